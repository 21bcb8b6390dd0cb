#pragma once

/// \file ljus/geometry/detail/field_on_ray.hpp
/// \brief Where a function of t with known bounds first gets to 0: two solvers that
/// look for it, sphere tracing and interval bisection.

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
/// \brief Section 2.1: isosurfaces. A field is above 0 inside, below 0 outside.
/// Chapter: \ref ch_metaballs.
/// \{

namespace detail {

/// All numbers from `low` to `high`.
template <std::floating_point T>
struct IntervalT {
    T low = T(0);  ///< The least.
    T high = T(0); ///< The largest.
};

/// A field as a ray sees it: f(O + tD), a function of t, that is below 0 outside of
/// [enter, leave] and that `steepest()` bounds the slope of.
template <typename L, typename T>
concept FieldOnRay = requires(const L& line, T t) {
    { line.enter } -> std::convertible_to<T>;
    { line.leave } -> std::convertible_to<T>;
    { line.value(t) } -> std::same_as<T>;
    { line.steepest() } -> std::same_as<T>;
    { line.range(t, t) } -> std::same_as<IntervalT<T>>;
};

/// A field on a ray that also bounds its slope over a part of the ray.
template <typename L, typename T>
concept SlopeOnRay = FieldOnRay<L, T> && requires(const L& line, T t) {
    { line.slope(t, t) } -> std::same_as<IntervalT<T>>;
};

} // namespace detail

/// Solver: steps along the ray that can never jump over the surface \cite hart1996.
struct SphereTracing {
    double tolerance = 1e-9; ///< A hit is where |f| falls to this.
    int max_steps = 2000;    ///< Then it gives up: a miss.
};

/// Solver: halves the ray until each part either cannot hold the surface or surely
/// holds one crossing \cite mitchell1990.
struct Bisection {
    int max_parts = 4096; ///< Then it gives up: a miss.
};

namespace detail {

/// Where a ray first meets f = 0, by sphere tracing: |f| divided by the largest slope
/// is a distance in which f cannot get to 0.
/// \param solver  Tolerance and limit.
/// \param line    The field on the ray.
/// \param t_min   First t that counts.
/// \param t_max   Last t that counts.
/// \return The first t at which |f| is within the tolerance, always before the surface;
///         nothing for a miss, for NaN, and when the steps run out.
/// \cost An evaluation a step; the closer to grazing, the more of them.
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

/// The place where f changes its sign between a and b, to the last place of t.
template <std::floating_point T, FieldOnRay<T> Line>
[[nodiscard]] T bisect(const Line& line, T side, T a, T b) {
    for (int step = 0; step < 2 * std::numeric_limits<T>::digits; ++step) {
        const T middle = a + (b - a) / T(2);
        if (!(a < middle && middle < b)) break;
        (side * line.value(middle) > T(0) ? a : b) = middle;
    }
    return b;
}

/// Where a ray first meets f = 0, by interval bisection.
///
/// A part [a, b] of the ray is dropped if all its values have the sign of the start; if
/// not and the slope has one sign, the values at the ends decide; else it is halved,
/// the nearer half first. The values are bounded by what the field says and by the mean
/// value form f(m) + f'([a, b]) (b - a)/2.
/// \param solver  The limit.
/// \param line    The field on the ray.
/// \param t_min   First t that counts.
/// \param t_max   Last t that counts.
/// \return The first t at which f has changed its sign, to the last place; nothing for
///         a miss, for NaN, and when the parts run out. A surface that is touched and
///         not crossed is met if f is not below 0 at the ends of a part as short as two
///         units in the last place.
/// \cost Some 10 to 100 ranges, more where value and slope nearly vanish together. A
///       field without slope() needs about 1/sqrt(depth) of them where a ray dips in by
///       depth.
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
        // All on the other side: the surface was in the rounding just before.
        if (side > T(0) ? range.high < T(0) : range.low > T(0)) return a;
        if constexpr (SlopeOnRay<Line, T>) {
            const IntervalT<T> slope = line.slope(a, b);
            const T reach = glm::max(slope.high, -slope.low) * (b - a) / T(2);
            const T doubt = line.rounding() + std::abs(reach);
            if (side * line.value(middle) > doubt) continue;
            if (slope.low > T(0) || slope.high < T(0)) {       // one sign: ends decide
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
