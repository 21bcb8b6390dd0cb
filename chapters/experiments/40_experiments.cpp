// smoke: --quality draft
/// \file chapters/experiments/40_experiments.cpp
/// \brief Chapter 40: what rough glass loses, and visible normals against all normals.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include <ljus/materials/rough_glass.hpp>
#include <ljus/math/random.hpp>

#include "common/example.hpp"

namespace {

using Glass = ljus::RoughGlassT<double>;
using Vec3 = ljus::Vec3T<double>;

/// The weight of one sample of flux; 0 if it is lost.
double by_visible_normals(const Glass& glass, const Vec3& wo, const Vec3& u) {
    const auto next = sample(glass, wo, u, ljus::Transport::flux);
    return next ? next->weight.x : 0;
}

/// G1 of Smith for facets of GGX.
double smith(double alpha, const Vec3& w) {
    const double slope2 = (w.x * w.x + w.y * w.y) / (w.z * w.z); // tan^2(theta)
    return 2 / (1 + std::sqrt(1 + alpha * alpha * slope2));
}

/// The same by the facets as they lie, seen from above, as Walter et al. choose them.
/// \param wo  With z > 0.
double by_all_normals(const Glass& glass, const Vec3& wo, const Vec3& u) {
    const double alpha = glass.roughness * glass.roughness;
    const double slope = alpha * std::sqrt(u.y / (1 - u.y)); // tan(theta)
    const double phi = 2 * std::numbers::pi * u.x;
    const Vec3 h =
        glm::normalize(Vec3{slope * std::cos(phi), slope * std::sin(phi), 1});
    const double c = glm::dot(wo, h);
    if (!(c > 0)) return 0;
    const bool reflected = u.z < ljus::fresnel(c, 1.0, glass.index);
    const std::optional<Vec3> wi =
        reflected ? ljus::reflect(-wo, h) : ljus::refract(-wo, h, 1 / glass.index);
    if (!wi || (wi->z > 0) != reflected) return 0;
    const double g1 = smith(alpha, wo), g1_in = smith(alpha, *wi);
    const double g2 = reflected ? 1 / (1 / g1 + 1 / g1_in - 1) : g1 * g1_in;
    return c * g2 / (wo.z * h.z);
}

/// Statistics of weights.
struct Weights {
    double mean = 0, variance = 0, largest = 0;
};

/// The weights of many samples.
/// \param from  Returns wo for a point of the unit square.
template <typename From, typename Way>
Weights weights(const Glass& glass, int count, const From& from, const Way& way) {
    ljus::RandomStream stream = ljus::random_stream(40, ljus::Pass::user, 0, 0);
    Weights found;
    double squares = 0;
    for (int i = 0; i < count; ++i) {
        const Vec3 wo = from(next_2d<double>(stream));
        const double w = way(glass, wo, next_3d<double>(stream));
        found.mean += w / count;
        squares += w * w / count;
        found.largest = std::max(found.largest, w);
    }
    found.variance = squares - found.mean * found.mean;
    return found;
}

/// Light at 60 degrees from outside.
Vec3 at_sixty(const ljus::Vec2T<double>&) {
    return {std::sqrt(0.75), 0, 0.5};
}

/// Plot: the part of diffuse light that is lost.
void plot_loss(const examples::Options& options, int count) {
    examples::Plot plot{.name = "rough_glass-loss",
                        .columns = {"roughness", "from outside", "from inside"},
                        .y_label = "lost part of diffuse light",
                        .more = "set key inside left top\nset yrange [0:0.7]\n"};
    for (int percent = 5; percent <= 100; percent += 5) {
        const Glass glass{.roughness = 0.01 * percent};
        const auto lost = [&](double side) {
            const auto from = [&](const ljus::Vec2T<double>& u) {
                const Vec3 w = ljus::sample_cosine_hemisphere(u);
                return Vec3{w.x, w.y, side * w.z};
            };
            return 1 - weights(glass, count, from, by_visible_normals).mean;
        };
        plot.rows.push_back({glass.roughness, lost(1), lost(-1)});
    }
    save_plot(options.path(""), plot);
}

/// Plot: the variance of the weight over roughness.
void plot_sampling(const examples::Options& options, int count) {
    examples::Plot plot{.name = "rough_glass-sampling",
                        .columns = {"roughness", "visible normals", "all normals"},
                        .y_label = "variance of the weight at 60°",
                        .log_y = true,
                        .more = "set key inside left top\n"};
    for (int percent = 5; percent <= 100; percent += 5) {
        const Glass glass{.roughness = 0.01 * percent};
        plot.rows.push_back(
            {glass.roughness,
             weights(glass, count, at_sixty, by_visible_normals).variance,
             weights(glass, count, at_sixty, by_all_normals).variance});
    }
    save_plot(options.path(""), plot);
}

/// Table: both ways to sample, at equal rays and in time.
void tabulate_trade(const examples::Options& options, int count) {
    examples::Table table{.name = "rough_glass-trade",
                          .columns = {"normals and roughness", "mean", "variance",
                                      "largest weight", "ns"}};
    const auto add = [&](const char* name, double roughness, const auto& way) {
        const Glass glass{.roughness = roughness};
        const Weights found = weights(glass, count, at_sixty, way);
        constexpr int calls = 4096;
        const double ns = examples::nanoseconds_a_call(
            double(calls), [&] { return weights(glass, calls, at_sixty, way).mean; });
        table.rows.push_back({name, examples::text(found.mean, "%.3f"),
                              examples::text(found.variance, "%.4f"),
                              examples::text(found.largest, "%.3g"),
                              examples::text(ns, "%.0f")});
    };
    add("visible 0.3", 0.3, by_visible_normals);
    add("all 0.3", 0.3, by_all_normals);
    add("visible 0.7", 0.7, by_visible_normals);
    add("all 0.7", 0.7, by_all_normals);
    examples::print_table(table);
    examples::save_table(options.path(""), table);
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 40, rough glass: what it loses, and how it is sampled.");
        const examples::Options options = line.parse({});
        const int count = options.pick(20000, 500000, 5000000);
        plot_loss(options, count);
        plot_sampling(options, count);
        tabulate_trade(options, count);
    });
}
