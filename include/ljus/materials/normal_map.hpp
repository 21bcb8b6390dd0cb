#pragma once

/// \file ljus/materials/normal_map.hpp
/// \brief Materials whose shading normals come from a picture.

#include "ljus/materials/textured.hpp"

namespace ljus {

/// \defgroup normal_map Normal maps
/// \brief Dents and grooves that are only shaded \cite blinn1978. Chapter:
/// \ref ch_textures.
///
/// The picture turns the shading normal, and nothing else: outlines, shadows and the
/// side of a direction are those of the shape. What two normals at one point mean for
/// light and photons is in chapter \ref ch_shading_normals.
/// \{

/// A picture of normals, in place of a texture of Textured. Red, green and blue are
/// (1 + n)/2 of a normal n: along u, along v, and outwards.
template <std::floating_point T>
struct NormalMapT {
    static constexpr bool uses_uv = true;    ///< It is in the coordinates of the shape.
    PictureTextureT<T, UvMapT<T>> picture{}; ///< Numbers, not colours; load_image().
};
using NormalMap = NormalMapT<float>; ///< NormalMapT in float.

/// The normal of a material in the directions of its shape's coordinates.
/// \param mapped  The material.
/// \param uv      From texture_coordinates().
/// \return x along u, y along v, z outwards; of any length. Exactly (0, 0, 1) for the
///         colour (0.5, 0.5, 1).
/// \cost color_at() of the picture.
template <typename Base, std::floating_point T>
[[nodiscard]] Vec3T<T> normal_at(const Textured<Base, NormalMapT<T>>& mapped,
                                 const Vec2T<T>& uv) noexcept {
    const auto& picture = mapped.texture.picture;
    const Vec3T<T> n = T(2) * color_at(picture, Vec3T<T>{T(0)}, uv) - T(1);
    return {direction_on_shape(picture.map, Vec2T<T>{n.x, n.y}), n.z};
}

/// The same for a textured material over one with a normal map.
template <typename Base, typename Texture, std::floating_point T>
requires NormalMapped<Base>
[[nodiscard]] Vec3T<T> normal_at(const Textured<Base, Texture>& textured,
                                 const Vec2T<T>& uv) noexcept {
    return normal_at(textured.base, uv);
}

/// Checks the picture.
/// \throws std::invalid_argument  naming the member.
template <std::floating_point T>
void check(const NormalMapT<T>& map) {
    check(map.picture);
}

/// \}

} // namespace ljus
