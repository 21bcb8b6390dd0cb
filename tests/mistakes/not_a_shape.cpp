// A type that is no shape: of the four functions it has one, with the arguments the wrong way round.
// says: Shape<S>|does not satisfy 'Shape'

#include <ljus/ljus.hpp>
using namespace ljus;

struct Plane {
    float height = 0;
};
std::optional<float> intersect(const Plane& plane, const Ray& ray) {
    return (plane.height - ray.origin.y) / ray.direction.y;
}

int main() {
    Scene<Shapes<Plane>, Materials<Lambertian>> scene;
}
