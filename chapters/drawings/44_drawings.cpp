// smoke: --quality draft
/// \file chapters/drawings/44_drawings.cpp
/// \brief Chapter 44: a ray that is taken to a mesh, and the normal of a stretched one.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A map of the plane: the images of both axes and of the origin.
struct Map {
    Point x, y, origin;
};
Point vector_by(const Map& map, const Point& v) {
    return {v.x * map.x.x + v.y * map.y.x, v.x * map.x.y + v.y * map.y.y};
}
Point point_by(const Map& map, const Point& p) {
    const Point v = vector_by(map, p);
    return {v.x + map.origin.x, v.y + map.origin.y};
}

/// A polygon of 12 corners around a point, mapped.
std::vector<Point> outline(const Map& map) {
    std::vector<Point> points;
    for (int i = 0; i <= 12; ++i) {
        const double a = i * std::numbers::pi / 6;
        points.push_back(point_by(map, {std::cos(a), std::sin(a)}));
    }
    return points;
}

/// A ray in the scene and the same ray at the mesh, with its points at t = 1, 2, 3.
void draw_ray(const std::string& folder) {
    Drawing drawing{.name = "instances-ray",
                    .description =
                        "Left two instances in the scene and a ray that meets "
                        "one of them; right the mesh, and the ray as the mesh "
                        "sees it, with the same t at each point",
                    .low{-3.3, -2},
                    .high{5.6, 2.1},
                    .scale = 90};
    const Map mesh{{1, 0}, {0, 1}, {4, 0}};
    const Map turned{{0.9, 0.55}, {-0.25, 0.41}, {-0.7, 0.35}};
    const Map small{{0.5, 0}, {0, -0.5}, {-2.4, -1.2}};
    for (const Map& map : {turned, small, mesh}) {
        draw_area(drawing, outline(map), colors::blue);
        draw_line(drawing, outline(map), {.width = 1.5});
    }
    // The same ray twice: given at the mesh, and mapped into the scene.
    const Point from{-1.9, 1.55}, step{0.62, -0.49};
    for (const Map& map : {turned, mesh}) {
        const auto at = [&](double t) {
            return point_by(map, {from.x + t * step.x, from.y + t * step.y});
        };
        draw_arrow(drawing, at(0), at(3.3), {colors::red, 2});
        for (int t = 1; t <= 3; ++t) draw_dot(drawing, at(t), 4, colors::red);
        draw_label(drawing, {at(1).x + 0.12, at(1).y + 0.22}, "t = 1", colors::red);
        draw_label(drawing, {at(2).x + 0.34, at(2).y + 0.12}, "2", colors::red);
    }
    draw_label(drawing, {-0.9, -1.8}, "the scene");
    draw_label(drawing, {4, -1.8}, "the mesh, and its tree");
    save_drawing(folder, drawing);
}

/// A normal of a flattened circle, mapped like a direction and as a normal.
void draw_normals(const std::string& folder) {
    Drawing drawing{.name = "instances-normals",
                    .description =
                        "A circle with a tangent and a normal; flattened, the "
                        "image of the normal no longer stands on the tangent, "
                        "but the one by the inverse transposed map does",
                    .low{-1.6, -1.5},
                    .high{6.4, 1.9},
                    .scale = 90};
    const Map flat{{1.7, 0}, {0, 0.6}, {4, 0}};
    const double a = 0.9;
    const Point on{std::cos(a), std::sin(a)}, along{-std::sin(a), std::cos(a)};
    for (const bool mapped : {false, true}) {
        const Map map = mapped ? flat : Map{{1, 0}, {0, 1}, {0, 0}};
        std::vector<Point> curve;
        for (int i = 0; i <= 72; ++i) {
            const double b = i * std::numbers::pi / 36;
            curve.push_back(point_by(map, {std::cos(b), std::sin(b)}));
        }
        draw_area(drawing, curve, colors::blue);
        draw_line(drawing, curve, {.width = 1.5});
        const auto beside = [&](const Point& v, double length) {
            const Point w = vector_by(map, v), at = point_by(map, on);
            return Point{at.x + length * w.x, at.y + length * w.y};
        };
        draw_line(drawing, {beside(along, -0.8), beside(along, 0.8)}, {.width = 1.5});
        draw_arrow(drawing, point_by(map, on), beside(on, 0.8), {colors::red, 2.5});
        if (!mapped) continue;
        // L^-T n for a map along the axes.
        const double x = on.x / flat.x.x, y = on.y / flat.y.y;
        const double length = std::hypot(x, y);
        const Point at = point_by(map, on);
        draw_arrow(drawing, at, {at.x + x / length, at.y + y / length},
                   {colors::green, 2.5});
        draw_label(drawing, {at.x + 1.15, at.y + 0.5}, "L n", colors::red);
        draw_label(drawing, {at.x - 0.35, at.y + 0.95}, "(L⁻¹)ᵀ n", colors::green);
    }
    draw_label(drawing, {1.35, 1.5}, "n", colors::red);
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 44, instances: drawings.");
        const std::string folder = line.parse({}).path("");
        draw_ray(folder);
        draw_normals(folder);
    });
}
