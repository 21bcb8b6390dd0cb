#pragma once

/// \file examples/common/clock.hpp
/// \brief How long things take.

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

namespace examples {

/// A stop watch that runs from its birth.
class StopWatch {
public:
    /// Seconds on the wall since the birth or the last restart().
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(Clock::now() - start_).count();
    }

    /// Starts from 0 again.
    void restart() { start_ = Clock::now(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Seconds that the processors have worked for this program, all threads together: what
/// the work costs, also on a machine that has other things to do.
[[nodiscard]] inline double processor_seconds() {
    return double(std::clock()) / double(CLOCKS_PER_SEC);
}

/// How long some work took.
struct Timing {
    double wall = 0; ///< Seconds on the wall.
    double work = 0; ///< Seconds of all processors.
};

/// Does some work.
/// \param work  Called once, without arguments.
/// \return How long it took.
template <typename Work>
[[nodiscard]] Timing timed(Work&& work) {
    const StopWatch watch;
    const double before = processor_seconds();
    work();
    return {watch.seconds(), processor_seconds() - before};
}

/// Nanoseconds of one call, the best of some runs: whatever else a machine does only
/// adds to them.
/// \param calls  How many calls one run of `work` makes.
/// \param work   Called once a run; returns a number that depends on all that it has
///               computed, so that nothing is optimised away.
/// \param runs   How many.
/// \return Nanoseconds on the wall, the loop around the call included.
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
