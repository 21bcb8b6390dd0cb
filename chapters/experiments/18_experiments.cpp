// smoke: --quality draft --width 24 --height 16 --rays 1 --photons 1000 --most 4
/// \file chapters/experiments/18_experiments.cpp
/// \brief Chapter 18: the experiments behind its tables and plots: how the tree grows,
/// both branches or one, and what the tree does not carry.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

namespace {

using ljus::Image;
using ljus::Quad;
using ljus::Rgb;
using ljus::Sphere;

using TiledFloor = ljus::Textured<ljus::Lambertian, ljus::Checker>;
using TwoBallsScene = ljus::Scene<
    ljus::Shapes<Sphere, Quad>,
    ljus::Materials<ljus::Lambertian, ljus::Glass, ljus::Mirror, TiledFloor>,
    ljus::Lights<ljus::PointLight>>;
using TwoBalls = ljus::World<TwoBallsScene>;

/// The radiance of the sky, W/(m^2 sr).
const Rgb sky{0.16f, 0.27f, 0.5f};

/// Whitted's well-known picture: a ball of glass before a mirror, over a floor of
/// red and yellow tiles, under a blue sky.
TwoBalls two_balls() {
    TwoBallsScene scene;
    const auto glass = scene.add(ljus::Glass{.index = 1.5f});
    const auto mirror = scene.add(ljus::Mirror{.reflectance{0.75f, 0.73f, 0.68f}});
    const auto black = scene.add(ljus::Lambertian{.albedo = Rgb{0}});
    const auto floor = scene.add(TiledFloor{{.albedo = Rgb{1}},
                                            {.map{.edge_u{2, 0, 0}, .edge_v{0, 0, 2}},
                                             .even{0.75f, 0.07f, 0.04f},
                                             .odd{0.8f, 0.65f, 0.07f}}});
    scene.add(Sphere{.center{0.5f, 1.5f, 1.2f}, .radius = 1}, glass);
    scene.add(Sphere{.center{-1.1f, 1.1f, -1.3f}, .radius = 1.1f}, mirror);
    scene.add(Quad{{-6, 0, 3.5f}, {11, 0, 0}, {0, 0, -16}}, floor);
    scene.add(Sphere{.radius = 60}, black, sky, true); // its inside
    scene.add(ljus::PointLight{.position{-3, 7, 5}, .intensity = Rgb{190}});
    return TwoBalls(std::move(scene));
}
ljus::Camera two_balls_camera() {
    return ljus::look_at(
        {.position{0.2f, 2.1f, 8}, .target{-0.1f, 1.1f, 0}, .vfov_degrees = 32});
}

/// The sky is seen, but no shadow ray asks for its light. Ambient light takes its
/// place: the same from everywhere, and no ball shades it.
ljus::WhittedSettings settings_of(int depth, bool split_glass = true) {
    return {
        .max_depth = depth, .split_glass = split_glass, .lamps = false, .ambient = sky};
}

/// A picture of the two balls, with a progress bar.
template <typename Renderer>
ljus::RenderedT<float> rendered(const std::string& name, const Renderer& renderer,
                                ljus::RenderSettings picture,
                                const examples::Options& options) {
    return examples::rendered(name, renderer, two_balls_camera(), picture, options);
}

/// Plot: how many rays the tree of a camera ray has, by its depth.
void plot_rays(const TwoBalls& world, const examples::Options& options) {
    const ljus::RenderSettings picture{options.width, options.height, options.samples,
                                       options.seed};
    examples::Plot plot{.name = "whitted-rays",
                        .columns = {"depth", "every ray meets glass: 2^(d+1) - 1",
                                    "rays that hit one ball of glass: 1 + 2d",
                                    "the two balls by both branches",
                                    "the two balls by one branch"},
                        .y_label = "rays per camera ray, without shadow rays",
                        .log_y = true,
                        .more = "set yrange [0.8:200]\nset format y '%g'\n"};
    const auto rays_of = [](const ljus::Counts& counts) {
        return double(counts.camera_rays + counts.bounce_rays) /
               double(counts.camera_rays);
    };
    for (int depth = 0; depth <= 6; ++depth) {
        const auto both =
            rendered("depth " + std::to_string(depth),
                     ljus::WhittedTracer(world, settings_of(depth)), picture, options);
        const auto one = rendered("one branch",
                                  ljus::WhittedTracer(world, settings_of(depth, false)),
                                  picture, options);
        plot.rows.push_back({double(depth), std::exp2(depth + 1) - 1, 1.0 + 2 * depth,
                             rays_of(both.counts), rays_of(one.counts)});
        if (!options.quiet)
            std::printf("depth %d: %.3f rays per camera ray by both branches, %.3f by "
                        "one; %.3f shadow rays\n",
                        depth, rays_of(both.counts), rays_of(one.counts),
                        double(both.counts.shadow_rays) /
                            double(both.counts.camera_rays));
    }
    save_plot(options.path(""), plot);
}

/// The root mean square error over the pixels of the glass ball.
double error_on_glass(const Image& image, const Image& truth) {
    double sum = 0, count = 0;
    const ljus::Camera camera = two_balls_camera();
    const Sphere ball{.center{0.5f, 1.5f, 1.2f}, .radius = 1};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const ljus::Vec2 middle{float(x) + 0.5f, float(y) + 0.5f};
            if (!intersect(primary_ray(camera, middle, image.width, image.height),
                           ball))
                continue;
            const Rgb d = pixel(image, x, y) - pixel(truth, x, y);
            sum += double(glm::dot(d, d)) / 3;
            count += 1;
        }
    return std::sqrt(sum / count);
}

/// Plot and table: error against rays, by both branches and by one.
void branches(const TwoBalls& world, int most, const examples::Options& options) {
    const int width = options.pick(48, 120, 180), height = width * 2 / 3;
    const int depth = 8;
    const Image truth =
        rendered("reference", ljus::WhittedTracer(world, settings_of(depth)),
                 {.width = width, .height = height, .samples = 16 * most, .seed = 77},
                 options)
            .image;
    examples::Plot plot{.name = "whitted-cost",
                        .columns = {"rays per pixel of all kinds", "both branches",
                                    "one branch by roulette"},
                        .y_label = "RMS error on the glass ball",
                        .log_x = true,
                        .log_y = true};
    examples::Table table{.name = "whitted-cost-table",
                          .columns = {"camera rays per pixel", "both: all rays",
                                      "both: RMS error", "one: all rays",
                                      "one: RMS error"}};
    const double empty = std::numeric_limits<double>::quiet_NaN();
    for (int rays = 1; rays <= most; rays *= 4) {
        const ljus::RenderSettings picture{width, height, rays, options.seed};
        std::vector<std::string> cells{std::to_string(rays)};
        for (const bool both : {true, false}) {
            const auto result = rendered(
                "branches", ljus::WhittedTracer(world, settings_of(depth, both)),
                picture, options);
            const double cost = double(result.counts.rays()) / (width * height);
            const double error = error_on_glass(result.image, truth);
            plot.rows.push_back({cost, both ? error : empty, both ? empty : error});
            cells.push_back(examples::text(cost));
            cells.push_back(examples::text(error, "%.2g"));
        }
        table.rows.push_back(cells);
    }
    save_plot(options.path(""), plot);
    save_table(options.path(""), table);
}

/// Picture: the same scene by photon mapping. The sky lights it, and light passes the
/// glass.
void by_photons(const TwoBalls& world, long long photons,
                const examples::Options& options) {
    ljus::PhotonMappingSettings settings;
    settings.caustics = {
        .photons = photons, .seed = options.seed, .threads = options.threads};
    settings.caustics_estimate = {.radius = options.pick(0.07f, 0.07f, 0.03f)};
    settings.max_depth = 8;
    settings.shadow_rays = 2;
    const ljus::PhotonMapper mapper(world, settings);
    const ljus::RenderSettings picture{
        options.width, options.height,
        std::max(options.samples, options.pick(16, 64, 256)), options.seed};
    save_png(rendered("photon map", mapper, picture, options).image,
             options.path("whitted-photons.png"));
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 0;
        line.about(
            "Chapter 18, Whitted's ray tracing: the tree of rays, and its cost.");
        line.add("--photons", photons, "Of the picture to compare with; 0: by quality",
                 0, 1'000'000'000);
        int most = 0;
        line.add("--most", most, "Most rays per pixel in the curves; 0: by quality", 0,
                 1 << 16);
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 200, .samples = 9},
                        .report{.width = 600, .height = 400, .samples = 36},
                        .reference{.width = 900, .height = 600, .samples = 144}});
        if (photons == 0) photons = options.pick(100000LL, 1000000LL, 10000000LL);
        const TwoBalls world = two_balls();
        plot_rays(world, options);
        by_photons(world, photons, options);
        if (most == 0) most = options.pick(64, 256, 1024);
        branches(world, most, options);
    });
}
