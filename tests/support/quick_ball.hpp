#pragma once

/// \file support/quick_ball.hpp
/// \brief A shape of a reader that counts how often it is asked whether it is met.

#include <optional>

#include "ljus/geometry/sphere.hpp"

namespace reader {

/// A ball that is quick to say whether it is met, and counts how often it is asked.
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
