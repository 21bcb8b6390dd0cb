#pragma once

/// \file ljus/photons/verdict_grid.hpp
/// \brief What photons say of shadow rays, worked out once for each cell of a grid.

#include "ljus/photons/detail/verdict_bits.hpp"

namespace ljus {

/// \addtogroup shadow_photons
/// \{

/// The fast twin of verdict_at(): a verdict for each cell of a grid, each of the six
/// ways that a surface may face in it, and each light. Shadow photons are from
/// \cite jensen1995.
///
/// A cell's verdict is that of all photons in the cell and its 26 neighbours, which
/// hold every photon within one cell's length of any point in it. If they are too few,
/// the cells around are taken twice as large, and then four times.
/// So where the grid says lit, verdict_at() with the length of its smallest cells finds
/// no shadow photon either.
template <std::floating_point T>
struct VerdictGridT {
    detail::VerdictBitsT<T> known{}; ///< Brick by brick.
    bool dark_known = false;         ///< Whether indirect photons were looked for.

    /// A cell, and a way in which a surface faces there.
    struct Place {
        const std::uint64_t* bits = nullptr; ///< Of its brick; null if there is none.
        std::uint32_t cell = 0;              ///< In the brick, 0 to 63.
    };

    /// Whether nothing is known anywhere.
    [[nodiscard]] bool empty() const noexcept { return known.bits.empty(); }
    /// The length of the smallest cells, in scene units.
    [[nodiscard]] T radius() const noexcept { return known.cells.length; }
    /// The memory that it takes.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return known.table.bytes() + known.bits.size() * sizeof(known.bits[0]);
    }

    /// Where to look for what is known of a point: one search for all lights.
    /// \param point  Of a surface.
    /// \param side   Which side of it: +1 if the normal points to it, else -1.
    /// \cost Some ten nanoseconds.
    // [place_of]
    [[nodiscard]] Place place_of(const SurfacePointT<T>& point,
                                 int side) const noexcept {
        if (empty()) return {};
        const int way = detail::facing(point.normal, side);
        const auto at = known.cells.cell_of(point.position, way);
        if (!at) return {};
        const std::uint32_t brick = known.table.find(detail::brick_key(*at));
        if (brick == detail::BrickTable::none) return {};
        return {&known.bits[brick * known.stride()], at->in_brick()};
    }

    /// What is known of a light there.
    [[nodiscard]] Verdict verdict(const Place& at, std::size_t light) const noexcept {
        if (at.bits == nullptr) return Verdict::unknown;
        const std::uint64_t lit = at.bits[2 * light] >> at.cell & 1;
        const std::uint64_t shadow = at.bits[2 * light + 1] >> at.cell & 1;
        return static_cast<Verdict>(lit + 2 * shadow); // no branch to mispredict
    }
    // [place_of]

    /// Whether an indirect photon lies in the cell or next to it; true if none was
    /// looked for.
    [[nodiscard]] bool indirect_near(const Place& at) const noexcept {
        if (!dark_known) return true;
        return at.bits != nullptr && (at.bits[2 * known.lights] >> at.cell & 1) != 0;
    }
};
using VerdictGrid = VerdictGridT<float>; ///< VerdictGridT in float.

namespace detail {

/// What a grid knows of the lights at a vertex: what sample_all_lights() asks.
template <std::floating_point T>
struct VerdictsAtT {
    const VerdictGridT<T>& grid;        ///< Which grid.
    typename VerdictGridT<T>::Place at; ///< The place of the vertex in it.

    /// Of the light with this number.
    [[nodiscard]] Verdict operator()(std::size_t light) const noexcept {
        return grid.verdict(at, light);
    }
};

/// Where a vertex is in a grid, seen from the side of `wo`.
template <std::floating_point T>
[[nodiscard]] auto place_of(const VerdictGridT<T>& grid,
                            const VertexT<T>& vertex) noexcept {
    return grid.place_of(vertex.point, vertex.wo.z < T(0) ? -1 : 1);
}

/// What a grid knows at a vertex.
/// \param grid    It may be empty; must outlive what is returned.
/// \param vertex  The place.
template <std::floating_point T>
[[nodiscard]] VerdictsAtT<T> verdicts_at(const VerdictGridT<T>& grid,
                                         const VertexT<T>& vertex) noexcept {
    return {grid, place_of(grid, vertex)};
}

/// Whether a vertex sends no indirect ray, because no indirect photon is near.
/// \param grid    It may be empty.
/// \param vertex  The place.
/// \param counts  Counts the ray that is not sent.
template <std::floating_point T>
[[nodiscard]] bool skips_bounce(const VerdictGridT<T>& grid, const VertexT<T>& vertex,
                                Counts& counts) noexcept {
    if (!grid.dark_known || grid.indirect_near(place_of(grid, vertex))) return false;
    ++counts.skipped_bounces;
    return true;
}

/// Where nothing is known, asks a coarser grid: all that is near by the finer one is
/// near by the coarser one too, so that a cell with photons of both kinds stays
/// unknown.
/// \param fine    Gets the verdicts.
/// \param coarse  With cells twice as large, or four times.
// [fill_from]
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
// [fill_from]

/// By the report's rule what is said of one light is said of all.
template <std::floating_point T>
void copy_to_all_lights(VerdictBitsT<T>& grid) {
    for (std::size_t b = 0; b < grid.bits.size(); b += grid.stride())
        for (std::size_t i = 2; i < 2 * grid.lights; ++i)
            grid.bits[b + i] = grid.bits[b + i % 2];
}

} // namespace detail

/// Works out the verdicts.
/// \param photons  Direct and shadow ones count, and indirect ones if they are asked
///                 for; a photon without a normal says nothing.
/// \param lights   How many lights the scene has.
/// \param skip     The rule and the radius.
/// \param threads  As in ParallelSettings.
/// \return The grid, the same for any number of threads; empty for SkipRule::none
///         without indirect rays, or without photons.
/// \throws std::invalid_argument  if a setting is out of range.
// [make_verdict_grid]
template <std::floating_point T>
[[nodiscard]] VerdictGridT<T>
make_verdict_grid(const std::vector<PhotonT<T>>& photons, std::size_t lights,
                  const SkipSettings& skip, int threads = 0) {
    check(skip);
    VerdictGridT<T> grid{.dark_known = skip.indirect_rays};
    if (photons.empty() || (skip.rule == SkipRule::none && !skip.indirect_rays))
        return grid;
    BoxT<T> box;
    for (const PhotonT<T>& photon : photons) box = box_union(box, photon.position);
    const T length = detail::cell_length(photons, box, lights, skip);
    if (!(length > 0)) return grid; // all photons in one point
    // Half a cell off: walls along the axes lie in the middle of the smallest cells.
    const Vec3T<T> corner = box.low - T(32.5) * length;
    grid.known = detail::make_bits(photons, {corner, length}, lights, skip, threads);
    SkipSettings coarse = skip; // of the indirect photons only the nearest count
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
// [make_verdict_grid]

/// \}

} // namespace ljus
