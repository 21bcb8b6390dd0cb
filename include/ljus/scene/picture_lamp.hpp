#pragma once

/// \file ljus/scene/picture_lamp.hpp
/// \brief A matt surface whose lamp shows a picture: the material with its light.

#include "ljus/image/image.hpp"
#include "ljus/lights/picture_light.hpp"
#include "ljus/materials/lambertian.hpp"

namespace ljus {

/// \defgroup picture_lamp Textured lamps
/// \brief Beyond the report: a lamp whose radiance is a picture, such as a window or a
/// screen. Chapter: \ref ch_lamps.
/// \{

/// The material of a textured lamp: a quad or a disc that emits its own radiance times
/// the picture. The lower left corner of the picture is at (u, v) = (0, 0), the upper
/// right one at (1, 1); see \ref texture_coordinates. A pixel is one radiance, without
/// interpolation. On the back it is dark.
///
///     const auto window = scene.add(PictureLamp{.picture = load_hdr("window.hdr")});
///     scene.add(quad, window, Rgb{1});
template <std::floating_point T>
struct PictureLampT {
    using Scalar = T;                     ///< The precision of its numbers.
    static constexpr bool uses_uv = true; ///< The picture lies in the shape's (u, v).
    /// Factors of the radiance, at least 0; of any width and height, not black
    /// everywhere.
    ImageT<T> picture{.width = 1, .height = 1, .pixels = {RgbT<T>(T(1))}};
    RgbT<T> albedo{T(0)}; ///< Reflected fraction of the light that falls on it.
};
using PictureLamp = PictureLampT<float>; ///< PictureLampT in float.

/// The picture, as ShowsPicture asks for it.
template <std::floating_point T>
[[nodiscard]] const ImageT<T>& emission_picture(const PictureLampT<T>& lamp) noexcept {
    return lamp.picture;
}

/// What it reflects by: a matt surface, the same everywhere.
template <std::floating_point T>
[[nodiscard]] LambertianT<T> at_point(const PictureLampT<T>& lamp, const Vec3T<T>&,
                                      const Vec2T<T>&) noexcept {
    return {lamp.albedo};
}

/// \name Functions of the matt surface
/// \{

/// As of a LambertianT.
template <std::floating_point T>
[[nodiscard]] constexpr Lobes lobes(const PictureLampT<T>&) noexcept {
    return Lobes::diffuse;
}

/// As of a LambertianT; in 1/sr, without the cosine.
template <std::floating_point T>
[[nodiscard]] RgbT<T> evaluate(const PictureLampT<T>& lamp, const Vec3T<T>& wo,
                               const Vec3T<T>& wi) noexcept {
    return evaluate(LambertianT<T>{lamp.albedo}, wo, wi);
}

/// As of a LambertianT; per steradian.
template <std::floating_point T>
[[nodiscard]] T pdf(const PictureLampT<T>& lamp, const Vec3T<T>& wo, const Vec3T<T>& wi,
                    Lobes which = Lobes::all) noexcept {
    return pdf(LambertianT<T>{lamp.albedo}, wo, wi, which);
}

/// As of a LambertianT.
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const PictureLampT<T>& lamp, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport transport, Lobes which = Lobes::all) noexcept {
    return sample(LambertianT<T>{lamp.albedo}, wo, u, transport, which);
}

/// \}

/// Refuses an invalid picture or albedo.
/// \throws std::invalid_argument  if the albedo is not within [0, 1], or the picture
///         empty, black in every pixel, or in some pixel negative or not finite.
template <std::floating_point T>
void check(const PictureLampT<T>& lamp) {
    require_unit("picture lamp.albedo", lamp.albedo);
    require_radiance("picture lamp.picture", lamp.picture);
}

/// \}

} // namespace ljus
