#pragma once

/// \file examples/common/terminal.hpp
/// \brief A progress bar with the remaining time, on stderr if that is a terminal.

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

/// Whether a stream is a terminal.
[[nodiscard]] inline bool is_terminal(std::FILE* stream) {
#ifdef _WIN32
    return ::_isatty(::_fileno(stream)) != 0;
#else
    return ::isatty(::fileno(stream)) != 0;
#endif
}

/// A duration as text.
/// \param seconds  The duration, at least 0.
/// \return A text such as "0:07", "12:34" or "3:07:00"; "?" for NaN, or from 100 hours
///         on.
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

/// The text of a progress bar.
/// \param name     The name of the work.
/// \param part     The part that is done, in [0, 1].
/// \param seconds  The time that this part took.
/// \return A text such as "render [#####.....] 50 % 0:12 left".
[[nodiscard]] inline std::string bar_text(const std::string& name, double part,
                                          double seconds) {
    const int width = 30;
    const int full = static_cast<int>(part * width);
    std::string text = name + "  [" + std::string(static_cast<std::size_t>(full), '#') +
                       std::string(static_cast<std::size_t>(width - full), '.') + "] ";
    const std::string percent = std::to_string(static_cast<int>(100.0 * part));
    text +=
        std::string(4 - std::min<std::size_t>(percent.size(), 4), ' ') + percent + " %";
    // From less than a tenth of a second the remaining time cannot be predicted.
    if (seconds > 0.1 && part > 0.0)
        text += "  " + duration_text(seconds * (1.0 - part) / part) + " left";
    return text;
}

/// Shows the progress of a loop, and stops it on Ctrl-C.
///
///     ProgressBar bar("render", options.quiet);
///     render(scene, camera, {.progress = bar});
///
/// The loops of Ljus call the bar to report progress. The bar is drawn at most ten
/// times a second, and not at all if it is quiet or if stderr is not a terminal. The
/// destructor erases the bar.
class ProgressBar {
public:
    /// \param name   The name of the work, in a word or two.
    /// \param quiet  Whether to draw nothing. Ctrl-C still stops the loop.
    explicit ProgressBar(std::string name, bool quiet = false)
        : name_(std::move(name)), draws_(!quiet && is_terminal(stderr)) {}
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar() { wipe(); }

    /// \param done   The number of blocks that are done.
    /// \param total  The number of all blocks.
    /// \return Whether to continue: false after Ctrl-C.
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
        // Blanks erase the end of a longer earlier text.
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
