#pragma once

/// \file ljus/render/render.hpp
/// \brief The pixel loop.

#include <algorithm>
#include <optional>

#include "ljus/image/filter.hpp"
#include "ljus/image/image.hpp"
#include "ljus/math/sampling_pattern.hpp"
#include "ljus/parallel.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/render/detail/sample_sums.hpp"
#include "ljus/scene/camera.hpp"

namespace ljus {

/// \defgroup render Rendering
/// \brief Section 3.2: "in order to render an image, primary rays are cast into the
/// scene".
/// \{

/// The picture that is asked for.
struct RenderSettings {
    int width = 400;        ///< Pixels, at least 1.
    int height = 400;       ///< Pixels, at least 1.
    int samples = 64;       ///< Primary rays in a pixel, at least 1; exactly as many.
    std::uint64_t seed = 1; ///< Of the random streams.
    int threads = 0;        ///< 0: all that there are.
    Progress progress = no_progress; ///< Called with (done, total); false stops.
    Sampling sampling = Sampling::multi_jittered; ///< Where in a pixel they go.
    Filter filter = Filter::box;                  ///< How much each place counts.
};

/// What a rendering brings.
template <std::floating_point T>
struct RenderedT {
    ImageT<T> image{};    ///< The mean radiance of each pixel.
    Counts counts{};      ///< What it cost.
    bool complete = true; ///< False if the progress callback stopped it.
};

/// Sets a stream to the numbers of one ray of a pixel.
/// \param stream   Any stream has such an overload.
/// \param seed     The user's seed.
/// \param pixel    The pixel's number within the picture.
/// \param ray      The ray's number within the pixel.
/// \param pattern  make_pattern() for the rays of a pixel.
constexpr void start_ray(RandomStream& stream, std::uint64_t seed, std::uint64_t pixel,
                         int ray, const Pattern& pattern) noexcept {
    stream = random_stream(seed, Pass::camera, 0,
                           pixel * static_cast<std::uint64_t>(pattern.points) +
                               static_cast<std::uint64_t>(ray));
}

namespace detail {

/// How many pixels beside each other are rendered at a time.
inline constexpr int strip_width = 16;

/// Where one ray of a pixel goes through the picture, and what it counts there.
/// \param picture  Size, rays, seed, filter.
/// \param pattern  make_pattern() for the rays of a pixel.
/// \param x        Column of the pixel.
/// \param y        Row of the pixel.
/// \param number   Which of the pixel's rays.
/// \param stream   Set to the numbers of that ray, past those of its place.
/// \return The place, from the upper left corner of the picture, and its weight.
template <std::floating_point T, typename Stream>
[[nodiscard]] FilterSampleT<T> place_of_ray(const RenderSettings& picture,
                                            const Pattern& pattern, int x, int y,
                                            int number, Stream& stream) {
    const auto pixel =
        static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(picture.width) +
        static_cast<std::uint64_t>(x);
    start_ray(stream, picture.seed, pixel, number, pattern);
    const Vec2T<T> u =
        spread(pattern, number, mix_bits(picture.seed) ^ pixel, next_2d<T>(stream));
    FilterSampleT<T> at = sample_filter(picture.filter, u);
    at.place += Vec2T<T>{T(x), T(y)};
    return at;
}

/// What one ray of a pixel brings.
template <std::floating_point T>
struct PixelSampleT {
    RgbT<T> radiance{T(0)}; ///< W/(m^2 sr).
    T weight = T(1);        ///< Of the filter, where the ray goes through it.
};

/// Sends one ray through a pixel, as the pixel loop does.
/// \param renderer  A PathTracer, a PhotonMapper, or any other Renderer.
/// \param camera    A CameraT, or anything with a camera_ray().
/// \param picture   Size, rays, seed, filter.
/// \param pattern   make_pattern() for the rays of a pixel.
/// \param x         Column of the pixel.
/// \param y         Row of the pixel.
/// \param number    Which of the pixel's rays.
/// \param counts    Counts the rays.
/// \param log       Told of each vertex and each term, without the weight.
/// \return Radiance, and what it counts.
// [trace_pixel]
template <typename R, template <std::floating_point> typename AnyCamera,
          std::floating_point T, typename Log = NoLog>
[[nodiscard]] PixelSampleT<T> trace_pixel(const R& renderer, const AnyCamera<T>& camera,
                                          const RenderSettings& picture,
                                          const Pattern& pattern, int x, int y,
                                          int number, Counts& counts, Log&& log = {}) {
    typename R::Stream stream;
    const auto at = place_of_ray<T>(picture, pattern, x, y, number, stream);
    const RayT<T> ray =
        camera_ray(camera, at.place, picture.width, picture.height, stream);
    ++counts.camera_rays;
    return {radiance(renderer, ray, stream, counts, log), at.weight};
}
// [trace_pixel]

} // namespace detail

/// Some rows of a picture, counted from the top: first <= y < last.
struct RowRange {
    int first = 0; ///< The first one.
    int last = 0;  ///< One past the last one.
};

/// Renders some rows of a picture, by several threads: one machine's part of it.
///
/// A ray's numbers depend on its pixel's place in the whole picture alone, so that rows
/// rendered apart and put below each other are the picture of render(), byte by byte.
/// \param renderer  A PathTracer, a PhotonMapper, or any other Renderer.
/// \param camera    A CameraT, or anything with a camera_ray().
/// \param picture   Size of the whole, rays, seed, threads.
/// \param rows      At least one of its rows.
/// \return A picture of those rows alone. A sample that is not finite is left out and
///         counted.
/// \throws std::invalid_argument  if the size or the number of rays is below 1, or the
///         rows are none of the picture's.
template <typename R, template <std::floating_point> typename AnyCamera,
          std::floating_point T>
requires Renderer<R, T>
[[nodiscard]] RenderedT<T> render_rows(const R& renderer, const AnyCamera<T>& camera,
                                       const RenderSettings& picture,
                                       const RowRange& rows) {
    require_at_least("samples", picture.samples, 1);
    require_image_size(picture.width, picture.height);
    require(rows.first >= 0 && rows.first < rows.last, "the first row",
            static_cast<long long>(rows.first), "at least 0 and below the last");
    require(rows.last <= picture.height, "the last row",
            static_cast<long long>(rows.last), "at most the picture's height");
    RenderedT<T> result{.image = make_image<T>(picture.width, rows.last - rows.first)};
    const Pattern pattern = make_pattern(picture.sampling, picture.samples);
    const int tiles = (picture.width - 1) / detail::strip_width + 1;
    std::vector<Counts> counts(static_cast<std::size_t>(tiles) *
                               static_cast<std::size_t>(result.image.height));
    // [strip]
    const auto strip = [&](long long number) {
        const int row = static_cast<int>(number / tiles);
        const int first = static_cast<int>(number % tiles) * detail::strip_width;
        const int last = std::min(first + detail::strip_width, picture.width);
        Counts cost; // of its own: two threads do not share a cache line
        std::array<detail::PixelSums, detail::strip_width> sums{};
        detail::SampleSums<R, T> samples(renderer, sums, cost);
        for (int x = first; x < last; ++x)
            for (int i = 0; i < picture.samples; ++i)
                samples.add(std::size_t(x - first), [&](auto& log) {
                    return detail::trace_pixel(renderer, camera, picture, pattern, x,
                                               rows.first + row, i, cost, log);
                });
        samples.finish();
        for (int x = first; x < last; ++x)
            pixel(result.image, x, row) =
                RgbT<T>(sums[std::size_t(x - first)].sum / double(picture.samples));
        counts[static_cast<std::size_t>(number)] = cost;
    };
    // [strip]
    result.complete =
        parallel_blocks(static_cast<long long>(counts.size()), strip,
                        {.threads = picture.threads, .progress = picture.progress});
    for (const Counts& cost : counts) result.counts += cost;
    return result;
}

/// Renders a picture by several threads, in strips of 16 pixels.
/// \param renderer  A PathTracer, a PhotonMapper, or any other Renderer.
/// \param camera    A CameraT, or anything with a camera_ray().
/// \param picture   Size, rays, seed, threads.
/// \return The picture, the same for any number of threads. A sample that is not finite
///         is left out and counted.
/// \throws std::invalid_argument  if the size or the number of rays is below 1.
template <typename R, template <std::floating_point> typename AnyCamera,
          std::floating_point T>
[[nodiscard]] RenderedT<T> render(const R& renderer, const AnyCamera<T>& camera,
                                  const RenderSettings& picture) {
    constexpr bool renders = Renderer<R, T>;
    static_assert(renders, "It is no renderer: make_path_tracer(scene) makes one.");
    if constexpr (renders)
        return render_rows(renderer, camera, picture, {0, picture.height});
    else
        return {};
}
/// \}

} // namespace ljus
