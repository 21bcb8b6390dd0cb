#pragma once

/// \file support/within.hpp
/// \brief Compares numbers with a relative tolerance.

#include <doctest/doctest.h>

#include <limits>

namespace ljus_test {

/// A number with a relative tolerance. doctest's Approx(x).epsilon(e) alone allows a
/// difference of e times 1 + |x|, which for a small x is many times x.
inline doctest::Approx within(double x, double part) {
    // The scale is not 0, because doctest requires a difference below the tolerance.
    // With x = 0 and a scale of 0 the tolerance would be 0, and no difference is below
    // 0.
    return doctest::Approx(x).epsilon(part).scale(std::numeric_limits<double>::min());
}

} // namespace ljus_test
