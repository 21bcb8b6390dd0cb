#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "../examples/common/terminal.hpp"

TEST_CASE("terminal: durations as people read them") {
    CHECK(examples::duration_text(0) == "0:00");
    CHECK(examples::duration_text(7.4) == "0:07");
    CHECK(examples::duration_text(59.6) == "1:00");
    CHECK(examples::duration_text(754) == "12:34");
    CHECK(examples::duration_text(3599.4) == "59:59");
    CHECK(examples::duration_text(11220) == "3:07:00");
    CHECK(examples::duration_text(-1) == "?");
    CHECK(examples::duration_text(1e300) == "?");
    CHECK(examples::duration_text(std::numeric_limits<double>::quiet_NaN()) == "?");
}

TEST_CASE("terminal: a bar shows its part and the time that is left") {
    CHECK(examples::bar_text("render", 0.5, 12.0) ==
          "render  [###############...............]   50 %  0:12 left");
    CHECK(examples::bar_text("render", 1.0, 12.0) ==
          "render  [##############################]  100 %  0:00 left");
    CHECK(examples::bar_text("trace", 0.0, 0.0) ==
          "trace  [..............................]    0 %");
    CHECK(examples::bar_text("trace", 0.1, 9.0) ==
          "trace  [###...........................]   10 %  1:21 left");
}

TEST_CASE("terminal: a bar lets the loop go on until there is a signal") {
    examples::handle_signals();
    examples::ProgressBar bar("test", true);
    CHECK(bar(1, 10));
    CHECK(bar(0, 0));
    std::raise(SIGINT);
    CHECK_FALSE(bar(2, 10));
    CHECK(examples::stop_signal() == SIGINT);
    CHECK_THROWS_AS(examples::stop_if_asked(), examples::Interrupted);
    examples::handle_signals(); // a new program begins without
    CHECK(bar(3, 10));
    CHECK_NOTHROW(examples::stop_if_asked());
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

TEST_CASE("terminal: a stop watch goes forward") {
    examples::StopWatch watch;
    const double first = watch.seconds();
    CHECK(first >= 0.0);
    CHECK(watch.seconds() >= first);
    watch.restart();
    CHECK(watch.seconds() < 60.0);
}
