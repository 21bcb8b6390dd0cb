#include <doctest/doctest.h>

#include <cstring>

#include "ljus/geometry/shape.hpp"
#include "ljus/geometry/watertight.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scene/make_scene.hpp"
#include "ljus/scenes/mesh_formulas.hpp"
#include "support/mesh_rooms.hpp"
#include "support/numbers.hpp"
#include "support/refusal.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

const Sphere unit_ball{.center{0, 0, 0}, .radius = 1};

MeshData flat(MeshData data) {
    data.normals.clear();
    return data;
}

/// Triangles of any size and place.
MeshData soup(int count, std::uint64_t seed) {
    Numbers numbers{seed};
    MeshData data;
    for (int i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(data.positions.size());
        const auto middle = numbers.point(1);
        const double size = numbers.power(-2, 0);
        for (int k = 0; k < 3; ++k)
            data.positions.emplace_back(middle + numbers.point(size));
        data.triangles.push_back({first, first + 1, first + 2});
    }
    return data;
}

/// What asking the triangles in turn finds.
template <typename Compute>
std::optional<ShapeHitT<float>> by_loop(Ray ray, const MeshData& data) {
    std::optional<ShapeHitT<float>> nearest;
    for (std::uint32_t i = 0; i < data.triangles.size(); ++i) {
        const auto hit = intersect<Compute>(ray, detail::triangle_of(data, i));
        if (!hit || (nearest && !(hit->t < nearest->t))) continue;
        nearest = hit;
        nearest->part = i;
    }
    return nearest;
}

template <typename Compute>
void check_hits(const MeshData& data, double size, const Vec3T<double>& place) {
    const Mesh mesh(data);
    Numbers numbers{17};
    int hits = 0, other = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3T<double> from = place + 2 * size * numbers.point(1);
        const Vec3T<double> to = place + size * numbers.point(1);
        const Ray ray{.origin = Vec3(from),
                      .direction = Vec3(glm::normalize(to - from))};
        const auto a = intersect<Compute>(ray, mesh);
        const auto b = by_loop<Compute>(ray, data);
        hits += b ? 1 : 0;
        const bool same = a.has_value() == b.has_value() &&
                          (!a || (a->t == b->t && a->u == b->u && a->v == b->v &&
                                  a->part == b->part));
        other += same ? 0 : 1;
        other += meets<Compute>(ray, mesh) == b.has_value() ? 0 : 1;
    }
    CHECK(other == 0);
    CHECK(hits > 300);
}

} // namespace

TEST_CASE("mesh: hits are those of its triangles, one by one") {
    static_assert(Shape<Mesh> && Shape<MeshT<double>>);
    for (const auto& data :
         {soup(300, 1), icosphere(unit_ball, 3), torus(Vec3{0}, 0.7f, 0.2f, 20, 10)}) {
        check_hits<void>(data, 1, {0, 0, 0});
        check_hits<double>(data, 1, {0, 0, 0});
        check_hits<Watertight>(data, 1, {0, 0, 0});
    }
    // A mesh of doubles walks the plain tree, which asks every triangle.
    const MeshT<double> ball(icosphere(ljus::SphereT<double>{.radius = 1}, 2));
    Numbers numbers{18};
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
        const Vec3T<double> from = 2.0 * numbers.point(1);
        const ljus::RayT<double> ray{.origin = from,
                                     .direction = glm::normalize(numbers.point(1))};
        const bool hit = intersect(ray, ball).has_value();
        CHECK(meets(ray, ball) == hit);
        hits += hit ? 1 : 0;
    }
    CHECK(hits > 50);
}

TEST_CASE("mesh: of any size and place") {
    for (const float size : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f})
        check_hits<double>(icosphere(Sphere{.center{0, 0, 0}, .radius = size}, 2),
                           double(size), {0, 0, 0});
    const Vec3 far{1e6f, -1e6f, 1e6f};
    check_hits<double>(icosphere(Sphere{.center = far, .radius = 30}, 2), 30, far);
    const MeshData one{.positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                       .triangles{{0, 1, 2}}};
    const auto hit = intersect(Ray{.origin{0.2f, 0.3f, 1}}, Mesh(one));
    REQUIRE(hit);
    CHECK(hit->part == 0);
    CHECK(area(Mesh(one)) == 0.5f);
}

TEST_CASE("mesh: pictures and photons are those of its triangles, to the last bit") {
    const MeshData ring = flat(torus(Vec3{0, 0.4f, 0}, 0.6f, 0.25f, 24, 12));
    MeshRoom whole, parts;
    for (MeshRoom* room : {&whole, &parts}) {
        const auto grey = room->add(Lambertian{.albedo = Rgb{0.7f}});
        const auto black = room->add(Lambertian{.albedo = Rgb{0}});
        room->add(Quad{.corner{-2, 0, 2}, .edge_u{4, 0, 0}, .edge_v{0, 0, -4}}, grey);
        room->add(Quad{.corner{-1, 2, -1}, .edge_u{2, 0, 0}, .edge_v{0, 0, 2}}, black,
                  Rgb{5});
        if (room == &whole) room->add(Mesh(ring), grey);
        for (std::uint32_t i = 0; room == &parts && i < ring.triangles.size(); ++i)
            room->add(detail::triangle_of(ring, i), grey);
    }
    const Camera camera = look_at({.position{0, 1.5f, 3}, .target{0, 0.3f, 0}});
    const RenderSettings picture{.width = 40, .height = 30, .samples = 4};
    const World of_mesh(std::move(whole)), of_parts(std::move(parts));
    const auto a = render(PathTracer(of_mesh), camera, picture).image;
    const auto b = render(PathTracer(of_parts), camera, picture).image;
    CHECK(std::memcmp(a.pixels.data(), b.pixels.data(),
                      a.pixels.size() * sizeof(a.pixels[0])) == 0);
    const PhotonPassSettings pass{.photons = 2000};
    const auto p = trace_photons(of_mesh, MapType::general, pass).photons;
    const auto q = trace_photons(of_parts, MapType::general, pass).photons;
    REQUIRE(p.size() == q.size());
    int other = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        other += p[i].position == q[i].position && p[i].flux == q[i].flux ? 0 : 1;
    CHECK(other == 0);
}

TEST_CASE("mesh: finer triangles come to the sphere") {
    double before = 1;
    for (int cuts = 2; cuts <= 5; ++cuts) {
        const Mesh mesh(icosphere(unit_ball, cuts));
        Numbers numbers{3};
        double worst = 0, worst_normal = 0;
        for (int i = 0; i < 2000; ++i) {
            const Vec3 to(0.8 * numbers.direction());
            const Vec3 from(4.0 * numbers.direction());
            const Ray ray{.origin = from, .direction = glm::normalize(to - from)};
            const auto hit = intersect(ray, mesh);
            if (!hit) continue;
            const auto point = surface_point(mesh, ray, *hit);
            worst = std::max(worst, 1 - double(glm::length(point.position)));
            const Vec3 n = shading_normal(mesh, *hit, point.normal);
            const Vec3 right = glm::normalize(point.position);
            worst_normal = std::max(worst_normal, double(glm::length(n - right)));
            CHECK(glm::length(n) == doctest::Approx(1).epsilon(1e-6));
        }
        // Both errors go with the square of the edge: four times less a cut.
        CHECK(worst < 0.3 * before);
        CHECK(worst_normal < 0.2 * std::sqrt(before) * 2);
        before = worst;
    }
    CHECK(before < 4e-4);
    const Mesh fine(icosphere(unit_ball, 6));
    CHECK(area(fine) == doctest::Approx(area(unit_ball)).epsilon(1e-3));
    CHECK(bounding_sphere(fine).radius == doctest::Approx(1).epsilon(1e-5));
    CHECK(glm::length(bounding_sphere(fine).center) < 1e-5f);
    for (const float place : {-1000.0f, 0.0f, 1000.0f}) {
        const Mesh mesh(icosphere(Sphere{.center = Vec3{place}, .radius = 1}, 2));
        const Sphere ball = bounding_sphere(mesh);
        for (const Vec3& p : mesh.data().positions)
            REQUIRE(glm::distance(glm::dvec3(p), glm::dvec3(ball.center)) <=
                    ball.radius);
    }
}

TEST_CASE("mesh: smooth_normals() finds the normals of a sphere and of a ring") {
    for (MeshData data :
         {icosphere(unit_ball, 4), torus(Vec3{0}, 1.0f, 0.3f, 60, 30)}) {
        const auto right = data.normals;
        data.positions.push_back({9, 9, 9}); // of no triangle
        smooth_normals(data);
        REQUIRE(data.normals.size() == right.size() + 1);
        CHECK(data.normals.back() == Vec3{0});
        for (std::size_t i = 0; i < right.size(); ++i)
            CHECK(glm::dot(data.normals[i], right[i]) > 0.999f);
    }
    // However the sides of a box are cut, a corner's normal is the diagonal.
    MeshData corner{.positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}},
                    .triangles{{0, 4, 1}, {0, 2, 4}, {0, 1, 3}, {0, 3, 2}}};
    smooth_normals(corner);
    CHECK(glm::length(corner.normals[0] + Vec3{std::sqrt(1.0f / 3.0f)}) < 1e-6f);
    // A corner of 120 degrees that looks up, and one of 90 that looks to -y: 4 to 3.
    MeshData blunt{
        .positions{{0, 0, 0}, {1, 0, 0}, {-0.5f, std::sqrt(0.75f), 0}, {0, 0, 1}},
        .triangles{{0, 1, 2}, {0, 1, 3}}};
    for (const bool collapsed : {false, true}) {
        // A triangle without an area has no influence on the normals.
        if (collapsed) blunt.triangles.push_back({0, 0, 1});
        smooth_normals(blunt);
        CHECK(glm::distance(blunt.normals[0], Vec3{0, -0.6f, 0.8f}) < 1e-6f);
        CHECK(blunt.normals[2] == Vec3{0, 0, 1});
    }
    // However narrow a corner is, it has a normal.
    MeshData thin{.positions{{0, 0, 0}, {1, 0, 0}, {1, 1e-3f, 0}},
                  .triangles{{0, 1, 2}}};
    smooth_normals(thin);
    for (const Vec3& normal : thin.normals) CHECK(normal == Vec3{0, 0, 1});
}

TEST_CASE("mesh: points are uniform over its area") {
    // 40 triangles of very different size; a point in each as often as its area says:
    // chi^2 with 39 degrees of freedom, above 73 in one run of 1000.
    const MeshData data = soup(40, 5);
    const Mesh mesh(data);
    Numbers numbers{11};
    constexpr int count = 40000;
    std::vector<double> seen(40);
    glm::dvec3 sum{0}, right{0};
    for (int i = 0; i < count; ++i) {
        const Vec2 u(static_cast<float>(numbers.next()),
                     static_cast<float>(numbers.next()));
        const SurfacePoint point = sample_area(mesh, u);
        sum += glm::dvec3(point.position);
        std::size_t nearest = 0;
        double least = 1e9;
        for (std::size_t k = 0; k < 40; ++k) {
            const Triangle t = detail::triangle_of(data, k);
            const double off =
                std::abs(double(glm::dot(point.position - t.v1, normal(t)))) +
                2 * (1 - double(glm::dot(point.normal, normal(t))));
            if (off < least) nearest = k, least = off;
        }
        seen[nearest] += 1;
    }
    double chi2 = 0, total = 0;
    for (std::size_t k = 0; k < 40; ++k)
        total += double(area(detail::triangle_of(data, k)));
    CHECK(area(mesh) == doctest::Approx(total).epsilon(1e-6));
    for (std::size_t k = 0; k < 40; ++k) {
        const Triangle t = detail::triangle_of(data, k);
        const double share = double(area(t)) / total;
        chi2 += (seen[k] - count * share) * (seen[k] - count * share) / (count * share);
        right += share * glm::dvec3(t.v1 + t.v2 + t.v3) / 3.0;
    }
    CHECK(chi2 < 73);
    CHECK(glm::length(sum / double(count) - right) < 0.02);
    for (const float x : {0.0f, 1.0f})
        CHECK(is_finite(sample_area(mesh, Vec2{x, 0.5f}).position));
}

TEST_CASE("mesh: a lamp of triangles lights as the sphere does") {
    const Mesh lamp(icosphere(Sphere{.center{0, 3, 0}, .radius = 1}, 4));
    const World scene(
        make_scene(placed(lamp, Lambertian{.albedo = Rgb{0}}, Rgb{2}),
                   placed(Quad{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}, Lambertian{})));
    REQUIRE(scene.light_count() == 1);
    CHECK(scene.powers()[0].x ==
          doctest::Approx(2 * std::numbers::pi * 4 * std::numbers::pi).epsilon(5e-3));
    // E = pi L (r/d)^2 right below; half of it comes back over pi.
    const double right = 0.5 * 2 * 1 / 9.0;
    const auto down = [](RandomStream&) {
        return Ray{.origin{0, 1, 0}, .direction{0, -1, 0}};
    };
    const Mean both = mean_radiance(PathTracer(scene), 40000, 1, down);
    CHECK(std::abs(apart(both, right, 4e-3)) < 3);
    const PathTracer no_shadow_rays(scene, {.sample_lights = false});
    const Mean alone = mean_radiance(no_shadow_rays, 40000, 2, down);
    CHECK(std::abs(apart(alone, right, 4e-3)) < 3);
    // Photons carry the same.
    const auto traced = trace_photons(scene, MapType::general, {.photons = 40000});
    double sum = 0;
    for (const Photon& photon : traced.photons) sum += double(photon.flux.x);
    // The lamp is aimed: no photon carries more than eight times the flux that it would
    // have otherwise, and five standard errors are at most 5 sqrt(7 / 40000).
    CHECK(std::abs(double(traced.audit.emitted.x) - double(scene.powers()[0].x)) <
          0.067 * double(scene.powers()[0].x));
    CHECK(sum > 0);
}

TEST_CASE("mesh: in a furnace a smooth mesh loses what its horizons cut off") {
    // A matt convex body in a glowing room: of a cosine lobe around the shading normal
    // the share below the triangle's horizon, (1 - cos d) / 2, has nowhere to go.
    for (const int cuts : {0, 1, 3}) {
        const Mesh mesh(icosphere(unit_ball, cuts));
        const World scene(
            make_scene(placed(mesh, Lambertian{.albedo = Rgb{1}}),
                       placed(Sphere{.center{0, 0, 0}, .radius = 5},
                              Lambertian{.albedo = Rgb{0}}, Rgb{1}, true)));
        Numbers numbers{7};
        Mean lost;
        for (int i = 0; i < 20; ++i) {
            const Ray ray{.origin = Vec3(3.0 * numbers.direction()),
                          .direction = Vec3{0}};
            Ray at = ray;
            at.direction = glm::normalize(Vec3(0.7 * numbers.point(1)) - ray.origin);
            const auto hit = intersect(at, mesh);
            if (!hit) continue;
            const auto point = surface_point(mesh, at, *hit);
            const Vec3 n = shading_normal(mesh, *hit, point.normal);
            const bool turned = glm::dot(n, at.direction) > 0;
            const double right =
                turned ? 1.0 : 0.5 + 0.5 * double(glm::dot(n, point.normal));
            const Mean seen = mean_radiance(PathTracer(scene), 4000, 100u + unsigned(i),
                                            [&](RandomStream&) { return at; });
            CHECK(std::abs(apart(seen, right, 1e-3)) < 4);
            lost.add(1 - right);
        }
        CHECK(lost.mean < (cuts == 0 ? 0.1 : cuts == 1 ? 0.03 : 0.003));
    }
}

TEST_CASE("mesh: mirrors, glass and matt meshes in a furnace are as bright as it is") {
    // No pixel is black, none is NaN, and a mirror loses nothing at all.
    for (const MeshData& data : {icosphere(unit_ball, 0), icosphere(unit_ball, 2),
                                 torus(Vec3{0}, 0.8f, 0.35f, 12, 8)})
        for (const int kind : {0, 1, 2}) {
            MeshRoom room;
            const auto black = room.add(Lambertian{.albedo = Rgb{0}});
            const auto material = kind == 0   ? room.add(Mirror{})
                                  : kind == 1 ? room.add(Glass{.index = 1.5f})
                                              : room.add(Lambertian{.albedo = Rgb{1}});
            room.add(Mesh(data), material);
            room.add(Sphere{.center{0, 0, 0}, .radius = 6}, black, Rgb{1}, true);
            const World world(std::move(room));
            // Without roulette and shadow rays each path brings exactly what it should.
            const PathTracer tracer(world,
                                    {.roulette_depth = 1001, .sample_lights = false});
            const Camera camera = look_at({.position{0, 2, 3}, .target{0, 0, 0}});
            const auto image =
                render(tracer, camera, {.width = 48, .height = 48, .samples = 16})
                    .image;
            double least = 9, most = 0, sum = 0;
            for (const Rgb& pixel : image.pixels) {
                sum += double(pixel.x);
                least = std::min(least, double(pixel.x)); // false for NaN
                most = std::max(most, double(pixel.x));
                CHECK(std::isfinite(pixel.x));
            }
            CAPTURE(kind);
            if (kind == 0) {
                CHECK(least == doctest::Approx(1).epsilon(1e-4));
            } else {
                // Matt meshes lose what the case above says; glass what total
                // reflection catches for ever within coarse smooth triangles: in these
                // pictures, background included, 0.8 % with 20
                // triangles, 0.1 % with 320.
                CHECK(least > 0.4);
                CHECK(sum / double(image.pixels.size()) > (kind == 1 ? 0.985 : 0.9));
            }
            CHECK(most < 1.0001);
        }
}

TEST_CASE("mesh: no light leaks through it") {
    // A lamp within a closed smooth mesh of another matt material: outside all is dark,
    // for camera paths and for photons.
    for (const MeshData& data : {icosphere(unit_ball, 0), icosphere(unit_ball, 2),
                                 torus(Vec3{0}, 1.0f, 0.45f, 10, 6)}) {
        const bool ring = data.triangles.size() == 120;
        MeshRoom room;
        const auto grey = room.add(Lambertian{.albedo = Rgb{0.8f}});
        room.add(Mesh(data), grey);
        room.add(Sphere{.center{ring ? 1.0f : 0.0f, 0, 0}, .radius = 0.1f}, grey,
                 Rgb{100});
        room.add(Sphere{.center{0, 0, 0}, .radius = 5}, grey, Rgb{0}, true);
        const World world(room);
        const Camera camera = look_at({.position{0, 2, 3}, .target{0, 0, 0}});
        const World exact(std::move(room), compute_in<double>);
        const auto image =
            render(PathTracer(exact), camera, {.width = 40, .height = 40, .samples = 8})
                .image;
        double sum = 0;
        for (const Rgb& pixel : image.pixels) sum += double(pixel.x);
        CHECK(sum == 0);
        const auto traced = trace_photons(exact, MapType::general,
                                          {.photons = 5000, .shadow_photons = false});
        int outside = 0;
        for (const Photon& photon : traced.photons)
            outside += glm::length(photon.position) > 2 ? 1 : 0;
        CHECK(outside == 0);
    }
}

// Photons and camera paths are two ways to the same number: what comes from the lamp by
// the mesh to the floor. Each of 6 pairs may be 3.5 standard errors apart: one run of
// 350, were the seeds new.
TEST_CASE("mesh: photons and camera paths agree about coarse smooth meshes") {
    for (const int cuts : {0, 2})
        for (const int kind : {0, 1, 2}) {
            const Mesh mesh(
                icosphere(Sphere{.center{0.3f, 1.3f, 0}, .radius = 1}, cuts));
            const ClosedMeshRoom room =
                kind == 0   ? lamp_below(mesh, Lambertian{.albedo = Rgb{0.8f}})
                : kind == 1 ? lamp_below(mesh, Mirror{.reflectance = Rgb{0.9f}})
                            : lamp_below(mesh, Glass{.index = 1.5f});
            const Mean photons = flux_by_photons(room, 200000, 1);
            const Mean paths = flux_by_paths(room, 400000, 2);
            CAPTURE(cuts);
            CAPTURE(kind);
            CAPTURE(photons.mean);
            CAPTURE(paths.mean);
            CHECK(std::abs(apart(photons, paths)) < 3.5);
        }
}

TEST_CASE("mesh: photons land with the cosine of the shading normal") {
    // One triangle, its normals all turned by 45 degrees: each photon of a lamp 2 above
    // it has the flux that it left with times |w.Ns| / |w.Ng|, and where the normals
    // disagree, below x = -2, there is none.
    const Vec3 ns = glm::normalize(Vec3{-1, 1, 0});
    const Mesh mesh(MeshData{.positions{{-3, 0, 3}, {3, 0, 3}, {0, 0, -3}},
                             .normals{ns, ns, ns},
                             .triangles{{0, 1, 2}}});
    const PointLight light{.position{0, 2, 0}, .intensity = Rgb{1}};
    const World scene(make_scene(placed(mesh, Lambertian{}), light));
    constexpr int count = 20000;
    const auto traced = trace_photons(scene, MapType::general,
                                      {.photons = count, .shadow_photons = false});
    CHECK(traced.photons.size() > 1000);
    const double left = 4 * std::numbers::pi / count;
    double least_x = 9, most_x = -9;
    for (const Photon& photon : traced.photons) {
        const double factor = double(glm::dot(photon.direction, ns)) /
                              double(glm::dot(photon.direction, Vec3{0, 1, 0}));
        REQUIRE(photon.flux.x == doctest::Approx(left * factor).epsilon(1e-4));
        least_x = std::min(least_x, double(photon.position.x));
        most_x = std::max(most_x, double(photon.position.x));
    }
    CHECK(least_x > -2.001);
    CHECK(least_x < -1.8);
    CHECK(most_x > 2.1);
}

TEST_CASE("mesh: the memory of a triangle, its tree included") {
    for (const int cuts : {4, 6}) {
        const Mesh round(icosphere(unit_ball, cuts));
        CHECK(double(round.bytes()) / round.size() < 110);
        const Mesh flat_one(flat(round.data()));
        CHECK(double(flat_one.bytes()) / flat_one.size() < 95);
    }
    const Mesh ring(torus(Vec3{0}, 1.0f, 0.3f, 400, 125)); // 100000 triangles
    CHECK(ring.size() == 100000);
    CHECK(double(ring.bytes()) / ring.size() < 100);
    MeshData apart = flat(ring.data()); // no vertex is shared
    apart.positions.clear();
    for (std::uint32_t i = 0; i < ring.size(); ++i) {
        const Triangle t = ring.triangle(i);
        apart.positions.insert(apart.positions.end(), {t.v1, t.v2, t.v3});
        apart.triangles[i] = {3 * i, 3 * i + 1, 3 * i + 2};
    }
    const Mesh loose(apart);
    CHECK(double(loose.bytes()) / loose.size() < 120);
    // All that it holds, at least: three corners and numbers, an area, and the tree.
    CHECK(loose.bytes() >= loose.size() * (3 * sizeof(Vec3) + 12 + sizeof(double)) +
                               loose.tree().bytes());
    CHECK(loose.tree().bytes() > 30 * std::size_t(loose.size()));
}

TEST_CASE("mesh: what is wrong is said with its place") {
    const MeshData good = icosphere(unit_ball, 0);
    const auto message = [](const MeshData& data) {
        return ljus_test::refusal([&] { const Mesh mesh(data); }, "nothing");
    };
    CHECK(message(good) == "nothing");
    CHECK(message({}) == "the number of a mesh's triangles is 0; it must be at least 1 "
                         "and below 2^32 - 1.");
    MeshData bad = good;
    bad.triangles[7][1] = 12;
    CHECK(message(bad) ==
          "mesh.triangles[7]'s vertex is 12; it must be below the number "
          "of positions, 12.");
    bad = good;
    bad.positions[3].y = std::numeric_limits<float>::quiet_NaN();
    CHECK(message(bad).find("mesh.positions[3] is (") == 0);
    bad = good;
    bad.normals.pop_back();
    CHECK(message(bad) ==
          "the number of a mesh's normals is 11; it must be 0 or that of "
          "its positions, 12.");
    bad = good;
    for (auto& p : bad.positions) p = {1, 2, 3};
    CHECK(message(bad) == "the area of the mesh is 0; it must be above 0 and finite.");
    bad = good;
    bad.uv.resize(3);
    CHECK(message(bad).find("the number of a mesh's texture coordinates is 3; it must "
                            "be 0 or that of its positions, ") == 0);
    bad.uv.assign(bad.positions.size(), Vec2{0});
    bad.uv[1].y = NAN;
    CHECK(message(bad).find("mesh.uv[1] is (0, NaN") == 0);
    bad.uv[1] = {INFINITY, 0};
    CHECK(message(bad).find("mesh.uv[1] is (infinity, 0") == 0);
    bad = good;
    bad.normals[5].z = INFINITY;
    CHECK(message(bad).find("mesh.normals[5] is (") == 0);
    Mesh moved(good);
    const Mesh taken(std::move(moved));
    CHECK_THROWS_AS(check(moved), std::invalid_argument);
    CHECK_NOTHROW(check(taken));
    CHECK_THROWS_AS((void)icosphere(unit_ball, 11), std::invalid_argument);
    CHECK_THROWS_AS((void)torus(Vec3{0}, 1.0f, 0.3f, 2, 5), std::invalid_argument);
    CHECK(ljus_test::refusal([] { (void)torus(Vec3{0}, 1.0f, 0.3f, 5, 20000); }) ==
          "the number of segments is 20000; it must be within [3, 10000].");
}

TEST_CASE("mesh: a number is a triangle's, and the rest of it a place there") {
    // Of areas 1, 2 and 1/2: up to 2/7 of u the first one, up to 6/7 the second.
    const MeshData data{.positions{{0, 0, 0},
                                   {2, 0, 0},
                                   {0, 1, 0},
                                   {0, 0, 1},
                                   {4, 0, 1},
                                   {0, 1, 1},
                                   {0, 0, 2},
                                   {1, 0, 2},
                                   {0, 1, 2}},
                        .triangles{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}};
    const Mesh mesh(data, 1);
    const double ends[] = {0, 2.0 / 7, 6.0 / 7, 1};
    for (std::uint32_t part = 0; part < 3; ++part)
        for (const double left : {0.01, 0.25, 0.6, 0.99})
            for (const float y : {0.0f, 0.3f, 1.0f}) {
                const double x = ends[part] + left * (ends[part + 1] - ends[part]);
                const Vec3 seen = sample_area(mesh, Vec2(x, y)).position;
                const Vec3 right =
                    sample_area(mesh.triangle(part), Vec2(left, y)).position;
                CHECK(glm::distance(seen, right) < 1e-5f);
            }
}

TEST_CASE("mesh: a normal between normals is unit, however short they are") {
    MeshData data{.positions{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, .triangles{{0, 1, 2}}};
    for (const float length : {1e-30f, 1e-20f, 1.0f, 1e20f}) {
        data.normals = {{0, 0, length}, {length, 0, length}, {0, length, length}};
        const Mesh mesh(data, 1);
        const Ray down{.origin{1, 2, 9}, .direction{0, 0, -1}}; // u = 1/4, v = 1/2
        const auto hit = intersect(down, mesh);
        REQUIRE(hit);
        const Vec3 normal =
            shading_normal(mesh, *hit, surface_point(mesh, down, *hit).normal);
        CHECK(glm::distance(normal, glm::normalize(Vec3{0.25f, 0.5f, 1})) < 1e-6f);
    }
}

TEST_CASE("mesh: triangles without an area, and normals without a direction") {
    MeshData data = icosphere(unit_ball, 1);
    data.triangles.push_back({0, 0, 1});
    data.triangles.push_back({2, 2, 2});
    for (std::size_t i = 0; i < data.normals.size(); i += 3) data.normals[i] = Vec3{0};
    for (std::size_t i = 1; i < data.normals.size(); i += 3)
        data.normals[i] = -data.normals[i]; // against the winding
    const Mesh mesh(data);
    CHECK(mesh.size() == 82);
    Numbers numbers{23};
    for (int i = 0; i < 3000; ++i) {
        const Vec3 from(3.0 * numbers.direction());
        const Ray ray{.origin = from,
                      .direction = glm::normalize(Vec3(numbers.point(0.8)) - from)};
        const auto hit = intersect(ray, mesh);
        if (!hit) continue;
        CHECK(hit->part < 80);
        const auto point = surface_point(mesh, ray, *hit);
        const Vec3 n = shading_normal(mesh, *hit, point.normal);
        CHECK(glm::length(n) == doctest::Approx(1).epsilon(1e-5));
        CHECK(glm::dot(n, point.normal) > 0);
        const auto sampled =
            sample_area(mesh, Vec2(static_cast<float>(numbers.next()),
                                   static_cast<float>(numbers.next())));
        CHECK(is_finite(sampled.position));
        CHECK(is_finite(sampled.normal));
    }
}

TEST_CASE("mesh: texture coordinates are those of its vertices, interpolated") {
    // Numbers that a float holds: the weights are 1/4, 1/4 and 1/2, nothing is rounded.
    MeshData one{.positions{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, .triangles{{0, 1, 2}}};
    const Ray down{.origin{1, 2, 9}, .direction{0, 0, -1}};
    const auto uv_of = [](const MeshData& data, const Ray& ray) {
        const Mesh mesh(data, 1);
        const auto hit = intersect(ray, mesh);
        REQUIRE(hit.has_value());
        return texture_coordinates(mesh, *hit, surface_point(mesh, ray, *hit));
    };
    CHECK(uv_of(one, down) == Vec2{0.25f, 0.5f}); // none: the triangle's own
    one.uv = {{8, -4}, {0, 16}, {2, 1}};
    CHECK(uv_of(one, down) == Vec2{3, 3.5f});

    // Where the coordinates are a linear function of the place, so is what is found,
    // whichever triangle of a soup is met.
    MeshData data = soup(300, 5);
    const auto linear = [](const glm::dvec3& p) {
        return glm::dvec2(0.5 + p.x - 2 * p.y + 0.25 * p.z, p.z - 3 * p.x);
    };
    for (const Vec3& p : data.positions) data.uv.emplace_back(linear(glm::dvec3(p)));
    const Mesh mesh(data, 1);
    Numbers numbers{7};
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const Vec3 from(3.0 * numbers.direction());
        const Ray ray{.origin = from,
                      .direction = glm::normalize(Vec3(numbers.point(0.8)) - from)};
        const auto hit = intersect(ray, mesh);
        if (!hit) continue;
        ++hits;
        const auto point = surface_point(mesh, ray, *hit);
        const glm::dvec2 right = linear(glm::dvec3(point.position));
        CHECK(glm::length(glm::dvec2(texture_coordinates(mesh, *hit, point)) - right) <
              1e-5);
    }
    CHECK(hits > 500);
    MeshData bare = data;
    bare.uv = {};
    CHECK(mesh.bytes() == Mesh(bare, 1).bytes() + 900 * sizeof(Vec2));
    MeshData round = bare;
    round.normals.assign(900, Vec3{0, 0, 1});
    bare.normals = {};
    CHECK(Mesh(round, 1).bytes() == Mesh(bare, 1).bytes() + 900 * sizeof(Vec3));
}

TEST_CASE("mesh: triangles that collapse to a line are never what a ray meets") {
    // A globe whose quads at the poles have two equal corners.
    const int rows = 6, columns = 8;
    MeshData data;
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double theta = 3.14159265358979 * i / rows;
            const double phi = 6.28318530717959 * j / columns;
            const double ring = i == 0 || i == rows ? 0 : std::sin(theta);
            data.positions.emplace_back(float(ring * std::cos(phi)),
                                        float(std::cos(theta)),
                                        float(ring * std::sin(phi)));
        }
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>(i * columns + j % columns);
    };
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            data.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
            data.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
        }
    const Mesh globe(data);
    Numbers n{71};
    for (int i = 0; i < 20000; ++i) {
        // At the sides of the collapsed triangles, from outside and from within.
        const Triangle t = globe.triangle(static_cast<std::uint32_t>(2 * (i % 8) + 1));
        const Vec3 target = t.v1 + float(n.next()) * (t.v3 - t.v1);
        const Vec3 origin(n.point(i % 2 == 0 ? 4 : 0.5));
        const Ray ray{.origin = origin, .direction = target - origin};
        const auto check = [&](const auto& hit) {
            if (!hit) return;
            const Vec3 normal = surface_point(globe, ray, *hit).normal;
            REQUIRE(glm::dot(normal, normal) == doctest::Approx(1));
        };
        check(intersect(ray, globe));
        check(intersect<float>(ray, globe));
        check(intersect<Watertight>(ray, globe));
    }
}

TEST_CASE("mesh: no point is chosen on a triangle that has no area") {
    MeshData data;
    data.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
    data.triangles = {{3, 3, 3}, {0, 1, 2}, {3, 3, 3}, {2, 1, 0}, {3, 3, 3}};
    const Mesh mesh(data);
    CHECK(area(mesh) == 1);
    for (const float x : {0.0f, 1e-30f, 0.25f, 0.5f, 0.75f, 0.9999999f, 1.0f})
        for (const float y : {0.0f, 0.5f, 1.0f}) {
            const SurfacePoint point = sample_area(mesh, Vec2{x, y});
            CHECK(point.position.z == 0);
            CHECK(std::abs(point.normal.z) == 1);
            CHECK(point.normal.z == (x < 0.5f ? 1 : -1));
        }
}
