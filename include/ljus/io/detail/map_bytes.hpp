#pragma once

/// \file ljus/io/detail/map_bytes.hpp
/// \brief The files of maps: numbers, the same on every machine, behind one header.

#include <bit>
#include <cstdint>
#include <type_traits>

#include "ljus/io/file.hpp"

namespace ljus::detail {

// A map's file begins with 16 letters that say what it is, its version, 12 bytes of its
// own, and the checksum of all but these letters and itself.
inline constexpr std::size_t map_checksum_place = 32;
inline constexpr std::size_t map_header = 40;
inline constexpr std::size_t map_key_bytes = 16; // behind the header, if there is one

// The most bytes of a file with so many entries; whoever sets no limit has none.
inline std::size_t map_limit(std::size_t most, std::size_t bytes_of_one) noexcept {
    const std::size_t all = static_cast<std::size_t>(-1);
    const std::size_t front = map_header + map_key_bytes;
    return most < (all - front) / bytes_of_one ? front + most * bytes_of_one : all;
}

// The bits of a number, behind zeros.
template <typename Number>
[[nodiscard]] std::uint64_t bits_of(Number value) noexcept {
    using Bits = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;
    if constexpr (std::is_floating_point_v<Number>)
        return std::bit_cast<Bits>(value);
    else
        return static_cast<std::uint64_t>(value);
}

// Appends a number, its lowest byte first.
template <typename Number>
void put_number(Bytes& bytes, Number value) {
    for (std::size_t i = 0; i < sizeof(Number); ++i)
        bytes.push_back(static_cast<unsigned char>(bits_of(value) >> (8 * i) & 255u));
}

// FNV-1a, with 64 bits: a byte after those that the hash is of.
inline constexpr std::uint64_t fnv_start = 0xcbf29ce484222325u;
constexpr std::uint64_t fnv_hash(std::uint64_t hash, unsigned char byte) noexcept {
    return (hash ^ byte) * 0x100000001b3u;
}

// Of all bytes but the checksum's own, from the version on.
inline std::uint64_t map_checksum(const Bytes& bytes) noexcept {
    std::uint64_t hash = fnv_start;
    for (std::size_t i = 16; i < bytes.size(); ++i)
        if (i < map_checksum_place || i >= map_header) hash = fnv_hash(hash, bytes[i]);
    return hash;
}

// The header of a file, whose checksum put_checksum() writes when all is there.
template <typename... Own>
[[nodiscard]] Bytes map_front(std::string_view magic, std::uint32_t version,
                              Own... own) {
    static_assert((sizeof(Own) + ...) == 12);
    Bytes bytes(magic.begin(), magic.end());
    put_number(bytes, version);
    (put_number(bytes, own), ...);
    put_number(bytes, std::uint64_t(0));
    return bytes;
}

// Writes the checksum into its place.
inline void put_checksum(Bytes& bytes) {
    const std::uint64_t sum = map_checksum(bytes);
    for (std::size_t i = 0; i < 8; ++i)
        bytes[map_checksum_place + i] =
            static_cast<unsigned char>(sum >> (8 * i) & 255u);
}

// What is left of a map's file.
struct MapReader {
    std::string path; // for messages
    Bytes bytes;
    std::size_t position = 0;

    [[noreturn]] void refuse(const std::string& why) const { fail_to_read(path, why); }
    std::size_t left() const noexcept { return bytes.size() - position; }

    // The next number, which must be there; the checksum is none of them.
    template <typename Number>
    [[nodiscard]] Number take() {
        if (position == map_checksum_place) position = map_header;
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < sizeof(Number); ++i)
            bits |= std::uint64_t(bytes[position++]) << (8 * i);
        using Bits =
            std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;
        if constexpr (std::is_floating_point_v<Number>)
            return std::bit_cast<Number>(static_cast<Bits>(bits));
        else
            return static_cast<Number>(bits);
    }
};

// Opens a map's file: what is cut short, damaged, of another version or another kind
// is refused.
[[nodiscard]] inline MapReader open_map(const std::string& path, std::size_t most,
                                        std::string_view magic, std::uint32_t version) {
    MapReader file{path, load_file(path, most, magic), magic.size()};
    if (file.bytes.size() < map_header)
        file.refuse("it ends in the middle of its header");
    const auto found = file.take<std::uint32_t>();
    if (found != version)
        file.refuse("it is of version " + std::to_string(found) +
                    ", and this library reads version " + std::to_string(version));
    std::uint64_t checksum = 0;
    for (std::size_t i = 0; i < 8; ++i)
        checksum |= std::uint64_t(file.bytes[map_checksum_place + i]) << (8 * i);
    if (checksum != map_checksum(file.bytes))
        file.refuse("its checksum is wrong, so that it is damaged or cut short");
    return file;
}

} // namespace ljus::detail
