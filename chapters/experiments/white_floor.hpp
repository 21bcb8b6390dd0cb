#pragma once

/// \file chapters/experiments/white_floor.hpp
/// \brief Irradiance on a white floor: what a rectangular lamp gives it, exactly, and
/// what photons say of it.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "ljus/geometry/quad.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/photons/density_estimate.hpp"

namespace examples {

/// The irradiance at a point from a rectangular lamp of radiance 1 (Lambert's formula).
/// \param lamp  The lamp, all of it above the floor.
/// \param at    The point.
/// \param up    The normal of the floor.
[[nodiscard]] inline double irradiance_from(const ljus::Quad& lamp,
                                            const ljus::Vec3T<double>& at,
                                            const ljus::Vec3T<double>& up) {
    using Point = ljus::Vec3T<double>;
    const Point c{lamp.corner}, u{lamp.edge_u}, v{lamp.edge_v};
    const std::array corners{c, c + u, c + u + v, c + v};
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Point a = glm::normalize(corners[i] - at);
        const Point b = glm::normalize(corners[(i + 1) % 4] - at);
        sum +=
            std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), up);
    }
    return std::abs(sum) / 2;
}

/// The irradiance that an estimate reads: pi times what a white floor would send.
/// \param map     The photons.
/// \param at      A point of the floor.
/// \param up      Its normal.
/// \param gather  How photons are gathered.
/// \param kinds   Which of them count.
[[nodiscard]] inline double irradiance_read(const ljus::PhotonMap& map,
                                            const ljus::Vec3& at, const ljus::Vec3& up,
                                            const ljus::DensityEstimateSettings& gather,
                                            ljus::PhotonKinds kinds = ljus::all_kinds) {
    const ljus::VertexT<float> floor{.point{.position = at, .normal = up},
                                     .frame = ljus::frame_around(up),
                                     .object = {}};
    std::uint64_t gathered = 0;
    return std::numbers::pi *
           double(estimate_radiance(map, floor,
                                    ljus::Lambertian{.albedo = ljus::Rgb{1}},
                                    ljus::Vec3{0, 0, 1}, gather, kinds, gathered)
                      .x);
}

} // namespace examples
