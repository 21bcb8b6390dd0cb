// alone: compiles stb_image for itself
#include <doctest/doctest.h>

#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "ljus/io/png.hpp"
#include "scratch_folder.hpp"
#include "support/little_memory.hpp"

// The reader: another program part than the writer, from the same collection.
#if __has_include(<stb/stb_image.h>) || __has_include(<stb_image.h>)
#define HAS_STB_IMAGE
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#if __has_include(<stb/stb_image.h>)
#include <stb/stb_image.h>
#else
#include <stb_image.h>
#endif
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
#endif

namespace {

ljus::Image ramp(int width, int height) {
    ljus::Image image = ljus::make_image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            ljus::pixel(image, x, y) = {
                (static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                (static_cast<float>(y) + 0.5f) / static_cast<float>(height),
                static_cast<float>(x * y % 7) / 6.0f};
    return image;
}

} // namespace

TEST_CASE("png: the signature and the header's size, type and depth") {
    const ljus::Bytes file = ljus::encode_png(ramp(300, 2));
    const unsigned char head[] = {0x89, 'P',  'N', 'G', '\r', '\n', 0x1a, '\n', 0,
                                  0,    0,    13,  'I', 'H',  'D',  'R',  0,    0,
                                  1,    0x2c, 0,   0,   0,    2,    8,    2};
    REQUIRE(file.size() > sizeof(head));
    CHECK(std::memcmp(file.data(), head, sizeof(head)) == 0);
}

#ifdef HAS_STB_IMAGE
TEST_CASE("png: a reader finds each pixel's sRGB bytes where they belong") {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}, {33, 17}}) {
        const ljus::Image image = ramp(width, height);
        const ljus::Bytes file = ljus::encode_png(image, {.exposure = -0.5});
        int w = 0, h = 0, channels = 0;
        unsigned char* const bytes = stbi_load_from_memory(
            file.data(), static_cast<int>(file.size()), &w, &h, &channels, 3);
        REQUIRE(bytes != nullptr);
        CHECK(w == width);
        CHECK(h == height);
        CHECK(channels == 3);
        int wrong = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double light = static_cast<double>(image.pixels[i][c]);
                wrong += bytes[3 * i + static_cast<std::size_t>(c)] !=
                         ljus::srgb_byte(light * std::sqrt(0.5));
            }
        CHECK(wrong == 0);
        stbi_image_free(bytes);
    }
}

TEST_CASE("png: a bright lamp in one corner changes no other pixel") {
    ljus::Image image = ramp(20, 10);
    const auto bytes = [&] {
        int w = 0, h = 0, channels = 0;
        const ljus::Bytes file = ljus::encode_png(image);
        unsigned char* const read = stbi_load_from_memory(
            file.data(), static_cast<int>(file.size()), &w, &h, &channels, 3);
        REQUIRE(read != nullptr);
        const std::vector<unsigned char> all(read, read + 3 * w * h);
        stbi_image_free(read);
        return all;
    };
    const auto before = bytes();
    ljus::pixel(image, 19, 9) = ljus::Rgb{20.0f};
    const auto after = bytes();
    REQUIRE(before.size() == after.size());
    for (std::size_t i = 0; i + 3 < before.size(); ++i) CHECK(before[i] == after[i]);
    CHECK(after.back() == 255);
}

TEST_CASE("png: NaN and negatives are black, infinity is white, in double as well") {
    auto image = ljus::make_image<double>(1, 1);
    image.pixels[0] = {std::numeric_limits<double>::quiet_NaN(), -1.0,
                       std::numeric_limits<double>::infinity()};
    const ljus::Bytes file = ljus::encode_png(image);
    int w = 0, h = 0, channels = 0;
    unsigned char* const bytes = stbi_load_from_memory(
        file.data(), static_cast<int>(file.size()), &w, &h, &channels, 3);
    REQUIRE(bytes != nullptr);
    CHECK(int{bytes[0]} == 0);
    CHECK(int{bytes[1]} == 0);
    CHECK(int{bytes[2]} == 255);
    stbi_image_free(bytes);
}
#endif

TEST_CASE("png: the file is what encode_png returns; the same image, the same bytes") {
    const ScratchFolder folder;
    const ljus::Image image = ramp(20, 10);
    ljus::save_png(image, folder.file("a.png"));
    const ljus::Bytes bytes = ljus::encode_png(image);
    CHECK(ScratchFolder::read(folder.file("a.png")) ==
          std::string(bytes.begin(), bytes.end()));
    CHECK(folder.count() == 1);
}

TEST_CASE("png: an image or an exposure that makes no picture leaves the older file") {
    const ScratchFolder folder;
    ScratchFolder::write(folder.file("a.png"), "older");
    CHECK_THROWS_AS(ljus::save_png(ljus::Image{}, folder.file("a.png")),
                    std::invalid_argument);
    for (const double exposure : {std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::infinity()})
        CHECK_THROWS_AS(
            ljus::save_png(ramp(2, 2), folder.file("a.png"), {.exposure = exposure}),
            std::invalid_argument);
    CHECK(ScratchFolder::read(folder.file("a.png")) == "older");
    CHECK(folder.count() == 1);
}

#ifdef LJUS_TEST_LITTLE_MEMORY
TEST_CASE("png: an encoder without memory throws, wherever that ends") {
    ljus::Image image = ramp(600, 400);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] *= float(i * 2654435761u % 1000003u) / 1e6f; // noise
    const ljus::Bytes right = ljus::encode_png(image);
    CHECK(ljus_test::trouble_with_little_memory(
              65536, 1 << 23, [&] { return ljus::encode_png(image) == right; }) == "");
}
#endif

TEST_CASE("png: what the encoder has not freed is freed behind it, and nothing else") {
    using ljus::detail::StbMemory;
    const auto number = [](void* memory) { return static_cast<int*>(memory); };
    void* const outside = StbMemory::resize(nullptr, sizeof(int));
    *number(outside) = 7;
    {
        const StbMemory scope; // a leak is the sanitizer's to find
        void* grown = StbMemory::resize(nullptr, sizeof(int));
        (void)StbMemory::resize(nullptr, 100);
        *number(grown) = 8;
        grown = StbMemory::resize(grown, 1 << 20);
        CHECK(*number(grown) == 8);
        StbMemory::release(StbMemory::resize(nullptr, 10));
        StbMemory::release(nullptr);
    }
    CHECK(*number(outside) == 7);
    StbMemory::release(outside);
}
