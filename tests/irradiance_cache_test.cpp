// long: pictures of four rooms, by two renderers
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "ljus/math/stratified_stream.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "support/mean.hpp"
#include "support/rooms.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

/// A cache of given records.
IrradianceCache cache_of(const std::vector<Vec3>& places,
                         const std::vector<GatheredT<float>>& records) {
    IrradianceCache cache;
    cache.tree = KdTree8(places);
    for (const std::uint32_t i : cache.tree.point_ids())
        cache.records.push_back(records[i]);
    return cache;
}

constexpr Vec3 up{0, 0, 1};

PhotonMappingSettings cached(std::uint64_t seed) {
    PhotonMappingSettings settings = preset_settings(Preset::fast, 100, 100);
    settings.general.seed = settings.caustics.seed = seed;
    settings.general.threads = settings.caustics.threads = 1;
    return settings;
}

} // namespace

TEST_CASE("irradiance cache: the mean by distance, within the reach of each point") {
    // Three points on a line; the nearest says how far is around.
    const GatheredT<float> a{Rgb{1}, up, 10, 1}, b{Rgb{2}, up, 10, 1},
        far{Rgb{100}, up, 0.2f, 1};
    const auto cache = cache_of({{0, 0, 0}, {1, 0, 0}, {0.5f, 0.5f, 0}}, {a, b, far});
    const auto at = [&](float x, float reach = 1) {
        const auto found = interpolate(cache, Vec3{x, 0, 0}, up, reach);
        REQUIRE(found);
        return double(found->x);
    };
    CHECK(at(0) == 1);                       // b lies at the border: 0
    CHECK(at(0.5f) == doctest::Approx(1.5)); // the third does not reach
    CHECK(at(0.25f) == doctest::Approx((0.9375 + 2 * 0.4375) / 1.375));
    CHECK(at(0.5f, 10) > 30);                                       // now it does
    CHECK(!interpolate(cache, Vec3{0, 0, 5}, up, 1.0f));            // too far from all
    CHECK(!interpolate(cache, Vec3{0, 0, 0}, Vec3{1, 0, 0}, 1.0f)); // unlike normals
    CHECK(!interpolate(cache, Vec3{0, 0, 0}, -up, 1.0f));
    CHECK(!interpolate(IrradianceCache{}, Vec3{0}, up, 1.0f));
    // All points in one place say nothing of how far they count.
    const GatheredT<float> same{Rgb{1}, up, 10, 0};
    CHECK(!interpolate(cache_of({Vec3{0}, Vec3{0}}, {same, same}), Vec3{0}, up, 1.0f));
    CHECK(!interpolate(cache, Vec3{std::nanf("")}, up, 1.0f));
}

TEST_CASE("irradiance cache: it equals path tracing, block by block") {
    // Balls of each kind under a lamp. Blocks of 10 x 10 pixels, 6 seeds against 6 of the
    // path tracer; what is allowed beside 4 standard errors is the bias of radius and
    // interpolation: 4 % of a block and 1 % of the picture.
    constexpr int size = 60, blocks = 36, seeds = 6;
    const Camera camera = room_camera<float>();
    for (const Ball ball :
         {Ball::lambertian, Ball::oren_nayar, Ball::mirror, Ball::glass}) {
        const Room room = make_room<float>(ball, Lamp::quad, 1);
        std::vector<Mean> mapped(blocks), traced(blocks);
        Mean all_mapped, all_traced;
        const auto add = [&](const Image& image, std::vector<Mean>& means, Mean& all) {
            std::vector<double> sum(blocks);
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    const Rgb p = pixel(image, x, y);
                    sum[std::size_t(y / 10 * 6 + x / 10)] +=
                        double(p.x + p.y + p.z) / 300;
                }
            double total = 0;
            for (std::size_t i = 0; i < blocks; ++i) means[i].add(sum[i]);
            for (const double s : sum) total += s / blocks;
            all.add(total);
        };
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const RenderSettings picture{.width = size,
                                         .height = size,
                                         .samples = 9,
                                         .seed = seed,
                                         .threads = 1};
            const auto settings = cached(seed);
            auto maps = make_photon_maps(room, settings);
            add_irradiance_cache(maps, room, camera, picture, settings);
            CHECK(maps.cache.records.size() > 100);
            const auto mapper =
                make_photon_mapper<StratifiedStream>(room, maps, settings);
            add(render(mapper, camera, picture).image, mapped, all_mapped);
            RenderSettings more = picture;
            more.samples = 25;
            add(render(make_path_tracer(room), camera, more).image, traced, all_traced);
        }
        CAPTURE(int(ball));
        CHECK(std::abs(all_mapped.mean / all_traced.mean - 1) < 0.01);
        for (std::size_t i = 0; i < blocks; ++i) {
            CAPTURE(i);
            const double error = std::hypot(mapped[i].error(), traced[i].error());
            CHECK(std::abs(mapped[i].mean - traced[i].mean) <
                  4 * error + 0.04 * traced[i].mean);
        }
    }
}

TEST_CASE("irradiance cache: surfaces seen from inside, and turned inside out") {
    // A room within a sphere that is lit from its middle: its shape's normals point
    // outwards, those of the surface inwards. Everywhere the same light comes.
    using S = Scene<Shapes<Sphere>, Materials<Lambertian>>;
    S scene;
    const auto wall = scene.add(Lambertian{.albedo = Rgb{0.5f}});
    scene.add(Sphere{}, wall);
    scene.add(PointLight{.intensity = Rgb{1}});
    const Camera camera = look_at(View{.position{0.3f, 0, 0}, .target{1, 0.1f, 0}});
    const RenderSettings picture{.width = 30, .height = 30, .samples = 4, .threads = 1};
    auto settings = cached(1);
    auto maps = make_photon_maps(scene, settings);
    add_irradiance_cache(maps, scene, camera, picture, settings);
    const auto mapper = make_photon_mapper(scene, maps, settings);
    const auto image = render(mapper, camera, picture).image;
    Mean mean;
    for (const Rgb& p : image.pixels) mean.add(double(p.x));
    // E = 1 straight from the light; radiance 0.5/pi of it, over 1 - 0.5.
    CHECK(mean.mean == doctest::Approx(1 / 3.14159265).epsilon(0.015));
}

TEST_CASE("irradiance cache: the same bytes for any number of threads") {
    const Room room = make_room<float>(Ball::glass, Lamp::sphere, 2);
    const Camera camera = room_camera<float>();
    std::vector<Image> images;
    for (const int threads : {1, 3}) {
        auto settings = cached(5);
        settings.general.threads = settings.caustics.threads = threads;
        const RenderSettings picture{
            .width = 31, .height = 17, .samples = 2, .threads = threads};
        auto maps = make_photon_maps(room, settings);
        add_irradiance_cache(maps, room, camera, picture, settings);
        images.push_back(
            render(make_photon_mapper<StratifiedStream>(room, maps, settings), camera,
                   picture)
                .image);
    }
    CHECK(images[0].pixels == images[1].pixels);
}

TEST_CASE("irradiance cache: no photons, no light, no points") {
    // Without photons there is direct light only, and no NaN.
    const Room room = make_room<float>(Ball::lambertian, Lamp::quad, 1);
    const Camera camera = room_camera<float>();
    const RenderSettings picture{.width = 20, .height = 20, .samples = 2, .threads = 1};
    const auto image = [&](auto change) {
        auto settings = cached(1);
        change(settings);
        auto maps = make_photon_maps(room, settings);
        add_irradiance_cache(maps, room, camera, picture, settings);
        return render(make_photon_mapper(room, maps, settings), camera, picture);
    };
    const auto none = image([](auto& s) { s.general.photons = 0; });
    const auto direct = image([](auto& s) { s.indirect = IndirectLight::none; });
    CHECK(none.counts.rejected == 0);
    for (std::size_t i = 0; i < none.image.pixels.size(); ++i)
        CHECK(none.image.pixels[i].x ==
              doctest::Approx(direct.image.pixels[i].x).epsilon(1e-5));
    // One photon, and a tile larger than the picture.
    const auto one = image([](auto& s) {
        s.general.photons = 1;
        s.gather.tile = 100;
    });
    CHECK(one.counts.rejected == 0);
    for (const Rgb& p : one.image.pixels) CHECK(is_finite(p));
}
