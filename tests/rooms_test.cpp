#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scenes/cornell_box.hpp"
#include "ljus/scenes/furnaces.hpp"
#include "ljus/scenes/report_rooms.hpp"

using namespace ljus;

namespace {

constexpr int seeds = 16;

// The mean radiance of a small picture of a room, one value a seed.
struct Means {
    std::array<glm::dvec3, seeds> of_seed{};

    [[nodiscard]] glm::dvec3 mean() const {
        glm::dvec3 sum{0};
        for (const glm::dvec3& m : of_seed) sum += m;
        return sum / double(seeds);
    }

    // The squared standard error of mean().
    [[nodiscard]] glm::dvec3 error2() const {
        glm::dvec3 sum{0};
        for (const glm::dvec3& m : of_seed) sum += (m - mean()) * (m - mean());
        return sum / double(seeds - 1) / double(seeds);
    }
};

template <typename MakeRenderer>
Means means(const Camera& camera, int rays, const MakeRenderer& with_renderer) {
    Means all;
    for (std::uint64_t seed = 0; seed < seeds; ++seed)
        with_renderer(seed + 1, [&](const auto& renderer) {
            const auto rendered =
                render(renderer, camera,
                       {.width = 16, .height = 16, .samples = rays, .seed = seed + 1});
            CHECK(rendered.counts.rejected == 0);
            glm::dvec3 sum{0};
            for (const Rgb& c : rendered.image.pixels) {
                REQUIRE(is_finite(c));
                sum += glm::dvec3(c);
            }
            all.of_seed[seed] = sum / 256.0;
        });
    return all;
}

template <typename Scene>
Means path_means(const Room<Scene>& room, int rays) {
    return means(room.camera, rays, [&](std::uint64_t, const auto& use) {
        use(make_path_tracer(room.scene));
    });
}

template <typename Scene>
Means photon_means(const Room<Scene>& room, int rays, float radius) {
    return means(room.camera, rays, [&](std::uint64_t seed, const auto& use) {
        const PhotonMappingSettings settings{
            .caustics = {.photons = 10'000, .seed = seed},
            .caustics_estimate = {.radius = radius}};
        const auto maps = make_photon_maps(room.scene, settings);
        use(make_photon_mapper(room.scene, maps, settings));
    });
}

// Two means of 16 seeds each: Student's t with at least 15 degrees of freedom is beyond
// 5 by chance in 0.00016 of all cases. With the 24 comparisons of this file, one in
// 260 choices of the seeds would give a false alarm; the seeds are fixed.
void check_equal(const Means& a, const Means& b) {
    for (int channel = 0; channel < 3; ++channel) {
        const double difference = std::abs(a.mean()[channel] - b.mean()[channel]);
        const double error = std::sqrt(a.error2()[channel] + b.error2()[channel]);
        CAPTURE(channel);
        CAPTURE(a.mean()[channel]);
        CAPTURE(b.mean()[channel]);
        CAPTURE(error);
        CHECK(difference <= 5 * error);
        CHECK(error < 0.025 * a.mean()[channel]); // or it would say nothing
    }
}

template <typename Scene>
void check_both_renderers_agree(const Room<Scene>& room, int rays, float radius) {
    check_equal(path_means(room, rays), photon_means(room, rays, radius));
}

// How many quads, spheres and triangles, which is the order of the report's types.
template <typename Scene>
std::array<std::size_t, 3> counts_of(const Scene& scene) {
    return {scene.objects[0].size(), scene.objects[1].size(), scene.objects[2].size()};
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
    CHECK(counts_of(room.scene) == std::array<std::size_t, 3>{8, 8, 6});
    REQUIRE(room.scene.lights.size() == 2);
    const SceneNeeds found = needs(room.scene);
    CHECK(found.specular == 5);
    CHECK(found.diffuse == 8 + 6 + 3);
    // Areas 4 and 1, the second one yellowish.
    const Rgb big = room.scene.lights[0].flux;
    const Rgb small = room.scene.lights[1].flux;
    CHECK(big.x == doctest::Approx(4 * double(small.x)));
    CHECK(small.z == doctest::Approx(0.65 * double(small.x)));
    CHECK(big.x == big.z);
}

TEST_CASE("rooms: the other rooms of the report have theirs") {
    const auto all = all_materials_room();
    CHECK(counts_of(all.scene) == std::array<std::size_t, 3>{7, 6, 6});
    CHECK(all.scene.lights.size() == 1);
    CHECK(needs(all.scene).specular == 3);

    const auto glass = four_glass_room();
    CHECK(counts_of(glass.scene) == std::array<std::size_t, 3>{7, 4, 2});
    CHECK(glass.scene.lights.size() == 1);
    CHECK(needs(glass.scene).specular == 4);
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
    const auto& triangles = std::get<2>(room.scene.shapes);
    constexpr std::array<Vec3, 4> stored{
        Vec3{-2.8036f, 1.15f, 1.63f}, Vec3{0, 1.14f, -3.26f},
        Vec3{2.8036f, 1.15f, 1.63f}, Vec3{0, -3.44f, 0}};
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(glm::distance(normal(triangles[2 + i]), glm::normalize(stored[i])) <
              0.01f);
}

TEST_CASE("rooms: lamps shine downwards and reflect nothing") {
    const auto room = final_room();
    for (const Light& light : room.scene.lights) {
        REQUIRE(light.object);
        const auto& quad = std::get<0>(room.scene.shapes)[light.object->index];
        CHECK(normal(quad).z == -1.0f);
        CHECK(quad.corner.z < 5.0f);
        const auto object = room.scene.object(*light.object);
        CHECK(room.scene.visit_material(object.material, [](const auto& m) {
            return is_black(evaluate(m, Vec3{0, 0, 1}, Vec3{0, 0, 1}));
        }));
    }
}

TEST_CASE("rooms: coloured glass leaves the square of its colour in the middle") {
    const auto room = final_room();
    const auto& glasses = std::get<1>(room.scene.materials);
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
    const auto& mixtures = std::get<3>(room.scene.materials);
    REQUIRE(mixtures.size() == 1);
    const auto share = detail::mixture_shares(mixtures[0], Vec3{0, 0, 1}, Lobes::all);
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
        expected.of_seed.fill(glm::dvec3(exact));
        check_equal(expected, found);
    };
    const Rgb emission{0.5f, 1, 2};
    const Rgb albedo{0.2f, 0.5f, 0.8f};
    const Rgb exact = detail::furnace_radiance(emission, albedo);
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
