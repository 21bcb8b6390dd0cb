/// \file own_kernel.cpp
/// \brief Shows a caustics map through a kernel of the reader's own.
// runs in the folder of its picture

#include <ljus/ljus.hpp>

#include "own_kernel.hpp"

/// Draws the caustic of a glass ball with a Hann kernel into own_kernel.png.
int main() {
    using namespace ljus;
    Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Glass>, Lights<PointLight>> scene;
    const Lambertian white{.albedo = Rgb{0.7f}};
    scene.add(Quad{{-6, 0, 6}, {12, 0, 0}, {0, 0, -12}}, scene.add(white));
    scene.add(Sphere{{0, 1.2f, 0}, 1}, scene.add(Glass{.index = 1.5f}));
    scene.add(PointLight{.position{-3, 5, 0}, .intensity = Rgb{18}});
    const World world(std::move(scene));
    const PhotonMapper mapper(world, {.caustics{.photons = 100000}});
    const DensityEstimateOf<reader::Hann> gather{.radius = 0.12f};
    check(gather); // refuses a kernel that creates or loses light

    const Camera camera = look_at({.position{1.5f, 6, 3.5f}, .target{0.8f, 0, 0}});
    Image image = make_image(320, 240);
    // [own kernel]
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Ray ray =
                primary_ray(camera, {float(x), float(y)}, image.width, image.height);
            const auto hit = closest_hit(world, ray);
            if (!hit) continue;
            const VertexT<float> vertex = vertex_at(world, ray, *hit);
            std::uint64_t found = 0;
            pixel(image, x, y) =
                estimate_radiance(mapper.maps().caustics, vertex, white, vertex.wo,
                                  gather, all_kinds, found);
        }
    // [own kernel]
    save_png(image, "own_kernel.png");
}
