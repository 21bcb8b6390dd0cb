#pragma once

/// \file ljus/math/frame.hpp
/// \brief An orthonormal frame around a normal.

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup frame Frames
/// \brief Materials and samplers work with z along the normal; a frame converts to and
/// from that coordinate system.
/// \{

/// Three orthonormal vectors.
template <std::floating_point T>
struct FrameT {
    Vec3T<T> tangent{T(1), T(0), T(0)};   ///< The local x axis, of unit length.
    Vec3T<T> bitangent{T(0), T(1), T(0)}; ///< The local y axis, of unit length.
    Vec3T<T> normal{T(0), T(0), T(1)};    ///< The local z axis, of unit length.
};
using Frame = FrameT<float>; ///< FrameT in float.

/// Makes a right-handed frame around a unit vector n \cite duff2017, accurate even near
/// -z. If n is from glm::normalize(), each length is 1 to within 4 units of roundoff,
/// and each dot product of two vectors is 0 to within 8 units.
/// \cost One division, no square root, no branch.
template <std::floating_point T>
[[nodiscard]] FrameT<T> frame_around(const Vec3T<T>& n) noexcept {
    const T sign = std::copysign(T(1), n.z);
    const T a = T(-1) / (sign + n.z);
    const T b = n.x * n.y * a;
    return {.tangent{T(1) + sign * n.x * n.x * a, sign * b, -sign * n.x},
            .bitangent{b, sign + n.y * n.y * a, -n.y},
            .normal = n};
}

/// Converts a vector from world to local coordinates; z is its normal component.
template <std::floating_point T>
[[nodiscard]] constexpr Vec3T<T> to_local(const FrameT<T>& frame,
                                          const Vec3T<T>& v) noexcept {
    return {glm::dot(v, frame.tangent), glm::dot(v, frame.bitangent),
            glm::dot(v, frame.normal)};
}

/// Converts a vector from local to world coordinates.
template <std::floating_point T>
[[nodiscard]] constexpr Vec3T<T> to_world(const FrameT<T>& frame,
                                          const Vec3T<T>& v) noexcept {
    return v.x * frame.tangent + v.y * frame.bitangent + v.z * frame.normal;
}

/// \}

} // namespace ljus
