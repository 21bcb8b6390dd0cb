/// \file own_kernel.hpp
/// \brief A kernel of the reader's own: a raised cosine.
#pragma once
#include <cmath>
#include <numbers>

#include "ljus/photons/kernel.hpp"

/// What a reader has written.
namespace reader {

/// 1 + cos(pi d/r): smooth in the middle and at the edge.
struct Hann {};

// [kernel_weight]
/// The weight of a photon at x = d^2/r^2. The mean over the disc is the integral of it
/// over x from 0 to 1, 1 - 4/pi^2 without the factor before it.
inline float kernel_weight(Hann, float x) {
    constexpr float pi = std::numbers::pi_v<float>;
    return (1 + std::cos(pi * std::sqrt(x))) / (1 - 4 / (pi * pi));
}
// [kernel_weight]

} // namespace reader
