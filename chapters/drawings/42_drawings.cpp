// smoke: --quality draft
/// \file chapters/drawings/42_drawings.cpp
/// \brief Chapter 42: who owns which light, and the photons beside a ray.

#include <cmath>
#include <numbers>
#include <string>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A whole circle.
void draw_circle(Drawing& drawing, const Point& center, double radius,
                 const examples::Pen& pen) {
    draw_arc(drawing, center, radius, 0, 2 * std::numbers::pi, pen);
}

/// Three ways of light to a ray, of which the last two are stored.
void draw_owners(const std::string& folder) {
    Drawing drawing{.name = "volume_photons-owners",
                    .description =
                        "Light comes to a ray straight from a lamp, through a ball of "
                        "glass, or after it was scattered elsewhere",
                    .low{-0.4, -1.2},
                    .high{8.2, 3.1},
                    .scale = 85};
    draw_area(drawing, {{0.5, -1.1}, {8, -1.1}, {8, 3}, {0.5, 3}}, colors::blue);
    draw_arrow(drawing, {8, 0}, {0, 0}, {.width = 2.5});
    const Point lamp{4, 2.6};
    draw_arrow(drawing, lamp, {1.75, 0.06}, {colors::orange, 2});
    draw_line(drawing, {lamp, {4, 1.55}}, {colors::green, 2});
    draw_circle(drawing, {4, 1.2}, 0.35, {colors::green, 2});
    draw_arrow(drawing, {4, 0.85}, {4, 0.06}, {colors::green, 2});
    draw_line(drawing, {lamp, {6.9, 1.6}}, {colors::violet, 2});
    draw_arrow(drawing, {6.9, 1.6}, {6.15, 0.06}, {colors::violet, 2});
    draw_dot(drawing, {6.9, 1.6}, 4, colors::violet);
    draw_dot(drawing, {4, 0}, 5, colors::green);
    draw_dot(drawing, {6.12, 0}, 5, colors::violet);
    draw_dot(drawing, lamp, 8, colors::orange);
    draw_label(drawing, {1.75, -0.45}, "shadow ray", colors::orange);
    draw_label(drawing, {4, -0.45}, "photon, L S+ D", colors::green);
    draw_label(drawing, {6.3, -0.45}, "photon, L D D", colors::violet);
    draw_label(drawing, {0, -0.4}, "eye");
    save_drawing(folder, drawing);
}

/// A ray and the balls of photons, some of which it crosses.
void draw_beam(const std::string& folder) {
    Drawing drawing{.name = "volume_photons-beam",
                    .description =
                        "A ray crosses the balls of some photons; each counts by its "
                        "distance from the ray",
                    .low{-0.4, -1.6},
                    .high{7.6, 1.6},
                    .scale = 90};
    const struct {
        Point at;
        double radius;
    } photons[] = {{{1.2, 0.35}, 0.6},  {{2.3, -0.9}, 0.5}, {{3.0, -0.2}, 0.45},
                   {{4.0, 0.25}, 0.35}, {{4.5, 0.1}, 0.3},  {{5.2, 1.0}, 0.5},
                   {{6.3, -0.45}, 0.7}};
    for (const auto& [at, radius] : photons) {
        const bool met = std::abs(at.y) < radius;
        const char* color = met ? colors::red : colors::blue;
        draw_circle(drawing, at, radius, {color, 1.5, !met});
        if (met) draw_line(drawing, {at, {at.x, 0}}, {color, 2});
        draw_dot(drawing, at, 4, color);
    }
    draw_arrow(drawing, {0, 0}, {7.5, 0}, {.width = 2.5});
    draw_label(drawing, {1.0, 0.15}, "d", colors::red);
    draw_label(drawing, {0, -0.35}, "eye");
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 42, photons in fog: drawings.");
        const examples::Options options = line.parse({});
        draw_owners(options.path(""));
        draw_beam(options.path(""));
    });
}
