#pragma once

/// \file ljus/photons/irradiance_points.hpp
/// \brief Irradiance that is precomputed at some photons, for gather rays.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "ljus/materials/lambertian.hpp"
#include "ljus/parallel.hpp"
#include "ljus/path/all_lights.hpp"
#include "ljus/photons/density_estimate.hpp"
#include "ljus/photons/irradiance_settings.hpp"
#include "ljus/photons/kernel_border.hpp"

namespace ljus {

/// \defgroup irradiance_points Precomputed irradiance
/// \brief Christensen's acceleration of final gathering: a precomputed value replaces
/// the density estimate where a gather ray ends \cite christensen1999. Chapter:
/// \ref ch_final_gathering.
/// \{

/// The irradiance at a point of a surface.
template <std::floating_point T>
struct IrradianceAtT {
    /// The irradiance by all light, including direct light; in W/m^2.
    RgbT<T> irradiance{T(0)};
    Vec3T<T> normal{T(0), T(0), T(1)}; ///< Unit normal on the lit side.
};

/// Points with known irradiance, in a tree.
template <std::floating_point T>
struct IrradiancePointsT {
    KdTree8T<T> tree; ///< The positions of the points.
    /// The irradiance at the points, in the tree's order.
    std::vector<IrradianceAtT<T>> records;
    /// Largest distance at which a lookup finds a point, in scene units.
    T radius = T(0);
    T disc = T(0); ///< Largest radius of an estimate, in scene units.

    /// Whether there are no points.
    [[nodiscard]] bool empty() const noexcept { return records.empty(); }
};
using IrradiancePoints = IrradiancePointsT<float>; ///< IrradiancePointsT in float.

namespace detail {

template <std::floating_point T>
[[nodiscard]] bool is_of_kind(const PhotonMapT<T>& map, std::uint32_t index,
                              PhotonKind kind) {
    return PhotonRecordT<T>(map.records[index]).kind == kind;
}

/// Whether a photon of a map becomes a lookup point. Every n-th photon in the order of
/// emission does; this order does not depend on the positions of the photons.
template <std::floating_point T>
[[nodiscard]] bool is_point(const PhotonMapT<T>& map, std::size_t index, int every) {
    return map.tree.point_ids()[index] % static_cast<std::size_t>(every) == 0;
}

template <std::floating_point T>
[[nodiscard]] bool has_direct(const PhotonMapT<T>& map) {
    for (std::size_t i = 0; i < map.records.size(); ++i)
        if (is_of_kind(map, std::uint32_t(i), PhotonKind::direct)) return true;
    return false;
}

/// The photons of one kind, without those that are lookup points.
template <std::floating_point T>
struct SourcePhotonsT {
    const PhotonMapT<T>& map; ///< The photons.
    PhotonKind kind;          ///< The kind that counts.
    int every = 0; ///< As in IrradiancePointSettings; 0: no photon is a lookup point.
    [[nodiscard]] bool operator()(std::uint32_t index) const {
        return is_of_kind(map, index, kind) &&
               (every == 0 || !is_point(map, index, every));
    }
};

/// A condition on the index of a photon, as nearest_photons() asks it.
template <typename Wanted>
struct OfIndex {
    const Wanted& wanted; ///< The condition.
    [[nodiscard]] bool operator()(std::uint32_t index, const auto& /*record*/) const {
        return wanted(index);
    }
};

/// Whether a point lies above or below a disc that is as high as its radius.
/// \param way  The vector from the centre of the disc to the point.
template <std::floating_point T>
[[nodiscard]] bool leaves_disc(const Vec3T<T>& way, const Vec3T<T>& normal,
                               T radius2) noexcept {
    const T height = glm::dot(way, normal);
    return T(4) * height * height > radius2;
}

} // namespace detail

/// The irradiance on one side of a surface from the nearest photons, with
/// Epanechnikov's kernel. It counts photons that arrived on this side, in a disc that
/// is as high as its radius. If settings.edges is true, the sum is divided by
/// part_on_surface().
/// \param world     The closed scene.
/// \param map       The photons.
/// \param vertex    The point of the surface.
/// \param normal    Unit normal on the side of the irradiance.
/// \param settings  The number of photons, and whether edges are corrected; they must
///                  pass check().
/// \param radius    The largest radius of the disc, in scene units.
/// \param wanted    wanted(index of a record) returns whether the photon counts.
/// \return W/m^2.
template <AnyWorld W, std::floating_point T, typename Wanted>
[[nodiscard]] RgbT<T>
estimate_irradiance(const W& world, const PhotonMapT<T>& map, const VertexT<T>& vertex,
                    const Vec3T<T>& normal, const IrradiancePointSettings& settings,
                    T radius, const Wanted& wanted) {
    // [estimate_irradiance]
    // Photons have the normal of the shape. Their directions give the side.
    const detail::OfIndex<Wanted> counts{wanted};
    std::array<Neighbor, max_nearest> room;
    const auto [photons, radius2] = detail::nearest_photons(
        map, vertex.point, radius, std::span(room.data(), settings.nearest), counts);
    if (!(radius2 > 0)) return RgbT<T>{T(0)};
    const T side = glm::dot(normal, vertex.point.normal);
    RgbT<double> sum{0};
    for (const Neighbor& near : photons) {
        const detail::PhotonRecordT<T> photon = map.records[near.index];
        const T on_other_side =
            side * glm::dot(photon.direction, Vec3T<T>(photon.normal));
        if (!(glm::dot(photon.direction, normal) < T(0)) || on_other_side > T(0))
            continue;
        if (detail::leaves_disc(map.tree.point(near.index) - vertex.point.position,
                                normal, T(radius2)))
            continue;
        const double weight =
            kernel_weight(Kernel::epanechnikov, near.distance2 / radius2);
        sum += weight * RgbT<double>(photon.flux);
    }
    const T part = settings.edges
                       ? part_on_surface(world, vertex, normal, T(std::sqrt(radius2)))
                       : T(1);
    return detail::per_area<T>(sum, radius2) / part;
    // [estimate_irradiance]
}

namespace detail {

/// The irradiance from all lights at a lookup point, in W/m^2: the mean over the time
/// for which the shutter is open.
/// \param resting  The point at time 0.
/// \param rays     Number of shadow rays per light. If a shape moves, the rays have
///                 different times.
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> direct_at_point(const W& world, const VertexT<T>& resting,
                                      int rays, Context& context) {
    const LambertianT<T> white{.albedo = RgbT<T>{T(1)}};
    const auto direct = [&](const VertexT<T>& vertex, int count) {
        return std::numbers::pi_v<T> * sample_all_lights(world, vertex, white,
                                                         {DirectLight::analytic, count},
                                                         context);
    };
    if constexpr (lists_moving<W>)
        if (has_moving(world)) {
            RgbT<T> sum{T(0)};
            for (int i = 0; i < rays; ++i) {
                VertexT<T> vertex = resting;
                vertex.time = (T(i) + next_1d<T>(context.stream)) / T(rays);
                world.visit_shape(resting.id, [&]<typename G>(const G& shape) {
                    if constexpr (is_moving<G>)
                        vertex.point.position += vertex.time * shape.displacement;
                });
                sum += direct(vertex, 1) / T(rays);
            }
            return sum;
        }
    return direct(resting, rays);
}

/// The irradiance at a lookup point, in W/m^2: direct light by shadow rays, caustics
/// and indirect light from the maps.
/// \param general   The general map. Its indirect photons are used, except for those
///                  that are lookup points.
/// \param caustics  The caustics map; may be empty or null.
/// \param vertex    The point at time 0, with `wo` on the side of the irradiance.
/// \param radius    The largest radius of an estimate, in scene units.
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> irradiance_of_point(const W& world, const PhotonMapT<T>& general,
                                          const PhotonMapT<T>* caustics,
                                          const VertexT<T>& vertex,
                                          const IrradiancePointSettings& settings,
                                          T radius, Context& context) {
    const Vec3T<T> side =
        vertex.wo.z < T(0) ? -vertex.point.normal : vertex.point.normal;
    const T every = T(settings.every);
    // [at_point]
    RgbT<T> sum = direct_at_point(world, vertex, settings.shadow_rays, context);
    const SourcePhotonsT<T> indirect{general, PhotonKind::indirect, settings.every};
    sum +=
        estimate_irradiance(world, general, vertex, side, settings, radius, indirect) *
        (every / (every - 1));
    if (caustics && !caustics->empty())
        sum += estimate_irradiance(
            world, *caustics, vertex, side, settings, radius,
            SourcePhotonsT<T>{*caustics, PhotonKind::caustic});
    // [at_point]
    return sum;
}

} // namespace detail

/// Precomputes the irradiance at every n-th photon of the general map: direct light by
/// shadow rays, indirect light from the general map, and caustics from their map.
/// Photons on materials with a glossy lobe are left out, because gather_ray() looks up
/// no irradiance there.
/// \param world     The closed scene.
/// \param general   The general map.
/// \param caustics  The caustics map; may be empty.
/// \param settings  The settings.
/// \param seed      Seed of the random streams.
/// \param threads   As in ParallelSettings.
/// \return The points, the same for any number of threads.
/// \throws std::invalid_argument  if a setting is out of range.
/// \cost About 10 microseconds per point.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] IrradiancePointsT<T> make_irradiance_points(
    const W& world, const PhotonMapT<T>& general, const PhotonMapT<T>& caustics,
    const IrradiancePointSettings& settings, std::uint64_t seed, int threads = 0) {
    check(settings);
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < general.records.size(); ++i)
        if (detail::is_point(general, i, settings.every)) chosen.push_back(i);
    // typical_radius() accepts one photon fewer than an estimate.
    const std::size_t count = std::min<std::size_t>(settings.nearest, 511);
    const T radius =
        settings.radius > 0 ? T(settings.radius) : 4 * typical_radius(general, count);
    std::vector<Vec3T<T>> positions(chosen.size());
    std::vector<IrradianceAtT<T>> records(chosen.size());
    std::vector<std::uint8_t> glossy(chosen.size()); // whether the point is left out
    const auto work_out = [&](std::size_t i) {
        const std::size_t photon = chosen[i];
        const detail::PhotonRecordT<T> record = general.records[photon];
        positions[i] = general.tree.point(photon);
        Vec3T<T> normal = glm::normalize(Vec3T<T>(record.normal));
        if (photon_side(record.direction, normal) < 0) normal = -normal;
        records[i].normal = normal;
        // A photon does not store its surface. A short ray finds the surface.
        const auto vertex =
            detail::vertex_below(world, positions[i], normal, T(1e-3) * radius);
        if (!vertex) return;
        glossy[i] = visit_material_at(world, *vertex, [](const auto& material) {
            return has(lobes(material), Lobes::glossy);
        });
        if (glossy[i]) return;
        auto stream = random_stream(seed, Pass::irradiance, 0, i);
        Counts counts;
        auto context = context_of(stream, counts);
        records[i].irradiance = detail::irradiance_of_point(
            world, general, &caustics, *vertex, settings, radius, context);
    };
    (void)detail::parallel_each(chosen.size(), 64, work_out, {.threads = threads});
    std::size_t kept = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (glossy[i]) continue;
        positions[kept] = positions[i];
        records[kept++] = records[i];
    }
    positions.resize(kept);

    IrradiancePointsT<T> points;
    points.radius = points.disc = radius;
    points.tree = KdTree8T<T>(positions, threads);
    // Direct photons are missing in shadows, where points are therefore far apart.
    if (settings.radius == 0 && detail::has_direct(general))
        points.radius = std::min(radius, typical_radius(points.tree, 2));
    points.records.reserve(kept);
    for (const std::uint32_t i : points.tree.point_ids())
        points.records.push_back(records[i]);
    return points;
}

/// The irradiance at the nearest lookup point with a similar normal, in a disc around
/// `position` whose radius and height are points.radius.
/// \param points    The lookup points.
/// \param position  A point of a surface.
/// \param normal    Unit normal on the side of the irradiance.
/// \return W/m^2; nothing if there is no such lookup point.
// [irradiance_at]
template <std::floating_point T>
[[nodiscard]] LJUS_CORE_CLONES std::optional<RgbT<T>>
irradiance_at(const IrradiancePointsT<T>& points, const Vec3T<T>& position,
              const Vec3T<T>& normal) {
    const auto like = [&](std::uint32_t i) {
        return glm::dot(points.records[i].normal, normal) > T(0.9) &&
               !detail::leaves_disc(points.tree.point(i) - position, normal,
                                    points.radius * points.radius);
    };
    const auto nearest = points.tree.nearest(position, points.radius);
    if (!nearest) return std::nullopt;
    if (like(nearest->index)) return points.records[nearest->index].irradiance;
    std::array<Neighbor, 1> found;
    if (points.tree.template nearest<1>(position, points.radius, found, like) == 0)
        return std::nullopt;
    return points.records[found[0].index].irradiance;
}
// [irradiance_at]

#ifdef LJUS_CORE // defined in ljus::core
extern template std::optional<Rgb> irradiance_at(const IrradiancePoints&, const Vec3&,
                                                 const Vec3&);
extern template detail::NearestPhotons
detail::nearest_photons(const PhotonMap&, const SurfacePoint&, float,
                        std::span<Neighbor>,
                        const detail::OfIndex<detail::SourcePhotonsT<float>>&);
#endif

/// \}

} // namespace ljus
