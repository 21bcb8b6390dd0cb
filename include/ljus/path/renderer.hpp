#pragma once

/// \file ljus/path/renderer.hpp
/// \brief The interface of a renderer: its counters, its logs, and the context of a
/// camera ray.

#include <concepts>
#include <cstdint>
#include <string_view>

#include "ljus/geometry/ray.hpp"
#include "ljus/math/random.hpp"

namespace ljus {

/// \defgroup counts Counts
/// \brief Counters of rays and photons. They do not depend on the number of threads.
/// \{

/// The numbers of rays and photons of a rendering.
struct Counts {
    std::uint64_t camera_rays = 0;  ///< Primary rays.
    std::uint64_t bounce_rays = 0;  ///< Reflected, refracted and indirect rays.
    std::uint64_t shadow_rays = 0;  ///< Rays to lights.
    std::uint64_t map_queries = 0;  ///< Density estimates of photon maps.
    std::uint64_t map_photons = 0;  ///< Photons that density estimates have summed.
    std::uint64_t skipped_rays = 0; ///< Shadow rays that photons made unnecessary.
    /// Indirect rays that were skipped because no indirect photon was near.
    std::uint64_t skipped_bounces = 0;
    /// Samples that were rejected because they were not finite.
    std::uint64_t rejected = 0;
    /// Paths that the depth limit has ended; their light is missing.
    std::uint64_t cut_paths = 0;

    /// All rays.
    [[nodiscard]] constexpr std::uint64_t rays() const noexcept {
        return camera_rays + bounce_rays + shadow_rays;
    }

    /// Adds other counts.
    constexpr Counts& operator+=(const Counts& other) noexcept {
        camera_rays += other.camera_rays;
        bounce_rays += other.bounce_rays;
        shadow_rays += other.shadow_rays;
        map_queries += other.map_queries;
        map_photons += other.map_photons;
        skipped_rays += other.skipped_rays;
        skipped_bounces += other.skipped_bounces;
        rejected += other.rejected;
        cut_paths += other.cut_paths;
        return *this;
    }
};

namespace detail {

/// Counts a path in Counts::cut_paths if `cut` is true. Returns `cut`.
constexpr bool cut_if(bool cut, Counts& counts) noexcept {
    counts.cut_paths += cut ? 1u : 0u;
    return cut;
}

} // namespace detail

/// \}

/// \defgroup renderer The interface of a renderer
/// \brief A renderer has one function, which is called for each camera ray.
/// \{

/// A receiver of the events of a path: begin() at its start, vertex() at each
/// scattering, and term() for each term of radiance. A log may have two more functions.
/// `arrive(position)` is called for each surface that the path hits. `delay(letters)`
/// is called instead of term() for a delayed term: one whose value is estimated later,
/// together with terms of other rays.
template <typename L, typename T = float>
concept LogLike = requires(L& log, const Vec3T<T>& v, T pdf) {
    log.begin();
    log.vertex('D', v, v, pdf);
    log.term(std::string_view{}, std::string_view{}, v);
};

/// A log that ignores all events.
struct NoLog {
    /// Ignores the start of a path.
    constexpr void begin() const noexcept {}
    /// Ignores a scattering.
    template <std::floating_point T>
    constexpr void vertex(char, const Vec3T<T>&, const RgbT<T>&, T) const noexcept {}
    /// Ignores a term.
    template <std::floating_point T>
    constexpr void term(std::string_view, std::string_view,
                        const RgbT<T>&) const noexcept {}
};

/// The type of Context::batch for a renderer that has no delayed terms.
struct NoBatch {};

/// The context of one camera ray and of the path that begins with it.
template <StreamLike S, typename L = const NoLog, typename B = const NoBatch>
struct Context {
    S& stream;      ///< Random numbers of the path.
    Counts& counts; ///< Counters of rays and photons.
    L& log;         ///< Receives each vertex and each term.
    B& batch;       ///< Estimates the delayed terms of many rays together.
};
/// Deduces the types from the values.
template <StreamLike S, typename L, typename B>
Context(S&, Counts&, L&, B&) -> Context<S, L, B>;

namespace detail {

inline constexpr NoLog no_log{};
inline constexpr NoBatch no_batch{};

} // namespace detail

/// The context of a ray, with a log or without.
template <StreamLike S, typename L = const NoLog>
[[nodiscard]] Context<S, L> context_of(S& stream, Counts& counts,
                                       L& log = detail::no_log) noexcept {
    return {stream, counts, log, detail::no_batch};
}

/// A sum of terms of radiance. Each term is also reported to a log.
template <std::floating_point T, typename L>
struct RadianceSum {
    RgbT<T>& sum;              ///< Radiance of the path.
    const RgbT<T>& throughput; ///< Throughput of the path so far.
    L& log;                    ///< Receives each term.

    /// Adds the radiance that the estimator `owner`, such as "shadow ray", has found,
    /// times the throughput. The letters lead from the last vertex to the light.
    void operator()(const char* owner, const char* letters,
                    const RgbT<T>& light) const {
        add(owner, letters, throughput * light);
    }
    /// Adds a term that already contains the throughput.
    void add(const char* owner, const char* letters, const RgbT<T>& term) const {
        log.term(owner, letters, term);
        sum += term;
    }
};
/// Deduces the types from the values.
template <std::floating_point T, typename L>
RadianceSum(RgbT<T>&, const RgbT<T>&, L&) -> RadianceSum<T, L>;

/// A renderer for rays of precision T. It is a struct that names its random stream,
///
///     using Stream = RandomStream; // or StratifiedStream
///
/// and has a function that returns the radiance of a camera ray in W/(m^2 sr). The
/// function reports each term to the log of the context:
///
///     Rgb radiance(const MyRenderer&, const Ray&, auto& context);
///
/// A renderer whose paths are scattered by fog (\ref fog_path) has a static member
/// `carries_fog`. For any other renderer with a function `world()`, render() refuses a
/// scene with fog. A renderer with neither ignores fog.
template <typename R, typename T = float>
concept Renderer = requires {
    typename R::Stream;
}
&&StreamLike<typename R::Stream>&& requires(const R& renderer, const RayT<T>& ray,
                                            Context<typename R::Stream>& context) {
    { radiance(renderer, ray, context) } -> std::same_as<RgbT<T>>;
};

/// \}

} // namespace ljus
