// smoke: --quality draft
/// \file chapters/drawings/38_drawings.cpp
/// \brief Chapter 38: what can become of a mutant.

#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A box with lines of text.
/// \param middle  Of the box.
/// \param wide    From side to side.
void draw_box(Drawing& drawing, const Point& middle, double wide,
              const std::vector<std::string>& lines,
              const std::string& color = "currentColor") {
    const double high = 0.36 * double(lines.size()) + 0.26;
    const double left = middle.x - wide / 2, low = middle.y - high / 2;
    const std::vector<Point> corners{{left, low},
                                     {left + wide, low},
                                     {left + wide, low + high},
                                     {left, low + high},
                                     {left, low}};
    draw_line(drawing, corners, {.color = color});
    double y = middle.y + 0.18 * double(lines.size() - 1);
    for (const std::string& line : lines) {
        draw_label(drawing, {middle.x, y}, line, color);
        y -= 0.36;
    }
}

/// From a header to its mutants, and what their tests say.
void draw_mutants(const std::string& folder) {
    Drawing drawing{.name = "break_it-mutants",
                    .description = "A header becomes many mutants, each with one small "
                                   "change. A mutant is killed if a test fails. If all "
                                   "tests pass it is equivalent, or a test is missing, "
                                   "or the code is not needed",
                    .low{-0.1, -0.1},
                    .high{9.3, 4.35},
                    .scale = 78};
    draw_box(drawing, {0.85, 2.1}, 1.6, {"a header", "that passes"});
    const char* changes[] = {"+ → −", "< → <=", "2 → 3"};
    for (int i = 0; i < 3; ++i) {
        const double y = 3.4 - 1.3 * i;
        draw_arrow(drawing, {1.7, 2.1}, {2.55, y});
        draw_box(drawing, {3.3, y}, 1.4, {"mutant", changes[i]}, colors::violet);
        draw_arrow(drawing, {4.05, y}, {4.75, 2.1 + 0.25 * (1 - i)});
    }
    draw_box(drawing, {5.4, 2.1}, 1.2, {"its", "tests"});
    draw_arrow(drawing, {6.05, 2.3}, {6.95, 3.6}, {.color = colors::green});
    draw_arrow(drawing, {6.05, 2.1}, {6.95, 2.2}, {.color = colors::red});
    draw_arrow(drawing, {6.05, 1.9}, {6.95, 0.8});
    draw_box(drawing, {8.1, 3.65}, 2.2, {"a test fails:", "killed"}, colors::green);
    draw_box(drawing, {8.1, 2.2}, 2.2,
             {"all pass: a test is", "missing, or code", "is not needed"}, colors::red);
    draw_box(drawing, {8.1, 0.7}, 2.2,
             {"all pass, for", "nothing changed:", "equivalent"});
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawing.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 38, break it: a drawing.");
        const examples::Options options = line.parse({});
        draw_mutants(options.path(""));
    });
}
