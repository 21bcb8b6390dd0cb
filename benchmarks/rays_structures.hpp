#pragma once

/// \file rays_structures.hpp
/// \brief Other subdivisions of space over triangles: a grid, an octree, a k-d tree.
/// Each is as simple as possible and finds the same hits as testing every triangle.
///
/// All three divide space, not the set of triangles: a triangle is listed in every cell
/// that its box touches, so that it may be tested more than once. Positions along a ray
/// are computed in double, and boxes grow by `slack`, far more than the rounding error.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <ljus/accel/bvh.hpp>
#include <ljus/geometry/triangle.hpp>

namespace rays {

using ljus::NearestHit;
using Point = ljus::Vec3T<double>;

/// Common to all of them: the triangles, and a box around all.
struct Crowd {
    const std::vector<ljus::Triangle>& mesh;
    std::vector<ljus::Box> boxes{};
    ljus::Box all{};
    float slack = 0;

    explicit Crowd(const std::vector<ljus::Triangle>& of) : mesh(of) {
        for (const ljus::Triangle& triangle : mesh) {
            boxes.push_back(ljus::bounds(triangle));
            all = ljus::box_union(all, boxes.back());
        }
        slack = 1e-5f * ljus::max_component(all.high - all.low);
        for (ljus::Box& box : boxes)
            box = {box.low - ljus::Vec3{slack}, box.high + ljus::Vec3{slack}};
        all = {all.low - ljus::Vec3{2 * slack}, all.high + ljus::Vec3{2 * slack}};
    }
    void ask(std::uint32_t i, ljus::Ray& ray, NearestHit& nearest) const {
        if (const auto hit = ljus::intersect<double>(ray, mesh[i]))
            nearest.offer(*hit, i, ray);
    }
};

/// The interval of a ray in a box: empty if first > last.
struct Span {
    double first, last;
};
inline Span span_in(const ljus::Ray& ray, const ljus::Box& box) {
    Span span{ray.t_min, ray.t_max};
    for (int axis = 0; axis < 3; ++axis) {
        const double inverse = 1.0 / double(ray.direction[axis]);
        double first = (double(box.low[axis]) - double(ray.origin[axis])) * inverse;
        double last = (double(box.high[axis]) - double(ray.origin[axis])) * inverse;
        if (inverse < 0) std::swap(first, last);
        if (first > span.first) span.first = first; // no for NaN
        if (last < span.last) span.last = last;
    }
    return span;
}

/// A grid of equal cells, walked from wall to wall (Amanatides and Woo 1987).
struct Grid {
    static constexpr const char* name = "grid";
    Crowd crowd;
    std::array<int, 3> cells{};
    Point size{};                       ///< Of a cell.
    std::vector<std::uint32_t> first{}; ///< Of each cell's part of `list`, and the end.
    std::vector<std::uint32_t> list{};  ///< Triangles, cell by cell.

    explicit Grid(const std::vector<ljus::Triangle>& of) : crowd(of) {
        // Cubes, about as many as triangles.
        const Point all(crowd.all.high - crowd.all.low);
        const double edge = std::cbrt(all.x * all.y * all.z / double(of.size()));
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            cells[k] = std::clamp(static_cast<int>(all[axis] / edge), 1, 512);
            size[axis] = all[axis] / cells[k];
        }
        // Once to count, once to note: a sort by cell.
        first.assign(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]) + 1, 0);
        each_cell([&](std::size_t cell, std::uint32_t) { ++first[cell + 1]; });
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        list.resize(first.back());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        each_cell([&](std::size_t cell, std::uint32_t i) { list[next[cell]++] = i; });
    }
    [[nodiscard]] std::size_t bytes() const { return 4 * (first.size() + list.size()); }

    NearestHit closest(ljus::Ray ray) const {
        NearestHit nearest;
        const Span span = span_in(ray, crowd.all);
        if (!(span.first <= span.last)) return nearest;
        const Point from(ray.origin), way(ray.direction);
        std::array<int, 3> at{}, step{};
        Point next, across; // t at the next wall, and from wall to wall
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            at[k] = cell_of(from[axis] + span.first * way[axis], axis);
            step[k] = way[axis] < 0 ? -1 : 1;
            across[axis] = way[axis] == 0 ? HUGE_VAL : size[axis] / std::abs(way[axis]);
            const double wall = double(crowd.all.low[axis]) +
                                (at[k] + (step[k] > 0 ? 1 : 0)) * size[axis];
            next[axis] = way[axis] == 0 ? HUGE_VAL : (wall - from[axis]) / way[axis];
        }
        for (;;) {
            const std::size_t cell = number(at[0], at[1], at[2]);
            for (std::uint32_t i = first[cell]; i < first[cell + 1]; ++i)
                crowd.ask(list[i], ray, nearest);
            const int axis = next.x < next.y   ? (next.x < next.z ? 0 : 2)
                             : next.y < next.z ? 1
                                               : 2;
            const auto k = static_cast<std::size_t>(axis);
            // A hit beyond the wall must wait: a triangle in the next cell may be
            // nearer.
            if (next[axis] > double(ray.t_max) || next[axis] > span.last)
                return nearest;
            at[k] += step[k];
            if (at[k] < 0 || at[k] >= cells[k]) return nearest;
            next[axis] += across[axis];
        }
    }

private:
    int cell_of(double x, int axis) const {
        const double place = (x - double(crowd.all.low[axis])) / size[axis];
        return std::clamp(static_cast<int>(place), 0,
                          cells[static_cast<std::size_t>(axis)] - 1);
    }
    std::size_t number(int x, int y, int z) const {
        return static_cast<std::size_t>((z * cells[1] + y) * cells[0] + x);
    }
    template <typename F>
    void each_cell(F f) const {
        for (std::uint32_t i = 0; i < crowd.boxes.size(); ++i) {
            const Point low(crowd.boxes[i].low), high(crowd.boxes[i].high);
            for (int z = cell_of(low.z, 2); z <= cell_of(high.z, 2); ++z)
                for (int y = cell_of(low.y, 1); y <= cell_of(high.y, 1); ++y)
                    for (int x = cell_of(low.x, 0); x <= cell_of(high.x, 0); ++x)
                        f(number(x, y, z), i);
        }
    }
};

/// A cube divided into eight octants, recursively (Glassner 1984).
struct Octree {
    static constexpr const char* name = "octree";
    static constexpr std::uint32_t enough = 8; ///< Triangles in a leaf.
    static constexpr int deepest = 12;
    struct Node {
        std::uint32_t first = 0; ///< Of eight children, or of the leaf's triangles.
        std::uint32_t count = 0; ///< Of the leaf's triangles;
        bool leaf = false;       ///< if it is one.
    };
    Crowd crowd;
    std::vector<Node> nodes{1};
    std::vector<std::uint32_t> list{};

    explicit Octree(const std::vector<ljus::Triangle>& of) : crowd(of) {
        std::vector<std::uint32_t> all(of.size());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        grow(0, all, crowd.all, 0);
    }
    [[nodiscard]] std::size_t bytes() const {
        return nodes.size() * sizeof(Node) + 4 * list.size();
    }
    NearestHit closest(ljus::Ray ray) const {
        NearestHit nearest;
        // The child with these bits flipped comes first along the ray.
        const unsigned turned = (ray.direction.x < 0 ? 1u : 0u) |
                                (ray.direction.y < 0 ? 2u : 0u) |
                                (ray.direction.z < 0 ? 4u : 0u);
        walk(0, crowd.all, turned, ray, nearest);
        return nearest;
    }

private:
    static ljus::Box eighth(const ljus::Box& box, unsigned which) {
        const ljus::Vec3 middle = 0.5f * box.low + 0.5f * box.high;
        ljus::Box part = box;
        for (int axis = 0; axis < 3; ++axis)
            (which >> axis & 1 ? part.low : part.high)[axis] = middle[axis];
        return part;
    }
    static bool touch(const ljus::Box& a, const ljus::Box& b) {
        return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y &&
               b.low.y <= a.high.y && a.low.z <= b.high.z && b.low.z <= a.high.z;
    }
    void grow(std::size_t node, const std::vector<std::uint32_t>& things,
              const ljus::Box& box, int depth) {
        std::array<std::vector<std::uint32_t>, 8> parts;
        std::size_t sum = 0;
        if (things.size() > enough && depth < deepest)
            for (unsigned which = 0; which < 8; ++which) {
                const ljus::Box part = eighth(box, which);
                for (const std::uint32_t i : things)
                    if (touch(crowd.boxes[i], part)) parts[which].push_back(i);
                sum += parts[which].size();
            }
        // Do not split if most triangles would lie in most children.
        if (sum == 0 || sum > 4 * things.size()) {
            nodes[node] = {static_cast<std::uint32_t>(list.size()),
                           static_cast<std::uint32_t>(things.size()), true};
            list.insert(list.end(), things.begin(), things.end());
            return;
        }
        const std::size_t first = nodes.size();
        nodes[node].first = static_cast<std::uint32_t>(first);
        nodes.resize(first + 8);
        for (unsigned which = 0; which < 8; ++which)
            grow(first + which, parts[which], eighth(box, which), depth + 1);
    }
    void walk(std::size_t node, const ljus::Box& box, unsigned turned, ljus::Ray& ray,
              NearestHit& nearest) const {
        const Node at = nodes[node];
        const Span span = span_in(ray, box);
        // Rounding may let the ray miss the corner of an octant.
        const double doubt = 1e-12 * (1 + std::abs(span.first));
        if (!(span.first <= span.last + doubt)) return;
        if (at.leaf) {
            for (std::uint32_t i = 0; i < at.count; ++i)
                crowd.ask(list[at.first + i], ray, nearest);
            return;
        }
        for (unsigned i = 0; i < 8; ++i)
            walk(at.first + (i ^ turned), eighth(box, i ^ turned), turned, ray,
                 nearest);
    }
};

/// A k-d tree: one plane per node, chosen by the surface area heuristic (MacDonald and
/// Booth 1990) from 32 candidates along each axis.
struct KdTree {
    static constexpr const char* name = "k-d tree";
    static constexpr int places = 32;
    struct Node {
        float plane = 0;
        std::uint32_t first = 0; ///< The lower child, the other follows; or the list.
        std::uint32_t count = 0; ///< Of the leaf's triangles.
        int axis = -1;           ///< -1 for a leaf.
    };
    Crowd crowd;
    std::vector<Node> nodes{1};
    std::vector<std::uint32_t> list{};
    int deepest = 0;

    explicit KdTree(const std::vector<ljus::Triangle>& of) : crowd(of) {
        deepest = 8 + static_cast<int>(1.3 * std::log2(double(of.size())));
        std::vector<std::uint32_t> all(of.size());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        grow(0, all, crowd.all, 0);
    }
    [[nodiscard]] std::size_t bytes() const {
        return nodes.size() * sizeof(Node) + 4 * list.size();
    }
    NearestHit closest(ljus::Ray ray) const {
        NearestHit nearest;
        const Span all = span_in(ray, crowd.all);
        if (!(all.first <= all.last)) return nearest;
        struct Later {
            std::uint32_t node;
            Span span;
        };
        std::array<Later, 64> later;
        std::size_t waiting = 0;
        later[waiting++] = {0, all};
        while (waiting > 0) {
            auto [at, span] = later[--waiting];
            if (span.first > double(ray.t_max)) continue;
            while (nodes[at].axis >= 0) {
                const Node& node = nodes[at];
                const double from{ray.origin[node.axis]}, way{ray.direction[node.axis]};
                const double ahead = double(node.plane) - from;
                const bool high_first = ahead < 0 || (ahead == 0 && way > 0);
                const std::uint32_t near = node.first + (high_first ? 1 : 0);
                const std::uint32_t far = node.first + (high_first ? 0 : 1);
                // Boxes are grown by `slack`, so that half of it may be lost here.
                const double t = ahead / way; // infinite or NaN along the plane
                const double doubt = 0.5 * double(crowd.slack) / std::abs(way);
                if (t - doubt > span.last || t + doubt < 0) {
                    at = near;
                } else if (t + doubt < span.first) {
                    at = t > 0 ? far : near; // behind the ray there is nothing
                } else {                     // both; for NaN as well
                    // A plane that the ray starts at, or runs along, does not end the
                    // nearer side.
                    const bool crossed = std::isfinite(t) && t > 0;
                    const double from_plane = crossed ? t - doubt : span.first;
                    later[waiting++] = {far,
                                        {std::max(span.first, from_plane), span.last}};
                    if (crossed) span.last = std::min(span.last, t + doubt);
                    at = near;
                }
            }
            for (std::uint32_t i = 0; i < nodes[at].count; ++i)
                crowd.ask(list[nodes[at].first + i], ray, nearest);
        }
        return nearest;
    }

private:
    struct Cut {
        int axis = -1;
        float plane = 0;
        double cost = 0;
    };
    static double area(const Point& size) {
        return size.x * size.y + size.y * size.z + size.z * size.x;
    }
    Cut best_cut(const std::vector<std::uint32_t>& things, const ljus::Box& box) const {
        Cut best{.cost = double(things.size())}; // a leaf's
        const Point size(box.high - box.low);
        for (int axis = 0; axis < 3; ++axis) {
            if (!(size[axis] > 4 * double(crowd.slack))) continue;
            // How many boxes begin and end between the planes.
            std::array<int, places + 1> begin{}, end{};
            const auto place = [&](float x) {
                const double p = double(x - box.low[axis]) / size[axis] * places;
                return static_cast<std::size_t>(
                    std::clamp(std::ceil(p), 0.0, double(places)));
            };
            for (const std::uint32_t i : things) {
                ++begin[place(crowd.boxes[i].low[axis])];
                ++end[place(crowd.boxes[i].high[axis])];
            }
            int low = begin[0], high = static_cast<int>(things.size()) - end[0];
            for (int k = 1; k < places; ++k) {
                const auto p = static_cast<std::size_t>(k);
                low += begin[p];
                Point below = size, above = size;
                below[axis] *= double(k) / places;
                above[axis] -= below[axis];
                // Favour empty sides.
                const double saved = low == 0 || high == 0 ? 0.8 : 1.0;
                const double cost =
                    1.0 + saved * (area(below) * low + area(above) * high) / area(size);
                if (cost < best.cost)
                    best = {axis, box.low[axis] + float(below[axis]), cost};
                high -= end[p];
            }
        }
        return best;
    }
    void grow(std::size_t node, const std::vector<std::uint32_t>& things,
              const ljus::Box& box, int depth) {
        const Cut cut =
            depth < deepest && things.size() > 1 ? best_cut(things, box) : Cut{};
        if (cut.axis < 0) {
            nodes[node].first = static_cast<std::uint32_t>(list.size());
            nodes[node].count = static_cast<std::uint32_t>(things.size());
            list.insert(list.end(), things.begin(), things.end());
            return;
        }
        std::vector<std::uint32_t> low, high;
        for (const std::uint32_t i : things) {
            if (crowd.boxes[i].low[cut.axis] <= cut.plane) low.push_back(i);
            if (crowd.boxes[i].high[cut.axis] >= cut.plane) high.push_back(i);
        }
        ljus::Box below = box, above = box;
        below.high[cut.axis] = above.low[cut.axis] = cut.plane;
        const std::size_t first = nodes.size();
        nodes[node] = {cut.plane, static_cast<std::uint32_t>(first), 0, cut.axis};
        nodes.resize(first + 2);
        grow(first, low, below, depth + 1);
        grow(first + 1, high, above, depth + 1);
    }
};

} // namespace rays
