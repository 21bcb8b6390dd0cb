#pragma once

/// \file support/tree_cases.hpp
/// \brief Test cases for both k-d trees.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "ljus/parallel.hpp"
#include "support/point_sets.hpp"

namespace ljus_test {

using ljus::Vec3;

/// Checks that every search gives the same results as brute force.
template <template <typename> typename Tree>
void every_search() {
    Draws numbers{5};
    for (const std::size_t n : {0u, 1u, 2u, 3u, 7u, 8u, 64u, 500u})
        for (const double size : {1e-18, 1e-3, 1.0, 1e6, 1e18})
            for (const auto& set : point_sets<float>(n, size, 0)) {
                CAPTURE(n);
                CAPTURE(size);
                compare_with_brute_force<Tree<float>>(set, numbers);
            }
}

/// Checks searches in double, and far from the origin.
template <template <typename> typename Tree>
void in_double() {
    Draws numbers{6};
    for (const std::size_t n : {0u, 1u, 2u, 10u, 500u}) {
        for (const double size : {1e-18, 1.0, 1e18})
            for (const auto& set : point_sets<double>(n, size, 0))
                compare_with_brute_force<Tree<double>>(set, numbers);
        // Near a million a float has four bits after the binary point.
        for (const auto& set : point_sets<float>(n, 1, 1e6))
            compare_with_brute_force<Tree<float>>(set, numbers);
        for (const auto& set : point_sets<double>(n, 1, 1e6))
            compare_with_brute_force<Tree<double>>(set, numbers);
    }
}

/// Checks searches among ten thousand points.
template <template <typename> typename Tree>
void ten_thousand() {
    Draws numbers{7};
    for (const auto& set : point_sets<float>(10000, 1, 0))
        compare_with_brute_force<Tree<float>>(set, numbers);
}

/// Checks that a search finds exactly the points of a closed ball.
template <template <typename> typename Tree>
void closed_ball() {
    // Whole numbers: squares and their sums are exact, and 3, 4, 5 make a right angle.
    Points<float> points;
    for (int x = -6; x <= 6; ++x)
        for (int y = -6; y <= 6; ++y)
            for (int z = -6; z <= 6; ++z)
                points.push_back({float(x), float(y), float(z)});
    const Tree<float> tree{std::span<const Vec3>(points)};
    for (int square = 0; square <= 36; ++square) {
        const auto radius = float(std::sqrt(double(square)));
        int expected = 0;
        for (int x = -6; x <= 6; ++x)
            for (int y = -6; y <= 6; ++y)
                for (int z = -6; z <= 6; ++z)
                    // A radius that was rounded down does not reach its points.
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
    CHECK(count(1) == 7); // a cube would contain 27
    CHECK(count(std::nextafter(1.0f, 0.0f)) == 1);
    CHECK(count(5) == 515); // lattice points of the ball of radius 5; the cube has 1331
    CHECK(count(std::nextafter(5.0f, 0.0f)) == 515 - 30);
}

/// Checks that an empty ball, and NaN, find nothing.
template <template <typename> typename Tree>
void no_inside() {
    const Points<float> points{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
    const Tree<float> tree{std::span<const Vec3>(points)};
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    std::array<Neighbor, 4> room;
    const auto count = [&](Vec3 center, float radius) {
        std::size_t found = 0;
        tree.visit_within(center, radius, [&](std::uint32_t, double) { ++found; });
        CHECK(tree.nearest(center, radius, room, [](auto) { return true; }) == found);
        CHECK(tree.any_within(center, radius) == (found > 0));
        return found;
    };
    CHECK(count({0, 0, 0}, 0.0f) == 2);
    CHECK(count({0, 0, 0}, -0.0f) == 2);
    CHECK(count({0, 0, 0}, -1.0f) == 0);
    CHECK(count({0, 0, 0}, nan) == 0);
    CHECK(count({nan, 0, 0}, 1.0f) == 0);
    CHECK(count({0, nan, 0}, std::numeric_limits<float>::infinity()) == 0);
    // no space for results
    CHECK(tree.nearest(Vec3{0}, 1.0f, {}, [](auto) { return true; }) == 0);
    CHECK(Tree<float>{}.nearest(Vec3{0}, 1.0f, room, [](auto) { return true; }) == 0);
    CHECK(Tree<float>{}.size() == 0);
}

/// Checks that a point that is not finite is refused, with a message.
template <template <typename> typename Tree>
void not_finite() {
    constexpr float inf = std::numeric_limits<float>::infinity();
    for (const float bad : {inf, -inf, std::numeric_limits<float>::quiet_NaN()})
        for (int axis = 0; axis < 3; ++axis) {
            Points<float> points(5, Vec3{1, 2, 3});
            points[3][axis] = bad;
            CHECK_THROWS_AS(Tree<float>{std::span<const Vec3>(points)},
                            std::invalid_argument);
        }
    const Points<float> points{{0, 0, 0}, {0, inf, 0}};
    CHECK_THROWS_WITH(Tree<float>{std::span<const Vec3>(points)},
                      "a point of the k-d tree is (0, infinity, 0); it must be "
                      "finite in every component.");
}

/// Checks that the largest floats do not overflow.
template <template <typename> typename Tree>
void largest_numbers() {
    constexpr float max = std::numeric_limits<float>::max();
    const Points<float> points{{max, max, max}, {-max, -max, -max}, {0, 0, 0}};
    const Tree<float> tree{std::span<const Vec3>(points)};
    std::array<Neighbor, 3> room;
    const std::span<Neighbor> two(room.data(), 2);
    CHECK(tree.nearest(Vec3{-max}, max, two, [](auto) { return true; }) == 1);
    CHECK(tree.nearest(Vec3{-max}, std::numeric_limits<float>::infinity(), room,
                       [](auto) { return true; }) == 3);
    CHECK(room[0].distance2 == doctest::Approx(12 * double(max) * double(max)));
}

/// Checks that point_ids() gives the original index of each point.
template <template <typename> typename Tree>
void order_of_points() {
    for (const auto& set : point_sets<float>(1000, 1, 0)) {
        const Tree<float> tree{std::span<const Vec3>(set.points)};
        REQUIRE(tree.size() == 1000);
        REQUIRE(tree.point_ids().size() == 1000);
        std::vector<std::uint32_t> sorted(tree.point_ids().begin(),
                                          tree.point_ids().end());
        std::sort(sorted.begin(), sorted.end());
        for (std::uint32_t i = 0; i < 1000; ++i) {
            REQUIRE(sorted[i] == i);
            REQUIRE(tree.point(i) == set.points[tree.point_ids()[i]]);
        }
    }
}

/// Checks that trees can be copied and moved.
template <template <typename> typename Tree>
void values() {
    const auto set = point_sets<float>(300, 1, 0)[0];
    Tree<float> tree{std::span<const Vec3>(set.points)};
    const auto count = [](const Tree<float>& t) {
        int found = 0;
        t.visit_within(Vec3{0}, 0.5f, [&](std::uint32_t, double) { ++found; });
        return found;
    };
    const int found = count(tree);
    CHECK(found > 0);
    Tree<float> copy = tree;
    const Tree<float> moved = std::move(tree);
    CHECK(count(copy) == found);
    CHECK(count(moved) == found);
    copy = Tree<float>{};
    CHECK(count(copy) == 0);
    copy = moved;
    CHECK(count(copy) == found);
    const auto& ids = moved.point_ids();
    CHECK(std::equal(ids.begin(), ids.end(), copy.point_ids().begin()));
}

/// Checks that searches by several threads give the same results.
template <template <typename> typename Tree>
void many_threads() {
    const auto set = point_sets<float>(20000, 1, 0)[1];
    const Tree<float> tree{std::span<const Vec3>(set.points)};
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

} // namespace ljus_test
