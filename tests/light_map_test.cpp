// concept: radiosity
/// \file light_map_test.cpp
/// \brief Light maps: blended between vertices, saved and loaded bit by bit.

#include "ljus/io/light_map_file.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "ljus/radiosity/radiosity.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scenes/cornell_box.hpp"
#include "scratch_folder.hpp"

using namespace ljus;

namespace {

using Color = RgbT<double>;

/// One of each kind of shape, and a mirror.
auto stage() {
    Scene<Shapes<Quad, Triangle, Sphere>, Materials<Mirror, Lambertian>> all;
    const auto white = all.add(Lambertian{.albedo = Rgb{0.5f}});
    all.add(Quad{{-2, -2, 0}, {4, 0, 0}, {0, 4, 0}}, white);
    all.add(Triangle{{-2, -2, 4}, {-2, 2, 4}, {2, 0, 4}}, white, Rgb{1, 2, 3});
    all.add(Sphere{.center{0, 0, 1}, .radius = 0.5f}, white);
    all.add(Sphere{.center{1, 1, 1}, .radius = 0.3f}, all.add(Mirror{}));
    return all;
}

bool same(const LightMap& a, const LightMap& b) {
    return a.objects == b.objects && a.grids == b.grids &&
           a.irradiance.size() == b.irradiance.size() &&
           (a.irradiance.empty() ||
            std::memcmp(a.irradiance.data(), b.irradiance.data(),
                        a.irradiance.size() * sizeof(Color)) == 0);
}

std::string why_not(const std::string& path) {
    try {
        (void)load_light_map(path, {});
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "it was read";
}

/// Light that grows evenly over the unit square.
Color slope(const glm::dvec2& at) {
    return Color(1 + at.x, 2 + at.y, 3 + at.x + at.y);
}

} // namespace

TEST_CASE("light_map: vertices are numbered, each by all of its cells") {
    const auto check_all = [](const PatchGrid& grid) {
        std::vector<int> cells(grid.vertices(), 0);
        for (std::uint32_t cell = 0; cell < grid.size(); ++cell)
            for (const std::uint32_t vertex :
                 detail::cell_vertices(grid, place_of(grid, cell)))
                if (vertex != detail::no_grid) {
                    REQUIRE(vertex < cells.size());
                    ++cells[vertex];
                }
        for (const int count : cells) CHECK(count > 0);
        return cells;
    };
    const auto quad = check_all(patch_grid(Quad{}, 0.3));
    CHECK(quad[0] == 1);
    CHECK(quad[6] == 4);
    const auto triangle =
        check_all(patch_grid(Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.3));
    CHECK(triangle[0] == 1);
    CHECK(std::count(triangle.begin(), triangle.end(), 6) == 6); // inner ones, n = 5
    const PatchGrid ball = patch_grid(Sphere{}, 1);
    const auto around = check_all(ball);
    CHECK(around[0] == 2 * int(ball.rows)); // the pole, twice in each of its cells
    CHECK(around[2] == 4);
}

TEST_CASE("light_map: blended light is continuous, and as even as the patches") {
    for (PatchGrid grid : {patch_grid(Quad{}, 0.2),
                           patch_grid(Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.2),
                           patch_grid(Sphere{}, 0.5)}) {
        const std::vector<Color> even(grid.size(), Color(1, 2, 3));
        const auto flat = vertex_light(grid, even);
        std::vector<Color> wild(grid.size());
        RandomStream stream = random_stream(3, Pass::user, 0, 0);
        for (Color& c : wild) c = Color(next_1d<double>(stream));
        const auto rough = vertex_light(grid, wild);
        for (int i = 0; i < 2000; ++i) {
            glm::dvec2 at = next_2d<double>(stream);
            if (grid.kind == detail::GridKind::triangle && at.x + at.y > 1)
                at = 1.0 - at;
            CHECK(glm::distance(blended_light(grid, at, flat), Color(1, 2, 3)) < 1e-14);
            const glm::dvec2 near =
                at * (1 - 1e-9) + 1e-9 * glm::dvec2(1, 1) / 3.0; // within both
            CHECK(glm::distance(blended_light(grid, at, rough),
                                blended_light(grid, near, rough)) < 1e-6);
        }
        // Around a ball the last row meets the first.
        if (grid.kind == detail::GridKind::ball)
            for (const double u : {0.0, 0.1, 0.5, 1.0})
                CHECK(glm::distance(blended_light(grid, {u, 0}, rough),
                                    blended_light(grid, {u, 1}, rough)) < 1e-14);
    }
    // An even slope comes back as it was, but for the outermost half of a patch.
    for (const PatchGrid& grid :
         {patch_grid(Quad{}, 0.1),
          patch_grid(Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.05)}) {
        std::vector<Color> cells(grid.size());
        const Facet unit = grid.kind == detail::GridKind::quad
                               ? facet_of(QuadT<double>{})
                               : Facet{{glm::dvec3(0), {1, 0, 0}, {0, 1, 0}}, 3};
        for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
            const Facet part = detail::cell_facet(grid, unit, cell);
            glm::dvec3 middle(0);
            for (int i = 0; i < part.count; ++i)
                middle += part.corners[std::size_t(i)] / double(part.count);
            cells[cell] = slope({middle.x, middle.y});
        }
        const auto vertices = vertex_light(grid, cells);
        for (const glm::dvec2 at : {glm::dvec2{0.2, 0.3}, {0.41, 0.33}, {0.15, 0.5}})
            CHECK(glm::distance(blended_light(grid, at, vertices), slope(at)) < 1e-12);
    }
}

TEST_CASE("light_map: what a ray finds") {
    const auto scene = stage();
    const auto all =
        make_radiosity(scene, {.patches = {.size = 1}, .factors = {.rays = 64}});
    const auto view = make_light_map_view(scene, all->map, {.smooth = false});
    RandomStream stream;
    Counts counts;
    const auto look = [&](const Vec3& from, const Vec3& way) {
        return radiance(view, Ray{.origin = from, .direction = way}, stream, counts);
    };
    CHECK(look({0, 0, 9}, {0, 0, 1}) == Rgb{0});    // nothing
    CHECK(look({1, 1, 3}, {0, 0, -1}) == Rgb{0});   // a mirror
    CHECK(look({0, 0, 9}, {0, 0, -1}) == Rgb{0});   // a side without patches
    CHECK(look({-1, -1, -1}, {0, 0, 1}) == Rgb{0}); // the floor from below
    const Rgb lamp = look({1.5f, 0, 1}, {0, 0, 1});
    CHECK(lamp.x > 1);
    CHECK(lamp.x < 1.2f);
    // A floor patch, as the map has it; the same from everywhere.
    const Rgb floor = look({-1.5f, -1.5f, 1}, {0, 0, -1});
    const Color light = all->map.irradiance[0];
    CHECK(floor.x == doctest::Approx(0.5 * light.x / std::numbers::pi).epsilon(1e-6));
    CHECK(look({-2, -1.5f, 1}, {0.5f, 0, -1}) == floor);
    PathLog log;
    (void)radiance(view, Ray{.origin{-1.5f, -1.5f, 1}, .direction{0, 0, -1}}, stream,
                   counts, log);
    REQUIRE(log.lines.size() == 1);
    CHECK(log.lines[0].path == "ED..L");
    CHECK(log.lines[0].what == "light map");
}

TEST_CASE("light_map: it comes back, bit by bit, and gives the same picture") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.light");
    const auto room = cornell_box();
    const auto all = make_radiosity(room.scene, {.patches = {.size = 1}});
    save_light_map(path, all->map, {});
    const LightMap back = load_light_map(path, {});
    CHECK(same(all->map, back));
    CHECK(load_file(path, 1'000'000).size() ==
          56 + 20 * all->map.grids.size() + 24 * all->map.irradiance.size());
    const RenderSettings picture{.width = 24, .height = 24, .samples = 1};
    CHECK(render(make_light_map_view(room.scene, back), room.camera, picture)
              .image.pixels ==
          render(make_light_map_view(room.scene, all->map), room.camera, picture)
              .image.pixels);
    const auto scene = stage();
    const auto balls =
        make_radiosity(scene, {.patches = {.size = 1}, .factors = {.rays = 16}});
    save_light_map(path, balls->map, {});
    CHECK(same(balls->map, load_light_map(path, {})));
    save_light_map(path, {}, {});
    CHECK(same({}, load_light_map(path, {})));
}

TEST_CASE("light_map: a map of another scene is refused") {
    const auto room = cornell_box();
    const auto all = make_radiosity(room.scene, {.patches = {.size = 2}});
    const auto refused = [&](const auto& scene, const LightMap& map) {
        CHECK_THROWS_AS((void)make_light_map_view(scene, map), std::invalid_argument);
    };
    refused(stage(), all->map);
    LightMap wrong = all->map;
    wrong.grids[0].object.index = 99;
    refused(room.scene, wrong);
    wrong = all->map;
    wrong.grids[0].object.type = 7;
    refused(room.scene, wrong);
    wrong = all->map;
    wrong.grids[0].kind = detail::GridKind::triangle;
    refused(room.scene, wrong);
    wrong = all->map;
    wrong.irradiance.pop_back();
    refused(room.scene, wrong);
}

TEST_CASE("light_map: a file cut short or damaged is refused") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.light");
    const std::string cannot = "cannot read '" + path + "': ";
    const auto scene = stage();
    save_light_map(
        path,
        make_radiosity(scene, {.patches = {.size = 9}, .factors = {.rays = 4}})->map,
        {});
    const Bytes whole = load_file(path, 100000);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        save_file(path, Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(size)));
        REQUIRE(why_not(path).starts_with(cannot));
    }
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const int bit : {0, 3, 7}) {
            Bytes damaged = whole;
            damaged[i] = static_cast<unsigned char>(damaged[i] ^ 1u << bit);
            save_file(path, damaged);
            REQUIRE(why_not(path).starts_with(cannot));
        }
    // Numbers that are wrong, checksum or not.
    const auto with = [&](std::size_t at, std::initializer_list<int> values) {
        Bytes bytes = whole;
        for (const int value : values) bytes[at++] = static_cast<unsigned char>(value);
        detail::put_checksum(bytes);
        save_file(path, bytes);
        return why_not(path);
    };
    const std::size_t light = whole.size() - 8;
    CHECK(with(16, {1}) ==
          cannot + "it is of version 1, and this library reads version 2.");
    CHECK(with(20, {255, 255, 255, 255})
              .starts_with(cannot + "it says that it holds 42"));
    CHECK(with(64, {3}) == cannot + "its grid 0 is none.");
    CHECK(with(68, {0}) == cannot + "its grid 0 is none.");
    CHECK(with(68, {255, 255, 1}) == cannot + "its grid 0 is none.");
    CHECK(with(68, {255, 255}).starts_with(cannot + "it says that it holds 655"));
    CHECK(with(light, {0, 0, 0, 0, 0, 0, 240, 127}) ==
          cannot + "it has light that is not finite, or below 0.");
    CHECK(with(light, {0, 0, 0, 0, 0, 0, 240, 191}) ==
          cannot + "it has light that is not finite, or below 0.");
    save_file(path, whole);
    CHECK_THROWS_AS((void)load_light_map(path, {}, 2), std::runtime_error);
    const std::string text = "P6 a picture";
    save_file(path, Bytes(text.begin(), text.end()));
    CHECK(why_not(path).starts_with(cannot + "it does not begin with 'ljus light map"));
    CHECK_THROWS_AS(save_light_map(folder.file("nowhere/a"), {}, {}),
                    std::runtime_error);
}
