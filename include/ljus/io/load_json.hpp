#pragma once

/// \file ljus/io/load_json.hpp
/// \brief Reads scenes from JSON files.

#include <map>

#include <nlohmann/json.hpp>

#include "ljus/image/image.hpp"
#include "ljus/io/detail/json_lights.hpp"
#include "ljus/io/detail/json_objects.hpp"
#include "ljus/io/detail/parse_json.hpp"
#include "ljus/io/file.hpp"
#include "ljus/scene/lens_camera.hpp"

namespace ljus {

/// \defgroup load_json Scene files
/// \brief Scene files in JSON: a scene, its camera and the size of its picture. Loading
/// them needs the package nlohmann-json.
///
///     {"name": "a ball", "image": {"width": 200, "height": 200},
///      "camera": {"position": [0, 1, 4], "look_at": [0, 1, 0], "up": [0, 1, 0],
///                 "vfov_deg": 40},
///      "materials": {"grey": {"type": "lambertian", "albedo": [0.5, 0.5, 0.5]}},
///      "objects": [{"type": "sphere", "material": "grey", "center": [0, 1, 0],
///                   "radius": 1, "emission": [2, 2, 2]}]}
///
/// All members of scene files are listed in \ref ch_scene_files.
/// \{

/// The content of a scene file.
template <std::floating_point T>
struct LoadedSceneT {
    detail::FileSceneT<T> scene; ///< Shapes, materials, lights and fog.
    LensCameraT<T> camera;       ///< The camera; a lens radius of 0 means a pinhole.
    std::string name;            ///< Name of the scene on one line, or empty.
    int width = 0;               ///< Width of the picture, in pixels.
    int height = 0;              ///< Height of the picture, in pixels.
};
using LoadedScene = LoadedSceneT<float>; ///< LoadedSceneT in float.

namespace detail {

/// The largest file that load_json() accepts, in bytes.
inline constexpr std::size_t max_scene_file = std::size_t(1) << 26;

/// The largest number of soap films. Each takes a tenth of a second to compute.
inline constexpr std::size_t max_soap_films = 16;

inline constexpr JsonMember camera_members[]{
    needed("position", point_value, "the pinhole, or the middle of the lens",
           "[0, 1, 4]"),
    needed("look_at", point_value, "the point at the middle of the picture",
           "[0, 1, 0]"),
    needed("up", point_value, "a direction, not along the view", "[0, 1, 0]"),
    needed("vfov_deg",
           {JsonKind::number, 1e-3, 179.99, "within [0.001, 179.99] degrees"},
           "full vertical angle of view, degrees", "40"),
    optional("lens", {.kind = JsonKind::object, .of = "lens"},
             "blurs what is out of focus")};
inline constexpr JsonMember lens_members[]{
    needed("radius", {JsonKind::number, 0, max_length, "within [0, 1e9]"},
           "half the width of the opening; 0: a pinhole", "0.05"),
    needed("focus", length_value, "distance of the plane of focus along the view",
           "4")};
inline constexpr JsonMember image_members[]{
    needed("width", {JsonKind::whole, 1, max_pixels, {}}, "pixels", "200"),
    needed("height", {JsonKind::whole, 1, max_pixels, {}}, "pixels", "200"),
    optional("pixel_filter", text_value, "box, the only one")};
inline constexpr JsonMember scene_members[]{
    optional("format", remark_value, "for people"),
    optional("name", remark_value, "for people: the title of the picture",
             "\"a ball\""),
    optional("description", remark_value, "for people"),
    needed("camera", {.kind = JsonKind::object, .of = "camera"}, "where the eye is",
           {}),
    needed("image", {.kind = JsonKind::object, .of = "image"}, "size of the picture",
           {}),
    needed("materials", {.kind = JsonKind::named, .of = "material"},
           "materials by their names", {}),
    needed("objects", {.kind = JsonKind::list, .of = "object"}, "shapes", {}),
    optional("lights", {.kind = JsonKind::list, .of = "light"},
             "lights that are no objects"),
    optional("fog", {.kind = JsonKind::list, .of = "fog"}, "balls and boxes of fog"),
    optional("lamp_groups", {.kind = JsonKind::named, .of = "factor"},
             "names of groups, and the factor of each group's light, from 0 on"),
    optional("$schema", text_value, "the JSON schema, for editors")};

template <std::floating_point T>
LensCameraT<T> read_camera(const JsonField& field) {
    const JsonMembersOf in(field, camera_members);
    const ViewT<T> view{.position{in.vector("position")},
                        .target{in.vector("look_at")},
                        .up{in.vector("up")},
                        .vfov_degrees = static_cast<T>(in.number("vfov_deg"))};
    const Vec3T<T> way = view.target - view.position;
    if (!(glm::dot(way, way) > T(0)))
        refuse_value(in["look_at"], "another point than camera.position");
    const auto pinhole = [&] {
        try {
            return look_at(view);
        } catch (const std::invalid_argument&) {
            refuse_value(in["up"], "a direction that is not along the view");
        }
    }();
    if (!in.has("lens")) return {pinhole};
    const JsonMembersOf lens(in["lens"], lens_members);
    return made_of(in["lens"], [&] {
        return with_lens(pinhole, static_cast<T>(lens.number("radius")),
                         static_cast<T>(lens.number("focus")));
    });
}

template <std::floating_point T>
void read_image_size(const JsonField& field, LoadedSceneT<T>& loaded) {
    const JsonMembersOf in(field, image_members);
    loaded.width = static_cast<int>(in.number("width"));
    loaded.height = static_cast<int>(in.number("height"));
    if (loaded.width > max_pixels / loaded.height)
        refuse(field, join({"has more than ", to_text(max_pixels), " pixels"}));
    if (in.has("pixel_filter") && text(in["pixel_filter"]).substr(0, 3) != "box")
        refuse_value(in["pixel_filter"],
                     "\"box\", the only filter that scene files support");
}

// Reads the materials of a scene, by name.
template <typename Scene, std::floating_point T = typename Scene::Scalar>
std::map<std::string, MaterialId> read_materials(const JsonField& list, Scene& scene) {
    std::size_t films = 0;
    for (const auto& value : list.value)
        if (const auto type = value.find("type"); type != value.end())
            films += *type == "soap-film" ? 1u : 0u;
    if (films > max_soap_films)
        refuse(list, "has more than 16 soap films, whose colours are slow to compute");

    SharedByMaterialsT<T> shared;
    std::map<std::string, MaterialId> materials;
    for (const auto& [name, value] : list.value.items())
        materials[name] = read_material({value, list.file, list.root}, shared, scene);
    return materials;
}

// Requires a valid number of lights, including emissive objects.
inline void require_lights(const JsonField& objects, std::size_t lights) {
    if (lights == 0)
        refuse(objects, "has no light; give an object an emission above 0, or add a "
                        "list of lights");
    if (lights > 65535)
        refuse(objects, join({"has ", std::to_string(lights),
                              " lights; it must have at most 65535"}));
}

template <std::floating_point T, typename LoadMeshes>
LoadedSceneT<T> read_scene(const JsonField& top, LoadMeshes& load_meshes) {
    const JsonMembersOf in(top, scene_members);
    LoadedSceneT<T> loaded;
    if (in.has("name") && !in["name"].value.is_null())
        loaded.name = shown(text(in["name"]), 200);
    loaded.camera = read_camera<T>(in["camera"]);
    read_image_size(in["image"], loaded);
    const auto materials = read_materials(in["materials"], loaded.scene);
    const LampGroups groups(in);
    FileMeshesT<T> meshes;
    for (const JsonField& object : entries(in["objects"]))
        read_object(object, materials, groups, loaded.scene, meshes, load_meshes);
    for (const JsonField& light : entries(find(top, "lights")))
        read_light(light, groups, loaded.scene, load_meshes);
    for (const JsonField& fog : entries(find(top, "fog"))) read_fog(fog, loaded.scene);
    require_lights(in["objects"], loaded.scene.light_count());
    return loaded;
}

} // namespace detail

/// Reads a scene from the text of a scene file. `file` is its path, for messages; other
/// files are looked for in its folder.
///
/// `load_meshes` reads mesh files, for example MeshFiles. It is called as
/// load_meshes(path, settings), once for each file and its MeshFileSettings, and
/// returns a LoadedMeshT. MeshFileSettings::pictures is true if the materials of the
/// file are used. WithExr also reads EXR pictures.
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

/// Loads a scene file; see read_json_scene().
/// \throws std::runtime_error  as read_json_scene(), or if the file cannot be read.
template <std::floating_point T = float, typename LoadMeshes = detail::NoMeshesT<T>>
[[nodiscard]] LoadedSceneT<T> load_json(const std::string& path,
                                        LoadMeshes load_meshes = {}) {
    return read_json_scene<T>(detail::load_text(path, detail::max_scene_file), path,
                              load_meshes);
}

/// \}

} // namespace ljus
