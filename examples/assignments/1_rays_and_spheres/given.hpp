#pragma once

/// \file given.hpp
/// \brief Given in assignment 1: a ball, the eye, and the hit of a ray.

#include <cstddef>

#include "ljus/geometry/ray.hpp"
#include "ljus/math/vector.hpp"

namespace answer {

using ljus::Ray, ljus::Rgb, ljus::Vec2, ljus::Vec3;

struct Ball {
    Vec3 center{0};
    float radius = 1;
    Rgb color{0.7f};
};

/// The eye looks along -z; x points to the right of the picture and y to its top.
struct Eye {
    Vec3 position{0};
    float vfov_degrees = 40; ///< Angle of view from the lower to the upper edge of the
                             ///< picture.
};

/// The hit of a ray on one of several balls: the distance, and the number of the ball.
struct Hit {
    float t = 0;
    std::size_t ball = 0;
};

} // namespace answer
