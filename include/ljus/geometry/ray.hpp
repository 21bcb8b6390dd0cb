#pragma once

/// \file ljus/geometry/ray.hpp
/// \brief The ray R(t) = O + tD, limited to a range of t.

#include <cstdint>
#include <limits>
#include <optional>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup ray Rays
/// \brief Section 3.1.1 of the report: the ray. Chapter: \ref ch_ray.
/// \{

/// The points O + tD of a line with t from `t_min` to `t_max`.
///
/// The report allows every t >= 0. A ray that leaves a surface may then hit the same
/// surface again at t = 0; spawn_ray() avoids this. A ray hits nothing if its direction
/// is zero, if its range is empty or NaN, or if its origin or its direction is not
/// finite. `t_max` may be infinite.
/// \report{Definition 3.1}
// [ray]
template <std::floating_point T>
struct RayT {
    Vec3T<T> origin{T(0)};                 ///< The origin O, in scene units.
    Vec3T<T> direction{T(0), T(0), T(-1)}; ///< The direction D, of any length except 0.
    T t_min = T(0);                        ///< The smallest t of a hit, >= 0.
    T t_max = std::numeric_limits<T>::infinity(); ///< The largest t of a hit.
    T time = T(0); ///< The time in [0, 1]: the shutter opens at 0 and closes at 1.
};
using Ray = RayT<float>; ///< RayT in float.
// [ray]

/// The point O + tD of a ray. t is any number, in units of the direction's length.
/// \report{Definition 3.1}
// [at]
template <std::floating_point T>
[[nodiscard]] constexpr Vec3T<T> point_at(const RayT<T>& ray, T t) noexcept {
    return ray.origin + t * ray.direction;
}
// [at]

/// The hit of a ray on a shape. Some shapes leave u and v at 0.
template <std::floating_point T>
struct ShapeHitT {
    T t = T(0);             ///< Distance, in units of the direction's length.
    T u = T(0);             ///< Surface coordinate, e.g. along the first edge.
    T v = T(0);             ///< Surface coordinate, e.g. along the second edge.
    std::uint32_t part = 0; ///< Index of a mesh's triangle; 0 for other shapes.
};

/// \name Diagnostics
/// \{

/// A compile-time error for swapped arguments and for mixed precisions.
template <std::floating_point T, typename Other>
requires(!std::same_as<T, Other>) Vec3T<T> point_at(const RayT<T>&, Other) {
    static_assert(sizeof(Other) == 0, "A ray of floats takes a float: 2.0f, not 2.");
    return {};
}
template <typename Test = void, typename Shape, std::floating_point T>
std::optional<T> intersect(const Shape&, const RayT<T>&) {
    static_assert(sizeof(T) == 0, "The ray comes first: intersect(ray, shape).");
    return {};
}
template <typename Test = void, std::floating_point T,
          template <std::floating_point> typename ShapeT, std::floating_point Other>
requires(!std::same_as<T, Other>) std::optional<T> intersect(const RayT<T>&,
                                                             const ShapeT<Other>&) {
    static_assert(sizeof(T) == 0, "The ray and the shape have two precisions.");
    return {};
}
/// \}

/// \name Preparation for many shapes
/// `Test` is the precision or the name of an intersection test.
///
///     const auto prepared = prepare<Test>(ray);
///     for (const Triangle& triangle : mesh) intersect<Test>(ray, triangle, prepared);
/// \{

namespace detail {

struct Unprepared {};

} // namespace detail

/// Computes, once per ray, the data that an intersection test uses for every shape.
/// Only Watertight needs such data.
template <typename Test = void, std::floating_point T>
[[nodiscard]] constexpr detail::Unprepared prepare(const RayT<T>&) noexcept {
    return {};
}

/// Intersects a ray with a shape by a test that needs no preparation.
template <typename Test = void, std::floating_point T, typename Shape,
          typename Prepared>
[[nodiscard]] constexpr auto intersect(const RayT<T>& ray, const Shape& shape,
                                       const Prepared&) noexcept {
    return intersect<Test>(ray, shape);
}
/// \}

/// \}

} // namespace ljus
