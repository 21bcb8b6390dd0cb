#pragma once

/// \file ljus/io/detail/mesh_pictures.hpp
/// \brief The pictures of the materials of a mesh file.

#include <algorithm>

#include "ljus/io/load_image.hpp"
#include "ljus/io/mesh_file.hpp"

namespace ljus::detail {

// Loads a picture of a material, unless it is already loaded. bytes_of(name) returns
// the bytes of its file. The picture is kept under its name with `kind` appended,
// because one file may hold both colours and alpha.
template <std::floating_point T, typename BytesOf>
void load_picture(MeshImage& picture, PictureContent content, std::string_view kind,
                  LoadedMeshT<T>& loaded, long long& pixels, const BytesOf& bytes_of) {
    if (picture.name.empty()) return;
    const std::string name = picture.name;
    picture.name += kind;
    if (loaded.pictures.contains(picture.name)) return;
    try {
        const ImageT<T>& image = loaded.pictures[picture.name] =
            decode_image<T>(bytes_of(name), name, pixels, content);
        pixels += static_cast<long long>(image.pixels.size());
    } catch (const std::runtime_error& wrong) {
        std::string why = (picture.at + ": ").append(wrong.what());
        auto& notes = loaded.report.notes; // materials may share a picture
        if (std::find(notes.begin(), notes.end(), why) == notes.end())
            notes.push_back(std::move(why));
    }
}

// Loads all pictures of a material.
template <std::floating_point T, typename BytesOf>
void load_pictures(MeshMaterial& material, LoadedMeshT<T>& loaded, long long& pixels,
                   const BytesOf& bytes_of) {
    const auto load = [&](MeshImage& picture, PictureContent content,
                          std::string_view kind) {
        load_picture(picture, content, kind, loaded, pixels, bytes_of);
    };
    load(material.picture, PictureContent::colors, "");
    load(material.mask,
         material.mask_is_alpha ? PictureContent::alpha : PictureContent::mask,
         " (alpha)");
    load(material.normals, PictureContent::numbers, " (normals)");
}

} // namespace ljus::detail
