// The smallest user of the library.
#include <cstdio>

#include "ljus/geometry/ray.hpp"
#include "ljus/math/frame.hpp"

#ifdef USES_EVERYTHING
#include <vector>

#include "ljus/ljus.hpp"
#endif

int main() {
#ifdef USES_EVERYTHING
    // An engine, from the headers or from ljus::core.
    const std::vector<ljus::Box> boxes(3, ljus::Box{{0, 0, 0}, {1, 1, 1}});
    if (ljus::Bvh(boxes).primitive_ids().size() != 3) return 1;
#endif
    const ljus::Ray ray{.origin = {0, 0, 3}};
    const ljus::Frame frame = ljus::frame_around(ljus::Vec3{0, 0, 1});
    const ljus::Vec3 point = to_world(frame, point_at(ray, 3.0f));
    std::printf("Ljus %d.%d.%d: %g\n", LJUS_VERSION_MAJOR, LJUS_VERSION_MINOR,
                LJUS_VERSION_PATCH, static_cast<double>(point.z));
    return point.z == 0.0f ? 0 : 1;
}
