#pragma once

/// \file ljus/io/load_obj.hpp
/// \brief Reads meshes from OBJ files.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>

#include "ljus/image/color.hpp"
#include "ljus/io/detail/mesh_builder.hpp"
#include "ljus/io/detail/mesh_pictures.hpp"
#include "ljus/io/detail/parse.hpp"
#include "ljus/io/load_image.hpp"
#include "ljus/io/mesh_file.hpp"

namespace ljus {

/// \defgroup load_obj Mesh files
/// \brief OBJ files with their MTL files, PLY, STL and glTF. Chapter:
/// \ref ch_triangle_files.
///
///     const auto teapot = load_obj("teapot.obj", {.scale = 0.1});
///     std::fputs(to_text(teapot.report).c_str(), stderr);
///     add_meshes(scene, teapot); // in the colours of the file
///     scene.add(teapot.parts[0].mesh, scene.add(Glass{})); // or one part, in glass
/// \{

namespace detail {

// Reads one material file, line by line.
struct MaterialReader {
    const std::string& path;                        // path of the file
    std::map<std::string, MeshMaterial>& materials; // receives the materials
    std::vector<std::string>& notes;                // receives a sentence per problem

    MeshMaterial ignored{}; // for lines that belong to no new material
    MeshMaterial* material = &ignored;
    bool has_diffuse = false, has_dissolve = false, glows_by_picture = false;
    std::string mirror_at{}; // place of the line illum
    long long number = 0;    // number of the line
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
    // Reads a colour: three numbers, or one that is used three times.
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
    // Uses an option of the picture of colours: its scale, its offset, or whether it
    // repeats. Returns whether the option is known.
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
    // Reads the name of a picture, which follows options. The options of map_Kd are
    // used, for all pictures of the material; others are ignored.
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
            to = {path_beside(path, name), where()};
        else
            note(keyword, "names no file.");
    }
    void finish() {
        MeshMaterial& is = *material;
        if (std::exchange(glows_by_picture, false)) is.emission = glm::dvec3(0);
        const bool black = has_diffuse && is.diffuse == glm::dvec3(0);
        const bool pictured = !is.picture.name.empty();
        if (pictured && (black || !has_diffuse)) {
            is.diffuse = glm::dvec3(1);
            if (black)
                note_at(is.picture.at,
                        "map_Kd is multiplied by Kd, which is 0; 1 is used.");
        }
        // Some programs write Tr 1 for an opaque material with a picture.
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
                glows_by_picture = true;
                note(keyword, "is not used; its material does not glow.");
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

// The materials of all material files that a mesh file names. If two materials have one
// name, the first is used.
struct MaterialLibraries {
    std::map<std::string, MeshMaterial> materials{};
    std::map<std::string, bool> read{}; // whether it succeeded, by one_path()

    // Reads the files of a line "mtllib", which has the name of one file, or names of
    // several files without blanks in them. No file is read twice.
    void add(const std::string& names, const std::string& file, long long line,
             MeshReport& report) {
        if (add_file(path_beside(file, names), report)) return;
        Words words{names};
        for (std::string_view name = words.next(); !name.empty(); name = words.next())
            if (name.size() == names.size() ||
                !add_file(path_beside(file, Words{name}.name()), report))
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
            } catch (const std::runtime_error&) { // add() reports it
            }
        }
        return known->second;
    }
};

// The index, from 0, that a number of the file means in a list of `count` elements.
// Numbers count from 1, or backwards from -1; others give no_number.
inline std::uint32_t place_of(long long number, std::size_t count) {
    const auto all = static_cast<long long>(count);
    if (number == 0 || number > all || number < -all) return no_number;
    return static_cast<std::uint32_t>(number > 0 ? number - 1 : number + all);
}

// Reads a file line by line. Names of materials are resolved at its end.
template <std::floating_point T>
class ObjReader {
public:
    ObjReader(const std::string& file, const MeshFileSettings& settings)
        : file_(file), text_{file}, mesh_(settings) {}

    // Reads a piece of the file, as LineReader::read() does.
    std::size_t read(std::string_view piece, bool last) {
        return text_.read(piece, last, [&](std::string_view line, long long number) {
            mesh_.place = number;
            read_line({line});
        });
    }

    // Returns the faces and the report; see MeshBuilder::take_faces().
    std::vector<MeshFacesT<T>> take_faces(MeshReport& report) {
        std::vector<const MeshMaterial*> known(names_.size() + 1); // nullptr: no
                                                                   // material
        for (const auto& [name, use] : names_) {
            const auto found = libraries_.materials.find(name);
            if (found == libraries_.materials.end())
                mesh_.report.add(MeshTrouble::no_material, use.at.line, use.at.count);
            else if (!name.empty())
                known[use.number] = &found->second;
        }
        std::vector<MeshFacesT<T>> parts = mesh_.take_faces(known);
        for (MeshFacesT<T>& part : parts)
            if (!part.colors.empty()) part.material.diffuse = glm::dvec3(1);
        unused_.tell(file_, mesh_.report.notes);
        report = std::move(mesh_.report);
        return parts;
    }

private:
    // The name of a material in lines usemtl.
    struct Name {
        std::uint32_t number;
        MeshCount at; // how often, and first line
    };

    void read_line(Words words) {
        const std::string_view keyword = words.next();
        if (keyword == "v")
            vertex(words);
        else if (keyword == "vn")
            mesh_.add_normal(three_numbers(words));
        else if (keyword == "vt")
            texture(words);
        else if (keyword == "f")
            face(words);
        else if (keyword == "usemtl")
            use(words.name());
        else if (keyword == "mtllib")
            libraries_.add(words.name(), file_, mesh_.place, mesh_.report);
        else if (keyword == "s")
            smoothing(words.next());
        else if (keyword == "o")
            ++mesh_.report.content.objects;
        else if (keyword == "g")
            ++mesh_.report.content.groups;
        else if (is_one_of(keyword, no_faces))
            mesh_.report.add(MeshTrouble::no_face, mesh_.place);
        else if (!is_one_of(keyword, without_effect))
            unused_.add(keyword, mesh_.place);
    }
    void vertex(Words words) {
        mesh_.add_position(three_numbers(words));
        Words color = words;
        (void)words.next(); // a weight, or the red of a colour
        if (words.next().empty()) return;
        glm::dvec3 light = three_numbers(color);
        for (int i = 0; i < 3; ++i)
            if (light[i] >= 0 && light[i] <= 1) light[i] = srgb_decode(light[i]);
        mesh_.add_color(light);
    }
    void texture(Words words) {
        const double u = number_of(words.next());
        const std::string_view second = words.next(); // missing for one-row pictures
        mesh_.add_uv(u, second.empty() ? 0 : number_of(second));
    }
    void use(const std::string& name) {
        const auto number = static_cast<std::uint32_t>(names_.size() + 1); // 0: none
        Name& known =
            names_.try_emplace(name, Name{number, {0, mesh_.place}}).first->second;
        ++known.at.count;
        mesh_.material = known.number;
    }
    void smoothing(std::string_view group) {
        mesh_.in_smooth_group = !group.empty() && group != "off" && group != "0";
    }
    // Adds a corner of a face, "1/2/3", "1//3" or "-1".
    void corner(std::string_view word) {
        const std::array<std::size_t, 3> counts = mesh_.counts();
        std::array<std::uint32_t, 3> at{no_number, no_number, no_number};
        for (std::size_t k = 0; k < 3 && !word.empty(); ++k) {
            const std::size_t end = std::min(word.find('/'), word.size());
            const char* const last = word.data() + end;
            long long number = 0;
            const auto [stop, error] = std::from_chars(word.data(), last, number);
            if (end > 0 && (stop != last || error != std::errc{})) break;
            at[k] = place_of(number, counts[k]);
            if (end > 0 && at[k] == no_number) mesh_.miss(k);
            word.remove_prefix(std::min(end + 1, word.size()));
        }
        // A word of another form names no position.
        if (!word.empty()) mesh_.miss(of_position);
        mesh_.add_corner(at[of_position], at[of_uv], at[of_normal]);
    }
    void face(Words words) {
        for (auto word = words.next(); !word.empty(); word = words.next()) corner(word);
        mesh_.end_face();
    }

    static constexpr std::string_view no_faces[]{"l", "p", "curv", "curv2", "surf"};
    // Keywords within curves and surfaces, and settings for displays.
    static constexpr std::string_view without_effect[]{
        "",      "vp",    "cstype", "deg",      "bmat",       "step",
        "parm",  "trim",  "hole",   "scrv",     "sp",         "end",
        "con",   "mg",    "bevel",  "c_interp", "d_interp",   "lod",
        "ctech", "stech", "maplib", "usemap",   "shadow_obj", "trace_obj"};

    const std::string& file_; // the path; material files are in its folder
    UnusedLines unused_{};
    LineReader text_;
    MeshBuilder<T> mesh_;
    MaterialLibraries libraries_{};
    std::map<std::string, Name> names_{};
};

inline Bytes picture_file(const std::string& path) {
    return load_file(path, max_image_file);
}

// Makes the meshes of a file. read(reader) passes the text of the file to an ObjReader.
template <std::floating_point T, typename Read>
LoadedMeshT<T> read_obj_pieces(const std::string& file,
                               const MeshFileSettings& settings, Read read) {
    return make_meshes<T>(
        file, settings, "; a mesh file has lines such as 'v 0 0 1' and 'f 1 2 3'.",
        [&](LoadedMeshT<T>& loaded) {
            ObjReader<T> reader(file, settings);
            read(reader);
            return reader.take_faces(loaded.report);
        },
        [](MeshMaterial& material, LoadedMeshT<T>& loaded, long long& pixels) {
            load_pictures(material, loaded, pixels, picture_file);
        });
}

} // namespace detail

/// Reads meshes from the text of an OBJ file. All faces of one material form one mesh.
/// A face with more than three corners is cut into triangles. `file` is the path of the
/// file, for messages; material files are looked for in its folder.
/// \return The meshes, and a report of the problems of the file. Elements of the file
///         that cannot be used are left out and counted.
/// \throws std::runtime_error  with one sentence, if no face can be used, or if a mesh
///         cannot be made: "box.obj: no face of the file can be used; the first
///         problem: line 7: 12 faces refer to a vertex that does not exist; ..."
/// \throws std::invalid_argument  unless the scale is finite and above 0.
template <std::floating_point T = float>
[[nodiscard]] LoadedMeshT<T> read_obj(std::string_view text, const std::string& file,
                                      const MeshFileSettings& settings = {}) {
    return detail::read_obj_pieces<T>(file, settings,
                                      [&](auto& reader) { reader.read(text, true); });
}

/// Loads an OBJ file; see read_obj().
/// \throws std::runtime_error  as read_obj(), or if the file cannot be read.
template <std::floating_point T = float>
[[nodiscard]] LoadedMeshT<T> load_obj(const std::string& path,
                                      const MeshFileSettings& settings = {}) {
    return detail::read_obj_pieces<T>(path, settings, [&](auto& reader) {
        read_in_pieces(path, detail::max_mesh_file,
                       [&](std::string_view piece, bool last) {
                           return reader.read(piece, last);
                       });
    });
}

/// \}

} // namespace ljus
