#pragma once

/// \file support/seed.hpp
/// \brief Changes the seeds of statistical tests on request.

#include <cstdint>
#include <cstdlib>

namespace ljus_test {

/// The seed of a statistical test. It is `seed` itself, unless the environment variable
/// LJUS_TEST_SEED holds a number, which selects another seed. See `./scripts/test
/// --seeds 20`.
inline std::uint64_t test_seed(std::uint64_t seed) {
    static const char* const text = std::getenv("LJUS_TEST_SEED");
    const std::uint64_t other = text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
    // Large odd steps, so that no two tests get the same seed.
    return seed + other * 0xd1342543de82ef95ull;
}

} // namespace ljus_test
