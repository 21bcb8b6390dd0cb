// smoke: --quality draft --width 24 --height 16 --rays 1
/// \file chapters/experiments/12_experiments.cpp
/// \brief Chapter 12: the experiments behind its tables and plots: Schlick's formula
/// beside the exact one, and whether a picture shows the difference.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>

#include "common/example.hpp"

namespace {

using ljus::FresnelModel;
using ljus::Quad;
using ljus::Rgb;
using ljus::Sphere;
using ljus::Vec3;

double cosine(double degrees) {
    return std::cos(degrees * std::numbers::pi / 180);
}

/// Schlick's formula as printed: with the angle of the incoming light, on either side.
double as_printed(double cos_theta, double n_i, double n_t) {
    return ljus::schlick(ljus::schlick_r0(n_i, n_t), cos_theta);
}

/// Plot: the reflectance of glass against the angle, from outside and from inside.
void plot_glass(const std::string& folder) {
    examples::Plot plot{.name = "fresnel-glass",
                        .columns = {"angle in degrees", "exact into glass",
                                    "Schlick into glass", "exact out of glass",
                                    "Schlick out of glass: thin side's angle",
                                    "Schlick out of glass: as printed"},
                        .y_label = "reflectance, n = 1.5"};
    for (int i = 0; i <= 180; ++i) {
        const double angle = i / 2.0, c = i == 180 ? 0.0 : cosine(angle);
        plot.rows.push_back(
            {angle, ljus::fresnel(c, 1.0, 1.5), ljus::schlick_dielectric(c, 1.0, 1.5),
             ljus::fresnel(c, 1.5, 1.0), ljus::schlick_dielectric(c, 1.5, 1.0),
             as_printed(c, 1.5, 1.0)});
    }
    save_plot(folder, plot);
}

/// Plot: the reflectance of gold in three channels against the angle, exact and by
/// Schlick's formula.
void plot_metals(const std::string& folder) {
    examples::Plot plot{.name = "fresnel-metals",
                        .columns = {"angle in degrees", "gold at 620 nm",
                                    "gold at 539 nm", "gold at 459 nm",
                                    "Schlick at 620 nm", "Schlick at 539 nm",
                                    "Schlick at 459 nm"},
                        .y_label = "reflectance of gold",
                        .more = "set yrange [0.3:1]\n"};
    const auto pass_through = ljus::fresnel_conductor(1.0, ljus::gold<double>);
    for (int i = 0; i <= 180; ++i) {
        const double angle = i / 2.0, c = i == 180 ? 0.0 : cosine(angle);
        const auto exact = ljus::fresnel_conductor(c, ljus::gold<double>);
        plot.rows.push_back(
            {angle, exact.x, exact.y, exact.z, ljus::schlick(pass_through.x, c),
             ljus::schlick(pass_through.y, c), ljus::schlick(pass_through.z, c)});
    }
    save_plot(folder, plot);
}

/// The errors of Schlick's formula, by direction and by the angle that it takes.
struct Errors {
    double into = 0;    ///< Into the denser medium.
    double out = 0;     ///< Out of it, by the angle on the thin side.
    double printed = 0; ///< Out of it, by the incoming angle.
};

/// The largest errors over all angles for an index.
Errors largest_errors(double n) {
    Errors errors;
    for (int i = 0; i <= 2000; ++i) {
        const double c = i / 2000.0;
        const double into = ljus::fresnel(c, 1.0, n), out = ljus::fresnel(c, n, 1.0);
        const auto raise = [](double& error, double a, double b) {
            error = std::max(error, std::abs(a - b));
        };
        raise(errors.into, ljus::schlick_dielectric(c, 1.0, n), into);
        raise(errors.out, ljus::schlick_dielectric(c, n, 1.0), out);
        raise(errors.printed, as_printed(c, n, 1.0), out);
    }
    return errors;
}

/// Plot: the largest error of Schlick's formula against the index.
void plot_errors(const std::string& folder) {
    examples::Plot plot{.name = "fresnel-error",
                        .columns = {"index n", "into the medium",
                                    "out of it: thin side's angle",
                                    "out of it: as printed"},
                        .y_label = "largest error of Schlick's formula",
                        .log_y = true};
    for (int i = 0; i <= 60; ++i) {
        const double n = 1 + 0.05 * i + (i == 0 ? 0.01 : 0);
        const Errors errors = largest_errors(n);
        plot.rows.push_back({n, errors.into, errors.out, errors.printed});
    }
    save_plot(folder, plot);
}

/// Glass that reflects the same fraction at every angle, as in the report's program,
/// whose half vector is the normal.
struct FlatGlass {
    using Scalar = float; ///< The precision.
    float index = 1.5f;   ///< Of refraction.
};
ljus::Lobes lobes(const FlatGlass&) {
    return ljus::Lobes::specular;
}
Rgb evaluate(const FlatGlass&, const Vec3&, const Vec3&) {
    return Rgb{0};
}
float pdf(const FlatGlass&, const Vec3&, const Vec3&, ljus::Lobes = ljus::Lobes::all) {
    return 0;
}
void check(const FlatGlass&) {}
// [flat glass]
std::optional<ljus::BsdfSample> sample(const FlatGlass& glass, const Vec3& wo,
                                       const Vec3& u, ljus::Transport transport,
                                       ljus::Lobes which = ljus::Lobes::all) {
    if (!has(which, ljus::Lobes::specular) || wo.z == 0) return std::nullopt;
    const float eta = wo.z > 0 ? 1 / glass.index : glass.index;
    const auto refracted = ljus::refract(wo, eta);
    const Vec3 half = glm::normalize(wo + ljus::reflect(wo)); // (0, 0, 1) or (0, 0, -1)
    const float cos_theta = std::abs(half.z);
    const float r = ljus::schlick(ljus::schlick_r0(1.0f, glass.index), cos_theta);
    if (!refracted || u.z < r) return ljus::specular_sample(ljus::reflect(wo), Rgb{1});
    const float scale = transport == ljus::Transport::radiance ? eta * eta : 1.0f;
    return ljus::specular_sample(*refracted, Rgb{scale});
}
// [flat glass]

/// Three balls of glass between two bright walls.
template <typename Material>
ljus::Image picture(const std::string& name, const Material& glass,
                    const examples::Options& options) {
    const auto matt = [](float r, float g, float b) {
        return ljus::Lambertian{.albedo{r, g, b}};
    };
    const ljus::World world(ljus::make_scene(
        placed(Quad{{-4, 0, 4}, {8, 0, 0}, {0, 0, -8}}, matt(0.12f, 0.12f, 0.14f)),
        placed(Quad{{-4, 0, -4}, {8, 0, 0}, {0, 5, 0}}, matt(0.1f, 0.16f, 0.25f)),
        placed(Quad{{-4, 0, 4}, {0, 0, -8}, {0, 5, 0}}, matt(0, 0, 0), Rgb{1}),
        placed(Quad{{4, 0, 4}, {0, 5, 0}, {0, 0, -8}}, matt(0, 0, 0), Rgb{1}),
        placed(Quad{{-4, 0, 4}, {0, 5, 0}, {8, 0, 0}}, matt(0.2f, 0.2f, 0.2f)),
        placed(Quad{{-4, 5, -4}, {8, 0, 0}, {0, 0, 8}}, matt(0.3f, 0.3f, 0.3f)),
        placed(Sphere{.center{-1.7f, 0.8f, 0}, .radius = 0.8f}, glass),
        placed(Sphere{.center{0, 0.8f, -0.4f}, .radius = 0.8f}, glass),
        placed(Sphere{.center{1.7f, 0.8f, 0}, .radius = 0.8f}, glass)));
    const auto camera = ljus::look_at(
        {.position{0, 1.5f, 3.9f}, .target{0, 0.85f, 0}, .vfov_degrees = 42});
    return examples::rendered(name, ljus::PathTracer(world), camera, options).image;
}

/// Nanoseconds per call, the best of 21 runs over random angles and both directions.
template <typename Formula>
double nanoseconds(Formula formula) {
    std::vector<float> cosines;
    ljus::RandomStream stream = ljus::random_stream(10, ljus::Pass::camera, 0, 0);
    for (int i = 0; i < 4096; ++i) cosines.push_back(next_1d<float>(stream));
    return examples::nanoseconds_a_call(20.0 * double(cosines.size()), [&] {
        float sum = 0;
        for (int round = 0; round < 20; ++round)
            for (std::size_t i = 0; i < cosines.size(); i += 2)
                sum += formula(cosines[i], 1.0f, 1.5f) +
                       formula(cosines[i + 1], 1.5f, 1.0f);
        return sum;
    });
}

/// Pictures, and the table: what each model costs and what it changes.
void tabulate_trade(const examples::Options& options) {
    const auto glass = [](FresnelModel model) {
        return ljus::Glass{.index = 1.5f, .fresnel = model};
    };
    const ljus::Image exact = picture("exact", glass(FresnelModel::exact), options);
    examples::Options other = options; // the noise of exact against exact
    other.seed = options.seed + 1;
    const ljus::Image again = picture("again", glass(FresnelModel::exact), other);
    const ljus::Image schlick =
        picture("Schlick", glass(FresnelModel::schlick), options);
    const ljus::Image flat = picture("flat", FlatGlass{}, options);
    save_png(exact, options.path("fresnel-exact.png"));
    save_png(flat, options.path("fresnel-flat.png"));

    const auto row = [&](const char* name, double time, double into, double out,
                         const ljus::Image& image) {
        std::vector<std::string> cells{
            name,
            examples::text(time, "%.1f"),
            examples::text(into, "%.2g"),
            examples::text(out, "%.2g"),
            examples::text(ljus::rel_mse(image, exact), "%.2g"),
            examples::text(ljus::block_error(image, exact), "%.2g")};
        examples::print_row(cells, 26);
        return cells;
    };
    const Errors errors = largest_errors(1.5);
    const auto flat_error = 1 - ljus::schlick_r0(1.0, 1.5);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto by = [](FresnelModel model) {
        return [model](float c, float n_i, float n_t) {
            return model == FresnelModel::exact ? ljus::fresnel(c, n_i, n_t)
                                                : ljus::schlick_dielectric(c, n_i, n_t);
        };
    };
    examples::save_table(
        options.path(""),
        {.name = "fresnel-trade",
         .columns = {"", "ns", "error, into", "error, out", "relMSE of the picture",
                     "error of its 10x10 blocks"},
         .rows = {row("exact", nanoseconds(by(FresnelModel::exact)), 0, 0, exact),
                  row("exact, another seed", nan, nan, nan, again),
                  row("Schlick", nanoseconds(by(FresnelModel::schlick)), errors.into,
                      errors.out, schlick),
                  row("the same at every angle", nan, flat_error, flat_error, flat)}});
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about(
            "Chapter 12, Fresnel: the formulas compared, on paper and in a picture.");
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 150, .samples = 36},
                        .report{.width = 600, .height = 300, .samples = 100},
                        .reference{.width = 900, .height = 450, .samples = 4096}});
        const std::string folder = options.path("");
        plot_glass(folder);
        plot_metals(folder);
        plot_errors(folder);
        tabulate_trade(options);
    });
}
