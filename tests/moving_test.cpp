// concept: shape
// Shapes on their way, against the same ones moved by hand; and what photons see of
// them, against paths. Of the standard errors that four means are held to one is a
// false alarm in ten thousand runs: they are at most a quarter of what is allowed.
#include "ljus/geometry/moving.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "ljus/geometry/shape.hpp"
#include "ljus/ljus.hpp"
#include "ljus/render/gathering.hpp"
#include "ljus/render/path_tracing.hpp"
#include "support/mean.hpp"
#include "support/numbers.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

} // namespace

TEST_CASE_TEMPLATE("moving: a shape is where its time says, and in its bounds", S,
                   SphereT<float>, QuadT<float>, TriangleT<float>) {
    Numbers n;
    const auto vec = [&](double size) { return Vec3(n.point(size)); };
    const auto any = [&]() -> S {
        if constexpr (std::is_same_v<S, Sphere>)
            return {vec(20), float(n.power(-1, 1))};
        else if constexpr (std::is_same_v<S, Quad>)
            return {vec(20), vec(3), vec(3)};
        else
            return {vec(20), vec(20), vec(20)};
    };
    // A shape moved by hand: the places of its points, in double.
    const auto points = [](const S& shape) -> std::vector<glm::dvec3> {
        if constexpr (std::is_same_v<S, Sphere>) {
            const glm::dvec3 c(shape.center);
            const double r = shape.radius;
            return {c + glm::dvec3{r, 0, 0}, c - glm::dvec3{r, 0, 0},
                    c + glm::dvec3{0, r, 0}, c - glm::dvec3{0, r, 0},
                    c + glm::dvec3{0, 0, r}, c - glm::dvec3{0, 0, r}};
        } else if constexpr (std::is_same_v<S, Quad>) {
            const glm::dvec3 c(shape.corner), u(shape.edge_u), v(shape.edge_v);
            return {c, c + u, c + v, c + u + v};
        } else {
            return {glm::dvec3(shape.v1), glm::dvec3(shape.v2), glm::dvec3(shape.v3)};
        }
    };
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
        const Moving<S> moving{any(), vec(30)};
        const glm::dvec3 way(moving.displacement);
        const Sphere ball = bounding_sphere(moving),
                     still = bounding_sphere(moving.shape);
        const Box box = bounds(moving), first = bounds(moving.shape);
        for (const float time : {0.0f, 0.25f, 1.0f}) {
            const S then = at_time(moving, time);
            const auto before = points(moving.shape), after = points(then);
            for (std::size_t k = 0; k < before.size(); ++k) {
                const glm::dvec3 there = before[k] + double(time) * way;
                REQUIRE(glm::distance(after[k], there) < 1e-4);
                // Both bounds hold it; the box in spite of the rounding, exactly.
                REQUIRE(glm::distance(glm::dvec3(ball.center), there) <
                        double(ball.radius) * (1 + 1e-5));
                for (int axis = 0; axis < 3; ++axis) {
                    REQUIRE(double(box.low[axis]) <= there[axis]);
                    REQUIRE(double(box.high[axis]) >= there[axis]);
                    REQUIRE(double(box.low[axis]) <= after[k][axis]);
                    REQUIRE(double(box.high[axis]) >= after[k][axis]);
                }
            }
            const Vec3 aim = Vec3(after[0] + after[1]) / 2.0f, origin = vec(60);
            const Ray ray{.origin = origin,
                          .direction = glm::normalize(aim - origin),
                          .time = time};
            const auto hit = intersect<float>(ray, moving);
            const auto by_hand = intersect<float>(ray, then);
            REQUIRE(bool(hit) == bool(by_hand));
            if (!hit) continue;
            ++hits;
            REQUIRE(as_hit(*hit).t == as_hit(*by_hand).t);
            REQUIRE(surface_point(moving, ray, as_hit(*hit)).position ==
                    surface_point(then, ray, as_hit(*by_hand)).position);
        }
        // No larger than they have to be.
        REQUIRE(ball.radius ==
                doctest::Approx(still.radius + glm::length(moving.displacement) / 2));
        for (int axis = 0; axis < 3; ++axis)
            REQUIRE(box.high[axis] - box.low[axis] ==
                    doctest::Approx(first.high[axis] - first.low[axis] +
                                    std::abs(moving.displacement[axis]))
                        .epsilon(1e-4));
        REQUIRE(area(moving) == area(moving.shape));
        const auto u = n.square<float>();
        REQUIRE(sample_area(moving, u).position ==
                sample_area(moving.shape, u).position);
    }
    CHECK(hits > 800);
    // A displacement whose square is no float.
    const Moving<S> fast{any(), {1e25f, 0, 0}};
    CHECK(bounding_sphere(fast).radius == doctest::Approx(5e24));

    Moving<S> bad{any(), {1, 2, 3}};
    CHECK_NOTHROW(check(bad));
    for (int axis = 0; axis < 3; ++axis) {
        bad.displacement = {1, 2, 3};
        bad.displacement[axis] = infinity;
        CHECK_THROWS_AS(check(bad), std::invalid_argument);
    }
    CHECK_THROWS_WITH_AS(
        check(Moving<S>{any(), {0, not_a_number, 0}}),
        "moving.displacement is (0, NaN, 0); it must be finite in every "
        "component.",
        std::invalid_argument);
    const S nowhere = translated(any(), Vec3{0, infinity, 0}); // refused as it is
    CHECK_THROWS_AS(check(Moving<S>{nowhere, {1, 2, 3}}), std::invalid_argument);
    CHECK(detail::is_moving<Moving<S>>);
    CHECK_FALSE(detail::is_moving<S>);
    CHECK(FlatShape<S> == !std::is_same_v<S, Sphere>);
    CHECK(std::is_same_v<decltype(at_time(any(), 0.5f)), const S&>);
}

TEST_CASE("moving: a time is drawn only for a scene in which something moves") {
    Scene<Shapes<Sphere, Moving<Sphere>>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    scene.add(Sphere{}, grey);
    const World still(scene);
    scene.add(Moving<Sphere>{{}, {0, 1, 0}}, grey);
    const World moves(scene);
    auto drawn = random_stream(1, Pass::user, 0, 0), untouched = drawn;
    CHECK(camera_path(still, Ray{}, drawn).ray.time == 0);
    const float first = next_1d<float>(untouched);
    CHECK(next_1d<float>(drawn) == first);
    CHECK(camera_path(moves, Ray{}, drawn).ray.time == next_1d<float>(untouched));
}

TEST_CASE("moving: light of all times is in one map, which is said") {
    using Moved = Moving<Sphere>;
    const auto remarks = [](bool glass_moves, bool matt_moves,
                            IndirectLight indirect = IndirectLight::rays) {
        Scene<Shapes<Sphere, Quad, Moved>, Materials<Lambertian, Glass>> scene;
        const auto grey = scene.add(Lambertian{});
        const auto glass = scene.add(Glass{});
        scene.add(Quad{.corner{-3, 0, 3}, .edge_u{6, 0, 0}, .edge_v{0, 0, -6}}, grey);
        scene.add(Quad{.corner{-1, 6, -1}, .edge_u{2, 0, 0}, .edge_v{0, 0, 2}}, grey,
                  Rgb{10});
        const Sphere left{.center{-2, 2, 0}}, right{.center{2, 2, 0}};
        glass_moves ? scene.add(Moved{left, {0, 1, 0}}, glass) : scene.add(left, glass);
        matt_moves ? scene.add(Moved{right, {0, 1, 0}}, grey) : scene.add(right, grey);
        const World world(std::move(scene));
        const PhotonMappingSettings settings{.indirect = indirect,
                                             .caustics{.photons = 20000},
                                             .general{.photons = 100000}};
        const PhotonMapper mapper(world, settings);
        std::string planned;
        for (const std::string& text : survey(world, settings).remarks)
            planned += text + "\n";
        CHECK(mapper_remarks(mapper) == planned);
        return planned;
    };
    CHECK(remarks(true, false).find("mirrors or glass move: ") == 0);
    CHECK(remarks(false, true).empty());
    CHECK(remarks(false, false).empty());
    CHECK(remarks(false, false, IndirectLight::map).empty());
    CHECK(remarks(false, true, IndirectLight::photons).empty()); // nothing gathers
    CHECK(remarks(false, true, IndirectLight::map).find("objects move: ") == 0);
}

TEST_CASE("moving: photons see what moves as paths do, by whatever carries them") {
    // The middle of a matt ball that crosses a room. Photons that lay where they had
    // landed would be spread over all of its way: a quarter of its light would be lost,
    // and more with a smaller radius.
    Scene<Shapes<Sphere, Quad, Moving<Sphere>>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.7f}});
    scene.add(Quad{.corner{-3, 0, 3}, .edge_u{6, 0, 0}, .edge_v{0, 0, -6}}, grey);
    scene.add(Quad{.corner{-3, 0, -3}, .edge_u{6, 0, 0}, .edge_v{0, 4, 0}}, grey);
    scene.add(Quad{.corner{-3, 0, -3}, .edge_u{0, 4, 0}, .edge_v{0, 0, 6}}, grey);
    scene.add(Quad{.corner{3, 0, -3}, .edge_u{0, 0, 6}, .edge_v{0, 4, 0}}, grey);
    scene.add(Quad{.corner{-3, 4, -3}, .edge_u{6, 0, 0}, .edge_v{0, 0, 6}}, grey);
    scene.add(Quad{.corner{-0.5f, 3.95f, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}},
              grey, Rgb{10});
    scene.add(Moving<Sphere>{{.center{-0.75f, 1.2f, 0}, .radius = 1}, {1.5f, 0, 0}},
              grey);
    const World world(std::move(scene));
    const auto mean = [&](const auto& renderer, long long paths) {
        return mean_radiance(renderer, paths, 4, [](auto& stream) {
            const Vec2 u = next_2d<float>(stream);
            const Vec3 at{1.2f * u.x - 0.6f, 1.2f * u.y + 0.6f, 1};
            const Vec3 eye{0, 1.5f, 7};
            return Ray{.origin = eye, .direction = glm::normalize(at - eye)};
        });
    };
    const Mean paths = mean(PathTracer(world, {}), 200'000);
    for (const IndirectLight how : {IndirectLight::map, IndirectLight::photons,
                                    IndirectLight::gather, IndirectLight::cache}) {
        CAPTURE(int(how));
        PhotonMappingSettings settings{.indirect = how};
        settings.general.photons = 300'000;
        settings.general_estimate.radius = 0.1f;
        PhotonMapper mapper(world, settings, abilities<Gathering>);
        const Mean photons =
            mean(mapper, how == IndirectLight::photons ? 60'000 : 20'000);
        CHECK(std::abs(photons.mean / paths.mean - 1) < 0.03);
        CHECK(photons.error() < 0.007 * paths.mean);
    }
}

TEST_CASE("moving: a lamp that passes by lights both ends of its way alike") {
    // Where gather rays end, the light of time 0 would be known, at the left.
    Scene<Shapes<Quad, Moving<Sphere>>, Materials<Lambertian>> scene;
    scene.add(Quad{.corner{-2, 0, 2}, .edge_u{4, 0, 0}, .edge_v{0, 0, -4}},
              scene.add(Lambertian{.albedo = Rgb{0.5f}}));
    scene.add(Moving<Sphere>{{.center{-1, 0.7f, 0}, .radius = 0.3f}, {2, 0, 0}},
              scene.add(Lambertian{.albedo = Rgb{0}}), Rgb{5});
    const World world(std::move(scene));
    PhotonMappingSettings settings{.indirect = IndirectLight::gather};
    settings.general.photons = 40'000;
    const PhotonMapper mapper(world, settings, abilities<Gathering>);
    const auto& points = mapper.state<Gathering>().points;
    Mean left, right;
    for (std::size_t i = 0; i < points.records.size(); ++i)
        (points.tree.point(i).x < 0 ? left : right)
            .add(double(points.records[i].irradiance.x));
    CHECK(left.count > 500);
    // Bounds are 5 standard errors or more.
    CHECK(right.mean / left.mean == doctest::Approx(1).epsilon(0.15));
    CHECK(left.error() < 0.021 * left.mean);
}

TEST_CASE("moving: the centre of a lamp is that of its shape at the time") {
    const Moving<Sphere> ball{{.center{-1, 3, 0}, .radius = 0.5f}, {4, 0, 1}};
    const auto lamp = detail::make_lamp(ball, Rgb{1}, false);
    const AreaLightT<Moving<Sphere>> light{ball, lamp};
    const Vec3 from{0.5f, 0, -1};
    for (const float time : {0.0f, 0.3f, 1.0f}) {
        const auto sample = sample_light(light, from, center_sample(light), time);
        REQUIRE(sample);
        const Vec3 center = ball.shape.center + time * ball.displacement;
        CHECK(glm::distance(sample->wi, glm::normalize(center - from)) < 1e-6f);
    }
}

TEST_CASE("moving: half of a disc lies on a surface that ends at its centre") {
    Scene<Shapes<Moving<Quad>, Moving<Triangle>>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    scene.add(Moving<Quad>{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {0, 0.5f, 3}}, grey);
    scene.add(Moving<Triangle>{{{5, 0, 0}, {7, 0, 0}, {6, 2, 0}}, {0, 0.5f, 3}}, grey);
    const World world(std::move(scene));
    for (const float x : {1.0f, 6.0f}) {
        const Ray down{.origin{x, 0.2501f, 9}, .direction{0, 0, -1}, .time = 0.5f};
        const auto vertex = vertex_at(world, down, *closest_hit(world, down));
        CHECK(vertex.point.position.z == doctest::Approx(1.5));
        CHECK(part_on_surface(world, detail::at_rest(world, vertex), {0, 0, 1}, 0.2f) ==
              doctest::Approx(0.5).epsilon(0.01));
    }
}
