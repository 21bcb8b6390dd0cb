// Live: a ball far away, seen through a telescope that keeps its size; by the formula
// as printed and by the robust one, both in float, each pixel compared with double.
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <ljus/geometry/sphere.hpp>
#include <ljus/image/color.hpp>

namespace {

using Point = ljus::Vec3T<double>;

constexpr int size = 240;
std::array<unsigned char, 4 * size * size> picture;
int wrong_pixels = 0;

void put(int x, int y, const ljus::Vec3T<double>& color) {
    unsigned char* pixel = &picture[4 * std::size_t(y * size + x)];
    for (int i = 0; i < 3; ++i) pixel[i] = ljus::srgb_byte(color[i]);
    pixel[3] = 255;
}

} // namespace

extern "C" {

/// The picture, 240 by 240 pixels of RGBA, by the printed formula or the robust one.
/// \param azimuth, height  From where one looks, in radians.
/// \param mark             Whether wrong answers are red.
[[gnu::used]] const unsigned char* telescope(int robust, double distance,
                                             double azimuth, double height, int mark) {
    const ljus::Sphere ball{};
    const Point back{std::cos(height) * std::cos(azimuth),
                     std::cos(height) * std::sin(azimuth), std::sin(height)};
    const Point right{-std::sin(azimuth), std::cos(azimuth), 0};
    const Point up = glm::cross(back, right);
    const Point sun = glm::normalize(back + 0.7 * right + 0.8 * up);
    const Point eye = distance * back;
    wrong_pixels = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const Point aim = 2.4 * ((x + 0.5) / size - 0.5) * right +
                              2.4 * (0.5 - (y + 0.5) / size) * up;
            const ljus::Ray ray{.origin = ljus::Vec3(eye),
                                .direction = ljus::Vec3(glm::normalize(aim - eye))};
            const std::optional<float> t = robust
                                               ? ljus::intersect(ray, ball)
                                               : ljus::intersect_as_printed(ray, ball);
            const bool wrong =
                t.has_value() != ljus::intersect<double>(ray, ball).has_value();
            wrong_pixels += wrong;
            if (wrong && mark) {
                put(x, y, {0.8, 0.03, 0.04});
            } else if (t) {
                const Point n{ljus::normal(ball, ljus::point_at(ray, *t))};
                const double light = 0.06 + 0.9 * std::fmax(0.0, glm::dot(n, sun));
                put(x, y, light * Point{0.95, 0.75, 0.4});
            } else {
                put(x, y, {0.05, 0.06, 0.08});
            }
        }
    return picture.data();
}

/// The share of pixels of the last picture whose ray hits or misses wrongly.
[[gnu::used]] double wrong() {
    return double(wrong_pixels) / (size * size);
}

/// How far the float above the square of a distance is from it.
[[gnu::used]] double spacing(double distance) {
    const float square = float(distance * distance);
    return double(std::nextafter(square, std::numeric_limits<float>::infinity()) -
                  square);
}

[[gnu::used]] int checks() {
    return 2 * 6 + 1;
}

[[gnu::used]] double check(int number) {
    if (number == 12) return spacing(1000);
    telescope(number % 2, std::pow(10.0, number / 2 + 1), 0.6, 0.5, 1);
    double sum = 0; // of all bytes, and not only of what is wrong
    for (const unsigned char byte : picture) sum += byte;
    return sum + wrong();
}

/// The directions of the rays are rounded to float: as good as always to the same one.
[[gnu::used]] double tolerance() {
    return 1e-12;
}

} // extern "C"
