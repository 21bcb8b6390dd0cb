#pragma once

/// \file ljus/accel/mesh_data.hpp
/// \brief The data of a mesh: vertices and triangles.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ljus/geometry/triangle.hpp"
#include "ljus/math/require.hpp"

namespace ljus {

/// \defgroup mesh_data The data of meshes
/// \brief A list of vertices, and triangles that share them. Chapter: \ref ch_triangle.
/// \{

/// Vertices and triangles. The vertices of a triangle turn counter-clockwise as seen
/// from outside.
template <std::floating_point T>
struct MeshDataT {
    std::vector<Vec3T<T>> positions{}; ///< Positions of vertices.
    std::vector<Vec3T<T>> normals{};   ///< Unit normals, one per vertex; or empty.
    /// The triangles, as indices of vertices.
    std::vector<std::array<std::uint32_t, 3>> triangles{};
    std::vector<Vec2T<T>> uv{}; ///< Texture coordinates, one per vertex; or empty.
};
using MeshData = MeshDataT<float>; ///< MeshDataT in float.

namespace detail {

template <std::floating_point T>
[[nodiscard]] TriangleT<T> triangle_of(const MeshDataT<T>& data,
                                       std::size_t part) noexcept {
    const auto& corner = data.triangles[part];
    return {data.positions[corner[0]], data.positions[corner[1]],
            data.positions[corner[2]]};
}

} // namespace detail

/// Refuses data from which no mesh can be built: a missing vertex, a number that is not
/// finite, or lists whose lengths do not match.
/// \throws std::invalid_argument  with the name of the list, the index and the value.
template <std::floating_point T>
void check(const MeshDataT<T>& data) {
    const auto place = [](const char* list, std::size_t i) {
        return detail::join({list, "[", std::to_string(i), "]"});
    };
    const auto count = [](std::size_t n) { return static_cast<long long>(n); };
    require(!data.triangles.empty() && data.triangles.size() < 0xffffffffu,
            "the number of a mesh's triangles", count(data.triangles.size()),
            "at least 1 and below 2^32 - 1");
    const auto one_per_vertex = [&](const char* what, std::size_t n) {
        require(n == 0 || n == data.positions.size(), what, count(n),
                "0 or that of its positions, " + std::to_string(data.positions.size()));
    };
    one_per_vertex("the number of a mesh's normals", data.normals.size());
    one_per_vertex("the number of a mesh's texture coordinates", data.uv.size());
    const auto all_finite = [&](const char* list, const std::vector<Vec3T<T>>& values) {
        for (std::size_t i = 0; i < values.size(); ++i)
            if (!is_finite(values[i])) require_finite(place(list, i), values[i]);
    };
    all_finite("mesh.positions", data.positions);
    all_finite("mesh.normals", data.normals);
    for (std::size_t i = 0; i < data.uv.size(); ++i)
        if (!std::isfinite(data.uv[i].x) || !std::isfinite(data.uv[i].y))
            require_finite(place("mesh.uv", i), Vec3T<T>{data.uv[i], T(0)});
    for (std::size_t i = 0; i < data.triangles.size(); ++i)
        for (const std::uint32_t corner : data.triangles[i])
            if (corner >= data.positions.size())
                require(false, place("mesh.triangles", i) + "'s vertex", count(corner),
                        "below the number of positions, " +
                            std::to_string(data.positions.size()));
}

/// Sets the normal of each vertex to the mean of the normals of its triangles, weighted
/// by the triangles' angles at the vertex. If a flat face is divided into other
/// triangles, this mean stays the same \cite thurmer1998. Vertices with different
/// indices stay separate, even at the same position, so that edges between them stay
/// sharp. A vertex that belongs to no triangle with an area gets (0, 0, 0), which
/// counts as no normal. The triangles must be as check() requires.
/// \cost O(n) for n triangles.
template <std::floating_point T>
void smooth_normals(MeshDataT<T>& data) {
    using Wide = Vec3T<WideT<T>>;
    std::vector<Wide> sums(data.positions.size(), Wide{0});
    for (std::size_t i = 0; i < data.triangles.size(); ++i) {
        const TriangleT<T> triangle = detail::triangle_of(data, i);
        if (!has_area(triangle)) continue;
        const Wide normal = glm::normalize(detail::cross_of_edges(triangle));
        const auto& corner = data.triangles[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const Wide here{data.positions[corner[k]]};
            const Wide a = Wide{data.positions[corner[(k + 1) % 3]]} - here;
            const Wide b = Wide{data.positions[corner[(k + 2) % 3]]} - here;
            const auto angle =
                std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
            sums[corner[k]] += angle * normal;
        }
    }
    data.normals.clear();
    for (const Wide& sum : sums) {
        const bool known = glm::dot(sum, sum) > 0;
        data.normals.emplace_back(known ? glm::normalize(sum) : Wide{0});
    }
}
/// \}

} // namespace ljus
