// Step 3, Lambert's cosine: a small lamp lights the sphere.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

const double pi = std::numbers::pi;
const double infinity = HUGE_VAL;
const double epsilon = 1e-6; // m; a hit below this is the surface that the ray leaves

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

struct Ray {
    Vec origin, direction; // the direction has length 1
};

struct Sphere {
    Vec centre;
    double radius;
    Vec albedo;
};

const Sphere ball{{0, 0, 0}, 0.8, {0.8, 0.6, 0.2}};
const Vec lamp{2, 3, 3};
const double lamp_intensity = 25; // W/sr

// The distance to a sphere along a ray.
double distance(Ray ray, Sphere sphere) {
    const Vec to = sphere.centre - ray.origin;
    const double middle = dot(to, ray.direction);
    const Vec off = to - middle * ray.direction;
    const double square = sphere.radius * sphere.radius - dot(off, off);
    if (square < 0) return infinity;
    const double half = std::sqrt(square);
    if (middle - half > epsilon) return middle - half;
    return middle + half > epsilon ? middle + half : infinity;
}

// The first surface that a ray meets.
struct Hit {
    double t = infinity;
    Vec point, normal, albedo;
};

Hit intersect(Ray ray) {
    Hit hit;
    if (const double t = distance(ray, ball); t < hit.t) {
        const Vec point = ray.origin + t * ray.direction;
        hit = {t, point, unit(point - ball.centre), ball.albedo};
    }
    return hit;
}

// The direct light that a diffuse surface reflects: light straight from the lamp.
Vec direct_light(Hit hit) {
    const Vec to = lamp - hit.point, direction = unit(to);
    const double square = dot(to, to), cosine = dot(direction, hit.normal);
    if (cosine <= 0) return {};
    const double irradiance = lamp_intensity * cosine / square; // W/m^2
    return irradiance / pi * hit.albedo;
}

const int width = 200, height = 200;

// The ray through a point of the picture, in pixels from its upper left corner.
Ray camera_ray(double x, double y) {
    const Vec eye{0, 0, 2.9};
    return {eye, unit({0.9 * (x / width - 0.5), 0.9 * (0.5 - y / height), -1})};
}

Vec sky(double up) { return up * Vec{0.3, 0.5, 0.9} + (1 - up) * Vec{1, 0.9, 0.8}; }

// The radiance that arrives along a ray, in W/(m^2 sr).
Vec radiance(Ray ray) {
    const Hit hit = intersect(ray);
    return hit.t < infinity ? direct_light(hit) : sky(0.5 + ray.direction.y);
}

// The byte, 0 to 255, that shows a colour on a screen, with a gamma.
double encoded(double value) { return 255 * std::pow(std::min(value, 1.0), 1 / 2.2); }

int main() {
    std::printf("P3 %d %d 255\n", width, height);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const Vec c = radiance(camera_ray(column + 0.5, row + 0.5));
            std::printf("%.0f %.0f %.0f\n", encoded(c.x), encoded(c.y), encoded(c.z));
        }
}
