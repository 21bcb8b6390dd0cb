#pragma once

/// \file ljus/parallel.hpp
/// \brief Parallel loops over blocks; the only header that uses OpenMP.

#include <concepts>
#include <cstddef>
#include <exception>

#include "ljus/math/require.hpp"
#include "ljus/ref.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace ljus {

/// \defgroup parallel Parallel loops
/// \brief Loops with the same result, byte by byte, on any number of threads.
///
/// A loop is divided into blocks, in the same way for any number of threads. A block
/// writes only its own results. The sums of the blocks are added in the order of the
/// blocks. Without OpenMP the blocks run one after the other.
/// \{

/// The largest number of threads that may be requested.
inline constexpr int max_threads_allowed = 1024;

/// The callback of a long loop: a callable that must outlive the loop; see FunctionRef.
/// It receives how many parts of the work are done, and how many there are in total.
/// The loop stops if the callback returns false.
///
///     auto progress = [&](long long done, long long total) { return !stopped; };
///     parallel_blocks(count, body, {.progress = progress});
using Progress = FunctionRef<bool(long long done, long long total)>;

/// The default callback. It does nothing and never stops the loop.
inline constexpr auto no_progress = [](long long, long long) noexcept { return true; };

/// The settings of a parallel loop.
struct ParallelSettings {
    int threads = 0; ///< At most max_threads_allowed; 0 stands for max_threads().
    Progress progress = no_progress; ///< Called after blocks, by one thread at a time.
};

/// The number of threads that `threads = 0` stands for: the value of the environment
/// variable OMP_NUM_THREADS or, if that is not set, the number of processors; at most
/// max_threads_allowed. Without OpenMP it is 1.
[[nodiscard]] inline int max_threads() noexcept {
#ifdef _OPENMP
    const int most = omp_get_max_threads();
    return most < max_threads_allowed ? most : max_threads_allowed;
#else
    return 1;
#endif
}

namespace detail {

/// The number of blocks of `size` items that cover `total` items.
[[nodiscard]] constexpr long long block_count(long long total,
                                              long long size) noexcept {
    return total / size + (total % size != 0 ? 1 : 0);
}

/// The items i of a block, with first <= i < last.
struct BlockRange {
    long long first = 0, last = 0;
};

/// The items of a block, whose number is below block_count(total, size).
[[nodiscard]] constexpr BlockRange block_range(long long block, long long size,
                                               long long total) noexcept {
    const long long first = block * size;
    return {first, total - first < size ? total : first + size};
}

using BlockBody = FunctionRef<void(long long block)>;

// Implements parallel_blocks().
LJUS_CORE_INLINE bool run_blocks(long long count, BlockBody body,
                                 const ParallelSettings& options);

#ifndef LJUS_CORE // otherwise defined in ljus::core

// A lock. OpenMP's own lock needs no further header, whereas <atomic> would make each
// header that includes this one an eighth slower to compile. A single thread does not
// call OpenMP, because LLVM's OpenMP runtime crashes in a forked process.
#ifdef _OPENMP
struct Mutex {
    const bool shared; // whether several threads use the lock
    omp_lock_t lock{};
    explicit Mutex(bool many) noexcept : shared(many) {
        if (shared) omp_init_lock(&lock);
    }
    ~Mutex() {
        if (shared) omp_destroy_lock(&lock);
    }
    Mutex(const Mutex&) = delete;
    Mutex& operator=(const Mutex&) = delete;
    void take() noexcept {
        if (shared) omp_set_lock(&lock);
    }
    void give() noexcept {
        if (shared) omp_unset_lock(&lock);
    }
};
#else
struct Mutex {
    explicit Mutex(bool) noexcept {}
    void take() noexcept {}
    void give() noexcept {}
};
#endif

// Holds a Mutex until the end of the scope.
struct LockGuard {
    Mutex& mutex;
    explicit LockGuard(Mutex& turns) noexcept : mutex(turns) { mutex.take(); }
    ~LockGuard() { mutex.give(); }
    LockGuard(const LockGuard&) = delete;
    LockGuard& operator=(const LockGuard&) = delete;
};

// The state of one loop over blocks.
struct BlockLoop {
    const long long count;
    const BlockBody body;
    const Progress& progress;

    Mutex turns;
    long long next = 0;             // the next block to begin
    long long done = 0;             // the number of completed blocks
    bool stop = false;              // no further block may begin
    bool reporting = false;         // a thread is in progress()
    long long reported = 0;         // the last `done` that progress received
    long long failed_block = count; // the lowest block that threw
    std::exception_ptr failure{};   // the exception of failed_block

    // Runs on each thread.
    void work() {
        // [next block]
        for (;;) {
            long long block = 0;
            {
                const LockGuard turn(turns);
                if (stop || next >= count) return;
                block = next++;
            }
            try {
                body(block);
                {
                    const LockGuard turn(turns);
                    ++done;
                }
                report();
                // [next block]
            } catch (...) {
                fail(block);
            }
        }
    }

    // Reports the progress, unless another thread is reporting. No thread waits.
    void report() {
        long long now = 0;
        {
            const LockGuard turn(turns);
            if (reporting || stop || done <= reported) return;
            reporting = true;
            now = reported = done;
        }
        const bool go_on = progress(now, count);
        const LockGuard turn(turns);
        reporting = false;
        stop = stop || !go_on;
    }

    // Keeps the current exception if its block is the lowest that threw. Blocks begin
    // in ascending order, and each block that has begun runs to its end. The lowest
    // block that throws is therefore the same for any number of threads.
    void fail(long long block) {
        const LockGuard turn(turns);
        stop = true;
        if (block < failed_block) {
            failed_block = block;
            failure = std::current_exception();
        }
    }
};

LJUS_CORE_INLINE bool run_blocks(long long count, BlockBody body,
                                 const ParallelSettings& options) {
    static_assert(max_threads_allowed == 1024, "the sentence below says so");
    require(options.threads >= 0 && options.threads <= max_threads_allowed,
            "the number of threads", static_cast<long long>(options.threads),
            "within [0, 1024]");

    const long long wanted = options.threads == 0 ? max_threads() : options.threads;
    const int threads = static_cast<int>(wanted < count ? wanted : count);
    BlockLoop loop{count, body, options.progress, Mutex(threads > 1)};
#ifdef _OPENMP
    if (threads > 1) {
        // At the end of a parallel region, libgomp's threads wait for the last one by
        // spinning for milliseconds. If another program occupies the processor of the
        // last thread, that thread cannot move to a spinning thread's processor, and a
        // loop of one millisecond takes twenty. Threads sleep at once if there are more
        // of them than processors. The loop therefore adds one idle thread.
        const int idle = threads == omp_get_num_procs() ? 1 : 0;
#pragma omp parallel num_threads(threads + idle)
        if (omp_get_thread_num() < threads) loop.work();
    } else {
        loop.work();
    }
#else
    loop.work();
#endif

    if (loop.failure) std::rethrow_exception(loop.failure);
    loop.report(); // the last blocks may have ended while another thread was reporting
    return loop.done >= count;
}

#endif

} // namespace detail

/// Calls `body(block)` once for each block in [0, count), on several threads.
///
/// Each free thread takes the next block. Small blocks keep all threads busy to the
/// end. A loop can stop only between blocks, so a block should take well below a
/// second. A loop inside a body runs on the thread that calls it.
/// \param count    The number of blocks. If it is 0 or negative, there are none.
/// \param body     Called as body(long long), concurrently and in any order.
/// \param options  The number of threads and the callback. The callback is called after
///                 a block, unless another thread is calling it. `done` is larger in
///                 each call. When all blocks are done, (count, count) has been
///                 reported, unless an earlier call returned false.
/// \return True if all blocks ran; false if `progress` stopped the loop.
/// \throws std::invalid_argument  if `options.threads` is not within [0, 1024]. If a
///         body or `progress` throws, no further block begins, and the loop throws the
///         same exception. If several blocks throw, the loop throws the exception of
///         the block with the lowest number.
/// \cost About 30 microseconds to wake the threads, more the first time, and below 0.1
///       microseconds per block.
template <std::invocable<long long> Body>
bool parallel_blocks(long long count, Body&& body,
                     const ParallelSettings& options = {}) {
    return detail::run_blocks(count, body, options);
}

namespace detail {

/// Calls `body(i)` once for each i in [0, total), in blocks of `block` calls, on
/// several threads; see parallel_blocks(). No two calls may write the same data.
template <std::invocable<std::size_t> Body>
bool parallel_each(std::size_t total, long long block, Body&& body,
                   const ParallelSettings& options = {}) {
    const auto all = static_cast<long long>(total);
    const auto run = [&](long long number) {
        const BlockRange range = block_range(number, block, all);
        for (auto i = std::size_t(range.first); i < std::size_t(range.last); ++i)
            body(i);
    };
    return parallel_blocks(block_count(all, block), run, options);
}

} // namespace detail

/// \}

} // namespace ljus
