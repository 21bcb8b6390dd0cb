// smoke: --quality draft
/// \file chapters/drawings/26_budget_drawings.cpp
/// \brief Chapter 26: the best division of photons, as the least of a sum.

#include <cmath>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// The variance due to two objects, against the fraction of the first one.
void draw_sum(const std::string& folder) {
    Drawing drawing{.name = "budget-sum",
                    .description = "The variances that two objects add to a picture, "
                                   "over the share of photons that the first one gets; "
                                   "their sum is least where the slopes cancel",
                    .low{-0.7, -0.6},
                    .high{6.6, 3.7},
                    .scale = 95};
    const double a[] = {3, 1}; // the scatter of both
    const double w = 6, h = 3.4, largest = 60;
    const auto at = [&](double share, double value) {
        return Point{w * share, h * value / largest};
    };
    std::vector<Point> first, second, sum;
    for (int i = 6; i < 195; ++i) {
        const double s = i / 200.0;
        const double one = a[0] * a[0] / s, other = a[1] * a[1] / (1 - s);
        if (one < largest) first.push_back(at(s, one));
        if (other < largest) second.push_back(at(s, other));
        if (one + other < largest) sum.push_back(at(s, one + other));
    }
    const double best = a[0] / (a[0] + a[1]);
    draw_arrow(drawing, {0, 0}, {w + 0.3, 0}, {.width = 1.2});
    draw_arrow(drawing, {0, 0}, {0, h + 0.2}, {.width = 1.2});
    draw_line(drawing, first, {colors::blue, 2});
    draw_line(drawing, second, {colors::orange, 2});
    draw_line(drawing, sum, {.width = 3});
    const double least = (a[0] + a[1]) * (a[0] + a[1]);
    draw_line(drawing, {at(best, 0), at(best, least)}, {colors::red, 1.2, true});
    draw_dot(drawing, at(best, least), 5, colors::red);
    draw_line(drawing, {at(0.5, 0), at(0.5, 20)}, {.width = 1, .dashed = true});
    draw_dot(drawing, at(0.5, 20), 4, "currentColor");
    draw_label(drawing, {w * best, -0.3}, "a_1/(a_1 + a_2)", colors::red);
    draw_label(drawing, {w * 0.5, -0.3}, "1/2");
    draw_label(drawing, {1.1, 1.15}, "a_1²/s", colors::blue);
    draw_label(drawing, {3.83, 0.43}, "a_2²/(1 − s)", colors::orange);
    draw_label(drawing, {2.55, 1.62}, "sum");
    draw_label(drawing, {6.35, 0.25}, "s");
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 26, a budget for caustics: drawings.");
        const examples::Options options = line.parse({});
        draw_sum(options.path(""));
    });
}
