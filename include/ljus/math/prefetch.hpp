#pragma once

/// \file ljus/math/prefetch.hpp
/// \brief Memory, asked for before it is needed.

#include "ljus/version.hpp"

namespace ljus {

/// \defgroup prefetch Prefetching
/// \brief A processor waits for its memory some hundred steps; it can be told in time.
/// \{

/// Says that `lines` cache lines of 64 bytes will soon be read. A hint: where a
/// compiler has none to give, nothing happens, and all answers are the same.
/// \param address  Where the first begins; any address.
/// \cost An instruction a line.
// [prefetch]
template <int lines = 1>
inline void prefetch([[maybe_unused]] const void* address) noexcept {
#if defined(__GNUC__) // clang says so, too
    for (int i = 0; i < lines; ++i)
        __builtin_prefetch(static_cast<const char*>(address) + 64 * i);
#endif
}
// [prefetch]

/// \}

} // namespace ljus
