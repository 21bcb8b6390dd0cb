// Live: photons aimed at a ball of glass in Flatland, and the light of the floor below.
#include <cmath>
#include <numbers>
#include <vector>

#include "flatland/density_estimate.hpp"
#include "live/photon_path.hpp"

namespace {

namespace fl = flatland;

constexpr fl::Vec2 lamp{0, 1.9};
constexpr fl::Circle ball{.center{0, 0.85}, .radius = 0.4};
constexpr double half_width = 1.6; // of the floor
constexpr int places = 241;        // of the curve
constexpr double disc = 0.015;     // of an estimate

struct Figure {
    fl::Scene scene;
    int sent = 0;
    fl::PhotonMap floor; // each photon as if it were the only one
    std::vector<float> curve;
};
Figure figure;

/// The half angle of the cone that holds the ball, and some of the floor beside it.
double cone() {
    return 1.4 * std::asin(ball.radius / (lamp.y - ball.center.y));
}

} // namespace

extern "C" {

/// What does not move: lamp, middle and radius of the ball, half width of the floor.
[[gnu::used]] double place(int i) {
    const double all[] = {lamp.y, ball.center.y, ball.radius, half_width};
    return all[i];
}

/// Begins anew with a ball of an index.
[[gnu::used]] void setup(double index) {
    figure = Figure{};
    figure.scene = {
        {{fl::Segment{{-half_width, 0}, {half_width, 0}}, fl::Lambertian{0}},
         {ball, fl::Glass{index}}}};
}

/// Aims the next photon at the ball, and keeps its path.
/// \return How many have been sent.
[[gnu::used]] int send() {
    ljus::RandomStream stream = fl::photon_stream({}, figure.sent++);
    const double angle = cone() * (2 * next_1d<double>(stream) - 1);
    // Of 1 W in all directions; the cone is 2 cone() wide.
    const fl::PathState photon{
        .ray{.origin = lamp, .direction{std::sin(angle), -std::cos(angle)}},
        .throughput = cone() / std::numbers::pi};
    live::follow_photon(figure.scene, photon, stream, 10,
                        [](const fl::PathState& state, const fl::Vertex& vertex) {
                            store_photon(state, vertex, figure.floor);
                        });
    return figure.sent;
}

/// The irradiance along the floor over that which the middle has without a ball.
[[gnu::used]] const float* curve() {
    const double bare = 1 / (2 * std::numbers::pi * lamp.y);
    figure.curve.clear();
    for (int i = 0; i < places; ++i) {
        const fl::SurfacePoint at{
            .position{half_width * (2.0 * i / (places - 1) - 1), 0}};
        const double found =
            estimate_irradiance(figure.floor, at, {.radius = disc}).irradiance;
        figure.curve.push_back(float(found / std::max(figure.sent, 1) / bare));
    }
    return figure.curve.data();
}
[[gnu::used]] int curve_size() {
    return places;
}

[[gnu::used]] int checks() {
    return 3;
}
[[gnu::used]] double check(int i) {
    const Figure shown = figure; // it goes on as it was
    setup(1.6);
    for (int k = 0; k < 1000; ++k) send();
    const double number = i == 0   ? double(figure.floor.size())
                          : i == 1 ? double(curve()[places / 2])
                                   : figure.floor[500].position.x;
    figure = shown;
    return number;
}

/// Sines and cosines of two C libraries differ in their last digit.
[[gnu::used]] double tolerance() {
    return 1e-6;
}

} // extern "C"
