// smoke: --quality draft --width 32 --height 8 --rays 1
/// \file chapters/experiments/15_experiments.cpp
/// \brief Chapter 15: the experiments behind its tables, plots and pictures: furnaces,
/// gloss from a mirror to satin, what each material costs, and two mistakes.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>

#include "common/example.hpp"

namespace {

using ljus::Image;
using ljus::Quad;
using ljus::Rgb;
using ljus::RgbT;
using ljus::Sphere;
using ljus::Vec3;
using ljus::Vec3T;

/// The materials of figure 4.
struct Row {
    ljus::Glass glass;       ///< Coloured by absorption.
    ljus::ThinGlass pane;    ///< A hollow ball.
    ljus::Eon rough;         ///< Clay.
    ljus::Mirror mirror;     ///< Without a tint.
    ljus::Lambertian matt;   ///< Of the colour of the clay.
    ljus::Metal metal;       ///< Polished gold.
    ljus::RoughMetal glossy; ///< Brushed copper.
    ljus::Textured<ljus::Lambertian, ljus::GlobeChecker> checker; ///< Two colours.
};

/// The materials in their usual colours.
Row colored_row() {
    const Rgb ochre{0.75f, 0.5f, 0.2f};
    return {
        .glass{.absorption = ljus::absorption_from_color(Rgb{0.55f, 0.9f, 0.7f}, 2.0f)},
        .pane{.tint{0.9f, 0.96f, 0.98f}},
        .rough{.albedo = ochre, .roughness = 1},
        .mirror{.reflectance = Rgb{0.98f}},
        .matt{.albedo = ochre},
        .metal{},
        .glossy{.reflectance = ljus::copper<float>, .roughness = 0.45f},
        .checker{{.albedo = Rgb{1}},
                 {.map{.center{8.4f, 1, 0}},
                  .even{0.85f, 0.85f, 0.8f},
                  .odd{0.1f, 0.2f, 0.5f},
                  .columns = 16,
                  .rows = 8}}};
}

/// The same, as white as they can be. Gold cannot be white; the brushed metal has so
/// large a k that each facet reflects all light, and shows what is lost between facets.
Row white_row() {
    Row row = colored_row();
    row.glass.absorption = Rgb{0};
    row.pane.tint = Rgb{1};
    row.rough.albedo = Rgb{1};
    row.mirror.reflectance = Rgb{1};
    row.matt.albedo = Rgb{1};
    row.glossy.reflectance = {Rgb{0}, Rgb{5}};
    row.checker.texture.even = row.checker.texture.odd = Rgb{1};
    return row;
}

/// Calls f(name, material) for each.
template <typename F>
void for_each(const Row& row, F f) {
    f("glass", row.glass);
    f("thin glass", row.pane);
    f("rough", row.rough);
    f("mirror", row.mirror);
    f("Lambert", row.matt);
    f("metal", row.metal);
    f("glossy", row.glossy);
    f("checker", row.checker);
}

/// The mean radiance of a ball under a sky of radiance 1, seen from far away.
template <typename Material>
Rgb furnace_albedo(const Material& material, int rays) {
    const ljus::World world(
        ljus::make_scene(placed(Sphere{.radius = 1000},
                                ljus::Lambertian{.albedo = Rgb{0}}, Rgb{1}, true),
                         placed(Sphere{.center{0, 0, 0}, .radius = 1}, material)));
    const auto camera = ljus::look_at(
        {.position{0, 0, 100}, .target{0, 0, 0}, .vfov_degrees = 1.1459f});
    const int size = 64;
    const auto image = render(ljus::PathTracer(world), camera,
                              {.width = size, .height = size, .samples = rays})
                           .image;
    Rgb sum{0};
    int count = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            if (std::hypot(x + 0.5 - size / 2, y + 0.5 - size / 2) < size / 2 - 1) {
                sum += pixel(image, x, y);
                ++count;
            }
    return sum / float(count);
}

/// Table: what each ball of figure 4 returns of a white sky.
void tabulate_furnace(const examples::Options& options) {
    examples::Table table{.name = "fig-4-furnace",
                          .columns = {"white sky"},
                          .rows = {{"as above"}, {"white"}}};
    const int rays = options.pick(16, 256, 1024);
    for_each(colored_row(), [&](const char* name, auto material) {
        table.columns.push_back(name);
        if constexpr (requires { material.texture.map.center; })
            material.texture.map.center = Vec3{0};
        const Rgb c = furnace_albedo(material, rays);
        table.rows[0].push_back(examples::text(ljus::luminance(c), "%.3f"));
    });
    for_each(white_row(), [&](const char*, const auto& material) {
        table.rows[1].push_back(
            examples::text(ljus::luminance(furnace_albedo(material, rays)), "%.3f"));
    });
    examples::print_rows(table, 11);
    examples::save_table(options.path(""), table);
}

/// The picture of a ball on a floor between two walls, under a lamp.
template <typename Material>
Image ball_picture(int size, int rays, std::uint64_t seed, const Material& material,
                   int threads = 0) {
    const auto matt = [](float r, float g, float b) {
        return ljus::Lambertian{.albedo{r, g, b}};
    };
    const ljus::World world(ljus::make_scene(
        placed(Quad{{-4, 0, 6}, {8, 0, 0}, {0, 0, -10}}, matt(0.4f, 0.4f, 0.4f)),
        placed(Quad{{-4, 0, -4}, {8, 0, 0}, {0, 6, 0}}, matt(0.5f, 0.5f, 0.5f)),
        placed(Quad{{-4, 0, 6}, {0, 0, -10}, {0, 6, 0}}, matt(0.6f, 0.2f, 0.1f)),
        placed(Quad{{4, 0, 6}, {0, 6, 0}, {0, 0, -10}}, matt(0.1f, 0.3f, 0.6f)),
        placed(Quad{{-4, 6, -4}, {8, 0, 0}, {0, 0, 10}}, matt(0.6f, 0.6f, 0.6f)),
        placed(Quad{{-4, 0, 6}, {0, 6, 0}, {8, 0, 0}}, matt(0.5f, 0.5f, 0.5f)),
        placed(Quad{{-1, 5.9f, 0}, {2, 0, 0}, {0, 0, 2}}, matt(0, 0, 0), Rgb{20}),
        placed(Sphere{.center{0, 1, 0}, .radius = 1}, material)));
    const auto camera =
        ljus::look_at({.position{0, 2, 5.5f}, .target{0, 1, 0}, .vfov_degrees = 28});
    return render(ljus::PathTracer(world), camera,
                  {.width = size,
                   .height = size,
                   .samples = rays,
                   .seed = seed,
                   .threads = threads})
        .image;
}

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
        save("materials-gloss-" + std::to_string(percent), gold(percent));
    save("materials-full-100", compensated_glossy(gold(100)));
}

/// The mean and the variance of a sample's weight.
struct Weights {
    double mean = 0;     ///< The albedo at the angle.
    double variance = 0; ///< By which the variance of a path grows.
};

/// Both over many samples at an angle.
template <typename Sampler>
Weights weights(double degrees, int count, Sampler sampler) {
    const double theta = degrees * std::numbers::pi / 180;
    const Vec3 wo(Vec3T<double>{std::sin(theta), 0, std::cos(theta)});
    ljus::RandomStream stream = ljus::random_stream(13, ljus::Pass::user, 0, 0);
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
        const double weight = sampler(wo, next_3d<float>(stream));
        sum += weight;
        squares += weight * weight;
    }
    const double mean = sum / count;
    return {mean, std::max(0.0, squares / count - mean * mean)};
}

/// The weight of a material's own sample.
template <typename Material>
auto own_sampler(const Material& material) {
    return [material](const Vec3& wo, const Vec3& u) {
        const auto s = sample(material, wo, u, ljus::Transport::flux);
        return s ? double(s->weight.x) : 0.0;
    };
}

/// Plots: how much light white gloss loses, and how much its sampler matters.
void plot_gloss(const std::string& folder, int count) {
    examples::Plot loss{.name = "materials-loss",
                        .columns = {"roughness", "straight on", "60 degrees",
                                    "80 degrees", "88 degrees"},
                        .y_label = "share of a white sky that white returns",
                        .more = "set yrange [0:1.05]\nset key inside left bottom\n"};
    examples::Plot noise{
        .name = "materials-sampling",
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

/// Nanoseconds per call of f(wo, wi, u), the best of 21 runs.
template <typename F>
double nanoseconds(F f) {
    std::vector<Vec3> wo, u;
    ljus::RandomStream stream = ljus::random_stream(12, ljus::Pass::user, 0, 0);
    for (int i = 0; i < 4096; ++i) {
        wo.push_back(ljus::sample_cosine_hemisphere(next_2d<float>(stream)));
        u.push_back(next_3d<float>(stream));
    }
    return examples::nanoseconds_a_call(4.0 * double(wo.size()), [&] {
        float sum = 0;
        for (int round = 0; round < 4; ++round)
            for (std::size_t i = 1; i < wo.size(); ++i)
                sum += f(wo[i], wo[i - 1], u[i]);
        return sum;
    });
}

/// Table: the time and the noise of each material.
void tabulate_trade(const examples::Options& options) {
    examples::Table table{.name = "materials-trade",
                          .columns = {"material", "evaluate, ns", "sample, ns",
                                      "variance of the weight at 60°", "µs per path",
                                      "relMSE of 16 rays"},
                          .rows = {}};
    const int size = options.pick(48, 96, 192);
    const auto add = [&](const char* name, const auto& material) {
        const double evaluating =
            nanoseconds([&](const Vec3& wo, const Vec3& wi, Vec3) {
                return evaluate(material_at(material, wi, ljus::Vec2{0}), wo, wi).x;
            });
        const double sampling = nanoseconds([&](const Vec3& wo, Vec3, const Vec3& u) {
            const auto s = sample(material_at(material, wo, ljus::Vec2{0}), wo, u,
                                  ljus::Transport::radiance);
            return s ? s->wi.x : 0.0f;
        });
        const auto timed = [&](std::uint64_t seed, double& seconds) {
            const examples::StopWatch watch;
            Image image = ball_picture(size, 16, seed, material, 1);
            seconds = std::min(seconds, watch.seconds());
            return image;
        };
        double seconds = std::numeric_limits<double>::infinity();
        const Image a = timed(1, seconds), b = timed(2, seconds);
        const double micro = seconds * 1e6 / (16.0 * size * size);
        table.rows.push_back(
            {name, examples::text(evaluating, "%.1f"), examples::text(sampling, "%.1f"),
             examples::text(weights(60, 100000, own_sampler(material)).variance,
                            "%.3f"),
             examples::text(micro, "%.2f"),
             examples::text(ljus::rel_mse(a, b) / 2, "%.2g")});
        examples::print_row(table.rows.back(), 22);
        examples::stop_if_asked();
    };
    const Row row = colored_row();
    add("Lambert", row.matt);
    add("Lambert, checkered", row.checker);
    add("Oren-Nayar", ljus::OrenNayar{.albedo = row.matt.albedo, .sigma = 0.7f});
    add("EON", row.rough);
    add("mirror", row.mirror);
    add("metal", row.metal);
    add("glass", row.glass);
    add("thin glass", row.pane);
    add("gloss of a colour, 0.45",
        ljus::Glossy{.reflectance = row.matt.albedo, .roughness = 0.45f});
    add("gloss of copper, 0.45", row.glossy);
    add("full gloss of copper, 0.45", compensated_glossy(row.glossy));
    add("the report's sliders", ljus::Mixture{.color = row.matt.albedo,
                                              .reflectivity = 0.2f,
                                              .specularity = 1});
    examples::save_table(options.path(""), table);
}

/// Table and picture: gloss that loses light, and gloss that keeps it.
void compare_full(const examples::Options& options) {
    examples::Table table{.name = "materials-full",
                          .columns = {"roughness", "white gloss returns", "full gloss",
                                      "sample, ns", "full, ns", "error of 10x10 blocks",
                                      "of it noise"},
                          .rows = {}};
    const int size = options.pick(48, 150, 300), rays = options.pick(25, 400, 4000);
    const auto sampling = [](const auto& material) {
        return nanoseconds([&](const Vec3& wo, Vec3, const Vec3& u) {
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
        .name = "materials-error",
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

/// What can go wrong with a diffuse surface.
enum class Mistake { none, missing_pi, doubled_cosine };

/// Lambert's surface with a mistake.
struct WrongMatt {
    using Scalar = float;            ///< The precision.
    Rgb albedo{0.5f};                ///< Of Lambert's surface.
    Mistake mistake = Mistake::none; ///< Which.
};
ljus::Lobes lobes(const WrongMatt&) {
    return ljus::Lobes::diffuse;
}
// [mistakes]
Rgb evaluate(const WrongMatt& matt, const Vec3& wo, const Vec3& wi) {
    if (!ljus::same_side(wo, wi)) return Rgb{0};
    if (matt.mistake == Mistake::missing_pi) return matt.albedo;
    const bool twice = matt.mistake == Mistake::doubled_cosine;
    const float again = twice ? std::abs(wi.z) : 1.0f;
    return matt.albedo * again * std::numbers::inv_pi_v<float>;
}
// [mistakes]
float pdf(const WrongMatt&, const Vec3& wo, const Vec3& wi,
          ljus::Lobes which = ljus::Lobes::all) {
    return ljus::pdf_cosine_lobe(wo, wi, which);
}
std::optional<ljus::BsdfSample> sample(const WrongMatt& matt, const Vec3& wo,
                                       const Vec3& u, ljus::Transport,
                                       ljus::Lobes which = ljus::Lobes::all) {
    auto next = ljus::sample_cosine_lobe(wo, u, which);
    if (next) next->weight = evaluate(matt, wo, next->wi) * std::numbers::pi_v<float>;
    return next;
}
void check(const WrongMatt&) {}

/// Pictures: the same room with each mistake. There are three surfaces on a path,
/// because with the first mistake light grows from wall to wall.
void picture_mistakes(const examples::Options& options) {
    const int size = options.pick(200, 400, 500), rays = options.pick(16, 256, 2048);
    const auto picture = [&](const std::string& name, Mistake mistake) {
        const auto matt = [&](float r, float g, float b) {
            return WrongMatt{{r, g, b}, mistake};
        };
        const ljus::World world(ljus::make_scene(
            placed(Quad{{-2, 0, 5}, {4, 0, 0}, {0, 0, -7}}, matt(0.6f, 0.6f, 0.6f)),
            placed(Quad{{-2, 0, -2}, {4, 0, 0}, {0, 4, 0}}, matt(0.6f, 0.6f, 0.6f)),
            placed(Quad{{-2, 0, 5}, {0, 0, -7}, {0, 4, 0}}, matt(0.6f, 0.1f, 0.05f)),
            placed(Quad{{2, 0, 5}, {0, 4, 0}, {0, 0, -7}}, matt(0.1f, 0.4f, 0.1f)),
            placed(Quad{{-2, 4, -2}, {4, 0, 0}, {0, 0, 7}}, matt(0.6f, 0.6f, 0.6f)),
            placed(Quad{{-0.6f, 3.95f, -0.6f}, {1.2f, 0, 0}, {0, 0, 1.2f}},
                   matt(0, 0, 0), Rgb{10}),
            placed(Sphere{.center{0, 1, 0}, .radius = 1}, matt(0.75f, 0.5f, 0.2f))));
        const auto camera = ljus::look_at(
            {.position{0, 2, 8.5f}, .target{0, 1.9f, 0}, .vfov_degrees = 30});
        examples::ProgressBar bar(name, options.quiet);
        const auto result = render(ljus::PathTracer(world, {.max_depth = 3}), camera,
                                   {.width = size,
                                    .height = size,
                                    .samples = rays,
                                    .seed = options.seed,
                                    .threads = options.threads,
                                    .progress = bar});
        examples::stop_if_asked();
        save_png(result.image, options.path(name + ".png"));
    };
    picture("materials-right", Mistake::none);
    picture("materials-no-pi", Mistake::missing_pi);
    picture("materials-two-cosines", Mistake::doubled_cosine);
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about(
            "Chapter 15, materials: furnaces, gloss, and what each material costs.");
        const examples::Options options =
            line.parse({.draft{.width = 600, .height = 150, .samples = 25},
                        .report{.width = 1200, .height = 300, .samples = 64},
                        .reference{.width = 1600, .height = 400, .samples = 2048}});
        tabulate_furnace(options);
        sweep_roughness(options);
        plot_gloss(options.path(""), options.pick(20000, 200000, 1000000));
        tabulate_trade(options);
        compare_full(options);
        plot_full(options);
        picture_mistakes(options);
    });
}
