// A scene that was not closed.
// long: clang++ shows each place where the type is used
// says: Close the scene: World world\(std::move\(scene\)\)

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    const PathTracer tracer(scene);
}
// [mistake]
