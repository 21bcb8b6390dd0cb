#include "answer_test.cpp"

TEST_CASE("fails unbroken: what no header can mend") {
    CHECK(answer() == 41);
}
