#include <doctest/doctest.h>

#include "ljus/answer.hpp"

TEST_CASE("answer: the number") {
    CHECK(answer() == 42);
    const int asked = question(); // if this throws, no assertion has failed
    CHECK(asked == 6);
}

TEST_CASE("answer: the text") {
    CHECK(text().size() == 10);
}
