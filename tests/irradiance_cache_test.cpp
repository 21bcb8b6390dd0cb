// The statistical cases were run with 20 further seeds: none failed. For others:
// `./scripts/test --seeds 20`.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ljus/materials/glossy.hpp"
#include "ljus/math/stratified_stream.hpp"
#include "ljus/render/gathering.hpp"
#include "ljus/render/path_tracing.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"
#include "support/rooms.hpp"
#include "support/student.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

/// A cache of given records.
IrradianceCache cache_of(const std::vector<Vec3>& places,
                         const std::vector<GatheredT<float>>& records) {
    IrradianceCache cache;
    cache.tree = KdTree8(places);
    for (const std::uint32_t i : cache.tree.point_ids())
        cache.records.push_back(records[i]);
    return cache;
}

constexpr Vec3 up{0, 0, 1};

PhotonMappingSettings cached(std::uint64_t seed) {
    PhotonMappingSettings settings = preset_settings(Preset::fast, 100, 100);
    settings.general.seed = settings.caustics.seed = seed;
    settings.general.threads = settings.caustics.threads = 1;
    return settings;
}

} // namespace

TEST_CASE("irradiance cache: the mean by distance, within the reach of each point") {
    // Three points on a line; the nearest says how far is around.
    const GatheredT<float> a{Rgb{1}, up, 10, 1}, b{Rgb{2}, up, 10, 1},
        far{Rgb{100}, up, 0.2f, 1};
    const auto cache = cache_of({{0, 0, 0}, {1, 0, 0}, {0.5f, 0.5f, 0}}, {a, b, far});
    const auto at = [&](float x, float reach = 1) {
        const auto found = interpolate(cache, Vec3{x, 0, 0}, up, reach);
        REQUIRE(found);
        return double(found->x);
    };
    CHECK(at(0) == 1);                       // b lies at the border: 0
    CHECK(at(0.5f) == doctest::Approx(1.5)); // the third does not reach
    CHECK(at(0.25f) == doctest::Approx((0.9375 + 2 * 0.4375) / 1.375));
    CHECK(at(0.5f, 10) > 30);                                       // now it does
    CHECK(!interpolate(cache, Vec3{0, 0, 5}, up, 1.0f));            // too far from all
    CHECK(!interpolate(cache, Vec3{0, 0, 0}, Vec3{1, 0, 0}, 1.0f)); // unlike normals
    CHECK(!interpolate(cache, Vec3{0, 0, 0}, -up, 1.0f));
    CHECK(!interpolate(IrradianceCache{}, Vec3{0}, up, 1.0f));
    // All points in one place say nothing of how far they count.
    const GatheredT<float> same{Rgb{1}, up, 10, 0};
    CHECK(!interpolate(cache_of({Vec3{0}, Vec3{0}}, {same, same}), Vec3{0}, up, 1.0f));
    CHECK(!interpolate(cache, Vec3{std::nanf("")}, up, 1.0f));
}

TEST_CASE("irradiance cache: a point counts as far as its nearest like ones lie") {
    // On a line at 0, 1, 3 and 7, itself counted among the nearest; what faces another
    // way is not asked.
    const GatheredT<float> one{.irradiance = Rgb{1}, .normal = up, .distance = 10};
    GatheredT<float> leaning = one, other = one;
    leaning.normal = glm::normalize(Vec3{0.3f, 0, 1}); // cosine 0.958: still like
    other.normal = glm::normalize(Vec3{0.4f, 0, 1});   // 0.928
    const std::vector<Vec3> places{{0, 0, 0}, {1, 0, 0},    {3, 0, 0},
                                   {7, 0, 0}, {0.1f, 0, 0}, {2.9f, 0, 0}};
    const auto spacings = [&](std::size_t nearest, int threads) {
        auto cache = cache_of(places, {one, one, leaning, one, other, other});
        detail::measure_spacing(cache, {.nearest = nearest}, threads);
        std::vector<float> found(places.size());
        for (std::size_t i = 0; i < places.size(); ++i)
            for (std::size_t k = 0; k < places.size(); ++k)
                if (cache.tree.point(i) == places[k])
                    found[k] = cache.records[i].spacing;
        return found;
    };
    for (const int threads : {1, 3}) {
        const auto third = spacings(3, threads);
        const std::vector<float> right{3, 2, 2, 6}; // 2.9 is like the leaning one
        for (std::size_t k = 0; k < right.size(); ++k)
            CHECK(third[k] == doctest::Approx(right[k]));
        const auto second = spacings(2, threads);
        const std::vector<float> close{1, 1, 0.1f, 4};
        for (std::size_t k = 0; k < close.size(); ++k)
            CHECK(second[k] == doctest::Approx(close[k]));
        // Fewer than asked for: as far as the farthest.
        CHECK(spacings(60, threads)[0] == doctest::Approx(7));
        // The two that face elsewhere: the leaning one is like them, too (0.995).
        CHECK(second[4] == doctest::Approx(2.8f));
        CHECK(second[5] == doctest::Approx(0.1f));
    }
    auto alone = cache_of({Vec3{0}}, {one});
    detail::measure_spacing(alone, {}, 1);
    CHECK(alone.records[0].spacing == 0); // it says nothing of how far it counts
}

TEST_CASE("irradiance cache: what one ray has found is spread over near points") {
    // 100 points on a floor and 100 on a wall through its middle, which know 1. At one
    // point of the floor, one ray has found `more` beside that.
    const auto spread = [](float more, float distance, int rays = 25) {
        std::vector<Vec3> places;
        std::vector<GatheredT<float>> records;
        for (int i = 0; i < 200; ++i) {
            const float x = float(i % 10), y = float(i / 10 % 10);
            const bool wall = i >= 100;
            places.push_back(wall ? Vec3{4.5f, x, y - 4.5f} : Vec3{x, y, 0});
            records.push_back({.irradiance = Rgb{1},
                               .normal = wall ? Vec3{1, 0, 0} : up,
                               .distance = 100,
                               .brightest = Rgb{0.1f}});
        }
        records[44].irradiance += Rgb{more, 0, more};
        records[44].brightest = Rgb{more, 0, more};
        records[44].distance = distance;
        std::vector<Rgb> found(200);
        for (int times = 0; times < 2; ++times) { // the second time, nothing is spread
            const auto cache =
                make_irradiance_cache(places, records, {.rays = rays}, 1);
            for (std::size_t i = 0; i < 200; ++i) {
                const std::uint32_t id = cache.tree.point_ids()[i];
                records[id] = cache.records[i];
                found[id] = records[id].irradiance;
            }
        }
        return found;
    };
    const auto changed = [](const std::vector<Rgb>& found, float value) {
        int count = 0;
        for (std::size_t i = 0; i < 200; ++i) {
            CHECK(found[i].y == 1);
            if (found[i].x == 1) continue;
            ++count;
            CHECK(i < 100); // the wall has another normal
            CHECK(found[i].x == doctest::Approx(value));
            CHECK(found[i].z == found[i].x);
        }
        return count;
    };
    CHECK(changed(spread(32, 100), 1.5f) == 64);
    // Within a distance of 1.1 there are the point and four neighbours.
    const auto near = spread(10, 1.1f);
    for (const std::size_t i : {34u, 43u, 44u, 45u, 54u})
        CHECK(near[i].x == doctest::Approx(3));
    CHECK(near[33].x == 1);
    // A sixth and less is no exception, and alone there is nobody to share with.
    CHECK(spread(0.19f, 100)[44].x == doctest::Approx(1.19f));
    CHECK(spread(0.21f, 100)[44].x < 1.01f);
    CHECK(spread(10, 0.5f)[44].x == 11);
    // Of few rays each carries much.
    CHECK(spread(2, 100, 6)[44].x == 3);
    CHECK(spread(2.1f, 100, 6)[44].x < 1.1f);
}

namespace {

using Hall = Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Mirror, Glass, Glossy>>;

/// A floor at z = 0 under a ceiling, each point of which sends E / (2 pi).
Hall hall(bool glass = false) {
    Hall scene;
    scene.add(Quad{.corner{-50, -50, 0}, .edge_u{100, 0, 0}, .edge_v{0, 100, 0}},
              scene.add(Lambertian{}));
    scene.add(Quad{.corner{-50, -50, 4}, .edge_u{0, 100, 0}, .edge_v{100, 0, 0}},
              scene.add(Lambertian{.albedo = Rgb{0.5f}}));
    if (glass)
        scene.add(Quad{.corner{-50, -50, 1}, .edge_u{100, 0, 0}, .edge_v{0, 100, 0}},
                  scene.add(Glass{}));
    return scene;
}

/// Points that know an irradiance above and below, wherever.
IrradiancePoints known(const Rgb& irradiance) {
    IrradiancePoints points;
    const std::vector<Vec3> normals{up, -up};
    points.tree = KdTree8(std::vector<Vec3>(2, Vec3{0}));
    for (const std::uint32_t i : points.tree.point_ids())
        points.records.push_back({irradiance, normals[i]});
    points.radius = 1000;
    return points;
}

} // namespace

TEST_CASE("irradiance cache: what is known is taken, what is not is gathered") {
    const World scene(hall());
    const IrradiancePoints points = known(Rgb{2});
    const Ray ray{.origin{0, 0, 1}, .direction{0, 0, -1}};
    const Vertex vertex = vertex_at(scene, ray, *closest_hit(scene, ray));
    auto cache = cache_of({{0.5f, 0, 0}, {-0.5f, 0, 0}},
                          {{Rgb{1}, up, 0.6f, 1}, {Rgb{3}, up, 0.6f, 1}});
    const auto find = [&](float reach, Counts& counts) {
        auto stream = random_stream(1, Pass::user, 0, 0);
        auto context = context_of(stream, counts);
        return irradiance_between(scene, points, cache, vertex, Lambertian{},
                                  {.rays = 9, .reach = reach}, context)
            .x;
    };
    Counts counts;
    CHECK(find(1, counts) == doctest::Approx(2));
    CHECK(counts.map_queries == 1);
    CHECK(counts.bounce_rays == 0);
    CHECK(find(0.8f, counts) == doctest::Approx(1)); // neither reaches: 0.5 times 2
    CHECK(counts.bounce_rays == 3); // a quarter of 9, rounded up
    CHECK(counts.map_queries == 5);
    // From below it is the points of that side that answer.
    const Ray from_below{.origin{0, 0, -1}, .direction{0, 0, 1}};
    const Vertex other_side =
        vertex_at(scene, from_below, *closest_hit(scene, from_below));
    cache = cache_of({{0, 0, 0}, {0, 0, 0}}, {{Rgb{1}, up, 9, 1}, {Rgb{3}, -up, 9, 1}});
    auto stream = random_stream(1, Pass::user, 0, 0);
    auto context = context_of(stream, counts);
    counts = {};
    CHECK(irradiance_between(scene, points, cache, other_side, Lambertian{},
                             GatherSettings{}, context)
              .x == 3);
    CHECK(counts.bounce_rays == 0);
}

TEST_CASE("irradiance cache: points where a camera ray meets something matt") {
    const IrradiancePoints points = known(Rgb{2});
    const auto gathered = [&](const World<Hall>& scene, const Ray& ray,
                              const GatherSettings& how) {
        auto stream = random_stream(1, Pass::user, 0, 0);
        detail::GatheredRowT<float> row;
        detail::gather_along(scene, points, ray, how, stream, row);
        REQUIRE(row.positions.size() == row.records.size());
        return row;
    };
    const Ray down{.origin{0, 0, 3}, .direction{0, 0, -1}};
    const auto floor = gathered(World(hall()), down, {.rays = 7});
    REQUIRE(floor.positions.size() == 1);
    CHECK(glm::length(floor.positions[0]) < 1e-5f);
    CHECK(floor.records[0].normal == up);
    CHECK(floor.records[0].irradiance.x == doctest::Approx(1).epsilon(0.02));
    CHECK(floor.counts.bounce_rays == 7);
    // Half of the rays find a darker ceiling, on one side or the other: the brightest of
    // 16 does not.
    for (const float from : {-40.0f, 0.0f}) {
        Hall two = hall();
        two.add(Quad{.corner{from, -40, 2}, .edge_u{0, 80, 0}, .edge_v{40, 0, 0}},
                two.add(Lambertian{.albedo = Rgb{0.1f}}));
        const Ray ray{.origin{0, 0, 1}, .direction{0, 0, -1}};
        const auto row = gathered(World(two), ray, {.rays = 16});
        CHECK(row.records[0].brightest.x == doctest::Approx(1.0 / 16).epsilon(0.001));
    }
    // By mirrors that are bright enough, and no farther than the depth.
    for (const float bright : {1.0f, 0.02f, 0.005f}) {
        Hall scene = hall();
        scene.add(Quad{.corner{-1, -1, 1}, .edge_u{2, 0, 0}, .edge_v{0, 2, 0}},
                  scene.add(Mirror{.reflectance = Rgb{bright}}));
        const World world(std::move(scene));
        const auto up_there = gathered(world, down, {.rays = 3});
        CHECK(up_there.positions.size() == (bright > 0.01f ? 1 : 0));
        if (bright == 1) CHECK(up_there.positions[0].z == doctest::Approx(4));
        CHECK(gathered(world, down, {.rays = 3, .max_depth = 2}).positions.size() ==
              (bright > 0.01f ? 1 : 0));
        CHECK(gathered(world, down, {.rays = 3, .max_depth = 1}).positions.empty());
    }
    // At glass both ways: through it to the floor, and back to the ceiling.
    const auto both = gathered(World(hall(true)), down, {.rays = 3});
    int below = 0, above = 0;
    for (const Vec3& p : both.positions) (p.z < 2 ? below : above) += 1;
    CHECK(below == 1);
    CHECK(above == 1);
    // Gloss is not gathered: its light comes by rays.
    Hall shiny;
    shiny.add(Quad{.corner{-9, -9, 0}, .edge_u{18, 0, 0}, .edge_v{0, 18, 0}},
              shiny.add(Glossy{}));
    CHECK(gathered(World(shiny), down, {}).positions.empty());
    // Of many slabs only as many paths as are rendered, eight; at 80
    // degrees both ways are strong.
    Hall panes = hall();
    const auto glass = panes.add(Glass{.index = 1.5f});
    for (int i = 0; i < 12; ++i) {
        const Vec3 x{1000, 0, 0}, y{0, 1000, 0};
        panes.add(Quad{.corner{-500, -500, 1 + 0.1f * float(i)},
                       .edge_u = i % 2 == 0 ? y : x,
                       .edge_v = i % 2 == 0 ? x : y},
                  glass);
    }
    const World many(std::move(panes));
    for (int i = 0; i < 8; ++i) {
        const Ray slanted{.origin{0, 0, 3},
                          .direction = glm::normalize(Vec3{5.7f, 0.1f * float(i), -1})};
        const std::size_t ways = gathered(many, slanted, {.rays = 1}).positions.size();
        CHECK(ways <= 8);
        CHECK(ways >= 5); // without those that are too faint
    }
}

TEST_CASE("irradiance cache: a point in each square of pixels") {
    const World scene(hall());
    const IrradiancePoints points = known(Rgb{2});
    const Camera camera = look_at({.position{0, 0, 3}, .target{0, 0, 0}, .up{0, 1, 0}});
    double aside = 0, squares = 0;
    for (const int tile : {1, 3, 4})
        for (const int threads : {1, 3}) {
            const RenderSettings picture{
                .width = 10, .height = 7, .seed = test_seed(3), .threads = threads};
            const auto cache =
                make_irradiance_cache(scene, points, camera, picture,
                                      {.rays = 5, .tile = tile, .nearest = 4});
            const int columns = (9 + tile) / tile, rows = (6 + tile) / tile;
            REQUIRE(cache.records.size() == std::size_t(columns * rows));
            CHECK(cache.complete);
            CHECK_FALSE(cache.empty());
            CHECK(cache.counts.bounce_rays == std::uint64_t(5 * columns * rows));
            std::vector<int> seen(std::size_t(columns * rows));
            for (std::size_t i = 0; i < cache.records.size(); ++i) {
                const auto pixel = project(camera, cache.tree.point(i), 10, 7);
                REQUIRE(pixel);
                const int x = int(pixel->x) / tile, y = int(pixel->y) / tile;
                ++seen[std::size_t(y * columns + x)];
                aside += double(pixel->x / float(tile)) - x;
                squares += 1;
                CHECK(cache.records[i].spacing > 0);
                CHECK(cache.records[i].irradiance.x == doctest::Approx(1).epsilon(0.2));
            }
            for (const int count : seen) CHECK(count == 1);
        }
    // Not at their corners: 88 numbers, each twice, whose mean scatters by 0.03.
    CHECK(aside / squares > 0.3);
    CHECK(aside / squares < 0.7);
    // Stopped, it says so.
    const auto stop = [](long long, long long) { return false; };
    RenderSettings picture{.width = 10, .height = 30, .threads = 1};
    picture.progress = stop;
    CHECK_FALSE(make_irradiance_cache(scene, points, camera, picture, {}).complete);
    for (const GatherSettings& bad :
         {GatherSettings{.rays = 0}, GatherSettings{.tile = 0},
          GatherSettings{.nearest = 65}, GatherSettings{.nearest = 1}})
        CHECK(ljus_test::refusal([&] {
                  (void)make_irradiance_cache(scene, points, camera, picture, bad);
              }).starts_with("gather."));
}

TEST_CASE("irradiance cache: each square has numbers of its own, with each seed") {
    // Where in its square a point stands: of 3 x 12 places in the unit square two are
    // as near as that once in 50 000 runs.
    const World scene(hall());
    const Camera camera = look_at({.position{0, 0, 3}, .target{0, 0, 0}, .up{0, 1, 0}});
    std::vector<glm::dvec2> places;
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const auto cache = make_irradiance_cache(
            scene, known(Rgb{2}), camera,
            {.width = 40, .height = 30, .seed = test_seed(seed), .threads = 1},
            {.rays = 1, .tile = 10});
        REQUIRE(cache.records.size() == 12);
        for (std::size_t i = 0; i < 12; ++i) {
            const auto pixel = project(camera, cache.tree.point(i), 40, 30);
            REQUIRE(pixel);
            const glm::dvec2 at = glm::dvec2(*pixel) / 10.0;
            places.push_back(at - glm::floor(at));
        }
    }
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            CHECK(glm::distance(places[i], places[k]) > 1e-4);
}

TEST_CASE("irradiance cache: each point has what was gathered there") {
    // A floor and a wall that stand in view: the normal tells which, and 1 / distance
    // is the mean of those of all rays, which are longer the farther the ceiling is.
    Hall scene = hall();
    scene.add(Quad{.corner{1, -50, 0}, .edge_u{0, 0, 4}, .edge_v{0, 100, 0}},
              scene.add(Lambertian{}));
    const World world(std::move(scene));
    const Camera camera = look_at(
        {.position{-1, 0, 3}, .target{1, 0, 0}, .up{0, 1, 0}, .vfov_degrees = 60});
    const auto cache = make_irradiance_cache(world, known(Rgb{2}), camera,
                                             {.width = 40, .height = 40, .threads = 2},
                                             {.rays = 4, .tile = 2});
    REQUIRE(cache.records.size() == 400);
    int on_floor = 0;
    for (std::size_t i = 0; i < 400; ++i) {
        const Vec3 place = cache.tree.point(i);
        const bool floor = std::abs(place.z) < 1e-4f;
        on_floor += floor;
        CHECK((floor || std::abs(place.x - 1) < 1e-4f));
        CHECK(cache.records[i].normal == (floor ? up : Vec3{-1, 0, 0}));
    }
    CHECK(on_floor > 50);
    CHECK(on_floor < 350);
}

TEST_CASE("irradiance cache: it equals path tracing, block by block") {
    // Balls of each kind under a lamp. Blocks of 10 x 10 pixels, 12 seeds against 24 of
    // the path tracer; what is allowed beside chance is the bias of radius and
    // interpolation: 4 % of a block and 1 % of the picture. One of the 144 blocks or
    // the 4 pictures is a false alarm in 60 000 runs.
    constexpr int size = 60, blocks = 36;
    const Camera camera = room_camera<float>();
    for (const Ball ball :
         {Ball::lambertian, Ball::oren_nayar, Ball::mirror, Ball::glass}) {
        const ClosedRoom room = make_room<float>(ball, Lamp::quad, 1);
        std::vector<Mean> mapped(blocks), traced(blocks);
        Mean all_mapped, all_traced;
        const auto add = [&](const Image& image, std::vector<Mean>& means, Mean& all) {
            std::vector<double> sum(blocks);
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    const Rgb p = pixel(image, x, y);
                    sum[std::size_t(y / 10 * 6 + x / 10)] +=
                        double(p.x + p.y + p.z) / 300;
                }
            double total = 0;
            for (std::size_t i = 0; i < blocks; ++i) means[i].add(sum[i]);
            for (const double s : sum) total += s / blocks;
            all.add(total);
        };
        for (std::uint64_t run = 1; run <= 24; ++run) {
            RenderSettings picture{.width = size,
                                   .height = size,
                                   .samples = 6,
                                   .seed = test_seed(run),
                                   .threads = 1};
            add(render(PathTracer(room), camera, picture).image, traced, all_traced);
            if (run > 12) continue;
            picture.samples = 2; // the path tracer's noise is larger
            const auto settings = cached(picture.seed);
            PhotonMapper mapper(room, settings, abilities<Gathering, StratifiedStream>);
            mapper.fill_cache(camera, picture);
            CHECK(mapper.state<Gathering>().cache.records.size() > 100);
            add(render(mapper, camera, picture).image, mapped, all_mapped);
        }
        CAPTURE(int(ball));
        double squared = 0;
        CHECK(chance_of(all_mapped, all_traced, 0.01 * all_traced.mean) > 1e-7);
        for (std::size_t i = 0; i < blocks; ++i) {
            CAPTURE(i);
            const double right = traced[i].mean;
            const double error = std::hypot(mapped[i].error(), traced[i].error());
            squared += error * error / (right * right) / blocks;
            CHECK(chance_of(mapped[i], traced[i], 0.04 * right) > 1e-7);
        }
        CHECK(squared < 0.02 * 0.02); // it is a comparison
    }
}

TEST_CASE("irradiance cache: surfaces seen from inside, and turned inside out") {
    // A room within a sphere that is lit from its middle: its shape's normals point
    // outwards, those of the surface inwards. Everywhere the same light comes.
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<PointLight>> scene;
    const auto wall = scene.add(Lambertian{.albedo = Rgb{0.5f}});
    scene.add(Sphere{}, wall);
    scene.add(PointLight{.intensity = Rgb{1}});
    const Camera camera = look_at(View{.position{0.3f, 0, 0}, .target{1, 0.1f, 0}});
    const RenderSettings picture{.width = 30, .height = 30, .samples = 4, .threads = 1};
    const World world(std::move(scene));
    PhotonMapper mapper(world, cached(1), abilities<Gathering>);
    mapper.fill_cache(camera, picture);
    const auto image = render(mapper, camera, picture).image;
    Mean mean;
    for (const Rgb& p : image.pixels) mean.add(double(p.x));
    // E = 1 straight from the light; radiance 0.5/pi of it, over 1 - 0.5.
    CHECK(mean.mean == doctest::Approx(1 / 3.14159265).epsilon(0.015));
}

TEST_CASE("irradiance cache: the same bytes for any number of threads") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::sphere, 2);
    const Camera camera = room_camera<float>();
    std::vector<Image> images;
    for (const int threads : {1, 3}) {
        auto settings = cached(5);
        settings.general.threads = settings.caustics.threads = threads;
        const RenderSettings picture{
            .width = 31, .height = 17, .samples = 2, .threads = threads};
        PhotonMapper mapper(room, settings, abilities<Gathering, StratifiedStream>);
        mapper.fill_cache(camera, picture);
        images.push_back(render(mapper, camera, picture).image);
    }
    CHECK(images[0].pixels == images[1].pixels);
}

TEST_CASE("irradiance cache: no photons, no light, no points") {
    // Without photons there is direct light only, and no NaN.
    const ClosedRoom room = make_room<float>(Ball::lambertian, Lamp::quad, 1);
    const Camera camera = room_camera<float>();
    const RenderSettings picture{.width = 20, .height = 20, .samples = 2, .threads = 1};
    const auto image = [&](auto change) {
        auto settings = cached(1);
        change(settings);
        PhotonMapper mapper(room, settings, abilities<Gathering>);
        mapper.fill_cache(camera, picture);
        return render(mapper, camera, picture);
    };
    const auto none = image([](auto& s) { s.general.photons = 0; });
    const auto direct = image([](auto& s) { s.indirect = IndirectLight::none; });
    CHECK(none.counts.rejected == 0);
    for (std::size_t i = 0; i < none.image.pixels.size(); ++i)
        CHECK(none.image.pixels[i].x ==
              doctest::Approx(direct.image.pixels[i].x).epsilon(1e-5));
    // One photon, and a tile larger than the picture.
    const auto one = image([](auto& s) {
        s.general.photons = 1;
        s.gather.tile = 100;
    });
    CHECK(one.counts.rejected == 0);
    for (const Rgb& p : one.image.pixels) CHECK(is_finite(p));
}
