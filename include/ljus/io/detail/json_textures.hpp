#pragma once

/// \file ljus/io/detail/json_textures.hpp
/// \brief The vectors and colours of a scene file, and its textures.

#include <map>
#include <variant>

#include <nlohmann/json.hpp>

#include "ljus/image/texture.hpp"
#include "ljus/io/detail/json_field.hpp"
#include "ljus/io/load_image.hpp"

namespace ljus::detail {

inline constexpr double max_length = 1e9;
inline constexpr double max_radiance = 1e12;

inline glm::dvec3 vector_field(const JsonField& field, double low, double high,
                               std::string_view right) {
    if (list_size(field) != 3) refuse_value(field, "a list of three numbers");
    return {number(entry(field, 0), low, high, right),
            number(entry(field, 1), low, high, right),
            number(entry(field, 2), low, high, right)};
}

inline glm::dvec3 point_field(const JsonField& field) {
    return vector_field(field, -max_length, max_length, "within [-1e9, 1e9]");
}

// A direction, of any length above 0.
inline glm::dvec3 direction_field(const JsonField& field) {
    const glm::dvec3 way = point_field(field);
    if (!(glm::dot(way, way) > 0)) refuse_value(field, "a vector that is not 0");
    return way;
}

// Radiance, intensity or irradiance.
inline glm::dvec3 light_field(const JsonField& field) {
    return vector_field(field, 0, max_radiance, "within [0, 1e12]");
}

inline glm::dvec3 fraction_field(const JsonField& field) {
    return vector_field(field, 0, 1, "within [0, 1]");
}

// Any of the maps, chosen when the file is read.
template <std::floating_point T>
struct FileMapT {
    static constexpr bool uses_uv = true; // the UvMap does
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

// The kind of a texture's map; a plane by default.
inline std::string kind_of_map(const JsonField& field) {
    const auto map = find(field, "map");
    if (!map) return "plane";
    require_one_of(*map, {"plane", "globe", "uv"});
    return text(*map);
}

// Refuses the fields of other kinds of maps.
inline void require_fields_of_map(const JsonField& field, const std::string& kind) {
    constexpr const char* owners[][2]{{"origin", "plane"},
                                      {"edge_u", "plane"},
                                      {"edge_v", "plane"},
                                      {"center", "globe"},
                                      {"scale", "uv"}};
    for (const auto& [name, owner] : owners)
        if (const auto other = find(field, name); other && kind != owner)
            refuse(*other, std::string("belongs to the map \"")
                               .append(owner)
                               .append("\", and the map here is \"")
                               .append(kind)
                               .append("\""));
}

template <std::floating_point T>
PlaneMapT<T> read_plane_map(const JsonField& field) {
    const auto edge = [&](const char* name) {
        const JsonField vector = member(field, name);
        const Vec3T<T> found{point_field(vector)};
        if (!std::isnormal(glm::dot(found, found)))
            refuse_value(vector, "a vector that is not 0");
        return found;
    };
    return {.origin{point_field(member(field, "origin"))},
            .edge_u = edge("edge_u"),
            .edge_v = edge("edge_v")};
}

template <std::floating_point T>
UvMapT<T> read_uv_map(const JsonField& field) {
    UvMapT<T> map;
    const auto scale = find(field, "scale");
    if (!scale) return map;
    if (list_size(*scale) != 2) refuse_value(*scale, "a list of two numbers");
    for (int i = 0; i < 2; ++i)
        map.scale[i] = static_cast<T>(
            number(entry(*scale, std::size_t(i)), -1e6, 1e6, "within [-1e6, 1e6]"));
    return map;
}

template <std::floating_point T>
FileMapT<T> read_map(const JsonField& field) {
    const std::string kind = kind_of_map(field);
    require_fields_of_map(field, kind);
    if (kind == "globe")
        return {GlobeMapT<T>{.center{point_field(member(field, "center"))}}};
    if (kind == "uv") return {read_uv_map<T>(field)};
    return {read_plane_map<T>(field)};
}

template <std::floating_point T>
CheckerT<T, FileMapT<T>> read_checker(const JsonField& field) {
    CheckerT<T, FileMapT<T>> checker{.map = read_map<T>(field),
                                     .even{fraction_field(member(field, "even"))},
                                     .odd{fraction_field(member(field, "odd"))}};
    const auto count = [&](const char* name, int& fields) {
        if (const auto found = find(field, name))
            fields = static_cast<int>(whole_number(*found, 2, 1'000'000));
    };
    count("columns", checker.columns);
    count("rows", checker.rows);
    return checker;
}

// The pictures of a scene file. Each is read once, and kept until its last use. A use
// has a copy of its own, so that all are limited together.
template <std::floating_point T>
struct FilePicturesT {
    struct Picture {
        int uses = 0; // that are still to come
        ImageT<T> image{};
    };
    std::map<std::string, Picture> by_path{};
    long long pixels = 0; // of all copies so far

    // Counts the uses in a list of materials.
    explicit FilePicturesT(const JsonField& materials) {
        for (const auto& value : materials.value)
            if (const auto file = value.find("file");
                file != value.end() && file->is_string())
                ++at(path_beside(materials.file, *file)).uses;
    }
    Picture& at(const std::string& path) { return by_path[one_path(path)]; }

    ImageT<T> take(const std::string& path) {
        Picture& known = at(path);
        ImageT<T>& image = known.image;
        if (image.pixels.empty())
            image = load_image<T>(path, pixels);
        else if (const std::string why =
                     too_large_beside(pixels, image.width, image.height);
                 !why.empty())
            throw std::runtime_error(join({shown_path(path), " ", why, "."}));
        pixels += static_cast<long long>(image.pixels.size());
        // It is not kept if there is no room for one more.
        if (--known.uses > 0 &&
            too_large_beside(pixels, image.width, image.height).empty())
            return image;
        return std::move(image);
    }
};

template <std::floating_point T>
PictureTextureT<T, FileMapT<T>> read_picture(const JsonField& field,
                                             FilePicturesT<T>& pictures) {
    PictureTextureT<T, FileMapT<T>> texture{.map = read_map<T>(field)};
    const JsonField file = member(field, "file");
    try {
        texture.image = pictures.take(path_beside(file));
    } catch (const std::runtime_error& error) {
        refuse_for(file, error);
    }
    return texture;
}

} // namespace ljus::detail
