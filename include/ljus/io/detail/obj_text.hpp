#pragma once

/// \file ljus/io/detail/obj_text.hpp
/// \brief The lines, words and numbers of a mesh file and of a material file.

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include <glm/vec3.hpp>

namespace ljus {

/// \addtogroup obj_reader
/// \{

namespace detail {

// Takes a line from the front of a text; it ends in LF, CR or CR LF.
inline std::string_view take_line(std::string_view& text) {
    const auto ends = [](char c) { return c == '\n' || c == '\r'; };
    const auto end = static_cast<std::size_t>(
        std::find_if(text.begin(), text.end(), ends) - text.begin());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    if (!text.empty()) text.remove_prefix(text.starts_with("\r\n") ? 2 : 1);
    return line;
}

// Calls use(line, number) for each line of a text, numbered from 1. A line that ends in
// a backslash goes on with the next one.
template <typename Use>
void each_line(std::string_view text, Use use) {
    std::string joined;
    for (long long number = 1, next = 1; !text.empty(); number = next) {
        std::string_view line = take_line(text);
        ++next;
        if (line.ends_with('\\') && !text.empty()) {
            for (joined.clear(); line.ends_with('\\') && !text.empty(); ++next) {
                joined.append(line.substr(0, line.size() - 1)).append(" ");
                line = take_line(text);
            }
            line = joined.append(line);
        }
        use(line, number);
    }
}

inline constexpr std::string_view blanks = " \t";

// A text without the blanks around it.
inline std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

// The words of a line, one after another. A word that begins with # begins a comment.
struct Words {
    std::string_view rest; // of the line

    // The next word; empty at the end.
    std::string_view next() {
        rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
        if (rest.starts_with('#')) rest = {};
        const std::size_t end = std::min(rest.find_first_of(blanks), rest.size());
        const std::string_view word = rest.substr(0, end);
        rest.remove_prefix(end);
        return word;
    }
    // All that is left: a name, which may have blanks in it, a # that no blank follows,
    // and quotation marks around it.
    [[nodiscard]] std::string name() const {
        std::string_view text = trimmed(rest.substr(0, rest.find(" # ")));
        if (text.size() > 2 && text[0] == '"' && text.find('"', 1) == text.size() - 1)
            text = text.substr(1, text.size() - 2);
        return std::string(text);
    }
};

// Whether two words are the same in small letters: programs write map_Kd and map_kd.
inline bool same_word(std::string_view a, std::string_view b) {
    const auto small = [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char c, char d) { return small(c) == small(d); });
}

// The number that a word is, 0 if it is too small for double; NaN for anything else.
inline double number_of(std::string_view word) {
    if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop == end && error == std::errc{}) return value;
    const bool tiny = stop == end && error == std::errc::result_out_of_range &&
                      word.find_first_of("eE") + 1 == word.find('-', 1);
    return tiny ? 0 : std::numeric_limits<double>::quiet_NaN();
}

// The next three numbers of a line.
inline glm::dvec3 three_numbers(Words& words) {
    const double x = number_of(words.next()), y = number_of(words.next());
    return {x, y, number_of(words.next())};
}

// A corner of a face as it is written, "1/2/3", "1//3" or "-1": which vertex, texture
// coordinate and normal, counted from 1 or, if negative, from the end. 0 for none, and
// the largest number, which no list has, for a 0 that is written.
struct ObjIndices {
    long long position = 0, uv = 0, normal = 0;
};

// Reads a corner; nothing if it is written otherwise.
inline std::optional<ObjIndices> indices_of(std::string_view word) {
    ObjIndices result;
    for (long long* const number : {&result.position, &result.uv, &result.normal}) {
        const std::size_t end = std::min(word.find('/'), word.size());
        const char* const last = word.data() + end;
        const auto [stop, error] = std::from_chars(word.data(), last, *number);
        if (end > 0 && (stop != last || error != std::errc{})) return std::nullopt;
        if (end > 0 && *number == 0) *number = std::numeric_limits<long long>::max();
        word.remove_prefix(end);
        if (word.empty()) break;
        word.remove_prefix(1);
    }
    if (!word.empty() || result.position == 0) return std::nullopt;
    return result;
}

// The index that a number of an OBJ file means in a list of `count`; nothing if out of
// range.
inline std::optional<std::uint32_t> place_of(long long number, std::size_t count) {
    const auto all = static_cast<long long>(count);
    if (number == 0 || number > all || number < -all) return std::nullopt;
    return static_cast<std::uint32_t>(number > 0 ? number - 1 : number + all);
}

} // namespace detail

/// \}

} // namespace ljus
