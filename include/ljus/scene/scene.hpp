#pragma once

/// \file ljus/scene/scene.hpp
/// \brief Shapes, what they are made of, and what emits: plain data.

#include <array>
#include <cstddef>
#include <tuple>
#include <vector>

#include "ljus/materials/material.hpp"
#include "ljus/scene/make_light.hpp"

namespace ljus {

/// \defgroup scene Scenes
/// \brief A scene lists the types it is made of; what is not listed costs nothing.
/// \{

/// The closed list of a scene's shape types.
template <Shape... S>
struct Shapes {};

/// The closed list of a scene's material types.
template <Material... M>
struct Materials {};

/// A scene; see the specialisation.
template <typename ShapeList, typename MaterialList>
struct Scene;

/// Shapes with their materials, and lights: one contiguous array a type.
///
///     Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass>> scene;
///     const auto grey = scene.add(Lambertian{.albedo = Rgb{0.5f}});
///     scene.add(Sphere{.center{0, 0, -3}, .radius = 1}, grey);
///     scene.add(PointLight{.position{0, 3, 0}, .intensity = Rgb{20}});
///
/// What is added is checked; lights are collected as they come, and keep their numbers.
template <typename FirstShape, typename... S, typename... M>
struct Scene<Shapes<FirstShape, S...>, Materials<M...>> {
    using Scalar = ScalarOf<FirstShape>; ///< The precision, from the shapes' types.
    static_assert((std::is_same_v<Scalar, ScalarOf<S>> && ...),
                  "A scene's shapes must all have one precision.");
    static_assert((std::is_same_v<Scalar, typename M::Scalar> && ...),
                  "A scene's materials must have the precision of its shapes.");
    static_assert(sizeof...(M) > 0, "A scene lists at least one type of material.");
    static_assert(detail::each_once<FirstShape, S...> && detail::each_once<M...>,
                  "A scene lists each type once.");

    /// Whether a type of shape or of material is listed.
    template <typename X>
    static constexpr bool lists = std::is_same_v<X, FirstShape> ||
                                  (std::is_same_v<X, S> || ...) ||
                                  (std::is_same_v<X, M> || ...);

    std::tuple<std::vector<FirstShape>, std::vector<S>...> shapes; ///< An array a type.
    /// What each shape is made of, in the order of `shapes`.
    std::array<std::vector<detail::ObjectT<Scalar>>, 1 + sizeof...(S)> objects;
    std::tuple<std::vector<M>...> materials; ///< An array a type.
    std::vector<LightT<Scalar>> lights;      ///< Emissive objects, and the others.
    Vec3T<Scalar> low{Scalar(0)};    ///< Least corner of a box around all shapes.
    Vec3T<Scalar> high{Scalar(0)};   ///< Its greatest corner.
    std::vector<std::uint32_t> suns; ///< Which lights are suns.

    /// Adds a material.
    /// \param material  One of the listed types.
    /// \return Its number, for the shapes that are made of it.
    /// \throws std::invalid_argument  if a value lies outside the material's range.
    template <Material B>
    requires lists<B> MaterialId add(const B& material) {
        check(material);
        auto& array = std::get<std::vector<B>>(materials);
        array.push_back(material);
        return {detail::type_number<B, M...>,
                static_cast<std::uint32_t>(array.size() - 1)};
    }

    /// Adds a shape.
    /// \param shape     One of the listed types.
    /// \param material  What add() returned for its material.
    /// \param radiance  The radiance it emits along its normal's side, W/(m^2 sr);
    ///                  added to what the material itself emits.
    /// \param inside_out  Whether the normal points inwards, as in a room made of a
    ///                  sphere.
    /// \return Its number.
    /// \throws std::invalid_argument  if a value is out of range, or the material
    ///                                unknown.
    template <Shape G>
    requires lists<G> ObjectId add(const G& shape, MaterialId material,
                                   RgbT<Scalar> radiance = {},
                                   bool inside_out = false) {
        check(shape);
        radiance = emitted_radiance(material, radiance);
        auto& array = std::get<std::vector<G>>(shapes);
        const ObjectId id{detail::type_number<G, FirstShape, S...>,
                          static_cast<std::uint32_t>(array.size())};
        if constexpr (!HasArea<G>)
            require(is_black(radiance), "the radiance of a shape of unknown area",
                    radiance, "black: it can be lit, but cannot be a light");
        else if (!is_black(radiance)) {
            add_light(id, radiance, area(shape));
            if constexpr (detail::is_plane<G>) {
                lights.back().direction = normal(shape);
                lights.back().area = area(shape);
            }
        }
        reach(bounding_sphere(shape));
        array.push_back(shape);
        const std::uint32_t light = is_black(radiance)
                                        ? detail::no_light
                                        : static_cast<std::uint32_t>(lights.size() - 1);
        objects[id.type].push_back({material, radiance, inside_out, light});
        return id;
    }

    /// A mistake: it does not compile, and says why.
    template <typename X>
    requires(!((std::is_same_v<X, M> || ...) ||
               std::is_convertible_v<X, detail::AnyLightT<Scalar>>)) MaterialId
        add(const X&) {
        static_assert(sizeof(X) == 0,
                      "Neither a light nor listed: Scene<..., Materials<...>>.");
        return {};
    }
    /// Another one.
    template <typename G, typename Made>
    ObjectId add(const G&, const Made&, RgbT<Scalar> = {}, bool = false) {
        static_assert(lists<G>, "List the shape: Scene<Shapes<...>, ...>.");
        static_assert(!lists<G>, "Add the material first: add(shape, add(material)).");
        return {};
    }

    /// Adds a light that is no object. A sun's flux is what falls into a sphere around
    /// all shapes; it grows with each that is added, before or after.
    /// \param light  A PointLight, a SpotLight, a SunLight, or another LightSource of
    ///               the scene's precision.
    /// \throws std::invalid_argument  if a value is out of range, or the flux.
    void add(const detail::AnyLightT<Scalar>& light) {
        LightT<Scalar> made = light.made;
        if (is_black(made.emission)) return;
        if (made.kind != LightKind::sun) {
            detail::require_flux(made.flux);
        } else {
            if (size() > 0) detail::widen(made, low, high);
            suns.push_back(static_cast<std::uint32_t>(lights.size()));
        }
        lights.push_back(made);
    }

    /// What the scene knows of a shape besides its geometry.
    [[nodiscard]] const detail::ObjectT<Scalar>& object(ObjectId id) const noexcept {
        return objects[id.type][id.index];
    }

    /// Calls f(shape) with the shape of a number, as its own type.
    template <typename F>
    decltype(auto) visit_shape(ObjectId id, F&& f) const {
        return visit<0>(shapes, id.type, id.index, f);
    }
    /// Calls f(material) with the material of a number, as its own type.
    template <typename F>
    decltype(auto) visit_material(MaterialId id, F&& f) const {
        return visit<0>(materials, id.type, id.index, f);
    }

    /// Whether a predicate on types, a lambda `[]<typename G>() { ... }`, holds for one
    /// of the listed shapes.
    template <typename F>
    [[nodiscard]] static constexpr bool any_shape(F f) noexcept {
        return f.template operator()<FirstShape>() ||
               (f.template operator()<S>() || ...);
    }
    /// The same for the listed materials.
    template <typename F>
    [[nodiscard]] static constexpr bool any_material(F f) noexcept {
        return (f.template operator()<M>() || ...);
    }

    /// How many shapes there are.
    [[nodiscard]] std::size_t size() const noexcept {
        std::size_t sum = 0;
        for (const auto& array : objects) sum += array.size();
        return sum;
    }

private:
    // What an object emits, with what its material does: the same for all shapes.
    RgbT<Scalar> emitted_radiance(MaterialId material, RgbT<Scalar> radiance) const {
        require_radiance("emission", radiance);
        require(material.type < sizeof...(M), "the material's type",
                static_cast<long long>(material.type), "one that add() returned");
        require(has(material), "the material's number",
                static_cast<long long>(material.index), "one that add() returned");
        radiance += visit_material(material, [](const auto& m) { return emission(m); });
        const bool thin = visit_material(material, [](const auto& m) {
            return requires {
                pass_through(m, Vec3T<Scalar>{}, Vec3T<Scalar>{});
            };
        });
        require(!thin || is_black(radiance), "the radiance of a thin surface", radiance,
                "black: light goes straight on through it");
        return radiance;
    }

    void add_light(ObjectId id, const RgbT<Scalar>& radiance, Scalar area) {
        require_positive("the area of a light", area);
        const RgbT<Scalar> flux = detail::diffuse_flux(radiance, area);
        detail::require_flux(flux);
        lights.push_back({.kind = LightKind::object,
                          .object = id,
                          .emission = radiance,
                          .flux = flux});
    }

    // Widens the box, and with it what each sun has to light.
    void reach(const SphereT<Scalar>& bound) {
        const bool first = size() == 0;
        const Vec3T<Scalar> from = bound.center - bound.radius;
        const Vec3T<Scalar> to = bound.center + bound.radius;
        low = first ? from : glm::min(low, from);
        high = first ? to : glm::max(high, to);
        for (const std::uint32_t sun : suns) detail::widen(lights[sun], low, high);
    }

    bool has(MaterialId id) const noexcept {
        std::uint32_t place = 0;
        return std::apply(
            [&](const auto&... array) {
                return ((place++ == id.type && id.index < array.size()) || ...);
            },
            materials);
    }

    // The last type needs no comparison: with one type listed, none is made at all.
    template <std::size_t I, typename Tuple, typename F>
    static decltype(auto) visit(const Tuple& arrays, std::uint32_t type,
                                std::uint32_t index, F& f) {
        if constexpr (I + 1 < std::tuple_size_v<Tuple>) {
            if (type != I) return visit<I + 1>(arrays, type, index, f);
        }
        return f(std::get<I>(arrays)[index]);
    }
};

/// \}

} // namespace ljus
