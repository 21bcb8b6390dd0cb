// smoke: --quality draft
/// \file chapters/drawings/27_drawings.cpp
/// \brief Chapter 27: three kinds of photons.

#include <cmath>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A photon's way: direct where it first lands, shadow behind that, indirect after a
/// bounce.
void draw_kinds(const std::string& folder) {
    Drawing drawing{.name = "general-kinds",
                    .description =
                        "A photon from the lamp is stored as direct where it "
                        "first lands, as shadow on all surfaces behind, and "
                        "as indirect after each bounce",
                    .low{-0.3, -0.45},
                    .high{6.3, 3.35},
                    .scale = 100};
    const double w = 6, h = 3;
    draw_line(drawing, {{0, h}, {0, 0}, {w, 0}, {w, h}, {0, h}}, {.width = 2});
    draw_line(drawing, {{1.2, h}, {2.0, h}}, {colors::orange, 7});
    const Point box[] = {{2.4, 0.9}, {3.5, 0.9}, {3.5, 1.9}, {2.4, 1.9}};
    draw_area(drawing, {box[0], box[1], box[2], box[3]}, "currentColor");
    draw_line(drawing, {box[0], box[1], box[2], box[3], box[0]}, {.width = 2});
    const Point lamp{1.6, h}, top{2.9, 1.9};
    // The line continues through the box to the floor.
    const double slope = (top.y - lamp.y) / (top.x - lamp.x);
    const Point bottom{top.x + (0.9 - top.y) / slope, 0.9},
        floor{top.x - top.y / slope, 0};
    draw_arrow(drawing, lamp, top, {colors::orange, 2.2});
    if (bottom.x < 3.5) draw_dot(drawing, bottom, 5, "#808080");
    const double right = top.y + slope * (3.5 - top.x);
    draw_line(drawing, {top, floor},
              {.color = "#808080", .width = 1.5, .dashed = true});
    if (right > 0.9) draw_dot(drawing, {3.5, right}, 6, "#808080");
    draw_dot(drawing, floor, 6, "#808080");
    const Point wall{w, 2.5}, low{4.3, 0};
    draw_arrow(drawing, top, wall, {colors::blue, 2});
    draw_arrow(drawing, wall, low, {colors::blue, 2});
    draw_dot(drawing, top, 6, colors::orange);
    draw_dot(drawing, wall, 6, colors::blue);
    draw_dot(drawing, low, 6, colors::blue);
    draw_label(drawing, {2.3, 2.05}, "direct", colors::orange);
    draw_label(drawing, {floor.x + 0.1, -0.26}, "shadow");
    draw_label(drawing, {low.x - 0.25, -0.26}, "indirect", colors::blue);
    draw_label(drawing, {5.45, 2.7}, "indirect", colors::blue);
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the drawing.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 27, the general map: its drawing.");
        const examples::Options options = line.parse({});
        draw_kinds(options.path(""));
    });
}
