// smoke: --quality draft --width 24 --height 24 --passes 8 --seeds 2
/// \file chapters/experiments/32_experiments.cpp
/// \brief Chapter 32: the experiments behind its tables and plots: laws, and one map
/// beside many.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/ljus.hpp>
#include <ljus/render/progressive.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/convergence.hpp"
#include "common/drawing.hpp"
#include "common/example.hpp"
#include "experiments/window.hpp"

using namespace ljus;

namespace {

/// The options of this program, besides the common ones.
struct Sizes {
    long long passes = 0; ///< How many.
    int seeds = 0;        ///< Runs behind each bias and variance.
};

// --- The laws, where light is known --------------------------------------------------

using examples::Strip;
using Stage =
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Mirror>, Lights<PointLight>>;

constexpr std::array strips{examples::middle, examples::edge};
constexpr int places = 48;

Vec3 place(const Strip& strip, int i) {
    return {float(strip.at(i, places)), 0, 0.5f * std::sin(2.4f * float(i))};
}

/// A picture one row high: the estimates at the points, relative to the light
/// in the middle.
Image read_strip(const PhotonMap& map, const Strip& strip, double radius) {
    Image row = make_image(places, 1);
    const Lambertian white{.albedo = Rgb{1}};
    for (int i = 0; i < places; ++i) {
        VertexT<float> floor{.point{.position = place(strip, i), .normal{0, 1, 0}}};
        floor.frame = frame_around(floor.point.normal);
        std::uint64_t gathered = 0;
        pixel(row, i, 0) =
            4 * std::numbers::pi_v<float> *
            estimate_radiance(map, floor, white, Vec3{0, 0, 1},
                              DensityEstimateSettings{.radius = float(radius)},
                              all_kinds, gathered);
    }
    return row;
}

/// The same, exactly.
Image exact_strip(const Strip& strip) {
    Image row = make_image(places, 1);
    for (int i = 0; i < places; ++i) {
        const Vec3 at = place(strip, i);
        pixel(row, i, 0) =
            Rgb{float(4 * examples::window_light(double(at.x), double(at.z)))};
    }
    return row;
}

PhotonMap window_map(const World<Stage>& stage, long long photons, std::uint64_t seed,
                     long long pass) {
    return make_photon_map(trace_photons(stage, MapType::caustics,
                                         {.photons = photons,
                                          .seed = seed,
                                          .iteration = std::uint64_t(pass),
                                          .threads = 1})
                               .photons);
}

/// One way to shrink at one strip, and the pictures of each seed after some passes.
struct Series {
    Strip strip;
    double alpha = 0;
    double radius = 0;                           ///< Of the first pass.
    std::vector<std::vector<Image>> images = {}; ///< [which passes][seed].
    std::vector<double> estimates = {}; ///< Mean square of the estimated errors.
};

/// Numbers of passes that are measured: 1, 2, 3, 6, 10, 18, 32, ...
std::vector<long long> milestones(long long passes) {
    std::vector<long long> list;
    for (int i = 0;; ++i) {
        const long long n = std::llround(std::pow(10.0, i / 4.0));
        if (n >= passes) break;
        if (list.empty() || n > list.back()) list.push_back(n);
    }
    list.push_back(passes);
    return list;
}

/// Runs all series on the same photons, seed by seed.
void run_series(std::vector<Series>& all, long long photons,
                const std::vector<long long>& stops, int seeds) {
    const World stage(examples::window_scene<Stage>());
    for (Series& series : all) {
        series.images.assign(stops.size(), {});
        series.estimates.assign(stops.size(), 0);
    }
    for (int seed = 1; seed <= seeds; ++seed) {
        std::vector<ProgressiveState> states;
        for (const Series& series : all) states.push_back({.alpha = series.alpha});
        std::size_t stop = 0;
        for (long long pass = 1; pass <= stops.back(); ++pass) {
            const PhotonMap map = window_map(stage, photons, std::uint64_t(seed), pass);
            for (std::size_t i = 0; i < all.size(); ++i)
                add_pass(states[i],
                         read_strip(map, all[i].strip,
                                    all[i].radius * std::sqrt(states[i].shrink)));
            if (pass != stops[stop]) continue;
            for (std::size_t i = 0; i < all.size(); ++i) {
                all[i].images[stop].push_back(mean_image(states[i]));
                const double error = estimate_error(states[i]).pixels;
                all[i].estimates[stop] += error * error / seeds;
            }
            ++stop;
            examples::stop_if_asked();
        }
    }
}

/// Bias and variance of a series after each number of passes.
std::vector<BiasVariance> split_of(const Series& series) {
    std::vector<BiasVariance> split;
    for (const auto& runs : series.images)
        split.push_back(bias_variance(runs, exact_strip(series.strip)));
    return split;
}

/// Bias and variance against the passes, for alpha = 2/3: in the middle of the light,
/// with the variance as the passes estimate it, and across its edge.
void plot_laws(const Series& middle, const Series& edge,
               const std::vector<long long>& stops, const examples::Options& options) {
    examples::Plot plot{.name = "progressive-laws",
                        .columns = {"passes", "variance in the middle",
                                    "squared bias in the middle", "estimated variance",
                                    "squared bias across the edge", "n^(-2/3)"},
                        .y_label = "mean square over the places",
                        .log_x = true,
                        .log_y = true};
    const auto inside = split_of(middle), across = split_of(edge);
    const double last = inside.back().variance;
    for (std::size_t i = 0; i < stops.size(); ++i)
        plot.rows.push_back(
            {double(stops[i]), inside[i].variance, inside[i].bias_squared,
             stops[i] > 1 ? middle.estimates[i] : std::nan(""), across[i].bias_squared,
             2 * last * std::pow(double(stops[i]) / double(stops.back()), -2.0 / 3)});
    save_plot(options.out, plot);
}

/// Bias and variance, and the estimated error beside the true one.
void laws(const examples::Options& options, const Sizes& sizes) {
    constexpr long long photons = 500;
    const auto stops =
        milestones(options.pick(sizes.passes / 5 + 1, sizes.passes, sizes.passes));
    std::vector<Series> all;
    for (const Strip& strip : strips)
        all.push_back({strip, 2.0 / 3, strip.first < 0 ? 1.2 : 0.6});
    run_series(all, photons, stops, 4 * sizes.seeds);
    plot_laws(all[0], all[1], stops, options);
}

/// Squared bias and variance of some runs together.
double error_of(const std::vector<Image>& runs, const Strip& strip) {
    const auto split = bias_variance(runs, exact_strip(strip));
    return split.bias_squared + split.variance;
}

/// The best of several radii, and the mean squared error with it.
struct BestRadius {
    double radius = 0;
    double error = std::numeric_limits<double>::infinity();

    void consider(double other, double its_error) {
        if (its_error < error) radius = other, error = its_error;
    }
};

constexpr std::array radius_steps{-4, -3, -2, -1, 0, 1, 2, 3, 4}; ///< Quarter octaves.

/// All photons in one map, with each of several radii.
BestRadius best_map(const Strip& strip, long long photons, int seeds) {
    const World stage(examples::window_scene<Stage>());
    std::array<std::vector<Image>, radius_steps.size()> runs;
    std::array<double, radius_steps.size()> radii{};
    for (std::size_t i = 0; i < radii.size(); ++i)
        radii[i] = (strip.first < 0 ? 2.4 * std::pow(double(photons), -1.0 / 6)
                                    : 4.0 * std::pow(double(photons), -1.0 / 3)) *
                   std::exp2(radius_steps[i] / 4.0);
    for (int seed = 1; seed <= seeds; ++seed) {
        const PhotonMap map = window_map(stage, photons, 5000 + std::uint64_t(seed), 0);
        for (std::size_t i = 0; i < radii.size(); ++i)
            runs[i].push_back(read_strip(map, strip, radii[i]));
        examples::stop_if_asked();
    }
    BestRadius best;
    for (std::size_t i = 0; i < radii.size(); ++i)
        best.consider(radii[i], error_of(runs[i], strip));
    return best;
}

/// The best first radius of the passes at a strip.
/// \param stop  Which of the numbers of passes.
BestRadius best_passes(const std::vector<Series>& all, const Strip& strip,
                       std::size_t stop) {
    BestRadius best;
    for (const Series& series : all)
        if (series.strip.first == strip.first)
            best.consider(series.radius, error_of(series.images[stop], strip));
    return best;
}

/// Passes at each strip, with several first radii.
std::vector<Series> series_of_radii() {
    std::vector<Series> all;
    for (const Strip& strip : strips)
        for (const int step : radius_steps)
            all.push_back({strip, strip.first < 0 ? 2.0 / 3 : 1.0 / 3,
                           (strip.first < 0 ? 0.9 : 0.7) * std::exp2(step / 4.0)});
    return all;
}

/// The same photons in one map, with the best radius that one map can have, and in
/// passes, with the best first radius.
void one_map(const examples::Options& options, const Sizes& sizes) {
    constexpr long long photons = 500;
    const int seeds = std::max(2, sizes.seeds / 2);
    std::vector<long long> stops;
    for (long long n = 10;
         n <= options.pick(sizes.passes / 5, sizes.passes, sizes.passes); n *= 10)
        stops.push_back(n);
    if (stops.empty()) stops.push_back(sizes.passes);
    examples::Table table{.name = "progressive-one-map",
                          .columns = {"where", "photons", "one map: best radius",
                                      "squared error", "passes of 500", "squared error",
                                      "ratio"}};
    std::vector<Series> all = series_of_radii();
    run_series(all, photons, stops, seeds);
    for (const Strip& strip : strips)
        for (std::size_t s = 0; s < stops.size(); ++s) {
            const long long count = stops[s] * photons;
            const BestRadius map = best_map(strip, count, seeds);
            const BestRadius passes = best_passes(all, strip, s);
            table.rows.push_back({strip.name, std::to_string(count),
                                  examples::text(map.radius, "%.2f"),
                                  examples::text(map.error, "%.3g"),
                                  std::to_string(stops[s]) +
                                      ", r = " + examples::text(passes.radius, "%.2f"),
                                  examples::text(passes.error, "%.3g"),
                                  examples::text(passes.error / map.error, "%.2f")});
            if (!options.quiet)
                std::printf(
                    "%s, %lld photons: one map %.3g (r %.2f), passes %.3g (r %.2f)\n",
                    strip.name, count, map.error, map.radius, passes.error,
                    passes.radius);
        }
    save_table(options.out, table);
}

/// Three passes at a point near the edge of the light: photons of their own, and discs
/// that shrink.
void draw_discs(const examples::Options& options) {
    const World stage(examples::window_scene<Stage>());
    examples::Drawing figure{.name = "progressive-discs",
                             .description = "Three passes: each has photons of its own "
                                            "and a smaller disc than the one before",
                             .low{-0.1, -0.35},
                             .high{6.5, 2.1},
                             .scale = 108};
    double shrink = 1;
    int panel = 0;
    constexpr std::array colors{examples::colors::blue, examples::colors::orange,
                                examples::colors::green};
    for (long long pass = 1; pass <= 100; ++pass) {
        if (pass == 1 || pass == 10 || pass == 100) {
            const double left = 2.2 * panel;
            const char* const color = colors[std::size_t(panel)];
            draw_line(figure,
                      {{left, 0}, {left + 2, 0}, {left + 2, 2}, {left, 2}, {left, 0}},
                      {"currentColor", 1});
            const auto traced = trace_photons(stage, MapType::caustics,
                                              {.photons = 4000,
                                               .seed = options.seed,
                                               .iteration = std::uint64_t(pass)});
            for (const Photon& photon : traced.photons) { // x from 0.6 to 2.6
                const double x = double(photon.position.x) - 0.6;
                const double y = double(photon.position.z) + 1;
                if (x > 0.02 && x < 1.98 && y > 0.02 && y < 1.98)
                    draw_dot(figure, {left + x, y}, 1.7, color);
            }
            draw_arc(figure, {left + 1, 1}, 0.7 * std::sqrt(shrink), 0,
                     2 * std::numbers::pi, {"currentColor", 2});
            draw_label(figure, {left + 1, -0.2},
                       "pass " + std::to_string(pass) +
                           ", r = " + examples::text(0.7 * std::sqrt(shrink), "%.2f"));
            ++panel;
        }
        shrink *= (double(pass) + 2.0 / 3) / (double(pass) + 1);
    }
    save_drawing(options.out, figure);
}

// --- The picture ---------------------------------------------------------------------

/// The Cornell box.
using Box = decltype(cornell_box());

/// How the box is rendered in one pass.
PhotonMappingSettings pass_settings(const examples::Options& options,
                                    std::uint64_t seed) {
    PhotonMappingSettings settings{.split_glass = true,
                                   .indirect = IndirectLight::photons};
    settings.caustics = {.photons = 1000, .seed = seed, .threads = options.threads};
    settings.general = {.photons = 5000,
                        .seed = seed,
                        .shadow_photons = false,
                        .threads = options.threads};
    settings.caustics_estimate.radius = 0.12f;
    settings.general_estimate.radius = 0.3f;
    return settings;
}

RenderSettings frame_of(const examples::Options& options, int samples,
                        std::uint64_t seed) {
    return {.width = options.width,
            .height = options.height,
            .samples = samples,
            .seed = seed,
            .threads = options.threads};
}

/// The reference of the box, by many paths.
struct Reference {
    Image image = {}; ///< The mean of two halves.
    double noise = 0; ///< Its variance, as the relMSE that it makes.
};

/// Two halves: their difference gives their own noise.
Reference reference_of(const Box& box, const examples::Options& options) {
    const PathTracer tracer(box.world);
    const int rays = options.pick(256, 4096, 65536);
    std::array<Image, 2> halves;
    for (const std::size_t i : {0u, 1u}) {
        examples::ProgressBar bar("reference", options.quiet);
        auto picture = frame_of(options, rays, 77 + i);
        picture.progress = bar;
        halves[i] = render(tracer, box.camera, picture).image;
        examples::stop_if_asked();
    }
    Reference truth{.image = halves[0]};
    for (std::size_t p = 0; p < truth.image.pixels.size(); ++p)
        truth.image.pixels[p] = 0.5f * (halves[0].pixels[p] + halves[1].pixels[p]);
    for (std::size_t p = 0; p < truth.image.pixels.size(); ++p) {
        const RgbT<double> d = 0.5 * (RgbT<double>(halves[0].pixels[p]) -
                                      RgbT<double>(halves[1].pixels[p]));
        const RgbT<double> r(truth.image.pixels[p]);
        const RgbT<double> e = d * d / (r * r + default_epsilon);
        truth.noise += (e.x + e.y + e.z) / 3 / double(truth.image.pixels.size());
    }
    return truth;
}

/// The box after some passes.
struct Milestone {
    long long passes = 0;
    double error = 0;  ///< relMSE.
    double faster = 0; ///< The same with the exponent that suits edges.
};

/// Runs passes up to the last milestone, and calls at(milestone, state) at each.
template <typename Pass, typename At>
void run_to(std::vector<Milestone>& milestones, ProgressiveState state, Pass pass,
            examples::ProgressBar bar, At at) {
    for (Milestone& milestone : milestones) {
        (void)run_progressive(state, milestone.passes, pass, [&](const auto& now) {
            return bar(now.passes, milestones.back().passes);
        });
        examples::stop_if_asked();
        at(milestone, state);
    }
}

/// Passes of the box with two exponents: their errors at the milestones.
void run_passes(std::vector<Milestone>& milestones, const Box& box,
                const examples::Options& options, const Reference& truth) {
    const auto pass = [&](long long i, double scale) {
        return photon_mapping_pass(box.world, box.camera,
                                   pass_settings(options, options.seed),
                                   frame_of(options, 1, options.seed), i, scale);
    };
    const auto error = [&](const ProgressiveState& state) {
        return rel_mse(mean_image(state), truth.image) - truth.noise;
    };
    run_to(milestones, {.alpha = 2.0 / 3}, pass,
           examples::ProgressBar("alpha 2/3", options.quiet),
           [&](Milestone& at, const ProgressiveState& now) { at.error = error(now); });
    run_to(milestones, {.alpha = 1.0 / 3}, pass,
           examples::ProgressBar("alpha 1/3", options.quiet),
           [&](Milestone& at, const ProgressiveState& now) { at.faster = error(now); });
}

/// The error of the box against the number of passes.
void save_errors(const std::vector<Milestone>& milestones,
                 const examples::Options& options) {
    examples::Plot plot{
        .name = "progressive-picture",
        .columns = {"passes", "alpha = 2/3", "alpha = 1/3", "n^(-2/3)", "n^(-1/3)"},
        .y_label = "relMSE of the box",
        .log_x = true,
        .log_y = true};
    const double first = milestones.front().error;
    for (const Milestone& at : milestones) {
        const auto n = double(at.passes);
        plot.rows.push_back({n, at.error, at.faster, first * std::pow(n, -2.0 / 3),
                             first * std::pow(n, -1.0 / 3)});
    }
    save_plot(options.out, plot);
}

/// The box after more and more passes.
void pictures(const examples::Options& options, const Sizes& sizes) {
    const Box box = cornell_box();
    const Reference truth = reference_of(box, options);
    std::vector<Milestone> all;
    for (const long long passes : milestones(sizes.passes)) all.push_back({passes});
    run_passes(all, box, options, truth);
    save_errors(all, options);
}

} // namespace

/// Makes the plots and the table of chapter 32.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 32, progressive photons: laws and pictures.");
        line.add("--seeds", sizes.seeds, "Runs behind bias and variance", 2, 1000);
        line.add("--passes", sizes.passes, "How many photon maps", 1, 1'000'000'000);
        const examples::Options options =
            line.parse({.draft{.width = 32, .height = 32, .samples = 1},
                        .report{.width = 64, .height = 64, .samples = 1},
                        .reference{.width = 128, .height = 128, .samples = 1}});
        if (!line.given("--passes")) sizes.passes = options.pick(100, 1000, 10000);
        if (!line.given("--seeds")) sizes.seeds = options.pick(4, 16, 64);
        draw_discs(options);
        laws(options, sizes);
        one_map(options, sizes);
        pictures(options, sizes);
    });
}
