// concept: bvh
// native: fused multiply-adds must not open a leak
/// \file bvh8_test.cpp
/// \brief The fast trees, against asking everything; and that nothing leaks.

#include "ljus/accel/triangle_bvh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numbers>

#include "ljus/geometry/watertight.hpp"
#include "support/triangle_soups.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
/// Both fast trees over triangles.
struct Trees {
    const Triangles& all;
    Bvh8 wide;
    TriangleBvh triangles;
    explicit Trees(const Triangles& of, std::uint32_t leaf_size = 3)
        : all(of), triangles(static_cast<std::uint32_t>(of.size()),
                             [&](std::uint32_t i) { return of[i]; }) {
        wide = Bvh8(boxes_of(of), {.leaf_size = leaf_size});
    }
    bool check(const Ray& ray) const {
        const Found expected = by_loop(all, ray);
        REQUIRE(by_tree(wide, all, ray) == expected);
        REQUIRE(by_tree(triangles, all, ray) == expected);
        const bool any = expected.number != ~0u;
        REQUIRE(any_by_tree(wide, all, ray) == any);
        REQUIRE(any_by_tree(triangles, all, ray) == any);
        return any;
    }
};

/// A closed ball whose triangles share their corners to the last bit.
Triangles ball(int rows, const Vec3& center) {
    const int columns = 2 * rows;
    std::vector<Vec3>
        corners; // each computed once: a corner must not have two roundings
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const float theta = std::numbers::pi_v<float> * float(i) / float(rows);
            const float phi = 2 * std::numbers::pi_v<float> * float(j) / float(columns);
            const float r = 1 + 0.1f * std::sin(5 * theta) * std::sin(4 * phi);
            const bool pole = i == 0 || i == rows;
            corners.push_back(
                center +
                (pole ? Vec3{0, i == 0 ? 1 : -1, 0}
                      : r * Vec3{std::sin(theta) * std::cos(phi), std::cos(theta),
                                 std::sin(theta) * std::sin(phi)}));
        }
    const auto at = [&](int i, int j) {
        return corners[static_cast<std::size_t>(i * columns + j % columns)];
    };
    Triangles mesh;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            if (i > 0) mesh.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            if (i + 1 < rows)
                mesh.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
        }
    return mesh;
}

} // namespace

TEST_CASE("wide bvh: the same answers as asking everything") {
    Numbers n;
    int hits = 0;
    for (const int count : {0, 1, 2, 7, 8, 9, 64, 300, 2000})
        for (const double size : {0.05, 1.0})
            for (const double away : {0.0, 100.0, 1e5}) {
                const Vec3 place(n.point(away));
                const Triangles triangles = soup(n, count, 5, size, place);
                const Trees trees(triangles, count % 2 ? 1 : 3);
                for (int i = 0; i < 300; ++i)
                    hits += trees.check(some_ray(n, 5, place));
            }
    CHECK(hits > 500);
}

TEST_CASE("wide bvh: the triangles are kept as they were given") {
    Numbers n{7};
    const Triangles triangles = soup(n, 500, 1, 0.1, Vec3(1e3f, 0, -0.0f));
    const TriangleBvh tree(500, [&](std::uint32_t i) { return triangles[i]; });
    int kept = 0;
    for (std::uint32_t place = 0; place < tree.primitive_ids().size(); ++place) {
        if (tree.primitive_ids()[place] == Bvh8::padding) continue;
        const Triangle triangle = tree.triangle(place);
        const Triangle& given = triangles[tree.primitive_ids()[place]];
        REQUIRE(std::memcmp(&triangle, &given, sizeof(Triangle)) == 0);
        ++kept;
    }
    CHECK(kept == 500);
}

TEST_CASE("wide bvh: rays from the surfaces themselves") {
    Numbers n;
    const Triangles triangles = soup(n, 400, 5, 1, Vec3{0});
    const Trees trees(triangles);
    for (int i = 0; i < 5000; ++i) {
        const Triangle& triangle = triangles[std::size_t(n.below(400))];
        const SurfacePoint point = sample_area(triangle, n.square<float>());
        trees.check(spawn_ray(point, Vec3(n.direction())));
        trees.check({.origin = point.position, .direction = Vec3(n.direction())});
        const Triangle& other = triangles[std::size_t(n.below(400))];
        trees.check(spawn_ray_to(point, sample_area(other, n.square<float>())));
    }
}

TEST_CASE("wide bvh: huge and tiny, flat and equal things") {
    Numbers n;
    for (const double scale : {1e-15, 1e-6, 1.0, 1e6, 1e15}) {
        const Triangles triangles = hard_soup(n, scale);
        const Trees trees(triangles);
        for (int i = 0; i < 1000; ++i) {
            Ray ray = some_ray(n, 5 * scale, Vec3{0});
            ray.direction *= float(n.power(-8, 8) / scale);
            trees.check(ray);
        }
    }
}

TEST_CASE("wide bvh: rays that are no rays meet nothing; absurd ones are not lost") {
    Numbers n;
    const Triangles triangles = soup(n, 500, 5, 1, Vec3{0});
    const Trees trees(triangles);
    for (const Ray& bad :
         {Ray{.origin{not_a_number, 0, 0}}, Ray{.direction{0, not_a_number, 0}},
          Ray{.direction = Vec3{0}}, Ray{.t_max = not_a_number},
          Ray{.t_min = not_a_number}, Ray{.origin{0, inf, 0}},
          Ray{.direction{inf, 0, 0}}, Ray{.t_min = 2, .t_max = 1}})
        CHECK_FALSE(trees.check(bad));
    for (const float length : {1e-42f, 1e-30f, 1e-20f, 1e-17f, 1e17f, 1e20f, 1e38f})
        for (int i = 0; i < 100; ++i) {
            Ray ray = some_ray(n, 5, Vec3{0});
            ray.direction = length * glm::normalize(ray.direction);
            trees.check(ray);
        }
    trees.check({.origin{1e25f, 0, 0}, .direction{-1, 0, 0}});
    CHECK_FALSE(Bvh8{}.any(Ray{}, [](std::uint32_t) { return true; }));
    CHECK_THROWS_AS(Bvh8(std::vector<Box>{}, BvhSettings{.leaf_size = 17}),
                    std::invalid_argument);
    CHECK_THROWS_WITH_AS(Bvh8(std::vector<Box>{}, BvhSettings{}, 0),
                         "multiple is 0; it must be at least 1.",
                         std::invalid_argument);
}

TEST_CASE(
    "wide bvh: no ray slips through a closed ball, at the origin or far from it") {
    Numbers n;
    for (const float away : {0.0f, 100.0f}) {
        const Vec3 center{away, -away, 2 * away};
        const Triangles mesh = ball(24, center);
        const Trees trees(mesh);
        int leaks = 0, wrong = 0;
        for (int i = 0; i < 40000; ++i) {
            // From within, at an edge, at a corner, and along an axis.
            const Triangle& triangle = mesh[std::size_t(n.below(int(mesh.size())))];
            const Vec3 origin = center + Vec3(n.point(0.4));
            const Vec3 at_edge =
                triangle.v1 + float(n.between(0, 1)) * (triangle.v2 - triangle.v1);
            Ray ray{.origin = origin,
                    .direction = (i % 2 ? triangle.v1 : at_edge) - origin};
            if (i % 5 == 0) {
                const int axis = n.below(3);
                ray = {.origin = at_edge, .direction = Vec3{n.below(2) ? 0.0f : -0.0f}};
                ray.origin[axis] = center[axis];
                ray.direction[axis] = at_edge[axis] > center[axis] ? 1.0f : -1.0f;
                // Not where a ray along the axis only touches the ball.
                if (std::abs(at_edge[axis] - center[axis]) < 0.6f) continue;
            }
            const bool hit = by_tree(trees.triangles, mesh, ray).number != ~0u;
            leaks += !hit;
            leaks += !trees.triangles.any(ray, [&](std::uint32_t place) {
                return intersect<Watertight>(
                           ray, mesh[trees.triangles.primitive_ids()[place]])
                    .has_value();
            });
            leaks += !trees.wide.any(ray, [&](std::uint32_t place) {
                return intersect<Watertight>(ray,
                                             mesh[trees.wide.primitive_ids()[place]])
                    .has_value();
            });
            if (i % 16) continue;
            const bool loop = by_loop(mesh, ray).number != ~0u;
            wrong += hit != loop || any_by_tree(trees.triangles, mesh, ray) != loop ||
                     any_by_tree(trees.wide, mesh, ray) != loop;
        }
        CHECK(wrong == 0);
        CHECK(leaks == 0);
    }
}

TEST_CASE(
    "wide bvh: at most 100 bytes per triangle, the same for any number of threads") {
    const Triangles mesh = ball(80, Vec3{0});
    const auto count = static_cast<std::uint32_t>(mesh.size());
    const auto at = [&](std::uint32_t i) { return mesh[i]; };
    const TriangleBvh one(count, at, 1), many(count, at, 5);
    MESSAGE("bytes per triangle: " << double(one.bytes()) / count);
    CHECK(double(one.bytes()) / count <= 100);
    CHECK(one.primitive_ids() == many.primitive_ids());
    REQUIRE(one.tree().nodes().size() == many.tree().nodes().size());
    CHECK(std::memcmp(one.tree().nodes().data(), many.tree().nodes().data(),
                      one.tree().nodes().size() * sizeof(ljus::detail::Bvh8Node)) == 0);
}

TEST_CASE("wide bvh: few nodes, for most of their places are taken") {
    // 22 things, as in the report's room; 3 nodes would have places enough.
    Numbers n;
    int most = 0;
    for (int i = 0; i < 100; ++i) {
        std::vector<Box> boxes;
        for (int k = 0; k < 22; ++k) {
            const Vec3 at(n.point(5));
            boxes.push_back({at, at + Vec3(0.5f)});
        }
        const Bvh8 tree(boxes, {.leaf_size = 1});
        most = std::max(most, static_cast<int>(tree.nodes().size()));
    }
    MESSAGE("nodes at most: " << most);
    CHECK(most <= 10); // a cut without a choice makes 14
}

TEST_CASE("wide bvh: of all ways to collapse a tree the one of least surface") {
    // By trying them all: what lies below a wide node is any row of at most eight nodes
    // that covers its leaves, and the surfaces of all wide nodes are added up.
    Numbers n{6};
    int wide_nodes = 0, better = 0;
    for (int round = 0; round < 60; ++round) {
        std::vector<Box> boxes;
        for (int k = 0; k < 9 + round % 5; ++k) {
            const Vec3 at(n.point(5));
            boxes.push_back({at, at + glm::abs(Vec3(n.point(2)))});
        }
        const auto tree =
            detail::build_bvh(std::span<const Box>(boxes), {.leaf_size = 1});
        const auto surface = [&](std::uint32_t i) {
            const glm::dvec3 d(tree.nodes[i].box.high - tree.nodes[i].box.low);
            return d.x * d.y + d.y * d.z + d.z * d.x;
        };
        // Least sums by node, from the last, whose children stand behind it; and all
        // rows below a node, as the sums that they give by how many nodes they have.
        std::vector<double> least(tree.nodes.size(), 0.0);
        const auto rows = [&](const auto& self, std::uint32_t i,
                              bool open) -> std::vector<std::pair<int, double>> {
            std::vector<std::pair<int, double>> result;
            if (!open) result.push_back({1, least[i]});
            if (tree.nodes[i].count > 0) return result;
            for (const auto& [a, low] : self(self, tree.nodes[i].first, false))
                for (const auto& [b, high] : self(self, tree.nodes[i].first + 1, false))
                    if (a + b <= 8) result.push_back({a + b, low + high});
            return result;
        };
        for (std::size_t i = tree.nodes.size(); i-- > 0;) {
            if (tree.nodes[i].count > 0) continue;
            double best = 1e300;
            for (const auto& [count, sum] : rows(rows, std::uint32_t(i), true))
                best = std::min(best, sum);
            least[i] = surface(std::uint32_t(i)) + best;
        }
        const detail::BvhCollapse<float> collapse(tree);
        double sum = 0;
        std::size_t leaves = 0;
        const auto visit = [&](const auto& self, std::uint32_t i) -> void {
            ++wide_nodes;
            sum += surface(i);
            const auto below = collapse.children(i);
            REQUIRE(below.count <= 8);
            for (std::size_t k = 0; k < below.count; ++k)
                if (tree.nodes[below.node[k]].count > 0)
                    ++leaves;
                else
                    self(self, below.node[k]);
        };
        visit(visit, 0);
        CHECK(leaves == boxes.size());
        CHECK(sum == doctest::Approx(least[0]).epsilon(1e-9));
        better += sum < 2 * surface(0);
    }
    CHECK(wide_nodes > 120);
    CHECK(better > 0);
}

TEST_CASE("wide bvh: where its middle is, its bytes, and leaves of sixteen") {
    Numbers n{9};
    const Triangles triangles = soup(n, 300, 5, 0.5, Vec3{100, -50, 7});
    const auto boxes = boxes_of(triangles);
    Box all;
    for (const Box& box : boxes) all = box_union(all, box);
    const Bvh8 tree(boxes, {.leaf_size = 16});
    const Vec3 middle = (all.low + all.high) / 2.0f, half = (all.high - all.low) / 2.0f;
    CHECK(glm::distance(tree.wide().middle, middle) < 1e-4f);
    CHECK(glm::distance(tree.wide().half, half) < 1e-4f);
    CHECK(tree.box().low == all.low);
    CHECK(tree.box().high == all.high);
    CHECK(tree.bytes() == tree.nodes().capacity() * sizeof(detail::Bvh8Node) +
                              tree.primitive_ids().capacity() * 4);
    const Trees trees(triangles, 16);
    for (int i = 0; i < 500; ++i) trees.check(some_ray(n, 5, Vec3{100, -50, 7}));
    // Sixteen at one place, split nowhere.
    const Triangles equal(16, triangles[0]);
    const Trees one(equal, 16);
    CHECK(one.wide.primitive_ids().size() == 16);
    const Vec3 inside = (triangles[0].v1 + triangles[0].v2 + triangles[0].v3) / 3.0f;
    const Vec3 up = glm::normalize(glm::cross(triangles[0].v2 - triangles[0].v1,
                                              triangles[0].v3 - triangles[0].v1));
    CHECK(one.check({.origin = inside + up, .direction = -up}));
}

TEST_CASE("wide bvh: large trees, too, are collapsed to the least surface") {
    // Enough boxes that some nodes had better stay closed. A twin by recursion: the
    // least total cost of a node's subtrees in this many adjacent slots.
    Numbers n{8};
    int closed = 0;
    for (int round = 0; round < 20; ++round) {
        std::vector<Box> boxes;
        for (int k = 0; k < 60 + 20 * round; ++k) {
            const Vec3 at(n.point(round % 2 ? 1 : 9));
            boxes.push_back({at, at + glm::abs(Vec3(n.point(2)))});
        }
        const auto tree =
            detail::build_bvh(std::span<const Box>(boxes), {.leaf_size = 1});
        const auto surface = [&](std::size_t i) {
            const glm::dvec3 d(tree.nodes[i].box.high - tree.nodes[i].box.low);
            return d.x * d.y + d.y * d.z + d.z * d.x;
        };
        std::vector<std::array<double, 9>> least(tree.nodes.size());
        for (std::size_t i = tree.nodes.size(); i-- > 0;) {
            least[i].fill(0);
            if (tree.nodes[i].count > 0) continue;
            const std::size_t child = tree.nodes[i].first;
            std::array<double, 9> opened{};
            for (std::size_t places = 2; places <= 8; ++places) {
                opened[places] = 1e300;
                for (std::size_t a = 1; a < places; ++a)
                    opened[places] = std::min(
                        opened[places], least[child][a] + least[child + 1][places - a]);
            }
            least[i][1] = surface(i) + opened[8];
            for (std::size_t places = 2; places <= 8; ++places) {
                closed += least[i][1] < opened[places];
                least[i][places] = std::min(least[i][1], opened[places]);
            }
        }
        const detail::BvhCollapse<float> collapse(tree);
        double sum = 0;
        const auto visit = [&](const auto& self, std::uint32_t i) -> void {
            sum += surface(i);
            const auto below = collapse.children(i);
            for (std::size_t k = 0; k < below.count; ++k)
                if (tree.nodes[below.node[k]].count == 0) self(self, below.node[k]);
        };
        visit(visit, 0);
        CHECK(sum == doctest::Approx(least[0][1]).epsilon(1e-9));
    }
    CHECK(closed > 100);
}

TEST_CASE("wide bvh: which rays can be made ready, and that boxes only grow") {
    detail::Bvh8Ray r;
    const auto ready = [&](const Vec3& origin, const Vec3& way) {
        return detail::make_ready(r, {.origin = origin, .direction = way}, Vec3{0},
                                  Vec3{1});
    };
    CHECK(ready({2, 0, 0}, {-1, 0.5f, 0}));
    for (const float length : {2e-18f, 1e-9f, 1e9f, 0.9e18f})
        CHECK(ready({2, 3, 4}, {0.1f * length, length, length}));
    for (const float length : {0.0f, 1e-30f, 0.9e-18f, 1.1e18f, 1e30f, inf})
        CHECK_FALSE(ready({2, 3, 4}, {0.1f * length, length, length}));
    CHECK(ready({0.9e18f, 0, 0}, {1, 1, 1}));
    CHECK_FALSE(ready({1.1e18f, 0, 0}, {1, 1, 1}));
    CHECK_FALSE(ready({1e30f, 0, 0}, {1, 1, 1}));
    // A component of 0 counts as 1e-12 of the largest: its plane lies beyond any float.
    CHECK_FALSE(ready({0, 1e12f, 0}, {1e-16f, 0, 0}));
    for (const Vec3& bad : {Vec3{not_a_number, 0, 0}, Vec3{0, inf, 0}}) {
        CHECK_FALSE(ready(bad, {1, 1, 1}));
        CHECK_FALSE(ready({0, 0, 0}, Vec3{1} + bad));
    }

    // A plane is met a little early if it is a near one, a little late if a far one.
    Numbers n{21};
    for (int i = 0; i < 20000; ++i) {
        const Vec3 middle(n.point(i % 3 ? 5 : 1e4)), half = glm::abs(Vec3(n.point(3)));
        const Ray ray{.origin = middle + Vec3(n.point(i % 2 ? 5 : 1e3)),
                      .direction = Vec3(n.direction())};
        REQUIRE(detail::make_ready(r, ray, middle, half));
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            CHECK(r.near[a] == a + (ray.direction[axis] < 0 ? 3u : 0u));
            CHECK(r.far[a] == a + (ray.direction[axis] < 0 ? 0u : 3u));
            if (std::abs(ray.direction[axis]) < 1e-3f) continue;
            const float plane = float(n.between(-1, 1)) * half[axis];
            const double exact =
                (double(plane) + double(middle[axis]) - double(ray.origin[axis])) /
                double(ray.direction[axis]);
            REQUIRE(double(plane * r.inverse[axis] - r.near_shift[axis]) <= exact);
            REQUIRE(double(plane * r.inverse[axis] - r.far_shift[axis]) >= exact);
        }
    }
    CHECK(r.length > 0);
    // No minus, no plus: a direction of -0 goes backwards.
    CHECK(ready({0, 0, 0}, {1, -0.0f, 0.0f}));
    CHECK(r.near == std::array<std::size_t, 3>{0, 4, 2});
}

TEST_CASE("wide bvh: who is asked, in which order, and who is not") {
    // Boxes one behind the other along z, each a leaf of its own, in any order.
    std::vector<Box> boxes;
    for (const float z : {4.0f, 1.0f, 6.0f, 3.0f, 7.0f, 2.0f, 5.0f, 8.0f})
        boxes.push_back({{-1, -1, z}, {1, 1, z + 0.5f}});
    const auto asked = [&](const Bvh8& tree, const Ray& ray) {
        std::vector<float> starts;
        tree.closest(ray, [&](std::uint32_t slot, Ray&) {
            starts.push_back(boxes[tree.primitive_ids()[slot]].low.z);
        });
        return starts;
    };
    const Bvh8 tree(boxes, {.leaf_size = 1});
    REQUIRE(tree.nodes().size() == 1);
    const Ray along{.origin{0.1f, 0.2f, 0}, .direction{0, 0, 1}};
    CHECK(asked(tree, along)[0] == 1); // the nearest first
    CHECK(asked(tree, along).size() == 8);
    // Of three all in order, from either end.
    const std::vector<Box> all = boxes;
    for (const auto& some : {std::array{2, 4, 7}, std::array{1, 0, 3},
                             std::array{7, 2, 1}, std::array{5, 6, 0}}) {
        boxes.clear();
        for (const int i : some) boxes.push_back(all[std::size_t(i)]);
        const Bvh8 three(boxes, {.leaf_size = 1});
        const auto up = asked(three, along);
        CHECK(up.size() == 3);
        CHECK(std::is_sorted(up.begin(), up.end()));
        const auto down = asked(three, {.origin{0, 0, 20}, .direction{0, 0, -1}});
        CHECK(down.size() == 3);
        CHECK(std::is_sorted(down.rbegin(), down.rend()));
    }
    boxes = all;
    // Not what lies before the ray's beginning, nor behind its end.
    for (float from = 0.75f; from < 9; ++from) {
        Ray part = along;
        part.t_min = from;
        CHECK(asked(tree, part).size() == std::size_t(8 - int(from)));
        part = along;
        part.t_max = from;
        CHECK(asked(tree, part).size() == std::size_t(from));
    }
    // A ray that is one point within a box meets that box.
    Ray point = along;
    point.t_min = point.t_max = 3.25f;
    CHECK(asked(tree, point) == std::vector{3.0f});
    // Two boxes that begin at the same t, and a search that ends there: both are asked.
    boxes = {{{-1, -1, 1}, {1, 1, 2}}, {{-1, -1, 1}, {1, 1, 9}}};
    const Bvh8 two(boxes, {.leaf_size = 1});
    detail::Bvh8Ray ready;
    REQUIRE(detail::make_ready(ready, along, two.wide().middle, two.wide().half));
    detail::Lanes entry;
    (void)detail::entered_lanes<void>(entry, two.wide(), 0, ready, along.t_min,
                                      along.t_max);
    int count = 0;
    two.closest(along, [&](std::uint32_t, Ray& rest) {
        ++count;
        rest.t_max = entry.lane[0];
    });
    CHECK(entry.lane[0] == entry.lane[1]);
    CHECK(count == 2);

    // Nobody is asked, and no node looked at, for a ray without a length or a place;
    // nor for one that no node can be asked by, if it has no length.
    boxes = all;
    std::vector<Ray> rays{{.direction{0, 0, 1}, .t_min = 2, .t_max = 1},
                          {.direction{0, 0, 1e30f}, .t_min = 2, .t_max = 1},
                          {.direction{0, 0, 1}, .t_max = not_a_number},
                          {.direction{0, 0, 1}, .t_min = not_a_number}};
    for (int axis = 0; axis < 3; ++axis)
        for (const float wrong : {not_a_number, inf, -inf}) {
            rays.push_back(along);
            rays.back().direction[axis] = wrong;
            rays.push_back(along);
            rays.back().origin[axis] = wrong;
        }
    for (const Ray& ray : rays) {
        int asks = 0, nodes = 0;
        tree.closest(
            ray, [&](std::uint32_t, Ray&) { ++asks; }, [&](std::uint32_t) { ++nodes; });
        CHECK_FALSE(tree.any(
            ray, [&](std::uint32_t) { return ++asks > 0; },
            [&](std::uint32_t) { ++nodes; }));
        CHECK(asks == 0);
        CHECK(nodes == 0);
    }
    // One that is absurd, but a ray, is asked of all.
    CHECK(asked(tree, {.origin{0, 0, 0}, .direction{0, 0, 1e30f}}).size() == 8);
}

TEST_CASE("wide bvh: triangles that are not there are not asked, and take no memory") {
    Numbers n{31};
    for (const int count : {1, 3, 9, 50}) {
        const Triangles triangles = soup(n, count, 0.5, 0.5, Vec3{0});
        const TriangleBvh tree(std::uint32_t(count),
                               [&](std::uint32_t i) { return triangles[i]; });
        CHECK(tree.bytes() == tree.tree().bytes() + tree.primitive_ids().size() / 8 *
                                                        sizeof(detail::TriangleLanes));
        bool padding = false;
        for (int i = 0; i < 2000; ++i) { // from very near to the origin, too
            Ray ray{.origin = Vec3(n.point(i % 2 ? 0.01 : 0.5)),
                    .direction = Vec3(n.direction())};
            if (i % 7 == 0) { // coordinates of the sum 1, where all bounds vanish
                ray.origin = i % 2 ? Vec3{1, 0, 0} : Vec3{0.25f, -0.5f, 0.25f};
                ray.direction = Vec3(n.point(0.5)) - ray.origin;
            }
            const auto look = [&](std::uint32_t slot) {
                padding = padding || tree.primitive_ids()[slot] == Bvh8::padding;
                return false;
            };
            tree.closest(ray, [&](std::uint32_t slot, Ray&) { (void)look(slot); });
            (void)tree.any(ray, look);
        }
        CHECK_FALSE(padding);
    }
}

TEST_CASE("wide bvh: the filter errs on one side only, at the ends of rays and of "
          "triangles of any size") {
    // Hits at edges and corners, with a t that is the ray's first or last: what the
    // triangle's own test says yes to is possible, what is definite it says yes to.
    Numbers n{41};
    int hits = 0, definite = 0;
    for (int repeat = 0; repeat < 40000; ++repeat) {
        const double size = n.power(-4, 7), away = size * n.power(-1, 3);
        const double length = repeat % 4 == 0 ? n.power(-6, 6) : 1.0;
        const Vec3 at(n.point(repeat % 3 ? size : 10 * size));
        // Of two edges one may be far shorter; and rays come from along an axis, too.
        const auto edge = [&] {
            return Vec3((n.below(4) ? 1.0 : n.power(-3, 0)) * n.point(size));
        };
        const Triangle triangle{at, at + edge(), at + edge()};
        const float u = repeat % 2 ? 0.0f : float(n.between(0, 1));
        const Vec3 target = triangle.v1 +
                            (repeat % 5 == 0 ? 0.0f : float(n.between(0, 1))) *
                                (triangle.v2 - triangle.v1) * (1 - u) +
                            u * (triangle.v3 - triangle.v1);
        Vec3 from(n.point(away));
        const int along = n.below(6);
        for (int axis = 0; axis < 3 && along < 3; ++axis)
            if (axis != along) from[axis] *= 1e-3f;
        const Vec3 origin = target + from;
        Ray ray{.origin = origin,
                .direction = float(length / away) * (target - origin)};
        if (const auto hit = intersect<double>(ray, triangle)) {
            const int end = n.below(6);
            if (end == 0) ray.t_max = hit->t;
            if (end == 1) ray.t_min = hit->t;
            if (end == 2) ray.t_max = std::nextafter(hit->t, 0.0f);
            if (end == 3) ray.t_min = std::nextafter(hit->t, inf);
        }
        detail::Bvh8Ray ready;
        const Box box = bounds(triangle);
        if (!detail::make_ready(ready, ray, 0.5f * (box.low + box.high),
                                0.5f * (box.high - box.low)) ||
            !ready.moderate)
            continue;
        const TriangleBvh tree(1, [&](std::uint32_t) { return triangle; });
        bool asked = false;
        tree.closest(ray, [&](std::uint32_t, Ray&) { asked = true; });
        // Without a question: definite.
        bool doubted = false;
        const bool yes = tree.any(ray, [&](std::uint32_t) {
            doubted = true;
            return false;
        });
        const bool right = intersect<double>(ray, triangle).has_value();
        hits += right;
        definite += yes;
        if (right) REQUIRE(asked);
        if (yes) REQUIRE(right);
        if (right) REQUIRE((yes || doubted));
    }
    CHECK(hits > 5000);
    CHECK(definite > 100);
}

TEST_CASE("wide bvh: products that no float holds are left to the triangles") {
    Numbers n{51};
    int hits = 0;
    for (const double scale : {1e10, 1e13, 1e15, 1e17}) {
        const Triangles triangles = soup(n, 200, 5 * scale, 2 * scale, Vec3{0});
        const Trees trees(triangles);
        for (int i = 0; i < 1500; ++i) {
            Ray ray{.origin = Vec3(n.point(5 * scale))};
            ray.direction = Vec3(n.point(5 * scale)) - ray.origin;
            ray.direction *= float(n.power(0, 17) / scale);
            hits += trees.check(ray);
        }
    }
    CHECK(hits > 1000);
}
