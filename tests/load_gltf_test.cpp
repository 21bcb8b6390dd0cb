#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "ljus/io/load_mesh.hpp"
#include "ljus/scenes/mesh_formulas.hpp"
#include "scratch_folder.hpp"
#include "support/mesh_checks.hpp"

using namespace ljus;
using namespace ljus_test;
using nlohmann::json;
using namespace nlohmann::literals;

namespace {

std::string base64(const Bytes& bytes) {
    const std::string letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            bits = bits << 8 | (k < bytes.size() ? bytes[k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : letters[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

constexpr int u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126;

/// A file that is written piece by piece: each list of numbers is an accessor with a
/// view of its own.
struct File {
    json all = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
                   "nodes": [{"mesh": 0}]})"_json;
    Bytes bytes{};

    std::size_t view(const Bytes& part) {
        all["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", part.size()}});
        bytes.insert(bytes.end(), part.begin(), part.end());
        return all["bufferViews"].size() - 1;
    }
    std::size_t add(const std::vector<double>& numbers, const char* type, int component,
                    bool normalized = false) {
        Bytes part;
        for (const double x : numbers)
            if (component == f32)
                add_float(part, float(x));
            else
                add_number(part, std::uint64_t(std::int64_t(x)),
                           component == u8    ? 1
                           : component == u32 ? 4
                                              : 2);
        const std::size_t size = type[0] == 'S' ? 1 : std::size_t(type[3] - '0');
        all["accessors"].push_back({{"bufferView", view(part)},
                                    {"componentType", component},
                                    {"count", numbers.size() / size},
                                    {"type", type},
                                    {"normalized", normalized}});
        return all["accessors"].size() - 1;
    }
    json& primitive() { return all["meshes"][0]["primitives"][0]; }
    void positions(const std::vector<double>& at) {
        primitive()["attributes"]["POSITION"] = add(at, "VEC3", f32);
    }
    void positions(const MeshData& data) {
        std::vector<double> at, normals, corners;
        for (const Vec3& p : data.positions) at.insert(at.end(), {p.x, p.y, p.z});
        for (const Vec3& n : data.normals)
            normals.insert(normals.end(), {n.x, n.y, n.z});
        for (const auto& t : data.triangles)
            corners.insert(corners.end(), t.begin(), t.end());
        positions(at);
        primitive()["attributes"]["NORMAL"] = add(normals, "VEC3", f32);
        primitive()["indices"] = add(corners, "SCALAR", u32);
    }
    [[nodiscard]] Bytes gltf() const {
        json file = all;
        file["buffers"] = {
            {{"byteLength", bytes.size()},
             {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
        return text_bytes(file.dump());
    }
    [[nodiscard]] Bytes glb() const {
        json file = all;
        file["buffers"] = {{{"byteLength", bytes.size()}}};
        std::string text = file.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        Bytes chunk = bytes;
        chunk.resize((chunk.size() + 3) / 4 * 4, 0);
        Bytes out = text_bytes("glTF");
        add_number(out, 2, 4);
        add_number(out, 28 + text.size() + chunk.size(), 4);
        add_number(out, text.size(), 4);
        add_number(out, 0x4e4f534a, 4);
        out.insert(out.end(), text.begin(), text.end());
        add_number(out, chunk.size(), 4);
        add_number(out, 0x004e4942, 4);
        out.insert(out.end(), chunk.begin(), chunk.end());
        return out;
    }
};

/// One triangle in the plane z = 0.
File triangle() {
    File file;
    file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    return file;
}

LoadedMesh read(const File& file, const MeshFileSettings& settings = {}) {
    return read_gltf(file.glb(), "x.gltf", settings);
}

Triangle only(const LoadedMesh& loaded) {
    REQUIRE(loaded.parts.size() == 1);
    REQUIRE(loaded.parts[0].mesh.size() == 1);
    return loaded.parts[0].mesh.triangle(0);
}

} // namespace

TEST_CASE("load_gltf: a mesh is the same in .gltf and .glb") {
    const MeshData data = icosphere(Sphere{.center{1, 2, 3}, .radius = 0.7f}, 2);
    File file;
    file.positions(data);
    // In a URI any letter may be written as % and its code.
    std::string coded;
    for (const unsigned char letter : file.gltf())
        if (letter == '+' || letter == '/')
            coded += letter == '+' ? "%2B" : "%2f";
        else
            coded += static_cast<char>(letter);
    REQUIRE(coded.find("%2f") != std::string::npos);
    for (const Bytes& bytes : {file.gltf(), file.glb(), text_bytes(coded)}) {
        REQUIRE_NOTHROW((void)read_gltf(bytes, "x.gltf"));
        const auto loaded = read_gltf(bytes, "x.gltf");
        check_normal(check_whole(loaded, data), data);
    }
}

TEST_CASE("load_mesh: the end of a name says which format a file has") {
    const MeshData data = icosphere(Sphere{.center{1, 2, 3}, .radius = 0.7f}, 1);
    File file;
    file.positions(data);
    std::string obj;
    for (const Vec3& p : data.positions) obj += "v " + text_of(p) + "\n";
    for (const auto& [a, b, c] : data.triangles)
        obj += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " +
               std::to_string(c + 1) + "\n";
    const ScratchFolder folder;
    const std::pair<const char*, Bytes> files[]{{"a.obj", text_bytes(obj)},
                                                {"b.PLY", ply_bytes(data, "ascii")},
                                                {"c.stl", stl_bytes(data, false)},
                                                {"d.gltf", file.gltf()},
                                                {"e.x.glb", file.glb()}};
    for (const auto& [name, bytes] : files) {
        save_file(folder.file(name), bytes);
        REQUIRE_NOTHROW((void)load_mesh(folder.file(name)));
        const auto loaded = load_mesh(folder.file(name));
        REQUIRE(loaded.parts.size() == 1);
        CHECK(loaded.parts[0].mesh.size() == data.triangles.size());
        CHECK(double(area(loaded.parts[0].mesh)) == doctest::Approx(area_of(data)));
        CHECK(MeshFiles{}(folder.file(name), {}).parts.size() == 1);
    }
    for (const char* name : {"mesh.json", "mesh", "", "obj"})
        CHECK(refusal_of([&] { return load_mesh(name); }) ==
              std::string(name) + ": the name of a mesh file ends in .obj, .ply, .stl, "
                                  ".gltf or .glb.");
}

TEST_CASE("load_mesh: a file of meshes for a scene file, and a report of what is odd") {
    const ScratchFolder folder;
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 -1\n"
                            "f 1//1 3//1 2//1\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    const std::string good = folder.file("good.obj"), odd = folder.file("odd.obj");
    ScratchFolder::write(good, obj);
    ScratchFolder::write(odd, obj + "f 1 2 99\n");
    std::string report;
    const MeshFiles meshes{&report};
    CHECK(area(meshes(good, {.scale = 2}).parts[0].mesh) ==
          doctest::Approx(4 * (1.5 + std::sqrt(0.75))));
    CHECK(report.empty());
    (void)meshes(odd, {});
    CHECK(report.find(odd + ":\nline 10: ") == 0);
    CHECK(MeshFiles{}(odd, {}).parts.size() == 1);
}

TEST_CASE("load_gltf: triangles, strips and fans, with indices of each type or none") {
    // A square of four corners around, and of four in a zigzag.
    const std::vector<double> around{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0};
    const std::vector<double> zigzag{0, 0, 0, 2, 0, 0, 0, 2, 0, 2, 2, 0};
    const struct {
        int mode;
        std::vector<double> at, corners;
        int type;
    } cases[]{
        {4, around, {0, 1, 2, 0, 2, 3}, u8},  {4, around, {0, 1, 2, 0, 2, 3}, u16},
        {4, zigzag, {0, 1, 2, 2, 1, 3}, u32}, {5, zigzag, {}, 0},
        {5, around, {0, 1, 3, 2}, u8},        {6, around, {}, 0},
        {6, zigzag, {0, 1, 3, 2}, u16}};
    for (const auto& one : cases) {
        CAPTURE(one.mode);
        File file;
        file.positions(one.at);
        file.primitive()["mode"] = one.mode;
        if (!one.corners.empty())
            file.primitive()["indices"] = file.add(one.corners, "SCALAR", one.type);
        const auto loaded = read(file);
        const Mesh& mesh = loaded.parts.at(0).mesh;
        CHECK(mesh.size() == 2);
        CHECK(area(mesh) == 4);
        for (std::uint32_t i = 0; i < 2; ++i) CHECK(normal(mesh.triangle(i)).z == 1);
    }
    // The second and the fourth triangle have an index that does not exist.
    File many = triangle();
    many.primitive()["indices"] = many.add({0, 1, 2, 0, 1, 9}, "SCALAR", u8);
    many.all["nodes"].push_back({{"mesh", 0}});
    many.all["scenes"][0]["nodes"] = {0, 1};
    CHECK(read(many).report[MeshTrouble::bad_index].count == 2);
    CHECK(read(many).report[MeshTrouble::bad_index].line == 2);
    File lines = triangle();
    lines.all["meshes"][0]["primitives"].push_back(lines.primitive());
    lines.primitive()["mode"] = 1;
    CHECK(read(lines).report[MeshTrouble::no_face].count == 1);
}

TEST_CASE("load_gltf: nodes place meshes as matrices worked by hand do") {
    const auto placed = [](const json& node) {
        File file = triangle();
        file.all["nodes"][0].update(node);
        return only(read(file));
    };
    const auto near = [](const Vec3& a, const Vec3& b) {
        return glm::distance(a, b) < 1e-6f;
    };
    // Column by column: x to (0, 0, 2), y to (3, 0, 0), z to (0, 4, 0), then (5, 6, 7).
    const Triangle by_matrix =
        placed(R"({"matrix": [0, 0, 2, 0, 3, 0, 0, 0, 0, 4, 0, 0, 5, 6, 7, 1]})"_json);
    CHECK(by_matrix.v1 == Vec3{5, 6, 7});
    CHECK(by_matrix.v2 == Vec3{5, 6, 9});
    CHECK(by_matrix.v3 == Vec3{8, 6, 7});
    // Some programs round its last row.
    const Triangle rounded = placed(R"({"matrix":
        [0, 0, 2, 1e-7, 3, 0, 0, 0, 0, 4, 0, 0, 5, 6, 7, 0.9999999]})"_json);
    CHECK(rounded.v3 == by_matrix.v3);
    // First the scale, then a quarter turn about z, which takes x to y, then the way.
    const Triangle by_parts = placed(R"({"translation": [1, 0, 0], "scale": [2, 3, 1],
        "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]})"_json);
    CHECK(near(by_parts.v1, Vec3{1, 0, 0}));
    CHECK(near(by_parts.v2, Vec3{1, 2, 0}));
    CHECK(near(by_parts.v3, Vec3{-2, 0, 0}));
    // A mirror image keeps its front: the normal is still +z, though x is turned.
    const Triangle mirrored = placed(R"({"scale": [-1, 1, 1]})"_json);
    CHECK(normal(mirrored).z == 1);
    CHECK(std::min({mirrored.v1.x, mirrored.v2.x, mirrored.v3.x}) == -1);

    // A node within another one: the outer place after the inner one.
    File file = triangle();
    file.all["nodes"] =
        R"([{"translation": [10, 0, 0], "scale": [2, 2, 2], "children": [1]},
            {"mesh": 0, "translation": [1, 0, 0]}])"_json;
    CHECK(only(read(file)).v2 == Vec3{14, 0, 0});
    CHECK(only(read(file, {.scale = 0.5})).v2 == Vec3{7, 0, 0});
    // Without scenes it begins with nodes that no other one has.
    file.all.erase("scenes");
    CHECK(only(read(file)).v2 == Vec3{14, 0, 0});
    // The scene that is named, or else the first.
    file.all["scenes"] = R"([{"nodes": [1]}, {"nodes": [0]}])"_json;
    CHECK(only(read(file)).v2 == Vec3{2, 0, 0});
    file.all["scene"] = 1;
    CHECK(only(read(file)).v2 == Vec3{14, 0, 0});
}

TEST_CASE("load_gltf: normals stay perpendicular under a scale, and in a mirror") {
    // The plane x + y = 1 with the normal (1, 1, 0) becomes x / a + y = 1.
    for (const double a : {4.0, -4.0}) {
        File file;
        file.positions({1, 0, 0, 0, 1, 0, 1, 0, 1});
        file.primitive()["attributes"]["NORMAL"] =
            file.add({1, 1, 0, 1, 1, 0, 1, 1, 0}, "VEC3", f32);
        file.primitive()["indices"] = file.add({0, 1, 2}, "SCALAR", u8);
        file.all["nodes"][0]["scale"] = {a, 1, 1};
        const auto loaded = read(file);
        CHECK(loaded.report[MeshTrouble::turned].count == 0);
        const Vec3 right = glm::normalize(Vec3{1 / float(a), 1, 0});
        const auto& normals = loaded.parts.at(0).mesh.data().normals;
        REQUIRE(normals.size() == 3);
        for (const Vec3& n : normals) CHECK(glm::distance(n, right) < 1e-6f);
    }
}

TEST_CASE("load_gltf: accessors that are normalized, strided or sparse") {
    File file = triangle();
    // u from u8 and from i16 that mean fractions, v downwards.
    file.primitive()["attributes"]["TEXCOORD_0"] =
        file.add({0, 255, 51, 0, 255, 255}, "VEC2", u8, true);
    auto uv = read(file).parts.at(0).mesh.data().uv;
    CHECK(uv.at(1).x == doctest::Approx(0.2));
    CHECK(uv[1].y == doctest::Approx(1));
    CHECK(uv[0] == Vec2{0, 0});
    file.primitive()["attributes"]["TEXCOORD_0"] =
        file.add({-32768, 32767, -16384, 0, 0, 0}, "VEC2", i16, true);
    uv = read(file).parts.at(0).mesh.data().uv;
    CHECK(uv.at(0) == Vec2{-1, 0});
    CHECK(uv[1].x == doctest::Approx(-16384.0 / 32767));
    file.primitive()["attributes"].erase("TEXCOORD_0");

    // The same numbers with four bytes between the points.
    Bytes apart;
    for (const double x : {0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0}) add_float(apart, float(x));
    const std::size_t view = file.view(apart);
    file.all["bufferViews"][view]["byteStride"] = 16;
    file.all["accessors"][0]["bufferView"] = view;
    CHECK(only(read(file)).v3 == Vec3{0, 1, 0});

    // One point is replaced; without a view the others are 0.
    Bytes which, what;
    add_number(which, 1, 2);
    for (const float x : {7.f, 8.f, 9.f}) add_float(what, x);
    file.all["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", file.view(which)}, {"componentType", u16}}},
        {"values", {{"bufferView", file.view(what)}}}};
    CHECK(only(read(file)).v2 == Vec3{7, 8, 9});
    CHECK(only(read(file)).v3 == Vec3{0, 1, 0});
    file.all["accessors"][0].erase("bufferView");
    CHECK(refusal_of([&] { return read(file); }).find("1 faces have no area") !=
          std::string::npos);
}

TEST_CASE("load_gltf: what its materials become") {
    const auto file_of = [](const char* material) {
        File file = triangle();
        file.all["materials"] = {json::parse(material)};
        file.primitive()["material"] = 0;
        return file;
    };
    const auto made_of = [&](const char* material) {
        return read(file_of(material)).parts.at(0).material;
    };
    const MeshMaterial matt = made_of(R"({"pbrMetallicRoughness":
        {"baseColorFactor": [0.5, 0.25, 0, 1], "metallicFactor": 0}})");
    CHECK(matt.diffuse == glm::dvec3(0.5, 0.25, 0));
    CHECK_FALSE(matt.is_mirror());
    CHECK_FALSE(matt.is_glass());
    CHECK(matt.name == "materials[0]");
    const MeshMaterial older = made_of(R"({"extensions":
        {"KHR_materials_pbrSpecularGlossiness":
        {"diffuseFactor": [0.5, 0.25, 0, 1], "glossinessFactor": 0.2}}})");
    CHECK(older.diffuse == glm::dvec3(0.5, 0.25, 0));
    CHECK_FALSE(older.is_mirror());
    const char* const red_metal = R"({"pbrMetallicRoughness":
        {"baseColorFactor": [0.5, 0.25, 0, 1], "roughnessFactor": 0.3}})";
    const MeshMaterial metal = made_of(red_metal);
    CHECK(metal.is_mirror());
    CHECK(metal.specular == glm::dvec3(0.5, 0.25, 0));
    CHECK(metal.roughness == 0.3);
    CHECK(
        made_of(R"({"pbrMetallicRoughness": {"roughnessFactor": 0.001}})").roughness ==
        0);
    const MeshMaterial lamp = made_of(R"({"emissiveFactor": [1, 0.5, 0], "extensions":
        {"KHR_materials_emissive_strength": {"emissiveStrength": 6}}})");
    CHECK(lamp.emission == glm::dvec3(6, 3, 0));
    const MeshMaterial glass = made_of(R"({"extensions":
        {"KHR_materials_transmission": {"transmissionFactor": 1},
         "KHR_materials_ior": {"ior": 1.33}}})");
    CHECK(glass.is_glass());
    CHECK(glass.index == 1.33);
    const auto faint = read(file_of(R"({"extensions":
        {"KHR_materials_transmission": {"transmissionFactor": 0.5}}})"));
    CHECK_FALSE(faint.parts.at(0).material.is_glass());
    CHECK(faint.report.notes.at(0) ==
          "materials[0] has what is not used: a transmissionFactor of at most 0.5.");

    Scene<Shapes<Mesh>, Materials<Lambertian, Mirror, Glossy, Glass>> scene;
    add_meshes(scene, read(file_of(red_metal)));
    REQUIRE(std::get<std::vector<Glossy>>(scene.materials).size() == 1);
    CHECK(std::get<std::vector<Glossy>>(scene.materials)[0].reflectance ==
          Rgb{0.5f, 0.25f, 0});
}

TEST_CASE("load_gltf: pictures of colour, of metal and roughness, and colours") {
    // BMP: 2 x 1 pixels, left red 255 and right green 255 blue 255, bottom row first.
    Bytes bmp = text_bytes("BM");
    for (const int word : {54 + 8, 0, 54, 40, 2, 1})
        add_number(bmp, std::uint64_t(word), 4);
    add_number(bmp, 1, 2);
    add_number(bmp, 24, 2);
    for (int i = 0; i < 6; ++i) add_number(bmp, 0, 4);
    bmp.insert(bmp.end(), {0, 0, 255, 255, 255, 0, 0, 0});
    File file;
    file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 3, 0, 0, 2, 1, 0});
    file.primitive()["attributes"]["TEXCOORD_1"] =
        file.add({0.2, 0, 0.2, 0, 0.2, 1, 0.8, 0, 0.8, 0, 0.8, 1}, "VEC2", f32);
    file.all["images"] = {{{"bufferView", file.view(bmp)}, {"mimeType", "image/bmp"}}};
    file.all["textures"] = {{{"source", 0}}};
    file.all["materials"] = R"([{"name": "two", "pbrMetallicRoughness":
        {"baseColorTexture": {"index": 0, "texCoord": 1}, "roughnessFactor": 0.5,
         "metallicRoughnessTexture": {"index": 0, "texCoord": 1}}}])"_json;
    file.primitive()["material"] = 0;
    const auto loaded = read(file);
    // To the left blue and green are 0: no metal. To the right they are 1.
    REQUIRE(loaded.parts.size() == 2);
    CHECK_FALSE(loaded.parts[0].material.is_mirror());
    CHECK(loaded.parts[1].material.is_mirror());
    CHECK(loaded.parts[1].material.roughness == 0.5);
    REQUIRE(loaded.pictures.size() == 1);
    CHECK(loaded.pictures.begin()->first == "x.gltf, images[0]");
    const Image& image = loaded.pictures.begin()->second;
    CHECK(pixel(image, 0, 0) == Rgb{1, 0, 0});
    CHECK(loaded.parts[0].material.picture.name == "x.gltf, images[0]");
    CHECK(loaded.parts[0].mesh.data().uv.at(2) == Vec2{0.2f, 0});
    // In the older extension, with holes.
    File older = file;
    older.all["materials"] = R"([{"alphaMode": "MASK", "extensions":
        {"KHR_materials_pbrSpecularGlossiness":
         {"diffuseTexture": {"index": 0, "texCoord": 1}}}}])"_json;
    const auto matt = read(older);
    REQUIRE(matt.parts.size() == 1);
    CHECK_FALSE(matt.parts[0].material.is_mirror());
    CHECK(matt.parts[0].material.picture.name == "x.gltf, images[0]");
    CHECK(matt.parts[0].material.mask.name == "x.gltf, images[0] (alpha)");
    CHECK(matt.parts[0].mesh.data().uv.at(2) == Vec2{0.2f, 0});
    // Roughness divides metals only.
    file.all["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 0;
    CHECK(read(file).parts.size() == 1);
    CHECK(loaded.report.notes.at(0).find("materials[0] (two) has what is not "
                                         "used: metallicRoughnessTexture within a") ==
          0);

    // Colours of vertices are linear, and the base colour multiplies them.
    File colored = triangle();
    colored.primitive()["attributes"]["COLOR_0"] =
        colored.add({255, 0, 0, 255, 255, 0, 0, 0, 255, 0, 0, 0}, "VEC4", u8, true);
    colored.all["materials"] = R"([{"pbrMetallicRoughness":
        {"baseColorFactor": [0.5, 1, 1, 1], "metallicFactor": 0}}])"_json;
    colored.primitive()["material"] = 0;
    const auto red = read(colored);
    CHECK(red.parts.at(0).material.diffuse == glm::dvec3(0.5, 0, 0));
    CHECK(red.pictures.empty());
    // A metal has them as well, of one colour or of several.
    colored.all["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 1;
    CHECK(read(colored).parts.at(0).material.specular == glm::dvec3(0.5, 0, 0));
    colored.primitive()["attributes"]["COLOR_0"] =
        colored.add({255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255}, "VEC4", u8, true);
    const auto three = read(colored);
    CHECK(three.pictures.size() == 1);
    CHECK_FALSE(three.parts.at(0).material.picture.name.empty());
    // A smooth one has no picture, and it is said.
    colored.all["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 0;
    CHECK(read(colored).pictures.empty());
}

TEST_CASE("load_gltf: cameras and lights stand where their nodes do") {
    File file = triangle();
    file.all["cameras"] = R"([
        {"name": "front", "type": "perspective", "perspective": {"yfov": 1}},
        {"type": "orthographic"}])"_json;
    file.all["extensions"]["KHR_lights_punctual"]["lights"] = R"([
        {"type": "point", "color": [1, 0.5, 0], "intensity": 8},
        {"type": "directional", "intensity": 3},
        {"type": "spot", "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}}
        ])"_json;
    // A quarter turn about y takes -z, along which all of them look, to -x.
    json light = R"({"rotation": [0, 0.7071067811865476, 0, 0.7071067811865476],
        "translation": [2, 0, 0], "extensions": {"KHR_lights_punctual": {}}})"_json;
    file.all["nodes"] = R"([{"mesh": 0}, {"camera": 0, "translation": [0, 0, 5]},
                            {"camera": 1}])"_json;
    for (int i = 0; i < 3; ++i) {
        light["extensions"]["KHR_lights_punctual"]["light"] = i;
        file.all["nodes"].push_back(light);
    }
    // A sun in a node of no size shines nowhere.
    light["extensions"]["KHR_lights_punctual"]["light"] = 1;
    light["scale"] = {0, 0, 0};
    file.all["nodes"].push_back(light);
    file.all["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5, 6};
    const auto loaded = read(file, {.scale = 3});
    REQUIRE(loaded.cameras.size() == 1);
    CHECK(loaded.cameras[0].name == "front");
    CHECK(loaded.cameras[0].camera.position == Vec3{0, 0, 15});
    CHECK(loaded.cameras[0].camera.forward.z == -1);
    CHECK(loaded.cameras[0].camera.half_height == doctest::Approx(std::tan(0.5)));
    CHECK(to_text(loaded.report)
              .find("cameras[1] is no perspective camera; it is left "
                    "out.") != std::string::npos);
    CHECK(to_text(loaded.report).find("is left out: sun light.direction is") !=
          std::string::npos);
    CHECK(to_text(loaded.report).find("..") == std::string::npos);
    REQUIRE(loaded.points.size() == 1);
    CHECK(loaded.points[0].position == Vec3{6, 0, 0});
    CHECK(loaded.points[0].intensity == Rgb{72, 36, 0}); // 8 * 3^2
    REQUIRE(loaded.suns.size() == 1);
    CHECK(loaded.suns[0].irradiance == Rgb{3, 3, 3});
    CHECK(glm::distance(loaded.suns[0].direction, Vec3{-1, 0, 0}) < 1e-6f);
    REQUIRE(loaded.spots.size() == 1);
    CHECK(glm::distance(loaded.spots[0].direction, Vec3{-1, 0, 0}) < 1e-6f);
    CHECK(loaded.spots[0].outer_degrees == doctest::Approx(28.6479));

    Scene<Shapes<Mesh>, Materials<Lambertian>, Lights<PointLight, SpotLight, SunLight>>
        scene;
    add_meshes(scene, loaded);
    CHECK(scene.light_count() == 3);
}

TEST_CASE("load_gltf: of variants of materials a mesh has the first") {
    File file = triangle();
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        file.all[list] = {"KHR_materials_variants",
                          "KHR_materials_pbrSpecularGlossiness"};
    std::string notes;
    REQUIRE_NOTHROW(notes = to_text(read(file).report));
    CHECK(notes.find("extensionsUsed[0] is KHR_materials_variants, which is not known: "
                     "what it adds is left out") != std::string::npos);
}

TEST_CASE("load_gltf: a file that cannot be right is refused with a sentence") {
    const struct {
        const char *list, *patch; // of the file, or of the first entry of a list
        std::string why;
    } cases[]{
        {"", R"({"asset": null})", "asset is missing."},
        {"", R"({"asset": {"version": "1.0"}})",
         "asset.version is \"1.0\"; it must be 2.0, the version of glTF that is "
         "known."},
        {"", R"({"extensionsRequired": ["KHR_draco_mesh_compression"]})",
         "extensionsRequired[0] is KHR_draco_mesh_compression, which is not known: "
         "export the file again without compression of its meshes."},
        {"", R"({"extensionsRequired": ["EXT_meshopt_compression"]})",
         "extensionsRequired[0] is EXT_meshopt_compression, which is not known: "
         "export the file again without compression of its meshes."},
        {"",
         R"({"extensionsRequired": ["KHR_texture_transform", "KHR_texture_basisu"]})",
         "extensionsRequired[1] is KHR_texture_basisu, which is not known: export the "
         "file again with pictures in PNG or JPEG."},
        {"", R"({"extensionsRequired": ["EXT_texture_webp"]})",
         "extensionsRequired[0] is EXT_texture_webp, which is not known: export the "
         "file again with pictures in PNG or JPEG."},
        {"", R"({"extensionsRequired": ["KHR_materials_volume"]})",
         "extensionsRequired[0] is KHR_materials_volume, which is not known: export "
         "the file again without it."},
        {"", R"({"asset": {"minVersion": "2.1"}})",
         "asset.minVersion is \"2.1\"; it must be 2.0, the version of glTF that is "
         "known."},
        {"nodes", R"({"matrix": [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]})",
         "nodes[0].matrix is a list of 16 entries; it must be a matrix "
         "whose last row, every fourth number, is 0, 0, 0, 1."},
        {"", R"({"scene": 3})", "scene is 3; it must be a whole number within [0, 0]."},
        {"", R"({"animations": [{}], "nodes": [{}]})",
         "no face of the file can be used; its scene must have nodes with meshes of "
         "triangles."},
        {"", R"({"meshes": null})",
         "nodes[0].mesh names one of meshes, but there are none."},
        {"nodes", R"({"mesh": -1})",
         "nodes[0].mesh is -1; it must be a whole number within [0, 0]."},
        {"nodes", R"({"children": [0]})",
         "nodes[0] is below two nodes, or below itself."},
        {"nodes", R"({"rotation": [0, 0, 0, 0]})",
         "nodes[0].rotation is [0,0,0,0]; it must be a quaternion that is not 0."},
        {"nodes", R"({"scale": [1, 2]})",
         "nodes[0].scale is [1,2]; it must be a list of 3 numbers."},
        {"accessors", R"({"count": 4})",
         "accessors[0] has 4 elements of 12 bytes, which do not fit into the 36 bytes "
         "of its view."},
        {"accessors", R"({"count": 1e9})",
         "accessors[0].count is 1000000000.0; it must be a whole number within [1, "
         "33554432]."},
        {"accessors", R"({"count": 2e7, "bufferView": null})",
         "accessors[0].count is 20000000.0; it must be at most 1048576, because there "
         "is no bufferView."},
        {"accessors", R"({"byteOffset": 1})",
         "accessors[0] has 3 elements of 12 bytes, which do not fit into the 36 bytes "
         "of its view."},
        {"accessors", R"({"type": "MAT4"})",
         "accessors[0].type is \"MAT4\"; it must be VEC3."},
        {"accessors", R"({"componentType": 5124})",
         "accessors[0].componentType is 5124; it must be 5120, 5121, 5122, 5123, 5125 "
         "or 5126."},
        {"bufferViews", R"({"byteStride": 4})",
         "accessors[0] has elements of 12 bytes, but the next one begins after 4 "
         "bytes."},
        {"bufferViews", R"({"byteOffset": 39})",
         "bufferViews[0] has bytes 39 to 75 of a buffer of 39."},
        {"bufferViews", R"({"byteLength": 1e12})",
         "bufferViews[0] has bytes 0 to 1000000000000 of a buffer of 39."},
    };
    for (const auto& [list, patch, why] : cases) {
        File file = triangle();
        file.primitive()["indices"] = file.add({0, 1, 2}, "SCALAR", u8);
        (*list == '\0' ? file.all : file.all[list][0]).merge_patch(json::parse(patch));
        CHECK(refusal_of([&] { return read(file); }) == "x.gltf: " + why);
    }

    // A mesh that is there compressed only; and one that is there in full as well.
    File draco = triangle();
    draco.primitive()["extensions"]["KHR_draco_mesh_compression"] = json::object();
    CHECK(read(draco).parts.size() == 1);
    draco.all["accessors"][0].erase("bufferView");
    CHECK(refusal_of([&] { return read(draco); }) ==
          "x.gltf: meshes[0].primitives[0] is compressed by "
          "KHR_draco_mesh_compression, which is not known: export the file again "
          "without it.");

    const auto refused = [](const Bytes& bytes) {
        return refusal_of([&] { return read_gltf(bytes, "x.glb"); });
    };
    const Bytes whole = triangle().glb();
    const auto with = [&](std::size_t place, unsigned char byte) {
        Bytes other = whole;
        other[place] = byte;
        return refused(other);
    };
    CHECK(refused({}) == "x.glb: the file is empty.");
    CHECK(refused({whole.begin(), whole.begin() + 19}) ==
          "x.glb: it ends within its head of 20 bytes.");
    CHECK(with(4, 1) ==
          "x.glb: it is a binary glTF file of version 1; only 2 is known.");
    CHECK(with(11, 1).find("x.glb: its head says that it has 16777") == 0);
    CHECK(with(15, 1).find("x.glb: its chunk at byte 12 says that it has 16777") == 0);
    CHECK(with(16, 1) == "x.glb: its first chunk must be JSON.");
    json far = triangle().all;
    const auto buffer = [&](const std::string& uri) {
        far["buffers"][0] = {{"byteLength", 36}};
        if (!uri.empty()) far["buffers"][0]["uri"] = uri;
        return refused(text_bytes(far.dump()));
    };
    CHECK(buffer("") == "x.glb: buffers[0] has no uri, and the file no bytes for it.");
    CHECK(buffer("data:;base64,AAAA") ==
          "x.glb: buffers[0] must have 36 bytes, but has 3.");
    CHECK(buffer("data:,AAAA") ==
          "x.glb: buffers[0].uri holds its data in another way than base64.");
    CHECK(buffer("data:;base64,A?AA") ==
          "x.glb: buffers[0].uri has a letter that base64 does not have.");
    CHECK(buffer("https://a.b/c.bin") ==
          "x.glb: buffers[0].uri is an address; only files beside this one are read.");
    CHECK(buffer("no%20such.bin").find("cannot read 'no such.bin': ") == 0);
}

TEST_CASE("load_gltf: one small file cannot ask for more than its bytes are worth") {
    // A mesh of many corners that lie on the same bytes, placed by many nodes.
    File file = triangle();
    file.primitive()["indices"] = file.add(std::vector<double>(30000, 1), "SCALAR", u8);
    file.all["nodes"] = std::vector<json>(5000, {{"mesh", 0}});
    file.all.erase("scenes");
    CHECK(refusal_of([&] {
              return read(file);
          }).find("the file must have at most 8388608 triangles.") !=
          std::string::npos);
    File many = triangle();
    many.primitive()["mode"] = 1;
    auto& primitives = many.all["meshes"][0]["primitives"];
    primitives = std::vector<json>(2000, many.primitive());
    many.all["nodes"] = std::vector<json>(1000, {{"mesh", 0}});
    many.all.erase("scenes");
    CHECK(refusal_of([&] {
              return read(many);
          }).find("nodes must place at most 1048576 primitives.") != std::string::npos);
}

TEST_CASE("load_gltf: what is not used is said") {
    File file = triangle();
    file.all["animations"] = {json::object(), json::object()};
    file.all["skins"] = {json::object()};
    file.all["nodes"][0]["skin"] = 0;
    file.primitive()["targets"] = {json::object()};
    file.all["materials"] = R"([{"name": "odd", "occlusionTexture": {"index": 0},
        "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0},
        "alphaMode": "MASK", "extensions": {"KHR_materials_sheen": {}}}])"_json;
    file.primitive()["material"] = 0;
    file.primitive()["indices"] = file.add({0, 1, 2, 0, 1}, "SCALAR", u8);
    file.all["extensionsUsed"] = {"KHR_materials_sheen", "KHR_texture_transform",
                                  "EXT_mesh_gpu_instancing"};
    const auto loaded = read(file);
    CHECK(loaded.parts.at(0).material.emission == glm::dvec3(0));
    std::string notes;
    for (const std::string& note : loaded.report.notes) notes += note + "\n";
    CHECK(notes == "extensionsUsed[2] is EXT_mesh_gpu_instancing, which is not known: "
                   "what it adds is left out.\n"
                   "meshes[0].primitives[0] has 5 corners of triangles; the last 2 are "
                   "left out.\n"
                   "materials[0] (odd) has what is not used: occlusionTexture, "
                   "emissiveTexture, alphaMode MASK and KHR_materials_sheen.\n"
                   "2 animations are not used.\n"
                   "1 nodes have skins, which are not used: their meshes stand "
                   "as they were modelled.\n"
                   "1 primitives have morph targets, which are not used.\n");

    File dented = triangle();
    dented.all["images"] = {{{"uri", "none.png"}}};
    dented.all["textures"] = {{{"source", 0}}};
    dented.all["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    dented.primitive()["material"] = 0;
    // Without its picture a mesh is still a mesh.
    const auto says = [&](const char* list, const json& first) {
        File other = dented;
        other.all[list] = {first};
        return to_text(read(other).report);
    };
    CHECK(says("textures", json::object())
              .find("textures[0]: it has no source, or one that is not known: export "
                    "the file again with pictures in PNG or JPEG.\n") !=
          std::string::npos);
    CHECK(says("images", {{"uri", "https://a.b/c.png"}})
              .find("images[0].uri is an address; only files beside this one are "
                    "read.\n") != std::string::npos);
    const auto says_tangents = [&] {
        const auto all = read(dented).report.notes;
        return std::count(all.begin(), all.end(),
                          "1 primitives have TANGENT, which is not used: a normal map "
                          "lies along the texture coordinates of each triangle.");
    };
    CHECK(says_tangents() == 0);
    dented.primitive()["attributes"]["TANGENT"] = 0;
    CHECK(says_tangents() == 1);
}

TEST_CASE("load_gltf: no file that is cut off, or has another byte, crashes it") {
    File file;
    file.positions(icosphere(Sphere{.center{0, 0, 0}, .radius = 1}, 0));
    const Bytes whole = file.glb();
    int refused = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        const Bytes cut(whole.begin(), whole.begin() + std::ptrdiff_t(i));
        refused += refusal_of([&] { return read_gltf(cut, "x"); }) != "nothing";
        Bytes other = whole;
        other[i] = static_cast<unsigned char>(other[i] + 1 + i % 200);
        (void)refusal_of([&] { return read_gltf(other, "x"); });
    }
    CHECK(refused == int(whole.size()));
}
