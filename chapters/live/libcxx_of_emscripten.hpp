#pragma once

/// \file libcxx_of_emscripten.hpp
/// \brief What the C++ library of emscripten 3.1.6 (LLVM 14, of Debian 12) lacks of
/// C++20, for the live figures: included before everything else, where it is needed.

#include <cstddef>
#include <memory>
#include <type_traits>
#include <version>

#ifndef __cpp_lib_bit_cast
namespace std {
template <typename To, typename From>
[[nodiscard]] constexpr To bit_cast(const From& from) noexcept {
    static_assert(sizeof(To) == sizeof(From));
    return __builtin_bit_cast(To, from);
}
} // namespace std
#endif

#ifndef __cpp_lib_smart_ptr_for_overwrite
namespace std {
template <typename T>
requires std::is_unbounded_array_v<T>
[[nodiscard]] std::unique_ptr<T> make_unique_for_overwrite(std::size_t count) {
    return std::unique_ptr<T>(new std::remove_extent_t<T>[count]);
}
} // namespace std
#endif
