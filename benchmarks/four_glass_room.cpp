/// \file four_glass_room.cpp
/// \brief The report's four-glass room: tables 1 and 2 as a benchmark.
///
/// 400 x 400 pixels, depth 4, 100 000 caustic photons, radius 0.05, as in the report.
/// The counters say how many rays were traced per camera ray, and how many per second.
///
///     bench_four_glass_room --benchmark_filter=room --benchmark_repetitions=5
///     bench_four_glass_room --benchmark_filter=render_loop   # rows of table 1

#include <benchmark/benchmark.h>

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

namespace {

using namespace ljus;

/// Depth 4 and no roulette, as in the report.
PhotonMappingSettings report_settings(int shadow_rays, int threads) {
    PhotonMappingSettings settings{.max_depth = 4, .roulette_depth = 5};
    settings.shadow_rays = shadow_rays;
    settings.caustics.photons = 100000;
    settings.caustics.threads = threads;
    settings.caustics_estimate.radius = 0.05f; // the report's
    return settings;
}

void count(benchmark::State& state, const Counts& counts) {
    state.counters["rays/camera_ray"] =
        double(counts.rays()) / double(counts.camera_rays);
    state.counters["rays/s"] = benchmark::Counter(
        double(counts.rays()), benchmark::Counter::kIsIterationInvariantRate);
}

/// Both passes. Arguments: rays per pixel, threads, shadow rays to the lamp.
void room(benchmark::State& state) {
    const auto room = four_glass_room();
    const int threads = static_cast<int>(state.range(1));
    const PhotonMappingSettings settings =
        report_settings(static_cast<int>(state.range(2)), threads);
    Counts counts;
    for (auto _ : state) {
        const PhotonMapper mapper(room.world, settings);
        const auto result =
            render(mapper, room.camera,
                   {.samples = static_cast<int>(state.range(0)), .threads = threads});
        counts = result.counts;
    }
    count(state, counts);
}

/// The second pass alone. Arguments: rays per pixel, threads.
void render_loop(benchmark::State& state) {
    const auto room = four_glass_room();
    const int threads = static_cast<int>(state.range(1));
    const PhotonMappingSettings settings = report_settings(1, threads);
    const PhotonMapper mapper(room.world, settings);
    Counts counts;
    for (auto _ : state) {
        const auto result =
            render(mapper, room.camera,
                   {.samples = static_cast<int>(state.range(0)), .threads = threads});
        counts = result.counts;
    }
    count(state, counts);
}

} // namespace

BENCHMARK(room)
    ->ArgsProduct({{64}, {1, 2}, {1, 2}})
    ->ArgNames({"rays", "threads", "shadow_rays"})
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->UseRealTime();
BENCHMARK(render_loop)
    ->ArgsProduct({{1, 10, 100, 200, 1000}, {1, 2}})
    ->ArgNames({"rays", "threads"})
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->UseRealTime();

BENCHMARK_MAIN();
