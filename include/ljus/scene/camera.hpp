#pragma once

/// \file ljus/scene/camera.hpp
/// \brief The pinhole camera.

#include <cmath>
#include <numbers>
#include <optional>

#include "ljus/geometry/ray.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/require.hpp"

namespace ljus {

/// \defgroup camera Cameras
/// \brief Section 3.2 of the report: primary rays.
/// \{

/// A pinhole camera; look_at() makes one.
template <std::floating_point T>
struct CameraT {
    using Scalar = T;                    ///< The precision of the camera's numbers.
    Vec3T<T> position{T(0)};             ///< The pinhole, in scene units.
    Vec3T<T> right{T(1), T(0), T(0)};    ///< Unit vector to the right of the picture.
    Vec3T<T> up{T(0), T(1), T(0)};       ///< Unit vector to the top of the picture.
    Vec3T<T> forward{T(0), T(0), T(-1)}; ///< Unit vector into the picture.
    T half_height = T(1); ///< tan(vfov / 2): half the picture's height at distance 1.
};
using Camera = CameraT<float>; ///< CameraT in float.

/// The position, orientation and field of view of a camera.
template <std::floating_point T>
struct ViewT {
    Vec3T<T> position{T(0)};            ///< The pinhole, in scene units.
    Vec3T<T> target{T(0), T(0), T(-1)}; ///< The point at the middle of the picture.
    Vec3T<T> up{T(0), T(1), T(0)}; ///< Approximate up direction; not along the view.
    T vfov_degrees = T(45);        ///< Full vertical angle in degrees, within (0, 180).
};
using View = ViewT<float>; ///< ViewT in float.

/// The camera of a view.
/// \throws std::invalid_argument  if the position and target are equal, `up` is along
///         the view, or the angle is out of range.
template <std::floating_point T>
[[nodiscard, gnu::cold]] CameraT<T> look_at(const ViewT<T>& view) {
    require_finite("camera.position", view.position);
    require_finite("camera.target", view.target);
    require_finite("camera.up", view.up);
    require(view.vfov_degrees > T(0) && view.vfov_degrees < T(180),
            "camera.vfov_degrees", view.vfov_degrees, "above 0 and below 180");
    // In double, so that a target 1e25 away or an angle of 179.99 degrees is possible.
    using W = WideT<T>;
    const Vec3T<W> way = Vec3T<W>{view.target} - Vec3T<W>{view.position};
    require(glm::dot(way, way) > W(0), "camera.target", view.target,
            "another point than camera.position");
    const Vec3T<W> forward = glm::normalize(way);
    const Vec3T<W> up{view.up};
    const Vec3T<W> side = glm::cross(forward, up);
    require(glm::dot(side, side) > W(1e-12) * glm::dot(up, up), "camera.up", view.up,
            "a direction that is not along the view");
    const Vec3T<W> right = glm::normalize(side);
    const W half_angle = W(view.vfov_degrees) * std::numbers::pi_v<W> / W(360);
    return {.position = view.position,
            .right = Vec3T<T>(right),
            .up = Vec3T<T>(glm::cross(right, forward)),
            .forward = Vec3T<T>(forward),
            .half_height = static_cast<T>(std::tan(half_angle))};
}

/// The camera of a view in float. The view may be written in braces.
[[nodiscard]] inline Camera look_at(const View& view) {
    return look_at<float>(view);
}

/// The primary ray through a point of the picture. `pixel` is its position in pixels
/// from the upper left corner.
/// \return A ray from the pinhole, with a direction of unit length.
/// \report{Section 3.2, Fig. 3}
// [primary_ray]
template <std::floating_point T>
[[nodiscard]] RayT<T> primary_ray(const CameraT<T>& camera, const Vec2T<T>& pixel,
                                  int width, int height) noexcept {
    const T scale = T(2) * camera.half_height / T(height);
    const T x = (pixel.x - T(width) / T(2)) * scale;
    const T y = (T(height) / T(2) - pixel.y) * scale;
    return {.origin = camera.position,
            .direction =
                glm::normalize(camera.forward + x * camera.right + y * camera.up)};
}
// [primary_ray]

/// The primary ray through a point of the picture, as in CameraLike. A pinhole camera
/// draws no random numbers.
template <std::floating_point T, StreamLike Stream>
[[nodiscard]] RayT<T> camera_ray(const CameraT<T>& camera, const Vec2T<T>& pixel,
                                 int width, int height, Stream&) noexcept {
    return primary_ray(camera, pixel, width, height);
}

/// A camera is a struct with a member type `Scalar`, and with a free function that
/// returns the ray through a point of the picture. The function may draw random
/// numbers:
///
///     Ray camera_ray(const MyCamera&, const Vec2& pixel, int width, int height,
///                    auto& stream);
template <typename C>
concept CameraLike = requires {
    typename C::Scalar;
}
&&requires(const C& camera, const Vec2T<typename C::Scalar>& pixel,
           RandomStream& stream) {
    {
        camera_ray(camera, pixel, 1, 1, stream)
        } -> std::same_as<RayT<typename C::Scalar>>;
};

/// The position of a point in the picture: the inverse of primary_ray().
/// \return The position in pixels from the upper left corner, possibly outside the
///         picture. Nothing for a point beside or behind the camera, or if the result
///         is not finite.
/// \report{Section 3.2, Fig. 3}
template <std::floating_point T>
[[nodiscard]] std::optional<Vec2T<T>> project(const CameraT<T>& camera,
                                              const Vec3T<T>& point, int width,
                                              int height) noexcept {
    const Vec3T<T> way = point - camera.position;
    const T depth = glm::dot(way, camera.forward);
    const T scale = T(height) / (T(2) * camera.half_height * depth);
    const Vec2T<T> pixel{T(width) / T(2) + scale * glm::dot(way, camera.right),
                         T(height) / T(2) - scale * glm::dot(way, camera.up)};
    if (!(depth > T(0) && std::isfinite(pixel.x) && std::isfinite(pixel.y)))
        return std::nullopt;
    return pixel;
}

/// \}

} // namespace ljus
