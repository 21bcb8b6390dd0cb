#pragma once

/// \file ljus/inspect/census.hpp
/// \brief The number and the flux of the photons of each kind in a map.

#include <array>
#include <cstddef>
#include <cstdint>

#include "ljus/photons/photon_map.hpp"

namespace ljus {

/// \defgroup census The census of a photon map
/// \brief Numbers of photons, as in figures 5 to 8 in Section 3.2.2.1 of the report.
/// \{

/// The number and the flux of the photons of one kind.
struct PhotonCount {
    std::uint64_t photons = 0; ///< Number of photons.
    /// Sum of the flux of these photons, in W; for shadow photons, the flux that the
    /// shadow lacks.
    RgbT<double> flux{0};
};

/// The number and the flux of the photons of a map, by kind.
struct PhotonCensus {
    std::array<PhotonCount, 5> kinds; ///< The counts, indexed by PhotonKind.

    /// The number and the flux of the photons of one kind.
    [[nodiscard]] const PhotonCount& operator[](PhotonKind kind) const noexcept {
        return kinds[static_cast<std::size_t>(kind)];
    }

    /// The number and the flux of the direct, caustic and indirect photons together.
    [[nodiscard]] PhotonCount light() const noexcept {
        PhotonCount sum;
        for (const PhotonKind kind :
             {PhotonKind::direct, PhotonKind::caustic, PhotonKind::indirect}) {
            sum.photons += (*this)[kind].photons;
            sum.flux += (*this)[kind].flux;
        }
        return sum;
    }
};

/// The name of a kind for tables, one word.
[[nodiscard]] constexpr const char* name_of(PhotonKind kind) noexcept {
    constexpr std::array<const char*, 5> names{"direct", "caustic", "indirect",
                                               "shadow", "fog"};
    return names[static_cast<std::size_t>(kind)];
}

/// Counts the photons of any list with operator[] and size() whose elements have a kind
/// and a flux.
template <typename Photons>
requires requires(const Photons& p) {
    { p[p.size() - 1].kind } -> std::convertible_to<PhotonKind>;
}
[[nodiscard]] PhotonCensus census(const Photons& photons) {
    PhotonCensus result;
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const auto& photon = photons[i];
        PhotonCount& count = result.kinds[static_cast<std::size_t>(photon.kind)];
        ++count.photons;
        count.flux += RgbT<double>(photon.flux);
    }
    return result;
}

/// Counts the photons of a map, by kind.
template <std::floating_point T>
[[nodiscard]] PhotonCensus census(const PhotonMapT<T>& map) {
    return census(map.records);
}

/// \}

} // namespace ljus
