#pragma once

/// \file progressive_picture.hpp
/// \brief Makes a picture pass by pass, with previews and checkpoints from which it can
/// be resumed.

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "clock.hpp"
#include "command_line.hpp"
#include "ljus/io/png.hpp"
#include "ljus/io/progressive_file.hpp"
#include "same_picture.hpp"
#include "terminal.hpp"

namespace examples {

/// The options of a picture in passes.
struct PassOptions {
    long long passes = 0;   ///< Number of passes; 0: no passes.
    double alpha = 2.0 / 3; ///< How slowly the radius shrinks; with 1 it is constant.
    std::string checkpoint = {}; ///< File to save the state to; empty: none.
    std::string preview = {};    ///< PNG file to save a preview to; empty: none.
    double every = 2;            ///< Seconds between saves; 0: after each pass.
    bool resume = false;         ///< Whether to continue from the checkpoint.
    double exposure = 0;         ///< Exposure of the preview, in stops.
    std::string picture = {};    ///< The text of picture_text(), which identifies the
                                 ///< picture.
};

/// Adds the options of passes to a command line.
/// \param line  The command line.
/// \param how   Receives the values; must live until the line is parsed.
inline void add_pass_options(CommandLine& line, PassOptions& how) {
    line.add("--passes", how.passes, "Number of passes, each with its own photons", 1,
             1'000'000'000);
    line.add("--alpha", how.alpha, "How slowly the radius shrinks; 1: not at all", 1e-3,
             1);
    line.add("--checkpoint FILE", how.checkpoint, "File to resume the passes from");
    line.add("--resume", how.resume, "Continue from the checkpoint");
    line.add("--preview FILE", how.preview, "PNG file of the passes so far");
    line.add("--every", how.every, "Seconds between saved files; 0: after each pass", 0,
             1e6);
}

/// Refuses options that do not fit together, and a new checkpoint that would replace an
/// existing one.
/// \param how  The options.
/// \throws std::invalid_argument  with one sentence about the option.
inline void check_pass_files(const PassOptions& how) {
    if (how.resume && how.checkpoint.empty())
        throw std::invalid_argument("--resume needs --checkpoint FILE.");
    if (!how.preview.empty() &&
        std::filesystem::path(how.preview).extension() != ".png")
        throw std::invalid_argument("--preview is " + how.preview +
                                    "; its name must end with .png.");
    if (!how.resume && !how.checkpoint.empty() &&
        std::filesystem::exists(how.checkpoint)) // maybe hours of work
        throw std::invalid_argument("--checkpoint is " + how.checkpoint +
                                    ", which is there already; it must be a new file, "
                                    "unless --resume goes on from it.");
}

/// Makes the passes.
/// \param how    The options.
/// \param quiet  Whether to draw no progress bar.
/// \param pass   Called as pass(i, scale); see \ref progressive.
/// \return The state after the last pass.
/// \throws Interrupted after Ctrl-C; the checkpoint then has all finished passes.
/// \throws std::invalid_argument  if the checkpoint is of another picture, or has more
///         passes.
template <typename RenderPass>
[[nodiscard]] ljus::ProgressiveState run_passes(const PassOptions& how, bool quiet,
                                                RenderPass&& pass) {
    using namespace ljus;
    ProgressBar bar("passes", quiet);
    const auto say = [&how](long long saved) {
        when_stopped_say(
            how.checkpoint.empty()
                ? "no pass is saved; with --checkpoint FILE passes can go on later"
            : saved == 0
                ? "no pass was done; the same command begins again"
                : std::to_string(saved) + " passes are saved in '" + how.checkpoint +
                      "'; the same command with --resume goes on from there");
    };
    say(0);
    ProgressiveState state{.alpha = how.alpha, .picture = how.picture};
    if (how.resume) {
        state = load_checkpoint(how.checkpoint);
        require_same_picture(how.checkpoint, state.picture, how.picture);
        if (state.passes > how.passes) // some passes would be lost
            throw std::invalid_argument("--passes is " + std::to_string(how.passes) +
                                        "; it must be at least " +
                                        std::to_string(state.passes) +
                                        ", the passes in '" + how.checkpoint + "'.");
        require_first_pass(state, pass);
        say(state.passes);
    }
    StopWatch watch;
    const auto save = [&](const ProgressiveState& now) {
        if (!how.preview.empty())
            save_png(mean_image(now), how.preview, {.exposure = how.exposure});
        if (!how.checkpoint.empty()) {
            save_checkpoint(how.checkpoint, now);
            say(now.passes);
        }
        watch.restart();
    };
    const bool done = run_progressive(state, how.passes, pass, [&](const auto& now) {
        if (watch.seconds() >= how.every) save(now);
        return bar(now.passes, how.passes);
    });
    if (state.passes > 0) save(state);
    if (!done) throw Interrupted{};
    return state;
}

/// Prints the passes, the standard errors and the radius on the terminal.
/// \param state  The state after at least one pass.
inline void print_passes(const ljus::ProgressiveState& state) {
    const auto error = ljus::estimate_error(state);
    std::printf("%lld passes, standard error %.3g per pixel, %.3g per block of "
                "%d x %d; radius %.3f of the first\n",
                state.passes, error.pixels, error.blocks, state.block_side,
                state.block_side, std::sqrt(state.shrink));
}

} // namespace examples
