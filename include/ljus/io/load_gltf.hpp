#pragma once

/// \file ljus/io/load_gltf.hpp
/// \brief Reads meshes, cameras and lights from glTF 2.0 files.

#include <utility>

#include <nlohmann/json.hpp>

#include "ljus/io/detail/gltf_reader.hpp"

namespace ljus {

/// \addtogroup load_obj
/// \{

/// Reads the meshes, cameras and lights of a glTF 2.0 file, .gltf or .glb, by means of
/// the package nlohmann-json. The nodes of the file's scene place the meshes. All faces
/// of one material form one mesh.
///
/// A material with a metallicFactor of 0.5 or more is a metal, with the colour and
/// roughness of the file; a roughness below 0.01 becomes 0. A metallicRoughnessTexture
/// is read at the middle of each triangle, and its roughness is rounded to a multiple
/// of 1/8. The faces of one metal may thus become several meshes. A material with a
/// transmissionFactor above 0.5 is glass. All other materials are matt, even with
/// KHR_materials_unlit. A material with the older KHR_materials_pbrSpecularGlossiness
/// is matt and has the diffuse colours of that extension.
///
/// The emissiveFactor, times the strength of KHR_materials_emissive_strength, is used
/// as radiance, in W/(m^2 sr). A material with an emissiveTexture does not glow.
///
/// All pictures of a material use the sampler and the KHR_texture_transform of the
/// baseColorTexture. With alphaMode MASK, the alpha of the baseColorTexture cuts holes.
/// Each mesh has copies of its pictures. The width and height of all pictures are
/// halved until the copies have at most 2^25 pixels together.
///
/// The intensities of KHR_lights_punctual are read as W/sr instead of candela, and as
/// W/m^2 instead of lux. The intensities of point lights and spots are multiplied by
/// the square of `scale`, so that the irradiance on surfaces does not depend on the
/// scale.
///
/// `file` is the path of the file, for messages; buffers and pictures are looked for in
/// its folder.
/// \return The content of the file. Its report says what is wrong or not used: skins,
///         animations, morph targets, tangents, alphaMode BLEND, the scale of normals,
///         other extensions.
/// \throws std::runtime_error  if the file breaks the format or requires an unknown
///         extension, with one sentence: "a.gltf: accessors[2] has 36 elements of 12
///         bytes, which do not fit into the 288 bytes of its view."
/// \throws std::runtime_error  as read_obj().
/// \throws std::invalid_argument  unless the scale is finite and above 0.
/// \cost Linear in the size of the files and the number of triangles, which is
///       at most 2^23.
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

/// Loads a glTF file; see read_gltf().
/// \throws std::runtime_error  as read_gltf(), or if the file cannot be read.
template <std::floating_point T = float>
[[nodiscard]] LoadedMeshT<T> load_gltf(const std::string& path,
                                       const MeshFileSettings& settings = {}) {
    return read_gltf<T>(load_file(path, detail::max_mesh_file), path, settings);
}

/// \}

} // namespace ljus
