/// \file bvh_test.cpp
/// \brief The plain tree of boxes, against asking everything.

#include "ljus/accel/bvh.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "support/triangle_soups.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

void check_same(const Triangles& triangles, const Bvh& tree, const Ray& ray) {
    const Found expected = by_loop(triangles, ray);
    REQUIRE(by_tree(tree, triangles, ray) == expected);
    REQUIRE(any_by_tree(tree, triangles, ray) == (expected.number != ~0u));
}

/// What every tree must be.
void check_sound(const Bvh& tree, const std::vector<Box>& boxes,
                 std::uint32_t leaf_size = 4) {
    std::vector<int> seen(boxes.size(), 0);
    const auto& nodes = tree.nodes();
    std::size_t visited = 0;
    int deepest = 0;
    const auto visit = [&](const auto& self, std::uint32_t i, int depth) -> void {
        ++visited;
        deepest = std::max(deepest, depth);
        const auto holds = [&](const Box& box) {
            return box_union(nodes[i].box, box).low == nodes[i].box.low &&
                   box_union(nodes[i].box, box).high == nodes[i].box.high;
        };
        REQUIRE(nodes[i].count <= leaf_size);
        for (std::uint32_t k = 0; k < nodes[i].count; ++k) {
            const std::uint32_t number = tree.primitive_ids()[nodes[i].first + k];
            ++seen[number];
            REQUIRE(holds(boxes[number]));
        }
        if (nodes[i].count > 0) return;
        for (const std::uint32_t child : {nodes[i].first, nodes[i].first + 1}) {
            REQUIRE(holds(nodes[child].box));
            self(self, child, depth + 1);
        }
    };
    if (!nodes.empty()) visit(visit, 0, 1);
    CHECK(visited == nodes.size());
    CHECK(deepest <= detail::bvh_depth);
    for (const int times : seen) REQUIRE(times == 1);
    CHECK(tree.primitive_ids().size() == boxes.size());
    CHECK(nodes.size() <= 2 * boxes.size());
}

} // namespace

TEST_CASE("bvh: the same answers as asking everything") {
    Numbers n;
    for (const int count : {0, 1, 2, 3, 5, 17, 300, 2000})
        for (const double size : {0.05, 1.0}) {
            const Vec3 place(n.point(count % 2 ? 100 : 0));
            const Triangles triangles = soup(n, count, 5, size, place);
            const auto boxes = boxes_of(triangles);
            const Bvh tree(boxes);
            check_sound(tree, boxes);
            for (int i = 0; i < 1500; ++i)
                check_same(triangles, tree, some_ray(n, 5, place));
        }
}

TEST_CASE("bvh: huge and tiny, flat and equal things") {
    Numbers n;
    for (const double scale : {1e-15, 1e-6, 1.0, 1e6, 1e15}) {
        const Triangles triangles = hard_soup(n, scale);
        const auto boxes = boxes_of(triangles);
        const Bvh tree(boxes);
        check_sound(tree, boxes);
        for (int i = 0; i < 1000; ++i) {
            Ray ray = some_ray(n, 5 * scale, Vec3{0});
            ray.direction *= float(n.power(-8, 8) / scale);
            check_same(triangles, tree, ray);
        }
    }
    for (const int count : {4, 5, 64, 4096, 5000}) { // all at one place
        const Triangles triangles(std::size_t(count),
                                  Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        const auto boxes = boxes_of(triangles);
        const Bvh tree(boxes);
        check_sound(tree, boxes);
        CHECK(by_tree(tree, triangles, {.origin{0.2f, 0.2f, 1}}).number == 0);
    }
}

TEST_CASE("bvh: sizes from 1e-30 to 1e30 in one tree, still no deeper than it may be") {
    std::vector<Box> boxes;
    for (int i = 0; i < 3000; ++i) {
        const float x = std::pow(10.0f, -30 + 0.02f * float(i));
        boxes.push_back({{x, -x, 0}, {1.001f * x, x, x}});
    }
    check_sound(Bvh(boxes), boxes);
}

TEST_CASE("bvh: rays that are no rays meet nothing; absurd ones are not lost") {
    Numbers n;
    const Triangles triangles = soup(n, 500, 5, 1, Vec3{0});
    const auto boxes = boxes_of(triangles);
    const Bvh tree(boxes);
    for (const Ray& bad :
         {Ray{.origin{not_a_number, 0, 0}}, Ray{.direction{0, not_a_number, 0}},
          Ray{.direction = Vec3{0}}, Ray{.t_max = not_a_number},
          Ray{.t_min = not_a_number}, Ray{.origin{0, inf, 0}},
          Ray{.direction{inf, 0, 0}}, Ray{.t_min = 2, .t_max = 1}}) {
        CHECK(by_tree(tree, triangles, bad) == Found{});
        CHECK_FALSE(any_by_tree(tree, triangles, bad));
    }
    for (const float length : {1e-42f, 1e-30f, 1e-20f, 1e20f, 1e38f})
        for (int i = 0; i < 200; ++i) {
            Ray ray = some_ray(n, 5, Vec3{0});
            ray.direction = length * glm::normalize(ray.direction);
            check_same(triangles, tree, ray);
        }
    check_same(triangles, tree, {.origin{1e25f, 0, 0}, .direction{-1, 0, 0}});
    const Bvh empty;
    CHECK_FALSE(empty.any(Ray{}, [](std::uint32_t) { return true; }));
    CHECK(empty.box().low.x == inf);
}

TEST_CASE("bvh: a wide range of leaves, and the same bytes for any number of threads") {
    Numbers n;
    const Triangles triangles = soup(n, 30000, 5, 0.1, Vec3{0});
    const auto boxes = boxes_of(triangles);
    for (const std::uint32_t leaf_size : {1u, 8u}) {
        const Bvh one(boxes, {.leaf_size = leaf_size, .threads = 1});
        check_sound(one, boxes, leaf_size);
        for (const int threads : {2, 3, 8}) {
            const Bvh many(boxes, {.leaf_size = leaf_size, .threads = threads});
            REQUIRE(many.primitive_ids() == one.primitive_ids());
            REQUIRE(many.nodes().size() == one.nodes().size());
            REQUIRE(std::memcmp(many.nodes().data(), one.nodes().data(),
                                one.nodes().size() * sizeof one.nodes()[0]) == 0);
        }
    }
    // An upper bound on the bytes per primitive.
    const Bvh finest(boxes, {.leaf_size = 1});
    CHECK(finest.nodes().capacity() * 32 + finest.primitive_ids().capacity() * 4 <=
          68 * boxes.size());
}

TEST_CASE("bvh: the nearer child first, so that little is visited") {
    Numbers n;
    const Triangles triangles = soup(n, 20000, 5, 0.3, Vec3{0});
    const auto boxes = boxes_of(triangles);
    const Bvh tree(boxes);
    long long nodes = 0, tests = 0, rays = 2000;
    for (int i = 0; i < rays; ++i) {
        const Vec3 origin = 9.0f * Vec3(n.direction());
        const Ray ray{.origin = origin, .direction = Vec3(n.point(4)) - origin};
        NearestHit nearest;
        tree.closest(
            ray,
            [&](std::uint32_t place, Ray& rest) {
                ++tests;
                const std::uint32_t number = tree.primitive_ids()[place];
                if (const auto hit = intersect<double>(rest, triangles[number]))
                    nearest.offer(*hit, number, rest);
            },
            [&](std::uint32_t) { ++nodes; });
    }
    MESSAGE("a ray visits " << nodes / rays << " nodes of " << tree.nodes().size()
                            << " and asks " << tests / rays << " of 20000 triangles");
    CHECK(nodes / rays < 120);
    CHECK(tests / rays < 80);
}

TEST_CASE("bvh: a search tells which nodes it visits") {
    Numbers n;
    const Triangles triangles = soup(n, 300, 5, 0.6, Vec3{0});
    const Bvh tree(boxes_of(triangles));
    const auto& nodes = tree.nodes();
    for (int i = 0; i < 200; ++i) {
        const Vec3 origin = 9.0f * Vec3(n.direction());
        std::vector<int> may_come(nodes.size(), 0); // the root, then children
        may_come[0] = 1;
        std::uint32_t last = 0;
        tree.closest(
            {.origin = origin, .direction = Vec3(n.point(4)) - origin},
            [&](std::uint32_t slot, Ray&) {
                CHECK(slot >= nodes[last].first);
                CHECK(slot < nodes[last].first + nodes[last].count);
            },
            [&](std::uint32_t node) {
                last = node;
                CHECK(may_come[node] == 1);
                may_come[node] = 2; // and not twice
                if (nodes[node].count == 0)
                    may_come[nodes[node].first] = may_come[nodes[node].first + 1] = 1;
            });
    }
}

// --- The surface area heuristic, by adding everything up -----------------------------

namespace {

/// What a range of boxes costs if it is split, by the definition: surface times tests.
struct Plain {
    static double half_area(const std::vector<Box>& boxes) {
        glm::dvec3 low{1e300}, high{-1e300};
        for (const Box& box : boxes) {
            low = glm::min(low, glm::dvec3(box.low));
            high = glm::max(high, glm::dvec3(box.high));
        }
        const glm::dvec3 d = high - low;
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }
    static double cost(const std::vector<Box>& boxes, unsigned at_a_time) {
        return half_area(boxes) * std::ceil(double(boxes.size()) / double(at_a_time));
    }
    /// The least over 3 axes and 15 borders of 16 equal slots of the centres.
    static detail::Split best(const std::vector<Box>& boxes, unsigned at_a_time) {
        detail::Split best;
        for (int axis = 0; axis < 3; ++axis) {
            const auto center = [axis](const Box& box) {
                return 0.5 * (double(box.low[axis]) + double(box.high[axis]));
            };
            double low = 1e300, high = -1e300;
            for (const Box& box : boxes) {
                low = std::min(low, center(box));
                high = std::max(high, center(box));
            }
            for (int bin = 1; bin < 16 && high > low; ++bin) {
                std::vector<Box> lower, upper;
                for (const Box& box : boxes) {
                    const int slot =
                        std::min(15, int(16 * (center(box) - low) / (high - low)));
                    (slot < bin ? lower : upper).push_back(box);
                }
                if (lower.empty() || upper.empty()) continue;
                const double sum = cost(lower, at_a_time) + cost(upper, at_a_time);
                if (sum < best.cost * (1 - 1e-9)) best = {axis, bin, sum};
            }
        }
        return best;
    }
};

std::vector<Box> some_boxes(Numbers& n, int count, const Vec3& stretch) {
    std::vector<Box> boxes;
    for (int i = 0; i < count; ++i) {
        const Vec3 low = Vec3(n.point(5)) * stretch;
        boxes.push_back({low, low + glm::abs(Vec3(n.point(1)))});
    }
    return boxes;
}

} // namespace

TEST_CASE("bvh: the split is the cheapest of all between 16 slots on three axes") {
    Numbers n{4};
    int axes[3] = {};
    for (int round = 0; round < 300; ++round) {
        const Vec3 stretch{round % 3 == 0 ? 3 : 0.3f, round % 3 == 1 ? 3 : 0.3f,
                           round % 3 == 2 ? 3 : 0.3f};
        const auto boxes = some_boxes(n, 2 + n.below(40), stretch);
        detail::GrowingArray<detail::PrimitiveRefT<float>> refs;
        for (const Box& box : boxes)
            refs.push_back({{{box.low.x, box.low.y, box.low.z, 0, -box.high.x,
                              -box.high.y, -box.high.z, 0}},
                            std::uint32_t(refs.size())});
        for (const unsigned at_a_time : {1u, 4u, 8u}) {
            detail::PrimitiveRangeT<float> range{.last = std::uint32_t(refs.size())};
            for (const auto& ref : refs) range.take(ref);
            const auto found = detail::best_split(refs, range, at_a_time);
            const auto right = Plain::best(boxes, at_a_time);
            CHECK(found.cost == doctest::Approx(right.cost).epsilon(1e-5));
            REQUIRE(found.axis >= 0);
            ++axes[found.axis];
            // The two halves are what was counted, each box once.
            auto sorted = refs;
            const auto halves = detail::divide(sorted, range, found);
            const auto &low = halves[0], &high = halves[1];
            REQUIRE(low.first == 0);
            REQUIRE(low.last == high.first);
            REQUIRE(high.last == refs.size());
            CHECK(low.depth == 1);
            CHECK(high.depth == 1);
            std::vector<Box> lower, upper;
            std::vector<int> seen(refs.size());
            for (std::uint32_t i = 0; i < refs.size(); ++i) {
                ++seen[sorted[i].id];
                (i < low.last ? lower : upper).push_back(boxes[sorted[i].id]);
            }
            for (const int times : seen) CHECK(times == 1);
            CHECK(Plain::cost(lower, at_a_time) + Plain::cost(upper, at_a_time) ==
                  doctest::Approx(right.cost).epsilon(1e-5));
            CHECK(low.bounds.half_area() ==
                  doctest::Approx(Plain::half_area(lower)).epsilon(1e-5));
            CHECK(high.bounds.half_area() ==
                  doctest::Approx(Plain::half_area(upper)).epsilon(1e-5));
        }
    }
    for (const int times : axes) CHECK(times > 30);
    // Centres in one place: no split.
    detail::GrowingArray<detail::PrimitiveRefT<float>> equal;
    for (int i = 0; i < 5; ++i) equal.push_back({{{0, 0, 0, 0, -1, -1, -1, 0}}, 0});
    detail::PrimitiveRangeT<float> range{.last = 5};
    for (const auto& ref : equal) range.take(ref);
    CHECK(detail::best_split(equal, range, 1).axis == -1);
    // The sum of the ends of a box may be more than a float holds.
    detail::GrowingArray<detail::PrimitiveRefT<float>> far;
    for (const float x : {1.9e38f, 3e38f})
        far.push_back({{{x, 0, 0, 0, -1.1f * x, -1e37f, -1e37f, 0}}, 0});
    range = {.last = 2};
    for (const auto& ref : far) range.take(ref);
    CHECK(detail::best_split(far, range, 1).axis == 0);
    CHECK(detail::tests_of(8, 8) == 1);
    CHECK(detail::tests_of(9, 8) == 2);
    CHECK(detail::tests_of(7, 1) == 7);
}

TEST_CASE("bvh: each range is split where that is cheaper, and nowhere else") {
    Numbers n{5};
    int leaves = 0, chosen = 0;
    for (const BvhSettings& how :
         {BvhSettings{.leaf_size = 4}, BvhSettings{.leaf_size = 16},
          BvhSettings{.leaf_size = 8, .at_a_time = 8},
          BvhSettings{.leaf_size = 16, .at_a_time = 4}})
        for (int round = 0; round < 20; ++round) {
            const auto boxes = some_boxes(n, 100, Vec3(round % 2 ? 1 : 0.2f));
            const Bvh tree(boxes, how);
            const auto& nodes = tree.nodes();
            const auto visit = [&](const auto& self,
                                   std::uint32_t i) -> std::vector<Box> {
                std::vector<Box> all;
                const bool leaf = nodes[i].count > 0;
                double cost = 0;
                for (std::uint32_t k = 0; k < nodes[i].count; ++k)
                    all.push_back(boxes[tree.primitive_ids()[nodes[i].first + k]]);
                for (std::uint32_t k = 0; k < 2 && !leaf; ++k) {
                    const auto half = self(self, nodes[i].first + k);
                    cost += Plain::cost(half, how.at_a_time);
                    all.insert(all.end(), half.begin(), half.end());
                }
                const double best = Plain::best(all, how.at_a_time).cost;
                const double split = best + Plain::half_area(all);
                const double whole = Plain::cost(all, how.at_a_time);
                if (!leaf) CHECK(cost == doctest::Approx(best).epsilon(1e-5));
                if (all.size() == 1 || std::abs(split - whole) < 1e-4 * whole)
                    return all;
                if (leaf) CHECK(split > whole);
                if (!leaf && all.size() <= how.leaf_size) CHECK(split < whole);
                leaves += leaf;
                chosen += !leaf && all.size() <= how.leaf_size;
                return all;
            };
            (void)visit(visit, 0);
        }
    CHECK(leaves > 100);
    CHECK(chosen > 100);
}

TEST_CASE(
    "bvh: a hit shortens the ray to itself and one unit more, and never prolongs it") {
    const auto after = [](float t, float t_max) {
        Ray ray{.t_max = t_max};
        NearestHit nearest;
        CHECK(nearest.offer({.t = t}, 3, ray));
        return ray.t_max;
    };
    for (const float t : {0.0f, 1e-40f, 1e-20f, 1.0f, 12345.6f}) {
        CAPTURE(t);
        CHECK(after(t, inf) > t);
        CHECK(after(t, inf) <= t * (1 + 2e-7f) + 1e-44f);
        CHECK(after(t, t) == t);
    }
    Ray ray{};
    NearestHit nearest;
    CHECK(nearest.offer({.t = 2}, 5, ray));
    CHECK_FALSE(nearest.offer({.t = 2}, 6, ray)); // as near, of a greater number
    CHECK_FALSE(nearest.offer({.t = 2}, 5, ray));
    CHECK_FALSE(nearest.offer({.t = 3}, 1, ray));
    CHECK(nearest.offer({.t = 2}, 4, ray));
    CHECK(nearest.number == 4);
    CHECK(nearest.offer({.t = 1}, 9, ray));
    CHECK(nearest.at.t == 1);
}

TEST_CASE("bvh: what is as far as the end of the ray is still asked") {
    // Two boxes that a ray enters at the same t: whichever is asked first, and shortens
    // the ray to exactly there, the other one is asked as well.
    const std::vector<Box> boxes{{{1, -1, -1}, {2, 1, 1}}, {{1, -1, -1}, {9, 1, 1}}};
    const Bvh tree(boxes, {.leaf_size = 1});
    REQUIRE(tree.nodes().size() == 3);
    const Ray ray{.origin{0, 0.1f, 0.2f}, .direction{1, 0, 0}};
    const auto ready = box_ray(ray, tree.box());
    REQUIRE(ready);
    const auto entry = intersect(*ready, boxes[0], ray.t_min, ray.t_max);
    REQUIRE(entry);
    int asked = 0;
    tree.closest(ray, [&](std::uint32_t, Ray& rest) {
        ++asked;
        rest.t_max = *entry;
    });
    CHECK(asked == 2);
}

TEST_CASE("bvh: a ray beside everything, or that is none, asks nothing") {
    Numbers n;
    for (const int count : {1, 3, 200}) {
        const Triangles triangles = soup(n, count, 5, 1, Vec3{0});
        const Bvh tree(boxes_of(triangles));
        std::vector<Ray> rays{{.origin{50, 50, 50}, .direction{0, 1, 0}},
                              {.origin{0, 0, 50}, .direction{0, 0, 1}},
                              {.origin{0, 0, 50}, .direction{0, 0, -1}, .t_max = 3}};
        for (int axis = 0; axis < 3; ++axis)
            for (const float wrong : {not_a_number, inf, -inf}) {
                Ray ray{.origin{0, 0, 50}, .direction{0, 0, -1}};
                ray.direction[axis] = wrong;
                rays.push_back(ray);
                ray = {.origin{0, 0, 50}, .direction{0, 0, -1}};
                ray.origin[axis] = wrong;
                rays.push_back(ray);
            }
        for (const Ray& ray : rays) {
            int asked = 0, visited = 0;
            tree.closest(
                ray, [&](std::uint32_t, Ray&) { ++asked; },
                [&](std::uint32_t) { ++visited; });
            CHECK_FALSE(tree.any(
                ray, [&](std::uint32_t) { return ++asked > 0; },
                [&](std::uint32_t) { ++visited; }));
            CHECK(asked == 0);
            CHECK(visited == 0);
        }
    }
}

TEST_CASE("bvh: refuses boxes that are none") {
    for (const float bad : {not_a_number, inf, -inf}) {
        const std::vector<Box> boxes{{Vec3{0}, Vec3{1}}, {Vec3{0}, Vec3{1, bad, 1}}};
        CHECK_THROWS_WITH_AS(Bvh{boxes}, doctest::Contains("a box's high corner is"),
                             std::invalid_argument);
    }
    CHECK_THROWS_AS(Bvh(std::vector<Box>{Box{}}), std::invalid_argument);
    CHECK_THROWS_AS(Bvh(std::vector<Box>{}, BvhSettings{.leaf_size = 0}),
                    std::invalid_argument);
}

TEST_CASE("bvh: in double as in float") {
    Numbers n;
    std::vector<TriangleT<double>> triangles;
    std::vector<BoxT<double>> boxes;
    for (int i = 0; i < 300; ++i) {
        const auto at = 1e100 * n.point(5);
        triangles.push_back({at, at + 1e100 * n.point(1), at + 1e100 * n.point(1)});
        boxes.push_back(bounds(triangles.back()));
    }
    const BvhT<double> tree(boxes);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto origin = 1e100 * n.point(9);
        RayT<double> ray{.origin = origin, .direction = 1e100 * n.point(5) - origin};
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& triangle : triangles)
            if (const auto hit = intersect(ray, triangle))
                nearest = std::min(nearest, hit->t);
        double found = std::numeric_limits<double>::infinity();
        tree.closest(ray, [&](std::uint32_t place, RayT<double>& rest) {
            const auto hit = intersect(rest, triangles[tree.primitive_ids()[place]]);
            if (hit) rest.t_max = found = hit->t;
        });
        REQUIRE(found == nearest);
        hits += found < 1e300;
    }
    CHECK(hits > 100);
}

TEST_CASE("bvh: its box and its bytes") {
    Numbers n{8};
    const auto boxes = some_boxes(n, 50, Vec3{1});
    const Bvh tree(boxes);
    Box all;
    for (const Box& box : boxes) all = box_union(all, box);
    CHECK(tree.box().low == all.low);
    CHECK(tree.box().high == all.high);
    CHECK(tree.bytes() ==
          tree.nodes().capacity() * 32 + tree.primitive_ids().capacity() * 4);
    CHECK(Bvh{}.bytes() == 0);
}

TEST_CASE("bvh: how a tree is built if nothing is said") {
    const BvhSettings settings;
    CHECK(settings.leaf_size == 4);
    CHECK(settings.at_a_time == 1);
    CHECK(settings.threads == 0);
    const std::vector<Box> boxes(3, Box{{0, 0, 0}, {1, 1, 1}});
    CHECK_THROWS_WITH_AS(Bvh(boxes, {.leaf_size = 0}),
                         "leaf_size is 0; it must be at least 1.",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(Bvh(boxes, {.at_a_time = 0}),
                         "at_a_time is 0; it must be at least 1.",
                         std::invalid_argument);
    CHECK_NOTHROW(Bvh(boxes, {.leaf_size = 1, .at_a_time = 1}));
    // No ray would enter it.
    CHECK_THROWS_WITH_AS(Bvh(std::vector{boxes[0], Box{{0, 2, 0}, {1, 1, 1}}}),
                         "a box's low corner is (0, 2, 0); it must be at most its high "
                         "corner.",
                         std::invalid_argument);
}
