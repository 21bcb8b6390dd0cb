#pragma once

// Tests work that runs out of memory, in a process of its own.

#include <cstddef>
#include <exception>
#include <fstream>
#include <new>
#include <string>

// A program with a sanitizer cannot run under a limit of memory.
#ifdef __has_feature
#if __has_feature(thread_sanitizer) || __has_feature(address_sanitizer)
#define LJUS_TEST_SANITIZER
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define LJUS_TEST_SANITIZER
#endif
#if defined(__GLIBC__) && !defined(LJUS_TEST_SANITIZER)
#define LJUS_TEST_LITTLE_MEMORY
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ljus_test {

// Calls `work`, which returns whether its result is right, with little memory: `step`
// bytes more than the process has, then two steps more, and so on up to `most`, until
// it has succeeded twice.
// \return Empty if every call succeeded or threw std::bad_alloc, and both happened.
template <typename Work>
std::string trouble_with_little_memory(std::size_t step, std::size_t most, Work work) {
    const auto in_child = [&] {
        int refused = 0, succeeded = 0;
        for (std::size_t more = 0; more < most && succeeded < 2; more += step) {
            ::malloc_trim(0);
            ::rlim_t pages = 0;
            std::ifstream("/proc/self/statm") >> pages;
            const ::rlimit limit{pages * ::rlim_t(::getpagesize()) + more,
                                 RLIM_INFINITY};
            ::setrlimit(RLIMIT_AS, &limit);
            try {
                if (!work()) return 1;
                ++succeeded;
            } catch (const std::bad_alloc&) {
                ++refused;
            } catch (...) {
                return 2;
            }
        }
        return refused > 0 && succeeded > 0 ? 0 : 3;
    };
    const ::pid_t child = ::fork();
    if (child == 0) ::_exit(in_child());
    int status = 0;
    if (child < 0 || ::waitpid(child, &status, 0) != child) return "there is no child";
    if (!WIFEXITED(status)) return "it was killed: memory that it did not get was used";
    constexpr const char* words[]{"", "its result is wrong",
                                  "it threw something else than std::bad_alloc",
                                  "memory was never too little, or always"};
    return WEXITSTATUS(status) < 4 ? words[WEXITSTATUS(status)] : "it stopped itself";
}

} // namespace ljus_test
#endif
