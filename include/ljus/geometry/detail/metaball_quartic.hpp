#pragma once

/// \file ljus/geometry/detail/metaball_quartic.hpp
/// \brief The field of metaballs along a ray is a quartic in each span between borders.

#include <array>
#include <concepts>
#include <limits>
#include <optional>

#include "ljus/geometry/detail/metaball_line.hpp"
#include "ljus/geometry/detail/quartic_formula.hpp"
#include "ljus/math/polynomial.hpp"

namespace ljus {

/// \addtogroup metaballs
/// \{

/// Solver: between two borders of blobs the field is a quartic, and the first sign
/// change of its Bernstein form is the hit. The points nearest to a centre also split
/// spans: a blob rises before and falls after, so most spans have at most one sign
/// change.
struct QuarticPieces {};

/// Solver: solves the same quartics by quartic_formula(), for comparison.
struct Radicals {};

namespace detail {

/// The quartic of a span, as a function of u in [0, 1] from its start to its end.
///
/// On [a, b] the Bernstein coefficients of \f$ s = h - k\tau^2 \f$, with
/// \f$ \tau = t - m \f$, are \f$ h - k\tau_a^2,\ h - k\tau_a\tau_b,\ h - k\tau_b^2 \f$;
/// those of s^2 are products of them, so no power of t is formed.
/// \param a     Start of the span.
/// \param b     Its end; no strand begins or ends between them.
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

/// The first sign change by the formula: the first of its roots in (0, 1].
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

/// The first hit of a ray on metaballs, span by span.
/// \report{Section 2.1}
/// \return The first t where f changes its sign; nothing for a miss.
/// \cost n blobs have at most 3 n - 1 spans. A span costs n additions of a quartic and
///       at most 10 roots of first_change().
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
