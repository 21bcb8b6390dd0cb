#pragma once

/// \file ljus/geometry/detail/pair_triangles.hpp
/// \brief Joins pairs of triangles into parallelograms.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "ljus/geometry/detail/equal_points.hpp"
#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/triangle.hpp"

namespace ljus::detail {

template <std::floating_point T>
struct FlatShapesT {
    /// Pairs of triangles, in the order in which the input completes them.
    std::vector<QuadT<T>> quads;
    /// The triangles without a partner, in the order of the input.
    std::vector<TriangleT<T>> triangles;
};

/// Joins pairs of triangles that share an edge, face the same way and form a
/// parallelogram. Files often split a wall or a lamp into two triangles. One quad costs
/// half as much as two triangles, and the lamp becomes a single light. The fourth
/// vertex may be off the parallelogram by a few units in the last place of a double,
/// because the decimals of a file are rounded.
/// \return Every triangle, unchanged or as half of a quad with the same normal.
/// \cost O(n log n) for n triangles.
template <std::floating_point T>
[[nodiscard]] FlatShapesT<T>
pair_triangles(const std::vector<glm::dvec3>& vertices,
               const std::vector<std::array<std::uint32_t, 3>>& indices) {
    const auto number = first_equal_points(vertices);

    FlatShapesT<T> shapes;
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    std::map<Edge, std::pair<std::size_t, int>>
        waiting; // the triangle, and the corner opposite to the edge
    std::vector<bool> paired(indices.size(), false);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const auto corner = [&](std::size_t triangle, int k) {
            return number[indices[triangle][static_cast<std::size_t>(k % 3)]];
        };
        for (int k = 0; k < 3 && !paired[i]; ++k) {
            // The partner has the same edge in the opposite direction.
            const auto found = waiting.find({corner(i, k + 2), corner(i, k + 1)});
            if (found == waiting.end() || paired[found->second.first]) continue;
            const auto [partner, opposite] = found->second;
            const glm::dvec3& a = vertices[corner(partner, opposite)];
            const glm::dvec3& b = vertices[corner(partner, opposite + 1)];
            const glm::dvec3& c = vertices[corner(partner, opposite + 2)];
            const glm::dvec3& d = vertices[corner(i, k)];
            const double size =
                std::max({max_component(glm::abs(a)), max_component(glm::abs(b)),
                          max_component(glm::abs(c))});
            const glm::dvec3 gap = glm::abs((a - b) + (d - c));
            if (!(max_component(gap) <=
                  8 * std::numeric_limits<double>::epsilon() * size))
                continue;
            paired[i] = paired[partner] = true;
            shapes.quads.push_back(
                {.corner{a}, .edge_u = Vec3T<T>{b - a}, .edge_v = Vec3T<T>{c - a}});
        }
        if (paired[i]) continue;
        for (int k = 0; k < 3; ++k)
            waiting[{corner(i, k + 1), corner(i, k + 2)}] = {i, k};
    }
    for (std::size_t i = 0; i < indices.size(); ++i)
        if (!paired[i])
            shapes.triangles.push_back({.v1 = Vec3T<T>{vertices[indices[i][0]]},
                                        .v2 = Vec3T<T>{vertices[indices[i][1]]},
                                        .v3 = Vec3T<T>{vertices[indices[i][2]]}});
    return shapes;
}

} // namespace ljus::detail
