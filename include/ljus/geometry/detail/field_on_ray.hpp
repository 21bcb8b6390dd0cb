#pragma once

/// \file ljus/geometry/detail/field_on_ray.hpp
/// \brief Two solvers for the first zero of a field along a ray: sphere tracing and
/// interval bisection.

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>

#include <glm/common.hpp>

#include "ljus/version.hpp"

namespace ljus {

/// \defgroup isosurface Isosurfaces
/// \brief Section 2.1 of the report: an isosurface is where a field is 0. The field is
/// positive inside and negative outside. Chapter: \ref ch_metaballs.
/// \{

namespace detail {

template <std::floating_point T>
struct IntervalT {
    T low = T(0);  ///< The lower end of the interval.
    T high = T(0); ///< The upper end of the interval.
};

/// A field f along a ray O + tD, as a function of t. f is negative outside [enter,
/// leave]. `value(t)` is f, `steepest()` is a bound on the absolute slope of f, and
/// `range(a, b)` contains all values of f for t in [a, b].
template <typename L, typename T>
concept FieldOnRay = requires(const L& line, T t) {
    { line.enter } -> std::convertible_to<T>;
    { line.leave } -> std::convertible_to<T>;
    { line.value(t) } -> std::same_as<T>;
    { line.steepest() } -> std::same_as<T>;
    { line.range(t, t) } -> std::same_as<IntervalT<T>>;
};

/// A field along a ray that also has `slope(a, b)`, which contains all slopes of f for
/// t in [a, b], and `rounding()`, a bound on the rounding error of value().
template <typename L, typename T>
concept SlopeOnRay = FieldOnRay<L, T> && requires(const L& line, T t) {
    { line.slope(t, t) } -> std::same_as<IntervalT<T>>;
    { line.rounding() } -> std::same_as<T>;
};

} // namespace detail

/// A solver that steps along the ray and never jumps over the surface \cite hart1996.
struct SphereTracing {
    double tolerance = 1e-9; ///< The largest |f| at a hit.
    int max_steps = 2000;    ///< Number of steps after which the ray counts as a miss.
};

/// A solver that halves the ray until each interval either cannot contain the surface
/// or contains exactly one crossing \cite mitchell1990.
struct Bisection {
    int max_parts = 4096; ///< Number of intervals after which the ray counts as a miss.
};

namespace detail {

/// Finds the first zero of a field f along a ray by sphere tracing. Each step is |f|
/// over the largest slope: within this distance f cannot reach 0.
/// \return The first t at which |f| is at most the tolerance; it lies before the
///         surface. Nothing for a miss, for NaN, or if the steps run out.
/// \cost One evaluation per step. A ray that passes closer to the surface takes more
///       steps.
// [sphere_tracing]
template <std::floating_point T, FieldOnRay<T> Line>
[[nodiscard]] std::optional<T> first_meeting(const SphereTracing& solver,
                                             const Line& line, T t_min, T t_max) {
    T t = glm::max(t_min, T(line.enter));
    const T end = glm::min(t_max, T(line.leave));
    const T steepest = line.steepest();
    const T side = std::copysign(T(1), line.value(t));
    for (int step = 0; step < solver.max_steps && t <= end; ++step) {
        const T distance = side * line.value(t);
        if (!(distance > T(solver.tolerance)))
            return distance == distance ? std::optional<T>(t) : std::nullopt;
        t += distance / steepest;
    }
    return std::nullopt;
}
// [sphere_tracing]

/// Finds by bisection the t between a and b where f changes its sign, to the last bit.
/// `side` is the sign of f at a.
template <std::floating_point T, FieldOnRay<T> Line>
[[nodiscard]] T bisect(const Line& line, T side, T a, T b) {
    for (int step = 0; step < 2 * std::numeric_limits<T>::digits; ++step) {
        const T middle = a + (b - a) / T(2);
        if (!(a < middle && middle < b)) break;
        (side * line.value(middle) > T(0) ? a : b) = middle;
    }
    return b;
}

/// Finds the first zero of a field f along a ray by interval bisection.
///
/// An interval [a, b] is dropped if all values of f in it have the sign of f at the
/// start of the ray. If the slope has one sign in [a, b], the values at a and b tell
/// whether f is 0 in between. Otherwise the interval is halved, and the nearer half is
/// tried first. The values are bounded by range(), and for a SlopeOnRay also by the
/// value at the middle and the largest slope times (b - a)/2.
/// \return The first t at which f has changed its sign, to the last bit. Nothing for a
///         miss, for NaN, or if the intervals run out. A ray that only touches the
///         surface may miss it.
/// \cost Some 10 to 100 calls of range(), more where f and its slope are both almost 0.
///       Without slope(), a ray that dips below the surface by d needs about 1/sqrt(d)
///       calls.
// [bisection]
template <std::floating_point T, FieldOnRay<T> Line>
[[nodiscard]] std::optional<T> first_meeting(const Bisection& solver, const Line& line,
                                             T t_min, T t_max) {
    struct Part {
        T a, b;
    };
    std::array<Part, std::numeric_limits<T>::digits + 64> parts;
    std::size_t count = 0;
    const T start = glm::max(t_min, T(line.enter)),
            end = glm::min(t_max, T(line.leave));
    const T side = std::copysign(T(1), line.value(start));
    if (start <= end) parts[count++] = {start, end};

    for (int tried = 0; count > 0 && tried < solver.max_parts; ++tried) {
        const auto [a, b] = parts[--count];
        const T middle = a + (b - a) / T(2);
        const IntervalT<T> range = line.range(a, b);
        if (side > T(0) ? range.low > T(0) : range.high < T(0)) continue;
        // All values have the other sign. The surface is just before a, but rounding
        // hid it.
        if (side > T(0) ? range.high < T(0) : range.low > T(0)) return a;
        if constexpr (SlopeOnRay<Line, T>) {
            const IntervalT<T> slope = line.slope(a, b);
            const T reach = glm::max(slope.high, -slope.low) * (b - a) / T(2);
            const T doubt = line.rounding() + std::abs(reach);
            if (side * line.value(middle) > doubt) continue;
            if (slope.low > T(0) || slope.high < T(0)) { // one sign: the ends decide
                if (!(side * line.value(b) <= T(0))) continue; // or NaN
                return bisect(line, side, a, b);
            }
        }
        if (!(a < middle && middle < b) || count + 2 > parts.size()) {
            if (side * line.value(b) <= T(0)) return b;
            continue;
        }
        parts[count++] = {middle, b};
        parts[count++] = {a, middle};
    }
    return std::nullopt;
}
// [bisection]

} // namespace detail

/// \}

} // namespace ljus
