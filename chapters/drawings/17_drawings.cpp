// smoke: --quality draft
/// \file chapters/drawings/17_drawings.cpp
/// \brief Chapter 17: the two waves of a film, and a bubble between the lamp and the eye.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/optics/refraction.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A ray at a film: reflected at its first surface, and at its second one.
void draw_two_waves(const std::string& folder) {
    Drawing drawing{.name = "soap_film-ways",
                    .description = "A wave meets a film. One part is reflected at the "
                                   "first surface, another crosses the film twice; the "
                                   "marked ways differ",
                    .low{-2.6, -1.9},
                    .high{4.4, 2.3},
                    .scale = 105};
    const double n = 1.33, angle = 48 * std::numbers::pi / 180, d = 1.15;
    const ljus::Vec3T<double> wo{-std::sin(angle), 0, std::cos(angle)};
    const auto wt = ljus::refract(wo, 1 / n).value();
    const double across = -d * wt.x / wt.z; // how far the ray shifts in the film
    draw_area(drawing, {{-2.6, 0}, {4.4, 0}, {4.4, -d}, {-2.6, -d}}, colors::blue);
    draw_line(drawing, {{-2.6, 0}, {4.4, 0}});
    draw_line(drawing, {{-2.6, -d}, {4.4, -d}});
    const Point first{0, 0}, bottom{across, -d}, second{2 * across, 0};
    const auto outwards = [&](const Point& from, double length) {
        return Point{from.x - length * wo.x, from.y + length * wo.z};
    };
    draw_arrow(drawing, {2.4 * wo.x, 2.4 * wo.z}, first, {.width = 2});
    // The front of the wave that leaves at the second point meets the first ray here.
    const double early = 2 * across * std::sin(angle);
    draw_line(drawing, {outwards(first, early), second}, {.width = 1, .dashed = true});
    draw_line(drawing, {first, outwards(first, early)}, {colors::red, 4});
    draw_arrow(drawing, outwards(first, early), outwards(first, 2.6), {colors::red, 2});
    draw_line(drawing, {first, bottom, second}, {colors::orange, 4});
    draw_arrow(drawing, second, outwards(second, 2.6 - early), {colors::orange, 2});
    for (const Point& point : {first, bottom, second})
        draw_dot(drawing, point, 4, "currentColor");
    draw_line(drawing, {{0, -1.75}, {0, 1.9}}, {.width = 0.8, .dashed = true});
    draw_label(drawing, {-0.32, 0.95}, "θ_i");
    draw_label(drawing, {0.2, -0.75}, "θ_t");
    draw_label(drawing, {3.9, -d / 2}, "d");
    draw_arrow(drawing, {3.6, -d / 2}, {3.6, 0}, {.width = 1});
    draw_arrow(drawing, {3.6, -d / 2}, {3.6, -d}, {.width = 1});
    draw_label(drawing, {-2.1, -d / 2}, "index n");
    draw_label(drawing, {-0.0, 1.98}, "changes its sign", colors::red);
    draw_label(drawing, {2.2, -1.5}, "keeps its sign", colors::orange);
    save_drawing(folder, drawing);
}

/// Two waves that add up, and two that cancel.
void draw_sum(const std::string& folder) {
    Drawing drawing{.name = "soap_film-sum",
                    .description = "Two waves in step add up; two waves half a "
                                   "wavelength apart cancel",
                    .low{-0.1, -1.25},
                    .high{9.3, 1.4},
                    .scale = 80};
    for (const bool in_step : {true, false}) {
        const double x = in_step ? 0.0 : 5.0;
        const double shift = in_step ? 2 * std::numbers::pi : std::numbers::pi;
        std::vector<Point> one, other, sum;
        for (int i = 0; i <= 160; ++i) {
            const double at = 4.2 * i / 160, phase = at * 2 * std::numbers::pi / 1.4;
            const double a = 0.5 * std::sin(phase), b = 0.5 * std::sin(phase - shift);
            one.push_back({x + at, a + 0.02});
            other.push_back({x + at, b - 0.02});
            sum.push_back({x + at, a + b});
        }
        draw_line(drawing, one, {colors::red, 1.5});
        draw_line(drawing, other, {colors::orange, 1.5, true});
        draw_line(drawing, sum, {colors::blue, 3});
        draw_label(drawing, {x + 2.1, 1.2},
                   in_step ? "one wavelength late: bright"
                           : "half a wavelength late: dark");
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 17, soap film: drawings.");
        const examples::Options options = line.parse({});
        draw_two_waves(options.path(""));
        draw_sum(options.path(""));
    });
}
