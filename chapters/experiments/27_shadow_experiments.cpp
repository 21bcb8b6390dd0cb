// smoke: --quality draft --photons 1000 --width 24 --height 24 --cuts 1
/// \file chapters/experiments/27_shadow_experiments.cpp
/// \brief Chapter 27: what is saved where photons replace rays, and the wire that is lost.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "experiments/show_table.hpp"
#include "ljus/accel/mesh.hpp"
#include "ljus/inspect/metrics.hpp"
#include "ljus/io/png.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/render/skipping.hpp"
#include "ljus/scenes/mesh_formulas.hpp"
#include "ljus/scenes/report_rooms.hpp"

using namespace ljus;

namespace {

using HallScene =
    Scene<Shapes<Mesh, Sphere, Quad>, Materials<Lambertian>, Lights<PointLight>>;
using Hall = World<HallScene>;

PhotonMappingSettings settings_of(const examples::Options& options, SkipRule rule,
                                  long long photons) {
    PhotonMappingSettings settings;
    settings.general = {
        .photons = photons, .seed = options.seed, .threads = options.threads};
    settings.caustics = {.photons = options.pick(1000LL, 20000LL, 100000LL),
                         .seed = options.seed,
                         .threads = options.threads};
    settings.skip.rule = rule;
    return settings;
}

/// The verdicts on the one lamp of a hall, by the photons of a seed.
VerdictGrid verdicts_of(const Hall& hall, const SkipSettings& skip, long long photons,
                        const examples::Options& options, int seed) {
    const auto traced =
        trace_photons(hall, MapType::general,
                      {.photons = photons,
                       .seed = options.seed + static_cast<std::uint64_t>(seed),
                       .max_bounces = 1,
                       .threads = options.threads});
    return make_verdict_grid(traced.photons, 1, skip, options.threads);
}

// --- The wire that defeats it --------------------------------------------------------

constexpr float lamp_height = 4, wire_height = 0.5f, lamp_away = 2;

/// A floor under a point light, and a flat wire of a width along x.
Hall wire_hall(float width) {
    HallScene hall;
    const auto grey = hall.add(Lambertian{.albedo = Rgb{0.6f}});
    hall.add(Quad{.corner{-3, 0, -3}, .edge_u{0, 0, 6}, .edge_v{6, 0, 0}}, grey);
    hall.add(Quad{.corner{-2.5f, wire_height, -width / 2},
                  .edge_u{5, 0, 0},
                  .edge_v{0, 0, width}},
             hall.add(Lambertian{.albedo{0.5f, 0.25f, 0.1f}}));
    // A ceiling above the lamp, so that its photons are not aimed at the scene.
    hall.add(Quad{.corner{-3, 4.5f, -3}, .edge_u{6, 0, 0}, .edge_v{0, 0, 6}}, grey);
    hall.add(PointLight{.position{0, lamp_height, lamp_away}, .intensity = Rgb{20}});
    return Hall(std::move(hall));
}

void wire(const examples::Options& options, long long photons) {
    // In the middle of the shadow the light is invisible, and the cells around a
    // point hold a strip of it 3 h long and as wide as the shadow. No shadow photon
    // falls into it with the probability exp(-density * 3 h * width).
    constexpr float radius = 0.2f;
    const double scale = lamp_height / (lamp_height - wire_height);
    const double z = lamp_away - scale * lamp_away;
    examples::Plot plot{.name = "shadow-wire",
                        .columns = {"width of the wire, in cells", "measured",
                                    "exp(-photons on the strip)"},
                        .y_label = "shadow lost, %",
                        .rows = {}};
    const int points = 400;
    for (int i = 1; i <= options.pick(6, 12, 16); ++i) {
        const double width = 0.02 * i * double(radius);
        const Hall hall = wire_hall(float(width));
        double lost = 0, expected = 0;
        const int seeds = options.pick(4, 40, 160);
        for (int seed = 0; seed < seeds; ++seed) {
            const VerdictGrid grid =
                verdicts_of(hall, {.rule = SkipRule::enough, .radius = radius}, photons,
                            options, seed);
            for (int k = 0; k < points; ++k) {
                const double x = -2 + 4 * (k + 0.5) / points;
                const SurfacePoint at{.position{float(x), 0, float(z)},
                                      .normal{0, 1, 0}};
                const bool lit = grid.verdict(grid.cell_of(at, 1), 0) == Verdict::lit;
                const double d = std::hypot(x, double(lamp_height), z - lamp_away);
                const double density =
                    double(photons) * lamp_height / (4 * std::numbers::pi * d * d * d);
                lost += (lit ? 100.0 : 0.0) / points / seeds;
                expected += 100 * std::exp(-density * 3 * radius * width * scale) /
                            points / seeds;
            }
        }
        plot.rows.push_back({width / radius, lost, expected});
    }
    examples::save_plot(options.out, plot);

    const Hall hall = wire_hall(0.03f * radius);
    const Camera camera =
        look_at({.position{0, 3.4f, -2.2f}, .target{0, 0, -0.1f}, .vfov_degrees = 50});
    for (const SkipRule rule : {SkipRule::none, SkipRule::enough}) {
        PhotonMappingSettings settings = settings_of(options, rule, photons);
        settings.skip.radius = radius;
        settings.indirect = IndirectLight::none;
        const PhotonMapper mapper(hall, settings, abilities<Skipping>);
        save_png(render(mapper, camera,
                        {.width = options.width,
                         .height = options.height,
                         .samples = options.pick(4, 16, 64),
                         .threads = options.threads})
                     .image,
                 options.path(rule == SkipRule::none ? "shadow-wire-all.png"
                                                     : "shadow-wire.png"));
    }
}

// --- What it saves -------------------------------------------------------------------

/// A hall with walls, lamps, and nine balls: meshes of 20 * 4^cuts triangles each, or
/// spheres if cuts is 0.
Hall hall_of_meshes(int cuts, int lamps) {
    HallScene hall;
    const auto grey = hall.add(Lambertian{.albedo = Rgb{0.6f}});
    const auto red = hall.add(Lambertian{.albedo{0.6f, 0.3f, 0.2f}});
    const auto black = hall.add(Lambertian{.albedo = Rgb{0}});
    const Vec3 x{10, 0, 0}, y{0, 5, 0}, z{0, 0, 10};
    hall.add(Quad{.corner{-5, 0, -5}, .edge_u = z, .edge_v = x}, grey);
    hall.add(Quad{.corner{-5, 5, -5}, .edge_u = x, .edge_v = z}, grey);
    hall.add(Quad{.corner{-5, 0, -5}, .edge_u = x, .edge_v = y}, grey);
    hall.add(Quad{.corner{-5, 0, -5}, .edge_u = y, .edge_v = z}, grey);
    hall.add(Quad{.corner{5, 0, -5}, .edge_u = z, .edge_v = y}, grey);
    for (int lamp = 0; lamp < lamps; ++lamp) {
        const float at = lamps == 1 ? 0 : -3 + 6 * float(lamp) / float(lamps - 1);
        hall.add(
            Quad{.corner{at - 0.5f, 4.99f, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}},
            black, Rgb{30 / float(lamps)});
    }
    for (int i = 0; i < 9; ++i) {
        const Sphere ball{
            .center{-2.5f + 2.5f * float(i % 3), 0.6f, -2.5f + 2.5f * float(i / 3)},
            .radius = 0.5f};
        if (cuts > 0)
            hall.add(Mesh(icosphere(ball, cuts)), red);
        else
            hall.add(ball, red);
    }
    return Hall(std::move(hall));
}

/// Where indirect rays have ended: points of a room as a picture asks about them.
template <AnyWorld W>
std::vector<Vertex> places_of(const W& world, const Camera& camera, std::size_t count,
                              std::uint64_t seed) {
    std::vector<Vertex> places;
    for (std::size_t tries = 0; tries < 5 * count && places.size() < count; ++tries) {
        auto stream = random_stream(seed, Pass::camera, 1, tries); // a path of its own
        PathStateT<float> path{
            .ray = primary_ray(camera, 100.0f * next_2d<float>(stream), 100, 100)};
        auto vertex = next_vertex(world, path, stream);
        if (!vertex) continue;
        const Vec3 out = sample_cosine_hemisphere(next_2d<float>(stream));
        const Vec3 up = vertex->wo.z < 0 ? -out : out;
        path.ray = spawn_ray(vertex->point, to_world(vertex->frame, up));
        vertex = next_vertex(world, path, stream);
        if (vertex && visit_material_at(world, *vertex, [](const auto& m) {
                return has(lobes(m), Lobes::non_specular);
            }))
            places.push_back(*vertex);
    }
    return places;
}

/// Nanoseconds of a shadow ray, of a verdict from the grid, and of a verdict by the
/// plain twin, which searches the map, all at the same points and for the first lamp;
/// and of a photon, from the lamp into the grid.
template <AnyWorld W>
std::array<double, 4> cost_of(const W& world, const Camera& camera, long long photons,
                              const examples::Options& options) {
    const SkipSettings skip{.rule = SkipRule::enough};
    const auto traced = trace_photons(world, MapType::general,
                                      {.photons = photons,
                                       .seed = options.seed,
                                       .max_bounces = 1,
                                       .threads = options.threads});
    VerdictGrid grid;
    const double photon = examples::nanoseconds_a_call(
        double(photons),
        [&] {
            const auto again = trace_photons(world, MapType::general,
                                             {.photons = photons,
                                              .seed = options.seed,
                                              .max_bounces = 1,
                                              .equal_lights = true,
                                              .threads = 1});
            grid = make_verdict_grid(again.photons, world.light_count(), skip, 1);
            return grid.known.table.size();
        },
        options.pick(1, 5, 9));
    const PhotonMap map = make_photon_map(traced.photons, options.threads);
    struct Question {
        SurfacePoint point{};
        SurfacePoint lamp{};
        int side = 1;
    };
    std::vector<Question> questions;
    auto stream = random_stream(options.seed, Pass::camera, 2, 0);
    for (const Vertex& place : places_of(world, camera, 4000, options.seed))
        if (const auto sampled =
                sample_light(world, 0, place.point.position, next_2d<float>(stream)))
            questions.push_back({place.point, sampled->point, place.wo.z < 0 ? -1 : 1});
    const double calls = double(std::max<std::size_t>(questions.size(), 1));
    const int runs = options.pick(3, 21, 51);
    const auto time = [&](auto ask) {
        return examples::nanoseconds_a_call(
            calls,
            [&] {
                int sum = 0;
                for (const Question& q : questions) sum += ask(q);
                return sum;
            },
            runs);
    };
    return {time([&](const Question& q) {
                return occluded(world, spawn_ray_to(q.point, q.lamp)) ? 1 : 0;
            }),
            time([&](const Question& q) {
                return int(grid.verdict(grid.cell_of(q.point, q.side), 0));
            }),
            time([&](const Question& q) {
                return int(verdict_at(map, q.point, q.side, 0, grid.radius(), skip));
            }),
            photon};
}

/// Both passes with and without skipping, in turn, one thread: processor seconds, the
/// median of the runs.
struct Seconds {
    double with = 0, without = 0, skipped = 0, error = 0;
};
template <AnyWorld W>
Seconds seconds_of(const W& world, const Camera& camera, int shadow_rays,
                   long long photons, int samples, int runs,
                   const examples::Options& options) {
    std::array<std::vector<double>, 2> seconds;
    std::array<Image, 2> images;
    std::array<double, 2> rays{};
    for (int run = 0; run < runs; ++run)
        for (const std::size_t i : {0u, 1u}) {
            PhotonMappingSettings settings = settings_of(
                options, i == 0 ? SkipRule::none : SkipRule::enough, photons);
            settings.shadow_rays = shadow_rays;
            settings.general.threads = settings.caustics.threads = 1;
            const double start = examples::processor_seconds();
            const PhotonMapper mapper(world, settings, abilities<Skipping>);
            auto picture = render(mapper, camera,
                                  {.width = options.pick(16, 120, 400),
                                   .height = options.pick(16, 120, 400),
                                   .samples = samples,
                                   .seed = options.seed,
                                   .threads = 1});
            seconds[i].push_back(examples::processor_seconds() - start);
            rays[i] = double(picture.counts.shadow_rays);
            images[i] = std::move(picture.image);
        }
    for (auto& times : seconds) std::sort(times.begin(), times.end());
    const std::size_t middle = std::size_t(runs) / 2;
    return {seconds[1][middle], seconds[0][middle], 1 - rays[1] / rays[0],
            rel_mse(images[1], images[0])};
}

void savings(const examples::Options& options, long long photons, int cuts) {
    const Camera camera =
        look_at({.position{0, 3.2f, 9}, .target{0, 1, 0}, .vfov_degrees = 45});
    examples::Table costs{.name = "shadow-costs",
                          .columns = {"room", "ns per shadow ray", "ns per grid lookup",
                                      "ns per map query", "ns per photon",
                                      "rays a photon must save"},
                          .rows = {}};
    examples::Table table{.name = "shadow-seconds",
                          .columns = {"room", "shadow rays per lamp", "skipped",
                                      "seconds without", "seconds with", "ratio",
                                      "relMSE of skipping"},
                          .rows = {}};
    const auto measure = [&](const std::string& name, const auto& world,
                             const Camera& from) {
        const auto cost = cost_of(world, from, photons, options);
        costs.rows.push_back(
            {name, examples::text(cost[0], "%.0f"), examples::text(cost[1], "%.1f"),
             examples::text(cost[2], "%.0f"), examples::text(cost[3], "%.0f"),
             examples::text(cost[3] / (cost[0] - cost[1]), "%.0f")});
        for (const int rays : {1, 4, 9}) {
            const Seconds found = seconds_of(world, from, rays, photons, 16,
                                             options.pick(1, 3, 9), options);
            const double ratio = found.with / found.without;
            table.rows.push_back({name, std::to_string(rays),
                                  examples::text(100 * found.skipped, "%.1f %%"),
                                  examples::text(found.without, "%.2f"),
                                  examples::text(found.with, "%.2f"),
                                  examples::text(ratio, "%.2f"),
                                  examples::text(found.error, "%.1g")});
        }
    };
    const auto glass = four_glass_room<float>();
    measure("figure 11: 11 objects", glass.world, glass.camera);
    const auto final = final_room<float>();
    measure("figure 1: 2 lamps", final.world, final.camera);
    measure("9 spheres", hall_of_meshes(0, 1), camera);
    for (int cut = cuts % 2 == 0 ? 2 : 1; cut <= cuts; cut += 2)
        measure("9 meshes, " + std::to_string(9 * 20 * (1 << (2 * cut))) + " triangles",
                hall_of_meshes(cut, 1), camera);
    measure("the same, 4 lamps", hall_of_meshes(cuts, 4), camera);
    examples::show_table(options, costs);
    examples::show_table(options, table);
}

} // namespace

/// Makes the pictures, the plot and the tables behind chapter 27.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 100000;
        int cuts = 0;
        line.about("Chapter 27, shadow photons: rays that need not be cast.");
        line.add("--photons", photons, "Photons emitted for pictures and times", 1,
                 100000000);
        line.add("--cuts", cuts,
                 "Cuts of the finest meshes, which have 180 * 4^cuts triangles", 1, 7);
        const examples::Options options =
            line.parse({.draft{.width = 200, .height = 200, .samples = 1},
                        .report{.width = 400, .height = 400, .samples = 16},
                        .reference{.width = 400, .height = 400, .samples = 256}});
        if (!line.given("--cuts")) cuts = options.pick(2, 6, 6);
        wire(options, photons);
        // In a draft the first pass must not outweigh a second one of few pixels.
        savings(options, options.pick(photons / 10, photons, photons), cuts);
    });
}
