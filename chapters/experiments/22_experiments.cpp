// smoke: --quality draft --photons 500 --paths 2000 --width 40 --height 40
/// \file chapters/experiments/22_experiments.cpp
/// \brief Chapter 22: roulette that loses no flux, the savings of aiming, and photons that
/// are spread evenly.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "experiments/show_table.hpp"
#include "ljus/geometry/shape.hpp"
#include "ljus/inspect/photon_dots.hpp"
#include "ljus/io/png.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/scenes/report_rooms.hpp"

using namespace ljus;

namespace {

constexpr double pi = std::numbers::pi;

/// The options of this program, besides the common ones.
struct Sizes {
    long long photons = 0; ///< Ten for each that is sent for the pictures.
    long long paths = 0;   ///< Photons behind each number of the tables.
};

// --- Photons as dots ------------------------------------------------------------------

/// Adds the photons that the camera can see, each as a dot in the colour of its flux.
template <typename S>
void add_dots(Image& image, const Room<S>& room, const std::vector<Photon>& photons) {
    for (const Photon& photon : photons) {
        const auto place =
            project(room.camera, photon.position, image.width, image.height);
        if (!place) continue;
        const auto x = static_cast<int>(std::floor(place->x));
        const auto y = static_cast<int>(std::floor(place->y));
        if (x < 0 || y < 0 || x >= image.width || y >= image.height) continue;

        // Objects in front of the photon hide it.
        const Vec3 way = photon.position - room.camera.position;
        const Ray ray{
            .origin = room.camera.position, .direction = way, .t_max = 0.999f};
        if (occluded(room.world, ray)) continue;
        pixel(image, x, y) += 0.8f / max_component(photon.flux) * photon.flux;
    }
}

// --- Roulette -------------------------------------------------------------------------

/// As in the report's program, survivors are not divided by the probability. (There
/// it is proportional to the flux.)
// [uncompensated]
std::optional<Rgb> play_uncompensated(Rgb flux, Rgb weight, float u) {
    const Rgb reflected = flux * weight;
    const float probability = max_component(reflected) / max_component(flux);
    if (!(u < probability)) return std::nullopt;
    return reflected;
}
// [uncompensated]

/// How a photon's path ends.
enum class End { roulette, uncompensated, faint };

/// The flux that arrives at each surface of a photon's path, in units of the light's,
/// and how many surfaces a photon met.
struct Arrivals {
    std::array<double, 16> at{}; ///< At the first surface, the second, ...
    double total = 0;            ///< All together.
    double surfaces = 0;         ///< The mean over the photons.
};

/// Photons in a closed room, all of whose walls have the same albedo.
Arrivals bounce(float albedo, End end, long long paths, std::uint64_t seed) {
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<PointLight>> scene;
    const auto wall = scene.add(Lambertian{.albedo = Rgb{albedo}});
    scene.add(Sphere{.radius = 1}, wall, Rgb{0}, true); // seen from inside
    scene.add(PointLight{.position{0.3f, 0, 0}, .intensity = Rgb{float(0.25 / pi)}});
    const World room(std::move(scene));
    const Lambertian material{.albedo = Rgb{albedo}};

    Arrivals arrivals;
    for (long long path = 0; path < paths; ++path) {
        RandomStream stream =
            random_stream(seed, Pass::user, 0, static_cast<std::uint64_t>(path));
        EmittedPhotonT<float> flight = emit(room, room.light_choice(), stream);
        for (std::uint64_t hit_number = 0;; ++hit_number) {
            start_bounce(stream, hit_number + 1);
            const auto hit = closest_hit(room, flight.ray);
            if (!hit) break;
            const double flux = double(flight.flux.x) / double(paths);
            if (hit_number < arrivals.at.size()) arrivals.at[hit_number] += flux;
            arrivals.total += flux;
            arrivals.surfaces += 1 / double(paths);

            const auto surface = vertex_at(room, flight.ray, *hit);
            const auto scattered =
                sample(material, to_local(surface.frame, -flight.ray.direction),
                       next_3d<float>(stream), Transport::flux);
            if (!scattered) break;
            const float u = next_1d<float>(stream);
            FluxAudit audit;
            std::optional<Rgb> survivor;
            if (end == End::roulette)
                survivor = play_roulette(flight.flux, scattered->weight, u, audit);
            else if (end == End::uncompensated)
                survivor = play_uncompensated(flight.flux, scattered->weight, u);
            else if (flight.flux.x > 0.01f)
                survivor = flight.flux * scattered->weight;
            if (!survivor) break;
            flight.flux = *survivor;
            flight.ray =
                spawn_ray(surface.point, to_world(surface.frame, scattered->wi));
        }
    }
    return arrivals;
}

void compare_roulettes(const examples::Options& options, long long paths) {
    constexpr float albedo = 0.75f; // the walls of the report's room
    const Arrivals fair = bounce(albedo, End::roulette, paths, options.seed);
    const Arrivals unfair = bounce(albedo, End::uncompensated, paths, options.seed);
    const Arrivals none = bounce(albedo, End::faint, paths, options.seed);

    examples::Plot plot{.name = "emission-roulette",
                        .columns = {"surface on the photon's way", "exact",
                                    "divided by the probability", "not divided"},
                        .y_label = "fraction of the flux that arrives",
                        .rows = {},
                        .log_y = true};
    for (std::size_t i = 0; i < fair.at.size(); ++i) {
        const auto or_nothing = [](double x) { return x > 0 ? x : std::nan(""); };
        plot.rows.push_back({double(i + 1), std::pow(double(albedo), double(i)),
                             or_nothing(fair.at[i]), or_nothing(unfair.at[i])});
    }
    examples::save_plot(options.out, plot);

    examples::Table table{.name = "emission-roulette-table",
                          .columns = {"a photon's life ends", "surfaces per photon",
                                      "flux that arrives", "error"},
                          .rows = {}};
    const double exact = 1 / (1 - double(albedo));
    const auto row = [&](const char* name, const Arrivals& arrivals) {
        table.rows.push_back(
            {name, examples::text(arrivals.surfaces, "%.2f"),
             examples::text(arrivals.total, "%.3f"),
             examples::text(100 * (arrivals.total / exact - 1), "%+.1f %%")});
    };
    row("by roulette, divided by the probability", fair);
    row("by roulette, not divided (as in the report's program)", unfair);
    row("when it carries less than a hundredth", none);
    table.rows.push_back({"never (exact)", "", examples::text(exact, "%.3f"), ""});
    examples::show_table(options, table);
}

// --- Aiming ---------------------------------------------------------------------------

/// The flux to the glass, photon by photon, for one way of sending them.
struct Brought {
    double mean = 0, squares = 0; ///< Of the flux of a photon sent, W.
    long long met = 0;            ///< Photons that met the glass first.
    double nanoseconds = 0;       ///< Per photon.
};

/// Sends photons one by one.
/// \param one_photon  Sends one, and returns the flux that arrives.
template <typename OnePhoton>
Brought send(const examples::Options& options, long long paths, OnePhoton one_photon) {
    Brought brought;
    const examples::StopWatch watch;
    for (long long path = 0; path < paths; ++path) {
        RandomStream stream = random_stream(options.seed, Pass::user, 1,
                                            static_cast<std::uint64_t>(path));
        const double flux = one_photon(stream);
        if (flux > 0) ++brought.met;
        brought.mean += flux / double(paths);
        brought.squares += flux * flux / double(paths);
    }
    brought.nanoseconds = watch.seconds() * 1e9 / double(paths);
    return brought;
}

/// The table: the flux to the glass by either way, and the cost of an error of 1 %.
void tabulate_aims(const examples::Options& options, const Brought& everywhere,
                   const Brought& aimed, double paths) {
    examples::Table table{.name = "emission-aim",
                          .columns = {"photons are sent", "meet glass first",
                                      "flux to the glass, W", "standard error, W",
                                      "photons for 1 %", "ns per photon", "ms for 1 %"},
                          .rows = {}};
    const auto row = [&](const char* name, const Brought& b) {
        const double deviation = std::sqrt(b.squares - b.mean * b.mean);
        const double needed = std::pow(deviation / (0.01 * b.mean), 2);
        table.rows.push_back(
            {name, examples::text(100 * double(b.met) / paths, "%.1f %%"),
             examples::text(b.mean, "%.2f"),
             examples::text(deviation / std::sqrt(paths), "%.2f"),
             examples::text(needed, "%.0f"), examples::text(b.nanoseconds, "%.0f"),
             examples::text(needed * b.nanoseconds * 1e-6, "%.2g")});
    };
    row("everywhere", everywhere);
    row("at the glass", aimed);
    examples::show_table(options, table);
}

/// Photons sent everywhere, and photons sent at the glass of the report's figure 11.
void compare_aims(const examples::Options& options, long long paths) {
    const auto room = four_glass_room<float>();
    const LightChoice choice = room.world.light_choice();
    const auto targets = specular_objects(room.world);
    const auto is_target = [&](ObjectId id) {
        for (const ObjectId target : targets)
            if (target == id) return true;
        return false;
    };
    const Brought everywhere = send(options, paths, [&](RandomStream& stream) {
        const auto flight = emit(room.world, choice, stream);
        const auto hit = closest_hit(room.world, flight.ray);
        return hit && is_target(hit->object) ? double(flight.flux.y) : 0.0;
    });
    const Brought aimed = send(options, paths, [&](RandomStream& stream) {
        const auto sent = aim(room.world, choice, targets, stream);
        if (!sent) return 0.0;
        const auto hit = closest_hit(room.world, sent->photon.ray);
        return hit && hit->object == sent->target ? double(sent->photon.flux.y) : 0.0;
    });
    tabulate_aims(options, everywhere, aimed, double(paths));
}

// --- A lamp far outside ---------------------------------------------------------------

/// A floor, a wall and a ball under a small lamp that is brighter the farther it is.
/// \param radii  Its distance, in radii of the sphere around them.
auto under_far_lamp(float radii) {
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian>> scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.7f}});
    scene.add(Quad{{-2, 0, -2}, {0, 0, 4}, {4, 0, 0}}, white);
    scene.add(Quad{{-2, 0, -2}, {4, 0, 0}, {0, 2.5f, 0}}, white);
    scene.add(Sphere{.center{0.3f, 0.5f, 0}, .radius = 0.5f}, white);
    const SphereT<float> lit = *lit_sphere(World(scene));
    const Vec3 away = radii * lit.radius * glm::normalize(Vec3{-0.6f, 1, 0.5f});
    const float radius = 0.1f;
    const float far = glm::length(away) / radius; // E = pi L / far^2
    scene.add(Sphere{.center = lit.center + away, .radius = radius}, white,
              Rgb{far * far / float(pi)});
    return Room<decltype(scene)>{
        World(std::move(scene)),
        look_at(
            View{.position{-1, 3, 5}, .target{0, 0.6f, -0.3f}, .vfov_degrees = 40})};
}

/// Sends photons to their first surface, as the lamp emits them or aimed at the scene:
/// pictures of where they land.
void compare_far_lamps(const examples::Options& options, long long photons) {
    const auto land = [](const auto& room, const auto* aim, RandomStream& stream) {
        const auto sent = aim ? emit(room.world, aim->choice, stream, *aim)
                              : emit(room.world, room.world.light_choice(), stream);
        const auto hit = closest_hit(room.world, sent.ray);
        Photon photon{.direction = sent.ray.direction};
        if (hit && !is_black(sent.flux)) {
            photon.position = sent.ray.origin + hit->at.t * sent.ray.direction;
            photon.flux = sent.flux;
        }
        return photon; // black if none has landed
    };
    const auto room = under_far_lamp(20);
    const auto at_room = aim_at_scene(room.world, room.world.light_choice());
    for (const bool aimed : {false, true}) {
        std::vector<Photon> landed;
        for (long long path = 0; path < photons; ++path) {
            auto stream = random_stream(options.seed, Pass::user, 2,
                                        static_cast<std::uint64_t>(path));
            const Photon photon = land(room, aimed ? &at_room : nullptr, stream);
            if (!is_black(photon.flux)) landed.push_back(photon);
        }
        Image image =
            scene_drawing(room.world, room.camera, options.width, options.height);
        add_dots(image, room, landed);
        save_png(image, options.path(std::string("emission-far-") +
                                     (aimed ? "aimed" : "everywhere") + ".png"));
    }
}

// --- Evenly spread photons ------------------------------------------------------------

/// A closed grey room with a square lamp.
auto small_room() {
    Scene<Shapes<Quad>, Materials<Lambertian>> room;
    const auto grey = room.add(Lambertian{.albedo = Rgb{0.7f}});
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    const Vec3 x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2};
    room.add(Quad{{-1, -1, -1}, z, x}, grey);
    room.add(Quad{{-1, 1, -1}, x, z}, grey);
    room.add(Quad{{-1, -1, -1}, x, y}, grey);
    room.add(Quad{{-1, -1, 1}, y, x}, grey);
    room.add(Quad{{-1, -1, -1}, y, z}, grey);
    room.add(Quad{{1, -1, -1}, z, y}, grey);
    room.add(Quad{{-0.3f, 0.98f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}}, black, Rgb{4});
    return World(std::move(room));
}

/// The flux that a photon carries to a patch of the floor: direct, after one bounce,
/// and after three.
constexpr std::size_t orders = 3;
using Orders = std::array<double, orders>;

template <AnyWorld W, typename Stream>
Orders follow(const W& room, const LightChoice& choice, Stream stream) {
    constexpr std::array<std::uint64_t, orders> surface{1, 2, 4};
    Orders brought{};
    auto flight = emit(room, choice, stream);
    FluxAudit audit;
    for (std::uint64_t number = 1; number <= surface.back(); ++number) {
        start_bounce(stream, number);
        const auto hit = closest_hit(room, flight.ray);
        if (!hit) break;
        const auto at = vertex_at(room, flight.ray, *hit);
        const Vec3& p = at.point.position;
        const bool on_patch =
            p.y < -0.999f && p.x > 0 && p.x < 0.6f && p.z > 0.1f && p.z < 0.7f;
        for (std::size_t i = 0; i < orders; ++i)
            if (on_patch && number == surface[i]) brought[i] = double(flight.flux.x);
        const bool alive =
            room.visit_material(at.object.material, [&](const auto& material) {
                const auto next =
                    sample(material, to_local(at.frame, -flight.ray.direction),
                           next_3d<float>(stream), Transport::flux);
                if (!next) return false;
                const auto survivor = play_roulette(flight.flux, next->weight,
                                                    next_1d<float>(stream), audit);
                if (!survivor) return false;
                flight.flux = *survivor;
                flight.ray = spawn_ray(at.point, to_world(at.frame, next->wi));
                return true;
            });
        if (!alive) break;
    }
    return brought;
}

/// The mean of one pass, and the scatter of the passes.
struct Spread {
    Orders mean{}, deviation{}; ///< Over the seeds, relative to the mean.
};

template <AnyWorld W, typename MakeStream>
Spread spread_of(const W& room, const LightChoice& choice, long long photons, int seeds,
                 MakeStream make_stream) {
    Orders sum{}, squares{};
    for (int seed = 0; seed < seeds; ++seed) {
        Orders one{};
        for (long long i = 0; i < photons; ++i) {
            const Orders brought = follow(room, choice,
                                          make_stream(static_cast<std::uint64_t>(seed),
                                                      static_cast<std::uint64_t>(i)));
            for (std::size_t k = 0; k < orders; ++k)
                one[k] += brought[k] / double(photons);
        }
        for (std::size_t k = 0; k < orders; ++k) {
            sum[k] += one[k] / seeds;
            squares[k] += one[k] * one[k] / seeds;
        }
    }
    Spread spread{.mean = sum};
    for (std::size_t k = 0; k < orders; ++k)
        spread.deviation[k] = std::sqrt(std::max(0.0, squares[k] - sum[k] * sum[k]) *
                                        seeds / (seeds - 1)) /
                              sum[k];
    return spread;
}

/// Table: the variance with random numbers over that with Sobol's, after none, one and
/// three bounces.
void compare_numbers(const examples::Options& options) {
    const auto room = small_room();
    const LightChoice choice = room.light_choice();
    const long long photons = 1LL << options.pick(13, 15, 17);
    const int seeds = options.pick(16, 32, 64);
    const Spread random =
        spread_of(room, choice, photons, seeds, [&](auto seed, auto path) {
            return random_stream(options.seed, Pass::user, seed, path);
        });
    const Spread sobol =
        spread_of(room, choice, photons, seeds, [&](auto seed, auto path) {
            return sobol_stream(options.seed, Pass::user, seed, path);
        });
    examples::Table table{.name = "emission-numbers-table",
                          .columns = {"photons", "variance, random over Sobol"},
                          .rows = {}};
    const char* const names[] = {"direct", "after one bounce", "after three bounces"};
    for (std::size_t k = 0; k < orders; ++k)
        table.rows.push_back(
            {names[k],
             examples::text(std::pow(random.deviation[k] / sobol.deviation[k], 2),
                            "%.2g")});
    examples::show_table(options, table);
}

// --- Roulette with another probability ------------------------------------------------

/// The flux of one photon that arrives at all surfaces together, if it survives each
/// with the probability p and then carries rho / p times its flux.
void compare_probabilities(const examples::Options& options, long long paths) {
    const double rho = 0.75;
    examples::Table table{.name = "emission-probability",
                          .columns = {"p", "surfaces per photon", "flux that arrives",
                                      "deviation", "deviation (exact)", "efficiency"},
                          .rows = {}};
    const auto variance_of = [&](double p) {
        const double rest = 1 - rho * rho / p, mean = 1 / (1 - rho);
        return rest > 0 ? (1 + 2 * rho * mean) / rest - mean * mean : -1.0;
    };
    const auto efficiency = [&](double p) { return (1 - p) / variance_of(p); };
    for (const double p : {0.95, 0.85, 0.75, 0.65, 0.5, 0.25, 0.1}) {
        double sum = 0, squares = 0;
        for (long long path = 0; path < paths; ++path) {
            RandomStream stream = random_stream(options.seed, Pass::user, 7,
                                                static_cast<std::uint64_t>(path));
            double flux = 1, arrived = 1;
            while (next_1d<double>(stream) < p) arrived += flux *= rho / p;
            sum += arrived / double(paths);
            squares += arrived * arrived / double(paths);
        }
        const double variance = variance_of(p);
        table.rows.push_back(
            {examples::text(p, "%.2f"), examples::text(1 / (1 - p), "%.2f"),
             examples::text(sum, "%.3f"),
             examples::text(std::sqrt(squares - sum * sum), "%.2f"),
             variance > 0 ? examples::text(std::sqrt(variance), "%.2f") : "infinite",
             variance > 0 ? examples::text(efficiency(p) / efficiency(rho), "%.2f")
                          : "0"});
    }
    examples::show_table(options, table);
}

} // namespace

/// Makes the pictures, plots and tables behind chapter 22.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 22, photons: roulette, aiming, evenly spread numbers.");
        line.add("--photons", sizes.photons, "Photons emitted for the pictures", 1,
                 100000000);
        line.add("--paths", sizes.paths, "Photons behind each number of the tables", 1,
                 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 200, .height = 200, .samples = 1}});
        if (!line.given("--photons"))
            sizes.photons = options.pick(20000LL, 60000LL, 200000LL);
        if (!line.given("--paths"))
            sizes.paths = options.pick(20000LL, 500000LL, 5000000LL);
        compare_roulettes(options, sizes.paths);
        compare_aims(options, sizes.paths);
        compare_far_lamps(options, sizes.photons / 10);
        compare_numbers(options);
        compare_probabilities(options, sizes.paths);
    });
}
