#pragma once

/// \file ljus/io/detail/obj_text.hpp
/// \brief The lines, words and numbers of a mesh file.

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace ljus {

/// \addtogroup obj_reader
/// \{

namespace detail {

// Where the line ends that begins at a place, and where the next one begins.
struct LineEnd {
    std::size_t last, next;
};
inline LineEnd line_end(std::string_view text, std::size_t begin) {
    const std::size_t last = std::min(text.find_first_of("\r\n", begin), text.size());
    const std::size_t next = last + (text.substr(last, 2) == "\r\n" ? 2 : 1);
    return {last, std::min(next, text.size())};
}

// The words of a line, as tinyobjloader sees them: up to a 0.
inline std::vector<std::string_view> words_of(std::string_view line) {
    line = line.substr(0, line.find('\0'));
    std::vector<std::string_view> words;
    while (true) {
        const std::size_t begin = line.find_first_not_of(" \t");
        if (begin == line.npos) return words;
        line.remove_prefix(begin);
        const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
        words.push_back(line.substr(0, end));
        line.remove_prefix(end);
    }
}

// The three numbers of a line "v 1 2 3"; NaN where there is none. tinyobjloader takes
// what it cannot read for 0.
inline glm::dvec3 numbers_of(std::string_view line) {
    const auto words = words_of(line);
    glm::dvec3 result(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < 3 && i + 1 < words.size(); ++i) {
        std::string_view word = words[i + 1];
        if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
        double value = 0;
        const char* const end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data(), end, value);
        if (stop == end && error == std::errc{})
            result[static_cast<glm::length_t>(i)] = value;
    }
    return result;
}

// tinyobjloader's exponents overflow from ten digits on. In what begins as a number and
// has so many, the letter E gives way to one that ends it, which numbers_of() refuses.
inline void blunt_exponents(std::string& text) {
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    bool number = true; // the word up to here
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if ((c == 'e' || c == 'E') && number) {
            std::size_t first = i + 1;
            if (first < text.size() && (text[first] == '-' || text[first] == '+'))
                ++first;
            std::size_t last = first;
            while (last < text.size() && digit(text[last])) ++last;
            if (last - first >= 10) text[i] = 'x';
        }
        const bool space = c == ' ' || c == '\t' || c == '\r' || c == '\n';
        number = space || (number && (digit(c) || c == '.' || c == '-' || c == '+'));
    }
}

} // namespace detail

/// \}

} // namespace ljus
