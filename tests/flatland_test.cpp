/// \file flatland_test.cpp
/// \brief Flatland's physics against closed forms, quadratures and each other.
///
/// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
/// none failed.

#include "flatland/density_estimate.hpp"
#include "flatland/path_tracing.hpp"
#include "flatland/room.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "support/ball_caustic.hpp"
#include "support/mean.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"
#include "support/within.hpp"

using namespace flatland;
using ljus::Kernel, ljus::Pass, ljus::PhotonKind, ljus::Transport;
using ljus_test::Mean, ljus_test::apart, ljus_test::test_seed, ljus_test::within;

// A mean that is compared with what it should be may be 5 standard errors away: a false
// alarm in 1.7 million, if the means are normal. All tests of this file together ask
// about 150 times, so that one seed in ten thousand raises one.

namespace {

constexpr double pi = std::numbers::pi;

/// The unit vector at an angle from the normal, in the frame of a surface.
Vec2 at_angle(double theta) {
    return {std::sin(theta), std::cos(theta)};
}

/// A lamp's stream of numbers.
ljus::RandomStream stream_of(std::uint64_t seed, int path) {
    return ljus::random_stream(test_seed(seed), Pass::camera, 0,
                               static_cast<std::uint64_t>(path));
}

/// The walls of a square from 0 to 1, their normals inwards.
std::vector<Object> square(const Material& material, double emission = 0) {
    const Vec2 a{0, 0}, b{1, 0}, c{1, 1}, d{0, 1};
    return {{Segment{a, b}, material, emission},
            {Segment{b, c}, material, emission},
            {Segment{c, d}, material, emission},
            {Segment{d, a}, material, emission}};
}

/// A point of a floor of albedo 1, seen from straight above.
Vertex floor_vertex(double x) {
    return {.point{.position{x, 0}, .normal{0, 1}}, .object{.material = Lambertian{1}}};
}

/// The irradiance that direct_light() finds there: f = 1/2, so that E = 2 L.
Mean direct_irradiance(const Scene& scene, double x, int paths) {
    Mean mean;
    for (int i = 0; i < paths; ++i) {
        auto stream = stream_of(11, i);
        mean.add(2 *
                 direct_light(scene, floor_vertex(x), ljus::next_2d<double>(stream)));
    }
    return mean;
}

} // namespace

TEST_CASE("flatland: a Lambertian surface reflects its albedo, by quadrature") {
    const Material matt = Lambertian{0.7};
    const int steps = 20000;
    for (const double wo : {0.1, -1.2, pi - 0.5}) {
        double reflected = 0;
        for (int i = 0; i < steps; ++i) {
            const double theta = 2 * pi * (i + 0.5) / steps;
            reflected += evaluate(matt, at_angle(wo), at_angle(theta)) *
                         std::abs(std::cos(theta)) * 2 * pi / steps;
        }
        CHECK(reflected == within(0.7, 1e-6));
    }
    CHECK(evaluate(Mirror{}, at_angle(0.3), at_angle(-0.3)) == 0);
}

TEST_CASE("flatland: directions by the cosine have the density that pdf says") {
    double sum = 0;
    const int steps = 20000;
    for (int i = 0; i < steps; ++i)
        sum += pdf_cosine_half_circle(at_angle(pi * (i + 0.5) / steps - pi / 2)) * pi /
               steps;
    CHECK(sum == within(1, 1e-6));
    CHECK(pdf_cosine_half_circle(at_angle(3)) == 0);

    // In cells of equal angle; the share of one is the integral of cos/2.
    const int cells = 24, draws = 100000;
    std::vector<double> counts(cells), expected(cells);
    for (int i = 0; i < draws; ++i) {
        const Vec2 d = sample_cosine_half_circle((i + 0.5) / draws);
        CHECK(glm::dot(d, d) == within(1, 1e-14));
        const double theta = std::atan2(d.x, d.y);
        counts[std::size_t(cells * (theta / pi + 0.5))] += 1;
    }
    for (int i = 0; i < cells; ++i) {
        const double low = pi * i / cells - pi / 2, high = low + pi / cells;
        expected[std::size_t(i)] = draws * (std::sin(high) - std::sin(low)) / 2;
        // Evenly spaced u: each border of a cell may cut one draw off.
        CHECK(std::abs(counts[std::size_t(i)] - expected[std::size_t(i)]) <= 2);
    }
}

TEST_CASE("flatland: a sample's weight is f cos/pdf, on the side of wo") {
    const Material matt = Lambertian{0.6};
    for (const Vec2 wo : {at_angle(0.4), at_angle(2.5)})
        for (const double u : {0.01, 0.3, 0.9}) {
            const auto s = sample(matt, wo, u, Transport::radiance);
            REQUIRE(s);
            CHECK_FALSE(s->specular);
            CHECK(s->wi.y * wo.y > 0);
            CHECK(
                s->weight ==
                within(evaluate(matt, wo, s->wi) * std::abs(s->wi.y) / s->pdf, 1e-12));
        }
    CHECK_FALSE(sample(matt, Vec2{1, 0}, 0.5, Transport::flux));
}

TEST_CASE("flatland: a mirror and Snell's law") {
    const auto mirrored = sample(Mirror{0.8}, at_angle(0.5), 0.1, Transport::flux);
    REQUIRE(mirrored);
    CHECK(glm::distance(mirrored->wi, at_angle(-0.5)) < 1e-15);
    CHECK(mirrored->weight == 0.8);

    const double n = 1.5;
    for (const double theta : {0.0, 0.3, 0.7, 1.3, -0.9}) {
        // u just below 1: refraction, wherever there is any.
        const auto in = sample(Glass{n}, at_angle(theta), 0.999999, Transport::flux);
        REQUIRE(in);
        CHECK(in->wi.y < 0);
        CHECK(in->wi.x == doctest::Approx(-std::sin(theta) / n));
        CHECK(in->weight == 1);
        const auto out = sample(Glass{n}, in->wi, 0.999999, Transport::flux);
        CHECK(glm::distance(out->wi, at_angle(theta)) < 1e-12);
    }
    // From inside, beyond the critical angle of 41.8 degrees.
    const Vec2 steep = at_angle(pi - 0.8);
    const auto total = sample(Glass{n}, steep, 0.999999, Transport::flux);
    CHECK(glm::distance(total->wi, Vec2{-steep.x, steep.y}) < 1e-15);
}

TEST_CASE("flatland: radiance across a boundary scales by n, not by its square") {
    // A narrow pencil of rays: the flux L cos(theta) d theta is the same on both sides.
    const double n = 1.7, theta = 0.6, d = 1e-5;
    const auto angle_inside = [&](double outside) {
        return std::asin(std::sin(outside) / n);
    };
    const double inside = angle_inside(theta);
    const double d_inside = angle_inside(theta + d / 2) - angle_inside(theta - d / 2);
    const double radiance_inside =
        std::cos(theta) * d / (std::cos(inside) * d_inside); // for 1 outside
    CHECK(radiance_inside == within(n, 1e-6));

    const auto out = sample(Glass{n}, at_angle(theta), 0.999999, Transport::radiance);
    CHECK(out->weight * radiance_inside == within(1, 1e-6)); // seen from outside: 1
    const auto in =
        sample(Glass{n}, at_angle(pi - inside), 0.999999, Transport::radiance);
    CHECK(in->weight == within(radiance_inside, 1e-6));
    CHECK(in->eta_scale == in->weight);
}

TEST_CASE("flatland: rays meet segments and circles") {
    const Segment wall{.from{-1, 0}, .to{1, 0}};
    const Ray down{.origin{0.5, 2}, .direction{0, -1}};
    CHECK(*intersect(down, wall) == 2);
    CHECK(glm::distance(normal(wall, Vec2{0}), Vec2{0, 1}) == 0);
    CHECK_FALSE(intersect(Ray{.origin{1.5, 2}, .direction{0, -1}}, wall)); // beside
    CHECK_FALSE(intersect(Ray{.origin{0, 2}, .direction{0, 1}}, wall));    // behind
    CHECK_FALSE(intersect(Ray{.origin{-2, 0}, .direction{1, 0}}, wall));   // along it
    CHECK_FALSE(intersect(Ray{.origin{0, 0}, .direction{0, -1}}, wall)); // starts there
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(intersect(Ray{.origin{nan, 2}, .direction{0, -1}}, wall));

    const Circle disc{.center{0, 0}, .radius = 0.5};
    CHECK(*intersect(Ray{.origin{0, 2}, .direction{0, -1}}, disc) == 1.5);
    CHECK(*intersect(Ray{.origin{0, 0}, .direction{1, 0}}, disc) == 0.5); // from inside
    CHECK(*intersect(Ray{.origin{0, 0.5}, .direction{0, -1}}, disc) == 1); // across
    CHECK_FALSE(intersect(Ray{.origin{0.6, 2}, .direction{0, -1}}, disc));
    CHECK_FALSE(intersect(Ray{.origin{nan, 2}, .direction{0, -1}}, disc));
    CHECK(glm::distance(normal(disc, Vec2{0.5, 0}), Vec2{1, 0}) == 0);

    // A wall has both its ends, a ray both of its own.
    for (const double x : {-1.0, 1.0}) {
        const auto end = intersect(Ray{.origin{x, 2}, .direction{0, -1}}, wall);
        REQUIRE(end);
        CHECK(*end == 2);
    }
    for (const double t : {1.999, 2.0, 2.001}) {
        const Ray to{.origin{0, 2}, .direction{0, -1}, .t_max = t};
        CHECK(intersect(to, wall).has_value() == (t >= 2));
        const Ray from{.origin{0, 2}, .direction{0, -1}, .t_min = t};
        CHECK(intersect(from, wall).has_value() == (t <= 2));
        const Ray into{.origin{0, 2.5}, .direction{0, -1}, .t_max = t};
        CHECK(intersect(into, disc).has_value() == (t >= 2));
        const Ray out{.origin{0, 1.5}, .direction{0, -1}, .t_min = t};
        CHECK(intersect(out, disc).has_value() == (t <= 2)); // its far side
    }

    const Scene scene{{{wall}, {disc}}};
    CHECK(closest_hit(scene, Ray{.origin{0, 2}, .direction{0, -1}})->id == 1);
    CHECK(closest_hit(scene, Ray{.origin{0.7, 2}, .direction{0, -1}})->id == 0);
    CHECK(occluded(scene, {0, 2}, {0, -2}));
    CHECK_FALSE(occluded(scene, {0.7, 2}, {0.7, 0})); // the wall's own point
}

TEST_CASE("flatland: a frame turns a vector and back") {
    const Vec2 n = glm::normalize(Vec2{-0.3, 0.8}), v{0.2, -1.4};
    CHECK(to_local(n, n).y == within(1, 1e-15));
    CHECK(glm::distance(to_world(n, to_local(n, v)), v) < 1e-15);
    CHECK(to_local({0, 1}, v) == v); // a floor's frame is the world's
}

TEST_CASE("flatland: the light of a round lamp falls off as 1/r, whatever its size") {
    // E = flux cos(theta) / (2 pi r), as of a point; the sibling of Newton's shell.
    for (const double size : {0.01, 0.4})
        for (const double height : {0.5, 1.0, 2.0, 4.0}) {
            const double x = 0.75;
            const Circle lamp{.center{0, height}, .radius = size};
            const Scene scene{{{lamp, Lambertian{0}, radiance_of(lamp, 3.0)}}};
            CHECK(flux(scene) == within(3, 1e-12));
            const double r = std::hypot(x, height);
            const double right = 3.0 * (height / r) / (2 * pi * r);
            CHECK(std::abs(apart(direct_irradiance(scene, x, 20000), right)) < 5);
        }
}

TEST_CASE("flatland: the light of a straight lamp is a difference of sines") {
    // E = L (sin theta_2 - sin theta_1): Lambert's formula with a dimension less.
    const Scene scene{{{Segment{.from{0.9, 0.5}, .to{-0.2, 0.8}}, Lambertian{0}, 2.0}}};
    const double right =
        2.0 * (0.9 / std::hypot(0.9, 0.5) + 0.2 / std::hypot(0.2, 0.8));
    CHECK(std::abs(apart(direct_irradiance(scene, 0, 100000), right)) < 5);
    // Its back is dark.
    const Scene turned{
        {{Segment{.from{-0.2, 0.8}, .to{0.9, 0.5}}, Lambertian{0}, 2.0}}};
    CHECK(direct_irradiance(turned, 0, 100).mean == 0);
}

TEST_CASE("flatland: two lamps share the shadow rays, and both count") {
    const Circle left{.center{-1, 1}, .radius = 0.1},
        right{.center{1, 2}, .radius = 0.2};
    const Scene scene{{{left, Lambertian{0}, radiance_of(left, 1)},
                       {right, Lambertian{0}, radiance_of(right, 5)}}};
    const double expected = 1 * 1 / (2 * pi * 2) + 5 * 2 / (2 * pi * 5);
    CHECK(std::abs(apart(direct_irradiance(scene, 0, 100000), expected)) < 5);
}

TEST_CASE("flatland: photons of a lamp arrive by angle and by crossed strings") {
    const int photons = 100000;
    const auto share_that_meets = [&](const Scene& scene, std::size_t id) {
        Mean mean;
        for (int i = 0; i < photons; ++i) {
            auto stream = stream_of(5, i);
            PathState photon = emit_photon(scene, 1, stream);
            const auto vertex = next_vertex(scene, photon, stream);
            mean.add(vertex && vertex->id == id ? 1 : 0);
        }
        return mean;
    };
    // A small round lamp: the angle in which the wall is seen, over the whole turn.
    const Circle lamp{.center{0.2, 0.6}, .radius = 1e-4};
    const Scene point{{{Segment{.from{-1, 0}, .to{0.5, 0}}, Lambertian{0}},
                       {lamp, Lambertian{0}, radiance_of(lamp, 1)}}};
    const double angle = std::atan(1.2 / 0.6) + std::atan(0.3 / 0.6);
    CHECK(std::abs(apart(share_that_meets(point, 0), angle / (2 * pi))) < 5);

    // A straight lamp (Hottel): (diagonals - sides) / 2 over the length of the lamp.
    const Segment floor{.from{0, 0}, .to{1, 0}},
        ceiling{.from{0.8, 0.7}, .to{0.1, 0.5}};
    const Scene strips{{{floor, Lambertian{0}}, {ceiling, Lambertian{0}, 1.0}}};
    const double crossed = std::hypot(0.8, 0.7) + std::hypot(0.9, 0.5);
    const double sides = std::hypot(0.1, 0.5) + std::hypot(0.2, 0.7);
    const double right = (crossed - sides) / 2 / std::hypot(0.7, 0.2);
    CHECK(std::abs(apart(share_that_meets(strips, 0), right)) < 5);
}

TEST_CASE("flatland: in a furnace all is equally bright, glass and mirror too") {
    const double albedo = 0.6, emission = 0.5, right = emission / (1 - albedo);
    Scene scene{square(Lambertian{albedo}, emission)};
    scene.objects.push_back({Circle{.center{0.6, 0.5}, .radius = 0.2}, Glass{1.5}});
    scene.objects.push_back({Segment{.from{0.1, 0.3}, .to{0.3, 0.2}}, Mirror{1}});
    const auto mean_along = [&](const Vec2& origin, double angle) {
        Mean mean;
        const Ray ray{.origin = origin, .direction{std::cos(angle), std::sin(angle)}};
        for (int i = 0; i < 20000; ++i) {
            auto stream = stream_of(7, i);
            mean.add(radiance(scene, ray, stream));
        }
        return mean;
    };
    for (const double angle : {0.1, 1.0, 2.5, 3.3, 4.4, 5.9}) {
        CHECK(std::abs(apart(mean_along({0.2, 0.6}, angle), right)) < 5);
        // Inside the glass radiance is n times as high.
        CHECK(std::abs(apart(mean_along({0.6, 0.5}, angle), 1.5 * right)) < 5);
    }

    // The photons say the same: E = 2 L. By blocks, for the photons of a path belong
    // together.
    Mean irradiance;
    for (int block = 0; block < 40; ++block) {
        const PhotonMap map = trace_photons(
            scene, {.photons = 2000, .seed = test_seed(std::uint64_t(block))});
        irradiance.add(estimate_irradiance(map, {.position{0.5, 0}, .normal{0, 1}},
                                           {.radius = 0.3})
                           .irradiance);
    }
    CHECK(std::abs(apart(irradiance, 2 * right)) < 5);
}

TEST_CASE("flatland: as many bounces as are asked for") {
    const double albedo = 0.6, emission = 0.5;
    const Scene scene{square(Lambertian{albedo}, emission)};
    const Ray ray{.origin{0.4, 0.6}, .direction{0.6, -0.8}};
    double right = emission, order = emission;
    for (int depth = 1; depth <= 3; ++depth) {
        order *= albedo;
        right += order;
        Mean mean;
        for (int i = 0; i < 20000; ++i) {
            auto stream = stream_of(3, i);
            mean.add(radiance(scene, ray, stream, depth));
        }
        CHECK(std::abs(apart(mean, right)) < 5);
    }
}

TEST_CASE("flatland: roulette changes no mean") {
    // In a closed room the flux that arrives is 1 + albedo + albedo^2 + ... times that
    // of the lamps.
    const double albedo = 0.75;
    const Scene scene{square(Lambertian{albedo}, 1.0)};
    Mean arrived;
    for (int i = 0; i < 100000; ++i) {
        auto stream = stream_of(9, i);
        double sum = 0;
        trace_photon(
            scene, emit_photon(scene, 1, stream), stream, 1000,
            [&](const PathState& path, const Vertex&) { sum += path.throughput; });
        arrived.add(sum);
    }
    CHECK(std::abs(apart(arrived, 1 / (1 - albedo))) < 5);
}

TEST_CASE("flatland: the caustic of a disc of glass is that of geometric optics") {
    // The way of a ray through a ball lies in a plane: the sums of ball_caustic.hpp
    // hold here too, only that a lamp sends flux d(alpha) / (2 pi) and not by solid
    // angle.
    const ljus_test::BallCaustic optics{.light = 0.7, .floor = 0.45, .radius = 0.25};
    const Circle lamp{.center{0, 0.45 + 0.7}, .radius = 1e-5};
    const Scene scene{{{Segment{.from{-4, 0}, .to{4, 0}}, Lambertian{0}},
                       {Circle{.center{0, 0.45}, .radius = 0.25}, Glass{1.5}},
                       {lamp, Lambertian{0}, radiance_of(lamp, 1)}}};
    const int photons = 200000, cells = 60;
    const double width = 0.6 / cells;
    std::vector<double> counts(cells), expected(cells);
    for (const Photon& photon :
         trace_photons(scene, {.photons = photons, .seed = test_seed(21)})) {
        const double x = std::abs(photon.position.x);
        if (photon.kind == PhotonKind::caustic && x < cells * width)
            counts[std::size_t(x / width)] += 1;
    }
    const int steps = 200000;
    const double step = optics.last() / steps;
    for (int i = 0; i < steps; ++i)
        for (int k = -1; k < 12; ++k) {
            const auto arrival = optics.trace((i + 0.5) * step, k);
            const double x = std::abs(arrival.rho);
            if (arrival.lands && x < cells * width)
                expected[std::size_t(x / width)] +=
                    photons * arrival.share * 2 * step / (2 * pi);
        }
    // One false alarm in 3 million seeds.
    CHECK(ljus_test::chi_square_agrees(counts, expected, 5));
}

TEST_CASE("flatland: path tracing and photons agree along the floor of the room") {
    const double albedo = 0.5;
    const Scene scene = make_room({.albedo = albedo, .lamp_size = 0.08});
    constexpr int bins = 10;
    const double width = length(room_floor) / bins;

    const int photons = 40000;
    std::array<Mean, bins> by_photons, by_paths;
    for (int i = 0; i < photons; ++i) {
        auto stream = stream_of(13, i);
        std::array<double, bins> flux_in{};
        trace_photon(scene, emit_photon(scene, flux(scene), stream), stream, 1000,
                     [&](const PathState& path, const Vertex& vertex) {
                         if (vertex.id != 0) return;
                         const double x = vertex.point.position.x - room_floor.from.x;
                         const int bin = std::min(bins - 1, int(x / width));
                         flux_in[std::size_t(bin)] += path.throughput;
                     });
        for (std::size_t bin = 0; bin < bins; ++bin) by_photons[bin].add(flux_in[bin]);
    }
    for (std::size_t bin = 0; bin < bins; ++bin) {
        for (int i = 0; i < 10000; ++i) {
            auto stream = stream_of(17 + bin, i);
            const double x =
                room_floor.from.x + (double(bin) + (i + 0.5) / 10000) * width;
            const Ray down{.origin{x, 1e-4}, .direction{0, -1}};
            // L = albedo E / 2, and the flux into the bin is E times its width.
            by_paths[bin].add(radiance(scene, down, stream) * 2 / albedo * width);
        }
        CHECK(std::abs(apart(by_photons[bin], by_paths[bin])) < 5);
        CHECK(by_photons[bin].error() < 0.05 * by_photons[bin].mean);
    }
}

TEST_CASE("flatland: each kernel keeps the flux") {
    for (const Kernel kernel : {Kernel::box, Kernel::cone, Kernel::gaussian,
                                Kernel::epanechnikov, Kernel::biweight}) {
        double mean = 0;
        const int steps = 10000;
        for (int i = 0; i < steps; ++i) {
            const double s = (i + 0.5) / steps;
            mean += kernel_weight(kernel, s * s) / steps;
        }
        CHECK(mean == within(1, 1e-7));
    }
}

TEST_CASE("flatland: the k-th photon sets the radius and is not counted") {
    // n photons even in [-1, 1] that carry 1 W/m together. The radius of the k-th has a
    // Beta(k, n - k + 1) distribution, and the estimate with a box the mean 1.
    for (const std::size_t k : {3u, 5u, 20u}) {
        Mean mean;
        const int n = 100;
        for (int run = 0; run < 4000; ++run) {
            auto stream = stream_of(100 + k, run);
            PhotonMap map;
            for (int i = 0; i < n; ++i)
                map.push_back({.position{2 * ljus::next_1d<double>(stream) - 1, 0},
                               .direction{0, -1},
                               .flux = 2.0 / n});
            const Estimate found = estimate_irradiance(
                map, {}, {.radius = 2, .nearest = k, .kernel = Kernel::box});
            CHECK(found.gathered == k - 1);
            mean.add(found.irradiance);
        }
        CHECK(std::abs(apart(mean, 1)) < 5);
    }
}

TEST_CASE("flatland: which photons an estimate counts") {
    const SurfacePoint point{.position{0.1, 0}, .normal{0, 1}};
    const DensityEstimateSettings box{.radius = 0.5, .kernel = Kernel::box};
    const Photon here{.position{0.2, 0}, .direction{0, -1}, .flux = 3};
    CHECK(estimate_irradiance({here}, point, box).irradiance == within(3, 1e-15));
    CHECK(estimate_irradiance({}, point, box).irradiance == 0);

    Photon other = here; // on the next wall of a corner
    other.normal = {1, 0};
    CHECK(estimate_irradiance({other}, point, box).irradiance == 0);
    other = here; // on the other side of the same wall
    other.direction = {0, 1};
    CHECK(estimate_irradiance({other}, point, box).irradiance == 0);
    other = here; // too far away
    other.position = {0.7, 0};
    CHECK(estimate_irradiance({other}, point, box).irradiance == 0);

    // Walls that are turned by less than 60 degrees are the same surface.
    for (const double degrees : {-61.0, -59.0, 59.0, 61.0}) {
        other = here;
        other.normal = at_angle(degrees * pi / 180);
        CHECK(estimate_irradiance({other}, point, box).gathered ==
              (std::abs(degrees) < 60 ? 1 : 0));
    }
    // The interval is closed, and with the k nearest it ends at the k-th.
    other = here;
    other.position = {0.6, 0};
    CHECK(estimate_irradiance({other}, {.position{0.1, 0}}, box).gathered == 1);
    Photon beside = here;
    beside.position = {0.35, 0};
    const Estimate two =
        estimate_irradiance({other, here, beside}, point,
                            {.radius = 0.5, .nearest = 2, .kernel = Kernel::box});
    CHECK(two.radius == within(0.25, 1e-15));
    CHECK(two.gathered == 1);
    CHECK(two.irradiance == within(3 / 0.5, 1e-14));

    // Fewer than k within the radius: the whole disc counts.
    const Estimate few = estimate_irradiance(
        {here}, point, {.radius = 0.5, .nearest = 5, .kernel = Kernel::box});
    CHECK(few.irradiance == within(3, 1e-15));
    CHECK(few.radius == 0.5);
    // All of them in one point: no interval, no estimate, and no division by 0.
    Photon at_point = here;
    at_point.position = point.position;
    CHECK(
        estimate_irradiance({at_point, at_point}, point, {.radius = 0.5, .nearest = 2})
            .irradiance == 0);
}

TEST_CASE("flatland: at the end of a wall the estimate is half of what it should be") {
    // Photons a millimetre apart, 1 W/m: at the end of the wall half the disc is empty.
    PhotonMap map;
    for (int i = 0; i < 1000; ++i)
        map.push_back(
            {.position{(i + 0.5) / 1000, 0}, .direction{0, -1}, .flux = 0.001});
    for (const Kernel kernel : {Kernel::box, Kernel::epanechnikov}) {
        const DensityEstimateSettings gather{.radius = 0.1, .kernel = kernel};
        CHECK(estimate_irradiance(map, {.position{0.5, 0}}, gather).irradiance ==
              within(1, 1e-3));
        CHECK(estimate_irradiance(map, {}, gather).irradiance == within(0.5, 1e-3));
    }
    // The k nearest make the disc larger, and it is half empty as well.
    CHECK(estimate_irradiance(map, {}, {.radius = 1, .nearest = 100}).irradiance ==
          within(0.5, 0.02));
}

TEST_CASE("flatland: photons by their path, and the same ones in a longer pass") {
    const Scene scene = make_room();
    const PhotonMap few = trace_photons(scene, {.photons = 10, .seed = 4});
    const PhotonMap many = trace_photons(scene, {.photons = 1000, .seed = 4});
    REQUIRE(few.size() <= many.size());
    for (std::size_t i = 0; i < few.size(); ++i) {
        CHECK(few[i].position == many[i].position);
        CHECK(few[i].flux == within(100 * many[i].flux, 1e-12));
    }
    CHECK(trace_photons(scene, {.photons = 0}).empty());

    CHECK(kind_of(PathState{}) == PhotonKind::direct);
    CHECK(kind_of(PathState{.met_specular = true}) == PhotonKind::caustic);
    CHECK(kind_of(PathState{.met_diffuse = true, .met_specular = true}) ==
          PhotonKind::indirect);
    // The numbers of a photon are those of its pass, and of nothing else.
    ljus::RandomStream own = photon_stream({.seed = 9}, 5);
    ljus::RandomStream same = ljus::random_stream(9, Pass::general_photons, 0, 5);
    for (int i = 0; i < 3; ++i)
        CHECK(ljus::next_1d<double>(own) == ljus::next_1d<double>(same));
    // The pass's limit of bounces is the path's.
    for (const Photon& photon :
         trace_photons(scene, {.photons = 300, .max_bounces = 1}))
        CHECK(photon.kind == PhotonKind::direct);
    for (const Photon& photon :
         many) // glass, mirror and the disc of the lamp keep none
        CHECK(glm::distance(photon.position, room_disc.center) > room_disc.radius);
}

TEST_CASE("flatland: a path does not forget what it has met") {
    PathState path;
    ljus::RandomStream stream = stream_of(1, 0);
    const auto kind_after = [&](const Material& material) {
        const Vertex vertex{.object{.material = material}};
        REQUIRE(continue_path(path, vertex, Transport::flux, stream));
        return kind_of(path);
    };
    CHECK(kind_after(Mirror{1}) == PhotonKind::caustic);
    CHECK(kind_after(Lambertian{1}) == PhotonKind::indirect);
    CHECK(kind_after(Mirror{1}) == PhotonKind::indirect);
    CHECK((path.met_diffuse && path.met_specular));
}

TEST_CASE("flatland: of two lamps the second half of the numbers is the second's") {
    const Circle left{.center{-1, 1}, .radius = 0.1},
        right{.center{1, 1}, .radius = 0.1};
    const Scene scene{{{left, Lambertian{0}, 1}, {right, Lambertian{0}, 1}}};
    for (const double u : {0.0, 0.25, 0.49999})
        CHECK(sample_lamp(scene, {u, 0.3}).lamp == &scene.objects[0]);
    for (const double u : {0.5, 0.75, 0.99999})
        CHECK(sample_lamp(scene, {u, 0.3}).lamp == &scene.objects[1]);
    CHECK(sample_lamp(scene, {0.75, 0.3}).probability == within(0.5, 1e-15));

    // Objects that emit nothing are not lamps, first or last, in spite of rounding.
    Scene many;
    for (int i = 0; i < 40; ++i)
        many.objects.push_back({Circle{.radius = 0.1 + 0.037 * (i % 7)}, Lambertian{},
                                i % 3 == 1 ? 0.1 * i : 0.0});
    for (int i = 0; i < 1000; ++i)
        REQUIRE(sample_lamp(many, {i / 1000.0, 0.5}).lamp->emission > 0);
    CHECK(sample_lamp(many, {std::nextafter(1.0, 0.0), 0.5}).lamp == &many.objects[37]);
    const Scene dark{square(Lambertian{1})};
    CHECK(sample_lamp(dark, {0.3, 0.3}).lamp == nullptr);
    CHECK(sample_lamp(dark, {0.3, 0.3}).probability == 0);
    Vertex above = floor_vertex(0.5);
    above.point = {.position{0.5, 0.7}, .normal{0, -1}};
    CHECK(direct_light(dark, above, {0.3, 0.3}) == 0);
}

TEST_CASE("flatland: a lamp shines on the side of its normal, and only there") {
    const Object lamp{Segment{.from{1, 1}, .to{-1, 1}}, Lambertian{0}, 3}; // downwards
    const Scene scene{{lamp}};
    auto stream = stream_of(12, 0);
    CHECK(radiance(scene, Ray{.origin{0.2, 0}, .direction{0, 1}}, stream) == 3);
    CHECK(radiance(scene, Ray{.origin{0.2, 2}, .direction{0, -1}}, stream) == 0);
    CHECK(Vertex{.wo{0, 1}, .object = lamp}.emits());
    CHECK_FALSE(Vertex{.wo{0, -1}, .object = lamp}.emits());
    CHECK_FALSE(Vertex{.wo{0, 1}}.emits());
    // No shadow ray finds its back.
    Vertex above = floor_vertex(0);
    above.point.position = {0, 2};
    above.point.normal = {0, -1};
    CHECK(direct_light(scene, above, {0.3, 0.6}) == 0);
    above.point.position = {0, 0};
    above.point.normal = {0, 1};
    CHECK(direct_light(scene, above, {0.3, 0.6}) > 0);
}

TEST_CASE("flatland: a vertex says where it is and from where the path came") {
    const Scene scene{{{Segment{.from{-1, 0}, .to{1, 0}}},
                       {Segment{.from{1, 3}, .to{-1, 3}}, Lambertian{}, 2}}};
    PathState path{.ray{.origin{-0.5, 0}, .direction = glm::normalize(Vec2{1, 3})}};
    auto stream = stream_of(13, 0);
    const auto vertex = next_vertex(scene, path, stream);
    REQUIRE(vertex);
    CHECK(path.depth == 1);
    CHECK(vertex->id == 1);
    CHECK(vertex->object.emission == 2);
    CHECK(vertex->distance == within(std::sqrt(10.0), 1e-12));
    CHECK(glm::distance(vertex->point.position, Vec2{0.5, 3}) < 1e-12);
    CHECK(glm::distance(vertex->point.normal, Vec2{0, -1}) < 1e-12);
    // The frame's x is the normal turned clockwise: here to the left of the plane.
    CHECK(glm::distance(vertex->wo, glm::normalize(Vec2{1, 3})) < 1e-12);
    CHECK_FALSE(
        next_vertex(scene, path = {.ray{.origin{0, 4}, .direction{0, 1}}}, stream));
}

TEST_CASE(
    "flatland: a photon within glass has the flux that it had, a path its radiance") {
    // A matt disc in a disc of glass; straight to the middle, 4 % are reflected.
    const Scene scene{
        {{Circle{.radius = 1}, Glass{1.5}}, {Circle{.radius = 0.5}, Lambertian{0.5}}}};
    const PathState down{.ray{.origin{0, 3}, .direction{0, -1}}, .throughput = 7};
    int landed = 0;
    for (int i = 0; i < 200; ++i) {
        auto stream = stream_of(21, i);
        PhotonMap map;
        int met = 0;
        trace_photon(scene, down, stream, 2,
                     [&](const PathState& path, const Vertex& v) {
                         ++met;
                         store_photon(path, v, map);
                     });
        CHECK(met <= 2); // as many surfaces as it may meet
        if (map.empty()) continue;
        ++landed;
        CHECK(map[0].flux == within(7, 1e-12));
        CHECK(map[0].kind == PhotonKind::caustic);
    }
    CHECK(landed > 150);
    auto stream = stream_of(22, 0);
    int met = 0;
    trace_photon(scene, down, stream, 1, [&](const auto&, const auto&) { ++met; });
    CHECK(met == 1);
    // Radiance is divided by n on the way in, and roulette does not take that for loss.
    int ended = 0;
    for (int i = 0; i < 200; ++i) {
        auto numbers = stream_of(23, i);
        PathState path = down;
        const auto vertex = next_vertex(scene, path, numbers);
        REQUIRE(vertex);
        ended += !continue_path(path, *vertex, Transport::radiance, numbers);
        const double right = path.ray.direction.y < 0 ? 7 / 1.5 : 7;
        CHECK(path.throughput == within(right, 1e-12));
    }
    CHECK(ended == 0);
}

TEST_CASE("flatland: the room, number by number, and its normals point into it") {
    const Scene scene = make_room({.albedo = 0.4, .flux = 3});
    REQUIRE(scene.objects.size() == 7);
    const Vec2 corners[] = {{-1, 0}, {1, 0}, {1, 1.1}, {-1, 1.1}};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto& wall = std::get<Segment>(scene.objects[i].shape);
        CHECK(wall.from == corners[i]);
        CHECK(wall.to == corners[(i + 1) % 4]);
        const Vec2 middle = (wall.from + wall.to) / 2.0;
        CHECK(glm::dot(normal(wall, middle), Vec2{0, 0.5} - middle) > 0);
        CHECK(std::get<Lambertian>(scene.objects[i].material).albedo == 0.4);
        CHECK(scene.objects[i].emission == 0);
    }
    const auto& mirror = std::get<Segment>(scene.objects[4].shape);
    CHECK(mirror.from == Vec2{0.95, 0.6});
    CHECK(mirror.to == Vec2{0.6, 1.0});
    CHECK(std::get<Mirror>(scene.objects[4].material).reflectance == 0.95);
    const auto& disc = std::get<Circle>(scene.objects[5].shape);
    CHECK(disc.center == Vec2{0.1, 0.45});
    CHECK(disc.radius == 0.25);
    CHECK(std::get<Glass>(scene.objects[5].material).index == 1.5);
    const Scene dense = make_room({.lamp{0.2, 0.9}, .index = 1.8, .lamp_size = 0.05});
    CHECK(std::get<Glass>(dense.objects[5].material).index == 1.8);
    CHECK(std::get<Circle>(dense.objects[6].shape).center == Vec2{0.2, 0.9});
    CHECK(std::get<Circle>(dense.objects[6].shape).radius == 0.05);
    CHECK(std::get<Lambertian>(dense.objects[0].material).albedo == 0.5);
    CHECK(flux(dense) == within(1, 1e-12));
    const auto& lamp = std::get<Circle>(scene.objects[6].shape);
    CHECK(lamp.center == Vec2{-0.45, 0.95});
    CHECK(lamp.radius == 0.03);
    CHECK(std::get<Lambertian>(scene.objects[6].material).albedo == 0);
    // A Lambertian line sends 2 L per length.
    CHECK(scene.objects[6].emission == within(3 / (2 * 2 * pi * 0.03), 1e-12));
    CHECK(flux(scene) == within(3, 1e-12));
}

TEST_CASE("flatland: what cannot be is refused with a sentence") {
    const auto refuses = [](const Object& object) {
        CHECK_THROWS_AS(check(Scene{{object}}), std::invalid_argument);
    };
    refuses({Circle{.radius = 0}});
    refuses({Circle{.radius = -1}});
    refuses({Circle{.center{2000, 0}}});
    refuses({Segment{.from{0, 0}, .to{0, 0}}});
    refuses({Segment{.from{0, std::nan("")}, .to{1, 0}}});
    refuses({Segment{}, Lambertian{1.1}});
    refuses({Segment{}, Mirror{-0.1}});
    refuses({Segment{}, Glass{0}});
    refuses({Segment{}, Lambertian{}, -1});
    CHECK_NOTHROW(check(make_room()));
    // The ends of each range, from both sides.
    const auto takes = [](const Object& object) {
        CHECK_NOTHROW(check(Scene{{object}}));
    };
    const auto up_to = [](double x) { return Segment{.from{0, 0}, .to{x, 0}}; };
    takes({up_to(1.01e-6)});
    refuses({up_to(0.99e-6)});
    takes({up_to(1000)});
    refuses({up_to(1000.1)});
    refuses({Segment{.from{0, -1000.1}, .to{0, 0}}});
    takes({Circle{.center{0, -1000}, .radius = 1591}});
    refuses({Circle{.radius = 1592}}); // longer than 10 000
    for (const double index : {0.1, 10.0}) takes({Segment{}, Glass{index}});
    for (const double index : {0.099, 10.1, std::nan("")})
        refuses({Segment{}, Glass{index}});
    for (const double share : {0.0, 1.0}) {
        takes({Segment{}, Lambertian{share}});
        takes({Segment{}, Mirror{share}});
    }
    refuses({Segment{}, Mirror{1.1}});
    refuses({Segment{}, Lambertian{}, std::nan("")});
    refuses({Segment{}, Lambertian{}, INFINITY});
    CHECK_THROWS_WITH_AS(
        check(Scene{{Object{up_to(5e-7)}}}),
        "the length of a shape is 5e-7; it must be within [1e-6, 10000].",
        std::invalid_argument);
    CHECK_THROWS_WITH_AS(
        check(Scene{{Object{up_to(1500)}}}),
        "the larger coordinate of a point is 1500; it must be at most 1000.",
        std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)trace_photons(Scene{square(Lambertian{})}, {}),
                         "the flux of the scene is 0; it must be finite and above 0.",
                         std::invalid_argument);
    // A pass looks at its scene before it sends anything.
    Scene wrong = make_room();
    wrong.objects[0].material = Lambertian{1.5};
    CHECK_THROWS_WITH_AS((void)trace_photons(wrong, {.photons = 1}),
                         "lambertian.albedo is 1.5; it must be within [0, 1].",
                         std::invalid_argument);
    CHECK_THROWS_AS((void)trace_photons(make_room(), {.photons = -1}),
                    std::invalid_argument);
    CHECK_THROWS_AS(check(DensityEstimateSettings{.radius = 0}), std::invalid_argument);
    CHECK_THROWS_AS(check(DensityEstimateSettings{.nearest = 1}),
                    std::invalid_argument);
    CHECK_NOTHROW(check(DensityEstimateSettings{}));
}

TEST_CASE("flatland: what there is if nothing is said") {
    CHECK(Lambertian{}.albedo == 0.5);
    CHECK(Mirror{}.reflectance == 1);
    CHECK(Glass{}.index == 1.5);
    CHECK(BsdfSample{}.eta_scale == 1);
    CHECK(BsdfSample{}.weight == 0);
    CHECK(Ray{}.t_min == 1e-9);
    CHECK(std::isinf(Ray{}.t_max));
    CHECK(Object{}.emission == 0);
    CHECK(PathState{}.throughput == 1);
    CHECK(PathState{}.depth == 0);
    CHECK_FALSE(PathState{}.specular);
    const PhotonPassSettings pass;
    CHECK(pass.photons == 10000);
    CHECK(pass.seed == 1);
    CHECK(pass.max_bounces == 1000);
    const DensityEstimateSettings gather;
    CHECK(gather.radius == 0.1);
    CHECK(gather.nearest == 0);
    CHECK(gather.kernel == Kernel::epanechnikov);
    const RoomSettings room;
    CHECK(room.lamp == Vec2{-0.45, 0.95});
    CHECK(room.index == 1.5);
    CHECK(room.albedo == 0.5);
    CHECK(room.flux == 1);
    CHECK(room.lamp_size == 0.03);
    CHECK(room_height == 1.1);
}
