// smoke: --quality draft --width 24 --height 24 --rays 1
/// \file chapters/experiments/14_experiments.cpp
/// \brief Chapter 14: the experiments behind its tables and plots: six models of rough
/// surfaces, and the fraction of a white sky that they reflect.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>

#include "common/example.hpp"

namespace {

using ljus::Image;
using ljus::Rgb;
using ljus::RoughModel;
using ljus::Sphere;
using ljus::Vec3;
using ljus::Vec3T;

template <typename T>
ljus::RoughDiffuseT<T> rough(RoughModel model, T albedo, T sigma) {
    return {ljus::RgbT<T>{albedo}, sigma, model};
}

/// A ball of one material; the lamp stands behind the camera, and there is no other
/// light.
template <typename Material>
Image ball(const examples::Options& options, const std::string& name,
           const Material& material) {
    const ljus::World world(
        ljus::make_scene(placed(Sphere{.center{0, 0, 0}, .radius = 1}, material),
                         placed(Sphere{.center{-4, 5, 9}, .radius = 1.2f},
                                ljus::Lambertian{.albedo = Rgb{0}}, Rgb{60})));
    const auto camera =
        ljus::look_at({.position{0, 0, 6}, .target{0, 0, 0}, .vfov_degrees = 21});
    const ljus::PathTracer tracer(world, {.max_depth = 1});
    return examples::rendered(name, tracer, camera, options).image;
}

/// Table: how little the pictures of figure 14 change with the report's roughnesses.
void tabulate_saturation(const examples::Options& options) {
    std::vector<Image> report;
    for (const float sigma : {0.0f, 1.0f, 10.0f, 100.0f})
        report.push_back(
            ball(options, "figure 14", rough(RoughModel::as_printed, 0.8f, sigma)));

    examples::Table table{.name = "fig-14-saturation",
                          .columns = {"roughness", "A", "B",
                                      "relMSE to the next picture",
                                      "largest difference of a channel in the PNG"},
                          .rows = {}};
    const double sigmas[] = {0, 1, 10, 100};
    for (std::size_t i = 0; i < 4; ++i) {
        const double s2 = sigmas[i] * sigmas[i];
        std::string error, levels;
        if (i + 1 < 4) {
            error = examples::text(ljus::rel_mse(report[i], report[i + 1]), "%.1e");
            double largest = 0;
            for (std::size_t k = 0; k < report[i].pixels.size(); ++k)
                for (int c = 0; c < 3; ++c)
                    largest = std::max(
                        largest,
                        std::abs(
                            double(ljus::srgb_byte(double(report[i].pixels[k][c]))) -
                            double(
                                ljus::srgb_byte(double(report[i + 1].pixels[k][c])))));
            levels = examples::text(largest, "%.0f of 255");
        }
        table.rows.push_back({examples::text(sigmas[i], "%.0f"),
                              examples::text(1 - s2 / (2 * (s2 + 0.57)), "%.4f"),
                              examples::text(0.45 * s2 / (s2 + 0.09), "%.4f"), error,
                              levels});
        examples::print_row(table.rows.back(), 12);
    }
    examples::save_table(options.path(""), table);
}

/// The fraction of a constant sky that a surface returns, by a grid of directions.
template <typename Material>
double albedo(const Material& material, double degrees, int size) {
    const double theta = degrees * std::numbers::pi / 180;
    const Vec3T<double> wo{std::sin(theta), 0, std::cos(theta)};
    double sum = 0;
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) {
            const double sin2 = (i + 0.5) / size;
            const double phi = 2 * std::numbers::pi * (j + 0.5) / size;
            const double s = std::sqrt(sin2);
            const Vec3T<double> wi{s * std::cos(phi), s * std::sin(phi),
                                   std::sqrt(1 - sin2)};
            sum += evaluate(material, wo, wi).x;
        }
    return sum * std::numbers::pi / size / size;
}

/// Plot: that fraction against the angle, for each model at roughness 0.7.
void plot_albedo(const std::string& folder, int size) {
    examples::Plot plot{.name = "oren_nayar-albedo",
                        .columns = {"angle in degrees", "as the report's program",
                                    "qualitative 1994", "full 1994", "Fujii's first",
                                    "Fujii's second", "EON"},
                        .y_label = "share of a white sky that white returns",
                        .more = "set yrange [0.6:1.1]\n"};
    constexpr double sigma = 0.7;
    for (int angle = 0; angle <= 88; angle += 4) {
        const auto of = [&](const auto& material) {
            return albedo(material, angle, size);
        };
        plot.rows.push_back({double(angle),
                             of(rough(RoughModel::as_printed, 1.0, sigma)),
                             of(ljus::OrenNayarT<double>{ljus::RgbT<double>{1}, sigma}),
                             of(rough(RoughModel::full, 1.0, sigma)),
                             of(rough(RoughModel::fujii, 1.0, sigma)),
                             of(rough(RoughModel::fon, 1.0, sigma)),
                             of(ljus::EonT<double>{ljus::RgbT<double>{1}, sigma})});
    }
    save_plot(folder, plot);
}

/// Plot: the radiance of a ball that is seen from the lamp, against the angle.
void plot_retroreflection(const std::string& folder) {
    examples::Plot plot{.name = "oren_nayar-front",
                        .columns = {"angle in degrees", "Lambert", "qualitative 1994",
                                    "full 1994", "EON"},
                        .y_label = "radiance, over that of a Lambertian at 0°"};
    const auto radiance = [](const auto& material, double degrees) {
        const double theta = degrees * std::numbers::pi / 180;
        const Vec3T<double> w{std::sin(theta), 0, std::cos(theta)};
        return evaluate(material, w, w).x * w.z * std::numbers::pi / 0.8;
    };
    const ljus::RgbT<double> grey{0.8};
    for (int angle = 0; angle <= 88; angle += 2)
        plot.rows.push_back({double(angle),
                             radiance(ljus::LambertianT<double>{grey}, angle),
                             radiance(ljus::OrenNayarT<double>{grey, 0.7}, angle),
                             radiance(rough(RoughModel::full, 0.8, 0.7), angle),
                             radiance(ljus::EonT<double>{grey, 0.7}, angle)});
    save_plot(folder, plot);
}

/// Nanoseconds to evaluate, the best of 21 runs over random directions.
template <typename Material>
double nanoseconds(const Material& material) {
    std::vector<Vec3> directions;
    ljus::RandomStream stream = ljus::random_stream(12, ljus::Pass::user, 0, 0);
    for (int i = 0; i < 4096; ++i)
        directions.push_back(ljus::sample_cosine_hemisphere(next_2d<float>(stream)));
    return examples::nanoseconds_a_call(8.0 * double(directions.size()), [&] {
        float sum = 0;
        for (int round = 0; round < 8; ++round)
            for (std::size_t i = 1; i < directions.size(); ++i)
                sum += evaluate(material, directions[i - 1], directions[i]).x;
        return sum;
    });
}

/// The weights of many samples, by which a path's throughput is multiplied; 0 for a
/// sample that fails.
template <typename Material>
std::vector<double> weights(const Material& material, double degrees, int count) {
    const double theta = degrees * std::numbers::pi / 180;
    const Vec3 wo(Vec3T<double>{std::sin(theta), 0, std::cos(theta)});
    ljus::RandomStream stream = ljus::random_stream(13, ljus::Pass::user, 0, 0);
    std::vector<double> list;
    for (int i = 0; i < count; ++i) {
        const auto s =
            sample(material, wo, next_3d<float>(stream), ljus::Transport::radiance);
        list.push_back(s ? double(s->weight.x) : 0.0);
    }
    return list;
}

/// Their variance.
template <typename Material>
double weight_variance(const Material& material, double degrees) {
    constexpr int count = 200000;
    double sum = 0, squares = 0;
    for (const double weight : weights(material, degrees, count)) {
        sum += weight;
        squares += weight * weight;
    }
    return squares / count - (sum / count) * (sum / count);
}

/// Nanoseconds to draw a sample, the best of 21 runs.
template <typename Material>
double nanoseconds_a_sample(const Material& material, double degrees) {
    constexpr int count = 16384;
    return examples::nanoseconds_a_call(count, [&] {
        const auto list = weights(material, degrees, count);
        return float(list.back());
    });
}

/// The root mean square error of the means of n values each; the truth is 1.
double error_of_means(const std::vector<double>& values, std::size_t n) {
    double squares = 0;
    std::size_t means = 0;
    for (std::size_t i = 0; i + n <= values.size(); i += n, ++means) {
        double mean = 0;
        for (std::size_t k = i; k < i + n; ++k) mean += values[k] / double(n);
        squares += (mean - 1) * (mean - 1);
    }
    return std::sqrt(squares / double(means));
}

/// Plot: error against time of what a white surface returns of a white sky at 75
/// degrees, by 1 to 4096 samples.
void plot_trade(const examples::Options& options) {
    constexpr float sigma = 0.7f;
    examples::Plot plot{.name = "oren_nayar-error",
                        .columns = {"nanoseconds for all samples"},
                        .y_label = "rms error of the radiance",
                        .log_x = true,
                        .log_y = true,
                        .more = "set yrange [1e-3:1]\n"};
    const int count = options.pick(1 << 16, 1 << 18, 1 << 20);
    constexpr std::size_t models = 4;
    const auto add = [&](const char* name, const auto& white) {
        const double ns = nanoseconds_a_sample(white, 75);
        const auto values = weights(white, 75, count);
        plot.columns.emplace_back(name);
        for (std::size_t n = 1; n <= 4096; n *= 4) {
            examples::Row row(1 + models, std::nan(""));
            row[0] = ns * double(n);
            row[plot.columns.size() - 1] = error_of_means(values, n);
            plot.rows.push_back(row);
        }
    };
    add("as the report's program", rough(RoughModel::as_printed, 1.0f, sigma));
    add("qualitative 1994", ljus::OrenNayar{Rgb{1}, sigma});
    add("full 1994", rough(RoughModel::full, 1.0f, sigma));
    add("EON", ljus::Eon{Rgb{1}, sigma});
    save_plot(options.path(""), plot);
}

/// Table: what each model costs, returns, and changes in a picture.
void tabulate_trade(const examples::Options& options, int size) {
    constexpr float sigma = 0.7f;
    const Rgb grey{0.8f};
    const Image truth = ball(options, "eon for the table",
                             ljus::Eon{.albedo = grey, .roughness = sigma});
    examples::Table table{.name = "oren_nayar-trade",
                          .columns = {"model", "ns", "least and most of a white sky",
                                      "relMSE to EON", "variance at 75°"},
                          .rows = {}};
    const auto add = [&](const char* name, const auto& material, const auto& white) {
        double least = 2, most = 0;
        for (const double angle : {0.0, 30.0, 60.0, 75.0, 85.0, 88.0}) {
            const double share = albedo(white, angle, size);
            least = std::min(least, share);
            most = std::max(most, share);
        }
        const Image image = ball(options, name, material);
        table.rows.push_back(
            {name, examples::text(nanoseconds(material), "%.1f"),
             examples::text(least, "%.3f") + " to " + examples::text(most, "%.3f"),
             examples::text(ljus::rel_mse(image, truth), "%.1e"),
             examples::text(weight_variance(material, 75), "%.3f")});
        examples::print_row(table.rows.back(), 26);
    };
    const ljus::RgbT<double> one{1};
    const auto model = [&](const char* name, RoughModel which) {
        add(name, rough(which, 0.8f, sigma), rough(which, 1.0, double(sigma)));
    };
    add("Lambert", ljus::Lambertian{grey}, ljus::LambertianT<double>{one});
    model("as the report's program", RoughModel::as_printed);
    add("qualitative 1994", ljus::OrenNayar{grey, sigma},
        ljus::OrenNayarT<double>{one, double(sigma)});
    model("full 1994", RoughModel::full);
    model("Fujii's first", RoughModel::fujii);
    model("Fujii's second", RoughModel::fon);
    add("EON", ljus::Eon{grey, sigma}, ljus::EonT<double>{one, double(sigma)});
    examples::save_table(options.path(""), table);
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 14, rough surfaces: six models compared.");
        const examples::Options options =
            line.parse({.draft{.width = 140, .height = 140, .samples = 9},
                        .report{.width = 400, .height = 400, .samples = 64},
                        .reference{.width = 400, .height = 400, .samples = 1024}});
        const std::string folder = options.path("");
        const int size = options.pick(150, 600, 1500);
        tabulate_saturation(options);
        plot_albedo(folder, size);
        plot_retroreflection(folder);
        tabulate_trade(options, size);
        plot_trade(options);
    });
}
