// Live: a triangle in the plane z = 0, and rays straight down on it, in pixels.
#include <array>
#include <cmath>

#include <ljus/geometry/triangle.hpp>

namespace {

constexpr int columns = 210, rows = 160, pixel_size = 2;
std::array<unsigned char, 4 * columns * rows> picture;
ljus::TriangleT<double> triangle;

ljus::RayT<double> down_on(double x, double y) {
    return {.origin = {x, y, 1}, .direction = {0, 0, -1}};
}

/// Its area, positive if the corners turn counter-clockwise for one who looks down.
double signed_area(const ljus::TriangleT<double>& of) {
    return glm::cross(of.v2 - of.v1, of.v3 - of.v1).z / 2;
}

} // namespace

extern "C" {

[[gnu::used]] void set_corners(double x1, double y1, double x2, double y2, double x3,
                               double y3) {
    triangle = {{x1, y1, 0}, {x2, y2, 0}, {x3, y3, 0}};
}

[[gnu::used]] double area() {
    return signed_area(triangle);
}

/// The weight of a corner, 0 to 2, at a point: the area of the triangle that the point
/// makes with the other two, as a part of the whole; below 0 beyond their edge.
[[gnu::used]] double weight(int corner, double x, double y) {
    auto part = triangle;
    (corner == 0 ? part.v1 : corner == 1 ? part.v2 : part.v3) = {x, y, 0};
    return signed_area(part) / signed_area(triangle);
}

/// Whether the ray at a point hits.
[[gnu::used]] int hits(double x, double y) {
    return ljus::intersect(down_on(x, y), triangle).has_value();
}

/// A picture, 210 by 160 of RGBA, one ray per pixel: red, green and blue, mixed by the
/// u and v of the hit.
[[gnu::used]] const unsigned char* mixed_colors() {
    constexpr ljus::Vec3T<double> red{214, 69, 80}, green{47, 163, 107},
        blue{59, 142, 208};
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            unsigned char* pixel = &picture[4 * std::size_t(y * columns + x)];
            const auto hit = ljus::intersect(
                down_on(pixel_size * (x + 0.5), pixel_size * (y + 0.5)), triangle);
            pixel[3] = hit ? 255 : 0;
            if (!hit) continue;
            const auto color =
                (1 - hit->u - hit->v) * red + hit->u * green + hit->v * blue;
            for (int i = 0; i < 3; ++i)
                pixel[i] = static_cast<unsigned char>(color[i] + 0.5);
        }
    return picture.data();
}

[[gnu::used]] int checks() {
    return 3 * 4 + 2;
}

[[gnu::used]] double check(int number) {
    set_corners(60.5, 250, 350, 290.25, 180, 40);
    if (number < 12) return weight(number % 3, 100 + 37.0 * (number / 3), 91);
    if (number == 12) return area();
    mixed_colors();
    double sum = 0;
    for (const unsigned char byte : picture) sum += byte;
    return sum;
}

/// Only sums, products and quotients.
[[gnu::used]] double tolerance() {
    return 1e-14;
}

} // extern "C"
