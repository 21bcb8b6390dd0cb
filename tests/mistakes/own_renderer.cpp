// A renderer that names no stream.
// says: it has a type Stream and radiance\(renderer, ray, context\)

#include <ljus/ljus.hpp>
using namespace ljus;

struct Sky {
    Rgb zenith{0.2f, 0.4f, 1};
};
template <typename Context>
Rgb radiance(const Sky& sky, const Ray& ray, Context&) {
    return std::abs(ray.direction.y) * sky.zenith;
}

int main() {
    const auto picture = render(Sky{}, look_at({}), {.samples = 4});
}
