#pragma once

/// \file ljus/materials/nested.hpp
/// \brief A transparent material with a priority, for bodies that overlap.

#include "ljus/image/texture.hpp"
#include "ljus/materials/material.hpp"

namespace ljus {

/// \addtogroup nested_bodies
/// \{

/// Glass, rough glass or another transparent material with a priority, for bodies that
/// overlap other bodies.
///
///     const auto glass = scene.add(Nested<Glass>{{.index = 1.5f}, 2});
///     const auto water = scene.add(Nested<Glass>{{.index = 1.33f}, 1});
/// \cite schmidt2002
template <Material Base>
requires Transparent<Base>
struct Nested {
    static_assert(!CutOutMaterial<Base>,
                  "A material with holes must be opaque, and needs no priority.");
    using Scalar = typename Base::Scalar;          ///< The precision of its numbers.
    static constexpr bool scatters_as_base = true; ///< Scattering is that of the base.
    static constexpr bool uses_uv = UsesUv<Base>;  ///< True if the base uses uv.
    Base base{};                                   ///< The material.
    /// Where bodies overlap, the body with the highest priority fills the space. A
    /// material that is not Nested has priority 0.
    int priority = 0;
};

/// The base at a point; see material_at().
template <typename Base, std::floating_point T>
[[nodiscard]] constexpr decltype(auto) at_point(const Nested<Base>& nested,
                                                const Vec3T<T>& position,
                                                const Vec2T<T>& uv) noexcept {
    return material_at(nested.base, position, uv);
}

/// The priority where bodies overlap.
template <typename Base>
[[nodiscard]] constexpr int priority(const Nested<Base>& nested) noexcept {
    return nested.priority;
}

/// \name Functions of the base
/// \{

/// The reflected and the refracted sample of the base, for a path that splits.
template <typename Base, std::floating_point T>
[[nodiscard]] auto split(const Nested<Base>& nested, const Vec3T<T>& wo,
                         Transport transport) noexcept
    -> decltype(split(nested.base, wo, transport)) {
    return split(nested.base, wo, transport);
}

/// The index of refraction inside; 0 if the base is opaque.
template <Refractive Base>
[[nodiscard]] constexpr auto refractive_index(const Nested<Base>& nested) noexcept {
    return refractive_index(nested.base);
}

/// The base at one wavelength, if it disperses light.
template <Dispersive Base, std::floating_point T>
[[nodiscard]] constexpr auto at_wavelength(const Nested<Base>& nested, T nm) noexcept {
    return at_wavelength(nested.base, nm);
}

/// The absorption coefficient inside, per scene unit.
template <typename Base>
[[nodiscard]] constexpr RgbT<typename Base::Scalar>
absorption(const Nested<Base>& nested) noexcept {
    return absorption(nested.base);
}

/// The shading normal of a base with a normal map.
template <NormalMapped Base, std::floating_point T>
[[nodiscard]] Vec3T<T> normal_at(const Nested<Base>& nested,
                                 const Vec2T<T>& uv) noexcept {
    return normal_at(nested.base, uv);
}

/// The emitted radiance of the base, in W/(m^2 sr).
template <typename Base>
[[nodiscard]] constexpr RgbT<typename Base::Scalar>
emission(const Nested<Base>& nested) noexcept {
    return emission(nested.base);
}

/// Checks the base.
template <typename Base>
void check(const Nested<Base>& nested) {
    check(nested.base);
}

/// \}

/// \}

} // namespace ljus
