#pragma once

/// \file ljus/lights/goniometric_light.hpp
/// \brief A point light whose intensity was measured in many directions.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ljus/lights/light.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/math/piecewise_constant.hpp"

namespace ljus {

/// \defgroup goniometric Goniometric lamps
/// \brief Beyond the report: lamps with measured intensities. Chapter: \ref ch_lamps.
///
/// A goniophotometer turns a lamp about a vertical and a horizontal axis and measures
/// its intensity in each position \cite lm63. The two angles are coordinates on the
/// sphere of directions. The type of the photometer determines the pole of these
/// coordinates. `direction` and `reference` are members of GoniometricLightT, and the
/// side is their cross product:
///
/// | type | pole                  | polar angle     | azimuth                        |
/// |------|-----------------------|-----------------|--------------------------------|
/// | C    | `direction`           | vertical        | horizontal, from `reference`   |
/// | B    | the side              | 90 - horizontal | vertical, from `direction`     |
/// | A    | `reference`           | 90 - vertical   | horizontal, from `direction`   |
///
/// Horizontal angles grow towards the side. For the types B and A vertical angles grow
/// towards `reference`.
/// \{

/// The type of a goniophotometer; see \ref goniometric.
enum class Photometry : std::uint8_t {
    c, ///< For lamps of rooms and streets: the pole is `direction`.
    b, ///< For floodlights: the pole is the side of the lamp.
    a  ///< For headlights: the pole is `reference`, which points up.
};

/// Intensities at a grid of angles. Between the angles, the intensity is interpolated
/// bilinearly. Outside the range of the angles the intensity is 0.
struct IntensityTable {
    Photometry type = Photometry::c; ///< Type of the goniophotometer.
    /// Polar angles in degrees, within [0, 180]: at least two, in increasing order, at
    /// least 0.001 apart.
    std::vector<double> polar{};
    /// Azimuths in degrees, within [-360, 720]: at least two, in increasing order, at
    /// least 0.001 apart, over a range of at most 360.
    std::vector<double> azimuth{};
    /// Intensities in cd, at least 0. Those at all polar angles of the first azimuth
    /// come first.
    std::vector<double> candela{};
};

/// A light without extent whose intensity is given by a table, such as that of an IES
/// file; see load_ies().
///
///     scene.add(GoniometricLight{.table = load_ies("spot.ies").table,
///                                .position{0, 2.4f, 0}});
template <std::floating_point T>
struct GoniometricLightT {
    using Scalar = T;        ///< The precision of its numbers.
    IntensityTable table{};  ///< The intensities.
    Vec3T<T> position{T(0)}; ///< The position, in scene units.
    /// Axis along which the lamp shines; any length but 0.
    Vec3T<T> direction{0, -1, 0};
    /// Determines how the lamp is turned about its direction: a vector towards
    /// horizontal angle 0 (type C) or towards vertical angle 90 (types B and A). It
    /// need not be perpendicular to the direction, but must not be parallel to it.
    Vec3T<T> reference{0, 0, -1};
    /// Watts per lumen, for each channel. A watt of green light is 683 lumens. With the
    /// default, the luminance() of a picture times 683 is therefore in cd/m^2.
    RgbT<T> watts_per_lumen{T(1) / T(683)};
};
using GoniometricLight = GoniometricLightT<float>; ///< GoniometricLightT in float.

/// A goniometric light as its scene stores it.
template <std::floating_point T>
struct GoniometricInSceneT {
    using Scalar = T;        ///< The precision of its numbers.
    Vec3T<T> position{T(0)}; ///< The position, in scene units.
    /// The frame of the angles: the normal is the pole, the tangent is azimuth 0.
    FrameT<T> frame{};
    std::vector<double> polar{};   ///< Polar angles in radians.
    std::vector<double> azimuth{}; ///< Azimuths in radians.
    std::vector<double> candela{}; ///< Intensities, as in an IntensityTable.
    /// The flux between neighbouring angles, in lm. A row is an interval of polar
    /// angles.
    PiecewiseConstant2D cells{};
    RgbT<T> watts_per_lumen{T(0)}; ///< Watts per lumen, as in a GoniometricLightT.
    detail::ConeT<T> cone{};       ///< A cone around all directions of emission.
};

namespace detail {

/// The integral of a linear function times the sine, \f$ \int_0^x (c_0 + c_1 t)
/// \sin(\theta_0 + t)\,dt \f$.
// [line times sine]
[[nodiscard]] inline double line_times_sine(double c0, double c1, double theta0,
                                            double x) noexcept {
    const double sine = std::sin(theta0 + x), cosine = std::cos(theta0 + x);
    return c0 * (std::cos(theta0) - cosine) +
           c1 * (sine - std::sin(theta0) - x * cosine);
}
// [line times sine]

/// The inverse of line_times_sine(): the x in [0, length] at which the integral is the
/// fraction `part` of its value at x = length.
/// \cost About five steps of Newton's method, safeguarded by bisection; more for a
///       length below a degree.
[[nodiscard]] inline double invert_line_times_sine(double c0, double c1, double theta0,
                                                   double length,
                                                   double part) noexcept {
    const double goal = part * line_times_sine(c0, c1, theta0, length);
    double low = 0, high = length, x = part * length;
    for (int step = 0; step < 50 && high - low > 1e-12 * length; ++step) {
        const double over = line_times_sine(c0, c1, theta0, x) - goal;
        (over > 0 ? high : low) = x;
        const double next = x - over / ((c0 + c1 * x) * std::sin(theta0 + x));
        const bool inside = next > low && next < high; // false for NaN
        const double before = x;
        x = inside ? next : (low + high) / 2;
        if (std::abs(x - before) <= 1e-14 * length) break;
    }
    return x;
}

/// The x in [0, 1] that divides the area under a line: the area from 0 to x is the
/// fraction `part` of the area from 0 to 1. The line has the height a at 0 and b at 1;
/// neither is negative.
[[nodiscard]] inline double invert_line(double a, double b, double part) noexcept {
    // x is the root in [0, 1] of (b - a) x^2 / 2 + a x = part (a + b) / 2.
    const double both = part * (a + b);
    return both > 0 ? both / (a + std::sqrt(a * a + (b - a) * both)) : part;
}

/// A position between two neighbouring angles of a table.
struct BetweenAngles {
    std::size_t index = 0; ///< The index of the smaller angle.
    double part = 0;       ///< The position: 0 at the smaller angle, 1 at the larger.
};

/// The position of an angle among angles in increasing order; nothing outside their
/// range.
[[nodiscard]] inline std::optional<BetweenAngles>
between_angles(const std::vector<double>& angles, double angle) noexcept {
    if (!(angle >= angles.front() && angle <= angles.back())) return std::nullopt;
    const auto after = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
    const auto index = static_cast<std::size_t>(after - angles.begin()) - 1;
    return BetweenAngles{index,
                         (angle - angles[index]) / (angles[index + 1] - angles[index])};
}

/// The intensities at the corners of a cell of the table, in cd. Each array has the
/// intensity at the smaller azimuth, then that at the larger azimuth.
struct CellCorners {
    double low[2] = {};  ///< Intensities at the smaller polar angle.
    double high[2] = {}; ///< Intensities at the larger polar angle.
};

/// The intensities at the corners of a cell, in a table with `rows` polar angles.
/// `polar` and `azimuth` are the indices of the cell's smaller angles.
[[nodiscard]] inline CellCorners corners_of(const std::vector<double>& candela,
                                            std::size_t rows, std::size_t polar,
                                            std::size_t azimuth) noexcept {
    const double* const left = &candela[azimuth * rows + polar];
    const double* const right = left + rows;
    return {{left[0], right[0]}, {left[1], right[1]}};
}

/// The intensity in a direction, in cd.
template <std::floating_point T>
[[nodiscard]] double intensity_towards(const GoniometricInSceneT<T>& light,
                                       const Vec3T<T>& wo) noexcept {
    const Vec3T<double> d{to_local(light.frame, wo)};
    const auto polar =
        between_angles(light.polar, std::atan2(std::hypot(d.x, d.y), d.z));
    constexpr double turn = 2 * std::numbers::pi;
    const double first = light.azimuth.front(), last = light.azimuth.back();
    double around = std::atan2(d.y, d.x);
    around = std::max(first, around - turn * std::floor((around - first) / turn));
    if (around > last && around - last < 1e-9) around = last; // rounding at the seam
    const auto azimuth = between_angles(light.azimuth, around);
    if (!polar || !azimuth) return 0;
    const auto [low, high] =
        corners_of(light.candela, light.polar.size(), polar->index, azimuth->index);
    return std::lerp(std::lerp(low[0], low[1], azimuth->part),
                     std::lerp(high[0], high[1], azimuth->part), polar->part);
}

/// The frame in which the angles of a light's table are measured, in the world. Its
/// normal points to the pole, and its tangent to azimuth 0.
template <std::floating_point T>
[[nodiscard]] FrameT<T> frame_of(const GoniometricLightT<T>& light) {
    const Vec3T<T> aim = unit_along(light.direction);
    const Vec3T<T> across = glm::cross(aim, unit_along(light.reference));
    require(glm::dot(across, across) > T(1e-8), "goniometric light.reference",
            light.reference, "a vector that is not along the direction");
    const Vec3T<T> side = glm::normalize(across);
    const Vec3T<T> reference = glm::cross(side, aim);
    switch (light.table.type) {
    case Photometry::a:
        return {aim, side, reference};
    case Photometry::b:
        return {aim, reference, side};
    default:
        return {reference, side, aim};
    }
}

/// Requires at least two angles within [first, last], in increasing order and at least
/// 0.001 degrees apart.
inline void check_angles(const std::vector<double>& angles, const char* what,
                         double first, double last) {
    require_at_least(join({"the number of ", what, " angles"}),
                     static_cast<long long>(angles.size()), 2);
    double before = first - 1;
    for (const double angle : angles) {
        const bool ok = angle >= first && angle <= last && angle - before >= 1e-3;
        if (!ok)
            refuse(join({"a ", what, " angle"}), angle,
                   join({"within [", to_text(first), ", ", to_text(last),
                         "] and at least 0.001 degrees beyond the one before"}));
        before = angle;
    }
}

} // namespace detail

/// \name A goniometric light
/// \{

/// Checks a table of intensities.
/// \throws std::invalid_argument  if an angle is out of range; if angles are not in
///         increasing order; or if an intensity is missing, negative or above 1e12 cd.
inline void check(const IntensityTable& table) {
    detail::check_angles(table.polar, "polar", 0, 180);
    detail::check_angles(table.azimuth, "azimuth", -360, 720);
    const double turn = table.azimuth.back() - table.azimuth.front();
    require(turn <= 360, "the range of azimuths", turn, "at most 360 degrees");
    require(table.candela.size() == table.polar.size() * table.azimuth.size(),
            "the number of intensities", static_cast<long long>(table.candela.size()),
            "that of the polar angles times that of the azimuths");
    for (const double candela : table.candela)
        require(candela >= 0 && candela <= 1e12, "an intensity", candela,
                "within [0, 1e12] cd");
}

/// Checks a goniometric light.
/// \throws std::invalid_argument  as check() of the table; if a vector is not finite;
///         if direction or reference is 0, or both are parallel; or if
///         `watts_per_lumen` is negative or not finite.
template <std::floating_point T>
void check(const GoniometricLightT<T>& light) {
    check(light.table);
    require_finite("goniometric light.position", light.position);
    require_radiance("goniometric light.watts_per_lumen", light.watts_per_lumen);
    require_direction("goniometric light.direction", light.direction);
    require_direction("goniometric light.reference", light.reference);
    (void)detail::frame_of(light);
}

/// Prepares a light, which must have passed check(), for its scene.
/// \cost 8 bytes per intensity besides the table.
template <std::floating_point T>
[[nodiscard]] GoniometricInSceneT<T> in_scene(const GoniometricLightT<T>& light,
                                              const SphereT<T>&) {
    constexpr double radians = std::numbers::pi / 180;
    const IntensityTable& table = light.table;
    GoniometricInSceneT<T> made{.position = light.position,
                                .frame = detail::frame_of(light),
                                .polar = table.polar,
                                .azimuth = table.azimuth,
                                .candela = table.candela,
                                .watts_per_lumen = light.watts_per_lumen};
    for (double& angle : made.polar) angle *= radians;
    for (double& angle : made.azimuth) angle *= radians;
    const std::size_t rows = table.polar.size();
    double widest = 0; // polar angle beyond which the intensity is 0
    const auto flux_of = [&](int x, int y) {
        const auto i = static_cast<std::size_t>(y), j = static_cast<std::size_t>(x);
        const auto [low, high] = detail::corners_of(made.candela, rows, i, j);
        const double length = made.polar[i + 1] - made.polar[i];
        const double first = (low[0] + low[1]) / 2, last = (high[0] + high[1]) / 2;
        if (first + last > 0) widest = made.polar[i + 1];
        return (made.azimuth[j + 1] - made.azimuth[j]) *
               detail::line_times_sine(first, (last - first) / length, made.polar[i],
                                       length);
    };
    const bool dark =
        *std::max_element(table.candela.begin(), table.candela.end()) == 0;
    if (!dark)
        made.cells = make_piecewise_constant(int(table.azimuth.size()) - 1,
                                             int(rows) - 1, flux_of);
    if (light.table.type == Photometry::c) {
        const double sine = std::sin(widest / 2);
        made.cone = {made.frame.normal, static_cast<T>(2 * sine * sine)};
    }
    return made;
}

namespace detail {

/// The emitted flux in lm: the integral of the intensity over all directions.
template <std::floating_point T>
[[nodiscard]] double lumens_of(const GoniometricInSceneT<T>& light) noexcept {
    return light.cells.rows.empty() ? 0 : light.cells.rows.back();
}

} // namespace detail

/// The emitted flux in W. It is the exact integral of the interpolated intensities.
template <std::floating_point T>
[[nodiscard]] RgbT<T> power(const GoniometricInSceneT<T>& light) noexcept {
    return static_cast<T>(detail::lumens_of(light)) * light.watts_per_lumen;
}

/// Samples the light for a shadow ray. The weight is intensity over squared distance,
/// and the pdf is 0.
/// \return Nothing if the intensity towards `from` is 0.
template <std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>>
sample_light(const GoniometricInSceneT<T>& light, const Vec3T<T>& from,
             const Vec2T<T>& /*u*/, T /*time*/) noexcept {
    return detail::sample_point(light.position, from, [&](const Vec3T<T>& wo) {
        return static_cast<T>(detail::intensity_towards(light, wo)) *
               light.watts_per_lumen;
    });
}

/// The position of the light.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> emission_point(const GoniometricInSceneT<T>& light,
                                      const Vec2T<T>&, T) noexcept {
    return light.position;
}

/// Samples the unit direction of a photon, in proportion to the intensity: a cell of
/// the table by its flux, then a polar angle within the cell, and then an azimuth.
/// \cost Two binary searches, and about five steps of Newton's method; more if angles
///       are less than a degree apart.
// [sample_emission]
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_emission(const GoniometricInSceneT<T>& light,
                                       const Vec3T<T>&, const Vec2T<T>& u) noexcept {
    const CellT<T> cell = sample_cell(light.cells, u);
    const auto i = static_cast<std::size_t>(cell.y),
               j = static_cast<std::size_t>(cell.x);
    const auto [low, high] =
        detail::corners_of(light.candela, light.polar.size(), i, j);
    const double length = light.polar[i + 1] - light.polar[i];
    const double first = (low[0] + low[1]) / 2, last = (high[0] + high[1]) / 2;
    const double x = detail::invert_line_times_sine(
        first, (last - first) / length, light.polar[i], length, double(cell.within.y));
    const double y = detail::invert_line(std::lerp(low[0], high[0], x / length),
                                         std::lerp(low[1], high[1], x / length),
                                         double(cell.within.x));
    const double theta = light.polar[i] + x;
    const double phi = std::lerp(light.azimuth[j], light.azimuth[j + 1], y);
    return to_world(light.frame,
                    Vec3T<T>{T(std::sin(theta) * std::cos(phi)),
                             T(std::sin(theta) * std::sin(phi)), T(std::cos(theta))});
}
// [sample_emission]

/// The density of sample_emission(), per steradian: intensity over emitted flux.
template <std::floating_point T>
[[nodiscard]] T pdf_emission(const GoniometricInSceneT<T>& light, const Vec3T<T>&,
                             const Vec3T<T>& wo) noexcept {
    return static_cast<T>(detail::intensity_towards(light, wo) /
                          detail::lumens_of(light));
}

/// A cone around all directions in which the light shines. For the types B and A it is
/// the whole sphere.
template <std::floating_point T>
[[nodiscard]] detail::ConeT<T> emission_cone(const GoniometricInSceneT<T>& light,
                                             const Vec3T<T>&) noexcept {
    return light.cone;
}

/// \}
/// \}

} // namespace ljus
