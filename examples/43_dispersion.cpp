// smoke: --quality draft --width 32 --height 16 --rays 1 --photons 500
/// \file 43_dispersion.cpp
/// \brief Chapter 43: a prism on a table; a ball of heavy flint and a diamond.

#include <cmath>

#include <ljus/accel/mesh.hpp>
#include <ljus/lights/environment.hpp>
#include <ljus/lights/spot_light.hpp>
#include <ljus/lights/sun_light.hpp>
#include <ljus/ljus.hpp>
#include <ljus/materials/dispersive_glass.hpp>
#include <ljus/math/stratified_stream.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

using Table = Scene<Shapes<Quad, Sphere, Mesh>, Materials<Lambertian, DispersiveGlass>,
                    Lights<SunLight, SpotLight, EnvironmentLight>>;

/// The surface of a body with rings of corners, one above the other. Each ring is
/// counter-clockwise as seen from above.
MeshData stacked(std::vector<std::vector<Vec3>> rings) {
    MeshData data;
    const auto n = std::uint32_t(rings[0].size());
    for (const auto& ring : rings)
        data.positions.insert(data.positions.end(), ring.begin(), ring.end());
    const auto last = std::uint32_t(n * (rings.size() - 1));
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t k = (i + 1) % n;
        for (std::uint32_t ring = 0; ring < last; ring += n) {
            data.triangles.push_back({ring + i, ring + k, ring + n + k});
            data.triangles.push_back({ring + i, ring + n + k, ring + n + i});
        }
        if (i > 0 && k > 0) { // bottom and top
            data.triangles.push_back({0, k, i});
            data.triangles.push_back({last, last + i, last + k});
        }
    }
    return data;
}

/// Eight corners around the y axis.
std::vector<Vec3> octagon(const Vec3& center, float radius) {
    std::vector<Vec3> ring;
    for (float phi = 0; phi < 6; phi += 0.785398f)
        ring.push_back(center + radius * Vec3{std::cos(phi), 0, -std::sin(phi)});
    return ring;
}

} // namespace

/// Makes dispersion-prism.png and dispersion-gems.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 0;
        line.about("Chapter 43, dispersion: a prism, a ball of flint and a diamond.");
        line.add("--photons", photons, "Photons of the caustics", 1, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 150, .samples = 4},
                        .report{.width = 720, .height = 360, .samples = 64},
                        .reference{.width = 1440, .height = 720, .samples = 1024}});
        if (!line.given("--photons"))
            photons = options.pick(100000LL, 10000000LL, 100000000LL);

        const auto show = [&](Table scene, const View& view, float radius,
                              const std::string& name) {
            scene.add(Quad{{-7, 0, 7}, {14, 0, 0}, {0, 0, -14}},
                      scene.add(Lambertian{.albedo = Rgb{0.7f}}));
            scene.add(EnvironmentLight{.picture = make_image(4, 2, Rgb{0.02f})});
            const World world(std::move(scene));
            const PhotonMapper mapper(
                world,
                {.caustics{.photons = photons, .seed = options.seed},
                 .caustics_estimate{.radius = radius * options.pick(4.0f, 1.0f, 0.5f)},
                 .lone_radius = 4},
                abilities<StratifiedStream>);
            const auto picture =
                examples::rendered(name, mapper, look_at(view), options);
            save_png(picture.image, options.path("dispersion-" + name + ".png"));
        };
        Table prism;
        const auto flint = prism.add(DispersiveGlass{.law = sf10<float>});
        const auto triangle = [](float y) -> std::vector<Vec3> {
            return {{-0.5f, y, -0.3f}, {0, y, 0.566f}, {0.5f, y, -0.3f}};
        };
        prism.add(Mesh(stacked({triangle(0.001f), triangle(0.8f)})), flint);
        // Sunlight through a slit between two black walls. In the prism it is parallel
        // to the base, which gives the least deviation.
        const auto black = prism.add(Lambertian{.albedo = Rgb{0.02f}});
        const Vec3 slit{-2.85f, 0, -1.36f}, along{0.497f, 0, -0.868f}, up{0, 3, 0};
        prism.add(Quad{slit + 0.02f * along, 9.0f * along, up}, black);
        prism.add(Quad{slit - 0.02f * along, -9.0f * along, up}, black);
        prism.add(SunLight{.direction{0.868f, -0.1f, 0.497f}, .irradiance = Rgb{80}});
        show(std::move(prism),
             {.position{0.8f, 5, 3.6f}, .target{0.8f, 0, -0.6f}, .vfov_degrees = 26},
             0.015f, "prism");

        Table gems;
        gems.add(Sphere{{-1.6f, 0.8f, 0}, 0.8f},
                 gems.add(DispersiveGlass{.law = sf66<float>}));
        gems.add(Mesh(stacked({octagon({1.2f, 0.01f, 0}, 0.02f),
                               octagon({1.2f, 0.85f, 0}, 1),
                               octagon({1.2f, 1.15f, 0}, 0.55f)})),
                 gems.add(DispersiveGlass{.law = diamond<float>}));
        for (const Vec3 aim : {Vec3{-1.6f, 0.8f, 0}, Vec3{1.2f, 0.8f, 0}}) {
            SpotLight lamp{.direction{0.3f, -0.8f, 0.3f}, .intensity = Rgb{900}};
            lamp.position = aim - 8.0f * lamp.direction;
            lamp.inner_degrees = lamp.outer_degrees = 6.3f;
            gems.add(lamp);
        }
        show(std::move(gems),
             {.position{0.5f, 5, 6}, .target{0.5f, 0.2f, 0.4f}, .vfov_degrees = 33},
             0.03f, "gems");
    });
}
