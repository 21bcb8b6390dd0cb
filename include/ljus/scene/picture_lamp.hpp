#pragma once

/// \file ljus/scene/picture_lamp.hpp
/// \brief The material of a matt surface that emits a picture.

#include "ljus/image/image.hpp"
#include "ljus/lights/picture_light.hpp"
#include "ljus/materials/lambertian.hpp"

namespace ljus {

/// \defgroup picture_lamp Textured lamps
/// \brief Beyond the report: a lamp whose radiance is a picture, such as a window or a
/// screen. Chapter: \ref ch_lamps.
/// \{

/// The material of a textured lamp. A quad or a disc of this material emits the
/// radiance of the object times the picture. The lower left corner of the picture is at
/// (u, v) = (0, 0), and the upper right corner at (1, 1); see \ref texture_coordinates.
/// The radiance is constant over each pixel. The back of the lamp does not emit.
///
///     const auto window = scene.add(PictureLamp{.picture = load_hdr("window.hdr")});
///     scene.add(quad, window, Rgb{1});
template <std::floating_point T>
struct PictureLampT {
    using Scalar = T;                              ///< The precision of its numbers.
    static constexpr bool scatters_as_base = true; ///< Scattering is that of the base.
    static constexpr bool uses_uv = true;          ///< The picture is looked up by uv.
    /// The factors of the radiance, at least 0 and not all black. The picture may have
    /// any width and height.
    ImageT<T> picture{.width = 1, .height = 1, .pixels = {RgbT<T>(T(1))}};
    LambertianT<T> base{RgbT<T>{T(0)}}; ///< How incident light is reflected; black.
};
using PictureLamp = PictureLampT<float>; ///< PictureLampT in float.

/// The picture of the lamp. The concept ShowsPicture requires this function.
template <std::floating_point T>
[[nodiscard]] const ImageT<T>& emission_picture(const PictureLampT<T>& lamp) noexcept {
    return lamp.picture;
}

/// The material that reflects light: the matt surface, the same at every point.
template <std::floating_point T>
[[nodiscard]] LambertianT<T> at_point(const PictureLampT<T>& lamp, const Vec3T<T>&,
                                      const Vec2T<T>&) noexcept {
    return lamp.base;
}

/// Refuses a lamp with an invalid picture or albedo.
/// \throws std::invalid_argument  if the albedo is not within [0, 1], if the picture is
///         empty or black in every pixel, or if a pixel is negative or not finite.
template <std::floating_point T>
void check(const PictureLampT<T>& lamp) {
    require_unit("picture lamp.albedo", lamp.base.albedo);
    require_radiance("picture lamp.picture", lamp.picture);
}

/// \}

} // namespace ljus
