/// \file contacts_test.cpp
/// \brief Surfaces of different objects in one place: which one counts, in any order.
///
/// Means are held within 5 standard errors: a false alarm once in 1.7 million.

#include "ljus/scene/contacts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <vector>

#include "ljus/accel/mesh.hpp"
#include "ljus/geometry/cylinder.hpp"
#include "ljus/geometry/disc.hpp"
#include "ljus/geometry/moving.hpp"
#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/triangle.hpp"
#include "ljus/inspect/survey.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/plain_path_tracing.hpp"
#include "support/mean.hpp"
#include "support/slabs.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

template <typename T>
using Everything =
    Scene<Shapes<QuadT<T>, TriangleT<T>, SphereT<T>, MeshT<T>>,
          Materials<LambertianT<T>, GlassT<T>, MirrorT<T>, ThinGlassT<T>, MixtureT<T>>,
          Lights<SunLightT<T>>>;

using Rolling = Scene<
    Shapes<Quad, Sphere, Cylinder, Moving<Quad>, Moving<Sphere>, Moving<Cylinder>>,
    Materials<Lambertian, Glass>>;

/// The faces of a box, outwards, as triangles in a mesh.
template <typename T>
MeshT<T> box_mesh(const Vec3T<T>& low, const Vec3T<T>& high) {
    MeshDataT<T> data;
    for (int i = 0; i < 8; ++i)
        data.positions.push_back({(i & 1) != 0 ? high.x : low.x,
                                  (i & 2) != 0 ? high.y : low.y,
                                  (i & 4) != 0 ? high.z : low.z});
    const std::array<std::array<std::uint32_t, 4>, 6> sides{{{0, 2, 3, 1},
                                                             {4, 5, 7, 6},
                                                             {0, 1, 5, 4},
                                                             {2, 6, 7, 3},
                                                             {0, 4, 6, 2},
                                                             {1, 3, 7, 5}}};
    for (const auto& [a, b, c, d] : sides) {
        data.triangles.push_back({a, b, c});
        data.triangles.push_back({a, c, d});
    }
    return MeshT<T>(data);
}

/// What a ray sees of a lamp behind slabs, which add(scene) makes.
template <typename T>
Mean seen_through(const std::function<void(Everything<T>&)>& add, double degrees,
                  long long paths = 20000) {
    Everything<T> scene;
    add(scene);
    return seen_through_scene<T>(std::move(scene), degrees, paths);
}

/// The mean over the hemisphere of a function of the angle in degrees, weighted by the
/// cosine: what it does to diffuse light.
double for_diffuse_light(const std::function<double(double)>& f) {
    constexpr int steps = 20000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) { // uniform in sin^2
        const double sine = std::sqrt((i + 0.5) / steps);
        sum += f(std::asin(sine) * 180 / std::numbers::pi) / steps;
    }
    return sum;
}

/// The remarks of a survey.
template <typename S>
std::vector<std::string> remarks_of(S scene) {
    return survey(World(std::move(scene)), PhotonMappingSettings{}).remarks;
}

/// Adds glass, water, glass: slabs of thickness 1 in contact, from z = 3 down to 0.
template <typename T>
void add_three_slabs(Everything<T>& scene) {
    const auto glass = scene.add(GlassT<T>{T(1.5)});
    const auto water = scene.add(GlassT<T>{T(1.33)});
    scene.add(face(T(3), true), glass);
    scene.add(face(T(2), false), glass);
    scene.add(face(T(2), true), water);
    scene.add(face(T(1), false), water);
    scene.add(face(T(1), true), glass);
    scene.add(face(T(0), false), glass);
}

/// The same, made of closed meshes; from the last one to the first.
template <typename T>
void add_three_meshes(Everything<T>& scene) {
    const auto glass = scene.add(GlassT<T>{T(1.5)});
    const auto water = scene.add(GlassT<T>{T(1.33)});
    for (int i = 0; i < 3; ++i)
        scene.add(box_mesh<T>({-50, -50, T(i)}, {50, 50, T(i + 1)}),
                  i == 1 ? water : glass);
}

} // namespace

TEST_CASE("contacts: slabs of glass and water in contact, as the exact series") {
    for (const double degrees : {0.0, 40.0, 75.0}) {
        CAPTURE(degrees);
        const double right = transmittance_of({1, 1.5, 1.33, 1.5, 1}, degrees);
        const auto agrees = [&](const Mean& mean) {
            CAPTURE(mean.mean);
            CHECK(mean.agrees_with(right));
        };
        agrees(seen_through<float>(add_three_slabs<float>, degrees));
        agrees(seen_through<double>(add_three_slabs<double>, degrees));
        agrees(seen_through<float>(add_three_meshes<float>, degrees));
        agrees(seen_through<double>(add_three_meshes<double>, degrees));
    }
    CHECK(transmittance_of({1, 1.5, 1.33, 1.5, 1}, 40) ==
          doctest::Approx(0.90613).epsilon(1e-5));
}

TEST_CASE("contacts: slabs in contact far from the origin and tilted") {
    // The corners are rounded, each slab's in its own way.
    const auto add = [](Everything<float>& scene) {
        const auto glass = scene.add(Glass{1.5f}), water = scene.add(Glass{1.33f});
        const Vec3 normal = glm::normalize(Vec3{0.3f, -0.2f, 1});
        const Vec3 x = glm::normalize(glm::cross(normal, Vec3{0, 1, 0}));
        const Vec3 y = glm::cross(normal, x);
        const auto plane = [&](float height, bool up, float half, MaterialId material) {
            const Vec3 corner = height * normal - half * x - half * y;
            const Vec3 u = 2 * half * x, v = 2 * half * y;
            scene.add(up ? Quad{corner, u, v} : Quad{corner, v, u}, material);
        };
        plane(1.7f, true, 31, glass);
        plane(0.9f, false, 31, glass);
        plane(0.9f, true, 17, water);
        plane(0.1f, false, 17, water);
    };
    const Vec3 normal = glm::normalize(Vec3{0.3f, -0.2f, 1});
    const double degrees = std::acos(double(normal.z)) * 180 / std::numbers::pi;
    const Mean mean = seen_through<float>(add, 0);
    CAPTURE(mean.mean);
    CHECK(mean.agrees_with(transmittance_of({1, 1.5, 1.33, 1}, degrees)));
}

TEST_CASE("contacts: two slabs of one glass are one, and absorb each by its own law") {
    const auto add = [](Everything<double>& scene) {
        const auto lower = scene.add(GlassT<double>{1.5, RgbT<double>{0.5}});
        const auto upper = scene.add(GlassT<double>{1.5, RgbT<double>{1.0}});
        scene.add(face(1.0, false), lower);
        scene.add(face(2.0, true), lower);
        scene.add(face(2.0, false), upper);
        scene.add(face(3.0, true), upper);
    };
    const double r = 0.04, t = std::exp(-1.5);
    const Mean mean = seen_through<double>(add, 0, 40000);
    CAPTURE(mean.mean);
    CHECK(mean.agrees_with((1 - r) * (1 - r) * t / (1 - r * r * t * t)));
}

TEST_CASE("contacts: a path that begins in a stack of bodies knows its medium") {
    Everything<float> scene;
    const auto grey = scene.add(Lambertian{});
    const auto upper = scene.add(Glass{1.5f, Rgb{1}}),
               lower = scene.add(Glass{1.3f, Rgb{2}});
    scene.add(face(0.0f, true), grey);       // the floor
    scene.add(face(2.0f, true, 1.0f), grey); // a sticker on the top
    scene.add(box_mesh<float>({-2, -2, 1}, {2, 2, 2}), upper);
    scene.add(box_mesh<float>({-2, -2, 0}, {2, 2, 1}), lower);
    const World world(std::move(scene));
    for (const float x : {0.3f, 1.4f}) // below the sticker, and beside it
        for (const float side : {-1.0f, 1.0f}) {
            const auto medium = [&](float z) {
                return medium_at(world,
                                 Ray{.origin{x, 0.2f, z}, .direction{0, 0, side}})
                    .x;
            };
            CHECK(medium(3) == 0);
            CHECK(medium(1.5f) == 1);
            CHECK(medium(0.5f) == 2);
            CHECK(medium(-1) == 0);
        }
}

TEST_CASE("contacts: glass that rests on a floor, and glass a little above it") {
    // Under a sky of radiance 1. Diffuse light enters glass by 1 - F_out, and of what
    // the floor sends up F_in comes back.
    const double rho = 0.5, n2 = 2.25;
    const double f_out =
        for_diffuse_light([](double a) { return reflectance(1, 1.5, a); });
    const double f_in = 1 - (1 - f_out) / n2;
    const double contact = 0.04 + 0.96 / n2 * rho * (1 - f_out) / (1 - rho * f_in);
    const double through = for_diffuse_light([](double a) {
        return transmittance_of({1, 1.5, 1}, a);
    });
    const double straight = transmittance_of({1, 1.5, 1}, 0);
    const double gap =
        1 - straight + straight * rho * through / (1 - rho * (1 - through));
    CHECK(std::abs(contact - gap) > 0.05);

    const auto seen = [&]<typename T>(T lifted, bool floor_first) {
        Everything<T> scene;
        const auto grey = scene.add(LambertianT<T>{RgbT<T>{T(rho)}});
        const auto black = scene.add(LambertianT<T>{RgbT<T>{0}});
        const auto glass = scene.add(GlassT<T>{});
        const auto add_floor = [&] { scene.add(face(T(0), true), grey); };
        if (floor_first) add_floor();
        scene.add(face(lifted, false), glass);
        scene.add(face(lifted + T(0.1), true), glass);
        if (!floor_first) add_floor();
        scene.add(SphereT<T>{{0, 0, 0}, 1000}, black, RgbT<T>{1}, true);
        const World world(std::move(scene));
        const PathTracer tracer(world);
        return mean_radiance(tracer, 40000, 3,
                             [](const auto&) { return ray_at<T>(0); });
    };
    const auto agrees = [](const Mean& mean, double right) {
        CAPTURE(mean.mean);
        CAPTURE(right);
        CHECK(mean.agrees_with(right, 2e-3)); // the slab is not infinite
    };
    for (const bool floor_first : {false, true}) {
        agrees(seen(0.0f, floor_first), contact);
        agrees(seen(0.0, floor_first), contact);
        agrees(seen(1e-4f, floor_first), gap);
        agrees(seen(1e-4, floor_first), gap);
    }
}

TEST_CASE("contacts: photons through glass that rests on a floor, under a sun") {
    // E = 2 of the sun enters with 0.96; the floor and the glass send it to and fro.
    const double f_out =
        for_diffuse_light([](double a) { return reflectance(1, 1.5, a); });
    const double f_in = 1 - (1 - f_out) / 2.25;
    const double right =
        2 * 0.96 / std::numbers::pi * 0.5 * 0.96 / 2.25 / (1 - 0.5 * f_in);
    CHECK(right == doctest::Approx(0.1858).epsilon(1e-3));
    for (const bool floor_first : {false, true}) {
        Everything<float> scene;
        const auto grey = scene.add(Lambertian{Rgb{0.5f}}), glass = scene.add(Glass{});
        const auto add_floor = [&] { scene.add(face(0.0f, true, 3.0f), grey); };
        if (floor_first) add_floor();
        scene.add(box_mesh<float>({-2.5f, -2.5f, 0}, {2.5f, 2.5f, 0.02f}), glass);
        if (!floor_first) add_floor();
        scene.add(SunLight{.direction{0, 0, -1}, .irradiance = Rgb{2}});
        const World world(std::move(scene));
        PhotonMappingSettings settings;
        settings.caustics.photons = 200000;
        settings.caustics_estimate.radius = 0.3f;
        const PhotonMapper mapper(world, settings);
        const Mean mean = mean_radiance(mapper, 2000, 5, [](auto& stream) {
            const auto u = next_2d<float>(stream);
            return Ray{.origin{u.x - 0.5f, u.y - 0.5f, 5}, .direction{0, 0, -1}};
        });
        CAPTURE(mean.mean);
        CHECK(mean.mean ==
              doctest::Approx(right).epsilon(0.02)); // photons, and the rim
    }
}

TEST_CASE("contacts: a lamp in the plane of the ceiling shines as one below it") {
    const Quad lamp = face(2.0f, false, 0.5f);
    const double right =
        0.5 * double(*form_factor_from(Vec3{0, 0, 0}, Vec3{0, 0, 1}, lamp, false));
    for (const bool lamp_first : {false, true}) {
        Everything<float> scene;
        const auto black = scene.add(Lambertian{Rgb{0}});
        const auto grey = scene.add(Lambertian{Rgb{0.5f}});
        const auto add_lamp = [&] { scene.add(lamp, black, Rgb{1}); };
        if (lamp_first) add_lamp();
        scene.add(face(2.0f, false, 3.0f), black);
        scene.add(face(0.0f, true, 3.0f), grey);
        if (!lamp_first) add_lamp();
        const World world(std::move(scene));
        const auto agrees = [&](const auto& tracer) {
            const Mean mean = mean_radiance(tracer, 20000, 9, [](const auto&) {
                return Ray{.origin{0, 0, 1}, .direction{0, 0, -1}};
            });
            CAPTURE(mean.mean);
            CHECK(mean.agrees_with(right));
        };
        agrees(PathTracer(world));
        agrees(PathTracer(world, {.sample_lights = false}));
        agrees(PathTracer(world, {.heuristic = MisHeuristic::shadow_rays}));
        agrees(PlainPathTracer(world));
        const auto up =
            closest_hit(world, Ray{.origin{0, 0, 1}, .direction{0.1f, 0, 1}});
        REQUIRE(up);
        CHECK(!is_black(world.object(up->object).emission));
        const auto beside =
            closest_hit(world, Ray{.origin{0, 0, 1}, .direction{1, 0, 1}});
        REQUIRE(beside);
        CHECK(is_black(world.object(beside->object).emission));
    }
}

TEST_CASE(
    "contacts: a disc in the plane of other surfaces, and the end of a cylinder") {
    using Round = Scene<Shapes<Quad, Disc, Cylinder>, Materials<Lambertian, Glass>>;
    const auto material_at = [](bool turned, const auto& one, const auto& other,
                                const Vec3& from) {
        Round scene;
        const std::array known{scene.add(Lambertian{Rgb{0.5f}}),
                               scene.add(Lambertian{Rgb{0.2f}})};
        const auto glass = scene.add(Glass{1.5f});
        if (turned) other(scene, known, glass);
        one(scene, known, glass);
        if (!turned) other(scene, known, glass);
        const World world(std::move(scene));
        const auto hit = closest_hit(world, Ray{.origin = from, .direction{0, 0, -1}});
        REQUIRE(hit);
        return world.object(hit->object).material;
    };
    const auto floor = [](auto& scene, const auto& known, auto) {
        scene.add(face(0.0f, true, 3.0f), known[0]);
    };
    // A rug, slanted towards no axis, and a lamp that looks down on a ceiling's outside.
    const auto rug = [](auto& scene, const auto& known, auto) {
        scene.add(Disc{.center{0.3f, 0, 0}, .radius = 0.5f}, known[1]);
    };
    const auto lamp = [](auto& scene, const auto& known, auto) {
        scene.add(Disc{.center{0.3f, 0, 0}, .normal{0, 0, 2}, .radius = 4}, known[1],
                  Rgb{1});
    };
    // A glass: a tube with an end in the plane of the floor.
    const auto tube = [](auto& scene, const auto&, auto glass) {
        scene.add(Cylinder{.axis{0, 0, 1}, .radius = 1}, glass);
        scene.add(Disc{.normal{0, 0, -1}, .radius = 1}, glass);
        scene.add(Disc{.center{0, 0, 1}, .radius = 1}, glass);
    };
    for (const bool turned : {false, true}) {
        const MaterialId grey{0, 0}, dark{0, 1};
        CHECK(material_at(turned, floor, rug, {0.79f, 0, 1}) == dark);
        CHECK(material_at(turned, floor, rug, {0.81f, 0, 1}) == grey);
        CHECK(material_at(turned, floor, lamp, {2, 2, 1}) == dark);
        CHECK(material_at(turned, floor, tube, {0.5f, 0, 0.5f}) == grey);
        CHECK(material_at(turned, floor, tube, {0.5f, 0, 1.5f}) == MaterialId{1, 0});
    }
}

TEST_CASE("contacts: what slides over a surface is met where it is at that time") {
    using Sliding = Scene<Shapes<Quad, Moving<Quad>>, Materials<Lambertian>>;
    for (const float up : {0.0f, 0.5f}) // a rug, and what is lifted off the floor
        for (const bool turned : {false, true}) {
            Sliding scene;
            const auto grey = scene.add(Lambertian{Rgb{0.5f}});
            const auto dark = scene.add(Lambertian{Rgb{0.2f}});
            const Moving<Quad> rug{.shape = face(0.0f, true, 1.0f),
                                   .displacement{2, 1, up}};
            if (turned) scene.add(rug, dark);
            scene.add(face(0.0f, true, 9.0f), grey);
            if (!turned) scene.add(rug, dark);
            const World world(std::move(scene));
            CHECK(world.contacts().pairs.size() == (up == 0 ? 1 : 0));
            std::string remarks;
            for (const std::string& remark : scene_remarks(world, {}))
                remarks += remark;
            CHECK((remarks.find("such as Quad 0 and moving Quad 0 around (") !=
                   std::string::npos) == (up == 0));
            for (const float time : {0.25f, 0.5f, 1.0f})
                for (const float x : {-0.99f, 0.99f, 1.01f}) {
                    const auto hit =
                        closest_hit(world, Ray{.origin{2 * time + x, time, 2},
                                               .direction{0, 0, -1},
                                               .time = time});
                    REQUIRE(hit);
                    CHECK((world.object(hit->object).material == dark) == (x < 1));
                }
        }
}

TEST_CASE("contacts: no order of a list changes what a path finds") {
    // A floor with a rug, a slab of glass and a block of water on it, and a lamp in the
    // plane of the ceiling.
    std::array<int, 7> order{};
    std::iota(order.begin(), order.end(), 0);
    std::vector<Rgb> first;
    int different = 0, permutations = 0;
    do {
        Everything<float> scene;
        const auto black = scene.add(Lambertian{Rgb{0}});
        const auto grey = scene.add(Lambertian{Rgb{0.5f}});
        const auto red = scene.add(Lambertian{Rgb{0.8f, 0.1f, 0.1f}});
        const auto glass = scene.add(Glass{1.5f}), water = scene.add(Glass{1.33f});
        for (const int what : order) {
            if (what == 0) scene.add(face(0.0f, true, 3.0f), grey);
            if (what == 1) scene.add(face(0.0f, true, 1.0f), red);
            if (what == 2) scene.add(face(0.0f, false, 2.0f), glass);
            if (what == 3) scene.add(face(0.5f, true, 2.0f), glass);
            if (what == 4) scene.add(box_mesh<float>({-1, -1, 0.5f}, {1, 1, 1}), water);
            if (what == 5) scene.add(face(3.0f, false, 3.0f), grey);
            if (what == 6) scene.add(face(3.0f, false, 1.0f), black, Rgb{1});
        }
        const World world(std::move(scene));
        const PathTracer tracer(world);
        std::vector<Rgb> found;
        for (std::uint64_t path = 0; path < 6; ++path) {
            auto stream = random_stream(1, Pass::camera, 0, path);
            Counts counts;
            auto context = context_of(stream, counts);
            const Ray ray{.origin{0.4f * float(path), 0.1f, 2},
                          .direction = glm::normalize(Vec3{0.1f, 0.2f, -1})};
            found.push_back(radiance(tracer, ray, context));
            const auto fast = closest_hit(world, ray),
                       plain = closest_hit_plain(world, ray);
            CHECK((fast && plain && fast->object == plain->object));
        }
        if (first.empty()) first = found;
        different += found != first ? 1 : 0;
        ++permutations;
    } while (std::next_permutation(order.begin(), order.end()));
    CHECK(permutations == 5040);
    CHECK(different == 0);
}

TEST_CASE("contacts: balls that touch, in both orders") {
    for (const bool turned : {false, true}) {
        // A ball of glass touches a lamp: without air between them.
        Everything<float> scene;
        const auto black = scene.add(Lambertian{Rgb{0}}), glass = scene.add(Glass{});
        const auto add_lamp = [&] { scene.add(Sphere{{-1, 0, 0}, 1}, black, Rgb{1}); };
        if (turned) add_lamp();
        scene.add(Sphere{{1, 0, 0}, 1}, glass);
        if (!turned) add_lamp();
        const World world(std::move(scene));
        const PathTracer tracer(world, {.roulette_depth = 1000});
        const Mean mean = mean_radiance(tracer, 20000, 11, [](const auto&) {
            return Ray{.origin{5, 0, 0}, .direction{-1, 0, 0}};
        });
        CHECK(mean.agrees_with(0.96 / 2.25));
        CHECK(survey(world, PhotonMappingSettings{}).remarks.empty());
    }
    const auto met = [](bool turned, const Ray& ray) { // two matt balls, or none
        Everything<float> scene;
        const auto red = scene.add(Lambertian{Rgb{0.5f, 0, 0}});
        const auto blue = scene.add(Lambertian{Rgb{0, 0, 0.6f}});
        if (turned) scene.add(Sphere{{-1, 0, 0}, 1}, red);
        scene.add(Sphere{{1, 0, 0}, 1}, blue);
        if (!turned) scene.add(Sphere{{-1, 0, 0}, 1}, red);
        const World world(std::move(scene));
        const auto hit = closest_hit(world, ray);
        return hit ? int(world.object(hit->object).material.index) : -1;
    };
    const Ray tangent{.origin{0, 0, 5}, .direction{0, 0, -1}};
    CHECK(met(false, tangent) == met(true, tangent));
    const Ray beside{.origin{0.01f, 0, 5}, .direction{0, 0, -1}};
    CHECK(met(false, beside) == 1);
    CHECK(met(true, beside) == 1);
}

TEST_CASE("contacts: a ball of water that fills a shell of glass") {
    const auto add = [](Everything<double>& scene) {
        const auto glass = scene.add(GlassT<double>{1.5});
        const auto water = scene.add(GlassT<double>{1.33});
        scene.add(SphereT<double>{{0, 0, 0}, 1}, water);
        scene.add(SphereT<double>{{0, 0, 0}, 1}, glass, {}, true);
        scene.add(SphereT<double>{{0, 0, 0}, 2}, glass);
    };
    const Mean mean = seen_through<double>(add, 0);
    CAPTURE(mean.mean);
    CHECK(mean.agrees_with(transmittance_of({1, 1.5, 1.33, 1.5, 1}, 0)));
}

TEST_CASE("contacts: water in a tube of glass, at rest and in motion") {
    const Cylinder inner{{0, -20, 0}, {0, 40, 0}, 1}, outer{{0, -20, 0}, {0, 40, 0}, 2};
    const double right = transmittance_of({1, 1.5, 1.33, 1.5, 1}, 0);
    for (const bool turned : {false, true})
        for (const bool moves : {false, true}) {
            Rolling scene;
            const auto glass = scene.add(Glass{1.5f}), water = scene.add(Glass{1.33f});
            // All of it together; rays are of time 0.
            const auto add = [&](const Cylinder& tube, MaterialId of, bool inside_out) {
                if (moves)
                    scene.add(Moving<Cylinder>{tube, {1, 0, 3}}, of, {}, inside_out);
                else
                    scene.add(tube, of, {}, inside_out);
            };
            if (turned) add(inner, glass, true);
            add(inner, water, false);
            if (!turned) add(inner, glass, true);
            add(outer, glass, false);
            const Mean mean = seen_through_scene<float>(std::move(scene), 0);
            CAPTURE(turned);
            CAPTURE(moves);
            CAPTURE(mean.mean);
            CHECK(mean.agrees_with(right));
        }
}

TEST_CASE("contacts: balls that move together are met as one at rest") {
    for (const bool turned : {false, true})
        for (const float apart : {0.0f, 0.5f}) {
            Rolling scene;
            const auto glass = scene.add(Glass{1.5f}), water = scene.add(Glass{1.33f});
            const Moving<Sphere> ball{{{0, 0, 0}, 1}, {8, 0, 2}};
            const Moving<Sphere> other{{{0, 0, 0}, 1}, {8, apart, 2}};
            if (turned) scene.add(ball, glass, {}, true);
            scene.add(other, water);
            if (!turned) scene.add(ball, glass, {}, true);
            const World world(std::move(scene));
            REQUIRE(world.contacts().pairs.size() == (apart == 0 ? 1 : 0));
            for (const float time : {0.0f, 0.5f, 1.0f}) {
                if (apart != 0) continue; // they are in one place for an instant
                const Ray ray{.origin{8 * time + 0.3f, 0.2f, 20},
                              .direction{0, 0, -1},
                              .time = time};
                const auto hit = closest_hit(world, ray);
                REQUIRE(hit);
                const auto place = place_of(world, ray, *hit);
                CHECK(place.met.shared);
                CHECK(place.left == glass);
                CHECK(place.entered == water);
            }
        }
}

TEST_CASE("contacts: cylinders and moving balls that touch in a line or a point") {
    using Add = std::function<void(Rolling&, MaterialId)>;
    struct Met {
        std::size_t pairs = 0;
        bool over_area = false;
        Vec3 low{0}, high{0};
    };
    const auto met = [](const Add& one, const Add& other) {
        std::array<Met, 2> is;
        for (std::size_t turned = 0; turned < 2; ++turned) {
            Rolling scene;
            const auto glass = scene.add(Glass{}), water = scene.add(Glass{1.33f});
            if (turned != 0) other(scene, water);
            one(scene, glass);
            if (turned == 0) other(scene, water);
            const World world(std::move(scene));
            const auto& pairs = world.contacts().pairs;
            if (!pairs.empty())
                is[turned] = {pairs.size(), pairs[0].over_area, Vec3(pairs[0].box.low),
                              Vec3(pairs[0].box.high)};
        }
        CHECK(is[0].pairs == is[1].pairs);
        CHECK(is[0].over_area == is[1].over_area);
        return is[0];
    };
    // Whether it is a small neighbourhood of a line or a point.
    const auto narrow = [](const Met& is, const Vec3& low, const Vec3& high) {
        return is.pairs == 1 && !is.over_area &&
               max_component(glm::abs(is.low - low)) < 0.05f &&
               max_component(glm::abs(is.high - high)) < 0.05f;
    };
    const auto shape = [](const auto& of) -> Add {
        return [of](Rolling& scene, MaterialId material) { scene.add(of, material); };
    };
    const auto moving = [&]<typename G>(const G& of, const Vec3& way) -> Add {
        return shape(Moving<G>{of, way});
    };
    const auto tube = [](float x, float y, float z) {
        return Cylinder{{x, y, z}, {3, 0, 0}, 1};
    };
    const Quad floor = face(0.0f, true, 9.0f);
    const Sphere ball{{0, 0, 1}, 1};
    CHECK(narrow(met(shape(floor), shape(tube(0, 0, 1))), {0, 0, 0}, {3, 0, 0}));
    CHECK(met(shape(floor), shape(tube(0, 0, 1.01f))).pairs == 0);
    CHECK(met(shape(floor), shape(Cylinder{{0, 0, 1}, {3, 0, 1}, 0.5f})).pairs == 0);
    // A ball that rolls over the floor, and one that is lifted; a floor beneath a ball;
    // both together in a lift.
    CHECK(narrow(met(shape(floor), moving(ball, {4, 2, 0})), {0, 0, 0}, {4, 2, 0}));
    CHECK(met(shape(floor), moving(ball, {4, 2, 1})).pairs == 0);
    CHECK(narrow(met(moving(floor, {4, 2, 0}), shape(ball)), {0, 0, 0}, {0, 0, 0}));
    CHECK(narrow(met(moving(floor, {1, 0, 5}), moving(ball, {1, 0, 5})), {0, 0, 0},
                 {1, 0, 5}));
    // A tile that slides onto another one, and one that does not come so far.
    const Quad tile = face(0.0f, true, 1.0f), beside = translated(tile, {5, 0, 0});
    CHECK(met(shape(tile), moving(beside, {-5, 0, 0})).over_area);
    CHECK(met(shape(tile), moving(beside, {-2, 0, 0})).pairs == 0);
    // Side by side; a ball on a cylinder, and beyond its end; a rod on a tube's inside.
    CHECK(
        narrow(met(shape(tube(0, 0, 1)), shape(tube(2, 2, 1))), {2, 1, 1}, {3, 1, 1}));
    CHECK(narrow(met(shape(tube(-1, 2, 1)), shape(ball)), {0, 1, 1}, {0, 1, 1}));
    CHECK(met(shape(tube(1, 2, 1)), shape(ball)).pairs == 0);
    CHECK(met(shape(Cylinder{{0, 0, 0.5f}, {3, 0, 0}, 0.5f}), shape(tube(0, 0, 1)))
              .pairs == 1);
    // A rod in a tube, also one that slides; end to end; one that is turned.
    CHECK(met(shape(tube(0, 0, 1)), shape(tube(1, 0, 1))).over_area);
    CHECK(met(shape(tube(0, 0, 1)), moving(tube(5, 0, 1), {-3, 0, 0})).over_area);
    CHECK(met(shape(tube(0, 0, 1)), moving(tube(5, 0, 1), {-1, 0, 0})).pairs == 0);
    CHECK(met(shape(tube(0, 0, 1)), shape(tube(3, 0, 1))).pairs == 0);
    CHECK(met(shape(tube(0, 0, 1)), shape(Cylinder{{0, 0, 1}, {3, 1, 0}, 1})).pairs ==
          0);
}

TEST_CASE("contacts: which of two surfaces counts") {
    // Seen from above and from below, in both orders.
    const auto met = [](const auto& add_one, const auto& add_other) {
        std::vector<ObjectId> seen;
        std::vector<MaterialId> materials;
        for (const bool turned : {false, true})
            for (const float side : {-1.0f, 1.0f}) {
                Everything<float> scene;
                const std::array known{
                    scene.add(Lambertian{Rgb{0.5f}}),
                    scene.add(Lambertian{Rgb{0.7f}}),
                    scene.add(Glass{1.5f}),
                    scene.add(Glass{1.3f}),
                    scene.add(ThinGlass{}),
                    scene.add(Mixture{.transparency = 0}),
                    scene.add(Mixture{.transparency = 1, .index = 1.4f})};
                if (turned) add_other(scene, known);
                add_one(scene, known);
                if (!turned) add_other(scene, known);
                const World world(std::move(scene));
                const auto hit = closest_hit(
                    world, Ray{.origin{0.1f, 0.2f, -side}, .direction{0, 0, side}});
                REQUIRE(hit);
                materials.push_back(world.object(hit->object).material);
                CHECK(world.contacts().pairs.size() == 1);
                CHECK(materials.back() == materials.front());
            }
        return materials.front();
    };
    const auto flat = [](std::size_t material, float half = 1, bool up = true,
                         Rgb light = {}) {
        return [=](auto& scene, const auto& known) {
            scene.add(face(0.0f, up, half), known[material], light);
        };
    };
    const MaterialId dark{0, 0}, bright{0, 1}, dense{1, 0}, mixture{4, 0}, water{1, 1};
    CHECK(met(flat(0), flat(1)) == bright);     // equal areas: the brighter
    CHECK(met(flat(0, 0.5f), flat(1)) == dark); // the smaller
    CHECK(met(flat(0, 0.5f, false), flat(1)) == dark);
    CHECK(met(flat(0, 2, true, Rgb{1}), flat(1)) == dark); // the lamp
    CHECK(met(flat(0), flat(2)) == dark);                  // what is opaque
    CHECK(met(flat(5), flat(2)) == mixture);
    CHECK(met(flat(2), flat(3, 2)) == dense); // the denser
    CHECK(met(flat(4), flat(3, 2)) == water); // a pane has no effect
    CHECK(met(flat(4), flat(0, 2)) == dark);
    const auto triangle = [](auto& scene, const auto& known) {
        scene.add(Triangle{{-1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, known[0]);
    };
    CHECK(met(triangle, flat(1, 2)) == dark);
}

TEST_CASE("contacts: what only shares an edge, a corner or a box is none") {
    const auto count = [](const auto& add) {
        Everything<float> scene;
        add(scene, scene.add(Glass{}), scene.add(Lambertian{}));
        return World(std::move(scene)).contacts().pairs.size();
    };
    const auto quad = [](Vec3 corner, Vec3 u, Vec3 v) { return Quad{corner, u, v}; };
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, zero{0};
    CHECK(count([&](auto& s, auto a, auto b) { // side by side
              s.add(quad(zero, x, y), a), s.add(quad(x, x, y), b);
          }) == 0);
    CHECK(count([&](auto& s, auto a, auto b) { // at a right angle
              s.add(quad(zero, x, y), a), s.add(quad(zero, x, z), b);
          }) == 0);
    CHECK(count([&](auto& s, auto a, auto b) { // through each other
              s.add(quad(zero, x, y), a);
              s.add(quad(0.5f * x + 0.25f * y - 0.5f * z, 0.5f * y, z), b);
          }) == 0);
    CHECK(count([&](auto& s, auto a, auto b) { // the same at half a right angle
              s.add(quad(zero, x, y), a);
              s.add(quad(0.25f * (x + y - z), 0.5f * y, 0.5f * (x + z)), b);
          }) == 0);
    CHECK(count([&](auto& s, auto a, auto b) { // two triangles of a square
              s.add(Triangle{zero, x, y}, a), s.add(Triangle{x, x + y, y}, b);
          }) == 0);
    CHECK(count([&](auto& s, auto a, auto b) { // above each other
              s.add(quad(zero, x, y), a), s.add(quad(1e-5f * z, x, y), b);
          }) == 0);
    CHECK(count([&](auto& s, auto a, auto b) { // they overlap by a little
              s.add(quad(zero, x, y), a), s.add(quad(0.999f * x, x, y), b);
          }) == 1);
    CHECK(count([&](auto& s, auto a, auto b) { // a ball on a plane, and one in it
              s.add(quad(-2.0f * x - 2.0f * y, 4.0f * x, 4.0f * y), a);
              s.add(Sphere{z, 1}, b);
              s.add(Sphere{{0, 0, 0.5f}, 1}, b);
          }) == 1);
    CHECK(count([&](auto& s, auto a, auto b) { // one ball in another
              s.add(Sphere{zero, 2}, a), s.add(Sphere{z, 1}, b);
          }) == 1);
    CHECK(count([&](auto& s, auto, auto b) { // of one opaque material
              s.add(quad(zero, x, y), b), s.add(quad(zero, x, y), b);
          }) == 0);
}

TEST_CASE("contacts: a search among thousands finds what a loop finds") {
    // Tiles of two materials over tiles of glass, with balls on them.
    Everything<float> scene;
    const std::array matt{scene.add(Lambertian{Rgb{0.3f}}), scene.add(Lambertian{})};
    const auto glass = scene.add(Glass{});
    constexpr int side = 30;
    for (int i = 0; i < side * side; ++i) {
        const float x = float(i % side), y = float(i / side);
        scene.add(Quad{{x, y, 0}, {1, 0, 0}, {0, 1, 0}}, matt[std::size_t(i) % 2]);
        scene.add(Quad{{x + 0.5f, y, 0}, {0, 1, 0}, {1, 0, 0}}, glass);
        scene.add(Sphere{{x + 0.25f, y + 0.5f, 0.2f}, 0.2f}, matt[0]);
    }
    const World world(std::move(scene));
    // Each tile of glass lies over two others, the last of a row over one. Balls stand
    // on tiles, half of which are of their own material, and on glass, except for the
    // first of a row.
    constexpr std::size_t tiles = side * side, rows = side;
    CHECK(world.contacts().pairs.size() ==
          (2 * tiles - rows) + tiles / 2 + tiles - rows);
    CHECK(world.contacts().complete);
}

TEST_CASE("contacts: the neighbours of an object are found by a tree") {
    // A row of boxes that overlap the next one, each with a look of its own, except that
    // every third shares that of the one before.
    std::vector<Box> boxes;
    std::vector<std::uint32_t> looks;
    constexpr std::uint32_t count = 20000;
    for (std::uint32_t i = 0; i < count; ++i) {
        const float x = float(i) / count;
        boxes.push_back({{x, 0, 0}, {x + 1.2f / count, 1, 1}});
        looks.push_back(i % 3 == 2 ? i - 1 : i);
    }
    const detail::LookTree tree(boxes, looks);
    long long budget = 100 * count; // nodes; a comparison of all pairs is 2e8 each way
    bool right = true;
    for (std::uint32_t i = 0; i < count; ++i) {
        std::vector<std::uint32_t> found, expected;
        const auto list = [&](std::uint32_t k) { found.push_back(k); };
        right &= tree.each_overlap(i, budget, list);
        if (i > 0 && i % 3 != 2) expected.push_back(i - 1);
        if (i + 1 < count && i % 3 != 1) expected.push_back(i + 1);
        std::sort(found.begin(), found.end());
        right &= found == expected;
    }
    CHECK(right);
    long long spent = 0;
    const auto ignore = [](std::uint32_t) {};
    CHECK(!tree.each_overlap(0, spent, ignore));
}

TEST_CASE("contacts: the survey says what lies in one place, and which rule decides") {
    const auto remarks = [](const auto& add) {
        Everything<float> scene;
        const auto grey = scene.add(Lambertian{});
        scene.add(Sphere{{0, 0, 9}, 1}, grey, Rgb{1});
        add(scene, grey);
        return remarks_of(std::move(scene));
    };
    const auto said = [&](const char* what, const auto& add) {
        const auto all = remarks(add);
        REQUIRE(all.size() == 1);
        CAPTURE(all[0]);
        CHECK(all[0].find(what) != std::string::npos);
    };
    CHECK(remarks([](auto& s, auto grey) { // a box on the floor, and a ball
              s.add(face(0.0f, true), grey);
              s.add(box_mesh<float>({0, 0, 0}, {1, 1, 1}), s.add(Mirror{}));
              s.add(Sphere{{-3, 0, 1}, 1}, s.add(Glass{}));
          })
              .empty());
    said("Mesh 0 around (0, 0, 0): light passes from the body to the opaque surface",
         [](auto& s, auto grey) {
             s.add(face(0.0f, true, 9.0f), grey);
             s.add(box_mesh<float>({-1, -1, 0}, {1, 1, 1}), s.add(Glass{}));
         });
    said("1 pair(s) of objects have surfaces in one place, such as Quad 0 and Quad 1",
         [](auto& s, auto grey) {
             s.add(face(0.0f, true, 1.0f), s.add(Mirror{}));
             s.add(face(0.0f, true, 9.0f), grey);
         });
    said("from one body into the other", [](auto& s, auto) {
        s.add(face(0.0f, false), s.add(Glass{}));
        s.add(face(0.0f, true), s.add(Glass{1.2f}));
    });
    said("of the higher index", [](auto& s, auto) {
        s.add(face(0.0f, true), s.add(Glass{}));
        s.add(face(0.0f, true), s.add(Glass{1.2f}));
    });
    said("rays meet the lamp there", [](auto& s, auto grey) {
        s.add(face(0.0f, true), grey);
        s.add(face(0.0f, true, 1.0f), grey, Rgb{1});
    });
    said("shadow rays find both", [](auto& s, auto grey) {
        s.add(face(0.0f, true), grey, Rgb{2});
        s.add(face(0.0f, true, 1.0f), grey, Rgb{1});
    });
    said("has no effect", [](auto& s, auto grey) {
        s.add(face(0.0f, true), grey);
        s.add(face(0.0f, true, 1.0f), s.add(ThinGlass{}));
    });
}
