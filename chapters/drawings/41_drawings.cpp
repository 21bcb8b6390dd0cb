// smoke: --quality draft
/// \file chapters/drawings/41_drawings.cpp
/// \brief Chapter 41: what fog does to a ray, phase functions, and equal angles.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/media/equi_angular.hpp>
#include <ljus/media/phase_function.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A ray that loses light on its way, and gains some of a lamp.
void draw_losses(const std::string& folder) {
    Drawing drawing{.name = "fog-losses",
                    .description =
                        "On a ray through fog, light is absorbed and scattered out; "
                        "light of a lamp is scattered into it",
                    .low{-0.4, -1.6},
                    .high{6.4, 2.6},
                    .scale = 90};
    draw_area(drawing, {{0.6, -1.4}, {5.4, -1.4}, {5.4, 2.4}, {0.6, 2.4}},
              colors::blue);
    draw_arrow(drawing, {6.2, 0}, {0, 0}, {.width = 2.5});
    draw_dot(drawing, {4.4, 0}, 5, colors::red);
    draw_dot(drawing, {3.4, 0}, 5, colors::violet);
    draw_arrow(drawing, {3.4, 0}, {2.9, -1}, {colors::violet, 2});
    draw_dot(drawing, {1.9, 0}, 5, colors::orange);
    draw_arrow(drawing, {3.3, 1.9}, {1.97, 0.1}, {colors::orange, 2});
    draw_dot(drawing, {3.3, 1.95}, 8, colors::orange);
    draw_label(drawing, {4.4, 0.4}, "absorbed", colors::red);
    draw_label(drawing, {3.9, -1.15}, "scattered out", colors::violet);
    draw_label(drawing, {1.5, 0.55}, "scattered in", colors::orange);
    draw_label(drawing, {0, -0.35}, "eye");
    draw_label(drawing, {3.75, 2.1}, "lamp", colors::orange);
    save_drawing(folder, drawing);
}

/// The root of the phase function, drawn around a point.
void draw_phase(const std::string& folder) {
    Drawing drawing{.name = "fog-phase",
                    .description = "Henyey and Greenstein's phase function for three "
                                   "values of g: backwards, even, forwards",
                    .low{-2.6, -1.7},
                    .high{4.6, 1.7},
                    .scale = 90};
    const struct {
        double g;
        const char* color;
        const char* name;
        Point label;
    } curves[] = {{0, colors::green, "g = 0", {-0.6, 1.25}},
                  {-0.4, colors::orange, "-0.4", {-1.9, 0.75}},
                  {0.7, colors::red, "0.7", {3.2, 1.1}}};
    for (const auto& curve : curves) {
        std::vector<Point> points;
        for (int degrees = 0; degrees <= 360; ++degrees) {
            const double a = degrees * std::numbers::pi / 180;
            const double r =
                3.3 * std::sqrt(ljus::henyey_greenstein(curve.g, std::cos(a)));
            points.push_back({r * std::cos(a), r * std::sin(a)});
        }
        draw_line(drawing, points, {curve.color, 2});
        draw_label(drawing, curve.label, curve.name, curve.color);
    }
    draw_arrow(drawing, {-2.5, 0}, {-0.1, 0}, {colors::violet, 2.5});
    draw_dot(drawing, {0, 0}, 4, colors::violet);
    save_drawing(folder, drawing);
}

/// Points of a ray at equal angles from a lamp.
void draw_angles(const std::string& folder) {
    Drawing drawing{.name = "fog-angles",
                    .description = "Points of a ray that a lamp sees at equal angles: "
                                   "close together where the ray passes the lamp",
                    .low{-0.4, -0.7},
                    .high{7.4, 1.7},
                    .scale = 85};
    const Point lamp{2.5, 1.2};
    const ljus::RayT<double> ray{.direction{1, 0, 0}};
    const auto angles = ljus::equi_angular(ray, ljus::SpanT<double>{0, 7},
                                           ljus::Vec3T<double>{lamp.x, lamp.y, 0});
    for (int i = 0; i <= 12; ++i) {
        const Point at{ljus::sample_equi_angular(angles, i / 12.0), 0};
        draw_line(drawing, {lamp, at}, {colors::orange, 1, true});
        draw_dot(drawing, at, 4, colors::red);
    }
    draw_arrow(drawing, {0, 0}, {7.3, 0}, {.width = 2.5});
    draw_line(drawing, {lamp, {lamp.x, 0}}, {colors::blue, 2});
    draw_dot(drawing, lamp, 8, colors::orange);
    draw_label(drawing, {lamp.x + 0.18, 0.45}, "D", colors::blue);
    draw_label(drawing, {lamp.x, -0.4}, "t = δ", colors::blue);
    draw_label(drawing, {0, -0.4}, "a");
    draw_label(drawing, {7, -0.4}, "b");
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 41, fog: drawings.");
        const examples::Options options = line.parse({});
        draw_losses(options.path(""));
        draw_phase(options.path(""));
        draw_angles(options.path(""));
    });
}
