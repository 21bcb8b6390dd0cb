// smoke: --quality draft
/// \file chapters/drawings/14_drawings.cpp
/// \brief Chapter 14: the valleys of a rough surface, the angles of the formula, and
/// how bright rough surfaces are from each side.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/materials/eon.hpp>
#include <ljus/materials/lambertian.hpp>
#include <ljus/materials/oren_nayar.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"
#include "drawings/lobes.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// V-shaped valleys: lit facets, facets in the shade, and what one sees of them from
/// the lamp's side and from the other side.
void draw_valleys(const std::string& folder) {
    Drawing drawing{.name = "oren_nayar-valleys",
                    .description =
                        "Valleys between facets under slanting light. One eye "
                        "is on the lamp's side and sees the bright facets, "
                        "the other one sees the dark ones",
                    .low{-0.6, -0.9},
                    .high{8.6, 3.0},
                    .scale = 85};
    const double width = 1.15, depth = 0.6;
    std::vector<Point> ground{{0, -0.8}};
    for (int i = 0; i < 7; ++i) {
        const double x = width * i;
        const Point left{x, 0}, bottom{x + width / 2, -depth}, right{x + width, 0};
        // The light comes from the left at 45 degrees, and meets facets that rise to the
        // right.
        draw_line(drawing, {left, bottom}, {.color = "#808080", .width = 5});
        draw_line(drawing, {bottom, right}, {.color = colors::orange, .width = 5});
        ground.insert(ground.end(), {left, bottom});
    }
    ground.insert(ground.end(), {{7 * width, 0}, {7 * width, -0.8}});
    draw_area(drawing, ground, "currentColor");
    for (const double x : {1.6, 2.75, 3.9})
        draw_arrow(drawing, {x - 1.7, 1.6}, {x - 0.25, 0.15}, {colors::orange, 2});
    for (const bool same_side : {true, false}) {
        const double sign = same_side ? -1 : 1;
        const Point from{same_side ? 4.6 : 5.9, 0.15};
        const Point eye{from.x + sign * 1.5, 2.15};
        draw_arrow(drawing, from, eye, {colors::blue, 2});
        draw_line(drawing, examples::circle({eye.x + sign * 0.1, eye.y + 0.14}, 0.13),
                  {.color = colors::blue, .width = 2});
        draw_label(drawing, {eye.x + sign * 0.1, eye.y + 0.55},
                   same_side ? "sees bright facets" : "sees dark facets", colors::blue);
    }
    draw_label(drawing, {0.2, 1.85}, "light", colors::orange);
    save_drawing(folder, drawing);
}

/// The four angles of the model, seen from above and from the side.
void draw_angles(const std::string& folder) {
    Drawing drawing{.name = "oren_nayar-angles",
                    .description = "The inclinations of both directions from the "
                                   "normal, and the azimuth between them",
                    .low{-2.1, -0.45},
                    .high{6.4, 2.3},
                    .scale = 90};
    const double pi = std::numbers::pi, inward = 50 * pi / 180, outward = 30 * pi / 180;
    const auto up = [](double angle, double length) {
        return Point{length * std::sin(angle), length * std::cos(angle)};
    };
    draw_line(drawing, {{-2, 0}, {2, 0}});
    draw_arrow(drawing, {0, 0}, {0, 2.0}, {.width = 1.5});
    draw_arrow(drawing, {0, 0}, up(-inward, 1.9), {colors::orange, 2.5});
    draw_arrow(drawing, {0, 0}, up(outward, 1.9), {colors::blue, 2.5});
    draw_arc(drawing, {0, 0}, 0.7, pi / 2, pi / 2 + inward);
    draw_arc(drawing, {0, 0}, 0.95, pi / 2 - outward, pi / 2);
    draw_label(drawing, {-0.36, 0.87}, "α");
    draw_label(drawing, {0.3, 1.13}, "β");
    draw_label(drawing, up(-inward - 0.12, 1.75), "ω_i", colors::orange);
    draw_label(drawing, up(outward + 0.14, 1.8), "ω_o", colors::blue);
    draw_label(drawing, {0.18, 2.05}, "n");
    draw_label(drawing, {0, -0.28}, "from the side");
    const Point center{4.4, 0.95};
    const auto round = [&](double angle, double length) {
        return Point{center.x + length * std::cos(angle),
                     center.y + length * std::sin(angle)};
    };
    draw_line(drawing, examples::circle(center, 1.05), {.width = 1, .dashed = true});
    draw_arrow(drawing, center, round(2.7, 1.05 * std::sin(inward)),
               {colors::orange, 2.5});
    draw_arrow(drawing, center, round(0.75, 1.05 * std::sin(outward)),
               {colors::blue, 2.5});
    draw_arc(drawing, center, 0.36, 0.75, 2.7);
    draw_dot(drawing, center, 4, "currentColor");
    draw_label(drawing, {4.35, 1.6}, "φ_i − φ_o");
    draw_label(drawing, {4.4, -0.28}, "from above");
    save_drawing(folder, drawing);
}

/// Where two rough surfaces send the light that comes from one side.
void draw_lobes(const std::string& folder) {
    using namespace examples;
    Drawing figure{.name = "oren_nayar-lobes",
                   .description = "Light comes from the upper left. Lambert's surface "
                                  "is equally bright from all sides, rough ones are "
                                  "brightest seen from where the light comes from",
                   .low = {-2.1, -0.15},
                   .high = {2.1, 1.75},
                   .scale = 110};
    const auto add = [&](const auto& material, const Pen& pen) {
        const std::vector<Point> points = lobe(material, -60);
        draw_area(figure, points, pen.color);
        draw_line(figure, points, pen);
    };
    const ljus::RgbT<double> white{1};
    add(ljus::LambertianT<double>{white}, {"currentColor", 1.5, true});
    add(ljus::OrenNayarT<double>{white, 0.7}, {colors::green, 2.5});
    add(ljus::EonT<double>{white, 0.7}, {colors::red, 2.5});
    draw_line(figure, {{-2.1, 0}, {2.1, 0}});
    const ljus::Vec3T<double> light = tilted(-60);
    draw_arrow(figure, {1.9 * light.x, 1.9 * light.z}, {0.1 * light.x, 0.1 * light.z},
               {colors::blue, 2.5});
    draw_label(figure, {0.4, 1.2}, "EON", colors::red);
    draw_label(figure, {1.25, 0.5}, "Lambert");
    draw_label(figure, {-0.35, 0.55}, "1994", colors::green);
    save_drawing(folder, figure);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 14, rough surfaces: drawings.");
        const examples::Options options = line.parse({});
        draw_valleys(options.path(""));
        draw_angles(options.path(""));
        draw_lobes(options.path(""));
    });
}
