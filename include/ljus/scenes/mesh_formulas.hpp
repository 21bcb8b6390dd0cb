#pragma once

/// \file ljus/scenes/mesh_formulas.hpp
/// \brief Meshes computed from formulas: a sphere and a torus.

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "ljus/accel/mesh_data.hpp"
#include "ljus/geometry/sphere.hpp"

namespace ljus {

/// \defgroup mesh_formulas Meshes from formulas
/// \brief Meshes whose vertices lie on a known surface. Chapter: \ref ch_triangle.
/// \{

namespace detail {

// Triangles with vertices on the unit sphere.
struct UnitTriangles {
    using Triple = std::array<std::uint32_t, 3>;
    std::vector<glm::dvec3> points{};
    std::vector<Triple> triangles{}; // counter-clockwise, from outside
};

// An icosahedron. Its vertices are the corners of three rectangles with sides in the
// golden ratio g. Each rectangle lies in a plane of two axes.
[[nodiscard]] inline UnitTriangles icosahedron() {
    UnitTriangles solid;
    auto& n = solid.points;
    const double g = std::numbers::phi;
    for (const double a : {-1.0, 1.0})
        for (const double b : {-g, g})
            for (const glm::dvec3& v :
                 {glm::dvec3(0, a, b), glm::dvec3(a, b, 0), glm::dvec3(b, 0, a)})
                n.push_back(glm::normalize(v));
    // A face is a triple of neighbours. If the circumradius is sqrt(1 + g^2),
    // neighbours are 2 apart.
    const double edge = 2.0 / std::sqrt(1 + g * g);
    const auto near = [&](std::uint32_t a, std::uint32_t b) {
        return std::abs(glm::distance(n[a], n[b]) - edge) < 1e-9;
    };
    for (std::uint32_t a = 0; a < 12; ++a)
        for (std::uint32_t b = a + 1; b < 12; ++b)
            for (std::uint32_t c = b + 1; c < 12; ++c)
                if (near(a, b) && near(b, c) && near(c, a)) {
                    const bool outward = glm::dot(glm::cross(n[a], n[b]), n[c]) > 0;
                    solid.triangles.push_back({a, outward ? b : c, outward ? c : b});
                }
    return solid;
}

// Splits each triangle into four at the midpoints of its edges, which are moved onto
// the sphere.
inline void cut_in_four(UnitTriangles& mesh) {
    using Triple = UnitTriangles::Triple;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        auto& n = mesh.points;
        const auto [at, fresh] = middles.try_emplace(
            std::minmax(a, b), static_cast<std::uint32_t>(n.size()));
        if (fresh) n.push_back(glm::normalize(n[a] + n[b]));
        return at->second;
    };
    std::vector<Triple> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const Triple& part : {Triple{a, ab, ca}, Triple{ab, b, bc},
                                   Triple{ca, bc, c}, Triple{ab, bc, ca}})
            finer.push_back(part);
    }
    mesh.triangles = std::move(finer);
}

} // namespace detail

/// A sphere made of triangles. Each triangle of an icosahedron is split into four,
/// `cuts` times, which makes 20 * 4^cuts triangles. The vertices lie on the sphere and
/// have the sphere's normals.
/// \throws std::invalid_argument  if `cuts` is not within [0, 10].
template <std::floating_point T>
[[nodiscard]] MeshDataT<T> icosphere(const SphereT<T>& sphere, int cuts) {
    require(cuts >= 0 && cuts <= 10, "the number of cuts", static_cast<long long>(cuts),
            "within [0, 10]");
    detail::UnitTriangles ball = detail::icosahedron();
    for (int cut = 0; cut < cuts; ++cut) detail::cut_in_four(ball);
    MeshDataT<T> data{.triangles = std::move(ball.triangles)};
    for (const glm::dvec3& normal : ball.points) {
        data.positions.emplace_back(glm::dvec3(sphere.center) +
                                    double(sphere.radius) * normal);
        data.normals.emplace_back(normal);
    }
    return data;
}

/// A torus around an axis parallel to the y axis, with the normals of the torus.
/// \param center  Centre of the torus, in scene units.
/// \param large   Radius of the tube's centre line, in scene units.
/// \param small   Radius of the tube, in scene units. If it is below `large`, the torus
///                has a hole.
/// \param around  Segments around the axis, 3 to 10000.
/// \param across  Segments around the tube, 3 to 10000.
/// \return A mesh with 2 * around * across triangles.
/// \throws std::invalid_argument  if a number of segments is not within [3, 10000].
template <std::floating_point T>
[[nodiscard]] MeshDataT<T> torus(const Vec3T<T>& center, T large, T small, int around,
                                 int across) {
    for (const long long segments : {around, across})
        require(segments >= 3 && segments <= 10000, "the number of segments", segments,
                "within [3, 10000]");
    MeshDataT<T> data;
    const auto number = [&](int i, int k) {
        return static_cast<std::uint32_t>((i % around) * across + k % across);
    };
    for (int i = 0; i < around; ++i)
        for (int k = 0; k < across; ++k) {
            const double phi = 2 * std::numbers::pi * i / around;
            const double theta = 2 * std::numbers::pi * k / across;
            const glm::dvec3 out(std::cos(phi), 0, -std::sin(phi));
            const glm::dvec3 normal =
                std::cos(theta) * out + glm::dvec3(0, std::sin(theta), 0);
            data.positions.emplace_back(glm::dvec3(center) + double(large) * out +
                                        double(small) * normal);
            data.normals.emplace_back(normal);
            const std::uint32_t a = number(i, k), b = number(i + 1, k);
            const std::uint32_t c = number(i + 1, k + 1), d = number(i, k + 1);
            data.triangles.push_back({a, b, c});
            data.triangles.push_back({a, c, d});
        }
    return data;
}

/// \}

} // namespace ljus
