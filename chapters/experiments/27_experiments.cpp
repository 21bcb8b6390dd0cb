// smoke: --quality draft --photons 500 --width 40 --height 40
/// \file chapters/experiments/27_experiments.cpp
/// \brief Chapter 27: how many photons there are of each kind, the map as a picture,
/// where it fails, and its error by number and radius.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/convergence.hpp"
#include "common/plot.hpp"
#include "experiments/show_table.hpp"
#include "experiments/two_rooms.hpp"
#include "experiments/white_floor.hpp"
#include "ljus/inspect/census.hpp"
#include "ljus/inspect/photon_dots.hpp"
#include "ljus/io/png.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scenes/report_rooms.hpp"

using namespace ljus;

namespace {

using Point = glm::dvec3;

// --- The photons of figures 5, 6 and 7 ------------------------------------------------

/// Counts the photons of each kind, and draws the shadow photons lamp by lamp.
void census_of_figures(const examples::Options& options, long long count) {
    const auto room = final_room<float>();
    const Image drawing =
        scene_drawing(room.world, room.camera, options.width, options.height);
    const auto traced = trace_photons(
        room.world, MapType::general,
        {.photons = count, .seed = options.seed, .threads = options.threads});
    const PhotonCensus found = census(traced.photons);
    const double emitted = traced.audit.emitted.y;
    const auto dots = [&](Image& image, auto color) {
        return add_photon_dots(image, room.world, room.camera, traced.photons,
                               {.radius = 1.2f, .brightness = 0.9f}, color);
    };

    examples::Table table{.name = "general-census",
                          .columns = {"photons", "stored", "in the picture", "power, W",
                                      "of the emitted", "large + small lamp, W",
                                      "inside of objects"},
                          .rows = {}};
    for (const PhotonKind kind :
         {PhotonKind::indirect, PhotonKind::shadow, PhotonKind::direct}) {
        Image image = drawing;
        const long long seen = dots(image, [kind](const Photon& photon) {
            return photon.kind == kind ? Rgb{1} : Rgb{0};
        });
        std::array<double, 2> lamp{};
        long long behind = 0; // on the inner side of a matt ball, never visible
        for (const Photon& photon : traced.photons) {
            if (photon.kind != kind) continue;
            lamp[photon.light] += double(photon.flux.y);
            behind += photon_side(photon.direction, Vec3(photon.normal)) < 0 ? 1 : 0;
        }
        const PhotonCount& of_kind = found[kind];
        table.rows.push_back(
            {name_of(kind), std::to_string(of_kind.photons), std::to_string(seen),
             examples::text(of_kind.flux.y, "%.1f"),
             examples::text(of_kind.flux.y / emitted, "%.3f"),
             examples::text(lamp[0], "%.1f + ") + examples::text(lamp[1], "%.1f"),
             std::to_string(behind)});
    }
    examples::show_table(options, table);

    // Each photon knows its lamp: the regions that either lamp does not reach.
    Image image = drawing;
    (void)dots(image, [](const Photon& photon) {
        if (photon.kind != PhotonKind::shadow) return Rgb{0};
        return photon.light == 0 ? Rgb{0.1f, 0.5f, 1} : Rgb{1, 0.4f, 0.05f};
    });
    save_png(image, options.path("general-shadow-lamps.png"));
}

// --- The map as a picture -------------------------------------------------------------

/// The general map seen directly: no shadow rays and no indirect rays, only the
/// estimate of the photons where a camera path first hits a matt surface.
template <AnyWorld W>
struct MapView {
    using Stream = RandomStream;
    const PhotonMapper<W>& mapper; ///< The world and its maps.
};
template <AnyWorld W>
Rgb radiance(const MapView<W>& view, const Ray& ray, auto& context) {
    const W& world = view.mapper.world();
    Rgb sum{0};
    PathState path{.ray = ray};
    const RadianceSum add{sum, path.throughput, context.log};
    while (path.depth < 20) {
        const auto vertex = next_vertex(world, path, context.stream);
        if (!vertex) break;
        if (vertex->emits()) sum += path.throughput * vertex->object.emission;
        const auto at_material = [&](const auto& material) {
            if (has(lobes(material), Lobes::non_specular))
                light_at(view.mapper, *vertex, material, true, context, add);
            return continue_path(path, *vertex, material, Transport::radiance,
                                 Lobes::specular, context.stream);
        };
        if (!visit_material_at(world, *vertex, at_material)) break;
    }
    return sum;
}
void map_as_picture(const examples::Options& options) {
    const auto room = final_room<float>();
    PhotonMappingSettings settings{.indirect = IndirectLight::map};
    settings.general = {.photons = options.pick(50'000LL, 500'000LL, 5'000'000LL),
                        .seed = options.seed,
                        .shadow_photons = false,
                        .threads = options.threads};
    settings.caustics = settings.general;
    settings.general_estimate.radius = 0.5f;
    settings.caustics_estimate.radius = 0.15f;
    const PhotonMapper mapper(room.world, settings);
    const RenderSettings picture{.width = options.width,
                                 .height = options.height,
                                 .samples = options.pick(4, 16, 64),
                                 .seed = options.seed,
                                 .threads = options.threads};
    const examples::StopWatch watch;
    save_png(render(MapView<decltype(room.world)>{mapper}, room.camera, picture).image,
             options.path("general-map.png"));
    const double map_seconds = watch.seconds();
    RenderSettings more = picture;
    more.samples = options.pick(8, 64, 1024);
    save_png(render(PathTracer(room.world), room.camera, more).image,
             options.path("general-path.png"));
    if (!options.quiet)
        std::printf("the map as a picture: %.1f s; path tracing: %.1f s\n", map_seconds,
                    watch.seconds() - map_seconds);
}

// --- Irradiance -----------------------------------------------------------------------

/// The estimate by direct photons of the irradiance at a point of the floor y = 0.
double irradiance(const PhotonMap& map, const Point& at, double radius) {
    return examples::irradiance_read(map, Vec3(at), Vec3{0, 1, 0},
                                     {.radius = float(radius)},
                                     one_kind(PhotonKind::direct));
}

/// The exact irradiance there of a rectangular lamp above.
double irradiance_from(const Quad& lamp, const Point& at) {
    return examples::irradiance_from(lamp, at, {0, 1, 0});
}

using examples::Boxes;

// --- Edges, corners, thin walls -------------------------------------------------------

constexpr double leak_radius = 0.15; ///< Of the estimates.
constexpr int leak_steps = 120;      ///< Along the floor, from wall to wall.

/// A point on the floor of the two rooms.
struct FloorPlace {
    const char* name;
    Point at;
};
constexpr std::array<FloorPlace, 6> floor_places{
    {{"in the middle of the left room", {-0.5, 0, 0.5}},
     {"at the foot of the left wall", {-1, 0, 0.5}},
     {"in its corner with the back wall", {-1, 0, 0}},
     {"at the wall between, lit side", {-1e-6, 0, 0.5}},
     {"at the wall between, dark side", {1e-6, 0, 0.5}},
     {"half a radius into the dark", {0.075, 0, 0.5}}}};

/// The estimates on the floor, as a mean over several maps.
struct FloorEstimates {
    std::array<double, leak_steps + 1> along{}; ///< From the left wall to the right.
    std::array<double, floor_places.size()> at_places{};
};

FloorEstimates estimate_floor(const examples::TwoRooms& rooms, long long photons,
                              const examples::Options& options) {
    FloorEstimates found;
    const int seeds = options.pick(4, 16, 16);
    for (int seed = 0; seed < seeds; ++seed) {
        const auto map = make_photon_map(
            trace_photons(rooms.world, MapType::general,
                          {.photons = photons,
                           .seed = options.seed + static_cast<std::uint64_t>(seed),
                           .max_bounces = 1,
                           .shadow_photons = false,
                           .threads = options.threads})
                .photons);
        for (int i = 0; i <= leak_steps; ++i)
            found.along[std::size_t(i)] +=
                irradiance(map, {2.0 * i / leak_steps - 1, 0, 0.5}, leak_radius) /
                seeds / 8;
        for (std::size_t i = 0; i < floor_places.size(); ++i)
            found.at_places[i] +=
                irradiance(map, floor_places[i].at, leak_radius) / seeds / 8;
    }
    return found;
}

/// The direct light on the floor: the lamp is in the left room.
double exact_on_floor(const examples::TwoRooms& rooms, const Point& at) {
    return at.x < 0 ? irradiance_from(rooms.lamp, at) : 0.0;
}

void plot_floor(const examples::TwoRooms& rooms, const FloorEstimates& found,
                const examples::Options& options) {
    examples::Plot plot{.name = "general-edges",
                        .columns = {"along the floor from the left wall to the right",
                                    "exact", "estimate with r = 0.15"},
                        .y_label = "irradiance from a lamp of radiance 1",
                        .rows = {}};
    for (int i = 0; i <= leak_steps; ++i) {
        const double x = 2.0 * i / leak_steps - 1;
        plot.rows.push_back(
            {x, exact_on_floor(rooms, {x, 0, 0.5}), found.along[std::size_t(i)]});
    }
    examples::save_plot(options.out, plot);
}

void table_of_floor(const examples::TwoRooms& rooms, const FloorEstimates& found,
                    const examples::Options& options) {
    examples::Table table{.name = "general-edges-table",
                          .columns = {"on the floor", "exact", "estimate", "ratio"},
                          .rows = {}};
    for (std::size_t i = 0; i < floor_places.size(); ++i) {
        const double right = exact_on_floor(rooms, floor_places[i].at);
        const double estimate = found.at_places[i];
        table.rows.push_back(
            {floor_places[i].name, examples::text(right, "%.4f"),
             examples::text(estimate, "%.4f"),
             right > 0 ? examples::text(estimate / right, "%.3f") : std::string("-")});
    }
    examples::show_table(options, table);
}

/// The two rooms as pictures, with indirect light: by the map, and by path
/// tracing.
void leak_pictures(const examples::TwoRooms& rooms, long long photons,
                   const examples::Options& options) {
    PhotonMappingSettings settings{.indirect = IndirectLight::map};
    settings.general = {.photons = photons,
                        .seed = options.seed,
                        .shadow_photons = false,
                        .threads = options.threads};
    settings.general_estimate.radius = float(leak_radius);
    const PhotonMapper mapper(rooms.world, settings);
    const Camera camera =
        look_at({.position{0, 0.5f, 3}, .target{0, 0.5f, 0}, .vfov_degrees = 54});
    const RenderSettings picture{.width = options.width,
                                 .height = options.height,
                                 .samples = options.pick(4, 16, 64),
                                 .seed = options.seed,
                                 .threads = options.threads};
    save_png(render(MapView<World<Boxes>>{mapper}, camera, picture).image,
             options.path("general-leak.png"), {.exposure = 0.5});
    RenderSettings more = picture;
    more.samples = options.pick(8, 64, 1024);
    save_png(render(PathTracer(rooms.world), camera, more).image,
             options.path("general-leak-path.png"), {.exposure = 0.5});
}

/// Where an estimate by a disc of photons fails: at edges, in corners, at thin walls.
void failures(const examples::Options& options) {
    const examples::TwoRooms rooms = examples::two_rooms();
    const long long photons = options.pick(50'000LL, 400'000LL, 4'000'000LL);
    const FloorEstimates found = estimate_floor(rooms, photons, options);
    plot_floor(rooms, found, options);
    table_of_floor(rooms, found, options);
    leak_pictures(rooms, photons, options);
}

// --- Error against number and radius --------------------------------------------------

/// Estimates of one number of photons: [radius][seed][place], relative to the
/// reference.
using Estimates = std::vector<std::vector<std::vector<double>>>;

/// Variance and squared bias of a radius, over all seeds but one (-1: over all).
struct Parts {
    double variance = 0, bias2 = 0;
};
Parts parts_of(const std::vector<std::vector<double>>& seeds, int left_out = -1) {
    Parts parts;
    const std::size_t places = seeds.front().size();
    for (std::size_t place = 0; place < places; ++place) {
        double count = 0, mean = 0, squares = 0;
        for (std::size_t seed = 0; seed < seeds.size(); ++seed) {
            if (int(seed) == left_out) continue;
            const double before = seeds[seed][place] - mean;
            mean += before / ++count;
            squares += before * (seeds[seed][place] - mean);
        }
        const double variance = squares / (count - 1);
        parts.variance += variance / double(places);
        parts.bias2 += ((mean - 1) * (mean - 1) - variance / count) / double(places);
    }
    return parts;
}

/// A slope of a logarithm over a logarithm, with its 95 % band from leaving out each
/// seed in turn (the jackknife).
struct Slope {
    double value = 0, band = 0;
};
template <typename Y>
Slope slope_of(const std::vector<double>& x, int seeds, Y y) {
    const auto fit = [&](int left_out) {
        std::vector<double> values;
        for (std::size_t i = 0; i < x.size(); ++i)
            values.push_back(std::max(y(i, left_out), 1e-30));
        return examples::fit_power(x, values).slope;
    };
    double mean = 0, squares = 0;
    std::vector<double> fits;
    for (int seed = 0; seed < seeds; ++seed) fits.push_back(fit(seed));
    for (const double f : fits) mean += f / seeds;
    for (const double f : fits) squares += (f - mean) * (f - mean);
    // Student's t, 15 degrees of freedom.
    return {fit(-1), 2.13 * std::sqrt(squares * (seeds - 1) / seeds)};
}

/// The cost of a map of one number of photons, the least of all seeds: the machine may
/// be busy.
struct Cost {
    double trace = 1e30, build = 1e30; ///< In seconds.
    double megabytes = 0, stored = 0;  ///< Of the map; its photons.
    std::vector<double> query;         ///< Nanoseconds, for each radius.
};

/// A lamp over a floor, its light estimated with many radii in maps of many sizes.
struct Experiment {
    std::vector<double> numbers;  ///< Photons emitted.
    std::vector<double> radii;    ///< Of the estimates.
    std::vector<Estimates> found; ///< [number][radius], over the true irradiance.
    std::vector<Cost> costs;      ///< [number].

    /// The mean square error, of all runs but one; -1: of all.
    double error2(std::size_t number, std::size_t radius, int left_out = -1) const {
        const Parts parts = parts_of(found[number][radius], left_out);
        return parts.variance + parts.bias2;
    }
    /// The radius with the least error.
    std::size_t best_radius(std::size_t number) const {
        std::size_t best = 0;
        for (std::size_t r = 1; r < radii.size(); ++r)
            if (error2(number, r) < error2(number, best)) best = r;
        return best;
    }
};
constexpr int seeds = 16;

/// Adds the estimates of one map at all points, and its cost.
void add_map(const PhotonMap& map, const Quad& lamp, const std::vector<double>& radii,
             Estimates& estimates, Cost& cost) {
    std::vector<Point> places;
    for (int i = 0; i < 49; ++i)
        places.push_back({0.2 * (i % 7) - 0.6, 0, 0.2 * (i / 7) - 0.6});
    cost.megabytes =
        1e-6 * double(map.tree.bytes() +
                      map.records.blocks().size() * sizeof(map.records.blocks()[0]));
    for (std::size_t r = 0; r < radii.size(); ++r) {
        const examples::StopWatch ask;
        std::vector<double> row;
        for (const Point& place : places)
            row.push_back(irradiance(map, place, radii[r]));
        cost.query[r] =
            std::min(cost.query[r], ask.seconds() * 1e9 / double(places.size()));
        for (std::size_t p = 0; p < places.size(); ++p)
            row[p] /= irradiance_from(lamp, places[p]);
        estimates[r].push_back(row);
    }
}

Experiment run_experiment(const examples::Options& options) {
    Boxes scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{1}});
    const Quad lamp{.corner{-0.5f, 1, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}};
    scene.add(Quad{.corner{-9, 0, -9}, .edge_u{0, 0, 18}, .edge_v{18, 0, 0}}, white);
    scene.add(lamp, scene.add(Lambertian{.albedo = Rgb{0}}), Rgb{1});
    const World world(std::move(scene));

    Experiment all;
    for (int i = 6; i <= options.pick(9, 11, 12); ++i)
        all.numbers.push_back(std::round(std::pow(10, i / 2.0)));
    for (int i = 0; i < 14; ++i) all.radii.push_back(0.05 * std::pow(2, i / 3.0));
    for (const double number : all.numbers) {
        Estimates estimates(all.radii.size());
        Cost cost{.query = std::vector<double>(all.radii.size(), 1e30)};
        for (int seed = 0; seed < seeds; ++seed) {
            const examples::StopWatch trace;
            const auto traced =
                trace_photons(world, MapType::general,
                              {.photons = static_cast<long long>(number),
                               .seed = options.seed + static_cast<std::uint64_t>(seed),
                               .shadow_photons = false,
                               .threads = options.threads});
            cost.trace = std::min(cost.trace, trace.seconds());
            cost.stored = double(traced.photons.size());
            const examples::StopWatch build;
            const PhotonMap map = make_photon_map(traced.photons, options.threads);
            cost.build = std::min(cost.build, build.seconds());
            add_map(map, lamp, all.radii, estimates, cost);
        }
        all.found.push_back(estimates);
        all.costs.push_back(cost);
    }
    return all;
}

/// The error against the radius, for every other number of photons.
void save_by_radius(const Experiment& all, const examples::Options& options) {
    examples::Plot plot{.name = "general-radius",
                        .columns = {"radius of the estimate"},
                        .y_label = "error of the irradiance, rms",
                        .rows = {},
                        .log_x = true,
                        .log_y = true};
    for (std::size_t n = 0; n < all.numbers.size(); n += 2)
        plot.columns.push_back(examples::text(all.numbers[n], "%.0f") + " photons");
    for (std::size_t r = 0; r < all.radii.size(); ++r) {
        examples::Row row{all.radii[r]};
        for (std::size_t n = 0; n < all.numbers.size(); n += 2) {
            const Parts parts = parts_of(all.found[n][r]);
            row.push_back(std::sqrt(parts.variance + std::max(0.0, parts.bias2)));
        }
        plot.rows.push_back(row);
    }
    examples::save_plot(options.out, plot);
}

/// The exponents of number and radius, beside those of the theory.
void save_slopes(const Experiment& all, const examples::Options& options) {
    const auto& numbers = all.numbers;
    const auto& radii = all.radii;
    const std::size_t middle = 6; // r = 0.2
    const Slope with_number =
        slope_of(numbers, seeds, [&](std::size_t n, int left_out) {
            return parts_of(all.found[n][middle], left_out).variance;
        });
    const std::vector<double> narrow(radii.begin(), radii.begin() + 8); // r <= 0.25
    const Slope with_radius = slope_of(narrow, seeds, [&](std::size_t r, int left_out) {
        return parts_of(all.found[numbers.size() / 2][r], left_out).variance;
    });
    const std::vector<double> wide(radii.begin() + 7, radii.begin() + 12); // to 0.63
    const Slope of_bias = slope_of(wide, seeds, [&](std::size_t r, int left_out) {
        return parts_of(all.found.back()[r + 7], left_out).bias2;
    });
    const Slope of_best = slope_of(numbers, seeds, [&](std::size_t n, int left_out) {
        double least = 1e30;
        for (std::size_t r = 0; r < radii.size(); ++r)
            least = std::min(least, all.error2(n, r, left_out));
        return least;
    });
    examples::Table table{
        .name = "general-slopes",
        .columns = {"what", "against", "theory", "measured", "95 % band"},
        .rows = {}};
    const auto add = [&](const char* what, const char* against, const char* theory,
                         const Slope& slope) {
        table.rows.push_back({what, against, theory,
                              examples::text(slope.value, "%.3f"),
                              examples::text(slope.band, "± %.3f")});
    };
    add("variance, r = 0.2", "N", "-1", with_number);
    add("variance, r to 0.25", "r", "-2", with_radius);
    add("bias squared, r from 0.25 to 0.63", "r", "4", of_bias);
    add("mean square error at the best r", "N", "-2/3", of_best);
    examples::show_table(options, table);
}

/// The cost of a smaller error.
void save_trade(const Experiment& all, const examples::Options& options) {
    examples::Plot plot{.name = "general-best",
                        .columns = {"photons emitted", "at the best radius", "N^(-2/3)",
                                    "r = 0.1", "r = 0.4"},
                        .y_label = "mean square error of the irradiance",
                        .rows = {},
                        .log_x = true,
                        .log_y = true};
    examples::Table table{.name = "general-trade",
                          .columns = {"photons", "best radius", "error, rms",
                                      "tracing, ms", "tree, ms", "query, µs", "MB",
                                      "bytes per photon"},
                          .rows = {}};
    const auto& numbers = all.numbers;
    const std::size_t half = numbers.size() / 2;
    const double anchor = all.error2(half, all.best_radius(half)) *
                          std::pow(numbers[half], 2.0 / 3); // where the law meets it
    for (std::size_t n = 0; n < numbers.size(); ++n) {
        const std::size_t best = all.best_radius(n);
        plot.rows.push_back({numbers[n], all.error2(n, best),
                             anchor / std::pow(numbers[n], 2.0 / 3), all.error2(n, 3),
                             all.error2(n, 9)});
        const Cost& cost = all.costs[n];
        table.rows.push_back(
            {examples::text(numbers[n], "%.0f"),
             examples::text(all.radii[best], "%.2f"),
             examples::text(100 * std::sqrt(all.error2(n, best)), "%.2f %%"),
             examples::text(1e3 * cost.trace, "%.1f"),
             examples::text(1e3 * cost.build, "%.1f"),
             examples::text(1e-3 * cost.query[best], "%.2f"),
             examples::text(cost.megabytes, "%.2f"),
             examples::text(1e6 * cost.megabytes / cost.stored, "%.1f")});
    }
    examples::save_plot(options.out, plot);
    examples::show_table(options, table);
}

/// How the error goes down with the number of photons, and with the radius.
void laws(const examples::Options& options) {
    const Experiment all = run_experiment(options);
    save_by_radius(all, options);
    save_slopes(all, options);
    save_trade(all, options);
}

} // namespace

/// Makes the pictures, plots and tables of chapter 27 that are not the report's.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 0;
        line.about("Chapter 27, the general map: the experiments behind its tables.");
        line.add("--photons", photons, "Photons emitted for the census", 1, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 300, .samples = 1}});
        if (!line.given("--photons")) photons = options.pick(15000LL, 30000LL, 60000LL);
        census_of_figures(options, photons);
        map_as_picture(options);
        failures(options);
        laws(options);
    });
}
