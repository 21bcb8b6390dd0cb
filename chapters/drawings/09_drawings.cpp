// smoke: --quality draft
/// \file chapters/drawings/09_drawings.cpp
/// \brief Chapter 9: a field with its surface, and how two solvers go along a ray.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <ljus/geometry/metaballs.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
using Vec = ljus::Vec3T<double>;
namespace colors = examples::colors;

const ljus::MetaballsT<double> balls{.blobs{{.center{1.7, 1.5, 0}, .radius = 1.5},
                                            {.center{3.3, 1.7, 0}, .radius = 1.2}},
                                     .level = 0.25};

/// Draws where the field has a value: short pieces through the cells of a grid.
void draw_level(Drawing& drawing, double level, const examples::Pen& pen) {
    const double cell = 0.04;
    const auto value = [&](const Point& p) {
        return field(balls, Vec{p.x, p.y, 0}) - level;
    };
    for (double y = 0; y < 3.2; y += cell)
        for (double x = 0; x < 5; x += cell) {
            const Point corners[] = {
                {x, y}, {x + cell, y}, {x + cell, y + cell}, {x, y + cell}, {x, y}};
            std::vector<Point> ends;
            for (int i = 0; i < 4; ++i) {
                const double a = value(corners[i]), b = value(corners[i + 1]);
                if ((a < 0) == (b < 0)) continue;
                const double s = a / (a - b);
                ends.push_back({corners[i].x + s * (corners[i + 1].x - corners[i].x),
                                corners[i].y + s * (corners[i + 1].y - corners[i].y)});
            }
            if (ends.size() == 2) draw_line(drawing, ends, pen);
        }
}

/// Two blobs: where each ends, some levels of the sum of both, and the surface.
void draw_field(const std::string& folder) {
    Drawing drawing{.name = "metaballs-field",
                    .description = "Two overlapping blobs with level lines of their "
                                   "sum; the surface is the line of one level",
                    .low{0, -0.15},
                    .high{5, 3.25},
                    .scale = 110};
    for (const auto& blob : balls.blobs)
        draw_line(drawing,
                  examples::circle({blob.center.x, blob.center.y}, blob.radius),
                  {.color = "#80808090", .dashed = true});
    for (const double level : {-0.15, 0.15, 0.35, 0.55})
        draw_level(drawing, level, {.color = colors::blue, .width = 0.9});
    draw_level(drawing, 0, {.color = colors::red, .width = 3});
    draw_dot(drawing, {1.7, 1.5}, 4, "currentColor");
    draw_dot(drawing, {3.3, 1.7}, 4, "currentColor");
    draw_label(drawing, {1.7, 1.25}, "C_1");
    draw_label(drawing, {3.55, 1.6}, "C_2");
    draw_label(drawing, {2.6, 3.05}, "f = 0", colors::red);
    save_drawing(folder, drawing);
}

/// Sphere tracing in the plane: from each point the ray advances by |f| / lambda.
void draw_steps(const std::string& folder) {
    Drawing drawing{.name = "metaballs-steps",
                    .description = "A ray at the surface. Around each point of sphere "
                                   "tracing no surface can be within the circle",
                    .low{-0.35, -0.1},
                    .high{5, 3.05},
                    .scale = 110};
    draw_level(drawing, 0, {.color = colors::red, .width = 2.5});
    const ljus::RayT<double> ray{.origin{0, 2.7, 0}, .direction{0.985, -0.17, 0}};
    const double lambda = ljus::lipschitz(balls);
    const auto at = [&](double t) {
        const Vec p = point_at(ray, t);
        return Point{p.x, p.y};
    };
    draw_line(drawing, {at(-0.3), at(5)}, {.width = 1.2});
    double t = 0;
    for (int i = 0; i < 60 && t < 4.6; ++i) {
        const double step = -field(balls, point_at(ray, t)) / lambda;
        if (step < 0.004) break;
        draw_area(drawing, examples::circle(at(t), step), colors::blue);
        draw_line(drawing, examples::circle(at(t), step),
                  {.color = colors::blue, .width = 0.8});
        draw_dot(drawing, at(t), 2.5, "currentColor");
        t += step;
    }
    draw_label(drawing, {0, 2.45}, "O");
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 9, metaballs: drawings.");
        const examples::Options options = line.parse({});
        draw_field(options.path(""));
        draw_steps(options.path(""));
    });
}
