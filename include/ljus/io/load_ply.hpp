#pragma once

/// \file ljus/io/load_ply.hpp
/// \brief Reads meshes from PLY files.

#include <array>
#include <optional>
#include <utility>

#include "ljus/image/color.hpp"
#include "ljus/io/detail/mesh_builder.hpp"
#include "ljus/io/detail/parse.hpp"

namespace ljus {

/// \addtogroup load_obj
/// \{

namespace detail {

struct PlyType {
    std::string_view name, other_name; // in old files, in newer files
    std::size_t size;                  // bytes
    char kind;                         // i: signed, u: unsigned, f: floating point
};
inline constexpr std::array<PlyType, 8> ply_types{{{"char", "int8", 1, 'i'},
                                                   {"uchar", "uint8", 1, 'u'},
                                                   {"short", "int16", 2, 'i'},
                                                   {"ushort", "uint16", 2, 'u'},
                                                   {"int", "int32", 4, 'i'},
                                                   {"uint", "uint32", 4, 'u'},
                                                   {"float", "float32", 4, 'f'},
                                                   {"double", "float64", 8, 'f'}}};

// A property of an element: a number, or a list of them.
struct PlyProperty {
    std::string_view name;
    PlyType type;
    std::optional<PlyType> count{}; // type of a list's length
};
struct PlyElement {
    std::string_view name;
    std::size_t count;
    std::vector<PlyProperty> properties{};
};

// The indices of the properties that give the position, normal, colour and texture
// coordinates of a vertex; -1 for none.
struct PlyVertex {
    std::array<int, 3> position{-1, -1, -1}, normal{-1, -1, -1}, color{-1, -1, -1};
    std::array<int, 2> uv{-1, -1};
};

template <std::floating_point T>
class PlyReader {
public:
    PlyReader(const Bytes& bytes, const std::string& file,
              const MeshFileSettings& settings)
        : rest_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), file_(file),
          mesh_(settings) {
        mesh_.report.unit = "element";
    }

    std::vector<MeshFacesT<T>> take_faces(LoadedMeshT<T>& loaded) {
        read_header();
        read_elements();
        std::vector<MeshFacesT<T>> parts = mesh_.take_faces({nullptr});
        for (MeshFacesT<T>& part : parts)
            if (!part.colors.empty()) part.material.diffuse = glm::dvec3(1);
        loaded.report = std::move(mesh_.report);
        return parts;
    }

private:
    [[noreturn]] void refuse(std::string_view why) const { refuse_file(file_, why); }

    PlyType type_of(std::string_view name) const {
        for (const PlyType& type : ply_types)
            if (name == type.name || name == type.other_name) return type;
        refuse(join({"its header has the type ", shown(std::string(name)),
                     "; types are char, uchar, short, ushort, int, uint, float and "
                     "double"}));
    }
    void read_header() {
        const std::string_view all = rest_ = plain_text(rest_, file_);
        if (take_line(rest_) != "ply") refuse("it does not begin with a line 'ply'");
        const bool cr = all.size() > 4 && all[3] == '\r' && all[4] != '\n';
        bool format = false;
        for (std::string_view line;;) {
            if (rest_.empty()) refuse("its header has no line 'end_header'");
            line = take_line(rest_);
            Words words{line};
            const std::string_view keyword = words.next();
            if (keyword == "end_header") {
                // If lines end in CR alone, a following LF belongs to the numbers.
                const std::size_t used = line.size() + 1;
                const auto from = static_cast<std::size_t>(line.data() - all.data());
                if (cr) rest_ = all.substr(std::min(from + used, all.size()));
                break;
            }
            if (keyword == "format") {
                format = true;
                read_format(words);
            } else if (keyword == "element") {
                read_element_line(words);
            } else if (keyword == "property") {
                read_property(words);
            } else if (keyword == "comment" && words.next() == "TextureFile") {
                mesh_.report.notes.push_back(
                    join({"the header names the picture ", shown(words.name()),
                          ", which is not loaded; a material of yours can have it."}));
            } else if (!keyword.empty() && keyword != "comment" &&
                       keyword != "obj_info" && mesh_.report.notes.empty()) {
                mesh_.report.notes.push_back(
                    join({"the header has the line ", shown(std::string(line)),
                          ", which is none of a PLY file; it is not used."}));
            }
        }
        if (!format) refuse("its header has no line 'format'");
    }
    void read_format(Words words) {
        const std::string_view name = words.next(), version = words.next();
        if (name == "ascii")
            ascii_ = true;
        else if (name == "binary_big_endian")
            big_endian_ = true;
        else if (name != "binary_little_endian")
            refuse(join({"its format is ", shown(std::string(name)),
                         "; it must be ascii, binary_little_endian or "
                         "binary_big_endian"}));
        if (version != "1.0")
            refuse(join({"its format has the version ", shown(std::string(version)),
                         "; only 1.0 is known"}));
    }
    void read_element_line(Words words) {
        const std::string_view name = words.next(), count = words.next();
        const bool plain = count.find(',') == count.npos; // not 1,000
        const double number = plain ? number_of(count) : -1;
        if (!(number >= 0 && number <= 1e9 && number == std::floor(number)))
            refuse(join({"its header has ", shown(std::string(count)), " elements ",
                         shown(std::string(name)),
                         "; there must be a whole number of them, at most 1e9"}));
        elements_.push_back({name, static_cast<std::size_t>(number)});
    }
    void read_property(Words words) {
        if (elements_.empty()) refuse("its header has a property before any element");
        std::string_view type = words.next();
        PlyProperty property{};
        if (type == "list") {
            property.count = type_of(words.next());
            if (property.count->kind == 'f')
                refuse("its header has a list whose length is no whole number");
            type = words.next();
        }
        property.type = type_of(type);
        property.name = words.next();
        elements_.back().properties.push_back(property);
    }

    [[noreturn]] void end_early(const PlyElement& element, std::size_t i) const {
        refuse(join({"the file ends within its element ", std::to_string(i + 1), " of ",
                     std::to_string(element.count), ", ",
                     shown(std::string(element.name))}));
    }
    // Reads the next number of the file; NaN for a word that is no number.
    double number(const PlyType& type, const PlyElement& element, std::size_t i) {
        if (ascii_) {
            constexpr std::string_view blanks = " \t\r\n";
            rest_.remove_prefix(
                std::min(rest_.find_first_not_of(blanks), rest_.size()));
            const std::string_view text = rest_.substr(0, rest_.find_first_of(blanks));
            if (text.empty()) end_early(element, i);
            rest_.remove_prefix(text.size());
            return number_of(text);
        }
        if (rest_.size() < type.size) end_early(element, i);
        const std::string_view bytes = rest_.substr(0, type.size);
        rest_.remove_prefix(type.size);
        return binary_number(bytes, type.kind, big_endian_);
    }
    std::size_t list_length(const PlyProperty& list, const PlyElement& element,
                            std::size_t i) {
        const double count = number(*list.count, element, i);
        if (!(count >= 0 && count == std::floor(count)))
            refuse(join({"element ", std::to_string(i + 1), " of ",
                         std::to_string(element.count), ", ",
                         shown(std::string(element.name)), ", has a list of ",
                         to_text(count), " numbers; it must be a whole number"}));
        // Each number takes at least one byte, in a text at least two with its blank.
        if (count > double(rest_.size())) end_early(element, i);
        return static_cast<std::size_t>(count);
    }

    static int index_of(const PlyElement& element,
                        std::initializer_list<std::string_view> names) {
        for (std::size_t i = 0; i < element.properties.size(); ++i)
            for (const std::string_view name : names)
                if (element.properties[i].name == name && !element.properties[i].count)
                    return static_cast<int>(i);
        return -1;
    }
    static PlyVertex properties_of(const PlyElement& element) {
        const auto at = [&](auto... names) { return index_of(element, {names...}); };
        return {.position{at("x"), at("y"), at("z")},
                .normal{at("nx"), at("ny"), at("nz")},
                .color{at("red", "diffuse_red"), at("green", "diffuse_green"),
                       at("blue", "diffuse_blue")},
                .uv{at("u", "s", "texture_u"), at("v", "t", "texture_v")}};
    }
    // Reads all elements. Faces that precede the vertices in the file are read after
    // the vertices.
    void read_elements() {
        const auto is_vertex = [](const PlyElement& e) { return e.name == "vertex"; };
        const auto vertices =
            std::find_if(elements_.begin(), elements_.end(), is_vertex);
        std::vector<std::pair<const PlyElement*, std::string_view>> later;
        for (auto e = elements_.begin(); e != elements_.end(); ++e) {
            const bool early = e < vertices && has_triangles(*e);
            if (early) later.emplace_back(&*e, rest_);
            read_element(*e, early);
        }
        std::string_view behind = rest_;
        if (ascii_)
            behind.remove_prefix(
                std::min(behind.find_first_not_of(" \t\r\n"), behind.size()));
        for (const auto& [element, at] : later) {
            rest_ = at;
            read_element(*element, false);
        }
        if (!behind.empty())
            mesh_.report.notes.push_back(
                join({"the file goes on for ", std::to_string(behind.size()),
                      " bytes behind the last element that its header lists; they are "
                      "not used."}));
    }
    static bool has_triangles(const PlyElement& element) {
        return element.name == "face" || element.name == "tristrips";
    }
    static bool is_face_uv(const PlyProperty& property) {
        return property.count && property.name == "texcoord";
    }
    static bool is_corners(const PlyProperty& property) {
        return property.count &&
               (property.name == "vertex_indices" || property.name == "vertex_index");
    }
    void note_unused(const PlyElement& element, const PlyVertex& has) {
        std::string unused;
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            const auto in = [&](const auto& at) {
                return whole(at) && std::count(at.begin(), at.end(), int(i)) > 0;
            };
            if (in(has.position) || in(has.normal) || in(has.color) || in(has.uv) ||
                (has_triangles(element) && is_corners(property)) ||
                (element.name == "face" && is_face_uv(property)))
                continue;
            unused.append(unused.empty() ? "" : ", ").append(property.name);
        }
        if (!unused.empty())
            mesh_.report.notes.push_back(
                join({"properties of the elements ", element.name,
                      " are not used: ", shown(unused, 200), "."}));
    }
    template <std::size_t N>
    static bool whole(const std::array<int, N>& at) {
        return std::all_of(at.begin(), at.end(), [](int k) { return k >= 0; });
    }
    // Reads all elements of one kind; with `pass_over` faces are only skipped.
    void read_element(const PlyElement& element, bool pass_over) {
        const bool vertex = element.name == "vertex";
        const bool face = has_triangles(element) && !pass_over;
        const PlyVertex has = vertex ? properties_of(element) : PlyVertex{};
        if (vertex && !whole(has.position))
            refuse("its vertices must have the properties x, y and z");
        if (element.properties.empty()) return; // such elements take no bytes
        if (vertex || face) note_unused(element, has);
        if (element.count > 0 && !vertex && !has_triangles(element))
            mesh_.report.notes.push_back(join(
                {"the elements ", shown(std::string(element.name)), " are not used."}));
        std::vector<double> values(element.properties.size()), corners, face_uv;
        for (std::size_t i = 0; i < element.count; ++i) {
            ++mesh_.place;
            corners.clear();
            face_uv.clear();
            bool found = false;
            for (std::size_t k = 0; k < values.size(); ++k) {
                const PlyProperty& property = element.properties[k];
                if (!property.count) {
                    values[k] = number(property.type, element, i);
                    continue;
                }
                const bool names_vertices = face && !found && is_corners(property);
                const bool is_uv = face && is_face_uv(property);
                found = found || names_vertices;
                for (std::size_t n = list_length(property, element, i); n > 0; --n) {
                    const double value = number(property.type, element, i);
                    if (names_vertices) corners.push_back(value);
                    if (is_uv) face_uv.push_back(value);
                }
            }
            if (vertex) add_vertex(element, has, values);
            if (found && element.name == "face") add_face(corners, face_uv);
            if (found && element.name != "face") add_strips(corners);
        }
    }
    void add_vertex(const PlyElement& element, const PlyVertex& has,
                    const std::vector<double>& values) {
        const auto value = [&](int k) { return values[static_cast<std::size_t>(k)]; };
        const auto vector = [&](const std::array<int, 3>& at) {
            return glm::dvec3(value(at[0]), value(at[1]), value(at[2]));
        };
        mesh_.add_position(vector(has.position));
        normals_ = whole(has.normal);
        if (normals_) mesh_.add_normal(vector(has.normal));
        uv_ = whole(has.uv);
        if (uv_) add_uv(value(has.uv[0]), value(has.uv[1]));
        if (!whole(has.color)) return;
        glm::dvec3 color = vector(has.color);
        for (int k = 0; k < 3; ++k) {
            const PlyType& type =
                element.properties[static_cast<std::size_t>(has.color[std::size_t(k)])]
                    .type;
            const bool is_ushort = type.kind == 'u' && type.size == 2;
            if (type.kind != 'f') color[k] /= is_ushort ? 65535 : 255;
            if (color[k] >= 0 && color[k] <= 1) color[k] = srgb_decode(color[k]);
        }
        mesh_.add_color(color);
    }
    std::uint32_t add_uv(double u, double v) {
        mesh_.add_uv(u, v);
        return uv_count_++;
    }
    // Adds a face, whose corners may have texture coordinates of their own.
    void add_face(const std::vector<double>& corners,
                  const std::vector<double>& face_uv) {
        const bool own_uv = face_uv.size() == 2 * corners.size();
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const double value = corners[k];
            const bool good = value >= 0 && value < double(no_number);
            const std::uint32_t at =
                good ? static_cast<std::uint32_t>(value) : no_number;
            const bool whole = good && double(at) == value;
            const std::uint32_t uv = own_uv ? add_uv(face_uv[2 * k], face_uv[2 * k + 1])
                                     : uv_  ? at
                                            : no_number;
            mesh_.add_corner(whole ? at : no_number, uv, normals_ ? at : no_number);
        }
        mesh_.end_face();
    }

    // Adds strips of triangles, each of which ends with -1. Every second triangle of a
    // strip is wound the other way.
    void add_strips(const std::vector<double>& corners) {
        for (std::size_t i = 0, in_strip = 0; i < corners.size(); ++i) {
            if (corners[i] == -1) {
                in_strip = 0;
                continue;
            }
            if (in_strip >= 2) {
                const std::size_t odd = in_strip % 2;
                add_face({corners[i - 2 + odd], corners[i - 1 - odd], corners[i]}, {});
            }
            ++in_strip;
        }
    }

    std::string_view rest_; // unread part of the file
    const std::string& file_;
    MeshBuilder<T> mesh_;
    std::vector<PlyElement> elements_{};
    bool ascii_ = false, big_endian_ = false;
    bool normals_ = false, uv_ = false; // of the vertices
    std::uint32_t uv_count_ = 0;
};

} // namespace detail

/// Reads a mesh from the bytes of a PLY file: text or binary of either byte order.
/// Vertices have positions (x, y, z) and may have normals (nx, ny, nz), texture
/// coordinates (u, v; s, t; or texture_u, texture_v) and colours (red, green, blue, or
/// with diffuse_ before each). Faces may have any number of corners, and a list
/// texcoord with two texture coordinates per corner. The list of an element tristrips
/// has strips of triangles; each strip ends with -1. Colours are sRGB, as integers from
/// 0 to 255, as ushort from 0 to 65535, or as floats from 0 to 1. They become a picture
/// on a white mesh.
/// \return One mesh without a material, and a report of the problems of the file.
/// \throws std::runtime_error  with one sentence: "bunny.ply: the file ends within its
///         element 8 of 35947, vertex."; or as read_obj().
/// \throws std::invalid_argument  unless the scale is finite and above 0.
/// \cost Time and memory linear in the size of the file.
template <std::floating_point T = float>
[[nodiscard]] LoadedMeshT<T> read_ply(Bytes bytes, const std::string& file,
                                      const MeshFileSettings& settings = {}) {
    const auto read = [&](LoadedMeshT<T>& loaded) {
        const Bytes own = std::move(bytes); // freed before the meshes are made
        return detail::PlyReader<T>(own, file, settings).take_faces(loaded);
    };
    return detail::make_meshes<T>(
        file, settings, "; a mesh has elements 'face' with a list 'vertex_indices'.",
        read, detail::no_pictures);
}

/// Loads a PLY file; see read_ply().
/// \throws std::runtime_error  as read_ply(), or if the file cannot be read.
template <std::floating_point T = float>
[[nodiscard]] LoadedMeshT<T> load_ply(const std::string& path,
                                      const MeshFileSettings& settings = {}) {
    return read_ply<T>(load_file(path, detail::max_mesh_file), path, settings);
}

/// \}

} // namespace ljus
