#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "ljus/inspect/explain.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/scenes/cornell_box.hpp"

using namespace ljus;

namespace {

constexpr RenderSettings picture{
    .width = 12, .height = 12, .samples = 8, .seed = 3, .threads = 1};

// Pixels of the box's walls, balls and lamp.
constexpr std::pair<int, int> places[] = {{0, 0}, {6, 1},  {3, 9},
                                          {8, 9}, {8, 11}, {6, 6}};

/// \param last  Whether the renderer adds some terms last when many rays are rendered
///              together: then the last bits differ.
template <typename Renderer>
void check_sums(const Renderer& renderer, const Camera& camera, bool last = false) {
    const auto rendered = render(renderer, camera, picture);
    for (const auto& place : places) {
        const int x = place.first;
        const int y = place.second;
        CAPTURE(x);
        CAPTURE(y);
        const auto apart = detail::take_apart(renderer, camera, picture, x, y);
        const Rgb& expected = pixel(rendered.image, x, y);
#ifdef __FMA__
        last = true; // the compiler may fuse other products and sums with a log
#endif
        if (last)
            CHECK(glm::distance(apart.radiance, expected) <=
                  1e-5f * glm::length(expected));
        else
            CHECK(apart.radiance == expected);
        CHECK(apart.rejected == 0);
        glm::dvec3 sum{0};
        for (const detail::PathSum& part : apart.sums) sum += part.value;
        for (int channel = 0; channel < 3; ++channel)
            CHECK(sum[channel] ==
                  doctest::Approx(double(apart.radiance[channel])).epsilon(1e-5));
    }
}

// A renderer of which every other ray is NaN.
struct HalfNan {
    using Stream = RandomStream;
};

[[maybe_unused]] Rgb radiance(const HalfNan&, const Ray&, auto& context) {
    context.log.begin();
    const bool bad = context.counts.camera_rays % 2 == 0;
    const Rgb value{bad ? std::numeric_limits<float>::quiet_NaN() : 3.0f};
    context.log.term("emission", "L", value);
    return value;
}

// A renderer with three owners, each of one colour.
struct Colors {
    using Stream = RandomStream;
};

[[maybe_unused]] Rgb radiance(const Colors&, const Ray&, auto& context) {
    context.log.begin();
    context.log.term("red", "L", Rgb{2, 0, 0});
    context.log.term("green", "DL", Rgb{1, 5, 0});
    context.log.term("blue", "SL", Rgb{0, 0, 3});
    return {3, 5, 3};
}

} // namespace

TEST_CASE("explain: the largest sum is first, in whichever channel") {
    const Camera camera = look_at({.position{0, 0, 0}, .target{0, 0, -1}});
    const auto apart = detail::take_apart(
        Colors{}, camera, {.width = 3, .height = 2, .samples = 4}, 2, 1);
    REQUIRE(apart.sums.size() == 3);
    CHECK(apart.sums[0].owner == "green");
    CHECK(apart.sums[1].owner == "blue");
    CHECK(apart.sums[2].owner == "red");
    CHECK(apart.sums[0].value == glm::dvec3{1, 5, 0});
    CHECK(apart.radiance == Rgb{3, 5, 3});
    CHECK(apart.samples == 4);
    // At most four rays are kept, and sixteen sums are shown.
    for (const int samples : {2, 4, 9})
        CHECK(detail::take_apart(Colors{}, camera,
                                 {.width = 3, .height = 2, .samples = samples}, 2, 1)
                  .first_rays.size() == std::size_t(std::min(samples, 4)));
    ExplainedPixelT<float> many{.samples = 1};
    for (int i = 0; i < 18; ++i) many.sums.push_back({"EL", "emission", {}, 1});
    CHECK(detail::describe(many).find("  2 more ") != std::string::npos);
}

TEST_CASE("explain: each term counts as much as the filter says") {
    // The rays of a pixel have weights, with Mitchell's filter of both signs: the sums
    // are those of the pixel only if each term has its ray's.
    const auto room = cornell_box();
    const PathTracer tracer(room.world);
    for (const Filter filter : {Filter::gaussian, Filter::mitchell}) {
        RenderSettings filtered = picture;
        filtered.filter = filter;
        for (const auto& [x, y] : {std::pair{3, 9}, {6, 6}}) {
            const auto apart = detail::take_apart(tracer, room.camera, filtered, x, y);
            glm::dvec3 sum{0};
            for (const detail::PathSum& part : apart.sums) sum += part.value;
            for (int channel = 0; channel < 3; ++channel)
                CHECK(sum[channel] ==
                      doctest::Approx(double(apart.radiance[channel])).epsilon(1e-5));
        }
    }
}

TEST_CASE("explain: the sums by path add up to the pixel as it is rendered") {
    const auto room = cornell_box();
    SUBCASE("path tracing") {
        check_sums(PathTracer(room.world), room.camera);
    }
    SUBCASE("path tracing without shadow rays") {
        check_sums(PathTracer(room.world, {.sample_lights = false}), room.camera);
    }
    for (const auto indirect : {IndirectLight::rays, IndirectLight::map,
                                IndirectLight::photons, IndirectLight::none}) {
        const PhotonMappingSettings settings{.max_depth = 6,
                                             .indirect = indirect,
                                             .caustics = {.photons = 2000},
                                             .general = {.photons = 2000}};
        check_sums(PhotonMapper(room.world, settings), room.camera, true);
    }
}

TEST_CASE("explain: a floor below a point light has one path, of the known value") {
    Scene<Shapes<Quad>, Materials<Lambertian>, Lights<PointLight>> scene;
    scene.add(Quad{.corner{-9, 0, 9}, .edge_u{18, 0, 0}, .edge_v{0, 0, -18}},
              scene.add(Lambertian{.albedo{0.8f, 0.4f, 0.2f}}));
    scene.add(PointLight{.position{0, 2, 0}, .intensity = Rgb{10}});
    const World world(std::move(scene));
    const Camera camera = look_at(
        {.position{0, 5, 0}, .target{0, 0, 0}, .up{0, 0, -1}, .vfov_degrees = 0.01f});
    const auto apart = detail::take_apart(
        PathTracer(world), camera, {.width = 1, .height = 1, .samples = 4}, 0, 0);
    REQUIRE(apart.sums.size() == 1);
    CHECK(apart.sums[0].path == "EDL");
    CHECK(apart.sums[0].owner == "shadow ray");
    CHECK(apart.sums[0].terms == 4);
    // albedo/pi times intensity over the squared distance.
    CHECK(apart.sums[0].value.x ==
          doctest::Approx(0.8 / std::numbers::pi * 10 / 4).epsilon(1e-4));
    CHECK(apart.sums[0].value.z ==
          doctest::Approx(0.2 / std::numbers::pi * 10 / 4).epsilon(1e-4));
}

TEST_CASE("explain: the text has a line for each vertex, each term and each path") {
    const auto room = cornell_box();
    const auto apart =
        detail::take_apart(PathTracer(room.world), room.camera, picture, 3, 9, 2);
    const std::string text = detail::describe(apart);
    CHECK(text.find("ray 1\n") == 0);
    CHECK(text.find("\nray 2\n") != std::string::npos);
    CHECK(text.find("\nray 3\n") == std::string::npos);
    CHECK(text.find("means over 8 rays\n") != std::string::npos);
    CHECK(text.find("the pixel") != std::string::npos);
    // The pixel shows the mirror ball: a delta, and then what it reflects.
    CHECK(text.find("  E S ") != std::string::npos);
    CHECK(text.find(", delta\n") != std::string::npos);
    CHECK(text.find("  E S D L ") != std::string::npos);
    CHECK(text.find("shadow ray") != std::string::npos);
    std::size_t lines = 0;
    for (const PathLog& log : apart.first_rays) lines += 1 + log.lines.size();
    lines += 1 + apart.sums.size() + 1;
    if (apart.sums.size() <= 16)
        CHECK(std::size_t(std::count(text.begin(), text.end(), '\n')) == lines);
}

TEST_CASE("explain: long lists of paths end in one line for the rest") {
    ExplainedPixelT<float> apart{.radiance = Rgb{5}, .samples = 5};
    for (int i = 0; i < 5; ++i)
        apart.sums.push_back({std::string("E").append(std::size_t(i), 'D') + "L",
                              "emission", glm::dvec3{1}, 1});
    const std::string text = detail::describe(apart, 3);
    CHECK(text.find("  E D D L ") != std::string::npos);
    CHECK(text.find("E D D D L") == std::string::npos);
    CHECK(text.find("2 more") != std::string::npos);
    const std::string rest = "2 more                2         2         2\n";
    CHECK(text.find(rest) != std::string::npos); // the sum of both
    // As many as are shown leave no rest.
    CHECK(detail::describe(apart, 5).find(" more") == std::string::npos);
    CHECK(detail::describe(apart, 4).find("1 more                1         1") !=
          std::string::npos);
}

TEST_CASE("explain: a scene alone is explained by path tracing") {
    const auto room = cornell_box();
    CHECK(explain(room.world, room.camera, 120, 300) ==
          explain(PathTracer(room.world), room.camera, {}, 120, 300));
}

TEST_CASE("explain: rays that are not finite are left out and counted") {
    const Camera camera = look_at({.position{0, 0, 0}, .target{0, 0, -1}});
    const RenderSettings odd{.width = 3, .height = 3, .samples = 7};
    const auto apart = detail::take_apart(HalfNan{}, camera, odd, 1, 1);
    const auto rendered =
        render(HalfNan{}, camera, {.width = 1, .height = 1, .samples = 7});
    CHECK(apart.rejected == 3);
    CHECK(rendered.counts.rejected == 3);
    CHECK(apart.radiance == pixel(rendered.image, 0, 0));
    REQUIRE(apart.sums.size() == 1);
    CHECK(apart.sums[0].value.x == doctest::Approx(3 * 4 / 7.0));
    CHECK(detail::describe(apart).find("3 rays were not finite") != std::string::npos);
}

TEST_CASE("explain: a pixel outside of the picture is refused") {
    const auto room = cornell_box();
    const PathTracer tracer(room.world);
    for (const auto& [x, y] : {std::pair{-1, 0}, {12, 0}, {0, -1}, {0, 12}})
        CHECK_THROWS_AS((void)explain(tracer, room.camera, picture, x, y),
                        std::invalid_argument);
    CHECK_THROWS_WITH_AS(
        (void)explain(tracer, room.camera, picture, 12, 0),
        "the pixel's column is 12; it must be at least 0 and below the "
        "picture's width.",
        std::invalid_argument);
    CHECK_THROWS_AS((void)explain(tracer, room.camera,
                                  {.width = 4, .height = 4, .samples = 0}, 1, 1),
                    std::invalid_argument);
}

TEST_CASE("explain: each line as it is printed, column by column") {
    ExplainedPixelT<float> apart{.radiance{1, 2, 3}, .samples = 2, .rejected = 1};
    PathLog log;
    log.begin();
    log.vertex('D', Vec3{1, -2, 3.5f}, Rgb{0.5f, 0.25f, 0.125f}, 0.75f);
    log.vertex('S', Vec3{4, 5, 6}, Rgb{0.5f, 0.25f, 0.125f}, 0.0f);
    log.term("emission", "L", Rgb{8, 4, 2});
    apart.first_rays = {log, {}};
    apart.sums = {{"EDSL", "emission", {1, 2, 3}, 1}, {"E.+L", "map", {0, 0.5, 0}, 1}};
    CHECK(detail::describe(apart) ==
          "ray 1\n"
          "  E D                        throughput          0.5      0.25     0.125"
          "   at (1, -2, 3.5), pdf 0.75\n"
          "  E D S                      throughput          0.5      0.25     0.125"
          "   at (4, 5, 6), delta\n"
          "  E D S L                    emission              8         4         2\n"
          "ray 2\n"
          "  no light\n"
          "means over 2 rays\n"
          "  E D S L                    emission              1         2         3\n"
          "  E.+ L                      map                   0       0.5         0\n"
          "                             the pixel             1         2         3\n"
          "1 rays were not finite and are left out\n");
}
