// smoke: --quality draft --width 24 --height 14 --rays 1
/// \file 45_textures.cpp
/// \brief Chapter 45: leaves cut out of squares, over tiles with a normal map.

#include <cmath>
#include <numbers>

#include <ljus/lights/environment.hpp>
#include <ljus/ljus.hpp>
#include <ljus/materials/cut_out.hpp>
#include <ljus/materials/normal_map.hpp>
#include <ljus/math/stratified_stream.hpp>
#include <ljus/render/path_tracing.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {
constexpr float pi = std::numbers::pi_v<float>;

/// A texture with the colours color_of(u, v), in the coordinates of the shape.
template <typename ColorOf>
UvPicture drawn(int size, const UvMap& map, ColorOf color_of) {
    UvPicture picture{.image = make_image<float>(size, size), .map = map};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            pixel(picture.image, x, y) = color_of((float(x) + 0.5f) / float(size),
                                                  1 - (float(y) + 0.5f) / float(size));
    return picture;
}

// [leaf]
/// Half the width of a leaf with a toothed rim at the height v, or of its stalk.
float half_width(float v) {
    const float leaf = 0.4f * std::sin(pi * std::pow(v, 0.7f));
    const float teeth = 1 - 0.25f * std::abs(std::sin(9 * pi * v));
    return std::max(v < 0.12f ? 0.02f : 0.0f, leaf * teeth);
}

/// The material of a square with the shape of a leaf and paler veins.
auto leaf(const Rgb& color) {
    const auto alpha = [](float u, float v) {
        return Rgb{std::abs(u - 0.5f) < half_width(v) ? 1.0f : 0.0f};
    };
    const auto veins = [](float u, float v) {
        const float x = std::abs(u - 0.5f), along = std::abs(std::sin(24 * (v - x)));
        return Rgb{x < 0.015f || along < 0.12f ? 1.0f : 0.7f};
    };
    return Textured<CutOut<Lambertian, UvPicture>, UvPicture>{
        {{.albedo = color}, {.mask = drawn(128, {}, alpha)}}, drawn(128, {}, veins)};
}
// [leaf]

/// The material of tiles with grey joints. Its normals make rounded rims and waves.
auto tiles(float count) {
    const UvMap map{.scale{count, count}};
    const auto rim = [](float x) { return std::max(0.0f, std::abs(x - 0.5f) - 0.4f); };
    const auto color = [&](float u, float v) {
        return std::max(rim(u), rim(v)) > 0.08f ? Rgb{0.35f} : Rgb{0.62f, 0.4f, 0.28f};
    };
    const auto normal = [&](float u, float v) {
        const auto slope = [&](float x, float y) {
            return std::copysign(8 * rim(x), x - 0.5f) + 0.15f * std::sin(6 * pi * y);
        };
        return 0.5f + 0.5f * glm::normalize(Vec3{slope(u, v), slope(v, u), 1});
    };
    return Textured<Textured<Lambertian, UvPicture>, NormalMap>{
        {{.albedo = Rgb{1}}, drawn(128, map, color)}, {drawn(128, map, normal)}};
}

/// A square around a point, turned at random, but facing upwards rather than down.
Quad turned_square(const Vec3& center, float size, RandomStream& stream) {
    const Vec3 up =
        glm::normalize(Vec3{0, 1.2f, 0} + 2.0f * next_3d<float>(stream) - 1.0f);
    const Frame frame = frame_around(up);
    const float angle = 2 * pi * next_1d<float>(stream);
    const Vec3 u = size * to_world(frame, Vec3{std::cos(angle), std::sin(angle), 0});
    const Vec3 v = glm::cross(up, u);
    return {center - 0.5f * (u + v), u, v};
}

} // namespace

/// Makes textures-leaves.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 45, textures: leaves over a floor of tiles.");
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 170, .samples = 8},
                        .report{.width = 720, .height = 400, .samples = 64},
                        .reference{.width = 1440, .height = 800, .samples = 1024}});

        Scene<Shapes<Quad, Sphere>,
              Materials<decltype(leaf({})), decltype(tiles(1)), Lambertian>,
              Lights<EnvironmentLight>>
            scene;
        const std::array green{scene.add(leaf({0.22f, 0.5f, 0.1f})),
                               scene.add(leaf({0.75f, 0.45f, 0.08f}))};
        scene.add(Quad{{-8, 0, 8}, {16, 0, 0}, {0, 0, -16}}, scene.add(tiles(16)));
        RandomStream stream = random_stream(45, Pass::user, 0, 0);
        for (int i = 0; i < 130; ++i) {
            const Vec3 at = next_3d<float>(stream);
            const Vec3 center{4.4f * at.x - 2.2f, 0.25f + 1.7f * at.y, 2.6f * at.z - 2};
            scene.add(turned_square(center, 0.42f, stream), green[i % 3 == 0 ? 1 : 0]);
        }
        scene.add(Sphere{{-8, 6, 1}, 0.5f}, scene.add(Lambertian{}),
                  Rgb{330, 300, 240});
        scene.add(EnvironmentLight{.picture = make_image(4, 2, Rgb{0.3f, 0.4f, 0.5f})});
        const World world(std::move(scene));
        const Camera camera = look_at(
            {.position{0, 1.7f, 3.6f}, .target{0, 0.55f, -0.4f}, .vfov_degrees = 42});
        const PathTracer tracer(world);
        const auto picture = examples::rendered("leaves", tracer, camera, options);
        save_png(picture.image, options.path("textures-leaves.png"));
    });
}
