// smoke: --quality draft --width 24 --height 24 --photons 1000 --seeds 2
/// \file chapters/experiments/26_budget_experiments.cpp
/// \brief Chapter 26: the experiments behind its tables and plots: how many photons
/// each mirror and each glass should get.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>
#include <ljus/render/budgeting.hpp>

#include "common/convergence.hpp"
#include "common/drawing.hpp"
#include "common/example.hpp"

using namespace ljus;

namespace {

constexpr double pi = std::numbers::pi;

/// The options of this program, besides the common ones.
struct Sizes {
    long long photons = 0; ///< Of a caustics map.
    int seeds = 0;         ///< Maps behind each error.
};

// --- Two balls -----------------------------------------------------------------------

using Stage =
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass>, Lights<PointLight>>;
constexpr float floor_albedo = 0.5f;
const Vec3 lamp{0, 4, 0};
constexpr float watts = 10; // a steradian

/// Two balls of one size under one light, indices 1.05 and 1.5, on a floor in the void.
World<Stage> two_balls() {
    Stage stage;
    stage.add(Quad{{-3, 0, -3}, {0, 0, 6}, {6, 0, 0}},
              stage.add(Lambertian{.albedo = Rgb{floor_albedo}}));
    for (const auto& [at, index] : {std::pair{-1.0f, 1.05f}, std::pair{1.0f, 1.5f}})
        stage.add(Sphere{.center{at, 0.8f, 0}, .radius = 0.5f},
                  stage.add(Glass{.index = index}));
    stage.add(PointLight{.position = lamp, .intensity = Rgb{watts}});
    return World(std::move(stage));
}

/// The part of the floor in view.
struct Grid {
    int width = 96, height = 72;
    [[nodiscard]] Vec3 at(int x, int y) const {
        return {4 * (float(x) + 0.5f) / float(width) - 2, 0,
                3 * (float(y) + 0.5f) / float(height) - 1.5f};
    }
};

/// The radiance that the photons of a map make on the floor.
Image floor_light(const PhotonMap& map, const Grid& grid, float radius,
                  PhotonKinds kinds) {
    Image image = make_image(grid.width, grid.height);
    const Lambertian material{.albedo = Rgb{floor_albedo}};
    const DensityEstimateSettings gather{.radius = radius};
    for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x) {
            VertexT<float> floor{.point{.position = grid.at(x, y), .normal{0, 1, 0}}};
            floor.frame = frame_around(floor.point.normal);
            std::uint64_t gathered = 0;
            pixel(image, x, y) = estimate_radiance(map, floor, material, Vec3{0, 0, 1},
                                                   gather, kinds, gathered);
        }
    return image;
}

/// The direct light on the floor in closed form; the balls cast shadows.
Image direct_light(const Grid& grid) {
    Image image = make_image(grid.width, grid.height);
    for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x) {
            const Vec3 way = lamp - grid.at(x, y);
            const float d = glm::length(way);
            bool lit = true;
            for (const float ball : {-1.0f, 1.0f}) {
                const Vec3 to = Vec3{ball, 0.8f, 0} - grid.at(x, y);
                lit = lit && glm::length(glm::cross(to, way / d)) > 0.5f;
            }
            if (lit)
                pixel(image, x, y) =
                    Rgb{float(double(floor_albedo) / pi) * watts * way.y / (d * d * d)};
        }
    return image;
}

Image operator+(const Image& a, const Image& b) {
    Image sum = a;
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += b.pixels[i];
    return sum;
}

PhotonMap caustics_of(const World<Stage>& stage, long long photons, std::uint64_t seed,
                      const std::vector<double>& shares,
                      const examples::Options& options) {
    return make_photon_map(trace_photons(stage, MapType::caustics,
                                         {.photons = photons,
                                          .seed = seed,
                                          .shares = shares,
                                          .threads = options.threads})
                               .photons);
}

/// Errors of a way to divide photons: bias and variance, absolute, relative to all
/// light and relative to the mean light of the caustic on that half of the floor.
struct Errors {
    BiasVariance absolute, relative, own;
};

/// The two balls and their references.
struct Known {
    World<Stage> world = two_balls();
    Image rest{};    ///< All light but the caustics.
    Image truth{};   ///< All light.
    double gain = 1; ///< Exposure for relative errors.
    std::vector<CausticPilot> pilots = {};
};

Known known_balls(const Grid& grid, float radius, const Sizes& sizes,
                  const examples::Options& options) {
    Known known{.rest = direct_light(grid)};
    const long long many = options.pick(50, 300, 1000) * sizes.photons;
    const auto general = trace_photons(known.world, MapType::general,
                                       {.photons = std::min(many, 2000000LL),
                                        .seed = 91,
                                        .shadow_photons = false,
                                        .threads = options.threads})
                             .photons;
    known.rest = known.rest + floor_light(make_photon_map(general), grid, 0.2f,
                                          one_kind(PhotonKind::indirect));
    known.truth =
        known.rest + floor_light(caustics_of(known.world, many, 92, {}, options), grid,
                                 0.5f * radius, all_kinds);
    double mean = 0;
    for (const Rgb& c : known.truth.pixels)
        mean += double(c.x) / double(known.truth.pixels.size());
    known.gain = 1 / mean; // the epsilon of relative errors assumes that
    known.pilots = pilot_caustics(known.world,
                                  PhotonPassSettings{.photons = sizes.photons,
                                                     .seed = options.seed,
                                                     .threads = options.threads},
                                  radius, general, 0.3f);
    return known;
}

Errors errors_of(const Known& known, const std::vector<double>& shares,
                 const Grid& grid, float radius, const Sizes& sizes,
                 const examples::Options& options) {
    std::vector<Image> runs;
    Errors errors;
    const auto scaled = [&](Image image, double gain) {
        for (Rgb& c : image.pixels) c *= float(gain);
        return image;
    };
    for (int seed = 1; seed <= sizes.seeds; ++seed) {
        const auto map = caustics_of(known.world, sizes.photons, std::uint64_t(seed),
                                     shares, options);
        runs.push_back(known.rest + floor_light(map, grid, radius, all_kinds));
        examples::stop_if_asked();
    }
    errors.absolute = bias_variance(runs, known.truth);
    const auto by_own = [&](Image image) {
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const CausticPilot& ball = known.pilots[2 * x < image.width ? 0 : 1];
                pixel(image, x, y) *=
                    float(ball.area / ball.flux * pi / double(floor_albedo));
            }
        return image;
    };
    std::vector<Image> owns;
    for (const Image& run : runs) owns.push_back(by_own(run));
    errors.own = bias_variance(owns, by_own(known.truth));
    for (Image& run : runs) run = scaled(run, known.gain);
    errors.relative =
        examples::relative_split(runs, block_means(scaled(known.truth, known.gain), 1));
    return errors;
}

/// Variance against the fraction of the light glass, beside theory.
void by_share(const Known& known, const Grid& grid, float radius, const Sizes& sizes,
              const examples::Options& options) {
    examples::Plot plot{
        .name = "budget-shares",
        .columns = {"share of the ball of index 1.05", "in W/m²", "predicted in W/m²",
                    "relative to own caustic", "predicted relative to own caustic",
                    "relative to all light", "predicted relative to all light"},
        .y_label = "variance over that of equal shares",
        .more = "set yrange [0:3]\n"};
    const auto law = [](double a, double b, double share) {
        return (a * a / share + b * b / (1 - share)) / (2 * a * a + 2 * b * b);
    };
    const auto variances = [&](double share) {
        const auto errors =
            errors_of(known, {share, 1 - share}, grid, radius, sizes, options);
        return std::array{errors.absolute.variance, errors.own.variance,
                          errors.relative.variance};
    };
    const auto half = variances(0.5);
    const CausticPilot &l = known.pilots[0], &r = known.pilots[1];
    for (const double share : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95}) {
        const auto found = variances(share);
        plot.rows.push_back({share, found[0] / half[0],
                             law(l.absolute, r.absolute, share), found[1] / half[1],
                             law(l.relative, r.relative, share), found[2] / half[2],
                             law(l.visible, r.visible, share)});
    }
    save_plot(options.out, plot);
}

/// Rays through balls of two indices by Snell's law, and where they land.
void draw_rays(const examples::Options& options) {
    examples::Drawing figure{.name = "budget-rays",
                             .description = "The same light through two balls: index "
                                            "1.05 spreads it, 1.5 gathers it",
                             .low{-1.5, -1.05},
                             .high{4.5, 1.75},
                             .scale = 115};
    for (const auto& [middle, index] : {std::pair{0.0, 1.05}, std::pair{3.0, 1.5}}) {
        const double light = 3.2, radius = 0.5, floor = 0.8;
        draw_line(figure, {{middle - 1.3, -floor}, {middle + 1.3, -floor}});
        draw_arc(figure, {middle, 0}, radius, 0, 2 * pi);
        for (int i = -7; i <= 7; ++i) {
            const double alpha = std::asin(radius / light) * i / 7.4;
            const double ti = std::asin(std::sin(alpha) * light / radius);
            const double tt = std::asin(std::sin(ti) / index);
            const double in = ti - alpha, out = in + pi - 2 * tt, way = out + ti;
            const examples::Point a{middle + radius * std::sin(in),
                                    radius * std::cos(in)};
            const examples::Point b{middle + radius * std::sin(out),
                                    radius * std::cos(out)};
            const double x = b.x - (b.y + floor) * std::tan(way);
            const examples::Point top{a.x - (1.7 - a.y) * std::tan(alpha), 1.7};
            draw_line(figure, {top, a, b, {x, -floor}},
                      {examples::colors::orange, 1.2});
        }
        draw_label(figure, {middle, -0.99}, "n = " + examples::text(index));
    }
    save_drawing(options.out, figure);
}

} // namespace

/// Makes the plot about the photons of each object, and a drawing.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 26: a budget for the photons of caustics.");
        line.add("--photons", sizes.photons, "Photons per caustics map", 1000,
                 10000000);
        line.add("--seeds", sizes.seeds, "Maps behind each error", 2, 1000);
        const examples::Options options =
            line.parse({.draft{.width = 80, .height = 80, .samples = 4},
                        .report{.width = 400, .height = 400, .samples = 16},
                        .reference{.width = 500, .height = 500, .samples = 64}});
        if (!line.given("--photons")) sizes.photons = options.pick(4000, 10000, 10000);
        if (!line.given("--seeds")) sizes.seeds = options.pick(4, 16, 64);
        const float radius = 0.03f;
        const Grid grid{options.pick(48, 96, 192), options.pick(36, 72, 144)};
        draw_rays(options);
        by_share(known_balls(grid, radius, sizes, options), grid, radius, sizes,
                 options);
    });
}
