#pragma once

/// \file ljus/geometry/facet.hpp
/// \brief Flat polygons and their form factors.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/geometric.hpp>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup form_factor Form factors
/// \brief Section 2.2 of the report: "a form factor, which describes patch visibility,
/// is calculated for each pair of patches". Chapter: \ref ch_radiosity.
///
/// Everything is in double: a form factor can be a small difference of larger numbers.
/// \{

/// A convex polygon. Its corners turn counter-clockwise as seen from its front.
struct Facet {
    /// The corners: the first `count` elements. The others are for clipping.
    std::array<glm::dvec3, 9> corners{};
    int count = 0; ///< The number of corners, at most 6.
};

namespace detail {

/// A facet with its front and its back exchanged.
[[nodiscard]] constexpr Facet turned(Facet facet) noexcept {
    std::reverse(facet.corners.begin(), facet.corners.begin() + facet.count);
    return facet;
}

/// The normal of a facet times its area; 0 for fewer than three corners.
[[nodiscard]] constexpr glm::dvec3 area_vector(const Facet& facet) noexcept {
    glm::dvec3 sum(0);
    for (int i = 2; i < facet.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        sum += glm::cross(facet.corners[k - 1] - facet.corners[0],
                          facet.corners[k] - facet.corners[0]);
    }
    return 0.5 * sum;
}

/// Clips a facet by the plane through `point`. The unit normal of the plane points to
/// the side that is kept. Corners within `width` of the plane count as on the plane.
/// \return At most one corner more than the facet, or up to half as many more if the
///         facet lies in the plane and rounding puts corners on both sides. No corners
///         if nothing is left.
[[nodiscard]] inline Facet clipped(const Facet& facet, const glm::dvec3& point,
                                   const glm::dvec3& normal,
                                   double width = 0) noexcept {
    const auto height = [&](const glm::dvec3& corner) {
        const double h = glm::dot(normal, corner - point);
        return std::abs(h) <= width ? 0.0 : h;
    };
    Facet part;
    const auto keep = [&](const glm::dvec3& corner) {
        part.corners[static_cast<std::size_t>(part.count++)] = corner;
    };
    for (int i = 0; i < facet.count; ++i) {
        const glm::dvec3& a = facet.corners[static_cast<std::size_t>(i)];
        const glm::dvec3& b =
            facet.corners[static_cast<std::size_t>((i + 1) % facet.count)];
        const double ha = height(a), hb = height(b);
        if (ha >= 0) keep(a);
        if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0))
            keep(a + ha / (ha - hb) * (b - a));
    }
    return part.count < 3 ? Facet{} : part;
}

} // namespace detail

/// The form factor F from a point of a surface to a facet: the fraction of the point's
/// diffuse emission that arrives at the facet. By Lambert's formula
/// \f[ F = \frac1{2\pi} \sum_k \theta_k\,
///     n \cdot \frac{v_{k+1} \times v_k}{|v_{k+1} \times v_k|} , \f]
/// where v_k is the unit vector from the point to corner k, theta_k is the angle
/// between v_k and v_{k+1}, and n is the unit normal at the point. The point must not
/// lie on the facet's border. The part of the facet below the point's horizon does not
/// count.
/// \return F in [0, 1]; 0 if the facet faces away.
/// \report{Section 2.2}
/// \cite baum1989
// [form_factor_at]
[[nodiscard]] inline double form_factor_at(const glm::dvec3& point,
                                           const glm::dvec3& normal,
                                           const Facet& facet) noexcept {
    const Facet seen = detail::clipped(facet, point, normal);
    double sum = 0;
    for (int i = 0; i < seen.count; ++i) {
        const glm::dvec3 a = seen.corners[static_cast<std::size_t>(i)] - point;
        const glm::dvec3 b =
            seen.corners[static_cast<std::size_t>((i + 1) % seen.count)] - point;
        const glm::dvec3 across = glm::cross(b, a);
        const double sine = glm::length(across);
        if (sine > 0)
            sum += glm::dot(normal, across) / sine * std::atan2(sine, glm::dot(a, b));
    }
    return sum > 0 ? sum * std::numbers::inv_pi / 2 : 0;
}
// [form_factor_at]

namespace detail {

/// The first 16 coefficients of theta / sin(theta) as a series in x = sin^2(theta / 2),
/// the hypergeometric function 2F1(1, 1; 3/2; x). For x up to 1/4 the sum of these
/// terms is exact to 1e-10.
inline constexpr auto angle_over_sine_series = [] {
    std::array<double, 16> terms{1};
    for (std::size_t n = 0; n + 1 < terms.size(); ++n)
        terms[n + 1] = terms[n] * double(n + 1) / (double(n) + 1.5);
    return terms;
}();

/// theta / sin(theta) for an angle theta of at most 60 degrees.
/// \param cosine  cos(theta), at least 1/2.
[[nodiscard]] constexpr double angle_over_sine(double cosine) noexcept {
    const auto& a = angle_over_sine_series;
    const double x = 0.5 - 0.5 * cosine, x2 = x * x;
    // Two independent sums, because each step of a sum waits for the one before.
    double even = a[14], odd = a[15];
    for (std::size_t n = 14; n > 0; n -= 2) {
        even = even * x2 + a[n - 2];
        odd = odd * x2 + a[n - 1];
    }
    return even + odd * x;
}

/// The fast twin of form_factor_at(). It needs no arc tangent and no clipping if the
/// facet has three or four corners, lies above the horizon, and has edges that each
/// span at most 60 degrees as seen from the point. Otherwise it calls form_factor_at().
[[nodiscard]] inline double form_factor_fast(const glm::dvec3& point,
                                             const glm::dvec3& normal,
                                             const Facet& facet) noexcept {
    constexpr std::size_t sides = 4;
    const auto count = static_cast<std::size_t>(facet.count);
    if (count < 3 || count > sides) return form_factor_at(point, normal, facet);
    double x[sides + 1], y[sides + 1], z[sides + 1], inverse[sides + 1], high[sides];
    for (std::size_t i = 0; i <= sides; ++i) { // an edge of no length adds nothing
        const glm::dvec3& corner = facet.corners[i < count ? i : 0];
        x[i] = corner.x - point.x;
        y[i] = corner.y - point.y;
        z[i] = corner.z - point.z;
    }
    for (std::size_t i = 0; i < sides; ++i) {
        high[i] = normal.x * x[i] + normal.y * y[i] + normal.z * z[i];
        inverse[i] = 1 / std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
    }
    inverse[sides] = inverse[0];
    double cosine[sides], part[sides];
    for (std::size_t i = 0; i < sides; ++i) {
        const std::size_t k = i + 1;
        const double scale = inverse[i] * inverse[k];
        cosine[i] = (x[i] * x[k] + y[i] * y[k] + z[i] * z[k]) * scale;
        const double across = normal.x * (y[k] * z[i] - z[k] * y[i]) +
                              normal.y * (z[k] * x[i] - x[k] * z[i]) +
                              normal.z * (x[k] * y[i] - y[k] * x[i]);
        part[i] = across * scale * angle_over_sine(cosine[i]);
    }
    bool near = false; // written so that NaN takes the plain twin
    for (std::size_t i = 0; i < sides; ++i) near |= !(high[i] >= 0 && cosine[i] >= 0.5);
    if (near) return form_factor_at(point, normal, facet);
    const double sum = (part[0] + part[1]) + (part[2] + part[3]);
    return sum > 0 ? sum * std::numbers::inv_pi / 2 : 0;
}

} // namespace detail

/// \}

} // namespace ljus
