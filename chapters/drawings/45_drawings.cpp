// smoke: --quality draft
/// \file chapters/drawings/45_drawings.cpp
/// \brief Chapter 45: a ray through a leaf, and the normals of a flat floor.

#include <cmath>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// Two leaves seen from the side, with their holes, and three rays.
void draw_holes(const std::string& folder) {
    Drawing drawing{.name = "textures-holes-rays",
                    .description =
                        "Three rays come down on two flat leaves with holes; one "
                        "ends on the upper leaf, one goes through a hole of it and "
                        "ends on the lower one, one goes through both",
                    .low{-0.3, -0.4},
                    .high{6.6, 2.7},
                    .scale = 90};
    const auto piece = [&](double from, double to, double y) {
        draw_line(drawing, {{from, y}, {to, y}}, {colors::green, 4});
    };
    const auto hole = [&](double from, double to, double y) {
        draw_line(drawing, {{from, y}, {to, y}}, {"#999999", 1});
    };
    piece(0, 1.6, 1.7);
    hole(1.6, 3.9, 1.7);
    piece(3.9, 5, 1.7);
    piece(1, 2.9, 0.9);
    hole(2.9, 4.6, 0.9);
    piece(4.6, 6, 0.9);
    draw_line(drawing, {{-0.2, 0}, {6.5, 0}}, {.width = 1.5});
    const auto ray = [&](double x, double end, const std::vector<double>& open) {
        const auto at = [&](double y) { return Point{x + 0.2 * (2.5 - y), y}; };
        draw_arrow(drawing, at(2.5), at(end), {colors::red, 2});
        for (const double y : open) draw_dot(drawing, at(y), 4, "#999999");
        draw_dot(drawing, at(end), 4, colors::red);
    };
    ray(0.7, 1.7, {});
    ray(2, 0.9, {1.7});
    ray(3.1, 0, {1.7, 0.9});
    draw_label(drawing, {4.45, 1.95}, "alpha 1", colors::green);
    draw_label(drawing, {2.7, 1.95}, "alpha 0", "#777777");
    save_drawing(folder, drawing);
}

/// A flat surface, and the normals that a picture gives it.
void draw_normals(const std::string& folder) {
    Drawing drawing{.name = "textures-frame",
                    .description =
                        "A flat surface with normals that turn as those of a groove "
                        "would, which is drawn below it; one of them with the axes u "
                        "and z of its picture",
                    .low{-0.3, -0.9},
                    .high{7.2, 1.6},
                    .scale = 90};
    const auto slope = [](double x) {
        const double from = x - 2;
        return std::abs(from) < 0.9 ? 0.75 * std::sin(from / 0.9 * 3.14159) : 0.0;
    };
    std::vector<Point> groove;
    double depth = 0;
    for (double x = 0; x <= 4; x += 0.02) {
        groove.push_back({x, depth - 0.12});
        depth += 0.02 * slope(x);
    }
    draw_line(drawing, groove, {"#999999", 1.5});
    draw_line(drawing, {{0, 0}, {4, 0}}, {.width = 2});
    for (double x = 0.2; x < 4; x += 0.3) {
        const double length = 0.8 / std::hypot(1, slope(x));
        draw_arrow(drawing, {x, 0}, {x - slope(x) * length, length}, {colors::blue, 2});
    }
    draw_line(drawing, {{4.6, 0}, {6.5, 0}}, {.width = 2});
    draw_arrow(drawing, {5.4, 0}, {6.4, 0}, {colors::orange, 2});
    draw_arrow(drawing, {5.4, 0}, {5.4, 1.2}, {colors::green, 2});
    draw_arrow(drawing, {5.4, 0}, {6.1, 0.95}, {colors::blue, 2.5});
    draw_label(drawing, {6.3, -0.3}, "∂p/∂u: red", colors::orange);
    draw_label(drawing, {5.4, 1.4}, "N: blue", colors::green);
    draw_label(drawing, {6.2, 1.2}, "mapped", colors::blue);
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 45, textures: drawings.");
        const std::string folder = line.parse({}).path("");
        draw_holes(folder);
        draw_normals(folder);
    });
}
