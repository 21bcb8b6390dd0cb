#pragma once

/// \file ljus/render/detail/ray_shares.hpp
/// \brief How to share out rays among parts of a picture.

#include <cmath>
#include <cstddef>
#include <vector>

#include "ljus/version.hpp"

namespace ljus::detail {

/// A part of a picture, as the sharing sees it.
struct RayShare {
    double pixels = 1;   ///< How many it has.
    double variance = 0; ///< Relative variance of one ray, mean over its pixels.
    double rays = 1;     ///< Rays that each of its pixels has.
};

/// The number of rays per pixel that each part should have, so that the mean of
/// variance / rays over all pixels falls to a target with the fewest rays, or is the
/// least that a number of rays can buy.
///
/// With n rays per pixel in each part, sum w v / n is to be least for a given sum w n.
/// Lagrange: v / n^2 is the same everywhere, so that n is in proportion to the root of
/// the variance \cite neyman1934. A part that has more rays already keeps them,
/// and the rest is shared out among the others.
/// \param parts   All parts.
/// \param target  The mean of variance / rays that is wanted; 0: as small as can be.
/// \param limit   The most rays per pixel, in the mean.
/// \return Rays a pixel for each part, not below those that it has.
[[nodiscard]] inline std::vector<double> ray_shares(const std::vector<RayShare>& parts,
                                                    double target, double limit) {
    std::vector<double> wanted(parts.size());
    std::vector<bool> settled(parts.size(), false);
    for (bool again = true; again;) {
        double roots = 0, error = 0, rays = 0, pixels = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const RayShare& part = parts[i];
            pixels += part.pixels;
            if (!settled[i]) roots += part.pixels * std::sqrt(part.variance);
            if (!settled[i]) continue;
            error += part.pixels * part.variance / part.rays;
            rays += part.pixels * part.rays;
        }
        // [scale]
        // n = scale * sqrt(v): what the target asks for, if the limit allows it.
        const double spare = std::fmax(limit * pixels - rays, 0.0);
        const double allowed = target * pixels - error;
        double scale = roots > 0 ? spare / roots : 0.0;
        if (target > 0 && allowed > 0) scale = std::fmin(scale, roots / allowed);
        again = false;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (settled[i]) continue;
            wanted[i] = scale * std::sqrt(parts[i].variance);
            if (wanted[i] > parts[i].rays) continue;
            wanted[i] = parts[i].rays;
            settled[i] = again = true;
        }
        // [scale]
    }
    return wanted;
}

} // namespace ljus::detail
