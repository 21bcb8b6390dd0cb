#pragma once

/// \file ljus/photons/shadow_verdict.hpp
/// \brief What direct and shadow photons say of a shadow ray: is it needed?

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "ljus/path/direct_light.hpp"
#include "ljus/photons/photon_map.hpp"

namespace ljus {

/// \defgroup shadow_photons Shadow photons
/// \brief Sections 3.2.2.1 and 3.2.3: which shadow rays and indirect rays are needless.
/// Chapter: \ref ch_shadow_photons.
/// \{

/// How many photons of which kind make a shadow ray needless.
enum class SkipRule : std::uint8_t {
    none,   ///< Every shadow ray is cast.
    report, ///< The report's: many of one kind and few of the other, all lights alike.
    any,    ///< One or more of one kind, none of the other \cite jensen1995.
    enough  ///< None of the other kind among so many that chance is no excuse.
};

/// How rays are skipped. The rest of the numbers belong to SkipRule::enough.
struct SkipSettings {
    SkipRule rule = SkipRule::none; ///< For shadow rays.
    bool indirect_rays = false;     ///< Send none where no indirect photon is near.
    float radius = 0;        ///< In scene units; 0: as far as enough photons lie.
    float tolerance = 0.05f; ///< The hidden share of a light that does not matter.
    float risk = 0.05f; ///< Of calling a point lit whose share is above the tolerance.
};

/// Refuses settings that make no sense.
/// \param skip  The settings.
/// \throws std::invalid_argument  with name and value.
inline void check(const SkipSettings& skip) {
    require(skip.radius >= 0 && std::isfinite(skip.radius), "skip.radius",
            double(skip.radius), "at least 0 (0: chosen from the photons)");
    require(skip.tolerance > 0 && skip.tolerance < 1, "skip.tolerance",
            double(skip.tolerance), "above 0 and below 1");
    require(skip.risk > 0 && skip.risk < 1, "skip.risk", double(skip.risk),
            "above 0 and below 1");
}

/// How many photons around a point a rule asks for before it says anything.
///
/// If a share above tau of a light is hidden, each of its photons is a shadow photon
/// with a probability above tau, and n of them are all direct with one below
/// \f$ (1-\tau)^n \f$. That is at most the risk alpha from
/// \f$ n = \ln\alpha / \ln(1-\tau) \f$ on.
/// \param skip  The settings.
/// \return At least 1.
// [photons_needed]
[[nodiscard]] inline std::uint32_t photons_needed(const SkipSettings& skip) noexcept {
    if (skip.rule == SkipRule::report) return 50;
    if (skip.rule != SkipRule::enough) return 1;
    const double tau = double(skip.tolerance);
    const double n = std::ceil(std::log(double(skip.risk)) / std::log1p(-tau));
    return n < 4e9 ? static_cast<std::uint32_t>(n) : 4000000000u;
}
// [photons_needed]

namespace detail {

/// The photons of a light around a point.
struct PhotonCounts {
    std::uint32_t direct = 0; ///< They came.
    std::uint32_t shadow = 0; ///< Something stood in their way.
};

/// The report's "nearly none": one in so many, by its program.
inline constexpr std::uint64_t report_ratio = 1200;

/// What photons say.
/// \param found   The photons around a point.
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

/// Which way a surface faces: the axis to which its normal is nearest, and which way
/// along it. In steps of 1/127, as photons keep normals: so the points and the photons
/// of a plane face the same way, however it is tilted.
/// \param x,y,z  The sizes of the normal's coordinates in these steps.
/// \param n      The normal.
/// \param side   +1, or -1 for the side that the normal does not point to.
/// \return 0 to 5: x, y, z, and 3 more for the negative direction.
// [facing]
template <typename N>
[[nodiscard]] constexpr int facing(int x, int y, int z, const N& n, int side) noexcept {
    const int larger = x >= y ? x : y;
    const int axis = larger >= z ? (x >= y ? 0 : 1) : 2;
    return (n[axis] < 0) == (side < 0) ? axis : axis + 3;
}
// [facing]

/// Which way a side faces, by a photon's normal.
[[nodiscard]] inline int facing(const SmallNormal& n, int side) noexcept {
    return facing(std::abs(n.x), std::abs(n.y), std::abs(n.z), n, side);
}
/// Which way a side faces, by a unit vector: rounded as in small_normal(), but faster.
template <std::floating_point T>
[[nodiscard]] int facing(const Vec3T<T>& n, int side) noexcept {
    const auto size = [](T c) { return int(T(127) * std::abs(c) + T(0.5)); };
    return facing(size(n.x), size(n.y), size(n.z), n, side);
}

} // namespace detail

/// The plain twin: asks the map what is known of a light at a point. A search for each
/// question costs more than the ray that it saves; see VerdictGridT.
/// \param map     With direct and shadow photons.
/// \param point   Of a surface.
/// \param side    Which side of it: +1 if the normal points to it, else -1.
/// \param light   The number of the light.
/// \param radius  Photons count as far as that, in scene units.
/// \param skip    The rule.
/// \return The verdict.
// [verdict_at]
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
// [verdict_at]

/// The irradiance that may be there though no photon is seen.
///
/// The photons in a disc are Poisson distributed. If their mean is m, there is none
/// with the probability \f$ e^{-m} \f$: below 5 % for a mean above 3. So, but for one
/// case in twenty,
/// \f[ E \le \frac{3\,\Delta\Phi}{\pi r^2} \f]
/// \param flux    Of one photon, in W.
/// \param radius  Of the disc, in scene units; all of it on the surface.
/// \param risk    How often the bound may be wrong.
/// \return W over squared scene units.
template <std::floating_point T>
[[nodiscard]] RgbT<T> unseen_irradiance(const RgbT<T>& flux, T radius,
                                        T risk = T(0.05)) noexcept {
    constexpr T pi = T(3.14159265358979323846L);
    return -std::log(risk) / (pi * radius * radius) * flux;
}

/// \}

} // namespace ljus
