// Live: photons land under a ball of glass, and a density estimate makes light of them.
#include <memory>
#include <vector>

#include "live/ball_over_floor.hpp"

namespace {

constexpr int most = 1500; // photons

struct Figure {
    live::Floor shown;
    std::vector<ljus::Photon> photons;
    ljus::PhotonMap map;
    int sent = 0;
    std::vector<float> picture;
};
std::unique_ptr<Figure> figure;

/// Each photon carries its part of all; those that are still to come are not there yet.
double so_far() {
    return double(most) / std::max(figure->sent, 1);
}

} // namespace

live::Floor& live::floor_shown() {
    return figure->shown;
}

extern "C" {

[[gnu::used]] void setup() {
    figure = std::make_unique<Figure>();
}
[[gnu::used]] int photons_in_all() {
    return most;
}

/// Sends the next photons.
/// \return How many have landed so far.
[[gnu::used]] int land(int photons) {
    const int last = std::min(most, figure->sent + photons);
    const auto traced =
        trace_photons(figure->shown.world, ljus::MapType::caustics,
                      {.photons = most, .threads = 1}, figure->sent, last);
    figure->sent = last;
    figure->photons.insert(figure->photons.end(), traced.photons.begin(),
                           traced.photons.end());
    figure->shown.show(traced.photons);
    figure->map = ljus::make_photon_map(figure->photons, 1);
    return int(figure->photons.size());
}
[[gnu::used]] int sent() {
    return figure->sent;
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

} // extern "C"
