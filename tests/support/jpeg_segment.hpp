#pragma once

/// \file support/jpeg_segment.hpp
/// \brief Makes unusual JPEG files, segment by segment.

#include <initializer_list>
#include <vector>

namespace ljus_test {

/// Adds a segment to a JPEG file.
/// \param file    The bytes of the file.
/// \param kind    The byte after 0xff: 0xdb for quantisation tables, 0xc4 for Huffman
///                tables, ...
/// \param values  The bytes after the length.
inline void add_jpeg_segment(std::vector<unsigned char>& file, int kind,
                             std::initializer_list<int> values) {
    for (const int v : {0xff, kind, 0, static_cast<int>(values.size()) + 2})
        file.push_back(static_cast<unsigned char>(v));
    for (const int v : values) file.push_back(static_cast<unsigned char>(v));
}

} // namespace ljus_test
