#pragma once

/// \file ljus/io/detail/byte_reader.hpp
/// \brief Reads the bytes of an image file, for pfm.hpp and hdr.hpp.

#include <charconv>
#include <cstddef>
#include <string>
#include <system_error>

#include "ljus/image/image.hpp"
#include "ljus/io/detail/parse.hpp"
#include "ljus/io/file.hpp"

namespace ljus::detail {

struct ByteReader {
    std::string path; // for messages
    Bytes bytes;
    std::size_t position = 0;

    [[noreturn]] void fail(const std::string& why) const { fail_to_read(path, why); }

    std::size_t left() const noexcept { return bytes.size() - position; }

    unsigned char next() {
        if (left() == 0) fail("it ends in the middle of its header or pixels");
        return bytes[position++];
    }

    // Reads the next word, and one character of white space after it. A '#' before the
    // word begins a comment, to the end of its line.
    std::string word() {
        std::string text;
        char c = to_char(next());
        while (is_space(c) || c == '#') {
            if (c == '#') (void)line();
            c = to_char(next());
        }
        for (; !is_space(c); c = to_char(next())) {
            text += c;
            if (text.size() > 64) fail("its header has a word of more than 64 letters");
        }
        return text;
    }

    // Reads a line to its end; returns it without blanks at both ends.
    std::string last_word() {
        std::string text = line();
        text.erase(0, text.find_first_not_of(" \t"));
        text.erase(text.find_last_not_of(" \t") + 1);
        return text;
    }

    // Reads a line; returns it without its end.
    std::string line() {
        std::string text;
        for (char c = to_char(next()); c != '\n'; c = to_char(next())) {
            text += c;
            if (text.size() > 4096)
                fail("its header has a line of more than 4096 letters");
        }
        if (!text.empty() && text.back() == '\r') text.pop_back();
        return text;
    }

    // Skips white space until `expected` bytes are left.
    void skip_blanks(std::size_t expected) noexcept {
        while (left() > expected && is_space(to_char(bytes[position]))) ++position;
    }

    // The width or height that a word of the header gives.
    int size(const std::string& text) const {
        int value = 0;
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        if (stop != end || error != std::errc{} || value < 1 || value > max_pixels)
            fail("its width or height is '" + shown(text) +
                 "'; it must be a whole number from 1 to " +
                 std::to_string(max_pixels));
        return value;
    }

    void require_pixels(int width, int height) const {
        if (width > max_pixels / height)
            fail("it has " + std::to_string(width) + " x " + std::to_string(height) +
                 " pixels; there can be at most " + std::to_string(max_pixels));
    }

private:
    static char to_char(unsigned char byte) noexcept { return static_cast<char>(byte); }
    static bool is_space(char c) noexcept {
        return c == ' ' || c == '\n' || c == '\t' || c == '\r';
    }
};

} // namespace ljus::detail
