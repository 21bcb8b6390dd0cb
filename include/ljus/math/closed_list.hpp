#pragma once

/// \file ljus/math/closed_list.hpp
/// \brief Closed lists of types: one array per type, and one element of them all.

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

#include "ljus/version.hpp"

namespace ljus::detail {

/// The position of a type in a list; that of the last one, whatever the type is.
template <typename X, typename First, typename... List>
inline constexpr std::uint32_t type_number = 0;
/// There is more than one left.
template <typename X, typename First, typename Second, typename... List>
inline constexpr std::uint32_t type_number<X, First, Second, List...> =
    std::is_same_v<X, First> ? 0 : 1 + type_number<X, Second, List...>;

/// Whether no type is listed twice.
template <typename... T>
inline constexpr bool each_once = true;
/// The first is not among the rest, and neither is any of them listed twice.
template <typename First, typename... T>
inline constexpr bool each_once<First, T...> =
    !(std::is_same_v<First, T> || ...) && each_once<T...>;

/// Calls f(element) with one element of a tuple of arrays, as its own type.
///
/// The last type needs no comparison: with one type listed, none is made at all.
/// \param arrays  One array per type.
/// \param type    Which array.
/// \param index   Which of its elements.
/// \param f       The function.
template <std::size_t I = 0, typename Tuple, typename F>
decltype(auto) visit_element(const Tuple& arrays, std::uint32_t type,
                             std::uint32_t index, F& f) {
    if constexpr (I + 1 < std::tuple_size_v<Tuple>) {
        if (type != I) return visit_element<I + 1>(arrays, type, index, f);
    }
    return f(std::get<I>(arrays)[index]);
}

} // namespace ljus::detail
