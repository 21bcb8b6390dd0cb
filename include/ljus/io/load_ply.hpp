#pragma once

/// \file ljus/io/load_ply.hpp
/// \brief Meshes from PLY files.

#include "ljus/io/detail/ply_reader.hpp"

namespace ljus {

/// \addtogroup load_obj
/// \{

namespace detail {

// The meshes of a file; bytes_of() returns its bytes, which are freed before the meshes
// are made if they are a value.
template <std::floating_point T, typename BytesOf>
LoadedMeshT<T> read_ply_bytes(const std::string& file, const MeshFileSettings& settings,
                              BytesOf bytes_of) {
    return make_meshes<T>(
        file, settings, "; a mesh has elements 'face' with a list 'vertex_indices'.",
        [&](LoadedMeshT<T>& loaded) {
            const Bytes& bytes = bytes_of();
            return PlyReader<T>(bytes, file, settings).take_faces(loaded);
        },
        no_pictures);
}

} // namespace detail

/// Reads a mesh from the bytes of a PLY file: text or binary of either byte order.
/// It has positions (x, y, z), perhaps normals (nx, ny, nz), texture coordinates (u, v;
/// s, t; texture_u, texture_v), colours (red, green, blue, with diffuse_ before them or
/// not) and faces of any number of corners. Colours make the mesh white under a
/// picture of them. Whole numbers are colours as a screen has them, from 0 to the
/// largest number of their type; broken ones too, from 0 to 1.
/// \param bytes     The bytes.
/// \param file      What messages call it.
/// \param settings  Scale and normals.
/// \return One mesh without a material, and what is wrong with the file.
/// \throws std::runtime_error  with one sentence: "bunny.ply: the file ends within its
///         element 8 of 35947, vertex."; or as read_obj().
/// \throws std::invalid_argument  for a scale that is not finite and above 0.
/// \cost Linear in the size of the file, which bounds its memory.
template <std::floating_point T = float>
[[nodiscard]] LoadedMeshT<T> read_ply(const Bytes& bytes, const std::string& file,
                                      const MeshFileSettings& settings = {}) {
    return detail::read_ply_bytes<T>(file, settings,
                                     [&]() -> const Bytes& { return bytes; });
}

/// Loads a PLY file.
/// \param path      The file.
/// \param settings  Scale and normals.
/// \return As read_ply().
/// \throws std::runtime_error  as read_ply(); or, if the file cannot be read, with its
///         name and the reason.
template <std::floating_point T = float>
[[nodiscard]] LoadedMeshT<T> load_ply(const std::string& path,
                                      const MeshFileSettings& settings = {}) {
    return detail::read_ply_bytes<T>(
        path, settings, [&] { return load_file(path, detail::max_mesh_file); });
}

/// \}

} // namespace ljus
