// needs: mpi
/// \file 32_many_machines.cpp
/// \brief Both passes on many machines, with Open MPI: the bytes of one machine.
///
///     mpirun -n 8 many_machines --out picture.pfm
///     mpirun -n 8 many_machines --scene scene.json --out picture.png
///
/// Each rank traces its part of the photons; one exchange gives all of them to all, in
/// the order of emission; each rank renders strips of rows, and rank 0 puts them together.

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <mpi.h>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/fingerprint.hpp"
#include "ljus/io/hdr.hpp"
#include "ljus/io/load_json.hpp"
#include "ljus/io/pfm.hpp"
#include "ljus/io/png.hpp"
#include "ljus/ljus.hpp"
#include "ljus/math/stratified_stream.hpp"
#include "ljus/scenes/report_rooms.hpp"

namespace {

using namespace ljus;

/// One of several processes that have a job together.
struct Rank {
    int number = 0; ///< From 0 on.
    int count = 1;  ///< How many there are.

    /// Its part of some things: the same for all who ask, and all are covered.
    [[nodiscard]] detail::BlockRange part(long long things, int of) const {
        return {things * of / count, things * (of + 1) / count};
    }
};

/// Values of all ranks, one after the other: each gives its own, and all have all.
/// MPI counts in `int`, so it is told of values, not of bytes.
template <typename V>
std::vector<V> all_of(const std::vector<V>& mine, const Rank& rank) {
    static_assert(std::is_trivially_copyable_v<V>);
    const auto ranks = static_cast<std::size_t>(rank.count);
    if (mine.size() > std::size_t(std::numeric_limits<int>::max()) / ranks)
        throw std::runtime_error("there are too many photons for one exchange");
    const int count = static_cast<int>(mine.size());
    std::vector<int> counts(ranks), places(ranks, 0);
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
    for (std::size_t i = 1; i < ranks; ++i) places[i] = places[i - 1] + counts[i - 1];

    MPI_Datatype type = MPI_DATATYPE_NULL;
    MPI_Type_contiguous(int(sizeof(V)), MPI_BYTE, &type);
    MPI_Type_commit(&type);
    std::vector<V> all(static_cast<std::size_t>(places.back() + counts.back()));
    MPI_Allgatherv(mine.data(), count, type, all.data(), counts.data(), places.data(),
                   type, MPI_COMM_WORLD);
    MPI_Type_free(&type);
    return all;
}

/// The photons of the caustics map: this rank's part, and then all of them.
// [photons]
template <AnyWorld W>
std::vector<Photon> photons_of(const W& world, const PhotonPassSettings& pass,
                               const Rank& rank) {
    const auto targets = specular_objects(world);
    if (targets.empty() || pass.photons == 0) return {};
    const LightChoice choice = detail::start_pass<float>(pass, world.light_choice());
    const auto paths = rank.part(pass.photons, rank.number);
    const long long size = detail::photon_block, count = paths.last - paths.first;
    std::vector<detail::PhotonBlockT<float>> blocks(
        static_cast<std::size_t>(detail::block_count(count, size)));
    const auto body = [&](long long i) {
        detail::BlockRange range = detail::block_range(i, size, count);
        range = {paths.first + range.first, paths.first + range.last};
        detail::trace_block(world, MapType::caustics, choice, targets, pass, range,
                            blocks[static_cast<std::size_t>(i)]);
    };
    parallel_blocks(static_cast<long long>(blocks.size()), body,
                    {.threads = pass.threads});
    TracedPhotonsT<float> mine;
    (void)detail::join_blocks(blocks, mine);
    return all_of(mine.photons, rank);
}
// [photons]

/// The strips of rows that a rank renders. The ranks take turns: each has its share of the
/// slow parts of a picture.
// [strips]
std::vector<RowRange> strips_of(int number, const Rank& rank, int height) {
    constexpr int strip = 8; // rows
    std::vector<RowRange> strips;
    for (int first = number * strip; first < height; first += rank.count * strip)
        strips.push_back({first, std::min(first + strip, height)});
    return strips;
}
// [strips]

/// The picture, of the strips of rank 0, of rank 1, and so on.
Image put_together(const std::vector<Rgb>& all, const RenderSettings& picture,
                   const Rank& rank) {
    Image image = make_image(picture.width, picture.height);
    const auto width = static_cast<std::ptrdiff_t>(picture.width);
    auto next = all.begin();
    for (int number = 0; number < rank.count; ++number)
        for (const auto& [first, last] : strips_of(number, rank, picture.height)) {
            const auto end = next + width * (last - first);
            std::copy(next, end, image.pixels.begin() + width * first);
            next = end;
        }
    return image;
}

void save(const Image& image, const std::string& path) {
    const std::string kind = std::filesystem::path(path).extension().string();
    if (kind == ".pfm")
        save_pfm(image, path);
    else if (kind == ".hdr")
        save_hdr(image, path);
    else
        save_png(image, path);
}

/// Both passes. Rank 0 saves the picture, when it has all of it.
template <AnyWorld W>
void render_room(const W& world, const Camera& camera, const RenderSettings& picture,
                 PhotonMappingSettings settings, const Rank& rank,
                 const std::string& path, bool quiet) {
    const examples::StopWatch watch;
    PhotonMap caustics = make_photon_map(photons_of(world, settings.caustics, rank));
    settings.caustics.photons = 0; // none besides these
    PhotonMapper mapper(world, settings, abilities<StratifiedStream>);
    mapper.set_caustics(std::move(caustics));
    const double first = watch.seconds();

    // [rows]
    std::vector<Rgb> mine;
    for (const auto& rows : strips_of(rank.number, rank, picture.height)) {
        const auto strip = render_rows(mapper, camera, picture, rows).image;
        mine.insert(mine.end(), strip.pixels.begin(), strip.pixels.end());
    }
    const double view = watch.seconds() - first;
    const std::vector<Rgb> all = all_of(mine, rank);
    // [rows]
    if (rank.number != 0) return;
    const Image image = put_together(all, picture, rank);
    save(image, path);
    if (!quiet)
        std::printf("%d ranks: photons and map %.3f s, rank 0's rows %.3f s, in all "
                    "%.3f s; picture %s\n  %s\n",
                    rank.count, first, view, watch.seconds(),
                    examples::hex_text(examples::hash_of(image.pixels)).c_str(),
                    path.c_str());
}

void body(examples::CommandLine& line) {
    Rank rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank.number);
    MPI_Comm_size(MPI_COMM_WORLD, &rank.count);
    std::string scene;
    long long photons = 100000;
    line.about("The report's renderer on many machines: mpirun -n 8 many_machines.");
    line.file_types({".png", ".hdr", ".pfm"});
    line.add("--scene", scene, "A scene file, or the four-glass room");
    line.add("--caustic-photons", photons, "Aimed at mirrors and glass", 0,
             1'000'000'000);
    const examples::Options options =
        line.parse({.draft{.width = 100, .height = 100, .samples = 4},
                    .report{.width = 400, .height = 400, .samples = 64},
                    .reference{.width = 400, .height = 400, .samples = 1024}});
    const std::string path =
        options.path(options.file.empty() ? "many-machines.pfm" : options.file);
    if (rank.number == 0) examples::require_writable(path);
    PhotonMappingSettings settings;
    settings.caustics.photons = photons;
    settings.caustics.seed = options.seed;
    settings.caustics.threads = options.threads;
    RenderSettings picture{options.width, options.height, options.samples, options.seed,
                           options.threads};
    require_image_size(picture.width, picture.height);
    if (scene.empty()) {
        const auto room = four_glass_room();
        render_room(room.world, room.camera, picture, settings, rank, path,
                    options.quiet);
        return;
    }
    auto loaded = load_json(scene);
    const World world(std::move(loaded.scene));
    if (!line.given("--width")) picture.width = loaded.width;
    if (!line.given("--height")) picture.height = loaded.height;
    render_room(world, loaded.camera, picture, settings, rank, path, options.quiet);
}

} // namespace

/// Renders on many machines.
int main(int argc, char** argv) {
    int threads = 0;
    // Only the thread that began talks to the other ranks.
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
    const int code = examples::run_main(argc, argv, body);
    // A rank that has failed has said why; the others would wait for it for ever.
    if (code != 0) MPI_Abort(MPI_COMM_WORLD, code);
    MPI_Finalize();
    return code;
}
