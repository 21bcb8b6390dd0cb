/// \file kd_tree_test.cpp
/// \brief Every search against all points in turn, and what it costs in the worst case.

#include "ljus/accel/kd_tree.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "support/tree_cases.hpp"

using ljus::KdTree;
using ljus::KdTreeT;
using ljus::Neighbor;
using ljus::Vec3;
using ljus::Vec3T;
using ljus_test::Draws;
using ljus_test::point_sets;

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

TEST_CASE("kd_tree: a point takes 16 bytes, and its boxes") {
    const auto set = point_sets<float>(4097, 1, 0)[0];
    const KdTree tree{std::span<const Vec3>(set.points)};
    CHECK(tree.points().capacity() == tree.size());
    CHECK(tree.point_ids().capacity() == tree.size());
}

TEST_CASE("kd_tree: every search is what asking all points gives") {
    ljus_test::every_search<KdTreeT>();
}

TEST_CASE("kd_tree: also in double, and far from the origin") {
    ljus_test::in_double<KdTreeT>();
}

TEST_CASE("kd_tree: ten thousand points at once") {
    ljus_test::ten_thousand<KdTreeT>();
}

TEST_CASE("kd_tree: the ball is closed, exactly, and it is no cube") {
    ljus_test::closed_ball<KdTreeT>();
}

TEST_CASE("kd_tree: a ball without an inside finds nothing, NaN finds nothing") {
    ljus_test::no_inside<KdTreeT>();
}

TEST_CASE("kd_tree: a point that is not finite is refused with a sentence") {
    ljus_test::not_finite<KdTreeT>();
}

TEST_CASE("kd_tree: the largest numbers of a float do not overflow") {
    ljus_test::largest_numbers<KdTreeT>();
}

TEST_CASE("kd_tree: point_ids() tells where each point came from") {
    ljus_test::order_of_points<KdTreeT>();
}

TEST_CASE("kd_tree: trees are values") {
    ljus_test::values<KdTreeT>();
}

TEST_CASE("kd_tree: each range is split in the middle, by one of the axes") {
    for (const auto& set : point_sets<float>(777, 1, 0)) {
        CAPTURE(set.name);
        const KdTree tree{std::span<const Vec3>(set.points)};
        const auto& p = tree.points();
        // Halves that differ by one point at most, down to leaves of 16: the depth is
        // that of a balanced tree for any points.
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

TEST_CASE("kd_tree: equal points are split by their numbers") {
    // So that the tree is the same with every standard library.
    const std::vector<Vec3> equal(200, Vec3{1, 2, 3});
    const KdTree tree{std::span<const Vec3>(equal)};
    const auto& ids = tree.point_ids();
    const auto ordered = [&](auto self, std::size_t first, std::size_t last) -> void {
        if (last - first <= 16) return;
        const std::size_t middle = first + (last - first) / 2;
        CHECK(*std::max_element(&ids[first], &ids[middle]) <
              *std::min_element(&ids[middle], ids.data() + last));
        self(self, first, middle);
        self(self, middle, last);
    };
    ordered(ordered, 0, ids.size());
}

TEST_CASE("kd_tree: nobody is asked about points that are too far away") {
    const auto points = point_sets<float>(500, 1, 0)[0].points;
    const KdTree tree{std::span<const Vec3>(points)};
    std::vector<Neighbor> room(3);
    std::size_t asked = 0;
    const Vec3 center = points[7];
    const float radius = 0.4f;
    (void)tree.nearest(center, radius, room, [&](std::uint32_t i) {
        ++asked;
        CHECK(ljus::distance2(tree.points()[i], center) <=
              double(radius) * double(radius));
        return false;
    });
    CHECK(asked > 3); // more than are wanted
}

TEST_CASE("kd_tree: the longest side of a box, and how far away a box is") {
    using ljus::detail::box_distance2, ljus::detail::longest_axis;
    const Vec3 low{-1, -2, -3};
    CHECK(longest_axis(low, Vec3{6, 2, 3}) == 0);
    CHECK(longest_axis(low, Vec3{1, 5, 3}) == 1);
    CHECK(longest_axis(low, Vec3{1, 2, 4}) == 2);
    // The first of several, and no overflow where a side is longer than any float.
    CHECK(longest_axis(Vec3{0}, Vec3{1}) == 0);
    CHECK(longest_axis(Vec3{0}, Vec3{1, 1, 0}) == 0);
    CHECK(longest_axis(Vec3{0}, Vec3{1, 0, 1}) == 0);
    CHECK(longest_axis(Vec3{0}, Vec3{0, 1, 1}) == 1);
    CHECK(longest_axis(Vec3{-3e38f, -3.3e38f, 0}, Vec3{3e38f, 3.3e38f, 1}) == 1);

    CHECK(box_distance2(low, Vec3{1}, Vec3{0.5f, -1, 1}) == 0); // within, and on it
    CHECK(box_distance2(low, Vec3{1}, Vec3{3, -4, 2}) == 4 + 4 + 1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Vec3& at : {Vec3{nan, 0, 0}, Vec3{0, nan, 0}, Vec3{0, 0, nan}})
        CHECK(std::isnan(box_distance2(low, Vec3{1}, at)));
}

TEST_CASE("kd_tree: no set of points makes a search slow") {
    constexpr std::size_t n = 100000;
    Draws numbers{9};
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
    ljus_test::many_threads<KdTreeT>();
}
