/// \file neighbours.cpp
/// \brief Points near a point: the k-d tree of the book, and its peers.
///
/// Each peer stands behind one adapter struct:
///
///     struct Peer {
///         explicit Peer(const std::vector<ljus::Vec3>& points);       // builds
///         float sum_within(ljus::Vec3 center, float radius) const;    // visits a ball
///         float sum_nearest(ljus::Vec3 center, std::size_t k) const;  // k nearest
///     };
///
/// The sums are of a payload of the points found, so that no peer gets away without
/// touching what a photon map reads, and so that all peers can be seen to agree.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <benchmark/benchmark.h>

#include <ljus/math/random.hpp>
#include <ljus/photons/kd_tree.hpp>

#if __has_include(<nanoflann.hpp>)
#include <nanoflann.hpp>
#define LJUS_BENCH_NANOFLANN 1
#endif

namespace {

using ljus::Vec3;

/// A number for each point, to be read when it is found.
std::vector<float> payload(std::size_t count) {
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = float(i % 7);
    return values;
}

/// The plain tree of the book.
struct PlainTree {
    ljus::KdTree tree;
    std::vector<float> values; // in the tree's order

    explicit PlainTree(const std::vector<Vec3>& points) : tree(points) {
        const std::vector<float> all = payload(points.size());
        for (const std::uint32_t i : tree.order()) values.push_back(all[i]);
    }
    float sum_within(Vec3 center, float radius) const {
        float sum = 0;
        tree.visit_within(center, radius,
                          [&](std::uint32_t i, double) { sum += values[i]; });
        return sum;
    }
    float sum_nearest(Vec3 center, std::size_t k) const {
        std::array<ljus::Neighbor, 256> room;
        const std::span found(room.data(), k);
        const std::size_t count =
            tree.nearest(center, std::numeric_limits<float>::infinity(), found,
                         [](std::uint32_t) { return true; });
        float sum = 0;
        for (std::size_t i = 0; i < count; ++i) sum += values[found[i].index];
        return sum;
    }
};

#ifdef LJUS_BENCH_NANOFLANN
/// nanoflann, told how to read a vector of points.
struct Nanoflann {
    struct Cloud {
        std::vector<Vec3> points;
        std::size_t kdtree_get_point_count() const { return points.size(); }
        float kdtree_get_pt(std::size_t i, std::size_t axis) const {
            return points[i][static_cast<int>(axis)];
        }
        template <typename Box>
        bool kdtree_get_bbox(Box&) const {
            return false;
        }
    };
    using Metric = nanoflann::L2_Simple_Adaptor<float, Cloud>;
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, 3, std::uint32_t>;

    Cloud cloud;
    Tree tree;
    std::vector<float> values;

    explicit Nanoflann(const std::vector<Vec3>& points)
        : cloud{points}, tree(3, cloud, {16}), values(payload(points.size())) {
        tree.buildIndex();
    }
    float sum_within(Vec3 center, float radius) const {
        static thread_local std::vector<std::pair<std::uint32_t, float>> found;
        nanoflann::SearchParams unsorted;
        unsorted.sorted = false;
        tree.radiusSearch(&center.x, radius * radius, found, unsorted);
        float sum = 0;
        for (const auto& [index, distance2] : found) sum += values[index];
        return sum;
    }
    float sum_nearest(Vec3 center, std::size_t k) const {
        std::array<std::uint32_t, 256> index;
        std::array<float, 256> distance2;
        const std::size_t count =
            tree.knnSearch(&center.x, k, index.data(), distance2.data());
        float sum = 0;
        for (std::size_t i = 0; i < count; ++i) sum += values[index[i]];
        return sum;
    }
};
#endif

/// Photons on the six walls of a room of side 10, uniform.
std::vector<Vec3> on_walls(std::size_t count) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        ljus::RandomStream stream = ljus::random_stream(1, ljus::Pass::user, 0, i);
        Vec3 point = 10.0f * ljus::next_3d(stream);
        const int wall = static_cast<int>(6.0f * ljus::next_1d(stream));
        point[wall / 2] = wall % 2 == 0 ? 0.0f : 10.0f;
        points.push_back(point);
    }
    return points;
}

/// A radius within which a wall holds about 50 of them.
float radius_for_50(std::size_t count) {
    return std::sqrt(50.0f * 600.0f / (3.14159265f * float(count)));
}

template <typename Peer>
void build(benchmark::State& state) {
    const auto points = on_walls(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) {
        const Peer peer(points);
        benchmark::DoNotOptimize(&peer);
    }
}

template <typename Peer, bool nearest>
void query(benchmark::State& state) {
    const auto count = static_cast<std::size_t>(state.range(0));
    const auto points = on_walls(count);
    const Peer peer(points);
    const float radius = radius_for_50(count);
    std::size_t i = 0;
    for (auto _ : state) {
        i = (i + 7919) % count;
        benchmark::DoNotOptimize(nearest ? peer.sum_nearest(points[i], 50)
                                         : peer.sum_within(points[i], radius));
    }
    state.SetItemsProcessed(state.iterations());
}

/// Ends the program if two peers disagree on what lies within a ball.
template <typename A, typename B>
void must_agree() {
    const auto points = on_walls(10000);
    const A a(points);
    const B b(points);
    const float radius = radius_for_50(points.size());
    for (std::size_t i = 0; i < points.size(); i += 97) {
        const float difference =
            a.sum_within(points[i], radius) - b.sum_within(points[i], radius);
        if (std::abs(difference) < 7.0f) continue; // one point on the edge, rounded
        std::fprintf(stderr, "Two peers find different points near number %zu.\n", i);
        std::exit(1);
    }
}

} // namespace

BENCHMARK(build<PlainTree>)->Arg(10000)->Arg(1000000);
BENCHMARK(query<PlainTree, false>)->Arg(10000)->Arg(1000000);
BENCHMARK(query<PlainTree, true>)->Arg(10000)->Arg(1000000);
#ifdef LJUS_BENCH_NANOFLANN
BENCHMARK(build<Nanoflann>)->Arg(10000)->Arg(1000000);
BENCHMARK(query<Nanoflann, false>)->Arg(10000)->Arg(1000000);
BENCHMARK(query<Nanoflann, true>)->Arg(10000)->Arg(1000000);
#endif

/// Runs the benchmarks.
int main(int argc, char** argv) {
#ifdef LJUS_BENCH_NANOFLANN
    must_agree<PlainTree, Nanoflann>();
#endif
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
