#pragma once

/// \file ljus/io/detail/obj_reader.hpp
/// \brief How load_obj() reads: line by line, trusting no number.

#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#ifndef TINY_OBJ_LOADER_H_ // it guards its names, and not what it implements
#include <tiny_obj_loader.h>
#endif

#include "ljus/io/detail/obj_material.hpp"
#include "ljus/io/detail/polygon.hpp"

namespace ljus {

/// \defgroup obj_reader Reading mesh files
/// \brief Optional (tinyobjloader): it finds lines and words; numbers, which it takes
/// for 0 or for another number if it cannot read them, are read again.
/// \{

/// Which normals a mesh from a file gets.
enum class ObjNormals : std::uint8_t {
    file,   ///< The file's; where it has none, the triangles'.
    smooth, ///< Those of smooth_normals(), whatever the file has.
    flat    ///< The triangles'.
};

/// How a mesh file is read.
struct ObjSettings {
    double scale = 1;                      ///< Every coordinate is multiplied by this.
    ObjNormals normals = ObjNormals::file; ///< Which normals.
    bool pictures = true;                  ///< Whether those of map_Kd are loaded.
};

namespace detail {

// The line that a stream has read last, and its number; asked after each line, so that
// lines are counted once.
struct LastLine {
    std::istringstream& stream;
    std::size_t begin = 0;
    LineEnd end{};
    long long number = 0;

    [[nodiscard]] std::string_view text() {
        std::string_view all = stream.view();
        const auto at = stream.tellg(); // -1 at the end
        if (at >= 0) all = all.substr(0, static_cast<std::size_t>(at));
        while (end.next < all.size()) {
            begin = end.next;
            end = line_end(all, begin);
            ++number;
        }
        return all.substr(begin, end.last - begin);
    }
};

// A number of a vertex: from 1, or from the end if negative; none if it is not there.
inline std::optional<std::uint32_t> place_of(int number, std::size_t count) {
    const auto all = static_cast<long long>(count);
    const long long place = number > 0 ? number - 1LL : number + all;
    if (number == 0 || place < 0 || place >= all) return std::nullopt;
    return static_cast<std::uint32_t>(place);
}

// What is known while a file is read.
template <std::floating_point T>
struct ObjReader {
    struct Part {
        ObjMaterial material{};
        MeshDataT<T> data{};
        // By the numbers of position, normal and texture coordinates; -1: none.
        std::map<std::array<long long, 3>, std::uint32_t> vertices{};
        bool smooth = false;                 // whether any face has normals
        bool has_uv = false;                 // whether any face has texture coordinates
        std::vector<long long> without_uv{}; // lines of faces that have none
    };
    const ObjSettings& settings;
    LastLine line;
    ObjReport report{};
    MeshDataT<T> whole{};            // all vertices of the file, NaN for a bad one
    std::vector<glm::dvec3> exact{}; // the same, in the file's own units
    std::vector<long long> lines{};  // of the triangles of `whole`
    std::vector<Vec3T<T>> normals{};
    std::vector<Vec2T<T>> uv{}; // NaN for a bad one
    std::map<std::string, ObjMaterial> materials{};
    std::map<std::string, std::size_t> numbers{}; // of the parts
    std::vector<Part> parts{};
    std::string material{}; // that faces have from here on

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
        if (words_of(text).size() < 3) at.y = 0; // of a picture of one row
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
    // No digit but of a number that tinyobjloader, which stops at other characters and
    // at 2^31 without a word, has read to its end.
    bool all_read(std::size_t corners) {
        const auto words = words_of(line.text());
        bool good = words.size() == corners + 1;
        for (std::size_t i = 1; i < words.size(); ++i) {
            int digits = 0;
            for (const char c : words[i]) {
                digits = c >= '0' && c <= '9' ? digits + 1 : 0;
                good = good && digits < 10 && (digits > 0 || c == '/' || c == '-');
            }
        }
        return good;
    }
    void face(const tinyobj::index_t* corners, std::size_t count) {
        const bool good = all_read(count);
        if (count < 3) return report.add(ObjTrouble::few_corners, line.number);
        if (count > 1000) return report.add(ObjTrouble::many_corners, line.number);
        std::vector<std::uint32_t> places;
        std::vector<long long> own;     // normals, -1: none
        std::vector<long long> painted; // texture coordinates, -1: none
        std::vector<glm::dvec3> points;
        bool has_normals = settings.normals == ObjNormals::file;
        bool has_uv = true;
        for (std::size_t i = 0; i < count; ++i) {
            const auto place = place_of(corners[i].vertex_index, exact.size());
            const int n = corners[i].normal_index;
            const auto of_normal = place_of(n, normals.size());
            const int t = corners[i].texcoord_index;
            const auto of_uv = place_of(t, uv.size());
            if (!good || !place || (n != 0 && !of_normal) || (t != 0 && !of_uv))
                return report.add(ObjTrouble::bad_index, line.number);
            if (!is_finite(whole.positions[*place])) return; // said at the vertex
            has_normals =
                has_normals && of_normal && normals[*of_normal] != Vec3T<T>{0};
            has_uv = has_uv && of_uv && has_place(uv[*of_uv]);
            places.push_back(*place);
            painted.push_back(of_uv ? static_cast<long long>(*of_uv) : -1);
            own.push_back(of_normal ? static_cast<long long>(*of_normal) : -1);
            points.push_back(exact[*place]);
        }
        if (!has_uv) painted.assign(count, -1);
        const auto triangles = cut_polygon(points);
        bool empty = triangles.empty();
        for (const auto& corner : triangles)
            empty = !add(places, own, painted, corner, has_normals) || empty;
        if (empty) report.add(ObjTrouble::no_area, line.number);
    }
    // One triangle of a face; false if it has no area.
    bool add(const std::vector<std::uint32_t>& places,
             const std::vector<long long>& own, const std::vector<long long>& painted,
             const std::array<std::uint32_t, 3>& corner, bool has_normals) {
        whole.triangles.push_back(
            {places[corner[0]], places[corner[1]], places[corner[2]]});
        const auto across =
            cross_of_edges(triangle_of(whole, whole.triangles.size() - 1));
        if (!(glm::dot(across, across) > 0)) {
            whole.triangles.pop_back();
            return false;
        }
        lines.push_back(line.number);
        if (has_normals) {
            Vec3T<T> sum{0};
            for (const std::uint32_t k : corner)
                sum += normals[static_cast<std::size_t>(own[k])];
            has_normals = glm::dot(Vec3T<WideT<T>>(sum), across) > 0;
            if (!has_normals) report.add(ObjTrouble::turned, line.number);
        }
        const auto [at, fresh] = numbers.try_emplace(material, parts.size());
        if (fresh) {
            parts.emplace_back();
            if (!material.empty()) parts.back().material = materials[material];
        }
        Part& part = parts[at->second];
        part.smooth = part.smooth || has_normals;
        const bool has_uv = painted[0] >= 0;
        part.has_uv = part.has_uv || has_uv;
        auto& without = part.without_uv;
        if (!has_uv && (without.empty() || without.back() != line.number))
            without.push_back(line.number);
        std::array<std::uint32_t, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            const long long n = has_normals ? own[corner[k]] : -1;
            const long long t = painted[corner[k]];
            const auto [vertex, unseen] = part.vertices.try_emplace(
                {places[corner[k]], n, t},
                static_cast<std::uint32_t>(part.data.positions.size()));
            triangle[k] = vertex->second;
            if (!unseen) continue;
            part.data.positions.push_back(whole.positions[places[corner[k]]]);
            part.data.normals.push_back(n < 0 ? Vec3T<T>{0}
                                              : normals[static_cast<std::size_t>(n)]);
            part.data.uv.push_back(t < 0 ? Vec2T<T>{0}
                                         : uv[static_cast<std::size_t>(t)]);
        }
        part.data.triangles.push_back(triangle);
        return true;
    }
};

// smooth_normals(), to which a seam of the texture coordinates is no edge.
template <std::floating_point T>
void smooth_across_seams(typename ObjReader<T>::Part& part) {
    MeshDataT<T> seamless{.triangles = part.data.triangles};
    std::map<long long, std::uint32_t> numbers;
    std::vector<std::uint32_t> of(part.data.positions.size());
    for (const auto& [key, vertex] : part.vertices) {
        const auto [at, fresh] = numbers.try_emplace(
            key[0], static_cast<std::uint32_t>(seamless.positions.size()));
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

} // namespace detail

/// \}

} // namespace ljus
