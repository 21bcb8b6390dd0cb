#pragma once

/// \file ljus/photons/photon.hpp
/// \brief The photon: a packet of flux at a surface.

#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup photon Photons
/// \brief Section 2.3: the content of a photon map.
/// \{

/// The path of a photon, in Heckbert's notation \cite heckbert1990.
enum class PhotonKind : std::uint8_t {
    direct,   ///< L D: straight from its light.
    caustic,  ///< L S+ D: by mirrors and glass only.
    indirect, ///< L ... D ... D: by a diffuse surface or by fog before.
    shadow,   ///< Carries no flux; marks a surface that is in shadow.
    fog       ///< Scattered in fog; in a volume map, see \ref volume_photons.
};

/// A set of kinds, one bit each: 1 direct, 2 caustic, 4 indirect, 8 shadow, 16 fog.
struct PhotonKinds {
    std::uint8_t bits = 0; ///< The kinds in the set.

    /// Whether a kind is in the set.
    [[nodiscard]] constexpr bool has(PhotonKind kind) const noexcept {
        return (bits >> static_cast<int>(kind) & 1) != 0;
    }
};
inline constexpr PhotonKinds all_kinds{15};  ///< Every photon at a surface.
inline constexpr PhotonKinds light_kinds{7}; ///< All but shadow photons.

/// The set of a single kind.
[[nodiscard]] constexpr PhotonKinds one_kind(PhotonKind kind) noexcept {
    return {static_cast<std::uint8_t>(1 << static_cast<int>(kind))};
}

namespace detail {

/// A normal in three bytes, in steps of 1/127: its error is below half a degree. Zero,
/// for a photon of unknown surface, matches every surface.
using SmallNormal = glm::vec<3, std::int8_t>;

} // namespace detail

/// Rounds a unit normal to three bytes.
template <std::floating_point T>
[[nodiscard]] detail::SmallNormal small_normal(const Vec3T<T>& normal) noexcept {
    return detail::SmallNormal(glm::round(T(127) * normal));
}

namespace detail {

/// Whether a photon's normal differs by 60 degrees or more from another one, as on the
/// next wall of a corner or on the back of a thin wall. On a ball, photons up to a
/// radius away belong to the same surface.
/// \param photon  Normal of the photon; if it is 0, the result is false.
/// \param normal  Unit normal.
// [turned_away]
template <std::floating_point T>
[[nodiscard]] bool turned_away(const SmallNormal& photon,
                               const Vec3T<T>& normal) noexcept {
    const Vec3T<T> n(photon);
    return T(2) * T(127) * glm::dot(n, normal) < glm::dot(n, n);
}
// [turned_away]

} // namespace detail

/// A photon at a surface, or where fog scatters it.
/// \report{Section 2.3}
/// \erratum{The report gives a photon a radiance; it carries flux, in W.}
template <std::floating_point T>
struct PhotonT {
    Vec3T<T> position{T(0)};  ///< In scene units.
    Vec3T<T> direction{T(0)}; ///< Unit direction of travel.
    RgbT<T> flux{T(0)};       ///< W that arrive; for a shadow photon, W occluded; in
                              ///< fog, W that are scattered.
    std::uint16_t light = 0;  ///< Index of its light; in fog, of the medium.
    PhotonKind kind = PhotonKind::direct; ///< Its path so far.
    detail::SmallNormal normal{0};        ///< Normal of the surface; in fog, 0.
};
using Photon = PhotonT<float>; ///< PhotonT in float: 44 bytes.

/// The side of a surface on which a photon arrives: +1 for that of the normal, -1 for
/// the other.
// [photon_side]
template <std::floating_point T>
[[nodiscard]] int photon_side(const Vec3T<T>& direction,
                              const Vec3T<T>& normal) noexcept {
    return glm::dot(direction, normal) < T(0) ? 1 : -1;
}
// [photon_side]

/// Where the emitted flux of a photon pass went; in W, summed in double.
///
/// For each path, absorbed + escaped + cut + roulette = emitted. `roulette` is what
/// terminated photons lost minus what survivors gained, and what photons lost minus
/// what they gained when a wavelength was chosen; its mean is 0.
struct FluxAudit {
    RgbT<double> emitted{0};  ///< By the lights.
    RgbT<double> absorbed{0}; ///< By materials and media.
    RgbT<double> escaped{0};  ///< Left the scene.
    RgbT<double> cut{0};      ///< Lost at the depth limit.
    RgbT<double> roulette{0}; ///< Lost minus gained by roulette.

    /// Adds another audit.
    FluxAudit& operator+=(const FluxAudit& other) noexcept {
        emitted += other.emitted;
        absorbed += other.absorbed;
        escaped += other.escaped;
        cut += other.cut;
        roulette += other.roulette;
        return *this;
    }

    /// Scales all flux.
    FluxAudit& operator*=(double factor) noexcept {
        emitted *= factor;
        absorbed *= factor;
        escaped *= factor;
        cut *= factor;
        roulette *= factor;
        return *this;
    }
};

/// \}

} // namespace ljus
