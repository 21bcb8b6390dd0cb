// smoke: --quality draft
/// \file chapters/experiments/41_experiments.cpp
/// \brief Chapter 41: free flights against equi-angular sampling.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <ljus/materials/lambertian.hpp>
#include <ljus/media/fog.hpp>
#include <ljus/render/path_tracing.hpp>

#include "common/example.hpp"

namespace {

using namespace ljus;
using examples::Options;

using Yard = Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<>, Media<Fog<Sphere>>>;

constexpr int directions = 200; // of the rays, each like a pixel

/// A lamp 4 units in front of the camera, in fog that fills everything up to a black
/// wall 20 units away.
World<Yard> yard(float density, float lamp_radius) {
    Yard scene;
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    scene.add(Sphere{.center{0, 0, -120}, .radius = 100}, black);
    scene.add(Sphere{.center{0, 0, -4}, .radius = lamp_radius}, black,
              Rgb{1 / (lamp_radius * lamp_radius)});
    scene.add(Fog<Sphere>{.region{.radius = 30}, .scattering = Rgb{density}});
    return World(std::move(scene));
}

/// The sums over all directions.
struct Found {
    double mean = 0;     // of the radiance
    double variance = 0; // of one ray, mean over the directions

    [[nodiscard]] double error() const { return std::sqrt(variance) / mean; }
};

/// Light that is scattered once, found by some rays in each direction. No ray meets the
/// lamp itself.
/// \param rays  In one direction; their mean counts as one value.
/// \param runs  Such means in each direction.
Found gather(const World<Yard>& world, FogLight how, int rays, int runs) {
    const PathTracer tracer(world, {.max_depth = 1, .fog = how});
    Counts counts;
    Found found;
    for (int i = 0; i < directions; ++i) {
        const float angle = 0.3f + 0.4f * (float(i) + 0.5f) / directions;
        const Ray ray{.direction{std::sin(angle), 0, -std::cos(angle)}};
        double sum = 0, squares = 0;
        for (int run = 0; run < runs; ++run) {
            double mean = 0;
            for (int k = 0; k < rays; ++k) {
                auto stream =
                    random_stream(1, Pass::camera, std::uint64_t(run),
                                  std::uint64_t(i) * 65536 + std::uint64_t(k));
                auto context = context_of(stream, counts);
                mean += double(radiance(tracer, ray, context).x) / rays;
            }
            sum += mean;
            squares += mean * mean;
        }
        found.mean += sum / runs / directions;
        found.variance += (squares - sum * sum / runs) / (runs - 1) / directions;
    }
    return found;
}

constexpr FogLight ways[] = {FogLight::flight, FogLight::equi_angular, FogLight::both};
const std::vector<std::string> names{"free flights", "equi-angular", "both"};

/// Plot: the error of one ray over the density of the fog.
void plot_density(const Options& options, int runs) {
    examples::Plot plot{.name = "fog-density",
                        .columns = {"scattering per unit of length"},
                        .y_label = "relative error of one ray",
                        .log_x = true,
                        .log_y = true};
    plot.columns.insert(plot.columns.end(), names.begin(), names.end());
    for (int step = -4; step <= 2; ++step) {
        const double density = std::pow(10.0, step / 2.0);
        const auto world = yard(float(density), 0.1f);
        examples::Row row{density};
        for (const FogLight how : ways)
            row.push_back(gather(world, how, 1, runs).error());
        plot.rows.push_back(row);
    }
    save_plot(options.path(""), plot);
}

/// Table: error and time of one ray, for small and large lamps in thin and dense fog.
void tabulate(const Options& options, int runs) {
    examples::Table table{.name = "fog-trade",
                          .columns = {"lamp and fog", "free flights", "equi-angular",
                                      "both", "ns: flights", "ns: equi-angular",
                                      "ns: both"}};
    const auto add = [&](const std::string& name, float density, float lamp_radius) {
        const auto world = yard(density, lamp_radius);
        std::vector<std::string> row{name}, times;
        for (const FogLight how : ways) {
            row.push_back(examples::text(gather(world, how, 1, runs).error(), "%.2f"));
            const double ns = examples::nanoseconds_a_call(
                8.0 * directions, [&] { return gather(world, how, 1, 8).mean; });
            times.push_back(examples::text(ns, "%.0f"));
        }
        row.insert(row.end(), times.begin(), times.end());
        table.rows.push_back(row);
    };
    add("small, thin", 0.05f, 0.05f);
    add("small, dense", 2, 0.05f);
    add("large, thin", 0.05f, 1);
    add("large, dense", 2, 1);
    examples::print_table(table);
    examples::save_table(options.path(""), table);
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 41, fog: two ways to find its light.");
        const Options options = line.parse({});
        const int runs = options.pick(20, 1000, 10000);
        plot_density(options, runs);
        tabulate(options, runs);
    });
}
