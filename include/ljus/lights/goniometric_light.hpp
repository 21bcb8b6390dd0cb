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
/// \brief Beyond the report: lamps as their makers measure them. Chapter: \ref
/// ch_lamps.
///
/// A goniophotometer turns a lamp about two axes and writes down its intensity in each
/// position \cite lm63. The two angles are coordinates on the sphere of directions, and
/// the type of the photometer says where their pole lies:
///
/// | type | pole                  | polar angle     | azimuth                        |
/// |------|-----------------------|-----------------|--------------------------------|
/// | C    | where the lamp shines | vertical        | horizontal, from `reference`   |
/// | B    | to the side           | 90 - horizontal | vertical, from where it aims  |
/// | A    | `reference`           | 90 - vertical   | horizontal, from where it aims |
///
/// The side is the cross product of `direction` and `reference`; horizontal angles grow
/// towards it, vertical angles of the types B and A towards `reference`.
/// \{

/// The axes of a goniophotometer.
enum class Photometry : std::uint8_t {
    c, ///< Lamps of rooms and streets: the pole is where the lamp shines.
    b, ///< Floodlights: the pole is to the side.
    a  ///< Headlights: the pole is up.
};

/// Intensities over a grid of angles, interpolated bilinearly in the angles. Beyond the
/// first and the last angles it is dark.
struct IntensityTable {
    Photometry type = Photometry::c; ///< Where the pole of the angles lies.
    std::vector<double> polar{};     ///< Degrees from the pole, within [0, 180]; at
                                     ///< least two, growing.
    std::vector<double> azimuth{};   ///< Degrees, within [-360, 720]; at least two,
                                     ///< growing, and at most 360 apart.
    std::vector<double> candela{};   ///< For each azimuth, the intensities at all polar
                                     ///< angles; cd, at least 0.
};

/// A light without extent whose intensity is a table, as load_ies() reads it.
///
///     scene.add(GoniometricLight{.table = load_ies("spot.ies").table,
///                                .position{0, 2.4f, 0}});
template <std::floating_point T>
struct GoniometricLightT {
    using Scalar = T;             ///< The precision.
    IntensityTable table{};       ///< The intensities.
    Vec3T<T> position{T(0)};      ///< In scene units.
    Vec3T<T> direction{0, -1, 0}; ///< In which the lamp shines; any length but 0.
    /// A vector on the side of horizontal angle 0 (type C), or of vertical angle 90
    /// (types B and A): it says how the lamp is turned about its direction. It need not
    /// be perpendicular to the direction.
    Vec3T<T> reference{0, 0, -1};
    /// W/sr for each candela. The default makes 683 times the luminance of a colour a
    /// photometric quantity, because 683 lumens are a watt of green light.
    RgbT<T> watts_per_lumen{T(1) / T(683)};
};
using GoniometricLight = GoniometricLightT<float>; ///< GoniometricLightT in float.

/// A goniometric light as its scene stores it.
template <std::floating_point T>
struct GoniometricInSceneT {
    using Scalar = T;              ///< The precision.
    Vec3T<T> position{T(0)};       ///< In scene units.
    FrameT<T> frame{};             ///< The normal is the pole, the tangent azimuth 0.
    std::vector<double> polar{};   ///< Radians.
    std::vector<double> azimuth{}; ///< Radians.
    std::vector<double> candela{}; ///< As in an IntensityTable.
    PiecewiseConstant2D cells{};   ///< Flux between neighbouring angles, lm; a row for
                                   ///< each interval of polar angles.
    RgbT<T> watts_per_lumen{T(0)}; ///< As in a GoniometricLightT.
    detail::ConeT<T> cone{};       ///< All directions in which it shines.
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

/// Where the integral of a linear function times the sine reaches a part of its value.
/// \param c0      The function at the beginning, at least 0.
/// \param part    In [0, 1].
/// \return In [0, length].
/// \cost Some four steps of Newton's method, between bounds that close in.
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

/// Where the integral of a linear function over [0, 1] reaches a part of its value.
/// \param a, b  The function at 0 and at 1, at least 0.
/// \param part  In [0, 1].
[[nodiscard]] inline double invert_line(double a, double b, double part) noexcept {
    // The root of (b - a) x^2 / 2 + a x = part (a + b) / 2 that lies in [0, 1].
    const double both = part * (a + b);
    return both > 0 ? both / (a + std::sqrt(a * a + (b - a) * both)) : part;
}

/// A position between the angles of a table.
struct BetweenAngles {
    std::size_t index = 0; ///< Of the angle before.
    double part = 0;       ///< Within [0, 1], from there to the next.
};

/// The interval of growing angles in which an angle lies.
/// \return Nothing outside of all of them.
[[nodiscard]] inline std::optional<BetweenAngles>
between_angles(const std::vector<double>& angles, double angle) noexcept {
    if (!(angle >= angles.front() && angle <= angles.back())) return std::nullopt;
    const auto after = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
    const auto index = static_cast<std::size_t>(after - angles.begin()) - 1;
    return BetweenAngles{index,
                         (angle - angles[index]) / (angles[index + 1] - angles[index])};
}

struct CellCorners {
    double low[2] = {};  ///< At the smaller polar angle, at both azimuths.
    double high[2] = {}; ///< At the larger one.
};

/// The intensities around a cell.
[[nodiscard]] inline CellCorners corners_of(const std::vector<double>& candela,
                                            std::size_t rows, std::size_t polar,
                                            std::size_t azimuth) noexcept {
    const double* const left = &candela[azimuth * rows + polar];
    const double* const right = left + rows;
    return {{left[0], right[0]}, {left[1], right[1]}};
}

/// The intensity in a direction.
/// \return cd.
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

/// The frame of a table's angles in the world.
template <std::floating_point T>
[[nodiscard]] FrameT<T> frame_of(const GoniometricLightT<T>& light) {
    const Vec3T<T> aim = unit_along("goniometric light.direction", light.direction);
    const Vec3T<T> across =
        glm::cross(aim, unit_along("goniometric light.reference", light.reference));
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

/// Refuses angles that do not grow.
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

/// Refuses an invalid table.
/// \throws std::invalid_argument  if angles are out of range or do not grow, or an
///         intensity is negative, not finite or missing.
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

/// Refuses an invalid light.
/// \throws std::invalid_argument  as check() of its table, or if a vector is not
///         finite, the reference is along the direction, or `watts_per_lumen` negative.
template <std::floating_point T>
void check(const GoniometricLightT<T>& light) {
    check(light.table);
    require_finite("goniometric light.position", light.position);
    require_radiance("goniometric light.watts_per_lumen", light.watts_per_lumen);
    (void)detail::frame_of(light);
}

/// Prepares a checked light for its scene: integrates the intensity between
/// neighbouring angles.
/// \cost 8 bytes for each intensity beside the table.
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
    double widest = 0; // polar angle up to which it shines
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

/// The flux of the table: the integral of the intensity over all directions.
/// \return lm; 0 for a table that is dark everywhere.
template <std::floating_point T>
[[nodiscard]] double lumens_of(const GoniometricInSceneT<T>& light) noexcept {
    return light.cells.rows.empty() ? 0 : light.cells.rows.back();
}

} // namespace detail

/// The flux in W: the exact integral of the table over all directions.
template <std::floating_point T>
[[nodiscard]] RgbT<T> power(const GoniometricInSceneT<T>& light) noexcept {
    return static_cast<T>(detail::lumens_of(light)) * light.watts_per_lumen;
}

/// Samples the light for a shadow ray from a point.
/// \return Intensity / distance^2 with the density 0; nothing where it is dark.
template <std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>>
sample_light(const GoniometricInSceneT<T>& light, const Vec3T<T>& from,
             const Vec2T<T>& /*u*/, T /*time*/) noexcept {
    return detail::sample_point(light.position, from, [&](const Vec3T<T>& wo) {
        return static_cast<T>(detail::intensity_towards(light, wo)) *
               light.watts_per_lumen;
    });
}

/// The origin of its photons.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> emission_point(const GoniometricInSceneT<T>& light,
                                      const Vec2T<T>&, T) noexcept {
    return light.position;
}

/// Samples the unit direction of a photon, with the density of the intensity: a cell of
/// the table by its flux, the polar angle in it, and the azimuth at that polar angle.
/// \cost Two binary searches, and some four sines and cosines for Newton's method.
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

/// The density of sample_emission(): intensity over flux, per steradian.
template <std::floating_point T>
[[nodiscard]] T pdf_emission(const GoniometricInSceneT<T>& light, const Vec3T<T>&,
                             const Vec3T<T>& wo) noexcept {
    return static_cast<T>(detail::intensity_towards(light, wo) /
                          detail::lumens_of(light));
}

/// A cone around all directions in which it shines; for the types B and A all
/// directions.
template <std::floating_point T>
[[nodiscard]] detail::ConeT<T> emission_cone(const GoniometricInSceneT<T>& light,
                                             const Vec3T<T>&) noexcept {
    return light.cone;
}

/// \}
/// \}

} // namespace ljus
