// smoke: --quality draft --width 24 --height 24 --seeds 2 --truth 16
/// \file 29_irradiance_cache.cpp
/// \brief Chapter 29: the irradiance cache. What interpolating costs and what it buys.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/image/flip.hpp>
#include <ljus/inspect/photon_dots.hpp>
#include <ljus/ljus.hpp>
#include <ljus/math/stratified_stream.hpp>
#include <ljus/path/light_transport.hpp>
#include <ljus/render/adaptive.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/convergence.hpp"
#include "common/drawing.hpp"
#include "common/oracle.hpp"
#include "common/plot.hpp"

using namespace ljus;

namespace {

using examples::text;
using Box = decltype(cornell_box());
using Maps = PhotonMapsT<float>;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// What the user may set besides the common options.
struct Sizes {
    int seeds = 0; ///< Runs behind each bias and variance.
    int truth = 0; ///< Rays a pixel of the references.
    int side = 0;  ///< Of the pictures whose errors are measured, in pixels.
};

/// Prints a table as it is saved.
void show(const examples::Options& options, const examples::Table& table) {
    save_table(options.out, table);
    if (options.quiet) return;
    std::printf("%s\n", table.name.c_str());
    examples::print_rows(table, 12);
}

// --- The idea ------------------------------------------------------------------------

/// A room in the plane: how far a point of its floor sees, as a harmonic mean.
double distance_on_floor(double x, double width, double height) {
    double inverse = 0;
    constexpr int rays = 4000;
    for (int i = 0; i < rays; ++i) {
        const double along = (2 * i + 1.0) / rays - 1; // the cosine law in the plane
        const double up = std::sqrt(1 - along * along);
        const double wall = along < 0 ? x / -along : (width - x) / along;
        inverse += 1 / std::min(wall, height / up) / rays;
    }
    return 1 / inverse;
}

/// Points on a floor, how far each of them counts, and a place that asks.
void draw_idea(const examples::Options& options) {
    constexpr double width = 9, height = 2.4, reach = 0.5;
    constexpr std::array places{0.12, 0.45, 0.8, 1.35, 1.9, 2.4, 3.0, 3.5, 4.2, 4.75};
    examples::Drawing figure{
        .name = "irradiance_cache-idea",
        .description = "Points on a floor beside a wall; those near the wall count for "
                       "a short distance",
        .low{-0.2, -0.5},
        .high{5.3, 1.75},
        .scale = 130};
    draw_area(figure, {{-0.2, -0.1}, {5.3, -0.1}, {5.3, 0}, {-0.2, 0}}, "currentColor");
    draw_area(figure, {{-0.2, 0}, {0, 0}, {0, 1.75}, {-0.2, 1.75}}, "currentColor");
    draw_line(figure, {{0, 1.75}, {0, 0}, {5.3, 0}});
    for (const double x : places) {
        const double r = reach * distance_on_floor(x, width, height);
        draw_arc(figure, {x, 0}, r, 0, std::numbers::pi,
                 {examples::colors::blue, 1, true});
    }
    // Six points take part, the nearest says how far they may lie.
    constexpr double asked = 2.6, around = 1.25;
    for (const double x : places) {
        const double share = (x - asked) * (x - asked) / (around * around);
        const double r = reach * distance_on_floor(x, width, height);
        if (share < 1 && std::abs(x - asked) < r)
            draw_line(figure, {{asked, 0.42}, {x, 0}},
                      {examples::colors::orange, 0.5 + 5 * (1 - share)});
        draw_dot(figure, {x, 0}, 5, examples::colors::blue);
    }
    draw_dot(figure, {asked, 0.42}, 6, examples::colors::orange);
    draw_line(figure, {{asked, 0.42}, {asked, 0}}, {"currentColor", 1, true});
    draw_label(figure, {asked, 0.62}, "E ?", examples::colors::orange);
    draw_label(figure, {2.6, -0.3},
               "points that have gathered, and how far each counts",
               examples::colors::blue);
    save_drawing(options.out, figure);
}

// --- A corner where irradiance is known ----------------------------------------------

/// The irradiance on a floor at a distance from an endless wall of height 1 whose
/// radiosity is 1; nothing else shines.
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

/// Exact records, no noise: what is wrong then is the interpolation alone.
void corner(const examples::Options& options) {
    constexpr double step = 0.1;
    constexpr int columns = 22, rows = 9, places = 40;
    constexpr std::array reaches{0.1, 0.3, 1.0, 4.0};
    const int runs = options.pick(32, 400, 2000);
    std::array<std::vector<double>, reaches.size()> squares, gathered;
    for (auto& s : squares) s.assign(places, 0);
    for (auto& g : gathered) g.assign(places, 0);
    const auto place = [](int i) {
        return 0.01 * std::pow(150.0, double(i) / (places - 1));
    };
    for (int run = 0; run < runs; ++run) {
        auto stream = random_stream(options.seed, Pass::gathering, 0,
                                    static_cast<std::uint64_t>(run));
        std::vector<Vec3T<double>> positions;
        std::vector<GatheredT<double>> records;
        for (int i = 0; i < columns * rows;
             ++i) { // one for each square, anywhere in it
            const auto u = next_2d<double>(stream);
            const Vec3T<double> p{step * (i % columns + u.x),
                                  step * (double(i / columns) - rows * 0.5 + u.y), 0};
            positions.push_back(p);
            records.push_back({.irradiance = RgbT<double>{beside_wall(p.x)},
                               .distance = sees_as_far(p.x)});
        }
        IrradianceCacheT<double> cache;
        cache.tree = KdTree8T<double>(positions, 1);
        for (const std::uint32_t i : cache.tree.point_ids())
            cache.records.push_back(records[i]);
        detail::measure_spacing(cache, GatherSettings{}, 1);
        for (std::size_t k = 0; k < reaches.size(); ++k)
            for (int i = 0; i < places; ++i) {
                const auto slot = static_cast<std::size_t>(i);
                const double exact = beside_wall(place(i));
                const auto found =
                    interpolate(cache, Vec3T<double>{place(i), 0, 0},
                                Vec3T<double>{0, 0, 1}, double(reaches[k]));
                if (!found) {
                    gathered[k][slot] += 1.0 / runs; // exactly
                    continue;
                }
                const double e = found->x / exact - 1;
                squares[k][slot] += e * e / runs;
            }
    }
    examples::Plot plot{.name = "irradiance_cache-corner",
                        .columns = {"distance from the wall, over its height",
                                    "reach 0.1", "reach 0.3", "reach 1", "reach 4"},
                        .y_label = "relative error, root mean square",
                        .log_x = true,
                        .log_y = true};
    for (int i = 0; i < places; ++i) {
        examples::Row row{place(i)};
        for (const auto& s : squares) {
            const double e = std::sqrt(s[static_cast<std::size_t>(i)]);
            row.push_back(e > 0 ? e : nothing);
        }
        plot.rows.push_back(row);
    }
    save_plot(options.out, plot);
    examples::Table table{.name = "irradiance_cache-corner-table",
                          .columns = {"reach", "error within a step of the wall",
                                      "farther out", "gathered anew within a step",
                                      "farther out"}};
    for (std::size_t k = 0; k < reaches.size(); ++k) {
        std::array<double, 2> error{}, anew{}, count{};
        for (int i = 0; i < places; ++i) {
            const std::size_t part = place(i) < step ? 0 : 1;
            error[part] += squares[k][static_cast<std::size_t>(i)];
            anew[part] += gathered[k][static_cast<std::size_t>(i)];
            count[part] += 1;
        }
        table.rows.push_back({text(reaches[k])});
        for (const std::size_t part : {0u, 1u})
            table.rows.back().push_back(
                text(100 * std::sqrt(error[part] / count[part]), "%.2f %%"));
        for (const std::size_t part : {0u, 1u})
            table.rows.back().push_back(
                text(100 * anew[part] / count[part], "%.1f %%"));
    }
    show(options, table);
}

// --- The pictures --------------------------------------------------------------------

/// A renderer whose gathered light alone is seen.
template <typename R>
struct GatheredOnly {
    using Stream = typename R::Stream;
    const R& renderer;
};

/// Adds up what was gathered or interpolated, and drops all else.
struct GatheredLog {
    Rgb sum{0};
    void begin() const {}
    void vertex(char, const Vec3&, const Rgb&, float) const {}
    void term(std::string_view owner, std::string_view, const Rgb& value) {
        if (owner == "irradiance cache" || owner == "irradiance points") sum += value;
    }
};

template <typename R, typename Log>
Rgb radiance(const GatheredOnly<R>& only, const Ray& ray, typename R::Stream& stream,
             Counts& counts, Log&&) {
    GatheredLog log;
    (void)radiance(only.renderer, ray, stream, counts, log);
    return log.sum;
}

/// The preset `fast` for one seed.
PhotonMappingSettings fast(int side, std::uint64_t seed, int threads) {
    auto settings = preset_settings(Preset::fast, side, side);
    settings.general.seed = settings.caustics.seed = seed;
    settings.general.threads = settings.caustics.threads = threads;
    return settings;
}

/// Indirect light alone, from maps that are there.
Image gathered_light(const Box& room, const Maps& maps,
                     const PhotonMappingSettings& settings,
                     const RenderSettings& picture) {
    const auto mapper =
        make_photon_mapper<StratifiedStream>(room.scene, maps, settings);
    auto image =
        render(
            GatheredOnly<PhotonMapper<decltype(room.scene), StratifiedStream>>{mapper},
            room.camera, picture)
            .image;
    examples::stop_if_asked();
    return image;
}

void pictures(const examples::Options& options) {
    const Box room = cornell_box();
    auto settings = fast(options.width, options.seed, options.threads);
    settings.gather.rays = 100; // as many for both, so that both can be looked at
    const RenderSettings picture{.width = options.width,
                                 .height = options.height,
                                 .samples = 4,
                                 .seed = options.seed,
                                 .threads = options.threads};
    auto maps = make_photon_maps(room.scene, settings);
    save_png(gathered_light(room, maps, settings, picture),
             options.path("irradiance_cache-everywhere.png"),
             {.exposure = 2}); // no cache yet
    add_irradiance_cache(maps, room.scene, room.camera, picture, settings);
    save_png(gathered_light(room, maps, settings, picture),
             options.path("irradiance_cache-interpolated.png"), {.exposure = 2});

    // The points as dots: as photons that have come to them from the side that is seen.
    std::vector<Photon> dots;
    for (std::size_t i = 0; i < maps.cache.records.size(); ++i)
        dots.push_back({.position = maps.cache.tree.point(i),
                        .direction = -maps.cache.records[i].normal,
                        .flux = maps.cache.records[i].irradiance});
    Image drawing =
        scene_drawing(room.scene, room.camera, options.width, options.height);
    const auto seen = add_photon_dots(
        drawing, room.scene, room.camera, dots,
        {.radius = std::max(0.8f, float(options.width) / 250), .brightness = 1},
        [](const Photon& dot) { return dot_color(dot); });
    save_png(drawing, options.path("irradiance_cache-points.png"));
    show(options, {.name = "irradiance_cache-points-table",
                   .columns = {"pixels", "points", "of which in sight", "gather rays"},
                   .rows = {{std::to_string(options.width) + " x " +
                                 std::to_string(options.height),
                             std::to_string(dots.size()), std::to_string(seen),
                             std::to_string(maps.cache.counts.bounce_rays)}}});
}

// --- Each knob -----------------------------------------------------------------------

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

/// A picture that is believed, by eight independent pieces, and its own noise.
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

/// Indirect light alone, one knob after the other.
void knobs(const examples::Options& options, const Sizes& sizes) {
    const Box room = cornell_box();
    const int side = sizes.side;
    const auto picture = [&](int samples, std::uint64_t seed) {
        return RenderSettings{.width = side,
                              .height = side,
                              .samples = samples,
                              .seed = seed,
                              .threads = options.threads};
    };
    const auto settings = fast(side, options.seed, options.threads);
    auto maps = make_photon_maps(room.scene, settings); // the same for all
    auto one_by_one = settings;
    one_by_one.indirect = IndirectLight::gather;
    const auto twin = oracle_of(
        [&](int rays, std::uint64_t seed) {
            return gathered_light(room, maps, one_by_one, picture(rays, seed));
        },
        4 * sizes.truth, side);
    const auto tracer = make_path_tracer(room.scene);
    const auto indirect = only_paths(tracer, "E.*D.*D.*L");
    const auto traced = oracle_of(
        [&](int rays, std::uint64_t seed) {
            auto image = render(indirect, room.camera, picture(rays, seed)).image;
            examples::stop_if_asked();
            return image;
        },
        sizes.truth, side);

    examples::Table table{.name = "irradiance_cache-knobs",
                          .columns = {"", "processor s", "points",
                                      "bias² of "
                                      "interpolating",
                                      "noise", "bias² with the photons'", "blocks",
                                      "mean", "FLIP"}};
    examples::Plot plot{
        .name = "irradiance_cache-knobs-plot",
        .columns = {"processor seconds", "tile", "gather rays", "nearest", "reach"},
        .y_label = "relMSE of indirect light",
        .log_x = true,
        .log_y = true,
        .more = "set format x '%g'\n"};
    const auto measure = [&](const std::string& name, const GatherSettings& gather,
                             std::size_t knob, bool interpolated) {
        auto now = settings;
        now.gather = gather;
        std::vector<Image> runs;
        double seconds = 0, seen = 0, mean = 0;
        std::size_t points = 0;
        for (int seed = 1; seed <= sizes.seeds; ++seed) {
            const auto number = static_cast<std::uint64_t>(seed);
            const double start = examples::processor_seconds();
            maps.cache = {};
            if (interpolated)
                maps.cache =
                    make_irradiance_cache(room.scene, maps.irradiance, room.camera,
                                          picture(9, number), gather);
            points = maps.cache.records.size();
            runs.push_back(gathered_light(room, maps, now, picture(9, number)));
            seconds += (examples::processor_seconds() - start) / sizes.seeds;
            seen += flip(runs.back(), traced.truth) / sizes.seeds;
            mean += mean_error(runs.back(), traced.truth) / sizes.seeds;
        }
        const auto split = examples::relative_split(runs, twin.truth, twin.noise);
        const auto whole = examples::relative_split(runs, traced.truth, traced.noise);
        const auto blocks =
            examples::relative_split(runs, traced.truth, traced.block_noise, 10);
        table.rows.push_back({name, text(seconds, "%.3f"), std::to_string(points),
                              text(split.bias_squared, "%.2g"),
                              text(split.variance, "%.2g"),
                              text(whole.bias_squared, "%.2g"),
                              text(blocks.bias_squared + blocks.variance, "%.2g"),
                              text(100 * mean, "%+.2f %%"), text(seen, "%.3f")});
        if (knob == 0) return;
        examples::Row row(5, nothing);
        row[0] = seconds;
        row[knob] = std::max(split.bias_squared + split.variance, 1e-9);
        plot.rows.push_back(row);
    };
    const GatherSettings usual;
    measure("tile 3, 25 rays, 6 nearest, reach 1", usual, 0, true);
    for (const int tile : {2, 3, 4, 6}) {
        auto gather = usual;
        gather.tile = tile;
        measure("tile " + std::to_string(tile), gather, 1, true);
    }
    for (const int rays : {9, 16, 25, 49, 100}) {
        auto gather = usual;
        gather.rays = rays;
        measure(std::to_string(rays) + " gather rays", gather, 2, true);
    }
    for (const std::size_t nearest : {3u, 6u, 10u, 20u}) {
        auto gather = usual;
        gather.nearest = nearest;
        measure(std::to_string(nearest) + " nearest", gather, 3, true);
    }
    for (const float reach : {0.3f, 0.5f, 1.0f, 2.0f, 4.0f}) {
        auto gather = usual;
        gather.reach = reach;
        measure("reach " + text(double(reach), "%.1f"), gather, 4, true);
    }
    measure("25 rays at every vertex, no cache", usual, 0, false);
    maps.cache = {};
    show(options, table);
    save_plot(options.out, plot);
    show(options, {.name = "irradiance_cache-truth",
                   .columns = {"reference", "rays a pixel", "its own relMSE"},
                   .rows = {{"gathered at every vertex, the same photons",
                             std::to_string(twin.rays), text(twin.noise, "%.2g")},
                            {"path tracing", std::to_string(traced.rays),
                             text(traced.noise, "%.2g")}}});
}

// --- Whole pictures ------------------------------------------------------------------

/// A way to make a whole picture: rays a pixel and a seed for all.
struct Method {
    std::string name;
    std::function<Image(int, std::uint64_t)> shoot;
};

/// What a method brought, over several seeds.
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
    // [by_photons]
    auto maps = make_photon_maps(room.scene, settings);
    add_irradiance_cache(maps, room.scene, room.camera, picture, settings);
    const auto mapper = make_photon_mapper<Draws>(room.scene, maps, settings);
    if (more == 0) return render(mapper, room.camera, picture).image;
    RenderSettings most = picture;
    most.samples += more;
    return render_adaptive(mapper, room.camera, most,
                           {.first = picture.samples,
                            .more = more,
                            .batches = 1,
                            .disagreement = PresetRays{}.disagreement})
        .image;
    // [by_photons]
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
    const auto tracer = make_path_tracer(room.scene);
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
                          .columns = {"indirect light by", "rays a pixel",
                                      "processor s", "bias²", "noise", "blocks: bias²",
                                      "noise", "mean", "FLIP"}};
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
    show(options, table);
}

/// From the report's photon mapper to the preset `fast`, one idea after the other.
void ladder(const examples::Options& options, const Sizes& sizes,
            const examples::Oracle& oracle) {
    const Box room = cornell_box();
    const int side = sizes.side;
    struct Rung {
        const char* idea;
        int shadow_rays;
        DirectLight direct;
        IndirectLight indirect;
        bool stratified;
        int more;
    };
    using enum DirectLight;
    constexpr std::array rungs{
        Rung{"the report's: one shadow ray", 1, sampled, IndirectLight::rays, false, 0},
        Rung{"+ four shadow rays, stratified", 4, sampled, IndirectLight::rays, false,
             0},
        Rung{"+ a stratified stream", 4, sampled, IndirectLight::rays, true, 0},
        Rung{"+ lamps in closed form", 4, analytic, IndirectLight::rays, true, 0},
        Rung{"+ the cache for indirect rays", 4, analytic, IndirectLight::cache, true,
             0},
        Rung{"+ 8 rays more where 2 disagree", 4, analytic, IndirectLight::cache, true,
             8}};
    examples::Table table{.name = "irradiance_cache-ladder",
                          .columns = {"", "processor s", "relMSE", "trimmed",
                                      "of blocks", "mean", "FLIP"}};
    for (const Rung& rung : rungs) {
        const Method method{
            rung.idea, [&](int rays, std::uint64_t seed) {
                auto settings = fast(side, seed, options.threads);
                settings.shadow_rays = rung.shadow_rays;
                settings.direct = rung.direct;
                settings.indirect = rung.indirect;
                const RenderSettings picture{.width = side,
                                             .height = side,
                                             .samples = rays,
                                             .seed = seed,
                                             .threads = options.threads};
                return rung.stratified ? by_photons<StratifiedStream>(
                                             room, settings, picture, rung.more)
                                       : by_photons<RandomStream>(room, settings,
                                                                  picture, rung.more);
            }};
        const Result r = try_method(method, 2, oracle, sizes.seeds);
        table.rows.push_back({rung.idea, text(r.seconds, "%.3f"),
                              text(r.error(), "%.2g"), text(r.trimmed, "%.2g"),
                              text(r.block_error(), "%.2g"),
                              text(100 * r.mean, "%+.2f %%"), text(r.flip, "%.3f")});
    }
    show(options, table);

    // What "three seconds" looks like.
    const double start = examples::processor_seconds();
    const auto settings = fast(options.width, options.seed, options.threads);
    const Image image = by_photons<StratifiedStream>(room, settings,
                                                     {.width = options.width,
                                                      .height = options.height,
                                                      .samples = 2,
                                                      .seed = options.seed,
                                                      .threads = options.threads},
                                                     8);
    show(options, {.name = "irradiance_cache-fast-table",
                   .columns = {"pixels", "processor seconds of both passes"},
                   .rows = {{std::to_string(options.width) + " x " +
                                 std::to_string(options.height),
                             text(examples::processor_seconds() - start, "%.2f")}}});
    save_png(image, options.path("irradiance_cache-fast.png"));
}

// --- The closed form in a penumbra ---------------------------------------------------

using Stage = Scene<Shapes<Quad>, Materials<Lambertian>>;

/// A square lamp over a floor.
struct Lamp {
    const char* name;
    float side, height;
};
constexpr std::array lamps{Lamp{"side 2, 1 above the floor", 2, 1},
                           Lamp{"that of the box: side 0.5, 2 above", 0.5f, 2}};

/// A floor, a lamp, and halfway between them half a ceiling whose edge is over x = 0.
Stage penumbra_stage(const Lamp& lamp) {
    Stage stage;
    const auto white = stage.add(Lambertian{.albedo = Rgb{1}});
    const auto black = stage.add(Lambertian{.albedo = Rgb{0}});
    const float h = lamp.height, s = lamp.side;
    stage.add(Quad{.corner{-4, 0, -4}, .edge_u{0, 0, 8}, .edge_v{8, 0, 0}}, white);
    stage.add(Quad{.corner{-8, h / 2, -8}, .edge_u{8, 0, 0}, .edge_v{0, 0, 16}}, black);
    stage.add(Quad{.corner{-s / 2, h, -s / 2}, .edge_u{s, 0, 0}, .edge_v{0, 0, s}},
              black, Rgb{1});
    return stage;
}

constexpr std::array shadow_rays{1, 2, 4, 9};

/// What the closed form with its shadow rays brings at one place, in parts of the whole
/// lamp's light; one number for each number of shadow rays.
struct InPenumbra {
    double x = 0; ///< Of the place; the penumbra is -1 to 1.
    std::array<double, shadow_rays.size()> bias{}, noise{}, sampled{};
};

InPenumbra measure_penumbra(const Stage& stage, const Lamp& lamp, double place,
                            std::uint64_t number, long long trials,
                            std::uint64_t seed) {
    InPenumbra here{.x = place};
    const float h = lamp.height, s = lamp.side, x = float(place) * s / 2;
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
    for (std::size_t k = 0; k < shadow_rays.size(); ++k)
        for (const DirectLight how : {DirectLight::analytic, DirectLight::sampled}) {
            double sum = 0, squares = 0;
            for (long long t = 0; t < trials; ++t) {
                auto stream =
                    random_stream(seed, Pass::gathering, 1 + k,
                                  number * std::uint64_t(trials) + std::uint64_t(t));
                Counts counts;
                const double value =
                    double(detail::sample_all_lights(stage, vertex, white, how,
                                                     shadow_rays[k], stream, counts)
                               .x) /
                    whole;
                sum += value / double(trials);
                squares += value * value / double(trials);
            }
            const double spread = std::sqrt(std::max(0.0, squares - sum * sum));
            if (how == DirectLight::analytic) {
                here.bias[k] = sum - exact / whole;
                here.noise[k] = spread;
            } else {
                here.sampled[k] = spread;
            }
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
    examples::Table table{.name = "irradiance_cache-penumbra-table",
                          .columns = {"lamp", "shadow rays", "largest bias",
                                      "its standard error", "noise, closed form",
                                      "noise, sampled", "in full light: closed form",
                                      "sampled"}};
    const auto percent = [](double share) { return text(100 * share, "%.2f %%"); };
    for (const Lamp& lamp : lamps) {
        const Stage stage = penumbra_stage(lamp);
        std::vector<InPenumbra> found(static_cast<std::size_t>(places));
        const auto at_place = [&](long long i) {
            found[static_cast<std::size_t>(i)] = measure_penumbra(
                stage, lamp, 1.2 * (2 * (double(i) + 0.5) / places - 1),
                static_cast<std::uint64_t>(i), trials, options.seed);
        };
        (void)parallel_blocks(places, at_place, {.threads = options.threads});
        examples::stop_if_asked();
        if (plot.rows.empty())
            for (const InPenumbra& f : found) {
                plot.rows.push_back({f.x});
                for (const double b : f.bias) plot.rows.back().push_back(100 * b);
            }
        for (std::size_t k = 0; k < shadow_rays.size(); ++k) {
            double largest = 0, its = 0, noise = 0, sampled = 0;
            for (const InPenumbra& f : found) {
                if (std::abs(f.bias[k]) > std::abs(largest)) {
                    largest = f.bias[k];
                    its = f.noise[k] / std::sqrt(double(trials));
                }
                noise = std::max(noise, f.noise[k]);
                sampled = std::max(sampled, f.sampled[k]);
            }
            table.rows.push_back({lamp.name, std::to_string(shadow_rays[k]),
                                  percent(largest), percent(its), percent(noise),
                                  percent(sampled), percent(found.back().noise[k]),
                                  percent(found.back().sampled[k])});
        }
    }
    save_plot(options.out, plot);
    show(options, table);
}

} // namespace

/// Makes the figures of chapter 29.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; 2 with one sentence for anything that is wrong.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 29, the irradiance cache: points, knobs, trades.");
        line.add("--seeds", sizes.seeds, "Runs behind each error", 2, 1000);
        line.add("--truth", sizes.truth, "Rays a pixel of the references", 8,
                 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 96, .height = 96, .samples = 4},
                        .report{.width = 400, .height = 400, .samples = 4},
                        .reference{.width = 400, .height = 400, .samples = 4}});
        if (!line.given("--seeds")) sizes.seeds = options.pick(4, 16, 64);
        if (!line.given("--truth")) sizes.truth = options.pick(256, 1024, 16384);
        sizes.side = std::min(options.pick(40, 120, 200), options.width);
        draw_idea(options);
        corner(options);
        penumbra(options);
        pictures(options);
        knobs(options, sizes);
        const auto oracle = examples::find_oracle("cornell", cornell_box(), sizes.side,
                                                  2 * sizes.truth, options);
        methods(options, sizes, oracle);
        ladder(options, sizes, oracle);
    });
}
