// The flag -std=c++20 is missing.
// says: Ljus needs C\+\+20: add -std=c\+\+20
// flags: -std=c++17

#include <ljus/geometry/sphere.hpp>

int main() { return intersect(ljus::Ray{}, ljus::Sphere{}) ? 0 : 1; }
