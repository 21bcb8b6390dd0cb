/// \file own_vector.cpp
/// \brief A small path tracer with its own vector type, scene and loop. The formulas
/// come from the library.
// runs in the folder of its picture

#include <algorithm>
#include <numbers>
#include <vector>

#include "own_vector.hpp"

#include <ljus/geometry/sphere.hpp>
#include <ljus/io/png.hpp>
#include <ljus/materials/oren_nayar.hpp>
#include <ljus/math/sampling_pattern.hpp>

using reader::Vector;

namespace {

struct Ball {
    ljus::Sphere shape;
    Vector color;
    bool glass = false;
};

Vector sky(const Vector& direction) {
    const float up = 0.5f * (1 + direction.y);
    return (1 - up) * Vector{1, 0.8f, 0.6f} + up * Vector{0.3f, 0.5f, 1};
}

// [trace]
Vector trace(const std::vector<Ball>& balls, ljus::Ray ray,
             ljus::RandomStream& stream) {
    Vector weight{1, 1, 1};
    for (int depth = 0; depth < 20; ++depth) {
        const Ball* met = nullptr;
        for (const Ball& ball : balls)
            if (const auto t = intersect(ray, ball.shape)) {
                ray.t_max = *t;
                met = &ball;
            }
        const Vector d = ray.direction;
        if (met == nullptr) return weight * sky(d);

        const ljus::SurfacePoint point =
            surface_point(met->shape, ray, {.t = ray.t_max});
        Vector next;
        if (met->glass) {
            next = at_glass(d, point.normal, ljus::next_1d(stream));
        } else {
            const ljus::OrenNayar clay{.albedo = met->color, .sigma = 0.5f};
            const auto frame = ljus::frame_around(point.normal);
            const auto wo = ljus::to_local<float>(frame, -d);
            const auto wi = ljus::sample_cosine_hemisphere(ljus::next_2d(stream));
            weight = std::numbers::pi_v<float> * (weight * evaluate(clay, wo, wi));
            next = to_world(frame, wi);
        }
        ray = ljus::spawn_ray<float>(point, next);
    }
    return {};
}
// [trace]

} // namespace

/// Renders three balls on a large one into own_vector.png.
int main() {
    const std::vector<Ball> balls{{{{0, -1000, 0}, 1000}, {0.6f, 0.6f, 0.5f}},
                                  {{{-2.1f, 1, -0.5f}, 1}, {0.8f, 0.3f, 0.2f}},
                                  {{{0, 1, 0.5f}, 1}, {}, true},
                                  {{{2.1f, 1, -0.5f}, 1}, {0.2f, 0.5f, 0.7f}}};
    constexpr int samples = 64;
    ljus::Image image = ljus::make_image(320, 200);
    // [stratified]
    const auto pattern = ljus::make_pattern(ljus::Sampling::multi_jittered, samples);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const std::uint64_t number = std::uint64_t(y * image.width + x);
            const std::uint64_t key = ljus::mix_bits(number);
            Vector sum;
            for (int i = 0; i < samples; ++i) {
                auto stream = ljus::random_stream(1, ljus::Pass::user, 0,
                                                  number * samples + std::uint64_t(i));
                const auto at = ljus::spread(pattern, i, key, ljus::next_2d(stream));
                const Vector d{(float(x) + at.x - 160) / 300,
                               (90 - float(y) - at.y) / 300, -1};
                sum = sum + trace(balls,
                                  {.origin{0, 1.2f, 7},
                                   .direction = glm::normalize(glm::vec3(d))},
                                  stream);
            }
            pixel(image, x, y) = (1.0f / samples) * sum;
        }
    // [stratified]
    save_png(image, "own_vector.png");
}
