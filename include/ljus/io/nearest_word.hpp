#pragma once

/// \file ljus/io/nearest_word.hpp
/// \brief Finds the known word that is most like an unknown word.

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ljus/version.hpp"

namespace ljus {

/// \defgroup nearest_word Did you mean
/// \brief The word that a message proposes in place of a wrong one.
/// \{

namespace detail {

// Whether a word is one of a list.
inline bool is_one_of(std::string_view word, std::span<const std::string_view> list) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

// Whether a character is a letter, a digit or _.
inline bool is_word_letter(char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') ||
           (c >= 'a' && c <= 'z');
}

// Whether two letters are equal but for capitals.
inline bool same_letter(char a, char b) {
    const auto small = [](char c) {
        return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    };
    return small(a) == small(b);
}

} // namespace detail

/// The smallest number of edits that turn one word into another. An edit inserts,
/// removes or replaces a letter, or exchanges two neighbouring letters; no letter is
/// edited twice. Capital and small letters count as equal.
/// \cost O(n m) for n and m letters.
[[nodiscard]] inline std::size_t edit_distance(std::string_view from,
                                               std::string_view to) {
    using detail::same_letter;
    // Rows of the table for the first i - 2, i - 1 and i letters of `from`.
    std::vector<std::size_t> before, last(to.size() + 1), row(to.size() + 1);
    for (std::size_t k = 0; k <= to.size(); ++k) last[k] = k;
    for (std::size_t i = 1; i <= from.size(); ++i) {
        row[0] = i;
        for (std::size_t k = 1; k <= to.size(); ++k) {
            const std::size_t replaced =
                last[k - 1] + !same_letter(from[i - 1], to[k - 1]);
            row[k] = std::min({last[k] + 1, row[k - 1] + 1, replaced});
            if (i > 1 && k > 1 && same_letter(from[i - 1], to[k - 2]) &&
                same_letter(from[i - 2], to[k - 1]))
                row[k] = std::min(row[k], before[k - 2] + 1);
        }
        before = last;
        std::swap(last, row);
    }
    return last[to.size()];
}

/// The word of `words` that is most like `word`.
/// \return The word with the smallest edit distance, if this distance is at most 1, or
///         at most a third of the length of `word`. Otherwise the nearest word that
///         contains `word` or is a part of `word`, if both have three letters or more.
///         The first of equally near words is returned. An empty text if none is near,
///         or if several words contain `word` and the nearest is not a part of them.
template <typename Words>
[[nodiscard]] std::string nearest_word(std::string_view word, const Words& words) {
    constexpr std::size_t longest = 40, shortest = 3;
    std::string found;
    if (word.size() > longest) return found;
    const std::size_t most = std::max<std::size_t>(1, word.size() / 3);
    std::size_t least = longest;
    for (const std::string_view known : words) {
        std::size_t distance = edit_distance(word, known);
        if (distance > most) {
            const bool within =
                std::min(word.size(), known.size()) >= shortest &&
                (known.find(word) != known.npos || word.find(known) != word.npos);
            if (!within) continue;
            distance += most;
        }
        if (distance >= least) continue;
        least = distance;
        found = known;
    }
    if (least > most)
        for (const std::string_view known : words)
            if (known.find(word) != known.npos && known.find(found) == known.npos)
                return {};
    return found;
}

/// \}

} // namespace ljus
