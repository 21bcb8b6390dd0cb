#pragma once

/// \file support/exact.hpp
/// \brief Exact arithmetic for reference values. Every finite float or double is a
/// fraction.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>

#include <boost/multiprecision/cpp_int.hpp>

#include "ljus/math/vector.hpp"

namespace ljus_test {

using Exact = boost::multiprecision::cpp_rational;

/// A vector of fractions.
struct Exact3 {
    Exact x, y, z;
    Exact3(Exact a, Exact b, Exact c)
        : x(std::move(a)), y(std::move(b)), z(std::move(c)) {}
    template <typename T>
    explicit Exact3(const ljus::Vec3T<T>& v) : x(v.x), y(v.y), z(v.z) {}
};
inline Exact3 operator+(const Exact3& a, const Exact3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Exact3 operator-(const Exact3& a, const Exact3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Exact3 operator*(const Exact& s, const Exact3& a) {
    return {s * a.x, s * a.y, s * a.z};
}
inline Exact dot(const Exact3& a, const Exact3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Exact3 cross(const Exact3& a, const Exact3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Exact3 abs(const Exact3& a) {
    using boost::multiprecision::abs;
    return {abs(a.x), abs(a.y), abs(a.z)};
}
/// a . (b x c)
inline Exact triple(const Exact3& a, const Exact3& b, const Exact3& c) {
    return dot(a, cross(b, c));
}
/// The sum of the absolute values of the terms of triple(). In triple() these terms may
/// cancel.
inline Exact triple_size(const Exact3& a, const Exact3& b, const Exact3& c) {
    return a.x * (b.y * c.z + b.z * c.y) + a.y * (b.z * c.x + b.x * c.z) +
           a.z * (b.x * c.y + b.y * c.x);
}
inline int sign(const Exact& x) {
    return x.sign();
}
inline double to_double(const Exact& x) {
    return x.convert_to<double>();
}

/// \name Exact arithmetic with integers, many times faster
/// Every float is an integer times a power of two. With the smallest such power as the
/// unit, sums and products of integers are exact.
/// \{

using Integer = boost::multiprecision::cpp_int;
struct Integer3 {
    Integer x, y, z;
};

/// An exponent e for which `value` is an integer times 2^e, where the integer uses all
/// bits of the mantissa.
template <std::floating_point T>
int grid_exponent(T value) {
    if (value == T(0)) return 1 << 20;
    int exponent = 0;
    (void)std::frexp(value, &exponent);
    return exponent - std::numeric_limits<T>::digits;
}
template <std::floating_point T>
int grid_exponent(const ljus::Vec3T<T>& v) {
    return std::min({grid_exponent(v.x), grid_exponent(v.y), grid_exponent(v.z)});
}

/// value / 2^exponent, which must be an integer.
template <std::floating_point T>
Integer on_grid(T value, int exponent) {
    if (value == T(0)) return 0;
    int own = 0;
    const T mantissa = std::frexp(value, &own);
    const auto whole =
        static_cast<std::int64_t>(std::ldexp(mantissa, std::numeric_limits<T>::digits));
    Integer result = whole < 0 ? -whole : whole;
    result <<= own - std::numeric_limits<T>::digits - exponent;
    return whole < 0 ? Integer(-result) : result;
}
template <std::floating_point T>
Integer3 on_grid(const ljus::Vec3T<T>& v, int exponent) {
    return {on_grid(v.x, exponent), on_grid(v.y, exponent), on_grid(v.z, exponent)};
}
inline Integer3 operator+(const Integer3& a, const Integer3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Integer3 operator-(const Integer3& a, const Integer3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Integer3 abs(const Integer3& a) {
    using boost::multiprecision::abs;
    return {abs(a.x), abs(a.y), abs(a.z)};
}
inline Integer3 operator<<(const Integer3& a, int bits) {
    return {a.x << bits, a.y << bits, a.z << bits};
}
inline Integer triple(const Integer3& a, const Integer3& b, const Integer3& c) {
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
           a.z * (b.x * c.y - b.y * c.x);
}
inline Integer triple_size(const Integer3& a, const Integer3& b, const Integer3& c) {
    return a.x * (b.y * c.z + b.z * c.y) + a.y * (b.z * c.x + b.x * c.z) +
           a.z * (b.x * c.y + b.y * c.x);
}
/// 2^exponent as a fraction.
inline Exact power_of_two(int exponent) {
    const Integer size = Integer(1) << std::abs(exponent);
    return exponent < 0 ? Exact(1) / Exact(size) : Exact(size);
}
/// \}

/// The difference between a value and the truth, in units in the last place of T.
template <typename T>
double ulps(T value, const Exact& truth) {
    const double size = std::abs(to_double(truth));
    int exponent = std::numeric_limits<T>::min_exponent;
    if (size > 0) exponent = std::max(exponent, std::ilogb(size) + 1);
    const Exact off = boost::multiprecision::abs(Exact(value) - truth);
    return std::ldexp(to_double(off), std::numeric_limits<T>::digits - exponent);
}

} // namespace ljus_test
