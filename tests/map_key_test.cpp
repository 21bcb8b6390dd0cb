/// \file map_key_test.cpp
/// \brief A saved map is of one scene and of one way to make it, and of no other.

#include <doctest/doctest.h>

#include <algorithm>
#include <stdexcept>

#include "ljus/accel/mesh.hpp"
#include "ljus/geometry/metaballs.hpp"
#include "ljus/geometry/moving.hpp"
#include "ljus/io/light_map_file.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/materials/eon.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/materials/oren_nayar.hpp"
#include "ljus/materials/rough_diffuse.hpp"
#include "ljus/materials/soap_film.hpp"
#include "ljus/scenes/cornell_box.hpp"
#include "scratch_folder.hpp"
#include "support/refusal.hpp"

using namespace ljus;

namespace {

/// FNV-1a of bytes, from its definition.
std::uint64_t fnv(std::initializer_list<unsigned> bytes) {
    std::uint64_t hash = 14695981039346656037u;
    for (const unsigned byte : bytes) hash = (hash ^ byte) * 1099511628211u;
    return hash;
}

template <typename... V>
std::uint64_t hash_of(const V&... values) {
    detail::FieldHash hash;
    hash.add(values...);
    return hash.value;
}

/// Something of most kinds.
struct Parts {
    Sphere ball{.center{0, 1, -3}, .radius = 1};
    Quad wall{{-2, -2, 0}, {4, 0, 0}, {0, 4, 0}};
    Moving<Sphere> moving{.shape = {.center{2, 1, -3}, .radius = 0.5f},
                          .displacement{1, 0, 0}};
    Metaballs blobs{.blobs = {{.center{3, 0, 0}, .radius = 1, .weight = 1},
                              {.center{3, 1, 0}, .radius = 1, .weight = 1}}};
    MeshData mesh{.positions = {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}},
                  .triangles = {{0, 1, 2}}};
    Lambertian matt{};
    Glass glass{};
    SoapFilm film{};
    Mixture mixture{};
    RoughDiffuse rough{};
    PointLight lamp{.position{0, 3, 0}, .intensity = Rgb{20}};
    SpotLight spot{.position{0, 4, 0}, .direction{0, -1, 0}, .intensity = Rgb{5}};
    Rgb shine{1, 2, 3};
    bool inside_out = false;

    std::uint64_t hash() const {
        Scene<Shapes<Sphere, Quad, Moving<Sphere>, Metaballs, Mesh>,
              Materials<Lambertian, Glass, SoapFilm, Mixture, RoughDiffuse>,
              Lights<PointLight, SpotLight>>
            scene;
        const auto grey = scene.add(matt);
        scene.add(ball, scene.add(glass));
        scene.add(wall, grey, shine, inside_out);
        scene.add(moving, scene.add(mixture));
        scene.add(blobs, scene.add(rough));
        scene.add(Mesh(mesh), scene.add(film));
        scene.add(lamp);
        scene.add(spot);
        return detail::scene_hash(World(std::move(scene)));
    }
};

auto go_on = [](long long, long long) { return true; };

std::string refusal(const std::string& path, const LightMapKey& key) {
    return ljus_test::refusal<std::runtime_error>(
        [&] { (void)load_light_map(path, key); }, "it was read");
}

} // namespace

TEST_CASE("map_key: the hash is that of the numbers' bytes, lowest first") {
    struct Two {
        float a = 1;
        std::uint16_t b = 0x1234;
    };
    struct Nested {
        bool yes = true;
        Two two{};
        double c = -2;
    };
    CHECK(hash_of() == fnv({}));
    CHECK(hash_of(std::uint8_t(97)) == 0xaf63dc4c8601ec8cu); // published: "a"
    CHECK(hash_of(Two{}) == fnv({0, 0, 128, 63, 0x34, 0x12}));
    CHECK(hash_of(Nested{}) ==
          fnv({1, 0, 0, 128, 63, 0x34, 0x12, 0, 0, 0, 0, 0, 0, 0, 192}));
    CHECK(hash_of(Vec3{1, 0, 2}) == fnv({0, 0, 128, 63, 0, 0, 0, 0, 0, 0, 0, 64}));
    CHECK(hash_of(RadiositySolver::jacobi) == fnv({1}));
    CHECK(hash_of(std::optional<std::uint8_t>{}) == fnv({0}));
    CHECK(hash_of(std::optional<std::uint8_t>{7}) == fnv({1, 7}));
    CHECK(hash_of(std::vector<std::uint8_t>{5, 6}) ==
          fnv({2, 0, 0, 0, 0, 0, 0, 0, 5, 6}));
    // Where one list ends and the next begins does count.
    using List = std::vector<std::uint8_t>;
    CHECK(hash_of(List{1}, List{}) != hash_of(List{}, List{1}));
}

TEST_CASE("map_key: whatever a scene is made of is part of its key") {
    const std::uint64_t before = Parts{}.hash();
    CHECK(Parts{}.hash() == before);
    std::vector<std::uint64_t> seen{before};
    const auto other = [&](void (*change)(Parts&)) {
        Parts parts;
        change(parts);
        const std::uint64_t hash = parts.hash();
        CHECK(std::find(seen.begin(), seen.end(), hash) == seen.end());
        seen.push_back(hash);
    };
    other([](Parts& p) { p.ball.center.z = std::nextafter(p.ball.center.z, 0.f); });
    other([](Parts& p) { p.ball.radius = 2; });
    other([](Parts& p) { p.wall.edge_v.y = 5; });
    other([](Parts& p) { p.moving.displacement.y = 1; });
    other([](Parts& p) { p.blobs.blobs[1].weight = 0.5f; });
    other([](Parts& p) { p.blobs.blobs.pop_back(); });
    other([](Parts& p) { p.mesh.positions[2].y = 2; });
    other([](Parts& p) { std::swap(p.mesh.triangles[0][0], p.mesh.triangles[0][1]); });
    other([](Parts& p) { p.mesh.normals.assign(3, Vec3{0, 0, 1}); });
    other([](Parts& p) { p.matt.albedo.y = 0.25f; });
    other([](Parts& p) { p.glass.index = 1.6f; });
    other([](Parts& p) { p.glass.absorption.z = 1; });
    other([](Parts& p) { p.glass.fresnel = FresnelModel::schlick; });
    other([](Parts& p) { p.film.thickness = 401; });
    other([](Parts& p) { p.film.up = {0, 1, 0}; });
    other([](Parts& p) { p.mixture.absorption.x = 1; }); // the last of eight
    other([](Parts& p) { p.rough.model = RoughModel::full; });
    other([](Parts& p) { p.lamp.intensity.x = 21; });
    other([](Parts& p) { p.lamp.position.x = 1; });
    other([](Parts& p) { p.spot.outer_degrees *= 1.01f; });
    other([](Parts& p) { p.shine.z = 4; });
    other([](Parts& p) { p.inside_out = true; });
}

TEST_CASE(
    "map_key: materials of equal members, and who is made of what, are told apart") {
    const auto with = [](const auto& material) {
        Scene<Shapes<Sphere>, Materials<std::remove_cvref_t<decltype(material)>>> scene;
        scene.add(Sphere{.center{0, 0, -3}, .radius = 1}, scene.add(material));
        return detail::scene_hash(World(std::move(scene)));
    };
    CHECK(with(Lambertian{.albedo = Rgb{0.5f}}) !=
          with(Mirror{.reflectance = Rgb{0.5f}}));
    CHECK(with(Eon{.albedo = Rgb{0.5f}, .roughness = 0.5f}) !=
          with(OrenNayar{.albedo = Rgb{0.5f}, .sigma = 0.5f}));
    const auto made_of = [](bool swapped) {
        Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
        const auto red = scene.add(Lambertian{.albedo{1, 0, 0}});
        const auto blue = scene.add(Lambertian{.albedo{0, 0, 1}});
        scene.add(Sphere{.center{0, 0, -3}, .radius = 1}, swapped ? blue : red);
        scene.add(Sphere{.center{0, 3, -3}, .radius = 1}, swapped ? red : blue);
        return detail::scene_hash(World(std::move(scene)));
    };
    CHECK(made_of(true) != made_of(false));
}

TEST_CASE("map_key: settings that change a light map count, and no others") {
    const auto room = matt_cornell_box();
    const auto same = [&](void (*change)(RadiositySettings&)) {
        RadiositySettings settings;
        change(settings);
        return light_map_key(room.world, settings) == light_map_key(room.world, {});
    };
    using Settings = RadiositySettings;
    CHECK_FALSE(same([](Settings& s) { s.patches.size = 1; }));
    CHECK_FALSE(same([](Settings& s) { s.factors.analytic = false; }));
    CHECK_FALSE(same([](Settings& s) { s.factors.rays = 1; }));
    CHECK_FALSE(same([](Settings& s) { s.factors.shadow_rays = 1; }));
    CHECK_FALSE(same([](Settings& s) { s.factors.closed = true; }));
    CHECK_FALSE(same([](Settings& s) { s.factors.seed = 2; }));
    CHECK_FALSE(same([](Settings& s) { s.solve.solver = RadiositySolver::jacobi; }));
    CHECK_FALSE(same([](Settings& s) { s.solve.tolerance = 1e-3; }));
    CHECK_FALSE(same([](Settings& s) { s.solve.max_sweeps = 1; }));
    CHECK(same([](Settings& s) {
        s.patches.most = 100;
        s.factors.threads = s.solve.threads = 3;
        s.factors.progress = go_on;
    }));
    CHECK(light_map_key(room.world, {}).scene == detail::scene_hash(room.world));
}

TEST_CASE("map_key: the map of a scene that was changed since is refused") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.map");
    const std::string cannot = "cannot read '" + path + "': it was made ";
    const auto box = [](float x) {
        Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Mirror, Glass>> scene;
        add_cornell_walls(scene);
        const auto matt = scene.add(Lambertian{});
        scene.add(Sphere{.center{x, 0.4f, 0}, .radius = 0.4f}, matt, Rgb{3});
        return World(std::move(scene));
    };
    const auto room = box(0), moved = box(0.01f);
    const std::string other_scene =
        "for another scene, with other shapes, materials or lights; make it again for "
        "this scene.";
    const std::string other_settings = "with other settings; make it again, or use "
                                       "the settings that it was made with.";
    const RadiositySettings large{.patches = {.size = 1}, .factors = {.rays = 4}};
    const auto light = make_radiosity(room, large);
    save_light_map(path, light->map);
    CHECK(refusal(path, light_map_key(room, large)) == "it was read");
    CHECK(refusal(path, light_map_key(moved, large)) == cannot + other_scene);
    CHECK(refusal(path, light_map_key(room, {})) == cannot + other_settings);
    CHECK_NOTHROW((void)LightMapView(room, light->map));
    CHECK_THROWS_WITH_AS((void)LightMapView(moved, light->map),
                         ("The light map was made " + other_scene).c_str(),
                         std::invalid_argument);
}
