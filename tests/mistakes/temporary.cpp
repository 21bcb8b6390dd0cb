// A world that is gone before it is rendered.
// says: use of deleted function|call to deleted constructor|conversion function from

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    const PathTracer tracer{World(scene)};
}
// [mistake]
