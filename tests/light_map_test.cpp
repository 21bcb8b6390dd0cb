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
#include "support/refusal.hpp"

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
    return World(std::move(all));
}

bool same(const LightMap& a, const LightMap& b) {
    return a.key == b.key && a.grids == b.grids &&
           a.irradiance.size() == b.irradiance.size() &&
           (a.irradiance.empty() ||
            std::memcmp(a.irradiance.data(), b.irradiance.data(),
                        a.irradiance.size() * sizeof(Color)) == 0);
}

std::string why_not(const std::string& path) {
    return ljus_test::refusal<std::runtime_error>(
        [&] { (void)load_light_map(path, {}); }, "it was read");
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
                if (vertex != no_grid) {
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
    // A linear slope is reproduced, except in the outermost half of a patch.
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
    const LightMapView view(scene, all->map, {.smooth = false});
    RandomStream stream;
    Counts counts;
    const auto look = [&](const Vec3& from, const Vec3& way) {
        auto context = context_of(stream, counts);
        return radiance(view, Ray{.origin = from, .direction = way}, context);
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
    auto logged = context_of(stream, counts, log);
    (void)radiance(view, Ray{.origin{-1.5f, -1.5f, 1}, .direction{0, 0, -1}}, logged);
    REQUIRE(log.lines.size() == 1);
    CHECK(log.lines[0].path == "ED..L");
    CHECK(log.lines[0].what == "light map");
    CHECK(glm::distance(log.lines[0].value, glm::dvec3(floor)) < 1e-12);
    // The next ray begins a path of its own; a lamp's own light is a term, too.
    log.letters = "ED";
    log.lines.clear();
    const Rgb bright =
        radiance(view, Ray{.origin{1.5f, 0, 1}, .direction{0, 0, 1}}, logged);
    glm::dvec3 sum{0};
    for (const auto& line : log.lines) {
        CHECK(line.path == (line.what == "emission" ? "EL" : "ED..L"));
        sum += line.value;
    }
    CHECK(glm::distance(sum, glm::dvec3(bright)) < 1e-6);
    REQUIRE(!log.lines.empty());
    CHECK(log.lines[0].what == "emission");
    CHECK(log.lines[0].value.x == doctest::Approx(1));
}

TEST_CASE("light_map: each side has its own light, where the ray meets it") {
    // A map by hand: all cells differ, in three channels. What a ray sees is the light
    // of the cell, or between its corners, that the place itself tells.
    for (const bool inside_out : {false, true}) {
        Scene<Shapes<Quad, Triangle, Sphere>, Materials<Mirror, Lambertian>> scene;
        const Rgb albedo{0.8f, 0.5f, 0.2f}, shines{3, 5, 7};
        const auto matt = scene.add(Lambertian{.albedo = albedo});
        scene.add(Quad{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, matt, shines, inside_out);
        scene.add(Triangle{{9, 0, 0}, {12, 0, 0}, {9, 3, 0}}, matt, shines, inside_out);
        scene.add(Sphere{.center{20, 0, 0}, .radius = 1}, matt, shines, inside_out);
        const World world(std::move(scene));
        const std::vector<PatchGrid> forms{
            patch_grid(Quad{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, 0.5),
            patch_grid(Triangle{{9, 0, 0}, {12, 0, 0}, {9, 3, 0}}, 1.2),
            patch_grid(Sphere{.radius = 1}, 0.9)};
        CHECK(forms[0].columns == 4);
        CHECK(forms[0].rows == 2);
        CHECK(forms[1].columns == 4); // the longest side is 4.24
        CHECK(forms[1].rows == 4);
        CHECK(forms[2].columns == 4); // pi over 0.9
        CHECK(forms[2].rows == 7);    // 2 pi over 0.9
        LightMap map{.key{.scene = detail::scene_hash(world)}};
        for (std::uint32_t type = 0; type < 3; ++type)
            for (const bool back : {false, true}) {
                PatchGrid grid = forms[type];
                grid.object = {type, 0};
                grid.back = back;
                grid.inward = back != inside_out;
                grid.first = std::uint32_t(map.irradiance.size());
                map.grids.push_back(grid);
                for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
                    const double light = 1 + double(map.irradiance.size());
                    map.irradiance.push_back(Color(light, 2 * light, 100 - light));
                }
            }
        const LightMapView plain(world, map, {.smooth = false});
        const LightMapView smooth(world, map);
        RandomStream stream = random_stream(4, Pass::user, 0, 0);
        for (int i = 0; i < 600; ++i) {
            const std::uint32_t type = std::uint32_t(i % 3);
            const bool inward = i % 2 == 1; // the ray goes along the shape's normal
            glm::dvec2 u{next_2d<double>(stream)};
            if (type == 1 && u.x + u.y > 1) u = 1.0 - u;
            Vec3 place, outer{0, 0, 1};
            glm::dvec2 at = u;
            if (type == 0) place = {2 * u.x, u.y, 0};
            if (type == 1) place = {9 + 3 * u.x, 3 * u.y, 0};
            if (type == 2) { // from the north pole down, and around from x to y
                const double z = 1 - 2 * u.x, r = std::sqrt(1 - z * z);
                const double turn = 2 * std::numbers::pi * u.y;
                outer = {r * std::cos(turn), r * std::sin(turn), z};
                place = Vec3{20, 0, 0} + outer;
            }
            const float before = inward ? -0.2f : 0.2f;
            const Ray ray{.origin = place + before * outer,
                          .direction = inward ? outer : -outer};
            const bool back = inward != inside_out;
            const PatchGrid& grid = map.grids[2 * type + back];
            // Too near to a cell's border to say by float whose it is.
            const glm::dvec2 cells{at.x * grid.columns, at.y * grid.rows};
            const glm::dvec2 off = glm::abs(cells - glm::round(cells));
            const double slanted = cells.x + cells.y;
            if (off.x < 1e-4 || off.y < 1e-4 ||
                std::abs(slanted - std::round(slanted)) < 1e-4)
                continue;
            // Which cell: those whose corners are around the place.
            const glm::dvec2 whole = glm::floor(cells), in = cells - whole;
            std::uint32_t cell =
                std::uint32_t(whole.y) * grid.columns + std::uint32_t(whole.x);
            if (type == 1) { // rows of 7, 5, 3 and 1
                const std::uint32_t before_row[] = {0, 7, 12, 15};
                cell = before_row[int(whole.y)] + 2 * std::uint32_t(whole.x) +
                       (in.x + in.y > 1 ? 1 : 0);
            }
            Counts counts;
            const auto seen = [&](const auto& view) {
                auto context = context_of(stream, counts);
                return glm::dvec3(radiance(view, ray, context));
            };
            const glm::dvec3 own = back ? glm::dvec3(0) : glm::dvec3(shines);
            const auto reflected = [&](const Color& light) {
                return own + glm::dvec3(albedo) / std::numbers::pi * light;
            };
            CAPTURE(type);
            CAPTURE(back);
            const glm::dvec3 right = reflected(map.irradiance[grid.first + cell]);
            CHECK(glm::distance(seen(plain), right) < 1e-4 * glm::length(right));
            const auto blended =
                reflected(blended_light(grid, at, smooth.vertices()[2 * type + back]));
            CHECK(glm::distance(seen(smooth), blended) < 1e-3 * glm::length(blended));
            CHECK(counts.rays() == 0);
        }
    }
}

TEST_CASE("light_map: it comes back, bit by bit, and gives the same picture") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.light");
    const auto room = cornell_box();
    const auto all = make_radiosity(room.world, {.patches = {.size = 1}});
    save_light_map(path, all->map);
    const LightMapKey& key = all->map.key;
    const LightMap back = load_light_map(path, key);
    CHECK(same(all->map, back));
    // It is accepted with this limit on patches, and refused with one fewer.
    const std::size_t patches = back.irradiance.size();
    CHECK(same(back, load_light_map(path, key, patches)));
    CHECK_THROWS_WITH_AS((void)load_light_map(path, key, patches - 1),
                         doctest::Contains("it holds more patches than are allowed"),
                         std::runtime_error);
    CHECK(load_file(path, 1'000'000).size() ==
          48 + 20 * all->map.grids.size() + 24 * all->map.irradiance.size());
    const RenderSettings picture{.width = 24, .height = 24, .samples = 1};
    CHECK(
        render(LightMapView(room.world, back), room.camera, picture).image.pixels ==
        render(LightMapView(room.world, all->map), room.camera, picture).image.pixels);
    const auto scene = stage();
    const auto balls =
        make_radiosity(scene, {.patches = {.size = 1}, .factors = {.rays = 16}});
    save_light_map(path, balls->map);
    CHECK(same(balls->map, load_light_map(path, balls->map.key)));
    save_light_map(path, {});
    CHECK(same({}, load_light_map(path, {})));
}

TEST_CASE("light_map: a map of another scene is refused") {
    const auto room = cornell_box();
    const auto all = make_radiosity(room.world, {.patches = {.size = 2}});
    const auto refused = [&](const auto& scene, const LightMap& map) {
        CHECK_THROWS_AS((void)LightMapView(scene, map), std::invalid_argument);
    };
    refused(stage(), all->map);
    LightMap wrong = all->map;
    ++wrong.key.scene;
    refused(room.world, wrong);
    wrong = all->map;
    // A shape or a type of shapes that does not exist: the first beyond the list, too.
    const PatchGrid& first = all->map.grids[0];
    const auto shapes = std::uint32_t(std::get<0>(room.world.objects()).size());
    REQUIRE(first.object.type == 0);
    for (const std::uint32_t index : {shapes, shapes + 1, 99u}) {
        wrong = all->map;
        wrong.grids[0].object.index = index;
        refused(room.world, wrong);
    }
    constexpr std::uint32_t types =
        std::tuple_size_v<std::remove_cvref_t<decltype(room.world.objects())>>;
    for (const std::uint32_t type : {types, types + 1, 99u}) {
        wrong = all->map;
        wrong.grids[0].object.type = type;
        refused(room.world, wrong);
    }
    wrong = all->map;
    wrong.grids[0].kind = detail::GridKind::triangle;
    refused(room.world, wrong);
    wrong = all->map;
    wrong.irradiance.pop_back();
    refused(room.world, wrong);
    // Grids that share their patches, or leave some out.
    for (const int shift : {-1, 1}) {
        wrong = all->map;
        wrong.grids[1].first += std::uint32_t(shift);
        refused(room.world, wrong);
    }
    CHECK_NOTHROW((void)LightMapView(room.world, all->map));
}

TEST_CASE("light_map: a file cut short or damaged is refused") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.light");
    const std::string cannot = "cannot read '" + path + "': ";
    const auto scene = stage();
    LightMap large =
        make_radiosity(scene, {.patches = {.size = 9}, .factors = {.rays = 4}})->map;
    large.key = {}; // as why_not() asks for
    save_light_map(path, large);
    const Bytes whole = load_file(path, 100000);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        save_file(path, Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(size)));
        REQUIRE(why_not(path).starts_with(cannot));
        if (size >= 40)
            CHECK(why_not(path) ==
                  cannot + "its checksum is wrong: it is damaged or truncated.");
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
        put_checksum(bytes);
        save_file(path, bytes);
        return why_not(path);
    };
    const std::size_t light = whole.size() - 8;
    CHECK(with(16, {1}) == cannot + "its version is 1; this library reads version 3.");
    CHECK(with(20, {255, 255, 255, 255}).starts_with(cannot + "it declares 42"));
    CHECK(with(56, {3}) == cannot + "its grid 0 is not valid.");
    CHECK(with(60, {0}) == cannot + "its grid 0 is not valid.");
    CHECK(with(60, {255, 255, 1}) == cannot + "its grid 0 is not valid.");
    // The kind stands in the two lowest bits: a triangle has as many rows as columns,
    // a ball two columns and three rows at least.
    const auto grid = [&](int how, int columns, int rows) {
        return with(56, {how, 0, 0, 0, columns, 0, 0, 0, rows, 0, 0, 0}) ==
               cannot + "its grid 0 is not valid.";
    };
    for (const int sides : {0, 4, 8, 12}) {
        CHECK_FALSE(grid(sides, 3, 2));
        CHECK(grid(sides + 1, 3, 2));
        CHECK_FALSE(grid(sides + 1, 3, 3));
        CHECK(grid(sides + 2, 1, 3));
        CHECK(grid(sides + 2, 2, 2));
        CHECK_FALSE(grid(sides + 2, 2, 3));
        CHECK(grid(sides + 3, 3, 3));
        CHECK(grid(sides, 0, 1));
        CHECK(grid(sides, 1, 0));
    }
    CHECK(grid(16, 3, 2));
    CHECK(with(60, {255, 255}).starts_with(cannot + "it declares 655"));
    // One patch more or fewer than it says, and a byte of another one.
    const auto longer = [&](std::ptrdiff_t by) {
        Bytes bytes = whole;
        if (by > 0) bytes.resize(bytes.size() + std::size_t(by));
        if (by < 0) bytes.erase(bytes.end() + by, bytes.end());
        put_checksum(bytes);
        save_file(path, bytes);
        return why_not(path).starts_with(cannot + "it declares ") &&
               why_not(path).ends_with(", which does not match its " +
                                       std::to_string(bytes.size()) + " bytes.");
    };
    CHECK(longer(24));
    CHECK(longer(-24));
    CHECK(longer(1));
    CHECK(longer(-1));
    Bytes no_key(whole.begin(), whole.begin() + 44);
    put_checksum(no_key);
    save_file(path, no_key);
    CHECK(why_not(path) == cannot + "it ends in the middle of its key.");
    CHECK(with(light, {0, 0, 0, 0, 0, 0, 240, 127}) ==
          cannot + "it has irradiance that is not finite or is below 0.");
    for (const std::size_t channel : {0u, 8u, 16u}) // -1 each
        CHECK(with(light - channel, {0, 0, 0, 0, 0, 0, 240, 191}) ==
              cannot + "it has irradiance that is not finite or is below 0.");
    save_file(path, whole);
    CHECK_THROWS_AS((void)load_light_map(path, {}, 2), std::runtime_error);
    const std::string text = "P6 a picture";
    save_file(path, Bytes(text.begin(), text.end()));
    CHECK(why_not(path).starts_with(cannot + "it does not begin with 'ljus light map"));
    CHECK_THROWS_AS(save_light_map(folder.file("nowhere/a"), {}), std::runtime_error);
}

TEST_CASE("light_map: the limit of a file's bytes, and none without one") {
    constexpr std::size_t all = static_cast<std::size_t>(-1);
    CHECK(detail::file_limit(3, 42) == 48 + 3 * 42);
    CHECK(detail::file_limit(0, 42) == 48);
    CHECK(detail::file_limit(all, 42) == all);
    CHECK(detail::file_limit(all / 42, 42) == all);
    // The front counts, too: never beyond what a number holds, and so less again.
    for (const std::size_t bytes : {1u, 8u, 24u, 38u, 42u, 96u})
        for (std::size_t below = 0; below < 60; ++below) {
            const std::size_t most = all / bytes - below;
            CHECK(detail::file_limit(most, bytes) >= most);
        }
}
