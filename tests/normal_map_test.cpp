/// \file normal_map_test.cpp
/// \brief Normals from a picture, on shapes whose coordinates lie any way.

#include "ljus/materials/normal_map.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "ljus/accel/instances.hpp"
#include "ljus/inspect/scene_remarks.hpp"
#include "ljus/ljus.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/scene/make_scene.hpp"
#include "ljus/scenes/mesh_formulas.hpp"
#include "support/bsdf_checks.hpp"
#include "support/draws.hpp"

using namespace ljus;
using ljus_test::Draws, ljus_test::refusal;

namespace {

using Mapped = Textured<Lambertian, NormalMap>;

/// White, with one normal everywhere.
Mapped tilted(const Vec3& normal, const UvMap& map = {}) {
    const Rgb color = 0.5f * normal + 0.5f;
    return {{.albedo = Rgb{1}},
            {.picture{.image = make_image(1, 1, color), .map = map}}};
}

/// A floor, seen from above: u goes along x, v along -z.
const Quad floor_quad{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}};

MeshData floor_mesh(const Vec2& u, const Vec2& v) {
    MeshData data{.triangles{{0, 1, 2}, {0, 2, 3}}};
    for (const Vec2 at : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}) {
        data.positions.push_back({2 * at.x - 1, 0, 1 - 2 * at.y});
        data.uv.push_back(at.x * u + at.y * v);
    }
    return data;
}

/// The vertex of a ray straight down.
template <typename G, typename M>
Vertex seen(const G& shape, const M& material, bool inside_out = false) {
    const World world(make_scene(placed(shape, material, Rgb{0}, inside_out)));
    const Ray down{.origin{0.3f, 3, 0.2f}, .direction{0, -1, 0}};
    const auto hit = closest_hit(world, down);
    REQUIRE(hit);
    return vertex_at(world, down, *hit);
}

void check_near(const Vec3& a, const Vec3& b) {
    CAPTURE(a.x);
    CAPTURE(a.y);
    CAPTURE(a.z);
    CHECK(glm::distance(a, b) < 1e-6f);
}

} // namespace

TEST_CASE("normal map: a flat one gives the bytes of none") {
    const auto picture = [](const auto& shape, const auto& material) {
        const World world(make_scene(
            placed(shape, material),
            placed(Quad{{-1, 2, -1}, {0.5f, 0, 0}, {0, 0, 0.5f}}, material, Rgb{9})));
        const auto camera = look_at({.position{0, 2, 3}, .target{0, 0, 0}});
        return render(PathTracer(world), camera,
                      {.width = 16, .height = 16, .samples = 8})
            .image;
    };
    const Mapped flat = tilted({0, 0, 1}, {.scale{3, -7}, .offset{0.3f, 0.1f}});
    const auto same = [&](const auto& shape) {
        const Image a = picture(shape, flat), b = picture(shape, flat.base);
        CHECK(a.pixels == b.pixels);
    };
    same(floor_quad);
    same(Mesh(floor_mesh({1, 2}, {0, 3})));
    same(Mesh(icosphere(Sphere{.radius = 0.8f}, 1))); // smooth, without uv
}

TEST_CASE("normal map: red goes along u and green along v, however they lie") {
    const Vec3 n = glm::normalize(Vec3{0.3f, 0.2f, 0.8f});
    const Vec3 right{n.x, n.z, -n.y}; // u along x, v along -z
    check_near(seen(floor_quad, tilted(n)).frame.normal, right);
    check_near(
        seen(Triangle{{-4, 0, 4}, {9, 0, 4}, {-4, 0, -9}}, tilted(n)).frame.normal,
        right);
    // Of any length but 0; the picture is not trusted to be of unit length.
    check_near(seen(floor_quad, tilted(0.5f * n)).frame.normal, right);
    const auto of_mesh = [&](const Vec2& u, const Vec2& v) {
        return seen(Mesh(floor_mesh(u, v)), tilted(n)).frame.normal;
    };
    check_near(of_mesh({1, 0}, {0, 1}), right);
    check_near(of_mesh({5, 0}, {0, 0.1f}), right);
    // A quarter turn: u goes along -z, v along -x.
    check_near(of_mesh({0, -1}, {1, 0}), {-n.y, n.z, -n.x});
    // Mirrored: u goes along -x.
    check_near(of_mesh({-1, 0}, {0, 1}), {-n.x, n.z, -n.y});
    // Without area in u and v: the shape's own normal.
    check_near(of_mesh({1, 0}, {1, 0}), {0, 1, 0});

    // Inside out and from behind: the dents are the same, seen from the other side.
    const Vertex turned = seen(floor_quad, tilted(n), true);
    check_near(turned.frame.normal, -right);
    CHECK(turned.wo.z < 0);
    CHECK(turned.smooth);

    // A map that turns the picture by a quarter, and one that mirrors it: as a mesh
    // whose coordinates are so.
    check_near(seen(floor_quad, tilted(n, {.turn{0, 1}})).frame.normal,
               of_mesh({0, 1}, {-1, 0}));
    check_near(seen(floor_quad, tilted(n, {.scale{-2, 3}})).frame.normal,
               of_mesh({-2, 0}, {0, 3}));
    check_near(
        seen(floor_quad, tilted(n, {.scale{-1, 1}, .turn{0.6f, 0.8f}})).frame.normal,
        of_mesh({-0.6f, -0.8f}, {-0.8f, 0.6f}));
}

TEST_CASE("normal map: a mesh's tangents are the derivatives by u and v") {
    Draws draws;
    const auto any = [&](float far) {
        return Vec3{draws.between(-far, far), draws.between(-far, far),
                    draws.between(-far, far)};
    };
    for (int i = 0; i < 200; ++i) {
        // Points of a plane p + u a + v b at three places (u, v).
        const Vec3 p = any(3), a = any(1), b = any(1);
        MeshData data{.triangles{{0, 1, 2}}};
        for (int k = 0; k < 3; ++k) {
            data.uv.push_back({draws.between(-9.0f, 9.0f), draws.between(-9.0f, 9.0f)});
            data.positions.push_back(p + data.uv.back().x * a + data.uv.back().y * b);
        }
        const Mesh mesh(data);
        const auto [du, dv] = texture_tangents(mesh, ShapeHitT<float>{});
        // Slivers in (u, v) magnify the rounding of the positions.
        const Vec2 e = data.uv[1] - data.uv[0], f = data.uv[2] - data.uv[0];
        const float slack = 1e-4f * (1 + 100 / std::abs(e.x * f.y - e.y * f.x));
        CHECK(glm::distance(du, a) < slack);
        CHECK(glm::distance(dv, b) < slack);
        Affine map(1.0f);
        for (int k = 0; k < 4; ++k) map[k] += any(0.3f);
        const auto [mu, mv] = texture_tangents(Instance(mesh, map), ShapeHitT<float>{});
        CHECK(glm::distance(mu, transform_vector(map, du)) < 1e-5f);
        CHECK(glm::distance(mv, transform_vector(map, dv)) < 1e-5f);
    }
}

TEST_CASE("normal map: a tilted normal is lit as a plane tilted so") {
    // By the cosine to a sun, for a normal that leans by 0.4 towards +x.
    const float lean = 0.4f;
    const Mapped mapped = tilted({std::sin(lean), 0, std::cos(lean)});
    for (const float sun : {-0.6f, 0.0f, 0.5f, 1.0f}) {
        const Vec3 from{std::sin(sun), std::cos(sun), 0};
        const World world(
            make_scene(placed(floor_quad, mapped),
                       SunLight{.direction = -from, .irradiance = Rgb{2}}));
        const Ray down{.origin{0.3f, 3, 0.2f}, .direction{0, -1, 0}};
        const Vertex vertex = vertex_at(world, down, *closest_hit(world, down));
        Counts counts;
        const Rgb light = visit_material_at(world, vertex, [&](const auto& m) {
            return direct_light(world, 0, vertex, m, Vec2{0.5f}, MisT<float>{}, counts);
        });
        CHECK(
            light.x ==
            doctest::Approx(2 * std::cos(sun - lean) / std::numbers::pi).epsilon(1e-5));
    }
}

TEST_CASE("normal map: a white furnace loses what chapter 29 states") {
    // (1 - cos d)/2 of the light goes below the plane. 400000 paths of one bounce, each
    // 0 or 1 with the probability p of being lost: 5 standard deviations, 6e-7.
    const float lean = 0.7f;
    const World world(make_scene(
        placed(floor_quad, tilted({0, std::sin(lean), std::cos(lean)})),
        placed(Sphere{.radius = 90}, Lambertian{.albedo = Rgb{0}}, Rgb{1}, true)));
    const Ray down{.origin{0.3f, 3, 0.2f}, .direction{0, -1, 0}};
    const Vertex vertex = vertex_at(world, down, *closest_hit(world, down));
    CHECK(vertex.smooth);
    auto stream = random_stream(45, Pass::user, 0, 0);
    double sum = 0;
    constexpr int count = 400000;
    for (int i = 0; i < count; ++i)
        if (const auto next = scatter(vertex, Lambertian{.albedo = Rgb{1}},
                                      next_3d<float>(stream), Transport::radiance))
            sum += double(next->sample.weight.x);
    const double lost = (1 - std::cos(double(lean))) / 2;
    CHECK(std::abs(1 - sum / count - lost) < 5 * std::sqrt(lost * (1 - lost) / count));
}

TEST_CASE("normal map: photons land with the cosine of the mapped normal") {
    const Vec3 n = glm::normalize(Vec3{-0.5f, 0, 1});
    const World world(make_scene(placed(floor_quad, tilted(n)),
                                 PointLight{.position{0, 1, 0}, .intensity = Rgb{1}}));
    constexpr int count = 4000;
    const auto traced = trace_photons(world, MapType::general,
                                      {.photons = count, .shadow_photons = false});
    CHECK(traced.photons.size() > 500);
    for (const Photon& photon : traced.photons) {
        const double factor = double(glm::dot(photon.direction, Vec3{n.x, n.z, 0})) /
                              double(photon.direction.y);
        CHECK(photon.flux.x ==
              doctest::Approx(4 * std::numbers::pi / count * factor).epsilon(1e-4));
    }
}

TEST_CASE("normal map: that photons lose light between them is said") {
    const auto said = [](const Vec3& normal, IndirectLight indirect) {
        const World world(
            make_scene(placed(floor_quad, tilted(normal)),
                       PointLight{.position{0, 1, 0}, .intensity = Rgb{1}}));
        const PhotonMapper mapper(world,
                                  {.indirect = indirect, .general{.photons = 100}});
        return mapper_remarks(mapper).find("1 object(s) have normal maps") !=
               std::string::npos;
    };
    CHECK(said({0.6f, 0, 0.8f}, IndirectLight::photons));
    CHECK(said({0.6f, 0, 0.8f}, IndirectLight::map));
    CHECK_FALSE(said({0.6f, 0, 0.8f}, IndirectLight::rays));
    CHECK_FALSE(said({0, 0, 1}, IndirectLight::photons));
}

TEST_CASE("normal map: what faces away is not black, and smooth normals are the base") {
    // The mapped normal lies below the plane, or is 0: the plane's own counts.
    for (const Vec3 n : {Vec3{0.9f, 0, -0.3f}, Vec3{0, 0.5f, 0}, Vec3{0.9f, 0, 0}}) {
        const Vertex vertex = seen(floor_quad, tilted(n));
        if (n.z != 0) check_near(vertex.frame.normal, {0, 1, 0});
        CHECK(std::isfinite(vertex.frame.normal.x));
        CHECK(vertex.wo.z > 0);
    }
    // Seen so flat that the eye is in front of the normal below the plane.
    const World below(make_scene(placed(floor_quad, tilted({0.9f, 0, -0.3f}))));
    const Ray grazing{.origin{9, 1, 0}, .direction = glm::normalize(Vec3{-9, -1, 0})};
    check_near(vertex_at(below, grazing, *closest_hit(below, grazing)).frame.normal,
               {0, 1, 0});
    // Seen from where the mapped normal faces away: as for all shading normals.
    const World world(make_scene(placed(floor_quad, tilted({0.8f, 0, 0.6f}))));
    const Ray flat_ray{.origin{-9, 3, 0}, .direction = glm::normalize(Vec3{9, -3, 0})};
    const Vertex vertex = vertex_at(world, flat_ray, *closest_hit(world, flat_ray));
    CHECK(vertex.turned);
    check_near(vertex.frame.normal, {0, 1, 0});

    // On a smooth mesh the map turns the interpolated normal.
    MeshData data = floor_mesh({1, 0}, {0, 1});
    const Vec3 smooth = glm::normalize(Vec3{0.2f, 1, 0});
    data.normals.assign(4, smooth);
    const Vec3 n = glm::normalize(Vec3{0.3f, 0, 1});
    const Vec3 along = glm::normalize(Vec3{1, 0, 0} - smooth.x * smooth);
    check_near(seen(Mesh(data), tilted(n)).frame.normal, n.x * along + n.z * smooth);
}

TEST_CASE("normal map: textures over it keep it, and shapes without tangents refuse") {
    const Vec3 n = glm::normalize(Vec3{0.3f, 0.2f, 0.8f});
    const Textured<Mapped, Checker> board{tilted(n), {}};
    static_assert(NormalMapped<Mapped> && !NormalMapped<Lambertian>);
    static_assert(!NormalMapped<Textured<Lambertian, Checker>>);
    check_near(seen(floor_quad, board).frame.normal, {n.x, n.z, -n.y});
    Scene<Shapes<Sphere, Quad>, Materials<Mapped, Lambertian>> scene;
    const auto grey = scene.add(Lambertian{}), dented = scene.add(tilted(n));
    scene.add(Sphere{.radius = 1}, grey);
    scene.add(floor_quad, dented);
    CHECK_NOTHROW(World(std::move(scene)));
    CHECK_THROWS_WITH(
        World(make_scene(placed(Sphere{.radius = 1}, tilted(n)))),
        "a shape of the type SphereT<float> has a normal map, but no "
        "texture_tangents() in which its normals would be; meshes, quads and "
        "triangles have them.");
    Mapped wrong = tilted(n);
    pixel(wrong.texture.picture.image, 0, 0).x = 2;
    CHECK(refusal(wrong).find("picture_texture.image, pixel (0, 0)") == 0);
}
