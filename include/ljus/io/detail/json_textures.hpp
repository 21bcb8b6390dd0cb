#pragma once

/// \file ljus/io/detail/json_textures.hpp
/// \brief The textures of a scene file.

#include <cmath>
#include <numbers>
#include <variant>

#include <nlohmann/json.hpp>

#include "ljus/image/texture.hpp"
#include "ljus/io/detail/json_members.hpp"
#include "ljus/io/load_image.hpp"

namespace ljus::detail {

// A map of one of several types, which is chosen when the file is read.
template <std::floating_point T>
struct FileMapT {
    static constexpr bool uses_uv = true; // if it holds a UvMap
    std::variant<PlaneMapT<T>, GlobeMapT<T>, UvMapT<T>> map{};
};
template <std::floating_point T>
[[nodiscard]] Vec2T<T> map_coordinates(const FileMapT<T>& any, const Vec3T<T>& place,
                                       const Vec2T<T>& uv) noexcept {
    return std::visit([&](const auto& map) { return map_coordinates(map, place, uv); },
                      any.map);
}
template <std::floating_point T>
void check(const FileMapT<T>& any) {
    std::visit([](const auto& map) { check(map); }, any.map);
}

inline constexpr std::string_view map_words[]{"plane", "globe", "uv"};

inline constexpr JsonValue repetitions_value{JsonKind::pair, -1e6, 1e6,
                                             "within [-1e6, 1e6]"};

// The members by which every texture describes its map.
inline constexpr JsonMember map_members[]{
    preset("map", {.kind = JsonKind::word, .words = map_words}, 0,
           "by a plane, by longitude and latitude around a point, or by the shape's "
           "own coordinates"),
    optional("origin", point_value, "of a plane: where (u, v) is (0, 0)", "[0, 0, 0]"),
    optional("edge_u", direction_value, "of a plane: from u = 0 to u = 1", "[1, 0, 0]"),
    optional("edge_v", direction_value, "of a plane: from v = 0 to v = 1", "[0, 0, 1]"),
    optional("center", point_value, "of a globe"),
    preset("scale", repetitions_value, 1,
           "of uv: how often the texture repeats along u and along v"),
    preset("rotate_deg", angle_value, 0, "of uv: how far u and v are turned then"),
    preset("offset", repetitions_value, 0, "of uv: added then, in repetitions")};
inline constexpr std::string_view wrap_words[]{"repeat", "clamp", "mirror"};
inline constexpr JsonMember wrap_row =
    preset("wrap", {.kind = JsonKind::word, .words = wrap_words}, 0,
           "beyond the border: the picture again, the pixels of its border, or the "
           "picture and its mirror image in turn");
inline constexpr std::string_view filter_words[]{"bilinear", "nearest"};
inline constexpr JsonMember filter_row =
    preset("filter", {.kind = JsonKind::word, .words = filter_words}, 0,
           "between the middles of pixels: interpolated, or the nearest one");

// Refuses the fields of other kinds of maps.
inline void require_fields_of_map(const JsonMembersOf& in, const std::string& kind) {
    constexpr const char* owners[][2]{{"origin", "plane"}, {"edge_u", "plane"},
                                      {"edge_v", "plane"}, {"center", "globe"},
                                      {"scale", "uv"},     {"rotate_deg", "uv"},
                                      {"offset", "uv"}};
    for (const auto& [name, owner] : owners)
        if (in.has(name) && kind != owner)
            refuse(in[name], join({"belongs to the map \"", owner,
                                   "\", and the map here is \"", kind, "\""}));
}

template <std::floating_point T>
PlaneMapT<T> read_plane_map(const JsonMembersOf& in) {
    for (const char* name : {"origin", "edge_u", "edge_v"}) (void)in[name];
    const auto edge = [&](const char* name) {
        const Vec3T<T> found{in.vector(name)};
        if (!std::isnormal(glm::dot(found, found)))
            refuse_value(in[name], "a vector that is not 0");
        return found;
    };
    return {.origin{in.vector("origin")},
            .edge_u = edge("edge_u"),
            .edge_v = edge("edge_v")};
}

template <std::floating_point T>
UvMapT<T> read_uv_map(const JsonMembersOf& in) {
    const auto pair = [&](const char* name, Vec2T<T> value) {
        if (in.has(name))
            for (int i = 0; i < 2; ++i)
                value[i] = in[name].value[std::size_t(i)].template get<T>();
        return value;
    };
    const double angle = in.number("rotate_deg") * std::numbers::pi / 180;
    return {.scale = pair("scale", Vec2T<T>{T(1)}),
            .turn{T(std::cos(angle)), T(std::sin(angle))},
            .offset = pair("offset", Vec2T<T>{T(0)})};
}

template <std::floating_point T>
FileMapT<T> read_map(const JsonMembersOf& in) {
    const std::string kind = in.word("map");
    require_fields_of_map(in, kind);
    if (kind == "globe") {
        (void)in["center"];
        return {GlobeMapT<T>{.center{in.vector("center")}}};
    }
    if (kind == "plane") return {read_plane_map<T>(in)};
    return {read_uv_map<T>(in)};
}

template <std::floating_point T>
CheckerT<T, FileMapT<T>> read_checker(const JsonMembersOf& in) {
    return {.map = read_map<T>(in),
            .even{in.vector("even")},
            .odd{in.vector("odd")},
            .columns = static_cast<int>(in.number("columns")),
            .rows = static_cast<int>(in.number("rows"))};
}

// Reads the picture that a field names. `pixels` is the number of pixels of all
// pictures so far, which is limited.
template <std::floating_point T>
ImageT<T> take_picture(const JsonField& file, long long& pixels,
                       PictureContent content = PictureContent::colors) {
    try {
        ImageT<T> image = load_image<T>(path_beside(file), pixels, content);
        pixels += static_cast<long long>(image.pixels.size());
        return image;
    } catch (const std::runtime_error& error) {
        refuse_for(file, error);
    }
}

// Puts a picture on a map.
template <std::floating_point T, typename Map>
PictureTextureT<T, Map> picture_on(const Map& map, const JsonMembersOf& in,
                                   ImageT<T> image) {
    const std::string wrap = in.word("wrap");
    return {.image = std::move(image),
            .map = map,
            .wrap = wrap == "clamp"    ? PictureWrap::clamp
                    : wrap == "mirror" ? PictureWrap::mirror
                                       : PictureWrap::repeat,
            .filter = in.word("filter") == "nearest" ? PictureFilter::nearest
                                                     : PictureFilter::bilinear};
}

template <std::floating_point T>
PictureTextureT<T, FileMapT<T>> read_picture(const JsonMembersOf& in,
                                             long long& pixels) {
    const FileMapT<T> map = read_map<T>(in);
    return picture_on(map, in, take_picture<T>(in["file"], pixels));
}

} // namespace ljus::detail
