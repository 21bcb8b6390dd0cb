#pragma once

/// \file ljus/io/detail/mesh_pictures.hpp
/// \brief The pictures of the materials of a mesh file.

#include "ljus/io/load_image.hpp"
#include "ljus/io/mesh_file.hpp"

namespace ljus::detail {

// Loads the picture of a material, unless it has none or it is loaded already;
// bytes_of(name) are those of its file. The pixels of all materials so far are limited,
// because add_meshes() copies each picture.
template <std::floating_point T, typename BytesOf>
void load_picture(MeshMaterial& material, LoadedMeshT<T>& loaded, long long& pixels,
                  const BytesOf& bytes_of) {
    const std::string name = material.picture;
    if (name.empty()) return;
    try {
        auto known = loaded.pictures.find(name);
        if (known == loaded.pictures.end())
            known = loaded.pictures
                        .emplace(name, decode_image<T>(bytes_of(name), name, pixels))
                        .first;
        const ImageT<T>& image = known->second;
        const std::string why = too_large_beside(pixels, image.width, image.height);
        if (!why.empty()) {
            material.picture.clear();
            throw std::runtime_error(join({shown_path(name), " ", why, "."}));
        }
        pixels += static_cast<long long>(image.pixels.size());
    } catch (const std::runtime_error& wrong) {
        loaded.report.notes.push_back(
            (material.picture_at + ": ").append(wrong.what()));
    }
}

} // namespace ljus::detail
