#pragma once

/// \file support/seed.hpp
/// \brief Other seeds for statistical tests, on request.

#include <cstdint>
#include <cstdlib>

namespace ljus_test {

/// The seed of a statistical test: itself, or another one for each number that the
/// environment variable LJUS_TEST_SEED holds. See `./scripts/test --seeds 20`.
inline std::uint64_t test_seed(std::uint64_t seed) {
    static const char* const text = std::getenv("LJUS_TEST_SEED");
    const std::uint64_t other = text == nullptr ? 0 : std::strtoull(text, nullptr, 10);
    // Far from each other, and odd steps, so that no two tests meet.
    return seed + other * 0xd1342543de82ef95ull;
}

} // namespace ljus_test
