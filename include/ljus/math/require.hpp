#pragma once

/// \file ljus/math/require.hpp
/// \brief The checks at the border of the library, each with a sentence to act on.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup require Checks at the border
/// \brief Data are checked once, where a scene, a camera, a map or an image is made.
/// \{

/// A number as a person writes it: -1, 0.5, 1e-7, 1e+30, NaN, infinity; with as many
/// digits, from 6 on, as bring the same value back, so that 1.0000001 is not "1".
/// \param value  Any number.
/// \return The text.
template <std::floating_point T>
[[nodiscard]] std::string to_text(T value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value < T(0) ? "-infinity" : "infinity";
    char digits[40];
    for (int count = 6; count <= std::numeric_limits<T>::max_digits10; ++count) {
        std::snprintf(digits, sizeof digits, "%.*g", count, double(value));
        if (static_cast<T>(std::strtod(digits, nullptr)) == value) break;
    }
    std::string text = digits;
    // C writes at least two digits of an exponent: 1e-07.
    const std::size_t e = text.find('e');
    if (e != std::string::npos && text[e + 2] == '0') text.erase(e + 2, 1);
    return text;
}

/// A vector as a message shows it.
template <std::floating_point T>
[[nodiscard]] std::string to_text(const Vec3T<T>& v) {
    // Appended, because g++ 12 warns of "x" + std::string (-Wrestrict, its bug 105651).
    std::string text(1, '(');
    text.append(to_text(v.x)).append(", ").append(to_text(v.y)).append(", ");
    return text.append(to_text(v.z)).append(")");
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
    throw std::invalid_argument(std::string(what) + " is " + to_text(value) +
                                "; it must be " + std::string(right) + ".");
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
