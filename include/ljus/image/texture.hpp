#pragma once

/// \file ljus/image/texture.hpp
/// \brief Colours that vary over a surface: checkers and images.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "ljus/image/image.hpp"
#include "ljus/math/require.hpp"
#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup texture Textures
/// \brief A map gives (u, v) for each point of a surface. A texture gives a colour for
/// each (u, v).
///
/// A texture is a type with the functions `color_at(texture, place, uv)` and
/// `check(texture)`. A map is a type with the functions
/// `map_coordinates(map, place, uv)` and `check(map)`. `place` is the point in scene
/// units, and `uv` are the coordinates of the point on its own shape, see
/// texture_coordinates(). A type receives `uv` only if it declares
/// `static constexpr bool uses_uv = true`; otherwise `uv` is (0, 0). The textures
/// Checker and PictureTexture repeat with period 1 in u and in v; PictureWrap has
/// alternatives for pictures.
/// \{

/// Projects each point of a surface orthogonally onto a plane.
template <std::floating_point T>
struct PlaneMapT {
    Vec3T<T> origin{T(0)}; ///< The point with (u, v) = (0, 0).
    /// The edge from u = 0 to u = 1, in scene units.
    Vec3T<T> edge_u{T(1), T(0), T(0)};
    /// The edge from v = 0 to v = 1, perpendicular to edge_u.
    Vec3T<T> edge_v{T(0), T(0), T(1)};
};
using PlaneMap = PlaneMapT<float>; ///< PlaneMapT in float.

/// Maps a point to its longitude and latitude around a centre, see globe_coordinates().
template <std::floating_point T>
struct GlobeMapT {
    Vec3T<T> center{T(0)}; ///< Centre of the globe, in scene units.
};
using GlobeMap = GlobeMapT<float>; ///< GlobeMapT in float.

/// Maps a point to its coordinates on its own shape, which are scaled, then rotated,
/// then displaced. The coordinates on a mesh come from the file of the mesh.
template <std::floating_point T>
struct UvMapT {
    static constexpr bool uses_uv = true; ///< Uses texture_coordinates() of the shape.
    Vec2T<T> scale{T(1)};                 ///< Repetitions per unit of u and v.
    Vec2T<T> turn{T(1), T(0)};            ///< Cosine and sine of the angle of rotation.
    Vec2T<T> offset{T(0)}; ///< Displacement of the picture, in repetitions.
};
using UvMap = UvMapT<float>; ///< UvMapT in float.

/// True if a map, a texture or a material uses the coordinates of the shape.
template <typename M>
concept UsesUv = M::uses_uv;

/// The coordinates (u, v) of a point projected onto a plane.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> map_coordinates(const PlaneMapT<T>& map, const Vec3T<T>& place,
                                       const Vec2T<T>& = Vec2T<T>{T(0)}) noexcept {
    const Vec3T<T> from = place - map.origin;
    return {glm::dot(from, map.edge_u) / glm::dot(map.edge_u, map.edge_u),
            glm::dot(from, map.edge_v) / glm::dot(map.edge_v, map.edge_v)};
}

/// The coordinates (u, v) of a point on a globe, in [0, 1]; (0, 0.5) at its centre.
/// \cost Two arc tangents.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> map_coordinates(const GlobeMapT<T>& map, const Vec3T<T>& place,
                                       const Vec2T<T>& = Vec2T<T>{T(0)}) noexcept {
    return globe_coordinates(place - map.center);
}

/// The coordinates (u, v) of a point on its own shape, scaled, rotated and displaced.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> map_coordinates(const UvMapT<T>& map, const Vec3T<T>& /*place*/,
                                       const Vec2T<T>& uv) noexcept {
    const Vec2T<T> scaled = map.scale * uv;
    return Vec2T<T>{map.turn.x * scaled.x - map.turn.y * scaled.y,
                    map.turn.y * scaled.x + map.turn.x * scaled.y} +
           map.offset;
}

/// Converts a direction in the (u, v) of the picture to the (u, v) of the shape:
/// rotates it back, and mirrors it where the scale is negative. The length stays the
/// same.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> direction_on_shape(const UvMapT<T>& map,
                                          const Vec2T<T>& along) noexcept {
    return {std::copysign(T(1), map.scale.x) *
                (map.turn.x * along.x + map.turn.y * along.y),
            std::copysign(T(1), map.scale.y) *
                (map.turn.x * along.y - map.turn.y * along.x)};
}

/// Requires a finite origin, and edges whose squared lengths are finite and not 0 in T.
template <std::floating_point T>
void check(const PlaneMapT<T>& map) {
    require_finite("plane_map.origin", map.origin);
    const T u2 = glm::dot(map.edge_u, map.edge_u);
    const T v2 = glm::dot(map.edge_v, map.edge_v);
    constexpr const char* right = "of a length whose square is finite and not 0";
    require(std::isnormal(u2), "plane_map.edge_u", map.edge_u, right);
    require(std::isnormal(v2), "plane_map.edge_v", map.edge_v, right);
}

/// Requires a finite centre.
template <std::floating_point T>
void check(const GlobeMapT<T>& map) {
    require_finite("globe_map.center", map.center);
}

/// Requires a finite scale that is not zero, a `turn` of unit length and a finite
/// offset.
template <std::floating_point T>
void check(const UvMapT<T>& map) {
    for (const T scale : {map.scale.x, map.scale.y})
        require(std::isnormal(scale), "uv_map.scale", scale, "finite and not 0");
    const T length = glm::dot(map.turn, map.turn);
    require(std::abs(length - T(1)) < T(1e-3), "the squared length of uv_map.turn",
            length, "1, because it is the cosine and the sine of an angle");
    for (const T offset : {map.offset.x, map.offset.y})
        require(std::isfinite(offset), "uv_map.offset", offset, "finite");
}

/// A chessboard of `columns` by `rows` squares per repetition.
template <std::floating_point T, typename Map = PlaneMapT<T>>
struct CheckerT {
    static constexpr bool uses_uv = UsesUv<Map>; ///< Whether the map uses uv.
    Map map{};                                   ///< Maps a point to (u, v).
    RgbT<T> even{T(0.9)}; ///< The colour of squares whose column + row is even.
    RgbT<T> odd{T(0.1)};  ///< The colour of the other squares.
    int columns = 2;      ///< The number of squares from u = 0 to 1; even.
    int rows = 2;         ///< The number of squares from v = 0 to 1; even.
};
using Checker = CheckerT<float>; ///< A checker on a plane, in float.
/// A checker on a globe, in float.
using GlobeChecker = CheckerT<float, GlobeMapT<float>>;

/// The colour of a checker at a point.
template <std::floating_point T, typename Map>
[[nodiscard]] RgbT<T> color_at(const CheckerT<T, Map>& checker, const Vec3T<T>& place,
                               const Vec2T<T>& uv = Vec2T<T>{T(0)}) noexcept {
    const Vec2T<T> at = map_coordinates(checker.map, place, uv);
    const T field =
        std::floor(at.x * T(checker.columns)) + std::floor(at.y * T(checker.rows));
    return std::abs(std::fmod(field, T(2))) < T(0.5) ? checker.even : checker.odd;
}

/// Requires a valid map, colours within [0, 1] and even numbers of squares, from 2 to
/// 1000000.
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

/// What a picture shows beyond its border.
enum class PictureWrap : std::uint8_t {
    repeat, ///< The picture again.
    clamp,  ///< The colour of the nearest border pixel.
    mirror  ///< The mirror image of the picture, then the picture again.
};

/// How the colour between the centres of pixels is found.
enum class PictureFilter : std::uint8_t {
    bilinear, ///< Interpolated between four pixels.
    nearest   ///< The colour of the pixel that contains the point.
};

/// An image with its lower left corner at (u, v) = (0, 0) and its upper right corner at
/// (1, 1).
template <std::floating_point T, typename Map = PlaneMapT<T>>
struct PictureTextureT {
    static constexpr bool uses_uv = UsesUv<Map>; ///< Whether the map uses uv.
    ImageT<T> image{}; ///< Linear colours in [0, 1], see load_image().
    Map map{};         ///< Maps a point to (u, v).
    PictureWrap wrap = PictureWrap::repeat;         ///< Colour beyond the border.
    PictureFilter filter = PictureFilter::bilinear; ///< Colour between pixel centres.
};
using PictureTexture = PictureTextureT<float>; ///< A picture on a plane, in float.
/// A picture in the coordinates of the shape, in float.
using UvPicture = PictureTextureT<float, UvMapT<float>>;

/// The colour of a picture at a point.
template <std::floating_point T, typename Map>
[[nodiscard]] RgbT<T> color_at(const PictureTextureT<T, Map>& texture,
                               const Vec3T<T>& place,
                               const Vec2T<T>& uv = Vec2T<T>{T(0)}) noexcept {
    const ImageT<T>& image = texture.image;
    const Vec2T<T> at = map_coordinates(texture.map, place, uv);
    const bool repeats = texture.wrap == PictureWrap::repeat;
    const auto inside = [&](T x) {
        if (texture.wrap == PictureWrap::mirror) // distance to the nearest even number
            x = std::abs(x - T(2) * std::round(x / T(2)));
        if (!repeats) return x > T(0) ? std::min(x, T(1)) : T(0);
        // Below 1 even after rounding; 0 for NaN.
        const T rest = x - std::floor(x);
        return rest < T(1) ? rest : T(0);
    };
    const auto number = [&](T of, int size) {
        const int i = static_cast<int>(of);
        return repeats ? (i + size) % size : std::clamp(i, 0, size - 1);
    };
    const auto color = [&](T column, T row) {
        return pixel(image, number(column, image.width), number(row, image.height));
    };
    const T wide = inside(at.x) * T(image.width);
    const T high = (T(1) - inside(at.y)) * T(image.height);
    if (texture.filter == PictureFilter::nearest)
        return color(std::floor(wide), std::ceil(high) - T(1));
    const T x = wide - T(0.5), y = high - T(0.5);
    const T left = std::floor(x), top = std::floor(y);
    const T dx = x - left, dy = y - top;
    return (T(1) - dy) * ((T(1) - dx) * color(left, top) + dx * color(left + 1, top)) +
           dy * ((T(1) - dx) * color(left, top + 1) + dx * color(left + 1, top + 1));
}

/// Requires a valid map, and an image with at least one pixel and all channels within
/// [0, 1].
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
