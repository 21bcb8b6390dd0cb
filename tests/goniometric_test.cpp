/// \file goniometric_test.cpp
/// \brief Lamps of measured intensity: against point lights, closed forms, quadrature,
/// and photons against paths; and the files that they come from.
///
/// Means are held within 5 standard errors: a false alarm once in 1.7 million; a
/// chi-square within what is exceeded once in a million.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ljus/io/load_ies.hpp"
#include "ljus/lights/goniometric_light.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/integrate.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"
#include "support/seed.hpp"

using namespace ljus;
using ljus_test::apart;
using ljus_test::integrate;
using ljus_test::Mean;
using ljus_test::refusal;

static_assert(LightSource<GoniometricLight> && NearLight<GoniometricInSceneT<float>> &&
              LightSource<GoniometricLightT<double>>);

namespace {

constexpr double pi = std::numbers::pi;

template <std::floating_point T>
GoniometricInSceneT<T> prepared(const GoniometricLightT<T>& light) {
    check(light);
    return in_scene(light, SphereT<T>{.radius = 1});
}

/// A table of irregular angles and numbers, with cells that are dark.
IntensityTable drawn_table(Photometry type) {
    IntensityTable table{.type = type,
                         .polar = {5, 20, 21, 60, 90, 130, 175},
                         .azimuth = {-90, -70, 10, 11, 90}};
    if (type == Photometry::c) table.azimuth = {-30, 40, 100, 270, 330};
    auto stream = random_stream(5, Pass::user, 0, 0);
    for (std::size_t i = 0; i < 35; ++i) {
        const double u = next_1d<double>(stream);
        table.candela.push_back(u < 0.2 ? 0 : 1000 * u * u);
    }
    for (std::size_t i = 7; i < 9; ++i) table.candela[i] = 0;
    if (type == Photometry::c) // the seam
        std::copy_n(table.candela.begin(), 7, table.candela.end() - 7);
    return table;
}

/// A light with that table that shines somewhere askew.
template <std::floating_point T>
GoniometricLightT<T> drawn_light(Photometry type) {
    return {.table = drawn_table(type),
            .position{T(0.2), T(0.7), T(-0.1)},
            .direction{T(0.3), T(-0.9), T(0.2)},
            .reference{T(0.5), T(0.1), T(-2)},
            .watts_per_lumen{T(0.01), T(0.02), T(0.03)}};
}

/// A table that is the same all around: angles from the axis, and intensities.
IntensityTable round_table(std::vector<double> polar, std::vector<double> candela) {
    const std::vector<double> once = candela;
    candela.insert(candela.end(), once.begin(), once.end());
    return {.polar = std::move(polar), .azimuth{0, 360}, .candela = std::move(candela)};
}

/// The integral of f(direction) over the cells of a table, by Gauss's rule in each.
template <typename T, typename F>
double over_cells(const GoniometricInSceneT<T>& light, const F& f) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < light.polar.size(); ++i)
        for (std::size_t j = 0; j + 1 < light.azimuth.size(); ++j)
            sum += integrate(light.polar[i], light.polar[i + 1], 2, [&](double theta) {
                return std::sin(theta) *
                       integrate(light.azimuth[j], light.azimuth[j + 1],
                                 [&](double phi) {
                                     const double s = std::sin(theta);
                                     return f(to_world(light.frame,
                                                       Vec3T<T>{T(s * std::cos(phi)),
                                                                T(s * std::sin(phi)),
                                                                T(std::cos(theta))}));
                                 });
            });
    return sum;
}

constexpr Photometry types[] = {Photometry::c, Photometry::b, Photometry::a};

} // namespace

TEST_CASE_TEMPLATE("goniometric: the same in all directions, a table is a point light",
                   T, float, double) {
    const PointLightT<T> point{.position{1, 2, 3}, .intensity{2, 3, 4}};
    for (const Photometry type : types) {
        GoniometricLightT<T> light{.table{.type = type,
                                          .polar{0, 30, 180},
                                          .azimuth{-90, 10, 270},
                                          .candela = std::vector<double>(9, 7.0)},
                                   .position = point.position,
                                   .direction{1, 2, 3},
                                   .watts_per_lumen = point.intensity / T(7)};
        const auto made = prepared(light);
        CHECK(power(made).y == doctest::Approx(double(power(point).y)).epsilon(1e-6));
        for (std::uint64_t i = 0; i < 1000; ++i) {
            auto stream = random_stream(1, Pass::user, 0, i);
            const Vec3T<T> from = T(3) * sample_uniform_sphere(next_2d<T>(stream));
            const auto a = sample_light(made, from, {}, T(0));
            const auto b = sample_light(point, from, {}, T(0));
            REQUIRE(a);
            REQUIRE(a->weight.x == doctest::Approx(double(b->weight.x)).epsilon(1e-6));
            REQUIRE(a->wi == b->wi);
            REQUIRE(a->pdf == 0);
            REQUIRE(pdf_emission(made, from, a->wi) ==
                    doctest::Approx(1 / (4 * pi)).epsilon(1e-6));
        }
    }
}

TEST_CASE("goniometric: where a table ends after a whole turn, it is not dark") {
    for (double first = -359.5; first < 360; first += 0.5) {
        const auto made = prepared(
            GoniometricLightT<double>{.table{.polar{0, 180},
                                             .azimuth{first, first + 360},
                                             .candela = std::vector<double>(4, 1.0)}});
        for (const double off : {-1e-16, 0.0, 1e-16}) {
            const double phi = first * pi / 180 * (1 + off) + off;
            const auto wo =
                to_world(made.frame, glm::dvec3{std::cos(phi), std::sin(phi), 0});
            CAPTURE(first);
            REQUIRE(detail::intensity_towards(made, wo) == doctest::Approx(1));
        }
    }
}

TEST_CASE("goniometric: the flux of tables with a closed form") {
    const auto lumens = [](const IntensityTable& table) {
        return double(
            power(prepared(GoniometricLight{.table = table, .watts_per_lumen = Rgb{1}}))
                .x);
    };
    // 1 - theta / pi times the sine.
    CHECK(lumens(round_table({0, 180}, {1, 0})) == doctest::Approx(2 * pi));
    // Within 60 degrees: 2 pi (1 - cos).
    CHECK(lumens(round_table({0, 60}, {5, 5})) == doctest::Approx(5 * pi));
    // A cosine, pi I, but for chords below an arc by 1 / 12 of the step squared.
    std::vector<double> angles, cosines;
    for (int i = 0; i <= 90; ++i) {
        angles.push_back(i);
        cosines.push_back(std::cos(i * pi / 180));
    }
    const double step = pi / 180;
    CHECK(lumens(round_table(angles, cosines)) ==
          doctest::Approx(pi * (1 - step * step / 12)).epsilon(1e-7));
    // 683 lumens are a watt.
    const auto made =
        prepared(GoniometricLight{.table = round_table({0, 180}, {1, 1})});
    CHECK(power(made).y == doctest::Approx(4 * pi / 683));
}

TEST_CASE_TEMPLATE("goniometric: the density integrates to 1, and follows the table", T,
                   float, double) {
    for (const Photometry type : types) {
        const auto light = prepared(drawn_light<T>(type));
        const auto pdf = [&](const Vec3T<T>& wo) {
            return double(pdf_emission(light, light.position, wo));
        };
        CHECK(over_cells(light, pdf) == doctest::Approx(1).epsilon(1e-5));
        const double lumens = over_cells(light, [&](const Vec3T<T>& wo) {
            return detail::intensity_towards(light, wo);
        });
        CHECK(double(power(light).y) == doctest::Approx(0.02 * lumens).epsilon(1e-5));
        // What a surface receives is the density of its photons.
        auto stream = random_stream(2, Pass::user, 0, 0);
        for (int i = 0; i < 1000; ++i) {
            const Vec3T<T> wo = sample_uniform_sphere(next_2d<T>(stream));
            const auto lit = sample_light(light, light.position + T(2) * wo, {}, T(0));
            const double sent = lit ? 4 * double(lit->weight.y) : 0;
            REQUIRE(sent == doctest::Approx(pdf(wo) * double(power(light).y))
                                .epsilon(1e-3)
                                .scale(1e-3 * double(power(light).y)));
        }
    }
}

TEST_CASE("goniometric: directions are drawn with the density") {
    for (const Photometry type : types) {
        const auto light = prepared(drawn_light<float>(type));
        constexpr int belts = 24, sectors = 24, draws = 100000;
        // Cells of another frame than the table's, and their probabilities.
        std::vector<double> counts(belts * sectors), expected(belts * sectors);
        const auto cell_of = [&](const Vec3& d) {
            const int belt = std::min(int((d.y + 1) / 2 * belts), belts - 1);
            const double turn = std::atan2(double(d.x), double(d.z)) / (2 * pi) + 0.5;
            return std::size_t(belt * sectors +
                               std::min(int(turn * sectors), sectors - 1));
        };
        constexpr int fine = 40;
        for (int b = 0; b < belts * fine; ++b)
            for (int s = 0; s < sectors * fine; ++s) {
                const double y = 2 * (b + 0.5) / (belts * fine) - 1;
                const double phi = 2 * pi * ((s + 0.5) / (sectors * fine) - 0.5);
                const double r = std::sqrt(1 - y * y);
                const Vec3 d(float(r * std::sin(phi)), float(y),
                             float(r * std::cos(phi)));
                expected[std::size_t(b / fine * sectors + s / fine)] +=
                    draws * double(pdf_emission(light, Vec3{0}, d)) * 4 * pi /
                    (belts * fine * sectors * fine);
            }
        for (std::uint64_t i = 0; i < draws; ++i) {
            auto stream = random_stream(ljus_test::test_seed(3), Pass::user, 0, i);
            const Vec3 d = sample_emission(light, Vec3{0}, next_2d<float>(stream));
            REQUIRE(std::abs(glm::length(d) - 1) < 1e-5f);
            REQUIRE(pdf_emission(light, Vec3{0}, d) > 0);
            const auto cone = emission_cone(light, Vec3{0});
            REQUIRE(1 - glm::dot(d, cone.axis) <= cone.one_minus_cos + 1e-5f);
            counts[cell_of(d)] += 1;
        }
        CHECK(ljus_test::chi_square_agrees(counts, expected,
                                           ljus_test::once_in_a_million));
    }
}

TEST_CASE("goniometric: corners of the unit square give directions that are lit") {
    for (const Photometry type : types) {
        const auto light = prepared(drawn_light<float>(type));
        const float last = 0x1.fffffep-1f;
        for (const Vec2& u : {Vec2{0, 0}, Vec2{last, 0}, Vec2{0, last},
                              Vec2{last, last}, Vec2{0.5f, last}})
            CHECK(std::abs(glm::length(sample_emission(light, Vec3{0}, u)) - 1) <
                  1e-5f);
    }
}

TEST_CASE("goniometric: where the angles of each type of photometer point") {
    // A spot at one pair of angles of a file: 30 degrees vertically, 50 horizontally.
    const auto brightest = [](const char* head, const char* vertical,
                              const char* horizontal, int peak, Vec3 direction) {
        std::string text = std::string("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 ") + head +
                           " 2 0 0 0\n1 1 10\n" + vertical + "\n" + horizontal + "\n";
        for (int i = 0; i < 25; ++i) text += i == peak ? " 1" : " 0";
        const auto light =
            prepared(GoniometricLight{.table = read_ies(text, "a.ies").table,
                                      .direction = direction,
                                      .reference{0, 1, 0},
                                      .watts_per_lumen = Rgb{1}});
        const auto from = emission_cone(light, Vec3{0});
        CHECK(from.one_minus_cos > 0);
        // Uphill from everywhere: the brightest of many directions.
        Vec3 best{0};
        double most = 0;
        for (int y = 0; y <= 360; ++y)
            for (int x = 0; x < 720; ++x) {
                const double theta = y * pi / 360, phi = x * pi / 360;
                const Vec3 d(Vec3T<double>{std::sin(theta) * std::cos(phi),
                                           std::cos(theta),
                                           std::sin(theta) * std::sin(phi)});
                const double here = detail::intensity_towards(light, d);
                if (here > most) best = d;
                most = std::max(most, here);
            }
        CHECK(most > 0.98);
        return best;
    };
    const double v = pi / 6, h = 5 * pi / 18;
    // The lamp aims at -z, up is y, so that the side is +x.
    const Vec3T<double> aim{0, 0, -1}, up{0, 1, 0}, side{1, 0, 0};
    const auto near = [](const Vec3& a, const Vec3T<double>& b) {
        CHECK(glm::distance(a, Vec3(b)) < 0.01f);
    };
    near(brightest("5 5 3", "-90 0 30 60 90", "-90 0 50 70 90", 12, Vec3(aim)),
         std::cos(v) * std::cos(h) * aim + std::cos(v) * std::sin(h) * side +
             std::sin(v) * up);
    near(brightest("5 5 2", "-90 0 30 60 90", "-90 0 50 70 90", 12, Vec3(aim)),
         std::cos(v) * std::cos(h) * aim + std::sin(h) * side +
             std::sin(v) * std::cos(h) * up);
    near(brightest("5 5 1", "0 10 30 60 180", "0 10 50 70 360", 12, Vec3(aim)),
         std::cos(v) * aim + std::sin(v) * (std::cos(h) * up + std::sin(h) * side));
}

namespace {

/// An IES file of type C with these horizontal angles, whose intensity is a function.
template <typename F>
std::string ies_file(const std::vector<double>& horizontal, const F& candela,
                     const char* head = "IESNA91\n[TEST] none\nTILT=NONE\n",
                     const char* factors = "1 1000 1", const char* ballast = "1 1 50",
                     int type = 1, double low = 0) {
    std::string text = head;
    text += std::string(factors) + " 4 " + std::to_string(horizontal.size()) + " " +
            std::to_string(type) + " 2 0.1 0.2 0\n" + ballast + "\n";
    const std::vector<double> vertical{low, low + 45, low + 90, low + 180};
    for (const double v : vertical) text += to_text(v) + " ";
    text += "\n";
    for (const double h : horizontal) text += to_text(h) + " ";
    for (const double h : horizontal) {
        text += "\n";
        for (const double v : vertical) text += to_text(candela(h, v)) + " ";
    }
    return text;
}

/// The table in a file of type C.
template <typename F>
IntensityTable table_in(const std::vector<double>& horizontal, const F& candela) {
    return read_ies(ies_file(horizontal, candela), "a.ies").table;
}

/// The greatest difference of two tables over many directions, in cd.
double difference(const IntensityTable& a, const IntensityTable& b) {
    const auto one = prepared(GoniometricLight{.table = a});
    const auto other = prepared(GoniometricLight{.table = b});
    double most = 0;
    for (std::uint64_t i = 0; i < 5000; ++i) {
        auto stream = random_stream(6, Pass::user, 0, i);
        const Vec3 d = sample_uniform_sphere(next_2d<float>(stream));
        most = std::max(most, std::abs(detail::intensity_towards(one, d) -
                                       detail::intensity_towards(other, d)));
    }
    return most;
}

std::vector<double> every_15_degrees(double low, double high) {
    std::vector<double> all;
    for (double angle = low; angle <= high; angle += 15) all.push_back(angle);
    return all;
}

} // namespace

TEST_CASE("goniometric: what a file leaves out by symmetry is completed") {
    const auto all = every_15_degrees(0, 360);
    // Symmetric about the planes of 0 and 90 degrees, of 0 alone, and of 90 alone.
    const auto quarters = [](double h, double v) {
        return 100 + v + 50 * std::cos(2 * h * pi / 180) + 5 * std::cos(h * pi / 45);
    };
    const auto halves = [](double h, double v) {
        return 100 + v + 50 * std::cos(h * pi / 180);
    };
    const auto sides = [](double h, double v) {
        return 100 + v + 50 * std::sin(h * pi / 180);
    };
    const auto round = [](double, double v) { return 100 + v; };
    CHECK(difference(table_in(every_15_degrees(0, 90), quarters),
                     table_in(all, quarters)) < 1e-3);
    CHECK(difference(table_in(every_15_degrees(0, 180), halves),
                     table_in(all, halves)) < 1e-3);
    CHECK(difference(table_in(every_15_degrees(90, 270), sides), table_in(all, sides)) <
          1e-3);
    CHECK(difference(table_in({0}, round), table_in(all, round)) < 1e-3);
    CHECK(difference(table_in(every_15_degrees(0, 345), sides), table_in(all, sides)) <
          1e-3);
    CHECK(difference(table_in(all, sides), table_in(all, halves)) > 10);
    // The types B and A: the left as the right.
    for (const int type : {2, 3}) {
        const auto even = [](double h, double v) { return 200 + v - std::abs(h); };
        const auto read = [&](double low) {
            return read_ies(ies_file(every_15_degrees(low, 90), even, "TILT=NONE\n",
                                     "1 1000 1", "1 1 50", type, -90),
                            "a.ies")
                .table;
        };
        CHECK(difference(read(0), read(-90)) < 1e-3);
    }
}

TEST_CASE("goniometric: versions of the format, a tilt table, and all factors") {
    const auto flat = [](double, double) { return 12.0; };
    const auto read = [&](const char* head, const char* factors = "1 1000 1",
                          const char* ballast = "1 1 50") {
        return read_ies(ies_file({0}, flat, head, factors, ballast), "a.ies");
    };
    for (const char* const head :
         {"A desk lamp, 1986\r\nTILT=NONE\r\n", "IESNA91\n[TEST] 1\nTILT=NONE\n",
          "IESNA:LM-63-1995\n[MANUFAC] none\n[MORE] TILT\n TILT=NONE\nTILT=NONE\n",
          "IESNA:LM-63-2002\nTILT=Include\n1\n3\n0 45, 90\n1, 0.9 0.8\n",
          "\xef\xbb\xbfIESNA:LM-63-2002\nTILT=none \n"}) {
        CAPTURE(head);
        const IesLamp lamp = read(head);
        CHECK(lamp.table.candela == std::vector<double>(8, 12.0));
        CHECK(lamp.table.polar == std::vector<double>{0, 45, 90, 180});
        CHECK(lamp.lumens == 1000);
        CHECK(lamp.watts == 50);
    }
    const IesLamp lamp = read("TILT=NONE\n", "3 700 2.5", "0.9 0.8 1e2");
    CHECK(lamp.table.candela[3] == doctest::Approx(12 * 2.5 * 0.9 * 0.8));
    CHECK(lamp.lumens == 2100);
    CHECK(lamp.watts == 100);
    CHECK(read("TILT=NONE\n", "2 -1 1").lumens == -1);
    // Commas may separate numbers, with and without blanks.
    IesLamp commas;
    REQUIRE_NOTHROW(commas = read("TILT=INCLUDE\n1,\n2,0 , 90,\n,1,1\n", "3,700 ,2.5",
                                  "1,1,\n,100"));
    CHECK(commas.table.candela[3] == 12 * 2.5);
    CHECK(commas.lumens == 2100);
    CHECK(commas.watts == 100);
    // Since 2019 the second of these tells how the file was made.
    CHECK(read("IES:LM-63-2019\nTILT=NONE\n", "1 1 2", "0.5 1.1 5").table.candela[3] ==
          doctest::Approx(12 * 2 * 0.5));
    const IesLamp file = load_ies(LJUS_TEST_INPUTS "/wall_washer.ies");
    CHECK(file.table.azimuth.size() == 13);
}

TEST_CASE("goniometric: files that are none end in a sentence") {
    const auto why = [](const std::string& text) {
        return ljus_test::refusal<std::runtime_error>(
            [&] { (void)read_ies(text, "a.ies"); });
    };
    CHECK(why("").ends_with("no line begins with 'TILT=', which comes before the "
                            "numbers of an IES file."));
    CHECK(why("TILT=NONE") ==
          "a.ies: line 1: the file ends before the number of lamps.");
    CHECK(why("x\nTILT=lamp.tlt\n1 1") ==
          "a.ies: line 2: the tilt is 'lamp.tlt'; it must be NONE or INCLUDE.");
    const std::string start = "TILT=NONE\n1 1000 1 ";
    CHECK(why(start + "3 1 1 2 0 0 0\n1 1 x") ==
          "a.ies: line 3: the power is 'x'; it must be a number.");
    CHECK(
        why(start + "3 1 1 2 0 0 0\n1 1 5\n0 25 20") ==
        "a.ies: line 4: a vertical angle is 20; it must be above the one before, 25.");
    CHECK(why(start + "2.5 1 1") == "a.ies: line 2: the number of vertical angles is "
                                    "2.5; it must be a whole number.");
    CHECK(why(start + "1 1 1").find("it must be within [2, 100000]") !=
          std::string::npos);
    CHECK(
        why(start + "99999 99999 1 2 0 0 0 1 1 5 0 1 2").find("the file ends before") !=
        std::string::npos);
    CHECK(
        why(start + "2 2 1 2 0 0 0 1 1 5 0 90 0 45 1 1 1 1") ==
        "cannot read 'a.ies': its horizontal angles go from 0 to 45; they must go from "
        "0 to 0, 90, 180 or 360, or from 90 to 270.");
    CHECK(why(start + "2 2 2 2 0 0 0 1 1 5 0 90 -45 90 1 1 1 1")
              .ends_with("they must go from 0 or -90 to 90."));
    // A comma separates numbers.
    CHECK(why(start + "2 1 1 2 0 0 0 1 1 5 0 90 0 1,5 2,5") ==
          "a.ies: line 2: a number follows the last intensity; there must be one for "
          "each pair of angles, and decimals must have a point.");
    CHECK(why(start + "2 1 1 2 0 0 0 1 1 5 0 90 0 1 2\n\x1a") == "");
    CHECK(why(start + "2 1 1 2 0 0 0 1 1 5 0 90 0 1 -1")
              .ends_with("an intensity is -1; it must be within [0, 1e+9]."));
    for (const char* const bad : {"nan", "inf", "1e999", "1e", "--1", "0x10"})
        CHECK(why(start + "2 1 1 2 0 0 0 1 1 5 0 90 0 1 " + bad)
                  .ends_with("it must be a number."));
    CHECK(why("TILT=INCLUDE\n1\n99999999\n").find("within [1, 1000]") !=
          std::string::npos);
    // Every cut of a file is refused, or it is whole.
    const std::string whole =
        ies_file({0, 90}, [](double h, double v) { return h + v; });
    for (std::size_t size = 0; size + 4 < whole.size(); ++size)
        CHECK(why(whole.substr(0, size)) != "");
    CHECK(why(whole) == "");
}

TEST_CASE("goniometric: what is no light is refused, and a dark one is left out") {
    const auto why = [](const GoniometricLight& light) {
        return refusal([&] { check(light); });
    };
    const IntensityTable good = round_table({0, 90}, {1, 1});
    CHECK(why({.table = good}) == "");
    CHECK(
        why({}).starts_with("the number of polar angles is 0; it must be at least 2"));
    CHECK(
        why({.table = round_table({0, 0}, {1, 1})}).starts_with("a polar angle is 0"));
    CHECK(why({.table = round_table({0, 181}, {1, 1})})
              .starts_with("a polar angle is 181"));
    CHECK(why({.table = round_table({0, 90}, {1, -1})})
              .starts_with("an intensity is -1"));
    CHECK(why({.table = round_table({0, 90}, {1})})
              .starts_with("the number of intensities is 2"));
    CHECK(why({.table = good, .direction{0, 0, 0}}).find("direction") !=
          std::string::npos);
    CHECK(why({.table = good, .reference{0, 3, 0}}).find("reference") !=
          std::string::npos);
    IntensityTable wide = good;
    wide.azimuth = {0, 361};
    CHECK(why({.table = wide}).starts_with("the range of azimuths is 361"));
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<GoniometricLight>> scene;
    scene.add(GoniometricLight{.table = round_table({0, 90}, {0, 0})});
    CHECK(scene.light_count() == 0);
}

TEST_CASE("goniometric: photons bring to a floor what shadow rays and paths find") {
    // A corner of a room: what the wall reflects comes along.
    for (const Photometry type : types) {
        GoniometricLight lamp = drawn_light<float>(type);
        lamp.position = {0.2f, 1.1f, -0.1f};
        const Lambertian matt{.albedo = Rgb{0.6f}};
        const World world(
            make_scene(placed(Quad{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}}, matt),
                       placed(Quad{{-1, 0, -1}, {2, 0, 0}, {0, 2, 0}}, matt), lamp));
        Mean photons;
        for (std::uint64_t seed = 1; seed <= 32; ++seed) {
            double flux = 0;
            for (const Photon& photon :
                 trace_photons(world, MapType::general,
                               {.photons = 4000,
                               .seed = ljus_test::test_seed(seed),
                               .shadow_photons = false,
                               .threads = 1})
                     .photons)
                if (photon.position.y < 1e-4f && photon.direction.y < 0)
                    flux += double(photon.flux.y);
            photons.add(flux);
        }
        const auto ray = [](RandomStream& stream) {
            const Vec2 at = 2.0f * next_2d<float>(stream) - 1.0f;
            return Ray{.origin{at.x, 0.01f, at.y}, .direction{0, -1, 0}};
        };
        Mean paths = ljus_test::mean_radiance(PathTracer(world), 40000, 9, ray, 1);
        const double scale = 4 * pi / 0.6; // a white floor of 4 m^2
        paths.mean *= scale;
        paths.squares *= scale * scale;
        CHECK(std::abs(apart(photons, paths)) < 5);
        CHECK(photons.error() < 0.01 * photons.mean);
        CHECK(paths.error() < 0.02 * paths.mean);
    }
}
