#pragma once

/// \file ljus/materials/normal_map.hpp
/// \brief Materials whose shading normals come from a picture.

#include <algorithm>

#include "ljus/materials/textured.hpp"

namespace ljus {

/// \defgroup normal_map Normal maps
/// \brief Dents and grooves that change the shading but not the shape \cite blinn1978.
/// Chapter: \ref ch_textures.
///
/// The picture turns only the shading normal. The geometric normal, the outlines and
/// the shadows remain those of the shape.
///
/// Photons between such surfaces lose light where the two normals disagree about a
/// direction. Indirect light from photons is therefore too dark, and darker the more
/// the normals lean; IndirectLight::rays has no such bias.
/// \{

/// A picture of normals, for Textured. Red, green and blue are (1 + n)/2, where n is
/// the component of the normal along u, along v, and outwards, respectively.
template <std::floating_point T>
struct NormalMapT {
    static constexpr bool uses_uv = true; ///< The picture is looked up by uv.
    /// The picture, loaded as numbers and not as colours; see load_image().
    PictureTextureT<T, UvMapT<T>> picture{};
};
using NormalMap = NormalMapT<float>; ///< NormalMapT in float.

/// The shading normal that the picture of a material gives at `uv`.
/// \return A normal of any length, with x along u, y along v and z outwards. It is
///         exactly (0, 0, 1) for the colour (0.5, 0.5, 1).
/// \cost That of color_at() of the picture.
template <typename Base, std::floating_point T>
[[nodiscard]] Vec3T<T> normal_at(const Textured<Base, NormalMapT<T>>& mapped,
                                 const Vec2T<T>& uv) noexcept {
    static_assert(!NormalMapped<Base>, "A material has one normal map, not two.");
    const auto& picture = mapped.texture.picture;
    const Vec3T<T> n = T(2) * color_at(picture, Vec3T<T>{T(0)}, uv) - T(1);
    return {direction_on_shape(picture.map, Vec2T<T>{n.x, n.y}), n.z};
}

/// The shading normal of a textured material whose base has a normal map.
template <typename Base, typename Texture, std::floating_point T>
requires NormalMapped<Base>
[[nodiscard]] Vec3T<T> normal_at(const Textured<Base, Texture>& textured,
                                 const Vec2T<T>& uv) noexcept {
    return normal_at(textured.base, uv);
}

/// Whether the picture turns any normal: false if red and green are 0.5 in each pixel.
template <std::floating_point T>
[[nodiscard]] bool turns_normals(const NormalMapT<T>& map) {
    const auto& pixels = map.picture.image.pixels;
    return !std::all_of(pixels.begin(), pixels.end(), [](const RgbT<T>& color) {
        return color.x == T(0.5) && color.y == T(0.5);
    });
}

/// Checks the picture.
template <std::floating_point T>
void check(const NormalMapT<T>& map) {
    check(map.picture);
}

/// \}

} // namespace ljus
