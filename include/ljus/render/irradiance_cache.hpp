#pragma once

/// \file ljus/render/irradiance_cache.hpp
/// \brief Indirect light, gathered at few points and interpolated between them.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "ljus/render/final_gathering.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \defgroup irradiance_cache The irradiance cache
/// \brief Indirect light on matt surfaces changes slowly: it is gathered at few points
/// and interpolated at all others \cite ward1988. Chapter: \ref ch_irradiance_cache.
/// \{

/// Points where irradiance was gathered, in a k-d tree.
template <std::floating_point T>
struct IrradianceCacheT {
    KdTree8T<T> tree;                  ///< The positions of the points.
    std::vector<GatheredT<T>> records; ///< The light gathered at the points, in the
                                       ///< tree's order.
    Counts counts{};                   ///< Numbers of rays and photons.
    bool complete = true; ///< False if the progress callback stopped the gathering.

    /// Whether the cache has no points.
    [[nodiscard]] bool empty() const noexcept { return records.empty(); }
};
using IrradianceCache = IrradianceCacheT<float>; ///< IrradianceCacheT in float.

namespace detail {

/// Whether two normals differ by less than 18 degrees.
template <std::floating_point T>
[[nodiscard]] bool like_normals(const Vec3T<T>& a, const Vec3T<T>& b) noexcept {
    return glm::dot(a, b) > T(0.95);
}

} // namespace detail

/// The irradiance between the points of a cache: the mean over the points with a
/// similar normal, weighted by 1 - d^2/r^2, where d is the distance of the point from
/// the position. The search radius r is the `spacing` of the nearest point.
/// \param cache     The points.
/// \param position  The position to interpolate at.
/// \param normal    Unit normal, on the side of the viewer.
/// \param reach     The largest distance of a point that is used, as a multiple of the
///                  harmonic mean length of its gather rays.
/// \return W/m^2; nothing if no point is near enough.
// [interpolate]
template <std::floating_point T>
[[nodiscard]] LJUS_CORE_CLONES std::optional<RgbT<T>>
interpolate(const IrradianceCacheT<T>& cache, const Vec3T<T>& position,
            const Vec3T<T>& normal, T reach) {
    const auto nearest = cache.tree.nearest(position);
    if (!nearest) return std::nullopt;
    const T radius = cache.records[nearest->index].spacing;
    RgbT<T> sum{T(0)};
    T weights = T(0);
    const auto add = [&](std::uint32_t i, double distance2) {
        const GatheredT<T>& record = cache.records[i];
        const T limit = reach * record.distance;
        const T share = T(distance2) / (radius * radius);
        if (!(T(distance2) < limit * limit) || !(share < T(1)) ||
            !detail::like_normals(record.normal, normal))
            return;
        sum += (T(1) - share) * record.irradiance;
        weights += T(1) - share;
    };
    cache.tree.visit_within(position, radius, add);
    if (!(weights > T(0))) return std::nullopt;
    return sum / weights;
}
// [interpolate]

#ifdef LJUS_CORE // defined in ljus::core
extern template std::optional<Rgb> interpolate(const IrradianceCache&, const Vec3&,
                                               const Vec3&, float);
#endif

/// The indirect irradiance at a vertex, interpolated between the points of a cache. If
/// no point is near enough, the irradiance is gathered at the vertex itself, with a
/// quarter of the rays. The noise of this irradiance affects one camera ray; the noise
/// at a point of the cache affects many.
/// \param world     The closed scene.
/// \param lookup    The data that gather rays look up.
/// \param cache     May be empty.
/// \param vertex    The surface; `wo` chooses its side.
/// \param material  Its material.
/// \param settings  Settings of gathering and interpolation.
/// \param context   The random stream of the path; counts the query and gather rays.
/// \return W/m^2.
template <AnyWorld W, std::floating_point T, Material M, typename Context>
[[nodiscard]] RgbT<T>
irradiance_between(const W& world, const std::type_identity_t<GatherLookupT<T>>& lookup,
                   const IrradianceCacheT<T>& cache, const VertexT<T>& vertex,
                   const M& material, const GatherSettings& settings,
                   Context& context) {
    ++context.counts.map_queries;
    const auto known = interpolate(cache, detail::at_rest(world, vertex).point.position,
                                   detail::seen_normal(vertex), T(settings.reach));
    if (known) return *known;
    GatherSettings once = settings;
    once.rays = (settings.rays + 3) / 4;
    return gather_irradiance(world, lookup, vertex, material, once, context).irradiance;
}

namespace detail {

/// The irradiance gathered for one row of tiles.
template <std::floating_point T>
struct GatheredRowT {
    std::vector<Vec3T<T>> positions;
    std::vector<GatheredT<T>> records; ///< The light gathered at the positions.
    Counts counts{};
};

/// Gathers irradiance where a camera ray meets its first diffuse surface. The ray
/// follows mirrors and is split at glass, so that one ray may give several points.
template <AnyWorld W, std::floating_point T>
void gather_along(const W& world, const std::type_identity_t<GatherLookupT<T>>& lookup,
                  const RayT<T>& ray, const GatherSettings& settings,
                  RandomStream& stream, GatheredRowT<T>& row) {
    constexpr std::size_t most = 8; // largest number of paths of a ray
    constexpr T faint = T(0.01);    // least throughput of a path
    auto context = context_of(stream, row.counts);
    std::vector<PathStateT<T>> ways{camera_path(world, ray, stream)};
    for (std::size_t way = 0; way < ways.size(); ++way) {
        PathStateT<T> path = ways[way];
        while (path.depth < settings.max_depth) {
            const auto vertex = next_vertex(world, path, stream);
            if (!vertex || max_component(path.throughput) < faint) break;
            const auto at_material = [&](const auto& material) {
                const Lobes parts = lobes(material);
                if (has(parts, Lobes::diffuse)) {
                    row.positions.push_back(
                        detail::at_rest(world, *vertex).point.position);
                    row.records.push_back(gather_irradiance(
                        world, lookup, *vertex, material, settings, context));
                }
                if (ways.size() < most)
                    if (const auto other = split_path(path, *vertex, material)) {
                        ways.push_back(*other);
                        return true;
                    }
                return continue_path(path, *vertex, material, Transport::radiance,
                                     Lobes::specular, stream);
            };
            if (!visit_material_at(world, *vertex, at_material)) break;
        }
    }
}

/// Sets GatheredT::spacing of each point of a cache.
template <std::floating_point T>
void measure_spacing(IrradianceCacheT<T>& cache, const GatherSettings& settings,
                     int threads) {
    const auto measure = [&](std::size_t i) {
        std::array<Neighbor, max_cache_nearest> room;
        const std::span<Neighbor> found(room.data(), settings.nearest);
        const auto like = [&](std::uint32_t k) {
            return like_normals(cache.records[k].normal, cache.records[i].normal);
        };
        const std::size_t count = cache.tree.template nearest<max_cache_nearest>(
            cache.tree.point(i), std::numeric_limits<T>::infinity(), found, like);
        return count > 1 ? T(std::sqrt(found[0].distance2)) : T(0);
    };
    (void)parallel_each(cache.records.size(), 64,
                        [&](std::size_t i) { cache.records[i].spacing = measure(i); },
                        {.threads = threads});
}

/// Spreads light that a single gather ray has found. A point whose ray meets a small
/// bright area, such as the focus of a caustic, is too bright, and the points around it
/// are too dark. Where the brightest ray carries more than a sixth of the irradiance,
/// and more than four times the mean of the rays, its part is divided equally among the
/// nearest 64 points with a similar normal within `reach`. The sum over all points
/// stays the same.
template <std::floating_point T>
void spread_brightest(IrradianceCacheT<T>& cache, const GatherSettings& settings) {
    constexpr std::size_t most = 64;
    const T least = std::max(T(1) / T(6), T(4) / T(settings.rays));
    std::vector<RgbT<T>> received(cache.records.size(), RgbT<T>{T(0)});
    for (std::uint32_t i = 0; i < cache.records.size(); ++i) {
        GatheredT<T>& record = cache.records[i];
        if (!(max_component(record.brightest) >
              least * max_component(record.irradiance)))
            continue;
        std::array<Neighbor, most> room;
        const auto like = [&](std::uint32_t k) {
            return like_normals(cache.records[k].normal, record.normal);
        };
        const std::size_t count = cache.tree.template nearest<most>(
            cache.tree.point(i), T(settings.reach) * record.distance, std::span(room),
            like);
        if (count < 2) continue;
        record.irradiance -= record.brightest;
        for (const Neighbor& near : std::span(room).first(count))
            received[near.index] += record.brightest / T(count);
        record.brightest = RgbT<T>{T(0)};
    }
    for (std::size_t i = 0; i < received.size(); ++i)
        cache.records[i].irradiance += received[i];
}

} // namespace detail

/// Makes a cache of points where irradiance is known, and finds the spacing of each.
/// Light that a single gather ray has found is divided among near points.
/// \param positions  The points, in scene units.
/// \param records    Irradiance and normal of each point, in the same order.
/// \param settings   The spacing of a point is the distance to its k-th nearest point
///                   with a similar normal, where k is the member `nearest` and the
///                   point itself is the first.
/// \param threads    As in ParallelSettings; the cache does not depend on it.
/// \throws std::invalid_argument  if a position is not finite, or `nearest` is not
///         within [2, 64].
/// \cost O(n log n) for n points.
template <std::floating_point T>
[[nodiscard]] IrradianceCacheT<T>
make_irradiance_cache(const std::vector<Vec3T<T>>& positions,
                      const std::vector<GatheredT<T>>& records,
                      const GatherSettings& settings, int threads = 0) {
    require(settings.nearest >= 2 && settings.nearest <= max_cache_nearest,
            "gather.nearest", static_cast<long long>(settings.nearest),
            "within [2, 64]");
    IrradianceCacheT<T> cache;
    cache.tree = KdTree8T<T>(positions, threads);
    cache.records.reserve(records.size());
    for (const std::uint32_t i : cache.tree.point_ids())
        cache.records.push_back(records[i]);
    detail::spread_brightest(cache, settings);
    detail::measure_spacing(cache, settings, threads);
    return cache;
}

/// Gathers irradiance for a picture, by one camera ray through each tile of pixels.
/// \param world     The closed scene.
/// \param lookup    The data that gather rays look up.
/// \param camera    Any camera.
/// \param picture   Size, seed, threads, progress.
/// \param settings  Settings of gathering.
/// \return The cache, the same for any number of threads.
/// \throws std::invalid_argument  if `tile` or `rays` is below 1, or as above.
/// \cost For each tile one camera ray, and `settings.rays` gather rays for each point.
template <AnyWorld W, CameraLike C>
[[nodiscard]] IrradianceCacheT<typename W::Scalar>
make_irradiance_cache(const W& world, const GatherLookupT<typename W::Scalar>& lookup,
                      const C& camera, const RenderSettings& picture,
                      const GatherSettings& settings) {
    using T = typename W::Scalar;
    require_at_least("gather.tile", settings.tile, 1);
    require_at_least("gather.rays", settings.rays, 1);
    // [make_irradiance_cache]
    const int tile = settings.tile;
    const int columns = (picture.width + tile - 1) / tile;
    std::vector<detail::GatheredRowT<T>> rows(
        static_cast<std::size_t>((picture.height + tile - 1) / tile));
    const auto gather_row = [&](long long y) {
        for (long long x = 0; x < columns; ++x) {
            auto stream = random_stream(picture.seed, Pass::gathering, 0,
                                        static_cast<std::uint64_t>(y * columns + x));
            const Vec2T<T> place =
                T(tile) * (Vec2T<T>{T(x), T(y)} + next_2d<T>(stream));
            const RayT<T> ray =
                camera_ray(camera, place, picture.width, picture.height, stream);
            detail::gather_along(world, lookup, ray, settings, stream,
                                 rows[static_cast<std::size_t>(y)]);
        }
    };
    const bool complete =
        parallel_blocks(static_cast<long long>(rows.size()), gather_row,
                        {.threads = picture.threads, .progress = picture.progress});
    // [make_irradiance_cache]
    std::vector<Vec3T<T>> positions;
    std::vector<GatheredT<T>> records;
    Counts counts;
    for (const auto& row : rows) {
        positions.insert(positions.end(), row.positions.begin(), row.positions.end());
        records.insert(records.end(), row.records.begin(), row.records.end());
        counts += row.counts;
    }
    auto cache = make_irradiance_cache(positions, records, settings, picture.threads);
    cache.counts = counts;
    cache.complete = complete;
    return cache;
}

/// \}

} // namespace ljus
