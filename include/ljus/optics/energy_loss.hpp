#pragma once

/// \file ljus/optics/energy_loss.hpp
/// \brief The energy that a single reflection at a rough surface loses, and a lobe that
/// returns it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "ljus/optics/microfacet.hpp"

namespace ljus {

/// \addtogroup microfacet
/// \{

namespace detail {

/// A table of the fraction of light that white facets lose if light is reflected only
/// once: 1 - E(mu), where E(mu) is the fraction that they reflect \cite kulla2017, and
/// mu is the cosine between the light and the normal. The cells of the table are small
/// near the horizon, where the loss is steep.
template <std::floating_point T>
struct EnergyLossT {
    static constexpr int cells = 128; ///< Number of cells of the table.
    T alpha = T(0);                   ///< Roughness; 0 for a mirror, without loss.
    std::array<T, cells + 1> at{};    ///< The loss 1 - E(mu), in [0, 1).
    /// The distribution function of the loss over mu: the fraction of the
    /// cosine-weighted loss at all smaller mu.
    std::array<T, cells + 1> below{};
    T mean = T(0); ///< The cosine-weighted mean of the loss over the hemisphere.
};

/// The cosine at a position in the table, from 0 to EnergyLossT::cells. It is
/// \f$ \alpha s^2 / (\alpha + 1 - s^2) \f$, where s is the position divided by
/// EnergyLossT::cells.
template <std::floating_point T>
[[nodiscard]] constexpr T facet_cosine(T alpha, T place) noexcept {
    const T s = place / T(EnergyLossT<T>::cells);
    return alpha * s * s / (alpha + (T(1) - s) * (T(1) + s));
}

/// The position of a cosine in the table: the inverse of facet_cosine().
template <std::floating_point T>
[[nodiscard]] T facet_position(T alpha, T cos_theta) noexcept {
    const T x = cos_theta * (T(1) + alpha) / (cos_theta + alpha);
    return std::sqrt(std::min(x, T(1))) * T(EnergyLossT<T>::cells);
}

/// The fraction of light that white facets lose at the cosine mu: 1 - E(mu), in [0, 1).
/// It is 0 for a mirror.
/// \cost A square root, a division and two adjacent table entries.
// [lost at]
template <std::floating_point T>
[[nodiscard]] T lost_at(const EnergyLossT<T>& loss, T cos_theta) noexcept {
    if (!(loss.alpha > T(0))) return T(0);
    const T place = facet_position(loss.alpha, cos_theta);
    const int i = std::min(static_cast<int>(place), loss.cells - 1);
    const auto low = static_cast<std::size_t>(i);
    return loss.at[low] + (place - T(i)) * (loss.at[low + 1] - loss.at[low]);
}
// [lost at]

/// Samples a cosine with a density proportional to the loss times the cosine. The loss
/// counts as constant within a cell of the table.
/// \cost A binary search and a square root.
template <std::floating_point T>
[[nodiscard]] T sample_lost(const EnergyLossT<T>& loss, T u) noexcept {
    const auto above =
        std::upper_bound(loss.below.begin() + 1, loss.below.end() - 1, u);
    const T place = static_cast<T>(above - loss.below.begin());
    const T from = *(above - 1), to = *above;
    const T low = facet_cosine(loss.alpha, place - T(1));
    const T high = facet_cosine(loss.alpha, place);
    const T share = to > from ? std::clamp((u - from) / (to - from), T(0), T(1)) : T(0);
    return std::sqrt(low * low + share * (high - low) * (high + low));
}

/// The density of sample_lost() with a uniform azimuth, per steradian.
template <std::floating_point T>
[[nodiscard]] T pdf_lost(const EnergyLossT<T>& loss, T cos_theta) noexcept {
    const int i = std::min(static_cast<int>(facet_position(loss.alpha, cos_theta)),
                           loss.cells - 1);
    const auto cell = static_cast<std::size_t>(i);
    const T low = facet_cosine(loss.alpha, T(i));
    const T high = facet_cosine(loss.alpha, T(i + 1));
    return (loss.below[cell + 1] - loss.below[cell]) * cos_theta *
           std::numbers::inv_pi_v<T> / ((high - low) * (high + low));
}

// The loss at the cosine mu: the mean of 1 - G2/G1 over the visible facets, which is
// the fraction of light that other facets intercept. See ggx_lambda(). The grid of
// samples is fine where u.y is close to 1, because facets are steep there and intercept
// most light.
inline double energy_loss(double alpha, double mu) {
    constexpr int rows = 96, columns = 48;
    const Vec3T<double> out{std::sqrt((1 - mu) * (1 + mu)), 0, mu};
    const double r_out = ggx_lambda(alpha, out);
    double sum = 0;
    for (int row = 0; row < rows; ++row) {
        const double v = (row + 0.5) / rows;
        double of_row = 0;
        for (int column = 0; column < columns; ++column) {
            const Vec2T<double> u{(column + 0.5) / (2 * columns), 1 - v * v * v};
            const Vec3T<double> h = sample_visible_normal(alpha, out, u);
            const Vec3T<double> in = 2 * glm::dot(out, h) * h - out;
            of_row += in.z > 0 ? 1 - (mu + r_out) /
                                         (r_out + mu / in.z * ggx_lambda(alpha, in))
                               : 1.0;
        }
        sum += 3 * v * v * of_row;
    }
    return sum / (rows * columns);
}

/// Makes the table of the loss for the roughness alpha, which is 0 for a mirror and
/// otherwise in [1e-4, 1]. The table is computed in double, and lowered so that
/// interpolation adds no light: its values are at most 4e-4 below the loss. Only at the
/// horizon can they be above the loss, by less than 1e-5.
/// \cost Samples 0.6 million visible normals, in about 20 ms.
template <std::floating_point T = float>
[[nodiscard]] EnergyLossT<T> bake_energy_loss(T alpha) {
    EnergyLossT<T> loss{.alpha = alpha};
    if (!(alpha > T(0))) return loss;
    const auto cosine = [&](double place) {
        return facet_cosine(double(alpha), place);
    };
    for (std::size_t i = 0; i < loss.at.size(); ++i) {
        const double mu = std::max(cosine(double(i)), 1e-9);
        const double lost = energy_loss(double(alpha), mu) - 2e-4;
        loss.at[i] = static_cast<T>(std::max(0.0, lost));
    }
    // The mean of the table itself. The lobe of multiple scattering then returns
    // exactly the loss in the table.
    constexpr int parts = 16;
    std::array<double, EnergyLossT<T>::cells + 1> sum{};
    for (std::size_t i = 1; i < sum.size(); ++i) {
        sum[i] = sum[i - 1];
        for (int part = 0; part < parts; ++part) {
            const double place = double(i - 1) + double(part) / parts;
            const double low = cosine(place), high = cosine(place + 1.0 / parts);
            const double middle = cosine(place + 0.5 / parts);
            sum[i] += double(lost_at(loss, static_cast<T>(middle))) * (high - low) *
                      (high + low);
        }
    }
    loss.mean = static_cast<T>(sum.back());
    for (std::size_t i = 0; i < sum.size(); ++i)
        loss.below[i] = static_cast<T>(sum[i] / sum.back());
    return loss;
}

} // namespace detail

/// \}

/// \defgroup multiple_scattering Multiple scattering
/// \brief A lobe that returns the energy which a single reflection at a rough surface
/// loses.
///
/// White facets reflect the fraction E(mu) of light whose direction has the cosine mu
/// to the normal, and lose 1 - E(mu). A second, reciprocal lobe returns the loss. It is
/// added to the BRDF f_1 of a single reflection \cite kulla2017 :
///
/// \f[ f = f_1 + \frac{\rho_m}{\pi}
///     \frac{(1 - E(\mu_i))\,(1 - E(\mu_o))}{1 - \bar E}, \qquad
///     \rho_m = \frac{\rho^2 \bar E}{1 - \rho (1 - \bar E)} \f]
///
/// \f$ \mu_i \f$ and \f$ \mu_o \f$ are the cosines of the two directions, \f$ \rho \f$
/// is the mean reflectance of a facet, and \f$ \bar E = 2 \int E(\mu)\,\mu\,d\mu \f$ is
/// the mean of E. For white facets the second lobe reflects exactly the light that f_1
/// loses. Eon and CompensatedGlossy use it.
/// \{

namespace detail {

/// The albedo rho_m of the lobe of multiple scattering, in [0, 1]; 1 for white.
/// \param reflectance  Mean reflectance of a facet over the angles, in [0, 1].
/// \param loss         1 minus the mean fraction of light that white facets reflect, in
///                     [0, 1).
template <std::floating_point T>
[[nodiscard]] RgbT<T> multiple_scattering(const RgbT<T>& reflectance, T loss) noexcept {
    return reflectance * reflectance * (T(1) - loss) /
           (RgbT<T>{T(1)} - reflectance * loss);
}

} // namespace detail

/// \}

} // namespace ljus
