// Which rays are needless: against verdicts counted one by one, the visible part of a
// lamp in closed form, and the laws of chance. Where chance decides, the false-alarm
// rate stands beside the check.
// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
// none failed.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "ljus/inspect/survey.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/photons/verdict_grid.hpp"
#include "ljus/render/render.hpp"
#include "ljus/render/skipping.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"
#include "support/rooms.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

constexpr SkipSettings enough{.rule = SkipRule::enough};
constexpr SkipSettings any{.rule = SkipRule::any};

/// A photon on a floor, from above.
Photon on_floor(float x, float z, PhotonKind kind, std::uint16_t light = 0) {
    return {.position{x, 0, z},
            .direction{0, -1, 0},
            .flux = Rgb{1},
            .light = light,
            .kind = kind,
            .normal{0, 127, 0}};
}
SurfacePoint floor_point(float x, float z) {
    return {.position{x, 0, z}, .normal{0, 1, 0}};
}
Verdict verdict_of(const VerdictGrid& grid, const SurfacePoint& point, int side,
                   std::size_t light = 0) {
    return grid.verdict(grid.cell_of(point, side), light);
}
std::vector<Photon> photons_of(const ClosedRoom& room, long long count,
                               std::uint64_t seed = 1) {
    return trace_photons(room, MapType::general,
                         {.photons = count, .seed = test_seed(seed), .threads = 1})
        .photons;
}

/// A floor, a lamp 2 above it, and between them a plate that ends at x = 0: from the
/// point (x, 0, z) of the floor the part 1/2 + x of the lamp is seen.
ClosedRoom half_plane(bool floor_up = true, bool second_lamp = false) {
    BallRoom room;
    const auto grey = room.add(Lambertian{.albedo = Rgb{0.5f}});
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    const Vec3 x{4, 0, 0}, z{0, 0, 4};
    room.add(Quad{.corner{-2, 0, -2},
                  .edge_u = floor_up ? z : x,
                  .edge_v = floor_up ? x : z},
             grey);
    room.add(Quad{.corner{-9, 1, -9}, .edge_u{9, 0, 0}, .edge_v{0, 0, 18}}, grey);
    room.add(Quad{.corner{-0.5f, 2, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}}, black,
             Rgb{10});
    if (second_lamp) // behind the plate, a thousandth as strong
        room.add(Quad{.corner{-2, 2, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}}, black,
                 Rgb{0.005f});
    return World(std::move(room));
}
double seen_part(double x) {
    return std::min(1.0, std::max(0.0, 0.5 + x));
}

} // namespace

TEST_CASE("shadow photons: how many are needed, and what they say") {
    // The least n with (1 - tau)^n <= alpha.
    for (const double tau : {0.01, 0.02, 0.05, 0.1, 0.5})
        for (const double alpha : {0.001, 0.05, 0.3}) {
            const auto n = photons_needed({.rule = SkipRule::enough,
                                           .tolerance = float(tau),
                                           .risk = float(alpha)});
            CHECK(std::pow(1 - double(float(tau)), n) <= alpha * (1 + 1e-6));
            CHECK(std::pow(1 - double(float(tau)), double(n) - 1) > alpha * (1 - 1e-6));
        }
    CHECK(photons_needed(enough) == 59);
    CHECK(photons_needed(any) == 1);
    CHECK(photons_needed({.rule = SkipRule::report}) == 50);
    // More than there can be: as many as a number holds, and no fewer.
    CHECK(photons_needed({.rule = SkipRule::enough, .tolerance = 1e-12f}) ==
          4000000000u);
    CHECK(photons_needed({.rule = SkipRule::enough, .tolerance = 1e-9f}) ==
          doctest::Approx(std::log(0.05f) / std::log1p(-double(1e-9f))).epsilon(1e-6));

    using detail::judge;
    CHECK(judge({58, 0}, SkipRule::enough, 59) == Verdict::unknown);
    CHECK(judge({59, 0}, SkipRule::enough, 59) == Verdict::lit);
    CHECK(judge({0, 59}, SkipRule::enough, 59) == Verdict::shadow);
    CHECK(judge({900000, 1}, SkipRule::enough, 59) == Verdict::unknown);
    CHECK(judge({1, 900000}, SkipRule::enough, 59) == Verdict::unknown);
    CHECK(judge({0, 0}, SkipRule::any, 1) == Verdict::unknown);
    CHECK(judge({1, 0}, SkipRule::any, 1) == Verdict::lit);
    CHECK(judge({0, 1}, SkipRule::any, 1) == Verdict::shadow);
    CHECK(judge({1, 1}, SkipRule::any, 1) == Verdict::unknown);
    CHECK(judge({49, 0}, SkipRule::report, 50) == Verdict::unknown);
    CHECK(judge({50, 0}, SkipRule::report, 50) == Verdict::lit);
    CHECK(judge({1201, 1}, SkipRule::report, 50) == Verdict::lit);
    CHECK(judge({1200, 1}, SkipRule::report, 50) == Verdict::unknown);
    CHECK(judge({1, 1201}, SkipRule::report, 50) == Verdict::shadow);
}

TEST_CASE("shadow photons: which way a side faces") {
    for (int axis = 0; axis < 3; ++axis) {
        detail::SmallNormal n{20, -30, 40};
        n[axis] = 100;
        CHECK(detail::facing(n, 1) == axis);
        CHECK(detail::facing(n, -1) == axis + 3);
        n[axis] = -100;
        CHECK(detail::facing(n, 1) == axis + 3);
        CHECK(detail::facing(n, -1) == axis);
    }
    // By a unit vector as by its small normal, ties of 45 degrees too.
    auto stream = random_stream(test_seed(5), Pass::camera, 0, 0);
    for (int i = 0; i < 20000; ++i) {
        Vec3 n = sample_uniform_sphere(next_2d<float>(stream));
        if (i % 4 == 0) n = glm::normalize(Vec3{n.x, n.x * (1 + 1e-7f), 0.1f * n.z});
        for (const int side : {1, -1})
            REQUIRE(detail::facing(n, side) == detail::facing(small_normal(n), side));
    }
    // Both signs of a tie face opposite ways along one axis.
    CHECK(detail::facing(detail::SmallNormal{90, 90, 0}, 1) == 0);
    CHECK(detail::facing(detail::SmallNormal{-90, -90, 0}, 1) == 3);
    CHECK(detail::facing(detail::SmallNormal{90, 0, 90}, 1) == 0);
    CHECK(detail::facing(detail::SmallNormal{0, 90, 90}, 1) == 1);
    CHECK(detail::facing(detail::SmallNormal{73, 73, 73}, 1) == 0);
    // A photon faces its origin, on either side of the normal.
    for (const int up : {127, -127}) {
        Photon photon = on_floor(0, 0, PhotonKind::direct);
        photon.normal.y = static_cast<std::int8_t>(up);
        CHECK(detail::facing(photon) == 1);
        photon.direction.y = 1;
        CHECK(detail::facing(photon) == 4);
    }
}

// --- The grid and its plain twins ----------------------------------------------------

namespace {

/// What the grid should say, photon by photon: cells of one, two and four lengths.
Verdict counted(const std::vector<Photon>& photons, const VerdictGrid& grid,
                const SurfacePoint& point, int way, std::size_t light,
                const SkipSettings& skip) {
    for (const int times : {1, 2, 4}) {
        const auto cell = [&](const Vec3& p) {
            const Vec3 c = (p - grid.known.cells.corner) * (1 / grid.radius());
            return glm::ivec3{int(std::floor(c.x)) / times,
                              int(std::floor(c.y)) / times,
                              int(std::floor(c.z)) / times};
        };
        detail::PhotonCounts found;
        for (const Photon& photon : photons) {
            const glm::ivec3 d = cell(photon.position) - cell(point.position);
            if (std::abs(d.x) > 1 || std::abs(d.y) > 1 || std::abs(d.z) > 1 ||
                (photon.light != light && skip.rule != SkipRule::report) ||
                detail::facing(photon) != way)
                continue;
            found.direct += photon.kind == PhotonKind::direct ? 1 : 0;
            found.shadow += photon.kind == PhotonKind::shadow ? 1 : 0;
        }
        const Verdict verdict = detail::judge(found, skip.rule, photons_needed(skip));
        if (verdict != Verdict::unknown) return verdict;
    }
    return Verdict::unknown;
}

} // namespace

TEST_CASE("shadow photons: the grid says what its photons say, counted one by one") {
    BallRoom room;
    add_walls(room);
    add_ball(room, Ball::lambertian);
    add_lamps(room, Lamp::quad, 2);
    const World world(std::move(room));
    const auto photons = photons_of(world, 8000);
    const PhotonMap map = make_photon_map(photons);
    for (const SkipSettings& skip :
         {enough, any, SkipSettings{.rule = SkipRule::report},
          SkipSettings{.rule = SkipRule::enough, .radius = 0.2f}}) {
        const VerdictGrid grid = make_verdict_grid(photons, 2, skip, 1);
        CAPTURE(grid.radius());
        int lit = 0, shadow = 0, compared = 0;
        for (std::size_t i = 0; i < photons.size(); i += 31) {
            if (photons[i].kind == PhotonKind::indirect) continue; // it makes no brick
            const SurfacePoint point{.position = photons[i].position,
                                     .normal = glm::normalize(Vec3(photons[i].normal))};
            const int side = photon_side(photons[i].direction, point.normal);
            const int way = detail::facing(photons[i]);
            if (detail::facing(small_normal(point.normal), side) != way) continue;
            for (const std::size_t light : {0u, 1u}) {
                const Verdict verdict = verdict_of(grid, point, side, light);
                // Rounding of a coordinate at a cell's border is the same in both.
                REQUIRE(verdict == counted(photons, grid, point, way, light, skip));
                lit += verdict == Verdict::lit ? 1 : 0;
                shadow += verdict == Verdict::shadow ? 1 : 0;
                ++compared;
                // Within one length there is no photon of the other kind.
                if (skip.rule == SkipRule::report || verdict == Verdict::unknown)
                    continue;
                const Verdict near =
                    verdict_at(map, point, side, light, 0.999f * grid.radius(), any);
                REQUIRE((near == verdict || near == Verdict::unknown));
            }
        }
        CHECK(compared > 200);
        CHECK(lit > 50);
        CHECK(shadow > 5);
    }
}

TEST_CASE("shadow photons: in one place each light has its own photons") {
    // The first of four lights shines far away. One of the others is hidden where the
    // two that are left shine, and light has come from elsewhere, too: what is counted
    // for one leaves nothing for the next.
    for (std::uint16_t hidden = 1; hidden < 4; ++hidden) {
        std::vector<Photon> photons;
        for (int i = 0; i < 400; ++i) {
            const auto light = static_cast<std::uint16_t>(i % 4);
            const auto kind = light == hidden ? PhotonKind::shadow : PhotonKind::direct;
            const float x = float(i / 4 % 10) / 10, z = float(i / 40) / 10;
            photons.push_back(on_floor(light == 0 ? x + 60 : x, z, kind, light));
        }
        photons.push_back(on_floor(0.5f, 0.5f, PhotonKind::indirect, hidden));
        for (SkipSettings skip : {any, enough}) {
            skip.radius = 2;
            skip.indirect_rays = true;
            const VerdictGrid grid = make_verdict_grid(photons, 4, skip, 1);
            const SurfacePoint middle = floor_point(0.45f, 0.55f);
            CHECK(verdict_of(grid, middle, 1, 0) == Verdict::unknown);
            for (std::size_t light = 1; light < 4; ++light)
                CHECK(verdict_of(grid, middle, 1, light) ==
                      (light == hidden ? Verdict::shadow : Verdict::lit));
            CHECK(grid.indirect_near(grid.cell_of(middle, 1)));
        }
    }
}

// --- Is it right? --------------------------------------------------------------------

TEST_CASE("shadow photons: the penumbra of a square lamp behind a straight edge") {
    for (const bool up : {true, false}) { // the floor's own normal does not matter
        int skipped = 0, wrong = 0, points = 0, far = 0, far_known = 0;
        for (int seed = 1; seed <= 8; ++seed) {
            const auto photons =
                photons_of(half_plane(up), 100000, std::uint64_t(seed));
            const VerdictGrid grid = make_verdict_grid(photons, 1, enough);
            CHECK(grid.radius() < 0.2f);
            for (int i = 0; i < 200; ++i)
                for (int j = 0; j < 20; ++j) {
                    const double x = -1.5 + 3 * (i + 0.5) / 200;
                    const SurfacePoint point{.position{float(x), 0, -1 + float(j) / 10},
                                             .normal{0, up ? 1.0f : -1.0f, 0}};
                    const Verdict verdict = verdict_of(grid, point, up ? 1 : -1);
                    const double v = seen_part(x);
                    ++points;
                    far += std::abs(x) > 1.2 ? 1 : 0;
                    if (verdict == Verdict::unknown) continue;
                    ++skipped;
                    far_known += std::abs(x) > 1.2 ? 1 : 0;
                    const double said = verdict == Verdict::lit ? 1 : 0;
                    wrong += std::abs(said - v) > 0.05 ? 1 : 0;
                    REQUIRE(std::abs(said - v) < 0.5);
                    // The other side of the floor gets no light, and knows nothing.
                    REQUIRE(verdict_of(grid, point, up ? -1 : 1) == Verdict::unknown);
                }
        }
        MESSAGE("skipped " << 100.0 * skipped / points << " %, wrong "
                           << 100.0 * wrong / points << " %");
        CHECK(far_known > 0.8 * far);
        CHECK(wrong * 1000 <= points); // 0.1 %
    }
}

TEST_CASE("shadow photons: called lit at the tolerated share with the stated risk") {
    // As many photons as are needed around one point, each a shadow photon with the
    // probability tau: all are direct with (1 - tau)^n. The share of 20 000 trials lies
    // more than 4 standard errors off in 0.006 % of all runs.
    for (const float tau : {0.05f, 0.2f}) {
        const SkipSettings skip{
            .rule = SkipRule::enough, .radius = 1, .tolerance = tau, .risk = 0.05f};
        const std::uint32_t n = photons_needed(skip);
        constexpr int trials = 20000;
        int lit = 0;
        for (int trial = 0; trial < trials; ++trial) {
            auto stream = random_stream(test_seed(7), Pass::general_photons, 0,
                                        std::uint64_t(trial));
            std::vector<Photon> photons;
            for (std::uint32_t i = 0; i < n; ++i) {
                const float x = next_1d<float>(stream), z = next_1d<float>(stream);
                const bool hidden = next_1d<float>(stream) < tau;
                photons.push_back(
                    on_floor(0.1f * x, 0.1f * z,
                             hidden ? PhotonKind::shadow : PhotonKind::direct));
            }
            const VerdictGrid grid = make_verdict_grid(photons, 1, skip, 1);
            lit += verdict_of(grid, floor_point(0.05f, 0.05f), 1) == Verdict::lit;
        }
        const double p = std::pow(1 - double(tau), n);
        const double share = double(lit) / trials;
        CAPTURE(tau);
        CHECK(std::abs(share - p) < 4 * std::sqrt(p * (1 - p) / trials));
        CHECK(p <= 0.05);
    }
}

// --- In the renderer -----------------------------------------------------------------

namespace {

PhotonMappingSettings skipping(SkipRule rule, long long photons = 100000) {
    PhotonMappingSettings settings;
    settings.general.photons = photons;
    settings.skip.rule = rule;
    return settings;
}
constexpr RenderSettings small{.width = 24, .height = 24, .samples = 4, .threads = 1};

} // namespace

TEST_CASE("shadow photons: what is known to be lit has the same bytes without rays") {
    BallRoom room; // nothing hides anything
    const auto grey = room.add(Lambertian{.albedo = Rgb{0.5f}});
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Quad{.corner{-1, 0, -1}, .edge_u{0, 0, 2}, .edge_v{2, 0, 0}}, grey);
    room.add(Quad{.corner{-0.2f, 1, -0.2f}, .edge_u{0.4f, 0, 0}, .edge_v{0, 0, 0.4f}},
             black, Rgb{5});
    room.add(PointLight{.position{0.5f, 1, 0}, .intensity = Rgb{1}});
    const World world(std::move(room));
    const Camera camera = look_at({.position{0, 2, 2}, .target{0, 0, 0}});
    for (const int rays : {1, 4}) {
        PhotonMappingSettings settings = skipping(SkipRule::none);
        settings.shadow_rays = rays;
        const PhotonMapper all(world, settings, abilities<Skipping>);
        CHECK(all.state<Skipping>().verdicts.empty());
        const auto before = render(all, camera, small);
        CHECK(before.counts.skipped_rays == 0);
        // Nothing is asked for: a mapper that is able to skip is as one that is not.
        const auto unable = render(PhotonMapper(world, settings), camera, small);
        CHECK(unable.image.pixels == before.image.pixels);
        CHECK(unable.counts.shadow_rays == before.counts.shadow_rays);
        settings.skip.rule = SkipRule::enough;
        const PhotonMapper few(world, settings, abilities<Skipping>);
        CHECK(few.maps().general.empty()); // nothing else needs it
        const auto after = render(few, camera, small);
        CHECK(after.image.pixels == before.image.pixels);
        CHECK(after.counts.shadow_rays + after.counts.skipped_rays ==
              before.counts.shadow_rays);
        CHECK(after.counts.shadow_rays * 20 < before.counts.shadow_rays);
        CHECK(after.counts.bounce_rays == before.counts.bounce_rays);
    }
}

TEST_CASE("shadow photons: fewer rays, the same picture, for any number of threads") {
    BallRoom room;
    add_walls(room);
    add_ball(room, Ball::mixture);
    add_lamps(room, Lamp::quad, 2);
    const World world(std::move(room));
    PhotonMappingSettings settings = skipping(SkipRule::none, 300000);
    const auto all = render(PhotonMapper(world, settings), room_camera<float>(), small);
    settings.skip.rule = SkipRule::enough;
    const PhotonMapper mapper(world, settings, abilities<Skipping>);
    const auto& bits = mapper.state<Skipping>().verdicts.known.bits;
    const auto some = render(mapper, room_camera<float>(), small);
    const double left =
        double(some.counts.shadow_rays) / double(all.counts.shadow_rays);
    CHECK(left < 0.5);
    CHECK(some.counts.skipped_rays > 0);
    double error = 0, light = 0; // the same random numbers: all that differs is V
    for (std::size_t i = 0; i < all.image.pixels.size(); ++i) {
        const double d = double(some.image.pixels[i].y - all.image.pixels[i].y);
        error += d * d;
        light += double(all.image.pixels[i].y * all.image.pixels[i].y);
    }
    CHECK(error < 1e-4 * light);
    for (const int threads : {2, 5}) {
        PhotonMappingSettings other = settings;
        other.general.threads = other.caustics.threads = threads;
        RenderSettings picture = small;
        picture.threads = threads;
        const PhotonMapper again(world, other, abilities<Skipping>);
        CHECK(again.state<Skipping>().verdicts.known.bits == bits);
        const auto same = render(again, room_camera<float>(), picture);
        CHECK(same.image.pixels == some.image.pixels);
        CHECK(same.counts.skipped_rays == some.counts.skipped_rays);
    }
    // With another use of the general map its photons serve both, and it keeps shadow
    // photons only if it is told to.
    settings.indirect = IndirectLight::map;
    settings.general.shadow_photons = false;
    const PhotonMapper both(world, settings, abilities<Skipping>);
    CHECK_FALSE(both.maps().general.empty());
    CHECK_FALSE(both.state<Skipping>().verdicts.empty());
    for (std::size_t i = 0; i < both.maps().general.records.size(); ++i)
        REQUIRE(both.maps().general.records[i].kind != PhotonKind::shadow);
    settings.general.shadow_photons = true;
    const PhotonMapper kept(world, settings, abilities<Skipping>);
    CHECK(kept.state<Skipping>().verdicts.known.bits ==
          both.state<Skipping>().verdicts.known.bits);
    CHECK(kept.maps().general.records.size() > both.maps().general.records.size());
}

TEST_CASE(
    "shadow photons: the report asks all lamps at once, and a faint one is lost") {
    // Behind the plate nothing of the faint lamp arrives on the right; the bright one's
    // photons say that all is lit.
    const auto photons = photons_of(half_plane(true, true), 400000);
    const SurfacePoint point = floor_point(0.8f, 0);
    const ClosedRoom room = half_plane(true, true);
    for (const float y : {-0.4f, 0.0f, 0.4f}) // the faint lamp is hidden here, indeed
        for (const float x : {-1.9f, -1.1f})
            CHECK(occluded(room, Ray{.origin = point.position,
                                     .direction = Vec3{x, 2, y} - point.position,
                                     .t_min = 1e-3f,
                                     .t_max = 0.999f}));
    const VerdictGrid report =
        make_verdict_grid(photons, 2, {.rule = SkipRule::report});
    CHECK(verdict_of(report, point, 1, 0) == Verdict::lit);
    CHECK(verdict_of(report, point, 1, 1) == Verdict::lit); // wrong
    const VerdictGrid grid = make_verdict_grid(photons, 2, enough);
    CHECK(verdict_of(grid, point, 1, 0) == Verdict::lit);
    CHECK(verdict_of(grid, point, 1, 1) != Verdict::lit);
    // As many photons from each lamp, as the renderer sends them, and both are known.
    const auto equal = trace_photons(room, MapType::general,
                                     {.photons = 400000, .equal_lights = true});
    const VerdictGrid fair = make_verdict_grid(equal.photons, 2, enough);
    CHECK(verdict_of(fair, point, 1, 0) == Verdict::lit);
    CHECK(verdict_of(fair, point, 1, 1) == Verdict::shadow);
    // And the light is the same: a lamp's flux is shared out among its photons.
    double flux[2] = {0, 0};
    for (const Photon& photon : equal.photons)
        if (photon.kind != PhotonKind::indirect) flux[photon.light] += photon.flux.x;
    double by_power[2] = {0, 0};
    for (const Photon& photon : photons)
        if (photon.kind != PhotonKind::indirect)
            by_power[photon.light] += photon.flux.x;
    CHECK(flux[0] == doctest::Approx(by_power[0]).epsilon(0.01));
    CHECK(flux[1] == doctest::Approx(by_power[1]).epsilon(0.3)); // by_power has 200
}

TEST_CASE("shadow photons: of fewer photons than are needed no verdict is made") {
    BallRoom room;
    add_walls(room);
    add_lamps(room, Lamp::quad, 1);
    const World world(std::move(room));
    for (const long long photons : {58, 59}) {
        const PhotonMapper mapper(world, skipping(SkipRule::enough, photons),
                                  abilities<Skipping>);
        CHECK(mapper.state<Skipping>().verdicts.empty() == (photons == 58));
    }
}

// --- Indirect rays -------------------------------------------------------------------

TEST_CASE("shadow photons: no indirect ray where no indirect photon is near") {
    // Two rooms, one of them closed and dark.
    BallRoom room;
    const auto grey = room.add(Lambertian{.albedo = Rgb{0.5f}});
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    for (const float x : {-2.0f, 0.0f, 2.0f})
        room.add(Quad{.corner{x, 0, 0}, .edge_u{0, 1, 0}, .edge_v{0, 0, 1}}, grey);
    for (const float y : {0.0f, 1.0f})
        room.add(Quad{.corner{-2, y, 0}, .edge_u{0, 0, 1}, .edge_v{4, 0, 0}}, grey);
    for (const float z : {0.0f, 1.0f})
        room.add(Quad{.corner{-2, 0, z}, .edge_u{4, 0, 0}, .edge_v{0, 1, 0}}, grey);
    room.add(
        Quad{.corner{-1.2f, 0.99f, 0.4f}, .edge_u{0.2f, 0, 0}, .edge_v{0, 0, 0.2f}},
        black, Rgb{50});
    const World world(std::move(room));
    const Camera into_dark =
        look_at({.position{0.1f, 0.5f, 0.5f}, .target{2, 0.5f, 0.5f}});
    const Camera into_light =
        look_at({.position{-0.1f, 0.5f, 0.5f}, .target{-2, 0.5f, 0.5f}});
    PhotonMappingSettings settings;
    settings.general.photons = 20000;
    settings.skip.indirect_rays = true;
    const PhotonMapper mapper(world, settings, abilities<Skipping>);
    REQUIRE(mapper.state<Skipping>().verdicts.dark_known);
    const auto dark = render(mapper, into_dark, small);
    CHECK(dark.counts.bounce_rays == 0);
    CHECK(dark.counts.skipped_bounces == dark.counts.camera_rays);
    for (const Rgb& pixel : dark.image.pixels) REQUIRE(is_black(pixel));
    const auto light = render(mapper, into_light, small);
    CHECK(light.counts.skipped_bounces * 100 < light.counts.bounce_rays);

    // With few photons some places miss theirs, and the picture can only be darker.
    PhotonMappingSettings all = settings;
    all.skip.indirect_rays = false;
    const auto right = render(PhotonMapper(world, all), into_light, small);
    settings.general.photons = 200;
    settings.skip.radius = 0.1f;
    const auto poor =
        render(PhotonMapper(world, settings, abilities<Skipping>), into_light, small);
    CHECK(poor.counts.skipped_bounces > 100);
    double sum = 0, should = 0;
    for (std::size_t i = 0; i < poor.image.pixels.size(); ++i) {
        REQUIRE(poor.image.pixels[i].y <= right.image.pixels[i].y);
        sum += double(poor.image.pixels[i].y);
        should += double(right.image.pixels[i].y);
    }
    CHECK(sum < 0.95 * should);

    // A point next to an indirect photon is never called dark, in any brick.
    const auto photons = photons_of(world, 300);
    SkipSettings skip{.indirect_rays = true, .radius = 0.05f};
    const VerdictGrid grid = make_verdict_grid(photons, 1, skip);
    for (const Photon& photon : photons) {
        if (photon.kind != PhotonKind::indirect) continue;
        const Vec3 normal = glm::normalize(Vec3(photon.normal));
        const int side = photon_side(photon.direction, normal);
        for (int i = 0; i < 27; ++i) {
            const Vec3 step{float(i % 3 - 1), float(i / 3 % 3 - 1), float(i / 9 - 1)};
            const SurfacePoint point{.position = photon.position + 0.0499f * step,
                                     .normal = normal};
            REQUIRE(grid.indirect_near(grid.cell_of(point, side)));
        }
    }
}

// --- Extremes ------------------------------------------------------------------------

TEST_CASE("shadow photons: extremes") {
    const SurfacePoint point = floor_point(0, 0);
    SUBCASE("no photons, one photon, all in one point") {
        CHECK(make_verdict_grid(std::vector<Photon>{}, 1, enough).empty());
        CHECK(verdict_of(VerdictGrid{}, point, 1) == Verdict::unknown);
        CHECK(VerdictGrid{}.indirect_near({}));
        const std::vector<Photon> one{on_floor(0, 0, PhotonKind::direct)};
        CHECK(make_verdict_grid(one, 1, any).empty()); // a grid of no size
        SkipSettings wide = any;
        wide.radius = 0.5f;
        const VerdictGrid grid = make_verdict_grid(one, 1, wide);
        CHECK(verdict_of(grid, point, 1) == Verdict::lit);
        CHECK(verdict_of(grid, point, -1) == Verdict::unknown);
        CHECK(verdict_of(grid, floor_point(50, 0), 1) == Verdict::unknown);
        CHECK(verdict_of(make_verdict_grid(one, 1, {.rule = SkipRule::none}), point,
                         1) == Verdict::unknown);
        const std::vector<Photon> many(1000, on_floor(3, 3, PhotonKind::shadow));
        wide.rule = SkipRule::enough;
        CHECK(verdict_of(make_verdict_grid(many, 1, wide), floor_point(3, 3), 1) ==
              Verdict::shadow);
    }
    SUBCASE("points that are nowhere") {
        const VerdictGrid grid =
            make_verdict_grid(photons_of(half_plane(), 2000), 1, enough);
        for (const float bad : {std::numeric_limits<float>::quiet_NaN(),
                                std::numeric_limits<float>::infinity(), 1e30f, -1e30f})
            for (int axis = 0; axis < 3; ++axis) {
                SurfacePoint far = point;
                far.position[axis] = bad;
                CHECK(verdict_of(grid, far, 1) == Verdict::unknown);
            }
    }
    SUBCASE("a photon without a normal, or of a light that is not there") {
        std::vector<Photon> photons(100, on_floor(0, 0, PhotonKind::direct));
        for (Photon& photon : photons) photon.normal = detail::SmallNormal{0};
        const SkipSettings wide{.rule = SkipRule::any, .radius = 1};
        CHECK(verdict_of(make_verdict_grid(photons, 1, wide), point, 1) ==
              Verdict::unknown);
        photons.assign(100, on_floor(0, 0, PhotonKind::direct, 7));
        CHECK(verdict_of(make_verdict_grid(photons, 1, wide), point, 1) ==
              Verdict::unknown);
        CHECK(verdict_of(make_verdict_grid(photons, 8, wide), point, 1, 7) ==
              Verdict::lit);
        // Light number 7 of seven: none, and what it says is of nothing else either.
        SkipSettings dark = wide;
        dark.indirect_rays = true;
        const VerdictGrid seven = make_verdict_grid(photons, 7, dark);
        CHECK_FALSE(seven.indirect_near(seven.cell_of(point, 1)));
        for (std::size_t light = 0; light < 7; ++light)
            CHECK(verdict_of(seven, point, 1, light) == Verdict::unknown);
    }
    SUBCASE("a radius larger than the room, and one too small for a number") {
        const auto photons = photons_of(half_plane(), 20000);
        SkipSettings skip = enough;
        skip.radius = 1000;
        const VerdictGrid large = make_verdict_grid(photons, 1, skip);
        CHECK(verdict_of(large, floor_point(1.5f, 0), 1) == Verdict::unknown);
        skip.radius = 1e-30f;
        const VerdictGrid tiny = make_verdict_grid(photons, 1, skip);
        CHECK(verdict_of(tiny, floor_point(1.5f, 0), 1) == Verdict::unknown);
    }
    SUBCASE("a lamp that cannot be reached") {
        BallRoom room;
        add_walls(room);
        const auto grey = room.add(Lambertian{.albedo = Rgb{0.5f}});
        room.add(PointLight{.position{0, 0.9f, 0}, .intensity = Rgb{1}});
        room.add(PointLight{.position{0, -0.5f, 0}, .intensity = Rgb{1}});
        room.add(Sphere{.center{0, -0.5f, 0}, .radius = 0.1f}, grey); // around it
        const VerdictGrid grid =
            make_verdict_grid(photons_of(World(room), 100000), 2, enough);
        const SurfacePoint floor{.position{0.7f, -1, 0.7f}, .normal{0, 1, 0}};
        CHECK(verdict_of(grid, floor, 1, 0) == Verdict::lit);
        CHECK(verdict_of(grid, floor, 1, 1) == Verdict::shadow);
        // One of no power sends no photon, and nothing is known of it.
        room.add(PointLight{.position{0.5f, 0, 0.5f}, .intensity = Rgb{0}});
        const World world(std::move(room));
        const VerdictGrid more =
            make_verdict_grid(photons_of(world, 100000), 3, enough);
        CHECK(verdict_of(more, floor, 1, 2) == Verdict::unknown);
    }
    SUBCASE("the two sides of a thin wall, and the floor at its foot") {
        BallRoom room;
        const auto grey = room.add(Lambertian{.albedo = Rgb{0.5f}});
        room.add(Quad{.corner{-1, 0, -1}, .edge_u{0, 0, 2}, .edge_v{2, 0, 0}}, grey);
        room.add(Quad{.corner{0, 0, -1}, .edge_u{0, 2, 0}, .edge_v{0, 0, 2}}, grey);
        room.add(PointLight{.position{-0.8f, 0.8f, 0}, .intensity = Rgb{1}});
        const World closed(std::move(room));
        const VerdictGrid grid =
            make_verdict_grid(photons_of(closed, 100000), 1, enough);
        const SurfacePoint wall{.position{0, 0.5f, 0}, .normal{1, 0, 0}};
        CHECK(verdict_of(grid, wall, -1) == Verdict::lit);
        CHECK(verdict_of(grid, wall, 1) == Verdict::unknown); // turned away from it
        CHECK(verdict_of(grid, floor_point(-0.5f, 0), 1) == Verdict::lit);
        CHECK(verdict_of(grid, floor_point(0.5f, 0), 1) == Verdict::shadow);
        CHECK(verdict_of(grid, floor_point(1e-4f, 0), 1) == Verdict::unknown);
    }
    SUBCASE("in double") {
        BallRoomT<double> room;
        add_walls(room);
        add_ball(room, Ball::lambertian);
        add_lamps(room, Lamp::quad, 1);
        const World closed(std::move(room));
        const auto traced = trace_photons(closed, MapType::general, {.photons = 50000});
        const auto grid = make_verdict_grid(traced.photons, 1, enough);
        int known = 0;
        for (std::size_t i = 0; i < traced.photons.size(); i += 50) {
            const auto& photon = traced.photons[i];
            const SurfacePointT<double> at{
                .position = photon.position,
                .normal = glm::normalize(Vec3T<double>(photon.normal))};
            const auto place =
                grid.cell_of(at, photon_side(photon.direction, at.normal));
            known += grid.verdict(place, 0) != Verdict::unknown ? 1 : 0;
        }
        CHECK(known * 50 > int(traced.photons.size()) / 2);
    }
    SUBCASE("a hundred lights") {
        std::vector<Photon> photons;
        for (std::uint16_t light = 0; light < 100; ++light)
            for (int i = 0; i < 60; ++i)
                photons.push_back(on_floor(
                    0.01f * float(i), 0,
                    light % 2 == 0 ? PhotonKind::direct : PhotonKind::shadow, light));
        SkipSettings skip = enough;
        skip.radius = 1;
        const VerdictGrid grid = make_verdict_grid(photons, 100, skip);
        for (std::size_t light = 0; light < 100; ++light)
            CHECK(verdict_of(grid, floor_point(0.3f, 0), 1, light) ==
                  (light % 2 == 0 ? Verdict::lit : Verdict::shadow));
    }
}

TEST_CASE("shadow photons: settings that make no sense") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto refuse = [](const SkipSettings& skip) {
        CHECK_THROWS_AS(check(skip), std::invalid_argument);
        PhotonMappingSettings settings;
        settings.skip = skip;
        CHECK_THROWS_AS(check(settings), std::invalid_argument);
    };
    for (const float bad : {-1.0f, nan, std::numeric_limits<float>::infinity()})
        refuse({.radius = bad});
    for (const float bad : {0.0f, 1.0f, -1.0f, nan}) {
        refuse({.tolerance = bad});
        refuse({.risk = bad});
    }
    check(SkipSettings{});
    check(enough);
    // A grid is not made by them either.
    const std::vector<Photon> one{on_floor(0, 0, PhotonKind::direct)};
    CHECK_THROWS_WITH_AS(
        (void)make_verdict_grid(one, 1, {.rule = SkipRule::any, .risk = 1}),
        "skip.risk is 1; it must be above 0 and below 1.", std::invalid_argument);
    CHECK_THROWS_AS((void)make_verdict_grid(std::vector<Photon>{}, 1, {.radius = -1}),
                    std::invalid_argument);
    // What they are if nothing is said.
    CHECK(SkipSettings{}.rule == SkipRule::none);
    CHECK_FALSE(SkipSettings{}.indirect_rays);
    CHECK(SkipSettings{}.radius == 0);
    CHECK(SkipSettings{}.tolerance == 0.05f);
    CHECK(SkipSettings{}.risk == 0.05f);
}

TEST_CASE("shadow photons: cells, bricks and the table that finds them") {
    using detail::BrickTable;
    const detail::CellsT<float> cells{.corner{1, 2, 3}, .length = 0.5f};
    const auto cell =
        cells.cell_of({1 + 0.5f * 4.5f, 2 + 0.5f * 9.5f, 3 + 0.5f * 100.5f}, 5);
    REQUIRE(cell);
    CHECK(cell->x == 4);
    CHECK(cell->y == 9);
    CHECK(cell->z == 100);
    CHECK(cell->way == 5);
    CHECK(cell->in_brick() == (0u | 1u << 2 | 0u << 4));
    // Out of the cells along any one axis: nowhere.
    const Vec3 inside = cells.corner + Vec3{5};
    REQUIRE(cells.cell_of(inside, 0));
    for (int axis = 0; axis < 3; ++axis)
        for (const float bad : {0.5f * 3.9f, -100.0f, 0.5f * float(detail::most_cells),
                                std::numeric_limits<float>::quiet_NaN(),
                                std::numeric_limits<float>::infinity()}) {
            Vec3 point = inside;
            point[axis] = cells.corner[axis] + bad;
            CHECK_FALSE(cells.cell_of(point, 0));
        }
    // A key is a brick and a way, and back; bricks are numbered as they come.
    auto stream = random_stream(test_seed(3), Pass::user, 0, 0);
    const auto some = [&] {
        return int(next_1d<float>(stream) * float(detail::most_cells));
    };
    BrickTable table;
    CHECK(table.find(detail::brick_key({4, 4, 4, 0})) == BrickTable::none);
    std::vector<std::uint64_t> keys;
    for (int i = 0; i < 3000; ++i) {
        const detail::VerdictCell at{some(), some(), some(), i % 6};
        const std::uint64_t key = detail::brick_key(at);
        const auto first = detail::first_cell(key);
        REQUIRE(first.x == at.x / 4 * 4);
        REQUIRE(first.y == at.y / 4 * 4);
        REQUIRE(first.z == at.z / 4 * 4);
        REQUIRE(first.way == at.way);
        REQUIRE(detail::brick_key(first) == key);
        REQUIRE(key != 0);
        REQUIRE(table.find(key) == BrickTable::none);
        REQUIRE(table.insert(key) == std::uint32_t(i));
        REQUIRE(table.insert(key) == std::uint32_t(i));
        keys.push_back(key);
    }
    CHECK(table.size() == 3000);
    CHECK(table.keys() == keys);
    for (std::uint32_t i = 0; i < 3000; ++i) REQUIRE(table.find(keys[i]) == i);
    // At most half full: 8192 places of 16 bytes, and a key for each brick.
    CHECK(table.bytes() == 8192 * 16 + 3000 * 8);
    VerdictGrid grid;
    grid.known.table = table;
    grid.known.bits.resize(7);
    CHECK(grid.bytes() == table.bytes() + 56);
}

TEST_CASE("shadow photons: the cells' length is that of enough photons in nine cells") {
    // One photon in the middle of each of 32 x 32 squares of side 1.
    std::vector<Photon> photons;
    BoxT<float> box;
    for (int i = 0; i < 32; ++i)
        for (int k = 0; k < 32; ++k) {
            photons.push_back(on_floor(float(i), float(k), PhotonKind::direct));
            box = box_union(box, photons.back().position);
        }
    const auto length = [&](const SkipSettings& skip, std::size_t lights = 1) {
        return double(detail::cell_length(photons, box, lights, skip));
    };
    // Each is in a cell of 31/32 of its own: 9 cells of length l hold 9 l^2 of them per
    // (31/32)^2.
    const double one = 31.0 / 32;
    CHECK(length(enough) == doctest::Approx(one * std::sqrt(59 / 9.0)).epsilon(1e-4));
    CHECK(length(any) == doctest::Approx(one * std::sqrt(20 / 9.0)).epsilon(1e-4));
    CHECK(length(any, 4) ==
          doctest::Approx(2 * one * std::sqrt(20 / 9.0)).epsilon(1e-4));
    SkipSettings given = any;
    given.radius = 0.75f;
    CHECK(length(given) == 0.75);
    given.radius = 1e-20f; // no more cells than there are numbers for
    CHECK(length(given) == doctest::Approx(31.0 / (detail::most_cells / 2)));
    // Four in each place make it half as long; those that say nothing do not count.
    const auto once = photons;
    for (const Photon& photon : once) {
        for (int i = 0; i < 3; ++i) photons.push_back(photon);
        photons.push_back(photon);
        photons.back().kind = PhotonKind::caustic;
        photons.push_back(photon);
        photons.back().kind = PhotonKind::indirect;
        photons.push_back(photon);
        photons.back().light = 7;
        photons.push_back(photon);
        photons.back().normal = detail::SmallNormal{0};
    }
    CHECK(length(any) == doctest::Approx(one * std::sqrt(5 / 9.0)).epsilon(1e-4));
    given = {.rule = SkipRule::any, .indirect_rays = true};
    CHECK(length(given) == doctest::Approx(one * std::sqrt(4 / 9.0)).epsilon(1e-4));
    given.rule = SkipRule::none; // indirect ones alone
    CHECK(length(given) == doctest::Approx(one * std::sqrt(20 / 9.0)).epsilon(1e-4));
}

TEST_CASE("shadow photons: verdicts in a ball, by side, light and kind") {
    using detail::judge;
    CHECK(judge({1, 1200}, SkipRule::report, 50) == Verdict::unknown);
    CHECK(judge({2, 1300}, SkipRule::report, 50) == Verdict::unknown);
    CHECK(judge({1300, 2}, SkipRule::report, 50) == Verdict::unknown);
    std::vector<Photon> photons;
    const auto add = [&](int count, PhotonKind kind, std::uint16_t light, bool below) {
        for (int i = 0; i < count; ++i) {
            photons.push_back(on_floor(0.01f * float(i % 10), 0, kind, light));
            if (below) photons.back().direction.y = 1;
        }
    };
    add(60, PhotonKind::direct, 0, false);
    add(60, PhotonKind::shadow, 0, true);
    add(60, PhotonKind::shadow, 1, false);
    add(60, PhotonKind::indirect, 2, false);
    add(60, PhotonKind::caustic, 3, false);
    const PhotonMap map = make_photon_map(photons);
    const auto verdict = [&](std::size_t light, int side,
                             SkipRule rule = SkipRule::enough, float radius = 1) {
        return verdict_at(map, floor_point(0, 0), side, light, radius, {.rule = rule});
    };
    CHECK(verdict(0, 1) == Verdict::lit);
    CHECK(verdict(0, -1) == Verdict::shadow);
    CHECK(verdict(1, 1) == Verdict::shadow);
    CHECK(verdict(1, -1) == Verdict::unknown);
    CHECK(verdict(2, 1) == Verdict::unknown);
    CHECK(verdict(3, 1) == Verdict::unknown);
    CHECK(verdict(0, 1, SkipRule::enough, 0.025f) == Verdict::unknown); // 18 of them
    CHECK(verdict(0, 1, SkipRule::any, 0.025f) == Verdict::lit);
    CHECK(verdict(0, 1, SkipRule::report) == Verdict::unknown); // all lights together
    CHECK(verdict(0, -1, SkipRule::report) == Verdict::shadow);
    CHECK(verdict(0, 1, SkipRule::none) == Verdict::unknown);
    SurfacePoint wall = floor_point(0, 0);
    wall.normal = {1, 0, 0};
    CHECK(verdict_at(map, wall, 1, 0, 1.0f, enough) == Verdict::unknown);
}

TEST_CASE("shadow photons: what a fine cell knows is not changed by a coarse one") {
    const detail::VerdictCell first{.x = 8, .y = 8, .z = 8, .way = 2};
    for (const int times : {2, 4})
        for (const bool lit : {false, true}) {
            // Cell 0 is lit, cell 1 in shadow, of the others nothing is known.
            detail::VerdictBitsT<float> fine{.lights = 1}, coarse{.lights = 1};
            (void)fine.table.insert(brick_key(first));
            fine.bits = {1, 2, 0};
            const std::int32_t at = 8 / times;
            (void)coarse.table.insert(detail::brick_key({at, at, at, 2}));
            const std::uint64_t all = ~std::uint64_t{0};
            coarse.bits = {lit ? all : 0, lit ? 0 : all, 0};
            detail::fill_from(fine, coarse, times);
            CHECK(fine.bits[0] == (lit ? all - 2 : 1));
            CHECK(fine.bits[1] == (lit ? 2 : all - 1));
        }
}

TEST_CASE(
    "shadow photons: a wall lies in the middle of its cells, not on their border") {
    const auto photons = photons_of(half_plane(), 20000);
    Vec3 low = photons[0].position;
    for (const Photon& photon : photons) low = glm::min(low, photon.position);
    const VerdictGrid grid =
        make_verdict_grid(photons, 1, {.rule = SkipRule::enough}, 1);
    const auto& cells = grid.known.cells;
    REQUIRE(cells.length > 0);
    for (int axis = 0; axis < 3; ++axis) {
        const float place = (low[axis] - cells.corner[axis]) / cells.length;
        CHECK(place - std::floor(place) == doctest::Approx(0.5).epsilon(0.01));
    }
}

TEST_CASE(
    "shadow photons: one indirect photon is enough, whatever the shadow rays ask") {
    for (const SkipRule rule :
         {SkipRule::none, SkipRule::report, SkipRule::any, SkipRule::enough}) {
        CAPTURE(int(rule));
        const std::vector<Photon> photons{on_floor(0, 0, PhotonKind::indirect),
                                          on_floor(9, 0, PhotonKind::direct)};
        const VerdictGrid grid = make_verdict_grid(
            photons, 1, {.rule = rule, .indirect_rays = true, .radius = 0.5f});
        CHECK(grid.indirect_near(grid.cell_of(floor_point(0, 0), 1)));
        CHECK(grid.indirect_near(grid.cell_of(floor_point(0.4f, 0), 1)));
        CHECK_FALSE(grid.indirect_near(grid.cell_of(floor_point(9, 0), 1)));
        CHECK_FALSE(grid.indirect_near(grid.cell_of(floor_point(0, 0), -1)));
    }
}

TEST_CASE("shadow photons: too many bricks are refused before they take any memory") {
    // Each photon lies in the first cell of a brick, and is near to eight.
    std::vector<Photon> photons;
    for (int i = 0; i < 65 * 64 * 64; ++i) {
        Photon photon =
            on_floor(float(i % 64) * 8, float(i / 64 % 64) * 8, PhotonKind::indirect);
        photon.position.y = float(i / 64 / 64) * 8;
        photons.push_back(photon);
    }
    CHECK(refusal([&] {
              (void)make_verdict_grid(photons, 1, {.indirect_rays = true, .radius = 1});
          }) == "the number of bricks in a verdict grid is 2129920; it must be at most "
                "2097152: a larger skip.radius makes fewer.");
}
