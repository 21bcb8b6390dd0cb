/// \file cut_out_test.cpp
/// \brief Holes that no ray and no photon meets, and nothing beside them changed.

#include "ljus/materials/cut_out.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <type_traits>

#include "ljus/accel/instances.hpp"
#include "ljus/geometry/moving.hpp"
#include "ljus/ljus.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/bsdf_checks.hpp"
#include "support/draws.hpp"

using namespace ljus;
using ljus_test::Draws, ljus_test::refusal;

namespace {

using UvChecker = CheckerT<float, UvMap>;
using UvGrid = CutOut<Lambertian, UvChecker>;

/// White, and open in half of its fields: where the sum of column and row is odd.
UvGrid grid(int fields) {
    return {{.albedo = Rgb{1}},
            {.mask{.even = Rgb{1}, .odd = Rgb{0}, .columns = fields, .rows = fields}}};
}

/// The unit square at a height, seen from above.
Quad square(float y) {
    return {{0, y, 1}, {1, 0, 0}, {0, 0, -1}};
}
MeshData two_squares(float low, float high) {
    MeshData data;
    for (const float y : {low, high}) {
        const auto first = static_cast<std::uint32_t>(data.positions.size());
        for (const Vec2 uv : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}) {
            data.positions.push_back({uv.x, y, 1 - uv.y});
            data.uv.push_back(uv);
        }
        data.triangles.push_back({first, first + 1, first + 2});
        data.triangles.push_back({first, first + 2, first + 3});
    }
    return data;
}

/// A ray down onto the middle of a field of `fields` by `fields`.
Ray down_on(int column, int row, int fields) {
    return {.origin{(float(column) + 0.5f) / float(fields), 9,
                    1 - (float(row) + 0.5f) / float(fields)},
            .direction{0, -1, 0}};
}

/// How open it is, as a number.
struct Veil : Lambertian {};
float is_open(const Veil&, const Vec3&, const Vec2&) {
    return 0.5f;
}

} // namespace

TEST_CASE("cut-out: rays go through the holes of each shape, and meet what is behind") {
    const auto hits = [](const auto& world, int fields, float solid, float open) {
        for (int row = 0; row < fields; ++row)
            for (int column = 0; column < fields; ++column) {
                const Ray ray = down_on(column, row, fields);
                const auto hit = closest_hit(world, ray);
                REQUIRE(hit);
                CHECK(hit->at.t == ((row + column) % 2 == 0 ? solid : open));
            }
    };
    // Over a floor at the height 0: a quad, a moving one, and a mesh of two squares,
    // of which the lower one has the same holes.
    const Lambertian floor;
    hits(World(make_scene(placed(square(4), grid(8)), placed(square(0), floor))), 8, 5,
         9);
    hits(World(make_scene(placed(Moving<Quad>{square(4)}, grid(8)),
                          placed(square(0), floor))),
         8, 5, 9);
    hits(World(make_scene(placed(Mesh(two_squares(3, 4)), grid(8)),
                          placed(square(0), floor))),
         8, 5, 9);
    Scene<Shapes<Instance, Quad>, Materials<UvGrid, Lambertian>> placed_mesh;
    Affine up(1.0f);
    up[3] = {0, 1, 0};
    const auto leaf = placed_mesh.add(Mesh(two_squares(2, 3)));
    placed_mesh.add(Instance(leaf, up), placed_mesh.add(grid(8)));
    placed_mesh.add(square(0), placed_mesh.add(floor));
    hits(World(std::move(placed_mesh)), 8, 5, 9);
    // A mask in place of uv: two walls of one ball.
    const CutOut<Lambertian, Checker> halves{
        {},
        {.mask{
            .map{.edge_u{2, 0, 0}, .edge_v{0, 0, 2}}, .even = Rgb{1}, .odd = Rgb{0}}}};
    const World ball(make_scene(placed(Sphere{.center{0, 0, 0}, .radius = 1}, halves)));
    const auto along_z = [&](float x, float y) {
        return closest_hit(ball, Ray{.origin{x, y, 5}, .direction{0, 0, -1}});
    };
    // The near wall, z > 0, is open for x < 0; the far one for x > 0.
    CHECK(along_z(0.1f, 0.5f)->at.t < 5);
    CHECK(along_z(-0.1f, 0.5f)->at.t > 5);
}

TEST_CASE("cut-out: the tree, the loop and the shadow rays agree") {
    Scene<Shapes<Quad, Mesh, Sphere>,
          Materials<UvGrid, CutOut<Lambertian, GlobeChecker>, Lambertian>>
        scene;
    Draws draws;
    const auto point = [&](float far) {
        return Vec3{draws.between(-far, far), draws.between(-far, far),
                    draws.between(-far, far)};
    };
    const auto open = scene.add(grid(6));
    const auto ball = scene.add(CutOut<Lambertian, GlobeChecker>{
        {}, {.mask{.even = Rgb{1}, .odd = Rgb{0.25f}, .columns = 8, .rows = 6}}});
    const auto solid = scene.add(Lambertian{});
    for (int i = 0; i < 12; ++i) {
        scene.add(Quad{point(2), point(1), point(1)}, i % 3 == 0 ? solid : open);
        scene.add(Sphere{.center = point(2), .radius = 0.3f}, ball);
    }
    scene.add(Mesh(two_squares(0.2f, -0.3f)), open);
    const World world(std::move(scene));
    int hits = 0, misses = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 from = point(4);
        Ray ray{.origin = from, .direction = point(2) - from, .t_max = 1};
        const auto hit = closest_hit(world, ray), plain = closest_hit_plain(world, ray);
        REQUIRE(hit.has_value() == plain.has_value());
        REQUIRE(occluded(world, ray) == hit.has_value());
        REQUIRE(occluded_plain(world, ray) == hit.has_value());
        (hit ? hits : misses) += 1;
        if (!hit) continue;
        REQUIRE(hit->at.t == plain->at.t);
        REQUIRE(hit->object == plain->object);
    }
    CHECK(hits > 3000);
    CHECK(misses > 3000);
}

TEST_CASE("cut-out: the shadow of a leaf has the area of its alpha") {
    // A disc of pixels, by 64 x 64; a sun in the zenith, a shadow ray for each pixel.
    constexpr int size = 64;
    UvPicture disc{.image = make_image<float>(size, size),
                   .filter = PictureFilter::nearest};
    int solid = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            if (std::hypot(x - 31.5, y - 20.5) < 15) {
                pixel(disc.image, x, y) = Rgb{0.75f};
                ++solid;
            }
    using Leaf = CutOut<Lambertian, UvPicture>;
    const auto shaded = [&](double cutoff) {
        const World world(
            make_scene(placed(square(1), Leaf{{}, {.mask = disc, .cutoff = cutoff}})));
        int count = 0;
        for (int row = 0; row < size; ++row)
            for (int column = 0; column < size; ++column) {
                Ray up = down_on(column, row, size);
                up.origin.y = 0;
                up.direction.y = 1;
                count += occluded(world, up) ? 1 : 0;
            }
        return count;
    };
    CHECK(solid > 600);
    CHECK(shaded(0.5) == solid);
    CHECK(shaded(0.75) == solid); // not below it
    CHECK(shaded(0.76) == 0);
    CHECK(shaded(0) == size * size);
}

TEST_CASE("cut-out: photons through a grid carry its open part") {
    // A sun in the zenith. Half of the grid's 32 x 32 fields are open; what passes
    // lands on the black floor below, the rest on the grid.
    Scene<Shapes<Quad>, Materials<UvGrid, Lambertian>, Lights<SunLight>> scene;
    UvGrid black = grid(32);
    black.base.albedo = Rgb{0};
    scene.add(square(1), scene.add(black));
    scene.add(square(0), scene.add(Lambertian{.albedo = Rgb{0}}));
    scene.add(SunLight{.direction{0, -1, 0}, .irradiance = Rgb{2}});
    const World world(std::move(scene));
    const auto traced = trace_photons(world, MapType::general,
                                      {.photons = 100000, .shadow_photons = false});
    double floor = 0, leaf = 0;
    for (const Photon& photon : traced.photons)
        (photon.position.y > 0.5f ? leaf : floor) += double(photon.flux.x);
    // The sun's disc around the scene is larger than the square: about n = 30000 of the
    // photons arrive, so that the relative deviation is below 0.01 each; 5 of these:
    // 1e-6.
    CHECK(leaf == doctest::Approx(1).epsilon(0.05));
    CHECK(floor == doctest::Approx(1).epsilon(0.05));
    const int behind = int(std::count_if(
        traced.photons.begin(), traced.photons.end(), [](const Photon& photon) {
            const auto field = [](float x) { return int(std::floor(x * 32)); };
            const bool open =
                (field(photon.position.x) + field(1 - photon.position.z)) % 2 != 0;
            return (photon.position.y < 0.5f) != open;
        }));
    CHECK(behind <= 2); // on a border, by rounding
}

TEST_CASE("cut-out: a camera sees through it, and colours stay where they are") {
    const Textured<UvGrid, UvPicture> red{grid(2), {.image = make_image(1, 1, Rgb{1})}};
    static_assert(CutOutMaterial<std::remove_cvref_t<decltype(red)>>);
    static_assert(CutOutMaterial<UvGrid> && !CutOutMaterial<Lambertian>);
    CHECK(is_open(Veil{}, Vec3{0}, Vec2{0}) == 0.5f);
    CHECK_FALSE(CutOutMaterial<Veil>);
    CHECK(material_at(red, Vec3{0}, Vec2{0.2f}).albedo == Rgb{1});
    CHECK(is_open(red, Vec3{0}, Vec2{0.2f, 0.7f}));
    CHECK_FALSE(is_open(red, Vec3{0}, Vec2{0.2f, 0.2f}));
    // Two masks: open where one of them is.
    const CutOut<UvGrid, UvChecker> both{grid(2), {.mask = grid(4).texture.mask}};
    CHECK(is_open(both, Vec3{0}, Vec2{0.2f, 0.7f}));
    CHECK(is_open(both, Vec3{0}, Vec2{0.1f, 0.3f}));
    CHECK_FALSE(is_open(both, Vec3{0}, Vec2{0.1f, 0.1f}));

    // A glowing wall behind the holes of a black grid.
    UvGrid black = grid(2);
    black.base.albedo = Rgb{0};
    const World world(
        make_scene(placed(square(4), black),
                   placed(square(0), Lambertian{.albedo = Rgb{0}}, Rgb{3})));
    const auto camera = look_at({.position{0.5f, 400, 0.5f},
                                 .target{0.5f, 0, 0.5f},
                                 .up{0, 0, -1},
                                 .vfov_degrees = 0.14f});
    const auto image =
        render(PathTracer(world), camera, {.width = 2, .height = 2, .samples = 4})
            .image;
    CHECK(pixel(image, 0, 0).x == doctest::Approx(3)); // upper left: odd
    CHECK(pixel(image, 1, 1).x == doctest::Approx(3));
    CHECK(pixel(image, 1, 0).x == 0);
    CHECK(pixel(image, 0, 1).x == 0);
}

TEST_CASE("cut-out: a leaf that lies on the floor") {
    // Contact: in the holes the floor is met, which is darker than the leaf, so that
    // the leaf would be met in its place; elsewhere either, at the same distance.
    const Textured<Lambertian, UvChecker> dark{{.albedo = Rgb{0.1f}},
                                               grid(2).texture.mask};
    const World world(
        make_scene(placed(square(0), grid(4)), placed(square(0), dark),
                   placed(Sphere{.center{20, 9, 0}, .radius = 1}, Lambertian{})));
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) {
            const auto hit = closest_hit(world, down_on(column, row, 4));
            REQUIRE(hit);
            CHECK(hit->at.t == 9);
            if ((row + column) % 2 != 0) CHECK(hit->object.index == 1);
        }
}

TEST_CASE("cut-out: lamps with holes and wrong cutoffs are refused") {
    Scene<Shapes<Quad>, Materials<UvGrid>> scene;
    const auto open = scene.add(grid(2));
    CHECK_THROWS_WITH(scene.add(square(0), open, Rgb{1}),
                      "the radiance of a cut-out is (1, 1, 1); it must be black: a "
                      "lamp shines from all of its area, holes too.");
    UvGrid wrong = grid(2);
    wrong.texture.cutoff = -0.5;
    CHECK(refusal(wrong) == "holes.cutoff is -0.5; it must be finite and at least 0.");
    wrong.texture.cutoff = NAN;
    CHECK(refusal(wrong).find("holes.cutoff is") == 0);
    wrong = grid(3);
    CHECK(refusal(wrong).find("checker.columns is 3") == 0);
}
