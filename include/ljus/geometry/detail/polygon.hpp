#pragma once

/// \file ljus/geometry/detail/polygon.hpp
/// \brief A polygon cut into triangles.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ljus/math/vector.hpp"

namespace ljus::detail {

// The triangles of a polygon: three numbers of corners each.
struct CutPolygon {
    std::vector<std::array<std::uint32_t, 3>> triangles{};
    bool crossed = false; // it crosses itself, so that they overlap
};

// Cuts a polygon into triangles: ears, corners whose triangle holds no other corner,
// one after another \cite meisters1975. What is not flat is seen along the sum of its
// areas; what crosses itself is cut somehow, into as many triangles, and said.
//
// The corners are given in order, counter-clockwise, n - 2 triangles come out: none for
// fewer than three corners, or for a polygon without an area. Corners may share a place,
// as where a bridge leads to a hole and back. O(n^2): an ear that is cut off can make or
// end an ear at its two neighbours only, so that no other corner is asked again.
[[nodiscard]] inline CutPolygon cut_polygon(std::span<const glm::dvec3> corners) {
    CutPolygon result;
    auto& triangles = result.triangles;
    const auto count = static_cast<std::uint32_t>(corners.size());
    if (count < 3) return result;
    glm::dvec3 across(0);
    for (std::uint32_t i = 1; i + 1 < count; ++i)
        across += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    if (!(glm::dot(across, across) > 0)) return result;

    // Twice the signed area of three corners, as seen along `across`.
    const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return glm::dot(across,
                        glm::cross(corners[b] - corners[a], corners[c] - corners[a]));
    };
    std::vector<std::uint32_t> left(count);
    for (std::uint32_t i = 0; i < count; ++i) left[i] = i;
    const auto is_ear = [&](std::size_t place) {
        const std::size_t n = left.size();
        const std::array<std::uint32_t, 3> ear{left[(place + n - 1) % n], left[place],
                                               left[(place + 1) % n]};
        const auto [a, b, c] = ear;
        if (!(turn(a, b, c) > 0)) return false;
        for (std::size_t i = 0; i < n; ++i) {
            const std::uint32_t p = left[i];
            if (p == a || p == b || p == c) continue;
            bool shares = false; // the place of a corner of the ear
            for (std::size_t k = 0; k < 3; ++k) {
                if (corners[p] != corners[ear[k]]) continue;
                shares = true; // then neither side of p may lead into the ear
                const std::uint32_t next = ear[(k + 1) % 3], last = ear[(k + 2) % 3];
                for (const std::uint32_t q : {left[(i + 1) % n], left[(i + n - 1) % n]})
                    if (turn(p, next, q) > 0 && turn(p, q, last) > 0) return false;
            }
            if (!shares && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
                turn(c, a, p) >= 0)
                return false;
        }
        return true;
    };
    std::vector<char> ears(count); // of the corners in `left`
    for (std::size_t i = 0; i < count; ++i) ears[i] = is_ear(i) ? 1 : 0;
    while (left.size() > 3) {
        const std::size_t n = left.size();
        std::size_t ear = 1; // if there is none, the polygon crosses itself
        for (std::size_t i = 1; i <= n; ++i) {
            if (ears[i % n] == 0) continue;
            ear = i % n;
            break;
        }
        triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
        ears.erase(ears.begin() + static_cast<std::ptrdiff_t>(ear));
        for (const std::size_t beside : {(ear + n - 2) % (n - 1), ear % (n - 1)})
            ears[beside] = is_ear(beside) ? 1 : 0;
    }
    triangles.push_back({left[0], left[1], left[2]});
    // Their areas add up to that of the polygon; turned ones count against it.
    const double most = 1e-9 * glm::dot(across, across);
    for (const auto& [a, b, c] : triangles)
        result.crossed = result.crossed || turn(a, b, c) < -most;
    return result;
}

} // namespace ljus::detail
