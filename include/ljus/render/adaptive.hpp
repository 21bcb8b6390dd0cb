#pragma once

/// \file ljus/render/adaptive.hpp
/// \brief Rays where they are needed: pictures that know their own error.

#include <algorithm>
#include <span>
#include <vector>

#include "ljus/render/detail/adaptive_blocks.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \defgroup adaptive Adaptive sampling
/// \brief Discussion: "priority-driven ray tracing"; section 4.3: how many rays?
/// Chapter: \ref ch_recursion_depth.
///
/// Every pixel gets a few rays, which tell how much rays differ there; the others go
/// where they take away most of the error. The mean number of rays per pixel is
/// at most RenderSettings::samples.
///
///     // 2 rays; 8 more where their mean has a relative standard error above 0.2
///     render_adaptive(mapper, camera, {.samples = 10},
///                     {.first = 2, .more = 8, .batches = 1, .disagreement = 0.2});
///     // as many as it takes, up to 1000 in the mean, for a relMSE of 0.01
///     render_adaptive(mapper, camera, {.samples = 1000}, {.target = 0.01});
/// \{

/// What an adaptive rendering brings.
template <std::floating_point T>
struct AdaptiveT {
    ImageT<T> image{};    ///< The mean radiance of each pixel.
    ImageT<T> rays{};     ///< How many rays each pixel had, those forgotten included.
    double estimate = 0;  ///< The relMSE that it believes to have, noise alone.
    bool reached = false; ///< Whether that is the target or less.
    Counts counts{};      ///< What it cost.
    bool complete = true; ///< False if the progress callback stopped it.
};

namespace detail {

/// Sends the batches through a block that it is to have in this round.
/// \param samples   Takes what they find; the pixels' places are those in the picture.
/// \param renderer  A PathTracer, a PhotonMapper, or any other Renderer.
/// \param camera    A CameraT, or anything with a camera_ray().
/// \param picture   Size, seed, pattern.
/// \param rule      Rays in a batch.
/// \param block     The block; its batches and rays are counted.
/// \param cost      Counts the rays.
template <typename R, template <std::floating_point> typename AnyCamera,
          std::floating_point T>
void trace_block(SampleSums<R, T>& samples, const R& renderer,
                 const AnyCamera<T>& camera, const RenderSettings& picture,
                 const AdaptiveSettings& rule, AdaptiveBlock& block, Counts& cost) {
    for (; block.wanted > 0; --block.wanted) {
        const int batch = block.batches++;
        RenderSettings part = picture; // a whole pattern of its own
        part.samples = rays_in_batch(rule, batch);
        if (batch > 0)
            part.seed = mix_bits(picture.seed + mix_bits(std::uint64_t(batch)));
        const Pattern pattern = make_pattern(part.sampling, part.samples);
        for (int y = block.y; y < block.bottom; ++y)
            for (int x = block.x; x < block.right; ++x)
                for (int i = 0; i < part.samples; ++i)
                    samples.add(place_of(picture.width, x, y), [&](auto& log) {
                        return trace_pixel(renderer, camera, part, pattern, x, y, i,
                                           cost, log);
                    });
        block.rays += part.samples;
    }
}

/// Sends the batches that some blocks are to have, and judges these blocks.
///
/// What the samples of all these blocks ask later is asked together.
/// \param renderer  A PathTracer, a PhotonMapper, or any other Renderer.
/// \param camera    A CameraT, or anything with a camera_ray().
/// \param picture   Size, seed, pattern.
/// \param rule      Rays in a batch; what counts as dark.
/// \param blocks    The blocks; their batches, rays and variances are updated.
/// \param sums      Of all pixels of the picture.
/// \return What it cost.
template <typename R, template <std::floating_point> typename AnyCamera,
          std::floating_point T>
[[nodiscard]] Counts
trace_blocks(const R& renderer, const AnyCamera<T>& camera,
             const RenderSettings& picture, const AdaptiveSettings& rule,
             std::span<AdaptiveBlock* const> blocks, std::vector<PixelSums>& sums) {
    Counts cost; // of its own: two threads do not share a cache line
    SampleSums<R, T> samples(renderer, sums, cost);
    for (AdaptiveBlock* const block : blocks)
        trace_block(samples, renderer, camera, picture, rule, *block, cost);
    samples.finish();
    for (AdaptiveBlock* const block : blocks)
        block->variance = relative_variance(*block, sums, picture.width, rule.epsilon);
    return cost;
}

/// The relMSE that the blocks believe the picture to have, noise alone.
/// \param blocks  All blocks of the picture.
/// \param pixels  How many pixels it has.
[[nodiscard]] inline double relative_error(const std::vector<AdaptiveBlock>& blocks,
                                           std::size_t pixels) noexcept {
    double error = 0;
    for (const AdaptiveBlock& block : blocks)
        error += block.pixels() * block.variance / std::max(block.rays, 1);
    return error / double(pixels);
}

/// Sets the pixels of an adaptive picture to the means of their rays.
/// \param result     Gets the means and the numbers of rays.
/// \param blocks     All blocks of the picture.
/// \param sums       Of all its pixels.
/// \param forgotten  Rays that each pixel had besides those in the sums.
template <std::floating_point T>
void set_pixels(AdaptiveT<T>& result, const std::vector<AdaptiveBlock>& blocks,
                const std::vector<PixelSums>& sums, int forgotten) {
    for (const AdaptiveBlock& block : blocks)
        for (int y = block.y; y < block.bottom; ++y)
            for (int x = block.x; x < block.right; ++x) {
                const auto i = place_of(result.image.width, x, y);
                result.image.pixels[i] =
                    RgbT<T>(sums[i].sum / double(std::max(block.rays, 1)));
                result.rays.pixels[i] = RgbT<T>(T(block.rays + forgotten));
            }
}

} // namespace detail

/// Renders a picture with more rays where they differ more, by several threads.
///
/// *Trap*: which pixels get more depends on what their rays have found, and the same
/// rays are then averaged. A pixel whose first rays have all missed a bright spot is
/// believed to be dark, and stays so: the picture's mean is too dark. Larger blocks and
/// more first rays make that small; `two_stage` makes it 0.
/// \param renderer  A PathTracer, a PhotonMapper, or any other Renderer.
/// \param camera    A CameraT, or anything with a camera_ray().
/// \param picture   Size, seed, threads; `samples` is the limit for the mean.
/// \param rule      Which pixels get how many.
/// \return The picture and its estimate, the same for any number of threads. A sample
///         that is not finite is left out and counted.
/// \throws std::invalid_argument  as render(), or for a setting out of range, or if
///         there are fewer samples than first rays.
/// \cost The rays, and 48 bytes per pixel.
/// \report{Sections 4.3 and 5}
template <typename R, template <std::floating_point> typename AnyCamera,
          std::floating_point T>
requires Renderer<R, T>
[[nodiscard]] AdaptiveT<T> render_adaptive(const R& renderer,
                                           const AnyCamera<T>& camera,
                                           const RenderSettings& picture,
                                           const AdaptiveSettings& rule = {}) {
    detail::check(rule, picture.samples);
    AdaptiveT<T> result{.image = make_image<T>(picture.width, picture.height),
                        .rays = make_image<T>(picture.width, picture.height)};
    std::vector<detail::PixelSums> sums(result.image.pixels.size());
    auto blocks = detail::adaptive_blocks(picture, rule.block);
    double traced = 0; // rays, of all that are allowed
    const double allowed = double(picture.samples) * double(sums.size());

    // Sends the batches that the blocks want, through 64 pixels or more at a time.
    const auto trace_round = [&] {
        std::vector<detail::AdaptiveBlock*> work;
        double rays = 0;
        for (auto& block : blocks)
            if (block.wanted > 0) {
                rays += detail::rays_wanted(block, rule);
                work.push_back(&block);
            }
        const int side = std::min(rule.block, 8);
        const long long size = 64 / (side * side);
        const auto all = static_cast<long long>(work.size());
        std::vector<Counts> counts(std::size_t(detail::block_count(all, size)));
        const auto some = [&](long long number) {
            const auto [first, last] = detail::block_range(number, size, all);
            counts[std::size_t(number)] = detail::trace_blocks(
                renderer, camera, picture, rule,
                std::span(work).subspan(std::size_t(first), std::size_t(last - first)),
                sums);
        };
        const auto progress = [&](long long done, long long of) {
            const double now = traced + rays * double(done) / double(of);
            return picture.progress(static_cast<long long>(now),
                                    static_cast<long long>(allowed));
        };
        const bool done =
            parallel_blocks(static_cast<long long>(counts.size()), some,
                            {.threads = picture.threads, .progress = progress});
        for (const Counts& cost : counts) result.counts += cost;
        traced += rays;
        return done;
    };
    const auto estimate = [&] { return detail::relative_error(blocks, sums.size()); };

    // [rounds]
    result.complete = trace_round(); // the first rays
    double limit = picture.samples;
    if (rule.two_stage) limit -= rule.first;
    while (result.complete &&
           !(rule.target > 0 && estimate() <= rule.target && !rule.two_stage) &&
           detail::plan_round(blocks, rule, limit)) {
        if (rule.two_stage) {
            sums.assign(sums.size(), {}); // the first rays only decided
            for (auto& block : blocks) block.rays = 0;
        }
        result.complete = trace_round();
        if (rule.two_stage) break;
    }
    // [rounds]
    if (result.complete) // it may have stopped long before
        (void)picture.progress(static_cast<long long>(allowed),
                               static_cast<long long>(allowed));
    result.estimate = estimate();
    result.reached = result.estimate <= rule.target * (1 + 1e-6); // but for rounding
    detail::set_pixels(result, blocks, sums, rule.two_stage ? rule.first : 0);
    return result;
}

/// \}

} // namespace ljus
