#pragma once

/// \file ljus/photons/photon_map.hpp
/// \brief Photons in a k-d tree.

#include <array>
#include <cmath>

#include "ljus/accel/kd_tree8.hpp"
#include "ljus/photons/detail/photon_records.hpp"

namespace ljus {

/// \defgroup photon_map Photon maps
/// \brief Sections 3.2.2 and 3.2.6 of the report: the general map and the caustics map.
/// \{

/// Photons in a k-d tree: a general map or a caustics map.
template <std::floating_point T>
struct PhotonMapT {
    KdTree8T<T> tree;                  ///< The positions.
    detail::PhotonRecordsT<T> records; ///< The other data, in the tree's order.

    /// Whether the map has no photons.
    [[nodiscard]] bool empty() const noexcept { return records.empty(); }
};
using PhotonMap = PhotonMapT<float>; ///< PhotonMapT in float.

namespace detail {

template <std::floating_point T>
using PhotonPartsT = std::vector<std::vector<PhotonT<T>>>;

/// Whether a direction has length 1, within 0.5 percent.
template <std::floating_point T>
[[nodiscard]] bool is_unit_direction(const Vec3T<T>& direction) noexcept {
    return std::abs(glm::dot(direction, direction) - T(1)) <= T(0.01);
}

/// Builds a map of `count` photons; each(add) must call add(photon) for each of them.
template <std::floating_point T, typename Each>
[[nodiscard]] PhotonMapT<T> map_of(std::size_t count, const Each& each, int threads) {
    require_point_count(count);
    RecordSorterT<T> records;
    KdTree8ItemsT<T> items;
    each([&](const PhotonT<T>& photon) {
        // A photon with the direction (0, 0, 0) would arrive on no side of a surface.
        require_finite("photon.flux", photon.flux);
        require(is_unit_direction(photon.direction), "photon.direction",
                photon.direction, "a vector of length 1");
        items.add(photon.position);
        records.add(photon);
    });
    KdTree8T<T> tree(std::move(items), threads);
    auto sorted = records.sorted(tree.point_ids(), threads);
    return {std::move(tree), std::move(sorted)};
}

/// Builds a map, and frees the given lists during the construction.
/// \cost At most 60 bytes per photon in float at any time, including the given photons,
///       on systems where std::realloc() moves pages without copying.
template <std::floating_point T>
[[nodiscard]] PhotonMapT<T> map_of_parts(PhotonPartsT<T> parts, int threads = 0) {
    std::size_t count = 0;
    for (const auto& part : parts) count += part.size();
    const auto each = [&](const auto& add) {
        std::size_t freed = 0;
        for (auto& part : parts) {
            for (const PhotonT<T>& photon : part) add(photon);
            freed += part.size();
            std::vector<PhotonT<T>>().swap(part);
            if (freed < 1 << 16) continue;
            freed = 0;
            give_back_memory();
        }
    };
    return map_of<T>(count, each, threads);
}

} // namespace detail

/// Builds a map.
/// \param photons  The photons, in any order.
/// \param threads  As in ParallelSettings.
/// \return The map, the same for any number of threads.
/// \throws std::invalid_argument  if a position or a flux is not finite, or if the
///         length of a direction differs from 1 by more than 0.5 percent.
template <std::floating_point T>
[[nodiscard]] PhotonMapT<T> make_photon_map(const std::vector<PhotonT<T>>& photons,
                                            int threads = 0) {
    const auto each = [&](const auto& add) {
        for (const PhotonT<T>& photon : photons) add(photon);
    };
    return detail::map_of<T>(photons.size(), each, threads);
}

/// The geometric mean of the radii of discs, around photons of a map, that contain a
/// given number of photons.
/// \param tree   The positions of the photons.
/// \param count  Number of photons in a disc, 1 to 511.
/// \param most   The largest number of discs, above 0.
/// \return In scene units; 1 if there are no photons, or if all lie at one point.
template <std::floating_point T>
[[nodiscard, gnu::cold]] T typical_radius(const KdTree8T<T>& tree, std::size_t count,
                                          std::size_t most = 255) {
    std::array<Neighbor, 512> room;
    const std::span<Neighbor> found(room.data(), count + 1); // with the photon itself
    const std::size_t step = tree.size() / most + 1;
    double logarithms = 0, photons = 0;
    for (std::size_t i = 0; i < tree.size(); i += step) {
        const std::size_t near = tree.template nearest<512>(
            tree.point(i), std::numeric_limits<T>::infinity(), found);
        if (near < 2 || !(found[0].distance2 > 0)) continue;
        logarithms += std::log(found[0].distance2) / 2;
        ++photons;
    }
    return photons > 0 ? static_cast<T>(std::exp(logarithms / photons)) : T(1);
}

/// The same for the photons of a map.
template <std::floating_point T>
[[nodiscard]] T typical_radius(const PhotonMapT<T>& map, std::size_t count,
                               std::size_t most = 255) {
    return typical_radius(map.tree, count, most);
}

/// \}

} // namespace ljus
