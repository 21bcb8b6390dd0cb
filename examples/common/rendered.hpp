#pragma once

/// \file examples/common/rendered.hpp
/// \brief A picture of a program's options, with a progress bar while it is made.

#include <string>

#include "common/command_line.hpp"
#include "common/terminal.hpp"
#include "ljus/render/render.hpp"

namespace examples {

/// Size, rays, seed and threads as the options have them.
[[nodiscard]] inline ljus::RenderSettings picture_settings(const Options& options) {
    return {.width = options.width,
            .height = options.height,
            .samples = options.samples,
            .seed = options.seed,
            .threads = options.threads};
}

/// Renders a picture with a progress bar; Ctrl-C ends the program.
/// \param name      Of the bar.
/// \param renderer  As render() has it.
/// \param camera    As render() has it.
/// \param picture   As render() has it; its bar, and threads if it has none, are added.
/// \param options   Threads, and whether there is a bar.
/// \return The picture and its counts.
template <typename Renderer, typename AnyCamera>
[[nodiscard]] auto rendered(const std::string& name, const Renderer& renderer,
                            const AnyCamera& camera, ljus::RenderSettings picture,
                            const Options& options) {
    ProgressBar bar(name, options.quiet);
    picture.progress = bar;
    if (picture.threads == 0) picture.threads = options.threads;
    auto result = render(renderer, camera, picture);
    stop_if_asked();
    return result;
}

/// The same, with the size, rays, seed and threads of the options.
template <typename Renderer, typename AnyCamera>
[[nodiscard]] auto rendered(const std::string& name, const Renderer& renderer,
                            const AnyCamera& camera, const Options& options) {
    return rendered(name, renderer, camera, picture_settings(options), options);
}

} // namespace examples
