#pragma once

/// \file ljus/lights/picture_light.hpp
/// \brief A textured lamp: a quad or a disc whose radiance is a picture.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "ljus/geometry/disc.hpp"
#include "ljus/geometry/quad.hpp"
#include "ljus/image/image.hpp"
#include "ljus/lights/area_light.hpp"
#include "ljus/math/piecewise_constant.hpp"

namespace ljus {

/// \addtogroup picture_lamp
/// \{

/// A textured lamp as a World stores it. A World makes it from an object that emits and
/// has a material of the concept ShowsPicture. Points are sampled in proportion to the
/// brightness of their pixels.
template <std::floating_point T>
struct PictureLightT {
    using Scalar = T;      ///< The precision of its numbers.
    QuadT<T> frame{};      ///< The quad, or the square around the disc.
    Vec3T<T> normal{T(0)}; ///< Unit normal on the side that shines.
    bool round = false;    ///< True for a disc: the corners of the square do not shine.
    ImageT<T> picture{};   ///< The radiance in W/(m^2 sr).
    PiecewiseConstant2D cells{}; ///< The brightness of each pixel; 0 outside a disc.
    double pixel_area = 0;       ///< The area of a pixel, in squared scene units.
    RgbT<T> flux{T(0)};          ///< The flux in W.
};

namespace detail {

template <typename T>
inline constexpr bool is_lamp<PictureLightT<T>> = true;

/// The area of the part of the unit disc with 0 <= x <= |a| and 0 <= y <= |b|, times
/// the sign of the product a b.
[[nodiscard]] inline double quarter_area(double a, double b) noexcept {
    const double x = std::min(std::abs(a), 1.0), y = std::min(std::abs(b), 1.0);
    const auto below_arc = [](double t) { // the integral of sqrt(1 - t^2) from 0
        return (t * std::sqrt(1 - t * t) + std::asin(t)) / 2;
    };
    const double corner = std::sqrt(1 - y * y); // where the arc reaches the height y
    const double area =
        x <= corner ? x * y : y * corner + below_arc(x) - below_arc(corner);
    return std::copysign(1.0, a) * std::copysign(1.0, b) * area;
}

/// The fraction of the pixel (x, y) that lies in the circle inscribed in the picture.
[[nodiscard]] inline double fraction_in_circle(int width, int height, int x,
                                               int y) noexcept {
    const auto edge = [](int i, int count) { return 2.0 * i / count - 1; };
    const double left = edge(x, width), right = edge(x + 1, width);
    const double top = edge(y, height), bottom = edge(y + 1, height);
    const double area = quarter_area(right, bottom) - quarter_area(left, bottom) -
                        quarter_area(right, top) + quarter_area(left, top);
    return std::clamp(area / ((right - left) * (bottom - top)), 0.0, 1.0);
}

/// The frame of a picture: the quad itself, or the square around a disc.
template <std::floating_point T>
[[nodiscard]] QuadT<T> picture_frame(const QuadT<T>& quad) noexcept {
    return quad;
}
template <std::floating_point T>
[[nodiscard]] QuadT<T> picture_frame(const DiscT<T>& disc) noexcept {
    const FrameT<T> frame = frame_around(normal(disc));
    const Vec3T<T> u = disc.radius * frame.tangent, v = disc.radius * frame.bitangent;
    return {disc.center - u - v, T(2) * u, T(2) * v};
}

} // namespace detail

/// \name A textured lamp
/// \{

/// Makes a textured lamp.
/// \param shape       A quad or a disc.
/// \param picture     Factors of the radiance.
/// \param radiance    The emitted radiance in W/(m^2 sr) where the picture is white.
/// \param inside_out  True if the lamp shines on the side opposite to the normal.
/// \throws std::invalid_argument  if no pixel shines, or if the shape is not a quad or
///         a disc.
/// \cost 8 bytes per pixel besides the picture.
template <typename S, std::floating_point T>
[[nodiscard]] PictureLightT<T>
make_picture_light(const S& shape, const ImageT<T>& picture, const RgbT<T>& radiance,
                   bool inside_out) {
    if constexpr (!requires { detail::picture_frame(shape); }) {
        throw std::invalid_argument("A lamp that shows a picture must be a quad or a "
                                    "disc at rest; give another shape a radiance "
                                    "without a picture.");
    } else {
        PictureLightT<T> light{.frame = detail::picture_frame(shape),
                               .normal = inside_out ? -normal(shape) : normal(shape),
                               .round = std::same_as<S, DiscT<T>>,
                               .picture = picture};
        const int width = picture.width, height = picture.height;
        light.pixel_area = double(area(light.frame)) / (double(width) * double(height));
        RgbT<double> sum{0};
        light.cells = make_piecewise_constant(width, height, [&](int x, int y) {
            RgbT<T>& there = pixel(light.picture, x, y);
            there *= radiance;
            const double part =
                light.round ? detail::fraction_in_circle(width, height, x, y) : 1.0;
            sum += part * RgbT<double>(there);
            return part > 0 ? double(detail::brightness(there)) : 0.0;
        });
        light.flux = RgbT<T>(std::numbers::pi * light.pixel_area * sum);
        return light;
    }
}

/// The radiance at a point of the picture, in W/(m^2 sr), without interpolation. For
/// `uv`, (0, 0) is the lower left corner of the picture, and (1, 1) the upper right.
template <std::floating_point T>
[[nodiscard]] const RgbT<T>& radiance_at(const PictureLightT<T>& light,
                                         const Vec2T<T>& uv) noexcept {
    const auto cell = [](T x, int count) {
        return std::clamp(static_cast<int>(x * T(count)), 0, count - 1);
    };
    return pixel(light.picture, cell(uv.x, light.picture.width),
                 cell(T(1) - uv.y, light.picture.height));
}

/// The density with which a point of the given radiance is sampled, per squared scene
/// unit: the brightness of the radiance over the integral of the brightness.
// [pdf of point]
template <std::floating_point T>
[[nodiscard]] T pdf_of_point(const PictureLightT<T>& light,
                             const RgbT<T>& radiance) noexcept {
    return static_cast<T>(double(detail::brightness(radiance)) /
                          (light.cells.rows.back() * light.pixel_area));
}
// [pdf of point]

/// The emitted flux in W: pi times the integral of the radiance over the area.
template <std::floating_point T>
[[nodiscard]] RgbT<T> power(const PictureLightT<T>& light) noexcept {
    return light.flux;
}

namespace detail {

/// A point of a textured lamp, and its radiance.
template <std::floating_point T>
struct PicturePointT {
    SurfacePointT<T> point{}; ///< The point, with its normal on the side that shines.
    Vec2T<T> uv{T(0)};        ///< Coordinates in the picture.
    const RgbT<T>& radiance;  ///< The radiance in W/(m^2 sr).
};

/// Samples a point of the frame with the density pdf_of_point().
template <std::floating_point T>
[[nodiscard]] PicturePointT<T> sample_picture(const PictureLightT<T>& light,
                                              const Vec2T<T>& u) noexcept {
    const CellT<T> cell = sample_cell(light.cells, u);
    const Vec2T<T> uv{(T(cell.x) + cell.within.x) / T(light.picture.width),
                      T(1) - (T(cell.y) + cell.within.y) / T(light.picture.height)};
    return {point_at(light.frame, uv.x, uv.y, light.normal), uv,
            pixel(light.picture, cell.x, cell.y)};
}

/// Whether a point of the frame belongs to the lamp.
template <std::floating_point T>
[[nodiscard]] bool shines_at(const PictureLightT<T>& light,
                             const Vec2T<T>& uv) noexcept {
    const Vec2T<T> from_middle = T(2) * uv - T(1);
    return !light.round || glm::dot(from_middle, from_middle) <= T(1);
}

/// The coordinates (u, v) of a point in the frame.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> place_in(const QuadT<T>& frame, const Vec3T<T>& position) {
    const Vec3T<double> way(position - frame.corner), a(frame.edge_u), b(frame.edge_v);
    const double aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b);
    const double u = glm::dot(way, a), v = glm::dot(way, b), all = aa * bb - ab * ab;
    return {T((u * bb - v * ab) / all), T((v * aa - u * ab) / all)};
}

} // namespace detail

/// Samples a point of the lamp for a shadow ray.
/// \return Nothing if `from` lies behind the lamp, or if the sampled point lies outside
///         the disc, which happens in pixels on the disc's edge.
template <std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>>
sample_light(const PictureLightT<T>& light, const Vec3T<T>& from, const Vec2T<T>& u,
             T /*time*/) {
    const auto [point, uv, radiance] = detail::sample_picture(light, u);
    const Vec3T<T> wi = glm::normalize(point.position - from);
    const T pdf =
        detail::pdf_from_area(from, point, T(1) / pdf_of_point(light, radiance));
    const bool reaches = glm::dot(wi, point.normal) < T(0) && pdf > T(0) &&
                         std::isfinite(pdf) && detail::shines_at(light, uv);
    if (!reaches) return std::nullopt;
    return LightSampleT<T>{
        .point = point, .wi = wi, .weight = radiance / pdf, .pdf = pdf};
}

/// The density with which sample_light() chooses a point of the lamp, per steradian at
/// the lit point `from`. `uv` are the coordinates of the point in the picture.
template <std::floating_point T>
[[nodiscard]] T pdf_towards(const PictureLightT<T>& light, const Vec3T<T>& from,
                            const SurfacePointT<T>& point, const Vec2T<T>& uv) {
    return detail::pdf_from_area(from, point,
                                 T(1) / pdf_of_point(light, radiance_at(light, uv)));
}

/// Samples the origin of a photon with the density pdf_of_point(). The normal of the
/// point is on the side that shines.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> emission_point(const PictureLightT<T>& light,
                                              const Vec2T<T>& u, T /*time*/) {
    return detail::sample_picture(light, u).point;
}

/// The flux of a photon that leaves from a point, times the number of photons of the
/// lamp: pi times the radiance over pdf_of_point(), in W; 0 for a point outside
/// the disc.
// [flux_from]
template <std::floating_point T>
[[nodiscard]] RgbT<T> flux_from(const PictureLightT<T>& light,
                                const SurfacePointT<T>& point) {
    const Vec2T<T> uv = detail::place_in(light.frame, point.position);
    const RgbT<T>& radiance = radiance_at(light, uv);
    if (is_black(radiance) || !detail::shines_at(light, uv)) return RgbT<T>{T(0)};
    return std::numbers::pi_v<T> / pdf_of_point(light, radiance) * radiance;
}
// [flux_from]

/// \}
/// \}

} // namespace ljus
