// smoke: --quality draft
/// \file chapters/drawings/40_drawings.cpp
/// \brief Chapter 40: the half vector of a facet that refracts, and lobes.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/materials/rough_glass.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
using Vec3 = ljus::Vec3T<double>;
namespace colors = examples::colors;

Point flat(const Vec3& v, double length = 1) {
    return {length * v.x, length * v.z};
}

/// A facet, ω_o above it, ω_i below, and the sum η ω_o + ω_i along its normal.
void draw_half_vector(const std::string& folder) {
    Drawing drawing{.name = "rough_glass-half-vector",
                    .description =
                        "A rough boundary between air and glass; one facet "
                        "refracts ω_i into ω_o, and the sum of both, weighted "
                        "by the indices, lies along its normal h",
                    .low{-2.4, -2.3},
                    .high{2.8, 2.3},
                    .scale = 100};
    const Vec3 h = glm::normalize(Vec3{-0.3, 0, 1});
    const Vec3 wo = glm::normalize(Vec3{0.75, 0, 0.75});
    const Vec3 wi = *ljus::refract(-wo, h, 1 / 1.5);
    const Point facet{h.z, -h.x};
    const std::vector<Point> ground{{-2.4, -0.1},
                                    {-1.8, 0.15},
                                    {-1.2, -0.2},
                                    {-0.6, -0.18},
                                    {0.5 * facet.x, 0.5 * facet.y},
                                    {1.1, -0.1},
                                    {1.7, 0.2},
                                    {2.8, -0.1}};
    std::vector<Point> body = ground;
    body.push_back({2.8, -2.3});
    body.push_back({-2.4, -2.3});
    draw_area(drawing, body, colors::blue);
    draw_line(drawing, ground, {.width = 1.5});
    draw_line(drawing,
              {{-0.5 * facet.x, -0.5 * facet.y}, {0.5 * facet.x, 0.5 * facet.y}},
              {colors::red, 4});
    draw_arrow(drawing, {0, 0}, {0, 2.05}, {.width = 1.2});
    draw_arrow(drawing, {0, 0}, flat(h, 2), {colors::red, 2.5});
    draw_arrow(drawing, {0, 0}, flat(wo, 2), {colors::blue, 2.5});
    draw_arrow(drawing, {0, 0}, flat(wi, 2), {colors::orange, 2.5});
    const Point part = flat(wo, 2 / 1.5), end{part.x + 2 * wi.x, part.y + 2 * wi.z};
    draw_line(drawing, {part, end}, {colors::orange, 1.2, true});
    draw_arrow(drawing, {0, 0}, end, {colors::green, 2});
    draw_label(drawing, {0.15, 2.15}, "n");
    draw_label(drawing, {2 * h.x - 0.2, 2.1}, "h", colors::red);
    draw_label(drawing, {2 * wo.x + 0.3, 2 * wo.z}, "ω_o", colors::blue);
    draw_label(drawing, {2 * wi.x - 0.3, 2 * wi.z}, "ω_i", colors::orange);
    draw_label(drawing, {end.x + 0.75, end.y - 0.1}, "η ω_o + ω_i", colors::green);
    save_drawing(folder, drawing);
}

/// The root of the density of scattered directions, drawn around a point.
void draw_lobes(const std::string& folder) {
    Drawing drawing{.name = "rough_glass-lobes",
                    .description = "Where light goes that arrives at 45 degrees: most "
                                   "through the surface, in a lobe that is wider the "
                                   "rougher the glass is; little back",
                    .low{-2.6, -3.6},
                    .high{2.6, 2.4},
                    .scale = 90};
    draw_area(drawing, {{-2.6, 0}, {2.6, 0}, {2.6, -3.6}, {-2.6, -3.6}}, colors::blue);
    draw_line(drawing, {{-2.6, 0}, {2.6, 0}});
    const Vec3 light{-std::sqrt(0.5), 0, std::sqrt(0.5)};
    const struct {
        double roughness;
        const char* color;
        const char* name;
        Point label;
    } curves[] = {{0.5, colors::red, "roughness 0.5", {1.4, -2.75}},
                  {0.7, colors::orange, "0.7", {1.15, -1.2}},
                  {0.9, colors::green, "0.9", {1.0, -0.5}}};
    for (const auto& curve : curves) {
        const ljus::RoughGlassT<double> glass{.roughness = curve.roughness};
        std::vector<Point> points;
        for (int degrees = 0; degrees <= 360; ++degrees) {
            const double a = degrees * std::numbers::pi / 180;
            const Vec3 w{std::sin(a), 0, std::cos(a)};
            const double r =
                std::abs(w.z) < 1e-9 ? 0 : 0.55 * std::sqrt(pdf(glass, light, w));
            points.push_back({r * w.x, r * w.z});
        }
        draw_line(drawing, points, {curve.color, 2});
        draw_label(drawing, curve.label, curve.name, curve.color);
    }
    draw_arrow(drawing, flat(light, 2.6), flat(light, 0.1), {colors::violet, 2.5});
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 40, rough glass: drawings.");
        const examples::Options options = line.parse({});
        draw_half_vector(options.path(""));
        draw_lobes(options.path(""));
    });
}
