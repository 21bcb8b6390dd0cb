// concept: reflection
/// \file facing_mirrors_test.cpp
/// \brief After n mirrors there is R^n left, with every renderer.

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include <ljus/ljus.hpp>

#include "support/mean.hpp"

namespace {

template <typename T>
using Hall = ljus::Scene<ljus::Shapes<ljus::QuadT<T>>,
                         ljus::Materials<ljus::MirrorT<T>, ljus::LambertianT<T>>>;

/// Two mirrors at x = 0 and x = 1, and above them a lamp of radiance 1 that spans the
/// gap.
template <typename T>
Hall<T> hall(const ljus::RgbT<T>& reflectance) {
    Hall<T> scene;
    const auto mirror = scene.add(ljus::MirrorT<T>{reflectance});
    const auto black = scene.add(ljus::LambertianT<T>{ljus::RgbT<T>{0}});
    using Quad = ljus::QuadT<T>;
    scene.add(Quad{{0, -1, -4}, {0, 0, 8}, {0, 3, 0}}, mirror);
    scene.add(Quad{{1, -1, -4}, {0, 3, 0}, {0, 0, 8}}, mirror);
    scene.add(Quad{{0, 1, -4}, {1, 0, 0}, {0, 0, 8}}, black, ljus::RgbT<T>{1});
    return scene;
}

/// The ray from the middle of the gap that meets a mirror n times below the lamp.
template <typename T>
ljus::RayT<T> ray_of(int n) {
    return {.origin{T(0.5), 0, 0},
            .direction = glm::normalize(ljus::Vec3T<T>{n, 1, 0})};
}

/// The largest relative error of R^n over n = 0..40 and three channels.
template <typename T, typename Renderer>
double largest_error(const Renderer& renderer, const ljus::RgbT<T>& reflectance) {
    double largest = 0;
    for (int n = 0; n <= 40; ++n) {
        ljus::RandomStream stream = ljus::random_stream(3, ljus::Pass::camera, 0, 0);
        ljus::Counts counts;
        auto context = ljus::context_of(stream, counts);
        const auto seen = radiance(renderer, ray_of<T>(n), context);
        for (int channel = 0; channel < 3; ++channel) {
            const double exact = std::pow(double(reflectance[channel]), n);
            largest = std::max(largest, std::abs(double(seen[channel]) / exact - 1));
        }
    }
    return largest;
}

} // namespace

TEST_CASE_TEMPLATE("facing_mirrors: n reflections leave R^n in both renderers", T,
                   float, double) {
    const ljus::RgbT<T> reflectance{T(0.95), T(0.9), T(0.8)};
    const ljus::World world(hall(reflectance));
    const double most = 45 * double(std::numeric_limits<T>::epsilon());
    const double found =
        largest_error(ljus::PathTracer(world, {.roulette_depth = 1000}), reflectance);
    MESSAGE("largest relative error ", found);
    CHECK(found <= most);
    ljus::PhotonMappingSettings settings{.roulette_depth = 1000};
    settings.caustics.photons = 100;
    CHECK(largest_error(ljus::PhotonMapper(world, settings), reflectance) <= most);
}

TEST_CASE("facing_mirrors: roulette keeps the mean of 40 reflections") {
    const ljus::Rgb reflectance{0.95f, 0.9f, 0.8f};
    const ljus::World world(hall(reflectance));
    const ljus::PathTracer tracer(world, {.roulette_depth = 4});
    const double exact = std::pow(0.95, 40);
    const auto seen = ljus_test::mean_radiance(tracer, 20000, 3,
                                               [](auto&) { return ray_of<float>(40); });
    // A false alarm once in 15 000 seeds; 20 further ones were tried.
    CHECK(std::abs(apart(seen, exact)) <= 4);
    CHECK(seen.error() < 0.05 * exact);
}
