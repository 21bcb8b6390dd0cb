#pragma once

/// \file ljus/scene/object.hpp
/// \brief The numbers by which a scene knows its shapes and materials.

#include <cstdint>
#include <type_traits>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup object Objects
/// \brief A shape becomes an object of a scene by what it is made of.
/// \{

/// The place of a material: which of the scene's material types, and where in its
/// array.
struct MaterialId {
    std::uint32_t type = 0;  ///< Place in Materials<...>.
    std::uint32_t index = 0; ///< Place in that type's array.
    /// Whether both name the same material.
    friend bool operator==(const MaterialId&, const MaterialId&) = default;
};

/// The place of a shape: which of the scene's shape types, and where in its array.
struct ObjectId {
    std::uint32_t type = 0;  ///< Place in Shapes<...>.
    std::uint32_t index = 0; ///< Place in that type's array.
    /// Whether both name the same shape.
    friend bool operator==(const ObjectId&, const ObjectId&) = default;
};

namespace detail {

/// The light number of an object that is no light.
inline constexpr std::uint32_t no_light = 0xffffffffu;

/// The place of a type in a list; of the last one, no matter which it is.
template <typename X, typename First, typename... List>
inline constexpr std::uint32_t type_number = 0;
/// There is more than one left.
template <typename X, typename First, typename Second, typename... List>
inline constexpr std::uint32_t type_number<X, First, Second, List...> =
    std::is_same_v<X, First> ? 0 : 1 + type_number<X, Second, List...>;

/// Whether no type is listed twice.
template <typename... T>
inline constexpr bool each_once = true;
/// The first is not among the rest, and neither is any of them listed twice.
template <typename First, typename... T>
inline constexpr bool each_once<First, T...> =
    !(std::is_same_v<First, T> || ...) && each_once<T...>;

/// What a scene knows of a shape besides its geometry.
template <std::floating_point T>
struct ObjectT {
    MaterialId material{};   ///< What it is made of.
    RgbT<T> emission{T(0)};  ///< Radiance along the normal's side, W/(m^2 sr).
    bool inside_out = false; ///< The normal points inwards: a room made of a sphere.
    std::uint32_t light = no_light; ///< Its number among the lights, if it emits.
};

} // namespace detail

/// \}

} // namespace ljus
