// A wrapper of a material that hides an optional function of its base.
// says: hides an optional function of its base

// [mistake]
#include <ljus/ljus.hpp>
using namespace ljus;

template <Material Base>
struct Numbered {
    using Scalar = float;
    static constexpr bool scatters_as_base = true;
    Base base{};
    int number = 0;
};
template <typename Base>
void check(const Numbered<Base>&) {}

int main() {
    Scene<Shapes<Sphere>, Materials<Numbered<Glass>>> scene;
}
// [mistake]
