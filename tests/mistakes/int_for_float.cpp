// An int for a float.
// says: A ray of floats takes a float: 2.0f, not 2

// [mistake]
#include <ljus/ljus.hpp>

int main() {
    const ljus::Ray ray{.origin = {0, 0, 3}};
    return point_at(ray, 2).z > 0 ? 0 : 1;
}
// [mistake]
