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

#include <ljus/image/flip.hpp>
#include <ljus/inspect/bias_variance.hpp>
#include <ljus/inspect/estimate.hpp>
#include <ljus/ljus.hpp>
#include <ljus/path/light_transport.hpp>
#include <ljus/render/budgeting.hpp>
#include <ljus/scenes/report_rooms.hpp>

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

constexpr std::array budgets{CausticBudget::as_seen, CausticBudget::equal,
                             CausticBudget::flux, CausticBudget::area,
                             CausticBudget::brightness};
constexpr std::array budget_names{"as seen", "equal", "flux", "area", "brightness"};

// --- Two balls -----------------------------------------------------------------------

using Stage =
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass>, Lights<PointLight>>;
constexpr float floor_albedo = 0.5f;
const Vec3 lamp{0, 4, 0};
constexpr float watts = 10; // a steradian

/// Two balls of one size under one light, indices 1.05 and 1.5, on a floor: in the
/// void, or in a box whose walls have a colour.
Room<Stage> two_balls(float albedo) {
    Stage stage;
    const Vec3 low{-3, 0, -3}, x{6, 0, 0}, y{0, 5, 0}, z{0, 0, 6};
    stage.add(Quad{low, z, x}, stage.add(Lambertian{.albedo = Rgb{floor_albedo}}));
    if (albedo > 0) {
        const auto walls = stage.add(Lambertian{.albedo = Rgb{albedo}});
        for (const Quad& wall :
             {Quad{low + y, x, z}, Quad{low, x, y}, Quad{low + z, y, x},
              Quad{low, y, z}, Quad{low + x, z, y}})
            stage.add(wall, walls);
    }
    for (const auto& [at, index] : {std::pair{-1.0f, 1.05f}, std::pair{1.0f, 1.5f}})
        stage.add(Sphere{.center{at, 0.8f, 0}, .radius = 0.5f},
                  stage.add(Glass{.index = index}));
    stage.add(PointLight{.position = lamp, .intensity = Rgb{watts}});
    const Camera camera = look_at(View{.position{0, 2.4f, 2.9f},
                                       .target{0, 0.45f, 0},
                                       .up{0, 1, 0},
                                       .vfov_degrees = 55});
    return {World(std::move(stage)), camera};
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
    double flip = 0;
};

/// A room and its references.
struct Known {
    std::string name;
    Room<Stage> room;
    Image rest{};    ///< All light but the caustics.
    Image truth{};   ///< All light.
    double gain = 1; ///< Exposure for FLIP.
    std::vector<CausticPilot> pilots = {};
};

Known known_room(const std::string& name, float albedo, const Grid& grid, float radius,
                 const Sizes& sizes, const examples::Options& options) {
    Known known{.name = name, .room = two_balls(albedo), .rest = direct_light(grid)};
    const long long many = options.pick(50, 300, 1000) * sizes.photons;
    const auto general = trace_photons(known.room.world, MapType::general,
                                       {.photons = std::min(many, 2000000LL),
                                        .seed = 91,
                                        .shadow_photons = false,
                                        .threads = options.threads})
                             .photons;
    known.rest = known.rest + floor_light(make_photon_map(general), grid, 0.2f,
                                          one_kind(PhotonKind::indirect));
    known.truth =
        known.rest + floor_light(caustics_of(known.room.world, many, 92, {}, options),
                                 grid, 0.5f * radius, all_kinds);
    double mean = 0;
    for (const Rgb& c : known.truth.pixels)
        mean += double(c.x) / double(known.truth.pixels.size());
    known.gain = 1 / mean; // the epsilon of relative errors assumes that
    known.pilots = pilot_caustics(known.room.world,
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
    const auto shown = [&](const Image& image) {
        return scaled(image, 0.3 * known.gain);
    };
    const Image truth = shown(known.truth);
    for (int seed = 1; seed <= sizes.seeds; ++seed) {
        const auto map = caustics_of(known.room.world, sizes.photons,
                                     std::uint64_t(seed), shares, options);
        runs.push_back(known.rest + floor_light(map, grid, radius, all_kinds));
        if (seed <= 4)
            errors.flip += flip(shown(runs.back()), truth) / std::min(4, sizes.seeds);
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

/// The table of all budgets in both rooms.
void two_rooms(const std::vector<Known>& rooms, const Grid& grid, float radius,
               const Sizes& sizes, const examples::Options& options) {
    examples::Table table{.name = "budget-two-balls",
                          .columns = {"room", "budget", "photons for index 1.05",
                                      "for index 1.5", "squared bias", "variance",
                                      "variance relative to own caustic",
                                      "variance relative to all light",
                                      "squared bias relative to all light", "FLIP"}};
    for (const Known& known : rooms)
        for (std::size_t b = 0; b < budgets.size(); ++b) {
            const auto shares = caustic_shares(budgets[b], known.pilots);
            const auto found = errors_of(known, shares, grid, radius, sizes, options);
            const double left = shares.empty() ? 0.5 : shares[0];
            table.rows.push_back({known.name, budget_names[b],
                                  examples::text(100 * left, "%.0f %%"),
                                  examples::text(100 - 100 * left, "%.0f %%"),
                                  examples::text(found.absolute.bias_squared, "%.3g"),
                                  examples::text(found.absolute.variance, "%.3g"),
                                  examples::text(found.own.variance, "%.3g"),
                                  examples::text(found.relative.variance, "%.3g"),
                                  examples::text(found.relative.bias_squared, "%.3g"),
                                  examples::text(found.flip, "%.4f")});
            if (!options.quiet) {
                examples::print_row(table.rows.back(), 11);
            }
        }
    save_table(options.out, table);

    examples::Table found{.name = "budget-pilot",
                          .columns = {"room", "index", "photons stored in the pilot",
                                      "flux, W", "area, m²", "a for flux", "a for area",
                                      "a for brightness"}};
    for (const Known& known : rooms)
        for (std::size_t k = 0; k < known.pilots.size(); ++k) {
            const CausticPilot& p = known.pilots[k];
            found.rows.push_back(
                {known.name, k == 0 ? "1.05" : "1.5", std::to_string(p.stored),
                 examples::text(p.flux, "%.3f"), examples::text(p.area, "%.2f"),
                 examples::text(p.absolute, "%.3f"), examples::text(p.relative, "%.2f"),
                 examples::text(p.visible, "%.2f")});
        }
    save_table(options.out, found);
}

/// Variance in the dark against the fraction of the light glass, beside theory.
void by_share(const std::vector<Known>& rooms, const Grid& grid, float radius,
              const Sizes& sizes, const examples::Options& options) {
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
            errors_of(rooms[0], {share, 1 - share}, grid, radius, sizes, options);
        return std::array{errors.absolute.variance, errors.own.variance,
                          errors.relative.variance};
    };
    const auto half = variances(0.5);
    const CausticPilot &l = rooms[0].pilots[0], &r = rooms[0].pilots[1];
    for (const double share : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95}) {
        const auto found = variances(share);
        plot.rows.push_back({share, found[0] / half[0],
                             law(l.absolute, r.absolute, share), found[1] / half[1],
                             law(l.relative, r.relative, share), found[2] / half[2],
                             law(l.visible, r.visible, share)});
    }
    save_plot(options.out, plot);
}

/// The pictures of the lit room: few photons, divided as lights see the objects, and by
/// area.
void pictures(const examples::Options& options) {
    for (const auto& [how, budget] : {std::pair{"seen", CausticBudget::as_seen},
                                      std::pair{"area", CausticBudget::area}}) {
        const auto room = two_balls(0.8f);
        PhotonMappingSettings settings{.split_glass = true,
                                       .indirect = IndirectLight::photons,
                                       .caustic_budget = budget};
        settings.caustics = {
            .photons = 3000, .seed = options.seed, .threads = options.threads};
        settings.general = {.photons = options.pick(100000LL, 400000LL, 1000000LL),
                            .shadow_photons = false,
                            .threads = options.threads};
        settings.caustics_estimate.radius = 0.06f;
        settings.general_estimate.radius = 0.3f;
        const PhotonMapper mapper(room.world, settings, abilities<Budgeting>);
        auto image = render(mapper, room.camera,
                            {.width = options.width,
                             .height = options.height * 3 / 4,
                             .samples = options.samples,
                             .threads = options.threads})
                         .image;
        for (Rgb& c : image.pixels) c *= 0.8f;
        save_png(image, options.path(std::string("budget-lit-") + how + ".png"));
        examples::stop_if_asked();
    }
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

// --- The report's four balls ---------------------------------------------------------

/// The four balls of figure 11, and the settings of their light.
struct FourBalls {
    decltype(four_glass_room()) room = four_glass_room();
    float radius = 0.15f;          ///< Of the estimate.
    PhotonPassSettings pass{};     ///< Of a caustics map.
    PhotonPassSettings rest{};     ///< Of a general map.
    std::vector<Photon> general{}; ///< The light of all but caustics.
    std::vector<CausticPilot> pilots{};
    std::array<std::vector<double>, budgets.size()> shares{}; ///< By each budget.
};

FourBalls known_balls(const examples::Options& options, const Sizes& sizes) {
    FourBalls balls{.pass = {.photons = sizes.photons,
                             .seed = options.seed,
                             .threads = options.threads},
                    .rest = {.photons = options.pick(50000LL, 400000LL, 1000000LL),
                             .shadow_photons = false,
                             .threads = options.threads}};
    balls.general =
        trace_photons(balls.room.world, MapType::general, balls.rest).photons;
    balls.pilots =
        pilot_caustics(balls.room.world, balls.pass, balls.radius, balls.general, 0.5f);
    for (std::size_t b = 0; b < budgets.size(); ++b)
        balls.shares[b] = caustic_shares(budgets[b], balls.pilots);
    return balls;
}

/// How often each object of glass is aimed at as lights see it.
std::vector<double> aimed_as_seen(const FourBalls& balls,
                                  const std::vector<ObjectId>& targets) {
    const auto choice = balls.room.world.light_choice();
    std::vector<double> seen(targets.size());
    for (std::uint64_t path = 0; path < 20000; ++path) {
        auto stream = random_stream(7, Pass::caustics_photons, 0, path);
        const auto aimed = aim(balls.room.world, choice, targets, stream);
        for (std::size_t k = 0; aimed && k < targets.size(); ++k)
            if (targets[k] == aimed->target) seen[k] += 1 / 20000.0;
    }
    return seen;
}

/// The pilot's results for each ball, and its fraction by each budget.
void four_balls_shares(const FourBalls& balls, const examples::Options& options) {
    examples::Table table{.name = "budget-four-balls",
                          .columns = {"ball", "index", "flux, W", "area, m²", "as seen",
                                      "by flux", "by area", "by brightness"}};
    constexpr std::array names{"large, right", "thin, left", "middle", "yellow, above"};
    constexpr std::array indices{"1.97", "1", "1.6", "1.7"}; // the report's
    const auto targets = specular_objects(balls.room.world);
    const auto seen = aimed_as_seen(balls, targets);
    const auto percent = [](double x) { return examples::text(100 * x, "%.0f %%"); };
    for (std::size_t k = 0; k < targets.size(); ++k) {
        // Glass may come before or after mixtures: the ball is known by its position.
        const float z = balls.room.world.visit_shape(targets[k], [](const auto& shape) {
            return bounding_sphere(shape).center.z;
        });
        const std::size_t name = z > 0 ? 0 : z == -3.5f ? 1 : z == -2.5f ? 2 : 3;
        const CausticPilot& pilot = balls.pilots[k];
        table.rows.push_back({names[name], indices[name],
                              examples::text(pilot.flux, "%.2f"),
                              examples::text(pilot.area, "%.2f"), percent(seen[k]),
                              percent(balls.shares[2][k]), percent(balls.shares[3][k]),
                              percent(balls.shares[4][k])});
    }
    save_table(options.out, table);
}

/// A picture of the caustics alone.
Image caustics_seen(const FourBalls& balls, long long photons, std::uint64_t seed,
                    const std::vector<double>& shares, const RenderSettings& picture) {
    PhotonMappingSettings settings{.indirect = IndirectLight::none};
    settings.caustics = balls.pass;
    settings.caustics.photons = photons;
    settings.caustics.seed = seed;
    settings.caustics.shares = shares;
    settings.caustics_estimate.radius = balls.radius;
    const PhotonMapper mapper(balls.room.world, settings);
    auto image = render(OnlyPaths(mapper, "ES*DS+L"), balls.room.camera, picture).image;
    examples::stop_if_asked();
    return image;
}

/// A picture of all light but the caustics, the general map seen.
Image rest_seen(const FourBalls& balls, const RenderSettings& picture) {
    PhotonMappingSettings settings{.indirect = IndirectLight::photons,
                                   .keep_general_map = true};
    settings.caustics.photons = 0;
    settings.general = balls.rest;
    settings.general_estimate.radius = 0.4f;
    return render(PhotonMapper(balls.room.world, settings), balls.room.camera, picture)
        .image;
}

/// The errors of each budget: caustics of many maps, in a picture whose other light is
/// always the same.
void four_balls_errors(const FourBalls& balls, const examples::Options& options,
                       const Sizes& sizes) {
    const RenderSettings picture{.width = options.width,
                                 .height = options.height,
                                 .samples = 4,
                                 .threads = options.threads};
    RenderSettings fine = picture;
    fine.samples = options.pick(16, 64, 256);
    const Image expected = caustics_seen(
        balls, options.pick(20, 100, 200) * sizes.photons, 99, {}, picture);
    const Image rest = rest_seen(balls, fine);
    const Image truth = rest + expected;
    examples::Table table{.name = "budget-four-balls-errors",
                          .columns = {"budget", "variance", "relative variance", "FLIP",
                                      "processor seconds"}};
    for (std::size_t b = 0; b < budgets.size(); ++b) {
        std::vector<Image> runs;
        const double begin = examples::processor_seconds();
        for (int seed = 1; seed <= sizes.seeds; ++seed)
            runs.push_back(rest + caustics_seen(balls, sizes.photons,
                                                std::uint64_t(seed), balls.shares[b],
                                                picture));
        const double seconds = (examples::processor_seconds() - begin) / sizes.seeds;
        const std::size_t judged = std::min<std::size_t>(4, runs.size());
        double seen_error = 0;
        for (std::size_t i = 0; i < judged; ++i)
            seen_error += flip(runs[i], truth) / double(judged);
        const auto split = bias_variance(runs, truth);
        const auto relative = examples::relative_split(runs, block_means(truth, 1));
        table.rows.push_back({budget_names[b], examples::text(split.variance, "%.3g"),
                              examples::text(relative.variance, "%.3g"),
                              examples::text(seen_error, "%.4f"),
                              examples::text(seconds, "%.3f")});
        if (!options.quiet)
            std::printf("four balls, %s: %.3g, relative %.3g, FLIP %.4f\n",
                        budget_names[b], split.variance, relative.variance, seen_error);
    }
    save_table(options.out, table);
}

/// The photons of each ball of figure 11, and their effect on the picture.
void four_balls(const examples::Options& options, const Sizes& sizes) {
    const FourBalls balls = known_balls(options, sizes);
    four_balls_shares(balls, options);
    four_balls_errors(balls, options, sizes);
}

// --- Several lamps -------------------------------------------------------------------

/// A glass ball under a lamp of 1 W/sr, and other lamps.
/// \param sealed  Whether each of them is in a black ball of its own.
World<Stage> ball_and_lamps(const std::vector<PointLight>& others, bool sealed) {
    Stage stage;
    stage.add(Quad{.corner{-50, -1, -50}, .edge_u{0, 0, 100}, .edge_v{100, 0, 0}},
              stage.add(Lambertian{.albedo = Rgb{floor_albedo}}));
    stage.add(Sphere{.radius = 0.5f}, stage.add(Glass{}));
    const auto black = stage.add(Lambertian{.albedo = Rgb{0}});
    stage.add(PointLight{.position{0, 2, 0}});
    for (const PointLight& other : others) {
        stage.add(other);
        if (sealed) stage.add(Sphere{.center = other.position, .radius = 0.2f}, black);
    }
    return World(std::move(stage));
}

/// The caustic light on half of the floor, by many maps.
Estimate half_of_floor(const World<Stage>& world, PhotonPassSettings pass, int seeds) {
    Estimate flux;
    for (int seed = 1; seed <= seeds; ++seed) {
        pass.seed = static_cast<std::uint64_t>(seed);
        double sum = 0;
        for (const Photon& photon :
             trace_photons(world, MapType::caustics, pass).photons)
            if (photon.normal.y > 0 && photon.position.x > 0)
                sum += double(photon.flux.x);
        add(flux, sum);
    }
    return flux;
}

/// Lamps chosen by power, and by what a pilot of each brought.
void several_lamps(const examples::Options& options, const Sizes& sizes) {
    examples::Table table{.name = "budget-lamps",
                          .columns = {"lamps beside the one above the ball",
                                      "light by power, W", "standard error",
                                      "by what arrives, W", "standard error",
                                      "variance falls by"}};
    const auto row = [&](const char* name, const std::vector<PointLight>& others,
                         bool sealed) {
        const World<Stage> world = ball_and_lamps(others, sealed);
        PhotonPassSettings pass{.photons = sizes.photons, .threads = options.threads};
        const auto by_power = half_of_floor(world, pass, 4 * sizes.seeds);
        pass.light_shares = pilot_lights(world, pass);
        const auto by_share = half_of_floor(world, pass, 4 * sizes.seeds);
        table.rows.push_back({name, examples::text(by_power.mean),
                              examples::text(standard_error(by_power), "%.2g"),
                              examples::text(by_share.mean),
                              examples::text(standard_error(by_share), "%.2g"),
                              examples::text(variance(by_power) / variance(by_share))});
    };
    std::vector<PointLight> strong, alike;
    for (int i = 0; i < 50; ++i) {
        strong.push_back({.position{float(i - 25), 9, 0}, .intensity = Rgb{100}});
        alike.push_back({.position{float(i - 25) / 25, 9, 0}});
    }
    row("50 sealed ones, 100 times as strong", strong, true);
    row("50 of its strength, high above", alike, false);
    row("one of its strength, beside it", {{.position{-1, 2, 0}}}, false);
    save_table(options.out, table);
}

} // namespace

/// Makes the figures of chapter 30.
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
        pictures(options);
        std::vector<Known> rooms;
        rooms.push_back(known_room("dark", 0, grid, radius, sizes, options));
        rooms.push_back(known_room("lit", 0.8f, grid, radius, sizes, options));
        two_rooms(rooms, grid, radius, sizes, options);
        by_share(rooms, grid, radius, sizes, options);
        four_balls(options, sizes);
        several_lamps(options, sizes);
    });
}
