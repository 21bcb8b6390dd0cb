#pragma once

/// \file chapters/experiments/one_ball.hpp
/// \brief One ball of any material: in a furnace, in a room, and its samples alone.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <ljus/ljus.hpp>

#include "common/clock.hpp"

namespace examples {

/// The mean radiance of a ball under a sky of radiance 1, seen from far away.
template <typename Material>
[[nodiscard]] ljus::Rgb furnace_albedo(const Material& material, int rays) {
    const ljus::World world(ljus::make_scene(
        placed(ljus::Sphere{.radius = 1000}, ljus::Lambertian{.albedo = ljus::Rgb{0}},
               ljus::Rgb{1}, true),
        placed(ljus::Sphere{.center{0, 0, 0}, .radius = 1}, material)));
    const auto camera = ljus::look_at(
        {.position{0, 0, 100}, .target{0, 0, 0}, .vfov_degrees = 1.1459f});
    const int size = 64;
    const auto image = render(ljus::PathTracer(world), camera,
                              {.width = size, .height = size, .samples = rays})
                           .image;
    ljus::Rgb sum{0};
    int count = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            if (std::hypot(x + 0.5 - size / 2, y + 0.5 - size / 2) < size / 2 - 1) {
                sum += pixel(image, x, y);
                ++count;
            }
    return sum / float(count);
}

/// The picture of a ball on a floor between two walls, under a lamp.
template <typename Material>
[[nodiscard]] ljus::Image ball_picture(int size, int rays, std::uint64_t seed,
                                       const Material& material, int threads = 0) {
    const auto matt = [](float r, float g, float b) {
        return ljus::Lambertian{.albedo{r, g, b}};
    };
    const ljus::World world(ljus::make_scene(
        placed(ljus::Quad{{-4, 0, 6}, {8, 0, 0}, {0, 0, -10}}, matt(0.4f, 0.4f, 0.4f)),
        placed(ljus::Quad{{-4, 0, -4}, {8, 0, 0}, {0, 6, 0}}, matt(0.5f, 0.5f, 0.5f)),
        placed(ljus::Quad{{-4, 0, 6}, {0, 0, -10}, {0, 6, 0}}, matt(0.6f, 0.2f, 0.1f)),
        placed(ljus::Quad{{4, 0, 6}, {0, 6, 0}, {0, 0, -10}}, matt(0.1f, 0.3f, 0.6f)),
        placed(ljus::Quad{{-4, 6, -4}, {8, 0, 0}, {0, 0, 10}}, matt(0.6f, 0.6f, 0.6f)),
        placed(ljus::Quad{{-4, 0, 6}, {0, 6, 0}, {8, 0, 0}}, matt(0.5f, 0.5f, 0.5f)),
        placed(ljus::Quad{{-1, 5.9f, 0}, {2, 0, 0}, {0, 0, 2}}, matt(0, 0, 0),
               ljus::Rgb{20}),
        placed(ljus::Sphere{.center{0, 1, 0}, .radius = 1}, material)));
    const auto camera =
        ljus::look_at({.position{0, 2, 5.5f}, .target{0, 1, 0}, .vfov_degrees = 28});
    return render(ljus::PathTracer(world), camera,
                  {.width = size,
                   .height = size,
                   .samples = rays,
                   .seed = seed,
                   .threads = threads})
        .image;
}

/// The mean and the variance of a sample's weight.
struct Weights {
    double mean = 0;     ///< The albedo at the angle.
    double variance = 0; ///< By which the variance of a path grows.
};

/// Both over many samples at an angle.
template <typename Sampler>
[[nodiscard]] Weights weights(double degrees, int count, Sampler sampler) {
    const double theta = degrees * std::numbers::pi / 180;
    const ljus::Vec3 wo(ljus::Vec3T<double>{std::sin(theta), 0, std::cos(theta)});
    ljus::RandomStream stream = ljus::random_stream(13, ljus::Pass::user, 0, 0);
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
        const double weight = sampler(wo, next_3d<float>(stream));
        sum += weight;
        squares += weight * weight;
    }
    const double mean = sum / count;
    return {mean, std::max(0.0, squares / count - mean * mean)};
}

/// The weight of a material's own sample.
template <typename Material>
[[nodiscard]] auto own_sampler(const Material& material) {
    return [material](const ljus::Vec3& wo, const ljus::Vec3& u) {
        const auto s = sample(material, wo, u, ljus::Transport::flux);
        return s ? double(s->weight.x) : 0.0;
    };
}

/// Nanoseconds per call of f(wo, wi, u), the best of 21 runs.
template <typename F>
[[nodiscard]] double nanoseconds(F f) {
    std::vector<ljus::Vec3> wo, u;
    ljus::RandomStream stream = ljus::random_stream(12, ljus::Pass::user, 0, 0);
    for (int i = 0; i < 4096; ++i) {
        wo.push_back(ljus::sample_cosine_hemisphere(next_2d<float>(stream)));
        u.push_back(next_3d<float>(stream));
    }
    return nanoseconds_a_call(4.0 * double(wo.size()), [&] {
        float sum = 0;
        for (int round = 0; round < 4; ++round)
            for (std::size_t i = 1; i < wo.size(); ++i)
                sum += f(wo[i], wo[i - 1], u[i]);
        return sum;
    });
}

} // namespace examples
