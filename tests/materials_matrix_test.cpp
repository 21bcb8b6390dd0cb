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
#include "support/block_means.hpp"
#include "support/box_sides.hpp"
#include "support/mean.hpp"
#include "support/student.hpp"

using namespace ljus;
using ljus_test::chance_of;
using ljus_test::Mean;
using ljus_test::test_seed;

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
World<Room> room_with(const M& material) {
    Room room;
    const auto grey = room.add(Matt{.albedo = Rgb{0.5f}});
    const auto red = room.add(Matt{.albedo{0.6f, 0.3f, 0.3f}});
    const auto green = room.add(Matt{.albedo{0.3f, 0.6f, 0.3f}});
    const auto black = room.add(Matt{.albedo = Rgb{0}});
    ljus_test::add_room(room, Vec3{-1}, Vec3{1}, {grey, grey, grey, grey, red, green});
    room.add(Sphere{.center{-0.15f, -0.45f, -0.2f}, .radius = 0.5f},
             room.add(material));
    room.add(Sphere{.center{0.6f, -0.7f, 0.25f}, .radius = 0.25f},
             room.add(Mirror{.reflectance{0.9f, 0.8f, 0.7f}}));
    room.add(Quad{{-0.6f, 0.98f, -0.55f}, {1, 0, 0}, {0, 0, 1}}, black, Rgb{4, 4, 3});
    return World(std::move(room));
}

/// All that was compared.
struct Found {
    int blocks = 0;
    int rare = 0; ///< Of them, with a chance below 0.0027: normal ones' 3 errors.
    double least = 1;
    int rooms = 0;
    double surprise = 0, off = 0, off_variance = 0; ///< Of the rooms' means.
};

/// Renders a material both ways, and compares.
template <Material M>
void compare(const std::string& name, const M& material, std::uint64_t cell,
             Found& all) {
    const auto room = room_with(material);
    const Camera camera = look_at(
        {.position{0, 0.25f, 0.97f}, .target{0, -0.45f, -0.3f}, .vfov_degrees = 70});
    const auto picture = [](std::uint64_t seed) {
        return RenderSettings{.width = size,
                              .height = size,
                              .samples = 4,
                              .seed = test_seed(seed),
                              .threads = 1};
    };
    ljus_test::BlockMeans traced{block}, mapped{block};
    for (std::uint64_t s = 1; s <= traced_seeds; ++s)
        traced.add(
            render(PathTracer(room), camera, picture(1000 * cell + 500 + s)).image);
    for (std::uint64_t s = 1; s <= mapped_seeds; ++s) {
        PhotonMappingSettings settings;
        settings.caustics = {
            .photons = 20000, .seed = test_seed(1000 * cell + s), .threads = 1};
        settings.caustics_estimate = {.radius = 0.03f};
        mapped.add(
            render(PhotonMapper(room, settings), camera, picture(1000 * cell + s))
                .image);
    }
    double least = 1;
    for (std::size_t b = 0; b < across * across; ++b) {
        const double chance = chance_of(mapped.of[b], traced.of[b]);
        ++all.blocks;
        all.rare += chance < 0.0027 ? 1 : 0;
        least = std::min(least, chance);
    }
    const Mean &a = mapped.of.back(), &b = traced.of.back();
    const double error = std::hypot(a.error(), b.error()) / b.mean;
    const double chance = chance_of(a, b);
    MESSAGE(name, ": means ", 100 * (a.mean / b.mean - 1), " +- ", 100 * error,
            " %, least chance of a block ", least);
    CAPTURE(name);
    CHECK(least > 1e-8);
    CHECK(chance > 1e-6);
    all.least = std::min(all.least, least);
    ++all.rooms;
    all.surprise -= 2 * std::log(chance);
    all.off += a.mean / b.mean - 1;
    all.off_variance += error * error;
}

} // namespace

// 13 rooms of 16 blocks; the scatter of each is known from 16 and 20 seeds, and
// chance_of() knows how well. One of 208 blocks is rarer than 1e-8 in 500 000 runs, and
// more than 5 are rarer than 0.0027 in 40 000; one of 13 means is rarer than 1e-6 in
// 75 000. Two more look at all means at once: Fisher's sum of the logarithms of their
// chances, and their own mean. In all a false alarm is one in 20 000 runs.
// Run with 20 further seeds: none failed.
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
    const double off_error = std::sqrt(all.off_variance);
    MESSAGE(all.rare, " of ", all.blocks, " blocks rare, least ", all.least,
            "; surprise ", all.surprise, ", off ", 100 * all.off / all.rooms, " +- ",
            100 * off_error / all.rooms, " %");
    CHECK(all.rare <= 5);
    CHECK(all.surprise < ljus_test::chi_square_limit(2 * all.rooms));
    CHECK(std::abs(all.off) < ljus_test::once_in_a_million * off_error);
    CHECK(off_error < 0.0015 * all.rooms); // it is a comparison
}
