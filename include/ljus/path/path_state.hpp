#pragma once

/// \file ljus/path/path_state.hpp
/// \brief The state of a path between two vertices, for radiance or flux.

#include <algorithm>
#include <cstdint>

#include "ljus/geometry/ray.hpp"
#include "ljus/scene/body_list.hpp"

namespace ljus {

/// \defgroup path_state Path states
/// \brief Section 3.2.4 of the report: the arguments of the report's recursive trace.
/// \{

/// The state of a path from the camera or from a light. next_vertex() and
/// continue_path() advance paths of both kinds.
template <std::floating_point T>
struct PathStateT {
    RayT<T> ray{}; ///< The current ray, with the time of the path.
    /// For a camera path, the factor by which the radiance that the path finds is
    /// multiplied. For a photon, its flux in W.
    RgbT<T> throughput{T(1)};
    T eta_scale = T(1); ///< Product of BsdfSampleT::eta_scale over all vertices.
    /// Absorption coefficient around the current ray, per scene unit.
    RgbT<T> medium{T(0)};
    bool medium_known = false; ///< If false, next_vertex() finds the medium.
    /// In a scene with priorities, the bodies around the path. If the list is empty,
    /// next_vertex() looks for them.
    BodyList bodies{};
    /// In a scene with priorities, the bodies behind the surface that the path has
    /// reached.
    BodyList behind{};
    Vec3T<T> previous{T(0)}; ///< Position of the last vertex.
    /// Density of the ray's direction, per steradian; 0 after a specular lobe.
    T pdf = T(0);
    /// The wavelength in nm, from the first Dispersive material on. Before that it is
    /// 0: the path carries all wavelengths.
    T wavelength = T(0);
    bool specular = false;     ///< Whether the last scattering was specular.
    bool met_diffuse = false;  ///< Whether any scattering was not specular.
    bool met_specular = false; ///< Whether any scattering was specular.
    int depth = 0;             ///< Number of vertices so far.
    std::uint64_t branch = 0;  ///< Offset of the random numbers; see split_path().
};
using PathState = PathStateT<float>; ///< PathStateT in float.

/// Russian roulette on a camera path \cite arvo1990. The path survives if `u`, in
/// [0, 1), is below the probability min(max_probability, q / threshold). Here q is the
/// largest channel of the throughput, divided by PathStateT::eta_scale. The throughput
/// of a survivor is divided by the probability, so that the mean radiance stays the
/// same.
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
