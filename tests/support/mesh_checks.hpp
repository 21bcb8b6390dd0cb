#pragma once

/// \file tests/support/mesh_checks.hpp
/// \brief Checks that a mesh is read as it was written.

#include <doctest/doctest.h>

#include "ljus/io/mesh_file.hpp"
#include "support/mesh_bytes.hpp"

namespace ljus_test {

/// Checks that a closed mesh was read completely and without a problem in the report.
/// \return The mesh.
inline const ljus::Mesh& check_whole(const ljus::LoadedMesh& loaded,
                                     const MeshData& data) {
    CHECK(to_text(loaded.report).empty());
    CHECK(loaded.report.content.closed);
    const ljus::Mesh& mesh = loaded.parts.at(0).mesh;
    REQUIRE(mesh.size() == data.triangles.size());
    CHECK(mesh.data().positions.size() == data.positions.size());
    CHECK(double(area(mesh)) == doctest::Approx(area_of(data)).epsilon(1e-6));
    CHECK(mesh.triangle(7).v2 == data.positions[data.triangles[7][1]]);
    return mesh;
}

/// Checks the normal at a corner of a mesh.
inline void check_normal(const ljus::Mesh& mesh, const MeshData& data) {
    const auto& normals = mesh.data().normals;
    REQUIRE(normals.size() == data.normals.size());
    CHECK(glm::dot(normals[mesh.data().triangles[7][1]],
                   data.normals[data.triangles[7][1]]) == doctest::Approx(1));
}

} // namespace ljus_test
