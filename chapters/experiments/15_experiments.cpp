// smoke: --quality draft --width 32 --height 8 --rays 1
/// \file chapters/experiments/15_experiments.cpp
/// \brief Chapter 15: the experiments behind its tables and pictures: furnaces, what each
/// material costs, and two mistakes.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

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
            examples::nanoseconds([&](const Vec3& wo, const Vec3& wi, Vec3) {
                return evaluate(material_at(material, wi, ljus::Vec2{0}), wo, wi).x;
            });
        const double sampling =
            examples::nanoseconds([&](const Vec3& wo, Vec3, const Vec3& u) {
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
        line.about("Chapter 15, materials: furnaces, and what each material costs.");
        const examples::Options options =
            line.parse({.draft{.width = 600, .height = 150, .samples = 25},
                        .report{.width = 1200, .height = 300, .samples = 64},
                        .reference{.width = 1600, .height = 400, .samples = 2048}});
        tabulate_furnace(options);
        tabulate_trade(options);
        picture_mistakes(options);
    });
}
