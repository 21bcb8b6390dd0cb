// A world is rendered by itself.
// says: This is no Renderer, such as PathTracer\(world\)

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    const World world(std::move(scene));
    const auto picture = render(world, look_at({}), {.samples = 4});
}
// [mistake]
