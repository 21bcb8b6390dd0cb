// rest: half a million rays at each of 16 seams, 6 s
// concept: triangle
// native: fused multiply-adds round the two sides of an edge differently
/// \file watertight_leaks_test.cpp
/// \brief No ray slips between two triangles, as far as half a million rays can say:
/// with the watertight test, and in double.

#include "ljus/geometry/watertight.hpp"

#include <doctest/doctest.h>

#include <cstdio>
#include <string>
#include <utility>

#include "support/leaks.hpp"

using namespace ljus;
using ljus_test::Aim;
using ljus_test::loop_leaks;

TEST_CASE(
    "watertight leaks: half a million rays at edges, at vertices, along the axes") {
    // A tie is a ray that meets the seam exactly, so that no rounding is needed to lose
    // it. The test in float leaks often enough to be counted with a tenth of the rays.
    std::printf("\n%-28s %10s %10s %10s\n", "leaks of 500 000", "float", "double",
                "watertight");
    const Vec3T<double> origin{0}, moved{100, -100, 100};
    for (const auto& [name, mesh] :
         {std::pair{"dented ball", ljus_test::dented_ball(1, 1, origin)},
          std::pair{"dented ball at 100", ljus_test::dented_ball(1, 1, moved)},
          std::pair{"cut cube", ljus_test::cut_cube(2, 1, origin)},
          std::pair{"cut cube at 100", ljus_test::cut_cube(2, 1.1, moved)}})
        for (const Aim aim : {Aim::edge, Aim::vertex, Aim::axis, Aim::tie}) {
            const long rays = 500000;
            const long in_float = loop_leaks<float>(mesh, aim, rays / 10) * 10;
            const long in_double = loop_leaks<double>(mesh, aim, rays);
            const long none = loop_leaks<Watertight>(mesh, aim, rays);
            const char* at[] = {", edges", ", vertices", ", axes", ", ties"};
            const std::string row = std::string(name) + at[static_cast<int>(aim)];
            std::printf("%-28s %10ld %10ld %10ld\n", row.c_str(), in_float, in_double,
                        none);
            CAPTURE(row);
            CHECK(in_double == 0);
            CHECK(none == 0);
        }
}
