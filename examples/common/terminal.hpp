#pragma once

/// \file examples/common/terminal.hpp
/// \brief A progress bar with the time that is left, on stderr if that is a terminal.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "clock.hpp"
#include "signals.hpp"

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace examples {

/// Whether a stream ends at a terminal.
[[nodiscard]] inline bool is_terminal(std::FILE* stream) {
#ifdef _WIN32
    return ::_isatty(::_fileno(stream)) != 0;
#else
    return ::isatty(::fileno(stream)) != 0;
#endif
}

/// A duration as people read it.
/// \param seconds  At least 0.
/// \return "0:07", "12:34", "3:07:00"; "?" for NaN, or for what is longer than 99
/// hours.
[[nodiscard]] inline std::string duration_text(double seconds) {
    if (!(seconds >= 0.0 && seconds < 360000.0)) return "?";
    const long whole = std::lround(seconds);
    const int hours = static_cast<int>(whole / 3600);
    const int minutes = static_cast<int>(whole / 60 % 60);
    const int rest = static_cast<int>(whole % 60);
    char text[32];
    if (hours > 0)
        std::snprintf(text, sizeof text, "%d:%02d:%02d", hours, minutes, rest);
    else
        std::snprintf(text, sizeof text, "%d:%02d", minutes, rest);
    return text;
}

/// The text of a bar, without the carriage return in front.
/// \param name     What is being done.
/// \param part     How much of it is done, in [0, 1].
/// \param seconds  How long that took.
/// \return "render  [#####.....]  50 %  0:12 left".
[[nodiscard]] inline std::string bar_text(const std::string& name, double part,
                                          double seconds) {
    const int width = 30;
    const int full = static_cast<int>(part * width);
    std::string text = name + "  [" + std::string(static_cast<std::size_t>(full), '#') +
                       std::string(static_cast<std::size_t>(width - full), '.') + "] ";
    const std::string percent = std::to_string(static_cast<int>(100.0 * part));
    text +=
        std::string(4 - std::min<std::size_t>(percent.size(), 4), ' ') + percent + " %";
    // The first tenth of a second says nothing about the rest.
    if (seconds > 0.1 && part > 0.0)
        text += "  " + duration_text(seconds * (1.0 - part) / part) + " left";
    return text;
}

/// Shows the progress of a loop, and stops it on Ctrl-C.
///
///     ProgressBar bar("render", options.quiet);
///     render(scene, camera, {.progress = bar});
///
/// It is the callable that the loops of Ljus report to; it draws ten times a second,
/// and nothing at all if told to be quiet or if stderr is not a terminal. It wipes the
/// line when it goes.
class ProgressBar {
public:
    /// \param name   What is being done, in a word or two.
    /// \param quiet  Draw nothing; Ctrl-C still stops the loop.
    explicit ProgressBar(std::string name, bool quiet = false)
        : name_(std::move(name)), draws_(!quiet && is_terminal(stderr)) {}
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar() { wipe(); }

    /// \param done   Blocks done.
    /// \param total  All blocks.
    /// \return Whether to go on: false after Ctrl-C.
    bool operator()(long long done, long long total) {
        if (draws_ && total > 0)
            draw(static_cast<double>(done) / static_cast<double>(total));
        return stop_signal() == 0;
    }

private:
    void draw(double part) {
        const double now = watch_.seconds();
        if (now - drawn_at_ < 0.1) return;
        drawn_at_ = now;
        std::string text = bar_text(name_, part, now);
        const std::size_t length = text.size();
        // Blanks over what a longer text has left behind.
        if (length < drawn_length_) text.append(drawn_length_ - length, ' ');
        drawn_length_ = length;
        std::fprintf(stderr, "\r%s", text.c_str());
        std::fflush(stderr);
    }

    void wipe() {
        if (drawn_length_ == 0) return;
        std::fprintf(stderr, "\r%s\r", std::string(drawn_length_, ' ').c_str());
        std::fflush(stderr);
    }

    std::string name_;
    bool draws_;
    StopWatch watch_;
    double drawn_at_ = 0.0;
    std::size_t drawn_length_ = 0;
};

} // namespace examples
