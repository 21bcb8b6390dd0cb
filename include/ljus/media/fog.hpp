#pragma once

/// \file ljus/media/fog.hpp
/// \brief Fog: a homogeneous medium that absorbs and scatters light.

#include <algorithm>
#include <cmath>

#include "ljus/geometry/sphere.hpp"
#include "ljus/math/require.hpp"
#include "ljus/media/medium.hpp"
#include "ljus/media/phase_function.hpp"

namespace ljus {

/// \defgroup fog Fog
/// \brief Beyond the report: media, such as fog or smoke, that absorb and scatter light
/// \cite novak2018. Chapter: \ref ch_fog.
/// \{

namespace detail {

/// Never called: its return type is the scalar type of a BoxT<T> or a SphereT<T>.
template <template <std::floating_point> typename Region, std::floating_point T>
T precision_of(const Region<T>&);

} // namespace detail

/// Fog in a sphere or in a box. A region that is larger than a room fills the room.
///
///     Scene<Shapes<Quad>, Materials<Lambertian>, Lights<>, Media<Fog<Box>>> scene;
///     scene.add(Fog<Box>{.region{{-1, 0, -1}, {1, 2, 1}}, .scattering = Rgb{0.2f}});
///
/// \tparam Region  Sphere or Box.
template <typename Region>
struct Fog {
    /// The precision of the fog's numbers.
    using Scalar = decltype(detail::precision_of(std::declval<const Region&>()));
    Region region{}; ///< The space that the fog fills, in scene units.
    RgbT<Scalar> absorption{Scalar(0)}; ///< Coefficient sigma_a, per scene unit.
    RgbT<Scalar> scattering{Scalar(0)}; ///< Coefficient sigma_s, per scene unit.
    /// Mean cosine of the angle of scattering; see henyey_greenstein().
    Scalar g = Scalar(0);
};

/// \name Regions
/// \{

/// The interval of t in which a ray is inside a sphere.
/// \return Nothing if the ray misses the sphere or only touches it in one point.
template <std::floating_point T>
[[nodiscard]] std::optional<SpanT<T>> span_of(const SphereT<T>& sphere,
                                              const RayT<T>& ray) noexcept {
    const T square = glm::dot(ray.direction, ray.direction);
    const Vec3T<T> to = sphere.center - ray.origin;
    const T nearest = glm::dot(to, ray.direction) / square;
    const Vec3T<T> off = to - nearest * ray.direction;
    const T half2 = sphere.radius * sphere.radius - glm::dot(off, off);
    if (!(half2 > T(0))) return std::nullopt;
    const T half = std::sqrt(half2 / square);
    const SpanT<T> span{std::max(ray.t_min, nearest - half),
                        std::min(ray.t_max, nearest + half)};
    if (!(span.first < span.last)) return std::nullopt;
    return span;
}

/// The interval of t in which a ray is inside a box.
/// \return Nothing if the ray misses the box or only touches it in one point.
template <std::floating_point T>
[[nodiscard]] std::optional<SpanT<T>> span_of(const BoxT<T>& box,
                                              const RayT<T>& ray) noexcept {
    SpanT<T> span{ray.t_min, ray.t_max};
    for (int axis = 0; axis < 3; ++axis) {
        const T inverse = T(1) / ray.direction[axis];
        const T low = (box.low[axis] - ray.origin[axis]) * inverse;
        const T high = (box.high[axis] - ray.origin[axis]) * inverse;
        const bool back = std::signbit(inverse);
        // A ray in the plane of a side gives NaN, for which both conditions are false.
        if ((back ? high : low) > span.first) span.first = back ? high : low;
        if ((back ? low : high) < span.last) span.last = back ? low : high;
    }
    if (!(span.first < span.last)) return std::nullopt;
    return span;
}

/// Calls f with a point in a sphere and, if the border is within `reach` of the point,
/// with its mirror image on the same radius. The image stands for a larger shell than
/// the point: its weight is the ratio of the areas, and at most 9, since points nearer
/// to the centre than to the border have no image.
template <std::floating_point T, typename F>
void each_image(const SphereT<T>& sphere, const Vec3T<T>& point, T reach, F&& f) {
    f(point, T(1));
    const Vec3T<T> off = point - sphere.center;
    const T distance = glm::length(off);
    const T inside = sphere.radius - distance;
    if (inside >= T(0) && inside < std::min(reach, sphere.radius / 2)) {
        const T ratio = 2 * sphere.radius / distance - 1;
        f(sphere.center + ratio * off, ratio * ratio);
    }
}

/// Calls f with a point in a box and with its mirror images in the sides that are
/// within `reach` of it, and in the edges and corners between these sides. It begins
/// with the sides across `axis`.
template <std::floating_point T, typename F>
void each_image(const BoxT<T>& box, const Vec3T<T>& point, T reach, F&& f,
                int axis = 0) {
    if (axis == 3) return f(point, T(1));
    each_image(box, point, reach, f, axis + 1);
    const T above = point[axis] - box.low[axis], below = box.high[axis] - point[axis];
    for (const T shift : {-2 * above, 2 * below})
        if (above >= T(0) && below >= T(0) && std::abs(shift) < 2 * reach) {
            Vec3T<T> image = point;
            image[axis] += shift;
            each_image(box, image, reach, f, axis + 1);
        }
}

/// The smallest box around a sphere.
template <std::floating_point T>
[[nodiscard]] BoxT<T> bounds_of(const SphereT<T>& sphere) noexcept {
    return {sphere.center - sphere.radius, sphere.center + sphere.radius};
}

/// The box itself.
template <std::floating_point T>
[[nodiscard]] BoxT<T> bounds_of(const BoxT<T>& box) noexcept {
    return box;
}

/// Checks a sphere that fog fills.
/// \throws std::invalid_argument  if the sphere is not finite or has no volume.
template <std::floating_point T>
void check_region(const SphereT<T>& sphere) {
    require_finite("fog.region.center", sphere.center);
    require_positive("fog.region.radius", sphere.radius);
}

/// Checks a box that fog fills.
/// \throws std::invalid_argument  if the box is not finite or has no volume.
template <std::floating_point T>
void check_region(const BoxT<T>& box) {
    require_finite("fog.region.low", box.low);
    require_finite("fog.region.high", box.high);
    require(glm::all(glm::lessThan(box.low, box.high)), "fog.region.high", box.high,
            "above fog.region.low in every component");
}

/// \}
/// \name Fog as a Medium
/// \{

/// Checks fog.
/// \throws std::invalid_argument  if the region has no volume or is not finite, a
///         coefficient is negative or not finite, or g is outside [-0.99, 0.99].
template <typename Region>
void check(const Fog<Region>& fog) {
    using T = typename Fog<Region>::Scalar;
    check_region(fog.region);
    require_radiance("fog.absorption", fog.absorption);
    require_radiance("fog.scattering", fog.scattering);
    require(is_finite(extinction(fog)), "the sum of fog.absorption and fog.scattering",
            extinction(fog), "finite");
    require(std::abs(fog.g) <= T(0.99), "fog.g", fog.g, "within [-0.99, 0.99]");
}

/// The smallest box around the fog.
template <typename Region>
[[nodiscard]] auto bounds(const Fog<Region>& fog) noexcept {
    return bounds_of(fog.region);
}

/// The interval of t in which a ray is inside the fog.
/// \return Nothing if the ray misses the fog or only touches it in one point.
template <typename Region, std::floating_point T>
[[nodiscard]] std::optional<SpanT<T>> span_in(const Fog<Region>& fog,
                                              const RayT<T>& ray) noexcept {
    return span_of(fog.region, ray);
}

/// The extinction coefficient sigma_t: absorption plus scattering, per scene unit.
template <typename Region>
[[nodiscard]] auto extinction(const Fog<Region>& fog) noexcept {
    return fog.absorption + fog.scattering;
}

/// The scattering coefficient sigma_s, per scene unit.
template <typename Region>
[[nodiscard]] auto scattering(const Fog<Region>& fog) noexcept {
    return fog.scattering;
}

/// The phase function of the fog, per steradian: henyey_greenstein().
template <typename Region, std::floating_point T>
[[nodiscard]] T phase(const Fog<Region>& fog, T cosine) noexcept {
    return henyey_greenstein(fog.g, cosine);
}

/// Samples the direction of travel after scattering, with the density phase().
template <typename Region, std::floating_point T>
[[nodiscard]] Vec3T<T> sample_phase(const Fog<Region>& fog, const Vec3T<T>& travel,
                                    const Vec2T<T>& u) noexcept {
    return sample_henyey_greenstein(fog.g, travel, u);
}

/// Calls f with a point of the fog and with its mirror images in the border of the fog,
/// where that is within `reach` of the point.
template <typename Region, std::floating_point T, typename F>
void each_image(const Fog<Region>& fog, const Vec3T<T>& point, T reach, F&& f) {
    each_image(fog.region, point, reach, f);
}

/// \}
/// \}

} // namespace ljus
