#pragma once

/// \file given.hpp
/// \brief Assignment 1, given: what a ball is, and what a ray that meets one reports.

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
    float vfov_degrees = 40; ///< From the lower edge of the picture to the upper one.
};

/// Which of several balls a ray met, and where.
struct Hit {
    float t = 0;
    std::size_t ball = 0;
};

} // namespace answer
