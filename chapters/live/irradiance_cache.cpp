// Live: points of a cache on a floor beside a bright wall, in Flatland.
#include <cmath>
#include <numbers>
#include <vector>

#include "live/gather_rays.hpp"
#include "ljus/math/random.hpp"
#include "ljus/render/irradiance_cache.hpp"

namespace {

namespace fl = flatland;
using Vec3 = ljus::Vec3T<double>;

constexpr double width = 2.4;
constexpr int points = 14, rays = 16, many = 2000, places = 241;

/// A floor, a wall of radiosity 1 at its left end, and a ceiling; open to the right.
const fl::Scene room{{
    {fl::Segment{.from{0, 0}, .to{3, 0}}, {}, 0},
    {fl::Segment{.from{0, 1}, .to{0, 0}}, {}, 0.5},
    {fl::Segment{.from{3, 1}, .to{0, 1}}, {}, 0},
}};

struct Figure {
    std::vector<Vec3> positions;
    std::vector<ljus::GatheredT<double>> records;
    ljus::IrradianceCacheT<double> cache;
};
Figure figure;

/// What n rays gather at a place of the floor: the light of the wall, and how far they
/// reach in the harmonic mean.
ljus::GatheredT<double> gather(double x, int n) {
    double light = 0, inverse = 0;
    for (int i = 0; i < n; ++i) {
        const auto hit = closest_hit(room, live::gather_ray(x, (i + 0.5) / n));
        if (!hit) continue; // it adds 0
        light += 2 * room.objects[hit->id].emission / n;
        inverse += 1 / hit->t / n;
    }
    return {.irradiance = ljus::RgbT<double>{light}, .distance = 1 / inverse};
}

double place(int i) {
    return width * (i + 0.5) / places;
}

} // namespace

extern "C" {

[[gnu::used]] double width_of_floor() {
    return width;
}

/// Chooses the points, one in each part of the floor, and makes the cache.
/// \return How many they are.
[[gnu::used]] int setup() {
    figure = Figure{};
    auto stream = ljus::random_stream(3, ljus::Pass::gathering, 0, 0);
    for (int i = 0; i < points; ++i) {
        const double x = width * (i + ljus::next_1d<double>(stream)) / points;
        figure.positions.push_back({x, 0, 0});
        figure.records.push_back(gather(x, many));
    }
    figure.cache = make_irradiance_cache(figure.positions, figure.records,
                                         ljus::GatherSettings{}, 1);
    return points;
}
/// A point: its place, its irradiance, the harmonic mean of its rays.
[[gnu::used]] double point(int i, int what) {
    const auto& record = figure.records[std::size_t(i)];
    return what == 0   ? figure.positions[std::size_t(i)].x
           : what == 1 ? record.irradiance.x
                       : record.distance;
}
/// The ends of some gather rays of a point: x, y of each.
[[gnu::used]] const double* ends(int i) {
    std::vector<double> all;
    for (int k = 0; k < rays; ++k) {
        const fl::Ray ray =
            live::gather_ray(figure.positions[std::size_t(i)].x, (k + 0.5) / rays);
        const auto hit = closest_hit(room, ray);
        const fl::Vec2 end = ray.origin + (hit ? hit->t : 4.0) * ray.direction;
        all.insert(all.end(), {end.x, end.y});
    }
    return live::for_page(all);
}
[[gnu::used]] int ends_size() {
    return rays;
}

[[gnu::used]] int curve_size() {
    return places;
}
[[gnu::used]] double curve_place(int i) {
    return place(i);
}
/// The irradiance along the floor, gathered everywhere.
[[gnu::used]] const double* exact() {
    return live::for_page(places,
                          [](int i) { return gather(place(i), many).irradiance.x; });
}
/// The same between the points; -1 where no point counts.
[[gnu::used]] const double* interpolated(double reach) {
    return live::for_page(places, [reach](int i) {
        const auto found =
            interpolate(figure.cache, Vec3{place(i), 0, 0}, Vec3{0, 0, 1}, reach);
        return found ? found->x : -1;
    });
}

[[gnu::used]] int checks() {
    return 4;
}
[[gnu::used]] double check(int i) {
    const Figure shown = figure; // it goes on as it was
    setup();
    const double number = i == 0   ? point(3, 2)
                          : i == 1 ? interpolated(0.5)[100]
                          : i == 2 ? interpolated(1.5)[2]
                                   : exact()[20];
    figure = shown;
    return number;
}

[[gnu::used]] double tolerance() {
    return 1e-9;
}

} // extern "C"
