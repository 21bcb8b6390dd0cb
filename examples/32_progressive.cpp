// smoke: --quality draft --width 24 --height 24 --passes 8
/// \file 32_progressive.cpp
/// \brief Chapter 32: the mean of many photon maps, which can be stopped and resumed.

#include <string>

#include <ljus/io/progressive_file.hpp>
#include <ljus/ljus.hpp>
#include <ljus/render/progressive.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/example.hpp"
#include "common/same_picture.hpp"

using namespace ljus;

/// Renders the Cornell box in passes, each with its own photons.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long passes = 0;
        double every = 2;
        bool resume = false;
        line.about("Chapter 32, progressive photons: the Cornell box.");
        line.group("Picture", {"--width", "--height", "--rays", "--seed"});
        line.group("Passes");
        line.add("--passes", passes, "Number of photon maps", 1, 1'000'000'000);
        line.add("--every", every, "Seconds between checkpoints", 0, 1e6);
        line.add("--resume", resume, "Continue from progressive.check in the folder");
        const examples::Options options =
            line.parse({.draft{.width = 64, .height = 64, .samples = 1},
                        .report{.width = 400, .height = 400, .samples = 1},
                        .reference{.width = 400, .height = 400, .samples = 1}});
        if (passes == 0) passes = options.pick(100, 1000, 10000);

        // A pass has few photons and large radii, which shrink from pass to pass.
        PhotonMappingSettings settings{.split_glass = true,
                                       .indirect = IndirectLight::photons};
        settings.caustics = {
            .photons = 1000, .seed = options.seed, .threads = options.threads};
        settings.caustics_estimate.radius = 0.12f;
        settings.general = {.photons = 5000,
                            .seed = options.seed,
                            .shadow_photons = false,
                            .threads = options.threads};
        settings.general_estimate.radius = 0.3f;
        const auto box = cornell_box();
        const auto pass = [&](long long number, double scale) {
            return photon_mapping_pass(box.world, box.camera, settings,
                                       picture_settings(options), number, scale);
        };

        // [resume]
        const std::string checkpoint = options.out + "/progressive.check";
        const auto picture = examples::picture_text(line.values("Picture"));
        ProgressiveState state{.picture = picture};
        if (resume) {
            state = load_checkpoint(checkpoint);
            examples::require_same_picture(checkpoint, state.picture, picture);
            require_first_pass(state, pass); // refuses another picture
        }
        examples::ProgressBar bar("passes", options.quiet);
        examples::StopWatch watch;
        const auto after = [&](const ProgressiveState& now) {
            const std::string number = std::to_string(now.passes);
            if (number == "1" || number == "10" || number == "100")
                save_png(mean_image(now),
                         options.out + "/progressive-" + number + ".png");
            if (watch.seconds() >= every) {
                save_checkpoint(checkpoint, now);
                watch.restart();
            }
            return bar(now.passes, passes); // false after Ctrl-C
        };
        const bool done = run_progressive(state, passes, pass, after);
        save_checkpoint(checkpoint, state);
        // [resume]
        examples::when_stopped_say(std::to_string(state.passes) +
                                   " passes are saved in '" + checkpoint +
                                   "'; --resume goes on from there");
        if (done) save_png(mean_image(state), options.path("progressive-last.png"));
    });
}
