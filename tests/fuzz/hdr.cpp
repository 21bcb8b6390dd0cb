/// \file tests/fuzz/hdr.cpp
/// \brief Radiance files.

#include "ljus/io/hdr.hpp"
#include "fuzz.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::MemoryFile file(data, size);
    fuzz::refused_or_done([&] {
        const ljus::Image image = ljus::load_hdr(file.path());
        for (const ljus::Rgb& c : image.pixels)
            fuzz::require_that(ljus::is_finite(c) && c.x >= 0 && c.y >= 0 && c.z >= 0,
                               "a pixel is finite and at least 0");
    });
    return 0;
}
