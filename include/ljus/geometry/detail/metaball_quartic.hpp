#pragma once

/// \file ljus/geometry/detail/metaball_quartic.hpp
/// \brief The field of metaballs along a ray: a quartic of t in each span of the ray.

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "ljus/geometry/detail/field_on_ray.hpp"
#include "ljus/geometry/ray.hpp"
#include "ljus/math/polynomial.hpp"
#include "ljus/version.hpp"

namespace ljus {

/// \defgroup metaballs Metaballs
/// \brief Section 2.1 of the report, footnote 2: "organic-looking n-dimensional
/// objects". Chapter:
/// \ref ch_metaballs.
/// \{

/// A source of a field. At the distance r from its centre, the field is
/// \f$ w (1 - r^2/R^2)^2 \f$ for r < R, and 0 beyond.
template <std::floating_point T>
struct BlobT {
    Vec3T<T> center{T(0)}; ///< The centre C, in scene units.
    T radius = T(1);       ///< The radius R at which the field ends, above 0.
    T weight = T(1);       ///< The weight w; a negative weight removes volume.
};
using Blob = BlobT<float>; ///< BlobT in float.

/// A solver. It splits the ray where the ray enters or leaves a blob and where it is
/// nearest to a centre. In each span the field is a quartic, and the first sign change
/// of a quartic is the hit. The field of a blob rises before the nearest point and
/// falls after it, so that most spans have at most one sign change.
struct QuarticPieces {};

/// A solver like QuarticPieces that finds roots by quartic_formula(), for comparison.
struct Radicals {};

namespace detail {

/// The largest absolute slope of \f$ (1 - q^2)^2 \f$ for q in [0, 1]: the slope at
/// \f$ q = 1/\sqrt 3 \f$.
template <std::floating_point T>
inline constexpr T steepest_blob = T(8) / (T(3) * std::numbers::sqrt3_v<T>);

/// The field of a blob of radius R along a ray is \f$ w\,\max(0, s(t))^2 \f$ with
/// \f$ s(t) = h - k (t - m)^2 \f$.
template <std::floating_point C>
struct StrandT {
    C enter = C(0);  ///< The t at which s becomes positive.
    C leave = C(0);  ///< The t at which s becomes negative again.
    C middle = C(0); ///< m, the t at which the ray is nearest to the centre.
    C height = C(0); ///< h = 1 - p^2/R^2, for a distance p from the centre to the
                     ///< ray.
    C bend = C(0);   ///< k = D.D / R^2, for the ray's direction D.
    C weight = C(1); ///< w, the weight of the blob.
};

/// The field of a blob along a ray. The vectors are subtracted before they are squared,
/// to avoid cancellation.
/// \return The strand, in double. Nothing for a miss, for non-finite data, a zero
///         direction, or a radius not above 0.
template <std::floating_point T>
[[nodiscard]] std::optional<StrandT<WideT<T>>> strand(const RayT<T>& ray,
                                                      const BlobT<T>& blob) noexcept {
    using C = WideT<T>;
    const Vec3T<C> d{ray.direction};
    const Vec3T<C> oc = Vec3T<C>{ray.origin} - Vec3T<C>{blob.center};
    const C r{blob.radius}, inverse_r = C(1) / r;
    const C a = glm::dot(d, d);
    const C middle = -glm::dot(oc, d) / a;
    const Vec3T<C> p = (oc + middle * d) * inverse_r;
    const C height = C(1) - glm::dot(p, p);
    const C bend = a * inverse_r * inverse_r;
    const C half = std::sqrt(height / bend);
    constexpr C max = std::numeric_limits<C>::max();
    const bool met = height > C(0) && half <= max && half > C(0) && r > C(0) &&
                     std::abs(middle) <= max && std::isfinite(C(blob.weight));
    if (!met) return std::nullopt;
    return StrandT<C>{middle - half, middle + half, middle,
                      height,        bend,          C(blob.weight)};
}

/// The strands of a ray. Up to 16 need no heap memory.
template <std::floating_point C>
struct StrandsT {
    std::array<StrandT<C>, 16> few; ///< Holds all strands if there are at most 16.
    std::vector<StrandT<C>> many{}; ///< Holds all strands if there are more than 16.
    std::size_t count = 0;          ///< Number of strands.
    void add(const StrandT<C>& strand) {
        if (count < few.size())
            few[count] = strand;
        else {
            if (many.empty()) many.assign(few.begin(), few.end());
            many.push_back(strand);
        }
        ++count;
    }
    [[nodiscard]] std::span<const StrandT<C>> all() const noexcept {
        return {many.empty() ? few.data() : many.data(), count};
    }
};

/// The field of metaballs along a ray. It satisfies FieldOnRay and SlopeOnRay.
template <std::floating_point C>
struct MetaballLineT {
    std::span<const StrandT<C>> strands{}; ///< The fields of the blobs along the ray.
    C level = C(0);                        ///< L, the level of the surface.
    C enter = C(0);                        ///< The t at which the first strand begins.
    C leave = C(-1);                       ///< The t at which the last strand ends.

    [[nodiscard]] C value(C t) const noexcept {
        C sum = -level;
        for (const auto& b : strands) {
            const C s = b.height - b.bend * (t - b.middle) * (t - b.middle);
            if (s > C(0)) sum += b.weight * s * s;
        }
        return sum;
    }
    /// A bound on |df/dt| along this ray: the sum of the steepest slopes of all
    /// strands.
    [[nodiscard]] C steepest() const noexcept {
        C sum = C(0);
        for (const auto& b : strands)
            sum += std::abs(b.weight) * b.height * std::sqrt(b.height * b.bend);
        return sum * steepest_blob<C>;
    }
    /// A bound on the rounding error of value().
    [[nodiscard]] C rounding() const noexcept {
        C sum = level;
        for (const auto& b : strands) sum += std::abs(b.weight);
        return C(8) * std::numeric_limits<C>::epsilon() * sum;
    }
    /// An interval that contains value(t) for all t in [from, to]. It is tight for a
    /// single strand.
    [[nodiscard]] IntervalT<C> range(C from, C to) const noexcept {
        const C doubt = rounding();
        IntervalT<C> sum{-level - doubt, -level + doubt};
        for (const auto& b : strands) {
            const auto s = height_in(b, from, to);
            const C low = b.weight * s.low * s.low, high = b.weight * s.high * s.high;
            sum.low += glm::min(low, high);
            sum.high += glm::max(low, high);
        }
        return sum;
    }
    /// An interval that contains the slope of the field for all t in [from, to]. The
    /// slope of a strand is -4 w k (t - m) s, in the symbols of StrandT.
    [[nodiscard]] IntervalT<C> slope(C from, C to) const noexcept {
        IntervalT<C> sum;
        for (const auto& b : strands) {
            const auto s = height_in(b, from, to);
            const C x = C(-4) * b.weight * b.bend * (from - b.middle);
            const C y = C(-4) * b.weight * b.bend * (to - b.middle);
            const C least = glm::min(x, y), most = glm::max(x, y);
            const C doubt = rounding() * glm::max(std::abs(x), std::abs(y));
            sum.low += glm::min(least * s.low, least * s.high) - doubt;
            sum.high += glm::max(most * s.low, most * s.high) + doubt;
        }
        return sum;
    }

private:
    // The range of max(s, 0) in [from, to].
    static IntervalT<C> height_in(const StrandT<C>& b, C from, C to) noexcept {
        const C near = glm::clamp(b.middle, from, to) - b.middle;
        const C far = glm::max(std::abs(from - b.middle), std::abs(to - b.middle));
        return {glm::max(C(0), b.height - b.bend * far * far),
                glm::max(C(0), b.height - b.bend * near * near)};
    }
};

/// Makes the field along a ray from its strands. The result refers to `strands`, and
/// must not be used after `strands` is destroyed.
/// \return The field. If there are no strands, `leave` is below `enter`.
template <std::floating_point C>
[[nodiscard]] MetaballLineT<C> line_of(const StrandsT<C>& strands, C level) noexcept {
    constexpr C far = std::numeric_limits<C>::infinity();
    MetaballLineT<C> line{strands.all(), level, far, -far};
    for (const auto& b : line.strands) {
        line.enter = glm::min(line.enter, b.enter);
        line.leave = glm::max(line.leave, b.leave);
    }
    return line;
}

/// The real roots of c[0] + c[1] x + ... + c[4] x^4 by radicals (Ferrari 1545), for
/// comparison with roots().
///
/// The polynomial is divided by c[4]. Let b be the new coefficient of x^3. The
/// substitution \f$ x = y - b/4 \f$ gives \f$ y^4 + p y^2 + q y + r = 0 \f$. A root z
/// of the resolvent \f$ z^3 - \frac p2 z^2 - r z + \frac{pr}{2} - \frac{q^2}{8} \f$
/// turns this equation into a difference of two squares, which is a product of two
/// quadratics.
/// \param c  The coefficients; c[4] is not 0.
/// \return The roots, unordered. At least about half of their digits are correct if the
///         roots are well separated and c[4] is not small. Otherwise they are
///         unreliable, because the steps subtract nearly equal numbers.
/// \cost Two cube roots, or a cosine and its inverse; up to 5 square roots.
/// \report{Section 2.1} \cite schwarze1990
template <std::floating_point T>
[[nodiscard]] RootsT<T, 4> quartic_formula(const std::array<T, 5>& c) noexcept {
    const T b = c[3] / c[4], d = c[2] / c[4], e = c[1] / c[4], f = c[0] / c[4];
    const T p = d - T(3) / T(8) * b * b;
    const T q = e - b * d / T(2) + b * b * b / T(8);
    const T r = f - b * e / T(4) + b * b * d / T(16) - T(3) / T(256) * b * b * b * b;

    // One real root z of the resolvent cubic, by Cardano or by the cosine.
    const T b3 = -p / T(2), c3 = -r, d3 = r * p / T(2) - q * q / T(8);
    const T p3 = (c3 - b3 * b3 / T(3)) / T(3);
    const T q3 = (T(2) / T(27) * b3 * b3 * b3 - b3 * c3 / T(3) + d3) / T(2);
    const T discriminant = q3 * q3 + p3 * p3 * p3;
    T z = -b3 / T(3);
    if (discriminant < T(0)) {
        const T size = std::sqrt(-p3);
        z += T(2) * size * std::cos(std::acos(-q3 / (size * size * size)) / T(3));
    } else {
        const T root = std::sqrt(discriminant);
        z += std::cbrt(root - q3) - std::cbrt(root + q3);
    }

    // (y^2 + z)^2 = (v y - w)^2
    constexpr T nothing = T(1e-9); // Schwarze's value for every quartic
    const auto positive = [](T x) { return std::abs(x) < nothing ? T(0) : x; };
    const T u2 = positive(z * z - r), v2 = positive(T(2) * z - p);
    RootsT<T, 4> result;
    if (!(u2 >= T(0) && v2 >= T(0))) return result;
    const T w = std::copysign(std::sqrt(u2), q), v = std::sqrt(v2);
    for (const T sign : {T(-1), T(1)}) {
        const T half = -sign * v / T(2); // of y^2 + sign v y + z - sign w
        const T under = positive(half * half - (z - sign * w));
        if (!(under >= T(0))) continue;
        result.add(half - std::sqrt(under) - b / T(4));
        result.add(half + std::sqrt(under) - b / T(4));
    }
    return result;
}

/// The field in a span [a, b] of a ray, as a quartic of u = (t - a)/(b - a). No strand
/// may begin or end between a and b.
///
/// The field of a strand is w s^2 with \f$ s = h - k (t - m)^2 \f$, see StrandT. Let
/// \f$ \tau_a = a - m \f$ and \f$ \tau_b = b - m \f$. On [a, b] the Bernstein
/// coefficients of s are \f$ h - k\tau_a^2,\ h - k\tau_a\tau_b,\ h - k\tau_b^2 \f$. The
/// coefficients of s^2 are sums of products of these.
// [quartic]
template <std::floating_point C>
[[nodiscard]] BernsteinT<C, 4> quartic(const MetaballLineT<C>& line, C a,
                                       C b) noexcept {
    BernsteinT<C, 4> p;
    p.c.fill(-line.level);
    for (const auto& strand : line.strands) {
        if (!(strand.enter <= a && b <= strand.leave)) continue;
        const C ta = a - strand.middle, tb = b - strand.middle;
        const C s0 = strand.height - strand.bend * ta * ta;
        const C s1 = strand.height - strand.bend * ta * tb;
        const C s2 = strand.height - strand.bend * tb * tb;
        p.c[0] += strand.weight * s0 * s0;
        p.c[1] += strand.weight * s0 * s1;
        p.c[2] += strand.weight * (s0 * s2 + C(2) * s1 * s1) / C(3);
        p.c[3] += strand.weight * s1 * s2;
        p.c[4] += strand.weight * s2 * s2;
    }
    return p;
}
// [quartic]

/// The first sign change of a quartic in [0, 1], from its Bernstein form.
template <std::floating_point C>
[[nodiscard]] std::optional<C> first_change(const QuarticPieces&,
                                            const BernsteinT<C, 4>& p) noexcept {
    return first_change(p);
}

/// The first root in (0, 1] that quartic_formula() finds.
template <std::floating_point C>
[[nodiscard]] std::optional<C> first_change(const Radicals&,
                                            const BernsteinT<C, 4>& p) noexcept {
    const auto& c = p.c;
    const std::array<C, 5> powers{c[0], C(4) * (c[1] - c[0]),
                                  C(6) * (c[0] - C(2) * c[1] + c[2]),
                                  C(4) * (c[3] - C(3) * (c[2] - c[1]) - c[0]),
                                  c[0] - C(4) * (c[1] + c[3]) + C(6) * c[2] + c[4]};
    std::optional<C> first;
    for (const C u : quartic_formula(powers))
        if (C(0) < u && u <= first.value_or(C(1))) first = u;
    return first;
}

/// Finds the first hit of a ray on metaballs, span by span.
/// \report{Section 2.1}
/// \return The first t where f changes its sign; nothing for a miss.
/// \cost A ray that meets n blobs has at most 3 n - 1 spans. For each span, n quartics
///       are added, and first_change() searches at most 7 intervals for a root.
// [first meeting]
template <typename Solver, std::floating_point C>
requires(std::same_as<Solver, QuarticPieces> || std::same_as<Solver, Radicals>)
    [[nodiscard]] std::optional<C> first_meeting(const Solver& solver,
                                                 const MetaballLineT<C>& line, C t_min,
                                                 C t_max) noexcept {
    C a = glm::max(t_min, line.enter);
    const C end = glm::min(t_max, line.leave);
    if (!(a < end)) return std::nullopt;
    const bool inside = line.value(a) >= C(0);
    // [first meeting]
    // [spans]
    while (a < end) {
        C b = end; // the next border
        for (const auto& strand : line.strands) {
            if (a < strand.enter && strand.enter < b) b = strand.enter;
            if (a < strand.leave && strand.leave < b) b = strand.leave;
            if constexpr (std::same_as<Solver,
                                       QuarticPieces>) // at most one change each
                if (a < strand.middle && strand.middle < b) b = strand.middle;
        }
        BernsteinT<C, 4> p = quartic(line, a, b);
        if ((p.c[0] >= C(0)) != inside) return a; // at a border, by rounding
        if (p.c[0] == C(0)) p.c[0] = std::numeric_limits<C>::min(); // on it is inside
        if (const auto u = first_change(solver, p)) return a + *u * (b - a);
        a = b;
    }
    return std::nullopt;
}
// [spans]

} // namespace detail

/// \}

} // namespace ljus
