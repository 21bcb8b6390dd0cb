#pragma once

/// \file support/block_means.hpp
/// \brief Pictures of several seeds, block by block.

#include <cstddef>
#include <vector>

#include "ljus/inspect/metrics.hpp"
#include "support/statistics.hpp"

namespace ljus_test {

/// The means of the blocks of pictures, all channels together, and last that of the
/// whole picture, which the blocks cover evenly.
struct BlockMeans {
    int side;               ///< Of a block, in pixels.
    std::vector<Mean> of{}; ///< One a block, and the whole.

    template <typename T>
    void add(const ljus::ImageT<T>& image) {
        const auto blocks = ljus::block_means(image, side).pixels;
        of.resize(blocks.size() + 1);
        double whole = 0;
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            const double value = (blocks[b].x + blocks[b].y + blocks[b].z) / 3;
            of[b].add(value);
            whole += value / double(blocks.size());
        }
        of.back().add(whole);
    }
};

} // namespace ljus_test
