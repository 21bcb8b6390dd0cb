#pragma once

/// \file ljus/geometry/detail/shape_lanes.hpp
/// \brief Eight shapes side by side, and which of them a ray may meet.

#include <algorithm>
#include <cmath>
#include <limits>

#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/math/lanes.hpp"

namespace ljus::detail {

/// \addtogroup few_shapes
/// \{

/// Half of epsilon: the largest relative error of one rounding.
inline constexpr float roundoff = std::numeric_limits<float>::epsilon() / 2;

/// A ray, as eight shapes are asked by it.
struct LaneRay {
    Vec3 origin{0};      ///< O.
    Vec3 direction{0};   ///< D.
    float t_min = 0;     ///< First t that counts.
    float t_max = 0;     ///< Last t that counts.
    float reach = 0;     ///< The largest coordinate of O.
    float length = 0;    ///< The largest component of D.
    float inverse_d = 0; ///< 1 / |D|.
};

/// Eight flat shapes, each by three functions of a point X: its height over the plane,
/// \f$ d - N \cdot X \f$, and its coordinates \f$ u = A \cdot X + a_0 \f$ and
/// \f$ v = B \cdot X + b_0 \f$ along the edges.
struct FlatLanes {
    Lanes3 n, a, b;          ///< N, of unit length, A and B.
    Lanes d, a0, b0;         ///< NaN where there is no shape: no ray meets it.
    Lanes sum;               ///< 1 for a triangle, where u + v <= 1; 0 for a quad.
    Lanes height, height_by; ///< `height` + `reach` * `height_by` bounds the rounding
                             ///< of the height, `length` * `height_by` that of N.D.
    Lanes slack, slack_by; ///< `length` * (`slack` + `reach` * `slack_by`) bounds that
                           ///< of u and v, each times the cosine at the plane.
};

/// Eight balls.
struct BallLanes {
    Lanes3 center; ///< NaN where there is no ball.
    Lanes radius;  ///< With a bound of rounding, which grows by `reach`.
    Lanes radius2; ///< Squared.
};

/// Eight flat shapes that no ray meets.
[[nodiscard]] inline FlatLanes no_flats() noexcept {
    FlatLanes none{};
    for (float& lane : none.d.lane) lane = std::numeric_limits<float>::quiet_NaN();
    return none;
}
/// Eight balls that no ray meets.
[[nodiscard]] inline BallLanes no_balls() noexcept {
    BallLanes none{};
    for (float& lane : none.center.x) lane = std::numeric_limits<float>::quiet_NaN();
    return none;
}

/// Between these sizes neither a product overflows nor a bound vanishes.
inline constexpr float least_length = 1e-6f, largest_size = 1e8f;

/// Puts a flat shape with an area into a lane.
/// \param flat    The block.
/// \param i       The lane.
/// \param corner  V_1.
/// \param e1      The edge along which u runs.
/// \param e2      The edge along which v runs.
/// \param sum     As FlatLanes has it.
/// \return Whether it has a place: not if it is too large, or too thin.
[[nodiscard]] inline bool set_lane(FlatLanes& flat, std::size_t i,
                                   const glm::dvec3& corner, const glm::dvec3& e1,
                                   const glm::dvec3& e2, float sum) noexcept {
    const glm::dvec3 up = glm::cross(e1, e2);
    const double area = glm::length(up);
    const glm::dvec3 n = up / area, a = glm::cross(e2, n) / area,
                     b = glm::cross(n, e1) / area;
    const double d = glm::dot(n, corner), a0 = -glm::dot(a, corner),
                 b0 = -glm::dot(b, corner);
    const double steep = std::max(size_of(a), size_of(b)), wide = size_of(n);
    const double size = size_of(corner) + size_of(e1) + size_of(e2);
    if (!(size < largest_size && steep < 1e9 && steep * size < 1e6)) return false;

    flat.n.set(i, Vec3(n));
    flat.a.set(i, Vec3(a));
    flat.b.set(i, Vec3(b));
    flat.d.lane[i] = float(d);
    flat.a0.lane[i] = float(a0);
    flat.b0.lane[i] = float(b0);
    flat.sum.lane[i] = sum;
    // A coefficient is rounded once, a sum of three products three times, and c u and
    // c v are sums of two products of such sums. Border: what intersect() lets through.
    const double u = roundoff, offset = std::max(std::abs(a0), std::abs(b0));
    flat.height.lane[i] = float(4 * u * std::abs(d));
    flat.height_by.lane[i] = float(6 * u * wide);
    flat.slack.lane[i] = float(16 * u * (wide * (1 + offset) + steep * std::abs(d)));
    flat.slack_by.lane[i] = float(32 * u * wide * steep);
    return true;
}
/// Puts a ball into a lane.
/// \return Whether it has a place: not if it is too large, or too small.
[[nodiscard]] inline bool set_lane(BallLanes& balls, std::size_t i,
                                   const Sphere& ball) noexcept {
    const float size = size_of(ball.center) + ball.radius;
    if (!(ball.radius > 1e-9f && size < largest_size)) return false;
    balls.center.set(i, ball.center);
    balls.radius.lane[i] = ball.radius + 32 * roundoff * size;
    balls.radius2.lane[i] = ball.radius * ball.radius;
    return true;
}

// Which of eight flat shapes a ray may meet, a bit each, and from which t on. With
// c = N.D and h = d - N.O it meets the plane at t = h / c, where u is
// (c (A.O + a0) + h A.D) / c.
// [flat lanes]
[[nodiscard]] inline std::uint32_t may_meet(const FlatLanes& flat, const LaneRay& r,
                                            Lanes& entry) noexcept {
    const Vec3 o = r.origin, d = r.direction;
    Lanes c, h, u, v;
    std::uint32_t met = 0;
    for_lanes([&](int i) {
        const float along = flat.n.x[i] * d.x + flat.n.y[i] * d.y + flat.n.z[i] * d.z;
        const float above = flat.d.lane[i] -
                            (flat.n.x[i] * o.x + flat.n.y[i] * o.y + flat.n.z[i] * o.z);
        c.lane[i] = std::abs(along);
        h.lane[i] = above * std::copysign(1.0f, along);
    });
    for_lanes([&](int i) {
        const float at = flat.a.x[i] * o.x + flat.a.y[i] * o.y + flat.a.z[i] * o.z;
        const float by = flat.a.x[i] * d.x + flat.a.y[i] * d.y + flat.a.z[i] * d.z;
        u.lane[i] = c.lane[i] * (at + flat.a0.lane[i]) + h.lane[i] * by;
    });
    for_lanes([&](int i) {
        const float at = flat.b.x[i] * o.x + flat.b.y[i] * o.y + flat.b.z[i] * o.z;
        const float by = flat.b.x[i] * d.x + flat.b.y[i] * d.y + flat.b.z[i] * d.z;
        v.lane[i] = c.lane[i] * (at + flat.b0.lane[i]) + h.lane[i] * by;
    });
    for_lanes([&](int i) {
        const float off = r.reach * flat.height_by.lane[i] + flat.height.lane[i];
        const float c_off = r.length * flat.height_by.lane[i];
        const float from = (h.lane[i] - off) / (c.lane[i] + c_off);
        const float first = from * (1 - 6 * roundoff);
        const float slack =
            r.length * (r.reach * flat.slack_by.lane[i] + flat.slack.lane[i]);
        const float top = c.lane[i] + slack;
        const bool inside = (u.lane[i] >= -slack) & (v.lane[i] >= -slack) &
                            (u.lane[i] <= top) &
                            (flat.sum.lane[i] * u.lane[i] + v.lane[i] <= top + slack);
        const bool ahead =
            (h.lane[i] + off >= r.t_min * (c.lane[i] - c_off)) & (first <= r.t_max);
        entry.lane[i] = first > r.t_min ? first : r.t_min;
        met |= (inside & ahead) ? lane_bit[i] : 0u;
    });
    return met;
}
// [flat lanes]

// The same of eight balls: by the nearest point of the line, at t = b / D.D, and one
// radius before it and behind it.
[[nodiscard]] inline std::uint32_t may_meet(const BallLanes& ball, const LaneRay& r,
                                            Lanes& entry) noexcept {
    const Vec3 o = r.origin, d = r.direction;
    const float inverse_d2 = r.inverse_d * r.inverse_d;
    const float d2 = glm::dot(d, d);
    Lanes b, q;
    std::uint32_t met = 0;
    for_lanes([&](int i) {
        const float x = ball.center.x[i] - o.x;
        const float y = ball.center.y[i] - o.y;
        const float z = ball.center.z[i] - o.z;
        b.lane[i] = x * d.x + y * d.y + z * d.z;
        q.lane[i] = x * x + y * y + z * z;
    });
    for_lanes([&](int i) {
        const float radius2 = ball.radius2.lane[i];
        const float slack = 64 * roundoff * (q.lane[i] + radius2);
        const float outside = q.lane[i] - radius2 - slack; // above 0: surely
        const float half =
            (ball.radius.lane[i] + 32 * roundoff * r.reach) * r.inverse_d;
        const float middle = b.lane[i] * inverse_d2;
        const bool crosses = b.lane[i] * b.lane[i] >= d2 * outside;
        const bool ahead = (middle + half >= r.t_min) & (middle - half <= r.t_max) &
                           ((b.lane[i] >= 0) | (outside <= 0));
        const float first = middle - half;
        entry.lane[i] = first > r.t_min ? first : r.t_min;
        met |= (crosses & ahead) ? lane_bit[i] : 0u;
    });
    return met;
}

/// \}

} // namespace ljus::detail
