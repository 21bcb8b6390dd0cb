// rest: whole pictures, of all concepts together
/// \file extremes_test.cpp
/// \brief Whole pictures at the extremes: no number is lost, and what a picture should
/// be it is. Its statistical case was run with 20 further seeds: none failed.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "experiments/extreme_room.hpp"
#include "ljus/inspect/metrics.hpp"
#include "ljus/inspect/survey.hpp"
#include "support/refusal.hpp"
#include "support/seed.hpp"

using namespace ljus;
using examples::Extreme;
using examples::ExtremePicture;
using examples::ExtremeSettings;
using examples::render_extreme;
using ljus_test::test_seed;

namespace {

/// Few rays: a picture of a tenth of a second.
constexpr ExtremeSettings few{.width = 24, .height = 24, .samples = 2, .photons = 3000};

template <typename T>
bool same_bytes(const ImageT<T>& a, const ImageT<T>& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(),
                       a.pixels.size() * sizeof(a.pixels[0])) == 0;
}

template <typename T>
bool all_finite(const ImageT<T>& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [](const auto& color) {
        return is_finite(color) && color.x >= 0 && color.y >= 0 && color.z >= 0;
    });
}

template <typename T>
double mean_of(const ImageT<T>& image) {
    double sum = 0;
    for (const auto& c : image.pixels) sum += double(c.x) + double(c.y) + double(c.z);
    return sum / 3 / double(image.pixels.size());
}

/// Without the worst pixels: with two rays those are a few caustics, and nothing else.
template <typename T>
double error_of(const ImageT<T>& image, const ImageT<double>& truth) {
    return trimmed_rel_mse(image, truth, 0.05);
}

/// Finite, without a sample that was left out.
template <typename T>
ExtremePicture<T> checked(const Extreme& how, const ExtremeSettings& settings = few) {
    auto picture = render_extreme<T>(how, settings);
    CHECK(picture.rendered.complete);
    CHECK(picture.rendered.counts.rejected == 0);
    CHECK(all_finite(picture.rendered.image));
    CHECK(mean_of(picture.rendered.image) > 0);
    return picture;
}

} // namespace

TEST_CASE_TEMPLATE("extremes: at every power of two the same bytes", T, float, double) {
    // What is multiplied by 2 loses no digit: a length that is hidden in the code, an
    // epsilon, would show.
    const auto plain = checked<T>({});
    for (const double scale : {std::exp2(-20.0), 0.25, 8.0, std::exp2(20.0)}) {
        CAPTURE(scale);
        CHECK(same_bytes(checked<T>({.scale = scale}).rendered.image,
                         plain.rendered.image));
    }
}

TEST_CASE_TEMPLATE("extremes: from a millionth to a million times the size", T, float,
                   double) {
    const auto plain = render_extreme<double>({}, few).rendered.image;
    ExtremeSettings other = few;
    other.seed = 2;
    const double noise =
        error_of(render_extreme<double>({}, other).rendered.image, plain);
    for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
        CAPTURE(scale);
        const auto picture = checked<T>({.scale = scale});
        CHECK(picture.remarks.empty());
        // A path that rounding sends elsewhere has another light, of the same noise.
        CHECK(error_of(picture.rendered.image, plain) < noise / 20);
    }
    // Where float ends, above the fourth root of its largest number, it says so.
    CHECK(checked<float>({.scale = 1e10}).remarks ==
          "coordinates reach 2e+11: above 1e9 the squares of areas leave the range of "
          "float; use double, or a larger unit of length\n");
    CHECK(checked<double>({.scale = 1e10}).remarks.empty());
}

TEST_CASE("extremes: far from the origin float says that it does not hold, and double "
          "does") {
    const auto plain = render_extreme<double>({}, few).rendered.image;
    ExtremeSettings other = few;
    other.seed = 2;
    const double noise =
        error_of(render_extreme<double>({}, other).rendered.image, plain);
    const auto at = [](double far) { return Extreme{.moved = {far, -far, far / 2}}; };
    CHECK(error_of(checked<float>(at(100)).rendered.image, plain) < noise / 4);
    CHECK(error_of(checked<double>(at(1e6)).rendered.image, plain) < noise / 20);
    CHECK(checked<float>(at(100)).remarks.empty());
    CHECK(checked<double>(at(1e6)).remarks.empty());

    const auto lost = checked<float>(at(1e6));
    CHECK(error_of(lost.rendered.image, plain) > noise / 4);
    CHECK(lost.remarks.find("float keeps ") != std::string::npos);
    CHECK(lost.remarks.find("use double, or move the scene towards the origin") !=
          std::string::npos);
    const Plan plan = survey(examples::extreme_room<float>(at(1e6)).world, {});
    for (const std::string& remark : plan.remarks)
        CHECK(lost.remarks.find(remark + "\n") != std::string::npos);
    const auto gone = survey(examples::extreme_room<float>(at(1e12)).world, {});
    REQUIRE(!gone.remarks.empty());
    CHECK(gone.remarks.front() ==
          "an object is so small or so far away that float keeps nothing of its size; "
          "use double, or move the scene towards the origin");
    // And double in its turn.
    CHECK(checked<double>(at(1e15)).remarks.find("double keeps ") != std::string::npos);
}

TEST_CASE_TEMPLATE("extremes: a camera in a surface, whatever else is in the scene", T,
                   float, double) {
    const auto remarks = [](const Vec3T<T>& camera, T scale, T lamp) {
        Scene<Shapes<SphereT<T>, QuadT<T>>, Materials<LambertianT<T>>> scene;
        const auto grey = scene.add(LambertianT<T>{});
        scene.add(QuadT<T>{.corner = scale * Vec3T<T>{-1, 0, 1},
                           .edge_u = scale * Vec3T<T>{2, 0, 0},
                           .edge_v = scale * Vec3T<T>{0, 0, -2}},
                  grey);
        if (lamp > 0) // far above, or all around
            for (const T height : {T(0), T(3) * lamp})
                scene.add(SphereT<T>{{T(0), height, T(0)}, lamp}, grey, RgbT<T>{T(1)});
        return camera_remarks(World(std::move(scene)), scale * camera);
    };
    for (const T scale : {T(1e-6), T(1), T(1e6)})
        for (const T lamp : {T(0), T(1e8)}) {
            CAPTURE(scale);
            CAPTURE(lamp);
            CHECK(remarks({T(0.25), T(0), T(0.5)}, scale, lamp) ==
                  std::vector<std::string>{
                      "camera.position lies in a surface, which its rays may meet at "
                      "once or not at all: move it to one side"});
            for (const T height : {T(1e-3), T(-1e-3), T(1)})
                CHECK(remarks({T(0.25), height, T(0.5)}, scale, lamp).empty());
            CHECK(remarks({T(3), T(0), T(0)}, scale, lamp).empty()); // beside it
        }
    // On a ball as large as the earth: 64 m are some digits of float's, or a few last ones.
    CHECK(remarks({T(0), T(1e8), T(0)}, 1, T(1e8)).size() == 1);
    CHECK(remarks({T(0), T(1e8) + T(1e3), T(0)}, 1, T(1e8)).empty());
    const Scene<Shapes<SphereT<T>>, Materials<LambertianT<T>>> nothing;
    CHECK(camera_remarks(World(nothing), Vec3T<T>{T(0)}).size() == 1);
}

TEST_CASE_TEMPLATE("extremes: lamps from a point to the ceiling", T, float, double) {
    const auto point = checked<T>({.lamp = 0});
    for (const double radius : {1e-6, 1e-4}) {
        CAPTURE(radius);
        const auto ball = checked<T>({.lamp = radius});
        // The same flux; the ball is too small to be seen.
        CHECK(mean_of(ball.rendered.image) ==
              doctest::Approx(mean_of(point.rendered.image)).epsilon(0.1));
    }
    checked<T>({.lamp = 0.9});
    checked<T>({.lamp = Extreme::ceiling});
    checked<T>({.scale = 1e-6, .lamp = 1e-3});
    // What lights a small room is near.
    const auto truth = render_extreme<double>({.lamp = 0}, few).rendered.image;
    CHECK(error_of(checked<T>({.scale = 1e-6, .lamp = 0}).rendered.image, truth) <
          1e-3);
    checked<T>({.scale = 1e6, .lamp = 0});
}

TEST_CASE_TEMPLATE("extremes: albedo 0 and 1, roughness 0 and most", T, float, double) {
    const auto dark = checked<T>({.albedo = 0}).rendered.image;
    const double plain = mean_of(checked<T>({}).rendered.image);
    const double white = mean_of(checked<T>({.albedo = 1}).rendered.image);
    CHECK(mean_of(dark) < plain);
    CHECK(std::count(dark.pixels.begin(), dark.pixels.end(), RgbT<T>(T(0))) >
          24 * 24 / 2); // what is left are the lamps, and what mirrors them
    CHECK(white > 1.3 * plain);
    // A matt surface of roughness 0 is Lambert's, a glossy mirror of roughness 0 a
    // mirror: the same paths, except for rounding.
    CHECK(mean_of(checked<T>({.matt = 0}).rendered.image) ==
          doctest::Approx(plain).epsilon(0.02));
    CHECK(mean_of(checked<T>({.gloss = 0}).rendered.image) ==
          doctest::Approx(plain).epsilon(0.02));
    checked<T>({.matt = 1});
    checked<T>({.gloss = 0.01});
    checked<T>({.gloss = 1});
}

TEST_CASE_TEMPLATE("extremes: glass of index 1 to 1000", T, float, double) {
    for (const double index : {1.0, 1.0 + 1e-6, 1.0001, 3.0, 1000.0}) {
        CAPTURE(index);
        checked<T>({.index = index});
    }
}

TEST_CASE_TEMPLATE("extremes: in a furnace everything that loses no light is invisible",
                   T, float, double) {
    // A black wall of radiance 1 all around: each pixel of a picture must be 1.
    using Furnace = Scene<Shapes<SphereT<T>>,
                          Materials<LambertianT<T>, GlassT<T>, MirrorT<T>, EonT<T>>>;
    for (const double scale : {1e-6, 1.0, 1e6})
        for (const double moved : {0.0, 1000.0})
            for (const double index : {0.0, 1.0, 1.0 + 1e-6, 1.5, 1000.0}) {
                CAPTURE(scale);
                CAPTURE(moved);
                CAPTURE(index);
                const T s = T(scale), away = T(moved * scale);
                const Vec3T<T> middle{away, -away, away};
                Furnace scene;
                scene.add(SphereT<T>{middle, T(10) * s},
                          scene.add(LambertianT<T>{.albedo = RgbT<T>(T(0))}),
                          RgbT<T>(T(1)), true);
                const SphereT<T> ball{middle, s};
                if (index > 0)
                    scene.add(ball, scene.add(GlassT<T>{.index = T(index)}));
                else
                    scene.add(ball,
                              scene.add(MirrorT<T>{.reflectance = RgbT<T>(T(1))}));
                const auto camera =
                    look_at(ViewT<T>{.position = middle + Vec3T<T>{0, 0, T(4) * s},
                                     .target = middle,
                                     .vfov_degrees = T(30)});
                const World world(std::move(scene));
                const PathTracer tracer(world);
                const auto picture =
                    render(tracer, camera, {.width = 16, .height = 16, .samples = 4});
                CHECK(picture.counts.rejected == 0);
                // A path that max_depth cuts has lost its light, and is counted.
                const double lost = double(picture.counts.cut_paths) / (16 * 16 * 4);
                CHECK(mean_of(picture.image) ==
                      doctest::Approx(1 - lost).epsilon(1e-5));
                CHECK(lost < 0.01);
            }
}

TEST_CASE_TEMPLATE("extremes: no photon, one, one fewer than are asked for, and more",
                   T, float, double) {
    ExtremeSettings settings = few;
    const auto with = [&](long long photons, std::size_t nearest) {
        settings.photons = photons;
        settings.nearest = nearest;
        settings.radius = 1;
        return checked<T>({}, settings);
    };
    CHECK(with(0, 0).photons == 0);
    CHECK(with(1, 0).photons <= 1);
    CHECK(with(1, 2).photons <= 1);
    const auto some = with(100, 0);
    REQUIRE(some.photons > 3);
    with(100, some.photons + 1); // k - 1 photons are there
    with(100, some.photons);
    with(100, some.photons - 1);
    CHECK(with(100'000, 50).photons > 10'000);
}

TEST_CASE_TEMPLATE("extremes: pictures of one pixel, of one row and of one column", T,
                   float, double) {
    for (const auto& size : {std::pair{1, 1}, std::pair{1, 200}, std::pair{200, 1}}) {
        ExtremeSettings settings = few;
        settings.width = size.first;
        settings.height = size.second;
        const auto picture = checked<T>({}, settings).rendered;
        CHECK(picture.image.width == settings.width);
        CHECK(picture.image.height == settings.height);
        CHECK(picture.counts.camera_rays ==
              std::uint64_t(size.first * size.second * 2));
    }
}

TEST_CASE("extremes: one ray, and a hundred thousand in one pixel") {
    ExtremeSettings settings = few;
    settings.width = settings.height = 1;
    const auto mean = [&](int samples, std::uint64_t seed) {
        settings.samples = samples;
        settings.seed = seed;
        return mean_of(checked<float>({}, settings).rendered.image);
    };
    CHECK(mean(1, 1) >= 0); // with this seed the ray meets light, as checked() asks
    // The photons are shared by all rays: that is most of what two seeds differ by.
    CHECK(mean(100'000, test_seed(1)) ==
          doctest::Approx(mean(100'000, test_seed(2))).epsilon(0.02));
}

TEST_CASE_TEMPLATE("extremes: 1 to 64 threads, the same bytes", T, float, double) {
    ExtremeSettings settings = few;
    settings.threads = 1;
    const auto one = checked<T>({}, settings);
    for (const int threads : {2, 3, 7, 16, 64}) {
        CAPTURE(threads);
        settings.threads = threads;
        const auto many = checked<T>({}, settings);
        CHECK(same_bytes(many.rendered.image, one.rendered.image));
        CHECK(many.photons == one.photons);
    }
}

TEST_CASE("extremes: what cannot be rendered is refused in a sentence") {
    const auto refused = [](const std::string& words, const Extreme& how,
                            const ExtremeSettings& settings = few) {
        const std::string said =
            ljus_test::refusal([&] { (void)render_extreme<float>(how, settings); });
        CAPTURE(words);
        CAPTURE(said);
        CHECK(said.find(words) != std::string::npos);
    };
    refused("absorption", {.scale = 0});
    refused("radius", {.scale = 1e-20});
    refused("quad.corner", {.scale = 1e39});
    refused("albedo", {.albedo = 1.001});
    refused("index", {.index = 0});
    refused("roughness", {.gloss = 0.001});
    refused("roughness", {.matt = 1.001});
    ExtremeSettings settings = few;
    settings.width = 0;
    refused("size is 0 x 24", {}, settings);
    settings = few;
    settings.samples = 0;
    refused("samples", {}, settings);
    settings = few;
    settings.photons = -1;
    refused("photons", {}, settings);
}
