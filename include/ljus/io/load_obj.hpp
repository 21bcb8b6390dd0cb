#pragma once

/// \file ljus/io/load_obj.hpp
/// \brief Meshes from OBJ files.

#include <sstream>

#ifndef TINY_OBJ_LOADER_H_ // the header guards its declarations only
#include <tiny_obj_loader.h>
#endif

#include "ljus/accel/mesh.hpp"
#include "ljus/io/detail/obj_reader.hpp"
#include "ljus/io/load_image.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/textured.hpp"
#include "ljus/scene/scene.hpp"

namespace ljus {

/// \defgroup load_obj Mesh files
/// \brief Optional (tinyobjloader, whose library must be linked): OBJ files and their
/// MTL files.
///
///     const auto teapot = load_obj("teapot.obj", {.scale = 0.1});
///     std::fputs(to_text(teapot.report).c_str(), stderr);
///     add_obj(scene, teapot);                               // the file's materials
///     scene.add(teapot.parts[0].mesh, scene.add(Glass{}));  // or another one
/// \{

namespace detail {

/// All faces of one material.
template <std::floating_point T>
struct ObjPartT {
    MeshT<T> mesh;                ///< Its triangles.
    detail::ObjMaterial material; ///< Its material in the file.
};

} // namespace detail

/// The content of a mesh file.
template <std::floating_point T>
struct LoadedObjT {
    std::vector<detail::ObjPartT<T>>
        parts{};        ///< One per material, in order of first use.
    ObjReport report{}; ///< The problems of the file.
    /// The pictures of the materials that could be read, by path.
    std::map<std::string, ImageT<T>> pictures{};
};
using LoadedObj = LoadedObjT<float>; ///< LoadedObjT in float.

/// A matt surface with the picture of map_Kd; see add_obj().
template <std::floating_point T>
using ObjPictureT = Textured<LambertianT<T>, PictureTextureT<T, UvMapT<T>>>;
using ObjPicture = ObjPictureT<float>; ///< ObjPictureT in float.

namespace detail {

// The callbacks of tinyobjloader, which let the reader parse numbers itself.
template <std::floating_point T>
tinyobj::callback_t calls_of_reader() {
    using Reader = ObjReader<T>;
    using Real = tinyobj::real_t;
    tinyobj::callback_t calls;
    calls.vertex_cb = [](void* reader, Real, Real, Real, Real) {
        static_cast<Reader*>(reader)->vertex();
    };
    calls.normal_cb = [](void* reader, Real, Real, Real) {
        static_cast<Reader*>(reader)->normal();
    };
    calls.texcoord_cb = [](void* reader, Real, Real, Real) {
        static_cast<Reader*>(reader)->texture();
    };
    calls.index_cb = [](void* reader, tinyobj::index_t* corners, int count) {
        static_cast<Reader*>(reader)->face(corners, static_cast<std::size_t>(count));
    };
    calls.usemtl_cb = [](void* reader, const char* name, int) {
        static_cast<Reader*>(reader)->use(name);
    };
    return calls;
}

[[noreturn]] inline void refuse_without_faces(const std::string& file,
                                              const ObjReport& report) {
    const std::string troubles = to_text(report);
    const std::string why =
        troubles.empty()
            ? "; a mesh file has lines such as 'v 0 0 1' and 'f 1 2 3'."
            : "; the first problem: " + troubles.substr(0, troubles.find('\n'));
    throw std::runtime_error(shown_path(file) + ": no face of the file can be used" +
                             why);
}

// Loads the picture of a material, unless it has none or it is loaded already.
template <std::floating_point T>
void load_picture(const ObjMaterial& material, LoadedObjT<T>& loaded) {
    const std::string& path = material.picture;
    if (path.empty() || loaded.pictures.contains(path)) return;
    try {
        loaded.pictures.emplace(path, load_image<T>(path));
    } catch (const std::runtime_error& wrong) {
        loaded.report.pictures.push_back(
            (material.picture_at + ": ").append(wrong.what()));
    }
}

} // namespace detail

/// Reads meshes from the text of an OBJ file. All faces of one material become one
/// mesh; cut_polygon() splits faces with more than three corners.
/// \param text      The text.
/// \param file      The name of the file for messages; material files are searched for
///                  beside it.
/// \param settings  Scale and normals.
/// \return The meshes, and a report: what cannot be used is left out and counted.
/// \throws std::runtime_error  with one sentence, if no face can be used, or if a mesh
///         cannot be made: "box.obj: no face of the file can be used; the first
///         problem: line 7: 12 faces refer to a vertex, ... that does not exist; ..."
/// \throws std::invalid_argument  for a scale that is not finite and above 0.
template <std::floating_point T = float>
[[nodiscard]] LoadedObjT<T> read_obj(std::string text, const std::string& file,
                                     const ObjSettings& settings = {}) {
    require_positive("the scale of a mesh file", settings.scale);
    detail::blunt_exponents(text);
    std::istringstream stream(std::move(text));
    detail::ObjReader<T> reader{.settings = settings, .line{.stream = stream}};
    reader.materials =
        detail::read_materials(stream.view(), detail::folder_of(file), reader.report);
    std::string warning, error; // not used: the report has our own
    tinyobj::LoadObjWithCallback(stream, detail::calls_of_reader<T>(), &reader, nullptr,
                                 &warning, &error);
    if (reader.parts.empty()) detail::refuse_without_faces(file, reader.report);

    LoadedObjT<T> loaded{.report = std::move(reader.report)};
    detail::count_edges(reader.whole, reader.lines, loaded.report);
    for (detail::ObjFacesT<T>& part : reader.parts) {
        detail::finish(part, settings.normals, loaded.report);
        if (settings.pictures) detail::load_picture(part.material, loaded);
        try {
            loaded.parts.push_back(
                {MeshT<T>(std::move(part.data)), std::move(part.material)});
        } catch (const std::invalid_argument& wrong) {
            throw std::runtime_error(shown_path(file) + ": " + wrong.what());
        }
    }
    return loaded;
}

/// Loads an OBJ file.
/// \throws std::runtime_error  as read_obj(), or with path and reason if the file
///         cannot be read.
template <std::floating_point T = float>
[[nodiscard]] LoadedObjT<T> load_obj(const std::string& path,
                                     const ObjSettings& settings = {}) {
    const Bytes bytes = load_file(path, detail::max_obj_file);
    return read_obj<T>(std::string(bytes.begin(), bytes.end()), path, settings);
}

/// Adds all meshes of a file to a scene with the file's materials: glass and mirrors if
/// the scene lists them, otherwise Lambert's with the colour Kd, or ObjPicture with
/// map_Kd if the scene lists that. Ke is the emission.
/// \param scene   A scene with meshes and Lambertian materials.
/// \param loaded  From load_obj().
template <typename Scene, std::floating_point T>
void add_obj(Scene& scene, const LoadedObjT<T>& loaded) {
    for (const detail::ObjPartT<T>& part : loaded.parts) {
        const detail::ObjMaterial& is = part.material;
        const GlassT<T> glass{.index = static_cast<T>(is.index)};
        const MirrorT<T> mirror{.reflectance = RgbT<T>(is.specular)};
        MaterialId id = [&] {
            if constexpr (Scene::template lists<GlassT<T>>)
                if (is.is_glass()) return scene.add(glass);
            if constexpr (Scene::template lists<MirrorT<T>>)
                if (is.is_mirror()) return scene.add(mirror);
            const LambertianT<T> matt{.albedo = RgbT<T>(is.diffuse)};
            if constexpr (Scene::template lists<ObjPictureT<T>>)
                if (const auto picture = loaded.pictures.find(is.picture);
                    picture != loaded.pictures.end())
                    return scene.add(ObjPictureT<T>{matt, {.image = picture->second}});
            return scene.add(matt);
        }();
        scene.add(part.mesh, id, RgbT<T>(is.emission));
    }
}

/// Adds all meshes of a file to a scene with one material.
/// \param scene     A scene with meshes.
/// \param loaded    From load_obj().
/// \param material  From scene.add().
/// \param radiance  Emission of all meshes, W/(m^2 sr).
template <typename Scene, std::floating_point T>
void add_obj(Scene& scene, const LoadedObjT<T>& loaded, MaterialId material,
             const RgbT<T>& radiance = RgbT<T>{0}) {
    for (const detail::ObjPartT<T>& part : loaded.parts)
        scene.add(part.mesh, material, radiance);
}

/// Reads the meshes of a scene file: load_json("scene.json", ObjMeshes{}). The scene
/// file sets their materials; those of the mesh file are not used.
template <std::floating_point T>
struct ObjMeshesT {
    std::string* report = nullptr; ///< Receives the problems, one per line.

    /// Reads one file.
    /// \param path     The file.
    /// \param scale    Factor of every coordinate.
    /// \param normals  "file", "smooth" or "flat".
    /// \return All meshes of the file.
    /// \throws std::runtime_error  as load_obj().
    [[nodiscard]] std::vector<MeshT<T>> operator()(const std::string& path,
                                                   double scale,
                                                   const std::string& normals) const {
        const ObjNormals which = normals == "smooth" ? ObjNormals::smooth
                                 : normals == "flat" ? ObjNormals::flat
                                                     : ObjNormals::file;
        auto loaded =
            load_obj<T>(path, {.scale = scale, .normals = which, .pictures = false});
        std::vector<MeshT<T>> meshes;
        for (auto& part : loaded.parts) meshes.push_back(std::move(part.mesh));
        const std::string text = to_text(loaded.report);
        if (report != nullptr && !text.empty())
            *report += shown_path(path) + ":\n" + text;
        return meshes;
    }
};
using ObjMeshes = ObjMeshesT<float>; ///< ObjMeshesT in float.

/// \}

} // namespace ljus
