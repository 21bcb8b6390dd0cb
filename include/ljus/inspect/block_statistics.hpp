#pragma once

/// \file ljus/inspect/block_statistics.hpp
/// \brief The means of a picture's blocks, with their standard errors.

#include <glm/exponential.hpp>

#include "ljus/inspect/metrics.hpp"

namespace ljus {

/// \addtogroup metrics
/// \{

/// The block means of several runs of one method.
struct BlockStatistics {
    ImageT<double> mean;           ///< Mean over all runs, block by block.
    ImageT<double> standard_error; ///< Its standard error, channel by channel.
    std::size_t runs = 0;          ///< The number of runs.
};

/// Computes the block means of several runs, with standard errors.
/// With b the mean of a block in one of M runs and m the mean of the b:
/// standard error = sqrt(sum (b - m)^2 / (M - 1) / M). It holds for photon maps too,
/// whose pixels are correlated, because whole runs are compared.
/// *Trap*: the standard error from M runs has a relative error of 1/sqrt(2(M - 1))
/// itself: 71 % with two runs, 18 % with 16.
/// \param runs  At least 2 pictures of the same size, with independent seeds.
/// \param size  Side of a block in pixels, at least 1.
/// \return Means and standard errors, in units of radiance.
/// \throws std::invalid_argument  for fewer than 2 runs, or as require_same_size() and
///         block_means().
template <std::floating_point T>
[[nodiscard]] BlockStatistics block_statistics(const std::vector<ImageT<T>>& runs,
                                               int size = 10) {
    if (runs.size() < 2)
        throw std::invalid_argument("A standard error needs at least 2 runs, but there "
                                    "are " +
                                    std::to_string(runs.size()) + ".");
    const double count = static_cast<double>(runs.size());
    std::vector<ImageT<double>> blocks;
    for (const ImageT<T>& run : runs) {
        detail::require_same_size(run, runs.front());
        blocks.push_back(block_means(run, size));
    }
    const int width = blocks.front().width, height = blocks.front().height;
    BlockStatistics result{make_image<double>(width, height),
                           make_image<double>(width, height), runs.size()};
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
    return result;
}

/// \}

} // namespace ljus
