#pragma once

/// \file ljus/photons/volume_photons.hpp
/// \brief Photons where fog scatters them, and the radiance of a ray from such photons.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <type_traits>
#include <vector>

#include "ljus/accel/bvh.hpp"
#include "ljus/accel/bvh8.hpp"
#include "ljus/accel/kd_tree8.hpp"
#include "ljus/math/require.hpp"
#include "ljus/parallel.hpp"
#include "ljus/path/fog_path.hpp"
#include "ljus/photons/kernel.hpp"
#include "ljus/photons/photon.hpp"

namespace ljus {

/// \defgroup volume_photons Photons in fog
/// \brief Beyond the report: the volume photon map \cite jensen1998 and the beam
/// radiance estimate \cite jarosz2008. Chapter: \ref ch_volume_photons.
///
/// A photon pass stores a photon at each point where fog scatters a photon. The light
/// that fog scatters along a ray to its origin is then a sum over the photons near the
/// ray,
///
/// \f[ L = \sum_i \frac{w(d_i^2 / r_i^2)}{\pi r_i^2}\,\varrho(\theta_i)\,T(t_i)\,
///     \Delta\Phi_i , \f]
///
/// where d_i is the distance at which the ray passes photon i, t_i the length of the
/// ray up to its point nearest to the photon, and r_i the radius of the photon. Only
/// photons with d_i < r_i count. w is the weight of the kernel, \f$ \varrho \f$ the
/// phase function, \f$ \theta_i \f$ the angle by which light is turned, T the
/// transmittance of the fog, and \f$ \Delta\Phi_i \f$ the flux of the photon.
/// \{

/// A photon in fog.
template <std::floating_point T>
struct VolumePhotonT {
    Vec3T<T> position{T(0)};  ///< Point where fog scatters the photon, in scene units.
    Vec3T<T> direction{T(0)}; ///< Unit direction of travel before the scattering.
    RgbT<T> flux{T(0)};       ///< Scattered flux, in W.
    T radius = T(1); ///< Radius of the ball that holds the flux, in scene units.
    std::uint32_t medium = 0; ///< Index of the medium; see visit_fog().
};
using VolumePhoton = VolumePhotonT<float>; ///< VolumePhotonT in float: 44 bytes.

/// How the flux of photons in fog is spread.
struct BeamEstimateSettings {
    /// Radius of the ball over which the flux of a photon is spread, in scene units. If
    /// 0, each photon's radius is the distance to its n-th nearest neighbour, where n
    /// is `nearest`.
    float radius = 0;
    std::size_t nearest = 10; ///< Which neighbour sets the radius, 1 to 511.
    Kernel kernel = Kernel::epanechnikov; ///< Weight by the distance from the ray.
};

/// Checks the settings.
/// \throws std::invalid_argument  if a number is out of range.
inline void check(const BeamEstimateSettings& settings) {
    require(settings.radius >= 0 && std::isfinite(settings.radius),
            "fog_estimate.radius", double(settings.radius),
            "at least 0 (0: chosen for each photon)");
    require(settings.nearest >= 1 && settings.nearest <= 511, "fog_estimate.nearest",
            static_cast<long long>(settings.nearest), "within [1, 511]");
}

/// Photons in fog. Each has a ball around it, and a tree holds the boxes of the balls.
template <std::floating_point T>
struct VolumeMapT {
    /// The type of the tree. A World uses the same type.
    using Tree = std::conditional_t<std::is_same_v<T, float>, Bvh8, BvhT<T>>;
    Tree tree{};                             ///< The tree over the boxes.
    std::vector<VolumePhotonT<T>> photons{}; ///< The photons, in the order of the tree.

    /// Whether the map has no photons.
    [[nodiscard]] bool empty() const noexcept { return photons.empty(); }
};
using VolumeMap = VolumeMapT<float>; ///< VolumeMapT in float.

namespace detail {

/// Sets the radii as BeamEstimateSettings describes. If the distance to the neighbour
/// is 0, the radius is a thousandth of the longest side of the box around all photons.
// [radii]
template <std::floating_point T>
[[gnu::cold]] void set_radii(std::vector<VolumePhotonT<T>>& photons,
                             std::size_t nearest, int threads) {
    std::vector<Vec3T<T>> positions;
    BoxT<T> all;
    for (const VolumePhotonT<T>& photon : photons) {
        positions.push_back(photon.position);
        all = box_union(all, photon.position);
    }
    const KdTree8T<T> tree(positions, threads);
    const T size = max_component(all.high - all.low);
    const T least = size > T(0) ? T(1e-3) * size : T(1);
    const auto set_radius = [&](std::size_t i) {
        std::array<Neighbor, 512> room;
        const std::span<Neighbor> found(room.data(), nearest + 1); // with the photon
        const std::size_t near = tree.template nearest<512>(
            photons[i].position, std::numeric_limits<T>::infinity(), found);
        const T radius = near > 1 ? T(std::sqrt(found[0].distance2)) : T(0);
        photons[i].radius = radius > T(0) ? radius : least;
    };
    parallel_each(photons.size(), 1024, set_radius, {.threads = threads});
}
// [radii]

} // namespace detail

/// Builds a map of the photons that fog scatters. Photons of other kinds are left out.
/// \param photons   The photons of a pass.
/// \param settings  The radius of the photons.
/// \param threads   As in ParallelSettings.
/// \return The map, the same for any number of threads.
/// \throws std::invalid_argument  if a setting is out of range, or a position or a flux
///         is not finite.
/// \cost One search per photon if settings.radius is 0.
template <std::floating_point T>
[[nodiscard, gnu::cold]] VolumeMapT<T>
make_volume_map(const std::vector<PhotonT<T>>& photons,
                const BeamEstimateSettings& settings = {}, int threads = 0) {
    check(settings);
    std::vector<VolumePhotonT<T>> found;
    for (const PhotonT<T>& photon : photons) {
        if (photon.kind != PhotonKind::fog) continue;
        require_finite("photon.flux", photon.flux);
        found.push_back({photon.position, photon.direction, photon.flux,
                         T(settings.radius), photon.light});
    }
    if (settings.radius == 0) detail::set_radii(found, settings.nearest, threads);
    std::vector<BoxT<T>> boxes;
    for (const auto& [position, direction, flux, radius, medium] : found)
        boxes.push_back({position - radius, position + radius});
    VolumeMapT<T> map;
    map.tree = typename VolumeMapT<T>::Tree(boxes, {.threads = threads});
    for (const std::uint32_t id : map.tree.primitive_ids())
        map.photons.push_back(found[id]);
    return map;
}

/// The geometric mean of the radii of a map's photons.
/// \return In scene units; 1 if there are no photons.
template <std::floating_point T>
[[nodiscard, gnu::cold]] T typical_radius(const VolumeMapT<T>& map) {
    double logarithms = 0;
    for (const VolumePhotonT<T>& photon : map.photons)
        logarithms += std::log(double(photon.radius)) / double(map.photons.size());
    return static_cast<T>(std::exp(logarithms));
}

/// The radiance that one photon adds to a ray. The part of its disc that lies outside
/// the fog is folded back at the border, by mirror images of the photon: without them
/// the fog would be too dark within a radius of its border, and would glow outside.
/// Where the radius is larger than the fog is thick, the fog is nevertheless too dark.
/// \param world   The closed scene.
/// \param photon  The photon.
/// \param ray     The ray, which has a unit direction and lies outside all bodies. Its
///                t_max is the distance to the next surface.
/// \param kernel  The kernel.
/// \return W/(m^2 sr) at the origin of the ray. 0 if the ray passes the photon at a
///         distance above the photon's radius, or ends before it reaches the photon.
// [beam]
template <AnyWorld W, std::floating_point T, KernelLike<T> K>
[[nodiscard]] RgbT<T> light_of_photon(const W& world, const VolumePhotonT<T>& photon,
                                      const RayT<T>& ray, const K& kernel) {
    RgbT<T> light{T(0)};
    const T radius2 = photon.radius * photon.radius;
    const auto place = [&](const Vec3T<T>& position) { // t and the squared distance
        const Vec3T<T> to = position - ray.origin;
        const T t = glm::dot(to, ray.direction);
        const Vec3T<T> off = to - t * ray.direction;
        return Vec2T<T>{t, glm::dot(off, off)};
    };
    if (!(place(photon.position).y < radius2)) return light; // nor do its images count
    visit_fog(world, photon.medium, [&](const auto& medium) {
        const auto span = span_in(medium, ray); // where the ray is in this fog
        if (!span) return;
        const T turned = phase(medium, -glm::dot(ray.direction, photon.direction));
        const auto add = [&](const Vec3T<T>& image, T weight) {
            const Vec2T<T> at = place(image);
            if (!(at.x > span->first && at.x < span->last && at.y < radius2)) return;
            RayT<T> before = ray;
            before.t_max = at.x;
            light += weight * turned * kernel_weight(kernel, at.y / radius2) /
                     (std::numbers::pi_v<T> * radius2) * photon.flux *
                     transmittance(optical_depth(world, before), T(1));
        };
        each_image(medium, photon.position, photon.radius, add);
    });
    return light;
}
// [beam]

/// The plain counterpart of estimate_beam(). It loops over all photons.
// [plain beam]
template <AnyWorld W, std::floating_point T, KernelLike<T> K>
[[nodiscard]] RgbT<T> estimate_beam_plain(const W& world, const VolumeMapT<T>& map,
                                          const RayT<T>& ray, const K& kernel) {
    RgbT<double> sum{0}; // in double, because float would lose the last terms
    for (const VolumePhotonT<T>& photon : map.photons)
        sum += RgbT<double>(light_of_photon(world, photon, ray, kernel));
    return RgbT<T>(sum);
}
// [plain beam]

/// The radiance that fog scatters along a ray to its origin, from the photons of a map.
/// The estimate is too dark near surfaces inside the fog: a photon is spread over a
/// ball, of which a part lies behind the surface there. Objects between a photon and
/// the ray are ignored.
/// \param world    The closed scene.
/// \param map      The photons.
/// \param ray      As for light_of_photon().
/// \param kernel   The kernel.
/// \param visited  A counter. The number of photons whose boxes the ray meets is added
///                 to it.
/// \return Radiance, in W/(m^2 sr).
/// \cost One call of light_of_photon() for each box that the ray meets.
// [tree beam]
template <AnyWorld W, std::floating_point T, KernelLike<T> K>
[[nodiscard]] RgbT<T> estimate_beam(const W& world, const VolumeMapT<T>& map,
                                    const RayT<T>& ray, const K& kernel,
                                    std::uint64_t& visited) {
    RgbT<double> sum{0};
    map.tree.closest(ray, [&](std::uint32_t slot, const RayT<T>&) {
        ++visited;
        sum += RgbT<double>(light_of_photon(world, map.photons[slot], ray, kernel));
    });
    return RgbT<T>(sum);
}
// [tree beam]

/// \}

} // namespace ljus
