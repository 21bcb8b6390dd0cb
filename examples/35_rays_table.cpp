// figures: table-3
// smoke: --quality draft --width 8 --height 8
/// \file 35_rays_table.cpp
/// \brief Chapter 35, table 3: time and error with more rays per pixel.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <ljus/image/flip.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/oracle.hpp"

using namespace ljus;
using examples::text;

namespace {

/// The report's settings: paths end at the fourth surface, or else by roulette.
PhotonMappingSettings settings_with(bool fixed_depth, std::uint64_t seed) {
    PhotonMappingSettings settings;
    if (fixed_depth) settings.max_depth = 4, settings.roulette_depth = 5;
    settings.caustics.photons = 100000;
    settings.caustics.seed = seed;
    settings.caustics_estimate.radius = 0.05f;
    return settings;
}

/// Photon mappers of several seeds, so that bias and noise can be told apart.
template <typename World>
auto mappers_of(const World& world, bool fixed_depth,
                const examples::Options& options) {
    std::vector mappers{PhotonMapper(world, settings_with(fixed_depth, 1))};
    for (std::uint64_t seed = 2; seed <= options.pick(3u, 6u, 16u); ++seed)
        mappers.emplace_back(world, settings_with(fixed_depth, seed));
    return mappers;
}

/// The error of pictures with a number of rays.
struct Errors {
    double pixels = 0; ///< relMSE of pixels.
    double blocks = 0; ///< relMSE of the means of 10 x 10 pixels.
    double flip = 0;   ///< FLIP of the first seed.
};

template <typename Mapper>
Errors errors_of(const std::vector<Mapper>& mappers, const Camera& camera, int rays,
                 const examples::Oracle& oracle, const examples::Options& options) {
    RenderSettings picture{.width = oracle.truth.width,
                           .height = oracle.truth.height,
                           .samples = rays,
                           .seed = 0};
    std::vector<Image> runs;
    for (const Mapper& mapper : mappers) {
        ++picture.seed;
        runs.push_back(rendered("errors", mapper, camera, picture, options).image);
    }
    const auto [pixels, blocks] = errors_against(oracle, runs);
    return {std::max(pixels.bias_squared + pixels.variance, 0.0),
            std::max(blocks.bias_squared + blocks.variance, 0.0),
            flip(runs[0], oracle.truth)};
}

} // namespace

/// Measures time and error of the report's room with 1 to 1000 rays per pixel.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 35, rays per pixel: table 3.");
        const examples::Options options =
            line.parse({.draft{.width = 40, .height = 40}});

        const auto room = all_materials_room();
        const double start = examples::processor_seconds();
        const PhotonMapper mapper(room.world, settings_with(true, options.seed));
        const double first_pass = examples::processor_seconds() - start;

        // Errors are measured in smaller pictures, by several seeds.
        const auto fixed = mappers_of(room.world, true, options);
        const auto roulette = mappers_of(room.world, false, options);
        const auto oracle = find_oracle(
            "all-materials", room, std::min(options.pick(24, 64, 100), options.width),
            options.pick(512, 32768, 262144), options);

        examples::Table table{.name = "table-3",
                              .columns = {"rays", "report", "photons, s", "picture, s",
                                          "relMSE, depth 4", "relMSE, roulette",
                                          "blocks, depth 4", "blocks, roulette",
                                          "FLIP, roulette"}};
        const std::vector<std::pair<int, std::string>> report{
            {1, "16 s"}, {10, "20 s"}, {100, "1 min 12 s"}, {1000, "12 min 43 s"}};
        for (const auto& [rays, time] : report) {
            RenderSettings picture = picture_settings(options);
            picture.samples = rays;
            const double before = examples::processor_seconds();
            (void)rendered("picture", mapper, room.camera, picture, options);
            const double seconds = examples::processor_seconds() - before;
            table.rows.push_back({std::to_string(rays), time, text(first_pass, "%.2f"),
                                  text(seconds, "%.3g"), "", "", "", "", ""});
            if (rays > options.pick(100, 1000, 1000)) continue; // to keep a draft quick
            const auto a = errors_of(fixed, room.camera, rays, oracle, options);
            const auto b = errors_of(roulette, room.camera, rays, oracle, options);
            auto cell = table.rows.back().begin() + 4;
            for (const double error : {a.pixels, b.pixels, a.blocks, b.blocks})
                *cell++ = text(error, "%.2g");
            *cell = text(b.flip, "%.3f");
        }
        save_table(options.out, table);
        if (!options.quiet) print_table(table);
    });
}
