#pragma once

/// \file support/mean.hpp
/// \brief A mean and its standard error, and paths to take it over.

#include <cmath>
#include <cstdint>

#include "ljus/math/random.hpp"
#include "ljus/path/counts.hpp"

namespace ljus_test {

/// The mean of numbers that come one by one, and how well it is known (Welford).
struct Mean {
    double count = 0;   ///< How many.
    double mean = 0;    ///< Of them.
    double squares = 0; ///< Sum of the squared distances from the mean.

    /// Takes one more.
    void add(double x) {
        count += 1;
        const double from_old = x - mean;
        mean += from_old / count;
        squares += from_old * (x - mean);
    }

    /// The standard error of the mean.
    [[nodiscard]] double error() const {
        return count < 2 ? 0 : std::sqrt(squares / (count - 1) / count);
    }
};

/// The distance of two independent means, in standard errors of their difference.
inline double apart(const Mean& a, const Mean& b) {
    const double error = std::hypot(a.error(), b.error());
    return a.mean == b.mean ? 0 : (a.mean - b.mean) / error;
}

/// The distance of a mean from what it should be, in standard errors. Where all numbers
/// are equal up to rounding the error is 0, so `rounding` (relative) is allowed for.
inline double apart(const Mean& a, double right, double rounding = 1e-6) {
    const double error = std::hypot(a.error(), rounding * right);
    return a.mean == right ? 0 : (a.mean - right) / error;
}

/// The mean of one channel of a renderer's radiance over many paths.
/// \param renderer  A path tracer or a photon mapper.
/// \param paths     How many.
/// \param seed      Of their random numbers.
/// \param ray       Called with the path's stream; returns where it starts.
/// \param channel   0, 1 or 2.
template <typename Renderer, typename MakeRay>
[[nodiscard]] Mean mean_radiance(const Renderer& renderer, long long paths,
                                 std::uint64_t seed, MakeRay ray, int channel = 0) {
    Mean mean;
    ljus::Counts counts;
    for (long long path = 0; path < paths; ++path) {
        auto stream = ljus::random_stream(seed, ljus::Pass::camera, 0,
                                          static_cast<std::uint64_t>(path));
        const auto start = ray(stream);
        mean.add(double(radiance(renderer, start, stream, counts)[channel]));
    }
    return mean;
}

} // namespace ljus_test
