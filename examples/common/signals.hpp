#pragma once

/// \file examples/common/signals.hpp
/// \brief Ctrl-C asks a program to stop; it does so between two blocks of work, or else
/// two seconds later, wherever it is: files are whole or not there at any moment.

#include <atomic>
#include <csignal>

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace examples {

/// Thrown by a program that has been asked to stop, after it has put things in order.
struct Interrupted {};

namespace detail {

// Read by all threads, written by the handler: an atomic that needs no lock may be
// both.
inline std::atomic<int> asked_to_stop{0};
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" inline void ask_to_stop(int signal) {
    asked_to_stop = signal;
    std::signal(signal, SIG_DFL); // the second time it ends the program at once
#ifdef SIGALRM
    ::alarm(2);
#endif
}

#ifdef SIGALRM
extern "C" inline void stop_now(int) {
    ::_exit(128 + asked_to_stop);
}
#endif

// No longer: the program has ended by itself.
inline void let_be() {
#ifdef SIGALRM
    ::alarm(0);
#endif
}

} // namespace detail

/// Lets Ctrl-C (and SIGTERM) ask for a stop, and a file-size limit be an error when
/// writing (SIGXFSZ) instead of the end of the program.
inline void handle_signals() {
    detail::let_be();
    detail::asked_to_stop = 0;
#ifdef SIGALRM
    std::signal(SIGALRM, detail::stop_now);
#endif
    std::signal(SIGINT, detail::ask_to_stop);
    std::signal(SIGTERM, detail::ask_to_stop);
#ifdef SIGXFSZ
    std::signal(SIGXFSZ, SIG_IGN);
#endif
}

/// The signal that asked for a stop, or 0.
[[nodiscard]] inline int stop_signal() {
    return detail::asked_to_stop;
}

/// \throws Interrupted  if the program has been asked to stop.
inline void stop_if_asked() {
    if (stop_signal() != 0) throw Interrupted{};
}

} // namespace examples
