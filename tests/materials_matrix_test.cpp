// long: 36 pictures of each of 13 rooms, some 30 s
/// \file materials_matrix_test.cpp
/// \brief Photon mapping equals path tracing for every material that the rooms of
/// photon_mapping_test.cpp do not have.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "ljus/materials/compensated_glossy.hpp"
#include "ljus/materials/eon.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/rough_diffuse.hpp"
#include "ljus/materials/textured.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scene/camera.hpp"
#include "ljus/scene/scene.hpp"
#include "support/mean.hpp"

using namespace ljus;
using ljus_test::Mean;

namespace {

constexpr int size = 48;  // pixels on a side
constexpr int block = 12; // of them, on the side of a block
constexpr int across = size / block;
constexpr int mapped_seeds = 16; // of the photon mapper
constexpr int traced_seeds = 20; // of the path tracer

using Matt = Lambertian;
using CheckeredMatt = Textured<Lambertian, GlobeChecker>;
using CheckeredGloss = Textured<Glossy, GlobeChecker>;

/// One type for all rooms: a type for each would be compiled 13 times over.
using Room = Scene<Shapes<Sphere, Quad>,
                   Materials<Matt, Mirror, Metal, Eon, RoughDiffuse, Glossy, RoughMetal,
                             FullRoughMetal, ThinGlass, CheckeredMatt, CheckeredGloss>>;

/// A closed room; a ball of the material on the floor, a small mirror beside it, so
/// that a caustic falls on both, and a lamp behind the camera's view.
template <Material M>
Room room_with(const M& material) {
    Room room;
    const auto grey = room.add(Matt{.albedo = Rgb{0.5f}});
    const auto red = room.add(Matt{.albedo{0.6f, 0.3f, 0.3f}});
    const auto green = room.add(Matt{.albedo{0.3f, 0.6f, 0.3f}});
    const auto black = room.add(Matt{.albedo = Rgb{0}});
    const Vec3 x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2};
    room.add(Quad{{-1, -1, -1}, z, x}, grey);
    room.add(Quad{{-1, 1, -1}, x, z}, grey);
    room.add(Quad{{-1, -1, -1}, x, y}, grey);
    room.add(Quad{{-1, -1, 1}, y, x}, grey);
    room.add(Quad{{-1, -1, -1}, y, z}, red);
    room.add(Quad{{1, -1, -1}, z, y}, green);
    room.add(Sphere{.center{-0.15f, -0.45f, -0.2f}, .radius = 0.5f},
             room.add(material));
    room.add(Sphere{.center{0.6f, -0.7f, 0.25f}, .radius = 0.25f},
             room.add(Mirror{.reflectance{0.9f, 0.8f, 0.7f}}));
    room.add(Quad{{-0.6f, 0.98f, -0.55f}, {1, 0, 0}, {0, 0, 1}}, black, Rgb{4, 4, 3});
    return room;
}

/// The means of the blocks and of the whole picture, over several seeds.
struct Blocks {
    Mean of_block[across * across];
    Mean of_all;

    void add(const Image& image) {
        double sum[across * across] = {};
        double all = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const Rgb& c = pixel(image, x, y);
                const double value = double(c.x + c.y + c.z) / 3;
                sum[y / block * across + x / block] += value / (block * block);
                all += value / (size * size);
            }
        for (int b = 0; b < across * across; ++b) of_block[b].add(sum[b]);
        of_all.add(all);
    }
};

/// All that was compared.
struct Found {
    int blocks = 0;
    int beyond3 = 0;
    double worst = 0;
};

/// Renders a material both ways, and compares.
template <Material M>
void compare(const std::string& name, const M& material, std::uint64_t cell,
             Found& all) {
    const auto room = room_with(material);
    const Camera camera = look_at(
        {.position{0, 0.25f, 0.97f}, .target{0, -0.45f, -0.3f}, .vfov_degrees = 70});
    const auto picture = [](std::uint64_t seed) {
        return RenderSettings{
            .width = size, .height = size, .samples = 4, .seed = seed, .threads = 1};
    };
    Blocks traced, mapped;
    for (std::uint64_t s = 1; s <= traced_seeds; ++s)
        traced.add(
            render(make_path_tracer(room), camera, picture(1000 * cell + 500 + s))
                .image);
    for (std::uint64_t s = 1; s <= mapped_seeds; ++s) {
        PhotonMappingSettings settings;
        settings.caustics = {.photons = 20000, .seed = 1000 * cell + s, .threads = 1};
        settings.caustics_estimate = {.radius = 0.03f};
        const auto maps = make_photon_maps(room, settings);
        mapped.add(render(make_photon_mapper(room, maps, settings), camera,
                          picture(1000 * cell + s))
                       .image);
    }
    double worst = 0;
    for (int b = 0; b < across * across; ++b) {
        const double distance =
            std::abs(ljus_test::apart(mapped.of_block[b], traced.of_block[b]));
        ++all.blocks;
        all.beyond3 += distance < 3 ? 0 : 1;
        worst = std::max(worst, distance);
    }
    const Mean &a = mapped.of_all, &b = traced.of_all;
    MESSAGE(name, ": means ", 100 * (a.mean / b.mean - 1), " +- ",
            100 * std::hypot(a.error(), b.error()) / b.mean, " %, worst block ", worst);
    CAPTURE(name);
    CHECK(worst < 5);
    CHECK(std::abs(ljus_test::apart(a, b)) < 4);
    CHECK(std::hypot(a.error(), b.error()) < 0.006 * b.mean);
    all.worst = std::max(all.worst, worst);
}

} // namespace

// 13 rooms of 16 blocks. A distance has Student's t with some 30 degrees of freedom:
// chance puts 1 of 208 blocks beyond 3 standard errors, more than 5 in one run of 2000,
// and one beyond 5 in one run of 250. A mean beyond 4 standard errors, which are
// below 0.6 %, is one run of 200. The seeds are fixed; two blocks were seen beyond 3.
TEST_CASE("materials matrix: photon mapping equals path tracing, for each material") {
    Found all;
    const Rgb ochre{0.8f, 0.6f, 0.3f};
    const auto rough = [&](RoughModel model) {
        return RoughDiffuse{.albedo = ochre, .sigma = 0.6f, .model = model};
    };
    compare("metal", Metal{}, 1, all);
    compare("eon", Eon{.albedo = ochre, .roughness = 0.7f}, 2, all);
    compare("as printed", rough(RoughModel::as_printed), 3, all);
    compare("full", rough(RoughModel::full), 4, all);
    compare("fujii", rough(RoughModel::fujii), 5, all);
    compare("fon", rough(RoughModel::fon), 6, all);
    compare("glossy", Glossy{.reflectance = ochre, .roughness = 0.4f}, 7, all);
    compare("rough metal", RoughMetal{.reflectance = copper<float>, .roughness = 0.7f},
            8, all);
    compare("gloss of roughness 0", Glossy{.reflectance = ochre, .roughness = 0}, 9,
            all);
    compare("thin glass", ThinGlass{.tint{0.8f, 0.9f, 0.7f}}, 10, all);
    compare("checker",
            CheckeredMatt{{.albedo = Rgb{1}},
                          {.map{.center{-0.15f, -0.45f, -0.2f}},
                           .even = ochre,
                           .odd{0.1f, 0.2f, 0.5f},
                           .columns = 12,
                           .rows = 6}},
            11, all);
    compare("checkered gloss",
            CheckeredGloss{{.reflectance = Rgb{1}, .roughness = 0.6f},
                           {.map{.center{-0.15f, -0.45f, -0.2f}}}},
            12, all);
    compare(
        "full gloss of copper",
        compensated_glossy(RoughMetal{.reflectance = copper<float>, .roughness = 0.8f}),
        13, all);
    MESSAGE(all.beyond3, " of ", all.blocks, " blocks beyond 3, worst ", all.worst);
    CHECK(all.beyond3 <= 5);
}
