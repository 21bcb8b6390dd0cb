#pragma once

/// \file ljus/inspect/block_statistics.hpp
/// \brief The means of a picture's blocks, with their standard errors.

#include <glm/exponential.hpp>

#include "ljus/inspect/metrics.hpp"

namespace ljus {

/// \addtogroup metrics
/// \{

/// What several runs of one method say of each block of the picture.
struct BlockStatistics {
    ImageT<double> mean;           ///< Of all runs, block by block.
    ImageT<double> standard_error; ///< Of that mean, channel by channel.
    std::size_t runs = 0;          ///< How many there were.
};

/// The block means of several runs, and how sure they are.
///
/// With b the mean of a block in one of M runs and m the mean of the b:
/// standard error = sqrt(sum (b - m)^2 / (M - 1) / M). It holds for photon maps too,
/// whose pixels share their photons, because whole runs are compared and not pixels.
/// *Trap*: from M runs the standard error itself is known within a part of
/// 1/sqrt(2(M - 1)): 71 % from two, 18 % from 16.
/// \param runs  At least 2 pictures of the same size, of independent seeds.
/// \param size  Side of a block in pixels, at least 1.
/// \return Means and standard errors, in units of radiance.
/// \throws std::invalid_argument  for fewer than 2 runs, or as require_same_size() and
///         block_means().
template <std::floating_point T>
[[nodiscard]] BlockStatistics block_statistics(const std::vector<ImageT<T>>& runs,
                                               int size = 10) {
    if (runs.size() < 2)
        throw std::invalid_argument("A standard error was asked of " +
                                    std::to_string(runs.size()) +
                                    " runs; there must be at least 2.");
    const double count = static_cast<double>(runs.size());
    std::vector<ImageT<double>> blocks;
    for (const ImageT<T>& run : runs) {
        detail::require_same_size(run, runs.front());
        blocks.push_back(block_means(run, size));
    }
    const int width = blocks.front().width, height = blocks.front().height;
    BlockStatistics result{make_image<double>(width, height),
                           make_image<double>(width, height), runs.size()};
    // [standard error]
    for (std::size_t i = 0; i < result.mean.pixels.size(); ++i) {
        RgbT<double>& mean = result.mean.pixels[i];
        for (const auto& block : blocks) mean += block.pixels[i] / count;
        RgbT<double> squares(0.0);
        for (const auto& block : blocks) {
            const RgbT<double> difference = block.pixels[i] - mean;
            squares += difference * difference;
        }
        result.standard_error.pixels[i] = glm::sqrt(squares / (count - 1.0) / count);
    }
    // [standard error]
    return result;
}

/// \}

} // namespace ljus
