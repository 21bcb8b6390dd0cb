#pragma once

/// \file examples/common/signals.hpp
/// \brief Lets Ctrl-C stop a program between two blocks of work, or at the latest after
/// two seconds. Files are never left incomplete. A broken pipe does not end the
/// program.

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <string>

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace examples {

/// Thrown by a program that stops because it was asked to.
struct Interrupted {};

// The signal that asked for a stop, or 0. The handler writes it, and all threads read
// it, which is allowed for an atomic without a lock.
inline std::atomic<int> asked_to_stop{0};
static_assert(std::atomic<int>::is_always_lock_free);

// The sentence that is printed when the program stops. There are two buffers, because
// the handler may run at any moment: it reads the one that is not being written.
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
    std::signal(signal, SIG_DFL); // a second Ctrl-C ends at once
#ifdef SIGALRM
    std::signal(SIGALRM, stop_now);
    ::alarm(2);
#endif
}

// The signal SIGPIPE if the program has written into a broken pipe, otherwise 0.
inline std::atomic<int> broken_pipe{0};
extern "C" inline void note_broken_pipe(int signal) {
    broken_pipe = signal;
}

// Installs a handler, unless the signal is ignored, as under nohup.
inline void handle(int signal, void (*handler)(int)) {
    if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
}

// Cancels the alarm when the program has ended by itself.
inline void let_be() {
#ifdef SIGALRM
    ::alarm(0);
#endif
}

/// Sets the sentence that a program prints when it is stopped: what is saved, and how
/// to resume.
/// \param sentence  The sentence, without a full stop.
inline void when_stopped_say(const std::string& sentence) {
    const std::size_t next = 1 - last_words_now;
    auto& text = last_words[next];
    const std::string all = ": " + sentence;
    text[all.copy(text.data(), text.size() - 1)] = '\0';
    last_words_now = next;
}

/// Installs handlers: Ctrl-C, SIGTERM and the closing of the terminal ask for a stop. A
/// file-size limit and a broken pipe become errors and do not end the program.
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
