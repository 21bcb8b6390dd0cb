#pragma once

/// \file ljus/geometry/detail/polygon.hpp
/// \brief Triangulation of a polygon.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "ljus/math/vector.hpp"

namespace ljus::detail {

// The triangles of a polygon. Each is given by the indices of its three corners.
struct CutPolygon {
    std::vector<std::array<std::uint32_t, 3>> triangles{};
    bool crossed = false; // the polygon crosses itself, so its triangles overlap
};

// Triangulates a polygon by cutting off ears \cite meisters1975. An ear is a corner
// that forms, with its two neighbours, a triangle without another corner. A polygon
// that is not flat is projected along its area vector. A polygon that crosses itself is
// cut arbitrarily, and `crossed` is set.
//
// The corners are given counter-clockwise. A polygon of n corners gives n - 2
// triangles, and one without an area gives none. Corners may coincide, for example
// where a bridge connects a hole to the border, or where parts of the polygon meet in a
// corner. If h of n corners are hollow (not convex), O(n h) tests suffice: only a
// hollow corner can lie in an ear, and cutting an ear off affects only its two
// neighbours.
[[nodiscard]] inline CutPolygon cut_polygon(std::span<const glm::dvec3> corners) {
    CutPolygon result;
    if (corners.size() < 3) return result;
    glm::dvec3 across(0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        across += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    if (!(glm::dot(across, across) > 0)) return result;
    if (corners.size() == 3) return {.triangles = {{0, 1, 2}}};

    // The corners, projected along the area vector onto the plane of two axes.
    const glm::dvec3 size = glm::abs(across);
    const int axis = size.x >= size.y && size.x >= size.z ? 0
                     : size.y >= size.z                   ? 1
                                                          : 2;
    int right = (axis + 1) % 3, up = (axis + 2) % 3;
    if (across[axis] < 0) std::swap(right, up);
    std::vector<glm::dvec2> flat;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 from = corner - corners[0];
        const double along = from[axis] / across[axis];
        flat.emplace_back(from[right] - along * across[right],
                          from[up] - along * across[up]);
    }
    // Twice the signed area of three corners.
    const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const glm::dvec2 ab = flat[b] - flat[a], ac = flat[c] - flat[a];
        return ab.x * ac.y - ab.y * ac.x;
    };
    std::vector<std::uint32_t> left(corners.size());
    std::iota(left.begin(), left.end(), 0u);
    // The corners before, at and after position i of `left`, which stays in order.
    const auto at = [&](std::size_t i) {
        const std::size_t n = left.size();
        return std::array{left[(i + n - 1) % n], left[i % n], left[(i + 1) % n]};
    };
    const auto is_hollow = [&](std::size_t i) {
        const auto [a, b, c] = at(i);
        return !(turn(a, b, c) > 0);
    };
    std::vector<std::uint32_t> hollow;
    for (std::size_t i = 0; i < left.size(); ++i)
        if (is_hollow(i)) hollow.push_back(left[i]);
    const auto is_ear = [&](std::size_t i) {
        const auto [a, b, c] = at(i);
        const auto is = [&](std::uint32_t p, std::uint32_t q) {
            return corners[p] == corners[q];
        };
        if (is(a, b) || is(b, c) || is(c, a)) return true; // without an area
        if (!(turn(a, b, c) > 0)) return false;
        // Whether p is between the two edges that meet in b, or on one of them.
        const auto is_between = [&, a = a, b = b, c = c](std::uint32_t p) {
            return is(p, a) || is(p, c) || (turn(a, b, p) > 0 && turn(b, c, p) > 0);
        };
        for (const std::uint32_t p : hollow)
            if (is(p, b)) { // parts of the polygon meet in b, with a gap at p
                const auto k = std::lower_bound(left.begin(), left.end(), p);
                const auto [before, same, after] = at(std::size_t(k - left.begin()));
                if (is_between(before) && is_between(after)) return false;
            } else if (!is(p, a) && !is(p, c) && turn(a, b, p) >= 0 &&
                       turn(b, c, p) >= 0 && turn(c, a, p) >= 0) {
                return false;
            }
        return true;
    };
    std::vector<char> ears; // of the corners in `left`
    for (std::size_t i = 0; i < left.size(); ++i) ears.push_back(is_ear(i) ? 1 : 0);
    while (left.size() > 3) {
        // The first ear from position 1 on. If there is no ear, the polygon crosses
        // itself.
        const auto found = std::find(ears.begin() + 1, ears.end(), 1);
        const auto ear = found != ears.end() ? found - ears.begin() : 1 - ears[0];
        const auto i = static_cast<std::size_t>(ear);
        result.triangles.push_back(at(i));
        std::erase(hollow, left[i]);
        left.erase(left.begin() + ear);
        ears.erase(ears.begin() + ear);
        const std::array beside{(i + left.size() - 1) % left.size(), i % left.size()};
        for (const std::size_t k : beside)
            if (!is_hollow(k)) std::erase(hollow, left[k]);
        for (const std::size_t k : beside) ears[k] = is_ear(k) ? 1 : 0;
    }
    result.triangles.push_back({left[0], left[1], left[2]});
    // A triangle that is flipped has a negative area.
    const double least = -1e-9 * size[axis];
    result.crossed =
        std::any_of(result.triangles.begin(), result.triangles.end(),
                    [&](const auto& t) { return turn(t[0], t[1], t[2]) < least; });
    return result;
}

} // namespace ljus::detail
