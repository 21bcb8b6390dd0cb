/// \file equal_error.cpp
/// \brief Time and error of a scene file: the processor seconds that a preset takes on
/// one thread, and its two errors, for several seeds.
///
/// The reference comes from another algorithm, the path tracer, in pieces that give its
/// own noise. It is made once, in minutes to hours:
///
///     bench_equal_error scene.json --reference ref --make 8 --rays 4096
///     bench_equal_error scene.json --reference ref --preset fast --seeds 5
///
/// Each line gives the result of a seed: relMSE and block error, both minus the
/// reference's own noise, the difference of the means, seconds, and the speed of the
/// machine.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/io/load_json.hpp>
#include <ljus/io/pfm.hpp>
#include <ljus/ljus.hpp>
#include <ljus/math/stratified_stream.hpp>
#include <ljus/render/adaptive.hpp>
#include <ljus/render/gathering.hpp>

namespace {

using namespace ljus;

/// The options.
struct Request {
    std::string scene;           ///< File.
    std::string reference;       ///< Files NAME-0.pfm, NAME-1.pfm, ...
    std::string preset = "fast"; ///< draft, fast or exact.
    int make = 0;                ///< Pieces of the reference to make; 0: measure.
    int rays = 4096;             ///< Per pixel, in each piece.
    int seeds = 5;               ///< Pictures to measure.
};

Request parse(int argc, char** argv) {
    Request request;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const auto value = [&] {
            if (i + 1 == argc) throw std::invalid_argument(word + " needs a value");
            return std::string(argv[++i]);
        };
        if (word == "--reference")
            request.reference = value();
        else if (word == "--preset")
            request.preset = value();
        else if (word == "--make")
            request.make = std::stoi(value());
        else if (word == "--rays")
            request.rays = std::stoi(value());
        else if (word == "--seeds")
            request.seeds = std::stoi(value());
        else if (request.scene.empty() && word.front() != '-')
            request.scene = word;
        else
            throw std::invalid_argument("there is no option '" + word + "'");
    }
    if (request.scene.empty() || request.reference.empty())
        throw std::invalid_argument(
            "bench_equal_error needs a scene's file and --reference NAME");
    return request;
}

/// Processor seconds of this process.
double processor_seconds() {
    return double(std::clock()) / double(CLOCKS_PER_SEC);
}

/// Seconds that this machine takes for a fixed task, a chain of 1e8 dependent
/// multiplications and additions: divide by it to compare the seconds of two machines.
double pace() {
    const double start = processor_seconds();
    double x = 0.5;
    for (int i = 0; i < 100'000'000; ++i) x = 3.6 * x * (1 - x);
    return x > 0 ? processor_seconds() - start : 0;
}

std::string piece_name(const std::string& name, std::size_t piece) {
    return name + "-" + std::to_string(piece) + ".pfm";
}

/// A scene file, closed.
struct Subject {
    World<decltype(LoadedScene::scene)> world;
    LensCamera camera;
    int width = 0;  ///< Of its picture, in pixels.
    int height = 0; ///< Of its picture, in pixels.
};

Subject load_subject(const std::string& path) {
    LoadedScene loaded = load_json<float>(path);
    return {World(std::move(loaded.scene)), loaded.camera, loaded.width, loaded.height};
}

void make_reference(const Request& request, const Subject& subject) {
    const PathTracer tracer(subject.world);
    for (std::size_t i = 0; i < std::size_t(request.make); ++i) {
        const auto result = render(tracer, subject.camera,
                                   {.width = subject.width,
                                    .height = subject.height,
                                    .samples = request.rays,
                                    .seed = 1'000'000 + i});
        save_pfm(result.image, piece_name(request.reference, i));
        std::printf("piece %zu of %d\n", i + 1, request.make);
        std::fflush(stdout);
    }
}

/// The reference, and its own error.
struct Reference {
    ImageT<double> image{};
    double noise = 0;       ///< relMSE of the mean of the pieces.
    double block_noise = 0; ///< Block error of the same.
};

Reference load_reference(const Request& request, const Subject& subject) {
    std::vector<Image> pieces;
    while (std::filesystem::exists(piece_name(request.reference, pieces.size())))
        pieces.push_back(load_pfm(piece_name(request.reference, pieces.size())));
    if (pieces.size() < 2 || pieces.size() % 2 != 0)
        throw std::invalid_argument(
            "the reference " + piece_name(request.reference, 0) + ", -1.pfm, ... has " +
            std::to_string(pieces.size()) +
            " pieces; it needs 2, or any even number: --make");
    Reference reference{.image = make_image<double>(subject.width, subject.height)};
    ImageT<double> half = reference.image;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (std::size_t p = 0; p < half.pixels.size(); ++p) {
            const auto share =
                RgbT<double>(pieces[i].pixels[p]) / double(pieces.size());
            reference.image.pixels[p] += share;
            if (i % 2 == 0) half.pixels[p] += share * 2.0;
        }
    // With halves a and b, (a - b)^2 / 4 is the variance of (a + b) / 2.
    reference.noise = rel_mse(half, reference.image);
    reference.block_noise = block_error(half, reference.image);
    return reference;
}

double level_of(const auto& image) {
    double sum = 0;
    for (const auto& c : image.pixels) sum += double(c.x) + double(c.y) + double(c.z);
    return sum;
}

/// Both passes of the photon mapper on one thread, as `render --preset` makes them.
Image photon_mapping(const Subject& subject, Preset preset, std::uint64_t seed) {
    auto settings = preset_settings(preset, subject.width, subject.height);
    settings.caustics.seed = settings.general.seed = seed;
    settings.caustics.threads = settings.general.threads = 1;
    const PresetRays rays = preset_rays(preset);
    const RenderSettings picture{.width = subject.width,
                                 .height = subject.height,
                                 .samples = rays.first + rays.more,
                                 .seed = seed,
                                 .threads = 1};
    PhotonMapper mapper(subject.world, settings,
                        abilities<StratifiedStream, Gathering>);
    mapper.fill_cache(subject.camera, picture);
    if (rays.more == 0) return render(mapper, subject.camera, picture).image;
    return render_adaptive(mapper, subject.camera, picture,
                           {.first = rays.first,
                            .more = rays.more,
                            .batches = 1,
                            .disagreement = rays.disagreement})
        .image;
}

void measure(const Request& request, const Subject& subject) {
    constexpr std::array names{"draft", "fast", "exact"};
    const auto* const name = std::ranges::find(names, request.preset);
    if (name == names.end())
        throw std::invalid_argument("there is no preset '" + request.preset + "'");
    const auto preset = static_cast<Preset>(name - names.begin());
    const Reference reference = load_reference(request, subject);
    std::printf("%s, preset %s, one thread; the reference's own noise: relMSE %.2g, "
                "blocks %.2g\n%6s %10s %10s %10s %8s %8s\n",
                request.scene.c_str(), *name, reference.noise, reference.block_noise,
                "seed", "seconds", "relMSE", "blocks", "mean", "pace");
    for (int seed = 1; seed <= request.seeds; ++seed) {
        const double start = processor_seconds();
        const Image image = photon_mapping(subject, preset, std::uint64_t(seed));
        const double seconds = processor_seconds() - start;
        std::printf("%6d %10.3f %10.5f %10.6f %+7.2f%% %8.3f\n", seed, seconds,
                    rel_mse(image, reference.image) - reference.noise,
                    block_error(image, reference.image) - reference.block_noise,
                    100 * (level_of(image) / level_of(reference.image) - 1), pace());
        std::fflush(stdout);
    }
}

} // namespace

/// Makes a reference, or measures against one.
int main(int argc, char** argv) {
    try {
        const Request request = parse(argc, argv);
        const Subject subject = load_subject(request.scene);
        if (request.make > 0)
            make_reference(request, subject);
        else
            measure(request, subject);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s.\n", error.what());
        return 2;
    }
    return 0;
}
