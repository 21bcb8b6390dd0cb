#pragma once

/// \file ljus/io/detail/mesh_builder.hpp
/// \brief Makes meshes from the faces of a mesh file, any of which may be wrong.

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

#include <glm/common.hpp>

#include "ljus/accel/mesh_data.hpp"
#include "ljus/geometry/detail/polygon.hpp"
#include "ljus/image/image.hpp"
#include "ljus/io/detail/picture_size.hpp"
#include "ljus/io/file.hpp"
#include "ljus/io/mesh_file.hpp"

namespace ljus::detail {

// The number of pixels that hold the colours of one triangle: two by two.
inline constexpr std::size_t painted_pixels = 4;

// Paints each triangle into a square of four pixels, and makes the texture coordinates
// of its corners the centres of three of them. The three pixels hold the colours c0, c1
// and c2 of the corners, and the fourth holds c1 + c2 - c0. The bilinear interpolation
// between pixel centres then is the linear interpolation between the corners. As c0,
// that corner is chosen for which the fourth pixel needs the least clamping to [0, 1].
template <std::floating_point T>
ImageT<T> paint_vertices(MeshDataT<T>& data, const std::vector<RgbT<T>>& colors) {
    const std::size_t count = data.triangles.size();
    const auto columns =
        static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    const std::size_t rows = (count + columns - 1) / columns;
    const std::size_t width = 2 * columns, height = 2 * rows;
    ImageT<T> image = make_image<T>(static_cast<int>(width), static_cast<int>(height));
    MeshDataT<T> painted;
    for (std::size_t i = 0; i < count; ++i) {
        std::array<std::uint32_t, 3> corner = data.triangles[i];
        const auto fourth = [&] {
            return colors[corner[1]] + colors[corner[2]] - colors[corner[0]];
        };
        const auto clamped = [&] {
            return glm::clamp(fourth(), RgbT<T>{0}, RgbT<T>{1});
        };
        std::array<std::uint32_t, 3> best = corner;
        T least = std::numeric_limits<T>::infinity();
        for (int turn = 0; turn < 3; ++turn) {
            const T off = glm::distance(fourth(), clamped());
            if (off < least) best = corner;
            least = std::min(least, off);
            std::rotate(corner.begin(), corner.begin() + 1, corner.end());
        }
        corner = best;
        const std::size_t left = 2 * (i % columns), top = 2 * (i / columns);
        const auto vertex = static_cast<std::uint32_t>(painted.positions.size());
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t x = left + k % 2, y = top + k / 2;
            pixel(image, static_cast<int>(x), static_cast<int>(y)) =
                k < 3 ? colors[corner[k]] : clamped();
            if (k == 3) continue;
            painted.positions.push_back(data.positions[corner[k]]);
            if (!data.normals.empty())
                painted.normals.push_back(data.normals[corner[k]]);
            painted.uv.emplace_back(T((double(x) + 0.5) / double(width)),
                                    T(1 - (double(y) + 0.5) / double(height)));
        }
        painted.triangles.push_back({vertex, vertex + 1, vertex + 2});
    }
    data = std::move(painted);
    return image;
}

/// The largest mesh file, in bytes.
inline constexpr std::size_t max_mesh_file = std::size_t(1) << 30;

// A corner of a face: indices into the lists of positions, texture coordinates, normals
// and materials of the file, each from 0, or no_number.
using MeshCorner = std::array<std::uint32_t, 4>;
inline constexpr std::size_t of_position = 0, of_uv = 1, of_normal = 2, of_material = 3;
inline constexpr auto no_number = std::numeric_limits<std::uint32_t>::max();

// All faces of one material.
template <std::floating_point T>
struct MeshFacesT {
    MeshMaterial material{};
    MeshDataT<T> data{};
    std::vector<std::uint32_t> positions{}; // indices of its vertices' positions
    std::vector<RgbT<T>> colors{};          // of its vertices; may be empty
    bool has_normals = false, has_uv = false;
    std::uint32_t without_uv = 0; // line of the last face without uv

    // Computes smooth normals. Vertices at the same position count as one, so that a
    // seam of the texture coordinates makes no edge.
    void smooth() {
        MeshDataT<T> seamless{.positions = data.positions};
        std::unordered_map<std::uint32_t, std::uint32_t> first; // by position
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

// Takes the vertices and faces of a file one by one, in the units of the file.
template <std::floating_point T>
class MeshBuilder {
public:
    explicit MeshBuilder(const MeshFileSettings& settings) : settings_(settings) {}

    MeshReport report{};
    long long place = 0;          // line or element that is read, for messages
    std::uint32_t material = 0;   // of the next faces; 0: none
    bool in_smooth_group = false; // the next faces are meant to be smooth

    [[nodiscard]] std::array<std::size_t, 3> counts() const {
        return {positions_.size(), uv_.size(), normals_.size()};
    }
    [[nodiscard]] const std::vector<glm::dvec3>& positions() const {
        return positions_;
    }

    void add_position(const glm::dvec3& at) {
        positions_.push_back(at);
        latest_.push_back(no_number);
        if (!is_finite(position(positions_.size() - 1)))
            report.add(MeshTrouble::bad_number, place);
    }
    // Adds the linear colour of the last position, unless a channel is outside [0, 1].
    void add_color(const glm::dvec3& color) {
        colors_.resize(positions_.size(), no_color);
        if (colored_.count++ == 0) colored_.line = place;
        for (int i = 0; i < 3; ++i)
            if (!(color[i] >= 0 && color[i] <= 1)) return;
        colors_.back() = RgbT<float>(color);
    }
    void add_normal(const glm::dvec3& n) {
        const double length = glm::length(n);
        const bool good = length > 0 && std::isfinite(length);
        if (!good) report.add(MeshTrouble::bad_normal, place);
        normals_.emplace_back(good ? n / length : glm::dvec3(0));
    }
    void add_uv(double u, double v) {
        uv_.emplace_back(T(u), T(v));
        if (!has_place(uv_.back())) report.add(MeshTrouble::bad_uv, place);
    }
    // Adds the next corner of a face: indices into the lists of positions, texture
    // coordinates and normals, or no_number. An index beyond the end of its list counts
    // as missing.
    void add_corner(std::uint32_t at, std::uint32_t uv, std::uint32_t normal) {
        const std::array<std::uint32_t, 3> corner{at, uv, normal};
        const auto all = counts();
        MeshCorner has{no_number, no_number, no_number, material};
        for (std::size_t k = 0; k < 3; ++k)
            if (corner[k] < all[k])
                has[k] = corner[k];
            else if (corner[k] != no_number || k == of_position)
                missing_[k] = true;
        if (face_.size() <= 1000) face_.push_back(has);
    }
    // Notes that a corner of the face names an element that does not exist.
    void miss(std::size_t k) { missing_[k] = true; }

    // Ends a face: adds the triangles between its corners.
    void end_face() {
        face();
        face_.clear();
        missing_ = {};
    }

    // Returns the faces by material, in the order in which materials are first used.
    // Completes the report and frees all lists. `known` lists the materials by number;
    // nullptr means no material.
    std::vector<MeshFacesT<T>>
    take_faces(const std::vector<const MeshMaterial*>& known) {
        report.content.vertices = static_cast<long long>(positions_.size());
        report.content.normals = static_cast<long long>(normals_.size());
        report.content.uvs = static_cast<long long>(uv_.size());
        report.content.unused = std::count(latest_.begin(), latest_.end(), no_number);
        std::vector<glm::dvec3>().swap(positions_);
        std::vector<std::uint32_t>().swap(latest_);
        std::vector<std::uint32_t>().swap(before_);
        const MeshDataT<T> whole = std::move(whole_);
        const auto lines = std::move(lines_);
        const auto corners = std::move(corners_);
        const auto normals = std::move(normals_);
        const auto uvs = std::move(uv_);
        count_edges(whole, lines, report);

        std::vector<MeshFacesT<T>> parts;
        std::unordered_map<const MeshMaterial*, std::size_t> numbers; // of parts
        const auto part_of = [&](const MeshCorner& corner) -> MeshFacesT<T>& {
            const MeshMaterial* const is = known[corner[of_material]];
            const auto [at, fresh] = numbers.try_emplace(is, parts.size());
            if (fresh) parts.push_back({is ? *is : MeshMaterial{}});
            return parts[at->second];
        };
        colors_.resize(colored_.count > 0 ? std::size_t(report.content.vertices) : 0,
                       no_color);
        std::vector<std::uint32_t> vertices; // number of each within its part
        vertices.reserve(corners.size());
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto [position, uv, normal, number] = corners[i];
            MeshFacesT<T>& part = part_of(corners[i]);
            vertices.push_back(static_cast<std::uint32_t>(part.positions.size()));
            part.positions.push_back(position);
            part.data.positions.push_back(whole.positions[i]);
            if (!normals.empty())
                part.data.normals.push_back(normal != no_number ? normals[normal]
                                                                : Vec3T<T>{0});
            if (!uvs.empty())
                part.data.uv.push_back(uv != no_number ? uvs[uv] : Vec2T<T>{0});
            part.has_normals = part.has_normals || normal != no_number;
            part.has_uv = part.has_uv || uv != no_number;
            if (!colors_.empty()) part.colors.emplace_back(colors_[position]);
        }
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const auto [a, b, c] = whole.triangles[i];
            MeshFacesT<T>& part = part_of(corners[a]);
            part.data.triangles.push_back({vertices[a], vertices[b], vertices[c]});
            if (part.has_uv && corners[a][of_uv] == no_number &&
                part.without_uv != lines[i])
                report.add(MeshTrouble::no_uv, part.without_uv = lines[i]);
        }
        bool all_colors = settings_.pictures && !colors_.empty();
        for (MeshFacesT<T>& part : parts) {
            if (!part.has_normals) part.data.normals = std::vector<Vec3T<T>>();
            if (settings_.normals == MeshNormals::smooth) part.smooth();
            if (!part.has_uv) part.data.uv = std::vector<Vec2T<T>>();
            const MeshMaterial& is = part.material;
            const bool pictured = !is.picture.name.empty() || !is.mask.name.empty() ||
                                  !is.normals.name.empty();
            if (settings_.pictures && pictured && !part.has_uv)
                report.notes.push_back(
                    join({"the pictures of material ", shown(is.name),
                          " lie on each triangle alike: its faces have no texture "
                          "coordinates."}));
            const bool smooth_mirror = is.is_mirror() && is.roughness == 0;
            if (!settings_.pictures || !is.picture.name.empty() || is.is_glass() ||
                smooth_mirror ||
                std::count(part.colors.begin(), part.colors.end(), RgbT<T>(no_color)) >
                    0)
                part.colors.clear();
            all_colors = all_colors && !part.colors.empty();
        }
        if (!all_colors && colored_.count > 0)
            report.add(MeshTrouble::vertex_color, colored_.line, colored_.count);
        return parts;
    }

private:
    // The colour of a position that has none.
    static constexpr RgbT<float> no_color{-1};

    Vec3T<T> position(std::size_t number) const {
        return Vec3T<T>(settings_.scale * positions_[number]);
    }
    static bool has_place(const Vec2T<T>& uv) {
        return std::isfinite(uv.x) && std::isfinite(uv.y);
    }
    void face() {
        if (face_.size() > 1000) return report.add(MeshTrouble::many_corners, place);
        if (face_.size() < 3) return report.add(MeshTrouble::few_corners, place);
        if (missing_[of_position]) return report.add(MeshTrouble::bad_index, place);
        if (missing_[of_uv]) report.add(MeshTrouble::no_such_uv, place);
        if (missing_[of_normal]) report.add(MeshTrouble::no_such_normal, place);
        face_positions_.clear();
        for (const MeshCorner& corner : face_) {
            if (!is_finite(position(corner[of_position]))) return; // already reported
            face_positions_.push_back(positions_[corner[of_position]]);
        }
        keep_what_all_have();
        const CutPolygon cut = cut_polygon(face_positions_);
        const std::size_t before = lines_.size();
        for (const auto& [a, b, c] : cut.triangles) add({face_[a], face_[b], face_[c]});
        if (lines_.size() > before)
            count_face();
        else
            report.add(MeshTrouble::no_area, place);
        if (cut.crossed) report.add(MeshTrouble::crossed, place);
    }
    // If a corner of a face lacks a valid normal or valid texture coordinates, these
    // are removed from all its corners.
    void keep_what_all_have() {
        bool all_normals = settings_.normals == MeshNormals::file;
        bool all_uv = true;
        for (const auto& [at, uv, normal, number] : face_) {
            all_normals =
                all_normals && normal != no_number && normals_[normal] != Vec3T<T>{0};
            all_uv = all_uv && uv != no_number && has_place(uv_[uv]);
        }
        for (MeshCorner& corner : face_) {
            if (!all_normals) corner[of_normal] = no_number;
            if (!all_uv) corner[of_uv] = no_number;
        }
    }
    void count_face() {
        MeshContent& all = report.content;
        const bool flat = face_[0][of_normal] == no_number;
        ++all.faces;
        all.polygons += face_.size() > 3 ? 1 : 0;
        all.flat_faces += flat ? 1 : 0;
        if (in_smooth_group && flat && settings_.normals == MeshNormals::file)
            report.add(MeshTrouble::not_smooth, place);
        all.no_uv_faces += face_[0][of_uv] == no_number ? 1 : 0;
    }
    // Adds one triangle of a face, unless it has no area.
    void add(std::array<MeshCorner, 3> corners) {
        const auto across = cross_of_edges(TriangleT<T>{
            position(corners[0][of_position]), position(corners[1][of_position]),
            position(corners[2][of_position])});
        if (!(glm::dot(across, across) > 0)) return;
        if (corners[0][of_normal] != no_number) {
            Vec3T<T> sum{0};
            for (const MeshCorner& corner : corners) sum += normals_[corner[of_normal]];
            if (!(glm::dot(Vec3T<WideT<T>>(sum), across) > 0)) {
                report.add(MeshTrouble::turned, place);
                for (MeshCorner& corner : corners) corner[of_normal] = no_number;
            }
        }
        whole_.triangles.push_back(
            {vertex_of(corners[0]), vertex_of(corners[1]), vertex_of(corners[2])});
        lines_.push_back(static_cast<std::uint32_t>(place));
    }
    // Equal corners share a vertex if it is one of the last 64 at their position.
    std::uint32_t vertex_of(const MeshCorner& corner) {
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

    const MeshFileSettings& settings_;
    std::vector<glm::dvec3> positions_{};
    std::vector<RgbT<float>> colors_{};   // of the positions, or empty
    MeshCount colored_{};                 // positions with a colour
    std::vector<Vec3T<T>> normals_{};     // 0 for a bad one
    std::vector<Vec2T<T>> uv_{};          // NaN for a bad one
    MeshDataT<T> whole_{};                // all triangles
    std::vector<std::uint32_t> lines_{};  // line of each triangle
    std::vector<MeshCorner> corners_{};   // of its vertices
    std::vector<std::uint32_t> before_{}; // for each vertex, the previous one at its
                                          // position
    std::vector<std::uint32_t> latest_{}; // the last vertex at each position
    std::vector<MeshCorner> face_{};      // corners of the face that is read
    std::array<bool, 3> missing_{};       // which elements of a corner do not exist
    std::vector<glm::dvec3> face_positions_{};
};

[[noreturn]] inline void refuse_without_faces(const std::string& file,
                                              const MeshReport& report,
                                              std::string_view hint) {
    const std::string troubles = to_text(report);
    throw std::runtime_error(
        join({shown_path(file), ": no face of the file can be used",
              troubles.empty() ? hint : "; the first problem: ",
              std::string_view(troubles).substr(0, troubles.find('\n'))}));
}

// Makes a picture of the vertex colours of a part. If all vertices have one colour, the
// material gets that colour instead.
template <std::floating_point T>
void paint(MeshFacesT<T>& part, LoadedMeshT<T>& loaded, long long& pixels) {
    const RgbT<T> first = part.colors.front();
    if (std::count(part.colors.begin(), part.colors.end(), first) ==
        std::ptrdiff_t(part.colors.size())) {
        part.material.diffuse *= glm::dvec3(first);
        part.material.specular *= glm::dvec3(first);
        return;
    }
    const auto size =
        static_cast<long long>(part.data.triangles.size() * painted_pixels);
    if (const std::string why = too_large_beside(pixels, 1, size); !why.empty()) {
        loaded.report.notes.push_back(join(
            {"the picture of the colours of vertices ", why, "; they are not used."}));
        return;
    }
    part.material.picture.name =
        "colours of vertices, part " + std::to_string(loaded.parts.size() + 1);
    ImageT<T>& image = loaded.pictures[part.material.picture.name];
    image = paint_vertices(part.data, part.colors);
    pixels += static_cast<long long>(image.pixels.size());
}

// A picture with half the width and height of another one.
template <std::floating_point T>
ImageT<T> halved(const ImageT<T>& image) {
    ImageT<T> half = make_image<T>((image.width + 1) / 2, (image.height + 1) / 2);
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x) {
            const int right = std::min(2 * x + 1, image.width - 1);
            const int below = std::min(2 * y + 1, image.height - 1);
            pixel(half, x, y) =
                (pixel(image, 2 * x, 2 * y) + pixel(image, right, 2 * y) +
                 pixel(image, 2 * x, below) + pixel(image, right, below)) /
                T(4);
        }
    return half;
}

// Halves the width and height of all pictures until their copies have at most `most`
// pixels together. add_meshes() makes a copy for each material that uses a picture.
// Returns the number of pixels of all copies.
template <std::floating_point T>
long long fit_copies(const std::vector<MeshFacesT<T>>& parts, LoadedMeshT<T>& loaded,
                     long long most = max_image_pixels) {
    const auto copied = [&] {
        std::size_t sum = 0;
        for (const MeshFacesT<T>& part : parts)
            for (const auto image :
                 {&MeshMaterial::picture, &MeshMaterial::mask, &MeshMaterial::normals})
                if (const auto* found = find_picture(loaded, part.material.*image))
                    sum += found->pixels.size();
        return static_cast<long long>(sum);
    };
    long long pixels = copied();
    int part = 1;
    for (; pixels > most; pixels = copied(), part *= 2)
        for (auto& [name, image] : loaded.pictures) image = halved(image);
    if (part > 1)
        loaded.report.notes.push_back(
            join({"all pictures are reduced to 1/", to_text(part),
                  " of their width and height, because each of the ",
                  to_text(static_cast<long long>(parts.size())),
                  " materials has copies of its own; together they may have ",
                  to_text(most), " pixels."}));
    return pixels;
}

// Makes the meshes of a file. read(loaded) makes the faces, completes the report and
// frees its lists, before the meshes are made, which need more memory. `hint` is the
// end of the error sentence for a file without faces. load(material, loaded, pixels)
// loads the pictures of a material.
template <std::floating_point T, typename Read, typename Load>
LoadedMeshT<T> make_meshes(const std::string& file, const MeshFileSettings& settings,
                           std::string_view hint, Read read, Load load) {
    require_positive("the scale of a mesh file", settings.scale);
    LoadedMeshT<T> loaded;
    std::vector<MeshFacesT<T>> parts = read(loaded);
    if (parts.empty()) refuse_without_faces(file, loaded.report, hint);
    long long pixels = 0; // of all pictures, then of their copies
    if (settings.pictures)
        for (MeshFacesT<T>& part : parts) load(part.material, loaded, pixels);
    pixels = fit_copies(parts, loaded);
    for (MeshFacesT<T>& part : parts) {
        if (!part.colors.empty()) paint(part, loaded, pixels);
        try {
            loaded.parts.push_back(
                {MeshT<T>(std::move(part.data)), std::move(part.material)});
        } catch (const std::invalid_argument& wrong) {
            throw std::runtime_error(shown_path(file) + ": " + wrong.what());
        }
    }
    BoxT<T> box;
    for (const MeshPartT<T>& part : loaded.parts)
        box = box_union(box, part.mesh.tree().box());
    const T far = max_component(glm::max(glm::abs(box.low), glm::abs(box.high)));
    const T step = std::nextafter(far, std::numeric_limits<T>::infinity()) - far;
    const T size = max_component(box.high - box.low);
    if (step > size / T(10000))
        loaded.report.notes.push_back(
            join({"the mesh is ", to_text(double(size)),
                  " large, but so far from the origin that coordinates are rounded to "
                  "steps of ",
                  to_text(double(step)), "; move it to the origin before it is saved",
                  sizeof(T) < sizeof(double) ? ", or load it in double." : "."}));
    return loaded;
}

// Loads nothing, for a file format without pictures.
inline constexpr auto no_pictures = [](const auto&...) {};

} // namespace ljus::detail
