// What render() returns is a picture and what it cost; the image is a part of it.
// says: no matching function for call to .save_png

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    const World world(std::move(scene));
    const auto picture = render(PathTracer(world), look_at({}), {});
    save_png(picture, "picture.png");
}
// [mistake]
