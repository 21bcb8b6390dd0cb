// smoke: --quality draft --width 16 --height 16 --rays 4
/// \file chapters/experiments/39_experiments.cpp
/// \brief Chapter 39: the experiments behind its table, plot and pictures: directions
/// of a sky drawn uniformly, by the cosine and by brightness.

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>

#include "common/example.hpp"
#include "experiments/uniform_sky.hpp"

namespace {

using ljus::EnvironmentLight;
using ljus::Image;
using ljus::MisHeuristic;
using ljus::Rgb;
using ljus::Vec2T;
using ljus::Vec3T;

/// A sky of radiance 1 above a dark ground, with one pixel of another radiance at an
/// elevation of about 50 degrees: 64 x 32 pixels, that is 5.6 degrees each.
ljus::EnvironmentLightT<double> sky_with_sun(double sun) {
    auto picture = ljus::make_image<double>(64, 32, ljus::RgbT<double>{0.1});
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 64; ++x) pixel(picture, x, y) = ljus::RgbT<double>{1.0};
    pixel(picture, 20, 7) = ljus::RgbT<double>{sun};
    return {.picture = picture};
}

/// The same in float, darker: a white pixel is about 1.
EnvironmentLight in_float(const ljus::EnvironmentLightT<double>& sky) {
    EnvironmentLight light{.picture =
                               ljus::make_image(sky.picture.width, sky.picture.height),
                           .strength = 0.3f};
    for (std::size_t i = 0; i < sky.picture.pixels.size(); ++i)
        light.picture.pixels[i] = Rgb(sky.picture.pixels[i]);
    return light;
}

/// Variance over squared mean of one sample, for the irradiance of a level floor, over
/// a grid of the unit square.
/// \param estimate  Called with a point of the square; the value of one sample.
template <typename Estimate>
double relative_variance(int size, const Estimate& estimate) {
    double sum = 0, squares = 0;
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) {
            const double value =
                estimate(Vec2T<double>{(i + 0.5) / size, (j + 0.5) / size});
            sum += value;
            squares += value * value;
        }
    const double count = double(size) * size;
    const double found = squares * count / (sum * sum) - 1;
    return found < 1e-9 ? 0 : found; // what is left by rounding
}

/// Table: the variance of three ways of drawing directions, under skies with a sun that
/// is 1 to 100 000 times as bright as its surroundings.
void tabulate_contrast(const std::string& folder, int size) {
    constexpr double pi = std::numbers::pi;
    examples::Table table{
        .name = "environment-contrast",
        .columns = {"sun over sky", "uniform", "by the cosine", "by brightness"}};
    for (const double sun : {1.0, 10.0, 100.0, 1000.0, 10'000.0, 100'000.0}) {
        const auto light =
            in_scene(sky_with_sun(sun), ljus::SphereT<double>{.radius = 1});
        const auto seen = [&](const Vec3T<double>& wi) {
            return escaped_radiance(light, wi).x * std::max(wi.y, 0.0);
        };
        const auto uniform = [&](const Vec2T<double>& u) {
            return seen(ljus::sample_uniform_sphere(u)) * 4 * pi;
        };
        const auto cosine = [&](const Vec2T<double>& u) {
            const Vec3T<double> local = ljus::sample_cosine_hemisphere(u);
            return escaped_radiance(light, Vec3T<double>{local.x, local.z, local.y}).x *
                   pi;
        };
        const auto brightness = [&](const Vec2T<double>& u) {
            const auto sample = sample_light(light, Vec3T<double>{0}, u, 0.0);
            return sample->weight.x * std::max(sample->wi.y, 0.0);
        };
        std::vector<std::string> row{examples::text(sun, "%.0f")};
        row.push_back(examples::text(relative_variance(size, uniform), "%.3g"));
        row.push_back(examples::text(relative_variance(size, cosine), "%.3g"));
        row.push_back(examples::text(relative_variance(size, brightness), "%.3g"));
        examples::print_row(row, 16);
        table.rows.push_back(row);
    }
    save_table(folder, table);
}

/// A grey ball on a grey floor.
template <typename Light>
auto ball_under(const Light& light) {
    const ljus::Lambertian grey{.albedo = Rgb{0.5f}};
    return ljus::World(
        make_scene(placed(ljus::Quad{{-4, 0, 4}, {8, 0, 0}, {0, 0, -8}}, grey),
                   placed(ljus::Sphere{{0, 1, 0}, 1}, grey), light));
}

/// Plot: the error of four ways over the rays of a pixel. Pictures: two of them.
void plot_error(const examples::Options& options) {
    const EnvironmentLight sky = in_float(sky_with_sun(1000));
    const auto uniform = ball_under(plain::UniformSky{sky});
    const auto bright = ball_under(sky);
    const auto camera =
        ljus::look_at({.position{0, 3, 6}, .target{0, 0.7f, 0}, .vfov_degrees = 30});
    const auto made = [&](const auto& tracer, int rays, std::uint64_t seed) {
        auto picture = examples::picture_settings(options);
        picture.samples = rays;
        picture.seed = seed;
        return examples::rendered("sky", tracer, camera, picture, options).image;
    };
    const int most = options.samples;
    const Image reference =
        made(ljus::PathTracer(bright), 16 * most, options.seed + 1000);
    examples::Plot plot{.name = "environment-error",
                        .columns = {"camera rays per pixel", "uniform shadow rays",
                                    "paths alone", "shadow rays by brightness",
                                    "paths and shadow rays by brightness"},
                        .y_label = "relMSE",
                        .log_x = true,
                        .log_y = true};
    for (int rays = 1; rays <= most; rays *= 4) {
        const auto error = [&](const auto& world,
                               const ljus::PathTracingSettings& settings,
                               const char* file) {
            const Image image =
                made(ljus::PathTracer(world, settings), rays, options.seed);
            if (rays == 16 && file != nullptr) save_png(image, options.path(file));
            return ljus::rel_mse(image, reference);
        };
        const ljus::PathTracingSettings shadow{.heuristic = MisHeuristic::shadow_rays};
        const examples::Row row{double(rays),
                                error(uniform, shadow, "environment-uniform.png"),
                                error(bright, {.sample_lights = false}, nullptr),
                                error(bright, shadow, "environment-bright.png"),
                                error(bright, {}, nullptr)};
        if (!options.quiet)
            std::printf("%4d rays: %.4f %.4f %.4f %.4f\n", rays, row[1], row[2], row[3],
                        row[4]);
        plot.rows.push_back(row);
    }
    save_plot(options.path(""), plot);
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 39, environments: which directions of a sky to ask.");
        const examples::Options options =
            line.parse({.draft{.width = 60, .height = 40, .samples = 16},
                        .report{.width = 240, .height = 160, .samples = 64},
                        .reference{.width = 480, .height = 320, .samples = 1024}});
        tabulate_contrast(options.path(""), options.pick(400, 2000, 4000));
        plot_error(options);
    });
}
