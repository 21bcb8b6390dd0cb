#pragma once

/// \file examples/common/fingerprint.hpp
/// \brief A fingerprint of a picture: a hash of its bytes, as hexadecimal digits.

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace examples {

/// The FNV-1a hash of the bytes of some values.
///
/// The probability that two different lists have the same hash is 5e-20, unless they
/// were made to collide.
/// \param values  Values of a type without padding between its members.
/// \param hash    The hash so far, to continue from.
/// \return The hash, 64 bits.
template <typename V>
[[nodiscard]] std::uint64_t hash_of(const std::vector<V>& values,
                                    std::uint64_t hash = 0xcbf29ce484222325u) {
    static_assert(std::is_trivially_copyable_v<V>);
    for (const V& value : values) {
        unsigned char bytes[sizeof(V)];
        std::memcpy(bytes, &value, sizeof(V));
        for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3u;
    }
    return hash;
}

/// A hash as text.
/// \param hash  The hash, 64 bits.
/// \return 16 hexadecimal digits.
[[nodiscard]] inline std::string hex_text(std::uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

} // namespace examples
