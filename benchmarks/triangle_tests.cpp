/// \file triangle_tests.cpp
/// \brief The cost of a ray-triangle test without leaks: Moeller-Trumbore in float and
/// in double, and the watertight test.
///
/// `pairs` meets a new ray with a new triangle each time: all hit, none, or every
/// other. `loop` asks one ray for the nearest of 128 triangles, as a leaf or a small
/// scene does; there the ray's own quantities are computed once. Time is per test.
///
///     bench_triangle_tests --benchmark_enable_random_interleaving=true
///         --benchmark_repetitions=9 --benchmark_report_aggregates_only=true

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include <ljus/geometry/watertight.hpp>

namespace {

using namespace ljus;
using Point = Vec3T<double>;

struct Numbers {
    std::uint64_t state = 1;
    double next() {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<double>(state >> 11) / 9007199254740992.0;
    }
    Point point(double size) {
        const double x = next(), y = next(), z = next();
        return size * (2.0 * Point{x, y, z} - 1.0);
    }
};

enum Aim { hits, misses, mixed };

struct Pairs {
    std::vector<Ray> rays;
    std::vector<Triangle> triangles;
};

/// Pairs of a triangle and a ray towards it, or past it by up to its size.
Pairs make_pairs(Aim aim) {
    Numbers n;
    Pairs pairs;
    while (pairs.rays.size() < 4096) {
        const Point center = n.point(3);
        const Triangle triangle{Vec3(center + n.point(1)), Vec3(center + n.point(1)),
                                Vec3(center + n.point(1))};
        const Point origin = center + n.point(8);
        const Ray ray{.origin = Vec3(origin),
                      .direction =
                          Vec3(glm::normalize(center + n.point(0.7) - origin))};
        const bool hit = intersect<double>(ray, triangle).has_value();
        const bool wanted = aim == hits || (aim == mixed && pairs.rays.size() % 2 == 0);
        if (hit != wanted) continue;
        pairs.rays.push_back(ray);
        pairs.triangles.push_back(triangle);
    }
    if (aim != mixed) return pairs;
    // In an order that a branch predictor cannot learn.
    for (std::size_t i = pairs.rays.size(); i-- > 1;) {
        const auto j = static_cast<std::size_t>(n.next() * static_cast<double>(i + 1));
        std::swap(pairs.rays[i], pairs.rays[j]);
        std::swap(pairs.triangles[i], pairs.triangles[j]);
    }
    return pairs;
}

template <typename Test, Aim aim>
void pairs(benchmark::State& state) {
    const Pairs cases = make_pairs(aim);
    float sum = 0;
    for (auto _ : state)
        for (std::size_t i = 0; i < cases.rays.size(); ++i)
            if (const auto hit = intersect<Test>(cases.rays[i], cases.triangles[i]))
                sum += hit->t;
    benchmark::DoNotOptimize(sum);
    const double tests = static_cast<double>(cases.rays.size());
    state.counters["tests"] =
        benchmark::Counter(tests, benchmark::Counter::kIsIterationInvariantRate |
                                      benchmark::Counter::kInvert); // seconds a test
}

/// A ball of 128 triangles, and rays of which about two of three meet it.
template <typename Test>
void loop(benchmark::State& state) {
    const auto on_ball = [](int row, int column) {
        const double theta = std::numbers::pi * row / 9;
        const double phi = 2 * std::numbers::pi * column / 8;
        return Vec3{static_cast<float>(std::sin(theta) * std::cos(phi)),
                    static_cast<float>(std::sin(theta) * std::sin(phi)),
                    static_cast<float>(std::cos(theta))};
    };
    std::vector<Triangle> mesh;
    for (int row = 0; row < 9; ++row)
        for (int column = 0; column < 8; ++column) {
            const Vec3 a = on_ball(row, column), b = on_ball(row, column + 1),
                       c = on_ball(row + 1, column), d = on_ball(row + 1, column + 1);
            if (row < 8) mesh.push_back({a, c, d});
            if (row > 0) mesh.push_back({a, d, b});
        }
    Numbers n;
    std::vector<Ray> rays;
    for (int i = 0; i < 512; ++i) {
        const Point origin = 4.0 * glm::normalize(n.point(1)), aim = n.point(0.9);
        rays.push_back(
            {.origin = Vec3(origin), .direction = Vec3(glm::normalize(aim - origin))});
    }
    float sum = 0;
    for (auto _ : state)
        for (Ray ray : rays) {
            const auto prepared = prepare<Test>(ray);
            for (const Triangle& triangle : mesh)
                if (const auto hit = intersect<Test>(ray, triangle, prepared))
                    ray.t_max = hit->t;
            if (ray.t_max < 100) sum += ray.t_max;
        }
    benchmark::DoNotOptimize(sum);
    state.counters["tests"] = benchmark::Counter(
        static_cast<double>(rays.size() * mesh.size()),
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

} // namespace

BENCHMARK_TEMPLATE(pairs, float, hits);
BENCHMARK_TEMPLATE(pairs, double, hits);
BENCHMARK_TEMPLATE(pairs, Watertight, hits);
BENCHMARK_TEMPLATE(pairs, float, misses);
BENCHMARK_TEMPLATE(pairs, double, misses);
BENCHMARK_TEMPLATE(pairs, Watertight, misses);
BENCHMARK_TEMPLATE(pairs, float, mixed);
BENCHMARK_TEMPLATE(pairs, double, mixed);
BENCHMARK_TEMPLATE(pairs, Watertight, mixed);
BENCHMARK_TEMPLATE(loop, float);
BENCHMARK_TEMPLATE(loop, double);
BENCHMARK_TEMPLATE(loop, Watertight);

BENCHMARK_MAIN();
