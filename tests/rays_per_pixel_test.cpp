// What a ray buys, in a room with a matt ball. Slopes and ratios of variances: the
// bands are stated with the standard error that several sets of seeds showed. Run with
// 20 further ones: none failed.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "common/convergence.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "support/rooms.hpp"
#include "support/seed.hpp"

using namespace ljus;

namespace {

constexpr int seeds = 8;

/// The variance of pictures of some rays per pixel, over seeds.
template <typename Renderer>
double variance_of(const Renderer& renderer, int rays, Sampling sampling) {
    std::vector<Image> runs;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
        runs.push_back(render(renderer, ljus_test::room_camera<float>(),
                              {.width = 24,
                               .height = 24,
                               .samples = rays,
                               .seed = ljus_test::test_seed(seed),
                               .threads = 1,
                               .sampling = sampling})
                           .image);
    return bias_variance(runs, runs[0]).variance;
}

} // namespace

TEST_CASE("rays_per_pixel: the slope of a power law, and how sure it is") {
    std::vector<double> x, y;
    for (const double n : {1.0, 4.0, 16.0, 64.0}) {
        x.push_back(n);
        y.push_back(3 / n);
    }
    CHECK(examples::fit_power(x, y).slope == doctest::Approx(-1));
    CHECK(examples::fit_power(x, y).error == doctest::Approx(0).epsilon(1e-6));
    // Off the line by e^(+-0.1) in turn. About the middle log x is (-3, -1, 1, 3) log
    // 2: the slope moves by 0.1 (-3 + 1 + 1 - 3) / (20 log 2) = -0.02 / log 2, and what
    // is left is a square sum of 0.04 - 20 (0.02)^2 = 0.032 over two degrees of
    // freedom.
    for (std::size_t i = 0; i < 4; ++i) y[i] *= std::exp(i % 2 == 0 ? 0.1 : -0.1);
    const auto law = examples::fit_power(x, y);
    const double step = std::log(2.0);
    CHECK(law.slope == doctest::Approx(-1 - 0.02 / step));
    CHECK(law.error == doctest::Approx(std::sqrt(0.032 / 2 / (20 * step * step))));
    // Two points have a slope, and nothing that tells its error.
    CHECK(std::isnan(examples::fit_power({1, 2}, {1, 0.5}).error));
    CHECK(std::isnan(examples::fit_power({1}, {1}).slope));
}

TEST_CASE("rays_per_pixel: sixteen times the rays, a sixteenth of the variance") {
    const auto room = ljus_test::make_room<float>(ljus_test::Ball::lambertian,
                                                  ljus_test::Lamp::quad, 1);
    const PathTracer tracer(room);
    // Of independent rays. A ratio of two such variances, over 576 pixels and 8 seeds,
    // scatters by some 4 %: a fifth is 5 standard errors.
    const double few = variance_of(tracer, 4, Sampling::random);
    const double many = variance_of(tracer, 64, Sampling::random);
    CHECK(std::abs(few / many - 16) < 3.2);
    // Strata are never worse, and edges within a pixel gain.
    CHECK(variance_of(tracer, 64, Sampling::multi_jittered) < 1.1 * many);
}

TEST_CASE("rays_per_pixel: rays do not take away the noise of photons") {
    const auto room = ljus_test::make_room<float>(ljus_test::Ball::lambertian,
                                                  ljus_test::Lamp::quad, 1);
    const auto variances = [&](int rays) {
        std::vector<Image> one_map, own_maps;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed)
            for (const bool own : {false, true}) {
                PhotonMappingSettings settings{.indirect = IndirectLight::photons};
                settings.general.photons = 1000;
                settings.general.seed = ljus_test::test_seed(own ? seed : 1);
                settings.general.threads = 1;
                (own ? own_maps : one_map)
                    .push_back(render(PhotonMapper(room, settings), Camera{},
                                      {.width = 16,
                                       .height = 16,
                                       .samples = rays,
                                       .seed = ljus_test::test_seed(seed),
                                       .threads = 1})
                                   .image);
            }
        const double rays_alone = bias_variance(one_map, one_map[0]).variance;
        const double all = bias_variance(own_maps, own_maps[0]).variance;
        return std::pair{rays_alone, all - rays_alone};
    };
    const auto [rays_few, photons_few] = variances(2);
    const auto [rays_many, photons_many] = variances(16);
    CHECK(rays_many < rays_few / 4);
    // The photons' part stays: within a third, of which the noise of the rays in the
    // first of the two is the largest share.
    CHECK(photons_many > 0);
    CHECK(std::abs(photons_many / photons_few - 1) < 0.35);
    CHECK(photons_many > rays_many); // from here on more rays are of no use
}
