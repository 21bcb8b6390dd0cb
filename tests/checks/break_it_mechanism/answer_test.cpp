#include <doctest/doctest.h>

#include "ljus/answer.hpp"

TEST_CASE("answer: the number") {
    CHECK(answer() == 42);
    const int asked = question(); // if this throws, no assertion has failed
    CHECK(asked == 6);
    CHECK(always_seven == 7);
}

TEST_CASE("answer: the text") {
    CHECK(text().size() == 10);
}

TEST_CASE("answer: the field") {
    const Field<> field(5);
    CHECK(field.above() == 5);
    CHECK(field.above('{') == '{' + 1);
    CHECK(field.sides == 4);
}
