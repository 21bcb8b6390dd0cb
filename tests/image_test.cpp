#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <utility>

#include "ljus/image/image.hpp"

TEST_CASE("image: a new one has its size, and one colour everywhere") {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {7, 1}, {5, 3}}) {
        const ljus::Image image = ljus::make_image(width, height, {1.0f, 2.0f, 3.0f});
        CHECK(image.width == width);
        CHECK(image.height == height);
        REQUIRE(image.pixels.size() == static_cast<std::size_t>(width * height));
        for (const ljus::Rgb& c : image.pixels) CHECK(c == ljus::Rgb{1, 2, 3});
        CHECK_NOTHROW(ljus::check(image));
    }
}

TEST_CASE("image: black unless told otherwise, in double as well") {
    CHECK(ljus::make_image(2, 2).pixels[3] == ljus::Rgb{0, 0, 0});
    const ljus::ImageT<double> image = ljus::make_image<double>(2, 2);
    CHECK(image.pixels[3] == ljus::RgbT<double>{0, 0, 0});
}

TEST_CASE("image: rows follow each other from the top, pixels from the left") {
    ljus::Image image = ljus::make_image(4, 3);
    ljus::pixel(image, 3, 0) = {1, 0, 0};
    ljus::pixel(image, 0, 2) = {0, 1, 0};
    CHECK(image.pixels[3] == ljus::Rgb{1, 0, 0});
    CHECK(image.pixels[8] == ljus::Rgb{0, 1, 0});
    const ljus::Image& read_only = image;
    CHECK(ljus::pixel(read_only, 0, 2) == ljus::Rgb{0, 1, 0});
}

TEST_CASE("image: a size that is not positive, or absurd, is refused with its value") {
    const int most = std::numeric_limits<int>::max();
    for (const auto& [width, height] : {std::pair{0, 1},
                                        {1, 0},
                                        {-1, 5},
                                        {5, -1},
                                        {-3, -3},
                                        {most, most},
                                        {most, 2}}) {
        CHECK_THROWS_AS((void)ljus::make_image(width, height), std::invalid_argument);
    }
    CHECK_THROWS_WITH(
        (void)ljus::make_image(0, 400),
        "The image's size is 0 x 400; width and height must be at least 1, "
        "and their product at most 268435456.");
    CHECK_NOTHROW(ljus::require_image_size(1LL << 28, 1));
    CHECK_THROWS_AS(ljus::require_image_size((1LL << 28) + 1, 1),
                    std::invalid_argument);
    CHECK_THROWS_AS(ljus::require_image_size(1LL << 62, 1LL << 62),
                    std::invalid_argument);
}

TEST_CASE("image: one whose pixels do not fit its size is refused") {
    ljus::Image image = ljus::make_image(4, 3);
    image.width = 5;
    CHECK_THROWS_WITH_AS(ljus::check(image),
                         "The image has 12 pixels; its size, 5 x 3, requires 15.",
                         std::invalid_argument);
    image.width = 3;
    CHECK_THROWS_WITH_AS(ljus::check(image),
                         "The image has 12 pixels; its size, 3 x 3, requires 9.",
                         std::invalid_argument);
    CHECK_THROWS_AS(ljus::check(ljus::Image{}), std::invalid_argument);
}

TEST_CASE("image: neither side alone may be beyond what both allow") {
    const long long most = ljus::max_pixels;
    CHECK_NOTHROW(ljus::require_image_size(most, 1));
    CHECK_NOTHROW(ljus::require_image_size(1, most));
    CHECK_NOTHROW(ljus::require_image_size(most / 2, 2));
    CHECK_THROWS_AS(ljus::require_image_size(most / 2 + 1, 2), std::invalid_argument);
    CHECK_THROWS_AS(ljus::require_image_size(2, most / 2 + 1), std::invalid_argument);
    CHECK_THROWS_AS(ljus::require_image_size(most, most), std::invalid_argument);
    // The sentence names the width first.
    ljus::Image image;
    image.width = 3;
    image.height = -4;
    CHECK_THROWS_WITH_AS(ljus::check(image),
                         doctest::Contains("The image's size is 3 x -4;"),
                         std::invalid_argument);
}

TEST_CASE("image: two are compared only if both sides fit, and both are whole") {
    const ljus::Image image = ljus::make_image(3, 2);
    CHECK_NOTHROW(
        ljus::detail::require_same_size(image, ljus::make_image<double>(3, 2)));
    CHECK_THROWS_WITH_AS(ljus::detail::require_same_size(image, ljus::make_image(3, 5)),
                         "The image's size is 3 x 2; the reference has 3 x 5.",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(ljus::detail::require_same_size(image, ljus::make_image(4, 2)),
                         "The image's size is 3 x 2; the reference has 4 x 2.",
                         std::invalid_argument);
    // As many pixels, the other way round.
    CHECK_THROWS_WITH_AS(ljus::detail::require_same_size(image, ljus::make_image(2, 3)),
                         "The image's size is 3 x 2; the reference has 2 x 3.",
                         std::invalid_argument);
    ljus::Image torn = image;
    torn.pixels.pop_back();
    CHECK_THROWS_AS(ljus::detail::require_same_size(torn, image),
                    std::invalid_argument);
    CHECK_THROWS_AS(ljus::detail::require_same_size(image, torn),
                    std::invalid_argument);
}
