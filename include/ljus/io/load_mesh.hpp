#pragma once

/// \file ljus/io/load_mesh.hpp
/// \brief Reads mesh files of all supported formats, also for scene files.

#include <nlohmann/json.hpp>

#include "ljus/io/load_gltf.hpp"
#include "ljus/io/load_obj.hpp"
#include "ljus/io/load_ply.hpp"
#include "ljus/io/load_stl.hpp"

namespace ljus {

/// \addtogroup load_obj
/// \{

/// Loads a mesh file. The extension of its name gives the format: .obj, .ply, .stl,
/// .gltf or .glb, in small or capital letters.
/// \return As load_obj(), load_ply(), load_stl() or load_gltf().
/// \throws std::runtime_error  as these functions do, or if the extension is unknown.
template <std::floating_point T = float>
[[nodiscard]] LoadedMeshT<T> load_mesh(const std::string& path,
                                       const MeshFileSettings& settings = {}) {
    const std::string end = path.substr(std::min(path.rfind('.'), path.size()));
    const auto is = [&](const char* known) { return detail::same_word(end, known); };
    if (is(".obj")) return load_obj<T>(path, settings);
    if (is(".ply")) return load_ply<T>(path, settings);
    if (is(".stl")) return load_stl<T>(path, settings);
    if (is(".gltf") || is(".glb")) return load_gltf<T>(path, settings);
    detail::refuse_file(
        path, "the name of a mesh file ends in .obj, .ply, .stl, .gltf or .glb");
}

/// Reads the mesh files that a scene file names: load_json("scene.json", MeshFiles{}).
/// If the scene file gives a mesh no material, the mesh has the materials of the mesh
/// file.
template <std::floating_point T>
struct MeshFilesT {
    std::string* report = nullptr; ///< Receives the problems of the files, one per
                                   ///< line; null: they are ignored.

    /// Reads a mesh file. Its lights are not used; the report says so.
    /// \throws std::runtime_error  as load_mesh().
    [[nodiscard]] LoadedMeshT<T> operator()(const std::string& path,
                                            const MeshFileSettings& settings) const {
        LoadedMeshT<T> loaded = load_mesh<T>(path, settings);
        if (settings.pictures &&
            !(loaded.points.empty() && loaded.spots.empty() && loaded.suns.empty()))
            loaded.report.notes.push_back(
                "its lights are not used; write them into the scene file.");
        const std::string text = to_text(loaded.report);
        if (report != nullptr && !text.empty())
            *report += shown_path(path) + ":\n" + text;
        return loaded;
    }
};
using MeshFiles = MeshFilesT<float>; ///< MeshFilesT in float.

/// \}

} // namespace ljus
