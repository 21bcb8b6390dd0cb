/// \file tests/fuzz/exr.cpp
/// \brief OpenEXR files.

#include "ljus/io/exr.hpp"
#include "fuzz.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::MemoryFile file(data, size);
    fuzz::refused_or_done([&] {
        for (const ljus::Layer& layer : ljus::load_exr_layers(file.path()))
            ljus::check(layer.image);
    });
    fuzz::refused_or_done([&] { ljus::check(ljus::load_exr(file.path())); });
    return 0;
}
