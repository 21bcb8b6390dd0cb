/// \file four_glass_room.cpp
/// \brief The report's four-glass room: tables 1 and 2 as a benchmark.
///
/// 400 x 400 pixels, depth 4, 100 000 caustic photons, radius 0.05, as in the report.
/// The counters say how many rays were traced per camera ray, and how many per second.
///
///     bench_four_glass_room --benchmark_filter=room --benchmark_repetitions=5
///     bench_four_glass_room --benchmark_filter=render_loop   # rows of table 1
///     bench_four_glass_room --benchmark_filter=camera_pass   # beside plain_room.hpp

#include <benchmark/benchmark.h>

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "plain_room.hpp"

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

/// The mean of an image's pixels: to see that two programs render the same.
void mean_of(benchmark::State& state, const std::vector<Vec3>& pixels) {
    Vec3 sum{0};
    for (const Vec3& pixel : pixels) sum += pixel / float(pixels.size());
    state.counters["red"] = sum.r;
    state.counters["green"] = sum.g;
    state.counters["blue"] = sum.b;
}

constexpr int paths_per_pixel = 16;

/// The camera pass by the library.
void camera_pass(benchmark::State& state) {
    const auto room = four_glass_room();
    const PhotonMapper mapper(room.world, report_settings(1, 1));
    Image image;
    for (auto _ : state)
        image = render(mapper, room.camera, {.samples = paths_per_pixel, .threads = 1})
                    .image;
    mean_of(state, image.pixels);
}

/// The same by plain_room.hpp.
void camera_pass_plain(benchmark::State& state) {
    const auto room = four_glass_room();
    const PhotonMapper mapper(room.world, report_settings(1, 1));
    const plain::Room plain_room(mapper.maps().caustics);
    const RenderSettings picture;
    const auto width = float(picture.width);
    std::vector<Vec3> pixels(std::size_t(picture.width * picture.height));
    for (auto _ : state)
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const auto x = float(i % std::size_t(picture.width));
            const auto y = float(i / std::size_t(picture.width));
            plain::Random random{i * 0x9E3779B97F4A7C15u};
            (void)random(); // the first number of nearby seeds is alike
            Vec3 sum{0};
            for (int path = 0; path < paths_per_pixel; ++path) {
                const Vec3 w{1, 0.5f - (x + random()) / width,
                             0.5f - (y + random()) / width};
                sum += plain_room.radiance({-7, 0, 0}, glm::normalize(w), random);
            }
            pixels[i] = sum / float(paths_per_pixel);
        }
    mean_of(state, pixels);
}

} // namespace

BENCHMARK(camera_pass)->Unit(benchmark::kSecond)->Iterations(1);
BENCHMARK(camera_pass_plain)->Unit(benchmark::kSecond)->Iterations(1);
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
