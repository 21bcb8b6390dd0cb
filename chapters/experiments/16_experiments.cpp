// smoke: --quality draft --width 32 --height 8 --rays 1
/// \file chapters/experiments/16_experiments.cpp
/// \brief Chapter 16: gloss from a mirror to satin, what it loses, and what its samples
/// are worth.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>

#include "common/example.hpp"
#include "experiments/one_ball.hpp"

namespace {

using examples::ball_picture;
using examples::furnace_albedo;
using examples::own_sampler;
using examples::weights;
using ljus::Image;
using ljus::Rgb;
using ljus::Vec3;

/// Pictures: gold from roughness 0 to 1.
void sweep_roughness(const examples::Options& options) {
    const int size = options.pick(150, 400, 500), rays = options.pick(20, 400, 4000);
    const auto save = [&](const std::string& name, const auto& material) {
        save_png(ball_picture(size, rays, options.seed, material, options.threads),
                 options.path(name + ".png"));
        examples::stop_if_asked();
    };
    const auto gold = [](int percent) {
        return ljus::RoughMetal{.reflectance = ljus::gold<float>,
                                .roughness = 0.01f * float(percent)};
    };
    for (const int percent : {0, 15, 30, 50, 70, 100})
        save("glossy-" + std::to_string(percent), gold(percent));
    save("glossy-full-100", compensated_glossy(gold(100)));
}

/// Plots: how much light white gloss loses, and how much its sampler matters.
void plot_gloss(const std::string& folder, int count) {
    examples::Plot loss{.name = "glossy-loss",
                        .columns = {"roughness", "straight on", "60 degrees",
                                    "80 degrees", "88 degrees"},
                        .y_label = "share of a white sky that white returns",
                        .more = "set yrange [0:1.05]\nset key inside left bottom\n"};
    examples::Plot noise{
        .name = "glossy-sampling",
        .columns = {"roughness", "visible normals", "cosine-weighted directions"},
        .y_label = "variance of the weight at 60°",
        .log_y = true,
        .more = "set yrange [1e-4:1e5]\n"};
    for (int percent = 5; percent <= 100; percent += 5) {
        const double r = 0.01 * percent;
        const ljus::Glossy white{.reflectance = Rgb{1}, .roughness = float(r)};
        const auto own = [&](double degrees) {
            return weights(degrees, count, own_sampler(white));
        };
        loss.rows.push_back({r, own(0).mean, own(60).mean, own(80).mean, own(88).mean});
        const auto cosine = [&](const Vec3& wo, const Vec3& u) {
            const Vec3 wi = ljus::sample_cosine_hemisphere(ljus::Vec2{u.x, u.y});
            return double(evaluate(white, wo, wi).x) * std::numbers::pi;
        };
        noise.rows.push_back(
            {r, own(60).variance, weights(60, count, cosine).variance});
    }
    save_plot(folder, loss);
    save_plot(folder, noise);
}

/// Table and picture: gloss that loses light, and gloss that keeps it.
void compare_full(const examples::Options& options) {
    examples::Table table{.name = "glossy-full",
                          .columns = {"roughness", "white gloss returns", "full gloss",
                                      "sample, ns", "full, ns", "error of 10x10 blocks",
                                      "of it noise"},
                          .rows = {}};
    const int size = options.pick(48, 150, 300), rays = options.pick(25, 400, 4000);
    const auto sampling = [](const auto& material) {
        return examples::nanoseconds([&](const Vec3& wo, Vec3, const Vec3& u) {
            const auto s = sample(material, wo, u, ljus::Transport::radiance);
            return s ? s->wi.x : 0.0f;
        });
    };
    for (const float roughness : {0.3f, 0.45f, 0.7f, 1.0f}) {
        const ljus::Glossy white{.reflectance = Rgb{1}, .roughness = roughness};
        const int many = options.pick(16, 64, 1024);
        const auto share = [&](const auto& material) {
            return examples::text(double(furnace_albedo(material, many).y), "%.3f");
        };
        const ljus::RoughMetal gold{.reflectance = ljus::gold<float>,
                                    .roughness = roughness};
        const ljus::FullRoughMetal full = compensated_glossy(gold);
        const auto picture = [&](const auto& material, std::uint64_t seed) {
            Image image = ball_picture(size, rays, seed, material, options.threads);
            examples::stop_if_asked();
            return image;
        };
        const Image truth = picture(full, options.seed);
        table.rows.push_back(
            {examples::text(double(roughness), "%.2f"), share(white),
             share(compensated_glossy(white)), examples::text(sampling(gold), "%.0f"),
             examples::text(sampling(full), "%.0f"),
             examples::text(ljus::block_error(picture(gold, options.seed + 1), truth),
                            "%.1e"),
             examples::text(ljus::block_error(picture(full, options.seed + 2), truth),
                            "%.1e")});
        examples::print_row(table.rows.back(), 10);
    }
    examples::save_table(options.path(""), table);
}

/// Plot: error against time for gold with both kinds of gloss. One loses light, which
/// more rays do not bring back.
void plot_full(const examples::Options& options) {
    const int size = options.pick(48, 100, 200), most = options.pick(64, 256, 256);
    const ljus::RoughMetal gold{.reflectance = ljus::gold<float>, .roughness = 0.7f};
    const ljus::FullRoughMetal full = compensated_glossy(gold);
    const Image truth =
        ball_picture(size, 8 * most, options.seed, full, options.threads);
    examples::Plot plot{
        .name = "glossy-error",
        .columns = {"processor seconds", "gloss that loses light", "full gloss"},
        .y_label = "relMSE of 10 x 10 blocks",
        .log_x = true,
        .log_y = true};
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    const auto measure = [&](const auto& material, int rays) {
        const double start = examples::processor_seconds();
        const Image image =
            ball_picture(size, rays, options.seed + 1, material, options.threads);
        const double seconds = examples::processor_seconds() - start;
        examples::stop_if_asked();
        return std::pair{seconds, ljus::block_error(image, truth)};
    };
    for (int rays = 1; rays <= most; rays *= 4) {
        const auto [seconds, error] = measure(gold, rays);
        plot.rows.push_back({seconds, error, nothing});
    }
    for (int rays = 1; rays <= most; rays *= 4) {
        const auto [seconds, error] = measure(full, rays);
        plot.rows.push_back({seconds, nothing, error});
    }
    save_plot(options.path(""), plot);
}

} // namespace

/// Makes the chapter's pictures, plots and tables.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 16, gloss: its pictures, losses and samples.");
        const examples::Options options = line.parse({});
        sweep_roughness(options);
        plot_gloss(options.path(""), options.pick(20000, 200000, 1000000));
        compare_full(options);
        plot_full(options);
    });
}
