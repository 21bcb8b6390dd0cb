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

/// A law that gives the index of refraction at a wavelength in nanometres, like
/// SellmeierT and CauchyT.
template <typename Law, typename T>
concept DispersionLaw = requires(const Law& law, T nm) {
    { refractive_index(law, nm) } -> std::same_as<T>;
};

/// The smooth boundary between air and a transparent body that disperses light
/// \cite musgrave1989. At any one wavelength it is a GlassT. The side z > 0 is air,
/// with index 1.
///
///     scene.add(DispersiveGlass{.law = sf10<float>});
template <std::floating_point T, DispersionLaw<T> Law = SellmeierT<T>>
struct DispersiveGlassT {
    using Scalar = T;                           ///< The precision of its numbers.
    static constexpr bool only_specular = true; ///< All lobes are specular.
    Law law{};                                  ///< The index at each wavelength.
    /// Absorption coefficient inside, per scene unit; at least 0.
    RgbT<T> absorption{T(0)};
};
/// DispersiveGlassT in float. The default law gives an index of 1 at every wavelength.
using DispersiveGlass = DispersiveGlassT<float>;

/// The glass at the wavelength `nm`, in nanometres, in [360, 830].
// [at_wavelength]
template <std::floating_point T, typename Law>
[[nodiscard]] GlassT<T> at_wavelength(const DispersiveGlassT<T, Law>& glass,
                                      T nm) noexcept {
    return {.index = refractive_index(glass.law, nm), .absorption = glass.absorption};
}
// [at_wavelength]

/// Samples the glass at the d line, a wavelength of 587.6 nm, as for GlassT.
template <std::floating_point T, typename Law>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const DispersiveGlassT<T, Law>& glass, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport transport, Lobes which = Lobes::all) noexcept {
    return sample(at_wavelength(glass, line_d<T>), wo, u, transport, which);
}

/// The reflected and the refracted sample at the d line, 587.6 nm, as for GlassT.
template <std::floating_point T, typename Law>
[[nodiscard]] std::optional<std::array<BsdfSampleT<T>, 2>>
split(const DispersiveGlassT<T, Law>& glass, const Vec3T<T>& wo,
      Transport transport) noexcept {
    return split(at_wavelength(glass, line_d<T>), wo, transport);
}

/// The index of refraction inside at the d line, 587.6 nm.
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

/// Requires a valid index at every fifth nanometre of the visible spectrum, and a
/// finite absorption of at least 0.
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
