// figures: fig-9
// smoke: --quality draft
/// \file 10_reflection.cpp
/// \brief Figure 9: a ray that a mirror reflects, R = 2I - D, computed by reflect().
// runs in the folder of its drawing

#include <ljus/optics/reflection.hpp>

#include "common/drawing.hpp"

using namespace examples;
using Vec = ljus::Vec3T<double>;

/// Draws fig-9.svg.
int main() {
    const Vec normal{0, 1, 0};
    const Vec d = 1.7 * glm::normalize(Vec{1, -0.75, 0});
    const Vec i = d - glm::dot(d, normal) * normal; // the component along the mirror
    const Vec r = ljus::reflect(d, normal);

    Drawing drawing{.name = "fig-9",
                    .description = "A ray D that a mirror reflects along R",
                    .low{-1.7, -0.5},
                    .high{3.1, 1.3}};
    const Pen blue{colors::blue, 2.5}, orange{colors::orange, 2.5},
        green{colors::green, 2};
    draw_area(drawing, {{-1.7, 0}, {3.1, 0}, {3.1, -0.5}, {-1.7, -0.5}},
              "currentColor");
    draw_line(drawing, {{-1.7, 0}, {3.1, 0}});
    draw_arrow(drawing, flat(-d), {0, 0}, blue);
    draw_arrow(drawing, {0, 0}, flat(r), orange);
    draw_arrow(drawing, {0, 0}, flat(normal), {.width = 2});

    // Twice I is drawn a little below the mirror, and minus D from the end of twice I;
    // their sum is R.
    const Vec below{0, -0.16, 0};
    draw_arrow(drawing, flat(below), flat(below + i), green);
    draw_arrow(drawing, flat(below + i), flat(below + 2.0 * i), green);
    draw_line(drawing, {flat(r), flat(r + d)}, {colors::blue, 1.5, true});

    draw_label(drawing, flat(Vec{0.45, -0.1, 0} - d), "D", colors::blue);
    draw_label(drawing, flat(Vec{-0.3, 0.05, 0} + r), "R", colors::orange);
    draw_label(drawing, flat(Vec{0.95, -0.45, 0} + r), "D", colors::blue);
    draw_label(drawing, {-0.15, 0.85}, "N");
    draw_label(drawing, {0.5 * i.x, -0.34}, "I", colors::green);
    draw_label(drawing, {1.5 * i.x, -0.34}, "I", colors::green);
    save_drawing(".", drawing);
}
