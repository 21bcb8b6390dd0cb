// smoke: --quality draft --width 24 --height 24 --rays 1 --photons 300 --seeds 2
/// \file chapters/experiments/26_experiments.cpp
/// \brief Chapter 26: a caustic in closed form; the errors of figure 11.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <ljus/inspect/photon_dots.hpp>
#include <ljus/ljus.hpp>
#include <ljus/path/light_transport.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "common/rendered.hpp"
#include "experiments/show_table.hpp"
#include "experiments/white_floor.hpp"
#include "experiments/window.hpp"

using namespace ljus;

namespace {

constexpr double pi = std::numbers::pi;

/// The options of this program, besides the common ones.
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

/// The point where a ray of light lands, and its fraction of the flux.
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

/// A floor, and what stands above it.
using Stage = Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass, Mirror>,
                    Lights<PointLight>>;

/// The irradiance that an estimate reads on the floor.
double read(const PhotonMap& map, const Vec3& at,
            const DensityEstimateSettings& gather) {
    return examples::irradiance_read(map, at, Vec3{0, 1, 0}, gather);
}

PhotonMap map_of(const World<Stage>& stage, long long photons, std::uint64_t seed) {
    return make_photon_map(
        trace_photons(stage, MapType::caustics, {.photons = photons, .seed = seed})
            .photons);
}

World<Stage> ball_stage(const Setup& setup) {
    Stage stage;
    examples::add_floor(stage, float(-setup.floor));
    stage.add(Sphere{.radius = float(setup.radius)},
              stage.add(Glass{.index = float(setup.index)}));
    stage.add(PointLight{.position{0, float(setup.light), 0}});
    return World(std::move(stage));
}

/// The profile of the caustic, by geometric optics and by photons.
void profile(const examples::Options& options, long long photons) {
    const Setup setup;
    const World stage = ball_stage(setup);
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
}

// --- The errors of figure 11 ----------------------------------------------------------

/// The caustics without a radius: each photon is connected to the pinhole, and counted
/// in the pixel that sees it. A pixel's radiance is the mean over its solid angle. An
/// area dA around the photon covers cos dA / d^2 of that angle.
template <typename S>
Image light_image(const Room<S>& room, const RenderSettings& picture,
                  long long photons) {
    const Camera& camera = room.camera;
    Image image = make_image(picture.width, picture.height);
    const double side = 2 * double(camera.half_height) / picture.height;
    const long long batches = std::max(1LL, photons / 500000);
    for (long long batch = 0; batch < batches; ++batch) {
        const auto traced =
            trace_photons(room.world, MapType::caustics,
                          {.photons = photons / batches,
                           .seed = picture.seed,
                           .iteration = static_cast<std::uint64_t>(batch),
                           .threads = picture.threads});
        for (const Photon& photon : traced.photons) {
            const auto place = photon_in_sight(room.world, camera, photon,
                                               picture.width, picture.height);
            if (!place) continue;
            const Vec3 way = photon.position - camera.position;
            const double d = double(glm::length(way));
            const Ray ray{.origin = camera.position, .direction = way / float(d)};
            const auto hit = closest_hit(room.world, ray);
            if (!hit) continue;
            const auto at = vertex_at(room.world, ray, *hit);
            const Vec3 wo = to_local(at.frame, -ray.direction);
            const Vec3 wi = to_local(at.frame, -photon.direction);
            const Rgb f = room.world.visit_material(
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
            room.world, primary_ray(room.camera, Vec2{float(x), float(y)} + offset,
                                    options.width, options.height));
        if (!hit || (first && hit->object != *first)) return false;
        first = hit->object;
        if (room.world.visit_material(
                room.world.object(hit->object).material,
                [](const auto& m) { return lobes(m) != Lobes::diffuse; }))
            return false;
    }
    return true;
}

/// The true light of the caustics, and the pixels in which it is bright.
struct CausticTruth {
    Image light = {};              ///< The mean of two halves.
    std::vector<bool> region = {}; ///< Pixels with more of it than the mean.
    double noise = 0;              ///< Its own squared error in the region.
    double level = 0;              ///< Its mean in the region.
    double pixels = 0;             ///< Of the region.
};

/// Pixels whose whole area sees one matt surface, and that are brighter than the mean
/// together with their neighbours.
template <typename S>
std::vector<bool> caustic_region(const Room<S>& room, const Image& light,
                                 const examples::Options& options) {
    double mean = 0;
    for (const Rgb& color : light.pixels)
        mean += double(luminance(color)) / double(light.pixels.size());
    std::vector<bool> region;
    for (int y = 0; y < light.height; ++y)
        for (int x = 0; x < light.width; ++x) {
            double sum = 0, count = 0;
            for (int j = std::max(0, y - 1); j <= std::min(light.height - 1, y + 1);
                 ++j)
                for (int i = std::max(0, x - 1); i <= std::min(light.width - 1, x + 1);
                     ++i, ++count)
                    sum += double(luminance(pixel(light, i, j)));
            region.push_back(sum / count > mean && sees_matt(room, options, x, y));
        }
    return region;
}

/// The reference as the mean of two pictures; their difference gives its error.
template <typename S>
CausticTruth caustic_truth(const Room<S>& room, const examples::Options& options,
                           long long photons) {
    std::array<Image, 2> halves;
    for (const std::size_t i : {0u, 1u})
        halves[i] = light_image(room,
                                {.width = options.width,
                                 .height = options.height,
                                 .seed = 1001 + i,
                                 .threads = options.threads},
                                photons);
    CausticTruth truth{.light = halves[0]};
    for (std::size_t i = 0; i < truth.light.pixels.size(); ++i)
        truth.light.pixels[i] = (halves[0].pixels[i] + halves[1].pixels[i]) / 2.0f;
    truth.region = caustic_region(room, truth.light, options);
    truth.noise = squared_error(halves[0], truth.light, truth.region);
    for (std::size_t i = 0; i < truth.region.size(); ++i) {
        if (!truth.region[i]) continue;
        truth.level += double(luminance(truth.light.pixels[i]));
        truth.pixels += 1;
    }
    truth.level /= std::max(truth.pixels, 1.0);
    return truth;
}

/// How far the caustics of figure 11 are off where a camera ray meets them first: root
/// mean square.
template <typename S>
double error_of_caustics(const Room<S>& room, const CausticTruth& truth,
                         long long photons, const examples::Options& options) {
    const PhotonMapper mapper(room.world,
                              {.max_depth = 4,
                               .roulette_depth = 5,
                               .indirect = IndirectLight::none,
                               .caustics{.photons = photons,
                                         .seed = options.seed,
                                         .threads = options.threads},
                               .caustics_estimate{.radius = 0.05f}}); // the report's
    const OnlyPaths caustics(mapper, "EDS+L");
    const Image image = examples::rendered(std::to_string(photons) + " photons",
                                           caustics, room.camera, options)
                            .image;
    return std::sqrt(
        std::max(0.0, squared_error(image, truth.light, truth.region) - truth.noise));
}

/// The errors of figure 11, in W/(m^2 sr) and of a picture without caustics.
void errors_of_figure_11(const examples::Options& options, const Sizes& sizes) {
    const auto room = four_glass_room();
    const CausticTruth truth =
        caustic_truth(room, options, options.pick(1, 10, 100) * sizes.photons);
    examples::Table table{.name = "fig-11-errors",
                          .columns = {"photons"},
                          .rows = {{"RMSE"}, {"of all"}}};
    double none = 1;
    for (const long long count : {0, 1000, 10000, 100000, 1000000}) {
        const double error =
            error_of_caustics(room, truth, std::min(count, sizes.photons), options);
        if (count == 0) none = error; // all of the caustics' light is missing
        table.columns.push_back(std::to_string(count));
        table.rows[0].push_back(examples::text(error, "%.3f"));
        table.rows[1].push_back(examples::text(100 * error / none, "%.1f %%"));
    }
    examples::show_table(options, table);
    if (!options.quiet)
        std::printf("reference: noise %.3f of a level of %.3f, %.0f pixels\n",
                    std::sqrt(truth.noise), truth.level, truth.pixels);
}

} // namespace

/// Makes the plots, tables and pictures of chapter 26 that are not the report's.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 26, caustics: the experiments behind plots and tables.");
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
        errors_of_figure_11(options, sizes);
    });
}
