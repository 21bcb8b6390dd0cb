#include "ljus/accel/instances.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "ljus/geometry/moving.hpp"
#include "ljus/ljus.hpp"
#include "ljus/math/field_hash.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/scene/make_scene.hpp"
#include "ljus/scenes/mesh_formulas.hpp"
#include "support/mean.hpp"
#include "support/numbers.hpp"
#include "support/refusal.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

template <typename T>
using Positions = std::vector<Vec3T<T>>;

/// A torus with a wide tube.
template <typename T>
MeshDataT<T> ring() {
    return torus(Vec3T<T>(T(0.2), T(-0.1), T(0.3)), T(1), T(0.4), 24, 12);
}

/// A turn around an axis, by Rodrigues' formula.
Affine turn(const glm::dvec3& axis, double angle) {
    const auto turned = [&](const glm::dvec3& v) {
        return Vec3(std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) +
                    (1 - std::cos(angle)) * glm::dot(axis, v) * axis);
    };
    Affine map(1.0f);
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 v(0);
        v[i] = 1;
        map[i] = turned(v);
    }
    return map;
}

/// The product of two maps: `first`, then `second`.
Affine then(const Affine& first, const Affine& second) {
    Affine both;
    for (int i = 0; i < 3; ++i) both[i] = transform_vector(second, first[i]);
    both[3] = transform_point(second, first[3]);
    return both;
}

Affine stretch(const Vec3& by) {
    Affine map(1.0f);
    for (int i = 0; i < 3; ++i) map[i] *= by[i];
    return map;
}

/// A map with any turns, factors of 10^-spread to 10^spread, mirrored or not.
Affine any_map(Numbers& n, double spread, double far) {
    const auto factor = [&] { return float(n.power(-spread, spread)); };
    const Vec3 by{factor(), factor(), float(n.sign()) * factor()};
    Affine map = then(then(turn(n.direction(), n.between(0, 6)), stretch(by)),
                      turn(n.direction(), n.between(0, 6)));
    map[3] = Vec3(n.point(far));
    return map;
}

/// The mesh with its vertices mapped, in double, and turned over if the map mirrors.
MeshDataT<double> copied(const MeshDataT<double>& data, const Affine& place) {
    const glm::dmat4x3 map(place);
    const glm::dmat3 linear(map);
    MeshDataT<double> copy = data;
    for (auto& p : copy.positions) p = map * glm::dvec4(p, 1);
    // Not of unit length: so their mean on a triangle is mapped as any normal.
    for (auto& n : copy.normals) n = glm::transpose(glm::inverse(linear)) * n;
    if (glm::determinant(linear) < 0)
        for (auto& corner : copy.triangles) std::swap(corner[1], corner[2]);
    return copy;
}

} // namespace

TEST_CASE("instances: in its own place a mesh is itself, bit for bit") {
    static_assert(Samplable<Instance> && Samplable<InstanceT<double>>);
    static_assert(Movable<Instance>);
    const Mesh mesh(ring<float>());
    const Instance same(mesh);
    Numbers n{3};
    int hits = 0, other = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 from = n.point(3);
        const Ray ray{.origin = Vec3(from), .direction = Vec3(n.point(1.3) - from)};
        const auto a = intersect(ray, mesh), b = intersect(ray, same);
        other += meets(ray, same) == a.has_value() ? 0 : 1;
        other += a.has_value() == b.has_value() ? 0 : 1;
        if (!a || !b) continue;
        ++hits;
        other += std::memcmp(&*a, &*b, sizeof *a) == 0 ? 0 : 1;
        const SurfacePoint p = surface_point(mesh, ray, *a);
        const SurfacePoint q = surface_point(same, ray, *b);
        other += p.position == q.position && p.normal == q.normal ? 0 : 1;
        const Vec3 s = shading_normal(mesh, *a, p.normal);
        other += glm::distance(s, shading_normal(same, *b, q.normal)) < 2e-7f ? 0 : 1;
    }
    CHECK(other == 0);
    CHECK(hits > 500);
    CHECK(area(same) == area(mesh));
    CHECK(area_sums(same).empty()); // those of the mesh serve
}

TEST_CASE("instances: a map of a mesh is the mesh of the mapped vertices") {
    const MeshDataT<double> data = ring<double>();
    const MeshT<double> mesh(data);
    Numbers n{11};
    int mirrored = 0;
    for (int k = 0; k < 24; ++k) {
        const Affine map = any_map(n, 1, 5);
        const InstanceT<double> instance(mesh, glm::dmat4x3(map));
        const MeshT<double> copy(copied(data, map));
        const bool mirrors = determinant_of(map) < 0;
        mirrored += mirrors ? 1 : 0;
        CAPTURE(k);
        CHECK(area(instance) == doctest::Approx(area(copy)).epsilon(1e-12));

        const SphereT<double> around = bounding_sphere(copy);
        int hits = 0, other = 0, far_t = 0, far_point = 0, far_uv = 0, far_normal = 0;
        int far_shading = 0, above = 0, turned = 0;
        for (int i = 0; i < 1000; ++i) {
            const auto from = around.center + 3 * around.radius * n.direction();
            const auto vertex = [&] {
                return copy.data().positions[std::size_t(n.below(288))];
            };
            const auto to =
                glm::mix(glm::mix(vertex(), vertex(), n.next()), vertex(), n.next());
            // Directions are of any length.
            const RayT<double> ray{.origin = from,
                                   .direction = n.power(-3, 3) * (to - from)};
            const auto a = intersect(ray, copy), b = intersect(ray, instance);
            const bool same = a && b && a->part == b->part;
            other += !same && (a || b); // at a silhouette
            if (!same) continue;
            ++hits;
            const auto p = surface_point(copy, ray, *a);
            const auto q = surface_point(instance, ray, *b);
            far_t += std::abs(a->t - b->t) > 1e-9 * a->t;
            far_point += glm::distance(p.position, q.position) > 1e-9 * around.radius;
            far_uv += std::abs(a->u - (mirrors ? b->v : b->u)) > 1e-9;
            far_normal += glm::distance(p.normal, q.normal) > 1e-9;
            const auto s = shading_normal(copy, *a, p.normal);
            const auto t = shading_normal(instance, *b, q.normal);
            far_shading += glm::distance(s, t) > 1e-9;
            // The point is on the triangle's plane within the bound of its error.
            const TriangleT<double> triangle = instance.triangle(b->part);
            const double height = glm::dot(q.normal, q.position - triangle.v1);
            above += std::abs(height) > glm::dot(glm::abs(q.normal), q.error);
            turned += glm::dot(normal(triangle), q.normal) < 1 - 1e-9;
        }
        CHECK(hits > 500);
        CHECK(other <= 2);
        CHECK(far_t == 0);
        CHECK(far_point == 0);
        CHECK(far_uv == 0);
        CHECK(far_normal == 0);
        CHECK(far_shading == 0);
        CHECK(above == 0);
        CHECK(turned == 0);
    }
    CHECK(mirrored > 6);
    CHECK(mirrored < 18);
}

TEST_CASE("instances: a box and a sphere contain all vertices, and are tight") {
    const Mesh mesh(ring<float>()), ball(icosphere(Sphere{.radius = 1}, 3));
    Numbers n{5};
    for (int k = 0; k < 100; ++k) {
        const Affine map = any_map(n, 3, k % 2 == 0 ? 0 : 1000);
        const Instance instance(mesh, map);
        const Box box = bounds(instance);
        const Sphere sphere = bounding_sphere(instance);
        bool inside = true;
        glm::dvec3 least(1e30), most(-1e30);
        for (const Vec3& v : mesh.data().positions) {
            const glm::dvec3 p = glm::dmat4x3(map) * glm::dvec4(v, 1);
            least = glm::min(least, p);
            most = glm::max(most, p);
            inside &= glm::distance(p, glm::dvec3(sphere.center)) <= sphere.radius;
        }
        inside &= glm::all(glm::lessThanEqual(glm::dvec3(box.low), least));
        inside &= glm::all(glm::greaterThanEqual(glm::dvec3(box.high), most));
        CHECK(inside);
        if (k % 2 == 1) continue; // far away, rounding is larger than a small ball
        // A turned ball has the box of a ball, and the sphere of its longest axis.
        const Box of_ball = bounds(Instance(ball, map));
        const glm::dmat3 rows = glm::transpose(glm::dmat3(glm::dmat4x3(map)));
        for (int i = 0; i < 3; ++i)
            CHECK(double(of_ball.high[i] - of_ball.low[i]) ==
                  doctest::Approx(2 * glm::length(rows[i])).epsilon(1e-3));
    }
    const auto turned = then(stretch({1, 3, 0.1f}), turn({0.6, 0, 0.8}, 1));
    CHECK(bounding_sphere(Instance(ball, turned)).radius == doctest::Approx(3));
    CHECK(bounds(Instance(mesh, stretch({2, 3, 4}))).high.y ==
          doctest::Approx(3 * bounds(mesh).high.y));
}

// A ray that leaves a convex surface meets it no more, however it is placed.
TEST_CASE("instances: a surface does not shadow itself") {
    const auto data = icosphere(Sphere{.center{0.1f, 0.2f, 0.3f}, .radius = 1}, 3);
    const Mesh ball(data);
    Numbers n{23};
    const auto maps = [&](int k) -> Affine {
        Affine map = any_map(n, k % 3 == 0 ? 0 : 2, 1);
        if (k % 5 == 4) map = then(stretch({1, 1e-4f, 1}), map);
        if (k % 4 == 1) map = then(map, stretch(Vec3(1e-6f)));
        if (k % 4 == 2) map = then(map, stretch(Vec3(1e6f)));
        if (k % 4 == 3) map[3] = Vec3(n.point(1000));
        return map;
    };
    int met = 0, entered = 0, shadowed = 0, rays = 0;
    for (int k = 0; k < 60; ++k) {
        const Instance instance(ball, maps(k));
        const auto sums = area_sums(instance);
        const Sphere around = bounding_sphere(instance);
        for (int i = 0; i < 400; ++i) {
            const SurfacePoint p = sample_area(instance, n.square<float>(), sums);
            // Half of the directions are grazing.
            Vec3 d = Vec3(n.direction());
            if (i % 2 == 0)
                d = glm::normalize(d - glm::dot(d, p.normal) * p.normal +
                                   float(n.power(-7, -2)) * p.normal);
            if (glm::dot(d, p.normal) < 0) d = -d;
            met += meets(spawn_ray(p, d), instance) ? 1 : 0;
            // The same point from its other side: the ray crosses the ball.
            const auto through = intersect(spawn_ray(p, -p.normal), instance);
            // A ball that is thinner than the rounding of its place has no other side.
            entered += k % 5 == 4 || (through && through->t > 0) ? 1 : 0;
            // From afar, the side that is seen is not shadowed.
            const Vec3 from = around.center + 50 * around.radius * Vec3(n.direction());
            const auto seen = sample_towards(instance, from, n.square<float>(), sums);
            const Vec3 way = from - seen.point.position;
            if (glm::dot(glm::normalize(way), seen.point.normal) < 0.01f) continue;
            SurfacePoint eye;
            eye.position = from;
            shadowed += meets(spawn_ray_to(eye, seen.point), instance) ? 1 : 0;
            ++rays;
        }
    }
    CHECK(met == 0);
    CHECK(entered == 60 * 400);
    CHECK(shadowed == 0);
    CHECK(rays > 8000);

    // The error says what is rounded at the mesh, and how far a shadow ray may miss.
    const Instance large(ball, stretch(Vec3(1e6f)));
    const auto sums = area_sums(large);
    const auto sum = [](const Vec3& v) {
        return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    };
    constexpr float unit = detail::rounding_bound<float>(1);
    const Vec2 u{0.3f, 0.6f};
    const SurfacePoint p = sample_area(large, u, sums);
    CHECK(sum(p.error) > 5 * unit * sum(p.position));
    const Vec3 from{1e8f, 2e8f, -1e8f};
    const SurfacePoint seen = sample_towards(large, from, u, sums).point;
    CHECK(sum(seen.error) - sum(p.error) > 3 * unit * sum(seen.position - from));
}

TEST_CASE("instances: points are uniform over the area in the scene") {
    const Mesh mesh(icosphere(Sphere{.radius = 1}, 1)); // 80 triangles
    const Affine map = then(then(turn({0, 0.6, 0.8}, 1), stretch({5, 0.2f, 1})),
                            turn({0.6, 0.8, 0}, 2));
    const Instance instance(mesh, map);
    const auto sums = area_sums(instance);
    REQUIRE(sums.size() == mesh.size());
    // Each triangle gets its part of 100000 values of u.x, and each of its quarters a
    // quarter of that: areas by Heron's formula.
    const auto heron = [](const Triangle& t) {
        const double a = glm::distance(glm::dvec3(t.v1), glm::dvec3(t.v2));
        const double b = glm::distance(glm::dvec3(t.v2), glm::dvec3(t.v3));
        const double c = glm::distance(glm::dvec3(t.v3), glm::dvec3(t.v1));
        const double s = (a + b + c) / 2;
        return std::sqrt(s * (s - a) * (s - b) * (s - c));
    };
    double whole = 0;
    for (std::uint32_t i = 0; i < mesh.size(); ++i)
        whole += heron(instance.triangle(i));
    CHECK(area(instance) == doctest::Approx(whole).epsilon(1e-4));
    std::vector<int> found(mesh.size());
    glm::dvec3 mean(0), center(0);
    constexpr int count = 100000;
    Numbers n{2};
    for (int i = 0; i < count; ++i) {
        const Vec2 u{(float(i) + 0.5f) / count, float(n.next())};
        const SurfacePoint p = sample_area(instance, u, sums);
        const auto part = std::uint32_t(detail::choose_interval(sums, u.x).index);
        ++found[part];
        mean += glm::dvec3(p.position) / double(count);
        const Triangle triangle = instance.triangle(part);
        CHECK(std::abs(glm::dot(p.normal, p.position - triangle.v1)) < 1e-5f);
    }
    for (std::uint32_t i = 0; i < mesh.size(); ++i) {
        const Triangle t = instance.triangle(i);
        CHECK(std::abs(found[i] - count * heron(t) / whole) < 2);
        center += heron(t) / whole * glm::dvec3(t.v1 + t.v2 + t.v3) / 3.0;
    }
    CHECK(glm::distance(mean, center) < 0.005);
    const Instance thrice(mesh, then(turn({0, 0.6, 0.8}, 1), stretch({3, -3, 3})));
    CHECK(area(thrice) == doctest::Approx(9 * area(mesh)));
    CHECK(area_sums(thrice).empty());
    // Without the sums the same points.
    CHECK(sample_area(instance, {0.3f, 0.6f}).position ==
          sample_area(instance, {0.3f, 0.6f}, sums).position);
}

// The irradiance at a point below a convex lamp is the sum of Lambert's formula over
// the triangles that face it. The mean of 20000 samples is 5 standard errors off in one
// run of a million.
TEST_CASE("instances: a stretched lamp shines as Lambert's formula says") {
    Scene<Shapes<Instance, Moving<Instance>>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    const auto ball = scene.add(Mesh(icosphere(Sphere{.radius = 1}, 2)));
    Numbers n{8};
    Affine map = any_map(n, 0.7, 0);
    map[2] *= determinant_of(map) < 0 ? 1.0f : -1.0f; // mirrored
    map[3] = {0, 8, 0};
    scene.add(Instance(ball, map), grey, Rgb{1});
    scene.add(Moving<Instance>{Instance(ball, map), {0, 1, 0}}, grey, Rgb{1});
    const World world(std::move(scene));
    CHECK(world.powers()[0].x ==
          doctest::Approx(std::numbers::pi * area(std::get<0>(world.shapes())[0])));

    const Instance& lamp = std::get<0>(world.shapes())[0];
    const Vec3 at{1, 0, 0.5f}, up{0, 1, 0};
    double expected = 0;
    for (std::uint32_t i = 0; i < lamp.size(); ++i)
        expected += std::numbers::pi * form_factor_at(glm::dvec3(at), glm::dvec3(up),
                                                      facet_of(lamp.triangle(i)));
    for (const std::uint32_t light : {0u, 1u}) {
        Mean mean;
        for (int i = 0; i < 20000; ++i) {
            const Vec2 u = n.square<float>();
            const auto sample = sample_light(world, light, at, u, 0.0f);
            mean.add(sample ? double(sample->weight.x * glm::dot(sample->wi, up)) : 0);
        }
        CHECK(std::abs(mean.mean - expected) < 5 * mean.error());
        CHECK(mean.error() < 0.02 * expected);
    }
    CHECK(expected > 0.05);
}

namespace {

using Room =
    Scene<Shapes<Instance, Mesh, Quad, Moving<Instance>>, Materials<Lambertian, Glass>>;

/// A mesh in float whose vertices are mapped.
Mesh copy_of(const MeshData& data, const Affine& place) {
    MeshDataT<double> wide{.triangles = data.triangles};
    for (const Vec3& p : data.positions) wide.positions.emplace_back(p);
    for (const Vec3& n : data.normals) wide.normals.emplace_back(n);
    const MeshDataT<double> copy = copied(wide, place);
    MeshData narrow{.triangles = copy.triangles};
    for (const auto& p : copy.positions) narrow.positions.emplace_back(p);
    for (const auto& n : copy.normals) narrow.normals.emplace_back(n);
    return Mesh(std::move(narrow));
}

/// A floor and a wall, a ball of glass, a grey one, and one that glows, all stretched;
/// by instances of one mesh, or by copies.
World<Room> room_of(bool instances) {
    Room room;
    const auto grey = room.add(Lambertian{.albedo = Rgb{0.5f}});
    const auto glass = room.add(Glass{});
    room.add(Quad{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}}, grey);
    room.add(Quad{{-2, 0, -2}, {4, 0, 0}, {0, 3, 0}}, grey);
    const MeshData data = icosphere(Sphere{.radius = 1}, 3);
    const auto ball = room.add(Mesh(data));
    const auto add = [&](Affine map, const Vec3& to, auto material, Rgb light) {
        map[3] = to;
        if (instances)
            room.add(Instance(ball, map), material, light);
        else
            room.add(copy_of(data, map), material, light);
    };
    const Affine a = then(stretch({0.6f, 0.4f, 0.5f}), turn({0.6, 0, 0.8}, 0.7));
    add(a, {0.5f, 0.7f, 0.4f}, glass, Rgb{0});
    add(stretch({-0.4f, 0.3f, 0.5f}), {-0.8f, 0.3f, 0.2f}, grey, Rgb{0});
    add(then(stretch({0.5f, 0.1f, 0.3f}), turn({0, 1, 0}, 1)), {0, 2.4f, 0.2f}, grey,
        Rgb{4, 3, 2});
    return World(std::move(room));
}

const Camera camera =
    look_at({.position{0, 1.6f, 5}, .target{0, 0.9f, 0}, .vfov_degrees = 40});

RenderSettings picture_with(std::uint64_t seed) {
    return {.width = 32, .height = 24, .samples = 4, .seed = seed, .threads = 1};
}

PhotonMappingSettings photons_with(std::uint64_t seed) {
    PhotonMappingSettings settings;
    settings.caustics = {.photons = 20000, .seed = seed, .threads = 1};
    settings.caustics_estimate = {.radius = 0.04f};
    return settings;
}

double mean_of(const Image& image) {
    double sum = 0;
    for (const Rgb& c : image.pixels) sum += double(c.x + c.y + c.z);
    return sum / double(3 * image.pixels.size());
}

/// The mean difference of two pictures over their mean.
double difference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const Rgb d = glm::abs(a.pixels[i] - b.pixels[i]);
        sum += double(d.x + d.y + d.z);
    }
    return sum / double(3 * a.pixels.size()) / mean_of(a);
}

} // namespace

// Both rooms draw the same numbers, so that their paths differ by rounding alone: where
// one of them just misses what the other one hits, a path goes elsewhere.
TEST_CASE("instances: glass, matt balls and lamps are those of copied meshes") {
    const World<Room> instances = room_of(true), copies = room_of(false);
    for (std::size_t i = 0; i < instances.powers().size(); ++i)
        CHECK(instances.powers()[i].x ==
              doctest::Approx(copies.powers()[i].x).epsilon(1e-5));
    const auto path = picture_with(1);
    CHECK(difference(render(PathTracer(copies), camera, path).image,
                     render(PathTracer(instances), camera, path).image) < 0.02);
    const PhotonMapper by_copies(copies, photons_with(1));
    const PhotonMapper by_instances(instances, photons_with(1));
    CHECK(difference(render(by_copies, camera, path).image,
                     render(by_instances, camera, path).image) < 0.02);
}

// 40 pictures each: the means are 4.5 standard errors apart in one run of 40 000
// (Student's t, 78 degrees of freedom), and one standard error is below 1 %.
TEST_CASE("instances: photon mapping and path tracing agree") {
    const World<Room> room = room_of(true);
    Mean traced, mapped;
    for (std::uint64_t i = 0; i < 40; ++i) {
        const std::uint64_t seed = ljus_test::test_seed(50 + i);
        traced.add(mean_of(render(PathTracer(room), camera, picture_with(seed)).image));
        mapped.add(mean_of(render(PhotonMapper(room, photons_with(seed)), camera,
                                  picture_with(100 + seed))
                               .image));
    }
    const double error = std::hypot(traced.error(), mapped.error());
    MESSAGE("path tracing " << traced.mean << ", photon mapping " << mapped.mean
                            << ", standard error " << error);
    CHECK(std::abs(traced.mean - mapped.mean) < 4.5 * error + 0.005 * traced.mean);
    CHECK(error < 0.01 * traced.mean);
}

TEST_CASE("instances: one moves among others that rest") {
    const MeshData data = ring<float>();
    Room room;
    const auto grey = room.add(Lambertian{});
    const auto mesh = room.add(Mesh(data));
    Numbers n{31};
    for (int i = 0; i < 30; ++i) room.add(Instance(mesh, any_map(n, 0.3, 20)), grey);
    const Affine map = any_map(n, 0.3, 3);
    const Vec3 way{3, 1, -2};
    room.add(Moving<Instance>{Instance(mesh, map), way}, grey);
    const World world(std::move(room));
    const ObjectId mover{3, 0};
    CHECK(detail::lists_moving<World<Room>>);
    int hits = 0, other = 0;
    for (const float time : {0.0f, 0.3f, 1.0f}) {
        Affine there = map;
        there[3] += time * way;
        const Mesh copy = copy_of(data, there);
        for (int i = 0; i < 400; ++i) {
            const glm::dvec3 from = 30.0 * n.direction();
            const glm::dvec3 to = glm::dvec3(there[3]) + n.point(1.5);
            const Ray ray{.origin = Vec3(from),
                          .direction = Vec3(glm::normalize(to - from)),
                          .time = time};
            const auto met = closest_hit(world, ray);
            if (!met || met->object != mover) continue;
            ++hits;
            const auto hit = intersect(ray, copy);
            if (!hit || hit->part != met->at.part) {
                ++other; // at an edge
                continue;
            }
            const Vertex vertex = vertex_at(world, ray, *met);
            const SurfacePoint point = surface_point(copy, ray, *hit);
            CHECK(glm::distance(vertex.point.position, point.position) < 1e-4f);
            CHECK(glm::distance(vertex.point.normal, point.normal) < 1e-4f);
            const Vec3 smooth = shading_normal(copy, *hit, point.normal);
            const Vec3 expected = vertex.turned ? point.normal : smooth;
            CHECK(glm::distance(vertex.frame.normal, expected) < 1e-3f);
            CHECK(occluded(world,
                           spawn_ray_to(SurfacePoint{.position = ray.origin},
                                        SurfacePoint{.position = Vec3(2.0 * to - from)},
                                        time)));
        }
    }
    CHECK(hits > 300);
    CHECK(other < 10);
}

TEST_CASE("instances: a placement takes 200 bytes, whatever the mesh") {
    const MeshData data = torus(Vec3(0), 1.0f, 0.4f, 100, 50); // 10000 triangles
    const Mesh alone(data);
    Scene<Shapes<Instance>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    const auto mesh = scene.add(Mesh(data));
    Numbers n{4};
    for (int i = 0; i < 1000; ++i) scene.add(Instance(mesh, any_map(n, 0, 100)), grey);
    const World world(std::move(scene));
    const auto& placed = std::get<0>(world.shapes());
    for (const Instance& one : placed) CHECK(&one.mesh() == &mesh.get());
    const std::size_t placements =
        world.tree().bytes() +
        1000 * (sizeof(Instance) + sizeof(ObjectT<float>) + sizeof(ObjectId));
    CHECK(sizeof(Instance) <= 200);
    CHECK(placements < 400 * 1000);
    CHECK(1000 * alone.bytes() > 600 * (mesh.get().bytes() + placements));
}

TEST_CASE("instances: the key of a light map is that of the mesh and the place") {
    const Mesh mesh(ring<float>()), other(icosphere(Sphere{}, 1)), same(ring<float>());
    const auto key = [](const auto& shape) {
        detail::FieldHash hash;
        hash.add(shape);
        return hash.value;
    };
    CHECK(key(Instance(mesh)) == key(Instance(same)));
    CHECK(key(Instance(mesh)) != key(Instance(other)));
    CHECK(key(Instance(mesh)) != key(Instance(mesh, stretch({1, 2, 1}))));
    CHECK(key(Moving<Instance>{Instance(mesh), {0, 1, 0}}) !=
          key(Moving<Instance>{Instance(mesh), {0, 2, 0}}));
}

TEST_CASE("instances: one that touches a floor is found as a copy is") {
    // A block of 12 triangles that is stretched, stands on a floor, and is mirrored.
    MeshData block;
    for (int i = 0; i < 8; ++i)
        block.positions.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
    block.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                       {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                       {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    const auto touching = [&](bool instance, float lift) {
        Room room;
        const auto grey = room.add(Lambertian{});
        const auto glass = room.add(Glass{});
        room.add(Quad{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, grey);
        Affine map = stretch({-2, 3, 1});
        map[3].y = lift;
        const auto mesh = room.add(Mesh(block));
        if (instance)
            room.add(Instance(mesh, map), glass);
        else
            room.add(copy_of(block, map), glass);
        const World world(std::move(room));
        const Contacts& contacts = world.contacts();
        if (contacts.pairs.empty()) return std::string("none");
        CHECK(contacts.pairs.size() == 1);
        const auto hit =
            closest_hit(world, Ray{.origin{-1, 2, 0.5f}, .direction{0, -1, 0}});
        REQUIRE(hit);
        return std::string(hit->object.type == 2 ? "floor" : "glass") +
               (contacts.pairs[0].opposed ? " opposed" : " alike");
    };
    CHECK(touching(true, 0) == touching(false, 0));
    CHECK(touching(true, 0) == "floor opposed");
    CHECK(touching(true, 0.1f) == "none");
}

TEST_CASE("instances: what cannot be placed is refused with a sentence") {
    const Mesh mesh(ring<float>());
    const auto refused = [&](const Affine& map) {
        return refusal([&] { (void)Instance(mesh, map); });
    };
    Affine map(1.0f);
    map[2] = map[0] + map[1];
    CHECK(refused(map) == "the determinant of an instance's map is 0; it must be other "
                          "than 0: a mesh without thickness has no inside.");
    map[2] = map[0] + map[1] + Vec3(0, 0, 1e-10f);
    CHECK(refused(map).find("the condition number of an instance's map is") == 0);
    map[2] = map[0] + map[1] + Vec3(0, 0, 1e-4f);
    CHECK(refused(map).empty());
    CHECK(refused(stretch({1, 1e-10f, 1})).empty()); // flat, but not lost in rounding
    map[3].y = std::nanf("");
    CHECK(refused(map) == "column 3 of an instance's map is (0, NaN, 0); it must be "
                          "finite in every component.");

    Scene<Shapes<Instance>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    const auto kept = scene.add(Mesh(ring<float>()));
    scene.add(Instance(kept), grey);
    const char* foreign =
        "An instance refers to a mesh that its scene does not keep; it "
        "must be made by Instance(scene.add(mesh), place).";
    CHECK(refusal([&] { scene.add(Instance(mesh), grey); }) == foreign);
    std::get<0>(scene.shapes)[0] = Instance(mesh); // in place
    CHECK(refusal([&] { World world(std::move(scene)); }) == foreign);
    CHECK(refusal([&] {
              (void)World(make_scene(placed(Instance(mesh), Lambertian{})));
          }) == foreign);
    static_assert(!std::is_copy_constructible_v<decltype(scene)>);
    static_assert(
        std::is_copy_constructible_v<Scene<Shapes<Mesh>, Materials<Lambertian>>>);
    static_assert(!std::is_constructible_v<Instance, Mesh&&>);
}
