#pragma once

/// \file ljus/io/detail/parse.hpp
/// \brief Reads lines, words and numbers from text files, and numbers from binary
/// files.

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <glm/vec3.hpp>

#include "ljus/io/file.hpp"
#include "ljus/io/nearest_word.hpp"

namespace ljus::detail {

// The unsigned number in at most 8 bytes. The last byte is the highest or, with
// `high_first`, the first.
inline std::uint64_t unsigned_value(std::string_view bytes, bool high_first = false) {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < bytes.size(); ++k)
        bits = bits << 8 |
               static_cast<unsigned char>(bytes[high_first ? k : bytes.size() - 1 - k]);
    return bits;
}

// The signed ('i'), unsigned ('u') or floating-point ('f') number in some bytes.
inline double binary_number(std::string_view bytes, char kind,
                            bool high_first = false) {
    const std::uint64_t bits = unsigned_value(bytes, high_first);
    if (kind == 'f')
        return bytes.size() == 4
                   ? double(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                   : std::bit_cast<double>(bits);
    const double value = static_cast<double>(bits);
    const double range = std::ldexp(1, 8 * static_cast<int>(bytes.size()));
    return kind == 'i' && value >= range / 2 ? value - range : value;
}

// Removes the first line from a text and returns it. A line ends in LF, CR or CR LF.
inline std::string_view take_line(std::string_view& text) {
    const auto ends = [](char c) { return c == '\n' || c == '\r'; };
    const auto end = static_cast<std::size_t>(
        std::find_if(text.begin(), text.end(), ends) - text.begin());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    if (!text.empty()) text.remove_prefix(text.starts_with("\r\n") ? 2 : 1);
    return line;
}

// The lines of a text that comes in pieces, without a byte order mark. A line that ends
// in a backslash is joined with the next line.
struct LineReader {
    const std::string& file; // the name of the file
    long long number = 1;    // of the next line
    std::string joined{};

    // Calls use(line, number) for each line of a piece. A line that reaches the end of
    // a piece may be incomplete, and is left for the next piece, if there is one.
    // Returns the number of bytes that were used.
    template <typename Use>
    std::size_t read(std::string_view piece, bool last, Use use) {
        std::string_view rest = number == 1 ? plain_text(piece, file) : piece;
        while (!rest.empty()) {
            const std::size_t left = rest.size();
            std::string_view line = take_line(rest);
            long long next = number + 1;
            if (line.ends_with('\\') && !rest.empty()) {
                for (joined.clear(); line.ends_with('\\') && !rest.empty(); ++next) {
                    joined.append(line.substr(0, line.size() - 1)).append(" ");
                    line = take_line(rest);
                }
                line = joined.append(line);
            }
            if (rest.empty() && !last) return piece.size() - left;
            use(line, number);
            number = next;
        }
        return piece.size();
    }
};

inline bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

// The words of a line, one after another. A comment begins with #.
struct Words {
    std::string_view rest; // of the line

    // The next word; empty at the end.
    std::string_view next() {
        while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
        if (rest.starts_with('#')) rest = {};
        std::size_t end = 0;
        while (end < rest.size() && !is_blank(rest[end])) ++end;
        const std::string_view word = rest.substr(0, end);
        rest.remove_prefix(end);
        return word;
    }
    // The rest of the line as a name. It may contain blanks and be in quotation marks;
    // a comment begins with a # between blanks.
    [[nodiscard]] std::string name() const {
        std::string_view text = rest.substr(0, rest.find(" # "));
        while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
        while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
        if (text.size() > 2 && text[0] == '"' && text.find('"', 1) == text.size() - 1)
            text = text.substr(1, text.size() - 2);
        return std::string(text);
    }
};

// Whether two words are equal but for capital letters, as map_Kd and map_kd are.
inline bool same_word(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_letter);
}

// Counts the lines that begin with keywords that the reader does not use. A keyword
// with other characters than letters, digits and _ is ignored.
class UnusedLines {
public:
    void add(std::string_view keyword, long long line) {
        if (!std::all_of(keyword.begin(), keyword.end(), is_word_letter)) return;
        if (words_.size() < most || words_.contains(keyword))
            ++words_.try_emplace(std::string(keyword), Found{0, line})
                  .first->second.count;
    }
    // Adds one note for each keyword, with the number of its first line.
    void tell(const std::string& file, std::vector<std::string>& notes) const {
        for (const auto& [word, at] : words_)
            notes.push_back(join({shown_path(file), ", line ", to_text(at.line), ": ",
                                  to_text(at.count), " lines begin with ", shown(word),
                                  "; they are not used."}));
    }

private:
    static constexpr std::size_t most = 20;
    struct Found {
        long long count, line;
    };
    std::map<std::string, Found, std::less<>> words_{};
};

// The number that a word spells; 0 if it is too small for double, NaN for no number.
// Some programs write a comma for the point, as their user's language has it; 1,000 is
// therefore 1.
inline double number_of(std::string_view word) {
    if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop == end && error == std::errc{}) return value;
    const auto at = static_cast<std::size_t>(stop - word.data());
    if (stop != end && *stop == ',' && word.find_first_of(",.", at + 1) == word.npos) {
        std::string with_point(word);
        with_point[at] = '.';
        return number_of(with_point);
    }
    const bool tiny = stop == end && error == std::errc::result_out_of_range &&
                      word.find_first_of("eE") + 1 == word.find('-', 1);
    return tiny ? 0 : std::numeric_limits<double>::quiet_NaN();
}

// The next three numbers of a line.
inline glm::dvec3 three_numbers(Words& words) {
    const double x = number_of(words.next()), y = number_of(words.next());
    return {x, y, number_of(words.next())};
}

} // namespace ljus::detail
