// smoke: --quality draft --width 24 --height 16 --rays 1 --photons 500
/// \file 44_instances.cpp
/// \brief Chapter 44: a field of knots of glass and clay, all of which are instances of
/// one mesh.

#include <cmath>
#include <numbers>

#include <ljus/accel/instances.hpp>
#include <ljus/lights/environment.hpp>
#include <ljus/ljus.hpp>
#include <ljus/math/stratified_stream.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

constexpr double pi = std::numbers::pi;

/// A trefoil knot around the y axis, with a tube of radius 0.2. It has 2 * around *
/// across triangles.
MeshData trefoil(int around, int across) {
    const auto center = [](double t) {
        const double out = 2 + std::cos(3 * t);
        return 0.4 * glm::dvec3(out * std::cos(2 * t), std::sin(3 * t),
                                -out * std::sin(2 * t));
    };
    MeshData data;
    const auto vertex = [&](int i, int k) {
        return static_cast<std::uint32_t>((i % around) * across + k % across);
    };
    for (int i = 0; i < around; ++i) {
        const double t = 2 * pi * i / around;
        const glm::dvec3 ahead = glm::normalize(center(t + 1e-4) - center(t - 1e-4));
        const glm::dvec3 outwards(std::cos(2 * t), 0, -std::sin(2 * t));
        const glm::dvec3 side = glm::normalize(glm::cross(ahead, outwards));
        const glm::dvec3 up = glm::cross(side, ahead);
        for (int k = 0; k < across; ++k) {
            const double phi = 2 * pi * k / across;
            const glm::dvec3 normal = std::cos(phi) * up + std::sin(phi) * side;
            data.positions.emplace_back(center(t) + 0.2 * normal);
            data.normals.emplace_back(normal);
            const auto a = vertex(i, k), b = vertex(i + 1, k);
            const auto c = vertex(i + 1, k + 1), d = vertex(i, k + 1);
            data.triangles.push_back({a, c, b});
            data.triangles.push_back({a, d, c});
        }
    }
    return data;
}

// [place]
/// The map of the knot in a row and column. Each knot is turned and scaled, and every
/// second one is mirrored.
Affine place(int row, int column, RandomStream& stream) {
    const float angle = 6.2832f * next_1d<float>(stream);
    const float size = 0.24f + 0.1f * next_1d<float>(stream);
    const float mirror = (row + column) % 2 == 0 ? 1.0f : -1.0f;
    const float c = size * std::cos(angle), s = size * std::sin(angle);
    Affine map;
    map[0] = mirror * Vec3{c, 0, -s};
    map[1] = {0, size, 0};
    map[2] = {s, 0, c};
    map[3] = {float(column), 0.6f * size, -float(row)};
    return map;
}
// [place]

} // namespace

/// Makes instances-field.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 0;
        line.about("Chapter 44, instances: a field of knots.");
        line.add("--photons", photons, "Photons of the caustics", 1, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 150, .samples = 4},
                        .report{.width = 720, .height = 360, .samples = 48},
                        .reference{.width = 1440, .height = 720, .samples = 1024}});
        if (!line.given("--photons"))
            photons = options.pick(50000LL, 1000000LL, 20000000LL);

        // [scene]
        Scene<Shapes<Instance, Quad, Sphere>, Materials<Lambertian, Glass>,
              Lights<EnvironmentLight>>
            scene;
        const auto sand = scene.add(Lambertian{.albedo{0.62f, 0.55f, 0.42f}});
        const auto clay = scene.add(Lambertian{.albedo{0.7f, 0.28f, 0.16f}});
        const auto glass = scene.add(Glass{.absorption{1.6f, 0.4f, 0.2f}});
        const auto knot = scene.add(Mesh(trefoil(240, 24)));
        RandomStream stream = random_stream(44, Pass::user, 0, 0);
        for (int row = 0; row < 16; ++row)
            for (int column = -8; column <= 8; ++column)
                scene.add(Instance(knot, place(row, column, stream)),
                          next_1d<float>(stream) < 0.4f ? glass : clay);
        // [scene]
        scene.add(Quad{{-60, 0, 10}, {120, 0, 0}, {0, 0, -120}}, sand);
        scene.add(Sphere{{-30, 25, -40}, 3}, sand, Rgb{380, 330, 250});
        scene.add(
            EnvironmentLight{.picture = make_image(4, 2, Rgb{0.35f, 0.45f, 0.65f})});
        const World world(std::move(scene));

        const PhotonMapper mapper(
            world,
            {.direct = DirectLight::mis,
             .caustics{.photons = photons, .seed = options.seed},
             .caustics_estimate{.radius = options.pick(0.08f, 0.04f, 0.02f)}},
            abilities<StratifiedStream>);
        const Camera camera = look_at(
            {.position{0.8f, 2.2f, 3.4f}, .target{0.1f, 0, -2.6f}, .vfov_degrees = 30});
        const auto picture = examples::rendered("field", mapper, camera, options);
        save_png(picture.image, options.path("instances-field.png"));
    });
}
