// smoke: --quality draft
/// \file chapters/drawings/36_drawings.cpp
/// \brief Chapter 36: bias and noise of a mean of pictures, and the Pareto front.

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A bar from one height to another.
void draw_bar(Drawing& drawing, double x, double low, double high, const char* color) {
    if (high <= low) return;
    const std::vector<Point> corners{
        {x, low}, {x + 0.36, low}, {x + 0.36, high}, {x, high}, {x, low}};
    draw_area(drawing, corners, color);
    draw_area(drawing, corners, color);
    draw_line(drawing, corners, {.color = color, .width = 1.2});
}

/// The error b + v/n of the mean of n pictures, for a method with a bias and for one
/// without that has more noise.
void draw_means(const std::string& folder) {
    Drawing drawing{.name = "trades-means",
                    .description = "Bars for the means of 1, 2, 4, 8 and 16 pictures: "
                                   "noise is halved at each step, and the squared bias "
                                   "stays; from 8 pictures on the method without bias "
                                   "has the smaller error",
                    .low{-0.6, -0.75},
                    .high{7.6, 4.6},
                    .scale = 85};
    const double unit = 0.5; // of the drawing for an error of 1
    const double bias = 1, noise[] = {2, 8};
    for (int step = 0; step < 5; ++step) {
        const int n = 1 << step;
        const double x = 1.4 * step;
        draw_bar(drawing, x, 0, bias * unit, colors::red);
        draw_bar(drawing, x, bias * unit, (bias + noise[0] / n) * unit, colors::blue);
        draw_bar(drawing, x + 0.5, 0, noise[1] / n * unit, colors::orange);
        draw_label(drawing, {x + 0.43, -0.25}, std::to_string(n));
    }
    draw_line(drawing, {{-0.3, 0}, {7.4, 0}}, {.width = 2});
    draw_line(drawing, {{-0.3, bias * unit}, {7.4, bias * unit}},
              {.color = colors::red, .width = 1, .dashed = true});
    draw_label(drawing, {3.4, -0.58}, "pictures in the mean, n");
    draw_label(drawing, {7.1, bias * unit + 0.2}, "b", colors::red);
    draw_label(drawing, {0.18, 1.7}, "v/n", colors::blue);
    draw_label(drawing, {0.68, 4.2}, "v/n", colors::orange);
    draw_label(drawing, {4.9, 3.9}, "biased: b + v/n", colors::blue);
    draw_label(drawing, {4.9, 3.4}, "without bias: v/n, with a larger v",
               colors::orange);
    save_drawing(folder, drawing);
}

/// Settings by time and error: those that no other beats in both, and what a dot is
/// beaten by.
void draw_front(const std::string& folder) {
    Drawing drawing{.name = "trades-pareto",
                    .description =
                        "Dots by time and error. The front steps down to the "
                        "right; every other dot has one of the front to its "
                        "lower left",
                    .low{-0.7, -0.7},
                    .high{7.3, 4.4},
                    .scale = 85};
    std::vector<Point> settings{{0.6, 3.7}, {1.1, 2.5}, {1.5, 3.3}, {2.3, 1.7},
                                {2.9, 2.9}, {3.6, 1.5}, {4.3, 0.8}, {4.6, 2.2},
                                {5.4, 1.2}, {6.2, 0.5}, {6.4, 3.0}, {3.2, 3.8}};
    std::sort(settings.begin(), settings.end(),
              [](const Point& a, const Point& b) { return a.x < b.x; });
    std::vector<Point> front, others;
    for (const Point& setting : settings)
        (front.empty() || setting.y < front.back().y ? front : others)
            .push_back(setting);
    std::vector<Point> stairs;
    for (std::size_t i = 0; i < front.size(); ++i) {
        if (i > 0) stairs.push_back({front[i].x, front[i - 1].y});
        stairs.push_back(front[i]);
    }
    // What is faster and more accurate than one of the others.
    const Point beaten{4.6, 2.2};
    draw_area(drawing, {{0, 0}, {beaten.x, 0}, beaten, {0, beaten.y}}, colors::blue);
    draw_line(drawing, {{0, beaten.y}, beaten, {beaten.x, 0}},
              {.color = colors::blue, .width = 1, .dashed = true});
    draw_line(drawing, stairs, {.color = colors::orange, .width = 2});
    for (const Point& dot : others) draw_dot(drawing, dot, 5, "#808080");
    for (const Point& dot : front) draw_dot(drawing, dot, 6, colors::orange);
    draw_dot(drawing, beaten, 6, colors::blue);
    draw_arrow(drawing, {0, 0}, {7.1, 0});
    draw_arrow(drawing, {0, 0}, {0, 4.2});
    draw_label(drawing, {6.8, -0.3}, "time");
    draw_label(drawing, {0.4, 4.25}, "error");
    draw_label(drawing, {1.6, 0.5}, "faster and more accurate", colors::blue);
    draw_label(drawing, {6.7, 0.55}, "front", colors::orange);
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 36, trades: drawings.");
        const examples::Options options = line.parse({});
        draw_means(options.path(""));
        draw_front(options.path(""));
    });
}
