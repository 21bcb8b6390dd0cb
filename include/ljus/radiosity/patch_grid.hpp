#pragma once

/// \file ljus/radiosity/patch_grid.hpp
/// \brief Grids that divide the sides of shapes into cells.

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>

#include "ljus/radiosity/exchange_area.hpp"
#include "ljus/scene/world.hpp"

namespace ljus {

/// \defgroup patch_grid Grids of patches
/// \brief Section 2.2 of the report: where a patch lies on its shape, and in which
/// patch a point lies.
///
/// A point of a shape has coordinates in the unit square: u and v of a hit on a flat
/// shape, height and azimuth on a ball. Equal squares then have equal areas.
/// \{

namespace detail {

enum class GridKind : std::uint8_t {
    quad,     ///< Columns are numbered along u, rows along v.
    triangle, ///< columns^2 congruent triangles.
    ball,     ///< The same as `quad`, but its first and last rows are neighbours.
};

} // namespace detail

/// The cells of one side of a shape.
struct PatchGrid {
    ObjectId object{}; ///< The object whose side is divided.
    detail::GridKind kind = detail::GridKind::quad; ///< How the shape is divided.
    bool back = false;         ///< True for the side from which no light is emitted.
    bool inward = false;       ///< True for the side opposite to the shape's normal.
    std::uint32_t columns = 1; ///< Number of columns, at least 1.
    std::uint32_t rows = 1;    ///< Number of rows; equal to `columns` for a triangle.
    std::uint32_t first = 0;   ///< The index of the first patch of this grid.

    /// The number of cells.
    [[nodiscard]] constexpr std::uint32_t size() const noexcept {
        return columns * rows;
    }
    /// The number of vertices.
    [[nodiscard]] constexpr std::uint32_t vertices() const noexcept {
        if (kind == detail::GridKind::triangle)
            return (columns + 1) * (columns + 2) / 2;
        return kind == detail::GridKind::ball ? (columns - 1) * rows + 2
                                              : (columns + 1) * (rows + 1);
    }
    /// True if all members are equal.
    friend bool operator==(const PatchGrid&, const PatchGrid&) = default;
};

namespace detail {
inline std::uint32_t cells_along(double length, double size) noexcept {
    // The limit prevents overflow. make_patches() refuses so many cells.
    return static_cast<std::uint32_t>(
        std::clamp(std::ceil(length / size * (1 - 1e-9)), 1.0, 1e6));
}
} // namespace detail

/// \name Grids for shapes
/// \{

/// The grid for the front of a shape. The edges of its cells are at most `size` long,
/// except for those of a ball towards its poles.
template <std::floating_point T>
[[nodiscard]] PatchGrid patch_grid(const QuadT<T>& shape, double size) noexcept {
    return {.columns = detail::cells_along(double(glm::length(shape.edge_u)), size),
            .rows = detail::cells_along(double(glm::length(shape.edge_v)), size)};
}
template <std::floating_point T>
[[nodiscard]] PatchGrid patch_grid(const TriangleT<T>& shape, double size) noexcept {
    const T longest = max_component(Vec3T<T>{glm::distance(shape.v1, shape.v2),
                                             glm::distance(shape.v2, shape.v3),
                                             glm::distance(shape.v3, shape.v1)});
    const std::uint32_t cells = detail::cells_along(double(longest), size);
    return {.kind = detail::GridKind::triangle, .columns = cells, .rows = cells};
}
template <std::floating_point T>
[[nodiscard]] PatchGrid patch_grid(const SphereT<T>& shape, double size) noexcept {
    const double half = std::numbers::pi * double(shape.radius);
    return {.kind = detail::GridKind::ball,
            .columns = std::max(2u, detail::cells_along(half, size)),
            .rows = std::max(3u, detail::cells_along(2 * half, size))};
}
/// \}

/// The position of a cell in its grid.
struct CellPlace {
    std::uint32_t column = 0; ///< Number of the column, along u.
    std::uint32_t row = 0;    ///< Number of the row, along v.
    bool upper = false;       ///< True for a triangle that stands on its tip.
};

/// The position of a cell, from its index within the grid.
[[nodiscard]] constexpr CellPlace place_of(const PatchGrid& grid,
                                           std::uint32_t cell) noexcept {
    if (grid.kind != detail::GridKind::triangle)
        return {cell % grid.columns, cell / grid.columns};
    std::uint32_t row = 0;
    while (cell >= 2 * (grid.columns - row) - 1) cell -= 2 * (grid.columns - row++) - 1;
    return {cell / 2, row, cell % 2 == 1};
}

/// The index, within its grid, of the cell that contains a point of the shape.
/// \param grid   The grid.
/// \param at     The coordinates (u, v) of the point; clamped to the unit square.
/// \param local  If not null, receives the coordinates of the point within the cell, in
///               [0, 1]^2.
[[nodiscard]] inline std::uint32_t cell_of(const PatchGrid& grid, const glm::dvec2& at,
                                           glm::dvec2* local = nullptr) noexcept {
    const double u = std::clamp(at.x, 0.0, 1.0) * grid.columns;
    const double v = std::clamp(at.y, 0.0, 1.0) * grid.rows;
    std::uint32_t column = std::min(static_cast<std::uint32_t>(u), grid.columns - 1);
    const std::uint32_t row = std::min(static_cast<std::uint32_t>(v), grid.rows - 1);
    const bool triangle = grid.kind == detail::GridKind::triangle;
    if (triangle) column = std::min(column, grid.columns - 1 - row);
    const glm::dvec2 inside{u - column, v - row};
    if (local != nullptr) *local = inside;
    if (!triangle) return row * grid.columns + column;
    const bool upper = inside.x + inside.y > 1 && column + row + 1 < grid.columns;
    return row * (2 * grid.columns - row) + 2 * column + (upper ? 1 : 0);
}

namespace detail {

template <typename S>
concept Cuttable = requires(const S& shape) {
    patch_grid(shape, 1.0);
};

/// The side of an object that a ray has hit.
template <std::floating_point T>
struct HitSideT {
    Vec3T<T> outer{T(0)}; ///< The shape's own normal at the hit.
    bool back = false;    ///< As PatchGrid::back.
};

template <AnyWorld W, std::floating_point T>
[[nodiscard]] HitSideT<T> side_of(const W& world, const RayT<T>& ray,
                                  const SceneHitT<T>& hit) {
    const Vec3T<T> outer = world.visit_shape(hit.object, [&](const auto& shape) {
        return surface_point(shape, ray, hit.at).normal;
    });
    const bool inward = glm::dot(ray.direction, outer) > T(0);
    return {outer, inward != world.object(hit.object).inside_out};
}

/// The coordinates of a hit on its shape, in the unit square. `outer_normal`, the
/// shape's own unit normal at the hit, is used on a ball only.
template <std::floating_point T>
[[nodiscard]] glm::dvec2 place_on(GridKind kind, const ShapeHitT<T>& hit,
                                  const Vec3T<T>& outer_normal) noexcept {
    if (kind != GridKind::ball) return {double(hit.u), double(hit.v)};
    const double turn = std::atan2(double(outer_normal.y), double(outer_normal.x)) *
                        std::numbers::inv_pi / 2;
    return {(1 - double(outer_normal.z)) / 2, turn < 0 ? turn + 1 : turn};
}

/// Samples a point of a cell, uniformly over its area, with the normal of the side that
/// the grid divides.
template <typename S, std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_cell(const PatchGrid& grid, const S& shape,
                                           std::uint32_t cell,
                                           const Vec2T<T>& u) noexcept {
    const CellPlace place = place_of(grid, cell);
    Vec2T<T> at{T(place.column), T(place.row)};
    SurfacePointT<T> point;
    if constexpr (std::same_as<S, TriangleT<T>>) {
        const Vec3T<T> b = sample_uniform_triangle(u);
        at += place.upper ? Vec2T<T>{T(1) - b.y, T(1) - b.z} : Vec2T<T>{b.y, b.z};
        point = point_at(shape, at.x / T(grid.columns), at.y / T(grid.columns));
    } else {
        point = sample_area(shape, Vec2T<T>{(at.x + u.x) / T(grid.columns),
                                            (at.y + u.y) / T(grid.rows)});
    }
    if (grid.inward) point.normal = -point.normal;
    return point;
}

/// A cell of a flat shape, with the normal of the side that the grid divides. `whole`
/// has the corners of the shape.
[[nodiscard]] inline Facet cell_facet(const PatchGrid& grid, const Facet& whole,
                                      std::uint32_t cell) noexcept {
    const CellPlace place = place_of(grid, cell);
    const glm::dvec3 u = whole.corners[1] - whole.corners[0];
    const glm::dvec3 v =
        whole.corners[static_cast<std::size_t>(whole.count) - 1] - whole.corners[0];
    const auto at = [&](std::uint32_t column, std::uint32_t row) {
        return whole.corners[0] + double(place.column + column) / grid.columns * u +
               double(place.row + row) / grid.rows * v;
    };
    Facet facet{{at(0, 0), at(1, 0), at(1, 1), at(0, 1)}, 4};
    if (grid.kind == GridKind::triangle)
        facet = place.upper ? Facet{{at(1, 0), at(1, 1), at(0, 1)}, 3}
                            : Facet{{at(0, 0), at(1, 0), at(0, 1)}, 3};
    return grid.inward ? turned(facet) : facet;
}

} // namespace detail

/// \}

} // namespace ljus
