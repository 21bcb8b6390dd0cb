/// \file bsdf_test.cpp
/// \brief The concept: what is a material, what is not, and what comes by default.

#include "ljus/materials/material.hpp"

#include <doctest/doctest.h>

#include <optional>
#include <string>

#include "ljus/materials/glass.hpp"
#include "ljus/materials/nested.hpp"

using ljus::Lobes, ljus::Rgb, ljus::Transport, ljus::Vec3;

// A material of a reader, in a namespace of the reader.
namespace reader {

struct Paint {
    using Scalar = float;
    float grey = 0.5f;
};
Lobes lobes(const Paint&) {
    return Lobes::diffuse;
}
Rgb evaluate(const Paint& p, const Vec3&, const Vec3&) {
    return Rgb{p.grey / 3.14159f};
}
float pdf(const Paint&, const Vec3&, const Vec3& wi, Lobes) {
    return wi.z / 3.14159f;
}
std::optional<ljus::BsdfSample> sample(const Paint& p, const Vec3&, const Vec3&,
                                       Transport, Lobes) {
    return ljus::diffuse_sample(Vec3{0, 0, 1}, Rgb{p.grey}, 1 / 3.14159f);
}
void check(const Paint&) {}

struct Lamp : Paint {};
Rgb emission(const Lamp&) {
    return Rgb{3};
}

struct Wall : Paint { // another one at each place
    static constexpr bool uses_uv = true;
};
Paint at_point(const Wall&, const Vec3&, const ljus::Vec2&) {
    return {};
}

struct Forgetful { // no pdf
    using Scalar = float;
};
Lobes lobes(const Forgetful&) {
    return Lobes::none;
}

} // namespace reader

static_assert(ljus::Material<reader::Paint>);
static_assert(!ljus::Material<reader::Forgetful>);
static_assert(!ljus::Material<int>);
static_assert(!ljus::Material<Vec3>);

TEST_CASE("bsdf: a reader's material needs nothing but its functions") {
    const reader::Paint paint;
    CHECK(lobes(paint) != ljus::Lobes::specular);
    CHECK(ljus::absorption(paint) == Rgb{0, 0, 0});
    CHECK(ljus::emission(paint) == Rgb{0, 0, 0});
}

TEST_CASE("bsdf: a material that emits says so, and its word counts") {
    using ljus::emission;
    CHECK(emission(reader::Lamp{}) == Rgb{3, 3, 3});
}

TEST_CASE("bsdf: lobes are a set") {
    CHECK((Lobes::diffuse | Lobes::glossy) == Lobes::non_specular);
    CHECK((Lobes::non_specular | Lobes::specular) == Lobes::all);
    CHECK_FALSE(ljus::has(Lobes::glossy, Lobes::diffuse));
    CHECK((Lobes::all & Lobes::specular) == Lobes::specular);
    CHECK((Lobes::diffuse & Lobes::specular) == Lobes::none);
    CHECK(ljus::has(Lobes::all, Lobes::non_specular));
    CHECK(ljus::has(Lobes::diffuse, Lobes::all));
    CHECK_FALSE(ljus::has(Lobes::diffuse, Lobes::specular));
    CHECK_FALSE(ljus::has(Lobes::none, Lobes::all));
}

TEST_CASE("bsdf: the surface itself is on neither side") {
    CHECK(ljus::same_side(Vec3{0, 0, 1e-30f}, Vec3{0, 0, 1e-30f})); // no underflow
    CHECK(ljus::same_side(Vec3{0, 0, -1}, Vec3{0, 0, -1}));
    CHECK_FALSE(ljus::same_side(Vec3{0, 0, 1}, Vec3{0, 0, -1}));
    CHECK_FALSE(ljus::same_side(Vec3{1, 0, 0}, Vec3{0, 0, 1}));
    CHECK_FALSE(ljus::same_side(Vec3{1, 0, 0}, Vec3{1, 0, 0}));
    CHECK_FALSE(ljus::same_side(Vec3{0, 0, 1}, Vec3{0, 0, NAN}));
}

TEST_CASE("bsdf: a delta has no density") {
    constexpr auto s = ljus::specular_sample(Vec3{0, 0, 1}, Rgb{1, 1, 1});
    static_assert(s.specular && s.pdf == 0);
    constexpr auto d = ljus::diffuse_sample(Vec3{0, 0, 1}, Rgb{1, 1, 1}, 0.3f);
    static_assert(!d.specular && d.pdf == 0.3f);
    CHECK(s.weight == d.weight);
}

TEST_CASE("bsdf: what a sample of a delta carries") {
    const auto mirrored = ljus::specular_sample(Vec3{0.6f, 0, 0.8f}, Rgb{4, 2, 1});
    CHECK(mirrored.wi == Vec3{0.6f, 0, 0.8f});
    CHECK(mirrored.weight == Rgb{4, 2, 1});
    CHECK(mirrored.eta_scale == 1);
    CHECK(mirrored.specular);
    CHECK(mirrored.pdf == 0);
    const auto through = ljus::specular_sample(Vec3{0, 0, -1}, Rgb{4, 2, 1}, 0.25f);
    CHECK(through.weight == Rgb{1, 0.5f, 0.25f});
    CHECK(through.eta_scale == 0.25f);
    CHECK(through.specular);
    const auto matt = ljus::diffuse_sample(Vec3{0, 0, 1}, Rgb{4, 2, 1}, 0.5f);
    CHECK(matt.weight == Rgb{4, 2, 1});
    CHECK(matt.pdf == 0.5f);
    CHECK(matt.eta_scale == 1);
    CHECK_FALSE(matt.specular);
    for (const float side : {1.0f, -1.0f}) {
        CHECK_FALSE(ljus::same_side(Vec3{0, 0, side}, Vec3{1, 0, 0}));
        CHECK_FALSE(ljus::same_side(Vec3{1, 0, 0}, Vec3{0, 0, side}));
        CHECK_FALSE(ljus::same_side(Vec3{0, 0, side}, Vec3{1, 0, -0.0f}));
    }
}

TEST_CASE("bsdf: which hooks a material has, by name") {
    const auto names = [](const auto& hooks) {
        std::string all;
        for (const auto& hook : hooks)
            if (hook.provided) all.append(hook.name).append(" ");
        return all;
    };
    CHECK(names(ljus::detail::material_hooks<reader::Paint>()).empty());
    CHECK(names(ljus::detail::material_hooks<reader::Lamp>()) == "emission ");
    CHECK(names(ljus::detail::material_hooks<ljus::Glass>()) ==
          "absorption refractive_index split only_specular ");
    CHECK(names(ljus::detail::material_hooks<ljus::Nested<ljus::Glass>>()) ==
          "absorption refractive_index priority emission at_point ");
    CHECK(names(ljus::detail::material_hooks<ljus::ThinGlass>()) ==
          "pass_through only_specular ");
    CHECK(names(ljus::detail::material_hooks<reader::Wall>()) == "at_point uses_uv ");
}

TEST_CASE("bsdf: a sample without more said, and a material of one place") {
    const ljus::BsdfSample s;
    CHECK(s.wi == Vec3{0, 0, 1});
    CHECK(s.weight == Rgb{0});
    CHECK(s.pdf == 0);
    CHECK_FALSE(s.specular);
    CHECK(s.eta_scale == 1);
    const reader::Paint paint{.grey = 0.25f};
    CHECK(&ljus::material_at(paint, Vec3{1}, ljus::Vec2{0}) == &paint);
    CHECK(ljus::material_at(reader::Wall{}, Vec3{1}, ljus::Vec2{0}).grey == 0.5f);
    // What a delta need not write.
    const ljus::Glass glass;
    const Vec3 up{0, 0, 1};
    CHECK(lobes(glass) == Lobes::specular);
    CHECK(evaluate(glass, up, up) == Rgb{0});
    CHECK(pdf(glass, up, up) == 0);
}
