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
                light_at(view.mapper, *vertex, material, true, {}, context, add);
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

/// The estimates on the floor, as a mean over several maps.
struct FloorEstimates {
    std::array<double, leak_steps + 1> along{}; ///< From the left wall to the right.
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
    leak_pictures(rooms, photons, options);
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
    });
}
