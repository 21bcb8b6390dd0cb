#pragma once

/// \file examples/common/rendered.hpp
/// \brief Renders a picture by the options of a program, with a progress bar.

#include <string>

#include "common/command_line.hpp"
#include "common/terminal.hpp"
#include "ljus/render/render.hpp"

namespace examples {

/// The settings of a picture, by the options: size, rays, seed and threads.
[[nodiscard]] inline ljus::RenderSettings picture_settings(const Options& options) {
    return {.width = options.width,
            .height = options.height,
            .samples = options.samples,
            .seed = options.seed,
            .threads = options.threads};
}

/// Renders a picture with a progress bar; Ctrl-C ends the program.
/// \param name      The name of the bar.
/// \param renderer  As for render().
/// \param camera    As for render().
/// \param picture   As for render(). The progress bar is added and, if `threads` is 0,
///                  the threads of the options.
/// \param options   Threads, and whether to draw a bar.
/// \return The result of render().
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

/// Renders a picture with a progress bar, with the size, rays, seed and threads of the
/// options.
template <typename Renderer, typename AnyCamera>
[[nodiscard]] auto rendered(const std::string& name, const Renderer& renderer,
                            const AnyCamera& camera, const Options& options) {
    return rendered(name, renderer, camera, picture_settings(options), options);
}

} // namespace examples
