#pragma once

/// \file ljus/io/detail/obj_material.hpp
/// \brief The materials of a mesh file, from its material files (MTL).

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include <glm/common.hpp>

#include "ljus/io/detail/mesh_builder.hpp"
#include "ljus/io/detail/obj_text.hpp"
#include "ljus/io/mesh_file.hpp"

namespace ljus {

/// \addtogroup obj_reader
/// \{

namespace detail {

// The file that another one names, on any system: "maps\wall.png" beside it.
inline std::string file_named(const std::string& beside, std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return path_beside(beside, name);
}

// Reads one material file, line by line.
struct MaterialReader {
    const std::string& path;                        // of the file
    std::map<std::string, MeshMaterial>& materials; // takes what is read
    std::vector<std::string>& notes;                // takes a sentence a trouble

    MeshMaterial ignored{}; // for lines before the first material, or of a name again
    MeshMaterial* material = &ignored;
    bool has_diffuse = false, has_dissolve = false;
    std::string mirror_at{}; // where illum stands
    long long number = 0;    // of the line
    UnusedLines others{};

    std::string where() const {
        return shown_path(path) + ", line " + std::to_string(number);
    }
    void note_at(const std::string& place, const std::string& what) {
        if (material != &ignored) notes.push_back(place + ": " + what);
    }
    void note(std::string_view keyword, const std::string& what) {
        note_at(where(), shown(std::string(keyword)) + " " + what);
    }
    // One number, or three; of one there are three alike.
    void color(std::string_view keyword, Words words, glm::dvec3& to, double most) {
        const std::string text = words.name();
        glm::dvec3 value(number_of(words.next()));
        if (const auto green = words.next(); !green.empty()) {
            value.y = number_of(green);
            value.z = number_of(words.next());
        }
        const std::string is = "is " + shown(text) +
                               "; it must be one number or three, "
                               "from 0 to " +
                               to_text(most);
        if (std::isnan(value.x + value.y + value.z))
            return note(keyword, is + ". It is not used.");
        to = glm::clamp(value, glm::dvec3(0), glm::dvec3(most));
        if (to != value) note(keyword, is + ". The nearest is taken.");
    }
    void value(std::string_view keyword, Words words, double& to, double least,
               double most) {
        const std::string text = words.name();
        const double value = number_of(words.next());
        if (value >= least && value <= most)
            to = value;
        else
            note(keyword, "is " + shown(text) + "; it must be a number from " +
                              to_text(least) + " to " + to_text(most) +
                              ". It is not used.");
    }
    // Takes an option of the picture of colours: where it lies, and if it repeats.
    // Returns whether it is known.
    bool take(std::string_view option, const std::array<double, 2>& numbers,
              std::string_view word) {
        glm::dvec2 value(numbers[0], numbers[1]);
        const bool scale = option == "-s";
        if (std::isnan(value.y)) value.y = scale ? 1 : 0;
        if (scale && std::isnormal(value.x) && std::isnormal(value.y))
            material->map.scale = value;
        else if (option == "-o" && std::isfinite(value.x) && std::isfinite(value.y))
            material->map.offset = value;
        else if (option == "-clamp" && (word == "on" || word == "off"))
            material->wrap = word == "on" ? PictureWrap::clamp : PictureWrap::repeat;
        else
            return false;
        return true;
    }
    // The name of a picture, behind options that say how it lies. Those of map_Kd are
    // used, and count for all pictures of the material.
    void picture(std::string_view keyword, Words words, MeshImage& to) {
        std::string unused;
        for (Words after = words;; words = after) {
            const std::string_view option = after.next();
            if (option.size() < 2 || option[0] != '-') break;
            const bool three = option == "-o" || option == "-s" || option == "-t";
            std::array<double, 2> numbers{NAN, NAN};
            std::string_view word;
            const int most = option == "-mm" ? 2 : three ? 3 : 1;
            for (int count = 0; count < most; ++count) {
                Words ahead = after;
                word = ahead.next();
                const double value = number_of(word);
                if (three && std::isnan(value)) break;
                if (count < 2) numbers[std::size_t(count)] = value;
                after = ahead;
            }
            if (&to != &material->picture || !take(option, numbers, word))
                unused.append(unused.empty() ? "" : " ").append(option);
        }
        if (!unused.empty())
            note(keyword, "has options, " + shown(unused) + "; they are not used.");
        if (const std::string name = words.name(); !name.empty())
            to = {file_named(path, name), where()};
        else
            note(keyword, "names no file.");
    }
    void finish() {
        MeshMaterial& is = *material;
        const bool black = has_diffuse && is.diffuse == glm::dvec3(0);
        const bool pictured = !is.picture.name.empty();
        if (pictured && (black || !has_diffuse)) {
            is.diffuse = glm::dvec3(1);
            if (black)
                note_at(is.picture.at,
                        "map_Kd is multiplied by Kd, which is 0; 1 is used.");
        }
        // Programs to which 1 is opaque write it beside a picture.
        if (pictured && !has_dissolve && is.dissolve == 0) {
            is.dissolve = 1;
            note_at(is.picture.at, "map_Kd is on a surface that Tr 1 makes wholly "
                                   "clear; Tr is not used.");
        }
        for (const MeshImage& detail : {is.mask, is.normals})
            if (!detail.name.empty() && is.emission != glm::dvec3(0))
                note_at(detail.at, "a picture of holes or normals is on what glows; it "
                                   "is not used.");
        if (is.is_mirror() && is.specular == glm::dvec3(0))
            note_at(mirror_at, "illum makes a mirror whose colour, Ks, is 0: it is "
                               "black.");
        has_diffuse = has_dissolve = false;
    }
    void read(std::string_view text) {
        LineReader{path}.read(text, true, [&](std::string_view line, long long at) {
            Words words{line};
            number = at;
            const std::string_view keyword = words.next();
            const auto is = [&](const char* word) { return same_word(keyword, word); };
            if (is("newmtl")) {
                finish();
                const auto [entry, fresh] = materials.try_emplace(words.name());
                material = fresh ? &entry->second : &ignored;
                material->name = entry->first;
            } else if (is("Kd")) {
                has_diffuse = true;
                color(keyword, words, material->diffuse, 1);
            } else if (is("Ks")) {
                color(keyword, words, material->specular, 1);
            } else if (is("Ke")) {
                color(keyword, words, material->emission, 1e12);
            } else if (is("Ni")) {
                value(keyword, words, material->index, 1e-3, 1e3);
            } else if (is("d")) {
                has_dissolve = true;
                value(keyword, words, material->dissolve, 0, 1);
            } else if (is("Tr") && !has_dissolve) {
                double clear = 1 - material->dissolve;
                value(keyword, words, clear, 0, 1);
                material->dissolve = 1 - clear;
            } else if (is("illum")) {
                double model = material->illumination;
                value(keyword, words, model, 0, 10);
                material->illumination = static_cast<int>(model);
                mirror_at = where();
            } else if (is("map_Kd")) {
                picture(keyword, words, material->picture);
            } else if (is("map_d")) {
                material->mask_is_alpha = false;
                picture(keyword, words, material->mask);
            } else if (is("norm")) {
                picture(keyword, words, material->normals);
            } else if (is("map_Ke")) {
                note(keyword, "is not used.");
            } else if (is("map_bump") || is("bump")) {
                note(keyword, "is a map of heights, which is not used; norm names one "
                              "of normals.");
            } else if (!(is("") || is("Tr") || is("Ka") || is("Ns") ||
                         is("sharpness"))) {
                others.add(keyword, at);
            }
        });
        finish();
        others.tell(path, notes);
    }
};

// The materials of all files that a mesh file names; the first of a name counts.
struct MaterialLibraries {
    std::map<std::string, MeshMaterial> materials{};
    std::map<std::string, bool> read{}; // whether a file could be, by one_path()

    // A line "mtllib": the name of one file, or those of several without blanks. A file
    // that is named again is not read again.
    void add(const std::string& names, const std::string& file, long long line,
             MeshReport& report) {
        if (add_file(file_named(file, names), report)) return;
        Words words{names};
        for (std::string_view name = words.next(); !name.empty(); name = words.next())
            if (name.size() == names.size() ||
                !add_file(file_named(file, Words{name}.name()), report))
                report.add(MeshTrouble::no_library, line);
    }

private:
    bool add_file(const std::string& path, MeshReport& report) {
        const auto [known, fresh] = read.try_emplace(one_path(path), false);
        if (fresh) {
            try {
                const std::string text = load_text(path, max_mesh_file);
                MaterialReader{path, materials, report.notes}.read(text);
                known->second = true;
            } catch (const std::runtime_error&) { // it is reported where it is named
            }
        }
        return known->second;
    }
};

} // namespace detail

/// \}

} // namespace ljus
