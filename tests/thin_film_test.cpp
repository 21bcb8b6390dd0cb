// needs: boost
/// \file thin_film_test.cpp
/// \brief Airy's sum against Airy's series and matrices in 50 digits; the colours
/// against the spectrum.

#include "ljus/optics/thin_film.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <boost/multiprecision/cpp_complex.hpp>

#include "ljus/optics/film_table.hpp"
#include "support/draws.hpp"
#include "support/within.hpp"

using ljus_test::Draws;

namespace {

using Complex = boost::multiprecision::cpp_complex_50;
using Real = Complex::value_type;

Real full_turn() {
    return 8 * atan(Real(1));
}

/// The film as a matrix between the fields at its two faces (Born and Wolf, 1.6), with
/// a complex cosine inside. R, and T of its own: not one minus R.
std::array<Real, 2> by_matrix(const Real& c, const Real& n, const Real& turns) {
    const Complex one(1, 0), i(0, 1), cosine(c, 0), index(n, 0);
    const Complex inside = sqrt(one - (one - cosine * cosine) / (index * index));
    const Complex phase = Complex(full_turn() * turns, 0) * index * inside;
    Real reflected = 0, transmitted = 0;
    for (const bool s : {true, false}) {
        const Complex air = s ? cosine : one / cosine;
        const Complex film = s ? index * inside : index / inside;
        const Complex b = cos(phase) + i * sin(phase) * air / film;
        const Complex d = i * sin(phase) * film + cos(phase) * air;
        reflected += norm((air * b - d) / (air * b + d)) / 2;
        transmitted += norm(Complex(2, 0) * air / (air * b + d)) / 2;
    }
    return {reflected, transmitted};
}

/// Airy's series, wave by wave: the first surface, and then each time round once more.
Real by_series(const Real& c, const Real& n, const Real& turns) {
    const Real inside = sqrt(1 - (1 - c * c) / (n * n));
    const Real delay = 2 * full_turn() * turns * n * inside;
    const Complex round(cos(delay), sin(delay));
    Real sum = 0;
    for (const bool s : {true, false}) {
        const Real r = s ? (c - n * inside) / (c + n * inside)
                         : (n * c - inside) / (n * c + inside);
        // t t' = 1 - r^2; the second surface reflects with -r from within.
        Complex wave = Complex(-r * (1 - r * r), 0) * round;
        Complex field(r, 0);
        for (int k = 0; k < 4000 && norm(wave) > Real(1e-90); ++k) {
            field += wave;
            wave *= Complex(r * r, 0) * round;
        }
        sum += norm(field) / 2;
    }
    return sum;
}

} // namespace

TEST_CASE("thin film: the series of waves and the matrix say the same") {
    Draws draws;
    for (int i = 0; i < 40; ++i) {
        const Real c = draws.between(0.2, 1.0), n = draws.between(1.01, 2.5);
        const Real turns = draws.between(0.0, 4.0);
        const auto [r, t] = by_matrix(c, n, turns);
        CHECK(abs(r + t - 1) < Real(1e-40));
        CHECK(abs(r - by_series(c, n, turns)) < Real(1e-40));
    }
}

TEST_CASE_TEMPLATE("thin film: any index, angle and thickness, as in 50 digits", T,
                   float, double) {
    Draws draws{3};
    const double u = std::numeric_limits<T>::epsilon() / 2;
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
        T c = draws.between<T>(T(0.001), T(1));
        if (i % 4 == 1) c = static_cast<T>(std::pow(10.0, draws.between(-5., 0.)));
        const T n = static_cast<T>(std::pow(10.0, draws.between(-0.5, 0.7)));
        const T d = static_cast<T>(std::pow(10.0, draws.between(-2.0, 3.5)));
        const T wavelength = draws.between<T>(T(380), T(780));
        const auto found = ljus::thin_film(c, n, d, wavelength);
        REQUIRE(found.reflected >= 0);
        REQUIRE(found.reflected <= 1);
        REQUIRE(double(found.reflected) + double(found.transmitted) ==
                doctest::Approx(1).epsilon(4 * u));
        const auto exact = [&](const Real& cosine, const Real& index, const Real& m) {
            return by_matrix(cosine, index, m);
        };
        const Real turns = Real(d) / Real(wavelength);
        const auto [r, t] = exact(c, n, turns);
        Real unit = u;
        for (const Real& moved : {exact(Real(c) * (1 - Real(u)), n, turns)[0],
                                  exact(c, Real(n) * (1 + Real(u)), turns)[0],
                                  exact(c, n, turns * (1 + Real(u)))[0]})
            unit += abs(moved - r);
        worst = std::max(
            worst,
            (abs(Real(found.reflected) - r) / unit).template convert_to<double>());
        worst = std::max(
            worst,
            (abs(Real(found.transmitted) - t) / unit).template convert_to<double>());
    }
    MESSAGE("largest error ", worst, " times u + what the rounding of the inputs does");
    CHECK(worst <= 12);
}

TEST_CASE("thin film: the numbers of a soap film") {
    const auto r = [](double thickness) {
        return ljus::thin_film(1.0, 1.33, thickness, 550.0).reflected;
    };
    CHECK(r(0) == 0);
    CHECK(r(10) == ljus_test::within(0.0019, 0.027)); // black
    double most = 0, at = 0;
    for (int i = 0; i <= 20000; ++i)
        if (const double d = 0.01 * i; r(d) > most) {
            most = r(d);
            at = d;
        }
    CHECK(at == doctest::Approx(550 / (4 * 1.33)).epsilon(1e-4)); // 103.4 nm
    MESSAGE("R(10 nm) = ", r(10), ", at most ", most, " at ", at, " nm");
    const double r0 = std::pow(0.33 / 2.33, 2);
    CHECK(most == doctest::Approx(4 * r0 / ((1 + r0) * (1 + r0))).epsilon(1e-9));
    CHECK(most == ljus_test::within(0.0771, 1e-3));
    CHECK(r(2 * at) < 1e-6); // twice as thick, nothing comes back
    CHECK(ljus::thick_film(1.0, 1.33) ==
          doctest::Approx(2 * r0 / (1 + r0)).epsilon(1e-12));
    CHECK(ljus::thick_film(1.0, 1.33) == ljus_test::within(0.0393, 1.3e-3));
}

TEST_CASE("thin film: all light is reflected or goes through, to 1e-12") {
    Draws draws{5};
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        const double c = i % 10 == 0 ? 0.0 : draws.unit<double>();
        const double n = draws.between(1.0, 3.0);
        const double d = i % 7 == 0 ? 0.0 : draws.between(0.0, 1e6);
        const auto film = ljus::thin_film(c, n, d, draws.between(360.0, 830.0));
        worst = std::max(worst, std::abs(film.reflected + film.transmitted - 1));
        REQUIRE(worst <= 1e-12);
        REQUIRE(film.reflected >= 0);
        if (d == 0) REQUIRE(film.reflected == 0);
        const double mean = ljus::thick_film(c, n);
        REQUIRE(mean >= 0);
        REQUIRE(mean <= 1);
    }
    MESSAGE("|R + T - 1| is at most ", worst);
}

TEST_CASE("thin film: where nothing is refracted, light tunnels through a thin gap") {
    // A gap of air within glass: 1/1.5, at 60 degrees. As thick as the wavelength it is
    // a mirror, as thin as a tenth it is not.
    CHECK(ljus::thin_film(0.5, 1 / 1.5, 600.0, 600.0).reflected > 0.99);
    CHECK(ljus::thin_film(0.5, 1 / 1.5, 60.0, 600.0).reflected < 0.6);
    CHECK(ljus::thin_film(0.5, 1 / 1.5, 1e9, 600.0).reflected == 1); // sinh is infinite
    CHECK(ljus::thin_film(0.5, 1 / 1.5, 1e9, 600.0).transmitted == 0);
}

TEST_CASE("observer: near the CIE's table, and each function has the same integral") {
    const double table[][4] = {{450, 0.3362, 0.0380, 1.7721},
                               {500, 0.0049, 0.3230, 0.2720},
                               {555, 0.5121, 1.0000, 0.0057},
                               {600, 1.0622, 0.6310, 0.0008},
                               {650, 0.2835, 0.1070, 0.0000}};
    for (const auto& row : table) {
        const auto eye = ljus::cie_observer(row[0]);
        for (int i = 0; i < 3; ++i) CHECK(std::abs(eye[i] - row[i + 1]) < 0.03);
    }
    glm::dvec3 sum{0};
    for (int nm = 360; nm < 830; ++nm) sum += ljus::cie_observer(nm + 0.5);
    for (int i = 0; i < 3; ++i) CHECK(sum[i] == doctest::Approx(106.9).epsilon(5e-3));
    // A flat spectrum is white; light of 550 nm alone is greener than any screen.
    const auto white = ljus::spectrum_color<double>([](double) { return 1.0; });
    for (int i = 0; i < 3; ++i) CHECK(white[i] == doctest::Approx(1).epsilon(1e-12));
    CHECK(ljus::xyz_to_rgb(ljus::cie_observer(550.0)).x < 0);
}

TEST_CASE("observer: a colour that cannot be shown keeps its luminance") {
    Draws draws{7};
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 c{draws.between(-0.5, 1.5), draws.between(-0.5, 1.5),
                           draws.between(-0.5, 1.5)};
        const double y = ljus::luminance(c);
        const glm::dvec3 shown = ljus::into_gamut(c);
        for (int k = 0; k < 3; ++k) {
            REQUIRE(shown[k] >= 0);
            REQUIRE(shown[k] <= 1);
        }
        if (y >= 0 && y <= 1)
            REQUIRE(ljus::luminance(shown) == doctest::Approx(y).epsilon(1e-12));
    }
    const glm::dvec3 possible{0.2, 0.3, 0.4};
    CHECK(ljus::into_gamut(possible) == possible);
}

TEST_CASE("film colours: black without thickness, grey with a millimetre") {
    for (const double c : {1.0, 0.7, 0.3}) {
        const auto black = ljus::film_spectral(c, 1.33, 0.0);
        const auto grey = ljus::film_spectral(c, 1.33, 1e6);
        for (int i = 0; i < 3; ++i) {
            CHECK(black[i] == 0);
            CHECK(grey[i] == doctest::Approx(ljus::thick_film(c, 1.33)).epsilon(1e-5));
            CHECK(ljus::film_preintegrated(c, 1.33, 1e6)[i] ==
                  doctest::Approx(ljus::thick_film(c, 1.33)).epsilon(1e-9));
            CHECK(std::abs(ljus::film_preintegrated(c, 1.33, 0.0)[i]) < 5e-3);
        }
    }
    // By three wavelengths a film of 1 mm is still coloured: wrong.
    const auto three = ljus::film_three(1.0, 1.33, 1e6);
    CHECK(three.z < 0.1 * three.x);
}

TEST_CASE("film colours: the integrals made beforehand are near the spectrum") {
    double worst = 0, three = 0;
    for (int d = 0; d <= 1500; d += 10)
        for (const double c : {1.0, 0.8, 0.6}) {
            const auto right = ljus::film_spectral(c, 1.33, double(d));
            const auto distance = [&](const glm::dvec3& color) {
                return ljus::max_component(glm::abs(color - right));
            };
            worst =
                std::max(worst, distance(ljus::film_preintegrated(c, 1.33, double(d))));
            three = std::max(three, distance(ljus::film_three(c, 1.33, double(d))));
        }
    MESSAGE("largest distance ", worst, ", of three wavelengths ", three);
    CHECK(worst < 0.012);
    CHECK(three > 0.04);
}

TEST_CASE(
    "film table: as the spectrum, from the thinnest film (5 nm) to the thickest") {
    const auto table = ljus::bake_film_table(1.33);
    CHECK(table.greyed > 0);
    CHECK(table.worst < 0);
    Draws draws{11};
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
        const double c = i % 3 == 0 ? std::pow(10.0, draws.between(-3.0, 0.0))
                                    : draws.unit<double>();
        const double d = i % 5 == 0 ? std::pow(10.0, draws.between(0.7, 1.0))
                                    : draws.between(0.0, 3500.0);
        const auto right = ljus::into_gamut(ljus::film_spectral(c, 1.33, d));
        const auto found = ljus::look_up(table, c, d);
        worst = std::max(worst, ljus::max_component(glm::abs(found - right)));
        for (int k = 0; k < 3; ++k) {
            REQUIRE(found[k] >= 0);
            REQUIRE(found[k] <= 1);
        }
    }
    MESSAGE("largest distance ", worst);
    CHECK(worst < 0.04); // at grazing angles, where R goes from 0.1 to 1
    // Thicker than the table: the mean. At both ends of both axes.
    for (const double c : {0.0, 0.25, 1.0}) {
        CHECK(ljus::look_up(table, c, 1e6).x ==
              ljus_test::within(ljus::thick_film(c, 1.33), 2e-3));
        CHECK(ljus::look_up(table, c, 0.0) == glm::dvec3(0));
    }
    CHECK(std::isfinite(ljus::look_up(table, 1.0, double(INFINITY)).x));
    CHECK(std::isfinite(ljus::look_up(table, 0.5, double(NAN)).x));
}

TEST_CASE("film table: an index or a size that cannot be is refused by name") {
    for (const float index : {0.0f, -1.0f, 0.9f, NAN, INFINITY})
        CHECK_THROWS_AS((void)ljus::bake_film_table(index), std::invalid_argument);
    CHECK_THROWS_AS((void)ljus::bake_film_table(1.33f, {.cosines = 1}),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)ljus::bake_film_table(1.33f, {.paths = 1}),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)ljus::bake_film_table(1.33f, {.longest = 0}),
                    std::invalid_argument);
    const auto none = ljus::bake_film_table(1.0f, {.cosines = 2, .paths = 2});
    for (const auto& cell : none.cells) CHECK(cell == ljus::Rgb{0}); // air is no film
}

TEST_CASE_TEMPLATE(
    "thin film: shares of light at every angle and thickness, the grazing "
    "angle and a film of hardly an atom among them",
    T, float, double) {
    Draws draws{41};
    const double least = sizeof(T) == 4 ? -44 : -320;
    int wrong = 0, three = 0, integrated = 0;
    const auto share = [](T x) { return x >= 0 && x <= 1; };
    for (int i = 0; i < 100000; ++i) {
        const auto small = [&] { return T(std::pow(10.0, draws.between(least, 0.0))); };
        const T c = i % 3 == 0 ? T(0) : i % 3 == 1 ? small() : draws.unit<T>();
        const T d = i % 2 ? T(1e6) * small() : draws.between(T(0), T(1e6));
        const T n = i % 7 == 0 ? T(1) : draws.between(T(1), T(5));
        const T index = i % 11 == 0 ? draws.between(T(0.001), T(1)) : n;
        const auto film = ljus::thin_film(c, index, d, draws.between(T(380), T(780)));
        wrong += !share(film.reflected) || !share(film.transmitted) ||
                 !(std::abs(film.reflected + film.transmitted - T(1)) < T(1e-6));
        const auto color = ljus::film_three(c, index, d);
        three += !share(color.x) || !share(color.y) || !share(color.z);
        integrated += !ljus::is_finite(ljus::film_preintegrated(c, n, d));
    }
    CHECK(wrong == 0);
    CHECK(three == 0);
    CHECK(integrated == 0);
    // Found from outside: the limit from each thickness is a mirror.
    CHECK(ljus::thin_film(T(0), T(1.33), T(1e-30), T(550)).reflected == 1);
    CHECK(ljus::thin_film(T(0), T(1.33), T(1e-30), T(550)).transmitted == 0);
}

TEST_CASE("film colour: three wavelengths, one a channel") {
    const auto three = ljus::film_three(0.7, 1.33, 400.0);
    const auto at = [](double wavelength) {
        return ljus::thin_film(0.7, 1.33, 400.0, wavelength).reflected;
    };
    CHECK(three.x == at(611.4));
    CHECK(three.y == at(549.1));
    CHECK(three.z == at(464.3));
}

TEST_CASE("film colour: a table by hand, to its last row and behind it") {
    // Rows at the paths 0, 1 and 4, and the mean; an index of 1 bends nothing.
    const auto row = [](double value) { return ljus::RgbT<double>(value); };
    const ljus::FilmTableT<double> table{
        .index = 1,
        .cosines = 2,
        .paths = 3,
        .longest = 4,
        .cells = {row(1), row(1), row(2), row(2), row(3), row(3), row(9), row(9),
                  row(INFINITY)}}; // one more than it has: not read
    const auto at = [&](double path) { return look_up(table, 1.0, path).x; };
    CHECK(at(0) == 1);
    CHECK(at(0.25) == 1.5);
    CHECK(at(2.25) == 2.5);
    CHECK(at(3.9) == doctest::Approx(1 + std::sqrt(3.9)));
    CHECK(at(4) == 9);
    CHECK(at(1e30) == 9);
}

TEST_CASE("observer: the fit's published constants, typed a second time") {
    // By another program, to 15 digits: a wrong digit of one of the 20 constants stays
    // within the 0.03 that the fit is off its table.
    const double eye[][4] = {
        {400, 0.0116744650448092, 0.00128008785546068, 0.0607859949105047},
        {430, 0.27339309010349, 0.0103838790109473, 1.38682275054222},
        {450, 0.343750027963776, 0.0334147995315081, 1.7813850393059},
        {470, 0.191832165335092, 0.0899439551304877, 1.29447339281129},
        {490, 0.0320122096499184, 0.213068788728945, 0.465525385984622},
        {520, 0.0698413627883319, 0.707113377656644, 0.0849914310468925},
        {540, 0.282596864651915, 0.95416943907732, 0.0201784541439252},
        {560, 0.60288764670001, 0.991081639477311, 0.00351836331245985},
        {580, 0.920460516031767, 0.872133790505321, 0.000450337270469693},
        {610, 1.00020491147278, 0.500338539402102, 1.15505746845681e-05},
        {650, 0.283631873380808, 0.110045343268982, 2.96115850313243e-08},
        {700, 0.00561199795848167, 0.00430455402456242, 3.00153837809723e-12}};
    for (const auto& row : eye) {
        const auto found = ljus::cie_observer(row[0]);
        for (int i = 0; i < 3; ++i)
            CHECK(found[i] == doctest::Approx(row[i + 1]).epsilon(1e-12));
    }
}

TEST_CASE("observer: the screen's own red, green and blue, and its white") {
    // By their chromaticities in IEC 61966-2-1; white is X = Y = Z = 1 here.
    const double primaries[][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
    for (int own = 0; own < 3; ++own) {
        const double x = primaries[own][0], y = primaries[own][1];
        const auto rgb = ljus::xyz_to_rgb(
            glm::dvec3(x / y / 0.95047, 1.0, (1 - x - y) / y / 1.08883));
        for (int i = 0; i < 3; ++i)
            if (i != own) CHECK(std::abs(rgb[i]) < 2e-4 * rgb[own]);
    }
    const auto white = ljus::xyz_to_rgb(glm::dvec3(1.0));
    for (int i = 0; i < 3; ++i) CHECK(white[i] == doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("observer: into the gamut by as much grey as needed, and no more") {
    // Grey of the same luminance, by hand: what leaves [0, 1] farthest lies on its
    // border afterwards, and all channels are drawn to the grey in proportion.
    Draws draws{8};
    int mixed = 0;
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 c{draws.between(-0.5, 1.5), draws.between(-0.5, 1.5),
                           draws.between(-0.5, 1.5)};
        const double grey = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
        if (grey <= 0.01 || grey >= 0.99) continue;
        double keep = 1;
        for (const double x : {c.x, c.y, c.z})
            keep = std::min(keep, x < 0   ? grey / (grey - x)
                                  : x > 1 ? (1 - grey) / (x - grey)
                                          : 1.0);
        const auto shown = ljus::into_gamut(c);
        for (int k = 0; k < 3; ++k)
            REQUIRE(std::abs(shown[k] - (grey + keep * (c[k] - grey))) < 1e-12);
        mixed += keep < 1;
    }
    CHECK(mixed > 1000);
    // What can be shown is not even rounded, or the table would count it as greyed.
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 root{draws.between(0.0, 1.0), draws.between(0.0, 1.0),
                              draws.between(0.0, 1.0)};
        const glm::dvec3 c = root * root; // digits below those of the grey
        CHECK(ljus::into_gamut(c) == c);
    }
}

TEST_CASE("film colours: where the spectrum is asked") {
    std::vector<double> asked;
    const auto ask = [&](double nm) { return asked.push_back(nm), 1.0; };
    (void)ljus::spectrum_color<double>(ask);
    REQUIRE(asked.size() == 470);
    CHECK(asked.front() == 360.5);
    CHECK(asked.back() == 829.5);
    // As close as the doc says: the phase 4 pi path / nm moves by 1/2 at 360 nm.
    const double path = 20000 * std::sqrt(ljus::film_cosine2(0.8, 1.33));
    const double step = 0.5 * 360 * 360 / (4 * std::numbers::pi * path);
    const auto count = static_cast<int>(std::ceil(470 / step));
    glm::dvec3 sum{0}, white{0};
    for (int i = 0; i < count; ++i) {
        const double nm = 360 + (i + 0.5) * 470 / count;
        const glm::dvec3 eye = ljus::cie_observer(nm);
        sum += eye * ljus::thin_film(0.8, 1.33, 20000.0, nm).reflected;
        white += eye;
    }
    const auto color = ljus::xyz_to_rgb(sum / white);
    const auto found = ljus::film_spectral(0.8, 1.33, 20000.0);
    for (int k = 0; k < 3; ++k) CHECK(found[k] == ljus_test::within(color[k], 1e-13));
}

TEST_CASE("film colours: the swing that is seen, its constants typed a second time") {
    // By another program from the published Gaussians: X, Y and Z after a delay in nm.
    const double swings[][4] = {
        {0, 1, 1, 1},
        {150, -0.0901767099032, -0.119941880827, -0.485814335481},
        {400, -0.267094775804, -0.187614026124, 0.712853653748},
        {700, 0.217629748481, -0.0352049824604, -0.843625701054},
        {1100, 0.280629320097, 0.633162479724, -0.658279874053},
        {1700, 0.356023120961, 0.327600652737, 0.0126457056684}};
    for (const auto& row : swings) {
        const auto right = ljus::xyz_to_rgb(glm::dvec3(row[1], row[2], row[3]));
        const auto found = ljus::detail::visible_swing(row[0]);
        for (int i = 0; i < 3; ++i)
            CHECK(found[i] == ljus_test::within(right[i], 1e-9));
    }
}

TEST_CASE("film colours: three times round, for each polarisation by itself") {
    // The sum of the doc, with Fresnel's amplitudes by sines and cosines. At a slant
    // the two polarisations differ most; the third time round is R^3 of the whole.
    for (const double c : {0.9, 0.5, 0.15}) {
        const double n = 1.5, d = 350;
        const double inside = std::sqrt(1 - (1 - c * c) / (n * n)); // cosine
        const double s = (c - n * inside) / (c + n * inside);
        const double p = (n * c - inside) / (n * c + inside);
        glm::dvec3 sum{0};
        for (const double r : {s * s, p * p}) {
            glm::dvec3 waves{0};
            for (int k = 1; k <= 3; ++k)
                waves += std::pow(r, k) *
                         ljus::detail::visible_swing(2 * k * d * n * inside);
            sum += r / (1 + r) - (1 - r) / (1 + r) * waves;
        }
        const auto found = ljus::film_preintegrated(c, n, d);
        for (int i = 0; i < 3; ++i) CHECK(std::abs(found[i] - sum[i]) < 1e-13);
    }
}

TEST_CASE("film table: each cell is the spectrum's colour, and what had to be greyed") {
    const auto table =
        ljus::bake_film_table(1.33, {.cosines = 3, .paths = 41, .longest = 1200});
    int greyed = 0;
    double worst = 0, far = 0;
    for (int row = 0; row < 41; ++row)
        for (int column = 0; column < 3; ++column) {
            const double c = column * column / 4.0, path = 1200 * row * row / 1600.0;
            const double d = path / std::sqrt(ljus::film_cosine2(c, 1.33));
            const auto color = ljus::film_spectral(c, 1.33, d);
            greyed += ljus::into_gamut(color) != color;
            worst = std::min({worst, color.x, color.y, color.z});
            const auto cell = table.cells[std::size_t(row * 3 + column)];
            far = std::max(
                far, ljus::max_component(glm::abs(ljus::into_gamut(color) - cell)));
        }
    MESSAGE("farthest ", far, ", worst ", worst, " and ", table.worst);
    CHECK(far < 2e-4);
    CHECK(greyed > 5);
    CHECK(std::abs(table.greyed - greyed) <= 1);
    CHECK(std::abs(table.worst - worst) < 2e-4);
    // Thin films only: the colours ask for close samples, not the fringes.
    const auto thin =
        ljus::bake_film_table(1.33, {.cosines = 2, .paths = 2, .longest = 100});
    const auto right = ljus::into_gamut(ljus::film_spectral(1.0, 1.33, 100 / 1.33));
    for (int i = 0; i < 3; ++i) CHECK(std::abs(thin.cells[3][i] - right[i]) < 1e-5);
}

TEST_CASE("thin film: what is small keeps its digits, and nothing is no film") {
    // Hardly any light goes through at the grazing angle, none is reflected by a film
    // that is nearly air.
    for (const double c : {1e-3, 1e-6, 1e-9}) {
        const auto exact = by_matrix(c, 1.33, Real(150.0) / Real(600.0));
        const double t = exact[1].convert_to<double>();
        CHECK(ljus::thin_film(c, 1.33, 150.0, 600.0).transmitted ==
              ljus_test::within(t, 1e-10));
    }
    const double r0 = std::pow(1e-8 / (2 + 1e-8), 2);
    CHECK(ljus::thick_film(1.0, 1 + 1e-8) ==
          ljus_test::within(2 * r0 / (1 + r0), 1e-6));
    CHECK(ljus::thick_film(0.0, 1.0) == 0);
    CHECK(ljus::thick_film(0.0, 1.33) == 1);
    const float c = 0.01f, n = 1.0001f;
    const Real g2 = Real(n) * Real(n) - 1 + Real(c) * Real(c);
    CHECK(double(ljus::film_cosine2(c, n)) ==
          ljus_test::within(g2.convert_to<double>(), 1e-6));
}

TEST_CASE("observer: what is brighter than the screen is white, below black is black") {
    for (const ljus::RgbT<double>& bright :
         {ljus::RgbT<double>{3, 3, 3}, {2, 1.5, 1}, {0.5, 3, 0.5}, {1, 40, -2}})
        CHECK(ljus::into_gamut(bright) == ljus::RgbT<double>{1, 1, 1});
    for (const ljus::RgbT<double>& dark :
         {ljus::RgbT<double>{-1, -1, -1}, {-1, 0.2, 0}, {0.1, -0.5, 0.5}})
        CHECK(ljus::into_gamut(dark) == ljus::RgbT<double>{0, 0, 0});
}

TEST_CASE("film table: long paths are asked at more wavelengths") {
    // The phase 2 pi path / lambda moves by at most 1/2 from one to the next.
    for (const double longest : {1.0, 4000.0, 6000.0, 40000.0}) {
        const auto spectrum = ljus::detail::film_spectrum(longest);
        const auto& w = spectrum.wavelengths;
        REQUIRE(w.size() == spectrum.eye.size());
        REQUIRE(w.size() >= 235); // 2 nm
        CHECK(2 * std::numbers::pi * longest * (1 / w[0] - 1 / w[1]) <= 0.5);
        CHECK(w[1] - w[0] == doctest::Approx(470.0 / double(w.size())));
        CHECK(w[0] - 360 == doctest::Approx((w[1] - w[0]) / 2));
        CHECK(830 - w.back() == doctest::Approx((w[1] - w[0]) / 2));
    }
}

TEST_CASE("thin film: exactly at the critical angle it is as beside it") {
    int exact = 0;
    for (int i = 1; i < 400; ++i) {
        const double n = 0.3 + i * 0.0017, c = std::sqrt((1 - n) * (1 + n));
        if (ljus::film_cosine2(c, n) != 0) continue;
        ++exact;
        const double at = ljus::thin_film(c, n, 300.0, 550.0).reflected;
        CHECK(at > 0.01);
        for (const double beside : {c - 1e-7, c + 1e-7})
            CHECK(ljus::thin_film(beside, n, 300.0, 550.0).reflected ==
                  doctest::Approx(at).epsilon(1e-4));
    }
#ifndef __FMA__
    CHECK(exact > 20);
#endif
}
