#pragma once

/// \file ljus/render/adaptive.hpp
/// \brief Rays where they are needed: pictures that know their own error.

#include "ljus/render/detail/adaptive_blocks.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \defgroup adaptive Adaptive sampling
/// \brief Discussion: "priority-driven ray tracing"; section 4.3: how many rays?
/// Chapter: \ref ch_recursion_depth.
///
/// Every pixel gets a few rays, which tell how much rays differ there; the others go
/// where they take away most of the error. RenderSettings::samples is the number of
/// rays a pixel in the mean, at most.
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
/// \cost The rays, and 48 bytes a pixel.
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

    // Adds rays to the pixels of a block: a whole pattern of its own each time.
    const auto add = [&](detail::AdaptiveBlock& block, int batch, Counts& cost) {
        RenderSettings part = picture;
        part.samples = batch == 0 ? rule.first : rule.more;
        if (batch > 0)
            part.seed =
                detail::mix_bits(picture.seed + detail::mix_bits(std::uint64_t(batch)));
        const Pattern pattern = make_pattern(picture.sampling, part.samples);
        for (int y = block.y; y < block.bottom; ++y)
            for (int x = block.x; x < block.right; ++x) {
                const auto place = detail::pixel_index(result.image, x, y);
                detail::PixelSums found = sums[place]; // threads share no cache line
                for (int i = 0; i < part.samples; ++i) {
                    const RgbT<double> sample(detail::sample_pixel(
                        renderer, camera, part, pattern, x, y, i, cost));
                    if (!is_finite(sample)) {
                        ++cost.rejected;
                        continue;
                    }
                    found.sum += sample;
                    found.squares += sample * sample;
                }
                sums[place] = found;
            }
        block.rays += part.samples;
    };
    double traced = 0; // rays, of all that are allowed
    const double allowed = double(picture.samples) * double(sums.size());
    // Runs `body(block, counts)` for all blocks.
    const auto for_blocks = [&](double rays, const auto& body) {
        std::vector<Counts> counts(blocks.size());
        const auto progress = [&](long long done, long long all) {
            const double now = traced + rays * double(done) / double(all);
            return picture.progress(static_cast<long long>(now),
                                    static_cast<long long>(allowed));
        };
        const bool done =
            parallel_blocks(static_cast<long long>(blocks.size()),
                            [&](long long i) {
                                const auto k = static_cast<std::size_t>(i);
                                Counts cost;
                                body(blocks[k], cost);
                                counts[k] = cost;
                                blocks[k].variance = detail::relative_variance(
                                    blocks[k], sums, picture.width, rule.epsilon);
                            },
                            {.threads = picture.threads, .progress = progress});
        for (const Counts& cost : counts) result.counts += cost;
        traced += rays;
        return done;
    };
    const auto estimate = [&] {
        double error = 0;
        for (const auto& block : blocks)
            error += block.pixels() * block.variance / std::max(block.rays, 1);
        return error / double(sums.size());
    };

    // [rounds]
    result.complete =
        for_blocks(double(rule.first) * double(sums.size()),
                   [&](auto& block, Counts& cost) { add(block, 0, cost); });
    double limit = picture.samples;
    if (rule.two_stage) limit -= rule.first;
    while (result.complete &&
           !(rule.target > 0 && estimate() <= rule.target && !rule.two_stage) &&
           detail::plan_round(blocks, rule, limit)) {
        double rays = 0;
        for (auto& block : blocks) rays += block.pixels() * block.wanted * rule.more;
        if (rule.two_stage) {
            sums.assign(sums.size(), {}); // the first rays have done their duty
            for (auto& block : blocks) block.rays = 0;
        }
        result.complete = for_blocks(rays, [&](auto& block, Counts& cost) {
            for (; block.wanted > 0; --block.wanted) add(block, ++block.batches, cost);
        });
        if (rule.two_stage) break;
    }
    // [rounds]
    if (result.complete) // it may have stopped long before
        (void)picture.progress(static_cast<long long>(allowed),
                               static_cast<long long>(allowed));
    result.estimate = estimate();
    result.reached = result.estimate <= rule.target * (1 + 1e-6); // but for rounding
    for (const auto& block : blocks)
        for (int y = block.y; y < block.bottom; ++y)
            for (int x = block.x; x < block.right; ++x) {
                const auto i = detail::pixel_index(result.image, x, y);
                const int rays = block.rays + (rule.two_stage ? rule.first : 0);
                result.image.pixels[i] =
                    RgbT<T>(sums[i].sum / double(std::max(block.rays, 1)));
                result.rays.pixels[i] = RgbT<T>(T(rays));
            }
    return result;
}

/// \}

} // namespace ljus
