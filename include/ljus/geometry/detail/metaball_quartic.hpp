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

/// Solver: in each span between two borders of blobs the field is a quartic; its first
/// change of sign is that of first_change(). The places nearest to a centre split
/// spans, too: a blob rises before and falls behind, so that most spans change at most
/// once.
struct QuarticPieces {};

/// Solver: the same quartics by the formula, quartic_formula(). For the lesson.
struct Radicals {};

namespace detail {

/// The quartic of a span, as a function of u in [0, 1] from its begin to its end.
///
/// On [a, b] the Bernstein coefficients of \f$ s = h - k\tau^2 \f$, with
/// \f$ \tau = t - m \f$, are \f$ h - k\tau_a^2,\ h - k\tau_a\tau_b,\ h - k\tau_b^2 \f$;
/// those of s^2 are products of them, and no power of t is ever formed.
/// \param line  The field.
/// \param a     The span's begin.
/// \param b     Its end: no strand begins or ends between them.
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

/// The first change of sign of a quartic on [0, 1], by robust pieces.
template <std::floating_point C>
[[nodiscard]] std::optional<C> first_change(const QuarticPieces&,
                                            const BernsteinT<C, 4>& p) noexcept {
    return first_change(p);
}

/// The same by the formula: the first of its roots in (0, 1].
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

/// Where a ray first meets metaballs, span by span.
/// \report{Section 2.1}
/// \param solver  QuarticPieces or Radicals.
/// \param line    The field on the ray.
/// \param t_min   First t that counts.
/// \param t_max   Last t that counts.
/// \return The first t where f changes its sign; nothing for a miss.
/// \cost A span has at most 10 roots of first_change() to find; n blobs have at most
///       3 n - 1 spans, and a span costs n additions of a quartic.
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
