// Live: a patch moves away from a lamp: its photons, and the lamp as it sees it.
#include <cmath>
#include <numbers>
#include <vector>

#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/sampling.hpp"

namespace {

using ljus::Vec3;

constexpr double flux = 100; // W
constexpr ljus::Sphere lamp{.center{0, 0, 0}, .radius = 0.2f};
constexpr double lamp_radiance =
    flux / (4 * std::numbers::pi * std::numbers::pi * 0.2 * 0.2);
constexpr int pixels = 96;            // of the picture, along a side
constexpr double picture_width = 1.2; // at distance 1

struct Figure {
    double distance = 1;
    int sent = 0, caught = 0;
    std::vector<float> picture;
};
Figure figure;

/// The patch, half a metre wide: it faces the lamp.
ljus::Quad patch() {
    return {{float(figure.distance), -0.25f, -0.25f}, {0, 0, 0.5f}, {0, 0.5f, 0}};
}

/// The next photon of the lamp: a point of it, and a direction by the cosine.
ljus::Ray next_photon() {
    auto stream =
        ljus::random_stream(1, ljus::Pass::user, 0, std::uint64_t(figure.sent++));
    const Vec3 normal = ljus::sample_uniform_sphere(ljus::next_2d(stream));
    const Vec3 out = ljus::sample_cosine_hemisphere(ljus::next_2d(stream));
    return {.origin = lamp.radius * normal,
            .direction = to_world(ljus::frame_around(normal), out)};
}

} // namespace

extern "C" {

/// Begins anew with the patch at a distance from the middle of the lamp.
[[gnu::used]] void setup(double distance) {
    figure = Figure{};
    figure.distance = distance;
}
[[gnu::used]] double lamp_radius() {
    return double(lamp.radius);
}

/// Sends photons, and counts those that the patch catches.
/// \return How many have been sent.
[[gnu::used]] int send(int photons) {
    for (int i = 0; i < photons; ++i)
        if (intersect(next_photon(), patch())) ++figure.caught;
    return figure.sent;
}
[[gnu::used]] int caught() {
    return figure.caught;
}

/// A photon of the plane of the drawing, not counted: where it starts (x, y), its
/// direction (x, y), and how far it flies, 0 if the patch does not stop it.
[[gnu::used]] const double* shown(int number) {
    static double all[5];
    const int sent = figure.sent;
    for (figure.sent = 1000 * number;;) {
        const ljus::Ray ray = next_photon();
        if (std::abs(ray.direction.z) > 0.05f || std::abs(ray.origin.z) > 0.1f)
            continue;
        const auto hit = intersect(ray, patch());
        const double values[] = {double(ray.origin.x), double(ray.origin.y),
                                 double(ray.direction.x), double(ray.direction.y),
                                 hit ? double(hit->t) : 0};
        std::copy(std::begin(values), std::end(values), all);
        break;
    }
    figure.sent = sent;
    return all;
}

/// The irradiance of the patch by the photons that it has caught, W/m^2.
[[gnu::used]] double counted() {
    return 4 * flux * figure.caught / std::max(figure.sent, 1);
}

[[gnu::used]] double radiance() {
    return lamp_radiance;
}
[[gnu::used]] int picture_size() {
    return pixels;
}
/// What the middle of the patch sees: radiance, row by row.
[[gnu::used]] const float* picture() {
    figure.picture.clear();
    for (int row = 0; row < pixels; ++row)
        for (int column = 0; column < pixels; ++column) {
            const double y = picture_width * (0.5 - (row + 0.5) / pixels);
            const double z = picture_width * ((column + 0.5) / pixels - 0.5);
            const ljus::Ray ray{.origin{float(figure.distance), 0, 0},
                                .direction = normalize(Vec3(-1, y, z))};
            figure.picture.push_back(intersect(ray, lamp) ? float(lamp_radiance)
                                                          : 0.0f);
        }
    return figure.picture.data();
}

/// The solid angle of the lamp, seen from the middle of the patch, sr.
[[gnu::used]] double solid_angle() {
    const double sine = double(lamp.radius) / figure.distance;
    return 2 * std::numbers::pi * (1 - std::sqrt(1 - sine * sine));
}

[[gnu::used]] int checks() {
    return 4;
}
[[gnu::used]] double check(int i) {
    const Figure kept = figure; // the page goes on with its own
    setup(1.5);
    send(5000);
    double number = i == 0 ? caught() : i == 1 ? solid_angle() : shown(3)[3];
    if (i == 3) {
        number = 0;
        picture();
        for (const float value : figure.picture) number += double(value);
    }
    figure = kept;
    return number;
}

/// Directions in float.
[[gnu::used]] double tolerance() {
    return 1e-5;
}

} // extern "C"
