// smoke: --quality draft
/// \file chapters/drawings/47_drawings.cpp
/// \brief Chapter 47: one path, found by five strategies.

#include <array>
#include <string>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A strategy: how many vertices come from the lamp, and whether the last one merges.
struct Strategy {
    const char* name;
    std::size_t from_lamp;
    bool merges;
};

/// Draws x_0 on the lamp to x_2 and the eye, once for each strategy.
void draw_strategies(const std::string& folder) {
    constexpr std::array strategies{
        Strategy{"emission", 0, false}, Strategy{"shadow ray", 1, false},
        Strategy{"connection", 2, false}, Strategy{"merging at x_1", 1, true},
        Strategy{"merging at x_2", 2, true}};
    constexpr double step = 2.5;
    Drawing drawing{.name = "both_ends-strategies",
                    .description =
                        "A path from a lamp over two walls to the eye, five times: hit "
                        "by chance, with a ray to the lamp, with a ray between the "
                        "walls, merged at the first wall, merged at the second",
                    .low{-0.4, -0.75},
                    .high{5 * step - 0.1, 2.4},
                    .scale = 66};
    for (std::size_t i = 0; i < strategies.size(); ++i) {
        const Strategy& way = strategies[i];
        const double left = step * double(i);
        const std::array<Point, 4> x{Point{left + 0.9, 2}, Point{left + 1.7, 0},
                                     Point{left + 0.2, 0.9}, Point{left + 1.5, 1.5}};
        draw_line(drawing, {{left, 2}, {left, 0}, {left + 2, 0}}, {.width = 2});
        draw_line(drawing, {{left + 0.65, 2}, {left + 1.15, 2}}, {colors::orange, 7});
        draw_line(drawing, {{left + 0.02, 0.7}, {left + 0.02, 1.1}}, {.width = 5});
        for (std::size_t k = 0; k + 1 < x.size(); ++k) {
            const bool light = k + (way.merges ? 0u : 1u) < way.from_lamp;
            const bool joint = !way.merges && k + 1 == way.from_lamp;
            if (joint)
                draw_line(drawing, {x[k], x[k + 1]}, {.width = 2, .dashed = true});
            else if (light)
                draw_arrow(drawing, x[k], x[k + 1], {colors::orange, 2.5});
            else
                draw_arrow(drawing, x[k + 1], x[k], {colors::blue, 2.5});
        }
        if (way.merges)
            draw_line(drawing, examples::circle(x[way.from_lamp], 0.24),
                      {colors::red, 2});
        for (std::size_t k = 0; k < x.size(); ++k)
            draw_dot(drawing, x[k], 4.5,
                     k < way.from_lamp || (way.merges && k == way.from_lamp)
                         ? colors::orange
                         : colors::blue);
        draw_label(drawing, {left + 1.35, 2.2}, "x_0");
        draw_label(drawing, {left + 1.95, 0.22}, "x_1");
        draw_label(drawing, {left + 0.3, 1.25}, "x_2");
        draw_label(drawing, {left + 1.8, 1.6}, "eye");
        draw_label(drawing, {left + 1, -0.5}, way.name);
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawing.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 47, both ends: the strategies of a path.");
        const examples::Options options = line.parse({});
        draw_strategies(options.path(""));
    });
}
