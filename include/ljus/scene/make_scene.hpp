#pragma once

/// \file ljus/scene/make_scene.hpp
/// \brief A scene in one expression, its lists of types deduced.

#include <type_traits>

#include "ljus/scene/scene.hpp"

namespace ljus {

/// \defgroup make_scene Scenes in one expression
/// \brief For small scenes in code, where spelling out the lists of types is a burden.
///
///     const World world(make_scene(
///         placed(Sphere{.center{0, 1, 0}}, Glass{}),
///         placed(Quad{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, Lambertian{}),
///         placed(Quad{{-1, 4, -1}, {2, 0, 0}, {0, 0, 2}}, Lambertian{}, Rgb{10}),
///         PointLight{.position{0, 3, 3}}));
///
/// closes a `Scene<Shapes<Sphere, Quad>, Materials<Glass, Lambertian>,
/// Lights<PointLight>>`.
/// \{

/// A shape and what it is made of, on its way into a scene.
template <Shape S, Material M>
struct Placed {
    S shape;                       ///< The shape.
    M material;                    ///< What it is made of.
    RgbT<ScalarOf<S>> emission{0}; ///< Radiance along the normal, W/(m^2 sr).
    bool inside_out = false;       ///< Whether the normal points inwards.
};

/// A shape, made of a material.
/// \param shape       Any shape.
/// \param material    Any material.
/// \param emission    The radiance it emits along its normal's side, W/(m^2 sr).
/// \param inside_out  Whether the normal points inwards.
/// \return A part for make_scene().
template <Shape S, Material M>
[[nodiscard]] Placed<S, M>
placed(const S& shape, const M& material,
       const std::type_identity_t<RgbT<ScalarOf<S>>>& emission = RgbT<ScalarOf<S>>{0},
       bool inside_out = false) {
    return {shape, material, emission, inside_out};
}

namespace detail {

/// Types in order of first appearance.
template <typename... T>
struct TypeList {};

/// A list with one more type, unless it holds the type already.
template <typename... T, typename Next>
[[nodiscard]] constexpr auto operator+(TypeList<T...>, TypeList<Next>) noexcept {
    if constexpr ((std::is_same_v<T, Next> || ...))
        return TypeList<T...>{};
    else
        return TypeList<T..., Next>{};
}

/// A list with nothing added: a point light has neither shape nor material.
template <typename... T>
[[nodiscard]] constexpr TypeList<T...> operator+(TypeList<T...>, TypeList<>) noexcept {
    return {};
}

/// What one part adds to the lists; placed() shapes and lights are parts.
template <typename Part>
struct PartOf;

/// \copydoc PartOf
template <typename S, typename M>
struct PartOf<Placed<S, M>> {
    using Shape = TypeList<S>;    ///< Its shape.
    using Material = TypeList<M>; ///< Its material.
    using Light = TypeList<>;     ///< None.
};

/// \copydoc PartOf
template <LightSource L>
struct PartOf<L> {
    using Shape = TypeList<>;    ///< None.
    using Material = TypeList<>; ///< None.
    using Light = TypeList<L>;   ///< Its own type.
};

/// Adds a part to a scene that lists its types.
/// \param scene  The scene.
/// \param part   A placed() shape.
template <typename Scene, typename S, typename M>
void add_part(Scene& scene, const Placed<S, M>& part) {
    scene.add(part.shape, scene.add(part.material), part.emission, part.inside_out);
}

/// Adds a light that is no object to a scene.
/// \param scene  The scene.
/// \param light  The light.
template <typename Scene, LightSource Light>
void add_part(Scene& scene, const Light& light) {
    scene.add(light);
}

/// What make_scene() takes: placed() shapes and lights.
template <typename Part>
concept ScenePart = requires {
    typename PartOf<Part>::Shape;
};

/// A part with a shape; a scene needs one for its precision.
template <typename Part>
concept PlacedPart =
    ScenePart<Part> && !std::is_same_v<typename PartOf<Part>::Shape, TypeList<>>;

/// The scene of three lists.
template <typename... S, typename... M, typename... L>
[[nodiscard]] Scene<Shapes<S...>, Materials<M...>, Lights<L...>>
scene_of(TypeList<S...>, TypeList<M...>, TypeList<L...>) {
    return {};
}

} // namespace detail

/// A scene of these parts, added in their order; each type is listed where it first
/// appears. Each placed() shape has a material of its own: to share one, use
/// Scene::add().
/// \param parts  placed() shapes, at least one, and lights; of one precision.
/// \return The scene.
/// \throws std::invalid_argument  as Scene::add().
template <detail::ScenePart... Part>
requires(detail::PlacedPart<Part> || ...)
    [[nodiscard]] auto make_scene(const Part&... parts) {
    auto scene = detail::scene_of(
        (detail::TypeList<>{} + ... + typename detail::PartOf<Part>::Shape{}),
        (detail::TypeList<>{} + ... + typename detail::PartOf<Part>::Material{}),
        (detail::TypeList<>{} + ... + typename detail::PartOf<Part>::Light{}));
    (detail::add_part(scene, parts), ...);
    return scene;
}

/// \}

} // namespace ljus
