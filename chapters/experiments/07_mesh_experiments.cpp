// smoke: --quality draft --photons 3000 --cuts 2 --width 24 --height 16 --rays 1
/// \file chapters/experiments/07_mesh_experiments.cpp
/// \brief Chapter 7: the experiments behind its other plot and table: the effect of
/// smooth normals on light, and what a mesh costs.

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "common/example.hpp"
#include "ljus/accel/mesh.hpp"
#include "ljus/io/load_obj.hpp"
#include "ljus/io/png.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/scenes/mesh_formulas.hpp"

using namespace ljus;

namespace {

using Open = Scene<Shapes<Mesh, Sphere, Quad>, Materials<Lambertian, Mirror, Glass>>;
using Room = World<Open>;

/// The options of this program, besides the common ones.
struct Sizes {
    long long photons = 0; ///< Aimed at the glass.
    int cuts = 0;          ///< Of the finest ball of the tables.
};

/// A white floor, and a lamp of 0.6 x 0.6 that shines on it from the left.
Open floor_and_lamp() {
    Open room;
    const auto white = room.add(Lambertian{.albedo = Rgb{0.7f}});
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Quad{.corner{-5, 0, 4}, .edge_u{10, 0, 0}, .edge_v{0, 0, -10}}, white);
    room.add(
        Quad{.corner{-3.3f, 4, -0.3f}, .edge_u{0.6f, 0.3f, 0}, .edge_v{0, 0, 0.6f}},
        black, Rgb{60});
    return room;
}

// --- The adjoint's factor ---------------------------------------------------------------

const Sphere glass_ball{.center{0, 1.1f, 0}, .radius = 0.8f};

Room glass_room(const MeshData& glass) {
    Open room = floor_and_lamp();
    room.add(Mesh(glass), room.add(Glass{.index = 1.5f}));
    return World(std::move(room));
}

/// The photons that a glass mesh sends to the floor.
/// \param factor  Whether they are scattered as flux, with the adjoint's factor.
///                Scattered as radiance they go the same way without it; the n^2 of
///                radiance is left out, too.
/// \param share   Set to their fraction of the flux that hit the glass.
std::vector<Photon> glass_photons(const Room& room, long long count, bool factor,
                                  std::uint64_t seed, double& share) {
    const LightChoice choice = room.light_choice();
    const std::vector<ObjectId> targets = specular_objects(room);
    std::vector<Photon> photons;
    double met = 0, landed = 0;
    for (long long i = 0; i < count; ++i) {
        RandomStream stream = random_stream(seed, Pass::caustics_photons, 0,
                                            static_cast<std::uint64_t>(i));
        const auto aimed = aim(room, choice, targets, stream);
        if (!aimed) continue;
        EmittedPhotonT<float> flight = aimed->photon;
        flight.flux /= static_cast<float>(count);
        for (int bounce = 1; bounce <= 100; ++bounce) {
            start_bounce(stream, static_cast<std::uint64_t>(bounce));
            const auto hit = closest_hit(room, flight.ray);
            if (!hit || (bounce == 1 && hit->object != targets[0])) break;
            if (bounce == 1) met += double(flight.flux.x);
            const auto surface = vertex_at(room, flight.ray, *hit);
            if (hit->object != targets[0]) {
                if (surface.point.normal.y < 0.9f) break; // the lamp
                landed += double(flight.flux.x);
                photons.push_back({.position = surface.point.position,
                                   .direction = flight.ray.direction,
                                   .flux = flight.flux,
                                   .kind = PhotonKind::caustic,
                                   .normal = small_normal(surface.point.normal)});
                break;
            }
            const auto next =
                scatter(surface, Glass{.index = 1.5f}, next_3d<float>(stream),
                        factor ? Transport::flux : Transport::radiance);
            if (!next) break;
            if (factor) flight.flux *= next->sample.weight;
            flight.ray = spawn_ray(surface.point, next->wi);
        }
    }
    share = landed / met;
    return photons;
}
void caustic_pictures(const examples::Options& options, const Sizes& sizes) {
    const Camera camera = look_at(
        {.position{0.6f, 2.6f, 4.6f}, .target{0.3f, 0.6f, 0}, .vfov_degrees = 34});
    const Room room = glass_room(icosphere(glass_ball, 0));
    const Room fine = glass_room(icosphere(glass_ball, 6));
    PhotonMappingSettings settings;
    settings.indirect = IndirectLight::none;
    settings.caustics_estimate.radius = options.pick(0.06f, 0.02f, 0.01f);
    for (const bool factor : {true, false}) {
        double share = 0;
        settings.caustics.photons = 0; // these are traced here
        PhotonMapper mapper(room, settings);
        mapper.set_caustics(make_photon_map(
            glass_photons(room, sizes.photons, factor, options.seed, share)));
        save_png(
            examples::rendered("caustic", mapper, camera, options).image,
            options.path(factor ? "mesh-caustic.png" : "mesh-caustic-without.png"));
    }
    settings.caustics = {
        .photons = sizes.photons, .seed = options.seed, .threads = options.threads};
    const PhotonMapper mapper(fine, settings);
    save_png(examples::rendered("caustic", mapper, camera, options).image,
             options.path("mesh-caustic-fine.png"));
}

// --- Energy -----------------------------------------------------------------------------

/// The mean brightness of a convex body in a furnace of brightness 1, by path tracing.
template <typename Material>
double in_furnace(const MeshData& body, const Material& material, int paths,
                  std::uint64_t seed) {
    Open open;
    const auto black = open.add(Lambertian{.albedo = Rgb{0}});
    open.add(Mesh(body), open.add(material));
    open.add(Sphere{.center{0, 0, 0}, .radius = 4}, black, Rgb{1}, true);
    const World room(std::move(open));
    const PathTracer tracer(room, {.roulette_depth = 1001, .sample_lights = false});
    Counts counts;
    double sum = 0;
    int hits = 0;
    for (int i = 0; i < paths; ++i) {
        RandomStream stream =
            random_stream(seed, Pass::camera, 0, static_cast<std::uint64_t>(i));
        const Vec3 from = 3.0f * sample_uniform_sphere(next_2d<float>(stream));
        const Vec2 disc = next_2d<float>(stream) * 2.0f - 1.0f;
        const Ray ray{.origin = from + to_world(frame_around(glm::normalize(from)),
                                                Vec3{disc, 0}),
                      .direction = -glm::normalize(from)};
        const auto first = closest_hit(room, ray);
        if (!first || first->object.type != 0) continue;
        auto context = context_of(stream, counts);
        sum += double(radiance(tracer, ray, context).x);
        ++hits;
    }
    return sum / hits;
}

void energy(const examples::Options& options, const Sizes& sizes) {
    examples::Plot plot{.name = "mesh-energy",
                        .columns = {"triangles", "diffuse white", "glass",
                                    "caustic without the factor"},
                        .y_label = "relative error",
                        .rows = {},
                        .log_x = true,
                        .log_y = true,
                        .more = "set key samplen 1\n"};
    const int paths = options.pick(20000, 200000, 1000000);
    const auto error = [](double off) {
        return std::abs(off) > 0 ? std::abs(off)
                                 : std::numeric_limits<double>::quiet_NaN();
    };
    for (int cuts = 0; cuts <= sizes.cuts; ++cuts) {
        const MeshData ball = icosphere(Sphere{}, cuts);
        const double matt =
            in_furnace(ball, Lambertian{.albedo = Rgb{1}}, paths, options.seed);
        const double glass =
            in_furnace(ball, Glass{.index = 1.5f}, paths, options.seed);
        double with = 0, without = 0;
        const Room room = glass_room(icosphere(glass_ball, cuts));
        (void)glass_photons(room, sizes.photons, true, options.seed, with);
        (void)glass_photons(room, sizes.photons, false, options.seed, without);
        plot.rows.push_back({20 * std::pow(4.0, cuts), error(1 - matt),
                             error(1 - glass), error(without / with - 1)});
        if (!options.quiet)
            std::printf(
                "%7.0f triangles: diffuse %.5f, glass %.5f, on the floor %.4f with "
                "the factor, %.4f without (%+.2f %%)\n",
                plot.rows.back()[0], matt, glass, with, without,
                100 * (without / with - 1));
    }
    examples::save_plot(options.out, plot);
}

// --- What it costs ------------------------------------------------------------------------

void costs(const examples::Options& options, const Sizes& sizes) {
    examples::Table table{
        .name = "mesh-costs",
        .columns = {"triangles", "bytes per triangle", "its tree, ms", "its file, ms"},
        .rows = {}};
    for (int cuts = 1; cuts <= sizes.cuts; ++cuts) {
        const MeshData data = icosphere(Sphere{}, cuts);
        examples::StopWatch watch;
        const Mesh mesh(data);
        const double build = watch.seconds();
        double load = std::numeric_limits<double>::quiet_NaN();
        std::string file;
        const auto line = [&](const char* word, const Vec3& v) {
            file += std::string(word) + examples::text(double(v.x), " %.9g") +
                    examples::text(double(v.y), " %.9g") +
                    examples::text(double(v.z), " %.9g") + "\n";
        };
        for (const Vec3& p : data.positions) line("v", p);
        for (const Vec3& n : data.normals) line("vn", n);
        for (const auto& corners : data.triangles) {
            file += "f";
            for (const std::uint32_t i : corners) {
                const std::string number = std::to_string(i + 1);
                file += std::string(" ") + number + "//" + number;
            }
            file += "\n";
        }
        const examples::StopWatch reading;
        const LoadedMesh loaded = read_obj(std::move(file), "ball.obj");
        load = reading.seconds();
        table.rows.push_back(
            {std::to_string(mesh.size()),
             examples::text(double(mesh.bytes()) / mesh.size(), "%.1f"),
             examples::text(1e3 * build, "%.2f"), examples::text(1e3 * load, "%.1f")});
    }
    examples::save_table(options.out, table);
}

void body(examples::CommandLine& line) {
    Sizes sizes;
    line.about("Chapter 7, meshes: their caustics, their energy, and their costs.");
    line.add("--photons", sizes.photons, "Aimed at the glass", 100, 100'000'000);
    line.add("--cuts", sizes.cuts, "Of the finest ball: 20 * 4^cuts triangles", 1, 8);
    const examples::Options options =
        line.parse({.draft{.width = 240, .height = 160, .samples = 8},
                    .report{.width = 480, .height = 320, .samples = 256},
                    .reference{.width = 480, .height = 320, .samples = 4096}});
    if (!line.given("--photons"))
        sizes.photons = options.pick(60'000LL, 2'000'000LL, 20'000'000LL);
    if (!line.given("--cuts")) sizes.cuts = options.pick(5, 6, 7);
    caustic_pictures(options, sizes);
    energy(options, sizes);
    costs(options, sizes);
}

} // namespace

/// Makes the pictures of caustics, the plot and the table.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, body);
}
