/// \file lamp_shares_test.cpp
/// \brief Shares of photons by lamp: fifty sealed lamps do not starve the one that is
/// seen, and the light stays the same.
///
/// Means are held within 5 standard errors: a false alarm once in 1.7 million.

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "ljus/geometry/quad.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/render/gathering.hpp"
#include "ljus/render/lamp_shares.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"

using namespace ljus;
using ljus_test::apart;
using ljus_test::Mean;

namespace {

using RoomScene = Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Mirror, Glass>>;

/// A box of the side `side` around a lamp below its top.
void add_sealed_lamp(RoomScene& scene, MaterialId wall, const Vec3& low, float side,
                     const Rgb& radiance) {
    for (const Quad& q : sides_of(Box{low, low + Vec3{side}})) scene.add(q, wall);
    const Vec3 corner = low + side * Vec3{0.3f, 0.95f, 0.3f};
    scene.add(Quad{corner, {0.4f * side, 0, 0}, {0, 0, 0.4f * side}}, wall, radiance);
}

/// A room of 2 x 2 x 2 with a lamp at its ceiling.
RoomScene room_with_lamp() {
    RoomScene scene;
    const auto wall = scene.add(Lambertian{.albedo{0.7f, 0.6f, 0.5f}});
    for (const Quad& q : sides_of(Box{{-1, 0, -1}, {1, 2, 1}}))
        scene.add(q, wall, {}, true);
    scene.add(Quad{{-0.2f, 1.99f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f}}, wall, Rgb{10});
    return scene;
}

constexpr MaterialId wall{0, 0};

/// With that many sealed lamps behind the building, each of the power of that lamp.
World<RoomScene> room_before_sealed(int lamps) {
    RoomScene scene = room_with_lamp();
    for (int i = 0; i < lamps; ++i)
        add_sealed_lamp(scene, wall,
                        {-2 + 0.4f * float(i % 10), 0.4f * float(i / 10), -3}, 0.3f,
                        Rgb{1000.0f / 9});
    return World(std::move(scene));
}

const Camera camera = look_at(
    View{.position{0, 1, 0.95f}, .target{0, 1, -1}, .up{0, 1, 0}, .vfov_degrees = 80});

PhotonMappingSettings settings_of(long long photons) {
    PhotonMappingSettings settings{.indirect = IndirectLight::map};
    settings.general.photons = settings.caustics.photons = photons;
    settings.general.seed = settings.caustics.seed = ljus_test::test_seed(3);
    settings.general.threads = settings.caustics.threads = 1;
    settings.general.shadow_photons = false;
    return settings;
}

template <typename W>
std::vector<double> general_shares(const W& world, PhotonMappingSettings settings) {
    return share_by_sight(world, camera, settings, 80, 60).general.light_shares;
}

/// The flux that photons bring into the room, one value per seed.
template <typename W>
Mean flux_in_room(const W& world, const std::vector<double>& shares) {
    Mean mean;
    for (std::uint64_t seed = 1; seed <= 64; ++seed) {
        double flux = 0;
        const auto traced = trace_photons(world, MapType::general,
                                          {.photons = 3000,
                                           .seed = ljus_test::test_seed(seed),
                                           .shadow_photons = false,
                                           .light_shares = shares,
                                           .threads = 1});
        for (const Photon& photon : traced.photons)
            if (photon.position.z > -1.1f) flux += double(photon.flux.y);
        mean.add(flux);
    }
    return mean;
}

} // namespace

TEST_CASE("lamp shares: fifty sealed lamps do not starve the one that is seen") {
    const auto world = room_before_sealed(50);
    REQUIRE(world.light_count() == 51);
    const auto shares = general_shares(world, settings_of(41000));
    REQUIRE(shares.size() == 51);
    CHECK(std::accumulate(shares.begin(), shares.end(), 0.0) == doctest::Approx(1));
    CHECK(shares[0] == doctest::Approx(0.9 + 0.1 / 51).epsilon(1e-3));
    for (std::size_t i = 1; i < shares.size(); ++i)
        CHECK(shares[i] == doctest::Approx(0.1 / 51).epsilon(1e-3));

    const Mean by_power = flux_in_room(world, {}),
               by_sight = flux_in_room(world, shares);
    CHECK(std::abs(apart(by_power, by_sight)) < 5);
    // 46 times as many of the photons are sent into the room. The quotient of two
    // variances of 64 values is within a factor 3 of that but once in 100 000.
    const double gain = by_power.variance() / by_sight.variance();
    CHECK(gain > 15);
    CHECK(gain < 140);
}

TEST_CASE("lamp shares: a picture keeps its mean, and loses noise") {
    const auto world = room_before_sealed(50);
    const auto picture_of = [&](bool shared, std::uint64_t seed) {
        auto settings = settings_of(41000);
        settings.general.seed = ljus_test::test_seed(seed);
        settings.general_estimate.radius = 0.3f;
        if (shared) settings = share_by_sight(world, camera, settings, 16, 16);
        const PhotonMapper mapper(world, settings);
        const Image image = render(mapper, camera,
                                   {.width = 16,
                                    .height = 16,
                                    .samples = 4,
                                    .seed = ljus_test::test_seed(seed),
                                    .threads = 1})
                                .image;
        double sum = 0;
        for (const Rgb& c : image.pixels) sum += double(c.y);
        return sum / double(image.pixels.size());
    };
    Mean by_power, by_sight;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        by_power.add(picture_of(false, seed));
        by_sight.add(picture_of(true, seed));
    }
    CHECK(std::abs(apart(by_power, by_sight)) < 5);
    CHECK(by_sight.error() < by_power.error());
}

TEST_CASE("lamp shares: a closed box in the room is seen from outside only") {
    RoomScene scene = room_with_lamp();
    add_sealed_lamp(scene, wall, {-0.3f, 0.2f, -0.6f}, 0.6f, Rgb{100});
    const World world(std::move(scene));
    const auto shares = general_shares(world, settings_of(41000));
    REQUIRE(shares.size() == 2);
    // Photons lie on the inner sides of its walls, within the radius of seen places.
    const double power = probability_of<double>(world.light_choice(), 1);
    CHECK(power > 0.7);
    CHECK(shares[1] < 0.1 * power + 0.01);
}

TEST_CASE("lamp shares: what a mirror shows is seen, and the mirror itself is not") {
    RoomScene scene = room_with_lamp();
    const auto mirror = scene.add(Mirror{.reflectance = Rgb{1}});
    scene.add(Quad{{-1, 0, -0.99f}, {2, 0, 0}, {0, 2, 0}}, mirror);
    const World world(std::move(scene));
    const View view{
        .position{0, 1, 0.5f}, .target{0, 1, -1}, .up{0, 1, 0}, .vfov_degrees = 40};
    const auto places = seen_places(world, look_at(view), 40, 40, 1);
    CHECK(places.records.size() == 2048); // two on each path
    int front = 0, back = 0; // a few lie on other walls, close to the mirror
    for (std::size_t i = 0; i < places.records.size(); ++i) {
        back += places.tree.point(i).z < -0.98f ? 1 : 0;
        front += places.tree.point(i).z > 0.99f ? 1 : 0;
    }
    CHECK(front > 800);
    CHECK(back < 50);
}

TEST_CASE("lamp shares: caustics that nobody sees leave their photons to the others") {
    RoomScene scene = room_with_lamp();
    const auto glass = scene.add(Glass{});
    scene.add(Sphere{{0, 0.5f, -0.3f}, 0.4f}, glass);
    add_sealed_lamp(scene, wall, {-1, 0, -5}, 2, Rgb{100});
    scene.add(Sphere{{0, 0.9f, -4}, 0.6f}, glass);
    const World world(std::move(scene));
    auto settings = settings_of(20000);
    const auto anywhere = pilot_lights(world, settings.caustics);
    REQUIRE(anywhere.size() == 2);
    CHECK(anywhere[1] > 0.5); // its caustic is the stronger one
    const auto seen = share_by_sight(world, camera, settings, 80, 60);
    REQUIRE(seen.caustics.light_shares.size() == 2);
    CHECK(seen.caustics.light_shares[1] < 0.11);
}

TEST_CASE("lamp shares: a pilot of few photons counts little, and biases nothing") {
    // A quarter of the photons are the pilot's. It finds light of the first lamp alone.
    const auto world = room_before_sealed(50);
    for (const auto& [photons, each] :
         {std::pair{40800, 200.0}, {20400, 100.0}, {6120, 30.0}}) {
        const auto shares = general_shares(world, settings_of(photons));
        REQUIRE(shares.size() == 51);
        const double sight = 9 * each / (9 * each + 200);
        CHECK(pilot_weight(each) == doctest::Approx(sight));
        CHECK(shares[0] == doctest::Approx(sight + (1 - sight) / 51).epsilon(1e-3));
        for (std::size_t i = 1; i < shares.size(); ++i)
            CHECK(shares[i] == doctest::Approx((1 - sight) / 51).epsilon(0.02));
    }
    CHECK(general_shares(world, settings_of(3)).empty()); // a quarter is none
    CHECK(pilot_weight(0) == 0);
    CHECK(pilot_weight(1e6) == 0.9);
    const auto few = general_shares(world, settings_of(6120));
    CHECK(std::abs(apart(flux_in_room(world, {}), flux_in_room(world, few))) < 5);
}

TEST_CASE("lamp shares: what is given stays as it is") {
    const auto one = room_before_sealed(0);
    CHECK(general_shares(one, settings_of(41000)).empty());
    const auto world = room_before_sealed(3);
    auto given = settings_of(41000);
    given.general.light_shares = {0.4, 0.3, 0.2, 0.1};
    CHECK(general_shares(world, given) == given.general.light_shares);
    // Without a general map there is nothing to share.
    auto rays = settings_of(41000);
    rays.indirect = IndirectLight::rays;
    CHECK(general_shares(world, rays).empty());
    // The same camera, seed and photons give the same shares.
    CHECK(general_shares(world, settings_of(9000)) ==
          general_shares(world, settings_of(9000)));
}
