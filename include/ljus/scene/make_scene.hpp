#pragma once

/// \file ljus/scene/make_scene.hpp
/// \brief Makes a scene in one expression, and deduces its lists of types.

#include <type_traits>

#include "ljus/scene/scene.hpp"

namespace ljus {

/// \defgroup make_scene Scenes in one expression
/// \brief Small scenes in code, without writing the lists of types.
///
///     const World world(make_scene(
///         placed(Sphere{.center{0, 1, 0}}, Glass{}),
///         placed(Quad{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, Lambertian{}),
///         placed(Quad{{-1, 4, -1}, {2, 0, 0}, {0, 0, 2}}, Lambertian{}, Rgb{10}),
///         PointLight{.position{0, 3, 3}}));
///
/// This makes a World of a `Scene<Shapes<Sphere, Quad>, Materials<Glass, Lambertian>,
/// Lights<PointLight>>`.
/// \{

/// A shape with its material and emission, as an argument of make_scene().
template <Shape S, Material M>
struct Placed {
    S shape;                       ///< The shape.
    M material;                    ///< The material.
    RgbT<ScalarOf<S>> emission{0}; ///< Radiance along the normal, in W/(m^2 sr).
    bool inside_out = false;       ///< Whether the normal points inwards.
};

/// Pairs a shape with its material and emission, for make_scene(); see Placed.
template <Shape S, Material M>
[[nodiscard]] Placed<S, M>
placed(const S& shape, const M& material,
       const std::type_identity_t<RgbT<ScalarOf<S>>>& emission = RgbT<ScalarOf<S>>{0},
       bool inside_out = false) {
    return {shape, material, emission, inside_out};
}

namespace detail {

/// A list of types.
template <typename... T>
struct TypeList {};

/// A list with one more type, unless the list already contains the type.
template <typename... T, typename Next>
[[nodiscard]] constexpr auto operator+(TypeList<T...>, TypeList<Next>) noexcept {
    if constexpr ((std::is_same_v<T, Next> || ...))
        return TypeList<T...>{};
    else
        return TypeList<T..., Next>{};
}

/// A list plus an empty list.
template <typename... T>
[[nodiscard]] constexpr TypeList<T...> operator+(TypeList<T...>, TypeList<>) noexcept {
    return {};
}

/// The types that an argument of make_scene() adds to the lists.
template <typename Part>
struct PartOf;

template <typename S, typename M>
struct PartOf<Placed<S, M>> {
    using Shape = TypeList<S>;
    using Material = TypeList<M>;
    using Light = TypeList<>;
};

template <LightSource L>
struct PartOf<L> {
    using Shape = TypeList<>;
    using Material = TypeList<>;
    using Light = TypeList<L>;
};

/// An argument of make_scene(): a placed() shape or a light.
template <typename Part>
concept ScenePart = requires {
    typename PartOf<Part>::Shape;
};

/// An argument with a shape. A scene needs at least one shape, because the shapes
/// determine the precision.
template <typename Part>
concept PlacedPart =
    ScenePart<Part> && !std::is_same_v<typename PartOf<Part>::Shape, TypeList<>>;

/// An empty scene with these lists of types.
template <typename... S, typename... M, typename... L>
[[nodiscard]] Scene<Shapes<S...>, Materials<M...>, Lights<L...>>
scene_of(TypeList<S...>, TypeList<M...>, TypeList<L...>) {
    return {};
}

} // namespace detail

/// Makes a scene of lights and at least one placed() shape, all of the same precision,
/// which are added in the order of the arguments. Types are listed in the order in
/// which they first occur. Each shape gets a material of its own; Scene::add() adds
/// shapes that share a material.
/// \throws std::invalid_argument  if a value is out of range.
template <detail::ScenePart... Part>
requires(detail::PlacedPart<Part> || ...)
    [[nodiscard]] auto make_scene(const Part&... parts) {
    auto scene = detail::scene_of(
        (detail::TypeList<>{} + ... + typename detail::PartOf<Part>::Shape{}),
        (detail::TypeList<>{} + ... + typename detail::PartOf<Part>::Material{}),
        (detail::TypeList<>{} + ... + typename detail::PartOf<Part>::Light{}));
    const auto add = [&scene]<typename P>(const P& part) {
        if constexpr (detail::PlacedPart<P>)
            scene.add(part.shape, scene.add(part.material), part.emission,
                      part.inside_out);
        else
            scene.add(part);
    };
    (add(parts), ...);
    return scene;
}

/// \}

} // namespace ljus
