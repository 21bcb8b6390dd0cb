#pragma once

/// \file ljus/scene/query.hpp
/// \brief What a ray meets first, and whether anything is in its way.

#include <optional>
#include <type_traits>

#include "ljus/scene/scene.hpp"

namespace ljus {

/// \defgroup query Scene queries
/// \brief Section 3.1: "determine the first object intersected by a ray".
/// \{

/// The first object that a ray meets.
template <std::floating_point T>
struct SceneHitT {
    FlatHitT<T> at{};  ///< Distance, and the shape's own coordinates.
    ObjectId object{}; ///< Which object.
};

namespace detail {

/// Where a ray meets a shape of any type, in the arithmetic that is asked for, if the
/// shape has a choice.
/// \tparam Compute  As for intersect().
/// \param ray    Hits count in [t_min, t_max].
/// \param shape  The shape.
/// \return The hit; nothing for a miss.
template <typename Compute, std::floating_point T, typename S>
[[nodiscard]] std::optional<FlatHitT<T>> hit_of(const RayT<T>& ray, const S& shape) {
    const auto ask = [&] {
        if constexpr (requires { intersect<Compute>(ray, shape); })
            return intersect<Compute>(ray, shape);
        else
            return intersect(ray, shape);
    };
    if constexpr (std::is_same_v<decltype(ask()), std::optional<FlatHitT<T>>>) {
        return ask(); // without a copy, which is slow enough to show
    } else {
        const auto hit = ask();
        if (!hit) return std::nullopt;
        return as_hit(*hit);
    }
}

/// Whether a ray meets a shape of any type: by the shape's own meets(), if it has one
/// that is done sooner than its intersect(), as a mesh has.
/// \tparam Compute  As for intersect().
/// \param ray    Hits count in [t_min, t_max].
/// \param shape  The shape.
/// \return Whether hit_of() would return a hit.
template <typename Compute, std::floating_point T, typename S>
[[nodiscard]] bool is_met(const RayT<T>& ray, const S& shape) {
    if constexpr (requires { meets<Compute>(ray, shape); })
        return meets<Compute>(ray, shape);
    else
        return hit_of<Compute>(ray, shape).has_value();
}

} // namespace detail

/// The first object that a ray meets, by asking every shape in turn: the exact twin of
/// the tree in an IndexedScene.
/// \tparam Compute  The arithmetic, as for intersect().
/// \param scene  The scene.
/// \param ray    Hits count in [t_min, t_max].
/// \return The nearest hit, the earlier object on a tie; nothing for a miss.
/// \cost One intersection a shape.
template <typename Compute = void, typename G, typename M, std::floating_point T>
[[nodiscard]] std::optional<SceneHitT<T>> closest_hit(const Scene<G, M>& scene,
                                                      RayT<T> ray) {
    std::optional<SceneHitT<T>> closest;
    std::uint32_t type = 0;
    const auto ask_all = [&](const auto& shapes) {
        for (std::uint32_t i = 0; i < shapes.size(); ++i) {
            const auto found = detail::hit_of<Compute>(ray, shapes[i]);
            if (!found || (closest && !(found->t < ray.t_max))) continue;
            ray.t_max = found->t;
            closest = SceneHitT<T>{*found, {type, i}};
        }
        ++type;
    };
    std::apply([&](const auto&... shapes) { (ask_all(shapes), ...); }, scene.shapes);
    return closest;
}

/// Whether anything lies on a ray: the question of a shadow ray.
/// \tparam Compute  The arithmetic, as for intersect().
/// \param scene  The scene.
/// \param ray    Hits count in [t_min, t_max].
/// \return True at the first hit found, whichever it is.
template <typename Compute = void, typename G, typename M, std::floating_point T>
[[nodiscard]] bool occluded(const Scene<G, M>& scene, const RayT<T>& ray) {
    const auto any = [&](const auto& shapes) {
        for (const auto& shape : shapes)
            if (detail::is_met<Compute>(ray, shape)) return true;
        return false;
    };
    return std::apply([&](const auto&... shapes) { return (any(shapes) || ...); },
                      scene.shapes);
}

/// What the renderers ask of a scene: a Scene, or one with an index over it.
template <typename S>
concept SceneLike = requires(const S& scene, const RayT<typename S::Scalar>& ray,
                             ObjectId object) {
    scene.lights;
    scene.materials;
    { scene.size() } -> std::same_as<std::size_t>;
    {
        scene.object(object)
        } -> std::same_as<const detail::ObjectT<typename S::Scalar>&>;
    {
        closest_hit(scene, ray)
        } -> std::same_as<std::optional<SceneHitT<typename S::Scalar>>>;
    { occluded(scene, ray) } -> std::same_as<bool>;
};

/// \}

} // namespace ljus
