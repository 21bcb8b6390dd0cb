// smoke: --quality draft
/// \file chapters/drawings/28_drawings.cpp
/// \brief Chapter 28: the two passes in one room, and who owns which path.

#include <cmath>
#include <string>
#include <vector>

#include <ljus/math/random.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

constexpr double width = 4, height = 3;
const Point glass{2.9, 0.75};

void draw_room(Drawing& drawing, double x, const char* name) {
    draw_line(drawing,
              {{x, height}, {x, 0}, {x + width, 0}, {x + width, height}, {x, height}},
              {.width = 1.5});
    draw_line(drawing, {{x + 1.6, height}, {x + 2.4, height}}, {colors::orange, 6});
    draw_area(drawing, examples::circle({x + glass.x, glass.y}, 0.45), colors::blue);
    draw_line(drawing, examples::circle({x + glass.x, glass.y}, 0.45));
    draw_label(drawing, {x + width / 2, -0.35}, name);
}

/// First photons, then rays.
void draw_passes(const std::string& folder) {
    Drawing drawing{.name = "two_pass-passes",
                    .description = "Left photons leave the lamp, pass through glass or "
                                   "bounce, and are stored; right rays from the camera "
                                   "ask the lamp and the map",
                    .low{-0.3, -0.65},
                    .high{9.1, 3.25},
                    .scale = 95};
    draw_room(drawing, 0, "first pass: photons");
    for (const double x : {0.5, 1.3, 2.0})
        draw_arrow(drawing, {2.0 + 0.1 * (x - 1), height}, {x, 0},
                   {colors::orange, 1.3});
    draw_arrow(drawing, {0.5, 0}, {0, 1.6}, {colors::green, 1.3});
    for (const double x : {2.62, 2.9, 3.12}) {
        const double top =
            glass.y + std::sqrt(0.45 * 0.45 - (x - glass.x) * (x - glass.x));
        draw_line(drawing, {{2.2, height}, {x, top}}, {colors::red, 1.2});
        draw_line(drawing, {{x, top}, {3.0 + 0.25 * (x - 2.9), 0.32}},
                  {colors::red, 1.2});
        draw_arrow(drawing, {3.0 + 0.25 * (x - 2.9), 0.32}, {3.1 - 0.2 * (x - 2.9), 0},
                   {colors::red, 1.2});
    }
    auto stream = ljus::random_stream(2, ljus::Pass::user, 0, 0);
    for (int i = 0; i < 26; ++i)
        draw_dot(drawing, {3.02 + 0.16 * double(next_1d(stream)), 0}, 2.6, colors::red);
    for (const double x : {0.5, 1.3, 2.0}) draw_dot(drawing, {x, 0}, 4, colors::orange);
    draw_dot(drawing, {0, 1.6}, 4, colors::green);

    const double x = 4.8;
    draw_room(drawing, x, "second pass: rays");
    const Point eye{x + 0.5, 2.0}, floor{x + 3.1, 0}, wall{x + 4, 2.75};
    draw_arrow(drawing, eye, {x + 1.6, 0}, {.width = 2});
    draw_arrow(drawing, eye, floor, {.width = 2});
    draw_line(drawing, {{x + 1.6, 0}, {x + 2, height}},
              {.color = colors::orange, .dashed = true});
    draw_arrow(drawing, {x + 1.6, 0}, wall, {colors::green, 1.8});
    draw_line(drawing, {wall, {x + 2.2, height}},
              {.color = colors::orange, .dashed = true});
    draw_line(drawing, examples::circle(floor, 0.3), {colors::red, 2});
    for (int i = 0; i < 26; ++i)
        draw_dot(drawing, {x + 3.02 + 0.16 * double(next_1d(stream)), 0}, 2.6,
                 colors::red);
    draw_dot(drawing, eye, 5, "currentColor");
    draw_label(drawing, {x + 0.3, 2.2}, "E");
    draw_label(drawing, {x + 1.1, 2.62}, "shadow ray", colors::orange);
    draw_label(drawing, {x + 2.85, 2.4}, "indirect ray", colors::green);
    draw_label(drawing, {x + 3.65, -0.2}, "map", colors::red);
    save_drawing(folder, drawing);
}

/// The classes of paths, each in the colour of its owner.
void draw_owners(const std::string& folder) {
    Drawing drawing{.name = "two_pass-owners",
                    .description =
                        "Four paths from the lamp to the camera, and the part "
                        "of the renderer that owns each",
                    .low{-0.2, -0.55},
                    .high{9.2, 2.7},
                    .scale = 90};
    const struct {
        std::vector<Point> way; // from the eye
        const char* color;
        const char* path;
        const char* owner;
    } classes[] = {
        {{{0.2, 1.2}, {1.4, 2.3}}, "currentColor", "E L", "emission"},
        {{{0.2, 1.2}, {0.9, 0.1}, {1.4, 2.3}}, colors::orange, "E D L", "shadow ray"},
        {{{0.2, 1.2}, {1.1, 0.1}, {1.25, 0.6}, {1.4, 2.3}},
         colors::red,
         "E D S⁺ L",
         "caustics map"},
        {{{0.2, 1.2}, {0.8, 0.1}, {1.9, 0.9}, {1.4, 2.3}},
         colors::green,
         "E D D L",
         "indirect ray"}};
    double x = 0;
    for (const auto& c : classes) {
        draw_line(drawing, {{x, 0.1}, {x + 1.9, 0.1}, {x + 1.9, 2.3}}, {.width = 1.2});
        draw_line(drawing, {{x + 1.1, 2.3}, {x + 1.7, 2.3}}, {colors::orange, 6});
        if (c.way.size() == 4 && c.way[2].x < 1.5) {
            draw_area(drawing, examples::circle({x + 1.25, 0.62}, 0.3), colors::blue);
            draw_line(drawing, examples::circle({x + 1.25, 0.62}, 0.3));
        }
        for (std::size_t i = 0; i + 1 < c.way.size(); ++i)
            draw_line(
                drawing,
                {{x + c.way[i].x, c.way[i].y}, {x + c.way[i + 1].x, c.way[i + 1].y}},
                {c.color, 2.2});
        draw_dot(drawing, {x + 0.2, 1.2}, 5, "currentColor");
        draw_label(drawing, {x + 0.95, 2.58}, c.path, c.color);
        draw_label(drawing, {x + 0.95, -0.25}, c.owner, c.color);
        x += 2.35;
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 28, two passes: drawings.");
        const examples::Options options = line.parse({});
        draw_passes(options.path(""));
        draw_owners(options.path(""));
    });
}
