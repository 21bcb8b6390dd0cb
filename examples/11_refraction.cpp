// figures: fig-10
// smoke: --quality draft
/// \file 11_refraction.cpp
/// \brief Figure 10: a ray that glass refracts, and the angles of Snell's law.
// runs in the folder of its drawing

#include <cmath>
#include <numbers>

#include <ljus/optics/refraction.hpp>

#include "common/drawing.hpp"

using namespace examples;
using Vec3d = ljus::Vec3T<double>;

/// Draws fig-10.svg.
int main() {
    const double n1 = 1, n2 = 1.5; // air above, glass below
    const Vec3d normal{0, 1, 0};
    const Vec3d d = glm::normalize(Vec3d{1, -0.9, 0});
    const auto refracted = ljus::refract(d, normal, n1 / n2);
    if (!refracted)
        return 1; // total reflection, which happens only in the denser medium
    const Vec3d r = *refracted;

    Drawing drawing{.name = "fig-10",
                    .description = "A ray D that glass refracts along R1",
                    .low{-2.2, -1.6},
                    .high{2.2, 1.5}};
    draw_area(drawing, {{-2.2, 0}, {2.2, 0}, {2.2, -1.6}, {-2.2, -1.6}}, colors::blue);
    draw_line(drawing, {{-2.2, 0}, {2.2, 0}});
    const Point hit{};
    draw_arrow(drawing, flat(-1.6 * d), hit, {colors::blue, 2.5});
    draw_arrow(drawing, hit, flat(1.6 * r), {colors::orange, 2.5});
    draw_arrow(drawing, hit, {0, 1.2}, {.width = 2});
    draw_arrow(drawing, hit, {0, -1.2}, {.width = 2});

    // The angles between -D and N_1, and between R_1 and N_2.
    const double half_pi = std::numbers::pi / 2;
    draw_arc(drawing, hit, 0.5, half_pi, std::atan2(-d.y, -d.x));
    draw_arc(drawing, hit, 0.5, -half_pi, std::atan2(r.y, r.x));
    draw_label(drawing, {-0.27, 0.62}, "θ_1");
    draw_label(drawing, {0.2, -0.66}, "θ_2");
    draw_label(drawing, {-1.35, 0.85}, "D", colors::blue);
    draw_label(drawing, {0.95, -1.1}, "R_1", colors::orange);
    draw_label(drawing, {0.2, 1.15}, "N_1");
    draw_label(drawing, {-0.2, -1.15}, "N_2");
    draw_label(drawing, {1.7, 0.25}, "n_1 = 1");
    draw_label(drawing, {1.65, -0.25}, "n_2 = 1.5");
    save_drawing(".", drawing);
}
