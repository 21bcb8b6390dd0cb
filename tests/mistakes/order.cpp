// The arguments the wrong way round.
// says: The ray comes first: intersect\(ray, shape\)

// [mistake]
#include <ljus/ljus.hpp>

int main() {
    const ljus::Sphere ball{.center = {0, 0, -3}, .radius = 1};
    const ljus::Ray ray{.origin = {0, 0, 3}};
    return intersect(ball, ray) ? 0 : 1;
}
// [mistake]
