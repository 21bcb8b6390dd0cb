// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
// none failed.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <utility>
#include <vector>

#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scenes/cornell_box.hpp"
#include "ljus/scenes/furnaces.hpp"
#include "ljus/scenes/report_rooms.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"

using namespace ljus;
using ljus_test::test_seed;

namespace {

constexpr int seeds = 16;

// The mean radiance of a small picture of a room, one value a seed and channel.
using Means = std::array<ljus_test::Mean, 3>;

template <typename MakeRenderer>
Means means(const Camera& camera, int rays, const MakeRenderer& with_renderer) {
    Means all;
    for (std::uint64_t seed = 0; seed < seeds; ++seed)
        with_renderer(seed + 1, [&](const auto& renderer) {
            const auto rendered = render(renderer, camera,
                                         {.width = 16,
                                          .height = 16,
                                          .samples = rays,
                                          .seed = test_seed(seed + 1)});
            CHECK(rendered.counts.rejected == 0);
            glm::dvec3 sum{0};
            for (const Rgb& c : rendered.image.pixels) {
                REQUIRE(is_finite(c));
                sum += glm::dvec3(c);
            }
            for (int c = 0; c < 3; ++c) all[std::size_t(c)].add(sum[c] / 256);
        });
    return all;
}

template <typename Scene>
Means path_means(const Room<Scene>& room, int rays) {
    return means(room.camera, rays,
                 [&](std::uint64_t, const auto& use) { use(PathTracer(room.world)); });
}

template <typename Scene>
Means photon_means(const Room<Scene>& room, int rays, float radius) {
    return means(room.camera, rays, [&](std::uint64_t seed, const auto& use) {
        const PhotonMappingSettings settings{
            .caustics = {.photons = 10'000, .seed = test_seed(seed)},
            .caustics_estimate = {.radius = radius}};
        use(PhotonMapper(room.world, settings));
    });
}

// Two means of 16 seeds each: Student's t with at least 15 degrees of freedom is beyond
// 5 by chance in 0.00016 of all cases. With the 24 comparisons of this file, one in
// 260 choices of the seeds would give a false alarm; the seeds are fixed.
void check_equal(const Means& a, const Means& b) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const double error = std::hypot(a[channel].error(), b[channel].error());
        CAPTURE(channel);
        CAPTURE(a[channel].mean);
        CAPTURE(b[channel].mean);
        CAPTURE(error);
        CHECK(std::abs(a[channel].mean - b[channel].mean) <= 5 * error);
        CHECK(error < 0.025 * a[channel].mean); // or it would say nothing
    }
}

template <typename Scene>
void check_both_renderers_agree(const Room<Scene>& room, int rays, float radius) {
    check_equal(path_means(room, rays), photon_means(room, rays, radius));
}

// How many quads, spheres and triangles, which is the order of the report's types.
template <AnyWorld W>
std::array<std::size_t, 3> counts_of(const W& world) {
    const auto& objects = world.objects();
    return {objects[0].size(), objects[1].size(), objects[2].size()};
}

// Every quad and triangle that does not shine turns its normal to a point in the room.
template <typename Scene>
int facing(const Scene& scene, const Vec3& inside) {
    int count = 0;
    const auto look = [&](const auto& shapes) {
        for (const auto& shape : shapes) {
            const auto point = point_at(shape, 0.3f, 0.3f);
            count += glm::dot(point.normal, inside - point.position) > 0 ? 1 : 0;
        }
    };
    look(std::get<std::vector<Quad>>(scene.shapes));
    if constexpr (std::tuple_size_v<decltype(scene.shapes)> == 3)
        look(std::get<std::vector<Triangle>>(scene.shapes));
    return count;
}

// A ball as the report's program has it: both reflectivity and transparency may be 1.
struct ReportBall {
    Vec3 center;
    float radius;
    Rgb color;
    float reflectivity = 0, transparency = 0, index = 1;
};

// The ball is there, of the material that the table of report_rooms.hpp makes of it.
template <AnyWorld W>
void check_ball(const W& world, std::size_t number, const ReportBall& right) {
    CAPTURE(number);
    const Sphere& ball = std::get<std::vector<Sphere>>(world.shapes())[number];
    const auto& object = world.objects()[1][number];
    CHECK(ball.center == right.center);
    CHECK(ball.radius == right.radius);
    CHECK(is_black(object.emission));
    CHECK_FALSE(object.inside_out);
    const auto check_color = [&](const Rgb& absorption) { // of half the way through
        const Rgb through = transmittance(absorption, right.radius);
        for (int i = 0; i < 3; ++i)
            CHECK(through[i] == doctest::Approx(std::max(right.color[i], 0.05f)));
    };
    world.visit_material(object.material, [&]<typename M>(const M& m) {
        if constexpr (std::same_as<M, Lambertian>) {
            CHECK(right.reflectivity + right.transparency == 0);
            CHECK(m.albedo == 0.75f * right.color);
        } else if constexpr (std::same_as<M, Mirror>) {
            CHECK(right.reflectivity == 1);
            CHECK(m.reflectance == Rgb{0.98f});
        } else if constexpr (std::same_as<M, Glass>) {
            CHECK(right.transparency == 1);
            CHECK(right.reflectivity == 0);
            CHECK(m.index == right.index);
            check_color(m.absorption);
        } else {
            const float all = right.reflectivity + right.transparency;
            CHECK(right.transparency == 1);
            CHECK(m.reflectivity == doctest::Approx(right.reflectivity / all));
            CHECK(m.transparency == 1);
            CHECK(m.index == right.index);
            CHECK(is_black(m.color));
            check_color(m.absorption);
        }
    });
}

// Seen from a point, a matt wall stands at this place and has this albedo.
template <AnyWorld W>
void check_wall(const W& world, const Vec3& from, const Vec3& place,
                const Rgb& albedo) {
    CAPTURE(place.x);
    CAPTURE(place.y);
    CAPTURE(place.z);
    const Ray ray{.origin = from, .direction = place - from};
    const auto hit = closest_hit(world, ray);
    REQUIRE(hit);
    CHECK(hit->at.t == doctest::Approx(1).epsilon(1e-5));
    const auto& object = world.object(hit->object);
    CHECK(is_black(object.emission));
    world.visit_material(object.material, [&]<typename M>(const M& m) {
        if constexpr (std::same_as<M, Lambertian>)
            for (int i = 0; i < 3; ++i)
                CHECK(m.albedo[i] == doctest::Approx(albedo[i]).epsilon(1e-6));
        else
            FAIL_CHECK("it is not matt");
    });
}

// A light that is a quad, and its radiance.
template <AnyWorld W>
std::pair<Quad, Rgb> lamp_of(const W& world, std::uint32_t number) {
    return world.visit_light(number, [](const auto& light) {
        std::pair<Quad, Rgb> lamp;
        if constexpr (std::same_as<std::remove_cvref_t<decltype(light)>,
                                   AreaLightT<Quad>>)
            lamp = {light.shape, light.lamp.radiance};
        else
            FAIL_CHECK("it is no square");
        return lamp;
    });
}

// A lamp is a square in the ceiling, from a corner.
template <AnyWorld W>
void check_lamp(const W& world, std::size_t number, const Vec3& corner, float side,
                const Rgb& radiance) {
    const auto [quad, emitted] = lamp_of(world, std::uint32_t(number));
    const Vec3 middle = corner + Vec3{side / 2, side / 2, 0};
    CHECK(glm::distance(point_at(quad, 0.5f, 0.5f).position, middle) < 1e-5f);
    CHECK(area(quad) == doctest::Approx(side * side));
    CHECK(emitted == radiance);
    CHECK(normal(quad).z == -1.0f);
}

} // namespace

TEST_CASE(
    "rooms: the report's camera puts points where the report's formula has them") {
    const Camera camera = report_camera();
    for (const Vec3& p : {Vec3{5, -0.5f, -4}, Vec3{10, 0, -0.5f}, Vec3{6, 4, 2},
                          Vec3{6, -3.5f, -3.5f}, Vec3{13, 0, 5}, Vec3{0, 6, -5}}) {
        const float left = 0.5f - p.y / (p.x + 7);
        const float top = 0.5f - p.z / (p.x + 7);
        const Ray ray = primary_ray(camera, Vec2{400 * left, 400 * top}, 400, 400);
        CHECK(glm::distance(ray.direction, glm::normalize(p - ray.origin)) < 1e-6f);
    }
    CHECK(camera.half_height == doctest::Approx(0.5).epsilon(1e-6));
}

TEST_CASE("rooms: the final room has the report's objects") {
    const auto room = final_room();
    CHECK(counts_of(room.world) == std::array<std::size_t, 3>{8, 8, 6});
    REQUIRE(room.world.light_count() == 2);
    const SceneNeeds found = needs(room.world);
    CHECK(found.specular == 5);
    CHECK(found.diffuse == 8 + 6 + 3);
    // Areas 4 and 1, the second one yellowish.
    const Rgb big = room.world.powers()[0];
    const Rgb small = room.world.powers()[1];
    CHECK(big.x == doctest::Approx(4 * double(small.x)));
    CHECK(small.z == doctest::Approx(0.65 * double(small.x)));
    CHECK(big.x == big.z);
}

TEST_CASE("rooms: the other rooms of the report have theirs") {
    const auto all = all_materials_room();
    CHECK(counts_of(all.world) == std::array<std::size_t, 3>{7, 6, 6});
    CHECK(all.world.light_count() == 1);
    CHECK(needs(all.world).specular == 3);

    const auto glass = four_glass_room();
    CHECK(counts_of(glass.world) == std::array<std::size_t, 3>{7, 4, 2});
    CHECK(glass.world.light_count() == 1);
    CHECK(needs(glass.world).specular == 4);
}

TEST_CASE("rooms: the report's walls, floor and ceiling face inwards") {
    Scene<Shapes<Quad, Triangle>, Materials<Lambertian>> scene;
    add_report_room(scene);
    const auto& quads = std::get<0>(scene.shapes);
    const auto& triangles = std::get<1>(scene.shapes);
    REQUIRE(quads.size() == 6);
    REQUIRE(triangles.size() == 2);
    CHECK(facing(scene, Vec3{5, 0, 0}) == 6);
    float floor = 0;
    float walls = 0;
    for (const Quad& quad : quads) {
        const Vec3 n = normal(quad);
        CHECK(glm::dot(n, Vec3{5, 0, 0} - point_at(quad, 0.5f, 0.5f).position) > 0);
        if (n.z > 0.5f) floor += area(quad);
        if (std::abs(n.z) < 0.5f) walls += area(quad);
    }
    for (const Triangle& triangle : triangles) {
        const Vec3 n = normal(triangle);
        CHECK(n.z * triangle.v1.z < 0);
        if (n.z > 0.5f) floor += area(triangle);
    }
    // The hexagon without its back triangle; 10 + 10 + 2 sqrt(45) of wall, 10 high.
    CHECK(floor == doctest::Approx(138));
    CHECK(walls == doctest::Approx(200 + 20 * std::sqrt(45.0)));
    // The normals that the report's program stores, for the slanted walls.
    CHECK(glm::distance(normal(quads[3]), glm::normalize(Vec3{-2, -1, 0})) < 1e-6f);
    CHECK(glm::distance(normal(quads[4]), glm::normalize(Vec3{-2, 1, 0})) < 1e-6f);
}

TEST_CASE("rooms: the tetrahedron's normals are those of the report's program") {
    const auto room = final_room();
    const auto& triangles = std::get<2>(room.world.shapes());
    constexpr std::array<Vec3, 4> stored{
        Vec3{-2.8036f, 1.15f, 1.63f}, Vec3{0, 1.14f, -3.26f},
        Vec3{2.8036f, 1.15f, 1.63f}, Vec3{0, -3.44f, 0}};
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(glm::distance(normal(triangles[2 + i]), glm::normalize(stored[i])) <
              0.01f);
}

TEST_CASE("rooms: lamps shine downwards and reflect nothing") {
    const auto room = final_room();
    for (std::uint32_t light = 0; light < room.world.light_count(); ++light) {
        REQUIRE(room.world.can_be_met(light));
        const Quad quad = lamp_of(room.world, light).first;
        CHECK(normal(quad).z == -1.0f);
        CHECK(quad.corner.z < 5.0f);
    }
    int lamps = 0;
    for (const auto& object : room.world.objects()[0]) {
        if (object.light == no_light) continue;
        ++lamps;
        CHECK(room.world.visit_material(object.material, [](const auto& m) {
            return is_black(evaluate(m, Vec3{0, 0, 1}, Vec3{0, 0, 1}));
        }));
    }
    CHECK(lamps == 2);
}

TEST_CASE("rooms: coloured glass leaves the square of its colour in the middle") {
    const auto room = final_room();
    const auto& glasses = std::get<1>(room.world.materials());
    REQUIRE(glasses.size() == 3);
    // Yellow, radius 1.5, its blue 0 raised to 0.05; purple, radius 0.5.
    const Rgb yellow = transmittance(glasses[0].absorption, 3.0f);
    CHECK(yellow.x == 1.0f);
    CHECK(yellow.z == doctest::Approx(0.05 * 0.05));
    const Rgb purple = transmittance(glasses[1].absorption, 1.0f);
    CHECK(purple.x == doctest::Approx(0.8 * 0.8));
    CHECK(purple.y == doctest::Approx(0.2 * 0.2));
    CHECK(purple.z == doctest::Approx(1));
    CHECK(glasses[1].index == 1.37f);
}

TEST_CASE(
    "rooms: the thin glass mirrors and transmits as 0.6 to 1, and no more light") {
    const auto room = all_materials_room();
    const auto& mixtures = std::get<3>(room.world.materials());
    REQUIRE(mixtures.size() == 1);
    const auto share = detail::lobe_fractions(mixtures[0], Vec3{0, 0, 1}, Lobes::all);
    CHECK(share.reflect / share.refract == doctest::Approx(0.6));
    CHECK(share.sum() == doctest::Approx(1));
    CHECK(share.diffuse == 0.0f);
}

TEST_CASE("rooms: the Cornell box faces inwards") {
    Scene<Shapes<Quad>, Materials<Lambertian>> scene;
    add_cornell_walls(scene);
    CHECK(scene.size() == 5);
    CHECK(facing(scene, Vec3{0, 1, 0}) == 5);
}

TEST_CASE("rooms: what stands where in the report's rooms, by its program's history") {
    const ReportBall matt[] = {{{5, -0.5f, -4}, 0.75f, {1, 0, 0}},
                               {{10, 0, -0.5f}, 1.25f, {1, 0.2f, 1}},
                               {{6, 4, 2}, 1.15f, {1, 1, 0.2f}},
                               {{8, 3, -3}, 1.15f, {1, 1, 0.2f}, 1}};
    const ReportBall in_final[] = {
        {{6, -3.5f, -3.5f}, 1.15f, {0.5f, 0.5f, 1}, 0.6f, 1, 1.15f},
        {{6, -4, 1.75f}, 1.5f, {1, 1, 0}, 0, 1, 1.47f},
        {{7, 0, 2.75f}, 0.5f, {0.8f, 0.2f, 1}, 0, 1, 1.37f},
        {{6.5f, -2, 0.95f}, 1, {0.7f, 1, 0}, 0, 1, 1.47f}};
    const ReportBall in_all[] = {
        {{6, -3.5f, -3.5f}, 1.15f, {0.5f, 0.5f, 1}, 0.6f, 1, 1},
        {{6, -4, 1.75f}, 1.5f, {1, 1, 1}, 0, 1, 1.97f}};
    const ReportBall of_glass[] = {
        {{6, -4, 1.75f}, 1.5f, {1, 1, 1}, 0, 1, 1.97f},
        {{6, -3.5f, -3.5f}, 1.15f, {0.5f, 0.5f, 1}, 0.6f, 1, 1},
        {{8, 0.5f, -2.5f}, 1.5f, {1, 1, 1}, 0.5f, 1, 1.6f},
        {{7, 4.5f, -3}, 1.15f, {1, 1, 0.2f}, 0, 1, 1.7f}};
    const auto last = final_room(), all = all_materials_room(),
               glass = four_glass_room();
    for (std::size_t i = 0; i < 4; ++i) {
        check_ball(last.world, i, matt[i]);
        check_ball(all.world, i, matt[i]);
        check_ball(last.world, 4 + i, in_final[i]);
        check_ball(glass.world, i, of_glass[i]);
    }
    for (std::size_t i = 0; i < 2; ++i) check_ball(all.world, 4 + i, in_all[i]);
    // A lamp of 2 by 2; the final room has a small yellowish one beside it.
    for (const auto* room : {&last, &all, &glass})
        check_lamp(room->world, 0, {5, -1, 4.999f}, 2, Rgb{30});
    check_lamp(last.world, 1, {4, 2, 4.999f}, 1, 30.0f * Rgb{1, 1, 0.65f});
    // The tetrahedron, corner by corner.
    const Vec3 v[] = {
        {7, 5.09f, -1}, {7, 3.46f, 0.15f}, {6, 3.46f, -1.57f}, {8, 3.46f, -1.57f}};
    const int faces[][3] = {{0, 2, 1}, {0, 3, 2}, {1, 3, 0}, {2, 3, 1}};
    for (const auto* room : {&last, &all})
        for (std::size_t i = 0; i < 4; ++i) {
            const auto& face = std::get<2>(room->world.shapes())[2 + i];
            CHECK(face.v1 == v[faces[i][0]]);
            CHECK(face.v2 == v[faces[i][1]]);
            CHECK(face.v3 == v[faces[i][2]]);
            const auto& object = room->world.objects()[2][2 + i];
            const auto& cyan = std::get<0>(room->world.materials());
            CHECK(cyan[object.material.index].albedo == Rgb{0, 0.75f, 0.75f});
        }
}

TEST_CASE("rooms: the report's walls, by rays to their middles and into the corners") {
    Scene<Shapes<Quad, Triangle>, Materials<Lambertian>> scene;
    add_report_room(scene);
    const World world(std::move(scene));
    const Vec3 from{5, 0, 0};
    const Rgb green = 0.75f * Rgb{0.05f, 1, 0.05f}, blue = 0.75f * Rgb{0.05f, 0.05f, 1};
    const Rgb red = 0.75f * Rgb{1, 0.05f, 0.05f}, white{0.75f};
    const Rgb orange = 0.75f * Rgb{1, 0.25f, 0.05f};
    for (const float z : {-4.9f, 0.0f, 4.9f}) {
        for (const float x : {0.1f, 5.0f, 9.9f}) {
            check_wall(world, from, {x, 6, z}, green);
            check_wall(world, from, {x, -6, z}, orange);
        }
        for (const float s : {0.02f, 0.5f, 0.98f}) {
            check_wall(world, from, {10 + 3 * s, 6 - 6 * s, z}, blue);
            check_wall(world, from, {13 - 3 * s, -6 * s, z}, red);
        }
    }
    for (const float z : {-5.0f, 5.0f})
        for (const Vec3& place :
             {Vec3{0.1f, 5.9f, z}, Vec3{0.1f, -5.9f, z}, Vec3{5, 0, z},
              Vec3{9.9f, 5.9f, z}, Vec3{9.9f, -5.9f, z}, Vec3{12.9f, 0, z}})
            check_wall(world, from, place, white);
    // Behind the camera it is open.
    CHECK_FALSE(closest_hit(world, Ray{.origin = from, .direction{-1, 0, 0}}));
}

TEST_CASE("rooms: the Cornell boxes, number by number") {
    const auto check_box = [](const auto& room) {
        const auto& world = room.world;
        const Vec3 from{0, 1, 0};
        for (const float a : {-0.9f, 0.9f}) {
            check_wall(world, {0, 1, 0.9f}, {a, 0, 0.95f}, Rgb{0.75f});
            check_wall(world, from, {a, 2, -0.9f}, Rgb{0.75f});
            check_wall(world, from, {a, 1.9f, -1}, Rgb{0.75f});
            check_wall(world, from, {-1, 1.9f, a}, Rgb{0.63f, 0.06f, 0.05f});
            check_wall(world, from, {1, 1.9f, a}, Rgb{0.14f, 0.45f, 0.09f});
        }
        CHECK_FALSE(closest_hit(world, Ray{.origin = from, .direction{0, 0, 1}}));
        REQUIRE(world.light_count() == 1);
        const auto [lamp, radiance] = lamp_of(world, 0);
        CHECK(glm::distance(point_at(lamp, 0.5f, 0.5f).position, Vec3{0, 1.99f, 0}) <
              1e-6f);
        CHECK(area(lamp) == doctest::Approx(0.25));
        CHECK(normal(lamp).y == -1.0f);
        CHECK(radiance == Rgb{17, 13, 8});
        const auto& balls = std::get<std::vector<Sphere>>(world.shapes());
        REQUIRE(balls.size() == 2);
        CHECK(balls[0].center == Vec3{-0.42f, 0.38f, -0.3f});
        CHECK(balls[1].center == Vec3{0.42f, 0.38f, 0.3f});
        CHECK(balls[0].radius == 0.38f);
        CHECK(balls[1].radius == 0.38f);
        // 33 degrees from top to bottom, seen from (0, 1, 4.4).
        CHECK(room.camera.position == Vec3{0, 1, 4.4f});
        CHECK(room.camera.forward == Vec3{0, 0, -1});
        CHECK(room.camera.half_height == doctest::Approx(0.296213496));
    };
    const auto box = cornell_box();
    check_box(box);
    CHECK(std::get<1>(box.world.materials())[0].reflectance == Rgb{0.95f});
    CHECK(std::get<2>(box.world.materials())[0].index == 1.5f);
    CHECK(is_black(std::get<2>(box.world.materials())[0].absorption));
    const auto matt = matt_cornell_box();
    check_box(matt);
    CHECK(std::get<0>(matt.world.materials())[3].albedo == Rgb{0.2f, 0.35f, 0.7f});
    CHECK(std::get<0>(matt.world.materials())[4].albedo == Rgb{0.7f});
}

TEST_CASE("rooms: a furnace is closed and shines inwards from all its walls") {
    const auto check_furnace = [](const auto& room) {
        int missed = 0, dark = 0;
        for (int i = 0; i < 500; ++i) {
            const float z = float(2 * i + 1) / 500 - 1, phi = 2.4f * float(i);
            const float r = std::sqrt(1 - z * z);
            const Ray ray{.origin{0.1f, -0.2f, 0.3f},
                          .direction{r * std::cos(phi), r * std::sin(phi), z}};
            const auto hit = closest_hit(room.world, ray);
            missed += !hit;
            if (hit) dark += !vertex_at(room.world, ray, *hit).emits();
        }
        CHECK(missed == 0);
        CHECK(dark == 0);
        CHECK(room.camera.position == Vec3{0.3f, -0.2f, 0.5f});
        CHECK(room.camera.half_height == doctest::Approx(1).epsilon(1e-6));
    };
    check_furnace(sphere_furnace(Rgb{1}, Rgb{0.5f}));
    check_furnace(box_furnace(Rgb{1}, Rgb{0.5f}));
}

TEST_CASE("rooms: both renderers find the same light") {
    SUBCASE("final room") {
        check_both_renderers_agree(final_room(), 16, 0.1f);
    }
    SUBCASE("all materials") {
        check_both_renderers_agree(all_materials_room(), 16, 0.1f);
    }
    SUBCASE("four glass balls") {
        check_both_renderers_agree(four_glass_room(), 16, 0.1f);
    }
    SUBCASE("Cornell box") {
        check_both_renderers_agree(cornell_box(), 16, 0.02f);
    }
}

TEST_CASE("rooms: a furnace emits L / (1 - a) in every direction") {
    const auto check_furnace = [](const Means& found, const Rgb& exact) {
        Means expected;
        for (int c = 0; c < 3; ++c) expected[std::size_t(c)].add(double(exact[c]));
        check_equal(expected, found);
    };
    const Rgb emission{0.5f, 1, 2};
    const Rgb albedo{0.2f, 0.5f, 0.8f};
    const Rgb exact = emission / (Rgb{1} - albedo);
    CHECK(exact.x == doctest::Approx(0.625));
    CHECK(exact.z == doctest::Approx(10));
    SUBCASE("sphere, path tracing") {
        check_furnace(path_means(sphere_furnace(emission, albedo), 16), exact);
    }
    SUBCASE("sphere, photon mapping") {
        check_furnace(photon_means(sphere_furnace(emission, albedo), 16, 0.1f), exact);
    }
    SUBCASE("box, path tracing") {
        check_furnace(path_means(box_furnace(emission, albedo), 16), exact);
    }
}
