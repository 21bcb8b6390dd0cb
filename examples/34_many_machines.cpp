// needs: mpi
/// \file 34_many_machines.cpp
/// \brief Chapter 34: runs both passes on many machines, with Open MPI. The picture is
/// byte for byte that of one machine.
///
///     mpirun -n 8 34_many_machines scene.json --out folder

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include <mpi.h>

#include <ljus/io/load_json.hpp>
#include <ljus/io/pfm.hpp>
#include <ljus/ljus.hpp>
#include <ljus/math/stratified_stream.hpp>

#include "common/example.hpp"
#include "common/program_files.hpp"
#include "common/ranks.hpp"

using namespace ljus;
using examples::Rank;

namespace {

/// The photons of the caustics map. This rank traces some of them, and receives all.
// [photons]
template <AnyWorld W>
std::vector<Photon> photons_of(const W& world, const PhotonPassSettings& pass,
                               const Rank& rank) {
    if (specular_objects(world).empty()) return {};
    const long long first = pass.photons * rank.number / rank.count;
    const long long last = pass.photons * (rank.number + 1) / rank.count;
    const auto mine = trace_photons(world, MapType::caustics, pass, first, last);
    const int count = static_cast<int>(mine.photons.size());
    std::vector<int> counts(std::size_t(rank.count)), before(counts.size() + 1, 0);
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
    std::partial_sum(counts.begin(), counts.end(), before.begin() + 1);
    std::vector<Photon> all(std::size_t(before.back()));
    MPI_Datatype photon = MPI_DATATYPE_NULL; // MPI counts in int, so photons are
                                             // counted, not bytes
    MPI_Type_contiguous(int(sizeof(Photon)), MPI_BYTE, &photon);
    MPI_Type_commit(&photon);
    MPI_Allgatherv(mine.photons.data(), count, photon, all.data(), counts.data(),
                   before.data(), photon, MPI_COMM_WORLD);
    MPI_Type_free(&photon);
    return all;
}
// [photons]

/// The strips of rows that a rank renders. Strips are dealt to the ranks in turn, so
/// that all of them share the slow regions.
std::vector<PixelRegion> strips_of(const Rank& rank, int width, int height) {
    constexpr int strip = 8; // rows
    std::vector<PixelRegion> strips;
    for (int row = rank.number * strip; row < height; row += rank.count * strip)
        strips.push_back({0, row, width, std::min(strip, height - row)});
    return strips;
}

void body(examples::CommandLine& line, Rank& rank) {
    PhotonPassSettings pass;
    std::string path;
    line.about("Photon mapping on many machines: mpirun -n 8 34_many_machines SCENE.");
    line.add_positional("SCENE", path, "A scene file");
    line.group("Picture", {"--width", "--height", "--rays", "--seed"});
    line.add("--caustic-photons", pass.photons, "Photons aimed at mirrors and glass", 0,
             1'000'000'000);
    const examples::Options options = line.parse();
    const std::string picture_file = options.path("many-machines.pfm");
    const examples::StopWatch watch;
    const FilesRead read;
    auto file = load_json(path);
    examples::agree(rank, examples::picture_text(line.values("Picture"), read.hash()));
    examples::require_outputs({{"--out", picture_file}}, examples::paths_of(read));
    const World world(std::move(file.scene));
    pass.seed = options.seed;
    const PhotonMappingSettings settings{.caustics{.photons = 0}}; // traced below
    PhotonMapper mapper(world, settings, abilities<StratifiedStream>);
    mapper.set_caustics(make_photon_map(photons_of(world, pass, rank)));

    RenderSettings picture = picture_settings(options);
    if (!line.given("--width")) picture.width = file.width;
    if (!line.given("--height")) picture.height = file.height;
    // [rows]
    Image image = make_image(picture.width, picture.height);
    for (const PixelRegion& rows : strips_of(rank, picture.width, picture.height)) {
        const Image strip = render_region(mapper, file.camera, picture, rows).image;
        std::copy(strip.pixels.begin(), strip.pixels.end(),
                  image.pixels.begin() + std::ptrdiff_t(rows.y) * picture.width);
    }
    // Each pixel is 0 on all ranks except one, so no sum is rounded.
    Rgb* const pixels = image.pixels.data();
    MPI_Reduce(rank.number == 0 ? MPI_IN_PLACE : pixels, pixels,
               3 * int(image.pixels.size()), MPI_FLOAT, MPI_SUM, 0, MPI_COMM_WORLD);
    // [rows]
    if (rank.number != 0) return;
    save_pfm(image, picture_file);
    if (!options.quiet) std::printf("%d ranks: %.3f s\n", rank.count, watch.seconds());
}

} // namespace

/// Renders on many machines.
int main(int argc, char** argv) {
    return examples::run_ranks(argc, argv, body);
}
