// The light of a lamp, of several and of the sun, at a place, against closed forms.
// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
// none failed.
#include <doctest/doctest.h>

#include <numbers>

#include "ljus/geometry/moving.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/path/all_lights.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/closed_forms.hpp"
#include "support/mean.hpp"
#include "support/rooms.hpp"
#include "support/seed.hpp"
#include "support/within.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

constexpr double pi = std::numbers::pi;

/// A floor at y = 0 and what is added to it.
template <typename T>
BallRoomT<T> floor_room() {
    BallRoomT<T> room;
    const auto white = room.add(LambertianT<T>{.albedo = RgbT<T>{T(0.5)}});
    room.add(QuadT<T>{.corner{T(-50), T(0), T(-50)},
                      .edge_u{T(0), T(0), T(100)},
                      .edge_v{T(100), T(0), T(0)}},
             white);
    return room;
}

/// The mean of the direct light of all lights, without any weight, where a ray meets
/// the closed room, the material made brighter or darker by the albedo.
template <typename T>
Mean direct(const BallRoomT<T>& room, const RayT<T>& ray,
            const LambertianT<T>& material, int samples, Counts& counts,
            RgbT<T> medium = RgbT<T>{T(0)}) {
    const World world(room);
    const auto hit = closest_hit(world, ray);
    REQUIRE(hit);
    VertexT<T> at = vertex_at(world, ray, *hit);
    at.medium = medium;
    auto stream = random_stream(ljus_test::test_seed(1), Pass::user, 0, 0);
    Mean mean;
    for (int i = 0; i < samples; ++i) {
        RgbT<T> sum{T(0)};
        for (std::uint32_t light = 0; light < world.light_count(); ++light)
            sum += direct_light(world, light, at, material, next_2d<T>(stream),
                                MisT<T>{}, counts);
        mean.add(double(sum.x));
    }
    return mean;
}

} // namespace

TEST_CASE_TEMPLATE("direct light: a point light gives I cos / d^2, exactly", T, float,
                   double) {
    for (const double height : {0.01, 1.0, 40.0})
        for (const double aside : {0.0, 0.5, 3.0}) {
            auto room = floor_room<T>();
            room.add(PointLightT<T>{.position{T(aside * height), T(height), T(0)},
                                    .intensity = RgbT<T>{T(7)}});
            const RayT<T> ray{.origin{T(0), T(0.005), T(0)},
                              .direction{T(0), T(-1), T(0)}};
            Counts counts;
            const Mean seen = direct(room, ray, LambertianT<T>{}, 3, counts);
            const double d2 = height * height * (1 + aside * aside);
            const double right = 0.5 / pi * 7 * (height / std::sqrt(d2)) / d2;
            CAPTURE(height);
            CAPTURE(aside);
            CHECK(seen.mean == doctest::Approx(right).epsilon(1e-5));
            CHECK(seen.error() < 1e-6 * right);
            CHECK(counts.shadow_rays == 3);
        }
}

TEST_CASE_TEMPLATE("direct light: lamps give their closed forms", T, float, double) {
    const double limit = ljus_test::limit_of(8); // 4 lamps, two precisions
    const RayT<T> ray{.origin{T(0), T(0.01), T(0)}, .direction{T(0), T(-1), T(0)}};
    Counts counts;
    for (const double radius : {0.001, 0.8}) { // E = pi L (R/d)^2
        auto room = floor_room<T>();
        const auto black = room.add(LambertianT<T>{.albedo = RgbT<T>{T(0)}});
        room.add(SphereT<T>{.center{T(0), T(1), T(0)}, .radius = T(radius)}, black,
                 RgbT<T>{T(3)});
        const Mean seen = direct(room, ray, LambertianT<T>{}, 20000, counts);
        CHECK(std::abs(apart(seen, 0.5 * 3 * radius * radius, 1e-4)) < limit);
    }
    for (const double height : {0.5, 4.0}) { // four rectangles with a corner above
        auto room = floor_room<T>();
        const auto black = room.add(LambertianT<T>{.albedo = RgbT<T>{T(0)}});
        room.add(QuadT<T>{.corner{T(-1), T(height), T(-0.5)},
                          .edge_u{T(2), T(0), T(0)},
                          .edge_v{T(0), T(0), T(1)}},
                 black, RgbT<T>{T(3)});
        const double factor = 4 * ljus_test::form_factor_of_corner(1, 0.5, height);
        const Mean seen = direct(room, ray, LambertianT<T>{}, 40000, counts);
        CHECK(std::abs(apart(seen, 0.5 * 3 * factor, 1e-4)) < limit);
    }
}

TEST_CASE("direct light: two lamps are added, not averaged") {
    BallRoom room = floor_room<float>();
    const Ray ray{.origin{0, 0.01f, 0}, .direction{0, -1, 0}};
    Counts counts;
    room.add(PointLight{.position{0, 2, 0}, .intensity = Rgb{1}});
    const double one = direct(room, ray, Lambertian{}, 1, counts).mean;
    room.add(PointLight{.position{0, 2, 0}, .intensity = Rgb{3}});
    CHECK(direct(room, ray, Lambertian{}, 1, counts).mean ==
          ljus_test::within(4 * one, 1e-6));
}

TEST_CASE("direct light: what stands between hides the light, glass and mirrors too") {
    const Ray ray{.origin{0, 0.01f, 0}, .direction{0, -1, 0}};
    for (const Ball ball : {Ball::lambertian, Ball::glass, Ball::mirror}) {
        BallRoom room = floor_room<float>();
        add_ball(room,
                 ball); // around (0.1, -0.4, -0.1): put the floor's point below it
        room.add(PointLight{.position{0, 5, 0}, .intensity = Rgb{1}});
        std::get<0>(room.shapes)[0].center = {0, 2, 0};
        Counts counts;
        CHECK(direct(room, ray, Lambertian{}, 10, counts).mean == 0);
        CHECK(counts.shadow_rays == 10);
        // Beyond the light, and beside its way, a ball hides nothing.
        for (const Vec3 center : {Vec3{0, 6, 0}, Vec3{1, 2, 0}}) {
            std::get<0>(room.shapes)[0].center = center;
            CHECK(direct(room, ray, Lambertian{}, 10, counts).mean ==
                  ljus_test::within(0.5 / pi / 25, 1e-5));
        }
    }
}

TEST_CASE("direct light: no ray where nothing can come") {
    Counts counts;
    const Ray ray{.origin{0, 0.01f, 0}, .direction{0, -1, 0}};
    { // a lamp that turns its back
        BallRoom room = floor_room<float>();
        const auto black = room.add(Lambertian{.albedo = Rgb{0}});
        room.add(Quad{.corner{-1, 2, -1}, .edge_u{0, 0, 2}, .edge_v{2, 0, 0}}, black,
                 Rgb{3});
        CHECK(direct(room, ray, Lambertian{}, 10, counts).mean == 0);
        CHECK(counts.shadow_rays == 0);
    }
    { // a light below the floor: opaque
        BallRoom room = floor_room<float>();
        room.add(PointLight{.position{0, -2, 0}, .intensity = Rgb{1}});
        CHECK(direct(room, ray, Lambertian{}, 10, counts).mean == 0);
        CHECK(counts.shadow_rays == 0);
    }
    { // a black surface
        BallRoom room = floor_room<float>();
        room.add(PointLight{.position{0, 2, 0}, .intensity = Rgb{1}});
        CHECK(direct(room, ray, Lambertian{.albedo = Rgb{0}}, 10, counts).mean == 0);
        CHECK(counts.shadow_rays == 0);
    }
    { // the light is on the surface itself
        BallRoom room = floor_room<float>();
        room.add(PointLight{.position{0, 0, 0}, .intensity = Rgb{1}});
        const Mean seen = direct(room, ray, Lambertian{}, 10, counts);
        CHECK(seen.mean == 0);
    }
}

TEST_CASE("direct light: within a medium it is absorbed along the way") {
    BallRoom room = floor_room<float>();
    room.add(PointLight{.position{0, 2, 0}, .intensity = Rgb{1}});
    const Ray ray{.origin{0, 0.01f, 0}, .direction{0, -1, 0}};
    Counts counts;
    const double clear = direct(room, ray, Lambertian{}, 1, counts).mean;
    const double dim = direct(room, ray, Lambertian{}, 1, counts, Rgb{0.7f}).mean;
    CHECK(dim == ljus_test::within(clear * std::exp(-1.4), 1e-5));
}

TEST_CASE("direct light: every factor once, in colours, from both sides") {
    // A point light, and a lamp of area 2 seen at its middle: radiance times area, by
    // both cosines and the square of the distance.
    using D3 = glm::dvec3;
    const LambertianT<double> matt{.albedo{0.8, 0.5, 0.2}};
    const D3 fog{0.1, 0.2, 0.3}, intensity{7, 11, 13};
    for (const double side : {1.0, -1.0}) {
        auto room = floor_room<double>();
        room.add(
            PointLightT<double>{.position{3, 4 * side, 0}, .intensity = intensity});
        const D3 u{2, 0, 0}, v{0, 0, 1}; // u x v = -2 y
        room.add(QuadT<double>{{2, 4 * side, -0.5}, side > 0 ? u : v, side > 0 ? v : u},
                 room.add(LambertianT<double>{.albedo = D3{0}}), intensity);
        const World world(std::move(room));
        const RayT<double> ray{.origin{0, side, 0}, .direction{0, -side, 0}};
        VertexT<double> at = vertex_at(world, ray, *closest_hit(world, ray));
        at.medium = fog;
        const auto seen = [&](std::uint32_t light, const MisT<double>& mis) {
            Counts counts;
            const D3 found = direct_light(world, light, at, matt,
                                          Vec2T<double>{0.5, 0.5}, mis, counts);
            CHECK(counts.shadow_rays == 1);
            return found;
        };
        const auto is = [](const D3& found, const D3& right) {
            return glm::distance(found, right) < 1e-9 * glm::length(right);
        };
        const D3 point =
            matt.albedo / pi * intensity * 0.8 / 25.0 * glm::exp(-5.0 * fog);
        const D3 lamp = 2 * 0.8 * point;
        CHECK(is(seen(0, {}), point));
        CHECK(is(seen(1, {}), lamp));
        // Weights: of the lamp, by the densities per steradian of the shadow ray and of
        // the material. No path meets a point, which keeps all of its light.
        const double by_shadow = 0.375 * 25 / (2 * 0.8), by_material = 0.8 / pi;
        for (const MisHeuristic how : {MisHeuristic::balance, MisHeuristic::power}) {
            const double power = how == MisHeuristic::power ? 2 : 1;
            const double weight = 1 / (1 + std::pow(by_material / by_shadow, power));
            const MisT<double> mis{.heuristic = how, .factor = 0.375};
            CHECK(is(seen(0, mis), point));
            CHECK(is(seen(1, mis), weight * lamp));
            // A ray that is not sampled from the material's lobe leaves all of it.
            CHECK(is(seen(1, {how, 0.375, Lobes::specular}), lamp));
            CHECK(is(seen(1, {how, 0.375, Lobes::non_specular}), weight * lamp));
        }
        CHECK(is(seen(1, {MisHeuristic::shadow_rays, 0.375}), lamp));
    }
}

TEST_CASE("direct light: a pane in the way takes its part, a wall all of it") {
    using D3 = glm::dvec3;
    const ThinGlassT<double> glass{.index = 1.5};
    const auto lit = [&](const auto&... between) {
        const World world(make_scene(
            placed(QuadT<double>{{-50, 0, 50}, {100, 0, 0}, {0, 0, -100}},
                   LambertianT<double>{.albedo = D3{0.5}}),
            placed(QuadT<double>{{30, 1, 1}, {2, 0, 0}, {0, 0, -2}}, glass), between...,
            PointLightT<double>{.position{0, 2, 0}, .intensity = D3{8}}));
        const RayT<double> ray{.origin{0, 0.5, 0}, .direction{0, -1, 0}};
        Counts counts;
        return direct_light(world, 0, vertex_at(world, ray, *closest_hit(world, ray)),
                            LambertianT<double>{.albedo = D3{0.5}}, Vec2T<double>{0, 0},
                            MisT<double>{}, counts)
            .x;
    };
    const QuadT<double> across{{-1, 1, 1}, {2, 0, 0}, {0, 0, -2}};
    const QuadT<double> higher{{-1, 1.5, 1}, {2, 0, 0}, {0, 0, -2}};
    // Head on R = 0.04 at each boundary; all turns within: T = (1 - R) / (1 + R).
    const double open = 0.5 / pi * 8 / 4, t = 0.96 / 1.04;
    CHECK(lit() == ljus_test::within(open, 1e-9));
    CHECK(lit(placed(across, glass)) == ljus_test::within(t * open, 1e-9));
    CHECK(lit(placed(across, glass), placed(higher, glass)) ==
          ljus_test::within(t * t * open, 1e-9));
    CHECK(lit(placed(across, glass), placed(higher, LambertianT<double>{})) == 0);
    CHECK(lit(placed(across, LambertianT<double>{})) == 0);
}

TEST_CASE("direct light: of all lights, by several rays each") {
    using D3 = glm::dvec3;
    auto room = floor_room<double>();
    const auto black = room.add(LambertianT<double>{.albedo = D3{0}});
    room.add(PointLightT<double>{.position{0, 2, 0}, .intensity{8, 4, 2}});
    room.add(QuadT<double>{{-1, 3, -1}, {2, 0, 0}, {0, 0, 2}}, black, D3{3, 2, 1});
    const World world(std::move(room));
    const RayT<double> ray{.origin{0, 0.5, 0}, .direction{0, -1, 0}};
    const auto at = vertex_at(world, ray, *closest_hit(world, ray));
    const LambertianT<double> matt{.albedo = D3{0.5}};
    // A square of side 2, 3 above.
    const double factor = 4 * ljus_test::form_factor_of_corner(1, 1, 3);
    const D3 right = 0.5 * (D3{8, 4, 2} / 4.0 / pi + factor * D3{3, 2, 1});
    double spread[2] = {};
    for (const int rays : {1, 4, 16}) {
        Mean mean[3];
        for (std::uint64_t path = 0; path < 4000; ++path) {
            auto stream = random_stream(ljus_test::test_seed(5), Pass::user, 0, path);
            Counts counts;
            auto context = context_of(stream, counts);
            const D3 seen = sample_all_lights(world, at, matt,
                                              {DirectLight::sampled, rays}, context);
            for (int c = 0; c < 3; ++c) mean[c].add(seen[c]);
            CHECK(counts.shadow_rays == std::uint64_t(2 * rays));
        }
        CAPTURE(rays);
        for (int c = 0; c < 3; ++c) // 5 standard errors: once in 1.7 million
            CHECK(std::abs(apart(mean[c], right[c], 1e-9)) < 5);
        if (rays != 4) spread[rays == 16] = mean[0].error();
    }
    CHECK(spread[1] < spread[0] / 6); // 16 by chance would give 1/4: they are spread
}

TEST_CASE_TEMPLATE("direct light: the weights of two ways to one light", T, float,
                   double) {
    const T u = std::numeric_limits<T>::epsilon();
    for (const double a : {1e-30, 1e-3, 0.5, 1.0, 3.0, 1e3, 1e30})
        for (const double b : {1e-30, 1e-3, 0.5, 1.0, 3.0, 1e3, 1e30}) {
            const double balance = double(balance_heuristic(T(a), T(b)));
            const double power = double(power_heuristic(T(a), T(b)));
            const double right = 1 / (1 + b / a); // 1e-60 may be 0
            CHECK(std::abs(balance - right) <= 4 * double(u) * right + 1e-37);
            const double square =
                1 / (1 + (b / a) * (b / a)); // 0 is the best of 1e-120
            CHECK(std::abs(power - square) <= 8 * double(u) * square + 1e-37);
            // All of the light once, by both ways together.
            CHECK(balance + double(balance_heuristic(T(b), T(a))) ==
                  ljus_test::within(1, 4 * double(u)));
            CHECK(power + double(power_heuristic(T(b), T(a))) ==
                  ljus_test::within(1, 4 * double(u)));
        }
    const T none = 0, delta = std::numeric_limits<T>::infinity();
    for (const auto weight : {balance_heuristic<T>, power_heuristic<T>}) {
        CHECK(weight(T(2), none) == 1);
        CHECK(weight(none, T(2)) == 0);
        CHECK(weight(delta, T(2)) == 1);
        CHECK(weight(T(2), delta) == 0);
    }
}

TEST_CASE("direct light: what is known is taken, and one side by both normals") {
    using D3 = glm::dvec3;
    auto room = floor_room<double>();
    room.add(QuadT<double>{{-50, 1, 50}, {100, 0, 0}, {0, 0, -100}},
             room.add(LambertianT<double>{})); // a screen
    room.add(PointLightT<double>{.position{3, 4, 0}, .intensity{7, 11, 13}});
    const LambertianT<double> matt{.albedo{0.8, 0.5, 0.2}};
    const RayT<double> ray{.origin{0, 0.5, 0}, .direction{0, -1, 0}};
    const World world(std::move(room));
    VertexT<double> at = vertex_at(world, ray, *closest_hit(world, ray));
    const auto share = [&](Verdict verdict, Counts& counts) {
        return detail::light_share(world, 0, at, matt, Vec2T<double>{0.5, 0.5},
                                   MisT<double>{}, counts, verdict);
    };
    const D3 sent = matt.albedo / pi * D3{7, 11, 13} * 0.8 / 25.0;
    Counts counts;
    const auto asked = share(Verdict::unknown, counts);
    CHECK(glm::distance(asked.sent, sent) < 1e-12);
    CHECK(asked.arrived == D3{0});
    CHECK(counts.shadow_rays == 1);
    CHECK(counts.skipped_rays == 0);
    const auto known = share(Verdict::lit, counts);
    CHECK(glm::distance(known.sent, sent) < 1e-12);
    CHECK(glm::distance(known.arrived, sent) < 1e-12);
    CHECK(counts.shadow_rays == 1);
    CHECK(counts.skipped_rays == 1);
    CHECK(glm::distance(direct_light(world, 0, at, matt, Vec2T<double>{0, 0},
                                     MisT<double>{}, counts, Verdict::lit),
                        sent) < 1e-12);
    // That nothing stands in the way does not make the fog thinner.
    at.medium = {0.1, 0.2, 0.4};
    const auto in_fog = share(Verdict::lit, counts);
    CHECK(glm::distance(in_fog.sent, sent) < 1e-12);
    CHECK(glm::distance(in_fog.arrived, sent * glm::exp(-5.0 * at.medium)) < 1e-12);
    at.medium = D3{0};
    // A shading normal that leans: a light that lies before one normal and behind the
    // other gives nothing; before both it gives by the shading one's cosine.
    at.smooth = true;
    for (const double lean : {-2.0, -1.0, 0.5, 2.0}) {
        const D3 normal = glm::normalize(D3{lean, 1, 0});
        at.frame = frame_around(normal);
        at.wo = to_local(at.frame, glm::normalize(D3{lean, 4, 0}));
        const double cosine = glm::dot(normal, D3{0.6, 0.8, 0});
        const D3 right = cosine > 0 ? sent / 0.8 * cosine : D3{0};
        CAPTURE(lean);
        CHECK(glm::distance(share(Verdict::lit, counts).arrived, right) < 1e-12);
    }
    at.point.normal = {1, 0, 0}; // the light is before it by 0.6
    at.frame = frame_around(D3{0, 1, 0});
    at.wo = D3{0, 0, 1};
    CHECK(glm::length(share(Verdict::lit, counts).arrived) > 0);
    at.point.normal = {-1, 0, 0};
    CHECK(share(Verdict::lit, counts).arrived == D3{0});
    CHECK(share(Verdict::lit, counts).sent == D3{0});
}

TEST_CASE("direct light: a lamp, and what stands before it, at the time of the path") {
    // A ball of light of radius 1 goes from (0, 5, 0) to (4, 5, 0), and a wall from
    // above the point to far away. Above the horizon a ball gives pi L (r/d)^2 cos;
    // mean of 32^2 points of the unit square. With and without a pane somewhere else.
    using D3 = glm::dvec3;
    using Ball = SphereT<double>;
    using Wall = QuadT<double>;
    const LambertianT<double> matt{.albedo{0.8, 0.5, 0.2}};
    const D3 radiance{3, 2, 1};
    const auto check_in = [&](auto scene) {
        const auto white = scene.add(matt);
        const auto black = scene.add(LambertianT<double>{.albedo = D3{0}});
        scene.add(Wall{{-50, 0, -50}, {0, 0, 100}, {100, 0, 0}}, white);
        scene.add(Moving<Ball>{{.center{0, 5, 0}, .radius = 1}, {4, 0, 0}}, black,
                  radiance);
        scene.add(Moving<Wall>{{{-2, 1, -2}, {4, 0, 0}, {0, 0, 4}}, {50, 0, 0}}, black);
        const RayT<double> ray{.origin{0, 0.5, 0}, .direction{0, -1, 0}};
        const World world(std::move(scene));
        auto at = vertex_at(world, ray, *closest_hit(world, ray));
        for (const double time : {0.0, 0.25, 0.75, 1.0}) {
            at.time = time;
            Counts counts;
            D3 mean{0}, sent{0};
            constexpr int n = 32;
            for (int i = 0; i < n * n; ++i) {
                const Vec2T<double> u{(i % n + 0.5) / n, (i / n + 0.5) / n};
                const auto share = detail::light_share(
                    world, 0, at, matt, u, MisT<double>{}, counts, Verdict::unknown);
                mean += share.arrived / double(n * n);
                sent += share.sent / double(n * n);
            }
            const double d2 = 25 + 16 * time * time;
            const D3 right = matt.albedo * radiance * 5.0 / (std::sqrt(d2) * d2);
            CAPTURE(time);
            for (int c = 0; c < 3; ++c) {
                CHECK(sent[c] == ljus_test::within(right[c], 1e-3));
                CHECK(mean[c] == ljus_test::within(time > 0 ? right[c] : 0, 1e-3));
            }
            CHECK(counts.shadow_rays == n * n);
        }
    };
    check_in(Scene<Shapes<Wall, Moving<Ball>, Moving<Wall>>,
                   Materials<LambertianT<double>>>{});
    Scene<Shapes<Wall, Moving<Ball>, Moving<Wall>>,
          Materials<LambertianT<double>, ThinGlassT<double>>>
        with_pane;
    with_pane.add(Wall{{30, 1, 1}, {2, 0, 0}, {0, 0, -2}},
                  with_pane.add(ThinGlassT<double>{.index = 1.5}));
    check_in(with_pane);
}
