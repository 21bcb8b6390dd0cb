#pragma once

/// \file ljus/photons/emission.hpp
/// \brief How a photon leaves a light.

#include "ljus/math/low_discrepancy.hpp"
#include "ljus/path/next_vertex.hpp"

namespace ljus {

/// \defgroup emission Photon emission
/// \brief Section 3.2.2: photons are "shot from all the light sources into the scene".
/// \{

/// A photon as it leaves its light.
template <std::floating_point T>
struct EmittedPhotonT {
    RayT<T> ray{};      ///< Where it is, where it goes, and when.
    RgbT<T> flux{T(0)}; ///< W, of all paths together: divide by how many are emitted.
    std::uint16_t light = 0; ///< The number of its light.
};

/// A photon of a light chosen by power, see emit_photon().
///
/// Each photon of a white light then carries the same flux, the scene's whole flux over
/// the number of photons; a coloured light's differs in its channels only.
/// \param world   The closed scene.
/// \param choice  Of its lights, at least one: World::light_choice(), or another.
/// \param stream  Five numbers are drawn; of any kind, see \ref low_discrepancy.
/// \return The photon; its flux is that of all paths together.
/// \report{Section 3.2.2}
/// \erratum{The program behind the report gives every light the same number of photons
///          and the same flux whatever its area, and multiplies the flux by the cosine
///          that the direction's density already holds.}
// [emit]
template <AnyWorld W, StreamLike Stream>
[[nodiscard]] EmittedPhotonT<typename W::Scalar>
emit(const W& world, const LightChoice& choice, Stream& stream) {
    using T = typename W::Scalar;
    const ChosenLightT<T> chosen = choose_light(choice, next_1d<T>(stream));
    const Vec2T<T> u_point = next_2d<T>(stream);
    const Vec2T<T> u_direction = next_2d<T>(stream);
    const T time = detail::path_time(world, stream);
    LeavingPhotonT<T> photon = world.visit_light(chosen.light, [&](const auto& light) {
        return emit_photon(light, u_point, u_direction, time);
    });
    photon.ray.time = time;
    return {.ray = photon.ray,
            .flux = photon.flux / chosen.probability,
            .light = static_cast<std::uint16_t>(chosen.light)};
}
// [emit]

/// \}

} // namespace ljus
