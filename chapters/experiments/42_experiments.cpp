// smoke: --quality draft
/// \file chapters/experiments/42_experiments.cpp
/// \brief Chapter 42: bias and noise of photons in fog over radius and number, points
/// and beams, the tree against a loop, and photon maps against path tracing in a foggy
/// room.

#include <cmath>
#include <ctime>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/lights/sun_light.hpp>
#include <ljus/materials/glass.hpp>
#include <ljus/materials/lambertian.hpp>
#include <ljus/materials/mirror.hpp>
#include <ljus/media/fog.hpp>
#include <ljus/photons/tracing.hpp>
#include <ljus/photons/volume_photons.hpp>
#include <ljus/render/path_tracing.hpp>
#include <ljus/render/photon_mapping.hpp>
#include <ljus/render/render.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/example.hpp"

namespace {

using namespace ljus;
using examples::Options;

using Yard = Scene<Shapes<Quad>, Materials<Mirror>, Lights<SunLight>, Media<Fog<Box>>>;

constexpr float half_width = 0.1f; // of the beam
constexpr double extinction_of_yard = 0.6;

/// The sun shines down on a strip of mirror, which sends a flat beam up through fog.
World<Yard> yard() {
    Yard scene;
    scene.add(Quad{{-1, 0, half_width}, {2, 0, 0}, {0, 0, -2 * half_width}},
              scene.add(Mirror{.reflectance = Rgb{1}}));
    scene.add(SunLight{.direction{0, -1, 0}, .irradiance = Rgb{1}});
    scene.add(Fog<Box>{.region{{-2, 0, -2}, {2, 1, 2}},
                       .absorption = Rgb{0.2f},
                       .scattering = Rgb{0.4f}});
    return World(std::move(scene));
}

/// A ray through the middle of the beam, and its radiance in closed form.
const Ray through_beam{.origin{-1.5f, 0.5f, 0}, .direction{1, 0, 0}};
double beam_radiance() {
    const double s = extinction_of_yard;
    const double up = std::exp(-1.5 * s); // down through all fog, and half of it up
    return 0.4 / (4 * std::numbers::pi) * up *
           (std::exp(-0.5 * s) - std::exp(-2.5 * s)) / s;
}

/// Mean and standard deviation of an estimate, relative to the truth.
struct Spread {
    double sum = 0, squares = 0, runs = 0;

    void add(double value) {
        const double x = value / beam_radiance();
        sum += x;
        squares += x * x;
        ++runs;
    }
    [[nodiscard]] double bias() const { return std::abs(sum / runs - 1); }
    [[nodiscard]] double noise() const {
        return std::sqrt((squares - sum * sum / runs) / (runs - 1));
    }
};

/// Photons of the beam, of one run.
std::vector<Photon> beam_photons(const World<Yard>& world, long long paths, int run) {
    return trace_photons(world, MapType::caustics,
                         {.photons = paths,
                          .iteration = std::uint64_t(run),
                          .keep = one_kind(PhotonKind::fog)})
        .photons;
}

/// The error of some ways to set the radius.
std::vector<Spread> spreads(const World<Yard>& world, long long paths, int runs,
                            const std::vector<BeamEstimateSettings>& ways) {
    std::vector<Spread> found(ways.size());
    for (int run = 0; run < runs; ++run) {
        const auto photons = beam_photons(world, paths, run);
        for (std::size_t i = 0; i < ways.size(); ++i)
            found[i].add(
                double(estimate_beam_plain(world, make_volume_map(photons, ways[i]),
                                           through_beam, ways[i].kernel)
                           .x));
    }
    return found;
}

/// Plot: bias and noise over the radius.
void plot_radius(const Options& options, const World<Yard>& world) {
    examples::Plot plot{.name = "volume_photons-radius",
                        .columns = {"radius in half widths of the beam", "bias",
                                    "noise of 2000 photons", "noise of 20000 photons"},
                        .y_label = "relative error",
                        .log_x = true,
                        .log_y = true};
    std::vector<BeamEstimateSettings> ways;
    for (int step = -4; step <= 6; ++step)
        ways.push_back({.radius = half_width * std::pow(2.0f, float(step) / 2)});
    const int runs = options.pick(10, 200, 1000);
    const auto few = spreads(world, 2000, runs, ways);
    const auto many = spreads(world, 20000, runs, ways);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const bool known = ways[i].radius > 1.2f * half_width; // else there is none
        plot.rows.push_back({double(ways[i].radius / half_width),
                             known ? many[i].bias() : std::nan(""), few[i].noise(),
                             many[i].noise()});
    }
    save_plot(options.path(""), plot);
}

/// Table: radii that photons choose.
void tabulate_nearest(const Options& options, const World<Yard>& world) {
    examples::Table table{.name = "volume_photons-nearest",
                          .columns = {"k", "noise of 2000", "bias of 2000",
                                      "noise of 20000", "bias of 20000"}};
    std::vector<BeamEstimateSettings> ways;
    for (const std::size_t nearest : {3, 10, 30, 100})
        ways.push_back({.nearest = nearest});
    const int runs = options.pick(5, 100, 500);
    const auto few = spreads(world, 2000, runs, ways);
    const auto many = spreads(world, 20000, runs, ways);
    for (std::size_t i = 0; i < ways.size(); ++i)
        table.rows.push_back({std::to_string(ways[i].nearest),
                              examples::text(few[i].noise(), "%.3f"),
                              examples::text(few[i].bias(), "%.3f"),
                              examples::text(many[i].noise(), "%.3f"),
                              examples::text(many[i].bias(), "%.3f")});
    examples::print_table(table);
    examples::save_table(options.path(""), table);
}

/// Table: a ray across the beam of the yard, by the points at which 2000 photons are
/// scattered, and by their whole flights.
void tabulate_beams(const Options& options) {
    examples::Table table{.name = "volume_photons-beams",
                          .columns = {"radius", "noise of points", "points at a ray",
                                      "noise of beams", "beams at a ray"}};
    constexpr int photons = 2000;
    constexpr double s = extinction_of_yard, albedo = 0.4 / s;
    const double flux = 4 * double(half_width) * std::exp(-s) / photons;
    const double phase = 1 / (4 * std::numbers::pi);
    const int runs = options.pick(10, 400, 4000);
    for (const double part : {0.25, 0.5, 1.0}) {
        const double r = part * double(half_width);
        Spread by_points, by_beams;
        double points = 0, beams = 0;
        for (int run = 0; run < runs; ++run) {
            double of_points = 0, of_beams = 0;
            for (int i = 0; i < photons; ++i) {
                auto stream =
                    random_stream(3, Pass::user, std::uint64_t(run), std::uint64_t(i));
                const auto u = next_2d<double>(stream);
                const double x = 2 * u.x - 1, z = double(half_width) * (2 * u.y - 1);
                const double seen = flux * phase * std::exp(-s * (x + 1.5));
                const double up = -std::log(1 - next_1d<double>(stream)) / s - 0.5;
                if (const double d2 = (up * up + z * z) / (r * r); d2 < 1) {
                    of_points +=
                        seen * albedo * 2 * (1 - d2) / (std::numbers::pi * r * r);
                    ++points;
                }
                if (const double d2 = z * z / (r * r); d2 < 1) {
                    of_beams += seen * 0.4 * std::exp(-0.5 * s) * 0.75 * (1 - d2) / r;
                    ++beams;
                }
            }
            by_points.add(of_points);
            by_beams.add(of_beams);
        }
        table.rows.push_back({examples::text(r, "%.3f"),
                              examples::text(by_points.noise(), "%.3f"),
                              examples::text(points / runs, "%.0f"),
                              examples::text(by_beams.noise(), "%.3f"),
                              examples::text(beams / runs, "%.0f")});
        // Neither has a bias here.
        for (const Spread& spread : {by_points, by_beams})
            if (spread.bias() > 5 * spread.noise() / std::sqrt(double(runs)))
                throw std::logic_error("volume_photons-beams: an estimate is biased");
    }
    examples::print_table(table);
    examples::save_table(options.path(""), table);
}

/// The seconds that a processor works on something, whatever else it does meanwhile.
template <typename Work>
double processor_seconds(Work&& work) {
    const std::clock_t start = std::clock();
    work();
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Table: the time of a ray, by the tree and by a loop.
void tabulate_tree(const Options& options, const World<Yard>& world) {
    examples::Table table{.name = "volume_photons-tree",
                          .columns = {"photons", "balls whose boxes it meets",
                                      "loop, us a ray", "tree, us a ray"}};
    std::vector<int> numbers{1000, 10'000};
    if (options.pick(0, 1, 1) == 1) numbers.push_back(100'000);
    for (const int number : numbers) {
        std::vector<Photon> photons;
        auto stream = random_stream(1, Pass::user, 0, 0);
        for (int i = 0; i < number; ++i)
            photons.push_back(
                {.position = 2.0f * next_3d<float>(stream) - 1.0f,
                 .direction = sample_uniform_sphere(next_2d<float>(stream)),
                 .flux = Rgb{1},
                 .kind = PhotonKind::fog});
        const VolumeMap map = make_volume_map(photons);
        constexpr int rays = 1000;
        std::uint64_t visited = 0;
        const auto time = [&](const auto& estimate) {
            const auto all = [&] {
                auto numbers_of_rays = random_stream(2, Pass::user, 0, 0);
                volatile float sum = 0; // so that no estimate is left out
                for (int i = 0; i < rays; ++i) {
                    const Vec2 u = next_2d<float>(numbers_of_rays);
                    sum = sum + estimate(Ray{.direction = sample_uniform_sphere(u)}).x;
                }
            };
            return processor_seconds(all) / rays * 1e6;
        };
        const double loop = time([&](const Ray& ray) {
            return estimate_beam_plain(world, map, ray, Kernel::epanechnikov);
        });
        const double tree = time([&](const Ray& ray) {
            return estimate_beam(world, map, ray, Kernel::epanechnikov, visited);
        });
        table.rows.push_back(
            {std::to_string(number), examples::text(double(visited) / rays, "%.0f"),
             examples::text(loop, "%.1f"), examples::text(tree, "%.1f")});
    }
    examples::print_table(table);
    examples::save_table(options.path(""), table);
}

using FoggyBox = Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Glass>, Lights<>,
                       Media<Fog<Box>>>;

/// A room with a lamp, a ball of glass and fog.
World<FoggyBox> foggy_box(float lamp_radius) {
    FoggyBox scene;
    add_cornell_walls(scene);
    scene.add(Sphere{.center{0.2f, 1.6f, 0}, .radius = lamp_radius},
              scene.add(Lambertian{.albedo = Rgb{0}}),
              Rgb{0.3f / (lamp_radius * lamp_radius)});
    scene.add(Sphere{.center{-0.3f, 0.8f, 0.1f}, .radius = 0.4f}, scene.add(Glass{}));
    scene.add(Fog<Box>{.region{{-1, 0, -1}, {1, 2, 1}},
                       .absorption = Rgb{0.1f},
                       .scattering = Rgb{0.6f},
                       .g = 0.3f});
    return World(std::move(scene));
}

/// Table: time and error of photon maps and of path tracing.
void tabulate_room(const Options& options) {
    examples::Table table{.name = "volume_photons-room",
                          .columns = {"lamp", "method", "seconds", "relMSE"}};
    const int side = options.pick(8, 20, 40);
    for (const float lamp : {0.3f, 0.1f}) {
        const auto world = foggy_box(lamp);
        const auto picture = [&](int samples, std::uint64_t seed) {
            return RenderSettings{.width = side,
                                  .height = side,
                                  .samples = samples,
                                  .seed = seed,
                                  .threads = 1};
        };
        const Image reference = render(PathTracer(world), cornell_camera(),
                                       picture(options.pick(16, 4096, 65536), 99))
                                    .image;
        const auto add = [&](const std::string& method, const auto& make) {
            Image image;
            const double seconds = processor_seconds([&] { image = make(); });
            table.rows.push_back({examples::text(double(lamp)), method,
                                  examples::text(seconds, "%.2f"),
                                  examples::text(rel_mse(image, reference), "%.2g")});
        };
        for (const int rays : {16, 64, 256})
            add("paths, " + std::to_string(rays) + " rays", [&] {
                return render(PathTracer(world), cornell_camera(), picture(rays, 1))
                    .image;
            });
        for (const int photons : {5'000, 50'000}) {
            add("maps, " + std::to_string(photons) + " photons each", [&] {
                PhotonMappingSettings settings{.indirect = IndirectLight::photons};
                for (auto* pass : {&settings.caustics, &settings.general}) {
                    pass->photons = photons;
                    pass->threads = 1;
                }
                settings.caustics_estimate.radius = settings.general_estimate.radius =
                    0;
                return render(PhotonMapper(world, settings), cornell_camera(),
                              picture(16, 1))
                    .image;
            });
        }
    }
    examples::print_table(table);
    examples::save_table(options.path(""), table);
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 42, photons in fog: radius, number, tree, and a room.");
        const Options options = line.parse({});
        const auto world = yard();
        plot_radius(options, world);
        tabulate_nearest(options, world);
        tabulate_beams(options);
        tabulate_tree(options, world);
        tabulate_room(options);
    });
}
