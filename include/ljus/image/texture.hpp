#pragma once

/// \file ljus/image/texture.hpp
/// \brief Colours that change from place to place: checkers and images.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "ljus/image/image.hpp"
#include "ljus/math/require.hpp"
#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup texture Textures
/// \brief A map from the place to (u, v), and a colour for (u, v).
///
/// A texture is anything with a `color_at(texture, place, uv)` and a `check(texture)`;
/// a map is anything with a `map_coordinates(map, place, uv)` and a `check(map)`. `uv`
/// are the coordinates of the place on its own shape, see texture_coordinates(); a
/// texture gets them only if it says `static constexpr bool uses_uv = true`, and else
/// (0, 0).
/// Both kinds here repeat: (u, v) and (u + 1, v) look the same.
/// \{

/// Coordinates of a plane, projected straight onto everything: `origin` is (0, 0),
/// `origin + edge_u` is (1, 0).
template <std::floating_point T>
struct PlaneMapT {
    Vec3T<T> origin{T(0)};             ///< Where (u, v) = (0, 0).
    Vec3T<T> edge_u{T(1), T(0), T(0)}; ///< As long as one repetition, in scene units.
    Vec3T<T> edge_v{T(0), T(0), T(1)}; ///< At right angles to edge_u.
};
using PlaneMap = PlaneMapT<float>; ///< PlaneMapT in float.

/// Longitude and latitude around a centre, north along y: u in [0, 1) once around from
/// +x towards -z, v from 0 at the south pole to 1 at the north pole.
template <std::floating_point T>
struct GlobeMapT {
    Vec3T<T> center{T(0)}; ///< Of the globe.
};
using GlobeMap = GlobeMapT<float>; ///< GlobeMapT in float.

/// The coordinates that the shape itself has, as a mesh has them from its file.
template <std::floating_point T>
struct UvMapT {
    static constexpr bool uses_uv = true; ///< See texture_coordinates().
    Vec2T<T> scale{T(1)};                 ///< Repetitions from u, v = 0 to 1.
};
using UvMap = UvMapT<float>; ///< UvMapT in float.

/// Whether a map, a texture or a material looks up by the coordinates of the shape.
template <typename M>
concept UsesUv = M::uses_uv;

/// The coordinates of a place.
/// \param map    The plane.
/// \param place  In scene units.
/// \return (u, v), in repetitions.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> map_coordinates(const PlaneMapT<T>& map, const Vec3T<T>& place,
                                       const Vec2T<T>& = Vec2T<T>{T(0)}) noexcept {
    const Vec3T<T> from = place - map.origin;
    return {glm::dot(from, map.edge_u) / glm::dot(map.edge_u, map.edge_u),
            glm::dot(from, map.edge_v) / glm::dot(map.edge_v, map.edge_v)};
}

/// The coordinates of a place on a globe; (0, 0.5) at its centre.
/// \param map    The globe.
/// \param place  In scene units.
/// \return (u, v) in [0, 1].
/// \cost Two arc tangents.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> map_coordinates(const GlobeMapT<T>& map, const Vec3T<T>& place,
                                       const Vec2T<T>& = Vec2T<T>{T(0)}) noexcept {
    return globe_coordinates(place - map.center);
}

/// The coordinates of a place on its own shape.
/// \param map  How often they repeat.
/// \param uv   Of texture_coordinates().
/// \return (u, v), in repetitions.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> map_coordinates(const UvMapT<T>& map, const Vec3T<T>& /*place*/,
                                       const Vec2T<T>& uv) noexcept {
    return map.scale * uv;
}

/// Refuses a plane whose edges span none.
/// \param map  The plane.
/// \throws std::invalid_argument naming the edge.
template <std::floating_point T>
void check(const PlaneMapT<T>& map) {
    require_finite("plane_map.origin", map.origin);
    const T u2 = glm::dot(map.edge_u, map.edge_u);
    const T v2 = glm::dot(map.edge_v, map.edge_v);
    require(std::isnormal(u2), "plane_map.edge_u", map.edge_u, "finite and not 0");
    require(std::isnormal(v2), "plane_map.edge_v", map.edge_v, "finite and not 0");
}

/// Refuses a globe without a place.
/// \param map  The globe.
/// \throws std::invalid_argument naming the centre.
template <std::floating_point T>
void check(const GlobeMapT<T>& map) {
    require_finite("globe_map.center", map.center);
}

/// Refuses coordinates that do not change.
/// \param map  The map.
/// \throws std::invalid_argument naming the scale.
template <std::floating_point T>
void check(const UvMapT<T>& map) {
    for (const T scale : {map.scale.x, map.scale.y})
        require(std::isnormal(scale), "uv_map.scale", scale, "finite and not 0");
}

/// Two colours in turn, as on a chessboard of `columns` by `rows` fields.
///
/// On a plane, not in space: a solid checker with a border in y = 0 decides by rounding
/// which colour a floor at y = 0 has, pixel by pixel.
template <std::floating_point T, typename Map = PlaneMapT<T>>
struct CheckerT {
    static constexpr bool uses_uv = UsesUv<Map>; ///< As its map says.
    Map map{};                                   ///< From the place to (u, v).
    RgbT<T> even{T(0.9)};                        ///< The colour of the field at (0, 0).
    RgbT<T> odd{T(0.1)};                         ///< The colour of its neighbours.
    int columns = 2; ///< Fields on the way from u = 0 to 1; even.
    int rows = 2;    ///< Fields on the way from v = 0 to 1; even.
};
using Checker = CheckerT<float>;                        ///< On a plane, in float.
using GlobeChecker = CheckerT<float, GlobeMapT<float>>; ///< On a globe, in float.

/// The colour of a place.
/// \param checker  The texture.
/// \param place    In scene units.
/// \param uv       Of texture_coordinates(); for a UvMap.
/// \return One of the two colours.
template <std::floating_point T, typename Map>
[[nodiscard]] RgbT<T> color_at(const CheckerT<T, Map>& checker, const Vec3T<T>& place,
                               const Vec2T<T>& uv = Vec2T<T>{T(0)}) noexcept {
    const Vec2T<T> at = map_coordinates(checker.map, place, uv);
    const T field =
        std::floor(at.x * T(checker.columns)) + std::floor(at.y * T(checker.rows));
    return std::abs(std::fmod(field, T(2))) < T(0.5) ? checker.even : checker.odd;
}

/// Refuses colours outside [0, 1], and numbers of fields that do not repeat.
/// \param checker  The texture.
/// \throws std::invalid_argument naming the member.
template <std::floating_point T, typename Map>
void check(const CheckerT<T, Map>& checker) {
    check(checker.map);
    require_unit("checker.even", checker.even);
    require_unit("checker.odd", checker.odd);
    const auto fields = [](const char* what, int count) {
        require(count >= 2 && count % 2 == 0 && count <= 1000000, what,
                static_cast<long long>(count), "even, from 2 to 1000000");
    };
    fields("checker.columns", checker.columns);
    fields("checker.rows", checker.rows);
}

/// An image, its lower left corner at (0, 0), its upper right one at (1, 1).
template <std::floating_point T, typename Map = PlaneMapT<T>>
struct PictureTextureT {
    static constexpr bool uses_uv = UsesUv<Map>; ///< As its map says.
    ImageT<T> image{}; ///< Linear colours in [0, 1], see load_image().
    Map map{};         ///< From the place to (u, v).
};
using PictureTexture = PictureTextureT<float>; ///< On a plane, in float.
/// By the coordinates of the shape, in float.
using UvPicture = PictureTextureT<float, UvMapT<float>>;

/// The colour of a place: of the four pixels whose middles are around it, in proportion
/// to how near they are.
/// \param texture  The texture.
/// \param place    In scene units.
/// \param uv       Of texture_coordinates(); for a UvMap.
/// \return A colour between those of the four pixels.
template <std::floating_point T, typename Map>
[[nodiscard]] RgbT<T> color_at(const PictureTextureT<T, Map>& texture,
                               const Vec3T<T>& place,
                               const Vec2T<T>& uv = Vec2T<T>{T(0)}) noexcept {
    const ImageT<T>& image = texture.image;
    const Vec2T<T> at = map_coordinates(texture.map, place, uv);
    // Below 1 even after rounding, and 0 for what is no number.
    const auto repeat = [](T x) {
        const T rest = x - std::floor(x);
        return rest < T(1) ? rest : T(0);
    };
    const T x = repeat(at.x) * T(image.width) - T(0.5);
    const T y = (T(1) - repeat(at.y)) * T(image.height) - T(0.5);
    const T left = std::floor(x), top = std::floor(y);
    const auto color = [&](T column, T row) {
        const int i = (static_cast<int>(column) + image.width) % image.width;
        const int j = (static_cast<int>(row) + image.height) % image.height;
        return pixel(image, i, j);
    };
    const T dx = x - left, dy = y - top;
    return (T(1) - dy) * ((T(1) - dx) * color(left, top) + dx * color(left + 1, top)) +
           dy * ((T(1) - dx) * color(left, top + 1) + dx * color(left + 1, top + 1));
}

/// Refuses an image without pixels, or with a channel outside [0, 1].
/// \param texture  The texture.
/// \throws std::invalid_argument naming the image or the pixel.
template <std::floating_point T, typename Map>
void check(const PictureTextureT<T, Map>& texture) {
    check(texture.map);
    check(texture.image);
    for (int y = 0; y < texture.image.height; ++y)
        for (int x = 0; x < texture.image.width; ++x)
            require_unit(std::string("picture_texture.image, pixel (")
                             .append(std::to_string(x))
                             .append(", ")
                             .append(std::to_string(y))
                             .append(")"),
                         pixel(texture.image, x, y));
}

/// \}

} // namespace ljus
