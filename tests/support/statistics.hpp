#pragma once

/// \file support/statistics.hpp
/// \brief Pearson's chi-square for counts against what is expected.

#include <cmath>
#include <cstddef>
#include <vector>

namespace ljus_test {

/// The value that a chi-square variable with `freedom` degrees exceeds as rarely as a
/// normal one exceeds z: 3.09 is once in 1000, 5 is 3 times in 10 million (Wilson and
/// Hilferty's cube, good to a few percent of that probability from 10 degrees on).
inline double chi_square_limit(double freedom, double z) {
    const double a = 2 / (9 * freedom);
    const double root = 1 - a + z * std::sqrt(a);
    return freedom * root * root * root;
}

/// Whether counts agree with expected ones, with the false-alarm rate of `z` (see
/// chi_square_limit()). Cells that expect fewer than 8 are joined into one.
inline bool chi_square_agrees(const std::vector<double>& counts,
                              const std::vector<double>& expected, double z) {
    double sum = 0, rest_count = 0, rest_expected = 0, cells = 0;
    const auto add = [&](double count, double expect) {
        sum += (count - expect) * (count - expect) / expect;
        cells += 1;
    };
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] >= 8) {
            add(counts[i], expected[i]);
        } else {
            rest_count += counts[i];
            rest_expected += expected[i];
        }
    }
    if (rest_expected >= 1)
        add(rest_count, rest_expected);
    else if (rest_count > 8)
        return false;                 // something fell where nothing can
    if (cells < 2) return sum < 1e-9; // no choice, no chance
    return sum <= chi_square_limit(cells - 1, z);
}

} // namespace ljus_test
