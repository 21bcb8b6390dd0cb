#pragma once

/// \file ljus/io/load_obj.hpp
/// \brief Meshes from OBJ files.

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
/// \brief OBJ files and their MTL files.
///
///     const auto teapot = load_obj("teapot.obj", {.scale = 0.1});
///     std::fputs(to_text(teapot.report).c_str(), stderr);
///     add_obj(scene, teapot);                          // colours of the file
///     scene.add(teapot.parts[0].mesh, scene.add(Glass{}));  // or one's own
/// \{

/// All faces of one material.
template <std::floating_point T>
struct ObjPartT {
    MeshT<T> mesh;        ///< Its triangles.
    ObjMaterial material; ///< Its material in the file.
};

/// The content of a mesh file.
template <std::floating_point T>
struct LoadedObjT {
    std::vector<ObjPartT<T>> parts{}; ///< One per material, in order of first use.
    ObjReport report{};               ///< The problems of the file.
    /// The pictures of the materials that could be read, by path.
    std::map<std::string, ImageT<T>> pictures{};
};
using LoadedObj = LoadedObjT<float>; ///< LoadedObjT in float.

/// A matt surface with the picture of map_Kd; see add_obj().
template <std::floating_point T>
using ObjPictureT = Textured<LambertianT<T>, PictureTextureT<T, UvMapT<T>>>;
using ObjPicture = ObjPictureT<float>; ///< ObjPictureT in float.

namespace detail {

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

// Loads the picture of a material, unless it has none or it is loaded already. The
// pixels of all materials so far are limited, because add_obj() copies each picture.
template <std::floating_point T>
void load_picture(ObjMaterial& material, LoadedObjT<T>& loaded, long long& pixels) {
    const std::string path = material.picture;
    if (path.empty()) return;
    try {
        auto known = loaded.pictures.find(path);
        if (known == loaded.pictures.end())
            known = loaded.pictures.emplace(path, load_image<T>(path, pixels)).first;
        const ImageT<T>& image = known->second;
        const std::string why = too_large_beside(pixels, image.width, image.height);
        if (!why.empty()) {
            material.picture.clear();
            throw std::runtime_error(join({shown_path(path), " ", why, "."}));
        }
        pixels += static_cast<long long>(image.pixels.size());
    } catch (const std::runtime_error& wrong) {
        loaded.report.notes.push_back(
            (material.picture_at + ": ").append(wrong.what()));
    }
}

// The meshes of a file, which `read` gives to an ObjReader. The lists of the reader are
// gone when the meshes, which need more memory, are made.
template <std::floating_point T, typename Read>
LoadedObjT<T> read_obj_pieces(const std::string& file, const ObjSettings& settings,
                              Read read) {
    require_positive("the scale of a mesh file", settings.scale);
    LoadedObjT<T> loaded;
    std::vector<ObjFacesT<T>> parts;
    {
        ObjReader<T> reader(file, settings);
        read(reader);
        parts = reader.take_faces();
        loaded.report = std::move(reader.report);
    }
    if (parts.empty()) refuse_without_faces(file, loaded.report);
    long long pixels = 0;
    for (ObjFacesT<T>& part : parts) {
        if (settings.pictures) load_picture(part.material, loaded, pixels);
        try {
            loaded.parts.push_back(
                {MeshT<T>(std::move(part.data)), std::move(part.material)});
        } catch (const std::invalid_argument& wrong) {
            throw std::runtime_error(shown_path(file) + ": " + wrong.what());
        }
    }
    return loaded;
}

} // namespace detail

/// Reads meshes from the text of an OBJ file. Faces of one material, wherever they
/// stand, are one mesh; those of more than three corners are cut by cut_polygon().
/// \param text      The text.
/// \param file      What messages call it: its name; material files are looked for
///                  beside it.
/// \param settings  Scale and normals.
/// \return The meshes, and what is wrong with the file: what cannot be used is left
///         out, and counted.
/// \throws std::runtime_error  with one sentence, if no face can be used, or if a mesh
///         cannot be made: "box.obj: no face of the file can be used; the first
///         problem: line 7: 12 faces refer to a vertex that does not exist; ..."
/// \throws std::invalid_argument  for a scale that is not finite and above 0.
template <std::floating_point T = float>
[[nodiscard]] LoadedObjT<T> read_obj(std::string_view text, const std::string& file,
                                     const ObjSettings& settings = {}) {
    return detail::read_obj_pieces<T>(file, settings,
                                      [&](auto& reader) { reader.read(text, true); });
}

/// Loads an OBJ file.
/// \param path      The file.
/// \param settings  Scale and normals.
/// \return As read_obj().
/// \throws std::runtime_error  as read_obj(); or, if the file cannot be read, with its
///         name and the reason.
template <std::floating_point T = float>
[[nodiscard]] LoadedObjT<T> load_obj(const std::string& path,
                                     const ObjSettings& settings = {}) {
    return detail::read_obj_pieces<T>(path, settings, [&](auto& reader) {
        read_in_pieces(path, detail::max_obj_file,
                       [&](std::string_view piece, bool last) {
                           return reader.read(piece, last);
                       });
    });
}

/// Adds all meshes of a file to a scene, each made of what the file says: glass and
/// mirrors where the scene lists them, and else Lambert's surface with the colour Kd;
/// with the picture of map_Kd, if there is one and the scene lists ObjPicture. What
/// glows, glows by Ke.
/// \param scene   A scene with meshes and Lambert's surface.
/// \param loaded  The result of load_obj().
template <typename Scene, std::floating_point T>
void add_obj(Scene& scene, const LoadedObjT<T>& loaded) {
    for (const ObjPartT<T>& part : loaded.parts) {
        const ObjMaterial& is = part.material;
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

/// Adds all meshes of a file to a scene, with one material for all.
/// \param scene     A scene with meshes.
/// \param loaded    The result of load_obj().
/// \param material  The id that add() returned for it.
/// \param radiance  Radiance that each mesh emits, W/(m^2 sr).
template <typename Scene, std::floating_point T>
void add_obj(Scene& scene, const LoadedObjT<T>& loaded, MaterialId material,
             const RgbT<T>& radiance = RgbT<T>{0}) {
    for (const ObjPartT<T>& part : loaded.parts)
        scene.add(part.mesh, material, radiance);
}

/// Reads the meshes of a scene file: load_json("scene.json", ObjMeshes{}). They are
/// made of what the scene file says; the colours of the mesh file are not used.
template <std::floating_point T>
struct ObjMeshesT {
    std::string* report = nullptr; ///< Takes what is wrong, a line a trouble.

    /// Reads one file.
    /// \param path     The file.
    /// \param scale    Every coordinate is multiplied by this.
    /// \param normals  "file", "smooth" or "flat".
    /// \return All its meshes.
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
