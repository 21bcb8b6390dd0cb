// A point of doubles, glm::dvec3, and a sphere of floats.
// says: The sphere and the point have two precisions

// [mistake]
#include <ljus/ljus.hpp>

int main() {
    const ljus::Sphere ball{.center = {0, 0, -3}, .radius = 1};
    const glm::dvec3 top{0, 1, -3};
    return normal(ball, top).y > 0 ? 0 : 1;
}
// [mistake]
