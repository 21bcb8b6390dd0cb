#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "ljus/io/pfm.hpp"
#include "scratch_folder.hpp"
#include "support/refusal.hpp"

namespace {

std::string message_of_load(const std::string& path) {
    return ljus_test::why_not_read(path, [&] { (void)ljus::load_pfm(path); });
}

} // namespace

TEST_CASE("pfm: every float comes back with the same bits") {
    const ScratchFolder folder;
    using Limits = std::numeric_limits<float>;
    const float specials[] = {0.0f, -0.0f, 1.0f, -1.0f, 0.1f, Limits::denorm_min(),
                              Limits::min(), Limits::max(), Limits::infinity(),
                              -Limits::max(), Limits::quiet_NaN(), -Limits::infinity(),
                              // One that signals: arithmetic would make it quiet.
                              std::bit_cast<float>(0x7f800123u)};
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 13}, {13, 1}, {31, 17}}) {
        ljus::Image image = ljus::make_image(width, height);
        std::uint32_t state = 3;
        for (ljus::Rgb& c : image.pixels) {
            state = state * 1664525u + 1013904223u;
            c = {specials[state >> 28 & 7], static_cast<float>(state),
                 specials[8 + (state >> 8) % 5]};
        }
        ljus::save_pfm(image, folder.file("a.pfm"));
        const ljus::Image loaded = ljus::load_pfm(folder.file("a.pfm"));
        REQUIRE(loaded.width == width);
        REQUIRE(loaded.height == height);
        int wrong = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                wrong += std::bit_cast<std::uint32_t>(image.pixels[i][c]) !=
                         std::bit_cast<std::uint32_t>(loaded.pixels[i][c]);
        CHECK(wrong == 0);
        CHECK(folder.count() == 1);
    }
}

TEST_CASE(
    "pfm: the bytes are those of the format: little-endian, the bottom row first") {
    const ScratchFolder folder;
    ljus::Image image = ljus::make_image(1, 2);
    image.pixels[0] = {1.0f, 2.0f, -0.5f};    // 3f800000 40000000 bf000000
    image.pixels[1] = {0.0f, 3.0f, 0.15625f}; // 00000000 40400000 3e200000
    ljus::save_pfm(image, folder.file("a.pfm"));
    const std::string expected("PF\n1 2\n-1.0\n"
                               "\0\0\0\0"
                               "\0\0\x40\x40"
                               "\0\0\x20\x3e"
                               "\0\0\x80\x3f"
                               "\0\0\0\x40"
                               "\0\0\0\xbf",
                               36);
    CHECK(ScratchFolder::read(folder.file("a.pfm")) == expected);
}

TEST_CASE("pfm: double is rounded to float once, and comes back as double") {
    const ScratchFolder folder;
    const auto image = ljus::make_image<double>(1, 1, {0.1, 1e300, 1e-300});
    ljus::save_pfm(image, folder.file("a.pfm"));
    const auto loaded = ljus::load_pfm<double>(folder.file("a.pfm"));
    CHECK(loaded.pixels[0].x == static_cast<double>(0.1f));
    CHECK(loaded.pixels[0].y == std::numeric_limits<double>::infinity());
    CHECK(loaded.pixels[0].z == 0.0);
}

TEST_CASE("pfm: big-endian, grey and scaled files of other programs") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.pfm");
    ScratchFolder::write(path, std::string("Pf 1\t2\r1.0\n\x3f\x80\0\0\x40\0\0\0", 19));
    const ljus::Image grey = ljus::load_pfm(path);
    REQUIRE(grey.pixels.size() == 2);
    CHECK(grey.pixels[0] == ljus::Rgb{2, 2, 2});
    CHECK(grey.pixels[1] == ljus::Rgb{1, 1, 1});
    ScratchFolder::write(path, std::string("Pf\n1 1\n-2.5e-1\n\0\0\x80\x3f", 19));
    CHECK(ljus::load_pfm(path).pixels[0].x == 0.25f);
    ScratchFolder::write(path, std::string("Pf\n1 1\n-1e300\n\0\0\x80\x3f", 18));
    CHECK(message_of_load(path) == "a pixel multiplied by its scale is not finite.");
}

TEST_CASE("pfm: a truncated, longer or foreign file is refused in a sentence") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.pfm");
    ljus::save_pfm(ljus::make_image(3, 2), path);
    const std::string whole = ScratchFolder::read(path);
    REQUIRE(whole.size() == 12 + 72);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        ScratchFolder::write(path, whole.substr(0, size));
        CHECK(message_of_load(path) != "loaded");
    }
    ScratchFolder::write(path, whole.substr(0, 80));
    CHECK(message_of_load(path) ==
          "its 3 x 2 pixels require 72 bytes after the header, "
          "but there are 68.");
    ScratchFolder::write(path, whole + "x");
    CHECK(message_of_load(path) ==
          "its 3 x 2 pixels require 72 bytes after the header, "
          "but there are 73.");
    CHECK(message_of_load(folder.file("b.pfm")) == "No such file or directory.");

    for (const std::string header :
         {"", "P", "PF", "P6\n3 2\n255\n", "PF\n0 2\n-1.0\n", "PF\n-3 2\n-1.0\n",
          "PF\n3 2\n0\n", "PF\n3 2\nnan\n", "PF\n3 2\n-1.0.0\n", "PF\n3 2\n1e999\n",
          "PF\n3 2\n-\n", "PF\n3 x\n-1.0\n", "PF\n99999999999999999999 2\n-1.0\n",
          "PF\n268435456 268435456\n-1.0\n", "PF\n268435456 1\n-1.0\n",
          "\x89PNG\r\n\x1a\n", "PFPFPFPFPFPFPFPF"}) {
        CAPTURE(header);
        ScratchFolder::write(path, header + std::string(72, '\0'));
        CHECK(message_of_load(path) != "loaded");
    }
    ScratchFolder::write(path, "PF\n20000 30000\n-1.0\n");
    CHECK(message_of_load(path) ==
          "it has 20000 x 30000 pixels; there can be at most 268435456.");
}

TEST_CASE("pfm: a file without end is refused at once") {
#if __has_include(<unistd.h>)
    CHECK_THROWS_AS((void)ljus::load_pfm("/dev/zero"), std::runtime_error);
#endif
}

TEST_CASE("pfm: a decimal of a header is the nearest number") {
    using ljus::detail::number_of;
    CHECK(number_of("0.3") == 0.3); // 3 times 0.1 is not
    CHECK(number_of("-12.7") == -12.7);
    CHECK(number_of("7e2") == 700);
    CHECK(number_of("+2.5E-1") == 0.25);
    for (const char* const none : {"", "-", ".", "1.", "1e", "1 ", "x", "0x1"})
        CHECK(std::isnan(number_of(none)) == (std::string(none) != "1."));
}

TEST_CASE("pfm: infinity and NaN are what they are at any scale") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.pfm");
    const float infinity = std::numeric_limits<float>::infinity();
    for (const char* const scale : {"-1", "-2.5", "1", "2.5"}) {
        const bool little = scale[0] == '-';
        std::string text = std::string("PF\n1 1\n") + scale + "\n";
        for (const float x :
             {infinity, -infinity, std::numeric_limits<float>::quiet_NaN()})
            for (int i = 0; i < 4; ++i)
                text += static_cast<char>(std::bit_cast<std::uint32_t>(x) >>
                                          8 * (little ? i : 3 - i));
        ScratchFolder::write(path, text);
        const ljus::Rgb c = ljus::load_pfm(path).pixels.at(0);
        CHECK(c.x == infinity);
        CHECK(c.y == -infinity);
        CHECK(std::isnan(c.z));
    }
}

TEST_CASE("pfm: a size with many digits is no small one, a word has at most 64") {
    // 2^64 + 1 and 2^32 + 1 would be 1 in a number that has no room for them.
    const ScratchFolder folder;
    const std::string path = folder.file("a.pfm");
    const auto message = [&](const std::string& width) {
        ScratchFolder::write(path, "PF\n" + width + " 1\n-1\n" + std::string(12, 'x'));
        return message_of_load(path);
    };
    CHECK(message("1") == "loaded");
    CHECK(message("+1") != "loaded");
    CHECK(message("0000000000001") == "loaded");
    for (const char* const width : {"18446744073709551617", "4294967297",
                                    "340282366920938463463374607431768211457"})
        CHECK(message(width) ==
              std::string("its width or height is '") + width +
                  "'; it must be a whole number from 1 to 268435456.");
    CHECK(message(std::string(63, '0') + "1") == "loaded");
    CHECK(message(std::string(64, '0') + "1") ==
          "its header has a word of more than 64 letters.");
}

TEST_CASE("pfm: comments in the header, as image editors write them") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.pfm");
    const std::string pixel(12, '\0');
    ScratchFolder::write(path, "PF\n#\n# 7 7 by hand\n1 #1\n1\n-1.0\n" + pixel);
    ljus::Image image;
    REQUIRE_NOTHROW(image = ljus::load_pfm(path));
    CHECK(image.width == 1);
    // A # among the pixels is none.
    ScratchFolder::write(path, "Pf\n1 1\n-1\n##\n#");
    REQUIRE_NOTHROW(image = ljus::load_pfm(path));
    CHECK(image.pixels[0].x == std::bit_cast<float>(0x230a2323u));
}

TEST_CASE("pfm: blanks behind the words of the header are no pixels") {
    ljus::Image image;
    REQUIRE_NOTHROW(image = ljus::load_pfm(LJUS_TEST_INPUTS "/spaces.pfm"));
    REQUIRE(image.width == 4);
    REQUIRE(image.height == 2);
    for (const ljus::Rgb& color : image.pixels)
        CHECK(color == ljus::Rgb{0.5f, 0.25f, 0.125f});
}
