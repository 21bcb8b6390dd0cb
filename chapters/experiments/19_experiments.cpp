// smoke: --quality draft --width 24 --height 16 --rays 4 --most 4
/// \file chapters/experiments/19_experiments.cpp
/// \brief Chapter 19: the experiments behind its tables, plots and pictures: edges,
/// soft shadows, gloss, a lens and motion, and what evenly spread numbers bring.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>

#include "common/example.hpp"

namespace {

using ljus::Image;
using ljus::LensCamera;
using ljus::Quad;
using ljus::Rgb;
using ljus::Sphere;
using ljus::Vec2;
using ljus::Vec3;

using Tiles = ljus::Textured<ljus::Lambertian, ljus::Checker>;
using MovingBall = ljus::Moving<Sphere>;
using Stage =
    ljus::Scene<ljus::Shapes<Sphere, Quad, MovingBall>,
                ljus::Materials<ljus::Lambertian, Tiles, ljus::Mirror, ljus::Glossy>,
                ljus::Lights<ljus::PointLight>>;

/// A closed scene and its camera.
struct Shot {
    ljus::World<Stage> world;
    LensCamera camera{};
    bool pixel = false; ///< Whether the rays are spread over the pixel for its curve.
};

LensCamera pinhole(const ljus::View& view) {
    return with_lens(look_at(view), 0.0f, 1.0f);
}

ljus::MaterialId matt(Stage& scene, float r, float g, float b) {
    return scene.add(ljus::Lambertian{.albedo{r, g, b}});
}

ljus::MaterialId tiles(Stage& scene, const Rgb& even, const Rgb& odd, float size = 1) {
    return scene.add(Tiles{{.albedo = Rgb{1}},
                           {.map{.edge_u{2 * size, 0, 0}, .edge_v{0, 0, 2 * size}},
                            .even = even,
                            .odd = odd}});
}

void add_floor(Stage& scene, ljus::MaterialId material, float size = 60) {
    scene.add(Quad{{-size, 0, size}, {2 * size, 0, 0}, {0, 0, -2 * size}}, material);
}

void add_lamp(Stage& scene, const Vec3& middle, float side, float radiance) {
    const Vec3 corner = middle - Vec3{side / 2, 0, side / 2};
    scene.add(Quad{corner, {side, 0, 0}, {0, 0, side}}, matt(scene, 0, 0, 0),
              Rgb{radiance});
}

/// Tiles to the horizon: edges, and more edges than pixels.
Shot edges() {
    Stage scene;
    add_floor(scene, tiles(scene, Rgb{0.8f}, Rgb{0.08f}), 80);
    scene.add(Sphere{.center{0.9f, 0.8f, 0}, .radius = 0.8f},
              scene.add(ljus::Mirror{Rgb{0.9f}}));
    scene.add(ljus::PointLight{.position{-5, 40, 20}, .intensity = Rgb{4500}});
    return {ljus::World(std::move(scene)),
            pinhole({.position{0, 1.6f, 5}, .target{0, 0.9f, 0}}), true};
}

/// A square lamp above two balls and a wall.
Shot shadows() {
    Stage scene;
    add_floor(scene, matt(scene, 0.7f, 0.68f, 0.62f));
    scene.add(Sphere{.center{1.2f, 0.7f, 0.3f}, .radius = 0.7f},
              matt(scene, 0.7f, 0.25f, 0.15f));
    scene.add(Sphere{.center{-0.4f, 0.35f, 1.2f}, .radius = 0.35f},
              matt(scene, 0.2f, 0.35f, 0.65f));
    scene.add(Quad{{-2.4f, 0, -0.6f}, {1.6f, 0, 0.5f}, {0, 2.4f, 0}},
              matt(scene, 0.6f, 0.6f, 0.5f));
    add_lamp(scene, {-3.5f, 5, 2.2f}, 2, 26);
    return {ljus::World(std::move(scene)),
            pinhole({.position{0, 3.4f, 7}, .target{0, 0.6f, 0}, .vfov_degrees = 36})};
}

/// Sticks in front of a satin floor: the reflection is sharp only where they stand.
Shot gloss() {
    Stage scene;
    add_floor(scene,
              scene.add(ljus::Glossy{.reflectance = Rgb{0.75f}, .roughness = 0.4f}));
    const Rgb colors[] = {{0.8f, 0.15f, 0.1f},
                          {0.85f, 0.6f, 0.1f},
                          {0.25f, 0.55f, 0.2f},
                          {0.15f, 0.35f, 0.7f},
                          {0.5f, 0.2f, 0.55f}};
    for (int i = 0; i < 5; ++i) {
        const auto paint = scene.add(ljus::Lambertian{.albedo = colors[i]});
        scene.add(Quad{{-2.9f + 1.25f * float(i), 0, 0}, {0.8f, 0, 0}, {0, 2.6f, 0}},
                  paint);
    }
    scene.add(Quad{{-30, 0, -3}, {60, 0, 0}, {0, 20, 0}},
              matt(scene, 0.25f, 0.27f, 0.3f));
    scene.add(ljus::PointLight{.position{1, 5, 7}, .intensity = Rgb{230}});
    return {ljus::World(std::move(scene)),
            pinhole({.position{0, 2.3f, 7}, .target{0, 0.35f, 0}, .vfov_degrees = 38})};
}

/// Balls in a row, the third of them in focus.
Shot focus() {
    Stage scene;
    add_floor(scene, tiles(scene, Rgb{0.6f}, Rgb{0.3f}, 0.5f));
    for (int i = 0; i < 6; ++i) {
        const float x = -1.6f + 0.75f * float(i), z = 3.2f - 1.9f * float(i);
        scene.add(Sphere{.center{x, 0.5f, z}, .radius = 0.5f},
                  matt(scene, 0.75f - 0.1f * float(i), 0.3f, 0.15f + 0.12f * float(i)));
    }
    scene.add(ljus::PointLight{.position{-4, 8, 8}, .intensity = Rgb{320}});
    const ljus::Camera camera = look_at(
        ljus::View{.position{0, 1.5f, 7}, .target{0, 0.5f, 0}, .vfov_degrees = 34});
    const Vec3 third{-0.1f, 0.5f, -0.6f};
    return {
        ljus::World(std::move(scene)),
        with_lens(camera, 0.14f, glm::dot(third - camera.position, camera.forward))};
}

/// Balls that roll on a billiard table while the shutter is open.
Shot motion() {
    Stage scene;
    add_floor(scene, matt(scene, 0.06f, 0.35f, 0.16f));
    const auto ball = [&](const Vec3& place, const Vec3& way, const Rgb& color) {
        const auto paint = scene.add(ljus::Lambertian{.albedo = color});
        scene.add(MovingBall{{.center = place, .radius = 0.5f}, way}, paint);
    };
    ball({-1.9f, 0.5f, 0.6f}, {1.1f, 0, -0.5f}, {0.85f, 0.82f, 0.7f});
    ball({0.6f, 0.5f, -0.3f}, {0, 0, 0}, {0.8f, 0.6f, 0.05f});
    ball({1.8f, 0.5f, 0.4f}, {0.35f, 0, 0.2f}, {0.65f, 0.08f, 0.07f});
    ball({0.3f, 0.5f, -2.6f}, {-0.3f, 0, -0.7f}, {0.1f, 0.15f, 0.55f});
    scene.add(ljus::PointLight{.position{-3, 7, 4}, .intensity = Rgb{260}});
    return {ljus::World(std::move(scene)), pinhole({.position{0, 3.2f, 6.5f},
                                                    .target{0, 0.3f, -0.4f},
                                                    .vfov_degrees = 36})};
}

/// A picture whose rays draw all their numbers by one pattern.
/// \param pixel  Whether the rays are spread over the pixel; else they pass its middle.
Image picture_by(const Shot& shot, int width, int height, int rays,
                 ljus::Sampling sampling, std::uint64_t seed, bool pixel, int threads) {
    const ljus::DistributedTracer tracer(shot.world);
    const ljus::Pattern pattern = ljus::make_pattern(sampling, rays);
    Image image = ljus::make_image<float>(width, height);
    const auto row = [&](long long number) {
        const int y = static_cast<int>(number);
        ljus::Counts counts;
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum{0};
            for (int i = 0; i < rays; ++i) {
                ljus::StratifiedStream stream;
                start_ray(stream, seed, static_cast<std::uint64_t>(y * width + x), i,
                          pattern);
                const Vec2 place = next_2d(stream);
                const Vec2 at = Vec2{float(x), float(y)} + (pixel ? place : Vec2{0.5f});
                const auto ray = camera_ray(shot.camera, at, width, height, stream);
                auto context = ljus::context_of(stream, counts);
                sum += glm::dvec3(radiance(tracer, ray, context));
            }
            ljus::pixel(image, x, y) = Rgb(sum / double(rays));
        }
    };
    (void)ljus::parallel_blocks(height, row, {.threads = threads});
    examples::stop_if_asked();
    return image;
}
double rms(const Image& image, const Image& truth) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const Rgb d = image.pixels[i] - truth.pixels[i];
        sum += double(glm::dot(d, d)) / 3;
    }
    return std::sqrt(sum / double(image.pixels.size()));
}

/// The slope of a curve in a plot with two logarithmic axes.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
    double mx = 0, my = 0, sxy = 0, sxx = 0;
    const double n = double(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        mx += std::log(x[i]) / n;
        my += std::log(y[i]) / n;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
        sxy += (std::log(x[i]) - mx) * (std::log(y[i]) - my);
        sxx += (std::log(x[i]) - mx) * (std::log(x[i]) - mx);
    }
    return sxy / sxx;
}

/// Error against rays for each pattern; adds a row to the table of slopes.
void curves(const std::string& name, const Shot& shot, int most,
            const examples::Options& options, examples::Table& table) {
    using ljus::Sampling;
    const int width = options.pick(30, 48, 72), height = width * 2 / 3;
    const auto by = [&](Sampling sampling, int rays, std::uint64_t seed) {
        return picture_by(shot, width, height, rays, sampling, seed, shot.pixel,
                          options.threads);
    };
    const Image truth = by(Sampling::sobol, 16 * most, 99);
    examples::Plot plot{
        .name = "distributed_rays-pixel-error",
        .columns = {"rays per pixel", "random", "jittered", "multi-jittered", "Sobol"},
        .y_label = "RMS error",
        .log_x = true,
        .log_y = true};
    std::vector<double> n, error[4];
    for (int rays = 1; rays <= most; rays *= 4) {
        n.push_back(rays);
        examples::Row row{double(rays)};
        std::size_t kind = 0;
        for (const Sampling sampling : {Sampling::random, Sampling::jittered,
                                        Sampling::multi_jittered, Sampling::sobol}) {
            row.push_back(rms(by(sampling, rays, options.seed), truth));
            error[kind++].push_back(row.back());
        }
        plot.rows.push_back(row);
    }
    if (name == "pixel") save_plot(options.path(""), plot); // the others look alike
    std::vector<std::string> cells{name};
    for (const auto& curve : error)
        cells.push_back(examples::text(slope(n, curve), "%.2f"));
    // The number of random rays with the same error as one such ray; error falls as
    // n^-1/2.
    const double ratio = error[0].back() / error[2].back();
    cells.push_back(examples::text(error[2].back(), "%.2g"));
    cells.push_back(examples::text(ratio * ratio, "%.1f"));
    table.rows.push_back(cells);
    if (!options.quiet)
        std::printf("%s: slopes %s (random), %s (jittered), %s (multi-jittered), "
                    "%s (Sobol)\n",
                    name.c_str(), cells[1].c_str(), cells[2].c_str(), cells[3].c_str(),
                    cells[4].c_str());
}

/// Pictures with one ray and with many rays per pixel.
void picture(const std::string& name, const Shot& shot,
             const examples::Options& options) {
    for (const int rays : {1, options.samples}) {
        auto picture = examples::picture_settings(options);
        picture.samples = rays;
        const auto result = examples::rendered(
            name, ljus::DistributedTracer(shot.world), shot.camera, picture, options);
        save_png(result.image, options.path("distributed_rays-" + name +
                                            (rays == 1 ? "-few.png" : ".png")));
    }
}

/// One ray through the middle of each pixel.
void jagged(const Shot& shot, const examples::Options& options) {
    save_png(picture_by(shot, options.width, options.height, 1, ljus::Sampling::random,
                        1, false, options.threads),
             options.path("distributed_rays-pixel-few.png"));
}

// What evenly spread numbers bring.

using Balls =
    ljus::Scene<ljus::Shapes<Sphere, Quad>, ljus::Materials<ljus::Lambertian>>;

/// Nine balls on a floor, without a light.
Balls nine_balls() {
    Balls scene;
    const auto grey = scene.add(ljus::Lambertian{.albedo = Rgb{0.6f}});
    scene.add(Quad{{-9, 0, 9}, {18, 0, 0}, {0, 0, -18}}, grey);
    for (int i = 0; i < 9; ++i) {
        scene.add(Sphere{.center{float(2 * (i % 3) - 2), 0.6f, float(2 * (i / 3) - 2)},
                         .radius = 0.6f},
                  grey);
    }
    return scene;
}

constexpr std::array patterns{ljus::Sampling::random, ljus::Sampling::jittered,
                              ljus::Sampling::multi_jittered, ljus::Sampling::sobol};

/// A picture, and its processor time.
struct Timed {
    Image image;
    double seconds = 0; ///< Of processor time.
};
struct Size {
    int width = 0, height = 0; ///< In pixels.
};
template <ljus::AnyWorld W, typename AnyCamera>
Timed timed(const W& world, const AnyCamera& camera, ljus::Sampling sampling, int rays,
            const Size& size, std::uint64_t seed = 1) {
    const double start = examples::processor_seconds();
    auto picture = render(ljus::DistributedTracer(world), camera,
                          {.width = size.width,
                           .height = size.height,
                           .samples = rays,
                           .seed = seed,
                           .threads = 1,
                           .sampling = sampling});
    return {std::move(picture.image), examples::processor_seconds() - start};
}

/// Plot: the error of a picture with soft shadows against time.
void plot_trade(const Size& size, int most, const examples::Options& options) {
    auto scene = nine_balls();
    scene.add(Quad{{2, 6, 3}, {2, 0, 0}, {0, 0, 2}},
              scene.add(ljus::Lambertian{.albedo = Rgb{0}}), Rgb{25});
    const ljus::World world(std::move(scene));
    const ljus::Camera camera =
        look_at(ljus::View{.position{0, 5, 8}, .target{0, 0.4f, 0}});
    const Image truth =
        timed(world, camera, ljus::Sampling::sobol, 16 * most, size, 99).image;

    const double none = std::numeric_limits<double>::quiet_NaN();
    examples::Plot plot{.name = "distributed_rays-trade",
                        .columns = {"microseconds per pixel", "random", "jittered",
                                    "multi-jittered", "Sobol"},
                        .y_label = "RMS error of the picture",
                        .rows = {},
                        .log_x = true,
                        .log_y = true};
    const double pixels = double(size.width) * size.height;
    for (std::size_t kind = 0; kind < patterns.size(); ++kind)
        for (int rays = 1; rays <= most; rays *= 4) {
            double square = 0, seconds = std::numeric_limits<double>::infinity();
            const int seeds = options.pick(4, 8, 16);
            for (int seed = 1; seed <= seeds; ++seed) {
                const Timed one = timed(world, camera, patterns[kind], rays, size,
                                        std::uint64_t(seed));
                const double error = double(ljus::rmse(one.image, truth));
                square += error * error / seeds;
                seconds = std::min(seconds, one.seconds);
                examples::stop_if_asked();
            }
            examples::Row row(patterns.size() + 1, none);
            row[0] = 1e6 * seconds / pixels;
            row[kind + 1] = std::sqrt(square);
            plot.rows.push_back(row);
        }
    save_plot(options.path(""), plot);
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        int most = 0;
        line.about(
            "Chapter 19, distributed rays: how fast five blurs become smooth, and "
            "what it costs.");
        line.add("--most", most, "Most rays per pixel in the curves; 0: by quality", 0,
                 1 << 16);
        const examples::Options options =
            line.parse({.draft{.width = 240, .height = 160, .samples = 36},
                        .report{.width = 600, .height = 400, .samples = 100},
                        .reference{.width = 900, .height = 600, .samples = 1024}});
        if (most == 0) most = options.pick(64, 256, 1024);
        examples::Table table{.name = "distributed_rays-slopes",
                              .columns = {"spread over", "random", "jittered",
                                          "multi-jittered", "Sobol", "error",
                                          "random rays for one"}};
        const auto both = [&](const std::string& name, const Shot& shot) {
            picture(name, shot, options);
            curves(name, shot, most, options, table);
        };
        both("pixel", edges());
        jagged(edges(), options);
        both("light", shadows());
        both("gloss", gloss());
        both("lens", focus());
        both("time", motion());
        save_table(options.path(""), table);
        const int width = std::min(options.width, options.pick(48, 72, 96));
        const Size small{.width = width, .height = 2 * width / 3};
        plot_trade(small, most, options);
    });
}
