#pragma once

/// \file ljus/materials/nested.hpp
/// \brief A transparent material with a priority, for bodies that overlap.

#include "ljus/materials/textured.hpp"

namespace ljus {

/// \addtogroup nested_bodies
/// \{

struct Priority; ///< Stands for the texture in the type Nested.

/// A material with a priority; see Nested.
template <Material Base>
struct Textured<Base, Priority> {
    using Scalar = typename Base::Scalar;          ///< The precision of its numbers.
    static constexpr bool scatters_as_base = true; ///< Scattering is that of the base.
    static constexpr bool uses_uv = UsesUv<Base>;  ///< True if the base uses uv.
    Base base{};                                   ///< The transparent material.
    /// Where bodies overlap, the body with the highest priority fills the space. A
    /// material that is not Nested has priority 0.
    int priority = 0;
};

/// Glass, rough glass or another transparent material with a priority, for bodies that
/// overlap other bodies. A material with holes must be opaque, and needs no priority.
///
///     const auto glass = scene.add(Nested<Glass>{{.index = 1.5f}, 2});
///     const auto water = scene.add(Nested<Glass>{{.index = 1.33f}, 1});
/// \cite schmidt2002
template <Material Base>
requires Transparent<Base>
using Nested = Textured<Base, Priority>;

/// The priority where bodies overlap.
template <typename Base>
[[nodiscard]] constexpr int priority(const Textured<Base, Priority>& nested) noexcept {
    return nested.priority;
}

/// Checks the base; every priority is allowed.
template <typename Base>
void check(const Textured<Base, Priority>& nested) {
    check(nested.base);
}

/// \}

} // namespace ljus
