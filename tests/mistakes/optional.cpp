// The ray may miss, and the result is then empty.
// says: cannot convert .std::optional<float>. to|no viable conversion from .std::optional<float>. to

// [mistake]
#include <ljus/ljus.hpp>

int main() {
    const ljus::Sphere ball{.center = {0, 0, -3}, .radius = 1};
    const ljus::Ray ray{.origin = {0, 0, 3}};
    const float t = intersect(ray, ball);
    return t > 0 ? 0 : 1;
}
// [mistake]
