#pragma once

/// \file ljus/math/polynomial.hpp
/// \brief All real roots of a polynomial in an interval, in ascending order.

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>

#include <glm/common.hpp>

#include "ljus/version.hpp"

namespace ljus::detail {

/// A polynomial p of degree N on [0, 1], given by its Bernstein coefficients c_i:
/// \f[ p(u) = \sum_{i=0}^{N} c_i \binom{N}{i} u^i (1 - u)^{N-i}. \f]
/// c_0 is p(0), and c_N is p(1). On [0, 1], p stays between the smallest and the
/// largest coefficient. The number of roots in (0, 1) is the number of sign changes of
/// the coefficients, or smaller by an even number \cite farouki2012.
template <std::floating_point T, std::size_t N>
struct BernsteinT {
    std::array<T, N + 1> c{}; ///< The coefficients c_0 to c_N.
};

/// The binomial coefficients 1, N, ..., N, 1 of (a + b)^N.
template <std::floating_point T, std::size_t N>
[[nodiscard]] constexpr std::array<T, N + 1> binomials() noexcept {
    std::array<T, N + 1> row{T(1)};
    for (std::size_t i = 1; i <= N; ++i) row[i] = row[i - 1] * T(N + 1 - i) / T(i);
    return row;
}

/// The value p(u), for u in [0, 1]. The error is at most 3 N units of roundoff times
/// the largest |c_i|.
template <std::floating_point T, std::size_t N>
[[nodiscard]] constexpr T value_at(const BernsteinT<T, N>& p, T u) noexcept {
    constexpr auto binomial = binomials<T, N>();
    const T v = T(1) - u;
    T power = T(1), sum = p.c[0];
    for (std::size_t i = 1; i <= N; ++i) {
        power *= u;
        sum = sum * v + binomial[i] * power * p.c[i];
    }
    return sum;
}

template <std::floating_point T, std::size_t N>
[[nodiscard]] constexpr BernsteinT<T, N - 1>
derivative(const BernsteinT<T, N>& p) noexcept {
    BernsteinT<T, N - 1> result;
    for (std::size_t i = 0; i < N; ++i) result.c[i] = T(N) * (p.c[i + 1] - p.c[i]);
    return result;
}

/// The number of sign changes of the coefficients; zeros do not count.
template <std::floating_point T, std::size_t N>
[[nodiscard]] constexpr int sign_changes(const BernsteinT<T, N>& p) noexcept {
    int changes = 0;
    T last = T(0);
    for (const T c : p.c) {
        changes += (last < T(0) && T(0) < c) || (c < T(0) && T(0) < last) ? 1 : 0;
        last = c != T(0) ? c : last;
    }
    return changes;
}

/// A bound on the rounding error of the values of a polynomial: 8 times the machine
/// epsilon times the largest |c_i|.
template <std::floating_point T, std::size_t N>
[[nodiscard]] constexpr T noise(const BernsteinT<T, N>& p) noexcept {
    T largest = T(0);
    for (const T c : p.c) largest = glm::max(largest, c < T(0) ? -c : c);
    return T(8) * std::numeric_limits<T>::epsilon() * largest;
}

/// The root between a and b of a polynomial p that has opposite signs at a and at b, by
/// Newton's method. If a step would leave the interval, or would be more than half as
/// long as the last step, the interval is bisected instead.
/// \return The root. Where p is steep, the error is about half the machine epsilon.
/// \cost At most 2 steps per bit of T's mantissa.
// [root_between]
template <std::floating_point T, std::size_t N>
[[nodiscard]] T root_between(const BernsteinT<T, N>& p, T a, T b) noexcept {
    constexpr T unit = std::numeric_limits<T>::epsilon() / T(2);
    const BernsteinT<T, N - 1> slope = derivative(p);
    const bool rises = value_at(p, a) < T(0) || value_at(p, b) > T(0);
    T u = a + (b - a) / T(2), last = b - a;
    for (int step = 0; step < 2 * std::numeric_limits<T>::digits; ++step) {
        const T value = value_at(p, u);
        ((value < T(0)) == rises ? a : b) = u;
        const T newton = u - value / value_at(slope, u);
        const bool shorter = std::abs(newton - u) <= last / T(2);
        const T next =
            a <= newton && newton <= b && shorter ? newton : a + (b - a) / T(2);
        last = std::abs(next - u);
        u = next;
        if (!(last > unit)) break;
    }
    return u;
}
// [root_between]

/// At most N + 1 roots of a polynomial of degree N. The polynomial has at most N
/// monotone pieces. roots() finds at most one root for each of the N + 1 ends of these
/// pieces.
template <std::floating_point T, std::size_t N>
struct RootsT {
    std::array<T, N + 1> at{}; ///< The roots: the first `count` elements.
    std::size_t count = 0;     ///< The number of roots.
    [[nodiscard]] const T* begin() const noexcept { return at.data(); }
    [[nodiscard]] const T* end() const noexcept { return at.data() + count; }
    void add(T root) noexcept { at[count++] = root; }
};

/// All roots of a polynomial p in [0, 1]. Between two neighbouring roots of its
/// derivative, p is monotone. In this interval p has one root if its signs at the two
/// ends differ, and otherwise none. The roots of the derivative are found in the same
/// way, down to degree 1 \cite yuksel2022. The leading coefficient may be tiny or 0.
/// \param p          The polynomial, with finite coefficients.
/// \param tolerance  The error of the coefficients. An extremum of p or an end of [0,
///                   1] counts as a root if |p| is at most `tolerance` there.
/// \return The roots in ascending order. Each is an exact root of a polynomial that
///         differs from p by at most 2 `tolerance` on [0, 1]. Near each exact root of p
///         there is a returned root. A root of multiplicity m appears 1 to m times.
/// \cost At most N (N + 1) / 2 calls of root_between(); mostly 0 or 1.
// [roots]
template <std::floating_point T, std::size_t N>
[[nodiscard]] RootsT<T, N> roots(const BernsteinT<T, N>& p, T tolerance) noexcept {
    RootsT<T, N> result;
    const auto is_zero = [&](T value) { return std::abs(value) <= tolerance; };
    const auto differ = [](T x, T y) {
        return (x < T(0) && T(0) < y) || (y < T(0) && T(0) < x);
    };
    const int changes = sign_changes(p);
    const bool at_end = is_zero(p.c[0]) || is_zero(p.c[N]);
    if (changes == 0 && !at_end) return result;

    // The ends of the monotone pieces.
    RootsT<T, N> ends;
    ends.add(T(0));
    if constexpr (N > 1)
        if (changes > 1 || at_end) {
            const BernsteinT<T, N - 1> slope = derivative(p);
            for (const T u : roots(slope, noise(slope)))
                if (ends.at[ends.count - 1] < u && u < T(1)) ends.add(u);
        }
    ends.add(T(1));

    T value = p.c[0];
    bool crossed = false; // whether p crosses zero in the previous piece
    for (std::size_t i = 0; i < ends.count; ++i) {
        const bool last = i + 1 == ends.count;
        const T next = last                  ? value
                       : i + 2 == ends.count ? p.c[N]
                                             : value_at(p, ends.at[i + 1]);
        const bool crosses = !last && differ(value, next);
        if (!crossed && !crosses && is_zero(value)) result.add(ends.at[i]);
        if (crosses) result.add(root_between(p, ends.at[i], ends.at[i + 1]));
        value = next;
        crossed = crosses;
    }
    return result;
}
// [roots]

/// The first point at which a polynomial p loses the sign that it has at 0.
/// \param p  The polynomial, with p(0) not 0.
/// \return The first u in (0, 1] where p crosses zero, or where p has an extremum with
///         |p| at most noise(p). Nothing if p keeps its sign or is NaN.
/// \cost Nothing is evaluated if all coefficients have the same sign. One root is
///       computed if the sign changes once.
template <std::floating_point T, std::size_t N>
[[nodiscard]] std::optional<T> first_change(const BernsteinT<T, N>& p) noexcept {
    const int changes = sign_changes(p);
    if (changes == 0) return std::nullopt;
    if (changes == 1) return root_between(p, T(0), T(1));
    const T sign = std::copysign(T(1), p.c[0]), touch = noise(p);
    const BernsteinT<T, N - 1> slope = derivative(p);
    T before = T(0);
    for (const T u : roots(slope, noise(slope))) {
        const T value = sign * value_at(p, u);
        if (value < T(0)) return root_between(p, before, u);
        if (value <= touch && before < u && u < T(1)) return u;
        before = u;
    }
    if (sign * p.c[N] < T(0)) return root_between(p, before, T(1));
    return std::nullopt;
}

} // namespace ljus::detail
