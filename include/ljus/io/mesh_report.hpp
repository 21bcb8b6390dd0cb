#pragma once

/// \file ljus/io/mesh_report.hpp
/// \brief A report of the problems of a mesh file that can still be used.

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "ljus/accel/mesh_data.hpp"
#include "ljus/geometry/detail/equal_points.hpp"

namespace ljus {

/// \defgroup mesh_report Problems of mesh files
/// \brief How often each problem occurs, and the first line with it.
/// \{

/// A problem of a mesh file.
enum class MeshTrouble : std::uint8_t {
    bad_number, ///< A coordinate that is not finite; faces with it are left out.
    bad_normal, ///< A normal that is 0 or not finite; faces with it are flat.
    bad_uv,     ///< A texture coordinate that is not finite; faces with it get (0, 0).
    no_uv,      ///< A face without texture coordinates in a mesh that has some.
    bad_index,  ///< A face with a vertex that does not exist; it is left out.
    no_such_uv, ///< A face with a uv that does not exist: it gets (0, 0).
    no_such_normal, ///< A face with a normal that does not exist: it is flat.
    not_smooth,     ///< A face without normals in a smoothing group; it is flat.
    few_corners,    ///< A face with fewer than three corners; it is left out.
    many_corners,   ///< A face with more than 1000 corners; it is left out.
    no_area,        ///< A face with an area of 0; it is left out.
    crossed,        ///< A face that crosses itself: its triangles overlap.
    turned,       ///< A face whose normals point to its back; the normals are ignored.
    edge_of_many, ///< An edge of three or more faces; the mesh has no inside.
    edge_turned,  ///< An edge whose two faces are wound in opposite directions.
    edge_open,    ///< An edge of one face: the mesh is not closed, and unsuitable for
                  ///< glass.
    inside_out,   ///< The mesh is closed, but inside out: its volume is below 0.
    vertex_color, ///< A vertex with its own colour, which is not used.
    no_face,      ///< A line, point, curve or surface; it is left out.
    no_material,  ///< A material that does not exist.
    no_library,   ///< A material file that cannot be read.
};

namespace detail {

inline constexpr std::size_t mesh_troubles = 21;

} // namespace detail

/// The number of occurrences of a problem.
struct MeshCount {
    long long count = 0; ///< Number of occurrences.
    long long line = 0;  ///< Number of the line of the first occurrence, from 1. In a
                         ///< binary file, of the element or triangle in place of the
                         ///< line; see MeshReport::unit.
};

/// The numbers of vertices, faces and other elements of a mesh file.
struct MeshContent {
    long long vertices = 0;    ///< Number of positions: the lines v of an OBJ file.
    long long normals = 0;     ///< Number of normals: the lines vn of an OBJ file.
    long long uvs = 0;         ///< Number of (u, v) pairs: the lines vt of an OBJ file.
    long long objects = 0;     ///< Number of objects: the lines o of an OBJ file.
    long long groups = 0;      ///< Number of groups: the lines g of an OBJ file.
    long long faces = 0;       ///< Number of faces that are used.
    long long polygons = 0;    ///< Number of faces with more than three corners.
    long long flat_faces = 0;  ///< Number of faces without usable normals.
    long long no_uv_faces = 0; ///< Number of faces without usable texture coordinates.
    long long unused = 0;      ///< Number of vertices that no triangle uses.
    bool closed = false; ///< Whether each edge has two faces with the same winding.
    double volume = 0; ///< Signed volume of a closed mesh; below 0 if it is inside out.
};

/// The problems of a mesh file.
struct MeshReport {
    /// What MeshCount::line counts: lines of a text, elements of a PLY file, or
    /// triangles of an STL or glTF file.
    const char* unit = "line";
    /// The counts, indexed by MeshTrouble.
    std::array<MeshCount, detail::mesh_troubles> counts{};
    /// One sentence for each further problem, for example of a material file.
    std::vector<std::string> notes{};
    MeshContent content{}; ///< The numbers of elements in the file.

    /// Adds `count` occurrences of a problem. The first is at `line`.
    void add(MeshTrouble trouble, long long line, long long count = 1) {
        MeshCount& at = counts[static_cast<std::size_t>(trouble)];
        if (at.count == 0 || line < at.line) at.line = line;
        at.count += count;
    }
    /// The occurrences of a problem.
    [[nodiscard]] const MeshCount& operator[](MeshTrouble trouble) const {
        return counts[static_cast<std::size_t>(trouble)];
    }
};

/// A report as text. Each problem has a line that ends with a line feed, such as
/// "line 12: 3 faces have no area; ...".
[[nodiscard]] inline std::string to_text(const MeshReport& report) {
    constexpr std::array<const char*, detail::mesh_troubles> words{
        "vertices have coordinates that are not finite numbers; their faces are left "
        "out",
        "normals are 0 or not finite numbers; their faces are shaded flat",
        "texture coordinates are not finite numbers; (0, 0) is used",
        "faces lack texture coordinates, which others of their mesh have; (0, 0) is "
        "used",
        "faces refer to a vertex that does not exist; they are left out",
        "faces refer to a texture coordinate that does not exist; (0, 0) is used",
        "faces refer to a normal that does not exist; they are shaded flat",
        "faces are in a smoothing group, without normals; they are shaded flat, unless "
        "smooth normals are asked for",
        "faces have fewer than three corners; they are left out",
        "faces have more than 1000 corners; they are left out",
        "faces have no area; they are left out",
        "faces cross themselves; their triangles overlap",
        "faces have normals that point to their back; they are shaded flat",
        "edges belong to three faces or more; they have no inside",
        "edges have faces that are wound in opposite directions; one of them is inside "
        "out",
        "edges belong to one face only; the mesh is not closed, and unsuitable for "
        "glass",
        "closed meshes are inside out; as glass they are bubbles of air",
        "vertices have colours of their own; they are not used",
        "lines, points, curves or surfaces are no faces; they are left out",
        "uses of a material that no material file has; the default is used",
        "material files cannot be read; the default material is used"};
    std::string text;
    for (std::size_t i = 0; i < detail::mesh_troubles; ++i)
        if (report.counts[i].count > 0)
            text +=
                detail::join({report.unit, " ", to_text(report.counts[i].line), ": ",
                              to_text(report.counts[i].count), " ", words[i], ".\n"});
    for (const std::string& note : report.notes) text.append(note).append("\n");
    return text;
}

namespace detail {

// Counts the edges that do not belong to exactly two faces, or whose faces are wound in
// opposite directions. Tests whether a closed mesh is inside out. Vertices at the same
// position count as one. `lines` are the lines of the triangles. Expected O(n).
template <std::floating_point T>
void count_edges(const MeshDataT<T>& data, const std::vector<std::uint32_t>& lines,
                 MeshReport& report) {
    const auto place = first_equal_points(data.positions);
    // An edge from one position to a position with a higher number.
    struct Edge {
        std::uint32_t high, triangle;
        bool forwards; // if its triangle goes from low to high
    };
    const auto each_edge = [&](auto use) { // use(low, edge)
        for (std::uint32_t i = 0; i < data.triangles.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = place[data.triangles[i][k]];
                const std::uint32_t b = place[data.triangles[i][(k + 1) % 3]];
                if (a != b) use(std::min(a, b), Edge{std::max(a, b), i, a < b});
            }
    };
    std::vector<std::uint32_t> end(place.size() + 1, 0); // end of the edges of each
                                                         // position
    each_edge([&](std::uint32_t low, const Edge&) { ++end[low + 1]; });
    for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
    std::vector<Edge> edges(end.back());
    each_edge([&](std::uint32_t low, const Edge& edge) { edges[end[low]++] = edge; });

    bool closed = !edges.empty();
    std::size_t next = 0;
    for (const std::uint32_t stop : end) {
        std::sort(edges.data() + next, edges.data() + stop,
                  [](const Edge& a, const Edge& b) { return a.high < b.high; });
        while (next < stop) {
            const std::size_t first = next;
            std::uint32_t line = lines[edges[first].triangle];
            for (; next < stop && edges[next].high == edges[first].high; ++next)
                line = std::min(line, lines[edges[next].triangle]);
            const std::size_t count = next - first;
            if (count == 2 && edges[first].forwards != edges[first + 1].forwards)
                continue;
            closed = false;
            report.add(count > 2    ? MeshTrouble::edge_of_many
                       : count == 1 ? MeshTrouble::edge_open
                                    : MeshTrouble::edge_turned,
                       line);
        }
    }
    report.content.closed = closed;
    if (!closed) return;
    double volume = 0; // times six, relative to a corner
    const glm::dvec3 from(data.positions[data.triangles[0][0]]);
    for (const auto& [a, b, c] : data.triangles)
        volume += glm::dot(glm::dvec3(data.positions[a]) - from,
                           glm::cross(glm::dvec3(data.positions[b]) - from,
                                      glm::dvec3(data.positions[c]) - from));
    report.content.volume = volume / 6;
    if (volume < 0) report.add(MeshTrouble::inside_out, lines[0]);
}

} // namespace detail

/// \}

} // namespace ljus
