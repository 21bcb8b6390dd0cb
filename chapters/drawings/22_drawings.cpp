// smoke: --quality draft
/// \file chapters/drawings/22_drawings.cpp
/// \brief Chapter 22: photons on their ways, and the cones of aimed ones.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/math/random.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// Photons of equal flux: some are absorbed where they land, some go on with all they
/// have.
void draw_ways(const std::string& folder) {
    Drawing drawing{.name = "emission-ways",
                    .description = "Photons leave a lamp. At each surface roulette "
                                   "decides whether a photon ends or goes on; each "
                                   "landing is stored",
                    .low{-0.3, -0.45},
                    .high{6.3, 3.35},
                    .scale = 100};
    const double w = 6, h = 3;
    draw_line(drawing, {{0, h}, {0, 0}, {w, 0}, {w, h}, {0, h}}, {.width = 2});
    draw_line(drawing, {{2.5, h}, {3.5, h}}, {colors::orange, 7});
    auto stream = ljus::random_stream(12, ljus::Pass::user, 0, 0);
    for (int i = 0; i < 4; ++i) {
        Point at{2.5 + (i + 0.5) / 4, h};
        Point n{0, -1};
        for (int bounce = 0; bounce < 4; ++bounce) {
            // In two dimensions a diffuse surface spreads sin(theta) evenly.
            const double s = 2 * double(next_1d(stream)) - 1, c = std::sqrt(1 - s * s);
            const Point d{c * n.x - s * n.y, c * n.y + s * n.x};
            // Which wall comes first?
            const double tx = d.x > 0 ? (w - at.x) / d.x : d.x < 0 ? -at.x / d.x : 1e9;
            const double ty = d.y > 0 ? (h - at.y) / d.y : d.y < 0 ? -at.y / d.y : 1e9;
            const bool side = tx < ty;
            const double t = side ? tx : ty;
            const Point next{at.x + t * d.x, at.y + t * d.y};
            draw_arrow(drawing, at, next,
                       {bounce == 0 ? colors::orange : colors::blue, 1.3});
            const bool goes_on = next_1d(stream) < 0.5f;
            draw_dot(drawing, next, goes_on ? 4 : 6,
                     goes_on ? "currentColor" : colors::red);
            if (!goes_on) break;
            at = next;
            n = side ? Point{d.x > 0 ? -1.0 : 1.0, 0} : Point{0, d.y > 0 ? -1.0 : 1.0};
        }
    }
    draw_dot(drawing, {1.9, -0.28}, 6, colors::red);
    draw_label(drawing, {2.45, -0.28}, "absorbed", colors::red);
    draw_dot(drawing, {3.5, -0.28}, 4, "currentColor");
    draw_label(drawing, {4.0, -0.28}, "reflected");
    save_drawing(folder, drawing);
}

/// Aiming: the cones in which two balls are seen from a lamp, and where they overlap.
void draw_cones(const std::string& folder) {
    Drawing drawing{.name = "emission-cones",
                    .description =
                        "Two balls of glass as seen from a point of the lamp: "
                        "photons are aimed into the cones around them",
                    .low{-0.3, -0.3},
                    .high{6.3, 3.4},
                    .scale = 100};
    const Point lamp{2.6, 3.2};
    const struct {
        Point center;
        double radius;
    } balls[] = {{{1.5, 0.9}, 0.62}, {{4.2, 1.2}, 0.5}};
    draw_line(drawing, {{0, 0}, {6, 0}}, {.width = 2});
    for (const auto& ball : balls) {
        const Point to{ball.center.x - lamp.x, ball.center.y - lamp.y};
        const double distance = std::hypot(to.x, to.y), around = std::atan2(to.y, to.x);
        const double half = std::asin(ball.radius / distance);
        const double rim = std::sqrt(distance * distance - ball.radius * ball.radius);
        const auto end = [&](double angle, double length) {
            return Point{lamp.x + length * std::cos(angle),
                         lamp.y + length * std::sin(angle)};
        };
        draw_area(drawing, {lamp, end(around - half, rim), end(around + half, rim)},
                  colors::orange);
        for (const double side : {-1.0, 1.0})
            draw_line(drawing, {lamp, end(around + side * half, rim)},
                      {.color = colors::orange, .width = 1.2});
        draw_arc(drawing, lamp, 0.8, around - half, around + half);
        draw_area(drawing, examples::circle(ball.center, ball.radius), colors::blue);
        draw_line(drawing, examples::circle(ball.center, ball.radius));
        for (int i = -2; i <= 2; ++i) {
            const double angle = around + half * i / 2.4;
            const double along = std::cos(angle - around) * distance;
            const double off = std::sin(angle - around) * distance;
            draw_arrow(
                drawing, lamp,
                end(angle, along - std::sqrt(ball.radius * ball.radius - off * off)),
                {colors::red, 1});
        }
    }
    draw_dot(drawing, lamp, 6, colors::orange);
    draw_label(drawing, {1.75, 2.55}, "Ω_1", colors::orange);
    draw_label(drawing, {3.5, 2.75}, "Ω_2", colors::orange);
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 22, photons: drawings.");
        const examples::Options options = line.parse({});
        draw_ways(options.path(""));
        draw_cones(options.path(""));
    });
}
