// smoke: --quality draft
/// \file chapters/drawings/11_drawings.cpp
/// \brief Chapter 11: the parts of the incoming and of the refracted direction, and
/// rays through a ball of glass.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/geometry/sphere.hpp>
#include <ljus/optics/refraction.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::flat;
using examples::Point;
using Vec = ljus::Vec3T<double>;
namespace colors = examples::colors;

/// D and T as radii of a circle, each with its part along the surface and its part
/// along the normal.
void draw_parts(const std::string& folder) {
    Drawing drawing{.name = "refraction-parts",
                    .description =
                        "The incoming direction D and the refracted one T in "
                        "a circle of radius 1. The part of T along the "
                        "surface is eta times that of D",
                    .low{-2.4, -1.3},
                    .high{2.4, 1.5},
                    .scale = 150};
    const double eta = 1 / 1.5, angle = 50 * std::numbers::pi / 180;
    const Vec d{std::sin(angle), -std::cos(angle), 0}, n{0, 1, 0};
    const Vec t = ljus::refract(d, n, eta).value();
    draw_area(drawing, {{-2.4, 0}, {2.4, 0}, {2.4, -1.3}, {-2.4, -1.3}}, colors::blue);
    draw_line(drawing, {{-2.4, 0}, {2.4, 0}}, {.width = 2});
    draw_line(drawing, examples::circle({0, 0}, 1),
              {.color = "#80808090", .dashed = true});
    draw_arrow(drawing, {0, 0}, {0, 1.3}, {.width = 1.5});
    draw_label(drawing, {0.13, 1.33}, "N");

    // D, and its parts: along the surface, and along the normal.
    const Point from = flat(-d), above{0, from.y};
    draw_arrow(drawing, from, {0, 0}, {colors::blue, 2.5});
    draw_arrow(drawing, from, above, {colors::green, 2.5});
    draw_arrow(drawing, above, {0, 0}, {colors::red, 2});
    draw_label(drawing, {from.x / 2 - 0.12, from.y / 2 - 0.12}, "D", colors::blue);
    draw_label(drawing, {from.x / 2, from.y + 0.13}, "P", colors::green);
    draw_label(drawing, {0.24, from.y / 2}, "cos θ_1", colors::red);

    const Point to = flat(t), below{0, to.y};
    draw_arrow(drawing, {0, 0}, to, {colors::orange, 2.5});
    draw_arrow(drawing, below, to, {colors::green, 2.5});
    draw_arrow(drawing, {0, 0}, below, {colors::red, 2});
    draw_label(drawing, {to.x / 2 + 0.14, to.y / 2}, "T", colors::orange);
    draw_label(drawing, {to.x + 0.2, to.y - 0.02}, "η P", colors::green);
    draw_label(drawing, {-0.26, to.y / 2}, "cos θ_2", colors::red);

    const double up = std::numbers::pi / 2, out = std::asin(eta * std::sin(angle));
    draw_arc(drawing, {0, 0}, 0.32, up, up + angle);
    draw_label(drawing, {-0.2, 0.42}, "θ_1");
    draw_arc(drawing, {0, 0}, 0.42, -up, -up + out);
    draw_label(drawing, {0.13, -0.52}, "θ_2");
    save_drawing(folder, drawing);
}

/// The way of a ray through a ball of index n: where it goes in, where out, and where
/// it is after a length of 4.
std::vector<Point> way_through_ball(double height, double n) {
    using Ray = ljus::RayT<double>;
    const ljus::SphereT<double> ball{};
    const Ray before{.origin{-2.2, height, 0}, .direction{1, 0, 0}};
    const auto in = point_at(before, *intersect(before, ball));
    const auto inside = *ljus::refract(before.direction, normal(ball, in), 1 / n);
    const Ray within{.origin = in, .direction = inside, .t_min = 1e-9};
    const auto out = point_at(within, *intersect(within, ball));
    const auto beyond = *ljus::refract(inside, normal(ball, out), n);
    const auto end = out + 4.0 * beyond;
    return {{-2.2, height}, {in.x, in.y}, {out.x, out.y}, {end.x, end.y}};
}

/// Parallel rays through a ball of glass, and where theory has their focus.
void draw_ball(const std::string& folder) {
    const double n = 1.5;
    Drawing figure{.name = "refraction-ball",
                   .description = "Parallel rays through a ball of glass",
                   .low{-2.2, -1.25},
                   .high{3.4, 1.25},
                   .scale = 125};
    std::vector<Point> circle;
    for (int i = 0; i < 120; ++i) {
        const double angle = 2 * std::numbers::pi * i / 120;
        circle.push_back({std::cos(angle), std::sin(angle)});
    }
    draw_area(figure, circle, colors::blue);
    for (int i = -24; i <= 24; ++i) {
        const double height = 0.98 * i / 24;
        draw_line(figure, way_through_ball(height, n), {colors::orange, 0.7});
    }
    const double focus = n / (2 * (n - 1)); // from the centre, for R = 1
    draw_line(figure, {{focus, -0.35}, {focus, 0.35}}, {.dashed = true});
    draw_label(figure, {focus, 0.5}, "n R / 2(n - 1)");
    save_drawing(folder, figure);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 11, refraction: drawings.");
        const examples::Options options = line.parse({});
        draw_parts(options.path(""));
        draw_ball(options.path(""));
    });
}
