/// \file own_materials_test.cpp
/// \brief What a mesh is made of by its own file, in code and in scene files.

#include <doctest/doctest.h>

#if __has_include(<nlohmann/json.hpp>) && __has_include(<stb/stb_image.h>)

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "ljus/io/load_json.hpp"
#include "ljus/io/load_mesh.hpp"
#include "ljus/io/png.hpp"
#include "ljus/path/direct_light.hpp"
#include "scratch_folder.hpp"
#include "support/mesh_bytes.hpp"
#include "support/refusal.hpp"

using namespace ljus;
using namespace ljus_test;
using nlohmann::json;

namespace {

struct Texel {
    int red, green, blue, alpha;
};

/// A BMP file of 32 bits, its rows from below.
Bytes bmp(int width, const std::vector<Texel>& texels) {
    Bytes file{'B', 'M'};
    const std::size_t height = texels.size() / std::size_t(width);
    const auto add = [&](std::size_t value, int size) {
        add_number(file, value, size);
    };
    add(54 + 4 * texels.size(), 4), add(0, 4), add(54, 4), add(40, 4);
    add(std::size_t(width), 4), add(height, 4), add(1, 2), add(32, 2);
    for (int i = 0; i < 6; ++i) add(0, 4);
    for (const Texel& t : texels)
        for (const int byte : {t.blue, t.green, t.red, t.alpha})
            add(std::size_t(byte), 1);
    return file;
}

void write(const ScratchFolder& folder, const char* name, const std::string& text) {
    save_file(folder.file(name), Bytes(text.begin(), text.end()));
}

/// A unit square in the plane z = 0 from x on, with coordinates from (0, 0) to (1, 1);
/// `first` is the number of its first vertex.
std::string square(int x, int first, const char* material) {
    std::string text;
    for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        text += "v " + std::to_string(x + u) + " " + std::to_string(v) + " 0\nvt " +
                std::to_string(u) + " " + std::to_string(v) + "\n";
    text += std::string("usemtl ") + material + "\nf";
    for (int i = first; i < first + 4; ++i)
        text += " " + std::to_string(i) + "/" + std::to_string(i);
    return text + "\n";
}

/// A scene file with these objects, under a lamp that is far away.
std::string scene_text(const std::string& objects, const std::string& more = "") {
    return R"({"camera": {"position": [0, 1, 5], "look_at": [0, 1, 0], "up": [0, 1, 0],
        "vfov_deg": 40}, "image": {"width": 3, "height": 2},
        "materials": {"grey": {"type": "lambertian", "albedo": [0.5, 0.5, 0.5]})" +
           more + R"(},
        "lights": [{"type": "point", "position": [0, 0, 100], "intensity": [1, 1, 1]}],
        "objects": [)" +
           objects + "]}";
}

/// The albedo that a ray along -z meets at (x, y), of a mirror or metal its
/// reflectance; negative if it meets nothing.
template <typename W>
Rgb color_seen(const W& world, float x, float y) {
    const Ray ray{.origin{x, y, 9}, .direction{0, 0, -1}};
    const auto hit = closest_hit(world, ray);
    if (!hit) return Rgb{-1};
    return visit_material_at(world, vertex_at(world, ray, *hit), [](const auto& m) {
        if constexpr (requires { m.albedo; })
            return Rgb(m.albedo);
        else if constexpr (requires { Rgb(m.reflectance); })
            return Rgb(m.reflectance);
        else
            return Rgb{-2};
    });
}
template <typename W>
Vec3 normal_seen(const W& world, float x, float y) {
    const Ray ray{.origin{x, y, 9}, .direction{0, 0, -1}};
    return vertex_at(world, ray, *closest_hit(world, ray)).frame.normal;
}

auto loaded_scene(const ScratchFolder& folder, const std::string& text,
                  std::string* report = nullptr) {
    return read_json_scene(text, folder.file("s.json"), MeshFiles{report});
}
auto world_of(const ScratchFolder& folder, const std::string& text,
              std::string* report = nullptr) {
    return World(std::move(loaded_scene(folder, text, report).scene));
}

std::string refusal(const ScratchFolder& folder, const std::string& text) {
    try {
        (void)loaded_scene(folder, text);
    } catch (const std::runtime_error& error) {
        const std::string what = error.what();
        return what.substr(what.find(".json: ") + 7);
    }
    return "";
}

/// Two by two texels, from the lower left: red, green, and above blue, white; the alpha
/// is 255, 100, 0, 255.
const std::vector<Texel> four{
    {255, 0, 0, 255}, {0, 255, 0, 100}, {0, 0, 255, 0}, {255, 255, 255, 255}};

/// A glTF file of one square with this material.
void write_gltf(const ScratchFolder& folder, const json& material,
                const json& more = json::object()) {
    Bytes bytes;
    for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        for (const int x : {u, v, 0}) add_float(bytes, float(x));
    for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        for (const int x : {u, 1 - v}) add_float(bytes, float(x)); // v goes down
    for (const unsigned corner : {0u, 1u, 2u, 0u, 2u, 3u}) add_number(bytes, corner, 2);
    save_file(folder.file("a.bin"), bytes);
    save_file(folder.file("four.bmp"), bmp(2, four));
    save_file(folder.file("lean.bmp"), bmp(1, {{204, 128, 230, 255}}));
    json all = json::parse(R"({"asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "buffers": [{"uri": "a.bin", "byteLength": 92}],
        "bufferViews": [{"buffer": 0, "byteLength": 48},
                        {"buffer": 0, "byteOffset": 48, "byteLength": 32},
                        {"buffer": 0, "byteOffset": 80, "byteLength": 12}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4,
                       "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5126, "count": 4,
                       "type": "VEC2"},
                      {"bufferView": 2, "componentType": 5123, "count": 6,
                       "type": "SCALAR"}],
        "images": [{"uri": "four.bmp"}, {"uri": "lean.bmp"}],
        "samplers": [{"magFilter": 9728}, {"magFilter": 9728, "wrapS": 33071,
                                           "wrapT": 33071}],
        "textures": [{"source": 0, "sampler": 0}, {"source": 1, "sampler": 0},
                     {"source": 0, "sampler": 1}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1},
                                    "indices": 2, "material": 0}]}]})");
    all["materials"] = {material};
    all.update(more);
    write(folder, "a.gltf", all.dump());
}

/// A matt material with the four texels.
json pictured() {
    return {{"pbrMetallicRoughness",
             {{"metallicFactor", 0}, {"baseColorTexture", {{"index", 0}}}}}};
}

const std::string gltf_object = R"({"type": "mesh", "file": "a.gltf"})";

} // namespace

TEST_CASE("own materials: three of an MTL file, in a scene file and in code") {
    const ScratchFolder folder;
    save_file(folder.file("four.bmp"), bmp(2, four));
    write(folder, "a.mtl",
          "newmtl red\nKd 0.8 0.1 0.2\n"
          "newmtl mirror\nillum 3\nKs 0.9 0.8 0.7\n"
          "newmtl lamp\nKd 0 0 0\nKe 3 2 1\n"
          "newmtl leaf\nKd 0.5 0.5 0.5\nmap_Kd -s 2 1 -o 0.25 -clamp off four.bmp\n"
          "map_d four.bmp\n");
    write(folder, "a.obj",
          "mtllib a.mtl\n" + square(0, 1, "red") + square(1, 5, "mirror") +
              square(2, 9, "lamp") + square(3, 13, "leaf"));
    const auto objects = [](const char* emission) {
        return std::string(R"({"type": "mesh", "file": "a.obj", "lamp_group": "x")") +
               emission + R"(},
        {"type": "mesh", "file": "a.obj", "material": "grey",
         "transform": {"translate": [0, 9, 0]}},
        {"type": "mesh", "file": "a.obj", "material": "file",
         "transform": {"translate": [0, -9, 0]}},
        {"type": "instances", "file": "a.obj",
         "places": [[1, 0, 0, 20, 0, 1, 0, 0, 0, 0, 1, 0]]})";
    };
    const auto whole = [&](const char* emission) {
        std::string text = scene_text(objects(emission));
        text.insert(text.find("\"lights\""), "\"lamp_groups\": {\"x\": 2}, ");
        return text;
    };
    const World world = world_of(folder, whole(""));
    for (const Vec2 at : {Vec2{0, 0}, Vec2{0, -9}, Vec2{20, 0}}) {
        const auto seen = [&](float x, float y) {
            return color_seen(world, at.x + x, at.y + y);
        };
        CHECK(seen(0.5f, 0.5f) == Rgb{0.8f, 0.1f, 0.2f});
        CHECK(seen(1.5f, 0.5f) == Rgb{0.9f, 0.8f, 0.7f});
        CHECK(seen(2.5f, 0.5f) == Rgb{0});
        // u = 2 x + 0.25: the middles of the lower texels at x = 0 and 0.25.
        CHECK(seen(3.5f, 0.25f) == Rgb{0.5f, 0, 0});
        CHECK(seen(3.75f, 0.25f) == Rgb{-1}); // its alpha is 100
        CHECK(seen(3.25f, 0.75f) == Rgb{0.5f});
        CHECK(seen(3.5f, 0.75f) == Rgb{-1});
    }
    CHECK(color_seen(world, 0.5f, 9.5f) == Rgb{0.5f}); // the scene's own grey
    CHECK(color_seen(world, 3.5f, 9.75f) == Rgb{0.5f});
    // Four lamps: the point and three squares, whose group is twice as bright once.
    REQUIRE(world.light_count() == 4);
    const auto radiance = [&](float x, float y) {
        const Ray ray{.origin{x, y, 9}, .direction{0, 0, -1}};
        return world.object(closest_hit(world, ray)->object).emission;
    };
    CHECK(radiance(2.5f, 0.5f) == Rgb{6, 4, 2});
    CHECK(radiance(2.5f, -8.5f) == Rgb{3, 2, 1});
    CHECK(radiance(22.5f, 0.5f) == Rgb{3, 2, 1});
    // What has holes cannot glow.
    CHECK(refusal(folder, whole(", \"emission\": [1, 1, 1]"))
              .find("the radiance of a cut-out") != std::string::npos);

    // The same in code; a scene that lists no holes has none.
    const auto loaded = load_obj(folder.file("a.obj"));
    CHECK(loaded.report.notes.empty());
    const auto sees = [&](auto scene) {
        add_meshes(scene, loaded);
        const World all(std::move(scene));
        return color_seen(all, 3.5f, 0.75f);
    };
    CHECK(sees(Scene<Shapes<Mesh>, Materials<Lambertian, MeshDetailed>>{}) == Rgb{-1});
    CHECK(sees(Scene<Shapes<Mesh>, Materials<Lambertian, MeshPicture>>{}) ==
          Rgb{0, 0, 0.5f});
    CHECK(sees(Scene<Shapes<Mesh>, Materials<Lambertian>>{}) == Rgb{0.5f});
}

TEST_CASE("own materials: pictures of MTL files") {
    const ScratchFolder folder;
    Image grey = make_image<float>(2, 1); // bytes of 150 and 90 in red
    pixel(grey, 0, 0) = {srgb_decode(150.0f / 255), 0, 0};
    pixel(grey, 1, 0) = {srgb_decode(90.0f / 255), 1, 1};
    save_png(grey, folder.file("grey.png"));
    save_file(folder.file("lean.bmp"), bmp(1, {{204, 128, 230, 255}}));
    write(folder, "a.obj", "mtllib a.mtl\n" + square(0, 1, "a"));
    const auto notes = [&](const std::string& material) {
        write(folder, "a.mtl", "newmtl a\n" + material);
        std::string text;
        for (const auto& note : load_obj(folder.file("a.obj")).report.notes)
            text += note.substr(note.rfind("a.mtl")) + "\n";
        return text;
    };
    // A mask without alpha counts by its red, as a number.
    CHECK(notes("map_d -s 3 3 3 grey.png\nnorm lean.bmp\n") ==
          "a.mtl, line 2: map_d has options, -s; they are not used.\n");
    const World world =
        world_of(folder, scene_text(R"({"type": "mesh", "file": "a.obj"})"));
    REQUIRE(color_seen(world, 0.25f, 0.5f) == Rgb{0.5f});
    CHECK(color_seen(world, 0.75f, 0.5f) == Rgb{-1});
    const Vec3 leaning = glm::normalize(Vec3{0.6f, 1 / 255.0f, 205 / 255.0f});
    CHECK(glm::distance(normal_seen(world, 0.25f, 0.5f), leaning) < 1e-6f);

    CHECK(notes("map_Bump -bm 2 lean.bmp\n") ==
          "a.mtl, line 2: map_Bump is a map of heights, which is not used; norm names "
          "one of normals.\n");
    CHECK(notes("map_Ke grey.png\nKe 1 1 1\nnorm lean.bmp\nnewmtl b\nKe 1 1 1\n") ==
          "a.mtl, line 2: map_Ke is not used; its material does not glow.\n");
    CHECK(load_obj(folder.file("a.obj")).parts.at(0).material.emission ==
          glm::dvec3(0));
    CHECK(notes("Ke 1 1 1\nmap_d grey.png\n") ==
          "a.mtl, line 3: a picture of holes or normals is on what glows; it is not "
          "used.\n");
    CHECK(notes("map_Kd -o 0.5 -s 2 0 -clamp on -blendu on grey.png\n") ==
          "a.mtl, line 2: map_Kd has options, -s -blendu; they are not used.\n");
    const auto loaded = load_obj(folder.file("a.obj"));
    const MeshMaterial& is = loaded.parts.at(0).material;
    CHECK(is.map.offset == glm::dvec2(0.5, 0));
    CHECK(is.map.scale == glm::dvec2(1));
    CHECK(is.wrap == PictureWrap::clamp);
}

TEST_CASE("own materials: a glTF file's picture, its holes and its normals") {
    const ScratchFolder folder;
    const auto seen = [&](const json& material) {
        write_gltf(folder, material);
        const World world = world_of(folder, scene_text(gltf_object));
        std::vector<Rgb> colors;
        for (const float y : {0.25f, 0.75f})
            for (const float x : {0.25f, 0.75f})
                colors.push_back(color_seen(world, x, y));
        return colors;
    };
    using Colors = std::vector<Rgb>;
    const Rgb red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1}, white{1}, open{-1};
    CHECK(seen(pictured()) == Colors{red, green, blue, white});
    json cut = pictured();
    cut["alphaMode"] = "MASK";
    CHECK(seen(cut) == Colors{red, open, open, white});
    cut["alphaCutoff"] = 0.3;
    CHECK(seen(cut) == Colors{red, green, open, white});
    // Alpha is multiplied by that of the factor: 100/255 of 0.7 is below 0.3.
    cut["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 0.7};
    CHECK(seen(cut) == Colors{0.5f * red, open, open, 0.5f * white});
    // Moved by half in u: left and right change places.
    json moved = pictured();
    auto& texture = moved["pbrMetallicRoughness"]["baseColorTexture"];
    texture["extensions"]["KHR_texture_transform"]["offset"] = {0.5, 0};
    CHECK(seen(moved) == Colors{green, red, white, blue});
    // Beyond its border: the border's pixels. From u = 0.25 on it is the right half.
    texture["index"] = 2;
    CHECK(seen(moved) == Colors{green, green, white, white});
    // By a quarter counter-clockwise, of coordinates whose v goes down, around the
    // upper left corner: (u, v) goes to (v, -u), which repeats.
    json turned = pictured();
    turned["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
          ["KHR_texture_transform"]["rotation"] = std::numbers::pi / 2;
    // Upper left of the square: v_down is 0.25, so u = 0.25 and v_down = -0.25: below.
    CHECK(seen(turned) == Colors{green, white, red, blue});
    // A metal: the same pictures, no diffuse lobe.
    json metal = cut;
    metal["pbrMetallicRoughness"]["metallicFactor"] = 1;
    metal["pbrMetallicRoughness"]["roughnessFactor"] = 0.5;
    CHECK(seen(metal) == Colors{0.5f * red, open, open, 0.5f * white});
    // It is one without holes as well.
    metal.erase("alphaMode");
    write_gltf(folder, metal);
    const auto painted = loaded_scene(folder, scene_text(gltf_object)).scene;
    CHECK(std::get<std::vector<MeshMetalDetailed>>(painted.materials).size() == 1);

    json dented = cut;
    dented["normalTexture"] = {{"index", 1}};
    write_gltf(folder, dented);
    const World world = world_of(folder, scene_text(gltf_object));
    const Vec3 leaning = glm::normalize(Vec3{0.6f, 1 / 255.0f, 205 / 255.0f});
    CHECK(glm::distance(normal_seen(world, 0.25f, 0.25f), leaning) < 1e-6f);
    CHECK(color_seen(world, 0.25f, 0.75f) == open);
}

TEST_CASE("own materials: what a glTF file has and we have not is said once") {
    const ScratchFolder folder;
    const auto notes = [&](const json& material, const json& more = json::object()) {
        write_gltf(folder, material, more);
        std::string report;
        (void)world_of(folder, scene_text(gltf_object + ", " + gltf_object), &report);
        return report;
    };
    const std::string open = folder.file("a.gltf") +
                             ":\ntriangle 1: 4 edges belong to one face only; the mesh "
                             "is not closed, and unsuitable for glass.\n";
    const std::string gloss =
        "the gloss over the colour of what is no metal is left out.\n";
    const auto unused = [&](const std::string& what) {
        return open + "materials[0] has what is not used: " + what + ".\n" + gloss;
    };
    CHECK(notes(pictured()) == open + gloss);
    json odd = pictured();
    odd["normalTexture"] = {{"index", 2}, {"scale", 0.5}};
    odd["alphaMode"] = "BLEND";
    odd["extensions"]["KHR_materials_clearcoat"] = json::object();
    CHECK(
        notes(odd) ==
        unused("a normalTexture that lies otherwise, scale of normalTexture, alphaMode "
               "BLEND and KHR_materials_clearcoat"));
    json lamp = pictured();
    lamp["emissiveFactor"] = {1, 1, 1};
    lamp["alphaMode"] = "MASK";
    CHECK(notes(lamp) == unused("holes and normals of what glows"));
    json mirrored = pictured();
    // The same on both axes; what is left out repeats.
    const auto wraps = [&](const json& u, const json& v) {
        return notes(mirrored, {{"samplers", {{{"wrapS", u}, {"wrapT", v}}, {}}}});
    };
    for (const auto& [kind, wrap] : {std::pair{10497, PictureWrap::repeat},
                                     {33071, PictureWrap::clamp},
                                     {33648, PictureWrap::mirror}}) {
        CHECK(wraps(kind, kind) == open + gloss);
        CHECK(load_gltf(folder.file("a.gltf")).parts.at(0).material.wrap == wrap);
        CHECK(wraps(kind, kind == 33071 ? 33648 : 33071) ==
              unused("a part of how baseColorTexture lies"));
    }
    CHECK(notes(mirrored, {{"samplers", {{{"wrapS", 33648}}, {{"wrapS", 33071}}}}}) ==
          unused("a part of how baseColorTexture lies"));
    json unlit = pictured();
    unlit["extensions"]["KHR_materials_unlit"] = json::object();
    CHECK(notes(unlit, {{"extensionsRequired", {"KHR_materials_unlit"}}}) ==
          unused("KHR_materials_unlit (matt: it needs light)"));
    // Its lamps stay where they are.
    CHECK(notes(pictured(), json::parse(R"({"nodes": [{"mesh": 0, "extensions":
                                {"KHR_lights_punctual": {"light": 0}}}],
                    "extensions": {"KHR_lights_punctual":
                                   {"lights": [{"type": "point"}]}}})")) ==
          open + gloss + "its lights are not used; write them into the scene file.\n");
}

TEST_CASE("own materials: pictures in scene files lie as they are told") {
    const ScratchFolder folder;
    write_gltf(folder, pictured());
    const auto seen = [&](const std::string& members) {
        const World world = world_of(
            folder, scene_text(R"({"type": "quad", "material": "m", "corner": [0, 0, 0],
                           "edge_u": [1, 0, 0], "edge_v": [0, 1, 0]})",
                               ", \"m\": {" + members + ", \"filter\": \"nearest\"}"));
        std::vector<Rgb> colors;
        for (const float y : {0.25f, 0.75f})
            for (const float x : {0.25f, 0.75f})
                colors.push_back(color_seen(world, x, y));
        return colors;
    };
    using Colors = std::vector<Rgb>;
    const Rgb red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1}, white{1}, open{-1};
    const std::string of_uv = R"("type": "picture", "file": "four.bmp", "map": "uv")";
    CHECK(seen(of_uv) == Colors{red, green, blue, white});
    CHECK(seen(of_uv + R"(, "offset": [0.5, 0])") == Colors{green, red, white, blue});
    CHECK(seen(of_uv + R"(, "offset": [0.5, 0], "wrap": "clamp")") ==
          Colors{green, green, white, white});
    CHECK(seen(of_uv + R"(, "offset": [1, 0], "wrap": "mirror")") ==
          Colors{green, red, white, blue});
    // (u, v) goes to (-v, u), which repeats.
    CHECK(seen(of_uv + R"(, "rotate_deg": 90)") == Colors{green, white, red, blue});
    const std::string mapped = R"("type": "mapped", "file": "four.bmp")";
    CHECK(seen(mapped) == Colors{red, green, blue, white});
    CHECK(seen(mapped + R"(, "cutoff": 0.5)") == Colors{red, open, open, white});
    CHECK(seen(mapped + R"(, "cutoff": 0.3, "offset": [0, 0.5])") ==
          Colors{open, white, red, green});

    const World world = world_of(
        folder, scene_text(R"({"type": "quad", "material": "m", "corner": [0, 0, 0],
                               "edge_u": [1, 0, 0], "edge_v": [0, 1, 0]})",
                           ", \"m\": {" + mapped + R"(, "normals": "lean.bmp"})"));
    const Vec3 leaning = glm::normalize(Vec3{0.6f, 1 / 255.0f, 205 / 255.0f});
    CHECK(glm::distance(normal_seen(world, 0.25f, 0.5f), leaning) < 1e-6f);

    // Shapes without tangents have all of it but the normals.
    const auto on_disc = [&](const std::string& members) {
        return world_of(
            folder, scene_text(R"({"type": "disc", "material": "m", "center": [0, 0, 0],
                           "normal": [0, 0, 1], "radius": 1})",
                               ", \"m\": {" + mapped + R"(, "filter": "nearest")" +
                                   members + "}"));
    };
    for (const char* members : {"", R"(, "cutoff": 0.5)"}) {
        const World disc = on_disc(members);
        std::vector<Rgb> colors;
        for (const float y : {-0.4f, 0.4f})
            for (const float x : {-0.4f, 0.4f})
                colors.push_back(color_seen(disc, x, y));
        for (const Rgb& color : {red, white})
            CHECK(std::count(colors.begin(), colors.end(), color) == 1);
        const int holes = std::string(members).empty() ? 0 : 1;
        CHECK(std::count(colors.begin(), colors.end(), green) == 1 - holes);
        CHECK(std::count(colors.begin(), colors.end(), blue) == 1 - holes);
        CHECK(std::count(colors.begin(), colors.end(), open) == 2 * holes);
    }
    CHECK_THROWS_WITH_AS((void)on_disc(R"(, "normals": "lean.bmp")"),
                         doctest::Contains("has a normal map"), std::invalid_argument);
}

TEST_CASE("own materials: a material may be called \"file\"") {
    const ScratchFolder folder;
    write_gltf(folder, pictured());
    CHECK(
        refusal(folder,
                scene_text(R"({"type": "mesh", "file": "a.gltf", "material": "file"})",
                           R"(, "file": {"type": "lambertian", "albedo": [2, 0, 0]})"))
            .find("materials.file.albedo") == 0);
    CHECK(refusal(folder, scene_text(R"({"type": "sphere", "center": [0, 0, 0],
                                         "radius": 1})")) ==
          "objects[0].material is missing.");
}

#endif
