#pragma once

/// \file ljus/optics/reflection.hpp
/// \brief The direction in which a mirror reflects a ray.

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup reflection Mirror reflection
/// \brief Section 3.2.4 of the report: the reflection of a ray by a perfect mirror.
/// \{

/// The direction of a ray after a mirror reflection.
///
/// \f[ R = 2I - D, \qquad I = D - (D \cdot N)\,N \f]
///
/// D and R are the directions before and after the reflection, N is the normal, and I
/// is the component of D along the surface.
/// \param d  The direction in which the incoming ray *travels*, towards the surface.
/// \param n  Unit normal; N and -N give the same R.
/// \return The direction in which the reflected ray travels, of the length of `d`.
/// \cost One dot product.
/// \report{Section 3.2.4, Eq. (4)}
// [reflect]
template <std::floating_point T>
[[nodiscard]] Vec3T<T> reflect(const Vec3T<T>& d, const Vec3T<T>& n) {
    const Vec3T<T> along = d - glm::dot(d, n) * n; // I, figure 9
    return T(2) * along - d;
}
// [reflect]

/// The mirror direction in a material's frame, where N = +z and both directions point
/// *away* from the surface. The result is exact.
/// \report{Section 3.2.4, Eq. (4)}
template <std::floating_point T>
[[nodiscard]] constexpr Vec3T<T> reflect(const Vec3T<T>& wo) noexcept {
    return {-wo.x, -wo.y, wo.z};
}

/// \}

} // namespace ljus
