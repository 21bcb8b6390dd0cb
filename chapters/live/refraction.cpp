// Live: a ray at a boundary of two media, bent by Snell's law and shared out by
// Fresnel's equations. Angles are in degrees from the normal; the ray comes from above.
#include <array>
#include <cmath>
#include <numbers>

#include <ljus/optics/fresnel.hpp>
#include <ljus/optics/refraction.hpp>
#include <ljus/optics/schlick.hpp>

namespace {

constexpr double degree = std::numbers::pi / 180;

double cosine(double angle) {
    return std::cos(angle * degree);
}

std::array<float, 2 * 91> curves; // exact, then Schlick: for 0 to 90 degrees

} // namespace

extern "C" {

/// The angle of the refracted ray; -1 under total internal reflection.
[[gnu::used]] double refracted(double angle, double n_1, double n_2) {
    const ljus::Vec3T<double> down{std::sin(angle * degree), 0, -cosine(angle)};
    const auto through = ljus::refract(down, {0, 0, 1}, n_1 / n_2);
    return through ? std::atan2(through->x, -through->z) / degree : -1;
}

/// The share of the light that is reflected.
[[gnu::used]] double reflected(double angle, double n_1, double n_2) {
    return ljus::fresnel(cosine(angle), n_1, n_2);
}

/// Both curves of the reflected share against the angle.
[[gnu::used]] const float* share_curves(double n_1, double n_2) {
    for (int angle = 0; angle <= 90; ++angle) {
        const auto i = std::size_t(angle);
        curves[i] = float(ljus::fresnel(cosine(angle), n_1, n_2));
        curves[91 + i] = float(ljus::schlick_dielectric(cosine(angle), n_1, n_2));
    }
    return curves.data();
}

[[gnu::used]] int checks() {
    return 2 * 19 + 2;
}

[[gnu::used]] double check(int number) {
    if (number < 19) return refracted(5.0 * number, 1, 1.5);
    if (number < 38) return reflected(5.0 * (number - 19), 1.5, 1);
    return share_curves(1, 1.5)[number == 38 ? 60 : 91 + 60];
}

/// Sines and cosines of two C libraries differ in their last digit.
[[gnu::used]] double tolerance() {
    return 1e-12;
}

} // extern "C"
