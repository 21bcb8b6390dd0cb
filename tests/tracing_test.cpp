// Where the flux of the photons goes. The statistical checks, about 50, have a limit
// that all of them together exceed once in 1000 runs.
// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
// none failed.
#include <doctest/doctest.h>

#include <cstdio>
#include <numbers>
#include <string>

#include "ljus/accel/mesh.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/materials/glossy.hpp"
#include "ljus/photons/tracing.hpp"
#include "support/box_sides.hpp"
#include "support/closed_forms.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"
#include "support/rooms.hpp"
#include "support/seed.hpp"
#include "support/within.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

const double limit = ljus_test::limit_of(50); ///< In standard errors.

constexpr double pi = std::numbers::pi;

/// Where photons of a pass lie on one object's plane: sums of flux, over blocks of
/// paths so that there is an error.
template <AnyWorld W, typename Where>
Mean stored_flux(const W& world, MapType law, const PhotonPassSettings& pass, int seeds,
                 Where where) {
    Mean mean;
    for (int seed = 1; seed <= seeds; ++seed) {
        PhotonPassSettings one = pass;
        one.seed = ljus_test::test_seed(static_cast<std::uint64_t>(seed));
        const auto traced = trace_photons(world, law, one);
        double sum = 0;
        for (const auto& photon : traced.photons)
            if (where(photon)) sum += double(photon.flux.x);
        mean.add(sum);
    }
    return mean;
}

/// The form factor from a rectangle of width w to one of height h that stands on its
/// common edge of length l.
double perpendicular_form_factor(double l, double h, double w) {
    const double H = h / l, W = w / l;
    const double h2 = H * H, w2 = W * W, hw = h2 + w2;
    const double log_sum = std::log((1 + w2) * (1 + h2) / (1 + hw)) +
                           w2 * std::log(w2 * (1 + hw) / ((1 + w2) * hw)) +
                           h2 * std::log(h2 * (1 + hw) / ((1 + h2) * hw));
    return (W * std::atan(1 / W) + H * std::atan(1 / H) -
            std::sqrt(hw) * std::atan(1 / std::sqrt(hw)) + log_sum / 4) /
           (pi * W);
}

void check_balance(const FluxAudit& audit) {
    const glm::dvec3 sum = audit.absorbed + audit.escaped + audit.cut + audit.roulette;
    for (int c = 0; c < 3; ++c) {
        CAPTURE(c);
        // Each step is a difference taken in double: only the sum itself is rounded.
        CHECK(sum[c] == doctest::Approx(audit.emitted[c]).epsilon(1e-12));
    }
}

} // namespace

TEST_CASE("tracing: absorbed + escaped + cut + roulette = emitted") {
    for (const Ball ball : {Ball::oren_nayar, Ball::mirror, Ball::glass, Ball::mixture})
        for (const Lamp lamp : {Lamp::quad, Lamp::sphere, Lamp::point})
            for (const int bounces : {1, 3, 1000})
                for (const MapType law : {MapType::general, MapType::caustics}) {
                    const ClosedRoom room = make_room<float>(ball, lamp, 2);
                    const auto traced = trace_photons(
                        room, law,
                        {.photons = 3000, .max_bounces = bounces, .threads = 1});
                    check_balance(traced.audit);
                    CHECK(traced.audit.escaped == glm::dvec3(0)); // the room is closed
                }
    // An open scene, in double.
    BallRoomT<double> open;
    add_ball(open, Ball::mixture);
    add_lamps(open, Lamp::quad, 2);
    const auto traced =
        trace_photons(World(open), MapType::general, {.photons = 3000, .threads = 1});
    check_balance(traced.audit);
    CHECK(traced.audit.escaped.x > 0.1 * traced.audit.emitted.x);
}

TEST_CASE("tracing: all the lights' flux is emitted, and roulette moves none of it in "
          "the mean") {
    for (const Ball ball : {Ball::oren_nayar, Ball::glass, Ball::mixture}) {
        const ClosedRoom room = make_room<float>(ball, Lamp::sphere, 2);
        glm::dvec3 flux(0);
        for (const Rgb& power : room.powers()) flux += glm::dvec3(power);
        Mean emitted[3], roulette[3];
        for (std::uint64_t seed = 1; seed <= 64; ++seed) {
            const auto traced = trace_photons(
                room, MapType::general,
                {.photons = 2000, .seed = ljus_test::test_seed(seed), .threads = 1});
            for (int c = 0; c < 3; ++c) {
                emitted[c].add(traced.audit.emitted[c]);
                roulette[c].add(traced.audit.roulette[c]);
            }
        }
        for (int c = 0; c < 3; ++c) {
            CAPTURE(c);
            CHECK(std::abs(apart(emitted[c], flux[c])) < limit);
            CHECK(std::abs(roulette[c].mean) < limit * roulette[c].error());
            CHECK(roulette[c].error() < 0.02 * flux[c]);
        }
    }
}

TEST_CASE("tracing: the first hits of a lamp's photons share its flux by the form "
          "factors") {
    // The whole ceiling of a 2 x 1.5 x 1 box shines, radiance 1.
    const double a = 2, b = 1.5, c = 1;
    BallRoomT<float> box;
    const auto black = box.add(Lambertian{.albedo = Rgb{0}});
    const Vec3 x{float(a), 0, 0}, z{0, 0, float(b)}, y{0, float(c), 0};
    box.add(Quad{.corner{0, float(c), 0}, .edge_u = x, .edge_v = z}, black, Rgb{1});
    box.add(Quad{.corner{0, 0, 0}, .edge_u = z, .edge_v = x}, black);
    box.add(Quad{.corner{0, 0, 0}, .edge_u = x, .edge_v = y}, black);
    box.add(Quad{.corner{0, 0, float(b)}, .edge_u = x, .edge_v = y}, black);
    box.add(Quad{.corner{0, 0, 0}, .edge_u = z, .edge_v = y}, black);
    box.add(Quad{.corner{float(a), 0, 0}, .edge_u = z, .edge_v = y}, black);
    const World closed(std::move(box));
    const double flux = pi * a * b;
    const auto flux_where = [&](auto where) {
        return stored_flux(closed, MapType::general,
                           {.photons = 20000, .shadow_photons = false, .threads = 1},
                           16, where);
    };
    const auto near = [](float value, double plane) {
        return std::abs(double(value) - plane) < 1e-5;
    };
    const double floor = form_factor_facing(a, b, c);
    const double long_wall = perpendicular_form_factor(a, c, b);
    const double short_wall = perpendicular_form_factor(b, c, a);
    CHECK(floor + 2 * long_wall + 2 * short_wall == doctest::Approx(1).epsilon(1e-12));
    CHECK(perpendicular_form_factor(1, 1, 1) ==
          doctest::Approx(0.2000438).epsilon(1e-6));
    const Mean on_floor =
        flux_where([&](const Photon& p) { return near(p.position.y, 0); });
    const Mean on_back =
        flux_where([&](const Photon& p) { return near(p.position.z, 0); });
    const Mean on_front =
        flux_where([&](const Photon& p) { return near(p.position.z, b); });
    const Mean on_left =
        flux_where([&](const Photon& p) { return near(p.position.x, 0); });
    const Mean on_right =
        flux_where([&](const Photon& p) { return near(p.position.x, a); });
    CHECK(std::abs(apart(on_floor, flux * floor)) < limit);
    CHECK(std::abs(apart(on_back, flux * long_wall)) < limit);
    CHECK(std::abs(apart(on_front, flux * long_wall)) < limit);
    CHECK(std::abs(apart(on_left, flux * short_wall)) < limit);
    CHECK(std::abs(apart(on_right, flux * short_wall)) < limit);
    CHECK(on_floor.error() < 0.0045 * on_floor.mean); // 0.0024, known to 18 %
}

namespace {

/// Of parallel light on a unit ball of glass: the share of what meets it that goes
/// through it without a reflection inside, (1 - F)^2 at the angle of entry, and crosses
/// a plane behind it, at a distance from its centre, within a radius of the axis.
double straight_through(double index, double distance, double radius) {
    double sum = 0;
    const int steps = 100000;
    for (int k = 0; k < steps; ++k) {
        const double sine = std::sqrt((k + 0.5) / steps); // uniform over the disc
        const double i = std::asin(sine), t = std::asin(sine / index);
        // It leaves at the angle i + pi - 2t around the centre, turned by 2 (i - t).
        const double place = i + pi - 2 * t, turn = 2 * (i - t);
        if (turn >= pi / 2) continue;
        const double way = (distance + std::cos(place)) / std::cos(turn);
        if (std::abs(std::sin(place) - way * std::sin(turn)) > radius) continue;
        sum += std::pow(1 - fresnel_share(std::cos(i), 1, index), 2) / steps;
    }
    return sum;
}

} // namespace

TEST_CASE("tracing: a caustic has the power that the glass was given") {
    // A small, far lamp; a ball of glass; a black shell around it all that keeps every
    // photon. What meets the ball is the lamp's intensity times the ball's solid angle;
    // all of it leaves the ball, for nothing is absorbed.
    for (const bool point_light : {true, false}) {
        BallRoom scene;
        const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
        const auto glass = scene.add(Glass{.index = 1.5f});
        scene.add(Sphere{.center{0, 0, 0}, .radius = 20}, black, Rgb{0}, true);
        scene.add(Sphere{.center{0, 0, 0}, .radius = 0.5f}, glass);
        if (point_light)
            scene.add(PointLight{.position{0, 3, 0}, .intensity = Rgb{2}});
        else // radius 0.1, seen from the ball's centre with intensity L pi r^2
            scene.add(Sphere{.center{0, 3, 0}, .radius = 0.1f}, black,
                      Rgb{float(2 / (pi * 0.01))});
        const World world(std::move(scene));
        // Between two Lambertian spheres: the flux on a ball from a point at distance d
        // is I 2 pi (1 - cos), and from a lamp the mean of that over its face; to
        // second order in the lamp's radius they agree, and here within 1e-4.
        const double solid = 2 * pi * (1 - std::sqrt(1 - 0.25 / 9));
        const auto everywhere = [](const Photon&) { return true; };
        const PhotonPassSettings pass{.photons = 20000, .threads = 1};
        const Mean caustic =
            stored_flux(world, MapType::caustics, pass, 16, everywhere);
        CAPTURE(point_light);
        CAPTURE(caustic.mean);
        CAPTURE(2 * solid);
        if (point_light) {
            CHECK(std::abs(apart(caustic, 2 * solid, 1e-5)) < limit);
            CHECK(caustic.error() < 1e-3 * caustic.mean);
        } else {
            CHECK(caustic.mean == ljus_test::within(2 * solid, 0.01));
        }
        // The same photons found blindly: emitted anywhere, kept if they went through
        // glass first.
        PhotonPassSettings blind = pass;
        blind.photons = 200000;
        Mean found;
        for (std::uint64_t seed = 1; seed <= 16; ++seed) {
            blind.seed = ljus_test::test_seed(seed);
            double sum = 0;
            detail::PhotonBlockT<float> out;
            for (std::uint64_t path = 0; path < 100000; ++path) {
                auto stream =
                    random_stream(ljus_test::test_seed(seed), Pass::user, 0, path);
                auto flight = emit(world, world.light_choice(), stream);
                flight.flux /= 100000.0f;
                detail::trace_photon(world, MapType::caustics, {flight}, blind, stream,
                                     out);
            }
            for (const Photon& photon : out.photons) sum += double(photon.flux.x);
            found.add(sum);
        }
        CAPTURE(found.mean);
        CHECK(std::abs(apart(caustic, found)) < limit);
    }
}

TEST_CASE("tracing: aimed photons equal blind ones, whatever their targets") {
    // Targets that hide each other, a light within the bounding sphere of a target (a
    // large mirror), mirrors and mixtures as targets, all kinds of lights.
    for (const Lamp lamp : {Lamp::quad, Lamp::sphere, Lamp::point}) {
        BallRoom scene;
        add_walls(scene);
        const auto glass = scene.add(Glass{.index = 1.5f});
        const auto mirror = scene.add(Mirror{.reflectance = Rgb{0.9f}});
        const auto mixed = scene.add(
            Mixture{.color = Rgb{0.5f}, .reflectivity = 0.3f, .transparency = 0.3f});
        scene.add(Sphere{.center{0, -0.3f, 0}, .radius = 0.3f}, glass);
        scene.add(Sphere{.center{0.1f, 0.2f, 0.05f}, .radius = 0.2f}, glass); // above
        scene.add(Sphere{.center{0.5f, -0.5f, 0.3f}, .radius = 0.3f}, mixed);
        scene.add(Quad{.corner{-0.9f, -0.9f, -0.8f},
                       .edge_u{1.8f, 0, 0},
                       .edge_v{0, 1.8f, -0.1f}},
                  mirror);
        add_lamps(scene, lamp, 2);
        const World world(std::move(scene));
        Mean aimed[2], blind[2];
        for (std::uint64_t seed = 1; seed <= 24; ++seed) {
            const auto half = [](const Photon& p) { return p.position.y < -0.999f; };
            const auto add = [&](Mean(&mean)[2], const std::vector<Photon>& photons) {
                double sum = 0, floor = 0;
                for (const Photon& photon : photons) {
                    CHECK_FALSE(photon.kind != PhotonKind::caustic);
                    sum += double(photon.flux.x);
                    floor += half(photon) ? double(photon.flux.x) : 0;
                }
                mean[0].add(sum);
                mean[1].add(floor);
            };
            add(aimed,
                trace_photons(
                    world, MapType::caustics,
                    {.photons = 6000, .seed = ljus_test::test_seed(seed), .threads = 1})
                    .photons);
            detail::PhotonBlockT<float> out;
            const int paths = 8000;
            for (std::uint64_t path = 0; path < paths; ++path) {
                auto stream =
                    random_stream(ljus_test::test_seed(seed), Pass::user, 0, path);
                auto flight = emit(world, world.light_choice(), stream);
                flight.flux /= float(paths);
                detail::trace_photon(world, MapType::caustics, {flight},
                                     PhotonPassSettings{}, stream, out);
            }
            add(blind, out.photons);
        }
        for (const int i : {0, 1}) {
            CAPTURE(static_cast<int>(lamp));
            CAPTURE(i);
            CAPTURE(aimed[i].mean);
            CAPTURE(blind[i].mean);
            CHECK(std::abs(apart(aimed[i], blind[i])) < limit);
            CHECK(aimed[i].error() < 0.03 * aimed[i].mean); // 0.015, known to 15 %
        }
    }
}

TEST_CASE("tracing: the parts of a pass, joined, are the pass") {
    const ClosedRoom room = make_room<float>(Ball::mixture, Lamp::quad, 2);
    for (const MapType map : {MapType::general, MapType::caustics}) {
        const PhotonPassSettings pass{.photons = 1300, .seed = 7, .threads = 1};
        const auto whole = trace_photons(room, map, pass);
        std::vector<Photon> joined;
        long long first = 0, emitted = 0;
        for (const long long last : {0, 1, 511, 1000, 1300}) {
            const auto part = trace_photons(room, map, pass, first, last);
            joined.insert(joined.end(), part.photons.begin(), part.photons.end());
            emitted += part.emitted;
            first = last;
        }
        CHECK(emitted == 1300);
        REQUIRE(joined.size() == whole.photons.size());
        REQUIRE(joined.size() > 500);
        for (std::size_t i = 0; i < joined.size(); ++i) {
            REQUIRE(joined[i].position == whole.photons[i].position);
            REQUIRE(joined[i].flux == whole.photons[i].flux);
        }
        CHECK_THROWS_WITH((void)trace_photons(room, map, pass, -1, 3),
                          "the first path is -1; it must be at least 0.");
        CHECK_THROWS_WITH((void)trace_photons(room, map, pass, 4, 3),
                          "the last path is 3; it must be at least 4.");
        CHECK_THROWS_WITH((void)trace_photons(room, map, pass, 0, 1301),
                          "the last path is 1301; it must be at most the number of "
                          "photons, 1300.");
    }
}

TEST_CASE("tracing: the kinds of photons are those of their paths") {
    // The walk of a photon is done again beside trace_photon(), from the
    // same random numbers, with its path spelt out; the photons must be
    // those whose path the law owns.
    const ClosedRoom room = make_room<float>(Ball::mixture, Lamp::quad, 2);
    const LightChoice& choice = room.light_choice();
    int seen[3] = {};
    for (std::uint64_t path = 0; path < 4000; ++path) {
        for (const MapType law : {MapType::general, MapType::caustics}) {
            auto stream = random_stream(ljus_test::test_seed(5), Pass::user, 0, path);
            const auto flight = emit(room, choice, stream);
            detail::PhotonBlockT<float> block;
            detail::trace_photon(room, law, {flight}, {.shadow_photons = false}, stream,
                                 block);
            const std::vector<Photon>& out = block.photons;

            std::vector<std::pair<std::string, Vec3>> expected;
            auto again = random_stream(ljus_test::test_seed(5), Pass::user, 0, path);
            auto walk = emit(room, choice, again);
            std::string letters = "L";
            for (std::uint64_t bounce = 1; bounce <= 1000; ++bounce) {
                start_bounce(again, bounce);
                const auto hit = closest_hit(room, walk.ray);
                if (!hit) break;
                const auto at = vertex_at(room, walk.ray, *hit);
                const bool alive =
                    room.visit_material(at.object.material, [&](const auto& material) {
                        if (has(lobes(material), Lobes::non_specular))
                            expected.push_back({letters + "D", at.point.position});
                        const auto next = sample(
                            material, to_local(at.frame, -walk.ray.direction),
                            next_3d<float>(again), Transport::flux,
                            law == MapType::caustics ? Lobes::specular : Lobes::all);
                        if (!next) return false;
                        letters += next->specular ? 'S' : 'D';
                        walk.ray = spawn_ray(at.point, to_world(at.frame, next->wi));
                        return true;
                    });
                if (!alive) break;
            }
            // Roulette may have ended the photon before the walk: it is a beginning.
            std::size_t place = 0;
            for (const Photon& photon : out) {
                while (place < expected.size() &&
                       expected[place].second != photon.position)
                    ++place;
                REQUIRE(place < expected.size());
                const std::string& string = expected[place].first;
                CAPTURE(string);
                const std::string between = string.substr(1, string.size() - 2);
                const bool direct = between.empty();
                const bool indirect = between.find('D') != std::string::npos;
                const PhotonKind kind = direct     ? PhotonKind::direct
                                        : indirect ? PhotonKind::indirect
                                                   : PhotonKind::caustic;
                CHECK(photon.kind == kind);
                CHECK((law == MapType::caustics) == (kind == PhotonKind::caustic));
                ++seen[direct ? 0 : indirect ? 1 : 2];
            }
            // And none is missing: what lies before the last one and is owned is there.
            std::size_t owned = 0;
            for (std::size_t i = 0; i < std::min(place + 1, expected.size()); ++i) {
                const std::string& s = expected[i].first;
                const bool caustic = s.size() > 2 && s.find('D') == s.size() - 1;
                owned += caustic == (law == MapType::caustics) ? 1 : 0;
            }
            if (!out.empty()) CHECK(owned == out.size());
        }
    }
    CHECK(seen[0] > 1000);
    CHECK(seen[1] > 1000);
    CHECK(seen[2] > 100);
}

TEST_CASE("tracing: one photon or none, no light, no target") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    for (const MapType law : {MapType::general, MapType::caustics})
        CHECK(trace_photons(room, law, {.photons = 0}).photons.empty());
    const ClosedRoom matt = make_room<float>(Ball::lambertian, Lamp::quad, 1);
    const auto none =
        trace_photons(matt, MapType::caustics, {.photons = 1000000, .give_up = 600});
    CHECK(none.photons.empty());
    CHECK(none.emitted == 1000000); // not even tried
    CHECK(none.remark.empty());
    // Shares are for the objects that photons are aimed at, and for no general pass.
    CHECK_THROWS_WITH_AS((void)trace_photons(room, MapType::caustics,
                                             {.photons = 10, .shares = {0.5, 0.5}}),
                         doctest::Contains("the number of shares is 2"),
                         std::invalid_argument);
    CHECK(trace_photons(room, MapType::general, {.photons = 10, .shares = {0.5, 0.5}})
              .emitted == 10);
    BallRoom dark;
    add_walls(dark);
    CHECK_THROWS_AS((void)trace_photons(World(dark), MapType::general, {}),
                    std::invalid_argument);
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<SunLight>> empty;
    empty.add(SunLight{});
    CHECK_THROWS_WITH_AS((void)trace_photons(World(empty), MapType::general, {}),
                         doctest::Contains("power of all lights"),
                         std::invalid_argument);
    const auto one = trace_photons(matt, MapType::general, {.photons = 1});
    REQUIRE(!one.photons.empty());
    CHECK(one.photons[0].flux == matt.powers()[0]);
}

namespace {

/// Whether two passes brought the same photons, number by number.
bool same(const TracedPhotonsT<float>& a, const TracedPhotonsT<float>& b) {
    if (a.photons.size() != b.photons.size()) return false;
    for (std::size_t i = 0; i < a.photons.size(); ++i) {
        const Photon &x = a.photons[i], &y = b.photons[i];
        if (x.position != y.position || x.direction != y.direction ||
            x.flux != y.flux || x.light != y.light || x.kind != y.kind)
            return false;
    }
    return a.audit.absorbed == b.audit.absorbed && a.audit.emitted == b.audit.emitted &&
           a.audit.roulette == b.audit.roulette;
}

} // namespace

TEST_CASE("tracing: the same photons for 1 to 4 threads, by chance and evenly spread") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 2);
    for (const MapType law : {MapType::general, MapType::caustics})
        for (const PhotonSampling numbers :
             {PhotonSampling::random, PhotonSampling::sobol}) {
            PhotonPassSettings pass{.photons = 5000, .numbers = numbers, .threads = 1};
            const auto one = trace_photons(room, law, pass);
            check_balance(one.audit);
            CHECK(one.photons.size() > 1000);
            for (pass.threads = 2; pass.threads <= 4; ++pass.threads)
                CHECK(same(one, trace_photons(room, law, pass)));
            pass.seed = ljus_test::test_seed(2);
            CHECK_FALSE(same(one, trace_photons(room, law, pass)));
        }
}

TEST_CASE("tracing: spots and suns balance, and their photons are what paths find") {
    // A floor patch beside a matt ball and a wall, lit by a sun and a spot: all photons
    // that are stored on it, against the path tracer's rule by hand: the mean over the
    // patch of E, direct and after one bounce and more.
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian>, Lights<SpotLight, SunLight>>
        scene;
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.6f}});
    scene.add(Quad{.corner{-2, 0, -2}, .edge_u{0, 0, 4}, .edge_v{4, 0, 0}}, grey);
    scene.add(Quad{.corner{-2, 0, -2}, .edge_u{4, 0, 0}, .edge_v{0, 2, 0}}, grey);
    scene.add(Sphere{.center{0.2f, 0.5f, 0}, .radius = 0.4f}, grey);
    scene.add(SunLight{.direction{-1, -2, -0.5f}, .irradiance{3, 2, 1}});
    scene.add(SpotLight{.position{-1, 1.5f, 1},
                        .direction{1, -1.2f, -1},
                        .intensity{1, 2, 4},
                        .inner_degrees = 15,
                        .outer_degrees = 35});
    const World open(std::move(scene));
    const auto on_patch = [](const Vec3& p) {
        return p.y < 1e-3f && p.x > -1 && p.x < 0 && p.z > -1 && p.z < 0;
    };
    for (const PhotonSampling numbers :
         {PhotonSampling::random, PhotonSampling::sobol}) {
        Mean photons[2]; // direct and indirect
        for (std::uint64_t seed = 1; seed <= 16; ++seed) {
            const auto traced = trace_photons(open, MapType::general,
                                              {.photons = 20000,
                                               .seed = ljus_test::test_seed(seed),
                                               .shadow_photons = false,
                                               .numbers = numbers,
                                               .threads = 1});
            check_balance(traced.audit);
            double sum[2] = {};
            for (const Photon& photon : traced.photons)
                if (on_patch(photon.position))
                    sum[photon.kind == PhotonKind::indirect] += double(photon.flux.y);
            for (const int i : {0, 1}) photons[i].add(sum[i]);
        }
        Mean paths[2];
        for (std::uint64_t path = 0; path < 100000; ++path) {
            auto stream = random_stream(ljus_test::test_seed(9), Pass::user, 0, path);
            const Vec2 u = next_2d<float>(stream);
            Ray ray{.origin{u.x - 1, 0.05f, u.y - 1}, .direction{0, -1, 0}};
            double weight = 1, found[2] = {};
            for (std::uint64_t depth = 1; depth < 12; ++depth) {
                start_bounce(stream, depth);
                const auto hit = closest_hit(open, ray);
                if (!hit) break;
                const auto at = vertex_at(open, ray, *hit);
                const Vec3 n =
                    at.frame.normal *
                    (glm::dot(at.frame.normal, ray.direction) < 0 ? 1.0f : -1.0f);
                for (std::uint32_t light = 0; light < 2; ++light) {
                    const auto s =
                        sample_light(open, light, at.point.position, Vec2{0.5f});
                    if (!s || !(glm::dot(s->wi, n) > 0)) continue;
                    if (occluded(open, spawn_ray_to(at.point, s->point))) continue;
                    found[depth > 1] +=
                        weight * double(s->weight.y * glm::dot(s->wi, n));
                }
                // E of the next surface, cosine-weighted: what
                // it sends back is 0.6 E/pi.
                weight *= 0.6;
                const Vec3 way = to_world(
                    frame_around(n), sample_cosine_hemisphere(next_2d<float>(stream)));
                ray = spawn_ray(at.point, way);
            }
            for (const int i : {0, 1}) paths[i].add(found[i]);
        }
        for (const int i : {0, 1}) {
            CAPTURE(i);
            CAPTURE(photons[i].mean);
            CAPTURE(paths[i].mean);
            CHECK(std::abs(apart(photons[i], paths[i])) < limit);
            CHECK(photons[i].error() < 0.11 * photons[i].mean);
        }
    }
}

TEST_CASE("tracing: through a ball of glass a sun sends what parallel light does") {
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass>, Lights<SunLight>> scene;
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    const auto glass = scene.add(Glass{.index = 1.5f});
    scene.add(Sphere{.center{0, 0, 0}, .radius = 1}, glass);
    scene.add(
        Quad{.corner{-1.2f, -1.5f, -1.2f}, .edge_u{0, 0, 2.4f}, .edge_v{2.4f, 0, 0}},
        black);
    scene.add(SunLight{.direction{0, -1, 0}, .irradiance = Rgb{1}});
    const World world(std::move(scene));
    using enum PhotonSampling;
    for (const auto& row :
         {std::pair{0.1, random}, {0.4, random}, {0.9, random}, {0.4, sobol}}) {
        const double radius = row.first;
        const Mean through = stored_flux(
            world, MapType::caustics,
            {.photons = 20000, .numbers = row.second, .threads = 1}, 16,
            [radius](const Photon& p) {
                return std::hypot(p.position.x, p.position.z) < float(radius);
            });
        // Light reflected inside an even number of times may land there as well: F^2.
        const double right = pi * straight_through(1.5, 1.5, radius);
        CAPTURE(radius);
        CAPTURE(through.mean);
        CAPTURE(right);
        CHECK(through.mean > right - limit * through.error());
        CHECK(through.mean < 1.005 * right + limit * through.error());
        CHECK(through.error() < 0.005 * right);
    }
}

TEST_CASE("tracing: roulette leaves the flux in a furnace as it is, over 100 seeds") {
    // Walls that reflect rho: the power that arrives is 1/(1 - rho) of the lamp's.
    for (const float rho : {0.3f, 0.75f, 0.9f}) {
        BallRoomT<float> room;
        const auto wall = room.add(Lambertian{.albedo = Rgb{rho}});
        room.add(Sphere{.radius = 1}, wall, Rgb{0}, true);
        room.add(PointLight{.position{0.3f, 0, 0},
                            .intensity = Rgb{float(0.25 / std::numbers::pi)}});
        const World world(std::move(room));
        Mean arrived;
        for (std::uint64_t seed = 1; seed <= 100; ++seed) {
            const auto traced = trace_photons(world, MapType::general,
                                              {.photons = 1000,
                                               .seed = ljus_test::test_seed(seed),
                                               .shadow_photons = false,
                                               .threads = 1});
            double sum = 0;
            for (const Photon& photon : traced.photons) sum += double(photon.flux.x);
            arrived.add(sum);
        }
        CAPTURE(rho);
        CAPTURE(arrived.mean);
        CHECK(std::abs(apart(arrived, 1 / (1 - double(rho)))) < limit);
        // A geometric number of surfaces has the variance rho / (1 - rho)^2.
        const double right = std::sqrt(double(rho) / 1000) / (1 - double(rho)) / 10;
        CHECK(arrived.error() == ljus_test::within(right, 0.25));
    }
}

TEST_CASE("tracing: memory is foretold, and refused in a sentence before it is taken") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    for (const MapType law : {MapType::general, MapType::caustics})
        for (const PhotonSampling numbers :
             {PhotonSampling::random, PhotonSampling::sobol})
            for (const long long photons : {1000000000000LL, 9223372036854775807LL})
                CHECK_THROWS_WITH_AS(
                    (void)trace_photons(room, law,
                                        {.photons = photons, .numbers = numbers}),
                    doctest::Contains("max_memory is 4 GB"), std::invalid_argument);
    // If the blocks alone take too much, no path is traced.
    int asked = 0;
    const auto ask = [&](long long, long long) { return ++asked > 0; };
    CHECK_THROWS_AS((void)trace_photons(room, MapType::general,
                                        {.photons = 1000000000000LL, .progress = ask}),
                    std::invalid_argument);
    CHECK(asked == 0);
    // What the pilot stored tells what all of them will: both sides of the limit.
    const auto few =
        trace_photons(room, MapType::general, {.photons = detail::pilot_paths});
    const double mean = double(few.photons.size()) / double(detail::pilot_paths);
    const double bytes = detail::expected_bytes<float>(20000, mean);
    PhotonPassSettings pass{.photons = 20000, .max_memory = 1.05 * bytes};
    const auto all = trace_photons(room, MapType::general, pass);
    CHECK(double(all.photons.size()) * 60 == doctest::Approx(bytes).epsilon(0.05));
    pass.max_memory = 0.95 * bytes;
    CHECK_THROWS_AS((void)trace_photons(room, MapType::general, pass),
                    std::invalid_argument);
}

TEST_CASE("tracing: a pass that stores nothing gives up and says why") {
    const auto sentence = [](const BallRoom& open, MapType law) {
        const World room(open);
        const PhotonPassSettings pass{.photons = 1000000, .give_up = 4096};
        const auto traced = trace_photons(room, law, pass);
        CHECK(traced.photons.empty());
        CHECK(traced.complete);
        CHECK(traced.emitted == 4096);
        check_balance(traced.audit);
        // As if all had been sent: those that were stand for the others.
        if (law == MapType::general)
            CHECK(traced.audit.emitted.x == within(double(room.powers()[0].x), 1e-4));
        return traced.remark;
    };
    BallRoom hidden; // a wall between the lamp and the glass
    const auto grey = hidden.add(Lambertian{});
    hidden.add(Sphere{.center{0, 0, 0}, .radius = 0.2f}, hidden.add(Glass{}));
    hidden.add(Quad{.corner{-2, 1, -2}, .edge_u{4, 0, 0}, .edge_v{0, 0, 4}}, grey);
    hidden.add(PointLight{.position{0, 2, 0}});
    CHECK(sentence(hidden, MapType::caustics).find("100 % met something else") !=
          std::string::npos);

    BallRoom away; // a lamp that turns its back to the glass
    away.add(Sphere{.center{0, 0, 0}, .radius = 0.2f}, away.add(Glass{}));
    away.add(Quad{.corner{-2, 1, -2}, .edge_u{0, 0, 4}, .edge_v{4, 0, 0}},
             away.add(Lambertian{}), Rgb{1});
    CHECK(sentence(away, MapType::caustics).find("100 % could not be sent") !=
          std::string::npos);

    BallRoom nowhere; // a lamp that looks at nothing
    nowhere.add(Quad{.corner{-2, 1, -2}, .edge_u{0, 0, 4}, .edge_v{4, 0, 0}},
                nowhere.add(Lambertian{}), Rgb{1});
    CHECK(sentence(nowhere, MapType::general).find("100 % left the scene") !=
          std::string::npos);
    // A pass that has stored one photon goes on; one that ends before it says nothing.
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    const auto all =
        trace_photons(room, MapType::general, {.photons = 6000, .give_up = 1});
    CHECK(all.emitted == 6000);
    CHECK(all.remark.empty());
    CHECK(trace_photons(World(nowhere), MapType::general, {.photons = 4000})
              .remark.empty());
}

TEST_CASE("tracing: lamps and scenes of any size") {
    double share[2] = {}; // of the emitted flux that the floor gets first
    for (const double scale : {1.0, 1e-6, 1e-3, 1e3, 1e6})
        for (const double lamp : {1.0, 1e-4}) {
            const auto s = static_cast<float>(scale), r = static_cast<float>(lamp);
            BallRoom room;
            const auto grey = room.add(Lambertian{});
            room.add(Quad{.corner = s * Vec3{-1, 0, -1},
                          .edge_u{0, 0, 2 * s},
                          .edge_v{2 * s, 0, 0}},
                     grey);
            room.add(Sphere{.center = s * Vec3{0, 1.2f, 0}, .radius = s * r}, grey,
                     Rgb{1});
            const auto traced = trace_photons(
                World(room), MapType::general,
                {.photons = 20000, .shadow_photons = false, .threads = 1});
            check_balance(traced.audit);
            double direct = 0;
            for (const Photon& photon : traced.photons)
                if (photon.kind == PhotonKind::direct) direct += double(photon.flux.x);
            double& right = share[lamp < 1];
            const double now = direct / traced.audit.emitted.x;
            CAPTURE(scale);
            CAPTURE(lamp);
            if (right == 0) right = now;
            CHECK(now == doctest::Approx(right).epsilon(1e-3));
            CHECK(now > 0.1);
        }
}

TEST_CASE("tracing: the memory by hand, and what the sentences say") {
    CHECK(detail::photon_block == 512);
    const double block = sizeof(detail::PhotonBlockT<float>) / 16.0;
    CHECK(detail::expected_bytes<float>(1024, 1.5) ==
          doctest::Approx(1024 * 1.5 * 60 + 2 * block));
    CHECK(detail::expected_bytes<float>(1025, 0) == doctest::Approx(3 * block));
    CHECK(detail::expected_bytes<double>(100, 3) ==
          doctest::Approx(100 * 3 * 112 +
                          double(sizeof(detail::PhotonBlockT<double>)) / 16));
    // 10^9 x 2 x 60 bytes, and a sixteenth of 10^9 / 512 blocks of some hundred bytes.
    const PhotonPassSettings pass{.photons = 1000000000, .max_memory = 3e9};
    const double gigabytes = (120e9 + 1953125 * block) * 1e-9;
    const auto words = [](MapType map, const PhotonPassSettings& of, double mean) {
        return ljus_test::refusal(
            [&] { detail::require_memory<float>(map, of, mean); });
    };
    char right[200];
    std::snprintf(right, sizeof right,
                  "The 1000000000 photons for the caustics map would take %.3g GB, and "
                  "max_memory is 3 GB: %.0f photons would fit.",
                  gigabytes, 512 * std::floor(3e9 / (512 * 2 * 60 + block)));
    CHECK(words(MapType::caustics, pass, 2) == right);
    CHECK(words(MapType::general, {.photons = 1000, .max_memory = 1}, 0)
              .ends_with("max_memory is 1e-09 GB: at most 0 photons would fit."));
    const PhotonPassSettings exact{
        .photons = 1024, .max_memory = detail::expected_bytes<float>(1024, 1)};
    CHECK(words(MapType::general, exact, 1).empty()); // all of it may be taken

    // Of 800 paths 200 could not be sent; the others' 8 W went by tenths.
    const FluxAudit audit{.emitted{1, 2, 5},
                          .absorbed{0.8, 0.8, 0.6},
                          .escaped{0.6, 0.5, 0.5},
                          .cut{1.2, 1, 1},
                          .roulette{0.4, 0.4, 0.2}};
    const std::string why =
        detail::why_nothing({.photons = 1000}, MapType::caustics, 800, 200, audit);
    CHECK(why ==
          "gave up after 800 of 1000 photons, none of which was stored: 25 % "
          "could not be sent (mirrors and glass lie behind the lights), 30 % met "
          "something else before the mirror or glass, 15 % left the scene, 30 % "
          "was absorbed");
    const std::string general =
        detail::why_nothing({.photons = 1000}, MapType::general, 800, 200, audit);
    CHECK(general.find("(no light), 30 % met the limit of bounces,") !=
          std::string::npos);
    // Where no path could be sent nothing is known of flux: no NaN stands there.
    CHECK(detail::why_nothing({.photons = 9}, MapType::general, 5, 5, {}) ==
          "gave up after 5 of 9 photons, none of which was stored: 100 % could not be "
          "sent (no light), 0 % met the limit of bounces, 0 % left the scene, 0 % was "
          "absorbed");
}

TEST_CASE(
    "tracing: settings that make no sense, and what they are if nothing is said") {
    const ClosedRoom room = make_room<float>(Ball::lambertian, Lamp::quad, 1);
    const auto why = [&](const PhotonPassSettings& pass) {
        const std::string said = refusal([&] { check(pass); });
        CHECK(refusal([&] { (void)trace_photons(room, MapType::general, pass); }) ==
              said);
        return said;
    };
    CHECK(why({.photons = -1}) ==
          "the number of photons is -1; it must be at least 0.");
    CHECK(why({.max_bounces = 0}) ==
          "the largest number of bounces is 0; it must be at least 1.");
    CHECK(why({.max_memory = 0}) == "the memory for photons is 0; it must be above 0.");
    CHECK(why({.max_memory = std::nan("")}).starts_with("the memory for photons is "));
    CHECK(why({.give_up = 0}) ==
          "the number of paths without a photon is 0; it must be at least 1.");
    CHECK(why({.photons = 0, .max_bounces = 1, .max_memory = 1e-9, .give_up = 1}) ==
          "");
    const PhotonPassSettings pass;
    CHECK(pass.photons == 100000);
    CHECK(pass.seed == 1);
    CHECK(pass.iteration == 0);
    CHECK(pass.max_bounces == 1000);
    CHECK(pass.shadow_photons);
    CHECK(pass.keep.bits == light_kinds.bits);
    CHECK_FALSE(pass.equal_lights);
    CHECK(pass.numbers == PhotonSampling::random);
    CHECK(pass.shares.empty());
    CHECK(pass.max_memory == 4e9);
    CHECK(pass.give_up == 1048576);
    CHECK(pass.threads == 0);
}

TEST_CASE("tracing: a shadow photon on each matt surface behind the first") {
    // Many walls, one behind the other: matt ones, a mirror, one that is both at once,
    // and a mesh with a normal at its vertices that is not its own.
    using V = Vec3;
    Scene<Shapes<Quad, Mesh>, Materials<Lambertian, Mirror, Mixture>> scene;
    const auto matt = scene.add(Lambertian{});
    const auto both = scene.add(Mixture{.reflectivity = 0.5f});
    const auto mirror = scene.add(Mirror{});
    const auto wall = [](float z) { return Quad{{-1, -1, z}, {2, 0, 0}, {0, 2, 0}}; };
    for (int i = 1; i <= 30; ++i) scene.add(wall(float(-i)), matt);
    scene.add(wall(-31), mirror);
    scene.add(wall(-32), both);
    MeshData data{.positions{{-1, -1, -33}, {1, -1, -33}, {0, 1, -33}},
                  .triangles{{0, 1, 2}}};
    data.normals.assign(3, glm::normalize(V{0.5f, 0, 1}));
    scene.add(Mesh(data), matt);
    const EmittedPhotonT<float> photon{
        .ray{.origin{0, 0, 1}, .direction{0, 0, -1}}, .flux = Rgb{2}, .light = 5};
    std::vector<Photon> out;
    detail::trace_shadow(World(scene), photon, SurfacePoint{},
                         random_stream(1, Pass::user, 0, 0), out);
    REQUIRE(out.size() == 32); // all but the mirror
    for (std::size_t i = 0; i < 32; ++i) {
        CHECK(out[i].position.z ==
              doctest::Approx(i < 30 ? -1.0 - double(i) : -2.0 - double(i)));
        CHECK(out[i].kind == PhotonKind::shadow);
        CHECK(out[i].light == 5);
        CHECK(out[i].flux == Rgb{2});
        CHECK(out[i].direction == V{0, 0, -1});
        CHECK(out[i].normal == detail::SmallNormal{0, 0, 127}); // the surface's own
    }
}

TEST_CASE("tracing: only kinds that are kept, and nothing without flux") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 2);
    std::size_t kinds[4] = {};
    for (const Photon& photon :
         trace_photons(room, MapType::general, {.photons = 500, .threads = 1}).photons)
        ++kinds[std::size_t(photon.kind)];
    CHECK(kinds[1] == 0);
    for (const PhotonKind kind : {PhotonKind::direct, PhotonKind::indirect}) {
        const auto kept = trace_photons(room, MapType::general,
                                        {.photons = 500,
                                         .shadow_photons = false,
                                         .keep = one_kind(kind),
                                         .threads = 1});
        CHECK(kept.photons.size() == kinds[std::size_t(kind)]);
        for (const Photon& photon : kept.photons) CHECK(photon.kind == kind);
    }
    CHECK(trace_photons(room, MapType::caustics,
                        {.photons = 500, .keep = one_kind(PhotonKind::direct)})
              .photons.empty());
    // Glass that lets nothing through: a photon that has lost all of its flux ends.
    BallRoom dark;
    add_walls(dark);
    dark.add(Sphere{.radius = 0.4f}, dark.add(Glass{.absorption = Rgb{1e9f}}));
    dark.add(PointLight{.position{0, 0.9f, 0}});
    const auto traced =
        trace_photons(World(dark), MapType::caustics, {.photons = 2000, .threads = 1});
    check_balance(traced.audit);
    CHECK(traced.photons.size() > 10); // by reflection
    for (const Photon& photon : traced.photons) REQUIRE(photon.flux.x > 0);
}

TEST_CASE("tracing: roulette by hand, below its probability and above") {
    using D3 = glm::dvec3;
    const D3 flux{4, 2, 1};
    const auto play = [&](const D3& weight, double u, FluxAudit& audit) {
        return play_roulette(flux, weight, u, audit);
    };
    { // 0.5 of the largest channel is left: it lives up to 0.5, and is worth twice
        FluxAudit lives, dies;
        const auto survivor = play({0.5, 0.25, 1}, 0.499, lives);
        REQUIRE(survivor);
        CHECK(glm::distance(*survivor, D3{4, 1, 2}) < 1e-15);
        CHECK(lives.absorbed == D3{2, 1.5, 0});
        CHECK(lives.roulette == D3{-2, -0.5, -1});
        CHECK_FALSE(play({0.5, 0.25, 1}, 0.501, dies));
        CHECK(dies.absorbed == D3{2, 1.5, 0});
        CHECK(dies.roulette == D3{2, 0.5, 1});
    }
    { // shading normals may make more of it: then it surely lives, and is not divided
        FluxAudit audit;
        const auto survivor = play(D3{1.5}, 0.999, audit);
        REQUIRE(survivor);
        CHECK(*survivor == D3{6, 3, 1.5});
        CHECK(audit.roulette == D3{0});
        CHECK(audit.absorbed == D3{-2, -1, -0.5});
    }
    FluxAudit audit;
    CHECK_FALSE(play(D3{0}, 0, audit)); // nothing is left
    CHECK(audit.absorbed == flux);
}

TEST_CASE("tracing: what is stored where, by both normals, for its own map") {
    using D3 = glm::dvec3;
    const LambertianT<double> matt{.albedo = D3{0.5}};
    PathStateT<double> path{.ray{.direction = glm::normalize(D3{0.5, -1, 0})},
                            .throughput{4, 2, 1}};
    VertexT<double> vertex;
    vertex.point.position = {1, 2, 3};
    vertex.point.normal = {0, 1, 0};
    vertex.frame = frame_around(glm::normalize(D3{-0.4, 1, 0}));
    vertex.wo = to_local(vertex.frame, -path.ray.direction);
    const auto stored = [&](MapType map, const auto& material) {
        std::vector<PhotonT<double>> out;
        detail::store_photon(World(BallRoomT<double>{}), path, vertex, material, 7, map,
                             light_kinds, out);
        return out;
    };
    const auto flat = stored(MapType::general, matt);
    REQUIRE(flat.size() == 1);
    CHECK(flat[0].position == D3{1, 2, 3});
    CHECK(flat[0].direction == path.ray.direction);
    CHECK(flat[0].flux == D3{4, 2, 1});
    CHECK(flat[0].light == 7);
    CHECK(flat[0].kind == PhotonKind::direct);
    CHECK(flat[0].normal == detail::SmallNormal{0, 127, 0});
    // |w Ns| / |w Ng|, of w = (1, -2) / sqrt(5), Ns = (-2, 5) / sqrt(29), Ng = (0, 1).
    vertex.smooth = true;
    const auto smooth = stored(MapType::general, matt);
    REQUIRE(smooth.size() == 1);
    const double factor = 12 / (2 * std::sqrt(29.0));
    CHECK(glm::distance(smooth[0].flux, factor * D3{4, 2, 1}) < 1e-12);
    vertex.smooth = false;
    vertex.turned = true; // the two normals disagree about its side: it is lost
    CHECK(stored(MapType::general, matt).empty());
    vertex.turned = false;
    CHECK(stored(MapType::caustics, matt).empty());
    CHECK(stored(MapType::general, MirrorT<double>{}).empty());
    path.met_specular = true;
    CHECK(stored(MapType::general, matt).empty());
    REQUIRE(stored(MapType::caustics, matt).size() == 1);
    CHECK(stored(MapType::caustics, matt)[0].kind == PhotonKind::caustic);
    path.met_diffuse = true;
    CHECK(stored(MapType::caustics, matt).empty());
    REQUIRE(stored(MapType::general, matt).size() == 1);
    CHECK(stored(MapType::general, matt)[0].kind == PhotonKind::indirect);

    // Scattered: caustic photons, and those the normals disagree on, by mirrors only.
    for (const bool turned : {false, true})
        for (const MapType map : {MapType::general, MapType::caustics}) {
            vertex.turned = turned;
            int on = 0;
            const int games = 4000;
            for (int i = 0; i < games; ++i) {
                auto stream = random_stream(ljus_test::test_seed(6), Pass::user, 0,
                                            std::uint64_t(i));
                PathStateT<double> one = path;
                FluxAudit audit;
                const bool lives =
                    detail::scatter_photon(one, vertex, matt, map, stream, audit);
                on += lives;
                if (lives) CHECK(glm::distance(one.throughput, D3{4, 2, 1}) < 1e-12);
                // All of it is somewhere: 0.5 in the wall, the rest played for.
                const D3 left = lives ? one.throughput : D3{0};
                CHECK(glm::distance(audit.absorbed + audit.roulette + left,
                                    D3{4, 2, 1}) < 1e-12);
            }
            if (turned || map == MapType::caustics)
                CHECK(on == 0);
            else // half of them, within 5 standard errors
                CHECK(std::abs(on - games / 2) < 5 * std::sqrt(games / 4.0));
        }
}

TEST_CASE("tracing: one photon's way, step by step") {
    using D3 = glm::dvec3;
    // A slab of tinted glass lies on a black floor; straight down, 0.96 goes in.
    BallRoomT<double> room;
    const auto glass =
        room.add(GlassT<double>{.index = 1.5, .absorption{0.1, 0.2, 0.3}});
    const auto black = room.add(LambertianT<double>{.albedo = D3{0}});
    const auto top =
        room.add(QuadT<double>{{-9, 2, 9}, {18, 0, 0}, {0, 0, -18}}, glass);
    const auto floor =
        room.add(QuadT<double>{{-9, 0, 9}, {18, 0, 0}, {0, 0, -18}}, black);
    const World slab(std::move(room));
    const EmittedPhotonT<double> photon{
        .ray{.origin{0, 5, 0}, .direction{0, -1, 0}, .time = 0.5},
        .flux{4, 2, 1},
        .light = 3};
    const D3 inside = D3{4, 2, 1} * glm::exp(-2.0 * D3{0.1, 0.2, 0.3});
    int landed = 0;
    for (std::uint64_t i = 0; i < 400; ++i) {
        auto stream = random_stream(ljus_test::test_seed(6), Pass::user, 0, i);
        detail::PhotonBlockT<double> block;
        detail::trace_photon(slab, MapType::caustics, {photon, top},
                             {.max_bounces = 10}, stream, block);
        const FluxAudit& audit = block.audit;
        const std::vector<PhotonT<double>>& out = block.photons;
        CHECK(audit.emitted == D3{4, 2, 1});
        CHECK(audit.cut == D3{0});
        CHECK(out.size() <= 1);
        if (out.empty()) { // reflected by the glass
            CHECK(audit.escaped == D3{4, 2, 1});
            continue;
        }
        ++landed;
        CHECK(out[0].kind == PhotonKind::caustic);
        CHECK(out[0].light == 3);
        CHECK(glm::distance(out[0].flux, inside) < 1e-9); // it spawns a bit off
        CHECK(out[0].position.y == doctest::Approx(0));
        CHECK(glm::distance(audit.absorbed, D3{4, 2, 1}) < 1e-12);
        CHECK(audit.escaped == D3{0});
    }
    CHECK(std::abs(landed - 384) < 5 * std::sqrt(400 * 0.96 * 0.04));
    // The limit cuts it within the glass; another target than the one it met, at once.
    auto stream = random_stream(ljus_test::test_seed(6), Pass::user, 0, 0);
    detail::PhotonBlockT<double> limited, missed;
    detail::trace_photon(slab, MapType::caustics, {photon, top}, {.max_bounces = 1},
                         stream, limited);
    CHECK(glm::distance(limited.audit.cut, D3{4, 2, 1}) < 1e-12);
    CHECK(limited.photons.empty());
    detail::trace_photon(slab, MapType::caustics, {photon, floor}, {.max_bounces = 10},
                         stream, missed);
    CHECK(missed.audit.cut == D3{4, 2, 1});
    CHECK(missed.photons.empty());
}

TEST_CASE("tracing: lights get photons by their power, or as many each") {
    // Two points of 1 and 9 W under a dome that all photons meet: 4000 paths, 5
    // standard errors.
    BallRoomT<float> room;
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Sphere{.radius = 9}, black, Rgb{0}, true);
    const float unit = float(0.25 / std::numbers::pi);
    room.add(PointLight{.position{1, 0, 0}, .intensity = Rgb{unit}});
    room.add(PointLight{.position{0, 1, 0}, .intensity = Rgb{9 * unit}});
    const World world(std::move(room));
    for (const bool equal : {false, true}) {
        const auto traced = trace_photons(world, MapType::general,
                                          {.photons = 4000,
                                           .shadow_photons = false,
                                           .equal_lights = equal,
                                           .threads = 1});
        REQUIRE(traced.photons.size() == 4000);
        double count[2] = {}, flux[2] = {};
        for (const Photon& photon : traced.photons) {
            count[photon.light] += 1;
            flux[photon.light] += double(photon.flux.x);
        }
        const double chance = equal ? 0.5 : 0.1;
        CHECK(std::abs(count[0] - 4000 * chance) <
              5 * std::sqrt(4000 * chance * (1 - chance)));
        CHECK(flux[0] / count[0] == ljus_test::within(1 / chance / 4000, 1e-4));
        CHECK(flux[1] / count[1] == ljus_test::within(9 / (1 - chance) / 4000, 1e-4));
    }
}

TEST_CASE("tracing: each path has the numbers of its seed, map, repetition and place") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    const LightChoice& choice = room.light_choice();
    const auto targets = specular_objects(room);
    for (const MapType map : {MapType::general, MapType::caustics})
        for (const PhotonSampling numbers :
             {PhotonSampling::random, PhotonSampling::sobol}) {
            const PhotonPassSettings pass{.photons = 40,
                                          .seed = 5,
                                          .iteration = 3,
                                          .shadow_photons = false,
                                          .numbers = numbers,
                                          .threads = 1};
            const Pass part = map == MapType::general ? Pass::general_photons
                                                      : Pass::caustics_photons;
            detail::PhotonBlockT<float> block;
            for (std::uint64_t path = 0; path < 40; ++path) {
                SobolStream stream =
                    numbers == PhotonSampling::sobol
                        ? sobol_stream(5, part, 3, path)
                        : detail::without_points(random_stream(5, part, 3, path));
                detail::SentPhotonT<float> sent;
                if (map == MapType::general) {
                    sent.photon = emit(room, choice, stream);
                } else {
                    const auto aimed = aim(room, choice, targets, stream);
                    if (!aimed) continue;
                    sent = {aimed->photon, aimed->target, aimed->others};
                }
                sent.photon.flux /= 40.0f;
                detail::trace_photon(room, map, sent, pass, stream, block);
            }
            const std::vector<Photon>& right = block.photons;
            const auto traced = trace_photons(room, map, pass);
            REQUIRE(traced.photons.size() == right.size());
            REQUIRE(!right.empty());
            for (std::size_t i = 0; i < right.size(); ++i) {
                CHECK(traced.photons[i].position == right[i].position);
                CHECK(traced.photons[i].flux == right[i].flux);
            }
        }
}

TEST_CASE("tracing: progress ascends through all stages of a pass") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    std::vector<long long> heard;
    const auto watch = [&](long long done, long long all) {
        CHECK(all == 12); // blocks of 512
        heard.push_back(done);
        return true;
    };
    (void)trace_photons(
        room, MapType::general,
        {.photons = 6000, .give_up = 3000, .threads = 1, .progress = watch});
    REQUIRE(heard.size() == 12);
    for (std::size_t i = 0; i < 12; ++i)
        CHECK(heard[i] == static_cast<long long>(i + 1));
    // Who is told to stop stops, and asks no more in any later stage.
    int calls = 0;
    const auto stop = [&](long long, long long) { return ++calls < 0; };
    const auto stopped = trace_photons(
        room, MapType::general,
        {.photons = 6000, .give_up = 3000, .threads = 1, .progress = stop});
    CHECK(calls == 1);
    CHECK_FALSE(stopped.complete);
    CHECK(stopped.emitted == 2048); // the first stage
    CHECK(stopped.remark.empty());
    // Nor does it give up, though nothing was stored: it does not know of the rest, and
    // the account is that of the one block.
    BallRoom empty;
    empty.add(PointLight{.intensity = Rgb{1}});
    calls = 0;
    const auto nothing = trace_photons(
        World(empty), MapType::general,
        {.photons = 6000, .give_up = 3000, .threads = 1, .progress = stop});
    CHECK(calls == 1);
    CHECK_FALSE(nothing.complete);
    CHECK(nothing.photons.empty());
    CHECK(nothing.remark.empty());
    CHECK(nothing.audit.emitted.x == within(4 * std::numbers::pi * 512 / 6000, 1e-4));
}

TEST_CASE("tracing: as many lights as 16 bits can number, and no more") {
    const auto start = [](std::size_t lights) {
        LightChoice choice;
        for (std::size_t i = 0; i < lights; ++i)
            choice.cumulative.push_back(double(i + 1));
        return detail::start_pass<float>(MapType::general, PhotonPassSettings{},
                                         choice);
    };
    CHECK(start(65536).cumulative.size() == 65536);
    CHECK_THROWS_WITH_AS(
        (void)start(65537),
        "the number of lights is 65537; it must be at most 65536, because a photon has "
        "16 bits for its light's number.",
        std::invalid_argument);
}

TEST_CASE("tracing: a shadow falls where things are when the light passes") {
    Scene<Shapes<Quad, Moving<Quad>>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    // Below the first surface only from time 1 on.
    scene.add(Moving<Quad>{{{4.5f, -0.5f, -1}, {1, 0, 0}, {0, 1, 0}}, {-5, 0, 0}},
              grey);
    scene.add(Quad{{-9, -9, -2}, {18, 0, 0}, {0, 18, 0}}, grey);
    const World world(std::move(scene));
    for (const float time : {0.0f, 0.5f, 1.0f}) {
        const EmittedPhotonT<float> photon{
            .ray{.origin{0, 0, 1}, .direction{0, 0, -1}, .time = time}, .flux = Rgb{1}};
        std::vector<Photon> out;
        detail::trace_shadow(world, photon, SurfacePoint{},
                             random_stream(1, Pass::user, 0, 0), out);
        CHECK(out.size() == (time == 1 ? 2 : 1));
    }
}

TEST_CASE("tracing: with gloss as mirrors no light is lost, and none kept twice") {
    // A box with a glossy floor and a glossy wall that meet. What comes to matt walls
    // by them alone moves from the general map to the caustics map, all else stays, and
    // on gloss nothing of it is kept: paths carry it from there. 4 comparisons.
    for (const float roughness : {0.05f, 0.3f}) {
        Scene<Shapes<Quad>, Materials<Lambertian, Glossy>, Lights<PointLight>> scene;
        const auto matt = scene.add(Lambertian{.albedo = Rgb{0.5f}});
        const auto gloss =
            scene.add(Glossy{.reflectance = Rgb{0.9f}, .roughness = roughness});
        add_room(scene, Vec3{-1}, Vec3{1}, {gloss, matt, matt, matt, gloss, matt});
        scene.add(PointLight{.position{0.2f, 0.4f, 0}, .intensity = Rgb{1}});
        const World world(std::move(scene));
        CHECK(specular_objects(world).empty());
        REQUIRE(specular_objects(world, true).size() == 2);
        const auto on_gloss = [](const auto& photon) {
            return photon.normal == small_normal(Vec3{0, 1, 0}) ||
                   photon.normal == small_normal(Vec3{1, 0, 0});
        };
        using enum PhotonKind;
        const auto general = MapType::general, caustics = MapType::caustics;
        // What is stored on matt walls, and how many photons are where none may be.
        int strays = 0;
        const auto stored = [&](MapType map, bool as_mirrors, const auto& is_stray) {
            const PhotonPassSettings pass{.photons = 20000,
                                          .shadow_photons = false,
                                          .gloss_as_mirrors = as_mirrors,
                                          .threads = 1};
            return stored_flux(world, map, pass, 12, [&](const auto& photon) {
                const bool glossy = on_gloss(photon);
                strays += is_stray(photon.kind, glossy);
                return photon.kind == (map == general ? indirect : caustic) && !glossy;
            });
        };
        const Mean all = stored(general, false, [](auto, bool) { return false; });
        const Mean rest =
            stored(general, true, [](auto kind, bool) { return kind == caustic; });
        const Mean moved = stored(caustics, true, [](auto kind, bool glossy) {
            return kind == (glossy ? caustic : indirect);
        });
        CHECK(stored(caustics, false, [](auto, bool) { return false; }).mean == 0);
        CHECK(strays == 0);
        const auto error = [](const Mean& a, const Mean& b, const Mean& c) {
            return std::hypot(a.error(), b.error(), c.error());
        };
        CAPTURE(roughness);
        CHECK(moved.mean > 0.1 * all.mean);
        CHECK(rest.mean > 0.1 * all.mean);
        CHECK(std::abs(rest.mean + moved.mean - all.mean) <
              limit * error(all, rest, moved));
        CHECK(error(all, rest, moved) < 0.01 * all.mean);
    }
}
