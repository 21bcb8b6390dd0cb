#pragma once

/// \file ljus/io/detail/map_bytes.hpp
/// \brief Numbers in a file of a map, the same on every machine.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "ljus/io/file.hpp"

namespace ljus::detail {

// A map's file begins with 16 letters that say what it is, 16 bytes of its own, and the
// checksum of all but these letters and itself.
inline constexpr std::size_t map_magic_size = 16;
inline constexpr std::size_t map_header = 40;

// The most bytes of a file with so many entries; whoever sets no limit has none.
inline std::size_t map_limit(std::size_t most, std::size_t bytes_of_one) noexcept {
    const std::size_t all = static_cast<std::size_t>(-1);
    return most < (all - map_header) / bytes_of_one ? map_header + most * bytes_of_one
                                                    : all;
}

// Appends a number, its lowest byte first.
template <typename Number>
void put_number(Bytes& bytes, Number value) {
    using Bits = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;
    std::uint64_t bits;
    if constexpr (std::is_floating_point_v<Number>)
        bits = std::bit_cast<Bits>(value);
    else
        bits = static_cast<std::uint64_t>(value);
    for (std::size_t i = 0; i < sizeof(Number); ++i)
        bytes.push_back(static_cast<unsigned char>(bits >> (8 * i) & 255u));
}

// Takes a number from the front of what is left.
template <typename Number>
[[nodiscard]] Number take_number(const unsigned char*& at) {
    using Bits = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i)
        bits |= std::uint64_t(*at++) << (8 * i);
    if constexpr (std::is_floating_point_v<Number>)
        return std::bit_cast<Number>(static_cast<Bits>(bits));
    else
        return static_cast<Number>(bits);
}

// Of all bytes but the checksum's own, from the version on: FNV-1a, with 64 bits.
inline std::uint64_t map_checksum(const Bytes& bytes) noexcept {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (std::size_t i = map_magic_size; i < bytes.size(); ++i)
        if (i < 32 || i >= map_header) hash = (hash ^ bytes[i]) * 0x100000001b3u;
    return hash;
}

// Writes the checksum into its place.
inline void put_checksum(Bytes& bytes) {
    Bytes sum;
    put_number(sum, map_checksum(bytes));
    std::copy(sum.begin(), sum.end(), bytes.begin() + 32);
}

} // namespace ljus::detail
