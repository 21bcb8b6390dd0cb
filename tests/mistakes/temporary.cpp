// A world that is gone before it is rendered.
// says: A temporary ends too early: give the object a name

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    const PathTracer tracer{World(scene)};
}
// [mistake]
