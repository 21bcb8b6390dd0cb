#pragma once

/// \file ljus/optics/reflection.hpp
/// \brief The mirror direction R = 2I - D.

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup reflection Mirror reflection
/// \brief Section 3.2.4: a ray perfectly reflected over the normal.
/// \{

/// The direction of a ray after a mirror.
///
/// \f[ R = 2I - D, \qquad I = D - (D \cdot N)\,N \f]
///
/// I is the part of D along the surface: it stays, and the part along N turns round.
/// \param d  The direction in which the incoming ray *travels*, towards the surface.
/// \param n  Unit normal, on either side: N and -N give the same R.
/// \return The direction in which the reflected ray travels, as long as `d`.
/// \cost One dot product.
/// \report{Section 3.2.4, Eq. (4)}
// [reflect]
template <std::floating_point T>
[[nodiscard]] Vec3T<T> reflect(const Vec3T<T>& d, const Vec3T<T>& n) {
    const Vec3T<T> along = d - glm::dot(d, n) * n; // I, figure 9
    return T(2) * along - d;
}
// [reflect]

/// The same in a material's frame, where N = +z and both directions point *away* from
/// the surface. Nothing is rounded.
/// \param wo  Vector in the surface's frame, to where the light goes.
/// \return wi, to where it comes from, on the same side as `wo`.
/// \report{Section 3.2.4, Eq. (4)}
template <std::floating_point T>
[[nodiscard]] constexpr Vec3T<T> reflect(const Vec3T<T>& wo) noexcept {
    return {-wo.x, -wo.y, wo.z};
}

/// \}

} // namespace ljus
