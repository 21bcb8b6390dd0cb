#pragma once

/// \file ljus/io/load_gltf.hpp
/// \brief Meshes, cameras and lights from glTF 2.0 files.

#include <utility>

#include <nlohmann/json.hpp>

#include "ljus/io/detail/gltf_reader.hpp"

namespace ljus {

/// \addtogroup load_obj
/// \{

/// Reads the meshes of a glTF 2.0 file, .gltf or .glb, and its cameras and lights.
/// Optional (nlohmann-json). The meshes stand as the nodes of the file's scene place
/// them; faces of one material are one mesh.
///
/// A metal has the colour and roughness of the file, at least 0.01 or 0; a factor of
/// 0.5 or more is a metal. A picture of metal and roughness counts at the middle of
/// each triangle, in steps of 1/8, so that the faces of one metal become several
/// meshes. All else is matt in its colour, or glass by KHR_materials_transmission;
/// KHR_materials_unlit is matt too, as a surface that glows would light the scene.
/// Each mesh has copies of its pictures; all pictures are halved until the copies have
/// at most 2^25 pixels together.
/// What glows has its emissiveFactor for radiance, W/(m^2 sr), times the strength of
/// KHR_materials_emissive_strength; with a picture of it, it does not glow. All
/// pictures of a material lie as that of its base colour does, by its sampler and its
/// KHR_texture_transform; with alphaMode MASK its alpha cuts holes. Lights of
/// KHR_lights_punctual have candela for W/sr and lux for W/m^2; with `scale` distances
/// and intensities grow alike, so that the light on surfaces stays the same.
/// \param bytes     The bytes.
/// \param file      What messages call it: its name; buffers and pictures are looked
///                  for beside it.
/// \param settings  Scale and normals.
/// \return The content, and in the report what is wrong or not used: skins, animations,
///         morph targets, tangents, alphaMode BLEND, the scale of normals, other
///         extensions.
/// \throws std::runtime_error  with one sentence, for a file that breaks the format, or
///         requires an extension that is not known: "a.gltf: accessors[2] has 36
///         elements of 12 bytes, which do not fit into the 288 bytes of its view.";
///         or as read_obj().
/// \throws std::invalid_argument  for a scale that is not finite and above 0.
/// \cost Linear in the size of the files and the number of triangles, at most 2^23.
template <std::floating_point T = float>
[[nodiscard]] LoadedMeshT<T> read_gltf(Bytes bytes, const std::string& file,
                                       const MeshFileSettings& settings = {}) {
    const detail::GltfFile content(std::exchange(bytes, {}), file); // frees the bytes
    detail::GltfReader<T> reader(content, settings);
    return detail::make_meshes<T>(
        file, settings, "; its scene must have nodes with meshes of triangles.",
        [&](LoadedMeshT<T>& loaded) { return reader.take_faces(loaded); },
        [&](MeshMaterial& material, LoadedMeshT<T>& loaded, long long& pixels) {
            detail::load_pictures(
                material, loaded, pixels,
                [&](const std::string& name) { return reader.picture(name); });
        });
}

/// Loads a glTF file.
/// \return As read_gltf().
/// \throws std::runtime_error  as read_gltf(); or, if the file cannot be read, with its
///         name and the reason.
template <std::floating_point T = float>
[[nodiscard]] LoadedMeshT<T> load_gltf(const std::string& path,
                                       const MeshFileSettings& settings = {}) {
    return read_gltf<T>(load_file(path, detail::max_mesh_file), path, settings);
}

/// \}

} // namespace ljus
