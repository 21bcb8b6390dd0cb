// smoke: --quality draft
/// \file chapters/drawings/05_drawings.cpp
/// \brief Chapter 5: what a ray is, and where the rounding puts the point that it meets.

#include <cmath>
#include <string>
#include <vector>

#include <ljus/geometry/sphere.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::flat;
using examples::Point;
using Vec = ljus::Vec3T<double>;
namespace colors = examples::colors;

/// A ray, its parameter, and the range of t that counts.
void draw_ray(const std::string& folder) {
    Drawing drawing{.name = "ray-range",
                    .description = "A ray from its origin O along D, with the part "
                                   "between t_min and t_max, and the first hit in it",
                    .low{-0.4, -0.9},
                    .high{6.6, 1.8},
                    .scale = 100};
    const ljus::RayT<double> ray{
        .origin{0, 0, 0}, .direction{1, 0.2, 0}, .t_min = 0.8, .t_max = 5.2};
    const ljus::SphereT<double> behind{.center{0.2, 0.25, 0}, .radius = 0.5};
    const ljus::SphereT<double> hit{.center{3.5, 0.95, 0}, .radius = 0.75};
    const auto at = [&](double t) { return flat(point_at(ray, t)); };
    for (const auto& ball : {behind, hit}) {
        draw_area(drawing, examples::circle(flat(ball.center), ball.radius),
                  colors::blue);
        draw_line(drawing, examples::circle(flat(ball.center), ball.radius));
    }
    draw_line(drawing, {at(0), at(6)}, {.width = 1, .dashed = true});
    draw_line(drawing, {at(ray.t_min), at(ray.t_max)},
              {.color = colors::orange, .width = 3});
    draw_arrow(drawing, at(0), at(1), {.width = 2.5});
    const double t = intersect(ray, hit).value();
    draw_dot(drawing, at(t), 5, colors::red);
    draw_dot(drawing, at(0), 4, "currentColor");
    draw_dot(drawing, at(ray.t_min), 4, colors::orange);
    draw_dot(drawing, at(ray.t_max), 4, colors::orange);
    draw_label(drawing, {-0.1, 0.17}, "O");
    draw_label(drawing, {0.85, -0.08}, "D");
    draw_label(drawing, {1.0, 0.5}, "t_min", colors::orange);
    draw_label(drawing, {5.3, 0.75}, "t_max", colors::orange);
    draw_label(drawing, {at(t).x - 0.5, at(t).y + 0.3}, "O + tD", colors::red);
    draw_label(drawing, {0.7, -0.6}, "too near: not a hit");
    save_drawing(folder, drawing);
}

/// The computed point lies anywhere in a box of rounding; the next ray starts above it.
void draw_box_of_rounding(const std::string& folder) {
    Drawing drawing{.name = "ray-rounding",
                    .description = "A surface, the box in which rounding may put the "
                                   "computed point, and the origin moved along the "
                                   "normal until the whole box lies below it",
                    .low{-3.2, -1.5},
                    .high{3.4, 2.3},
                    .scale = 100};
    // The surface is a line at 20 degrees; the box is an error bound per axis.
    const double slope = 0.36, norm = std::hypot(1.0, slope);
    const Point n{-slope / norm, 1 / norm};
    const double ex = 0.75, ey = 0.55;
    draw_area(drawing,
              {{-3.2, -3.2 * slope}, {3.4, 3.4 * slope}, {3.4, -1.5}, {-3.2, -1.5}},
              "currentColor");
    draw_line(drawing, {{-3.2, -3.2 * slope}, {3.4, 3.4 * slope}}, {.width = 2});
    draw_area(drawing, {{-ex, -ey}, {ex, -ey}, {ex, ey}, {-ex, ey}}, colors::red);
    draw_line(drawing, {{-ex, -ey}, {ex, -ey}, {ex, ey}, {-ex, ey}, {-ex, -ey}},
              {.color = colors::red});
    // How far the box reaches along n, above the plane: |n| . (ex, ey).
    const double reach = std::abs(n.x) * ex + std::abs(n.y) * ey;
    const Point computed{0.42, -0.28};
    const Point origin{computed.x + 2 * reach * n.x, computed.y + 2 * reach * n.y};
    draw_line(drawing,
              {{-2.4 + reach * n.x, -2.4 * slope + reach * n.y},
               {2.6 + reach * n.x, 2.6 * slope + reach * n.y}},
              {.color = colors::orange, .dashed = true});
    draw_arrow(drawing, {0, 0}, {1.9 * n.x, 1.9 * n.y}, {.width = 2});
    draw_arrow(drawing, computed, origin, {colors::orange, 2.5});
    draw_dot(drawing, {0, 0}, 4, "currentColor");
    draw_dot(drawing, computed, 5, colors::red);
    draw_dot(drawing, origin, 5, colors::orange);
    draw_label(drawing, {-0.9 + 1.75 * n.x + 0.6, 1.85}, "n");
    draw_label(drawing, {1.5, -0.55}, "computed point", colors::red);
    draw_label(drawing, {origin.x + 0.9, origin.y + 0.42}, "origin of the next ray",
               colors::orange);
    draw_label(drawing, {-0.2, -0.18}, "P");
    draw_label(drawing, {-2.3, -0.35}, "true surface");
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 5, rays: drawings.");
        const examples::Options options = line.parse({});
        draw_ray(options.path(""));
        draw_box_of_rounding(options.path(""));
    });
}
