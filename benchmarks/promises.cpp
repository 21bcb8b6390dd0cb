/// \file promises.cpp
/// \brief Whether the errors that `render --seconds` and `--error` state are true: in
/// scenes that are drawn at random, and in open ones below a far lamp.
///
///     bench_promises --csv chapters/measured      in minutes
///
/// The reference of each scene is path traced in two halves, whose difference tells its
/// own noise; that is subtracted. A promise is kept if the upper end of the interval
/// that is stated is at least two thirds of the measured error.

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "common/promised_picture.hpp"
#include "csv.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/random_scene.hpp"

namespace {

using namespace ljus;

constexpr int width = 48, height = 36;

/// The mean of two path-traced halves, and its own error.
struct Truth {
    ImageT<double> image{};
    double noise = 0;       ///< relMSE.
    double block_noise = 0; ///< The same of squares of 8 x 8 pixels.
};

template <typename W, typename C>
Truth truth_of(const W& world, const C& camera, int rays) {
    const PathTracer tracer(world);
    const auto half = [&](std::uint64_t seed) {
        return render(tracer, camera,
                      {.width = width, .height = height, .samples = rays, .seed = seed})
            .image;
    };
    const auto a = half(1'000'003), b = half(2'000'003);
    Truth truth{.image = make_image<double>(width, height)};
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        truth.image.pixels[i] =
            (RgbT<double>(a.pixels[i]) + RgbT<double>(b.pixels[i])) / 2.0;
    truth.noise = rel_mse(a, truth.image);
    truth.block_noise = block_error(a, truth.image, examples::PictureCheck::side);
    return truth;
}

/// Counts promises, and those that are kept.
struct Score {
    int runs = 0, pixels = 0, blocks = 0;
};

/// Promises seconds, and an error: a row for each.
template <typename W, typename C>
void try_promises(examples::Table& table, Score& score, const std::string& name,
                  const W& world, const C& camera, int rays = 512) {
    using examples::two_digits;
    const Truth truth = truth_of(world, camera, rays);
    for (const examples::Promise& promise :
         {examples::Promise{.seconds = 0.5}, {.error = 0.02}}) {
        const std::clock_t begin = std::clock();
        const auto now = [begin] {
            return double(std::clock() - begin) / double(CLOCKS_PER_SEC);
        };
        const auto kept = keep(world, camera, {.width = width, .height = height},
                               promise, now, true, [](const auto&) {});
        const bool timed = promise.seconds > 0;
        table.rows.push_back(
            {name,
             two_digits(timed ? promise.seconds : promise.error) + (timed ? " s" : ""),
             kept.recipe.name});
        // Adds what was stated and measured; returns whether the promise was kept.
        const auto add = [&](const examples::ErrorInterval& stated, double error) {
            const double ratio = stated.high / error;
            for (const std::string& cell :
                 {two_digits(stated.low) + " to " + two_digits(stated.high),
                  two_digits(error), two_digits(ratio)})
                table.rows.back().push_back(cell);
            return error <= 0 || 1.5 * ratio >= 1;
        };
        const auto& image = kept.rendered.image;
        ++score.runs;
        score.pixels +=
            add(kept.stated.pixels, rel_mse(image, truth.image) - truth.noise);
        score.blocks +=
            add(kept.stated.blocks,
                block_error(image, truth.image, examples::PictureCheck::side) -
                    truth.block_noise);
        table.rows.back().push_back(two_digits(truth.noise));
        examples::print_row(table.rows.back(), 8);
        std::fflush(stdout);
    }
}

/// A plain, a wall, and balls of mirror and glass below a lamp far away.
/// \param radius  Of the lamp. Its irradiance is the same for each.
auto open_scene(float radius) {
    const Lambertian white{.albedo = Rgb{0.75f}}, red{.albedo{0.7f, 0.25f, 0.2f}};
    return World(make_scene(
        placed(Quad{{-10, 0, -10}, {0, 0, 20}, {20, 0, 0}}, white),
        placed(Quad{{-2.5f, 0, -1.5f}, {5, 0, 0}, {0, 2.5f, 0}}, red),
        placed(Sphere{{-1.1f, 0.6f, 0.2f}, 0.6f}, Mirror{.reflectance = Rgb{0.95f}}),
        placed(Sphere{{0.9f, 0.6f, 0.6f}, 0.6f}, Glass{}),
        placed(Sphere{{248, 398, 174}, radius}, Lambertian{.albedo = Rgb{0}},
               Rgb{149 * 40 * 40 / (radius * radius)})));
}

} // namespace

/// Keeps promises in all scenes.
int main(int argc, char** argv) {
    examples::Table table{.name = "trades-stated",
                          .columns = {"scene", "promised", "chosen", "relMSE, stated",
                                      "measured", "ratio", "of blocks, stated",
                                      "measured of blocks", "ratio of blocks",
                                      "noise of the truth"}};
    Score score;
    for (const auto& [name, radius] :
         {std::pair{"open, a small far lamp", 10.0f}, {"open, a far lamp", 40.0f}}) {
        const auto open = open_scene(radius);
        const Camera camera =
            look_at({.position{0, 2.2f, 7}, .target{0, 0.8f, 0}, .vfov_degrees = 40});
        try_promises(table, score, name, open, camera, 8192); // for its reflections
    }
    for (int scene = 1; scene <= 20; ++scene) {
        const auto drawn = ljus_test::SceneDrawer(2000 + std::uint64_t(scene)).draw();
        try_promises(table, score, std::to_string(scene), drawn.world, drawn.camera);
    }
    const std::string of = " of " + std::to_string(score.runs);
    table.rows.push_back({"kept", "", "", std::to_string(score.pixels) + of, "", "",
                          std::to_string(score.blocks) + of, "", "", ""});
    examples::print_row(table.rows.back(), 8);
    save_csv(csv_folder(argc, argv), table);
    return 0;
}
