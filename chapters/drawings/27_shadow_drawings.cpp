// smoke: --quality draft
/// \file chapters/drawings/27_shadow_drawings.cpp
/// \brief Chapter 27: photons and shadow photons of a lamp over a ball, and discs in
/// the light, in the penumbra and in the shadow.

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <ljus/math/random.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"
#include "experiments/numbers.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A floor with direct and shadow photons below an object, and three verdicts.
void draw_verdicts(const std::string& folder) {
    Drawing drawing{.name = "shadow-verdicts",
                    .description =
                        "A floor with direct and shadow photons. A disc with "
                        "direct ones only is lit, one with shadow photons "
                        "only is in shadow, one with both is unknown",
                    .low{-0.2, -0.75},
                    .high{7.2, 2.7},
                    .scale = 90};
    // The visible fraction of the lamp: from 0 at x = 2.6 to 1 at x = 4.4.
    const auto seen = [](double x) {
        return std::min(1.0, std::max(0.0, (x - 2.6) / 1.8));
    };
    auto stream = ljus::random_stream(7, ljus::Pass::user, 0, 0);
    const Point centers[] = {{1.2, 1.2}, {3.5, 1.2}, {5.8, 1.2}};
    const char* names[] = {"shadow: skip", "unknown: cast rays", "lit: skip"};
    const double radius = 0.75;
    for (int i = 0; i < 260; ++i) {
        const ljus::Vec2 u = next_2d(stream);
        const Point at{7 * double(u.x), 2.5 * double(u.y)};
        const bool direct = double(next_1d(stream)) < seen(at.x);
        draw_dot(drawing, at, 2.8, direct ? colors::blue : colors::orange);
    }
    for (int k = 0; k < 3; ++k) {
        draw_line(drawing, examples::circle(centers[k], radius), {.width = 2});
        draw_label(drawing, {centers[k].x, -0.4}, names[k]);
    }
    save_drawing(folder, drawing);
}

/// Rays from a lamp past a disc to a floor, and the photons that they leave.
void draw_idea(const std::string& folder) {
    Drawing drawing{
        .name = "shadow-idea",
        .description = "A lamp above a floor, a ball between them. Rays of photons end "
                       "on the floor as direct photons; those that meet the ball leave "
                       "a shadow photon on the floor behind it.",
        .low{-3.3, -0.75},
        .high{3.3, 2.5},
        .scale = 100};
    const Point ball{-0.2, 0.9};
    const double radius = 0.55;
    draw_area(drawing, {{-3.2, 0}, {3.2, 0}, {3.2, -0.06}, {-3.2, -0.06}},
              "currentColor");
    draw_line(drawing, {{-3.2, 0}, {3.2, 0}});
    draw_line(drawing, {{-0.4, 2.3}, {0.4, 2.3}}, {.width = 4});
    draw_label(drawing, {0.75, 2.3}, "lamp");
    draw_arc(drawing, ball, radius, 0, 2 * std::numbers::pi);
    examples::Numbers numbers{4};
    for (int i = 0; i < 110; ++i) {
        const Point from{numbers.between(-0.4, 0.4), 2.3};
        const double sine = numbers.between(-1, 1);
        const Point way{sine, -std::sqrt(1 - sine * sine)};
        const Point to{from.x - way.x / way.y * from.y, 0};
        if (std::abs(to.x) > 3.1) continue;
        const double along = (ball.x - from.x) * way.x + (ball.y - from.y) * way.y;
        const double across = std::hypot(ball.x - from.x - along * way.x,
                                         ball.y - from.y - along * way.y);
        const bool hidden = across < radius;
        if (i % 8 == 0) {
            const double end =
                along - std::sqrt(std::max(0.0, radius * radius - across * across));
            const Point stop{from.x + end * way.x, from.y + end * way.y};
            const std::string color = hidden ? colors::orange : colors::blue;
            draw_line(drawing, {from, hidden ? stop : to},
                      {.color = colors::blue, .width = 0.7});
            if (hidden)
                draw_line(drawing, {stop, to},
                          {.color = color, .width = 0.7, .dashed = true});
            if (hidden) draw_dot(drawing, stop, 3.5, colors::blue);
        }
        draw_dot(drawing, to, 3.5, hidden ? colors::orange : colors::blue);
    }
    const std::array circles{std::pair{Point{1.9, 0}, "lit"},
                             std::pair{Point{0.66, 0}, "unknown"},
                             std::pair{Point{-0.45, 0}, "in shadow"}};
    for (const auto& [at, name] : circles) {
        draw_arc(drawing, at, 0.3, 0, 2 * std::numbers::pi,
                 {.color = colors::green, .width = 1.5});
        draw_label(drawing, {at.x, -0.5}, name);
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 27, shadow photons: drawings.");
        const examples::Options options = line.parse({});
        draw_idea(options.path(""));
        draw_verdicts(options.path(""));
    });
}
