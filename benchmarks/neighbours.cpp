/// \file neighbours.cpp
/// \brief Searches for near points: the k-d trees of the book, and other libraries
/// (peers).
///
/// Each peer is called through one adapter struct, at its best:
///
///     struct Peer {
///         explicit Peer(const std::vector<ljus::Vec3>& points);      // builds
///         void arrange(const std::vector<float>& payload); // if it wants that
///         float sum_within(ljus::Vec3 center, float radius) const;   // visits a ball
///         float sum_blocks(ljus::Vec3 center, float radius) const;   // by blocks
///         float sum_nearest(ljus::Vec3 center, std::size_t k) const; // k nearest
///         float any(ljus::Vec3 center, float radius) const;          // 1 or 0
///         float one(ljus::Vec3 center) const;                        // the nearest
///     };
///
/// The sums are of a payload of the points found, so that no peer gets away without
/// touching what a photon map reads, and so that all peers can be seen to agree. What a
/// peer cannot do is left out. `--table`, and `--csv FOLDER`, prints the times of all
/// in one run: processor time of one thread, peers in turn, the median of seven rounds,
/// and how many times as long as the wide tree each takes.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <benchmark/benchmark.h>

#include <ljus/accel/kd_tree.hpp>
#include <ljus/accel/kd_tree8.hpp>
#include <ljus/math/random.hpp>

#include "csv.hpp"
#include "nanoflann_peer.hpp"
#include "point_structures.hpp"

#if __has_include(<kdtree++/kdtree.hpp>)
#include <kdtree++/kdtree.hpp>
#define LJUS_BENCH_KDTREEPP 1
#endif

namespace {

using ljus::Vec3;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// A number for each point, to be read when it is found.
std::vector<float> payload(std::size_t count) {
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = float(i % 7);
    return values;
}

/// A payload in the order of a tree, filled up to whole blocks.
template <typename Tree>
std::vector<float> payload_of(const Tree& tree) {
    const std::vector<float> all = payload(tree.size());
    std::vector<float> values;
    for (const std::uint32_t i : tree.point_ids()) values.push_back(all[i]);
    values.resize((values.size() + 7) / 8 * 8);
    return values;
}

/// The wide tree of the book.
struct WideTree {
    static constexpr const char* name = "wide";
    ljus::KdTree8 tree;
    std::vector<float> values; // in the tree's order

    explicit WideTree(const std::vector<Vec3>& points)
        : tree(points, 1), values(payload_of(tree)) {}
    float sum_within(Vec3 center, float radius) const {
        float sum = 0;
        tree.visit_within(center, radius,
                          [&](std::uint32_t i, double) { sum += values[i]; });
        return sum;
    }
    float sum_blocks(Vec3 center, float radius) const {
        ljus::detail::LanesT<float> sums{};
        tree.visit_blocks(center, radius, [&](const auto& block) {
            const float* const value = &values[block.first];
            ljus::detail::for_lanes([&](int i) {
                sums.lane[i] +=
                    (block.found & ljus::detail::lane_bit[i]) != 0 ? value[i] : 0.0f;
            });
        });
        float sum = 0;
        for (const float x : sums.lane) sum += x;
        return sum;
    }
    float sum_nearest(Vec3 center, std::size_t k) const {
        std::array<ljus::Neighbor, 256> room;
        const std::span found(room.data(), k);
        const std::size_t count = tree.nearest(center, infinity, found);
        float sum = 0;
        for (std::size_t i = 0; i < count; ++i) sum += values[found[i].index];
        return sum;
    }
    float any(Vec3 center, float radius) const {
        return tree.any_within(center, radius) ? 1.0f : 0.0f;
    }
    float one(Vec3 center) const {
        const auto found = tree.nearest(center);
        return found ? values[found->index] : 0.0f;
    }
};

/// The plain tree of the book.
struct PlainTree {
    static constexpr const char* name = "plain";
    ljus::KdTree tree;
    std::vector<float> values; // in the tree's order

    explicit PlainTree(const std::vector<Vec3>& points)
        : tree(points), values(payload_of(tree)) {}
    float sum_within(Vec3 center, float radius) const {
        float sum = 0;
        tree.visit_within(center, radius,
                          [&](std::uint32_t i, double) { sum += values[i]; });
        return sum;
    }
    float sum_nearest(Vec3 center, std::size_t k) const {
        std::array<ljus::Neighbor, 256> room;
        const std::span found(room.data(), k);
        const std::size_t count = tree.nearest(center, infinity, found);
        float sum = 0;
        for (std::size_t i = 0; i < count; ++i) sum += values[found[i].index];
        return sum;
    }
    float one(Vec3 center) const { return sum_nearest(center, 1); }
};

#ifdef LJUS_BENCH_KDTREEPP
/// Functions of an allocator that libkdtree++ calls and C++20 has removed.
template <typename T>
struct OldAllocator : std::allocator<T> {
    using pointer = T*;
    using const_pointer = const T*;
    using reference = T&;
    using const_reference = const T&;
    template <typename U>
    struct rebind {
        using other = OldAllocator<U>;
    };
    OldAllocator() = default;
    template <typename U>
    OldAllocator(const OldAllocator<U>&) {}
    template <typename... Arguments>
    void construct(T* p, Arguments&&... arguments) {
        ::new (static_cast<void*>(p)) T(std::forward<Arguments>(arguments)...);
    }
    void destroy(T* p) { p->~T(); }
};

/// libkdtree++, which the report uses: its range is a cube, made a ball here.
struct KdTreePp {
    static constexpr const char* name = "kdtree++";
    struct Item {
        using value_type = float;
        Vec3 point;
        float value;
        float operator[](std::size_t axis) const { return point[int(axis)]; }
    };
    KDTree::KDTree<3, Item, KDTree::_Bracket_accessor<Item>,
                   KDTree::squared_difference<float, float>, std::less<float>,
                   OldAllocator<KDTree::_Node<Item>>>
        tree;

    explicit KdTreePp(const std::vector<Vec3>& points) {
        const std::vector<float> values = payload(points.size());
        std::vector<Item> items;
        for (std::size_t i = 0; i < points.size(); ++i)
            items.push_back({points[i], values[i]});
        tree.efficient_replace_and_optimise(items);
    }
    float sum_within(Vec3 center, float radius) const {
        static thread_local std::vector<Item> found;
        found.clear();
        tree.find_within_range(Item{center, 0}, radius, std::back_inserter(found));
        float sum = 0;
        for (const Item& item : found) {
            const Vec3 way = item.point - center;
            if (glm::dot(way, way) <= radius * radius) sum += item.value;
        }
        return sum;
    }
    float one(Vec3 center) const {
        const auto found = tree.find_nearest(Item{center, 0});
        return found.first == tree.end() ? 0.0f : found.first->value;
    }
};
#endif

/// A peer that is ready to be asked.
template <typename Peer>
std::unique_ptr<Peer> arranged(const std::vector<Vec3>& points) {
    auto peer = std::make_unique<Peer>(points);
    if constexpr (requires { peer->arrange(payload(0)); })
        peer->arrange(payload(points.size()));
    return peer;
}

/// Points of a kind: 0 on walls, 1 in caustics.
std::vector<Vec3> points_of(int kind, std::size_t count) {
    ljus::RandomStream stream = ljus::random_stream(1, ljus::Pass::user, 0, 0);
    const auto unit = [&] { return ljus::next_1d(stream); };
    return kind == 0 ? structures::on_walls(count, unit)
                     : structures::in_caustics(count, unit);
}

/// A radius that holds about 50 of them, as a median.
float radius_for_50(const std::vector<Vec3>& points) {
    const ljus::KdTree8 tree(points, 1);
    std::vector<float> radii;
    std::array<ljus::Neighbor, 50> room;
    for (std::size_t i = 0; i < points.size(); i += points.size() / 400 + 1) {
        (void)tree.nearest(points[i], infinity, std::span(room));
        radii.push_back(float(std::sqrt(room[0].distance2)));
    }
    std::nth_element(radii.begin(), radii.begin() + std::ptrdiff_t(radii.size() / 2),
                     radii.end());
    return radii[radii.size() / 2];
}

enum class Query { within, blocks, nearest_50, nearest_200, any, one };
constexpr std::array names{"radius",      "blocks", "50 nearest",
                           "200 nearest", "any",    "nearest"};

/// Whether a peer has a query.
template <typename Peer, Query query>
constexpr bool has() {
    if constexpr (query == Query::within) return requires(const Peer& p) {
            p.sum_within(Vec3{}, 1.0f);
        };
    else if constexpr (query == Query::blocks)
        return requires(const Peer& p) {
            p.sum_blocks(Vec3{}, 1.0f);
        };
    else if constexpr (query == Query::any)
        return requires(const Peer& p) {
            p.any(Vec3{}, 1.0f);
        };
    else if constexpr (query == Query::one)
        return requires(const Peer& p) {
            p.one(Vec3{});
        };
    else
        return requires(const Peer& p) {
            p.sum_nearest(Vec3{}, 1);
        };
}

/// Queries a peer: `any` and `one` beside the points, the others at them.
template <Query query, typename Peer>
float ask(const Peer& peer, const Vec3& center, float radius) {
    const Vec3 beside = center + 0.3f * radius;
    if constexpr (query == Query::within) return peer.sum_within(center, radius);
    if constexpr (query == Query::blocks) return peer.sum_blocks(center, radius);
    if constexpr (query == Query::nearest_50) return peer.sum_nearest(center, 50);
    if constexpr (query == Query::nearest_200) return peer.sum_nearest(center, 200);
    if constexpr (query == Query::any) return peer.any(beside, radius);
    if constexpr (query == Query::one) return peer.one(beside);
}

template <typename Peer>
void build(benchmark::State& state) {
    const auto points = points_of(int(state.range(1)), std::size_t(state.range(0)));
    for (auto _ : state) {
        const Peer peer(points);
        benchmark::DoNotOptimize(&peer);
    }
}

template <typename Peer, Query which>
void query(benchmark::State& state) {
    const auto points = points_of(int(state.range(1)), std::size_t(state.range(0)));
    const auto peer = arranged<Peer>(points);
    const float radius = radius_for_50(points);
    std::size_t i = 0;
    for (auto _ : state) {
        i = (i + 102947) % points.size();
        benchmark::DoNotOptimize(ask<which>(*peer, points[i], radius));
    }
    state.SetItemsProcessed(state.iterations());
}

template <typename Peer>
void register_all() {
    const auto with = [&](const char* what, auto function) {
        benchmark::RegisterBenchmark((std::string(what) + "/" + Peer::name).c_str(),
                                     function)
            ->ArgsProduct({{10000, 100000, 1000000}, {0, 1}});
    };
    with("build", build<Peer>);
    if constexpr (has<Peer, Query::within>())
        with("radius", query<Peer, Query::within>);
    if constexpr (has<Peer, Query::blocks>())
        with("blocks", query<Peer, Query::blocks>);
    if constexpr (has<Peer, Query::nearest_50>()) {
        with("50_nearest", query<Peer, Query::nearest_50>);
        with("200_nearest", query<Peer, Query::nearest_200>);
    }
    if constexpr (has<Peer, Query::any>()) with("any", query<Peer, Query::any>);
    if constexpr (has<Peer, Query::one>()) with("nearest", query<Peer, Query::one>);
}

double cpu_seconds() {
    return double(std::clock()) / double(CLOCKS_PER_SEC);
}

/// One line of the table: the median time of each peer, and its ratio to the first.
/// \return The ratios, and the first one's time in ns.
template <typename... Times>
std::pair<std::vector<double>, double> print_line(const char* what,
                                                  const std::vector<const char*>& peers,
                                                  int rounds, Times... times) {
    std::vector<std::vector<double>> all(sizeof...(times));
    for (int round = 0; round < rounds; ++round) {
        std::size_t i = 0;
        (all[i++].push_back(times()), ...);
    }
    std::printf("%-12s", what);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::vector<double> ratio;
        for (std::size_t r = 0; r < all[i].size(); ++r)
            ratio.push_back(all[i][r] / all[0][r]);
        std::sort(ratio.begin(), ratio.end());
        ratios.push_back(ratio[ratio.size() / 2]);
        std::sort(all[i].begin(), all[i].end());
        const double time = all[i][all[i].size() / 2];
        if (time < 0)
            std::printf(" | %-9s %9s %6s", peers[i], "-", "-");
        else
            std::printf(" | %-9s %9.0f %6.2f", peers[i], time, ratio[ratio.size() / 2]);
    }
    std::printf("\n");
    std::fflush(stdout);
    return {ratios, all[0][all[0].size() / 2]};
}

float sink = 0; // sum of all results, so that no call is optimised away

/// A table of the book: one peer, and its index.
struct Book {
    examples::Table table;
    std::size_t peer;
};

/// The centres of 10 000 searches, contiguous in memory: fetching them from
/// elsewhere is not part of a search.
std::vector<Vec3> centers_of(const std::vector<Vec3>& points) {
    std::vector<Vec3> centers;
    for (std::size_t i = 1; i <= 10000; ++i)
        centers.push_back(points[i * 102947 % points.size()]);
    return centers;
}

/// Prints the times of all peers over some points, and adds a row to each table.
/// \param kind   Of the points: 0 on walls, 1 in caustics.
/// \param count  How many points.
/// \param size   The same in words.
/// \param books  The tables.
template <typename... Peers>
void measure(int kind, std::size_t count, const char* size, std::vector<Book>& books) {
    const auto points = points_of(kind, count);
    const float radius = radius_for_50(points);
    std::printf("%zu points %s; ns, and times the first\n", count,
                kind == 0 ? "on walls" : "in caustics");
    const auto built = [&]<typename Peer>() {
        return [&] {
            const double start = cpu_seconds();
            const Peer peer(points);
            return (cpu_seconds() - start) * 1e9 / double(count);
        };
    };
    const auto note = [&](const std::vector<double>& ratios) {
        for (Book& book : books) {
            const double ratio = ratios[book.peer];
            book.table.rows.back().push_back(
                ratio > 0 ? examples::text(ratio, ratio < 9.5 ? "%.1f" : "%.0f") : "");
        }
    };
    const std::vector<const char*> all{Peers::name...};
    for (Book& book : books)
        book.table.rows.push_back(
            {std::string(size) + (kind == 0 ? " on walls" : " in caustics")});
    note(print_line("build", all, 5, built.template operator()<Peers>()...).first);
    const std::tuple<std::unique_ptr<Peers>...> peers{arranged<Peers>(points)...};
    const std::vector<Vec3> centers = centers_of(points);
    const auto line = [&]<Query query>() {
        const auto time = [&](const auto& peer) {
            return [&] {
                using Peer = std::remove_cvref_t<decltype(peer)>;
                if constexpr (!has<Peer, query>()) {
                    return -1.0;
                } else {
                    const double start = cpu_seconds();
                    for (const Vec3& center : centers)
                        sink += ask<query>(peer, center, radius);
                    return (cpu_seconds() - start) * 1e9 / double(centers.size());
                }
            };
        };
        const auto [ratios, first] =
            print_line(names[std::size_t(query)], all, 7,
                       time(*std::get<std::unique_ptr<Peers>>(peers))...);
        note(ratios);
        if (query == Query::one)
            for (Book& book : books)
                book.table.rows.back().push_back(examples::text(1e-3 * first, "%.2f"));
    };
    line.template operator()<Query::within>();
    line.template operator()<Query::blocks>();
    line.template operator()<Query::nearest_50>();
    line.template operator()<Query::nearest_200>();
    line.template operator()<Query::any>();
    line.template operator()<Query::one>();
}

/// Ends the program if two peers disagree on what lies within a ball.
template <typename A, typename B>
void must_agree() {
    for (const int kind : {0, 1}) {
        const auto points = points_of(kind, 10000);
        const auto a = arranged<A>(points);
        const auto b = arranged<B>(points);
        const float radius = radius_for_50(points);
        for (std::size_t i = 0; i < points.size(); i += 97) {
            const float difference =
                a->sum_within(points[i], radius) - b->sum_within(points[i], radius);
            if (std::abs(difference) < 7.0f) continue; // one on the edge
            std::fprintf(stderr, "Two peers find different points near number %zu.\n",
                         i);
            std::exit(1);
        }
    }
}

template <typename... Peers>
struct List {};
template <typename... A, typename... B>
constexpr List<A..., B...> operator+(List<A...>, List<B...>) {
    return {};
}
/// All available peers.
constexpr auto all_peers = List<WideTree>{}
#ifdef LJUS_BENCH_NANOFLANN
                           +
                           List<nanoflann_peer::Nanoflann<nanoflann_peer::Installed>>{}
#endif
#ifdef LJUS_BENCH_NANOFLANN_LATEST
                           + List<nanoflann_peer::Nanoflann<nanoflann_peer::Latest>>{}
#endif
#ifdef LJUS_BENCH_KDTREEPP
                           + List<KdTreePp>{}
#endif
                           + List<PlainTree>{};

/// The tables of the book that can be made.
template <typename... Peers>
std::vector<Book> books_of(List<Peers...>) {
    std::vector<Book> books;
    std::size_t place = 0;
    const auto look = [&]<typename Peer>() {
        if constexpr (requires { Peer::book; })
            books.push_back(
                {.table = {.name = Peer::book,
                           .columns = {"nanoflann's time over the wide tree's", "build",
                                       "ball", "by blocks", "50 nearest", "200 nearest",
                                       "any", "nearest",
                                       "the wide tree's nearest, microseconds"}},
                 .peer = place});
        ++place;
    };
    (look.template operator()<Peers>(), ...);
    return books;
}

template <typename... Peers>
int run(int argc, char** argv, List<Peers...> list) {
    (must_agree<WideTree, Peers>(), ...);
    if (argc > 1 &&
        (std::strcmp(argv[1], "--table") == 0 || std::strcmp(argv[1], "--csv") == 0)) {
        std::vector<Book> books = books_of(list);
        for (const auto& [count, size] : {std::pair(10000u, "10 000"),
                                          {100000u, "100 000"},
                                          {1000000u, "a million"}})
            for (const int kind : {0, 1}) measure<Peers...>(kind, count, size, books);
        for (const Book& book : books) save_csv(csv_folder(argc, argv), book.table);
        return std::isnan(sink) ? 1 : 0;
    }
    (register_all<Peers>(), ...);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}

} // namespace

/// Runs the benchmarks, or prints the table.
int main(int argc, char** argv) {
    return run(argc, argv, all_peers);
}
