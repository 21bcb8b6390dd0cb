// Live: pass after pass of photons under a ball of glass, with a disc that shrinks.
#include <cmath>
#include <memory>
#include <vector>

#include "live/ball_over_floor.hpp"
#include "ljus/render/progressive.hpp"

namespace {

constexpr int photons = 500; // aimed in a pass
constexpr double first_radius = 0.025;
constexpr int places = 2 * live::rings; // of the middle line

struct Figure {
    live::Floor shown;
    ljus::ProgressiveState floor;            // its cells
    ljus::ProgressiveState line;             // its middle line
    ljus::ProgressiveState same{.alpha = 1}; // the line, by discs that do not shrink
    std::vector<double> radii;               // of each pass
    std::vector<float> picture, values;
};
std::unique_ptr<Figure> figure;

std::vector<ljus::Photon> photons_of(int pass) {
    return trace_photons(
               figure->shown.world, ljus::MapType::caustics,
               {.photons = photons, .iteration = std::uint64_t(pass), .threads = 1}, 0,
               photons)
        .photons;
}

ljus::Image line_by(const ljus::PhotonMap& map, double radius) {
    ljus::Image image = ljus::make_image(places, 1);
    for (int i = 0; i < places; ++i) {
        const float x = live::half_width * (2 * (float(i) + 0.5f) / places - 1);
        pixel(image, i, 0) = ljus::Rgb{float(examples::irradiance_read(
            map, {x, 0, 0}, {0, 1, 0}, {.radius = float(radius)}))};
    }
    return image;
}

} // namespace

live::Floor& live::floor_shown() {
    return figure->shown;
}

extern "C" {

[[gnu::used]] void setup() {
    figure = std::make_unique<Figure>();
}

/// One pass more: its photons make a map, and the map light, which is added.
/// \return The number of passes so far.
[[gnu::used]] int pass() {
    const ljus::PhotonMap map =
        ljus::make_photon_map(photons_of(int(figure->floor.passes) + 1), 1);
    const double radius = first_radius * std::sqrt(figure->floor.shrink);
    figure->radii.push_back(radius);
    ljus::Image image = ljus::make_image(live::cells, live::cells);
    const std::vector<float> cells = live::picture_by(map, float(radius));
    for (std::size_t i = 0; i < cells.size(); ++i)
        image.pixels[i] = ljus::Rgb{cells[i]};
    add_pass(figure->floor, image);
    add_pass(figure->line, line_by(map, radius));
    add_pass(figure->same, line_by(map, first_radius));
    return int(figure->floor.passes);
}
/// The radius of a pass that has been, 1, 2, ...
[[gnu::used]] double radius(int pass) {
    return figure->radii[std::size_t(pass - 1)];
}

/// Where the photons of a pass land: x and z of each.
/// \return How many there are.
[[gnu::used]] int land(int pass) {
    figure->shown.dots.clear();
    figure->shown.show(photons_of(pass));
    return int(figure->shown.dots.size() / 2);
}

/// The mean of the passes, W/m^2, in the cells of the floor.
[[gnu::used]] const float* picture() {
    figure->picture.clear();
    for (const ljus::Rgb& color : mean_image(figure->floor).pixels)
        figure->picture.push_back(color.x);
    return figure->picture.data();
}
/// The same along its middle line, by discs that shrink or do not.
[[gnu::used]] const float* line(int shrinking) {
    figure->values.clear();
    for (const ljus::Rgb& color :
         mean_image(shrinking ? figure->line : figure->same).pixels)
        figure->values.push_back(color.x);
    return figure->values.data();
}

[[gnu::used]] int checks() {
    return 4;
}
[[gnu::used]] double check(int i) {
    auto kept = std::move(figure); // the page goes on with its own
    setup();
    pass();
    pass();
    const double found = i == 0   ? double(picture()[live::cells * 20 + 30])
                         : i == 1 ? double(line(1)[places / 3])
                         : i == 2 ? double(line(0)[places / 3])
                                  : radius(2);
    figure = std::move(kept);
    return found;
}

} // extern "C"
