// smoke: --quality draft
/// \file chapters/drawings/30_drawings.cpp
/// \brief Chapter 30: the disc of an estimate at the edge of a wall, and gather rays
/// that look up points.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <ljus/math/random.hpp>
#include <ljus/photons/kernel_border.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"
#include "drawings/dimension.hpp"

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
                       ", P = " + examples::text(ljus::kernel_part(s), "%.2f"),
                   colors::orange);
    }
    draw_dimension(drawing, {4.1, 0}, {4.1, 0.4 * radius}, "s r", "currentColor", 20);
    draw_label(drawing, {0.75, 2.5}, "wall", colors::blue);
    draw_label(drawing, {0.75, -0.3}, "no wall");
    save_drawing(folder, drawing);
}

/// A room cut open: photons, the points chosen from them, and rays that look those up.
void draw_idea(const std::string& folder) {
    Drawing figure{.name = "final-gathering-idea",
                   .description =
                       "Rays from x end on walls and take what the nearest point knows",
                   .low{-0.35, -0.35},
                   .high{4.35, 2.35},
                   .scale = 150};
    const double width = 4, height = 2;
    draw_line(figure, {{0, height}, {0, 0}, {width, 0}, {width, height}, {0, height}});
    // Along the walls but the floor: a photon every so often, irregularly.
    struct Dot {
        Point at, normal;
    };
    std::vector<Dot> points;
    auto stream = ljus::random_stream(1, ljus::Pass::user, 0, 0);
    const double way = 2 * height + width;
    int number = 0;
    for (double s = 0.05; s < way; s += 0.04 + 0.08 * double(next_1d(stream))) {
        const Dot dot = s < height           ? Dot{{0, s}, {1, 0}}
                        : s < height + width ? Dot{{s - height, height}, {0, -1}}
                                             : Dot{{width, way - s}, {-1, 0}};
        if (number++ % 6 == 3)
            points.push_back(dot);
        else
            draw_dot(figure, dot.at, 2.2, colors::blue);
    }
    const Point x{1.7, 0};
    for (int i = 0; i < 9; ++i) {
        // Evenly over the cosine: seen from the side, the sine has equal steps.
        const double sine = -1 + 2 * (i + 0.5) / 9, cosine = std::sqrt(1 - sine * sine);
        double t = height / cosine;
        if (sine > 0) t = std::min(t, (width - x.x) / sine);
        if (sine < 0) t = std::min(t, x.x / -sine);
        const Point end{x.x + t * sine, t * cosine};
        draw_arrow(figure, x, end, {"currentColor", 1});
        const auto distance = [&](const Dot& dot) {
            return std::hypot(dot.at.x - end.x, dot.at.y - end.y);
        };
        const Dot& nearest = *std::min_element(
            points.begin(), points.end(),
            [&](const Dot& a, const Dot& b) { return distance(a) < distance(b); });
        draw_line(figure, {end, nearest.at}, {colors::orange, 4});
    }
    for (const Dot& dot : points) {
        draw_arrow(figure, dot.at,
                   {dot.at.x + 0.22 * dot.normal.x, dot.at.y + 0.22 * dot.normal.y},
                   {colors::orange, 1.5});
        draw_dot(figure, dot.at, 5, colors::orange);
    }
    draw_dot(figure, x, 5, "currentColor");
    draw_label(figure, {x.x, -0.18}, "x");
    save_drawing(folder, figure);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 30, final gathering: drawings.");
        const examples::Options options = line.parse({});
        draw_discs_at_edge(options.path(""));
        draw_idea(options.path(""));
    });
}
