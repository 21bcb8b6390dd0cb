#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

#include "ljus/image/color.hpp"

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// The standard, read the other way round and in the longest precision there is: the
// byte is the number of thresholds that the light has reached, threshold k being the
// light whose encoded value is (k - 1/2) / 255.
long double threshold(int k) {
    const long double y = (static_cast<long double>(k) - 0.5L) / 255.0L;
    return y <= 0.04045L ? y / 12.92L : std::pow((y + 0.055L) / 1.055L, 2.4L);
}

} // namespace

TEST_CASE("color: the byte is right at all 765 numbers at and beside the thresholds") {
    int wrong = 0;
    int wrong_in_float = 0;
    for (int k = 1; k <= 255; ++k) {
        const float at = static_cast<float>(threshold(k));
        for (const float x : {std::nextafter(at, 0.0f), at, std::nextafter(at, 2.0f)}) {
            const int right = static_cast<long double>(x) >= threshold(k) ? k : k - 1;
            wrong += ljus::srgb_byte(static_cast<double>(x)) != right;
            const float y = x <= 0.0031308f
                                ? 12.92f * x
                                : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
            wrong_in_float += static_cast<int>(std::floor(255.0f * y + 0.5f)) != right;
        }
    }
    CHECK(wrong == 0);
    CHECK(wrong_in_float > 50); // the reason why it is done in double
}

TEST_CASE("color: every byte comes back from the light that it stands for") {
    for (int k = 0; k <= 255; ++k)
        CHECK(ljus::srgb_byte(ljus::srgb_decode(k / 255.0)) == k);
}

TEST_CASE("color: the byte never falls as the light grows") {
    int last = 0;
    for (int i = 0; i <= 100000; ++i) {
        const int byte = ljus::srgb_byte(i * 1e-5);
        REQUIRE(byte >= last);
        last = byte;
    }
    CHECK(last == 255);
}

TEST_CASE("color: encoding and decoding undo each other") {
    for (int i = 0; i <= 1000; ++i) {
        const double x = i / 1000.0;
        // The standard's two pieces meet at 0.0031308 within 3e-8 only.
        CHECK(std::abs(ljus::srgb_decode(ljus::srgb_encode(x)) - x) < 1e-8);
    }
    CHECK(ljus::srgb_encode(0.5) == doctest::Approx(0.735356983052449));
    CHECK(ljus::srgb_encode(0.18) == doctest::Approx(0.461356129500442));
}

TEST_CASE("color: NaN and negatives are black, infinity is white") {
    for (const double x :
         {not_a_number, -not_a_number, -inf, -1.0, -1e-300, -0.0, 0.0, 1e-300}) {
        CAPTURE(x);
        CHECK(ljus::srgb_byte(x) == 0);
        CHECK(ljus::srgb_byte(ljus::srgb_decode(x)) == 0);
        if (x > 0.0) continue;
        CHECK(ljus::srgb_encode(x) == 0.0); // a byte of NaN may be 0 by chance
        CHECK(ljus::srgb_decode(x) == 0.0);
    }
    for (const double x : {1.0, 1.0000001, 1e300, inf}) {
        CAPTURE(x);
        CHECK(ljus::srgb_byte(x) == 255);
        CHECK(ljus::srgb_encode(x) == doctest::Approx(1.0).epsilon(1e-15));
        CHECK(ljus::srgb_decode(x) == 1.0);
    }
}

TEST_CASE("color: the luminance of white is 1, and green is the brightest") {
    CHECK(ljus::luminance(ljus::RgbT<double>{1, 1, 1}) == doctest::Approx(1.0));
    CHECK(ljus::luminance(ljus::RgbT<double>{1, 0, 0}) == 0.2126);
    CHECK(ljus::luminance(ljus::RgbT<double>{0, 1, 0}) == 0.7152);
    CHECK(ljus::luminance(ljus::RgbT<double>{0, 0, 1}) == 0.0722);
}
