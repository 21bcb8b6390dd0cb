// concept: recursion_depth
// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
// none failed.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ljus/inspect/metrics.hpp"
#include "ljus/render/adaptive.hpp"
#include "ljus/render/path_tracing.hpp"
#include "support/rooms.hpp"
#include "support/seed.hpp"

using namespace ljus;
using ljus_test::test_seed;

namespace {

/// A renderer whose rays have a known mean and variance in each half of the picture.
struct Halves {
    using Stream = RandomStream;
    float left = 0.1f;  ///< Standard deviation of a ray in the left half.
    float right = 0.4f; ///< The same in the right one.
    float mean = 1;     ///< Of all.
};

/// Uniform noise of the standard deviation that the direction's side has.
template <typename Context>
Rgb radiance(const Halves& halves, const Ray& ray, Context& context) {
    const float noise = std::sqrt(3.0f) * (2 * next_1d(context.stream) - 1);
    const float sigma = ray.direction.x < 0 ? halves.left : halves.right;
    return Rgb{halves.mean + sigma * noise};
}

/// A renderer that sees a bright spot with a small chance, and nothing else.
struct Spot {
    using Stream = RandomStream;
    float chance = 0.1f; ///< Of a ray.
};
template <typename Context>
Rgb radiance(const Spot& spot, const Ray&, Context& context) {
    return Rgb{next_1d(context.stream) < spot.chance ? 1.0f : 0.0f};
}

/// NaN for one ray in four.
struct Broken {
    using Stream = RandomStream;
};
template <typename Context>
Rgb radiance(const Broken&, const Ray&, Context& context) {
    return Rgb{next_1d(context.stream) < 0.25f ? std::numeric_limits<float>::quiet_NaN()
                                               : 1};
}

bool same_bytes(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height &&
           std::memcmp(a.pixels.data(), b.pixels.data(),
                       a.pixels.size() * sizeof(Rgb)) == 0;
}

double mean_of(const Image& image) {
    double sum = 0;
    for (const Rgb& c : image.pixels) sum += double(c.x);
    return sum / double(image.pixels.size());
}

/// Whether two numbers are equal within a relative tolerance. (doctest's Approx allows
/// for its epsilon times 1 as well, which for small numbers is everything.)
bool near(double x, double right, double part) {
    return std::abs(x - right) <= part * std::abs(right);
}

RenderSettings square(int size, int samples, std::uint64_t seed = 1) {
    return {.width = size, .height = size, .samples = samples, .seed = test_seed(seed)};
}

} // namespace

TEST_CASE("adaptive: the blocks of a picture hold each of its pixels once") {
    for (const auto& [width, height] : {std::pair{7, 3}, {3, 7}, {8, 8}, {1, 5}})
        for (const int side : {1, 2, 3, 8}) {
            std::vector<int> held(std::size_t(width * height));
            double pixels = 0;
            for (const auto& block :
                 detail::adaptive_blocks({.width = width, .height = height}, side, 0,
                                         (height + side - 1) / side)) {
                REQUIRE((block.x >= 0 && block.right <= width));
                REQUIRE((block.y >= 0 && block.bottom <= height));
                CHECK(block.x % side == 0);
                CHECK(block.y % side == 0);
                CHECK(
                    (block.right - block.x <= side && block.bottom - block.y <= side));
                CHECK(block.wanted == 1); // the first rays
                CHECK(block.batches == 0);
                pixels += block.pixels();
                for (int y = block.y; y < block.bottom; ++y)
                    for (int x = block.x; x < block.right; ++x)
                        ++held[detail::pixel_index(width, x, y)];
            }
            CHECK(pixels == width * height);
            for (const int count : held) CHECK(count == 1);
        }
}

TEST_CASE("adaptive: rays are shared out by the root of the variance") {
    // Two parts, variances 1 and 16, sizes 3 and 1: n = scale (1, 4). The mean error is
    // (3 / n1 + 16 / n2) / 4 = (3 + 4) / (4 scale): 0.01 for scale 175.
    using Parts = std::vector<detail::RayShare>;
    const Parts parts{{3, 1, 1}, {1, 16, 1}};
    const auto shares = detail::ray_shares(parts, 0.01, 1e9);
    CHECK(shares[0] == doctest::Approx(175));
    CHECK(shares[1] == doctest::Approx(700));
    // With a limit of 70 rays in the mean: scale = 4 * 70 / 7.
    const auto limited = detail::ray_shares(parts, 0, 70);
    CHECK(limited[0] == doctest::Approx(40));
    CHECK(limited[1] == doctest::Approx(160));
    CHECK(detail::ray_shares(parts, 0.01, 70) == limited);
    // No other division of the same rays is better.
    const auto error = [](double a, double b) { return (3 / a + 16 / b) / 4; };
    for (const double shift : {-9.0, -1.0, 1.0, 9.0})
        CHECK(error(40 + shift, 160 - 3 * shift) > error(40, 160));
    // A part that has more than its share keeps it, and the other pays for less: the
    // target is still met, (3 / 1000 + 16 / n) / 4 = 0.01.
    const auto rest = detail::ray_shares(Parts{{3, 1, 1000}, {1, 16, 1}}, 0.01, 1e9);
    CHECK(rest[0] == 1000);
    CHECK(rest[1] == doctest::Approx(16 / (0.04 - 0.003)));
    // If what is settled alone is above the target, the rest gets all that is left.
    const auto all = detail::ray_shares(Parts{{1, 4, 1000}, {1, 1, 1}}, 0.001, 700);
    CHECK(all[0] == 1000);
    CHECK(all[1] == doctest::Approx(400));
    // Nothing to gain, and nothing at all.
    CHECK(detail::ray_shares(Parts{{1, 0, 7}}, 0.01, 100) == std::vector<double>{7});
    CHECK(detail::ray_shares({}, 0.01, 100).empty());
}

TEST_CASE("adaptive: with nothing more to give it is render(), byte by byte") {
    const ljus_test::ClosedRoom room =
        ljus_test::make_room<float>(ljus_test::Ball::glass, ljus_test::Lamp::quad, 1);
    const PathTracer tracer(room);
    const Camera camera;
    for (const Sampling sampling : {Sampling::random, Sampling::multi_jittered}) {
        RenderSettings picture = square(13, 6, 5);
        picture.sampling = sampling;
        const Image plain = render(tracer, camera, picture).image;
        for (const int block : {1, 4, 100}) {
            const auto seen = render_adaptive(
                tracer, camera, picture, {.first = 6, .batches = 0, .block = block});
            CHECK(same_bytes(seen.image, plain));
            CHECK(seen.counts.camera_rays == 13 * 13 * 6);
            CHECK(mean_of(seen.rays) == 6);
        }
    }
}

TEST_CASE("adaptive: the same bytes for any number of threads") {
    const ljus_test::ClosedRoom room =
        ljus_test::make_room<float>(ljus_test::Ball::glass, ljus_test::Lamp::quad, 1);
    const PathTracer tracer(room);
    for (const bool two_stage : {false, true}) {
        const AdaptiveSettings rule{
            .first = 4, .more = 4, .block = 3, .target = 0.05, .two_stage = two_stage};
        RenderSettings picture = square(20, 40);
        picture.threads = 1;
        const auto one = render_adaptive(tracer, Camera{}, picture, rule);
        CHECK(one.counts.camera_rays > 20 * 20 * 4);
        for (const int threads : {2, 3, 8}) {
            picture.threads = threads;
            const auto many = render_adaptive(tracer, Camera{}, picture, rule);
            CHECK(same_bytes(one.image, many.image));
            CHECK(same_bytes(one.rays, many.rays));
            CHECK(one.estimate == many.estimate);
            CHECK(std::memcmp(&one.counts, &many.counts, sizeof(Counts)) == 0);
        }
    }
}

TEST_CASE("adaptive: it stops at the target, and the error is what it says") {
    // The truth is 1 everywhere, variances 0.01 and 0.16 of 1.01: relMSE 0.0004 takes
    // scale (1, 4) = roots/target: (0.1 + 0.4) / 2 / 0.000404, 62 and 248 rays.
    // With blocks of 64 pixels and 16 rays a variance is known within 3 %, the
    // picture's error over 4096 pixels and three equal channels within sqrt(2 / 4096) =
    // 2.2 %: 12 % are more than 5 standard errors, and the first seed that fails is
    // news.
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto seen = render_adaptive(Halves{}, Camera{}, square(64, 1000, seed),
                                          {.block = 8, .target = 0.0004});
        CHECK(seen.reached);
        CHECK(seen.estimate <= 0.0004);
        CHECK(seen.estimate > 0.00034); // whole batches of 16 are more than needed
        const double error = rel_mse(seen.image, make_image(64, 64, Rgb{1}));
        CHECK(near(error, seen.estimate, 0.12));
        const double left = double(pixel(seen.rays, 5, 20).x);
        const double right = double(pixel(seen.rays, 60, 20).x);
        CHECK(near(left, 62, 0.35)); // whole batches
        CHECK(near(right, 248, 0.15));
        // Fewer than equal numbers would take: 0.085 / 1.01 / 0.0004 = 210.
        CHECK(mean_of(seen.rays) < 180);
    }
}

TEST_CASE("adaptive: the limit for the mean is kept, and used") {
    for (const int samples : {16, 17, 31, 32, 50, 100}) {
        const auto seen =
            render_adaptive(Halves{}, Camera{}, square(32, samples), {.block = 8});
        CHECK(mean_of(seen.rays) <= samples);
        CHECK(mean_of(seen.rays) > samples - 16);
        CHECK_FALSE(seen.reached);
        CHECK(seen.counts.camera_rays ==
              std::uint64_t(std::lround(mean_of(seen.rays) * 1024)));
    }
    // Neither is that of batches exceeded.
    const auto seen = render_adaptive(Halves{}, Camera{}, square(32, 1000),
                                      {.batches = 2, .target = 1e-9});
    for (const Rgb& rays : seen.rays.pixels) CHECK(rays.x <= 48);
    const auto twice =
        render_adaptive(Halves{}, Camera{}, square(32, 1000),
                        {.batches = 2, .target = 1e-9, .two_stage = true});
    for (const Rgb& rays : twice.rays.pixels) CHECK(rays.x <= 48);
    // Any number of batches, of which sanitizers see none overflow.
    const int most = std::numeric_limits<int>::max();
    const auto any =
        render_adaptive(Halves{}, Camera{}, square(8, 64), {.batches = most});
    CHECK(mean_of(any.rays) > 48);
}

TEST_CASE("adaptive: pixels beside rays that differ get more, and no others") {
    // Left no noise, right plenty, by one ray per pixel. Beside the border three of
    // eight rays are noisy: uniform within 0.693 of 1, they are all within 0.02 of 1,
    // and so get fewer than 8 rays, once in 1000 seeds for 30 such pixels.
    const auto seen = render_adaptive(Halves{.left = 0}, Camera{}, square(32, 9),
                                      {.first = 1, .more = 8, .disagreement = 0.01});
    for (int y = 1; y < 31; ++y)
        for (int x = 0; x < 32; ++x)
            CHECK(pixel(seen.rays, x, y).x == (x < 15 ? 1 : 9));
    // A pixel that is alone has no neighbour that agrees.
    CHECK(render_adaptive(Halves{}, Camera{}, square(1, 10),
                          {.first = 2, .more = 8, .disagreement = 9})
              .counts.camera_rays == 10);
    // The error of single rays is that of the rays around: without edges it is right,
    // 0.16 / 1.01, known by 4096 pixels within 3 %.
    const auto flat =
        render_adaptive(Halves{0.4f, 0.4f}, Camera{}, square(64, 2),
                        {.first = 1, .more = 1, .batches = 0, .disagreement = 9});
    CHECK(flat.counts.camera_rays == 64 * 64);
    CHECK(near(flat.estimate, 0.16 / 1.01, 0.12));
}

TEST_CASE("adaptive: as many more rays as the root of the variance says") {
    // Two blocks, each with four first rays of mean 1 that decide about the other one.
    const auto more = [](double deviation) {
        std::vector<detail::AdaptiveBlock> blocks;
        for (int i = 0; i < 2; ++i)
            blocks.push_back(
                {.x = i,
                 .right = i + 1,
                 .bottom = 1,
                 .rays = 4,
                 .batches = 1,
                 .sum = Rgb{4},
                 .squares = Rgb(RgbT<double>{4 + 3 * 1.01 * deviation * deviation})});
        const AdaptiveSettings rule{.first = 4, .more = 9, .disagreement = 0.3};
        const bool any = detail::plan_round(blocks, rule, 100);
        CHECK(any == (blocks[0].wanted > 0));
        CHECK(blocks[0].wanted == blocks[1].wanted);
        CHECK(blocks[0].variance == doctest::Approx(deviation * deviation));
        return blocks[0].wanted * blocks[0].more;
    };
    CHECK(more(0.03) == 0);
    CHECK(more(0.04) == 1);
    CHECK(more(0.11) == 3);
    CHECK(more(0.29) == 8);
    CHECK(more(0.31) == 9);
    CHECK(more(5) == 9);
}

TEST_CASE("adaptive: a picture in bands is the picture in one piece") {
    // Bands of 4096 pixels per thread, of 16384 at least: with 64 threads one is all.
    const auto picture = [](int width, int height, int threads) {
        RenderSettings all{.width = width, .height = height, .samples = 6};
        all.threads = threads;
        return all;
    };
    const auto bands = [&](int width, int height, int threads, int block) {
        const AdaptiveSettings rule{.more = 4, .batches = 1, .block = block};
        AdaptiveSettings around = rule;
        around.disagreement = 0.1;
        around.first = 2;
        return detail::rows_in_band(picture(width, height, threads), around);
    };
    CHECK(bands(100, 1000, 1, 1) == 163);
    CHECK(bands(100, 1000, 1, 3) == 54);
    CHECK(bands(100, 1000, 64, 1) == 1000);
    CHECK(bands(100000, 3, 1, 1) == 1); // wider than a band
    for (const auto& [width, height, block] :
         {std::array{100, 500, 1}, {20000, 7, 1}, {100, 500, 3}, {1, 40000, 1}}) {
        const AdaptiveSettings rule{
            .first = 2, .more = 4, .batches = 1, .block = block, .disagreement = 0.3};
        const Spot spot{0.02f};
        const auto parts =
            render_adaptive(spot, Camera{}, picture(width, height, 1), rule);
        const auto whole =
            render_adaptive(spot, Camera{}, picture(width, height, 64), rule);
        CHECK(same_bytes(parts.image, whole.image));
        CHECK(same_bytes(parts.rays, whole.rays));
        CHECK(parts.estimate == whole.estimate);
        CHECK(parts.counts.camera_rays == whole.counts.camera_rays);
        CHECK(mean_of(parts.rays) > 2);
        CHECK(mean_of(parts.rays) < 6);
    }
}

TEST_CASE("adaptive: the variance of the first rays around decides, not one's own") {
    const AdaptiveSettings rule{.first = 3, .disagreement = 1, .epsilon = 0.25};
    for (const auto& [columns, rows] : {std::pair{7, 4}, {1, 6}, {3, 1}, {2, 2}}) {
        std::vector<detail::AdaptiveBlock> blocks;
        std::vector<std::array<double, 6>> rays; // of two pixels
        for (int i = 0; i < columns * rows; ++i) {
            detail::AdaptiveBlock block{.x = 2 * (i % columns),
                                        .y = i / columns,
                                        .right = 2 * (i % columns) + 2,
                                        .bottom = i / columns + 1};
            rays.emplace_back();
            for (int k = 0; k < 6; ++k) {
                const double x = (i * 37 + k * 11) % 29; // no order
                rays.back()[std::size_t(k)] = x;
                block.sum += Rgb(RgbT<double>{x, 2 * x, 0});
                block.squares += Rgb(RgbT<double>{x * x, 4 * x * x, 0});
            }
            blocks.push_back(block);
        }
        std::vector<detail::RayShare> parts(blocks.size());
        detail::set_variances_around(parts, blocks, rule);
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            double n = 0, mean = 0, square = 0;
            for (const bool first : {true, false}) {
                for (std::size_t k = 0; k < blocks.size(); ++k) {
                    if (k == i || std::abs(blocks[k].x - blocks[i].x) > 2 ||
                        std::abs(blocks[k].y - blocks[i].y) > 1)
                        continue;
                    for (const double x : rays[k])
                        first ? (n += 1, mean += x) : square += (x - mean) * (x - mean);
                }
                if (first) mean /= n;
            }
            const double variance = square / (n - 1);
            CHECK(parts[i].variance ==
                  doctest::Approx((variance / (mean * mean + 0.25) +
                                   4 * variance / (4 * mean * mean + 0.25)) /
                                  3));
        }
    }
}

TEST_CASE("adaptive: choosing by the rays that are averaged is biased, as foretold; "
          "by its neighbours' rays a pixel is not") {
    // A spot that a ray sees with chance p. The first two agree on 0 or 1, or disagree
    // and get 8 more: the mean is p^2 + 2 p (1 - p) (1 + 8 p) / 10, and not p. Its
    // standard error over 128 x 128 pixels is below 0.3 / 128: 5 of them are allowed.
    // For the neighbours a pixel has its first rays at least: 5 sqrt(p / first) / 128.
    const RenderSettings picture = square(128, 10);
    for (const double p : {0.1, 0.03, 0.01}) {
        const AdaptiveSettings own{.first = 2, .more = 8, .batches = 1, .target = 1e-9};
        const Spot spot{float(p)};
        const double biased =
            mean_of(render_adaptive(spot, Camera{}, picture, own).image);
        const double foretold = p * p + 2 * p * (1 - p) * (1 + 8 * p) / 10;
        CHECK(std::abs(biased - foretold) < 0.012);
        CHECK(foretold < 0.5 * p); // more than half of the light is lost
        for (const int first : {1, 2}) {
            const auto seen =
                render_adaptive(spot, Camera{}, picture,
                                {.first = first, .more = 8, .disagreement = 0.01});
            CHECK(std::abs(mean_of(seen.image) - p) < 5 * std::sqrt(p / first) / 128);
            CHECK(mean_of(seen.rays) < first + 8); // some pixels have no more
        }
    }
    // Judged in large blocks, which see it all: hardly any bias.
    const double in_blocks =
        mean_of(render_adaptive(
                    Spot{}, Camera{}, picture,
                    {.first = 2, .more = 8, .batches = 1, .block = 32, .target = 1e-9})
                    .image);
    CHECK(std::abs(in_blocks - 0.1) < 0.012);
}

TEST_CASE("adaptive: in two stages there is no bias") {
    // The same spot, judged pixel by pixel: n depends on the first rays alone, which
    // are forgotten. The mean over 16 seeds has a standard error of at most
    // 0.3 / sqrt(2 * 16 * 64^2) = 0.0008; 5 of them are allowed.
    double mean = 0, few = 0;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        const auto seen = render_adaptive(Spot{}, Camera{}, square(64, 12, seed),
                                          {.first = 4, .more = 2, .two_stage = true});
        mean += mean_of(seen.image) / 16;
        CHECK(mean_of(seen.rays) <= 12);
        for (const Rgb& rays : seen.rays.pixels) few += rays.x < 6;
    }
    CHECK(std::abs(mean - 0.1) < 0.004);
    CHECK(few == 0); // a batch of two at least, and the four
    // The target, by one division of the rays: 0.01 / n and 0.16 / n.
    const auto seen =
        render_adaptive(Halves{}, Camera{}, square(64, 1000),
                        {.block = 8, .target = 0.0004, .two_stage = true});
    const double error = rel_mse(seen.image, make_image(64, 64, Rgb{1}));
    CHECK(near(error, 0.0004, 0.15));
    CHECK(near(double(pixel(seen.rays, 60, 20).x), 248 + 16, 0.15));
}

TEST_CASE("adaptive: black, not a number, one pixel, narrow pictures") {
    const auto black =
        render_adaptive(Halves{0, 0, 0}, Camera{}, square(9, 100), {.target = 0.01});
    CHECK(black.estimate == 0);
    CHECK(black.reached);
    CHECK(mean_of(black.rays) == 16);
    const auto broken =
        render_adaptive(Broken{}, Camera{}, square(20, 64), {.target = 1e-6});
    CHECK(broken.counts.rejected > 20 * 20 * 10);
    for (const Rgb& c : broken.image.pixels) CHECK(is_finite(c));
    for (const int width : {1, 7})
        for (const int block : {1, 3, 1000}) {
            const auto seen = render_adaptive(
                Halves{}, Camera{}, {.width = width, .height = 1, .samples = 64},
                {.block = block, .target = 0.001});
            CHECK(seen.image.width == width);
            for (const Rgb& c : seen.image.pixels) CHECK(is_finite(c));
        }
}

TEST_CASE("adaptive: progress goes up to the end, and stops it") {
    long long last = -1, total = 0;
    int falls = 0;
    auto watch = [&](long long done, long long all) {
        falls += done < last;
        last = done;
        total = all;
        return true;
    };
    RenderSettings picture = square(24, 64);
    picture.progress = watch;
    CHECK(render_adaptive(Halves{}, Camera{}, picture, {.target = 0.001}).complete);
    CHECK(falls == 0);
    CHECK(last == total);
    CHECK(total == 24 * 24 * 64);
    auto stop = [&](long long done, long long) { return done < 24 * 24 * 8; };
    picture.progress = stop;
    picture.threads = 1;
    const auto stopped = render_adaptive(Halves{}, Camera{}, picture, {});
    CHECK_FALSE(stopped.complete);
    for (const Rgb& c : stopped.image.pixels) CHECK(is_finite(c));
    // What is done counts in rays, within a round too: 64 pixels at a time have their
    // first 16, and five times that is the first above 24 * 24 * 8.
    CHECK(stopped.counts.camera_rays == 5 * 64 * 16);
}

TEST_CASE("adaptive: a rule without sense is refused with its value") {
    const auto refused = [](const AdaptiveSettings& rule, int samples,
                            const char* sentence) {
        CHECK_THROWS_WITH_AS(
            (void)render_adaptive(Halves{}, Camera{}, square(4, samples), rule),
            sentence, std::invalid_argument);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    refused({.first = 1}, 64, "first is 1; it must be at least 2.");
    refused({.first = 0, .disagreement = 1}, 64, "first is 0; it must be at least 1.");
    refused({.first = 1, .target = 0.1, .disagreement = 1}, 64,
            "first is 1; it must be at least 2.");
    refused({.more = 0}, 64, "more is 0; it must be at least 1.");
    refused({.batches = -1}, 64, "batches is -1; it must be at least 0.");
    refused({.block = 0}, 64, "block is 0; it must be at least 1.");
    refused({.target = -0.1}, 64, "target is -0.1; it must be at least 0.");
    refused({.target = nan}, 64, "target is NaN; it must be at least 0.");
    refused({.disagreement = -1}, 64, "disagreement is -1; it must be at least 0.");
    refused({.epsilon = 0}, 64, "epsilon is 0; it must be finite and above 0.");
    refused({.epsilon = HUGE_VAL}, 64,
            "epsilon is infinity; it must be finite and above 0.");
    refused({.first = 2, .two_stage = true}, 17,
            "samples is 17; it must be at least first + more.");
    refused({.disagreement = 0.1, .two_stage = true}, 64,
            "disagreement is 0.1; it must be 0 with two_stage.");
    refused({.more = 1, .two_stage = true}, 64, "more is 1; it must be at least 2.");
    refused({.batches = 0, .two_stage = true}, 64,
            "batches is 0; it must be at least 1.");
    refused({}, 15,
            "samples is 15; it must be at least first, the first rays of a pixel.");
    refused({.two_stage = true}, 31,
            "samples is 31; it must be at least first + more.");
}

TEST_CASE("adaptive: the relative variance of a block, by hand and in colours") {
    // Two pixels of a row of three, five rays each: of each channel the means of mean
    // and variance over both, then the quotient, and its mean.
    detail::RowSums sums{.width = 3, .pixels = std::vector<detail::PixelSums>(6)};
    const double rays[2][3][5] = {{{1, 2, 3, 4, 5}, {0, 0, 0, 0, 0}, {2, 2, 2, 2, 7}},
                                  {{1, 1, 1, 1, 2}, {9, 0, 0, 0, 0}, {3, 3, 3, 3, 3}}};
    double mean[3] = {}, variance[3] = {};
    for (int p = 0; p < 2; ++p)
        for (int c = 0; c < 3; ++c) {
            double m = 0, v = 0;
            for (const double x : rays[p][c]) {
                sums.pixels[std::size_t(4 + p)].sum[c] += x;
                sums.pixels[std::size_t(4 + p)].squares[c] += x * x;
                m += x / 5;
            }
            for (const double x : rays[p][c]) v += (x - m) * (x - m) / 4;
            mean[c] += m / 2;
            variance[c] += v / 2;
        }
    detail::AdaptiveBlock block{.x = 1, .y = 1, .right = 3, .bottom = 2, .rays = 5};
    CHECK(block.pixels() == 2);
    double right = 0;
    for (int c = 0; c < 3; ++c) right += variance[c] / (mean[c] * mean[c] + 0.25) / 3;
    CHECK(detail::relative_variance(block, sums, 0.25) ==
          doctest::Approx(right).epsilon(1e-12));
    // Every channel by itself.
    for (int c = 0; c < 3; ++c) {
        detail::RowSums one{.width = 3, .pixels = std::vector<detail::PixelSums>(6)};
        for (const std::size_t p : {4u, 5u}) {
            one.pixels[p].sum[c] = sums.pixels[p].sum[c];
            one.pixels[p].squares[c] = sums.pixels[p].squares[c];
        }
        CHECK(detail::relative_variance(block, one, 0.25) ==
              doctest::Approx(variance[c] / (mean[c] * mean[c] + 0.25) / 3));
    }
    block.rays = 0;
    CHECK(detail::relative_variance(block, sums, 0.25) == 0); // not NaN
}

TEST_CASE("adaptive: a sample counts with its weight, squared in the squares") {
    // The weights of Mitchell's filter differ, and some are below 0.
    struct Plain {};
    std::vector<detail::PixelSums> sums(2);
    Counts cost;
    const Plain renderer;
    detail::SampleSums<Plain, float> samples(renderer, sums, cost);
    for (const auto& [weight, light] : {std::pair{2.0f, 3.0f}, {-0.5f, 8.0f}})
        samples.add(1, [&, w = weight, x = light](auto&) {
            return PixelSampleT<float>{{x, 2 * x, 0}, w};
        });
    samples.finish();
    CHECK(sums[0].sum == RgbT<double>{0, 0, 0});
    CHECK(sums[1].sum == RgbT<double>{6 - 4, 12 - 8, 0});
    CHECK(sums[1].squares == RgbT<double>{36 + 16, 144 + 64, 0});
    CHECK(cost.rejected == 0);
}

TEST_CASE("adaptive: what is left goes to the largest errors first") {
    // Of four blocks of one pixel with ten rays each, and ten rays to spare.
    const double variances[] = {1, 9, 4, 0};
    for (const double disagreement : {0.0, 0.1}) {
        std::vector<detail::AdaptiveBlock> blocks;
        for (int i = 0; i < 4; ++i)
            blocks.push_back({.x = i,
                              .right = i + 1,
                              .bottom = 1,
                              .rays = 10,
                              .variance = variances[i],
                              .sum = Rgb{10},
                              .squares = Rgb(RgbT<double>{10 + 9 * variances[i]})});
        const AdaptiveSettings rule{
            .first = 10, .more = 5, .disagreement = disagreement};
        REQUIRE(detail::plan_round(blocks, rule, 12.5));
        // By shares those get a batch that lie above what they have. By disagreement
        // the variances of the rays around are 9, (1 + 4) 9 / 19, (9 + 0) 9 / 19, 4.
        const int first = disagreement > 0 ? 0 : 1;
        CHECK(blocks[std::size_t(first)].wanted >= 1);
        CHECK(blocks[3].wanted == 0);
        CHECK(blocks[std::size_t(first)].wanted + blocks[2].wanted == 2);
        CHECK(blocks[std::size_t(1 - first)].wanted == 0);
        if (disagreement > 0) CHECK(blocks[2].wanted == 1);
        CHECK_FALSE(detail::plan_round(blocks, rule, 10)); // nothing to spare
    }
    // A part that is settled has its error and its rays, in its own size.
    using Parts = std::vector<detail::RayShare>;
    const auto rest = detail::ray_shares(Parts{{3, 2, 1000}, {1, 16, 1}}, 0.01, 1e9);
    CHECK(rest[0] == 1000);
    CHECK(rest[1] == doctest::Approx(16 / (0.04 - 3 * 2 / 1000.0)));
    const auto limited = detail::ray_shares(Parts{{3, 0.01, 50}, {1, 16, 1}}, 0, 100);
    CHECK(limited[0] == 50);
    CHECK(limited[1] == doctest::Approx(4 * 100 - 3 * 50));
}

TEST_CASE("adaptive: batches fit into what is left, and double at most") {
    const auto plan = [](std::vector<detail::AdaptiveBlock> blocks,
                         const AdaptiveSettings& rule, double limit) {
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            blocks[i].x = int(i);
            blocks[i].right = int(i) + 1;
            blocks[i].bottom = 1;
        }
        (void)detail::plan_round(blocks, rule, limit);
        std::vector<int> wanted;
        for (const auto& block : blocks) wanted.push_back(block.wanted);
        return wanted;
    };
    using Wanted = std::vector<int>;
    for (const double disagreement : {0.0, 0.1}) {
        const AdaptiveSettings rule{
            .first = 10, .more = 5, .disagreement = disagreement};
        // Seven rays to spare, and nine: one batch of five. Ten: two.
        for (const auto& [spare, batches] : {std::pair{7, 1}, {9, 1}, {10, 2}}) {
            std::vector<detail::AdaptiveBlock> blocks;
            for (const double variance : {9.0, 8.0})
                blocks.push_back({.rays = 10,
                                  .batches = 1,
                                  .variance = variance,
                                  .squares = Rgb(RgbT<double>{9 * variance})});
            const Wanted given = plan(blocks, rule, 10 + spare / 2.0);
            CHECK(given[0] + given[1] == batches);
            // By disagreement each block has the other one's variance.
            if (disagreement > 0)
                CHECK(given[1] >= given[0]);
            else
                CHECK(given[0] >= given[1]);
        }
    }
    // The error is variance over rays: 9 / 90 is less than 4 / 10.
    CHECK(plan({{.rays = 90, .batches = 17, .variance = 9},
                {.rays = 10, .batches = 1, .variance = 4}},
               {.first = 10, .more = 5}, 52.5) == Wanted{0, 1});
    // As many more as there are, at most, however large the share would be.
    const AdaptiveSettings fives{.first = 10, .more = 5};
    for (const int rays : {10, 20, 40})
        CHECK(plan({{.rays = rays, .batches = rays / 5 - 1, .variance = 1}}, fives,
                   1e4) == Wanted{rays / 5});
    // 2 / 0.1 are twenty rays, five more; a hair above them is rounding, and no batch.
    CHECK(plan({{.rays = 15, .batches = 2, .variance = 2}},
               {.first = 10, .more = 5, .target = 0.1}, 1e4) == Wanted{1});
    // Of two stages the second brings all of it at once, its first batch included.
    CHECK(plan({{.rays = 10, .batches = 1, .variance = 1}},
               {.first = 10, .more = 5, .two_stage = true}, 1000) == Wanted{200});
    // As many batches as are allowed, at most; those that it has had are counted.
    CHECK(plan({{.rays = 20, .batches = 3, .variance = 1}},
               {.first = 10, .more = 5, .batches = 3}, 1e4) == Wanted{1});
    CHECK(plan({{.rays = 10, .batches = 1, .variance = 1}},
               {.first = 10, .more = 5, .batches = 3, .two_stage = true},
               1e4) == Wanted{3});
}

TEST_CASE(
    "adaptive: the estimate is the variance over mean^2 + epsilon, and the rays") {
    // Two variances of uniform noise, as many pixels of each: 4096 pixels of 64 rays
    // know them within sqrt(0.8 / 64 / 2048) = 0.25 %.
    for (const double epsilon : {0.01, 3.0})
        for (const int block : {4, 8}) {
            const auto seen =
                render_adaptive(Halves{}, Camera{}, square(64, 64),
                                {.first = 64, .block = block, .epsilon = epsilon});
            CHECK(near(seen.estimate, 0.085 / (1 + epsilon) / 64, 0.02));
            CHECK_FALSE(seen.reached); // no target, none reached
        }
    // Where rays do not differ at all, even an error of 0 is reached.
    const Halves even{.left = 0, .right = 0};
    const auto seen = render_adaptive(even, Camera{}, square(4, 16));
    CHECK(seen.estimate == 0);
    CHECK(seen.reached);
}

TEST_CASE(
    "adaptive: of two stages the second is traced, whatever the first has found") {
    // The target is reached at once: a batch of 8 for all, and the 16 are forgotten. A
    // variance by 8 rays of 512 pixels is known within 1.6 %.
    int calls = 0;
    auto watch = [&](long long, long long) { return ++calls < 100000; };
    RenderSettings picture = square(32, 64);
    picture.progress = watch;
    const auto seen =
        render_adaptive(Halves{}, Camera{}, picture,
                        {.more = 8, .block = 8, .target = 10, .two_stage = true});
    REQUIRE(seen.complete);
    for (const Rgb& rays : seen.rays.pixels) CHECK(rays == Rgb{24});
    CHECK(seen.counts.camera_rays == 32 * 32 * 24);
    CHECK(seen.reached);
    CHECK(near(seen.estimate, 0.085 / 1.01 / 8, 0.08)); // of those that count
    // One stage has enough with its first rays, and says so at the end.
    long long last = 0, total = 0;
    auto told = [&](long long done, long long all) {
        last = done;
        total = all;
        return true;
    };
    picture.progress = told;
    const auto once = render_adaptive(Halves{}, Camera{}, picture, {.target = 10});
    for (const Rgb& rays : once.rays.pixels) CHECK(rays == Rgb{16});
    CHECK(once.reached);
    CHECK(last == total);
    CHECK(total == 32 * 32 * 64);
}

TEST_CASE("adaptive: what is meant where nothing is said") {
    const AdaptiveSettings silent;
    CHECK(silent.first == 16);
    CHECK(silent.more == 16);
    CHECK(silent.batches == 1000);
    CHECK(silent.block == 1);
    CHECK(silent.target == 0);
    CHECK(silent.disagreement == 0);
    CHECK(silent.epsilon == 0.01);
    CHECK_FALSE(silent.two_stage);
    const AdaptiveT<float> nothing;
    CHECK_FALSE(nothing.reached);
    CHECK(nothing.complete);
    const detail::RayShare part;
    CHECK(part.pixels == 1);
    CHECK(part.rays == 1);
}
