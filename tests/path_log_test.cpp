// Every light path has one owner: the tables of the two renderers, proven by the
// letters of the paths that they log. Where energies are compared, 20 times, the limit
// is one that all of them together exceed once in 1000 runs.
// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
// none failed.
#include <doctest/doctest.h>

#include <map>
#include <regex>
#include <set>
#include <string>

#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/render/whitted.hpp"
#include "support/mean.hpp"
#include "support/rooms.hpp"
#include "support/seed.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

const double limit = ljus_test::limit_of(20); ///< In standard errors.

/// Matt walls, a ball of glass, a mirror on the back wall, a mixed ball, a quad lamp.
ClosedRoom mixed_room() {
    BallRoom room;
    add_walls(room);
    const auto glass = room.add(Glass{.index = 1.5f});
    const auto mirror = room.add(Mirror{.reflectance = Rgb{0.9f}});
    const auto mixed = room.add(Mixture{
        .color = Rgb{0.7f, 0.5f, 0.3f}, .reflectivity = 0.3f, .transparency = 0.2f});
    room.add(Sphere{.center{-0.4f, -0.5f, 0.1f}, .radius = 0.4f}, glass);
    room.add(Sphere{.center{0.45f, -0.55f, -0.1f}, .radius = 0.4f}, mixed);
    room.add(
        Quad{.corner{-0.7f, -0.9f, -0.95f}, .edge_u{1.4f, 0, 0}, .edge_v{0, 1.5f, 0}},
        mirror);
    add_lamps(room, Lamp::quad, 1);
    return World(std::move(room));
}

/// A ray into the room, where all of its things are.
Ray into_room(RandomStream& stream) {
    const Vec2 u = next_2d<float>(stream);
    return primary_ray(room_camera<float>(), u, 1, 1);
}

/// The class of a path: S+ stands for one or more S, and is one letter in it: E D S L,
/// E S D L, E D D S L, ...
std::string class_of(const std::string& path) {
    std::string shorter;
    for (const char c : path)
        if (!(c == 'S' && shorter.back() == 'S')) shorter += c;
    return shorter;
}

/// One logged path, its terms and who carried them.
template <typename Renderer>
PathLog log_of(const Renderer& renderer, std::uint64_t seed, std::uint64_t path,
               Counts& counts) {
    auto stream = random_stream(ljus_test::test_seed(seed), Pass::camera, 0, path);
    const Ray ray = into_room(stream);
    PathLog log;
    auto context = context_of(stream, counts, log);
    const Rgb sum = radiance(renderer, ray, context);
    // The log holds all that was added.
    glm::dvec3 all(0);
    for (const PathLogLine& line : log.lines)
        if (line.what != "vertex") all += line.value;
    CHECK(double(sum.x) == doctest::Approx(all.x).epsilon(1e-4));
    CHECK(double(sum.z) == doctest::Approx(all.z).epsilon(1e-4));
    return log;
}

/// Whether a term's path may be carried by this owner, by the table of the photon
/// mapper. `indirect` is rays or map.
bool owned(const std::string& owner, const std::string& path, IndirectLight indirect) {
    static const std::regex emission("ES*L"), shadow("E[SD]*DL"),
        caustics("E[SD]*DS\\+L");
    if (owner == "emission") return std::regex_match(path, emission);
    if (owner == "shadow ray")
        return std::regex_match(
            path, indirect == IndirectLight::rays ? shadow : std::regex("ES*DL"));
    if (owner == "caustics map") return std::regex_match(path, caustics);
    if (owner == "general map")
        return (indirect == IndirectLight::map &&
                std::regex_match(path, std::regex("ES*DS*DL\\|D\\.\\.DL"))) ||
               (indirect == IndirectLight::photons &&
                std::regex_match(path, std::regex("ES*D\\.\\.DL")));
    return false;
}

} // namespace

TEST_CASE("path log: the letters of a path that is known") {
    // A mirror over a matt floor: E S D L by the shadow ray, nothing else.
    BallRoom room;
    const auto white = room.add(Lambertian{.albedo = Rgb{0.5f}});
    const auto mirror = room.add(Mirror{});
    room.add(Quad{.corner{-9, 0, -9}, .edge_u{0, 0, 18}, .edge_v{18, 0, 0}}, white);
    room.add(Quad{.corner{-1, 2, -1}, .edge_u{2, 0, 0}, .edge_v{0, 0, 2}}, mirror);
    room.add(PointLight{.position{3, 1, 0}, .intensity = Rgb{1}});
    const World world(std::move(room));
    const PathTracer tracer(world, {.max_depth = 2});
    auto stream = random_stream(ljus_test::test_seed(1), Pass::camera, 0, 0);
    Counts counts;
    PathLog log;
    auto context = context_of(stream, counts, log);
    const Rgb seen =
        radiance(tracer, Ray{.origin{0, 1, 0}, .direction{0, 1, 0}}, context);
    REQUIRE(log.lines.size() >= 2);
    CHECK(log.lines[0].path == "ES");
    CHECK(log.lines[0].what == "vertex");
    CHECK(log.lines[0].position == glm::dvec3{0, 2, 0});
    CHECK(log.lines[0].value == glm::dvec3{1});
    CHECK(log.lines[0].pdf == 0);
    CHECK(log.lines[1].path == "ESDL");
    CHECK(log.lines[1].what == "shadow ray");
    CHECK(log.lines[1].value.x == double(seen.x));
    CHECK(glm::length(log.lines[1].position) < 1e-6); // the floor, below the eye
    // E = I cos / d^2 of the floor at (0, 0, 0).
    const double d2 = 10;
    CHECK(double(seen.x) ==
          doctest::Approx(0.5 / std::numbers::pi / (d2 * std::sqrt(d2))).epsilon(1e-5));
    // A log that is begun again starts at E.
    log.begin();
    CHECK(log.letters == "E");
    log.term("emission", "L", Rgb{0}); // black is no term
    CHECK(log.lines.back().what != "emission");
}

TEST_CASE("path log: each term of the photon mapper has the one owner of the table") {
    const ClosedRoom room = mixed_room();
    for (const IndirectLight indirect : {IndirectLight::rays, IndirectLight::map,
                                         IndirectLight::photons, IndirectLight::none}) {
        PhotonMappingSettings settings;
        settings.indirect = indirect;
        settings.split_glass = indirect != IndirectLight::map;
        settings.caustics = {.photons = 20000, .threads = 1};
        settings.general = {.photons = 20000, .threads = 1};
        const PhotonMapper mapper(room, settings);
        Counts counts;
        std::map<std::string, std::set<std::string>> owners;
        std::map<std::string, int> terms;
        for (std::uint64_t path = 0; path < 4000; ++path) {
            const PathLog log = log_of(mapper, 1, path, counts);
            std::set<std::string> diffuse;
            for (const PathLogLine& line : log.lines) {
                if (line.what == "vertex") continue;
                CAPTURE(line.what);
                CAPTURE(line.path);
                CHECK(owned(line.what, line.path, indirect));
                owners[line.path].insert(line.what);
                ++terms[line.what];
                if (indirect == IndirectLight::none)
                    CHECK(std::regex_match(line.path,
                                           std::regex("ES*L|ES*DL|ES*DS\\+L")));
            }
        }
        for (const auto& carried : owners) {
            CAPTURE(carried.first);
            CHECK(carried.second.size() == 1);
        }
        CHECK(terms["emission"] > 10); // by the mirror; no lamp is in view
        CHECK(terms["shadow ray"] > 2000);
        CHECK(terms["caustics map"] > 1000);
        CHECK((terms["general map"] > 1000) ==
              (indirect == IndirectLight::map || indirect == IndirectLight::photons));
    }
}

TEST_CASE(
    "path log: the path tracer finds lamps by emission and by shadow rays, and by "
    "nothing else") {
    const ClosedRoom room = mixed_room();
    const PathTracer tracer(room);
    Counts counts;
    for (std::uint64_t path = 0; path < 4000; ++path) {
        const PathLog log = log_of(tracer, 2, path, counts);
        for (const PathLogLine& line : log.lines) {
            CAPTURE(line.path);
            if (line.what == "emission")
                CHECK(std::regex_match(line.path, std::regex("E[SD]*L")));
            else if (line.what == "shadow ray")
                CHECK(std::regex_match(line.path, std::regex("E[SD]*DL")));
            else
                CHECK(line.what == "vertex");
        }
    }
}

TEST_CASE("path log: the two renderers bring the same light, class of paths by class") {
    // No class is missing, none is counted twice: E L, E S+ L, E D L, E D S+ L, E D D
    // L, E S+ D L, E D D S+ L, ... in one room with both maps' photons.
    const ClosedRoom room = mixed_room();
    PhotonMappingSettings settings;
    settings.caustics_estimate.radius = 0.04f;
    const std::uint64_t paths = 12000;
    const int seeds = 24;
    std::set<std::string> classes;
    const auto run = [&](const auto& renderer, std::uint64_t seed) {
        std::map<std::string, double> sums;
        Counts counts;
        for (std::uint64_t path = 0; path < paths; ++path) {
            auto stream =
                random_stream(ljus_test::test_seed(seed), Pass::camera, 0, path);
            const Ray ray = into_room(stream);
            PathLog log;
            auto context = context_of(stream, counts, log);
            (void)radiance(renderer, ray, context);
            for (const PathLogLine& line : log.lines) {
                if (line.what == "vertex") continue;
                std::string name = class_of(line.path);
                if (const auto plus = name.find('+'); plus != std::string::npos)
                    name.erase(plus, 1);
                if (name.size() > 6) name = "longer";
                sums[name] += line.value.y / double(paths);
                classes.insert(name);
            }
        }
        return sums;
    };
    std::vector<std::map<std::string, double>> a, b;
    for (int seed = 1; seed <= seeds; ++seed) {
        const auto s = static_cast<std::uint64_t>(seed);
        a.push_back(run(PathTracer(room), 100 + s));
        settings.caustics = {
            .photons = 50000, .seed = ljus_test::test_seed(s), .threads = 1};
        b.push_back(run(PhotonMapper(room, settings), s));
    }
    int compared = 0;
    std::set<std::string> found;
    for (const std::string& name : classes) {
        Mean of_tracer, of_mapper;
        for (int i = 0; i < seeds; ++i) {
            of_tracer.add(a[static_cast<std::size_t>(i)][name]);
            of_mapper.add(b[static_cast<std::size_t>(i)][name]);
        }
        const double error = std::hypot(of_tracer.error(), of_mapper.error());
        if (error > 0.07 * of_tracer.mean) continue; // known too badly
        ++compared;
        found.insert(name);
        CAPTURE(name);
        CAPTURE(of_tracer.mean);
        CAPTURE(of_tracer.error());
        CAPTURE(of_mapper.mean);
        CAPTURE(of_mapper.error());
        CHECK(std::abs(apart(of_mapper, of_tracer)) < limit);
    }
    CHECK(compared >= 10);
    for (const char* name :
         {"ESL", "EDL", "EDSL", "ESDL", "EDDL", "EDSDL", "ESDSL", "EDDSL"})
        CHECK(found.count(name) == 1);
}

TEST_CASE("path log: a mirror and a ball of glass cast no shadow ray") {
    // Mirrors all around, and glass: nothing to light.
    BallRoom room;
    const auto mirror = room.add(Mirror{.reflectance = Rgb{0.5f}});
    const auto glass = room.add(Glass{});
    room.add(Sphere{.radius = 5}, mirror, Rgb{0}, true);
    room.add(Sphere{.center{0, 0, -2}, .radius = 1}, glass);
    room.add(PointLight{.position{0, 2, 0}, .intensity = Rgb{10}});
    const World world(std::move(room));
    PhotonMappingSettings settings;
    settings.caustics.photons = 1000;
    const RenderSettings picture{.width = 16, .height = 16, .samples = 4, .threads = 1};
    const Camera camera = look_at({.position{0, 0, 1}, .target{0, 0, -2}});
    for (const Counts& counts :
         {render(PathTracer(world), camera, picture).counts,
          render(PhotonMapper(world, settings), camera, picture).counts}) {
        CHECK(counts.camera_rays == 16 * 16 * 4);
        CHECK(counts.bounce_rays > counts.camera_rays);
        CHECK(counts.shadow_rays == 0);
        CHECK(counts.map_queries == 0);
    }
}

TEST_CASE("path log: a gather ray that reaches a lamp adds nothing") {
    // A matt floor under a lamp that covers half of its sky: half of the indirect rays
    // meet the lamp, straight or by a mirror. Direct light is the shadow rays' alone.
    BallRoom room;
    const auto white = room.add(Lambertian{.albedo = Rgb{1}});
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    const auto mirror = room.add(Mirror{});
    room.add(Quad{.corner{-9, 0, -9}, .edge_u{0, 0, 18}, .edge_v{18, 0, 0}}, white);
    room.add(Quad{.corner{-3, 1, -3}, .edge_u{6, 0, 0}, .edge_v{0, 0, 6}}, black,
             Rgb{2});
    room.add(Quad{.corner{4, 0, -9}, .edge_u{0, 3, 0}, .edge_v{0, 0, 18}}, mirror);
    const World world(std::move(room));
    for (const IndirectLight indirect : {IndirectLight::rays, IndirectLight::map}) {
        PhotonMappingSettings settings;
        settings.indirect = indirect;
        settings.caustics.photons = 5000;
        settings.general.photons = 5000;
        const PhotonMapper mapper(world, settings);
        Counts counts;
        for (std::uint64_t path = 0; path < 2000; ++path) {
            auto stream = random_stream(ljus_test::test_seed(1), Pass::camera, 0, path);
            PathLog log;
            auto context = context_of(stream, counts, log);
            (void)radiance(mapper, Ray{.origin{0, 0.5f, 0}, .direction{0, -1, 0}},
                           context);
            for (const PathLogLine& line : log.lines) CHECK(line.what != "emission");
        }
    }
}

TEST_CASE("path log: a line is a vertex with its density, or a term without one") {
    PathLog log;
    log.begin();
    log.vertex('D', Vec3{1, 2, 3}, Rgb{0.5f, 0.25f, 0.125f}, 0.75f);
    log.vertex('S', Vec3{4, 5, 6}, Rgb{0.25f}, 0.0f);
    log.term("shadow ray", "DL", Rgb{0});
    log.arrive(Vec3{7, 8, 9});
    log.term("shadow ray", "DL", Rgb{0, 0, 2});
    REQUIRE(log.lines.size() == 3); // a black one is none
    CHECK(log.lines[0].path == "ED");
    CHECK(log.lines[0].what == "vertex");
    CHECK(log.lines[0].value == glm::dvec3{0.5, 0.25, 0.125});
    CHECK(log.lines[0].position == glm::dvec3{1, 2, 3});
    CHECK(log.lines[0].pdf == 0.75);
    CHECK(log.lines[1].path == "EDS");
    CHECK(log.lines[1].pdf == 0);
    CHECK(log.lines[2].path == "EDSDL");
    CHECK(log.lines[2].what == "shadow ray");
    CHECK(log.lines[2].value == glm::dvec3{0, 0, 2});
    CHECK(log.lines[2].position == glm::dvec3{7, 8, 9});
    CHECK(log.lines[2].pdf == 0);
    // A path tells its last scattering, as does one that split off.
    PathState path{.throughput{3, 2, 1}, .previous{7, 8, 9}, .pdf = 0.5f, .depth = 3};
    detail::log_vertex(log, path);
    CHECK(log.lines.back().path == "EDSD");
    CHECK(log.lines.back().value == glm::dvec3{3, 2, 1});
    CHECK(log.lines.back().position == glm::dvec3{7, 8, 9});
    CHECK(log.lines.back().pdf == 0.5);
    path.specular = true;
    path.pdf = 0;
    log.lines.clear();
    detail::log_specular_path(log, path);
    REQUIRE(log.lines.size() == 1);
    CHECK(log.lines[0].path == "ESSS");
    CHECK(log.lines[0].what == "vertex");
    log.begin();
    CHECK(log.letters == "E");
}

TEST_CASE("path log: a term has the place that its path has come to") {
    const ClosedRoom room = mixed_room();
    const PhotonMapper mapper(room, {.caustics{.photons = 2000}});
    const PathTracer tracer(room);
    int followed = 0, last = 0;
    const auto look = [&](const PathLog& log) {
        glm::dvec3 before{0, 0, 100};
        for (std::size_t i = 0; i < log.lines.size(); ++i) {
            if (log.lines[i].what == "vertex") {
                before = log.lines[i].position;
                continue;
            }
            std::size_t next = i + 1;
            while (next < log.lines.size() && log.lines[next].what != "vertex") ++next;
            if (next < log.lines.size()) { // the path was scattered there, and tells it
                CHECK(log.lines[i].position == log.lines[next].position);
                ++followed;
            } else { // it ended there, which no vertex tells
                CHECK(glm::distance(log.lines[i].position, before) > 1e-3);
                ++last;
            }
        }
    };
    Counts counts;
    for (std::uint64_t path = 0; path < 200; ++path) {
        look(log_of(mapper, 3, path, counts));
        look(log_of(tracer, 3, path, counts));
    }
    CHECK(followed > 200);
    CHECK(last > 5);
}

TEST_CASE("path log: at glass that splits both ways are told from the eye") {
    // Above a pane of glass: what it mirrors is ESDL by the shadow ray on the ceiling,
    // what it lets through ESDL by that on the floor; each has its own vertex.
    BallRoom room;
    const auto white = room.add(Lambertian{.albedo = Rgb{0.5f}});
    room.add(Quad{.corner{-9, 0, -9}, .edge_u{0, 0, 18}, .edge_v{18, 0, 0}}, white);
    room.add(Quad{.corner{-9, 4, -9}, .edge_u{18, 0, 0}, .edge_v{0, 0, 18}}, white);
    room.add(Quad{.corner{-9, 1, -9}, .edge_u{0, 0, 18}, .edge_v{18, 0, 0}},
             room.add(Glass{.index = 1.5f}));
    room.add(PointLight{.position{0, 3, 2}, .intensity = Rgb{1}});
    const World world(std::move(room));
    PhotonMappingSettings settings{.max_depth = 2, .split_glass = true};
    settings.caustics.photons = 0;
    const PhotonMapper mapper(world, settings);
    auto stream = random_stream(ljus_test::test_seed(1), Pass::camera, 0, 0);
    Counts counts;
    PathLog log;
    auto context = context_of(stream, counts, log);
    (void)radiance(mapper, Ray{.origin{0, 2, 0}, .direction{0, -1, 0}}, context);
    int vertices = 0, terms = 0;
    for (const PathLogLine& line : log.lines) {
        if (line.what == "vertex") {
            CHECK((line.path == "ES" || line.path == "ESD"));
            vertices += line.path == "ES";
        } else {
            CHECK(line.path == "ESDL");
            CHECK(line.what == "shadow ray");
            ++terms;
        }
    }
    CHECK(vertices == 2);
    CHECK(terms == 1); // the floor's light is hidden by the pane
}

TEST_CASE("path log: a vertex behind which a path split lies where it was met") {
    // Down the axis of a ball of glass: above at odd vertices, below at even ones.
    BallRoom room;
    room.add(Sphere{}, room.add(Glass{.index = 1.5f}));
    const World world(std::move(room));
    const WhittedTracer tracer(world, {.max_depth = 4, .split_glass = true});
    auto stream = random_stream(1, Pass::camera, 0, 0);
    Counts counts;
    PathLog log;
    auto context = context_of(stream, counts, log);
    (void)radiance(tracer, Ray{.origin{0, 2, 0}, .direction{0, -1, 0}}, context);
    const double reflected = 0.04; // at index 1.5
    int vertices = 0;
    for (const PathLogLine& line : log.lines) {
        REQUIRE(line.what == "vertex");
        const auto depth = double(line.path.size()) - 1;
        CHECK(line.position.y == doctest::Approx(line.path.size() % 2 == 0 ? 1 : -1));
        // Into the ball, depth - 2 reflections, and then one more or out of the ball.
        const double within = (1 - reflected) / 2.25 * std::pow(reflected, depth - 2);
        const double on = depth == 1 ? reflected : within * reflected;
        const double through =
            depth == 1 ? (1 - reflected) / 2.25 : within * (1 - reflected) * 2.25;
        CHECK(std::min(std::abs(line.value.x / on - 1),
                       std::abs(line.value.x / through - 1)) < 1e-5);
        ++vertices;
    }
    CHECK(vertices == 8);
}
