#pragma once

/// \file ljus/math/require.hpp
/// \brief The checks at the border of the library, each with a sentence to act on.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup require Checks at the border
/// \brief Data are checked once, where a scene, a camera, a map or an image is made.
/// \{

namespace detail {

// What follows is one function for all types: text takes a compiler long.

// See to_text(); `single` says that the value came from a float.
[[nodiscard]] LJUS_CORE_INLINE std::string number_text(double value, bool single);

// Throws the sentence of require().
[[noreturn]] LJUS_CORE_INLINE void refuse_text(std::string_view what,
                                               std::string_view value,
                                               std::string_view right);

#ifndef LJUS_CORE // else they are there already
LJUS_CORE_INLINE std::string number_text(double value, bool single) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value < 0 ? "-infinity" : "infinity";
    char digits[40];
    const int most = single ? std::numeric_limits<float>::max_digits10
                            : std::numeric_limits<double>::max_digits10;
    for (int count = 6; count <= most; ++count) {
        std::snprintf(digits, sizeof digits, "%.*g", count, value);
        const double read = std::strtod(digits, nullptr);
        if (read == value || (single && float(read) == float(value))) break;
    }
    // C writes at least two digits of an exponent: 1e-07.
    char* const e = std::strchr(digits, 'e');
    if (e != nullptr && e[2] == '0') std::memmove(e + 2, e + 3, std::strlen(e + 2));
    return digits;
}

LJUS_CORE_INLINE void refuse_text(std::string_view what, std::string_view value,
                                  std::string_view right) {
    std::string text;
    for (const std::string_view part : {what, std::string_view(" is "), value,
                                        std::string_view("; it must be "), right,
                                        std::string_view(".")})
        text.append(part);
    throw std::invalid_argument(text);
}
#endif

} // namespace detail

/// A number as a person writes it: -1, 0.5, 1e-7, 1e+30, NaN, infinity; with as many
/// digits, from 6 on, as bring the same value back, so that 1.0000001 is not "1".
/// \param value  Any number.
/// \return The text.
template <std::floating_point T>
[[nodiscard]] std::string to_text(T value) {
    return detail::number_text(double(value), std::is_same_v<T, float>);
}

/// A vector as a message shows it.
template <std::floating_point T>
[[nodiscard]] std::string to_text(const Vec3T<T>& v) {
    std::string text;
    for (int i = 0; i < 3; ++i)
        text.append(i == 0 ? "(" : ", ").append(to_text(v[i]));
    return text.append(")");
}

/// An integer as a message shows it.
[[nodiscard]] inline std::string to_text(long long value) {
    return std::to_string(value);
}

namespace detail {

// Apart from the check, which is everywhere and has nothing to say.
template <typename Value>
[[noreturn]] void refuse(std::string_view what, const Value& value,
                         std::string_view right) {
    refuse_text(what, to_text(value), right);
}

} // namespace detail

/// Refuses a value with one sentence: what it is, its value, what would be right.
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

/// Refuses a vector with a NaN or infinite component.
/// \param what   The name of the vector.
/// \param value  The vector.
/// \throws std::invalid_argument  as require().
template <std::floating_point T>
void require_finite(std::string_view what, const Vec3T<T>& value) {
    require(is_finite(value), what, value, "finite in every component");
}

/// Refuses a number that is not finite and above 0.
/// \param what   The name of the number.
/// \param value  The number.
/// \throws std::invalid_argument  as require().
template <std::floating_point T>
void require_positive(std::string_view what, T value) {
    require(std::isfinite(value) && value > T(0), what, value, "finite and above 0");
}

/// Refuses a number outside [0, 1].
/// \param what   The name of the number.
/// \param value  The number.
/// \throws std::invalid_argument  as require().
template <std::floating_point T>
void require_unit(std::string_view what, T value) {
    require(value >= T(0) && value <= T(1), what, value, "within [0, 1]");
}

/// Refuses a colour with a channel outside [0, 1].
/// \param what   The name of the colour.
/// \param value  The colour.
/// \throws std::invalid_argument  as require().
template <std::floating_point T>
void require_unit(std::string_view what, const RgbT<T>& value) {
    const bool ok = value.x >= T(0) && value.y >= T(0) && value.z >= T(0) &&
                    value.x <= T(1) && value.y <= T(1) && value.z <= T(1);
    require(ok, what, value, "within [0, 1] in every channel");
}

/// Refuses a colour with a negative, NaN or infinite channel.
/// \param what   The name of the colour.
/// \param value  The colour.
/// \throws std::invalid_argument  as require().
template <std::floating_point T>
void require_radiance(std::string_view what, const RgbT<T>& value) {
    const bool ok =
        is_finite(value) && value.x >= T(0) && value.y >= T(0) && value.z >= T(0);
    require(ok, what, value, "finite and at least 0 in every channel");
}

/// \}

} // namespace ljus
