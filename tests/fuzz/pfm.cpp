/// \file tests/fuzz/pfm.cpp
/// \brief PFM files.

#include "ljus/io/pfm.hpp"
#include "fuzz.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::MemoryFile file(data, size);
    fuzz::refused_or_done([&] {
        const ljus::Image image = ljus::load_pfm(file.path());
        fuzz::require_that(image.pixels.size() * 4 <= size, "no pixel is made up");
    });
    return 0;
}
