// smoke: --quality draft --width 20 --height 20 --seeds 4 --most 256
/// \file chapters/experiments/03_experiments.cpp
/// \brief Chapter 3: the experiments behind its tables and plots: one idea after the
/// other, on an integral whose value is known; and how errors are measured.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/image/flip.hpp>
#include <ljus/inspect/estimate.hpp>
#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>
#include <ljus/math/stratified_stream.hpp>
#include <ljus/optics/schlick.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/convergence.hpp"
#include "common/plot.hpp"
#include "common/terminal.hpp"
#include "experiments/glass_integral.hpp"

namespace {

using namespace examples::glass; // f, its truth, the ways to draw
using examples::text;
using ljus::Estimate;
using ljus::Image;
using ljus::Rgb;

constexpr double pi = std::numbers::pi;

/// The options of this program, besides the common ones.
struct Sizes {
    int seeds = 0; ///< Runs behind each error.
    int most = 0;  ///< Samples of a run, at most.
};

// --- The integral ---------------------------------------------------------------------

/// A density in steps, each as high as f in its middle.
struct Table {
    static constexpr std::size_t steps = 32;
    std::array<double, steps + 1> cdf{};
    Table() {
        for (std::size_t i = 0; i < steps; ++i)
            cdf[i + 1] = cdf[i] + f((double(i) + 0.5) / double(steps));
        const double all = cdf[steps];
        for (double& sum : cdf) sum /= all;
    }
    [[nodiscard]] double sample(double u) const {
        const auto above = std::upper_bound(cdf.begin() + 1, cdf.end() - 1, u);
        const double low = *(above - 1);
        const double step = double(above - 1 - cdf.begin());
        return (step + (u - low) / (*above - low)) / double(steps);
    }
    [[nodiscard]] double pdf(double c) const {
        const auto i = std::min(static_cast<std::size_t>(c * double(steps)), steps - 1);
        return (cdf[i + 1] - cdf[i]) * double(steps);
    }
};

/// The mean of f/p over n samples.
template <typename Way>
Estimate integrate(const Way& way, int n, ljus::RandomStream& stream) {
    Estimate result;
    for (int i = 0; i < n; ++i) {
        const double c = way.sample(next_1d<double>(stream));
        add(result, f(c) / way.pdf(c));
    }
    return result;
}

ljus::RandomStream stream_of(int seed, int iteration = 0) {
    return ljus::random_stream(std::uint64_t(seed), ljus::Pass::user,
                               std::uint64_t(iteration), 0);
}

/// The rms error of the mean of `value(u)` over n numbers, from many runs.
template <typename Value>
double rms_error(Points points, int n, int seeds, double right, Value value) {
    double squares = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        auto stream = stream_of(seed, n);
        double sum = 0;
        for (int i = 0; i < n; ++i)
            sum += value(number(points, i, n, std::uint64_t(seed) * 7919, stream)) / n;
        squares += (sum - right) * (sum - right) / seeds;
    }
    return std::sqrt(squares);
}

// --- The estimator and its error ------------------------------------------------------

/// Plots: error against n for smooth values and for values with an edge.
void error_against_n(const std::string& folder, const Sizes& sizes) {
    for (const bool edge : {false, true}) {
        const auto value = [edge](double u) { return !edge || u < 0.37 ? f(u) : 0.0; };
        double right = truth;
        if (edge) { // the integral up to 0.37, by the antiderivative
            const double s = 0.63, a = 0.37;
            const auto g = [](double m) {
                return std::pow(m, 6) / 6 - std::pow(m, 7) / 7;
            };
            right = r0 * a * a + 2 * (1 - r0) * (g(1) - g(s));
        }
        examples::Plot plot{
            .name = edge ? "monte_carlo-edge" : "monte_carlo-smooth",
            .columns = {"samples n", "random", "strata", "Owen", "sigma / sqrt(n)"},
            .y_label = "rms error",
            .log_x = true,
            .log_y = true};
        Estimate one;
        auto stream = stream_of(8);
        for (int i = 0; i < 100000; ++i) add(one, value(next_1d<double>(stream)));
        for (int n = 4; n <= sizes.most; n *= 4) {
            examples::Row row{double(n)};
            for (std::size_t k = 0; k < 3; ++k)
                row.push_back(
                    rms_error(static_cast<Points>(k), n, sizes.seeds, right, value));
            row.push_back(std::sqrt(variance(one) / n));
            plot.rows.push_back(row);
            examples::stop_if_asked();
        }
        save_plot(folder, plot);
    }
}

/// How often the truth lies within two standard errors of the estimate.
void coverage(const std::string& folder, int runs) {
    examples::Table table{.name = "monte_carlo-coverage",
                          .columns = {"samples", "uniform", "cosine", "grazing"}};
    const auto covered = [runs](auto way, int n) {
        int inside = 0;
        for (int run = 0; run < runs; ++run) {
            auto stream = stream_of(run + 1, n);
            const Estimate e = integrate(way, n, stream);
            inside += std::abs(e.mean - truth) <= 1.96 * standard_error(e);
        }
        return text(100.0 * inside / runs, "%.1f %%");
    };
    for (const int n : {4, 16, 64, 256, 1024}) {
        table.rows.push_back({std::to_string(n), covered(Uniform{}, n),
                              covered(Cosine{}, n), covered(Grazing{}, n)});
        examples::stop_if_asked();
    }
    save_table(folder, table);
}

// --- Which density --------------------------------------------------------------------

/// Plot and table: the densities beside f, and the error of each.
void importance(const std::string& folder, int samples) {
    const Table steps;
    examples::Plot plot{
        .name = "monte_carlo-densities",
        .columns = {"cosine c", "f / I", "uniform", "cosine", "grazing", "32 steps"},
        .y_label = "density",
        .more = "set yrange [0:3]\n"};
    for (int i = 0; i <= 200; ++i) {
        const double c = i / 200.0;
        plot.rows.push_back({c, f(c) / truth, Uniform::pdf(c), Cosine::pdf(c),
                             Grazing::pdf(c), steps.pdf(c)});
    }
    save_plot(folder, plot);

    examples::Table table{.name = "monte_carlo-ways",
                          .columns = {"", "mean", "sigma / I", "n for 1 %",
                                      "largest sample / I", "ns per sample"}};
    const auto add_row = [&](const std::string& name, const auto& way) {
        auto stream = stream_of(31);
        Estimate all;
        double largest = 0;
        for (int i = 0; i < samples; ++i) {
            const double c = way.sample(next_1d<double>(stream));
            const double value = f(c) / way.pdf(c);
            add(all, value);
            largest = std::max(largest, value);
        }
        const double ns = examples::nanoseconds_a_call(
            10000.0, [&] { return integrate(way, 10000, stream).mean; });
        const double sigma = std::sqrt(variance(all)) / truth;
        table.rows.push_back(
            {name, text(all.mean, "%.5f") + " ± " + text(standard_error(all), "%.5f"),
             text(sigma, "%.3g"), text(sigma * sigma * 1e4, "%.0f"),
             text(largest / truth, "%.3g"), text(ns, "%.1f")});
    };
    add_row("uniform", Uniform{});
    add_row("cosine", Cosine{});
    add_row("32 steps", steps);
    add_row("grazing", Grazing{});
    save_table(folder, table);
}

/// One sample by each of two ways, with the weights of multiple importance sampling.
enum class Weights { mean, balance, power };

// [both]
double both(Weights rule, ljus::RandomStream& stream) {
    const auto term = [rule](double c, double pdf, double other) {
        double weight = 0.5; // a plain mean of the two
        if (rule == Weights::balance) weight = ljus::balance_heuristic(pdf, other);
        if (rule == Weights::power) weight = ljus::power_heuristic(pdf, other);
        return weight * f(c) / pdf;
    };
    const double a = Cosine::sample(next_1d<double>(stream));
    const double b = Grazing::sample(next_1d<double>(stream));
    return term(a, Cosine::pdf(a), Grazing::pdf(a)) +
           term(b, Grazing::pdf(b), Cosine::pdf(b));
}
// [both]

/// Plot and table: the weights, and the error of two samples with them.
void multiple(const std::string& folder, int samples) {
    examples::Plot plot{.name = "monte_carlo-weights",
                        .columns = {"cosine c", "cosine by balance",
                                    "grazing by balance", "cosine by power",
                                    "grazing by power"},
                        .y_label = "weight"};
    for (int i = 0; i <= 100; ++i) {
        const double c = i / 100.0, p = Cosine::pdf(c), q = Grazing::pdf(c);
        plot.rows.push_back({c, ljus::balance_heuristic(p, q),
                             ljus::balance_heuristic(q, p), ljus::power_heuristic(p, q),
                             ljus::power_heuristic(q, p)});
    }
    save_plot(folder, plot);

    examples::Table table{
        .name = "monte_carlo-multiple",
        .columns = {"two samples", "mean", "sigma / I", "largest / I"}};
    const auto add_row = [&](const std::string& name, auto draw) {
        auto stream = stream_of(37);
        Estimate all;
        double largest = 0;
        for (int i = 0; i < samples; ++i) {
            const double value = draw(stream);
            add(all, value);
            largest = std::max(largest, value);
        }
        table.rows.push_back(
            {name, text(all.mean, "%.5f") + " ± " + text(standard_error(all), "%.5f"),
             text(std::sqrt(variance(all)) / truth, "%.3g"),
             text(largest / truth, "%.3g")});
    };
    add_row("both by the cosine",
            [](auto& stream) { return integrate(Cosine{}, 2, stream).mean; });
    add_row("both by the grazing density",
            [](auto& stream) { return integrate(Grazing{}, 2, stream).mean; });
    add_row("one of each, mean",
            [](auto& stream) { return both(Weights::mean, stream); });
    add_row("one of each, balance",
            [](auto& stream) { return both(Weights::balance, stream); });
    add_row("one of each, power",
            [](auto& stream) { return both(Weights::power, stream); });
    save_table(folder, table);
}

// --- The trade ------------------------------------------------------------------------

/// Adds a curve to the plot of error against time.
/// \param column    Its column.
/// \param estimate  The integral by n samples: of n, a seed, and a stream.
template <typename Estimator>
void add_curve(examples::Plot& plot, std::size_t column, const Sizes& sizes,
               Estimator estimate) {
    auto clock_stream = stream_of(1);
    const double ns = examples::nanoseconds_a_call(
        4096.0, [&] { return estimate(4096, 1, clock_stream); });
    for (int n = 16; n <= sizes.most; n *= 4) {
        double squares = 0;
        for (int seed = 1; seed <= sizes.seeds; ++seed) {
            auto stream = stream_of(seed, n);
            squares += std::pow(estimate(n, seed, stream) / truth - 1, 2) / sizes.seeds;
        }
        examples::Row row(plot.columns.size(), std::nan(""));
        row[0] = n * ns / 1000;
        row[column] = std::sqrt(squares);
        plot.rows.push_back(row);
        examples::stop_if_asked();
    }
}

/// The estimator of a density, for add_curve().
template <typename Way>
auto by_density(const Way& way) {
    return [&way](int n, int, ljus::RandomStream& stream) {
        return integrate(way, n, stream).mean;
    };
}

/// The estimator of the cosine density with strata or Owen's numbers, for add_curve().
auto by_points(Points points) {
    return [points](int n, int seed, ljus::RandomStream& stream) {
        double sum = 0;
        for (int i = 0; i < n; ++i) {
            const double c = Cosine::sample(
                number(points, i, n, std::uint64_t(seed) * 7919, stream));
            sum += f(c) / Cosine::pdf(c);
        }
        return sum / n;
    };
}

/// Plot: error against time for all estimators of the chapter.
void trade(const std::string& folder, const Sizes& sizes) {
    const Table steps;
    const Uniform uniform;
    const Cosine cosine;
    examples::Plot plot{.name = "monte_carlo-trade",
                        .columns = {"time (microseconds)", "uniform", "cosine",
                                    "32 steps", "balance", "strata", "Owen"},
                        .y_label = "relative rms error",
                        .log_x = true,
                        .log_y = true};
    add_curve(plot, 1, sizes, by_density(uniform));
    add_curve(plot, 2, sizes, by_density(cosine));
    add_curve(plot, 3, sizes, by_density(steps));
    add_curve(plot, 4, sizes, [](int n, int, ljus::RandomStream& stream) {
        double sum = 0;
        for (int i = 0; i < n / 2; ++i) sum += both(Weights::balance, stream);
        return sum / (n / 2);
    });
    add_curve(plot, 5, sizes, by_points(Points::strata));
    add_curve(plot, 6, sizes, by_points(Points::owen));
    save_plot(folder, plot);
}

// --- How errors are measured ----------------------------------------------------------

/// A ball in front of a wall, as a formula.
Image ball_picture(int size) {
    Image image = ljus::make_image(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double u = (x + 0.5) / size * 2 - 1, v = 1 - (y + 0.5) / size * 2;
            const double r2 = (u * u + v * v) / 0.5;
            double value = 0.35 + 0.25 * v;
            if (r2 < 1) {
                const double z = std::sqrt(1 - r2);
                const double light = (-0.5 * u + 0.6 * v) / std::sqrt(0.5) + 0.62 * z;
                value = 0.02 + 0.9 * std::max(0.0, light);
            }
            pixel(image, x, y) = Rgb(float(value));
        }
    return image;
}

/// Table and pictures: four kinds of damage with the same RMSE.
void damage(const examples::Options& options) {
    const int size = options.width;
    const Image right = ball_picture(size);
    constexpr double rmse = 0.04;
    examples::Table table{.name = "monte_carlo-damage",
                          .columns = {"", "RMSE", "relMSE", "without the worst 1 %",
                                      "block error", "FLIP"}};
    save_png(right, options.path("monte_carlo-right.png"));
    const auto add_row = [&](const std::string& name, const std::string& file,
                             auto change) {
        // Scaled so that the rms is the same for all.
        Image wrong = right;
        double squares = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const double by = change(x, y);
                pixel(wrong, x, y) = Rgb(float(by));
                squares += by * by;
            }
        const double scale = rmse / std::sqrt(squares / (double(size) * size));
        for (std::size_t i = 0; i < wrong.pixels.size(); ++i)
            wrong.pixels[i] = right.pixels[i] + float(scale) * wrong.pixels[i];
        save_png(wrong, options.path("monte_carlo-" + file + ".png"));
        table.rows.push_back({name, text(ljus::rmse(wrong, right), "%.4f"),
                              text(ljus::rel_mse(wrong, right), "%.4f"),
                              text(ljus::trimmed_rel_mse(wrong, right), "%.4f"),
                              text(ljus::block_error(wrong, right), "%.4f"),
                              text(ljus::flip(wrong, right), "%.3f")});
    };
    auto stream = stream_of(61);
    add_row("noise", "noise",
            [&](int, int) { return next_1d<double>(stream) < 0.5 ? -1 : 1; });
    add_row("too dark", "dark",
            [&](int x, int y) { return -double(pixel(right, x, y).x); });
    const int reach = std::max(1, size / 16);
    add_row("blurred", "blurred", [&](int x, int y) {
        double sum = 0, count = 0;
        for (int j = std::max(0, y - reach); j <= std::min(size - 1, y + reach); ++j)
            for (int i = std::max(0, x - reach); i <= std::min(size - 1, x + reach);
                 ++i)
                sum += double(pixel(right, i, j).x), count += 1;
        return sum / count - double(pixel(right, x, y).x);
    });
    add_row("fireflies", "fireflies",
            [&](int, int) { return next_1d<double>(stream) < 1 / 400.0 ? 1.0 : 0.0; });
    save_table(options.path(""), table);
}

} // namespace

/// Makes the figures of chapter 3.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 3: densities, strata, and how errors are measured.");
        line.add("--seeds", sizes.seeds, "Runs behind each error", 2, 100000);
        line.add("--most", sizes.most, "Samples per run, at most", 64, 1 << 24);
        const examples::Options options =
            line.parse({.draft{.width = 240, .height = 240, .samples = 1},
                        .report{.width = 400, .height = 400, .samples = 1},
                        .reference{.width = 400, .height = 400, .samples = 1}});
        if (!line.given("--seeds")) sizes.seeds = options.pick(32, 200, 1000);
        if (!line.given("--most")) sizes.most = options.pick(4096, 65536, 262144);
        const std::string folder = options.path("");
        const int samples = options.pick(100000, 2000000, 20000000);
        error_against_n(folder, sizes);
        coverage(folder, options.pick(1000, 20000, 100000));
        importance(folder, samples);
        multiple(folder, samples);
        trade(folder, sizes);
        damage(options);
    });
}
