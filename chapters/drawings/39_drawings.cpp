// smoke: --quality draft
/// \file chapters/drawings/39_drawings.cpp
/// \brief Chapter 39: pixels of a picture of the sky, and their places on the sphere.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

constexpr double pi = std::numbers::pi;
constexpr int width = 16, height = 8;

/// The place of a point of the picture: at its left edge 0, 0.
Point in_picture(double column, double row) {
    return {4 * column / width, 1 - 2 * row / height};
}

/// The same point on a sphere that is seen from the front and from 20 degrees above.
Point on_sphere(double column, double row) {
    const double down = pi * row / height, azimuth = pi * (2 * column / width - 1);
    const double tilt = 20 * pi / 180;
    const double back = std::sin(down) * std::cos(azimuth);
    return {6 + 1.2 * std::sin(down) * std::sin(azimuth),
            1.2 * (std::cos(down) * std::cos(tilt) - back * std::sin(tilt))};
}

/// The outline of a part of the picture, in one of the two views.
template <typename Place>
std::vector<Point> outline(double column, double row, double across,
                           const Place& place) {
    std::vector<Point> points;
    for (int i = 0; i <= 16; ++i)
        points.push_back(place(column + across * i / 16, row));
    for (int i = 16; i >= 0; --i)
        points.push_back(place(column + across * i / 16, row + 1));
    points.push_back(points.front());
    return points;
}

/// Two pixels of the same size in the picture, one of them near the zenith.
void draw_pixels(const std::string& folder) {
    Drawing drawing{.name = "environment-pixels",
                    .description =
                        "Left a picture with equal pixels; right the same pixels on "
                        "the sphere of directions, where those near the pole are small",
                    .low{-0.2, -1.5},
                    .high{7.4, 1.4},
                    .scale = 100};
    const examples::Pen thin{.color = "#80808090", .width = 1};
    for (int row = 0; row <= height; ++row) {
        draw_line(drawing, {in_picture(0, row), in_picture(width, row)}, thin);
        // The front half of the sphere: columns a quarter to three quarters.
        std::vector<Point> belt;
        for (int i = 0; i <= 48; ++i)
            belt.push_back(on_sphere(width * (0.25 + 0.5 * i / 48), row));
        draw_line(drawing, belt, thin);
    }
    for (int column = 0; column <= width; ++column) {
        draw_line(drawing, {in_picture(column, 0), in_picture(column, height)}, thin);
        if (column < width / 4 || column > 3 * width / 4) continue;
        std::vector<Point> meridian;
        for (int i = 0; i <= 48; ++i)
            meridian.push_back(on_sphere(column, height * i / 48.0));
        draw_line(drawing, meridian, thin);
    }
    draw_line(drawing, examples::circle({6, 0}, 1.2), {.width = 1.5});
    const struct {
        double column, row;
        const char* color;
    } pixels[] = {{8, 1, colors::orange}, {6, 4, colors::blue}};
    for (const auto& at : pixels)
        for (const bool sphere : {false, true}) {
            const auto place = [&](double column, double row) {
                return sphere ? on_sphere(column, row) : in_picture(column, row);
            };
            draw_area(drawing, outline(at.column, at.row, 1, place), at.color);
            draw_line(drawing, outline(at.column, at.row, 1, place),
                      {.color = at.color});
        }
    draw_label(drawing, {2, -1.25}, "the picture: equal steps of both angles");
    draw_label(drawing, {6, -1.36}, "the sphere of directions");
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawing.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 39, environments: drawings.");
        draw_pixels(line.parse({}).path(""));
    });
}
