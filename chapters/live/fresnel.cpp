// Live: how much light a boundary reflects, exactly and by Schlick's formula, and what
// one sees who looks at it. Angles are in degrees from the normal.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <ljus/image/color.hpp>
#include <ljus/optics/fresnel.hpp>
#include <ljus/optics/refraction.hpp>
#include <ljus/optics/schlick.hpp>

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int points = 181; // every half degree
constexpr int size = 240;

std::array<float, 3 * points> curves;
std::array<unsigned char, 4 * size * size> picture;

/// Rings and sectors of a sky, so that one sees where its directions have gone.
ljus::Vec3T<double> pattern(const ljus::Vec3T<double>& from,
                            const ljus::Vec3T<double>& color) {
    const double angle =
        std::atan2(std::hypot(from.x, from.y), std::abs(from.z)) / degree;
    const double turn = std::atan2(from.y, from.x) / degree + 180;
    const bool odd = (int(angle / 15) + int(turn / 30)) % 2 != 0;
    return odd ? 0.6 * color : color;
}

} // namespace

extern "C" {

/// The reflected share: 0 exact, 1 Schlick with the angle of the thinner side,
/// 2 Schlick with the angle of the incoming light, as printed.
[[gnu::used]] double reflected(int formula, double angle, double n_1, double n_2) {
    const double c = std::max(0.0, std::cos(angle * degree));
    if (formula == 0) return ljus::fresnel(c, n_1, n_2);
    if (formula == 1) return ljus::schlick_dielectric(c, n_1, n_2);
    return ljus::schlick(ljus::schlick_r0(n_1, n_2), c);
}

/// The three curves from 0 to 90 degrees, one behind the other.
[[gnu::used]] const float* share_curves(double n_1, double n_2) {
    for (int i = 0; i < 3 * points; ++i)
        curves[std::size_t(i)] =
            float(reflected(i / points, (i % points) / 2.0, n_1, n_2));
    return curves.data();
}

/// From where on everything is reflected; 90 if there is no such angle.
[[gnu::used]] double critical_angle(double n_1, double n_2) {
    return n_1 > n_2 ? std::asin(n_2 / n_1) / degree : 90;
}

/// The half space of directions towards the boundary as a disc, straight on in the
/// middle, the horizon at its rim: blue is mirrored, orange comes from the other side.
[[gnu::used]] const unsigned char* view(int formula, double n_1, double n_2) {
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            unsigned char* pixel = &picture[4 * std::size_t(y * size + x)];
            const double across = 2 * (x + 0.5) / size - 1;
            const double up = 1 - 2 * (y + 0.5) / size;
            const double radius = std::hypot(across, up);
            pixel[3] = radius < 1 ? 255 : 0;
            if (radius >= 1) continue;
            const double angle = 90 * radius;
            const double sine = std::sin(angle * degree);
            const ljus::Vec3T<double> seen{sine * across / radius, sine * up / radius,
                                           std::cos(angle * degree)};
            const double r = reflected(formula, angle, n_1, n_2);
            auto color = r * pattern(seen, {0.10, 0.28, 0.62});
            if (const auto beyond = ljus::refract(-seen, {0, 0, 1}, n_1 / n_2))
                color += (1 - r) * pattern(-*beyond, {1.0, 0.62, 0.22});
            for (int i = 0; i < 3; ++i) pixel[i] = ljus::srgb_byte(color[i]);
        }
    return picture.data();
}

[[gnu::used]] int checks() {
    return 3 * 19 + 3;
}

[[gnu::used]] double check(int number) {
    if (number < 57) return reflected(number / 19, 5.0 * (number % 19), 1.5, 1.2);
    if (number == 57) return critical_angle(1.5, 1);
    if (number == 58) return share_curves(1, 1.33)[points + 120];
    view(1, 1.33, 1);
    double sum = 0;
    for (const unsigned char byte : picture) sum += byte;
    return sum;
}

/// Sines of two C libraries differ in their last digit, and so may some byte by 1.
[[gnu::used]] double tolerance() {
    return 1e-7;
}

} // extern "C"
