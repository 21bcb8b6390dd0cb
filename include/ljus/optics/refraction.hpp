#pragma once

/// \file ljus/optics/refraction.hpp
/// \brief Snell's law without angles, and total internal reflection.

#include <cmath>
#include <optional>

#include "ljus/math/require.hpp"
#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup refraction Refraction
/// \brief Section 3.2.5 of the report: the direction of a ray after a boundary between
/// two media.
///
/// Let \f$ \eta = n_1/n_2 \f$, where the ray leaves the medium of index n_1 and enters
/// that of index n_2. Snell's law multiplies P, the component of the direction D along
/// the surface, by \f$ \eta \f$. The refracted direction T has unit length, which gives
/// the cosine of its angle theta_2. theta_1 is the angle of the incoming ray, and N is
/// the normal; the sign is plus if N points to the side that the ray enters:
///
/// \f[ T = \eta P \pm N \cos\theta_2, \qquad
///     \cos^2\theta_2 = \cos^2\theta_1 + (1 - \eta)(1 + \eta)\,|P|^2 \f]
///
/// For \f$ \eta \le 1 \f$ nothing cancels in this form. For \f$ \eta = 1 \f$ the
/// direction is unchanged. A negative cos^2(theta_2) means total internal reflection.
/// \erratum{theta_1 must be the angle between -D and N, not between D and N. The report
///          does not mention the case without a refracted ray, sin(theta_1) n_1/n_2 >
///          1.}
/// \{

namespace detail {

/// The difference of two products without cancellation, by Kahan's form with FMA.
/// \return a b - c d, within 2 units of roundoff.
template <std::floating_point T>
[[nodiscard]] T difference_of_products(T a, T b, T c, T d) noexcept {
    const T cd = c * d;
    const T lost = std::fma(-c, d, cd); // the rounding error of c d, exactly
    return std::fma(a, b, -cd) + lost;
}

} // namespace detail

/// The direction of a ray after a boundary. Write `ljus::refract`: an unqualified call
/// may find GLM's refract(), which does not report total reflection.
/// \param direction  The direction in which the ray *travels*, towards the surface;
///                   unit vector.
/// \param normal     Unit normal, on either side.
/// \param eta        n_1/n_2, > 0.
/// \return The refracted unit direction. Nothing under total internal reflection, or if
///         an input is NaN.
/// \cost Two square roots, one division, two cross products by FMA. P is a cross
///       product, because D - (D.N)N is inaccurate near normal incidence.
/// \report{Section 3.2.5}
// [refract]
template <std::floating_point T>
[[nodiscard]] std::optional<Vec3T<T>> refract(const Vec3T<T>& direction,
                                              const Vec3T<T>& normal, T eta) {
    const auto cross = [](const Vec3T<T>& a, const Vec3T<T>& b) {
        return Vec3T<T>{detail::difference_of_products(a.y, b.z, a.z, b.y),
                        detail::difference_of_products(a.z, b.x, a.x, b.z),
                        detail::difference_of_products(a.x, b.y, a.y, b.x)};
    };
    const Vec3T<T> along = cross(normal, cross(direction, normal)); // P
    const T cos_1 = glm::dot(direction, normal);
    const T square =
        cos_1 * cos_1 + (T(1) - eta) * (T(1) + eta) * glm::dot(along, along);
    if (!(square >= T(0))) return std::nullopt; // NaN is a miss

    const T cos_2 = std::copysign(std::sqrt(square), cos_1);
    const Vec3T<T> t = eta * along + cos_2 * normal;
    return t / glm::length(t);
}
// [refract]

/// Refraction in a material's frame, where N = +z and directions point *away* from the
/// surface.
/// \param wo   Outgoing direction, a unit vector.
/// \param eta  n_1/n_2, > 0: index on the side of `wo` over index on the other side.
/// \return wi, the unit vector on the other side. Nothing under total internal
///         reflection, or if an input is NaN.
/// \cost Two square roots and one division.
/// \report{Section 3.2.5}
// [refract local]
template <std::floating_point T>
[[nodiscard]] std::optional<Vec3T<T>> refract(const Vec3T<T>& wo, T eta) {
    const T sin2 = wo.x * wo.x + wo.y * wo.y;
    const T square = wo.z * wo.z + (T(1) - eta) * (T(1) + eta) * sin2;
    if (!(square >= T(0))) return std::nullopt;

    const T cos_2 = std::copysign(std::sqrt(square), wo.z);
    const Vec3T<T> wi{-eta * wo.x, -eta * wo.y, -cos_2};
    return wi / glm::length(wi);
}
// [refract local]

namespace detail {

/// Requires an index of refraction within [0.001, 1000]. `what` is its name.
template <std::floating_point T>
void require_index(std::string_view what, T index) {
    require(index >= T(1e-3) && index <= T(1e3), what, index, "within [0.001, 1000]");
}

} // namespace detail

/// \}

} // namespace ljus
