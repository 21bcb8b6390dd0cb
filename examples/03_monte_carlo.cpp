// smoke: --quality draft
/// \file 03_monte_carlo.cpp
/// \brief Computes an integral as the mean of random numbers, with its error. The
/// integral is the light that glass reflects under an even sky.

#include <cmath>
#include <cstdio>
#include <string>

#include <ljus/inspect/estimate.hpp>
#include <ljus/math/random.hpp>
#include <ljus/optics/schlick.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

constexpr double r0 = schlick_r0(1.0, 1.5);  // glass at normal incidence: 0.04
constexpr double truth = r0 + (1 - r0) / 21; // the integral of f from 0 to 1

/// The integrand f: the reflectance of glass at an angle with cosine c, times the
/// density of the light from there.
// [integrand]
double f(double c) {
    return 2 * c * schlick(r0, c);
}
// [integrand]

/// Densities of the cosine, each with a function that draws a cosine from a number u in
/// [0, 1).
// [ways]
struct Uniform {
    static double sample(double u) { return u; }
    static double pdf(double) { return 1; }
};
struct Cosine {
    static double sample(double u) { return std::sqrt(1 - u); } // never 0
    static double pdf(double c) { return 2 * c; }
};
struct Grazing {
    static double sample(double u) { return 1 - std::pow(1 - u, 1.0 / 6); }
    static double pdf(double c) { return 6 * std::pow(1 - c, 5); }
};
// [ways]

/// The mean of f/p over n samples, where p is the density.
// [estimator]
template <typename Way>
Estimate integrate(const Way& way, int n, RandomStream& stream) {
    Estimate result;
    for (int i = 0; i < n; ++i) {
        const double c = way.sample(next_1d<double>(stream));
        add(result, f(c) / way.pdf(c));
    }
    return result;
}
// [estimator]

/// The mean of one run after more and more samples, with two standard errors to each
/// side.
examples::Plot running_mean(int most) {
    examples::Plot plot{.name = "monte_carlo-running",
                        .columns = {"samples n", "estimate", "+ 2 standard errors",
                                    "- 2 standard errors", "I"},
                        .y_label = "mean of f/p",
                        .log_x = true,
                        .more = "set yrange [0.06:0.115]\n"};
    RandomStream stream = random_stream(3, Pass::user, 0, 0);
    Estimate run;
    double next = 8;
    for (int n = 1; n <= most; ++n) {
        add(run, f(next_1d<double>(stream))); // uniform: p is 1
        if (n < next) continue;
        next = n * 1.15; // evenly spaced on a logarithmic axis
        const double error = 2 * standard_error(run);
        plot.rows.push_back(
            {double(n), run.mean, run.mean + error, run.mean - error, truth});
    }
    return plot;
}

/// Prints the estimates of a density with more and more samples.
template <typename Way>
void print_way(const std::string& name, const Way& way) {
    using examples::text;
    RandomStream stream = random_stream(31, Pass::user, 0, 0);
    for (const int n : {1000, 10000, 100000, 1000000}) {
        const Estimate found = integrate(way, n, stream);
        examples::print_row({name, std::to_string(n), text(found.mean, "%.5f"),
                             text(standard_error(found), "%.5f"),
                             text(std::sqrt(variance(found)) / truth, "%.3f")},
                            16);
    }
}

} // namespace

/// Prints three estimates of the integral and saves the plot of a run.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 3, Monte Carlo: an integral as a mean of random numbers.");
        line.without({"--width", "--height", "--rays", "--seed", "--threads"});
        const examples::Options options = line.parse();
        std::printf("The integral is %.5f.\n", truth);
        examples::print_row(
            {"density", "samples", "mean", "standard error", "sigma / I"}, 16);
        print_way("uniform", Uniform{});
        print_way("cosine", Cosine{});
        print_way("grazing", Grazing{});
        save_plot(options.path(""), running_mean(options.pick(4096, 65536, 262144)));
    });
}
