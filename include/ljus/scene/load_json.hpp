#pragma once

/// \file ljus/scene/load_json.hpp
/// \brief Scenes from JSON files.

#include <map>

#include <nlohmann/json.hpp>

#include "ljus/geometry/mesh.hpp"
#include "ljus/geometry/pair_triangles.hpp"
#include "ljus/image/file.hpp"
#include "ljus/image/image.hpp"
#include "ljus/scene/camera.hpp"
#include "ljus/scene/json_lights.hpp"
#include "ljus/scene/json_materials.hpp"
#include "ljus/scene/parse_json.hpp"
#include "ljus/scene/scene.hpp"

namespace ljus {

/// \defgroup load_json Scene files
/// \brief Optional (nlohmann-json): a scene, its camera and the size of its picture.
///
///     {"name": "a ball", "image": {"width": 200, "height": 200},
///      "camera": {"position": [0, 1, 4], "look_at": [0, 1, 0], "up": [0, 1, 0],
///                 "vfov_deg": 40},
///      "materials": {"grey": {"type": "lambertian", "albedo": [0.5, 0.5, 0.5]}},
///      "objects": [{"type": "sphere", "material": "grey", "center": [0, 1, 0],
///                   "radius": 1, "emission": [2, 2, 2]}]}
///
/// The materials are those of \ref json_materials. A list `lights` may follow, of
/// points, spots and suns: \ref json_lights.
///
/// | `type` of an object | its fields, besides material, name and emission         |
/// |---------------------|---------------------------------------------------------|
/// | sphere              | center, radius                                          |
/// | triangles           | vertices, indices: three numbers a triangle, from 0     |
/// | mesh                | file: OBJ, beside the scene's; scale (1); normals (file, |
/// |                     | smooth or flat); see ObjMeshes                          |
///
/// Emission is radiance: of a sphere outwards, of a triangle towards
/// \f$(V_2 - V_1) \times (V_3 - V_1)\f$. Lengths are within 1e9, radiance within 1e12.
/// \{

/// A scene of whatever a scene file may hold.
template <std::floating_point T>
using FileSceneT =
    Scene<Shapes<QuadT<T>, SphereT<T>, TriangleT<T>, MeshT<T>>, FileMaterialsT<T>>;

/// What a scene file says.
template <std::floating_point T>
struct LoadedSceneT {
    FileSceneT<T> scene; ///< Shapes, materials and lights.
    CameraT<T> camera;   ///< Where it is seen from.
    std::string name;    ///< Of the scene; empty if it has none.
    int width = 0;       ///< Of its picture, in pixels.
    int height = 0;      ///< Of its picture, in pixels.
};
using LoadedScene = LoadedSceneT<float>; ///< LoadedSceneT in float.

/// The largest file that load_json() takes, in bytes.
inline constexpr std::size_t max_scene_file = std::size_t(1) << 28;

/// Reads no meshes: what load_json() does unless it is given an ObjMeshes.
struct NoMeshes {
    /// \throws std::runtime_error  always.
    [[noreturn]] void operator()(const std::string& file, double,
                                 const std::string&) const {
        throw std::runtime_error(
            file +
            ": meshes are not read here; load_json() must be given ObjMeshes, of "
            "ljus/scene/load_obj.hpp, which needs tinyobjloader.");
    }
};

namespace detail {

template <std::floating_point T>
CameraT<T> read_camera(const JsonField& field) {
    require_object(field, {"position", "look_at", "up", "vfov_deg"});
    const ViewT<T> view{
        .position{point_field(member(field, "position"))},
        .target{point_field(member(field, "look_at"))},
        .up{point_field(member(field, "up"))},
        .vfov_degrees = static_cast<T>(number(member(field, "vfov_deg"), 1e-3, 179.99,
                                              "within [0.001, 179.99] degrees"))};
    const Vec3T<T> way = view.target - view.position;
    if (!(glm::dot(way, way) > T(0)))
        refuse_value(member(field, "look_at"), "another point than camera.position");
    try {
        return look_at(view);
    } catch (const std::invalid_argument&) {
        refuse_value(member(field, "up"), "a direction that is not along the view");
    }
}

// The triangles of an object, as quads where two of them are one.
template <std::floating_point T>
FlatShapesT<T> read_triangles(const JsonField& field) {
    const JsonField vertices = member(field, "vertices");
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < list_size(vertices); ++i)
        points.push_back(point_field(entry(vertices, i)));

    const JsonField indices = member(field, "indices");
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < list_size(indices); ++i) {
        const JsonField triple = entry(indices, i);
        if (list_size(triple) != 3) refuse_value(triple, "a list of three numbers");
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const JsonField index = entry(triple, k);
            if (points.empty()) refuse(index, "names a vertex, but there are none");
            corners[k] = static_cast<std::uint32_t>(
                whole_number(index, 0, static_cast<long long>(points.size()) - 1));
        }
        const glm::dvec3& a = points[corners[0]];
        const glm::dvec3 normal =
            glm::cross(points[corners[1]] - a, points[corners[2]] - a);
        if (!(glm::dot(normal, normal) > 0))
            refuse(triple, "is a triangle without an area");
        triangles.push_back(corners);
    }
    return pair_triangles<T>(points, triangles);
}

// The meshes of an object's file.
template <std::floating_point T, typename LoadMeshes>
std::vector<MeshT<T>> read_meshes(const JsonField& field, LoadMeshes& load_meshes) {
    const std::string file = text(member(field, "file"));
    const auto scale = find(field, "scale");
    const auto normals = find(field, "normals");
    if (normals) require_one_of(*normals, {"file", "smooth", "flat"});
    const double factor = scale ? number(*scale, 1e-9, 1e9, "within [1e-9, 1e9]") : 1.0;
    const std::size_t slash = field.file.find_last_of("/\\");
    const bool beside = slash != std::string::npos && file.substr(0, 1) != "/";
    const std::string path = beside ? field.file.substr(0, slash + 1) + file : file;
    if constexpr (std::is_same_v<std::remove_cvref_t<LoadMeshes>, NoMeshes>)
        load_meshes(path, factor, normals ? text(*normals) : "file");
    else
        return load_meshes(path, factor, normals ? text(*normals) : "file");
}

template <std::floating_point T, typename LoadMeshes>
void read_object(const JsonField& field,
                 const std::map<std::string, MaterialId>& materials,
                 FileSceneT<T>& scene, LoadMeshes& load_meshes) {
    const JsonField type = member(field, "type");
    require_one_of(type, {"sphere", "triangles", "mesh"});
    const bool sphere = text(type) == "sphere";
    const bool mesh = text(type) == "mesh";
    if (sphere)
        require_object(field,
                       {"type", "name", "material", "emission", "center", "radius"});
    else if (mesh)
        require_object(field, {"type", "name", "material", "emission", "file", "scale",
                               "normals"});
    else
        require_object(field,
                       {"type", "name", "material", "emission", "vertices", "indices"});
    if (const auto name = find(field, "name")) (void)text(*name);

    const JsonField material = member(field, "material");
    const auto known = materials.find(text(material));
    if (known == materials.end()) {
        std::vector<std::string> names;
        for (const auto& [name, id] : materials) names.push_back(name);
        refuse_value(material,
                     std::string("one of the materials ") + in_a_row(names, "or"));
    }
    RgbT<T> emission{T(0)};
    const auto emitted = find(field, "emission");
    if (emitted)
        emission = RgbT<T>{vector_field(*emitted, 0, max_radiance, "within [0, 1e12]")};

    const auto add = [&](const auto& shape) {
        try {
            scene.add(shape, known->second, emission);
        } catch (const std::invalid_argument& error) {
            // What is too small or too large for T, though not for the file.
            refuse(field, std::string("cannot be used: ") + error.what());
        }
    };
    if (sphere) {
        const JsonField radius = member(field, "radius");
        const double length = number(radius, -max_length, max_length, "at most 1e9");
        if (!(static_cast<T>(length) > T(0))) refuse_value(radius, "above 0");
        add(SphereT<T>{.center{point_field(member(field, "center"))},
                       .radius = static_cast<T>(length)});
    } else if (mesh) {
        for (const MeshT<T>& part : read_meshes<T>(field, load_meshes)) add(part);
    } else {
        const FlatShapesT<T> shapes = read_triangles<T>(field);
        for (const QuadT<T>& quad : shapes.quads) add(quad);
        for (const TriangleT<T>& triangle : shapes.triangles) add(triangle);
    }
}

} // namespace detail

/// Reads a scene from the text of a scene file.
/// \param source  The text.
/// \param file    What messages call it: the name of the file.
/// \param load_meshes  Called as load_meshes(path, scale, normals) for each mesh;
///         returns a vector of meshes.
/// \return The scene. Two triangles that are one parallelogram have become one quad.
/// \throws std::runtime_error  with one sentence that names the file, the path of the
///         field, its value and what would be right: "scene.json: objects[3].radius is
///         -1; it must be above 0."
template <std::floating_point T = float, typename LoadMeshes = NoMeshes>
[[nodiscard]] LoadedSceneT<T> read_json_scene(std::string_view source,
                                              const std::string& file,
                                              LoadMeshes load_meshes = {}) {
    const nlohmann::json root = parse_json(source, file);
    const JsonField top{root, file, ""};
    require_object(top, {"format", "name", "description", "camera", "image",
                         "materials", "objects", "lights"});
    for (const char* field : {"format", "name", "description"})
        if (const auto comment = find(top, field)) (void)text(*comment);

    LoadedSceneT<T> loaded;
    if (const auto name = find(top, "name")) loaded.name = text(*name);
    loaded.camera = detail::read_camera<T>(member(top, "camera"));

    const JsonField image = member(top, "image");
    require_object(image, {"width", "height", "pixel_filter"});
    loaded.width =
        static_cast<int>(whole_number(member(image, "width"), 1, max_pixels));
    loaded.height =
        static_cast<int>(whole_number(member(image, "height"), 1, max_pixels));
    if (loaded.width > max_pixels / loaded.height)
        refuse(image, std::string("has more than ").append(std::to_string(max_pixels)) +
                          " pixels");
    if (const auto filter = find(image, "pixel_filter");
        filter && text(*filter).substr(0, 3) != "box")
        refuse_value(*filter, "\"box\", the only filter that there is");

    std::map<std::string, MaterialId> materials;
    const JsonField list = member(top, "materials");
    if (!list.value.is_object()) refuse_value(list, "an object");
    for (const auto& [name, value] : list.value.items())
        materials[name] = detail::read_material(
            {value, file, path_of_member(list.path, name)}, loaded.scene);

    const JsonField objects = member(top, "objects");
    for (std::size_t i = 0; i < list_size(objects); ++i)
        detail::read_object(entry(objects, i), materials, loaded.scene, load_meshes);
    if (const auto lights = find(top, "lights"))
        for (std::size_t i = 0; i < list_size(*lights); ++i)
            detail::read_light(entry(*lights, i), loaded.scene);
    if (loaded.scene.lights.empty())
        refuse(objects, "has no light; at least one needs an emission above 0, or "
                        "there must be lights");
    if (loaded.scene.lights.size() > 65535)
        refuse(objects, std::string("has ")
                            .append(std::to_string(loaded.scene.lights.size()))
                            .append(" lights; it must have at most 65535"));
    return loaded;
}

/// Loads a scene file.
/// \param path  The file.
/// \param load_meshes  As for read_json_scene(): ObjMeshes, or nothing.
/// \return The scene.
/// \throws std::runtime_error  as read_json_scene(); or, if the file cannot be read,
///         with its name and the reason.
template <std::floating_point T = float, typename LoadMeshes = NoMeshes>
[[nodiscard]] LoadedSceneT<T> load_json(const std::string& path,
                                        LoadMeshes load_meshes = {}) {
    const Bytes bytes = load_file(path, max_scene_file);
    return read_json_scene<T>(
        {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path, load_meshes);
}

/// \}

} // namespace ljus
