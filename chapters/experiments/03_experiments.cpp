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

/// Plots and a table: error against n for smooth values and for values with an edge.
void error_against_n(const std::string& folder, const Sizes& sizes) {
    examples::Table slopes{.name = "monte_carlo-slopes",
                           .columns = {"", "random", "strata", "Owen"}};
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
        std::array<std::vector<double>, 3> errors;
        std::vector<double> counts;
        for (int n = 4; n <= sizes.most; n *= 4) {
            examples::Row row{double(n)};
            if (n >= 256 || sizes.most < 4096) counts.push_back(n);
            for (std::size_t k = 0; k < 3; ++k) {
                row.push_back(
                    rms_error(static_cast<Points>(k), n, sizes.seeds, right, value));
                if (!counts.empty()) errors[k].push_back(row.back());
            }
            row.push_back(std::sqrt(variance(one) / n));
            plot.rows.push_back(row);
            examples::stop_if_asked();
        }
        save_plot(folder, plot);
        std::vector<std::string> row{edge ? "with an edge" : "smooth"};
        for (std::size_t k = 0; k < 3; ++k)
            row.push_back(text(examples::fit_power(counts, errors[k]).slope, "%.2f"));
        slopes.rows.push_back(row);
    }
    save_table(folder, slopes);
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

/// Table: samples that are evaluated only with some probability.
void roulette(const std::string& folder, int samples) {
    examples::Table table{.name = "monte_carlo-roulette",
                          .columns = {"survives with", "samples looked at", "mean",
                                      "sigma / I", "sigma² × samples looked at"}};
    const auto add_row = [&](const std::string& name, auto chance, bool divided) {
        auto stream = stream_of(41);
        Estimate all;
        int looked = 0;
        for (int i = 0; i < samples; ++i) {
            const double c = Cosine::sample(next_1d<double>(stream));
            const double y = f(c) / Cosine::pdf(c);
            const double q = chance(y);
            double value = 0;
            if (next_1d<double>(stream) < q) {
                value = y / (divided ? q : 1);
                ++looked;
            }
            add(all, value);
        }
        const double cost = double(looked) / samples;
        const double relative = variance(all) / (truth * truth);
        table.rows.push_back({name, text(100 * cost, "%.0f %%"), text(all.mean, "%.4f"),
                              text(std::sqrt(relative), "%.3g"),
                              text(relative * cost, "%.3g")});
    };
    add_row(
        "1", [](double) { return 1.0; }, true);
    add_row(
        "0.5", [](double) { return 0.5; }, true);
    add_row(
        "0.1", [](double) { return 0.1; }, true);
    add_row(
        "Y / I, at most 1", [](double y) { return std::min(1.0, y / truth); }, true);
    add_row(
        "0.5, not divided", [](double) { return 0.5; }, false);
    save_table(folder, table);
}

// --- The hemisphere -------------------------------------------------------------------

/// A density of directions, and where its points of the square come from.
struct HemisphereWay {
    const char* name;
    bool cosine;
    ljus::Sampling sampling;
};
constexpr std::array hemisphere_ways{
    HemisphereWay{"uniform random", false, ljus::Sampling::random},
    HemisphereWay{"cosine random", true, ljus::Sampling::random},
    HemisphereWay{"cosine strata", true, ljus::Sampling::jittered},
    HemisphereWay{"cosine Owen", true, ljus::Sampling::sobol}};

/// One term of the estimate: of R cos θ over all directions, or of cos θ alone.
double hemisphere_term(const HemisphereWay& way, const ljus::Vec2T<double>& u,
                       bool glass) {
    const auto d = way.cosine ? ljus::sample_cosine_hemisphere(u)
                              : ljus::sample_uniform_hemisphere(u);
    const double pdf =
        way.cosine ? ljus::pdf_cosine_hemisphere(d) : ljus::pdf_uniform_hemisphere(d);
    return (glass ? ljus::schlick(r0, d.z) : 1) * d.z / pdf;
}

/// The relative rms error of n samples, over some seeds.
double hemisphere_error(const HemisphereWay& way, int n, int seeds) {
    const auto pattern = make_pattern(way.sampling, n);
    double squares = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        double sum = 0;
        for (int i = 0; i < n; ++i) {
            ljus::StratifiedStream stream;
            start_ray(stream, std::uint64_t(seed), 5, i, pattern);
            sum += hemisphere_term(way, next_2d<double>(stream), true) / n;
        }
        squares += std::pow(sum / (pi * truth) - 1, 2) / seeds;
    }
    return std::sqrt(squares);
}

/// How fast errors fall, from numbers of samples on that are large enough for a law.
struct ErrorLaws {
    std::vector<double> counts{};
    std::array<std::vector<double>, hemisphere_ways.size()> errors{};
};

/// Plot: the error of each way against the number of samples.
ErrorLaws plot_hemisphere(const std::string& folder, const Sizes& sizes) {
    examples::Plot plot{.name = "monte_carlo-hemisphere",
                        .columns = {"samples n"},
                        .y_label = "relative rms error",
                        .log_x = true,
                        .log_y = true};
    for (const HemisphereWay& way : hemisphere_ways)
        plot.columns.emplace_back(way.name);
    ErrorLaws laws;
    for (int n = 4; n <= std::min(sizes.most, 65536); n *= 4) {
        examples::Row row{double(n)};
        if (n >= 256 || sizes.most < 4096) laws.counts.push_back(n);
        for (std::size_t k = 0; k < hemisphere_ways.size(); ++k) {
            row.push_back(hemisphere_error(hemisphere_ways[k], n, sizes.seeds));
            if (!laws.counts.empty()) laws.errors[k].push_back(row.back());
            examples::stop_if_asked();
        }
        plot.rows.push_back(row);
    }
    save_plot(folder, plot);
    return laws;
}

/// Plot and table: the same integral over directions, by points of the square.
void hemisphere(const std::string& folder, const Sizes& sizes) {
    const ErrorLaws laws = plot_hemisphere(folder, sizes);
    examples::Table table{
        .name = "monte_carlo-hemisphere-table",
        .columns = {"", "sigma / π, of cos θ", "sigma / (π I), of R cos θ", "slope"}};
    for (std::size_t k = 0; k < hemisphere_ways.size(); ++k) {
        const HemisphereWay& way = hemisphere_ways[k];
        Estimate one, glass;
        auto stream = stream_of(53);
        for (int i = 0; i < 200000; ++i) {
            const auto u = next_2d<double>(stream);
            add(one, hemisphere_term(way, u, false));
            add(glass, hemisphere_term(way, u, true));
        }
        table.rows.push_back(
            {way.name, text(std::sqrt(std::abs(variance(one))) / pi, "%.3f"),
             text(std::sqrt(variance(glass)) / (pi * truth), "%.3f"),
             text(examples::fit_power(laws.counts, laws.errors[k]).slope, "%.2f")});
    }
    save_table(folder, table);
}

// --- The trade ------------------------------------------------------------------------

/// Error against time for all estimators of the chapter, as they are measured.
struct Trade {
    examples::Plot plot{.name = "monte_carlo-trade",
                        .columns = {"time (microseconds)", "uniform", "cosine",
                                    "32 steps", "balance", "strata", "Owen"},
                        .y_label = "relative rms error",
                        .log_x = true,
                        .log_y = true};
    examples::Table table{.name = "monte_carlo-trade-table",
                          .columns = {"", "ns per sample",
                                      "relative error, 1024 samples",
                                      "time for 0.1 %, µs"}};
};

/// The time at which the error is 0.1 %: from the curve, or, if that ends earlier, by
/// its fitted slope.
double time_for_a_thousandth(const std::vector<double>& times,
                             const std::vector<double>& errors) {
    const auto law = examples::fit_power(times, errors);
    const double time = examples::reach(times, errors, 1e-3);
    return std::isnan(time)
               ? times.back() * std::pow(1e-3 / errors.back(), 1 / law.slope)
               : time;
}

/// Adds the next curve of the plot, and its row of the table.
/// \param estimate  The integral by n samples: of n, a seed, and a stream.
template <typename Estimator>
void add_curve(Trade& trade, const std::string& name, const Sizes& sizes,
               Estimator estimate) {
    const std::size_t column = trade.table.rows.size() + 1;
    auto clock_stream = stream_of(1);
    const double ns = examples::nanoseconds_a_call(
        4096.0, [&] { return estimate(4096, 1, clock_stream); });
    std::vector<double> times, errors;
    double at_1024 = std::nan("");
    for (int n = 16; n <= sizes.most; n *= 4) {
        double squares = 0;
        for (int seed = 1; seed <= sizes.seeds; ++seed) {
            auto stream = stream_of(seed, n);
            squares += std::pow(estimate(n, seed, stream) / truth - 1, 2) / sizes.seeds;
        }
        examples::Row row(trade.plot.columns.size(), std::nan(""));
        row[0] = n * ns / 1000;
        row[column] = std::sqrt(squares);
        if (n == 1024) at_1024 = row[column];
        times.push_back(row[0]);
        errors.push_back(row[column]);
        trade.plot.rows.push_back(row);
        examples::stop_if_asked();
    }
    trade.table.rows.push_back({name, text(ns, "%.1f"), text(at_1024, "%.2g"),
                                text(time_for_a_thousandth(times, errors), "%.3g")});
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
    Trade found;
    add_curve(found, "uniform", sizes, by_density(uniform));
    add_curve(found, "cosine", sizes, by_density(cosine));
    add_curve(found, "32 steps", sizes, by_density(steps));
    add_curve(found, "cosine and grazing, balance", sizes,
              [](int n, int, ljus::RandomStream& stream) {
                  double sum = 0;
                  for (int i = 0; i < n / 2; ++i) sum += both(Weights::balance, stream);
                  return sum / (n / 2);
              });
    add_curve(found, "cosine, strata", sizes, by_points(Points::strata));
    add_curve(found, "cosine, Owen", sizes, by_points(Points::owen));
    save_plot(folder, found.plot);
    save_table(folder, found.table);
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

/// Table: the variance of numbers far from 0, by the formula on paper and by Welford's.
void far_means(const std::string& folder) {
    examples::Table table{.name = "monte_carlo-far",
                          .columns = {"samples", "sum of squares", "Welford", "right"}};
    for (const double offset : {0.0, 1e4, 1e8, 1e10}) {
        auto stream = stream_of(71);
        Estimate e;
        double sum = 0, squares = 0;
        constexpr int n = 100000;
        for (int i = 0; i < n; ++i) {
            const double x = offset + next_1d<double>(stream);
            add(e, x);
            sum += x;
            squares += x * x;
        }
        table.rows.push_back({text(offset, "%.0f") + " + u",
                              text((squares - sum * sum / n) / (n - 1), "%.4g"),
                              text(variance(e), "%.4g"), text(1 / 12.0, "%.4g")});
    }
    save_table(folder, table);
}

} // namespace

/// Makes the figures of chapter 3.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about(
            "Chapter 3: densities, strata, roulette, and how errors are measured.");
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
        roulette(folder, samples);
        hemisphere(folder, sizes);
        trade(folder, sizes);
        damage(options);
        far_means(folder);
    });
}
