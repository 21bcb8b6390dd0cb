#pragma once

/// \file ljus/geometry/detail/polygon.hpp
/// \brief A polygon cut into triangles.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ljus/math/vector.hpp"

namespace ljus::detail {

// Cuts a polygon into triangles: ears, corners whose triangle holds no other corner,
// one after another \cite meisters1975. What is not flat is seen along the sum of its
// areas; what crosses itself is cut somehow, into as many triangles.
//
// The corners are given in order, counter-clockwise. Each triangle is three numbers of
// corners, and there are n - 2 of them: none for fewer than three corners, or for a
// polygon without an area. O(n^2): an ear that is cut off can make or end an ear at its
// two neighbours only, so that no other corner is asked again.
[[nodiscard]] inline std::vector<std::array<std::uint32_t, 3>>
cut_polygon(std::span<const glm::dvec3> corners) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const auto count = static_cast<std::uint32_t>(corners.size());
    if (count < 3) return triangles;
    glm::dvec3 across(0);
    for (std::uint32_t i = 1; i + 1 < count; ++i)
        across += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    if (!(glm::dot(across, across) > 0)) return triangles;

    // Twice the signed area of three corners, as seen along `across`.
    const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return glm::dot(across,
                        glm::cross(corners[b] - corners[a], corners[c] - corners[a]));
    };
    std::vector<std::uint32_t> left(count);
    for (std::uint32_t i = 0; i < count; ++i) left[i] = i;
    const auto is_ear = [&](std::size_t place) {
        const std::size_t n = left.size();
        const std::uint32_t a = left[(place + n - 1) % n], b = left[place],
                            c = left[(place + 1) % n];
        if (!(turn(a, b, c) > 0)) return false;
        for (const std::uint32_t p : left)
            if (p != a && p != b && p != c && turn(a, b, p) >= 0 &&
                turn(b, c, p) >= 0 && turn(c, a, p) >= 0)
                return false;
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
    return triangles;
}

} // namespace ljus::detail
