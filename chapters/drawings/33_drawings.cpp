// smoke: --quality draft
/// \file chapters/drawings/33_drawings.cpp
/// \brief Chapter 33: what the three methods compute in the same room.

#include <cmath>
#include <string>
#include <vector>

#include <ljus/math/random.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Pen;
using examples::Point;
namespace colors = examples::colors;

constexpr double width = 3, height = 2.2; // of a room in section

/// A room in section at x, with its lamp.
void draw_room(Drawing& drawing, double x, const char* name) {
    draw_line(drawing,
              {{x, height}, {x, 0}, {x + width, 0}, {x + width, height}, {x, height}},
              {.width = 1.5});
    draw_line(drawing, {{x + 1.2, height}, {x + 1.8, height}}, {colors::orange, 6});
    draw_label(drawing, {x + width / 2, -0.35}, name);
}

/// Radiosity, paths and photons in one room each.
void draw_methods(const std::string& folder) {
    Drawing drawing{.name = "side_by_side-methods",
                    .description =
                        "Three rooms: patches that exchange light; paths from "
                        "the camera; photons from the lamp with rays from the "
                        "camera",
                    .low{-0.2, -0.65},
                    .high{10.3, 2.45},
                    .scale = 85};
    draw_room(drawing, 0, "radiosity: patches");
    for (int i = 0; i <= 8; ++i)
        for (const double y : {0.0, height})
            draw_dot(drawing, {width * i / 8, y}, 3, "currentColor");
    for (int i = 1; i < 6; ++i)
        for (const double x : {0.0, width})
            draw_dot(drawing, {x, height * i / 6}, 3, "currentColor");
    const Point patches[] = {{1.5, height}, {0.95, 0}, {width, 0.9}, {0, 1.3}};
    for (const Point& a : patches)
        for (const Point& b : patches)
            if (a.x < b.x) draw_line(drawing, {a, b}, {colors::blue, 1.2});

    const double second = 3.5;
    draw_room(drawing, second, "path tracing: camera rays");
    const Point eye{second + 0.4, 1.6};
    const std::vector<Point> ways[] = {
        {eye, {second + 1.1, 0}, {second + 3, 1.1}, {second + 1.5, height}},
        {eye, {second + 2.1, 0}, {second + 0, 0.8}, {second + 1.4, height}}};
    for (const auto& way : ways)
        for (std::size_t i = 0; i + 1 < way.size(); ++i)
            draw_arrow(drawing, way[i], way[i + 1], {colors::blue, 1.5});
    draw_dot(drawing, eye, 5, "currentColor");

    const double third = 7;
    draw_room(drawing, third, "photon mapping: both");
    auto stream = ljus::random_stream(9, ljus::Pass::user, 0, 0);
    for (int i = 0; i < 70; ++i) {
        const ljus::Vec2 u = next_2d(stream);
        const double x = third + width * double(u.x);
        const bool wall = i % 3 == 0;
        draw_dot(drawing,
                 wall ? Point{i % 2 ? third : third + width, height * double(u.y)}
                      : Point{x, 0},
                 2.2, colors::orange);
    }
    for (const double x : {0.5, 1.2, 2.3})
        draw_arrow(drawing, {third + 1.5, height}, {third + x, 0},
                   {colors::orange, 1.2});
    const Point other{third + 0.4, 1.6};
    draw_arrow(drawing, other, {third + 1.6, 0}, {colors::blue, 1.5});
    draw_line(drawing, examples::circle({third + 1.6, 0}, 0.24), {colors::blue, 1.2});
    draw_dot(drawing, other, 5, "currentColor");
    save_drawing(folder, drawing);
}

/// Bias and noise as shots at a target.
void draw_target(const std::string& folder) {
    Drawing drawing{.name = "side_by_side-target",
                    .description =
                        "Three targets with hits: far apart around the "
                        "centre, close together beside it, and close together "
                        "at the centre",
                    .low{-1.2, -1.6},
                    .high{7.2, 1.2},
                    .scale = 95};
    const struct {
        double spread, shift;
        const char* name;
    } cases[] = {{0.62, 0, "noise, no bias"},
                 {0.1, 0.55, "bias, no noise"},
                 {0.1, 0, "neither"}};
    double x = 0;
    auto stream = ljus::random_stream(4, ljus::Pass::user, 0, 0);
    for (const auto& shots : cases) {
        for (const double radius : {0.35, 0.7, 1.05})
            draw_line(drawing, examples::circle({x, 0}, radius), {.width = 1});
        for (int i = 0; i < 14; ++i) {
            const ljus::Vec2 u = next_2d(stream), v = next_2d(stream);
            // The sum of two uniform numbers is nearly normal for the eye.
            draw_dot(
                drawing,
                {x + shots.shift + shots.spread * (double(u.x) + double(v.x) - 1),
                 0.6 * shots.shift + shots.spread * (double(u.y) + double(v.y) - 1)},
                3.5, colors::red);
        }
        draw_label(drawing, {x, -1.35}, shots.name);
        x += 3;
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 33, side by side: drawings.");
        const examples::Options options = line.parse({});
        draw_methods(options.path(""));
        draw_target(options.path(""));
    });
}
