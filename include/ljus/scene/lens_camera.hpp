#pragma once

/// \file ljus/scene/lens_camera.hpp
/// \brief A camera with a lens: sharp at one distance only.

#include "ljus/math/random.hpp"
#include "ljus/math/sampling.hpp"
#include "ljus/scene/camera.hpp"

namespace ljus {

/// \defgroup lens_camera A camera with a lens
/// \brief Section 2.1, distributed rays: depth of field \cite cook1984. Chapter:
/// \ref ch_distributed_rays.
/// \{

/// A thin lens in the place of the pinhole. All light that comes from one point of the
/// plane of focus meets in one point of the picture; with_lens() makes one.
template <std::floating_point T>
struct LensCameraT {
    using Scalar = T;     ///< The precision.
    CameraT<T> pinhole{}; ///< Where it stands, and what it looks at.
    T radius = T(0);      ///< Of the lens' opening, in scene units; 0 is the pinhole.
    T focus = T(1); ///< How far the plane of focus is, along the view, in scene units.
};
using LensCamera = LensCameraT<float>; ///< LensCameraT in float.

/// Replaces the pinhole of a camera by a thin lens.
/// \param camera  Of look_at().
/// \param radius  Of the opening, at least 0.
/// \param focus   Distance of the plane that is sharp, above 0.
/// \return The camera.
/// \throws std::invalid_argument  if one of the two is out of range.
template <std::floating_point T>
[[nodiscard]] LensCameraT<T> with_lens(const CameraT<T>& camera,
                                       std::type_identity_t<T> radius,
                                       std::type_identity_t<T> focus) {
    require(std::isfinite(radius) && radius >= T(0), "camera.radius", radius,
            "finite and at least 0");
    require_positive("camera.focus", focus);
    return {camera, radius, focus};
}

/// The primary ray through a point of the picture and a point of the lens: it meets the
/// pinhole's ray in the plane of focus.
/// \param camera  The camera.
/// \param pixel   From the upper left corner: x in [0, width], y in [0, height].
/// \param width   Of the picture, in pixels.
/// \param height  Of the picture, in pixels.
/// \param u       Point of the unit square: where on the lens, uniform over its area.
/// \return A ray from the lens, its direction of unit length.
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

/// The primary ray as the pixel loop asks for it.
/// \param camera  The camera.
/// \param pixel   From the upper left corner.
/// \param width   Of the picture, in pixels.
/// \param height  Of the picture, in pixels.
/// \param stream  Two numbers are drawn.
/// \return A ray from a random point of the lens.
template <std::floating_point T, StreamLike Stream>
[[nodiscard]] RayT<T> camera_ray(const LensCameraT<T>& camera, const Vec2T<T>& pixel,
                                 int width, int height, Stream& stream) noexcept {
    return primary_ray(camera, pixel, width, height, next_2d<T>(stream));
}

/// The circle of confusion: how large a point appears that is not in focus.
/// \param camera  The camera.
/// \param depth   How far the point is along the view, above 0.
/// \param height  Of the picture, in pixels.
/// \return Its diameter, in pixels.
/// \cite cook1984
// [circle of confusion]
template <std::floating_point T>
[[nodiscard]] T circle_of_confusion(const LensCameraT<T>& camera, T depth,
                                    int height) noexcept {
    const T diameter = T(2) * camera.radius; // at distance 1, where the picture is:
    const T there = diameter * std::abs(depth - camera.focus) / (depth * camera.focus);
    return there * T(height) / (T(2) * camera.pinhole.half_height);
}
// [circle of confusion]

/// \}

} // namespace ljus
