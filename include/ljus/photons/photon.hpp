#pragma once

/// \file ljus/photons/photon.hpp
/// \brief The photon: a packet of flux that has come to a surface.

#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup photon Photons
/// \brief Section 2.3: what a photon map keeps.
/// \{

/// What has happened to a photon, in Heckbert's letters \cite heckbert1990.
enum class PhotonKind : std::uint8_t {
    direct,   ///< L D: it comes straight from its light.
    caustic,  ///< L S+ D: only mirrors and glass lie between.
    indirect, ///< L ... D ... D: it has met a diffuse surface before.
    shadow ///< Not light: the first surface in its way hides this one from the light.
};

/// Some of the kinds, as a bit each: 1 for direct, 2 for caustic, 4 for indirect, 8 for
/// shadow.
struct PhotonKinds {
    std::uint8_t bits = 0; ///< Those that are meant.

    /// Whether a kind is one of them.
    [[nodiscard]] constexpr bool has(PhotonKind kind) const noexcept {
        return (bits >> static_cast<int>(kind) & 1) != 0;
    }
};
inline constexpr PhotonKinds all_kinds{15};  ///< Every photon.
inline constexpr PhotonKinds light_kinds{7}; ///< All but shadow photons.

/// One kind alone.
[[nodiscard]] constexpr PhotonKinds one_kind(PhotonKind kind) noexcept {
    return {static_cast<std::uint8_t>(1 << static_cast<int>(kind))};
}

namespace detail {

/// A surface's normal in three bytes, in steps of 1/127: less than half a degree wrong.
/// Zero, of a photon whose surface is not known, matches every surface.
using SmallNormal = glm::vec<3, std::int8_t>;

} // namespace detail

/// A normal, rounded to three bytes.
/// \param normal  Unit vector.
/// \return The nearest small normal.
template <std::floating_point T>
[[nodiscard]] detail::SmallNormal small_normal(const Vec3T<T>& normal) noexcept {
    return detail::SmallNormal(glm::round(T(127) * normal));
}

namespace detail {

/// Whether a photon's surface is turned away from another by 60 degrees or more: the
/// next wall of a corner, the other side of a thin wall. On a ball, photons as far as
/// its radius are of the same surface.
/// \param photon  The normal where the photon is.
/// \param normal  Unit vector, where it is asked for.
/// \return Never true of a zero photon normal.
// [turned_away]
template <std::floating_point T>
[[nodiscard]] bool turned_away(const SmallNormal& photon,
                               const Vec3T<T>& normal) noexcept {
    const Vec3T<T> n(photon);
    return T(2) * T(127) * glm::dot(n, normal) < glm::dot(n, n);
}
// [turned_away]

} // namespace detail

/// A photon where it met a surface.
/// \report{Section 2.3}
/// \erratum{The report gives a photon a radiance; it carries flux, in W.}
template <std::floating_point T>
struct PhotonT {
    Vec3T<T> position{T(0)};  ///< In scene units.
    Vec3T<T> direction{T(0)}; ///< Unit, the way it travels.
    RgbT<T> flux{T(0)};       ///< W that arrive; of a shadow photon, that do not.
    std::uint16_t light = 0;  ///< The number of the light it comes from.
    PhotonKind kind = PhotonKind::direct; ///< What has happened to it.
    detail::SmallNormal normal{0};        ///< Of the surface that it met.
};
using Photon = PhotonT<float>; ///< PhotonT in float: 44 bytes.

/// The side of a surface that a photon has come to.
/// \param direction  The way the photon travels.
/// \param normal     Of the surface.
/// \return +1 if it is the side that the normal points to, -1 if it is the other.
// [photon_side]
template <std::floating_point T>
[[nodiscard]] int photon_side(const Vec3T<T>& direction,
                              const Vec3T<T>& normal) noexcept {
    return glm::dot(direction, normal) < T(0) ? 1 : -1;
}
// [photon_side]

/// Where the emitted flux of a photon pass has gone; in W, added in double.
///
/// Path by path, absorbed + escaped + cut + roulette = emitted: the first three are
/// what materials took, what left the scene, and what a depth limit threw away;
/// `roulette` is what the dead lost less what the survivors gained, and has the mean 0.
struct FluxAudit {
    RgbT<double> emitted{0};  ///< By the lights.
    RgbT<double> absorbed{0}; ///< By materials and media.
    RgbT<double> escaped{0};  ///< Past all objects.
    RgbT<double> cut{0};      ///< By the limit of bounces.
    RgbT<double> roulette{0}; ///< Lost by the dead, less what the survivors gained.

    /// Adds another account.
    FluxAudit& operator+=(const FluxAudit& other) noexcept {
        emitted += other.emitted;
        absorbed += other.absorbed;
        escaped += other.escaped;
        cut += other.cut;
        roulette += other.roulette;
        return *this;
    }

    /// As if so many times as much had been emitted.
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
