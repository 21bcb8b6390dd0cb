// smoke: --quality draft
/// \file chapters/drawings/48_drawings.cpp
/// \brief Chapter 48: Newton's method finds the way through water, and a ball has three.

#include <cmath>
#include <numbers>
#include <string>

#include <ljus/optics/refraction.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
using Vec3 = ljus::Vec3T<double>;
namespace colors = examples::colors;

Point flat(const Vec3& v) {
    return {v.x, v.y};
}

/// From a point below water to a lamp: the straight line, and the solution.
void draw_water(Drawing& drawing) {
    constexpr double index = 1.33, left = -4.4, surface = 2;
    const Point x{left, 0.1}, lamp{left + 2.4, 3.2};
    draw_area(drawing,
              {{left - 0.5, 0},
               {left - 0.5, surface},
               {left + 2.6, surface},
               {left + 2.6, 0}},
              colors::blue);
    draw_line(drawing, {{left - 0.5, 0}, {left + 2.6, 0}}, {.width = 2});
    const auto sine = [](double aside, double up) {
        return aside / std::hypot(aside, up);
    };
    const auto snell = [&](double s) { // 0 where Snell's law holds
        return index * sine(s - x.x, surface - x.y) -
               sine(lamp.x - s, lamp.y - surface);
    };
    double s = x.x + (lamp.x - x.x) * (surface - x.y) / (lamp.y - x.y);
    draw_line(drawing, {x, {s, surface}, lamp}, {.width = 1.5, .dashed = true});
    for (int step = 0; step < 5; ++step)
        s -= snell(s) * 2e-5 / (snell(s + 1e-5) - snell(s - 1e-5));
    draw_line(drawing, {x, {s, surface}, lamp}, {colors::orange, 2.5});
    draw_dot(drawing, x, 5, colors::blue);
    draw_dot(drawing, lamp, 7, colors::orange);
}

/// The ray that leaves a point of the floor at an angle, through a ball of glass.
struct Way {
    Vec3 in, out, direction;
};
Way through(const Vec3& x, const Vec3& center, double angle) {
    constexpr double index = 1.5;
    Vec3 way{std::cos(angle), std::sin(angle), 0};
    const double b = glm::dot(center - x, way);
    const double c = glm::dot(center - x, center - x) - 1;
    const Vec3 in = x + (b - std::sqrt(b * b - c)) * way;
    way = *ljus::refract(way, in - center, 1 / index);
    const Vec3 out = in - 2 * glm::dot(in - center, way) * way;
    return {in, out, *ljus::refract(way, center - out, index)};
}

/// All ways from a point of the floor through a ball to a lamp.
void draw_ball(Drawing& drawing) {
    const Vec3 center{0, 1.9, 0}, x{0.06, 0.1, 0}, lamp{0, 4.6, 0};
    draw_line(drawing, {{-1.4, 0}, {1.4, 0}}, {.width = 2});
    draw_area(drawing, examples::circle(flat(center), 1), colors::blue);
    const auto beside = [&](double angle) { // 0 where the ray meets the lamp
        const Way way = through(x, center, angle);
        const Vec3 rest = lamp - way.out;
        return way.direction.x * rest.y - way.direction.y * rest.x;
    };
    const double middle = std::atan2(center.y - x.y, center.x - x.x);
    const double half = std::asin(1 / glm::length(center - x)) - 1e-6;
    constexpr int cells = 1000;
    for (int i = 0; i < cells; ++i) {
        double low = middle - half + 2 * half * i / cells,
               high = low + 2 * half / cells;
        if (beside(low) * beside(high) > 0) continue;
        for (int k = 0; k < 40; ++k) {
            const double half_way = (low + high) / 2;
            (beside(low) * beside(half_way) > 0 ? low : high) = half_way;
        }
        const Way way = through(x, center, low);
        draw_line(drawing, {flat(x), flat(way.in), flat(way.out), flat(lamp)},
                  {colors::orange, 2.5});
    }
    draw_dot(drawing, flat(x), 5, colors::blue);
    draw_dot(drawing, flat(lamp), 7, colors::orange);
}

} // namespace

/// Makes the chapter's drawing.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 48, photon maps today: the ways of light through water and "
                   "glass.");
        const examples::Options options = line.parse({});
        Drawing drawing{.name = "today-manifold",
                        .description =
                            "Left, a point under water and a lamp: the straight line, "
                            "and the line that obeys Snell's law. Right, a ball of "
                            "glass: three lines obey it",
                        .low{-5.1, -0.1},
                        .high{1.6, 4.8},
                        .scale = 75};
        draw_water(drawing);
        draw_ball(drawing);
        save_drawing(options.path(""), drawing);
    });
}
