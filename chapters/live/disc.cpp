// Live: the disc of a density estimate near the edge of a floor, and at the foot of a
// thin wall.
#include <array>
#include <memory>
#include <numbers>
#include <vector>

#include "experiments/two_rooms.hpp"
#include "ljus/geometry/facet.hpp"
#include "ljus/photons/density_estimate.hpp"
#include "ljus/photons/kernel_border.hpp"
#include "ljus/photons/tracing.hpp"

namespace {

using ljus::Rgb, ljus::Vec3;

constexpr int steps = 160; // of the curve along the floor
constexpr double lamp_radiance = 8;

struct Figure {
    examples::TwoRooms rooms = examples::two_rooms();
    ljus::PhotonMap map;
    std::vector<float> on_floor; ///< x and z of the floor's photons.
};
std::unique_ptr<Figure> figure;
std::array<double, 2 * (steps + 1)> curve; // as it is, then corrected

/// The floor at a place: a ray straight down says what it is.
ljus::Vertex floor_at(double x, double z) {
    const ljus::Ray down{.origin{float(x), 0.1f, float(z)}, .direction{0, -1, 0}};
    return vertex_at(figure->rooms.world, down,
                     *closest_hit(figure->rooms.world, down));
}

struct Estimates {
    double plain = 0, corrected = 0;
};
Estimates estimate_at(double x, double z, double radius) {
    const ljus::Vertex floor = floor_at(x, z);
    std::uint64_t gathered = 0;
    const Rgb sent = estimate_radiance(
        figure->map, floor, ljus::Lambertian{.albedo = Rgb{1}}, Vec3{0, 0, 1},
        {.radius = float(radius)}, one_kind(ljus::PhotonKind::direct), gathered);
    const double plain = double(sent.x) * std::numbers::pi / lamp_radiance;
    const double part = double(ljus::part_on_surface(
        figure->rooms.world, floor, floor.point.normal, float(radius)));
    return {plain, plain / part};
}

/// A place of the floor: not its edge itself, nor the foot of the wall, where a ray
/// straight down may miss.
double inside(double x) {
    const double within = x < -0.9999 ? -0.9999 : x > 0.9999 ? 0.9999 : x;
    return within > -1e-4 && within < 1e-4 ? (within < 0 ? -1e-4 : 1e-4) : within;
}

} // namespace

extern "C" {

/// Sends photons; those on the floor can be drawn.
/// \return How many lie there.
[[gnu::used]] int trace(int photons, int seed) {
    figure = std::make_unique<Figure>();
    const auto traced = trace_photons(figure->rooms.world, ljus::MapType::general,
                                      {.photons = photons,
                                       .seed = static_cast<std::uint64_t>(seed),
                                       .max_bounces = 1,
                                       .shadow_photons = false,
                                       .threads = 1});
    figure->map = make_photon_map(traced.photons, 1);
    for (const ljus::Photon& photon : traced.photons)
        if (photon.normal.y > 120 && photon.position.y < 1e-3f) {
            figure->on_floor.push_back(photon.position.x);
            figure->on_floor.push_back(photon.position.z);
        }
    return static_cast<int>(figure->on_floor.size() / 2);
}
[[gnu::used]] const float* floor_photons() { return figure->on_floor.data(); }

/// The irradiance from a lamp of radiance 1, as Lambert's formula has it.
[[gnu::used]] double exact(double x, double z) {
    const ljus::Facet lamp = facet_of(figure->rooms.lamp);
    if (x > 0) return 0; // the wall hides the lamp
    return std::numbers::pi * ljus::form_factor_at({x, 0, z}, {0, 1, 0}, lamp);
}

/// The part of the disc that the library's correction divides by.
[[gnu::used]] double part_of_disc(double x, double z, double radius) {
    const ljus::Vertex floor = floor_at(inside(x), z);
    return double(ljus::part_on_surface(figure->rooms.world, floor,
                                        floor.point.normal, float(radius)));
}

/// The estimate by the photons, as it is or corrected at edges.
[[gnu::used]] double estimate(double x, double z, double radius, int corrected) {
    const Estimates found = estimate_at(inside(x), z, radius);
    return corrected ? found.corrected : found.plain;
}

[[gnu::used]] int curve_steps() { return steps; }
/// The estimate along the floor, at 161 places, as it is and corrected.
[[gnu::used]] const double* along(double z, double radius) {
    for (int i = 0; i <= steps; ++i) {
        const Estimates found = estimate_at(inside(2.0 * i / steps - 1), z, radius);
        curve[std::size_t(i)] = found.plain;
        curve[std::size_t(i + steps + 1)] = found.corrected;
    }
    return curve.data();
}

/// The same by other photons, which are not kept: for the mean over many maps.
[[gnu::used]] const double* along_others(int photons, int seed, double z,
                                         double radius) {
    auto kept = std::move(figure);
    trace(photons, seed);
    along(z, radius);
    figure = std::move(kept);
    return curve.data();
}

[[gnu::used]] int checks() { return 8; }
[[gnu::used]] double check(int i) {
    auto kept = std::move(figure); // the page goes on with its own
    trace(5000, 3);
    const double x = i % 4 == 0 ? -1 : i % 4 == 1 ? -0.5 : i % 4 == 2 ? -1e-4 : 0.05;
    const double found = i < 4   ? estimate(x, 0.5, 0.15, 1)
                         : i < 7 ? part_of_disc(x, 0.1, 0.15)
                                 : exact(-0.5, 0.5);
    figure = std::move(kept);
    return found;
}

/// Photons in float; a last digit of a sine moves each of them a little.
[[gnu::used]] double tolerance() { return 1e-5; }

} // extern "C"
