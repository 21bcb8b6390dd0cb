// smoke: --quality draft
/// \file chapters/drawings/10_drawings.cpp
/// \brief Chapter 10: reflection as twice a projection.

#include <string>
#include <vector>

#include <ljus/optics/reflection.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::flat;
using examples::Point;
using Vec = ljus::Vec3T<double>;
namespace colors = examples::colors;

/// D, its part along the normal, and D less twice that part.
void draw_projection(const std::string& folder) {
    Drawing drawing{.name = "reflection-parts",
                    .description = "A direction D drawn from the point it meets, its "
                                   "part along the normal, the rest I along the "
                                   "surface, and the reflected direction, "
                                   "which is D less twice that part",
                    .low{-2.3, -1.9},
                    .high{3.1, 1.95},
                    .scale = 115};
    const Vec d = 1.9 * glm::normalize(Vec{0.8, -0.6, 0}), n{0, 1, 0};
    const Vec r = ljus::reflect(d, n), along = glm::dot(d, n) * n;
    draw_area(drawing, {{-2.3, 0}, {3.1, 0}, {3.1, -1.9}, {-2.3, -1.9}},
              "currentColor");
    draw_line(drawing, {{-2.3, 0}, {3.1, 0}}, {.width = 2});
    draw_arrow(drawing, flat(-d), {0, 0}, {.color = colors::blue, .width = 1.2});
    draw_arrow(drawing, {0, 0}, flat(d), {colors::blue, 2.5});
    draw_arrow(drawing, {0, 0}, flat(r), {colors::orange, 2.5});
    draw_arrow(drawing, {0, 0}, {0, 1.7}, {.width = 2});
    draw_arrow(drawing, {0, 0}, flat(d - along), {colors::green, 2.5});
    draw_arrow(drawing, flat(d), flat(d - along), {colors::red, 2});
    draw_arrow(drawing, flat(d - along), flat(r), {colors::red, 2});
    draw_arrow(drawing, {0, 0}, flat(along), {colors::red, 2});
    draw_line(drawing, {flat(along), flat(d)}, {.width = 1, .dashed = true});
    draw_label(drawing, {-0.18, 1.6}, "N");
    draw_label(drawing, {-1.2, 0.65}, "D", colors::blue);
    draw_label(drawing, {0.85, -0.4}, "D", colors::blue);
    draw_label(drawing, {0.8, 0.85}, "R", colors::orange);
    draw_label(drawing, {0.9, 0.13}, "I", colors::green);
    draw_label(drawing, {-0.65, -0.7}, "(D · N) N", colors::red);
    draw_label(drawing, {2.35, 0.25}, "−2 (D · N) N", colors::red);
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 10, reflection: drawings.");
        const examples::Options options = line.parse({});
        draw_projection(options.path(""));
    });
}
