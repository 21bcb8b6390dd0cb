// smoke: --quality draft --width 16 --height 16 --rays 1 --most 4 --runs 3 --paths 50
/// \file chapters/experiments/20_experiments.cpp
/// \brief Chapter 20: the experiments behind its tables, plots and pictures: how paths find
/// the lamp, and roulette.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scene/camera.hpp>
#include <ljus/scenes/cornell_box.hpp>
#include <ljus/scenes/furnaces.hpp>

#include "common/example.hpp"
#include "experiments/veach_plates.hpp"

namespace {

using examples::rendered;
using examples::text;
using ljus::Image;
using ljus::MisHeuristic;
using ljus::PathTracingSettings;
using ljus::Quad;
using ljus::Rgb;
using ljus::Sphere;
using ljus::Vec3;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The options of this program, besides the common ones.
struct Sizes {
    int most = 0;  ///< Most rays per pixel in the curves of noise.
    int runs = 0;  ///< Of roulette with a constant probability.
    int paths = 0; ///< Per run.
};

// --- Scenes ---------------------------------------------------------------------------

using Matt = ljus::Scene<ljus::Shapes<Quad, Sphere>, ljus::Materials<ljus::Lambertian>>;

/// A room with only diffuse surfaces, its front open.
ljus::Room<Matt> matt_room() {
    Matt scene;
    ljus::add_cornell_walls(scene);
    const auto grey = scene.add(ljus::Lambertian{.albedo = Rgb{0.75f}});
    const auto black = scene.add(ljus::Lambertian{.albedo = Rgb{0}});
    scene.add(Sphere{{-0.42f, 0.38f, -0.3f}, 0.38f}, grey);
    scene.add(Sphere{{0.42f, 0.38f, 0.3f}, 0.38f}, grey);
    scene.add(Quad{{-0.25f, 1.99f, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f}}, black,
              Rgb{17, 13, 8});
    return {ljus::World(std::move(scene)), ljus::cornell_box().camera};
}

/// The camera of all measurements of noise: it does not see the lamp, whose edge is
/// noisier than everything else.
ljus::Camera low_camera() {
    return ljus::look_at(
        {.position{0, 1, 4.4f}, .target{0, 0.6f, 0}, .vfov_degrees = 22});
}

// --- Noise ----------------------------------------------------------------------------

/// The noise of a renderer, from two pictures with different seeds: it needs no
/// reference.
struct Noise {
    double rms = 0;     ///< Of one picture.
    double rays = 0;    ///< Of all kinds, per camera ray.
    double seconds = 0; ///< Of processor time, for both.
    Image image{};      ///< The first.
    Image other{};      ///< The second.
};
template <typename Renderer>
Noise noise_of(const Renderer& renderer, const ljus::Camera& camera,
               ljus::RenderSettings picture, const examples::Options& options) {
    const double start = examples::processor_seconds();
    const auto a = rendered("noise", renderer, camera, picture, options);
    picture.seed += 1000;
    const auto b = rendered("noise", renderer, camera, picture, options);
    return {.rms = rmse(a.image, b.image) / std::sqrt(2.0),
            .rays = double(a.counts.rays()) / double(a.counts.camera_rays),
            .seconds = examples::processor_seconds() - start,
            .image = a.image,
            .other = b.image};
}
void print(const examples::Table& table, const examples::Options& options) {
    if (options.quiet) return;
    std::printf("\n%s\n", table.name.c_str());
    for (const auto& heading : table.columns) std::printf("%s | ", heading.c_str());
    std::printf("\n");
    for (const auto& row : table.rows) {
        for (const auto& cell : row) std::printf("%s | ", cell.c_str());
        std::printf("\n");
    }
}

// --- Who finds the lamp ---------------------------------------------------------------

struct Way {
    const char *name, *file;
    PathTracingSettings settings{};
};
const std::array ways{
    Way{"paths alone", "paths", {.sample_lights = false}},
    Way{"shadow rays alone", "shadow", {.heuristic = MisHeuristic::shadow_rays}},
    Way{"both by balance", "balance"},
    Way{"both by power", "power", {.heuristic = MisHeuristic::power}}};
/// Plot and table: the noise of each way in the diffuse room, against rays.
void in_the_room(const examples::Options& options, const Sizes& sizes) {
    const auto room = matt_room();
    const int side = options.pick(48, 80, 120);
    examples::Plot plot{.name = "path_tracing-noise",
                        .columns = {"camera rays per pixel", ways[0].name, ways[1].name,
                                    ways[2].name, "slope -1/2"},
                        .y_label = "RMS noise, W/(m^2 sr)",
                        .log_x = true,
                        .log_y = true};
    for (int rays = 1; rays <= sizes.most; rays *= 4)
        plot.rows.push_back({double(rays), nothing, nothing, nothing, nothing});
    examples::Table table{.name = "path_tracing-ways",
                          .columns = {"way", "rays per camera ray", "slope", "noise",
                                      "efficiency by rays", "by time"}};
    double first_rms = 0, first_by_rays = 0, first_by_time = 0;
    for (std::size_t way = 0; way < 3; ++way) {
        const ljus::PathTracer tracer(room.world, ways[way].settings);
        Noise last;
        for (auto& row : plot.rows) {
            last = noise_of(tracer, low_camera(),
                            {side, side, int(row[0]), options.seed}, options);
            row[1 + way] = last.rms;
        }
        const auto& rows = plot.rows;
        const double slope = std::log(rows.back()[1 + way] / rows[0][1 + way]) /
                             std::log(rows.back()[0] / rows[0][0]);
        const double variance = last.rms * last.rms;
        const double by_rays = 1 / (variance * last.rays);
        const double by_time = 1 / (variance * last.seconds);
        if (way == 0)
            first_rms = last.rms, first_by_rays = by_rays, first_by_time = by_time;
        table.rows.push_back({ways[way].name, text(last.rays, "%.2f"),
                              text(slope, "%.3f"), text(last.rms / first_rms, "%.4f"),
                              text(by_rays / first_by_rays, "%.1f"),
                              text(by_time / first_by_time, "%.1f")});
    }
    for (auto& row : plot.rows) row[4] = plot.rows[0][2] / (2 * std::sqrt(row[0]));
    save_plot(options.path(""), plot);
    save_table(options.path(""), table);
    print(table, options);
}

/// Pictures: a box whose walls all shine, so that lamps are infinitely close to its
/// edges.
void in_the_box(const examples::Options& options) {
    const auto room = ljus::box_furnace(Rgb{0.25f}, Rgb{0.5f});
    for (std::size_t way = 0; way < 3; ++way)
        save_png(
            rendered("box", ljus::PathTracer(room.world, ways[way].settings),
                     room.camera, options)
                .image,
            options.path(std::string("path_tracing-box-") + ways[way].file + ".png"));
}

/// A path log that sums the light of one owner.
struct OwnerLog {
    std::string_view owner;
    Rgb sum{0};
    void begin() noexcept {}
    void vertex(char, const Vec3&, const Rgb&, float) noexcept {}
    void term(std::string_view who, std::string_view, const Rgb& value) noexcept {
        if (who == owner) sum += value;
    }
};

template <typename Renderer>
struct OneOwner {
    using Stream = typename Renderer::Stream;
    Renderer whole;
    std::string_view owner;
};

template <typename Renderer>
OneOwner<Renderer> part_of(const Renderer& whole, std::string_view owner) {
    return {whole, owner};
}

template <typename Renderer>
Rgb radiance(const OneOwner<Renderer>& one, const ljus::Ray& ray, auto& context) {
    OwnerLog log{.owner = one.owner};
    auto told = ljus::context_of(context.stream, context.counts, log);
    (void)radiance(one.whole, ray, told);
    return log.sum;
}

/// The relative noise where the plates mirror the lamps: plate by plate, lamp by lamp.
template <typename World>
std::array<std::array<double, 4>, 4>
noise_on_plates(const World& world, const ljus::Camera& camera, const Noise& noise) {
    std::array<std::array<double, 4>, 4> squares{}, sums{}, counts{};
    const Image& image = noise.image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const auto ray = primary_ray(camera, {float(x) + 0.5f, float(y) + 0.5f},
                                         image.width, image.height);
            const auto hit = closest_hit(world, ray);
            if (!hit || hit->object.type != 0 || hit->object.index >= 4) continue;
            const float across = ray.origin.x + hit->at.t * ray.direction.x;
            const auto lamp = std::size_t(std::clamp((across + 4) / 2, 0.0f, 3.0f));
            const Rgb a = pixel(image, x, y), b = pixel(noise.other, x, y);
            squares[hit->object.index][lamp] += double(dot(a - b, a - b)) / 6;
            sums[hit->object.index][lamp] += double(a.x + a.y + a.z) / 3;
            counts[hit->object.index][lamp] += 1;
        }
    for (std::size_t plate = 0; plate < 4; ++plate)
        for (std::size_t lamp = 0; lamp < 4; ++lamp)
            squares[plate][lamp] =
                std::sqrt(squares[plate][lamp] * counts[plate][lamp]) /
                sums[plate][lamp];
    return squares;
}

/// Table and pictures: Veach's plates by each way, and the two parts of the weighted
/// sum.
void on_the_plates(const examples::Options& options) {
    const auto room = examples::veach_plates();
    const ljus::RenderSettings picture{options.width,
                                       std::max(1, options.width * 2 / 3),
                                       options.samples, options.seed};
    std::array<std::array<std::array<double, 4>, 4>, 4> noise{};
    for (std::size_t way = 0; way < ways.size(); ++way) {
        PathTracingSettings settings = ways[way].settings;
        settings.max_depth = 1;
        const ljus::PathTracer tracer(room.world, settings);
        const Noise here = noise_of(tracer, room.camera, picture, options);
        noise[way] = noise_on_plates(room.world, room.camera, here);
        const std::string file = std::string("path_tracing-plates-") + ways[way].file;
        save_png(here.image, options.path(file + ".png"));
        if (way != 2) continue;
        for (const auto& [owner, name] : {std::array{"shadow ray", "of-shadow"},
                                          std::array{"emission", "of-paths"}})
            save_png(rendered("shares", part_of(tracer, owner), room.camera, picture,
                              options)
                         .image,
                     options.path(std::string("path_tracing-plates-") + name + ".png"));
    }
    examples::Table table{.name = "path_tracing-plates",
                          .columns = {"roughness of the plate", "radius of the lamp",
                                      "paths", "shadow rays", "balance", "power"}};
    for (std::size_t plate = 0; plate < 4; ++plate)
        for (std::size_t lamp = 0; lamp < 4; ++lamp) {
            table.rows.push_back(
                {text(double(examples::plate_roughness[plate]), "%.2f"),
                 text(double(examples::lamp_radius[lamp]), "%.2g")});
            for (const auto& way : noise)
                table.rows.back().push_back(text(100 * way[plate][lamp], "%.0f %%"));
        }
    save_table(options.path(""), table);
    print(table, options);
}

// --- Where paths end ------------------------------------------------------------------

ljus::Ray in_furnace(ljus::RandomStream& stream) {
    return {.origin{0.1f, 0.2f, -0.1f},
            .direction = ljus::sample_uniform_sphere(next_2d(stream))};
}

/// The mean of many paths, and their cost.
struct Mean {
    double mean = 0;
    double variance = 0; ///< Of one path.
    double surfaces = 0; ///< That a path meets.
};

/// The radiance in a furnace, by paths.
Mean furnace_mean(float albedo, const PathTracingSettings& settings, int paths,
                  std::uint64_t seed) {
    const auto room = ljus::sphere_furnace(Rgb{1}, Rgb{albedo});
    const ljus::PathTracer tracer(room.world, settings);
    ljus::Counts counts;
    double sum = 0, squares = 0;
    for (int path = 0; path < paths; ++path) {
        auto stream = random_stream(seed, ljus::Pass::user, 0, std::uint64_t(path));
        const auto ray = in_furnace(stream);
        auto context = ljus::context_of(stream, counts);
        const double seen = double(radiance(tracer, ray, context).x);
        sum += seen;
        squares += seen * seen;
    }
    examples::stop_if_asked();
    const double mean = sum / paths;
    return {mean, (squares / paths - mean * mean) * paths / std::max(1, paths - 1),
            1 + double(counts.bounce_rays) / paths};
}

/// The variance of a path in a furnace of emission 1, if it continues with a constant
/// probability p.
double furnace_variance(double rho, double p) {
    const double r = rho / p, s = rho * rho / p, mean = 1 / (1 - rho);
    if (s > 1 - 1e-6) return nothing;
    if (std::abs(r - 1) < 1e-9) return p / ((1 - p) * (1 - p));
    return 1 / (1 - s) + 2 / (r - 1) * (1 / (1 - s) - mean) - mean * mean;
}

PathTracingSettings constant_chance(double p) {
    return {.roulette_depth = 1,
            .sample_lights = false,
            .roulette_threshold = 1e-30,
            .roulette_max = p};
}

/// Table: a constant probability, for which the variance has a closed form or is
/// infinite.
void constant_chances(const examples::Options& options, const Sizes& sizes) {

    examples::Table table{
        .name = "path_tracing-catastrophe",
        .columns = {"chance p", "surfaces per path", "standard deviation of a path",
                    "median of the runs (truth: 10)", "runs that are too low",
                    "truth within 2 of a run's own standard errors"}};
    for (const double p : {0.3, 0.5, 0.7, 0.85, 0.9, 0.95}) {
        std::vector<double> means;
        double low = 0, within = 0, surfaces = 0;
        for (int run = 0; run < sizes.runs; ++run) {
            const Mean seen =
                furnace_mean(0.9f, constant_chance(p), sizes.paths,
                             options.seed + 10 + static_cast<std::uint64_t>(run));
            means.push_back(seen.mean);
            low += seen.mean < 10 ? 1 : 0;
            within +=
                std::abs(seen.mean - 10) < 2 * std::sqrt(seen.variance / sizes.paths)
                    ? 1
                    : 0;
            surfaces += seen.surfaces / sizes.runs;
        }
        std::sort(means.begin(), means.end());
        const double variance = furnace_variance(0.9, p);
        table.rows.push_back(
            {text(p, "%.2f"), text(surfaces, "%.1f"),
             std::isnan(variance) ? "no end" : text(std::sqrt(variance), "%.1f"),
             text(means[means.size() / 2], "%.2f"),
             text(100 * low / sizes.runs, "%.0f %%"),
             text(100 * within / sizes.runs, "%.0f %%")});
    }
    save_table(options.path(""), table);
    print(table, options);
}

/// A roulette: the probability of surviving is throughput / threshold, at most `most`.
struct RouletteCase {
    std::string name;
    double threshold, most;
    int from = 1; ///< The first surface with roulette.
    [[nodiscard]] PathTracingSettings settings() const {
        return {.roulette_depth = from,
                .roulette_threshold = threshold,
                .roulette_max = most};
    }
};

std::vector<RouletteCase> roulette_cases() {
    std::vector<RouletteCase> cases{{"1: no roulette", 0, 1}};
    for (const double threshold : {0.05, 0.1, 0.2, 0.4, 0.7, 1.0, 2.0, 4.0, 10.0, 40.0})
        cases.push_back({"throughput / " + text(threshold), threshold, 1});
    for (const double most : {0.9, 0.7, 0.5, 0.3, 0.1})
        cases.push_back({text(most), 1e-30, most});
    cases.push_back({"throughput from surface 4 on", 1, 1, 4});
    return cases;
}

double efficiency_by_rays(const Noise& n) {
    return 1 / (n.rms * n.rms * n.rays);
}

double efficiency_by_time(const Noise& n) {
    return 1 / (n.rms * n.rms * std::max(n.seconds, 1e-6));
}

/// Plot and table: the efficiency of each roulette.
/// \param usual  The noise of the threshold 1, with which the others are compared.
void save_roulettes(const std::vector<RouletteCase>& cases,
                    const std::vector<Noise>& noises, const Noise& usual,
                    const examples::Options& options) {
    examples::Plot plot{.name = "path_tracing-roulette",
                        .columns = {"threshold", "by rays", "by time", "no roulette"},
                        .y_label = "efficiency, 1 / (variance x cost); 1: threshold 1",
                        .log_x = true,
                        .more = "set yrange [0:*]\n"};
    examples::Table table{.name = "path_tracing-roulette-table",
                          .columns = {"chance to go on", "rays per camera ray",
                                      "RMS noise", "efficiency by rays", "by time"}};
    const double none = efficiency_by_rays(noises[0]) / efficiency_by_rays(usual);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double rays = efficiency_by_rays(noises[i]) / efficiency_by_rays(usual);
        const double time = efficiency_by_time(noises[i]) / efficiency_by_time(usual);
        table.rows.push_back({cases[i].name, text(noises[i].rays, "%.2f"),
                              text(noises[i].rms, "%.4f"), text(rays, "%.2f"),
                              text(time, "%.2f")});
        if (cases[i].threshold >= 0.05 && cases[i].from == 1)
            plot.rows.push_back({cases[i].threshold, rays, time, none});
    }
    save_plot(options.path(""), plot);
    save_table(options.path(""), table);
    print(table, options);
}

/// Roulette in the room: its efficiency, and two pictures.
void roulette(const examples::Options& options, const Sizes& sizes) {
    const auto room = matt_room();
    const int side = options.pick(48, 80, 120);
    const std::vector<RouletteCase> cases = roulette_cases();
    std::vector<Noise> noises;
    for (const RouletteCase& c : cases)
        noises.push_back(noise_of(ljus::PathTracer(room.world, c.settings()),
                                  low_camera(), {side, side, sizes.most, options.seed},
                                  options));
    const Noise& usual = noises[6];                // threshold 1
    const Noise& rash = noises[noises.size() - 2]; // a probability of 0.1
    save_roulettes(cases, noises, usual, options);

    // Both pictures take the same number of rays of all kinds.
    const double rays = usual.rays / rash.rays * options.samples;
    const auto save = [&](const char* file, const PathTracingSettings& settings,
                          int count) {
        save_png(rendered("roulette", ljus::PathTracer(room.world, settings),
                          room.camera,
                          {options.width, options.height, count, options.seed}, options)
                     .image,
                 options.path(file));
    };
    save("path_tracing-roulette-usual.png", {.roulette_depth = 1}, options.samples);
    save("path_tracing-roulette-rash.png",
         {.roulette_depth = 1, .roulette_threshold = 1e-30, .roulette_max = 0.1},
         std::max(1, int(std::lround(rays))));
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about(
            "Chapter 20, path tracing: who finds the lamp, and where paths end.");
        line.add("--most", sizes.most, "Most rays per pixel in a curve; 0: by quality",
                 0, 1 << 16);
        line.add("--runs", sizes.runs, "Runs per constant chance; 0: by quality", 0,
                 10000);
        line.add("--paths", sizes.paths, "Paths per run; 0: by quality", 0, 10000000);
        const examples::Options options =
            line.parse({.draft{.width = 120, .height = 120, .samples = 9},
                        .report{.width = 400, .height = 400, .samples = 64},
                        .reference{.width = 480, .height = 480, .samples = 1024}});
        if (sizes.most == 0) sizes.most = options.pick(16, 256, 1024);
        if (sizes.runs == 0) sizes.runs = options.pick(21, 101, 1001);
        if (sizes.paths == 0) sizes.paths = options.pick(1000, 10000, 10000);
        in_the_room(options, sizes);
        in_the_box(options);
        on_the_plates(options);
        constant_chances(options, sizes);
        roulette(options, sizes);
    });
}
