#pragma once

/// \file ljus/path/shutter.hpp
/// \brief A scene at one moment while the shutter is open.

#include "ljus/geometry/moving.hpp"
#include "ljus/path/thin_surfaces.hpp"

namespace ljus {

/// \defgroup shutter The shutter
/// \brief Section 2.1, distributed rays: each camera ray has a time of its own, and
/// sees the scene as it is then \cite cook1984. Chapter: \ref ch_distributed_rays.
/// \{

/// Whether a type of scene lists a shape that moves.
template <typename S>
inline constexpr bool lists_moving = false;
/// Of a scene: whether one of its shapes does.
template <typename... G, typename M>
inline constexpr bool lists_moving<Scene<Shapes<G...>, M>> = (is_moving<G> || ...);
/// Of an indexed scene: what its scene says.
template <typename S, typename Compute>
inline constexpr bool lists_moving<IndexedScene<S, Compute>> = lists_moving<S>;

/// An indexed scene at one time. It stands for the scene wherever one is asked for, and
/// costs two references and a number: the boxes of the index hold what moves at all
/// times, and only a shape that is asked is put where it is.
/// \tparam S  An IndexedScene.
template <typename S>
struct SceneAt {
    using Scalar = typename S::Scalar; ///< The precision.

    const S& scene; ///< What there is.
    Scalar time;    ///< In [0, 1]: from when the shutter opens to when it closes.
    const decltype(S::lights)& lights = scene.lights; ///< As the scene has them.

    /// As the scene does.
    [[nodiscard]] const ObjectT<Scalar>& object(ObjectId id) const noexcept {
        return scene.object(id);
    }
    /// Calls f(shape) with the shape where it is at this time.
    template <typename F>
    auto visit_shape(ObjectId id, F&& f) const {
        return scene.visit_shape(
            id, [&](const auto& shape) { return f(at_time(shape, time)); });
    }
    /// As the scene does.
    template <typename F>
    decltype(auto) visit_material(MaterialId id, F&& f) const {
        return scene.visit_material(id, f);
    }
};

/// A scene in which something moves, at one time.
/// \param scene  The scene; must outlive the result.
/// \param time   In [0, 1].
/// \return The scene at that time.
// [scene at_time]
template <typename S, typename Compute, std::floating_point T>
requires lists_moving<S>
[[nodiscard]] SceneAt<IndexedScene<S, Compute>>
at_time(const IndexedScene<S, Compute>& scene, T time) noexcept {
    return {scene, time};
}

/// A scene in which nothing can move is the same at all times: itself.
template <typename S, typename Compute, std::floating_point T>
requires(!lists_moving<S>) [[nodiscard]] const IndexedScene<S, Compute>& at_time(
    const IndexedScene<S, Compute>& scene, T) noexcept {
    return scene;
}
// [scene at_time]

/// The first object that a ray meets at the scene's time.
/// \param at   The scene and the time.
/// \param ray  Hits count in [t_min, t_max].
/// \return The nearest hit; nothing for a miss.
// [closest_hit]
template <typename S, typename Compute, std::floating_point T>
[[nodiscard]] std::optional<SceneHitT<T>>
closest_hit(const SceneAt<IndexedScene<S, Compute>>& at, RayT<T> ray) {
    NearestHitT<T> nearest;
    ObjectId object;
    const auto ask = [&](ObjectId id, std::uint32_t order, RayT<T>& rest) {
        const auto hit = at.visit_shape(
            id, [&](const auto& shape) { return hit_of<Compute>(rest, shape); });
        if (hit && nearest.offer(*hit, order, rest)) object = id;
    };
    const auto& index = at.scene;
    if (index.ids.empty()) { // too few shapes for a tree
        std::uint32_t order = 0;
        for (std::uint32_t type = 0; type < index.objects.size(); ++type)
            for (std::uint32_t i = 0; i < index.objects[type].size(); ++i)
                ask({type, i}, order++, ray);
    } else {
        index.tree.closest(ray, [&](std::uint32_t place, RayT<T>& rest) {
            ask(index.ids[place], index.tree.primitive_ids()[place], rest);
        });
    }
    if (!nearest.found) return std::nullopt;
    return SceneHitT<T>{nearest.at, object};
}
// [closest_hit]

/// Whether anything lies on a ray at the scene's time.
/// \param at   The scene and the time.
/// \param ray  Hits count in [t_min, t_max].
/// \return True for any hit.
template <typename S, typename Compute, std::floating_point T>
[[nodiscard]] bool occluded(const SceneAt<IndexedScene<S, Compute>>& at,
                            const RayT<T>& ray) {
    if (at.scene.ids.empty()) return closest_hit(at, ray).has_value();
    return at.scene.tree.any(ray, [&](std::uint32_t place) {
        return at.visit_shape(at.scene.ids[place], [&](const auto& shape) {
            return hit_of<Compute>(ray, shape).has_value();
        });
    });
}

/// Of a scene at a time: what the scene says.
template <typename S>
inline constexpr bool lists_thin_surfaces<SceneAt<S>> = lists_thin_surfaces<S>;
/// Whether the scene has a thin sheet among its materials.
/// \param at  The scene and the time.
/// \return What has_thin_surfaces() of the scene says.
template <typename S>
[[nodiscard]] bool has_thin_surfaces(const SceneAt<S>& at) noexcept {
    return has_thin_surfaces(at.scene);
}

/// \}

} // namespace ljus
