/// \file tests/fuzz/light_map.cpp
/// \brief Light maps in files, drawn if a room takes them; with
/// key and checksum put right.

#include <algorithm>

#include "fuzz.hpp"
#include "ljus/io/light_map_file.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scenes/cornell_box.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto room = ljus::cornell_box();
    ljus::Bytes bytes(data, data + size);
    const auto load = [](const ljus::Bytes& file) {
        const fuzz::MemoryFile in_memory(file);
        fuzz::refused_or_done([&] {
            auto map = ljus::load_light_map(in_memory.path(), {}, 10'000);
            map.key.scene = ljus::detail::scene_hash(room.world); // drawn all the same
            const ljus::LightMapView view(room.world, map);
            const auto picture =
                ljus::render(view, room.camera,
                             {.width = 4, .height = 4, .samples = 1, .threads = 1});
            for (const ljus::Rgb& c : picture.image.pixels)
                fuzz::require_that(ljus::is_finite(c), "a pixel is finite");
        });
    };
    load(bytes);
    if (size < ljus::file_front_bytes + ljus::detail::key_bytes) return 0;
    std::fill_n(bytes.begin() + 24, 8, std::uint8_t(0)); // the scene
    std::fill_n(bytes.begin() + 40, ljus::detail::key_bytes, std::uint8_t(0));
    ljus::put_checksum(bytes);
    load(bytes);
    return 0;
}
