#pragma once

/// \file ljus/math/rounding.hpp
/// \brief How far rounding can move the result of a computation.

#include <limits>

#include "ljus/math/vector.hpp"

namespace ljus::detail {

/// A bound on the relative error of n roundings in a row: n u / (1 - n u), where u is
/// the unit roundoff of T.
template <std::floating_point T>
[[nodiscard]] constexpr T rounding_bound(int n) noexcept {
    const T nu = T(n) * std::numeric_limits<T>::epsilon() / T(2);
    return nu / (T(1) - nu);
}

/// The sum of the absolute values of the components. In a dot or a cross product of v
/// and w, the absolute value of each product is at most size_of(v) * size_of(w).
template <std::floating_point T>
[[nodiscard]] T size_of(const Vec3T<T>& v) noexcept {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

} // namespace ljus::detail
