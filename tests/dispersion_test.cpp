/// \file dispersion_test.cpp
/// \brief Dispersion: measured indices, prisms and rainbows, and what a wavelength does
/// to a path.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/lights/environment.hpp"
#include "ljus/materials/dispersive_glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/nested.hpp"
#include "ljus/materials/normal_map.hpp"
#include "ljus/path/light_transport.hpp"
#include "ljus/photons/light_paths.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/box_sides.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"
#include "support/student.hpp"

using namespace ljus;
using ljus_test::Mean;

namespace {

using Flint = DispersiveGlassT<double>;
using Optics = Scene<Shapes<SphereT<double>, QuadT<double>>, Materials<Flint>>;
using Room = Scene<Shapes<Sphere, Quad>, Materials<Lambertian, DispersiveGlass, Glass>,
                   Lights<EnvironmentLight>>;

constexpr double degrees = 180 / std::numbers::pi;

double angle(const Vec3T<double>& a, const Vec3T<double>& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The direction of light of one wavelength after it was refracted (T) or reflected (R)
/// at one surface after another; 0 if there is no such light.
template <typename W>
Vec3T<double> sent(const W& world, const RayT<double>& ray, double nm,
                   std::string_view letters) {
    PathStateT<double> path{.ray = ray, .wavelength = nm};
    RandomStream stream;
    for (const char letter : letters) {
        const auto vertex = next_vertex(world, path, stream);
        if (!vertex) return {0, 0, 0};
        const auto wi = visit_material_at(world, *vertex, [&](const auto& m) {
            const auto both = split(m, vertex->wo, Transport::radiance);
            return both ? (*both)[letter == 'T'].wi : Vec3T<double>{0};
        });
        if (wi == Vec3T<double>{0}) return wi;
        path.ray = spawn_ray(vertex->point, to_world(vertex->frame, wi));
    }
    return path.ray.direction;
}

/// The least value of a function that has one minimum in an interval.
template <typename F>
double least(double low, double high, F f) {
    for (int step = 0; step < 80; ++step) {
        const double a = low + (high - low) / 3, b = high - (high - low) / 3;
        (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
    }
    return f((low + high) / 2);
}

/// The mean of a function of the index over wavelengths, for each channel.
template <typename F>
RgbT<double> over_wavelengths(const SellmeierT<double>& law, F f) {
    RgbT<double> sum{0}, white{0};
    for (double nm = 360.05; nm < 830; nm += 0.1) {
        const RgbT<double> weight = wavelength_color(nm) * pdf_wavelength(nm);
        sum += weight * f(refractive_index(law, nm));
        white += weight;
    }
    return sum / white;
}

} // namespace

TEST_CASE("dispersion: indices and Abbe numbers are those of the catalogues") {
    struct Row {
        const char* name;
        SellmeierT<double> law;
        double index, abbe;
    };
    // Schott's data sheets of 2017 state five and four digits.
    for (const Row& row : {Row{"N-BK7", bk7<double>, 1.51680, 64.17},
                           Row{"SF10", sf10<double>, 1.72825, 28.41},
                           Row{"N-SF66", sf66<double>, 1.92286, 20.88}}) {
        CAPTURE(row.name);
        CHECK(refractive_index(row.law, line_d<double>) ==
              doctest::Approx(row.index).epsilon(5e-6));
        CHECK(std::abs(abbe_number(row.law) - row.abbe) < 0.01);
    }
    // The CRC Handbook's table at 20 degrees, for the sodium line; and Peter's diamond.
    CHECK(std::abs(refractive_index(water<double>, 589.29) - 1.33336) < 1e-4);
    CHECK(std::abs(refractive_index(water<double>, 404.66) - 1.34315) < 2e-4);
    CHECK(std::abs(refractive_index(diamond<double>, 589.29) - 2.4175) < 5e-4);
    const auto made = cauchy_from_abbe(1.62, 36.4);
    CHECK(refractive_index(made, line_d<double>) == doctest::Approx(1.62));
    CHECK(abbe_number(made) == doctest::Approx(36.4));
    // The law that is made of two numbers is close to the measured one in between.
    const auto near = cauchy_from_abbe(1.51680, 64.17);
    for (const double nm : {420., 500., 550., 700.})
        CHECK(std::abs(refractive_index(near, nm) - refractive_index(bk7<double>, nm)) <
              4e-4);
}

TEST_CASE("dispersion: the mean colour of all wavelengths is white") {
    RgbT<double> sum{0};
    constexpr int count = 1 << 16;
    for (int i = 0; i < count; ++i) {
        const double nm = sample_wavelength((i + 0.5) / count);
        const RgbT<double> color = wavelength_color(nm);
        CHECK_MESSAGE(color.x + color.y + color.z == doctest::Approx(3), nm);
        CHECK_MESSAGE(std::min({color.x, color.y, color.z}) >= 0, nm);
        sum += color;
    }
    // The rest is the grid, which does not end where the bands do.
    for (int c = 0; c < 3; ++c)
        CHECK(sum[c] / count == doctest::Approx(1).epsilon(2e-4));
    // In float, as renderers draw it, at both ends of [0, 1).
    CHECK(sample_wavelength(0.0f) >= 360);
    CHECK(sample_wavelength(0x1.fffffep-1f) <= 830);
    CHECK(wavelength_color(830.0f).x >= 0);
}

TEST_CASE("dispersion: wavelengths are chosen with the stated density") {
    double before = sample_wavelength(0.0), all = 0;
    for (int i = 1; i < 1000; ++i) {
        const double u = i / 1000.0, nm = sample_wavelength(u);
        CHECK(nm > before); // neighbours stay neighbours
        double sum = 0;     // exact: the density is constant in bands of 5 nm
        for (double at = 360; at < nm; at += 5)
            sum += pdf_wavelength(at + 1) * std::min(5.0, nm - at);
        CHECK(sum == doctest::Approx(u));
        before = nm;
    }
    for (double at = 360; at < 830; at += 5) all += 5 * pdf_wavelength(at + 1);
    CHECK(all == doctest::Approx(1));
    CHECK(pdf_wavelength(359.0) == 0);
    CHECK(pdf_wavelength(831.0) == 0);
}

TEST_CASE("dispersion: pure colours have their hues") {
    const auto most = [](double nm) {
        const RgbT<double> c = wavelength_color(nm);
        return c.x > c.y && c.x > c.z ? 'r' : c.y > c.z ? 'g' : 'b';
    };
    CHECK(most(650) == 'r');
    CHECK(most(530) == 'g');
    CHECK(most(450) == 'b');
    const RgbT<double> yellow = wavelength_color(572.0), red = wavelength_color(650.0);
    CHECK(std::abs(yellow.x / yellow.y - 1) < 0.4);
    CHECK(yellow.z == 0);
    CHECK(red.y == 0); // its negative channels are set to 0
    CHECK(red.z < 0.02);
}

TEST_CASE("dispersion: a prism deviates each wavelength by its least angle") {
    constexpr double apex = 60 / degrees;
    Optics scene;
    const auto flint = scene.add(Flint{.law = sf10<double>});
    // Two faces that meet above, with normals outwards.
    const double s = std::sin(apex / 2), c = std::cos(apex / 2);
    scene.add(QuadT<double>{{0, 1, -1}, {-s, -c, 0}, {0, 0, 2}}, flint);
    scene.add(QuadT<double>{{0, 1, 1}, {s, -c, 0}, {0, 0, -2}}, flint);
    scene.add(QuadT<double>{{-s, 1 - c, -1}, {2 * s, 0, 0}, {0, 0, 2}}, flint);
    const World world(std::move(scene));
    for (const double nm : {404.66, 486.13, 587.56, 656.27, 706.52}) {
        const double n = refractive_index(sf10<double>, nm);
        const auto deviation = [&](double incidence) {
            const double up = incidence - apex / 2; // of the ray above the horizontal
            const Vec3T<double> in{std::cos(up), std::sin(up), 0};
            const Vec3T<double> face{-s / 2, 1 - c / 2, 0};
            const auto out =
                sent(world, {.origin = face - in, .direction = in}, nm, "TT");
            return out == Vec3T<double>{0} ? 3.0 : angle(in, out);
        };
        const double right = 2 * std::asin(n * std::sin(apex / 2)) - apex;
        CAPTURE(nm);
        CHECK(least(0.8, 1.35, deviation) == doctest::Approx(right).epsilon(1e-9));
    }
}

TEST_CASE("dispersion: with a priority, glass has the same index at each wavelength") {
    const Nested<DispersiveGlass> nested{
        {.law = sf10<float>, .absorption{0.1f, 0.2f, 0.3f}}, 2};
    static_assert(Dispersive<Nested<DispersiveGlass>>);
    for (const float nm : {400.0f, 589.0f, 700.0f}) {
        const Glass glass = at_wavelength(nested, nm);
        CHECK(glass.index == refractive_index(sf10<float>, nm));
        CHECK(glass.absorption == nested.base.absorption);
    }
}

TEST_CASE("dispersion: a normal map around glass leaves its spectrum") {
    const auto check_index = [](const auto& glass) {
        const World world(make_scene(placed(Quad{}, glass)));
        RandomStream stream{ljus_test::test_seed(9), 0};
        PathState path{.ray{.origin{0.4f, 0.4f, 2}, .direction{0, 0, -1}}};
        const auto vertex = next_vertex(world, path, stream);
        REQUIRE(vertex);
        REQUIRE(path.wavelength > 0);
        CHECK(path.throughput == wavelength_color(path.wavelength));
        visit_material_at(world, *vertex, [&](const auto& here) {
            CHECK(refractive_index(here) ==
                  refractive_index(sf10<float>, path.wavelength));
        });
        CHECK(detail::index_of(world, vertex->object.material, 400.0f) ==
              refractive_index(sf10<float>, 400.0f));
    };
    using Dented = Textured<DispersiveGlass, NormalMap>;
    const DispersiveGlass flint{.law = sf10<float>};
    const NormalMap flat{{.image = make_image(1, 1, Rgb{0.5f, 0.5f, 1})}};
    check_index(flint);
    check_index(Dented{flint, flat});
    check_index(Nested<Dented>{{flint, flat}, 1});
    check_index(Textured<Nested<DispersiveGlass>, NormalMap>{{flint, 1}, flat});
}

TEST_CASE("dispersion: a second prism gathers a spectrum, or spreads it further") {
    constexpr double apex = 60 / degrees;
    const double s = std::sin(apex / 2), c = std::cos(apex / 2);
    const Vec3T<double> left{-s / 2, 1 - c / 2, 0}, right{s / 2, 1 - c / 2, 0};
    Optics scene;
    const auto flint = scene.add(Flint{.law = sf10<double>});
    // The prism of the test above, turned about z, with the middle of its left face at a
    // place.
    const auto add_prism = [&](double turn, const Vec3T<double>& to) {
        const auto turned = [&](const Vec3T<double>& v) {
            return Vec3T<double>{std::cos(turn) * v.x - std::sin(turn) * v.y,
                                 std::sin(turn) * v.x + std::cos(turn) * v.y, v.z};
        };
        const auto side = [&](const Vec3T<double>& corner, const Vec3T<double>& u,
                              double depth) {
            scene.add(QuadT<double>{to + turned(corner - left), turned(u),
                                    Vec3T<double>{0, 0, depth}},
                      flint);
        };
        side({0, 1, -1}, {-s, -c, 0}, 2);
        side({0, 1, 1}, {s, -c, 0}, -2);
        side({-s, 1 - c, -1}, {2 * s, 0, 0}, 2);
    };
    const double incidence = 60 / degrees, up = incidence - apex / 2;
    const Vec3T<double> in{std::cos(up), std::sin(up), 0};
    const auto out = [&](double nm, const char* path) {
        auto copy = scene;
        return sent(World(std::move(copy)), {.origin = left - in, .direction = in}, nm,
                    path);
    };
    add_prism(0, left);
    const double first = angle(out(404.66, "TT"), out(706.52, "TT"));
    CHECK(first > 4 / degrees);

    const auto with_one = scene;
    // Upside down: its faces are parallel to those of the first one, and so are the rays.
    const Vec3T<double> on{c, -s, 0};
    add_prism(180 / degrees, right + 0.3 * on + (right - left));
    for (const double nm : {404.66, 587.56, 706.52}) {
        CAPTURE(nm);
        CHECK(angle(in, out(nm, "TTTT")) < 1e-9);
    }

    // Turned by 60 degrees, as the ray is: it deviates each wavelength once more.
    scene = with_one;
    add_prism(-60 / degrees, right + on);
    for (const double nm : {404.66, 587.56, 706.52}) {
        const double n = refractive_index(sf10<double>, nm);
        const auto deviation = [&](double i) {
            return i + std::asin(n * std::sin(apex - std::asin(std::sin(i) / n))) -
                   apex;
        };
        const double once = deviation(incidence);
        const double twice = once + deviation(incidence - once + 60 / degrees);
        CAPTURE(nm);
        CHECK(angle(in, out(nm, "TTTT")) == doctest::Approx(twice).epsilon(1e-9));
    }
    CHECK(angle(out(404.66, "TTTT"), out(706.52, "TTTT")) > 1.8 * first);
}

TEST_CASE("dispersion: a ball of water makes Descartes' rainbow") {
    Optics scene;
    scene.add(SphereT<double>{{0, 0, 0}, 1}, scene.add(Flint{.law = water<double>}));
    const World world(std::move(scene));
    const auto bow = [&](double nm, std::string_view letters) {
        const Vec3T<double> in{1, 0, 0};
        const double turn = letters == "TRT" ? 1 : -1; // a maximum; of two, a minimum
        return turn * -least(0.5, 0.999, [&](double b) {
                   const auto out =
                       sent(world, {.origin{-3, b, 0}, .direction = in}, nm, letters);
                   return -turn * angle(out, -in);
               });
    };
    for (const double nm : {400., 500., 600., 700.}) {
        const double n = refractive_index(water<double>, nm);
        const double in = std::acos(std::sqrt((n * n - 1) / 3));
        CHECK(bow(nm, "TRT") ==
              doctest::Approx(4 * std::asin(std::sin(in) / n) - 2 * in).epsilon(1e-9));
        const double second = std::acos(std::sqrt((n * n - 1) / 8));
        CHECK(bow(nm, "TRRT") == doctest::Approx(std::numbers::pi + 2 * second -
                                                 6 * std::asin(std::sin(second) / n))
                                     .epsilon(1e-9));
    }
    CHECK(std::abs(bow(656.27, "TRT") * degrees - 42.3) < 0.1);
    CHECK(std::abs(bow(400, "TRT") * degrees - 40.6) < 0.1);
}

TEST_CASE("dispersion: violet is totally reflected where red is not") {
    const Flint glass{.law = sf66<double>};
    const double critical = std::asin(1 / refractive_index(sf66<double>, 550.0));
    const Vec3T<double> wo{std::sin(critical), 0, -std::cos(critical)};
    CHECK_FALSE(split(at_wavelength(glass, 430.0), wo, Transport::radiance));
    const auto red = split(at_wavelength(glass, 680.0), wo, Transport::radiance);
    REQUIRE(red);
    // Radiance is divided by the square of the index that the wavelength has.
    const double n = refractive_index(sf66<double>, 680.0);
    CHECK((*red)[1].eta_scale == doctest::Approx(n * n));
    CHECK((*split(at_wavelength(glass, 680.0), wo, Transport::flux))[1].eta_scale == 1);
    // By itself the glass is that of the d line.
    const Vec3T<double> down{0.6, 0, 0.8}, u{0, 0, 0.99};
    const auto own = sample(glass, down, u, Transport::flux);
    const auto plain =
        sample(at_wavelength(glass, line_d<double>), down, u, Transport::flux);
    REQUIRE(own);
    CHECK(own->wi == plain->wi);
    CHECK(refractive_index(glass) == doctest::Approx(1.92286).epsilon(1e-5));
}

TEST_CASE("dispersion: a path keeps its wavelength, and has none before") {
    Room room;
    const auto matt = room.add(Lambertian{.albedo = Rgb{0.5f}});
    const auto plain = room.add(Glass{.index = 1.5f});
    const auto flint = room.add(DispersiveGlass{.law = sf66<float>});
    room.add(Sphere{{0, 0, 5}, 1}, plain);
    room.add(Sphere{{0, 0, 0}, 1}, flint);
    room.add(Quad{{-9, -9, -5}, {18, 0, 0}, {0, 18, 0}}, matt);
    const World world(std::move(room));
    PathState path{.ray{.origin{0, 0, 9}, .direction{0, 0, -1}}};
    RandomStream stream = random_stream(3, Pass::user, 0, 0);
    const auto ahead = [&] {
        const auto vertex = next_vertex(world, path, stream);
        REQUIRE(vertex);
        path.ray = spawn_ray(vertex->point, path.ray.direction);
        return *vertex;
    };
    CHECK(ahead().wavelength == line_d<float>);
    CHECK(ahead().wavelength == line_d<float>);
    CHECK(path.wavelength == 0);
    CHECK(path.throughput == Rgb{1});
    const auto first = ahead();
    CHECK(first.wavelength == path.wavelength);
    CHECK(path.throughput == wavelength_color(path.wavelength));
    const float kept = path.wavelength;
    CHECK(ahead().wavelength == kept);
    CHECK(ahead().wavelength == kept); // on the floor
    CHECK(path.wavelength == kept);
    CHECK(path.throughput == wavelength_color(kept)); // coloured once
    // The index on the way is that of the wavelength.
    visit_material_at(world, first, [&](const auto& m) {
        if constexpr (Refractive<std::remove_cvref_t<decltype(m)>>)
            CHECK(m.index == refractive_index(sf66<float>, kept));
    });
}

TEST_CASE("dispersion: bodies that touch have the ratio of their indices at the "
          "wavelength") {
    // Flint below, plain glass above, met from either side.
    Room room;
    const auto plain = room.add(Glass{.index = 1.5f});
    const auto flint = room.add(DispersiveGlass{.law = sf66<float>});
    ljus_test::add_block(room, {-1, 0, -1}, {1, 1, 1}, plain);
    ljus_test::add_block(room, {-1, -1, -1}, {1, 0, 1}, flint);
    const World world(std::move(room));
    for (const float y : {0.5f, -0.5f}) {
        PathState path{
            .ray{.origin{0.1f, y, 0.2f}, .direction{0, y < 0 ? 1.f : -1.f, 0}}};
        RandomStream stream = random_stream(5, Pass::user, 0, 0);
        const auto vertex = next_vertex(world, path, stream);
        REQUIRE(vertex);
        REQUIRE(path.wavelength > 0);
        CHECK(path.throughput == wavelength_color(path.wavelength));
        const float n = refractive_index(sf66<float>, path.wavelength);
        visit_material_at(world, *vertex, [&](const auto& m) {
            if constexpr (Refractive<std::remove_cvref_t<decltype(m)>>) {
                const float inside = y < 0 ? 1.5f : n, outside = y < 0 ? n : 1.5f;
                // The side of the ray, however the boundary is seen.
                const bool in = vertex->wo.z < 0;
                CHECK(m.index ==
                      doctest::Approx(in ? outside / inside : inside / outside));
            } else {
                FAIL("not glass");
            }
        });
    }
}

// 3 channels within 5 standard errors: a false alarm once in 600 000.
TEST_CASE("dispersion: under a white sky flint glass is invisible, and loses nothing") {
    Room room;
    room.add(Sphere{{0, 0, 0}, 1}, room.add(DispersiveGlass{.law = sf66<float>}));
    room.add(EnvironmentLight{});
    const World world(std::move(room));
    const PathTracer tracer(world, {.max_depth = 100, .roulette_depth = 1000});
    std::array<Mean, 3> mean;
    Counts counts;
    for (std::uint64_t path = 0; path < 20000; ++path) {
        auto stream = random_stream(ljus_test::test_seed(1), Pass::camera, 0, path);
        const auto u = next_2d<float>(stream);
        const Ray ray{.origin{1.6f * u.x - 0.8f, 1.6f * u.y - 0.8f, 3},
                      .direction{0, 0, -1}};
        auto context = context_of(stream, counts);
        const Rgb seen = radiance(tracer, ray, context);
        const float sum = seen.x + seen.y + seen.z;
        if (std::abs(sum - 3) > 1e-4f) CHECK_MESSAGE(sum == 3, path);
        for (int c = 0; c < 3; ++c) mean[std::size_t(c)].add(double(seen[c]));
    }
    for (const Mean& m : mean) CHECK(m.agrees_with(1));
    MESSAGE("variance of one path: ", mean[0].variance(), " ", mean[1].variance(), " ",
            mean[2].variance());
}

// 3 channels within 5 standard errors: a false alarm once in 600 000.
TEST_CASE("dispersion: a plate transmits each channel by its own indices") {
    for (const Rgb& absorption : {Rgb{0}, Rgb{1, 4, 15}}) {
        Room room;
        const auto flint =
            room.add(DispersiveGlass{.law = sf66<float>, .absorption = absorption});
        const auto black = room.add(Lambertian{.albedo = Rgb{0}});
        ljus_test::add_block(room, {-50, -50, 0}, {50, 50, 0.1f}, flint);
        room.add(Quad{{-90, -90, -1}, {180, 0, 0}, {0, 180, 0}}, black, Rgb{1});
        const World world(std::move(room));
        const PathTracer tracer(world, {.sample_lights = false});
        for (int c = 0; c < 3; ++c) {
            CAPTURE(absorption[c]);
            const double inside = std::exp(-0.1 * double(absorption[c]));
            const auto right = over_wavelengths(sf66<double>, [&](double n) {
                const double r = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
                // all reflections inside
                return (1 - r) * (1 - r) * inside / (1 - r * r * inside * inside);
            });
            if (c == 0 && inside == 1) CHECK(right.x > right.z + 0.01);
            const Mean seen = ljus_test::mean_radiance(
                tracer, 100000, 20,
                [](auto&) {
                    return Ray{.origin{0.1f, 0.2f, 2}, .direction{0, 0, -1}};
                },
                c);
            CHECK(seen.agrees_with(right[c]));
        }
    }
}

namespace {

/// A long narrow lamp, a prism of heavy flint, and the floor on which its light falls;
/// all of them are long in z.
World<Room> lamp_and_prism() {
    Room room;
    const auto floor = room.add(Lambertian{.albedo = Rgb{0.5f}});
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    const auto flint = room.add(DispersiveGlass{.law = sf66<float>});
    const float half = 0.43633f, s = std::sin(half),
                c = std::cos(half); // of 50 degrees
    room.add(Quad{{0, 1, -2}, {-s, -c, 0}, {0, 0, 4}}, flint);
    room.add(Quad{{0, 1, 2}, {s, -c, 0}, {0, 0, -4}}, flint);
    room.add(Quad{{-s, 1 - c, -2}, {2 * s, 0, 0}, {0, 0, 4}}, flint);
    const float up = std::asin(1.93f * s) - half; // towards least deviation
    const Vec3 in{std::cos(up), std::sin(up), 0}, side{-in.y, in.x, 0};
    const Vec3 face{-s / 2, 1 - c / 2, 0};
    room.add(
        Quad{face - 3.0f * in - 0.05f * side - Vec3{0, 0, 2}, 0.1f * side, {0, 0, 4}},
        black, Rgb{40});
    room.add(Quad{{-6, -2, 6}, {12, 0, 0}, {0, 0, -12}}, floor);
    return World(std::move(room));
}

/// The mean radiance of the floor between two x, for each channel.
template <typename Renderer>
std::array<Mean, 3> floor_between(const Renderer& renderer, float low, float high,
                                  int paths, std::uint64_t seed) {
    std::array<Mean, 3> mean;
    Counts counts;
    for (int path = 0; path < paths; ++path) {
        auto stream = random_stream(ljus_test::test_seed(seed), Pass::camera, 0,
                                    static_cast<std::uint64_t>(path));
        const auto u = next_2d<float>(stream);
        const Ray ray{.origin{low + u.x * (high - low), -1.95f, u.y - 0.5f},
                      .direction{0, -1, 0}};
        auto context = context_of(stream, counts);
        const Rgb seen = radiance(renderer, ray, context);
        for (int c = 0; c < 3; ++c) mean[std::size_t(c)].add(double(seen[c]));
    }
    return mean;
}

} // namespace

// 2 strips, 3 channels: a false alarm once in 1000 runs.
TEST_CASE("dispersion: photons colour a spectrum as paths do") {
    constexpr double risk = 1e-3 / 6;
    const auto world = lamp_and_prism();
    const PathTracer tracer(world);
    for (const float low : {2.4f, 3.0f}) {
        const auto right = floor_between(OnlyPaths(tracer, "EDS+L"), low, low + 0.5f,
                                         200000, 50 + std::uint64_t(low));
        std::array<Mean, 3> found;
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            const PhotonMapper mapper(
                world, {.caustics{.photons = 30000, .seed = ljus_test::test_seed(seed)},
                        .general{.photons = 0},
                        .caustics_estimate{.radius = 0.03f}});
            const auto one =
                floor_between(OnlyPaths(mapper, "EDS+L"), low, low + 0.5f, 1000, seed);
            for (std::size_t c = 0; c < 3; ++c) found[c].add(one[c].mean);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            MESSAGE(low, ", channel ", c, ": ", found[c].mean, " +- ", found[c].error(),
                    " and ", right[c].mean, " +- ", right[c].error());
            CHECK(ljus_test::chance_of(found[c], right[c], 0.02 * right[c].mean) >
                  risk);
        }
        // Above the lamp's own blur, the spectrum ends in blue.
        if (low < 3) CHECK(found[2].mean > 3 * found[0].mean);
    }
}

TEST_CASE("dispersion: photons keep account of the flux that a wavelength moves") {
    Room room;
    room.add(Sphere{{0, 0, 0}, 1}, room.add(DispersiveGlass{.law = sf66<float>}));
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Sphere{{0, 3, 0}, 0.3f}, black, Rgb{1});
    const World world(std::move(room));
    const auto traced = trace_photons(world, MapType::caustics, {.photons = 4000});
    const FluxAudit& audit = traced.audit;
    for (int c = 0; c < 3; ++c) {
        const double all =
            audit.absorbed[c] + audit.escaped[c] + audit.cut[c] + audit.roulette[c];
        CHECK(all == doctest::Approx(audit.emitted[c]).epsilon(1e-5));
        CHECK(audit.roulette[c] != 0);
    }
    // Clear glass absorbs nothing; only the lamp does, what the ball reflects to it.
    CHECK(max_component(audit.absorbed) < 0.05 * audit.emitted.x);
    CHECK(-max_component(-audit.absorbed) >= 0);
}

TEST_CASE("dispersion: what is not possible is said") {
    const auto refusal = [](const auto& glass) {
        return ljus_test::refusal([&] { check(glass); });
    };
    CHECK(refusal(DispersiveGlass{.law = bk7<float>}).empty());
    CHECK(refusal(DispersiveGlassT<float, Cauchy>{.law = {1.4f, 0.01f}}).empty());
    // A resonance at 500 nm.
    const std::string said = refusal(DispersiveGlass{.law = {{1.0f}, {0.25f}}});
    CHECK(said.find("dispersive_glass.law at 360 nm") != std::string::npos);
    // One between 494 and 500 nm alone.
    CHECK(refusal(DispersiveGlass{.law = {{1, 0.05f}, {0, 0.25f}}})
              .find("dispersive_glass.law at 49") != std::string::npos);
    CHECK(refusal(DispersiveGlassT<float, Cauchy>{.law = {-1, 0}}) != "");
    CHECK(refusal(DispersiveGlass{.law = bk7<float>, .absorption{-1, 0, 0}})
              .find("dispersive_glass.absorption") != std::string::npos);
    const auto world = lamp_and_prism();
    CHECK_THROWS_WITH_AS(
        (void)trace_light_paths(world, {}),
        doctest::Contains("the number of materials that disperse light"),
        std::invalid_argument);
}
