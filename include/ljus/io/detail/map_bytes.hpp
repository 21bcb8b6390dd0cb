#pragma once

/// \file ljus/io/detail/map_bytes.hpp
/// \brief The files of maps: numbers, the same on every machine, behind one header.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "ljus/io/file.hpp"

namespace ljus::detail {

// A kind of file: the 16 letters that it begins with, and the version that is written
// and read.
struct MapFormat {
    std::string_view magic;
    std::uint32_t version = 1;
};

// These letters are followed by the version, 12 bytes of the format's own, and the
// checksum of all but the letters and itself.
inline constexpr std::size_t map_checksum_place = 32;
inline constexpr std::size_t map_header = 40;
inline constexpr std::size_t map_key_bytes = 16; // behind the header, if there is one

// The most bytes of a file with so many entries; whoever sets no limit has none.
inline std::size_t map_limit(std::size_t most, std::size_t bytes_of_one) noexcept {
    const std::size_t all = static_cast<std::size_t>(-1);
    const std::size_t front = map_header + map_key_bytes;
    return most < (all - front) / bytes_of_one ? front + most * bytes_of_one : all;
}

// The unsigned number of the same size.
template <typename Number>
using BitsOf = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;

// The bytes of a number, the lowest first, on every machine.
template <typename Number>
[[nodiscard]] std::array<unsigned char, sizeof(Number)>
bytes_of(Number value) noexcept {
    std::uint64_t bits = 0;
    if constexpr (std::is_floating_point_v<Number>)
        bits = std::bit_cast<BitsOf<Number>>(value);
    else
        bits = static_cast<std::uint64_t>(value);
    std::array<unsigned char, sizeof(Number)> bytes{};
    for (std::size_t i = 0; i < sizeof(Number); ++i)
        bytes[i] = static_cast<unsigned char>(bits >> (8 * i) & 255u);
    return bytes;
}

// The number whose bytes begin at a place, where there are enough.
template <typename Number>
[[nodiscard]] Number number_at(const Bytes& bytes, std::size_t place) noexcept {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i)
        bits |= std::uint64_t(bytes[place + i]) << (8 * i);
    if constexpr (std::is_floating_point_v<Number>)
        return std::bit_cast<Number>(static_cast<BitsOf<Number>>(bits));
    else
        return static_cast<Number>(bits);
}

template <typename Number>
void put_number(Bytes& bytes, Number value) {
    for (const unsigned char byte : bytes_of(value)) bytes.push_back(byte);
}

template <typename Vector>
void put_vector(Bytes& bytes, const Vector& v) {
    for (int axis = 0; axis < 3; ++axis) put_number(bytes, v[axis]);
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
[[nodiscard]] Bytes map_front(const MapFormat& format, Own... own) {
    static_assert((sizeof(Own) + ...) == 12);
    Bytes bytes(format.magic.begin(), format.magic.end());
    put_number(bytes, format.version);
    (put_number(bytes, own), ...);
    put_number(bytes, std::uint64_t(0));
    return bytes;
}

// Writes the checksum into its place.
inline void put_checksum(Bytes& bytes) {
    const auto sum = bytes_of(map_checksum(bytes));
    std::copy(sum.begin(), sum.end(), bytes.begin() + map_checksum_place);
}

// What is left of a map's file.
struct MapReader {
    std::string path; // for messages
    Bytes bytes;
    std::size_t position = 0;

    [[noreturn]] void refuse(const std::string& why) const { fail_to_read(path, why); }
    std::size_t left() const noexcept { return bytes.size() - position; }

    // Refuses a file unless so many entries are all that is left of it.
    void require_left(std::uint64_t count, std::size_t bytes_of_one,
                      const char* entries) const {
        if (left() / bytes_of_one == count && left() % bytes_of_one == 0) return;
        refuse("it says that it holds " + std::to_string(count) + " " + entries +
               ", which does not go with its " + std::to_string(bytes.size()) +
               " bytes");
    }

    // The next number, which must be there; the checksum is none of them.
    template <typename Number>
    [[nodiscard]] Number take() {
        if (position == map_checksum_place) position = map_header;
        position += sizeof(Number);
        return number_at<Number>(bytes, position - sizeof(Number));
    }

    template <typename Vector>
    [[nodiscard]] Vector take_vector() {
        Vector v;
        for (int axis = 0; axis < 3; ++axis)
            v[axis] = take<typename Vector::value_type>();
        return v;
    }
};

// Opens a map's file: what is cut short, damaged, of another version or another kind
// is refused.
[[nodiscard]] inline MapReader open_map(const std::string& path, std::size_t most,
                                        const MapFormat& format) {
    MapReader file{path, load_file(path, most, format.magic), format.magic.size()};
    if (file.bytes.size() < map_header)
        file.refuse("it ends in the middle of its header");
    const auto found = file.take<std::uint32_t>();
    if (found != format.version)
        file.refuse("it is of version " + std::to_string(found) +
                    ", and this library reads version " +
                    std::to_string(format.version));
    const auto checksum = number_at<std::uint64_t>(file.bytes, map_checksum_place);
    if (checksum != map_checksum(file.bytes))
        file.refuse("its checksum is wrong, so that it is damaged or cut short");
    return file;
}

} // namespace ljus::detail
