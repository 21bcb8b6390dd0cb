#pragma once

/// \file ljus/io/detail/obj_reader.hpp
/// \brief How load_obj() reads: line by line, trusting no number.

#include <cmath>
#include <compare>
#include <map>
#include <optional>
#include <unordered_map>

#include "ljus/geometry/detail/polygon.hpp"
#include "ljus/io/detail/obj_material.hpp"

namespace ljus {

/// \defgroup obj_reader Reading mesh files
/// \brief Lines, words and numbers of OBJ and MTL files. No number is trusted: what
/// cannot be used is counted in the report, with its line.
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

// A corner of a face: the numbers, from 0, of what the file says of it.
struct ObjCorner {
    std::uint32_t position = 0;
    std::optional<std::uint32_t> normal{};
    std::optional<std::uint32_t> uv{};

    friend bool operator==(const ObjCorner&, const ObjCorner&) = default;
};
struct ObjCornerHash {
    std::size_t operator()(const ObjCorner& corner) const noexcept {
        const auto number = [](const std::optional<std::uint32_t>& from) {
            return std::uint64_t(from.value_or(0xffffffffu));
        };
        std::uint64_t hash = corner.position;
        for (const std::uint64_t more : {number(corner.uv), number(corner.normal)})
            hash = (hash ^ more) * 0x9e3779b97f4a7c15u;
        return static_cast<std::size_t>(hash ^ hash >> 32);
    }
};

// The faces of one material, as far as they have been read.
template <std::floating_point T>
struct ObjFacesT {
    ObjMaterial material{};
    MeshDataT<T> data{};
    // Of `data`: one for equal corners.
    std::unordered_map<ObjCorner, std::uint32_t, ObjCornerHash> vertices{};
    std::vector<std::uint32_t> positions{}; // of the vertices, in the file
    bool smooth = false;                    // whether any face has normals
    bool has_uv = false;                    // whether any face has texture coordinates
    std::vector<long long> without_uv{};    // lines of faces that have none
};

// The state of reading a file.
template <std::floating_point T>
struct ObjReader {
    const std::string& file; // its name, beside which its material files are
    const ObjSettings& settings;
    long long line = 0; // that is read
    ObjReport report{};
    MeshDataT<T> whole{};            // all vertices of the file, NaN for a bad one
    std::vector<glm::dvec3> exact{}; // the same, in the file's own units
    std::vector<long long> lines{};  // of the triangles of `whole`
    std::vector<Vec3T<T>> normals{}; // 0 for a bad one
    std::vector<Vec2T<T>> uv{};      // NaN for a bad one
    MaterialLibraries libraries{};
    std::map<std::string, std::size_t> numbers{}; // of the parts, by material
    std::vector<ObjFacesT<T>> parts{};
    std::string material{};                   // that faces have from here on
    std::optional<std::size_t> part{};        // of that material, once it has a face
    bool in_smooth_group = false;             // whether s is neither off nor 0
    std::vector<ObjCorner> face_corners{};    // of the face that is read
    std::vector<glm::dvec3> face_positions{}; // of these

    void read(std::string_view text) {
        each_line(text, [&](std::string_view all, long long number) {
            Words words{all};
            if (words.next() == "mtllib") // wherever it stands
                libraries.add(words.name(), file, number, report);
        });
        each_line(text, [&](std::string_view all, long long number) {
            Words words{all};
            line = number;
            const std::string_view keyword = words.next();
            if (keyword == "v")
                vertex(words);
            else if (keyword == "vn")
                normal(words);
            else if (keyword == "vt")
                texture(words);
            else if (keyword == "f" || keyword == "fo") // as old files have it
                face(words);
            else if (keyword == "usemtl")
                use(words.name());
            else if (keyword == "s")
                smoothing(words.next());
            else if (keyword == "o")
                ++report.content.objects;
            else if (keyword == "g")
                ++report.content.groups;
            else if (keyword == "l" || keyword == "p" || keyword == "curv" ||
                     keyword == "curv2" || keyword == "surf")
                report.add(ObjTrouble::no_face, line);
        });
    }
    void vertex(Words words) {
        exact.push_back(three_numbers(words));
        whole.positions.emplace_back(settings.scale * exact.back());
        if (!is_finite(whole.positions.back()))
            report.add(ObjTrouble::bad_number, line);
        (void)words.next(); // a weight, or red: a colour has three numbers
        if (!words.next().empty()) report.add(ObjTrouble::vertex_color, line);
    }
    void normal(Words words) {
        const glm::dvec3 n = three_numbers(words);
        const double length = glm::length(n);
        const bool good = length > 0 && std::isfinite(length);
        if (!good) report.add(ObjTrouble::bad_normal, line);
        normals.emplace_back(good ? n / length : glm::dvec3(0));
    }
    void texture(Words words) {
        const double u = number_of(words.next());
        const std::string_view second = words.next(); // of a picture of one row: none
        uv.emplace_back(T(u), second.empty() ? T(0) : T(number_of(second)));
        if (!has_place(uv.back())) report.add(ObjTrouble::bad_uv, line);
    }
    static bool has_place(const Vec2T<T>& uv) {
        return std::isfinite(uv.x) && std::isfinite(uv.y);
    }
    void smoothing(std::string_view group) {
        in_smooth_group = !group.empty() && group != "off" && group != "0";
    }
    void use(const std::string& name) {
        const bool known = libraries.materials.contains(name);
        if (!known) report.add(ObjTrouble::no_material, line);
        material = known ? name : std::string();
        part.reset();
    }
    void face(Words words) {
        face_corners.clear();
        face_positions.clear();
        bool good = true, all_uv = true, all_normals = true;
        for (auto word = words.next(); !word.empty(); word = words.next()) {
            if (face_corners.size() == 1000)
                return report.add(ObjTrouble::many_corners, line);
            const ObjIndices named = indices_of(word).value_or(ObjIndices{});
            const auto position = place_of(named.position, exact.size());
            face_corners.push_back({position.value_or(0),
                                    place_of(named.normal, normals.size()),
                                    place_of(named.uv, uv.size())});
            good = good && position;
            all_uv = all_uv && (named.uv == 0 || face_corners.back().uv);
            all_normals =
                all_normals && (named.normal == 0 || face_corners.back().normal);
        }
        if (face_corners.size() < 3) return report.add(ObjTrouble::few_corners, line);
        if (!good) return report.add(ObjTrouble::bad_index, line);
        if (!all_uv) report.add(ObjTrouble::no_such_uv, line);
        if (!all_normals) report.add(ObjTrouble::no_such_normal, line);
        for (const ObjCorner& corner : face_corners) {
            if (!is_finite(whole.positions[corner.position]))
                return; // said at the vertex
            face_positions.push_back(exact[corner.position]);
        }
        keep_what_all_have();
        const CutPolygon cut = cut_polygon(face_positions);
        const std::size_t before = whole.triangles.size();
        bool empty = cut.triangles.empty();
        for (const auto& [a, b, c] : cut.triangles)
            empty = !add({face_corners[a], face_corners[b], face_corners[c]}) || empty;
        if (whole.triangles.size() > before) count_face();
        if (empty) report.add(ObjTrouble::no_area, line);
        if (cut.crossed) report.add(ObjTrouble::crossed, line);
    }
    void count_face() {
        ObjContent& all = report.content;
        ++all.faces;
        all.polygons += face_corners.size() > 3 ? 1 : 0;
        all.flat_faces += face_corners[0].normal ? 0 : 1;
        if (in_smooth_group && !face_corners[0].normal &&
            settings.normals == ObjNormals::file)
            report.add(ObjTrouble::not_smooth, line);
        all.no_uv_faces += face_corners[0].uv ? 0 : 1;
    }
    // Normals and texture coordinates that are not good at every corner of a face are
    // used at none.
    void keep_what_all_have() {
        bool all_normals = settings.normals == ObjNormals::file;
        bool all_uv = true;
        for (const ObjCorner& corner : face_corners) {
            all_normals =
                all_normals && corner.normal && normals[*corner.normal] != Vec3T<T>{0};
            all_uv = all_uv && corner.uv && has_place(uv[*corner.uv]);
        }
        for (ObjCorner& corner : face_corners) {
            if (!all_normals) corner.normal.reset();
            if (!all_uv) corner.uv.reset();
        }
    }
    // One triangle of a face; false if it has no area.
    bool add(std::array<ObjCorner, 3> corners) {
        whole.triangles.push_back(
            {corners[0].position, corners[1].position, corners[2].position});
        const auto across =
            cross_of_edges(triangle_of(whole, whole.triangles.size() - 1));
        if (!(glm::dot(across, across) > 0)) {
            whole.triangles.pop_back();
            return false;
        }
        lines.push_back(line);
        if (corners[0].normal && !normals_point_along(across, corners)) {
            report.add(ObjTrouble::turned, line);
            for (ObjCorner& corner : corners) corner.normal.reset();
        }
        ObjFacesT<T>& into = part_in_use();
        into.smooth = into.smooth || corners[0].normal;
        into.has_uv = into.has_uv || corners[0].uv;
        auto& without = into.without_uv;
        if (!corners[0].uv && (without.empty() || without.back() != line))
            without.push_back(line);
        into.data.triangles.push_back({vertex_of(into, corners[0]),
                                       vertex_of(into, corners[1]),
                                       vertex_of(into, corners[2])});
        return true;
    }
    bool normals_point_along(const Vec3T<WideT<T>>& across,
                             const std::array<ObjCorner, 3>& corners) const {
        Vec3T<T> sum{0};
        for (const ObjCorner& corner : corners) sum += normals[*corner.normal];
        return glm::dot(Vec3T<WideT<T>>(sum), across) > 0;
    }
    ObjFacesT<T>& part_in_use() {
        if (!part) {
            const auto [at, fresh] = numbers.try_emplace(material, parts.size());
            part = at->second;
            if (fresh) {
                parts.emplace_back();
                if (!material.empty())
                    parts.back().material = libraries.materials[material];
            }
        }
        return parts[*part];
    }
    // The vertex of a part that a corner is.
    std::uint32_t vertex_of(ObjFacesT<T>& into, const ObjCorner& corner) const {
        const auto [at, fresh] = into.vertices.try_emplace(
            corner, static_cast<std::uint32_t>(into.data.positions.size()));
        if (fresh) {
            into.positions.push_back(corner.position);
            into.data.positions.push_back(whole.positions[corner.position]);
            into.data.normals.push_back(corner.normal ? normals[*corner.normal]
                                                      : Vec3T<T>{0});
            into.data.uv.push_back(corner.uv ? uv[*corner.uv] : Vec2T<T>{0});
        }
        return at->second;
    }
};

// smooth_normals(), to which a seam of the texture coordinates is no edge.
template <std::floating_point T>
void smooth_across_seams(ObjFacesT<T>& part) {
    MeshDataT<T> seamless{.triangles = part.data.triangles};
    std::unordered_map<std::uint32_t, std::uint32_t> numbers; // by position in the file
    std::vector<std::uint32_t> of;
    for (std::size_t vertex = 0; vertex < part.positions.size(); ++vertex) {
        const auto [at, fresh] =
            numbers.try_emplace(part.positions[vertex],
                                static_cast<std::uint32_t>(seamless.positions.size()));
        if (fresh) seamless.positions.push_back(part.data.positions[vertex]);
        of.push_back(at->second);
    }
    for (auto& triangle : seamless.triangles)
        for (std::uint32_t& vertex : triangle) vertex = of[vertex];
    smooth_normals(seamless);
    part.data.normals.clear();
    for (const std::uint32_t vertex : of)
        part.data.normals.push_back(seamless.normals[vertex]);
}

// Drops the normals or texture coordinates of a part in which no face has any, and
// reports the faces that lack what others have.
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
