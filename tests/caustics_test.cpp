/// \file caustics_test.cpp
/// \brief The caustics map against geometric optics and against tracers of our own.
///
/// Standard errors come from 16 seeds. A single number is accepted within 5 of them,
/// once in 6000 runs a false alarm with 15 degrees of freedom, were the seeds new; of n
/// numbers together the bound is Student's for one false alarm in 1000 runs, and is
/// written beside them. Run with 20 further seeds: none failed.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>
#include <vector>

#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/photons/density_estimate.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/scene/scene.hpp"
#include "support/ball_caustic.hpp"
#include "support/draws.hpp"
#include "support/integrate.hpp"
#include "support/mean.hpp"
#include "support/seed.hpp"
#include "support/within.hpp"

using namespace ljus;
using ljus_test::apart;
using ljus_test::BallCaustic;
using ljus_test::Mean;

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::uint64_t seeds = 16;

using Open = Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass, Mirror>,
                   Lights<PointLight>>;
using Room = World<Open>;
const Lambertian white{.albedo = Rgb{0.5f}};

/// The floor y = height, from -half to half, lit from above.
void add_floor(Open& room, float height, float half) {
    room.add(Quad{.corner{-half, height, -half},
                  .edge_u{0, 0, 2 * half},
                  .edge_v{2 * half, 0, 0}},
             room.add(white));
}

/// The scene of a closed form. A floor of a ten thousand radii catches all but what
/// leaves almost level, and rounds positions to a thousandth of the ball.
Room room_of(const BallCaustic& ball, bool mirror = false, double half = 1e4) {
    Open room;
    add_floor(room, float(-ball.floor), float(half * ball.radius));
    const Sphere shape{.radius = float(ball.radius)};
    if (mirror)
        room.add(shape, room.add(Mirror{.reflectance = Rgb{0.8f}}));
    else
        room.add(shape, room.add(Glass{.index = float(ball.index),
                                       .absorption = Rgb{float(ball.absorption)}}));
    room.add(PointLight{.position{0, float(ball.light), 0},
                        .intensity = Rgb{float(ball.intensity)}});
    return Room(std::move(room));
}

std::vector<Photon> caustic_photons(const Room& room, long long count,
                                    std::uint64_t seed) {
    return trace_photons(
               room, MapType::caustics,
               {.photons = count, .seed = ljus_test::test_seed(seed), .threads = 1})
        .photons;
}

/// The flux on the floor. Black lamps catch photons, too, on their lower sides.
double power(const std::vector<Photon>& photons) {
    double sum = 0;
    for (const Photon& photon : photons)
        if (photon.normal.y > 0) sum += double(photon.flux.x);
    return sum;
}

/// The power of a room's caustics, over the seeds.
Mean power_of(const Room& room, long long count) {
    Mean mean;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
        mean.add(power(caustic_photons(room, count, seed)));
    return mean;
}

/// The irradiance that an estimate reads on the floor.
double irradiance(const PhotonMap& map, Vec3 at,
                  const DensityEstimateSettings& gather) {
    VertexT<float> surface{};
    surface.point.position = at;
    surface.point.normal = {0, 1, 0};
    surface.frame = frame_around(surface.point.normal);
    std::uint64_t gathered = 0;
    const Rgb radiance = estimate_radiance(map, surface, white, Vec3{0, 0, 1}, gather,
                                           ljus::all_kinds, gathered);
    return double(radiance.x) * pi / 0.5;
}

} // namespace

TEST_CASE("caustics: the light of a point light through a glass ball, ring by ring") {
    // In focus, before it, behind it, and through a heavy glass. Of up to 40 rings
    // each, 6 standard errors of 16 seeds are exceeded once in 1000 runs of all.
    for (const BallCaustic& ball :
         {BallCaustic{}, BallCaustic{.floor = 0.6}, BallCaustic{.floor = 3},
          BallCaustic{.light = 1, .floor = 0.8, .radius = 0.7, .index = 1.9}}) {
        constexpr int rings = 40;
        const double width = 2 * ball.radius / rings;
        std::array<double, rings + 1> right{};
        const auto ring_of = [&](double rho) {
            return std::size_t(std::min(rho / width, double(rings)));
        };
        ball.shower([&](double rho, double flux) { right[ring_of(rho)] += flux; });

        std::array<Mean, rings + 1> found{};
        const Room room = room_of(ball, false, 50);
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            std::array<double, rings + 1> flux{};
            for (const Photon& photon : caustic_photons(room, 10000, seed))
                flux[ring_of(std::hypot(double(photon.position.x),
                                        double(photon.position.z)))] +=
                    double(photon.flux.x);
            for (std::size_t i = 0; i <= rings; ++i) found[i].add(flux[i]);
        }
        CAPTURE(ball.floor);
        for (std::size_t i = 0; i < rings; ++i) {
            CAPTURE(i);
            CAPTURE(found[i].mean);
            CAPTURE(right[i]);
            // Rings of a few photons have no standard error worth the name.
            if (right[i] < 5e-4 * BallCaustic{}.intensity) continue;
            CHECK(std::abs(apart(found[i], right[i], 1e-4)) < 6);
        }
    }
}

TEST_CASE("caustics: the estimate is the kernel's mean of the closed form") {
    const BallCaustic ball{.floor = 0.6};
    const Room room = room_of(ball, false, 50);
    const double radius = 0.03;
    // No fold within the radius of any of them.
    const std::array places{0.06, 0.2, 0.8, 0.9};
    // The mean of the exact light over Epanechnikov's hill: each ring of light crosses
    // the disc with an arc.
    std::array<double, 4> right{};
    ball.shower([&](double rho, double flux) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (std::abs(rho - places[i]) >= radius) continue;
            const double near2 = (rho - places[i]) * (rho - places[i]);
            // d^2 = (rho - place)^2 + 4 rho place sin^2(phi/2) < r^2
            const double s =
                std::sqrt((radius * radius - near2) / (4 * rho * places[i]));
            const double arc = s >= 1 ? pi : 2 * std::asin(s);
            const double mean = ljus_test::integrate(0, arc, 2, [&](double phi) {
                const double half = std::sin(phi / 2);
                const double d2 = near2 + 4 * rho * places[i] * half * half;
                return 2 * (1 - d2 / (radius * radius));
            });
            right[i] += flux * mean / pi / (pi * radius * radius);
        }
    });
    std::array<Mean, 4> found{};
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const PhotonMap map = make_photon_map(caustic_photons(room, 100000, seed));
        for (std::size_t i = 0; i < places.size(); ++i)
            found[i].add(irradiance(map, {float(places[i]), -0.6f, 0},
                                    {.radius = float(radius)}));
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        CAPTURE(places[i]);
        CAPTURE(found[i].mean);
        CAPTURE(found[i].error());
        CAPTURE(right[i]);
        CHECK(std::abs(apart(found[i], right[i], 1e-4)) < 5.5); // 4 of 1 in 16000
        // Away from the fold it is the ratio of areas itself.
        const double exact = ball.irradiance(places[i]);
        CAPTURE(exact);
        CHECK(right[i] == ljus_test::within(exact, 0.08));
    }
}

TEST_CASE("caustics: the floor gets the power that the ball lets through") {
    // Clear to dark glass, and a light that touches the ball to one far away.
    for (const auto& [absorption, light] :
         {std::pair{0.0, 2.0}, std::pair{0.3, 0.51}, std::pair{0.3, 2.0},
          std::pair{0.3, 50.0}, std::pair{2.0, 2.0}}) {
        const BallCaustic ball{.light = light, .absorption = absorption};
        double right = 0;
        ball.shower([&](double, double flux) { right += flux; });
        CAPTURE(ball.absorption);
        CAPTURE(ball.light);
        const Mean found = power_of(room_of(ball), 10000);
        CAPTURE(found.mean);
        CAPTURE(right);
        CHECK(std::abs(apart(found, right, 1e-4)) < 4.3); // 5 of 1 in 1000
    }
}

TEST_CASE("caustics: the three colours of an absorbing glass") {
    Open room;
    add_floor(room, -1, 100);
    room.add(Sphere{.radius = 0.5f}, room.add(Glass{.absorption{0.1f, 1.0f, 3.0f}}));
    room.add(PointLight{.position{0, 2, 0}});
    const World world(std::move(room));
    std::array<Mean, 3> found;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        glm::dvec3 sum(0);
        for (const Photon& photon : caustic_photons(world, 10000, seed))
            sum += glm::dvec3(photon.flux);
        for (int c = 0; c < 3; ++c) found[std::size_t(c)].add(sum[c]);
    }
    const std::array absorption{0.1, 1.0, 3.0};
    for (std::size_t c = 0; c < 3; ++c) {
        double right = 0;
        BallCaustic{.absorption = absorption[c]}.shower(
            [&](double, double flux) { right += flux; });
        CHECK(std::abs(apart(found[c], right, 1e-4)) < 4);
    }
}

TEST_CASE("caustics: a mirror ball and a flat mirror") {
    // What the lower rays of the cone throw on the floor: k = -1 with F = 0.8.
    const BallCaustic ball{.light = 1, .floor = 0.6};
    double right = 0;
    const int steps = 100000;
    for (int i = 0; i < steps; ++i) {
        const double alpha = (i + 0.5) / steps * ball.last();
        if (ball.trace(alpha, -1).lands)
            right += 2 * pi * std::sin(alpha) * ball.last() / steps * 0.8;
    }
    // The floor ends; far out lands nothing but what leaves almost level.
    const Mean found = power_of(room_of(ball, true), 20000);
    CAPTURE(found.mean);
    CAPTURE(right);
    CHECK(std::abs(apart(found, right, 1e-3)) < 5);

    // A square mirror straight above the light: its solid angle from there.
    for (const float height : {0.05f, 0.3f, 2.0f}) {
        Open room;
        add_floor(room, -1, 200);
        room.add(
            Quad{.corner{-0.5f, height, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}},
            room.add(Mirror{.reflectance = Rgb{0.9f}}));
        room.add(PointLight{});
        const World world(std::move(room));
        const double h = 2 * double(height);
        const double solid_angle = 4 * std::asin(1 / (1 + h * h));
        const Mean flat = power_of(world, 8000);
        CAPTURE(height);
        CAPTURE(flat.mean);
        CAPTURE(flat.error());
        CHECK(std::abs(apart(flat, 0.9 * solid_angle, 3e-3)) < 5);
    }
}

namespace {

// A tracer of our own, in double, that shares no line with the library: photons leave
// the light everywhere, and are followed through balls of glass or mirror to the floor.

struct OwnBall {
    glm::dvec3 center;
    double radius;
    double index; // 0: a mirror; below 0: black
};

struct OwnRoom {
    std::vector<OwnBall> balls;
    double floor;
    glm::dvec3 light;
    double lamp = 0; // side of a square lamp that shines down; 0: a point light
};

/// The power that reaches the floor by way of at least one ball.
double own_power(const OwnRoom& room, long long paths, std::uint64_t seed) {
    std::mt19937_64 engine(ljus_test::test_seed(seed));
    const auto unit = [&] { return double(engine() >> 11) * 0x1p-53; };
    long long landed = 0;
    for (long long path = 0; path < paths; ++path) {
        glm::dvec3 o = room.light, d;
        const double phi = 2 * pi * unit();
        if (room.lamp > 0) {
            o += room.lamp * glm::dvec3{unit() - 0.5, 0, unit() - 0.5};
            const double s = std::sqrt(unit());
            d = {s * std::cos(phi), -std::sqrt(1 - s * s), s * std::sin(phi)};
        } else {
            const double y = 2 * unit() - 1, s = std::sqrt(1 - y * y);
            d = {s * std::cos(phi), y, s * std::sin(phi)};
        }
        bool met = false;
        for (int bounce = 0; bounce < 200; ++bounce) {
            double t = d.y < 0 ? (room.floor - o.y) / d.y : 1e30;
            if (t < 1e-9) t = 1e30;
            const OwnBall* first = nullptr;
            for (const OwnBall& ball : room.balls) {
                const glm::dvec3 m = o - ball.center;
                const double b = glm::dot(m, d);
                const double q = b * b - glm::dot(m, m) + ball.radius * ball.radius;
                if (q < 0) continue;
                for (const double at : {-b - std::sqrt(q), -b + std::sqrt(q)})
                    if (at > 1e-9 && at < t) {
                        t = at;
                        first = &ball;
                        break;
                    }
            }
            if (!first) {
                if (t < 1e29 && met) ++landed;
                break;
            }
            if (first->index < 0) break;
            met = true;
            o += t * d;
            glm::dvec3 n = (o - first->center) / first->radius;
            const bool inside = glm::dot(n, d) > 0;
            if (inside) n = -n;
            const double c = -glm::dot(n, d);
            if (first->index == 0) {
                if (unit() >= 0.8) break;
                d += 2 * c * n;
                continue;
            }
            const double eta = inside ? first->index : 1 / first->index;
            const double s2 = eta * eta * (1 - c * c);
            double f = 1;
            if (s2 < 1) {
                const double ct = std::sqrt(1 - s2);
                const double s = (eta * c - ct) / (eta * c + ct);
                const double p = (c - eta * ct) / (c + eta * ct);
                f = (s * s + p * p) / 2;
                if (unit() >= f) {
                    d = glm::normalize(eta * d + (eta * c - ct) * n);
                    continue;
                }
            }
            d += 2 * c * n;
        }
    }
    return double(landed) / double(paths);
}

/// The same room, and the flux that its light sends out in all.
Room library_room(const OwnRoom& own, double& flux) {
    Open room;
    add_floor(room, float(own.floor), 500);
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    for (const OwnBall& ball : own.balls) {
        const Sphere shape{.center{ball.center}, .radius = float(ball.radius)};
        if (ball.index > 0)
            room.add(shape, room.add(Glass{.index = float(ball.index)}));
        else if (ball.index == 0)
            room.add(shape, room.add(Mirror{.reflectance = Rgb{0.8f}}));
        else
            room.add(shape, black);
    }
    if (own.lamp > 0) {
        const auto side = float(own.lamp);
        room.add(Quad{.corner = Vec3{own.light} - side / 2 * Vec3{1, 0, 1},
                      .edge_u{side, 0, 0},
                      .edge_v{0, 0, side}},
                 black, Rgb{1});
        flux = pi * own.lamp * own.lamp;
    } else {
        room.add(PointLight{.position{own.light}});
        flux = 4 * pi;
    }
    return Room(std::move(room));
}

} // namespace

TEST_CASE("caustics: overlapping targets, an occluder, a lamp within its target") {
    const std::array rooms{
        // Two balls of glass, one behind the other and a little beside it.
        OwnRoom{{{{0, 0, 0}, 0.5, 1.5}, {{0.4, -1.2, 0}, 0.6, 1.3}}, -2, {0, 1, 0}},
        // Glass behind a mirror.
        OwnRoom{{{{0.3, 0.2, 0}, 0.3, 0}, {{0, -1, 0}, 0.7, 1.5}}, -2, {0, 1, 0}},
        // A black ball in the way of half of the glass.
        OwnRoom{{{{0.4, 0.5, 0}, 0.3, -1}, {{0, -0.5, 0}, 0.6, 1.5}}, -2, {0, 1.5, 0}},
        // A square lamp that shines down through a ball in which it hangs, and one that
        // hangs above two.
        OwnRoom{{{{0, 0, 0}, 1, 1.5}}, -2, {0.1, 0.2, 0}, 0.5},
        OwnRoom{{{{-0.5, 0, 0}, 0.5, 1.5}, {{0.4, 0.1, 0.2}, 0.4, 1.8}},
                -1,
                {0, 1, 0},
                0.6},
        // A point light in a bubble of glass between two mirrors.
        OwnRoom{{{{0, 0, 0}, 0.5, 1.5}, {{1.5, 0.5, 0}, 0.6, 0}, {{-1, 0, 1}, 0.5, 0}},
                -2,
                {0.1, 0.1, 0}}};
    for (std::size_t i = 0; i < rooms.size(); ++i) {
        double flux = 0;
        const Room room = library_room(rooms[i], flux);
        const Mean found = power_of(room, 10000);
        Mean right;
        for (std::uint64_t seed = 1; seed <= 16; ++seed)
            right.add(flux * own_power(rooms[i], 45000, seed));
        CAPTURE(i);
        CAPTURE(found.mean);
        CAPTURE(found.error());
        CAPTURE(right.mean);
        CAPTURE(right.error());
        CHECK(std::abs(apart(found, right)) < 5);
        CHECK(std::hypot(found.error(), right.error()) < 0.02 * right.mean);
    }
}

TEST_CASE("caustics: invisible glass throws the light that its shadow lacks") {
    // Index 1 is met by shadow rays and sent through by photons: together nothing.
    const double height = 1 + 2; // of the light above the floor
    for (const double index : {1.0, 1.0001}) {
        const Room room = room_of(BallCaustic{.index = index});
        Mean found;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const PhotonMap map = make_photon_map(caustic_photons(room, 15000, seed));
            found.add(irradiance(map, {0.2f, -1, 0}, {.radius = 0.1f}));
        }
        const double d2 = height * height + 0.04;
        CHECK(std::abs(apart(found, height / (d2 * std::sqrt(d2)), 2e-3)) < 5);
    }
}

TEST_CASE("caustics: diamond and beyond, near and far, small and large") {
    for (const double index : {1.0001, 2.4, 100.0})
        for (const double scale : {1e-6, 1.0, 1e6}) {
            const BallCaustic ball{.light = 2 * scale,
                                   .floor = scale,
                                   .radius = 0.5 * scale,
                                   .index = index,
                                   .intensity = scale * scale};
            double right = 0;
            ball.shower([&](double, double flux) { right += flux; });
            const Mean found = power_of(room_of(ball), 4000);
            CAPTURE(index);
            CAPTURE(scale);
            CAPTURE(found.mean / right);
            CHECK(std::abs(apart(found, right, 5e-3)) < 4.5); // 9 of 1 in 1000
        }
}

TEST_CASE("caustics: 0, 1, k - 1 and k photons, and a radius larger than the room") {
    const BallCaustic ball{};
    const Room room = room_of(ball);
    CHECK(caustic_photons(room, 0, 1).empty());
    for (const std::size_t count : {1u, 4u, 5u}) {
        auto photons = caustic_photons(room, 1000, 2);
        REQUIRE(photons.size() > 10);
        photons.resize(count);
        const PhotonMap map = make_photon_map(photons);
        const DensityEstimateSettings all{.radius = 1e6f, .kernel = Kernel::box};
        // Everything, over the area that was asked for.
        CHECK(irradiance(map, {0, -1, 0}, all) ==
              ljus_test::within(power(photons) / (pi * 1e12), 1e-5));
        // Fewer than k are that, too; of k the farthest sets the radius.
        DensityEstimateSettings nearest = all;
        nearest.nearest = 5;
        const double found = irradiance(map, {0, -1, 0}, nearest);
        if (count < 5) {
            CHECK(found == doctest::Approx(irradiance(map, {0, -1, 0}, all)));
        } else {
            double farthest = 0, flux_there = 0;
            for (const Photon& photon : photons) {
                const double d =
                    glm::distance(glm::dvec3(photon.position), glm::dvec3(0, -1, 0));
                if (d <= farthest) continue;
                farthest = d;
                flux_there = double(photon.flux.x);
            }
            CHECK(found == ljus_test::within((power(photons) - flux_there) /
                                                 (pi * farthest * farthest),
                                             1e-4));
        }
        // The largest float that check() lets pass.
        const DensityEstimateSettings huge{.radius = 3e38f};
        CHECK(std::isfinite(irradiance(map, {0, -1, 0}, huge)));
    }
}

TEST_CASE("caustics: k nearest is unbiased for every k from 2 to 50") {
    // Of 49 x 2 means the largest lies beyond 4.6 standard errors once in 2000 runs; of
    // k = 2 the variance is infinite, and of 3 the box's is: they are only near.
    ljus_test::Draws numbers{24};
    std::array<std::array<ljus_test::Mean, 51>, 2> found{};
    for (int i = 0; i < 2000; ++i) {
        std::vector<Photon> photons(300);
        for (Photon& photon : photons)
            photon = {.position{float(numbers.between(-1, 1)), 0,
                                float(numbers.between(-1, 1))},
                      .direction{0, -1, 0},
                      .flux = Rgb{4.0f / 300}};
        const PhotonMap map = make_photon_map(photons);
        for (std::size_t k = 2; k <= 50; ++k)
            for (const std::size_t j : {0u, 1u})
                found[j][k].add(irradiance(
                    map, Vec3{0},
                    {.radius = 0.99f,
                     .nearest = k,
                     .kernel = j == 0 ? Kernel::box : Kernel::epanechnikov}));
    }
    for (std::size_t k = 2; k <= 50; ++k)
        for (const std::size_t j : {0u, 1u}) {
            CAPTURE(k);
            CAPTURE(j);
            CAPTURE(found[j][k].mean);
            if (k <= 3)
                CHECK(found[j][k].mean ==
                      doctest::Approx(1).epsilon(k == 2 ? 0.3 : 0.1));
            else
                CHECK(std::abs(found[j][k].sigmas(1)) < 4.6);
        }
}

namespace {

/// A point light under a square mirror: from the floor a second light behind a square
/// window, whose edge is sharp on the floor.
Room window() {
    Open room;
    add_floor(room, 0, 20);
    room.add(
        Quad{.corner{-0.2f, 1.5f, -0.2f}, .edge_u{0.4f, 0, 0}, .edge_v{0, 0, 0.4f}},
        room.add(Mirror{.reflectance = Rgb{1}}));
    room.add(PointLight{.position{0, 1, 0}});
    return Room(std::move(room));
}

/// Its exact light: the mirror image stands at height 2, and the window at 1.5 is four
/// times as large on the floor.
double window_light(double x, double z) {
    const double half = 0.2 * 2 / 0.5;
    if (std::max(std::abs(x), std::abs(z)) > half) return 0;
    const double d2 = x * x + z * z + 4;
    return 2 / (d2 * std::sqrt(d2));
}

} // namespace

TEST_CASE("caustics: with an edge in the picture the best error falls with N^(-1/3)") {
    // A strip across the edge. Bias there is O(1) in a band as wide as r: MSE is about
    // a r + b / (N r^2), the best r goes with N^(-1/3), and so does the MSE.
    const Room room = window();
    std::vector<double> log_count, log_error;
    for (const long long count : {500LL, 4000LL, 32000LL}) {
        std::vector<double> error;
        std::vector<float> radii;
        for (int i = 0; i < 9; ++i)
            radii.push_back(2.2f * std::pow(float(count), -1.0f / 3) *
                            std::pow(2.0f, float(i - 4) / 3));
        error.resize(radii.size());
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const PhotonMap map = make_photon_map(caustic_photons(room, count, seed));
            for (std::size_t i = 0; i < radii.size(); ++i)
                for (int place = 0; place < 150; ++place) {
                    const double x = 0.2 + 0.9 * (place + 0.5) / 150;
                    const double z = 0.3 * std::sin(place * 2.4);
                    const double e =
                        irradiance(map, {float(x), 0, float(z)}, {.radius = radii[i]}) -
                        window_light(x, z);
                    error[i] += e * e;
                }
        }
        const auto least = std::min_element(error.begin(), error.end());
        CHECK(least != error.begin());
        CHECK(least != error.end() - 1);
        log_count.push_back(std::log(double(count)));
        log_error.push_back(std::log(*least));
    }
    const double found = ljus_test::slope(log_count, log_error);
    CHECK(std::abs(found + 1.0 / 3) < 0.05);
}

TEST_CASE("caustics: both ways at the first glass are one way in the mean") {
    // A ball under a square lamp, looked at so that some paths mirror the lamp.
    double flux = 0;
    const Room room =
        library_room(OwnRoom{{{{0, 0, 0}, 0.5, 1.5}}, -1, {0, 2, 0}, 0.8}, flux);
    std::array<Mean, 2> means;
    for (const bool split : {false, true}) {
        PhotonMappingSettings settings{.split_glass = split};
        settings.caustics = {.photons = 20000, .threads = 1};
        const PhotonMapper mapper(room, settings);
        means[split ? 1 : 0] =
            ljus_test::mean_radiance(mapper, 10000, 3, [](RandomStream& stream) {
                const Vec2 u = next_2d<float>(stream) - 0.5f;
                return Ray{.origin{0.3f * u.x, 1.5f, 0.3f * u.y}, .direction{0, -1, 0}};
            });
    }
    CAPTURE(means[0].mean);
    CAPTURE(means[1].mean);
    CHECK(std::abs(apart(means[0], means[1])) < 5);
    CHECK(means[1].error() < means[0].error());
}

TEST_CASE(
    "caustics: a radius of 0 is that of 32 photons, and of 64 of the general map") {
    double flux = 0;
    const Room room =
        library_room(OwnRoom{{{{0, 0, 0}, 0.5, 1.5}}, -1, {0, 2, 0}, 0.8}, flux);
    PhotonMappingSettings settings{.indirect = IndirectLight::map};
    settings.caustics = {.photons = 5000, .threads = 1};
    settings.general = {.photons = 5000, .threads = 1};
    for (const float radius : {0.0f, 0.125f}) {
        settings.caustics_estimate.radius = settings.general_estimate.radius = radius;
        const PhotonMapper mapper(room, settings);
        const auto& maps = mapper.maps();
        CHECK(typical_radius(maps.caustics, 32) > 0);
        CHECK(typical_radius(maps.caustics, 32) < typical_radius(maps.caustics, 33));
        CHECK(mapper.settings().caustics_estimate.radius ==
              (radius > 0 ? radius : float(typical_radius(maps.caustics, 32))));
        CHECK(mapper.settings().general_estimate.radius ==
              (radius > 0 ? radius : float(typical_radius(maps.general, 64))));
    }
}
