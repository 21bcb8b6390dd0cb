#pragma once

/// \file ljus/io/detail/picture_damage.hpp
/// \brief Tests PNG, JPEG and BMP files for damage that stb_image does not notice, and
/// for variants of these formats that stb_image does not read.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ljus/io/file.hpp"

namespace ljus::detail {

// A byte of a file; 0 beyond its end, as in stb_image.
inline std::size_t byte_at(const Bytes& file, std::size_t at) {
    return at < file.size() ? std::size_t(file[at]) : std::size_t(0);
}

// The number in some bytes of a file. The first byte is the highest or, with
// `low_first`, the lowest.
inline std::size_t number_in(const Bytes& file, std::size_t at, std::size_t bytes,
                             bool low_first = false) {
    std::size_t value = 0;
    for (std::size_t k = 0; k < bytes; ++k)
        value = value * 256 + byte_at(file, at + (low_first ? bytes - 1 - k : k));
    return value;
}

inline std::uint32_t png_number(const Bytes& file, std::size_t at) {
    return static_cast<std::uint32_t>(number_in(file, at, 4));
}

// The CRC-32 of the bytes from `first` to `last` - 1. A PNG chunk ends with the CRC-32
// of its name and data.
inline std::uint32_t png_sum(const Bytes& file, std::size_t first, std::size_t last) {
    static constexpr auto table = [] {
        std::array<std::uint32_t, 256> sums{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            sums[i] = i;
            for (int bit = 0; bit < 8; ++bit)
                sums[i] = sums[i] >> 1 ^ (sums[i] & 1u ? 0xedb88320u : 0u);
        }
        return sums;
    }();
    std::uint32_t sum = 0xffffffffu;
    for (std::size_t i = first; i < last; ++i)
        sum = table[(sum ^ file[i]) & 255u] ^ sum >> 8;
    return ~sum;
}

// Whether a text stands at an index of a file.
inline bool stands_at(const Bytes& file, std::size_t at, std::string_view text) {
    return at + text.size() <= file.size() &&
           std::equal(text.begin(), text.end(), file.data() + at);
}

// Calls use(name, at, size) for each chunk of a PNG file, where `at` is the index of
// the chunk's data. Ends if use() returns true, after the chunk IEND, or at a chunk
// that is cut off.
template <typename Use>
void find_png_chunk(const Bytes& file, Use use) {
    for (std::size_t at = 8; at <= file.size() && file.size() - at >= 12;) {
        const std::size_t size = png_number(file, at);
        const std::string_view name(reinterpret_cast<const char*>(&file[at + 4]), 4);
        if (size > file.size() - at - 12 || use(name, at + 8, size)) return;
        if (name == "IEND") return;
        at += 12 + size;
    }
}

// The damage of a PNG file, or null. stb_image tests neither whether the chunks are
// complete up to IEND nor whether their checksums are right.
inline const char* png_trouble(const Bytes& file) {
    const char* trouble = "it ends before its last chunk, or in the middle of one";
    find_png_chunk(file, [&](std::string_view name, std::size_t at, std::size_t size) {
        const bool right =
            png_number(file, at + size) == png_sum(file, at - 4, at + size);
        if (!right)
            trouble = "the checksum of a chunk is wrong";
        else if (name == "IEND")
            trouble = nullptr;
        return !right;
    });
    return trouble;
}

// A copy of a PNG file whose palette is filled up with black to 256 colours; empty if
// the file has no palette, or a full one. For a colour beyond the end of a palette,
// stb_image would read uninitialised memory.
inline Bytes with_whole_palette(const Bytes& file) {
    constexpr std::size_t full = 3 * 256;
    Bytes whole;
    find_png_chunk(file, [&](std::string_view name, std::size_t at, std::size_t size) {
        if (name != "PLTE" || size >= full || size % 3 != 0) return false;
        whole = file;
        whole.insert(whole.begin() + static_cast<std::ptrdiff_t>(at + size),
                     full - size, 0);
        whole[at - 6] = full / 256; // the last two bytes of its size
        whole[at - 5] = full % 256;
        return true;
    });
    return whole;
}

// EXIF data, which are a TIFF file within a picture file. They consist of the byte
// order, the offset of the first list of fields, and lists of fields of 12 bytes.
class Tiff {
public:
    Tiff(const Bytes& file, std::size_t at) : file_(file), at_(at) {}

    // The orientation, 1 to 8; 1 if the data do not give one.
    [[nodiscard]] int orientation() const {
        const std::size_t field = find(list(at_ + 4), 0x112);
        return field != 0 ? static_cast<int>(number(field, 2)) : 1;
    }

    // Whether the data declare Adobe RGB: by the number of a colour space or, as
    // cameras do, by the interoperability rule "R03".
    [[nodiscard]] bool is_adobe_rgb() const {
        const std::size_t exif = find(list(at_ + 4), 0x8769);
        if (exif == 0) return false;
        const std::size_t space = find(list(exif), 0xa001);
        const std::size_t rules = find(list(exif), 0xa005);
        const std::size_t rule = rules != 0 ? find(list(rules), 1) : 0;
        return (space != 0 && number(space, 2) == 2) ||
               (rule != 0 && stands_at(file_, rule, "R03"));
    }

private:
    [[nodiscard]] std::size_t number(std::size_t i, std::size_t bytes) const {
        return number_in(file_, i, bytes, byte_at(file_, at_) == 'I');
    }
    // The list of fields whose offset is at `i`.
    [[nodiscard]] std::size_t list(std::size_t i) const { return at_ + number(i, 4); }

    // The index of the value of a field in a list; 0 if the list lacks the field.
    [[nodiscard]] std::size_t find(std::size_t fields, std::size_t name) const {
        for (std::size_t i = 0; i < number(fields, 2); ++i)
            if (const std::size_t field = fields + 2 + 12 * i; number(field, 2) == name)
                return field + 8;
        return 0;
    }

    const Bytes& file_;
    std::size_t at_;
};

// The orientation in the eXIf chunk of a PNG file, which comes before its pixels; 1
// without one.
inline int png_orientation(const Bytes& file) {
    int orientation = 1;
    find_png_chunk(file, [&](std::string_view name, std::size_t at, std::size_t) {
        const bool found = name == "eXIf";
        if (found) orientation = Tiff(file, at).orientation();
        return found || name == "IDAT";
    });
    return orientation;
}

// Whether stb_image can read the Huffman tables of a JPEG segment whose length is at
// `at`. It has room for 256 entries per table, does not count them, and uses the number
// 255 for no entry. The tables are noted in `there`: bit n for DC table n, bit 16 + n
// for AC table n.
inline bool good_huffman_tables(const Bytes& file, std::size_t at,
                                std::uint32_t& there) {
    const auto byte = [&](std::size_t i) { return byte_at(file, i); };
    auto left = static_cast<long long>(byte(at) * 256 + byte(at + 1)) - 2;
    for (at += 2; left > 0;) {
        std::size_t entries = 0;
        for (std::size_t i = 1; i <= 16; ++i) entries += byte(at + i);
        if (entries > 255) return false;
        there |= std::uint32_t{1} << (byte(at) & 31u);
        at += 17 + entries;
        left -= static_cast<long long>(17 + entries);
    }
    return true;
}

// Whether the file has all Huffman tables that a scan uses; the length of the scan's
// header is at `at`. stb_image would use uninitialised tables.
inline bool finds_tables(const Bytes& file, std::size_t at, bool in_parts,
                         std::uint32_t there) {
    const std::size_t components = byte_at(file, at + 2);
    const std::size_t behind = at + 3 + 2 * components;
    const bool begins_at_dc = byte_at(file, behind) == 0;
    const bool refines = byte_at(file, behind + 2) >> 4 != 0;
    const bool asks_dc = !in_parts || (begins_at_dc && !refines);
    const bool asks_ac = !in_parts || !begins_at_dc;
    for (std::size_t i = 0; i < components; ++i) {
        const std::size_t numbers = byte_at(file, at + 4 + 2 * i);
        if (asks_dc && (there >> (numbers >> 4) & 1u) == 0) return false;
        if (asks_ac && (there >> (16 + (numbers & 15u)) & 1u) == 0) return false;
    }
    return true;
}

// The index of the first marker after coded pixels that begin at `at`. Within pixels, a
// byte 0xff is followed by 0 or by a restart number.
inline std::size_t behind_pixels(const Bytes& file, std::size_t at) {
    const auto is_marker = [&](unsigned char kind) {
        return kind != 0 && kind != 0xff && (kind & 0xf8u) != 0xd0;
    };
    while (at + 1 < file.size() && (file[at] != 0xff || !is_marker(file[at + 1]))) ++at;
    return at;
}

// Calls use(kind, at) for each segment of a JPEG file before its pixels, where `at` is
// the index after the segment's length. Ends if use() returns true.
template <typename Use>
void find_jpeg_segment(const Bytes& file, Use use) {
    constexpr unsigned char padding = 0xff, scan = 0xda;
    for (std::size_t at = 2; at + 4 <= file.size() && file[at] == 0xff;) {
        const unsigned char kind = file[at + 1];
        if (kind == padding) {
            ++at;
            continue;
        }
        if (kind == scan || use(kind, at + 4)) return;
        at += 2 + std::size_t(file[at + 2]) * 256 + file[at + 3];
    }
}

// The orientation in the EXIF segment of a JPEG file; 1 without one.
inline int jpeg_orientation(const Bytes& file) {
    int orientation = 1;
    find_jpeg_segment(file, [&](unsigned char kind, std::size_t at) {
        const bool found = kind == 0xe1 && stands_at(file, at, {"Exif\0\0", 6});
        if (found) orientation = Tiff(file, at + 6).orientation();
        return found;
    });
    return orientation;
}

// The kind of a JPEG file that stb_image does not read, or reads with wrong colours, as
// the end of a sentence; null for any other file.
inline const char* jpeg_kind_unread(const Bytes& file) {
    const char* why = nullptr;
    bool adobe = false; // a segment that explains four channels
    find_jpeg_segment(file, [&](unsigned char kind, std::size_t at) {
        adobe = adobe || (kind == 0xee && stands_at(file, at, "Adobe"));
        const bool frame = kind >= 0xc0 && kind <= 0xcf && kind != 0xc4 &&
                           kind != 0xc8 && kind != 0xcc;
        if (!frame || at + 6 > file.size()) return false;
        if (kind > 0xc2)
            why = "that is lossless, in layers or coded arithmetically; save it as "
                  "baseline JPEG or PNG";
        else if (file[at] != 8)
            why = "of more than 8 bits per channel; save it with 8 bits";
        else if (file[at + 5] == 4 && !adobe)
            why = "of four channels that does not say what they mean; save it as RGB";
        return why != nullptr;
    });
    return why;
}

// The damage of a JPEG file, or null. stb_image does not test whether Huffman tables
// are valid, and whether all tables that a scan uses exist. Scans are limited: each
// takes time for the whole picture, and can be as short as ten bytes. A baseline file
// has at most one per channel, and a progressive file usually about ten.
inline const char* jpeg_trouble(const Bytes& file) {
    constexpr unsigned char tables = 0xc4, progressive = 0xc2, scan = 0xda, end = 0xd9;
    std::uint32_t there = 0;
    int scans = 0;
    bool in_parts = false;
    for (std::size_t at = 2; at < file.size() && file.size() - at >= 4;) {
        const unsigned char kind = file[at + 1];
        if (file[at] != 0xff || kind == 0xff) { // padding
            ++at;
            continue;
        }
        if (kind == end) break;
        in_parts = in_parts || kind == progressive;
        if (kind == tables && !good_huffman_tables(file, at + 2, there))
            return "a table has more than 255 entries";
        if (kind == scan && !finds_tables(file, at + 2, in_parts, there))
            return "a scan uses a table that is not there";
        if (kind == scan && ++scans > (in_parts ? 64 : 4))
            return in_parts ? "it has more than 64 scans"
                            : "it has more than 4 scans, and is not progressive";
        at += 2 + std::size_t(file[at + 2]) * 256 + file[at + 3];
        if (kind == scan) at = behind_pixels(file, at);
    }
    return nullptr;
}

inline std::size_t bmp_number(const Bytes& file, std::size_t at, std::size_t bytes) {
    return number_in(file, at, bytes, true);
}

// The header of a BMP file.
struct BmpHead {
    std::size_t offset, size, bits, compression; // offset of the pixels, size of the
                                                 // header, bits of a pixel
    explicit BmpHead(const Bytes& file)
        : offset(bmp_number(file, 10, 4)), size(bmp_number(file, 14, 4)),
          bits(bmp_number(file, size == 12 ? 24 : 28, 2)),
          compression(size == 12 ? 0 : bmp_number(file, 30, 4)) {}
    // The size of a file with a picture of this width and height, in bytes. The padding
    // of the last row is left out.
    [[nodiscard]] std::size_t bytes(std::size_t width, std::size_t height) const {
        const std::size_t row = (width * bits + 31) / 32 * 4;
        return offset + (height - 1) * row + (width * bits + 7) / 8;
    }
};

// A copy of a BMP file whose palette is filled up with black, as in
// with_whole_palette().
inline Bytes bmp_with_whole_palette(const Bytes& file) {
    const BmpHead head(file);
    // In files with the oldest header stb_image counts four colours too few.
    const std::size_t full = 14 + head.size + (head.size == 12 ? 3 * 260 : 4 * 256);
    if (head.bits >= 16 || head.offset <= 14 + head.size || head.offset >= full ||
        head.offset > file.size())
        return {};
    Bytes whole = file;
    whole.insert(whole.begin() + static_cast<std::ptrdiff_t>(head.offset),
                 full - head.offset, 0);
    for (std::size_t k = 0; k < 4; ++k)
        whole[10 + k] = static_cast<unsigned char>(full >> 8 * k);
    return whole;
}

} // namespace ljus::detail
