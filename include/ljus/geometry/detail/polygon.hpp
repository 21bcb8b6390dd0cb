#pragma once

/// \file ljus/geometry/detail/polygon.hpp
/// \brief Triangulation of a polygon.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ljus/math/vector.hpp"

namespace ljus::detail {

// The triangles of a polygon, as three indices of corners each.
struct CutPolygon {
    std::vector<std::array<std::uint32_t, 3>> triangles{};
    bool crossed = false; // the polygon crosses itself, so its triangles overlap
};

// Triangulates a polygon by cutting off ears: corners whose triangle contains no other
// corner \cite meisters1975. A polygon that is not flat is projected along its area
// vector. A polygon that crosses itself is cut arbitrarily, and `crossed` is set.
//
// The corners are given counter-clockwise; n of them give n - 2 triangles. Fewer than
// three corners, or no area, give none. Corners may coincide, as where a bridge
// connects a hole. The cost is O(n^2), because cutting an ear only affects its two
// neighbours.
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
            bool shares = false; // coincides with a corner of the ear
            for (std::size_t k = 0; k < 3; ++k) {
                if (corners[p] != corners[ear[k]]) continue;
                shares = true; // then no edge at p may lead into the ear
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
        std::size_t ear = 1; // if there is no ear, the polygon crosses itself
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
    // The areas add up to that of the polygon; those of flipped triangles are negative.
    const double most = 1e-9 * glm::dot(across, across);
    for (const auto& [a, b, c] : triangles)
        result.crossed = result.crossed || turn(a, b, c) < -most;
    return result;
}

} // namespace ljus::detail
