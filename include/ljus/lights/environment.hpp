#pragma once

/// \file ljus/lights/environment.hpp
/// \brief Light from all around: a picture of the sky in latitude and longitude.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ljus/image/image.hpp"
#include "ljus/lights/light.hpp"
#include "ljus/math/piecewise_constant.hpp"

namespace ljus {

/// \defgroup environment Environments
/// \brief Beyond the report: light from infinitely far away, from all directions
/// \cite debevec1998. Chapter: \ref ch_environment.
///
/// The picture is a map of the sphere of directions. Its rows are equal steps of the
/// angle from straight up (+y) to straight down, its columns equal steps of azimuth:
///
/// | in the picture                             | direction |
/// |--------------------------------------------|-----------|
/// | the upper edge                             | +y        |
/// | the middle                                 | -z        |
/// | a quarter of the width right of the middle | +x        |
/// | the left and the right edge                | +z        |
///
/// The radiance is the same for all directions within a pixel. A picture of one pixel
/// is a constant sky.
/// \{

/// Light from infinitely far away, from all directions, given by a picture. Its flux is
/// the light that falls into the sphere around all shapes of the scene.
///
///     scene.add(EnvironmentLight{.picture = load_hdr("garden.hdr"), .strength = 2});
///     scene.add(EnvironmentLight{.picture = make_image(1, 1, Rgb{0.2f, 0.4f, 1})});
template <std::floating_point T>
struct EnvironmentLightT {
    using Scalar = T; ///< The precision of its numbers.
    /// The radiance in W/(m^2 sr). The picture may have any width and height, and at
    /// least one pixel must not be black.
    ImageT<T> picture{.width = 1, .height = 1, .pixels = {RgbT<T>(T(1))}};
    T strength = T(1); ///< Factor of all radiance, above 0.
    /// Rotation of the sky about the y axis, in degrees. A positive angle rotates the
    /// sky counter-clockwise, as seen from above.
    T rotation_degrees = T(0);
};
using EnvironmentLight = EnvironmentLightT<float>; ///< EnvironmentLightT in float.

/// An environment as its scene stores it.
template <std::floating_point T>
struct EnvironmentInSceneT {
    using Scalar = T;              ///< The precision of its numbers.
    ImageT<T> picture{};           ///< Radiance times strength, in W/(m^2 sr).
    PiecewiseConstant2D density{}; ///< Brightness times solid angle of each pixel.
    RgbT<T> sum{T(0)};             ///< Integral of radiance over all directions, W/m^2.
    T turn = T(0);                 ///< Rotation about +y, in full turns.
    SphereT<T> around{};           ///< The sphere around the scene.
};

namespace detail {

/// 1 - cos of an angle, without cancellation. `fraction` is the angle over pi.
template <std::floating_point T>
[[nodiscard]] T one_minus_cos_of(T fraction) noexcept {
    const T sine = std::sin(fraction * (std::numbers::pi_v<T> / T(2)));
    return T(2) * sine * sine;
}

/// The solid angle of a pixel in row y, in steradians. A row of pixels is a belt of the
/// unit sphere, whose area is 2 pi times its extent in height.
// [solid angle of pixel]
[[nodiscard]] inline double solid_angle_of_pixel(int width, int height,
                                                 int y) noexcept {
    const auto below = [height](int row) {
        return one_minus_cos_of(double(row) / height);
    };
    return 2 * std::numbers::pi * (below(y + 1) - below(y)) / width;
}
// [solid angle of pixel]

} // namespace detail

/// The picture of a sky with a gradient, for an EnvironmentLightT. Above the horizon
/// the radiance, in W/(m^2 sr), is linear in the sine of the elevation. Below the
/// horizon it is that of the ground.
/// \return One column of 256 pixels. Each has the mean radiance of its directions.
template <std::floating_point T>
[[nodiscard]] ImageT<T> gradient_sky(const RgbT<T>& horizon, const RgbT<T>& zenith,
                                     const RgbT<T>& ground) {
    constexpr int height = 256;
    ImageT<T> picture = make_image<T>(1, height, ground);
    for (int y = 0; y < height / 2; ++y) {
        const T above = detail::one_minus_cos_of(T(y) / T(height));
        const T below = detail::one_minus_cos_of(T(y + 1) / T(height));
        const T sine = T(1) - (above + below) / T(2);
        pixel(picture, 0, y) = horizon + sine * (zenith - horizon);
    }
    return picture;
}

/// gradient_sky() in float. It accepts colours in braces.
[[nodiscard]] inline Image gradient_sky(const Rgb& horizon, const Rgb& zenith,
                                        const Rgb& ground) {
    return gradient_sky<float>(horizon, zenith, ground);
}

/// \name An environment
/// \{

/// Checks an environment.
/// \throws std::invalid_argument  if the strength is not finite or not above 0; if
///         the rotation is not finite; or if the picture is empty, is black in every
///         pixel, or has a value that is negative or not finite.
template <std::floating_point T>
void check(const EnvironmentLightT<T>& light) {
    require_positive("environment light.strength", light.strength);
    require(std::isfinite(light.rotation_degrees), "environment light.rotation_degrees",
            light.rotation_degrees, "finite");
    require_radiance("environment light.picture", light.picture);
}

/// Prepares an environment, which must have passed check(), for its scene.
/// \cost A sum over all pixels; 8 bytes per pixel besides the picture.
template <std::floating_point T>
[[nodiscard]] EnvironmentInSceneT<T> in_scene(const EnvironmentLightT<T>& light,
                                              const SphereT<T>& around) {
    EnvironmentInSceneT<T> made{.picture = light.picture,
                                .turn = std::remainder(light.rotation_degrees, T(360)) /
                                        T(360),
                                .around = around};
    const int width = made.picture.width, height = made.picture.height;
    for (RgbT<T>& radiance : made.picture.pixels) radiance *= light.strength;
    std::vector<double> solid_angle; // of one pixel of each row
    for (int y = 0; y < height; ++y)
        solid_angle.push_back(detail::solid_angle_of_pixel(width, height, y));
    RgbT<double> sum{0};
    made.density = make_piecewise_constant(width, height, [&](int x, int y) {
        const RgbT<double> there = solid_angle[static_cast<std::size_t>(y)] *
                                   RgbT<double>(pixel(made.picture, x, y));
        sum += there;
        return detail::brightness(there);
    });
    made.sum = RgbT<T>(sum);
    return made;
}

/// The flux into the sphere around the scene, in W: the integral of the radiance over
/// all directions, times the area of the sphere's cross section.
template <std::floating_point T>
[[nodiscard]] RgbT<T> power(const EnvironmentInSceneT<T>& light) noexcept {
    return detail::disc_area(light.around.radius) * light.sum;
}

namespace detail {

template <std::floating_point T>
struct SkyDirectionT {
    Vec3T<T> wi{T(0)};      ///< Unit direction towards the sky.
    RgbT<T> radiance{T(0)}; ///< The radiance in W/(m^2 sr).
    T pdf = T(0);           ///< Density of `wi`, per steradian.
};

/// The density of sample_sky() for a direction of the given radiance, per steradian:
/// the brightness over the integral of the brightness.
// [pdf of pixel]
template <std::floating_point T>
[[nodiscard]] T pdf_of_pixel(const EnvironmentInSceneT<T>& light,
                             const RgbT<T>& radiance) noexcept {
    return static_cast<T>(double(brightness(radiance)) / light.density.rows.back());
}
// [pdf of pixel]

/// Samples a direction to the sky. A pixel is chosen in proportion to its brightness
/// times its solid angle. The direction is uniform in the solid angle of the pixel.
// [sample_sky]
template <std::floating_point T>
[[nodiscard]] SkyDirectionT<T> sample_sky(const EnvironmentInSceneT<T>& light,
                                          const Vec2T<T>& u) noexcept {
    const CellT<T> at = sample_cell(light.density, u);
    const int rows = light.picture.height;
    // Rows are counted from the nearer pole, so that small angles keep their digits.
    const bool down = 2 * at.y >= rows;
    const int row = down ? rows - 1 - at.y : at.y;
    const T within = down ? T(1) - at.within.y : at.within.y;
    const T top = one_minus_cos_of(T(row) / T(rows));
    const T w = top + within * (one_minus_cos_of(T(row + 1) / T(rows)) - top);
    const T r = std::sqrt(w * (T(2) - w));
    const T column = (T(at.x) + at.within.x) / T(light.picture.width);
    const T azimuth = T(2) * std::numbers::pi_v<T> * (column - T(0.5) - light.turn);
    const RgbT<T>& radiance = pixel(light.picture, at.x, at.y);
    return {.wi = {r * std::sin(azimuth), down ? w - T(1) : T(1) - w,
                   -r * std::cos(azimuth)},
            .radiance = radiance,
            .pdf = pdf_of_pixel(light, radiance)};
}
// [sample_sky]

} // namespace detail

/// Samples the light for a shadow ray from a point within the sphere around the scene.
/// The ray ends outside the scene. The weight is the radiance over the pdf.
template <std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>>
sample_light(const EnvironmentInSceneT<T>& light, const Vec3T<T>& from,
             const Vec2T<T>& u, T /*time*/) noexcept {
    const auto [wi, radiance, pdf] = detail::sample_sky(light, u);
    return LightSampleT<T>{
        .point{.position = from + T(2) * light.around.radius * wi, .normal = -wi},
        .wi = wi,
        .weight = radiance / pdf,
        .pdf = pdf};
}

/// Samples the direction of a photon in proportion to the brightness of the sky.
template <std::floating_point T>
[[nodiscard]] ArrivalT<T> sample_arrival(const EnvironmentInSceneT<T>& light,
                                         const Vec2T<T>& u) noexcept {
    const auto [wi, radiance, pdf] = detail::sample_sky(light, u);
    return {-wi, radiance / pdf};
}

/// The radiance that a ray with a unit direction meets when it leaves the scene, in
/// W/(m^2 sr): that of a pixel, without interpolation.
// [escaped_radiance]
template <std::floating_point T>
[[nodiscard]] RgbT<T> escaped_radiance(const EnvironmentInSceneT<T>& light,
                                       const Vec3T<T>& direction) noexcept {
    constexpr T inv_pi = std::numbers::inv_pi_v<T>;
    const ImageT<T>& picture = light.picture;
    const T across = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    const T down = inv_pi * std::atan2(across, direction.y); // in [0, 1]
    T turns =
        inv_pi / T(2) * std::atan2(direction.x, -direction.z) + T(0.5) + light.turn;
    turns -= std::floor(turns);
    // By rounding, a product may be the number of columns or of rows: one too large.
    const int column = std::min(int(turns * T(picture.width)), picture.width - 1);
    const int row = std::min(int(down * T(picture.height)), picture.height - 1);
    return pixel(picture, column, row);
}
// [escaped_radiance]

/// The density with which sample_light() chooses a direction, per steradian.
template <std::floating_point T>
[[nodiscard]] T pdf_escaped(const EnvironmentInSceneT<T>& light,
                            const Vec3T<T>& direction) noexcept {
    return detail::pdf_of_pixel(light, escaped_radiance(light, direction));
}

/// \}
/// \}

} // namespace ljus
