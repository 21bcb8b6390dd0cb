#include <doctest/doctest.h>

#include <clocale>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>

#include "ljus/math/require.hpp"

using namespace ljus;

namespace {

const float nan_value = std::numeric_limits<float>::quiet_NaN();
const float infinite = std::numeric_limits<float>::infinity();
const float smallest = std::numeric_limits<float>::denorm_min();

} // namespace

TEST_CASE("require: the sentence says what, its value, and what would be right") {
    CHECK_THROWS_WITH_AS(require_positive("sphere.radius", -1.0f),
                         "sphere.radius is -1; it must be finite and above 0.",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(require_at_least("samples", 0, 1),
                         "samples is 0; it must be at least 1.", std::invalid_argument);
    CHECK_THROWS_WITH_AS(require(false, "camera.width", 0LL, "above 0"),
                         "camera.width is 0; it must be above 0.",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(
        require_finite("ray.origin", Vec3{1, nan_value, -infinite}),
        "ray.origin is (1, NaN, -infinity); it must be finite in every component.",
        std::invalid_argument);
}

TEST_CASE("require: a number has a point in every country") {
    const char* const before = std::setlocale(LC_ALL, nullptr);
    const std::string country = before == nullptr ? "C" : before;
    bool found = false;
    for (const char* name :
         {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "sv_SE.UTF-8", "fr_FR.UTF-8"})
        found = found || std::setlocale(LC_ALL, name) != nullptr;
    if (!found) MESSAGE("no country with a comma is installed: only the text is tried");
    CHECK(to_text(0.5f) == "0.5");
    CHECK(to_text(1.5e-7) == "1.5e-7");
    std::setlocale(LC_ALL, country.c_str());
    char half[] = "1,5e-07", whole[] = "15";
    CHECK(std::string(detail::with_point(half)) == "1.5e-07");
    CHECK(std::string(detail::with_point(whole)) == "15");
}

TEST_CASE("require: a vector without a direction, and one too long for its square") {
    CHECK_NOTHROW(require_direction("up", Vec3{1e-30f, 0, 0}));
    CHECK_THROWS_WITH(require_direction("up", Vec3{0}),
                      "up is (0, 0, 0); it must be finite and not 0, for it gives a "
                      "direction.");
    for (const double length : {1e-170, 1e200})
        CHECK_THROWS_WITH(require_direction("up", Vec3T<double>{length, 0, 0}),
                          doctest::Contains("between 1e-150 and 1e150 long"));
}

TEST_CASE("require: what holds passes in silence") {
    CHECK_NOTHROW(require(true, "anything", 1.0, "right"));
    CHECK_NOTHROW(require_at_least("samples", 1, 1));
    CHECK_NOTHROW(require_finite("v", Vec3{0, -1, 1e30f}));
}

TEST_CASE("require: positive is finite and above zero") {
    CHECK_NOTHROW(require_positive("x", smallest));
    CHECK_NOTHROW(require_positive("x", std::numeric_limits<float>::max()));
    for (const float bad : {0.0f, -0.0f, -smallest, nan_value, infinite, -infinite})
        CHECK_THROWS_AS(require_positive("x", bad), std::invalid_argument);
}

TEST_CASE("require: the unit interval has both its ends") {
    for (const float good : {0.0f, -0.0f, 0.5f, 1.0f})
        CHECK_NOTHROW(require_unit("x", good));
    for (const float bad : {-smallest, std::nextafter(1.0f, 2.0f), nan_value, infinite})
        CHECK_THROWS_AS(require_unit("x", bad), std::invalid_argument);
}

TEST_CASE("require: a colour is checked in every channel") {
    CHECK_NOTHROW(require_unit("albedo", Rgb{0, 0.5f, 1}));
    CHECK_NOTHROW(require_unit("albedo", Rgb{0.0f}));
    CHECK_NOTHROW(require_unit("albedo", Rgb{1.0f}));
    CHECK_NOTHROW(require_radiance("light", Rgb{0, 15, 1e6f}));
    CHECK_NOTHROW(require_radiance("light", Rgb{0.0f}));
    for (int channel = 0; channel < 3; ++channel) {
        for (const float bad : {-0.1f, 1.1f, nan_value, infinite}) {
            Rgb albedo{0.5f};
            albedo[channel] = bad;
            CHECK_THROWS_AS(require_unit("albedo", albedo), std::invalid_argument);
        }
        for (const float bad : {-0.1f, nan_value, infinite}) {
            Rgb radiance{0.5f};
            radiance[channel] = bad;
            CHECK_THROWS_AS(require_radiance("light", radiance), std::invalid_argument);
        }
    }
}

TEST_CASE("require: a number reads as a person writes it") {
    CHECK(to_text(0.0f) == "0");
    CHECK(to_text(-1.0f) == "-1");
    CHECK(to_text(0.5f) == "0.5");
    CHECK(to_text(0.1f) == "0.1");
    CHECK(to_text(0.1) == "0.1");
    CHECK(to_text(100.0f) == "100");
    CHECK(to_text(2000.0) == "2000");
    CHECK(to_text(123456.0f) == "123456");
    CHECK(to_text(16777216.0f) == "16777216");
    CHECK(to_text(1e-7f) == "1e-7");
    CHECK(to_text(-2e-8) == "-2e-8");
    CHECK(to_text(1.2e-5f) == "1.2e-5");
    CHECK(to_text(1e30f) == "1e+30");
    CHECK(to_text(1e6f) == "1e+6");
    CHECK(to_text(1e-300) == "1e-300");
    CHECK(to_text(nan_value) == "NaN");
    CHECK(to_text(-nan_value) == "NaN");
    CHECK(to_text(infinite) == "infinity");
    CHECK(to_text(-infinite) == "-infinity");
    CHECK(to_text(Vec3{-0.25f, 1e9f, nan_value}) == "(-0.25, 1e+9, NaN)");
    CHECK(to_text(-17LL) == "-17");
    CHECK(to_text(std::numeric_limits<long long>::min()) == "-9223372036854775808");
    CHECK(to_text(-2.2250738585072014e-308) == "-2.2250738585072014e-308");
    CHECK(to_text(1.5e-10f) == "1.5e-10");
    CHECK(to_text(123457.0) == "123457");
    CHECK(to_text(100000.0f) == "100000");
}

TEST_CASE("require: a number just outside its range is not shown as the range's end") {
    CHECK(to_text(std::nextafter(1.0f, 2.0f)) == "1.0000001");
    CHECK(to_text(std::nextafter(1.0, 2.0)) == "1.0000000000000002");
    CHECK_THROWS_WITH_AS(require_unit("albedo", std::nextafter(1.0f, 2.0f)),
                         "albedo is 1.0000001; it must be within [0, 1].",
                         std::invalid_argument);
}

TEST_CASE_TEMPLATE("require: what is shown is the value itself", T, float, double) {
    std::uint64_t state = 1;
    for (int i = 0; i < 20000; ++i) {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        const int exponent = static_cast<int>(state >> 40) % 70 - 35;
        const T value = std::ldexp(static_cast<T>(state >> 11) / T(0x1p53), exponent);
        REQUIRE(static_cast<T>(std::strtod(to_text(value).c_str(), nullptr)) == value);
    }
}

TEST_CASE("require: several numbers are a vector, one is not") {
    CHECK(detail::numbers_to_text({0.5}, false) == "0.5");
    CHECK(detail::numbers_to_text({0.5, -1}, false) == "(0.5, -1)");
    CHECK(detail::numbers_to_text({1, 2, 1e-7, 4}, true) == "(1, 2, 1e-7, 4)");
    // As many digits as the precision has: of a float that is a double, more.
    CHECK(detail::numbers_to_text({double(0.1f)}, true) == "0.1");
    CHECK(detail::numbers_to_text({double(0.1f)}, false) == "0.10000000149011612");
}
