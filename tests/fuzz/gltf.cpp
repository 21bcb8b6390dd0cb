/// \file tests/fuzz/gltf.cpp
/// \brief glTF files, with and without bytes behind their JSON.

#include "fuzz_mesh.hpp"

#include "ljus/io/load_gltf.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::read_mesh([&](const ljus::MeshFileSettings& settings) {
        return ljus::read_gltf({data, data + size}, "fuzz.gltf", settings);
    });
    return 0;
}
