// A setting that does not exist.
// says: cannot convert.*RenderSettings

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    const World world(std::move(scene));
    const auto picture = render(PathTracer(world), look_at({}), {.rays = 64});
}
// [mistake]
