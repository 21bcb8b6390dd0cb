#pragma once

/// \file support/within.hpp
/// \brief A tolerance that is a part of the number.

#include <doctest/doctest.h>

#include <limits>

namespace ljus_test {

/// A number, but for a part of it. (doctest's Approx(x).epsilon(e) allows for e times
/// 1 + |x|: of a small x any multiple.)
inline doctest::Approx within(double x, double part) {
    // Not 0: doctest asks whether the distance is below the tolerance, and 0 is 0.
    return doctest::Approx(x).epsilon(part).scale(std::numeric_limits<double>::min());
}

} // namespace ljus_test
