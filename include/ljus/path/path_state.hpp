#pragma once

/// \file ljus/path/path_state.hpp
/// \brief What a path carries from vertex to vertex, be it radiance or flux.

#include <algorithm>
#include <cstdint>

#include "ljus/geometry/ray.hpp"

namespace ljus {

/// \defgroup path_state Path states
/// \brief Section 3.2.4: what the recursive trace of the report carries along.
/// \{

/// A path on its way, from the camera or from a light. Both travel by next_vertex() and
/// continue_path(); they differ only in what they carry and in what is done at a
/// vertex.
template <std::floating_point T>
struct PathStateT {
    RayT<T> ray{};             ///< Where it goes, and when.
    RgbT<T> throughput{T(1)};  ///< From the camera: the factor of the radiance that it
                               ///< finds. Of a photon: its flux, in W.
    T eta_scale = T(1);        ///< The part of the throughput that is (n_i/n_t)^2.
    RgbT<T> medium{T(0)};      ///< Absorption of what it is in, per scene unit.
    bool medium_known = false; ///< Whether that is so; else next_vertex() looks.
    Vec3T<T> previous{T(0)};   ///< The last vertex.
    T pdf = T(0);              ///< Of its direction, per steradian; 0: a delta.
    bool specular = false;     ///< Whether its last scattering was by a delta.
    bool met_diffuse = false;  ///< Whether it was ever scattered by anything else.
    bool met_specular = false; ///< Whether it was ever scattered by a delta.
    int depth = 0;             ///< Vertices so far.
    std::uint64_t branch = 0;  ///< Where its random numbers start; see split_path().
};
using PathState = PathStateT<float>; ///< PathStateT in float.

/// Russian roulette on a camera path: it survives with a probability in proportion to
/// its throughput, and a survivor is divided by it \cite arvo1990. That radiance is
/// 2.25 times less outside of glass is no loss, and no reason to end. For any positive
/// probability the mean is what it was; the noise is not.
/// \param throughput  Divided by the probability, if it survives.
/// \param eta_scale   The product of all BsdfSampleT::eta_scale in the throughput.
/// \param u           In [0, 1).
/// \param threshold   Throughput from which on a path is safe; 0: any.
/// \param max_probability  The largest probability, in (0, 1].
/// \return Whether the path goes on.
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
