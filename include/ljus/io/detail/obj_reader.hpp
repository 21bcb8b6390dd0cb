#pragma once

/// \file ljus/io/detail/obj_reader.hpp
/// \brief The reader of load_obj(), line by line; it checks every number.

#include <cmath>
#include <compare>
#include <map>
#include <optional>

#ifndef TINY_OBJ_LOADER_H_ // the header guards its declarations only
#include <tiny_obj_loader.h>
#endif

#include "ljus/geometry/detail/polygon.hpp"
#include "ljus/io/detail/obj_material.hpp"

namespace ljus {

/// \defgroup obj_reader Reading mesh files
/// \brief Optional: tinyobjloader finds lines and words. It silently misreads malformed
/// numbers, so that the reader parses numbers itself.
/// \{

/// The normals of a mesh from a file.
enum class ObjNormals : std::uint8_t {
    file,   ///< Those of the file, or of the triangles if it has none.
    smooth, ///< Those of smooth_normals(), even if the file has normals.
    flat    ///< Those of the triangles.
};

/// The settings of load_obj().
struct ObjSettings {
    double scale = 1;                      ///< Factor of every coordinate.
    ObjNormals normals = ObjNormals::file; ///< Which normals.
    bool pictures = true;                  ///< True: loads the pictures of map_Kd.
};

namespace detail {

// A corner of a face: indices from 0.
struct ObjCorner {
    std::uint32_t position = 0;
    std::optional<std::uint32_t> normal{};
    std::optional<std::uint32_t> uv{};

    friend auto operator<=>(const ObjCorner&, const ObjCorner&) = default;
};

// The faces of one material that have been read.
template <std::floating_point T>
struct ObjFacesT {
    ObjMaterial material{};
    MeshDataT<T> data{};
    std::map<ObjCorner, std::uint32_t> vertices{}; // of `data`: one for equal corners
    bool smooth = false;                           // true if any face has normals
    bool has_uv = false;                 // true if any face has texture coordinates
    std::vector<long long> without_uv{}; // lines of faces that have none
};

// The state of reading a file.
template <std::floating_point T>
struct ObjReader {
    const ObjSettings& settings;
    LastLine line;
    ObjReport report{};
    MeshDataT<T> whole{};            // all vertices of the file, NaN for a bad one
    std::vector<glm::dvec3> exact{}; // the same, in the file's own units
    std::vector<long long> lines{};  // of the triangles of `whole`
    std::vector<Vec3T<T>> normals{}; // 0 for a bad one
    std::vector<Vec2T<T>> uv{};      // NaN for a bad one
    std::map<std::string, ObjMaterial> materials{};
    std::map<std::string, std::size_t> numbers{}; // index of the part of each material
    std::vector<ObjFacesT<T>> parts{};
    std::string material{}; // of the faces that follow

    void vertex() {
        exact.push_back(numbers_of(line.text()));
        whole.positions.emplace_back(settings.scale * exact.back());
        if (!is_finite(whole.positions.back()))
            report.add(ObjTrouble::bad_number, line.number);
    }
    void normal() {
        const glm::dvec3 n = numbers_of(line.text());
        const double length = glm::length(n);
        const bool good = length > 0 && std::isfinite(length);
        if (!good) report.add(ObjTrouble::bad_normal, line.number);
        normals.emplace_back(good ? n / length : glm::dvec3(0));
    }
    void texture() {
        const std::string_view text = line.text();
        glm::dvec3 at = numbers_of(text);
        if (words_of(text).size() < 3) at.y = 0; // a picture with one row
        uv.emplace_back(T(at.x), T(at.y));
        if (!has_place(uv.back())) report.add(ObjTrouble::bad_uv, line.number);
    }
    static bool has_place(const Vec2T<T>& uv) {
        return std::isfinite(uv.x) && std::isfinite(uv.y);
    }
    void use(std::string name) {
        (void)line.text();
        while (!name.empty() && (name.back() == ' ' || name.back() == '\t'))
            name.pop_back();
        const bool known = materials.count(name) > 0;
        if (!known) report.add(ObjTrouble::no_material, line.number);
        material = known ? name : std::string();
    }
    // A corner of a face; nothing if an index does not exist.
    std::optional<ObjCorner> corner_of(const tinyobj::index_t& named) const {
        const auto position = place_of(named.vertex_index, exact.size());
        const auto normal = place_of(named.normal_index, normals.size());
        const auto place = place_of(named.texcoord_index, uv.size());
        if (!position || (named.normal_index != 0 && !normal) ||
            (named.texcoord_index != 0 && !place))
            return std::nullopt;
        return ObjCorner{*position, normal, place};
    }
    void face(const tinyobj::index_t* named, std::size_t count) {
        const bool good = all_read(line.text(), count);
        if (count < 3) return report.add(ObjTrouble::few_corners, line.number);
        if (count > 1000) return report.add(ObjTrouble::many_corners, line.number);
        std::vector<ObjCorner> corners;
        std::vector<glm::dvec3> points;
        for (std::size_t i = 0; i < count; ++i) {
            const auto corner = corner_of(named[i]);
            if (!good || !corner) return report.add(ObjTrouble::bad_index, line.number);
            if (!is_finite(whole.positions[corner->position]))
                return; // reported at the vertex
            corners.push_back(*corner);
            points.push_back(exact[corner->position]);
        }
        keep_what_all_have(corners);
        const auto triangles = cut_polygon(points);
        bool empty = triangles.empty();
        for (const auto& [a, b, c] : triangles)
            empty = !add({corners[a], corners[b], corners[c]}) || empty;
        if (empty) report.add(ObjTrouble::no_area, line.number);
    }
    // Drops normals or texture coordinates unless they are valid at every corner of the
    // face.
    void keep_what_all_have(std::vector<ObjCorner>& corners) const {
        bool all_normals = settings.normals == ObjNormals::file;
        bool all_uv = true;
        for (const ObjCorner& corner : corners) {
            all_normals =
                all_normals && corner.normal && normals[*corner.normal] != Vec3T<T>{0};
            all_uv = all_uv && corner.uv && has_place(uv[*corner.uv]);
        }
        for (ObjCorner& corner : corners) {
            if (!all_normals) corner.normal.reset();
            if (!all_uv) corner.uv.reset();
        }
    }
    // Adds one triangle of a face; false if it has no area.
    bool add(std::array<ObjCorner, 3> corners) {
        whole.triangles.push_back(
            {corners[0].position, corners[1].position, corners[2].position});
        const auto across =
            cross_of_edges(triangle_of(whole, whole.triangles.size() - 1));
        if (!(glm::dot(across, across) > 0)) {
            whole.triangles.pop_back();
            return false;
        }
        lines.push_back(line.number);
        if (corners[0].normal && !normals_point_along(across, corners)) {
            report.add(ObjTrouble::turned, line.number);
            for (ObjCorner& corner : corners) corner.normal.reset();
        }
        ObjFacesT<T>& part = part_in_use();
        part.smooth = part.smooth || corners[0].normal;
        part.has_uv = part.has_uv || corners[0].uv;
        auto& without = part.without_uv;
        if (!corners[0].uv && (without.empty() || without.back() != line.number))
            without.push_back(line.number);
        part.data.triangles.push_back({vertex_of(part, corners[0]),
                                       vertex_of(part, corners[1]),
                                       vertex_of(part, corners[2])});
        return true;
    }
    bool normals_point_along(const Vec3T<WideT<T>>& across,
                             const std::array<ObjCorner, 3>& corners) const {
        Vec3T<T> sum{0};
        for (const ObjCorner& corner : corners) sum += normals[*corner.normal];
        return glm::dot(Vec3T<WideT<T>>(sum), across) > 0;
    }
    ObjFacesT<T>& part_in_use() {
        const auto [at, fresh] = numbers.try_emplace(material, parts.size());
        if (fresh) {
            parts.emplace_back();
            if (!material.empty()) parts.back().material = materials[material];
        }
        return parts[at->second];
    }
    // The index of a corner's vertex in a part; added if it is new.
    std::uint32_t vertex_of(ObjFacesT<T>& part, const ObjCorner& corner) const {
        const auto [at, fresh] = part.vertices.try_emplace(
            corner, static_cast<std::uint32_t>(part.data.positions.size()));
        if (fresh) {
            part.data.positions.push_back(whole.positions[corner.position]);
            part.data.normals.push_back(corner.normal ? normals[*corner.normal]
                                                      : Vec3T<T>{0});
            part.data.uv.push_back(corner.uv ? uv[*corner.uv] : Vec2T<T>{0});
        }
        return at->second;
    }
};

// smooth_normals() that ignores seams of the texture coordinates.
template <std::floating_point T>
void smooth_across_seams(ObjFacesT<T>& part) {
    MeshDataT<T> seamless{.triangles = part.data.triangles};
    std::map<std::uint32_t, std::uint32_t> numbers; // by position in the file
    std::vector<std::uint32_t> of(part.data.positions.size());
    for (const auto& [corner, vertex] : part.vertices) {
        const auto [at, fresh] = numbers.try_emplace(
            corner.position, static_cast<std::uint32_t>(seamless.positions.size()));
        if (fresh) seamless.positions.push_back(part.data.positions[vertex]);
        of[vertex] = at->second;
    }
    for (auto& triangle : seamless.triangles)
        for (std::uint32_t& vertex : triangle) vertex = of[vertex];
    smooth_normals(seamless);
    part.data.normals.clear();
    for (const std::uint32_t vertex : of)
        part.data.normals.push_back(seamless.normals[vertex]);
}

// Drops the normals or texture coordinates of a part if no face has them, and reports
// the faces that lack those of others.
template <std::floating_point T>
void finish(ObjFacesT<T>& part, ObjNormals normals, ObjReport& report) {
    if (!part.smooth) part.data.normals.clear();
    if (normals == ObjNormals::smooth) smooth_across_seams(part);
    if (!part.has_uv) return part.data.uv.clear();
    for (const long long line : part.without_uv) report.add(ObjTrouble::no_uv, line);
}

} // namespace detail

/// \}

} // namespace ljus
