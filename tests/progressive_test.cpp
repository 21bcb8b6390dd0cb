/// \file progressive_test.cpp
/// \brief Progressive passes against their laws, and checkpoints against kills.
///
/// Of 3 means of 1500 runs, 6 of 64 and 2 of 48, each against its closed form, one is a
/// false alarm in 70 000 runs; by how much they scatter, the runs tell. The statistical
/// cases were run with 20 further seeds: none failed. For others:
/// `./scripts/test --seeds 20`.

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "ljus/io/progressive_file.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/render/budgeting.hpp"
#include "ljus/render/gathering.hpp"
#include "ljus/render/progressive.hpp"
#include "scratch_folder.hpp"
#include "support/draws.hpp"
#include "support/integrate.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"
#include "support/rooms.hpp"
#include "support/student.hpp"
#include "support/within.hpp"

// A child of a program with threads is more than the thread sanitizer can follow; g++
// and clang say by different names that it is there.
#ifdef __has_feature
#if __has_feature(thread_sanitizer)
#define LJUS_TEST_THREAD_SANITIZER
#endif
#endif
#ifdef __SANITIZE_THREAD__
#define LJUS_TEST_THREAD_SANITIZER
#endif
#if __has_include(<sys/wait.h>) && !defined(LJUS_TEST_THREAD_SANITIZER)
#define LJUS_TEST_FORKS
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#endif

using namespace ljus;
using ljus_test::apart;
using ljus_test::chance_of;
using ljus_test::Draws;
using ljus_test::Mean;
using ljus_test::once_in_a_million;
using ljus_test::refusal;
using ljus_test::test_seed;

namespace {

/// A pass that needs no scene: light 1 + bias r^2, and noise that grows as 1/r.
struct NoisyPass {
    int width = 5, height = 3;
    double bias = 0;
    double noise = 1;
    std::uint64_t seed = 1;

    RenderedT<float> operator()(long long pass, double scale) const {
        RenderedT<float> result{.image = make_image<float>(width, height)};
        Draws numbers{seed * 1000003 + std::uint64_t(pass) * 7919};
        for (Rgb& color : result.image.pixels)
            for (int c = 0; c < 3; ++c)
                color[c] = float(1 + bias * scale * scale +
                                 noise / scale * (numbers.unit() - 0.5));
        return result;
    }
};

const auto go_on = [](const ProgressiveState&) { return true; };

/// The state after some passes.
template <typename RenderPass>
ProgressiveState state_after(long long passes, RenderPass&& pass,
                             double alpha = 2.0 / 3) {
    ProgressiveState state{.alpha = alpha};
    CHECK(run_progressive(state, passes, pass, go_on));
    return state;
}

bool same_image(const ImageT<double>& a, const ImageT<double>& b) {
    return a.width == b.width && a.height == b.height &&
           a.pixels.size() == b.pixels.size() &&
           (a.pixels.empty() || std::memcmp(a.pixels.data(), b.pixels.data(),
                                            a.pixels.size() * sizeof a.pixels[0]) == 0);
}

bool same_state(const ProgressiveState& a, const ProgressiveState& b) {
    return a.alpha == b.alpha && a.shrink == b.shrink && a.passes == b.passes &&
           a.block_side == b.block_side && a.first_pass == b.first_pass &&
           a.picture == b.picture && same_image(a.sum, b.sum) &&
           same_image(a.squares, b.squares) &&
           same_image(a.block_squares, b.block_squares);
}

/// A point light under a square mirror, whose light on the floor ends at 0.8.
using Stage =
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Mirror>, Lights<PointLight>>;
World<Stage> window() {
    Stage room;
    room.add(Quad{.corner{-10, 0, -10}, .edge_u{0, 0, 20}, .edge_v{20, 0, 0}},
             room.add(Lambertian{.albedo = Rgb{0.5f}}));
    room.add(
        Quad{.corner{-0.2f, 1.5f, -0.2f}, .edge_u{0.4f, 0, 0}, .edge_v{0, 0, 0.4f}},
        room.add(Mirror{.reflectance = Rgb{1}}));
    room.add(PointLight{.position{0, 1, 0}});
    return World(std::move(room));
}

/// A camera that sees a small patch of that floor around (0, 0, 0).
Camera patch_camera(float degrees = 1) {
    return look_at(View{.position{0.1f, 0.9f, 0},
                        .target{0, 0, 0},
                        .up{0, 0, 1},
                        .vfov_degrees = degrees});
}

/// The kernel's mean of the mirror's irradiance 2 / (d^2 + 4)^(3/2) over a disc.
double blurred(double radius) {
    return ljus_test::integrate(0, 1, 4, [&](double t) { // t = d^2 / r^2
        const double d2 = t * radius * radius + 4;
        return 2 * (1 - t) * 2 / (d2 * std::sqrt(d2));
    });
}

PhotonMappingSettings mirror_light(float radius, long long photons,
                                   std::uint64_t seed) {
    PhotonMappingSettings settings{.indirect = IndirectLight::none};
    settings.caustics = {.photons = photons, .seed = seed, .threads = 1};
    settings.caustics_estimate.radius = radius;
    return settings;
}

/// The shrinking of r^2 up to pass i, by the gamma function.
double closed_shrink(double i, double alpha) {
    return std::exp(std::lgamma(i + alpha) - std::lgamma(1 + alpha) -
                    std::lgamma(i + 1));
}

} // namespace

TEST_CASE("progressive: the radius follows the gamma function") {
    for (const double alpha : {0.01, 1.0 / 3, 2.0 / 3, 1.0}) {
        std::vector<double> scales;
        const auto pass = [&](long long i, double scale) {
            CHECK(i == (long long)(scales.size()) + 1);
            scales.push_back(scale);
            return RenderedT<float>{.image = make_image(1, 1)};
        };
        (void)progressive_mean(3000, pass, alpha);
        REQUIRE(scales.size() == 3000);
        CHECK(scales[0] == 1.0);
        for (const std::size_t i : {2u, 3u, 10u, 100u, 3000u})
            CHECK(scales[i - 1] * scales[i - 1] ==
                  doctest::Approx(closed_shrink(double(i), alpha)).epsilon(1e-10));
        // Both twins ask for the same radii.
        const auto plain = scales;
        scales.clear();
        const auto state = state_after(3000, pass, alpha);
        CHECK(scales == plain);
        CHECK(state.shrink ==
              doctest::Approx(closed_shrink(3001, alpha)).epsilon(1e-10));
    }
}

TEST_CASE("progressive: the mean is that of the passes, added in double") {
    const NoisyPass pass{.noise = 1e-3};
    RgbT<double> sum{0};
    for (long long i = 1; i <= 500; ++i)
        sum += RgbT<double>(
            pass(i, std::sqrt(closed_shrink(double(i), 2.0 / 3))).image.pixels[7]);
    const auto plain = progressive_mean(500, pass);
    const auto state = state_after(500, pass);
    CHECK(plain.pixels[7].x == doctest::Approx(sum.x / 500).epsilon(1e-8));
    CHECK(same_image(plain, mean_image<double>(state)));
    CHECK(mean_image(state).pixels[7].x == float(plain.pixels[7].x));
    // A float sum of 1 and 1e-9 a thousand times would stay at 1.
    const auto tiny = [](long long i, double) {
        return RenderedT<float>{
            .image = make_image<float>(1, 1, Rgb{i == 1 ? 1.0f : 1e-9f})};
    };
    CHECK(state_after(1001, tiny).sum.pixels[0].x ==
          doctest::Approx(1 + 1e-6).epsilon(1e-12));
}

TEST_CASE("progressive: the estimated error is the scatter of many runs") {
    // Of 1500 runs of 15 pixels and 3 channels, 8 passes each. Draws in [-1/2, 1/2)
    // have the variance 1/12; pass i scatters by 1/scale_i more. The bias moves.
    double exact = 0;
    for (int i = 1; i <= 8; ++i) exact += 1 / closed_shrink(i, 2.0 / 3) / 12 / 64;
    double drift = 0; // what the moving expectations add
    std::array<double, 8> expected;
    double middle = 0;
    for (int i = 1; i <= 8; ++i) {
        expected[std::size_t(i - 1)] = 0.3 * closed_shrink(i, 2.0 / 3);
        middle += expected[std::size_t(i - 1)] / 8;
    }
    for (const double x : expected) drift += (x - middle) * (x - middle) / 8 / 7;
    Mean pixels, blocks, scatter;
    for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
        const auto state =
            state_after(8, NoisyPass{.bias = 0.3, .seed = test_seed(seed)});
        const auto error = estimate_error(state);
        pixels.add(error.pixels * error.pixels);
        blocks.add(error.blocks * error.blocks);
        const double off = mean_image<double>(state).pixels[3].y - (1 + middle);
        scatter.add(off * off);
    }
    CAPTURE(exact);
    CAPTURE(drift);
    CAPTURE(pixels.mean);
    CHECK(drift < 0.02 * exact);
    CHECK(std::abs(apart(pixels, exact + drift)) < once_in_a_million);
    // One block of 15 pixels that share nothing.
    CHECK(std::abs(apart(blocks, exact / 15 + drift)) < once_in_a_million);
    CHECK(std::abs(apart(scatter, exact)) < once_in_a_million);
    CHECK(pixels.error() < 0.01 * exact); // an error that is 3 % off is found
}

TEST_CASE("progressive: the error of blocks has what their pixels share") {
    // All pixels of a pass are off by the same: a block's mean is as wrong as a pixel.
    const auto shared = [](long long pass, double) {
        Draws numbers{std::uint64_t(pass)};
        return RenderedT<float>{
            .image = make_image<float>(20, 13, Rgb{float(numbers.unit())})};
    };
    for (const int side : {1, 7, 8, 1000}) {
        ProgressiveState state{.block_side = side};
        (void)run_progressive(state, 50, shared, go_on);
        const auto error = estimate_error(state);
        CHECK(error.blocks == doctest::Approx(error.pixels).epsilon(1e-9));
        CHECK(state.block_squares.width == (20 - 1) / side + 1);
        CHECK(state.block_squares.height == (13 - 1) / side + 1);
    }
    // One pass says nothing; two equal ones say 0.
    CHECK(std::isinf(estimate_error(ProgressiveState{}).pixels));
    CHECK(std::isinf(estimate_error(state_after(1, shared)).blocks));
    CHECK(estimate_error(state_after(2, NoisyPass{.noise = 0})).pixels == 0);
    // A large number under the noise does not drown it.
    const auto high = [](long long pass, double) {
        return RenderedT<float>{
            .image = make_image<float>(1, 1, Rgb{8388608.0f + float(pass % 2)})};
    };
    CHECK(estimate_error(state_after(1000, high)).pixels ==
          doctest::Approx(0.5 / std::sqrt(999.0)).epsilon(1e-6));
}

TEST_CASE("progressive: photons follow the closed form of the blur, pass by pass") {
    // The mean of the passes is the mean of the blurs of all their radii.
    const World<Stage> room = window();
    const Camera camera = patch_camera();
    const float radius = 0.7f;
    for (const double alpha : {1.0 / 3, 2.0 / 3}) {
        std::array<Mean, 3> found;
        constexpr std::array counts{1LL, 16LL, 128LL};
        for (std::uint64_t run = 1; run <= 32; ++run) {
            const std::uint64_t seed = test_seed(run);
            const auto pass = [&](long long i, double scale) {
                return photon_mapping_pass(
                    room, camera, mirror_light(radius, 400, seed),
                    {.width = 2, .height = 1, .samples = 1, .seed = seed, .threads = 1},
                    i, scale);
            };
            ProgressiveState state{.alpha = alpha};
            for (std::size_t k = 0; k < counts.size(); ++k) {
                (void)run_progressive(state, counts[k], pass, go_on);
                const auto image = mean_image<double>(state);
                found[k].add((image.pixels[0].x + image.pixels[1].x) / 2);
            }
        }
        double sum = 0;
        std::size_t k = 0;
        for (long long i = 1; i <= counts.back(); ++i) {
            sum += blurred(double(radius) * std::sqrt(closed_shrink(double(i), alpha)));
            if (i != counts[k]) continue;
            // Direct light from height 1, the mirror's, and the BRDF 0.5 / pi.
            const double right = (1 + sum / double(i)) * 0.5 / std::numbers::pi;
            CAPTURE(i);
            CAPTURE(found[k].mean);
            CAPTURE(found[k].error());
            CAPTURE(right);
            CHECK(chance_of(found[k], right) > 1e-6);
            CHECK(found[k].error() < 0.01 * right);
            ++k;
        }
    }
}

TEST_CASE("progressive: variance and squared bias fall with the predicted slopes") {
    const World<Stage> room = window();
    const Camera camera = patch_camera();
    // Variance: a small disc, so that almost all photons lie outside of it. Of each of
    // 48 runs the ratio that the radii say, of what two estimates of the error say.
    for (const double alpha : {1.0 / 3, 2.0 / 3}) {
        double sum_few = 0, sum_many = 0;
        for (int i = 1; i <= 128; ++i) {
            const double scatter = 1 / closed_shrink(i, alpha);
            sum_many += scatter;
            if (i <= 16) sum_few += scatter;
        }
        const double right = sum_many / (128 * 128) / (sum_few / (16 * 16));
        CHECK(std::abs(std::log(right) / std::log(8.0) + alpha) < 0.03);
        Mean few, more;
        for (std::uint64_t run = 1; run <= 48; ++run) {
            const std::uint64_t seed = test_seed(run);
            const auto pass = [&](long long i, double scale) {
                return photon_mapping_pass(
                    room, camera, mirror_light(0.2f, 200, seed),
                    {.width = 1, .height = 1, .samples = 1, .seed = seed, .threads = 1},
                    i, scale);
            };
            ProgressiveState state{.alpha = alpha};
            const auto variance = [&](long long passes) {
                (void)run_progressive(state, passes, pass, go_on);
                const double error = estimate_error(state).pixels;
                return error * error;
            };
            const double of_few = variance(16);
            few.add(of_few);
            more.add(variance(128) - right * of_few);
        }
        CAPTURE(alpha);
        CAPTURE(more.mean / few.mean);
        CAPTURE(more.error() / few.mean);
        CAPTURE(right);
        CHECK(chance_of(more, 0) > 1e-6);
        CHECK(more.error() < 0.1 * right * few.mean); // it is a comparison
    }
    // The bias that the blur predicts, which the case above has found: its slope.
    for (const double alpha : {1.0 / 3, 2.0 / 3}) {
        double sum = 0, at_1000 = 0;
        for (int i = 1; i <= 64000; ++i) {
            sum += blurred(0.7 * std::sqrt(closed_shrink(i, alpha))) - 0.25;
            if (i == 1000) at_1000 = sum / i;
        }
        const double slope = 2 * std::log(sum / 64000 / at_1000) / std::log(64.0);
        CHECK(std::abs(slope + 2 * (1 - alpha)) < 0.05); // 8 % are early passes
    }
}

TEST_CASE("progressive: both radii shrink, and no pass repeats another") {
    // In a room with a glass ball, with the general map and with rays.
    ljus_test::BallRoom room;
    ljus_test::add_walls(room);
    ljus_test::add_ball(room, ljus_test::Ball::glass);
    ljus_test::add_lamps(room, ljus_test::Lamp::quad, 1);
    const World world(std::move(room));
    const auto camera = ljus_test::room_camera<float>();
    PhotonMappingSettings settings{.indirect = IndirectLight::photons};
    settings.caustics = {.photons = 2000, .seed = test_seed(1)};
    settings.general = {.photons = 2000, .seed = test_seed(1)};
    const RenderSettings picture{
        .width = 12, .height = 9, .samples = 1, .seed = test_seed(1)};
    const auto pass = [&](const PhotonMappingSettings& how, long long i, double scale) {
        return photon_mapping_pass(world, camera, how, picture, i, scale);
    };
    // A pass does not depend on earlier ones.
    const auto hash = [](const auto& rendered) {
        return detail::hash_of(rendered.image);
    };
    CHECK(hash(pass(settings, 3, 0.5)) == hash(pass(settings, 3, 0.5)));
    CHECK(hash(pass(settings, 3, 0.5)) != hash(pass(settings, 4, 0.5)));
    // Fewer photons in smaller discs: a quarter each time the radius halves.
    const auto gathered = [&](double scale) {
        double photons = 0;
        for (long long i = 1; i <= 4; ++i)
            photons += double(pass(settings, i, scale).counts.map_photons);
        return photons;
    };
    const double large = gathered(0.5), small = gathered(0.25);
    CAPTURE(large);
    CAPTURE(small);
    // 0.262 by 21 seeds, which scatter by 0.009.
    CHECK(small / large == ljus_test::within(0.25, 0.25));
    // Each map by itself.
    for (const bool caustics : {false, true}) {
        PhotonMappingSettings one = settings;
        (caustics ? one.general : one.caustics).photons = 0;
        CHECK(hash(pass(one, 1, 1)) != hash(pass(one, 1, 0.5)));
        // The photons are others, and so are the camera's rays.
        PhotonMappingSettings none = one;
        (caustics ? none.caustics : none.general).photons = 0;
        none.indirect = IndirectLight::none;
        CHECK(hash(pass(none, 1, 1)) == hash(pass(none, 1, 0.5)));
        CHECK(hash(pass(none, 1, 1)) != hash(pass(none, 2, 1)));
    }
    // Another number of threads, the same bytes.
    const auto run = [&](int threads) {
        PhotonMappingSettings how = settings;
        how.caustics.threads = how.general.threads = threads;
        RenderSettings size = picture;
        size.threads = threads;
        return state_after(5, [&](long long i, double scale) {
            return photon_mapping_pass(world, camera, how, size, i, scale);
        });
    };
    CHECK(same_state(run(1), run(3)));
    // Who stops a pass gets the picture without it.
    ProgressiveState state;
    long long calls = 0;
    auto stop = [&](long long, long long) { return ++calls < 100; };
    PhotonMappingSettings how = settings;
    how.caustics.progress = how.general.progress = stop;
    RenderSettings stopped = picture;
    stopped.progress = stop;
    stopped.threads = how.caustics.threads = how.general.threads = 1;
    CHECK_FALSE(run_progressive(
        state, 1000000,
        [&](long long i, double scale) {
            return photon_mapping_pass(world, camera, how, stopped, i, scale);
        },
        go_on));
    REQUIRE(state.passes > 0);
    CHECK(same_state(state, [&] {
        ProgressiveState same;
        (void)run_progressive(
            same, state.passes,
            [&](long long i, double scale) { return pass(settings, i, scale); }, go_on);
        return same;
    }()));
}

TEST_CASE("progressive: radii and shares are chosen once, for all passes") {
    ljus_test::BallRoom room;
    ljus_test::add_walls(room);
    ljus_test::add_ball(room, ljus_test::Ball::glass);
    ljus_test::add_lamps(room, ljus_test::Lamp::quad, 1);
    const World world(std::move(room));
    const auto camera = ljus_test::room_camera<float>();
    PhotonMappingSettings settings{.indirect = IndirectLight::photons,
                                   .caustic_budget = CausticBudget::area};
    settings.caustics = {.photons = 2000};
    settings.general = {.photons = 2000};
    settings.caustics_estimate.radius = settings.general_estimate.radius = 0;
    const PhotonMapper mapper(world, settings, abilities<Budgeting>);
    const auto chosen = settings_for_passes(mapper);
    const auto& maps = mapper.maps();
    CHECK(chosen.caustics.shares == mapper.settings().caustics.shares);
    CHECK(chosen.caustics_estimate.radius == typical_radius(maps.caustics, 32));
    CHECK(chosen.general_estimate.radius == typical_radius(maps.general, 64));
    REQUIRE(chosen.caustics.shares.size() == 1);
    CHECK(chosen.caustics.shares[0] == doctest::Approx(1));
    // What was given stays; what is not asked for is not done.
    settings.caustics_estimate.radius = 0.1f;
    const auto again = [&] {
        return settings_for_passes(PhotonMapper(world, settings, abilities<Budgeting>));
    };
    CHECK(again().caustics_estimate.radius == 0.1f);
    settings.caustics.shares = {1.0};
    CHECK(again().caustics.shares == settings.caustics.shares);
    settings.caustics.shares.clear();
    settings.caustic_budget = CausticBudget::as_seen;
    CHECK(again().caustics.shares.empty());

    // A pass that would choose its own radius would never shrink it.
    const RenderSettings picture{.width = 12, .height = 9, .samples = 1};
    CHECK(refusal([&] {
              (void)photon_mapping_pass(world, camera, settings, picture, 1, 1);
          }) == "general_estimate.radius is 0; it must be finite and above 0.");
    settings.caustics_estimate.radius = 0;
    CHECK(refusal([&] {
              (void)photon_mapping_pass(world, camera, settings, picture, 1, 1);
          }) == "caustics_estimate.radius is 0; it must be finite and above 0.");

    // A pass has the irradiance cache that it asks for: without it, it would gather
    // for each of its pixels.
    PhotonMappingSettings cached = chosen;
    cached.indirect = IndirectLight::cache;
    const auto pass =
        photon_mapping_pass(world, camera, cached, picture, 1, 1, abilities<Gathering>);
    CHECK(pass.counts.bounce_rays < 12u * 9u * std::uint64_t(cached.gather.rays) / 2);
}

TEST_CASE("progressive: what cannot be is refused in a sentence") {
    const NoisyPass pass;
    for (const auto& [alpha, text] :
         {std::pair{0.0, "0"}, {-1.0, "-1"}, {1.5, "1.5"}, {std::nan(""), "NaN"}}) {
        ProgressiveState state{.alpha = alpha};
        CHECK(refusal([&] { add_pass(state, pass(1, 1).image); }) ==
              std::string("alpha is ") + text + "; it must be in (0, 1].");
    }
    ProgressiveState steady{.alpha = 1}; // the last that is none: nothing shrinks
    add_pass(steady, pass(1, 1).image);
    CHECK(steady.shrink == 1);
    const ProgressiveState silent;
    CHECK(silent.alpha == 2.0 / 3);
    CHECK(silent.block_side == 8);
    CHECK(silent.shrink == 1);
    CHECK(silent.passes == 0);
    ProgressiveState state{.block_side = 0};
    CHECK(refusal([&] { add_pass(state, pass(1, 1).image); }) ==
          "the side of a block is 0; it must be at least 1.");
    state.block_side = 8;
    CHECK(refusal([&] { (void)mean_image(state); }) ==
          "the number of passes is 0; it must be at least 1.");
    add_pass(state, pass(1, 1).image);
    CHECK(refusal([&] { add_pass(state, make_image(4, 4)); }) ==
          "The image's size is 4 x 4; the reference has 5 x 3.");
    CHECK(refusal([&] {
              add_pass(state, make_image(5, 3, Rgb{std::nanf("")}));
          }).find("a pass's pixel is (NaN") == 0);
    CHECK(state.passes == 1);
    CHECK(refusal([&] { require_first_pass(state, pass); }).empty());
    CHECK(refusal([&] { require_first_pass(ProgressiveState{}, pass); }).empty());
    CHECK(refusal([&] {
              require_first_pass(state, NoisyPass{.noise = 1.001});
          }).find("The passes so far are of another picture") == 0);
    // One that was stopped says nothing of what it would have been.
    const auto stopped = [](long long, double) {
        return RenderedT<float>{.image = make_image(5, 3), .complete = false};
    };
    CHECK(refusal([&] { require_first_pass(state, stopped); }).empty());
    // No passes asked for, or fewer than there are: nothing is done.
    CHECK(run_progressive(state, 0, pass, go_on));
    CHECK(run_progressive(state, -5, pass, go_on));
    CHECK(state.passes == 1);
    // The callback ends it, and is heard also after the last pass.
    CHECK_FALSE(run_progressive(
        state, 9, pass, [](const ProgressiveState& s) { return s.passes < 4; }));
    CHECK(state.passes == 4);
    CHECK(
        run_progressive(state, 5, pass, [](const ProgressiveState&) { return false; }));
}

TEST_CASE("progressive: a checkpoint comes back, and nothing else does") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.check");
    const auto why_not = [&] {
        return ljus_test::refusal<std::runtime_error>(
            [&] { (void)load_checkpoint(path); }, "it was read");
    };
    CHECK(why_not().find("cannot read") == 0);
    CHECK_FALSE(refusal([&] { save_checkpoint(path, ProgressiveState{}); }).empty());
    for (const int side : {1, 2, 8}) {
        ProgressiveState state{.alpha = 0.4, .block_side = side};
        (void)run_progressive(state, 7, NoisyPass{.width = 3, .height = 2}, go_on);
        if (side > 1) state.picture = std::string("seed: 1\n\0end", 12);
        save_checkpoint(path, state);
        CHECK(same_state(load_checkpoint(path), state));
    }
    CHECK(folder.count() == 1);
    const std::string whole = ScratchFolder::read(path);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string broken = whole;
        broken[i] = char(broken[i] ^ (1 << i % 8));
        ScratchFolder::write(path, broken);
        CHECK(why_not().find("cannot read") == 0);
    }
    for (std::size_t length = 0; length < whole.size(); ++length) {
        ScratchFolder::write(path, whole.substr(0, length));
        CHECK(why_not().find("cannot read") == 0);
    }
    ScratchFolder::write(path, whole + "x");
    CHECK(why_not().find("cannot read") == 0);
    // With a checksum that is right: sizes and numbers that cannot be.
    const auto forged = [&](std::size_t at, std::uint64_t bits, int bytes) {
        Bytes file(whole.begin(), whole.end());
        for (int i = 0; i < bytes; ++i)
            file[at + std::size_t(i)] = static_cast<unsigned char>(bits >> (8 * i));
        put_checksum(file);
        ScratchFolder::write(path, std::string(file.begin(), file.end()));
        return why_not();
    };
    CHECK(forged(16, 1, 4).find("its version is 1") != std::string::npos);
    CHECK(forged(20, 0, 4).find("block side is out") !=
          std::string::npos); // block side
    CHECK(forged(24, 0, 4).find("block side is out") != std::string::npos); // width
    CHECK(forged(24, 0xffffffffu, 4).find("block side is out") != std::string::npos);
    CHECK(forged(24, 6, 4).find("do not match") != std::string::npos);
    for (const std::uint64_t letters : {0u, 11u, 13u}) // of the text, which has 12
        CHECK(forged(whole.size() - 20, letters, 8).find("do not match") !=
              std::string::npos);
    CHECK(forged(40, 0x7ff8000000000000u, 8).find("not finite") != std::string::npos);
    CHECK(forged(40, 0, 8).find("out of range") != std::string::npos); // alpha
    for (const double shrink : {0.0, -0.5, 1.001})                     // of the radius
        CHECK(
            forged(48, std::bit_cast<std::uint64_t>(shrink), 8).find("out of range") !=
            std::string::npos);
    CHECK(forged(40, std::bit_cast<std::uint64_t>(1.001), 8).find("out of range") !=
          std::string::npos);
    CHECK(forged(48, std::bit_cast<std::uint64_t>(1.0), 8) == "it was read");
    CHECK(forged(56, 0, 8).find("out of range") != std::string::npos); // passes
    CHECK(forged(40, std::bit_cast<std::uint64_t>(0.5), 8) == "it was read");
    // Light, the first pixel's, is finite in double only.
    CHECK(forged(72, std::bit_cast<std::uint64_t>(1e300), 8).find("beyond the range") !=
          std::string::npos);
    CHECK(
        forged(72, std::bit_cast<std::uint64_t>(-1e300), 8).find("beyond the range") !=
        std::string::npos);
    // Seven passes can have found seven times the largest float, and no more.
    const double most = 7 * double(std::numeric_limits<float>::max());
    for (const double sign : {1.0, -1.0}) {
        CHECK(forged(72, std::bit_cast<std::uint64_t>(sign * most), 8) ==
              "it was read");
        CHECK(forged(72, std::bit_cast<std::uint64_t>(sign * 1.01 * most), 8)
                  .find("beyond the range") != std::string::npos);
    }
}

TEST_CASE("progressive: interrupted after any pass, the end is the same") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.check");
    const NoisyPass pass{.bias = 0.1};
    const auto whole = state_after(12, pass);
    for (long long at = 1; at < 12; ++at) {
        ProgressiveState state;
        (void)run_progressive(state, at, pass, go_on);
        save_checkpoint(path, state);
        ProgressiveState resumed = load_checkpoint(path);
        require_first_pass(resumed, pass);
        (void)run_progressive(resumed, 12, pass, go_on);
        CHECK(same_state(resumed, whole));
    }
}

#ifdef LJUS_TEST_FORKS

namespace {

/// What a program does with a checkpoint: begins or resumes, and saves after each pass.
template <typename RenderPass>
void work(const std::string& path, long long passes, const RenderPass& pass) {
    ProgressiveState state;
    if (::access(path.c_str(), F_OK) == 0) {
        state = load_checkpoint(path);
        require_first_pass(state, pass);
    }
    (void)run_progressive(state, passes, pass, [&](const ProgressiveState& now) {
        save_checkpoint(path, now);
        return true;
    });
}

/// Runs it in a process of its own, which is killed after some microseconds.
/// \return Whether it came to its end by itself, and that was a good one.
template <typename RenderPass>
bool survives(const std::string& path, long long passes, const RenderPass& pass,
              double microseconds) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        try {
            work(path, passes, pass);
        } catch (...) {
            std::_Exit(7);
        }
        std::_Exit(0);
    }
    int status = 0;
    if (microseconds >= 0) {
        ::usleep(static_cast<useconds_t>(microseconds));
        ::kill(child, SIGKILL);
    }
    ::waitpid(child, &status, 0);
    CHECK((WIFSIGNALED(status) || WEXITSTATUS(status) == 0)); // no refusal
    return WIFEXITED(status);
}

/// Kills a picture at random moments, many times, and lets it come to its end.
/// \param longest  Microseconds that it may live, at most.
template <typename RenderPass>
void check_kills(long long passes, const RenderPass& pass, double longest) {
    const ScratchFolder folder;
    const std::string whole = folder.file("whole"), killed = folder.file("killed");
    work(whole, passes, pass);
    Draws numbers{4};
    int kills = 0;
    while (kills < 60 && !survives(killed, passes, pass, numbers.between(0, longest))) {
        ++kills;
        // The last checkpoint is whole.
        if (::access(killed.c_str(), F_OK) == 0)
            CHECK_NOTHROW((void)load_checkpoint(killed));
    }
    // A kill between the new file's two names leaves it beside the checkpoint, until
    // the next save.
    CHECK(folder.count() <= 3);
    MESSAGE(kills, " kills, ",
            ::access(killed.c_str(), F_OK) == 0 ? load_checkpoint(killed).passes : 0,
            " passes done by then");
    CHECK(survives(killed, passes, pass, -1));
    CHECK(ScratchFolder::read(whole) == ScratchFolder::read(killed));
}

} // namespace

TEST_CASE("progressive: killed at any moment and resumed, the bytes are the same") {
    // Passes of photons, of some milliseconds each; one thread, since those of OpenMP
    // do not come along into a forked process.
    const World<Stage> room = window();
    const Camera camera = patch_camera();
    check_kills(
        40,
        [&](long long i, double scale) {
            return photon_mapping_pass(
                room, camera, mirror_light(0.3f, 2000, 1),
                {.width = 16, .height = 12, .samples = 1, .threads = 1}, i, scale);
        },
        20000);
    // Passes that cost nothing: it is always killed while it writes.
    check_kills(100, NoisyPass{.width = 160, .height = 100}, 30000);
}

TEST_CASE("progressive: 150 passes take the memory of ten") {
    // Each pass stores photons of half a megabyte or more: kept, they would be 75 MB.
    const auto peak_megabytes = [] {
        struct ::rusage usage = {};
        ::getrusage(RUSAGE_SELF, &usage);
        return double(usage.ru_maxrss) / 1024;
    };
    const World<Stage> room = window();
    const auto pass = [&, camera = patch_camera()](long long i, double scale) {
        return photon_mapping_pass(
            room, camera, mirror_light(0.05f, 12000, 1),
            {.width = 8, .height = 8, .samples = 1, .threads = 1}, i, scale);
    };
    ProgressiveState state;
    (void)run_progressive(state, 10, pass, go_on);
    const double before = peak_megabytes();
    (void)run_progressive(state, 150, pass, go_on);
    const double grown = peak_megabytes() - before;
    CAPTURE(before);
    CAPTURE(grown);
#ifndef __SANITIZE_ADDRESS__ // which keeps what was freed for a while
    CHECK(grown < 8);
#endif
}

#endif

TEST_CASE("progressive: the standard error is over all channels and pixels") {
    auto squares = make_image<double>(2, 1);
    squares.pixels = {{1, 2, 4}, {8, 16, 32}};
    CHECK(detail::standard_error(squares, 5) ==
          doctest::Approx(std::sqrt(63 / 6.0 / (5 * 4))));
    const auto image = [](double a, double b) {
        auto one = make_image<double>(1, 1);
        one.pixels[0] = {a, b, 3 * a};
        return one;
    };
    auto sum = image(7, 1), known = image(0, 0);
    detail::add_squares(known, image(3, 2), sum, 0); // the first has no mean yet
    CHECK(known.pixels[0] == RgbT<double>{0});
    detail::add_squares(known, image(3, 2), sum, 2); // means 3.5, 0.5 and 10.5
    CHECK(known.pixels[0].x == doctest::Approx(0.25 * 2 / 3));
    CHECK(known.pixels[0].y == doctest::Approx(2.25 * 2 / 3));
    CHECK(known.pixels[0].z == doctest::Approx(2.25 * 2 / 3));
    // Blocks at the border have fewer pixels.
    auto five = make_image<double>(5, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) pixel(five, x, y) = RgbT<double>(x + 10.0 * y);
    const auto means = block_means(five, 2);
    REQUIRE(means.width == 3);
    REQUIRE(means.height == 2);
    CHECK(pixel(means, 0, 0).x == doctest::Approx(5.5));
    CHECK(pixel(means, 2, 0).x == doctest::Approx(9));
    CHECK(pixel(means, 1, 1).x == doctest::Approx(22.5));
    CHECK(pixel(means, 2, 1).x == doctest::Approx(24));
    // Another picture, another hash: by any channel, any pixel, and the form.
    const std::uint64_t hash = detail::hash_of(five);
    for (int c = 0; c < 3; ++c) {
        auto other = five;
        other.pixels[7][c] += 1e-12;
        CHECK(detail::hash_of(other) != hash);
    }
    auto turned = five;
    std::swap(turned.pixels[3], turned.pixels[9]);
    CHECK(detail::hash_of(turned) != hash);
    turned = five;
    std::swap(turned.width, turned.height);
    CHECK(detail::hash_of(turned) != hash);
}

TEST_CASE("progressive: each pass has photons of its own, in either map") {
    using namespace ljus_test;
    // One pixel, so narrow that all its rays meet one point, under a point light: what
    // differs from pass to pass is the photons'. A tenth of 3000 photons is known to
    // some per cent; twice the same photons, to the last digits of a float.
    const auto room = make_room<float>(Ball::mirror, Lamp::point, 1);
    const Camera narrow = look_at(View{
        .position{0.6f, -0.2f, 0.5f}, .target{0.5f, -1, 0.4f}, .vfov_degrees = 1e-3f});
    for (const bool caustics : {false, true}) {
        PhotonMappingSettings settings{.indirect = caustics ? IndirectLight::none
                                                            : IndirectLight::photons};
        settings.caustics = {.photons = caustics ? 3000 : 0, .threads = 1};
        settings.general = {.photons = caustics ? 0 : 3000, .threads = 1};
        settings.caustics_estimate.radius = settings.general_estimate.radius = 0.5f;
        const auto seen = [&](long long pass) {
            const auto rendered =
                photon_mapping_pass(room, narrow, settings,
                                    {.width = 1, .height = 1, .samples = 1}, pass, 1.0);
            REQUIRE(rendered.complete);
            return double(rendered.image.pixels[0].x);
        };
        // Without photons: the light of the lamp alone.
        PhotonMappingSettings without = settings;
        without.caustics.photons = without.general.photons = 0;
        const auto direct =
            double(photon_mapping_pass(room, narrow, without,
                                       {.width = 1, .height = 1, .samples = 1}, 1, 1.0)
                       .image.pixels[0]
                       .x);
        CAPTURE(caustics);
        std::vector<double> by_photons;
        for (long long pass = 1; pass <= 4; ++pass) {
            by_photons.push_back(seen(pass) - direct);
            CHECK(by_photons.back() > 0);
            for (std::size_t i = 0; i + 1 < by_photons.size(); ++i)
                CHECK(std::abs(by_photons.back() / by_photons[i] - 1) > 1e-4);
        }
    }
}

TEST_CASE("progressive: a pass that is stopped has no picture") {
    using namespace ljus_test;
    const auto room = make_room<float>(Ball::mirror, Lamp::quad, 1);
    PhotonMappingSettings settings{.indirect = IndirectLight::photons};
    settings.caustics_estimate.radius = settings.general_estimate.radius = 0.2f;
    const auto stop = [](long long, long long) { return false; };
    int rows = 0;
    const auto watch = [&](long long, long long) { return ++rows > 0; };
    settings.caustics.progress = stop;
    const auto pass = photon_mapping_pass(
        room, room_camera<float>(), settings,
        {.width = 8, .height = 8, .samples = 1, .progress = watch}, 1, 1.0);
    CHECK_FALSE(pass.complete);
    CHECK(pass.image.pixels.empty());
    CHECK(rows == 0);
}
