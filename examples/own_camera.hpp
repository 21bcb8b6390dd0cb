/// \file own_camera.hpp
/// \brief A camera of the reader's own: a fisheye.
#pragma once
#include <cmath>
#include <numbers>

#include "ljus/scene/camera.hpp"

/// Code that a reader of the book has written.
namespace reader {

/// A lens that shows a hemisphere, or more, in a disc. The distance from the middle of
/// the picture is proportional to the angle from the axis.
struct Fisheye {
    using Scalar = float;      ///< The precision.
    ljus::Camera at{};         ///< Position and directions of the camera.
    float field_degrees = 180; ///< Angle from one edge of the disc to the other.
};

// [camera_ray]
/// The ray through a point of the picture. Outside the disc the ray is empty: it has
/// t_max 0.
template <ljus::StreamLike Stream>
ljus::Ray camera_ray(const Fisheye& eye, const ljus::Vec2& pixel, int width, int height,
                     Stream& /*no number is drawn*/) {
    const float half = 0.5f * float(width < height ? width : height);
    const ljus::Vec2 at{(pixel.x - 0.5f * float(width)) / half,
                        (0.5f * float(height) - pixel.y) / half};
    const float r = std::hypot(at.x, at.y);
    if (r > 1) return {.origin = eye.at.position, .t_max = 0};
    const float angle = r * eye.field_degrees * std::numbers::pi_v<float> / 360;
    const float aside = r > 0 ? std::sin(angle) / r : 0;
    return {.origin = eye.at.position,
            .direction =
                glm::normalize(std::cos(angle) * eye.at.forward +
                               aside * (at.x * eye.at.right + at.y * eye.at.up))};
}
// [camera_ray]

static_assert(ljus::CameraLike<Fisheye>);

} // namespace reader
