#pragma once

/// \file support/shown.hpp
/// \brief Lets a failed check print vectors, colours and optional results.
///
/// tests/CMakeLists.txt includes this header in each test. Without it doctest prints
/// {?}.

#include <optional>

#include <doctest/doctest.h>
#include <glm/vec3.hpp>

namespace doctest {

/// Prints a vector as (1, 2, 3).
template <glm::length_t size, typename T, glm::qualifier Q>
struct StringMaker<glm::vec<size, T, Q>> {
    static String convert(const glm::vec<size, T, Q>& v) {
        String text = "(";
        for (glm::length_t i = 0; i < size; ++i)
            text += (i > 0 ? String(", ") : String()) + toString(v[i]);
        return text + ")";
    }
};

/// Prints the value of an optional, or "nothing". A value that cannot be printed is
/// {?}.
template <typename T>
struct StringMaker<std::optional<T>> {
    static String convert(const std::optional<T>& value) {
        return value ? toString(*value) : String("nothing");
    }
};

} // namespace doctest
