#pragma once

/// \file ljus/math/affine.hpp
/// \brief Affine maps, which move, turn, scale, mirror and shear a shape.

#include <algorithm>
#include <cmath>

#include <glm/mat4x3.hpp>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup affine Affine maps
/// \brief An affine map is given by a 3x3 matrix L and a vector b. It maps a point p to
/// \f$Lp + b\f$, a direction v to \f$Lv\f$ and a normal n to \f$L^{-T}n\f$. Chapter:
/// \ref ch_instances.
/// \{

/// An affine map, as a GLM matrix of four columns: the three columns of L, then b.
/// GLM's functions make such a matrix: `Affine(glm::translate(glm::mat4(1), by))` is a
/// translation.
template <std::floating_point T>
using AffineT = glm::mat<4, 3, T>;
using Affine = AffineT<float>; ///< AffineT in float.

/// The image of a direction or of a difference of points, Lv.
template <std::floating_point T>
[[nodiscard]] constexpr Vec3T<T> transform_vector(const AffineT<T>& map,
                                                  const Vec3T<T>& v) noexcept {
    return v.x * map[0] + v.y * map[1] + v.z * map[2];
}

/// The image of a point, Lp + b.
template <std::floating_point T>
[[nodiscard]] constexpr Vec3T<T> transform_point(const AffineT<T>& map,
                                                 const Vec3T<T>& p) noexcept {
    return transform_vector(map, p) + map[3];
}

/// The image of a normal, in general not of unit length. It points to the same side of
/// the surface, even if the map mirrors. `inverse` is the inverse of the map.
// [transform_normal]
template <std::floating_point T>
[[nodiscard]] constexpr Vec3T<T> transform_normal(const AffineT<T>& inverse,
                                                  const Vec3T<T>& n) noexcept {
    return {glm::dot(inverse[0], n), glm::dot(inverse[1], n), glm::dot(inverse[2], n)};
}
// [transform_normal]

/// The determinant of L: the factor by which the map scales volumes. It is negative if
/// the map mirrors.
template <std::floating_point T>
[[nodiscard]] constexpr T determinant_of(const AffineT<T>& map) noexcept {
    return glm::dot(map[0], glm::cross(map[1], map[2]));
}

/// The inverse map, by Cramer's rule. The determinant of the map must not be 0, nor so
/// small or large that T holds it with fewer digits or not at all.
template <std::floating_point T>
[[nodiscard]] constexpr AffineT<T> inverse_of(const AffineT<T>& map) noexcept {
    const T d = determinant_of(map);
    const Vec3T<T> x = glm::cross(map[1], map[2]) / d;
    const Vec3T<T> y = glm::cross(map[2], map[0]) / d;
    const Vec3T<T> z = glm::cross(map[0], map[1]) / d;
    AffineT<T> back{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z, T(0), T(0), T(0)};
    back[3] = -transform_vector(back, map[3]);
    return back;
}

/// The largest factor by which a map stretches a length. It is the square root of the
/// largest eigenvalue of \f$L^T L\f$, computed in closed form \cite smith1961. In float
/// it holds for factors between 1e-9 and 1e9.
template <std::floating_point T>
[[nodiscard]] T largest_stretch(const AffineT<T>& map) noexcept {
    const T xx = glm::dot(map[0], map[0]), xy = glm::dot(map[0], map[1]);
    const T yy = glm::dot(map[1], map[1]), yz = glm::dot(map[1], map[2]);
    const T zz = glm::dot(map[2], map[2]), zx = glm::dot(map[2], map[0]);
    const T mean = (xx + yy + zz) / T(3);
    const T x = xx - mean, y = yy - mean, z = zz - mean;
    const T spread = std::sqrt(
        (x * x + y * y + z * z + T(2) * (xy * xy + yz * yz + zx * zx)) / T(6));
    if (!(spread > T(0))) return std::sqrt(mean);
    const auto scaled = [spread](T entry) { return entry / spread; };
    const T a = scaled(x), b = scaled(y), c = scaled(z);
    const T ab = scaled(xy), bc = scaled(yz), ca = scaled(zx);
    const T cubic =
        a * (b * c - bc * bc) - ab * (ab * c - bc * ca) + ca * (ab * bc - b * ca);
    const T cosine = std::clamp(cubic / T(2), T(-1), T(1));
    return std::sqrt(mean + T(2) * spread * std::cos(std::acos(cosine) / T(3)));
}

/// \}

} // namespace ljus
