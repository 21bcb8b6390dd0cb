// smoke: --quality draft
/// \file chapters/drawings/24_drawings.cpp
/// \brief Chapter 24: the cuts of a tree, and a search for the nearest.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <ljus/accel/kd_tree.hpp>
#include <ljus/math/random.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::flat;
using examples::Point;
using ljus::Vec3;
namespace colors = examples::colors;

constexpr float width = 6, height = 3.4f;

/// Points in a plane, denser towards one corner.
std::vector<Vec3> make_points(int count) {
    auto stream = ljus::random_stream(8, ljus::Pass::user, 0, 0);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        const ljus::Vec2 u = next_2d(stream);
        points.push_back({width * u.x * u.x, height * u.y, 0});
    }
    return points;
}
/// A cell of the plane with the points in it.
struct Cell {
    Point low, high;
    std::vector<Vec3> points;
    int level = 0;
};

/// Cuts a cell at the median of its longer side, until few points are left.
void cut(Drawing& drawing, Cell cell, std::size_t few, std::vector<Cell>& leaves) {
    if (cell.points.size() <= few) {
        leaves.push_back(cell);
        return;
    }
    const bool by_x = cell.high.x - cell.low.x > cell.high.y - cell.low.y;
    const auto middle = cell.points.begin() + std::ptrdiff_t(cell.points.size() / 2);
    std::nth_element(
        cell.points.begin(), middle, cell.points.end(),
        [&](const Vec3& a, const Vec3& b) { return by_x ? a.x < b.x : a.y < b.y; });
    Cell left{cell.low, cell.high, {cell.points.begin(), middle}, cell.level + 1};
    Cell right{cell.low, cell.high, {middle, cell.points.end()}, cell.level + 1};
    if (by_x)
        left.high.x = right.low.x = double(middle->x);
    else
        left.high.y = right.low.y = double(middle->y);
    const char* tints[] = {colors::red, colors::orange, colors::blue, colors::green};
    draw_line(
        drawing,
        {{right.low.x, right.low.y},
         by_x ? Point{right.low.x, right.high.y} : Point{right.high.x, right.low.y}},
        {tints[cell.level % 4], std::max(1.0, 3.5 - cell.level)});
    cut(drawing, left, few, leaves);
    cut(drawing, right, few, leaves);
}

/// The halvings of 64 points.
void draw_cuts(const std::string& folder) {
    Drawing drawing{.name = "kd_tree-cuts",
                    .description = "Points, halved again and again across the longer "
                                   "side of their box, until four are left in each",
                    .low{-0.15, -0.15},
                    .high{6.15, 3.55},
                    .scale = 110};
    std::vector<Cell> leaves;
    cut(drawing, {{0, 0}, {width, height}, make_points(64)}, 4, leaves);
    draw_line(drawing, {{0, 0}, {width, 0}, {width, height}, {0, height}, {0, 0}},
              {.width = 1.5});
    for (const Cell& leaf : leaves)
        for (const Vec3& point : leaf.points)
            draw_dot(drawing, flat(point), 3, "currentColor");
    save_drawing(folder, drawing);
}

/// The eight nearest of 200 points, found by the library's tree, and the leaves of the
/// cuts above that the final circle touches.
void draw_search(const std::string& folder) {
    Drawing drawing{.name = "kd_tree-search",
                    .description =
                        "A search for the eight nearest points: only boxes "
                        "that the circle around the query reaches are looked "
                        "into",
                    .low{-0.15, -0.15},
                    .high{6.15, 3.55},
                    .scale = 110};
    const std::vector<Vec3> points = make_points(200);
    const Vec3 query{2.1f, 1.7f, 0};
    const ljus::KdTree tree(points);
    std::vector<ljus::Neighbor> found(8);
    const std::size_t count = tree.nearest(query, 100, found);
    double reach = 0;
    for (std::size_t i = 0; i < count; ++i)
        reach = std::max(reach, std::sqrt(double(found[i].distance2)));
    Drawing unseen; // the lines of the cuts are not wanted here
    std::vector<Cell> leaves;
    cut(unseen, {{0, 0}, {width, height}, points}, 8, leaves);
    const Point q = flat(query);
    for (const Cell& leaf : leaves) {
        const double dx = std::max({leaf.low.x - q.x, 0.0, q.x - leaf.high.x});
        const double dy = std::max({leaf.low.y - q.y, 0.0, q.y - leaf.high.y});
        const std::vector<Point> box{leaf.low,
                                     {leaf.high.x, leaf.low.y},
                                     leaf.high,
                                     {leaf.low.x, leaf.high.y},
                                     leaf.low};
        const bool reached = std::hypot(dx, dy) <= reach;
        if (reached) draw_area(drawing, box, colors::orange);
        draw_line(drawing, box, {.color = "#80808090", .width = 1});
        for (const Vec3& point : leaf.points) {
            const bool near = std::hypot(double(point.x) - q.x,
                                         double(point.y) - q.y) <= reach * 1.000001;
            draw_dot(drawing, flat(point), near ? 4.5 : 3,
                     near      ? colors::red
                     : reached ? colors::orange
                               : "#808080");
        }
    }
    draw_line(drawing, examples::circle(q, reach), {colors::blue, 2.5});
    draw_dot(drawing, q, 5, colors::blue);
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 24, the k-d tree: drawings.");
        const examples::Options options = line.parse({});
        draw_cuts(options.path(""));
        draw_search(options.path(""));
    });
}
