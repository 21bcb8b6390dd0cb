/// \file hello_sphere.cpp
/// \brief The least: one ball, one point light, one ray a pixel.

#include "ljus/lights/point_light.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/render/whitted.hpp"
#include "ljus/scene/world.hpp"
#include "report.hpp"

using namespace ljus;

int main() {
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<PointLight>> scene;
    scene.add(Sphere{.center{0, 0, -3}}, scene.add(Lambertian{.albedo = Rgb{0.7f}}));
    scene.add(PointLight{.position{2, 3, 1}, .intensity = Rgb{20}});
    const World world(std::move(scene));
    const WhittedTracer whitted(world);
    report(render(whitted, look_at({.position{0, 0, 0}, .target{0, 0, -3}}),
                  {.width = 64, .height = 64, .samples = 1, .threads = 1}));
}
