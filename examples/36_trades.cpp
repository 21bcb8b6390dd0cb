// smoke: --quality draft --width 16 --height 16 --seconds 0.05
/// \file 36_trades.cpp
/// \brief Chapter 36: one room by five settings, each in the same time.

#include <algorithm>
#include <string>

#include <ljus/ljus.hpp>
#include <ljus/math/stratified_stream.hpp>
#include <ljus/render/gathering.hpp>
#include <ljus/render/progressive.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/example.hpp"

using namespace ljus;
using examples::text;

namespace {

/// The mean of as many pictures as can be made in the time.
/// \param shoot  Makes a picture with the given seed.
template <typename Shoot>
ProgressiveState mean_within(double seconds, Shoot shoot) {
    ProgressiveState mean{.alpha = 1};
    const double begin = examples::processor_seconds();
    double took = 0;
    do {
        add_pass(mean, shoot(std::uint64_t(mean.passes) + 1));
        examples::stop_if_asked();
        took = examples::processor_seconds() - begin;
    } while (took + took / double(mean.passes) / 2 < seconds); // to within half a
                                                               // picture
    return mean;
}

/// Settings for a picture with photons.
struct Way {
    std::string name;
    PhotonMappingSettings settings{};
    int rays = 1; ///< Rays per pixel of one picture.
};

} // namespace

/// Renders the Cornell box by each of the settings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        double seconds = 0;
        line.about("Chapter 36, trades: the Cornell box after the same seconds.");
        line.add("--seconds", seconds, "Processor seconds for each picture", 0, 1e6);
        const examples::Options options =
            line.parse({.draft{.width = 60, .height = 60}});
        if (!line.given("--seconds")) seconds = options.pick(0.5, 20.0, 20.0);
        const auto box = cornell_box();
        examples::Table table{.name = "trades-equal", .columns = {"way", "pictures"}};
        const auto save = [&](const std::string& name, const ProgressiveState& mean) {
            save_png(mean_image(mean), options.path("trades-equal-" + name + ".png"));
            table.rows.push_back({name, std::to_string(mean.passes)});
        };

        const PathTracer tracer(box.world);
        save("paths", mean_within(seconds, [&](std::uint64_t seed) {
                 RenderSettings picture = picture_settings(options);
                 picture.samples = 1;
                 picture.seed = seed;
                 return render(tracer, box.camera, picture).image;
             }));

        // The report's settings, and the three presets of the library.
        Way report{"report", {.max_depth = 4, .roulette_depth = 5}, 16};
        report.settings.caustics.photons = 100000;
        report.settings.caustics_estimate.radius = 0.01f;
        const auto preset = [&](Preset which) {
            return preset_settings(which, options.width, options.height);
        };
        Way exact{"exact", preset(Preset::exact), 4};
        const long long pixels = 1LL * options.width * options.height;
        exact.settings.caustics.photons = std::max(20000LL, 2 * pixels);
        for (const Way& way : {report, Way{"draft", preset(Preset::draft), 1},
                               Way{"fast", preset(Preset::fast), 4}, exact})
            save(way.name, mean_within(seconds, [&](std::uint64_t seed) {
                     PhotonMappingSettings settings = way.settings;
                     settings.caustics.seed = settings.general.seed = seed;
                     settings.caustics.threads = options.threads;
                     settings.general.threads = options.threads;
                     RenderSettings picture = picture_settings(options);
                     picture.samples = way.rays;
                     picture.seed = seed;
                     PhotonMapper mapper(box.world, settings,
                                         abilities<StratifiedStream, Gathering>);
                     mapper.fill_cache(box.camera, picture);
                     return render(mapper, box.camera, picture).image;
                 }));
        if (!options.quiet) print_table(table);
    });
}
