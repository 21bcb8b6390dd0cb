// smoke: --quality draft --width 24 --height 24 --seeds 2 --truth 16
/// \file chapters/experiments/31_experiments.cpp
/// \brief Chapter 31: the cost and the gain of interpolating irradiance.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <ljus/image/flip.hpp>
#include <ljus/ljus.hpp>
#include <ljus/math/stratified_stream.hpp>
#include <ljus/path/light_transport.hpp>
#include <ljus/render/adaptive.hpp>
#include <ljus/render/gathering.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/convergence.hpp"
#include "common/oracle.hpp"
#include "common/plot.hpp"
#include "experiments/show_table.hpp"

using namespace ljus;

namespace {

using examples::text;
using Box = decltype(cornell_box());
/// The photon mapper of the preset `fast`.
using Mapper = PhotonMapper<decltype(Box::world), StratifiedStream, Gathering>;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The options of this program, besides the common ones.
struct Sizes {
    int seeds = 0; ///< Runs behind each bias and variance.
    int truth = 0; ///< Rays per pixel of the references.
    int side = 0;  ///< Of the pictures whose errors are measured, in pixels.
};

// --- A corner where irradiance is known ----------------------------------------------

/// The irradiance on a floor at a distance from an endless wall of height 1 whose
/// radiosity is 1; nothing else emits light.
double beside_wall(double x) {
    return 0.5 * (1 - x / std::hypot(x, 1.0));
}

/// The harmonic mean distance there, by rays spread evenly over the cosine; a ray that
/// misses the wall goes to infinity.
double sees_as_far(double x) {
    constexpr int side = 32;
    double inverse = 0;
    for (int i = 0; i < side * side; ++i) {
        const Vec3T<double> d = sample_cosine_hemisphere(
            Vec2T<double>{(i % side + 0.5) / side, (double(i / side) + 0.5) / side});
        if (!(d.x < 0)) continue;
        const double t = x / -d.x;
        if (t * d.z < 1) inverse += 1 / t / (side * side);
    }
    return inverse > 0 ? 1 / inverse : std::numeric_limits<double>::infinity();
}

constexpr double corner_step = 0.1;               ///< Side of a square of the floor.
constexpr int corner_places = 40;                 ///< Where it is asked.
constexpr std::array reaches{0.1, 0.3, 1.0, 4.0}; ///< Of the records.

/// The distance of a point from the wall: from 0.01 to 1.5 of its height.
double corner_place(int i) {
    return 0.01 * std::pow(150.0, double(i) / (corner_places - 1));
}

/// Records with the exact irradiance beside the wall: one for each square of the floor,
/// anywhere in it.
IrradianceCacheT<double> exact_cache(int run, std::uint64_t seed) {
    constexpr int columns = 22, rows = 9;
    auto stream =
        random_stream(seed, Pass::gathering, 0, static_cast<std::uint64_t>(run));
    std::vector<Vec3T<double>> positions;
    std::vector<GatheredT<double>> records;
    for (int i = 0; i < columns * rows; ++i) {
        const auto u = next_2d<double>(stream);
        const Vec3T<double> p{corner_step * (i % columns + u.x),
                              corner_step * (double(i / columns) - rows * 0.5 + u.y),
                              0};
        positions.push_back(p);
        records.push_back({.irradiance = RgbT<double>{beside_wall(p.x)},
                           .distance = sees_as_far(p.x)});
    }
    return make_irradiance_cache(positions, records, GatherSettings{}, 1);
}

/// The errors of interpolation with one reach at all points, as means over the runs.
struct AtCorner {
    std::array<double, corner_places> squares{}; ///< Of the relative error.
};

/// Adds the errors of one cache, which is one of `runs`.
void add_run(AtCorner& corner, const IrradianceCacheT<double>& cache, double reach,
             int runs) {
    for (int i = 0; i < corner_places; ++i) {
        const auto slot = static_cast<std::size_t>(i);
        const double exact = beside_wall(corner_place(i));
        const auto found = interpolate(cache, Vec3T<double>{corner_place(i), 0, 0},
                                       Vec3T<double>{0, 0, 1}, reach);
        if (!found) continue; // gathered anew, and exact
        const double e = found->x / exact - 1;
        corner.squares[slot] += e * e / runs;
    }
}

/// One for each reach.
using Corner = std::array<AtCorner, reaches.size()>;

void plot_corner(const Corner& corner, const examples::Options& options) {
    examples::Plot plot{.name = "irradiance_cache-corner",
                        .columns = {"distance from the wall, over its height",
                                    "reach 0.1", "reach 0.3", "reach 1", "reach 4"},
                        .y_label = "relative error, root mean square",
                        .log_x = true,
                        .log_y = true};
    for (int i = 0; i < corner_places; ++i) {
        examples::Row row{corner_place(i)};
        for (const AtCorner& at : corner) {
            const double e = std::sqrt(at.squares[static_cast<std::size_t>(i)]);
            row.push_back(e > 0 ? e : nothing);
        }
        plot.rows.push_back(row);
    }
    save_plot(options.out, plot);
}

/// Exact records without noise: the error is that of the interpolation alone.
void corner(const examples::Options& options) {
    const int runs = options.pick(32, 400, 2000);
    Corner found{};
    for (int run = 0; run < runs; ++run) {
        const auto cache = exact_cache(run, options.seed);
        for (std::size_t k = 0; k < reaches.size(); ++k)
            add_run(found[k], cache, reaches[k], runs);
    }
    plot_corner(found, options);
}

// --- Each knob -----------------------------------------------------------------------

/// The preset `fast` for one seed.
PhotonMappingSettings fast(int side, std::uint64_t seed, int threads) {
    auto settings = preset_settings(Preset::fast, side, side);
    settings.general.seed = settings.caustics.seed = seed;
    settings.general.threads = settings.caustics.threads = threads;
    return settings;
}

/// Indirect light alone, from a renderer of all light.
template <typename Renderer>
Image indirect_light(const Box& room, const Renderer& renderer,
                     const RenderSettings& picture) {
    const OnlyPaths indirect(renderer, "E.*D.*D.*L");
    auto image = render(indirect, room.camera, picture).image;
    examples::stop_if_asked();
    return image;
}

/// The mean of a picture over that of another, less 1.
template <typename T, typename U>
double mean_error(const ImageT<T>& image, const ImageT<U>& truth) {
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const RgbT<double> a(image.pixels[i]), b(truth.pixels[i]);
        sum += a.x + a.y + a.z;
        all += b.x + b.y + b.z;
    }
    return sum / all - 1;
}

/// A reference from eight independent pictures, whose scatter gives its noise.
examples::Oracle oracle_of(const std::function<Image(int, std::uint64_t)>& shot,
                           int rays, int side) {
    constexpr int pieces = 8;
    const int part = std::max(1, rays / pieces);
    examples::Oracle oracle{.truth = make_image<double>(side, side),
                            .rays = part * pieces};
    std::vector<Image> runs;
    for (std::uint64_t piece = 0; piece < pieces; ++piece) {
        runs.push_back(shot(part, 9000 + piece));
        for (std::size_t i = 0; i < runs.back().pixels.size(); ++i)
            oracle.truth.pixels[i] += RgbT<double>(runs.back().pixels[i]) / 8.0;
    }
    oracle.noise = examples::relative_split(runs, oracle.truth).variance / pieces;
    oracle.block_noise =
        examples::relative_split(runs, oracle.truth, 0, 10).variance / pieces;
    return oracle;
}

/// The box as all settings of the cache see it: with the same photons, beside a
/// reference of its indirect light.
struct Bench {
    const Box& room;
    const examples::Options& options;
    const Sizes& sizes;
    PhotonMappingSettings settings; ///< The preset `fast`.
    examples::Oracle twin{}; ///< Gathered at every vertex, from the same photons.

    [[nodiscard]] RenderSettings picture(int samples, std::uint64_t seed) const {
        return {.width = sizes.side,
                .height = sizes.side,
                .samples = samples,
                .seed = seed,
                .threads = options.threads};
    }
};

/// The reference of the bench.
void add_oracle(Bench& bench) {
    const int side = bench.sizes.side, truth = bench.sizes.truth;
    auto one_by_one = bench.settings;
    one_by_one.indirect = IndirectLight::gather;
    const Mapper mapper(bench.room.world, one_by_one);
    bench.twin = oracle_of(
        [&](int rays, std::uint64_t seed) {
            return indirect_light(bench.room, mapper, bench.picture(rays, seed));
        },
        4 * truth, side);
}

/// A way to gather, and which curve of the plot it belongs to.
struct Knob {
    GatherSettings gather{};
    std::size_t curve = 0; ///< Which column.
};

/// Each setting of the cache varied, with the others fixed.
std::vector<Knob> all_knobs() {
    std::vector<Knob> all;
    for (const int tile : {2, 3, 4, 6}) all.push_back({{.tile = tile}, 1});
    for (const int rays : {9, 16, 25, 49, 100}) all.push_back({{.rays = rays}, 2});
    for (const std::size_t nearest : {3u, 6u, 10u, 20u})
        all.push_back({{.nearest = nearest}, 3});
    for (const float reach : {0.3f, 0.5f, 1.0f, 2.0f, 4.0f})
        all.push_back({{.reach = reach}, 4});
    return all;
}

/// The result of one setting, over several seeds.
struct Turned {
    double seconds = 0;
    BiasVariance error{};
};

Turned turn(const Bench& bench, const Knob& knob) {
    auto now = bench.settings;
    now.gather = knob.gather;
    Mapper mapper(bench.room.world, now); // the same photons for all
    Turned found;
    std::vector<Image> runs;
    const int seeds = bench.sizes.seeds;
    for (int seed = 1; seed <= seeds; ++seed) {
        const RenderSettings picture =
            bench.picture(9, static_cast<std::uint64_t>(seed));
        const double start = examples::processor_seconds();
        mapper.fill_cache(bench.room.camera, picture);
        runs.push_back(indirect_light(bench.room, mapper, picture));
        found.seconds += (examples::processor_seconds() - start) / seeds;
    }
    found.error = examples::relative_split(runs, bench.twin.truth, bench.twin.noise);
    return found;
}

/// Indirect light alone, one setting after the other.
void knobs(const examples::Options& options, const Sizes& sizes) {
    const Box room = cornell_box();
    const auto settings = fast(sizes.side, options.seed, options.threads);
    Bench bench{room, options, sizes, settings};
    add_oracle(bench);
    examples::Plot plot{
        .name = "irradiance_cache-knobs-plot",
        .columns = {"processor seconds", "tile", "gather rays", "nearest", "reach"},
        .y_label = "relMSE of indirect light",
        .rows = {}};
    for (const Knob& knob : all_knobs()) {
        const Turned found = turn(bench, knob);
        examples::Row row(plot.columns.size(), nothing);
        row[0] = found.seconds;
        row[knob.curve] =
            std::max(found.error.bias_squared + found.error.variance, 1e-9);
        plot.rows.push_back(row);
    }
    save_plot(options.out, plot);
}

// --- Whole pictures ------------------------------------------------------------------

/// A way to make a whole picture: rays per pixel and a seed for all.
struct Method {
    std::string name;
    std::function<Image(int, std::uint64_t)> shoot;
};

/// The result of a method, over several seeds.
struct Result {
    double seconds = 0; ///< Of a processor, both passes.
    BiasVariance pixels{}, blocks{};
    double mean = 0, flip = 0, trimmed = 0;
    [[nodiscard]] double error() const { return pixels.bias_squared + pixels.variance; }
    [[nodiscard]] double block_error() const {
        return blocks.bias_squared + blocks.variance;
    }
};

Result try_method(const Method& method, int rays, const examples::Oracle& oracle,
                  int seeds) {
    Result result;
    std::vector<Image> runs;
    for (int seed = 1; seed <= seeds; ++seed) {
        const double start = examples::processor_seconds();
        runs.push_back(method.shoot(rays, static_cast<std::uint64_t>(seed)));
        result.seconds += (examples::processor_seconds() - start) / seeds;
        result.flip += flip(runs.back(), oracle.truth) / seeds;
        result.mean += mean_error(runs.back(), oracle.truth) / seeds;
        result.trimmed += trimmed_rel_mse(runs.back(), oracle.truth) / seeds;
        examples::stop_if_asked();
    }
    result.pixels = examples::relative_split(runs, oracle.truth, oracle.noise);
    result.blocks =
        examples::relative_split(runs, oracle.truth, oracle.block_noise, 10);
    return result;
}

/// A picture by photons: both passes.
template <typename Draws>
Image by_photons(const Box& room, const PhotonMappingSettings& settings,
                 const RenderSettings& picture, int more = 0) {
    PhotonMapper mapper(room.world, settings, abilities<Draws, Gathering>);
    mapper.fill_cache(room.camera, picture);
    if (more == 0) return render(mapper, room.camera, picture).image;
    RenderSettings most = picture;
    most.samples = 1 + more;
    return render_adaptive(
               mapper, room.camera, most,
               {.first = 1, .more = more, .disagreement = PresetRays{}.disagreement})
        .image;
}

void methods(const examples::Options& options, const Sizes& sizes,
             const examples::Oracle& oracle) {
    const Box room = cornell_box();
    const int side = sizes.side;
    const auto picture = [&](int rays, std::uint64_t seed) {
        return RenderSettings{.width = side,
                              .height = side,
                              .samples = rays,
                              .seed = seed,
                              .threads = options.threads};
    };
    const auto photons = [&](IndirectLight indirect) {
        return [&, indirect](int rays, std::uint64_t seed) {
            auto settings = fast(side, seed, options.threads);
            settings.indirect = indirect;
            return by_photons<StratifiedStream>(room, settings, picture(rays, seed));
        };
    };
    const PathTracer tracer(room.world);
    const std::vector<Method> all{
        {"cache", photons(IndirectLight::cache)},
        {"gather", photons(IndirectLight::gather)},
        {"photons", photons(IndirectLight::photons)},
        {"rays", photons(IndirectLight::rays)},
        {"path tracing", [&](int rays, std::uint64_t seed) {
             return render(tracer, room.camera, picture(rays, seed)).image;
         }}};
    std::vector<int> rungs{1, 4, 16};
    if (options.pick(false, true, true)) rungs.push_back(64);
    examples::Plot plot{.name = "irradiance_cache-trade",
                        .columns = {"processor seconds"},
                        .y_label = "relMSE of the picture",
                        .log_x = true,
                        .log_y = true};
    for (const Method& method : all) plot.columns.push_back(method.name);
    examples::Table table{.name = "irradiance_cache-trade-table",
                          .columns = {"indirect light by", "rays per pixel",
                                      "processor seconds", "bias²", "noise",
                                      "blocks: bias²", "noise", "mean", "FLIP"}};
    for (std::size_t m = 0; m < all.size(); ++m)
        for (const int rays : rungs) {
            const Result r = try_method(all[m], rays, oracle, sizes.seeds);
            examples::Row row(all.size() + 1, nothing);
            row[0] = r.seconds;
            row[m + 1] = std::max(r.error(), 1e-9);
            plot.rows.push_back(row);
            if (rays != 4 && rays != rungs.back()) continue;
            table.rows.push_back(
                {all[m].name, std::to_string(rays), text(r.seconds, "%.3f"),
                 text(r.pixels.bias_squared, "%.2g"), text(r.pixels.variance, "%.2g"),
                 text(r.blocks.bias_squared, "%.2g"), text(r.blocks.variance, "%.2g"),
                 text(100 * r.mean, "%+.2f %%"), text(r.flip, "%.3f")});
        }
    save_plot(options.out, plot);
    examples::show_table(options, table);
}

/// One idea more than the rung before.
struct Rung {
    const char* idea;
    int shadow_rays;
    DirectLight direct;
    IndirectLight indirect;
    bool stratified;
    int more; ///< The most rays that are added to one, where those around differ.
};
constexpr std::array ladder_rungs{
    Rung{"the report's: one shadow ray", 1, DirectLight::sampled, IndirectLight::rays,
         false, 0},
    Rung{"+ four shadow rays, stratified", 4, DirectLight::sampled, IndirectLight::rays,
         false, 0},
    Rung{"+ a stratified stream", 4, DirectLight::sampled, IndirectLight::rays, true,
         0},
    Rung{"+ lamps in closed form", 4, DirectLight::analytic, IndirectLight::rays, true,
         0},
    Rung{"+ the cache for indirect rays", 4, DirectLight::analytic,
         IndirectLight::cache, true, 0},
    Rung{"+ one ray, more where rays differ", 4, DirectLight::analytic,
         IndirectLight::cache, true, preset_rays(Preset::fast).more}};

/// The room as a rung of the ladder renders it.
Image shoot_rung(const Rung& rung, const Box& room, const RenderSettings& picture) {
    auto settings = fast(picture.width, picture.seed, picture.threads);
    settings.shadow_rays = rung.shadow_rays;
    settings.direct = rung.direct;
    settings.indirect = rung.indirect;
    return rung.stratified
               ? by_photons<StratifiedStream>(room, settings, picture, rung.more)
               : by_photons<RandomStream>(room, settings, picture, rung.more);
}

/// From the report's photon mapper to the preset `fast`, one idea after the other.
void ladder(const examples::Options& options, const Sizes& sizes,
            const examples::Oracle& oracle) {
    const Box room = cornell_box();
    examples::Table table{.name = "irradiance_cache-ladder",
                          .columns = {"", "processor seconds", "relMSE", "trimmed",
                                      "of blocks", "mean", "FLIP"}};
    for (const Rung& rung : ladder_rungs) {
        const Method method{rung.idea, [&](int rays, std::uint64_t seed) {
                                return shoot_rung(rung, room,
                                                  {.width = sizes.side,
                                                   .height = sizes.side,
                                                   .samples = rays,
                                                   .seed = seed,
                                                   .threads = options.threads});
                            }};
        const Result r = try_method(method, 2, oracle, sizes.seeds);
        table.rows.push_back({rung.idea, text(r.seconds, "%.3f"),
                              text(r.error(), "%.2g"), text(r.trimmed, "%.2g"),
                              text(r.block_error(), "%.2g"),
                              text(100 * r.mean, "%+.2f %%"), text(r.flip, "%.3f")});
    }
    examples::show_table(options, table);
}

/// What "three seconds" looks like.
void fast_picture(const examples::Options& options) {
    const Box room = cornell_box();
    const Image image = by_photons<StratifiedStream>(
        room, fast(options.width, options.seed, options.threads),
        {.width = options.width,
         .height = options.height,
         .samples = 1,
         .seed = options.seed,
         .threads = options.threads},
        preset_rays(Preset::fast).more);
    save_png(image, options.path("irradiance_cache-fast.png"));
}

// --- The closed form in a penumbra ---------------------------------------------------

using Stage = Scene<Shapes<Quad>, Materials<Lambertian>>;

constexpr float lamp_side = 2, lamp_height = 1; ///< Of a square lamp over a floor.

/// A floor, a lamp, and halfway between them half a ceiling whose edge is over x = 0.
World<Stage> penumbra_stage() {
    Stage stage;
    const auto white = stage.add(Lambertian{.albedo = Rgb{1}});
    const auto black = stage.add(Lambertian{.albedo = Rgb{0}});
    const float h = lamp_height, s = lamp_side;
    stage.add(Quad{.corner{-4, 0, -4}, .edge_u{0, 0, 8}, .edge_v{8, 0, 0}}, white);
    stage.add(Quad{.corner{-8, h / 2, -8}, .edge_u{8, 0, 0}, .edge_v{0, 0, 16}}, black);
    stage.add(Quad{.corner{-s / 2, h, -s / 2}, .edge_u{s, 0, 0}, .edge_v{0, 0, s}},
              black, Rgb{1});
    return World(std::move(stage));
}

constexpr std::array shadow_rays{1, 2, 4, 9};

/// The light that the closed form finds at one point, as a fraction of the whole
/// lamp's; one value for each number of shadow rays.
struct InPenumbra {
    double x = 0; ///< Position; the penumbra is -1 to 1.
    std::array<double, shadow_rays.size()> bias{};
};

InPenumbra measure_penumbra(const World<Stage>& stage, double place,
                            std::uint64_t number, long long trials,
                            std::uint64_t seed) {
    InPenumbra here{.x = place};
    const float h = lamp_height, s = lamp_side, x = float(place) * s / 2;
    const Ray down{.origin{x, h / 4, 0}, .direction{0, -1, 0}};
    const auto vertex = vertex_at(stage, down, *closest_hit(stage, down));
    const Lambertian white{.albedo = Rgb{1}};
    // From x the edge hides all of the lamp that is left of -x.
    const auto from = [&](float left) {
        const Quad part{
            .corner{left, h, -s / 2}, .edge_u{s / 2 - left, 0, 0}, .edge_v{0, 0, s}};
        if (!(left < s / 2)) return 0.0;
        const auto& at = vertex.point;
        return double(
            form_factor_from(at.position, at.normal, part, false).value_or(0));
    };
    const double whole = from(-s / 2), exact = from(std::max(-s / 2, -x));
    for (std::size_t k = 0; k < shadow_rays.size(); ++k) {
        double sum = 0;
        for (long long t = 0; t < trials; ++t) {
            auto stream =
                random_stream(seed, Pass::gathering, 1 + k,
                              number * std::uint64_t(trials) + std::uint64_t(t));
            Counts counts;
            auto context = context_of(stream, counts);
            const Rgb value = sample_all_lights(
                stage, vertex, white, {DirectLight::analytic, shadow_rays[k]}, context);
            sum += double(value.x) / whole / double(trials);
        }
        here.bias[k] = sum - exact / whole;
    }
    return here;
}

void penumbra(const examples::Options& options) {
    const int places = options.pick(10, 24, 24);
    const long long trials = options.pick(8000, 100000, 1000000);
    examples::Plot plot{
        .name = "irradiance_cache-penumbra",
        .columns = {"place; the penumbra is from -1 to 1", "1 ray", "2", "4", "9"},
        .y_label = "bias, % of the whole lamp's light"};
    const World stage = penumbra_stage();
    std::vector<InPenumbra> found(static_cast<std::size_t>(places));
    const auto at_place = [&](long long i) {
        found[static_cast<std::size_t>(i)] =
            measure_penumbra(stage, 1.2 * (2 * (double(i) + 0.5) / places - 1),
                             static_cast<std::uint64_t>(i), trials, options.seed);
    };
    (void)parallel_blocks(places, at_place, {.threads = options.threads});
    examples::stop_if_asked();
    for (const InPenumbra& f : found) {
        plot.rows.push_back({f.x});
        for (const double b : f.bias) plot.rows.back().push_back(100 * b);
    }
    save_plot(options.out, plot);
}

} // namespace

/// Makes the plots and tables of chapter 31, and the picture by the preset `fast`.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 31, the irradiance cache: corners, knobs, trades.");
        line.add("--seeds", sizes.seeds, "Runs behind each error", 2, 1000);
        line.add("--truth", sizes.truth, "Rays per pixel of the references", 8,
                 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 96, .height = 96, .samples = 4},
                        .report{.width = 400, .height = 400, .samples = 4},
                        .reference{.width = 400, .height = 400, .samples = 4}});
        if (!line.given("--seeds")) sizes.seeds = options.pick(4, 16, 64);
        if (!line.given("--truth")) sizes.truth = options.pick(256, 1024, 16384);
        sizes.side = std::min(options.pick(40, 120, 200), options.width);
        corner(options);
        penumbra(options);
        knobs(options, sizes);
        const auto oracle = examples::find_oracle("cornell", cornell_box(), sizes.side,
                                                  2 * sizes.truth, options);
        methods(options, sizes, oracle);
        ladder(options, sizes, oracle);
        fast_picture(options);
    });
}
