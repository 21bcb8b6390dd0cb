// smoke: --quality draft --photons 2000 --maps 2 --quiet
/// \file chapters/experiments/23_experiments.cpp
/// \brief Chapter 23: the experiments behind its drawings and plots: the bias at a wall,
/// and the error over k.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "flatland/density_estimate.hpp"
#include "flatland/room.hpp"

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using namespace flatland;
using examples::Drawing, examples::flat, examples::Point, examples::text;
using ljus::Kernel, ljus::PhotonKind;

constexpr double pi = std::numbers::pi;

/// The colour of a photon of each kind.
std::string color_of(PhotonKind kind) {
    if (kind == PhotonKind::direct) return examples::colors::blue;
    return kind == PhotonKind::caustic ? examples::colors::orange
                                       : examples::colors::green;
}

/// A point of the floor, seen from above.
SurfacePoint on_floor(double x) {
    return {.position{x, 0}, .normal{0, 1}};
}

// --- Drawings ------------------------------------------------------------------------

/// Rays in even steps of the angle, and two screens of one length: how many arrive.
void draw_falloff(const std::string& folder) {
    Drawing figure{.name = "flatland-falloff",
                   .description = "A fan of even rays; a screen at twice the distance "
                                  "catches half as many",
                   .low{-2.2, -0.62},
                   .high{1.4, 0.62},
                   .scale = 200};
    const Scene scene{{{Segment{.from{1, -0.3}, .to{1, 0.3}}},
                       {Segment{.from{-2, 0.3}, .to{-2, -0.3}}}}};
    int arrived[2] = {0, 0};
    constexpr int rays = 120;
    for (int i = 0; i < rays; ++i) {
        const double angle = 2 * pi * (i + 0.5) / rays;
        const Ray ray{.direction{std::cos(angle), std::sin(angle)}};
        const auto hit = closest_hit(scene, ray);
        if (hit) ++arrived[hit->id];
        const double end = hit ? hit->t : 0.55;
        draw_line(figure, {{0, 0}, flat(end * ray.direction)},
                  {hit ? examples::colors::orange : "currentColor", hit ? 1.2 : 0.4});
    }
    for (const Object& object : scene.objects) {
        const auto& screen = std::get<Segment>(object.shape);
        draw_line(figure, {flat(screen.from), flat(screen.to)}, {.width = 4});
    }
    draw_dot(figure, {0, 0}, 6, examples::colors::orange);
    draw_label(figure, {1.2, 0}, std::to_string(arrived[0]));
    draw_label(figure, {-2.1, 0}, std::to_string(arrived[1]));
    draw_label(figure, {0.62, -0.5}, "r");
    draw_label(figure, {-1.2, -0.5}, "2r");
    save_drawing(folder, figure);
}

/// Directions by the cosine: even feet on the diameter, lifted to the half circle.
void draw_lambert(const std::string& folder) {
    Drawing figure{.name = "flatland-lambert",
                   .description =
                       "Even points of a diameter, lifted to the half circle",
                   .low{-1.3, -0.28},
                   .high{1.3, 1.1},
                   .scale = 240};
    draw_line(figure, {{-1.3, 0}, {1.3, 0}}, {.width = 2});
    draw_arc(figure, {0, 0}, 1, 0, pi);
    constexpr int count = 16;
    for (int i = 0; i < count; ++i) {
        const Vec2 d = sample_cosine_half_circle((i + 0.5) / count);
        draw_line(figure, {{d.x, 0}, flat(d)}, {.width = 0.8, .dashed = true});
        draw_arrow(figure, {0, 0}, flat(d), {examples::colors::orange, 1.2});
        draw_dot(figure, {d.x, 0}, 3, examples::colors::blue);
    }
    draw_label(figure, {-1, -0.14}, "−1");
    draw_label(figure, {1, -0.14}, "1");
    draw_label(figure, {0, -0.14}, "2u − 1");
    save_drawing(folder, figure);
}

/// Light from everywhere, in even steps of the sine, and how glass squeezes it.
void draw_squeeze(const std::string& folder) {
    Drawing figure{.name = "flatland-squeeze",
                   .description = "Rays from a half circle of air fill a narrow wedge "
                                  "of glass",
                   .low{-1.3, -1.05},
                   .high{1.3, 1.05},
                   .scale = 220};
    draw_area(figure, {{-1.3, 0}, {1.3, 0}, {1.3, -1.05}, {-1.3, -1.05}},
              examples::colors::blue);
    draw_line(figure, {{-1.3, 0}, {1.3, 0}});
    constexpr int count = 16;
    for (int i = 0; i < count; ++i) {
        const Vec2 wo = sample_cosine_half_circle((i + 0.5) / count);
        const auto in = sample(Glass{1.5}, wo, 0.999999, ljus::Transport::flux);
        draw_line(figure, {flat(wo), {0, 0}}, {examples::colors::orange, 1.2});
        draw_line(figure, {{0, 0}, flat(in->wi)}, {examples::colors::orange, 1.2});
    }
    draw_label(figure, {-1.05, 0.12}, "n_1 = 1");
    draw_label(figure, {-1.05, -0.13}, "n_2 = 1.5");
    save_drawing(folder, figure);
}

/// The disc at one point, for three k.
void draw_disc(const std::string& folder, const PhotonMap& map) {
    const double x = 0.5;
    Drawing figure{.name = "flatland-disc",
                   .description = "Three discs around a point of the floor, which hold "
                                  "5, 20 and 60 photons",
                   .low{x - 0.13, -0.065},
                   .high{x + 0.13, 0.075},
                   .scale = 2700};
    draw_line(figure, {{x - 0.13, 0}, {x + 0.13, 0}}, {.width = 2});
    for (const Photon& photon : map) {
        const Point at = flat(photon.position);
        if (photon.normal.y < 0.5 || std::abs(at.x - x) > 0.128) continue;
        const Vec2 from = photon.position - 0.012 * photon.direction;
        draw_line(figure, {flat(from), at}, {color_of(photon.kind), 0.8});
        draw_dot(figure, at, 3, color_of(photon.kind));
    }
    double below = -0.015;
    for (const std::size_t k : {5u, 20u, 60u}) {
        const Estimate found =
            estimate_irradiance(map, on_floor(x), {.radius = 1, .nearest = k});
        const double r = found.radius;
        draw_arc(figure, {x, 0}, r, 0, pi, {examples::colors::red, 1.5});
        draw_line(figure, {{x - r, below}, {x + r, below}}, {examples::colors::red, 3});
        draw_label(figure, {x + r + 0.016, below}, "k = " + std::to_string(k),
                   examples::colors::red);
        below -= 0.018;
    }
    draw_dot(figure, {x, 0}, 5, "currentColor");
    save_drawing(folder, figure);
}

/// Discs of one k at four points: small in the caustic, half outside at the wall.
void draw_places(const std::string& folder, const PhotonMap& map) {
    Drawing figure{.name = "flatland-places",
                   .description = "Discs that hold 40 photons at four places of the "
                                  "floor",
                   .low{-1.2, -0.24},
                   .high{1.15, 0.22},
                   .scale = 310};
    draw_line(figure, {{-1, 0.22}, {-1, 0}, {1, 0}, {1, 0.22}}, {.width = 2});
    for (const Photon& photon : map)
        if (photon.normal.y > 0.5)
            draw_dot(figure, flat(photon.position), 2, color_of(photon.kind));
    struct Place {
        double x;
        const char* name;
    };
    for (const Place& place : {Place{-1, "wall"}, Place{-0.45, "lamp above"},
                               Place{0.16, "shadow"}, Place{0.58, "caustic"}}) {
        const Estimate found =
            estimate_irradiance(map, on_floor(place.x), {.radius = 1, .nearest = 40});
        draw_arc(figure, {place.x, 0}, found.radius, 0, 2 * pi,
                 {examples::colors::red, 1.5});
        draw_label(figure, {place.x, -0.2}, place.name);
    }
    save_drawing(folder, figure);
}

// --- Along the floor -----------------------------------------------------------------

constexpr int bins = 200;

/// The irradiance along the floor of the room, by counting many photons in bins.
std::vector<double> count_floor(const Scene& scene, long long photons) {
    std::vector<double> irradiance(bins);
    const double each = flux(scene) / double(photons) / (2.0 / bins);
    for (long long i = 0; i < photons; ++i) {
        auto stream = ljus::random_stream(77, ljus::Pass::general_photons, 0,
                                          static_cast<std::uint64_t>(i));
        trace_photon(scene, emit_photon(scene, each, stream), stream, 1000,
                     [&](const PathState& path, const Vertex& vertex) {
                         if (vertex.id != 0) return;
                         const double at = (vertex.point.position.x + 1) / 2 * bins;
                         irradiance[std::size_t(std::clamp(int(at), 0, bins - 1))] +=
                             path.throughput;
                     });
    }
    return irradiance;
}

/// Plots: one map, and the mean over many maps, beside the truth.
void plot_floor(const std::string& folder, const Scene& scene,
                const std::vector<double>& truth, int photons, int maps) {
    examples::Plot one{.name = "flatland-floor",
                       .columns = {"x, m", "many photons counted in parts of 1 cm",
                                   "one map by k = 40", "one map by the radius 0.05 m"},
                       .y_label = "irradiance, W/m"};
    examples::Plot bias{.name = "flatland-bias",
                        .columns = {"x, m", "many photons counted in parts of 1 cm",
                                    "mean of many maps by k = 40",
                                    "mean of many maps by k = 400"},
                        .y_label = "irradiance, W/m"};
    bias.notes = {std::to_string(photons) + " photons per map, " +
                  std::to_string(maps) + " maps."};
    const auto by = [](const PhotonMap& map, double x, double radius, std::size_t k) {
        return estimate_irradiance(map, on_floor(x), {.radius = radius, .nearest = k})
            .irradiance;
    };
    const auto place = [](int i) { return -1 + 2 * (i + 0.5) / bins; };
    std::vector<std::array<double, 2>> mean(bins);
    for (int m = 0; m < maps; ++m) {
        examples::stop_if_asked();
        const PhotonMap map = trace_photons(
            scene, {.photons = photons, .seed = 100 + static_cast<std::uint64_t>(m)});
        for (int i = 0; i < bins; ++i) {
            const double x = place(i), sharp = by(map, x, 0.5, 40);
            mean[std::size_t(i)][0] += sharp / maps;
            mean[std::size_t(i)][1] += by(map, x, 0.5, 400) / maps;
            if (m == 0)
                one.rows.push_back(
                    {x, truth[std::size_t(i)], sharp, by(map, x, 0.05, 0)});
        }
    }
    for (int i = 0; i < bins; ++i)
        bias.rows.push_back({place(i), truth[std::size_t(i)], mean[std::size_t(i)][0],
                             mean[std::size_t(i)][1]});
    save_plot(folder, one);
    save_plot(folder, bias);
}

// --- The trade -----------------------------------------------------------------------

/// A lamp at height 1 above a black floor: E = h / (2 pi (x^2 + h^2)) for 1 W.
double irradiance_under(double x) {
    return 1 / (2 * pi * (x * x + 1));
}

/// The error over k, for several numbers of photons: points within half a metre of the
/// middle, many maps. Relative, root mean square.
void plot_trade(const std::string& folder, const std::vector<int>& counts, int maps) {
    const Circle lamp{.center{0, 1}, .radius = 0.02};
    const Scene scene{{{Segment{.from{-3, 0}, .to{3, 0}}, Lambertian{0}},
                       {lamp, Lambertian{0}, radiance_of(lamp, 1)}}};
    examples::Plot plot{.name = "flatland-trade",
                        .columns = {"k"},
                        .y_label = "relative error of the irradiance",
                        .log_x = true,
                        .log_y = true};
    std::vector<std::size_t> ks;
    for (double k = 4; k < 40000; k *= 1.5) ks.push_back(std::size_t(k));
    for (const std::size_t k : ks) plot.rows.push_back({double(k)});
    for (const int photons : counts) {
        plot.columns.push_back(std::to_string(photons) + " photons");
        std::vector<double> squares(ks.size());
        constexpr int points = 11;
        for (int m = 0; m < maps; ++m) {
            examples::stop_if_asked();
            const PhotonMap map = trace_photons(
                scene, {.photons = photons, .seed = 7 + static_cast<std::uint64_t>(m)});
            for (std::size_t i = 0; i < ks.size(); ++i)
                for (int p = 0; p < points; ++p) {
                    const double x = -0.5 + double(p) / (points - 1);
                    const double e =
                        estimate_irradiance(map, on_floor(x),
                                            {.radius = 3, .nearest = ks[i]})
                            .irradiance;
                    const double part = e / irradiance_under(x) - 1;
                    squares[i] += part * part / (points * maps);
                }
        }
        for (std::size_t i = 0; i < ks.size(); ++i) {
            // A third of the photons come to the floor near the lamp.
            const bool enough = 4 * ks[i] < std::size_t(photons);
            plot.rows[i].push_back(enough ? std::sqrt(squares[i]) : std::nan(""));
        }
    }
    save_plot(folder, plot);
}

/// Plot: the floor under a lamp, as four mistakes have it.
void plot_mistakes(const std::string& folder, int photons) {
    const double height = 0.5, radius = 0.25;
    const Circle lamp{.center{0, height}, .radius = 0.02};
    const Scene scene{{{Segment{.from{-3, 0}, .to{3, 0}}, Lambertian{0}},
                       {lamp, Lambertian{0}, radiance_of(lamp, 1)}}};
    const PhotonMap map = trace_photons(scene, {.photons = photons});
    examples::Plot plot{.name = "flatland-mistakes",
                        .columns = {"x, m", "right", "with the square of the distance",
                                    "with a second cosine",
                                    "over the area of the disc"},
                        .y_label = "irradiance, W/m"};
    for (int i = -50; i <= 50; ++i) {
        const double x = i / 50.0, r = std::hypot(x, height);
        const double right = height / r / (2 * pi * r);
        const double found =
            estimate_irradiance(map, on_floor(x), {.radius = radius}).irradiance;
        plot.rows.push_back({x, right, right / r, right * height / r,
                             found * 2 * radius / (pi * radius * radius)});
    }
    save_plot(folder, plot);
}

} // namespace

/// Makes the chapter's figures.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long reference = 0;
        int maps = 0;
        line.about("Chapter 23, Flatland: its drawings and plots.");
        line.add("--photons", reference, "Photons of the reference along the floor",
                 1000, 1000000000);
        line.add("--maps", maps, "Photon maps of which the mean is taken", 1, 10000);
        line.without({"--width", "--height", "--rays", "--seed", "--threads"});
        const examples::Options options = line.parse();
        if (!line.given("--photons"))
            reference = options.pick(300000, 20000000, 100000000);
        if (!line.given("--maps")) maps = options.pick(10, 100, 400);
        const std::string& folder = options.out;

        const Scene scene = make_room();
        draw_falloff(folder);
        draw_lambert(folder);
        draw_squeeze(folder);
        const PhotonMap small = trace_photons(scene, {.photons = 800});
        draw_disc(folder, trace_photons(scene, {.photons = 3000}));
        draw_places(folder, small);
        plot_floor(folder, scene, count_floor(scene, reference), 3000, maps);
        plot_trade(folder, {1000, 10000, 100000}, maps);
        plot_mistakes(folder, 100000);
    });
}
