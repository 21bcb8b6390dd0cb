#pragma once

/// \file ljus/geometry/watertight.hpp
/// \brief A ray-triangle test through which no ray slips between two neighbours.

#include <limits>
#include <optional>

#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/triangle.hpp"

namespace ljus {

/// \defgroup watertight Watertight triangles
/// \brief Section 3.1.5 once more, with a promise about shared edges.
/// Chapter: \ref ch_triangle.
/// \{

/// In place of a precision: `intersect<Watertight>(ray, triangle)`. Where a loop or a
/// tree takes a precision for all its shapes, it takes this as well; a sphere, which
/// has no neighbours, is then met as always, and a quad in double.
struct Watertight {};

namespace detail {

/// Which axis a ray mostly follows, and how the other two lean. The same for all
/// triangles.
template <std::floating_point T>
struct ShearT {
    int x = 0;     ///< The axis that becomes x,
    int y = 1;     ///< and the one that becomes y.
    int z = 2;     ///< The axis along which the direction is longest.
    T sx = T(0);   ///< \f$ D_x / D_z \f$, in [-1, 1].
    T sy = T(0);   ///< \f$ D_y / D_z \f$, in [-1, 1].
    double sz = 1; ///< \f$ 1 / D_z \f$; beyond the range of T for a denormal direction.
};

} // namespace detail

/// The shear that turns a ray into the z axis.
/// \tparam Test  Watertight.
/// \param ray    A ray. A direction of zero, NaN or infinity gives NaN or an sz of 0,
///               and no hit.
/// \return Axes and factors.
template <std::same_as<Watertight> Test, std::floating_point T>
[[nodiscard]] detail::ShearT<T> prepare(const RayT<T>& ray) noexcept {
    const Vec3T<T> size = detail::sizes(ray.direction);
    const int z = size.x > size.y ? (size.x > size.z ? 0 : 2) : size.y > size.z ? 1 : 2;
    const int x = z == 2 ? 0 : z + 1, y = x == 2 ? 0 : x + 1;
    const T* const d = &ray.direction.x;
    return {.x = x,
            .y = y,
            .z = z,
            .sx = d[x] / d[z],
            .sy = d[y] / d[z],
            .sz = 1 / static_cast<double>(d[z])};
}
/// Where a ray meets a triangle, so that of two triangles with a common edge at least
/// one is hit by a ray at that edge, and of a fan at least one by a ray at its hub.
///
/// The ray becomes the z axis; what is left is whether a triangle of the plane holds
/// the origin: whether \f$ P_x Q_y - P_y Q_x \f$ has one sign on all three edges. A
/// vertex gets the same rounded \f$P\f$ in all its triangles; and the products of two
/// floats are formed in double, where they are exact: the sign is that of exact
/// arithmetic, with and without fused multiply-adds. Triangles that share their corners
/// and decide exactly leave no gap \cite woop2013.
///
/// \tparam Test     Watertight.
/// \param ray       Any length of direction but zero; hits count in [t_min, t_max].
/// \param triangle  Any three vertices; one without an area is never hit.
/// \param shear     Of this ray: what prepare() returned.
/// \return t, and the barycentric u, v; nothing for a miss or a non-finite input.
/// \cost Most rays miss after 6 products; one that hits needs 6 more for its edges, one
///       division, and 7 products for t, u and v.
/// \report{Section 3.1.5}
// [intersect]
template <std::same_as<Watertight> Test, std::floating_point T>
[[nodiscard]] std::optional<FlatHitT<T>>
intersect(const RayT<T>& ray, const TriangleT<T>& triangle,
          const detail::ShearT<T>& shear) noexcept {
    // Wide enough for the product of two Ts.
    using W = std::conditional_t<std::is_same_v<T, float>, double, long double>;
    const T* const o = &ray.origin.x;
    const auto corner = [&](const Vec3T<T>& vertex) {
        const T* const p = &vertex.x;
        const T x = p[shear.x] - o[shear.x];
        const T y = p[shear.y] - o[shear.y];
        const T z = p[shear.z] - o[shear.z];
        return Vec3T<T>(static_cast<T>(W(x) - W(shear.sx) * W(z)),
                        static_cast<T>(W(y) - W(shear.sy) * W(z)), z);
    };
    const Vec3T<T> a = corner(triangle.v1), b = corner(triangle.v2),
                   c = corner(triangle.v3);
    // Most triangles lie beside the axis, for each of two coordinates.
    const Vec3T<T> low = glm::min(a, glm::min(b, c)),
                   high = glm::max(a, glm::max(b, c));
    if (low.x > 0 || low.y > 0 || high.x < 0 || high.y < 0) return std::nullopt;

    const auto edge = [](const Vec3T<T>& p, const Vec3T<T>& q) {
        return W(p.x) * W(q.y) - W(p.y) * W(q.x); // edge(q, p) is exactly -edge(p, q)
    };
    const W u = edge(a, c), v = edge(b, a), w = edge(c, b);
    // Written so that NaN is a miss; on an edge is inside.
    if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)))
        return std::nullopt;

    const W inverse = W(1) / (u + v + w); // infinite without an area
    const W t = (w * W(a.z) + u * W(b.z) + v * W(c.z)) * inverse * W(shear.sz);
    constexpr W max{std::numeric_limits<T>::max()};
    if (!(W(ray.t_min) <= t && t <= W(ray.t_max) && t <= max && shear.sz != 0))
        return std::nullopt;
    // Sheared and rounded, corners on a line may span a triangle.
    if (!detail::has_area(triangle)) return std::nullopt;
    return FlatHitT<T>{static_cast<T>(t), static_cast<T>(u * inverse),
                       static_cast<T>(v * inverse), 0};
}
// [intersect]

// Doxygen takes these two for their namesakes with another precision.
/// \cond
// The same for one triangle alone: two divisions more, which a loop prepares once.
template <std::same_as<Watertight> Test, std::floating_point T>
[[nodiscard]] std::optional<FlatHitT<T>>
intersect(const RayT<T>& ray, const TriangleT<T>& triangle) noexcept {
    return intersect<Test>(ray, triangle, prepare<Test>(ray));
}

// Quads have edges of their own, rounded for each: what their data leave open, no test
// can close. In double their borders are closed as well as can be.
template <std::same_as<Watertight> Test, std::floating_point T>
[[nodiscard]] std::optional<FlatHitT<T>> intersect(const RayT<T>& ray,
                                                   const QuadT<T>& quad) noexcept {
    return intersect<WideT<T>>(ray, quad);
}
/// \endcond

/// \}

} // namespace ljus
