#pragma once

/// \file ljus/math/rounding.hpp
/// \brief How far rounding can move the result of a computation.

#include <limits>

#include "ljus/math/vector.hpp"

namespace ljus::detail {

/// The relative error of n roundings in a row, n u / (1 - n u) for the unit
/// roundoff u.
template <std::floating_point T>
[[nodiscard]] constexpr T rounding_bound(int n) noexcept {
    const T nu = T(n) * std::numeric_limits<T>::epsilon() / T(2);
    return nu / (T(1) - nu);
}

/// The sum of the sizes of the components: each product in a dot or a cross product is
/// at most the product of two such sums.
template <std::floating_point T>
[[nodiscard]] T size_of(const Vec3T<T>& v) noexcept {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

} // namespace ljus::detail
