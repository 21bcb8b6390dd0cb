/// \file tests/fuzz/corpus.cpp
/// \brief Makes the small files that the fuzzers of binary formats begin with.
///
///     corpus FOLDER       FOLDER/png/..., FOLDER/pfm/..., ...

#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <string>

#include "ljus/io/hdr.hpp"
#include "ljus/io/light_map_file.hpp"
#include "ljus/io/pfm.hpp"
#include "ljus/io/photon_map_file.hpp"
#include "ljus/io/png.hpp"
#include "ljus/radiosity/radiosity.hpp"
#include "ljus/scenes/cornell_box.hpp"
#include "ljus/scenes/mesh_formulas.hpp"
#include "support/jpeg_segment.hpp"
#include "support/mesh_bytes.hpp"

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    using namespace ljus;
    const std::filesystem::path folder = argv[1];
    const auto file = [&](const char* kind, const std::string& name) {
        std::filesystem::create_directories(folder / kind);
        return (folder / kind / name).string();
    };

    Image image = make_image<float>(9, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 9; ++x)
            pixel(image, x, y) = Rgb{float(x) / 8, float(y) / 2, 0.5f};
    save_pfm(image, file("pfm", "color.pfm"));
    save_file(file("pfm", "grey.pfm"), {'P', 'f', '\n', '1', ' ', '1', '\n', '1', '.',
                                        '0', '\n', 63, 128, 0, 0});
    save_hdr(image, file("hdr", "plain.hdr"));
    // Nine pixels in runs: of one byte, and of several.
    const std::string runs = "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n"
                             "-Y 1 +X 9\n\x02\x02";
    Bytes coded(runs.begin(), runs.end());
    for (const int byte :
         {0, 9, 137, 128, 2, 1, 2, 135, 7, 9, 1, 2, 3, 4, 5, 6, 7, 8, 9, 137, 129})
        coded.push_back(static_cast<unsigned char>(byte));
    save_file(file("hdr", "runs.hdr"), coded);

    save_png(image, file("png", "color.png"));
    Bytes screen;
    for (int i = 0; i < 9 * 3 * 4; ++i) screen.push_back(static_cast<unsigned char>(i));
    for (const int channels : {1, 2, 4}) {
        const std::string name = file("png", std::to_string(channels) + ".png");
        stbi_write_png(name.c_str(), 9, 3, channels, screen.data(), 9 * channels);
    }
    stbi_write_bmp(file("png", "3.bmp").c_str(), 9, 3, 3, screen.data());
    stbi_write_jpg(file("png", "50.jpg").c_str(), 9, 3, 3, screen.data(), 50);
    stbi_write_jpg(file("png", "95.jpg").c_str(), 9, 3, 3, screen.data(), 95);

    // A JPEG file whose bits run out in the middle of a number: its codes have 9 and 10
    // bits, and 7 and 15 bits follow them, but there are only 32.
    Bytes jpeg{0xff, 0xd8};
    ljus_test::add_jpeg_segment(jpeg, 0xdb, {0});
    jpeg[5] = 67; // 64 more, the units
    jpeg.insert(jpeg.end(), 64, 1);
    ljus_test::add_jpeg_segment(
        jpeg, 0xc0, {8, 0, 8, 0, 8, 1, 1, 0x11, 0}); // 8 x 8 pixels of one channel
    ljus_test::add_jpeg_segment(
        jpeg, 0xc4, {0x00, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 7});
    ljus_test::add_jpeg_segment(
        jpeg, 0xc4, {0x10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 15});
    ljus_test::add_jpeg_segment(jpeg, 0xda, {1, 1, 0, 0, 63, 0});
    jpeg.insert(jpeg.end(), {0, 0, 0, 0, 0xff, 0xd9});
    save_file(file("png", "short.jpg"), jpeg);

    for (const char* name : {"b44a", "dwaa", "grey", "none", "parts", "piz", "pxr24",
                             "rle", "tiled", "zips"})
        save_file(file("exr", name),
                  load_file(std::string(LJUS_TEST_INPUTS "/exr/") + name + ".exr",
                            std::size_t(1) << 20));

    const MeshData ball = icosphere(Sphere{.center{0, 0, 0}, .radius = 1}, 0);
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
        save_file(file("ply", format), ljus_test::ply_bytes(ball, format));
    save_file(file("stl", "text.stl"), ljus_test::stl_bytes(ball, true));
    save_file(file("stl", "bytes.stl"), ljus_test::stl_bytes(ball, false));

    const auto room = cornell_box();
    LightMap light = make_radiosity(room.world, {.patches = {.size = 2}})->map;
    save_light_map(file("light_map", "room.light"), light);
    save_light_map(file("light_map", "none.light"), {});

    // Without what is between the header and the arrays: see photon_map.cpp.
    for (const int count : {0, 5, 40, 70}) {
        std::vector<Photon> photons;
        for (int i = 0; i < count; ++i)
            photons.push_back({.position{float(i % 7), 0, float(i % 5)},
                               .direction{0, i % 3 ? -1.0f : 1.0f, 0},
                               .flux = Rgb{1},
                               .kind = PhotonKind(i % 3),
                               .normal = small_normal(Vec3{0, 1, 0})});
        const PhotonMap map = make_photon_map(photons);
        Bytes bytes = file_front(ljus::detail::photon_map_format,
                                 static_cast<std::uint32_t>(count), std::uint64_t(0));
        for (const auto& array : ljus::detail::arrays_of(map))
            bytes.insert(bytes.end(), array.begin(), array.end());
        save_file(file("photon_map", std::to_string(count)), bytes);
    }
    return 0;
}
