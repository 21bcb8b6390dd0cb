// alone: compiles stb_image for itself
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "ljus/io/hdr.hpp"
#include "scratch_folder.hpp"
#include "support/refusal.hpp"

// A second opinion: the reader and the writer of the stb collection.
#if (__has_include(<stb/stb_image.h>) && __has_include(<stb/stb_image_write.h>)) || \
    (__has_include(<stb_image.h>) && __has_include(<stb_image_write.h>))
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
#define STBI_ONLY_HDR
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#if __has_include(<stb/stb_image.h>)
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#else
#include <stb_image.h>
#include <stb_image_write.h>
#endif
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
#endif

namespace {

ljus::Image noise(int width, int height) {
    ljus::Image image = ljus::make_image(width, height);
    std::uint32_t state = 5;
    const auto random = [&state] {
        state = state * 1664525u + 1013904223u;
        return std::ldexp(static_cast<float>(state >> 8), -24);
    };
    for (ljus::Rgb& c : image.pixels) {
        const float size = std::exp2(60.0f * random() - 30.0f);
        c = {size * random(), size * random(), size * random()};
        if (random() < 0.2f) c = {size, size, size};
    }
    return image;
}

// The largest error of a channel, in units of its pixel's largest channel.
double largest_error(const ljus::Image& a, const ljus::Image& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            largest = std::max(
                largest,
                std::abs(static_cast<double>(a.pixels[i][c] - b.pixels[i][c])) /
                    static_cast<double>(ljus::max_component(a.pixels[i])));
    return largest;
}

std::string message_of_load(const std::string& path) {
    return ljus_test::why_not_read(path, [&] { (void)ljus::load_hdr(path); });
}

} // namespace

TEST_CASE("hdr: four bytes hold a colour within 1/256 of its largest channel") {
    for (int exponent = -120; exponent <= 126; ++exponent)
        for (int i = 1; i <= 64; ++i) {
            const double largest = std::ldexp(0.5 + i / 128.0 - 1e-9, exponent);
            const ljus::RgbT<double> c{largest, 0.3 * largest, 0.0};
            const ljus::RgbT<double> back =
                ljus::detail::from_rgbe(ljus::detail::to_rgbe(c));
            CHECK(std::abs(back.x - c.x) <= largest / 256 * (1 + 1e-12));
            CHECK(std::abs(back.y - c.y) <= largest / 256 * (1 + 1e-12));
            CHECK(back.z == 0.0);
        }
}

TEST_CASE("hdr: known colours have the bytes of the format") {
    using Rgbe = std::array<unsigned char, 4>;
    CHECK(ljus::detail::to_rgbe({1, 0.5, 0.25}) == Rgbe{128, 64, 32, 129});
    CHECK(ljus::detail::to_rgbe({0, 0, 0}) == Rgbe{0, 0, 0, 0});
    CHECK(ljus::detail::to_rgbe({0.5, 0, 0}) == Rgbe{128, 0, 0, 128});
    CHECK(ljus::detail::to_rgbe({0.9999, 0, 0}) ==
          Rgbe{128, 0, 0, 129}); // 256 does not fit
    CHECK(ljus::detail::to_rgbe({1e-300, 0, 0}) == Rgbe{0, 0, 0, 0});
    CHECK(ljus::detail::to_rgbe({1.69e38, 0, 0})[3] == 255);
    CHECK(ljus::detail::from_rgbe({128, 64, 32, 129}) ==
          ljus::RgbT<double>{1, 0.5, 0.25});
}

TEST_CASE("hdr: rounding has no preferred direction") {
    double sum = 0.0;
    for (int i = 0; i < 100000; ++i) {
        const double x = 0.5 + (i + 0.5) / 200000.0;
        sum += ljus::detail::from_rgbe(ljus::detail::to_rgbe({x, x, x})).x - x;
    }
    CHECK(std::abs(sum / 100000) < 1e-5); // rounding down would give -0.002
}

TEST_CASE("hdr: what is saved is what is loaded") {
    const ScratchFolder folder;
    for (const auto& [width, height] :
         {std::pair{1, 1}, {1, 9}, {7, 3}, {8, 3}, {300, 2}}) {
        const ljus::Image image = noise(width, height);
        ljus::save_hdr(image, folder.file("a.hdr"));
        const ljus::Image loaded = ljus::load_hdr(folder.file("a.hdr"));
        REQUIRE(loaded.width == width);
        REQUIRE(loaded.height == height);
        CHECK(largest_error(image, loaded) <= 1.0 / 256 * (1 + 1e-6));
        // What has been rounded once stays the same.
        ljus::save_hdr(loaded, folder.file("b.hdr"));
        CHECK(ScratchFolder::read(folder.file("a.hdr")) ==
              ScratchFolder::read(folder.file("b.hdr")));
        CHECK(folder.count() == 2);
    }
}

#ifdef HAS_STB_IMAGE
TEST_CASE("hdr: another reader sees the same image") {
    const ScratchFolder folder;
    for (const int width : {3, 8, 200}) {
        const ljus::Image image = noise(width, 5);
        ljus::save_hdr(image, folder.file("a.hdr"));
        const ljus::Image loaded = ljus::load_hdr(folder.file("a.hdr"));
        int w = 0, h = 0, channels = 0;
        float* const other =
            stbi_loadf(folder.file("a.hdr").c_str(), &w, &h, &channels, 3);
        REQUIRE(other != nullptr);
        CHECK(w == width);
        CHECK(h == 5);
        int wrong = 0;
        for (std::size_t i = 0; i < loaded.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                wrong +=
                    other[3 * i + static_cast<std::size_t>(c)] != loaded.pixels[i][c];
        CHECK(wrong == 0);
        stbi_image_free(other);
    }
}

TEST_CASE("hdr: the ends of what the format holds, and a pixel beyond them by place") {
    // Below 2^-128 there is no exponent left: black, and not the largest one.
    for (int e = -126; e >= -140; --e) {
        const auto rgbe = ljus::detail::to_rgbe({std::ldexp(0.75, e), 0, 0});
        CHECK(int(rgbe[3]) == (e >= -127 ? e + 128 : 0));
        CHECK(int(rgbe[0]) == (e >= -127 ? 192 : 0));
    }
    const ScratchFolder folder;
    auto image = ljus::make_image<double>(3, 2);
    pixel(image, 2, 1) = {0, 1.68e38, 0};
    CHECK_NOTHROW(ljus::save_hdr(image, folder.file("a.hdr")));
    // The limit itself is beyond it, the number before it is not.
    pixel(image, 2, 1) = {0, std::nextafter(1.69e38, 0), 0};
    CHECK_NOTHROW(ljus::save_hdr(image, folder.file("a.hdr")));
    pixel(image, 2, 1) = {0, 1.69e38, 0};
    CHECK_THROWS_AS(ljus::save_hdr(image, folder.file("b.hdr")), std::invalid_argument);
    pixel(image, 2, 1) = {0, 2e38, 0};
    CHECK_THROWS_WITH_AS(ljus::save_hdr(image, folder.file("b.hdr")),
                         doctest::Contains("Pixel (2, 1) has a channel of 19999"),
                         std::invalid_argument);
    pixel(image, 2, 1) = {0, 0, -0.5};
    CHECK_THROWS_WITH_AS(ljus::save_hdr(image, folder.file("b.hdr")),
                         doctest::Contains("Pixel (2, 1) has a channel of -0.5"),
                         std::invalid_argument);
}

TEST_CASE("hdr: the run-length coded file of another writer is read") {
    const ScratchFolder folder;
    for (const int width : {7, 8, 500}) {
        ljus::Image image = noise(width, 4);
        for (int x = 0; x < width; ++x) ljus::pixel(image, x, 1) = {3, 2, 1};
        REQUIRE(stbi_write_hdr(folder.file("a.hdr").c_str(), width, 4, 3,
                               &image.pixels[0].x) != 0);
        const ljus::Image loaded = ljus::load_hdr(folder.file("a.hdr"));
        CHECK(largest_error(image, loaded) <= 1.0 / 128 * (1 + 1e-6)); // it rounds down
        CHECK(ljus::pixel(loaded, width - 1, 1) == ljus::Rgb{3, 2, 1});
    }
}

TEST_CASE("hdr: no truncated or damaged coded file does harm") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.hdr");
    ljus::Image image = noise(40, 3);
    for (int x = 0; x < 40; ++x) ljus::pixel(image, x, 1) = {3, 2, 1};
    REQUIRE(stbi_write_hdr(path.c_str(), 40, 3, 3, &image.pixels[0].x) != 0);
    const std::string whole = ScratchFolder::read(path);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        ScratchFolder::write(path, whole.substr(0, size));
        CHECK(message_of_load(path) != "loaded");
    }
    std::uint32_t state = 1;
    for (int i = 0; i < 300; ++i) {
        std::string damaged = whole;
        state = state * 1664525u + 1013904223u;
        const std::size_t at = (state >> 8) % whole.size();
        damaged[at] = static_cast<char>(state >> 24);
        ScratchFolder::write(path, damaged);
        (void)message_of_load(path); // any answer but a crash
    }
}
#endif

TEST_CASE(
    "hdr: a channel that four bytes cannot hold is refused, the older file stays") {
    const ScratchFolder folder;
    ScratchFolder::write(folder.file("a.hdr"), "older");
    using Limits = std::numeric_limits<float>;
    for (const float bad :
         {Limits::quiet_NaN(), Limits::infinity(), -1.0f, Limits::max()}) {
        ljus::Image image = ljus::make_image(2, 2);
        ljus::pixel(image, 1, 0).y = bad;
        CHECK_THROWS_AS(ljus::save_hdr(image, folder.file("a.hdr")),
                        std::invalid_argument);
    }
    CHECK_THROWS_AS(ljus::save_hdr(ljus::Image{}, folder.file("a.hdr")),
                    std::invalid_argument);
    CHECK(ScratchFolder::read(folder.file("a.hdr")) == "older");
    CHECK(folder.count() == 1);
}

TEST_CASE("hdr: the exposure of the header is taken out again") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.hdr");
    ScratchFolder::write(path,
                         "#?RADIANCE\n# a comment\nEXPOSURE= 2.0\nEXPOSURE=4e0\r\n"
                         "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x81");
    CHECK(ljus::load_hdr(path).pixels[0] == ljus::Rgb{0.125f, 0.0625f, 0.03125f});
    // 0 stands for unknown.
    ScratchFolder::write(path, "#?RADIANCE\nEXPOSURE=2\nGAMMA=1\nEXPOSURE=0\n\n"
                               "-Y 1 +X 1\n\x80\x40\x20\x81");
    CHECK(ljus::load_hdr(path).pixels[0] == ljus::Rgb{0.5f, 0.25f, 0.125f});
    // Light without end is refused, and not loaded as infinity.
    for (const char* exposure : {"1e-300", "1e-38\nEXPOSURE=1e-2"}) {
        ScratchFolder::write(path, std::string("#?RADIANCE\nEXPOSURE=") + exposure +
                                       "\n\n-Y 1 +X 1\n\x80\x40\x20\x88");
        CHECK(message_of_load(path) ==
              "a pixel divided by its exposure is not finite.");
    }
}

TEST_CASE("hdr: the colour correction of the header is taken out, colours of other "
          "primaries become those of sRGB") {
    // Two lines, 2 4 0.5 and 1 1 2, over (1, 0.5, 0.25).
    const std::string folder = LJUS_TEST_INPUTS "/";
    CHECK(ljus::load_hdr(folder + "colorcorr.hdr").pixels[1] ==
          ljus::Rgb{0.5f, 0.125f, 0.25f});
    CHECK(message_of_load(folder + "primaries.hdr")
              .starts_with("its header says GAMMA="));
    const ScratchFolder scratch;
    const std::string path = scratch.file("a.hdr");
    const auto message = [&](const std::string& line) {
        ScratchFolder::write(path,
                             "#?RADIANCE\n" + line + "\n\n-Y 1 +X 1\n\x80\x40\x20\x81");
        return message_of_load(path);
    };
    CHECK(message("PRIMARIES= .640 .330 .290 .600 .150 .060 .333 .333") == "loaded");
    CHECK(ljus::load_hdr(path).pixels[0] == ljus::Rgb{1.0f, 0.5f, 0.25f});
    // Those of Rec. 2020, as Little CMS 2.14 converts (1, 0.5, 0.25).
    CHECK(message("PRIMARIES=.708 .292 .17 .797 .131 .046 .3127 .329") == "loaded");
    CHECK(glm::distance(ljus::load_hdr(path).pixels[0],
                        ljus::Rgb{1.34846f, 0.43981f, 0.21124f}) < 1e-4f);
    CHECK(message("PRIMARIES=.708 .292 .708 .292 .708 .292 .3127 .329") != "loaded");
    CHECK(message("PRIMARIES= .640 .330 .290 .600") != "loaded");
    CHECK(message("PRIMARIES=0 0 0 0 0 0 0 0") == "loaded"); // stands for unknown
    CHECK(message("PRIMARIES=0 0 0 0") != "loaded");
    CHECK(message("FORMAT= 32-bit_rle_rgbe\t ") == "loaded");
    CHECK(message("GAMMA=1.0") == "loaded");
    CHECK(message("GAMMA=2.2") == "its header says GAMMA=2.2; only radiance is "
                                  "supported, with a gamma of 1.");
    for (const char* const bad :
         {"COLORCORR=1 1", "COLORCORR=1 1 1 1", "COLORCORR=1 0 1", "COLORCORR=1 x 1"})
        CHECK(message(bad) == std::string("its header says ") + bad +
                                  ", which is not three numbers above 0.");
}

TEST_CASE("hdr: pixels in XYZE become radiance at 179 lm/W, by Radiance's primaries") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.hdr");
    // White, a colour within the gamut, and one outside of it. The second is
    // (1, 0.5, 0.25) by the columns of the primaries, but for the rounding to bytes.
    ScratchFolder::write(path, "#?RADIANCE\nPRIMARIES=.7 .3 .2 .7 .1 .1 .33 .33\n"
                               "EXPOSURE=2\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 3\n"
                               "\xb3\xb3\xb3\x89\x80\x6e\x35\x89" +
                                   std::string("\0\xb3\0\x88", 4));
    const ljus::Image image = ljus::load_hdr(path);
    CHECK(glm::distance(image.pixels[0], ljus::Rgb{1}) < 1e-6f);
    CHECK(glm::distance(image.pixels[1], ljus::Rgb{0.99937f, 0.49779f, 0.24717f}) <
          1e-5f);
    CHECK(glm::distance(image.pixels[2], ljus::Rgb{0, 0.98914f, 0}) < 1e-5f);
}

TEST_CASE("hdr: a truncated, longer or foreign file is refused in a sentence") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.hdr");
    ljus::save_hdr(noise(3, 2), path);
    const std::string whole = ScratchFolder::read(path);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        ScratchFolder::write(path, whole.substr(0, size));
        CHECK(message_of_load(path) != "loaded");
    }
    ScratchFolder::write(path, whole + "abc");
    CHECK(message_of_load(path) == "it has 3 bytes more than its pixels require.");
    CHECK(message_of_load(folder.file("b.hdr")) == "No such file or directory.");

    const std::string start = "#?RADIANCE\n";
    for (const std::string& header :
         {std::string("PF\n3 2\n-1.0\n"), std::string("\n\n"),
          start + "FORMAT=32-bit_rle_luv\n\n-Y 2 +X 3\n",
          start + "EXPOSURE=-1\n\n-Y 2 +X 3\n", start + "EXPOSURE=nan\n\n-Y 2 +X 3\n",
          start + "EXPOSURE=\n\n-Y 2 +X 3\n", start + "\n+Y 2 -X 3\n",
          start + "\n+X 3 -Y 2\n", start + "\n-Y 0 +X 3\n", start + "\n-Y -2 +X 3\n",
          start + "\n-Y 268435456 +X 268435456\n", start + "\n-Y 268435456 +X 1\n",
          start + "\n-Y 1 +X 268435456\n", start + "\n-Y 2 +X 3\n\1\1\1\1"}) {
        CAPTURE(header);
        ScratchFolder::write(path, header + std::string(24, '\x40'));
        CHECK(message_of_load(path) != "loaded");
    }
}

TEST_CASE("hdr: rows from the bottom are those from the top, the last one first") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.hdr"), start = "#?RADIANCE\n\n";
    for (const int height : {1, 2, 3, 4}) {
        std::string down, up;
        for (int y = 0; y < height; ++y) {
            const std::string row{char(60 + y), '\x20',  '\x10', '\x80',
                                  '\x11',       char(y), '\x50', '\x81'};
            down += row;
            up = row + up;
        }
        const std::string size = std::to_string(height) + " +X 2\n";
        ScratchFolder::write(path, start + "-Y " + size + down);
        const auto pixels = ljus::load_hdr(path).pixels;
        ScratchFolder::write(path, start + "+Y " + size + up);
        CHECK(ljus::load_hdr(path).pixels == pixels);
    }
}

TEST_CASE("hdr: what is wrong with a header or a row is said, word by word") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.hdr");
    const auto message = [&](const std::string& text) {
        ScratchFolder::write(path, text);
        return message_of_load(path);
    };
    const std::string start = "#?RADIANCE\n", row(12, '\x40');
    const std::string only = "; only -Y +X and +Y +X are supported.";
    CHECK(message(start + "\n-Y 1 +X 3\n" + row) == "loaded");
    CHECK(message(start + "\n-Y 1 +X\t3 \t\n" + row) == "loaded");
    CHECK(message(start + "\n+Y 1 -X 3\n" + row) == "its rows go +Y -X" + only);
    CHECK(message(start + "\n-Y 1 -X 3\n" + row) == "its rows go -Y -X" + only);
    CHECK(message(start + "\n+X 1 -Y 3\n" + row) == "its rows go +X -Y" + only);
    CHECK(message(start + "FORMAT= 32-bit_rle_rgbe\n\n-Y 1 +X 3\n" + row) == "loaded");
    for (const char* const format : {"foo32-bit_rle_rgbe", "32-bit_rle_rgbe foo", ""})
        CHECK(message(start + "FORMAT=" + format + "\n\n-Y 1 +X 3\n" + row)
                  .find("it must be 32-bit_rle_rgbe or 32-bit_rle_xyze") !=
              std::string::npos);
    for (const char* const exposure : {"-1", "1e999", "nan"})
        CHECK(message(start + "EXPOSURE=" + exposure + "\n\n-Y 1 +X 3\n" + row)
                  .find("which is not a number above 0") != std::string::npos);
    CHECK(message(start + "\n-Y 30000 +X 20000\n" + row) ==
          "it has 20000 x 30000 pixels; there can be at most 268435456.");
    CHECK(message(start + "\n-Y 2 +X 3\n" + row) == "its last row is incomplete.");
    CHECK(message(start + "\n-Y 1 +X 3\n" + row.substr(1)) ==
          "its last row is incomplete.");
    CHECK(message(start + "\n-Y 1 +X 3\n\1\1\1" + row.substr(3)) ==
          "a run of its repeated pixels leaves its row or repeats none.");
    // A coded row of 8 that says 9, or whose first run is empty or too long, with good
    // ones behind it.
    const std::string coded = start + "\n-Y 1 +X 8\n\2\2";
    const auto bytes = [](std::initializer_list<int> values) {
        std::string text;
        for (const int value : values) text += static_cast<char>(value);
        return text;
    };
    std::string good = bytes({0, 8});
    for (int part = 0; part < 4; ++part) good += bytes({128 + 8, 100 + part});
    CHECK(message(coded + good) == "loaded");
    CHECK(message(coded + bytes({0, 9}) + good.substr(2)) ==
          "a row declares another width than the header.");
    for (const int run : {0, 9, 128, 128 + 9})
        CHECK(message(coded + bytes({0, 8, run}) + good.substr(2)) ==
              "a run of its coded pixels is empty or leaves its row.");
    // The second run of a row ends with it, and no later.
    for (const int run : {4, 128 + 4, 8, 128 + 8})
        CHECK(message(coded + bytes({0, 8, 128 + 5, 7, run}) + good + good) ==
              "a run of its coded pixels is empty or leaves its row.");
    CHECK(message(coded + bytes({0, 8, 3, 1, 2, 3, 128 + 5, 9}) + good.substr(4)) ==
          "loaded");
    const auto image = ljus::load_hdr(path);
    CHECK(image.pixels[2].x == 3 * std::ldexp(1.0f, 103 - 136));
    CHECK(image.pixels[3].x == 9 * std::ldexp(1.0f, 103 - 136));
    CHECK(image.pixels[7].z == 102 * std::ldexp(1.0f, 103 - 136));
}

TEST_CASE("hdr: the coding from before 1991 repeats the pixel before") {
    const ljus::Image seven = ljus::load_hdr(LJUS_TEST_INPUTS "/old_runs.hdr");
    CHECK(seven.pixels == std::vector<ljus::Rgb>(8, ljus::Rgb{1, 0.5f, 0.25f}));
    // 0x12a repeats in two bytes, another pixel, and two repeats of that one.
    const ScratchFolder folder;
    const std::string path = folder.file("a.hdr");
    const std::string first = "\x80\x40\x20\x81", second = "\x20\x40\x80\x82";
    const auto repeat = [](int count) { return std::string{1, 1, 1, char(count)}; };
    const auto message = [&](int width, const std::string& rows) {
        ScratchFolder::write(path, "#?RADIANCE\n\n-Y 2 +X " + std::to_string(width) +
                                       "\n" + rows);
        return message_of_load(path);
    };
    const std::string row =
        first + repeat(0x2a) + repeat(1) + second + repeat(2) + first;
    REQUIRE(message(303, row + row) == "loaded");
    const ljus::Image image = ljus::load_hdr(path);
    for (int x = 0; x < 303; ++x)
        CHECK(pixel(image, x, 1) ==
              (x > 298 && x < 302 ? ljus::Rgb{0.5f, 1, 2} : ljus::Rgb{1, 0.5f, 0.25f}));
    const std::string wrong =
        "a run of its repeated pixels leaves its row or repeats none.";
    for (const std::string& runs :
         {repeat(2) + first, first + repeat(3), first + repeat(0) + repeat(1),
          first + repeat(0) + repeat(0) + repeat(0) + first + first}) {
        CHECK(message(3, runs + first + first + first) == wrong);
        CHECK(message(3, first + first + first + runs) == wrong);
    }
}

TEST_CASE("hdr: a row too narrow or too wide for the coding is read as it stands") {
    // Its first pixel is what a coded row of this width would begin with.
    const ScratchFolder folder;
    const std::string path = folder.file("a.hdr");
    for (const int width : {1, 4, 7, 32768}) {
        std::string row;
        for (int x = 0; x < width; ++x) row += "\x03\x05\x07\x81";
        row.replace(0, 4, {2, 2, char(width / 256 % 128), char(width % 256)});
        ScratchFolder::write(path, "#?RADIANCE\n\n-Y 1 +X " + std::to_string(width) +
                                       "\n" + row);
        REQUIRE(message_of_load(path) == "loaded");
        const ljus::Image image = ljus::load_hdr(path);
        REQUIRE(image.width == width);
        if (width > 1)
            CHECK(image.pixels[std::size_t(width) - 1] ==
                  ljus::Rgb{3 / 128.0f, 5 / 128.0f, 7 / 128.0f});
        const float unit = std::ldexp(1.0f, width % 256 - 136);
        CHECK(image.pixels[0].x == (width % 256 == 0 ? 0.0f : 2 * unit));
    }
}

TEST_CASE("hdr: a plain row whose first colour begins like a coded one") {
    // 2, 2 and a third byte of 128 or more, which no coded row has: a colour.
    const ScratchFolder folder;
    const std::string path = folder.file("a.hdr");
    std::string row{2, 2, char(200), char(130)};
    for (int x = 1; x < 8; ++x) row += "\x03\x05\x07\x81";
    ScratchFolder::write(path, "#?RADIANCE\n\n-Y 1 +X 8\n" + row);
    REQUIRE(message_of_load(path) == "loaded");
    const ljus::Image image = ljus::load_hdr(path);
    CHECK(image.pixels[0] == ljus::Rgb{2 / 64.0f, 2 / 64.0f, 200 / 64.0f});
    CHECK(image.pixels[7] == ljus::Rgb{3 / 128.0f, 5 / 128.0f, 7 / 128.0f});
}

TEST_CASE("hdr: a header whose lines end in CR LF, as some systems have it") {
    ljus::Image image;
    REQUIRE_NOTHROW(image = ljus::load_hdr(LJUS_TEST_INPUTS "/crlf.hdr"));
    REQUIRE(image.width == 8);
    REQUIRE(image.height == 2);
    for (const ljus::Rgb& color : image.pixels)
        CHECK(color == ljus::Rgb{1, 0.5f, 0.25f});
}

TEST_CASE("hdr: a coded row may have any width from 8 to 32 767") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.hdr");
    for (const int width : {8, 127, 128, 129, 511, 512, 2048, 32767}) {
        // 128 different bytes, the most of a run, then equal ones, 127 at the most.
        std::string row{2, 2, char(width / 256), char(width % 256)};
        for (const int part : {0, 1, 2, 3}) {
            const int different = std::min(width, 128);
            row += char(different);
            for (int x = 0; x < different; ++x) row += char(part == 3 ? 136 : x);
            for (int left = width - different; left > 0; left -= 127)
                row += {char(128 + std::min(left, 127)), char(part == 3 ? 136 : part)};
        }
        ScratchFolder::write(path, "#?RADIANCE\n\n-Y 1 +X " + std::to_string(width) +
                                       "\n" + row);
        CAPTURE(width);
        REQUIRE(message_of_load(path) == "loaded");
        const ljus::Image image = ljus::load_hdr(path);
        REQUIRE(image.width == width);
        bool right = true;
        for (int x = 0; x < width; ++x) {
            const auto byte = [&](int part) { return float(x < 128 ? x : part); };
            right = right && image.pixels[std::size_t(x)] ==
                                 ljus::Rgb{byte(0), byte(1), byte(2)};
        }
        CHECK(right);
    }
}
