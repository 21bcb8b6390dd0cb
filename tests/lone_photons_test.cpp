// concept: caustics
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ljus/geometry/quad.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/photons/lone_photons.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/seed.hpp"

using namespace ljus;

namespace {

/// A photon that falls onto the floor.
Photon photon_at(float x, float z, float flux) {
    Photon photon{.position{x, 0, z}, .direction{0, -1, 0}, .flux = Rgb{flux}};
    photon.kind = PhotonKind::caustic;
    photon.normal = detail::SmallNormal{0, 127, 0};
    return photon;
}

/// A dense spot of photons around the middle, and some that are thrown over the floor.
std::vector<Photon> spot_and_strays(int spot, int strays, std::uint64_t seed) {
    auto stream = random_stream(ljus_test::test_seed(seed), Pass::user, 0, 0);
    std::vector<Photon> photons;
    for (int i = 0; i < spot + strays; ++i) {
        const float half = i < spot ? 0.1f : 1.0f;
        const Vec2 at = half * (2.0f * next_2d(stream) - 1.0f);
        photons.push_back(photon_at(at.x, at.y, 0.5f + next_1d(stream)));
    }
    return photons;
}

auto white_floor() {
    return World(make_scene(
        placed(Quad{{-3, 0, -3}, {0, 0, 6}, {6, 0, 0}}, Lambertian{.albedo = Rgb{1}})));
}

PhotonMappingSettings caustics_alone(float radius, float lone_radius) {
    PhotonMappingSettings settings{.indirect = IndirectLight::none,
                                   .caustics_estimate{.radius = radius},
                                   .lone_radius = lone_radius};
    settings.caustics.photons = 0; // they come from elsewhere
    return settings;
}

} // namespace

TEST_CASE("lone photons: those with fewer than three others within the radius") {
    for (const int strays : {0, 3, 100})
        for (const int spot : {0, 1, 3, 4, 5, 300}) {
            const auto photons = spot_and_strays(spot, strays, 7);
            for (const float radius : {0.02f, 0.15f, 10.f}) {
                std::vector<Photon> right;
                for (const Photon& photon : photons) {
                    int others = -1; // without itself
                    for (const Photon& other : photons)
                        others +=
                            glm::distance(photon.position, other.position) <= radius;
                    if (others < 3) right.push_back(photon);
                }
                const auto found = lone_photons(make_photon_map(photons), radius);
                REQUIRE(found.records.size() == right.size());
                for (std::size_t i = 0; i < right.size(); ++i) {
                    const auto record = found.records[i];
                    const auto same = [&](const Photon& photon) {
                        return photon.position == found.tree.point(i) &&
                               photon.flux == record.flux &&
                               photon.direction == record.direction &&
                               photon.kind == record.kind &&
                               photon.normal.y == record.normal.y;
                    };
                    CHECK(std::count_if(right.begin(), right.end(), same) == 1);
                }
            }
        }
}

TEST_CASE("lone photons: no dots, and no light is lost or added") {
    const auto floor = white_floor();
    auto photons = spot_and_strays(400, 30, 3);
    photons.push_back(photon_at(2, 2, 1)); // far from all others
    const float radius = 0.05f, times = 6;
    double all = 0;
    for (const Photon& photon : photons) all += double(photon.flux.x);
    const auto seen = [&](const auto& mapper, float x, float z) {
        auto stream = random_stream(1, Pass::user, 0, 0);
        Counts counts;
        auto context = context_of(stream, counts);
        const Ray down{.origin{x, 1, z}, .direction{0, -1, 0}};
        return double(radiance(mapper, down, context).x);
    };
    for (const float lone : {1.0f, times}) {
        PhotonMapper mapper(floor, caustics_alone(radius, lone));
        mapper.set_caustics(make_photon_map(photons));
        CHECK(mapper.maps().lone.empty() == (lone == 1));
        // The flux of all photons over pi, by a grid of cells of an eighth of a radius.
        const double cell = double(radius) / 8;
        double sum = 0, least = 0;
        for (double x = -2.5; x < 2.5; x += cell)
            for (double z = -2.5; z < 2.5; z += cell) {
                const double light = seen(mapper, float(x), float(z));
                sum += light * cell * cell;
                least = std::min(least, light);
            }
        CHECK(sum == doctest::Approx(all / std::numbers::pi).epsilon(0.01));
        CHECK(least >= 0);
        // Epanechnikov's kernel is 2 in the middle of the disc.
        const double wide = double(radius) * double(lone);
        CHECK(
            seen(mapper, 2, 2) ==
            doctest::Approx(2 / (std::pow(std::numbers::pi * wide, 2))).epsilon(1e-4));
    }
    // Where photons lie close together, not a bit changes.
    PhotonMapper plain(floor, caustics_alone(radius, 1));
    PhotonMapper wide(floor, caustics_alone(radius, times));
    const auto dense = make_photon_map(spot_and_strays(4000, 0, 5));
    plain.set_caustics(dense);
    wide.set_caustics(dense);
    CHECK(wide.maps().lone.empty());
    for (const float x : {-0.1f, 0.0f, 0.07f})
        CHECK(seen(wide, x, 0) == seen(plain, x, 0));
}

TEST_CASE("lone photons: the same picture if estimates are made together") {
    const auto floor = white_floor();
    PhotonMapper mapper(floor, caustics_alone(0.05f, 6));
    mapper.set_caustics(make_photon_map(spot_and_strays(400, 30, 9)));
    REQUIRE_FALSE(mapper.maps().lone.empty());
    const Camera camera = look_at({.position{0, 2, 2}, .target{0, 0, 0}});
    const RenderSettings picture{.width = 24, .height = 24, .samples = 1, .threads = 1};
    const auto together = render(mapper, camera, picture).image;
    const PictureRays rays(picture);
    double lit = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            Counts counts;
            const Rgb alone =
                trace_pixel(mapper, camera, rays, {x, y, 0}, counts).radiance;
            CHECK(pixel(together, x, y).x == doctest::Approx(alone.x).epsilon(1e-4));
            lit += alone.x > 0;
        }
    CHECK(lit > 50);
}

TEST_CASE("lone photons: who asks, and what is refused") {
    CHECK(preset_settings(Preset::draft, 100, 100).lone_radius == 4);
    CHECK(preset_settings(Preset::fast, 100, 100).lone_radius == 4);
    CHECK(preset_settings(Preset::exact, 100, 100).lone_radius == 1);
    CHECK(PhotonMappingSettings{}.lone_radius == 1);
    const auto floor = white_floor();
    CHECK_THROWS_WITH_AS(PhotonMapper(floor, {.lone_radius = 0.5f}),
                         "lone_radius is 0.5; it must be within [1, 1000].",
                         std::invalid_argument);
    // The k nearest photons set their own radius.
    auto settings = caustics_alone(0.05f, 6);
    settings.caustics_estimate.nearest = 10;
    PhotonMapper nearest(floor, settings);
    nearest.set_caustics(make_photon_map(spot_and_strays(40, 30, 9)));
    CHECK(nearest.maps().lone.empty());
}
