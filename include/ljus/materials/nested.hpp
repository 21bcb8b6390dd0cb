#pragma once

/// \file ljus/materials/nested.hpp
/// \brief A transparent material with a priority, for bodies that overlap.

#include "ljus/materials/textured.hpp"

namespace ljus {

/// \addtogroup nested_bodies
/// \{

/// The priority of a Nested material.
struct Priority {
    /// Where bodies overlap, the body with the highest priority fills the space. A
    /// material that is not Nested has priority 0.
    int number = 0;
};

/// Glass, rough glass or another transparent material with a priority, for bodies that
/// overlap other bodies. A material with holes must be opaque, and needs no priority.
///
///     const auto glass = scene.add(Nested<Glass>{{.index = 1.5f}, {2}});
///     const auto water = scene.add(Nested<Glass>{{.index = 1.33f}, {1}});
/// \cite schmidt2002
template <Material Base>
requires Transparent<Base>
using Nested = Textured<Base, Priority>;

/// The priority where bodies overlap.
template <typename Base>
[[nodiscard]] constexpr int priority(const Textured<Base, Priority>& nested) noexcept {
    return nested.texture.number;
}

/// Every priority is allowed.
inline void check(const Priority&) noexcept {}

/// \}

} // namespace ljus
