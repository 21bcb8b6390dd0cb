// smoke: --quality draft --width 8 --height 8 --rungs 2 --seeds 2 --truth 4
/// \file chapters/experiments/47_experiments.cpp
/// \brief Chapter 47: error against time by paths, by photons and by both, in a
/// diffuse room and for a caustic before a mirror.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>
#include <ljus/render/vertex_merging.hpp>

#include "common/convergence.hpp"
#include "common/example.hpp"
#include "experiments/show_table.hpp"

using namespace ljus;

namespace {

using Box = Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass, Mirror>>;

/// The options of this program, besides the common ones.
struct Sizes {
    int rungs = 0; ///< Efforts tried, each four times the one before.
    int seeds = 0; ///< Runs of each.
    int truth = 0; ///< Rays per pixel of the reference, by path tracing.
};

/// A room with a small round lamp: a glass ball before a mirror, or all of it matt.
World<Box> box(bool shining) {
    Box scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.6f}});
    const auto red = scene.add(Lambertian{.albedo{0.6f, 0.2f, 0.1f}});
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    const auto mirror = scene.add(Mirror{.reflectance = Rgb{0.9f}});
    const auto glass = scene.add(Glass{});
    const Vec3 x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2}, corner{-1, -1, -1};
    scene.add(Quad{corner, z, x}, white);
    scene.add(Quad{corner + y, x, z}, white);
    scene.add(Quad{corner, x, y}, shining ? mirror : white);
    scene.add(Quad{corner + z, y, x}, white);
    scene.add(Quad{corner, y, z}, red);
    scene.add(Quad{corner + x, z, y}, white);
    scene.add(Sphere{{-0.1f, -0.5f, -0.2f}, 0.35f}, shining ? glass : red);
    scene.add(Sphere{{-0.5f, 0.7f, 0.2f}, 0.1f}, black, Rgb{30});
    return World(std::move(scene));
}

/// A way to render, by an effort: rays per pixel, or as much work.
struct Method {
    std::string name;
    std::function<Image(const World<Box>&, const Camera&, int effort,
                        std::uint64_t seed, RenderSettings picture)>
        shoot;
};

std::vector<Method> methods() {
    const auto joined = [](float radius, int rays) {
        return [=](const World<Box>& world, const Camera& camera, int effort,
                   std::uint64_t seed, RenderSettings picture) {
            const VertexMerger merger(
                world, {.paths = 2000LL * effort,
                        .radius = radius * float(std::pow(double(effort), -1.0 / 6)),
                        .seed = seed,
                        .threads = picture.threads});
            picture.samples = rays * effort;
            return render(merger, camera, picture).image;
        };
    };
    return {{"path tracing",
             [](const World<Box>& world, const Camera& camera, int effort,
                std::uint64_t, RenderSettings picture) {
                 picture.samples = 8 * effort;
                 return render(PathTracer(world), camera, picture).image;
             }},
            {"photon mapping",
             [](const World<Box>& world, const Camera& camera, int effort,
                std::uint64_t seed, RenderSettings picture) {
                 const auto radius = 0.1f * float(std::pow(double(effort), -1.0 / 6));
                 const PhotonMapper mapper(world,
                                           {.caustics{.photons = 2000LL * effort,
                                                      .seed = seed,
                                                      .threads = picture.threads},
                                            .caustics_estimate{.radius = radius}});
                 picture.samples = 4 * effort;
                 return render(mapper, camera, picture).image;
             }},
            {"connection alone", joined(0, 4)},
            {"merging", joined(0.06f, 2)}};
}

/// Errors and times of all methods in one room, as a plot and as rows of a table.
void measure(const examples::Options& options, const Sizes& sizes, bool shining,
             examples::Table& table) {
    const auto world = box(shining);
    const Camera camera = look_at(
        {.position{0.3f, 0.1f, 0.95f}, .target{0, -0.3f, -0.4f}, .vfov_degrees = 75});
    auto picture = picture_settings(options);
    picture.samples = sizes.truth;
    picture.seed = 12345;
    const Image truth =
        examples::rendered("truth", PathTracer(world), camera, picture, options).image;

    const std::string name = shining ? "mirror" : "diffuse";
    examples::Plot plot{.name = "both_ends-" + name,
                        .columns = {"seconds"},
                        .y_label = "relative error",
                        .log_x = true,
                        .log_y = true};
    const auto ways = methods();
    for (const Method& method : ways) plot.columns.push_back(method.name);
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t m = 0; m < ways.size(); ++m) {
        examples::Row last;
        for (int rung = 0; rung < sizes.rungs; ++rung) {
            const int effort = 1 << (2 * rung);
            double squares = 0, seconds = 0;
            for (int seed = 1; seed <= sizes.seeds; ++seed) {
                picture.seed = std::uint64_t(seed);
                const double start = examples::processor_seconds();
                const Image image =
                    ways[m].shoot(world, camera, effort, std::uint64_t(seed), picture);
                seconds += (examples::processor_seconds() - start) / sizes.seeds;
                squares += rel_mse(image, truth) / sizes.seeds;
                examples::stop_if_asked();
            }
            examples::Row row(ways.size() + 1, nothing);
            row[0] = seconds;
            row[m + 1] = std::sqrt(squares);
            plot.rows.push_back(row);
            last = {seconds, row[m + 1]};
        }
        plot.rows.push_back({});
        table.rows.push_back({ways[m].name + " " + name,
                              examples::text(last[0], "%.2f"),
                              examples::text(last[1], "%.3f")});
    }
    save_plot(options.path(""), plot);
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 47, both ends: error against time in two rooms.");
        line.group("Measurements");
        line.add("--rungs", sizes.rungs, "Efforts, each 4 times the last", 1, 8);
        line.add("--seeds", sizes.seeds, "Runs of each", 1, 1000);
        line.add("--truth", sizes.truth, "Rays per pixel of the reference", 1,
                 10000000);
        const examples::Options options =
            line.parse({.draft{.width = 12, .height = 12, .samples = 1},
                        .report{.width = 24, .height = 24, .samples = 1},
                        .reference{.width = 32, .height = 32, .samples = 1}});
        if (sizes.rungs == 0) sizes.rungs = options.pick(3, 4, 5);
        if (sizes.seeds == 0) sizes.seeds = options.pick(2, 3, 16);
        if (sizes.truth == 0) sizes.truth = options.pick(400, 6000, 400000);
        examples::Table table{
            .name = "both_ends-trade",
            .columns = {"method and room", "seconds", "relative error"}};
        measure(options, sizes, false, table);
        measure(options, sizes, true, table);
        examples::show_table(options, table);
    });
}
