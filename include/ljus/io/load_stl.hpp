#pragma once

/// \file ljus/io/load_stl.hpp
/// \brief Reads meshes from STL files.

#include <utility>

#include "ljus/geometry/detail/equal_points.hpp"
#include "ljus/io/detail/mesh_builder.hpp"
#include "ljus/io/detail/parse.hpp"

namespace ljus {

/// \addtogroup load_obj
/// \{

namespace detail {

// The size of a binary file's header, and of one triangle, in bytes.
inline constexpr std::size_t stl_head = 84, stl_triangle = 50;

// Reads the faces of an STL file.
template <std::floating_point T>
struct StlReader {
    std::string_view text;   // the whole file
    const std::string& file; // its path
    MeshBuilder<T>& mesh;
    MeshReport& report = mesh.report;
    std::vector<glm::dvec3> face{}; // corners read so far
    EqualPoints<double> numbers{};  // indices of positions

    // Whether the file is a text. Some binary files begin with "solid" as well, but
    // some byte of their header is 0: at least one byte of the number of triangles.
    [[nodiscard]] bool is_text() const {
        const std::string_view plain = plain_text(text, file);
        const std::size_t begin = plain.find_first_not_of(" \t\r\n");
        return begin != plain.npos && same_word(plain.substr(begin, 5), "solid") &&
               text.substr(0, stl_head).find('\0') == text.npos;
    }
    // The unsigned number in `bytes` bytes of a binary file.
    [[nodiscard]] std::size_t word(std::size_t at, std::size_t bytes) const {
        return unsigned_value(text.substr(at, bytes));
    }
    // Adds a corner. All points that are not finite become equal, for EqualPoints.
    void add(const glm::dvec3& point) {
        constexpr double none = std::numeric_limits<double>::infinity();
        face.push_back(is_finite(point) ? point : glm::dvec3(none));
    }
    // Ends a face. The order of its corners decides which side is the front.
    void end_face(const glm::dvec3& normal, std::size_t place) {
        mesh.place = static_cast<long long>(place);
        if (face.size() >= 3 &&
            glm::dot(glm::cross(face[1] - face[0], face[2] - face[0]), normal) < 0)
            report.add(MeshTrouble::turned, mesh.place);
        for (const glm::dvec3& corner : face) {
            const auto next = static_cast<std::uint32_t>(mesh.positions().size());
            const auto number = numbers.find_or_add(mesh.positions(), corner, next);
            if (number == next) mesh.add_position(corner);
            mesh.add_corner(number, no_number, no_number);
        }
        mesh.end_face();
        face.clear();
    }
    // A point or a normal of a binary file.
    [[nodiscard]] glm::dvec3 three_floats(std::size_t at) const {
        const auto number = [&](std::size_t i) {
            return binary_number(text.substr(at + 4 * i, 4), 'f');
        };
        return {number(0), number(1), number(2)};
    }
    void read_binary() {
        if (text.size() < stl_head)
            refuse_file(file,
                        "it is neither a text that begins with 'solid' nor a binary "
                        "STL file, whose head has 84 bytes");
        const std::size_t count = word(80, 4);
        const std::size_t room = (text.size() - stl_head) / stl_triangle;
        if (count > room)
            refuse_file(file, join({"its head says that it has ", std::to_string(count),
                                    " triangles, but there are bytes for ",
                                    std::to_string(room), " only"}));
        report.unit = "triangle";
        if (const std::size_t more = text.size() - stl_head - stl_triangle * count;
            more > 0)
            report.notes.push_back(
                join({"the file goes on for ", std::to_string(more),
                      " bytes behind the ", std::to_string(count),
                      " triangles that its head names; they are not used."}));
        bool colors = false;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t at = stl_head + stl_triangle * i;
            for (std::size_t k = 1; k < 4; ++k) add(three_floats(at + 12 * k));
            end_face(three_floats(at), i + 1);
            colors = colors || word(at + 48, 2) != 0;
        }
        if (colors)
            report.notes.push_back(
                "the triangles have attributes, perhaps colours; they are not used.");
    }
    void read_text() {
        bool open = false; // whether a solid has not ended
        glm::dvec3 normal(0);
        LineReader{file}.read(text, true, [&](std::string_view line, long long number) {
            Words words{line};
            const std::string_view keyword = words.next();
            if (same_word(keyword, "vertex")) {
                add(three_numbers(words));
            } else if (same_word(keyword, "endloop")) {
                end_face(normal, static_cast<std::size_t>(number));
            } else if (same_word(keyword, "facet")) {
                (void)words.next(); // "normal"
                normal = three_numbers(words);
            } else if (same_word(keyword, "solid")) {
                ++report.content.objects;
                open = true;
            } else if (same_word(keyword, "endsolid")) {
                open = false;
            }
        });
        if (!face.empty())
            refuse_file(file, "the file ends within a triangle, before its 'endloop'");
        if (open)
            report.notes.push_back(
                "the file ends before 'endsolid': perhaps it is cut off.");
    }
};

} // namespace detail

/// Reads a mesh from the bytes of an STL file, text or binary. Corners at the same
/// position become one vertex. The normals of the file are not used. The report counts
/// the normals that disagree with the order of the corners.
/// \return One mesh without a material, and a report of the problems of the file.
/// \throws std::runtime_error  with one sentence: "gear.stl: its head says that it has
///         9000 triangles, but there are bytes for 12 only."; or as read_obj().
/// \throws std::invalid_argument  unless the scale is finite and above 0.
/// \cost Time and memory linear in the size of the file.
template <std::floating_point T = float>
[[nodiscard]] LoadedMeshT<T> read_stl(Bytes bytes, const std::string& file,
                                      const MeshFileSettings& settings = {}) {
    const auto read = [&](LoadedMeshT<T>& loaded) {
        detail::MeshBuilder<T> mesh(settings);
        {
            const Bytes own = std::move(bytes); // freed before the meshes are made
            detail::StlReader<T> reader{
                {reinterpret_cast<const char*>(own.data()), own.size()}, file, mesh};
            reader.is_text() ? reader.read_text() : reader.read_binary();
        }
        auto parts = mesh.take_faces({nullptr});
        loaded.report = std::move(mesh.report);
        return parts;
    };
    return detail::make_meshes<T>(
        file, settings,
        "; a text has lines 'vertex 0 0 1' between 'outer loop' and 'endloop'.", read,
        detail::no_pictures);
}

/// Loads an STL file; see read_stl().
/// \throws std::runtime_error  as read_stl(), or if the file cannot be read.
template <std::floating_point T = float>
[[nodiscard]] LoadedMeshT<T> load_stl(const std::string& path,
                                      const MeshFileSettings& settings = {}) {
    return read_stl<T>(load_file(path, detail::max_mesh_file), path, settings);
}

/// \}

} // namespace ljus
