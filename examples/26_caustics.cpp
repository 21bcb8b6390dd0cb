// figures: fig-8 fig-11 table-2
// smoke: --quality draft --width 24 --height 24 --rays 1 --photons 300 --seeds 2
/// \file 26_caustics.cpp
/// \brief Chapter 26: caustics. Figures 8 and 11, table 2, and a caustic on paper.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <ljus/inspect/photon_dots.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "common/terminal.hpp"

using namespace ljus;

namespace {

constexpr double pi = std::numbers::pi;

/// What the user may set besides the common options.
struct Sizes {
    long long photons = 0; ///< The largest number of photons.
    int seeds = 0;         ///< Maps behind each error.
};

// --- A caustic on paper ---------------------------------------------------------------

/// A point light above a ball of glass above a floor.
struct Setup {
    double light = 2;    ///< D, from the ball's middle up to the light.
    double floor = 0.6;  ///< From the ball's middle down to the floor.
    double radius = 0.5; ///< R.
    double index = 1.5;  ///< n.
};

/// Where a ray of light lands, and how much of it.
struct Landing {
    double rho = 0;   ///< Signed distance from the axis.
    double share = 0; ///< (1 - F)^2.
};

/// The ray that leaves the light at an angle, refracted twice.
// [landing]
Landing landing(const Setup& setup, double alpha) {
    const double sine = std::sin(alpha) * setup.light / setup.radius;
    const double ti = std::asin(sine);
    const double tt = std::asin(sine / setup.index);
    const double exit = ti - alpha + pi - 2 * tt; // angle from the ball's top
    const double way = exit + ti;
    const double x = setup.radius * std::sin(exit);
    const double height = setup.floor + setup.radius * std::cos(exit);
    const double f = fresnel(std::cos(ti), 1.0, setup.index);
    return {x - height * std::tan(way), (1 - f) * (1 - f)};
}
// [landing]

/// The irradiance on the floor for an intensity of 1 W/sr: a ring of directions over
/// the ring of the floor on which it lands, wherever a ray lands there.
double irradiance(const Setup& setup, double rho) {
    constexpr int steps = 4000;
    const double width = std::asin(setup.radius / setup.light) / steps;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double alpha = (i + 0.5) * width;
        const Landing a = landing(setup, alpha - width / 2);
        const Landing b = landing(setup, alpha + 0.499 * width);
        for (const double at : {rho, -rho})
            if ((a.rho < at) != (b.rho < at))
                sum += std::sin(alpha) * a.share /
                       (rho * std::abs((b.rho - a.rho) / width));
    }
    return sum;
}
using Stage = Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass, Mirror>>;

void add_floor(Stage& stage, float y) {
    stage.add(Quad{.corner{-9, y, -9}, .edge_u{0, 0, 18}, .edge_v{18, 0, 0}},
              stage.add(Lambertian{.albedo = Rgb{1}}));
}

/// The irradiance that an estimate reads on a floor: a white one sends E/pi.
double read(const PhotonMap& map, const Vec3& at,
            const DensityEstimateSettings& gather) {
    VertexT<float> floor{.point{.position = at, .normal{0, 1, 0}}};
    floor.frame = frame_around(floor.point.normal);
    std::uint64_t gathered = 0;
    return pi * double(estimate_radiance(map, floor, Lambertian{.albedo = Rgb{1}},
                                         Vec3{0, 0, 1}, gather, all_kinds, gathered)
                           .x);
}

PhotonMap map_of(const Stage& stage, long long photons, std::uint64_t seed) {
    return make_photon_map(
        trace_photons(stage, MapType::caustics, {.photons = photons, .seed = seed})
            .photons);
}

Stage ball_stage(const Setup& setup) {
    Stage stage;
    add_floor(stage, float(-setup.floor));
    stage.add(Sphere{.radius = float(setup.radius)},
              stage.add(Glass{.index = float(setup.index)}));
    stage.add(PointLight{.position{0, float(setup.light), 0}});
    return stage;
}

constexpr std::array kernels{Kernel::box, Kernel::cone, Kernel::gaussian,
                             Kernel::epanechnikov, Kernel::biweight};
constexpr std::array kernel_names{"box", "cone", "Gaussian", "Epanechnikov",
                                  "biweight"};

/// The profile of the caustic, by geometric optics and by photons, and what the kernels
/// make of few photons.
void profile(const examples::Options& options, long long photons) {
    const Setup setup;
    const Stage stage = ball_stage(setup);
    const auto y = float(-setup.floor);
    const PhotonMap map = map_of(stage, photons, options.seed);
    examples::Plot plot{.name = "caustics-profile",
                        .columns = {"distance from the axis", "geometric optics",
                                    "photons within 0.004"},
                        .y_label = "irradiance, W/m^2",
                        .log_y = true,
                        .more = "set yrange [0.1:100]\n"};
    for (int i = 1; i <= 160; ++i) {
        const double rho = 0.001 * i - 0.0003;
        const double exact = irradiance(setup, rho);
        const double found = read(map, {float(rho), y, 0}, {.radius = 0.004f});
        const double empty = std::numeric_limits<double>::quiet_NaN();
        plot.rows.push_back(
            {rho, exact > 0 ? exact : empty, found > 0 ? found : empty});
    }
    save_plot(options.out, plot);

    const int size = options.pick(160, 240, 480);
    const PhotonMap few = map_of(stage, std::min(photons, 20000LL), options.seed);
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        Image image = make_image(size, size);
        for (int i = 0; i < size; ++i)
            for (int j = 0; j < size; ++j) {
                const Vec3 at{0.4f * (float(i) + 0.5f) / float(size) - 0.2f, y,
                              0.4f * (float(j) + 0.5f) / float(size) - 0.2f};
                pixel(image, i, j) = Rgb{float(
                    0.2 * read(few, at, {.radius = 0.012f, .kernel = kernels[k]}))};
            }
        save_png(image, options.path("caustics-kernel-" + std::to_string(k) + ".png"));
    }
}

// --- Error against radius, number and kernel ------------------------------------------

/// A square mirror above a point light: its light on the floor has a sharp edge.
Stage window_stage() {
    Stage stage;
    add_floor(stage, 0);
    stage.add(Quad{.corner{-0.5f, 1.5f, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}},
              stage.add(Mirror{.reflectance = Rgb{1}}));
    stage.add(PointLight{.position{0, 1, 0}});
    return stage;
}

/// The exact light: the light's image is at height 2, and the window's light ends at 2
/// from the middle.
double window_light(double x, double z) {
    if (std::max(std::abs(x), std::abs(z)) > 2) return 0;
    const double d2 = x * x + z * z + 4;
    return 2 / (d2 * std::sqrt(d2));
}

/// Where errors are measured: around the middle, or across an edge.
struct Strip {
    double first = 0; ///< x of its left end.
    double last = 0;  ///< x of its right end.
};
constexpr Strip middle{-0.5, 0.5};
constexpr Strip edge{1.2, 2.8};

/// The mean squared error of several ways to gather, relative to the light at the
/// middle, over the seeds.
std::vector<double> errors(const Stage& stage, long long photons, int seeds,
                           const Strip& strip,
                           const std::vector<DensityEstimateSettings>& ways) {
    std::vector<double> sum(ways.size());
    constexpr int places = 100;
    for (int seed = 1; seed <= seeds; ++seed) {
        const PhotonMap map =
            map_of(stage, photons, 1000 + static_cast<std::uint64_t>(seed));
        for (int place = 0; place < places; ++place) {
            const double x =
                strip.first + (strip.last - strip.first) * (place + 0.5) / places;
            const double z = 0.5 * std::sin(2.4 * place);
            const double right = window_light(x, z);
            for (std::size_t i = 0; i < ways.size(); ++i) {
                const double error =
                    read(map, {float(x), 0, float(z)}, ways[i]) - right;
                sum[i] += error * error / places / seeds;
            }
        }
    }
    for (double& value : sum) value /= window_light(0, 0) * window_light(0, 0);
    return sum;
}

/// Ways to gather with radii around one that grows by a third of an octave.
std::vector<DensityEstimateSettings> around(double radius,
                                            Kernel kernel = Kernel::epanechnikov) {
    std::vector<DensityEstimateSettings> ways;
    for (int i = -5; i <= 5; ++i)
        ways.push_back(
            {.radius = float(radius * std::exp2(i / 3.0)), .kernel = kernel});
    return ways;
}

void laws(const examples::Options& options, const Sizes& sizes) {
    const Stage stage = window_stage();
    examples::Plot by_radius{.name = "caustics-radius",
                             .columns = {"radius", "middle 1000", "middle 100 000",
                                         "edge 1000", "edge 100 000"},
                             .y_label = "mean squared error",
                             .log_x = true,
                             .log_y = true};
    std::vector<DensityEstimateSettings> ways;
    for (int i = 0; i <= 16; ++i)
        ways.push_back({.radius = float(0.05 * std::exp2(i / 3.0))});
    std::array<std::vector<double>, 4> found;
    for (const std::size_t i : {0u, 1u, 2u, 3u})
        found[i] = errors(stage, i % 2 == 0 ? 1000 : 100000, sizes.seeds,
                          i < 2 ? middle : edge, ways);
    for (std::size_t i = 0; i < ways.size(); ++i)
        by_radius.rows.push_back({double(ways[i].radius), found[0][i], found[1][i],
                                  found[2][i], found[3][i]});
    save_plot(options.out, by_radius);

    examples::Plot by_number{
        .name = "caustics-number",
        .columns = {"photons aimed", "middle", "edge", "N^(-2/3)", "N^(-1/3)"},
        .y_label = "mean squared error at the best radius",
        .log_x = true,
        .log_y = true};
    for (int i = 0; i <= options.pick(4, 6, 7); ++i) {
        const double count = std::round(300 * std::pow(10.0, i / 2.0));
        const auto n = static_cast<long long>(count);
        const auto best = [&](const Strip& strip, double radius) {
            const auto all = errors(stage, n, sizes.seeds, strip, around(radius));
            return *std::min_element(all.begin(), all.end());
        };
        const double smooth = best(middle, 2.6 * std::pow(count, -1.0 / 6));
        const double sharp = best(edge, 4.0 * std::pow(count, -1.0 / 3));
        by_number.rows.push_back({count, smooth, sharp, 0, 0});
    }
    // The laws, as straight lines below the last points.
    const examples::Row last = by_number.rows.back();
    for (auto& row : by_number.rows) {
        row[3] = 0.6 * last[1] * std::pow(row[0] / last[0], -2.0 / 3);
        row[4] = 0.6 * last[2] * std::pow(row[0] / last[0], -1.0 / 3);
    }
    save_plot(options.out, by_number);
    const auto slope = [&](std::size_t column) {
        double xy = 0, xx = 0, mx = 0, my = 0;
        for (const auto& row : by_number.rows) {
            mx += std::log(row[0]) / double(by_number.rows.size());
            my += std::log(row[column]) / double(by_number.rows.size());
        }
        for (const auto& row : by_number.rows) {
            xy += (std::log(row[0]) - mx) * (std::log(row[column]) - my);
            xx += (std::log(row[0]) - mx) * (std::log(row[0]) - mx);
        }
        return xy / xx;
    };
    save_table(
        options.out,
        examples::Table{.name = "caustics-slopes",
                        .columns = {"where", "law", "measured"},
                        .rows = {{"middle", "-0.67", examples::text(slope(1), "%.2f")},
                                 {"edge", "-0.33", examples::text(slope(2), "%.2f")}}});
    if (!options.quiet)
        std::printf("slopes of the best error: middle %.3f, edge %.3f\n", slope(1),
                    slope(2));

    examples::Table table{.name = "caustics-kernels",
                          .columns = {"kernel", "mean of w^2", "middle, r = 0.25",
                                      "middle, best r", "edge, r = 0.25",
                                      "edge, best r"}};
    constexpr std::array squares{"1", "1.5", "1.313", "1.333", "1.8"};
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        std::vector<std::string> row{kernel_names[k], squares[k]};
        for (const Strip& strip : {middle, edge}) {
            auto tried = around(strip.first < 0 ? 0.6 : 0.2, kernels[k]);
            tried.push_back({.radius = 0.25f, .kernel = kernels[k]});
            const auto all = errors(stage, 10000, sizes.seeds, strip, tried);
            const auto best = std::min_element(all.begin(), all.end() - 1);
            row.push_back(examples::text(std::sqrt(all.back()), "%.3f"));
            row.push_back(
                examples::text(std::sqrt(*best), "%.3f") + " (r = " +
                examples::text(double(tried[std::size_t(best - all.begin())].radius),
                               "%.2f") +
                ")");
        }
        table.rows.push_back(row);
    }
    save_table(options.out, table);
}

// --- Figure 8 -------------------------------------------------------------------------

/// The caustic photons as dots.
void figure_8(const examples::Options& options) {
    const auto room = four_glass_room();
    const auto traced = trace_photons(room.scene, MapType::caustics,
                                      {.photons = 20000, .seed = options.seed});
    const int size = std::max(300, options.width);
    Image image = scene_drawing(room.scene, room.camera, size, size);
    const auto color = [](const Photon& photon) { return dot_color(photon); };
    (void)add_photon_dots(image, room.scene, room.camera, traced.photons,
                          {.radius = 1.2f, .brightness = 0.7f}, color);
    save_png(image, options.path("fig-8.png"));
}
// --- Figure 11 and table 2 ------------------------------------------------------------

/// The caustics without a radius: each photon is joined to the pinhole, and counted in
/// the pixel that sees it. A pixel's radiance is the mean over its solid angle, of which
/// the surface around the photon covers cos dA / d^2.
// [light image]
template <typename S>
Image light_image(const Room<S>& room, const RenderSettings& picture,
                  long long photons) {
    const Camera& camera = room.camera;
    Image image = make_image(picture.width, picture.height);
    const double side = 2 * double(camera.half_height) / picture.height;
    const long long batches = std::max(1LL, photons / 500000);
    for (long long batch = 0; batch < batches; ++batch) {
        const auto traced =
            trace_photons(room.scene, MapType::caustics,
                          {.photons = photons / batches,
                           .seed = picture.seed,
                           .iteration = static_cast<std::uint64_t>(batch),
                           .threads = picture.threads});
        for (const Photon& photon : traced.photons) {
            const auto place = photon_in_sight(room.scene, camera, photon,
                                               picture.width, picture.height);
            if (!place) continue;
            const Vec3 way = photon.position - camera.position;
            const double d = double(glm::length(way));
            const Ray ray{.origin = camera.position, .direction = way / float(d)};
            const auto hit = closest_hit(room.scene, ray);
            if (!hit) continue;
            const auto at = vertex_at(room.scene, ray, *hit);
            const Vec3 wo = to_local(at.frame, -ray.direction);
            const Vec3 wi = to_local(at.frame, -photon.direction);
            const Rgb f = room.scene.visit_material(
                at.object.material,
                [&](const auto& material) { return evaluate(material, wo, wi); });
            const double film = double(glm::dot(ray.direction, camera.forward));
            const double angle = side * side * film * film * film;
            pixel(image, int(place->x), int(place->y)) +=
                float(double(std::abs(wo.z)) / (d * d * angle * double(batches))) * f *
                photon.flux;
        }
        examples::stop_if_asked();
    }
    return image;
}
// [light image]

/// A log that keeps the light of E D S+ L: what the caustics map adds at the first
/// surface, seen with nothing between.
struct CausticLog {
    Rgb sum{0};
    bool first = true;

    void begin() { first = true; }
    void vertex(char, const Vec3&, const Rgb&, float) { first = false; }
    void term(std::string_view owner, std::string_view, const Rgb& value) {
        if (first && owner == "caustics map") sum += value;
    }
};

/// A photon mapper of which the picture shows the caustics alone.
template <typename Renderer>
struct CausticsOf {
    using Stream = typename Renderer::Stream;
    const Renderer& renderer; ///< The whole.
};

/// The caustics' share of what radiance() finds for the whole.
template <typename Renderer, typename Log>
Rgb radiance(const CausticsOf<Renderer>& part, const Ray& ray, RandomStream& stream,
             Counts& counts, Log&&) {
    CausticLog log;
    (void)radiance(part.renderer, ray, stream, counts, log);
    return log.sum;
}

template <typename Renderer>
RenderedT<float> rendered(const std::string& name, const Renderer& renderer,
                          const Camera& camera, RenderSettings picture,
                          const examples::Options& options) {
    examples::ProgressBar bar(name, options.quiet);
    picture.progress = bar;
    picture.threads = options.threads;
    auto result = render(renderer, camera, picture);
    examples::stop_if_asked();
    return result;
}

/// The squared error of a picture in some of its pixels, mean over channels.
double squared_error(const Image& image, const Image& truth,
                     const std::vector<bool>& region) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < region.size(); ++i) {
        if (!region[i]) continue;
        const Rgb e = image.pixels[i] - truth.pixels[i];
        sum += double(glm::dot(e, e)) / 3;
        count += 1;
    }
    return count > 0 ? sum / count : 0;
}

/// Whether a pixel and a little around it see the same matt object.
template <typename S>
bool sees_matt(const Room<S>& room, const examples::Options& options, int x, int y) {
    std::optional<ObjectId> first;
    for (const Vec2 offset : {Vec2{-0.2f, -0.2f}, Vec2{1.2f, -0.2f}, Vec2{-0.2f, 1.2f},
                              Vec2{1.2f, 1.2f}, Vec2{0.5f, 0.5f}}) {
        const auto hit = closest_hit(
            room.scene, primary_ray(room.camera, Vec2{float(x), float(y)} + offset,
                                    options.width, options.height));
        if (!hit || (first && hit->object != *first)) return false;
        first = hit->object;
        if (room.scene.visit_material(
                room.scene.object(hit->object).material,
                [](const auto& m) { return lobes(m) != Lobes::diffuse; }))
            return false;
    }
    return true;
}

/// Figure 11 and table 2: the report's settings, and beside the time the error of the
/// caustics.
void table_2(const examples::Options& options, const Sizes& sizes) {
    const auto room = four_glass_room();
    // The reference in two halves, which tell its own error.
    const long long photons = options.pick(1, 10, 100) * sizes.photons;
    std::array<Image, 2> halves;
    for (const std::size_t i : {0u, 1u})
        halves[i] = light_image(room,
                                {.width = options.width,
                                 .height = options.height,
                                 .seed = 1001 + i,
                                 .threads = options.threads},
                                photons);
    Image truth = halves[0];
    double mean = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        truth.pixels[i] = (halves[0].pixels[i] + halves[1].pixels[i]) / 2.0f;
        mean += double(luminance(truth.pixels[i])) / double(truth.pixels.size());
    }
    // The caustic region: pixels that see one matt surface with all of their area, and
    // in it, with their neighbours, more than the mean of the caustics' light.
    std::vector<bool> region;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            double sum = 0, count = 0;
            for (int j = std::max(0, y - 1); j <= std::min(truth.height - 1, y + 1);
                 ++j)
                for (int i = std::max(0, x - 1); i <= std::min(truth.width - 1, x + 1);
                     ++i, ++count)
                    sum += double(luminance(pixel(truth, i, j)));
            region.push_back(sum / count > mean && sees_matt(room, options, x, y));
        }
    const double noise = squared_error(halves[0], truth, region);
    double level = 0, pixels = 0;
    for (std::size_t i = 0; i < region.size(); ++i)
        if (region[i]) level += double(luminance(truth.pixels[i])), pixels += 1;
    level /= std::max(pixels, 1.0);

    examples::Table table{.name = "table-2",
                          .columns = {"photons", "the report's time", "photons, s",
                                      "picture, s", "RMSE of the caustics", "of all",
                                      "stored", "found by a query"}};
    examples::Table strip{.name = "fig-11-errors", .columns = {"photons"}, .rows = {}};
    std::vector<std::string> errors_row{"RMSE"}, relative_row{"of all"};
    std::vector<Image> pictures;
    double none = 1;
    const std::array counts{0LL, 1000LL, 10000LL, 100000LL, 1000000LL};
    constexpr std::array report{"26 s", "37 s", "44 s", "53 s", ""};
    for (std::size_t i = 0; i < counts.size(); ++i) {
        PhotonMappingSettings settings{.max_depth = 4, .roulette_depth = 5};
        settings.caustics.photons = std::min(counts[i], sizes.photons);
        settings.caustics.seed = options.seed;
        settings.caustics.threads = options.threads;
        settings.caustics_estimate.radius = 0.05f; // the report's
        const double start = examples::processor_seconds();
        const auto maps = make_photon_maps(room.scene, settings);
        const double first_pass = examples::processor_seconds() - start;
        const auto mapper = make_photon_mapper(room.scene, maps, settings);
        const std::string name = "fig-11-" + std::to_string(counts[i]);
        const RenderSettings picture{options.width, options.height, options.samples,
                                     options.seed};
        const auto result = rendered(name, mapper, room.camera, picture, options);
        const double second_pass = examples::processor_seconds() - start - first_pass;
        save_png(result.image, options.path(name + ".png"));
        pictures.push_back(result.image);

        settings.indirect = IndirectLight::none; // for the caustics at D alone
        const auto direct = make_photon_mapper(room.scene, maps, settings);
        const Image part =
            rendered(name + " caustics", CausticsOf<decltype(direct)>{direct},
                     room.camera, picture, options)
                .image;
        const double error =
            std::sqrt(std::max(0.0, squared_error(part, truth, region) - noise));
        if (i == 0) none = error; // all of the caustics' light is missing
        table.rows.push_back(
            {std::to_string(counts[i]), report[i], examples::text(first_pass, "%.2f"),
             examples::text(second_pass, "%.2f"), examples::text(error, "%.3f"),
             examples::text(100 * error / none, "%.1f %%"),
             std::to_string(maps.caustics.records.size()),
             examples::text(result.counts.map_queries == 0
                                ? 0
                                : double(result.counts.map_photons) /
                                      double(result.counts.map_queries),
                            "%.1f")});
        strip.columns.push_back(std::to_string(counts[i]));
        errors_row.push_back(examples::text(error, "%.3f"));
        relative_row.push_back(examples::text(100 * error / none, "%.1f %%"));
    }
    strip.rows = {errors_row, relative_row};
    save_table(options.out, table);
    save_table(options.out, strip);

    // The strip: the pictures side by side.
    const int gap = std::max(1, options.width / 50);
    const int count = static_cast<int>(pictures.size());
    Image all =
        make_image(count * options.width + (count - 1) * gap, options.height, Rgb{1});
    for (int i = 0; i < count; ++i)
        for (int y = 0; y < options.height; ++y)
            for (int x = 0; x < options.width; ++x)
                pixel(all, i * (options.width + gap) + x, y) =
                    pixel(pictures[static_cast<std::size_t>(i)], x, y);
    save_png(all, options.path("fig-11.png"));
    if (!options.quiet) {
        std::printf("reference: noise %.3f of a level of %.3f, %.0f pixels\n",
                    std::sqrt(noise), level, pixels);
        for (const auto& cells : table.rows) {
            for (const auto& cell : cells) std::printf("%-10s ", cell.c_str());
            std::printf("\n");
        }
    }
}

} // namespace

/// Makes the figures of chapter 26.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; 2 with one sentence for anything that is wrong.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 26, caustics: figures 8 and 11, table 2.");
        line.add("--photons", sizes.photons, "The largest number of photons", 1,
                 100000000);
        line.add("--seeds", sizes.seeds, "Maps behind each error", 1, 1000);
        const examples::Options options =
            line.parse({.draft{.width = 160, .height = 160, .samples = 6},
                        .report{.width = 400, .height = 400, .samples = 64},
                        .reference{.width = 400, .height = 400, .samples = 1024}});
        if (!line.given("--photons")) sizes.photons = 1000000;
        if (!line.given("--seeds")) sizes.seeds = options.pick(4, 16, 64);
        profile(options, options.pick(sizes.photons / 5, sizes.photons, sizes.photons));
        laws(options, sizes);
        figure_8(options);
        table_2(options, sizes);
    });
}
