#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "ljus/parallel.hpp"
#include "scratch_folder.hpp"

#if __has_include(<nlohmann/json.hpp>)
#define HAS_SLICES
#include "common/picture_slice.hpp"
#include "support/refusal.hpp"
#endif

namespace {

using ljus::FunctionRef;
using ljus::Progress;

struct Counter {
    int calls = 0;
    int operator()(int step) { return calls += step; }
};
struct Always {
    bool operator()(long long, long long) const { return true; }
};
// With a name, constant or not; no temporary, and nothing that cannot be called so.
static_assert(std::is_convertible_v<Always&, Progress>);
static_assert(std::is_convertible_v<const Always&, Progress>);
static_assert(!std::is_constructible_v<Progress, Always>);
static_assert(!std::is_constructible_v<Progress, const Always>);
static_assert(!std::is_constructible_v<Progress, Counter&>);
static_assert(!std::is_default_constructible_v<Progress>);
static_assert(std::is_trivially_copyable_v<Progress>);

/// The sum of `body(block)` over all blocks, added in the order of the blocks.
template <typename Body>
auto sum_of_blocks(long long count, Body&& body, int threads = 0) {
    using R = std::invoke_result_t<Body&, long long>;
    std::vector<R> sums(static_cast<std::size_t>(count));
    ljus::parallel_blocks(
        count,
        [&](long long block) { sums[static_cast<std::size_t>(block)] = body(block); },
        {.threads = threads});
    R sum{};
    for (const R& block_sum : sums) sum = sum + block_sum;
    return sum;
}

/// Waits until a condition holds, but not for ever.
template <typename Condition>
void wait_for(Condition holds, int seconds = 5) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
    while (!holds() && std::chrono::steady_clock::now() < end)
        std::this_thread::yield();
}

// Some work whose result depends on every step.
double work(long long seed, int steps) {
    double x = static_cast<double>(seed) + 0.5;
    for (int i = 0; i < steps; ++i) x = std::sin(x) + 1e-3 * x;
    return x;
}

double seconds_of(int threads, int blocks, int steps) {
    std::vector<double> results(static_cast<std::size_t>(blocks));
    const auto start = std::chrono::steady_clock::now();
    ljus::parallel_blocks(
        blocks,
        [&](long long b) { results[static_cast<std::size_t>(b)] = work(b, steps); },
        {.threads = threads});
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    return time.count();
}

} // namespace

TEST_CASE("parallel: every block runs once, for any number of threads and blocks") {
    for (const int threads : {0, 1, 2, 3, 4, 7, 16, 64})
        for (const long long count : {0LL, 1LL, 2LL, 3LL, 63LL, 1000LL}) {
            std::vector<std::atomic<int>> runs(static_cast<std::size_t>(count));
            const bool finished = ljus::parallel_blocks(
                count, [&](long long b) { ++runs[static_cast<std::size_t>(b)]; },
                {.threads = threads});
            CHECK(finished);
            int wrong = 0;
            for (const auto& n : runs) wrong += n != 1;
            CHECK(wrong == 0);
        }
    // Blocks so short that two threads often ask for the next one at once.
    for (const int threads : {2, 3}) {
        std::vector<std::atomic<int>> runs(30000);
        CHECK(ljus::parallel_blocks(
            30000, [&](long long b) { ++runs[static_cast<std::size_t>(b)]; },
            {.threads = threads}));
        int wrong = 0;
        for (const auto& n : runs) wrong += n != 1;
        CHECK(wrong == 0);
    }
    int calls = 0;
    CHECK(ljus::parallel_blocks(-5, [&](long long) { ++calls; }));
    CHECK(calls == 0);
}

TEST_CASE("parallel: a sum has the same bits for 1 to 64 threads") {
    const auto sum = [](int threads) {
        return sum_of_blocks(
            1000, [](long long b) { return 1.0 / (static_cast<double>(b) + 0.1); },
            threads);
    };
    double in_order = 0.0;
    for (int b = 0; b < 1000; ++b) in_order += 1.0 / (b + 0.1);
    for (const int threads : {0, 1, 2, 3, 4, 5, 8, 64}) CHECK(sum(threads) == in_order);
    CHECK(sum_of_blocks(0, [](long long) { return 1.0; }) == 0.0);
    CHECK(sum_of_blocks(1, [](long long) { return 7; }) == 7);
    CHECK(sum_of_blocks(3, [](long long b) { return std::string(1, char('a' + b)); }) ==
          "abc");
}

#ifdef _OPENMP
TEST_CASE("parallel: more than one thread works at a time") {
    // The first block waits for the second, which another thread must run.
    std::atomic<bool> second{false};
    std::atomic<bool> met{false};
    ljus::parallel_blocks(2,
                          [&](long long b) {
                              if (b == 1) {
                                  second = true;
                                  return;
                              }
                              wait_for([&] { return second.load(); }, 20);
                              met = second.load();
                          },
                          {.threads = 2});
    CHECK(met);
}
#endif

TEST_CASE("parallel: a reference to a function calls what it refers to") {
    Counter counter;
    const FunctionRef<int(int)> call = counter;
    const FunctionRef<int(int)> copy = call; // of the counter, and not of the reference
    CHECK(call(2) == 2);
    CHECK(copy(3) == 5);
    CHECK(counter.calls == 5);
    const auto add = [](int& sum, int x) { sum += x; };
    const FunctionRef<void(int&, int)> to = add;
    int sum = 1;
    to(sum, 6);
    CHECK(sum == 7);
    CHECK(ljus::no_progress(1, 2));
}

TEST_CASE("parallel: progress is told by one thread at a time, ascending, to the end") {
    for (const int threads : {1, 2, 4, 16}) {
        std::atomic<int> inside{0};
        int overlaps = 0, wrong_totals = 0, descents = 0, ends = 0;
        long long last = 0;
        auto progress = [&](long long done, long long total) {
            overlaps += ++inside != 1;
            wrong_totals += total != 500;
            descents += done <= last;
            ends += done == total;
            last = done;
            --inside;
            return true;
        };
        CHECK(ljus::parallel_blocks(500, [](long long b) { (void)work(b, 100); },
                                    {.threads = threads, .progress = progress}));
        CHECK(overlaps == 0);
        CHECK(wrong_totals == 0);
        CHECK(descents == 0);
        CHECK(ends == 1);
        CHECK(last == 500);
    }
}

#ifdef _OPENMP
TEST_CASE("parallel: while one thread tells, the others work and do not tell") {
    // The first to tell stays in progress() until nine more blocks are done: whoever
    // finishes one meanwhile has something to tell, and must not.
    std::atomic<int> inside{0}, overlaps{0}, done_blocks{0};
    auto progress = [&](long long done, long long) {
        if (++inside != 1) ++overlaps;
        wait_for([&] { return done >= 3 || done_blocks >= 10; });
        --inside;
        return true;
    };
    CHECK(ljus::parallel_blocks(12, [&](long long) { ++done_blocks; },
                                {.threads = 2, .progress = progress}));
    CHECK(overlaps == 0);
    CHECK(done_blocks == 12);
}

TEST_CASE("parallel: whoever said stop is not asked again") {
    // Block 1 ends after block 0 was told of, and that told to stop.
    std::atomic<bool> begun{false}, told{false};
    std::atomic<int> calls{0}, runs{0};
    auto progress = [&](long long, long long) {
        ++calls;
        return false;
    };
    const auto body = [&](long long b) {
        ++runs;
        if (b == 0) wait_for([&] { return begun.load(); });
        if (b != 1) return;
        begun = true;
        wait_for([&] { return told.load(); });
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
    };
    auto tell = [&](long long done, long long total) {
        const bool go_on = progress(done, total);
        told = true;
        return go_on;
    };
    CHECK_FALSE(ljus::parallel_blocks(1000, body, {.threads = 2, .progress = tell}));
    CHECK(runs == 2);
    CHECK(calls == 1);
}

TEST_CASE("parallel: what ended while another thread was telling is told at the end") {
    // Block 0 is told of until block 1 has ended and found that somebody tells.
    std::atomic<bool> telling{false}, ended{false};
    std::vector<long long> heard;
    auto progress = [&](long long done, long long) {
        heard.push_back(done);
        if (done == 2) return true;
        telling = true;
        wait_for([&] { return ended.load(); });
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        return true;
    };
    const auto body = [&](long long b) {
        if (b == 0) return;
        wait_for([&] { return telling.load(); });
        ended = true;
    };
    CHECK(ljus::parallel_blocks(2, body, {.threads = 2, .progress = progress}));
    CHECK(heard == std::vector<long long>{1, 2});
}

TEST_CASE("parallel: 0 threads are all that there are") {
    if (ljus::max_threads() < 2) return; // one processor, or asked for so
    std::atomic<int> begun{0};
    ljus::parallel_blocks(2, [&](long long) {
        ++begun;
        wait_for([&] { return begun >= 2; }, 20);
        CHECK(begun == 2); // both at a time
    });
}

TEST_CASE("parallel: what a block threw is not forgotten because progress goes on") {
    // Block 0 is told of while block 1 throws; then progress says "go on".
    std::atomic<int> runs{0};
    std::atomic<bool> thrown{false};
    std::atomic<bool> telling{false};
    auto progress = [&](long long, long long) {
        telling = true;
        wait_for([&] { return thrown.load(); });
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        return true;
    };
    CHECK_THROWS_AS(ljus::parallel_blocks(1000,
                                          [&](long long b) {
                                              ++runs;
                                              if (b != 1) return;
                                              wait_for([&] { return telling.load(); });
                                              thrown = true;
                                              throw std::runtime_error("block 1");
                                          },
                                          {.threads = 2, .progress = progress}),
                    std::runtime_error);
    CHECK(runs == 2);
}

TEST_CASE("parallel: of two exceptions the first block's, whichever was thrown first") {
    for (const long long late : {0LL, 1LL}) {
        std::atomic<int> here{0};
        std::atomic<bool> thrown{false};
        const auto body = [&](long long b) {
            ++here; // both have begun before any throws
            wait_for([&] { return here >= 2 && (b != late || thrown); });
            if (b == late) // the other one has been caught by then
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
            thrown = true;
            throw std::runtime_error("block " + std::to_string(b));
        };
        CHECK_THROWS_WITH_AS(ljus::parallel_blocks(2, body, {.threads = 2}), "block 0",
                             std::runtime_error);
    }
}

TEST_CASE("parallel: as many threads as were asked for, and no more than blocks") {
    // Each block waits for all the others, so that each has a thread of its own.
    for (const int threads : {1, 2, 3, 5}) {
        std::atomic<int> here{0};
        int most = 0;
        const auto meet = [&](long long) {
            const int now = ++here;
            wait_for([&] { return here >= threads; });
            if (now == threads) most = here;
        };
        CHECK(ljus::parallel_blocks(threads, meet, {.threads = threads}));
        CHECK(most == threads);

        std::atomic<int> inside{0}, crowd{0};
        const auto count = [&](long long) {
            const int now = ++inside;
            if (now > crowd) crowd = now;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            --inside;
        };
        CHECK(ljus::parallel_blocks(10 * threads, count, {.threads = threads}));
        CHECK(crowd <= threads);
    }
}
#endif

TEST_CASE("parallel: false at the very last block: all blocks ran all the same") {
    for (const int threads : {1, 2}) {
        auto progress = [](long long done, long long total) { return done < total; };
        CHECK(ljus::parallel_blocks(20, [](long long) {},
                                    {.threads = threads, .progress = progress}));
    }
}

TEST_CASE("parallel: false from progress stops the loop") {
    for (const int threads : {1, 2, 4}) {
        std::atomic<int> runs{0};
        int told = 0;
        auto progress = [&](long long done, long long) {
            ++told;
            return done < 10;
        };
        CHECK_FALSE(ljus::parallel_blocks(100000,
                                          [&](long long b) {
                                              ++runs;
                                              (void)work(b, 1000);
                                          },
                                          {.threads = threads, .progress = progress}));
        CHECK(runs >= 10);
        CHECK(runs < 50000);
        CHECK(told <= runs);
    }
}

TEST_CASE("parallel: with one thread, progress comes after every block") {
    std::vector<long long> told;
    auto progress = [&](long long done, long long total) {
        told.push_back(10 * done + total);
        return true;
    };
    ljus::parallel_blocks(3, [](long long) {}, {.threads = 1, .progress = progress});
    CHECK(told == std::vector<long long>{13, 23, 33});
    // Nothing to do is nothing to tell.
    ljus::parallel_blocks(0, [](long long) {}, {.threads = 1, .progress = progress});
    CHECK(told.size() == 3);
}

TEST_CASE("parallel: of all exceptions that of the first block comes out, once") {
    for (int repeat = 0; repeat < 20; ++repeat)
        for (const int threads : {1, 2, 4, 16}) {
            std::atomic<int> runs{0};
            std::string message;
            try {
                ljus::parallel_blocks(100000,
                                      [&](long long b) {
                                          ++runs;
                                          if (b >= 20)
                                              throw std::runtime_error(
                                                  "block " + std::to_string(b));
                                      },
                                      {.threads = threads});
            } catch (const std::runtime_error& error) {
                message = error.what();
            }
            CHECK(message == "block 20");
            CHECK(runs <= 20 + 16);
        }
}

TEST_CASE(
    "parallel: what progress throws comes out, and things that are no exception") {
    for (const int threads : {1, 4}) {
        auto progress = [](long long done, long long) -> bool {
            if (done > 3) throw 42;
            return true;
        };
        CHECK_THROWS_AS(
            ljus::parallel_blocks(1000, [](long long) {},
                                  {.threads = threads, .progress = progress}),
            int);
        CHECK_THROWS_AS(
            (void)sum_of_blocks(
                10, [](long long) -> double { throw std::bad_alloc(); }, threads),
            std::bad_alloc);
    }
    // The loop can be used again.
    CHECK(sum_of_blocks(
              4, [](long long b) { return b; }, 4) == 6);
}

TEST_CASE("parallel: a loop inside a loop") {
    std::vector<double> results(8);
    CHECK(ljus::parallel_blocks(
        8,
        [&](long long b) {
            results[static_cast<std::size_t>(b)] = sum_of_blocks(
                10, [b](long long i) { return static_cast<double>(10 * b + i); }, 4);
        },
        {.threads = 4}));
    for (int b = 0; b < 8; ++b)
        CHECK(results[static_cast<std::size_t>(b)] == 100.0 * b + 45.0);
}

TEST_CASE("parallel: a number of threads without sense is refused with its value") {
    CHECK_THROWS_WITH_AS(ljus::parallel_blocks(1, [](long long) {}, {.threads = -1}),
                         "the number of threads is -1; it must be within [0, 1024].",
                         std::invalid_argument);
    CHECK_THROWS_AS(ljus::parallel_blocks(1, [](long long) {}, {.threads = 1025}),
                    std::invalid_argument);
    CHECK(ljus::max_threads_allowed == 1024);
    CHECK(ljus::parallel_blocks(1, [](long long) {}, {.threads = 1024}));
    CHECK(ljus::max_threads() >= 1);
#ifdef _OPENMP
    const int before = omp_get_max_threads(); // what OMP_NUM_THREADS says
    omp_set_num_threads(5000);
    CHECK(ljus::max_threads() == 1024);
    omp_set_num_threads(7);
    CHECK(ljus::max_threads() == 7);
    omp_set_num_threads(before);
#endif
}

TEST_CASE("parallel: blocks cover all things, none twice") {
    for (const long long total : {0LL, 1LL, 9LL, 10LL, 11LL, 100LL})
        for (const long long size : {1LL, 3LL, 10LL, 1000LL}) {
            long long next = 0;
            for (long long b = 0; b < ljus::detail::block_count(total, size); ++b) {
                const ljus::detail::BlockRange range =
                    ljus::detail::block_range(b, size, total);
                CHECK(range.first == next);
                CHECK(range.last > range.first);
                CHECK(range.last - range.first <= size);
                next = range.last;
            }
            CHECK(next == total);
        }
    const long long most = std::numeric_limits<long long>::max();
    CHECK(ljus::detail::block_count(most, 2) == most / 2 + 1);
    CHECK(ljus::detail::block_range(0, most, most).last == most);
}

TEST_CASE("parallel: a loop over things is one over their blocks, with its options") {
    using ljus::detail::parallel_each;
    for (const int threads : {1, 3})
        for (const std::size_t total : {0u, 1u, 9u, 10u, 11u}) {
            std::vector<int> runs(total);
            std::vector<long long> told;
            const auto blocks = static_cast<long long>(total + 4) / 5;
            const auto tell = [&](long long done, long long of) {
                told.push_back(done);
                return of == blocks;
            };
            CAPTURE(total);
            CHECK(parallel_each(total, 5, [&](std::size_t i) { ++runs[i]; },
                                {.threads = threads, .progress = tell}));
            CHECK(std::count(runs.begin(), runs.end(), 1) ==
                  static_cast<std::ptrdiff_t>(total));
            CHECK((told.empty() ? 0 : told.back()) == blocks);
        }
    std::atomic<int> runs{0};
    const auto stop = [](long long done, long long) { return done < 2; };
    CHECK_FALSE(parallel_each(20, 3, [&](std::size_t) { ++runs; },
                              {.threads = 1, .progress = stop}));
    CHECK(runs == 6);
    CHECK_THROWS_AS(parallel_each(20, 3, [](std::size_t) {}, {.threads = -1}),
                    std::invalid_argument);
}

#ifdef HAS_SLICES
// Files with the right checksum that say what no renderer says.
TEST_CASE(
    "parallel: a slice that promises too much is refused before memory is taken") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.slice");
    const auto said = [&](const examples::PictureSlice& slice) -> std::string {
        examples::save_slice(path, slice);
        return ljus_test::refusal<std::runtime_error>(
            [&] { (void)examples::merge_slices({path}); }, "merged");
    };
    examples::PictureSlice slice{.slice = {1, 1}, .width = 2, .height = 1};
    slice.settings = R"({"scene": "a", "light": {"pairs": [[1, 2]]}})";
    slice.pixels.assign(2, ljus::RgbT<double>(1));
    CHECK(said(slice) == "merged");
    const std::string refused =
        "cannot read '" + path + "': its settings are not those of a slice.";
    auto other = slice;
    for (const std::string settings : {"", "no JSON", "[1]", "1"}) {
        other.settings = settings;
        CHECK(said(other) == refused);
    }
    // Whoever writes these again overflows the stack.
    other.settings =
        "{\"a\": " + std::string(300'000, '[') + std::string(300'000, ']') + "}";
    CHECK(said(other) == refused);
    other = slice;
    other.exposure = std::numeric_limits<double>::quiet_NaN();
    CHECK(said(other) == refused);
    // No rows of a picture of 6 gigabytes.
    other = slice;
    other.slice.count = 65536;
    other.width = other.height = 16384;
    other.pixels.clear();
    const auto before = std::chrono::steady_clock::now();
    CHECK(said(other).find("of 65536 slices 65535 are missing: 2/65536,") == 0);
    const std::chrono::duration<double> seconds =
        std::chrono::steady_clock::now() - before;
    CHECK(seconds.count() < 5); // it was 15 when the picture was made first
}
#endif

// What a loop costs depends on what else the machine does: shown, not required.
TEST_CASE("parallel: two threads on a job of 0.1 s (information)") {
    (void)seconds_of(2, 2, 10); // the threads are made once
    double one = 1e9, two = 1e9, empty = 1e9;
    for (int repeat = 0; repeat < 5; ++repeat) {
        one = std::min(one, seconds_of(1, 100, 50000));
        two = std::min(two, seconds_of(2, 100, 50000));
        empty = std::min(empty, seconds_of(2, 2, 0));
    }
    MESSAGE("one thread " << one << " s, two " << two << " s: " << one / two
                          << " times as fast; a loop that does nothing takes "
                          << 1e6 * empty << " us");
}
