// smoke: --quality draft
/// \file chapters/drawings/32_drawings.cpp
/// \brief Chapter 32: passes that come and go, and what stays.

#include <cmath>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A row of passes: each makes a map and a picture and throws the map away.
void draw_passes(const std::string& folder) {
    Drawing drawing{.name = "progressive-passes",
                    .description =
                        "Each pass emits photons into a map, renders a "
                        "picture with it, adds that to a sum, and forgets the "
                        "map; the radius shrinks from pass to pass",
                    .low{-0.2, -0.9},
                    .high{8.6, 3.2},
                    .scale = 85};
    const auto box = [&](const Point& low, double w, double h, const char* color) {
        const std::vector<Point> corners{
            low, {low.x + w, low.y}, {low.x + w, low.y + h}, {low.x, low.y + h}, low};
        draw_area(drawing, corners, color);
        draw_line(drawing, corners, {color, 1.6});
    };
    double radius2 = 0.3 * 0.3;
    for (int pass = 0; pass < 4; ++pass) {
        const double x = 0.2 + 2.1 * pass;
        box({x, 2.1}, 1.4, 0.8, colors::orange);
        draw_label(drawing, {x + 0.42, 2.5}, "map");
        draw_line(drawing, examples::circle({x + 1.05, 2.5}, std::sqrt(radius2)),
                  {colors::red, 2});
        draw_arrow(drawing, {x + 0.7, 2.1}, {x + 0.7, 1.55}, {.width = 1.5});
        box({x, 0.95}, 1.4, 0.6, colors::blue);
        draw_label(drawing, {x + 0.7, 1.25}, "picture");
        draw_arrow(drawing, {x + 0.7, 0.95}, {x + 0.7, 0.3}, {.width = 1.5});
        // The radius of the next pass: r^2 (i + alpha) / (i + 1), as in the text.
        radius2 *= (pass + 1 + 2.0 / 3) / (pass + 2);
    }
    box({0.2, -0.3}, 7.7, 0.6, "currentColor");
    draw_label(drawing, {4.05, 0}, "sum of all pictures so far");
    draw_label(drawing, {4.05, -0.65}, "time →");
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 32, progressive photons: drawings.");
        const examples::Options options = line.parse({});
        draw_passes(options.path(""));
    });
}
