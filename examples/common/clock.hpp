#pragma once

/// \file examples/common/clock.hpp
/// \brief How long things take.

#include <chrono>

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

} // namespace examples
