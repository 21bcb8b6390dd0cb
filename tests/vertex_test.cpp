// Of 12 means at 4.75 standard errors and 18 means and counts at 5 one is a false alarm
// in 30 000 runs. The statistical cases were run with 20 further seeds: none failed.
// For others: `./scripts/test --seeds 20`.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "ljus/geometry/moving.hpp"
#include "ljus/image/texture.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/materials/textured.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/photons/photon_path.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/scene/make_scene.hpp"
#include "ljus/scene/world.hpp"
#include "support/closed_forms.hpp"
#include "support/mean.hpp"
#include "support/rooms.hpp"

using namespace ljus;
using namespace ljus_test;

TEST_CASE("vertex: a lamp emits along its normal, and to no other side") {
    BallRoom room;
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Quad{.corner{-1, -1, 0}, .edge_u{2, 0, 0}, .edge_v{0, 2, 0}}, black,
             Rgb{3});                                                      // normal +z
    room.add(Sphere{.center{10, 0, 0}, .radius = 1}, black, Rgb{1}, true); // inwards
    const World world(std::move(room));
    const auto seen = [&](const Vec3& from, const Vec3& direction) {
        const Ray ray{.origin = from, .direction = direction};
        const auto hit = closest_hit(world, ray);
        REQUIRE(hit);
        return vertex_at(world, ray, *hit);
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

TEST_CASE("vertex: roulette leaves the mean as it was") {
    // Survivors are divided by the probability of surviving: three channels and four
    // throughputs; one false alarm in 40 000 runs.
    for (const Rgb before : {Rgb{0.9f, 0.5f, 0.1f}, Rgb{0.01f, 0.02f, 0}, Rgb{0.3f},
                             Rgb{2.25f, 1, 0.5f}}) {
        Mean after[3];
        auto stream = random_stream(test_seed(1), Pass::user, 0, 0);
        for (int i = 0; i < 50000; ++i) {
            Rgb throughput = before;
            const bool alive = survives(throughput, 1.0f, next_1d<float>(stream));
            for (int c = 0; c < 3; ++c)
                after[c].add(alive ? double(throughput[c]) : 0.0);
            if (alive) CHECK(max_component(throughput) >= 1.0f - 1e-6f);
        }
        for (int c = 0; c < 3; ++c)
            CHECK(std::abs(apart(after[c], double(before[c]), 1e-6)) <
                  once_in_a_million);
    }
    // Above 1 no path ends, and none is changed: inside glass throughputs are 2.25.
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
    const World world(
        make_scene(placed(Sphere{{0, 0, -5}, 1}, Lambertian{}, Rgb{2}),
                   placed(Sphere{{0, 0, -5}, 50}, Lambertian{.albedo = Rgb{0.25f}},
                          Rgb{0}, true)));
    const Ray ray; // along -z
    const auto ball = vertex_at(world, ray, *closest_hit(world, ray));
    CHECK(ball.point.position == Vec3{0, 0, -4});
    CHECK(ball.point.normal == Vec3{0, 0, 1});
    CHECK(ball.object.emission == Rgb{2});
    CHECK(ball.frame.normal == ball.point.normal);
    const Ray away{.direction = {0, 0, 1}};
    const auto room = vertex_at(world, away, *closest_hit(world, away));
    CHECK(room.point.position == Vec3{0, 0, 45});
    CHECK(room.point.normal == Vec3{0, 0, -1}); // it points inwards
    CHECK(room.object.material == MaterialId{0, 1});
    CHECK(room.object.inside_out);
    CHECK(std::abs(glm::dot(room.frame.tangent, room.frame.normal)) < 1e-6f);
    // Leaving is on the inside, whichever way the normal points.
    CHECK(offset_ray_origin(room.point, Vec3{0, 0, -1}).z < 45);
}

namespace {

using D3 = glm::dvec3;
const D3 fog{0.1, 0.2, 0.3}; ///< What the glass of the tests below absorbs.

/// A slab of glass between z = -2 and z = 0, its normals outwards.
ClosedRoomT<double> slab() {
    BallRoomT<double> room;
    const auto glass = room.add(GlassT<double>{.index = 1.5, .absorption = fog});
    room.add(QuadT<double>{{-1e5, -1e5, 0}, {2e5, 0, 0}, {0, 2e5, 0}}, glass);
    room.add(QuadT<double>{{-1e5, -1e5, -2}, {0, 2e5, 0}, {2e5, 0, 0}}, glass);
    return ClosedRoomT<double>(std::move(room));
}

/// A vertex at the origin whose shading normal leans by 0.3 to +x from the surface's
/// own, which is +y; seen from a direction.
VertexT<double> leaning(const D3& back) {
    VertexT<double> vertex;
    vertex.point.normal = {0, 1, 0};
    vertex.frame = frame_around(glm::normalize(D3{0.3, 1, 0}));
    vertex.wo = to_local(vertex.frame, back);
    vertex.smooth = true;
    return vertex;
}

} // namespace

TEST_CASE("vertex: a path through glass carries what its ways and Snell say") {
    // A path knows by its turns where it is; the test by the place. Camera paths gain
    // and lose n^2, photons do not.
    const auto world = slab();
    int inside_reflections = 0, left = 0;
    for (const Transport transport : {Transport::radiance, Transport::flux})
        for (std::uint64_t seed = 0; seed < 400; ++seed) {
            auto stream = random_stream(test_seed(seed), Pass::user, 0, 0);
            const RayT<double> ray{.origin{0, 0, 1},
                                   .direction = glm::normalize(D3{0.6, 0.2, -0.8}),
                                   .time = 0.25};
            PathStateT<double> path{.ray = ray, .throughput{2, 3, 4}};
            D3 from = ray.origin, way{0};
            bool was_inside = false;
            while (path.depth < 12) {
                const auto vertex = next_vertex(world, path, stream);
                if (!vertex) break;
                const D3 place = vertex->point.position;
                const bool inside =
                    (from.z + place.z) / 2 < 0 && (from.z + place.z) / 2 > -2;
                const double length = glm::distance(from, place);
                REQUIRE(vertex->distance == doctest::Approx(length).epsilon(1e-9));
                REQUIRE(vertex->medium == (inside ? fog : D3{0}));
                REQUIRE(vertex->time == 0.25);
                if (inside) way += length * fog;
                inside_reflections += inside && was_inside;
                was_inside = inside;
                const double scale =
                    inside && transport == Transport::radiance ? 1 / 2.25 : 1;
                for (int c = 0; c < 3; ++c)
                    REQUIRE(path.throughput[c] ==
                            doctest::Approx((2 + c) * scale * std::exp(-way[c]))
                                .epsilon(1e-9));
                const int depth = path.depth;
                REQUIRE(world.visit_material(
                    vertex->object.material, [&](const auto& material) {
                        return continue_path(path, *vertex, material, transport,
                                             Lobes::all, stream);
                    }));
                REQUIRE(path.depth == depth);
                REQUIRE(path.previous == place);
                REQUIRE(path.specular);
                REQUIRE(path.met_specular);
                REQUIRE_FALSE(path.met_diffuse);
                REQUIRE(path.pdf == 0);
                REQUIRE(path.ray.time == 0.25);
                REQUIRE(glm::length(path.ray.direction) ==
                        doctest::Approx(1).epsilon(1e-12));
                // Across: sine 0.632 outside, 0.632 / 1.5 inside.
                const bool goes_inside =
                    path.ray.direction.z < 0 ? place.z > -1 : place.z < -1;
                const double sine =
                    std::hypot(path.ray.direction.x, path.ray.direction.y);
                REQUIRE(sine ==
                        doctest::Approx(std::sqrt(0.4 / 1.04) / (goes_inside ? 1.5 : 1))
                            .epsilon(1e-9));
                REQUIRE(path.medium == (goes_inside ? fog : D3{0}));
                if (transport == Transport::radiance)
                    REQUIRE(path.eta_scale ==
                            doctest::Approx(goes_inside ? 1 / 2.25 : 1).epsilon(1e-9));
                from = place;
            }
            left += path.depth < 12;
        }
    CHECK(inside_reflections > 5);
    CHECK(left == 800);
}

TEST_CASE("vertex: a path that begins in glass is in it, and outside it is not") {
    const auto world = slab();
    auto stream = random_stream(1, Pass::user, 0, 0);
    for (const double z : {-0.5, 0.5, -2.5}) {
        const double up = z < -2 ? 1 : z > 0 ? -1 : 1; // towards the slab
        PathStateT<double> path{.ray{.origin{0, 0, z}, .direction{0, 0, up}}};
        const auto vertex = next_vertex(world, path, stream);
        REQUIRE(vertex);
        const bool inside = z == -0.5;
        CHECK(vertex->medium == (inside ? fog : D3{0}));
        for (int c = 0; c < 3; ++c)
            CHECK(path.throughput[c] ==
                  doctest::Approx(inside ? std::exp(-0.5 * fog[c]) : 1));
        CHECK(path.depth == 1);
    }
    // Later a surface says nothing, met from the front or from behind: a matt sheet
    // within the glass.
    for (const bool behind : {false, true}) {
        PathStateT<double> path{
            .ray{.origin{0, 0, -1}, .direction{0, 0, 1}}, .medium = fog, .depth = 1};
        BallRoomT<double> room;
        const D3 u{0, 18, 0}, v{18, 0, 0}; // u x v = -z
        room.add(QuadT<double>{{-9, -9, 0}, behind ? v : u, behind ? u : v},
                 room.add(LambertianT<double>{}));
        const auto vertex = next_vertex(World(room), path, stream);
        REQUIRE(vertex);
        CHECK((vertex->wo.z < 0) == behind);
        CHECK(vertex->medium == fog);
        CHECK(path.medium == fog);
        CHECK(path.throughput.y == doctest::Approx(std::exp(-0.2)));
    }
}

TEST_CASE(
    "vertex: where a path begins, and where it leaves a body, its medium is what is "
    "around it") {
    // Bodies of index 1, which bend and mirror nothing, before a lamp of radiance 1 at
    // z = -8: what arrives is exp(-sum of absorption times length), by hand.
    using T = double;
    Scene<Shapes<SphereT<T>, QuadT<T>>, Materials<LambertianT<T>, GlassT<T>>> scene;
    const auto black = scene.add(LambertianT<T>{.albedo = D3{0}});
    const auto body = [&](double absorption) {
        return scene.add(GlassT<T>{.index = 1, .absorption = D3{absorption}});
    };
    scene.add(QuadT<T>{{-9, -9, -8}, {18, 0, 0}, {0, 18, 0}}, black, D3{1});
    const auto outer = body(0.3), clear = body(0), dense = body(0.7), pane = body(0.2);
    scene.add(SphereT<T>{.radius = 5}, outer);
    scene.add(SphereT<T>{.center{0, 0, 2}, .radius = 1}, clear);
    scene.add(SphereT<T>{.center{0, 0, -2}, .radius = 1}, dense);
    // A sheet of glass of two quads, beyond the ball: z in [-7, -6].
    scene.add(QuadT<T>{{-9, -9, -6}, {18, 0, 0}, {0, 18, 0}}, pane);
    scene.add(QuadT<T>{{-9, -9, -7}, {0, 18, 0}, {18, 0, 0}}, pane);
    // A matt sheet within the ball, beside the way of the others, front to the camera.
    scene.add(QuadT<T>{{3, -1, -1}, {1, 0, 0}, {0, 2, 0}}, black, D3{1});
    const World world(std::move(scene));
    CHECK(world.has_nested_media());
    const PathTracer tracer(world, {.roulette_depth = 100, .sample_lights = false});
    const auto seen = [&](double x, double z) {
        auto stream = random_stream(1, Pass::user, 0, 0);
        Counts counts;
        auto context = context_of(stream, counts);
        return radiance(tracer, RayT<T>{.origin{x, 0, z}, .direction{0, 0, -1}},
                        context)
            .y;
    };
    const double sheet = 0.2, inner = 1.4; // of the pane and of the dense ball, whole
    const auto is = [](double depth) { return doctest::Approx(std::exp(-depth)); };
    CHECK(seen(0, 9) == is(0.3 * (10 - 4) + inner + sheet));    // from outside
    CHECK(seen(0, 4) == is(0.3 * (9 - 4) + inner + sheet));     // in the outer ball
    CHECK(seen(0, 2.5) == is(0.3 * (2 + 2) + inner + sheet));   // in the clear one
    CHECK(seen(0, 0.5) == is(0.3 * (1.5 + 2) + inner + sheet)); // between the two
    CHECK(seen(0, -2) == is(0.7 * 1 + 0.3 * 2 + sheet));        // in the dense one
    CHECK(seen(0, -5.5) == is(sheet));                          // beyond the ball
    CHECK(seen(0, -6.25) == is(0.2 * 0.75));                    // in the sheet
    CHECK(seen(3.5, 1) == is(0.3 * 2)); // before what is met from the front
    for (const double z : {9.0, 4.0, 2.5, 0.5, -2.0, -5.5, -6.25})
        CHECK(medium_at(world, RayT<T>{.origin{0, 0, z},
                                       .direction{0, 0, 1},
                                       .t_max = 0.01}) == // which does not matter
              D3{z == 4 || z == 0.5 ? 0.3
                 : z == -2          ? 0.7
                 : z == -6.25       ? 0.2
                                    : 0.0});
}

namespace {

/// Paper that light passes: half of what it scatters goes on to the other side.
struct Paper {
    using Scalar = float;
    Rgb albedo{0.8f};
    Rgb inside{0};
};
Lobes lobes(const Paper&) {
    return Lobes::diffuse;
}
Rgb evaluate(const Paper& p, const Vec3&, const Vec3&) {
    return p.albedo * (0.5f * std::numbers::inv_pi_v<float>);
}
float pdf(const Paper&, const Vec3&, const Vec3& wi, Lobes which = Lobes::all) {
    return has(which, Lobes::diffuse)
               ? 0.5f * std::abs(wi.z) * std::numbers::inv_pi_v<float>
               : 0;
}
std::optional<BsdfSample> sample(const Paper& p, const Vec3&, const Vec3& u, Transport,
                                 Lobes which = Lobes::all) {
    Vec3 w = sample_cosine_hemisphere(Vec2{u.x, u.y});
    if (!has(which, Lobes::diffuse) || !(w.z > 0)) return std::nullopt;
    const float density = 0.5f * w.z * std::numbers::inv_pi_v<float>;
    if (u.z < 0.5f) w.z = -w.z;
    return diffuse_sample(w, p.albedo, density);
}
Rgb absorption(const Paper& p) {
    return p.inside;
}
void check(const Paper&) {}

} // namespace

TEST_CASE("vertex: light from behind a surface comes through what is behind it") {
    // A lamp within a ball of paper that absorbs inside: shadow rays, paths and both
    // see the same.
    Scene<Shapes<Sphere>, Materials<Lambertian, Paper>> scene;
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    const auto paper = scene.add(Paper{.inside = Rgb{0.5f}});
    scene.add(Sphere{.radius = 2}, paper);
    scene.add(Sphere{.radius = 0.5f}, black, Rgb{20});
    const World world(std::move(scene));
    const auto mean = [&](bool shadow_rays, MisHeuristic heuristic, int count) {
        const PathTracer tracer(world,
                                {.sample_lights = shadow_rays, .heuristic = heuristic});
        return mean_radiance(tracer, count, 9, [](auto&) {
            return Ray{.origin{0, 0.3f, 6}, .direction{0, 0, -1}};
        });
    };
    const Mean paths = mean(false, MisHeuristic::balance, 60000);
    for (const MisHeuristic how : {MisHeuristic::shadow_rays, MisHeuristic::balance}) {
        const Mean rays = mean(true, how, 20000);
        CHECK(std::abs(apart(rays, paths)) < 5);
        CHECK(rays.error() < 0.03 * rays.mean);
    }
}

TEST_CASE("vertex: a matt surface sends a path on by the cosine, times its albedo") {
    BallRoomT<double> room;
    const LambertianT<double> matt{.albedo{0.8, 0.5, 0.2}};
    room.add(QuadT<double>{{-9, -9, 0}, {18, 0, 0}, {0, 18, 0}}, room.add(matt));
    const World world(std::move(room));
    for (const double side : {1.0, -1.0})
        for (const double stop : {1.0, 0.25}) {
            D3 mean{0};
            const int count = 4000;
            for (int i = 0; i < count; ++i) {
                auto stream =
                    random_stream(test_seed(2), Pass::user, 0, std::uint64_t(i));
                PathStateT<double> path{
                    .ray{.origin{0, 0, side}, .direction{0, 0, -side}, .time = 0.5}};
                auto vertex = next_vertex(world, path, stream);
                REQUIRE(vertex);
                vertex->stop_probability = stop;
                REQUIRE(continue_path(path, *vertex, matt, Transport::radiance,
                                      Lobes::all, stream));
                const D3 d = path.ray.direction;
                REQUIRE(d.z * side > 0);
                REQUIRE(path.ray.origin.z * side > 0);
                REQUIRE(path.pdf == doctest::Approx(std::abs(d.z) / std::numbers::pi));
                for (int c = 0; c < 3; ++c)
                    REQUIRE(path.throughput[c] ==
                            doctest::Approx(matt.albedo[c] / stop));
                REQUIRE_FALSE(path.specular);
                REQUIRE(path.met_diffuse);
                REQUIRE_FALSE(path.met_specular);
                REQUIRE(path.eta_scale == 1);
                REQUIRE(path.ray.time == 0.5);
                REQUIRE(path.ray.t_max == std::numeric_limits<double>::infinity());
                mean += d / double(count);
            }
            // E[d] = (0, 0, 2/3); the components scatter by 1/2, 1/2 and 0.24.
            const double error = 5 / std::sqrt(double(count));
            CHECK(std::abs(mean.x) < 0.5 * error);
            CHECK(std::abs(mean.y) < 0.5 * error);
            CHECK(std::abs(mean.z - side * 2 / 3) < 0.24 * error);
        }
    // A black lobe, or one that is not asked for, ends it.
    auto stream = random_stream(2, Pass::user, 0, 0);
    PathStateT<double> path{.ray{.origin{0, 0, 1}, .direction{0, 0, -1}}};
    const auto vertex = next_vertex(world, path, stream);
    CHECK_FALSE(continue_path(path, *vertex, matt, Transport::radiance, Lobes::specular,
                              stream));
}

TEST_CASE("vertex: at a boundary a path splits by Fresnel's share") {
    const auto world = slab();
    const GlassT<double> glass{.index = 1.5, .absorption = fog};
    for (const int depth : {0, 3, 40}) {
        auto stream = random_stream(1, Pass::user, 0, 0);
        PathStateT<double> path{.ray{.origin{0, 0, 1}, .direction{0.6, 0, -0.8}},
                                .throughput{2, 3, 4},
                                .depth = depth,
                                .branch = 5};
        const auto vertex = next_vertex(world, path, stream);
        REQUIRE(vertex);
        const auto other = split_path(path, *vertex, glass);
        REQUIRE(other);
        const double cos_t = std::sqrt(1 - 0.36 / 2.25);
        const double share = fresnel_share(0.8, 1, 1.5);
        for (int c = 0; c < 3; ++c) {
            CHECK(path.throughput[c] == doctest::Approx((2 + c) * share));
            CHECK(other->throughput[c] ==
                  doctest::Approx((2 + c) * (1 - share) / 2.25));
        }
        CHECK(glm::distance(path.ray.direction, D3{0.6, 0, 0.8}) < 1e-12);
        CHECK(glm::distance(other->ray.direction, D3{0.4, 0, -cos_t}) < 1e-12);
        CHECK(path.ray.origin.z > 0);
        CHECK(other->ray.origin.z < 0);
        CHECK(path.medium == D3{0});
        CHECK(other->medium == fog);
        CHECK(path.eta_scale == 1);
        CHECK(other->eta_scale == doctest::Approx(1 / 2.25));
        CHECK(path.branch == 5);
        // Numbers of its own: beyond all depths of its sister, and of another split.
        CHECK(other->branch == 5 + (std::uint64_t(1) << (16 + (depth + 1) % 32)));
        CHECK(path.depth == depth + 1);
        CHECK(other->depth == depth + 1);
    }
    auto stream = random_stream(1, Pass::user, 0, 0);
    // From within, beyond the critical angle, and at a matt surface, there is one way.
    PathStateT<double> steep{.ray{.origin{0, 0, -1}, .direction{0.8, 0, 0.6}}};
    const auto total = next_vertex(world, steep, stream);
    REQUIRE(total);
    CHECK_FALSE(split_path(steep, *total, glass));
    CHECK(steep.ray.direction.z == 0.6);
    CHECK_FALSE(split_path(steep, *total, LambertianT<double>{}));
    auto smooth = leaning({0, 1, 0});
    CHECK_FALSE(split_path(steep, smooth, glass));
    smooth.smooth = false;
    CHECK(split_path(steep, smooth, glass));
}

TEST_CASE("vertex: with two normals, radiance by the one and flux by both") {
    const D3 lean = glm::normalize(D3{0.3, 1, 0}), up{0, 1, 0};
    const LambertianT<double> matt{.albedo{0.8, 0.5, 0.2}};
    int ended = 0, went_on = 0;
    for (const double x : {-0.9, -0.3, 0.4, 0.9})
        for (std::uint64_t i = 0; i < 2000; ++i) {
            auto stream = random_stream(test_seed(3), Pass::user, 0, i);
            const D3 back = glm::normalize(D3{x, 0.6, 0.2});
            const auto vertex = leaning(back);
            const auto u = next_3d<double>(stream);
            const auto radiance = scatter(vertex, matt, u, Transport::radiance);
            const auto flux = scatter(vertex, matt, u, Transport::flux);
            const D3 local = sample(matt, vertex.wo, u, Transport::radiance)->wi;
            const D3 wi = to_world(vertex.frame, local);
            REQUIRE(glm::dot(wi, lean) > 0);
            REQUIRE(bool(radiance) == (wi.y > 0)); // through the surface: it ends
            REQUIRE(bool(flux) == (wi.y > 0));
            (wi.y > 0 ? went_on : ended) += 1;
            if (!radiance) continue;
            CHECK(glm::distance(radiance->wi, wi) < 1e-14);
            CHECK(glm::distance(radiance->sample.weight, matt.albedo) < 1e-14);
            // Veach's equation 5.19.
            const double factor = glm::dot(back, lean) * glm::dot(wi, up) /
                                  (glm::dot(back, up) * glm::dot(wi, lean));
            CHECK(glm::distance(flux->sample.weight, matt.albedo * factor) <
                  1e-12 * factor);
        }
    // The normals are 16.7 degrees apart: 42 of 2000 directions are below the surface,
    // for each of the four ways the same; fewer than 10 are once in a thousand million.
    CHECK(ended >= 40);
    CHECK(went_on > 7000);

    // A mirror: about the leaning normal, where that stays above the surface; else
    // about the surface's own.
    const MirrorT<double> mirror{.reflectance = D3{0.9}};
    for (const double x : {-0.9, -0.3, 0.0, 0.9}) {
        const D3 back = glm::normalize(D3{x, 0.5, 0.1});
        const auto seen = scatter(leaning(back), mirror, D3{0.5}, Transport::radiance);
        REQUIRE(seen);
        const D3 by_lean = 2 * glm::dot(back, lean) * lean - back;
        const D3 by_own{-back.x, back.y, -back.z};
        CAPTURE(x);
        CHECK(glm::distance(seen->wi, by_lean.y > 0 ? by_lean : by_own) < 1e-12);
    }
    // Seen along the surface itself nothing is known: no infinite flux.
    VertexT<double> edge;
    edge.frame = {.tangent{1, 0, 0}, .bitangent{0, 1, 0}, .normal{0, 0, 1}};
    edge.point.normal = {1, 0, 0};
    edge.wo = {0, 0.6, 0.8};
    edge.smooth = true;
    int refused = 0;
    for (const double u : {0.1, 0.4, 0.6, 0.9}) {
        const D3 three{u, u, u};
        const auto radiance = scatter(edge, matt, three, Transport::radiance);
        CHECK_FALSE(scatter(edge, matt, three, Transport::flux));
        refused += bool(radiance);
    }
    CHECK(refused > 0);
}

TEST_CASE("vertex: panes in the way let a path pass, or stop it by what they reflect") {
    // Head on, r = 0.04 at each side and a tint a on each way through: all turns within
    // together let (1 - r)^2 a / (1 - r^2 a^2) pass.
    const D3 tint{1, 0.5, 0.25};
    D3 passed;
    for (int c = 0; c < 3; ++c)
        passed[c] = 0.96 * 0.96 * tint[c] / (1 - 0.0016 * tint[c] * tint[c]);
    const double stop = 1 - (passed.x + passed.y + passed.z) / 3;
    const ThinGlassT<double> pane{1.5, tint};
    const auto at_height = [](double z) {
        return QuadT<double>{{-9, -9, z}, {18, 0, 0}, {0, 18, 0}};
    };
    const World world(make_scene(placed(at_height(0), LambertianT<double>{}),
                                 placed(at_height(1), pane),
                                 placed(at_height(2), pane)));
    int stopped[3] = {};
    const int paths = 20000;
    for (int i = 0; i < paths; ++i) {
        auto stream = random_stream(test_seed(8), Pass::user, 0, std::uint64_t(i));
        PathStateT<double> path{
            .ray{.origin{0, 0, 4}, .direction{0, 0, -1}, .time = 0.75},
            .throughput{2, 3, 4},
            .medium = fog,
            .depth = 1};
        const auto vertex = next_vertex(world, path, stream);
        REQUIRE(vertex);
        const double z = std::round(vertex->point.position.z);
        const int panes = 2 - int(z); // that it has passed
        ++stopped[panes];
        REQUIRE(vertex->point.position.z == doctest::Approx(z).epsilon(1e-9));
        REQUIRE(vertex->distance == doctest::Approx(4 - z).epsilon(1e-9));
        REQUIRE(vertex->stop_probability == doctest::Approx(z > 0 ? stop : 1));
        REQUIRE(vertex->time == 0.75);
        REQUIRE(path.depth == 2);
        for (int c = 0; c < 3; ++c)
            REQUIRE(path.throughput[c] ==
                    doctest::Approx((2 + c) * std::pow(passed[c] / (1 - stop), panes) *
                                    std::exp(-fog[c] * (4 - z)))
                        .epsilon(1e-9));
    }
    const double on = 1 - stop, share[3] = {stop, on * stop, on * on};
    for (int k = 0; k < 3; ++k) // once in 1.7 million each
        CHECK(std::abs(stopped[k] - paths * share[k]) <
              5 * std::sqrt(paths * share[k] * (1 - share[k])));
    // Out of the scene through both panes: no vertex. And how much of a lamp is seen.
    bool left = false;
    for (std::uint64_t i = 0; i < 50; ++i) {
        auto stream = random_stream(test_seed(9), Pass::user, 0, i);
        PathStateT<double> path{.ray{.origin{0, 0, 0.5}, .direction{0, 0, 1}}};
        left = left || !next_vertex(world, path, stream);
    }
    CHECK(left);
    const auto point = [](double z) {
        return SurfacePointT<double>{.position{0, 0, z}, .normal{0, 0, 1}};
    };
    const D3 through = visibility(world, point(0.5), point(3));
    CHECK(glm::distance(through, passed * passed) < 1e-9);
    CHECK(visibility(world, point(2.5), point(3)) == D3{1});
    CHECK(visibility(world, point(-1), point(3)) == D3{0});
}

TEST_CASE("vertex: a way is blocked by the thousandth pane") {
    for (const int panes : {999, 1000}) {
        Scene<Shapes<QuadT<double>>, Materials<LambertianT<double>, ThinGlassT<double>>>
            scene;
        const auto clear = scene.add(ThinGlassT<double>{1, D3{1}}); // reflects nothing
        const auto at_height = [](double z) {
            return QuadT<double>{{-9, -9, z}, {18, 0, 0}, {0, 18, 0}};
        };
        scene.add(at_height(-1), scene.add(LambertianT<double>{}));
        for (int i = 0; i < panes; ++i) scene.add(at_height(i), clear);
        const World world(std::move(scene));
        auto stream = random_stream(1, Pass::user, 0, 0);
        PathStateT<double> path{.ray{.origin{0, 0, 1000.5}, .direction{0, 0, -1}}};
        CHECK(next_vertex(world, path, stream).has_value() == (panes < 1000));
        CHECK(path.throughput.x == doctest::Approx(panes < 1000 ? 1 : 0)); // nor a sky
        const auto point = [](double z) {
            return SurfacePointT<double>{.position{0, 0, z}, .normal{0, 0, 1}};
        };
        CHECK(visibility(world, point(1000.5), point(-0.5)).x ==
              doctest::Approx(panes < 1000 ? 1 : 0));
    }
}

TEST_CASE("vertex: roulette's threshold and its largest probability") {
    const auto alive = [](float carried, float u, float threshold, float most) {
        Rgb throughput{carried};
        return survives(throughput, 1.0f, u, threshold, most) ? throughput.x : 0.0f;
    };
    CHECK(alive(0.25f, 0.49f, 0.5f, 1) == 0.5f); // with probability 0.25 / 0.5
    CHECK(alive(0.25f, 0.51f, 0.5f, 1) == 0);
    CHECK(alive(4, 0.74f, 0.5f, 0.75f) == doctest::Approx(4 / 0.75f));
    CHECK(alive(4, 0.76f, 0.5f, 0.75f) == 0);
    CHECK(alive(0.001f, 0.99f, 0, 1) == 0.001f); // any is safe
    // The brightest channel decides, whichever it is.
    for (int brightest = 0; brightest < 3; ++brightest)
        for (const bool lives : {true, false}) {
            Rgb throughput{0.125f};
            throughput[brightest] = 0.5f;
            CHECK(survives(throughput, 1.0f, lives ? 0.49f : 0.51f) == lives);
            CHECK(throughput[brightest] == (lives ? 1.0f : 0.5f));
            CHECK(throughput[(brightest + 1) % 3] == (lives ? 0.25f : 0.125f));
        }
}

TEST_CASE("vertex: what a slanted pane lets through, and what glass hides") {
    // At 60 degrees, and by Fresnel there: all turns within, T = (1 - r) / (1 + r).
    const World world(
        make_scene(placed(QuadT<double>{{-9, -9, 1}, {18, 0, 0}, {0, 18, 0}},
                          ThinGlassT<double>{}),
                   placed(QuadT<double>{{-9, -9, -1}, {18, 0, 0}, {0, 18, 0}},
                          LambertianT<double>{})));
    const double r = fresnel_share(0.5, 1, 1.5);
    const auto point = [](double x, double z) {
        return SurfacePointT<double>{.position{x, 0, z}, .normal{0, 0, 1}};
    };
    const D3 seen = visibility(world, point(0, 0), point(2.5 * std::sqrt(3.0), 2.5));
    CHECK(glm::distance(seen, D3{(1 - r) / (1 + r)}) < 1e-9);
    CHECK(visibility(world, point(0, 0), point(0, -3)) == D3{0});
    // A scene that lists no thin surface: all or nothing.
    const auto glass = slab();
    CHECK(visibility(glass, point(0, 1), point(0, 3)) == D3{1});
    CHECK(visibility(glass, point(0, 1), point(0, -1)) == D3{0});
}

TEST_CASE("vertex: a path has a time if something moves, and draws it once") {
    Scene<Shapes<Moving<Sphere>, Quad>, Materials<Lambertian>> with_ball;
    with_ball.add(Moving<Sphere>{{{0, 0, 0}, 1}, {1, 0, 0}},
                  with_ball.add(Lambertian{}));
    const World moving(std::move(with_ball));
    const World still(BallRoom{});
    double sum = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        auto stream = random_stream(test_seed(5), Pass::user, 0, i), twin = stream,
             other = stream;
        const Ray ray{.origin{1, 2, 3}, .time = 0.75f};
        const PathState path = camera_path(moving, ray, stream);
        REQUIRE(path.ray.time == next_1d<float>(twin));
        REQUIRE(path.ray.origin == ray.origin);
        REQUIRE(next_1d<float>(stream) == next_1d<float>(twin));
        sum += double(path.ray.time);
        auto same = other;
        REQUIRE(camera_path(still, ray, other).ray.time == 0);
        REQUIRE(next_1d<float>(other) == next_1d<float>(same));
    }
    CHECK(std::abs(sum / 1000 - 0.5) < 5 / std::sqrt(12000.0));
}

TEST_CASE("vertex: a world knows the frames of flat shapes") {
    // What it has worked out once is what the shape says for each ray.
    Scene<Shapes<Quad, Sphere, Triangle>, Materials<Lambertian>> room;
    const auto matt = room.add(Lambertian{});
    for (const bool inside_out : {false, true}) {
        const float x = inside_out ? 3.0f : 0.0f;
        room.add(Quad{.corner{x, 0, 0}, .edge_u{1, 0, 0.2f}, .edge_v{0.1f, 1, 0}}, matt,
                 Rgb{2}, inside_out);
        room.add(Sphere{.center{x + 2, 0, 0}, .radius = 0.5f}, matt, Rgb{}, inside_out);
        room.add(Triangle{{x, -2, 0.5f}, {x + 1, -2, 0}, {x, -1, 0.3f}}, matt, Rgb{},
                 inside_out);
    }
    const World world(std::move(room));
    RandomStream numbers = random_stream(test_seed(7), Pass::user, 0, 0);
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
        const Vec2 u = next_2d(numbers);
        const float side = i % 2 == 0 ? 5.0f : -5.0f;
        const Ray ray{.origin{7 * u.x - 0.5f, 4 * u.y - 2.5f, side},
                      .direction{0, 0, -side / 5}};
        const auto hit = closest_hit(world, ray);
        if (!hit) continue;
        ++hits;
        const bool inside_out = world.object(hit->object).inside_out;
        const Vertex found = vertex_at(world, ray, *hit);
        const SurfacePoint point =
            world.visit_shape(hit->object, [&](const auto& shape) {
                return surface_point(shape, ray, hit->at);
            });
        const Vec3 normal = inside_out ? -point.normal : point.normal;
        const Frame frame = frame_around(normal);
        REQUIRE(found.point.position == point.position);
        REQUIRE(found.point.normal == normal);
        REQUIRE(found.point.error == point.error);
        REQUIRE(found.frame.tangent == frame.tangent);
        REQUIRE(found.frame.bitangent == frame.bitangent);
        REQUIRE(found.frame.normal == frame.normal);
        REQUIRE(found.wo == to_local(frame, -ray.direction));
        REQUIRE(found.emits() ==
                (hit->object.type == 0 && glm::dot(normal, ray.direction) < 0));
    }
    CHECK(hits > 50);
    // A lamp's normal and area, too.
    const auto& lamp = std::get<0>(world.shapes())[0];
    world.visit_light(0, [&](const auto& light) {
        CHECK(light.lamp.normal == normal(lamp));
        CHECK(light.lamp.area == area(lamp));
    });
    const Vec3 from{0.3f, 0.2f, 2};
    const auto known = sample_light(world, 0, from, Vec2{0.3f, 0.8f});
    REQUIRE(known);
    const SeenPointT<float> seen = sample_towards(lamp, from, Vec2{0.3f, 0.8f});
    CHECK(known->pdf == seen.pdf);
    CHECK(known->weight == Rgb{2} / seen.pdf);
    CHECK(known->point.position == seen.point.position);
    CHECK(known->point.normal == seen.point.normal);
}

TEST_CASE("vertex: coordinates of a texture, for those that look up by them") {
    using Paper = Textured<Lambertian, CheckerT<float, UvMap>>;
    Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Paper>> scene;
    const Quad wall{.corner{0, 0, 0}, .edge_u{4, 0, 0}, .edge_v{0, 2, 0}};
    const auto plain = scene.add(Lambertian{});
    const auto paper = scene.add(Paper{{}, {}});
    scene.add(wall, plain);
    Quad other = wall;
    other.corner.x = 10;
    scene.add(other, paper);
    const auto uv = [&](float x) {
        const Ray ray{.origin{x, 0.5f, 1}, .direction{0, 0, -1}};
        const World world(scene);
        return vertex_at(world, ray, *closest_hit(world, ray)).uv;
    };
    CHECK(uv(13) == Vec2{0.75f, 0.25f});
    CHECK(uv(3) == Vec2{0}); // not used
    // A hit of a ball brings no coordinates: its normal, here (0.6, 0, 0.8), tells
    // them.
    scene.add(Sphere{.center{20, 0.5f, -5}, .radius = 5}, paper);
    CHECK(uv(23).x != uv(17).x);
    CHECK(glm::distance(uv(23), map_coordinates(GlobeMap{}, Vec3{0.6f, 0, 0.8f})) <
          1e-6f);
    CHECK(detail::uses_uv(World(scene), paper));
    CHECK_FALSE(detail::uses_uv(World(scene), plain));
    Scene<Shapes<Quad>, Materials<Lambertian>> bare;
    const auto id = bare.add(Lambertian{});
    CHECK_FALSE(detail::uses_uv(World(bare), id));
}

TEST_CASE(
    "vertex: a path that stops at a pane carries the light of those that do not") {
    // By how rarely it stops, at a pane that lets nearly all light pass or nearly none.
    const LambertianT<double> matt{.albedo{0.8, 0.5, 0.2}};
    for (const double stop : {0.01, 0.4, 0.5, 0.7, 0.99, 1.0}) {
        VertexT<double> vertex;
        vertex.point.normal = {0, 0, 1};
        vertex.frame = frame_around(D3{0, 0, 1});
        vertex.stop_probability = stop;
        auto stream = random_stream(6, Pass::user, 0, 0);
        PathStateT<double> path{.throughput{1, 2, 4}};
        REQUIRE(
            continue_path(path, vertex, matt, Transport::radiance, Lobes::all, stream));
        CHECK(glm::distance(path.throughput * stop, D3{0.8, 1, 0.8}) < 1e-12);
    }
}

TEST_CASE("vertex: a path keeps nothing of how it was scattered before") {
    VertexT<double> vertex;
    vertex.point.normal = {0, 0, 1};
    vertex.frame = frame_around(D3{0, 0, 1});
    const LambertianT<double> matt{.albedo{0.8, 0.5, 0.2}};
    const MirrorT<double> mirror{.reflectance = D3{0.9}};
    auto stream = random_stream(6, Pass::user, 0, 0);
    PathStateT<double> path{.eta_scale = 0.5};
    for (int turn = 0; turn < 3; ++turn) {
        REQUIRE(
            continue_path(path, vertex, matt, Transport::radiance, Lobes::all, stream));
        CHECK(path.pdf == doctest::Approx(path.ray.direction.z / std::numbers::pi));
        CHECK_FALSE(path.specular);
        CHECK(path.met_specular == (turn > 0)); // this it does keep
        REQUIRE(continue_path(path, vertex, mirror, Transport::radiance, Lobes::all,
                              stream));
        CHECK(path.pdf == 0);
        CHECK(path.specular);
        CHECK(path.met_diffuse);
        CHECK(path.met_specular);
        CHECK(path.eta_scale == 0.5);
    }
}

TEST_CASE("vertex: what two normals disagree about is sampled again, as it was asked") {
    // Seen along the surface, a direction mirrored about the leaning normal lies below
    // the surface. About its own normal Fresnel mirrors less: some go in, after all.
    const D3 back = glm::normalize(D3{-0.9, 0.35, 0});
    const auto vertex = leaning(back);
    REQUIRE(vertex.wo.z > 0);
    const GlassT<double> glass{.index = 1.5};
    for (const Transport transport : {Transport::radiance, Transport::flux}) {
        int refracted = 0;
        for (int i = 0; i < 40; ++i) {
            const double u = (i + 0.5) / 40;
            const auto next = scatter(vertex, glass, D3{u, u, u}, transport);
            REQUIRE(next);
            const bool inside = next->wi.y < 0;
            // In by the leaning normal from the first, or by the surface's own.
            const D3 plane = inside ? glm::cross(next->wi, D3{0, 1, 0}) : D3{0};
            const bool by_own =
                inside && std::abs(glm::length(plane) - std::abs(back.x) / 1.5) < 1e-9;
            refracted += by_own;
            const double scale =
                inside && transport == Transport::radiance ? 1 / 2.25 : 1;
            if (by_own || !inside)
                CHECK(next->sample.weight.x == doctest::Approx(scale));
            if (!inside) CHECK(glm::distance(next->wi, D3{-back.x, back.y, 0}) < 1e-9);
        }
        CHECK(refracted > 5);
    }
    // Half a mirror, half matt: if the mirror is asked for, it is the mirror.
    const MixtureT<double> half{.color{0.9, 0.9, 0.9}, .reflectivity = 0.5};
    int matt = 0;
    for (int i = 0; i < 40; ++i) {
        const double u = (i + 0.5) / 40;
        const auto next =
            scatter(vertex, half, D3{u, u, u}, Transport::radiance, Lobes::specular);
        REQUIRE(next);
        CHECK(next->sample.specular);
        CHECK(glm::distance(next->sample.weight, D3{0.5}) < 1e-12);
        CHECK(glm::distance(next->wi, D3{-back.x, back.y, 0}) < 1e-9);
        const auto any = scatter(vertex, half, D3{u, u, u}, Transport::radiance);
        matt += !any || !any->sample.specular;
    }
    CHECK(matt > 5);
    // A matt direction through the surface ends the path, and is no second chance for
    // the boundary, which by the surface's own normal mirrors more.
    const MixtureT<double> coated{.color = D3{0.9}, .specularity = 1};
    const auto low = leaning(glm::normalize(D3{0.95, 0.1, 0}));
    int through = 0, mirrored = 0;
    auto numbers = random_stream(7, Pass::user, 0, 0);
    for (int i = 0; i < 4000; ++i) {
        const auto u = next_3d<double>(numbers);
        const auto first = sample(coated, low.wo, u, Transport::radiance);
        REQUIRE(first);
        if (first->specular || to_world(low.frame, first->wi).y > 0) continue;
        ++through;
        CHECK_FALSE(scatter(low, coated, u, Transport::radiance));
        const auto flat = frame_around(D3{0, 1, 0});
        const D3 wo = to_local(flat, to_world(low.frame, low.wo));
        const auto own = sample(coated, wo, u, Transport::radiance);
        mirrored += own && own->specular;
    }
    CHECK(through > 50);
    CHECK(mirrored > 10);
    // Nor is the boundary, if by the surface's own normal the same numbers go to the
    // matt part: the path ends.
    int lost = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto u = next_3d<double>(numbers);
        const auto first = sample(coated, vertex.wo, u, Transport::radiance);
        if (!first || !first->specular || to_world(vertex.frame, first->wi).y > 0)
            continue;
        const auto flat = frame_around(D3{0, 1, 0});
        const auto own = sample(coated, to_local(flat, back), u, Transport::radiance);
        if (!own || own->specular) continue;
        ++lost;
        CHECK_FALSE(scatter(vertex, coated, u, Transport::radiance));
    }
    CHECK(lost > 10);
}

TEST_CASE("vertex: the numbers of a bounce are those of its place in the tree") {
    const auto world = slab();
    for (const int depth : {0, 7})
        for (const std::uint64_t branch :
             {std::uint64_t(0), std::uint64_t(1) << 20, std::uint64_t(3) << 44}) {
            auto stream = random_stream(4, Pass::user, 1, 2), twin = stream;
            for (int i = 0; i < 5; ++i) (void)next_1d<double>(stream);
            PathStateT<double> path{.ray{.origin{0, 0, 1}, .direction{0, 0, -1}},
                                    .depth = depth,
                                    .branch = branch};
            REQUIRE(next_vertex(world, path, stream));
            CHECK(path.branch == branch);
            start_bounce(twin, branch + std::uint64_t(depth) + 1);
            CHECK(next_1d<double>(stream) == next_1d<double>(twin));
        }
}

TEST_CASE("vertex: what stands in the way does so at its time") {
    // A wall that goes from x = 0 to x = 10; with and without a pane beyond it.
    const QuadT<double> wall{{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}};
    const QuadT<double> pane{{-30, -30, 2}, {60, 0, 0}, {0, 60, 0}};
    const ThinGlassT<double> clear{1, D3{1}}; // reflects nothing
    const auto check_in = [&](auto scene) {
        const auto matt = scene.add(LambertianT<double>{});
        scene.add(Moving<QuadT<double>>{wall, {10, 0, 0}}, matt);
        const World world(std::move(scene));
        for (const double time : {0.0, 0.25, 0.5, 1.0})
            for (const double x : {0.0, 2.5, 5.0, 10.0}) {
                const SurfacePointT<double> from{.position{x, 0, 0}, .normal{0, 0, 1}};
                const SurfacePointT<double> to{.position{x, 0, 3}, .normal{0, 0, -1}};
                const bool hidden = std::abs(x - 10 * time) < 1;
                CAPTURE(time);
                CAPTURE(x);
                CHECK(visibility(world, from, to, time).x ==
                      doctest::Approx(hidden ? 0 : 1));
                CHECK(visibility(world, to, from, time).x ==
                      doctest::Approx(hidden ? 0 : 1));
                auto stream = random_stream(4, Pass::user, 1, 2);
                PathStateT<double> path{
                    .ray{.origin{x, 0, 3}, .direction{0, 0, -1}, .time = time}};
                const auto vertex = next_vertex(world, path, stream);
                CHECK(vertex.has_value() == hidden);
                if (vertex) CHECK(vertex->time == time);
            }
    };
    check_in(Scene<Shapes<QuadT<double>, Moving<QuadT<double>>>,
                   Materials<LambertianT<double>>>{});
    Scene<Shapes<QuadT<double>, Moving<QuadT<double>>>,
          Materials<LambertianT<double>, ThinGlassT<double>>>
        with_pane;
    check_in(with_pane); // lists such a material, and has none
    with_pane.add(pane, with_pane.add(clear));
    check_in(with_pane);
}

TEST_CASE("vertex: a path and a vertex, before anything is known of them") {
    const PathStateT<double> path;
    CHECK(path.throughput == D3{1});
    CHECK(path.eta_scale == 1);
    CHECK(path.medium == D3{0});
    CHECK(path.pdf == 0);
    CHECK_FALSE(path.specular);
    CHECK_FALSE(path.met_diffuse);
    CHECK_FALSE(path.met_specular);
    CHECK(path.depth == 0);
    CHECK(path.branch == 0);
    const VertexT<double> vertex;
    CHECK(vertex.wo == D3{0, 0, 1});
    CHECK(vertex.medium == D3{0});
    CHECK(vertex.stop_probability == 1);
    CHECK_FALSE(vertex.smooth);
    CHECK_FALSE(vertex.turned);
    CHECK_FALSE(vertex.emits());
}

TEST_CASE("vertex: which of two normals decides what") {
    const D3 up{0, 1, 0}, lean = glm::normalize(D3{0.3, 1, 0});
    const auto seen = [&](const D3& direction, const D3& shading, bool inside_out) {
        VertexT<double> vertex;
        vertex.point.normal = up;
        vertex.object.inside_out = inside_out;
        detail::set_frame(vertex, RayT<double>{.direction = direction}, shading);
        vertex.wo = to_local(vertex.frame, -direction);
        return vertex;
    };
    for (const bool inside_out : {false, true}) {
        const double turn = inside_out ? -1 : 1;
        for (int i = 0; i < 72; ++i) {
            const double angle = (i + 0.5) / 36 * std::numbers::pi;
            const D3 direction{std::cos(angle), std::sin(angle), 0};
            const auto flat = seen(direction, up, inside_out);
            CHECK_FALSE(flat.smooth);
            CHECK_FALSE(flat.turned);
            CHECK(flat.point.normal == turn * up);
            CHECK(flat.frame.normal == turn * up);
            CHECK(detail::landing_factor(flat, direction) == 1);

            const auto vertex = seen(direction, lean, inside_out);
            const double by_own = glm::dot(direction, up),
                         by_lean = glm::dot(direction, lean);
            const bool turned = (by_own < 0) != (by_lean < 0);
            CAPTURE(i);
            CHECK(vertex.turned == turned);
            CHECK(vertex.smooth == !turned);
            CHECK(vertex.point.normal == turn * up);
            CHECK(vertex.frame.normal == turn * (turned ? up : lean));
            // No surface is seen from behind: wo tells the side of the surface's own.
            CHECK((vertex.wo.z < 0) == (turn * by_own > 0));
            CHECK(detail::landing_factor(vertex, direction) ==
                  doctest::Approx(turned ? 0 : std::abs(by_lean / by_own)));
            // Of another direction both say the same, above and below.
            for (int k = 0; k < 72; ++k) {
                const double other = (k + 0.5) / 36 * std::numbers::pi;
                const D3 way{std::cos(other), std::sin(other), 0};
                const bool one_side =
                    (glm::dot(way, up) < 0) == (glm::dot(way, lean) < 0);
                CHECK(detail::agrees(vertex, to_local(vertex.frame, way), way) ==
                      (turned || one_side));
            }
        }
    }
    CHECK(seen(-up, lean, false).smooth);
}

TEST_CASE("vertex: a material is what it is at that place") {
    // Two by two fields of a wall of 4 by 2, by the coordinates of the wall.
    using Paper = Textured<LambertianT<double>, CheckerT<double, UvMapT<double>>>;
    Scene<Shapes<QuadT<double>>, Materials<LambertianT<double>, Paper>> scene;
    scene.add(
        QuadT<double>{{5, 0, 0}, {4, 0, 0}, {0, 2, 0}},
        scene.add(Paper{{.albedo = D3{1}}, {.even{0.9, 0.8, 0.7}, .odd = D3{0.2}}}));
    const World world(std::move(scene));
    for (int i = 0; i < 64; ++i) {
        const int column = i % 8, row = i / 8;
        const RayT<double> ray{.origin{5 + (column + 0.3) / 2, (row + 0.3) / 4, 1},
                               .direction{0, 0, -1}};
        const auto vertex = vertex_at(world, ray, *closest_hit(world, ray));
        const D3 albedo = visit_material_at(world, vertex, [](const auto& material) {
            return std::numbers::pi * evaluate(material, D3{0, 0, 1}, D3{0.6, 0, 0.8});
        });
        const bool even = (column / 4 + row / 4) % 2 == 0;
        CHECK(glm::distance(albedo, even ? D3{0.9, 0.8, 0.7} : D3{0.2}) < 1e-12);
    }
}
