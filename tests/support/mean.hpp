#pragma once

/// \file support/mean.hpp
/// \brief The mean radiance that a renderer finds over many paths.

#include <cstdint>

#include "ljus/math/random.hpp"
#include "ljus/path/renderer.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"

namespace ljus_test {

/// The mean of one channel of a renderer's radiance over many paths.
/// \param renderer  A path tracer or a photon mapper.
/// \param paths     How many.
/// \param seed      Of their random numbers; see test_seed().
/// \param ray       Called with the path's stream; returns where it starts.
/// \param channel   0, 1 or 2.
template <typename Renderer, typename MakeRay>
[[nodiscard]] Mean mean_radiance(const Renderer& renderer, long long paths,
                                 std::uint64_t seed, MakeRay ray, int channel = 0) {
    Mean mean;
    ljus::Counts counts;
    for (long long path = 0; path < paths; ++path) {
        auto stream = ljus::random_stream(test_seed(seed), ljus::Pass::camera, 0,
                                          static_cast<std::uint64_t>(path));
        const auto start = ray(stream);
        auto context = ljus::context_of(stream, counts);
        mean.add(double(radiance(renderer, start, context)[channel]));
    }
    return mean;
}

} // namespace ljus_test
