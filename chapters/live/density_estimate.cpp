// Live: photons land under a ball of glass, and a density estimate makes light of them.
#include <memory>
#include <vector>

#include "live/ball_over_floor.hpp"

namespace {

constexpr int most = 1500; // photons

struct Figure {
    ljus::World<live::Stage> world = live::ball_over_floor();
    std::vector<ljus::Photon> photons;
    ljus::PhotonMap map;
    int sent = 0;
    std::vector<float> dots; // x and z of each photon
    std::vector<float> picture, line, reference;
    live::Rings rings;
};
std::unique_ptr<Figure> figure;

/// Each photon carries its part of all; those that are still to come are not there yet.
double so_far() {
    return double(most) / std::max(figure->sent, 1);
}

} // namespace

extern "C" {

[[gnu::used]] void setup() {
    figure = std::make_unique<Figure>();
}
[[gnu::used]] double width() {
    return 2 * double(live::half_width);
}
[[gnu::used]] int picture_size() {
    return live::cells;
}
[[gnu::used]] int photons_in_all() {
    return most;
}

/// Sends the next photons.
/// \return How many have landed so far.
[[gnu::used]] int land(int photons) {
    const int last = std::min(most, figure->sent + photons);
    const auto traced =
        trace_photons(figure->world, ljus::MapType::caustics,
                      {.photons = most, .threads = 1}, figure->sent, last);
    figure->sent = last;
    for (const ljus::Photon& photon : traced.photons) {
        figure->photons.push_back(photon);
        figure->dots.push_back(photon.position.x);
        figure->dots.push_back(photon.position.z);
    }
    figure->map = ljus::make_photon_map(figure->photons, 1);
    return int(figure->photons.size());
}
[[gnu::used]] int sent() {
    return figure->sent;
}
[[gnu::used]] const float* dots() {
    return figure->dots.data();
}

/// The irradiance by discs of a radius, W/m^2, in the cells of the floor.
[[gnu::used]] const float* picture(double radius) {
    figure->picture = live::picture_by(figure->map, float(radius));
    for (float& value : figure->picture) value *= float(so_far());
    return figure->picture.data();
}

/// The irradiance at a place of the floor's middle line.
[[gnu::used]] double estimate(double x, double radius) {
    return so_far() * examples::irradiance_read(figure->map, {float(x), 0, 0},
                                                {0, 1, 0}, {.radius = float(radius)});
}

/// Counts more photons in rings, and returns how many so far.
[[gnu::used]] double count_reference(int photons) {
    if (photons > 0) figure->rings.count(figure->world, photons);
    return double(figure->rings.sent);
}
[[gnu::used]] int reference_size() {
    return live::rings;
}
[[gnu::used]] double reference(int ring) {
    return figure->rings.irradiance(ring);
}

[[gnu::used]] int checks() {
    return 5;
}
[[gnu::used]] double check(int i) {
    auto kept = std::move(figure); // the page goes on with its own
    setup();
    const int landed = land(2000);
    const double found = i == 0   ? landed
                         : i == 1 ? estimate(0, 0.02)
                         : i == 2 ? estimate(0.1, 0.05)
                         : i == 3 ? double(picture(0.05)[live::cells * 20 + 30])
                                  : (count_reference(3000), reference(20));
    figure = std::move(kept);
    return found;
}

/// Photons in float; a last digit of a sine moves each of them a little.
[[gnu::used]] double tolerance() {
    return 1e-4;
}

} // extern "C"
