/// \file cornell_diffuse.cpp
/// \brief A box of matt walls and balls, by the photon mapper: nothing asks for a
/// photon. With -DALL_HEADERS it includes everything and lists
/// every shape and material.

#ifdef ALL_HEADERS
#include "ljus/ljus.hpp"
#else
#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/scene/camera.hpp"
#endif
#include "report.hpp"

using namespace ljus;

namespace {

#ifdef ALL_HEADERS
using MattBox =
    Scene<Shapes<Quad, Sphere, Triangle>, Materials<Lambertian, Mirror, Glass, Mixture,
                                                    Glossy, Eon, OrenNayar, SoapFilm>>;
#else
using MattBox = Scene<Shapes<Quad, Sphere>, Materials<Lambertian>>;
#endif

} // namespace

int main() {
    MattBox scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.75f}});
    const auto red = scene.add(Lambertian{.albedo{0.63f, 0.06f, 0.05f}});
    const auto green = scene.add(Lambertian{.albedo{0.14f, 0.45f, 0.09f}});
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    const Vec3 x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2}, corner{-1, 0, -1};
    scene.add(Quad{corner, z, x}, white);
    scene.add(Quad{corner + y, x, z}, white);
    scene.add(Quad{corner, x, y}, white);
    scene.add(Quad{corner, y, z}, red);
    scene.add(Quad{corner + x, z, y}, green);
    scene.add(Sphere{.center{-0.42f, 0.38f, -0.3f}, .radius = 0.38f}, red);
    scene.add(Sphere{.center{0.42f, 0.38f, 0.3f}, .radius = 0.38f}, white);
    scene.add(Quad{{-0.25f, 1.99f, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f}}, black,
              Rgb{17, 13, 8});
    const World world(std::move(scene));
    const PhotonMapper mapper(world);
    report(
        render(mapper,
               look_at({.position{0, 1, 4.4f}, .target{0, 1, 0}, .vfov_degrees = 33}),
               {.width = 64, .height = 64, .samples = 4, .threads = 1}),
        mapper.maps().caustics.records.size());
}
