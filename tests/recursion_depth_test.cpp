// Furnaces, whose light is known to all depths. Comparisons of random numbers are at 5
// standard errors: one of the four is a false alarm in half a million runs. Run with
// 20 further seeds: none failed. For others: `./scripts/test --seeds 20`.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "experiments/ended_paths.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scenes/furnaces.hpp"
#include "support/mean.hpp"

using namespace ljus;
using examples::Ending;

namespace {

/// What the pixels of a picture have found, green.
template <typename Renderer>
ljus_test::Mean pixels_of(const Renderer& renderer, const Camera& camera, int rays) {
    const auto seen = render(renderer, camera,
                             {.width = 16,
                              .height = 16,
                              .samples = rays,
                              .seed = ljus_test::test_seed(1),
                              .threads = 1});
    ljus_test::Mean mean;
    for (const Rgb& c : seen.image.pixels) mean.add(double(c.y));
    return mean;
}

/// Light up to some bounce: 1 + a + ... + a^depth.
double light_to(double albedo, int depth) {
    return (1 - std::pow(albedo, depth + 1)) / (1 - albedo);
}

} // namespace

TEST_CASE("recursion_depth: a limit of d surfaces loses albedo^(d + 1) of all light") {
    for (const float albedo : {0.3f, 0.75f, 0.9f}) {
        const auto room = sphere_furnace<float>(Rgb{1}, Rgb{albedo});
        for (const int depth : {1, 2, 4, 8, 30}) {
            const double right = light_to(double(albedo), depth);
            // All paths are alike in a sphere: no noise but rounding.
            const auto ended =
                pixels_of(examples::make_ended_paths(room.world, Ending::depth, depth),
                          room.camera, 2);
            CHECK(ended.mean == doctest::Approx(right).epsilon(1e-3));
            // The path tracer of the library, which shares the lamp by its weights.
            const PathTracer tracer(room.world,
                                    {.max_depth = depth,
                                     .roulette_depth = 1000,
                                     .heuristic = MisHeuristic::shadow_rays});
            CHECK(pixels_of(tracer, room.camera, 2).mean ==
                  doctest::Approx(right).epsilon(1e-3));
        }
    }
}

TEST_CASE("recursion_depth: a threshold loses what comes after it is crossed") {
    for (const float albedo : {0.3f, 0.75f, 0.9f})
        for (const double threshold : {0.5, 0.1, 0.01}) {
            // After k surfaces a path carries albedo^k: the first k below it is the
            // last.
            int last = 1;
            while (std::pow(double(albedo), last) >= threshold) ++last;
            const auto room = sphere_furnace<float>(Rgb{1}, Rgb{albedo});
            const auto ended = pixels_of(
                examples::make_ended_paths(room.world, Ending::threshold, 0, threshold),
                room.camera, 2);
            CHECK(ended.mean ==
                  doctest::Approx(light_to(double(albedo), last)).epsilon(1e-3));
            // What is lost is less than the threshold over 1 - albedo.
            const double all = 1 / (1 - double(albedo));
            CHECK(ended.mean < all);
            CHECK(all - ended.mean < threshold * all);
        }
}

TEST_CASE("recursion_depth: roulette loses nothing, wherever it begins") {
    const auto room = sphere_furnace<float>(Rgb{1}, Rgb{0.75f});
    for (const int from : {1, 4})
        for (const double threshold : {1.0, 0.2}) {
            const auto found =
                pixels_of(examples::make_ended_paths(room.world, Ending::roulette, from,
                                                     threshold),
                          room.camera, 256);
            CHECK(std::abs(found.mean - 4) < 5 * found.error() + 1e-3);
            CHECK(found.error() > 0);
            CHECK(found.error() < 0.05); // sharp enough to tell
        }
}

TEST_CASE("recursion_depth: the depth of the photon mapper ends camera paths") {
    // The same furnace: depth 1 shows the lamp and its light, depth 2 one bounce more.
    const auto room = sphere_furnace<float>(Rgb{1}, Rgb{0.5f});
    for (const int depth : {1, 2, 5}) {
        PhotonMappingSettings settings{.max_depth = depth, .roulette_depth = 1000};
        const PhotonMapper mapper(room.world, settings);
        CHECK(pixels_of(mapper, room.camera, 2).mean ==
              doctest::Approx(light_to(0.5, depth)).epsilon(1e-3));
    }
}
