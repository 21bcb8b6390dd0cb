// smoke: --quality draft
/// \file chapters/drawings/13_drawings.cpp
/// \brief Chapter 13: from the disc up to the hemisphere, and cells of equal angles.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/math/sampling.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
using ljus::Vec3;
namespace colors = examples::colors;

/// A view from above at 25 degrees: x to the right, z up.
Point seen(const Vec3& p, double x) {
    const double tilt = 25 * std::numbers::pi / 180;
    return {x + double(p.x),
            double(p.z) * std::cos(tilt) + double(p.y) * std::sin(tilt)};
}

std::vector<Point> rim(double height, double radius, double x) {
    std::vector<Point> points;
    for (int i = 0; i <= 72; ++i) {
        const double a = 2 * std::numbers::pi * i / 72;
        points.push_back(seen(
            {float(radius * std::cos(a)), float(radius * std::sin(a)), float(height)},
            x));
    }
    return points;
}

void draw_dome(Drawing& drawing, double x) {
    draw_line(drawing, rim(0, 1, x), {.width = 1});
    std::vector<Point> dome;
    for (int i = 0; i <= 36; ++i) {
        const double a = std::numbers::pi * i / 36;
        dome.push_back({x + std::cos(a), std::sin(a)});
    }
    draw_line(drawing, dome, {.width = 1});
}

/// Malley's method: points spread evenly over the disc, lifted to the hemisphere.
void draw_lift(const std::string& folder) {
    Drawing drawing{.name = "hemisphere-lift",
                    .description =
                        "Points on a disc, and the directions straight above "
                        "them on the hemisphere",
                    .low{-1.3, -0.75},
                    .high{1.3, 1.15},
                    .scale = 220};
    draw_area(drawing, rim(0, 1, 0), colors::blue);
    draw_dome(drawing, 0);
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 2; ++j) {
            const ljus::Vec2 u{(float(i) + 0.5f) / 9, (float(j) + 0.5f) / 2};
            const Vec3 d = ljus::sample_cosine_hemisphere(u);
            const Point below = seen({d.x, d.y, 0}, 0), above = seen(d, 0);
            draw_line(drawing, {below, above},
                      {.color = "#80808090", .width = 1, .dashed = true});
            draw_dot(drawing, below, 3, colors::blue);
            draw_dot(drawing, above, 4, colors::orange);
        }
    draw_arrow(drawing, seen({0, 0, 0}, 0), seen({0, 0, 1.12f}, 0), {.width = 1.5});
    save_drawing(folder, drawing);
}

/// Cells that the naive rule makes equally likely: those at the pole are small.
void draw_cells(const std::string& folder) {
    Drawing drawing{.name = "hemisphere-cells",
                    .description =
                        "Left cells of equal angles on the hemisphere, which "
                        "are narrow at the pole; right cells of equal solid "
                        "angle",
                    .low{-1.2, -0.7},
                    .high{3.8, 1.1},
                    .scale = 150};
    for (const bool equal_angles : {true, false}) {
        const double x = equal_angles ? 0 : 2.6;
        draw_dome(drawing, x);
        const int rings = 6, sectors = 12;
        const auto inclination = [&](int ring) {
            const double share = double(ring) / rings;
            return equal_angles ? share * std::numbers::pi / 2 : std::acos(1 - share);
        };
        for (int ring = 1; ring < rings; ++ring)
            draw_line(drawing,
                      rim(std::cos(inclination(ring)), std::sin(inclination(ring)), x),
                      {.color = colors::blue, .width = 1});
        for (int sector = 0; sector < sectors; ++sector) {
            const double azimuth = 2 * std::numbers::pi * sector / sectors;
            std::vector<Point> line;
            for (int i = 0; i <= 24; ++i) {
                const double t = std::numbers::pi / 2 * i / 24;
                line.push_back(
                    seen({float(std::sin(t) * std::cos(azimuth)),
                          float(std::sin(t) * std::sin(azimuth)), float(std::cos(t))},
                         x));
            }
            draw_line(drawing, line, {.color = colors::blue, .width = 1});
        }
        draw_label(drawing, {x, -0.58},
                   equal_angles ? "equal angles" : "equal solid angles");
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 13, directions: drawings.");
        const examples::Options options = line.parse({});
        draw_lift(options.path(""));
        draw_cells(options.path(""));
    });
}
