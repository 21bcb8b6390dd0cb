// smoke: --quality draft
/// \file chapters/drawings/26_drawings.cpp
/// \brief Chapter 26: how a ball of glass gathers light.

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <ljus/geometry/sphere.hpp>
#include <ljus/math/frame.hpp>
#include <ljus/optics/refraction.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"
#include "drawings/dimension.hpp"

namespace {

using examples::Drawing;
using examples::flat;
using examples::Point;
using Vec = ljus::Vec3T<double>;
namespace colors = examples::colors;

const ljus::SphereT<double> ball{.center{0, 1.6, 0}, .radius = 1};

/// The way of a ray from above through the ball to the floor.
std::vector<Vec> through_ball(const Vec& start, const Vec& direction) {
    std::vector<Vec> way{start};
    Vec at = start, d = direction;
    double eta = 1 / 1.5;
    for (int surface = 0; surface < 2; ++surface) {
        const auto t = intersect(
            ljus::RayT<double>{.origin = at, .direction = d, .t_min = 1e-6}, ball);
        if (!t) break;
        at = at + *t * d;
        way.push_back(at);
        const Vec n = (surface == 0 ? 1.0 : -1.0) * normal(ball, at);
        const auto frame = ljus::frame_around(n);
        const auto wt = ljus::refract(to_local(frame, -d), eta);
        if (!wt) return way;
        d = to_world(frame, *wt);
        eta = 1.5;
    }
    way.push_back(at - at.y / d.y * d);
    return way;
}

/// Rays of equal flux from a lamp above: where they land, many are close together.
void draw_gathering(const std::string& folder) {
    Drawing drawing{.name = "caustics-rays",
                    .description =
                        "Rays from a small lamp through a ball of glass: "
                        "they land close together on the floor, at the rim of "
                        "the caustic closest of all",
                    .low{-3.2, -0.55},
                    .high{3.2, 5.2},
                    .scale = 85};
    draw_line(drawing, {{-3.2, 0}, {3.2, 0}}, {.width = 2});
    draw_area(drawing, examples::circle({0, 1.6}, 1), colors::blue);
    draw_line(drawing, examples::circle({0, 1.6}, 1));
    const Vec lamp{0, 5, 0};
    for (int i = -32; i <= 32; ++i) {
        const double angle = i * 0.016;
        const auto way = through_ball(lamp, {std::sin(angle), -std::cos(angle), 0});
        std::vector<Point> points;
        for (const Vec& v : way) points.push_back({v.x, v.y});
        if (std::abs(points.back().x) > 3.2) continue;
        const bool bent = way.size() > 2;
        draw_line(drawing, points,
                  {.color = bent ? colors::orange : "#80808060", .width = 0.9});
        draw_dot(drawing, points.back(), 2.5, bent ? colors::red : "#808080");
    }
    draw_dot(drawing, {lamp.x, lamp.y}, 6, colors::orange);
    draw_label(drawing, {0, -0.32}, "caustic", colors::red);
    draw_label(drawing, {1.75, -0.32}, "shadow of the glass");
    save_drawing(folder, drawing);
}

/// The direction from one point to another: radians, counter-clockwise from the right.
double angle_to(const Vec& from, const Vec& to) {
    return std::atan2(to.y - from.y, to.x - from.x);
}

/// An arc with its letter in the middle.
void draw_angle(Drawing& drawing, const Vec& at, double radius, double first,
                double last, const std::string& name, const char* color) {
    draw_arc(drawing, flat(at), radius, first, last, {.color = color, .width = 1.2});
    const double middle = (first + last) / 2, out = radius + 0.17;
    draw_label(drawing, {at.x + out * std::cos(middle), at.y + out * std::sin(middle)},
               name, color);
}

/// One ray with the letters of the chapter.
void draw_one_ray(const std::string& folder) {
    Drawing drawing{.name = "caustics-letters",
                    .description = "A ray from the lamp through the ball to the floor, "
                                   "with the angles alpha at the lamp, theta_i and "
                                   "theta_t at both surfaces, and phi at the centre",
                    .low{-2.6, -0.5},
                    .high{2.9, 4.3},
                    .scale = 130};
    const Vec lamp{0, 4, 0}, &center = ball.center;
    const double alpha = 16 * std::numbers::pi / 180, down = -std::numbers::pi / 2;
    const auto way = through_ball(lamp, {std::sin(alpha), -std::cos(alpha), 0});
    draw_line(drawing, {{-2.6, 0}, {2.9, 0}}, {.width = 2});
    draw_area(drawing, examples::circle(flat(center), ball.radius), colors::blue);
    draw_line(drawing, examples::circle(flat(center), ball.radius));
    const examples::Pen thin{.color = "#808080", .width = 1, .dashed = true};
    draw_line(drawing, {flat(lamp), {0, 0}}, thin);
    for (const Vec& hit : {way[1], way[2]}) // the normals
        draw_line(drawing, {flat(center), flat(hit + 0.75 * (hit - center))}, thin);
    for (std::size_t i = 0; i + 1 < way.size(); ++i)
        draw_arrow(drawing, flat(way[i]), flat(way[i + 1]), {colors::orange, 2});

    draw_angle(drawing, lamp, 0.95, down, down + alpha, "α", colors::orange);
    const double enter = angle_to(center, way[1]), leave = angle_to(center, way[2]);
    draw_angle(drawing, way[1], 0.42, enter, angle_to(way[1], lamp), "θ_i",
               colors::red);
    const double inwards = enter - std::numbers::pi; // the normal, from the other end
    draw_angle(drawing, way[1], 0.5, inwards, angle_to(way[1], way[2]), "θ_t",
               colors::violet);
    draw_angle(drawing, way[2], 0.42, angle_to(way[2], way[3]), leave, "θ_i",
               colors::red);
    draw_angle(drawing, center, 0.17, leave, -down, "φ", colors::green);

    draw_dot(drawing, flat(lamp), 6, colors::orange);
    draw_dot(drawing, flat(center), 4, "currentColor");
    draw_dimension(drawing, {-0.3, center.y}, {-0.3, lamp.y}, "D", "currentColor", 14);
    draw_line(drawing, {flat(center), {-0.94 * ball.radius, center.y - 0.342}});
    draw_label(drawing, {-0.5, center.y - 0.35}, "R");
    draw_dimension(drawing, {0, -0.15}, {way[3].x, -0.15}, "ρ", colors::red, -16);
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 26, caustics: drawings.");
        const examples::Options options = line.parse({});
        draw_gathering(options.path(""));
        draw_one_ray(options.path(""));
    });
}
