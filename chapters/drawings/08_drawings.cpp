// smoke: --quality draft
/// \file chapters/drawings/08_drawings.cpp
/// \brief Chapter 8: a ray between the sides of a box, and its way through a tree.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/accel/bvh.hpp>
#include <ljus/geometry/shape.hpp>
#include <ljus/math/random.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::flat;
using examples::Point;
using ljus::Box;
using ljus::Vec3;
namespace colors = examples::colors;

std::vector<Point> outline(const Box& box) {
    const double x0 = double(box.low.x), y0 = double(box.low.y);
    const double x1 = double(box.high.x), y1 = double(box.high.y);
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}};
}
/// The intervals of t in the two slabs of a box, for a hit and for a miss.
void draw_slabs(const std::string& folder) {
    Drawing drawing{.name = "bvh-slabs",
                    .description = "Two rays at a box. One is in both slabs for a "
                                   "while; the other leaves one before it enters the "
                                   "other",
                    .low{-0.4, -0.8},
                    .high{7.0, 4.1},
                    .scale = 95};
    const Box box{.low{2.2f, 1, -1}, .high{4.6f, 2.6f, 1}};
    draw_area(drawing, {{2.2, -0.8}, {4.6, -0.8}, {4.6, 4.1}, {2.2, 4.1}},
              colors::orange);
    draw_area(drawing, {{-0.4, 1}, {7, 1}, {7, 2.6}, {-0.4, 2.6}}, colors::blue);
    draw_line(drawing, outline(box), {.width = 2});
    for (const Vec3& direction : {Vec3{1, 0.36f, 0}, Vec3{1, 1.3f, 0}}) {
        const ljus::Ray ray{.origin{0, 0.35f, 0}, .direction = direction};
        const auto at = [&](double t) { return flat(point_at(ray, float(t))); };
        const double y = double(direction.y);
        const double x_in = 2.2, x_out = 4.6;
        const double y_in = (1 - 0.35) / y, y_out = (2.6 - 0.35) / y;
        draw_arrow(drawing, at(0), at(y > 0.5 ? 2.8 : 6.6), {.width = 1.2});
        // Beside the ray: when it is in which slab.
        const auto beside = [&](double t, double by) {
            const double length = std::hypot(1.0, y);
            return Point{at(t).x - by * y / length, at(t).y + by / length};
        };
        draw_line(drawing, {beside(x_in, 0.09), beside(y > 0.5 ? 2.75 : x_out, 0.09)},
                  {colors::orange, 4});
        draw_line(drawing, {beside(y_in, -0.09), beside(y_out, -0.09)},
                  {colors::blue, 4});
        const auto ready = ljus::box_ray(ray, box).value();
        const auto entry = ljus::intersect(ready, box, 0.0f, 100.0f);
        if (entry) draw_dot(drawing, at(double(*entry)), 6, colors::red);
    }
    draw_dot(drawing, {0, 0.35}, 4, "currentColor");
    draw_label(drawing, {5.9, 3.0}, "hit");
    draw_label(drawing, {3.15, 3.9}, "miss");
    draw_label(drawing, {-0.2, 0.2}, "O");
    draw_label(drawing, {4.2, -0.55}, "x-slab", colors::orange);
    draw_label(drawing, {6.4, 1.25}, "y-slab", colors::blue);
    save_drawing(folder, drawing);
}

/// A ray in a plane of balls, and the boxes of the nodes that it visits.
void draw_walk(const std::string& folder) {
    std::vector<ljus::Sphere> spheres;
    std::vector<ljus::Box> boxes;
    ljus::RandomStream stream = ljus::random_stream(5, ljus::Pass::user, 0, 0);
    for (int i = 0; i < 24; ++i) {
        const ljus::Vec2 at = 92.0f * ljus::next_2d<float>(stream) + 4.0f;
        const float radius = 1.2f + 2.4f * ljus::next_1d<float>(stream);
        spheres.push_back({.center = {at, 0}, .radius = radius});
        boxes.push_back(ljus::bounds(spheres.back()));
    }
    const ljus::Bvh tree(boxes, {.leaf_size = 2, .threads = 1});
    Drawing drawing{.name = "bvh-walk",
                    .description = "Balls in boxes in boxes. A ray passes through some "
                                   "of the boxes, down to the ball that it hits",
                    .low = {0, 0},
                    .high = {100, 100},
                    .scale = 3.6};
    const auto circle = [&](std::uint32_t i, const examples::Pen& pen) {
        const auto& [center, radius] = spheres[i];
        draw_arc(drawing, {center.x, center.y}, radius, 0, 2 * std::numbers::pi, pen);
    };
    for (std::uint32_t i = 0; i < spheres.size(); ++i) circle(i, {"currentColor", 1});

    const Vec3 from{2, 20, 0};
    const ljus::Ray ray{.origin = from,
                        .direction = glm::normalize(Vec3{96, 90, 0} - from)};
    ljus::NearestHit nearest;
    tree.closest(
        ray,
        [&](std::uint32_t slot, ljus::Ray& rest) {
            const std::uint32_t i = tree.primitive_ids()[slot];
            circle(i, {colors::red, 2.5});
            if (const auto t = ljus::intersect(rest, spheres[i]))
                nearest.offer({.t = *t}, i, rest);
        },
        [&](std::uint32_t i) {
            const auto& [low, high] = tree.nodes()[i].box;
            const std::vector<Point> corners{{low.x, low.y},
                                             {high.x, low.y},
                                             {high.x, high.y},
                                             {low.x, high.y},
                                             {low.x, low.y}};
            draw_area(drawing, corners, colors::blue);
            draw_line(drawing, corners, {colors::blue, 1.5});
        });
    circle(nearest.number, {colors::green, 3});
    const Vec3 hit = point_at(ray, nearest.at.t);
    draw_arrow(drawing, {from.x, from.y}, {hit.x, hit.y}, {.width = 2});
    save_drawing(folder, drawing);
}

/// Triangles in a plane, the boxes of the library's tree above them, and a ray with the
/// nodes that it visits.
void draw_tree(const std::string& folder) {
    Drawing drawing{.name = "bvh-tree",
                    .description = "Small shapes with the boxes of the tree over them; "
                                   "the boxes that a ray visits are marked",
                    .low{-0.15, -0.15},
                    .high{7.15, 4.15},
                    .scale = 100};
    auto stream = ljus::random_stream(5, ljus::Pass::user, 0, 0);
    std::vector<Box> boxes;
    for (int i = 0; i < 18; ++i) {
        const ljus::Vec2 at = next_2d(stream), size = next_2d(stream);
        const Vec3 center{0.4f + 6.2f * at.x, 0.3f + 3.4f * at.y, 0};
        const Vec3 half{0.08f + 0.22f * size.x, 0.08f + 0.2f * size.y, 0.1f};
        boxes.push_back({.low = center - half, .high = center + half});
    }
    const ljus::Bvh tree(boxes, {.leaf_size = 2});
    const ljus::Ray ray{.origin{-0.1f, 0.9f, 0}, .direction{1, 0.28f, 0}};
    // The first hit of the ray, and the boxes before it.
    int asked = 0, visited = 0;
    double nearest = 7.3;
    tree.closest(
        ray,
        [&](std::uint32_t slot, ljus::Ray& rest) {
            ++asked;
            const Box& box = boxes[tree.primitive_ids()[slot]];
            const auto ready = ljus::box_ray(rest, box).value();
            const auto t = ljus::intersect(ready, box, rest.t_min, rest.t_max);
            if (t) rest.t_max = *t, nearest = double(*t);
        },
        [&](std::uint32_t) { ++visited; });
    const auto is_on_the_way = [&](const Box& box) {
        const auto ready = ljus::box_ray(ray, tree.box()).value();
        return ljus::intersect(ready, box, 0.0f, float(nearest)).has_value();
    };
    for (const Box& box : boxes) {
        draw_area(drawing, outline(box), "currentColor");
        draw_line(drawing, outline(box), {.width = 1});
    }
    for (const auto& node : tree.nodes()) {
        const bool meets = is_on_the_way(node.box);
        draw_line(drawing, outline(node.box),
                  {.color = meets ? colors::orange : "#80808090",
                   .width = meets ? 2.2 : 0.8,
                   .dashed = !meets});
    }
    draw_arrow(drawing, flat(ray.origin), flat(point_at(ray, float(nearest))),
               {colors::red, 2.2});
    draw_line(drawing, {flat(point_at(ray, float(nearest))), flat(point_at(ray, 7.2f))},
              {.color = colors::red, .width = 0.8, .dashed = true});
    save_drawing(folder, drawing);
    if (asked == 0 || visited == 0) throw std::logic_error("the ray misses the tree");
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 8, trees of boxes: drawings.");
        const examples::Options options = line.parse({});
        draw_slabs(options.path(""));
        draw_walk(options.path(""));
        draw_tree(options.path(""));
    });
}
