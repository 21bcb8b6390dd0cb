// A ray of doubles, and a sphere of floats.
// says: The ray and the shape have two precisions

#include <ljus/ljus.hpp>

int main() {
    const ljus::Sphere ball{.center = {0, 0, -3}, .radius = 1};
    const ljus::RayT<double> ray{.origin = {0, 0, 3}};
    return intersect(ray, ball) ? 0 : 1;
}
