#pragma once

/// \file point_structures.hpp
/// \brief Other structures that find near points: hash grid, Morton order, octree.
///
/// Simple implementations with the interface of the trees. They are
/// here to be compared with; the library does not use them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "ljus/accel/neighbor.hpp"

namespace structures {

using ljus::Vec3;

/// Cells as large as the radius of the queries, found by a hash of their coordinates;
/// points in cell order, by counting.
struct HashGrid {
    float cell = 1;                    ///< Side of a cell.
    std::vector<std::uint32_t> starts; ///< First point of each slot.
    std::vector<std::uint32_t> order;  ///< Where the points came from.
    std::vector<Vec3> points;          ///< By slot.

    HashGrid(std::span<const Vec3> all, float radius) : cell(radius) {
        std::size_t slots = 1;
        while (slots < all.size()) slots *= 2;
        starts.assign(slots + 1, 0);
        std::vector<std::uint32_t> slot(all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            slot[i] = slot_of(cell_of(all[i]));
            ++starts[slot[i] + 1];
        }
        std::partial_sum(starts.begin(), starts.end(), starts.begin());
        std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
        order.resize(all.size());
        points.resize(all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::uint32_t place = next[slot[i]]++;
            order[place] = static_cast<std::uint32_t>(i);
            points[place] = all[i];
        }
    }
    std::array<std::int32_t, 3> cell_of(const Vec3& p) const {
        return {static_cast<std::int32_t>(std::floor(p.x / cell)),
                static_cast<std::int32_t>(std::floor(p.y / cell)),
                static_cast<std::int32_t>(std::floor(p.z / cell))};
    }
    std::uint32_t slot_of(const std::array<std::int32_t, 3>& c) const {
        const std::uint32_t hash = std::uint32_t(c[0]) * 73856093u ^
                                   std::uint32_t(c[1]) * 19349663u ^
                                   std::uint32_t(c[2]) * 83492791u;
        return hash & static_cast<std::uint32_t>(starts.size() - 2);
    }
    template <typename Visit>
    void visit_within(const Vec3& center, float radius, Visit visit) const {
        const auto low = cell_of(center - radius), high = cell_of(center + radius);
        const double limit2 = double(radius) * double(radius);
        for (std::int32_t x = low[0]; x <= high[0]; ++x)
            for (std::int32_t y = low[1]; y <= high[1]; ++y)
                for (std::int32_t z = low[2]; z <= high[2]; ++z) {
                    const std::array<std::int32_t, 3> c{x, y, z};
                    const std::uint32_t slot = slot_of(c);
                    for (std::uint32_t i = starts[slot]; i < starts[slot + 1]; ++i) {
                        // Other cells may share the slot.
                        const double d2 = ljus::distance2(points[i], center);
                        if (d2 <= limit2 && cell_of(points[i]) == c) visit(i, d2);
                    }
                }
    }
    std::size_t bytes() const {
        return starts.size() * 4 + order.size() * 4 + points.size() * sizeof(Vec3);
    }
};

/// The cube around some points.
struct Cube {
    Vec3 low{0};    ///< Its corner.
    float side = 1; ///< Its side.
    explicit Cube(std::span<const Vec3> all) {
        if (all.empty()) return;
        Vec3 high = low = all[0];
        for (const Vec3& p : all) low = glm::min(low, p), high = glm::max(high, p);
        const Vec3 size = high - low;
        side = std::max({size.x, size.y, size.z, 1e-30f}) * 1.0001f;
    }
};

/// The squared distance from a point to a cube.
inline double cube_distance2(const Vec3& low, float side, const Vec3& center) {
    return ljus::detail::box_distance2(low, low + side, center);
}

/// Points sorted along Morton's curve, 21 bits per axis: an octree without nodes, whose
/// cells are found by bisection.
struct MortonOrder {
    Cube cube;
    std::vector<std::uint64_t> codes;
    std::vector<std::uint32_t> order;
    std::vector<Vec3> points;

    explicit MortonOrder(std::span<const Vec3> all) : cube(all) {
        struct Item {
            std::uint64_t code;
            std::uint32_t index;
        };
        std::vector<Item> items(all.size()), other(all.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            items[i] = {code_of(all[i]), static_cast<std::uint32_t>(i)};
        for (int shift = 0; shift < 63; shift += 9) { // by radix, nine bits at a time
            std::array<std::uint32_t, 513> starts{};
            for (const Item& item : items) ++starts[(item.code >> shift & 511) + 1];
            std::partial_sum(starts.begin(), starts.end(), starts.begin());
            for (const Item& item : items)
                other[starts[item.code >> shift & 511]++] = item;
            items.swap(other);
        }
        for (const Item& item : items) {
            codes.push_back(item.code);
            order.push_back(item.index);
            points.push_back(all[item.index]);
        }
    }
    std::uint64_t code_of(const Vec3& p) const {
        const auto spread = [](std::uint64_t x) {
            x = (x | x << 32) & 0x001f00000000ffffu;
            x = (x | x << 16) & 0x001f0000ff0000ffu;
            x = (x | x << 8) & 0x100f00f00f00f00fu;
            x = (x | x << 4) & 0x10c30c30c30c30c3u;
            return (x | x << 2) & 0x1249249249249249u;
        };
        const Vec3 q = (p - cube.low) / cube.side * 2097152.0f;
        const auto number = [](float x) {
            return std::min<std::uint64_t>(static_cast<std::uint64_t>(x), 2097151);
        };
        return spread(number(q.x)) | spread(number(q.y)) << 1 |
               spread(number(q.z)) << 2;
    }
    template <typename Visit>
    void visit_within(const Vec3& center, float radius, Visit visit) const {
        descend(0, codes.size(), 63, cube.low, cube.side, center,
                double(radius) * double(radius), visit);
    }
    template <typename Visit>
    void descend(std::size_t first, std::size_t last, int shift, const Vec3& low,
                 float side, const Vec3& center, double limit2, Visit& visit) const {
        // A little larger: the coordinates of the cells are rounded.
        if (first == last || cube_distance2(low - 1e-5f * cube.side,
                                            side + 2e-5f * cube.side, center) > limit2)
            return;
        if (last - first <= 24 || shift == 0) {
            for (std::size_t i = first; i < last; ++i) {
                const double d2 = ljus::distance2(points[i], center);
                if (d2 <= limit2) visit(static_cast<std::uint32_t>(i), d2);
            }
            return;
        }
        const auto begin = codes.begin();
        std::size_t from = first;
        for (std::uint64_t child = 0; child < 8; ++child) {
            const std::uint64_t end =
                ((codes[first] >> shift) << 3 | child) + 1; // of its codes, shifted
            const auto to = std::size_t(
                std::partition_point(
                    begin + std::ptrdiff_t(from), begin + std::ptrdiff_t(last),
                    [&](std::uint64_t code) { return code >> (shift - 3) < end; }) -
                begin);
            const float half = side / 2;
            const Vec3 corner =
                low +
                half * Vec3(float(child & 1), float(child >> 1 & 1), float(child >> 2));
            descend(from, to, shift - 3, corner, half, center, limit2, visit);
            from = to;
        }
    }
    std::size_t bytes() const {
        return codes.size() * 8 + order.size() * 4 + points.size() * sizeof(Vec3);
    }
};

/// Cubes cut into eight down to leaves of 24 points, children by their numbers.
struct Octree {
    struct Node {
        std::uint32_t first = 0, last = 0; ///< Its points.
        std::uint32_t child = 0;           ///< The first of eight; 0: a leaf.
    };
    Cube cube;
    std::vector<Node> nodes;
    std::vector<std::uint32_t> order;
    std::vector<Vec3> points;

    explicit Octree(std::span<const Vec3> all) : cube(all), order(all.size()) {
        std::iota(order.begin(), order.end(), 0u);
        nodes.push_back({0, static_cast<std::uint32_t>(all.size()), 0});
        split(0, cube.low, cube.side, 0, all);
        for (const std::uint32_t i : order) points.push_back(all[i]);
    }
    void split(std::uint32_t node, const Vec3& low, float side, int depth,
               std::span<const Vec3> all) {
        const auto [first, last, none] = nodes[node];
        if (last - first <= 24 || depth == 21) return;
        const float half = side / 2;
        const Vec3 middle = low + half;
        const auto child = static_cast<std::uint32_t>(nodes.size());
        nodes[node].child = child;
        nodes.resize(nodes.size() + 8);
        const auto cut = [&](std::uint32_t a, std::uint32_t b, int axis) {
            return static_cast<std::uint32_t>(
                std::partition(
                    order.begin() + a, order.begin() + b,
                    [&](std::uint32_t i) { return all[i][axis] < middle[axis]; }) -
                order.begin());
        };
        const std::uint32_t z = cut(first, last, 2);
        const std::uint32_t y[2] = {cut(first, z, 1), cut(z, last, 1)};
        const std::uint32_t ends[9] = {
            first, cut(first, y[0], 0), y[0], cut(y[0], z, 0), z, cut(z, y[1], 0),
            y[1],  cut(y[1], last, 0),  last};
        for (std::uint32_t i = 0; i < 8; ++i) {
            nodes[child + i] = {ends[i], ends[i + 1], 0};
            split(child + i,
                  low + half * Vec3(float(i & 1), float(i >> 1 & 1), float(i >> 2)),
                  half, depth + 1, all);
        }
    }
    template <typename Visit>
    void visit_within(const Vec3& center, float radius, Visit visit) const {
        descend(0, cube.low, cube.side, center, double(radius) * double(radius), visit);
    }
    template <typename Visit>
    void descend(std::uint32_t node, const Vec3& low, float side, const Vec3& center,
                 double limit2, Visit& visit) const {
        const auto [first, last, child] = nodes[node];
        if (first == last || cube_distance2(low - 1e-6f * cube.side,
                                            side + 2e-6f * cube.side, center) > limit2)
            return;
        if (child == 0) {
            for (std::uint32_t i = first; i < last; ++i) {
                const double d2 = ljus::distance2(points[i], center);
                if (d2 <= limit2) visit(i, d2);
            }
            return;
        }
        const float half = side / 2;
        for (std::uint32_t i = 0; i < 8; ++i)
            descend(child + i,
                    low + half * Vec3(float(i & 1), float(i >> 1 & 1), float(i >> 2)),
                    half, center, limit2, visit);
    }
    std::size_t bytes() const {
        return nodes.size() * sizeof(Node) + order.size() * 4 +
               points.size() * sizeof(Vec3);
    }
};

/// The k nearest by a structure that can only search balls: the ball is doubled until
/// it holds enough.
/// \param structure  Any of these.
/// \param center     Where from.
/// \param first      The radius to begin with.
/// \param found      Space for the k nearest; the farthest comes first.
/// \return How many were found.
template <typename Structure>
std::size_t nearest_by_balls(const Structure& structure, const Vec3& center,
                             float first, std::span<ljus::Neighbor> found) {
    static thread_local std::vector<ljus::Neighbor> all;
    for (float radius = first;; radius *= 1.41421356f) {
        all.clear();
        structure.visit_within(center, radius, [&](std::uint32_t i, double d2) {
            all.push_back({d2, i});
        });
        if (all.size() >= found.size()) break;
        if (all.size() == structure.points.size()) break;
    }
    const std::size_t count = std::min(all.size(), found.size());
    std::nth_element(all.begin(), all.begin() + std::ptrdiff_t(count) - 1, all.end());
    std::copy(all.begin(), all.begin() + std::ptrdiff_t(count), found.begin());
    if (count > 0) std::swap(found[0], found[count - 1]);
    return count;
}

/// Photons on the six walls of a room of side 10, uniform, and those of a caustic:
/// four rings of widths from 1 to 1/10000, most photons in the thinnest.
/// \param count  How many.
/// \param unit   A source of numbers in [0, 1).
template <typename Unit>
std::vector<Vec3> on_walls(std::size_t count, Unit&& unit) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        Vec3 point{unit(), unit(), unit()};
        point *= 10.0f;
        const int wall = static_cast<int>(6.0f * unit());
        point[wall / 2] = wall % 2 == 0 ? 0.0f : 10.0f;
        points.push_back(point);
    }
    return points;
}
template <typename Unit>
std::vector<Vec3> in_caustics(std::size_t count, Unit&& unit) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const float angle = 6.2831853f * unit();
        const float width = std::pow(10.0f, -4.0f * unit());
        const auto ring = static_cast<float>(static_cast<int>(4.0f * unit()));
        const float r = 1.0f + width * (unit() - 0.5f);
        points.push_back({2.5f * ring + 1.0f + 0.8f * r * std::cos(angle), 0.0f,
                          2.0f + r * std::sin(angle)});
    }
    return points;
}

} // namespace structures
