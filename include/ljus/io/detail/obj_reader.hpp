#pragma once

/// \file ljus/io/detail/obj_reader.hpp
/// \brief How load_obj() reads: line by line, trusting no number.

#include <cmath>
#include <map>
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

// What the file says of a corner of a face: numbers, from 0, in its lists of positions,
// texture coordinates, normals and names of materials; or no_number.
using ObjCorner = std::array<std::uint32_t, 4>;
inline constexpr std::size_t of_position = 0, of_uv = 1, of_normal = 2, of_material = 3;
inline constexpr auto no_number = std::numeric_limits<std::uint32_t>::max();

// The number, from 0, that a number of the file means in a list of `count`.
inline std::uint32_t place_of(long long number, std::size_t count) {
    const auto all = static_cast<long long>(count);
    if (number == 0 || number > all || number < -all) return no_number;
    return static_cast<std::uint32_t>(number > 0 ? number - 1 : number + all);
}

// All faces of one material.
template <std::floating_point T>
struct ObjFacesT {
    ObjMaterial material{};
    MeshDataT<T> data{};
    std::vector<std::uint32_t> positions{}; // of its vertices, in the file
    bool has_normals = false, has_uv = false;
    std::uint32_t without_uv = 0; // line of the last face that has none

    // smooth_normals(), to which a seam of the texture coordinates is no edge.
    void smooth() {
        MeshDataT<T> seamless{.positions = data.positions};
        std::unordered_map<std::uint32_t, std::uint32_t> first; // at each position
        std::vector<std::uint32_t> of;
        for (const std::uint32_t position : positions) {
            const auto vertex = static_cast<std::uint32_t>(of.size());
            of.push_back(first.try_emplace(position, vertex).first->second);
        }
        for (const auto& [a, b, c] : data.triangles)
            seamless.triangles.push_back({of[a], of[b], of[c]});
        smooth_normals(seamless);
        data.normals.clear();
        for (const std::uint32_t vertex : of)
            data.normals.push_back(seamless.normals[vertex]);
    }
};

// Reads a file line by line. Which materials there are is known at its end.
template <std::floating_point T>
class ObjReader {
public:
    ObjReader(const std::string& file, const ObjSettings& settings)
        : file_(file), settings_(settings), text_{file} {}

    ObjReport report{};

    // Reads a piece of the file, as LineReader::read() does.
    std::size_t read(std::string_view piece, bool last) {
        return text_.read(piece, last, [&](std::string_view line, long long number) {
            line_ = number;
            read_line({line});
        });
    }

    // The faces by material, in the order of its first use. Completes the report.
    std::vector<ObjFacesT<T>> take_faces() {
        report.content.vertices = static_cast<long long>(positions_.size());
        report.content.normals = static_cast<long long>(normals_.size());
        report.content.uvs = static_cast<long long>(uv_.size());
        report.content.unused = std::count(latest_.begin(), latest_.end(), no_number);
        count_edges(whole_, lines_, report);

        std::vector<const ObjMaterial*> known(names_.size() + 1); // nullptr for none
        for (const auto& [name, use] : names_) {
            const auto found = libraries_.materials.find(name);
            if (found == libraries_.materials.end())
                report.add(ObjTrouble::no_material, use.at.line, use.at.count);
            else if (!name.empty())
                known[use.number] = &found->second;
        }
        std::vector<ObjFacesT<T>> parts;
        std::unordered_map<const ObjMaterial*, std::size_t> numbers; // of the parts
        const auto part_of = [&](const ObjCorner& corner) -> ObjFacesT<T>& {
            const ObjMaterial* const material = known[corner[of_material]];
            const auto [at, fresh] = numbers.try_emplace(material, parts.size());
            if (fresh) parts.push_back({material ? *material : ObjMaterial{}});
            return parts[at->second];
        };
        std::vector<std::uint32_t> vertices; // of `whole_`, in their parts
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const auto [position, uv, normal, material] = corners_[i];
            ObjFacesT<T>& part = part_of(corners_[i]);
            vertices.push_back(static_cast<std::uint32_t>(part.positions.size()));
            part.positions.push_back(position);
            part.data.positions.push_back(whole_.positions[i]);
            part.data.normals.push_back(normal != no_number ? normals_[normal]
                                                            : Vec3T<T>{0});
            part.data.uv.push_back(uv != no_number ? uv_[uv] : Vec2T<T>{0});
            part.has_normals = part.has_normals || normal != no_number;
            part.has_uv = part.has_uv || uv != no_number;
        }
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const auto [a, b, c] = whole_.triangles[i];
            ObjFacesT<T>& part = part_of(corners_[a]);
            part.data.triangles.push_back({vertices[a], vertices[b], vertices[c]});
            if (part.has_uv && corners_[a][of_uv] == no_number &&
                part.without_uv != lines_[i])
                report.add(ObjTrouble::no_uv, part.without_uv = lines_[i]);
        }
        for (ObjFacesT<T>& part : parts) {
            if (!part.has_normals) part.data.normals.clear();
            if (settings_.normals == ObjNormals::smooth) part.smooth();
            if (!part.has_uv) part.data.uv.clear();
        }
        return parts;
    }

private:
    // A name of a material.
    struct Name {
        std::uint32_t number;
        ObjCount at; // lines usemtl
    };

    void read_line(Words words) {
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
        else if (keyword == "mtllib")
            libraries_.add(words.name(), file_, line_, report);
        else if (keyword == "s")
            smoothing(words.next());
        else if (keyword == "o")
            ++report.content.objects;
        else if (keyword == "g")
            ++report.content.groups;
        else if (keyword == "l" || keyword == "p" || keyword == "curv" ||
                 keyword == "curv2" || keyword == "surf")
            report.add(ObjTrouble::no_face, line_);
    }
    void vertex(Words words) {
        positions_.push_back(three_numbers(words));
        latest_.push_back(no_number);
        if (!is_finite(position(positions_.size() - 1)))
            report.add(ObjTrouble::bad_number, line_);
        (void)words.next(); // a weight, or red: a colour has three numbers
        if (!words.next().empty()) report.add(ObjTrouble::vertex_color, line_);
    }
    Vec3T<T> position(std::size_t number) const {
        return Vec3T<T>(settings_.scale * positions_[number]);
    }
    void normal(Words words) {
        const glm::dvec3 n = three_numbers(words);
        const double length = glm::length(n);
        const bool good = length > 0 && std::isfinite(length);
        if (!good) report.add(ObjTrouble::bad_normal, line_);
        normals_.emplace_back(good ? n / length : glm::dvec3(0));
    }
    void texture(Words words) {
        const double u = number_of(words.next());
        const std::string_view second = words.next(); // of a picture of one row: none
        uv_.emplace_back(T(u), second.empty() ? T(0) : T(number_of(second)));
        if (!has_place(uv_.back())) report.add(ObjTrouble::bad_uv, line_);
    }
    static bool has_place(const Vec2T<T>& uv) {
        return std::isfinite(uv.x) && std::isfinite(uv.y);
    }
    void use(const std::string& name) {
        const auto number = static_cast<std::uint32_t>(names_.size() + 1); // 0: none
        Name& known = names_.try_emplace(name, Name{number, {0, line_}}).first->second;
        ++known.at.count;
        material_ = known.number;
    }
    void smoothing(std::string_view group) {
        in_smooth_group_ = !group.empty() && group != "off" && group != "0";
    }
    // Reads a corner of a face, "1/2/3", "1//3" or "-1"; notes what does not exist.
    ObjCorner corner_of(std::string_view word, std::array<bool, 3>& missing) const {
        const std::array counts{positions_.size(), uv_.size(), normals_.size()};
        ObjCorner corner{no_number, no_number, no_number, material_};
        for (std::size_t k = 0; k < 3 && !word.empty(); ++k) {
            const std::size_t end = std::min(word.find('/'), word.size());
            const char* const last = word.data() + end;
            long long number = 0;
            const auto [stop, error] = std::from_chars(word.data(), last, number);
            if (end > 0 && (stop != last || error != std::errc{})) break;
            corner[k] = place_of(number, counts[k]);
            missing[k] = missing[k] || (end > 0 && corner[k] == no_number);
            word.remove_prefix(std::min(end + 1, word.size()));
        }
        // A word that is written otherwise means no position.
        if (!word.empty() || corner[of_position] == no_number)
            missing[of_position] = true;
        return corner;
    }
    void face(Words words) {
        face_.clear();
        std::array<bool, 3> missing{};
        for (auto word = words.next(); !word.empty(); word = words.next()) {
            if (face_.size() == 1000)
                return report.add(ObjTrouble::many_corners, line_);
            face_.push_back(corner_of(word, missing));
        }
        if (face_.size() < 3) return report.add(ObjTrouble::few_corners, line_);
        if (missing[of_position]) return report.add(ObjTrouble::bad_index, line_);
        if (missing[of_uv]) report.add(ObjTrouble::no_such_uv, line_);
        if (missing[of_normal]) report.add(ObjTrouble::no_such_normal, line_);
        face_positions_.clear();
        for (const ObjCorner& corner : face_) {
            if (!is_finite(position(corner[of_position]))) return; // said at the vertex
            face_positions_.push_back(positions_[corner[of_position]]);
        }
        keep_what_all_have();
        const CutPolygon cut = cut_polygon(face_positions_);
        const std::size_t before = lines_.size();
        bool empty = cut.triangles.empty();
        for (const auto& [a, b, c] : cut.triangles)
            empty = !add({face_[a], face_[b], face_[c]}) || empty;
        if (lines_.size() > before) count_face();
        if (empty) report.add(ObjTrouble::no_area, line_);
        if (cut.crossed) report.add(ObjTrouble::crossed, line_);
    }
    // Normals and texture coordinates that are not good at every corner of a face are
    // used at none.
    void keep_what_all_have() {
        bool all_normals = settings_.normals == ObjNormals::file;
        bool all_uv = true;
        for (const auto& [at, uv, normal, material] : face_) {
            all_normals =
                all_normals && normal != no_number && normals_[normal] != Vec3T<T>{0};
            all_uv = all_uv && uv != no_number && has_place(uv_[uv]);
        }
        for (ObjCorner& corner : face_) {
            if (!all_normals) corner[of_normal] = no_number;
            if (!all_uv) corner[of_uv] = no_number;
        }
    }
    void count_face() {
        ObjContent& all = report.content;
        const bool flat = face_[0][of_normal] == no_number;
        ++all.faces;
        all.polygons += face_.size() > 3 ? 1 : 0;
        all.flat_faces += flat ? 1 : 0;
        if (in_smooth_group_ && flat && settings_.normals == ObjNormals::file)
            report.add(ObjTrouble::not_smooth, line_);
        all.no_uv_faces += face_[0][of_uv] == no_number ? 1 : 0;
    }
    // One triangle of a face; false if it has no area.
    bool add(std::array<ObjCorner, 3> corners) {
        const auto across = cross_of_edges(TriangleT<T>{
            position(corners[0][of_position]), position(corners[1][of_position]),
            position(corners[2][of_position])});
        if (!(glm::dot(across, across) > 0)) return false;
        if (corners[0][of_normal] != no_number) {
            Vec3T<T> sum{0};
            for (const ObjCorner& corner : corners) sum += normals_[corner[of_normal]];
            if (!(glm::dot(Vec3T<WideT<T>>(sum), across) > 0)) {
                report.add(ObjTrouble::turned, line_);
                for (ObjCorner& corner : corners) corner[of_normal] = no_number;
            }
        }
        whole_.triangles.push_back(
            {vertex_of(corners[0]), vertex_of(corners[1]), vertex_of(corners[2])});
        lines_.push_back(static_cast<std::uint32_t>(line_));
        return true;
    }
    // The vertex of a corner: one for equal corners, if it is among the latest at their
    // position.
    std::uint32_t vertex_of(const ObjCorner& corner) {
        std::uint32_t& latest = latest_[corner[of_position]];
        std::uint32_t vertex = latest;
        for (int i = 0; i < 64 && vertex != no_number; ++i) {
            if (corners_[vertex] == corner) return vertex;
            vertex = before_[vertex];
        }
        before_.push_back(latest);
        corners_.push_back(corner);
        latest = static_cast<std::uint32_t>(whole_.positions.size());
        whole_.positions.push_back(position(corner[of_position]));
        return latest;
    }

    const std::string& file_; // its name, beside which its material files are
    const ObjSettings& settings_;
    LineReader text_;
    long long line_ = 0;                  // that is read
    std::vector<glm::dvec3> positions_{}; // in the file's own units
    std::vector<Vec3T<T>> normals_{};     // 0 for a bad one
    std::vector<Vec2T<T>> uv_{};          // NaN for a bad one
    MaterialLibraries libraries_{};
    std::map<std::string, Name> names_{};
    std::uint32_t material_ = 0;          // the name that faces have from here on
    bool in_smooth_group_ = false;        // whether s is neither off nor 0
    MeshDataT<T> whole_{};                // all triangles
    std::vector<std::uint32_t> lines_{};  // of each
    std::vector<ObjCorner> corners_{};    // of its vertices
    std::vector<std::uint32_t> before_{}; // of each the one before at its position
    std::vector<std::uint32_t> latest_{}; // the last one at each position
    std::vector<ObjCorner> face_{};       // that is read
    std::vector<glm::dvec3> face_positions_{};
};

} // namespace detail

/// \}

} // namespace ljus
