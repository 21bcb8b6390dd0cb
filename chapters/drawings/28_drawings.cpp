// smoke: --quality draft
/// \file chapters/drawings/28_drawings.cpp
/// \brief Chapter 28: the disc of an estimate at the edge of a wall.

#include <algorithm>
#include <string>
#include <vector>

#include <ljus/math/random.hpp>
#include <ljus/photons/detail/kernel_border.hpp>

#include "common/command_line.hpp"
#include "drawings/dimension.hpp"
#include "drawings/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A wall seen from the front, whose lower edge has the height 0 in the drawing, and
/// the discs of three points: far from the edge, near it and at it.
void draw_discs_at_edge(const std::string& folder) {
    Drawing drawing{.name = "final-gathering-disc",
                    .description =
                        "Photons lie on a wall only. The disc of a point far "
                        "from its edge lies on the wall, that of a point at "
                        "the edge only with its upper half",
                    .low{-0.2, -1.75},
                    .high{8.2, 2.75},
                    .scale = 85};
    const double wide = 8, high = 2.7;
    draw_area(drawing, {{0, 0}, {wide, 0}, {wide, high}, {0, high}}, colors::blue);
    draw_line(drawing, {{0, 0}, {wide, 0}}, {.width = 3});
    auto stream = ljus::random_stream(28, ljus::Pass::user, 0, 0);
    for (int i = 0; i < 260; ++i) {
        const auto u = ljus::next_2d<double>(stream);
        draw_dot(drawing, {wide * u.x, high * u.y}, 1.8, colors::blue);
    }

    const double radius = 1.1;
    const struct { double x, s; } places[] = {{1.4, 1.0}, {4.1, 0.4}, {6.8, 0.0}};
    for (const auto& [x, s] : places) {
        const Point middle{x, s * radius};
        draw_line(drawing, examples::circle(middle, radius),
                  {.color = colors::orange, .width = 2});
        // The part of the disc that lies beyond the edge.
        std::vector<Point> beyond;
        for (const Point& point : examples::circle(middle, radius))
            beyond.push_back({point.x, std::min(point.y, 0.0)});
        draw_area(drawing, beyond, colors::red);
        draw_dot(drawing, middle, 5, "currentColor");
        draw_dimension(drawing, middle, {x + radius, middle.y}, "r");
        draw_label(drawing, {x, -1.5},
                   "s = " + examples::text(s, "%g") +
                       ", P = " + examples::text(ljus::detail::kernel_part(s), "%.2f"),
                   colors::orange);
    }
    draw_dimension(drawing, {4.1, 0}, {4.1, 0.4 * radius}, "s r", "currentColor", 20);
    draw_label(drawing, {0.75, 2.5}, "wall", colors::blue);
    draw_label(drawing, {0.75, -0.3}, "no wall");
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawing.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 28, final gathering: a drawing.");
        const examples::Options options = line.parse({});
        draw_discs_at_edge(options.path(""));
    });
}
