// smoke: --quality draft
/// \file chapters/drawings/04_drawings.cpp
/// \brief Chapter 4: the geometry of equation (1), and a path with what it multiplies.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/optics/reflection.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Pen;
using examples::Point;
namespace colors = examples::colors;

/// A point at a distance from x, in a direction at an angle from its normal, which
/// points up: positive angles to the right.
Point towards(const Point& x, double degrees, double distance) {
    const double angle = degrees * std::numbers::pi / 180;
    return {x.x + distance * std::sin(angle), x.y + distance * std::cos(angle)};
}

/// Equation (1): two points that see each other, and the angles at both.
void draw_equation(const std::string& folder) {
    Drawing drawing{.name = "transport-geometry",
                    .description = "A surface point x′, the hemisphere above it, light "
                                   "that arrives along w_i from a small part dx″ of "
                                   "another surface, and light that leaves along w_o",
                    .low{-3.0, -0.45},
                    .high{3.6, 2.75},
                    .scale = 105};
    const Point x{0, 0}, y = towards(x, 48, 2.9);
    const double half_pi = std::numbers::pi / 2;
    draw_area(drawing, {{-3, 0}, {3.6, 0}, {3.6, -0.45}, {-3, -0.45}}, "currentColor");
    draw_line(drawing, {{-3, 0}, {3.6, 0}});
    draw_arc(drawing, x, 1.5, 0, 2 * half_pi, {.color = "#80808090", .dashed = true});
    // The lamp's piece dA, turned by 25 degrees from facing x.
    const double turn = (48 - 25) * std::numbers::pi / 180;
    const Point along{std::cos(turn), -std::sin(turn)};
    const Point a{y.x - 0.34 * along.x, y.y - 0.34 * along.y};
    const Point b{y.x + 0.34 * along.x, y.y + 0.34 * along.y};
    draw_area(drawing, {x, a, b}, colors::orange);
    draw_line(drawing, {x, a}, {.color = colors::orange, .width = 0.8});
    draw_line(drawing, {x, b}, {.color = colors::orange, .width = 0.8});
    draw_line(drawing, {a, b}, {.color = colors::orange, .width = 5});
    draw_arrow(drawing, y, {y.x + 0.8 * along.y, y.y - 0.8 * along.x});
    draw_arrow(drawing, x, {0, 2.2}, {.width = 2});
    draw_arrow(drawing, x, towards(x, 48, 1.5), {colors::orange, 2.5});
    draw_arrow(drawing, x, towards(x, -35, 2.3), {colors::blue, 2.5});
    draw_arc(drawing, x, 0.7, half_pi - 48 * std::numbers::pi / 180, half_pi);
    const double back = std::atan2(-y.y, -y.x), down = std::atan2(-along.x, along.y);
    draw_arc(drawing, y, 0.5, std::min(back, down), std::max(back, down));
    draw_dot(drawing, x, 4, "currentColor");
    draw_label(drawing, {0.12, -0.22}, "x′");
    draw_label(drawing, {-0.22, 2.2}, "n");
    draw_label(drawing, {0.33, 0.86}, "θ_i");
    draw_label(drawing, towards(x, 62, 1.35), "ω_i", colors::orange);
    draw_label(drawing, towards(x, -43, 2.15), "ω_o", colors::blue);
    draw_label(drawing, {2.7, 2.0}, "dx″", colors::orange);
    draw_label(drawing, {1.63, 1.42}, "θ″");
    draw_label(drawing, {0.9, 1.37}, "dω", colors::orange);
    draw_label(drawing, towards(x, 37.5, 2.35), "r″");
    draw_label(drawing, {-2.1, 0.25}, "hemisphere Ω");
    save_drawing(folder, drawing);
}

/// A path from the lamp over two diffuse surfaces and a mirror to the camera, with the
/// factor of each vertex.
void draw_path(const std::string& folder) {
    Drawing drawing{.name = "transport-path",
                    .description = "A path from a lamp over a wall, the floor and a "
                                   "mirror to the camera, with the factor that each "
                                   "vertex adds",
                    .low{-0.3, -0.35},
                    .high{6.5, 3.2},
                    .scale = 105};
    draw_line(drawing, {{0, 3}, {0, 0}, {6, 0}, {6, 3}});
    const Point lamp{2.2, 3}, wall{0, 1.5}, floor{2.9, 0}, mirror{6, 1.55};
    draw_line(drawing, {{1.7, 3}, {2.7, 3}}, {.color = colors::orange, .width = 6});
    draw_line(drawing, {{6, 0.9}, {6, 2.3}}, {.color = colors::blue, .width = 6});
    // The mirror's direction is the library's.
    const ljus::Vec3T<double> d{mirror.x - floor.x, mirror.y - floor.y, 0};
    const auto r = reflect(d, ljus::Vec3T<double>{-1, 0, 0});
    const double share = (4.3 - mirror.x) / r.x;
    const Point eye{mirror.x + share * r.x, mirror.y + share * r.y};
    draw_arrow(drawing, lamp, wall, {colors::orange, 2.2});
    draw_arrow(drawing, wall, floor, {colors::orange, 2.2});
    draw_arrow(drawing, floor, mirror, {colors::orange, 2.2});
    draw_arrow(drawing, mirror, eye, {colors::orange, 2.2});
    for (const Point& point : {lamp, wall, floor, mirror})
        draw_dot(drawing, point, 4, "currentColor");
    draw_area(drawing, {{eye.x - 0.5, eye.y - 0.18}, {eye.x - 0.5, eye.y + 0.18}, eye},
              "currentColor");
    draw_line(drawing, {{eye.x - 0.5, eye.y - 0.18},
                        {eye.x - 0.5, eye.y + 0.18},
                        eye,
                        {eye.x - 0.5, eye.y - 0.18}});
    draw_label(drawing, {eye.x - 0.28, eye.y + 0.36}, "E");
    draw_label(drawing, {2.2, 2.72}, "L: L_e", colors::orange);
    draw_label(drawing, {0.8, 1.46}, "D: f_1");
    draw_label(drawing, {2.9, -0.2}, "D: f_2");
    draw_label(drawing, {5.1, 1.46}, "S: f_3", colors::blue);
    draw_label(drawing, {1.38, 2.05}, "G_1");
    draw_label(drawing, {1.3, 0.55}, "G_2");
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 4, light transport: drawings.");
        const examples::Options options = line.parse({});
        draw_equation(options.path(""));
        draw_path(options.path(""));
    });
}
