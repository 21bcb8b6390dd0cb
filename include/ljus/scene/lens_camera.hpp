#pragma once

/// \file ljus/scene/lens_camera.hpp
/// \brief A camera with a thin lens, for depth of field.

#include "ljus/math/random.hpp"
#include "ljus/math/sampling.hpp"
#include "ljus/scene/camera.hpp"

namespace ljus {

/// \defgroup lens_camera A camera with a lens
/// \brief Section 2.1 of the report, distributed rays: depth of field \cite cook1984.
/// Chapter:
/// \ref ch_distributed_rays.
/// \{

/// A camera with a thin lens instead of a pinhole. Only the points of the plane of
/// focus appear sharp in the picture. with_lens() makes such a camera.
template <std::floating_point T>
struct LensCameraT {
    using Scalar = T;     ///< The precision of the camera's numbers.
    CameraT<T> pinhole{}; ///< The same camera with a pinhole.
    T radius = T(0);      ///< Radius of the lens, in scene units; 0 for a pinhole.
    T focus = T(1);       ///< Distance of the plane of focus, in scene units.
};
using LensCamera = LensCameraT<float>; ///< LensCameraT in float.

/// Replaces the pinhole of a camera by a thin lens, with the radius of the lens and the
/// distance of the plane of focus in scene units.
/// \throws std::invalid_argument  if the radius is not at least 0, or the distance not
///         above 0.
template <std::floating_point T>
[[nodiscard]] LensCameraT<T> with_lens(const CameraT<T>& camera,
                                       std::type_identity_t<T> radius,
                                       std::type_identity_t<T> focus) {
    require(std::isfinite(radius) && radius >= T(0), "camera.radius", radius,
            "finite and at least 0");
    require_positive("camera.focus", focus);
    return {camera, radius, focus};
}

/// The primary ray from the point of the lens that `u` selects. If `u` is uniform in
/// the unit square, the point is uniform on the lens. In the plane of focus, this ray
/// meets the ray through the pinhole. `pixel` is the position in pixels from the upper
/// left corner of the picture.
/// \return A ray from the lens, with a direction of unit length.
/// \cite cook1984
// [lens ray]
template <std::floating_point T>
[[nodiscard]] RayT<T> primary_ray(const LensCameraT<T>& camera, const Vec2T<T>& pixel,
                                  int width, int height, const Vec2T<T>& u) noexcept {
    const CameraT<T>& middle = camera.pinhole;
    const Vec3T<T> way = primary_ray(middle, pixel, width, height).direction;
    const Vec3T<T> to_focus = camera.focus / glm::dot(way, middle.forward) * way;
    const Vec2T<T> p = camera.radius * sample_concentric_disc(u);
    const Vec3T<T> offset = p.x * middle.right + p.y * middle.up;
    return {.origin = middle.position + offset,
            .direction = glm::normalize(to_focus - offset)};
}
// [lens ray]

/// The primary ray from a random point of the lens, as in CameraLike. Two numbers are
/// drawn, or none for a lens of radius 0.
template <std::floating_point T, StreamLike Stream>
[[nodiscard]] RayT<T> camera_ray(const LensCameraT<T>& camera, const Vec2T<T>& pixel,
                                 int width, int height, Stream& stream) noexcept {
    if (camera.radius == T(0)) return primary_ray(camera.pinhole, pixel, width, height);
    return primary_ray(camera, pixel, width, height, next_2d<T>(stream));
}

/// The diameter, in pixels, of the circle of confusion: the disc in the picture that a
/// point out of focus becomes. `depth` is the distance of the point along the view, in
/// scene units and above 0; it may be infinite. \cite cook1984
// [circle of confusion]
template <std::floating_point T>
[[nodiscard]] T circle_of_confusion(const LensCameraT<T>& camera, T depth,
                                    int height) noexcept {
    const T diameter = T(2) * camera.radius; // of the lens; `there` is at distance 1:
    const T there = diameter * std::abs(T(1) - camera.focus / depth) / camera.focus;
    return there * T(height) / (T(2) * camera.pinhole.half_height);
}
// [circle of confusion]

/// \}

} // namespace ljus
