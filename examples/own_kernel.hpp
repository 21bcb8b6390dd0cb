/// \file own_kernel.hpp
/// \brief A kernel of the reader's own: a raised cosine.
#pragma once
#include <cmath>
#include <numbers>

#include "ljus/photons/kernel.hpp"

/// Code that a reader of the book has written.
namespace reader {

/// The kernel 1 + cos(pi d/r) at a distance d in a disc of radius r. It is smooth in
/// the middle and at the edge.
struct Hann {};

// [kernel_weight]
/// The weight of a photon at x = d^2/r^2. The mean over the disc must be 1. It is the
/// integral over x from 0 to 1, and 1 + cos(pi sqrt(x)) has the integral 1 - 4/pi^2.
inline float kernel_weight(Hann, float x) {
    constexpr float pi = std::numbers::pi_v<float>;
    return (1 + std::cos(pi * std::sqrt(x))) / (1 - 4 / (pi * pi));
}
// [kernel_weight]

} // namespace reader
