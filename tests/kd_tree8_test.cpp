// native: fused multiply-adds must not decide on a point at the border of a ball
/// \file kd_tree8_test.cpp
/// \brief Every search against all points in turn, and what it costs in the worst case.

#include "ljus/accel/kd_tree8.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

#include "ljus/accel/kd_tree.hpp"
#include "support/tree_cases.hpp"

using ljus::KdTree8;
using ljus::KdTree8T;
using ljus::Neighbor;
using ljus::Vec3;
using ljus_test::brute_force;
using ljus_test::compare_with_brute_force;
using ljus_test::Draws;
using ljus_test::point_sets;

TEST_CASE("kd_tree8: every search is what asking all points gives") {
    ljus_test::every_search<KdTree8T>();
}

TEST_CASE("kd_tree8: also in double, and far from the origin") {
    ljus_test::in_double<KdTree8T>();
}

TEST_CASE("kd_tree8: ten thousand points at once") {
    ljus_test::ten_thousand<KdTree8T>();
}

TEST_CASE("kd_tree8: the ball is closed, exactly, and it is no cube") {
    ljus_test::closed_ball<KdTree8T>();
}

TEST_CASE("kd_tree8: a ball without an inside finds nothing, NaN finds nothing") {
    ljus_test::no_inside<KdTree8T>();
}

TEST_CASE("kd_tree8: a point that is not finite is refused with a sentence") {
    ljus_test::not_finite<KdTree8T>();
}

TEST_CASE("kd_tree8: the largest numbers of a float do not overflow") {
    ljus_test::largest_numbers<KdTree8T>();
}

TEST_CASE("kd_tree8: point_ids() tells where each point came from") {
    ljus_test::order_of_points<KdTree8T>();
}

TEST_CASE("kd_tree8: trees are values") {
    ljus_test::values<KdTree8T>();
}

TEST_CASE("kd_tree8: searches on many threads find the same") {
    ljus_test::many_threads<KdTree8T>();
}

TEST_CASE("kd_tree8: the smallest numbers of a float are told apart") {
    // Their squares are no floats any more.
    Draws numbers{16};
    for (const double size : {1e-25, 1e-22, 1e-20, 1e20, 1e25})
        for (const auto& set : point_sets<float>(300, size, 0))
            compare_with_brute_force<KdTree8>(set, numbers);
}

TEST_CASE("kd_tree8: more neighbours than are counted go through a heap") {
    Draws numbers{17};
    for (const auto& set : point_sets<float>(3000, 1, 0)) {
        const KdTree8 tree{std::span<const Vec3>(set.points)};
        for (const std::size_t k : {511u, 512u, 513u, 700u, 2999u}) {
            const Vec3 center = set.points[std::size_t(numbers.below(3000))];
            std::vector<Neighbor> room(k);
            REQUIRE(tree.nearest(center, 1e9f, room) == k);
            const auto all = brute_force(tree, center, 1e9f, ljus::detail::AnyPoint{});
            std::sort(room.begin(), room.end());
            for (std::size_t i = 0; i < k; ++i)
                REQUIRE(room[i].distance2 == all[i].distance2);
        }
    }
}

TEST_CASE("kd_tree8: each range is halved by one of the axes") {
    for (const std::size_t n : {777u, 5000u, 70000u, 200000u})
        for (const auto& set : point_sets<float>(n, 1, 0)) {
            CAPTURE(set.name);
            CAPTURE(n);
            const KdTree8 tree{std::span<const Vec3>(set.points)};
            REQUIRE(tree.first_point(0, 1) == n);
            for (int depth = 0; depth < tree.halvings(); ++depth)
                for (std::uint64_t i = 0; i < 1ull << depth; ++i) {
                    const auto first = tree.first_point(depth, i);
                    const auto middle = tree.first_point(depth + 1, 2 * i + 1);
                    const auto last = tree.first_point(depth, i + 1);
                    REQUIRE(first < middle);
                    REQUIRE(middle < last);
                    Vec3 low{-1e30f}, high{1e30f};
                    for (auto j = first; j < middle; ++j)
                        low = glm::max(low, tree.point(j));
                    for (auto j = middle; j < last; ++j)
                        high = glm::min(high, tree.point(j));
                    REQUIRE((low.x <= high.x || low.y <= high.y || low.z <= high.z));
                    // By the longest: of a range that is one point, any.
                    Vec3 least{1e30f}, most{-1e30f};
                    for (auto j = first; j < last; ++j) {
                        least = glm::min(least, tree.point(j));
                        most = glm::max(most, tree.point(j));
                    }
                    const Vec3 sides = most - least;
                    bool longest = false;
                    for (int axis = 0; axis < 3; ++axis)
                        longest =
                            longest || (sides[axis] == ljus::max_component(sides) &&
                                        low[axis] <= high[axis]);
                    REQUIRE(longest);
                }
        }
}

TEST_CASE("kd_tree8: many balls at once find what each of them finds alone") {
    Draws numbers{23};
    ljus::detail::BallBlocks found; // what was in it is gone
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const std::size_t n : {0u, 1u, 8u, 31u, 33u, 257u, 777u, 5000u})
        for (const std::size_t balls : {7u, 1u, 0u})
            for (const float radius : {0.3f, 0.0f, infinity, -1.0f, nan}) {
                std::vector<Vec3> points(n);
                for (Vec3& point : points) point = numbers.point<float>(1);
                const KdTree8 tree{std::span<const Vec3>(points)};
                std::vector<Vec3> centers(balls);
                for (Vec3& center : centers) center = numbers.point<float>(1.2);
                if (balls > 5) {
                    centers[2] = Vec3{nan};
                    centers[5] = Vec3{9};
                    if (n > 0) centers[3] = points[n / 2];
                }
                std::vector<std::size_t> told; // the blocks that were announced
                ljus::detail::find_in_balls(
                    tree.parts(), balls,
                    [&](std::size_t i) -> const Vec3& { return centers[i]; }, radius,
                    [&](std::size_t block) { told.push_back(block); }, found);
                std::size_t at = 0;
                for (std::uint32_t ball = 0; ball < balls; ++ball)
                    tree.visit_blocks(centers[ball], radius, [&](const auto& block) {
                        REQUIRE(at < found.blocks.size());
                        CHECK(found.blocks[at].ball == ball);
                        CHECK(found.blocks[at].block == block.first / 8);
                        CHECK(found.blocks[at].found == block.found);
                        REQUIRE(at < told.size());
                        CHECK(told[at] == block.first / 8);
                        ++at;
                    });
                CHECK(at == found.blocks.size());
                CHECK(at == told.size());
                const bool all = n > 0 && balls == 7 && radius == infinity;
                if (all) CHECK(at == (balls - 1) * ((n + 7) / 8)); // all but the NaN
            }
}

TEST_CASE("kd_tree8: the same tree from any number of threads") {
    for (const auto& set : point_sets<float>(100000, 1, 0)) {
        const KdTree8 one(set.points, 1);
        for (const int threads : {2, 3, 8}) {
            const KdTree8 many(set.points, threads);
            REQUIRE(std::ranges::equal(one.point_ids(), many.point_ids()));
            REQUIRE(std::memcmp(one.blocks().data(), many.blocks().data(),
                                one.blocks().size() * sizeof(one.blocks()[0])) == 0);
        }
    }
}

TEST_CASE("kd_tree8: the plain tree finds the same points") {
    Draws numbers{18};
    for (const auto& set : point_sets<float>(3000, 1, 0)) {
        const ljus::KdTree plain{std::span<const Vec3>(set.points)};
        const KdTree8 wide{std::span<const Vec3>(set.points)};
        for (int i = 0; i < 50; ++i) {
            const Vec3 center = numbers.point<float>(1.2);
            const auto radius = float(numbers.between(0, 0.5));
            std::vector<std::uint32_t> a, b;
            plain.visit_within(center, radius, [&](std::uint32_t j, double) {
                a.push_back(plain.point_ids()[j]);
            });
            wide.visit_within(center, radius, [&](std::uint32_t j, double) {
                b.push_back(wide.point_ids()[j]);
            });
            std::sort(a.begin(), a.end());
            std::sort(b.begin(), b.end());
            REQUIRE(a == b);
        }
    }
}

TEST_CASE("kd_tree8: a million points take 17 bytes each") {
    std::vector<Vec3> points(1'000'000);
    Draws numbers{19};
    for (Vec3& point : points) point = numbers.point<float>(1);
    const KdTree8 tree{std::span<const Vec3>(points)};
    CHECK(double(tree.bytes()) / 1e6 < 17.5);
}

TEST_CASE("kd_tree8: the bytes that it takes are those of its parts") {
    // 17 blocks' worth of points: at least their coordinates and their numbers.
    const auto set = ljus_test::point_sets<float>(1000, 1, 0)[0];
    const ljus::KdTree8T<float> tree{std::span<const ljus::Vec3>(set.points)};
    CHECK(tree.bytes() >= 1000 * (12 + 4) + 500); // and the boxes of nodes
    CHECK(tree.bytes() <= 1000 * (12 + 4) * 2);
    const auto more = ljus_test::point_sets<float>(8000, 1, 0)[0];
    const ljus::KdTree8T<float> large{std::span<const ljus::Vec3>(more.points)};
    CHECK(double(large.bytes()) / double(tree.bytes()) ==
          doctest::Approx(8).epsilon(0.2));
}
