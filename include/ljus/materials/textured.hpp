#pragma once

/// \file ljus/materials/textured.hpp
/// \brief Any material with a colour, its colour from a texture.

#include "ljus/image/texture.hpp"
#include "ljus/materials/material.hpp"

namespace ljus {

/// \defgroup textured Textured materials
/// \brief A material that becomes another one at each place.
///
/// Renderers ask material_at(), which asks at_point(): a plain material has none and is
/// itself, a textured one answers with its base in the colour of the place. So no plain
/// material knows of textures, and a scene without them compiles nothing of this.
/// \{

/// A material whose colour is multiplied by a texture's.
template <Material Base, typename Texture>
struct Textured {
    using Scalar = typename Base::Scalar;            ///< The precision of its numbers.
    static constexpr bool uses_uv = UsesUv<Texture>; ///< As its texture says.
    Base base{};       ///< White, if the texture's colour shall stay.
    Texture texture{}; ///< In [0, 1] everywhere.
};

namespace detail {

/// A material in another colour; its `albedo`, `reflectance`, `tint` or `color` is it.
/// \param base   The material.
/// \param color  What its colour is multiplied by.
/// \return The same material in the new colour.
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

/// The material of a place: the base in the texture's colour.
/// \param textured  The material.
/// \param position  In scene units.
/// \param uv        The coordinates of the place on its shape.
/// \return A base material.
/// \cost color_at() of the texture.
// [at_point]
template <typename Base, typename Texture, std::floating_point T>
[[nodiscard]] Base at_point(const Textured<Base, Texture>& textured,
                            const Vec3T<T>& position, const Vec2T<T>& uv) noexcept {
    const RgbT<T> color = color_at(textured.texture, position, uv);
    return detail::colored(textured.base, color);
}
// [at_point]

/// What goes straight on through a textured pane; only of a base that is thin, and of a
/// texture that looks up by the place alone, which is all that is known here.
/// \param textured  The material.
/// \param position  Where.
/// \param wo        Unit vector in the surface's frame, to where the light goes.
/// \return Of each channel, what the base lets through there.
template <typename Base, typename Texture, std::floating_point T>
[[nodiscard]] auto pass_through(const Textured<Base, Texture>& textured,
                                const Vec3T<T>& position, const Vec3T<T>& wo) noexcept
    -> decltype(pass_through(textured.base, position, wo)) {
    static_assert(!UsesUv<Texture>,
                  "The texture of a pane looks up by the place, not by uv.");
    const Base here = at_point(textured, position, Vec2T<T>{T(0)});
    return pass_through(here, position, wo);
}

/// \name What the base says
/// What is asked of no place in particular: by a survey, or when a shape is added.
/// \{

/// The parts of the base.
/// \param m  The material.
template <typename Base, typename Texture>
[[nodiscard]] constexpr Lobes lobes(const Textured<Base, Texture>& m) noexcept {
    return lobes(m.base);
}

/// The absorption inside: the base's.
/// \param m  The material.
/// \return Per scene unit.
template <typename Base, typename Texture>
[[nodiscard]] constexpr RgbT<typename Base::Scalar>
absorption(const Textured<Base, Texture>& m) noexcept {
    return absorption(m.base);
}

/// The emitted radiance: the base's, everywhere.
/// \param m  The material.
/// \return W/(m^2 sr).
template <typename Base, typename Texture>
[[nodiscard]] constexpr RgbT<typename Base::Scalar>
emission(const Textured<Base, Texture>& m) noexcept {
    return emission(m.base);
}

/// f of the base in its own colour; that of a place is evaluate(material_at(m, ...)).
/// \param m   The material.
/// \param wo  Unit vector in the surface's frame, to where the light goes.
/// \param wi  Unit vector in the surface's frame, to where it comes from.
/// \return f in 1/sr, without the cosine.
template <typename Base, typename Texture, std::floating_point T>
[[nodiscard]] RgbT<T> evaluate(const Textured<Base, Texture>& m, const Vec3T<T>& wo,
                               const Vec3T<T>& wi) noexcept {
    return evaluate(m.base, wo, wi);
}

/// The density of the base's sample().
/// \param m      The material.
/// \param wo     Unit vector in the surface's frame, to where the light goes.
/// \param wi     Unit vector in the surface's frame, to where it comes from.
/// \param which  The parts to sample from.
/// \return Per steradian.
template <typename Base, typename Texture, std::floating_point T>
[[nodiscard]] T pdf(const Textured<Base, Texture>& m, const Vec3T<T>& wo,
                    const Vec3T<T>& wi, Lobes which = Lobes::all) noexcept {
    return pdf(m.base, wo, wi, which);
}

/// A sample of the base in its own colour.
/// \param m          The material.
/// \param wo         Unit vector in the surface's frame, to where the light goes.
/// \param u          Point of [0,1)^3.
/// \param transport  Radiance or flux.
/// \param which      The parts to sample from.
/// \return The sample; nothing as for the base.
template <typename Base, typename Texture, std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const Textured<Base, Texture>& m, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport transport, Lobes which = Lobes::all) noexcept {
    return sample(m.base, wo, u, transport, which);
}

/// \}

/// Refuses what the base or the texture refuses.
/// \param textured  The material.
/// \throws std::invalid_argument naming the member.
template <typename Base, typename Texture>
void check(const Textured<Base, Texture>& textured) {
    check(textured.base);
    check(textured.texture);
}

/// \}

} // namespace ljus
