#pragma once

/// \file ljus/lights/area_light.hpp
/// \brief A lamp: the emissive surface of an object.

#include <vector>

#include "ljus/geometry/moving.hpp"
#include "ljus/lights/light.hpp"

namespace ljus {

/// \addtogroup light
/// \{

/// Precomputed data of a lamp.
template <std::floating_point T>
struct LampT {
    RgbT<T> radiance{T(0)}; ///< Emitted radiance in W/(m^2 sr).
    Vec3T<T> normal{T(0)};  ///< Unit normal of a flat shape, otherwise 0.
    T area = T(0);          ///< The area, in squared scene units.
    /// True if the lamp emits on the side opposite to its normal.
    bool inside_out = false;
    /// Cumulative areas of the shape's parts, from area_sums(), for sampling; empty for
    /// a shape without this function.
    std::vector<double> area_sums{};
};

/// A lamp: a shape that emits uniform radiance on one side. A scene makes a lamp from
/// an object with a radiance.
template <Shape S>
struct AreaLightT {
    using Scalar = ScalarOf<S>; ///< The precision of its numbers.
    const S& shape;             ///< The shape, which may move.
    const LampT<Scalar>& lamp;  ///< The precomputed data of the lamp.
};

namespace detail {

/// Whether a light is a surface that emits diffusely from each point.
template <typename L>
inline constexpr bool is_lamp = false;
template <typename S>
inline constexpr bool is_lamp<AreaLightT<S>> = true;

/// Whether a shape has area_sums(), whose result a lamp then stores.
template <typename S>
inline constexpr bool has_area_sums = requires(const S& shape) {
    area_sums(shape);
};

/// Precomputes the data of a lamp.
/// \throws std::invalid_argument  if its area or its flux is 0 or not finite.
template <Shape S, std::floating_point T>
[[nodiscard, gnu::cold]] LampT<T> make_lamp(const S& shape, const RgbT<T>& radiance,
                                            bool inside_out) {
    LampT<T> lamp{.radiance = radiance, .area = area(shape), .inside_out = inside_out};
    require_positive("the area of a light", lamp.area);
    if constexpr (is_plane<S>) lamp.normal = normal(shape);
    if constexpr (has_area_sums<S>) lamp.area_sums = area_sums(shape);
    require_flux(std::numbers::pi_v<T> * lamp.area * radiance);
    return lamp;
}

} // namespace detail

/// \name A lamp
/// \{

/// The emitted flux in W: pi times radiance times area.
template <typename S>
[[nodiscard]] auto power(const AreaLightT<S>& light) noexcept {
    using T = ScalarOf<S>;
    return RgbT<T>{std::numbers::pi_v<T> * light.lamp.area * light.lamp.radiance};
}

/// Samples a point of the lamp for a shadow ray from the point `from`.
/// \return Nothing if `from` is not on the emitting side of the lamp.
/// \report{Section 3.2.3}
/// \erratum{The report's program leaves out the area of the lamp and the inverse square
/// of the distance. A wall ten times as far away gets as much light as a near wall.}
template <typename S, std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>> sample_light(const AreaLightT<S>& light,
                                                          const Vec3T<T>& from,
                                                          const Vec2T<T>& u, T time) {
    std::optional<LightSampleT<T>> sample(std::in_place);
    SurfacePointT<T>& point = sample->point;
    if constexpr (detail::is_plane<S>) {
        detail::set_point(point, sample_area(light.shape, u, light.lamp.normal));
        sample->pdf = detail::pdf_from_area(from, point, light.lamp.area);
    } else {
        const auto& now = at_time(light.shape, time);
        const auto seen = [&] {
            if constexpr (detail::has_area_sums<S>)
                return sample_towards(now, from, u, light.lamp.area_sums);
            else
                return sample_towards(now, from, u);
        }();
        detail::set_point(point, seen.point);
        sample->pdf = seen.pdf;
    }
    if (light.lamp.inside_out) point.normal = -point.normal;

    const T pdf = sample->pdf;
    sample->wi = glm::normalize(point.position - from);
    sample->weight = light.lamp.radiance / pdf;
    // A point on the lamp itself gives NaN, and no light.
    if (!(glm::dot(sample->wi, point.normal) < T(0) && pdf > T(0) &&
          std::isfinite(pdf)))
        sample.reset();
    return sample;
}

/// Samples the origin of a photon, uniformly over the area. The normal of the point is
/// on the emitting side.
template <typename S, std::floating_point T>
[[nodiscard]] SurfacePointT<T> emission_point(const AreaLightT<S>& light,
                                              const Vec2T<T>& u, T time) {
    const auto& now = at_time(light.shape, time);
    auto point = [&] {
        if constexpr (detail::has_area_sums<S>)
            return sample_area(now, u, light.lamp.area_sums);
        else
            return sample_area(now, u);
    }();
    if (light.lamp.inside_out) point.normal = -point.normal;
    return point;
}

/// Samples the unit direction of a photon, with the density pdf_emission().
template <typename L, std::floating_point T>
requires detail::is_lamp<L>
[[nodiscard]] Vec3T<T> sample_emission(const L&, const SurfacePointT<T>& point,
                                       const Vec2T<T>& u) noexcept {
    return to_world(frame_around(point.normal), sample_cosine_hemisphere(u));
}

/// The density of sample_emission(), per steradian: the cosine to the normal over pi; 0
/// behind the lamp.
template <typename L, std::floating_point T>
requires detail::is_lamp<L>
[[nodiscard]] T pdf_emission(const L&, const SurfacePointT<T>& point,
                             const Vec3T<T>& wo) noexcept {
    const T cosine = glm::dot(wo, point.normal);
    return cosine > T(0) ? cosine * std::numbers::inv_pi_v<T> : T(0);
}

/// The hemisphere into which a point of the lamp emits.
template <typename L, std::floating_point T>
requires detail::is_lamp<L>
[[nodiscard]] detail::ConeT<T> emission_cone(const L&,
                                             const SurfacePointT<T>& point) noexcept {
    return {point.normal, T(1)};
}

/// The form factor to the lamp from a point of a surface with the given unit normal.
/// \return In [0, 1]; nothing if the shape has no closed form, or none from this point.
template <typename S, std::floating_point T>
[[nodiscard]] std::optional<T> form_factor(const AreaLightT<S>& light,
                                           const Vec3T<T>& from, const Vec3T<T>& normal,
                                           T time) {
    const auto& now = at_time(light.shape, time);
    const bool inside_out = light.lamp.inside_out;
    if constexpr (requires { form_factor_from(from, normal, now, inside_out); })
        return form_factor_from(from, normal, now, inside_out);
    else
        return std::nullopt;
}

/// The u for which sample_light() returns the centre of a quad or a disc, or the point
/// of a sphere that is nearest to `from`.
template <typename S>
[[nodiscard]] auto center_sample(const AreaLightT<S>& light) noexcept {
    return center_sample(light.shape);
}

/// \}
/// \}

} // namespace ljus
