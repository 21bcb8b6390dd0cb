#pragma once

/// \file ljus/io/binary_file.hpp
/// \brief Binary files with a checked header, whose bytes are the same on every
/// machine.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "ljus/io/file.hpp"
#include "ljus/math/field_hash.hpp"

namespace ljus {

/// \defgroup binary_file Files of numbers
/// \brief The format in which light maps, photon maps, checkpoints and slices of
/// pictures are saved.
///
/// A file begins with a header of 40 bytes: 16 letters that name the format; 4 bytes
/// for the version; 12 bytes that the format defines; 8 bytes for a checksum of all
/// other bytes after the letters. Numbers follow, lowest byte first, without any
/// rounding. file_front(), put_number() and put_checksum() make the bytes of a file,
/// save_file() writes them, and open_file() reads them.
/// \{

/// A file format.
struct FileFormat {
    std::string_view magic;    ///< The 16 letters that a file begins with.
    std::uint32_t version = 1; ///< The only version that is written and read.
};

/// The size of the header, in bytes.
inline constexpr std::size_t file_front_bytes = 40;

namespace detail {

inline constexpr std::size_t checksum_place = 32;
inline constexpr std::size_t key_bytes = 8; // of a key, which follows some headers

// The largest size of a file with `most` entries; the largest size_t if that overflows.
inline std::size_t file_limit(std::size_t most, std::size_t bytes_of_one) noexcept {
    const std::size_t all = static_cast<std::size_t>(-1);
    const std::size_t front = file_front_bytes + key_bytes;
    return most < (all - front) / bytes_of_one ? front + most * bytes_of_one : all;
}

// The number whose bytes begin at `place`. All of them must be in the file.
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

// The checksum of all bytes after the letters, except the checksum itself.
inline std::uint64_t checksum(const Bytes& bytes) noexcept {
    std::uint64_t hash = fnv_start;
    for (std::size_t i = 16; i < bytes.size(); ++i)
        if (i < checksum_place || i >= file_front_bytes)
            hash = fnv_hash(hash, bytes[i]);
    return hash;
}

} // namespace detail

/// Appends a number to a file.
template <typename Number>
void put_number(Bytes& bytes, Number value) {
    for (const unsigned char byte : detail::bytes_of(value)) bytes.push_back(byte);
}

/// Appends the three components of a vector or a colour to a file.
template <typename Vector>
void put_vector(Bytes& bytes, const Vector& v) {
    for (int axis = 0; axis < 3; ++axis) put_number(bytes, v[axis]);
}

/// Makes the header of a file. `own` are integers that the format defines, of 12 bytes
/// in total. The checksum is set later, by put_checksum().
template <typename... Own>
[[nodiscard]] Bytes file_front(const FileFormat& format, Own... own) {
    static_assert((sizeof(Own) + ...) == 12);
    Bytes bytes(format.magic.begin(), format.magic.end());
    put_number(bytes, format.version);
    (put_number(bytes, own), ...);
    put_number(bytes, std::uint64_t(0));
    return bytes;
}

/// Writes the checksum of a file into its header.
inline void put_checksum(Bytes& bytes) {
    const auto sum = detail::bytes_of(detail::checksum(bytes));
    std::copy(sum.begin(), sum.end(), bytes.begin() + detail::checksum_place);
}

/// A file that has been loaded and is read from front to back.
struct FileReader {
    std::string path;         ///< The path of the file, for messages.
    Bytes bytes;              ///< The whole file.
    std::size_t position = 0; ///< Index of the next byte.

    /// Throws std::runtime_error with the text "cannot read 'a.map': " and `why`.
    [[noreturn]] void refuse(const std::string& why) const {
        detail::fail_to_read(path, why);
    }

    /// The number of unread bytes.
    [[nodiscard]] std::size_t left() const noexcept { return bytes.size() - position; }

    /// Requires that exactly `count` entries of `bytes_of_one` bytes are unread; throws
    /// as refuse(). The message calls them `entries`, for example "patches".
    void require_left(std::uint64_t count, std::size_t bytes_of_one,
                      const char* entries) const {
        if (left() / bytes_of_one == count && left() % bytes_of_one == 0) return;
        refuse("it declares " + std::to_string(count) + " " + entries +
               ", which does not match its " + std::to_string(bytes.size()) + " bytes");
    }

    /// Reads the next number, which must be in the file. Where the next bytes are the
    /// checksum, they are left out.
    template <typename Number>
    [[nodiscard]] Number take() {
        if (position == detail::checksum_place) position = file_front_bytes;
        position += sizeof(Number);
        return detail::number_at<Number>(bytes, position - sizeof(Number));
    }

    /// Reads three numbers, each by take().
    template <typename Vector>
    [[nodiscard]] Vector take_vector() {
        Vector v;
        for (int axis = 0; axis < 3; ++axis)
            v[axis] = take<typename Vector::value_type>();
        return v;
    }
};

namespace detail {

// Refuses a file of another format or version. Reading then continues after the
// version.
inline void take_format(FileReader& file, const FileFormat& format) {
    require_beginning({reinterpret_cast<const char*>(file.bytes.data()),
                       std::min(file.bytes.size(), format.magic.size())},
                      format.magic, file.path);
    file.position = format.magic.size();
    if (file.bytes.size() < file_front_bytes)
        file.refuse("it ends in the middle of its header");
    const auto found = file.take<std::uint32_t>();
    if (found != format.version)
        file.refuse("its version is " + std::to_string(found) +
                    "; this library reads version " + std::to_string(format.version));
}

} // namespace detail

/// Loads a file of at most `most` bytes and checks its header.
/// \return A reader of the file, at the first number after the version.
/// \throws std::runtime_error  if the file is longer, truncated, damaged, or of another
///         version or format; for example "cannot read 'a.map': its checksum is wrong".
[[nodiscard]] inline FileReader open_file(const std::string& path, std::size_t most,
                                          const FileFormat& format) {
    FileReader file{path, load_file(path, most, format.magic)};
    detail::take_format(file, format);
    const auto checksum =
        detail::number_at<std::uint64_t>(file.bytes, detail::checksum_place);
    if (checksum != detail::checksum(file.bytes))
        file.refuse("its checksum is wrong: it is damaged or truncated");
    return file;
}

/// \}

} // namespace ljus
