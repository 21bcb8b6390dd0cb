#pragma once

/// \file ljus/math/sum.hpp
/// \brief Sums of many terms that keep their digits.

#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

#include "ljus/version.hpp"

namespace ljus {

/// \defgroup sum Sums
/// \brief A plain float sum of 10^8 equal terms stops at 2^24 of them: 83 % are lost.
/// \{

/// A running sum in twice the digits of T: the sum, and what it lacks.
///
/// Neumaier's (1974) sum, which copes with terms larger than the sum, but with what is
/// lacking taken into the sum again at each step. Neumaier's own form gathers it in a
/// number that in the end stops growing as well: in float, 66 % of 10^8 terms are lost.
template <std::floating_point T>
struct CompensatedSumT {
    T sum = T(0);  ///< The sum, rounded to T.
    T lack = T(0); ///< What is to be added to `sum`, below half a unit of it.
};
using CompensatedSum = CompensatedSumT<double>; ///< CompensatedSumT in double.

/// Adds a term to a compensated sum.
/// \param total  The sum, changed.
/// \param term   Any number; NaN and infinity stay in the sum, as in a plain one.
/// \cost 11 additions, one test.
template <std::floating_point T>
constexpr void add(CompensatedSumT<T>& total, T term) noexcept {
    // Knuth's two-sum: sum + term = rounded + error, exactly.
    const T rounded = total.sum + term;
    const T part = rounded - total.sum;
    const T error = (total.sum - (rounded - part)) + (term - part);

    const T lack = total.lack + error;
    const T sum = rounded + lack;
    // Infinity minus infinity is NaN: then there is nothing to compensate.
    const bool finite = sum - sum == T(0);
    total.sum = finite ? sum : rounded;
    total.lack = finite ? lack - (sum - rounded) : T(0);
}

/// The sum of numbers as if in twice their digits, rounded once.
/// \param terms  Anything contiguous: a vector, an array, a span.
/// \return The sum; 0 for no terms. Its error is about one unit of roundoff plus
///         n u^2 sum |term| for n terms.
/// \cost As add() for each term.
template <typename Terms>
requires std::constructible_from < std::span<const typename Terms::value_type>,
const Terms& >
    [[nodiscard]] constexpr auto compensated_sum(const Terms& terms) noexcept {
    using T = std::remove_cv_t<typename Terms::value_type>;
    CompensatedSumT<T> total;
    for (const T term : std::span<const T>(terms)) add(total, term);
    return total.sum;
}

namespace detail {

template <typename T>
[[nodiscard]] constexpr T pairwise_sum(const T* first, std::size_t count) noexcept {
    // Short runs are added plainly: the calls would cost more than the terms.
    if (count <= 16) {
        T sum(0);
        for (std::size_t i = 0; i < count; ++i) sum = sum + first[i];
        return sum;
    }
    const std::size_t half = count / 2;
    return pairwise_sum(first, half) + pairwise_sum(first + half, count - half);
}

/// The sum of numbers or colours by halves: each half is summed in the same way.
///
/// No term passes through more than 16 + log2(n) additions, so that the error grows
/// like log n instead of n, at the price of a plain sum.
/// \param terms  Anything contiguous: a vector, an array, a span.
/// \return The sum; 0 for no terms.
/// \cost One addition a term.
template <typename Terms>
requires std::constructible_from < std::span<const typename Terms::value_type>,
const Terms& > [[nodiscard]] constexpr auto pairwise_sum(const Terms& terms) noexcept {
    const std::span<const typename Terms::value_type> all(terms);
    return detail::pairwise_sum(all.data(), all.size());
}

} // namespace detail

/// \}

} // namespace ljus
