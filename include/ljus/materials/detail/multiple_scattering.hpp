#pragma once

/// \file ljus/materials/detail/multiple_scattering.hpp
/// \brief What light brings back that has gone from facet to facet.

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup multiple_scattering Light from facet to facet
/// \brief What one reflection at a rough surface loses, further ones bring back.
///
/// A surface of facets that returns the share E(mu) of light at a cosine mu, if its
/// facets were white, keeps 1 - E(mu) among them. Spread that as if it had been lost on
/// the way in and were found again on the way out \cite kulla2017 :
///
/// \f[ f = f_1 + \frac{\rho_m}{\pi}
///     \frac{(1 - E(\mu_i))\,(1 - E(\mu_o))}{1 - \bar E}, \qquad
///     \rho_m = \frac{\rho^2 \bar E}{1 - \rho (1 - \bar E)} \f]
///
/// with the mean \f$ \bar E = 2 \int E(\mu)\,\mu\,d\mu \f$. For white facets the
/// integral over one direction is exactly what f_1 has lost, and the two directions can
/// be exchanged. EON and full gloss are such surfaces.
/// \{

namespace detail {

/// What light that is lost once will bring back, over all its further ways.
/// \param reflectance  Of a facet, the mean over the angles, in [0, 1].
/// \param loss         1 minus the mean of E, in [0, 1).
/// \return rho_m in [0, 1]; 1 for white.
/// \cite kulla2017
template <std::floating_point T>
[[nodiscard]] RgbT<T> multiple_scattering(const RgbT<T>& reflectance, T loss) noexcept {
    return reflectance * reflectance * (T(1) - loss) /
           (RgbT<T>{T(1)} - reflectance * loss);
}

} // namespace detail

/// \}

} // namespace ljus
