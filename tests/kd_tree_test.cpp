/// \file kd_tree_test.cpp
/// \brief Every search against all points in turn, and what it costs in the worst case.

#include "ljus/photons/kd_tree.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "ljus/parallel.hpp"
#include "support/point_sets.hpp"

using ljus::KdTree;
using ljus::KdTreeT;
using ljus::Neighbor;
using ljus::Vec3;
using ljus::Vec3T;
using photon_test::compare_with_brute_force;
using photon_test::Numbers;
using photon_test::point_sets;
using photon_test::Points;
using photon_test::PointSet;

namespace {

/// How many points a search passes.
template <typename T>
std::size_t steps_within(const KdTreeT<T>& tree, const Vec3T<T>& center, T radius,
                         std::size_t& found) {
    std::size_t steps = 0;
    const double limit2 = double(radius) * double(radius);
    found = 0;
    tree.walk(
        center,
        [&](std::uint32_t, double d2) {
            ++steps;
            if (d2 <= limit2) ++found;
        },
        [&](double d2) { return d2 <= limit2; });
    return steps;
}
template <typename T>
std::size_t steps_nearest(const KdTreeT<T>& tree, const Vec3T<T>& center,
                          std::size_t k) {
    std::vector<Neighbor> room(k);
    ljus::Nearest best{.found = room, .limit2 = 1e300};
    std::size_t steps = 0;
    tree.walk(
        center,
        [&](std::uint32_t index, double d2) {
            ++steps;
            if (best.reaches(d2)) best.take({d2, index});
        },
        [&](double d2) { return best.reaches(d2); });
    return steps;
}

} // namespace

TEST_CASE("kd_tree: every search is what asking all points gives") {
    Numbers numbers{5};
    for (const std::size_t n : {0u, 1u, 2u, 3u, 7u, 8u, 64u, 500u})
        for (const double size : {1e-18, 1e-3, 1.0, 1e6, 1e18})
            for (const auto& set : point_sets<float>(n, size, 0)) {
                CAPTURE(n);
                CAPTURE(size);
                compare_with_brute_force<KdTree>(set, numbers);
            }
}

TEST_CASE("kd_tree: also in double, and far from the origin") {
    Numbers numbers{6};
    for (const std::size_t n : {0u, 1u, 2u, 10u, 500u}) {
        for (const double size : {1e-18, 1.0, 1e18})
            for (const auto& set : point_sets<double>(n, size, 0))
                compare_with_brute_force<KdTreeT<double>>(set, numbers);
        // A million away, a float has four bits left behind the point.
        for (const auto& set : point_sets<float>(n, 1, 1e6))
            compare_with_brute_force<KdTree>(set, numbers);
        for (const auto& set : point_sets<double>(n, 1, 1e6))
            compare_with_brute_force<KdTreeT<double>>(set, numbers);
    }
}

TEST_CASE("kd_tree: ten thousand points at once") {
    Numbers numbers{7};
    for (const auto& set : point_sets<float>(10000, 1, 0))
        compare_with_brute_force<KdTree>(set, numbers);
}

TEST_CASE("kd_tree: the ball is closed, exactly, and it is no cube") {
    // Whole numbers: squares and their sums are exact, and 3, 4, 5 make a right angle.
    Points<float> points;
    for (int x = -6; x <= 6; ++x)
        for (int y = -6; y <= 6; ++y)
            for (int z = -6; z <= 6; ++z)
                points.push_back({float(x), float(y), float(z)});
    const KdTree tree{std::span<const Vec3>(points)};
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

TEST_CASE("kd_tree: a ball without an inside finds nothing, NaN finds nothing") {
    const Points<float> points{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
    const KdTree tree{std::span<const Vec3>(points)};
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
    CHECK(KdTree{}.nearest(Vec3{0}, 1.0f, room, [](auto) { return true; }) == 0);
    CHECK(KdTree{}.size() == 0);
}

TEST_CASE("kd_tree: a point that is not finite is refused with a sentence") {
    constexpr float inf = std::numeric_limits<float>::infinity();
    for (const float bad : {inf, -inf, std::numeric_limits<float>::quiet_NaN()})
        for (int axis = 0; axis < 3; ++axis) {
            Points<float> points(5, Vec3{1, 2, 3});
            points[3][axis] = bad;
            CHECK_THROWS_AS(KdTree{std::span<const Vec3>(points)},
                            std::invalid_argument);
        }
    const Points<float> points{{0, 0, 0}, {0, inf, 0}};
    CHECK_THROWS_WITH(KdTree{std::span<const Vec3>(points)},
                      "a point of the k-d tree is (0, infinity, 0); it must be "
                      "finite in every component.");
}

TEST_CASE("kd_tree: the largest numbers of a float do not overflow") {
    constexpr float max = std::numeric_limits<float>::max();
    const Points<float> points{{max, max, max}, {-max, -max, -max}, {0, 0, 0}};
    const KdTree tree{std::span<const Vec3>(points)};
    std::array<Neighbor, 3> room;
    const std::span<Neighbor> two(room.data(), 2);
    CHECK(tree.nearest(Vec3{-max}, max, two, [](auto) { return true; }) == 1);
    CHECK(tree.nearest(Vec3{-max}, std::numeric_limits<float>::infinity(), room,
                       [](auto) { return true; }) == 3);
    CHECK(room[0].distance2 == doctest::Approx(12 * double(max) * double(max)));
}

TEST_CASE("kd_tree: order() tells where each point came from") {
    for (const auto& set : point_sets<float>(1000, 1, 0)) {
        const KdTree tree{std::span<const Vec3>(set.points)};
        REQUIRE(tree.size() == 1000);
        REQUIRE(tree.order().size() == 1000);
        auto sorted = tree.order();
        std::sort(sorted.begin(), sorted.end());
        for (std::uint32_t i = 0; i < 1000; ++i) {
            REQUIRE(sorted[i] == i);
            REQUIRE(tree.points()[i] == set.points[tree.order()[i]]);
        }
    }
}

TEST_CASE("kd_tree: trees are values") {
    const auto set = point_sets<float>(300, 1, 0)[0];
    KdTree tree{std::span<const Vec3>(set.points)};
    const auto count = [](const KdTree& t) {
        int found = 0;
        t.visit_within(Vec3{0}, 0.5f, [&](std::uint32_t, double) { ++found; });
        return found;
    };
    const int found = count(tree);
    CHECK(found > 0);
    KdTree copy = tree;
    const KdTree moved = std::move(tree);
    CHECK(count(copy) == found);
    CHECK(count(moved) == found);
    copy = KdTree{};
    CHECK(count(copy) == 0);
    copy = moved;
    CHECK(count(copy) == found);
    CHECK(copy.points() == moved.points());
}

TEST_CASE("kd_tree: each range is split in the middle, by one of the axes") {
    for (const auto& set : point_sets<float>(777, 1, 0)) {
        CAPTURE(set.name);
        const KdTree tree{std::span<const Vec3>(set.points)};
        const auto& p = tree.points();
        // Halves that differ by one point at most, down to leaves of 16: the depth is
        // that of a balanced tree, whatever the points.
        const auto split = [&](auto self, std::size_t first, std::size_t last) -> int {
            if (last - first <= 16) return 0;
            const std::size_t middle = first + (last - first) / 2;
            bool by_an_axis = false;
            for (int axis = 0; axis < 3; ++axis) {
                float low_end = p[first][axis];
                float high_start = p[middle][axis];
                for (std::size_t i = first; i < middle; ++i)
                    low_end = std::max(low_end, p[i][axis]);
                for (std::size_t i = middle; i < last; ++i)
                    high_start = std::min(high_start, p[i][axis]);
                by_an_axis = by_an_axis || low_end <= high_start;
            }
            REQUIRE(by_an_axis);
            return 1 + std::max(self(self, first, middle), self(self, middle, last));
        };
        CHECK(split(split, 0, p.size()) == 6); // 2^5 * 16 < 777 <= 2^6 * 16
    }
}

TEST_CASE("kd_tree: no set of points makes a search slow") {
    constexpr std::size_t n = 100000;
    Numbers numbers{9};
    for (const auto& set : point_sets<float>(n, 1, 0)) {
        CAPTURE(set.name);
        const KdTree tree{std::span<const Vec3>(set.points)};
        double nearest_steps = 0;
        double within_steps = 0, within_found = 0;
        constexpr int queries = 100;
        for (int i = 0; i < queries; ++i) {
            const Vec3 center = set.points[static_cast<std::size_t>(numbers.below(n))];
            nearest_steps += double(steps_nearest(tree, center, 10));
            std::size_t found = 0;
            within_steps += double(steps_within(tree, center, 0.01f, found));
            within_found += double(found);
        }
        CAPTURE(nearest_steps / queries);
        CAPTURE(within_steps / queries);
        CAPTURE(within_found / queries);
        // 17 levels and 10 neighbours. On the lattice some 1300 points are equal to
        // each of 75, and a search for 10 of them still passes few.
        CHECK(nearest_steps / queries < 250);
        CHECK(within_steps / queries < 250 + 2 * within_found / queries);
    }
}

TEST_CASE("kd_tree: a search far from all points ends at once") {
    for (const auto& set : point_sets<float>(100000, 1, 0)) {
        const KdTree tree{std::span<const Vec3>(set.points)};
        int points = 0;
        int boxes = 0;
        tree.walk(
            Vec3{100, 0, 0}, [&](auto, double) { ++points; },
            [&](double distance2) {
                ++boxes;
                return distance2 <= 1;
            });
        CHECK(points == 0);
        CHECK(boxes == 1);
    }
}

TEST_CASE("kd_tree: searches on many threads find the same") {
    const auto set = point_sets<float>(20000, 1, 0)[1];
    const KdTree tree{std::span<const Vec3>(set.points)};
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
