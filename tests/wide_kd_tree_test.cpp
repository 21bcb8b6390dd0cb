/// \file wide_kd_tree_test.cpp
/// \brief Every search against all points in turn, and what it costs in the worst case.

#include "ljus/photons/wide_kd_tree.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "ljus/parallel.hpp"
#include "ljus/photons/kd_tree.hpp"
#include "support/point_sets.hpp"

using ljus::Neighbor;
using ljus::Vec3;
using ljus::Vec3T;
using ljus::WideKdTree;
using ljus::WideKdTreeT;
using photon_test::brute_force;
using photon_test::compare_with_brute_force;
using photon_test::Numbers;
using photon_test::point_sets;
using photon_test::Points;
using photon_test::PointSet;

TEST_CASE("wide_kd_tree: every search is what asking all points gives") {
    Numbers numbers{5};
    for (const std::size_t n : {0u, 1u, 2u, 3u, 7u, 8u, 64u, 500u})
        for (const double size : {1e-18, 1e-3, 1.0, 1e6, 1e18})
            for (const auto& set : point_sets<float>(n, size, 0)) {
                CAPTURE(n);
                CAPTURE(size);
                compare_with_brute_force<WideKdTree>(set, numbers);
            }
}

TEST_CASE("wide_kd_tree: also in double, and far from the origin") {
    Numbers numbers{6};
    for (const std::size_t n : {0u, 1u, 2u, 10u, 500u}) {
        for (const double size : {1e-18, 1.0, 1e18})
            for (const auto& set : point_sets<double>(n, size, 0))
                compare_with_brute_force<WideKdTreeT<double>>(set, numbers);
        // A million away, a float has four bits left behind the point.
        for (const auto& set : point_sets<float>(n, 1, 1e6))
            compare_with_brute_force<WideKdTree>(set, numbers);
        for (const auto& set : point_sets<double>(n, 1, 1e6))
            compare_with_brute_force<WideKdTreeT<double>>(set, numbers);
    }
}

TEST_CASE("wide_kd_tree: ten thousand points at once") {
    Numbers numbers{7};
    for (const auto& set : point_sets<float>(10000, 1, 0))
        compare_with_brute_force<WideKdTree>(set, numbers);
}

TEST_CASE("wide_kd_tree: the ball is closed, exactly, and it is no cube") {
    // Whole numbers: squares and their sums are exact, and 3, 4, 5 make a right angle.
    Points<float> points;
    for (int x = -6; x <= 6; ++x)
        for (int y = -6; y <= 6; ++y)
            for (int z = -6; z <= 6; ++z)
                points.push_back({float(x), float(y), float(z)});
    const WideKdTree tree{std::span<const Vec3>(points)};
    for (int square = 0; square <= 36; ++square) {
        const auto radius = float(std::sqrt(double(square)));
        int expected = 0;
        for (int x = -6; x <= 6; ++x)
            for (int y = -6; y <= 6; ++y)
                for (int z = -6; z <= 6; ++z)
                    // A root that was rounded down does not reach its points.
                    if (double(x * x + y * y + z * z) <=
                        double(radius) * double(radius))
                        ++expected;
        int found = 0;
        tree.visit_within(Vec3{0}, radius, [&](std::uint32_t, double) { ++found; });
        CHECK(found == expected);
    }
    const auto count = [&](float radius) {
        int found = 0;
        tree.visit_within(Vec3{0}, radius, [&](std::uint32_t, double) { ++found; });
        return found;
    };
    CHECK(count(1) == 7); // the cube would hold 27
    CHECK(count(std::nextafter(1.0f, 0.0f)) == 1);
    CHECK(count(5) == 515); // lattice points of the ball of radius 5; the cube has 1331
    CHECK(count(std::nextafter(5.0f, 0.0f)) == 515 - 30);
}

TEST_CASE("wide_kd_tree: a ball without an inside finds nothing, NaN finds nothing") {
    const Points<float> points{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
    const WideKdTree tree{std::span<const Vec3>(points)};
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    std::array<Neighbor, 4> room;
    const auto count = [&](Vec3 center, float radius) {
        std::size_t found = 0;
        tree.visit_within(center, radius, [&](std::uint32_t, double) { ++found; });
        CHECK(tree.nearest(center, radius, room, [](auto) { return true; }) == found);
        return found;
    };
    CHECK(count({0, 0, 0}, 0.0f) == 2);
    CHECK(count({0, 0, 0}, -0.0f) == 2);
    CHECK(count({0, 0, 0}, -1.0f) == 0);
    CHECK(count({0, 0, 0}, nan) == 0);
    CHECK(count({nan, 0, 0}, 1.0f) == 0);
    CHECK(count({0, nan, 0}, std::numeric_limits<float>::infinity()) == 0);
    CHECK(tree.nearest(Vec3{0}, 1.0f, {}, [](auto) { return true; }) == 0); // no room
    CHECK(WideKdTree{}.nearest(Vec3{0}, 1.0f, room, [](auto) { return true; }) == 0);
    CHECK(WideKdTree{}.size() == 0);
}

TEST_CASE("wide_kd_tree: a point that is not finite is refused with a sentence") {
    constexpr float inf = std::numeric_limits<float>::infinity();
    for (const float bad : {inf, -inf, std::numeric_limits<float>::quiet_NaN()})
        for (int axis = 0; axis < 3; ++axis) {
            Points<float> points(5, Vec3{1, 2, 3});
            points[3][axis] = bad;
            CHECK_THROWS_AS(WideKdTree{std::span<const Vec3>(points)},
                            std::invalid_argument);
        }
    const Points<float> points{{0, 0, 0}, {0, inf, 0}};
    CHECK_THROWS_WITH(WideKdTree{std::span<const Vec3>(points)},
                      "a point of the k-d tree is (0, infinity, 0); it must be "
                      "finite in every component.");
}

TEST_CASE("wide_kd_tree: the largest numbers of a float do not overflow") {
    constexpr float max = std::numeric_limits<float>::max();
    const Points<float> points{{max, max, max}, {-max, -max, -max}, {0, 0, 0}};
    const WideKdTree tree{std::span<const Vec3>(points)};
    std::array<Neighbor, 3> room;
    const std::span<Neighbor> two(room.data(), 2);
    CHECK(tree.nearest(Vec3{-max}, max, two, [](auto) { return true; }) == 1);
    CHECK(tree.nearest(Vec3{-max}, std::numeric_limits<float>::infinity(), room,
                       [](auto) { return true; }) == 3);
    CHECK(room[0].distance2 == doctest::Approx(12 * double(max) * double(max)));
}

TEST_CASE("wide_kd_tree: order() tells where each point came from") {
    for (const auto& set : point_sets<float>(1000, 1, 0)) {
        const WideKdTree tree{std::span<const Vec3>(set.points)};
        REQUIRE(tree.size() == 1000);
        REQUIRE(tree.order().size() == 1000);
        auto sorted = tree.order();
        std::sort(sorted.begin(), sorted.end());
        for (std::uint32_t i = 0; i < 1000; ++i) {
            REQUIRE(sorted[i] == i);
            REQUIRE(tree.point(i) == set.points[tree.order()[i]]);
        }
    }
}

TEST_CASE("wide_kd_tree: trees are values") {
    const auto set = point_sets<float>(300, 1, 0)[0];
    WideKdTree tree{std::span<const Vec3>(set.points)};
    const auto count = [](const WideKdTree& t) {
        int found = 0;
        t.visit_within(Vec3{0}, 0.5f, [&](std::uint32_t, double) { ++found; });
        return found;
    };
    const int found = count(tree);
    CHECK(found > 0);
    WideKdTree copy = tree;
    const WideKdTree moved = std::move(tree);
    CHECK(count(copy) == found);
    CHECK(count(moved) == found);
    copy = WideKdTree{};
    CHECK(count(copy) == 0);
    copy = moved;
    CHECK(count(copy) == found);
    CHECK(copy.order() == moved.order());
}

TEST_CASE("wide_kd_tree: searches on many threads find the same") {
    const auto set = point_sets<float>(20000, 1, 0)[1];
    const WideKdTree tree{std::span<const Vec3>(set.points)};
    constexpr long long queries = 400;
    const auto search = [&](int threads) {
        std::vector<double> sums(queries);
        const auto body = [&](long long i) {
            std::array<Neighbor, 30> room;
            const Vec3 center = set.points[static_cast<std::size_t>(i * 50)];
            const auto count =
                tree.nearest(center, 0.2f, room, [](auto) { return true; });
            for (std::size_t j = 0; j < count; ++j)
                sums[static_cast<std::size_t>(i)] +=
                    room[j].distance2 * double(room[j].index + 1);
        };
        ljus::parallel_blocks(queries, body, {.threads = threads});
        return sums;
    };
    CHECK(search(4) == search(1));
}

TEST_CASE("wide_kd_tree: the smallest numbers of a float are told apart") {
    // Their squares are no floats any more.
    Numbers numbers{16};
    for (const double size : {1e-25, 1e-22, 1e-20, 1e20, 1e25})
        for (const auto& set : point_sets<float>(300, size, 0))
            compare_with_brute_force<WideKdTree>(set, numbers);
}

TEST_CASE("wide_kd_tree: more neighbours than are counted go through a heap") {
    Numbers numbers{17};
    for (const auto& set : point_sets<float>(3000, 1, 0)) {
        const WideKdTree tree{std::span<const Vec3>(set.points)};
        for (const std::size_t k : {511u, 512u, 513u, 700u, 2999u}) {
            const Vec3 center = set.points[std::size_t(numbers.below(3000))];
            std::vector<Neighbor> room(k);
            REQUIRE(tree.nearest(center, 1e9f, room) == k);
            const auto all = brute_force(tree, center, 1e9f, ljus::AnyPoint{});
            std::sort(room.begin(), room.end());
            for (std::size_t i = 0; i < k; ++i)
                REQUIRE(room[i].distance2 == all[i].distance2);
        }
    }
}

TEST_CASE("wide_kd_tree: each range is halved by one of the axes") {
    for (const std::size_t n : {777u, 5000u, 70000u})
        for (const auto& set : point_sets<float>(n, 1, 0)) {
            CAPTURE(set.name);
            CAPTURE(n);
            const WideKdTree tree{std::span<const Vec3>(set.points)};
            const auto shape = ljus::WideShape::of(n);
            for (int depth = 0; depth < shape.halvings; ++depth)
                for (std::uint64_t i = 0; i < 1ull << depth; ++i) {
                    const auto point = [&](std::uint64_t block) {
                        return std::min<std::uint64_t>(8 * block, n);
                    };
                    const auto first = point(shape.first_block(depth, i));
                    const auto middle = point(shape.first_block(depth + 1, 2 * i + 1));
                    const auto last = point(shape.first_block(depth, i + 1));
                    REQUIRE(first < middle);
                    REQUIRE(middle < last);
                    Vec3 low{-1e30f}, high{1e30f};
                    for (auto j = first; j < middle; ++j)
                        low = glm::max(low, tree.point(j));
                    for (auto j = middle; j < last; ++j)
                        high = glm::min(high, tree.point(j));
                    REQUIRE((low.x <= high.x || low.y <= high.y || low.z <= high.z));
                }
        }
}

TEST_CASE("wide_kd_tree: the same tree from any number of threads") {
    for (const auto& set : point_sets<float>(100000, 1, 0)) {
        const WideKdTree one(set.points, 1);
        for (const int threads : {2, 3, 8}) {
            const WideKdTree many(set.points, threads);
            REQUIRE(one.order() == many.order());
            REQUIRE(std::memcmp(one.blocks().data(), many.blocks().data(),
                                one.blocks().size() * sizeof(one.blocks()[0])) == 0);
        }
    }
}

TEST_CASE("wide_kd_tree: the plain tree finds the same points") {
    Numbers numbers{18};
    for (const auto& set : point_sets<float>(3000, 1, 0)) {
        const ljus::KdTree plain{std::span<const Vec3>(set.points)};
        const WideKdTree wide{std::span<const Vec3>(set.points)};
        for (int i = 0; i < 50; ++i) {
            const Vec3 center = numbers.point<float>(1.2);
            const auto radius = float(numbers.between(0, 0.5));
            std::vector<std::uint32_t> a, b;
            plain.visit_within(center, radius, [&](std::uint32_t j, double) {
                a.push_back(plain.order()[j]);
            });
            wide.visit_within(center, radius, [&](std::uint32_t j, double) {
                b.push_back(wide.order()[j]);
            });
            std::sort(a.begin(), a.end());
            std::sort(b.begin(), b.end());
            REQUIRE(a == b);
        }
    }
}

TEST_CASE("wide_kd_tree: a million points take 17 bytes each") {
    std::vector<Vec3> points(1'000'000);
    Numbers numbers{19};
    for (Vec3& point : points) point = numbers.point<float>(1);
    const WideKdTree tree{std::span<const Vec3>(points)};
    CHECK(double(tree.bytes()) / 1e6 < 17.5);
}
