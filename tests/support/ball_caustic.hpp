#pragma once

/// \file support/ball_caustic.hpp
/// \brief The light of a point light through a ball, by geometric optics in closed
/// form.

#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <numbers>

#include "support/closed_forms.hpp"

namespace ljus_test {

/// A ball above a floor, with a point light above it on the vertical axis of the ball.
///
/// A ray leaves the light at an angle alpha from the axis, and meets the ball at the
/// angle phi = theta_i - alpha from its top. The angle of incidence theta_i satisfies
/// sin theta_i = (D/R) sin alpha, with the distance D of the light and the radius R of
/// the ball. The angle of refraction is theta_t. Each chord through the ball turns by
/// pi - 2 theta_t around its centre. After k inner reflections the ray leaves at phi_e
/// = theta_i - alpha + (k + 1)(pi - 2 theta_t) in the direction phi_e + theta_i, with
/// the fraction (1 - F)^2 F^k of its light, where F is the Fresnel reflectance. k = -1
/// is the reflection at the first boundary, with the fraction F.
struct BallCaustic {
    double light = 2;      ///< D: distance from the centre of the ball to the light.
    double floor = 1;      ///< Distance from the centre of the ball to the floor.
    double radius = 0.5;   ///< R: radius of the ball.
    double index = 1.5;    ///< Index of refraction.
    double intensity = 1;  ///< Intensity of the light, W/sr.
    double absorption = 0; ///< Absorption inside the ball, per unit of length.

    /// The largest angle alpha at which a ray meets the ball.
    [[nodiscard]] double last() const { return std::asin(radius / light); }

    /// The point where a ray lands.
    struct Arrival {
        bool lands = false; ///< Whether the ray reaches the floor.
        double rho = 0;     ///< Signed distance from the axis, on the floor.
        double share = 0;   ///< Fraction of the light that takes this path.
    };

    /// The ray that leaves at alpha, after k inner reflections.
    [[nodiscard]] Arrival trace(double alpha, int k) const {
        const double si = std::sin(alpha) * light / radius;
        const double ti = std::asin(si), tt = std::asin(si / index);
        const double f = fresnel_share(std::cos(ti), 1, index);
        const double exit = ti - alpha + (k + 1) * (std::numbers::pi - 2 * tt);
        const double way = exit + ti;
        Arrival result;
        result.lands = std::cos(way) < -1e-9;
        result.rho = radius * std::sin(exit) +
                     (radius * std::cos(exit) + floor) * -std::tan(way);
        const double chord = 2 * radius * std::cos(tt);
        result.share = k < 0 ? f
                             : (1 - f) * (1 - f) * std::pow(f, k) *
                                   std::exp(-absorption * chord * (k + 1));
        return result;
    }

    /// Sums over all light that lands.
    /// \param add    Called as add(rho, flux), with rho >= 0.
    /// \param first  -1 to include the reflection at the outside; 0 without it.
    /// \param steps  Number of rays between the axis and the edge of the ball.
    template <typename Add>
    void shower(Add add, int first = -1, int steps = 40000) const {
        const double width = last() / steps;
        for (int i = 0; i < steps; ++i) {
            const double alpha = (i + 0.5) * width;
            const double flux =
                intensity * 2 * std::numbers::pi * std::sin(alpha) * width;
            for (int k = first; k < 40; ++k) {
                const Arrival at = trace(alpha, k);
                if (at.lands) add(std::abs(at.rho), flux * at.share);
                if (k > 3 && at.share < 1e-9) break;
            }
        }
    }

    /// The irradiance of the floor at the distance rho from the axis. Each path to that
    /// distance adds I sin(alpha) share / (rho |d rho / d alpha|), where I is the
    /// intensity.
    [[nodiscard]] double irradiance(double rho, int first = -1,
                                    int steps = 4000) const {
        double sum = 0;
        const double width = last() / steps;
        for (int k = first; k < 12; ++k)
            for (int i = 0; i < steps; ++i) {
                const double a = i * width, b = (i + 1) * width * (1 - 1e-12);
                const Arrival from = trace(a, k), to = trace(b, k);
                if (!from.lands || !to.lands) continue;
                for (const double at : {rho, -rho}) {
                    if ((from.rho < at) == (to.rho < at)) continue;
                    const double slope = (to.rho - from.rho) / (b - a);
                    const double alpha = a + (at - from.rho) / slope;
                    const double share = trace(alpha, k).share;
                    sum +=
                        intensity * std::sin(alpha) * share / (rho * std::abs(slope));
                }
            }
        return sum;
    }
};

} // namespace ljus_test
