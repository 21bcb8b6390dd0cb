// Distributed rays against areas, quadrature and other scenes. The statistics have
// fixed seeds: "within 4 standard errors" would fail once in 15 000 new ones. Run with
// 20 further seeds: none failed.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ljus/lights/point_light.hpp"
#include "ljus/materials/compensated_glossy.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/render/distributed.hpp"
#include "ljus/render/render.hpp"
#include "ljus/render/whitted.hpp"
#include "ljus/scene/lens_camera.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/mean.hpp"
#include "support/seed.hpp"

using namespace ljus;
using ljus_test::apart;
using ljus_test::Mean;

namespace {

constexpr double pi = std::numbers::pi;
using D2 = glm::dvec2;
using D3 = glm::dvec3;
using QuadD = QuadT<double>;
using MattD = LambertianT<double>;
using RgbD = RgbT<double>;

/// Matt below a gloss, that notes by which lobes it is sampled.
struct Lacquer {
    using Scalar = double;
    MattD matt{};
    Lobes* asked = nullptr;
};
Lobes lobes(const Lacquer&) {
    return Lobes::diffuse | Lobes::glossy;
}
RgbD evaluate(const Lacquer& lacquer, const D3& wo, const D3& wi) {
    return evaluate(lacquer.matt, wo, wi);
}
[[maybe_unused]] double pdf(const Lacquer& lacquer, const D3& wo, const D3& wi, Lobes) {
    return pdf(lacquer.matt, wo, wi);
}
std::optional<BsdfSampleT<double>> sample(const Lacquer& lacquer, const D3& wo,
                                          const D3& u, Transport transport,
                                          Lobes which) {
    *lacquer.asked = which;
    return sample(lacquer.matt, wo, u, transport);
}
void check(const Lacquer&) {}

// Two scenes for most cases: each further type of scene takes a second to compile.
using Studio = Scene<Shapes<Quad, Sphere, Moving<Quad>, Moving<Sphere>>,
                     Materials<Lambertian, Mirror, Glass, Glossy>, Lights<PointLight>>;
using StudioD = Scene<Shapes<QuadD, Moving<QuadD>>,
                      Materials<MattD, MirrorT<double>, Lacquer>,
                      Lights<PointLightT<double>>>;

/// What a renderer finds along a ray.
template <typename Renderer, std::floating_point T, StreamLike Stream,
          typename Log = const NoLog>
RgbT<T> seen_along(const Renderer& renderer, const RayT<T>& ray, Stream& stream,
                   Counts& counts, Log& log = detail::no_log) {
    auto context = context_of(stream, counts, log);
    return radiance(renderer, ray, context);
}

/// The mean of n rays of one pixel, as render() draws them.
template <typename Tracer, typename T>
double mean_of_rays(const Tracer& tracer, const RayT<T>& ray, int rays,
                    std::uint64_t pixel, Sampling sampling, Counts& counts) {
    const Pattern pattern = make_pattern(sampling, rays);
    double sum = 0;
    for (int i = 0; i < rays; ++i) {
        StratifiedStream stream;
        start_ray(stream, ljus_test::test_seed(3), pixel, i, pattern);
        sum += double(seen_along(tracer, ray, stream, counts).x);
    }
    return sum / rays;
}
template <typename Tracer, typename T>
double mean_of_rays(const Tracer& tracer, const RayT<T>& ray, int rays,
                    std::uint64_t pixel, Sampling sampling = Sampling::multi_jittered) {
    Counts counts;
    return mean_of_rays(tracer, ray, rays, pixel, sampling, counts);
}

/// The slope of log(error) over log(n): error(n) is asked for 4, 16, 64, 256.
template <typename Error>
double slope(const Error& error) {
    double sxy = 0, sxx = 0;
    for (const int i : {-3, -1, 1, 3}) {
        const int n = 1 << (5 + i); // 4, 16, 64, 256
        sxy += i * std::log(error(n));
        sxx += i * i * std::log(2.0);
    }
    return sxy / sxx;
}

// --- A square lamp behind a straight edge --------------------------------------------
const D2 edge_normal = glm::normalize(D2{1, 0.4}); // in the plane of the edge, y = 2
constexpr double lamp_radiance = 5, lamp_height = 4, edge_height = 2;

/// Whether the edge lets a point of the lamp through to a point of the floor.
bool is_open(const D2& floor, const D2& lamp) {
    return glm::dot((floor + lamp) / 2.0, edge_normal) > 0; // halfway up
}

/// The lamp [-1, 1]^2, the floor, and a half plane beyond the edge.
auto edge_world() {
    const D2 n = edge_normal, along{-n.y, n.x};
    const auto at = [](const D2& p, double y) { return D3{p.x, y, p.y}; };
    return World(make_scene(
        placed(QuadD{{-20, 0, 20}, {40, 0, 0}, {0, 0, -40}}, MattD{RgbD{0.5}}),
        placed(QuadD{{-1, lamp_height, -1}, {2, 0, 0}, {0, 0, 2}}, MattD{RgbD{0}},
               RgbD{lamp_radiance}),
        placed(QuadD{at(-20.0 * along, edge_height), at(-20.0 * n, 0),
                     at(40.0 * along, 0)},
               MattD{RgbD{0}})));
}

/// The part of the square [-1, 1]^2 that a floor point sees: the area of a polygon, cut
/// off by a half plane (Sutherland and Hodgman), by Gauss' formula.
double open_area(const D2& floor) {
    const std::array<D2, 4> square{D2{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    std::vector<D2> kept;
    const auto height = [&](const D2& p) { return glm::dot(floor + p, edge_normal); };
    for (std::size_t i = 0; i < 4; ++i) {
        const D2 a = square[i], b = square[(i + 1) % 4];
        const double ha = height(a), hb = height(b);
        if (ha > 0) kept.push_back(a);
        if ((ha > 0) != (hb > 0)) kept.push_back(a + ha / (ha - hb) * (b - a));
    }
    double twice = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const D2 a = kept[i], b = kept[(i + 1) % kept.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return twice / 2 / 4;
}

/// The floor's radiance, by the midpoint rule over the lamp.
double lit_by_quadrature(const D2& floor) {
    constexpr int n = 1000;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const D2 lamp{(2 * i + 1.0) / n - 1, (2 * k + 1.0) / n - 1};
            if (!is_open(floor, lamp)) continue;
            const double r2 =
                glm::dot(lamp - floor, lamp - floor) + lamp_height * lamp_height;
            sum += lamp_height * lamp_height / (r2 * r2);
        }
    return 0.5 / pi * lamp_radiance * sum * 4 / (double(n) * n);
}

RayT<double> down_to(const D2& floor) {
    return {.origin{floor.x, 1, floor.y}, .direction{0, -1, 0}};
}

} // namespace

TEST_CASE("distributed rays: the visible part of a square lamp behind an edge is its "
          "area") {
    const auto world = edge_world();
    const QuadD lamp{{-1, lamp_height, -1}, {2, 0, 0}, {0, 0, 2}};
    constexpr int rays = 1024, side = 32;
    for (const double x : {-1.6, -1.2, -0.8, -0.4, -0.05, 0.3, 0.7, 1.1, 1.7}) {
        const D2 floor{x, 0.15};
        const SurfacePointT<double> from{.position{floor.x, 0, floor.y},
                                         .normal{0, 1, 0}};
        double open = 0;
        for (int i = 0; i < rays; ++i) {
            StratifiedStream stream;
            start_ray(stream, ljus_test::test_seed(1), 5, i,
                      make_pattern(Sampling::jittered, rays));
            const auto to = sample_area(lamp, next_2d<double>(stream));
            open += visibility(world, from, to).x / rays;
        }
        CAPTURE(x);
        CAPTURE(open);
        CAPTURE(open_area(floor));
        // Only cells that the edge crosses, at most 2 * 32 - 1 of 1024, can err.
        CHECK(std::abs(open - open_area(floor)) <= (2.0 * side - 1) / rays);
        CHECK(std::abs(open - open_area(floor)) < 0.012); // 4 standard errors
    }
    CHECK(open_area({-1.6, 0.15}) == 0); // umbra
    CHECK(open_area({1.7, 0.15}) == doctest::Approx(1).epsilon(1e-12));
    CHECK(open_area({-0.06, 0.15}) ==
          doctest::Approx(0.5).epsilon(1e-12)); // the middle
}

TEST_CASE("distributed rays: the penumbra's radiance is the quadrature with cosines") {
    const auto world = edge_world();
    const DistributedTracer tracer(world);
    for (const double x : {-0.8, 0.0, 0.6, 2.0}) {
        const D2 floor{x, 0.15};
        Mean seen;
        for (std::uint64_t pixel = 0; pixel < 60; ++pixel)
            seen.add(mean_of_rays(tracer, down_to(floor), 64, pixel));
        const double right = lit_by_quadrature(floor);
        CAPTURE(x);
        CAPTURE(seen.mean);
        CAPTURE(seen.error());
        CHECK(std::abs(apart(seen, right, 1e-4)) < 4);
        CHECK(seen.error() < 0.003);
    }
    // It is not the visible share times the whole lamp's light: cosines differ.
    const double shared = open_area({0.0, 0.15}) * lit_by_quadrature({40, 0.15});
    CHECK(shared != doctest::Approx(lit_by_quadrature({0.0, 0.15})).epsilon(0.01));
}

TEST_CASE("distributed rays: the error falls by n^-1/2, stratified by n^-3/4") {
    // RMS over 150 pixels; the slope of 4 points of 150 each is known to about 0.03.
    const auto world = edge_world();
    const DistributedTracer tracer(world);
    const D2 floor{0.1, 0.15};
    const double right = lit_by_quadrature(floor);
    const auto error_with = [&](Sampling sampling) {
        return [&, sampling](int n) {
            double sum = 0;
            for (std::uint64_t pixel = 0; pixel < 150; ++pixel) {
                const double seen =
                    mean_of_rays(tracer, down_to(floor), n, pixel, sampling);
                sum += (seen - right) * (seen - right) / 150;
            }
            return std::sqrt(sum);
        };
    };
    const double random = slope(error_with(Sampling::random));
    const double jittered = slope(error_with(Sampling::jittered));
    const double multi = slope(error_with(Sampling::multi_jittered));
    const double sobol = slope(error_with(Sampling::sobol));
    CAPTURE(random);
    CAPTURE(jittered);
    CAPTURE(multi);
    CAPTURE(sobol);
    CHECK(random == doctest::Approx(-0.5).epsilon(0.2));
    CHECK(jittered == doctest::Approx(-0.75).epsilon(0.15));
    CHECK(multi == doctest::Approx(-0.75).epsilon(0.15));
    CHECK(sobol < -0.65);
}

namespace {

// A satin floor, a lamp, and nothing else; the integral takes evaluate(), the ray
// sample().
template <typename Gloss>
void check_gloss(const Gloss& gloss) {
    const World world(make_scene(
        placed(QuadD{{-20, 0, 20}, {40, 0, 0}, {0, 0, -40}}, gloss),
        placed(QuadD{{-1, 2, -3}, {2, 0, 0}, {0, 2, 0}}, MattD{RgbD{0}}, RgbD{3})));
    const D3 wo = glm::normalize(D3{0.2, 1, 1.5}), n{0, 1, 0};
    const FrameT<double> frame = frame_around(n);
    double right = 0;
    constexpr int cells = 200;
    for (int i = 0; i < cells; ++i)
        for (int k = 0; k < cells; ++k) {
            const D3 lamp{-1 + (2 * i + 1.0) / cells, 2 + (2 * k + 1.0) / cells, -3};
            const double r2 = glm::dot(lamp, lamp);
            const D3 wi = lamp / std::sqrt(r2);
            right += evaluate(gloss, to_local(frame, wo), to_local(frame, wi)).x *
                     wi.y * -wi.z / r2 * 3 * 4 / (cells * cells);
        }
    Mean seen;
    Counts counts;
    const DistributedTracer tracer(world);
    for (std::uint64_t pixel = 0; pixel < 200; ++pixel)
        seen.add(mean_of_rays(tracer,
                              RayT<double>{.origin = 3.0 * wo, .direction = -wo}, 64,
                              pixel, Sampling::multi_jittered, counts));
    CHECK(counts.shadow_rays == 0); // the reflected ray finds the lamp
    CAPTURE(seen.mean);
    CAPTURE(right);
    CHECK(right > 0.1);
    CHECK(std::abs(apart(seen, right)) < 4);
    CHECK(seen.error() < 0.015 * right);
}

} // namespace

TEST_CASE("distributed rays: gloss sees a lamp as the integral over it says") {
    const GlossyT<double> gloss{.reflectance = RgbD{0.8}, .roughness = 0.5};
    check_gloss(gloss);
    check_gloss(compensated_glossy(gloss));
}

TEST_CASE("distributed rays: with point lights and mirrors it is Whitted's, "
          "bit by bit") {
    Studio room;
    const auto matt = room.add(Lambertian{.albedo = Rgb{0.6f}});
    room.add(Quad{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, matt);
    room.add(Sphere{.center{0, 1, 0}}, room.add(Mirror{Rgb{0.9f}}));
    room.add(Sphere{.center{1.5f, 0.5f, 1}, .radius = 0.5f}, matt);
    room.add(PointLight{.position{2, 5, 4}, .intensity = Rgb{60}});
    const World world(std::move(room));
    const auto camera = look_at({.position{1, 2, 6}, .target{0, 0.7f, 0}});
    const RenderSettings picture{.width = 24,
                                 .height = 16,
                                 .samples = 1,
                                 .threads = 1,
                                 .sampling = Sampling::random};
    const auto blurred = render(DistributedTracer(world), camera, picture);
    const auto sharp = render(WhittedTracer(world), camera, picture);
    CHECK(blurred.image.pixels == sharp.image.pixels);
    CHECK(blurred.counts.rays() == sharp.counts.rays());
    CHECK(sharp.counts.bounce_rays > 20);
}

// --- Motion --------------------------------------------------------------------------
TEST_CASE("distributed rays: a moving strip covers a ray as long as it takes to pass") {
    // A strip of width 0.6 that moves by 2 to the right, seen at different x.
    using Strip = Moving<Quad>;
    Studio scene;
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    scene.add(
        Strip{.shape{{0, -1, 0}, {0.6f, 0, 0}, {0, 2, 0}}, .displacement{2, 0, 0}},
        black, Rgb{1});
    const World world(std::move(scene));
    const DistributedTracer tracer(world);
    for (const double x : {-0.1, 0.1, 0.35, 0.6, 1.0, 1.7, 2.1, 2.45, 2.7}) {
        // At time t it covers [2t, 2t + 0.6].
        const double from = std::max(0.0, (x - 0.6) / 2), to = std::min(1.0, x / 2);
        const double right = std::max(0.0, to - from);
        CAPTURE(x);
        const Ray ray{.origin{float(x), 0, 2}, .direction{0, 0, -1}};
        // The times are in cells: one at each end of the interval may err.
        for (const int rays : {7, 64, 1000})
            CHECK(std::abs(mean_of_rays(tracer, ray, rays, 2) - right) <= 2.0 / rays);
    }
}

TEST_CASE("distributed rays: at each time the scene is that of shapes moved by hand") {
    using Still = Scene<Shapes<Sphere, Quad, Triangle>, Materials<Lambertian>>;
    using Scene3 =
        Scene<Shapes<Moving<Sphere>, Moving<Quad>, Triangle>, Materials<Lambertian>>;
    const Lambertian white{.albedo = Rgb{1}};
    for (const int count : {1, 9}) { // a flat loop, and a tree
        auto numbers =
            random_stream(ljus_test::test_seed(8), Pass::user, 0, std::uint64_t(count));
        const auto somewhere = [&](float size) {
            return size * (next_3d(numbers) - Vec3{0.5f});
        };
        Scene3 scene;
        const auto m = scene.add(white);
        for (int i = 0; i < count; ++i) {
            scene.add(Moving<Sphere>{{somewhere(4), 0.5f}, somewhere(3)}, m);
            if (count == 1) break;
            scene.add(
                Moving<Quad>{{somewhere(4), somewhere(2), somewhere(2)}, somewhere(3)},
                m);
            scene.add(Triangle{somewhere(4), somewhere(4), somewhere(4)}, m);
        }
        const World world(scene);
        CHECK(world.ids().empty() == (count == 1));
        int hits = 0;
        for (int k = 0; k < 60; ++k) {
            const float time = k == 0 ? 0.0f : k == 1 ? 1.0f : next_1d(numbers);
            Still still;
            const auto sm = still.add(white);
            for (const auto& s : std::get<0>(scene.shapes))
                still.add(
                    Sphere{s.shape.center + time * s.displacement, s.shape.radius}, sm);
            for (const auto& q : std::get<1>(scene.shapes))
                still.add(Quad{q.shape.corner + time * q.displacement, q.shape.edge_u,
                               q.shape.edge_v},
                          sm);
            for (const auto& t : std::get<2>(scene.shapes)) still.add(t, sm);
            const World stopped(std::move(still));
            for (int i = 0; i < 60; ++i) {
                const Vec3 from = somewhere(12), to = somewhere(4);
                const Ray ray{.origin = from, .direction = to - from, .time = time};
                const auto found = closest_hit(world, ray);
                const auto right = closest_hit(stopped, ray);
                REQUIRE(found.has_value() == right.has_value());
                REQUIRE(occluded(world, ray) == right.has_value());
                if (!found) continue;
                ++hits;
                REQUIRE(found->at.t == right->at.t);
                REQUIRE(found->object == right->object);
                const auto point = vertex_at(world, ray, *found).point;
                REQUIRE(point.position ==
                        vertex_at(stopped, ray, *right).point.position);
            }
        }
        CHECK(hits > 10); // or nothing was compared
    }
}

TEST_CASE("distributed rays: a moving lamp lights as the mean over its places") {
    StudioD room;
    const auto matt = room.add(MattD{.albedo = RgbD{0.5}});
    room.add(QuadD{{-9, 0, 9}, {18, 0, 0}, {0, 0, -18}}, matt);
    const D3 way{4, 1, 0};
    room.add(Moving<QuadD>{{{-3, 3, -0.5}, {1, 0, 0}, {0, 0, 1}}, way}, matt, RgbD{9});
    double right = 0;
    constexpr int n = 60;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                const D3 p = D3{-3 + (i + 0.5) / n, 3, -0.5 + (j + 0.5) / n} +
                             (k + 0.5) / n * way;
                const double r2 = glm::dot(p, p);
                right += 0.5 / pi * 9 * p.y * p.y / (r2 * r2) / (double(n) * n * n);
            }
    Mean seen;
    const World world(std::move(room));
    const DistributedTracer tracer(world);
    for (std::uint64_t pixel = 0; pixel < 60; ++pixel)
        seen.add(mean_of_rays(tracer, down_to({0, 0}), 64, pixel));
    CAPTURE(seen.mean);
    CAPTURE(right);
    CHECK(std::abs(apart(seen, right, 1e-4)) < 4);
    CHECK(seen.error() < 0.015 * right);
}

TEST_CASE("distributed rays: a scene in which nothing moves draws no time") {
    const auto world = edge_world();
    const DistributedTracer tracer(world);
    static_assert(!detail::lists_moving<decltype(edge_world())>);
    static_assert(detail::lists_moving<
                  World<Scene<Shapes<Quad, Moving<Sphere>>, Materials<Mirror>>>>);
    RandomStream stream;
    Counts counts;
    const RayT<double> up{.origin{30, 5, 30}, .direction{0, 1, 0}};
    (void)seen_along(tracer, up, stream, counts);
    CHECK(stream.counter == std::uint64_t(1) << 16); // the first bounce, nothing drawn
}

TEST_CASE("distributed rays: every path is L D? (S|G)* E") {
    Studio room;
    const auto matt = room.add(Lambertian{.albedo = Rgb{0.6f}});
    const auto satin = room.add(Glossy{.reflectance = Rgb{0.8f}, .roughness = 0.4f});
    room.add(Quad{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, matt);
    room.add(Quad{{-3, 0.1f, 3}, {6, 0, 0}, {0, 2, -6}}, satin);
    room.add(Quad{{-2, 5, -2}, {4, 0, 0}, {0, 0, 4}}, matt, Rgb{4});
    room.add(Moving<Sphere>{{{-1, 2.2f, 0}}, {1, 0, 0}}, room.add(Glass{}));
    room.add(Moving<Sphere>{{{1.5f, 2.4f, 0}, 0.8f}, {0, 0.5f, 0}}, room.add(Mirror{}));
    room.add(PointLight{.position{2, 4, 4}, .intensity = Rgb{10}});
    const auto lens =
        with_lens(look_at({.position{1, 2.5f, 6}, .target{0, 1.5f, 0}}), 0.1f, 5.0f);
    const World world(std::move(room));
    const DistributedTracer tracer(world, {.max_depth = 4});
    PathLog log;
    Counts counts;
    const RenderSettings picture{.width = 20, .height = 20, .samples = 4, .threads = 1};
    const PictureRays rays(picture);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x)
            for (int i = 0; i < 4; ++i)
                (void)trace_pixel(tracer, lens, rays, {x, y, i}, counts, log);
    std::set<std::string> kinds;
    std::size_t longest = 0;
    for (const PathLogLine& line : log.lines) {
        if (line.what == "vertex") continue;
        kinds.insert(line.path + " " + line.what);
        longest = std::max(longest, line.path.size());
        CHECK(line.path.ends_with("L"));
        // A lamp seen straight or by turns, or one shadow ray: that is all.
        CHECK((line.what == "emission" || line.what == "shadow ray"));
    }
    CHECK(kinds.contains("ESL emission"));
    CHECK(kinds.contains("EDL emission"));   // the lamp in the satin
    CHECK(kinds.contains("EDL shadow ray")); // the floor, and points in the satin
    CHECK(kinds.contains("ESDL shadow ray"));
    CHECK(longest <= 7); // E, 4 turns, D, L

    // The same picture for any number of threads, without a bad sample.
    const auto one = render(tracer, lens, picture);
    auto three_threads = picture;
    three_threads.threads = 3;
    const auto three = render(tracer, lens, three_threads);
    CHECK(one.image.pixels == three.image.pixels);
    CHECK(one.counts.rejected == 0);
}

TEST_CASE("distributed rays: the log adds up, ray by ray, in colours") {
    StudioD room;
    const auto matt = room.add(LambertianT<double>{.albedo{0.6, 0.3, 0.1}});
    const auto mirror = room.add(MirrorT<double>{.reflectance{0.9, 0.5, 0.2}});
    room.add(QuadT<double>{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, matt);
    room.add(QuadT<double>{{-5, 0, -4}, {10, 0, 0}, {0, 6, 0}}, mirror);
    room.add(QuadT<double>{{-2, 5, -2}, {4, 0, 0}, {0, 0, 4}}, matt, RgbD{4, 5, 6});
    room.add(PointLightT<double>{.position{2, 4, 3}, .intensity{10, 20, 30}});
    const World world(std::move(room));
    const DistributedTracer tracer(world, {.max_depth = 3});
    int in_the_mirror = 0;
    for (int i = 0; i < 100; ++i) {
        auto random =
            random_stream(ljus_test::test_seed(7), Pass::user, 0, std::uint64_t(i));
        const auto way = D3(next_3d<double>(random)) * 2.0 - D3{1, 1, 2};
        PathLog log;
        Counts counts;
        const RayT<double> ray{.origin{0, 2, 3}, .direction = glm::normalize(way)};
        const D3 seen(seen_along(tracer, ray, random, counts, log));
        D3 told{0};
        for (const PathLogLine& line : log.lines) {
            if (line.what == "vertex") continue;
            told += line.value;
            in_the_mirror += line.path == "ESDL";
        }
        CHECK(glm::length(told - seen) <= 1e-13 * glm::length(seen));
    }
    CHECK(in_the_mirror > 2);
}

TEST_CASE("distributed rays: max_depth turns, and no ray of black light") {
    // Facing mirrors never let a ray out.
    for (const double share : {1.0, 0.0})
        for (const int depth : {0, 1, 4}) {
            StudioD hall;
            const auto mirror = hall.add(MirrorT<double>{.reflectance = RgbD{share}});
            hall.add(QuadT<double>{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, mirror);
            hall.add(QuadT<double>{{-1, -1, 1}, {0, 2, 0}, {2, 0, 0}}, mirror);
            const World world(std::move(hall));
            Counts counts;
            StratifiedStream stream;
            const RayT<double> across{.origin{0, 0, 0.5}, .direction{0, 0, 1}};
            (void)seen_along(DistributedTracer(world, {.max_depth = depth}), across,
                             stream, counts);
            CHECK(counts.bounce_rays == std::uint64_t(share > 0 ? depth : 0));
            CHECK(counts.cut_paths == (share > 0 || depth == 0 ? 1u : 0u));
        }
    // A red mirror and a green one: what comes by both of them is black.
    StudioD red_and_green;
    red_and_green.add(QuadT<double>{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}},
                      red_and_green.add(MirrorT<double>{.reflectance{0, 1, 0}}));
    red_and_green.add(QuadT<double>{{-1, -1, 1}, {0, 2, 0}, {2, 0, 0}},
                      red_and_green.add(MirrorT<double>{.reflectance{1, 0, 0}}));
    const World world(std::move(red_and_green));
    Counts both;
    StratifiedStream numbers;
    (void)seen_along(DistributedTracer(world, {.max_depth = 4}),
                     RayT<double>{.origin{0, 0, 0.5}, .direction{0, 0, 1}}, numbers,
                     both);
    CHECK(both.bounce_rays == 1);
    CHECK(both.cut_paths == 0);
    // A matt surface sends no ray on, so that the depth cuts none; gloss does.
    const Ray down{.origin{0, 1, 0}, .direction{0, -1, 0}};
    for (const int depth : {0, 1}) {
        const auto cut = [&](const auto& material) {
            Studio scene;
            scene.add(Quad{{-20, 0, 20}, {40, 0, 0}, {0, 0, -40}}, scene.add(material));
            const World floor(std::move(scene));
            Counts counts;
            StratifiedStream stream;
            (void)seen_along(DistributedTracer(floor, {.max_depth = depth}), down,
                             stream, counts);
            return counts.cut_paths;
        };
        CHECK(cut(Lambertian{}) == 0);
        CHECK(cut(Glossy{.reflectance = Rgb{0.8f}}) == (depth == 0 ? 1u : 0u));
        CHECK(cut(Mirror{}) == (depth == 0 ? 1u : 0u));
    }
}

TEST_CASE(
    "distributed rays: a matt surface sends no ray on, and gloss no ray to lamps") {
    const auto world = edge_world();
    Counts counts;
    StratifiedStream stream;
    (void)seen_along(DistributedTracer(world), down_to({2, 0}), stream, counts);
    CHECK(counts.bounce_rays == 0);
    CHECK(counts.shadow_rays == 1);
    Studio satin;
    satin.add(Quad{{-20, 0, 20}, {40, 0, 0}, {0, 0, -40}},
              satin.add(Glossy{.reflectance = Rgb{0.8f}}));
    satin.add(Quad{{-1, 4, -1}, {2, 0, 0}, {0, 0, 2}}, satin.add(Lambertian{}), Rgb{5});
    const World shiny(std::move(satin));
    counts = {};
    const Ray down{.origin{0, 1, 0}, .direction{0, -1, 0}};
    (void)seen_along(DistributedTracer(shiny), down, stream, counts);
    CHECK(counts.bounce_rays == 1);
    CHECK(counts.shadow_rays == 0);
}

TEST_CASE("distributed rays: what is below a gloss is seen by the same ray") {
    // No shadow ray goes to the lamp: all lobes must see it by themselves.
    StudioD room;
    Lobes asked = Lobes::none;
    room.add(QuadD{{-20, 0, 20}, {40, 0, 0}, {0, 0, -40}},
             room.add(Lacquer{{.albedo = RgbD{0.5}}, &asked}));
    room.add(QuadD{{-1e4, 4, -1e4}, {2e4, 0, 0}, {0, 0, 2e4}},
             room.add(MattD{.albedo = RgbD{0}}), RgbD{3});
    const World world(std::move(room));
    Counts counts;
    StratifiedStream stream;
    const RgbD seen = seen_along(DistributedTracer(world),
                                 RayT<double>{.origin{0, 1, 0}, .direction{0, -1, 0}},
                                 stream, counts);
    CHECK(asked == Lobes::all);
    CHECK(counts.shadow_rays == 0);
    CHECK(seen.x == doctest::Approx(1.5)); // the lamp is all of the sky
}

TEST_CASE("distributed rays: a light draws two numbers if it has a size, else none") {
    const MattD matt{.albedo = RgbD{0.5}};
    for (const int points : {0, 1, 3})
        for (const int lamps : {0, 1, 2}) {
            StudioD room;
            const auto white = room.add(matt);
            room.add(QuadD{{-20, 0, 20}, {40, 0, 0}, {0, 0, -40}}, white);
            for (int i = 0; i < points; ++i)
                room.add(PointLightT<double>{.position{0, 2.0 + i, 0},
                                             .intensity = RgbD{1}});
            for (int i = 0; i < lamps; ++i)
                room.add(QuadD{{-1, 3.0 + i, -1}, {2, 0, 0}, {0, 0, 2}}, white,
                         RgbD{3});
            const RayT<double> down{.origin{0, 1, 0}, .direction{0, -1, 0}};
            const World world(std::move(room));
            const auto vertex = vertex_at(world, down, *closest_hit(world, down));
            auto stream = random_stream(5, Pass::user, 0, 0), twin = stream;
            Counts counts;
            auto context = context_of(stream, counts);
            (void)detail::soft_light(world, vertex, matt, context);
            for (int i = 0; i < lamps; ++i) (void)next_2d<double>(twin);
            CHECK(next_1d<double>(stream) == next_1d<double>(twin));
            CHECK(counts.shadow_rays == std::uint64_t(points + lamps));
        }
}

TEST_CASE("distributed rays: at the extremes") {
    const auto world = edge_world();
    CHECK_THROWS_WITH_AS((void)DistributedTracer(world, {.max_depth = -1}),
                         "max_depth is -1; it must be at least 0.",
                         std::invalid_argument);
    CHECK(DistributedTracer(world, {.max_depth = 0}).settings().max_depth == 0);
    CHECK(DistributedTracer(world).settings().max_depth == 5);
    Studio room;
    const auto matt = room.add(Lambertian{.albedo = Rgb{0.5f}});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_AS(room.add(Moving<Sphere>{{}, {nan, 0, 0}}, matt),
                    std::invalid_argument);
    CHECK_THROWS_AS(room.add(Moving<Sphere>{{.radius = -1}, {1, 0, 0}}, matt),
                    std::invalid_argument);
    // What does not move is where it was; a way of 1e6 is flown to its end.
    room.add(Moving<Sphere>{{.center{0, 0, 0}}, {0, 0, 0}}, matt);
    room.add(Moving<Sphere>{{.center{5, 0, 0}}, {1e6f, 0, 0}}, matt);
    const World index(std::move(room));
    const Ray ahead{.origin{0, 0, 3}, .direction{0, 0, -1}};
    for (const float time : {0.0f, 0.5f, 1.0f}) {
        Ray then = ahead;
        then.time = time;
        const auto hit = closest_hit(index, then);
        REQUIRE(hit);
        CHECK(hit->at.t == 2);
    }
    Ray far_away{.origin{1e6f + 5, 0, 3}, .direction{0, 0, -1}};
    CHECK(!closest_hit(index, far_away)); // at time 0, if nothing else is said
    far_away.time = 1;
    CHECK(closest_hit(index, far_away));
    CHECK(closest_hit(index, Ray{.origin{5, 0, 3}, .direction{0, 0, -1}}));
}
