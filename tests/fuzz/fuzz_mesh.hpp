#pragma once

/// \file tests/fuzz/fuzz_mesh.hpp
/// \brief What must hold for the meshes of every format.

#include <cmath>

#include "fuzz.hpp"

#include "ljus/io/mesh_file.hpp"

namespace fuzz {

/// Reads a mesh file by read(settings), and adds what it has to a scene.
template <typename Read>
void read_mesh(Read read) {
    using namespace ljus;
    refused_or_done([&] {
        const LoadedMesh loaded =
            read(MeshFileSettings{.normals = MeshNormals::smooth});
        for (const auto& part : loaded.parts) {
            const Ray ray{.origin{0.1f, 0.2f, 9}, .direction{0, 0, -1}};
            const auto hit = intersect(ray, part.mesh);
            require_that(!hit || hit->part < part.mesh.size(), "a hit is a part");
            require_that(std::isfinite(area(part.mesh)), "an area is finite");
        }
        for (const std::string& note : loaded.report.notes) require_sentence(note);
        Scene<Shapes<Mesh>, Materials<Lambertian, Glass, Mirror, Glossy, MeshPicture>,
              Lights<PointLight, SpotLight, SunLight>>
            scene;
        add_meshes(scene, loaded);
    });
}

} // namespace fuzz
