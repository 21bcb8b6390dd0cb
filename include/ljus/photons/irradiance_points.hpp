#pragma once

/// \file ljus/photons/irradiance_points.hpp
/// \brief Irradiance, worked out once at some of the photons, for rays to look up.

#include <array>
#include <cmath>
#include <numbers>

#include "ljus/materials/lambertian.hpp"
#include "ljus/parallel.hpp"
#include "ljus/path/all_lights.hpp"
#include "ljus/photons/density_estimate.hpp"
#include "ljus/photons/detail/kernel_border.hpp"
#include "ljus/photons/irradiance_settings.hpp"

namespace ljus {

/// \defgroup irradiance_points Precomputed irradiance
/// \brief Christensen's shortcut for final gathering: a gather ray looks up one number
/// in place of a density estimate \cite christensen1999. Chapter:
/// \ref ch_final_gathering.
/// \{

/// A point of a surface where the irradiance is known.
template <std::floating_point T>
struct IrradianceAtT {
    RgbT<T> irradiance{T(0)};          ///< Of all light, direct light too; W/m^2.
    Vec3T<T> normal{T(0), T(0), T(1)}; ///< Unit, on the lit side.
};

/// Points where the irradiance is known, ordered for searching.
template <std::floating_point T>
struct IrradiancePointsT {
    KdTree8T<T> tree;                      ///< Where they are.
    std::vector<IrradianceAtT<T>> records; ///< What is known, in the tree's order.
    T radius = T(0); ///< A point says nothing of what is farther from it.

    /// Whether there are none.
    [[nodiscard]] bool empty() const noexcept { return records.empty(); }
};
using IrradiancePoints = IrradiancePointsT<float>; ///< IrradiancePointsT in float.

namespace detail {

/// Whether a photon of a map is of some kind.
template <std::floating_point T>
[[nodiscard]] bool is_of_kind(const PhotonMapT<T>& map, std::uint32_t index,
                              PhotonKind kind) {
    return PhotonRecordT<T>(map.records[index]).kind == kind;
}

/// Whether a photon of a map becomes a point: every so many of them.
///
/// They are counted in the order of emission, which is chance. In the tree's order
/// there would be more points where there are too many photons, and the mean over a
/// surface would be too small.
/// \param map    The general map.
/// \param index  Of the photon, in the tree's order.
/// \param every  One of so many is a point.
template <std::floating_point T>
[[nodiscard]] bool is_point(const PhotonMapT<T>& map, std::size_t index, int every) {
    return map.tree.point_ids()[index] % static_cast<std::size_t>(every) == 0;
}

} // namespace detail

/// The irradiance on one side of a surface that the nearest photons make, by
/// Epanechnikov's kernel, with edges made up for: estimate_irradiance() for those who
/// know the scene.
/// \param world     The closed scene.
/// \param map       The photons.
/// \param vertex    Where.
/// \param normal    Unit, on the side that is asked about.
/// \param settings  How many photons, and whether edges are made up for.
/// \param radius    The largest distance at which they count, in scene units.
/// \param wanted    Says of the index of a record whether that photon counts.
/// \return W/m^2.
template <AnyWorld W, std::floating_point T, typename Wanted>
[[nodiscard]] RgbT<T>
estimate_irradiance(const W& world, const PhotonMapT<T>& map, const VertexT<T>& vertex,
                    const Vec3T<T>& normal, const IrradiancePointSettings& settings,
                    T radius, const Wanted& wanted) {
    // [estimate_irradiance]
    // By the shape's own normal, as photons have it; the side is told by where they go.
    const auto counts = [&](std::uint32_t i, const auto&) { return wanted(i); };
    std::array<Neighbor, max_nearest> room;
    const auto [photons, radius2] = detail::nearest_photons(
        map, vertex.point, radius, std::span(room.data(), settings.nearest), counts);
    if (!(radius2 > 0)) return RgbT<T>{T(0)};
    RgbT<double> sum{0};
    for (const Neighbor& near : photons) {
        const detail::PhotonRecordT<T> photon = map.records[near.index];
        if (!(glm::dot(photon.direction, normal) < T(0))) continue;
        const double weight =
            kernel_weight(Kernel::epanechnikov, near.distance2 / radius2);
        sum += weight * RgbT<double>(photon.flux);
    }
    const T part = settings.edges ? detail::part_on_surface(world, vertex, normal,
                                                            T(std::sqrt(radius2)))
                                  : T(1);
    return detail::per_area<T>(sum, radius2) / part;
    // [estimate_irradiance]
}

namespace detail {

/// The irradiance at a point: direct light by shadow rays, which know where its shadows
/// end; caustics and indirect light from the maps.
/// \param world     The closed scene.
/// \param general   The general map, of whose indirect photons those count that are not
///                  points themselves.
/// \param caustics  The caustics map; may be empty.
/// \param vertex    The point, seen from the side that is asked about.
/// \param settings  How.
/// \param radius    Within which the photons of an estimate lie, in scene units.
/// \param stream    The numbers of the shadow rays.
/// \return W/m^2.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> irradiance_of_point(const W& world, const PhotonMapT<T>& general,
                                          const PhotonMapT<T>& caustics,
                                          const VertexT<T>& vertex,
                                          const IrradiancePointSettings& settings,
                                          T radius, RandomStream& stream) {
    const Vec3T<T> side =
        vertex.wo.z < T(0) ? -vertex.point.normal : vertex.point.normal;
    const T every = T(settings.every);
    // [at_point]
    Counts counts;
    auto context = context_of(stream, counts);
    const LambertianT<T> white{.albedo = RgbT<T>{T(1)}};
    RgbT<T> sum =
        std::numbers::pi_v<T> *
        sample_all_lights(world, vertex, white,
                          {DirectLight::analytic, settings.shadow_rays}, context);
    const auto indirect = [&](std::uint32_t k) {
        return is_of_kind(general, k, PhotonKind::indirect) &&
               !is_point(general, k, settings.every);
    };
    const auto caustic = [&](std::uint32_t k) {
        return is_of_kind(caustics, k, PhotonKind::caustic);
    };
    sum +=
        estimate_irradiance(world, general, vertex, side, settings, radius, indirect) *
        (every / (every - 1));
    if (!caustics.empty())
        sum += estimate_irradiance(world, caustics, vertex, side, settings, radius,
                                   caustic);
    // [at_point]
    return sum;
}

} // namespace detail

/// Works out the irradiance at every so many photons of a map.
/// \param world     The closed scene.
/// \param general   The general map: where the points are, and its indirect photons.
/// \param caustics  The caustics map; may be empty.
/// \param settings  How.
/// \param seed      Of the shadow rays.
/// \param threads   As in ParallelSettings.
/// \return The points, the same for any number of threads.
/// \cost About 10 microseconds per point.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] IrradiancePointsT<T> make_irradiance_points(
    const W& world, const PhotonMapT<T>& general, const PhotonMapT<T>& caustics,
    const IrradiancePointSettings& settings, std::uint64_t seed, int threads = 0) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < general.records.size(); ++i)
        if (detail::is_point(general, i, settings.every)) chosen.push_back(i);
    const T radius = settings.radius > 0
                         ? T(settings.radius)
                         : 4 * typical_radius(general, settings.nearest);
    std::vector<Vec3T<T>> positions(chosen.size());
    std::vector<IrradianceAtT<T>> records(chosen.size());
    const auto work_out = [&](std::size_t i) {
        const std::size_t photon = chosen[i];
        const detail::PhotonRecordT<T> record = general.records[photon];
        positions[i] = general.tree.point(photon);
        Vec3T<T> normal = glm::normalize(Vec3T<T>(record.normal));
        if (photon_side(record.direction, normal) < 0) normal = -normal;
        records[i].normal = normal;
        // What stands there is asked of the scene: a photon does not remember.
        const auto vertex =
            detail::vertex_below(world, positions[i], normal, T(1e-3) * radius);
        if (!vertex) return;
        auto stream = random_stream(seed, Pass::irradiance, 0, i);
        records[i].irradiance = detail::irradiance_of_point(
            world, general, caustics, *vertex, settings, radius, stream);
    };
    (void)detail::parallel_each(chosen.size(), 64, work_out, {.threads = threads});

    IrradiancePointsT<T> points;
    points.radius = radius;
    points.tree = KdTree8T<T>(positions, threads);
    points.records.reserve(chosen.size());
    for (const std::uint32_t i : points.tree.point_ids())
        points.records.push_back(records[i]);
    return points;
}

/// The irradiance at the nearest point with a like normal.
/// \param points    The points.
/// \param position  Where it is asked for.
/// \param normal    Unit, on the side that is asked about.
/// \return W/m^2; 0 if there is none: where no photon came, it is dark.
// [irradiance_at]
template <std::floating_point T>
[[nodiscard]] RgbT<T> irradiance_at(const IrradiancePointsT<T>& points,
                                    const Vec3T<T>& position, const Vec3T<T>& normal) {
    const auto like = [&](std::uint32_t i) {
        return glm::dot(points.records[i].normal, normal) > T(0.9);
    };
    const auto nearest = points.tree.nearest(position, points.radius);
    if (!nearest) return RgbT<T>{T(0)};
    if (like(nearest->index)) return points.records[nearest->index].irradiance;
    std::array<Neighbor, 1> found;
    if (points.tree.template nearest<1>(position, points.radius, found, like) == 0)
        return RgbT<T>{T(0)};
    return points.records[found[0].index].irradiance;
}
// [irradiance_at]

/// \}

} // namespace ljus
