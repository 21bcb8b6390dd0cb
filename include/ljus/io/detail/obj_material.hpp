#pragma once

/// \file ljus/io/detail/obj_material.hpp
/// \brief The materials of mesh files.

#include <algorithm>
#include <sstream>

#ifndef TINY_OBJ_LOADER_H_ // the header guards its declarations only
#include <tiny_obj_loader.h>
#endif

#include "ljus/io/detail/obj_text.hpp"
#include "ljus/io/file.hpp"
#include "ljus/io/obj_report.hpp"

namespace ljus {

/// \addtogroup obj_reader
/// \{

namespace detail {

/// The largest file that load_obj() accepts, in bytes.
inline constexpr std::size_t max_obj_file = std::size_t(1) << 30;

/// A material of a material file; its numbers are clamped to their ranges.
struct ObjMaterial {
    std::string name{};       ///< Empty for faces without a material.
    glm::dvec3 diffuse{0.5};  ///< Kd, in [0, 1].
    glm::dvec3 specular{0};   ///< Ks, in [0, 1].
    glm::dvec3 emission{0};   ///< Ke, W/(m^2 sr), at least 0.
    double index = 1.5;       ///< Ni, within [0.001, 1000].
    double dissolve = 1;      ///< d: 0 is clear.
    int illumination = 2;     ///< illum: 3, 5 and 8: mirror; 4, 6, 7 and 9: glass.
    std::string picture{};    ///< map_Kd, multiplied by Kd: its path; or empty.
    std::string picture_at{}; ///< The position of map_Kd: "room.mtl, line 12".

    /// True for glass: by illum, or because d is below 1/2.
    [[nodiscard]] bool is_glass() const noexcept {
        const int i = illumination;
        return i == 4 || i == 6 || i == 7 || i == 9 || dissolve < 0.5;
    }
    /// True for a mirror.
    [[nodiscard]] bool is_mirror() const noexcept {
        return illumination == 3 || illumination == 5 || illumination == 8;
    }
};

inline ObjMaterial material_of(const tinyobj::material_t& from) {
    const auto within = [](double x, double low, double high) { // NaN: low
        return x > low ? (x < high ? x : high) : low;
    };
    const auto color = [&](const tinyobj::real_t* c, double most) {
        return glm::dvec3(within(double(c[0]), 0, most), within(double(c[1]), 0, most),
                          within(double(c[2]), 0, most));
    };
    return {.name = from.name,
            .diffuse = color(from.diffuse, 1),
            .specular = color(from.specular, 1),
            .emission = color(from.emission, 1e12),
            .index = within(double(from.ior), 1e-3, 1e3),
            .dissolve = within(double(from.dissolve), 0, 1),
            .illumination = from.illum};
}

// The line of a material file that names a picture, counted from 1; 0 if none does.
inline long long line_of_picture(std::string_view text, std::string_view picture) {
    long long first = 0;
    each_line(text, [&](std::string_view line, long long number) {
        const auto words = words_of(line);
        const bool names =
            !words.empty() && words[0] == "map_Kd" && line.find(picture) != line.npos;
        if (names && first == 0) first = number;
    });
    return first;
}

// Adds the materials of one material file; of equal names the first one is kept.
inline void add_library(std::map<std::string, ObjMaterial>& materials,
                        const std::string& path) {
    const Bytes bytes = load_file(path, max_obj_file);
    std::string text(bytes.begin(), bytes.end());
    blunt_exponents(text);
    std::istringstream stream(text);
    std::map<std::string, int> names;
    std::vector<tinyobj::material_t> found;
    std::string warning, error;
    tinyobj::LoadMtl(&names, &found, &stream, &warning, &error);
    for (const tinyobj::material_t& from : found) {
        ObjMaterial material = material_of(from);
        if (std::string picture = from.diffuse_texname; !picture.empty()) {
            material.picture_at = shown_path(path) + ", line " +
                                  std::to_string(line_of_picture(text, picture));
            std::replace(picture.begin(), picture.end(), '\\', '/');
            material.picture = path_beside(path, picture);
        }
        materials.try_emplace(from.name, std::move(material));
    }
}

// The materials of all material files of a mesh file; of equal names the first is kept.
inline std::map<std::string, ObjMaterial>
read_materials(std::string_view text, const std::string& folder, ObjReport& report) {
    std::map<std::string, ObjMaterial> materials;
    each_line(text, [&](std::string_view line, long long number) {
        const auto words = words_of(line);
        if (words.empty() || words[0] != "mtllib") return;
        for (std::size_t i = 1; i < words.size(); ++i) {
            try {
                add_library(materials, folder + std::string(words[i]));
            } catch (const std::runtime_error&) {
                report.add(ObjTrouble::no_library, number);
            }
        }
    });
    return materials;
}

} // namespace detail

/// \}

} // namespace ljus
