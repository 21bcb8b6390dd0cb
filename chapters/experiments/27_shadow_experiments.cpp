// smoke: --quality draft --photons 1000 --width 24 --height 24 --cuts 1
/// \file chapters/experiments/27_shadow_experiments.cpp
/// \brief Chapter 27: the savings where photons replace rays, and the errors.

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
#include "experiments/numbers.hpp"
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
constexpr std::array rules{SkipRule::report, SkipRule::any, SkipRule::enough};
constexpr std::array rule_names{"the report's", "that of 1995", "enough photons"};

// --- Pictures of the report's room ---------------------------------------------------

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

void pictures(const examples::Options& options, long long photons) {
    const auto room = final_room<float>();
    // The same random numbers in all pictures: they differ by wrong verdicts only.
    const RenderSettings picture{.width = options.width,
                                 .height = options.height,
                                 .samples = options.samples,
                                 .seed = options.seed,
                                 .threads = options.threads};
    examples::Table table{.name = "shadow-pictures",
                          .columns = {"rule", "photons", "shadow rays skipped",
                                      "relMSE against all rays", "largest block"},
                          .rows = {}};
    const auto shot = [&](SkipRule rule, long long count) {
        const PhotonMapper mapper(room.world, settings_of(options, rule, count),
                                  abilities<Skipping>);
        return render(mapper, room.camera, picture);
    };
    const auto all = shot(SkipRule::none, photons);
    save_png(all.image, options.path("shadow-all.png"));
    for (std::size_t r = 0; r < rules.size(); ++r)
        for (const long long count : {photons / 10, photons}) {
            const auto some = shot(rules[r], count);
            const bool few = count < photons;
            if (!few || rules[r] != SkipRule::report)
                save_png(some.image,
                         options.path("shadow-rule-" + std::to_string(int(rules[r])) +
                                      (few ? "-few.png" : ".png")));
            const auto blocks = block_means(some.image), right = block_means(all.image);
            double largest = 0;
            for (std::size_t i = 0; i < right.pixels.size(); ++i)
                largest = std::max(
                    largest, std::abs(blocks.pixels[i].y / right.pixels[i].y - 1));
            table.rows.push_back(
                {rule_names[r], std::to_string(count),
                 examples::text(100 * (1 - double(some.counts.shadow_rays) /
                                               double(all.counts.shadow_rays)),
                                "%.1f %%"),
                 examples::text(rel_mse(some.image, all.image), "%.2g"),
                 examples::text(100 * largest, "%.1f %%")});
        }
    examples::show_table(options, table);
}

// --- Skipped and wrong, over photons, radius and the size of what throws the shadow --

/// A floor of 10 x 10, a lamp of 2 x 2 at the height 5, and three balls that lie on it.
Hall three_balls(float radius) {
    HallScene hall;
    const auto grey = hall.add(Lambertian{.albedo = Rgb{0.5f}});
    hall.add(Quad{.corner{-5, 0, -5}, .edge_u{0, 0, 10}, .edge_v{10, 0, 0}}, grey);
    hall.add(Quad{.corner{-1, 5, -1}, .edge_u{2, 0, 0}, .edge_v{0, 0, 2}},
             hall.add(Lambertian{.albedo = Rgb{0}}), Rgb{10});
    for (const Vec2& at : {Vec2{-2, -1}, Vec2{1.3f, 1.6f}, Vec2{2, -2.2f}})
        hall.add(Sphere{.center{at.x, radius, at.y}, .radius = radius}, grey);
    return Hall(std::move(hall));
}

/// Points of the floor with the visible fraction of the lamp, by brute force.
struct Probes {
    std::vector<Vec3> points{}; ///< On the floor.
    std::vector<double> seen{}; ///< In [0, 1].
    std::size_t everywhere = 0; ///< This many, first, over the whole floor.
};
double part_seen(const Hall& hall, const Vec3& at, int n) {
    int seen = 0;
    for (int i = 0; i < n * n; ++i) {
        const Vec3 to{-1 + (float(i % n) + 0.5f) * 2 / float(n), 5,
                      -1 + (float(i / n) + 0.5f) * 2 / float(n)};
        seen += occluded(hall, Ray{.origin = at,
                                   .direction = to - at,
                                   .t_min = 1e-4f,
                                   .t_max = 0.9999f})
                    ? 0
                    : 1;
    }
    return double(seen) / (n * n);
}

Probes make_probes(const Hall& hall, float radius, const examples::Options& options) {
    Probes probes;
    examples::Numbers numbers{7};
    const auto add = [&](float x, float z) {
        probes.points.push_back({x, 0, z});
        probes.seen.push_back(
            part_seen(hall, probes.points.back(), options.pick(8, 16, 32)));
    };
    const int side = options.pick(30, 100, 200);
    for (int i = 0; i < side * side; ++i)
        add(float(10 * (i % side + numbers.next()) / side - 5),
            float(10 * (i / side + numbers.next()) / side - 5));
    probes.everywhere = probes.points.size();
    for (const Vec2& ball : {Vec2{-2, -1}, Vec2{1.3f, 1.6f}, Vec2{2, -2.2f}})
        for (int i = 0; i < side * side / 3; ++i)
            add(ball.x + 3 * radius * float(numbers.between(-1, 1)),
                ball.y + 3 * radius * float(numbers.between(-1, 1)));
    return probes;
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

/// How often a rule skips rays, and how often it is wrong; fractions.
struct Outcome {
    double skipped = 0; ///< Fraction of points with a verdict.
    double wrong = 0;   ///< Points with one that is more than 5 % of the lamp off.
    double lost = 0;    ///< Points called lit, of those that miss more than 5 % of it.
};
Outcome outcome(const Hall& hall, const Probes& probes, const SkipSettings& skip,
                long long photons, const examples::Options& options, int seeds) {
    Outcome mean;
    for (int seed = 0; seed < seeds; ++seed) {
        const VerdictGrid grid = verdicts_of(hall, skip, photons, options, seed);
        double skipped = 0, wrong = 0, lost = 0, hidden = 0;
        for (std::size_t i = 0; i < probes.points.size(); ++i) {
            const SurfacePoint at{.position = probes.points[i], .normal{0, 1, 0}};
            const Verdict verdict = grid.verdict(grid.cell_of(at, 1), 0);
            const double said = verdict == Verdict::lit ? 1 : 0;
            const bool known = verdict != Verdict::unknown;
            const bool bad = known && std::abs(said - probes.seen[i]) > 0.05;
            if (i < probes.everywhere) {
                skipped += known ? 1 : 0;
                wrong += bad ? 1 : 0;
            }
            hidden += probes.seen[i] < 0.95 ? 1 : 0;
            lost += probes.seen[i] < 0.95 && verdict == Verdict::lit ? 1 : 0;
        }
        mean.skipped += skipped / double(probes.everywhere) / seeds;
        mean.wrong += wrong / double(probes.everywhere) / seeds;
        mean.lost += lost / std::max(hidden, 1.0) / seeds;
    }
    return mean;
}

void over_photons(const examples::Options& options, long long most) {
    const std::array sizes{0.5f, 0.1f, 0.03f};
    examples::Table table{.name = "shadow-trade",
                          .columns = {"radius of the balls", "photons", "rule",
                                      "skipped", "wrong, of all points", "shadow lost"},
                          .rows = {}};
    examples::Plot skipped{.name = "shadow-skipped",
                           .columns = {"photons emitted"}, // and the rules
                           .y_label = "shadow rays skipped, %",
                           .rows = {},
                           .log_x = true};
    skipped.more =
        "set xrange [1000:" + std::to_string(most) + "]\nset yrange [0:100]\n";
    examples::Plot lost = skipped;
    lost.name = "shadow-lost";
    lost.y_label = "shadow taken for lit, %";
    const int seeds = options.pick(1, 4, 8);
    for (int i = 6;; ++i) {
        const double photons = std::round(std::pow(10, i / 2.0));
        if (photons > double(most)) break;
        skipped.rows.push_back({photons});
        lost.rows.push_back({photons});
    }
    for (const float size : sizes) {
        const Hall hall = three_balls(size);
        const Probes probes = make_probes(hall, size, options);
        for (std::size_t r = 0; r < rules.size(); ++r) {
            const std::string curve =
                std::string(rule_names[r]) + ": " + examples::text(double(size));
            if (size == sizes[0]) skipped.columns.push_back(curve);
            const bool shown = r == 2 || (r == 1 && size == sizes[0]);
            if (shown) lost.columns.push_back(curve);
            for (std::size_t row = 0; row < skipped.rows.size(); ++row) {
                const auto photons = static_cast<long long>(skipped.rows[row][0]);
                const Outcome found =
                    outcome(hall, probes, {.rule = rules[r]}, photons, options, seeds);
                if (size == sizes[0]) skipped.rows[row].push_back(100 * found.skipped);
                if (shown) lost.rows[row].push_back(100 * found.lost);
                if (row % 2 == 0)
                    table.rows.push_back(
                        {examples::text(double(size)), std::to_string(photons),
                         rule_names[r], examples::text(100 * found.skipped, "%.1f %%"),
                         examples::text(100 * found.wrong, "%.3f %%"),
                         examples::text(100 * found.lost, "%.1f %%")});
            }
        }
    }
    examples::save_plot(options.out, skipped);
    examples::save_plot(options.out, lost);
    examples::show_table(options, table);
}

void over_radius(const examples::Options& options, long long photons) {
    const Hall hall = three_balls(0.5f);
    const Probes probes = make_probes(hall, 0.5f, options);
    examples::Plot skipped{
        .name = "shadow-radius-skipped",
        .columns = {"length of the smallest cells", rule_names[1], rule_names[2]},
        .y_label = "shadow rays skipped, %",
        .rows = {},
        .log_x = true};
    examples::Plot lost = skipped;
    lost.name = "shadow-radius-lost";
    lost.y_label = "shadow taken for lit, %";
    for (int i = 0; i <= options.pick(10, 14, 14); ++i) {
        const double radius = 0.02 * std::pow(2, i / 2.0);
        examples::Row skip_row{radius}, lost_row{radius};
        for (const SkipRule rule : {SkipRule::any, SkipRule::enough}) {
            const Outcome found =
                outcome(hall, probes, {.rule = rule, .radius = float(radius)}, photons,
                        options, options.pick(1, 4, 8));
            skip_row.push_back(100 * found.skipped);
            lost_row.push_back(100 * found.lost);
        }
        skipped.rows.push_back(skip_row);
        lost.rows.push_back(lost_row);
    }
    examples::save_plot(options.out, skipped);
    examples::save_plot(options.out, lost);
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

/// How often a room's verdicts are wrong: a row for each rule.
template <AnyWorld W>
void judge_room(examples::Table& table, const char* name, const W& world,
                const Camera& camera, long long photons,
                const examples::Options& options) {
    const auto places =
        places_of(world, camera, options.pick<std::size_t>(200, 4000, 20000), 5);
    std::vector<double> seen; // for each point and lamp; -1: it faces away
    for (const Vertex& place : places)
        for (std::uint32_t lamp = 0; lamp < world.light_count(); ++lamp) {
            int rays = 0, through = 0;
            for (int i = 0; i < 256; ++i) {
                const Vec2 u{(float(i % 16) + 0.5f) / 16, (float(i / 16) + 0.5f) / 16};
                const auto sampled = sample_light(world, lamp, place.point.position, u);
                if (!sampled || to_local(place.frame, sampled->wi).z * place.wo.z <= 0)
                    continue;
                ++rays;
                through +=
                    occluded(world, spawn_ray_to(place.point, sampled->point)) ? 0 : 1;
            }
            seen.push_back(rays == 0 ? -1 : double(through) / rays);
        }
    // Points that see a lamp wholly or not at all: a perfect rule could skip these.
    double clear = 0, all = 0;
    for (const double part : seen) {
        all += part >= 0;
        clear += (part >= 0 && part <= 0.05) || part >= 0.95;
    }
    for (std::size_t r = 0; r < rules.size(); ++r) {
        const PhotonMapper mapper(world, settings_of(options, rules[r], photons),
                                  abilities<Skipping>);
        double asked = 0, known = 0, wrong = 0;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            if (seen[i] < 0) continue;
            const std::size_t lamps = world.light_count();
            const Verdict verdict = verdicts_of(mapper, places[i / lamps])(i % lamps);
            const double said = verdict == Verdict::lit ? 1 : 0;
            ++asked;
            known += verdict != Verdict::unknown ? 1 : 0;
            wrong += verdict != Verdict::unknown && std::abs(said - seen[i]) > 0.05;
        }
        table.rows.push_back({name, std::to_string(photons), rule_names[r],
                              examples::text(100 * known / asked, "%.1f %%"),
                              examples::text(100 * wrong / asked, "%.3f %%"),
                              examples::text(100 * clear / all, "%.1f %%")});
    }
}

void rooms(const examples::Options& options, long long photons) {
    examples::Table table{.name = "shadow-rooms",
                          .columns = {"room", "photons", "rule", "skipped",
                                      "wrong, of all rays", "a perfect rule skips"},
                          .rows = {}};
    const auto glass = four_glass_room<float>();
    const auto final = final_room<float>();
    for (const long long count : {photons, 10 * photons}) {
        judge_room(table, "figure 11", glass.world, glass.camera, count, options);
        judge_room(table, "figure 1, two lamps", final.world, final.camera, count,
                   options);
    }
    examples::show_table(options, table);
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
    examples::Plot size{.name = "shadow-seconds-size",
                        .columns = {"rays per pixel", "1 shadow ray", "4", "9"},
                        .y_label = "processor time, with / without",
                        .rows = {},
                        .log_x = true,
                        .more = "set yrange [0:*]\n"};
    for (int samples = 1; samples <= options.pick(64, 256, 1024); samples *= 4) {
        examples::Row row{double(samples)};
        for (const int rays : {1, 4, 9}) {
            const Seconds found = seconds_of(glass.world, glass.camera, rays, photons,
                                             samples, samples < 64 ? 5 : 1, options);
            row.push_back(found.with / found.without);
        }
        size.rows.push_back(row);
    }
    examples::save_plot(options.out, size);
    examples::show_table(options, costs);
    examples::show_table(options, table);
}

// --- Indirect rays -------------------------------------------------------------------

/// Two rooms with a door between; the lamp is in the left one.
Hall two_rooms() {
    HallScene hall;
    const auto white = hall.add(Lambertian{.albedo = Rgb{0.6f}});
    const Vec3 x{4, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    hall.add(Quad{.corner{-2, 0, 0}, .edge_u = z, .edge_v = x}, white);
    hall.add(Quad{.corner{-2, 1, 0}, .edge_u = x, .edge_v = z}, white);
    hall.add(Quad{.corner{-2, 0, 0}, .edge_u = x, .edge_v = y}, white);
    hall.add(Quad{.corner{-2, 0, 0}, .edge_u = y, .edge_v = z}, white);
    hall.add(Quad{.corner{2, 0, 0}, .edge_u = z, .edge_v = y}, white);
    hall.add(Quad{.corner{0, 0, 0}, .edge_u{0, 1, 0}, .edge_v{0, 0, 0.6f}}, white);
    hall.add(
        Quad{.corner{-1.2f, 0.999f, 0.3f}, .edge_u{0.3f, 0, 0}, .edge_v{0, 0, 0.3f}},
        hall.add(Lambertian{.albedo = Rgb{0}}), Rgb{20});
    return Hall(std::move(hall));
}

void indirect(const examples::Options& options) {
    const Hall hall = two_rooms();
    const Camera camera =
        look_at({.position{0, 0.55f, 3.1f}, .target{0, 0.45f, 0}, .vfov_degrees = 48});
    const RenderSettings picture{.width = options.width,
                                 .height = options.height / 2,
                                 .samples = options.pick(4, 36, 256),
                                 .seed = options.seed,
                                 .threads = options.threads};
    PhotonMappingSettings settings =
        settings_of(options, SkipRule::none, options.pick(1000LL, 100LL, 100LL));
    const auto all = render(PhotonMapper(hall, settings), camera, picture);
    save_png(all.image, options.path("shadow-dark-all.png"), {.exposure = 3});
    const auto right_half = [](const Image& image) {
        double sum = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 6 * image.width / 10; x < image.width; ++x)
                sum += double(pixel(image, x, y).y);
        return sum;
    };
    const auto mean = [](const Image& image) {
        double sum = 0;
        for (const Rgb& p : image.pixels) sum += double(p.y);
        return sum / double(image.pixels.size());
    };
    examples::Table table{.name = "shadow-dark",
                          .columns = {"photons", "cell", "bound of E, W/m²",
                                      "bound over the mean E", "bounces skipped",
                                      "light left in the picture", "in the dark room"},
                          .rows = {}};
    settings.skip.indirect_rays = true;
    settings.skip.radius = 0.1f; // chosen by the photons, it would shrink with them
    for (const long long photons : {100LL, 1000LL, 10000LL, 100000LL}) {
        settings.general.photons = photons;
        const PhotonMapper mapper(hall, settings, abilities<Skipping>);
        const auto some = render(mapper, camera, picture);
        if (photons <= 1000)
            save_png(some.image,
                     options.path("shadow-dark-" + std::to_string(photons) + ".png"),
                     {.exposure = 3});
        const Rgb flux{Vec3(mapper.maps().general_audit.emitted) / float(photons)};
        const float radius = mapper.state<Skipping>().verdicts.radius();
        const double bound = double(unseen_irradiance(flux, radius).y);
        // The mean irradiance: radiance times pi over the albedo.
        const double irradiance = mean(all.image) * std::numbers::pi / 0.6;
        const double skipped = double(some.counts.skipped_bounces);
        table.rows.push_back(
            {std::to_string(photons), examples::text(double(radius), "%.3f"),
             examples::text(bound, "%.3g"),
             examples::text(100 * bound / irradiance, "%.0f %%"),
             examples::text(100 * skipped / (skipped + double(some.counts.bounce_rays)),
                            "%.2f %%"),
             examples::text(100 * mean(some.image) / mean(all.image), "%.2f %%"),
             examples::text(100 * right_half(some.image) / right_half(all.image),
                            "%.2f %%")});
    }
    examples::show_table(options, table);
}

} // namespace

/// Makes the pictures, plots and tables behind chapter 25.
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
        pictures(options, photons);
        over_photons(options, options.pick(photons, 10 * photons, 10 * photons));
        over_radius(options, photons);
        rooms(options, photons);
        wire(options, photons);
        indirect(options);
        // In a draft the first pass must not outweigh a second one of few pixels.
        savings(options, options.pick(photons / 10, photons, photons), cuts);
    });
}
