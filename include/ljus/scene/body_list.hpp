#pragma once

/// \file ljus/scene/body_list.hpp
/// \brief The transparent bodies around a point, in order of priority.

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "ljus/scene/scene.hpp"

namespace ljus {

/// \addtogroup nested_bodies
/// \{

/// The bodies around a point, by the ranks of their materials; a material stands here
/// once for each of its bodies. Of more than eight bodies those of the highest ranks
/// are kept. \cite schmidt2002
struct BodyList {
    std::array<std::uint8_t, 8> ranks{}; ///< Falling; 0 after the last one.

    /// The rank of the body whose medium holds; 0 outside all bodies.
    [[nodiscard]] constexpr std::uint8_t top() const noexcept { return ranks[0]; }
    /// Whether a body of a material is in the list.
    [[nodiscard]] constexpr bool has(std::uint8_t rank) const noexcept {
        return std::find(ranks.begin(), ranks.end(), rank) != ranks.end();
    }
    /// The list with one body more.
    [[nodiscard]] constexpr BodyList with(std::uint8_t rank) const noexcept {
        BodyList list = *this;
        for (std::uint8_t& place : list.ranks)
            if (rank > place) std::swap(rank, place);
        return list;
    }
    /// The list with one body less; the same list if it is not there.
    [[nodiscard]] constexpr BodyList without(std::uint8_t rank) const noexcept {
        BodyList list = *this;
        const auto at = std::find(list.ranks.begin(), list.ranks.end(), rank);
        if (at == list.ranks.end()) return list;
        std::copy(at + 1, list.ranks.end(), at);
        list.ranks.back() = 0;
        return list;
    }
    /// Whether both hold the same bodies.
    friend bool operator==(const BodyList&, const BodyList&) = default;
};

/// The order of the transparent materials of a scene: by priority, and among equal ones
/// by index of refraction.
struct BodyRanks {
    std::vector<MaterialId> materials{}; ///< The material of rank r is at r - 1.
    std::vector<std::vector<std::uint8_t>>
        ranks{};              ///< By type and index of a material; 0 for opaque ones.
    bool prioritized = false; ///< Whether any material has a priority other than 0.
};

/// \}

} // namespace ljus
