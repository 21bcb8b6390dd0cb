/// \file flatland.cpp
/// \brief The live figure of chapter 23: photons land in Flatland, and a disc grows
/// until it holds k of them.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "flatland/density_estimate.hpp"
#include "flatland/room.hpp"

namespace {

namespace fl = flatland;

/// How many places of the floor a curve has.
constexpr int places = 201;
/// How many parts of the floor count the photons of the reference.
constexpr int bins = 100;

/// What the figure shows. One for the page: a module has no other state.
struct Figure {
    fl::RoomSettings settings{}; ///< Where the reader has put the lamp.
    fl::Scene scene{};           ///< The room.
    int landed = 0;              ///< Photons that have left the lamp so far.
    fl::PhotonMap floor{};       ///< Those on the floor; each of 1 W until it is asked.
    std::vector<float> dots{};   ///< Of every photon stored: x, y, kind.
    std::vector<float> path{};   ///< Of the last photon: x, y, kind at each vertex.
    double radius = 0;           ///< Of the last disc.
    std::uint64_t counted = 0;   ///< Photons of the reference.
    std::vector<double> bin_flux =
        std::vector<double>(bins, 0.0);                          ///< In W, all of 1 W.
    std::vector<float> curve = std::vector<float>(places, 0.0f); ///< For the page.
    std::vector<float> reference = std::vector<float>(bins, 0.0f); ///< For the page.
};

Figure figure;

/// A place of the floor.
fl::SurfacePoint on_floor(double x) {
    return {.position{x, 0}, .normal{0, 1}};
}

/// What the photons say so far, in W/m, as if all the lamp's flux were in them.
fl::Estimate estimate_at(double x, int k) {
    const std::size_t nearest = std::size_t(std::max(k, 2));
    fl::Estimate found = estimate_irradiance(figure.floor, on_floor(x),
                                             {.radius = 0.5, .nearest = nearest});
    found.irradiance *= figure.settings.flux / std::max(figure.landed, 1);
    return found;
}

/// The photons of the reference have a seed of their own.
constexpr std::uint64_t reference_seed = 1000;

} // namespace

extern "C" {

/// What of the room does not move: the disc of glass (x, y, radius), the ends of the
/// mirror, the height.
[[gnu::used]] double room(int i) {
    const auto& disc = fl::room_disc;
    const auto& mirror = fl::room_mirror;
    const double all[] = {disc.center.x, disc.center.y, disc.radius, mirror.from.x,
                          mirror.from.y, mirror.to.x,   mirror.to.y, fl::room_height};
    return all[i];
}

/// How far the lamp may be dragged: inside the room, and not into the glass.
/// \return 1 if the place is allowed.
[[gnu::used]] int lamp_may_be(double x, double y) {
    const double margin = 2 * figure.settings.lamp_size;
    const fl::Vec2 place{x, y};
    const auto& mirror = fl::room_mirror;
    const fl::Vec2 along = glm::normalize(mirror.to - mirror.from);
    const double behind = glm::dot(place - mirror.from, normal(mirror, place));
    const double beside = glm::dot(place - mirror.from, along);
    const bool at_mirror = std::abs(behind) < margin && beside > -margin &&
                           beside < length(mirror) + margin;
    return std::abs(x) < 1 - margin && y > margin && y < fl::room_height - margin &&
           glm::distance(place, fl::room_disc.center) > fl::room_disc.radius + margin &&
           !at_mirror;
}

/// Begins anew with the lamp at a place and glass of an index.
[[gnu::used]] void setup(double x, double y, double index) {
    Figure next;
    next.settings.lamp = lamp_may_be(x, y) ? fl::Vec2{x, y} : figure.settings.lamp;
    next.settings.index = index;
    next.scene = make_room(next.settings);
    figure = next;
}

/// Sends some photons, the next ones, and keeps the path of the last.
/// \return How many have been sent so far.
[[gnu::used]] int land(int photons) {
    for (int i = 0; i < photons; ++i) {
        ljus::RandomStream stream = fl::photon_stream({}, figure.landed++);
        const fl::PathState photon = emit_photon(figure.scene, 1, stream);
        figure.path = {float(photon.ray.origin.x), float(photon.ray.origin.y), 0};
        const auto visit = [](const fl::PathState& path, const fl::Vertex& vertex) {
            const fl::Vec2 at = vertex.point.position;
            fl::PhotonMap kept;
            store_photon(path, vertex, kept);
            if (vertex.id == 0)
                figure.floor.insert(figure.floor.end(), kept.begin(), kept.end());
            const bool seen = !kept.empty() && !(vertex.object.emission > 0);
            const float kind = float(kind_of(path));
            for (const float value : {float(at.x), float(at.y), kind}) {
                figure.path.push_back(value);
                if (seen) figure.dots.push_back(value);
            }
        };
        trace_photon(figure.scene, photon, stream, 1000, visit);
    }
    return figure.landed;
}

/// The path of the last photon: x, y, kind of each vertex.
[[gnu::used]] const float* path() {
    return figure.path.data();
}
/// How many vertices it has, the lamp included.
[[gnu::used]] int path_size() {
    return int(figure.path.size() / 3);
}

/// All photons that are stored: x, y, kind.
[[gnu::used]] const float* dots() {
    return figure.dots.data();
}
/// How many there are.
[[gnu::used]] int dots_size() {
    return int(figure.dots.size() / 3);
}

/// The irradiance by the k nearest photons at a place of the floor, in W/m.
[[gnu::used]] double estimate(double x, int k) {
    const fl::Estimate found = estimate_at(x, k);
    figure.radius = found.radius;
    return found.irradiance;
}
/// The radius of the disc of the last estimate, in metres.
[[gnu::used]] double disc() {
    return figure.radius;
}

/// The estimate at places of the floor, evenly spaced from end to end.
[[gnu::used]] const float* curve(int k) {
    for (int i = 0; i < places; ++i)
        figure.curve[std::size_t(i)] =
            float(estimate_at(-1 + 2.0 * i / (places - 1), k).irradiance);
    return figure.curve.data();
}
/// How many places.
[[gnu::used]] int curve_size() {
    return places;
}

/// Sends more photons of the reference and counts those that come to the floor.
/// \return How many have been sent so far.
[[gnu::used]] double count_reference(int photons) {
    for (int i = 0; i < photons; ++i) {
        ljus::RandomStream stream = ljus::random_stream(
            reference_seed, ljus::Pass::general_photons, 0, figure.counted++);
        trace_photon(
            figure.scene, emit_photon(figure.scene, 1, stream), stream, 1000,
            [](const fl::PathState&, const fl::Vertex& vertex) {
                if (vertex.id != 0) return;
                const double part = (vertex.point.position.x + 1) / 2 * bins;
                figure.bin_flux[std::size_t(std::clamp(int(part), 0, bins - 1))] += 1;
            });
    }
    return double(figure.counted);
}

/// The irradiance in each part of the floor, by counting, in W/m.
[[gnu::used]] const float* reference() {
    const double watt =
        figure.settings.flux / std::max(1.0, double(figure.counted)) / (2.0 / bins);
    for (std::size_t i = 0; i < bins; ++i)
        figure.reference[i] = float(figure.bin_flux[i] * watt);
    return figure.reference.data();
}
/// How many parts.
[[gnu::used]] int reference_size() {
    return bins;
}

/// How many numbers check() has.
[[gnu::used]] int checks() {
    return 8;
}

/// What the test compares: the same in the page and in the native program.
[[gnu::used]] double check(int i) {
    const Figure shown = figure; // it goes on as it was
    setup(-0.45, 0.95, 1.5);
    land(2000);
    double number = 0;
    if (i == 0) number = double(figure.floor.size());
    if (i == 1)
        for (const float value : figure.dots) number += double(value);
    if (i == 2) number = estimate(0.3, 50);
    if (i == 3) number = (void(estimate(0.3, 50)), disc());
    if (i == 4) number = estimate(-0.99, 50);
    if (i == 5) number = estimate(0.99, 500);
    if (i == 6) number = (count_reference(2000), double(reference()[60]));
    if (i == 7) number = (setup(0.5, 0.5, 1.7), land(500), estimate(0, 20));
    figure = shown;
    return number;
}

/// Sines and cosines of two C libraries differ in their last digit.
[[gnu::used]] double tolerance() {
    return 1e-9;
}

} // extern "C"
