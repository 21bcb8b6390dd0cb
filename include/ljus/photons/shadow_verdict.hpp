#pragma once

/// \file ljus/photons/shadow_verdict.hpp
/// \brief Decides from direct and shadow photons whether a shadow ray is needed.

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "ljus/path/direct_light.hpp"
#include "ljus/photons/photon_map.hpp"

namespace ljus {

/// \defgroup shadow_photons Shadow photons
/// \brief Sections 3.2.2.1 and 3.2.3: which shadow rays and indirect rays to skip.
/// Chapter: \ref ch_shadow_photons.
/// \{

/// Rules for photons that make a shadow ray unnecessary.
enum class SkipRule : std::uint8_t {
    none,   ///< Every shadow ray is cast.
    report, ///< The report's: many of one kind, few of the other; lights combined.
    any,    ///< One or more of one kind, none of the other \cite jensen1995.
    enough  ///< None of the other kind among statistically enough.
};

/// Settings for skipping rays. All but the first three are for SkipRule::enough.
struct SkipSettings {
    SkipRule rule = SkipRule::none; ///< Rule for shadow rays.
    bool indirect_rays = false;     ///< Skip those without an indirect photon near.
    float radius = 0;        ///< In scene units; 0: large enough for enough photons.
    float tolerance = 0.05f; ///< Hidden fraction of a light that may be ignored.
    float risk = 0.05f;      ///< Probability of ignoring a larger fraction.
};

/// Refuses invalid settings.
/// \throws std::invalid_argument  with name and value.
inline void check(const SkipSettings& skip) {
    require(skip.radius >= 0 && std::isfinite(skip.radius), "skip.radius",
            double(skip.radius), "at least 0 (0: chosen from the photons)");
    require(skip.tolerance > 0 && skip.tolerance < 1, "skip.tolerance",
            double(skip.tolerance), "above 0 and below 1");
    require(skip.risk > 0 && skip.risk < 1, "skip.risk", double(skip.risk),
            "above 0 and below 1");
}

/// The number of photons around a point that a rule needs.
///
/// If a fraction above tau of a light is hidden, each of its photons is a shadow photon
/// with a probability above tau, and n of them are all direct with one below
/// \f$ (1-\tau)^n \f$. This is at most the risk alpha for
/// \f$ n \ge \ln\alpha / \ln(1-\tau) \f$.
/// \return At least 1.
[[nodiscard]] inline std::uint32_t photons_needed(const SkipSettings& skip) noexcept {
    if (skip.rule == SkipRule::report) return 50;
    if (skip.rule != SkipRule::enough) return 1;
    const double tau = double(skip.tolerance);
    const double n = std::ceil(std::log(double(skip.risk)) / std::log1p(-tau));
    return n < 4e9 ? static_cast<std::uint32_t>(n) : 4000000000u;
}

namespace detail {

/// Numbers of a light's photons around a point.
struct PhotonCounts {
    std::uint32_t direct = 0; ///< Photons that arrived.
    std::uint32_t shadow = 0; ///< Photons that were occluded.
};

/// The report's program ignores one photon in as many.
inline constexpr std::uint64_t report_ratio = 1200;

/// The verdict of the photons around a point.
/// \param rule    Any but SkipRule::none.
/// \param needed  photons_needed() by this rule.
// [judge]
[[nodiscard]] constexpr Verdict judge(const PhotonCounts& found, SkipRule rule,
                                      std::uint32_t needed) noexcept {
    const std::uint64_t direct = found.direct, shadow = found.shadow;
    if (direct + shadow < needed) return Verdict::unknown;
    const std::uint64_t few = rule == SkipRule::report ? report_ratio : 0;
    if (few == 0 ? shadow == 0 : shadow * few < direct) return Verdict::lit;
    if (few == 0 ? direct == 0 : direct * few < shadow) return Verdict::shadow;
    return Verdict::unknown;
}
// [judge]

/// The facing of a surface: the axis nearest to its normal, and the sign along it. It
/// is computed from normals rounded to 1/127, as photons store them, so that all points
/// and photons of a plane have the same facing.
/// \param x,y,z  Magnitudes of the normal's coordinates in these steps.
/// \param side   +1 for the side of the normal, -1 for the other.
/// \return 0 to 5: x, y, z, then the same for negative directions.
template <typename N>
[[nodiscard]] constexpr int facing(int x, int y, int z, const N& n, int side) noexcept {
    const int larger = x >= y ? x : y;
    const int axis = larger >= z ? (x >= y ? 0 : 1) : 2;
    return (n[axis] < 0) == (side < 0) ? axis : axis + 3;
}

/// The facing of a side, from a photon's normal.
[[nodiscard]] inline int facing(const SmallNormal& n, int side) noexcept {
    return facing(std::abs(n.x), std::abs(n.y), std::abs(n.z), n, side);
}
/// The facing of a side, from a unit normal; faster than small_normal().
template <std::floating_point T>
[[nodiscard]] int facing(const Vec3T<T>& n, int side) noexcept {
    const auto size = [](T c) { return int(T(127) * std::abs(c) + T(0.5)); };
    return facing(size(n.x), size(n.y), size(n.z), n, side);
}

} // namespace detail

/// The plain counterpart of VerdictGridT: searches the map for each verdict, which
/// costs more than the ray that it may save.
/// \param map     Contains direct and shadow photons.
/// \param point   Point of a surface.
/// \param side    +1 for the side of its normal, -1 for the other.
/// \param light   Index of the light.
/// \param radius  Search radius, in scene units.
/// \param skip    The rule.
template <std::floating_point T>
[[nodiscard]] Verdict
verdict_at(const PhotonMapT<T>& map, const SurfacePointT<T>& point, int side,
           std::size_t light, T radius, const SkipSettings& skip) {
    if (skip.rule == SkipRule::none) return Verdict::unknown;
    const int way = detail::facing(point.normal, side);
    detail::PhotonCounts found;
    const auto count = [&](std::uint32_t i, double) {
        const detail::PhotonRecordT<T> photon = map.records[i];
        if (photon.light != light && skip.rule != SkipRule::report) return;
        const int its_side = photon_side(photon.direction, Vec3T<T>(photon.normal));
        if (detail::facing(photon.normal, its_side) != way) return;
        if (photon.kind == PhotonKind::direct) ++found.direct;
        if (photon.kind == PhotonKind::shadow) ++found.shadow;
    };
    map.tree.visit_within(point.position, radius, count);
    return detail::judge(found, skip.rule, photons_needed(skip));
}

/// \}

} // namespace ljus
