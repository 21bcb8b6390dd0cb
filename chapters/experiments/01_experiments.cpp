// smoke: --quality draft --width 24 --height 16 --rays 2 --pixels 8
/// \file chapters/experiments/01_experiments.cpp
/// \brief Chapter 1: the error of patterns of rays in a pixel; exposures and fields
/// of view.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/example.hpp"
#include "experiments/middle_rays.hpp"

namespace {

using ljus::Camera;
using ljus::Image;
using ljus::Ray;
using ljus::Rgb;
using ljus::Sampling;
using ljus::Vec2;
using ljus::Vec3;

constexpr Sampling patterns[] = {Sampling::random, Sampling::jittered,
                                 Sampling::multi_jittered, Sampling::sobol};
constexpr const char* names[] = {"random", "jittered", "multi-jittered", "Sobol"};

/// A renderer that sees a picture in the plane at distance 1: a disc, and light that
/// changes smoothly.
struct TestCard {
    using Stream = ljus::RandomStream;
    bool edges = true;

    [[nodiscard]] double value(double x, double y) const {
        if (edges) return x * x + y * y < 0.62 ? 1 : 0;
        return 0.5 + 0.5 * std::sin(3 * x + x * y) * std::exp(-y);
    }
};

template <typename Context>
Rgb radiance(const TestCard& card, const Ray& ray, Context&) {
    const Vec3 d = ray.direction / -ray.direction.z;
    return Rgb(float(card.value(double(d.x), double(d.y))));
}

/// The rms error of pixels that are not all black or all white.
double error(const TestCard& card, Sampling sampling, int rays, int pixels,
             const Image& truth, int seeds) {
    const Camera camera = ljus::look_at({.vfov_degrees = 90});
    double sum = 0;
    int count = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        const auto seen = render(card, camera,
                                 {.width = pixels,
                                  .height = pixels,
                                  .samples = rays,
                                  .seed = static_cast<std::uint64_t>(seed),
                                  .sampling = sampling});
        for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
            const double exact = double(truth.pixels[i].x);
            if (card.edges && (exact == 0 || exact == 1)) continue;
            sum += std::pow(double(seen.image.pixels[i].x) - exact, 2);
            ++count;
        }
    }
    return std::sqrt(sum / count);
}

/// The exact mean of a pixel, from its lower left corner: column by column, the disc's
/// height in it; or by the midpoint rule.
double mean_of_pixel(const TestCard& card, double x, double y, double size) {
    const int columns = card.edges ? 4000 : 100, rows = card.edges ? 1 : 100;
    double sum = 0;
    for (int i = 0; i < columns; ++i) {
        const double at = x + size * (i + 0.5) / columns;
        if (card.edges) {
            const double top = std::sqrt(std::max(0.0, 0.62 - at * at));
            const double low = std::clamp(y, -top, top);
            sum += (std::clamp(y + size, -top, top) - low) / size;
        } else {
            for (int j = 0; j < rows; ++j)
                sum += card.value(at, y + size * (j + 0.5) / rows);
        }
    }
    return sum / (columns * rows);
}

/// Two plots: how the error of a pixel falls with the number of its rays.
void plot_errors(const std::string& folder, int pixels, int most) {
    std::array<Image, 2> truth;
    const double size = 2.0 / pixels;
    for (const bool edges : {false, true}) {
        truth[edges] = ljus::make_image(pixels, pixels);
        for (int y = 0; y < pixels; ++y)
            for (int x = 0; x < pixels; ++x)
                pixel(truth[edges], x, y) = Rgb(float(
                    mean_of_pixel({edges}, -1 + x * size, 1 - (y + 1) * size, size)));
    }
    for (const bool edges : {false, true}) {
        examples::Plot plot{.name = edges ? "patterns-edge" : "patterns-smooth",
                            .columns = {"rays per pixel", "random", "jittered",
                                        "multi-jittered", "Sobol"},
                            .y_label = "rms error per pixel",
                            .log_x = true,
                            .log_y = true};
        for (int rays = 4; rays <= most; rays *= 4) {
            examples::Row row{double(rays)};
            for (const Sampling sampling : patterns)
                row.push_back(error({edges}, sampling, rays, pixels, truth[edges], 2));
            plot.rows.push_back(row);
        }
        save_plot(folder, plot);
        const examples::Row first = plot.rows[1], last = plot.rows.back();
        for (std::size_t k = 1; k < 5; ++k)
            std::printf("%s, %s: slope %.2f\n", plot.name.c_str(), names[k - 1],
                        std::log(last[k] / first[k]) / std::log(last[0] / first[0]));
    }
}

/// A floor of tiles to the horizon, too fine for the pixels.
struct Tiles {
    using Stream = ljus::RandomStream;
};

template <typename Context>
Rgb radiance(const Tiles&, const Ray& ray, Context&) {
    if (!(ray.direction.y < 0)) return {0.35f, 0.5f, 0.8f};
    const Vec3 p = point_at(ray, -ray.origin.y / ray.direction.y);
    const bool dark = (std::fmod(std::floor(p.x) + std::floor(p.z), 2.0f) != 0);
    return dark ? Rgb{0.05f} : Rgb{0.8f};
}

/// Four pictures of the tiles, one for each pattern, and one of a single ray.
void tiles(const examples::Options& options) {
    const Camera camera = ljus::look_at(
        {.position{0, 1.3f, 0}, .target{0.6f, 0.85f, -3}, .vfov_degrees = 40});
    ljus::RenderSettings picture{
        .width = options.width, .height = options.height, .samples = 4};
    const Image truth = render(Tiles{}, camera,
                               {.width = options.width,
                                .height = options.height,
                                .samples = options.pick(256, 1024, 4096)})
                            .image;
    for (std::size_t k = 0; k < 4; ++k) {
        picture.sampling = patterns[k];
        const Image image = render(Tiles{}, camera, picture).image;
        save_png(image, options.path("tiles-" + std::to_string(k) + ".png"));
        std::printf("tiles, 4 rays, %s: rmse %.4f\n", names[k], rmse(image, truth));
    }
    save_png(examples::by_middle_rays(Tiles{}, camera, options.width, options.height),
             options.path("tiles-one.png"));
}

/// One rendering, developed with several exposures, and without the sRGB curve.
void exposures(const examples::Options& options) {
    const auto room = ljus::cornell_box();
    auto settings = examples::picture_settings(options);
    settings.width = options.height; // the room is a square
    const auto seen = examples::rendered("exposure", ljus::PhotonMapper(room.world),
                                         room.camera, settings, options);
    for (int stops = -4; stops <= 4; stops += 2)
        save_png(seen.image, options.path("exposure" + std::to_string(stops) + ".png"),
                 {.exposure = double(stops)});
    // The picture of a program that forgets the curve.
    Image linear = seen.image;
    for (Rgb& c : linear.pixels)
        for (int k = 0; k < 3; ++k) c[k] = float(ljus::srgb_decode(double(c[k])));
    save_png(linear, options.path("exposure-linear.png"));
    // The report's program: divided by the brightest channel.
    float brightest = 0;
    for (const Rgb& c : seen.image.pixels)
        brightest = std::max({brightest, c.x, c.y, c.z});
    save_png(seen.image, options.path("exposure-report.png"),
             {.exposure = -std::log2(double(brightest))});
    std::printf("brightest channel: %.1f\n", double(brightest));
}

/// Balls in a row, through lenses from long to absurdly wide, always with the front of
/// the middle ball of the same size.
void fields_of_view(const examples::Options& options) {
    ljus::Scene<ljus::Shapes<ljus::Sphere, ljus::Quad>,
                ljus::Materials<ljus::Lambertian>>
        scene;
    const auto grey = scene.add(ljus::Lambertian{.albedo = Rgb{0.5f}});
    const auto red = scene.add(ljus::Lambertian{.albedo{0.75f, 0.3f, 0.2f}});
    scene.add(
        ljus::Quad{.corner{-400, -1, 400}, .edge_u{800, 0, 0}, .edge_v{0, 0, -800}},
        grey);
    for (int i = -4; i <= 4; ++i)
        for (int j = -1; j <= 1; ++j)
            scene.add(ljus::Sphere{.center{2.6f * float(i), 0, -2.6f * float(j + 1)},
                                   .radius = 1},
                      red);
    scene.add(ljus::Sphere{.center{-20, 60, 40}, .radius = 12}, grey, Rgb{40});
    const ljus::World world(std::move(scene));
    for (const float angle : {1.0f, 20.0f, 60.0f, 120.0f, 170.0f}) {
        const float distance = 3.5f / std::tan(angle * std::numbers::pi_v<float> / 360);
        const Camera camera =
            ljus::look_at({.position{0, 0.06f * distance, 1 + distance},
                           .target{0, 0, 0},
                           .vfov_degrees = angle});
        const auto seen = examples::rendered("field of view",
                                             ljus::PathTracer(world, {.max_depth = 2}),
                                             camera, options);
        save_png(seen.image,
                 options.path("fov-" + std::to_string(int(angle)) + ".png"));
    }
}

} // namespace

/// Makes the chapter's figures.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        int pixels = 32;
        line.about("Chapter 1: patterns in a pixel, exposures, and fields of view.");
        line.add("--pixels", pixels, "Side of the test card in pixels", 4, 200);
        const examples::Options options =
            line.parse({.draft{.width = 240, .height = 160, .samples = 9},
                        .report{.width = 600, .height = 400, .samples = 64},
                        .reference{.width = 900, .height = 600, .samples = 1024}});
        plot_errors(options.path(""), pixels, options.pick(1024, 4096, 16384));
        tiles(options);
        exposures(options);
        fields_of_view(options);
    });
}
