#pragma once

/// \file ljus/geometry/detail/quartic_formula.hpp
/// \brief Ferrari's formula for the quartic, as textbooks print it.

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>

#include "ljus/version.hpp"

namespace ljus {

/// \defgroup quartic_formula The quartic formula
/// \brief Section 2.1: "without having to use numerical algorithms". Chapter:
/// \ref ch_metaballs.
/// \{

namespace detail {

/// Real roots, unsorted.
template <std::floating_point T>
struct QuarticRootsT {
    std::array<T, 4> at{}; ///< The first `count` are roots.
    std::size_t count = 0; ///< Number of roots.
    /// Iterator to the first root.
    [[nodiscard]] const T* begin() const noexcept { return at.data(); }
    /// Iterator past the last root.
    [[nodiscard]] const T* end() const noexcept { return at.data() + count; }
};

/// The real roots of c[0] + c[1] x + ... + c[4] x^4 by radicals (Ferrari 1545), for
/// comparison. Use roots() of a BernsteinT instead.
///
/// The substitution \f$ x = y - b/4 \f$ gives \f$ y^4 + p y^2 + q y + r = 0 \f$. A root
/// z of the resolvent \f$ z^3 - \frac p2 z^2 - r z + \frac{pr}{2} - \frac{q^2}{8} \f$
/// turns this into a difference of two squares, and so into two quadratics. Each step
/// subtracts numbers that may be nearly equal, and decides by the sign of rounded
/// numbers.
/// \param c  The coefficients; the last is not 0.
/// \return The roots, accurate to about half of T's digits or better if they are well
///         separated and the last coefficient is not small; otherwise unreliable.
/// \cost One cosine or cube root, and up to 4 square roots; no loop.
/// \report{Section 2.1} \cite schwarze1990
template <std::floating_point T>
[[nodiscard]] QuarticRootsT<T> quartic_formula(const std::array<T, 5>& c) noexcept {
    const T b = c[3] / c[4], d = c[2] / c[4], e = c[1] / c[4], f = c[0] / c[4];
    const T p = d - T(3) / T(8) * b * b;
    const T q = e - b * d / T(2) + b * b * b / T(8);
    const T r = f - b * e / T(4) + b * b * d / T(16) - T(3) / T(256) * b * b * b * b;

    // One real root z of the resolvent cubic, by Cardano or by the cosine.
    const T b3 = -p / T(2), c3 = -r, d3 = r * p / T(2) - q * q / T(8);
    const T p3 = (c3 - b3 * b3 / T(3)) / T(3);
    const T q3 = (T(2) / T(27) * b3 * b3 * b3 - b3 * c3 / T(3) + d3) / T(2);
    const T discriminant = q3 * q3 + p3 * p3 * p3;
    T z = -b3 / T(3);
    if (discriminant < T(0)) {
        const T size = std::sqrt(-p3);
        z += T(2) * size * std::cos(std::acos(-q3 / (size * size * size)) / T(3));
    } else {
        const T root = std::sqrt(discriminant);
        z += std::cbrt(root - q3) - std::cbrt(root + q3);
    }

    // (y^2 + z)^2 = (v y - w)^2
    constexpr T nothing = T(1e-9); // Schwarze's, independent of the quartic's scale
    const auto positive = [](T x) { return std::abs(x) < nothing ? T(0) : x; };
    const T u2 = positive(z * z - r), v2 = positive(T(2) * z - p);
    QuarticRootsT<T> result;
    if (!(u2 >= T(0) && v2 >= T(0))) return result;
    const T w = std::copysign(std::sqrt(u2), q), v = std::sqrt(v2);
    for (const T sign : {T(-1), T(1)}) {
        const T half = -sign * v / T(2); // of y^2 + sign v y + z - sign w
        const T under = positive(half * half - (z - sign * w));
        if (!(under >= T(0))) continue;
        result.at[result.count++] = half - std::sqrt(under) - b / T(4);
        result.at[result.count++] = half + std::sqrt(under) - b / T(4);
    }
    return result;
}

} // namespace detail

/// \}

} // namespace ljus
