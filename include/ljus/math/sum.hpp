#pragma once

/// \file ljus/math/sum.hpp
/// \brief Sums of many terms with a small rounding error.

#include <concepts>
#include <cstddef>
#include <span>

#include "ljus/version.hpp"

namespace ljus::detail {

template <typename T>
[[nodiscard]] constexpr T pairwise_sum(const T* first, std::size_t count) noexcept {
    // Short runs are added plainly: calls would cost more than additions.
    if (count <= 16) {
        T sum(0);
        for (std::size_t i = 0; i < count; ++i) sum = sum + first[i];
        return sum;
    }
    const std::size_t half = count / 2;
    return pairwise_sum(first, half) + pairwise_sum(first + half, count - half);
}

/// The sum of numbers or colours, by pairwise summation: a list is cut into two halves,
/// and each half is summed in the same way. Each of n terms passes through at most
/// 16 + log2(n) additions, so that the rounding error grows like log n instead of n.
/// \param terms  Anything contiguous: a vector, an array, a span.
/// \return The sum; 0 for no terms.
template <typename Terms>
requires std::constructible_from < std::span<const typename Terms::value_type>,
const Terms& > [[nodiscard]] constexpr auto pairwise_sum(const Terms& terms) noexcept {
    const std::span<const typename Terms::value_type> all(terms);
    return pairwise_sum(all.data(), all.size());
}

} // namespace ljus::detail
