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
/// \brief Sections 3.2.2.1 and 3.2.3 of the report: which shadow rays and indirect rays
/// to skip. Chapter: \ref ch_shadow_photons.
/// \{

/// A rule by which the photons around a point make a shadow ray unnecessary. Direct
/// photons mean that a light is visible, shadow photons that it is occluded.
enum class SkipRule : std::uint8_t {
    none, ///< Every shadow ray is cast.
    /// The rule of the report: it needs many photons of one kind and few of the other.
    /// The photons of all lights are counted together.
    report,
    /// Needs at least one photon of one kind and none of the other \cite jensen1995.
    any,
    enough ///< Needs photons_needed() photons of one kind and none of the other.
};

/// Settings for skipping rays. `tolerance` and `risk` are used by SkipRule::enough.
struct SkipSettings {
    SkipRule rule = SkipRule::none; ///< Rule for shadow rays.
    /// Whether indirect rays are skipped where no indirect photon is near.
    bool indirect_rays = false;
    /// Search radius in scene units. If it is 0, it is chosen from the photons.
    float radius = 0;
    float tolerance = 0.05f; ///< Occluded fraction of a light that may be ignored.
    /// Probability of ignoring an occluded fraction above `tolerance`.
    float risk = 0.05f;
};

/// Checks the settings.
/// \throws std::invalid_argument  if a number is out of range.
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
/// For SkipRule::enough, let tau be the tolerance and alpha the risk. If a fraction
/// above tau of a light is occluded, a photon of this light is a shadow photon with a
/// probability above tau. The probability that n photons are all direct is then below
/// \f$ (1-\tau)^n \f$, which is at most alpha for
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

/// Whether the settings skip any rays.
[[nodiscard]] constexpr bool skips_rays(const SkipSettings& skip) noexcept {
    return skip.rule != SkipRule::none || skip.indirect_rays;
}

/// Numbers of a light's photons around a point.
struct PhotonCounts {
    std::uint32_t direct = 0;
    std::uint32_t shadow = 0;
};

/// The rule of the report ignores the photons of one kind if the other kind is more
/// frequent by more than this factor.
inline constexpr std::uint64_t report_ratio = 1200;

/// The verdict of the photons around a point, by a rule other than SkipRule::none.
/// \param needed  The result of photons_needed().
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

/// The facing of a side of a surface: the coordinate axis that is nearest to the normal
/// of this side, with its sign. Normals are rounded to steps of 1/127, as photons store
/// them. All points and photons of a plane therefore have the same facing.
/// \param x,y,z  Absolute values of the normal's components, in steps of 1/127.
/// \param n      The normal; the signs of its components are used.
/// \param side   +1 for the side of the normal, -1 for the other side.
/// \return 0, 1 or 2 for +x, +y or +z; 3, 4 or 5 for -x, -y or -z.
template <typename N>
[[nodiscard]] constexpr int facing(int x, int y, int z, const N& n, int side) noexcept {
    const int larger = x >= y ? x : y;
    const int axis = larger >= z ? (x >= y ? 0 : 1) : 2;
    return (n[axis] < 0) == (side < 0) ? axis : axis + 3;
}

/// The facing of a side of a surface whose normal is in three bytes.
[[nodiscard]] inline int facing(const SmallNormal& n, int side) noexcept {
    return facing(std::abs(n.x), std::abs(n.y), std::abs(n.z), n, side);
}
/// The facing of a side of a surface with a unit normal.
template <std::floating_point T>
[[nodiscard]] int facing(const Vec3T<T>& n, int side) noexcept {
    const auto size = [](T c) { return int(T(127) * std::abs(c) + T(0.5)); };
    return facing(size(n.x), size(n.y), size(n.z), n, side);
}

/// The facing of the side of the surface on which a photon arrives.
/// \param photon  A PhotonT or a PhotonRecordT.
template <typename P>
[[nodiscard]] int facing(const P& photon) noexcept {
    using Vec = decltype(photon.direction);
    return facing(photon.normal, photon_side(photon.direction, Vec(photon.normal)));
}

} // namespace detail

/// The plain counterpart of VerdictGridT. It searches the map for each verdict, which
/// takes longer than the shadow ray that the verdict may save.
/// \param map     The map, with direct and shadow photons.
/// \param point   Point of a surface.
/// \param side    +1 for the side of its normal, -1 for the other side.
/// \param light   Index of the light.
/// \param radius  Search radius, in scene units.
/// \param skip    The settings; `radius` in them is not used.
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
        if (detail::facing(photon) != way) return;
        if (photon.kind == PhotonKind::direct) ++found.direct;
        if (photon.kind == PhotonKind::shadow) ++found.shadow;
    };
    map.tree.visit_within(point.position, radius, count);
    return detail::judge(found, skip.rule, photons_needed(skip));
}

/// \}

} // namespace ljus
