#pragma once

/// \file ljus/io/detail/picture_size.hpp
/// \brief A limit for the number of pixels in all pictures of a file together.

#include <string>

#include "ljus/math/require.hpp"

namespace ljus::detail {

/// The largest number of pixels in all pictures of a file together: 8192 x 4096. A
/// single 16-bit PNG picture may have half as many.
inline constexpr int max_image_pixels = 1 << 25;

// Why a picture is too large beside others of `others` pixels; empty if it is not.
inline std::string too_large_beside(long long others, long long wide, long long high) {
    if (wide * high <= max_image_pixels - others) return "";
    return join({"has ", to_text(wide), " x ", to_text(high),
                 " pixels, and the pictures before it have ", to_text(others),
                 "; together there must be at most ", to_text(max_image_pixels)});
}

} // namespace ljus::detail
