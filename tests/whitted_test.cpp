// Whitted's ray tracing against optics on paper: a ball over a checkered floor under a
// point light. The paper knows nothing of the library's functions: textbook quadratic,
// Snell by angles, and a ray in a ball of glass as a fan of chords in one plane.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "ljus/image/texture.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/oren_nayar.hpp"
#include "ljus/materials/textured.hpp"
#include "ljus/render/render.hpp"
#include "ljus/render/whitted.hpp"
#include "support/closed_forms.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"

using namespace ljus;
using ljus_test::apart;
using ljus_test::mean_radiance;

namespace {

constexpr double pi = std::numbers::pi;
using D3 = glm::dvec3;

// --- The scene -----------------------------------------------------------------------
template <typename T>
using Floor = Textured<LambertianT<T>, CheckerT<T>>;

template <typename T>
using BallScene = Scene<Shapes<SphereT<T>, QuadT<T>>,
                        Materials<MirrorT<T>, GlassT<T>, LambertianT<T>, Floor<T>>,
                        Lights<PointLightT<T>>>;

const D3 ball_center{0.3, 1.25, -0.2}, light_place{-3, 6, 4};
constexpr double ball_radius = 1, light_intensity = 100, half_floor = 20;
constexpr double even = 0.8, odd = 0.2, glass_index = 1.5, mirror_share = 0.9;

template <typename T, typename Material>
BallScene<T> ball_scene(const Material& material) {
    BallScene<T> scene;
    const T h = T(half_floor);
    const auto floor =
        scene.add(Floor<T>{{.albedo = RgbT<T>{T(1)}},
                           {.map{.edge_u{T(2), T(0), T(0)}, .edge_v{T(0), T(0), T(2)}},
                            .even = RgbT<T>{T(even)},
                            .odd = RgbT<T>{T(odd)}}});
    scene.add(QuadT<T>{{-h, T(0), h}, {2 * h, T(0), T(0)}, {T(0), T(0), -2 * h}},
              floor);
    scene.add(SphereT<T>{.center = Vec3T<T>(ball_center), .radius = T(ball_radius)},
              scene.add(material));
    scene.add(PointLightT<T>{.position = Vec3T<T>(light_place),
                             .intensity = RgbT<T>{T(light_intensity)}});
    return scene;
}

/// What a renderer finds along a ray.
template <typename Renderer, std::floating_point T, typename Log = const NoLog>
RgbT<T> seen_along(const Renderer& renderer, const RayT<T>& ray, RandomStream& stream,
                   Counts& counts, Log& log = detail::no_log) {
    auto context = context_of(stream, counts, log);
    return radiance(renderer, ray, context);
}

template <typename T>
CameraT<T> camera() {
    return look_at<T>({.position{T(1), T(2.6), T(6)},
                       .target{T(0.2), T(0.9), T(0)},
                       .vfov_degrees = T(40)});
}

// --- The paper -----------------------------------------------------------------------
// What decides on a pixel, as text; where it changes, there is an edge.
struct Paper {
    double radiance = 0;
    std::string edges;
};

/// Whether the ball is within the way from a to b.
bool ball_between(const D3& a, const D3& b) {
    const D3 way = b - a;
    double s = glm::dot(ball_center - a, way) / glm::dot(way, way);
    s = std::min(1.0, std::max(0.0, s));
    return glm::length(a + s * way - ball_center) < ball_radius;
}

/// The floor's light along a ray that does not meet the ball.
double floor_light(const D3& o, const D3& d, Paper& paper) {
    if (!(d.y < 0)) return paper.edges += "sky;", 0;
    const D3 p = o - o.y / d.y * d;
    if (std::abs(p.x) > half_floor || std::abs(p.z) > half_floor)
        return paper.edges += "beyond;", 0;
    const double i = std::floor(p.x), k = std::floor(p.z);
    paper.edges += std::to_string(i) + "," + std::to_string(k);
    if (ball_between(p, light_place)) return paper.edges += " shadow;", 0;
    const D3 way = light_place - p;
    const double r2 = glm::dot(way, way);
    const double albedo = std::fmod(std::abs(i + k), 2.0) < 0.5 ? even : odd;
    return albedo / pi * light_intensity * (way.y / std::sqrt(r2)) / r2;
}

/// The light along a primary ray after at most `depth` turns.
Paper on_paper(const D3& o, const D3& d, bool glass, int depth) {
    Paper paper;
    const double b = glm::dot(o - ball_center, d);
    const double c = glm::dot(o - ball_center, o - ball_center) - 1;
    if (b * b - c < 0) {
        paper.radiance = floor_light(o, d, paper);
        return paper;
    }
    paper.edges = "ball;";
    const double t = -b - std::sqrt(b * b - c);
    const D3 n = o + t * d - ball_center; // of length 1
    const double cosine = -glm::dot(d, n);
    const D3 mirrored = d + 2 * cosine * n;
    if (!glass) {
        if (depth >= 1)
            paper.radiance =
                mirror_share * floor_light(ball_center + n, mirrored, paper);
        return paper;
    }
    // In the plane of n and d: e lies along the surface.
    const D3 e = glm::normalize(d + cosine * n);
    const double in = std::acos(cosine), turned = std::asin(std::sin(in) / glass_index);
    const double f = ljus_test::fresnel_share(cosine, 1, glass_index);
    if (depth >= 1) paper.radiance = f * floor_light(ball_center + n, mirrored, paper);
    // Each chord moves the point by pi - 2 turned around the centre; what leaves there
    // makes the angle `in` with the new normal.
    double share = (1 - f) * (1 - f);
    for (int chord = 1; chord + 1 <= depth; ++chord, share *= f) {
        const double around = chord * (pi - 2 * turned);
        const D3 normal = std::cos(around) * n + std::sin(around) * e;
        const D3 along = -std::sin(around) * n + std::cos(around) * e;
        const D3 out = std::cos(in) * normal + std::sin(in) * along;
        paper.radiance += share * floor_light(ball_center + normal, out, paper);
    }
    return paper;
}

struct Worst {
    int pixels = 0;    ///< Compared.
    int on_ball = 0;   ///< Of them.
    int left_out = 0;  ///< Too close to an edge.
    double error = 0;  ///< Largest absolute one; the brightest pixel is about 2.
    double beyond = 0; ///< Share of the pixels with an error above 1e-5.
};

/// Compares pixels all over the picture with the paper.
template <typename T, typename Material>
Worst compare(const Material& material, bool glass, int depth, double margin) {
    constexpr int size = 38;
    const World world(ball_scene<T>(material));
    const WhittedTracer tracer(world, {.max_depth = depth});
    const CameraT<T> in_t = camera<T>();
    const CameraT<double> exact = camera<double>();
    Worst worst;
    Counts counts;
    RandomStream stream;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::dvec2 at{x + 0.5, y + 0.5};
            const auto paper = [&](double dx, double dy) {
                const auto ray =
                    primary_ray(exact, at + glm::dvec2{dx, dy}, size, size);
                return on_paper(ray.origin, ray.direction, glass, depth);
            };
            const Paper right = paper(0, 0);
            bool edge = false;
            for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}})
                edge = edge || paper(margin * dx, margin * dy).edges != right.edges;
            if (edge) {
                ++worst.left_out;
                continue;
            }
            const auto ray = primary_ray(in_t, Vec2T<T>(at), size, size);
            const auto seen = seen_along(tracer, ray, stream, counts);
            const double error = std::abs(double(seen.x) - right.radiance);
            worst.error = std::max(worst.error, error);
            worst.beyond += error > 1e-5;
            ++worst.pixels;
            worst.on_ball += right.edges.starts_with("ball");
        }
    worst.beyond /= worst.pixels;
    return worst;
}

/// A ray that meets the ball off its middle.
template <typename T>
RayT<T> at_the_ball() {
    const D3 from{1, 2.6, 6};
    return {.origin = Vec3T<T>(from),
            .direction =
                Vec3T<T>(glm::normalize(ball_center + D3{0.4, 0.5, 0} - from))};
}

} // namespace

TEST_CASE("whitted: a mirror over a checkered floor is what paper says") {
    const Worst in_double =
        compare<double>(MirrorT<double>{RgbT<double>{mirror_share}}, false, 5, 1e-3);
    CAPTURE(in_double.error);
    CAPTURE(in_double.left_out);
    CHECK(in_double.pixels >= 1000);
    CHECK(in_double.on_ball > 100);
    CHECK(in_double.error < 1e-5);
    CHECK(in_double.error < 1e-12); // seen: 3e-14
    const Worst in_float =
        compare<float>(Mirror{Rgb{float(mirror_share)}}, false, 5, 1e-2);
    CAPTURE(in_float.error);
    CAPTURE(in_float.beyond);
    CHECK(in_float.pixels >= 1000);
    CHECK(in_float.error < 1e-5);
}

TEST_CASE("whitted: a ball of glass over a checkered floor, depth by depth") {
    for (const int depth : {0, 1, 2, 3, 5, 9}) {
        CAPTURE(depth);
        const Worst in_double =
            compare<double>(GlassT<double>{glass_index}, true, depth, 1e-4);
        CAPTURE(in_double.error);
        CAPTURE(in_double.left_out);
        CHECK(in_double.pixels >= 1000);
        CHECK(in_double.on_ball > 90);
        CHECK(in_double.error < 1e-5);
        CHECK(in_double.error < 1e-11);
    }
    const Worst in_float = compare<float>(Glass{float(glass_index)}, true, 5, 1e-3);
    CAPTURE(in_float.error);
    CAPTURE(in_float.beyond);
    CHECK(in_float.pixels >= 1000);
    CHECK(in_float.error < 1e-5); // seen: 2.6e-6
}

TEST_CASE("whitted: one ball of glass costs 1 + 2d rays") {
    // At each turn one of the two rays leaves for good, the other stays within.
    const World world(ball_scene<double>(GlassT<double>{glass_index}));
    for (int d = 0; d <= 12; ++d) {
        Counts counts{.camera_rays = 1};
        RandomStream stream;
        (void)seen_along(WhittedTracer(world, {.max_depth = d}), at_the_ball<double>(),
                         stream, counts);
        CAPTURE(d);
        CHECK(counts.camera_rays + counts.bounce_rays == std::uint64_t(1 + 2 * d));
    }
}

TEST_CASE("whitted: a mirror costs one ray, a matt floor none but its shadow ray") {
    const World world(ball_scene<double>(MirrorT<double>{}));
    RandomStream stream;
    Counts counts;
    (void)seen_along(WhittedTracer(world), at_the_ball<double>(), stream, counts);
    CHECK(counts.bounce_rays == 1);
    CHECK(counts.shadow_rays == 0); // it is mirrored into the sky
    const RayT<double> down{.origin{4, 3, 4}, .direction{0, -1, 0}};
    counts = {};
    (void)seen_along(WhittedTracer(world), down, stream, counts);
    CHECK(counts.bounce_rays == 0);
    CHECK(counts.shadow_rays == 1);
    // A mirror sends no shadow ray, and without a light none is sent.
    counts = {};
    const RayT<double> up{.origin{0.3, 5, -0.2}, .direction{0, -1, 0}};
    (void)seen_along(WhittedTracer(world), up, stream, counts);
    CHECK(counts.shadow_rays == 0);
    // The depth cuts a path at the mirror, and none at the floor, which sends none on.
    for (const int depth : {0, 1})
        for (const auto& ray : {at_the_ball<double>(), down}) {
            counts = {};
            (void)seen_along(WhittedTracer(world, {.max_depth = depth}), ray, stream,
                             counts);
            const bool mirror = ray.direction != down.direction;
            CHECK(counts.cut_paths == (mirror && depth == 0 ? 1u : 0u));
            CHECK(counts.bounce_rays == (mirror && depth > 0 ? 1u : 0u));
        }
}

TEST_CASE("whitted: the tree doubles only if every ray meets glass again") {
    // Two flat boundaries of index 1.5, one glass above, one below, and between them
    // the gap: a ray in the gap meets glass for ever, what has left never again.
    using Two = Scene<Shapes<QuadT<double>>, Materials<GlassT<double>>>;
    Two two;
    const auto glass = two.add(GlassT<double>{1.5});
    two.add(QuadT<double>{{-50, 0, 50}, {100, 0, 0}, {0, 0, -100}}, glass);
    two.add(QuadT<double>{{-50, 1, 50}, {0, 0, -100}, {100, 0, 0}}, glass);
    // Nested balls: every ray within meets one of the two shells again.
    using Shells = Scene<Shapes<SphereT<double>>, Materials<GlassT<double>>>;
    Shells shells;
    const auto clear = shells.add(GlassT<double>{1.01}); // no total reflection head on
    for (int i = 1; i <= 12; ++i)
        shells.add(SphereT<double>{.radius = double(i)}, clear);
    const World gap(std::move(two));
    const World room(std::move(shells));
    const RayT<double> ray{.origin{0, 0.5, 0}, .direction{0.0, 1.0, 0.0}};
    for (const int d : {1, 2, 3, 4, 5}) {
        CAPTURE(d);
        Counts counts{.camera_rays = 1};
        RandomStream stream;
        (void)seen_along(WhittedTracer(gap, {.max_depth = d}), ray, stream, counts);
        CHECK(counts.camera_rays + counts.bounce_rays == std::uint64_t(1 + 2 * d));
        counts = {.camera_rays = 1};
        (void)seen_along(WhittedTracer(room, {.max_depth = d}), ray, stream, counts);
        CHECK(counts.camera_rays + counts.bounce_rays ==
              (std::uint64_t(2) << d) - 1); // 1 + 2 + 4 + ... + 2^d
    }
}

TEST_CASE("whitted: roulette has the mean of both branches, at a ray for each turn") {
    // Two means; one false alarm in 250 000 runs; with 20 further seeds
    // there was none.
    const World world(ball_scene<double>(GlassT<double>{glass_index}));
    for (const int depth : {2, 5}) {
        Counts counts;
        RandomStream stream;
        const double both = seen_along(WhittedTracer(world, {.max_depth = depth}),
                                       at_the_ball<double>(), stream, counts)
                                .x;
        const WhittedTracer one(world, {.max_depth = depth, .split_glass = false});
        const auto seen = mean_radiance(
            one, 20000, 5, [](RandomStream&) { return at_the_ball<double>(); });
        CAPTURE(depth);
        CAPTURE(both);
        CAPTURE(seen.mean);
        CHECK(both > 0);
        CHECK(seen.error() > 0); // it is a lottery
        CHECK(std::abs(apart(seen, both)) < ljus_test::once_in_a_million);
        counts = {};
        (void)seen_along(one, at_the_ball<double>(), stream, counts);
        CHECK(counts.bounce_rays <= std::uint64_t(depth));
    }
}

TEST_CASE("whitted: every path is L D? S* E, the ambient light apart") {
    auto scene = ball_scene<float>(Glass{float(glass_index)});
    const auto lamp = scene.add(Lambertian{.albedo = Rgb{0.5f}});
    scene.add(Quad{{-1, 5, -1}, {2, 0, 0}, {0, 0, 2}}, lamp, Rgb{20});
    scene.add(Sphere{.center{-2, 0.6f, 1}, .radius = 0.6f}, scene.add(Mirror{}));
    const World world(std::move(scene));
    const WhittedTracer tracer(world, {.max_depth = 4});
    PathLog log;
    Counts counts;
    RandomStream stream;
    std::set<std::string> kinds;
    Rgb sum{0}, told{0};
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            const auto ray = primary_ray(
                camera<float>(), Vec2{float(x) + 0.5f, float(y) + 0.5f}, 24, 24);
            sum += seen_along(tracer, ray, stream, counts, log);
        }
    for (const PathLogLine& line : log.lines) {
        if (line.what == "vertex") continue;
        kinds.insert(line.path);
        told += Rgb(line.value);
    }
    for (const std::string& path : kinds) {
        CAPTURE(path);
        const auto last_s = path.find_first_not_of('S', 1);
        REQUIRE(last_s != std::string::npos);
        const std::string end = path.substr(last_s);
        CHECK((end == "L" || end == "DL"));
        CHECK(last_s <= 5); // E and at most 4 S
    }
    CHECK(kinds.contains("EDL"));
    CHECK(kinds.contains("ESSDL"));
    CHECK(kinds.contains("ESSSSDL"));
    CHECK(kinds.contains("ESL")); // the lamp in the mirror
    CHECK(told.x == doctest::Approx(sum.x).epsilon(1e-5));
}

TEST_CASE("whitted: a lamp with a size lights from its middle, or is only seen") {
    using Room =
        Scene<Shapes<QuadT<double>, SphereT<double>>, Materials<LambertianT<double>>>;
    const RayT<double> ray{.origin{0, 1, 0}, .direction{0, -1, 0}};
    const auto seen = [&](const Room& room, const WhittedSettings& settings) {
        RandomStream stream;
        Counts counts;
        const World world(room);
        return seen_along(WhittedTracer(world, settings), ray, stream, counts).x;
    };
    const auto floor_only = [] {
        Room room;
        const auto matt = room.add(LambertianT<double>{.albedo = RgbT<double>{0.5}});
        room.add(QuadT<double>{{-9, 0, 9}, {18, 0, 0}, {0, 0, -18}}, matt);
        return room;
    };
    // A square lamp of area 4 at height 3, its middle straight above: L A / r^2.
    Room square = floor_only();
    const auto grey = square.add(LambertianT<double>{});
    square.add(QuadT<double>{{-1, 3, -1}, {2, 0, 0}, {0, 0, 2}}, grey, RgbT<double>{7});
    CHECK(seen(square, {}) == doctest::Approx(0.5 / pi * 7 * 4 / 9).epsilon(1e-12));
    CHECK(seen(square, {.lamps = false}) == 0);
    // A ball of radius 1, 3 above: its solid angle, 2 pi (1 - cos), is all that counts.
    Room ball = floor_only();
    ball.add(SphereT<double>{.center{0, 3, 0}}, ball.add(LambertianT<double>{}),
             RgbT<double>{7});
    const double solid = 2 * pi * (1 - std::sqrt(8.0 / 9));
    CHECK(seen(ball, {}) == doctest::Approx(0.5 / pi * 7 * solid).epsilon(1e-12));
    // Ambient light: albedo times its radiance, beside the rest.
    CHECK(seen(ball, {.lamps = false, .ambient = Rgb{0.25f}}) ==
          doctest::Approx(0.125));
    CHECK(seen(ball, {.ambient = Rgb{0.25f}}) - seen(ball, {}) ==
          doctest::Approx(0.125));
}

TEST_CASE("whitted: a point light lights where lamps with a size do not, both sides") {
    // I cos / d^2 times albedo / pi, from above and, by a light below, from below.
    using Room = Scene<Shapes<QuadT<double>>, Materials<LambertianT<double>>,
                       Lights<PointLightT<double>>>;
    Room room;
    const auto matt = room.add(LambertianT<double>{.albedo = RgbT<double>{0.5}});
    room.add(QuadT<double>{{-9, 0, 9}, {18, 0, 0}, {0, 0, -18}}, matt);
    room.add(PointLightT<double>{.position{3, 4, 0}, .intensity = RgbT<double>{50}});
    room.add(PointLightT<double>{.position{0, -2, 0}, .intensity = RgbT<double>{8}});
    const World world(std::move(room));
    for (const bool lamps : {true, false}) {
        RandomStream stream;
        Counts counts;
        const auto seen = [&](double side) {
            const RayT<double> ray{.origin{0, side, 0}, .direction{0, -side, 0}};
            return seen_along(WhittedTracer(world, {.lamps = lamps}), ray, stream,
                              counts)
                .x;
        };
        CHECK(seen(1) == doctest::Approx(0.5 / pi * 50 / 25 * 0.8).epsilon(1e-12));
        CHECK(seen(-1) == doctest::Approx(0.5 / pi * 8 / 4).epsilon(1e-12));
        CHECK(counts.shadow_rays == 2); // the other light is behind the surface
    }
}

TEST_CASE("whitted: ambient light comes along the normal, on both sides") {
    // Lambert: albedo. Oren and Nayar's lobe has A of that where light comes straight.
    const double sigma = 0.6, s2 = sigma * sigma, a = 1 - s2 / (2 * (s2 + 0.33));
    using Room = Scene<Shapes<QuadT<double>>,
                       Materials<LambertianT<double>, OrenNayarT<double>>>;
    for (const bool rough : {false, true}) {
        Room room;
        const RgbT<double> albedo{0.5, 0.25, 1};
        const QuadT<double> floor{{-9, 0, 9}, {18, 0, 0}, {0, 0, -18}};
        if (rough)
            room.add(floor, room.add(OrenNayarT<double>{albedo, sigma}));
        else
            room.add(floor, room.add(LambertianT<double>{.albedo = albedo}));
        const World world(std::move(room));
        for (const D3& from :
             {D3{-1, 1, 0.5}, D3{1, 1, 1}, D3{1, -1, -0.5}, D3{-1, -1, -1}})
            for (const float ambient : {0.25f, 1.0f}) {
                RandomStream stream;
                Counts counts;
                PathLog log;
                const RayT<double> ray{.origin = from,
                                       .direction = -glm::normalize(from)};
                const auto seen =
                    seen_along(WhittedTracer(world, {.ambient = Rgb{ambient}}), ray,
                               stream, counts, log);
                for (int i = 0; i < 3; ++i)
                    CHECK(seen[i] ==
                          doctest::Approx(double(ambient) * albedo[i] * (rough ? a : 1))
                              .epsilon(1e-12));
                REQUIRE(log.lines.size() == 1);
                CHECK(log.lines[0].what == "ambient");
                CHECK(log.lines[0].path == "ED");
            }
    }
}

TEST_CASE("whitted: straight through a ball of glass, the log says ESSD") {
    // Head on each boundary reflects 0.04; what has turned back within leaves later.
    auto scene = ball_scene<double>(GlassT<double>{glass_index});
    const World world(std::move(scene));
    const WhittedTracer tracer(world, {.max_depth = 4, .ambient = Rgb{0.5f}});
    const RayT<double> ray{.origin = ball_center + D3{0, 3, 0}, .direction{0, -1, 0}};
    RandomStream stream;
    Counts counts;
    PathLog log;
    (void)seen_along(tracer, ray, stream, counts, log);
    std::vector<std::string> ambient;
    for (const PathLogLine& line : log.lines)
        if (line.what == "ambient") {
            ambient.push_back(line.path);
            const double albedo = 0.96 * 0.96 * (ambient.size() == 1 ? 0.04 * 0.04 : 1);
            CHECK((line.value.x / albedo == doctest::Approx(0.5 * even) ||
                   line.value.x / albedo == doctest::Approx(0.5 * odd)));
        }
    // The branch that was reflected twice within is followed first.
    CHECK(ambient == std::vector<std::string>{"ESSSSD", "ESSD"});
}

TEST_CASE("whitted: the log names both branches of glass, and adds up ray by ray") {
    // Lambert's floor under a ball of glass, all of it lit: the tree's leaves.
    auto scene = ball_scene<double>(GlassT<double>{glass_index});
    scene.add(PointLightT<double>{.position{2, 3, 1}, .intensity = RgbT<double>{30}});
    const World world(std::move(scene));
    const WhittedTracer tracer(world, {.max_depth = 4, .ambient = Rgb{0.1f}});
    RandomStream stream;
    Counts counts;
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) {
            PathLog log;
            const auto ray =
                primary_ray(camera<double>(), Vec2T<double>{x + 0.5, y + 0.5}, 12, 12);
            const auto seen = seen_along(tracer, ray, stream, counts, log);
            D3 told{0};
            std::size_t depth = 0;
            for (const PathLogLine& line : log.lines) {
                if (line.what == "vertex") {
                    depth = line.path.size() - 1; // "ES" is at depth 1
                    continue;
                }
                told += line.value;
                // A term's letters are those of the vertices before it, and its own.
                CHECK(line.path.substr(0, depth + 1) == "E" + std::string(depth, 'S'));
                CHECK(line.path.size() == depth + 1 + (line.what == "ambient" ? 1 : 2));
            }
            CHECK(glm::length(told - D3(seen)) <= 1e-12 * glm::length(told));
        }
}

TEST_CASE("whitted: a black mirror and a mirror among lights cost nothing") {
    using Hall = Scene<Shapes<QuadT<double>>, Materials<MirrorT<double>>,
                       Lights<PointLightT<double>>>;
    for (const double share : {0.0, 0.5}) {
        Hall hall;
        hall.add(QuadT<double>{{-9, 0, 9}, {18, 0, 0}, {0, 0, -18}},
                 hall.add(MirrorT<double>{.reflectance = RgbT<double>{share}}));
        hall.add(
            PointLightT<double>{.position{0, 4, 0}, .intensity = RgbT<double>{50}});
        const World world(std::move(hall));
        Counts counts;
        RandomStream stream;
        const RayT<double> ray{.origin{1, 1, 0}, .direction{0, -1, 0}};
        CHECK(is_black(seen_along(WhittedTracer(world), ray, stream, counts)));
        CHECK(counts.bounce_rays == (share > 0 ? 1 : 0));
        CHECK(counts.shadow_rays == 0);
    }
}

TEST_CASE("whitted: what two lamps send is the sum of each") {
    const RayT<double> ray{.origin{4, 1, 4}, .direction{0, -1, 0}};
    const auto seen = [&](int lamps) {
        auto scene = ball_scene<double>(MirrorT<double>{});
        for (int i = 1; i < lamps; ++i)
            scene.add(PointLightT<double>{.position{-3, 6, 4},
                                          .intensity = RgbT<double>{light_intensity}});
        const World world(std::move(scene));
        RandomStream stream;
        Counts counts;
        return seen_along(WhittedTracer(world), ray, stream, counts).x;
    };
    CHECK(seen(3) == doctest::Approx(3 * seen(1)).epsilon(1e-14));
}

TEST_CASE("whitted: at the extremes") {
    const World glass(ball_scene<float>(Glass{float(glass_index)}));
    CHECK_THROWS_WITH_AS((void)WhittedTracer(glass, {.max_depth = -1}),
                         "max_depth is -1; it must be within [0, 1000].",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)WhittedTracer(glass, {.max_depth = 1001}),
                         "max_depth is 1001; it must be within [0, 1000].",
                         std::invalid_argument);
    const auto said = [&](const WhittedSettings& settings) {
        return ljus_test::refusal([&] { (void)WhittedTracer(glass, settings); });
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(said({.ambient{0, -1, 0}}).find("whitted.ambient is (0, -1, 0); ") == 0);
    CHECK(said({.ambient{0, 0, nan}}).find("whitted.ambient is (0, 0, NaN); ") == 0);
    CHECK(said({.max_depth = 0}).empty());
    CHECK(said({.max_depth = 1000}).empty());
    const WhittedSettings silent = WhittedTracer(glass).settings();
    CHECK(silent.max_depth == 5);
    CHECK(silent.split_glass);
    CHECK(silent.lamps);
    CHECK(silent.ambient == Rgb{0});
    // A light on the floor, in the middle of the glass, at the camera: no NaN.
    for (const Vec3& place :
         {Vec3{0.5f, 0, 1.5f}, Vec3(ball_center), Vec3{1, 2.6f, 6}}) {
        auto scene = ball_scene<float>(Glass{float(glass_index)});
        scene.add(PointLight{.position = place, .intensity = Rgb{5}});
        const World world(std::move(scene));
        const auto seen =
            render(WhittedTracer(world, {.max_depth = 8}), camera<float>(),
                   {.width = 16, .height = 16, .samples = 2, .threads = 1});
        CHECK(seen.counts.rejected == 0);
    }
    // Facing mirrors without a light between them end at the depth, not before.
    using Hall = Scene<Shapes<Quad>, Materials<Mirror>>;
    Hall hall;
    const auto mirror = hall.add(Mirror{});
    hall.add(Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, mirror);
    hall.add(Quad{{-1, -1, 1}, {0, 2, 0}, {2, 0, 0}}, mirror);
    const World between(std::move(hall));
    Counts counts;
    RandomStream stream;
    const Ray across{.origin{0, 0, 0.5f}, .direction{0, 0, 1}};
    (void)seen_along(WhittedTracer(between, {.max_depth = 1000}), across, stream,
                     counts);
    CHECK(counts.bounce_rays == 1000);
}

TEST_CASE("whitted: what is black sends no ray on") {
    // Nothing comes through glass as dark as this: one ray mirrored, one that ends.
    const World world(ball_scene<double>(
        GlassT<double>{.index = glass_index, .absorption = RgbT<double>{1e6}}));
    RandomStream stream;
    Counts counts;
    (void)seen_along(WhittedTracer(world, {.max_depth = 9}), at_the_ball<double>(),
                     stream, counts);
    CHECK(counts.bounce_rays == 2);
}
