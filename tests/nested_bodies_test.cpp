/// \file nested_bodies_test.cpp
/// \brief Transparent bodies that overlap, by priority: against closed forms, and
/// against the same bodies without an overlap.
///
/// Means are held within 5 standard errors: a false alarm once in 1.7 million. Photons
/// are held against paths by Welch's t test: once in a million for each of two places.

#include "ljus/scene/nested_bodies.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/inspect/survey.hpp"
#include "ljus/lights/environment.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/materials/nested.hpp"
#include "ljus/materials/normal_map.hpp"
#include "ljus/materials/rough_glass.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "support/mean.hpp"
#include "support/slabs.hpp"
#include "support/student.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

template <typename T>
using Bodies =
    Scene<Shapes<QuadT<T>, SphereT<T>>,
          Materials<LambertianT<T>, MirrorT<T>, GlassT<T>, ThinGlassT<T>,
                    Nested<GlassT<T>>, Nested<RoughGlassT<T>>, Nested<MixtureT<T>>>,
          Lights<EnvironmentLightT<T>>>;

template <typename T>
Nested<GlassT<T>> nested(double index, int priority, double absorption = 0) {
    return {{.index = T(index), .absorption = RgbT<T>{T(absorption)}}, priority};
}

/// A sky that is bluer above.
template <typename T>
EnvironmentLightT<T> sky() {
    return {.picture = gradient_sky(RgbT<T>{T(1)}, RgbT<T>{T(1), T(1.5), T(2)},
                                    RgbT<T>{T(0.5)})};
}

/// Adds a wide slab.
template <typename T>
void add_slab(Bodies<T>& scene, double low, double high, MaterialId material) {
    scene.add(face(T(low), false), material);
    scene.add(face(T(high), true), material);
}

/// What a ray sees of a lamp of radiance 1 behind slabs.
template <typename T>
Mean seen_through(const std::function<void(Bodies<T>&)>& add, double degrees) {
    Bodies<T> scene;
    add(scene);
    return seen_through_scene<T>(std::move(scene), degrees);
}

/// Clear all over, so that light splits at it into a reflected and a refracted part.
template <typename M>
concept Splits = Refractive<std::remove_cvref_t<M>> &&
    requires(const std::remove_cvref_t<M>& m,
             Vec3T<typename std::remove_cvref_t<M>::Scalar> wo) {
    split(m, wo, Transport::flux);
};

/// A vertex of a path that always goes through.
struct Passed {
    double position, ratio; ///< x, and the index behind the vertex over that before.
    double absorption;      ///< Of the medium before it.
};

/// Follows a ray through all bodies, refracted at each of them.
template <AnyWorld W, std::floating_point T>
std::vector<Passed> pass_all(const W& world, PathStateT<T>& path) {
    std::vector<Passed> all;
    RandomStream stream{};
    while (const auto vertex = next_vertex(world, path, stream)) {
        const bool through = visit_material_at(world, *vertex, [&](const auto& m) {
            if constexpr (Splits<decltype(m)>) {
                const bool in = vertex->wo.z > T(0);
                const auto n = double(refractive_index(m));
                all.push_back({double(vertex->point.position.x), in ? n : 1 / n,
                               double(vertex->medium.x)});
                const auto both = split(m, vertex->wo, Transport::flux);
                if (!both) return false;
                detail::follow(path, *vertex, m, (*both)[1],
                               to_world(vertex->frame, (*both)[1].wi));
                return true;
            } else {
                return false;
            }
        });
        if (!through) break;
    }
    return all;
}

/// Water, a ball of glass that stands out of it, and a bubble where both overlap.
template <typename T>
Bodies<T> three_balls(const std::array<int, 3>& order = {0, 1, 2}) {
    Bodies<T> scene;
    for (const int which : order) {
        const auto add = [&](double x, double radius, const auto& material) {
            scene.add(SphereT<T>{{T(x), T(0), T(0)}, T(radius)}, scene.add(material));
        };
        if (which == 0) add(0, 1, nested<T>(1.33, 1, 0.1));
        if (which == 1) add(0.8, 0.5, nested<T>(1.5, 2, 0.2));
        if (which == 2) add(0.35, 0.2, nested<T>(1, 3));
    }
    return scene;
}

} // namespace

TEST_CASE("nested bodies: a list is in order, and keeps the highest eight") {
    BodyList list;
    CHECK(list.top() == 0);
    for (const int rank : {3, 7, 3, 1}) list = list.with(std::uint8_t(rank));
    CHECK(list == BodyList{{7, 3, 3, 1}});
    CHECK(list.without(3) == BodyList{{7, 3, 1}});
    CHECK(list.without(7).top() == 3);
    CHECK(list.without(2) == list);
    CHECK(list.has(1));
    CHECK_FALSE(list.has(2));
    BodyList full;
    for (std::uint8_t rank = 1; rank <= 9; ++rank) full = full.with(rank);
    CHECK(full == BodyList{{9, 8, 7, 6, 5, 4, 3, 2}});
    CHECK(full.with(1) == full);
    CHECK(full.without(2).ranks[7] == 0);
}

TEST_CASE("nested bodies: the boundaries along a ray") {
    const auto along = []<typename T>(const Bodies<T>& scene, T from) {
        const World world(scene);
        PathStateT<T> path{.ray{.origin{from, 0, 0}, .direction{1, 0, 0}}};
        return pass_all(world, path);
    };
    // Air, water, glass, bubble, glass, air; the end of the water is hidden, and so are
    // the parts of the glass and of the water in the bubble.
    const std::vector<Passed> right{
        {-1, 1.33, 0}, {0.15, 1 / 1.33, 0.1}, {0.55, 1.5, 0}, {1.3, 1 / 1.5, 0.2}};
    const auto agree = [](const std::vector<Passed>& found,
                          const std::vector<Passed>& expected) {
        REQUIRE(found.size() == expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            CAPTURE(i);
            CHECK(found[i].position ==
                  doctest::Approx(expected[i].position).epsilon(1e-6));
            CHECK(found[i].ratio == doctest::Approx(expected[i].ratio).epsilon(1e-6));
            CHECK(found[i].absorption ==
                  doctest::Approx(expected[i].absorption).epsilon(1e-6));
        }
    };
    agree(along(three_balls<float>(), -3.0f), right);
    agree(along(three_balls<double>(), -3.0), right);
    // A path may begin in any of them.
    agree(along(three_balls<double>(), 0.0), {right.begin() + 1, right.end()});
    agree(along(three_balls<double>(), 0.3), {right.begin() + 2, right.end()});
    agree(along(three_balls<double>(), 0.6), {right.begin() + 3, right.end()});
}

TEST_CASE("nested bodies: what a ray crosses, whatever was known") {
    const World world(three_balls<double>());
    const auto crossing = [&](double from, const BodyList& known) {
        const RayT<double> ray{.origin{from, 0, 0}, .direction{1, 0, 0}};
        return crossing_at(world, ray, closest_hit(world, ray).value(), known);
    };
    const std::uint8_t water = 1, glass = 2, bubble = 3;
    const auto into = crossing(0, BodyList{{water}}); // of the bubble
    CHECK(into.entered);
    CHECK(into.behind == BodyList{{bubble, water}});
    CHECK(into.outside() == water);
    const auto end = crossing(1.2, {}); // of the glass, which was not known
    CHECK_FALSE(end.hidden);
    CHECK_FALSE(end.entered);
    CHECK(end.before == BodyList{{glass}});
    CHECK(end.behind == BodyList{});
    CHECK(end.outside() == 0);
    CHECK(crossing(0.9, BodyList{{glass, water}}).hidden); // the end of the water
}

TEST_CASE("nested bodies: two of one material in contact") {
    Bodies<double> scene;
    const auto water = scene.add(nested<double>(1.33, 1));
    for (int i = 0; i < 3; ++i) add_slab(scene, i, i + 1, water);
    const World world(std::move(scene));
    for (const double z : {0.5, 1.5, 2.5})
        for (const double side : {-1.0, 1.0}) {
            const RayT<double> ray{.origin{0.3, 0.2, z}, .direction{0, 0, side}};
            CHECK(bodies_around(world, ray) == BodyList{{1}});
            PathStateT<double> path{.ray = ray};
            RandomStream stream{};
            const auto end = next_vertex(world, path, stream);
            REQUIRE(end); // the boundary to air, through those between
            CHECK(end->point.position.z == (side < 0 ? 0 : 3));
        }
}

TEST_CASE("nested bodies: no order of a list matters") {
    std::array<int, 3> order{0, 1, 2};
    std::vector<std::vector<Rgb>> pictures;
    do {
        auto scene = three_balls<float>(order);
        scene.add(sky<float>());
        const World world(std::move(scene));
        const auto camera = look_at({.position{0, -4, 1}, .target{0.2f, 0, 0}});
        const auto picture = render(PathTracer(world), camera,
                                    {.width = 16, .height = 16, .samples = 2});
        pictures.push_back(picture.image.pixels);
    } while (std::next_permutation(order.begin(), order.end()));
    REQUIRE(pictures.size() == 6);
    for (const auto& picture : pictures) CHECK(picture == pictures[0]);
}

TEST_CASE("nested bodies: water on glass and glass in water, as the exact series") {
    for (const double degrees : {0.0, 50.0}) {
        CAPTURE(degrees);
        const auto agrees = [&](const Mean& mean, double right) {
            CAPTURE(mean.mean);
            CHECK(mean.agrees_with(right));
        };
        const auto on_glass = [](auto& scene) {
            using T = typename std::remove_cvref_t<decltype(scene)>::Scalar;
            add_slab(scene, -0.3, 1, scene.add(nested<T>(1.33, 1, 0.5)));
            add_slab(scene, -1, 0, scene.add(nested<T>(1.5, 2, 0.25)));
        };
        const double on = transmittance_of({1, 1.33, 1.5, 1}, degrees, {0, 0.5, 0.25});
        agrees(seen_through<float>(on_glass, degrees), on);
        agrees(seen_through<double>(on_glass, degrees), on);
        agrees(seen_through<double>(
                   [](auto& scene) {
                       add_slab(scene, -0.3, 1,
                                scene.add(nested<double>(1.33, 1, 0.5)));
                       const MixtureT<double> glass{.transparency = 1,
                                                    .specularity = 1,
                                                    .absorption = RgbT<double>{0.25}};
                       add_slab(scene, -1, 0,
                                scene.add(Nested<MixtureT<double>>{glass, 2}));
                   },
                   degrees),
               on);
        // The same, touching: priorities and contacts know each other.
        agrees(seen_through<double>(
                   [](auto& scene) {
                       add_slab(scene, 0, 1, scene.add(nested<double>(1.33, 1, 0.5)));
                       add_slab(scene, -1, 0, scene.add(nested<double>(1.5, 2, 0.25)));
                   },
                   degrees),
               on);
        agrees(seen_through<double>(
                   [](auto& scene) {
                       add_slab(scene, -2, 2, scene.add(nested<double>(1.33, 1, 0.5)));
                       add_slab(scene, -1, 0, scene.add(nested<double>(1.5, 2, 0.25)));
                   },
                   degrees),
               transmittance_of({1, 1.33, 1.5, 1.33, 1}, degrees, {0, 1.0, 0.25, 0.5}));
    }
}

TEST_CASE("nested bodies: three that end and begin in one plane") {
    // Water and a bubble end where glass begins; oil of a higher priority goes on.
    const auto stack = [](bool oil) {
        return [oil](Bodies<double>& scene) {
            add_slab(scene, 0, 2, scene.add(nested<double>(1.33, 1)));
            add_slab(scene, 0, 1, scene.add(nested<double>(1, 3)));
            add_slab(scene, -1, 0, scene.add(nested<double>(1.5, 2)));
            if (oil) add_slab(scene, -0.5, 0.5, scene.add(nested<double>(1.4, 2)));
        };
    };
    const auto agrees = [](const Mean& mean, const std::vector<double>& indices) {
        CAPTURE(mean.mean);
        CHECK(mean.agrees_with(transmittance_of(indices, 30)));
    };
    agrees(seen_through<double>(stack(false), 30), {1, 1.33, 1, 1.5, 1});
    // Of glass and oil, of one priority, the higher index holds.
    agrees(seen_through<double>(stack(true), 30), {1, 1.33, 1, 1.5, 1});
    agrees(seen_through<double>(
               [&](Bodies<double>& scene) {
                   stack(false)(scene);
                   add_slab(scene, -0.5, 0.5, scene.add(nested<double>(1.4, 4)));
               },
               30),
           {1, 1.33, 1, 1.4, 1.5, 1});
}

TEST_CASE("nested bodies: a furnace stays 1, and n^2 in a medium") {
    const auto seen = [](const Vec3T<double>& from, bool rough) {
        auto scene = three_balls<double>();
        for (auto& material :
             std::get<std::vector<Nested<GlassT<double>>>>(scene.materials))
            material.base.absorption = RgbT<double>{0};
        if (rough)
            scene.add(SphereT<double>{{-0.4, 0, 0}, 0.3},
                      scene.add(Nested<RoughGlassT<double>>{{1.6, 0.05}, 2}));
        scene.add(SphereT<double>{{0, 0.6, 0}, 0.2},
                  scene.add(MirrorT<double>{RgbT<double>{1}}));
        scene.add(EnvironmentLightT<double>{});
        const World world(std::move(scene));
        return mean_radiance(
            PathTracer(world, {.max_depth = 1000, .roulette_depth = 1000}), 4000, 3,
            [&](auto& stream) {
                return RayT<double>{.origin = from,
                                    .direction =
                                        sample_uniform_sphere(next_2d<double>(stream))};
            });
    };
    CHECK(seen({-0.8, 0, 0.05}, false).mean ==
          doctest::Approx(1.33 * 1.33).epsilon(1e-6));
    CHECK(seen({0.35, 0.1, 0}, false).mean == doctest::Approx(1).epsilon(1e-6));
    CHECK(seen({0.9, 0.1, 0}, false).mean == doctest::Approx(2.25).epsilon(1e-6));
    // Facets lose a little light to others.
    const double in_rough = seen({-0.4, 0, 0}, true).mean / (1.6 * 1.6);
    CHECK(in_rough < 1);
    CHECK(in_rough > 0.98);
}

TEST_CASE("nested bodies: a ball of glass in water, by the lens maker's formula") {
    Bodies<double> scene;
    scene.add(SphereT<double>{{0, 0, 0}, 100}, scene.add(nested<double>(1.33, 1)));
    scene.add(SphereT<double>{{0, 0, 0}, 1}, scene.add(nested<double>(1.5, 2)));
    const World world(std::move(scene));
    const double height = 1e-4, n = 1.5 / 1.33;
    PathStateT<double> path{.ray{.origin{-5, 0, height}, .direction{1, 0, 0}}};
    RandomStream stream{};
    for (int i = 0; i < 2; ++i) {
        const auto vertex = next_vertex(world, path, stream);
        REQUIRE(vertex);
        visit_material_at(world, *vertex, [&](const auto& m) {
            if constexpr (Splits<decltype(m)>) {
                const auto both = split(m, vertex->wo, Transport::radiance);
                REQUIRE(both);
                detail::follow(path, *vertex, m, (*both)[1],
                               to_world(vertex->frame, (*both)[1].wi));
            }
        });
    }
    const auto& [origin, way] = std::pair(path.ray.origin, path.ray.direction);
    CHECK(origin.x - origin.z / way.z * way.x ==
          doctest::Approx(n / (2 * (n - 1))).epsilon(1e-6));
    CHECK(path.bodies.ranks[1] == 0); // in water again, and in nothing else
}

TEST_CASE("nested bodies: the same picture as with a relative index") {
    // Water within a shell of glass, and a matt ball in it.
    const auto picture = [](bool priorities) {
        Bodies<float> scene;
        const auto ball = scene.add(Lambertian{.albedo{0.7f, 0.5f, 0.3f}});
        const Rgb green{0.3f, 0.1f, 0.3f}, blue{0.5f, 0.2f, 0};
        const Glass glass{.index = 1.5f, .absorption = green};
        const Glass water{.index = 1.33f, .absorption = blue};
        scene.add(Sphere{{0, 0, 0}, 0.4f}, ball);
        if (priorities) {
            scene.add(Sphere{{0, 0, 0}, 0.8f}, scene.add(Nested<Glass>{water, 2}));
            scene.add(Sphere{{0, 0, 0}, 1}, scene.add(Nested<Glass>{glass, 1}));
        } else {
            Glass relative = water;
            relative.index = 1.33f / 1.5f;
            scene.add(Sphere{{0, 0, 0}, 0.8f}, scene.add(relative));
            scene.add(Sphere{{0, 0, 0}, 1}, scene.add(glass));
        }
        scene.add(sky<float>());
        const World world(std::move(scene));
        return render(PathTracer(world), look_at({.position{0, -4, 1}}),
                      {.width = 24, .height = 24, .samples = 4})
            .image.pixels;
    };
    const auto a = picture(true), b = picture(false);
    int other = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        other += glm::length(a[i] - b[i]) > 1e-4f ? 1 : 0;
    CHECK(other <= 6); // rounding decides some of 2304 paths otherwise
    CHECK(glm::length(a[300]) > 0.1f);
}

TEST_CASE("nested bodies: priorities without an overlap change no byte") {
    const auto picture = [](auto first, auto second) {
        Bodies<float> scene;
        scene.add(Quad{{-3, -3, -1}, {6, 0, 0}, {0, 6, 0}}, scene.add(Lambertian{}));
        scene.add(Sphere{{-1, 0, 0}, 0.8f}, scene.add(first));
        scene.add(Sphere{{1, 0, 0}, 0.8f}, scene.add(second));
        scene.add(sky<float>());
        const World world(std::move(scene));
        return render(PathTracer(world), look_at({.position{0, -4, 1}}),
                      {.width = 24, .height = 24, .samples = 2})
            .image.pixels;
    };
    const Glass clear{.index = 1.5f}, red{.index = 1.4f, .absorption{0, 1, 1}};
    const auto plain = picture(clear, red);
    CHECK(picture(Nested<Glass>{clear, 1}, Nested<Glass>{red, 2}) == plain);
    CHECK(picture(Nested<Glass>{clear}, Nested<Glass>{red}) == plain);
}

TEST_CASE("nested bodies: a normal map changes neither index nor priority") {
    using Dented = Textured<Glass, NormalMap>;
    using Over = Textured<Nested<Glass>, NormalMap>;
    const auto picture = [](const auto& glass, double water_from) {
        Scene<Shapes<Quad>,
              Materials<Glass, Nested<Glass>, Dented, Nested<Dented>, Over>,
              Lights<EnvironmentLight>>
            scene;
        const auto water =
            scene.add(Nested<Glass>{{.index = 1.33f, .absorption = Rgb{0.1f}}, 1});
        const auto other = scene.add(glass);
        scene.add(face(float(water_from), false), water);
        scene.add(face(2.0f, true), water);
        scene.add(face(0.0f, false), other);
        scene.add(face(1.0f, true), other);
        scene.add(sky<float>());
        const World world(std::move(scene));
        return render(PathTracer(world),
                      look_at({.position{-2, 1, 0.3f}, .target{0.5f, 0, 0}}),
                      {.width = 16, .height = 16, .samples = 4})
            .image.pixels;
    };
    const Glass glass{.index = 1.5f, .absorption{0.2f, 0.1f, 0}};
    const NormalMap flat{{.image = make_image(1, 1, Rgb{0.5f, 0.5f, 1})}};
    const auto overlapping = picture(Nested<Glass>{glass, 2}, 0.5);
    CHECK(overlapping != picture(Nested<Glass>{glass, 0}, 0.5));
    CHECK(picture(Nested<Dented>{{glass, flat}, 2}, 0.5) == overlapping);
    CHECK(picture(Over{{glass, 2}, flat}, 0.5) == overlapping);
    const auto in_contact = picture(glass, 1);
    CHECK(picture(Dented{glass, flat}, 1) == in_contact);

    const NormalMap slope{{.image = make_image(1, 1, Rgb{0.7f, 0.5f, 0.9f})}};
    CHECK(picture(Nested<Dented>{{glass, slope}, 2}, 0.5) ==
          picture(Over{{glass, 2}, slope}, 0.5));
    CHECK(picture(Nested<Dented>{{glass, slope}, 2}, 0.5) != overlapping);
}

TEST_CASE("nested bodies: shadow rays pass what is hidden") {
    Bodies<double> scene;
    scene.add(SphereT<double>{{0, 0, 0}, 10}, scene.add(nested<double>(1.33, 2, 0.1)));
    scene.add(SphereT<double>{{0, 0, 0}, 1}, scene.add(nested<double>(1.5, 1)));
    scene.add(SphereT<double>{{0, 5, 0}, 1}, scene.add(nested<double>(1.5, 3)));
    scene.add(QuadT<double>{{3, -1, -5}, {2, 0, 0}, {0, 2, 0}},
              scene.add(LambertianT<double>{}));
    const World world(std::move(scene));
    const auto from = [](double x, double y, double z) {
        return SurfacePointT<double>{.position{x, y, z}, .normal{0, 0, 0}};
    };
    CHECK(visibility(world, from(-3, 0, 0), from(3, 0, 0)).x == 1); // hidden glass
    CHECK(visibility(world, from(0, 0, 0), from(3, 0, 0)).x == 1);
    CHECK(visibility(world, from(-3, 5, 0), from(3, 5, 0)).x == 0); // seen glass
    CHECK(visibility(world, from(0, 5, 0), from(3, 5, 0)).x == 0);
    CHECK(visibility(world, from(4, 0, -6), from(4, 0, 0)).x == 0);   // what is matt
    CHECK(visibility(world, from(-20, 0, 0), from(-3, 0, 0)).x == 0); // the water

    // A path knows its medium behind a hidden surface, and a mirror keeps it.
    PathStateT<double> path{.ray{.origin{-3, 0, 0}, .direction{1, 0, 0}}};
    RandomStream stream{};
    const auto end = next_vertex(world, path, stream);
    REQUIRE(end);
    CHECK(end->distance == doctest::Approx(13));
    CHECK(path.throughput.x == doctest::Approx(std::exp(-1.3)));
    CHECK(medium_at(world, RayT<double>{.direction{1, 0, 0}}).x == 0.1);
}

TEST_CASE("nested bodies: photons bring the irradiance that paths find") {
    // A floor in water, and below a ball of glass with a bubble at the water's surface.
    Bodies<double> scene;
    scene.add(SphereT<double>{{0, 0, 0}, 2}, scene.add(nested<double>(1.33, 1, 0.1)));
    scene.add(SphereT<double>{{0, 0, 1.7}, 0.6}, scene.add(nested<double>(1.5, 2)));
    scene.add(SphereT<double>{{0, 0.2, 1.5}, 0.3}, scene.add(nested<double>(1, 3)));
    const auto black = scene.add(LambertianT<double>{RgbT<double>{0}});
    scene.add(QuadT<double>{{-1, -1, -0.8}, {2, 0, 0}, {0, 2, 0}}, black);
    scene.add(QuadT<double>{{-3, -3, 4}, {0, 6, 0}, {6, 0, 0}}, black, RgbT<double>{1});
    const World world(std::move(scene));
    const PathTracer tracer(world, {.max_depth = 1000});
    const auto below_ball = [](const Vec3T<double>& p) {
        return p.x * p.x + p.y * p.y < 0.16;
    };
    for (const bool inner : {true, false}) {
        CAPTURE(inner);
        Mean by_photons, by_paths;
        for (std::uint64_t batch = 0; batch < 64; ++batch) {
            const auto traced =
                trace_photons(world, MapType::caustics,
                              {.photons = 3000,
                               .seed = ljus_test::test_seed(100 + batch),
                               .threads = 1});
            double flux = 0;
            for (const auto& photon : traced.photons)
                if (std::abs(photon.position.z + 0.8) < 1e-6 &&
                    photon.direction.z < 0 && below_ball(photon.position) == inner)
                    flux += photon.flux.x;
            by_photons.add(flux);
        }
        Counts counts;
        for (std::uint64_t path = 0; path < 80000; ++path) {
            auto stream =
                random_stream(ljus_test::test_seed(9), Pass::camera, inner, path);
            const auto u = next_2d<double>(stream), v = next_2d<double>(stream);
            const Vec3T<double> at{2 * u.x - 1, 2 * u.y - 1, -0.8 + 1e-9};
            const RayT<double> ray{.origin = at,
                                   .direction = sample_cosine_hemisphere(v)};
            auto context = context_of(stream, counts);
            by_paths.add(below_ball(at) == inner
                             ? 4 * std::numbers::pi * radiance(tracer, ray, context).x
                             : 0.0);
        }
        CAPTURE(by_photons.mean);
        CAPTURE(by_photons.error());
        CAPTURE(by_paths.mean);
        CAPTURE(by_paths.error());
        CHECK(by_paths.error() < 0.02 * by_paths.mean);
        CHECK(ljus_test::chance_of(by_photons, by_paths) > 1e-6);
    }
}

TEST_CASE("nested bodies: a random path is in the bodies around it") {
    auto scene = three_balls<float>();
    scene.add(Sphere{{0, -0.6f, 0}, 0.25f}, scene.add(Mirror{}));
    scene.add(Sphere{{-0.6f, 0.3f, 0}, 0.2f}, scene.add(Lambertian{}));
    scene.add(Sphere{{0.2f, 0, 0.9f}, 0.4f},
              scene.add(Nested<RoughGlass>{{1.6f, 0.4f}, 2}));
    scene.add(Quad{{-3, -3, -0.7f}, {6, 0, 0}, {0, 6, 0}}, scene.add(Lambertian{}));
    const World world(std::move(scene));
    int checked = 0, wrong = 0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        RandomStream stream{5, i};
        const Vec2 u = next_2d<float>(stream);
        const Vec3 from = 4.0f * sample_uniform_sphere(u);
        PathState path{.ray{.origin = from,
                            .direction = glm::normalize(
                                0.8f * sample_uniform_sphere(Vec2{u.y, u.x}) - from)}};
        while (path.depth < 20) {
            const auto vertex = next_vertex(world, path, stream);
            if (!vertex) break;
            ++checked;
            Ray back = spawn_ray(vertex->point, -path.ray.direction);
            wrong += bodies_around(world, back) == path.bodies ? 0 : 1;
            if (!visit_material_at(world, *vertex, [&](const auto& m) {
                    return continue_path(path, *vertex, m, Transport::flux, Lobes::all,
                                         stream);
                }))
                break;
        }
    }
    CAPTURE(checked);
    CAPTURE(wrong);
    CHECK(checked > 10000);
    CHECK(wrong < checked / 1000); // a ray may graze two surfaces in one rounding
}

TEST_CASE("nested bodies: what cannot be right is said or refused") {
    const auto remarks = [](Bodies<float> scene) {
        scene.add(EnvironmentLight{});
        return survey(World(std::move(scene)), PhotonMappingSettings{}).remarks;
    };
    const auto two = [](int first, int second) {
        Bodies<float> scene;
        scene.add(Sphere{{0, 0, 0}, 1}, scene.add(nested<float>(1.5, first)));
        scene.add(Sphere{{1, 0, 0}, 1}, scene.add(nested<float>(1.33, second)));
        return scene;
    };
    const auto say = [](const std::vector<std::string>& all, const char* what) {
        return std::any_of(all.begin(), all.end(), [&](const std::string& remark) {
            return remark.find(what) != std::string::npos;
        });
    };
    CHECK(say(remarks(two(0, 0)), "give them priorities; around (0."));
    CHECK(say(remarks(two(1, 1)), "of equal priority"));
    CHECK_FALSE(say(remarks(two(1, 2)), "priorit"));
    // Boxes on a floor, the second of which begins at x: they touch, or overlap.
    const auto boxes = [](float x) {
        Bodies<float> scene;
        const auto glass = scene.add(nested<float>(1.5, 1));
        const auto tinted = scene.add(Nested<Glass>{{1.5f, Rgb{0.2f, 1, 2}}, 1});
        for (const Quad& side :
             sides_of(Box{{-0.6f, -1, -0.6f}, {-0.1f, -0.4f, -0.1f}}))
            scene.add(side, glass);
        for (const Quad& side : sides_of(Box{{x, -1, -0.6f}, {0.4f, -0.4f, -0.1f}}))
            scene.add(side, tinted);
        scene.add(Sphere{{0.5f, -0.7f, 0.3f}, 0.3f}, glass);
        return scene;
    };
    CHECK_FALSE(say(remarks(boxes(-0.1f)), "priorit"));
    CHECK(say(remarks(boxes(-0.3f)), "of equal priority"));
    auto film = two(1, 2);
    film.add(Sphere{{0, 0, 0}, 0.5f}, film.add(ThinGlass{}));
    CHECK(say(remarks(film), "a thin surface lies in a transparent body"));

    auto lamp = two(1, 2);
    lamp.add(Sphere{{9, 0, 0}, 1}, lamp.add(nested<float>(1.5, 0)), Rgb{1});
    CHECK_THROWS_WITH_AS((void)World(lamp),
                         doctest::Contains("the radiance of a transparent body"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)lamp.add(nested<float>(0, 1)),
                         doctest::Contains("glass.index is 0"), std::invalid_argument);
    Bodies<float> many;
    for (int i = 0; i < 256; ++i) (void)many.add(Glass{});
    CHECK_NOTHROW((void)World(many));
    (void)many.add(nested<float>(1.5, 1));
    CHECK_THROWS_WITH_AS((void)World(many), doctest::Contains("at most 255"),
                         std::invalid_argument);
}
