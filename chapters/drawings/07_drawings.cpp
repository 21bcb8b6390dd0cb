// smoke: --quality draft
/// \file chapters/drawings/07_drawings.cpp
/// \brief Chapter 7: the weights of a point in a triangle, and the change of coordinates
/// that the formula of Möller and Trumbore makes.

#include <string>

#include "common/command_line.hpp"
#include "common/drawing.hpp"
#include "ljus/geometry/triangle.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A point, and the parts of the triangle whose areas are its weights.
void draw_weights(const std::string& folder) {
    const ljus::Triangle triangle{{0, 0, 0}, {3, -0.2f, 0}, {1.2f, 2.2f, 0}};
    const ljus::Ray ray{.origin{1.3f, 0.8f, 1}};
    const auto hit = ljus::intersect(ray, triangle);
    const Point p = examples::flat(ray.origin);
    const Point corners[] = {examples::flat(triangle.v1), examples::flat(triangle.v2),
                             examples::flat(triangle.v3)};
    const float weights[] = {1 - hit->u - hit->v, hit->u, hit->v};
    const char* inks[] = {colors::red, colors::green, colors::blue};
    const Point labels[] = {{0, -0.2}, {3, -0.4}, {1.2, 2.36}};
    Drawing drawing{.name = "triangle-weights",
                    .description =
                        "A triangle with a point P inside. Its corner V1 has "
                        "the weight of the area of P, V2 and V3",
                    .low = {-0.7, -0.6},
                    .high = {3.7, 2.55},
                    .scale = 90};
    for (std::size_t i = 0; i < 3; ++i) {
        const Point& a = corners[(i + 1) % 3];
        const Point& b = corners[(i + 2) % 3];
        draw_area(drawing, {p, a, b}, inks[i]);
        draw_area(drawing, {p, a, b}, inks[i]);
        draw_line(drawing, {a, b});
        draw_line(drawing, {p, corners[i]}, {inks[i]});
        draw_label(drawing, {(p.x + a.x + b.x) / 3, (p.y + a.y + b.y) / 3},
                   examples::text(double(weights[i]), "%.2f"), inks[i]);
        draw_label(drawing, labels[i], "V_" + std::to_string(i + 1), inks[i]);
    }
    draw_dot(drawing, p, 4, "currentColor");
    draw_label(drawing, {p.x + 0.02, p.y - 0.2}, "P");
    save_drawing(folder, drawing);
}

/// The triangle with its ray, and both in the coordinates (t, u, v), where the triangle
/// is the unit triangle and the ray is upright.
void draw_change(const std::string& folder) {
    Drawing drawing{.name = "triangle-change",
                    .description = "Left a ray at a triangle; right the same in "
                                   "coordinates in which the triangle is the unit "
                                   "triangle and the ray falls along t",
                    .low{-0.8, -0.7},
                    .high{8.6, 3.6},
                    .scale = 85};
    const double u = 0.28, v = 0.42;
    const auto at = [](double x, double y, double along) { // seen from the side
        return Point{x, 0.62 * y + along};
    };
    const Point a = at(0, 0, 0), b = at(3.2, 0.3, 0), c = at(1.3, 2.6, 0);
    const Point hit{a.x + u * (b.x - a.x) + v * (c.x - a.x),
                    a.y + u * (b.y - a.y) + v * (c.y - a.y)};
    draw_area(drawing, {a, b, c}, colors::blue);
    draw_line(drawing, {a, b, c, a}, {.width = 1.5});
    draw_arrow(drawing, a, b, {colors::orange, 2.5});
    draw_arrow(drawing, a, c, {colors::blue, 2.5});
    draw_arrow(drawing, {hit.x - 0.7, hit.y + 1.9}, hit, {.width = 2});
    draw_dot(drawing, hit, 5, colors::red);
    draw_label(drawing, {1.9, -0.1}, "E_1", colors::orange);
    draw_label(drawing, {0.4, 0.95}, "E_2", colors::blue);
    draw_label(drawing, {hit.x - 0.95, hit.y + 1.9}, "O");
    draw_label(drawing, {hit.x - 0.25, hit.y + 1.35}, "D");
    draw_label(drawing, {-0.3, -0.1}, "V_1");

    draw_arrow(drawing, {3.6, 1.2}, {4.5, 1.2}, {.width = 2});
    draw_label(drawing, {4.05, 1.5}, "M⁻¹");

    const Point o{5.6, 0}, e1{7.9, 0}, e2{6.3, 1.25};
    const Point image{o.x + u * (e1.x - o.x) + v * (e2.x - o.x),
                      o.y + u * (e1.y - o.y) + v * (e2.y - o.y)};
    draw_area(drawing, {o, e1, e2}, colors::blue);
    draw_line(drawing, {o, e1, e2, o}, {.width = 1.5});
    draw_arrow(drawing, o, e1, {colors::orange, 2.5});
    draw_arrow(drawing, o, e2, {colors::blue, 2.5});
    draw_line(drawing, {o, {o.x, 2.9}}, {.width = 1, .dashed = true});
    draw_arrow(drawing, {image.x, 2.6}, image, {.width = 2});
    draw_dot(drawing, image, 5, colors::red);
    draw_label(drawing, {8.15, 0}, "u", colors::orange);
    draw_label(drawing, {6.05, 1.35}, "v", colors::blue);
    draw_label(drawing, {5.4, 2.8}, "t");
    draw_label(drawing, {5.6, -0.3}, "0");
    draw_label(drawing, {7.85, -0.3}, "1", colors::orange);
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 7, triangles: drawings.");
        const examples::Options options = line.parse({});
        draw_weights(options.path(""));
        draw_change(options.path(""));
    });
}
