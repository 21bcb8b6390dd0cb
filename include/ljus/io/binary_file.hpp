#pragma once

/// \file ljus/io/binary_file.hpp
/// \brief Files of numbers, the same on every machine, behind one header.

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
/// \brief How light maps, checkpoints and slices of pictures are written and read.
///
/// A file is 16 letters that say what it is; the version, 4 bytes; 12 bytes of the
/// format's own; the checksum of all but the letters and itself, 8 bytes; then numbers,
/// with all their bits, the lowest byte first. Make it with file_front(), put_number()
/// and put_checksum(), and write it with save_file(); read it with open_file().
/// \{

/// A kind of file.
struct FileFormat {
    std::string_view magic;    ///< The 16 letters that it begins with.
    std::uint32_t version = 1; ///< The one that is written and read.
};

/// The bytes from the first letter to the checksum.
inline constexpr std::size_t file_front_bytes = 40;

namespace detail {

inline constexpr std::size_t checksum_place = 32;
inline constexpr std::size_t key_bytes = 8; // behind the front, if there is one

// The most bytes of a file with so many entries; whoever sets no limit has none.
inline std::size_t file_limit(std::size_t most, std::size_t bytes_of_one) noexcept {
    const std::size_t all = static_cast<std::size_t>(-1);
    const std::size_t front = file_front_bytes + key_bytes;
    return most < (all - front) / bytes_of_one ? front + most * bytes_of_one : all;
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

// Of all bytes but the checksum's own, from the version on.
inline std::uint64_t checksum(const Bytes& bytes) noexcept {
    std::uint64_t hash = fnv_start;
    for (std::size_t i = 16; i < bytes.size(); ++i)
        if (i < checksum_place || i >= file_front_bytes)
            hash = fnv_hash(hash, bytes[i]);
    return hash;
}

} // namespace detail

/// Adds a number to a file.
/// \param bytes  The file so far.
/// \param value  An integer or a floating-point number.
template <typename Number>
void put_number(Bytes& bytes, Number value) {
    for (const unsigned char byte : detail::bytes_of(value)) bytes.push_back(byte);
}

/// Adds the three numbers of a vector or a colour to a file.
/// \param bytes  The file so far.
/// \param v      The vector.
template <typename Vector>
void put_vector(Bytes& bytes, const Vector& v) {
    for (int axis = 0; axis < 3; ++axis) put_number(bytes, v[axis]);
}

/// The front of a file, whose checksum put_checksum() writes when all is there.
/// \param format  What kind of file it is.
/// \param own     Integers of the format's own, 12 bytes together.
/// \return 40 bytes.
template <typename... Own>
[[nodiscard]] Bytes file_front(const FileFormat& format, Own... own) {
    static_assert((sizeof(Own) + ...) == 12);
    Bytes bytes(format.magic.begin(), format.magic.end());
    put_number(bytes, format.version);
    (put_number(bytes, own), ...);
    put_number(bytes, std::uint64_t(0));
    return bytes;
}

/// Writes the checksum of a file into its place.
/// \param bytes  The whole file.
inline void put_checksum(Bytes& bytes) {
    const auto sum = detail::bytes_of(detail::checksum(bytes));
    std::copy(sum.begin(), sum.end(), bytes.begin() + detail::checksum_place);
}

/// A file that is read from the front.
struct FileReader {
    std::string path;         ///< For messages.
    Bytes bytes;              ///< The whole file.
    std::size_t position = 0; ///< Of the next byte.

    /// Refuses the file.
    /// \param why  "its size is 0": the end of the sentence "cannot read 'a.map': ...".
    /// \throws std::runtime_error  always.
    [[noreturn]] void refuse(const std::string& why) const {
        detail::fail_to_read(path, why);
    }

    /// How many bytes are left.
    [[nodiscard]] std::size_t left() const noexcept { return bytes.size() - position; }

    /// Refuses the file unless so many entries are all that is left of it.
    /// \param count         How many.
    /// \param bytes_of_one  Bytes of an entry.
    /// \param entries       Their name: "patches".
    /// \throws std::runtime_error  if there are more or fewer.
    void require_left(std::uint64_t count, std::size_t bytes_of_one,
                      const char* entries) const {
        if (left() / bytes_of_one == count && left() % bytes_of_one == 0) return;
        refuse("it says that it holds " + std::to_string(count) + " " + entries +
               ", which does not go with its " + std::to_string(bytes.size()) +
               " bytes");
    }

    /// The next number. It must be there: ask left(). The checksum is passed over.
    template <typename Number>
    [[nodiscard]] Number take() {
        if (position == detail::checksum_place) position = file_front_bytes;
        position += sizeof(Number);
        return detail::number_at<Number>(bytes, position - sizeof(Number));
    }

    /// The next three numbers, as take().
    template <typename Vector>
    [[nodiscard]] Vector take_vector() {
        Vector v;
        for (int axis = 0; axis < 3; ++axis)
            v[axis] = take<typename Vector::value_type>();
        return v;
    }
};

/// Opens a file.
/// \param path    The file.
/// \param most    The most bytes that it may have.
/// \param format  What it must be.
/// \return The file, behind its version.
/// \throws std::runtime_error  "cannot read 'a.map': its checksum is wrong, ...": what
///         is cut short, damaged, of another version or of another kind is refused.
[[nodiscard]] inline FileReader open_file(const std::string& path, std::size_t most,
                                          const FileFormat& format) {
    FileReader file{path, load_file(path, most, format.magic), format.magic.size()};
    if (file.bytes.size() < file_front_bytes)
        file.refuse("it ends in the middle of its header");
    const auto found = file.take<std::uint32_t>();
    if (found != format.version)
        file.refuse("it is of version " + std::to_string(found) +
                    ", and this library reads version " +
                    std::to_string(format.version));
    const auto checksum =
        detail::number_at<std::uint64_t>(file.bytes, detail::checksum_place);
    if (checksum != detail::checksum(file.bytes))
        file.refuse("its checksum is wrong, so that it is damaged or cut short");
    return file;
}

/// \}

} // namespace ljus
