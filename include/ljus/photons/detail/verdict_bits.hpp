#pragma once

/// \file ljus/photons/detail/verdict_bits.hpp
/// \brief Computes the bits of a VerdictGridT from photons. A brick is a block of 4 x 4
/// x 4 cells of the grid. Only bricks with photons are stored.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ljus/geometry/box.hpp"
#include "ljus/parallel.hpp"
#include "ljus/photons/shadow_verdict.hpp"

namespace ljus::detail {

/// A cell of the grid, for one facing of a surface.
struct VerdictCell {
    std::int32_t x = 0, y = 0, z = 0; ///< Indices along the axes, at least 0.
    std::int32_t way = 0;             ///< Facing of the surface; see facing().

    /// The index of the cell in its brick, 0 to 63.
    [[nodiscard]] constexpr std::uint32_t in_brick() const noexcept {
        return static_cast<std::uint32_t>((x & 3) | (y & 3) << 2 | (z & 3) << 4);
    }
};

inline constexpr std::int32_t most_cells = 1 << 20;

/// The key of the brick that contains a cell. The lowest 54 bits hold the brick's
/// three coordinates. The bits above hold `way` + 1, so that no key is 0.
[[nodiscard]] constexpr std::uint64_t brick_key(const VerdictCell& cell) noexcept {
    return std::uint64_t(cell.x >> 2) | std::uint64_t(cell.y >> 2) << 18 |
           std::uint64_t(cell.z >> 2) << 36 | std::uint64_t(cell.way + 1) << 54;
}

[[nodiscard]] constexpr VerdictCell first_cell(std::uint64_t key) noexcept {
    const auto axis = [&](int shift) {
        return static_cast<std::int32_t>(key >> shift & 0x3ffff) * 4;
    };
    return {axis(0), axis(18), axis(36), static_cast<std::int32_t>(key >> 54) - 1};
}

/// The geometry of a grid's cells.
template <std::floating_point T>
struct CellsT {
    Vec3T<T> corner{T(0)}; ///< Corner of cell (0, 0, 0) with the smallest coordinates.
    T length = T(0);       ///< Length of a cell, in scene units.

    /// The cell that contains a point; nothing outside the grid.
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

/// The indices of bricks by their keys: a hash table with open addressing that is at
/// most half full.
class BrickTable {
public:
    /// The result of find() for a missing brick.
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    [[nodiscard]] std::uint32_t size() const noexcept {
        return static_cast<std::uint32_t>(keys_.size());
    }
    /// The keys, in the order of insertion.
    [[nodiscard]] const std::vector<std::uint64_t>& keys() const noexcept {
        return keys_;
    }
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

    /// Inserts a brick if it is new, and returns its index.
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
        std::uint64_t key = 0; // 0: the entry is free
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

/// The bricks of a grid, with bits for the verdicts of their cells.
template <std::floating_point T>
struct VerdictBitsT {
    CellsT<T> cells{};      ///< Geometry of the cells.
    std::size_t lights = 0; ///< Number of lights.
    BrickTable table{};     ///< The existing bricks.
    /// Each brick has two elements per light: the first has a bit for each lit cell,
    /// the second a bit for each cell in shadow. In a last element the bit of a cell
    /// is set if the cell or one of its neighbours contains an indirect photon.
    std::vector<std::uint64_t> bits{};

    /// Number of elements of `bits` per brick.
    [[nodiscard]] constexpr std::size_t stride() const noexcept {
        return 2 * lights + 1;
    }
};

/// Whether a photon counts for the grid. Its surface and its light must be known, and
/// the settings must use its kind.
template <std::floating_point T>
[[nodiscard]] bool is_witness(const PhotonT<T>& photon, std::size_t lights,
                              const SkipSettings& skip) noexcept {
    if (photon.light >= lights || photon.normal == SmallNormal{0}) return false;
    if (photon.kind == PhotonKind::indirect) return skip.indirect_rays;
    return photon.kind != PhotonKind::caustic && skip.rule != SkipRule::none;
}

/// The length of the smallest cells of a grid. It is skip.radius or, if this is 0,
/// chosen from the photons: on average, a cell and its neighbours then contain as many
/// photons of each light as `skip.rule` needs, but at least 20.
/// \param box  The bounding box of the photons.
/// \return In scene units; 0 if all photons lie at one point.
template <std::floating_point T>
[[nodiscard]] T cell_length(const std::vector<PhotonT<T>>& photons, const BoxT<T>& box,
                            std::size_t lights, const SkipSettings& skip) {
    const Vec3T<T> size = box.high - box.low;
    const T most = std::max({size.x, size.y, size.z});
    const T least = most / T(most_cells / 2);
    if (skip.radius > 0) return std::max(T(skip.radius), least);
    const CellsT<T> coarse{box.low - T(4.5) * most / T(32), most / T(32)};
    BrickTable seen; // one brick per coarse cell, to measure the area with photons
    double witnesses = 0;
    for (const PhotonT<T>& photon : photons) {
        if (!is_witness(photon, lights, skip)) continue;
        const auto at = coarse.cell_of(photon.position, facing(photon));
        if (!at) continue;
        ++witnesses;
        (void)seen.insert(brick_key({4 * at->x, 4 * at->y, 4 * at->z, at->way}));
    }
    const double area = double(seen.size()) * double(coarse.length * coarse.length);
    const double wanted = double(std::max(photons_needed(skip), 20u));
    const double length =
        std::sqrt(wanted * area * double(lights) / (9 * std::max(witnesses, 1.0)));
    return std::max(T(length), least);
}

/// A photon that counts for the grid; see is_witness().
struct Witness {
    /// The photon's cell: 64 times the index of the brick plus the index within it.
    std::uint32_t where = 0;
    bool shadow = false; ///< True for a shadow photon, false for a direct one.
};

/// Finds the cells of photons, and inserts the bricks of these cells into the table of
/// a grid.
/// \return For each light a list of its direct and shadow photons, and then one list of
///         all indirect photons. With SkipRule::report the first list has the direct
///         and shadow photons of all lights, and the lists of the other lights are
///         empty.
template <std::floating_point T>
[[nodiscard]] std::vector<std::vector<Witness>>
find_witnesses(const std::vector<PhotonT<T>>& photons, const SkipSettings& skip,
               VerdictBitsT<T>& grid) {
    std::vector<std::vector<Witness>> found(grid.lights + 1);
    for (const PhotonT<T>& photon : photons) {
        if (!is_witness(photon, grid.lights, skip)) continue;
        const auto at = grid.cells.cell_of(photon.position, facing(photon));
        if (!at) continue;
        const bool indirect = photon.kind == PhotonKind::indirect;
        // An indirect photon inserts all bricks in its neighbourhood, because in a
        // missing brick no indirect photon is near.
        for (int corner = 0; indirect && corner < 8; ++corner)
            (void)grid.table.insert(
                brick_key({at->x + (corner & 1) * 2 - 1, at->y + (corner & 2) - 1,
                           at->z + (corner & 4) / 2 - 1, at->way}));
        const std::uint32_t brick = grid.table.insert(brick_key(*at));
        const bool together = skip.rule == SkipRule::report;
        const std::size_t list = indirect ? grid.lights : together ? 0 : photon.light;
        found[list].push_back(
            {64 * brick + at->in_brick(), photon.kind == PhotonKind::shadow});
    }
    return found;
}

/// The largest number of bricks in a grid. Each takes 512 bytes during the
/// construction.
inline constexpr std::uint32_t most_bricks = 1 << 21;

/// The numbers of photons in a cell: direct photons in the lower 32 bits, shadow
/// photons in the upper 32 bits.
using PackedCounts = std::uint64_t;

/// The counts of the cells of a brick and of the cells around it: 6 x 6 x 6 cells. The
/// index grows first along x.
using CountsAround = std::array<PackedCounts, 216>;

/// Collects the counts of the cells of a brick and of the cells around it.
/// \param counts  The counts of all cells, 64 per brick.
[[nodiscard]] inline CountsAround
counts_around(const BrickTable& table, std::uint32_t brick,
              const std::vector<PackedCounts>& counts) {
    // Of the six layers of cells along an axis, the first comes from the brick before,
    // four from the brick itself, and the last from the brick after.
    constexpr std::array<int, 4> layer{0, 1, 5, 6};
    CountsAround around{};
    const VerdictCell first = first_cell(table.keys()[brick]);
    for (std::size_t n = 0; n < 27; ++n) {
        const std::size_t i = n % 3, j = n / 3 % 3, k = n / 9;
        const auto moved = [](std::int32_t x, std::size_t by) {
            return x + 4 * (std::int32_t(by) - 1);
        };
        const std::uint32_t other = table.find(brick_key(
            {moved(first.x, i), moved(first.y, j), moved(first.z, k), first.way}));
        if (other == BrickTable::none) continue;
        for (int z = layer[k]; z < layer[k + 1]; ++z)
            for (int y = layer[j]; y < layer[j + 1]; ++y)
                for (int x = layer[i]; x < layer[i + 1]; ++x)
                    around[std::size_t(x + 6 * y + 36 * z)] =
                        counts[64 * std::size_t(other) +
                               VerdictCell{x + 3, y + 3, z + 3}.in_brick()];
    }
    return around;
}

/// Adds to the counts of each cell of a brick those of its 26 neighbours.
/// \param sums  The result of counts_around(). Receives the sums. The sum of the cell
///              (x, y, z) of the brick is at x + 6 y + 36 z.
constexpr void add_neighbors(CountsAround& sums) noexcept {
    for (const std::size_t step : {1u, 6u, 36u})
        for (std::size_t i = 0; i + 2 * step < sums.size(); ++i)
            sums[i] += sums[i + step] + sums[i + 2 * step];
}

/// Converts the sums of add_neighbors() into bits.
/// \return Two elements: a bit for each lit cell, and a bit for each cell in shadow.
[[nodiscard]] inline std::array<std::uint64_t, 2>
judge_brick(const CountsAround& sums, SkipRule rule, std::uint32_t needed) noexcept {
    std::array<std::uint64_t, 2> bits{};
    for (std::uint32_t cell = 0; cell < 64; ++cell) {
        const std::size_t at = (cell & 3) + 6 * (cell >> 2 & 3) + 36 * (cell >> 4);
        const PhotonCounts found{static_cast<std::uint32_t>(sums[at]),
                                 static_cast<std::uint32_t>(sums[at] >> 32)};
        const Verdict verdict = judge(found, rule, needed);
        bits[0] |= std::uint64_t{verdict == Verdict::lit} << cell;
        bits[1] |= std::uint64_t{verdict == Verdict::shadow} << cell;
    }
    return bits;
}

/// Computes a verdict grid from photons, stored as bits in bricks of 4 x 4 x 4 cells.
/// \throws std::invalid_argument  if there would be more than most_bricks bricks.
template <std::floating_point T>
[[nodiscard]] VerdictBitsT<T> make_bits(const std::vector<PhotonT<T>>& photons,
                                        const CellsT<T>& cells, std::size_t lights,
                                        const SkipSettings& skip, int threads) {
    VerdictBitsT<T> grid{.cells = cells, .lights = lights};
    const auto found = find_witnesses(photons, skip, grid);
    const std::uint32_t bricks = grid.table.size();
    require(bricks <= most_bricks, "the number of bricks in a verdict grid",
            static_cast<long long>(bricks),
            "at most 2097152: a larger skip.radius makes fewer");
    grid.bits.assign(bricks * grid.stride(), 0);
    std::vector<PackedCounts> counts(64 * std::size_t(bricks));
    for (std::size_t list = 0; list <= lights; ++list) {
        if (found[list].empty()) continue;
        const bool indirect = list == lights; // for these one photon is enough
        const SkipRule rule = indirect ? SkipRule::any : skip.rule;
        const std::uint32_t needed = indirect ? 1 : photons_needed(skip);
        for (const Witness& one : found[list])
            counts[one.where] += one.shadow ? PackedCounts{1} << 32 : 1;
        const auto judge_one = [&](std::size_t brick) {
            auto around = counts_around(grid.table, std::uint32_t(brick), counts);
            add_neighbors(around);
            const auto bits = judge_brick(around, rule, needed);
            std::uint64_t* const to = &grid.bits[brick * grid.stride() + 2 * list];
            to[0] = bits[0];
            if (!indirect) to[1] = bits[1];
        };
        (void)parallel_each(bricks, 64, judge_one, {.threads = threads});
        for (const Witness& one : found[list]) counts[one.where] = 0;
    }
    return grid;
}

} // namespace ljus::detail
