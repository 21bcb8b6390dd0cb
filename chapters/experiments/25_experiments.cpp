// smoke: --quality draft --photons 300 --seeds 2
/// \file chapters/experiments/25_experiments.cpp
/// \brief Chapter 25: the error of density estimates by radius, number of photons and
/// kernel, where light has a sharp edge.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <ljus/io/png.hpp>
#include <ljus/ljus.hpp>

#include "common/command_line.hpp"
#include "common/convergence.hpp"
#include "common/plot.hpp"
#include "experiments/show_table.hpp"
#include "experiments/white_floor.hpp"
#include "experiments/window.hpp"

using namespace ljus;

namespace {

/// The options of this program, besides the common ones.
struct Sizes {
    long long photons = 20000; ///< Of the pictures.
    int seeds = 0;             ///< Maps behind each error.
};

/// A floor, and what stands above it.
using Stage = Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass, Mirror>,
                    Lights<PointLight>>;

/// The irradiance that an estimate reads on the floor.
double read(const PhotonMap& map, const Vec3& at,
            const DensityEstimateSettings& gather) {
    return examples::irradiance_read(map, at, Vec3{0, 1, 0}, gather);
}

PhotonMap map_of(const World<Stage>& stage, long long photons, std::uint64_t seed) {
    return make_photon_map(
        trace_photons(stage, MapType::caustics, {.photons = photons, .seed = seed})
            .photons);
}

constexpr std::array kernels{Kernel::box, Kernel::cone, Kernel::gaussian,
                             Kernel::epanechnikov, Kernel::biweight};
constexpr std::array kernel_names{"box", "cone", "Gaussian", "Epanechnikov",
                                  "biweight"};

/// The caustic of a glass ball by the same few photons and each kernel.
void pictures_by_kernel(const examples::Options& options, long long photons) {
    Stage stage;
    examples::add_floor(stage, -0.6f);
    stage.add(Sphere{.radius = 0.5f}, stage.add(Glass{.index = 1.5f}));
    stage.add(PointLight{.position{0, 2, 0}});
    const PhotonMap map = map_of(World(std::move(stage)), photons, options.seed);
    const int size = options.pick(160, 400, 480);
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        Image image = make_image(size, size);
        for (int i = 0; i < size; ++i)
            for (int j = 0; j < size; ++j) {
                const Vec3 at{0.4f * (float(i) + 0.5f) / float(size) - 0.2f, -0.6f,
                              0.4f * (float(j) + 0.5f) / float(size) - 0.2f};
                pixel(image, i, j) = Rgb{float(
                    0.2 * read(map, at, {.radius = 0.012f, .kernel = kernels[k]}))};
            }
        save_png(image, options.path("density-kernel-" + std::to_string(k) + ".png"));
    }
}

// --- Light with a sharp edge -----------------------------------------------------------

/// The mean squared error of several ways to gather, relative to the light at the
/// middle, over the seeds.
std::vector<double> errors(const World<Stage>& stage, long long photons, int seeds,
                           const examples::Strip& strip,
                           const std::vector<DensityEstimateSettings>& ways) {
    std::vector<double> sum(ways.size());
    constexpr int places = 100;
    for (int seed = 1; seed <= seeds; ++seed) {
        const PhotonMap map =
            map_of(stage, photons, 1000 + static_cast<std::uint64_t>(seed));
        for (int place = 0; place < places; ++place) {
            const double x = strip.at(place, places);
            const double z = 0.5 * std::sin(2.4 * place);
            const double right = examples::window_light(x, z);
            for (std::size_t i = 0; i < ways.size(); ++i) {
                const double error =
                    read(map, {float(x), 0, float(z)}, ways[i]) - right;
                sum[i] += error * error / places / seeds;
            }
        }
    }
    const double light = examples::window_light(0, 0);
    for (double& value : sum) value /= light * light;
    return sum;
}

/// Ways to gather with radii around one that grows by a third of an octave.
std::vector<DensityEstimateSettings> around(double radius,
                                            Kernel kernel = Kernel::epanechnikov) {
    std::vector<DensityEstimateSettings> ways;
    for (int i = -5; i <= 5; ++i)
        ways.push_back(
            {.radius = float(radius * std::exp2(i / 3.0)), .kernel = kernel});
    return ways;
}

/// The error against the radius, for few photons and for many.
void error_by_radius(const examples::Options& options, const Sizes& sizes) {
    const World stage(examples::window_scene<Stage>());
    examples::Plot plot{.name = "density-radius",
                        .columns = {"radius", "middle 1000", "middle 100 000",
                                    "edge 1000", "edge 100 000"},
                        .y_label = "mean squared error",
                        .log_x = true,
                        .log_y = true};
    std::vector<DensityEstimateSettings> ways;
    for (int i = 0; i <= 16; ++i)
        ways.push_back({.radius = float(0.05 * std::exp2(i / 3.0))});
    std::array<std::vector<double>, 4> found;
    for (const std::size_t i : {0u, 1u, 2u, 3u})
        found[i] = errors(stage, i % 2 == 0 ? 1000 : 100000, sizes.seeds,
                          i < 2 ? examples::middle : examples::edge, ways);
    for (std::size_t i = 0; i < ways.size(); ++i)
        plot.rows.push_back({double(ways[i].radius), found[0][i], found[1][i],
                             found[2][i], found[3][i]});
    save_plot(options.out, plot);
}

/// The error at the best radius against the number of photons, and its two laws.
void error_by_number(const examples::Options& options, const Sizes& sizes) {
    const World stage(examples::window_scene<Stage>());
    examples::Plot plot{
        .name = "density-number",
        .columns = {"photons aimed", "middle", "edge", "N^(-2/3)", "N^(-1/3)"},
        .y_label = "mean squared error at the best radius",
        .log_x = true,
        .log_y = true};
    std::vector<double> numbers, smooth, sharp;
    for (int i = 0; i <= options.pick(4, 6, 7); ++i) {
        const double count = std::round(300 * std::pow(10.0, i / 2.0));
        const auto best = [&](const examples::Strip& strip, double radius) {
            const auto all = errors(stage, static_cast<long long>(count), sizes.seeds,
                                    strip, around(radius));
            return *std::min_element(all.begin(), all.end());
        };
        numbers.push_back(count);
        smooth.push_back(best(examples::middle, 2.6 * std::pow(count, -1.0 / 6)));
        sharp.push_back(best(examples::edge, 4.0 * std::pow(count, -1.0 / 3)));
    }
    // The laws, as straight lines below the last points.
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double share = numbers[i] / numbers.back();
        plot.rows.push_back({numbers[i], smooth[i], sharp[i],
                             0.6 * smooth.back() * std::pow(share, -2.0 / 3),
                             0.6 * sharp.back() * std::pow(share, -1.0 / 3)});
    }
    save_plot(options.out, plot);

    const double in_middle = examples::fit_power(numbers, smooth).slope;
    const double at_edge = examples::fit_power(numbers, sharp).slope;
    examples::show_table(
        options, {.name = "density-slopes",
                  .columns = {"where", "law", "measured"},
                  .rows = {{"middle", "-0.67", examples::text(in_middle, "%.2f")},
                           {"edge", "-0.33", examples::text(at_edge, "%.2f")}}});
}

/// The error of each kernel, at one radius and at its best one.
void error_by_kernel(const examples::Options& options, const Sizes& sizes) {
    const World stage(examples::window_scene<Stage>());
    examples::Table table{.name = "density-kernels",
                          .columns = {"kernel", "mean of w^2", "middle, r = 0.25",
                                      "middle, best r", "edge, r = 0.25",
                                      "edge, best r"}};
    constexpr std::array squares{"1", "1.5", "1.313", "1.333", "1.8"};
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        std::vector<std::string> row{kernel_names[k], squares[k]};
        for (const examples::Strip& strip : {examples::middle, examples::edge}) {
            auto tried = around(strip.first < 0 ? 0.6 : 0.2, kernels[k]);
            tried.push_back({.radius = 0.25f, .kernel = kernels[k]});
            const auto all = errors(stage, 10000, sizes.seeds, strip, tried);
            const auto best = std::min_element(all.begin(), all.end() - 1);
            const auto radius = double(tried[std::size_t(best - all.begin())].radius);
            row.push_back(examples::text(std::sqrt(all.back()), "%.3f"));
            row.push_back(examples::text(std::sqrt(*best), "%.3f") +
                          " (r = " + examples::text(radius, "%.2f") + ")");
        }
        table.rows.push_back(row);
    }
    examples::show_table(options, table);
}

} // namespace

/// Makes the plots, tables and pictures of chapter 25 for a caustic.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 25, the density estimate: its error where light ends.");
        line.add("--photons", sizes.photons, "Photons of the pictures", 1, 100000000);
        line.add("--seeds", sizes.seeds, "Maps behind each error", 1, 1000);
        const examples::Options options = line.parse({});
        if (!line.given("--seeds")) sizes.seeds = options.pick(4, 16, 64);
        pictures_by_kernel(options, sizes.photons);
        error_by_radius(options, sizes);
        error_by_number(options, sizes);
        error_by_kernel(options, sizes);
    });
}
