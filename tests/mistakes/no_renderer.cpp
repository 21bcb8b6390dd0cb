// A scene is rendered by itself.
// says: It is no renderer: make_path_tracer\(scene\) makes one

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    const auto picture = render(scene, look_at({}), {.samples = 4});
}
// [mistake]
