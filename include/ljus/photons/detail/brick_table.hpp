#pragma once

/// \file ljus/photons/detail/brick_table.hpp
/// \brief The cells of a grid in bricks of 4 x 4 x 4; only bricks with photons exist.

#include <cstdint>
#include <optional>
#include <vector>

#include "ljus/math/vector.hpp"

namespace ljus::detail {

/// \addtogroup shadow_photons
/// \{

/// A cell of the grid, with a facing of a surface.
struct VerdictCell {
    std::int32_t x = 0;   ///< Along the first axis; at least 0.
    std::int32_t y = 0;   ///< Along the second.
    std::int32_t z = 0;   ///< Along the third.
    std::int32_t way = 0; ///< Facing of the surface, 0 to 5.

    /// The index in its brick, 0 to 63.
    [[nodiscard]] constexpr std::uint32_t in_brick() const noexcept {
        return static_cast<std::uint32_t>((x & 3) | (y & 3) << 2 | (z & 3) << 4);
    }
};

/// Limit of cells along an axis.
inline constexpr std::int32_t most_cells = 1 << 20;

/// The key of a cell's brick, never 0: 18 bits per coordinate, and the facing.
[[nodiscard]] constexpr std::uint64_t brick_key(const VerdictCell& cell) noexcept {
    return std::uint64_t(cell.x >> 2) | std::uint64_t(cell.y >> 2) << 18 |
           std::uint64_t(cell.z >> 2) << 36 | std::uint64_t(cell.way + 1) << 54;
}

/// The first cell of a brick.
[[nodiscard]] constexpr VerdictCell first_cell(std::uint64_t key) noexcept {
    const auto axis = [&](int shift) {
        return static_cast<std::int32_t>(key >> shift & 0x3ffff) * 4;
    };
    return {axis(0), axis(18), axis(36), static_cast<std::int32_t>(key >> 54) - 1};
}

/// The geometry of a grid's cells.
template <std::floating_point T>
struct CellsT {
    Vec3T<T> corner{T(0)}; ///< Origin of cell (0, 0, 0).
    T length = T(0);       ///< Length of a cell, in scene units.

    /// The cell of a point; nothing outside the grid.
    [[nodiscard]] std::optional<VerdictCell> cell_of(const Vec3T<T>& point,
                                                     int way) const noexcept {
        const Vec3T<T> c = (point - corner) * (T(1) / length);
        const auto within = [](T x) { // false for NaN
            return x >= T(4) && x < T(most_cells - 4);
        };
        if (!within(c.x) || !within(c.y) || !within(c.z)) return std::nullopt;
        return VerdictCell{std::int32_t(c.x), std::int32_t(c.y), std::int32_t(c.z),
                           way};
    }
};

/// Bricks by key: a hash table with open addressing, at most half full.
class BrickTable {
public:
    /// What find() returns for a missing brick.
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// The number of bricks.
    [[nodiscard]] std::uint32_t size() const noexcept {
        return static_cast<std::uint32_t>(keys_.size());
    }
    /// The keys, in the order of insertion.
    [[nodiscard]] const std::vector<std::uint64_t>& keys() const noexcept {
        return keys_;
    }
    /// The size in bytes.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return entries_.size() * sizeof(Entry) + keys_.size() * sizeof(keys_[0]);
    }

    /// The index of a brick, or `none`.
    [[nodiscard]] std::uint32_t find(std::uint64_t key) const noexcept {
        for (std::size_t i = start(key);; i = (i + 1) & (entries_.size() - 1)) {
            if (entries_[i].key == key) return entries_[i].brick;
            if (entries_[i].key == 0) return none;
        }
    }

    /// The index of a brick; inserts it if it is new.
    std::uint32_t insert(std::uint64_t key) {
        if (2 * (keys_.size() + 1) > entries_.size()) grow();
        std::size_t i = start(key);
        while (entries_[i].key != 0 && entries_[i].key != key)
            i = (i + 1) & (entries_.size() - 1);
        if (entries_[i].key == 0) {
            entries_[i] = {key, size()};
            keys_.push_back(key);
        }
        return entries_[i].brick;
    }

private:
    struct Entry {
        std::uint64_t key = 0; // 0: free
        std::uint32_t brick = none;
    };

    // Fibonacci hashing: the upper bits of the product depend on the whole key.
    [[nodiscard]] std::size_t start(std::uint64_t key) const noexcept {
        return static_cast<std::size_t>(key * 0x9e3779b97f4a7c15u >> shift_);
    }

    void grow() {
        --shift_;
        entries_.assign(std::size_t{1} << (64 - shift_), Entry{});
        for (std::uint32_t brick = 0; brick < size(); ++brick) {
            std::size_t i = start(keys_[brick]);
            while (entries_[i].key != 0) i = (i + 1) & (entries_.size() - 1);
            entries_[i] = {keys_[brick], brick};
        }
    }

    int shift_ = 62; // 64 minus the logarithm of the number of entries
    std::vector<Entry> entries_ = std::vector<Entry>(4);
    std::vector<std::uint64_t> keys_;
};

/// \}

} // namespace ljus::detail
