// smoke: --quality draft
/// \file chapters/drawings/15_drawings.cpp
/// \brief Chapter 15: a mixture of materials.

#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// The light as a bar; each lobe of the mixture takes a piece of it.
void draw_mixture(const std::string& folder) {
    Drawing drawing{.name = "materials-mixture",
                    .description = "A bar of all light. The mirror takes the share r, "
                                   "the boundary the share F of the rest, refraction "
                                   "the share t of what is left, and the diffuse body "
                                   "the remainder",
                    .low{-0.2, -0.6},
                    .high{8.2, 3.6},
                    .scale = 85};
    constexpr double wide = 8, high = 0.42, r = 0.2, f = 0.16, t = 0.45;
    const auto bar = [&](double from, double to, double y, const char* color,
                         const char* share) {
        const std::vector<Point> corners{
            {from, y}, {to, y}, {to, y + high}, {from, y + high}, {from, y}};
        draw_area(drawing, corners, color);
        draw_line(drawing, corners, {.color = color});
        draw_label(drawing, {(from + to) / 2, y + high / 2}, share, color);
    };
    const char* rest = "#808080";
    const double first = wide * r, second = first + wide * (1 - r) * f;
    const double third = second + wide * (1 - r) * (1 - f) * t;
    bar(0, wide, 3.0, rest, "all light: 1");
    bar(0, first, 2.0, colors::green, "r");
    bar(first, wide, 2.0, rest, "1 − r");
    bar(first, second, 1.0, colors::red, "(1 − r) F");
    bar(second, wide, 1.0, rest, "(1 − r)(1 − F)");
    bar(second, third, 0.0, colors::blue, "(1 − r)(1 − F) t");
    bar(third, wide, 0.0, colors::orange, "(1 − r)(1 − F)(1 − t)");
    draw_label(drawing, {first / 2, 1.78}, "1. mirror", colors::green);
    draw_label(drawing, {(first + second) / 2, 0.78}, "2. boundary", colors::red);
    draw_label(drawing, {(second + third) / 2, -0.24}, "3. refracted", colors::blue);
    draw_label(drawing, {(third + wide) / 2, -0.24}, "4. diffuse body", colors::orange);
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 15, materials: drawings.");
        const examples::Options options = line.parse({});
        draw_mixture(options.path(""));
    });
}
