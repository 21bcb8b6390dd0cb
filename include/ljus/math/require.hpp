#pragma once

/// \file ljus/math/require.hpp
/// \brief Checks of input data. The message of a failed check is one sentence that says
/// what is wrong and what would be right.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup require Checks of input data
/// \brief Data are checked once: when a scene, a camera, a map or an image is made.
/// \{

namespace detail {

// Code that builds texts is slow to compile. The following functions are therefore
// compiled once, for all types of values.

// The concatenation of several texts.
[[nodiscard, gnu::cold]] LJUS_CORE_INLINE std::string
join(std::initializer_list<std::string_view> parts);

// Replaces the decimal comma of some locales by a point.
inline char* with_point(char* digits) {
    if (char* const comma = std::strchr(digits, ',')) *comma = '.';
    return digits;
}

// The text of one number, or of several numbers as the components of a vector. `single`
// means that the numbers are floats. See to_text().
[[nodiscard, gnu::cold]] LJUS_CORE_INLINE std::string
numbers_to_text(std::initializer_list<double> values, bool single);

#ifndef LJUS_CORE // otherwise defined in ljus::core
LJUS_CORE_INLINE std::string join(std::initializer_list<std::string_view> parts) {
    std::string text;
    for (const std::string_view part : parts) text.append(part);
    return text;
}

LJUS_CORE_INLINE std::string numbers_to_text(std::initializer_list<double> values,
                                             bool single) {
    const int most = single ? std::numeric_limits<float>::max_digits10
                            : std::numeric_limits<double>::max_digits10;
    std::string text;
    for (const double value : values) {
        char digits[40];
        for (int count = 6; count <= most; ++count) {
            std::snprintf(digits, sizeof digits, "%.*g", count, value);
            const double read = std::strtod(digits, nullptr);
            if (read == value || (single && float(read) == float(value))) break;
        }
        // snprintf writes at least two digits of an exponent: 1e-07 becomes 1e-7.
        with_point(digits);
        char* const e = std::strchr(digits, 'e');
        if (e != nullptr && e[2] == '0') std::memmove(e + 2, e + 3, std::strlen(e + 2));
        text.append(text.empty() ? "" : ", ");
        text.append(std::isnan(value)      ? "NaN"
                    : std::isfinite(value) ? digits
                    : value < 0            ? "-infinity"
                                           : "infinity");
    }
    return values.size() == 1 ? text : join({"(", text, ")"});
}
#endif

} // namespace detail

/// A number as text: -1, 0.5, 1e-7, 1e+30, NaN, infinity. It is rounded to 6 digits, or
/// to as many more as are needed to read the same value back.
template <std::floating_point T>
[[nodiscard, gnu::cold]] std::string to_text(T value) {
    return detail::numbers_to_text({double(value)}, std::is_same_v<T, float>);
}

/// A vector as text: (1, 0.5, -2).
template <std::floating_point T>
[[nodiscard, gnu::cold]] std::string to_text(const Vec3T<T>& v) {
    return detail::numbers_to_text({double(v.x), double(v.y), double(v.z)},
                                   std::is_same_v<T, float>);
}

/// An integer as text.
[[nodiscard, gnu::cold]] inline std::string to_text(long long value) {
    return std::to_string(value);
}

namespace detail {

// A function of its own, so that require() stays small where it is inlined.
template <typename Value>
[[noreturn, gnu::cold]] void refuse(std::string_view what, const Value& value,
                                    std::string_view right) {
    throw std::invalid_argument(
        join({what, " is ", to_text(value), "; it must be ", right, "."}));
}

} // namespace detail

/// Throws an exception if a condition fails.
/// \param ok     The condition that must hold.
/// \param what   The name of the value, e.g. "sphere.radius".
/// \param value  The value, shown in the message.
/// \param right  What would be right, e.g. "finite and above 0".
/// \throws std::invalid_argument  if `ok` is false.
template <typename Value>
void require(bool ok, std::string_view what, const Value& value,
             std::string_view right) {
    if (!ok) detail::refuse(what, value, right);
}

/// Requires that every component of a vector is finite; throws as require().
template <std::floating_point T>
void require_finite(std::string_view what, const Vec3T<T>& value) {
    require(is_finite(value), what, value, "finite in every component");
}

/// Requires that a vector is finite and not 0 and, in double, between 1e-150 and 1e150
/// long, so that it has a direction; throws as require().
template <std::floating_point T>
void require_direction(std::string_view what, const Vec3T<T>& value) {
    const Vec3T<WideT<T>> wide{value};
    const bool has_length = is_finite(value) && !is_black(value);
    require(std::isnormal(glm::dot(wide, wide)), what, value,
            has_length ? "between 1e-150 and 1e150 long, for it gives a direction"
                       : "finite and not 0, for it gives a direction");
}

/// Requires that a number is finite and above 0; throws as require().
template <std::floating_point T>
void require_positive(std::string_view what, T value) {
    require(std::isfinite(value) && value > T(0), what, value, "finite and above 0");
}

/// Requires that a count is at least `least`; throws as require().
inline void require_at_least(std::string_view what, long long value, long long least) {
    if (value < least)
        detail::refuse(what, value, detail::join({"at least ", to_text(least)}));
}

/// Requires that a number is within [0, 1]; throws as require().
template <std::floating_point T>
void require_unit(std::string_view what, T value) {
    require(value >= T(0) && value <= T(1), what, value, "within [0, 1]");
}

/// Requires that every channel of a colour is within [0, 1]; throws as require().
template <std::floating_point T>
void require_unit(std::string_view what, const RgbT<T>& value) {
    const bool ok = value.x >= T(0) && value.y >= T(0) && value.z >= T(0) &&
                    value.x <= T(1) && value.y <= T(1) && value.z <= T(1);
    require(ok, what, value, "within [0, 1] in every channel");
}

/// Requires that every channel of a colour is finite and at least 0; throws as
/// require().
template <std::floating_point T>
void require_radiance(std::string_view what, const RgbT<T>& value) {
    const bool ok =
        is_finite(value) && value.x >= T(0) && value.y >= T(0) && value.z >= T(0);
    require(ok, what, value, "finite and at least 0 in every channel");
}

/// \}

} // namespace ljus
