#pragma once

/// \file ljus/path/light_path_expression.hpp
/// \brief Sets of light paths, written in Heckbert's notation: E S*D?L.

#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ljus/version.hpp"

namespace ljus {

/// \defgroup light_path_expression Classes of light paths
/// \brief Regular expressions for sets of light paths. Chapter:
/// \ref ch_light_transport.
///
/// A path is written as a string of letters: E is the eye, D a diffuse or glossy
/// surface, S a mirror or a boundary of glass, and L the light. A class of paths is a
/// regular expression over these letters. It begins at the eye; Heckbert
/// \cite heckbert1990 begins at the light.
/// \{

/// A compiled class of paths: Glushkov's automaton. State 0 is the start. Each letter
/// of the expression is one more state. A set of states has one bit per state.
struct LightPathExpression {
    /// For each state, the set of states that may follow.
    std::array<std::uint64_t, 64> follow{};
    std::array<char, 64> letter{}; ///< Letter of each state: E, D, S, L or '.'.
    std::uint64_t last = 0;        ///< The set of accepting states.

    /// The set of possible states after one more letter of a path, E, D, S or L.
    /// \return Empty if no path of the class begins with these letters.
    [[nodiscard]] constexpr std::uint64_t step(std::uint64_t states,
                                               char next) const noexcept {
        std::uint64_t possible = 0;
        for (; states != 0; states &= states - 1)
            possible |= follow[static_cast<std::size_t>(std::countr_zero(states))];
        std::uint64_t result = 0;
        for (; possible != 0; possible &= possible - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(possible));
            const bool bounce = letter[i] == '.' && (next == 'S' || next == 'D');
            if (letter[i] == next || bounce) result |= std::uint64_t(1) << i;
        }
        return result;
    }
};

namespace detail {

// Parses an expression, and records which letters may follow each letter.
struct LightPathExpressionReader {
    // A subexpression: its first and last states, and whether it may be empty.
    struct Part {
        std::uint64_t first = 0, last = 0;
        bool empty = true;
    };
    LightPathExpression& result;
    std::string_view expression, rest;
    std::size_t letters = 0;  // so far; state 0 is the start
    std::size_t brackets = 0; // opened so far; each nests four calls

    [[noreturn]] void refuse(const char* what) const {
        const std::size_t place = expression.size() - rest.size();
        throw std::invalid_argument(
            std::string("The class of paths '").append(expression) + "' has " + what +
            " at position " + std::to_string(place + 1) +
            "; it may contain E, D, S, L, '.' for D or S, and | ( ) * + ?.");
    }
    [[nodiscard]] constexpr bool at(std::string_view set) const {
        return !rest.empty() && set.find(rest.front()) != std::string_view::npos;
    }
    constexpr char take() {
        const char c = rest.front();
        rest.remove_prefix(1);
        return c;
    }
    constexpr void connect(std::uint64_t from, std::uint64_t to) {
        for (; from != 0; from &= from - 1)
            result.follow[static_cast<std::size_t>(std::countr_zero(from))] |= to;
    }
    constexpr Part alternatives() {
        Part all = sequence();
        while (at("|")) {
            take();
            const Part other = sequence();
            all = {all.first | other.first, all.last | other.last,
                   all.empty || other.empty};
        }
        return all;
    }
    constexpr Part sequence() {
        Part all;
        while (!rest.empty() && !at("|)")) {
            const Part next = repeated();
            connect(all.last, next.first);
            all = {all.first | (all.empty ? next.first : 0),
                   next.last | (next.empty ? all.last : 0), all.empty && next.empty};
        }
        return all;
    }
    constexpr Part repeated() {
        Part part = atom();
        while (at("*+?")) {
            const char sign = take();
            if (sign != '?') connect(part.last, part.first);
            if (sign != '+') part.empty = true;
        }
        return part;
    }
    constexpr Part atom() {
        if (at("(")) {
            if (++brackets == 64) refuse("more than 63 opening brackets");
            take();
            const Part inside = alternatives();
            if (!at(")")) refuse("no closing bracket");
            take();
            return inside;
        }
        if (!at("EDSL.")) refuse("an unexpected character");
        if (++letters == 64) refuse("more than 63 letters");
        result.letter[letters] = take();
        const std::uint64_t bit = std::uint64_t(1) << letters;
        return {bit, bit, false};
    }
};

} // namespace detail

/// Compiles a class of paths, such as "ES*D?L": at most 63 letters E, D, S, L and '.',
/// which stands for D or S, with the usual operators `| ( ) * + ?` and at most 63 pairs
/// of brackets.
/// \throws std::invalid_argument  for an invalid expression, with the position of the
///         error.
[[nodiscard]] constexpr LightPathExpression
light_path_expression(std::string_view expression) {
    LightPathExpression result;
    detail::LightPathExpressionReader reader{result, expression, expression};
    const auto whole = reader.alternatives();
    if (!reader.rest.empty()) reader.refuse("an unmatched closing bracket");
    result.follow[0] = whole.first;
    result.last = whole.last | (whole.empty ? 1u : 0u);
    return result;
}

namespace detail {

/// Whether a whole path, for example "EDSSL", belongs to a class.
/// \cost A few bit operations per letter; allocates no memory.
// [contains]
[[nodiscard]] constexpr bool contains(const LightPathExpression& paths,
                                      std::string_view path) noexcept {
    std::uint64_t states = 1;
    for (const char letter : path) states = paths.step(states, letter);
    return (states & paths.last) != 0;
}
// [contains]

} // namespace detail

/// \}

} // namespace ljus
