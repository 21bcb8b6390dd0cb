#pragma once

/// \file ljus/scene/world.hpp
/// \brief The closed scene that renderers and photon passes take.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "ljus/accel/bvh8.hpp"
#include "ljus/accel/detail/stored_array.hpp"
#include "ljus/image/texture.hpp"
#include "ljus/lights/area_light.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/ref.hpp"
#include "ljus/scene/body_list.hpp"
#include "ljus/scene/contacts.hpp"

namespace ljus {

/// \defgroup light_choice Choosing a light
/// \brief Photons and the path tracer's shadow rays choose one light, with a
/// probability proportional to its power.
/// \{

/// The cumulative distribution of the lights of a scene by power.
struct LightChoice {
    std::vector<double> cumulative; ///< Sum of the powers up to each light, in W.
};

/// One chosen light.
template <std::floating_point T>
struct ChosenLightT {
    std::uint32_t light = 0; ///< The number of the light.
    T probability = T(0);    ///< The probability of this choice.
};

/// The distribution for choose_light(), from the flux of each light, in W. The power of
/// a light is the sum of the channels of its flux.
template <std::floating_point T>
[[nodiscard]] LightChoice light_choice(const std::vector<RgbT<T>>& powers) {
    LightChoice choice{std::vector<double>(powers.size())};
    double sum = 0;
    for (std::size_t i = 0; i < powers.size(); ++i) {
        const RgbT<double> flux{powers[i]};
        choice.cumulative[i] = sum += flux.x + flux.y + flux.z;
    }
    return choice;
}

/// The probability that choose_light() returns a light: its fraction of the total
/// power.
template <std::floating_point T>
[[nodiscard]] T probability_of(const LightChoice& choice,
                               std::uint32_t light) noexcept {
    const double before = light == 0 ? 0.0 : choice.cumulative[light - 1];
    return static_cast<T>((choice.cumulative[light] - before) /
                          choice.cumulative.back());
}

/// Chooses a light with a probability proportional to its power. There must be a light,
/// and `u` must be in [0, 1).
/// \return The number of the light, and its probability, which is never 0.
/// \cost A binary search.
template <std::floating_point T>
[[nodiscard]] ChosenLightT<T> choose_light(const LightChoice& choice, T u) noexcept {
    const double power = double(u) * choice.cumulative.back();
    const auto place =
        std::upper_bound(choice.cumulative.begin(), choice.cumulative.end() - 1, power);
    const auto light = static_cast<std::uint32_t>(place - choice.cumulative.begin());
    // The probability may underflow in T if another light is 1e38 times as strong. It
    // must not be 0, because the flux of the light is divided by it.
    return {light,
            std::max(probability_of<T>(choice, light), std::numeric_limits<T>::min())};
}

/// \}

/// \defgroup world Worlds
/// \brief Section 3.1 of the report: "determine the first object intersected by a ray";
/// the report's discussion: "an octree, axis-aligned bounding boxes, or a binary space
/// partition". Chapter: \ref ch_bvh.
/// \{

namespace detail {

/// The largest number of shapes that are tested in a loop. More shapes are put in a
/// tree. Measured with 3 and more objects of the report's room, the tree is no slower
/// than the loop (benchmarks/rays_room.cpp; \ref ch_bvh).
inline constexpr std::size_t flat_loop_limit = 2;

/// Whether this number of shapes needs a tree.
[[nodiscard]] constexpr bool needs_tree(std::size_t shapes) noexcept {
    return shapes > flat_loop_limit;
}

/// Intersects a ray with a shape of any type. Compute selects the arithmetic, if the
/// shape offers a choice.
template <typename Compute, std::floating_point T, typename S>
[[nodiscard]] std::optional<ShapeHitT<T>> hit_of(const RayT<T>& ray, const S& shape) {
    const auto ask = [&] {
        if constexpr (requires { intersect<Compute>(ray, shape); })
            return intersect<Compute>(ray, shape);
        else
            return intersect(ray, shape);
    };
    if constexpr (std::is_same_v<decltype(ask()), std::optional<ShapeHitT<T>>>) {
        return ask(); // avoids a copy with a measurable cost
    } else {
        const auto hit = ask();
        if (!hit) return std::nullopt;
        return as_hit(*hit);
    }
}

/// Whether hit_of() would return a hit, by the shape's meets() if there is one.
template <typename Compute, std::floating_point T, typename S>
[[nodiscard]] bool is_met(const RayT<T>& ray, const S& shape) {
    if constexpr (requires { meets<Compute>(ray, shape); })
        return meets<Compute>(ray, shape);
    else
        return hit_of<Compute>(ray, shape).has_value();
}

/// The type in which a World stores a scene's list of lights.
template <typename LightList>
struct KeptLights;
template <typename... L>
struct KeptLights<std::tuple<std::vector<L>...>> {
    using Type = std::tuple<std::vector<InSceneT<L>>...>;
};

/// Whether the normal map of a NormalMapped material turns any normal. Scene files and
/// mesh files have materials with a flat map, which has no effect.
template <typename M>
[[nodiscard]] bool turns_normals_of(const M& m) {
    if constexpr (requires { turns_normals(m.texture); })
        return turns_normals(m.texture);
    else if constexpr (requires { m.base; })
        return turns_normals_of(m.base);
    else
        return true;
}

template <typename S>
inline constexpr bool is_scene = false;
template <typename G, typename M, typename L, typename P>
inline constexpr bool is_scene<Scene<G, M, L, P>> = true;

} // namespace detail

/// A textured lamp. It is only declared here, so that programs without such a lamp do
/// not compile lights/picture_light.hpp.
template <std::floating_point T>
struct PictureLightT;

namespace detail {

/// The textured lamps of a World.
template <std::floating_point T>
struct KeptPicturesT {
    std::vector<PictureLightT<T>> lights{};
    /// For each lamp of the scene, its index in `lights`; no_light for a lamp without a
    /// picture.
    std::vector<std::uint32_t> shown{};
};

} // namespace detail

/// Selects the arithmetic of intersections, as an argument of the constructor:
/// `World world(std::move(scene), compute_in<double>)`.
template <typename Compute>
inline constexpr std::type_identity<Compute> compute_in{};

/// The first object that a ray meets.
template <std::floating_point T>
struct SceneHitT {
    ShapeHitT<T> at{};   ///< Distance, and the shape's own coordinates.
    ObjectId object{};   ///< The object.
    bool shared = false; ///< Whether other objects have surfaces in the same place.
};

/// A closed scene. It owns shapes, materials and lights, a tree over the shapes
/// \cite rubin1980, and data derived from the lights. It cannot be changed, so its
/// members are always consistent.
///
///     const World world(std::move(scene));
///
/// Compute is the arithmetic of all intersections, as for intersect().
template <typename S, typename Compute = void>
class World {
    static_assert(detail::is_scene<S>, "A World is made of a Scene.");

public:
    using Scalar = typename S::Scalar; ///< The precision, from the shapes' types.
    /// The type of the tree: Bvh8 for float, BvhT for other precisions.
    using Tree = std::conditional_t<std::is_same_v<Scalar, float>, Bvh8, BvhT<Scalar>>;

    /// Closes a scene. A scene without instances may be copied instead of moved.
    /// \throws std::invalid_argument  if the scene contains data that add() would
    ///         refuse, or a black light, or if its arrays are inconsistent.
    [[gnu::cold]] explicit World(S scene, std::type_identity<Compute> = {})
        : shapes_(std::move(scene.shapes)), objects_(std::move(scene.objects)),
          prototypes_(std::move(scene.prototypes)), fog_(std::move(scene.media)) {
        const std::vector<BoxT<Scalar>> boxes = find_bounds();
        make_frames();
        make_tree(boxes);
        const auto check_all = [](const auto& list) {
            for (const auto& element : list) check(element);
        };
        detail::each_array(scene.materials, check_all);
        detail::each_array(fog_, check_all);
        close_lights(scene);
        materials_ = std::move(scene.materials);
        if constexpr (lists_priorities) rank_bodies();
        has_holes_ = has_material([]<typename M>() { return CutOutMaterial<M>; });
        if constexpr (any_material([]<typename M>() { return NormalMapped<M>; }))
            check_normal_maps();
        if constexpr (any_material([]<typename M>() { return Transparent<M>; }))
            find_media(boxes);
        contacts_ = find_contacts(*this, boxes);
        has_contacts_ = !contacts_.pairs.empty();
        contact_box_ = {Vec3T<Scalar>(contacts_.box.low),
                        Vec3T<Scalar>(contacts_.box.high)};
    }

    /// All shapes, an array per type.
    [[nodiscard]] const auto& shapes() const noexcept { return shapes_; }
    /// The properties of each object, in the order of shapes().
    [[nodiscard]] const auto& objects() const noexcept { return objects_; }
    /// All materials, an array per type.
    [[nodiscard]] const auto& materials() const noexcept { return materials_; }
    /// The number of shapes.
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// The bounding box of the bounding spheres of all shapes.
    [[nodiscard]] const BoxT<Scalar>& box() const noexcept { return box_; }
    /// Whether a point lies in the bounding box of all absorbing bodies or, in a scene
    /// with fog or priorities, of all transparent bodies.
    [[nodiscard]] bool may_be_in_medium(const Vec3T<Scalar>& point) const noexcept {
        return glm::all(glm::lessThanEqual(media_.low, point)) &&
               glm::all(glm::lessThanEqual(point, media_.high));
    }
    /// Whether the bounding box of an absorbing body overlaps that of another
    /// transparent body, so that a path that leaves one may still be in the other. Also
    /// true if there are absorbing bodies and more than 4096 transparent ones.
    [[nodiscard]] bool has_nested_media() const noexcept { return nested_media_; }
    /// Whether the scene lists a type of material that may have a priority.
    static constexpr bool lists_priorities =
        S::any_material([]<typename M>() { return HasPriority<M>; });
    /// Whether any material of the scene has a priority other than 0; see
    /// \ref nested_bodies.
    [[nodiscard]] bool has_priorities() const noexcept {
        return lists_priorities && ranks_.prioritized;
    }
    /// The rank of a material among the transparent materials; 0 for an opaque
    /// material. Where bodies overlap, the body of the highest rank counts.
    [[nodiscard]] std::uint8_t rank_of(MaterialId id) const noexcept {
        return ranks_.ranks.empty() ? std::uint8_t(0) : ranks_.ranks[id.type][id.index];
    }
    /// The material of a rank; no_body for rank 0, which is air.
    [[nodiscard]] MaterialId material_of_rank(std::uint8_t rank) const noexcept {
        return rank == 0 ? no_body : ranks_.materials[rank - 1u];
    }
    /// All contacts of the scene: objects that have surfaces in the same place.
    [[nodiscard]] const Contacts& contacts() const noexcept { return contacts_; }
    /// Whether surfaces of several objects may lie at the point t of a ray.
    /// \cost A comparison in a scene without contacts.
    [[nodiscard]] bool may_share_place(const RayT<Scalar>& ray,
                                       Scalar t) const noexcept {
        return has_contacts_ && detail::may_be_in(contact_box_, ray, t);
    }
    /// The number of lights, including emissive objects. Lights are numbered in the
    /// order in which they were added.
    [[nodiscard]] std::size_t light_count() const noexcept { return lights_.size(); }
    /// The flux of each light, in W.
    [[nodiscard]] const auto& powers() const noexcept { return powers_; }
    /// The distribution of the lights by power.
    [[nodiscard]] const LightChoice& light_choice() const noexcept { return choice_; }
    /// The objects in the tree's order; empty without a tree.
    [[nodiscard]] std::span<const ObjectId> ids() const noexcept { return ids_; }
    /// The tree over the shapes; empty if there are too few for a tree.
    [[nodiscard]] const Tree& tree() const noexcept { return tree_; }

    /// Whether the scene lists a type of medium, such as Fog.
    static constexpr bool lists_fog = S::lists_fog;
    /// All media, an array per type.
    [[nodiscard]] const auto& media() const noexcept { return fog_; }
    /// Whether the scene has a medium.
    [[nodiscard]] bool has_fog() const noexcept {
        return detail::any_array(fog_, [](const auto& list) { return !list.empty(); });
    }

    /// The properties of an object.
    [[nodiscard]] const ObjectT<Scalar>& object(ObjectId id) const noexcept {
        return objects_[id.type][id.index];
    }
    /// Calls f(id, object) for each object, in the order of shapes().
    template <typename F>
    void each_object(F&& f) const {
        for (ObjectId id; id.type < objects_.size(); ++id.type)
            for (id.index = 0; id.index < objects_[id.type].size(); ++id.index)
                f(id, object(id));
    }
    /// The frame around the normal of a flat shape.
    [[nodiscard]] const FrameT<Scalar>& frame(ObjectId id) const noexcept {
        return frames_[id.type][id.index];
    }
    /// Whether the scene lists a type of material whose lamps emit a picture.
    static constexpr bool lists_pictures =
        S::any_material([]<typename M>() { return ShowsPicture<M>; });
    static_assert(
        !lists_pictures || requires { sizeof(PictureLightT<Scalar>); },
        "A material with emission_picture() needs ljus/lights/picture_light.hpp.");
    /// The textured lamp of an object; null if the object is not such a lamp.
    [[nodiscard]] const PictureLightT<Scalar>*
    picture_of(const ObjectT<Scalar>& object) const noexcept {
        return object.light == no_light ? nullptr
                                        : picture_of(lights_[object.light].index);
    }
    /// Whether a path can meet a light: the light is an object or fills the sky.
    [[nodiscard]] bool can_be_met(std::uint32_t light) const {
        if constexpr (any_light([]<typename L>() { return FillsSky<L>; }))
            if (lights_[light].is_light)
                return visit_light(light,
                                   []<typename L>(const L&) { return FillsSky<L>; });
        return !lights_[light].is_light;
    }
    /// Calls f(shape) with the shape of an object, in the shape's own type.
    template <typename F>
    decltype(auto) visit_shape(ObjectId id, F&& f) const {
        return detail::visit_element(shapes_, id.type, id.index, f);
    }
    /// Calls f(material) with a material, in the material's own type.
    template <typename F>
    decltype(auto) visit_material(MaterialId id, F&& f) const {
        return detail::visit_element(materials_, id.type, id.index, f);
    }
    /// Calls f(light) with a light, in the light's own type: an AreaLightT or a
    /// PictureLightT for an emissive object, and the result of in_scene() for others.
    template <typename F>
    decltype(auto) visit_light(std::uint32_t number, F&& f) const {
        const AddedId& id = lights_[number];
        if constexpr (std::tuple_size_v < Kept >> 0)
            if (id.is_light) return detail::visit_element(kept_, id.type, id.index, f);
        if constexpr (lists_pictures)
            if (const auto* const lamp = picture_of(id.index)) return f(*lamp);
        const Lamp& lamp = lamps_[id.index];
        return visit_shape(lamp.object, [&]<typename G>(const G& shape) {
            return f(AreaLightT<G>{shape, lamp.known});
        });
    }

    /// Whether a predicate is true for at least one listed type of shape; see
    /// Scene::any_shape().
    template <typename F>
    [[nodiscard]] static constexpr bool any_shape(F f) noexcept {
        return S::any_shape(f);
    }
    /// Whether a predicate is true for at least one listed type of material; see
    /// Scene::any_material().
    template <typename F>
    [[nodiscard]] static constexpr bool any_material(F f) noexcept {
        return S::any_material(f);
    }
    /// The same as any_material(), for the types of which the scene has a material.
    template <typename F>
    [[nodiscard]] bool has_material([[maybe_unused]] F f) const noexcept {
        return detail::any_array(materials_,
                                 [&]<typename M>(const std::vector<M>& list) {
                                     return f.template operator()<M>() && !list.empty();
                                 });
    }
    /// Whether a material of the scene has holes.
    [[nodiscard]] bool has_holes() const noexcept { return has_holes_; }
    /// Whether a predicate is true for at least one of the types that the scene's
    /// lights have in this world; see Scene::any_light().
    template <typename F>
    [[nodiscard]] static constexpr bool any_light(F f) noexcept {
        return S::any_light(f);
    }

private:
    using Kept = typename detail::KeptLights<decltype(S::lights)>::Type;
    struct Lamp {
        ObjectId object;
        LampT<Scalar> known;
    };

    // The box of each object, in the order of types and indices.
    [[nodiscard, gnu::cold]] std::vector<BoxT<Scalar>> find_bounds() {
        for (const auto& list : objects_) size_ += list.size();
        std::vector<BoxT<Scalar>> boxes(size_);
        auto next = boxes.begin();
        std::size_t type = 0;
        const auto add = [&](const auto& list) {
            require(list.size() == objects_[type].size(), "the number of shapes",
                    static_cast<long long>(list.size()),
                    "the number of their objects: add shapes by add()");
            for (const auto& shape : list) {
                check(shape);
                prototypes_.require_kept(shape);
                const SphereT<Scalar> bound = bounding_sphere(shape);
                box_.low = glm::min(box_.low, bound.center - bound.radius);
                box_.high = glm::max(box_.high, bound.center + bound.radius);
                *next++ = detail::box_around(shape);
            }
            ++type;
        };
        detail::each_array(shapes_, add);
        if (size_ == 0) box_ = {Vec3T<Scalar>{0}, Vec3T<Scalar>{0}};
        return boxes;
    }

    // The frames of flat shapes are computed only once, because a normal costs a cross
    // product in double and a square root.
    [[gnu::cold]] void make_frames() {
        std::size_t type = 0;
        const auto add = [&]<typename G>(const std::vector<G>& list) {
            if constexpr (detail::is_plane<G>) {
                auto& frames = frames_[type];
                frames.resize(list.size());
                for (std::size_t i = 0; i < list.size(); ++i) {
                    const auto n = normal(list[i]);
                    frames[i] = frame_around(objects_[type][i].inside_out ? -n : n);
                }
            }
            ++type;
        };
        detail::each_array(shapes_, add);
    }

    [[gnu::cold]] void make_tree(const std::vector<BoxT<Scalar>>& boxes) {
        if (!detail::needs_tree(size_)) return;
        detail::GrowingArray<ObjectId> all;
        each_object([&](ObjectId id, const auto&) { all.push_back(id); });
        tree_ = Tree(boxes, {.leaf_size = 1});
        ids_.resize(size_);
        for (std::size_t slot = 0; slot < size_; ++slot)
            ids_[slot] = all[tree_.primitive_ids()[slot]];
    }

    [[gnu::cold]] void rank_bodies() {
        struct Body {
            std::array<double, 5> order; // priority, index, absorption
            MaterialId id;
        };
        std::vector<Body> bodies;
        MaterialId id;
        const auto add = [&]<typename M>(const std::vector<M>& list) {
            ranks_.ranks.emplace_back(list.size());
            for (id.index = 0; id.index < list.size(); ++id.index) {
                const M& m = list[id.index];
                if (detail::kind_of(m) != ContactKind::body) continue;
                double index = 1;
                if constexpr (Refractive<M>) index = double(refractive_index(m));
                const RgbT<double> absorbed{absorption(m)};
                bodies.push_back(
                    {{double(priority(m)), index, absorbed.x, absorbed.y, absorbed.z},
                     id});
                ranks_.prioritized |= priority(m) != 0;
            }
            ++id.type;
        };
        detail::each_array(materials_, add);
        if (bodies.size() > 255) {
            require(!ranks_.prioritized, "the number of transparent materials",
                    static_cast<long long>(bodies.size()),
                    "at most 255 in a scene with priorities");
            ranks_.ranks.clear();
            return;
        }
        std::stable_sort(
            bodies.begin(), bodies.end(),
            [](const Body& a, const Body& b) { return a.order < b.order; });
        for (const Body& body : bodies) {
            ranks_.materials.push_back(body.id);
            ranks_.ranks[body.id.type][body.id.index] =
                static_cast<std::uint8_t>(ranks_.materials.size());
        }
        for (const auto& list : objects_)
            for (const auto& object : list)
                require(!has_priorities() || is_black(object.emission) ||
                            rank_of(object.material) == 0,
                        "the radiance of a transparent body", object.emission,
                        "black in a scene with priorities: another body may hide it");
    }

    [[gnu::cold]] void check_normal_maps() const {
        std::size_t type = 0;
        const auto check_list = [&]<typename G>(const std::vector<G>&) {
            if constexpr (!HasTangents<G>)
                for (const ObjectT<Scalar>& object : objects_[type])
                    visit_material(object.material, []<typename M>(const M& m) {
                        if constexpr (NormalMapped<M>)
                            if (detail::turns_normals_of(m))
                                throw std::invalid_argument(detail::join(
                                    {"a shape of the type ", detail::type_name<G>(),
                                     " has a normal map, but no texture_tangents() in "
                                     "which its normals would be; meshes, quads and "
                                     "triangles have them."}));
                    });
            ++type;
        };
        detail::each_array(shapes_, check_list);
    }

    [[gnu::cold]] void find_media(const std::vector<BoxT<Scalar>>& boxes) {
        struct Body {
            BoxT<Scalar> box;
            bool absorbs; // also true with fog or priorities
        };
        detail::GrowingArray<Body> bodies;
        auto next = boxes.begin();
        each_object([&](ObjectId, const auto& object) {
            visit_material(object.material, [&]<typename M>(const M& m) {
                if constexpr (Transparent<M>)
                    bodies.push_back({*next, has_fog() || has_priorities() ||
                                                 !is_black(absorption(m))});
            });
            ++next;
        });
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const auto& [box, absorbs] = bodies[i];
            if (!absorbs) continue;
            media_.low = glm::min(media_.low, box.low);
            media_.high = glm::max(media_.high, box.high);
            // For very many bodies it is true without the test, which is quadratic.
            nested_media_ = nested_media_ || bodies.size() > 4096;
            for (std::size_t k = 0; k < bodies.size() && !nested_media_; ++k)
                nested_media_ = k != i && (!bodies[k].absorbs || k > i) &&
                                detail::overlap(box, bodies[k].box);
        }
    }

    // The sphere around everything. It is 0.1 % larger, so that rounding does not
    // exclude a corner from a sun's light.
    [[nodiscard]] SphereT<Scalar> around() const {
        BoxT<Scalar> all = box_;
        const auto add = [&](const auto& list) {
            for (const auto& medium : list) all = box_union(all, bounds(medium));
        };
        detail::each_array(fog_, add);
        const Vec3T<Scalar> half = (all.high - all.low) / Scalar(2);
        return {.center = all.low + half, .radius = Scalar(1.001) * glm::length(half)};
    }

    // Refuses an order that does not list each object and each light once.
    [[gnu::cold]] void check_order(const S& scene) const {
        std::array<std::vector<std::size_t>, 2> sizes; // of objects, of lights
        for (const auto& list : objects_) sizes[0].push_back(list.size());
        const auto add = [&](const auto& list) { sizes[1].push_back(list.size()); };
        detail::each_array(scene.lights, add);
        std::array<std::vector<std::size_t>, 2> listed;
        for (const std::size_t kind : {0u, 1u}) listed[kind].resize(sizes[kind].size());
        bool in_turn = true; // as add() lists them
        for (const auto& [type, index, is_light] : scene.order) {
            auto& next = listed[is_light];
            in_turn = in_turn && type < next.size() && index == next[type]++;
        }
        require(in_turn && listed == sizes, "the number of entries in Scene::order",
                static_cast<long long>(scene.order.size()),
                "one for each shape and light: add them by add()");
    }

    [[gnu::cold]] void close_lights(const S& scene) {
        check_order(scene);
        const SphereT<Scalar> sphere = around();
        const auto keep = [&](auto& to, const auto& from) {
            for (const auto& light : from) {
                check(light);
                to.push_back(in_scene(light, sphere));
            }
        };
        [&]<std::size_t... I>(std::index_sequence<I...>) {
            (keep(std::get<I>(kept_), std::get<I>(scene.lights)), ...);
        }
        (std::make_index_sequence<std::tuple_size_v<Kept>>{});
        for (const AddedId& added : scene.order)
            if (added.is_light)
                add_light(added);
            else
                add_lamp(scene, {added.type, added.index});
        choice_ = ljus::light_choice(powers_);
    }

    [[gnu::cold]] void add_lamp(const S& scene, ObjectId id) {
        ObjectT<Scalar>& object = objects_[id.type][id.index];
        object.emission = scene.emission_of(object);
        object.light = no_light;
        if (is_black(object.emission)) return;
        visit_shape(id, [&]<typename G>(const G& shape) {
            if constexpr (HasArea<G>)
                lamps_.push_back(
                    {id, detail::make_lamp(shape, object.emission, object.inside_out)});
            if constexpr (lists_pictures) add_picture(scene, shape, object);
        });
        object.light = static_cast<std::uint32_t>(lights_.size());
        add_light({0, static_cast<std::uint32_t>(lamps_.size() - 1), false});
    }

    // The textured lamp of a lamp, or null.
    [[nodiscard]] const PictureLightT<Scalar>*
    picture_of(std::uint32_t lamp) const noexcept {
        if constexpr (lists_pictures)
            if (const std::uint32_t number = pictures_.shown[lamp]; number != no_light)
                return &pictures_.lights[number];
        return nullptr;
    }

    // Gives the last lamp its picture, if its material shows one.
    template <typename G>
    [[gnu::cold]] void add_picture(const S& scene, const G& shape,
                                   const ObjectT<Scalar>& object) {
        pictures_.shown.push_back(no_light);
        const auto add = [&]<typename M>(const M& material) {
            if constexpr (ShowsPicture<M>) {
                auto& [lights, shown] = pictures_;
                shown.back() = static_cast<std::uint32_t>(lights.size());
                lights.push_back(make_picture_light(shape, emission_picture(material),
                                                    object.emission,
                                                    object.inside_out));
            }
        };
        detail::visit_element(scene.materials, object.material.type,
                              object.material.index, add);
    }

    [[gnu::cold]] void add_light(const AddedId& id) {
        lights_.push_back(id);
        powers_.push_back(visit_light(static_cast<std::uint32_t>(lights_.size() - 1),
                                      [](const auto& light) { return power(light); }));
        if (size_ > 0) detail::require_flux(powers_.back()); // a sun needs objects
    }

    decltype(S::shapes) shapes_;
    decltype(S::objects) objects_;
    decltype(S::prototypes) prototypes_; // to which shapes_ refer
    decltype(S::materials) materials_;
    decltype(S::media) fog_;
    std::array<std::vector<FrameT<Scalar>>, std::tuple_size_v<decltype(S::shapes)>>
        frames_;
    std::size_t size_ = 0;
    BoxT<Scalar> box_{};
    BoxT<Scalar> media_{}; // see may_be_in_medium(); empty if there are none
    bool nested_media_ = false;
    BodyRanks ranks_{};
    bool has_contacts_ = false;
    bool has_holes_ = false;
    BoxT<Scalar> contact_box_{};
    Tree tree_{};
    std::vector<ObjectId> ids_{};
    Kept kept_{};
    std::vector<Lamp> lamps_{};
    std::vector<AddedId> lights_{}; // the index is in kept_, or in lamps_
    std::vector<RgbT<Scalar>> powers_{};
    LightChoice choice_{};
    Contacts contacts_{};
    std::conditional_t<lists_pictures, detail::KeptPicturesT<Scalar>, std::tuple<>>
        pictures_{};
};

namespace detail {

template <typename W>
inline constexpr bool is_world = false;
template <typename S, typename Compute>
inline constexpr bool is_world<World<S, Compute>> = true;

} // namespace detail

/// Any type of World, which renderers and photon passes take as an argument.
template <typename W>
concept AnyWorld = detail::is_world<W>;

namespace detail {

/// Causes a compile error for a scene that is not closed.
template <typename W>
struct Closed {
    using Type = W;
    static_assert(is_world<W>, "Close the scene: World world(std::move(scene)).");
};

template <AnyWorld W>
inline constexpr bool lists_cut_outs = W::any_material([]<typename M>() {
    return CutOutMaterial<M>;
});

/// If a ray meets more holes than this in one object, it misses the object.
inline constexpr int max_holes = 1000;

/// The first hit of a ray on a shape, outside the holes of the shape's material.
/// \cost One more intersection and one more look-up in the mask for each hole.
// [solid_hit]
template <typename Compute, std::floating_point T, typename G, CutOutMaterial M>
[[nodiscard]] std::optional<ShapeHitT<T>> solid_hit(RayT<T> ray, const G& shape,
                                                    const M& material) {
    for (int holes = 0; holes < max_holes; ++holes) {
        const auto hit = hit_of<Compute>(ray, shape);
        if (!hit) break;
        const SurfacePointT<T> point = surface_point(shape, ray, *hit);
        Vec2T<T> uv{T(0)};
        if constexpr (UsesUv<M>) uv = texture_coordinates(shape, *hit, point);
        if (!is_open(material, point.position, uv)) return hit;
        ray.t_min = std::nextafter(hit->t, std::numeric_limits<T>::infinity());
    }
    return std::nullopt;
}
// [solid_hit]

/// Calls f(material) for an object whose material may have holes, and f() for any
/// other object.
template <AnyWorld W, typename F>
[[nodiscard]] decltype(auto) with_holes(const W& world, ObjectId id, F&& f) {
    if constexpr (lists_cut_outs<W>) {
        if (!world.has_holes()) return f();
        return world.visit_material(world.object(id).material,
                                    [&]<typename M>(const M& m) {
                                        if constexpr (CutOutMaterial<M>)
                                            return f(m);
                                        else
                                            return f();
                                    });
    } else {
        return f();
    }
}

/// The hit of a ray on the shape of an object. A point in a hole is not a hit.
template <typename Compute, AnyWorld W, std::floating_point T, typename G>
[[nodiscard]] std::optional<ShapeHitT<T>> hit_on(const W& world, ObjectId id,
                                                 const RayT<T>& ray, const G& shape) {
    return with_holes(world, id, [&](const auto&... cut) {
        if constexpr (sizeof...(cut) > 0)
            return solid_hit<Compute>(ray, shape, cut...);
        else
            return hit_of<Compute>(ray, shape);
    });
}

/// Whether hit_on() would return a hit.
template <typename Compute, AnyWorld W, std::floating_point T, typename G>
[[nodiscard]] bool meets_object(const W& world, ObjectId id, const RayT<T>& ray,
                                const G& shape) {
    return with_holes(world, id, [&](const auto&... cut) {
        if constexpr (sizeof...(cut) > 0)
            return solid_hit<Compute>(ray, shape, cut...).has_value();
        else
            return is_met<Compute>(ray, shape);
    });
}

} // namespace detail

/// Refuses a scene with fog, for a method such as "photon maps" that does not compute
/// light in fog.
/// \throws std::invalid_argument  if the scene has a medium.
template <AnyWorld W>
void require_no_fog([[maybe_unused]] const W& world,
                    [[maybe_unused]] std::string_view what) {
    if constexpr (W::lists_fog)
        if (world.has_fog())
            throw std::invalid_argument(detail::join(
                {"the scene has fog, and light in fog is not computed by ", what,
                 "; render it by path tracing, or remove the fog."}));
}

/// A renderer's reference to its world. For a scene that is not closed, the compiler's
/// message says how to close it.
template <typename W>
using WorldRef = Ref<typename detail::Closed<W>::Type>;

/// The surface that a ray meets at a hit, chosen from all surfaces that coincide there.
template <std::floating_point T>
struct PlaceHitT {
    SceneHitT<T> met{};           ///< The surface that counts; see \ref contacts.
    MaterialId left = no_body;    ///< The material of a body that ends at the hit.
    MaterialId entered = no_body; ///< The material of a body that begins at the hit.
    /// Distance of the farthest coinciding surface from the hit, in scene units.
    T depth = T(0);
};

namespace detail {

/// The surface point at a hit, with its normal on the outside.
template <typename S, typename Compute, std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_at(const World<S, Compute>& world,
                                          const RayT<T>& ray, const SceneHitT<T>& hit) {
    auto point = world.visit_shape(hit.object, [&](const auto& shape) {
        return surface_point(shape, ray, hit.at);
    });
    if (world.object(hit.object).inside_out) point.normal = -point.normal;
    return point;
}

/// If a hit lies in the box of a contact, calls f(object, hit, front) for the hit
/// itself, then for the hit of each other surface in the same place. `here` is the
/// object of the given hit. `front` tells whether the ray arrives from outside the
/// object.
/// \return Distance of the farthest other surface from the hit, along the normal, in
///         scene units; nothing if there are no other surfaces.
template <typename S, typename Compute, std::floating_point T, typename F>
[[nodiscard]] std::optional<T> visit_place(const World<S, Compute>& world,
                                           const RayT<T>& ray, const SceneHitT<T>& hit,
                                           const TouchingObject& here, F&& f) {
    const Contacts& contacts = world.contacts();
    const auto arrives = [&](const SurfacePointT<T>& point) {
        return glm::dot(ray.direction, point.normal) < T(0);
    };
    std::optional<SurfacePointT<T>> point;
    std::optional<T> depth;
    RayT<T> near = ray; // only around the hit
    for (std::uint32_t i = here.contact; i != no_contact;) {
        const Contact& contact = contacts.pairs[i];
        const std::size_t mine = &contacts.objects[contact.pair[0]] == &here ? 0 : 1;
        const TouchingObject& other = contacts.objects[contact.pair[1 - mine]];
        i = contact.next[mine];
        const BoxT<T> box{Vec3T<T>(contact.box.low), Vec3T<T>(contact.box.high)};
        if (!may_be_in(box, ray, hit.at.t)) continue;
        if (!point) {
            point = surface_at(world, ray, hit);
            const T across = std::abs(glm::dot(ray.direction, point->normal));
            const T reach = T(2) * leaving_distance(*point) /
                                glm::max(across, T(1e-3) * glm::length(ray.direction)) +
                            T(16) * std::numeric_limits<T>::epsilon() * hit.at.t;
            near.t_min = glm::max(ray.t_min, hit.at.t - reach);
            near.t_max = glm::min(ray.t_max, hit.at.t + reach);
            f(here, hit, arrives(*point));
        }
        const auto found = world.visit_shape(other.object, [&](const auto& shape) {
            return hit_on<Compute>(world, other.object, near, shape);
        });
        if (!found) continue;
        const SceneHitT<T> at{*found, other.object};
        const SurfacePointT<T> there = surface_at(world, ray, at);
        const T apart =
            std::abs(glm::dot(point->normal, there.position - point->position));
        if (!(apart <= leaving_distance(*point))) continue;
        depth = glm::max(depth.value_or(T(0)), apart);
        f(other, at, arrives(there));
    }
    return depth;
}

} // namespace detail

/// Decides which of several coinciding surfaces a ray meets at a hit. The direction of
/// the ray may have any length.
/// \return The surface that counts. If no other surface coincides with the surface of
///         the hit, this is the hit itself, and SceneHitT::shared is false.
/// \cost One intersection for each object that may have a coinciding surface.
template <typename S, typename Compute, std::floating_point T>
[[nodiscard, gnu::noinline]] PlaceHitT<T>
place_of(const World<S, Compute>& world, const RayT<T>& ray, const SceneHitT<T>& hit) {
    PlaceHitT<T> place{.met = hit};
    const TouchingObject* const here = world.contacts().find(hit.object);
    if (here == nullptr) return place;

    const TouchingObject *met = here, *left = nullptr, *entered = nullptr;
    SceneHitT<T> into{};
    const auto pass = [&](const TouchingObject& object, const SceneHitT<T>& at,
                          bool front) {
        if (object.kind == ContactKind::body) {
            const TouchingObject*& best = front ? entered : left;
            if (best == nullptr || object.key < best->key) {
                best = &object;
                (front ? place.entered : place.left) = world.object(at.object).material;
                if (front) into = at;
            }
        }
        if (object.key < met->key) {
            met = &object;
            place.met = at;
        }
    };
    const std::optional<T> depth = detail::visit_place(world, ray, hit, *here, pass);
    // If one body ends and another begins, the path meets the one that begins.
    if (entered != nullptr && met->kind == ContactKind::body) place.met = into;
    place.depth = depth.value_or(T(0));
    place.met.shared = depth.has_value();
    return place;
}

/// The first object that a ray meets, by a loop over all shapes: the plain twin of
/// closest_hit().
/// \cost One intersection per shape.
template <typename S, typename Compute, std::floating_point T>
[[nodiscard]] std::optional<SceneHitT<T>>
closest_hit_plain(const World<S, Compute>& world, const RayT<T>& asked) {
    RayT<T> ray = asked;
    std::optional<SceneHitT<T>> closest;
    std::uint32_t type = 0;
    const auto ask_all = [&](const auto& shapes) {
        for (std::uint32_t i = 0; i < shapes.size(); ++i) {
            const auto found =
                detail::hit_on<Compute>(world, {type, i}, ray, shapes[i]);
            if (!found || (closest && !(found->t < ray.t_max))) continue;
            ray.t_max = found->t;
            closest = SceneHitT<T>{*found, {type, i}};
        }
        ++type;
    };
    detail::each_array(world.shapes(), ask_all);
    if (closest && world.may_share_place(asked, closest->at.t))
        return place_of(world, asked, *closest).met;
    return closest;
}

/// Whether any object intersects a ray, by a loop over all shapes: the plain twin of
/// occluded().
template <typename S, typename Compute, std::floating_point T>
[[nodiscard]] bool occluded_plain(const World<S, Compute>& world, const RayT<T>& ray) {
    std::uint32_t type = 0;
    const auto any = [&](const auto& shapes) {
        for (const auto& shape : shapes) {
            const ObjectId id{type, static_cast<std::uint32_t>(&shape - shapes.data())};
            if (detail::meets_object<Compute>(world, id, ray, shape)) return true;
        }
        ++type;
        return false;
    };
    return detail::any_array(world.shapes(), any);
}

/// The first object that a ray meets, found by the tree. The result is the same as that
/// of closest_hit_plain(), to the last bit.
/// \return The nearest hit in [t_min, t_max]; nothing for a miss. For several surfaces
///         in one place see \ref contacts.
template <typename S, typename Compute, std::floating_point T>
[[nodiscard]] inline std::optional<SceneHitT<T>>
closest_hit(const World<S, Compute>& world, const RayT<T>& ray) {
    std::optional<SceneHitT<T>> hit;
    if (world.ids().empty()) {
        hit = closest_hit_plain(world, ray);
        return hit;
    }
    const auto nearest =
        nearest_hit(world.tree(), ray, [&](std::uint32_t slot, const RayT<T>& rest) {
            return world.visit_shape(world.ids()[slot], [&](const auto& shape) {
                return detail::hit_on<Compute>(world, world.ids()[slot], rest, shape);
            });
        });
    if (!nearest.found) return hit;
    const auto& [t, u, v, part] = nearest.at; // by member: a wide copy would stall
    hit.emplace().object = world.ids()[nearest.slot];
    hit->at.t = t;
    hit->at.u = u;
    hit->at.v = v;
    hit->at.part = part;
    if (world.may_share_place(ray, hit->at.t)) hit = place_of(world, ray, *hit).met;
    return hit;
}

/// Whether any object intersects a ray in [t_min, t_max]. The first hit that is found
/// ends the search.
template <typename S, typename Compute, std::floating_point T>
[[nodiscard]] bool occluded(const World<S, Compute>& world, const RayT<T>& ray) {
    if (world.ids().empty()) return occluded_plain(world, ray);
    return world.tree().any(ray, [&](std::uint32_t slot) {
        return world.visit_shape(world.ids()[slot], [&](const auto& shape) {
            return detail::meets_object<Compute>(world, world.ids()[slot], ray, shape);
        });
    });
}

/// Samples a point of a light, for a shadow ray that begins at the lit point `from`. If
/// the light is a sun, that point must be within the sphere around the scene. `u` is a
/// point of the unit square, and `time` is in [0, 1].
/// \return The sample; nothing if the light does not shine towards `from`.
/// \report{Section 3.2.3}
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>>
sample_light(const W& world, std::uint32_t light, const Vec3T<T>& from,
             const Vec2T<T>& u, T time = T(0)) {
    return world.visit_light(
        light, [&](const auto& l) { return sample_light(l, from, u, time); });
}

/// \}

} // namespace ljus
