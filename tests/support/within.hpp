#pragma once

/// \file support/within.hpp
/// \brief A relative tolerance.

#include <doctest/doctest.h>

#include <limits>

namespace ljus_test {

/// A number with a relative tolerance. (doctest's Approx(x).epsilon(e) allows e times
/// 1 + |x|, which for a small x is any multiple.)
inline doctest::Approx within(double x, double part) {
    // Not 0: doctest asks whether the distance is below the tolerance, and 0 is 0.
    return doctest::Approx(x).epsilon(part).scale(std::numeric_limits<double>::min());
}

} // namespace ljus_test
