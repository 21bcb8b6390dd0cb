// smoke: --quality draft --rays 4 --shots 20000 --pixels 24
/// \file chapters/experiments/02_experiments.cpp
/// \brief Chapter 2: the experiments behind its tables and plots: flux, irradiance and
/// radiance, each counted with rays; and what filters make of a pixel.

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/inspect/estimate.hpp>
#include <ljus/ljus.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/convergence.hpp"
#include "common/plot.hpp"
#include "common/terminal.hpp"
#include "experiments/middle_rays.hpp"

namespace {

using examples::text;
using ljus::Estimate;
using ljus::Filter;
using ljus::Rgb;
using Vec = ljus::Vec3T<double>;
using Quad = ljus::QuadT<double>;
using Sphere = ljus::SphereT<double>;
using Ray = ljus::RayT<double>;

constexpr double pi = std::numbers::pi;

/// The options of this program, besides the common ones.
struct Sizes {
    int shots = 0;  ///< Rays for each count.
    int pixels = 0; ///< Side of the rings.
};

// --- Counting rays --------------------------------------------------------------------

/// The fraction of random directions from a point for which `hits` is true.
template <typename Hits>
Estimate count(const Vec& from, int shots, std::uint64_t seed, Hits hits) {
    auto stream = ljus::random_stream(seed, ljus::Pass::user, 0, 0);
    Estimate share;
    for (int i = 0; i < shots; ++i) {
        const Ray ray{.origin = from,
                      .direction =
                          ljus::sample_uniform_sphere(next_2d<double>(stream))};
        add(share, hits(ray) ? 1.0 : 0.0);
    }
    return share;
}

/// A square patch of side 0.25 at a distance from the origin along x, tilted.
Quad patch_at(double distance, double degrees) {
    constexpr double side = 0.25;
    const double a = degrees * pi / 180;
    const Vec u = side * Vec{std::sin(a), std::cos(a), 0}, v{0, 0, side};
    return {.corner = Vec{distance, 0, 0} - 0.5 * (u + v), .edge_u = u, .edge_v = v};
}

/// The irradiance of that patch by a lamp of 100 W at the origin, by counting.
// [count]
Estimate irradiance_counted(const Quad& patch, int shots, std::uint64_t seed) {
    constexpr double flux = 100; // of the lamp, W, in as many rays
    Estimate found = count({0, 0, 0}, shots, seed, [&](const Ray& ray) {
        return ljus::intersect(ray, patch).has_value();
    });
    const double each = flux / area(patch); // W/m^2, if all rays went there
    return {found.count, each * found.mean, each * each * found.squares};
}
// [count]

/// Plots: a patch at changing distance, and at changing tilt.
void count_on_patches(const std::string& folder, int shots) {
    examples::Plot far{.name = "radiance-distance",
                       .columns = {"distance r (m)", "counted", "100 W / (4 pi r^2)"},
                       .y_label = "irradiance (W/m^2)",
                       .log_x = true,
                       .log_y = true};
    for (const double r : {0.5, 1.0, 2.0, 4.0, 8.0}) {
        const Estimate e = irradiance_counted(patch_at(r, 0), shots, 11);
        const double right = 100 / (4 * pi * r * r);
        far.rows.push_back({r, e.mean, right});
    }
    save_plot(folder, far);

    examples::Plot tilt{.name = "radiance-tilt",
                        .columns = {"tilt (degrees)", "counted", "cosine"},
                        .y_label = "irradiance over that at 0 degrees"};
    const double facing = 100 / (4 * pi * 2 * 2);
    for (int degrees = 0; degrees <= 90; degrees += 10) {
        const Estimate e = irradiance_counted(patch_at(2, degrees), shots, 12);
        tilt.rows.push_back(
            {double(degrees), e.mean / facing, std::cos(degrees * pi / 180)});
    }
    save_plot(folder, tilt);
}

/// Plot: a square lamp of side 1 is no point. Both laws, and Lambert's closed form.
void near_the_lamp(const std::string& folder) {
    examples::Plot plot{
        .name = "radiance-near",
        .columns = {"distance over the lamp's side", "inverse square over the truth"},
        .y_label = "ratio",
        .log_x = true,
        .log_y = true};
    for (int i = -8; i <= 12; ++i) {
        const double r = std::pow(10.0, i / 8.0);
        const Quad lamp{{-0.5, r, -0.5}, {1, 0, 0}, {0, 0, 1}};
        const double truth =
            pi * *form_factor_from(Vec{0, 0, 0}, Vec{0, 1, 0}, lamp, false);
        plot.rows.push_back({r, 1 / (r * r) / truth});
    }
    save_plot(folder, plot);
}

// --- The trade: four ways to an irradiance --------------------------------------------

/// A ball of radius 0.25 and radiance 100 over a patch of the floor, to its side.
struct Lamp {
    Sphere ball{.center{1, 2, 0}, .radius = 0.25};
    double radiance = 100;

    /// Irradiance of a point of the floor, in closed form.
    [[nodiscard]] double at(const Vec& point) const {
        return pi * radiance * *form_factor_from(point, Vec{0, 1, 0}, ball, false);
    }
};

/// A sample of the irradiance at the origin, or over a small patch, by one of the ways.
enum Way { from_lamp, uniform, by_cosine, to_lamp, ways };
constexpr const char* way_names[] = {"rays from the lamp", "uniform directions",
                                     "cosine-weighted directions",
                                     "directions to the lamp"};

double sample_irradiance(Way way, const Lamp& lamp, ljus::RandomStream& stream) {
    const auto up = [](const Vec& z) { return Vec{z.x, z.z, -z.y}; }; // z to y
    const auto u = next_2d<double>(stream);
    if (way == from_lamp) {
        // A point of the lamp, a direction by the cosine; is the patch hit?
        constexpr double side = 0.25;
        const auto start = ljus::sample_area(lamp.ball, u);
        const auto frame = ljus::frame_around(start.normal);
        const Vec d =
            to_world(frame, ljus::sample_cosine_hemisphere(next_2d<double>(stream)));
        if (d.y >= 0) return 0;
        const Vec p = start.position - d * (start.position.y / d.y);
        const bool hit = std::abs(p.x) < side / 2 && std::abs(p.z) < side / 2;
        const double flux = pi * lamp.radiance * area(lamp.ball);
        return hit ? flux / (side * side) : 0;
    }
    if (way == to_lamp) {
        const auto found = ljus::sample_towards(lamp.ball, Vec{0, 0, 0}, u);
        const double cosine = glm::normalize(found.point.position).y;
        return lamp.radiance * cosine / found.pdf;
    }
    const Vec z = way == uniform ? ljus::sample_uniform_hemisphere(u)
                                 : ljus::sample_cosine_hemisphere(u);
    const double pdf = way == uniform ? ljus::pdf_uniform_hemisphere(z)
                                      : ljus::pdf_cosine_hemisphere(z);
    const Ray ray{.origin{0, 0, 0}, .direction = up(z)};
    return ljus::intersect(ray, lamp.ball) ? lamp.radiance * z.z / pdf : 0;
}

/// Plot: relative error against processor time.
void trade(const std::string& folder, int most, int seeds) {
    const Lamp lamp;
    double over_patch = 0; // the first way has a patch, the others a point
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            over_patch +=
                lamp.at({(i - 9.5) / 20 * 0.25, 0, (j - 9.5) / 20 * 0.25}) / 400;
    examples::Plot plot{.name = "radiance-trade",
                        .columns = {"processor time (microseconds)"},
                        .y_label = "relative error of the irradiance",
                        .log_x = true,
                        .log_y = true};
    for (const char* name : way_names) plot.columns.emplace_back(name);
    for (std::size_t way = 0; way < ways; ++way) {
        const auto w = static_cast<Way>(way);
        const double truth = w == from_lamp ? over_patch : lamp.at({0, 0, 0});
        auto clock_stream = ljus::random_stream(1, ljus::Pass::user, 1, 0);
        const double ns = examples::nanoseconds_a_call(20000.0, [&] {
            double sum = 0;
            for (int i = 0; i < 20000; ++i)
                sum += sample_irradiance(w, lamp, clock_stream);
            return sum;
        });
        Estimate one;
        for (int n = 64; n <= most; n *= 4) {
            double squares = 0;
            for (int seed = 0; seed < seeds; ++seed) {
                auto stream = ljus::random_stream(std::uint64_t(seed + 1),
                                                  ljus::Pass::user, way, 0);
                Estimate mean;
                for (int i = 0; i < n; ++i)
                    add(mean, sample_irradiance(w, lamp, stream));
                squares += std::pow(mean.mean / truth - 1, 2) / seeds;
                if (4 * n > most) one = joined(one, mean);
            }
            examples::Row row(ways + 1, std::nan(""));
            row[0] = n * ns / 1000;
            row[way + 1] = std::sqrt(squares);
            plot.rows.push_back(row);
        }
        const double deviation = std::sqrt(variance(one)) / truth;
        std::printf("%-28s %s of the truth, %.3g per sample, %.0f ns\n", way_names[way],
                    text(one.mean / truth, "%.4f").c_str(), deviation, ns);
        examples::stop_if_asked();
    }
    save_plot(folder, plot);
}

// --- Filters --------------------------------------------------------------------------

constexpr Filter filters[] = {Filter::box, Filter::tent, Filter::gaussian,
                              Filter::mitchell};
constexpr const char* filter_names[] = {"box", "tent", "Gaussian", "Mitchell"};

/// How much of a wave a filter passes; the frequency is in cycles per pixel.
double passed(Filter filter, double frequency) {
    constexpr int steps = 4000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = (i + 0.5) / steps * 4 - 2;
        sum += ljus::filter_weight(filter, x) * std::cos(2 * pi * frequency * x);
    }
    return sum * 4 / steps;
}

/// A renderer of rings that become finer outwards.
struct Card {
    using Stream = ljus::RandomStream;
    double frequency = 2; ///< In cycles per pixel, at the picture's edge.
    double half = 1;      ///< Pixels from the middle of the picture to its edge.
};
template <typename Context>
Rgb radiance(const Card& card, const ljus::Ray& ray, Context&) {
    const double x = double(ray.direction.x / -ray.direction.z) * card.half;
    const double y = double(ray.direction.y / -ray.direction.z) * card.half;
    const double value = std::cos(pi * card.frequency * (x * x + y * y) / card.half);
    return Rgb(float(0.5 + 0.5 * value));
}

/// The picture of a card, with the camera straight before it.
ljus::Image picture_of(const Card& card, Filter filter, int samples, int pixels,
                       const examples::Options& options) {
    const auto camera = ljus::look_at({.vfov_degrees = 90});
    return render(card, camera,
                  {.width = pixels,
                   .height = pixels,
                   .samples = samples,
                   .seed = options.seed,
                   .threads = options.threads,
                   .filter = filter})
        .image;
}

/// Plots: the weights of the filters, and what passes of each frequency.
void plot_filters(const std::string& folder) {
    examples::Plot weights{.name = "radiance-filters",
                           .columns = {"distance from the pixel's middle (pixels)"},
                           .y_label = "weight"};
    examples::Plot response{.name = "radiance-response",
                            .columns = {"cycles per pixel"},
                            .y_label = "amplitude that passes",
                            .more =
                                "set arrow from 0.5, graph 0 to 0.5, graph 1 nohead "
                                "dt 2 lc rgb '#808080'\n"};
    for (const char* name : filter_names) {
        weights.columns.emplace_back(name);
        response.columns.emplace_back(name);
    }
    for (int i = -55; i <= 55; ++i) {
        examples::Row row{i * 0.04};
        for (const Filter filter : filters)
            row.push_back(ljus::filter_weight(filter, row[0]));
        weights.rows.push_back(row);
    }
    for (int i = 0; i <= 100; ++i) {
        examples::Row row{i * 0.025};
        for (const Filter filter : filters)
            row.push_back(std::abs(passed(filter, row[0])));
        response.rows.push_back(row);
    }
    save_plot(folder, weights);
    save_plot(folder, response);
}

/// Table: what each filter passes of an alias.
void table_of_filters(const std::string& folder) {
    examples::Table table{.name = "radiance-filter-table",
                          .columns = {"", "passes at 1.5"}};
    for (std::size_t i = 0; i < std::size(filters); ++i)
        table.rows.push_back(
            {filter_names[i],
             text(100 * std::abs(passed(filters[i], 1.5)), "%.2f %%")});
    save_table(folder, table);
}

/// Rings that become finer outwards: by a ray through the middle of each pixel, and by
/// each filter.
void pictures_of_rings(const examples::Options& options, int pixels, int samples) {
    const Card rings{.half = pixels / 2.0};
    save_png(examples::by_middle_rays(rings, ljus::look_at({.vfov_degrees = 90}),
                                      pixels, pixels),
             options.path("radiance-rings-none.png"));
    for (std::size_t i = 0; i < std::size(filters); ++i)
        save_png(picture_of(rings, filters[i], samples, pixels, options),
                 options.path("radiance-rings-" + std::to_string(i + 1) + ".png"));
}

/// Plots of weights and of what passes; a table; pictures of rings.
void compare_filters(const examples::Options& options, int pixels, int samples) {
    plot_filters(options.path(""));
    table_of_filters(options.path(""));
    pictures_of_rings(options, pixels, samples);
}

} // namespace

/// Makes the figures of chapter 2.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 2: the laws of light counted with rays, and filters.");
        line.add("--shots", sizes.shots, "Rays per count", 1000, 2000000000);
        line.add("--pixels", sizes.pixels, "Side of the pictures of rings", 8, 4000);
        line.without({"--width", "--height"});
        const examples::Options options = line.parse({.draft{.samples = 16},
                                                      .report{.samples = 64},
                                                      .reference{.samples = 1024}});
        if (!line.given("--shots"))
            sizes.shots = options.pick(400000, 10000000, 100000000);
        if (!line.given("--pixels")) sizes.pixels = options.pick(160, 400, 400);
        const std::string folder = options.path("");
        count_on_patches(folder, sizes.shots);
        near_the_lamp(folder);
        trade(folder, options.pick(4096, 65536, 262144), options.pick(16, 64, 256));
        compare_filters(options, sizes.pixels, std::min(options.samples, 256));
    });
}
