#pragma once

/// \file ljus/path/emission.hpp
/// \brief How a photon leaves a light.

#include "ljus/math/low_discrepancy.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/scene/light_choice.hpp"

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

namespace detail {

/// A point of an emissive object, uniform over its area, the normal where it shines to.
/// \param scene  The scene.
/// \param light  One of its lights that is an object.
/// \param u      Point of the unit square.
/// \param time   Of the photon, in [0, 1].
/// \return The point.
template <SceneLike S, std::floating_point T>
[[nodiscard]] SurfacePointT<T> light_point(const S& scene, const LightT<T>& light,
                                           const Vec2T<T>& u, T time = T(0)) {
    SurfacePointT<T> point = scene.visit_shape(*light.object, [&](const auto& shape) {
        return sample_area(at_time(shape, time), u);
    });
    if (scene.object(*light.object).inside_out) point.normal = -point.normal;
    return point;
}

/// A ray of a sun: from the plane where the scene begins, through a disc.
/// \param sun     The light.
/// \param center  Of the disc.
/// \param radius  Of the disc.
/// \param u       Point of the unit square: where in the disc.
/// \return The ray.
template <std::floating_point T>
[[nodiscard]] RayT<T> sun_ray(const LightT<T>& sun, const Vec3T<T>& center, T radius,
                              const Vec2T<T>& u) {
    const Vec2T<T> disc = radius * sample_concentric_disc(u);
    const FrameT<T> frame = frame_around(sun.direction);
    const T back = glm::dot(center - sun.position, sun.direction) + sun.radius;
    return {.origin = center + to_world(frame, Vec3T<T>{disc.x, disc.y, -back}),
            .direction = sun.direction};
}

} // namespace detail

/// The way of a photon that leaves a light, with the density of what the light sends:
/// uniform over an object's area and with cos / pi in direction; uniform over the
/// sphere from a point; as the intensity from a spot; and from a sun side by side, over
/// the disc that the sphere around the scene throws as its shadow.
/// \param scene        The scene.
/// \param light        One of its lights.
/// \param u_point      Point of the unit square: where on the light.
/// \param u_direction  Point of the unit square: where to.
/// \param time         Of the photon, in [0, 1].
/// \return The ray; its time is still to be set.
// [light_ray]
template <SceneLike S, std::floating_point T>
[[nodiscard]] RayT<T> light_ray(const S& scene, const LightT<T>& light,
                                const Vec2T<T>& u_point, const Vec2T<T>& u_direction,
                                T time = T(0)) {
    if (light.object) {
        const SurfacePointT<T> point = detail::light_point(scene, light, u_point, time);
        const FrameT<T> frame = frame_around(point.normal);
        return spawn_ray(point, to_world(frame, sample_cosine_hemisphere(u_direction)));
    }
    if (light.kind == LightKind::sun)
        return detail::sun_ray(light, light.position, light.radius, u_point);
    if (light.kind == LightKind::spot) {
        const T share = detail::sample_spot(light, u_direction.x) / light.outer;
        const Vec3T<T> local =
            sample_uniform_cone(Vec2T<T>{share, u_direction.y}, light.outer);
        return {.origin = light.position,
                .direction = to_world(frame_around(light.direction), local)};
    }
    return {.origin = light.position, .direction = sample_uniform_sphere(u_direction)};
}
// [light_ray]

/// A photon of a light chosen by power, see light_ray().
///
/// Each photon of a white light then carries the same flux, the scene's whole flux over
/// the number of photons; a coloured light's differs in its channels only.
/// \param scene   The scene.
/// \param choice  Of the scene's lights; at least one.
/// \param stream  Five numbers are drawn; of any kind, see \ref low_discrepancy.
/// \return The photon; its flux is that of all paths together.
/// \report{Section 3.2.2}
/// \erratum{The program behind the report gives every light the same number of photons
///          and the same flux whatever its area, and multiplies the flux by the cosine
///          that the direction's density already holds.}
// [emit]
template <SceneLike S, typename Stream>
[[nodiscard]] EmittedPhotonT<typename S::Scalar>
emit(const S& scene, const LightChoice& choice, Stream& stream) {
    using T = typename S::Scalar;
    const detail::ChosenLightT<T> chosen =
        detail::choose_light(choice, next_1d<T>(stream));
    const LightT<T>& light = scene.lights[chosen.light];
    const Vec2T<T> u_point = next_2d<T>(stream);
    const Vec2T<T> u_direction = next_2d<T>(stream);
    const T time = detail::path_time(scene, stream);
    RayT<T> ray = light_ray(scene, light, u_point, u_direction, time);
    ray.time = time;
    return {.ray = ray,
            .flux = light.flux / chosen.probability,
            .light = static_cast<std::uint16_t>(chosen.light)};
}
// [emit]

/// \}

} // namespace ljus
