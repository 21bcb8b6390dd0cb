// needs: mpi
/// \file 34_distributed_map.cpp
/// \brief Chapter 34: a photon map that no machine holds whole. Each rank owns the
/// photons of one region, and answers the queries of all ranks there.
///
///     mpirun -n 8 34_distributed_map scene.json --out folder

#include <cstdio>
#include <string>
#include <vector>

#include <mpi.h>

#include <ljus/io/load_json.hpp>
#include <ljus/io/pfm.hpp>
#include <ljus/ljus.hpp>

#include "common/example.hpp"
#include "common/program_files.hpp"
#include "common/ranks.hpp"
#include "experiments/regions.hpp"

using namespace ljus;
using examples::all_to_all;
using examples::Rank;
using examples::Regions;
template <typename T>
using Lists = std::vector<std::vector<T>>; // one for each rank

namespace {

/// The photons of some paths of both passes.
template <AnyWorld W>
std::vector<Photon> trace_paths(const W& world, const PhotonPassSettings& pass,
                                long long first, long long last) {
    auto photons = trace_photons(world, MapType::general, pass, first, last).photons;
    const auto caustic = trace_photons(world, MapType::caustics, pass, first, last);
    photons.insert(photons.end(), caustic.photons.begin(), caustic.photons.end());
    return photons;
}

/// The map of a rank's region: the photons in it, and those within a radius of it.
PhotonMap map_of_region(const std::vector<Photon>& traced, const Regions& regions,
                        int ranks) {
    Lists<Photon> photons(std::size_t(ranks), std::vector<Photon>{});
    for (const Photon& photon : traced)
        regions.visit(photon.position,
                      [&](int rank) { photons[std::size_t(rank)].push_back(photon); });
    return make_photon_map(all_to_all(photons), 1);
}

/// What a rank does with the answer to a query.
struct Asked {
    std::size_t pixel = 0;
    Rgb throughput{1};
};

/// Queries, each for the rank that owns the point: the ray that met it.
struct Queries {
    Lists<Ray> rays;
    Lists<Asked> asked;
};

/// Follows a camera path by at most 32 mirrors and panes of glass, and asks at the first
/// diffuse surface.
/// \return The emission on the way, E S* L.
template <AnyWorld W>
Rgb ask(const W& world, PathState path, RandomStream& stream, const Regions& regions,
        std::size_t pixel, Queries& queries) {
    Rgb emitted{0};
    for (bool goes_on = true; goes_on && path.depth < 32;) {
        const auto x = next_vertex(world, path, stream);
        if (!x)
            return emitted + path.throughput * sky_radiance(world, path.ray.direction);
        emitted += path.throughput * x->object.emission;
        goes_on = visit_material_at(world, *x, [&](const auto& material) {
            if (has(lobes(material), Lobes::non_specular)) {
                const auto rank = std::size_t(regions.owner(x->point.position));
                queries.rays[rank].push_back(path.ray);
                queries.asked[rank].push_back({pixel, path.throughput});
            }
            return continue_path(path, *x, material, Transport::radiance,
                                 Lobes::specular, stream);
        });
    }
    return emitted;
}

/// The radiance that the photons around what a ray meets send back along it.
template <AnyWorld W>
Rgb answer(const W& world, const PhotonMap& map, const Ray& ray,
           const DensityEstimateSettings& disc) {
    const auto hit = closest_hit(world, ray);
    if (!hit) return Rgb{0};
    const Vertex x = vertex_at(world, ray, *hit);
    std::uint64_t gathered = 0;
    return visit_material_at(world, x, [&](const auto& material) {
        return estimate_radiance(map, x, material, x.wo, disc, light_kinds, gathered);
    });
}

void body(examples::CommandLine& line, Rank& rank) {
    PhotonPassSettings pass{.shadow_photons = false};
    DensityEstimateSettings disc;
    std::string path;
    line.about(
        "One photon map on many machines: mpirun -n 8 34_distributed_map SCENE.");
    line.add_positional("SCENE", path, "A scene file");
    line.group("Picture", {"--width", "--height", "--rays", "--seed"});
    line.add("--photons", pass.photons, "Photons of each map", 0, 1'000'000'000'000);
    line.add("--radius", disc.radius, "Of an estimate, in scene units", 1e-6, 1e6);
    const examples::Options options = line.parse();
    const std::string picture_file = options.path("distributed-map.pfm");
    const FilesRead read;
    auto file = load_json(path);
    examples::agree(rank, examples::picture_text(line.values("Picture"), read.hash()));
    examples::require_outputs({{"--out", picture_file}}, examples::paths_of(read));
    const World world(std::move(file.scene));
    require_no_fog(world, "this program");
    pass.seed = options.seed;

    // Every rank finds the same regions from the first photons, without a message.
    std::vector<Vec3> positions;
    for (const Photon& photon :
         trace_paths(world, pass, 0, std::min(pass.photons, 20000LL)))
        positions.push_back(photon.position);
    const Regions regions(std::move(positions), rank.count, disc.radius);
    const PhotonMap map =
        map_of_region(trace_paths(world, pass, pass.photons * rank.number / rank.count,
                                  pass.photons * (rank.number + 1) / rank.count),
                      regions, rank.count);

    RenderSettings picture = picture_settings(options);
    if (!line.given("--width")) picture.width = file.width;
    if (!line.given("--height")) picture.height = file.height;
    Image image = make_image(picture.width, picture.height);
    const PictureRays rays(picture);
    Queries queries{Lists<Ray>(std::size_t(rank.count)),
                    Lists<Asked>(std::size_t(rank.count))};
    for (int y = rank.number; y < picture.height; y += rank.count)
        for (int x = 0; x < picture.width; ++x)
            for (int i = 0; i < picture.samples; ++i) {
                RandomStream stream;
                const auto sample = sample_pixel<float>(rays, {x, y, i}, stream);
                const Ray ray = camera_ray(file.camera, sample.place, picture.width,
                                           picture.height, stream);
                pixel(image, x, y) +=
                    ask(world, camera_path(world, ray, stream), stream, regions,
                        std::size_t(y) * std::size_t(picture.width) + std::size_t(x),
                        queries);
            }
    std::vector<int> count;
    const std::vector<Ray> asked = all_to_all(queries.rays, &count);
    Lists<Rgb> answers(std::size_t(rank.count), std::vector<Rgb>{});
    std::size_t next = 0;
    for (std::size_t from = 0; from < answers.size(); ++from)
        for (int i = 0; i < count[from]; ++i)
            answers[from].push_back(answer(world, map, asked[next++], disc));
    const std::vector<Rgb> found = all_to_all(answers);
    next = 0;
    for (const auto& list : queries.asked)
        for (const Asked& query : list)
            image.pixels[query.pixel] += query.throughput * found[next++];
    for (Rgb& sum : image.pixels) sum /= float(picture.samples);
    Rgb* const pixels = image.pixels.data();
    MPI_Reduce(rank.number == 0 ? MPI_IN_PLACE : pixels, pixels,
               3 * int(image.pixels.size()), MPI_FLOAT, MPI_SUM, 0, MPI_COMM_WORLD);
    if (rank.number == 0) save_pfm(image, picture_file);
}

} // namespace

/// Renders on many machines.
int main(int argc, char** argv) {
    return examples::run_ranks(argc, argv, body);
}
