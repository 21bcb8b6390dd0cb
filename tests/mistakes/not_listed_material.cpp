// A material that the scene does not list.
// says: Neither a light nor listed: Scene<..., Materials<...>>

#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    const auto mirror = scene.add(Mirror{});
    scene.add(Sphere{}, mirror);
}
