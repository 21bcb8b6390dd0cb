#pragma once

/// \file ljus/path/path_state.hpp
/// \brief The state of a path between its vertices, for radiance or flux.

#include <algorithm>
#include <cstdint>

#include "ljus/geometry/ray.hpp"
#include "ljus/scene/body_list.hpp"

namespace ljus {

/// \defgroup path_state Path states
/// \brief Section 3.2.4: the arguments of the report's recursive trace.
/// \{

/// The state of a path from the camera or from a light. next_vertex() and
/// continue_path() advance both kinds; they differ only in what they carry and in what
/// is done at a vertex.
template <std::floating_point T>
struct PathStateT {
    RayT<T> ray{};             ///< Its current ray and its time.
    RgbT<T> throughput{T(1)};  ///< The factor of the radiance that a camera path finds;
                               ///< the flux of a photon, in W.
    T eta_scale = T(1);        ///< The factor (n_i/n_t)^2 in the throughput.
    RgbT<T> medium{T(0)};      ///< Absorption at its position, per scene unit.
    bool medium_known = false; ///< False: next_vertex() finds the medium.
    BodyList bodies{}; ///< Around it, in a scene with priorities. Empty: next_vertex()
                       ///< looks for them.
    BodyList behind{}; ///< Beyond the surface of its vertex, in such a scene.
    Vec3T<T> previous{T(0)};   ///< The last vertex.
    T pdf = T(0);              ///< Pdf of its direction, per steradian; 0: delta.
    T wavelength = T(0);       ///< In nm, once it has met a Dispersive material; until
                               ///< then 0, and it carries light of all wavelengths.
    bool specular = false;     ///< Whether its last scattering was specular.
    bool met_diffuse = false;  ///< Whether any scattering was not specular.
    bool met_specular = false; ///< Whether any scattering was specular.
    int depth = 0;             ///< Number of vertices so far.
    std::uint64_t branch = 0;  ///< Offset of its random numbers; see split_path().
};
using PathState = PathStateT<float>; ///< PathStateT in float.

/// Russian roulette on a camera path: it survives with a probability proportional to
/// its throughput, and a survivor is divided by the probability \cite arvo1990.
/// Radiance decreases by a factor of 2.25 when it leaves glass; roulette ignores this
/// factor. Any positive probability gives the same mean, but not the same noise.
/// \param throughput  Divided by the probability if the path survives.
/// \param eta_scale   The product of all BsdfSampleT::eta_scale in the throughput.
/// \param u           In [0, 1).
/// \param threshold   Roulette applies below this throughput; 0: never.
/// \param max_probability  The largest probability, in (0, 1].
/// \return Whether the path survives.
// [survives]
template <std::floating_point T>
[[nodiscard]] bool survives(RgbT<T>& throughput, T eta_scale, T u, T threshold = T(1),
                            T max_probability = T(1)) noexcept {
    const T carried = max_component(throughput) / eta_scale;
    const T probability = std::min(max_probability, carried / threshold);
    if (!(u < probability)) return false;
    throughput /= probability;
    return true;
}
// [survives]

/// \}

} // namespace ljus
