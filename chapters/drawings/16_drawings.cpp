// smoke: --quality draft
/// \file chapters/drawings/16_drawings.cpp
/// \brief Chapter 16: the half vector of a facet, and lobes of gloss.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/materials/glossy.hpp>
#include <ljus/math/random.hpp>
#include <ljus/optics/microfacet.hpp>
#include <ljus/optics/reflection.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"
#include "drawings/lobes.hpp"

namespace {

using examples::Drawing;
using examples::Point;
using ljus::Vec3;
namespace colors = examples::colors;

Point flat(const Vec3& v) {
    return {double(v.x), double(v.z)};
}
Point times(double s, const Point& p) {
    return {s * p.x, s * p.y};
}

/// A facet that mirrors wi into wo stands upright on the half vector.
void draw_half_vector(const std::string& folder) {
    Drawing drawing{.name = "glossy-half-vector",
                    .description = "A rough surface of small mirrors; one of them "
                                   "reflects w_i into w_o, and its normal is the half "
                                   "vector of both",
                    .low{-2.6, -0.75},
                    .high{2.9, 2.3},
                    .scale = 115};
    auto stream = ljus::random_stream(3, ljus::Pass::user, 0, 0);
    std::vector<Point> ground{{-2.6, -0.7}};
    const Vec3 wo = glm::normalize(Vec3{0.75f, 0, 0.8f});
    const Vec3 h = glm::normalize(Vec3{-0.22f, 0, 1});
    const Vec3 wi = ljus::reflect(-wo, h);
    // The facet in the middle is upright on h; the others are random.
    const Point facet{double(h.z), -double(h.x)};
    for (double x = -2.6; x < -0.35; x += 0.45)
        ground.push_back({x, -0.2 + 0.26 * double(next_1d(stream))});
    ground.push_back(times(-0.32, facet));
    ground.push_back(times(0.32, facet));
    for (double x = 0.7; x < 3; x += 0.45)
        ground.push_back({x, -0.2 + 0.26 * double(next_1d(stream))});
    std::vector<Point> line(ground.begin() + 1, ground.end());
    ground.push_back({2.9, -0.7});
    draw_area(drawing, ground, "currentColor");
    draw_line(drawing, line, {.width = 1.5});
    draw_line(drawing, {times(-0.32, facet), times(0.32, facet)}, {colors::red, 4});
    draw_arrow(drawing, {0, 0}, {0, 2.05}, {.width = 1.2});
    draw_arrow(drawing, {0, 0}, times(2, flat(h)), {colors::red, 2.5});
    draw_arrow(drawing, {0, 0}, times(2, flat(wi)), {colors::orange, 2.5});
    draw_arrow(drawing, {0, 0}, times(2, flat(wo)), {colors::blue, 2.5});
    const double up = std::atan2(double(h.z), double(h.x));
    draw_arc(drawing, {0, 0}, 0.8, std::atan2(double(wo.z), double(wo.x)), up);
    draw_arc(drawing, {0, 0}, 0.9, up, std::atan2(double(wi.z), double(wi.x)));
    draw_label(drawing, {0.15, 2.1}, "n");
    draw_label(drawing, {times(2, flat(h)).x - 0.18, 2.1}, "h", colors::red);
    draw_label(drawing, {times(2, flat(wi)).x - 0.2, times(2, flat(wi)).y + 0.12},
               "ω_i", colors::orange);
    draw_label(drawing, {times(2, flat(wo)).x + 0.25, times(2, flat(wo)).y}, "ω_o",
               colors::blue);
    save_drawing(folder, drawing);
}

/// How many facets have a given slope: the distribution of the library for some
/// roughnesses, over the angle from the normal.
void draw_distribution(const std::string& folder) {
    Drawing drawing{.name = "glossy-facets",
                    .description = "The share of facets by their direction, drawn "
                                   "around the normal, for three roughnesses",
                    .low{-2.3, -0.35},
                    .high{2.3, 2.15},
                    .scale = 130};
    draw_line(drawing, {{-2.2, 0}, {2.2, 0}});
    const struct {
        double alpha;
        const char* color;
    } curves[] = {{0.25, colors::red}, {0.5, colors::orange}, {1.0, colors::blue}};
    for (const auto& curve : curves) {
        const auto share = [&](double a) {
            return ljus::ggx_distribution(
                curve.alpha, ljus::Vec3T<double>{std::sin(a), 0, std::cos(a)});
        };
        std::vector<Point> points;
        for (int i = -90; i <= 90; ++i) {
            const double a = i * std::numbers::pi / 180;
            const double length = 1.9 * share(a) / share(0);
            points.push_back({length * std::sin(a), length * std::cos(a)});
        }
        draw_area(drawing, points, curve.color);
        draw_line(drawing, points, {curve.color, 2});
    }
    draw_arrow(drawing, {0, 0}, {0, 2.1}, {.width = 1.2});
    draw_label(drawing, {0.42, 1.95}, "α = 0.25", colors::red);
    draw_label(drawing, {0.56, 1.2}, "0.5", colors::orange);
    draw_label(drawing, {1.15, 0.8}, "1", colors::blue);
    save_drawing(folder, drawing);
}

/// Where gloss of three roughnesses sends the light that comes from one side.
void draw_lobes(const std::string& folder) {
    using namespace examples;
    Drawing figure{.name = "glossy-lobes",
                   .description = "Light comes from the upper left. The rougher the "
                                  "gloss, the wider the lobe on the other side",
                   .low = {-3.2, -0.15},
                   .high = {4.6, 3.2},
                   .scale = 65};
    const char* inks[] = {colors::red, colors::green, colors::violet};
    const double roughnesses[] = {0.6, 0.7, 1};
    for (std::size_t i = 0; i < 3; ++i) {
        const ljus::GlossyT<double> gloss{ljus::RgbT<double>{1}, roughnesses[i]};
        const std::vector<Point> points = lobe(gloss, -45);
        draw_area(figure, points, inks[i]);
        draw_line(figure, points, {inks[i], 2.5});
        const Point& label = points[130];
        draw_label(figure, {label.x + 0.3, label.y + 0.2},
                   (i == 0 ? "roughness " : "") + text(roughnesses[i], "%.1f"),
                   inks[i]);
    }
    draw_line(figure, {{-3.2, 0}, {4.6, 0}});
    draw_arc(figure, {0, 0}, 1, 0, std::numbers::pi, {"currentColor", 1.5, true});
    const ljus::Vec3T<double> light = tilted(-45);
    draw_arrow(figure, {4 * light.x, 4 * light.z}, {0.1 * light.x, 0.1 * light.z},
               {colors::blue, 2.5});
    save_drawing(folder, figure);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 16, gloss: drawings.");
        const examples::Options options = line.parse({});
        draw_half_vector(options.path(""));
        draw_distribution(options.path(""));
        draw_lobes(options.path(""));
    });
}
