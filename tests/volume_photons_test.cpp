/// \file volume_photons_test.cpp
/// \brief Photons in fog: the beam estimate against quadrature, the photons that a pass
/// stores against closed forms, and whole pictures against path tracing.
///
/// Means are held within 5 standard errors: a false alarm once in 1.7 million.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "ljus/inspect/metrics.hpp"
#include "ljus/inspect/survey.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/soap_film.hpp"
#include "ljus/media/fog.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/photons/volume_photons.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/progressive.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scenes/cornell_box.hpp"
#include "support/integrate.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"

using namespace ljus;
using ljus_test::Mean;
using ljus_test::mean_radiance;
using ljus_test::refusal;

namespace user {

/// A ball of fog with the functions that the concept Medium requires, and no others.
struct Smoke {
    using Scalar = float;
    Fog<Sphere> fog;
    friend void check(const Smoke& s) { check(s.fog); }
    friend Box bounds(const Smoke& s) { return bounds(s.fog); }
    friend auto span_in(const Smoke& s, const Ray& ray) { return span_in(s.fog, ray); }
    friend Rgb extinction(const Smoke& s) { return extinction(s.fog); }
    friend Rgb scattering(const Smoke& s) { return scattering(s.fog); }
    friend float phase(const Smoke& s, float cosine) { return phase(s.fog, cosine); }
    friend Vec3 sample_phase(const Smoke& s, const Vec3& travel, const Vec2& u) {
        return sample_phase(s.fog, travel, u);
    }
};

} // namespace user

namespace {

using Place = Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Glass, Mirror>,
                    Lights<PointLight, SunLight>, Media<Fog<Sphere>, Fog<Box>>>;

/// Two media that overlap, and nothing to see far away.
World<Place> two_fogs() {
    Place scene;
    scene.add(Sphere{.center{0, 0, 50}, .radius = 1}, scene.add(Lambertian{}));
    scene.add(Fog<Sphere>{.region{.radius = 3}, .scattering{0.2f, 0.1f, 0}, .g = 0.5f});
    scene.add(Fog<Box>{.region{{-4, -4, 0}, {4, 4, 4}},
                       .absorption = Rgb{0.1f},
                       .scattering{0, 0.1f, 0.3f},
                       .g = -0.2f});
    return World(std::move(scene));
}

/// Photons at random places of a cube, as a pass stores them.
std::vector<Photon> some_photons(int count, std::uint64_t seed) {
    std::vector<Photon> photons;
    auto stream = random_stream(seed, Pass::user, 0, 0);
    for (int i = 0; i < count; ++i)
        photons.push_back({.position = 4.0f * next_3d<float>(stream) - 2.0f,
                           .direction = sample_uniform_sphere(next_2d<float>(stream)),
                           .flux = next_3d<float>(stream),
                           .light = std::uint16_t(i % 2),
                           .kind = PhotonKind::fog});
    return photons;
}

/// A box with a large lamp, glass and a mirror in coloured fog.
World<Place> foggy_box() {
    Place scene;
    add_cornell_walls(scene);
    scene.add(Sphere{.center{0.2f, 1.5f, 0}, .radius = 0.3f},
              scene.add(Lambertian{.albedo = Rgb{0}}), Rgb{4});
    scene.add(Sphere{.center{-0.4f, 0.7f, 0.2f}, .radius = 0.4f}, scene.add(Glass{}));
    scene.add(Sphere{.center{0.5f, 0.4f, 0.1f}, .radius = 0.35f}, scene.add(Mirror{}));
    scene.add(Fog<Box>{.region{{-1, 0, -1}, {1, 2, 1}},
                       .absorption{0, 0.1f, 0.3f},
                       .scattering{0.4f, 0.6f, 1.5f},
                       .g = 0.4f});
    return World(std::move(scene));
}

/// The sum of the fluxes of fog photons.
RgbT<double> flux_in_fog(const std::vector<Photon>& photons) {
    RgbT<double> sum{0};
    for (const Photon& photon : photons)
        if (photon.kind == PhotonKind::fog) sum += RgbT<double>(photon.flux);
    return sum;
}

constexpr PhotonKinds fog_only = one_kind(PhotonKind::fog);

} // namespace

TEST_CASE("volume_photons: over all parallel rays a photon gives its flux, dimmed") {
    const auto world = two_fogs();
    const Vec3 travel = glm::normalize(Vec3{1, -2, 0.5f});
    for (const Kernel kernel : {Kernel::box, Kernel::cone, Kernel::gaussian,
                                Kernel::epanechnikov, Kernel::biweight})
        for (const std::uint32_t medium : {0u, 1u}) {
            CAPTURE(int(kernel));
            const VolumePhoton photon{
                {0.3f, -0.2f, 1}, travel, {1, 2, 3}, 0.4f, medium};
            // Rays along +z: 3 units of the ball of fog, 1 of the box, about.
            RgbT<double> sum{0};
            constexpr int n = 400;
            for (int i = 0; i < n * n; ++i) {
                const float x = (float(i % n) + 0.5f) / n - 0.5f;
                const float y = (float(i / n) + 0.5f) / n - 0.5f;
                const Ray ray{.origin{0.3f + x, -0.2f + y, -5}, .direction{0, 0, 1}};
                sum += RgbT<double>(light_of_photon(world, photon, ray, kernel)) /
                       double(n * n);
            }
            const double cosine = -double(travel.z), g = medium == 0 ? 0.5 : -0.2;
            const double phase = (1 - g * g) / (4 * std::numbers::pi) /
                                 std::pow(1 + g * g - 2 * g * cosine, 1.5);
            const double in_ball = 1 + std::sqrt(9 - 0.13);
            const double depth[] = {0.2 * in_ball + 0.1, 0.1 * in_ball + 0.2, 0.4};
            for (int c = 0; c < 3; ++c)
                CHECK(sum[c] == doctest::Approx(phase * (c + 1) * std::exp(-depth[c]))
                                    .epsilon(0.01));
        }
}

TEST_CASE("volume_photons: along its border fog is as bright as within, and dark out") {
    // Photons evenly spread over two fogs of the same photons per volume.
    Place scene;
    scene.add(Sphere{.center{0, 0, 50}, .radius = 1}, scene.add(Lambertian{}));
    scene.add(Fog<Sphere>{.region{.radius = 2}, .scattering = Rgb{1e-4f}});
    scene.add(Fog<Box>{.region{{-2, -2, -2}, {2, 0.05f, 2}}, .scattering = Rgb{1e-4f}});
    const World world(std::move(scene));
    constexpr int count = 100'000;
    std::vector<Photon> photons = some_photons(count, 7);
    for (Photon& photon : photons) photon.flux = Rgb{1};
    std::erase_if(photons, [](const Photon& photon) {
        return photon.light == 0 ? glm::length(photon.position) > 2
                                 : photon.position.y > 0.05f;
    });
    const auto seen = [&](float x, float y, std::uint32_t medium, float radius) {
        std::uint64_t visited = 0;
        VolumeMap of_fog = make_volume_map(photons, {.radius = radius});
        for (VolumePhoton& photon : of_fog.photons)
            if (photon.medium != medium) photon.flux = Rgb{0};
        double sum = 0;
        constexpr int rays = 64; // around the z-axis for the sphere
        for (int i = 0; i < rays; ++i) {
            const float part = (float(i) + 0.5f) / rays;
            const float turn = 2 * std::numbers::pi_v<float> * part;
            const Vec3 origin = medium == 1
                                    ? Vec3{x == 0 ? 3 * part - 1.5f : x, y, -3}
                                    : Vec3{y * std::cos(turn), y * std::sin(turn), -3};
            sum += double(estimate_beam(world, of_fog,
                                        Ray{.origin = origin, .direction{0, 0, 1}},
                                        Kernel::epanechnikov, visited)
                              .x);
        }
        return sum / rays;
    };
    const double density = count / 2.0 / 64 / (4 * std::numbers::pi);
    struct Row {
        float x, y;
        std::uint32_t medium;
        double length;
    };
    for (const Row& is : {Row{0, -1, 1, 4},          // within the box; x varies
                          Row{0, 0.04f, 1, 4},       // along a side
                          Row{1.97f, 0.04f, 1, 4},   // along an edge
                          Row{0, 0.06f, 1, 0},       // outside
                          Row{0, 1.5f, 0, 2.64575},  // within the sphere
                          Row{0, 1.95f, 0, 0.88882}, // near its rim
                          Row{0, 1.98f, 0, 0.56427},
                          Row{0, 2.01f, 0, 0}}) {
        CAPTURE(is.x);
        CAPTURE(is.y);
        CAPTURE(is.medium);
        for (const float radius : {0.2f, 0.8f})
            CHECK(std::abs(seen(is.x, is.y, is.medium, radius) -
                           density * is.length) <= 0.05 * density * is.length);
    }
}

TEST_CASE("volume_photons: a medium without each_image() shows each photon once") {
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<>,
          Media<user::Smoke, Fog<Sphere>>>
        scene;
    scene.add(Sphere{.center{0, 0, 50}, .radius = 1}, scene.add(Lambertian{}));
    const Fog<Sphere> fog{.region{.radius = 2}, .scattering = Rgb{1e-7f}};
    scene.add(user::Smoke{fog});
    scene.add(fog);
    const World world(std::move(scene));
    for (const std::uint32_t medium : {0u, 1u}) { // the photon's image is at x = 2.05
        const VolumePhoton photon{.position{1.95f, 0, 0},
                                  .direction{0, 0, 1},
                                  .flux = Rgb{1},
                                  .radius = 0.5f,
                                  .medium = medium};
        const Ray ray{.origin{1.9f, 0, -3}, .direction{0, 0, 1}};
        const double seen = double(light_of_photon(world, photon, ray, Kernel::box).x);
        const double once = 1 / (std::numbers::pi * std::numbers::pi);
        CAPTURE(medium);
        const double image = medium == 0 ? 0 : 2.05 * 2.05 / (1.95 * 1.95);
        CHECK(seen == doctest::Approx(once * (1 + image)).epsilon(1e-4));
    }
}

TEST_CASE("volume_photons: the tree finds what a loop over all photons finds") {
    const auto world = two_fogs();
    auto stream = random_stream(2, Pass::user, 0, 0);
    for (const BeamEstimateSettings& how :
         {BeamEstimateSettings{},
          BeamEstimateSettings{.radius = 0.3f, .kernel = Kernel::box}}) {
        const VolumeMap map = make_volume_map(some_photons(3000, 1), how);
        REQUIRE(map.photons.size() == 3000);
        std::uint64_t visited = 0;
        int lit = 0;
        for (int i = 0; i < 300; ++i) {
            const Vec3 from = 8.0f * next_3d<float>(stream) - 4.0f;
            const Vec3 to = 4.0f * next_3d<float>(stream) - 2.0f;
            const Ray ray{.origin = from,
                          .direction = glm::normalize(to - from),
                          .t_max = i % 2 == 0 ? glm::distance(from, to) : INFINITY};
            const Rgb loop = estimate_beam_plain(world, map, ray, how.kernel);
            const Rgb tree = estimate_beam(world, map, ray, how.kernel, visited);
            for (int c = 0; c < 3; ++c)
                REQUIRE(tree[c] == doctest::Approx(loop[c]).epsilon(1e-6));
            lit += is_black(loop) ? 0 : 1;
        }
        CHECK(lit > 250);
        CHECK(visited < 300 * 3000 / 4);
    }
}

TEST_CASE("volume_photons: the radius is the distance of the k-th other photon") {
    std::vector<Photon> photons = some_photons(500, 3);
    photons.push_back({.kind = PhotonKind::caustic}); // not in fog
    const VolumeMap map = make_volume_map(photons, {.nearest = 5});
    REQUIRE(map.photons.size() == 500);
    for (const VolumePhoton& photon : map.photons) {
        std::vector<double> distances;
        for (const VolumePhoton& other : map.photons)
            distances.push_back(
                glm::distance(glm::dvec3(photon.position), glm::dvec3(other.position)));
        std::sort(distances.begin(), distances.end());
        CHECK(double(photon.radius) == doctest::Approx(distances[5]).epsilon(1e-5));
    }
    for (const VolumePhoton& photon :
         make_volume_map(some_photons(20, 4), {.radius = 0.25f}).photons)
        CHECK(photon.radius == 0.25f);
    // One alone, and many in one place.
    CHECK(make_volume_map(some_photons(1, 5)).photons[0].radius == 1);
    std::vector<Photon> same(30, some_photons(1, 6)[0]);
    CHECK(make_volume_map(same).photons[7].radius == 1);
    same.push_back(same[0]);
    same.back().position.x += 2;
    CHECK(make_volume_map(same).photons[7].radius == doctest::Approx(2e-3f));
    CHECK(make_volume_map(std::vector<Photon>{}).empty());
    same[3].flux.y = std::nanf("");
    CHECK(refusal([&] { (void)make_volume_map(same); }).starts_with("photon.flux is "));
}

TEST_CASE(
    "volume_photons: in fog without end photons scatter as often as the albedo says") {
    // Of the flux, albedo^n is left after n scatterings; all but the first are stored.
    Place scene;
    scene.add(Sphere{.center{0, 0, 9000}, .radius = 1}, scene.add(Lambertian{}));
    scene.add(PointLight{.intensity = Rgb{float(1 / (4 * std::numbers::pi))}});
    scene.add(Fog<Sphere>{.region{.radius = 5000},
                          .absorption{0.5f, 0.25f, 2},
                          .scattering{0.5f, 0.75f, 1},
                          .g = 0.3f});
    const World world(std::move(scene));
    const double albedo[] = {0.5, 0.75, 1.0 / 3};
    Mean means[3];
    for (std::uint64_t run = 0; run < 20; ++run) {
        const auto traced =
            trace_photons(world, MapType::general,
                          {.photons = 1000, .iteration = run, .keep = fog_only});
        const RgbT<double> flux = flux_in_fog(traced.photons);
        for (int c = 0; c < 3; ++c) means[c].add(flux[c]);
        const FluxAudit& audit = traced.audit;
        const auto sum = audit.absorbed + audit.escaped + audit.cut + audit.roulette;
        for (int c = 0; c < 3; ++c)
            CHECK(sum[c] == doctest::Approx(audit.emitted[c]).epsilon(1e-5));
    }
    for (int c = 0; c < 3; ++c) {
        CAPTURE(c);
        CHECK(means[c].agrees_with(albedo[c] * albedo[c] / (1 - albedo[c]), 1e-4));
    }
}

TEST_CASE(
    "volume_photons: a beam from a mirror has its closed form, in map and picture") {
    // The sun shines straight down on a mirror of 2 by 2, under fog of height 1.
    const double absorb = 0.3, scatter = 0.5, extinct = absorb + scatter;
    Place scene;
    scene.add(Quad{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}},
              scene.add(Mirror{.reflectance = Rgb{0.8f}}));
    scene.add(SunLight{.direction{0, -1, 0}, .irradiance = Rgb{3}});
    scene.add(Fog<Box>{.region{{-2, 0, -2}, {2, 1, 2}},
                       .absorption = Rgb{float(absorb)},
                       .scattering = Rgb{float(scatter)},
                       .g = 0.4f});
    const World world(std::move(scene));
    Mean stored;
    for (std::uint64_t run = 0; run < 20; ++run)
        stored.add(
            flux_in_fog(
                trace_photons(world, MapType::caustics,
                              {.photons = 1000, .iteration = run, .keep = fog_only})
                    .photons)
                .x);
    const double up = 0.8 * 3 * std::exp(-extinct); // irradiance that leaves the mirror
    CHECK(stored.agrees_with(4 * up * (1 - std::exp(-extinct)) * scatter / extinct,
                             1e-4));

    // Across the beam at half its height, without the light that scatters more often.
    const PhotonMapper mapper(
        world, {.indirect = IndirectLight::none,
                .caustics = {.photons = 40000},
                .fog_estimate = {.radius = 0.1f, .kernel = Kernel::box}});
    const auto across = [](RandomStream& stream) {
        return Ray{.origin{-1.5f, 0.5f, next_1d<float>(stream) - 0.5f},
                   .direction{1, 0, 0}};
    };
    // At a right angle; the sun's own light and the beam's.
    const double phase = (1 - 0.16) / (4 * std::numbers::pi) / std::pow(1 + 0.16, 1.5);
    const auto along = [&](double first, double last) {
        return (std::exp(-extinct * first) - std::exp(-extinct * last)) / extinct;
    };
    const double truth = scatter * phase *
                         (up * std::exp(-extinct * 0.5) * along(0.5, 2.5) +
                          3 * std::exp(-extinct * 0.5) * along(0, 3.5));
    const Mean seen = mean_radiance(mapper, 8000, 1, across);
    CHECK(seen.mean == doctest::Approx(truth).epsilon(0.01));
}

TEST_CASE("volume_photons: in a glowing room, fog that absorbs nothing is not seen") {
    for (const float g : {0.0f, 0.7f}) {
        Place scene;
        scene.add(Sphere{.radius = 2}, scene.add(Lambertian{.albedo = Rgb{0.5f}}),
                  Rgb{0.5f}, true);
        scene.add(
            Fog<Sphere>{.region{.radius = 5}, .scattering{0.3f, 1, 0.1f}, .g = g});
        const World world(std::move(scene));
        for (const auto indirect :
             {IndirectLight::rays, IndirectLight::map, IndirectLight::photons}) {
            CAPTURE(g);
            CAPTURE(int(indirect));
            const PhotonMapper mapper(world, {.indirect = indirect,
                                              .general = {.photons = 20000},
                                              .general_estimate = {.radius = 0.25f}});
            constexpr int rays = 700;
            RgbT<double> mean{0};
            Counts counts;
            for (int i = 0; i < rays; ++i) {
                auto stream = random_stream(2, Pass::camera, 0, std::uint64_t(i));
                const Vec3 off = sample_uniform_sphere(next_2d<float>(stream));
                const Ray ray{.origin = 0.5f * off,
                              .direction =
                                  sample_uniform_sphere(next_2d<float>(stream))};
                auto context = context_of(stream, counts);
                mean += RgbT<double>(radiance(mapper, ray, context)) / double(rays);
            }
            // One map for all rays; 2 % is several times what such maps scatter.
            for (int c = 0; c < 3; ++c)
                CHECK(mean[c] == doctest::Approx(1).epsilon(0.02));
        }
    }
}

TEST_CASE("volume_photons: behind fog that lets nothing pass all is finite") {
    Place scene;
    scene.add(Sphere{.radius = 1}, scene.add(Glass{}));
    scene.add(Sphere{.center{0, 9, 0}, .radius = 1}, scene.add(Lambertian{}), Rgb{1});
    scene.add(Fog<Sphere>{.region{.radius = 3}, .scattering = Rgb{1000}});
    const World world(std::move(scene));
    const PhotonMapper mapper(world, {.split_glass = true,
                                      .indirect = IndirectLight::none,
                                      .caustics = {.photons = 0}});
    const auto picture = render(mapper, look_at({.position{0, 0, 5}, .target{0, 0, 0}}),
                                {.width = 8, .height = 8, .samples = 4});
    CHECK(picture.counts.rejected == 0);
}

TEST_CASE("volume_photons: fog dims both halves of direct light") {
    // A ball within a lamp, in fog that absorbs: shadow rays and rays that the material
    // samples share the light.
    Place scene;
    scene.add(Sphere{.radius = 2}, scene.add(Lambertian{.albedo = Rgb{0}}), Rgb{1},
              true);
    scene.add(Sphere{.radius = 0.5f}, scene.add(Lambertian{.albedo = Rgb{0.5f}}));
    scene.add(Fog<Sphere>{.region{.radius = 3}, .absorption = Rgb{0.5f}});
    const World world(std::move(scene));
    const auto seen = [&](DirectLight direct) {
        const PhotonMapper mapper(world,
                                  {.direct = direct, .indirect = IndirectLight::none});
        return mean_radiance(mapper, 4000, 3, [](RandomStream&) {
            return Ray{.origin{-1, 0.1f, 0}, .direction{1, 0, 0}};
        });
    };
    CHECK(std::abs(ljus_test::apart(seen(DirectLight::mis),
                                    seen(DirectLight::sampled))) < 5);
}

TEST_CASE(
    "volume_photons: photon maps and paths give the same picture of a foggy room") {
    // 4 blocks, 6 runs of each method with seeds of their own. A block may be off by 5
    // standard errors, and by 5 % for the radius of the estimates. Of the 36 values, of
    // about 10 degrees of freedom, one is beyond 5 errors once in 50 without those 5 %.
    const auto world = foggy_box();
    const auto blocks = [&](const auto& make, int samples) {
        std::vector<Image> runs;
        for (std::uint64_t seed = 1; seed <= 6; ++seed)
            runs.push_back(
                render(make(seed), cornell_camera(),
                       {.width = 12, .height = 12, .samples = samples, .seed = seed})
                    .image);
        return block_statistics(runs, 6);
    };
    const BlockStatistics truth =
        blocks([&](std::uint64_t) { return PathTracer(world); }, 200);
    const auto check_picture = [&](IndirectLight indirect, DirectLight direct) {
        const auto make = [&](std::uint64_t seed) {
            return PhotonMapper(world, {.direct = direct,
                                        .indirect = indirect,
                                        .caustics = {.photons = 20000, .seed = seed},
                                        .general = {.photons = 20000, .seed = seed},
                                        .caustics_estimate = {.radius = 0.05f},
                                        .general_estimate = {.radius = 0.1f}});
        };
        const BlockStatistics mapped = blocks(make, 4);
        for (std::size_t i = 0; i < truth.mean.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                CAPTURE(int(indirect));
                CAPTURE(int(direct));
                CAPTURE(i);
                CAPTURE(c);
                const double right = truth.mean.pixels[i][c];
                const double off = mapped.mean.pixels[i][c] - right;
                const double error = std::hypot(mapped.standard_error.pixels[i][c],
                                                truth.standard_error.pixels[i][c]);
                CHECK(std::abs(off) < 5 * error + 0.05 * right);
            }
    };
    check_picture(IndirectLight::rays, DirectLight::sampled);
    check_picture(IndirectLight::map, DirectLight::analytic);
    check_picture(IndirectLight::photons, DirectLight::mis);
}

TEST_CASE("volume_photons: a scene that lists fog and has none is the scene without") {
    const auto picture = []<typename... F>(Media<F...>) {
        Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Glass>, Lights<>, Media<F...>>
            scene;
        add_cornell_walls(scene);
        scene.add(Sphere{.center{0, 0.5f, 0}, .radius = 0.5f}, scene.add(Glass{}));
        scene.add(Sphere{.center{0, 1.6f, 0}, .radius = 0.1f}, scene.add(Lambertian{}),
                  Rgb{9});
        const World world(std::move(scene));
        const PhotonMapper mapper(world, {.direct = DirectLight::mis,
                                          .indirect = IndirectLight::map,
                                          .caustics = {.photons = 1000},
                                          .general = {.photons = 1000}});
        CHECK_FALSE(mapper.passes().volume_map);
        return render(mapper, cornell_camera(),
                      {.width = 12, .height = 12, .samples = 4})
            .image.pixels;
    };
    CHECK(picture(Media<>{}) == picture(Media<Fog<Sphere>, Fog<Box>>{}));
}

TEST_CASE("volume_photons: maps are made if something lights the fog") {
    const auto world = foggy_box();
    const PhotonMappingSettings few{.caustics = {.photons = 500},
                                    .general = {.photons = 500}};
    const auto photons = [&](const auto& change) {
        PhotonMappingSettings settings = few;
        change(settings);
        const PhotonMapper mapper(world, settings);
        const auto& maps = mapper.maps();
        CHECK(survey(world, settings).volume_map.on ==
              !(maps.fog.empty() && maps.fog_caustics.empty()));
        return std::pair{!maps.fog_caustics.empty(), !maps.fog.empty()};
    };
    CHECK(photons([](auto&) {}) == std::pair{true, true});
    CHECK(photons([](auto& s) { s.caustics.photons = 0; }) == std::pair{false, true});
    CHECK(photons([](auto& s) { s.general.photons = 0; }) == std::pair{true, false});
    CHECK(photons([](auto& s) {
              s.indirect = IndirectLight::none;
              s.keep_general_map = true;
          }) == std::pair{true, false});
    CHECK(photons([](auto& s) { s.caustics.photons = s.general.photons = 0; }) ==
          std::pair{false, false});
    CHECK(survey(world, few).volume_map.why == "1 medium(s) scatter light");

    // No photon of the fog gets into a map of surfaces.
    const PhotonMapper mapper(world, {.indirect = IndirectLight::photons,
                                      .caustics = {.photons = 500},
                                      .general = {.photons = 500}});
    for (std::size_t i = 0; i < mapper.maps().general.records.size(); ++i)
        REQUIRE(mapper.maps().general.records[i].kind != PhotonKind::fog);
    REQUIRE(mapper.maps().general.records.size() > 0);
}

TEST_CASE("volume_photons: what is not carried is refused, with a remedy") {
    const auto world = foggy_box();
    const auto why = [&](const PhotonMappingSettings& settings) {
        return refusal([&] { (void)PhotonMapper(world, settings); });
    };
    CHECK(why({.indirect = IndirectLight::cache}) ==
          "the scene has fog, and irradiance that is gathered or cached leaves its "
          "light out; let indirect light come by rays, map or photons, or remove the "
          "fog.");
    CHECK(why({.indirect = IndirectLight::gather}) ==
          why({.indirect = IndirectLight::cache}));
    CHECK(why({.skip = {.rule = SkipRule::enough}}) ==
          "the scene has fog, and photons that say which rays to skip do not know how "
          "much it dims; skip no rays, or remove the fog.");
    CHECK(why({.skip = {.indirect_rays = true}}) ==
          why({.skip = {.rule = SkipRule::enough}}));
    CHECK(why({.fog_estimate = {.radius = -1}}) ==
          "fog_estimate.radius is -1; it must be at least 0 (0: chosen for each "
          "photon).");
    CHECK(why({.fog_estimate = {.nearest = 0}}).starts_with("fog_estimate.nearest is"));
    CHECK(
        why({.fog_estimate = {.nearest = 512}}).starts_with("fog_estimate.nearest is"));
    const Plan plan = survey(world, {.indirect = IndirectLight::cache});
    REQUIRE(plan.remarks.size() == 1);
    CHECK(plan.remarks[0] + "." == why({.indirect = IndirectLight::cache}));

    Scene<Shapes<Sphere>, Materials<SoapFilm>, Lights<PointLight>, Media<Fog<Sphere>>>
        bubble;
    bubble.add(Sphere{}, bubble.add(SoapFilm{}));
    bubble.add(PointLight{});
    bubble.add(Fog<Sphere>{});
    const World both(std::move(bubble));
    CHECK(refusal([&] {
              (void)trace_photons(both, MapType::general, {.photons = 10});
          }).starts_with("the scene has both fog and thin surfaces"));
}

TEST_CASE("volume_photons: the balls of a pass shrink") {
    const auto world = foggy_box();
    PhotonMappingSettings settings{.caustics = {.photons = 500},
                                   .general = {.photons = 500},
                                   .caustics_estimate = {.radius = 0.1f}};
    const RenderSettings small{.width = 2, .height = 2, .samples = 1};
    CHECK(refusal([&] {
              (void)photon_mapping_pass(world, cornell_camera(), settings, small, 1, 1);
          }).starts_with("fog_estimate.radius is 0"));
    settings = settings_for_passes(PhotonMapper(world, settings));
    CHECK(settings.fog_estimate.radius > 0.02f);
    CHECK(settings.fog_estimate.radius < 0.5f);
    const auto first =
        photon_mapping_pass(world, cornell_camera(), settings, small, 1, 0.5);
    // It is the picture of a map with half the radius.
    settings.fog_estimate.radius /= 2;
    settings.caustics_estimate.radius /= 2;
    settings.general_estimate.radius /= 2;
    CHECK(photon_mapping_pass(world, cornell_camera(), settings, small, 1, 1)
              .image.pixels == first.image.pixels);
}
