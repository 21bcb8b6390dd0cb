#pragma once

/// \file ljus/media/medium.hpp
/// \brief The interface of a medium that fills a region of space.

#include <concepts>
#include <optional>

#include "ljus/geometry/box.hpp"
#include "ljus/geometry/ray.hpp"

namespace ljus {

/// \defgroup medium Media
/// \brief What fills space between the surfaces: fog, smoke, murky water.
///
/// A medium has the same coefficients everywhere in its region. The border of the
/// region is not a surface: rays go straight through it. A medium fills the space
/// around bodies of glass, but not the bodies themselves. Where several media overlap,
/// their coefficients add up. A scene lists the types of its media, as in
/// `Media<Fog<Sphere>>`.
///
/// A medium is a struct with a member type `Scalar` and these functions:
///
/// | function                        | returns                                       |
/// |---------------------------------|-----------------------------------------------|
/// | check(medium)                   | nothing; throws, and names the wrong member   |
/// | bounds(medium)                  | a box around the medium                       |
/// | span_in(medium, ray)            | the interval of t in it, a SpanT, or nothing  |
/// | extinction(medium)              | absorption plus scattering, per scene unit    |
/// | scattering(medium)              | scattering alone, per scene unit              |
/// | phase(medium, cosine)           | the phase function, per steradian             |
/// | sample_phase(medium, travel, u) | a direction of travel, with density phase()   |
///
/// each_image() is optional, for photons near the border of the medium.
/// \{

/// An interval of the parameter t of a ray.
template <std::floating_point T>
struct SpanT {
    T first = T(0); ///< The smallest t, in units of the direction's length.
    T last = T(0);  ///< The largest t, above `first`.
};

/// A medium; see \ref medium.
template <typename M>
concept Medium = requires(const M& medium, const RayT<typename M::Scalar>& ray,
                          typename M::Scalar cosine,
                          const Vec3T<typename M::Scalar>& travel,
                          const Vec2T<typename M::Scalar>& u) {
    check(medium);
    { bounds(medium) } -> std::same_as<BoxT<typename M::Scalar>>;
    { span_in(medium, ray) } -> std::same_as<std::optional<SpanT<typename M::Scalar>>>;
    { extinction(medium) } -> std::same_as<RgbT<typename M::Scalar>>;
    { scattering(medium) } -> std::same_as<RgbT<typename M::Scalar>>;
    { phase(medium, cosine) } -> std::same_as<typename M::Scalar>;
    { sample_phase(medium, travel, u) } -> std::same_as<Vec3T<typename M::Scalar>>;
};

/// Calls f with a point of a medium and the weight 1. An overload for a type of medium
/// also calls f with each mirror image of the point in a border within `reach` and with
/// its weight, so that the light of photons near the border stays in the medium.
/// Without one, the medium is too dark within its photons' radius of the border.
template <Medium M, std::floating_point T, typename F>
void each_image(const M&, const Vec3T<T>& point, T /*reach*/, F&& f) {
    f(point, T(1));
}

/// \}

} // namespace ljus
