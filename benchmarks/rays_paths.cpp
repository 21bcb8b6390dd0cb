/// \file rays_paths.cpp
/// \brief The path tracer's rays per second in the report's room: camera, bounce and
/// shadow rays, with all their shading.
///
/// A program of its own, as a reader's is: in one that holds much else (the peers of
/// rays_room.cpp), g++ reaches its limit for the growth of a file, puts fewer functions
/// into each other, and the same paths take 8 % longer.

#include <algorithm>
#include <cstdio>

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "rays_timing.hpp"

/// Prints the best and the median of some runs.
int main() {
    const auto room = ljus::final_room();
    const ljus::PathTracer tracer(room.world);
    std::vector<double> speeds;
    for (int run = 0; run < 15; ++run) {
        const double start = rays::seconds();
        const auto result =
            render(tracer, room.camera,
                   {.width = 100, .height = 100, .samples = 8, .threads = 1});
        speeds.push_back(double(result.counts.rays()) / (rays::seconds() - start));
    }
    std::sort(speeds.begin(), speeds.end());
    std::printf(
        "path tracing: %.2f million rays per second and thread, the middle of %zu "
        "runs %.2f\n",
        speeds.back() / 1e6, speeds.size(), speeds[speeds.size() / 2] / 1e6);
}
