#pragma once

/// \file ljus/radiosity/exchange_area.hpp
/// \brief The form factor between two flat patches, by integrals along their edges.

#include <array>
#include <cmath>
#include <numbers>

#include "ljus/geometry/facet.hpp"

namespace ljus {

/// \defgroup exchange_area Exchange areas
/// \brief Section 2.2 of the report: the exchange area of two patches is the area of
/// one patch times its form factor to the other. The exchange area is symmetric.
/// \{

namespace detail {

// The integral of ln(sqrt(t^2 + d^2) / unit) over t, from 0 to z; d is at least 0.
[[nodiscard]] inline double log_once(double z, double d, double unit) noexcept {
    const double r2 = z * z + d * d;
    if (!(r2 > 0)) return 0;
    return z * std::log(r2 / (unit * unit)) / 2 - z + d * std::atan2(z, d);
}

// The integral of log_once() over its first argument, from 0 to z, without the term
// -3/4 z^2.
[[nodiscard]] inline double log_twice(double z, double d, double unit) noexcept {
    const double r2 = z * z + d * d;
    if (!(r2 > 0)) return 0;
    return (z - d) * (z + d) * std::log(r2 / (unit * unit)) / 4 +
           d * z * std::atan2(z, d);
}

// Nodes in (0, 1) and weights of the double exponential rule, which suits integrands
// that behave like s ln s at an end.
struct EdgeRule {
    static constexpr int count = 49;
    std::array<double, count> place{};
    std::array<double, count> weight{};

    EdgeRule() noexcept {
        for (int i = 0; i < count; ++i) {
            const double t = (i - count / 2) / 8.0;
            const double steep = std::numbers::pi * std::sinh(t);
            const double across = std::cosh(steep / 2);
            place[static_cast<std::size_t>(i)] = 1 / (1 + std::exp(-steep));
            weight[static_cast<std::size_t>(i)] =
                std::numbers::pi * std::cosh(t) / (4 * across * across) / 8;
        }
    }
};

[[nodiscard]] inline const EdgeRule& edge_rule() noexcept {
    static const EdgeRule rule;
    return rule;
}

// The integral over two distant edges, by Gauss's rule with six points on each edge. If
// the edges are six lengths of the longer one apart, the rule is exact to the last
// digit. The closed form would be a small difference of large numbers.
[[nodiscard]] inline double edges_apart(const glm::dvec3& way, const glm::dvec3& u,
                                        const glm::dvec3& v, double unit) noexcept {
    constexpr std::array place{0.03376524289842397, 0.1693953067668678,
                               0.38069040695840156, 0.6193095930415985,
                               0.8306046932331322,  0.966234757101576};
    constexpr std::array weight{0.08566224618958516, 0.1803807865240693,
                                0.2339569672863455,  0.2339569672863455,
                                0.1803807865240693,  0.08566224618958516};
    double sum = 0;
    for (std::size_t i = 0; i < place.size(); ++i)
        for (std::size_t k = 0; k < place.size(); ++k) {
            const glm::dvec3 r = (way - place[i] * u + place[k] * v) / unit;
            sum += weight[i] * weight[k] * std::log(glm::dot(r, r)) / 2;
        }
    return glm::dot(u, v) * sum;
}

// The integral over two parallel edges, in closed form. The second edge starts at the
// distance `ahead` from the start of the first, measured along the second edge, and `d`
// across it. `back` is the length of the first edge, negative if the edges have
// opposite directions, and `length_v` that of the second.
[[nodiscard]] inline double parallel_edges(double ahead, double d, double back,
                                           double length_v, double unit) noexcept {
    const auto f = [&](double z) { return log_twice(z, d, unit); };
    return f(ahead + length_v) + f(ahead - back) - f(ahead + length_v - back) -
           f(ahead) - 1.5 * length_v * back;
}

// Splits the first edge at the points that are closest to the ends of the second edge
// and to its line. Returns ascending fractions of the first edge, including 0 and 1.
[[nodiscard]] inline std::array<double, 5>
pieces_of_edge(const glm::dvec3& way, const glm::dvec3& u, const glm::dvec3& v,
               double length_u, const glm::dvec3& along) noexcept {
    const glm::dvec3 off = u - glm::dot(u, along) * along;
    std::array<double, 5> ends{0, glm::dot(way, u) / (length_u * length_u),
                               glm::dot(way + v, u) / (length_u * length_u),
                               glm::dot(way, off) / glm::dot(off, off), 1};
    for (std::size_t i = 1; i < 4; ++i) {
        ends[i] = glm::clamp(ends[i], 0.0, 1.0);
        for (std::size_t k = i; ends[k] < ends[k - 1]; --k)
            std::swap(ends[k], ends[k - 1]);
    }
    return ends;
}

/// The integral of the logarithm of the distance r over two edges, times the cosine of
/// their angle phi. It is 0 for perpendicular edges, and has a closed form for parallel
/// edges. Otherwise the inner integral has a closed form, and the outer integral is
/// summed by the double exponential rule \cite takahasi1974. This rule allows
/// singularities at the ends of an interval only. The first edge is therefore split
/// where it is close to the second.
/// \param a, u  Start and vector of the first edge.
/// \param b, v  Start and vector of the second edge.
/// \param unit  A length that keeps the logarithm small.
/// \return \f$\cos\varphi \int\!\!\int \ln(r / \text{unit})\, ds\, dt\f$
[[nodiscard]] inline double edge_pair(const glm::dvec3& a, const glm::dvec3& u,
                                      const glm::dvec3& b, const glm::dvec3& v,
                                      double unit) noexcept {
    const double length_u = glm::length(u), length_v = glm::length(v);
    if (!(length_u > 0 && length_v > 0)) return 0;
    const glm::dvec3 along = v / length_v;
    const double cosine = glm::dot(u, along) / length_u;
    if (std::abs(cosine) < 1e-15) return 0;
    const glm::dvec3 way = b - a;
    const double longer = glm::max(length_u, length_v);
    if (glm::length(way) > 8 * longer) return edges_apart(way, u, v, unit);
    const double ahead = glm::dot(way, along);
    if (glm::length(glm::cross(u, along)) <= 1e-14 * length_u) {
        const double d = glm::length(way - ahead * along);
        return parallel_edges(ahead, d, std::copysign(length_u, cosine), length_v,
                              unit);
    }
    // The inner integral is over the second edge, for the point s of the first edge.
    const auto inner = [&](double s) {
        const glm::dvec3 from = way - s * u;
        const double z = glm::dot(from, along);
        const double d = glm::length(from - z * along);
        return log_once(z + length_v, d, unit) - log_once(z, d, unit);
    };
    const std::array<double, 5> ends = pieces_of_edge(way, u, v, length_u, along);
    const EdgeRule& rule = edge_rule();
    double sum = 0;
    for (std::size_t piece = 1; piece < ends.size(); ++piece) {
        const double first = ends[piece - 1], step = ends[piece] - first;
        if (!(step > 1e-12)) continue;
        for (std::size_t i = 0; i < rule.place.size(); ++i)
            sum += step * rule.weight[i] * inner(first + step * rule.place[i]);
    }
    return cosine * length_u * sum;
}

} // namespace detail

/// The exchange area of two facets with nothing between them: the area A of one facet
/// times the form factor F to the other. Each facet is first clipped by the plane of
/// the other. Stokes' theorem, applied to both areas, then gives an integral along the
/// edges \cite goral1984 :
/// \f[ A_1 F_{12} = \int_{A_1}\!\int_{A_2}
///     \frac{\cos\theta_1 \cos\theta_2}{\pi r^2}\, dA_2\, dA_1
///   = \frac{1}{2\pi} \oint\!\oint \ln r\; dx_1 \cdot dx_2. \f]
/// Here r is the distance of two points x_1 and x_2, and the angles theta are those of
/// the line between them to the normals. For facets of size s at the distance d, the
/// relative error is at most about \f$ 10^{-15} (d/s)^2 \f$.
/// \return In squared scene units, at least 0.
/// \cost 1 microsecond for two axis-aligned rectangles, 30 to 120 microseconds for two
///       that are close together at other angles.
/// \report{Section 2.2}
// [exchange_area]
[[nodiscard]] inline double exchange_area(const Facet& one, const Facet& two) noexcept {
    const glm::dvec3 n1 = glm::normalize(detail::area_vector(one));
    const glm::dvec3 n2 = glm::normalize(detail::area_vector(two));
    const double unit = glm::distance(one.corners[0], two.corners[0]) +
                        glm::distance(one.corners[0], one.corners[1]);
    const Facet a = detail::clipped(one, two.corners[0], n2, 1e-13 * unit);
    const Facet b = detail::clipped(two, one.corners[0], n1, 1e-13 * unit);
    double sum = 0;
    for (int i = 0; i < a.count; ++i) {
        const glm::dvec3& from = a.corners[static_cast<std::size_t>(i)];
        const glm::dvec3& to = a.corners[static_cast<std::size_t>((i + 1) % a.count)];
        for (int k = 0; k < b.count; ++k) {
            const glm::dvec3& start = b.corners[static_cast<std::size_t>(k)];
            const glm::dvec3& end =
                b.corners[static_cast<std::size_t>((k + 1) % b.count)];
            sum += detail::edge_pair(from, to - from, start, end - start, unit);
        }
    }
    return sum > 0 ? sum * std::numbers::inv_pi / 2 : 0;
}
// [exchange_area]

/// \}

/// \addtogroup form_factor
/// \{

/// The form factor from a rectangular floor to a wall that stands on one of its edges;
/// 0.2000438 for two unit squares \cite howell2010. All lengths must be above 0.
/// \param edge    Length of the common edge.
/// \param floor   Length of the floor perpendicular to this edge.
/// \param height  Height of the wall.
[[nodiscard]] inline double form_factor_corner(double edge, double floor,
                                               double height) noexcept {
    const double w = floor / edge, h = height / edge;
    const double w2 = w * w, h2 = h * h, s = h2 + w2;
    const double angles = w * std::atan(1 / w) + h * std::atan(1 / h) -
                          std::sqrt(s) * std::atan(1 / std::sqrt(s));
    const double logs = std::log((1 + w2) * (1 + h2) / (1 + s)) +
                        w2 * std::log(w2 * (1 + s) / ((1 + w2) * s)) +
                        h2 * std::log(h2 * (1 + s) / ((1 + h2) * s));
    return std::numbers::inv_pi / w * (angles + logs / 4);
}

/// \}

} // namespace ljus
