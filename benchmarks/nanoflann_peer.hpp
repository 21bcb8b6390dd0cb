#pragma once

/// \file nanoflann_peer.hpp
/// \brief nanoflann at its best, as a peer of the benchmarks: of the installed version,
/// of a newer one, or of both. See neighbours.cpp for what a peer is.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <ljus/math/vector.hpp>

#if __has_include(<nanoflann.hpp>)
#include <nanoflann.hpp>
#define LJUS_BENCH_NANOFLANN 1
#endif
#ifdef LJUS_BENCH_NANOFLANN_LATEST // a file; its names must not meet the older ones
#undef NANOFLANN_VERSION
#define nanoflann nanoflann_latest
#include LJUS_BENCH_NANOFLANN_LATEST
#undef nanoflann
#endif
namespace nanoflann_peer {

using ljus::Vec3;

/// A vector of points, as nanoflann reads it.
struct Cloud {
    std::vector<Vec3> points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return (&points[i].x)[axis]; // Vec3's own operator asks which axis it is
    }
    template <typename Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

/// The squared distance in three dimensions, as nanoflann calls it.
struct Distance {
    using ElementType = float;
    using DistanceType = float;
    const Cloud& cloud;
    explicit Distance(const Cloud& of) : cloud(of) {}
    float evalMetric(const float* a, std::size_t i, std::size_t) const {
        const Vec3& p = cloud.points[i];
        const float x = a[0] - p.x, y = a[1] - p.y, z = a[2] - p.z;
        return x * x + y * y + z * z;
    }
    float accum_dist(float a, float b, std::size_t) const { return (a - b) * (a - b); }
};

#ifdef LJUS_BENCH_NANOFLANN
/// The words of the installed nanoflann.
struct Installed {
    static constexpr const char* name = "nanoflann";
    static constexpr const char* book = "kd_tree-nanoflann";
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<Distance, Cloud, 3, std::uint32_t>;
    static auto& order(Tree& tree) { return tree.vAcc; }
};
#endif
#ifdef LJUS_BENCH_NANOFLANN_LATEST
/// The words of the newer one.
struct Latest {
    static constexpr const char* name = "nanoflann, newer";
    static constexpr const char* book = "kd_tree-nanoflann-latest";
    using Tree =
        nanoflann_latest::KDTreeSingleIndexAdaptor<Distance, Cloud, 3, std::uint32_t>;
    static auto& order(Tree& tree) { return tree.vAcc_; }
};
#endif

/// What nanoflann asks of a set of results; the others add `addPoint`, which receives
/// a point closer than `worstDist()` and returns whether the search goes on.
struct Results {
    using DistanceType = float;
    using IndexType = std::uint32_t;
    float worst2; ///< A squared distance.
    std::size_t size() const { return 1; }
    bool full() const { return true; }
    void sort() {}
    float worstDist() const { return worst2; }
};

/// nanoflann, of one version or the other, at its best: points and payload in the order
/// of the tree once it is built, and a set of results for each question.
template <typename Words>
struct Nanoflann {
    static constexpr const char* name = Words::name;
    static constexpr const char* book = Words::book;
    Cloud cloud;
    typename Words::Tree tree;
    std::vector<float> values;

    explicit Nanoflann(const std::vector<Vec3>& points)
        // From version 1.4 on the constructor builds the tree.
        : cloud{points}, tree(3, cloud, {64}) {}
    /// Puts the points into the order of the tree; not counted as building.
    void arrange(const std::vector<float>& payload) {
        auto& order = Words::order(tree);
        const std::vector<Vec3> points = cloud.points;
        for (std::size_t i = 0; i < order.size(); ++i) {
            cloud.points[i] = points[order[i]];
            values.push_back(payload[order[i]]);
            order[i] = static_cast<std::uint32_t>(i);
        }
    }
    template <typename Found>
    Found find(Found found, const Vec3& center) const {
        (void)tree.findNeighbors(found, &center.x, {});
        return found;
    }

    struct Sum : Results {
        const float* values;
        float sum = 0;
        bool addPoint(float, std::uint32_t i) {
            sum += values[i];
            return true;
        }
    };
    float sum_within(Vec3 center, float radius) const {
        return find(Sum{{radius * radius}, values.data()}, center).sum;
    }
    float sum_blocks(Vec3 center, float radius) const {
        return sum_within(center, radius);
    }

    /// The k nearest, as a heap with the farthest on top.
    struct Nearest : Results {
        std::size_t k;
        std::vector<std::pair<float, std::uint32_t>>& heap;
        bool addPoint(float distance2, std::uint32_t i) {
            if (heap.size() == k) {
                std::pop_heap(heap.begin(), heap.end());
                heap.back() = {distance2, i};
            } else {
                heap.emplace_back(distance2, i);
            }
            std::push_heap(heap.begin(), heap.end());
            if (heap.size() == k) worst2 = heap.front().first;
            return true;
        }
    };
    float sum_nearest(Vec3 center, std::size_t k) const {
        float sum = 0;
        if (k < 100) { // its own sorted list is faster
            std::array<std::uint32_t, 100> index;
            std::array<float, 100> distance2;
            const std::size_t count =
                tree.knnSearch(&center.x, k, index.data(), distance2.data());
            for (std::size_t i = 0; i < count; ++i) sum += values[index[i]];
            return sum;
        }
        static thread_local std::vector<std::pair<float, std::uint32_t>> heap;
        heap.clear();
        for (const auto& [distance2, i] :
             find(Nearest{{std::numeric_limits<float>::infinity()}, k, heap}, center)
                 .heap)
            sum += values[i];
        return sum;
    }

    struct First : Results {
        bool found = false;
        bool addPoint(float, std::uint32_t) {
            found = true;
            return false;
        }
    };
    float any(Vec3 center, float radius) const {
        return find(First{{radius * radius}}, center).found ? 1.0f : 0.0f;
    }

    struct Closest : Results {
        std::uint32_t index = 0;
        bool addPoint(float distance2, std::uint32_t i) {
            worst2 = distance2;
            index = i;
            return true;
        }
    };
    float one(Vec3 center) const {
        return values[find(Closest{{std::numeric_limits<float>::infinity()}}, center)
                          .index];
    }
};

} // namespace nanoflann_peer
