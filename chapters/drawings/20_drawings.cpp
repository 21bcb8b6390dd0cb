// smoke: --quality draft
/// \file chapters/drawings/20_drawings.cpp
/// \brief Chapter 20: a path with its shadow rays, and two ways to find a lamp.

#include <cmath>
#include <string>
#include <vector>

#include <ljus/math/random.hpp>
#include <ljus/math/sampling.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A path through a room; each vertex asks the lamp.
void draw_path(const std::string& folder) {
    Drawing drawing{.name = "path_tracing-path",
                    .description = "A path from the camera over three vertices; from "
                                   "each of them a shadow ray goes to the lamp, one of "
                                   "which is blocked",
                    .low{-0.3, -0.4},
                    .high{6.9, 3.4},
                    .scale = 100};
    draw_line(drawing, {{0, 3}, {0, 0}, {6.6, 0}, {6.6, 3}, {0, 3}}, {.width = 2});
    draw_line(drawing, {{2.9, 3}, {3.9, 3}}, {colors::orange, 7});
    const Point eye{0.6, 1.9}, x1{2.4, 0}, x2{6.6, 1.55}, x3{4.9, 0}, lamp{3.4, 3};
    const Point ball{3.1, 1.25};
    draw_area(drawing, examples::circle(ball, 0.42), "currentColor");
    draw_line(drawing, examples::circle(ball, 0.42));
    draw_arrow(drawing, eye, x1, {.width = 2.5});
    draw_arrow(drawing, x1, x2, {.width = 2.5});
    draw_arrow(drawing, x2, x3, {.width = 2.5});
    draw_line(drawing, {x2, lamp}, {.color = colors::orange, .dashed = true});
    draw_line(drawing, {x3, lamp}, {.color = colors::orange, .dashed = true});
    // The first one ends at the ball: where the segment enters the circle.
    const double dx = lamp.x - x1.x, dy = lamp.y - x1.y;
    const double a = dx * dx + dy * dy;
    const double b = (x1.x - ball.x) * dx + (x1.y - ball.y) * dy;
    const double c =
        std::pow(x1.x - ball.x, 2) + std::pow(x1.y - ball.y, 2) - 0.42 * 0.42;
    const double t = (-b - std::sqrt(b * b - a * c)) / a;
    draw_line(drawing, {x1, {x1.x + t * dx, x1.y + t * dy}},
              {.color = colors::red, .dashed = true});
    draw_dot(drawing, {x1.x + t * dx, x1.y + t * dy}, 5, colors::red);
    for (const Point& vertex : {eye, x1, x2, x3})
        draw_dot(drawing, vertex, 4, "currentColor");
    draw_label(drawing, {0.4, 2.1}, "E");
    draw_label(drawing, {2.4, -0.22}, "x_1");
    draw_label(drawing, {6.77, 1.55}, "x_2");
    draw_label(drawing, {4.9, -0.22}, "x_3");
    draw_label(drawing, {3.4, 2.72}, "L", colors::orange);
    draw_label(drawing, {2.3, 0.75}, "V = 0", colors::red);
    save_drawing(folder, drawing);
}

/// Two strategies: a point of the lamp, or a direction of the surface's lobe.
void draw_strategies(const std::string& folder) {
    Drawing drawing{.name = "path_tracing-strategies",
                    .description =
                        "Left directions are chosen by points of the lamp, "
                        "right by the lobe of a glossy surface; either finds "
                        "what the other one misses",
                    .low{-2.3, -0.6},
                    .high{6.9, 2.75},
                    .scale = 85};
    auto stream = ljus::random_stream(2, ljus::Pass::user, 0, 0);
    for (const bool by_lobe : {false, true}) {
        const double x = by_lobe ? 4.6 : 0;
        draw_line(drawing, {{x - 2.2, 0}, {x + 2.2, 0}}, {.width = 2});
        const Point lamp[] = {{x - 0.1, 2.4}, {x + 1.8, 2.0}};
        draw_line(drawing, {lamp[0], lamp[1]}, {colors::orange, 6});
        // The lobe: a power of the cosine around the mirror direction.
        const double mirror = 0.6, power = 30;
        std::vector<Point> lobe{{x, 0}};
        for (int i = -60; i <= 60; ++i) {
            const double a = mirror + i * 0.02;
            const double r = 1.7 * std::pow(std::cos(i * 0.02), power);
            lobe.push_back({x + r * std::sin(a), r * std::cos(a)});
        }
        draw_area(drawing, lobe, colors::blue);
        draw_line(drawing, lobe, {colors::blue, 1.2});
        for (int i = 0; i < 7; ++i) {
            const double u = (i + double(next_1d(stream))) / 7;
            Point end{lamp[0].x + u * (lamp[1].x - lamp[0].x),
                      lamp[0].y + u * (lamp[1].y - lamp[0].y)};
            bool found = true;
            if (by_lobe) {
                const double side = u < 0.5 ? -1 : 1, v = std::abs(2 * u - 1);
                const double a = mirror + side * std::acos(std::pow(1 - v, 1 / power));
                const double t =
                    (2.4 - 0.1 * 0.4 / 1.9) / (std::cos(a) + std::sin(a) * 0.4 / 1.9);
                end = {x + t * std::sin(a), t * std::cos(a)};
                found = end.x > lamp[0].x && end.x < lamp[1].x;
                if (!found) end = {x + 2.5 * std::sin(a), 2.5 * std::cos(a)};
            }
            draw_arrow(drawing, {x, 0}, end,
                       {found ? colors::orange : "#80808090", 1.2});
        }
        draw_arrow(drawing, {x - 1.7 * std::sin(mirror), 1.7 * std::cos(mirror)},
                   {x, 0}, {.width = 1.5});
        draw_dot(drawing, {x, 0}, 4, "currentColor");
        draw_label(drawing, {x, -0.35},
                   by_lobe ? "by the lobe: p_b" : "by the lamp: p_l");
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 20, path tracing: drawings.");
        const examples::Options options = line.parse({});
        draw_path(options.path(""));
        draw_strategies(options.path(""));
    });
}
