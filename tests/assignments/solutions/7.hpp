#pragma once

/// \file answer.hpp
/// \brief Assignment 7: a solution, for those who keep the course.

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "given.hpp"
#include "ljus/math/random.hpp"

namespace answer {

inline float next_radius(float radius, int pass, float alpha) {
    return radius * std::sqrt((float(pass) + alpha) / (float(pass) + 1));
}

inline Picture photon_pass(const Light& light, std::span<const Vec2> points,
                           float radius, int count, int number) {
    auto stream =
        ljus::random_stream(1, ljus::Pass::user, static_cast<std::uint64_t>(number), 0);
    std::vector<Photon> stored;
    for (int i = 0; i < count; ++i)
        if (const auto place = light.land(stream))
            stored.push_back({*place, light.flux / count});
    const PhotonMap map(stored);
    Picture picture;
    for (const Vec2& point : points) picture.push_back(map.irradiance(point, radius));
    return picture;
}

inline void add_pass(Progress& progress, const Picture& picture) {
    progress.mean.resize(picture.size());
    progress.squares.resize(picture.size());
    progress.passes += 1;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const double before = picture[i] - progress.mean[i];
        progress.mean[i] += before / progress.passes;
        progress.squares[i] += before * (picture[i] - progress.mean[i]);
    }
    progress.radius = next_radius(progress.radius, progress.passes, progress.alpha);
}

inline Picture standard_error(const Progress& progress) {
    Picture errors;
    const double n = progress.passes;
    for (const double squares : progress.squares)
        errors.push_back(n < 2 ? std::numeric_limits<double>::infinity()
                               : std::sqrt(squares / (n * (n - 1))));
    return errors;
}

template <typename MakePass>
void run(Progress& progress, int passes, MakePass&& make_pass) {
    for (int i = 0; i < passes; ++i)
        add_pass(progress, make_pass(progress.radius, progress.passes));
}

} // namespace answer
