#pragma once

/// \file support/quick_ball.hpp
/// \brief A shape of a user that counts the calls of its any-hit test.

#include <optional>

#include "ljus/geometry/sphere.hpp"

namespace reader {

/// A ball with its own any-hit test, which counts how often it is called.
struct Quick {
    ljus::Sphere ball{};
    int* asked = nullptr;
};
inline std::optional<float> intersect(const ljus::Ray& ray, const Quick& s) {
    return ljus::intersect(ray, s.ball);
}
template <typename Compute>
bool meets(const ljus::Ray& ray, const Quick& s) {
    ++*s.asked;
    return ljus::intersect(ray, s.ball).has_value();
}
inline ljus::SurfacePoint surface_point(const Quick& s, const ljus::Ray& ray,
                                        const ljus::ShapeHitT<float>& hit) {
    return ljus::surface_point(s.ball, ray, hit);
}
inline ljus::Sphere bounding_sphere(const Quick& s) {
    return s.ball;
}
inline void check(const Quick&) {}

} // namespace reader
