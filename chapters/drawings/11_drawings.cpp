// smoke: --quality draft
/// \file chapters/drawings/11_drawings.cpp
/// \brief Chapter 11: the parts of the incoming and of the refracted direction.

#include <cmath>
#include <numbers>
#include <string>

#include <ljus/optics/refraction.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::flat;
using examples::Point;
using Vec = ljus::Vec3T<double>;
namespace colors = examples::colors;

/// D and T as radii of a circle, each with its part along the surface and its part along
/// the normal.
void draw_parts(const std::string& folder) {
    Drawing drawing{.name = "refraction-parts",
                    .description =
                        "The incoming direction D and the refracted one T in "
                        "a circle of radius 1. The part of T along the "
                        "surface is eta times that of D",
                    .low{-2.4, -1.3},
                    .high{2.4, 1.5},
                    .scale = 150};
    const double eta = 1 / 1.5, angle = 50 * std::numbers::pi / 180;
    const Vec d{std::sin(angle), -std::cos(angle), 0}, n{0, 1, 0};
    const Vec t = ljus::refract(d, n, eta).value();
    draw_area(drawing, {{-2.4, 0}, {2.4, 0}, {2.4, -1.3}, {-2.4, -1.3}}, colors::blue);
    draw_line(drawing, {{-2.4, 0}, {2.4, 0}}, {.width = 2});
    draw_line(drawing, examples::circle({0, 0}, 1),
              {.color = "#80808090", .dashed = true});
    draw_arrow(drawing, {0, 0}, {0, 1.3}, {.width = 1.5});
    draw_label(drawing, {0.13, 1.33}, "N");

    // D, and its parts: along the surface, and along the normal.
    const Point from = flat(-d), above{0, from.y};
    draw_arrow(drawing, from, {0, 0}, {colors::blue, 2.5});
    draw_arrow(drawing, from, above, {colors::green, 2.5});
    draw_arrow(drawing, above, {0, 0}, {colors::red, 2});
    draw_label(drawing, {from.x / 2 - 0.12, from.y / 2 - 0.12}, "D", colors::blue);
    draw_label(drawing, {from.x / 2, from.y + 0.13}, "P", colors::green);
    draw_label(drawing, {0.24, from.y / 2}, "cos θ_1", colors::red);

    const Point to = flat(t), below{0, to.y};
    draw_arrow(drawing, {0, 0}, to, {colors::orange, 2.5});
    draw_arrow(drawing, below, to, {colors::green, 2.5});
    draw_arrow(drawing, {0, 0}, below, {colors::red, 2});
    draw_label(drawing, {to.x / 2 + 0.14, to.y / 2}, "T", colors::orange);
    draw_label(drawing, {to.x + 0.2, to.y - 0.02}, "η P", colors::green);
    draw_label(drawing, {-0.26, to.y / 2}, "cos θ_2", colors::red);

    const double up = std::numbers::pi / 2, out = std::asin(eta * std::sin(angle));
    draw_arc(drawing, {0, 0}, 0.32, up, up + angle);
    draw_label(drawing, {-0.2, 0.42}, "θ_1");
    draw_arc(drawing, {0, 0}, 0.42, -up, -up + out);
    draw_label(drawing, {0.13, -0.52}, "θ_2");
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawing.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 11, refraction: a drawing.");
        const examples::Options options = line.parse({});
        draw_parts(options.path(""));
    });
}
