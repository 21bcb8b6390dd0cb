#pragma once

/// \file support/exact.hpp
/// \brief Exact arithmetic for oracles: every float and every double is a fraction.

#include <cmath>
#include <limits>

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
/// triple() with all signs positive: the size of what may cancel in it.
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

/// How many units in the last place of T lie between a value and the truth.
template <typename T>
double ulps(T value, const Exact& truth) {
    const double size = std::abs(to_double(truth));
    int exponent = std::numeric_limits<T>::min_exponent;
    if (size > 0) exponent = std::max(exponent, std::ilogb(size) + 1);
    const Exact off = boost::multiprecision::abs(Exact(value) - truth);
    return std::ldexp(to_double(off), std::numeric_limits<T>::digits - exponent);
}

} // namespace ljus_test
