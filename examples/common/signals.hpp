#pragma once

/// \file examples/common/signals.hpp
/// \brief Ctrl-C asks a program to stop; it does so between two blocks of work, or else
/// two seconds later, wherever it is: files are whole or not there at any moment. A
/// pipe that nobody reads any more ends no work.

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <string>

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace examples {

/// Thrown by a program that has been asked to stop, after it has put things in order.
struct Interrupted {};

// Read by all threads, written by the handler: an atomic that needs no lock may be
// both.
inline std::atomic<int> asked_to_stop{0};
static_assert(std::atomic<int>::is_always_lock_free);

// What is said then. The handler may come at any moment: the text that it reads is not
// the one that is being written.
inline std::array<std::array<char, 1000>, 2> last_words{};
inline std::atomic<std::size_t> last_words_now{0};

[[nodiscard]] inline const char* last_words_text() {
    return last_words[last_words_now].data();
}

#ifdef SIGALRM
extern "C" inline void stop_now(int) {
    for (const char* text : {"stopped", last_words_text(), ".\n"})
        if (::write(2, text, std::strlen(text)) < 0) break;
    ::_exit(128 + asked_to_stop);
}
#endif

extern "C" inline void ask_to_stop(int signal) {
    asked_to_stop = signal;
    std::signal(signal, SIG_DFL); // the second time it ends the program at once
#ifdef SIGALRM
    std::signal(SIGALRM, stop_now);
    ::alarm(2);
#endif
}

// The signal, once a text has been written into a pipe that nobody reads.
inline std::atomic<int> broken_pipe{0};
extern "C" inline void note_broken_pipe(int signal) {
    broken_pipe = signal;
}

// Handles a signal, unless whoever has started the program wants it to be ignored, as
// nohup does.
inline void handle(int signal, void (*handler)(int)) {
    if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
}

// No longer: the program has ended by itself.
inline void let_be() {
#ifdef SIGALRM
    ::alarm(0);
#endif
}

/// What a program says when it is stopped: what is saved, and how to go on.
/// \param sentence  Without a full stop.
inline void when_stopped_say(const std::string& sentence) {
    const std::size_t next = 1 - last_words_now;
    auto& text = last_words[next];
    const std::string all = ": " + sentence;
    text[all.copy(text.data(), text.size() - 1)] = '\0';
    last_words_now = next;
}

/// Lets Ctrl-C, SIGTERM and the end of a terminal ask for a stop, and makes what can go
/// wrong in writing (a limit of size, a broken pipe) an error instead of the end of the
/// program.
inline void handle_signals() {
    let_be();
    asked_to_stop = 0;
    broken_pipe = 0;
    handle(SIGINT, ask_to_stop);
    handle(SIGTERM, ask_to_stop);
#ifdef SIGALRM
    handle(SIGHUP, ask_to_stop);
    handle(SIGPIPE, note_broken_pipe);
    std::signal(SIGXFSZ, SIG_IGN);
#endif
}

/// The signal that asked for a stop, or 0.
[[nodiscard]] inline int stop_signal() {
    return asked_to_stop;
}

/// \throws Interrupted  if the program has been asked to stop.
inline void stop_if_asked() {
    if (stop_signal() != 0) throw Interrupted{};
}

} // namespace examples
