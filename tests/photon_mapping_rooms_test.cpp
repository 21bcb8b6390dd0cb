// long: 16 pictures of each of 18 rooms, three quarters of a minute
// concept: photon_mapping
/// \file photon_mapping_rooms_test.cpp
/// \brief Photon mapping against path tracing, in rooms with each material and light.
///
/// What chance allows is told by the scatter of 16 to 40 seeds, with Student's t for as
/// many as there are (support/student.hpp). How many checks there are, and how rare a
/// distance has to be to fail one:
///
///     1088 blocks of 18 rooms                      1e-8 each
///     54 means of their channels                   1e-7 each
///     how many of the blocks are rarer than 0.0027: 3 are expected, 16 allowed
///     two sums over all rooms                      1e-6 each
///
/// Together a false alarm comes once in 50 000 runs. All were run with 20 further seeds
/// (`./scripts/test --seeds 20`): none failed.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "support/light_tracer.hpp"
#include "support/mean.hpp"
#include "support/rooms.hpp"
#include "support/student.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

constexpr int size = 80;  // pixels on a side
constexpr int block = 10; // of them, on the side of a block
constexpr int blocks = (size / block) * (size / block);
constexpr int seeds = 16; // of the photon mapper

/// The means of the blocks and of the whole picture, over several seeds.
struct Blocks {
    std::vector<Mean> of_block = std::vector<Mean>(blocks);
    Mean of_channel[3];

    /// Takes one picture; only the pixels of the mask count.
    template <typename T>
    void add(const ImageT<T>& image, const std::vector<bool>& mask) {
        std::vector<double> sum(blocks), count(blocks);
        glm::dvec3 all(0);
        double pixels = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                if (!mask[static_cast<std::size_t>(y * size + x)]) continue;
                const auto b =
                    static_cast<std::size_t>(y / block * (size / block) + x / block);
                const glm::dvec3 value(pixel(image, x, y));
                sum[b] += (value.x + value.y + value.z) / 3;
                count[b] += 1;
                all += value;
                pixels += 1;
            }
        for (std::size_t b = 0; b < sum.size(); ++b)
            if (count[b] >= 30) of_block[b].add(sum[b] / count[b]);
        for (int c = 0; c < 3; ++c) of_channel[c].add(all[c] / pixels);
    }
};

/// How often the blocks of two pictures of the same would be as far apart.
struct Distances {
    int count = 0;
    int rare = 0; ///< Of them, with a chance below 0.0027: normal ones' 3 errors.
    double least = 1;
    std::size_t at = 0; ///< The block with that chance.

    void add(const Blocks& a, const Blocks& b) {
        for (std::size_t i = 0; i < a.of_block.size(); ++i) {
            if (a.of_block[i].count < 2) continue;
            const double chance = chance_of(a.of_block[i], b.of_block[i]);
            ++count;
            rare += chance < 0.0027 ? 1 : 0;
            if (chance < least) least = chance, at = i;
        }
    }
};

} // namespace

// Each ball under each kind of lamp, and three of them under two lamps. The errors come
// from 16 seeds of the photon mapper and 20 to 40 of the reference. A mean is known to
// 0.1 to 0.4 %; what all rooms had in common would show from 0.3 % on: their own mean,
// and Fisher's sum of the logarithms of all chances, which has chi-square.
TEST_CASE("photon mapping: equals path tracing, material by material and light by "
          "light") {
    const Camera camera = room_camera<float>();
    Distances all;
    int rooms = 0;
    double surprise = 0, off = 0, off_variance = 0; // of the rooms' green means
    std::uint64_t cell = 0;                         // each has seeds of its own
    for (const Lamp lamp : {Lamp::quad, Lamp::sphere, Lamp::point})
        for (const Ball ball : {Ball::lambertian, Ball::oren_nayar, Ball::mirror,
                                Ball::glass, Ball::mixture})
            for (const int lamps : {1, 2}) {
                if (lamps == 2 && !(lamp == Lamp::quad     ? ball == Ball::glass
                                    : lamp == Lamp::sphere ? ball == Ball::mixture
                                                           : ball == Ball::mirror))
                    continue;
                const ClosedRoom room = make_room<float>(ball, lamp, lamps);
                std::vector<bool> mask(size * size, true);
                Blocks mapped, traced;
                const std::uint64_t first = 1000 * ++cell;
                const bool light_tracer = lamp == Lamp::point;
                const bool matt = ball == Ball::lambertian || ball == Ball::oren_nayar;
                const int reference_seeds = light_tracer ? 40 : matt ? 20 : 36;
                const int rays =
                    matt ? 2 : 4; // there is little noise without a caustic
                if (light_tracer) mask = matt_pixels(room, camera, size, size);
                for (int seed = 1; seed <= reference_seeds; ++seed) {
                    const auto s = first + 500 + static_cast<std::uint64_t>(seed);
                    if (light_tracer)
                        traced.add(
                            trace_light(room, camera, size, size, 27000, test_seed(s)),
                            mask);
                    else
                        traced.add(render(PathTracer(room), camera,
                                          {.width = size,
                                           .height = size,
                                           .samples = rays,
                                           .seed = test_seed(s),
                                           .threads = 1})
                                       .image,
                                   mask);
                }
                for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
                    PhotonMappingSettings settings;
                    settings.caustics = {
                        .photons = 30000, .seed = test_seed(seed), .threads = 1};
                    settings.caustics_estimate = {.radius = 0.03f};
                    const PhotonMapper mapper(room, settings);
                    mapped.add(render(mapper, camera,
                                      {.width = size,
                                       .height = size,
                                       .samples = rays,
                                       .seed = test_seed(seed),
                                       .threads = 1})
                                   .image,
                               mask);
                }
                Distances here;
                here.add(mapped, traced);
                all.add(mapped, traced);
                CAPTURE(name(ball));
                CAPTURE(name(lamp));
                CAPTURE(lamps);
                CAPTURE(here.at);
                CHECK(here.least > 1e-8);
                for (int c = 0; c < 3; ++c) {
                    const Mean& a = mapped.of_channel[c];
                    const Mean& b = traced.of_channel[c];
                    const double error = std::hypot(a.error(), b.error()) / b.mean;
                    const double chance = chance_of(a, b);
                    CHECK(chance > 1e-7);
                    if (c != 1) continue;
                    ++rooms;
                    surprise -= 2 * std::log(chance);
                    off += a.mean / b.mean - 1;
                    off_variance += error * error;
                }
            }
    const double off_error = std::sqrt(off_variance);
    CHECK(all.count >= 1000);
    CHECK(all.rare <= 16);
    CHECK(rooms == 18);
    CHECK(surprise < chi_square_limit(2 * rooms));
    CHECK(std::abs(off) < once_in_a_million * off_error);
    CHECK(off_error < 0.001 * rooms); // it is a comparison
}
