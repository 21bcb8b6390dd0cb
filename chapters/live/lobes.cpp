// Live: where a rough surface sends the light that arrives from one direction. White,
// so that what does not come back is lost. Angles are in degrees.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <ljus/image/color.hpp>
#include <ljus/materials/eon.hpp>
#include <ljus/materials/glossy.hpp>
#include <ljus/materials/lambertian.hpp>
#include <ljus/materials/oren_nayar.hpp>
#include <ljus/math/frame.hpp>
#include <ljus/math/sampling.hpp>

namespace {

using Vec = ljus::Vec3T<double>;

constexpr double degree = std::numbers::pi / 180;
constexpr int points = 181, size = 200;
std::array<float, points> lobe;
std::array<unsigned char, 4 * size * size> picture;

enum Model { lambert, oren_nayar, eon, gloss };

/// f for the light from `wi`, seen from `wo`; of white.
double brdf(int model, double roughness, const Vec& wo, const Vec& wi) {
    const Vec white{1};
    switch (model) {
    case oren_nayar:
        return evaluate(ljus::OrenNayarT<double>{white, roughness}, wo, wi).y;
    case eon:
        return evaluate(ljus::EonT<double>{white, roughness}, wo, wi).y;
    case gloss:
        return evaluate(ljus::GlossyT<double>{white, roughness}, wo, wi).y;
    default:
        return evaluate(ljus::LambertianT<double>{white}, wo, wi).y;
    }
}

Vec direction(double angle) {
    return {std::sin(angle * degree), 0, std::cos(angle * degree)};
}

/// Directions for a mean over the hemisphere: a grid of the unit square.
template <typename Term>
double mean_over_square(Term term) {
    constexpr int steps = 96;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k)
            sum += term(ljus::Vec2T<double>{(i + 0.5) / steps, (k + 0.5) / steps});
    return sum / (steps * steps);
}

} // namespace

extern "C" {

/// pi times f in the plane of the light, seen from -90 to 90 degrees: 1 for Lambert.
/// \param angle  Of the light, on the side of the negative angles.
[[gnu::used]] const float* lobe_curve(int model, double roughness, double angle) {
    for (int i = 0; i < points; ++i)
        lobe[std::size_t(i)] =
            float(std::numbers::pi * brdf(model, roughness, direction(0.995 * (i - 90)),
                                          direction(-angle)));
    return lobe.data();
}

/// The part of the light that comes back: the integral of f cos over all directions.
[[gnu::used]] double albedo(int model, double roughness, double angle) {
    const Vec wi = direction(-angle);
    if (model == gloss) // its lobe is narrow: where its samples go
        return mean_over_square([&](const ljus::Vec2T<double>& u) {
            const ljus::GlossyT<double> surface{Vec{1}, roughness};
            const auto sampled =
                sample(surface, wi, Vec{u, 0}, ljus::Transport::radiance);
            return sampled ? sampled->weight.y : 0.0;
        });
    return mean_over_square([&](const ljus::Vec2T<double>& u) {
        const Vec wo = ljus::sample_cosine_hemisphere(u);
        return std::numbers::pi * brdf(model, roughness, wo, wi);
    });
}

/// A ball of the surface, 200 by 200 of RGBA. A distant lamp stands on the left,
/// `angle` away from the eye; 0: behind the eye.
[[gnu::used]] const unsigned char* ball(int model, double roughness, double angle) {
    const Vec eye{0, 0, 1}, lamp = direction(-angle);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            unsigned char* pixel = &picture[4 * std::size_t(y * size + x)];
            const double across = 2 * (x + 0.5) / size - 1;
            const double up = 1 - 2 * (y + 0.5) / size;
            const double square = across * across + up * up;
            pixel[3] = square < 1 ? 255 : 0;
            if (square >= 1) continue;
            const Vec normal{across, up, std::sqrt(1 - square)};
            const auto frame = ljus::frame_around(normal);
            const Vec wo = to_local(frame, eye), wi = to_local(frame, lamp);
            const double light =
                wi.z > 0 ? std::numbers::pi * wi.z * brdf(model, roughness, wo, wi)
                         : 0.0;
            for (int i = 0; i < 3; ++i) pixel[i] = ljus::srgb_byte(0.9 * light);
        }
    return picture.data();
}

[[gnu::used]] int checks() {
    return 4 * 5 + 4;
}

[[gnu::used]] double check(int number) {
    if (number >= 20) {
        ball(number - 20, 0.7, 40);
        double sum = 0;
        for (const unsigned char byte : picture) sum += byte;
        return sum;
    }
    const int model = number / 5;
    return number % 5 == 0 ? double(lobe_curve(model, 0.6, 50)[30])
                           : albedo(model, 0.2 * (number % 5), 10.0 * (number % 5));
}

/// Sines of two C libraries differ in their last digit, and so may some byte by 1.
[[gnu::used]] double tolerance() {
    return 1e-7;
}

} // extern "C"
