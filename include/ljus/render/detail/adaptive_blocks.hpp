#pragma once

/// \file ljus/render/detail/adaptive_blocks.hpp
/// \brief The squares of a picture that adaptive sampling judges, and its rule.

#include <algorithm>
#include <numeric>

#include "ljus/math/require.hpp"
#include "ljus/render/detail/ray_shares.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \addtogroup adaptive
/// \{

/// Which pixels get how many rays. Why `two_stage`: \cite kirk1991.
struct AdaptiveSettings {
    int first = 16;     ///< Rays in every pixel, at least 2.
    int more = 16;      ///< Rays in a batch, at least 1.
    int batches = 1000; ///< Batches that a pixel may get, at most; at least 0.
    int block = 1;      ///< Side of the squares of pixels that are judged together.
    double target = 0;  ///< The relMSE at which it stops; 0: none.
    double disagreement = 0; ///< Above 0: a batch for all whose mean has a relative
                             ///< standard error above this, and for no others.
    double epsilon = 0.01;   ///< Radiance squared that counts as dark, as in rel_mse().
    bool two_stage = false;  ///< The first rays only decide, and are then forgotten: no
                             ///< bias. Not with `disagreement`.
};

namespace detail {

/// Refuses a rule that gives no picture.
/// \param rule     The rule.
/// \param samples  The most rays per pixel, in the mean.
/// \throws std::invalid_argument  with name and value.
inline void check(const AdaptiveSettings& rule, int samples) {
    require_at_least("first", rule.first, 2);
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
                           : "at least as many as first rays");
}

/// A square of pixels; all of them have the same number of rays.
struct AdaptiveBlock {
    int x = 0, y = 0;          ///< Its upper left pixel.
    int right = 0, bottom = 0; ///< One past its last column and row.
    int rays = 0;              ///< Per pixel, less those that were forgotten.
    int batches = 0;           ///< Batches it has had; the first rays count as one.
    int wanted = 1;            ///< Batches it is to get in this round.
    double variance = 0;       ///< See relative_variance().

    /// How many pixels it has.
    [[nodiscard]] constexpr double pixels() const noexcept {
        return double(right - x) * (bottom - y);
    }
};

/// The squares of a picture, from the top left.
[[nodiscard]] inline std::vector<AdaptiveBlock>
adaptive_blocks(const RenderSettings& picture, int size) {
    std::vector<AdaptiveBlock> blocks;
    for (int y = 0; y < picture.height; y += size)
        for (int x = 0; x < picture.width; x += size)
            blocks.push_back({.x = x,
                              .y = y,
                              .right = std::min(x + size, picture.width),
                              .bottom = std::min(y + size, picture.height)});
    return blocks;
}

/// Where a pixel's sums stand, of a picture of this width.
[[nodiscard]] constexpr std::size_t place_of(int width, int x, int y) noexcept {
    return std::size_t(y) * std::size_t(width) + std::size_t(x);
}

/// How many rays a pixel gets in a batch.
/// \param rule   The rule.
/// \param batch  0: the first rays.
[[nodiscard]] constexpr int rays_in_batch(const AdaptiveSettings& rule,
                                          int batch) noexcept {
    return batch == 0 ? rule.first : rule.more;
}

/// How many rays a block is to have in this round.
[[nodiscard]] constexpr double rays_wanted(const AdaptiveBlock& block,
                                           const AdaptiveSettings& rule) noexcept {
    return block.pixels() * block.wanted * rays_in_batch(rule, block.batches);
}

/// How much the rays of a block differ, by what they have found.
///
/// The variance is relative to the mean of the block, which is known better than that
/// of a pixel. The rays of a pixel are taken for independent; because they are
/// stratified, the true variance of their mean is a little smaller.
/// \param block    At least 2 rays per pixel.
/// \param sums     Of all pixels.
/// \param width    Of the picture.
/// \param epsilon  What counts as dark.
/// \return The variance of a ray over mean^2 + epsilon; mean over channels and pixels.
[[nodiscard]] inline double relative_variance(const AdaptiveBlock& block,
                                              const std::vector<PixelSums>& sums,
                                              int width, double epsilon) {
    const double n = block.rays, count = block.pixels();
    RgbT<double> mean{0}, variance{0};
    for (int y = block.y; y < block.bottom; ++y)
        for (int x = block.x; x < block.right; ++x) {
            const PixelSums& found = sums[place_of(width, x, y)];
            mean += found.sum / (n * count);
            variance += (found.squares - found.sum * found.sum / n) / ((n - 1) * count);
        }
    const RgbT<double> relative = variance / (mean * mean + epsilon);
    return std::fmax((relative.x + relative.y + relative.z) / 3, 0.0); // not NaN
}

/// How many batches each block gets in the next round.
/// \param blocks  Their `wanted` is set.
/// \param rule    The rule.
/// \param limit   The most rays per pixel in the mean, less those that were forgotten.
/// \return Whether any block gets a batch.
inline bool plan_round(std::vector<AdaptiveBlock>& blocks, const AdaptiveSettings& rule,
                       double limit) {
    std::vector<RayShare> parts;
    double spare = 0; // rays
    for (const AdaptiveBlock& block : blocks) {
        // After the first stage all start anew, with a batch each.
        const double have = rule.two_stage ? rule.more : block.rays;
        parts.push_back({block.pixels(), block.variance, have});
        spare += block.pixels() * (limit - have);
    }
    std::vector<double> shares(parts.size());
    if (rule.disagreement == 0) shares = ray_shares(parts, rule.target, limit);

    std::vector<std::size_t> order(parts.size()); // those with the largest errors first
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return parts[a].variance / parts[a].rays > parts[b].variance / parts[b].rays;
    });
    const int begun = rule.two_stage ? 1 : 0; // the batch that each has
    const int most_batches = 1 + rule.batches - begun;
    bool any = false;
    for (const std::size_t i : order) {
        double batches = 0;
        if (rule.disagreement > 0) {
            batches = std::sqrt(parts[i].variance / parts[i].rays) > rule.disagreement;
        } else {
            // At most twice as many: an estimate by few rays is not believed for long.
            const double most = rule.two_stage ? shares[i] : 2 * parts[i].rays;
            const double lacking = std::min(shares[i], most) - parts[i].rays;
            batches = std::ceil(lacking / rule.more - 1e-6);
        }
        const double cost = rule.more * parts[i].pixels;
        batches = std::min({batches, double(most_batches - blocks[i].batches),
                            std::floor(spare / cost * (1 + 1e-9))});
        blocks[i].wanted = static_cast<int>(std::max(batches, 0.0));
        spare -= cost * blocks[i].wanted;
        blocks[i].wanted += begun;
        any = any || blocks[i].wanted > 0;
    }
    return any;
}

} // namespace detail

/// \}

} // namespace ljus
