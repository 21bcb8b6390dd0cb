// smoke: --quality draft --width 32 --height 16 --rays 1 --photons 500
/// \file 43_dispersion.cpp
/// \brief Chapter 43: a prism on a table, and the caustic of a ball of heavy flint.

#include <cmath>

#include <ljus/accel/mesh.hpp>
#include <ljus/lights/environment.hpp>
#include <ljus/lights/sun_light.hpp>
#include <ljus/ljus.hpp>
#include <ljus/materials/dispersive_glass.hpp>
#include <ljus/math/stratified_stream.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

using Table = Scene<Shapes<Quad, Sphere, Mesh>, Materials<Lambertian, DispersiveGlass>,
                    Lights<SunLight, EnvironmentLight>>;

/// A prism that stands on the table: its three corners from above, counter-clockwise.
MeshData prism(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 up{0, 0.8f, 0};
    return {.positions{a, b, c, a + up, b + up, c + up},
            .triangles{{0, 2, 1},
                       {3, 4, 5},
                       {0, 1, 4},
                       {0, 4, 3},
                       {1, 2, 5},
                       {1, 5, 4},
                       {2, 0, 3},
                       {2, 3, 5}}};
}

/// A gem with eight sides: its tip, a ring around its waist, and one around its top.
MeshData gem(const Vec3& tip) {
    MeshData data{.positions{tip, tip + Vec3{0, 1.15f, 0}}};
    for (int i = 0; i < 8; ++i) {
        const float phi = 0.785398f * float(i), c = std::cos(phi), s = std::sin(phi);
        data.positions.push_back(tip + Vec3{c, 0.85f, -s});
        data.positions.push_back(tip + Vec3{0.55f * c, 1.15f, -0.55f * s});
    }
    for (std::uint32_t i = 0; i < 8; ++i) {
        const std::uint32_t a = 2 + 2 * i, b = 2 + (2 * i + 2) % 16;
        data.triangles.insert(
            data.triangles.end(),
            {{0, b, a}, {a, b, b + 1}, {a, b + 1, a + 1}, {a + 1, b + 1, 1}});
    }
    return data;
}

/// A table of white paper under a faint sky.
Table table() {
    Table scene;
    scene.add(Quad{{-20, 0, 20}, {40, 0, 0}, {0, 0, -40}},
              scene.add(Lambertian{.albedo = Rgb{0.7f}}));
    scene.add(EnvironmentLight{.picture = make_image(4, 2, Rgb{0.03f})});
    return scene;
}

} // namespace

/// Makes dispersion-prism.png and dispersion-gems.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 0;
        line.about("Chapter 43, dispersion: a prism, and a ball of heavy flint.");
        line.add("--photons", photons, "Photons of the caustics", 1, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 150, .samples = 4},
                        .report{.width = 720, .height = 360, .samples = 36},
                        .reference{.width = 1440, .height = 720, .samples = 1024}});
        if (!line.given("--photons"))
            photons = options.pick(100000LL, 2000000LL, 20000000LL);

        const auto show = [&](Table scene, const View& view, const char* name) {
            const World world(std::move(scene));
            const PhotonMapper mapper(
                world,
                {.split_glass = true,
                 .caustics{.photons = photons, .seed = options.seed},
                 .caustics_estimate{.radius = options.pick(0.05f, 0.02f, 0.01f)}},
                abilities<StratifiedStream>);
            const auto picture =
                examples::rendered(name, mapper, look_at(view), options);
            save_png(picture.image,
                     options.path(std::string("dispersion-") + name + ".png"));
        };
        {
            // [prism]
            Table scene = table();
            const auto flint = scene.add(DispersiveGlass{.law = sf10<float>});
            scene.add(Mesh(prism({-0.5f, 0.001f, -0.3f}, {0, 0.001f, 0.566f},
                                 {0.5f, 0.001f, -0.3f})),
                      flint);
            // Sunlight through a slit between two black walls. In the prism it runs
            // along the base, and so is deviated least.
            const auto black = scene.add(Lambertian{.albedo = Rgb{0.02f}});
            const Vec3 sun{0.868f, -0.1f, 0.497f}, along{0.497f, 0, -0.868f};
            const Vec3 slit{-2.85f, 0, -1.36f}, up{0, 3, 0};
            scene.add(Quad{slit + 0.02f * along, 9.0f * along, up}, black);
            scene.add(Quad{slit - 0.02f * along, -9.0f * along, up}, black);
            scene.add(SunLight{.direction = sun, .irradiance = Rgb{80}});
            // [prism]
            show(
                std::move(scene),
                {.position{0.8f, 5, 3.6f}, .target{0.8f, 0, -0.6f}, .vfov_degrees = 26},
                "prism");
        }
        {
            Table scene = table();
            scene.add(Sphere{{-1.6f, 0.8f, 0}, 0.8f},
                      scene.add(DispersiveGlass{.law = sf66<float>}));
            scene.add(Mesh(gem({1.2f, 0.001f, 0})),
                      scene.add(DispersiveGlass{.law = diamond<float>}));
            scene.add(SunLight{.direction{0.6f, -0.8f, 0.4f}, .irradiance = Rgb{5}});
            show(std::move(scene),
                 {.position{0.5f, 4, 6}, .target{0.5f, 0.3f, 0}, .vfov_degrees = 30},
                 "gems");
        }
    });
}
