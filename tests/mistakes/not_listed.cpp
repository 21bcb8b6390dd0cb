// A shape that the scene does not list.
// says: List the shape: Scene<Shapes<...>, ...>

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    scene.add(Quad{}, grey);
}
// [mistake]
