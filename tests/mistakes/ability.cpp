// An ability whose header is not included.
// says: Include the header of each ability: ljus/render/gathering.hpp for Gathering

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    const World world(std::move(scene));
    const PhotonMapper mapper(world, {.indirect = IndirectLight::gather},
                              abilities<Gathering>);
}
// [mistake]
