#pragma once

/// \file ljus/io/detail/json_objects.hpp
/// \brief The objects of scene files.

#include <map>

#include <nlohmann/json.hpp>

#include "ljus/accel/mesh.hpp"
#include "ljus/geometry/detail/pair_triangles.hpp"
#include "ljus/io/detail/json_field.hpp"
#include "ljus/io/detail/json_materials.hpp"
#include "ljus/lights/environment.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/scene/scene.hpp"

namespace ljus {

/// \defgroup json_objects Objects in scene files
/// \brief Optional (nlohmann-json): spheres, triangles and meshes.
///
/// | `type` of an object | its fields, besides material, name and emission         |
/// |---------------------|---------------------------------------------------------|
/// | sphere              | center, radius                                          |
/// | triangles           | vertices, indices: three numbers per triangle, from 0   |
/// | mesh                | file: OBJ, PLY, STL or glTF, relative to the scene      |
/// |                     | file; scale (1); normals (file, smooth or flat); see    |
/// |                     | MeshFiles                                               |
///
/// Emission is radiance: outwards for a sphere, towards
/// \f$(V_2 - V_1) \times (V_3 - V_1)\f$ for a triangle.
/// \{

namespace detail {

/// The scene type of scene files.
template <std::floating_point T>
using FileSceneT =
    Scene<Shapes<QuadT<T>, SphereT<T>, TriangleT<T>, MeshT<T>>, FileMaterialsT<T>,
          Lights<PointLightT<T>, SpotLightT<T>, SunLightT<T>, EnvironmentLightT<T>>>;

/// Reads no meshes: the default of load_json().
template <std::floating_point T>
struct NoMeshesT {
    /// \throws std::runtime_error  always.
    [[noreturn]] std::vector<MeshT<T>> operator()(const std::string& file, double,
                                                  const std::string&) const {
        throw std::runtime_error(
            shown_path(file) +
            ": load_json() reads no meshes unless it is given MeshFiles, from "
            "ljus/io/load_mesh.hpp.");
    }
};

// The three indices of a triangle.
inline std::array<std::uint32_t, 3>
read_triangle(const JsonField& field, const std::vector<glm::dvec3>& points) {
    if (list_size(field) != 3) refuse_value(field, "a list of three numbers");
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
        const JsonField index = entry(field, k);
        if (points.empty()) refuse(index, "names a vertex, but there are none");
        corners[k] = static_cast<std::uint32_t>(
            whole_number(index, 0, static_cast<long long>(points.size()) - 1));
    }
    const glm::dvec3& a = points[corners[0]];
    const glm::dvec3 normal =
        glm::cross(points[corners[1]] - a, points[corners[2]] - a);
    if (!(glm::dot(normal, normal) > 0)) refuse(field, "is a triangle without an area");
    return corners;
}

// The triangles of an object; two that form a parallelogram become a quad.
template <std::floating_point T>
FlatShapesT<T> read_triangles(const JsonField& field) {
    const JsonField vertices = member(field, "vertices");
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < list_size(vertices); ++i)
        points.push_back(point_field(entry(vertices, i)));

    const JsonField indices = member(field, "indices");
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < list_size(indices); ++i)
        triangles.push_back(read_triangle(entry(indices, i), points));
    return pair_triangles<T>(points, triangles);
}

/// The largest number of scales and normals with which a scene reads one mesh file, and
/// the largest number of triangles that it has by naming a file again as it is.
inline constexpr std::size_t max_mesh_readings = 16, max_copied_triangles = 1 << 22;

// The mesh files of a scene so far. What is named again is copied from the scene.
struct FileMeshes {
    struct Reading {
        double scale;
        std::string normals;
        std::size_t first, last; // of the meshes in the scene
    };
    std::map<std::string, std::vector<Reading>> by_path{};
    std::size_t copied = 0; // triangles
};

// Adds the meshes of a file as `add` does it.
template <std::floating_point T, typename LoadMeshes, typename Add>
void read_meshes(const JsonField& field, const FileSceneT<T>& scene, FileMeshes& known,
                 LoadMeshes& load_meshes, Add add) {
    const JsonField file = member(field, "file");
    const std::string path = path_beside(file);
    const auto scale = find(field, "scale");
    const auto normals = find(field, "normals");
    if (normals) require_one_of(*normals, {"file", "smooth", "flat"});
    const double factor = scale ? number(*scale, 1e-9, 1e9, "within [1e-9, 1e9]") : 1.0;
    const std::string which = normals ? text(*normals) : "file";

    const auto& all = std::get<std::vector<MeshT<T>>>(scene.shapes);
    auto& readings = known.by_path[one_path(path)];
    for (const FileMeshes::Reading& reading : readings) {
        if (reading.scale != factor || reading.normals != which) continue;
        for (std::size_t i = reading.first; i < reading.last; ++i) {
            known.copied += all[i].size();
            if (known.copied > max_copied_triangles)
                refuse(file, "is named once more; meshes that are named again have at "
                             "most 4194304 triangles together");
            add(MeshT<T>(all[i]));
        }
        return;
    }
    if (readings.size() == max_mesh_readings)
        refuse(file, "is named with more than 16 scales and normals");
    const std::size_t first = all.size();
    for (MeshT<T>& mesh : load_meshes(path, factor, which)) add(std::move(mesh));
    readings.push_back({factor, which, first, all.size()});
}

template <std::floating_point T>
SphereT<T> read_sphere(const JsonField& field) {
    const JsonField radius = member(field, "radius");
    const double length = number(radius, -max_length, max_length, "at most 1e9");
    if (!(static_cast<T>(length) > T(0))) refuse_value(radius, "above 0");
    return {.center{point_field(member(field, "center"))},
            .radius = static_cast<T>(length)};
}

inline MaterialId material_of(const JsonField& field,
                              const std::map<std::string, MaterialId>& materials) {
    const JsonField material = member(field, "material");
    const auto known = materials.find(text(material));
    if (known != materials.end()) return known->second;
    std::vector<std::string> names;
    for (const auto& [name, id] : materials) names.push_back(name);
    refuse_value(material,
                 std::string("one of the materials ") + in_a_row(names, "or"));
}

// Requires the fields of an object of this type.
inline void require_fields_of_object(const JsonField& field, const std::string& type) {
    static constexpr std::string_view all[]{"type", "name", "material", "emission"};
    static constexpr std::string_view sphere[]{"center", "radius"};
    static constexpr std::string_view mesh[]{"file", "scale", "normals"};
    static constexpr std::string_view triangles[]{"vertices", "indices"};
    require_object(field, all,
                   type == "sphere" ? JsonNames(sphere)
                   : type == "mesh" ? JsonNames(mesh)
                                    : JsonNames(triangles));
}

template <std::floating_point T, typename LoadMeshes>
void read_object(const JsonField& field,
                 const std::map<std::string, MaterialId>& materials,
                 FileSceneT<T>& scene, FileMeshes& meshes, LoadMeshes& load_meshes) {
    const JsonField type = member(field, "type");
    require_one_of(type, {"sphere", "triangles", "mesh"});
    require_fields_of_object(field, text(type));
    (void)remark(field, "name");
    const MaterialId material = material_of(field, materials);
    const auto emission = find(field, "emission");
    const RgbT<T> radiance{emission ? light_field(*emission) : glm::dvec3(0)};

    const auto add = [&](auto shape) {
        made_of(field, [&] { scene.add(std::move(shape), material, radiance); });
    };
    if (text(type) == "sphere") {
        add(read_sphere<T>(field));
    } else if (text(type) == "mesh") {
        read_meshes(field, scene, meshes, load_meshes, add);
    } else {
        const FlatShapesT<T> shapes = read_triangles<T>(field);
        for (const QuadT<T>& quad : shapes.quads) add(quad);
        for (const TriangleT<T>& triangle : shapes.triangles) add(triangle);
    }
}

} // namespace detail

/// \}

} // namespace ljus
