/// \file own_material_test.cpp
/// \brief The moon of examples/own_material.hpp by what must hold for every material,
/// and by its closed form.

#include "own_material.hpp"

#include <doctest/doctest.h>

#include <utility>

#include "ljus/geometry/sphere.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/render/path_tracing.hpp"
#include "support/bsdf_checks.hpp"

using ljus::Lobes, ljus::Rgb, ljus::Vec3;
using reader::Moon;

static_assert(ljus::Material<Moon>);

namespace {

/// A mirror that reflects only red; it says nothing of what OnlySpecular spares it.
struct RedMirror {
    using Scalar = float;
    static constexpr bool only_specular = true;
};
std::optional<ljus::BsdfSample> sample(const RedMirror&, const Vec3& wo, const Vec3&,
                                       ljus::Transport, Lobes which = Lobes::all) {
    if (!has(which, Lobes::specular) || wo.z == 0) return std::nullopt;
    return ljus::specular_sample(Vec3{-wo.x, -wo.y, wo.z}, Rgb{1, 0, 0});
}
void check(const RedMirror&) {}

} // namespace

static_assert(ljus::Material<RedMirror>);

TEST_CASE("own material: f is the same with its directions exchanged") {
    for (const float k : {1.0f, 1.5f, 4.0f})
        ljus_test::check_reciprocity(Moon{.color = Rgb{0.9f}, .k = k});
}

TEST_CASE(
    "own material: it sends back colour times cos^(k-1), and never more than came") {
    for (const float k : {1.0f, 1.5f, 2.0f, 4.0f})
        for (const float cosine : {1.0f, 0.8f, 0.3f, -0.6f}) {
            const Vec3 wo{std::sqrt(1 - cosine * cosine), 0, cosine};
            const Moon moon{.color{0.9f, 0.5f, 0}, .k = k};
            const auto back = ljus_test::albedo_by_quadrature(moon, wo);
            const double share = std::pow(std::abs(double(cosine)), double(k) - 1);
            CHECK(back.x == doctest::Approx(double(0.9f) * share).epsilon(2e-3));
            CHECK(back.y == doctest::Approx(0.5 * share).epsilon(2e-3));
            CHECK(back.z == 0);
            CHECK(back.x <= 1);
        }
}

TEST_CASE("own material: directions come with the density that pdf() says") {
    // Chi-square: a false alarm three times in 10 million for each of six calls.
    for (const float k : {1.0f, 2.5f})
        for (const float cosine : {0.95f, 0.2f, -0.5f})
            ljus_test::check_sampling(Moon{.k = k},
                                      {std::sqrt(1 - cosine * cosine), 0, cosine});
}

TEST_CASE("own material: what would make light is refused by name") {
    CHECK_NOTHROW(check(Moon{}));
    CHECK_THROWS_WITH_AS(check(Moon{.k = 0.9f}), doctest::Contains("moon.k"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(check(Moon{.color = Rgb{1.1f}}),
                         doctest::Contains("moon.color"), std::invalid_argument);
}

TEST_CASE("own material: one that is only specular need not say that it has no f") {
    const RedMirror mirror;
    CHECK(ljus::lobes(mirror) == ljus::Lobes::specular);
    ljus_test::check_sampling(mirror, {0.6f, 0, -0.8f});
    ljus_test::check_extremes(mirror, 1);
    const auto back =
        ljus_test::specular_albedo(mirror, {0.6f, 0, 0.8f}, ljus::Transport::radiance);
    CHECK(back.x == doctest::Approx(1).epsilon(1e-9));
    CHECK(back.y == 0);

    // A ball of it inside a white lamp is red with every renderer.
    using namespace ljus;
    Scene<Shapes<Sphere>, Materials<Lambertian, RedMirror>> scene;
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    scene.add(Sphere{{0, 0, 0}, 3}, black, Rgb{1}, true);
    scene.add(Sphere{{0, 0, 0}, 1}, scene.add(mirror));
    RandomStream stream = random_stream(1, Pass::camera, 0, 0);
    const Ray ray{.origin{0.3f, 0.2f, 2}, .direction{0, 0, -1}};
    Counts counts;
    auto context = context_of(stream, counts);
    const World world(std::move(scene));
    const Rgb seen = radiance(PathTracer(world), ray, context);
    CHECK(seen.x == doctest::Approx(1).epsilon(1e-5));
    CHECK(seen.y == 0);
}
