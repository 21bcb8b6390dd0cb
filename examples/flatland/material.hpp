#pragma once

/// \file flatland/material.hpp
/// \brief Materials of the plane: Lambert's surface, a mirror, glass.

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "ljus/materials/material.hpp"
#include "ljus/math/vector.hpp"
#include "ljus/optics/fresnel.hpp"
#include "ljus/optics/refraction.hpp"

/// A world of two dimensions with the concepts of the book: chapter 23.
namespace flatland {

using ljus::Transport, ljus::Vec3T;

// Section 3.2.1 in two dimensions, with angles in place of solid angles.
//
// The functions are those of a material in space (ljus/materials/material.hpp), with
// the same names. The frame of a surface has x along the surface and y along its
// normal; `wo` and `wi` point away from it. Light has one channel. Everything is
// computed in double.

using Vec2 = ljus::Vec2T<double>; ///< A point or a direction of the plane.

/// A diffuse surface, which reflects the same radiance in all directions.
struct Lambertian {
    double albedo = 0.5; ///< Reflected fraction of the flux, in [0, 1].
};

/// A mirror.
struct Mirror {
    double reflectance = 1; ///< Reflected fraction of the flux, in [0, 1].
};

/// The boundary of clear glass; the normal points outwards.
struct Glass {
    double index = 1.5; ///< Index of refraction.
};

/// Any material of a surface.
using Material = std::variant<Lambertian, Mirror, Glass>;

/// One scattered direction.
struct BsdfSample {
    Vec2 wi{0, 1};         ///< Direction towards the light; unit vector.
    double weight = 0;     ///< f |cos|/pdf, the factor of the throughput.
    double pdf = 0;        ///< Density of `wi`, per radian; 0 for a delta.
    bool specular = false; ///< Whether `wi` is the direction of a delta.
    double eta_scale = 1;  ///< The factor n_i/n_t that is in the weight; it is no loss
                           ///< of light.
};

/// A direction with the density cos(theta)/2 per radian. Its projection onto the
/// surface is uniform in [-1, 1]. In space it is uniform on a disc.
/// \param u  In [0, 1).
/// \return Unit vector with y >= 0.
/// \report{Section 3.2.4}
// [sample cosine]
[[nodiscard]] inline Vec2 sample_cosine_half_circle(double u) noexcept {
    return {2 * u - 1, 2 * std::sqrt(u * (1 - u))};
}
// [sample cosine]

/// The density of sample_cosine_half_circle().
/// \param d  Unit vector.
/// \return cos(theta)/2 per radian, 0 below the surface.
[[nodiscard]] constexpr double pdf_cosine_half_circle(const Vec2& d) noexcept {
    return d.y > 0 ? d.y / 2 : 0;
}

/// The BRDF: reflected radiance divided by irradiance, without deltas.
/// \param material  The material.
/// \param wo        Outgoing direction.
/// \param wi        Direction towards the light.
/// \return albedo/2 per radian, if both directions are on one side of a Lambertian
///         surface; otherwise 0. The 2 is the integral of the cosine over the half
///         circle, which is pi in space.
/// \report{Section 3.2.1}
// [evaluate]
[[nodiscard]] inline double evaluate(const Material& material, const Vec2& wo,
                                     const Vec2& wi) noexcept {
    const auto* matt = std::get_if<Lambertian>(&material);
    return matt && wo.y * wi.y > 0 ? matt->albedo / 2 : 0;
}
// [evaluate]

/// Samples a Lambertian surface by the cosine, on the side of `wo`.
/// \param surface  The surface.
/// \param wo       Outgoing direction.
/// \param u        In [0, 1).
/// \return The sample; nothing if `wo` lies on the surface.
[[nodiscard]] inline std::optional<BsdfSample>
sample(const Lambertian& surface, const Vec2& wo, double u, Transport) noexcept {
    if (!(wo.y > 0 || wo.y < 0)) return std::nullopt;
    const Vec2 up = sample_cosine_half_circle(u);
    return BsdfSample{.wi{up.x, std::copysign(up.y, wo.y)},
                      .weight = surface.albedo,
                      .pdf = pdf_cosine_half_circle(up)};
}

/// Samples the mirror direction.
/// \param mirror  The mirror.
/// \param wo      Outgoing direction.
/// \return Always a sample.
/// \report{Section 3.2.4, Eq. (4)}
[[nodiscard]] inline std::optional<BsdfSample>
sample(const Mirror& mirror, const Vec2& wo, double, Transport) noexcept {
    return BsdfSample{.wi{-wo.x, wo.y}, .weight = mirror.reflectance, .specular = true};
}

/// Samples reflection or refraction, each with the probability of its share of the
/// light. Snell's law and Fresnel's equations are those of space, where rays stay in
/// the plane of incidence.
/// \param glass      The glass.
/// \param wo         Outgoing direction; inside the glass if y < 0.
/// \param u          In [0, 1); chooses the branch.
/// \param transport  The transported quantity. Radiance from the side with index n_t is
///                   multiplied by n_i/n_t, because Snell's law conserves n cos(theta)
///                   d theta; in space n is squared. Flux is not scaled.
/// \return Always a sample.
/// \report{Section 3.2.5}
// [sample glass]
[[nodiscard]] inline std::optional<BsdfSample>
sample(const Glass& glass, const Vec2& wo, double u, Transport transport) noexcept {
    const bool outside = wo.y > 0;
    const double n_i = outside ? 1 : glass.index;
    const double n_t = outside ? glass.index : 1;
    const auto refracted = ljus::refract(Vec3T<double>{wo.x, 0, wo.y}, n_i / n_t);
    const double reflectance = ljus::fresnel(std::abs(wo.y), n_i, n_t);
    if (!refracted || u < reflectance)
        return BsdfSample{.wi{-wo.x, wo.y}, .weight = 1, .specular = true};
    const double scale = transport == Transport::radiance ? n_i / n_t : 1;
    return BsdfSample{.wi{refracted->x, refracted->z},
                      .weight = scale,
                      .specular = true,
                      .eta_scale = scale};
}
// [sample glass]

/// Samples any material.
/// \param material   The material.
/// \param wo         Outgoing direction: unit vector in the surface's frame.
/// \param u          In [0, 1).
/// \param transport  Radiance or flux.
/// \return The sample; nothing if the path ends.
[[nodiscard]] inline std::optional<BsdfSample>
sample(const Material& material, const Vec2& wo, double u, Transport transport) {
    return std::visit([&](const auto& m) { return sample(m, wo, u, transport); },
                      material);
}

} // namespace flatland
