/// \file own_renderer_test.cpp
/// \brief The ambient occlusion of examples/own_renderer.hpp against closed forms.

#include "own_renderer.hpp"

#include <doctest/doctest.h>

#include "ljus/materials/lambertian.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/mean.hpp"

using namespace ljus;

// Each mean of 20 000 rays lies beyond 4 standard errors once in 15 000 seeds.
TEST_CASE("own renderer: a disc of sky, a wall, and a reach") {
    // Below a ball of radius 1 whose centre is 2 away, the cosine-weighted share of the
    // hemisphere that it hides is (1/2)^2.
    const World world(
        make_scene(placed(Quad{{-50, 0, 50}, {100, 0, 0}, {0, 0, -100}}, Lambertian{}),
                   placed(Sphere{.center{0, 2, 0}, .radius = 1}, Lambertian{})));
    const auto open_at = [&](float x, float reach) {
        const reader::AmbientOcclusion renderer(world, reach);
        return ljus_test::mean_radiance(renderer, 20000, 1, [&](RandomStream&) {
            return Ray{.origin{x, 0.5f, 0}, .direction{0, -1, 0}};
        });
    };
    const auto below = open_at(0, 1e6f);
    CHECK(std::abs(below.mean - 0.75) < 4 * below.error());
    CHECK(below.error() < 0.005);
    CHECK(open_at(0, 0.9f).mean == 1); // the ball is farther away
    CHECK(open_at(40, 1e6f).mean > 0.999);
}

TEST_CASE("own renderer: the back of a wall is as open as its front") {
    const World world(make_scene(
        placed(Quad{{-50, 0, 50}, {100, 0, 0}, {0, 0, -100}}, Lambertian{})));
    const reader::AmbientOcclusion renderer(world, 1.0f);
    const auto seen = ljus_test::mean_radiance(renderer, 1000, 1, [](RandomStream&) {
        return Ray{.origin{0, -1, 0}, .direction{0, 1, 0}};
    });
    CHECK(seen.mean == 1);
    static_assert(Renderer<decltype(renderer)>);
    static_assert(
        !std::is_constructible_v<std::remove_const_t<decltype(renderer)>,
                                 std::remove_const_t<decltype(world)>, float>);
}
