/// \file tests/fuzz/png.cpp
/// \brief Pictures: PNG, JPEG and BMP; of PNG the same with its sums put right.

#include "fuzz.hpp"
#include "ljus/io/load_image.hpp"

namespace {

/// Each chunk of a PNG file gets its sum, which no fuzzer would find.
ljus::Bytes with_sums(ljus::Bytes file) {
    for (std::size_t at = 8; at + 12 <= file.size();) {
        const std::size_t size = ljus::detail::png_number(file, at);
        if (size > file.size() - at - 12) break;
        const auto sum = ljus::detail::png_sum(file, at + 4, at + 8 + size);
        for (std::size_t i = 0; i < 4; ++i)
            file[at + 8 + size + i] = static_cast<unsigned char>(sum >> (24 - 8 * i));
        at += 12 + size;
    }
    return file;
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const ljus::Bytes bytes(data, data + size);
    const auto decode = [](const ljus::Bytes& file) {
        fuzz::refused_or_done([&] {
            const ljus::Image image = ljus::decode_image(file, "fuzz.png");
            for (const ljus::Rgb& c : image.pixels)
                for (const float channel : {c.x, c.y, c.z})
                    fuzz::require_that(channel >= 0 && channel <= 1,
                                       "a channel is within [0, 1]");
        });
    };
    decode(bytes);
    if (size > 8 && data[0] == 0x89) decode(with_sums(bytes));
    return 0;
}
