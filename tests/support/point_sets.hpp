#pragma once

/// \file support/point_sets.hpp
/// \brief Sets of points for the tests of both k-d trees, and a search by brute force.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "ljus/accel/neighbor.hpp"
#include "support/draws.hpp"

namespace ljus_test {

using ljus::Neighbor;
using ljus::Vec3T;

template <typename T>
using Points = std::vector<Vec3T<T>>;

template <typename T>
struct PointSet {
    std::string name;
    double size = 1; ///< Half the side of a cube that contains the points.
    Points<T> points;
};

/// Sets that resemble photons, and difficult sets.
template <typename T>
std::vector<PointSet<T>> point_sets(std::size_t n, double size, double offset) {
    Draws numbers{n * 7 + 1};
    const auto make = [&](const char* name, auto point) {
        PointSet<T> set{name, size, {}};
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3T<double> p = point(i);
            set.points.push_back(Vec3T<T>{p * size + offset});
        }
        return set;
    };
    using D = Vec3T<double>;
    std::vector<PointSet<T>> sets;
    sets.push_back(make("volume", [&](auto) { return numbers.point<double>(1); }));
    sets.push_back(make("walls", [&](auto) {
        D p = numbers.point<double>(1);
        p[numbers.below(3)] = numbers.unit() < 0.5 ? -1 : 1;
        return p;
    }));
    sets.push_back(make("caustics", [&](auto) {
        const double width = std::pow(10.0, -numbers.between(0, 6));
        const double angle = numbers.between(0, 6.283);
        const D center{numbers.below(3) - 1, 0, numbers.below(2)};
        return center + width * D{std::cos(angle), 0, std::sin(angle)} * numbers.unit();
    }));
    sets.push_back(make("identical", [&](auto) { return D{0.5, -0.25, 0.125}; }));
    sets.push_back(make("collinear", [&](std::size_t i) {
        return D{1, 1, 1} * (double(i) / double(n)); // on a line, and sorted
    }));
    sets.push_back(make("along an axis, backwards", [&](std::size_t i) {
        return D{0, 1 - double(i) / double(n), 0};
    }));
    sets.push_back(make("lattice with ties", [&](auto) {
        return D{numbers.below(5) - 2, numbers.below(5) - 2, numbers.below(3) - 1} /
               4.0;
    }));
    sets.push_back(make("two heaps", [&](std::size_t i) {
        return D{i % 2 == 0 ? 1 : -1, 0, 0};
    }));
    sets.push_back(
        make("along an axis", [&](auto) { return D{0, numbers.unit(), 0}; }));
    // 512 points with even gaps say nothing about the others.
    sets.push_back(make("a sample that is one plane", [&](std::size_t i) {
        D p = numbers.point<double>(1);
        p.x = i % std::max<std::size_t>(n / 512, 1) == 0 ? -1 : std::abs(p.x);
        return p;
    }));
    return sets;
}

/// The squared distance as the tree computes it: in double, with fused multiply-add on
/// machines that have it.
template <typename T>
double distance2(const Vec3T<T>& a, const Vec3T<T>& b) {
    const double x = double(a.x) - double(b.x), y = double(a.y) - double(b.y),
                 z = double(a.z) - double(b.z);
#ifdef FP_FAST_FMA
    return std::fma(z, z, std::fma(y, y, x * x));
#else
    const double xx = x * x, yy = y * y, zz = z * z;
    return xx + yy + zz;
#endif
}

/// All points within a closed ball, nearest first, found by brute force.
template <typename Tree, typename T, typename Wanted>
std::vector<Neighbor> brute_force(const Tree& tree, const Vec3T<T>& center, T radius,
                                  Wanted wanted) {
    std::vector<Neighbor> found;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        const double d2 = distance2(tree.point(i), center);
        if (d2 <= double(radius) * double(radius) && wanted(index))
            found.push_back({d2, index});
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// Compares every kind of search in a tree with brute force, at many centres.
template <typename Tree, typename T>
void compare_with_brute_force(const PointSet<T>& set, Draws& numbers) {
    CAPTURE(set.name);
    const Tree tree{std::span<const Vec3T<T>>(set.points)};
    const std::size_t n = set.points.size();
    constexpr T infinity = std::numeric_limits<T>::infinity();
    for (int i = 0; i < 12; ++i) {
        // Centres at a point, near a point, anywhere, and far away.
        Vec3T<T> center = Vec3T<T>{numbers.point<double>(1.2 * set.size)};
        if (n > 0 && i % 4 < 2) {
            center = set.points[static_cast<std::size_t>(numbers.below(int(n)))];
            if (i % 4 == 1) center += Vec3T<T>{numbers.point<double>(1e-3 * set.size)};
        }
        if (i == 11) center = Vec3T<T>{T(1e3 * set.size), 0, 0};
        T radius = T(set.size * std::pow(10.0, -numbers.between(-0.5, 4)));
        if (i == 3) radius = 0;
        if (i == 7) radius = infinity;
        if (n > 0 && i % 3 == 0) { // the radius ends at a point
            const auto& edge =
                set.points[static_cast<std::size_t>(numbers.below(int(n)))];
            radius = T(std::sqrt(distance2(edge, center)));
        }

        constexpr ljus::detail::AnyPoint all{};
        const auto some = [](std::uint32_t index) { return index % 3 == 1; };
        const auto expected = brute_force(tree, center, radius, all);
        std::vector<Neighbor> visited;
        tree.visit_within(center, radius, [&](std::uint32_t index, double d2) {
            visited.push_back({d2, index});
        });
        std::sort(visited.begin(), visited.end());
        REQUIRE(visited == expected);
        if constexpr (requires { tree.blocks(); }) {
            visited.clear();
            tree.visit_blocks(center, radius, [&](const auto& block) {
                REQUIRE(block.found != 0);
                for (std::size_t j = 0; j < 8; ++j) {
                    const bool in = (block.found >> j & 1u) != 0;
                    if (!in) continue;
                    const auto index = static_cast<std::uint32_t>(block.first + j);
                    const double exact = distance2(block.points[j], center);
                    visited.push_back({exact, index});
                    if (1e-30 < exact && exact < 1e30)
                        REQUIRE(double(block.distance2.lane[j]) ==
                                doctest::Approx(exact).epsilon(3e-7));
                }
            });
            std::sort(visited.begin(), visited.end());
            REQUIRE(visited == expected);
        }
        REQUIRE(tree.any_within(center, radius) == !expected.empty());
        const auto one = tree.nearest(center, radius);
        REQUIRE(one.has_value() == !expected.empty());
        if (one) {
            REQUIRE(one->distance2 == expected[0].distance2);
            REQUIRE(std::binary_search(expected.begin(), expected.end(), *one));
        }

        for (const std::size_t k :
             {std::size_t(1), std::size_t(2), std::size_t(20), n + 3}) {
            const auto check_nearest = [&](auto wanted) {
                auto nearest = brute_force(tree, center, radius, wanted);
                const auto among = nearest;
                nearest.resize(std::min(nearest.size(), k));
                std::vector<Neighbor> room(k);
                const std::size_t count = tree.nearest(center, radius, room, wanted);
                REQUIRE(count == nearest.size());
                room.resize(count);
                if (count > 0) REQUIRE(room[0].distance2 == nearest.back().distance2);
                std::sort(room.begin(), room.end());
                REQUIRE(std::adjacent_find(room.begin(), room.end()) == room.end());
                for (std::size_t j = 0; j < count; ++j) {
                    REQUIRE(room[j].distance2 == nearest[j].distance2);
                    REQUIRE(std::binary_search(among.begin(), among.end(), room[j]));
                }
            };
            check_nearest(all);
            check_nearest(some);
        }
    }
}

} // namespace ljus_test
