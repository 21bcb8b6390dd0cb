// concept: load_json
/// \file nearest_word_test.cpp
/// \brief Edit distances against the recursion that defines them.

#include "ljus/io/nearest_word.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "support/numbers.hpp"

using namespace ljus;

namespace {

/// The definition, without a table.
std::size_t by_recursion(std::string_view a, std::string_view b) {
    if (a.empty() || b.empty()) return a.size() + b.size();
    const auto rest = [](std::string_view s, std::size_t n) {
        return s.substr(0, s.size() - n);
    };
    std::size_t least =
        std::min({by_recursion(rest(a, 1), b) + 1, by_recursion(a, rest(b, 1)) + 1,
                  by_recursion(rest(a, 1), rest(b, 1)) + (a.back() != b.back())});
    if (a.size() > 1 && b.size() > 1 && a.back() == b[b.size() - 2] &&
        a[a.size() - 2] == b.back())
        least = std::min(least, by_recursion(rest(a, 2), rest(b, 2)) + 1);
    return least;
}

} // namespace

TEST_CASE("nearest word: the edit distance is that of its definition") {
    CHECK(edit_distance("", "") == 0);
    CHECK(edit_distance("radius", "radius") == 0);
    CHECK(edit_distance("radius", "radios") == 1);
    CHECK(edit_distance("radius", "raduis") == 1);
    CHECK(edit_distance("Radius", "radius") == 0);
    CHECK(edit_distance("", "abc") == 3);
    ljus_test::Numbers n;
    const auto word = [&] {
        std::string text(std::size_t(n.below(6)), 'a');
        for (char& c : text) c = char('a' + n.below(3));
        return text;
    };
    for (int i = 0; i < 2000; ++i) {
        const std::string a = word(), b = word();
        CAPTURE(a);
        CAPTURE(b);
        CHECK(edit_distance(a, b) == by_recursion(a, b));
    }
}

TEST_CASE("nearest word: what is near is proposed, and nothing else") {
    const std::vector<std::string> words{"lambertian", "mirror",      "oren-nayar-full",
                                         "oren-nayar", "dielectric",  "thin-glass",
                                         "fon",        "rough-glass", "eon"};
    CHECK(nearest_word("lambert", words) == "lambertian");
    CHECK(nearest_word("Mirror", words) == "mirror");
    CHECK(nearest_word("miror", words) == "mirror");
    CHECK(nearest_word("mirrors", words) == "mirror");
    CHECK(nearest_word("thin", words) == "thin-glass");
    CHECK(nearest_word("oren", words) == "oren-nayar"); // a part of the other
    CHECK(nearest_word("glass", words).empty());        // which of two?
    CHECK(nearest_word("rough-glass-pane", words) == "rough-glass");
    CHECK(nearest_word("fom", words) == "fon"); // the first of two
    CHECK(nearest_word("dielectirc", words) == "dielectric");
    CHECK(nearest_word("plastic", words).empty());
    CHECK(nearest_word("", words).empty());
    std::string many(1000, 'x');
    many += "mirror";
    CHECK(nearest_word(many, words).empty());
    CHECK(nearest_word("o", words).empty());
}
