#pragma once

/// \file ljus/io/load_json.hpp
/// \brief Scenes from JSON files.

#include <map>

#include <nlohmann/json.hpp>

#include "ljus/image/image.hpp"
#include "ljus/io/detail/json_lights.hpp"
#include "ljus/io/detail/json_objects.hpp"
#include "ljus/io/detail/parse_json.hpp"
#include "ljus/io/file.hpp"
#include "ljus/scene/camera.hpp"

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
/// The materials are those of \ref json_materials, the objects those of
/// \ref json_objects. A list `lights` may follow, of points, spots, suns and an
/// environment: \ref json_lights. Lengths are within 1e9, radiance within 1e12.
/// \{

/// The content of a scene file.
template <std::floating_point T>
struct LoadedSceneT {
    detail::FileSceneT<T> scene; ///< Shapes, materials and lights.
    CameraT<T> camera;           ///< The camera.
    std::string name;            ///< Name of the scene on one line, or empty.
    int width = 0;               ///< Width of the picture, in pixels.
    int height = 0;              ///< Height of the picture, in pixels.
};
using LoadedScene = LoadedSceneT<float>; ///< LoadedSceneT in float.

namespace detail {

/// The largest file that load_json() accepts, in bytes.
inline constexpr std::size_t max_scene_file = std::size_t(1) << 26;

/// The largest number of soap films; the colours of each take a tenth of a second.
inline constexpr std::size_t max_soap_films = 16;

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

template <std::floating_point T>
void read_image_size(const JsonField& image, LoadedSceneT<T>& loaded) {
    require_object(image, {"width", "height", "pixel_filter"});
    const auto size = [&](const char* name) {
        return static_cast<int>(whole_number(member(image, name), 1, max_pixels));
    };
    loaded.width = size("width");
    loaded.height = size("height");
    if (loaded.width > max_pixels / loaded.height)
        refuse(image, std::string("has more than ").append(std::to_string(max_pixels)) +
                          " pixels");
    if (const auto filter = find(image, "pixel_filter");
        filter && text(*filter).substr(0, 3) != "box")
        refuse_value(*filter, "\"box\", the only filter that scene files support");
}

// The materials of a scene, by name.
template <typename Scene, std::floating_point T = typename Scene::Scalar>
std::map<std::string, MaterialId> read_materials(const JsonField& list, Scene& scene) {
    if (!list.value.is_object()) refuse_value(list, "an object");
    std::size_t films = 0;
    for (const auto& value : list.value)
        if (const auto type = value.find("type"); type != value.end())
            films += *type == "soap-film" ? 1u : 0u;
    if (films > max_soap_films)
        refuse(list, "has more than 16 soap films, whose colours are slow to compute");

    SharedByMaterialsT<T> shared{.pictures = FilePicturesT<T>(list)};
    std::map<std::string, MaterialId> materials;
    for (const auto& [name, value] : list.value.items())
        materials[name] = read_material({value, list.file, list.root}, shared, scene);
    return materials;
}

// Requires a valid number of lights; emissive `objects` count.
inline void require_lights(const JsonField& objects, std::size_t lights) {
    if (lights == 0)
        refuse(objects, "has no light; give an object an emission above 0, or add a "
                        "list of lights");
    if (lights > 65535)
        refuse(objects, std::string("has ")
                            .append(std::to_string(lights))
                            .append(" lights; it must have at most 65535"));
}

template <std::floating_point T, typename LoadMeshes>
LoadedSceneT<T> read_scene(const JsonField& top, LoadMeshes& load_meshes) {
    require_object(top, {"format", "name", "description", "camera", "image",
                         "materials", "objects", "lights"});
    for (const char* field : {"format", "description"}) (void)remark(top, field);

    LoadedSceneT<T> loaded;
    loaded.name = shown(remark(top, "name"), 200);
    loaded.camera = read_camera<T>(member(top, "camera"));
    read_image_size(member(top, "image"), loaded);
    const auto materials = read_materials(member(top, "materials"), loaded.scene);
    const JsonField objects = member(top, "objects");
    FileMeshes meshes;
    for (std::size_t i = 0; i < list_size(objects); ++i)
        read_object(entry(objects, i), materials, loaded.scene, meshes, load_meshes);
    if (const auto lights = find(top, "lights"))
        for (std::size_t i = 0; i < list_size(*lights); ++i)
            read_light(entry(*lights, i), loaded.scene);
    require_lights(objects, loaded.scene.light_count());
    return loaded;
}

} // namespace detail

/// Reads a scene from the text of a scene file.
/// \param source  The text.
/// \param file    The name of the file for messages.
/// \param load_meshes  Called as load_meshes(path, scale, normals), once for each mesh
///         file, scale and normals; returns a vector of meshes.
/// \return The scene. Two triangles that form a parallelogram become one quad.
/// \throws std::runtime_error  with one sentence that names the file, the path of the
///         field, its value and what would be right: "scene.json: objects[3].radius is
///         -1; it must be above 0."
template <std::floating_point T = float, typename LoadMeshes = detail::NoMeshesT<T>>
[[nodiscard]] LoadedSceneT<T> read_json_scene(std::string_view source,
                                              const std::string& file,
                                              LoadMeshes load_meshes = {}) {
    const nlohmann::json root = detail::parse_json(source, file);
    return detail::read_scene<T>({root, file, root}, load_meshes);
}

/// Loads a scene file.
/// \param path  The file.
/// \param load_meshes  As for read_json_scene(): MeshFiles, or nothing.
/// \throws std::runtime_error  as read_json_scene(), or with path and reason if the
///         file cannot be read.
template <std::floating_point T = float, typename LoadMeshes = detail::NoMeshesT<T>>
[[nodiscard]] LoadedSceneT<T> load_json(const std::string& path,
                                        LoadMeshes load_meshes = {}) {
    return read_json_scene<T>(detail::load_text(path, detail::max_scene_file), path,
                              load_meshes);
}

/// \}

} // namespace ljus
