#pragma once

/// \file ljus/photons/verdict_grid.hpp
/// \brief Verdicts about shadow rays, precomputed from photons for the cells of a grid.

#include "ljus/photons/detail/verdict_bits.hpp"

namespace ljus {

/// \addtogroup shadow_photons
/// \{

/// The fast counterpart of verdict_at(): a verdict for each cell of a grid, for each of
/// the six facings of a surface, and for each light \cite jensen1995.
///
/// The verdict of a cell is that of the photons in the cell and in its 26 neighbours.
/// These 27 cells contain all photons within the length of a cell around any point of
/// the middle cell. If there are too few photons for a verdict, cells of twice and then
/// of four times the length are used.
template <std::floating_point T>
struct VerdictGridT {
    detail::VerdictBitsT<T> known{}; ///< The verdicts, in bricks of 4 x 4 x 4 cells.
    bool dark_known = false;         ///< Whether indirect photons were counted.

    /// A cell of the grid, for one facing of a surface.
    struct Cell {
        /// The bits of the cell's brick; null if no brick contains the cell.
        const std::uint64_t* bits = nullptr;
        std::uint32_t cell = 0; ///< Index in the brick, 0 to 63.
    };

    /// Whether the grid has no verdicts.
    [[nodiscard]] bool empty() const noexcept { return known.bits.empty(); }
    /// The length of the smallest cells, in scene units.
    [[nodiscard]] T radius() const noexcept { return known.cells.length; }
    /// The size in bytes.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return known.table.bytes() + known.bits.size() * sizeof(known.bits[0]);
    }

    /// Finds the cell of a point. One cell serves for all lights.
    /// \param point  Point of a surface.
    /// \param side   +1 for the side of its normal, -1 for the other side.
    /// \cost About ten nanoseconds.
    // [cell_of]
    [[nodiscard]] Cell cell_of(const SurfacePointT<T>& point, int side) const noexcept {
        if (empty()) return {};
        const int way = detail::facing(point.normal, side);
        const auto at = known.cells.cell_of(point.position, way);
        if (!at) return {};
        const std::uint32_t brick = known.table.find(detail::brick_key(*at));
        if (brick == detail::BrickTable::none) return {};
        return {&known.bits[brick * known.stride()], at->in_brick()};
    }

    /// The verdict about a light.
    [[nodiscard]] Verdict verdict(const Cell& at, std::size_t light) const noexcept {
        if (at.bits == nullptr) return Verdict::unknown;
        const std::uint64_t lit = at.bits[2 * light] >> at.cell & 1;
        const std::uint64_t shadow = at.bits[2 * light + 1] >> at.cell & 1;
        return static_cast<Verdict>(lit + 2 * shadow); // branch-free
    }
    // [cell_of]

    /// Whether an indirect photon lies in the cell or in one of its neighbours. Also
    /// true if indirect photons were not counted.
    [[nodiscard]] bool indirect_near(const Cell& at) const noexcept {
        if (!dark_known) return true;
        return at.bits != nullptr && (at.bits[2 * known.lights] >> at.cell & 1) != 0;
    }
};
using VerdictGrid = VerdictGridT<float>; ///< VerdictGridT in float.

namespace detail {

/// The cell of a vertex, on the side of `wo`.
template <std::floating_point T>
[[nodiscard]] auto cell_of(const VerdictGridT<T>& grid,
                           const VertexT<T>& vertex) noexcept {
    return grid.cell_of(vertex.point, vertex.wo.z < T(0) ? -1 : 1);
}

/// The verdicts of a grid at a vertex, on the side of `wo`, for sample_all_lights().
/// The grid may be empty, and must outlive the result.
template <std::floating_point T>
[[nodiscard]] auto verdicts_at(const VerdictGridT<T>& grid,
                               const VertexT<T>& vertex) noexcept {
    return [&grid, at = cell_of(grid, vertex)](std::size_t light) noexcept {
        return grid.verdict(at, light);
    };
}

/// Replaces unknown verdicts by those of a coarser grid, whose cells are longer by the
/// factor `times`.
template <std::floating_point T>
void fill_from(VerdictBitsT<T>& fine, const VerdictBitsT<T>& coarse, int times) {
    for (std::size_t b = 0; b < fine.table.size(); ++b) {
        const VerdictCell first = first_cell(fine.table.keys()[b]);
        for (int cell = 0; cell < 64; ++cell) {
            const VerdictCell at{(first.x + (cell & 3)) / times,
                                 (first.y + (cell >> 2 & 3)) / times,
                                 (first.z + (cell >> 4)) / times, first.way};
            const std::uint32_t from = coarse.table.find(brick_key(at));
            if (from == BrickTable::none) continue;
            for (std::size_t light = 0; light < fine.lights; ++light) {
                std::uint64_t* const to = &fine.bits[b * fine.stride() + 2 * light];
                const std::uint64_t* const bits =
                    &coarse.bits[from * coarse.stride() + 2 * light];
                if ((to[0] | to[1]) >> cell & 1) continue;
                to[0] |= (bits[0] >> at.in_brick() & 1) << cell;
                to[1] |= (bits[1] >> at.in_brick() & 1) << cell;
            }
        }
    }
}

/// Copies the verdicts of light 0 to all lights, for SkipRule::report.
template <std::floating_point T>
void copy_to_all_lights(VerdictBitsT<T>& grid) {
    for (std::size_t b = 0; b < grid.bits.size(); b += grid.stride())
        for (std::size_t i = 2; i < 2 * grid.lights; ++i)
            grid.bits[b + i] = grid.bits[b + i % 2];
}

} // namespace detail

/// Computes the verdicts of a grid from direct and shadow photons, and from indirect
/// photons if skip.indirect_rays is set. Photons without a normal are ignored.
/// \param photons  The photons of a general map.
/// \param lights   The number of lights.
/// \param skip     The settings.
/// \param threads  As in ParallelSettings.
/// \return The grid, the same for any number of threads. Empty if there are no photons
///         or if the settings skip no rays.
/// \throws std::invalid_argument  if a setting is out of range, or if there would be
///         too many cells.
template <std::floating_point T>
[[nodiscard]] VerdictGridT<T>
make_verdict_grid(const std::vector<PhotonT<T>>& photons, std::size_t lights,
                  const SkipSettings& skip, int threads = 0) {
    check(skip);
    VerdictGridT<T> grid{.dark_known = skip.indirect_rays};
    if (photons.empty() || !detail::skips_rays(skip)) return grid;
    BoxT<T> box;
    for (const PhotonT<T>& photon : photons) box = box_union(box, photon.position);
    const T length = detail::cell_length(photons, box, lights, skip);
    if (!(length > 0)) return grid; // all photons at one point
    // The corner is offset by half a cell. Walls at the border of the scene then lie in
    // the middle of cells.
    const Vec3T<T> corner = box.low - T(32.5) * length;
    grid.known = detail::make_bits(photons, {corner, length}, lights, skip, threads);
    SkipSettings coarse = skip; // indirect photons count in the smallest cells only
    coarse.indirect_rays = false;
    for (const int times : {2, 4})
        if (skip.rule != SkipRule::none)
            detail::fill_from(grid.known,
                              detail::make_bits(photons, {corner, T(times) * length},
                                                lights, coarse, threads),
                              times);
    if (skip.rule == SkipRule::report) detail::copy_to_all_lights(grid.known);
    return grid;
}

/// \}

} // namespace ljus
