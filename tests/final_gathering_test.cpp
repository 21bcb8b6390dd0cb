#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ljus/render/photon_mapping.hpp"
#include "ljus/scenes/furnaces.hpp"
#include "support/mean.hpp"
#include "support/within.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

constexpr double pi = std::numbers::pi;

/// The volume under Epanechnikov's hill on one side of a line, by the midpoint rule.
double part_by_rule(double s) {
    constexpr int n = 1000;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double x = 2 * (i + 0.5) / n - 1, y = 2 * (j + 0.5) / n - 1;
            if (x * x + y * y < 1 && x < s)
                sum += 2 / pi * (1 - x * x - y * y) * 4 / (double(n) * n);
        }
    return sum;
}

using Flat = Scene<Shapes<Quad, Triangle>, Materials<Lambertian>>;

/// A unit square at z = 0, whole or of two triangles.
Flat square(bool two_triangles) {
    Flat scene;
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.5f}});
    if (two_triangles) {
        scene.add(Triangle{.v1{0, 0, 0}, .v2{1, 0, 0}, .v3{1, 1, 0}}, grey);
        scene.add(Triangle{.v1{0, 0, 0}, .v2{1, 1, 0}, .v3{0, 1, 0}}, grey);
    } else {
        scene.add(Quad{.corner{0, 0, 0}, .edge_u{1, 0, 0}, .edge_v{0, 1, 0}}, grey);
    }
    return scene;
}

/// Lets every photon count, for estimate_irradiance().
constexpr auto all_photons = [](std::uint32_t) { return true; };

Vertex at(const Flat& scene, float x, float y) {
    const Ray ray{.origin{x, y, 0.1f}, .direction{0, 0, -1}};
    const auto hit = closest_hit(scene, ray);
    REQUIRE(hit);
    return vertex_at(scene, ray, *hit);
}

/// Indirect photons, so many on the unit square, 1 W in all, from above or below.
PhotonMap even_photons(int count, std::uint64_t seed, bool above = true) {
    auto stream = random_stream(seed, Pass::user, 0, 0);
    std::vector<Photon> photons;
    for (int i = 0; i < count; ++i)
        photons.push_back({.position = Vec3(next_2d(stream), 0),
                           .direction{0, 0, above ? -1.0f : 1.0f},
                           .flux = Rgb{1 / float(count)},
                           .kind = PhotonKind::indirect,
                           .normal = small_normal(Vec3{0, 0, 1})});
    return make_photon_map(photons);
}

} // namespace

TEST_CASE("final gathering: the part of the kernel beside a line") {
    for (const double s : {-0.9, -0.3, 0.0, 0.2, 0.7, 0.95})
        CHECK(detail::kernel_part(s) == doctest::Approx(part_by_rule(s)).epsilon(2e-3));
    CHECK(detail::kernel_part(-1.0) == 0);
    CHECK(detail::kernel_part(1.0) == 1);
    CHECK(detail::kernel_part(7.0) == 1);
    CHECK(detail::kernel_part(-7.0) == 0);
    CHECK(detail::kernel_part(std::nan("")) == 1); // no correction
    for (const double s : {0.1, 0.5, 0.8}) // the two sides of a line are the whole
        CHECK(detail::kernel_part(s) + detail::kernel_part(-s) == doctest::Approx(1));
}

TEST_CASE("final gathering: what lies on the surface near its edges") {
    const Vec3 up{0, 0, 1};
    for (const bool triangles : {false, true}) {
        const Flat scene = square(triangles);
        const auto part = [&](float x, float y, float radius) {
            return detail::part_on_surface(scene, at(scene, x, y), up, radius);
        };
        CAPTURE(triangles);
        CHECK(part(0.5f, 0.45f, 0.1f) == 1); // the diagonal is no edge
        CHECK(part(0.05f, 0.4f, 0.1f) == doctest::Approx(detail::kernel_part(0.5f)));
        CHECK(part(0.98f, 0.6f, 0.1f) == doctest::Approx(detail::kernel_part(0.2f)));
        if (!triangles) // where triangles meet a corner each edge is seen by one of them
            CHECK(
                part(0.05f, 0.02f, 0.1f) ==
                doctest::Approx(detail::kernel_part(0.5f) * detail::kernel_part(0.2f)));
    }
}

TEST_CASE("final gathering: an even light is found in the middle and at the edge") {
    // 1 W on a unit square is 1 W/m^2. Over 16 maps; 6 comparisons of 4 standard errors
    // and one of a bias of 3 %, which the product of two edges has at a corner.
    const Flat scene = square(false);
    const Vec3 up{0, 0, 1};
    const IrradiancePointSettings how{.nearest = 50};
    IrradiancePointSettings plain = how;
    plain.edges = false;
    Mean middle, edge, corner, cut, own, others, below;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        const PhotonMap map = even_photons(20000, seed);
        const auto estimate = [&](float x, float y, const IrradiancePointSettings& s) {
            return double(detail::estimate_irradiance(scene, map, at(scene, x, y), up,
                                                      s, 0.3f, all_photons)
                              .x);
        };
        for (int i = 0; i < 10; ++i) {
            const float t = 0.1f + 0.08f * float(i);
            middle.add(estimate(t, 0.5f, how));
            edge.add(estimate(t, 0.001f, how));
            cut.add(estimate(t, 0.001f, plain));
        }
        for (const float x : {0.001f, 0.999f})
            for (const float y : {0.001f, 0.999f}) corner.add(estimate(x, y, how));
        // At photons: the one that lies there says nothing.
        for (std::uint32_t i = 0; i < 20000; i += 100) {
            const Vec3 p = map.tree.point(i);
            if (std::abs(p.x - 0.5f) > 0.4f || std::abs(p.y - 0.5f) > 0.4f) continue;
            const Vertex there = at(scene, p.x, p.y);
            own.add(double(detail::estimate_irradiance(scene, map, there, up, how, 0.3f,
                                                       all_photons)
                               .x));
            const auto not_i = [i](std::uint32_t k) { return k != i; };
            others.add(double(
                detail::estimate_irradiance(scene, map, there, up, how, 0.3f, not_i)
                    .x));
        }
        // From the other side nothing comes.
        below.add(double(detail::estimate_irradiance(scene, map, at(scene, 0.5f, 0.5f),
                                                     -up, how, 0.3f, all_photons)
                             .x));
    }
    CHECK(std::abs(apart(middle, 1)) < 4);
    CHECK(std::abs(apart(edge, 1)) < 4);
    CHECK(std::abs(corner.mean - 1) < 4 * corner.error() + 0.05);
    CHECK(std::abs(apart(cut, 0.5)) < 4);
    CHECK(std::abs(apart(others, 1)) < 4);
    CHECK(own.mean > 1.02); // 2/50 too much
    CHECK(below.mean == 0);
}

TEST_CASE("final gathering: fewer photons than asked for are spread over the disc") {
    // 100 photons of 0.01 W on a unit square, 28 in the disc in the mean, k of 64: all of
    // them count. 400 maps, 4 standard errors.
    const Flat scene = square(false);
    Mean few;
    for (std::uint64_t seed = 1; seed <= 400; ++seed)
        few.add(double(detail::estimate_irradiance(scene, even_photons(100, seed),
                                                   at(scene, 0.5f, 0.5f), Vec3{0, 0, 1},
                                                   {.nearest = 64}, 0.3f, all_photons)
                           .x));
    CHECK(std::abs(apart(few, 1)) < 4);
}

TEST_CASE("final gathering: what is looked up is right in the mean over a surface") {
    // Where there are too many photons by chance there must not be more points as well,
    // or their numbers, too large, would each stand for less of the surface. With points
    // in the tree's order and 16 photons an estimate is 4 % too dark. Over 64 maps; three
    // comparisons of 4 standard errors.
    const Flat scene = square(false);
    for (const int every : {2, 8, 32}) {
        Mean mean;
        for (std::uint64_t seed = 1; seed <= 64; ++seed) {
            const IrradiancePoints points =
                make_irradiance_points(scene, even_photons(8000, seed), PhotonMap{},
                                       {.every = every, .nearest = 16}, seed, 1);
            double sum = 0;
            for (int y = 0; y < 40; ++y)
                for (int x = 0; x < 40; ++x)
                    sum += double(irradiance_at(points,
                                                Vec3{0.2f + 0.015f * float(x),
                                                     0.2f + 0.015f * float(y), 0},
                                                Vec3{0, 0, 1})
                                      .x);
            mean.add(sum / 1600);
        }
        CAPTURE(every);
        CHECK(std::abs(apart(mean, 1)) < 4);
    }
}

TEST_CASE("final gathering: a radius from the photons") {
    // Of n points on a unit square, k lie within r = sqrt(k / (pi n)) in the mean.
    const PhotonMap map = even_photons(50000, 3);
    for (const std::size_t k : {8u, 32u, 200u})
        CHECK(double(typical_radius(map, k)) ==
              ljus_test::within(std::sqrt(double(k) / (pi * 50000)), 0.05));
    CHECK(typical_radius(PhotonMap{}, 32) == 1);
    CHECK(typical_radius(even_photons(1, 1), 32) == 1);
    CHECK(typical_radius(make_photon_map(std::vector<Photon>(40)), 32) == 1);
    // Fewer than k: as far as the farthest.
    const float few = typical_radius(even_photons(5, 1), 32);
    CHECK(few > 0.1f);
    CHECK(few < 1.5f);
}

TEST_CASE("final gathering: points answer for their own side and their own surface") {
    IrradiancePoints points;
    const std::vector<Vec3> places{{0, 0, 0}, {0, 0, 0.001f}, {1, 0, 0}};
    points.tree = KdTree8(places);
    const std::vector<IrradianceAtT<float>> known{
        {Rgb{1}, {0, 0, 1}}, {Rgb{2}, {0, 0, -1}}, {Rgb{3}, {1, 0, 0}}};
    for (const std::uint32_t i : points.tree.point_ids())
        points.records.push_back(known[i]);
    points.radius = 2;
    CHECK(irradiance_at(points, Vec3{0}, Vec3{0, 0, 1}).x == 1);
    CHECK(irradiance_at(points, Vec3{0}, Vec3{0, 0, -1}).x == 2);
    CHECK(irradiance_at(points, Vec3{0}, Vec3{1, 0, 0}).x == 3);
    CHECK(irradiance_at(points, Vec3{0}, Vec3{0, 1, 0}).x == 0); // nobody knows
    points.radius = 0.5f;
    CHECK(irradiance_at(points, Vec3{0}, Vec3{1, 0, 0}).x == 0); // too far
    CHECK(irradiance_at(IrradiancePoints{}, Vec3{0}, Vec3{1, 0, 0}).x == 0);
}

TEST_CASE("final gathering: in a furnace every way of gathering finds L / (1 - a)") {
    // Emission 1, albedo 0.5: radiance 2. One ray in ten thousand meets an edge, where
    // the estimate is not exact; 1 % is allowed for the bias, and 4 standard errors of
    // 16 pictures each.
    const auto room = box_furnace(Rgb{1}, Rgb{0.5f});
    for (const IndirectLight indirect : {IndirectLight::gather, IndirectLight::cache}) {
        Mean seen, known;
        for (std::uint64_t seed = 1; seed <= 16; ++seed) {
            PhotonMappingSettings settings{.direct = DirectLight::analytic,
                                           .indirect = indirect};
            settings.general.photons = 4000;
            settings.general.seed = seed;
            settings.general.threads = 1;
            const RenderSettings picture{
                .width = 24, .height = 24, .samples = 4, .seed = seed, .threads = 1};
            auto maps = make_photon_maps(room.scene, settings);
            for (const auto& record : maps.irradiance.records)
                known.add(double(record.irradiance.x) / pi);
            add_irradiance_cache(maps, room.scene, room.camera, picture, settings);
            CHECK(maps.cache.empty() == (indirect == IndirectLight::gather));
            const auto mapper = make_photon_mapper(room.scene, maps, settings);
            double sum = 0;
            for (const Rgb& pixel : render(mapper, room.camera, picture).image.pixels)
                sum += double(pixel.x) / (24 * 24);
            seen.add(sum);
        }
        CAPTURE(int(indirect));
        CAPTURE(seen.mean);
        CAPTURE(seen.error());
        CHECK(std::abs(seen.mean - 2) < 4 * seen.error() + 0.01);
        CHECK(std::abs(known.mean - 2) < 0.02);
    }
}

TEST_CASE("final gathering: settings that give no picture are refused") {
    const auto room = box_furnace(Rgb{1}, Rgb{0.5f});
    const auto refused = [&](auto change) {
        PhotonMappingSettings settings;
        change(settings);
        CHECK_THROWS_AS((void)make_photon_maps(room.scene, settings),
                        std::invalid_argument);
    };
    refused([](auto& s) { s.irradiance.every = 1; });
    refused([](auto& s) { s.irradiance.nearest = 1; });
    refused([](auto& s) { s.irradiance.nearest = 513; });
    refused([](auto& s) { s.irradiance.radius = -1; });
    refused([](auto& s) { s.irradiance.shadow_rays = 0; });
    refused([](auto& s) { s.gather.rays = 0; });
    refused([](auto& s) { s.gather.tile = 0; });
    refused([](auto& s) { s.gather.nearest = 1; });
    refused([](auto& s) { s.gather.nearest = 65; });
    refused([](auto& s) { s.gather.reach = 0; });
    refused([](auto& s) { s.gather.max_depth = 1; });
    refused([](auto& s) { s.caustics_estimate.radius = -0.1f; });
}
