#include <doctest/doctest.h>

#include "ljus/path/continue_path.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/mean.hpp"
#include "support/rooms.hpp"

using namespace ljus;
using namespace ljus_test;

TEST_CASE("vertex: a lamp emits along its normal, and to no other side") {
    Room room;
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Quad{.corner{-1, -1, 0}, .edge_u{2, 0, 0}, .edge_v{0, 2, 0}}, black,
             Rgb{3});                                                      // normal +z
    room.add(Sphere{.center{10, 0, 0}, .radius = 1}, black, Rgb{1}, true); // inwards
    const auto seen = [&](const Vec3& from, const Vec3& direction) {
        const Ray ray{.origin = from, .direction = direction};
        const auto hit = closest_hit(room, ray);
        REQUIRE(hit);
        return vertex_at(room, ray, *hit);
    };
    CHECK(seen({0, 0, 1}, {0, 0, -1}).emits());
    CHECK(seen({0, 0, 1}, {0, 0, -1}).wo.z == doctest::Approx(1));
    CHECK_FALSE(seen({0, 0, -1}, {0, 0, 1}).emits());
    CHECK_FALSE(seen({10, 0, 5}, {0, 0, -1}).emits());
    CHECK(seen({10, 0, 0}, {0, 0, -1}).emits());
    const Vec3 slanted = glm::normalize(Vec3{1, 0, -1});
    const auto at = seen({-0.5f, 0.2f, 0.5f}, slanted);
    CHECK(at.wo.z == doctest::Approx(std::sqrt(0.5)));
    CHECK(glm::length(at.wo) == doctest::Approx(1));
    CHECK(glm::distance(to_world(at.frame, at.wo), -slanted) < 1e-6f);
}

TEST_CASE("vertex: what a path is in after a surface") {
    const Glass glass{.absorption = Rgb{0.1f, 0.2f, 0.3f}};
    const Rgb outside{0}, inside = glass.absorption;
    const Vec3 up = glm::normalize(Vec3{0.3f, 0, 1}), down = -up;
    CHECK(detail::medium_beyond(outside, glass, up, up) ==
          outside); // reflected outside
    CHECK(detail::medium_beyond(outside, glass, up, down) ==
          inside); // refracted into it
    CHECK(detail::medium_beyond(inside, glass, down, down) ==
          inside); // reflected inside
    CHECK(detail::medium_beyond(inside, glass, down, up) ==
          Rgb{0}); // refracted out of it
    const Lambertian matt{};
    CHECK(detail::medium_beyond(inside, matt, up, up) ==
          inside); // a matt ball within glass
}

TEST_CASE("vertex: roulette leaves the mean as it was") {
    // Survivors are divided by the probability of surviving: 3 standard errors of 20000
    // games, three channels and four throughputs.
    for (const Rgb before : {Rgb{0.9f, 0.5f, 0.1f}, Rgb{0.01f, 0.02f, 0}, Rgb{0.3f},
                             Rgb{2.25f, 1, 0.5f}}) {
        Mean after[3];
        auto stream = random_stream(1, Pass::user, 0, 0);
        for (int i = 0; i < 20000; ++i) {
            Rgb throughput = before;
            const bool alive = survives(throughput, 1.0f, next_1d<float>(stream));
            for (int c = 0; c < 3; ++c)
                after[c].add(alive ? double(throughput[c]) : 0.0);
            if (alive) CHECK(max_component(throughput) >= 1.0f - 1e-6f);
        }
        for (int c = 0; c < 3; ++c)
            CHECK(std::abs(apart(after[c], double(before[c]), 1e-6)) < 3);
    }
    // Above 1 nobody dies, and nothing is changed: inside glass throughputs are 2.25.
    Rgb bright{2.25f, 1, 0.5f};
    CHECK(survives(bright, 1.0f, 0.9999999f));
    CHECK(bright == Rgb{2.25f, 1, 0.5f});
    Rgb black{0};
    CHECK_FALSE(survives(black, 1.0f, 0.0f));
    Rgb broken{std::numeric_limits<float>::quiet_NaN()};
    (void)survives(broken, 1.0f, 0.5f); // does what it will, but ends
    // What n^2 makes of the throughput is no reason to die.
    Rgb in_glass{1 / 2.25f};
    CHECK(survives(in_glass, 1 / 2.25f, 0.99999f));
    CHECK(in_glass.x == doctest::Approx(1 / 2.25f));
}

TEST_CASE("vertex: the surface at a hit, seen from its outer side") {
    const auto scene = make_scene(
        placed(Sphere{{0, 0, -5}, 1}, Lambertian{}, Rgb{2}),
        placed(Sphere{{0, 0, -5}, 50}, Lambertian{.albedo = Rgb{0.25f}}, Rgb{0}, true));
    const Ray ray; // along -z
    const auto ball = vertex_at(scene, ray, *closest_hit(scene, ray));
    CHECK(ball.point.position == Vec3{0, 0, -4});
    CHECK(ball.point.normal == Vec3{0, 0, 1});
    CHECK(ball.object.emission == Rgb{2});
    CHECK(ball.frame.normal == ball.point.normal);
    const Ray away{.direction = {0, 0, 1}};
    const auto room = vertex_at(scene, away, *closest_hit(scene, away));
    CHECK(room.point.position == Vec3{0, 0, 45});
    CHECK(room.point.normal == Vec3{0, 0, -1}); // it points inwards
    CHECK(room.object.material == MaterialId{0, 1});
    CHECK(room.object.inside_out);
    CHECK(std::abs(glm::dot(room.frame.tangent, room.frame.normal)) < 1e-6f);
    // Leaving is on the inside, whichever way the normal points.
    CHECK(offset_ray_origin(room.point, Vec3{0, 0, -1}).z < 45);
}
