/// \file glass_caustic.cpp
/// \brief A caustic at equal error: how many processor seconds to relMSE 0.008 and a
/// block error of 0.0006, on one thread.
///
/// The scene is the published glass_caustic: a ball of glass in a closed grey room under
/// a small lamp, 200 x 200 pixels. The reference comes from another algorithm, the path
/// tracer, which finds the caustic only when a path happens to meet the lamp; it is made
/// once, in pieces that tell its own noise:
///
///     bench_glass_caustic --make-reference=ref --pieces=16 --rays=1024
///     bench_glass_caustic --reference=ref
///
/// Counters: relMSE and block error, each less the reference's own share; the trimmed
/// relMSE; rays and photons.

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include <ljus/inspect/metrics.hpp>
#include <ljus/io/pfm.hpp>
#include <ljus/ljus.hpp>

namespace {

using namespace ljus;

using CausticScene = Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Glass>>;

/// The scene of glass_caustic.json, two triangles a wall taken as one quad.
CausticScene glass_caustic() {
    CausticScene scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.5f}});
    const auto wall = [&](Vec3 corner, Vec3 u, Vec3 v) {
        scene.add(Quad{.corner = corner, .edge_u = u, .edge_v = v}, white);
    };
    wall({-1, 0, -1}, {0, 0, 4}, {2, 0, 0}); // floor
    wall({-1, 2, -1}, {2, 0, 0}, {0, 0, 4}); // ceiling
    wall({-1, 0, -1}, {2, 0, 0}, {0, 2, 0}); // back
    wall({-1, 0, 3}, {0, 2, 0}, {2, 0, 0});  // front
    wall({-1, 0, -1}, {0, 2, 0}, {0, 0, 4}); // left
    wall({1, 0, -1}, {0, 0, 4}, {0, 2, 0});  // right
    scene.add(
        Quad{.corner{-0.7f, 1.98f, -0.6f}, .edge_u{0.3f, 0, 0}, .edge_v{0, 0, 0.3f}},
        scene.add(Lambertian{.albedo = Rgb{0}}), Rgb{50});
    scene.add(Sphere{.center{0, 0.5f, 0}, .radius = 0.35f},
              scene.add(Glass{.index = 1.5f}));
    return scene;
}

Camera camera() {
    return look_at(
        View{.position{0, 1.3f, 2.8f}, .target{0.1f, 0.25f, 0}, .vfov_degrees = 36});
}

/// Processor seconds of this process.
double processor_seconds() {
    return double(std::clock()) / double(CLOCKS_PER_SEC);
}

/// The reference, and the error that it has itself.
struct Reference {
    ImageT<double> image{};
    double noise = 0;       ///< relMSE of the mean of the pieces.
    double block_noise = 0; ///< Block error of the same.
};

std::string piece_name(const std::string& name, int piece) {
    return name + "-" + std::to_string(piece) + ".pfm";
}

/// Renders the pieces by path tracing, each with a seed of its own.
void make_reference(const std::string& name, int pieces, int rays) {
    const CausticScene scene = glass_caustic();
    const auto tracer = make_path_tracer(scene);
    for (int piece = 0; piece < pieces; ++piece) {
        const auto result =
            render(tracer, camera(),
                   {.width = 200,
                    .height = 200,
                    .samples = rays,
                    .seed = 1000000 + static_cast<std::uint64_t>(piece)});
        save_pfm(result.image, piece_name(name, piece));
        std::printf("piece %d of %d\n", piece + 1, pieces);
        std::fflush(stdout);
    }
}

/// Reads the pieces; the two halves of them differ by twice the noise of the mean.
Reference load_reference(const std::string& name) {
    std::vector<Image> pieces;
    while (std::FILE* file =
               std::fopen(piece_name(name, int(pieces.size())).c_str(), "rb")) {
        std::fclose(file);
        pieces.push_back(load_pfm(piece_name(name, int(pieces.size()))));
    }
    if (pieces.size() < 2) {
        std::fprintf(stderr, "There is no reference %s-0.pfm, -1.pfm, ...\n",
                     name.c_str());
        std::exit(2);
    }
    const std::size_t even = pieces.size() / 2 * 2;
    Reference reference;
    auto& mean = reference.image = make_image<double>(200, 200);
    auto first = mean, second = mean;
    for (std::size_t i = 0; i < even; ++i)
        for (int y = 0; y < 200; ++y)
            for (int x = 0; x < 200; ++x) {
                const RgbT<double> share =
                    RgbT<double>(pixel(pieces[i], x, y)) / double(even);
                pixel(mean, x, y) += share;
                pixel(i % 2 == 0 ? first : second, x, y) += share * 2.0;
            }
    // (a - b)^2 / 4 is the variance of (a + b) / 2.
    reference.noise = rel_mse(first, mean);
    reference.block_noise = block_error(first, mean);
    return reference;
}

Reference reference; // NOLINT: made once, before the benchmarks run

/// Direct light by rays, caustics and indirect light by photons.
PhotonMappingSettings settings_for(double caustic_photons, double caustic_radius,
                                   double indirect_photons, double indirect_radius) {
    PhotonMappingSettings settings;
    settings.indirect = IndirectLight::photons;
    settings.split_glass = true;
    settings.caustics.photons = static_cast<long long>(caustic_photons);
    settings.caustics.threads = 1;
    settings.caustics_estimate.radius = static_cast<float>(caustic_radius);
    settings.general.photons = static_cast<long long>(indirect_photons);
    settings.general.shadow_photons = false;
    settings.general.threads = 1;
    settings.general_estimate.radius = static_cast<float>(indirect_radius);
    return settings;
}

void count(benchmark::State& state, const Image& image, const Counts& counts) {
    state.counters["relMSE"] = rel_mse(image, reference.image) - reference.noise;
    state.counters["blocks"] =
        block_error(image, reference.image) - reference.block_noise;
    state.counters["trimmed"] = trimmed_rel_mse(image, reference.image);
    state.counters["rays"] = double(counts.rays());
}

/// Both passes of the photon mapper. Arguments: rays a pixel; of the caustics and of the
/// indirect light thousands of photons and the radius in thousandths; the seed.
void photon_mapping(benchmark::State& state) {
    const CausticScene scene = glass_caustic();
    const auto seed = static_cast<std::uint64_t>(state.range(5));
    PhotonMappingSettings settings =
        settings_for(1e3 * double(state.range(1)), 1e-3 * double(state.range(2)),
                     1e3 * double(state.range(3)), 1e-3 * double(state.range(4)));
    settings.caustics.seed = settings.general.seed = seed;
    RenderedT<float> result;
    for (auto _ : state) {
        const double start = processor_seconds();
        const auto maps = make_photon_maps(scene, settings);
        const auto mapper = make_photon_mapper(scene, maps, settings);
        result = render(mapper, camera(),
                        {.width = 200,
                         .height = 200,
                         .samples = static_cast<int>(state.range(0)),
                         .seed = seed,
                         .threads = 1});
        state.SetIterationTime(processor_seconds() - start);
    }
    count(state, result.image, result.counts);
}

/// The path tracer, for comparison. Argument: rays a pixel.
void path_tracing(benchmark::State& state) {
    const CausticScene scene = glass_caustic();
    const auto tracer = make_path_tracer(scene);
    RenderedT<float> result;
    for (auto _ : state) {
        const double start = processor_seconds();
        result = render(tracer, camera(),
                        {.width = 200,
                         .height = 200,
                         .samples = static_cast<int>(state.range(0)),
                         .threads = 1});
        state.SetIterationTime(processor_seconds() - start);
    }
    count(state, result.image, result.counts);
}

} // namespace

BENCHMARK(photon_mapping)
    ->ArgsProduct({{2, 3, 4}, {50}, {14}, {700}, {50}, {1, 2, 3, 4}})
    ->ArgNames({"rays", "caustic_k", "r_milli", "indirect_k", "r_milli", "seed"})
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->UseManualTime();
BENCHMARK(path_tracing)
    ->Arg(16)
    ->Arg(64)
    ->ArgName("rays")
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->UseManualTime();

/// Makes a reference, or measures against one.
int main(int argc, char** argv) {
    std::string make, use;
    int pieces = 16, rays = 1024, rest = 1;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const auto value = word.substr(std::min(word.find('=') + 1, word.size()));
        if (word.rfind("--make-reference=", 0) == 0)
            make = value;
        else if (word.rfind("--reference=", 0) == 0)
            use = value;
        else if (word.rfind("--pieces=", 0) == 0)
            pieces = std::atoi(value.c_str());
        else if (word.rfind("--rays=", 0) == 0)
            rays = std::atoi(value.c_str());
        else
            argv[rest++] = argv[i];
    }
    if (!make.empty()) {
        make_reference(make, pieces, rays);
        return 0;
    }
    if (use.empty()) {
        std::fprintf(stderr, "bench_glass_caustic needs --reference=NAME, made with "
                             "--make-reference=NAME.\n");
        return 2;
    }
    reference = load_reference(use);
    std::printf("The reference's own noise: relMSE %.2g, blocks %.2g\n",
                reference.noise, reference.block_noise);
    argc = rest;
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
