#pragma once

/// \file ljus/io/detail/json_objects.hpp
/// \brief The objects of scene files.

#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "ljus/accel/instances.hpp"
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
/// \brief Optional (nlohmann-json): spheres, triangles, meshes and their instances.
///
/// | `type` of an object | its fields, besides material, name and emission         |
/// |---------------------|---------------------------------------------------------|
/// | sphere              | center, radius                                          |
/// | triangles           | vertices, indices: three numbers per triangle, from 0   |
/// | mesh                | file: OBJ, relative to the scene file; scale (1);       |
/// |                     | normals (file, smooth or flat); see ObjMeshes           |
/// | instances           | those of a mesh, and places: a list of maps, each the   |
/// |                     | twelve numbers of a 3 x 4 matrix, row by row            |
///
/// Emission is radiance: outwards for a sphere, towards
/// \f$(V_2 - V_1) \times (V_3 - V_1)\f$ for a triangle.
/// \{

namespace detail {

/// The scene type of scene files.
template <std::floating_point T>
using FileSceneT =
    Scene<Shapes<QuadT<T>, SphereT<T>, TriangleT<T>, MeshT<T>, InstanceT<T>>,
          FileMaterialsT<T>,
          Lights<PointLightT<T>, SpotLightT<T>, SunLightT<T>, EnvironmentLightT<T>>>;

/// Reads no meshes: the default of load_json().
template <std::floating_point T>
struct NoMeshesT {
    /// \throws std::runtime_error  always.
    [[noreturn]] std::vector<MeshT<T>> operator()(const std::string& file, double,
                                                  const std::string&) const {
        throw std::runtime_error(
            shown_path(file) +
            ": load_json() reads no meshes unless it is given ObjMeshes, from "
            "ljus/io/load_obj.hpp.");
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

/// The largest number of triangles of all instances together: the area of a stretched
/// one is a sum over its triangles.
inline constexpr std::size_t max_placed_triangles = 1 << 30;

// The mesh files of a scene so far. What is named again is copied from the scene; what
// instances place is kept once.
template <std::floating_point T>
struct FileMeshesT {
    struct Reading {
        double scale;
        std::string normals;
        std::size_t first, last; // of the meshes in the scene
    };
    struct Kept {
        double scale;
        std::string normals;
        std::vector<Ref<MeshT<T>>> meshes;
    };
    std::map<std::string, std::vector<Reading>> by_path{};
    std::map<std::string, std::vector<Kept>> kept{}; // by path as well
    std::size_t copied = 0, placed = 0;              // triangles
};

// How an object names a mesh file.
struct MeshName {
    JsonField file;
    std::string path;
    double scale;
    std::string normals;
};

inline MeshName read_mesh_name(const JsonField& field) {
    const JsonField file = member(field, "file");
    const auto scale = find(field, "scale");
    const auto normals = find(field, "normals");
    if (normals) require_one_of(*normals, {"file", "smooth", "flat"});
    return {file, path_beside(file),
            scale ? number(*scale, 1e-9, 1e9, "within [1e-9, 1e9]") : 1.0,
            normals ? text(*normals) : "file"};
}

// Requires that a file may be read once more.
inline void require_readings(const JsonField& file, std::size_t readings) {
    if (readings == max_mesh_readings)
        refuse(file, "is named with more than 16 scales and normals");
}

// Adds the meshes of a file as `add` does it.
template <std::floating_point T, typename LoadMeshes, typename Add>
void read_meshes(const JsonField& field, const FileSceneT<T>& scene,
                 FileMeshesT<T>& known, LoadMeshes& load_meshes, Add add) {
    const auto [file, path, factor, which] = read_mesh_name(field);
    const auto& all = std::get<std::vector<MeshT<T>>>(scene.shapes);
    auto& readings = known.by_path[one_path(path)];
    for (const auto& reading : readings) {
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
    require_readings(file, readings.size());
    const std::size_t first = all.size();
    for (MeshT<T>& mesh : load_meshes(path, factor, which)) add(std::move(mesh));
    readings.push_back({factor, which, first, all.size()});
}

// The meshes of a file, which the scene keeps for instances.
template <std::floating_point T, typename LoadMeshes>
std::vector<Ref<MeshT<T>>> read_kept_meshes(const JsonField& field,
                                            FileSceneT<T>& scene, FileMeshesT<T>& known,
                                            LoadMeshes& load_meshes) {
    const auto [file, path, factor, which] = read_mesh_name(field);
    auto& readings = known.kept[one_path(path)];
    for (const auto& reading : readings)
        if (reading.scale == factor && reading.normals == which) return reading.meshes;
    require_readings(file, readings.size());
    std::vector<Ref<MeshT<T>>> meshes;
    for (MeshT<T>& mesh : load_meshes(path, factor, which))
        meshes.push_back(scene.add(std::move(mesh)));
    readings.push_back({factor, which, meshes});
    return meshes;
}

// A map: the twelve numbers of a matrix of three rows.
template <std::floating_point T>
AffineT<T> read_place(const JsonField& field) {
    if (list_size(field) != 12)
        refuse_value(field, "a list of twelve numbers, the rows of a 3 x 4 matrix");
    AffineT<T> map;
    for (int i = 0; i < 12; ++i)
        map[i % 4][i / 4] =
            static_cast<T>(number(entry(field, std::size_t(i)), -max_length, max_length,
                                  "within [-1e9, 1e9]"));
    return map;
}

// Places the meshes of a file once for each map.
template <std::floating_point T, typename LoadMeshes>
void read_instances(const JsonField& field, MaterialId material,
                    const RgbT<T>& radiance, FileSceneT<T>& scene,
                    FileMeshesT<T>& known, LoadMeshes& load_meshes) {
    const JsonField places = member(field, "places");
    const std::size_t count = list_size(places);
    for (const Ref<MeshT<T>>& mesh :
         read_kept_meshes(field, scene, known, load_meshes)) {
        known.placed += std::min(count, max_placed_triangles) * mesh.get().size();
        if (known.placed > max_placed_triangles)
            refuse(places, "has too many entries; instances have at most 1073741824 "
                           "triangles together");
        for (std::size_t i = 0; i < count; ++i)
            made_of(entry(places, i), [&] {
                scene.add(InstanceT<T>(mesh, read_place<T>(entry(places, i))), material,
                          radiance);
            });
    }
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
    static constexpr std::string_view instances[]{"file", "scale", "normals", "places"};
    static constexpr std::string_view triangles[]{"vertices", "indices"};
    require_object(field, all,
                   type == "sphere"      ? JsonNames(sphere)
                   : type == "mesh"      ? JsonNames(mesh)
                   : type == "instances" ? JsonNames(instances)
                                         : JsonNames(triangles));
}

template <std::floating_point T, typename LoadMeshes>
void read_object(const JsonField& field,
                 const std::map<std::string, MaterialId>& materials,
                 FileSceneT<T>& scene, FileMeshesT<T>& meshes,
                 LoadMeshes& load_meshes) {
    const JsonField type = member(field, "type");
    require_one_of(type, {"sphere", "triangles", "mesh", "instances"});
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
    } else if (text(type) == "instances") {
        read_instances(field, material, radiance, scene, meshes, load_meshes);
    } else {
        const FlatShapesT<T> shapes = read_triangles<T>(field);
        for (const QuadT<T>& quad : shapes.quads) add(quad);
        for (const TriangleT<T>& triangle : shapes.triangles) add(triangle);
    }
}

} // namespace detail

/// \}

} // namespace ljus
