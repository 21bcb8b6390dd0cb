#pragma once

/// \file ljus/scene/index.hpp
/// \brief A scene that knows where its shapes are: the fast way to the first hit.

#include "ljus/accel/bvh8.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/scene/query.hpp"

namespace ljus {

/// \defgroup index Indexed scenes
/// \brief Discussion: "an octree, axis-aligned bounding boxes, or a binary space
/// partition". Chapter: \ref ch_bvh.
/// \{

namespace detail {

/// The most shapes that are asked in turn; of more, a tree says which ones to ask.
/// In the report's room, cut down to its first 1, 2, 3, ... objects, the tree is no
/// slower than the loop from the third on (benchmarks/rays_room.cpp; \ref ch_bvh).
inline constexpr std::size_t flat_loop_limit = 2;

/// Whether a tree finds the first of so many shapes on a ray, or a loop over all.
/// \param shapes  How many.
[[nodiscard]] constexpr bool needs_tree(std::size_t shapes) noexcept {
    return shapes > flat_loop_limit;
}

/// A box around a shape of any type: its own bounds(), or those of its bounding sphere.
/// \param shape  The shape.
/// \return The box.
template <Shape S>
[[nodiscard]] auto box_around(const S& shape) {
    if constexpr (requires { bounds(shape); })
        return bounds(shape);
    else
        return bounds(bounding_sphere(shape));
}

/// Frames by the number of an object; of no use for a shape that is not flat.
template <typename S>
using FramesT = std::array<std::vector<FrameT<typename S::Scalar>>,
                           std::tuple_size_v<decltype(S::shapes)>>;

/// The frames of a scene's flat shapes: a normal takes a cross product in double and a
/// square root, which is worth doing once.
/// \param scene  The scene.
/// \return Around the normal that object() says is the outer one.
template <typename S>
[[nodiscard]] FramesT<S> frames_of(const S& scene) {
    FramesT<S> frames;
    std::size_t kind = 0;
    const auto add = [&](const auto& list) {
        if constexpr (is_plane<
                          typename std::remove_cvref_t<decltype(list)>::value_type>)
            for (std::size_t i = 0; i < list.size(); ++i) {
                const auto n = normal(list[i]);
                frames[kind].push_back(
                    frame_around(scene.objects[kind][i].inside_out ? -n : n));
            }
        ++kind;
    };
    std::apply([&](const auto&... lists) { (add(lists), ...); }, scene.shapes);
    return frames;
}

} // namespace detail

/// A scene with an index over all its shapes, of all types \cite rubin1980. It stands
/// for the scene wherever one is asked for, and refers to it: the scene must outlive
/// it, unchanged.
///
/// closest_hit() and occluded() give the same answers as for the scene itself, to the
/// last bit: the index leaves out what a ray cannot meet, and asks the rest.
/// \tparam S        A Scene.
/// \tparam Compute  The arithmetic of all intersections, as intersect() has it.
template <typename S, typename Compute = void>
struct IndexedScene {
    using Scalar = typename S::Scalar; ///< The precision, from the shapes' types.
    /// The wide tree, which is made of floats, or the plain one.
    using Tree = std::conditional_t<std::is_same_v<Scalar, float>, Bvh8, BvhT<Scalar>>;

    /// Indexes a scene.
    /// \param of  Must outlive the index.
    IndexedScene(const S& of)
        : scene(of), shapes(of.shapes), objects(of.objects), materials(of.materials),
          lights(of.lights), frames(detail::frames_of(of)) {
        if (!detail::needs_tree(scene.size())) return;
        std::vector<BoxT<Scalar>> boxes(scene.size());
        std::vector<ObjectId> all(scene.size());
        std::uint32_t type = 0;
        std::size_t number = 0;
        const auto add = [&](const auto& list) {
            for (std::uint32_t i = 0; i < list.size(); ++i, ++number) {
                boxes[number] = detail::box_around(list[i]);
                all[number] = {type, i};
            }
            ++type;
        };
        std::apply([&](const auto&... lists) { (add(lists), ...); }, shapes);
        tree = Tree(boxes, {.leaf_size = 1});
        ids = std::vector<ObjectId>(scene.size());
        for (std::size_t slot = 0; slot < ids.size(); ++slot)
            ids[slot] = all[tree.primitive_ids()[slot]];
    }

    /// Not of a temporary: the scene would be gone before it is asked.
    IndexedScene(const S&&) = delete;

    const S& scene;                          ///< Which scene.
    const decltype(S::shapes)& shapes;       ///< As the scene has them.
    const decltype(S::objects)& objects;     ///< As the scene has them.
    const decltype(S::materials)& materials; ///< As the scene has them.
    const decltype(S::lights)& lights;       ///< As the scene has them.
    detail::FramesT<S> frames;   ///< Around the normals of what is flat, by object.
    Tree tree{};                 ///< Over all shapes, if there are many; else empty.
    std::vector<ObjectId> ids{}; ///< Of the shapes, in the tree's order; empty for the
                                 ///< flat loop.

    /// As the scene does.
    [[nodiscard]] const detail::ObjectT<Scalar>& object(ObjectId id) const noexcept {
        return scene.object(id);
    }
    /// As the scene does.
    template <typename F>
    decltype(auto) visit_shape(ObjectId id, F&& f) const {
        return scene.visit_shape(id, f);
    }
    /// As the scene does.
    template <typename F>
    decltype(auto) visit_material(MaterialId id, F&& f) const {
        return scene.visit_material(id, f);
    }
    /// As the scene does.
    [[nodiscard]] std::size_t size() const noexcept { return scene.size(); }
    /// As the scene does.
    template <typename F>
    [[nodiscard]] static constexpr bool any_shape(F f) noexcept {
        return S::any_shape(f);
    }
    /// As the scene does.
    template <typename F>
    [[nodiscard]] static constexpr bool any_material(F f) noexcept {
        return S::any_material(f);
    }
};

/// Indexes a scene, with a choice of arithmetic: `index_scene<double>(scene)`.
/// \param scene  Must outlive the index.
/// \return The index.
template <typename Compute = void, typename S>
[[nodiscard]] IndexedScene<S, Compute> index_scene(const S& scene) {
    return IndexedScene<S, Compute>(scene);
}
/// Not of a temporary: the scene would be gone before it is asked.
template <typename Compute = void, typename S>
IndexedScene<S, Compute> index_scene(const S&& scene) = delete;

namespace detail {

/// What a renderer keeps of the scene that it is given: an index of its own, or the one
/// that it was given.
template <typename S>
struct Indexed {
    using Type = IndexedScene<S>; ///< An index of its own.
};
/// A scene that is indexed already.
template <typename S, typename Compute>
struct Indexed<IndexedScene<S, Compute>> {
    using Type = const IndexedScene<S, Compute>&; ///< The one that it was given.
};
/// What a renderer keeps of the scene that it is given.
template <typename S>
using IndexedT = typename Indexed<S>::Type;

} // namespace detail

/// The first object that a ray meets, by the index.
/// \param scene  The scene.
/// \param ray    Hits count in [t_min, t_max].
/// \return As for the scene itself.
template <typename S, typename Compute, std::floating_point T>
[[nodiscard]] inline std::optional<SceneHitT<T>>
closest_hit(const IndexedScene<S, Compute>& scene, const RayT<T>& ray) {
    if (scene.ids.empty()) return closest_hit<Compute>(scene.scene, ray);
    NearestHitT<T> nearest;
    ObjectId object;
    scene.tree.closest(ray, [&](std::uint32_t slot, RayT<T>& rest) {
        const ObjectId id = scene.ids[slot];
        const auto hit = scene.scene.visit_shape(id, [&](const auto& shape) {
            return detail::hit_of<Compute>(rest, shape);
        });
        if (hit && nearest.offer(*hit, scene.tree.primitive_ids()[slot], rest))
            object = id;
    });
    if (!nearest.found) return std::nullopt;
    return SceneHitT<T>{nearest.at, object};
}

/// Whether anything lies on a ray, by the index.
/// \param scene  The scene.
/// \param ray    Hits count in [t_min, t_max].
/// \return As for the scene itself.
template <typename S, typename Compute, std::floating_point T>
[[nodiscard]] bool occluded(const IndexedScene<S, Compute>& scene, const RayT<T>& ray) {
    if (scene.ids.empty()) return occluded<Compute>(scene.scene, ray);
    return scene.tree.any(ray, [&](std::uint32_t slot) {
        return scene.scene.visit_shape(scene.ids[slot], [&](const auto& shape) {
            return detail::is_met<Compute>(ray, shape);
        });
    });
}

/// \}

} // namespace ljus
