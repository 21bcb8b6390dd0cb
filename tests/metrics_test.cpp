#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "ljus/inspect/metrics.hpp"
#include "support/numbers.hpp"
#include "support/within.hpp"

namespace {

using doctest::Approx;
using ImageD = ljus::ImageT<double>;
using RgbD = ljus::RgbT<double>;

ImageD noisy(int width, int height, double mean, double deviation, std::uint64_t seed) {
    ImageD image = ljus::make_image<double>(width, height);
    ljus_test::Numbers numbers{seed * 7919 + 1};
    for (RgbD& c : image.pixels)
        for (int k = 0; k < 3; ++k) c[k] = mean + deviation * numbers.noise();
    return image;
}

} // namespace

TEST_CASE("metrics: all are 0 for equal images, of float and of double") {
    const ljus::Image a = ljus::make_image(23, 11, {1.0f, 0.0f, 5.0f});
    const ImageD b = ljus::make_image<double>(23, 11, {1.0, 0.0, 5.0});
    CHECK(ljus::rmse(a, b) == 0.0);
    CHECK(ljus::rel_mse(a, b) == 0.0);
    CHECK(ljus::trimmed_rel_mse(a, b) == 0.0);
    CHECK(ljus::block_error(a, b) == 0.0);
    const auto c = ljus::make_image<double>(5, 5, {0.1, 0.3, 1.7}); // rounded
    const auto black = ljus::make_image<double>(5, 5);
    for (const std::size_t runs : {2u, 7u, 26u, 100u}) {
        const std::vector<ImageD> equal(runs, c);
        const ljus::BiasVariance split = ljus::bias_variance(equal, c);
        CHECK(split.bias_squared == 0.0);
        CHECK(split.variance == 0.0);
        for (const double off : ljus::block_deviations(equal, c)) CHECK(off == 0.0);
        for (const double off : ljus::block_deviations(equal, black))
            CHECK(std::isinf(off));
    }
}

TEST_CASE("metrics: their formulas, for one pixel written out") {
    const ImageD x = ljus::make_image<double>(1, 1, {3.0, 1.0, 0.0});
    const ImageD r = ljus::make_image<double>(1, 1, {1.0, 2.0, 0.5});
    CHECK(ljus::rmse(x, r) == Approx(std::sqrt((4.0 + 1.0 + 0.25) / 3)));
    CHECK(ljus::rel_mse(x, r) == Approx((4 / 1.01 + 1 / 4.01 + 0.25 / 0.26) / 3));
    CHECK(ljus::rel_mse(x, r, 1.0) == Approx((4 / 2.0 + 1 / 5.0 + 0.25 / 1.25) / 3));
    CHECK(ljus::block_error(x, r) == Approx(ljus::rel_mse(x, r)));
}

TEST_CASE("metrics: a shift, over an image of any size") {
    const ImageD r = ljus::make_image<double>(37, 23, RgbD(2.0));
    const ImageD x = ljus::make_image<double>(37, 23, RgbD(2.2));
    CHECK(ljus::rmse(x, r) == Approx(0.2));
    CHECK(ljus::rel_mse(x, r) == Approx(0.04 / 4.01));
    CHECK(ljus::block_error(x, r) == Approx(0.04 / 4.01)); // blocks do not hide bias
    CHECK(ljus::trimmed_rel_mse(x, r) == Approx(0.04 / 4.01));
}

TEST_CASE("metrics: blocks of 10 x 10 weaken independent noise by 100") {
    // 6 standard errors of a mean of 3 * 400 squared block means, chi^2 with one
    // degree: 6 sqrt(2 / 1200) = 0.24.
    const ImageD r = ljus::make_image<double>(200, 200, RgbD(1.0));
    const ImageD x = noisy(200, 200, 1.0, 0.5, 1);
    CHECK(ljus::rel_mse(x, r) == ljus_test::within(0.25 / 1.01, 0.025));
    CHECK(ljus::block_error(x, r) == ljus_test::within(0.0025 / 1.01, 0.24));
}

TEST_CASE("metrics: a partial block takes the mean of the pixels it has") {
    ImageD image = ljus::make_image<double>(23, 11);
    for (int y = 0; y < 11; ++y)
        for (int x = 0; x < 23; ++x)
            ljus::pixel(image, x, y) = RgbD(100.0 * (x / 10) + 10.0 * (y / 10) + 1.0);
    const ImageD means = ljus::block_means(image);
    REQUIRE(means.width == 3);
    REQUIRE(means.height == 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
            CHECK(ljus::pixel(means, x, y).x == Approx(100.0 * x + 10.0 * y + 1.0));
    CHECK(ljus::block_means(image, 1).pixels == image.pixels);
    const int most = std::numeric_limits<int>::max();
    CHECK(ljus::block_means(image, most).pixels.size() == 1);
}

TEST_CASE("metrics: a firefly counts for the whole, but not for the trimmed rest") {
    const ImageD r = ljus::make_image<double>(20, 20, RgbD(1.0));
    ImageD x = ljus::make_image<double>(20, 20, RgbD(1.1));
    for (int i = 0; i < 4; ++i)
        ljus::pixel(x, 3 * i, i) = RgbD(1000.0); // 4 = 1 % of 400
    CHECK(ljus::rel_mse(x, r) > 9000.0);
    CHECK(ljus::trimmed_rel_mse(x, r) == Approx(0.01 / 1.01));
    CHECK(ljus::trimmed_rel_mse(x, r, 0.0) == Approx(ljus::rel_mse(x, r)));
    ljus::pixel(x, 19, 19) = RgbD(1000.0); // the fifth is over 1 %
    CHECK(ljus::trimmed_rel_mse(x, r) > 1000.0);
    // 29 % of 100 pixels are 29, although the product is rounded below.
    ImageD y = ljus::make_image<double>(10, 10, RgbD(1.0));
    for (std::size_t i = 0; i < 29; ++i) y.pixels[i] = RgbD(9.0);
    CHECK(ljus::trimmed_rel_mse(y, ljus::make_image<double>(10, 10, RgbD(1.0)), 0.29) ==
          0.0);
    // Of fewer than 100 pixels none is dropped.
    const ImageD one = ljus::make_image<double>(1, 1, RgbD(2.0));
    CHECK(ljus::trimmed_rel_mse(one, ljus::make_image<double>(1, 1, RgbD(1.0))) ==
          Approx(1 / 1.01));
    // One is always left.
    CHECK(ljus::trimmed_rel_mse(one, ljus::make_image<double>(1, 1, RgbD(1.0)),
                                std::nextafter(1.0, 0.0)) == Approx(1 / 1.01));
}

TEST_CASE("metrics: bias and variance of runs with known ones") {
    // Two runs x = r + b +- d: mean r + b, variance 2 d^2 and
    // bias^2 = b^2 - d^2, exactly.
    const ImageD r = ljus::make_image<double>(4, 3, RgbD(1.0));
    const ImageD up = ljus::make_image<double>(4, 3, RgbD(1.0 + 0.5 + 0.25));
    const ImageD down = ljus::make_image<double>(4, 3, RgbD(1.0 + 0.5 - 0.25));
    const ljus::BiasVariance split = ljus::bias_variance(std::vector{up, down}, r);
    CHECK(split.variance == Approx(2 * 0.0625));
    CHECK(split.bias_squared == Approx(0.25 - 0.0625));

    // 16 seeds, bias 0.3, deviation 2: the standard errors of variance and bias^2 over
    // 30 000 channels are below 0.01 and 0.004; the limits are 6 of them.
    std::vector<ImageD> runs;
    for (std::uint64_t seed = 0; seed < 16; ++seed)
        runs.push_back(noisy(100, 100, 1.3, 2.0, seed));
    const ljus::BiasVariance measured =
        ljus::bias_variance(runs, ljus::make_image<double>(100, 100, RgbD(1.0)));
    CHECK(std::abs(measured.variance - 4.0) < 0.06);
    CHECK(std::abs(measured.bias_squared - 0.09) < 0.024);
    double mse = 0.0;
    for (const ImageD& run : runs)
        mse +=
            std::pow(ljus::rmse(run, ljus::make_image<double>(100, 100, RgbD(1.0))), 2);
    CHECK(measured.variance + measured.bias_squared ==
          ljus_test::within(mse / 16, 1e-9));
}

TEST_CASE("metrics: large numbers are summed in double") {
    const ljus::Image r = ljus::make_image(1000, 1000, ljus::Rgb(0.1f));
    const ljus::Image x = ljus::make_image(1000, 1000, ljus::Rgb(0.3f));
    const double difference = static_cast<double>(0.3f) - static_cast<double>(0.1f);
    CHECK(ljus::rmse(x, r) == Approx(difference).epsilon(1e-14));
}

TEST_CASE("metrics: NaN is shown, not hidden") {
    const ImageD r = ljus::make_image<double>(20, 20, RgbD(1.0));
    ImageD x = r;
    x.pixels[17].y = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(ljus::rmse(x, r)));
    CHECK(std::isnan(ljus::rel_mse(x, r)));
    CHECK(std::isnan(ljus::trimmed_rel_mse(x, r)));
    // Not among the worst that are left out, wherever it stands
    // and however many they are.
    for (const std::size_t place : {0u, 17u, 200u, 399u})
        for (const double dropped : {0.01, 0.3, 0.9, 0.999}) {
            ImageD odd = r;
            for (std::size_t i = 0; i < 400; ++i) odd.pixels[i].x += double(i % 7);
            odd.pixels[place].z = std::numeric_limits<double>::quiet_NaN();
            CHECK(std::isnan(ljus::trimmed_rel_mse(odd, r, dropped)));
        }
    CHECK(std::isnan(ljus::block_error(x, r)));
    CHECK(std::isnan(ljus::bias_variance(std::vector{x, r}, r).variance));
}

TEST_CASE("metrics: sizes that differ, and arguments without sense, are refused") {
    const ljus::Image a = ljus::make_image(4, 3);
    const ljus::Image b = ljus::make_image(3, 4);
    CHECK_THROWS_WITH_AS((void)ljus::rmse(a, b),
                         "The image's size is 4 x 3; the reference has 3 x 4.",
                         std::invalid_argument);
    CHECK_THROWS_AS((void)ljus::rel_mse(a, b), std::invalid_argument);
    CHECK_THROWS_AS((void)ljus::trimmed_rel_mse(a, b), std::invalid_argument);
    CHECK_THROWS_AS((void)ljus::block_error(a, b), std::invalid_argument);
    CHECK_THROWS_AS((void)ljus::bias_variance(std::vector{a, a}, b),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)ljus::bias_variance(std::vector{a}, a),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)ljus::rmse(ljus::Image{}, ljus::Image{}),
                    std::invalid_argument);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double epsilon : {0.0, -1.0, nan})
        CHECK_THROWS_AS((void)ljus::rel_mse(a, a, epsilon), std::invalid_argument);
    for (const double dropped : {-0.1, 1.0, nan})
        CHECK_THROWS_AS((void)ljus::trimmed_rel_mse(a, a, dropped),
                        std::invalid_argument);
    for (const int size : {0, -1})
        CHECK_THROWS_AS((void)ljus::block_error(a, a, size), std::invalid_argument);
}

TEST_CASE(
    "metrics: epsilon and the side of a block are the caller's, and so are runs") {
    const ImageD x = ljus::make_image<double>(4, 4, {3.0, 1.0, 0.0});
    ImageD r = ljus::make_image<double>(4, 4, {1.0, 2.0, 0.5});
    const double with_1 = (4 / 2.0 + 1 / 5.0 + 0.25 / 1.25) / 3;
    CHECK(ljus::block_error(x, r, 2, 1.0) == Approx(with_1));
    CHECK(ljus::trimmed_rel_mse(x, r, 0.5, 1.0) == Approx(with_1));
    // Black and white in turns: blocks of 2 x 2 are grey, single pixels are not.
    ImageD board = ljus::make_image<double>(4, 4);
    for (std::size_t i = 0; i < 16; ++i)
        board.pixels[i] = RgbD((i + i / 4) % 2 ? 1 : 0);
    const ImageD grey = ljus::make_image<double>(4, 4, RgbD(0.5));
    CHECK(ljus::block_error(board, grey, 2) == 0.0);
    CHECK(ljus::block_error(board, grey, 1) == Approx(0.25 / 0.26));
    // 25 % of 16 pixels are dropped, the worst four, wherever they stand.
    for (const std::size_t i : {0u, 5u, 9u, 15u}) r.pixels[i] = RgbD(50.0);
    CHECK(ljus::trimmed_rel_mse(x, r, 0.25, 1.0) == Approx(with_1));
    CHECK(ljus::trimmed_rel_mse(x, r, 0.2, 1.0) < with_1 + 0.2);
    CHECK(ljus::trimmed_rel_mse(x, r, 0.2, 1.0) > with_1 + 0.01);
}

TEST_CASE("metrics: what is refused is named with its value") {
    const ImageD a = ljus::make_image<double>(4, 3);
    const ImageD turned = ljus::make_image<double>(3, 4);
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH_AS((void)ljus::rel_mse(a, a, -1.0),
                         "the epsilon of a relative error is -1; it must be finite and "
                         "above 0.",
                         std::invalid_argument);
    CHECK_THROWS_AS((void)ljus::rel_mse(a, a, infinity), std::invalid_argument);
    CHECK_THROWS_AS((void)ljus::trimmed_rel_mse(a, a, 0.01, infinity),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)ljus::block_error(a, a, 10, 0.0), std::invalid_argument);
    CHECK_THROWS_WITH_AS(
        (void)ljus::trimmed_rel_mse(a, a, 1.0),
        "the fraction of pixels to drop is 1; it must be within [0, 1).",
        std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)ljus::block_means(a, 0),
                         "the side of a block is 0; it must be at least 1.",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)ljus::bias_variance(std::vector{a}, a),
                         "the number of runs is 1; it must be at least 2.",
                         std::invalid_argument);
    // Each run is compared, not the first alone; and with the same number of pixels.
    CHECK_THROWS_WITH_AS((void)ljus::bias_variance(std::vector{a, turned}, a),
                         "The image's size is 3 x 4; the reference has 4 x 3.",
                         std::invalid_argument);
}
