#pragma once

/// \file ljus/scene/scene.hpp
/// \brief Scenes: shapes, materials and lights as plain data.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <vector>

#include "ljus/lights/area_light.hpp"
#include "ljus/materials/material.hpp"
#include "ljus/media/medium.hpp"
#include "ljus/ref.hpp"
#include "ljus/version.hpp"

namespace ljus {

/// \defgroup scene Scenes
/// \brief A scene lists the types of its shapes, materials, lights and media. Code for
/// other types is not compiled.
/// \{

/// The types of shapes that a scene may contain.
template <Shape... S>
struct Shapes {};

/// The types of materials that a scene may contain.
template <Material... M>
struct Materials {};

/// The types of lights that a scene may contain. Emissive objects are not listed.
template <LightSource... L>
struct Lights {};

/// The types of media that a scene may contain; see \ref medium.
template <Medium... P>
struct Media {};

/// Identifies a material by its type and its index.
struct MaterialId {
    std::uint32_t type = 0;  ///< Position in Materials<...>.
    std::uint32_t index = 0; ///< Index in that type's array.
    /// Whether both identify the same material.
    friend bool operator==(const MaterialId&, const MaterialId&) = default;
};

/// Identifies an object by its shape's type and its index.
struct ObjectId {
    std::uint32_t type = 0;  ///< Position in Shapes<...>.
    std::uint32_t index = 0; ///< Index in that type's array.
    /// Whether both identify the same object.
    friend bool operator==(const ObjectId&, const ObjectId&) = default;
};

/// The light number of an object that is not a light.
inline constexpr std::uint32_t no_light = 0xffffffffu;

/// The properties of an object, except its shape.
template <std::floating_point T>
struct ObjectT {
    MaterialId material{};   ///< The material.
    RgbT<T> emission{T(0)};  ///< Radiance on the side of the normal, in W/(m^2 sr).
    bool inside_out = false; ///< Whether the normal points inwards.
    /// The object's number among the lights of a World.
    std::uint32_t light = no_light;
};

/// An object or a light, as an element of Scene::order.
struct AddedId {
    std::uint32_t type = 0;  ///< Position in Shapes<...> or in Lights<...>.
    std::uint32_t index = 0; ///< Index in that type's array.
    bool is_light = false;   ///< True for a light, false for an object.
};

/// A material that transmits light without deflection: `pass_through(m, position, wo)`
/// returns the transmittance. sample() of such a material returns reflection only.
template <typename M>
concept ThinSurface = requires(const M& m, const Vec3T<typename M::Scalar>& v) {
    { pass_through(m, v, v) } -> std::same_as<RgbT<typename M::Scalar>>;
};

namespace detail {

/// The index of the type X in a list; the last index if no other type matches.
template <typename X, typename First, typename... List>
inline constexpr std::uint32_t type_number = 0;
template <typename X, typename First, typename Second, typename... List>
inline constexpr std::uint32_t type_number<X, First, Second, List...> =
    std::is_same_v<X, First> ? 0 : 1 + type_number<X, Second, List...>;

/// True if no type is listed twice.
template <typename... T>
inline constexpr bool each_once = true;
template <typename First, typename... T>
inline constexpr bool each_once<First, T...> =
    !(std::is_same_v<First, T> || ...) && each_once<T...>;

/// Calls f(element) with one element of a tuple of arrays, in the element's own type.
/// The last type is not tested, so that a list of one type needs no comparison.
template <std::size_t I = 0, typename Tuple, typename F>
decltype(auto) visit_element(const Tuple& arrays, std::uint32_t type,
                             std::uint32_t index, F& f) {
    if constexpr (I + 1 < std::tuple_size_v<Tuple>) {
        if (type != I) return visit_element<I + 1>(arrays, type, index, f);
    }
    return f(std::get<I>(arrays)[index]);
}

/// Calls f(array) with each array of a tuple. All arrays have different types.
template <typename... A, typename F>
void each_array([[maybe_unused]] const std::tuple<A...>& arrays, F&& f) {
    (f(std::get<A>(arrays)), ...);
}

/// Whether f(array) is true for at least one array of a tuple. The arrays after the
/// first such array are not tested.
template <typename... A, typename F>
[[nodiscard]] bool any_array([[maybe_unused]] const std::tuple<A...>& arrays, F&& f) {
    return (f(std::get<A>(arrays)) || ...);
}

/// The type of object to which a shape refers by prototype(); void if it refers to
/// none.
template <typename S>
struct PrototypeOf : std::type_identity<void> {};
template <typename S>
requires requires(const S& shape) {
    prototype(shape);
}
struct PrototypeOf<S>
    : std::type_identity<std::remove_cvref_t<decltype(prototype(std::declval<S>()))>> {
};

/// PrototypeOf the first shape in a list that refers to an object; void if none does.
template <typename... S>
struct PrototypeIn : std::type_identity<void> {};
template <typename First, typename... S>
struct PrototypeIn<First, S...>
    : std::conditional_t<std::is_void_v<typename PrototypeOf<First>::type>,
                         PrototypeIn<S...>, PrototypeOf<First>> {};

/// Keeps the objects to which the shapes of a scene refer. Their addresses stay the
/// same when the scene is moved.
template <typename P>
class Prototypes {
public:
    Prototypes() = default;
    /// Moves the kept objects; references to them stay valid.
    Prototypes(Prototypes&&) = default;
    /// Moves the kept objects; references to them stay valid.
    Prototypes& operator=(Prototypes&&) = default;
    const P& keep(P one) {
        kept_.push_back(std::move(one));
        return kept_.back();
    }
    /// Refuses a shape that refers to an object which is not kept here.
    /// \throws std::invalid_argument  for such a shape.
    template <typename S>
    void require_kept(const S& shape) const {
        if constexpr (!std::is_void_v<typename PrototypeOf<S>::type>) {
            const auto is_it = [mesh = &prototype(shape)](const auto& one) {
                return &one == mesh;
            };
            if (std::none_of(kept_.begin(), kept_.end(), is_it))
                throw std::invalid_argument(
                    "An instance refers to a mesh that its scene does not keep; it "
                    "must be made by Instance(scene.add(mesh), place).");
        }
    }

private:
    std::list<P> kept_; // a list, because its elements are never moved
};
/// The case of shapes that refer to nothing.
template <>
class Prototypes<void> {
public:
    template <typename S>
    void require_kept(const S&) const noexcept {}
};

} // namespace detail

/// A scene; see the specialisation.
template <typename ShapeList, typename MaterialList, typename LightList = Lights<>,
          typename MediumList = Media<>>
struct Scene;

/// A scene: shapes with their materials, lights and media, in one contiguous array per
/// type. A World is made from the finished scene. Renderers and photon passes take the
/// World.
///
///     #include <ljus/ljus.hpp> // or the header of each type, and scene/world.hpp
///
///     Scene<Shapes<Sphere>, Materials<Lambertian, Glass>, Lights<PointLight>> scene;
///     const auto grey = scene.add(Lambertian{.albedo = Rgb{0.5f}});
///     scene.add(Sphere{.center{0, 0, -3}, .radius = 1}, grey);
///     scene.add(PointLight{.position{0, 3, 0}, .intensity = Rgb{20}});
///     const World world(std::move(scene));
///
/// add() checks its arguments. The arrays may be changed in place; a World checks them
/// again.
template <typename FirstShape, typename... S, typename... M, typename... L,
          typename... P>
struct Scene<Shapes<FirstShape, S...>, Materials<M...>, Lights<L...>, Media<P...>> {
    using Scalar = ScalarOf<FirstShape>; ///< The precision, from the shapes' types.
    static_assert((std::is_same_v<Scalar, ScalarOf<S>> && ...),
                  "A scene's shapes must all have one precision.");
    static_assert((std::is_same_v<Scalar, typename M::Scalar> && ...),
                  "A scene's materials must have the precision of its shapes.");
    static_assert((std::is_same_v<Scalar, typename L::Scalar> && ...),
                  "A scene's lights must have the precision of its shapes.");
    static_assert((std::is_same_v<Scalar, typename P::Scalar> && ...),
                  "A scene's media must have the precision of its shapes.");
    static_assert(sizeof...(M) > 0, "A scene lists at least one type of material.");
    static_assert((detail::keeps_hooks<M> && ...),
                  "A material around another one hides an optional function of its "
                  "base, such as absorption(): write it for the wrapper as well.");
    static_assert(detail::each_once<FirstShape, S...> && detail::each_once<M...> &&
                      detail::each_once<L...> && detail::each_once<P...>,
                  "A scene lists each type once.");

    /// The type of object to which shapes refer: MeshT if instances are listed,
    /// otherwise void.
    using Prototype = typename detail::PrototypeIn<FirstShape, S...>::type;

    /// Whether a type of shape, material, light or medium is listed.
    template <typename X>
    static constexpr bool lists = std::is_same_v<X, FirstShape> ||
                                  (std::is_same_v<X, S> || ...) ||
                                  (std::is_same_v<X, M> || ...) ||
                                  (std::is_same_v<X, L> || ...) ||
                                  (std::is_same_v<X, P> || ...);
    /// Whether a type of medium is listed.
    static constexpr bool lists_fog = sizeof...(P) > 0;

    std::tuple<std::vector<FirstShape>, std::vector<S>...>
        shapes; ///< The shapes, an array per type.
    /// The properties of each shape, in the order of `shapes`. ObjectT::emission is the
    /// argument of add(); what the material emits is not included.
    std::array<std::vector<ObjectT<Scalar>>, 1 + sizeof...(S)> objects;
    std::tuple<std::vector<M>...> materials; ///< The materials, an array per type.
    std::tuple<std::vector<L>...> lights;    ///< The lights, an array per type.
    std::tuple<std::vector<P>...> media;     ///< The media, an array per type.
    std::vector<AddedId> order; ///< Objects and lights, in the order of addition.
    /// The meshes of instances. A scene with instances can be moved, not copied.
    detail::Prototypes<Prototype> prototypes;

    /// Adds a material.
    /// \return Its number, for adding shapes.
    /// \throws std::invalid_argument  if a value lies outside the material's range.
    template <Material B>
    requires lists<B> MaterialId add(B material) {
        check(material);
        auto& array = std::get<std::vector<B>>(materials);
        array.push_back(std::move(material));
        return {detail::type_number<B, M...>,
                static_cast<std::uint32_t>(array.size() - 1)};
    }

    /// Keeps a mesh for instances. The mesh itself is not visible.
    /// \return A reference, for making instances.
    /// \throws std::invalid_argument  if the mesh was moved from.
    template <typename X>
    requires std::is_same_v<X, Prototype> Ref<X> add(X mesh) {
        check(mesh);
        return prototypes.keep(std::move(mesh));
    }

    /// Adds a shape with a material of this scene. `radiance`, in W/(m^2 sr), is
    /// emitted on the side of the normal, in addition to the emission of the material.
    /// `inside_out` tells whether the normal points inwards, as in a room made of a
    /// sphere.
    /// \return The number of the object.
    /// \throws std::invalid_argument  if a value is out of range, or if the material is
    ///         unknown.
    template <Shape G>
    requires lists<G>
    [[gnu::cold]] ObjectId add(G shape, MaterialId material, RgbT<Scalar> radiance = {},
                               bool inside_out = false) {
        check(shape);
        prototypes.require_kept(shape);
        const ObjectT<Scalar> object{material, radiance, inside_out};
        check_emission(shape, emission_of(object));
        auto& array = std::get<std::vector<G>>(shapes);
        const ObjectId id{detail::type_number<G, FirstShape, S...>,
                          static_cast<std::uint32_t>(array.size())};
        array.push_back(std::move(shape));
        objects[id.type].push_back(object);
        order.push_back({id.type, id.index, false});
        return id;
    }

    /// Adds a light that is not an object. A black light is ignored.
    /// \throws std::invalid_argument  if a value or the flux is out of range.
    template <LightSource X>
    requires lists<X>
    void add(const X& light) {
        check(light);
        const auto flux = power(in_scene(light, SphereT<Scalar>{.radius = 1}));
        if (is_black(flux)) return;
        detail::require_flux(flux);
        auto& array = std::get<std::vector<X>>(lights);
        order.push_back({detail::type_number<X, L...>,
                         static_cast<std::uint32_t>(array.size()), true});
        array.push_back(light);
    }

    /// Adds a medium. Where several media overlap, their coefficients add up.
    /// \throws std::invalid_argument  if a value is out of range.
    template <Medium X>
    requires lists<X>
    void add(const X& medium) {
        check(medium);
        std::get<std::vector<X>>(media).push_back(medium);
    }

    /// Tells the user at compile time that a type is not listed.
    template <typename X>
    requires(!lists<X> && !std::is_same_v<X, Prototype>) MaterialId add(const X&) {
        constexpr bool light = LightSource<X>, medium = Medium<X>;
        static_assert(!light, "List the light: Scene<..., ..., Lights<...>>.");
        static_assert(!medium, "List the medium: Scene<..., ..., ..., Media<...>>.");
        static_assert(light || medium,
                      "Neither a light nor listed: Scene<..., Materials<...>>.");
        return {};
    }
    /// Tells the user at compile time that a shape is not listed, or that a material is
    /// passed instead of its number.
    template <typename G, typename Made>
    ObjectId add(const G&, const Made&, RgbT<Scalar> = {}, bool = false) {
        static_assert(lists<G>, "List the shape: Scene<Shapes<...>, ...>.");
        static_assert(!lists<G>, "Add the material first: add(shape, add(material)).");
        return {};
    }

    /// The properties of an object.
    [[nodiscard]] const ObjectT<Scalar>& object(ObjectId id) const noexcept {
        return objects[id.type][id.index];
    }

    /// The emission of an object, including that of its material, in W/(m^2 sr).
    /// \throws std::invalid_argument  if the material is unknown, if the radiance is
    ///         out of range, or if it is above 0 on a thin surface or one with holes.
    [[nodiscard]] RgbT<Scalar> emission_of(const ObjectT<Scalar>& object) const {
        const MaterialId id = object.material;
        require_radiance("emission", object.emission);
        require(id.type < sizeof...(M), "the material's type",
                static_cast<long long>(id.type), "one that add() returned");
        require(has(id), "the material's number", static_cast<long long>(id.index),
                "one that add() returned");
        const auto of_material = [&]<typename B>(const B& m) {
            const RgbT<Scalar> all = object.emission + emission(m);
            require(!ThinSurface<B> || is_black(all), "the radiance of a thin surface",
                    all, "black: light goes straight on through it");
            require(!CutOutMaterial<B> || is_black(all), "the radiance of a cut-out",
                    all, "black: a lamp shines from all of its area, holes too");
            return all;
        };
        return detail::visit_element(materials, id.type, id.index, of_material);
    }

    /// Whether a predicate on types, a lambda `[]<typename G>() { ... }`, is true for
    /// at least one listed type of shape.
    template <typename F>
    [[nodiscard]] static constexpr bool any_shape(F f) noexcept {
        return f.template operator()<FirstShape>() ||
               (f.template operator()<S>() || ...);
    }
    /// The same as any_shape(), for the listed types of materials.
    template <typename F>
    [[nodiscard]] static constexpr bool any_material(F f) noexcept {
        return (f.template operator()<M>() || ...);
    }
    /// The same as any_shape(), for the types that lights have within a World.
    template <typename F>
    [[nodiscard]] static constexpr bool any_light([[maybe_unused]] F f) noexcept {
        return (f.template operator()<InSceneT<L>>() || ...);
    }

    /// The number of lights, including emissive objects.
    [[nodiscard]] std::size_t light_count() const {
        std::size_t count = 0;
        for (const AddedId& added : order)
            count += added.is_light ||
                     !is_black(emission_of(objects[added.type][added.index]));
        return count;
    }

    /// The number of shapes.
    [[nodiscard]] std::size_t size() const noexcept {
        std::size_t sum = 0;
        for (const auto& array : objects) sum += array.size();
        return sum;
    }

private:
    template <typename G>
    void check_emission(const G& shape, const RgbT<Scalar>& radiance) const {
        if (is_black(radiance)) return;
        if constexpr (HasArea<G>)
            (void)detail::make_lamp(shape, radiance, false);
        else
            require(false, "the radiance of a shape of unknown area", radiance,
                    "black: it can be lit, but cannot be a light");
    }

    bool has(MaterialId id) const noexcept {
        std::uint32_t type = 0;
        return detail::any_array(materials, [&](const auto& array) {
            return type++ == id.type && id.index < array.size();
        });
    }
};

/// \}

} // namespace ljus
