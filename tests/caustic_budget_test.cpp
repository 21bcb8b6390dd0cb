/// \file caustic_budget_test.cpp
/// \brief Photons shared out among mirrors and glass: closed forms, and no bias.
///
/// Statistical checks state how often they would fail by chance, were the seeds new.
/// They were run with 20 further seeds (`./scripts/test --seeds 20`): none failed.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "ljus/inspect/survey.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/media/fog.hpp"
#include "ljus/photons/budget.hpp"
#include "ljus/render/budgeting.hpp"
#include "ljus/scene/scene.hpp"
#include "support/ball_caustic.hpp"
#include "support/box_sides.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"
#include "support/seed.hpp"
#include "support/within.hpp"

using namespace ljus;
using ljus_test::apart;
using ljus_test::BallCaustic;
using ljus_test::Mean;
using ljus_test::refusal;
using ljus_test::test_seed;

namespace {

constexpr double pi = std::numbers::pi;
using Room = Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass, Mirror>,
                   Lights<PointLight>>;

void add_floor(Room& room, float half = 50) {
    room.add(Quad{.corner{-half, -1, -half},
                  .edge_u{0, 0, 2 * half},
                  .edge_v{2 * half, 0, 0}},
             room.add(Lambertian{.albedo = Rgb{0.5f}}));
}

/// A point light at height 2 above a glass ball, and beside the light, 0.5 higher, a
/// square mirror: what each sends to the floor at -1 is known.
Room ball_and_mirror() {
    Room room;
    add_floor(room);
    room.add(Sphere{.radius = 0.5f}, room.add(Glass{}));
    room.add(Quad{.corner{1.5f, 2.5f, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}},
             room.add(Mirror{.reflectance = Rgb{0.9f}}));
    room.add(PointLight{.position{0, 2, 0}});
    return room;
}

/// The mirror's solid angle from the light of 1 W/sr, and nine tenths of it.
double mirror_flux() {
    const auto corner = [](double x, double z) { // of a rectangle from the axis to it
        return std::atan(x * z / (0.5 * std::sqrt(x * x + z * z + 0.25)));
    };
    return 0.9 * 2 * (corner(2.5, 0.5) - corner(1.5, 0.5));
}

double ball_flux() {
    double flux = 0;
    BallCaustic{}.shower([&](double, double part) { flux += part; });
    return flux;
}

double power(const std::vector<Photon>& photons) {
    double sum = 0;
    for (const Photon& photon : photons)
        if (photon.normal.y > 0) sum += double(photon.flux.x);
    return sum;
}

/// Two glass balls of one size side by side under one light, on a floor in the void or,
/// if the walls have a colour, in a box.
Room two_balls(float left_index, float right_index, float albedo) {
    Room room;
    const auto walls = room.add(Lambertian{.albedo = Rgb{albedo}});
    const float s = 3;
    const auto floor = room.add(Lambertian{.albedo = Rgb{0.5f}});
    if (albedo > 0)
        ljus_test::add_room(room, {-s, 0, -s}, {s, 5, s},
                            {floor, walls, walls, walls, walls, walls});
    else
        room.add(Quad{{-s, 0, -s}, {0, 0, 2 * s}, {2 * s, 0, 0}}, floor);
    for (const auto& [x, index] :
         {std::pair{-1.0f, left_index}, std::pair{1.0f, right_index}})
        room.add(Sphere{.center{x, 0.8f, 0}, .radius = 0.5f},
                 room.add(Glass{.index = index}));
    room.add(PointLight{.position{0, 4, 0}, .intensity = Rgb{10}});
    return room;
}

} // namespace

TEST_CASE("caustic_budget: shares follow the scatter, and no others do better") {
    const auto shares = share_out(std::array{1.0, 3.0, 4.0}, 0);
    CHECK(shares == std::vector{0.125, 0.375, 0.5});
    // Brute force: the sum of a^2 / n on a grid of all shares.
    const auto variance = [](double n1, double n2, double n3) {
        return 1 / n1 + 9 / n2 + 16 / n3;
    };
    const double least = variance(0.125, 0.375, 0.5);
    CHECK(least == doctest::Approx(8 * 8)); // the square of the sum of the a_k
    for (int i = 1; i < 100; ++i)
        for (int j = 1; i + j < 100; ++j)
            CHECK(variance(i / 100.0, j / 100.0, (100 - i - j) / 100.0) >=
                  least * (1 - 1e-12));
    // The floor: each object gets photons, at a variance of at most 1/(1 - floor) of
    // the least.
    for (const double floor : {0.1, 0.5, 1.0}) {
        const auto some = share_out(std::array{1.0, 3.0, 4.0}, floor);
        CHECK(some[0] + some[1] + some[2] == doctest::Approx(1));
        CHECK(some[0] >= floor / 3);
        if (floor < 1)
            CHECK(variance(some[0], some[1], some[2]) <= least / (1 - floor));
    }
    CHECK(share_out(std::array{0.0, 5.0})[0] == doctest::Approx(0.05));
    CHECK(share_out(std::array{0.0, 5.0})[1] == doctest::Approx(0.95));
    CHECK(share_out(std::array{0.0, 0.0}) == std::vector{0.5, 0.5});
    CHECK(share_out(std::array{1e300})[0] == doctest::Approx(1));
    CHECK(share_out(std::vector<double>{}).empty());
    for (double a = 0.001; a < 10; a *= 1.01) { // rounding must not make it 1 + 2^-52
        CHECK(share_out(std::array{a})[0] == 1);
        CHECK(share_out(std::array{a, 0.0}, 0)[0] == 1);
    }
    // Numbers as small and as far apart as they may be.
    const auto tiny = share_out(std::array{1e-300, 1e-310});
    CHECK(tiny[0] + tiny[1] == doctest::Approx(1));
    CHECK(refusal([] {
              (void)share_out(std::array{1.0, -1.0});
          }) == "the scatter of an object is -1; it must be finite and at least 0.");
    CHECK(refusal([] { (void)share_out(std::array{1e308, 1e308}); }) ==
          "the sum of the scatter is infinity; it must be finite.");
    CHECK(refusal([] { (void)share_out(std::array{std::nan("")}); }).find("NaN") !=
          std::string::npos);
    CHECK(refusal([] { (void)share_out(std::array{1.0}, 1.5); }) ==
          "the floor of the shares is 1.5; it must be within [0, 1].");
}

TEST_CASE("caustic_budget: any shares give the same light") {
    const World room(ball_and_mirror());
    const double right = ball_flux() + mirror_flux();
    for (const auto& shares : {std::vector<double>{}, std::vector{0.5, 0.5},
                               std::vector{0.9, 0.1}, std::vector{0.02, 0.98}})
        for (const PhotonSampling numbers :
             {PhotonSampling::random, PhotonSampling::sobol}) {
            Mean found;
            for (std::uint64_t seed = 1; seed <= 16; ++seed)
                found.add(power(trace_photons(room, MapType::caustics,
                                              {.photons = 8000,
                                               .seed = test_seed(seed),
                                               .numbers = numbers,
                                               .shares = shares,
                                               .threads = 1})
                                    .photons));
            CAPTURE(found.mean);
            CAPTURE(found.error());
            CAPTURE(right);
            // Student's t with 15 degrees: eight of 1 in 8000. The floor ends.
            CHECK(std::abs(apart(found, right, 2e-3)) < 5);
            CHECK(found.error() < 0.04 * right);
        }
    // One object alone: its own light, and as much of it as of a share.
    for (const std::size_t k : {0u, 1u}) {
        std::vector<double> shares(2, 0.0);
        shares[k] = 1;
        Mean found;
        for (std::uint64_t seed = 1; seed <= 16; ++seed)
            found.add(
                power(trace_photons(
                          room, MapType::caustics,
                          {.photons = 5000, .seed = test_seed(seed), .shares = shares})
                          .photons));
        CHECK(std::abs(apart(found, k == 0 ? ball_flux() : mirror_flux(), 2e-3)) < 5);
    }
}

TEST_CASE("caustic_budget: no shares are the photons of old, byte by byte") {
    const World room(ball_and_mirror());
    const auto targets = specular_objects(room);
    const auto choice = room.light_choice();
    for (std::uint64_t path = 0; path < 200; ++path) {
        auto a = random_stream(1, Pass::caustics_photons, 0, path), b = a;
        const auto old = aim(room, choice, targets, a);
        const auto now = aim_by_share(room, choice, targets, {}, b);
        REQUIRE(old.has_value() == now.has_value());
        if (!old) continue;
        CHECK(old->photon.flux == now->photon.flux);
        CHECK(old->photon.ray.direction == now->photon.ray.direction);
        CHECK(a.counter == b.counter);
    }
    // A share of 0 is never chosen, in spite of rounding: here it is half.
    for (std::uint64_t path = 0; path < 2000; ++path) {
        auto stream = random_stream(2, Pass::caustics_photons, 0, path);
        const std::array shares{0.5, 0.0};
        const auto aimed = aim_by_share(room, choice, targets, shares, stream);
        REQUIRE(aimed.has_value());
        CHECK(aimed->target == targets[0]);
    }
}

TEST_CASE("caustic_budget: the pilot measures flux, area and scatter") {
    // A mirror of side 0.4, 0.5 above a light: the image stands at height 3, so 4 above
    // the floor, and the patch is 8 times the mirror.
    Room room;
    add_floor(room);
    room.add(
        Quad{.corner{-0.2f, 2.5f, -0.2f}, .edge_u{0.4f, 0, 0}, .edge_v{0, 0, 0.4f}},
        room.add(Mirror{.reflectance = Rgb{1}}));
    room.add(PointLight{.position{0, 2, 0}});
    const World world(std::move(room));
    const PhotonPassSettings pass{.photons = 400000};
    const auto pilots = pilot_caustics(world, pass, 0.1f);
    REQUIRE(pilots.size() == 1);
    double flux = 0, squares = 0;
    const int steps = 200;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double cell = 3.2 / steps;
            const double x = cell * (i + 0.5) - 1.6, z = cell * (j + 0.5) - 1.6;
            const double e = 4 * std::pow(x * x + z * z + 16, -1.5);
            flux += e * cell * cell;
            squares += e * e * cell * cell;
        }
    CHECK(pilots[0].flux == doctest::Approx(flux).epsilon(0.03));
    // Along the edge, discs lie half beside the patch: the area reads larger.
    CHECK(pilots[0].area == doctest::Approx(flux * flux / squares).epsilon(0.1));
    CHECK(pilots[0].area > flux * flux / squares);
    // All aimed photons arrive, with nearly the same flux.
    CHECK(pilots[0].stored == 20000);
    CHECK(pilots[0].absolute == doctest::Approx(flux).epsilon(0.05));
    CHECK(pilots[0].relative == doctest::Approx(pilots[0].area).epsilon(0.05));
    // Even light of E photons around: the scatter of the flux over E.
    const auto lit_by = [&](double e, float wide = 0.5f) {
        std::vector<Photon> light;
        for (int i = 0; i < 100; ++i)
            for (int j = 0; j < 100; ++j)
                light.push_back(
                    {.position{0.1f * float(i) - 4.95f, -1, 0.1f * float(j) - 4.95f},
                     .direction{0, -1, 0},
                     .flux = Rgb{float(0.01 * e)},
                     .normal = small_normal(Vec3{0, 1, 0})});
        return pilot_caustics(world, pass, 0.1f, light, wide)[0].visible;
    };
    // All 100 e W in a disc of radius 50, or in the default number of photons.
    CHECK(lit_by(100, 50) ==
          doctest::Approx(flux / (1.1 * 1e4 / (pi * 2500) + 0.058)).epsilon(0.05));
    CHECK(lit_by(100, 0) == doctest::Approx(flux / 110).epsilon(0.05));
    // A tenth of the mean is added, and the caustic's own 1/16 W/m^2.
    CHECK(lit_by(100) == doctest::Approx(flux / 110).epsilon(0.05));
    CHECK(lit_by(1) == doctest::Approx(flux / (1.1 + 0.058)).epsilon(0.05));
    // Photons that lie on the other side of the floor light nothing here.
    std::vector<Photon> below(1000, {.position{0, -1, 0},
                                     .direction{0, 1, 0},
                                     .flux = Rgb{1},
                                     .normal = small_normal(Vec3{0, 1, 0})});
    const Photon at{.position{0, -1, 0},
                    .direction{0, -1, 0},
                    .normal = small_normal(Vec3{0, 1, 0})};
    CHECK(detail::irradiance_around(make_photon_map(below), at, 0.5f) == 0);
    below.assign(1, at);
    below[0].flux = Rgb{2};
    CHECK(detail::irradiance_around(make_photon_map(below), at, 0.5f) ==
          doctest::Approx(2 / (pi * 0.25)));
}

TEST_CASE("caustic_budget: the pilot's numbers, one photon after the other") {
    // A plain twin: the pilot's own passes, and sums over all photons in turn.
    Room open = ball_and_mirror();
    open.add(Sphere{.center{-1.5f, 0.5f, 0.7f}, .radius = 0.3f},
             open.add(Glass{.index = 1.3f}));
    const World room(std::move(open));
    int asked = 0;
    const auto ask = [&](long long, long long) { return ++asked > 0; };
    const PhotonPassSettings pass{
        .photons = 42000, .seed = test_seed(3), .iteration = 5, .progress = ask};
    // Other light on the floor: on both sides of it, of all kinds, and on things that
    // stand on it.
    std::vector<Photon> light;
    auto stream = random_stream(7, Pass::user, 0, 0);
    for (int i = 0; i < 3000; ++i) {
        const Vec2 at = next_2d(stream);
        const Vec3 normals[] = {{0, 1, 0}, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}};
        light.push_back({.position{8 * at.x - 4, -1, 8 * at.y - 4},
                         .direction{0, i % 5 == 0 ? 1.0f : -1.0f, 0},
                         .flux{0.01f, 0.02f, 0.001f * float(i % 7)},
                         .kind = PhotonKind(i / 4 % 4),
                         .normal = small_normal(normals[i % 4])});
    }
    const float radius = 0.15f, wide = 0.6f;
    const auto pilots = pilot_caustics(room, pass, radius, light, wide);
    CHECK(asked == 0);   // there is no pilot
    auto bright = light; // shadow photons are no light, and count nowhere
    std::erase_if(bright, [](const auto& p) { return p.kind == PhotonKind::shadow; });
    REQUIRE(bright.size() < 2500);
    const auto objects = specular_objects(room);
    REQUIRE(objects.size() == 3);
    REQUIRE(pilots.size() == 3);

    const long long paths = 42000 / 60;
    std::vector<std::vector<Photon>> found;
    std::vector<Photon> all;
    for (std::size_t k = 0; k < 3; ++k) {
        PhotonPassSettings own = pass;
        own.progress = no_progress;
        own.photons = paths;
        own.iteration = ~std::uint64_t{5} - k; // from the other end: no picture's
        own.shares = {0, 0, 0};
        own.shares[k] = 1;
        found.push_back(trace_photons(room, MapType::caustics, own).photons);
        all.insert(all.end(), found[k].begin(), found[k].end());
    }
    const auto around = [](const std::vector<Photon>& photons, const Photon& at,
                           double within) {
        double sum = 0;
        const auto side = [](const Photon& photon, const Vec3& normal) {
            return glm::dot(photon.direction, normal) < 0;
        };
        const Vec3 normal = glm::normalize(Vec3(at.normal));
        for (const Photon& photon : photons) {
            const Vec3 own = glm::normalize(Vec3(photon.normal));
            if (glm::distance(glm::dvec3(photon.position), glm::dvec3(at.position)) <=
                    within &&
                photon.kind != PhotonKind::shadow && glm::dot(own, normal) > 0.5f &&
                side(photon, normal) == side(at, normal))
                sum += luminance(RgbT<double>(photon.flux));
        }
        return sum / (pi * within * within);
    };
    double flux_of_light = 0, lit_of_light = 0;
    for (std::size_t i = 0; i < bright.size(); i += bright.size() / 1000 + 1) {
        const double part = luminance(RgbT<double>(bright[i].flux));
        flux_of_light += part;
        lit_of_light += part * around(bright, bright[i], double(wide));
    }
    const double dark = 0.1 * lit_of_light / flux_of_light;
    for (std::size_t k = 0; k < 3; ++k) {
        CAPTURE(k);
        double flux = 0, lit = 0, squares = 0, visible = 0;
        for (const Photon& photon : found[k]) {
            const double part = luminance(RgbT<double>(photon.flux));
            const double own = around(all, photon, 2 * double(radius));
            const double here = own + dark + around(bright, photon, double(wide));
            flux += part;
            lit += part * own;
            squares += part * part;
            visible += part * part / (here * here);
        }
        CHECK(pilots[k].object == objects[k]);
        CHECK(pilots[k].stored == found[k].size());
        CHECK(found[k].size() > 100);
        const double n = double(paths);
        CHECK(pilots[k].flux == doctest::Approx(flux).epsilon(1e-9));
        CHECK(pilots[k].absolute == doctest::Approx(std::sqrt(n * squares)));
        CHECK(pilots[k].area == doctest::Approx(flux * flux / lit).epsilon(1e-4));
        CHECK(pilots[k].relative ==
              doctest::Approx(std::sqrt(n * squares) * flux / lit).epsilon(1e-4));
        CHECK(pilots[k].visible ==
              doctest::Approx(std::sqrt(n * visible)).epsilon(1e-4));
    }
    // Without a radius for the other light, that in which 64 of its photons lie.
    const float typical = typical_radius(make_photon_map(bright), 64);
    const auto unsaid = pilot_caustics(room, pass, radius, light, 0.0f);
    const auto said = pilot_caustics(room, pass, radius, light, typical);
    const auto half = pilot_caustics(room, pass, radius, light,
                                     typical_radius(make_photon_map(bright), 32));
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(unsaid[k].visible == said[k].visible);
        CHECK(unsaid[k].visible != half[k].visible);
    }
    // Where there is no other light, a tenth of the caustics' own mean is dark, within
    // the same radius as each of their photons.
    double flux_of_all = 0, lit_of_all = 0;
    for (std::size_t i = 0; i < all.size(); i += all.size() / 1000 + 1) {
        const double part = luminance(RgbT<double>(all[i].flux));
        flux_of_all += part;
        lit_of_all += part * around(all, all[i], 2 * double(radius));
    }
    const auto alone = pilot_caustics(room, pass, radius);
    for (std::size_t k = 0; k < 3; ++k) {
        double visible = 0;
        for (const Photon& photon : found[k]) {
            const double part = luminance(RgbT<double>(photon.flux)) /
                                (around(all, photon, 2 * double(radius)) +
                                 0.1 * lit_of_all / flux_of_all);
            visible += part * part;
        }
        CHECK(alone[k].visible ==
              doctest::Approx(std::sqrt(double(paths) * visible)).epsilon(1e-4));
    }
    // However few photons the picture has, an object gets 500.
    const auto few = pilot_caustics(room, {.photons = 100}, radius);
    for (std::size_t k = 0; k < 3; ++k) {
        PhotonPassSettings own{.photons = 500, .iteration = ~std::uint64_t{0} - k};
        own.shares = {0, 0, 0};
        own.shares[k] = 1;
        CHECK(few[k].stored ==
              trace_photons(room, MapType::caustics, own).photons.size());
    }
}

TEST_CASE("caustic_budget: how many paths a pilot has, and that it does not give up") {
    // A mirror throws all of its light at the sky, except onto a small square. The
    // light of 1 W/sr in front of it and its image at height 4 see the same cone.
    Room room;
    room.add(Quad{.corner{-0.5f, 0, -0.5f}, .edge_u{0, 0, 1}, .edge_v{1, 0, 0}},
             room.add(Mirror{.reflectance = Rgb{1}}));
    room.add(Quad{.corner{0.3f, 4, 0.4f}, .edge_u{0.06f, 0, 0}, .edge_v{0, 0, 0.06f}},
             room.add(Lambertian{}));
    room.add(PointLight{.position{0, 1, 0}});
    const World world(std::move(room));
    const auto stored = [&](long long photons, long long give_up) {
        return pilot_caustics(world, {.photons = photons, .give_up = give_up}, 0.1f)[0]
            .stored;
    };
    const auto traced = [&](long long paths) {
        return trace_photons(
                   world, MapType::caustics,
                   {.photons = paths, .iteration = ~std::uint64_t{0}, .shares = {1}})
            .photons.size();
    };
    // A twentieth, at least 500 and at most 20 000.
    CHECK(traced(20000) > 0);
    CHECK(traced(20000) > traced(10000));
    CHECK(stored(4000000, 1 << 20) == traced(20000));
    CHECK(stored(200000, 1 << 20) == traced(10000));
    // Where the first thousands of paths bring nothing, it goes on.
    Room rare;
    rare.add(Quad{.corner{-0.5f, 0, -0.5f}, .edge_u{0, 0, 1}, .edge_v{1, 0, 0}},
             rare.add(Mirror{.reflectance = Rgb{1}}));
    rare.add(Quad{.corner{0.3f, 4, 0.4f}, .edge_u{0.03f, 0, 0}, .edge_v{0, 0, 0.03f}},
             rare.add(Lambertian{}));
    rare.add(PointLight{.position{0, 1, 0}});
    const World rare_world(std::move(rare));
    std::uint64_t seed = 1; // with which the first 2048 paths bring nothing
    for (;; ++seed)
        if (trace_photons(rare_world, MapType::caustics,
                          {.photons = 20000,
                           .seed = seed,
                           .iteration = ~std::uint64_t{0},
                           .shares = {1},
                           .give_up = 1})
                .photons.empty())
            break;
    REQUIRE(seed < 50);
    const auto all = trace_photons(rare_world, MapType::caustics,
                                   {.photons = 20000,
                                    .seed = seed,
                                    .iteration = ~std::uint64_t{0},
                                    .shares = {1}});
    REQUIRE(all.photons.size() > 0);
    CHECK(pilot_caustics(rare_world, {.photons = 400000, .seed = seed, .give_up = 1},
                         0.1f)[0]
              .stored == all.photons.size());
}

TEST_CASE("caustic_budget: an index near 1 asks for photons by area, and else not") {
    // Two balls of one size and distance. The heavy glass gathers its light in a spot;
    // the light one spreads it over its shadow.
    const PhotonPassSettings pass{.photons = 100000};
    const World dark(two_balls(1.05f, 1.5f, 0));
    const auto pilots = pilot_caustics(dark, pass, 0.04f);
    REQUIRE(pilots.size() == 2);
    CHECK(pilots[0].flux == doctest::Approx(pilots[1].flux).epsilon(0.15));
    CHECK(pilots[0].area > 4 * pilots[1].area);
    const auto share = [&](CausticBudget budget, const auto& of) {
        return caustic_shares(budget, of)[0];
    };
    CHECK(caustic_shares(CausticBudget::as_seen, pilots).empty());
    CHECK(share(CausticBudget::equal, pilots) == 0.5);
    CHECK(share(CausticBudget::flux, pilots) == doctest::Approx(0.5).epsilon(0.1));
    CHECK(share(CausticBudget::area, pilots) > 0.75);
    // By brightness: in the dark the heavy glass has its due in its own deep shadow,
    // where nothing is but what it reflects inside; other light fills that in, and the
    // shares come to those of the flux.
    std::vector<double> bright;
    for (const float albedo : {0.0f, 0.5f, 0.8f}) {
        const World room(two_balls(1.05f, 1.5f, albedo));
        const auto light = trace_photons(room, MapType::general,
                                         {.photons = 20000, .shadow_photons = false})
                               .photons;
        bright.push_back(share(CausticBudget::brightness,
                               pilot_caustics(room, pass, 0.04f, light, 0.3f)));
    }
    CAPTURE(bright[0]);
    CAPTURE(bright[1]);
    CAPTURE(bright[2]);
    CHECK(bright[0] < bright[1]);
    CHECK(bright[1] < bright[2]);
    CHECK(bright[2] ==
          doctest::Approx(share(CausticBudget::flux, pilots)).epsilon(0.12));
}

TEST_CASE("caustic_budget: a radius of 0 is chosen as the picture will choose it") {
    const PhotonPassSettings pass{.photons = 200000};
    const World room(two_balls(1.05f, 1.5f, 0.5f));
    const PhotonMap whole =
        make_photon_map(trace_photons(room, MapType::caustics, pass).photons);
    const PhotonPassSettings other{.photons = 20000, .shadow_photons = false};
    const auto light = trace_photons(room, MapType::general, other).photons;
    const float wide = typical_radius(make_photon_map(light), 64);
    // Ten times fewer photons, and a radius as if they were all: a few per cent.
    const auto chosen = pilot_caustics(room, pass, 0.0f, light, 0.0f);
    const auto told =
        pilot_caustics(room, pass, typical_radius(whole, 32), light, wide);
    REQUIRE(chosen.size() == 2);
    for (const std::size_t i : {0u, 1u}) {
        CHECK(chosen[i].absolute == told[i].absolute);
        CHECK(chosen[i].area == ljus_test::within(told[i].area, 0.15));
        CHECK(chosen[i].relative == ljus_test::within(told[i].relative, 0.15));
        CHECK(chosen[i].visible == ljus_test::within(told[i].visible, 0.15));
    }
    // By the radius of the pilot alone it would be three times as large.
    const auto alone = pilot_caustics(room, pass, 3 * typical_radius(whole, 32), light);
    CHECK(alone[1].area > 1.3 * told[1].area);
    // No photon to learn from: no radius, no share, and nothing that is not finite.
    for (const PhotonPassSettings& none : {PhotonPassSettings{.photons = 0}, pass})
        for (const CausticPilot& pilot : pilot_caustics(room, none, 0.0f, {}, 0.0f)) {
            CHECK(std::isfinite(pilot.area));
            CHECK(std::isfinite(pilot.visible));
        }
}

TEST_CASE("caustic_budget: the shares make the error least that they promise") {
    // Mean squared error of the light on a grid of the floor over 32 maps, absolute and
    // relative to all light there, for shares of all kinds, and what the law says. It
    // speaks of mean squares: N times the variance and the square of the mean, which no
    // share changes.
    const World room(two_balls(1.05f, 1.5f, 0));
    const float radius = 0.06f;
    const auto light = trace_photons(room, MapType::general,
                                     {.photons = 20000, .shadow_photons = false})
                           .photons;
    const auto pilots = pilot_caustics(room, PhotonPassSettings{.photons = 400000},
                                       radius, light, 0.3f);
    const PhotonMap direct = make_photon_map(light);
    constexpr int size = 72;
    const auto place = [](int i) {
        return Photon{.position{6.0f * (float(i % size) + 0.5f) / size - 3, 0,
                                6.0f * (float(i / size) + 0.5f) / size - 3},
                      .direction{0, -1, 0},
                      .normal = small_normal(Vec3{0, 1, 0})};
    };
    std::vector<double> rest;
    double level = 0; // of the light on the floor
    for (int i = 0; i < size * size; ++i) {
        rest.push_back(detail::irradiance_around(direct, place(i), 0.3f));
        level += rest.back() / size / size;
    }
    const auto errors = [&](const std::vector<double>& shares) {
        std::vector<Mean> found(size * size);
        for (std::uint64_t seed = 1; seed <= 32; ++seed) {
            const PhotonMap map =
                make_photon_map(trace_photons(room, MapType::caustics,
                                              {.photons = 10000,
                                               .seed = test_seed(seed),
                                               .shares = shares,
                                               .threads = 1})
                                    .photons);
            for (int i = 0; i < size * size; ++i)
                found[std::size_t(i)].add(
                    detail::irradiance_around(map, place(i), radius));
        }
        std::array<double, 2> sums{};
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double square = 10000 * found[i].squares / (found[i].count - 1) +
                                  found[i].mean * found[i].mean;
            const double all = found[i].mean + rest[i] + 0.1 * level;
            sums[0] += square;
            sums[1] += square / (all * all);
        }
        return sums;
    };
    const auto shares_of = [](double a, double b) {
        return share_out(std::array{a, b}, 0);
    };
    const auto least = errors(shares_of(pilots[0].absolute, pilots[1].absolute));
    const auto seen = errors(shares_of(pilots[0].visible, pilots[1].visible));
    for (const double left : {0.15, 0.35, 0.5, 0.65, 0.85}) {
        const auto found = errors({left, 1 - left});
        const auto law = [&](double a, double b) {
            return (a * a / left + b * b / (1 - left)) / ((a + b) * (a + b));
        };
        const double absolute = law(pilots[0].absolute, pilots[1].absolute);
        const double visible = law(pilots[0].visible, pilots[1].visible);
        CAPTURE(left);
        CAPTURE(found[0] / least[0]);
        CAPTURE(absolute);
        CAPTURE(found[1] / seen[1]);
        CAPTURE(visible);
        // A sum of variances of 32 maps each is known to some percent. The spot is so
        // small that some ten places of the grid decide.
        CHECK(found[0] / least[0] == doctest::Approx(absolute).epsilon(0.25));
        CHECK(found[1] / seen[1] == doctest::Approx(visible).epsilon(0.25));
    }
    // As far as they are apart, each is the better one by its own measure.
    CHECK(least[0] < seen[0]);
    CHECK(seen[1] < least[1]);
}

TEST_CASE("caustic_budget: who gets nothing in the pilot is not starved") {
    // A ball behind a wall: no light comes to it, and it keeps half of the floor.
    Room room = two_balls(1.5f, 1.5f, 0);
    room.add(Sphere{.center{0, 1, -2}, .radius = 0.3f}, room.add(Glass{}));
    room.add(Sphere{.center{0, 1, -2}, .radius = 0.35f},
             room.add(Lambertian{.albedo = Rgb{0.5f}}));
    const World world(std::move(room));
    PhotonMappingSettings settings{.caustic_budget = CausticBudget::flux};
    settings.caustics = {.photons = 40000};
    const auto pilots = pilot_caustics(world, settings.caustics, 0.1f);
    REQUIRE(pilots.size() == 3);
    CHECK(pilots[2].stored == 0);
    CHECK(pilots[2].area == 0);
    for (const CausticBudget budget :
         {CausticBudget::flux, CausticBudget::area, CausticBudget::brightness}) {
        const auto shares = caustic_shares(budget, pilots);
        CHECK(shares[2] == doctest::Approx(0.1 / 3));
        CHECK(shares[0] + shares[1] + shares[2] == doctest::Approx(1));
    }
}

TEST_CASE("caustic_budget: the pilot of the other light is none of the picture's") {
    // What the picture's own photons found, in any of its first passes, must not decide
    // about shares.
    const World room(two_balls(1.2f, 1.5f, 0.5f));
    PhotonMappingSettings settings{.caustic_budget = CausticBudget::brightness};
    settings.caustics.photons = 20000;
    settings.caustics_estimate.radius = 0.05f;
    settings.general_estimate.radius = 0.3f;
    std::vector<std::vector<double>> chosen, own;
    for (const std::uint64_t iteration : {0u, 1u, 2u}) {
        settings.general.iteration = iteration;
        chosen.push_back(caustic_shares(room, settings));
        PhotonPassSettings pass = settings.general;
        pass.photons = 20000;
        const auto light = trace_photons(room, MapType::general, pass).photons;
        own.push_back(caustic_shares(
            CausticBudget::brightness,
            pilot_caustics(room, settings.caustics, 0.05f, light, 0.3f)));
    }
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        CHECK(chosen[i][0] == ljus_test::within(own[i][0], 0.05)); // the same light
        for (const auto& others : own) CHECK(chosen[i] != others);
    }
}

TEST_CASE("caustic_budget: maps by budget have the same light, on any threads") {
    const World room(two_balls(1.2f, 1.5f, 0.5f));
    for (const CausticBudget budget :
         {CausticBudget::as_seen, CausticBudget::equal, CausticBudget::flux,
          CausticBudget::area, CausticBudget::brightness}) {
        PhotonMappingSettings settings{.caustic_budget = budget};
        settings.caustics = {.photons = 20000, .threads = 1};
        settings.general = {.threads = 1};
        Mean found;
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            settings.caustics.seed = settings.general.seed = test_seed(seed);
            const PhotonMapper mapper(room, settings, abilities<Budgeting>);
            const auto& maps = mapper.maps();
            double sum = 0;
            for (std::size_t i = 0; i < maps.caustics.records.size(); ++i)
                sum += double(maps.caustics.records[i].flux.x);
            found.add(sum);
        }
        static Mean first;
        if (budget == CausticBudget::as_seen) first = found;
        CHECK(std::abs(apart(found, first)) < 5); // four of 1 in 4000, 14 degrees
        // By other threads the same bytes.
        auto others = settings;
        others.caustics.threads = others.general.threads = 3;
        const PhotonMapper one(room, settings, abilities<Budgeting>),
            two(room, others, abilities<Budgeting>);
        const auto &a = one.maps(), &b = two.maps();
        REQUIRE(a.caustics.records.size() == b.caustics.records.size());
        bool same = true;
        for (std::size_t i = 0; i < a.caustics.records.size(); ++i)
            same = same && a.caustics.records[i].flux == b.caustics.records[i].flux &&
                   a.caustics.tree.point(i) == b.caustics.tree.point(i);
        CHECK(same);
    }
}

TEST_CASE("caustic_budget: what cannot be is refused, and extremes are none") {
    const World room(ball_and_mirror());
    const auto traced = [&](std::vector<double> shares, long long photons = 100) {
        return trace_photons(room, MapType::caustics,
                             {.photons = photons, .shares = std::move(shares)});
    };
    CHECK(refusal([&] { (void)traced({1.0}); }) ==
          "the number of shares is 1; it must be the number of specular objects.");
    CHECK(refusal([&] {
              (void)traced({0.5, 0.6});
          }) == "the sum of all shares is 1.1; it must be 1.");
    CHECK(refusal([&] {
              (void)traced({0.5, 0.25});
          }) == "the sum of all shares is 0.75; it must be 1.");
    CHECK(refusal([&] {
              (void)traced({1.5, -0.5});
          }) == "a share of the photons is 1.5; it must be within [0, 1].");
    CHECK(refusal([&] {
              (void)traced({std::nan(""), 1.0});
          }).find("NaN") != std::string::npos);
    CHECK(traced({0.5, 0.5}, 0).photons.empty());
    CHECK(traced({0.5, 0.5}, 1).emitted == 1);
    // No mirror, no glass: no pilot, no shares, no photons.
    Room matt;
    add_floor(matt);
    matt.add(PointLight{.position{0, 2, 0}});
    const World world(std::move(matt));
    CHECK(pilot_caustics(world, PhotonPassSettings{}, 0.1f).empty());
    CHECK(caustic_shares(CausticBudget::flux, {}).empty());
    PhotonMappingSettings settings{.caustic_budget = CausticBudget::brightness};
    CHECK(PhotonMapper(world, settings, abilities<Budgeting>).maps().caustics.empty());
    // The plan says what is shared out, and by what.
    settings.caustic_budget = CausticBudget::area;
    CHECK(survey(room, settings)
              .caustics_map.why.starts_with("2 of 3 objects mirror or refract, photons "
                                            "are shared out by caustic area; "));
    settings.caustic_budget = CausticBudget::as_seen;
    CHECK(survey(room, settings)
              .caustics_map.why.starts_with("2 of 3 objects mirror or refract; "));
}

TEST_CASE("caustic_budget: each object is chosen with its share, and pays for it") {
    // Four mirror balls around a light; 20 000 photons twice, 5 standard errors.
    Room room;
    const auto mirror = room.add(Mirror{});
    for (const Vec3 at : {Vec3{3, 0, 0}, Vec3{-3, 0, 0}, Vec3{0, 3, 0}, Vec3{0, -3, 0}})
        room.add(Sphere{.center = at, .radius = 0.5f}, mirror);
    room.add(PointLight{.intensity = Rgb{1}});
    const World world(std::move(room));
    const auto targets = specular_objects(world);
    const LightChoice choice = world.light_choice();
    using Shares = std::vector<double>;
    for (const Shares& shares :
         {Shares{0.1, 0.2, 0, 0.7}, Shares{0.3, 0.1, 0.4, 0.2}}) {
        std::array<int, 4> counts{};
        constexpr int photons = 20000;
        for (int i = 0; i < photons; ++i) {
            auto stream = random_stream(1, Pass::user, 0, std::uint64_t(i));
            const auto aimed = aim_by_share(world, choice, targets, shares, stream);
            REQUIRE(aimed);
            const auto k =
                std::size_t(std::find(targets.begin(), targets.end(), aimed->target) -
                            targets.begin());
            ++counts[k];
            // All of the cone's flux, 2 pi (1 - cos), over the chance.
            const double cone = 2 * pi * (1 - std::sqrt(1 - 1 / 36.0));
            REQUIRE(double(aimed->photon.flux.x) ==
                    ljus_test::within(cone / shares[k], 1e-4));
        }
        for (std::size_t k = 0; k < 4; ++k)
            CHECK(std::abs(counts[k] - photons * shares[k]) <=
                  5 * std::sqrt(photons * shares[k] * (1 - shares[k])));
    }
}

TEST_CASE("caustic_budget: the mean irradiance is that of thousands of photons") {
    // One photon alone, first of all, and 5000 on a square of side 1, 1 W in all.
    std::vector<Photon> photons;
    const auto add = [&](float x, float z, float flux) {
        photons.push_back({.position{x, 0, z},
                           .direction{0, -1, 0},
                           .flux = Rgb{flux},
                           .normal = small_normal(Vec3{0, 1, 0})});
    };
    add(50, 50, 1e-4f);
    for (int i = 0; i < 100; ++i)
        for (int k = 0; k < 50; ++k)
            add(0.01f * float(i), 0.02f * float(k), 1 / 5000.0f);
    const PhotonMap map = make_photon_map(photons);
    const double mean = detail::mean_irradiance(map, photons, 0.05f);
    CHECK(mean == ljus_test::within(1, 0.07)); // the edges see less
    CHECK(detail::mean_irradiance(map, std::vector<Photon>{}, 0.05f) == 0);
    // By the flux that each brings: 3 W where it is 3 times as light.
    std::vector<Photon> two{photons[0], photons[0]};
    two[1].position.x = -50;
    two[0].flux = Rgb{1};
    two[1].flux = Rgb{3};
    CHECK(detail::mean_irradiance(make_photon_map(two), two, 0.5f) ==
          ljus_test::within((1 * 1 + 3 * 3) / 4.0 / (pi * 0.25), 1e-5));
}

// Lamps that no mirror or glass sees. A mean over 60 seeds lies beyond 5 standard
// errors once in 200 000 (t distribution); the ratio of the variances is about 6000,
// and that of 60 seeds each is below a sixth of it less than once in a million.
TEST_CASE("caustic_budget: lamps that nobody sees take no photons from the others") {
    Room open;
    add_floor(open);
    open.add(Sphere{.radius = 0.5f}, open.add(Glass{}));
    open.add(PointLight{.position{0, 2, 0}});
    const auto black = open.add(Lambertian{.albedo = Rgb{0}});
    for (int i = 0; i < 50; ++i) { // each 100 times as strong, in a ball without holes
        const Vec3 place{float(i - 25), 9, 0};
        open.add(Sphere{.center = place, .radius = 0.2f}, black);
        open.add(PointLight{.position = place, .intensity = Rgb{100}});
    }
    const World room(std::move(open));
    PhotonPassSettings pass{.photons = 40800};
    const auto shares = pilot_lights(room, pass);
    pass.photons = 10000;
    REQUIRE(shares.size() == 51);
    double sum = 0, hidden = 0;
    for (const double share : shares) sum += share;
    for (std::size_t k = 1; k < 51; ++k) hidden = std::max(hidden, shares[k]);
    CHECK(sum == doctest::Approx(1));
    CHECK(shares[0] == doctest::Approx(0.9 + 0.1 / 5001));
    CHECK(hidden == doctest::Approx(0.1 * 100 / 5001)); // its part of the floor

    const auto half = [](const std::vector<Photon>& photons) {
        double flux = 0; // on half of the floor
        for (const Photon& photon : photons)
            if (photon.normal.y > 0 && photon.position.x > 0)
                flux += double(photon.flux.x);
        return flux;
    };
    Mean by_power, by_share;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        pass.seed = test_seed(100 + seed);
        pass.light_shares = {};
        by_power.add(half(trace_photons(room, MapType::caustics, pass).photons));
        pass.light_shares = shares;
        by_share.add(half(trace_photons(room, MapType::caustics, pass).photons));
    }
    CHECK(std::abs(by_power.mean - ball_flux() / 2) < 5 * by_power.error());
    CHECK(std::abs(by_share.mean - ball_flux() / 2) < 5 * by_share.error());
    CHECK(by_power.variance() > 1000 * by_share.variance());

    // Who keeps the choice by power is told.
    PhotonMappingSettings settings{.indirect = IndirectLight::none,
                                   .caustics = {.photons = 20000}};
    const std::string said = PhotonMapper(room, settings).maps().remarks;
    CHECK(said.find("% of the photons sent to mirrors and glass are stored: a caustic "
                    "budget by flux") != std::string::npos);
    settings.caustic_budget = CausticBudget::flux;
    CHECK(PhotonMapper(room, settings, abilities<Budgeting>).maps().remarks.empty());

    settings.caustic_budget = CausticBudget::as_seen;
    for (const bool asks : {false, true}) {
        settings.share_lights = asks;
        CHECK(caustic_light_shares(room, settings).empty() != asks);
    }
}

TEST_CASE("caustic_budget: photons in fog tell a pilot of lamps nothing") {
    // They have the number of their medium in place of that of their light.
    Scene<Shapes<Quad>, Materials<Lambertian>, Lights<PointLight>, Media<Fog<Box>>>
        scene;
    scene.add(Quad{{-5, 0, -5}, {0, 0, 10}, {10, 0, 0}}, scene.add(Lambertian{}));
    for (const float x : {-2.0f, 2.0f})
        scene.add(PointLight{.position{x, 1, 0}, .intensity = Rgb{4 + x}});
    for (int i = 0; i < 3; ++i)
        scene.add(Fog<Box>{.region{{-5, 0, -5}, {5, 3, 5}}, .scattering = Rgb{0.3f}});
    const World world(std::move(scene));
    PhotonPassSettings pass{.photons = 8000};
    const auto shares = pilot_lights(world, pass, MapType::general);
    REQUIRE(shares.size() == 2);
    pass.keep = {31};
    CHECK(pilot_lights(world, pass, MapType::general) == shares);
}

TEST_CASE("caustic_budget: who has one lamp, or gives shares, has no pilot of lamps") {
    const World one(ball_and_mirror());
    CHECK(pilot_lights(one, {.photons = 2000}).empty());
    Room open = ball_and_mirror();
    open.add(PointLight{.position{0, 2, 0}, .intensity = Rgb{9}}); // in the same place
    const World two(std::move(open));
    const auto shares = pilot_lights(two, {.photons = 40000});
    REQUIRE(shares.size() == 2);
    CHECK(shares[0] == doctest::Approx(0.1).epsilon(0.1)); // by flux, as power has it
    PhotonMappingSettings settings{.caustic_budget = CausticBudget::as_seen};
    CHECK(caustic_light_shares(two, settings).empty());
    settings.caustic_budget = CausticBudget::flux;
    settings.caustics.photons = 2000;
    settings.indirect = IndirectLight::none;
    const PhotonMapper mapper(two, settings, abilities<Budgeting>);
    CHECK(mapper.settings().caustics.light_shares ==
          caustic_light_shares(two, settings));
    CHECK(mapper.settings().caustics.light_shares.size() == 2);
    settings.caustics.light_shares = {0.25, 0.75};
    CHECK(caustic_light_shares(two, settings) == std::vector{0.25, 0.75});

    // The presets ask it, without a pilot of objects.
    CHECK_FALSE(preset_settings(Preset::exact, 100, 100).share_lights);
    for (const Preset preset : {Preset::draft, Preset::fast}) {
        auto asked = preset_settings(preset, 100, 100);
        CHECK(asked.share_lights);
        asked.indirect = IndirectLight::none;
        const PhotonMapper by_preset(two, asked, abilities<Budgeting>);
        CHECK(by_preset.settings().caustics.light_shares ==
              pilot_lights(two, asked.caustics));
        CHECK(by_preset.settings().caustics.shares.empty());
    }
    CHECK(refusal([&] {
              (void)trace_photons(one, MapType::caustics,
                                  {.photons = 9, .light_shares = {0.5, 0.5}});
          }) == "the number of shares is 2; it must be the number of lights.");
}
