// A callback with other arguments than (done, total).
// says: no matching function for call to .render

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    auto print = [](double share) { return share < 1; };
    const auto picture =
        render(make_path_tracer(scene), look_at({}), {.progress = print});
}
// [mistake]
