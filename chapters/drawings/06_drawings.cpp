// smoke: --quality draft
/// \file chapters/drawings/06_drawings.cpp
/// \brief Chapter 6: the chord that a ball cuts out of a line, and the three cases.

#include <cmath>
#include <string>
#include <vector>

#include <ljus/geometry/sphere.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::flat;
using examples::Point;
using Vec = ljus::Vec3T<double>;
namespace colors = examples::colors;

/// The chord, its middle P, and the right triangle of P, C and a hit.
void draw_chord(const std::string& folder) {
    Drawing drawing{.name = "sphere-chord",
                    .description = "A line through a ball: the two hits, the middle of "
                                   "the chord, and the right triangle with the radius",
                    .low{-0.5, -1.3},
                    .high{6.4, 2.5},
                    .scale = 105};
    const ljus::RayT<double> ray{.origin{0, 0, 0}, .direction{1, 0.3, 0}};
    const ljus::SphereT<double> ball{.center{3.9, 0.45, 0}, .radius = 1.45};
    const auto hits = ljus::chord(ray, ball).value();
    const Vec nearest = point_at(ray, (hits.enter + hits.leave) / 2);
    const Point p = flat(nearest), c = flat(ball.center);
    const Point first = flat(point_at(ray, hits.enter));
    const Point second = flat(point_at(ray, hits.leave));
    draw_area(drawing, examples::circle(c, ball.radius), colors::blue);
    draw_line(drawing, examples::circle(c, ball.radius));
    draw_line(drawing, {flat(ray.origin), flat(point_at(ray, 6.2))}, {.width = 1.2});
    draw_line(drawing, {first, second}, {.color = colors::orange, .width = 3});
    draw_line(drawing, {c, p}, {.color = colors::red, .width = 2.5});
    draw_line(drawing, {c, first}, {.color = colors::blue, .width = 2.5});
    draw_arrow(drawing, flat(ray.origin), flat(point_at(ray, 1.0)), {.width = 2.5});
    for (const Point& point : {first, second, p, c})
        draw_dot(drawing, point, 4, "currentColor");
    draw_dot(drawing, {0, 0}, 4, "currentColor");
    draw_label(drawing, {-0.2, 0.1}, "O");
    draw_label(drawing, {0.55, -0.12}, "D");
    draw_label(drawing, {c.x + 0.2, c.y - 0.2}, "C");
    draw_label(drawing, {p.x - 0.05, p.y + 0.28}, "nearest point");
    draw_label(drawing, {first.x - 0.3, first.y + 0.25}, "t_0");
    draw_label(drawing, {second.x + 0.3, second.y - 0.12}, "t_1");
    draw_label(drawing, {3.54, 0.72}, "|P|", colors::red);
    draw_label(drawing, {3.0, 0.42}, "R", colors::blue);
    draw_label(drawing, {4.72, 0.92}, "√(R² − |P|²)", colors::orange);
    save_drawing(folder, drawing);
}

/// Two hits, one, none; and an origin within the ball.
void draw_cases(const std::string& folder) {
    Drawing drawing{.name = "sphere-cases",
                    .description = "Three lines at a ball, which meet it twice, once "
                                   "and never, and a ray that starts inside",
                    .low{-0.3, -1.7},
                    .high{9.2, 1.35},
                    .scale = 80};
    const ljus::SphereT<double> ball{.center{2.4, 0, 0}, .radius = 1};
    draw_area(drawing, examples::circle(flat(ball.center), 1), colors::blue);
    draw_line(drawing, examples::circle(flat(ball.center), 1));
    for (const double height : {0.35, 1.0, 1.22}) {
        const ljus::RayT<double> ray{.origin{0, height, 0}, .direction{1, 0, 0}};
        const auto hits = ljus::chord(ray, ball);
        draw_arrow(drawing, {0, height}, {4.7, height},
                   {.color = hits ? colors::orange : "#80808090", .width = 2});
        if (!hits) continue;
        draw_dot(drawing, flat(point_at(ray, hits->enter)), 5, colors::red);
        draw_dot(drawing, flat(point_at(ray, hits->leave)), 5, colors::red);
    }
    const ljus::SphereT<double> around{.center{7, 0, 0}, .radius = 1};
    draw_area(drawing, examples::circle(flat(around.center), 1), colors::blue);
    draw_line(drawing, examples::circle(flat(around.center), 1));
    const ljus::RayT<double> inside{.origin{6.6, -0.2, 0}, .direction{1, 0.25, 0}};
    const auto hits = ljus::chord(inside, around).value();
    draw_line(drawing, {flat(point_at(inside, -1.2)), flat(inside.origin)},
              {.color = "#80808090", .dashed = true});
    draw_arrow(drawing, flat(inside.origin), flat(point_at(inside, 2.3)),
               {.color = colors::orange, .width = 2});
    draw_dot(drawing, flat(inside.origin), 4, "currentColor");
    draw_dot(drawing, flat(point_at(inside, hits.leave)), 5, colors::red);
    draw_dot(drawing, flat(point_at(inside, hits.enter)), 4, "#80808090");
    draw_label(drawing, {7.0, -1.35}, "t_0 is negative");
    draw_label(drawing, {2.4, -1.35}, "two hits, one, none");
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 6, spheres: drawings.");
        const examples::Options options = line.parse({});
        draw_chord(options.path(""));
        draw_cases(options.path(""));
    });
}
