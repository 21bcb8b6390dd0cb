#pragma once

/// \file ljus/photons/light_paths.hpp
/// \brief Light paths with their vertices, which are joined with paths from the eye.

#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "ljus/accel/kd_tree8.hpp"
#include "ljus/path/subpath_weights.hpp"
#include "ljus/photons/photon_path.hpp"

namespace ljus {

/// \addtogroup subpath_weights
/// \{

/// How light paths are traced and joined with paths from the eye.
struct LightPathSettings {
    long long paths = 100000; ///< Number of light paths, at least 1.
    float radius = 0.02f;     ///< Radius of merging, in scene units; 0 for no merging.
    /// Largest number of surfaces between a light and the eye, at least 1.
    int max_depth = 100;
    std::uint64_t seed = 1;      ///< Seed of the random streams.
    std::uint64_t iteration = 0; ///< Each value gives other random numbers.
    int threads = 0;             ///< Number of threads, as in ParallelSettings.

    /// The term \f$\eta\f$ of SubpathWeights: the number of paths times the area of a
    /// disc with the merging radius.
    [[nodiscard]] double merging() const noexcept {
        return double(paths) * std::numbers::pi * double(radius) * double(radius);
    }
};

/// Checks the settings of light paths.
/// \throws std::invalid_argument  if a number is out of range.
inline void check(const LightPathSettings& settings) {
    require_at_least("the number of light paths", settings.paths, 1);
    require_at_least("max_depth", settings.max_depth, 1);
    require(std::isfinite(settings.radius) && settings.radius >= 0,
            "the merging radius", settings.radius, "finite and at least 0");
}

/// A vertex of a light path \cite lafortune1993.
template <std::floating_point T>
struct LightVertexT {
    VertexT<T> vertex{};      ///< The surface. It has a lobe that is not specular.
    RgbT<T> flux{T(0)};       ///< The flux that arrives, in W, as in a PhotonT.
    SubpathWeights weights{}; ///< The weights at the vertex.
    int depth = 0;            ///< Number of surfaces from the light to this vertex.
    /// Heckbert's letters, "DD...L". The first D is the vertex to which this one is
    /// joined, the second D is this vertex, and L is the light.
    std::string letters{};
};

/// Light paths.
template <std::floating_point T>
struct LightPathsT {
    std::vector<LightVertexT<T>> vertices{}; ///< The vertices, path by path.
    /// For each path, the index after that of its last vertex.
    std::vector<std::size_t> last{};
    KdTree8T<T> tree{}; ///< A tree over the vertices; empty without merging.

    /// The vertices of one path.
    /// \param u  In [0, 1); chooses the path.
    [[nodiscard]] std::span<const LightVertexT<T>> choose(double u) const noexcept {
        if (last.empty()) return {};
        const auto path = std::size_t(u * double(last.size()));
        const std::size_t first = path == 0 ? 0 : last[path - 1];
        return std::span(vertices).subspan(first, last[path] - first);
    }
};

namespace detail {

template <std::floating_point T>
struct LightStartT {
    /// The ray, and the flux, which is not yet divided by the number of paths.
    PathStateT<T> path{};
    /// The point of the light; the normal is 0 for a point light.
    SurfacePointT<T> point{};
    ChosenLightT<T> light{};
};

/// Starts a light path as emit() does. The result also has the point of the light.
template <AnyWorld W, StreamLike Stream>
[[nodiscard]] auto start_light_path(const W& world, Stream& stream) {
    using T = typename W::Scalar;
    LightStartT<T> start{.light =
                             choose_light(world.light_choice(), next_1d<T>(stream))};
    const Vec2T<T> u_point = next_2d<T>(stream);
    const Vec2T<T> u_direction = next_2d<T>(stream);
    world.visit_light(start.light.light, [&]<typename L>(const L& light) {
        if constexpr (has_light_end<L>) {
            const auto point = emission_point(light, u_point, T(0));
            start.point.position = position_of(point);
            if constexpr (requires { point.normal; }) start.point = point;
            start.path.ray = leave(point, sample_emission(light, point, u_direction));
            start.path.throughput = power(light) / start.light.probability;
        }
    });
    return start;
}

// [light path]
template <AnyWorld W, StreamLike Stream, std::floating_point T>
void trace_light_path(const W& world, const LightPathSettings& settings, Stream stream,
                      std::vector<LightVertexT<T>>& out) {
    LightStartT<T> start = start_light_path(world, stream);
    PathStateT<T>& path = start.path;
    path.throughput /= T(settings.paths);
    const Vec3T<T> direction = path.ray.direction;
    SubpathWeights weights;
    FluxAudit audit;
    std::string letters = "L";
    while (path.depth < settings.max_depth) {
        const auto x = next_vertex(world, path, stream);
        if (!x || is_black(path.throughput)) return;
        if (path.depth == 1)
            weights = started(light_end(world, start.light.light, start.point,
                                        direction, x->point.position),
                              start.light.probability);
        weights = arrived(weights, path, *x);
        const bool goes_on = visit_material_at(world, *x, [&](const auto& m) {
            const T landing = landing_factor(*x, path.ray.direction);
            if (has(lobes(m), Lobes::non_specular) && landing > T(0))
                out.push_back({*x, landing * path.throughput, weights, path.depth,
                               "DD" + letters});
            if (!scatter_photon(path, *x, m, MapType::general, stream, audit))
                return false;
            weights = scattered(weights, path, *x, m, settings.merging());
            return true;
        });
        if (!goes_on) return;
        letters.insert(0, 1, path.specular ? 'S' : 'D');
    }
}
// [light path]

/// Refuses lights, shapes, materials and media that light paths do not support.
template <AnyWorld W>
[[gnu::cold]] void require_joints(const W& world) {
    require_no_fog(world, "joined light paths");
    for (std::uint32_t i = 0; i < world.light_count(); ++i)
        require(
            world.visit_light(i, []<typename L>(const L&) { return has_light_end<L>; }),
            "the number of a light", static_cast<long long>(i),
            "that of a point, a spot, a goniometric light or a lamp without a picture, "
            "where a light path can begin");
    const auto rest = []<typename G>(const std::vector<G>& list) {
        require(!is_moving<G> || list.empty(), "the number of moving shapes",
                static_cast<long long>(list.size()), "0, or paths differ in time");
    };
    each_array(world.shapes(), rest);
    const auto one_index = []<typename M>(const std::vector<M>& list) {
        require(!Dispersive<M> || list.empty(),
                "the number of materials that disperse light",
                static_cast<long long>(list.size()),
                "0, or joined paths differ in wavelength");
    };
    each_array(world.materials(), one_index);
}

} // namespace detail

/// Traces light paths by several threads.
/// \param world     The closed scene.
/// \param settings  The settings.
/// \return The paths, the same for any number of threads; empty if there is no light.
/// \throws std::invalid_argument  if a setting is out of range, a light is a sun, an
///         environment or a lamp with a picture, a shape moves, a material disperses
///         light, or the scene has fog.
/// \cost About 350 bytes per vertex.
template <AnyWorld W>
[[nodiscard, gnu::cold]] LightPathsT<typename W::Scalar>
trace_light_paths(const W& world, const LightPathSettings& settings) {
    using T = typename W::Scalar;
    check(settings);
    detail::require_joints(world);
    LightPathsT<T> result;
    if (world.light_count() == 0) return result;
    constexpr long long size = detail::photon_block;
    std::vector<LightPathsT<T>> blocks(
        std::size_t(detail::block_count(settings.paths, size)));
    const auto trace = [&](long long number) {
        LightPathsT<T>& block = blocks[std::size_t(number)];
        const auto range = detail::block_range(number, size, settings.paths);
        for (long long i = range.first; i < range.last; ++i) {
            const auto stream =
                random_stream(settings.seed, Pass::general_photons, settings.iteration,
                              static_cast<std::uint64_t>(i));
            detail::trace_light_path(world, settings, stream, block.vertices);
            block.last.push_back(block.vertices.size());
        }
    };
    parallel_blocks(static_cast<long long>(blocks.size()), trace,
                    {.threads = settings.threads});
    std::vector<Vec3T<T>> positions;
    for (LightPathsT<T>& block : blocks) {
        const std::size_t before = result.vertices.size();
        for (const std::size_t last : block.last) result.last.push_back(before + last);
        for (LightVertexT<T>& y : block.vertices) {
            positions.push_back(y.vertex.point.position);
            result.vertices.push_back(std::move(y));
        }
        block = {};
    }
    if (settings.radius > 0) result.tree = KdTree8T<T>(positions, settings.threads);
    return result;
}

/// \}

} // namespace ljus
