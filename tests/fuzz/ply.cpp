/// \file tests/fuzz/ply.cpp
/// \brief PLY files.

#include "fuzz_mesh.hpp"

#include "ljus/io/load_ply.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::read_mesh([&](const ljus::MeshFileSettings& settings) {
        return ljus::read_ply({data, data + size}, "fuzz.ply", settings);
    });
    return 0;
}
