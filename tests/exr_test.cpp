// needs: openexr
/// \file exr_test.cpp
/// \brief EXR files: what is saved is loaded, files that OpenEXR's C++ library has
/// written, and damaged ones.

#include "ljus/io/exr.hpp"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "scratch_folder.hpp"
#include "support/refusal.hpp"

using namespace ljus;

namespace {

const ScratchFolder folder;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// A file in tests/inputs/exr. OpenEXR 3.1.5's library for C++ has written them, 6 x 8
/// pixels with the channels below; "zips" begins at column -2 and row -3.
std::string input(const std::string& name) {
    return LJUS_TEST_INPUTS "/exr/" + name + ".exr";
}
Rgb input_color(int x, int y) {
    const auto u = float(x), v = float(y);
    return {u / 16, v / 32, -0.25f + u * v / 1024};
}

/// An image of one row.
Image row_of(const std::vector<Rgb>& pixels) {
    return {.width = int(pixels.size()), .height = 1, .pixels = pixels};
}

std::string refusal_of(const std::string& path) {
    return ljus_test::refusal<std::runtime_error>([&] { (void)load_exr(path); },
                                                  "accepted");
}

void require_bits(float a, float b) {
    REQUIRE(std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b));
}

} // namespace

TEST_CASE("exr: floats keep their bits, even NaN, infinity and denormals") {
    std::vector<Rgb> pixels{{0, -0.0f, 1},
                            {infinity, -infinity, not_a_number},
                            {1e-45f, -1e-40f, 3.4e38f},
                            {std::bit_cast<float>(0x7fa12345u), 65536, -2.5f}};
    Image image = make_image(4, 40);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 4; ++x)
            pixel(image, x, y) = pixels[std::size_t((x + y) % 4)];
    const std::string file = folder.file("floats.exr");
    save_exr(image, file);
    const Image loaded = load_exr(file);
    REQUIRE(loaded.width == 4);
    REQUIRE(loaded.height == 40);
    for (std::size_t i = 0; i < loaded.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            require_bits(loaded.pixels[i][c], image.pixels[i][c]);
}

TEST_CASE("exr: a double is rounded to float, and loaded as a double") {
    auto image = make_image<double>(2, 1, RgbT<double>{0.1, 1e300, 2});
    const std::string file = folder.file("doubles.exr");
    save_exr(image, file);
    const auto loaded = load_exr<double>(file);
    CHECK(loaded.pixels[1] == RgbT<double>{double(0.1f), double(infinity), 2.0});
}

TEST_CASE("exr: every half is loaded as the number that it is, and saved as itself") {
    // By the definition of binary16, in double.
    std::vector<Rgb> pixels;
    for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
        const double sign = bits >= 0x8000 ? -1 : 1, mantissa = bits & 1023;
        const int exponent = int(bits >> 10 & 31);
        const double size = exponent == 0   ? std::ldexp(mantissa, -24)
                            : exponent < 31 ? std::ldexp(1024 + mantissa, exponent - 25)
                            : mantissa == 0 ? double(infinity)
                                            : double(not_a_number);
        const unsigned char bytes[]{static_cast<unsigned char>(bits & 255u),
                                    static_cast<unsigned char>(bits >> 8)};
        const float value = detail::exr_number(bytes, EXR_PIXEL_HALF);
        if (std::isnan(size)) {
            REQUIRE(std::isnan(value));
        } else {
            require_bits(value, float(sign * size));
        }
        pixels.push_back(Rgb{value});
    }
    const std::string file = folder.file("halves.exr");
    Image image = make_image(256, 256);
    image.pixels = pixels;
    save_exr(image, file, ExrNumbers::halves);
    const Image loaded = load_exr(file);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        if (std::isnan(pixels[i].x)) {
            REQUIRE(std::isnan(loaded.pixels[i].x));
        } else {
            require_bits(loaded.pixels[i].x, pixels[i].x);
        }
}

TEST_CASE("exr: what no half can hold is rounded, or is infinite") {
    const std::string file = folder.file("rounded.exr");
    save_exr(
        row_of({{65504, 65519, 65520}, {1e9f, -1e9f, 1e-9f}, {1.0004f, 1.0006f, 2}}),
        file, ExrNumbers::halves);
    const Image loaded = load_exr(file);
    CHECK(loaded.pixels[0] == Rgb{65504, 65504, infinity});
    CHECK(loaded.pixels[1] == Rgb{infinity, -infinity, 0});
    CHECK(loaded.pixels[2] == Rgb{1, 1.0009765625f, 2});
}

TEST_CASE("exr: layers come back with their names, channels and values") {
    // The names are not in the order of the file, which sorts them.
    std::vector<Layer> layers(4);
    layers[0].image = make_image(5, 33, Rgb{1, 2, 3});
    layers[1] = {"N", {"X", "Y", "Z"}, make_image(5, 33, Rgb{-1, 0, 0.5f})};
    layers[2] = {"", {"Z"}, make_image(5, 33, Rgb{7})};
    layers[3] = {"light.of lamps", {"R", "G", "B"}, make_image(5, 33, Rgb{4, 5, 6})};
    pixel(layers[3].image, 4, 32) = Rgb{9, 8, 7};
    const std::string file = folder.file("layers.exr");
    save_exr_layers(layers, file);
    const auto loaded = load_exr_layers(file);
    REQUIRE(loaded.size() == 4);
    for (const Layer& layer : layers) {
        bool found = false;
        for (const Layer& other : loaded)
            found = found ||
                    (other.name == layer.name && other.channels == layer.channels &&
                     other.image.pixels == layer.image.pixels);
        CAPTURE(channel_name(layer, 0));
        CHECK(found);
    }
    CHECK(load_exr(file).pixels == layers[0].image.pixels);
    CHECK(load_exr(file, "N").pixels == layers[1].image.pixels);
    CHECK(load_exr(file, "Z").pixels == layers[2].image.pixels);
    CHECK(load_exr(file, "light.of lamps").pixels == layers[3].image.pixels);
    CHECK_THROWS_WITH_AS((void)load_exr(file, "albedo"),
                         (file + " has no layer 'albedo'; it has 'RGB' 'N' 'Z' "
                                 "'light.of lamps'.")
                             .c_str(),
                         std::runtime_error);
}

TEST_CASE("exr: what another library has written, by every compression that is read") {
    for (const char* name :
         {"none", "rle", "zips", "piz", "pxr24", "b44a", "b44_floats", "tiled"}) {
        CAPTURE(name);
        REQUIRE_NOTHROW((void)load_exr_layers<double>(input(name)));
        const auto layers = load_exr_layers<double>(input(name));
        // Of tiles the largest level counts. B44 stores floats as they are.
        const bool alone = layers.size() == 1;
        REQUIRE((alone || layers.size() == 3));
        // Of one file the data window begins 2 columns and 3 rows before the display
        // window, which is as large, so that its end is not stored.
        const bool before = name == std::string("zips");
        for (int row = 0; row < 8; ++row)
            for (int column = 0; column < 6; ++column) {
                const int x = before ? column + 2 : column, y = before ? row + 3 : row;
                const bool stored = x < 6 && y < 8;
                const auto is = [&](std::size_t layer, const RgbT<double>& color) {
                    CHECK(pixel(layers[layer].image, column, row) ==
                          (stored ? color : RgbT<double>{0}));
                };
                is(0, RgbT<double>(input_color(x, y)));
                if (alone) continue;
                is(1, RgbT<double>{x / 16.0});       // half.R
                is(2, RgbT<double>{x * 1000.0 + y}); // id, whole
            }
    }
}

TEST_CASE("exr: several parts, a data window of its own, and a grey picture") {
    const auto parts = load_exr_layers(input("parts"));
    REQUIRE(parts.size() == 2);
    CHECK(parts[0].name == "beauty");
    CHECK(parts[0].image.width == 6);
    CHECK(pixel(parts[0].image, 3, 4) == Rgb{3 / 16.f, 4 / 32.f, 3 / 16.f});
    // Tiles of 4 x 4 pixels, from column 2 and row 3 of the picture on.
    CHECK(channel_name(parts[1], 0) == "depth.Z");
    CHECK(parts[1].image.width == 6);
    CHECK(parts[1].image.height == 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 6; ++x)
            CHECK(pixel(parts[1].image, x, y).x ==
                  (x < 2 || y < 3 ? 0.0f : float(x + 100 * y)));
    CHECK(load_exr(input("parts"), "depth.Z").pixels == parts[1].image.pixels);
    // Tiles of 4 x 2 pixels, in a part that is a cube.
    REQUIRE_NOTHROW((void)load_exr(input("cube"), "picture"));
    const auto cube = load_exr_layers(input("cube"));
    REQUIRE(cube.size() == 2);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 6; ++x)
            CHECK(pixel(cube[1].image, x, y) == input_color(x, y));
    CHECK_THROWS_AS((void)load_exr(input("cube"), "faces"), std::runtime_error);
    CHECK(refusal_of(input("parts")) ==
          input("parts") + " has no picture of R, G and B; it has 'beauty' 'depth.Z': "
                           "load one by its name, or save it as R, G and B.");
    // Luminance, in rows from the bottom up, and colours for every second pixel.
    CHECK(refusal_of(input("grey")) ==
          input("grey") +
              " has a luminance Y with colours in RY and BY, which are not "
              "read; save it with R, G and B, or load its layer 'Y' alone.");
    REQUIRE_NOTHROW((void)load_exr(input("grey"), "Y"));
    const Image grey = load_exr(input("grey"), "Y");
    CHECK(load_exr_layers(input("grey")).size() == 1);
    CHECK(pixel(grey, 5, 7) == Rgb{5 / 16.f});
}

TEST_CASE("exr: a luminance without colours is grey, no layer is no picture") {
    save_exr_layers(
        std::vector<Layer>{{.channels{"Y"}, .image = make_image(2, 2, Rgb{0.5f})}},
        folder.file("y.exr"));
    CHECK(load_exr(folder.file("y.exr")).pixels == std::vector<Rgb>(4, Rgb{0.5f}));
    // Every channel has values for every second pixel only.
    Bytes bytes = load_file(input("grey"), 1 << 20);
    const unsigned char name_and_head[]{'Y', 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1};
    const auto at = std::search(bytes.begin(), bytes.end(), std::begin(name_and_head),
                                std::end(name_and_head));
    REQUIRE(at != bytes.end());
    at[10] = at[14] = 2;
    save_file(folder.file("half.exr"), bytes);
    CHECK(refusal_of(folder.file("half.exr"))
              .find("has only deep pixels, or channels "
                    "with fewer values than pixels") != std::string::npos);
    CHECK_THROWS((void)load_exr_layers(folder.file("half.exr")));
}

TEST_CASE("exr: layers that no file can hold are refused") {
    const auto refused = [](const std::vector<Layer>& layers, const char* why) {
        CHECK_THROWS_WITH_AS(save_exr_layers(layers, folder.file("never.exr")),
                             doctest::Contains(why), std::invalid_argument);
    };
    const Image one = make_image(1, 1);
    refused({}, "layers is 0; it must be at least 1");
    refused({{.image = one}, {.image = make_image(2, 1)}}, "1 x 1");
    refused({{.image = one}, {.image = one}}, "Two channels are called 'B'");
    refused({{.channels{"R", "G"}, .image = one}}, "is 2; it must be 1 or 3");
    refused({{.channels{""}, .image = one}}, "1 to 255 bytes");
    refused({{.name = std::string(254, 'n'), .image = one}}, "1 to 255 bytes");
    refused({{.image = {}}}, "0 x 0");
    save_exr_layers(std::vector<Layer>{{std::string(253, 'n'), {"R", "G", "B"}, one}},
                    folder.file("long.exr"));
    CHECK(load_exr_layers(folder.file("long.exr"))[0].name == std::string(253, 'n'));
}

TEST_CASE("exr: what is wrong with a file is said in a sentence") {
    CHECK(refusal_of(folder.file("none.exr")).starts_with("cannot read"));
    CHECK(refusal_of(input("dwaa")) ==
          input("dwaa") + " is compressed by a method that OpenEXRCore does not read, "
                          "such as DWAA; save it with ZIP or PIZ.");
    const std::string file = folder.file("hostile.exr");
    const auto with = [&](Bytes bytes) {
        save_file(file, bytes);
        return refusal_of(file);
    };
    CHECK(with({'P', 'F', '\n'}).find("another kind of file") != std::string::npos);
    const Bytes whole = load_file(input("none"), 1 << 20);
    CHECK(with(whole) == "accepted");
    // Cut anywhere, it ends in a sentence.
    for (std::size_t size = 4; size < whole.size(); size += 7) {
        const std::string why =
            with({whole.begin(), whole.begin() + std::ptrdiff_t(size)});
        REQUIRE(why.starts_with(file + " is damaged, or not an EXR file"));
        REQUIRE(why.ends_with("."));
    }
    // A picture that is wider than the file has bytes takes no memory.
    const std::string attribute = "dataWindow";
    const auto at =
        std::search(whole.begin(), whole.end(), attribute.begin(), attribute.end()) -
        whole.begin();
    const auto window = std::size_t(at) + attribute.size() + 1 + 6 + 4; // box2i, size
    const auto with_corner = [&](std::initializer_list<std::uint32_t> numbers) {
        Bytes bytes = whole;
        std::size_t place = window + 8;
        for (const std::uint32_t number : numbers)
            for (int shift = 0; shift < 32; shift += 8)
                bytes[place++] = static_cast<unsigned char>(number >> shift);
        return with(bytes);
    };
    CHECK(with_corner({5, 7}) == "accepted");
    CHECK(with_corner({4095, 4095}).find("it ends in the middle of its pixels") !=
          std::string::npos);
    CHECK(with_corner({0x7ffffff0, 7}).find(" is damaged, or not") !=
          std::string::npos);
    CHECK(with_corner({0x00ffffff, 0x00ffffff}).find("16777216 x 16777216 pixels") !=
          std::string::npos);
    CHECK(with_corner({0xffffffff, 7}).starts_with(file + " is damaged"));
}

TEST_CASE("exr: colours of other primaries become those of sRGB, cubes are refused") {
    const std::string file = folder.file("primaries.exr");
    const Image colors{3, 1, {Rgb{0.5f}, {0.5f, 0.25f, 0.125f}, {0.25f, 0.5f, 0.75f}}};
    const auto save_with = [&](const std::string& name, const Bytes& value) {
        save_exr_layers(
            std::vector<Layer>{
                {.image = colors},
                {.name = "N", .channels = {"X", "Y", "Z"}, .image = colors}},
            file);
        Bytes bytes = load_file(file, 1 << 20);
        // The offset of the only chunk, which stands before it, becomes larger.
        const auto number = [&](std::size_t at) {
            return bytes[at] | std::size_t(bytes[at + 1]) << 8;
        };
        std::size_t at = 8;
        while (number(at) != at + 8) ++at;
        Bytes attribute; // of a type that has the same name
        for (int i = 0; i < 2; ++i)
            attribute.insert(attribute.end(), name.c_str(),
                             name.c_str() + name.size() + 1);
        attribute.insert(attribute.end(),
                         {static_cast<unsigned char>(value.size()), 0, 0, 0});
        attribute.insert(attribute.end(), value.begin(), value.end());
        const std::size_t behind = at + 8 + attribute.size();
        bytes[at] = static_cast<unsigned char>(behind);
        bytes[at + 1] = static_cast<unsigned char>(behind >> 8);
        bytes.insert(bytes.begin() + 8, attribute.begin(), attribute.end());
        save_file(file, bytes);
    };
    const auto save_in = [&](const std::array<float, 8>& primaries) {
        Bytes value;
        for (const float number : primaries)
            for (int shift = 0; shift < 32; shift += 8)
                value.push_back(static_cast<unsigned char>(
                    std::bit_cast<std::uint32_t>(number) >> shift));
        save_with("chromaticities", value);
    };
    const auto far = [](const Image& a, const Image& b) {
        float most = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            most = std::max(most, glm::distance(a.pixels[i], b.pixels[i]));
        return most;
    };
    // Those of sRGB, with its white or another.
    for (const float white : {0.3127f, 0.3457f}) {
        save_in({0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, white, 0.329f});
        CHECK(far(load_exr(file), colors) == 0);
    }
    // Of ACES and ACEScg; their numbers are from Little CMS 2.14. Negative channels
    // are 0.
    struct Row {
        std::array<float, 8> primaries;
        std::vector<Rgb> colors;
    };
    for (const Row& row :
         {Row{{0.7347f, 0.2653f, 0.0f, 1.0f, 0.0001f, -0.077f, 0.3217f, 0.3377f},
              {Rgb{0.5f}, {0.92883f, 0.19291f, 0.10011f}, {0, 0.54506f, 0.79593f}}},
          Row{{0.713f, 0.293f, 0.165f, 0.83f, 0.128f, 0.044f, 0.32168f, 0.33767f},
              {Rgb{0.5f},
               {0.68667f, 0.21875f, 0.09988f},
               {0.05292f, 0.52993f, 0.79424f}}},
          // X, Y and Z themselves, which are not adapted, by the matrix of sRGB.
          Row{{1, 0, 0, 1, 0, 0, 0.33333f, 0.33333f},
              {{0.60239f, 0.47415f, 0.45442f},
               {1.17363f, 0, 0.10897f},
               {0, 0.72686f, 0.70482f}}}}) {
        save_in(row.primaries);
        CHECK(far(load_exr(file), {3, 1, row.colors}) < 3e-4f);
        // Normals have none.
        const auto layers = load_exr_layers(file);
        REQUIRE(layers.size() == 2);
        for (const Layer& layer : layers)
            CHECK(far(layer.image,
                      layer.name == "N" ? colors : Image{3, 1, row.colors}) < 3e-4f);
    }
    save_in({});
    CHECK(refusal_of(file) == file + " has chromaticities that are not three primaries "
                                     "and a white; save it with those "
                                     "of sRGB.");
    save_with("envmap", {0}); // latitude and longitude
    CHECK(refusal_of(file) == "accepted");
    save_with("envmap", {1});
    CHECK(refusal_of(file) ==
          file + " has the six faces of a cube, as its attribute envmap says; convert "
                 "it to latitude and longitude, for example by 'exrenvmap -l'.");
    CHECK(load_exr_layers(file).size() == 2);
}

TEST_CASE("exr: what reads meshes reads pictures as well") {
    const WithExr files{[](const std::string& path, int settings) {
        return path + " " + std::to_string(settings);
    }};
    CHECK(files("a.obj", 3) == "a.obj 3");
    CHECK(files.load_picture<float>(input("piz")).pixels ==
          load_exr(input("none")).pixels);
}
