#pragma once

/// \file support/mean.hpp
/// \brief The mean radiance that a renderer finds over many paths.

#include <array>
#include <cstddef>
#include <cstdint>

#include "ljus/math/random.hpp"
#include "ljus/path/renderer.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"

namespace ljus_test {

/// The mean of each channel of a renderer's radiance over many paths.
/// \param renderer  A path tracer or a photon mapper.
/// \param paths     The number of paths.
/// \param seed      Seed of the random numbers; see test_seed().
/// \param ray       Called with the stream of a path; returns its first ray.
template <typename Renderer, typename MakeRay>
[[nodiscard]] std::array<Mean, 3> mean_radiances(const Renderer& renderer,
                                                 long long paths, std::uint64_t seed,
                                                 MakeRay ray) {
    std::array<Mean, 3> means;
    ljus::Counts counts;
    for (long long path = 0; path < paths; ++path) {
        auto stream = ljus::random_stream(test_seed(seed), ljus::Pass::camera, 0,
                                          static_cast<std::uint64_t>(path));
        const auto start = ray(stream);
        auto context = ljus::context_of(stream, counts);
        const auto found = radiance(renderer, start, context);
        for (int c = 0; c < 3; ++c) means[std::size_t(c)].add(double(found[c]));
    }
    return means;
}

/// The mean of one channel, 0, 1 or 2, of a renderer's radiance over many paths.
template <typename Renderer, typename MakeRay>
[[nodiscard]] Mean mean_radiance(const Renderer& renderer, long long paths,
                                 std::uint64_t seed, MakeRay ray, int channel = 0) {
    return mean_radiances(renderer, paths, seed, ray)[std::size_t(channel)];
}

} // namespace ljus_test
