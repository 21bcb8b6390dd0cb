// Live: directions by a sampler, counted in cells beside a density.
#include <array>

#include "experiments/hemisphere_cells.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/sampling.hpp"

namespace {

using Cells = examples::HemisphereCells;
using ljus::Vec3T;

constexpr int at_once = 2048;
std::array<float, 3 * at_once> directions;
std::array<double, 2 * Cells::rows> belts; // found and said, one after the other

struct Run {
    int sampler = 0;
    ljus::RandomStream stream;
    std::vector<double> counts, expected; ///< Of each cell; expected: its share.
    double total = 0;
};
Run run;

Vec3T<double> sample(int sampler, const ljus::Vec2T<double>& u) {
    if (sampler == 1) return ljus::sample_uniform_hemisphere(u);
    if (sampler == 2) return ljus::sample_naive_hemisphere(u);
    return ljus::sample_cosine_hemisphere(u);
}

double pdf(int density, const Vec3T<double>& d) {
    if (density == 1) return ljus::pdf_uniform_hemisphere(d);
    if (density == 2) return ljus::pdf_naive_hemisphere(d);
    return ljus::pdf_cosine_hemisphere(d);
}

/// The sum of (found - expected)^2 / expected over the cells.
double chi_square_sum() {
    double sum = 0;
    for (std::size_t i = 0; i < run.counts.size(); ++i) {
        const double expect = run.total * run.expected[i];
        sum += (run.counts[i] - expect) * (run.counts[i] - expect) / expect;
    }
    return sum;
}

} // namespace

extern "C" {

/// Starts again: directions by one sampler, judged by the density of one.
[[gnu::used]] void restart(int by, int density, int seed) {
    run = {.sampler = by,
           .stream = ljus::random_stream(static_cast<std::uint64_t>(seed),
                                         ljus::Pass::user, 0, 0),
           .counts = std::vector<double>(Cells::rows * Cells::columns),
           .expected = Cells::integrals(
               [density](const Vec3T<double>& d) { return pdf(density, d); })};
}

/// Draws and counts some more, at most 2048.
/// \return x, y, z of each.
[[gnu::used]] const float* draw(int count) {
    for (int i = 0; i < count && i < at_once; ++i) {
        const Vec3T<double> d = sample(run.sampler, next_2d<double>(run.stream));
        run.counts[Cells::of(d)] += 1;
        run.total += 1;
        for (int k = 0; k < 3; ++k)
            directions[static_cast<std::size_t>(3 * i + k)] = float(d[k]);
    }
    return directions.data();
}

/// The share of each belt of equal height: as found, and as the density has it.
[[gnu::used]] const double* histogram() {
    belts.fill(0);
    for (std::size_t i = 0; i < run.counts.size(); ++i) {
        const std::size_t row = i / Cells::columns;
        belts[row] += run.total > 0 ? run.counts[i] / run.total : 0;
        belts[row + Cells::rows] += run.expected[i];
    }
    return belts.data();
}

[[gnu::used]] int belt_count() { return Cells::rows; }
[[gnu::used]] double chi_square() { return chi_square_sum(); }
[[gnu::used]] double freedom() { return double(run.counts.size() - 1); }
/// How likely a right sampler is to look as bad.
[[gnu::used]] double p_value() {
    return examples::chi_square_p(chi_square_sum(), freedom());
}

[[gnu::used]] int checks() { return 8; }
[[gnu::used]] double check(int i) {
    const Run kept = run; // the page goes on with its own
    restart(i % 3, i < 3 ? i % 3 : 0, 7);
    for (int k = 0; k < 4; ++k) draw(at_once);
    const double found = i < 6 ? chi_square_sum() : histogram()[i];
    run = kept;
    return found;
}

/// Sines and cosines of two C libraries differ in their last digit.
[[gnu::used]] double tolerance() { return 1e-9; }

} // extern "C"
