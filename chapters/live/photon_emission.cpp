// Live: photons in a closed room of Flatland; Russian roulette at each wall.
#include <algorithm>
#include <cmath>
#include <vector>

#include "flatland/room.hpp"
#include "live/photon_path.hpp"

namespace {

namespace fl = flatland;

constexpr double lamp_from = -0.2, lamp_to = 0.2; // under the ceiling

/// Walls and lamp reflect the same; no photon can leave.
fl::Scene closed_room(double albedo) {
    const fl::Lambertian wall{albedo};
    const fl::Vec2 left = fl::room_floor.from, right = fl::room_floor.to;
    const double h = fl::room_height;
    const fl::Segment lamp{{lamp_to, h}, {lamp_from, h}};
    return {{{fl::room_floor, wall},
             {fl::Segment{right, {1, h}}, wall},
             {fl::Segment{{1, h}, lamp.from}, wall},
             {lamp, wall, 1 / (2 * length(lamp))}, // 1 W
             {fl::Segment{lamp.to, {-1, h}}, wall},
             {fl::Segment{{-1, h}, left}, wall}}};
}

struct Figure {
    fl::Scene scene = closed_room(0.5);
    int sent = 0;
    std::vector<int> arrived = std::vector<int>(1000, 0); // at the k-th surface
};
Figure figure;

} // namespace

extern "C" {

[[gnu::used]] double lamp(int end) {
    return end == 0 ? lamp_from : lamp_to;
}
[[gnu::used]] double height() {
    return fl::room_height;
}

/// Begins anew with walls of an albedo.
[[gnu::used]] void setup(double albedo) {
    figure = Figure{};
    figure.scene = closed_room(albedo);
}

/// Sends the next photons and keeps the path of the last.
/// \return How many have been sent.
[[gnu::used]] int send(int photons) {
    for (int i = 0; i < photons; ++i) {
        ljus::RandomStream stream = fl::photon_stream({}, figure.sent++);
        const fl::PathState photon = emit_photon(figure.scene, 1, stream);
        live::follow_photon(figure.scene, photon, stream, 1000,
                            [](const fl::PathState& state, const fl::Vertex&) {
                                ++figure.arrived[std::size_t(state.depth - 1)];
                            });
    }
    return figure.sent;
}

/// How many photons have arrived at their k-th surface, k = 1, 2, ...
[[gnu::used]] int arrived(int k) {
    return figure.arrived[std::size_t(k - 1)];
}
/// How many surfaces the photons have met, all together.
[[gnu::used]] double met() {
    double sum = 0;
    for (const int count : figure.arrived) sum += count;
    return sum;
}

[[gnu::used]] int checks() {
    return 4;
}
[[gnu::used]] double check(int i) {
    const Figure shown = figure; // it goes on as it was
    setup(0.75);
    send(1000);
    const double number = i == 0   ? met()
                          : i == 1 ? arrived(5)
                          : i == 2 ? double(path()[2])
                                   : double(live::last_path.back());
    figure = shown;
    return number;
}

/// Sines and cosines of two C libraries differ in their last digit.
[[gnu::used]] double tolerance() {
    return 1e-6;
}

} // extern "C"
