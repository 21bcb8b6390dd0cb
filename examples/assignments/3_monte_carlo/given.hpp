#pragma once

/// \file given.hpp
/// \brief Given in assignment 3: an estimate, a sky, and directions around an axis.

#include <functional>

#include "ljus/math/frame.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/vector.hpp"

namespace answer {

using ljus::RandomStream, ljus::next_1d, ljus::next_2d; // uniform in [0, 1)
using ljus::Vec2, ljus::Vec3;

/// A mean and its standard error.
struct Estimate {
    double mean = 0;
    double error = 0;
};

/// The radiance that arrives from a direction; z points away from the floor.
using Sky = std::function<double(const Vec3&)>;

/// The directions of a round lamp: all whose angle with the axis has at least this
/// cosine.
struct Cone {
    Vec3 axis{0, 0, 1};
    float cosine = 0.9f;
};

/// Turns a direction by the rotation that takes +z to the axis.
inline Vec3 around(const Vec3& axis, const Vec3& local) {
    return ljus::to_world(ljus::frame_around(axis), local);
}

} // namespace answer
