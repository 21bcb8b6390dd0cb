// Live: many runs of an estimator, as long as one likes.
#include <array>
#include <cmath>

#include "experiments/glass_integral.hpp"
#include "ljus/inspect/estimate.hpp"

namespace {

using namespace examples::glass; // f, its truth, the ways to draw

constexpr int most_runs = 64;
std::array<double, 2 * most_runs> results; // mean and standard error of each run

/// One run. Its first n random numbers are the same for each n: the run goes on. Strata
/// are cut anew for each n.
template <typename Way>
ljus::Estimate run(Points points, int n, int seed) {
    const auto iteration = static_cast<std::uint64_t>(points == Points::strata ? n : 0);
    auto stream = ljus::random_stream(static_cast<std::uint64_t>(seed),
                                      ljus::Pass::user, iteration, 0);
    ljus::Estimate result;
    for (int i = 0; i < n; ++i) {
        const double u =
            number(points, i, n, static_cast<std::uint64_t>(seed), stream);
        const double c = Way::sample(u);
        add(result, f(c) / Way::pdf(c));
    }
    return result;
}

ljus::Estimate run(int way, int points, int n, int seed) {
    const auto from = static_cast<Points>(points);
    if (way == 1) return run<Cosine>(from, n, seed);
    if (way == 2) return run<Grazing>(from, n, seed);
    return run<Uniform>(from, n, seed);
}

} // namespace

extern "C" {

[[gnu::used]] double right_answer() { return truth; }

/// f, and the density of a way, for the small drawing.
[[gnu::used]] double height(double c) { return f(c) / truth; }
[[gnu::used]] double density(int way, double c) {
    return way == 1 ? Cosine::pdf(c) : way == 2 ? Grazing::pdf(c) : Uniform::pdf(c);
}

/// Runs number first to last - 1 with n samples each: mean and standard error.
[[gnu::used]] const double* run_some(int way, int points, int n, int first, int last,
                                     int seed) {
    for (int i = first; i < last && i < most_runs; ++i) {
        const ljus::Estimate found = run(way, points, n, seed + i);
        results[static_cast<std::size_t>(2 * i)] = found.mean;
        results[static_cast<std::size_t>(2 * i + 1)] = standard_error(found);
    }
    return results.data();
}

/// The root mean square error of the first runs.
[[gnu::used]] double rms_error(int runs) {
    double squares = 0;
    for (int i = 0; i < runs; ++i) {
        const double error = results[static_cast<std::size_t>(2 * i)] - truth;
        squares += error * error / runs;
    }
    return std::sqrt(squares);
}

/// The standard deviation of one sample, from a hundred thousand of them.
[[gnu::used]] double deviation(int way) {
    return std::sqrt(variance(run(way, static_cast<int>(Points::strata), 100000, 1)));
}

[[gnu::used]] int checks() { return 12; }
[[gnu::used]] double check(int i) {
    const int way = i % 3, points = i / 3 % 3;
    if (i >= 9) return deviation(way);
    const auto kept = results; // the page goes on with its own
    run_some(way, points, 256, 0, 8, 5);
    const double error = rms_error(8);
    results = kept;
    return error;
}

/// Powers and roots of two C libraries differ in their last digit.
[[gnu::used]] double tolerance() { return 1e-11; }

} // extern "C"
