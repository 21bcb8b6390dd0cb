#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <type_traits>
#include <utility>

#include "ljus/path/light_transport.hpp"
#include "ljus/radiosity/light_map.hpp"
#include "ljus/render/distributed.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/plain_path_tracing.hpp"
#include "ljus/render/plain_photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/render/whitted.hpp"
#include "support/refusal.hpp"
#include "support/rooms.hpp"
#include "support/within.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

/// A renderer that answers where its rays went.
struct Probe {
    using Stream = RandomStream;
    bool bad = false; ///< Every fourth path is not a number.
};
template <std::floating_point T, typename Context>
RgbT<T> radiance(const Probe& probe, const RayT<T>& ray, Context& context) {
    if (probe.bad && next_1d<T>(context.stream) < T(0.25))
        return RgbT<T>{std::numeric_limits<T>::quiet_NaN()};
    return {ray.direction.x / -ray.direction.z, ray.direction.y / -ray.direction.z,
            T(1)};
}

/// A renderer that answers with the numbers it was given.
struct Echo {
    using Stream = RandomStream;
};
template <std::floating_point T, typename Context>
RgbT<T> radiance(const Echo&, const RayT<T>&, Context& context) {
    return next_3d<T>(context.stream);
}

/// A renderer that answers with its numbers, at once or later; every eighth answer is
/// not a number, and some samples have two answers or none.
struct Late {
    using Stream = RandomStream;
    /// The answers that come later.
    struct Batch {
        std::uint32_t item = 0;
        std::vector<std::pair<std::uint32_t, Rgb>> answers{};
        template <typename Give>
        void finish(const Late&, Counts& counts, const Give& give) {
            counts.map_queries += answers.size();
            for (const auto& [to, light] : answers) give(to, light);
            answers.clear();
        }
    };
};
template <typename Context>
Rgb radiance(const Late&, const Ray&, Context& context) {
    Rgb sum{0};
    for (int i = static_cast<int>(3 * next_1d(context.stream)); i > 0; --i) {
        Rgb light = next_3d(context.stream);
        if (light.x < 0.125f) light.x = std::numeric_limits<float>::quiet_NaN();
        if constexpr (requires { context.batch.answers; }) {
            context.batch.answers.push_back({context.batch.item, light});
        } else {
            ++context.counts.map_queries;
            sum += light;
        }
    }
    return sum;
}

/// A caustics map that was made by hand, and nothing else.
struct HandMade {
    using Stream = RandomStream;
    using Batch = detail::CausticsBatch<float>;
    const ClosedRoom* room = nullptr;
    PhotonMapsT<float> known{};
    PhotonMappingSettings how{};

    const PhotonMapsT<float>& maps() const { return known; }
    const PhotonMappingSettings& settings() const { return how; }
};
template <typename Context>
Rgb radiance(const HandMade& mapper, const Ray& ray, Context& context) {
    const auto hit = closest_hit(*mapper.room, ray);
    if (!hit) return Rgb{0};
    const Vertex vertex = vertex_at(*mapper.room, ray, *hit);
    return visit_material_at(*mapper.room, vertex, [&](const auto& material) {
        if (detail::put_off(context.batch, vertex, material, Rgb{1},
                            mapper.how.caustics_estimate))
            return Rgb{0};
        ++context.counts.map_queries;
        return estimate_radiance(mapper.known.caustics, vertex, material, vertex.wo,
                                 mapper.how.caustics_estimate, light_kinds,
                                 context.counts.map_photons);
    });
}

/// The picture of a renderer whose every question is answered at once.
template <typename R>
RenderedT<float> plain_picture(const R& renderer, const Camera& camera,
                               const RenderSettings& picture) {
    RenderedT<float> plain{.image = make_image(picture.width, picture.height)};
    const PictureRays rays(picture);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            RgbT<double> sum{0};
            for (int i = 0; i < picture.samples; ++i) {
                const auto found =
                    trace_pixel(renderer, camera, rays, {x, y, i}, plain.counts);
                const Rgb sample = found.weight * found.radiance;
                if (is_finite(sample))
                    sum += RgbT<double>(sample);
                else
                    ++plain.counts.rejected;
            }
            pixel(plain.image, x, y) = Rgb(sum / double(picture.samples));
        }
    return plain;
}

} // namespace

TEST_CASE("render: answers that come later go to their own samples") {
    for (const int samples : {1, 3, 4, 63, 64, 65, 200})
        for (const auto& [width, filter] :
             {std::pair{1, Filter::box}, {16, Filter::mitchell}, {21, Filter::box}}) {
            const RenderSettings picture{.width = width,
                                         .height = 3,
                                         .samples = samples,
                                         .seed = 12,
                                         .threads = 1,
                                         .filter = filter};
            const auto late = render(Late{}, Camera{}, picture);
            const auto plain = plain_picture(Late{}, Camera{}, picture);
            REQUIRE(late.image.pixels == plain.image.pixels);
            REQUIRE(late.counts.rejected == plain.counts.rejected);
            REQUIRE(late.counts.map_queries == plain.counts.map_queries);
        }
}

// The terms of a path are the same, but those of caustics are added last: each of some
// dozen sums rounds by half a unit in the last place.
TEST_CASE("render: caustics that are asked for together are those asked one by one") {
    const Camera camera = room_camera<float>();
    for (const Ball ball : {Ball::glass, Ball::oren_nayar, Ball::mixture})
        for (const std::size_t nearest : {0u, 20u}) {
            const ClosedRoom room = make_room<float>(ball, Lamp::quad, 1);
            PhotonMappingSettings settings;
            settings.caustics.photons = 20000;
            settings.caustics_estimate = {.radius = 0.1f, .nearest = nearest};
            const PhotonMapper mapper(room, settings);
            for (const int samples : {1, 5, 70}) {
                const RenderSettings picture{
                    .width = 21, .height = 16, .samples = samples, .threads = 2};
                const auto together = render(mapper, camera, picture);
                const auto plain = plain_picture(mapper, camera, picture);
                for (std::size_t i = 0; i < plain.image.pixels.size(); ++i)
                    for (int c = 0; c < 3; ++c)
                        REQUIRE(
                            together.image.pixels[i][c] ==
                            doctest::Approx(plain.image.pixels[i][c]).epsilon(1e-5));
                CHECK(together.counts.rays() == plain.counts.rays());
                CHECK(together.counts.map_queries == plain.counts.map_queries);
                CHECK(together.counts.map_photons == plain.counts.map_photons);
                CHECK(together.counts.rejected == plain.counts.rejected);
                if (ball == Ball::glass) CHECK(plain.counts.map_photons > 0);
            }
        }
}

TEST_CASE("render: no ray of a picture has the numbers of another one") {
    // Of 24 bits each: that two of 3200 triples agree by chance
    // is as good as impossible.
    std::set<std::array<double, 3>> seen;
    for (const std::uint64_t seed : {1u, 2u}) {
        const RenderSettings picture{.width = seed == 1 ? 25 : 16,
                                     .height = seed == 1 ? 16 : 25,
                                     .samples = 4,
                                     .seed = seed};
        const PictureRays rays(picture);
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x)
                for (int i = 0; i < 4; ++i) {
                    Counts counts;
                    const auto numbers =
                        trace_pixel(Echo{}, CameraT<double>{}, rays, {x, y, i}, counts)
                            .radiance;
                    seen.insert({numbers.x, numbers.y, numbers.z});
                    CHECK(counts.camera_rays == 1);
                }
    }
    CHECK(seen.size() == 3200);
}

TEST_CASE("render: as many rays are traced as were asked for, from 1 to 1000") {
    const Camera camera;
    for (int rays = 1; rays <= 1000; ++rays) {
        const auto seen = render(
            Probe{}, camera, {.width = 2, .height = 1, .samples = rays, .threads = 1});
        CHECK(seen.counts.camera_rays == 2 * static_cast<std::uint64_t>(rays));
        CHECK(seen.counts.rejected == 0);
    }
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    for (const int rays : {1, 2, 7, 8, 10, 64, 101}) {
        const auto seen =
            render(PathTracer(room), camera,
                   {.width = 5, .height = 3, .samples = rays, .threads = 1});
        CHECK(seen.counts.camera_rays == 15 * static_cast<std::uint64_t>(rays));
    }
}

TEST_CASE("render: the rays of a pixel are spread as the picture says") {
    // How far the mean of 61 rays is from the middle of its pixel, over 400 pixels.
    const auto error = [](Sampling sampling) {
        const auto seen = render(Probe{}, look_at({.vfov_degrees = 90}),
                                 {.width = 20,
                                  .height = 20,
                                  .samples = 61,
                                  .threads = 1,
                                  .sampling = sampling});
        double sum = 0;
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 20; ++x) {
                const Rgb mean = pixel(seen.image, x, y);
                sum += std::hypot(double(mean.x) * 10 - (x - 9.5),
                                  double(mean.y) * 10 - (9.5 - y));
            }
        return sum / 400;
    };
    const double chance = error(Sampling::random);
    CHECK(chance == ljus_test::within(std::sqrt(std::atan(1) * 2 / 12 / 61), 0.1));
    // Rooks stand evenly along both sides, which is all that this mean asks for.
    CHECK(error(Sampling::jittered) < 0.05 * chance);
    CHECK(error(Sampling::multi_jittered) < 0.15 * chance);
    CHECK(error(Sampling::sobol) < 0.25 * chance);
    CHECK(error(RenderSettings{}.sampling) == error(Sampling::multi_jittered));
}

TEST_CASE("render: each pixel is the mean over its own square, from the upper left") {
    const int width = 20, height = 10; // wider than one strip of 16 pixels
    const Camera camera = look_at({.vfov_degrees = 90}); // half a height is 1
    for (const int rays : {1, 9, 13, 400}) {
        CAPTURE(rays);
        const auto seen = render(Probe{}, camera,
                                 {.width = width,
                                  .height = height,
                                  .samples = rays,
                                  .seed = 3,
                                  .threads = 1});
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const Rgb mean = pixel(seen.image, x, y);
                const double side = 2.0 / height;
                const double dx = double(mean.x) - (x + 0.5 - width / 2.0) * side;
                const double dy = double(mean.y) - (height / 2.0 - y - 0.5) * side;
                // Within the pixel; and the more rays the nearer to its middle:
                // stratified means of n rays lie within 1/(2 sqrt(n)) of it at the
                // very worst.
                const double bound =
                    rays == 1 ? 0.5 : 0.5 / std::floor(std::sqrt(rays / 4.0) + 0.5);
                CHECK(std::abs(dx) <= bound * side + 1e-6);
                CHECK(std::abs(dy) <= bound * side + 1e-6);
                CHECK(mean.z == doctest::Approx(1));
            }
    }
}

TEST_CASE("render: pictures of one pixel, one row and one column, through any angle") {
    for (const float angle : {1e-3f, 45.0f, 179.99f})
        for (const auto& [width, height] : {std::pair{1, 1}, {1, 300}, {300, 1}}) {
            const Camera camera = look_at({.vfov_degrees = angle});
            const auto seen =
                render(Probe{}, camera,
                       {.width = width, .height = height, .samples = 5, .threads = 1});
            CHECK(seen.counts.camera_rays ==
                  5 * static_cast<std::uint64_t>(width) * std::uint64_t(height));
            CHECK(seen.counts.rejected == 0);
            // What the borders should be, in units of half the height.
            const double side = 2.0 / height, h = double(camera.half_height);
            const double x = double(pixel(seen.image, width - 1, 0).x) / h;
            const double y = double(pixel(seen.image, 0, height - 1).y) / h;
            CAPTURE(angle);
            CHECK(std::abs(x / side - (width / 2.0 - 0.5)) < 0.51);
            CHECK(std::abs(y / side + (height / 2.0 - 0.5)) < 0.51);
        }
}

TEST_CASE("render: a sample that is not finite is left out and counted, never shown") {
    const auto seen = render(Probe{.bad = true}, Camera{},
                             {.width = 20, .height = 20, .samples = 16, .threads = 1});
    // 6400 paths, a quarter bad: 1600 with a standard deviation of 35.
    CHECK(seen.counts.rejected > 1600 - 5 * 35);
    CHECK(seen.counts.rejected < 1600 + 5 * 35);
    for (const Rgb& color : seen.image.pixels) CHECK(is_finite(color));
}

TEST_CASE("render: refuses a picture without pixels or rays") {
    const auto said = [](const RenderSettings& picture) {
        return refusal([&] { (void)render(Probe{}, Camera{}, picture); });
    };
    for (const auto& [width, height] : {std::pair{0, 4}, {4, 0}, {-3, 4}})
        CHECK(said({.width = width, .height = height})
                  .find("The image's size is " + std::to_string(width) + " x " +
                        std::to_string(height) + "; ") == 0);
    CHECK(said({.width = 4, .height = 4, .samples = 0}) ==
          "samples is 0; it must be at least 1.");
    CHECK(said({.width = 4, .height = 4, .samples = -1}) ==
          "samples is -1; it must be at least 1.");
    CHECK(said({.threads = -1}) ==
          "the number of threads is -1; it must be within [0, 1024].");
    CHECK(said({.width = 1, .height = 1, .samples = 1}).empty());
    const RenderSettings silent;
    CHECK(silent.width == 400);
    CHECK(silent.height == 400);
    CHECK(silent.samples == 64);
    CHECK(silent.seed == 1);
    CHECK(silent.threads == 0);
    CHECK(silent.sampling == Sampling::multi_jittered);
    CHECK(silent.filter == Filter::box);
    CHECK(RenderedT<float>{}.complete);
}

TEST_CASE("render: progress is told, and can stop it") {
    long long last = 0, total = 0;
    const auto watch = [&](long long done, long long all) {
        last = done;
        total = all;
        return true;
    };
    const auto seen = render(
        Probe{}, Camera{},
        {.width = 33, .height = 7, .samples = 1, .threads = 2, .progress = watch});
    CHECK(seen.complete);
    CHECK(last == total);
    CHECK(total == 3 * 7); // strips of 16 pixels
    const auto stop = [&](long long, long long) { return false; };
    const auto stopped = render(
        Probe{}, Camera{},
        {.width = 64, .height = 64, .samples = 1, .threads = 1, .progress = stop});
    CHECK_FALSE(stopped.complete);
    CHECK(stopped.counts.camera_rays < 64 * 64);
}

TEST_CASE("render: a strip for every 16 pixels of a row, the last one part of one") {
    for (const int width : {1, 15, 16, 17, 32, 33}) {
        long long all = 0;
        const auto watch = [&](long long, long long total) {
            return all = total, true;
        };
        (void)render(Echo{}, Camera{},
                     {.width = width,
                      .height = 3,
                      .samples = 1,
                      .threads = 1,
                      .progress = watch});
        CHECK(all == 3 * std::ceil(width / 16.0));
    }
}

TEST_CASE("render: neighbours do not look through the same places of their squares") {
    for (const Sampling sampling : {Sampling::sobol, Sampling::multi_jittered}) {
        const RenderSettings picture{
            .width = 8, .height = 8, .samples = 16, .sampling = sampling};
        const PictureRays rays(picture);
        std::set<int> cells; // of 16 x 16, into which the first ray of each pixel goes
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                RandomStream stream;
                const auto at = sample_pixel<double>(rays, {x, y, 0}, stream);
                const Vec2T<double> rest = at.place - Vec2T<double>(x, y);
                cells.insert(int(16 * rest.x));
            }
        CHECK(cells.size() > 8); // one, if all had one pattern
        std::set<int> by_seed;   // the same of one pixel in 64 pictures
        for (std::uint64_t seed = 1; seed <= 64; ++seed) {
            RandomStream stream;
            RenderSettings other = picture;
            other.seed = seed;
            const auto at = sample_pixel<double>(PictureRays(other), {0, 0, 0}, stream);
            by_seed.insert(int(16 * at.place.x));
        }
        CHECK(by_seed.size() > 8);
    }
}

TEST_CASE("render: a ray goes as far from its pixel as the filter reaches") {
    for (const Filter filter :
         {Filter::box, Filter::tent, Filter::gaussian, Filter::mitchell}) {
        CAPTURE(int(filter));
        const RenderSettings picture{
            .width = 9, .height = 6, .samples = 256, .seed = 3, .filter = filter};
        const PictureRays rays(picture);
        double farthest = 0, sum = 0;
        bool negative = false;
        for (int i = 0; i < 256; ++i) {
            RandomStream stream;
            const auto at = sample_pixel<double>(rays, {7, 4, i}, stream);
            farthest = std::max(
                {farthest, std::abs(at.place.x - 7.5), std::abs(at.place.y - 4.5)});
            sum += at.weight;
            negative = negative || at.weight < 0;
            // Its stream is past the two numbers of the place, and no others.
            RandomStream twin;
            start_ray(twin, 3, 4 * 9 + 7, i, rays.pattern);
            (void)next_2d<double>(twin);
            CHECK(next_1d<double>(stream) == next_1d<double>(twin));
        }
        CHECK(farthest <= filter_radius(filter));
        CHECK(farthest > 0.8 * filter_radius(filter));
        CHECK(sum / 256 == ljus_test::within(1, 0.15)); // 4 standard errors, or fewer
        CHECK(negative == (filter == Filter::mitchell));
    }
}

TEST_CASE("render: sums of samples and of their squares, each by its weight") {
    // Numbers of few bits, so that all is exact; 1e20 has no square in float.
    const auto check = [](const auto& renderer, int repetitions) {
        std::array<detail::PixelSums, 3> sums{};
        Counts cost;
        detail::SampleSums<std::remove_cvref_t<decltype(renderer)>, float> samples(
            renderer, sums, cost);
        const auto add = [&](std::size_t pixel, const Rgb& light, float weight) {
            samples.add(pixel, [&](auto&) {
                return PixelSampleT<float>{light, weight};
            });
        };
        for (int i = 0; i < repetitions; ++i) {
            add(2, Rgb{3, 5, 7}, 0.5f);
            add(0, Rgb{8, 4, 2}, -0.25f);
            add(2, Rgb{1, 2, 4}, 2);
            add(1, Rgb{1, std::numeric_limits<float>::infinity(), 1}, 1);
            add(0, Rgb{std::numeric_limits<float>::quiet_NaN(), 1, 1}, 0);
        }
        add(1, Rgb{1e20f, 0, 1}, 1);
        samples.finish();
        samples.finish(); // nothing is added twice
        const double n = repetitions, huge = double(1e20f);
        CHECK(sums[0].sum == n * RgbT<double>{-2, -1, -0.5});
        CHECK(sums[0].squares == n * RgbT<double>{4, 1, 0.25});
        CHECK(sums[1].sum == RgbT<double>{huge, 0, 1});
        CHECK(sums[1].squares == RgbT<double>{huge * huge, 0, 1});
        CHECK(sums[2].sum == n * RgbT<double>{3.5, 6.5, 11.5});
        CHECK(sums[2].squares == n * RgbT<double>{6.25, 22.25, 76.25});
        CHECK(cost.rejected == 2 * static_cast<std::uint64_t>(repetitions));
    };
    for (const int repetitions : {1, 12, 13, 50}) { // 64 of Late's wait at most
        check(Probe{}, repetitions);
        check(Late{}, repetitions);
    }
}

TEST_CASE("render: of a caustics map only light is seen, asked together or not") {
    // A map may be made by hand, and may have shadow photons in it: they are no light.
    BallRoom room;
    room.add(Quad{{-9, -9, -3}, {18, 0, 0}, {0, 18, 0}},
             room.add(Lambertian{.albedo = Rgb{0.5f}}));
    room.add(PointLight{.position{0, 0, 9}, .intensity = Rgb{1}});
    const World world(std::move(room));
    PhotonMappingSettings settings{.max_depth = 1};
    settings.caustics_estimate.radius = 1;
    const auto picture_of = [&](bool shadows) {
        std::vector<Photon> photons;
        for (int i = 0; i < 400; ++i) {
            const bool shadow = i % 2 == 1;
            if (!shadow || shadows)
                photons.push_back(
                    {.position{0.2f * float(i % 20) - 2, 0.2f * float(i / 20) - 2, -3},
                     .direction{0, 0, -1},
                     .flux{1, 2, 3},
                     .kind = shadow ? PhotonKind::shadow : PhotonKind::caustic,
                     .normal = small_normal(Vec3{0, 0, 1})});
        }
        HandMade mapper{.room = &world, .how = settings};
        mapper.known.caustics = make_photon_map(photons);
        const RenderSettings picture{
            .width = 9, .height = 9, .samples = 2, .threads = 1};
        const auto together = render(mapper, Camera{}, picture);
        const auto plain = plain_picture(mapper, Camera{}, picture);
        CHECK(together.counts.map_photons == plain.counts.map_photons);
        for (std::size_t i = 0; i < plain.image.pixels.size(); ++i)
            CHECK(together.image.pixels[i].y ==
                  doctest::Approx(plain.image.pixels[i].y).epsilon(1e-5));
        return together;
    };
    const auto light = picture_of(false), both = picture_of(true);
    CHECK(light.counts.map_photons > 0);
    CHECK(light.counts.map_photons == both.counts.map_photons);
    for (std::size_t i = 0; i < light.image.pixels.size(); ++i)
        CHECK(both.image.pixels[i].y ==
              doctest::Approx(light.image.pixels[i].y).epsilon(1e-5));
}

TEST_CASE("render: one pixel's ray is the same alone as in the picture") {
    const ClosedRoom room = make_room<float>(Ball::mixture, Lamp::quad, 1);
    const PathTracer tracer(room);
    const Camera camera = room_camera<float>();
    const RenderSettings picture{
        .width = 24, .height = 9, .samples = 5, .seed = 8, .threads = 1};
    const auto seen = render(tracer, camera, picture);
    const PictureRays rays(picture);
    for (const auto& [x, y] : {std::pair{0, 0}, std::pair{17, 4}, std::pair{23, 8}}) {
        RgbT<double> sum{0}; // as the pixel loop adds
        Counts counts;
        PathLog log;
        for (int i = 0; i < picture.samples; ++i) {
            const auto found =
                trace_pixel(tracer, camera, rays, {x, y, i}, counts, log);
            sum += RgbT<double>(found.weight * found.radiance);
        }
        CHECK(Rgb(sum / double(picture.samples)) == pixel(seen.image, x, y));
        CHECK(counts.camera_rays == 5);
        CHECK_FALSE(log.lines.empty());
    }
}

TEST_CASE("render: a region is that part of the whole, byte by byte") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    const PathTracer tracer(room);
    const auto camera = room_camera<float>();
    const RenderSettings picture{
        .width = 37, .height = 9, .samples = 3, .seed = 4, .threads = 2};
    const auto whole = render(tracer, camera, picture);
    // A missing pixel would be black; few of these are.
    const auto black = [](const Rgb& c) { return is_black(c); };
    REQUIRE(std::count_if(whole.image.pixels.begin(), whole.image.pixels.end(), black) <
            20);
    for (const PixelRegion& region :
         {PixelRegion{0, 0, 37, 9}, PixelRegion{0, 0, 1, 1}, PixelRegion{36, 8, 1, 1},
          PixelRegion{15, 2, 2, 3}, PixelRegion{3, 4, 30, 5}}) {
        const auto part = render_region(tracer, camera, picture, region);
        REQUIRE(part.image.width == region.width);
        REQUIRE(part.image.height == region.height);
        for (int y = 0; y < region.height; ++y)
            for (int x = 0; x < region.width; ++x)
                CHECK(pixel(part.image, x, y) ==
                      pixel(whole.image, region.x + x, region.y + y));
    }
    // A few strips, not the whole.
    CHECK(render_region(tracer, camera, picture, {15, 2, 2, 3}).counts.camera_rays ==
          3 * 32 * 3);
    for (const PixelRegion& wrong :
         {PixelRegion{-1, 0, 2, 1}, PixelRegion{36, 0, 2, 1}, PixelRegion{0, 0, 0, 1},
          PixelRegion{37, 0, 1, 1}, PixelRegion{0, 0, 2147483647, 1}})
        CHECK_THROWS_WITH_AS((void)render_region(tracer, camera, picture, wrong),
                             ("the region's width is " + std::to_string(wrong.width) +
                              "; it must be at least 1, and the region within the "
                              "picture.")
                                 .c_str(),
                             std::invalid_argument);
    CHECK_THROWS_AS((void)render_region(tracer, camera, picture, {0, 5, 1, 5}),
                    std::invalid_argument);
}

TEST_CASE("render: rows that are rendered apart are the whole, byte by byte") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    const PathTracer tracer(room);
    const RenderSettings picture{
        .width = 21, .height = 13, .samples = 3, .seed = 4, .threads = 2};
    const auto whole = render(tracer, Camera{}, picture);
    for (const int parts : {1, 2, 3, 13}) {
        Counts counts;
        for (int i = 0; i < parts; ++i) {
            const int first = 13 * i / parts, last = 13 * (i + 1) / parts;
            const auto part =
                render_region(tracer, Camera{}, picture, {0, first, 21, last - first});
            REQUIRE(part.image.width == 21);
            REQUIRE(part.image.height == last - first);
            for (int y = first; y < last; ++y)
                for (int x = 0; x < 21; ++x)
                    CHECK(pixel(part.image, x, y - first) == pixel(whole.image, x, y));
            counts += part.counts;
        }
        CHECK(counts.rays() == whole.counts.rays());
    }
}

namespace {

/// Whether R can be made of a named X, and not of one that is gone at once.
template <typename R, typename X, typename... More>
constexpr bool refers_to = std::is_constructible_v<R, const X&, More...>&&
                               std::is_constructible_v<R, X&, More...> &&
                           !std::is_constructible_v<R, X, More...> &&
                           !std::is_constructible_v<R, const X, More...>;

using W = ClosedRoom;
static_assert(refers_to<PathTracer<W>, W>);
static_assert(refers_to<PathTracer<W>, W, PathTracingSettings>);
static_assert(refers_to<PlainPathTracer<W>, W>);
static_assert(refers_to<PlainPathTracer<W>, W, int>);
static_assert(refers_to<WhittedTracer<W>, W>);
static_assert(refers_to<WhittedTracer<W>, W, WhittedSettings>);
static_assert(refers_to<DistributedTracer<W>, W>);
static_assert(refers_to<DistributedTracer<W>, W, DistributedSettings>);
static_assert(refers_to<PhotonMapper<W>, W>);
static_assert(refers_to<PhotonMapper<W>, W, PhotonMappingSettings>);
static_assert(refers_to<PlainPhotonMapper<W>, W, PhotonMap>);
static_assert(refers_to<LightMapView<W>, W, LightMap>);
static_assert(refers_to<OnlyPaths<PathTracer<W>>, PathTracer<W>, const char*>);
static_assert(refers_to<PictureRays, RenderSettings>);

} // namespace

TEST_CASE("render: what a renderer refers to has a name, and is referred to") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    const PathTracer tracer(room);
    CHECK(&tracer.world() == &room);
    CHECK(&PlainPathTracer(room).world() == &room);
    CHECK(&WhittedTracer(room).world() == &room);
    CHECK(&DistributedTracer(room).world() == &room);
    CHECK(&PlainPhotonMapper(room, PhotonMap{}).world() == &room);
    CHECK(&OnlyPaths(tracer, "EDL").whole() == &tracer);
    const RenderSettings picture;
    CHECK(&PictureRays(picture).picture == &picture);
}
