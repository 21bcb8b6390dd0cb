// The header that has the name is not included.
// says: no type named .Triangle. in namespace|.Triangle. in namespace .ljus. does not name a type

// [mistake]
#include <ljus/geometry/sphere.hpp>

int main() {
    const ljus::Triangle triangle{.v1 = {0, 0, 0}, .v2 = {1, 0, 0}, .v3 = {0, 1, 0}};
    return intersect(ljus::Ray{}, triangle) ? 0 : 1;
}
// [mistake]
