#pragma once

/// \file ljus/materials/textured.hpp
/// \brief Any material with something that varies over its surface.

#include "ljus/image/texture.hpp"
#include "ljus/materials/material.hpp"

namespace ljus {

/// \defgroup textured Textured materials
/// \brief A material that varies over the surface: in colour, by holes or by normals.
///
/// Renderers call material_at(), which calls at_point(). A plain material has no
/// at_point() and is used as it is; a textured one returns its base in the colour of
/// the point. So a scene without textures compiles nothing of this. A base may be
/// textured itself.
/// \{

/// A material whose colour is multiplied by that of a texture; or with Holes or a
/// NormalMap in place of the texture, which leave its colour. As a MaterialWrapper it
/// scatters in the colour that the base itself has; material_at() has the texture's.
template <Material Base, typename Texture>
struct Textured {
    using Scalar = typename Base::Scalar;          ///< The precision of its numbers.
    static constexpr bool scatters_as_base = true; ///< A MaterialWrapper.
    /// As the texture or the base declares it.
    static constexpr bool uses_uv = UsesUv<Texture> || UsesUv<Base>;
    Base base{};       ///< White, if the texture's colour is to be kept.
    Texture texture{}; ///< Colours within [0, 1].
};

namespace detail {

/// A material with its `albedo`, `reflectance`, `tint` or `color` multiplied.
template <Material Base>
[[nodiscard]] constexpr Base
colored(Base base, const RgbT<typename Base::Scalar>& color) noexcept {
    if constexpr (requires { base.albedo *= color; })
        base.albedo *= color;
    else if constexpr (requires { base.reflectance *= color; })
        base.reflectance *= color;
    else if constexpr (requires { base.tint *= color; })
        base.tint *= color;
    else
        base.color *= color;
    return base;
}

} // namespace detail

/// The material at a point: the base there, in the texture's colour if it has one.
/// \cost color_at() of the texture.
// [at_point]
template <typename Base, typename Texture, std::floating_point T>
[[nodiscard]] decltype(auto) at_point(const Textured<Base, Texture>& textured,
                                      const Vec3T<T>& position,
                                      const Vec2T<T>& uv) noexcept {
    if constexpr (requires { color_at(textured.texture, position, uv); })
        return detail::colored(material_at(textured.base, position, uv),
                               color_at(textured.texture, position, uv));
    else
        return material_at(textured.base, position, uv);
}
// [at_point]

/// The transmittance of a textured pane. Its texture may depend on the position only,
/// because uv is not known here.
/// \return The base's transmittance per channel.
template <typename Base, typename Texture, std::floating_point T>
[[nodiscard]] auto pass_through(const Textured<Base, Texture>& textured,
                                const Vec3T<T>& position, const Vec3T<T>& wo) noexcept
    -> decltype(pass_through(textured.base, position, wo)) {
    static_assert(!Textured<Base, Texture>::uses_uv,
                  "The texture of a pane must not use uv: "
                  "give it a PlaneMap or a GlobeMap.");
    return pass_through(at_point(textured, position, Vec2T<T>{T(0)}), position, wo);
}

/// \name Functions of the base
/// They answer for the whole material: for a survey, or when a shape is added.
/// \{

/// The base's absorption coefficient inside, if it has one: a matt base is no body.
/// \return Per scene unit.
template <MayAbsorb Base, typename Texture>
[[nodiscard]] constexpr RgbT<typename Base::Scalar>
absorption(const Textured<Base, Texture>& m) noexcept {
    return absorption(m.base);
}

/// The base's emitted radiance, everywhere.
/// \return W/(m^2 sr).
template <typename Base, typename Texture>
[[nodiscard]] constexpr RgbT<typename Base::Scalar>
emission(const Textured<Base, Texture>& m) noexcept {
    return emission(m.base);
}

/// \}

/// Checks the base and the texture.
/// \throws std::invalid_argument naming the member.
template <typename Base, typename Texture>
void check(const Textured<Base, Texture>& textured) {
    check(textured.base);
    check(textured.texture);
}

/// \}

} // namespace ljus
