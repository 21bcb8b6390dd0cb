#include <doctest/doctest.h>

#include "ljus/io/load_ply.hpp"
#include "ljus/scenes/mesh_formulas.hpp"
#include "support/mesh_checks.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

LoadedMesh read(const std::string& text) {
    return read_ply(text_bytes(text), "x.ply");
}

std::string message(const std::string& text) {
    return refusal_of([&] { return read(text); });
}

/// A header of three vertices with these properties beside x, y and z.
std::string head(const std::string& more, int vertices = 3) {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\n" + more +
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
}

const std::string triangle = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

} // namespace

TEST_CASE("load_ply: a mesh is the same in text and in bytes of either order") {
    const MeshData data = icosphere(Sphere{.center{1, 2, 3}, .radius = 0.7f}, 2);
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        CAPTURE(format);
        const auto loaded = read_ply(ply_bytes(data, format), "x.ply");
        check_normal(check_whole(loaded, data), data);
    }
    CHECK(double(area(
              read_ply(ply_bytes(data, "ascii"), "x", {.scale = 2}).parts[0].mesh)) ==
          doctest::Approx(4 * area_of(data)));
}

TEST_CASE("load_ply: what other programs write") {
    // CR LF, comments, a polygon, properties and elements in between, old names.
    const std::string text =
        "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nmade by hand\r\nobj_info "
        "none\r\n"
        "element camera 1\r\nproperty list uint8 float32 view\r\n"
        "property int16 kind\r\n"
        "element vertex 4\r\nproperty float64 x\r\nproperty uchar quality\r\n"
        "property double y\r\nproperty double z\r\nproperty float s\r\n"
        "property float t\r\n"
        "element face 1\r\nproperty uchar flags\r\n"
        "property list uint8 uint16 vertex_index\r\n"
        "property list uchar float texcoord\r\nend_header\r\n"
        "2 0.5 0.25 -7\r\n"
        "0 9 0 0 0 0\r\n2 9 0 0 1 0\r\n2 9 2 0 1 1\r\n0 9 2 0 0 1\r\n"
        "1 4 0 1 2 3 2 1 2\r\n";
    const auto loaded = read(text);
    const Mesh& mesh = loaded.parts.at(0).mesh;
    CHECK(mesh.size() == 2);
    CHECK(area(mesh) == 4);
    CHECK(mesh.data().uv.at(2) == Vec2{1, 1});
    CHECK(loaded.report.content.polygons == 1);
    const std::string odd = to_text(loaded.report);
    CHECK(odd.find("the elements camera are not used.") != std::string::npos);
    CHECK(odd.find("the header has the line made by hand, which is none of a PLY "
                   "file; it is not used.") != std::string::npos);
    CHECK(odd.find("element 6: 4 edges belong to one face only") == 0);
}

TEST_CASE("load_ply: the corners of a face may have texture coordinates") {
    // Two faces that share an edge, and a third whose list is too short.
    const auto loaded =
        read("ply\nformat ascii 1.0\ncomment TextureFile  my wood.jpg \n"
             "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 3\nproperty list uchar float texcoord\n"
             "property list uchar int vertex_indices\nend_header\n"
             "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
             "6 0.1 0.2 0.3 0.4 0.5 0.6 3 0 1 2\n6 0.7 0.8 0.9 1 0 0.25 3 0 2 3\n"
             "4 0 0 1 1 3 0 3 1\n");
    const auto& data = loaded.parts.at(0).mesh.data();
    REQUIRE(data.triangles.size() == 3);
    const auto corner = [&](std::size_t face, std::size_t k) {
        return data.uv.at(data.triangles[face][k]);
    };
    CHECK(corner(0, 1) == Vec2{0.3f, 0.4f});
    CHECK(corner(0, 2) == Vec2{0.5f, 0.6f});
    CHECK(corner(1, 0) == Vec2{0.7f, 0.8f});
    CHECK(corner(1, 2) == Vec2{0, 0.25f});
    CHECK(loaded.report[MeshTrouble::no_uv].count == 1);
    CHECK(loaded.report.notes ==
          std::vector<std::string>{"the header names the picture my wood.jpg, which is "
                                   "not loaded; a material of yours can have it."});
}

TEST_CASE("load_ply: strips of triangles, one after another in a list") {
    // A square of two triangles, a triangle, and a strip too short.
    const std::string strips = "element tristrips 1\n"
                               "property list int int vertex_indices\n";
    const std::string vertices = "element vertex 6\nproperty float x\n"
                                 "property float y\nproperty float z\n";
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 0\n2 1 0\n";
    const std::string list = "11 0 1 2 3 -1 1 4 5 -1 0 1\n";
    const std::string start = "ply\nformat ascii 1.0\n", end = "end_header\n";
    for (const bool first : {false, true}) {
        const auto loaded =
            read(first ? start + strips + vertices + end + list + points
                       : start + vertices + strips + end + points + list);
        const Mesh& mesh = loaded.parts.at(0).mesh;
        REQUIRE(mesh.size() == 3);
        for (std::uint32_t k = 0; k < 3; ++k)
            CHECK(normal(mesh.triangle(k)) == Vec3{0, 0, 1});
        CHECK(area(mesh) == 1.5);
        CHECK(loaded.report[MeshTrouble::bad_index].count == 0);
        CHECK(to_text(loaded.report).find("are not used") == std::string::npos);
    }
}

TEST_CASE("load_ply: whole numbers are signed, or not, as their type says") {
    // -1 as char, 65535 as ushort, -2 as int, in bytes of either order.
    for (const bool big : {false, true}) {
        Bytes bytes =
            text_bytes(std::string("ply\nformat binary_") + (big ? "big" : "little") +
                       "_endian 1.0\nelement vertex 3\nproperty char x\n"
                       "property ushort y\nproperty int z\nelement face 1\n"
                       "property list uchar uchar vertex_indices\nend_header\n");
        for (const int x : {-1, 1, 0}) {
            add_number(bytes, std::uint64_t(x), 1, big);
            add_number(bytes, x == 0 ? 0 : 65535, 2, big);
            add_number(bytes, std::uint64_t(-2), 4, big);
        }
        bytes.insert(bytes.end(), {3, 0, 1, 2});
        const auto loaded = read_ply(bytes, "x.ply");
        const Mesh& mesh = loaded.parts.at(0).mesh;
        CHECK(mesh.triangle(0).v1 == Vec3{-1, 65535, -2});
        CHECK(mesh.triangle(0).v2 == Vec3{1, 65535, -2});
    }
}

TEST_CASE("load_ply: the colours of vertices are interpolated between them") {
    const std::string colors =
        "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    const auto loaded = read(head(colors, 4) + "0 0 0 200 0 50\n1 0 0 100 80 50\n"
                                               "1 1 0 0 255 50\n0 1 0 60 90 50\n"
                                               "4 0 1 2 3\n");
    CHECK(loaded.report[MeshTrouble::vertex_color].count == 0);
    const Mesh& mesh = loaded.parts.at(0).mesh;
    const MeshMaterial& material = loaded.parts[0].material;
    CHECK(material.diffuse == glm::dvec3(1));
    const UvPicture picture{.image = loaded.pictures.at(material.picture.name)};
    check(picture);
    // What the colours are at the corners, found by their places.
    const auto color_of = [](const Vec3& p) {
        const glm::dvec3 bytes = p == Vec3{0, 0, 0}   ? glm::dvec3(200, 0, 50)
                                 : p == Vec3{1, 0, 0} ? glm::dvec3(100, 80, 50)
                                 : p == Vec3{1, 1, 0} ? glm::dvec3(0, 255, 50)
                                                      : glm::dvec3(60, 90, 50);
        return glm::dvec3(srgb_decode(bytes.x / 255), srgb_decode(bytes.y / 255),
                          srgb_decode(bytes.z / 255));
    };
    for (std::uint32_t part = 0; part < mesh.size(); ++part)
        for (const Vec2 at :
             {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{0.5f, 0.5f}, Vec2{0.3f, 0.2f}}) {
            const Triangle t = mesh.triangle(part);
            const glm::dvec3 right = double(1 - at.x - at.y) * color_of(t.v1) +
                                     double(at.x) * color_of(t.v2) +
                                     double(at.y) * color_of(t.v3);
            const ShapeHitT<float> hit{.u = at.x, .v = at.y, .part = part};
            const Vec2 uv = texture_coordinates(mesh, hit, SurfacePoint{});
            const glm::dvec3 found(color_at(picture, Vec3{0}, uv));
            CHECK(glm::distance(found, right) < 2e-6);
        }
    // One colour needs no picture; floating point is a colour from 0 to 1.
    const auto one = read(head("property float diffuse_red\nproperty float "
                               "diffuse_green\nproperty float diffuse_blue\n") +
                          "0 0 0 0.5 1 0\n1 0 0 0.5 1 0\n0 1 0 0.5 1 0\n3 0 1 2\n");
    CHECK(one.pictures.empty());
    CHECK(one.parts.at(0).material.diffuse.x == doctest::Approx(srgb_decode(0.5)));
    CHECK(one.parts[0].material.diffuse.y == 1);
    // Of all integers but ushort, 255 is the brightest.
    for (const std::string type : {"uchar", "int", "uint", "short", "ushort"}) {
        const std::string rgb = type == "ushort" ? " 13107 65535 0\n" : " 51 255 0\n";
        const auto whole =
            read(head("property " + type + " red\nproperty " + type +
                      " green\nproperty " + type + " blue\n") +
                 "0 0 0" + rgb + "1 0 0" + rgb + "0 1 0" + rgb + "3 0 1 2\n");
        CAPTURE(type);
        CHECK(whole.parts.at(0).material.diffuse.x ==
              doctest::Approx(srgb_decode(0.2)));
        CHECK(whole.parts[0].material.diffuse.y == 1);
    }
    // A vertex whose colour is none, and colours that are not asked for.
    const std::string none = head("property float red\nproperty float green\n"
                                  "property float blue\n") +
                             "0 0 0 0.5 1 0\n1 0 0 0.5 7 0\n0 1 0 1 1 1\n3 0 1 2\n";
    CHECK(read(none).report[MeshTrouble::vertex_color].count == 3);
    CHECK(read(none).parts.at(0).material.diffuse == glm::dvec3(0.5));
}

TEST_CASE("load_ply: colours that vary widely stay within [0, 1]") {
    // Red, green and blue: the fourth pixel would be below 0.
    const auto loaded =
        read(head("property uchar red\nproperty uchar green\nproperty uchar blue\n") +
             "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2\n");
    const UvPicture picture{
        .image = loaded.pictures.at(loaded.parts.at(0).material.picture.name)};
    CHECK_NOTHROW(check(picture)); // which refuses colours that are not
    CHECK(picture.image.width == 2);
    CHECK(picture.image.height == 2);
}

TEST_CASE("load_ply: faces may stand before the vertices, their colours are named") {
    const std::string text =
        "ply\nformat ascii 1.0\ncomment\nelement face 1\n"
        "property list uchar int vertex_indices\nproperty uchar red\n"
        "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\n"
        "property float quality\nend_header\n"
        "4 0 1 2 3 255\n0 0 0 0 0.6 0.8 7\n2 0 0 0 0.6 0.8 7\n2 2 0 0 0.6 0.8 7\n"
        "0 2 0 0 0.6 0.8 7\n";
    const auto loaded = read(text);
    CHECK(area(loaded.parts.at(0).mesh) == 4);
    CHECK(loaded.parts[0].mesh.data().normals.at(3) == Vec3{0, 0.6f, 0.8f});
    CHECK(loaded.report.notes ==
          std::vector<std::string>{
              "properties of the elements vertex are not used: quality.",
              "properties of the elements face are not used: red."});
    // A column that the header does not have shifts all that follows.
    CHECK(to_text(read(text + "9 9 9\n").report)
              .find("the file goes on for 6 bytes behind the last element that its "
                    "header lists; they are not used.") != std::string::npos);
}

TEST_CASE("load_ply: behind a header whose lines end in CR, LF is a number") {
    // Whatever lines end in: a face of ten corners, whose number is that of LF, before
    // its vertices.
    for (const char* const end : {"\r", "\r\n", "\n"}) {
        std::string header;
        for (const char* const line :
             {"ply", "format binary_little_endian 1.0", "element face 1",
              "property list uchar uchar vertex_index", "element vertex 10",
              "property uchar x", "property uchar y", "property uchar z", "end_header"})
            header.append(line).append(end);
        Bytes bytes = text_bytes(header + "\n");
        for (unsigned char i = 0; i < 10; ++i) bytes.push_back(i);
        const int places[10][2]{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0},
                                {4, 2}, {3, 2}, {2, 2}, {1, 2}, {0, 2}};
        for (const auto& [x, y] : places)
            for (const int number : {x, y, 0})
                bytes.push_back(static_cast<unsigned char>(number));
        CHECK(area(read_ply(bytes, "x.ply").parts.at(0).mesh) == 8);
    }
}

TEST_CASE("load_ply: a file that cannot be right is refused with a sentence") {
    const std::string list = "element face 1\nproperty list uchar int vertex_indices\n";
    const auto as = [&](const std::string& what, const std::string& by) {
        std::string text = head("") + triangle;
        return text.replace(text.find(what), what.size(), by);
    };
    const struct {
        std::string text, why;
    } cases[]{
        {"", "it does not begin with a line 'ply'."},
        {"plyx\n", "it does not begin with a line 'ply'."},
        {"ply\nformat ascii 1.0\n", "its header has no line 'end_header'."},
        {as("ascii", "asci"), "its format is asci; it must be ascii, "
                              "binary_little_endian or binary_big_endian."},
        {as("1.0", "2.0"), "its format has the version 2.0; only 1.0 is known."},
        {as("format ascii 1.0\n", ""), "its header has no line 'format'."},
        {as("float y", "flat y"),
         "its header has the type flat; types are char, uchar, "
         "short, ushort, int, uint, float and double."},
        {as("property float y\n", ""),
         "its vertices must have the properties x, y and z."},
        {as("vertex 3", "vertex -3"),
         "its header has -3 elements vertex; there must be a whole number of them, at "
         "most 1e9."},
        {as("vertex 3", "vertex 3,000"),
         "its header has 3,000 elements vertex; there must be a whole number of them, "
         "at most 1e9."},
        {as("vertex 3", "vertex"),
         "its header has  elements vertex; there must be a whole number of them, at "
         "most 1e9."},
        {as("element vertex 3\n", ""), "its header has a property before any element."},
        {as("list uchar", "list float"),
         "its header has a list whose length is no whole number."},
        {as("vertex 3", "vertex 999999999"),
         "the file ends within its element 5 of 999999999, vertex."},
        {as("3 0 1 2", "300000 0 1 2"),
         "the file ends within its element 1 of 1, face."},
        {as("3 0 1 2", "-3 0 1 2"),
         "element 1 of 1, face, has a list of -3 numbers; it must be a whole number."},
        {as("3 0 1 2", "x"),
         "element 1 of 1, face, has a list of NaN numbers; it must be a whole number."},
        {as("3 0 1 2", "3 0 1 9"),
         "no face of the file can be used; the first problem: element 4: 1 faces refer "
         "to a vertex that does not exist; they are left out."},
        {as("3 0 1 2", "3 0 1 1.5"),
         "no face of the file can be used; the first problem: element 4: 1 faces refer "
         "to a vertex that does not exist; they are left out."},
        {as("1 0 0", "1 nan 0"),
         "no face of the file can be used; the first problem: element 2: 1 vertices "
         "have coordinates that are not finite numbers; their faces are left out."},
        {as("vertex_indices", "corners"),
         "no face of the file can be used; the first problem: properties of the "
         "elements face are not used: corners."},
    };
    for (const auto& [text, why] : cases) CHECK(message(text) == "x.ply: " + why);
    CHECK(message("\xff\xfep") ==
          "cannot read 'x.ply': its text is UTF-16; save it as UTF-8.");
    CHECK(message("\xef\xbb\xbf" + head("") + triangle) == "nothing");
}

TEST_CASE("load_ply: no file that is cut off, or has another byte, crashes it") {
    const MeshData data = icosphere(Sphere{.center{0, 0, 0}, .radius = 1}, 0);
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const Bytes whole = ply_bytes(data, format);
        int refused = 0;
        for (std::size_t i = 0; i < whole.size(); i += 1 + i % 3) {
            const Bytes cut(whole.begin(), whole.begin() + std::ptrdiff_t(i));
            refused += refusal_of([&] { return read_ply(cut, "x"); }) != "nothing";
            Bytes other = whole;
            other[i] = static_cast<unsigned char>(other[i] + 1 + i % 200);
            (void)refusal_of([&] { return read_ply(other, "x"); });
        }
        CHECK(refused > 100);
    }
}
