#pragma once

/// \file ljus/geometry/ray.hpp
/// \brief The ray R(t) = O + tD, and the range of t that counts.

#include <cstdint>
#include <limits>
#include <optional>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup ray Rays
/// \brief Section 3.1.1: the ray. Chapter: \ref ch_ray.
/// \{

/// The part of a line from `t_min` to `t_max`.
///
/// The report allows every t >= 0, so that a ray which leaves a surface may hit that
/// surface again at t = 0: see offset_ray_origin() for the origin that avoids it.
/// A NaN or an infinity in a ray, a direction of zero, a t_min beyond t_max: such a ray
/// meets nothing.
/// \report{Definition 3.1}
// [ray]
template <std::floating_point T>
struct RayT {
    Vec3T<T> origin{T(0)};                        ///< O, in scene units.
    Vec3T<T> direction{T(0), T(0), T(-1)};        ///< D: any length but zero.
    T t_min = T(0);                               ///< First t that counts, >= 0.
    T t_max = std::numeric_limits<T>::infinity(); ///< Last t that counts.
    T time = T(0); ///< In [0, 1]: from when the shutter opens to when it closes.
};
using Ray = RayT<float>; ///< RayT in float.
// [ray]

/// The point of a ray at distance t, in units of the direction's length.
/// \param ray  The ray.
/// \param t    Any number.
/// \return O + tD.
/// \report{Definition 3.1}
// [at]
template <std::floating_point T>
[[nodiscard]] constexpr Vec3T<T> point_at(const RayT<T>& ray, T t) noexcept {
    return ray.origin + t * ray.direction;
}
// [at]

/// Where a ray meets a shape. Of a flat shape, u and v are coordinates along its edges;
/// other shapes may leave them 0.
template <std::floating_point T>
struct FlatHitT {
    T t = T(0);             ///< Distance, in units of the direction's length.
    T u = T(0);             ///< Coordinate along the first edge.
    T v = T(0);             ///< Coordinate along the second edge.
    std::uint32_t part = 0; ///< Which triangle of a mesh; 0 for other shapes.
};

/// \name Mistakes
/// \{

/// A mistake does not compile, and says why.
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

/// \name What a test prepares
/// A loop over many shapes is told its test once, as one template argument: a
/// precision, or the name of a test.
///
///     const auto prepared = prepare<Test>(ray);
///     for (const Triangle& triangle : mesh) intersect<Test>(ray, triangle, prepared);
/// \{

namespace detail {

/// A test that prepares nothing.
struct Unprepared {};

} // namespace detail

/// What a test computes once for a ray and then uses for every shape: nothing, in
/// general; prepare<Watertight>() is another.
template <typename Test = void, std::floating_point T>
[[nodiscard]] constexpr detail::Unprepared prepare(const RayT<T>&) noexcept {
    return {};
}

/// Where a ray meets a shape whose test has no use for what was prepared.
/// \tparam Test  As for intersect(ray, shape).
/// \param ray    The ray.
/// \param shape  The shape.
/// \return What intersect(ray, shape) returns.
template <typename Test = void, std::floating_point T, typename Shape,
          typename Prepared>
[[nodiscard]] constexpr auto intersect(const RayT<T>& ray, const Shape& shape,
                                       const Prepared&) noexcept {
    return intersect<Test>(ray, shape);
}
/// \}

/// \}

} // namespace ljus
