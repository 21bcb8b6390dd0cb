/// \file tests/fuzz/stl.cpp
/// \brief STL files.

#include "fuzz_mesh.hpp"

#include "ljus/io/load_stl.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::read_mesh([&](const ljus::MeshFileSettings& settings) {
        return ljus::read_stl({data, data + size}, "fuzz.stl", settings);
    });
    return 0;
}
