#pragma once

/// \file ljus/materials/textured.hpp
/// \brief Materials that vary over the surface.

#include "ljus/image/texture.hpp"
#include "ljus/materials/material.hpp"

namespace ljus {

/// \defgroup textured Textured materials
/// \brief Materials whose colour, holes or normals vary over the surface.
///
/// For a textured material, material_at() calls at_point(), which multiplies the base
/// by the colour of the texture at the point. The base may be textured itself.
/// \{

/// A material whose colour is multiplied by that of a texture. Holes, a NormalMap or a
/// Priority in place of the texture leave the colour unchanged. sample() and evaluate()
/// of this type ignore the texture; renderers call those of material_at().
template <Material Base, typename Texture>
struct Textured {
    using Scalar = typename Base::Scalar;          ///< The precision of its numbers.
    static constexpr bool scatters_as_base = true; ///< Scattering is that of the base.
    /// True if the texture or the base uses uv.
    static constexpr bool uses_uv = UsesUv<Texture> || UsesUv<Base>;
    Base base{};       ///< The material; a white one keeps the texture's colours.
    Texture texture{}; ///< The texture, with colours within [0, 1].
};

namespace detail {

/// A copy of a material whose `albedo`, `reflectance`, `tint` or `color` is multiplied
/// by a colour.
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

/// The material at a point: the base at that point, multiplied by the colour of the
/// texture.
/// \cost That of color_at() of the texture.
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

/// The transmittance of a textured pane, in each channel. The texture must depend on
/// the position only, because a shadow ray does not compute uv.
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
/// \{

/// The absorption coefficient inside the base, per scene unit.
template <MayAbsorb Base, typename Texture>
[[nodiscard]] constexpr RgbT<typename Base::Scalar>
absorption(const Textured<Base, Texture>& m) noexcept {
    return absorption(m.base);
}

/// The index of refraction inside; 0 if the base is opaque.
template <Refractive Base, typename Texture>
[[nodiscard]] constexpr auto
refractive_index(const Textured<Base, Texture>& m) noexcept {
    return refractive_index(m.base);
}

/// The base at one wavelength, if it disperses light.
template <Dispersive Base, typename Texture, std::floating_point T>
[[nodiscard]] constexpr auto at_wavelength(const Textured<Base, Texture>& m,
                                           T nm) noexcept {
    return at_wavelength(m.base, nm);
}

/// The priority of the base where bodies overlap.
template <HasPriority Base, typename Texture>
[[nodiscard]] constexpr int priority(const Textured<Base, Texture>& m) noexcept {
    return priority(m.base);
}

/// The picture of a base that shows one. The texture does not change it.
template <ShowsPicture Base, typename Texture>
[[nodiscard]] const auto& emission_picture(const Textured<Base, Texture>& m) noexcept {
    return emission_picture(m.base);
}

/// The emitted radiance of the base, in W/(m^2 sr). The texture does not change it.
template <typename Base, typename Texture>
[[nodiscard]] constexpr RgbT<typename Base::Scalar>
emission(const Textured<Base, Texture>& m) noexcept {
    return emission(m.base);
}

/// \}

/// Checks the base and the texture.
/// \throws std::invalid_argument  with the name of the member that is not valid.
template <typename Base, typename Texture>
void check(const Textured<Base, Texture>& textured) {
    check(textured.base);
    check(textured.texture);
}

/// \}

} // namespace ljus
