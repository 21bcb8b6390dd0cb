// The renderer comes first.
// says: This is no camera, which render\(\) takes second

#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    const World world(std::move(scene));
    const auto picture = render(look_at({}), PathTracer(world), {.samples = 4});
}
