// smoke: --quality draft
/// \file chapters/drawings/12_drawings.cpp
/// \brief Chapter 12: the two polarisations, and what a surface reflects by angle.

#include <cmath>
#include <numbers>
#include <string>

#include <ljus/optics/fresnel.hpp>
#include <ljus/optics/refraction.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Pen;
using examples::Point;
namespace colors = examples::colors;

constexpr double n_t = 1.5;

/// The directions at a boundary of glass, each as a unit vector away from the point.
struct Directions {
    Point in, reflected, transmitted;
};
Directions directions(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const ljus::Vec3T<double> wo{-std::sin(angle), 0, std::cos(angle)};
    const auto wt = ljus::refract(wo, 1 / n_t).value();
    return {{wo.x, wo.z}, {-wo.x, wo.z}, {wt.x, wt.z}};
}

/// Left the electric field across the plane of incidence (s), right within it (p).
void draw_polarisations(const std::string& folder) {
    Drawing drawing{.name = "fresnel-polarisations",
                    .description = "The electric field of a wave at a boundary: across "
                                   "the plane of incidence, and within it",
                    .low{-2.2, -1.75},
                    .high{6.6, 1.9},
                    .scale = 85};
    for (const bool is_p : {false, true}) {
        const Point hit{is_p ? 4.4 : 0.0, 0};
        const Directions d = directions(50);
        draw_area(
            drawing,
            {{hit.x - 2, 0}, {hit.x + 2, 0}, {hit.x + 2, -1.6}, {hit.x - 2, -1.6}},
            colors::blue);
        draw_line(drawing, {{hit.x - 2, 0}, {hit.x + 2, 0}});
        draw_line(drawing, {{hit.x, -1.4}, {hit.x, 1.6}}, {.width = 1, .dashed = true});
        const auto along = [&](const Point& way, double t) {
            return Point{hit.x + t * way.x, hit.y + t * way.y};
        };
        draw_arrow(drawing, along(d.in, 1.9), hit, {colors::orange, 2.2});
        draw_arrow(drawing, hit, along(d.reflected, 1.9), {colors::orange, 2.2});
        draw_arrow(drawing, hit, along(d.transmitted, 1.6), {colors::orange, 2.2});
        for (const Point& way : {d.in, d.reflected, d.transmitted}) {
            const Point at = along(way, 1.05);
            if (is_p) { // a double arrow across the ray
                draw_arrow(drawing, at, {at.x - 0.38 * way.y, at.y + 0.38 * way.x},
                           {.width = 2});
                draw_arrow(drawing, at, {at.x + 0.38 * way.y, at.y - 0.38 * way.x},
                           {.width = 2});
            } else { // seen from its tip
                draw_line(drawing, examples::circle(at, 0.13), {.width = 2});
                draw_dot(drawing, at, 3, "currentColor");
            }
        }
        draw_label(drawing, {hit.x + 1.65, -1.35}, is_p ? "p" : "s");
        draw_label(drawing, {hit.x - 0.28, 0.78}, "θ_i");
        draw_label(drawing, {hit.x + 0.22, -0.85}, "θ_t");
        draw_label(drawing, {hit.x - 1.5, 0.22}, "n_i = 1");
        draw_label(drawing, {hit.x - 1.42, -0.25}, "n_t = 1.5");
    }
    save_drawing(folder, drawing);
}

/// Rays of several angles, their width in proportion to their flux.
void draw_shares(const std::string& folder) {
    Drawing drawing{.name = "fresnel-shares",
                    .description = "Four rays that meet glass at growing angles; the "
                                   "width of the reflected and transmitted rays is "
                                   "their share of the flux",
                    .low{-0.2, -1.25},
                    .high{9.4, 1.7},
                    .scale = 90};
    draw_area(drawing, {{-0.2, 0}, {9.4, 0}, {9.4, -1.25}, {-0.2, -1.25}},
              colors::blue);
    draw_line(drawing, {{-0.2, 0}, {9.4, 0}});
    double x = 1.0;
    for (const double degrees : {0.0, 45.0, 70.0, 85.0}) {
        const Directions d = directions(degrees);
        const double share =
            ljus::fresnel(std::cos(degrees * std::numbers::pi / 180), 1.0, n_t);
        const double widest = 16;
        const auto to = [&](const Point& way, double t) {
            return Point{x + t * way.x, t * way.y};
        };
        draw_line(drawing, {to(d.in, 1.2), {x, 0}}, {colors::orange, widest});
        draw_line(drawing, {{x, 0}, to(d.reflected, 1.2)},
                  {colors::red, widest * share});
        draw_line(drawing, {{x, 0}, to(d.transmitted, 1.1)},
                  {colors::blue, widest * (1 - share)});
        draw_label(drawing, {x, 1.5},
                   examples::text(degrees, "%.0f") +
                       "°: R = " + examples::text(100 * share, "%.0f") + " %");
        x += 2.35;
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 12, Fresnel: drawings.");
        const examples::Options options = line.parse({});
        draw_polarisations(options.path(""));
        draw_shares(options.path(""));
    });
}
