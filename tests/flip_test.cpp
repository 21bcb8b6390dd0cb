// FLIP against numbers from elsewhere: closed forms, a constant of other programs, and
// a second program in another language (plain Python, 2-D kernels, written from the
// paper) on small pictures made of whole numbers.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "ljus/image/flip.hpp"
#include "ljus/image/hdr_flip.hpp"

using namespace ljus;
using doctest::Approx;

namespace {

using ImageD = ImageT<double>;
using RgbD = RgbT<double>;

/// The pictures of the second program: two patterns, one colour, and an edge.
enum Kind { pattern, changed, even, edge };
ImageD picture(int width, int height, Kind kind) {
    ImageD image = make_image<double>(width, height, {0.2, 0.3, 0.4});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            RgbD& c = pixel(image, x, y);
            const double red = (x * 7 + y * 3 + (kind == changed ? 1 : 0)) % 16 / 15.0;
            const double green = (x + y * 5) % 9 / 8.0, blue = x * y % 11 / 10.0;
            if (kind == pattern) c = {red, green, blue};
            if (kind == changed) c = {red, 0.8 * green, 0.25 + 0.5 * blue};
            if (kind == edge && x >= width / 2) c = {0.9, 0.85, 0.1};
        }
    return image;
}

} // namespace

TEST_CASE("flip: 0 for the same picture, whatever it shows and from wherever") {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 40}, {40, 1}, {17, 9}})
        for (const double ppd : {1.0, 20.0, 67.0}) {
            const ImageD image = picture(width, height, pattern);
            CHECK(flip(image, image, ppd) == 0);
        }
    const Image in_float = make_image(5, 5, {0.25f, 0.5f, 1.0f});
    CHECK(flip(in_float, make_image<double>(5, 5, {0.25, 0.5, 1.0})) == 0);
}

TEST_CASE("flip: the distance of a screen, and the largest difference of all") {
    CHECK(detail::pixels_per_degree() == Approx(67.0206432766).epsilon(1e-11));
    CHECK(detail::pixels_per_degree(1.4) == Approx(2 * detail::pixels_per_degree()));
    // Other programs hold 41.2760963 as a constant.
    const double most =
        detail::hyab(detail::hunt_lab({0, 1, 0}), detail::hunt_lab({0, 0, 1}));
    CHECK(std::pow(most, 0.7) == Approx(41.2760963).epsilon(2e-7));
    // L*a*b* of the primaries as tables have them: 87.737, -86.185, 83.181 for green;
    // the Hunt effect takes 0.87737 of the last two.
    const auto green = detail::hunt_lab({0, 1, 0});
    CHECK(green.x == Approx(87.737).epsilon(1e-4));
    CHECK(green.y == Approx(-86.185 * 0.87737).epsilon(1e-3));
    CHECK(green.z == Approx(83.181 * 0.87737).epsilon(1e-3));
    const auto white = detail::hunt_lab(RgbD(1));
    CHECK(white.x == Approx(100));
    CHECK(std::abs(white.y) + std::abs(white.z) < 1e-10);
    // In the dark, L* is 903.3 times Y.
    CHECK(detail::hunt_lab(RgbD(0.001)).x == Approx(24389.0 / 27 * 0.001));
}

TEST_CASE("flip: colours against colours") {
    CHECK(detail::color_error({0, 1, 0}, {0, 0, 1}) == 1);
    // By hand: 100 to the power 0.7 is 25.1189, beyond the bend at 0.4 * 41.2761.
    CHECK(detail::color_error(RgbD(1), RgbD(0)) == Approx(0.9673797615).epsilon(1e-8));
    // The second program.
    CHECK(detail::color_error({1, 0, 0}, {0, 1, 0}) ==
          Approx(0.9866622752).epsilon(1e-8));
    CHECK(detail::color_error({1, 0, 0}, {0, 0, 1}) ==
          Approx(0.9650790225).epsilon(1e-8));
    CHECK(detail::color_error(RgbD(0.2), RgbD(0.21)) ==
          Approx(0.0619891554).epsilon(1e-8));
    CHECK(detail::color_error({0.001, 0.002, 0.003}, RgbD(0)) ==
          Approx(0.0836492478).epsilon(1e-8));
    CHECK(detail::color_error(RgbD(1), RgbD(0.2)) ==
          Approx(0.8666886543).epsilon(1e-8));
    // To the colour space to blur in and back.
    for (const RgbD& c : {RgbD{1, 0, 0}, RgbD{0.1, 0.7, 0.4}, RgbD{0}, RgbD{1}})
        CHECK(glm::distance(detail::rgb_of_opponent(detail::opponent(c)), c) < 1e-12);
}

TEST_CASE("flip: pictures without edges are as different as their colours") {
    const RgbD a{0.2, 0.3, 0.4}, b{0.5, 0.3, 0.1};
    for (const int size : {1, 2, 30}) {
        const ImageD one = make_image<double>(size, size, a);
        const ImageD other = make_image<double>(size, size, b);
        // Sums that cancel leave features of 1e-17, whose root is taken.
        CHECK(flip(one, other) == Approx(detail::color_error(a, b)).epsilon(1e-7));
    }
    CHECK(flip(make_image(9, 9, Rgb(1)), make_image(9, 9)) ==
          Approx(0.9673797615).epsilon(1e-8));
}

TEST_CASE("flip: a second program's numbers for whole pictures") {
    struct Case {
        int width, height;
        Kind a, b;
        double ppd, mean, first, last, middle;
    };
    for (const Case& c :
         {Case{24, 18, pattern, changed, 20, 0.524372515372, 0.558135173910,
               0.295155482780, 0.722856866732},
          Case{24, 18, even, edge, 20, 0.523901444360, 0, 0.969190738322, 0},
          Case{24, 18, even, edge, 67.0206, 0.620826745655, 0, 0.969190738743, 0},
          Case{13, 9, pattern, changed, 67.0206, 0.493906536394, 0.744803589459,
               0.462240486758, 0.389264218972},
          Case{1, 1, even, pattern, 67.0206, 0.955821218156, 0.955821218156,
               0.955821218156, 0.955821218156},
          Case{1, 7, pattern, changed, 10, 0.842839430721, 0.751706761301,
               0.878855806911, 0.876947766033}}) {
        const ImageD a = picture(c.width, c.height, c.a);
        const ImageD b = picture(c.width, c.height, c.b);
        const ImageD map = flip_map(a, b, c.ppd);
        CAPTURE(c.width);
        CAPTURE(c.ppd);
        // The second program rounds its matrix to ten digits.
        CHECK(flip(a, b, c.ppd) == Approx(c.mean).epsilon(1e-6));
        CHECK(map.pixels.front().x == Approx(c.first).epsilon(1e-6));
        CHECK(map.pixels.back().z == Approx(c.last).epsilon(1e-6));
        CHECK(map.pixels[map.pixels.size() / 2].y == Approx(c.middle).epsilon(1e-6));
        // Exchanged, nothing changes.
        CHECK(flip(b, a, c.ppd) == Approx(flip(a, b, c.ppd)).epsilon(1e-12));
    }
}

TEST_CASE(
    "flip: a chequerboard of single pixels is grey from far away, not from near") {
    ImageD board = make_image<double>(40, 40);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x) pixel(board, x, y) = RgbD((x + y) % 2);
    const ImageD grey = make_image<double>(40, 40, RgbD(0.5));
    const double near = flip(board, grey, 5), far = flip(board, grey, 200);
    CHECK(near > 0.4);
    CHECK(far < 0.03); // the border is not blurred all round
}

TEST_CASE(
    "flip: an edge that is there in one picture only counts more than its colours") {
    const ImageD map = flip_map(picture(40, 40, even), picture(40, 40, edge));
    // Beside the edge, on the side that has not changed, nothing but blur and the edge.
    CHECK(pixel(map, 0, 20).x == 0);
    CHECK(pixel(map, 18, 20).x > 0.3);
    CHECK(pixel(map, 20, 20).x > pixel(map, 39, 20).x - 0.02);
}

TEST_CASE("flip: too bright, below black and not a number are what a screen shows") {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const ImageD bright = make_image<double>(3, 3, {1e30, infinity, 1});
    CHECK(flip(bright, make_image<double>(3, 3, RgbD(1))) == 0);
    const ImageD dark = make_image<double>(3, 3, {-1, nan, -infinity});
    CHECK(flip(dark, make_image<double>(3, 3)) == 0);
    CHECK_THROWS_AS((void)flip(make_image(3, 3), make_image(3, 4)),
                    std::invalid_argument);
    for (const double ppd : {0.0, -1.0, 0.99, 1e4, nan})
        CHECK_THROWS_AS((void)flip(bright, bright, ppd), std::invalid_argument);
}

TEST_CASE("flip: HDR: the film's curve and the exposures, by hand") {
    CHECK(detail::film_curve(0) == 0);
    CHECK(detail::film_curve(2.1188723) == Approx(0.85).epsilon(1e-6));
    CHECK(detail::film_curve(1) == Approx(0.9216 / 1.3688));
    CHECK(detail::film_curve(1e300) == 1);
    // Luminances 1/4, 1/4, 1, 4: the median is 1 and the brightest 4.
    ImageD image = make_image<double>(4, 1, RgbD(0.25));
    pixel(image, 2, 0) = RgbD(1);
    pixel(image, 3, 0) = RgbD(4);
    const detail::Exposures e = detail::exposures_of(image);
    CHECK(e.first == Approx(std::log2(2.1188723 / 4)).epsilon(1e-6));
    CHECK(e.last == Approx(std::log2(2.1188723)).epsilon(1e-6));
    CHECK(e.count == 2);
    pixel(image, 3, 0) = RgbD(1024);
    CHECK(detail::exposures_of(image).count == 10);
    // Light without end counts as the most that a float holds.
    pixel(image, 3, 0) = RgbD(std::numeric_limits<double>::infinity());
    CHECK(detail::exposures_of(image).first == Approx(std::log2(2.1188723) - 128));
    CHECK(detail::exposures_of(image).count == 128);
    // The middle one of an even number is the brighter of two, and never below epsilon.
    image.pixels = {RgbD(0), RgbD(0), RgbD(2), RgbD(8)};
    CHECK(detail::exposures_of(image).last == Approx(std::log2(2.1188723 / 2)));
    image.pixels = {RgbD(0), RgbD(-1), RgbD(0), RgbD(1e-9)};
    CHECK(detail::exposures_of(image).last == Approx(std::log2(2.1188723) + 23));
}

TEST_CASE("flip: HDR: the second program's numbers; and what does not matter") {
    // Each picture times 50 x / width, so that both have a bright side.
    const auto lit = [](Kind kind) {
        ImageD image = picture(24, 18, kind);
        for (int y = 0; y < 18; ++y)
            for (int x = 0; x < 24; ++x) pixel(image, x, y) *= 50.0 * (x + 1) / 24;
        return image;
    };
    const ImageD a = lit(pattern), b = lit(changed);
    CHECK(hdr_flip(a, b, 20) == Approx(0.515797845184).epsilon(1e-6));
    CHECK(hdr_flip(a, a, 20) == 0);
    // The exposure is found, so that the unit of radiance does not matter.
    ImageD dim_a = a, dim_b = b;
    for (RgbD& c : dim_a.pixels) c *= 1e-3;
    for (RgbD& c : dim_b.pixels) c *= 1e-3;
    CHECK(hdr_flip(dim_a, dim_b, 20) == Approx(hdr_flip(a, b, 20)).epsilon(1e-9));
}

TEST_CASE("flip: HDR: black, infinite and NaN pictures have a number") {
    const double infinity = std::numeric_limits<double>::infinity();
    const ImageD black = make_image<double>(4, 4);
    CHECK(hdr_flip(black, black) == 0);
    CHECK(hdr_flip(make_image<double>(4, 4, RgbD(1e30)), black) > 0.9);
    const ImageD odd = make_image<double>(
        4, 4, {infinity, std::numeric_limits<double>::quiet_NaN(), 1});
    const double error = hdr_flip(black, odd);
    CHECK((error >= 0 && error <= 1));
}

TEST_CASE("flip: of a large picture, tile by tile, as of all of it at once") {
    // A tile has 512 pixels a side; of 80 pixels a degree 11 around one count.
    constexpr double ppd = 80;
    for (const glm::ivec2 size : {glm::ivec2{1100, 20}, {20, 1100}, {600, 540}}) {
        const auto width = size.x, height = size.y;
        CAPTURE(width);
        const ImageD a = picture(width, height, pattern),
                     b = picture(width, height, changed);
        CHECK(flip_map(a, b, ppd).pixels == detail::flip_tile(a, b, ppd).pixels);
        ImageD worst = make_image<double>(width, height); // of all exposures
        const detail::Exposures exposures = detail::exposures_of(b);
        for (int i = 0; i < exposures.count; ++i) {
            const double part = double(i) / (exposures.count - 1);
            const auto developed = [&](ImageD of) {
                const double light = std::exp2(
                    exposures.first + part * (exposures.last - exposures.first));
                for (RgbD& c : of.pixels)
                    for (int k = 0; k < 3; ++k) c[k] = detail::film_curve(light * c[k]);
                return of;
            };
            const ImageD map = detail::flip_tile(developed(a), developed(b), ppd);
            for (std::size_t k = 0; k < map.pixels.size(); ++k)
                worst.pixels[k] = glm::max(worst.pixels[k], map.pixels[k]);
        }
        CHECK(hdr_flip_map(a, b, ppd).pixels == worst.pixels);
    }
}
