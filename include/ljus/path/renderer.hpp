#pragma once

/// \file ljus/path/renderer.hpp
/// \brief What a renderer is, and what travels with each of its camera rays.

#include <concepts>
#include <cstdint>
#include <string_view>

#include "ljus/geometry/ray.hpp"
#include "ljus/math/random.hpp"

namespace ljus {

/// \defgroup counts Counts
/// \brief What the renderers count: the same on every machine.
/// \{

/// Rays and photons of a rendering.
struct Counts {
    std::uint64_t camera_rays = 0;     ///< Primary rays.
    std::uint64_t bounce_rays = 0;     ///< Reflected, refracted and indirect rays.
    std::uint64_t shadow_rays = 0;     ///< Rays to lights.
    std::uint64_t map_queries = 0;     ///< Estimates asked of a photon map.
    std::uint64_t map_photons = 0;     ///< Photons summed in them.
    std::uint64_t skipped_rays = 0;    ///< Shadow rays that photons have made needless.
    std::uint64_t skipped_bounces = 0; ///< Indirect rays left out where it is dark.
    std::uint64_t rejected = 0;        ///< Samples that were not finite and left out.
    std::uint64_t cut_paths =
        0; ///< Ended by the limit of depth: their light is missing.

    /// All rays.
    [[nodiscard]] constexpr std::uint64_t rays() const noexcept {
        return camera_rays + bounce_rays + shadow_rays;
    }

    /// Adds another account.
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

/// Counts a path that is cut, if it is.
/// \param cut     Whether the limit of depth ends it.
/// \param counts  Gets one more.
/// \return `cut`.
constexpr bool cut_if(bool cut, Counts& counts) noexcept {
    counts.cut_paths += cut ? 1u : 0u;
    return cut;
}

} // namespace detail

/// \}

/// \defgroup renderer What a renderer is
/// \brief One function, called for each primary ray.
/// \{

/// What a renderer reports a path to, in Heckbert's letters: its beginning, each vertex
/// where it was scattered, and each term of radiance. A log may have an
/// `arrive(position)` as well, which is told of each surface that the path comes to.
template <typename L, typename T = float>
concept LogLike = requires(L& log, const Vec3T<T>& v, T pdf) {
    log.begin();
    log.vertex('D', v, v, pdf);
    log.term(std::string_view{}, std::string_view{}, v);
};

/// Takes nothing and costs nothing: the log of a picture.
struct NoLog {
    /// A path begins.
    constexpr void begin() const noexcept {}
    /// The path was scattered at a vertex.
    template <std::floating_point T>
    constexpr void vertex(char, const Vec3T<T>&, const RgbT<T>&, T) const noexcept {}
    /// Radiance was added.
    template <std::floating_point T>
    constexpr void term(std::string_view, std::string_view,
                        const RgbT<T>&) const noexcept {}
};

/// No questions are put off.
struct NoBatch {};

/// What travels with a camera ray from its first vertex to its last.
/// \tparam S  The stream.
/// \tparam L  The log; most often a NoLog.
/// \tparam B  Questions that are put off, to be answered for many rays together; most
///            often a NoBatch.
template <StreamLike S, typename L = const NoLog, typename B = const NoBatch>
struct Context {
    S& stream;      ///< The numbers of this ray.
    Counts& counts; ///< What it costs.
    L& log;         ///< Told of each vertex and each term.
    B& batch;       ///< Takes what need not be answered at once.
};
/// Deduces the types from the values.
template <StreamLike S, typename L, typename B>
Context(S&, Counts&, L&, B&) -> Context<S, L, B>;

namespace detail {

/// A NoLog with a name, for a Context to refer to.
inline constexpr NoLog no_log{};
/// A NoBatch with a name.
inline constexpr NoBatch no_batch{};

} // namespace detail

/// The context of a ray that reports to a log, or to none.
/// \param stream  The numbers of this ray.
/// \param counts  What it costs.
/// \param log     Told of each vertex and each term.
template <StreamLike S, typename L = const NoLog>
[[nodiscard]] Context<S, L> context_of(S& stream, Counts& counts,
                                       L& log = detail::no_log) noexcept {
    return {stream, counts, log, detail::no_batch};
}

/// Adds terms to the radiance of a path, and tells a log of them.
template <std::floating_point T, typename L>
struct RadianceSum {
    RgbT<T>& sum;              ///< Of the path.
    const RgbT<T>& throughput; ///< Of the path, as far as it has come.
    L& log;                    ///< Told of each term.

    /// Adds the light of a surface, times the throughput.
    /// \param owner    Who carries it: "emission", "shadow ray", "caustics map", ...
    /// \param letters  From here to the light.
    /// \param light    Radiance, before the throughput.
    void operator()(const char* owner, const char* letters,
                    const RgbT<T>& light) const {
        add(owner, letters, throughput * light);
    }
    /// Adds a term that holds the throughput.
    /// \param owner    Who carries it.
    /// \param letters  From here to the light.
    /// \param term     Throughput times radiance.
    void add(const char* owner, const char* letters, const RgbT<T>& term) const {
        log.term(owner, letters, term);
        sum += term;
    }
};
/// Deduces the types from the values.
template <std::floating_point T, typename L>
RadianceSum(RgbT<T>&, const RgbT<T>&, L&) -> RadianceSum<T, L>;

/// A renderer in the precision of a camera: a struct that names the random stream which
/// it draws from,
///
///     using Stream = RandomStream; // or StratifiedStream
///
/// and, beside it, a function that returns the radiance of a camera ray, W/(m^2 sr),
/// and tells the context's log what it adds:
///
///     Rgb radiance(const MyRenderer&, const Ray&, auto& context);
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
