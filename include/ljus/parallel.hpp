#pragma once

/// \file ljus/parallel.hpp
/// \brief Loops over blocks by several threads: the one place that knows OpenMP.

#include <concepts>
#include <cstddef>
#include <exception>

#include "ljus/function_ref.hpp"
#include "ljus/math/require.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace ljus {

/// \defgroup parallel Parallel loops
/// \brief The same answer, byte by byte, whatever the number of threads.
///
/// Work is cut into blocks that do not depend on the number of threads; a block writes
/// what no other block writes; sums are formed block by block and added in the order of
/// the blocks. Compiled without OpenMP, the blocks run one after the other.
/// \{

/// The largest number of threads that one may ask for.
inline constexpr int max_threads_allowed = 1024;

/// What a long loop reports to, and is stopped by: anything with a name that can be
/// called as `bool progress(long long done, long long total)`; false stops the loop.
///
///     auto progress = [&](long long done, long long total) { return !stopped; };
///     parallel_blocks(count, body, {.progress = progress});
///
/// The callable must live as long as the loop: see FunctionRef.
using Progress = FunctionRef<bool(long long done, long long total)>;

namespace detail {

/// Nothing to report to, and no reason to stop.
struct NoProgress {
    /// \return True.
    constexpr bool operator()(long long, long long) const noexcept { return true; }
};

} // namespace detail

/// The progress of loops that report to nobody.
inline constexpr detail::NoProgress no_progress;

/// How a parallel loop runs.
struct ParallelSettings {
    int threads = 0; ///< 1 to max_threads_allowed; 0: one per processor.
    Progress progress = no_progress; ///< Called after a block, by one thread at a time.
};

namespace detail {

/// The number of threads that `threads = 0` stands for: that of the processors, or what
/// OMP_NUM_THREADS says, but no more than are allowed; 1 without OpenMP.
[[nodiscard]] inline int max_threads() noexcept {
#ifdef _OPENMP
    const int most = omp_get_max_threads();
    return most < max_threads_allowed ? most : max_threads_allowed;
#else
    return 1;
#endif
}

/// The number of blocks that cover `total` things.
/// \param total  At least 0.
/// \param size   Things in a block, at least 1; the last block may have fewer.
[[nodiscard]] constexpr long long block_count(long long total,
                                              long long size) noexcept {
    return total / size + (total % size != 0 ? 1 : 0);
}

/// The things of a block: first <= i < last.
struct BlockRange {
    long long first = 0; ///< The first one.
    long long last = 0;  ///< One past the last one.
};

/// The things of block number `block`.
/// \param block  In [0, block_count(total, size)).
/// \param size   Things in a block, at least 1.
/// \param total  All things.
[[nodiscard]] constexpr BlockRange block_range(long long block, long long size,
                                               long long total) noexcept {
    const long long first = block * size;
    return {first, total - first < size ? total : first + size};
}

// What is done with a block. The loop below is the same for all bodies, and not
// compiled again for each.
using BlockBody = FunctionRef<void(long long block)>;

// In blocks, by several threads; see parallel_blocks().
LJUS_CORE_INLINE bool run_blocks(long long count, BlockBody body,
                                 const ParallelSettings& options);

#ifndef LJUS_CORE // else it is there already

// What several threads change, they change in turn. OpenMP's lock comes without a
// further header; <atomic> would make each header here an eighth longer to compile.
// One thread alone asks nothing of OpenMP: LLVM's crashes in a forked process.
#ifdef _OPENMP
struct Mutex {
    const bool shared; // by more than one thread
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

// A thread's turn, from here to the end of the block.
struct LockGuard {
    Mutex& mutex;
    explicit LockGuard(Mutex& turns) noexcept : mutex(turns) { mutex.take(); }
    ~LockGuard() { mutex.give(); }
    LockGuard(const LockGuard&) = delete;
    LockGuard& operator=(const LockGuard&) = delete;
};

// One loop over blocks: what its threads do, and what they change in turn.
struct BlockLoop {
    const long long count;
    const BlockBody body;
    const Progress& progress;

    Mutex turns;
    long long next = 0;             // the block to begin next
    long long done = 0;             // blocks that have run to their end
    bool stop = false;              // no further block shall begin
    bool stopped = false;           // progress said so
    bool reporting = false;         // a thread is in progress()
    long long reported = 0;         // what progress heard last
    long long failed_block = count; // the first block, in order, that threw
    std::exception_ptr failure{};   // what it threw

    // What each thread does.
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

    // Tells of what is done, unless another thread is telling; the others work on.
    void report() {
        long long now = 0;
        {
            const LockGuard turn(turns);
            if (reporting || stopped || done <= reported) return;
            reporting = true;
            now = reported = done;
        }
        const bool go_on = progress(now, count);
        const LockGuard turn(turns);
        reporting = false;
        stopped = !go_on;
        stop = stop || stopped;
    }

    // Keeps the exception that is being handled, if it is the first in order. Every
    // block before this one has begun and runs to its end, so that the first one that
    // throws is the same for any number of threads.
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
        // At the end of the region all wait for the last. libgomp's threads do so by
        // spinning for milliseconds, and if another program has the processor of the
        // last one they keep it from theirs: a loop of one millisecond took twenty.
        // More threads than processors go to sleep at once, which is what we want; so
        // there is one more, which does nothing.
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

/// Calls `body(block)` once for each block in [0, count), by several threads.
///
/// Blocks are handed out in order, one at a time, to whichever thread is free: small
/// enough, they keep all threads busy to the end; a loop can be stopped between blocks
/// only, so they should take well below a second. A loop inside a body runs on the
/// thread that it is called from.
/// \param count    The number of blocks; none if it is 0 or less.
/// \param body     Called as body(long long); calls run at the same time, in any order.
/// \param options  Threads and progress. `progress(done, total)` comes after a block
///                 unless another thread is reporting, with ascending `done`; when all
///                 blocks are done, (count, count) has been reported once.
/// \return Whether all blocks ran: false when `progress` stopped the loop.
/// \throws std::invalid_argument  for a number of threads that is not allowed; and what
///         a body or `progress` threw: no further block is then begun, and of several
///         exceptions that of the first block in order is thrown, always the same one.
/// \cost Some 30 microseconds to wake the threads (more the first time), below 0.1 a
///       block.
template <std::invocable<long long> Body>
bool parallel_blocks(long long count, Body&& body,
                     const ParallelSettings& options = {}) {
    return detail::run_blocks(count, body, options);
}

namespace detail {

/// Calls `body(i)` once for each i in [0, total), in blocks, by several threads.
/// \param total    How many calls.
/// \param block    Calls in a block, at least 1.
/// \param body     Called as body(std::size_t); what it writes, no other call writes.
/// \param options  As for parallel_blocks().
/// \return As parallel_blocks().
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
