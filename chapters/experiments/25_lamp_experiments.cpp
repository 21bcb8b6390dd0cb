// smoke: --quality draft
/// \file chapters/experiments/25_lamp_experiments.cpp
/// \brief Chapter 25: the error of density estimates by radius and number of photons,
/// where light is smooth: under a square lamp.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "experiments/white_floor.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/photons/density_estimate.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/scene/world.hpp"

using namespace ljus;

namespace {

using Point = glm::dvec3;
using Boxes = Scene<Shapes<Quad>, Materials<Lambertian>>;

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

/// Estimates of one number of photons: [radius][seed][place], relative to the
/// reference.
using Estimates = std::vector<std::vector<std::vector<double>>>;

/// Variance and squared bias of a radius, over all seeds.
struct Parts {
    double variance = 0, bias2 = 0;
};
Parts parts_of(const std::vector<std::vector<double>>& seeds) {
    Parts parts;
    const std::size_t places = seeds.front().size();
    for (std::size_t place = 0; place < places; ++place) {
        double count = 0, mean = 0, squares = 0;
        for (std::size_t seed = 0; seed < seeds.size(); ++seed) {
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

/// A lamp over a floor, its light estimated with many radii in maps of many sizes.
struct Experiment {
    std::vector<double> numbers;  ///< Photons emitted.
    std::vector<double> radii;    ///< Of the estimates.
    std::vector<Estimates> found; ///< [number][radius], over the true irradiance.
    /// The mean square error of all runs.
    double error2(std::size_t number, std::size_t radius) const {
        const Parts parts = parts_of(found[number][radius]);
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

/// Adds the estimates of one map at all points.
void add_map(const PhotonMap& map, const Quad& lamp, const std::vector<double>& radii,
             Estimates& estimates) {
    std::vector<Point> places;
    for (int i = 0; i < 49; ++i)
        places.push_back({0.2 * (i % 7) - 0.6, 0, 0.2 * (i / 7) - 0.6});
    for (std::size_t r = 0; r < radii.size(); ++r) {
        std::vector<double> row;
        for (const Point& place : places)
            row.push_back(irradiance(map, place, radii[r]) /
                          irradiance_from(lamp, place));
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
        for (int seed = 0; seed < seeds; ++seed) {
            const auto traced =
                trace_photons(world, MapType::general,
                              {.photons = static_cast<long long>(number),
                               .seed = options.seed + static_cast<std::uint64_t>(seed),
                               .shadow_photons = false,
                               .threads = options.threads});
            add_map(make_photon_map(traced.photons, options.threads), lamp, all.radii,
                    estimates);
        }
        all.found.push_back(estimates);
    }
    return all;
}

/// The error against the radius, for every other number of photons.
void save_by_radius(const Experiment& all, const examples::Options& options) {
    examples::Plot plot{.name = "density-lamp-radius",
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

/// The error at the best radius, against the number of photons.
void save_by_number(const Experiment& all, const examples::Options& options) {
    examples::Plot plot{.name = "density-lamp-best",
                        .columns = {"photons emitted", "at the best radius", "N^(-2/3)",
                                    "r = 0.1", "r = 0.4"},
                        .y_label = "mean square error of the irradiance",
                        .rows = {},
                        .log_x = true,
                        .log_y = true};
    const auto& numbers = all.numbers;
    const std::size_t half = numbers.size() / 2;
    const double anchor = all.error2(half, all.best_radius(half)) *
                          std::pow(numbers[half], 2.0 / 3); // where the law meets it
    for (std::size_t n = 0; n < numbers.size(); ++n) {
        const std::size_t best = all.best_radius(n);
        plot.rows.push_back({numbers[n], all.error2(n, best),
                             anchor / std::pow(numbers[n], 2.0 / 3), all.error2(n, 3),
                             all.error2(n, 9)});
    }
    examples::save_plot(options.out, plot);
}

} // namespace

/// Makes the plots of chapter 25 for a lamp.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about(
            "Chapter 25, the density estimate: its error where light is smooth.");
        const examples::Options options = line.parse({});
        const Experiment all = run_experiment(options);
        save_by_radius(all, options);
        save_by_number(all, options);
    });
}
