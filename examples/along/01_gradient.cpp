// Step 1, a gradient: the smallest program that makes a picture.
#include <algorithm>
#include <cmath>
#include <cstdio>

// A point, a direction or a colour.
struct Vec {
    double x = 0, y = 0, z = 0;
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(Vec a, Vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec unit(Vec a) { return 1 / std::sqrt(dot(a, a)) * a; }

const int width = 200, height = 200;

Vec sky(double up) { return up * Vec{0.3, 0.5, 0.9} + (1 - up) * Vec{1, 0.9, 0.8}; }

// The byte, 0 to 255, that shows a colour on a screen, with a gamma.
double encoded(double value) { return 255 * std::pow(std::min(value, 1.0), 1 / 2.2); }

int main() {
    std::printf("P3 %d %d 255\n", width, height);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const Vec c = sky(1 - (row + 0.5) / height);
            std::printf("%.0f %.0f %.0f\n", encoded(c.x), encoded(c.y), encoded(c.z));
        }
}
