#pragma once

/// \file ljus/io/detail/polygon.hpp
/// \brief A polygon cut into triangles.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup polygon Polygons
/// \brief Files of meshes have faces with any number of corners.
/// \{

/// Cuts a polygon into triangles: ears, corners whose triangle holds no other corner,
/// one after another \cite meisters1975. What is not flat is seen along the sum of its
/// areas; what crosses itself is cut somehow, into as many triangles.
/// \param corners  In order, counter-clockwise.
/// \return Three numbers of corners a triangle, n - 2 of them; none for fewer than
///         three corners, or a polygon without an area.
/// \cost O(n^2), at worst O(n^3).
// [cut_polygon]
[[nodiscard]] inline std::vector<std::array<std::uint32_t, 3>>
cut_polygon(std::span<const glm::dvec3> corners) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const auto count = static_cast<std::uint32_t>(corners.size());
    if (count < 3) return triangles;
    glm::dvec3 across(0);
    for (std::uint32_t i = 1; i + 1 < count; ++i)
        across += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    if (!(glm::dot(across, across) > 0)) return triangles;

    std::vector<std::uint32_t> left(count);
    for (std::uint32_t i = 0; i < count; ++i) left[i] = i;
    // Twice the signed area of three corners, as seen along `across`.
    const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return glm::dot(across,
                        glm::cross(corners[b] - corners[a], corners[c] - corners[a]));
    };
    while (left.size() > 3) {
        const std::size_t n = left.size();
        std::size_t ear = 1; // if there is none, the polygon crosses itself
        for (std::size_t i = 1; i <= n; ++i) {
            const std::uint32_t a = left[i - 1], b = left[i % n], c = left[(i + 1) % n];
            bool free = turn(a, b, c) > 0;
            for (std::size_t k = 0; free && k < n; ++k) {
                const std::uint32_t p = left[k];
                if (p == a || p == b || p == c) continue;
                free =
                    !(turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0);
            }
            if (!free) continue;
            ear = i % n;
            break;
        }
        triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}
// [cut_polygon]

/// \}

} // namespace ljus
