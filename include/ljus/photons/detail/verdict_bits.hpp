#pragma once

/// \file ljus/photons/detail/verdict_bits.hpp
/// \brief Computes the bits of a verdict grid from photons.

#include <algorithm>
#include <array>

#include "ljus/geometry/box.hpp"
#include "ljus/parallel.hpp"
#include "ljus/photons/detail/brick_table.hpp"
#include "ljus/photons/shadow_verdict.hpp"

namespace ljus::detail {

/// \addtogroup shadow_photons
/// \{

/// Bricks with the bits of their cells.
template <std::floating_point T>
struct VerdictBitsT {
    CellsT<T> cells{};      ///< Geometry of the cells.
    std::size_t lights = 0; ///< Number of lights.
    BrickTable table{};     ///< The existing bricks.
    /// For each brick and each light: 64 bits for lit cells, then 64 for cells in
    /// shadow; finally 64 bits for cells with an indirect photon near.
    std::vector<std::uint64_t> bits{};

    /// Number of elements of `bits` per brick.
    [[nodiscard]] constexpr std::size_t stride() const noexcept {
        return 2 * lights + 1;
    }
};

/// The facing of the side on which a photon arrives.
template <std::floating_point T>
[[nodiscard]] int facing(const PhotonT<T>& photon) noexcept {
    return facing(photon.normal,
                  photon_side(photon.direction, Vec3T<T>(photon.normal)));
}

/// Whether a photon counts: its surface and its light are known.
template <std::floating_point T>
[[nodiscard]] bool is_witness(const PhotonT<T>& photon, std::size_t lights,
                              const SkipSettings& skip) noexcept {
    if (photon.light >= lights || photon.normal == SmallNormal{0}) return false;
    if (photon.kind == PhotonKind::indirect) return skip.indirect_rays;
    return photon.kind != PhotonKind::caustic && skip.rule != SkipRule::none;
}

/// The length of the smallest cells: with it, the neighbourhood of a cell contains on
/// average the needed number of photons of a light. A coarse grid measures the area on
/// which the photons lie.
/// \return In scene units; 0 if all photons lie at one point.
template <std::floating_point T>
[[nodiscard]] T cell_length(const std::vector<PhotonT<T>>& photons, const BoxT<T>& box,
                            std::size_t lights, const SkipSettings& skip) {
    const Vec3T<T> size = box.high - box.low;
    const T most = std::max({size.x, size.y, size.z});
    const T least = most / T(most_cells / 2);
    if (skip.radius > 0) return std::max(T(skip.radius), least);
    const CellsT<T> coarse{box.low - T(4.5) * most / T(32), most / T(32)};
    BrickTable seen; // one brick per cell
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

/// A counted photon: its cell, and whether it is a shadow photon.
struct Witness {
    std::uint32_t where = 0; ///< 64 times its brick, plus its cell.
    bool shadow = false;     ///< False: it carries light.
};

/// Finds the cells of photons, and inserts their bricks.
/// \param grid     Receives the bricks.
/// \return The counted photons by light; the last list has the indirect photons.
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
        // An indirect photon inserts all bricks in its neighbourhood: a missing brick
        // means that it is dark.
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

/// Limit of bricks in a grid; each takes 512 bytes during its construction.
inline constexpr std::uint32_t most_bricks = 1 << 21;

/// Numbers of photons in a cell: direct in the lower 32 bits, shadow in the upper 32.
using PackedCounts = std::uint64_t;

/// The counts of a brick and its surroundings: 6 x 6 x 6 cells, x first.
using CountsAround = std::array<PackedCounts, 216>;

/// Collects the counts of a brick and its surroundings.
/// \param counts  64 per brick.
[[nodiscard]] inline CountsAround
counts_around(const BrickTable& table, std::uint32_t brick,
              const std::vector<PackedCounts>& counts) {
    // Which of six layers along an axis come from the brick before, at, or after.
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

/// Sums each cell of a brick with its 26 neighbours, axis by axis.
/// \param sums  What counts_around() returned. Afterwards the sum of the cell (x, y,
///              z), each from 0 to 3, is at x + 6 y + 36 z.
constexpr void add_neighbors(CountsAround& sums) noexcept {
    for (const std::size_t step : {1u, 6u, 36u})
        for (std::size_t i = 0; i + 2 * step < sums.size(); ++i)
            sums[i] += sums[i + step] + sums[i + 2 * step];
}

/// Converts sums into bits.
/// \param needed  photons_needed() by this rule.
/// \return A bit for each lit cell, and one for each cell in shadow.
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

/// Computes the bits of all bricks.
/// \throws std::invalid_argument  if there would be more than most_bricks.
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
        const bool indirect = list == lights; // one photon is enough
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

/// \}

} // namespace ljus::detail
