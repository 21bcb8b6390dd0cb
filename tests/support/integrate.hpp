#pragma once

/// \file support/integrate.hpp
/// \brief Integrals of smooth functions, for reference values.

namespace ljus_test {

/// The integral over [low, high], by Gauss-Legendre quadrature with 8 points.
template <typename F>
double integrate(double low, double high, F&& f) {
    constexpr double x[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                            0.9602898564975363};
    constexpr double w[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                            0.1012285362903763};
    const double middle = (low + high) / 2, half = (high - low) / 2;
    double sum = 0;
    for (int i = 0; i < 4; ++i)
        sum += w[i] * (f(middle - half * x[i]) + f(middle + half * x[i]));
    return sum * half;
}

/// The integral over [low, high], by Gauss-Legendre quadrature with 8 points on each of
/// `pieces` equal pieces.
template <typename F>
double integrate(double low, double high, int pieces, F&& f) {
    double sum = 0;
    for (int i = 0; i < pieces; ++i)
        sum += integrate(low + (high - low) * i / pieces,
                         low + (high - low) * (i + 1) / pieces, f);
    return sum;
}

} // namespace ljus_test
