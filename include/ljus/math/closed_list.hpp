#pragma once

/// \file ljus/math/closed_list.hpp
/// \brief Closed lists of types: one array per type, visited by type number and index.

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

#include "ljus/version.hpp"

namespace ljus::detail {

/// The index of a type in a list; that of the last type if no other one matches.
template <typename X, typename First, typename... List>
inline constexpr std::uint32_t type_number = 0;
/// The case of at least two types.
template <typename X, typename First, typename Second, typename... List>
inline constexpr std::uint32_t type_number<X, First, Second, List...> =
    std::is_same_v<X, First> ? 0 : 1 + type_number<X, Second, List...>;

/// True if no type is listed twice.
template <typename... T>
inline constexpr bool each_once = true;
/// The first type differs from all others, and these are distinct.
template <typename First, typename... T>
inline constexpr bool each_once<First, T...> =
    !(std::is_same_v<First, T> || ...) && each_once<T...>;

/// Calls f(element) with one element of a tuple of arrays, in the element's own type.
/// The last type is not tested for, so that a list of one type needs no comparison.
template <std::size_t I = 0, typename Tuple, typename F>
decltype(auto) visit_element(const Tuple& arrays, std::uint32_t type,
                             std::uint32_t index, F& f) {
    if constexpr (I + 1 < std::tuple_size_v<Tuple>) {
        if (type != I) return visit_element<I + 1>(arrays, type, index, f);
    }
    return f(std::get<I>(arrays)[index]);
}

/// Calls f(array) with each array of a tuple. All have different types.
template <typename... A, typename F>
void each_array([[maybe_unused]] const std::tuple<A...>& arrays, F&& f) {
    (f(std::get<A>(arrays)), ...);
}

/// Whether f(array) is true for an array of a tuple; those after it are not asked.
template <typename... A, typename F>
[[nodiscard]] bool any_array([[maybe_unused]] const std::tuple<A...>& arrays, F&& f) {
    return (f(std::get<A>(arrays)) || ...);
}

} // namespace ljus::detail
