#pragma once

/// \file ljus/io/load_obj.hpp
/// \brief Meshes from OBJ files.

#include "ljus/io/detail/mesh_pictures.hpp"
#include "ljus/io/detail/obj_reader.hpp"
#include "ljus/io/load_image.hpp"

namespace ljus {

/// \defgroup load_obj Mesh files
/// \brief OBJ files with their MTL files, PLY, STL and glTF. Chapter:
/// \ref ch_triangle_files.
///
///     const auto teapot = load_obj("teapot.obj", {.scale = 0.1});
///     std::fputs(to_text(teapot.report).c_str(), stderr);
///     add_meshes(scene, teapot);                          // colours of the file
///     scene.add(teapot.parts[0].mesh, scene.add(Glass{}));  // or one's own
/// \{

namespace detail {

// The bytes of a picture.
inline Bytes picture_file(const std::string& path) {
    return load_file(path, max_image_file);
}

// The meshes of a file, which `read` gives to an ObjReader.
template <std::floating_point T, typename Read>
LoadedMeshT<T> read_obj_pieces(const std::string& file,
                               const MeshFileSettings& settings, Read read) {
    return make_meshes<T>(
        file, settings, "; a mesh file has lines such as 'v 0 0 1' and 'f 1 2 3'.",
        [&](LoadedMeshT<T>& loaded) {
            ObjReader<T> reader(file, settings);
            read(reader);
            return reader.take_faces(loaded.report);
        },
        [](MeshMaterial& material, LoadedMeshT<T>& loaded, long long& pixels) {
            load_pictures(material, loaded, pixels, picture_file);
        });
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
[[nodiscard]] LoadedMeshT<T> read_obj(std::string_view text, const std::string& file,
                                      const MeshFileSettings& settings = {}) {
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
[[nodiscard]] LoadedMeshT<T> load_obj(const std::string& path,
                                      const MeshFileSettings& settings = {}) {
    return detail::read_obj_pieces<T>(path, settings, [&](auto& reader) {
        read_in_pieces(path, detail::max_mesh_file,
                       [&](std::string_view piece, bool last) {
                           return reader.read(piece, last);
                       });
    });
}

/// \}

} // namespace ljus
