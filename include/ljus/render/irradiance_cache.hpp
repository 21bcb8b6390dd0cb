#pragma once

/// \file ljus/render/irradiance_cache.hpp
/// \brief Indirect light, gathered at few points and interpolated between them.

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "ljus/render/detail/gather_along.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \defgroup irradiance_cache The irradiance cache
/// \brief Indirect light on matt surfaces changes slowly: it is gathered at few points
/// and interpolated at all others \cite ward1988. Chapter: \ref ch_irradiance_cache.
/// \{

/// Points where irradiance was gathered, ordered for searching.
template <std::floating_point T>
struct IrradianceCacheT {
    KdTree8T<T> tree;                  ///< Where they are.
    std::vector<GatheredT<T>> records; ///< What was gathered, in the tree's order.
    Counts counts{};                   ///< What it cost.
    bool complete = true; ///< False if the progress callback stopped the gathering.

    /// Whether there are none.
    [[nodiscard]] bool empty() const noexcept { return records.empty(); }
};
using IrradianceCache = IrradianceCacheT<float>; ///< IrradianceCacheT in float.

namespace detail {

/// Whether the irradiance at one point says something of another: their normals differ
/// by less than 18 degrees.
template <std::floating_point T>
[[nodiscard]] bool like_normals(const Vec3T<T>& a, const Vec3T<T>& b) noexcept {
    return glm::dot(a, b) > T(0.95);
}

} // namespace detail

/// The irradiance between the points of a cache: the mean over those that have a like
/// normal, each weighted by how near it is. Points count as far away as the `spacing`
/// of the nearest one.
/// \param cache     The points.
/// \param position  Where the irradiance is asked for.
/// \param normal    Unit, on the side that is asked about.
/// \param reach     A point counts no farther away than so many times the harmonic mean
///                  distance of what it sees.
/// \return W/m^2; nothing if no point is near enough.
// [interpolate]
template <std::floating_point T>
[[nodiscard]] std::optional<RgbT<T>> interpolate(const IrradianceCacheT<T>& cache,
                                                 const Vec3T<T>& position,
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

/// The indirect irradiance at a vertex, by the points of a cache; where none of them is
/// near enough, it is gathered here and now.
/// \param scene     The scene.
/// \param points    What gather rays look up.
/// \param cache     May be empty.
/// \param vertex    The surface; the side is that of `wo`.
/// \param settings  How.
/// \param stream    The numbers of the path.
/// \param counts    Counts the query, and the rays if there are any.
/// \return W/m^2.
template <SceneLike S, std::floating_point T, typename Stream>
[[nodiscard]] RgbT<T>
irradiance_between(const S& scene, const IrradiancePointsT<T>& points,
                   const IrradianceCacheT<T>& cache, const VertexT<T>& vertex,
                   const GatherSettings& settings, Stream& stream, Counts& counts) {
    ++counts.map_queries;
    const auto known = interpolate(cache, vertex.point.position,
                                   detail::seen_normal(vertex), T(settings.reach));
    if (known) return *known;
    return gather_irradiance(scene, points, vertex, settings, stream, counts)
        .irradiance;
}

namespace detail {

/// Sets the `spacing` of each point of a cache: how far the farthest of its nearest
/// points of a like normal lies.
/// \param cache     The cache.
/// \param settings  How many points.
/// \param threads   As in ParallelSettings.
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

} // namespace detail

/// Gathers irradiance for a picture: behind one place of each tile of pixels.
/// \param scene     The scene.
/// \param points    What gather rays look up.
/// \param camera    A CameraT, or anything with a camera_ray().
/// \param picture   Size, seed, threads, progress.
/// \param settings  How.
/// \return The cache, the same for any number of threads.
/// \cost settings.rays gather rays per tile, and some microseconds more.
template <SceneLike S, std::floating_point T,
          template <std::floating_point> typename AnyCamera>
[[nodiscard]] IrradianceCacheT<T>
make_irradiance_cache(const S& scene, const IrradiancePointsT<T>& points,
                      const AnyCamera<T>& camera, const RenderSettings& picture,
                      const GatherSettings& settings) {
    const detail::IndexedT<S> indexed(scene);
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
            detail::gather_along(indexed, points, ray, settings, stream,
                                 rows[static_cast<std::size_t>(y)]);
        }
    };
    IrradianceCacheT<T> cache;
    cache.complete =
        parallel_blocks(static_cast<long long>(rows.size()), gather_row,
                        {.threads = picture.threads, .progress = picture.progress});
    // [make_irradiance_cache]
    std::vector<Vec3T<T>> positions;
    std::vector<GatheredT<T>> records;
    for (const auto& row : rows) {
        positions.insert(positions.end(), row.positions.begin(), row.positions.end());
        records.insert(records.end(), row.records.begin(), row.records.end());
        cache.counts += row.counts;
    }
    cache.tree = KdTree8T<T>(positions, picture.threads);
    cache.records.reserve(records.size());
    for (const std::uint32_t i : cache.tree.point_ids())
        cache.records.push_back(records[i]);
    detail::measure_spacing(cache, settings, picture.threads);
    return cache;
}

/// \}

} // namespace ljus
