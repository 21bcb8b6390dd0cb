// A colour has three channels, and GLM makes none of one number by itself.
// says: no viable conversion from .float. to .RgbT|could not convert .*float.* to .ljus::RgbT
// long: clang++ adds the constructors of GLM

// [mistake]
#include <ljus/ljus.hpp>

int main() {
    const ljus::Lambertian grey{.albedo = 0.5f};
    return grey.albedo.x > 0 ? 0 : 1;
}
// [mistake]
