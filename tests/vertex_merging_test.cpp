// concept: vertex_merging
// Weights against a list of all strategies, shares and pictures against closed forms and
// the path tracer. Means are asked for within limit_of(): a case fails with fresh seeds
// once in 1000 runs; there are 5 of them.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "ljus/inspect/metrics.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/glossy.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/materials/rough_glass.hpp"
#include "ljus/media/fog.hpp"
#include "ljus/path/light_transport.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/vertex_merging.hpp"
#include "ljus/scene/make_scene.hpp"
#include "ljus/scene/picture_lamp.hpp"
#include "ljus/scenes/furnaces.hpp"
#include "support/box_sides.hpp"
#include "support/refusal.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"

using namespace ljus;
using ljus_test::limit_of;
using ljus_test::Mean;
using ljus_test::refusal;
using ljus_test::test_seed;

namespace {

/// The numbers of a path x_0 (on a light) to x_n (before the eye), made up.
struct MadeUp {
    struct Vertex {
        bool specular = false;
        double to_eye = 0, to_light = 0; // density of the next direction, per steradian
        double eye = 0, light = 0;       // cosines to the neighbours
        double distance2 = 0;            // to the vertex nearer to the light
    };
    std::vector<Vertex> x;
    LightEnd end{};
    double probability = 1, merging = 0;

    /// Density of x_i per area, for a path from the light.
    double forward(std::size_t i) const {
        if (i == 0) return end.area > 0 ? probability / end.area : probability;
        const double pdf = i == 1 ? end.pdf : x[i - 1].to_eye;
        return pdf * x[i].light / x[i].distance2;
    }
    /// The same for a path from the eye.
    double backward(std::size_t i) const {
        if (i + 1 == x.size()) return 1;
        return x[i + 1].to_light * x[i].eye / x[i + 1].distance2;
    }
};

MadeUp make_up(RandomStream& stream, std::size_t surfaces, bool lamp) {
    const auto number = [&](double low, double high) {
        return low * std::pow(high / low, next_1d<double>(stream));
    };
    MadeUp path;
    path.x.resize(surfaces + 1);
    for (auto& x : path.x) {
        x.specular = next_1d<double>(stream) < 0.3;
        x.to_eye = x.specular ? 1 : number(0.01, 100);
        x.to_light = x.specular ? 1 : number(0.01, 100);
        x.eye = number(0.1, 1);
        x.light = x.specular ? x.eye : number(0.1, 1);
        x.distance2 = number(0.01, 100);
    }
    path.x[0].specular = false;
    path.x[0].to_light = 0;
    path.probability = number(0.1, 1);
    path.merging = number(0.01, 1000);
    path.end = {.pdf = number(0.01, 10)};
    if (lamp)
        path.end = {.area = number(0.01, 10),
                    .pdf = path.end.pdf,
                    .direct = number(0.1, 10),
                    .cosine = path.x[0].eye};
    return path;
}

/// The density of each strategy by its definition: a product over all vertices.
struct Strategy {
    std::string name;
    std::size_t at = 0;
    double density = 0;
};

std::vector<Strategy> all_strategies(const MadeUp& path) {
    const auto rough = [&](std::size_t i) { return !path.x[i].specular; };
    std::vector<Strategy> all;
    for (std::size_t s = 0; s < path.x.size(); ++s) {
        double density =
            1; // of the first s vertices from the light, others from the eye
        for (std::size_t i = 0; i < path.x.size(); ++i)
            density *= i < s ? path.forward(i) : path.backward(i);
        if (s == 0 && path.end.area > 0)
            all.push_back({"emission", 0, density});
        else if (s == 1 && rough(1))
            all.push_back({"shadow ray", 1, density * path.end.direct});
        else if (s > 1 && rough(s - 1) && rough(s))
            all.push_back({"connection", s, density});
        if (s > 0 && rough(s))
            all.push_back({"merging", s, density * path.forward(s) * path.merging});
    }
    return all;
}

/// The weight by the recursion.
double weight_of(const MadeUp& path, const Strategy& way) {
    const auto& x = path.x;
    const double merging = path.merging;
    std::vector<SubpathWeights> light(x.size()), eye(x.size());
    for (std::size_t i = 1; i < x.size(); ++i) {
        const auto& last = x[i - 1];
        const auto from = i == 1
                              ? started(path.end, path.probability)
                              : scattered(light[i - 1], last.specular ? 0 : last.to_eye,
                                          last.to_light, last.eye, merging);
        light[i] = arrived(from, x[i].light, x[i].distance2);
    }
    for (std::size_t i = x.size() - 1; i-- > 0;) {
        const auto& last = x[i + 1];
        eye[i] = arrived(scattered(eye[i + 1], last.specular ? 0 : last.to_light,
                                   last.to_eye, last.light, merging),
                         x[i].eye, last.distance2);
    }
    const std::size_t s = way.at;
    if (way.name == "emission")
        return weight_against(others_of_emission(eye[0], path.end, path.probability));
    if (way.name == "shadow ray")
        return weight_against(
            others_of_shadow_ray(eye[1], path.end, path.probability, x[1].to_light,
                                 x[1].to_eye, x[1].light, x[1].distance2, merging));
    if (way.name == "connection")
        return weight_against(
            others(light[s - 1], path.backward(s - 1), x[s - 1].to_light, merging) +
            others(eye[s], path.forward(s), x[s].to_eye, merging));
    return weight_against(others_merged(light[s], x[s].to_light, merging) +
                          others_merged(eye[s], x[s].to_eye, merging));
}

/// Sums the terms of a renderer by their names.
struct Terms {
    std::map<std::string, double> sums{};

    void begin() noexcept {}
    void vertex(char, const Vec3&, const Rgb&, float) noexcept {}
    void term(std::string_view owner, std::string_view, const Rgb& value) {
        sums[std::string(owner)] += double(value.x);
    }
};

/// The mean of each term, over independent repetitions with light paths of their own.
template <typename W, typename MakeRay>
std::map<std::string, Mean> shares(const W& world, LightPathSettings settings,
                                   int repetitions, int rays, const MakeRay& ray) {
    std::map<std::string, Mean> means;
    settings.seed = test_seed(settings.seed);
    Counts counts;
    for (int i = 0; i < repetitions; ++i) {
        settings.iteration = std::uint64_t(i);
        const VertexMerger merger(world, settings);
        Terms terms;
        for (const char* name : {"emission", "shadow ray", "connection", "merging"})
            terms.sums[name] = 0;
        for (int k = 0; k < rays; ++k) {
            auto stream = random_stream(settings.seed, Pass::user, std::uint64_t(i),
                                        std::uint64_t(k));
            const Ray start = ray(stream);
            auto context = context_of(stream, counts, terms);
            (void)radiance(merger, start, context);
        }
        double all = 0;
        for (const auto& [name, sum] : terms.sums) {
            means[name].add(sum / rays);
            all += sum / rays;
        }
        means["all"].add(all);
    }
    return means;
}

Ray anywhere(RandomStream& stream) {
    return {.origin{0.1f, 0.2f, -0.1f},
            .direction = sample_uniform_sphere(next_2d<float>(stream))};
}

using Any = Scene<Shapes<Sphere, Quad>,
                  Materials<Lambertian, Glossy, Glass, Mirror, RoughGlass, Mixture>,
                  Lights<PointLight, SunLight>>;
enum class Kind { diffuse, glossy, caustic, mirror };

/// A closed box with a lamp, and what the room is named after. The glossy one has a ball
/// of rough glass that absorbs; those with a glass ball a wall with a mirror's part.
Any box(Kind kind) {
    Any scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.6f}});
    const auto red = scene.add(Lambertian{.albedo{0.6f, 0.2f, 0.1f}});
    const auto gloss = scene.add(Glossy{.reflectance = Rgb{0.8f}, .roughness = 0.4f});
    const auto mirror = scene.add(Mirror{.reflectance = Rgb{0.9f}});
    const bool clear = kind == Kind::caustic || kind == Kind::mirror;
    const auto mixed = scene.add(
        Mixture{.color{0.6f, 0.2f, 0.1f}, .reflectivity = 0.3f, .specularity = 1});
    ljus_test::add_room(scene, Vec3{-1}, Vec3{1},
                        {kind == Kind::glossy ? gloss : white, white,
                         kind == Kind::mirror ? mirror : white, white,
                         clear ? mixed : red, white});
    scene.add(Quad{{-0.4f, 0.99f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}}, white, Rgb{3});
    const Sphere ball{{-0.2f, -0.55f, -0.2f}, 0.35f};
    const auto frosted =
        scene.add(RoughGlass{.roughness = 0.5f, .absorption = Rgb{0.5f}});
    scene.add(ball, clear ? scene.add(Glass{}) : kind == Kind::glossy ? frosted : red);
    return scene;
}

const Camera camera = look_at(
    {.position{0.3f, 0.1f, 0.95f}, .target{0, -0.35f, -0.4f}, .vfov_degrees = 75});

/// The means of 4 x 4 blocks of a picture, over repetitions.
template <typename Draw>
std::array<Mean, 16> blocks(int repetitions, const Draw& draw) {
    std::array<Mean, 16> means;
    for (int i = 0; i < repetitions; ++i) {
        const Image image = draw(i);
        const auto found = block_means(image, image.width / 4).pixels;
        for (std::size_t b = 0; b < 16; ++b) means[b].add(found[b].x);
    }
    return means;
}

} // namespace

TEST_CASE("vertex merging: the recursion has the weights of the list of strategies") {
    auto stream = random_stream(1, Pass::user, 0, 0);
    int ways = 0;
    for (int i = 0; i < 2000; ++i) {
        const MadeUp path = make_up(stream, std::size_t(1 + i % 7), i % 3 > 0);
        const auto all = all_strategies(path);
        double total = 0, weights = 0;
        for (const Strategy& way : all) total += way.density;
        for (const Strategy& way : all) {
            CAPTURE(way.name);
            const double weight = weight_of(path, way);
            CHECK(weight == doctest::Approx(way.density / total).epsilon(1e-9));
            weights += weight;
        }
        if (!all.empty()) CHECK(weights == doctest::Approx(1).epsilon(1e-9));
        ways += int(all.size());
    }
    CHECK(ways > 8000);
}

// In a sphere every vertex is uniform over the area A, whoever finds it. Of light that
// meets n surfaces each of the n + 1 joints by a ray gets the same share, and each of
// the n mergers eta/A times as much.
TEST_CASE("vertex merging: in a sphere each strategy has its share") {
    const auto room = sphere_furnace(Rgb{1}, Rgb{0.5f});
    for (const float radius : {0.0f, 0.02f, 0.1f}) {
        const LightPathSettings settings{.paths = 2000, .radius = radius, .seed = 5};
        const double ratio = settings.merging() / (4 * std::numbers::pi);
        std::map<std::string, double> expected;
        for (int n = 0; n < 60; ++n) {
            const double share = std::pow(0.5, n) / (n + 1 + n * ratio);
            expected["emission"] += share;
            if (n > 0) expected["shadow ray"] += share;
            if (n > 1) expected["connection"] += (n - 1) * share;
            expected["merging"] += n * ratio * share;
        }
        expected["all"] = 2;
        const auto found = shares(room.world, settings, 60, 1000, anywhere);
        for (const auto& term : found) {
            const std::string& name = term.first;
            const Mean& mean = term.second;
            CAPTURE(name);
            CAPTURE(radius);
            CAPTURE(mean.mean);
            CAPTURE(mean.error());
            CHECK(std::abs(mean.mean - expected[name]) <
                  limit_of(15) * mean.error() + 1e-5);
            CHECK(mean.error() < 0.01);
        }
    }
}

// A floor and a wall that see each other at cosines of 1 and 2 over the root of 5. Each
// finds the other with the same density per area, 1 * 2 / (5 pi) / 5.
TEST_CASE("vertex merging: a connection between two angles, by hand") {
    Any scene;
    const Lambertian grey{.albedo = Rgb{0.5f}};
    const auto matt = scene.add(grey);
    scene.add(Quad{{0, 0, 3}, {3, 0, 0}, {0, 0, -3}}, matt);
    scene.add(Quad{{0, 0, 3}, {0, 0, -3}, {0, 3, 0}}, matt);
    scene.add(PointLight{.position{1, 2, 1}});
    const World world(std::move(scene));
    const VertexMerger merger(world, {.paths = 10, .radius = 0.1f});
    const auto at = [&](const Ray& ray) {
        return vertex_at(world, ray, *closest_hit(world, ray));
    };
    const Vertex floor = at({.origin{2, 2, 1}, .direction{0, -1, 0}});
    const SubpathWeights weights{3, 0.7};
    const LightVertexT<float> wall{.vertex =
                                       at({.origin{2, 1, 1}, .direction{-1, 0, 0}}),
                                   .flux = Rgb{4},
                                   .weights{5, 0.2},
                                   .depth = 1};
    Counts counts;
    const Rgb seen = detail::connect(
        merger, detail::CameraVertex{floor, grey, weights, 1}, wall, counts);
    constexpr double pi = std::numbers::pi, eta = 10 * pi * 0.01;
    const double others = 2 / (25 * pi) * ((3 + eta + 0.7 / pi) + (5 + eta + 0.2 / pi));
    const double f = 0.5 / pi;
    CHECK(seen.x == doctest::Approx(f * f * 4 * (2 / 25.0) * 10 / (1 + others)));
}

// A floor that one point light shines on: a shadow ray, or a photon.
TEST_CASE("vertex merging: below a point light two strategies share") {
    Any scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.8f}});
    scene.add(Quad{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, white);
    scene.add(PointLight{.position{0, 1, 0}, .intensity = Rgb{2}});
    const World world(std::move(scene));
    const LightPathSettings settings{.paths = 4000, .radius = 0.05f, .seed = 7};
    const auto down = [](RandomStream&) {
        return Ray{.origin{0.5f, 3, 0}, .direction{0, -1, 0}};
    };
    const auto found = shares(world, settings, 600, 1, down);
    const double d2 = 1.25, cosine = 1 / std::sqrt(d2);
    const double light = 0.8 / std::numbers::pi * 2 * cosine / d2;
    const double ratio = settings.merging() * cosine / (4 * std::numbers::pi * d2);
    CHECK(found.at("shadow ray").mean == doctest::Approx(light / (1 + ratio)));
    CHECK(std::abs(found.at("merging").mean - light * ratio / (1 + ratio)) <
          limit_of(1) * found.at("merging").error() + 0.002 * light);
    CHECK(found.at("merging").error() < 0.05 * light);
    CHECK(found.at("emission").mean == 0);
    CHECK(found.at("connection").mean == 0);
    const VertexMerger merger(world, settings);
    auto stream = random_stream(1, Pass::user, 0, 0);
    Counts counts;
    auto context = context_of(stream, counts);
    (void)radiance(merger, down(stream), context);
    CHECK(counts.map_queries == 1); // the camera path has one surface
}

TEST_CASE("vertex merging: rooms are those of the path tracer, block by block") {
    // Without merging there is no bias; with it, 2 % are allowed.
    for (const Kind kind : {Kind::diffuse, Kind::glossy, Kind::caustic, Kind::mirror}) {
        const World world(box(kind));
        const PathTracer tracer(world, {.max_depth = 40});
        const auto truth = blocks(16, [&](int i) {
            return render(tracer, camera,
                          {.width = 12,
                           .height = 12,
                           .samples = 64,
                           .seed = test_seed(std::uint64_t(1000 + i))})
                .image;
        });
        for (const float radius : {0.0f, 0.03f}) {
            const auto found = blocks(16, [&](int i) {
                const VertexMerger merger(world,
                                          {.paths = 4000,
                                           .radius = radius,
                                           .max_depth = 40,
                                           .seed = test_seed(std::uint64_t(100 + i))});
                return render(merger, camera,
                              {.width = 12,
                               .height = 12,
                               .samples = radius > 0 ? 9 : 36,
                               .seed = test_seed(std::uint64_t(2000 + i))})
                    .image;
            });
            for (std::size_t b = 0; b < 16; ++b) {
                CAPTURE(int(kind));
                CAPTURE(radius);
                CAPTURE(b);
                CAPTURE(found[b].mean);
                CAPTURE(truth[b].mean);
                const double error = std::hypot(found[b].error(), truth[b].error());
                CAPTURE(error);
                const double allowed = radius > 0 ? 0.02 * truth[b].mean : 0;
                CHECK(std::abs(found[b].mean - truth[b].mean) <
                      limit_of(128) * error + allowed);
            }
        }
    }
}

TEST_CASE("vertex merging: its terms have the letters of their paths") {
    const auto room = sphere_furnace(Rgb{1}, Rgb{0.5f});
    const char* const classes[] = {"EL", "EDL", "EDDL", "EDDDL"};
    std::array<Mean, 4> means;
    Counts counts;
    for (std::uint64_t i = 0; i < 60; ++i) {
        const VertexMerger merger(
            room.world,
            {.paths = 1000, .radius = 0.05f, .seed = test_seed(9), .iteration = i});
        for (std::size_t n = 0; n < 4; ++n) {
            const OnlyPaths only(merger, classes[n]);
            double sum = 0;
            for (std::uint64_t k = 0; k < 300; ++k) {
                auto stream = random_stream(test_seed(9), Pass::user, i, k);
                const Ray ray = anywhere(stream);
                auto context = context_of(stream, counts);
                sum += double(radiance(only, ray, context).x) / 300;
            }
            means[n].add(sum);
        }
    }
    for (int n = 0; n < 4; ++n)
        CHECK(std::abs(means[std::size_t(n)].mean - std::pow(0.5, n)) <
              limit_of(4) * means[std::size_t(n)].error() + 1e-5);
}

TEST_CASE("vertex merging: the same bytes for any number of threads") {
    const World world(box(Kind::caustic));
    const auto picture = [&](int threads) {
        const VertexMerger merger(world, {.paths = 3000, .threads = threads});
        return render(merger, camera,
                      {.width = 20, .height = 20, .samples = 4, .threads = threads})
            .image.pixels;
    };
    const auto one = picture(1);
    CHECK(one == picture(2));
    CHECK(one == picture(5));
}

TEST_CASE("vertex merging: the limit of depth is that of the path tracer") {
    const auto room = sphere_furnace(Rgb{1}, Rgb{0.5f});
    for (const int most : {1, 2, 3}) {
        const auto found = shares(room.world,
                                  {.paths = 1000,
                                   .radius = 0.05f,
                                   .max_depth = most,

                                   .seed = 3},
                                  60, 300, anywhere);
        const Mean& all = found.at("all");
        CHECK(std::abs(all.mean - (2 - std::pow(0.5, most))) <
              limit_of(3) * all.error() + 1e-5);
    }
}

TEST_CASE("vertex merging: the extremes") {
    const RenderSettings small{.width = 4, .height = 4, .samples = 16};
    const auto seen = [&](Any scene,
                          const LightPathSettings& settings = {.paths = 500}) {
        const World world(std::move(scene));
        const auto rendered = render(VertexMerger(world, settings), camera, small);
        CHECK(rendered.counts.rejected == 0);
        double sum = 0;
        for (const Rgb& c : rendered.image.pixels) {
            CHECK(is_finite(c));
            CHECK(c.x >= 0);
            sum += double(c.x);
        }
        return sum;
    };
    SUBCASE("no light") {
        Any scene;
        scene.add(Sphere{{0, 0, -1}, 0.5f}, scene.add(Lambertian{}));
        CHECK(seen(std::move(scene)) == 0);
    }
    SUBCASE("nothing at all") {
        CHECK(seen(Any{}) == 0);
    }
    SUBCASE("only glass and a lamp") {
        Any scene;
        scene.add(Sphere{{0, 0, -1}, 0.7f}, scene.add(Glass{}));
        scene.add(Sphere{{0, 0, -4}, 2}, scene.add(Lambertian{.albedo = Rgb{0}}),
                  Rgb{1});
        CHECK(seen(std::move(scene)) > 0);
    }
    SUBCASE("a tiny lamp") {
        Any scene = box(Kind::glossy);
        scene.add(Sphere{{0, 0.3f, 0}, 1e-6f}, scene.add(Lambertian{}), Rgb{1e12f});
        CHECK(seen(std::move(scene)) > 0);
    }
    SUBCASE("one path, and a disc as large as the room") {
        CHECK(seen(box(Kind::diffuse), {.paths = 1, .radius = 3}) > 0);
    }
    SUBCASE("a disc in which hardly a photon lands") {
        CHECK(seen(box(Kind::diffuse), {.paths = 100, .radius = 1e-18f}) > 0);
    }
    SUBCASE("one pixel") {
        const World world(box(Kind::mirror));
        const auto image = render(VertexMerger(world, {.paths = 100}), camera,
                                  {.width = 1, .height = 1, .samples = 1})
                               .image;
        CHECK(is_finite(image.pixels[0]));
    }
}

TEST_CASE("vertex merging: passes have paths of their own, and the radius shrinks") {
    const World world(box(Kind::diffuse));
    const auto pass = [&](long long number, double scale) {
        return vertex_merging_pass(world, camera, {.paths = 500, .radius = 0.1f},
                                   {.width = 8, .height = 8, .samples = 1}, number,
                                   scale)
            .image.pixels;
    };
    CHECK(pass(1, 1) == pass(1, 1));
    CHECK(pass(1, 1) != pass(2, 1));
    const VertexMerger merger(world,
                              {.paths = 500, .radius = 0.1f * 0.5f, .iteration = 3});
    CHECK(
        pass(3, 0.5) ==
        render(
            merger, camera,
            {.width = 8, .height = 8, .samples = 1, .seed = mix_bits(mix_bits(1) + 3)})
            .image.pixels);
}

TEST_CASE("vertex merging: what it cannot carry is refused") {
    const World room(box(Kind::diffuse));
    const auto refused = [&](const LightPathSettings& settings) {
        return refusal([&] { VertexMerger(room, settings); });
    };
    CHECK(refused({.paths = 0}).find("number of light paths is 0") !=
          std::string::npos);
    CHECK(refused({.radius = -1}).find("merging radius is -1") != std::string::npos);
    CHECK(refused({.radius = std::numeric_limits<float>::infinity()}) != "");
    CHECK(refused({.max_depth = 0}).find("max_depth is 0") != std::string::npos);

    Any sunny = box(Kind::diffuse);
    sunny.add(SunLight{});
    const World outside(std::move(sunny));
    const auto by_sun = refusal([&] { VertexMerger merger(outside); });
    CAPTURE(by_sun);
    CHECK(by_sun.find("light is 1") != std::string::npos);
    const World window(make_scene(
        placed(Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, PictureLamp{}, Rgb{1})));
    const auto by_picture = refusal([&] { VertexMerger merger(window); });
    CAPTURE(by_picture);
    CHECK(by_picture.find("a lamp without a picture") != std::string::npos);

    const World moving(make_scene(
        placed(Moving<Sphere>{.shape{}, .displacement{1, 0, 0}}, Lambertian{})));
    CHECK(refusal([&] { VertexMerger merger(moving); }) != "");

    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<>, Media<Fog<Sphere>>> foggy;
    foggy.add(Fog<Sphere>{.scattering = Rgb{1}});
    const World fog(std::move(foggy));
    CHECK(refusal([&] { (void)trace_light_paths(fog, {}); }).find("has fog") !=
          std::string::npos);
}
