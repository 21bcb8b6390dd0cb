#pragma once

/// \file ljus/materials/dispersive_glass.hpp
/// \brief Glass whose index of refraction depends on the wavelength.

#include <array>
#include <optional>
#include <string>

#include "ljus/materials/glass.hpp"
#include "ljus/optics/dispersion.hpp"

namespace ljus {

/// \addtogroup dispersion
/// \{

/// What an index of refraction depends on: `refractive_index(law, nm)`, as for
/// SellmeierT and CauchyT.
template <typename Law, typename T>
concept DispersionLaw = requires(const Law& law, T nm) {
    { refractive_index(law, nm) } -> std::same_as<T>;
};

/// The smooth boundary of a transparent body that disperses light; GlassT at any one
/// wavelength \cite musgrave1989. Outside is z > 0 and has index 1.
///
///     scene.add(DispersiveGlass{.law = sf10<float>});
template <std::floating_point T, DispersionLaw<T> Law = SellmeierT<T>>
struct DispersiveGlassT {
    using Scalar = T;                           ///< The precision of its numbers.
    static constexpr bool only_specular = true; ///< See OnlySpecular.
    Law law{};                                  ///< The index at each wavelength.
    RgbT<T> absorption{T(0)};                   ///< Inside, per scene unit, >= 0.
};
/// DispersiveGlassT in float; by default without any resonance, an index of 1.
using DispersiveGlass = DispersiveGlassT<float>;

/// The glass at one wavelength. Renderers and photons call this function for the
/// wavelength of their path.
/// \param glass  The glass.
/// \param nm     In [360, 830].
// [at_wavelength]
template <std::floating_point T, typename Law>
[[nodiscard]] GlassT<T> at_wavelength(const DispersiveGlassT<T, Law>& glass,
                                      T nm) noexcept {
    return {.index = refractive_index(glass.law, nm), .absorption = glass.absorption};
}
// [at_wavelength]

/// A sample at the d line, as for GlassT.
template <std::floating_point T, typename Law>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const DispersiveGlassT<T, Law>& glass, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport transport, Lobes which = Lobes::all) noexcept {
    return sample(at_wavelength(glass, line_d<T>), wo, u, transport, which);
}

/// Both branches at the d line, as for GlassT.
template <std::floating_point T, typename Law>
[[nodiscard]] std::optional<std::array<BsdfSampleT<T>, 2>>
split(const DispersiveGlassT<T, Law>& glass, const Vec3T<T>& wo,
      Transport transport) noexcept {
    return split(at_wavelength(glass, line_d<T>), wo, transport);
}

/// The index of refraction inside, at the d line.
template <std::floating_point T, typename Law>
[[nodiscard]] T refractive_index(const DispersiveGlassT<T, Law>& glass) noexcept {
    return refractive_index(glass.law, line_d<T>);
}

/// The absorption coefficient inside, per scene unit; see transmittance().
template <std::floating_point T, typename Law>
[[nodiscard]] constexpr RgbT<T>
absorption(const DispersiveGlassT<T, Law>& glass) noexcept {
    return glass.absorption;
}

/// Requires a valid index at all visible wavelengths, and a finite absorption of at
/// least 0.
template <std::floating_point T, typename Law>
void check(const DispersiveGlassT<T, Law>& glass) {
    const auto [first, last] = detail::visible<T>;
    for (T nm = first; nm <= last; nm += T(5))
        detail::require_index("dispersive_glass.law at " + std::to_string(int(nm)) +
                                  " nm",
                              refractive_index(glass.law, nm));
    require_radiance("dispersive_glass.absorption", glass.absorption);
}

/// \}

} // namespace ljus
