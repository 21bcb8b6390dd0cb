#pragma once

/// \file support/within.hpp
/// \brief A tolerance that is a part of the number.

#include <doctest/doctest.h>

namespace ljus_test {

/// A number, but for a part of it. (doctest's Approx(x).epsilon(e) allows for e times
/// 1 + |x|: of a small x any multiple.)
inline doctest::Approx within(double x, double part) {
    return doctest::Approx(x).epsilon(part).scale(0);
}

} // namespace ljus_test
