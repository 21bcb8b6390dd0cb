#pragma once

/// \file ljus/geometry/isosurface.hpp
/// \brief Isosurfaces f(X) = 0 of fields with a Lipschitz bound.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>

#include "ljus/geometry/detail/field_on_ray.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/geometry/surface_point.hpp"
#include "ljus/geometry/triangle.hpp"
#include "ljus/math/require.hpp"

namespace ljus {

/// \addtogroup isosurface
/// \{

/// A field with its value and its gradient at a point. `lipschitz()` is a bound on the
/// length of the gradient.
template <typename F>
concept LipschitzField = requires(const F& field, Vec3T<double> x) {
    { field.value(x) } -> std::same_as<double>;
    { field.gradient(x) } -> std::same_as<Vec3T<double>>;
    { field.lipschitz() } -> std::same_as<double>;
};

/// The surface where a field is 0.
/// \report{Section 2.1}
template <std::floating_point T, LipschitzField Field>
struct IsosurfaceT {
    Field field{};       ///< The field, positive inside and negative outside.
    SphereT<T> bounds{}; ///< A sphere around the whole surface, with a margin.
};
template <LipschitzField Field>
using Isosurface = IsosurfaceT<float, Field>; ///< IsosurfaceT in float.

namespace detail {

/// The field of an isosurface along a ray. It satisfies FieldOnRay.
template <LipschitzField Field>
struct LipschitzLine {
    const Field& field; ///< The field.
    RayT<double> ray{}; ///< The ray.
    double length = 0;  ///< Length of the ray's direction.
    double enter = 0;   ///< The t at which the ray enters the bounds.
    double leave = 0;   ///< The t at which the ray leaves the bounds.

    [[nodiscard]] double value(double t) const { return field.value(point_at(ray, t)); }
    [[nodiscard]] double steepest() const { return field.lipschitz() * length; }
    [[nodiscard]] IntervalT<double> range(double a, double b) const {
        const double middle = value(a + (b - a) / 2), reach = steepest() * (b - a) / 2;
        return {middle - reach, middle + reach};
    }
};

} // namespace detail

/// The distance at which a ray first hits an isosurface.
/// \tparam Solver  SphereTracing or Bisection.
/// \return The distance in units of the direction's length, computed in double; nothing
///         for a miss, or if the solver gives up.
template <typename Solver = SphereTracing, std::floating_point T, LipschitzField Field>
[[nodiscard]] std::optional<T> intersect(const RayT<T>& ray,
                                         const IsosurfaceT<T, Field>& surface,
                                         const Solver& solver = {}) {
    const auto inside = chord<double>(ray, surface.bounds);
    if (!inside) return std::nullopt;
    const RayT<double> wide{Vec3T<double>(ray.origin), Vec3T<double>(ray.direction)};
    const detail::LipschitzLine<Field> line{
        surface.field, wide, glm::length(wide.direction), inside->enter, inside->leave};
    const auto t =
        detail::first_meeting(solver, line, double(ray.t_min), double(ray.t_max));
    if (!t || !(*t <= std::numeric_limits<T>::max())) return std::nullopt;
    return static_cast<T>(*t);
}

namespace detail {

/// Projects the hit of a ray at t onto the surface of a field f, by one Newton step
/// along the gradient. The step is taken only if it is no longer than the error of t.
/// If the gradient is 0, the normal faces the ray. `value(x)` is f, and `rounding` is a
/// bound on the error of f, including the solver's tolerance.
template <std::floating_point T, typename Value, typename Gradient>
[[nodiscard]] SurfacePointT<T> refined(const Value& value, const Gradient& gradient,
                                       const RayT<T>& ray, T t, double rounding) {
    using Wide = Vec3T<double>;
    const Wide o(ray.origin), d(ray.direction);
    Wide x = o + double(t) * d;
    const double unit = double(std::numeric_limits<T>::epsilon()) / 2;
    Wide g = gradient(x);
    // The error along the ray is the error of f over the slope of f. Where the slope is
    // 0, f behaves like a square, and the error along the ray is the square root of the
    // error of f.
    const double doubt =
        std::max(8 * unit * (glm::length(o) + double(t) * glm::length(d)),
                 std::min(rounding / glm::length(g), std::sqrt(rounding)));
    const double step = value(x) / glm::dot(g, g);
    if (!(glm::dot(g, g) > 0))
        g = d;
    else if (std::abs(step) * glm::length(g) <= doubt)
        x -= step * g;
    if (const Wide there = gradient(x); glm::dot(there, there) > 0) g = there;

    const double left = (std::abs(value(x)) + rounding) / glm::length(g);
    const double error = left < doubt ? left : doubt;
    return {.position = Vec3T<T>(x),
            .error = Vec3T<T>(static_cast<T>(error)) +
                     rounding_bound<T>(2) * glm::abs(Vec3T<T>(x)),
            .normal = Vec3T<T>(-glm::normalize(g))};
}

} // namespace detail

/// The point of an isosurface that a ray hit, projected onto the surface.
template <std::floating_point T, LipschitzField Field>
[[nodiscard]] SurfacePointT<T> surface_point(const IsosurfaceT<T, Field>& surface,
                                             const RayT<T>& ray,
                                             const ShapeHitT<T>& hit) {
    return detail::refined([&](const auto& x) { return surface.field.value(x); },
                           [&](const auto& x) { return surface.field.gradient(x); },
                           ray, hit.t, 4 * SphereTracing{}.tolerance);
}

/// A sphere around the isosurface: its member `bounds`.
template <std::floating_point T, LipschitzField Field>
[[nodiscard]] SphereT<T>
bounding_sphere(const IsosurfaceT<T, Field>& surface) noexcept {
    return surface.bounds;
}

/// Checks an isosurface: the centre of `bounds` must be finite, and its radius and the
/// Lipschitz bound finite and above 0.
/// \throws std::invalid_argument  with the name and the value of the member.
template <std::floating_point T, LipschitzField Field>
void check(const IsosurfaceT<T, Field>& surface) {
    require_finite("isosurface.bounds.center", surface.bounds.center);
    require_positive("isosurface.bounds.radius", surface.bounds.radius);
    require_positive("isosurface.field.lipschitz()", surface.field.lipschitz());
}

/// \}

} // namespace ljus
