// A vector of one's own as an argument of a function template.
// says: no matching function for call to

// [mistake]
#include <ljus/optics/reflection.hpp>

struct Vector {
    float x, y, z;
    operator glm::vec3() const { return glm::vec3(x, y, z); }
};

int main() {
    const Vector d{0, 0, -1}, n{0, 0, 1};
    const auto mirrored = ljus::reflect(d, n); // right: ljus::reflect<float>(d, n)
}
// [mistake]
