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

/// The transparent bodies around a point, as a list of the ranks of their materials. A
/// rank occurs once for each body of its material. If there are more than eight bodies,
/// the eight of the highest ranks are kept. \cite schmidt2002
struct BodyList {
    std::array<std::uint8_t, 8> ranks{}; ///< The ranks in descending order, then zeros.

    /// The rank of the body whose medium counts; 0 outside all bodies.
    [[nodiscard]] constexpr std::uint8_t top() const noexcept { return ranks[0]; }
    /// Whether a body of the given rank is in the list.
    [[nodiscard]] constexpr bool has(std::uint8_t rank) const noexcept {
        return std::find(ranks.begin(), ranks.end(), rank) != ranks.end();
    }
    /// A copy of the list with one more body of the given rank.
    [[nodiscard]] constexpr BodyList with(std::uint8_t rank) const noexcept {
        BodyList list = *this;
        for (std::uint8_t& place : list.ranks)
            if (rank > place) std::swap(rank, place);
        return list;
    }
    /// A copy of the list without one body of the given rank, if there is one.
    [[nodiscard]] constexpr BodyList without(std::uint8_t rank) const noexcept {
        BodyList list = *this;
        const auto at = std::find(list.ranks.begin(), list.ranks.end(), rank);
        if (at == list.ranks.end()) return list;
        std::copy(at + 1, list.ranks.end(), at);
        list.ranks.back() = 0;
        return list;
    }
    /// Whether two lists contain the same bodies.
    friend bool operator==(const BodyList&, const BodyList&) = default;
};

/// The transparent materials of a scene in ascending order of priority. Materials of
/// the same priority are ordered by index of refraction, then by absorption.
struct BodyRanks {
    /// The materials. The material of rank r has the index r - 1.
    std::vector<MaterialId> materials{};
    /// The rank of each material, by type and index; 0 if opaque.
    std::vector<std::vector<std::uint8_t>> ranks{};
    bool prioritized = false; ///< Whether any material has a priority other than 0.
};

/// \}

} // namespace ljus
