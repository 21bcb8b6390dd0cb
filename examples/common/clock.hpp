#pragma once

/// \file examples/common/clock.hpp
/// \brief Measures how long work takes.

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

namespace examples {

/// A stop watch that starts when it is made.
class StopWatch {
public:
    /// Wall-clock seconds since the stop watch was made or last restarted.
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(Clock::now() - start_).count();
    }

    /// Starts from 0 again.
    void restart() { start_ = Clock::now(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Processor seconds of this program, summed over all threads. This measures the work
/// of the program even if the machine is busy with other programs.
[[nodiscard]] inline double processor_seconds() {
    return double(std::clock()) / double(CLOCKS_PER_SEC);
}

/// The time that some work took.
struct Timing {
    double wall = 0; ///< Wall-clock seconds.
    double work = 0; ///< Processor seconds, summed over all threads.
};

/// Measures how long some work takes.
/// \param work  Called once, without arguments.
/// \return The time of the call.
template <typename Work>
[[nodiscard]] Timing timed(Work&& work) {
    const StopWatch watch;
    const double before = processor_seconds();
    work();
    return {watch.seconds(), processor_seconds() - before};
}

/// The time of one call in nanoseconds. The least of several runs is taken, because
/// other work on the machine can only add time.
/// \param calls  The number of calls that one run of `work` makes.
/// \param work   Called once per run; returns a number that depends on all results, so
///               that the compiler removes no part of the work.
/// \param runs   The number of runs.
/// \return Wall-clock nanoseconds, including the loop around the call.
template <typename Work>
[[nodiscard]] double nanoseconds_a_call(double calls, Work&& work, int runs = 21) {
    double best = std::numeric_limits<double>::infinity();
    volatile double keep = 0;
    for (int run = 0; run < runs; ++run) {
        const StopWatch watch;
        const auto sum = work();
        best = std::min(best, watch.seconds() * 1e9 / calls);
        keep = keep + double(sum);
    }
    return best;
}

} // namespace examples
