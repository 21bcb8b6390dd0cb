// The namespace is missing.
// says: did you mean 'ljus::Sphere'|.Sphere. does not name a type

// [mistake]
#include <ljus/ljus.hpp>

int main() {
    const Sphere ball{.center = {0, 0, -3}, .radius = 1};
    return intersect(ljus::Ray{}, ball) ? 0 : 1;
}
// [mistake]
