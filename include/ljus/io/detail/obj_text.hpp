#pragma once

/// \file ljus/io/detail/obj_text.hpp
/// \brief The lines, words and numbers of a mesh file.

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

namespace ljus {

/// \addtogroup obj_reader
/// \{

namespace detail {

// The end of the line that begins at `begin`, and the start of the next one.
struct LineEnd {
    std::size_t last, next;
};
inline LineEnd line_end(std::string_view text, std::size_t begin) {
    const std::size_t last = std::min(text.find_first_of("\r\n", begin), text.size());
    const std::size_t next = last + (text.substr(last, 2) == "\r\n" ? 2 : 1);
    return {last, std::min(next, text.size())};
}

// Calls use(line, number) for each line of a text; the first is number 1.
template <typename Use>
void each_line(std::string_view text, Use use) {
    std::size_t begin = 0;
    for (long long number = 1; begin < text.size(); ++number) {
        const LineEnd end = line_end(text, begin);
        use(text.substr(begin, end.last - begin), number);
        begin = end.next;
    }
}

// The last line that a stream has read, and its number. It is queried after each line,
// so that lines are counted once.
struct LastLine {
    std::istringstream& stream;
    std::size_t begin = 0;
    LineEnd end{};
    long long number = 0;

    [[nodiscard]] std::string_view text() {
        std::string_view all = stream.view();
        const auto at = stream.tellg(); // -1 at the end
        if (at >= 0) all = all.substr(0, static_cast<std::size_t>(at));
        while (end.next < all.size()) {
            begin = end.next;
            end = line_end(all, begin);
            ++number;
        }
        return all.substr(begin, end.last - begin);
    }
};

// The words of a line as tinyobjloader splits them: up to a 0.
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

// The three numbers of a line "v 1 2 3"; NaN where there is none. tinyobjloader reads
// malformed numbers as 0.
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

// True if tinyobjloader has read the indices of a line "f 1/2/3 4/5/6 ..." with so many
// corners to their ends. It silently stops at other characters and at 2^31.
inline bool all_read(std::string_view line, std::size_t corners) {
    const auto words = words_of(line);
    bool good = words.size() == corners + 1;
    for (std::size_t i = 1; i < words.size(); ++i) {
        int digits = 0;
        for (const char c : words[i]) {
            digits = c >= '0' && c <= '9' ? digits + 1 : 0;
            good = good && digits < 10 && (digits > 0 || c == '/' || c == '-');
        }
    }
    return good;
}

// The index of a vertex by its number: from 1, or from the end if negative; nothing if
// it does not exist.
inline std::optional<std::uint32_t> place_of(int number, std::size_t count) {
    const auto all = static_cast<long long>(count);
    const long long place = number > 0 ? number - 1LL : number + all;
    if (number == 0 || place < 0 || place >= all) return std::nullopt;
    return static_cast<std::uint32_t>(place);
}

// tinyobjloader's exponents overflow from ten digits on. In a word with such a number
// the letter E is replaced by one that ends the number; numbers_of() then refuses it.
inline void blunt_exponents(std::string& text) {
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    bool number = true; // whether the word up to here is a number
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
