/// \file texture_test.cpp
/// \brief The right colour in the right place, and nothing else changed by it.

#include "ljus/image/texture.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "ljus/io/png.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/glossy.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/materials/textured.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scene/make_scene.hpp"
#include "scratch_folder.hpp"
#include "support/bsdf_checks.hpp"
#include "support/jpeg_segment.hpp"
#include "support/little_memory.hpp"
#include "support/refusal.hpp"

#if __has_include(<stb/stb_image.h>)
#include "ljus/io/load_image.hpp"
#endif

using namespace ljus;
using ljus_test::Draws, ljus_test::refusal;

namespace {

/// Four pixels: red and green above, blue and white below.
Image four() {
    Image image = make_image<float>(2, 2);
    pixel(image, 0, 0) = {1, 0, 0};
    pixel(image, 1, 0) = {0, 1, 0};
    pixel(image, 0, 1) = {0, 0, 1};
    pixel(image, 1, 1) = {1, 1, 1};
    return image;
}

/// A map whose (u, v) are (x, y).
PlaneMap flat() {
    return {.edge_u{1, 0, 0}, .edge_v{0, 1, 0}};
}

} // namespace

TEST_CASE("texture: a chessboard has 64 fields, in turn, and goes on") {
    const Checker board{
        .map = flat(), .even = Rgb{0.75f}, .odd = Rgb{0.25f}, .columns = 8, .rows = 8};
    for (int row = -8; row < 16; ++row)
        for (int column = -8; column < 16; ++column) {
            const Vec3 middle{(float(column) + 0.5f) / 8, (float(row) + 0.5f) / 8, 7};
            const bool even = (row + column) % 2 == 0;
            REQUIRE(color_at(board, middle).x == (even ? 0.75f : 0.25f));
        }
    // Far away it is one of the two colours still.
    for (const float far : {1e9f, -3e30f, 3e38f})
        CHECK(color_at(board, Vec3{far, 0.1f, 0}).x > 0);
}

TEST_CASE("texture: places of a plane and of a globe") {
    const PlaneMapT<double> plane{.origin{1, 2, 3}, .edge_u{0, 2, 0}, .edge_v{0, 0, 4}};
    const auto uv = map_coordinates(plane, Vec3T<double>{9, 3, 4});
    CHECK(uv.x == 0.5);
    CHECK(uv.y == 0.25);
    const GlobeMapT<double> globe{.center{1, 1, 1}};
    const auto at = [&](double x, double y, double z) {
        return map_coordinates(globe, Vec3T<double>{1 + x, 1 + y, 1 + z});
    };
    CHECK(at(1, 0, 0).x == 0);
    CHECK(at(0, 0, -1).x == doctest::Approx(0.25));
    CHECK(at(-1, 0, 0).x == doctest::Approx(0.5));
    CHECK(at(0, 0, 1).x == doctest::Approx(0.75));
    CHECK(at(0, 2, 0).y == doctest::Approx(1));
    CHECK(at(0, -2, 0).y == doctest::Approx(0));
    CHECK(at(1, 1, 0).y == doctest::Approx(0.75));
    CHECK(at(0, 0, 0).y == doctest::Approx(0.5));
}

TEST_CASE("texture: an image stands upright, is smooth between pixels, and repeats") {
    const PictureTexture texture{.image = four(), .map = flat()};
    const auto at = [&](float u, float v) { return color_at(texture, Vec3{u, v, 0}); };
    CHECK(at(0.25f, 0.75f) == Rgb{1, 0, 0});
    CHECK(at(0.75f, 0.75f) == Rgb{0, 1, 0});
    CHECK(at(0.25f, 0.25f) == Rgb{0, 0, 1});
    CHECK(at(0.75f, 0.25f) == Rgb{1, 1, 1});
    CHECK(at(0.5f, 0.5f) == Rgb{0.5f});
    CHECK(at(0.5f, 0.75f) == Rgb{0.5f, 0.5f, 0});
    CHECK(at(3.25f, -1.25f) == Rgb{1, 0, 0});
    CHECK(at(0.0f, 0.75f) == at(1.0f, 0.75f));
    // At its borders it goes over into its other side, in both directions.
    CHECK(at(0.0f, 0.75f) == Rgb{0.5f, 0.5f, 0});
    CHECK(at(0.25f, 0.0f) == Rgb{0.5f, 0, 0.5f});
    CHECK(at(0.25f, 1.0f) == Rgb{0.5f, 0, 0.5f});
    CHECK(at(0.25f, 0.125f) == Rgb{0.25f, 0, 0.75f});
    CHECK(at(0.25f, 0.875f) == Rgb{0.75f, 0, 0.25f});
    Draws draws;
    for (int i = 0; i < 20000; ++i) {
        const float size = std::pow(10.0f, draws.between(-30.0f, 30.0f));
        const Rgb c = at(size * draws.between(-1.0f, 1.0f), draws.between(-3.0f, 3.0f));
        REQUIRE(max_component(c) <= 1 + 1e-6f);
        REQUIRE(c.x >= 0);
    }
    CHECK(is_finite(at(NAN, INFINITY)));
}

TEST_CASE("texture: rows and columns of a picture that is no square") {
    for (const int width : {2, 5}) {
        const int height = 7 - width;
        PictureTexture texture{.image = make_image<float>(width, height),
                               .map = flat()};
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                pixel(texture.image, x, y) = {float(x), float(y), 0};
        const auto at = [&](float x, float y) { // in pixels from the upper left
            return color_at(texture, Vec3{x / float(width), 1 - y / float(height), 0});
        };
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                CHECK(glm::distance(at(float(x) + 0.5f, float(y) + 0.5f),
                                    Rgb{float(x), float(y), 0}) < 1e-5f);
        // At a border the mean of both sides.
        const float last_x = float(width - 1), last_y = float(height - 1);
        CHECK(glm::distance(at(0, 0.5f), Rgb{last_x / 2, 0, 0}) < 1e-5f);
        CHECK(glm::distance(at(0.5f, 0), Rgb{0, last_y / 2, 0}) < 1e-5f);
    }
}

TEST_CASE(
    "texture: the hook gives each material its colour, and plain ones themselves") {
    const Checker board{.map = flat(), .even = Rgb{0.5f}, .odd = Rgb{1}};
    const Vec3 here{0.25f, 0.25f, 0}, there{0.75f, 0.25f, 0};
    const Textured<Lambertian, Checker> matt{{.albedo = Rgb{0.8f}}, board};
    CHECK(material_at(matt, here, Vec2{0}).albedo == Rgb{0.4f});
    CHECK(material_at(matt, there, Vec2{0}).albedo == Rgb{0.8f});
    const Textured<Mirror, Checker> mirror{{}, board};
    CHECK(material_at(mirror, here, Vec2{0}).reflectance == Rgb{0.5f});
    CHECK(lobes(mirror) == Lobes::specular);
    const Textured<Glossy, Checker> gloss{{.reflectance = Rgb{1}}, board};
    CHECK(material_at(gloss, here, Vec2{0}).reflectance == Rgb{0.5f});
    const Textured<ThinGlass, Checker> pane{{}, board};
    CHECK(material_at(pane, here, Vec2{0}).tint == Rgb{0.5f});
    const Lambertian plain;
    CHECK(&material_at(plain, here, Vec2{0}) == &plain); // not even copied
}

TEST_CASE("texture: in a white furnace a textured floor emits as its fields do") {
    // Open to a sky of radiance 1: what comes back is the albedo of the place.
    const World scene(make_scene(
        placed(Sphere{.radius = 50}, Lambertian{.albedo = Rgb{0}}, Rgb{1}, true),
        placed(Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}},
               Textured<Lambertian, PictureTexture>{
                   {.albedo = Rgb{1}},
                   {.image = four(),
                    .map{.origin{-1, -1, 0}, .edge_u{2, 0, 0}, .edge_v{0, 2, 0}}}})));
    const auto camera = look_at(
        {.position{0, 0, 5}, .target{0, 0, 0}, .up{0, 1, 0}, .vfov_degrees = 15});
    const auto image = render(PathTracer(scene), camera,
                              {.width = 32, .height = 32, .samples = 64, .threads = 1})
                           .image;
    // Columns and rows 8 and 24 see the middles of the pixels, nearly.
    const auto near = [&](int x, int y, const Rgb& right) {
        const Rgb c = pixel(image, x, y);
        for (int k = 0; k < 3; ++k)
            CHECK(c[k] == doctest::Approx(right[k]).epsilon(0.25));
    };
    near(6, 6, {1, 0, 0});
    near(25, 6, {0, 1, 0});
    near(6, 25, {0, 0, 1});
    near(25, 25, {1, 1, 1});
}

TEST_CASE(
    "texture: fields, edges, colours and pixels out of range are refused by name") {
    const auto matt = [](const auto& texture) {
        return refusal(
            Textured<Lambertian, std::remove_cvref_t<decltype(texture)>>{{}, texture});
    };
    CHECK(matt(Checker{}).empty());
    CHECK(matt(GlobeChecker{}).empty());
    CHECK(matt(Checker{.columns = 3}).find("checker.columns is 3") == 0);
    CHECK(matt(Checker{.rows = 0}).find("checker.rows is 0") == 0);
    for (const int fine : {2, 4, 1000000}) {
        CHECK(matt(Checker{.columns = fine}).empty());
        CHECK(matt(Checker{.rows = fine}).empty());
    }
    for (const int wrong : {-2, 0, 1, 5, 1000002}) {
        const std::string is =
            " is " + std::to_string(wrong) + "; it must be even, from 2 to 1000000.";
        CHECK(matt(Checker{.columns = wrong}) == "checker.columns" + is);
        CHECK(matt(Checker{.rows = wrong}) == "checker.rows" + is);
    }
    CHECK(matt(Checker{.even{1.5f, 0, 0}}).find("checker.even") == 0);
    CHECK(matt(Checker{.odd{NAN, 0, 0}}).find("checker.odd") == 0);
    // The square of 1e-20 has lost digits, that of 1e-30 all; that of 1e20 is too
    // large.
    for (const float length : {0.0f, 1e-30f, 1e-20f, 1e20f, INFINITY, NAN}) {
        CAPTURE(length);
        const Vec3 edge{0, 0, length};
        CHECK(matt(Checker{.map{.edge_u = edge}}).find("plane_map.edge_u is (0, 0, ") ==
              0);
        CHECK(matt(Checker{.map{.edge_v = edge}}).find("plane_map.edge_v is (0, 0, ") ==
              0);
    }
    CHECK(matt(PictureTexture{.image = four()}).empty());
    CHECK(matt(PictureTexture{}).find("The image's size is 0 x 0") == 0);
    Image bright = four();
    pixel(bright, 1, 0).y = 2;
    CHECK(matt(PictureTexture{.image = bright})
              .find("picture_texture.image, pixel (1, 0)") == 0);
    const Textured<Lambertian, Checker> base{{.albedo = Rgb{1.5f}}, {}};
    CHECK(refusal(base).find("lambertian.albedo") == 0);
}

TEST_CASE("texture: a UvMap looks up by the shape's own coordinates, and repeats") {
    const UvPicture texture{.image = four(), .map{.scale{2, 0.5f}}};
    const auto at = [&](float u, float v) {
        return color_at(texture, Vec3{7, 8, 9}, Vec2{u, v});
    };
    // u from 0 to 1 shows the image twice, v from 0 to 1 its lower half.
    CHECK(at(0.125f, 0.5f) == Rgb{0, 0, 1});
    CHECK(at(0.375f, 0.5f) == Rgb{1, 1, 1});
    CHECK(at(0.625f, 0.5f) == Rgb{0, 0, 1});
    CHECK(at(0.125f, 1.5f) == Rgb{1, 0, 0});
    CHECK(at(-0.125f, 3.5f) == Rgb{0, 1, 0});
    const Textured<Lambertian, UvPicture> still{{},
                                                {.image = four(), .map{.scale{0, 1}}}};
    CHECK(refusal(still).find("uv_map.scale is 0; it must be finite and not 0.") == 0);
    const Textured<Lambertian, UvPicture> flatter{
        {}, {.image = four(), .map{.scale{1, INFINITY}}}};
    CHECK(refusal(flatter) == "uv_map.scale is infinity; it must be finite and not 0.");
    const CheckerT<float, UvMap> board{.even = Rgb{1}, .odd = Rgb{0}};
    CHECK(color_at(board, Vec3{9}, Vec2{0.25f, 0.25f}) == Rgb{1});
    CHECK(color_at(board, Vec3{9}, Vec2{0.75f, 0.25f}) == Rgb{0});

    // Who looks up by uv says so, and gets it; for all others it is not worked out.
    using Wallpaper = Textured<Lambertian, UvPicture>;
    static_assert(UsesUv<Wallpaper> && !UsesUv<Lambertian>);
    static_assert(!UsesUv<Textured<Lambertian, PictureTexture>>);
    static_assert(UsesUv<Textured<Wallpaper, PictureTexture>>); // the base does
    const Wallpaper paper{{.albedo = Rgb{0.5f}}, {.image = four()}};
    CHECK(material_at(paper, Vec3{9}, Vec2{0.75f, 0.75f}).albedo == Rgb{0, 0.5f, 0});
    const Ray ray{.origin{0.75f, 0.75f, 1}, .direction{0, 0, -1}};
    const Quad wall{.corner{0, 0, 0}, .edge_u{1, 0, 0}, .edge_v{0, 1, 0}};
    const auto uv_of = [&](const auto& material) {
        const World scene(make_scene(placed(wall, material)));
        return vertex_at(scene, ray, *closest_hit(scene, ray)).uv;
    };
    CHECK(uv_of(paper) == Vec2{0.75f, 0.75f});
    CHECK(uv_of(Lambertian{}) == Vec2{0});
}

TEST_CASE("texture: a picture ends at its border, and each pixel has an edge") {
    UvPicture texture{.image = four(), .wrap = PictureWrap::clamp};
    const auto at = [&](float u, float v) {
        return color_at(texture, Vec3{0}, Vec2{u, v});
    };
    // Clamped: beyond the middles of the outer pixels their colours go on.
    const Rgb red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1}, white{1};
    for (const float far : {0.0f, -1e-3f, -1.0f, -1e6f, -3e38f}) {
        CHECK(at(far, 0.75f) == red);
        CHECK(at(0.75f, far) == white);
        CHECK(at(1 - far, 0.25f) == white);
        CHECK(at(0.25f, 1 - far) == red);
        CHECK(at(far, far) == blue);
    }
    CHECK(at(0.5f, 0.5f) == Rgb{0.5f});
    CHECK(is_finite(at(NAN, NAN)));
    // The nearest pixel; on an edge between two, the right and the upper one.
    texture.filter = PictureFilter::nearest;
    for (const float u : {0.0f, 0.2f, 0.4999f}) {
        CHECK(at(u, 0) == blue);
        CHECK(at(u, 0.4999f) == blue);
        CHECK(at(u, 0.5f) == red);
        CHECK(at(u, 1) == red);
        CHECK(at(u + 0.5f, 0.2f) == white);
    }
    CHECK(at(7, -7) == white);
    texture.wrap = PictureWrap::repeat;
    CHECK(at(0, 0) == blue);
    CHECK(at(1, 1) == blue);
    CHECK(at(-0.25f, 0.75f) == green);
    // At a million repetitions a float has steps of 1/16.
    CHECK(at(1e6f + 0.25f, -1e6f + 0.75f) == red);
    CHECK(at(-1e6f + 0.75f, 1e6f + 0.25f) == white);
    texture.filter = PictureFilter::bilinear;
    CHECK(at(1e6f + 0.25f, -1e6f + 0.75f) == red);
    CHECK(at(1e6f + 0.5f, 0.25f) == Rgb{0.5f, 0.5f, 1});
    // The four weights, at 1/8 and 3/8 of the way from the middle of one pixel to the
    // next.
    const Rgb mixed = at(0.3125f, 0.5625f);
    const float x = 0.125f, y = 0.375f;
    CHECK(mixed ==
          (1 - y) * ((1 - x) * red + x * green) + y * ((1 - x) * blue + x * white));
}

TEST_CASE("texture: a mirrored picture is one of twice the size that repeats") {
    const Image once = four();
    Image twice = make_image(4, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) // its own tile is the lower left one
            pixel(twice, x, y) = pixel(once, std::min(x, 3 - x), y < 2 ? 1 - y : y - 2);
    for (const PictureFilter filter :
         {PictureFilter::bilinear, PictureFilter::nearest}) {
        const UvPicture mirrored{
            .image = once, .wrap = PictureWrap::mirror, .filter = filter};
        const UvPicture right{
            .image = twice, .map{.scale{0.5f, 0.5f}}, .filter = filter};
        // Steps of 1/16 meet each border, and each middle and edge of a pixel.
        for (int i = -48; i <= 48; ++i)
            for (int j = -48; j <= 48; ++j) {
                const bool edge = i % 8 == 0 || j % 8 == 0; // between two pixels
                if (filter == PictureFilter::nearest && edge) continue;
                const Vec2 uv{float(i) / 16, float(j) / 16};
                CAPTURE(uv);
                CHECK(color_at(mirrored, Vec3{0}, uv) == color_at(right, Vec3{0}, uv));
            }
        for (const float far : {3e38f, -3e38f, INFINITY, NAN})
            CHECK(is_finite(color_at(mirrored, Vec3{0}, Vec2{far, -far})));
        CHECK(color_at(mirrored, Vec3{0}, Vec2{1e6f + 1.25f, 0.75f}) == Rgb{0, 1, 0});
    }
}

TEST_CASE("texture: a UvMap scales, then turns, then displaces") {
    const UvMapT<double> map{.scale{2, -3}, .turn{0.6, 0.8}, .offset{0.25, -1}};
    const auto at = [&](double u, double v) {
        return map_coordinates(map, Vec3T<double>{9}, Vec2T<double>{u, v});
    };
    const auto near = [](const Vec2T<double>& a, const Vec2T<double>& b) {
        return glm::distance(a, b) < 1e-14;
    };
    CHECK(near(at(0, 0), {0.25, -1}));
    CHECK(near(at(1, 0), {0.25 + 1.2, -1 + 1.6}));
    CHECK(near(at(0, 1), {0.25 + 2.4, -1 - 1.8}));
    // A direction in the picture, back on the shape: the scale only mirrors it.
    for (const double angle : {0.0, 0.3, 2.0}) {
        const Vec2T<double> along{std::cos(angle), std::sin(angle)};
        const auto shape = direction_on_shape(map, along);
        CHECK(glm::length(shape) == doctest::Approx(1));
        const auto there = at(shape.x / 2, shape.y / 3) - at(0, 0);
        CHECK(near(there, along));
    }
    const auto why = [](const UvMap& odd) {
        return refusal(Textured<Lambertian, UvPicture>{{}, {four(), odd}});
    };
    CHECK(why({.turn{1, 1}}) ==
          "the squared length of uv_map.turn is 2; it must be 1, because it is the "
          "cosine and the sine of an angle.");
    CHECK(why({.offset{0, NAN}}).find("uv_map.offset is") == 0);
    CHECK(why({.turn{0.6f, -0.8f}}).empty());
}

TEST_CASE("texture: what its colour is of each material, and what the base says") {
    const Rgb half{0.5f, 0.25f, 1};
    CHECK(detail::colored(Lambertian{.albedo = Rgb{0.5f}}, half).albedo ==
          Rgb{0.25f, 0.125f, 0.5f});
    CHECK(detail::colored(Mirror{.reflectance = Rgb{0.5f}}, half).reflectance ==
          Rgb{0.25f, 0.125f, 0.5f});
    CHECK(detail::colored(ThinGlass{.tint = Rgb{0.5f}}, half).tint ==
          Rgb{0.25f, 0.125f, 0.5f});
    CHECK(detail::colored(Mixture{.color = Rgb{0.5f}}, half).color ==
          Rgb{0.25f, 0.125f, 0.5f});
    // In no place in particular it is its base.
    const Glossy gloss{.reflectance{0.9f, 0.5f, 0.1f}, .roughness = 0.3f};
    const Textured<Glossy, Checker> board{gloss, {.even = Rgb{0}, .odd = Rgb{0}}};
    const Vec3 wo = glm::normalize(Vec3{0.3f, 0.1f, 0.8f});
    const Vec3 wi = glm::normalize(Vec3{-0.1f, 0.3f, 0.5f}), u{0.3f, 0.6f, 0.9f};
    CHECK(lobes(board) == lobes(gloss));
    CHECK(evaluate(board, wo, wi) == evaluate(gloss, wo, wi));
    CHECK(pdf(board, wo, wi) == pdf(gloss, wo, wi));
    CHECK(pdf(board, wo, wi, Lobes::diffuse) == 0);
    const auto next = sample(board, wo, u, Transport::radiance);
    const auto right = sample(gloss, wo, u, Transport::radiance);
    REQUIRE((next && right));
    CHECK(next->wi == right->wi);
    CHECK(next->weight == right->weight);
    CHECK_FALSE(sample(board, wo, u, Transport::radiance, Lobes::specular));
    const Mixture clear{.color = Rgb{0.5f},
                        .transparency = 1,
                        .emissivity = 4,
                        .absorption = Rgb{1, 2, 3}};
    const Textured<Mixture, Checker> mixed{clear, {}};
    CHECK(absorption(mixed) == Rgb{1, 2, 3});
    CHECK(emission(mixed) == Rgb{2});
    for (const Transport way : {Transport::radiance, Transport::flux}) {
        const auto through = sample(mixed, wo, u, way);
        REQUIRE(through);
        CHECK(through->eta_scale == sample(clear, wo, u, way)->eta_scale);
    }
    // A pane lets through its own colour, place by place.
    const ThinGlass pane{.index = 1.5f};
    const Textured<ThinGlass, Checker> window{
        pane, {.map = flat(), .even{1, 0.5f, 0.25f}, .odd = Rgb{0}}};
    const auto passed = pass_through(window, Vec3{0.25f, 0.25f, 7}, wo);
    CHECK(passed == pass_through(ThinGlass{1.5f, Rgb{1, 0.5f, 0.25f}}, Vec3{0}, wo));
    CHECK(pass_through(window, Vec3{0.75f, 0.25f, 7}, wo) ==
          pass_through(ThinGlass{1.5f, Rgb{0}}, Vec3{0}, wo));
}

TEST_CASE("texture: each shape has its own coordinates") {
    const auto of = [](const auto& shape, const Ray& ray) {
        const auto hit = as_hit(*intersect(ray, shape));
        return texture_coordinates(shape, hit, surface_point(shape, ray, hit));
    };
    const Ray down{.origin{1.5f, 5, 2.5f}, .direction{0, -1, 0}};
    CHECK(of(Quad{.corner{1, 0, 2}, .edge_u{2, 0, 0}, .edge_v{0, 0, 4}}, down) ==
          Vec2{0.25f, 0.125f});
    CHECK(of(Triangle{.v1{1, 0, 2}, .v2{3, 0, 2}, .v3{1, 0, 6}}, down) ==
          Vec2{0.25f, 0.125f});
    // A sphere has a globe's, far from the origin too.
    for (const float far : {0.0f, 1e6f}) {
        const Vec3 c{far, 0, 0};
        const Sphere ball{.center = c, .radius = 2};
        const auto from = [&](const Vec3& side) {
            return of(ball, Ray{.origin = c + 3.0f * side, .direction = -side});
        };
        CHECK(from({1, 0, 0}).x == doctest::Approx(0));
        CHECK(from({0, 0, -1}).x == doctest::Approx(0.25));
        CHECK(from({-1, 0, 0}).x == doctest::Approx(0.5));
        CHECK(from({0, 1, 0}).y == doctest::Approx(1));
        CHECK(from({0, 0, 1}).y == doctest::Approx(0.5));
    }
    const Moving<Quad> moving{.shape{.edge_u{1, 0, 0}, .edge_v{0, 1, 0}},
                              .displacement{5, 0, 0}};
    CHECK(of(moving, Ray{.origin{0.25f, 0.5f, 1}, .direction{0, 0, -1}}) ==
          Vec2{0.25f, 0.5f});
    // Of a ball that moves they are the globe's, wherever it is.
    const Moving<Sphere> ball{.shape{.radius = 2}, .displacement{8, 0, 0}};
    const Vec2 at = of(ball, Ray{.origin{4, 0, -9}, .direction{0, 0, 1}, .time = 0.5f});
    CHECK(at.x == doctest::Approx(0.25));
    CHECK(at.y == doctest::Approx(0.5));
}

#if __has_include(<stb/stb_image.h>)
namespace {

/// Why a file is not decoded; empty if it is.
std::string trouble_with(const Bytes& file,
                         PictureContent content = PictureContent::colors) {
    return refusal<std::runtime_error>(
        [&] { (void)decode_image(file, "a", 0, content); });
}

void add_big(Bytes& to, std::uint32_t value, int bytes) {
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
        to.push_back(static_cast<unsigned char>(value >> shift & 255u));
}
void add_text(Bytes& to, std::string_view text) {
    to.insert(to.end(), text.begin(), text.end());
}

Bytes curve_of_gamma(double gamma) {
    Bytes curve;
    add_text(curve, {"curv\0\0\0\0\0\0\0\1", 12});
    add_big(curve, std::uint32_t(std::lround(gamma * 256)), 2);
    return curve;
}
Bytes curve_of_table(double (*decode)(double)) {
    Bytes curve;
    add_text(curve, {"curv\0\0\0\0\0\0\4\0", 12});
    for (int i = 0; i < 1024; ++i)
        add_big(curve, std::uint32_t(65535 * decode(i / 1023.0)), 2);
    return curve;
}
Bytes curve_of_numbers(std::uint32_t kind, const std::vector<double>& numbers) {
    Bytes curve;
    add_text(curve, {"para\0\0\0\0", 8});
    add_big(curve, kind << 16, 4);
    for (const double x : numbers)
        add_big(curve, std::uint32_t(std::lround(x * 65536)), 4);
    return curve;
}

using Columns = std::array<double, 9>; // X, Y, Z of red, of green, of blue
constexpr Columns of_srgb{0.4360, 0.2225, 0.0139, 0.3851, 0.7169,
                          0.0971, 0.1431, 0.0606, 0.7139};
constexpr Columns of_p3{0.5151, 0.2412, -0.0011, 0.2920, 0.6922,
                        0.0419, 0.1571, 0.0666,  0.7841};
constexpr Columns of_adobe{0.6097, 0.3111, 0.0195, 0.2053, 0.6257,
                           0.0609, 0.1492, 0.0632, 0.7446};

// With its name in UTF-16, as profiles of version 4 have it, or in ASCII.
Bytes profile_of(std::string_view name, bool wide, const Columns& columns,
                 const Bytes& curve, std::string_view space = "RGB ") {
    std::vector<std::pair<std::string, Bytes>> tags;
    Bytes said;
    if (wide) {
        add_text(said, {"mluc\0\0\0\0\0\0\0\1\0\0\0\x0c"
                        "enUS",
                        20});
        add_big(said, std::uint32_t(2 * name.size()), 4);
        add_big(said, 28, 4);
        for (const char c : name) add_big(said, static_cast<unsigned char>(c), 2);
    } else {
        add_text(said, {"desc\0\0\0\0", 8});
        add_big(said, std::uint32_t(name.size() + 1), 4);
        add_text(said, name);
        said.push_back(0);
    }
    tags.emplace_back("desc", said);
    if (space == "GRAY") tags.emplace_back("kTRC", curve);
    for (std::size_t k = 0; k < 3 && space == "RGB " && !curve.empty(); ++k) {
        Bytes column;
        add_text(column, {"XYZ \0\0\0\0", 8});
        for (std::size_t i = 0; i < 3; ++i)
            add_big(column, std::uint32_t(std::lround(columns[3 * k + i] * 65536)), 4);
        tags.emplace_back(std::string(1, "rgb"[k]) + "XYZ", column);
        tags.emplace_back(std::string(1, "rgb"[k]) + "TRC", curve);
    }
    Bytes profile(16), data;
    add_text(profile, space);
    add_text(profile, "XYZ ");
    profile.resize(36);
    add_text(profile, "acsp");
    profile.resize(128);
    add_big(profile, std::uint32_t(tags.size()), 4);
    for (const auto& [tag, content] : tags) {
        add_text(profile, tag);
        add_big(profile, std::uint32_t(132 + 12 * tags.size() + data.size()), 4);
        add_big(profile, std::uint32_t(content.size()), 4);
        data.insert(data.end(), content.begin(), content.end());
    }
    profile.insert(profile.end(), data.begin(), data.end());
    return profile;
}

// Behind the head of a PNG file, which ends at byte 33.
Bytes png_with(Bytes file, std::string_view name, const Bytes& content) {
    Bytes chunk;
    add_big(chunk, std::uint32_t(content.size()), 4);
    add_text(chunk, name);
    chunk.insert(chunk.end(), content.begin(), content.end());
    add_big(chunk, detail::png_sum(chunk, 4, chunk.size()), 4);
    file.insert(file.begin() + 33, chunk.begin(), chunk.end());
    return file;
}

// In one block of zlib that is not packed.
Bytes png_with_profile(const Bytes& file, const Bytes& profile) {
    Bytes content;
    add_text(content, {"a name\0\0\x78\1\1", 11});
    for (const unsigned flip : {0u, 0xffffu}) {
        content.push_back(static_cast<unsigned char>((profile.size() ^ flip) & 255u));
        content.push_back(static_cast<unsigned char>((profile.size() ^ flip) >> 8));
    }
    content.insert(content.end(), profile.begin(), profile.end());
    content.resize(content.size() + 4); // a sum that nobody reads
    return png_with(file, "iCCP", content);
}

// Behind the first mark of a JPEG file.
Bytes jpeg_with(Bytes file, unsigned kind, std::string_view head,
                const Bytes& content) {
    Bytes segment{0xff, static_cast<unsigned char>(kind)};
    add_big(segment, std::uint32_t(2 + head.size() + content.size()), 2);
    add_text(segment, head);
    segment.insert(segment.end(), content.begin(), content.end());
    file.insert(file.begin() + 2, segment.begin(), segment.end());
    return file;
}

} // namespace

TEST_CASE("texture: what is saved as PNG is loaded again; what is not is named") {
    const ScratchFolder folder;
    const std::string path = folder.file("four.png");
    save_png(four(), path);
    CHECK(load_image(path).pixels == four().pixels);
    Image grey = make_image<float>(3, 1, Rgb{0.2f});
    const Image back = decode_image(encode_png(grey), "grey.png");
    CHECK(back.width == 3);
    CHECK(back.pixels[1].x == doctest::Approx(0.2).epsilon(0.01));

    CHECK(refusal<std::runtime_error>(
              [&] { (void)load_image(folder.file("none.png")); }) ==
          "cannot read '" + folder.file("none.png") + "': No such file or directory.");
    Bytes bytes = encode_png(four());
    bytes.resize(bytes.size() / 2);
    CHECK(trouble_with(bytes).starts_with("a is damaged: "));
    // Of a bitmap, impossible sizes: 0 x 0 and 2^30 x 2^30. It packs nothing: one of
    // 100 x 100 pixels without them is cut short.
    const auto bitmap = [](int side, int high) {
        Bytes file{'B', 'M', 58, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40};
        file.resize(54 + 4);
        file[18] = file[22] = static_cast<unsigned char>(side);
        file[21] = file[25] = static_cast<unsigned char>(high);
        file[26] = 1;
        file[28] = 24;
        return file;
    };
    for (const int high : {0x00, 0x40})
        CHECK(refusal<std::runtime_error>([&] {
                  (void)decode_image(bitmap(0, high), "b\n.bmp");
              }).starts_with("b?.bmp "));
    CHECK(trouble_with(bitmap(100, 0)) ==
          "a is damaged: it ends in the middle of its pixels.");
    CHECK(trouble_with({}).starts_with("a is not a picture that can be read: "));
}

TEST_CASE("texture: a PNG file of another kind, and one of another gamma") {
    const std::string apple = LJUS_TEST_INPUTS "/cgbi_red.png";
    CHECK(refusal<std::runtime_error>([&] { (void)load_image(apple); }) ==
          apple + " is a PNG file of Apple's own kind (CgBI), which has red and "
                  "blue exchanged; save it as plain PNG.");
    const auto with = [](const std::string& name, std::uint32_t value, bool as_number) {
        Bytes content;
        add_big(content, value, as_number ? 4 : 1);
        return png_with(encode_png(make_image<float>(2, 1, Rgb{0.5f})), name, content);
    };
    // sRGB of 0.5 is byte 188.
    const auto shown = [](const Bytes& file) {
        return double(decode_image(file, "a").pixels[1].y);
    };
    CHECK(shown(with("gAMA", 100000, true)) == doctest::Approx(188 / 255.0));
    CHECK(shown(with("gAMA", 50000, true)) ==
          doctest::Approx(188 / 255.0 * (188 / 255.0)));
    const double srgb = shown(with("teXt", 0, true));
    CHECK(srgb == doctest::Approx(0.5).epsilon(0.01));
    CHECK(shown(with("gAMA", 45455, true)) == srgb);
    CHECK(shown(with("sRGB", 0, false)) == srgb);
    CHECK(shown(with("cICP", 0x010d0001, true)) == srgb);
    // Rec. 2020 by PQ, an unknown curve or matrix, and bytes from 16 to 235.
    for (const std::uint32_t other :
         {0x09100001u, 0x01010001u, 0x010d0101u, 0x010d0000u})
        CHECK_THROWS_WITH((void)shown(with("cICP", other, true)),
                          "a has colours of a kind that is not read, as its cICP chunk "
                          "says; save it as sRGB.");
}

TEST_CASE("texture: colours of other profiles become linear sRGB, or are refused") {
    const auto other = [](const std::string& what) {
        return "a has colours of a kind that is not read, as " + what +
               " says; save it as sRGB.";
    };
    const auto bytes = [](int r, int g, int b) {
        return Rgb(RgbT<double>{srgb_decode(r / 255.0), srgb_decode(g / 255.0),
                                srgb_decode(b / 255.0)});
    };
    Image two = make_image<float>(2, 1, bytes(200, 100, 50));
    two.pixels[1] = bytes(0, 255, 0);
    const Bytes png = encode_png(two);
    const Bytes jpeg = load_file(LJUS_TEST_INPUTS "/turned_padded.jpg", 1 << 20);
    const Bytes jpeg_as_png = encode_png(decode_image(jpeg, "a"));
    const auto is = [](const Bytes& file, const Rgb& color) {
        const Image read = decode_image(file, "a");
        const float error = max_component(glm::abs(read.pixels[0] - color));
        CHECK_MESSAGE(error < 2e-4, read.pixels[0].x, " ", read.pixels[0].y, " ",
                      read.pixels[0].z);
        CHECK(read.pixels[1].y <= 1);
        CHECK(read.pixels[1].x >= 0);
    };
    const Bytes gamma = curve_of_gamma(2.2), table = curve_of_table(srgb_decode);
    const Bytes numbers =
        curve_of_numbers(3, {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045});
    const auto p3_by = [](std::uint32_t kind, const std::vector<double>& of_curve) {
        return profile_of("Display P3", true, of_p3, curve_of_numbers(kind, of_curve));
    };

    // What Little CMS 2.14 makes of the bytes 200, 100, 50 (relative colorimetric, into
    // linear sRGB); or why they are not read.
    struct Row {
        Bytes profile;
        Rgb color;
        std::string why = "";
    };
    Bytes cut = profile_of("cut", true, of_p3, table);
    cut.resize(cut.size() - 1000);
    const std::array rows{
        Row{profile_of("sRGB IEC61966-2.1", false, of_srgb, table),
            {0.57750f, 0.12748f, 0.03188f}},
        Row{profile_of("sRGB", true, of_srgb, numbers), {0.57750f, 0.12748f, 0.03188f}},
        Row{profile_of("c2", false, of_srgb, gamma), {0.58600f, 0.12766f, 0.02778f}},
        // Of tables alone.
        Row{profile_of("sRGB v4 ICC preference", true, of_srgb, {}),
            {0.57750f, 0.12748f, 0.03188f}},
        Row{profile_of("Wide", true, of_srgb, {}), {}, " 'Wide'"},
        Row{profile_of("Gray Gamma 2.2", true, {}, gamma, "GRAY"),
            {0.58608f, 0.12762f, 0.02779f}},
        Row{profile_of("Dot Gain 20%", true, {}, curve_of_gamma(1.75), "GRAY"),
            {0.65367f, 0.19434f, 0.05778f}},
        Row{profile_of("Display P3", true, of_p3, numbers),
            {0.67882f, 0.10852f, 0.01363f}},
        Row{p3_by(0, {1.8}), {0.74931f, 0.16610f, 0.03119f}},
        Row{p3_by(1, {2.2, 0.9, 0.1}), {0.72252f, 0.15632f, 0.03889f}},
        Row{p3_by(1, {2.2, 1.25, -0.25}), {0.60390f, 0.02414f, 0.0f}}, // -0.01328
        Row{p3_by(2, {2.2, 0.8, 0.1, 0.05}), {0.62597f, 0.17863f, 0.08415f}},
        Row{p3_by(4, {2.0, 0.8, 0.1, 0.2, 0.2, 0.1, 0.05}),
            {0.70971f, 0.25611f, 0.06427f}},
        Row{p3_by(5, {2.2}), {}, " 'Display P3'"},
        Row{profile_of("Adobe RGB (1998)", false, of_adobe, curve_of_gamma(2.199)),
            {0.76865f, 0.12763f, 0.02354f}},
        Row{profile_of("linear sRGB", true, of_srgb, curve_of_gamma(1)),
            {0.78422f, 0.39220f, 0.19607f}},
        Row{profile_of("black", true, {}, gamma), {}, " 'black'"},
        Row{profile_of("SWOP", false, {}, {}, "CMYK"), {}, " 'SWOP'"},
        Row{profile_of("a", false, {}, {}, "Lab "), {}, " 'a'"},
        Row{cut, {}, " 'cut'"},
        Row{Bytes(200), {}, ""},
    };
    for (const Row& row : rows) {
        const bool refused = row.color == Rgb{};
        const std::string why = refused ? other("its colour profile" + row.why) : "";
        CHECK(trouble_with(png_with_profile(png, row.profile)) == why);
        // A JPEG file has it in pieces, in any order.
        const auto half = row.profile.begin() + 100;
        Bytes file = jpeg_with(jpeg, 0xe2, {"ICC_PROFILE\0\1\2", 14},
                               Bytes(row.profile.begin(), half));
        file = jpeg_with(file, 0xe2, {"ICC_PROFILE\0\2\2", 14},
                         Bytes(half, row.profile.end()));
        CHECK(trouble_with(file) == why);
        // What is no colour is read as it is.
        CHECK(decode_image(file, "a", 0, PictureContent::numbers).pixels ==
              decode_image(jpeg, "a", 0, PictureContent::numbers).pixels);
        if (refused) continue;
        is(png_with_profile(png, row.profile), row.color);
        CHECK(decode_image(file, "a").pixels ==
              decode_image(png_with_profile(jpeg_as_png, row.profile), "a").pixels);
    }
    // White stays white, and a green that sRGB does not have is limited.
    CHECK(decode_image(png_with_profile(png, rows[7].profile), "a").pixels[1] ==
          Rgb{0, 1, 0});
    // Not packed as it should be.
    CHECK(trouble_with(png_with(png, "iCCP", {'a', 0, 0, 1, 2, 3})) ==
          other("its colour profile"));
    CHECK(trouble_with(png_with(png, "iCCP", {'a', 'b'})) ==
          other("its colour profile"));

    // Primaries by themselves, behind those of white; of two chunks, sRGB counts. And
    // by number: Rec. 2020 with the curve of sRGB, Display P3 with that and linear.
    const auto numbers_of = [](std::initializer_list<std::uint32_t> all) {
        Bytes content;
        for (const std::uint32_t x : all) add_big(content, x, 4);
        return content;
    };
    const Bytes those =
        numbers_of({31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000});
    const Bytes adobe =
        numbers_of({31270, 32900, 64000, 33000, 21000, 71000, 15000, 6000});
    const Bytes with_adobe = png_with(png, "cHRM", adobe);
    is(png_with(png, "cHRM", those), {0.57750f, 0.12748f, 0.03188f});
    is(with_adobe, {0.75690f, 0.12744f, 0.02779f});
    is(png_with(with_adobe, "gAMA", numbers_of({50000})),
       {0.79893f, 0.15379f, 0.03350f});
    is(png_with(with_adobe, "sRGB", {0}), {0.57750f, 0.12748f, 0.03188f});
    CHECK(trouble_with(png_with(png, "cHRM", numbers_of({0, 0, 0, 0, 0, 0, 0, 0}))) ==
          other("its cHRM chunk"));
    // Three primaries nearly on a line: the matrix would magnify by 80 000.
    CHECK(trouble_with(png_with(
              png, "cHRM",
              numbers_of({33000, 33000, 70000, 30000, 50000, 40000, 30000, 50001}))) ==
          other("its cHRM chunk"));
    // A colour that is not finite has no matrix.
    const float infinite = std::numeric_limits<float>::infinity();
    std::vector<Rgb> sun{{infinite, 1, 2}, Rgb{1}};
    detail::convert(sun, *detail::to_srgb(detail::p3_primaries),
                    std::numeric_limits<float>::max());
    CHECK(sun[0] == Rgb{infinite, 1, 2});
    CHECK(max_component(glm::abs(sun[1] - Rgb{1})) < 1e-6f);
    is(png_with(with_adobe, "cICP", numbers_of({0x090d0001})),
       {0.88186f, 0.07217f, 0.01238f});
    is(png_with(png, "cICP", numbers_of({0x0c0d0001})), {0.67884f, 0.10851f, 0.01367f});
    is(png_with(png, "cICP", numbers_of({0x0c080001})), {0.87253f, 0.37566f, 0.16911f});

    // What a camera that is set to Adobe RGB writes: no profile, but the rule R03 in a
    // list of the list of EXIF fields. And the number of Adobe RGB.
    const auto exif = [](bool by_rule) {
        Bytes tiff;
        const auto field = [&](std::uint32_t name, std::uint32_t kind,
                               std::uint32_t value) {
            add_big(tiff, 1, 2);
            add_big(tiff, name, 2);
            add_big(tiff, kind, 2);
            add_big(tiff, kind == 2 ? 4 : 1, 4);
            add_big(tiff, value, 4);
            add_big(tiff, 0, 4);
        };
        add_text(tiff, {"MM\0*\0\0\0\x08", 8});
        field(0x8769, 4, 26);
        if (by_rule)
            field(0xa005, 4, 44);
        else
            field(0xa001, 3, 2 << 16);
        field(1, 2, 0x52303300);
        return tiff;
    };
    for (const bool by_rule : {true, false}) {
        const Bytes file = jpeg_with(jpeg, 0xe1, {"Exif\0\0", 6}, exif(by_rule));
        // 563/256 is the gamma of Adobe RGB.
        const Bytes same = png_with_profile(
            jpeg_as_png, profile_of("", false, of_adobe, curve_of_gamma(563 / 256.0)));
        const Rgb found = decode_image(file, "a").pixels[0];
        is(same, found);
        const Bytes with_profile =
            jpeg_with(file, 0xe2, {"ICC_PROFILE\0\1\1", 14}, rows[0].profile);
        CHECK(decode_image(with_profile, "a").pixels ==
              decode_image(png_with_profile(jpeg_as_png, rows[0].profile), "a").pixels);
    }

    // BMP: the same two pixels, with the longest head.
    const auto bmp = [&](std::uint32_t kind, const Bytes& profile, bool primaries_of_p3,
                         double of_gamma = 0) {
        Bytes file(14 + 124);
        file.insert(file.end(), {50, 100, 200, 0, 255, 0, 0, 0});
        const auto put = [&](std::size_t at, std::uint32_t value) {
            for (std::size_t k = 0; k < 4; ++k)
                file[at + k] = static_cast<unsigned char>(value >> 8 * k);
        };
        file[0] = 'B';
        file[1] = 'M';
        put(10, 138);
        put(14, 124);
        put(18, 2);
        put(22, 1);
        put(26, 1 | 24 << 16);
        put(70, kind);
        put(110, std::uint32_t(of_gamma * 65536));
        const std::array<double, 6> p3{0.68, 0.32, 0.265, 0.69, 0.15, 0.06};
        for (std::size_t k = 0; k < 3 && primaries_of_p3; ++k) {
            const double x = p3[2 * k], y = p3[2 * k + 1];
            put(74 + 12 * k, std::uint32_t(x * (1 << 30)));
            put(78 + 12 * k, std::uint32_t(y * (1 << 30)));
            put(82 + 12 * k, std::uint32_t((1 - x - y) * (1 << 30)));
        }
        put(126, 132);
        put(130, std::uint32_t(profile.size()));
        file.insert(file.end(), profile.begin(), profile.end());
        return file;
    };
    const std::uint32_t embedded = 0x4d424544, linked = 0x4c494e4b, srgb = 0x73524742;
    const Rgb as_srgb{0.57750f, 0.12748f, 0.03188f};
    is(bmp(0, {}, false), as_srgb);
    is(bmp(srgb, {}, true), as_srgb);
    is(bmp(0, {}, true, 2.2), {0.67884f, 0.10851f, 0.01367f});
    is(bmp(0, {}, true, 1 / 2.2), {0.67884f, 0.10851f, 0.01367f});
    is(bmp(0, {}, true, 1.8), {0.74932f, 0.16609f, 0.03123f});
    is(bmp(embedded, rows[7].profile, false), rows[7].color);
    CHECK(trouble_with(bmp(linked, {}, false)) ==
          other("the colour profile that it names"));
    Bytes short_profile = bmp(embedded, rows[7].profile, false);
    short_profile.pop_back();
    CHECK(trouble_with(short_profile) == other("its colour profile"));
}

TEST_CASE("texture: a photograph stands upright, as its EXIF segment says") {
    // 24 x 16, in fields of 8: the first is red, the last blue, the others grey.
    constexpr int width = 24, height = 16;
    Bytes pixels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool red = x < 8 && y < 8, blue = x >= 16 && y >= 8;
            for (const int v : {blue  ? 0
                                : red ? 255
                                      : 90,
                                red || blue ? 0 : 90,
                                red    ? 0
                                : blue ? 255
                                       : 90})
                pixels.push_back(static_cast<unsigned char>(v));
        }
    Bytes plain;
    stbi_write_jpg_to_func(
        [](void* to, void* data, int size) {
            const auto* bytes = static_cast<const unsigned char*>(data);
            static_cast<Bytes*>(to)->insert(static_cast<Bytes*>(to)->end(), bytes,
                                            bytes + size);
        },
        &plain, width, height, 3, pixels.data(), 100);
    const auto turned = [&](int orientation, bool low_first) {
        Bytes file(plain.begin(), plain.begin() + 2);
        const auto two = [&](int a, int b) {
            return low_first ? std::array{b, a} : std::array{a, b};
        };
        const auto [kind_a, kind_b] = two(low_first ? 'I' : 'M', low_first ? 'I' : 'M');
        const auto [mark_a, mark_b] = two(0, 42);
        const auto [tag_a, tag_b] = two(0x01, 0x12);
        const auto [type_a, type_b] = two(0, 3);
        const auto [value_a, value_b] = two(0, orientation);
        const auto [count_a, count_b] = two(0, 1);
        const int low = low_first ? 8 : 0, high = low_first ? 0 : 8;
        const int one_low = low_first ? 1 : 0, one_high = low_first ? 0 : 1;
        ljus_test::add_jpeg_segment(
            file, 0xe1, {'E',     'x',     'i',      'f',     0,       0,      kind_a,
                         kind_b,  mark_a,  mark_b,   low,     0,       0,      high,
                         count_a, count_b, tag_a,    tag_b,   type_a,  type_b, one_low,
                         0,       0,       one_high, value_a, value_b, 0,      0});
        file.insert(file.end(), plain.begin() + 2, plain.end());
        return decode_image(file, "photo.jpg");
    };
    CHECK(decode_image(plain, "plain.jpg").width == width);
    // Where the first field lies once it is upright: from the right, from below.
    const bool right[] = {false, true, true, false, false, true, true, false};
    const bool below[] = {false, false, true, true, false, false, true, true};
    for (const bool low_first : {true, false})
        for (int orientation = 1; orientation <= 8; ++orientation) {
            CAPTURE(orientation);
            CAPTURE(low_first);
            const Image image = turned(orientation, low_first);
            const bool lies = orientation >= 5;
            REQUIRE(image.width == (lies ? height : width));
            REQUIRE(image.height == (lies ? width : height));
            const std::size_t i = std::size_t(orientation) - 1;
            const int x = right[i] ? image.width - 4 : 3;
            const int y = below[i] ? image.height - 4 : 3;
            const Rgb red = pixel(image, x, y);
            const Rgb blue = pixel(image, image.width - 1 - x, image.height - 1 - y);
            CHECK(red.x > 0.9f);
            CHECK(red.z < 0.1f);
            CHECK(blue.z > 0.9f);
            CHECK(blue.x < 0.1f);
        }
}

TEST_CASE("texture: files that other readers of pictures had trouble with") {
    const std::string folder = LJUS_TEST_INPUTS "/";
    const auto refused = [&](const std::string& name) {
        return refusal<std::runtime_error>([&] { (void)load_image(folder + name); })
            .substr((folder + name).size());
    };
    // Indices 0 to 3 into a palette of red and green.
    CHECK(load_image(folder + "short_palette.png").pixels ==
          std::vector<Rgb>{Rgb{1, 0, 0}, Rgb{0, 1, 0}, Rgb{0}, Rgb{0}});
    // Red, green, blue above white and two greys, to be turned by a quarter to the
    // right; behind the pixels that is not said any more.
    const Image turned = load_image(folder + "turned.png");
    REQUIRE(turned.width == 2);
    CHECK(pixel(turned, 0, 0) == Rgb{1});
    CHECK(pixel(turned, 1, 0) == Rgb{1, 0, 0});
    CHECK(pixel(turned, 1, 2) == Rgb{0, 0, 1});
    CHECK(load_image(folder + "turned_late.png").width == 3);
    // A photograph 8 wide, with two bytes of padding before what turns it.
    CHECK(load_image(folder + "turned_padded.jpg").width == 4);
    // Inks: 255, 40 and 90 of 255 parts are not absorbed, and by black 200 are not.
    const Rgb ink = load_image(folder + "adobe_cmyk.jpg").pixels[0];
    CHECK(ink.x == doctest::Approx(srgb_decode(200 / 255.0)));
    CHECK(ink.y == doctest::Approx(srgb_decode(31 / 255.0)));
    CHECK(ink.z == doctest::Approx(srgb_decode(71 / 255.0)));
    CHECK(refused("four_channels.jpg") ==
          " is a JPEG file of four channels that does not say what they mean; save it "
          "as RGB.");
    CHECK(refused("twelve_bits.jpg") ==
          " is a JPEG file of more than 8 bits per channel; save it with 8 bits.");
    CHECK(refused("arithmetic.jpg") ==
          " is a JPEG file that is lossless, in layers or coded arithmetically; save "
          "it as baseline JPEG or PNG.");
}

TEST_CASE("texture: BMP files from the top, of few colours, cut off and compressed") {
    // `colors` are those of its palette: blue, green, red, and a byte for nothing.
    const auto bmp = [](int width, int height, int bits, const Bytes& colors,
                        const Bytes& pixels, int compression = 0) {
        Bytes file{'B', 'M'};
        const auto add = [&](long long value, int size) {
            for (int k = 0; k < size; ++k)
                file.push_back(static_cast<unsigned char>(value >> 8 * k));
        };
        const auto offset = static_cast<long long>(54 + colors.size());
        for (const long long word : {0LL, 0LL, offset, 40LL}) add(word, 4);
        add(width, 4);
        add(height, 4);
        add(1, 2);
        add(bits, 2);
        for (const int word : {compression, 0, 0, 0, 0, 0}) add(word, 4);
        file.insert(file.end(), colors.begin(), colors.end());
        file.insert(file.end(), pixels.begin(), pixels.end());
        return file;
    };
    const Rgb red{1, 0, 0}, green{0, 1, 0}, black{0};
    // A red row above a green one, stored in both orders.
    const Bytes red_first{0, 0, 255, 0, 0, 255, 0, 0};
    CHECK(decode_image(bmp(1, -2, 24, {}, red_first), "a").pixels ==
          std::vector{red, green});
    CHECK(decode_image(bmp(1, 2, 24, {}, red_first), "a").pixels ==
          std::vector{green, red});
    // Indices 0 to 3 into a palette of red and green, of a byte, half a byte and a bit.
    const Bytes two{0, 0, 255, 0, 0, 255, 0, 0};
    const std::vector right{red, green, black, black};
    CHECK(decode_image(bmp(4, 1, 8, two, {0, 1, 2, 3}), "a").pixels == right);
    CHECK(decode_image(bmp(4, 1, 4, two, {0x01, 0x23, 0, 0}), "a").pixels == right);
    CHECK(decode_image(bmp(2, 1, 1, two, {0x40, 0, 0, 0}), "a").pixels ==
          std::vector{red, green});
    // The oldest head, and the last one of 256 colours of three bytes.
    Bytes old{'B', 'M', 0, 0, 0, 0, 0, 0, 0, 0, 26 + 0, 3, 0, 0, 12, 0, 0, 0};
    old.insert(old.end(), {1, 0, 1, 0, 1, 0, 8, 0});
    old.resize(26 + 3 * 256);
    old[26 + 3 * 255 + 2] = 255;
    old.insert(old.end(), {255, 0, 0, 0});
    CHECK(decode_image(old, "a").pixels == std::vector{red});
    // Each byte but those that fill up the last row is needed.
    const Bytes whole = bmp(3, 2, 24, {}, Bytes(24, 200));
    const std::string ends = "a is damaged: it ends in the middle of its pixels.";
    for (std::size_t size = 54; size < whole.size() - 3; ++size)
        CHECK(trouble_with(
                  Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(size))) == ends);
    CHECK(trouble_with(Bytes(whole.begin(), whole.end() - 3)).empty());
    CHECK(trouble_with(bmp(1, std::numeric_limits<int>::min(), 24, {}, {}))
              .find("a has 1 x 2147483648") == 0);
    // Two bits for a pixel, no palette, and a header of 64 bytes.
    const std::string rare =
        "a is a BMP file that is damaged or of a rare kind; save it as PNG.";
    CHECK(trouble_with(bmp(4, 1, 2, two, {0, 0, 0, 0})) == rare);
    CHECK(trouble_with(bmp(4, 1, 8, {}, {0, 1, 2, 3})) == rare);
    Bytes os2 = whole;
    os2[14] = 64;
    CHECK(trouble_with(os2) == rare);
    CHECK(trouble_with(bmp(8, 1, 8, two, {8, 1, 0, 0, 0, 1}, 1)) ==
          "a is a BMP file that is compressed; save it without, or as PNG.");
}

TEST_CASE("texture: of pictures only those are read whose reader is trusted, and of "
          "PNG files only whole ones") {
    const std::string other = "a is not a picture that can be read: it is neither "
                              "PNG, JPEG nor BMP; save it as one of these.";
    // Softimage PIC, Photoshop, GIF, PNM; and TGA, which begins as anything.
    for (const std::string_view begin :
         {std::string_view("\x53\x80\xf6\x34"), std::string_view("8BPS"),
          std::string_view("GIF89a"), std::string_view("P6 1 1 255 abc"),
          std::string_view("\0\0\2", 3)}) {
        Bytes bytes(130, 1);
        std::copy(begin.begin(), begin.end(), bytes.begin());
        CHECK(trouble_with(bytes) == other);
    }
    // Any bit turned over, and any end: stb_image asks for no sum.
    const Bytes whole = encode_png(four());
    REQUIRE(trouble_with(whole).empty());
    for (std::size_t i = 8; i < whole.size(); ++i) {
        Bytes damaged = whole;
        damaged[i] = static_cast<unsigned char>(damaged[i] ^ 4u);
        REQUIRE(trouble_with(damaged).find("a is damaged: ") == 0);
        damaged.resize(i);
        REQUIRE(trouble_with(damaged).find("a is damaged: it ends ") == 0);
    }
    // Bytes behind the last chunk are none of the picture, and are not read as chunks.
    Bytes longer = whole;
    longer.insert(longer.end(), {0, 0, 0, 0, 't', 'e', 'X', 't', 1, 2, 3, 4});
    CHECK(trouble_with(longer).empty());
    longer.resize(33); // the header; no pixels
    longer.insert(longer.end(), whole.end() - 12, whole.end());
    longer.insert(longer.end(),
                  {0x7f, 0xff, 0xff, 0xff, 't', 'e', 'X', 't', 0, 0, 0, 0});
    longer.insert(longer.end(), 12, 0);
    CHECK(trouble_with(longer).find("a is damaged") == 0);
    // A critical chunk whose name is not of letters.
    const std::string sentence = trouble_with(png_with(whole, {"A\x1b\xff\n", 4}, {}));
    CHECK(sentence.find("a is ") == 0);
    for (const char c : sentence) CHECK((c >= ' ' && c < 0x7f));
    // A JPEG file whose table has more entries than stb_image has room for.
    Bytes jpeg{0xff, 0xd8, 0xff, 0xc4, 0x01, 0x14, 0x00};
    jpeg.insert(jpeg.end(), 16, 0);
    jpeg[7 + 8] = 255;
    jpeg.resize(400);
    CHECK(trouble_with(jpeg) != "a is damaged: a table has more than 255 entries.");
    jpeg[7 + 15] = 1;
    CHECK(trouble_with(jpeg) == "a is damaged: a table has more than 255 entries.");
    // A header with another byte and the right sum.
    const auto resummed = [](Bytes png) {
        const std::uint32_t sum = detail::png_sum(png, 12, 29);
        for (std::size_t i = 0; i < 4; ++i)
            png[29 + i] = static_cast<unsigned char>(sum >> (24 - 8 * i) & 255u);
        return png;
    };
    const auto with = [&](std::initializer_list<std::size_t> places,
                          unsigned char byte) {
        Bytes changed = whole;
        for (const std::size_t at : places) changed[at] = byte;
        return resummed(changed);
    };
    // Sizes that would take gigabytes; stb_image knows the larger ones for no picture.
    CHECK(trouble_with(with({18, 22}, 0x40)) ==
          "a has 16386 x 16386 pixels; there must be 1 to 33554432.");
    CHECK(trouble_with(with({18, 22}, 0xff)) ==
          "a has 65282 x 65282 pixels; there must be 1 to 33554432.");
    CHECK(trouble_with(with({16, 20}, 0xff)) ==
          "a has 4278190082 x 4278190082 pixels; there must be 1 to 33554432.");
    CHECK(trouble_with(with({19}, 0)) ==
          "a has 0 x 2 pixels; there must be 1 to 33554432.");
    // Half as many of 16 bits, as byte 24 says.
    CHECK(trouble_with(with({18, 22, 24}, 0x10)) ==
          "a has 4098 x 4098 pixels of 16 bits per channel; there must be 1 to "
          "16777216.");
    CHECK(trouble_with(with({18, 22}, 0x10)) ==
          "a is damaged: it ends in the middle of its pixels.");
    CHECK(trouble_with(with({24}, 3)) == // bits of a channel
          "a is not a picture that can be read: its header is damaged or unknown.");
    // As few pixels as are allowed, in one row that the decoder would not read.
    Bytes row = encode_png(make_image(2, 1));
    row[16] = 2; // 2^25 pixels wide
    row[19] = 0;
    CHECK(trouble_with(resummed(row)) ==
          "a has 33554432 x 1 pixels; width and height must be at "
          "most 16777216.");
    // Another chunk where the header must be.
    Bytes late = whole;
    late.erase(late.begin() + 8, late.begin() + 33);
    CHECK(trouble_with(late) ==
          "a is not a picture that can be read: its header is damaged or unknown.");
}

TEST_CASE("texture: pictures that are kept together are limited together") {
    const Bytes file = encode_png(make_image(4, 2));
    CHECK(decode_image(file, "a", (1 << 25) - 8).pixels.size() == 8);
    CHECK_THROWS_WITH(
        (void)decode_image(file, "a", (1 << 25) - 7),
        "a has 4 x 2 pixels, and the pictures before it have 33554425; together there "
        "must be at most 33554432.");
}

#ifdef LJUS_TEST_LITTLE_MEMORY
TEST_CASE("texture: a picture for which there is no memory is not called damaged") {
    Image image = make_image(600, 400);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = Rgb(float(i * 2654435761u % 1000003u) / 1e6f); // noise
    const Bytes file = encode_png(image);
    const auto right = decode_image(file, "a").pixels;
    CHECK(ljus_test::trouble_with_little_memory(65536, 1 << 23, [&] {
              return decode_image(file, "a").pixels == right;
          }) == "");
}
#endif

TEST_CASE("texture: the tables of a JPEG file, segment by segment") {
    const auto add = [](Bytes& to, std::initializer_list<int> values) {
        for (const int value : values) to.push_back(static_cast<unsigned char>(value));
    };
    // A table of this many entries, all codes of 8 bits, or the others of 9.
    const auto table = [&](Bytes& to, int entries) {
        add(to, {0, 0, 0, 0, 0, 0, 0, 0, std::min(entries, 255),
                 entries - std::min(entries, 255), 0, 0, 0, 0, 0, 0, 0});
        for (int i = 0; i < entries; ++i) add(to, {i % 200});
    };
    const auto tables = [&](std::initializer_list<int> sizes) {
        Bytes file{0xff, 0xd8, 0xff, 0xc4};
        int length = 2;
        for (const int entries : sizes) length += 17 + entries;
        add(file, {length / 256, length % 256});
        for (const int entries : sizes) table(file, entries);
        add(file, {0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff});
        file.resize(file.size() + 300, 0xff);
        return file;
    };
    const auto trouble = [](const Bytes& file) {
        return detail::jpeg_trouble(file) != nullptr;
    };
    CHECK_FALSE(trouble(tables({0})));
    CHECK_FALSE(trouble(tables({255})));
    CHECK(trouble(tables({256})));
    CHECK_FALSE(trouble(tables({200, 200, 255, 3})));
    CHECK(trouble(tables({200, 200, 256})));
    CHECK(trouble(tables({200, 256, 200})));
    // A long segment before it is jumped over, to the byte: its last two look like the
    // beginning of a table, of which what follows would be a bad one.
    for (const int length : {16, 0x110, 0x202, 0x3ff}) {
        Bytes file{0xff, 0xd8, 0xff, 0xe0};
        add(file, {length / 256, length % 256});
        file.resize(4 + std::size_t(length) - 2, 0);
        add(file, {0xff, 0xc4});
        Bytes with_table = file;
        add(file, {0xff, 0xfe, 0, 0x30});
        file.resize(file.size() + 46, 0x7f);
        CHECK_FALSE(trouble(file));
        const Bytes bad = tables({256});
        with_table.insert(with_table.end(), bad.begin() + 2, bad.end());
        CHECK(trouble(with_table));
    }
    // Behind coded pixels, among which 0xff is followed by 0 or numbers a restart.
    Bytes coded{0xff, 0xd8, 0xff, 0xda, 0, 8, 0, 0, 0, 0, 0, 0};
    add(coded, {7, 0xff, 0, 0xc4, 0xff, 0xd0, 0xff, 0xd7, 0xc4, 0xff});
    const Bytes bad = tables({256});
    const auto with_bad = [&](std::initializer_list<int> before) {
        Bytes file = coded;
        add(file, before);
        file.insert(file.end(), bad.begin() + 2, bad.end());
        return trouble(file);
    };
    CHECK_FALSE(trouble(coded));
    CHECK(with_bad({}));
    CHECK(with_bad({0xff, 0xff}));                   // padding
    CHECK(with_bad({0xff, 0xc4, 0, 2}));             // no tables, then these
    CHECK(with_bad({0xff, 0xfe, 0, 4, 0xff, 0xd9})); // a comment
    CHECK_FALSE(with_bad({0xff, 0xfe, 0, 4}));       // in one: its end is in the table
    CHECK_FALSE(with_bad({0xff, 0xd9}));             // behind the end of the picture
    CHECK_FALSE(trouble({0xff, 0xd8}));
    CHECK_FALSE(trouble({0xff, 0xd8, 0xff, 0xe0, 0xff}));
}

TEST_CASE("texture: a JPEG file has the tables that its scans use") {
    // A file of a kind with an empty table of each number, 0x10 and more for AC, and a
    // scan of two components that use some: DC in the upper half of a byte.
    const auto good = [](int kind, std::initializer_list<int> there,
                         std::array<int, 2> used, int first = 0, int high = 0,
                         std::initializer_list<int> before = {}) {
        Bytes file{0xff, 0xd8, 0xff, static_cast<unsigned char>(kind), 0, 2};
        const auto add = [&](std::initializer_list<int> values) {
            for (const int v : values) file.push_back(static_cast<unsigned char>(v));
        };
        for (const int number : there) {
            add({0xff, 0xc4, 0, 19, number});
            file.insert(file.end(), 16, 0);
        }
        add(before);
        add({0xff, 0xda, 0, 10, 2, 1, used[0], 2, used[1], first, 63, high << 4, 0, 0});
        return detail::jpeg_trouble(file) == nullptr;
    };
    constexpr int baseline = 0xc0, progressive = 0xc2;
    CHECK(good(baseline, {0x00, 0x10, 0x01, 0x11}, {0x00, 0x11}));
    CHECK(good(baseline, {0x00, 0x11}, {0x01, 0x01}));
    CHECK_FALSE(good(baseline, {0x00, 0x10, 0x01}, {0x00, 0x11}));
    CHECK_FALSE(good(baseline, {0x00, 0x10, 0x11}, {0x00, 0x11}));
    CHECK_FALSE(good(baseline, {0x01, 0x10, 0x11}, {0x00, 0x11}));
    CHECK_FALSE(good(baseline, {}, {0x00, 0x00}));
    // A part of a progressive file uses tables of one kind, or none to refine DC.
    CHECK(good(progressive, {0x00}, {0x00, 0x01}));
    CHECK_FALSE(good(progressive, {0x10, 0x11}, {0x00, 0x01}));
    CHECK(good(progressive, {0x12}, {0x32, 0x32}, 1));
    CHECK(good(progressive, {0x12}, {0x32, 0x32}, 1, 1));
    CHECK_FALSE(good(progressive, {0x02, 0x03}, {0x22, 0x22}, 1));
    CHECK(good(progressive, {}, {0x00, 0x00}, 0, 1));
    // What looks like a table within a comment, here behind a first scan, is none.
    const auto second_scan = [&](int kind) {
        return good(progressive, {0x00}, {0x02, 0x02}, 1, 0,
                    {0xff, 0xda, 0, 8,  1,    1, 0, 0, 0, 0, 7, // pixels: 7
                     0xff, kind, 0, 19, 0x12, 0, 0, 0, 0, 0, 0, //
                     0,    0,    0, 0,  0,    0, 0, 0, 0, 0});
    };
    CHECK(second_scan(0xc4));
    CHECK_FALSE(second_scan(0xfe));
}

TEST_CASE("texture: a JPEG file of many scans is refused before they are decoded") {
    const auto trouble = [](unsigned char kind, int scans) -> std::string {
        Bytes file{0xff, 0xd8, 0xff, kind, 0, 2};
        constexpr unsigned char dc = 0x00, ac = 0x10;
        for (const unsigned char number : {dc, ac}) { // tables, empty
            file.insert(file.end(), {0xff, 0xc4, 0, 19, number});
            file.insert(file.end(), 16, 0);
        }
        for (int i = 0; i < scans; ++i)
            file.insert(file.end(), {0xff, 0xda, 0, 8, 1, 1, 0, 0, 63, 0});
        const char* const why = detail::jpeg_trouble(file);
        return why ? why : "";
    };
    constexpr unsigned char baseline = 0xc0, progressive = 0xc2;
    CHECK(trouble(baseline, 4).empty());
    CHECK(trouble(baseline, 5) == "it has more than 4 scans, and is not progressive");
    CHECK(trouble(progressive, 64).empty());
    CHECK(trouble(progressive, 65) == "it has more than 64 scans");
}

TEST_CASE("texture: the sums of a damaged JPEG file wrap, and are clamped") {
    // 64 x 8 pixels of one channel. Each block is 32 767 units of 65 535 brighter than
    // the one before it, so that the second one overflows an int. The sanitizers judge.
    Bytes file{0xff, 0xd8};
    ljus_test::add_jpeg_segment(file, 0xdb, {0x10}); // the units, 16 bits each
    file[5] = 131;
    file.insert(file.end(), 128, 0xff);
    ljus_test::add_jpeg_segment(file, 0xc0, {8, 0, 8, 0, 64, 1, 1, 0x11, 0});
    // One code in each table, 0: a step of 15 bits, and nothing but it in the block.
    ljus_test::add_jpeg_segment(
        file, 0xc4, {0x00, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 15});
    ljus_test::add_jpeg_segment(
        file, 0xc4, {0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    ljus_test::add_jpeg_segment(file, 0xda, {1, 1, 0x00, 0, 63, 0});
    // 0 111111111111111 0, eight times; a zero byte follows each byte of ones.
    for (const int half : {0x7f, 0x3f, 0x9f, 0xcf, 0xe7, 0xf3, 0xf9, 0xfc, 0xfe})
        for (const int v : {half, 0xff, 0})
            file.push_back(static_cast<unsigned char>(v));
    file.back() = 0xd9;
    const Image image = decode_image(file, "a");
    CHECK(image.width == 64);
    for (const Rgb& color : image.pixels) CHECK((color.x >= 0 && color.x <= 1));
}

TEST_CASE("texture: a file of many pixels and few bytes is refused") {
    // 10 289 152 x 3 pixels of 16 bits in 63 bytes, as a fuzzer found it.
    Bytes bmp(63, 0);
    bmp[0] = 'B', bmp[1] = 'M', bmp[10] = 54, bmp[14] = 40;
    bmp[20] = 0x9d, bmp[22] = 3, bmp[26] = 1, bmp[28] = 16;
    // 63 753 x 256 of three channels in 644 bytes, which the fuzzer found next.
    Bytes jpeg{0xff, 0xd8, 0xff, 0xc0, 0, 17,   8, 1, 0,    0xf9, 0x09,
               3,    1,    0x11, 0,    2, 0x11, 0, 3, 0x11, 0};
    jpeg.resize(644);
    for (const Bytes& file : {bmp, jpeg})
        CHECK(trouble_with(file) ==
              "a is damaged: it ends in the middle of its pixels.");
}
#endif
