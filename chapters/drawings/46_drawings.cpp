// smoke: --quality draft
/// \file chapters/drawings/46_drawings.cpp
/// \brief Chapter 46: the intensity of a lamp and its photons, and sealed lamps.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// The intensity of a lamp that throws most light aside, at an angle from its pole.
double intensity(double theta) {
    const double down = std::cos(theta);
    return down <= 0 ? 0.0 : (0.6 + 3.4 * std::pow(std::sin(theta), 2)) * down;
}

/// A point at a distance from the lamp, at an angle from straight down.
Point beside(const Point& lamp, double theta, double distance) {
    return {lamp.x + distance * std::sin(theta), lamp.y - distance * std::cos(theta)};
}

/// The angle below which the lamp sends a part of its flux to one side.
double angle_of(double part) {
    constexpr int steps = 4000;
    constexpr double length = std::numbers::pi / 2 / steps;
    double all = 0;
    for (int i = 0; i < steps; ++i)
        all += intensity((i + 0.5) * length) * std::sin((i + 0.5) * length);
    double sum = 0;
    int i = 0;
    for (; i < steps && sum < part * all; ++i)
        sum += intensity((i + 0.5) * length) * std::sin((i + 0.5) * length);
    return i * length;
}

/// The curve of the intensity with its measured angles, and photons of equal flux.
void draw_intensity(const std::string& folder) {
    Drawing drawing{
        .name = "lamps-intensity",
        .description = "Left, the intensity of a lamp as the distance of a curve from "
                       "it, with dots at the measured angles; right, the directions of "
                       "its photons, most of them where the curve is far from the lamp",
        .low{-2.1, -1.95},
        .high{6.4, 0.45},
        .scale = 86};
    const Point lamp{0, 0}, other{4.3, 0};
    constexpr double degree = std::numbers::pi / 180;
    std::vector<Point> curve;
    for (int angle = -90; angle <= 90; ++angle)
        curve.push_back(
            beside(lamp, angle * degree, intensity(std::abs(angle) * degree)));
    draw_area(drawing, curve, colors::orange);
    draw_line(drawing, curve, {colors::orange, 2});
    draw_line(drawing, {lamp, {0, -1.7}}, {.width = 1, .dashed = true});
    for (int angle = -75; angle <= 75; angle += 15)
        draw_dot(drawing,
                 beside(lamp, angle * degree, intensity(std::abs(angle) * degree)), 4,
                 colors::orange);
    const double theta = 45 * degree;
    draw_line(drawing, {lamp, beside(lamp, theta, intensity(theta))},
              {colors::blue, 1.5});
    const double down = -std::numbers::pi / 2;
    draw_arc(drawing, lamp, 0.5, down, down + theta, {colors::blue, 1.5});
    draw_label(drawing, beside(lamp, theta / 2, 0.72), "θ", colors::blue);
    draw_label(drawing, {0.85, -1.45}, "I(θ)", colors::orange);
    draw_dot(drawing, lamp, 6, "currentColor");

    constexpr int photons = 10;
    for (int i = 0; i < photons; ++i)
        for (const double side : {-1.0, 1.0}) {
            const double at = side * angle_of((i + 0.5) / photons);
            draw_arrow(drawing, beside(other, at, 0.12), beside(other, at, 1.6),
                       {colors::blue, 1.5});
        }
    draw_line(drawing, {other, {other.x, -1.7}}, {.width = 1, .dashed = true});
    draw_dot(drawing, other, 6, "currentColor");
    save_drawing(folder, drawing);
}

/// A room with a lamp and an eye, and three boxes with a lamp in each.
void draw_sealed(const std::string& folder) {
    Drawing drawing{
        .name = "lamps-sealed",
        .description =
            "A room with a lamp and an eye, and beside it three closed boxes "
            "with a lamp in each; every lamp sends as many photons, and those "
            "of the boxes stay in them",
        .low{-0.2, -0.2},
        .high{7.6, 2.3},
        .scale = 90};
    const auto box = [&](const Point& low, const Point& high) {
        draw_line(drawing,
                  {low, {high.x, low.y}, high, {low.x, high.y}, low, {high.x, low.y}},
                  {.width = 2});
    };
    // The photons fly to the walls of a box, at even angles.
    const auto photons = [&](const Point& lamp, const Point& low, const Point& high,
                             const char* color) {
        constexpr int count = 8;
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * std::numbers::pi * (i + 0.5) / count;
            const double x = std::cos(angle), y = std::sin(angle);
            const double t = std::fmin(((x > 0 ? high.x : low.x) - lamp.x) / x,
                                       ((y > 0 ? high.y : low.y) - lamp.y) / y);
            draw_arrow(drawing, lamp, {lamp.x + t * x, lamp.y + t * y}, {color, 1.5});
        }
        draw_dot(drawing, lamp, 6, color);
    };
    const Point low{0, 0}, high{3, 2};
    box(low, high);
    photons({1.5, 1.4}, low, high, colors::orange);
    draw_line(drawing, {{0.35, 0.28}, {0.6, 0.4}, {0.35, 0.52}}, {.width = 1.5});
    draw_dot(drawing, {0.52, 0.4}, 3, "currentColor");
    for (int i = 0; i < 3; ++i) {
        const double left = 3.6 + 1.3 * i;
        box({left, 0.5}, {left + 1, 1.5});
        photons({left + 0.5, 1}, {left, 0.5}, {left + 1, 1.5}, colors::blue);
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 46, lamps: drawings.");
        const std::string folder = line.parse({}).path("");
        draw_intensity(folder);
        draw_sealed(folder);
    });
}
