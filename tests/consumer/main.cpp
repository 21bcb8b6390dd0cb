// The smallest user of the library.
#include <cstdio>

#include "ljus/geometry/ray.hpp"
#include "ljus/math/frame.hpp"

#ifdef USES_EVERYTHING
#include "ljus/ljus.hpp"
#endif

int main() {
    const ljus::Ray ray{.origin = {0, 0, 3}};
    const ljus::Frame frame = ljus::frame_around(ljus::Vec3{0, 0, 1});
    const ljus::Vec3 point = to_world(frame, point_at(ray, 3.0f));
    std::printf("Ljus %d.%d.%d: %g\n", LJUS_VERSION_MAJOR, LJUS_VERSION_MINOR,
                LJUS_VERSION_PATCH, static_cast<double>(point.z));
    return point.z == 0.0f ? 0 : 1;
}
