#pragma once

/// \file ljus/photons/photon.hpp
/// \brief The photon: a packet of flux at a surface.

#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup photon Photons
/// \brief Section 2.3 of the report: the photons of a photon map.
/// \{

/// The kind of a photon, by its path in Heckbert's notation \cite heckbert1990.
enum class PhotonKind : std::uint8_t {
    direct,   ///< L D: the photon comes straight from its light.
    caustic,  ///< L S+ D: the photon has met mirrors and glass only.
    indirect, ///< L ... D ... D: the photon has met a diffuse surface or fog before.
    shadow,   ///< The photon marks a surface that is in shadow, and carries no light.
    fog       ///< Fog scatters the photon; see \ref volume_photons.
};

/// A set of kinds. Bits: 1 direct, 2 caustic, 4 indirect, 8 shadow, 16 fog.
struct PhotonKinds {
    std::uint8_t bits = 0; ///< The kinds in the set.

    /// Whether a kind is in the set.
    [[nodiscard]] constexpr bool has(PhotonKind kind) const noexcept {
        return (bits >> static_cast<int>(kind) & 1) != 0;
    }
};
inline constexpr PhotonKinds all_kinds{15};  ///< All kinds at surfaces.
inline constexpr PhotonKinds light_kinds{7}; ///< Direct, caustic and indirect.

/// The set of a single kind.
[[nodiscard]] constexpr PhotonKinds one_kind(PhotonKind kind) noexcept {
    return {static_cast<std::uint8_t>(1 << static_cast<int>(kind))};
}

namespace detail {

/// A normal in three bytes, in steps of 1/127. Its error is below half a degree. A
/// normal of 0 belongs to a photon whose surface is unknown, and matches every surface.
using SmallNormal = glm::vec<3, std::int8_t>;

} // namespace detail

/// Rounds a unit normal to three bytes.
template <std::floating_point T>
[[nodiscard]] detail::SmallNormal small_normal(const Vec3T<T>& normal) noexcept {
    return detail::SmallNormal(glm::round(T(127) * normal));
}

namespace detail {

/// Whether the normal of a photon differs by more than 60 degrees from a unit normal,
/// for example on the next wall of a corner or on the back of a thin wall.
/// \param photon  Normal of the photon. If it is 0, the result is false.
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
/// \erratum{The report says that a photon has a radiance. A photon carries flux, in W.}
template <std::floating_point T>
struct PhotonT {
    Vec3T<T> position{T(0)};  ///< The position, in scene units.
    Vec3T<T> direction{T(0)}; ///< Unit direction of travel.
    /// The flux that arrives, in W. For a shadow photon it is the flux that is
    /// occluded; in fog, the flux that is scattered.
    RgbT<T> flux{T(0)};
    std::uint16_t light = 0; ///< Index of the light; in fog, of the medium.
    PhotonKind kind = PhotonKind::direct; ///< The kind.
    detail::SmallNormal normal{0};        ///< Normal of the surface; in fog, 0.
};
using Photon = PhotonT<float>; ///< PhotonT in float: 44 bytes.

/// The side on which a photon arrives: +1 for the side of the normal, otherwise -1.
// [photon_side]
template <std::floating_point T>
[[nodiscard]] int photon_side(const Vec3T<T>& direction,
                              const Vec3T<T>& normal) noexcept {
    return glm::dot(direction, normal) < T(0) ? 1 : -1;
}
// [photon_side]

/// What became of the flux that a photon pass emitted, in W. For each path, absorbed +
/// escaped + cut + roulette = emitted.
struct FluxAudit {
    RgbT<double> emitted{0};  ///< Flux that lights have emitted.
    RgbT<double> absorbed{0}; ///< Flux that materials and media have absorbed.
    RgbT<double> escaped{0};  ///< Flux that has left the scene.
    /// Flux of paths that end at the depth limit, and of photons that were aimed at an
    /// object and do not hit it.
    RgbT<double> cut{0};
    /// Flux lost minus flux gained by Russian roulette and by the choice of a
    /// wavelength. Its mean is 0.
    RgbT<double> roulette{0};

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
