// A type that is no material.
// says: Material<M>|does not satisfy 'Material'

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

struct Paint {
    Rgb color{0.5f};
};

int main() {
    Scene<Shapes<Sphere>, Materials<Paint>> scene;
}
// [mistake]
