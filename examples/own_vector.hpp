/// \file own_vector.hpp
/// \brief A vector type of the reader's own that converts to and from the vectors of
/// the library.
#pragma once
#include <cmath>
#include <cstdlib>
#include <optional>

#include "ljus/optics/reflection.hpp"
#include "ljus/optics/refraction.hpp"
#include "ljus/optics/schlick.hpp"

/// Code that a reader of the book has written.
namespace reader {

// [conversions]
/// The vector type of a program that was written without this library.
struct Vector {
    float x = 0, y = 0, z = 0; ///< Lengths in scene units, or a colour.

    Vector() = default;                                       ///< Zero.
    Vector(float a, float b, float c) : x(a), y(b), z(c) {}   ///< From components.
    Vector(const glm::vec3& v) : x(v.x), y(v.y), z(v.z) {}    ///< From the library.
    operator glm::vec3() const { return glm::vec3(x, y, z); } ///< To the library.
};
// [conversions]

/// The sum of two vectors.
inline Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
/// The opposite vector.
inline Vector operator-(const Vector& a) {
    return {-a.x, -a.y, -a.z};
}
/// A multiple of a vector.
inline Vector operator*(float s, const Vector& a) {
    return {s * a.x, s * a.y, s * a.z};
}
/// The product of two colours, channel by channel.
inline Vector operator*(const Vector& a, const Vector& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
/// The dot product of two vectors.
inline float dot(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// [glass]
/// The direction of a ray after it has met glass: refracted or reflected, chosen at
/// random.
/// \param d  Unit direction of travel.
/// \param n  Unit normal, on the outside.
/// \param u  A number in [0, 1) that makes the choice.
inline Vector at_glass(const Vector& d, const Vector& n, float u) {
    const bool enters = dot(d, n) < 0;
    const float n1 = enters ? 1.0f : 1.5f, n2 = enters ? 1.5f : 1.0f;
    const std::optional<Vector> t = ljus::refract<float>(d, n, n1 / n2);
    if (!t) return ljus::reflect<float>(d, n); // total internal reflection
    const Vector& outside = enters ? d : *t;   // on the side of the lower index
    const float cosine = std::abs(dot(outside, n));
    if (u < ljus::schlick(ljus::schlick_r0(n1, n2), cosine))
        return ljus::reflect<float>(d, n);
    return *t;
}
// [glass]

} // namespace reader
