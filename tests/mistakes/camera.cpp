// A camera that takes no random stream.
// says: a camera has a type Scalar and camera_ray\(camera, pixel, width

#include <ljus/ljus.hpp>
using namespace ljus;

struct Parallel {
    using Scalar = float;
    float size = 2;
};
Ray camera_ray(const Parallel& camera, const Vec2& pixel, int width, int height) {
    const Vec2 at = pixel / Vec2(width, height) - 0.5f;
    return {.origin{camera.size * at, 5}, .direction{0, 0, -1}};
}

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    const World world(std::move(scene));
    const auto picture = render(PathTracer(world), Parallel{}, {.samples = 4});
}
