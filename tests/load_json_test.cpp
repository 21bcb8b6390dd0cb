#include <doctest/doctest.h>

// Scene files need nlohmann-json, the library does not.
#if __has_include(<nlohmann/json.hpp>)

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ljus/io/load_json.hpp"
#include "ljus/io/png.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/scene/world.hpp"
#include "scratch_folder.hpp"
#include "support/refusal.hpp"

using namespace ljus;

namespace {

// A scene with each material and each type of object; numbered from 0: floor, lamp,
// ball, wedge.
const std::string good = R"({
 "format": "see README.md",
 "name": "four things",
 "description": "for the tests",
 "camera": {"position": [0, 1, 5], "look_at": [0, 1, 0], "up": [0, 1, 0],
            "vfov_deg": 40},
 "image": {"width": 30, "height": 20, "pixel_filter": "box, exactly one pixel wide"},
 "materials": {
  "matt": {"type": "lambertian", "albedo": [0.75, 0.5, 0.25]},
  "rough": {"type": "oren-nayar", "albedo": [0.5, 0.5, 0.5], "sigma_deg": 30},
  "mirror": {"type": "mirror", "reflectance": [0.9, 0.8, 0.7]},
  "glass": {"type": "dielectric", "ior": 1.5}
 },
 "objects": [
  {"type": "triangles", "name": "floor", "material": "matt",
   "vertices": [[-2, 0, -2], [-2, 0, 2], [2, 0, 2], [2, 0, -2]],
   "indices": [[0, 1, 2], [0, 2, 3]]},
  {"type": "triangles", "name": "lamp", "material": "rough",
   "vertices": [[-0.6, 3, -0.6], [0.6, 3, -0.6], [0.6, 3, 0.6], [-0.6, 3, 0.6]],
   "indices": [[0, 1, 2], [0, 2, 3]], "emission": [5, 4, 2.5]},
  {"type": "sphere", "name": "ball", "material": "glass", "center": [0.5, 1, 0],
   "radius": 0.75},
  {"type": "triangles", "material": "mirror",
   "vertices": [[-1, 1, 0], [-1.5, 1, 0.5], [-1, 2, 0]], "indices": [[0, 1, 2]]}
 ]
})";

// The good scene with one place changed.
std::string changed(const std::string& from, const std::string& to) {
    const std::size_t at = good.find(from);
    REQUIRE_MESSAGE(at != std::string::npos, "the scene has no ", from);
    std::string text = good;
    return text.replace(at, from.size(), to);
}

// What reads meshes: one type in all cases, so that the reader is compiled once.
using ReadMeshes = std::function<LoadedMesh(const std::string&, MeshFileSettings)>;
const ReadMeshes no_meshes = detail::NoMeshesT<float>{}; // what is the default

// The content of a mesh file.
template <typename... M>
LoadedMesh of_meshes(M... meshes) {
    LoadedMesh loaded;
    (loaded.parts.push_back({std::move(meshes), {}}), ...);
    return loaded;
}

LoadedScene read(const std::string& text, const ReadMeshes& meshes = no_meshes,
                 const std::string& file = "a.json") {
    return read_json_scene(text, file, meshes);
}

// The sentence with which a text is refused.
std::string refusal(const std::string& text, const ReadMeshes& meshes = no_meshes,
                    const std::string& file = "a.json") {
    return ljus_test::refusal<std::runtime_error>(
        [&] { (void)read(text, meshes, file); }, "accepted");
}

std::string refusal(const std::string& from, const std::string& to) {
    return refusal(changed(from, to));
}

// A text is refused with the name of its file and this sentence.
void refused(const std::string& text, const char* sentence,
             const ReadMeshes& meshes = no_meshes) {
    CHECK(refusal(text, meshes) == std::string("a.json: ") + sentence);
}

// The good scene is, with one place changed.
void refused(const char* from, const std::string& to, const char* sentence) {
    INFO("instead of ", std::string(from), " the scene has ", to);
    refused(changed(from, to), sentence);
}

// A place of the good scene, what is there instead, and the sentence.
struct Row {
    const char *from, *to, *sentence;
};
void refused(std::initializer_list<Row> rows) {
    for (const Row& row : rows) refused(row.from, row.to, row.sentence);
}

using Board = Textured<Lambertian, CheckerT<float, detail::FileMapT<float>>>;
using Wallpaper = Textured<Lambertian, PictureTextureT<float, detail::FileMapT<float>>>;

} // namespace

TEST_CASE("load_json: everything in the file is in the scene") {
    LoadedScene loaded = read(good);
    CHECK(loaded.name == "four things");
    CHECK(loaded.width == 30);
    CHECK(loaded.height == 20);

    const auto& scene = loaded.scene;
    CHECK(scene.size() == 4);
    const auto& quads = std::get<0>(scene.shapes);
    const auto& spheres = std::get<1>(scene.shapes);
    const auto& triangles = std::get<2>(scene.shapes);
    REQUIRE(quads.size() == 2);
    REQUIRE(spheres.size() == 1);
    REQUIRE(triangles.size() == 1);
    CHECK(normal(quads[0]) == Vec3{0, 1, 0});
    CHECK(area(quads[0]) == 16.0f);
    CHECK(normal(quads[1]).y == doctest::Approx(-1)); // the lamp faces down
    CHECK(spheres[0].center == Vec3{0.5f, 1, 0});
    CHECK(spheres[0].radius == 0.75f);
    CHECK(triangles[0].v2 == Vec3{-1.5f, 1, 0.5f});

    const auto& rough = std::get<1>(scene.materials);
    REQUIRE(rough.size() == 1);
    CHECK(rough[0].sigma == doctest::Approx(std::numbers::pi / 6));
    const auto& mirrors = std::get<2>(scene.materials);
    REQUIRE(mirrors.size() == 1);
    CHECK(mirrors[0].reflectance == Rgb{0.9f, 0.8f, 0.7f});
    const auto& glasses = std::get<3>(scene.materials);
    REQUIRE(glasses.size() == 1);
    CHECK(glasses[0].base.index == 1.5f);
    const World world(std::move(loaded.scene));
    CHECK(world
              .visit_material(world.object({0, 0}).material,
                              [](const auto& m) {
                                  return evaluate(m, Vec3{0, 0, 1}, Vec3{0, 0, 1}) *
                                         std::numbers::pi_v<float>;
                              })
              .x == doctest::Approx(0.75));
}

TEST_CASE("load_json: a lamp of two triangles is one light") {
    LoadedScene loaded = read(good);
    const World world(std::move(loaded.scene));
    REQUIRE(world.light_count() == 1);
    world.visit_light(0, [](const auto& light) {
        if constexpr (requires { light.lamp; })
            CHECK(light.lamp.radiance == Rgb{5, 4, 2.5f});
        else
            FAIL("the lamp is no object");
    });
    CHECK(world.powers()[0].x == doctest::Approx(5 * 1.44 * std::numbers::pi));
}

TEST_CASE("load_json: the camera sees what it looks at in the middle") {
    const LoadedScene loaded = read(good);
    const Ray ray = primary_ray(loaded.camera.pinhole, Vec2{15, 10}, 30, 20);
    CHECK(ray.origin == Vec3{0, 1, 5});
    CHECK(glm::distance(ray.direction, Vec3{0, 0, -1}) < 1e-6f);
    // The upper edge of the picture lies at half the angle.
    const Ray up = primary_ray(loaded.camera.pinhole, Vec2{15, 0}, 30, 20);
    CHECK(up.direction.y / -up.direction.z ==
          doctest::Approx(std::tan(20 * std::numbers::pi / 180)));
}

TEST_CASE("load_json: what may be missing may be missing") {
    for (const auto& [from, to] :
         {std::pair{" \"format\": \"see README.md\",", ""},
          {" \"name\": \"four things\",", ""},
          {" \"description\": \"for the tests\",", ""},
          {", \"pixel_filter\": \"box, exactly one pixel wide\"", ""},
          {" \"name\": \"ball\",", ""},
          {"\"name\": \"ball\"", "\"name\": null"}})
        CHECK(refusal(from, to) == "accepted");
    const LoadedScene unnamed = read(changed("\"four things\"", "null"));
    CHECK(unnamed.name.empty());
}

TEST_CASE(
    "load_json: an error names the file, the field, its value and what is right") {
    refused({
        {"\"radius\": 0.75", "\"radius\": -1",
         "objects[2].radius is -1; it must be above 0."},
        {"\"radius\": 0.75", "\"radius\": 0",
         "objects[2].radius is 0; it must be above 0."},
        // Above 0 in double, 0 in float.
        {"\"radius\": 0.75", "\"radius\": 1e-60",
         "objects[2].radius is 1e-60; it must be above 0."},
        {"\"radius\": 0.75", "\"radius\": \"big\"",
         "objects[2].radius is \"big\"; it must be a number."},
        {"\"radius\": 0.75", "\"radius\": 2e9",
         "objects[2].radius is 2000000000.0; it must be at most 1e9."},
        {"0.75, 0.5, 0.25", "0.75, 1.5, 0.25",
         "materials.matt.albedo[1] is 1.5; it must be within [0, 1]."},
        {"0.75, 0.5, 0.25", "0.75, -0.1, 0.25",
         "materials.matt.albedo[1] is -0.1; it must be within [0, 1]."},
        {"0.75, 0.5, 0.25", "0.75, 0.5",
         "materials.matt.albedo is [0.75,0.5]; it must be a list of three numbers."},
        {"0.75, 0.5, 0.25", "0.75, null, 0.25",
         "materials.matt.albedo[1] is null; it must be a number."},
        {"0.9, 0.8, 0.7", "0.9, 0.8, 7",
         "materials.mirror.reflectance[2] is 7; it must be within [0, 1]."},
        {"\"sigma_deg\": 30", "\"sigma_deg\": 100",
         "materials.rough.sigma_deg is 100; it must be within [0, 90] degrees."},
        {"\"ior\": 1.5", "\"ior\": 0",
         "materials.glass.ior is 0; it must be within [0.001, 1000]."},
        {"[5, 4, 2.5]", "[5, -4, 2.5]",
         "objects[1].emission[1] is -4; it must be within [0, 1e12]."},
        {"[0.5, 1, 0]", "[0.5, 1e300, 0]",
         "objects[2].center[1] is 1e+300; it must be within [-1e9, 1e9]."},
        {"\"vfov_deg\": 40", "\"vfov_deg\": 180",
         "camera.vfov_deg is 180; it must be within [0.001, 179.99] degrees."},
        {"\"look_at\": [0, 1, 0]", "\"look_at\": [0, 1, 5]",
         "camera.look_at is [0,1,5]; it must be another point than camera.position."},
        {"\"up\": [0, 1, 0]", "\"up\": [0, 0, 2]",
         "camera.up is [0,0,2]; it must be a direction that is not along the view."},
        {"\"up\": [0, 1, 0]", "\"up\": [0, 0, 0]",
         "camera.up is [0,0,0]; it must be a direction that is not along the view."},
        {"\"width\": 30", "\"width\": 0",
         "image.width is 0; it must be a whole number within [1, 268435456]."},
        {"\"width\": 30", "\"width\": 30.5",
         "image.width is 30.5; it must be a whole number within [1, 268435456]."},
        {"\"width\": 30", "\"width\": 100000000000000000000",
         "image.width is 1e+20; it must be a whole number within [1, 268435456]."},
        {"\"width\": 30, \"height\": 20", "\"width\": 200000, \"height\": 200000",
         "image has more than 268435456 pixels."},
        {"box, exactly one pixel wide", "gaussian",
         "image.pixel_filter is \"gaussian\"; it must be \"box\", the only filter that "
         "scene files support."},
        {"\"name\": \"four things\"", "\"name\": 4",
         "name is 4; it must be a text in quotation marks."},
        {"\"name\": \"ball\"", "\"name\": 4",
         "objects[2].name is 4; it must be a text in quotation marks."},
    });
}

namespace {

// The good scene with another object in front of the others.
std::string object(const std::string& fields) {
    return changed("\"objects\": [",
                   R"("objects": [{"material": "matt", )" + fields + "}, ");
}

} // namespace

TEST_CASE("load_json: quads, boxes, discs and cylinders") {
    const auto scene = [](const std::string& fields) {
        return read(object(fields)).scene;
    };
    const auto quad = scene(
        R"("type": "quad", "corner": [1, 2, 3], "edge_u": [2, 0, 0], "edge_v": [0, 1, 1],
           "emission": [1, 2, 3])");
    const Quad& first = std::get<std::vector<Quad>>(quad.shapes).at(0);
    CHECK(first.corner == Vec3{1, 2, 3});
    CHECK(first.edge_u == Vec3{2, 0, 0});
    CHECK(first.edge_v == Vec3{0, 1, 1});
    CHECK(quad.objects[0][0].emission == Rgb{1, 2, 3});
    const auto box = scene(R"("type": "box", "low": [0, 0, 0], "high": [1, 2, 4])");
    const auto& sides = std::get<std::vector<Quad>>(box.shapes);
    REQUIRE(sides.size() == 8); // with two quads of the good scene
    float all = 0;
    for (std::size_t i = 0; i < 6; ++i) all += area(sides[i]);
    CHECK(all == 2 * (1 * 2 + 2 * 4 + 4 * 1));
    const auto disc = scene(
        R"("type": "disc", "center": [1, 2, 3], "normal": [0, -2, 0], "radius": 0.5)");
    const Disc& round = std::get<std::vector<Disc>>(disc.shapes).at(0);
    CHECK(round.center == Vec3{1, 2, 3});
    CHECK(normal(round) == Vec3{0, -1, 0});
    CHECK(round.radius == 0.5f);
    const std::string tube =
        R"("type": "cylinder", "base": [1, 2, 3], "axis": [0, 2, 0], "radius": 0.5)";
    const auto open = scene(tube), closed = scene(tube + R"(, "ends": "closed")");
    const Cylinder& pipe = std::get<std::vector<Cylinder>>(open.shapes).at(0);
    CHECK(pipe.base == Vec3{1, 2, 3});
    CHECK(pipe.axis == Vec3{0, 2, 0});
    CHECK(pipe.radius == 0.5f);
    CHECK(std::get<std::vector<Disc>>(open.shapes).empty());
    CHECK(std::get<std::vector<Cylinder>>(closed.shapes).size() == 1);
    CHECK(std::get<std::vector<Disc>>(closed.shapes).size() == 2);

    refused(object(R"("type": "box", "low": [0, 0, 0], "high": [1, 0, 4])"),
            "objects[0].high is [1,0,4]; it must be above low along x, y and z.");
    refused(object(R"("type": "quad", "corner": [0, 0, 0], "edge_u": [1, 2, 3],
                      "edge_v": [2, 4, 6])"),
            "objects[0].edge_v is [2,4,6]; it must be a vector that is not along "
            "edge_u.");
    refused(object(R"("type": "disc", "center": [0, 0, 0], "normal": [0, 0, 0],
                      "radius": 1)"),
            "objects[0].normal is [0,0,0]; it must be a vector that is not 0.");
    refused(object(tube + R"(, "ends": "close")"),
            "objects[0].ends is \"close\"; did you mean \"closed\"? It must be open or "
            "closed.");
}

TEST_CASE("load_json: objects are scaled, turned and displaced") {
    const auto sphere = [](const std::string& transform) {
        return object(R"("type": "sphere", "center": [1, 0, 0], "radius": 0.5,
                         "transform": )" +
                      transform);
    };
    const auto scene = read(sphere(R"({"scale": 2, "translate": [0, 5, 0],
            "rotate": {"axis": [0, 0, 1], "degrees": 90}})"))
                           .scene;
    const Sphere& placed_one = std::get<std::vector<Sphere>>(scene.shapes).at(0);
    CHECK(placed_one.center == Vec3{0, 7, 0});
    CHECK(placed_one.radius == 1);
    auto box = read(object(R"("type": "box", "low": [0, 0, 0], "high": [1, 1, 1],
                  "transform": {"scale": [1, 2, 4]})"));
    const World world(std::move(box.scene));
    CHECK(world.box().high.z >= 4);

    refused(sphere(R"({"scale": [1, 1, 2]})"),
            "objects[0] cannot be used: the scale of a sphere is (1, 1, 2); it must be "
            "the same along x, y and z.");
    refused(sphere(R"({"scale": -1})"),
            "objects[0].transform.scale is -1; it must be within [1e-9, 1e9].");
    refused(sphere(R"({"rotate": {"axis": [0, 0, 0], "degrees": 1}})"),
            "objects[0].transform.rotate.axis is [0,0,0]; it must be a vector that is "
            "not 0.");
    refused(sphere(R"({"rotation": 1})"),
            "objects[0].transform.rotation is not known; the fields here are scale, "
            "rotate and translate.");
}

TEST_CASE("load_json: a mesh file is placed wherever it is named") {
    int calls = 0;
    const auto load = [&](const std::string&, const MeshFileSettings&) {
        ++calls;
        return of_meshes(Mesh({.positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                               .normals{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
                               .triangles{{0, 1, 2}}}));
    };
    const auto mesh = [](const std::string& rest) {
        return R"({"type": "mesh", "file": "m.obj", "material": "matt")" + rest + "}, ";
    };
    const std::string moved = mesh(R"(, "transform": {"translate": [0, 0, 7],
                                    "rotate": {"axis": [1, 0, 0], "degrees": 90}})");
    for (const bool first : {true, false}) {
        calls = 0;
        const std::string two = first ? moved + mesh("") : mesh("") + moved;
        const auto loaded =
            read(changed("\"objects\": [", "\"objects\": [" + two + moved), load);
        const auto& meshes = std::get<std::vector<Mesh>>(loaded.scene.shapes);
        REQUIRE(meshes.size() == 3);
        CHECK(calls == 1);
        const std::size_t still = first ? 1 : 0;
        CHECK(meshes[still].data().positions[2] == Vec3{0, 1, 0});
        CHECK(meshes[still].data().normals[0] == Vec3{0, 0, 1});
        for (const std::size_t there : {1 - still, std::size_t(2)}) {
            CHECK(meshes[there].data().positions[2] == Vec3{0, 0, 8});
            CHECK(meshes[there].data().normals[0] == Vec3{0, -1, 0});
        }
    }
}

TEST_CASE("load_json: what moves while the shutter is open") {
    const auto scene = [](const char* shape) {
        return read(object(std::string(shape) + R"(, "displacement": [0.5, 0, 1])"))
            .scene;
    };
    const auto ball = scene(R"("type": "sphere", "center": [1, 0, 0], "radius": 0.5)");
    const auto& balls = std::get<std::vector<Moving<Sphere>>>(ball.shapes);
    REQUIRE(balls.size() == 1);
    CHECK(balls[0].shape.center == Vec3{1, 0, 0});
    CHECK(balls[0].displacement == Vec3{0.5f, 0, 1});
    const auto box = scene(R"("type": "box", "low": [0, 0, 0], "high": [1, 1, 1])");
    CHECK(std::get<std::vector<Moving<Quad>>>(box.shapes).size() == 6);
    const auto triangle = scene(R"("type": "triangles", "indices": [[0, 1, 2]],
        "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]])");
    CHECK(std::get<std::vector<Moving<Triangle>>>(triangle.shapes).size() == 1);
    refused(
        object(R"("type": "disc", "center": [0, 0, 0], "normal": [0, 1, 0],
                      "radius": 1, "displacement": [0, 0, 1])"),
        "objects[0].displacement belongs to spheres, quads, boxes and triangles; in "
        "a scene file other shapes do not move.");
}

TEST_CASE("load_json: a lens, and without one a pinhole") {
    const auto lens = [](const std::string& text) {
        return changed("\"vfov_deg\": 40", "\"vfov_deg\": 40, \"lens\": " + text);
    };
    CHECK(read(good).camera.radius == 0);
    const auto camera = read(lens(R"({"radius": 0.25, "focus": 3})")).camera;
    CHECK(camera.radius == 0.25f);
    CHECK(camera.focus == 3);
    refused(lens(R"({"radius": 0.25})"), "camera.lens.focus is missing.");
    refused(lens(R"({"radius": -1, "focus": 3})"),
            "camera.lens.radius is -1; it must be within [0, 1e9].");
    refused(lens(R"({"radius": 1, "focus": 0})"),
            "camera.lens.focus is 0; it must be above 0.");
    refused(lens(R"({"aperture": 1, "focus": 3})"),
            "camera.lens.aperture is not known; the fields here are radius and focus.");
}

TEST_CASE("load_json: groups of lamps are dimmed together") {
    const auto grouped = [](const std::string& groups) {
        std::string text =
            changed("\"emission\": [5, 4, 2.5]",
                    "\"emission\": [5, 4, 2.5], \"lamp_group\": \"top\"");
        const std::string end = "\n ]\n}";
        return text.replace(text.rfind(end), end.size(),
                            "\n ], \"lights\": [{\"type\": \"point\", \"position\": "
                            "[0, 2, 0], \"intensity\": [1, 2, 3], \"lamp_group\": "
                            "\"top\"}, {\"type\": \"sun\", \"direction\": [0, -1, 0], "
                            "\"irradiance\": [1, 1, 1]}]" +
                                groups + "}");
    };
    const auto dim = read(grouped(R"(, "lamp_groups": {"top": 0.5, "side": 1})")).scene;
    CHECK(dim.objects[0][1].emission == Rgb{2.5f, 2, 1.25f});
    CHECK(std::get<0>(dim.lights).at(0).intensity == Rgb{0.5f, 1, 1.5f});
    CHECK(std::get<2>(dim.lights).at(0).irradiance == Rgb{1});
    const auto off = read(grouped(R"(, "lamp_groups": {"top": 0})")).scene;
    CHECK(off.light_count() == 1);
    refused(
        grouped(R"(, "lamp_groups": {"topp": 0})"),
        "objects[1].lamp_group is \"top\"; did you mean \"topp\"? It must be one of "
        "the lamp_groups topp.");
    refused(grouped(""), "objects[1].lamp_group is \"top\"; it must be a name of "
                         "lamp_groups, which the file lacks.");
    refused(grouped(R"(, "lamp_groups": {"top": -1})"),
            "lamp_groups.top is -1; it must be within [0, 1e9].");
}

TEST_CASE("load_json: for a wrong word the nearest one is proposed") {
    refused({
        {"\"type\": \"lambertian\"", "\"type\": \"lambert\"",
         "materials.matt.type is \"lambert\"; did you mean \"lambertian\"? It must be "
         "lambertian, oren-nayar, mirror, dielectric, mixture, oren-nayar-full, "
         "oren-nayar-printed, fujii, fon, eon, metal, rough-metal, full-rough-metal, "
         "glossy, full-glossy, rough-glass, dispersive-glass, measured-glass, "
         "thin-glass, soap-film, checker, picture, mapped or picture-lamp."},
        {"\"type\": \"sphere\"", "\"type\": \"shpere\"",
         "objects[2].type is \"shpere\"; did you mean \"sphere\"? It must be sphere, "
         "triangles, mesh, instances, quad, box, disc or cylinder."},
        {"\"material\": \"glass\"", "\"material\": \"Glas\"",
         "objects[2].material is \"Glas\"; did you mean \"glass\"? It must be one of "
         "the materials glass, matt, mirror or rough."},
    });
}

TEST_CASE("load_json: numbers of vertices are checked") {
    refused({
        {"[[0, 1, 2], [0, 2, 3]]}", "[[0, 1, 2], [0, 2, 4]]}",
         "objects[0].indices[1][2] is 4; it must be a whole number within [0, 3]."},
        {"[[0, 1, 2], [0, 2, 3]]}", "[[0, 1, -1], [0, 2, 3]]}",
         "objects[0].indices[0][2] is -1; it must be a whole number within [0, 3]."},
        {"[[0, 1, 2], [0, 2, 3]]}", "[[0, 1, 4294967296]]}",
         "objects[0].indices[0][2] is 4294967296; it must be a whole number within [0, "
         "3]."},
        {"[[0, 1, 2], [0, 2, 3]]}", "[[0, 1, 2, 3]]}",
         "objects[0].indices[0] is [0,1,2,3]; it must be a list of three numbers."},
        {"[[0, 1, 2], [0, 2, 3]]}", "[[0, 1, 1]]}",
         "objects[0].indices[0] is a triangle without an area."},
        {"[[-1, 1, 0], [-1.5, 1, 0.5], [-1, 2, 0]]", "[]",
         "objects[3].indices[0][0] names a vertex, but there are none."},
        {"\"indices\": [[0, 1, 2]]", "\"indices\": 7",
         "objects[3].indices is 7; it must be a list."},
    });
}

// The good scene with another glass.
static std::string with(const std::string& material) {
    return changed("{\"type\": \"dielectric\", \"ior\": 1.5}", material);
}

TEST_CASE("load_json: metal, rough matt, gloss and checkers") {
    const auto first = [](const std::string& material, auto type) {
        const LoadedScene loaded = read(with(material));
        return std::get<std::vector<decltype(type)>>(loaded.scene.materials).at(0);
    };
    CHECK(first(R"({"type": "metal", "metal": "silver"})", Metal{}).index.k ==
          silver<float>.k);
    const Eon eon =
        first(R"({"type": "eon", "albedo": [0.5, 0.25, 1], "roughness": 0.5})", Eon{});
    CHECK(eon.albedo == Rgb{0.5f, 0.25f, 1});
    CHECK(eon.roughness == 0.5f);
    const Glossy gloss =
        first(R"({"type": "glossy", "reflectance": [0.5, 0.25, 1], "roughness": 0.25})",
              Glossy{});
    CHECK(gloss.reflectance == Rgb{0.5f, 0.25f, 1});
    CHECK(gloss.roughness == 0.25f);
    const auto board = first(R"({"type": "checker", "even": [1, 1, 1], "odd": [0, 0, 0],
        "origin": [1, 2, 3], "edge_u": [2, 0, 0], "edge_v": [0, 0, 4]})",
                             Board{});
    CHECK(material_at(board, Vec3{1.5f, 0, 3.5f}, Vec2{0}).albedo == Rgb{1});
    CHECK(material_at(board, Vec3{2.5f, 0, 3.5f}, Vec2{0}).albedo == Rgb{0});

    refused(with(R"({"type": "metal", "metal": "tin"})"),
            "materials.glass.metal is \"tin\"; it must be gold, copper or silver.");
    refused(with(R"({"type": "glossy", "reflectance": [1, 1, 1], "roughness": 0.001})"),
            "materials.glass.roughness is 0.001; it must be 0 or within [0.01, 1].");
    refused(with(R"({"type": "eon", "albedo": [1, 1, 1], "roughness": 2})"),
            "materials.glass.roughness is 2; it must be within [0, 1].");
    refused(with(R"({"type": "checker", "even": [1, 1, 1], "odd": [0, 0, 0],
        "origin": [1, 2, 3], "edge_u": [0, 0, 0], "edge_v": [0, 0, 4]})"),
            "materials.glass.edge_u is [0,0,0]; it must be a vector that is not 0.");
}

TEST_CASE("load_json: panes, soap and gloss that keeps its light") {
    const auto film = [&](const std::string& rest) {
        return with(R"({"type": "soap-film", "ior": 1.33, "thickness_nm": 400)" + rest +
                    "}");
    };
    const LoadedScene soap =
        read(film(R"(, "scale": 2, "level": [1, 2, 3], "up": [0, 5, 0])"));
    const SoapFilm& thin = std::get<std::vector<SoapFilm>>(soap.scene.materials).at(0);
    CHECK(thin.color == FilmColor::table);
    CHECK(thickness_at(thin, Vec3{9, 2, 9}) == 400);
    CHECK(thickness_at(thin, Vec3{9, 4, 9}) == doctest::Approx(400 * std::exp(-1.0)));
    const LoadedScene pane =
        read(with(R"({"type": "thin-glass", "ior": 1.5, "tint": [1, 0.5, 1]})"));
    CHECK(std::get<std::vector<ThinGlass>>(pane.scene.materials).at(0).tint ==
          Rgb{1, 0.5f, 1});
    const LoadedScene gloss = read(
        with(R"({"type": "full-glossy", "reflectance": [1, 1, 1], "roughness": 0.5})"));
    CHECK(std::get<std::vector<CompensatedGlossy>>(gloss.scene.materials)
              .at(0)
              .loss.mean > 0);

    refused(film(R"(, "scale": 2)"), "materials.glass.up is missing.");
    refused(film(R"(, "level": [1, 2, 3])"), "materials.glass.up is missing.");
    refused(film(R"(, "up": [0, 5, 0])"), "materials.glass.scale is missing.");
    refused(film(R"(, "scale": 2, "level": [0, 0, 0], "up": [0, 0, 0])"),
            "materials.glass.up is [0,0,0]; it must be a vector that is not 0.");
    refused(with(R"({"type": "soap-film", "ior": 1.33, "thickness_nm": -1})"),
            "materials.glass.thickness_nm is -1; it must be within [0, 1e6] nm.");
    refused(with(R"({"type": "thin-glass", "ior": 0, "tint": [1, 1, 1]})"),
            "materials.glass.ior is 0; it must be within [0.001, 1000].");
}

TEST_CASE("load_json: the report's sliders") {
    const auto mixture = [](const std::string& rest) {
        return with(R"({"type": "mixture", "color": [0.5, 0.25, 1])" + rest + "}");
    };
    const auto made = [&](const std::string& rest) {
        const LoadedScene loaded = read(mixture(rest));
        return std::get<std::vector<Nested<Mixture>>>(loaded.scene.materials).at(0);
    };
    const Mixture plain = made("").base;
    CHECK(made("").priority == 0);
    CHECK(made(R"(, "priority": 3)").priority == 3);
    CHECK(plain.color == Rgb{0.5f, 0.25f, 1});
    CHECK(plain.index == 1.5f);
    for (const float slider :
         {plain.reflectivity, plain.transparency, plain.specularity, plain.emissivity,
          plain.sigma, plain.absorption.x})
        CHECK(slider == 0);
    const Mixture all = made(R"(, "reflectivity": 0.125, "transparency": 0.5,
        "ior": 1.25, "specularity": 0.75, "emissivity": 3, "sigma_deg": 90,
        "absorption": [1, 2, 3])")
                            .base;
    CHECK(all.reflectivity == 0.125f);
    CHECK(all.transparency == 0.5f);
    CHECK(all.index == 1.25f);
    CHECK(all.specularity == 0.75f);
    CHECK(all.emissivity == 3);
    CHECK(all.sigma == doctest::Approx(std::numbers::pi / 2));
    CHECK(all.absorption == Rgb{1, 2, 3});
    // A ball whose material shines is a light.
    CHECK(read(mixture(R"(, "emissivity": 3)")).scene.light_count() == 2);

    refused(mixture(R"(, "reflectivity": 1.5)"),
            "materials.glass.reflectivity is 1.5; it must be within [0, 1].");
    refused(mixture(R"(, "emissivity": -1)"),
            "materials.glass.emissivity is -1; it must be within [0, 1e12].");
    refused(mixture(R"(, "shininess": 1)"),
            "materials.glass.shininess is not known; the fields here are type, color, "
            "reflectivity, transparency, ior, specularity, emissivity, sigma_deg, "
            "absorption and priority.");
}

TEST_CASE("load_json: each name makes its own material") {
    // The type of the material of the ball, as the scene numbers them, and f there.
    const auto f = [](const std::string& material) {
        const World world(read(with(material)).scene);
        return world.visit_material(world.object({1, 0}).material, [](const auto& m) {
            const Vec3 tilted{0.6f, 0, 0.8f}, back{-0.48f, 0.36f, 0.8f};
            return evaluate(m, tilted, back);
        });
    };
    const Vec3 wo{0.6f, 0, 0.8f}, wi{-0.48f, 0.36f, 0.8f};
    const std::pair<const char*, RoughModel> models[]{
        {"oren-nayar-full", RoughModel::full},
        {"oren-nayar-printed", RoughModel::as_printed},
        {"fujii", RoughModel::fujii}};
    for (const auto& [name, model] : models) {
        const RoughDiffuse right{Rgb{0.5f}, std::numbers::pi_v<float> / 6, model};
        CHECK(f(R"({"type": ")" + std::string(name) +
                R"(", "albedo": [0.5, 0.5, 0.5], "sigma_deg": 30})")
                  .x == doctest::Approx(evaluate(right, wo, wi).x));
    }
    CHECK(f(R"({"type": "fon", "albedo": [0.5, 0.5, 0.5], "roughness": 0.75})").x ==
          evaluate(RoughDiffuse{Rgb{0.5f}, 0.75f, RoughModel::fon}, wo, wi).x);
    const RoughMetal copper_{copper<float>, 0.5f};
    CHECK(f(R"({"type": "rough-metal", "metal": "copper", "roughness": 0.5})") ==
          evaluate(copper_, wo, wi));
    CHECK(f(R"({"type": "full-rough-metal", "metal": "copper", "roughness": 0.5})") ==
          evaluate(compensated_glossy(copper_), wo, wi));
    const LoadedScene green =
        read(with(R"({"type": "dielectric", "ior": 1.25, "absorption": [3, 0, 3]})"));
    const auto& glasses = std::get<std::vector<Nested<Glass>>>(green.scene.materials);
    CHECK(glasses.at(0).base.absorption == Rgb{3, 0, 3});
    CHECK(glasses.at(0).priority == 0);
    const World in_order(
        read(with(R"({"type": "dielectric", "ior": 1.3, "priority": 2})")).scene);
    CHECK(in_order.has_priorities());
    CHECK_FALSE(World(read(with(R"({"type": "dielectric", "ior": 1.3})")).scene)
                    .has_priorities());
    const LoadedScene frosted =
        read(with(R"({"type": "rough-glass", "ior": 1.25, "roughness": 0.5,
                                 "absorption": [3, 0, 3]})"));
    const RoughGlass frost =
        std::get<std::vector<Nested<RoughGlass>>>(frosted.scene.materials).at(0).base;
    CHECK(frost.index == 1.25f);
    CHECK(frost.roughness == 0.5f);
    CHECK(frost.absorption == Rgb{3, 0, 3});
    using Flint = DispersiveGlassT<float, Cauchy>;
    const LoadedScene made =
        read(with(R"({"type": "dispersive-glass", "ior": 1.75, "abbe": 28,
                                 "absorption": [3, 0, 3]})"));
    const Flint flint =
        std::get<std::vector<Nested<Flint>>>(made.scene.materials).at(0).base;
    CHECK(refractive_index(flint) == doctest::Approx(1.75));
    CHECK(abbe_number(flint.law) == doctest::Approx(28));
    CHECK(flint.absorption == Rgb{3, 0, 3});
    const std::pair<const char*, Sellmeier> media[] = {{"bk7", bk7<float>},
                                                       {"sf10", sf10<float>},
                                                       {"sf66", sf66<float>},
                                                       {"water", water<float>},
                                                       {"diamond", diamond<float>}};
    for (const auto& [name, law] : media) {
        const LoadedScene measured =
            read(with(R"({"type": "measured-glass", "medium": ")" + std::string(name) +
                      R"(", "absorption": [3, 0, 3]})"));
        const auto glass =
            std::get<std::vector<Nested<DispersiveGlass>>>(measured.scene.materials)
                .at(0)
                .base;
        CHECK(glass.law.b == law.b);
        CHECK(glass.absorption == Rgb{3, 0, 3});
    }
}

TEST_CASE("load_json: textures by a plane, a globe and the shape's own coordinates") {
    const auto board = [](const std::string& rest) {
        return with(R"({"type": "checker", "even": [1, 1, 1], "odd": [0, 0, 0])" +
                    rest + "}");
    };
    const auto color = [&](const std::string& rest, const Vec3& place, const Vec2& uv) {
        const LoadedScene loaded = read(board(rest));
        return material_at(std::get<std::vector<Board>>(loaded.scene.materials).at(0),
                           place, uv)
            .albedo.x;
    };
    const Vec3 here{0.1f, 0, 0.1f};
    CHECK(color(R"(, "map": "uv")", here, {0.25f, 0.25f}) == 1);
    CHECK(color(R"(, "map": "uv")", here, {0.25f, 0.625f}) == 0);
    CHECK(color(R"(, "map": "uv", "scale": [1, 2])", here, {0.25f, 0.625f}) == 1);
    CHECK(color(R"(, "map": "uv", "scale": [2, 1])", here, {0.625f, 0.25f}) !=
          color(R"(, "map": "uv")", here, {0.625f, 0.25f}));
    CHECK(color(R"(, "map": "uv", "rows": 4)", here, {0.25f, 0.625f}) == 1);
    CHECK(color(R"(, "map": "globe", "center": [0, 0, 0])", {1, 1, -0.1f}, {}) == 0);
    CHECK(color(R"(, "map": "globe", "center": [0, 0, 0])", {1, -1, -0.1f}, {}) == 1);
    CHECK(color(R"(, "map": "plane", "origin": [0, 0, 0], "edge_u": [1, 0, 0],
                "edge_v": [0, 0, 1])",
                {0.75f, 0, 0.25f}, {}) == 0);

    refused(board(R"(, "map": "cube")"),
            "materials.glass.map is \"cube\"; it must be plane, globe or uv.");
    refused(board(R"(, "map": "uv", "center": [0, 0, 0])"),
            "materials.glass.center belongs to the map \"globe\", and the map here is "
            "\"uv\".");
    refused(board(""), "materials.glass.origin is missing.");
    refused(board(R"(, "map": "uv", "scale": [1, 1, 1])"),
            "materials.glass.scale is [1,1,1]; it must be a list of two numbers.");
    refused(board(R"(, "map": "uv", "scale": [1, 0])"),
            "materials.glass cannot be used: uv_map.scale is 0; it must be finite and "
            "not 0.");
    refused(board(R"(, "map": "uv", "columns": 3)"),
            "materials.glass cannot be used: checker.columns is 3; it must be even, "
            "from 2 to 1000000.");
}

TEST_CASE("load_json: a picture as a texture, and one that is not there") {
    const ScratchFolder folder;
    Image image = make_image<float>(2, 1);
    image.pixels = {{1, 0, 0}, {0, 0, 1}};
    save_png(image, folder.file("two.png"));
    const std::string scene =
        with(R"({"type": "picture", "file": "two.png", "map": "uv"})");
    const LoadedScene loaded = read(scene, no_meshes, folder.file("a.json"));
    const Wallpaper& paper =
        std::get<std::vector<Wallpaper>>(loaded.scene.materials).at(0);
    CHECK(material_at(paper, Vec3{5}, Vec2{0.25f, 0.5f}).albedo == Rgb{1, 0, 0});
    CHECK(material_at(paper, Vec3{5}, Vec2{0.75f, 0.5f}).albedo == Rgb{0, 0, 1});
    // On a mesh it is found by the coordinates of the mesh.
    const auto wall = [](const auto&...) {
        return of_meshes(Mesh({.positions{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
                               .triangles{{0, 1, 2}},
                               .uv{{0, 0}, {1, 0}, {0, 1}}}));
    };
    std::string hung = scene;
    const std::string list = "\"objects\": [";
    hung.insert(hung.find(list) + list.size(),
                R"({"type": "mesh", "file": "m.obj", "material": "glass"}, )");
    const World world(read(hung, wall, folder.file("a.json")).scene);
    const Ray ray{.origin{3, 0.5f, 9}, .direction{0, 0, -1}};
    const auto vertex = vertex_at(world, ray, closest_hit(world, ray).value());
    const Vec3 up{0, 0, 1};
    CHECK(visit_material_at(world, vertex, [&](const auto& m) {
              return evaluate(m, up, up);
          }) == Rgb{0, 0, std::numbers::inv_pi_v<float>});
    refused(scene, "materials.glass.file cannot be used: cannot read 'two.png': No "
                   "such file or directory.");
    refused(with(R"({"type": "picture", "file": "a\nb.png", "map": "uv"})"),
            "materials.glass.file cannot be used: cannot read 'a?b.png': No such file "
            "or directory.");
}

TEST_CASE("load_json: the pictures of all materials together are limited") {
    const ScratchFolder folder;
    save_png(make_image<float>(3, 2), folder.file("a.png"));
    const std::string file = folder.file("s.json");
    const nlohmann::json name = "a.png";
    long long pixels = (1 << 25) - 13;
    const auto take = [&] {
        return detail::take_picture<float>({name, file, name}, pixels);
    };
    for (int i = 0; i < 2; ++i) CHECK(take().pixels.size() == 6);
    CHECK(pixels == (1 << 25) - 1);
    CHECK_THROWS_WITH(
        (void)take(),
        (file + ": the file cannot be used: " + folder.file("a.png") +
         " has 3 x 2 pixels, and the pictures before it have 33554431; together there "
         "must be at most 33554432.")
            .c_str());
}

TEST_CASE("load_json: full gloss of one roughness has one table, and at most 64 have") {
    const auto glosses = [](int count, int different) {
        std::string text;
        for (int i = 0; i < count; ++i)
            text += "\"g" + std::to_string(i) +
                    "\": {\"type\": \"full-glossy\", \"reflectance\": [1, 1, 1], "
                    "\"roughness\": " +
                    std::to_string(0.25 + 0.005 * (i % different)) + "},";
        return changed("\"materials\": {", "\"materials\": {" + text);
    };
    // Of 5000 tables that would take a minute.
    const LoadedScene loaded = read(glosses(5000, 2));
    const auto& all = std::get<std::vector<CompensatedGlossy>>(loaded.scene.materials);
    REQUIRE(all.size() == 5000);
    for (const CompensatedGlossy& gloss : all) {
        const CompensatedGlossy& same =
            gloss.first.roughness == 0.25f ? all[0] : all[1];
        CHECK(gloss.loss.at == same.loss.at);
    }
    CHECK(all[1].loss.at == compensated_glossy(all[1].first).loss.at);
    CHECK(all[0].loss.mean == compensated_glossy(all[0].first).loss.mean);
    refused(
        glosses(65, 65),
        "materials.g9.roughness is 0.295; it must be one of the 64 that full-glossy "
        "and full-rough-metal have before it, because each takes a table that is "
        "slow to compute.");
}

// The good scene with a list of lights.
static std::string lit(const std::string& lights) {
    const std::string end = R"("indices": [[0, 1, 2]]}
 ])";
    return changed(end, end + ", \"lights\": [" + lights + "]");
}

TEST_CASE("load_json: a goniometric light and a textured lamp are those of C++") {
    const LoadedScene loaded = read_json_scene(
        lit(R"({"type": "goniometric", "position": [0, 2, 1], "direction": [1, -1, 0],
                "reference": [1, 0, 0], "file": "wall_washer.ies",
                "watts_per_lumen": [1, 2, 3]},
               {"type": "goniometric", "position": [0, 2, 1], "direction": [0, -1, 0],
                "file": "wall_washer.ies"})"),
        LJUS_TEST_INPUTS "/a.json");
    const auto& lamps = std::get<std::vector<GoniometricLight>>(loaded.scene.lights);
    REQUIRE(lamps.size() == 2);
    CHECK(lamps[0].table.candela ==
          load_ies(LJUS_TEST_INPUTS "/wall_washer.ies").table.candela);
    CHECK(lamps[0].position == Vec3{0, 2, 1});
    CHECK(lamps[0].direction == Vec3{1, -1, 0});
    CHECK(lamps[0].reference == Vec3{1, 0, 0});
    CHECK(lamps[0].watts_per_lumen == Rgb{1, 2, 3});
    CHECK(lamps[1].reference == GoniometricLight{}.reference);
    CHECK(lamps[1].watts_per_lumen == GoniometricLight{}.watts_per_lumen);
    const auto one = [](const std::string& rest) {
        return lit(R"({"type": "goniometric", "position": [0, 0, 0], )" + rest + "}");
    };
    CHECK(refusal(one(R"("direction": [0, -1, 0], "file": "none.ies")"))
              .starts_with(
                  "a.json: lights[0].file cannot be used: cannot read 'none.ies'"));
    const std::string washer = R"("file": "wall_washer.ies")";
    const auto why = [&](const std::string& source) {
        return ljus_test::refusal<std::runtime_error>(
            [&] { (void)read_json_scene(source, LJUS_TEST_INPUTS "/a.json"); });
    };
    CHECK(why(one(R"("direction": [0, 0, 2], )" + washer))
              .ends_with("lights[0] cannot be used: goniometric light.reference is "
                         "(0, 0, -1); it must be a vector that is not along the "
                         "direction."));
    std::string many;
    for (int i = 0; i < 1025; ++i)
        many += std::string(i > 0 ? ", " : "") +
                R"({"type": "goniometric", "position": [0, 0, 0],
                    "direction": [0, -1, 0], )" +
                washer + "}";
    CHECK(why(lit(many)).ends_with("lights[1024] is one goniometric light too many; a "
                                   "scene file has at most 1024."));

    const LoadedScene shown =
        read_json_scene(changed(R"("type": "lambertian")",
                                R"("type": "picture-lamp", "file": "tile.png")"),
                        LJUS_TEST_INPUTS "/a.json");
    const auto& pictures = std::get<std::vector<PictureLamp>>(shown.scene.materials);
    REQUIRE(pictures.size() == 1);
    CHECK(pictures[0].picture.pixels ==
          load_image(LJUS_TEST_INPUTS "/tile.png").pixels);
}

TEST_CASE("load_json: an environment is a constant, a gradient or a picture") {
    const auto environment = [](const std::string& fields) {
        const LoadedScene loaded =
            read(lit(R"({"type": "environment", )" + fields + "}"), no_meshes,
                 LJUS_TEST_INPUTS "/a.json");
        return std::get<std::vector<EnvironmentLight>>(loaded.scene.lights).at(0);
    };
    const EnvironmentLight even = environment(R"("radiance": [1, 2, 3])");
    CHECK(even.picture.pixels == std::vector<Rgb>{Rgb{1, 2, 3}});
    CHECK(even.strength == 1);
    CHECK(even.rotation_degrees == 0);
    const EnvironmentLight gradient = environment(
        R"("gradient": {"horizon": [3, 2, 1], "zenith": [1, 1, 4], "ground": [0, 0, 0]},
           "strength": 2.5, "rotation_deg": -90)");
    CHECK(gradient.picture.pixels ==
          gradient_sky(Rgb{3, 2, 1}, Rgb{1, 1, 4}, Rgb{0}).pixels);
    CHECK(gradient.strength == 2.5f);
    CHECK(gradient.rotation_degrees == -90);
    CHECK(environment(R"("file": "spaces.pfm")").picture.pixels ==
          load_pfm(LJUS_TEST_INPUTS "/spaces.pfm").pixels);
    CHECK(environment(R"("file": "crlf.hdr")").picture.pixels ==
          load_hdr(LJUS_TEST_INPUTS "/crlf.hdr").pixels);

    const auto sky = [](const std::string& fields) {
        return lit(R"({"type": "environment")" + fields + "}");
    };
    const std::string even_sky = R"(, "radiance": [1, 1, 1])";
    for (const std::string fields : {"", R"(, "radiance": [1, 1, 1], "file": "a.hdr")"})
        refused(sky(fields),
                "lights[0] must have one of the fields radiance, gradient and file.");
    refused(sky(R"(, "file": "a.png")"),
            "lights[0].file is \"a.png\"; it must be a picture with the ending .hdr, "
            ".pfm or .exr.");
    CHECK(refusal(sky(R"(, "file": "none.exr")"))
              .starts_with("a.json: lights[0].file cannot be used: load_json() reads "
                           "no EXR pictures unless it is given WithExr"));
    CHECK(refusal(sky(R"(, "file": "none.hdr")"))
              .starts_with(
                  "a.json: lights[0].file cannot be used: cannot read 'none.hdr'"));
    refused(sky(R"(, "gradient": {"horizon": [1, 1, 1], "zenith": [1, 1, 1]})"),
            "lights[0].gradient.ground is missing.");
    refused(sky(even_sky + R"(, "strength": 0)"),
            "lights[0].strength is 0; it must be within [1e-9, 1e9].");
    refused(sky(even_sky + R"(, "rotation_deg": 361)"),
            "lights[0].rotation_deg is 361; it must be within [-360, 360] degrees.");
    refused(sky(R"(, "radiance": [0, 0, 0])"),
            "lights[0] cannot be used: environment light.picture is black in every "
            "pixel; leave such a light out of the scene.");
    const std::string one = R"({"type": "environment", "radiance": [1, 1, 1]})";
    refused(lit(one + ", " + one),
            "lights[1] is a second environment; a scene file has at most one.");

    const World open(
        load_json(LJUS_TEST_INPUTS "/../scenes/sky.json", no_meshes).scene);
    CHECK(open.light_count() == 2);
    CHECK(open.can_be_met(0));
    CHECK(!open.can_be_met(1));
}

TEST_CASE("load_json: fog fills a box or a ball") {
    const auto foggy = [](const std::string& fog) {
        const std::string end = R"("indices": [[0, 1, 2]]}
 ])";
        return changed(end, end + ", \"fog\": [" + fog + "]");
    };
    const LoadedScene loaded = read(foggy(
        R"({"type": "box", "low": [-1, 0, -1], "high": [1, 2, 1], "scattering": [1, 2, 3]},
                 {"type": "sphere", "center": [1, 2, 3], "radius": 4, "scattering": [0, 0, 0],
                  "absorption": [3, 2, 1], "g": -0.5})"));
    const auto& [balls, boxes] = loaded.scene.media;
    REQUIRE((balls.size() == 1 && boxes.size() == 1));
    CHECK(boxes[0].region.low == Vec3{-1, 0, -1});
    CHECK(boxes[0].region.high == Vec3{1, 2, 1});
    CHECK(boxes[0].scattering == Rgb{1, 2, 3});
    CHECK(boxes[0].absorption == Rgb{0});
    CHECK(boxes[0].g == 0);
    CHECK(balls[0].region.center == Vec3{1, 2, 3});
    CHECK(balls[0].region.radius == 4);
    CHECK(balls[0].scattering == Rgb{0});
    CHECK(balls[0].absorption == Rgb{3, 2, 1});
    CHECK(balls[0].g == -0.5f);

    const std::string ball = R"({"type": "sphere", "center": [0, 0, 0], "radius": )";
    refused(foggy(ball + "1}"), "fog[0].scattering is missing.");
    refused(foggy(ball + R"(0, "scattering": [1, 1, 1]})"),
            "fog[0].radius is 0; it must be above 0.");
    refused(foggy(ball + R"(1, "scattering": [1, 1, -1]})"),
            "fog[0].scattering[2] is -1; it must be within [0, 1e12].");
    refused(foggy(ball + R"(1, "scattering": [1, 1, 1], "g": 1})"),
            "fog[0].g is 1; it must be within [-0.99, 0.99].");
    refused(
        foggy(ball + R"(1, "scattering": [1, 1, 1], "high": [1, 1, 1]})"),
        "fog[0].high is not known; the fields here are type, scattering, absorption, "
        "g, center and radius.");
    refused(
        foggy(
            R"({"type": "box", "low": [0, 0, 0], "high": [1, 0, 1], "scattering": [1, 1, 1]})"),
        "fog[0] cannot be used: fog.region.high is (1, 0, 1); it must be above "
        "fog.region.low in every component.");
    refused(foggy("1"), "fog[0] is 1; it must be an object.");

    const World yard(
        load_json(LJUS_TEST_INPUTS "/../scenes/fog.json", no_meshes).scene);
    CHECK(yard.has_fog());
}

TEST_CASE("load_json: points, spots and suns") {
    LoadedScene loaded =
        read(lit(R"({"type": "point", "position": [0, 2, 1], "intensity": [1, 2, 3]},
               {"type": "spot", "position": [0, 2, 1], "direction": [0, -2, 0],
                "intensity": [1, 1, 1], "inner_deg": 10, "outer_deg": 60},
               {"type": "sun", "direction": [1, -1, 0], "irradiance": [4, 4, 3]})"));
    const auto& [points, spots, suns, skies, measured] = loaded.scene.lights;
    REQUIRE(points.size() == 1);
    CHECK(points[0].position == Vec3{0, 2, 1});
    CHECK(points[0].intensity == Rgb{1, 2, 3});
    REQUIRE(spots.size() == 1);
    CHECK(glm::normalize(spots[0].direction) == Vec3{0, -1, 0});
    CHECK(spots[0].outer_degrees == doctest::Approx(60));
    REQUIRE(suns.size() == 1);
    CHECK(suns[0].irradiance == Rgb{4, 4, 3});
    CHECK(skies.empty());
    CHECK(measured.empty());
    // In the scene they come after the lamp, in the order of the file.
    const World world(std::move(loaded.scene));
    REQUIRE(world.light_count() == 4);
    CHECK(world.can_be_met(0));
    world.visit_light(2, [](const auto& light) {
        if constexpr (requires { light.outer; })
            CHECK(light.outer == doctest::Approx(0.5));
        else
            FAIL("the third light is no spot");
    });
    world.visit_light(3, [](const auto& light) {
        if constexpr (requires { light.around; })
            CHECK(light.around.radius > 2);
        else
            FAIL("the fourth light is no sun");
    });

    refused(lit("1"), "lights[0] is 1; it must be an object.");
    refused(lit(R"({"type": "moon"})"),
            "lights[0].type is \"moon\"; it must be point, spot, sun, environment or "
            "goniometric.");
    refused(lit(R"({"type": "sun", "direction": [0, 0, 0], "irradiance": [1, 1, 1]})"),
            "lights[0].direction is [0,0,0]; it must be a vector that is not 0.");
    refused(lit(R"({"type": "point", "position": [0, 0, 0], "intensity": [1, -1, 1]})"),
            "lights[0].intensity[1] is -1; it must be within [0, 1e12].");
    const std::string spot =
        R"({"type": "spot", "position": [0, 2, 1], "direction": [0, -2, 0],
            "intensity": [1, 1, 1], )";
    refused(lit(spot + R"("inner_deg": 20, "outer_deg": 10})"),
            "lights[0].inner_deg is 20; it must be within [0, outer_deg].");
    CHECK(refusal(lit(spot + R"("inner_deg": 0, "outer_deg": 0})"))
              .find("a.json: lights[0].outer_deg is 0; it must be within [0.001, 180] "
                    "degrees.") == 0);
    // They are enough: no object needs to shine.
    std::string dark = lit(R"({"type": "sun", "direction": [0, -1, 0],
                              "irradiance": [1, 1, 1]})");
    const std::string lamp = ", \"emission\": [5, 4, 2.5]";
    dark.erase(dark.find(lamp), lamp.size());
    CHECK(refusal(dark) == "accepted");
}

TEST_CASE("load_json: unknown and missing fields, types and materials are named") {
    refused({
        {"\"radius\": 0.75", "\"radios\": 0.75",
         "objects[2].radios is not known; did you mean radius? The fields here are "
         "type, name, emission, lamp_group, transform, displacement, material, center "
         "and radius."},
        {"\"radius\": 0.75", "\"vertices\": []",
         "objects[2].vertices is not known; the fields here are type, name, "
         "emission, lamp_group, transform, displacement, material, center and radius."},
        {",\n   \"radius\": 0.75", "", "objects[2].radius is missing."},
        {"\"camera\": {", "\"camera\": {\"fov\": 3, ",
         "camera.fov is not known; did you mean vfov_deg? The fields here are "
         "position, "
         "look_at, up, vfov_deg and lens."},
        {"\"format\"", "\"formt\"",
         "formt is not known; did you mean format? The fields here are format, name, "
         "description, camera, image, materials, objects, lights, fog, lamp_groups and "
         "$schema."},
    });
    CHECK(refusal("\"camera\"", "\"name\"").find("name appears twice") !=
          std::string::npos);
    refused({
        {"\"type\": \"dielectric\"", "\"type\": \"crystal\"",
         "materials.glass.type is \"crystal\"; it must be lambertian, oren-nayar, "
         "mirror, dielectric, mixture, oren-nayar-full, oren-nayar-printed, fujii, "
         "fon, eon, metal, rough-metal, full-rough-metal, glossy, full-glossy, "
         "rough-glass, dispersive-glass, measured-glass, thin-glass, soap-film, "
         "checker, picture, mapped or picture-lamp."},
        {"\"ior\": 1.5", "\"ior\": 1.5, \"tint\": [1, 1, 1]",
         "materials.glass.tint is not known; the fields here are type, ior, "
         "absorption and priority."},
        {"\"type\": \"sphere\"", "\"type\": \"cube\"",
         "objects[2].type is \"cube\"; it must be sphere, triangles, mesh, instances, "
         "quad, box, disc or cylinder."},
        {"\"type\": \"sphere\", ", "", "objects[2].type is missing."},
        {"\"material\": \"glass\"", "\"material\": \"gold\"",
         "objects[2].material is \"gold\"; it must be one of the materials glass, "
         "matt, mirror or rough."},
        {"{\"type\": \"dielectric\", \"ior\": 1.5}", "\"glass\"",
         "materials.glass is \"glass\"; it must be an object."},
        {", \"emission\": [5, 4, 2.5]", "",
         "objects has no light; give an object an emission above 0, or add a list of "
         "lights."},
        {"[5, 4, 2.5]", "[0, 0, 0]",
         "objects has no light; give an object an emission above 0, or add a list of "
         "lights."},
    });
    refused("[]", "the file is []; it must be an object.");
    refused("{}", "camera is missing.");
}

TEST_CASE("load_json: names that are no plain words cannot disturb a message") {
    refused(
        "\"format\"", "\"a\\nb\\u001b[31m\"",
        "[\"a?b?[31m\"] is not known; the fields here are format, name, "
        "description, camera, image, materials, objects, lights, fog, lamp_groups and "
        "$schema.");
    CHECK(
        refusal("\"format\"", "\"" + std::string(100'000, 'x') + "\"") ==
        "a.json: [\"" + std::string(48, 'x') +
            "...\"] is not known; the fields here are format, name, description, "
            "camera, image, materials, objects, lights, fog, lamp_groups and $schema.");
}

TEST_CASE("load_json: broken JSON is refused with line and column") {
    refused("", "the file is empty.");
    refused(" \n\t\r\n", "the file is empty.");
    // What comes after the place is nlohmann's and may change.
    const auto place = [](const std::string& text, const std::string& expected) {
        const std::string message = refusal(text);
        CHECK_MESSAGE(message.find("a.json: " + expected) == 0, message);
    };
    place("{\n \"name\": \"x\",\n", "line 3, column 1: unexpected end of input");
    place("{\n \"name\": x}", "line 2, column 10: invalid literal");
    place(changed("\"radius\": 0.75", "\"radius\": NaN"), "line 22, column 14: ");
    const std::string word = refusal("\"radius\": 0.75", "\"radius\": NaN");
    CHECK(word.find("; a value is a number, a text in quotation marks, a list, an "
                    "object, true, false or null.") != std::string::npos);
    place(good + "x", "line 26, column 2: ");
    place("{\"a\": \"\xff\"}", "line 1, column 8: ");
    place("{\"a\": \"\\x\"}", "line 1, column 9: ");
    place(std::string("{\0}", 3), "line 1, column 2: ");
    refused("\"radius\": 0.75", "\"radius\": 1e999",
            "line 22, column 18: objects[2].radius is 1e999; it must be finite.");
    CHECK(refusal("\"albedo\": [0.5, 0.5, 0.5]", "\"albedo\": [0.5, -1e999, 0.5]")
              .find("materials.rough.albedo[1] is -1e999; it must be finite.") !=
          std::string::npos);
    // However long the number is, what would be right is said.
    const std::string digits(5000, '4');
    const std::string endless = refusal("\"radius\": 0.75", "\"radius\": " + digits);
    CHECK(endless.size() < 300);
    CHECK(endless.find("objects[2].radius is 444") != std::string::npos);
    CHECK(endless.find("44...; it must be finite.") != std::string::npos);
    for (const char* const begin : {"\xff\xfe{", "\xfe\xff"})
        CHECK(refusal(begin) ==
              "cannot read 'a.json': its text is UTF-16; save it as UTF-8.");
    const std::string deep(100'000, '[');
    CHECK(refusal(deep).find("is nested too deeply; at most 32 levels are allowed.") !=
          std::string::npos);
}

TEST_CASE("load_json: a name is not endless, materials have names") {
    const LoadedScene loaded =
        read(changed("\"four things\"", "\"" + std::string(250, 'x') + "\""));
    CHECK(loaded.name == std::string(200, 'x').append("..."));
    std::string list = good;
    const std::size_t begin = list.find("\"materials\": {") + 13;
    list.replace(begin, list.find("\"objects\"") - begin, "[], ");
    refused(list, "materials is []; it must be an object.");
}

TEST_CASE("load_json: a mesh is refused where nobody reads its file") {
    for (const char* const normals : {"", R"(, "normals": "smooth")"}) {
        std::string mesh = R"("objects": [{"type": "mesh", "file": "m.obj", )";
        mesh.append(R"("material": "matt")").append(normals).append("}, ");
        CHECK(refusal("\"objects\": [", mesh)
                  .starts_with("m.obj: load_json() reads no meshes unless "));
    }
}

TEST_CASE("load_json: files") {
    const ScratchFolder folder;
    ScratchFolder::write(folder.file("scene.json"), good);
    CHECK(load_json(folder.file("scene.json"), no_meshes).scene.size() == 4);

    ScratchFolder::write(folder.file("empty.json"), "");
    CHECK_THROWS_WITH_AS((void)load_json(folder.file("empty.json"), no_meshes),
                         (folder.file("empty.json") + ": the file is empty.").c_str(),
                         std::runtime_error);
    CHECK_THROWS_AS((void)load_json(folder.file("missing.json"), no_meshes),
                    std::runtime_error);
    CHECK_THROWS_AS((void)load_json(folder.file(""), no_meshes), std::runtime_error);
}

TEST_CASE("load_json: so many values that memory would end are refused") {
    const auto many = [](std::size_t count, const std::string& value) {
        std::string text = "[";
        for (std::size_t i = 0; i < count; ++i) text.append(value).append(",");
        text.back() = ']';
        return text;
    };
    const std::string sentence =
        "a.json: it has more than 8388608 numbers, or a quarter as many lists, "
        "objects and members; put large meshes into files of their own.";
    CHECK(refusal(many(2'200'000, "{}")) == sentence);
    CHECK(refusal(many(2'200'000, "[]")) == sentence);
    CHECK(refusal(many(1'400'000, R"({"a":1})")) == sentence);
    CHECK(refusal(many(100'000, "[1,2,3]")) != sentence);
    const std::string triangle = R"({"type": "triangles", "material": "grey",)"
                                 R"("vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]],)"
                                 R"("indices": [[0, 1, 2]]})";
    CHECK(refusal(many(100'000, triangle)) != sentence);
    // To the last one: 4 for the list, 4 for each list or object and member in it.
    constexpr std::size_t room = 8'388'608 - 4;
    CHECK(refusal(many(room / 4, "[]")) != sentence);
    CHECK(refusal(many(room / 4 + 1, "[]")) == sentence);
    CHECK(refusal(many(room / 9, R"({"a":1})")) != sentence);
    CHECK(refusal(many(room / 9 + 1, R"({"a":1})")) == sentence);
    CHECK(refusal(many(room, "1")) != sentence);
    CHECK(refusal(many(room + 1, "1")) == sentence);
}

TEST_CASE("load_json: hundreds of soap films are refused before all are made") {
    std::string films;
    for (int i = 0; i < 300; ++i)
        films.append("\"f")
            .append(std::to_string(i))
            .append(R"(": {"type": "soap-film", "ior": 1.33, "thickness_nm": 400}, )");
    refused(
        "\"materials\": {", "\"materials\": {" + films,
        "materials has more than 16 soap films, whose colours are slow to compute.");
}

TEST_CASE("load_json: tens of thousands of lights are refused") {
    std::string text = "{\"camera\": {\"position\": [0, 0, 9], \"look_at\": [0, 0, 0],"
                       "\"up\": [0, 1, 0], \"vfov_deg\": 40},"
                       "\"image\": {\"width\": 2, \"height\": 2},"
                       "\"materials\": {\"m\": {\"type\": \"lambertian\","
                       "\"albedo\": [0, 0, 0]}}, \"objects\": [";
    for (int i = 0; i < 65536; ++i)
        text += "{\"type\": \"sphere\", \"material\": \"m\", \"center\": [0, 0, 0],"
                "\"radius\": 1, \"emission\": [1, 1, 1]},";
    text.back() = ']';
    refused(text + "}", "objects has 65536 lights; it must have at most 65535.");
}

TEST_CASE("load_json: garbage is refused, or gives a scene that can be used") {
    // Every truncation, and 20 000 mutations, always the same ones.
    std::uint64_t state = 1;
    const auto random = [&state](std::uint64_t below) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return (state >> 33) % below;
    };
    int accepted = 0;
    const auto try_it = [&](const std::string& text) {
        try {
            LoadedScene loaded = read(text);
            ++accepted;
            REQUIRE(loaded.scene.light_count() > 0);
            REQUIRE(loaded.width >= 1);
            REQUIRE(is_finite(loaded.camera.pinhole.forward));
            const World world(std::move(loaded.scene));
            const auto hit =
                closest_hit(world, primary_ray(loaded.camera.pinhole, Vec2{0.5f, 0.5f},
                                               loaded.width, loaded.height));
            if (hit) REQUIRE(hit->at.t >= 0);
        } catch (const std::runtime_error& error) {
            const std::string what = error.what();
            REQUIRE_MESSAGE(what.find("a.json: ") == 0, what);
            REQUIRE_MESSAGE(what.back() == '.', what);
            REQUIRE_MESSAGE(what.size() < 400, what);
            const bool plain = std::all_of(what.begin(), what.end(),
                                           [](char c) { return c >= 0x20 || c < 0; });
            REQUIRE_MESSAGE(plain, what); // no control characters
        }
    };
    for (std::size_t length = 0; length < good.size(); ++length)
        try_it(good.substr(0, length));
    CHECK(accepted == 0);

    const std::string alphabet =
        "{}[]:,\"-+.eE0123456789 truefalsn\\\n\x01\x7f\xc3\xff";
    for (int i = 0; i < 20'000; ++i) {
        std::string text = good;
        const std::uint64_t count = 1 + random(4);
        for (std::uint64_t k = 0; k < count; ++k) {
            // One by one, because the order of a call's arguments is not fixed.
            const std::size_t at = random(text.size());
            const char c = alphabet[random(alphabet.size())];
            const std::size_t length = 1 + random(8);
            const std::size_t from = random(text.size());
            switch (random(4)) {
            case 0:
                text[at] = c;
                break;
            case 1:
                text.insert(at, 1, c);
                break;
            case 2:
                text.erase(at, length);
                break;
            default:
                text.insert(at, text.substr(from, 5 * length));
            }
        }
        try_it(text);
    }
    CHECK(accepted > 300); // or the mutations test the parser only
}

TEST_CASE("load_json: the numbers that the table above leaves out have limits, too") {
    // With the least and the most it is accepted, just beyond it names field and range.
    const auto limits = [](const std::string& from, const std::string& to,
                           const std::string& field, double low, double high,
                           const std::string& range) {
        CAPTURE(field);
        const auto with = [&](double value) {
            std::string put = to;
            put.replace(put.find('#'), 1, to_text(value));
            return refusal(from, put);
        };
        CHECK(with(low) == "accepted");
        CHECK(with(high) == "accepted");
        const double under = low > 0 ? low * 0.999 : low < 0 ? low * 1.001 : -1e-6;
        for (const double beyond : {under, high * 1.001}) {
            const std::string message = with(beyond);
            CHECK_MESSAGE(message.find("a.json: " + field + " is ") == 0, message);
            CHECK_MESSAGE(message.find("it must be " + range) != message.npos, message);
        }
    };
    const std::string glass = R"({"type": "dielectric", "ior": 1.5})";
    limits("\"vfov_deg\": 40", "\"vfov_deg\": #", "camera.vfov_deg", 1e-3, 179.99,
           "within [0.001, 179.99] degrees");
    limits("\"position\": [0, 1, 5]", "\"position\": [#, 1, 5]", "camera.position[0]",
           -1e9, 1e9, "within [-1e9, 1e9]");
    limits("[5, 4, 2.5]", "[5, 4, #]", "objects[1].emission[2]", 0, 1e12,
           "within [0, 1e12]");
    for (const std::string start : {R"({"type": "dielectric", "ior": 1.5)",
                                    R"({"type": "mixture", "color": [0.5, 0.5, 0.5])"})
        limits(glass, start + R"(, "absorption": [1, #, 1]})",
               "materials.glass.absorption[1]", 0, 1e12, "within [0, 1e12]");
    const std::string board =
        R"({"type": "checker", "even": [1, 1, 1], "odd": [0, 0, 0], "map": "uv")";
    limits(glass, board + R"(, "scale": [1, #]})", "materials.glass.scale[1]", -1e6,
           1e6, "within [-1e6, 1e6]");
    limits(glass, board + R"(, "columns": #})", "materials.glass.columns", 2, 1e6,
           "a whole number within [2, 1000000]");
    limits(glass, board + R"(, "rows": #})", "materials.glass.rows", 2, 1e6,
           "a whole number within [2, 1000000]");
    CHECK(refusal(with(board + R"(, "rows": 1})"))
              .find("glass.rows is 1; it must be a whole number within [2,") !=
          std::string::npos);
    limits(glass, R"({"type": "soap-film", "thickness_nm": 400, "ior": #})",
           "materials.glass.ior", 1, 1000, "within [1, 1000]");
    limits(glass, R"({"type": "soap-film", "thickness_nm": 400, "ior": 1.33,
                      "scale": #, "level": [0, 0, 0], "up": [0, 1, 0]})",
           "materials.glass.scale", 0, 1e9, "within [0, 1e9]");
    // Not 0, but its square is none that float holds with all its digits.
    for (const char* const edge : {"edge_u", "edge_v"}) {
        std::string tiny = R"({"type": "checker", "even": [1, 1, 1], "odd": [0, 0, 0],
            "origin": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [1, 0, 0]})";
        tiny.replace(tiny.find(edge) + 9, 9, "[1e-21, 0, 0]");
        CHECK(refusal(with(tiny)) ==
              std::string("a.json: materials.glass.") + edge +
                  " is [1e-21,0,0]; it must be a vector that is not 0.");
    }
}

TEST_CASE("load_json: who reads meshes is told the file, the scale and the normals") {
    struct Call {
        std::string path;
        MeshFileSettings settings;
    };
    std::vector<Call> calls;
    const auto load = [&](const std::string& path, const MeshFileSettings& settings) {
        calls.push_back({path, settings});
        return LoadedMesh{};
    };
    const auto said = [&](const std::string& rest) {
        const std::string mesh =
            R"("objects": [{"type": "mesh", "file": "m.obj", "material": "matt")";
        return refusal(changed("\"objects\": [", mesh + rest + "}, "), load,
                       "sub/a.json");
    };
    CHECK(said("") == "accepted");
    CHECK(said(R"(, "scale": 1e-9, "normals": "smooth")") == "accepted");
    CHECK(said(R"(, "scale": 1e9, "normals": "flat")") == "accepted");
    CHECK(said(R"(, "scale": 2.5, "normals": "file")") == "accepted");
    REQUIRE(calls.size() == 4);
    for (const Call& call : calls) CHECK(call.path == "sub/m.obj");
    for (const Call& call : calls) CHECK_FALSE(call.settings.pictures);
    CHECK(calls[0].settings.scale == 1);
    CHECK(calls[1].settings.scale == 1e-9);
    CHECK(calls[2].settings.scale == 1e9);
    CHECK(calls[3].settings.scale == 2.5);
    CHECK(calls[0].settings.normals == MeshNormals::file);
    CHECK(calls[1].settings.normals == MeshNormals::smooth);
    CHECK(calls[2].settings.normals == MeshNormals::flat);
    CHECK(calls[3].settings.normals == MeshNormals::file);
    for (const char* const scale : {"0", "-1", "0.99e-9", "1.01e9"})
        CHECK(said(std::string(", \"scale\": ") + scale)
                  .find("; it must be within [1e-9, 1e9].") != std::string::npos);
    CHECK(said(R"(, "normals": "sharp")") ==
          "sub/a.json: objects[0].normals is \"sharp\"; it must be file, smooth or "
          "flat.");
    CHECK(calls.size() == 4);
}

TEST_CASE("load_json: a mesh file is read once for each scale and normals") {
    const MeshData triangle{.positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                            .triangles{{0, 1, 2}}};
    int calls = 0;
    std::size_t triangles = 1;
    const auto load = [&](const std::string&, const MeshFileSettings& settings) {
        ++calls;
        MeshData data = triangle;
        data.positions[1].x = float(settings.scale);
        data.triangles.resize(triangles, data.triangles[0]);
        return of_meshes(Mesh(triangle), Mesh(data));
    };
    const auto objects = [](int count, int different = 1) {
        std::string text;
        for (int i = 0; i < count; ++i)
            text += R"({"type": "mesh", "file": "m.obj", "material": ")" +
                    std::string(i % 2 == 0 ? "matt" : "glass") + "\"" +
                    (different > 1 ? ", \"scale\": " + std::to_string(1 + i % different)
                                   : "") +
                    "}, ";
        return changed("\"objects\": [", "\"objects\": [" + text);
    };
    LoadedScene loaded;
    REQUIRE_NOTHROW(loaded = read(objects(100, 3), load));
    CHECK(calls == 3);
    const auto& meshes = std::get<std::vector<Mesh>>(loaded.scene.shapes);
    REQUIRE(meshes.size() == 200);
    for (std::uint32_t i = 0; i < 200; ++i) {
        const float right = i % 2 == 0 ? 1 : float(1 + i / 2 % 3);
        CHECK(meshes[i].data().positions[1].x == right);
        CHECK((loaded.scene.objects[3][i].material ==
               loaded.scene.objects[3][i % 4].material));
    }
    CHECK(loaded.scene.objects[3][0].material != loaded.scene.objects[3][2].material);
    // All meshes of a file shine, if one does.
    const std::string lamp =
        R"({"type": "mesh", "file": "m.obj", "material": "matt", "emission": [1, 1, 1]}, )";
    CHECK(read(changed("\"objects\": [", "\"objects\": [" + lamp), load)
              .scene.light_count() == 3);

    CHECK(refusal(objects(40, 16), load) == "accepted");
    refused(objects(40, 17),
            "objects[16].file is named with more than 16 scales and normals.", load);
    triangles = (1 << 19) - 1; // and one
    CHECK(refusal(objects(9), load) == "accepted");
    refused(objects(10),
            "objects[9].file is named once more; meshes that are named again have "
            "at most 4194304 triangles together.",
            load);
}

TEST_CASE("load_json: instances place a mesh that is read once") {
    int calls = 0;
    std::uint32_t triangles = 1;
    const auto load = [&](const std::string&, const MeshFileSettings& settings) {
        ++calls;
        MeshData data{.positions{{0, 0, 0}, {float(settings.scale), 0, 0}, {0, 1, 0}}};
        data.triangles.resize(triangles, {0, 1, 2});
        return of_meshes(Mesh(data));
    };
    const auto with = [](const std::string& places, int count = 1) {
        std::string text;
        for (int i = 0; i < count; ++i)
            text += R"({"type": "instances", "file": "m.obj", "material": "matt", )"
                    R"("places": )" +
                    places + "}, ";
        return changed("\"objects\": [", "\"objects\": [" + text);
    };
    const std::string two = "[[1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7], "
                            "[0, 2, 0, 0, 1, 0, 0, 0, 0, 0, 3, 0]]";
    auto loaded = read(with(two, 3), load);
    CHECK(calls == 1);
    const World world(std::move(loaded.scene));
    const auto& placed = std::get<std::vector<Instance>>(world.shapes());
    REQUIRE(placed.size() == 6);
    for (const Instance& one : placed) CHECK(&one.mesh() == &placed[0].mesh());
    CHECK(placed[0].triangle(0).v1 == Vec3(5, 6, 7));
    CHECK(placed[0].triangle(0).v2 == Vec3(6, 6, 7));
    CHECK(placed[1].place()[0] == Vec3(0, 1, 0)); // the first column
    CHECK(placed[1].place()[1] == Vec3(2, 0, 0));
    CHECK(placed[1].place()[2] == Vec3(0, 0, 3));

    CHECK(refusal(with("[]"), load) == "accepted");
    refused(with("[[1, 0, 0]]"),
            "objects[0].places[0] is [1,0,0]; it must be a list of twelve "
            "numbers, the rows of a 3 x 4 matrix.",
            load);
    refused(
        with("[[1,0,0,0, 0,0,0,0, 0,0,1,0]]"),
        "objects[0].places[0] cannot be used: the determinant of an "
        "instance's map is 0; it must be other than 0: a mesh without thickness has "
        "no inside.",
        load);
    triangles = 1 << 20;
    const std::string same = "[1,0,0,0, 0,1,0,0, 0,0,1,0]";
    std::string many = same;
    for (int i = 1; i < 1025; ++i) many += "," + same;
    refused(with("[" + many + "]"),
            "objects[0].places has too many entries; instances have at most "
            "1073741824 triangles together.",
            load);
}

TEST_CASE("load_json: counts are right to the last one") {
    // Names of 48 letters are plain; 12 names stand in a message, the rest is dots.
    const auto named = [](std::size_t length) {
        return refusal("\"format\"", "\"" + std::string(length, 'x') + "\"");
    };
    CHECK(named(48).find("a.json: " + std::string(48, 'x') + " is not known") == 0);
    CHECK(named(49).find("a.json: [\"" + std::string(48, 'x') +
                         "...\"] is not known") == 0);
    const auto wrong = [](const std::string& more) {
        std::string text = changed("\"material\": \"glass\"", "\"material\": \"no\"");
        const std::string before = "\"materials\": {";
        return refusal(text.replace(text.find(before), before.size(), before + more));
    };
    std::string more;
    for (const char name : {'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h'})
        more.append("\"").append(1, name).append(
            R"(": {"type": "mirror", "reflectance": [1, 1, 1]},)");
    CHECK(wrong(more) ==
          "a.json: objects[2].material is \"no\"; it must be one of the materials a, "
          "b, c, d, e, f, g, glass, h, matt, mirror or rough.");
    more += R"("z": {"type": "mirror", "reflectance": [1, 1, 1]},)";
    CHECK(wrong(more) ==
          "a.json: objects[2].material is \"no\"; it must be one of the materials a, "
          "b, c, d, e, f, g, glass, h, matt, mirror, rough, ....");
    // 32 lists in each other, and not one more.
    const auto nested = [](std::size_t depth) {
        return refusal(std::string(depth, '[') + std::string(depth, ']'));
    };
    CHECK(nested(32).find("it must be an object") != std::string::npos);
    CHECK(nested(33).find(" is nested too deeply; at most 32 levels") !=
          std::string::npos);
    // 16 films: then it is the next mistake that is refused, before one is made.
    const auto films = [](int count) {
        std::string all = R"("a": {"type": "mirror"}, )";
        for (int i = 0; i < count; ++i)
            all += "\"f" + std::to_string(i) +
                   R"(": {"type": "soap-film", "ior": 1.33, "thickness_nm": 400}, )";
        return refusal("\"materials\": {", "\"materials\": {" + all);
    };
    CHECK(films(16) == "a.json: materials.a.reflectance is missing.");
    CHECK(films(17).find("more than 16 soap films") != std::string::npos);
}

TEST_CASE("load_json: only a box is a filter, and a parser's words are plain letters") {
    for (const char* const filter : {"b", "bo", "bos", "Box", " box", ""})
        CHECK(refusal("box, exactly one pixel wide", filter).find("the only filter") !=
              std::string::npos);
    CHECK(refusal("box, exactly one pixel wide", "box") == "accepted");
    for (const char* const text :
         {"{\"a\": \xc3\xa9}", "{\"\xc3\xa9\": x}", "\xe2\x82\xac"})
        for (const char c : refusal(text)) CHECK(static_cast<unsigned char>(c) < 0x80);
}

TEST_CASE("load_json: each number of each material and light has its limits") {
    // With the least and the most it is accepted, just beyond it is not.
    struct Limit {
        const char* start; // of the material, its type and the fields that it needs
        const char* field;
        double low, high;
    };
    const char* const metal = R"({"type": "rough-metal", "metal": "gold")";
    const char* const gloss = R"({"type": "glossy", "reflectance": [1, 1, 1])";
    const char* const frost = R"({"type": "rough-glass", "ior": 1.5)";
    const char* const mixture = R"({"type": "mixture", "color": [0.1, 0.1, 0.1])";
    const char* const film = R"({"type": "soap-film", "ior": 1.33)";
    const auto read = [&](const std::string& material) {
        return refusal(R"({"type": "lambertian", "albedo": [0.75, 0.5, 0.25]})",
                       material);
    };
    for (const Limit& limit :
         {Limit{R"({"type": "oren-nayar", "albedo": [1, 1, 1])", "sigma_deg", 0, 90},
          Limit{R"({"type": "fujii", "albedo": [1, 1, 1])", "sigma_deg", 0, 90},
          Limit{R"({"type": "dielectric")", "ior", 1e-3, 1e3},
          Limit{R"({"type": "thin-glass", "tint": [1, 1, 1])", "ior", 1e-3, 1e3},
          Limit{R"({"type": "dispersive-glass", "abbe": 30)", "ior", 1, 100},
          Limit{R"({"type": "dispersive-glass", "ior": 100)", "abbe", 1, 1e6},
          Limit{R"({"type": "fon", "albedo": [1, 1, 1])", "roughness", 0, 1},
          Limit{R"({"type": "eon", "albedo": [1, 1, 1])", "roughness", 0, 1},
          Limit{metal, "roughness", 0.01, 1}, Limit{gloss, "roughness", 0.01, 1},
          Limit{frost, "roughness", 0.01, 1}, Limit{mixture, "reflectivity", 0, 1},
          Limit{mixture, "transparency", 0, 1}, Limit{mixture, "specularity", 0, 1},
          Limit{mixture, "sigma_deg", 0, 90}, Limit{mixture, "ior", 1e-3, 1e3},
          Limit{mixture, "emissivity", 0, 1e12}, Limit{film, "thickness_nm", 0, 1e6}}) {
        CAPTURE(limit.start);
        CAPTURE(limit.field);
        const auto with = [&](double value) {
            return read(std::string(limit.start) + ", \"" + limit.field +
                        "\": " + to_text(value) + "}");
        };
        CHECK(with(limit.low) == "accepted");
        CHECK(with(limit.high) == "accepted");
        const std::string place = std::string("a.json: materials.matt.") + limit.field;
        for (const double beyond :
             {limit.low > 0 ? limit.low * 0.999 : -1e-6, limit.high * 1.001})
            CHECK(with(beyond).find(place + " is ") == 0);
    }
    for (const char* const field : {"reflectivity", "transparency"})
        CHECK(read(std::string(mixture) + ", \"" + field + "\": true}") != "accepted");
    CHECK(read(std::string(metal) + R"(, "roughness": 0})") == "accepted");
    // A field that a type does not have is refused with those that it has.
    for (const char* const type :
         {R"({"type": "mirror", "reflectance": [1, 1, 1])",
          R"({"type": "metal", "metal": "gold")",
          R"({"type": "dielectric", "ior": 1.5)",
          R"({"type": "checker", "even": [1, 1, 1], "odd": [0, 0, 0], "map": "uv")"})
        CHECK(
            read(std::string(type) + R"(, "zzz": 1})").find("matt.zzz is not known") !=
            std::string::npos);
    const char* const lights[] = {
        R"({"type": "point", "position": [0, 2, 1], "intensity": [1, 1, 1])",
        R"({"type": "sun", "direction": [0, -1, 0], "irradiance": [1, 1, 1])",
        R"({"type": "spot", "position": [0, 2, 1], "direction": [0, -1, 0],
            "intensity": [1, 1, 1], "inner_deg": 1, "outer_deg": 180)",
        R"({"type": "environment", "radiance": [1, 1, 1])"};
    for (const std::string light : lights) {
        CHECK(refusal(lit(light + "}")) == "accepted");
        CHECK(
            refusal(lit(light + R"(, "zzz": 1})")).find("lights[0].zzz is not known") !=
            std::string::npos);
        const auto replaced = [&](const std::string& from, const std::string& to) {
            std::string text = light + "}";
            const std::size_t at = text.find(from);
            if (at == text.npos) return std::string("none");
            return refusal(lit(text.replace(at, from.size(), to)));
        };
        CHECK(replaced("[1, 1, 1]", "[1, 1, 1e12]") == "accepted");
        CHECK(replaced("[1, 1, 1]", "[1, 1, 1.001e12]") != "accepted");
        if (light.find("spot") == light.npos) continue;
        CHECK(replaced("180", "180.1") != "accepted");
        CHECK(replaced("\"inner_deg\": 1", "\"inner_deg\": 0") == "accepted");
        CHECK(replaced("\"inner_deg\": 1", "\"inner_deg\": -0.1") != "accepted");
    }
}

TEST_CASE("load_json: a file beside the scene, or anywhere if its name is whole") {
    const auto beside = [](const char* file, const char* name) {
        const nlohmann::json value = name;
        const std::string whole = file;
        const detail::JsonField field{value, whole, value};
        return detail::path_beside(field);
    };
    CHECK(beside("scenes/a.json", "b.obj") == "scenes/b.obj");
    CHECK(beside("scenes/a.json", "sub/b.obj") == "scenes/sub/b.obj");
    CHECK(beside("c:\\scenes\\a.json", "b.obj") == "c:\\scenes\\b.obj");
    CHECK(beside("a.json", "b.obj") == "b.obj");
    CHECK(beside("scenes/a.json", "/whole/b.obj") == "/whole/b.obj");
    CHECK(beside("scenes/a.json", "") == "scenes/");
}

TEST_CASE("load_json: a slab of glass on the floor, in either order of the objects") {
    // The floor's quad and the slab's lower side; the light there is contacts_test's.
    for (const bool turned : {false, true}) {
        auto file = nlohmann::json::parse(
            detail::load_text(LJUS_TEST_INPUTS "/glass_on_floor.json", 1 << 20));
        if (turned) std::swap(file["objects"][0], file["objects"][1]);
        const World world(read(file.dump()).scene);
        CHECK(world.contacts().pairs.size() == 1);
    }
}

#endif
