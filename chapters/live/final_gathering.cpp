// Live: gather rays in Flatland, and what each of them reads where it ends.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "flatland/density_estimate.hpp"
#include "flatland/path_tracing.hpp"
#include "flatland/room.hpp"
#include "live/gather_rays.hpp"

namespace {

namespace fl = flatland;

constexpr int places = 101; // of the floor that the curves have
constexpr double albedo = 0.7;
constexpr fl::Circle lamp{.center{-0.5, 0.85}, .radius = 0.05};
constexpr int photons = 500;

/// Where the irradiance is known before rays are sent.
struct IrradiancePoint {
    fl::SurfacePoint point{};
    double irradiance = 0; ///< W/m, of all photons.
};

struct Figure {
    fl::Scene scene;
    fl::PhotonMap map, indirect;
    std::vector<IrradiancePoint> points;
    std::vector<double> reference = std::vector<double>(places, 0.0); // sums
    int counted = 0;                                                  // rays in them
};
Figure figure;

fl::Scene room() {
    const fl::Lambertian wall{albedo};
    const fl::Vec2 left = fl::room_floor.from, right = fl::room_floor.to;
    const fl::Vec2 up{0, fl::room_height};
    return {{{fl::room_floor, wall},
             {fl::Segment{right, right + up}, wall},
             {fl::Segment{right + up, left + up}, wall},
             {fl::Segment{left + up, left}, wall},
             {lamp, fl::Lambertian{0}, fl::radiance_of(lamp, 1)}}};
}

double floor_place(int i) {
    return 0.98 * (2.0 * i / (places - 1) - 1);
}

/// The nearest point of a wall that is turned like it.
const IrradiancePoint& nearest_point(const fl::SurfacePoint& end) {
    const IrradiancePoint* nearest = &figure.points.front();
    double least = std::numeric_limits<double>::infinity();
    for (const IrradiancePoint& one : figure.points) {
        const double far = glm::distance(one.point.position, end.position);
        if (far < least && glm::dot(one.point.normal, end.normal) > 0.5) {
            least = far;
            nearest = &one;
        }
    }
    return *nearest;
}

/// What a gather ray meets, and the point that it reads; none for the lamp.
struct Read {
    fl::Vec2 end{0};
    const IrradiancePoint* from = nullptr;
};
Read read(const fl::Ray& ray) {
    const auto hit = closest_hit(figure.scene, ray);
    const fl::Object& met = figure.scene.objects[hit->id];
    const fl::Vec2 end = ray.origin + hit->t * ray.direction;
    if (met.emission > 0) return {end, nullptr}; // its light is counted elsewhere
    const fl::Vec2 up = normal(std::get<fl::Segment>(met.shape), end);
    return {end, &nearest_point({end, up})};
}

/// The number that sends ray i of n into its part of all directions.
double stratum(int i, int n, ljus::RandomStream& stream) {
    return (i + next_1d<double>(stream)) / n;
}

ljus::RandomStream stream_of(int pass, int place) {
    return ljus::random_stream(std::uint64_t(pass), ljus::Pass::gathering, 0,
                               std::uint64_t(place));
}

} // namespace

extern "C" {

/// Traces the photons, and makes every 12th an irradiance point.
/// \return How many photons there are.
[[gnu::used]] int setup() {
    figure = Figure{};
    figure.scene = room();
    figure.map = trace_photons(figure.scene, {.photons = photons});
    std::erase_if(figure.map, [](const fl::Photon& photon) { // the lamp is black
        return glm::distance(photon.position, lamp.center) < 2 * lamp.radius;
    });
    for (std::size_t i = 0; i < figure.map.size(); ++i) {
        const fl::Photon& photon = figure.map[i];
        if (photon.kind == ljus::PhotonKind::indirect)
            figure.indirect.push_back(photon);
        if (i % 12 > 0) continue;
        const fl::SurfacePoint at{photon.position, photon.normal};
        const double found =
            estimate_irradiance(figure.map, at, {.radius = 0.2, .nearest = 40})
                .irradiance;
        figure.points.push_back({at, found});
    }
    return int(figure.map.size());
}
[[gnu::used]] double lamp_place(int i) {
    return i == 0 ? lamp.center.x : i == 1 ? lamp.center.y : lamp.radius;
}
[[gnu::used]] double height() {
    return fl::room_height;
}

/// All photons: x, y of each.
[[gnu::used]] const double* dots() {
    std::vector<double> all;
    for (const fl::Photon& photon : figure.map)
        all.insert(all.end(), {photon.position.x, photon.position.y});
    return live::for_page(all);
}
[[gnu::used]] int points_size() {
    return int(figure.points.size());
}
/// The irradiance points: place, normal, W/m.
[[gnu::used]] const double* points() {
    std::vector<double> all;
    for (const auto& [at, irradiance] : figure.points)
        all.insert(all.end(), {at.position.x, at.position.y, at.normal.x, at.normal.y,
                               irradiance});
    return live::for_page(all);
}

/// Ray i of n from a place of the floor: its end, the place of the point that it reads,
/// and the radiosity there; 0 at the lamp.
[[gnu::used]] const double* ray(double x, int i, int n) {
    auto stream = stream_of(2 + i, 0);
    const Read found = read(live::gather_ray(x, stratum(i, n, stream)));
    const fl::Vec2 from = found.from ? found.from->point.position : found.end;
    return live::for_page({found.end.x, found.end.y, from.x, from.y,
                           found.from ? albedo * found.from->irradiance : 0});
}

[[gnu::used]] int curve_size() {
    return places;
}
[[gnu::used]] double curve_place(int i) {
    return floor_place(i);
}
/// The indirect irradiance along the floor by n gather rays at each place, W/m.
[[gnu::used]] const double* gathered(int n) {
    return live::for_page(places, [n](int place) {
        auto stream = stream_of(1, place);
        double sum = 0;
        for (int i = 0; i < n; ++i) {
            const Read found =
                read(live::gather_ray(floor_place(place), stratum(i, n, stream)));
            // The radiance is half the radiosity, and the integral of the cosine is 2.
            if (found.from) sum += albedo * found.from->irradiance / n;
        }
        return sum;
    });
}
/// The same by the indirect photons on the floor itself.
[[gnu::used]] const double* seen() {
    return live::for_page(places, [](int place) {
        const fl::SurfacePoint at{.position{floor_place(place), 0}};
        return estimate_irradiance(figure.indirect, at, {.radius = 0.1}).irradiance;
    });
}

/// The same by paths: adds rays at each place.
/// \return How many rays a place has.
[[gnu::used]] int add_reference(int rays) {
    for (int i = 0; i < rays; ++i, ++figure.counted)
        for (int place = 0; place < places; ++place) {
            auto stream = stream_of(1000 + figure.counted, place);
            const fl::Ray ray =
                live::gather_ray(floor_place(place), next_1d<double>(stream));
            const auto hit = closest_hit(figure.scene, ray);
            if (figure.scene.objects[hit->id].emission > 0) continue;
            figure.reference[std::size_t(place)] +=
                2 * fl::radiance(figure.scene, ray, stream);
        }
    return figure.counted;
}
[[gnu::used]] const double* reference() {
    return live::for_page(places, [](int place) {
        return figure.reference[std::size_t(place)] / std::max(figure.counted, 1);
    });
}

[[gnu::used]] int checks() {
    return 4;
}
[[gnu::used]] double check(int i) {
    const Figure shown = figure; // it goes on as it was
    setup();
    const double number = i == 0   ? double(figure.map.size())
                          : i == 1 ? gathered(16)[30]
                          : i == 2 ? seen()[50]
                                   : (add_reference(20), reference()[70]);
    figure = shown;
    return number;
}

/// Sines and cosines of two C libraries differ in their last digit.
[[gnu::used]] double tolerance() {
    return 1e-6;
}

} // extern "C"
