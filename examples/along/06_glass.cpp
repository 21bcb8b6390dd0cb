// Step 6, mirror and glass: a ray goes on until it meets a diffuse surface.
#include <algorithm>
#include <cmath>
#include <cstdint>
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

// Random numbers in [0, 1), by Marsaglia's xorshift with the scrambling of Vigna.
struct Random {
    std::uint64_t state = 1;
    double operator()() {
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        return double(state * 0x2545F4914F6CDD1D >> 11) * 0x1p-53;
    }
};

struct Ray {
    Vec origin, direction; // the direction has length 1
};

struct Sphere {
    Vec centre;
    double radius;
    double index; // of refraction; 0 for a mirror
};

const Sphere spheres[] = {
    {{-0.45, -0.6, -0.4}, 0.4, 0},   // a mirror
    {{0.45, -0.65, 0.1}, 0.35, 1.5}, // glass
};

struct Wall {
    Vec point, normal, albedo;
};

const Wall walls[] = {
    {{0, -1, 0}, {0, 1, 0}, {0.75, 0.75, 0.75}}, // floor
    {{0, 1, 0}, {0, -1, 0}, {0.75, 0.75, 0.75}}, // ceiling
    {{0, 0, -1}, {0, 0, 1}, {0.75, 0.75, 0.75}}, // back
    {{0, 0, 3}, {0, 0, -1}, {0.75, 0.75, 0.75}}, // behind the eye
    {{-1, 0, 0}, {1, 0, 0}, {0.75, 0.25, 0.2}},  // left
    {{1, 0, 0}, {-1, 0, 0}, {0.25, 0.35, 0.75}}, // right
};

// The lamp is the part of the ceiling where |x| and |z| are below lamp_half.
const double lamp_half = 0.15, lamp_area = 4 * lamp_half * lamp_half; // m, m^2
const Vec lamp_radiance{50, 50, 50};                                  // W/(m^2 sr)

Vec lamp_point(Random& random) {
    const double x = 2 * random() - 1, z = 2 * random() - 1;
    return {lamp_half * x, 1, lamp_half * z};
}

bool is_lamp(Vec p) {
    return p.y > 1 - epsilon && std::max(std::abs(p.x), std::abs(p.z)) < lamp_half;
}

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

// The distance to the front of a wall.
double distance(Ray ray, Wall wall) {
    const double cosine = dot(ray.direction, wall.normal);
    const double t = dot(wall.point - ray.origin, wall.normal) / cosine;
    return cosine < 0 && t > epsilon ? t : infinity;
}

// The first surface that a ray meets.
struct Hit {
    double t = infinity;
    Vec point, normal, albedo;
    const Sphere* sphere = nullptr; // null for a diffuse surface
};

Hit intersect(Ray ray) {
    Hit hit;
    for (const Sphere& sphere : spheres)
        if (const double t = distance(ray, sphere); t < hit.t) {
            const Vec point = ray.origin + t * ray.direction;
            hit = {t, point, unit(point - sphere.centre), {}, &sphere};
        }
    for (const Wall& wall : walls)
        if (const double t = distance(ray, wall); t < hit.t)
            hit = {t, ray.origin + t * ray.direction, wall.normal, wall.albedo};
    return hit;
}

// The direction of a ray after a mirror or glass, chosen by Fresnel's equations.
Ray scatter(Ray ray, Hit hit, Random& random) {
    const double cosine = dot(ray.direction, hit.normal);
    const Ray mirrored{hit.point, ray.direction - 2 * cosine * hit.normal};
    if (hit.sphere->index == 0) return mirrored;
    const double n = hit.sphere->index, eta = cosine < 0 ? 1 / n : n; // n1 / n2
    const double square = 1 - eta * eta * (1 - cosine * cosine);
    if (square < 0) return mirrored; // total reflection
    const double c1 = std::abs(cosine), c2 = std::sqrt(square);
    const double rs = (eta * c1 - c2) / (eta * c1 + c2);
    const double rp = (c1 - eta * c2) / (c1 + eta * c2);
    if (random() < (rs * rs + rp * rp) / 2) return mirrored;
    const Vec normal = cosine < 0 ? hit.normal : -1 * hit.normal;
    return {hit.point, eta * ray.direction + (eta * c1 - c2) * normal};
}

// The first diffuse surface that a ray reaches through mirrors and glass.
Hit trace(Ray ray, Random& random) {
    Hit hit = intersect(ray);
    while (hit.sphere) {
        ray = scatter(ray, hit, random);
        hit = intersect(ray);
    }
    return hit;
}

// The direct light that a diffuse surface reflects: light straight from the lamp.
Vec direct_light(Hit hit, Random& random) {
    const Vec to = lamp_point(random) - hit.point, direction = unit(to);
    const double square = dot(to, to), cosine = dot(direction, hit.normal);
    const double t = intersect({hit.point, direction}).t;
    if (cosine <= 0 || t < std::sqrt(square) - epsilon) return {};
    const double lamp_cosine = std::max(direction.y, 0.0);
    const Vec irradiance = lamp_area * lamp_cosine * cosine / square * lamp_radiance;
    return 1 / pi * hit.albedo * irradiance;
}

const int width = 200, height = 200;
const int samples = 16; // rays per pixel

// The ray through a point of the picture, in pixels from its upper left corner.
Ray camera_ray(double x, double y) {
    const Vec eye{0, 0, 2.9};
    return {eye, unit({0.9 * (x / width - 0.5), 0.9 * (0.5 - y / height), -1})};
}

// The radiance that arrives along a ray, in W/(m^2 sr).
Vec radiance(Ray ray, Random& random) {
    const Hit hit = trace(ray, random);
    return is_lamp(hit.point) ? lamp_radiance : direct_light(hit, random);
}

// The byte, 0 to 255, that shows a colour on a screen, with a gamma.
double encoded(double value) { return 255 * std::pow(std::min(value, 1.0), 1 / 2.2); }

int main() {
    Random random;
    std::printf("P3 %d %d 255\n", width, height);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            Vec c;
            for (int i = 0; i < samples; ++i) {
                const double x = column + random(), y = row + random();
                c = c + radiance(camera_ray(x, y), random);
            }
            c = 1.0 / samples * c;
            std::printf("%.0f %.0f %.0f\n", encoded(c.x), encoded(c.y), encoded(c.z));
        }
}
