// A material in place of its number.
// says: Add the material first: add\(shape, add\(material\)\)

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    scene.add(Sphere{}, Lambertian{});
}
// [mistake]
