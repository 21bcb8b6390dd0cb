// A callback with other arguments than (done, total).
// says: no matching function for call to .render

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    const World world(Scene<Shapes<Sphere>, Materials<Lambertian>>{});
    auto print = [](double share) { return share < 1; };
    const auto picture = render(PathTracer(world), look_at({}), {.progress = print});
}
// [mistake]
