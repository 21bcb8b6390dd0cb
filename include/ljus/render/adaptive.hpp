#pragma once

/// \file ljus/render/adaptive.hpp
/// \brief Adaptive sampling: more rays where a picture is noisy, and an error estimate.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "ljus/render/render.hpp"

namespace ljus {

/// \defgroup adaptive Adaptive sampling
/// \brief The report proposes "priority-driven ray tracing" in its discussion, and asks
/// in Section 4.3 how many rays a pixel needs. Chapter: \ref ch_recursion_depth.
///
/// Every pixel gets a few rays, which estimate the variance there; the remaining rays
/// go to the pixels where they reduce the error most. The mean number of rays per pixel
/// is at most RenderSettings::samples.
///
///     // 1 ray per pixel, and up to 9 more if the rays of neighbouring pixels differ:
///     // all 9 if their relative standard deviation is at least 0.3
///     render_adaptive(mapper, camera, {.samples = 10},
///                     {.first = 1, .more = 9, .disagreement = 0.3});
///     // up to 1000 rays per pixel on average, until the relMSE is 0.01
///     render_adaptive(mapper, camera, {.samples = 1000}, {.target = 0.01});
/// \{

/// How rays are allocated to pixels. The bias that `two_stage` avoids is described in
/// \cite kirk1991.
struct AdaptiveSettings {
    /// Number of first rays of every pixel, at least 2. With `disagreement` and without
    /// a target, 1 is enough.
    int first = 16;
    /// Number of rays per pixel in each batch after the first rays, at least 1; with
    /// `two_stage`, at least 2. With `disagreement`, a batch may have fewer.
    int more = 16;
    int batches = 1000; ///< Largest number of batches per pixel, at least 0.
    /// Side of a square block, in pixels. The pixels of a block share one estimate of
    /// variance and get the same number of rays.
    int block = 1;
    double target = 0; ///< Rendering stops when the estimated relMSE is at most this
                       ///< number; 0: no target.
    /// If above 0, each block gets one batch after its first rays. The number of rays
    /// in the batch is proportional to the relative standard deviation of the first
    /// rays of the eight blocks around it. The batch has its largest size, the setting
    /// `more`, if that deviation is at least this number.
    double disagreement = 0;
    /// The relative variance is the variance divided by the sum of the squared mean and
    /// this number, as in rel_mse().
    double epsilon = 0.01;
    /// Whether the first rays only decide how many rays follow and are then discarded,
    /// which removes the bias. Not allowed with `disagreement`, which has no bias.
    bool two_stage = false;
};

/// Checks the settings of adaptive sampling.
/// \param rule     The settings.
/// \param samples  Largest mean number of rays per pixel.
/// \throws std::invalid_argument  if a setting is out of range.
inline void check(const AdaptiveSettings& rule, int samples) {
    const bool by_others = rule.disagreement > 0 && rule.target == 0;
    require_at_least("first", rule.first, by_others ? 1 : 2);
    require_at_least("more", rule.more, rule.two_stage ? 2 : 1);
    require_at_least("batches", rule.batches, rule.two_stage ? 1 : 0);
    require_at_least("block", rule.block, 1);
    require(rule.target >= 0, "target", rule.target, "at least 0");
    require(rule.disagreement >= 0, "disagreement", rule.disagreement, "at least 0");
    require(std::isfinite(rule.epsilon) && rule.epsilon > 0, "epsilon", rule.epsilon,
            "finite and above 0");
    require(!(rule.two_stage && rule.disagreement > 0), "disagreement",
            rule.disagreement, "0 with two_stage");
    const long long least = rule.first + (rule.two_stage ? rule.more : 0LL);
    require(samples >= least, "samples", static_cast<long long>(samples),
            rule.two_stage ? "at least first + more"
                           : "at least first, the first rays of a pixel");
}

/// The result of adaptive rendering.
template <std::floating_point T>
struct AdaptiveT {
    ImageT<T> image{};    ///< The mean radiance of each pixel.
    ImageT<T> rays{};     ///< Rays of each pixel, including discarded ones.
    double estimate = 0;  ///< An estimate of the relMSE that noise causes.
    bool reached = false; ///< Whether the estimate is at most the target.
    Counts counts{};      ///< Numbers of rays and photons.
    bool complete = true; ///< False if the progress callback stopped the work.
};

namespace detail {

/// A square of pixels; all of them have the same number of rays.
struct AdaptiveBlock {
    int x = 0, y = 0;          ///< Column and row of the upper left pixel.
    int right = 0, bottom = 0; ///< One past the last column and row.
    int rays = 0;              ///< Rays per pixel so far, without discarded ones.
    int batches = 0;           ///< Batches traced so far, including the first rays.
    int wanted = 1;            ///< Batches to trace in this round.
    int more = 0;              ///< Rays per pixel in each batch but the first.
    double variance = 0; ///< Relative variance of the rays; see relative_variance().
    Rgb sum{0};          ///< Sum of the radiance of the first rays.
    Rgb squares{0};      ///< Sum of the squared radiance of the first rays.

    [[nodiscard]] constexpr double pixels() const noexcept {
        return double(right - x) * (bottom - y);
    }
};

/// Lists the blocks of some rows, row by row. A picture is divided into blocks of
/// `size` times `size` pixels. `first` is the number of the first row of blocks, and
/// `last` is the number after that of the last row.
[[nodiscard]] inline std::vector<AdaptiveBlock>
adaptive_blocks(const RenderSettings& picture, int size, int first, int last) {
    std::vector<AdaptiveBlock> blocks;
    for (int y = first * size; y < std::min(last * size, picture.height); y += size)
        for (int x = 0; x < picture.width; x += size)
            blocks.push_back({.x = x,
                              .y = y,
                              .right = std::min(x + size, picture.width),
                              .bottom = std::min(y + size, picture.height)});
    return blocks;
}

[[nodiscard]] constexpr std::size_t pixel_index(int width, int x, int y) noexcept {
    return std::size_t(y) * std::size_t(width) + std::size_t(x);
}

/// The sums of the pixels in some rows of a picture.
struct RowSums {
    int width = 0;                   ///< Width of the picture.
    int top = 0;                     ///< The first row.
    std::vector<PixelSums> pixels{}; ///< The sums of the pixels, row by row.

    [[nodiscard]] std::size_t index(int x, int y) const noexcept {
        return pixel_index(width, x, y - top);
    }
    /// Removes the first `count` blocks, which fill whole rows, and their sums.
    void drop(std::vector<AdaptiveBlock>& blocks, std::size_t count) {
        if (count == 0) return;
        const int rows = blocks[count - 1].bottom - top;
        pixels.erase(pixels.begin(), pixels.begin() + std::ptrdiff_t(width) * rows);
        blocks.erase(blocks.begin(), blocks.begin() + std::ptrdiff_t(count));
        top += rows;
    }
};

[[nodiscard]] constexpr int rays_in_batch(const AdaptiveSettings& rule,
                                          const AdaptiveBlock& block) noexcept {
    return block.batches == 0 ? rule.first : block.more;
}

[[nodiscard]] constexpr double rays_wanted(const AdaptiveBlock& block,
                                           const AdaptiveSettings& rule) noexcept {
    return block.pixels() * block.wanted * rays_in_batch(rule, block);
}

/// The variance of a ray divided by mean^2 + epsilon, averaged over the channels and
/// pixels of a block with at least 2 rays per pixel.
///
/// The mean is that of the block, which is less noisy than that of a pixel. The rays of
/// a pixel are assumed to be independent; because they are stratified, the true
/// variance of their mean is slightly smaller.
[[nodiscard]] inline double relative_variance(const AdaptiveBlock& block,
                                              const RowSums& sums, double epsilon) {
    const double n = block.rays, count = block.pixels();
    RgbT<double> mean{0}, variance{0};
    for (int y = block.y; y < block.bottom; ++y)
        for (int x = block.x; x < block.right; ++x) {
            const PixelSums& found = sums.pixels[sums.index(x, y)];
            mean += found.sum / (n * count);
            variance += (found.squares - found.sum * found.sum / n) / ((n - 1) * count);
        }
    const RgbT<double> relative = variance / (mean * mean + epsilon);
    return std::fmax((relative.x + relative.y + relative.z) / 3, 0.0); // not NaN
}

/// Sets the statistics of a block from which plan_round() allocates rays. These are the
/// variance or, with `disagreement`, the sums of the first rays.
inline void set_statistics(AdaptiveBlock& block, const RowSums& sums,
                           const AdaptiveSettings& rule) {
    if (rule.disagreement == 0) {
        block.variance = relative_variance(block, sums, rule.epsilon);
        return;
    }
    for (int y = block.y; y < block.bottom; ++y)
        for (int x = block.x; x < block.right; ++x) {
            const PixelSums& found = sums.pixels[sums.index(x, y)];
            block.sum += Rgb(found.sum);
            block.squares += Rgb(found.squares);
        }
}

/// The statistics of a block that ray_shares() needs.
struct RayShare {
    double pixels = 1;   ///< Number of pixels in the block.
    double variance = 0; ///< Relative variance of one ray, as a mean over the pixels.
    double rays = 1;     ///< Rays per pixel so far.
};

/// The optimal number of rays per pixel for each block. With a target, the mean of
/// variance / rays over all pixels reaches the target with the fewest rays. Without a
/// target, or if the limit does not allow enough rays, that mean is as small as the
/// limit allows.
///
/// A block has w pixels, variance v and n rays per pixel. The sum of w v / n over all
/// blocks is minimised for a given sum of w n. By Lagrange multipliers, v / n^2 is the
/// same for all blocks, so that n is proportional to the square root of the variance
/// \cite neyman1934. A block that already has more rays keeps them, and the remaining
/// rays are distributed over the other blocks.
/// \param target  The wanted mean of variance / rays; 0: no target.
/// \param limit   Largest mean number of rays per pixel.
/// \return Rays per pixel for each block, never fewer than the block already has.
[[nodiscard]] inline std::vector<double> ray_shares(const std::vector<RayShare>& parts,
                                                    double target, double limit) {
    std::vector<double> wanted(parts.size());
    std::vector<bool> settled(parts.size(), false);
    for (bool again = true; again;) {
        double roots = 0, error = 0, rays = 0, pixels = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const RayShare& part = parts[i];
            pixels += part.pixels;
            if (!settled[i]) roots += part.pixels * std::sqrt(part.variance);
            if (!settled[i]) continue;
            error += part.pixels * part.variance / part.rays;
            rays += part.pixels * part.rays;
        }
        // [scale]
        // n = scale * sqrt(v). The scale reaches the target, or else uses all rays of
        // the limit.
        const double spare = std::fmax(limit * pixels - rays, 0.0);
        const double allowed = target * pixels - error;
        double scale = roots > 0 ? spare / roots : 0.0;
        if (target > 0 && allowed > 0) scale = std::fmin(scale, roots / allowed);
        again = false;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (settled[i]) continue;
            wanted[i] = scale * std::sqrt(parts[i].variance);
            if (wanted[i] > parts[i].rays) continue;
            wanted[i] = parts[i].rays;
            settled[i] = again = true;
        }
        // [scale]
    }
    return wanted;
}

/// Sets the variance of each block to the relative variance of the first rays of the
/// eight blocks around it; to infinity if these have fewer than two rays.
///
/// This variance includes the differences between pixels. An edge or the border of a
/// shadow is therefore noticed even with one ray per pixel.
/// \param blocks  All blocks of a picture, row by row.
inline void set_variances_around(std::vector<RayShare>& parts,
                                 const std::vector<AdaptiveBlock>& blocks,
                                 const AdaptiveSettings& rule) {
    const int all = static_cast<int>(blocks.size());
    int columns = 0;
    while (columns < all && blocks[std::size_t(columns)].y == blocks[0].y) ++columns;
    for (int i = 0; i < all; ++i) {
        const int x = i % columns, y = i / columns;
        const int right = std::min(x + 1, columns - 1);
        const int bottom = std::min(y + 1, all / columns - 1);
        double rays = 0;
        RgbT<double> sum{0}, squares{0};
        for (int v = std::max(y - 1, 0); v <= bottom; ++v)
            for (int u = std::max(x - 1, 0); u <= right; ++u) {
                if (u == x && v == y) continue;
                const AdaptiveBlock& block = blocks[pixel_index(columns, u, v)];
                rays += block.pixels() * rule.first;
                sum += RgbT<double>(block.sum);
                squares += RgbT<double>(block.squares);
            }
        double& variance = parts[std::size_t(i)].variance;
        variance = std::numeric_limits<double>::infinity();
        if (rays < 2) continue;
        const RgbT<double> mean = sum / rays;
        const RgbT<double> relative =
            (squares - mean * sum) / ((rays - 1) * (mean * mean + rule.epsilon));
        variance = std::fmax((relative.x + relative.y + relative.z) / 3, 0.0);
    }
}

/// Plans the number of batches of each block in the next round.
/// \param blocks  All blocks; the plan is stored in their `wanted` and `more`.
/// \param limit   Largest mean number of rays per pixel, without discarded ones.
/// \return Whether any block gets a batch.
inline bool plan_round(std::vector<AdaptiveBlock>& blocks, const AdaptiveSettings& rule,
                       double limit) {
    std::vector<RayShare> parts;
    double spare = 0; // rays
    for (const AdaptiveBlock& block : blocks) {
        // In two stages, each block starts the second stage with one batch.
        const double have = rule.two_stage ? rule.more : block.rays;
        parts.push_back({block.pixels(), block.variance, have});
        spare += block.pixels() * (limit - have);
    }
    if (rule.disagreement > 0) set_variances_around(parts, blocks, rule);
    std::vector<double> shares(parts.size());
    if (rule.disagreement == 0) shares = ray_shares(parts, rule.target, limit);

    std::vector<std::size_t> order(parts.size()); // largest errors first
    std::iota(order.begin(), order.end(), std::size_t{0});
    const bool scarce = rule.disagreement == 0 || limit - rule.first < rule.more;
    if (scarce) // otherwise each block gets what it asks for
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return parts[a].variance / parts[a].rays >
                   parts[b].variance / parts[b].rays;
        });
    const int begun = rule.two_stage ? 1 : 0; // the batch that begins the second stage
    const double most_batches = 1.0 + rule.batches - begun;
    bool any = false;
    for (const std::size_t i : order) {
        double batches = 0;
        blocks[i].more = rule.more;
        if (rule.disagreement > 0) {
            // As in ray_shares(), rays are proportional to the square root of the
            // variance.
            blocks[i].variance = parts[i].variance;
            const double part = std::sqrt(parts[i].variance) / rule.disagreement;
            blocks[i].more = static_cast<int>(rule.more * std::min(part, 1.0));
            if (blocks[i].more > 0) batches = 1;
        } else {
            // A round at most doubles the rays of a block, because an estimate from few
            // rays is unreliable.
            const double most = rule.two_stage ? shares[i] : 2 * parts[i].rays;
            const double lacking = std::min(shares[i], most) - parts[i].rays;
            batches = std::ceil(lacking / rule.more - 1e-6);
        }
        const double cost = std::max(blocks[i].more, 1) * parts[i].pixels;
        batches = std::min({batches, most_batches - blocks[i].batches,
                            std::floor(spare / cost * (1 + 1e-9))});
        blocks[i].wanted = static_cast<int>(std::max(batches, 0.0));
        spare -= cost * blocks[i].wanted;
        blocks[i].wanted += begun;
        any = any || blocks[i].wanted > 0;
    }
    return any;
}

/// Traces the batches of a block in this round.
/// \param samples  Receives the samples of the block.
/// \param sums     The sums of the pixels, to which `samples` adds each sample.
template <typename R, CameraLike C, std::floating_point T>
void trace_block(SampleSums<R, T>& samples, const RowSums& sums, const R& renderer,
                 const C& camera, const RenderSettings& picture,
                 const AdaptiveSettings& rule, AdaptiveBlock& block, Counts& cost) {
    for (; block.wanted > 0; --block.wanted) {
        RenderSettings part = picture; // with its own sampling pattern
        part.samples = rays_in_batch(rule, block);
        const int batch = block.batches++;
        if (batch > 0)
            part.seed = mix_bits(picture.seed + mix_bits(std::uint64_t(batch)));
        const PictureRays rays(part);
        for (int y = block.y; y < block.bottom; ++y)
            for (int x = block.x; x < block.right; ++x)
                for (int i = 0; i < part.samples; ++i)
                    samples.add(sums.index(x, y), [&](auto& later) {
                        return trace_pixel(renderer, camera, rays, {x, y, i}, cost,
                                           no_log, later);
                    });
        block.rays += part.samples;
    }
}

/// Traces the batches of some blocks. The delayed queries of their samples are answered
/// together.
template <typename R, CameraLike C>
[[nodiscard]] Counts
trace_blocks(const R& renderer, const C& camera, const RenderSettings& picture,
             const AdaptiveSettings& rule, std::span<AdaptiveBlock* const> blocks,
             RowSums& sums) {
    Counts cost; // local, so that threads do not share a cache line
    SampleSums<R, typename C::Scalar> samples(renderer, sums.pixels, cost);
    for (AdaptiveBlock* const block : blocks)
        trace_block(samples, sums, renderer, camera, picture, rule, *block, cost);
    samples.finish();
    return cost;
}

/// Estimates the squared relative error of each pixel of some blocks, and adds the
/// estimates to `error`. They have no bias for a pixel with several rays. For a pixel
/// with a single ray the estimate is too large, because it uses the variance of the
/// rays in the blocks around the pixel.
inline void add_errors(double& error, std::span<const AdaptiveBlock> blocks,
                       const RowSums& sums, double epsilon) {
    for (const AdaptiveBlock& block : blocks)
        error += block.pixels() *
                 (block.rays == 1 ? block.variance
                                  : relative_variance(block, sums, epsilon)) /
                 std::max(block.rays, 1);
}

/// Sets the pixels of an adaptive picture to the means of their rays.
/// \param forgotten  Discarded rays per pixel, which the sums do not contain.
template <std::floating_point T>
void set_pixels(AdaptiveT<T>& result, std::span<const AdaptiveBlock> blocks,
                const RowSums& sums, int forgotten) {
    for (const AdaptiveBlock& block : blocks)
        for (int y = block.y; y < block.bottom; ++y)
            for (int x = block.x; x < block.right; ++x) {
                const auto i = pixel_index(result.image.width, x, y);
                result.image.pixels[i] = RgbT<T>(sums.pixels[sums.index(x, y)].sum /
                                                 double(std::max(block.rays, 1)));
                result.rays.pixels[i] = RgbT<T>(T(block.rays + forgotten));
            }
}

/// The number of rows of blocks in a band. Each band is finished before the next one
/// begins, which saves memory. A band may have few rows if the rays of a block depend
/// only on the blocks around it. This requires `disagreement`, no target, and at least
/// `first` + `more` in picture.samples. In all other cases one band contains all rows.
[[nodiscard]] inline int rows_in_band(const RenderSettings& picture,
                                      const AdaptiveSettings& rule) noexcept {
    const int all = static_cast<int>(block_count(picture.height, rule.block));
    if (rule.disagreement == 0 || rule.target > 0 ||
        picture.samples - rule.first < rule.more)
        return all;
    // Each thread has so many pixels that it does not wait long at the end of a band.
    const int threads = picture.threads == 0 ? max_threads() : picture.threads;
    const long long pixels = 4096LL * std::max(threads, 4);
    const long long row = static_cast<long long>(picture.width) * rule.block;
    return static_cast<int>(std::clamp(pixels / row, 1LL, static_cast<long long>(all)));
}

} // namespace detail

/// Renders a picture with more rays where the variance is larger, by several threads.
///
/// *Trap*: unless `two_stage` or `disagreement` is set, the rays that are averaged also
/// decide how many rays follow. A pixel whose first rays all miss a bright spot seems
/// dark and gets no further rays, so that the picture is too dark on average. Larger
/// blocks and more first rays reduce this bias; `two_stage` removes it. With
/// `disagreement`, the blocks around a block decide how many rays it gets. This has no
/// bias if `samples` is at least `first` + `more`.
/// \param renderer  A PathTracer, a PhotonMapper, or any other Renderer.
/// \param camera    Any camera.
/// \param picture   Size, seed, threads; `samples` is the largest mean number of rays
///                  per pixel.
/// \param rule      How rays are allocated.
/// \return The picture and the estimate of its error, the same for any number of
///         threads. A sample that is not finite is left out and counted.
/// \throws std::invalid_argument  as render(), or if a setting is out of range, or if
///         there are fewer samples than first rays.
/// \cost The time of the rays. The result takes 24 bytes per pixel in float. During
///       rendering, about 200 bytes more are needed per pixel. With `disagreement`,
///       without a target and with at least `first` + `more` samples, the picture is
///       rendered in strips, and only one strip at a time needs these bytes. A strip
///       has 16384 pixels, or 4096 per thread if there are more than four threads.
/// \report{Sections 4.3 and 5}
template <typename R, CameraLike C>
requires Renderer<R, typename C::Scalar>
[[nodiscard]] AdaptiveT<typename C::Scalar>
render_adaptive(const R& renderer, const C& camera, const RenderSettings& picture,
                const AdaptiveSettings& rule = {}) {
    using T = typename C::Scalar;
    detail::require_fog_carried(renderer);
    check(rule, picture.samples);
    AdaptiveT<T> result{.image = make_image<T>(picture.width, picture.height),
                        .rays = make_image<T>(picture.width, picture.height)};
    const double pixels = double(result.image.pixels.size());
    const double allowed = double(picture.samples) * pixels;
    double traced = 0; // rays so far

    // The blocks of a band, and of one row above and below it: their first rays decide
    // too.
    std::vector<detail::AdaptiveBlock> blocks;
    detail::RowSums sums{.width = picture.width};

    // Traces the batches of the blocks, 64 pixels or more at a time.
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
    const auto update = [&](std::size_t from) {
        for (std::size_t i = from; i < blocks.size(); ++i)
            set_statistics(blocks[i], sums, rule);
    };

    const double limit = picture.samples - (rule.two_stage ? rule.first : 0);
    const bool once = rule.two_stage || rule.disagreement > 0;
    const int rounds = once ? 1 : std::numeric_limits<int>::max();
    const auto columns = std::size_t(detail::block_count(picture.width, rule.block));
    const int all = int(detail::block_count(picture.height, rule.block));
    const int band = detail::rows_in_band(picture, rule);
    const int around = band < all ? 1 : 0; // rows above and below a band
    const auto estimate = [&] {            // of a band with all rows
        double sum = 0;
        detail::add_errors(sum, blocks, sums, rule.epsilon);
        return sum / pixels;
    };
    double error = 0;
    int below = 0; // the next row of blocks
    for (int first = 0; first < all && result.complete; first += band) {
        const int last = std::min(first + band, all);
        const int end = std::min(last + around, all);
        const auto fresh = detail::adaptive_blocks(picture, rule.block, below, end);
        const std::size_t known = blocks.size();
        blocks.insert(blocks.end(), fresh.begin(), fresh.end());
        below = end;
        sums.pixels.resize(std::size_t(picture.width) *
                           std::size_t(blocks.back().bottom - sums.top));

        // [rounds]
        result.complete = trace_round(); // the first rays
        update(known);
        for (int round = 0; round < rounds && result.complete; ++round) {
            if (rule.target > 0 && estimate() <= rule.target && !rule.two_stage) break;
            if (!detail::plan_round(blocks, rule, limit)) break;
            for (auto& block : blocks) // no rays outside the band
                if (block.y < first * rule.block || block.y >= last * rule.block)
                    block.wanted = 0;
            if (rule.two_stage) {
                sums.pixels.assign(sums.pixels.size(), {}); // discard the first rays
                for (auto& block : blocks) block.rays = 0;
            }
            result.complete = trace_round();
            if (round + 1 < rounds) update(0); // a later band needs the old statistics
        }
        // [rounds]
        const int top = blocks[0].y / rule.block;
        const auto part = std::span<const detail::AdaptiveBlock>(blocks).subspan(
            columns * std::size_t(first - top), columns * std::size_t(last - first));
        detail::add_errors(error, part, sums, rule.epsilon);
        detail::set_pixels(result, part, sums, rule.two_stage ? rule.first : 0);
        sums.drop(blocks, columns * std::size_t(std::max(last - around - top, 0)));
    }
    if (result.complete) // reports the end, even if fewer rays were enough
        (void)picture.progress(static_cast<long long>(allowed),
                               static_cast<long long>(allowed));
    result.estimate = error / pixels;
    result.reached = result.estimate <= rule.target * (1 + 1e-6); // up to rounding
    return result;
}

/// \}

} // namespace ljus
