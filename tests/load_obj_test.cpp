#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "ljus/io/load_obj.hpp"
#include "ljus/io/png.hpp"
#include "ljus/math/random.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/scene/world.hpp"
#include "ljus/scenes/mesh_formulas.hpp"
#include "scratch_folder.hpp"
#include "support/refusal.hpp"

#if __has_include(<sys/stat.h>)
#include <sys/stat.h>
#endif

using namespace ljus;

namespace {

/// A scene that lists the pictures of an OBJ file.
using Painted = Scene<Shapes<Mesh>, Materials<Lambertian, MeshPicture>>;

/// A cube with outward sides, in polygons of four corners.
const std::string cube = R"(# a cube
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
vn 0 0 1
vn 0 0 -1
f 1 4 3 2
f 5//1 6//1 7//1 8//1
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)";

void append(std::string& text, const char* word, const Vec3& v) {
    for (const float x : {v.x, v.y, v.z}) {
        text.append(word).append(to_text(x));
        word = " ";
    }
    text.append("\n");
}

std::string obj_text(const MeshData& data) {
    std::string text;
    for (const Vec3& p : data.positions) append(text, "v ", p);
    for (const Vec3& n : data.normals) append(text, "vn ", n);
    for (const auto& t : data.triangles) {
        const char* word = "f ";
        for (const std::uint32_t i : t) {
            const std::string number = std::to_string(i + 1);
            text.append(word).append(number).append("//").append(number);
            word = " ";
        }
        text.append("\n");
    }
    return text;
}

std::string message(const std::string& text, const MeshFileSettings& settings = {}) {
    return ljus_test::refusal<std::exception>(
        [&] { (void)read_obj(text, "x.obj", settings); }, "nothing");
}

MeshCount trouble(const std::string& text, MeshTrouble which) {
    return read_obj(text, "x.obj").report[which];
}

/// At how many corners two meshes differ.
int differences(const MeshData& a, const MeshData& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto j = a.triangles[i][k], l = b.triangles[i][k];
            count += a.positions[j] != b.positions[l] ||
                     glm::distance(a.normals[j], b.normals[l]) >= 1e-6f;
        }
    return count;
}

double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::uint32_t i = 0; i < mesh.size(); ++i) {
        const auto t = mesh.triangle(i);
        sum += double(glm::dot(t.v1, glm::cross(t.v2, t.v3))) / 6;
    }
    return sum;
}

} // namespace

TEST_CASE("load_obj: a cube of quads") {
    const auto loaded = read_obj(cube, "cube.obj", {.scale = 0.5});
    CHECK(to_text(loaded.report).empty());
    REQUIRE(loaded.parts.size() == 1);
    const Mesh& mesh = loaded.parts[0].mesh;
    CHECK(mesh.size() == 12);
    CHECK(area(mesh) == doctest::Approx(6));
    CHECK(volume(mesh) == doctest::Approx(1));
    // The side with normals has them, the others have none.
    int smooth_corners = 0;
    for (const Vec3& n : mesh.data().normals) smooth_corners += n == Vec3{0} ? 0 : 1;
    CHECK(smooth_corners == 4);
    CHECK(read_obj(cube, "c", {.normals = MeshNormals::flat})
              .parts[0]
              .mesh.data()
              .normals.empty());
    const auto round = read_obj(cube, "c", {.normals = MeshNormals::smooth});
    REQUIRE(round.parts[0].mesh.data().normals.size() == 8);
    CHECK(round.parts[0].mesh.data().normals[0].x == doctest::Approx(-0.57735));
}

TEST_CASE("load_obj: what is written is read again, to the last bit") {
    const MeshData data = icosphere(Sphere{.center{1, 2, 3}, .radius = 0.7f}, 3);
    const auto loaded = read_obj(obj_text(data), "x.obj");
    CHECK(to_text(loaded.report).empty());
    const MeshData& again = loaded.parts[0].mesh.data();
    REQUIRE(again.triangles.size() == data.triangles.size());
    CHECK(again.positions.size() == data.positions.size());
    CHECK(differences(data, again) == 0);
}

TEST_CASE("load_obj: line ends, numbers from the end, comments, no last line feed") {
    std::string dos;
    for (const char c : cube)
        dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
    std::string mac = cube;
    for (char& c : mac) c = c == '\n' ? '\r' : c;
    for (const std::string& text : {dos, mac, cube.substr(0, cube.size() - 1)})
        CHECK(read_obj(text, "x").parts[0].mesh.size() == 12);
    for (const std::string& text : {dos, mac}) // lines are counted alike
        CHECK(trouble(text + "f 1 2 99\r\n", MeshTrouble::bad_index).line == 18);
    const auto back = read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n", "x");
    CHECK(back.parts[0].mesh.triangle(0).v1 == Vec3{0, 0, 0});
    CHECK(back.parts[0].mesh.triangle(0).v2 == Vec3{1, 0, 0});
}

TEST_CASE("load_obj: polygons are cut along their own shape") {
    // A hollow polygon: a fan from its first corner would leave it.
    const auto loaded = read_obj("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\n"
                                 "f 3 4 5 1 2\n",
                                 "x");
    const Mesh& mesh = loaded.parts[0].mesh;
    CHECK(mesh.size() == 3);
    CHECK(area(mesh) == doctest::Approx(10)); // 16 - 6
    for (std::uint32_t i = 0; i < mesh.size(); ++i)
        CHECK(normal(mesh.triangle(i)).z == 1);
    std::string circle;
    std::string face = "f";
    for (int i = 0; i < 1000; ++i) {
        const double a = 2 * std::numbers::pi * i / 1000;
        append(circle, "v ", Vec3(std::cos(a), std::sin(a), 0));
        face.append(" ").append(std::to_string(i + 1));
    }
    const auto disc = read_obj(circle + face, "x");
    CHECK(area(disc.parts[0].mesh) == doctest::Approx(std::numbers::pi).epsilon(1e-4));
    CHECK(message(circle + face + " 1").find("more than 1000 corners") !=
          std::string::npos);
}

namespace {

using Corners = std::vector<glm::dvec3>;

/// Twice the area of a polygon in z = 0, by the shoelace formula.
double twice_area(const Corners& corners) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
        sum += glm::cross(corners[i], corners[(i + 1) % corners.size()]).z;
    return sum;
}

/// Cuts a polygon in z = 0; the triangles fill it and turn its way.
/// \param flat  Some may have no area, or be missing.
void check_cut(const Corners& corners, bool flat = false) {
    const auto cut = detail::cut_polygon(corners);
    CHECK_FALSE(cut.crossed);
    if (!flat) REQUIRE(cut.triangles.size() == corners.size() - 2);
    double sum = 0;
    for (const auto& [a, b, c] : cut.triangles) {
        const double twice =
            glm::cross(corners[b] - corners[a], corners[c] - corners[a]).z;
        REQUIRE(twice > (flat ? -1e-12 : 0));
        sum += twice;
    }
    REQUIRE(sum == doctest::Approx(twice_area(corners)).epsilon(1e-9));
}

/// A corner in z = 0.
glm::dvec3 corner(double angle, double radius) {
    return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

} // namespace

TEST_CASE("load_obj: random polygons are cut into triangles that all turn one way") {
    RandomStream stream = random_stream(7, Pass::user, 0, 0);
    for (int round = 0; round < 300; ++round) {
        // Around a point, at any radius: mostly hollow corners.
        const int most = round % 10 == 0 ? 120 : 9;
        const int count = 4 + int(next_1d<double>(stream) * most);
        Corners corners;
        for (int i = 0; i < count; ++i) {
            const double turn = (i + 0.5 * next_1d<double>(stream)) / count;
            corners.push_back(
                corner(2 * std::numbers::pi * turn, 0.1 + next_1d<double>(stream)));
        }
        check_cut(corners);
    }
    // A ring of corners at random radii, and a hole in it, clockwise, joined by a bridge
    // that is walked twice. Both begin at the angle 0; the edges of the outer one stay
    // beyond 0.75 of its least radius, as its corners are at most a fifth of a turn
    // apart.
    const auto ring = [&](int count, double least, double most, bool back) {
        Corners corners;
        for (int i = 0; i < count; ++i)
            corners.push_back(corner(2 * std::numbers::pi * (back ? -i : i) / count,
                                     least + (most - least) * next_1d<double>(stream)));
        return corners;
    };
    for (int round = 0; round < 300; ++round) {
        const int count = 5 + int(next_1d<double>(stream) * 20);
        Corners corners = ring(count, 2, 4, false);
        const Corners hole = ring(count, 0.2, 1.5, true);
        corners.push_back(corners[0]);
        corners.insert(corners.end(), hole.begin(), hole.end());
        corners.push_back(hole[0]);
        check_cut(corners, true);
    }
}

TEST_CASE("load_obj: a polygon that is not flat is cut as it is seen along its area") {
    // As before, around an axis that leans from all others, and up to 0.1 off a plane.
    RandomStream stream = random_stream(8, Pass::user, 0, 0);
    const glm::dvec3 normal = glm::normalize(glm::dvec3{1, 1.1, 1.2});
    const glm::dvec3 u = glm::normalize(glm::cross(normal, glm::dvec3{1, 0, 0}));
    const glm::dvec3 v = glm::cross(normal, u);
    for (int round = 0; round < 300; ++round) {
        const int count = 4 + int(next_1d<double>(stream) * 9);
        Corners corners;
        for (int i = 0; i < count; ++i) {
            const double a = 2 * std::numbers::pi * i / count;
            const double r = 0.3 + next_1d<double>(stream);
            const double off = 0.1 * next_1d<double>(stream);
            corners.push_back(r * std::cos(a) * u + r * std::sin(a) * v + off * normal);
        }
        glm::dvec3 area{0};
        for (std::size_t i = 0; i < corners.size(); ++i)
            area += glm::cross(corners[i], corners[(i + 1) % corners.size()]);
        const auto cut = detail::cut_polygon(corners);
        REQUIRE(cut.triangles.size() == corners.size() - 2);
        CHECK_FALSE(cut.crossed);
        for (const auto& [a, b, c] : cut.triangles)
            REQUIRE(glm::dot(area, glm::cross(corners[b] - corners[a],
                                              corners[c] - corners[a])) > 0);
    }
}

TEST_CASE(
    "load_obj: an ear is cut off where it leaves nothing wrong, from any corner") {
    // Of the first, the corner before an ear is an ear no longer when that is cut off.
    // Of the second, the fourth corner lies between the first and the third: were the
    // second one cut off there, what is left would have no area. The third is two
    // triangles that meet in the fourth corner, on the first side. The fourth corner of
    // the last is on the line from the third to the first.
    const Corners polygons[] = {
        {{7, 8, 0}, {6, 6, 0}, {6, 3, 0}, {1, 2, 0}, {7, 0, 0}, {6, 2, 0}},
        {{6, 4, 0}, {6, 5, 0}, {4, 6, 0}, {5, 5, 0}, {1, 1, 0}},
        {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}},
        {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}}};
    for (const Corners& polygon : polygons)
        for (std::size_t first = 0; first < polygon.size(); ++first) {
            CAPTURE(first);
            Corners turned = polygon;
            std::rotate(turned.begin(), turned.begin() + std::ptrdiff_t(first),
                        turned.end());
            check_cut(turned, &polygon == &polygons[2]);
        }
}

TEST_CASE("load_obj: the parts of a polygon may meet in one of its corners") {
    // Two triangles on top of each other, a V, one in which corners that coincide become
    // neighbours, and four random parts around a point.
    std::vector<Corners> polygons{
        {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}},
        {{0, 0, 0}, {2, 3, 0}, {1, 3, 0}, {0, 0, 0}, {-1, 3, 0}, {-2, 3, 0}},
        {{3, 2, 0}, {2, 2, 0}, {2, 3, 0}, {3, 3, 0}, {3, 4, 0}, {5, 4, 0}, {5, 5, 0},
         {3, 5, 0}, {3, 4, 0}, {1, 4, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {3, 1, 0}}};
    RandomStream stream = random_stream(9, Pass::user, 0, 0);
    for (int round = 0; round < 50; ++round) {
        Corners corners;
        for (int part = 0; part < 4; ++part) {
            corners.push_back({0, 0, 0});
            for (int i = 0; i < 4; ++i)
                corners.push_back(corner(part + i / 5.0 + 0.1 * round,
                                         0.2 + next_1d<double>(stream)));
        }
        polygons.push_back(corners);
    }
    for (Corners& polygon : polygons)
        for (std::size_t first = 0; first < polygon.size(); ++first) {
            CAPTURE(first);
            std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
            check_cut(polygon, true);
        }
    // No triangle without an area is counted.
    const auto loaded = read_obj("v 0 0 0\nv 2 0 0\nv 1 1 0\nv 2 2 0\nv 0 2 0\n"
                                 "f 1 2 3 4 5 3\n",
                                 "x.obj");
    CHECK(loaded.parts.at(0).mesh.size() == 2);
    CHECK(to_text(loaded.report) ==
          "line 6: 6 edges belong to one face only; the mesh is not closed, and "
          "unsuitable for glass.\n");
}

TEST_CASE("load_obj: of corners without an area nothing is cut") {
    // On a line, at one point, there and back again, and too few of them.
    for (const glm::dvec3& along :
         {glm::dvec3{1, 0, 0}, glm::dvec3{0, -2, 0}, glm::dvec3{1, 2, 4}})
        for (const int count : {0, 1, 2, 3, 4, 7})
            for (const int step : {0, 1, 2}) {
                std::vector<glm::dvec3> corners;
                for (int i = 0; i < count; ++i)
                    corners.push_back(glm::dvec3{5, 0, 3} +
                                      double(i * step % 5) * along);
                CHECK(detail::cut_polygon(corners).triangles.empty());
            }
    CHECK(detail::cut_polygon(
              std::vector<glm::dvec3>{{0, 0, 0}, {2, 0, 0}, {0, 0, 0}, {0, 2, 0}})
              .triangles.empty());
}

TEST_CASE("load_obj: a plus sign, and a normal that is none") {
    const auto loaded = read_obj("v +0 0 0\nv +1.5 0 0\nv 0 +1 0\nvn 0 0 0\nvn 0 0 +2\n"
                                 "f 1//1 2//2 3//2\n",
                                 "x");
    const MeshData& data = loaded.parts.at(0).mesh.data();
    CHECK(data.positions[1] == Vec3{1.5f, 0, 0});
    CHECK(data.normals.empty()); // the face is flat
    CHECK(loaded.report[MeshTrouble::bad_normal].count == 1);
    CHECK(to_text(loaded.report)
              .find("1 normals are 0 or not finite numbers; their faces") !=
          std::string::npos);
    CHECK(loaded.report[MeshTrouble::bad_number].count == 0);
}

TEST_CASE("load_obj: many corners, in and out, are cut in no time") {
    // Stars: every second corner is hollow. A second or two in n^2, not in n^3.
    constexpr int count = 1000;
    std::string text;
    Corners star;
    for (int i = 0; i < count; ++i) {
        star.push_back(corner(2 * std::numbers::pi * i / count, i % 2 == 0 ? 1 : 0.3));
        append(text, "v ", Vec3(star.back()));
    }
    std::string face = "f";
    for (int i = 1; i <= count; ++i) face.append(" ").append(std::to_string(i));
    constexpr int faces = 150;
    for (int i = 0; i < faces; ++i) text.append(face).append("\n");
    const std::clock_t before = std::clock();
    const auto loaded = read_obj(text, "stars.obj");
    const double seconds = double(std::clock() - before) / CLOCKS_PER_SEC;
    const Mesh& mesh = loaded.parts[0].mesh;
    CHECK(mesh.size() == faces * (count - 2));
    CHECK(double(area(mesh)) ==
          doctest::Approx(faces * twice_area(star) / 2).epsilon(1e-5));
    CHECK_MESSAGE(seconds < 15, seconds);
}

TEST_CASE("load_obj: each trouble is counted, with its first line") {
    const auto check = [](const std::string& more, MeshTrouble which, long long count,
                          long long line) {
        const MeshCount found = trouble(cube + more, which);
        CAPTURE(more);
        CHECK(found.count == count);
        CHECK(found.line == line);
    };
    // The cube has 17 lines.
    check("v 1 nan 2\nv 1 2\nv 1e999 0 0\nv 1 2 x\n", MeshTrouble::bad_number, 4, 18);
    check("vn 0 0 0\nvn 1 inf 0\n", MeshTrouble::bad_normal, 2, 18);
    check("vt nan 0\nvt 1 inf\nvt x\n", MeshTrouble::bad_uv, 3, 18);
    check("vt 0 0\nf 1/2 2/1 3/1\nf 1/-2 2/1 3/1\nf 1/1 2/1 3/99999999999\n",
          MeshTrouble::no_such_uv, 3, 19);
    check("vn 0 0 1\nf 1//4 4//1 3//1\nf 1//1 4//1 3//-4\n",
          MeshTrouble::no_such_normal, 2, 19);
    check("vt 0 0\nvt nan 0\nf 1/1 2/1 3/1\nf 1/1 2/2 3/1\nf 1/1 2/1 3\n",
          MeshTrouble::no_uv, 8, 12); // 6 of them the cube's
    check("f 1 2 9\nf 0 1 2\nf -9 1 2\nf 1 2 x\nf 1/1/1/1 2 3\n",
          MeshTrouble::bad_index, 5, 18);
    check("f 1/0 2 3\n", MeshTrouble::no_such_uv, 1, 18);
    check("s off\nf 1 2 3\ns 7\nf 1 2 3\nf 1 2 2\nf 5//1 6//1 7//1\ns 0\nf 1 2 3\n",
          MeshTrouble::not_smooth, 1, 21);
    CHECK(read_obj(cube + "s 1\nf 1 2 3\n", "x.obj", {.normals = MeshNormals::smooth})
              .report[MeshTrouble::not_smooth]
              .count == 0);
    check("f 4294967297 2 3\nf 1.5 2 3\nf 1 2 99999999999999999999\n",
          MeshTrouble::bad_index, 3, 18);
    check("\nf 1 2\nf 1\n", MeshTrouble::few_corners, 2, 19);
    check("v 0 0 0 1\nv 0 0 0 1 0 0\nv 0 0 0 0.5 0.25 1\n", MeshTrouble::vertex_color,
          2, 19);
    check("l 1 2\np 1\nsurf 0 1 0 1 1 2\n", MeshTrouble::no_face, 3, 18);
    check("v 1 0 9\nv 4 0 9\nv 0 1 9\nv 4 3 9\nf 9 10 11 12\n", MeshTrouble::crossed, 1,
          22);
    check("f 1 1 2\nf 2 2 2\n", MeshTrouble::no_area, 2, 18);
    check("f 5//2 6//2 7//2\n", MeshTrouble::turned, 1, 18);
    check("f 1 4 3\n", MeshTrouble::edge_of_many, 3, 12);
    check("v 9 9 9\nf 1 2 9\n", MeshTrouble::edge_open, 2, 19);
    check("usemtl none\nusemtl nothing \n", MeshTrouble::no_material, 2, 18);
    check("mtllib nowhere.mtl\n", MeshTrouble::no_library, 1, 18);
    const std::string turned = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n";
    CHECK(trouble(turned, MeshTrouble::edge_turned).count == 1);
    // An edge that is not used twice, but whose faces are there: none of a closed mesh.
    CHECK(trouble(cube, MeshTrouble::edge_open).count == 0);
}

TEST_CASE("load_obj: a file without a face is refused with a sentence") {
    const std::string hint = "x.obj: no face of the file can be used; a mesh file has "
                             "lines such as 'v 0 0 1' and 'f 1 2 3'.";
    CHECK(message("") == hint);
    CHECK(message("\n\n# nothing\n") == hint);
    CHECK(message(std::string(1000, '\0')) == hint);
    CHECK(message("f 1 2 3\n") ==
          "x.obj: no face of the file can be used; the first "
          "problem: line 1: 1 faces refer to a vertex that does "
          "not exist; they are left out.");
    CHECK(message(cube, {.scale = -1})
              .find("the scale of a mesh file is -1; it must be") == 0);
    CHECK(message(cube, {.scale = 1e-40}).find("x.obj: ") == 0);
    CHECK(message(cube, {.scale = 1e30}).find("x.obj: ") == 0);
    CHECK(message("v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n").find("line 2: 1 vert") !=
          std::string::npos);
    const ScratchFolder folder;
    const auto refused = [&](const char* name) {
        return ljus_test::refusal<std::runtime_error>(
            [&] { (void)load_obj(folder.file(name)); });
    };
    ScratchFolder::write(folder.file("empty.obj"), "");
    for (const char* const name : {"", "missing.obj", "empty.obj"})
        CHECK(refused(name).find(folder.file(name)) != std::string::npos);
    ScratchFolder::write(folder.file("a.obj"), std::string("\xff\xfev\0 \0", 6));
    CHECK(refused("a.obj") == "cannot read '" + folder.file("a.obj") +
                                  "': its text is UTF-16; save it as UTF-8.");
}

TEST_CASE("load_obj: materials of a file, and scenes that use it") {
    const ScratchFolder folder;
    ScratchFolder::write(
        folder.file("m.mtl"),
        "newmtl red\nKd 0.8 0.1 0.1\nnewmtl lamp\nKd 0 0 0\nKe 3 2 1\n"
        "newmtl clear\nillum 7\nNi 1.33\nnewmtl shiny\nillum 3\nKs 0.9 0.8 2\n"
        "newmtl odd\nKd nan -1 7\nNi -3\nd 9\n");
    std::string text = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    for (const char* name : {"red", "lamp", "clear", "shiny", "odd", "red"})
        text.append("usemtl ").append(name).append("\nf 1 2 3\n");
    ScratchFolder::write(folder.file("m.obj"), text);
    const auto loaded = load_obj(folder.file("m.obj"));
    REQUIRE(loaded.parts.size() == 5);
    CHECK(loaded.parts[0].mesh.size() == 2);
    CHECK(loaded.parts[0].material.diffuse.x == doctest::Approx(0.8));
    CHECK(loaded.parts[2].material.is_glass());
    CHECK(loaded.parts[2].material.index == doctest::Approx(1.33));
    CHECK(loaded.parts[3].material.is_mirror());
    CHECK(loaded.parts[3].material.specular.z == 1);
    CHECK(to_text(loaded.report).find("black") == std::string::npos);
    Scene<Shapes<Mesh>, Materials<Lambertian, Glass, Mirror>> scene;
    add_meshes(scene, loaded);
    CHECK(scene.size() == 5);
    REQUIRE(scene.light_count() == 1);
    const World world(scene);
    world.visit_light(0, [](const auto& light) {
        CHECK(light.lamp.radiance == Rgb{3, 2, 1});
    });
    CHECK(scene.object({0, 2}).material.type == 1);
    CHECK(scene.object({0, 3}).material.type == 2);
    Scene<Shapes<Mesh>, Materials<Lambertian>> plain; // lists neither glass nor mirrors
    add_meshes(plain, loaded);
    CHECK(plain.size() == 5);
}

namespace {

/// A wall in z = 0 from (0, 0) to (4, 2), with the four corners of a picture on it.
const std::string wall = R"(mtllib m.mtl
v 0 0 0
v 4 0 0
v 4 2 0
v 0 2 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl painted
f 1/1 2/2 3/3 4/4
)";

/// Red and green above, blue and white below.
Image four_colors() {
    Image image = make_image<float>(2, 2);
    image.pixels = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    return image;
}

/// A folder with the picture and the material of the wall.
struct WallFolder : ScratchFolder {
    WallFolder() {
        save_png(four_colors(), file("four.png"));
        write(file("m.mtl"), "# walls\nnewmtl painted\nKd 1 1 1\nmap_Kd four.png\n");
        write(file("wall.obj"), wall);
    }
};

} // namespace

TEST_CASE("load_obj: texture coordinates and the picture of a material") {
    const WallFolder folder;
    const auto loaded = load_obj(folder.file("wall.obj"));
    CHECK(loaded.report.notes.empty());
    CHECK(loaded.report[MeshTrouble::no_uv].count == 0);
    REQUIRE(loaded.parts.size() == 1);
    const Mesh& mesh = loaded.parts[0].mesh;
    CHECK(mesh.data().positions.size() == 4);
    REQUIRE(mesh.data().uv.size() == 4);

    Painted scene;
    add_meshes(scene, loaded);
    const World world(std::move(scene));
    const MeshPicture& paint =
        std::get<std::vector<MeshPicture>>(world.materials()).at(0);
    const auto at = [&](float x, float y) {
        const Ray ray{.origin{x, y, 3}, .direction{0, 0, -1}};
        const auto hit = closest_hit(world, ray);
        REQUIRE(hit.has_value());
        const auto surface = vertex_at(world, ray, *hit);
        CHECK(surface.uv == Vec2{x / 4, y / 2});
        return material_at(paint, surface.point.position, surface.uv).albedo;
    };
    // The middles of the pixels have their colours, exactly.
    CHECK(at(1, 1.5f) == Rgb{1, 0, 0});
    CHECK(at(3, 1.5f) == Rgb{0, 1, 0});
    CHECK(at(1, 0.5f) == Rgb{0, 0, 1});
    CHECK(at(3, 0.5f) == Rgb{1, 1, 1});
    // A scene that does not list pictures is painted in Kd, as before.
    Scene<Shapes<Mesh>, Materials<Lambertian>> plain;
    add_meshes(plain, loaded);
    CHECK(plain.size() == 1);

    // Coordinates beyond 1 repeat, and those from the end count backwards.
    std::string wide = wall;
    for (const char* vt : {"vt 1 0", "vt 1 1"}) wide.replace(wide.find(vt), 4, "vt 3");
    const std::size_t f = wide.find("f 1/1");
    wide.replace(f, wide.npos, "f 1/-4 2/-3 3/-2 4/-1\n");
    const Mesh again = read_obj(wide, folder.file("x.obj")).parts[0].mesh;
    CHECK(again.data().uv[1] == Vec2{3, 0});
    const Ray ray{.origin{2, 1.5f, 3}, .direction{0, 0, -1}};
    const auto hit = intersect(ray, again);
    REQUIRE(hit.has_value());
    const Vec2 uv = texture_coordinates(again, *hit, surface_point(again, ray, *hit));
    CHECK(uv == Vec2{1.5f, 0.75f});
    CHECK(color_at(paint.texture, Vec3{0}, uv) ==
          color_at(paint.texture, Vec3{0}, Vec2{0.5f, 0.75f}));

    // A mesh without any has those of its triangles.
    CHECK(read_obj(cube, "c").parts[0].mesh.data().uv.empty());
    // A vertex with two texture coordinates is two, and still one when smoothed.
    const std::string fold = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 1\n"
                             "f 1/1 2/1 3/1\nf 1/2 3/2 4/2\n";
    const auto round =
        read_obj(fold, "x", {.normals = MeshNormals::smooth}).parts[0].mesh.data();
    REQUIRE(round.positions.size() == 6);
    int same = 0;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t k = 0; k < i; ++k)
            same += round.positions[i] == round.positions[k] &&
                            round.normals[i] == round.normals[k]
                        ? 1
                        : 0;
    CHECK(same == 2); // the two vertices of the common edge
}

TEST_CASE("load_obj: a picture that cannot be read is named with its line") {
    const WallFolder folder;
    const auto report = [&](const std::string& name) {
        ScratchFolder::write(folder.file("m.mtl"),
                             "newmtl other\n\nnewmtl painted\nKd 0.5 0.5 0.5\nmap_Kd " +
                                 name + "\nnewmtl unused\nmap_Kd " + name + "\n");
        const auto loaded = load_obj(folder.file("wall.obj"));
        CHECK(loaded.pictures.empty());
        Painted scene;
        add_meshes(scene, loaded);
        CHECK(std::get<std::vector<Lambertian>>(scene.materials).at(0).albedo ==
              Rgb{0.5f});
        const std::string text = to_text(loaded.report);
        return text.substr(text.find(folder.file("m.mtl")));
    };
    const std::string line = folder.file("m.mtl") + ", line 5: ";
    CHECK(report("none.png") == line + "cannot read '" + folder.file("none.png") +
                                    "': No such file or directory.\n");
    CHECK(report("m.mtl").find(line + folder.file("m.mtl") +
                               " is not a picture that can be read: ") == 0);
    CHECK(report("sub\\a\x1b.png") == line + "cannot read '" +
                                          folder.file("sub/a?.png") +
                                          "': No such file or directory.\n");
    const auto unread = load_obj(folder.file("wall.obj"), {.pictures = false});
    CHECK(unread.report.notes.empty());
}

TEST_CASE("load_obj: which words of a material file make a mirror or glass") {
    const ScratchFolder folder;
    std::string library, text = "mtllib a.mtl b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const auto use = [&](const std::string& name, const std::string& lines) {
        library.append("newmtl ").append(name).append("\n").append(lines);
        text.append("usemtl ").append(name).append("\nf 1 2 3\n");
    };
    for (int i = 0; i <= 10; ++i)
        use("i" + std::to_string(i), "illum " + std::to_string(i) + "\n");
    use("thin", "d 0.25\n");
    use("half", "d 0.5\n");
    use("pale", "Kd 7 8 9\nKs -7 -8 -9\nKe -1 2e12 2e12\n");
    use("bright", "Kd 0.25 0.5 1.5\nKs -1 0.5 2\nKe 7 nan -1\nNi 2000\n");
    use("dark", "Kd nan 0 1\nKe 2e12 1e12 1\nNi 0\nd -1\n");
    use("long", "Ni 1.25e4294967295\n"); // -1 in 32 bits
    ScratchFolder::write(folder.file("a.mtl"), library);
    // Of a name that stands in both the first counts; others come from the second.
    ScratchFolder::write(folder.file("b.mtl"),
                         "newmtl thin\nKd 0 0 0\nnewmtl late\nKd 1 0 0\n");
    text.append("usemtl late\nf 1 2 3\n");
    const auto loaded = read_obj(text, folder.file("x.obj"));
    REQUIRE(loaded.parts.size() == 18);
    const auto is = [&](std::size_t i) { return loaded.parts[i].material; };
    for (std::size_t i = 0; i <= 10; ++i) {
        CAPTURE(i);
        CHECK(is(i).is_glass() == (i == 4 || i == 6 || i == 7 || i == 9));
        CHECK(is(i).is_mirror() == (i == 3 || i == 5 || i == 8));
        CHECK(is(i).dissolve == 1);
    }
    CHECK(is(11).is_glass());
    CHECK(is(11).dissolve == 0.25);
    CHECK_FALSE(is(12).is_glass());
    CHECK(is(13).diffuse == glm::dvec3{1, 1, 1});
    CHECK(is(13).specular == glm::dvec3{0});
    CHECK(is(13).emission == glm::dvec3{0, 1e12, 1e12});
    CHECK(is(14).diffuse == glm::dvec3{0.25, 0.5, 1});
    CHECK(is(14).specular == glm::dvec3{0, 0.5, 1});
    CHECK(is(14).emission == glm::dvec3{0}); // what is no number is not used
    CHECK(is(14).index == 1.5);
    CHECK(is(15).diffuse == glm::dvec3{0.5});
    CHECK(is(15).emission == glm::dvec3{1e12, 1e12, 1});
    CHECK(is(15).index == 1.5);
    CHECK(is(15).dissolve == 1);
    CHECK(is(16).index == 1.5);
    const std::string notes = to_text(loaded.report);
    for (
        const char* note :
        {"line 8: illum makes a mirror whose colour, Ks, is 0: it is black.",
         "line 28: Kd is 7 8 9; it must be one number or three, from 0 to 1. The "
         "nearest is taken.",
         "line 32: Kd is 0.25 0.5 1.5; it must be",
         "line 34: Ke is 7 nan -1; it must be one number or three, from 0 to 1e+12. It "
         "is not used.",
         "line 35: Ni is 2000; it must be a number from 0.001 to 1000. It is not used.",
         "line 40: d is -1; it must be a number from 0 to 1. It is not used.",
         "line 42: Ni is 1.25e4294967295; it must"}) {
        CAPTURE(note);
        CHECK(notes.find(folder.file("a.mtl") + ", " + note) != std::string::npos);
    }
    CHECK(is(17).diffuse == glm::dvec3{1, 0, 0});
    CHECK(is(17).name == "late");
    // What a scene makes of it.
    Scene<Shapes<Mesh>, Materials<Lambertian, Glass, Mirror>> scene;
    add_meshes(scene, loaded);
    for (std::uint32_t i = 0; i < 18; ++i)
        CHECK(scene.object({0, i}).material.type == (is(i).is_glass()    ? 1u
                                                     : is(i).is_mirror() ? 2u
                                                                         : 0u));
    const auto& glasses = std::get<std::vector<Glass>>(scene.materials);
    CHECK(glasses.back().index == 1.5f);
    CHECK(scene.light_count() == 2);
}

TEST_CASE("load_obj: a wall shows the four colours of its picture") {
    // Of each quarter the mean is known. A pixel's weight falls off in a tent; of its
    // own quarter it fills 3/4 in u and in v, its neighbour, which is on both sides
    // because the picture repeats, the rest. Midpoints integrate this exactly.
    const WallFolder folder;
    Painted scene;
    add_meshes(scene, load_obj(folder.file("wall.obj")));
    const World world(std::move(scene));
    const auto color = [&](int x, int y) { // of 64 x 32 points, from the upper left
        const Ray ray{.origin{(float(x) + 0.5f) / 16, 2 - (float(y) + 0.5f) / 16, 3},
                      .direction{0, 0, -1}};
        const auto vertex = vertex_at(world, ray, closest_hit(world, ray).value());
        return visit_material_at(world, vertex, [&](const auto& m) {
            return std::numbers::pi_v<float> * evaluate(m, vertex.wo, vertex.wo);
        });
    };
    const Image colors = four_colors();
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < 2; ++column) {
            Rgb mean{0};
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 32; ++x)
                    mean += color(32 * column + x, 16 * row + y) / 512.0f;
            const Rgb right = 0.5625f * pixel(colors, column, row) +
                              0.1875f * (pixel(colors, 1 - column, row) +
                                         pixel(colors, column, 1 - row)) +
                              0.0625f * pixel(colors, 1 - column, 1 - row);
            for (int k = 0; k < 3; ++k)
                CHECK(mean[k] == doctest::Approx(right[k]).epsilon(1e-4));
        }
}

TEST_CASE("load_obj: two names in quotation marks, and half a pair of them") {
    const ScratchFolder folder;
    ScratchFolder::write(folder.file("a.mtl"), "newmtl \"red\"\nKd 1 0 0\n");
    ScratchFolder::write(folder.file("b.mtl"), "newmtl 2\"\nkd 0 1 0\n");
    const auto loaded = read_obj("mtllib \"a.mtl\" \"b.mtl\"\nv 0 0 0\nv 1 0 0\n"
                                 "v 0 1 0\nusemtl red\nf 1 2 3\nusemtl 2\"\nf 1 3 2\n",
                                 folder.file("x.obj"));
    REQUIRE(loaded.parts.size() == 2);
    CHECK(loaded.parts[0].material.diffuse == glm::dvec3{1, 0, 0});
    CHECK(loaded.parts[1].material.diffuse == glm::dvec3{0, 1, 0});
    CHECK(loaded.report[MeshTrouble::no_library].count == 0);
}

TEST_CASE("load_obj: an exponent that overflows is no number") {
    for (const char* number :
         {"0E-99999999999x", "1e9999999999", "-1e400", "1e", "0x1"})
        CHECK(trouble(std::string("v ") + number + " 0 0\n" + cube.substr(0),
                      MeshTrouble::bad_number)
                  .line == 1);
}

#if __has_include(<sys/stat.h>)
TEST_CASE("load_obj: a pipe in the place of a material file is not waited for") {
    const ScratchFolder folder;
    REQUIRE(::mkfifo(folder.file("pipe.mtl").c_str(), 0600) == 0);
    const auto loaded =
        read_obj("mtllib pipe.mtl\n" + std::string(cube), folder.file("cube.obj"));
    CHECK(loaded.parts.size() == 1);
    CHECK(to_text(loaded.report).find("line 1: ") != std::string::npos);
}
#endif

TEST_CASE(
    "load_obj: a material file is read once, by whatever name and however often") {
    const ScratchFolder folder;
    const std::string mesh = folder.file("a.obj");
    ScratchFolder::write(folder.file("a.mtl"), "newmtl red\nKd 1 0 0\n");
    detail::MaterialLibraries libraries;
    MeshReport report;
    libraries.add("a.mtl", mesh, 1, report);
    libraries.add("./a.mtl .//a.mtl none.mtl", mesh, 2, report);
    CHECK(libraries.read.size() == 3); // with all three as one name
    CHECK(report[MeshTrouble::no_library].count == 1);
    ScratchFolder::write(folder.file("a.mtl"), "newmtl blue\n");
    libraries.add("a.mtl", mesh, 3, report);
    CHECK(libraries.materials.size() == 1);
    CHECK(report[MeshTrouble::no_library].count == 1);
}

TEST_CASE("load_obj: no file crashes it") {
    // Bytes changed, cut out, doubled and swapped in; each
    // mesh that comes out is asked.
    const std::string extra = "vt 0.5 1 0\nf 1/-1/1 2/-1/1 3/1/1\nusemtl a\ng b\no "
                              "c\ns off\nvt 0 1\nf 1/1 2/1 3/1\n"
                              "f 1/1/1 2/1/1 3/1/1\nl 1 2\nv 1e30 -1e-30 5\n";
    const std::string start = cube + extra;
    const char* const pieces[] = {
        "-",   "/",         "//",  " ",     "\n",   "\r", "9999999999",
        "f ",  "v ",        "nan", "1e400", "-0",   "\t", "usemtl ",
        "vn ", "mtllib x ", "\\",  "#",     "0x10", "+",  "."};
    RandomStream stream = random_stream(1, Pass::camera, 0, 0);
    const auto below = [&](std::size_t n) {
        return static_cast<std::size_t>(next_1d<double>(stream) * double(n));
    };
    int used = 0, refused = 0;
    for (int i = 0; i < 6000; ++i) {
        std::string text = start;
        for (std::size_t k = 1 + below(6); k > 0; --k) {
            const std::size_t at = below(text.size() + 1);
            switch (below(5)) {
            case 0:
                text.insert(at, pieces[below(std::size(pieces))]);
                break;
            case 1:
                text.erase(at, below(20));
                break;
            case 2:
                if (at < text.size()) text[at] = static_cast<char>(below(256));
                break;
            case 3:
                text.insert(at, text.substr(below(text.size()), below(60)));
                break;
            default:
                if (below(10) == 0) text.resize(at);
            }
        }
        try {
            const auto loaded = read_obj(text, "fuzz.obj");
            ++used;
            for (const auto& part : loaded.parts) {
                const auto hit = intersect(
                    Ray{.origin{0.1f, 0.2f, 9}, .direction{0, 0, -1}}, part.mesh);
                if (hit) CHECK(hit->part < part.mesh.size());
                CHECK(std::isfinite(area(part.mesh)));
            }
        } catch (const std::runtime_error& error) {
            ++refused;
            CHECK(std::string(error.what()).find("fuzz.obj: ") == 0);
        }
    }
    CHECK(used > 4000);
    CHECK(refused > 0);
    // Huge and odd in other ways.
    CHECK(message("f" + std::string(1 << 20, '/')) != "nothing");
    CHECK(message(std::string(1 << 20, 'v')) != "nothing");
    std::string many = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
    for (int i = 0; i < 300000; ++i) many += " 1";
    CHECK(message(many).find("more than 1000 corners") != std::string::npos);
}

TEST_CASE("load_obj: the pictures of all materials together are limited") {
    const ScratchFolder folder;
    LoadedMesh loaded;
    long long pixels = (1 << 25) - 2;
    const auto load = [&](const char* name) {
        const std::string file = folder.file(name);
        save_png(make_image<float>(2, 1), file);
        MeshMaterial material{.picture{file, "a.mtl, line 3"}};
        detail::load_pictures(material, loaded, pixels, detail::picture_file);
        return file;
    };
    load("two.png");
    load("two.png"); // read once
    CHECK(loaded.report.notes.empty());
    const std::string other = load("other.png");
    load("other.png"); // said once
    CHECK(loaded.pictures.size() == 1);
    REQUIRE(loaded.report.notes.size() == 1);
    CHECK(loaded.report.notes[0] ==
          "a.mtl, line 3: " + other +
              " has 2 x 1 pixels, and the pictures before it have 33554432; together "
              "there must be at most 33554432.");
}

TEST_CASE("load_obj: pictures that many materials have are reduced") {
    LoadedMesh loaded;
    Image image = make_image<float>(3, 2);
    for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 2; ++y)
            pixel(image, x, y) = Rgb{float(1 << x), float(y), 1};
    loaded.pictures["a"] = image;
    std::vector<detail::MeshFacesT<float>> parts(2);
    parts[0].material.picture.name = parts[0].material.normals.name = "a";
    parts[1].material.mask.name = "a";
    CHECK(detail::fit_copies(parts, loaded, 18) == 18);
    CHECK(loaded.pictures["a"].pixels == image.pixels);
    CHECK(loaded.report.notes.empty());
    CHECK(detail::fit_copies(parts, loaded, 17) == 6);
    const Image& half = loaded.pictures["a"];
    REQUIRE(half.width == 2);
    REQUIRE(half.height == 1);
    CHECK(half.pixels == std::vector{Rgb{1.5f, 0.5f, 1}, Rgb{4, 0.5f, 1}});
    REQUIRE(loaded.report.notes.size() == 1);
    CHECK(loaded.report.notes[0] ==
          "all pictures are reduced to 1/2 of their width and height, because each of "
          "the 2 materials has copies of its own; together they may have 17 pixels.");
    CHECK(detail::fit_copies(parts, loaded, 3) == 3);
    CHECK(loaded.pictures["a"].pixels == std::vector{Rgb{2.75f, 0.5f, 1}});
}

TEST_CASE("load_obj: a report has all that the file has") {
    // A tetrahedron of volume 4 / 3 with one vertex twice; a vertex without a face; and
    // two faces that cannot be used.
    const std::string text =
        "o a\nv 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nv 0 0 0\nv 9 9 9\n"
        "vt 0 0\nvt 1 0\nvn 0 0 -1\ng b\ng c\n"
        "f 1//1 3//1 2//1\nf 5/1 2/2 4/1\nf 1 4 3\nf 2 3 4\n"
        "f 1 1 2\nf 1 2 99\n";
    const MeshContent has = read_obj(text, "x").report.content;
    CHECK(has.vertices == 6);
    CHECK(has.unused == 1);
    CHECK(has.normals == 1);
    CHECK(has.uvs == 2);
    CHECK(has.objects == 1);
    CHECK(has.groups == 2);
    CHECK(has.faces == 4);
    CHECK(has.polygons == 0);
    CHECK(has.flat_faces == 3);
    CHECK(has.no_uv_faces == 3);
    CHECK(has.closed);
    CHECK(has.volume == doctest::Approx(4.0 / 3));
    CHECK(to_text(read_obj(text, "x")).find("  closed     yes; volume 1.33333\n") !=
          std::string::npos);
    const auto square =
        read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n", "x");
    CHECK(to_text(square) ==
          "  vertices   4, 0 of them in no face; 0 normals, 0 texture coordinates\n"
          "  groups     0 in 0 objects\n"
          "  faces      1, 1 of them with more than three corners, which are cut; 1 "
          "without normals, 1 without texture coordinates\n"
          "  triangles  2\n"
          "  box        (0, 0, 0) to (1, 1, 0)\n"
          "  area       1\n"
          "  closed     no\n"
          "  material   (none): 2 triangles, matt (0.5, 0.5, 0.5)\n"
          "odd:\n"
          "line 5: 4 edges belong to one face only; the mesh is not closed, and "
          "unsuitable for glass.\n");
    CHECK(to_text(MeshMaterial{.specular = glm::dvec3(0.9),
                               .emission{2, 1, 0},
                               .roughness = 0.25,
                               .illumination = 3,
                               .mask{.name = "leaf.png"}}) ==
          "mirror of (0.9, 0.9, 0.9), roughness 0.25, emits (2, 1, 0), holes by "
          "leaf.png");
    CHECK(to_text(MeshMaterial{.index = 1.25, .illumination = 4}) ==
          "glass of index 1.25");
    // A square of 0.5 m in SWEREF 99, the grid of Sweden. Floats between 2^22 and 2^23
    // are multiples of 0.5.
    const std::string far = "v 535000 6474000 0\nv 535000.5 6474000 0\n"
                            "v 535000.5 6474000.5 0\nv 535000 6474000.5 0\n"
                            "f 1 2 3 4\n";
    CHECK(to_text(read_obj(far, "x").report)
              .ends_with(" is 0.5 large, but so far from the origin that coordinates "
                         "are rounded to steps of 0.5; move it to the origin before it "
                         "is saved, or load it in double.\n"));
    CHECK(read_obj<double>(far, "x").report.notes.empty());
    CHECK(square.report.content.polygons == 1);
    CHECK_FALSE(square.report.content.closed);
    CHECK(square.report.content.volume == 0);
}

TEST_CASE("load_obj: a report has the first line of each trouble, in any order") {
    MeshReport report;
    for (const long long line : {7, 3, 5}) report.add(MeshTrouble::no_area, line);
    CHECK(report[MeshTrouble::no_area].count == 3);
    CHECK(report[MeshTrouble::no_area].line == 3);
    // Three triangles at one edge, and one whose first two corners are at one place:
    // it has two edges, which are two sides of the same.
    MeshData data{.positions{{0, 0, 0},
                             {1, 0, 0},
                             {0, 1, 0},
                             {0, 0, 1},
                             {0, -1, 0},
                             {5, 0, 0},
                             {5, 0, 0},
                             {6, 0, 0}},
                  .triangles{{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {5, 6, 7}}};
    MeshReport edges;
    detail::count_edges(data, {9, 4, 7, 2}, edges);
    CHECK(edges[MeshTrouble::edge_of_many].count == 1);
    CHECK(edges[MeshTrouble::edge_of_many].line == 4);
    CHECK(edges[MeshTrouble::edge_open].count == 6);
    CHECK(edges[MeshTrouble::edge_open].line == 4);
    CHECK(edges[MeshTrouble::edge_turned].count == 0);
}

TEST_CASE("load_obj: the rarer words of a file") {
    const ScratchFolder folder;
    ScratchFolder::write(folder.file("a.mtl"),
                         "newmtl a#1\nillum 3\nd 0.25\nnewmtl a#2 # red\nKd 1 0 0\n");
    // A # within a name, a tab behind it; a texture coordinate of one number.
    const auto loaded =
        read_obj("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25\nvt 0.5\t0.75\n"
                 "usemtl a#1\nf 1 2 3\nusemtl a#2 \t\nf 1/1 2/2 3/1\n",
                 folder.file("x.obj"));
    CHECK(loaded.report[MeshTrouble::no_material].count == 0);
    CHECK(loaded.report[MeshTrouble::bad_uv].count == 0);
    REQUIRE(loaded.parts.size() == 2);
    CHECK(loaded.parts[1].mesh.data().uv[0] == Vec2{0.25f, 0});
    CHECK(loaded.parts[1].mesh.data().uv[1] == Vec2{0.5f, 0.75f});
    // What is both is glass, where a scene lists it, and else a mirror.
    CHECK(loaded.parts[0].material.is_glass());
    CHECK(loaded.parts[0].material.is_mirror());
    Scene<Shapes<Mesh>, Materials<Lambertian, Glass, Mirror>> all;
    add_meshes(all, loaded);
    CHECK(all.object({0, 0}).material.type == 1);
    Scene<Shapes<Mesh>, Materials<Lambertian, Mirror>> no_glass;
    add_meshes(no_glass, loaded);
    CHECK(no_glass.object({0, 0}).material.type == 1);
    CHECK(no_glass.object({0, 1}).material.type == 0);
}

TEST_CASE("load_obj: lines that are not used are counted, by their first words") {
    const ScratchFolder folder;
    ScratchFolder::write(folder.file("a.mtl"),
                         "newmtl gold\nka 0 0 0\nKd 1 0.8 0.3\nNs 900\nPm 1\nPr 0.2\n"
                         "newmtl clay\nPm 0\nmap_Pr r.png\nTf 0.5 1 1\n");
    const std::string path = folder.file("a.obj");
    ScratchFolder::write(path, "mtllib a.mtl\ncall legs.obj\nbevel off\nV 0 0 0\n"
                               "v 0 0 0\nv 1 0 0\nv 0 1 0\nV 1 1 1\nf 1 2 3\n");
    const std::string mtl = folder.file("a.mtl"), begin = " lines begin with ",
                      end = "; they are not used.";
    CHECK(load_obj(path).report.notes ==
          std::vector<std::string>{mtl + ", line 5: 2" + begin + "Pm" + end,
                                   mtl + ", line 6: 1" + begin + "Pr" + end,
                                   mtl + ", line 10: 1" + begin + "Tf" + end,
                                   mtl + ", line 9: 1" + begin + "map_Pr" + end,
                                   path + ", line 4: 2" + begin + "V" + end,
                                   path + ", line 2: 1" + begin + "call" + end});
    // Of many words the first twenty.
    std::string many = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (int i = 0; i < 50; ++i) many += "x" + std::to_string(i) + "\n";
    CHECK(read_obj(many, "x.obj").report.notes.size() == 20);
    // A picture, and nothing that says how it lies.
    ScratchFolder::write(folder.file("b.mtl"), "newmtl wall\nmap_Kd p.png\n");
    save_png(make_image<float>(1, 1, Rgb{1}), folder.file("p.png"));
    ScratchFolder::write(path, "mtllib b.mtl\nusemtl wall\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                               "f 1 2 3\n");
    CHECK(load_obj(path).report.notes ==
          std::vector<std::string>{"the pictures of material wall lie on each triangle "
                                   "alike: its faces have no texture coordinates."});
    // Colours from 0 to 255 are none.
    const auto report =
        read_obj("v 0 0 0 255 0 0\nv 1 0 0 9 9 9\nv 0 1 0 1 1 1\nf 1 2 3\n", "x.obj")
            .report;
    CHECK(report[MeshTrouble::vertex_color].count == 3);
}

TEST_CASE("load_obj: files of other programs") {
    // Each has one peculiarity; the right values are worked out by hand.
    struct Case {
        const char* file;
        double area;
        glm::dvec3 diffuse;  // of its one material
        bool picture;        // whether it has one
        const char* trouble; // in the report; empty: there is none
    };
    const glm::dvec3 red{1, 0, 0}, none{0.5}, white{1};
    for (const Case& is :
         {Case{"a_usemtl_two_spaces", 1, red, false, ""},
          Case{"c_mtllib_backslash", 1, red, false, ""},
          Case{"d4_cube_bom", 6, none, false, ""},
          Case{"e5_map_only", 1, white, true, ""},
          Case{"e8_map_after_second", 1, white, true, ""},
          Case{"e_map_o1", 1, white, true, ""},
          Case{"f_continuation", 1, none, false, ""},
          Case{"g_comment_after_face", 1, none, false, ""},
          Case{"n_missing_vn", 0.5, none, false, "1 faces refer to a normal that does"},
          Case{"v_keyhole", 12, none, false, ""}, Case{"names", 3, red, false, ""},
          Case{"quotes", 1, red, true, ""}, Case{"tiny_number", 1, none, false, ""},
          Case{"small_letters", 1, red, true, ""},
          Case{"glass_of_nothing", 1, white, true,
               "glass_of_nothing.mtl, line 6: map_Kd is multiplied by Kd, which is 0"},
          Case{"tr_opaque", 1, white, true, "line 7: map_Kd is on a surface that Tr 1"},
          Case{"zero_indices", 1, none, false,
               "line 9: 1 faces refer to a normal that does not exist"},
          Case{"values", 6, none, false,
               "values.mtl, line 12: Kd is spectral glass.rfl; it must be one number"},
          Case{"inside_out", 0.5 * 3 + std::sqrt(0.75), none, false,
               "line 5: 1 closed meshes are inside out"}}) {
        CAPTURE(is.file);
        REQUIRE_NOTHROW(
            (void)load_obj(std::string(LJUS_TEST_INPUTS "/") + is.file + ".obj"));
        const auto loaded =
            load_obj(std::string(LJUS_TEST_INPUTS "/") + is.file + ".obj");
        double all = 0;
        for (const auto& part : loaded.parts) all += double(area(part.mesh));
        CHECK(all == doctest::Approx(is.area));
        CHECK(loaded.parts[0].material.diffuse == is.diffuse);
        CHECK(loaded.pictures.contains(loaded.parts[0].material.picture.name) ==
              is.picture);
        std::string text = to_text(loaded.report);
        CAPTURE(text);
        CHECK(text.find(is.trouble) != std::string::npos);
        // Edges of a single face are open; nothing else is remarked.
        while (text.find("edges belong to one") < text.find('\n'))
            text.erase(0, text.find('\n') + 1);
        CHECK(text.empty() == (*is.trouble == '\0'));
    }
    const auto loaded = load_obj(LJUS_TEST_INPUTS "/values.obj");
    REQUIRE(loaded.parts.size() == 6);
    const auto is = [&](std::size_t i) { return loaded.parts[i].material; };
    CHECK(is(0).diffuse == glm::dvec3{0.5});  // nothing is said
    CHECK(is(1).diffuse == glm::dvec3{0.25}); // one number for three
    CHECK(is(2).emission == glm::dvec3{2});   // the same
    CHECK(is(3).dissolve == 0.25);            // Tr is its opposite
    CHECK(is(4).dissolve == 1);               // d counts, if there is one
    CHECK(is(5).diffuse == glm::dvec3{0.5});  // a spectrum is not read
    // Cloth that calls itself glass, of an index of 1.
    const auto shirt = load_obj(LJUS_TEST_INPUTS "/glass_of_nothing.obj");
    CHECK_FALSE(shirt.parts[0].material.is_glass());
    const auto house = load_obj(LJUS_TEST_INPUTS "/tr_opaque.obj");
    CHECK_FALSE(house.parts[0].material.is_glass());
    // The first face has the uv of the file, the second its normal.
    const auto zero = load_obj(LJUS_TEST_INPUTS "/zero_indices.obj");
    CHECK(zero.report[MeshTrouble::no_such_uv].line == 10);
    const MeshData& has = zero.parts[0].mesh.data();
    CHECK(has.uv[has.triangles[0][2]] == Vec2{1, 1});
    CHECK(has.normals[has.triangles[1][0]] == Vec3{0, 0, 1});
}

TEST_CASE("load_obj: a file that comes in pieces has the lines of the whole") {
    const std::string text =
        "\xef\xbb\xbfv 1\r\n\r\n\rf 1 \\\r\n2\\\n\n# c\\\n\\\n\nf\\";
    const std::vector<std::pair<std::string, long long>> right{
        {"v 1", 1}, {"", 2}, {"", 3}, {"f 1  2 ", 4}, {"# c  ", 7}, {"f\\", 10}};
    for (std::size_t step = 1; step <= text.size(); ++step) {
        CAPTURE(step);
        std::vector<std::pair<std::string, long long>> lines;
        const std::string name = "x.obj";
        detail::LineReader reader{name};
        std::size_t begin = 0;
        for (std::size_t end = 3;; end += step) { // a mark is read whole
            const bool last = end >= text.size();
            end = std::min(end, text.size());
            begin += reader.read(std::string_view(text).substr(begin, end - begin),
                                 last, [&](std::string_view line, long long number) {
                                     lines.emplace_back(line, number);
                                 });
            if (last) break;
        }
        CHECK(begin == text.size());
        CHECK(lines == right);
    }
    // A file of many pieces, with a line that is longer than each of them.
    const ScratchFolder folder;
    const MeshData ball = icosphere(Sphere{.center{1, 2, 3}, .radius = 0.7f}, 5);
    const std::string file = "#" + std::string(1 << 18, ' ') + "\n" + obj_text(ball);
    ScratchFolder::write(folder.file("ball.obj"), file);
    const auto loaded = load_obj(folder.file("ball.obj"));
    CHECK(to_text(loaded.report).empty());
    const MeshData& again = loaded.parts.at(0).mesh.data();
    CHECK(again.positions.size() == ball.positions.size());
    REQUIRE(again.triangles.size() == ball.triangles.size());
    CHECK(differences(ball, again) == 0);
}

TEST_CASE("load_obj: a material file may be named behind its use") {
    const ScratchFolder folder;
    ScratchFolder::write(folder.file("a.mtl"), "newmtl red\nKd 1 0 0\n");
    const auto loaded = read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl none\n"
                                 "f 1 2 3\nusemtl red\nf 1 2 3\nusemtl nothing\n"
                                 "f 1 2 3\nusemtl none\nmtllib a.mtl\n",
                                 folder.file("x.obj"));
    REQUIRE(loaded.parts.size() == 2);
    CHECK(loaded.parts[0].mesh.size() == 3); // of no material, or of none that is known
    CHECK(loaded.parts[1].material.diffuse == glm::dvec3{1, 0, 0});
    CHECK(loaded.report[MeshTrouble::no_material].count == 3);
    CHECK(loaded.report[MeshTrouble::no_material].line == 5);
}
