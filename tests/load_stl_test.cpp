#include <doctest/doctest.h>

#include "ljus/io/load_stl.hpp"
#include "ljus/scenes/mesh_formulas.hpp"
#include "support/mesh_checks.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

std::string message(const Bytes& bytes) {
    return refusal_of([&] { return read_stl(bytes, "x.stl"); });
}

const MeshData ball = icosphere(Sphere{.center{1, 2, 3}, .radius = 0.7f}, 2);

} // namespace

TEST_CASE("load_stl: a mesh is the same in text and in bytes") {
    // Programs write bytes behind "solid" as well.
    for (const Bytes& bytes : {stl_bytes(ball, true), stl_bytes(ball, false),
                               stl_bytes(ball, false, "solid ball")}) {
        REQUIRE_NOTHROW((void)read_stl(bytes, "x.stl"));
        const auto loaded = read_stl(bytes, "x.stl");
        CHECK(check_whole(loaded, ball).data().normals.empty());
    }
}

TEST_CASE("load_stl: corners at one place are one vertex to smooth normals") {
    const auto loaded =
        read_stl(stl_bytes(ball, false), "x.stl", {.normals = MeshNormals::smooth});
    const MeshData& data = loaded.parts.at(0).mesh.data();
    REQUIRE(data.normals.size() == data.positions.size());
    for (std::size_t i = 0; i < data.positions.size(); ++i) {
        const Vec3 out = glm::normalize(data.positions[i] - Vec3{1, 2, 3});
        CHECK(glm::dot(out, data.normals[i]) > 0.999f);
    }
}

TEST_CASE("load_stl: two solids, capital letters, polygons, and attributes") {
    const auto loaded = read_stl(
        text_bytes("  solid a\r\nFACET NORMAL 0 0 1\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\n"
                   "VERTEX 2 0 0\r\nVERTEX 2 2 0\r\nVERTEX 0 2 0\r\nENDLOOP\r\n"
                   "ENDFACET\r\nendsolid a\r\nsolid b\r\nendsolid b\r\n"),
        "x.stl");
    CHECK(area(loaded.parts.at(0).mesh) == 4);
    CHECK(loaded.report.content.objects == 2);
    CHECK(loaded.report[MeshTrouble::edge_open].line == 8);
    // All in capitals; and a normal that points to the other side than the corners say.
    for (const std::string up : {"1", "-1", "0", "NAN"}) {
        const auto capital = read_stl(
            text_bytes("SOLID A\nFACET NORMAL 0 0 " + up +
                       "\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 2 0 0\nVERTEX 2 2 0\n"
                       "ENDLOOP\nENDFACET\nENDSOLID A\n"),
            "x.stl");
        CHECK(area(capital.parts.at(0).mesh) == 2);
        CHECK(capital.report[MeshTrouble::turned].count == (up == "-1" ? 1 : 0));
    }
    // Of a program that speaks Swedish: 1.5 x 0.75 / 2. More commas make no number.
    for (const std::string y : {"-7,5E-1", "0,7,5", "0,7.5"}) {
        const Bytes file =
            text_bytes("solid a\nfacet normal 0,0 0,0 -1,0\nouter loop\nvertex 0,0 0,0 "
                       "0,0\nvertex ,5 " +
                       y + " 0,\nvertex 1,5 0,0 0,0\nendloop\nendfacet\nendsolid a\n");
        if (y[0] == '-')
            CHECK(area(read_stl(file, "x.stl").parts.at(0).mesh) == 0.5625f);
        else
            CHECK_THROWS((void)read_stl(file, "x.stl"));
    }
    Bytes turned = stl_bytes(
        {.positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles{{0, 1, 2}}}, false);
    turned[84 + 10] = 0x80; // the normal becomes (0, 0, -1)
    turned[84 + 11] = 0xbf;
    CHECK(read_stl(turned, "x.stl").report[MeshTrouble::turned].count == 1);
    Bytes colored = stl_bytes(ball, false);
    colored[84 + 48] = 7;
    CHECK(to_text(read_stl(colored, "x.stl").report) ==
          "the triangles have attributes, perhaps colours; they are not used.\n");
}

TEST_CASE("load_stl: binary or text, whatever it begins with, and what is left over") {
    const MeshData data{.positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                        .triangles{{0, 1, 2}}};
    const auto notes = [](const Bytes& bytes) {
        const auto loaded = read_stl(bytes, "x.stl");
        CHECK(loaded.parts.at(0).mesh.size() == 1);
        return loaded.report.notes;
    };
    // As a program of CAD begins, filled up with blanks; a byte more than there are.
    Bytes solid = stl_bytes(data, false);
    const std::string head = "solid gear";
    std::fill_n(solid.begin(), 80, static_cast<unsigned char>(' '));
    std::copy(head.begin(), head.end(), solid.begin());
    CHECK(notes(solid).empty());
    solid.push_back('\n');
    CHECK(notes(solid) == std::vector<std::string>{
                              "the file goes on for 1 bytes behind the 1 triangles "
                              "that its head names; they are not used."});
    solid[80] = 0;
    CHECK(message(solid) ==
          "x.stl: no face of the file can be used; the first problem: "
          "the file goes on for 51 bytes behind the 0 triangles that "
          "its head names; they are not used.");
    // A text with a byte order mark; one that is cut off between two triangles.
    const std::string text = "\xef\xbb\xbfsolid a\nfacet normal 0 0 1\nouter loop\n"
                             "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                             "endfacet\n";
    CHECK(notes(text_bytes(text + "endsolid a\n")).empty());
    CHECK(notes(text_bytes(text)) ==
          std::vector<std::string>{
              "the file ends before 'endsolid': perhaps it is cut off."});
}

TEST_CASE("load_stl: a file that cannot be right is refused with a sentence") {
    const Bytes whole = stl_bytes(ball, false);
    const Bytes cut(whole.begin(), whole.begin() + 84 + 3 * 50 + 49);
    Bytes many = cut;
    many[83] = 255;
    Bytes none(84, 0);
    Bytes nowhere = stl_bytes(
        {.positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles{{0, 1, 2}}}, false);
    for (const std::size_t at : {84u + 14u, 84u + 15u, 84u + 26u, 84u + 27u})
        nowhere[at] = 255; // numbers that are none
    const struct {
        Bytes bytes;
        std::string why;
    } cases[]{
        {{},
         "it is neither a text that begins with 'solid' nor a binary STL file, "
         "whose head has 84 bytes."},
        {cut, "its head says that it has 320 triangles, but there are bytes for 3 "
              "only."},
        {many,
         "its head says that it has 4278190400 triangles, but there are bytes for "
         "3 only."},
        {none, "no face of the file can be used; a text has lines 'vertex 0 0 1' "
               "between 'outer loop' and 'endloop'."},
        {nowhere, "no face of the file can be used; the first problem: triangle 1: 1 "
                  "vertices have coordinates that are not finite numbers; their faces "
                  "are left out."},
        {text_bytes("solid\nouter loop\nvertex 0 0 0\n"),
         "the file ends within a triangle, before its 'endloop'."},
        {text_bytes("solid\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"),
         "no face of the file can be used; the first problem: line 5: 1 faces have "
         "fewer than three corners; they are left out."},
    };
    for (const auto& [bytes, why] : cases) CHECK(message(bytes) == "x.stl: " + why);
}

TEST_CASE("load_stl: many points that are none take no longer than others") {
    // Were each of them its own place in the table of places, this took minutes.
    Bytes bytes(80, 0);
    const int count = 40000;
    add_number(bytes, count, 4);
    for (int i = 0; i < count; ++i) bytes.insert(bytes.end(), 50, 255);
    CHECK(message(bytes).find("triangle 1: 1 vertices") != std::string::npos);
}
