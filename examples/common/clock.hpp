#pragma once

/// \file examples/common/clock.hpp
/// \brief How long things take.

#include <chrono>
#include <ctime>

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

} // namespace examples
