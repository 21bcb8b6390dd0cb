// figures: flight
// smoke: --quality draft --width 16 --height 9 --rays 1 --frames 3 --photons 1000
/// \file chapters/experiments/01_flight_experiments.cpp
/// \brief A sequence of frames: the camera flies once around the room's balls, and the
/// photons stay where they are.
///
///     01_flight --out film --frames 240
///     ffmpeg -i film/flight-%04d.png film.mp4     # or any program that joins them

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/ljus.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "common/terminal.hpp"

namespace {

using ljus::Image;
using ljus::Rgb;
using ljus::Vec3;

/// A floor with a ring of balls around one of glass, under a lamp and a dim sky lamp.
auto make_place() {
    ljus::Scene<ljus::Shapes<ljus::Sphere, ljus::Quad>,
                ljus::Materials<ljus::Lambertian, ljus::Glass, ljus::Mirror>>
        scene;
    const auto floor = scene.add(ljus::Lambertian{.albedo{0.6f, 0.58f, 0.55f}});
    const auto glass = scene.add(ljus::Glass{.index = 1.5f});
    const auto mirror = scene.add(ljus::Mirror{.reflectance = Rgb{0.9f}});
    scene.add(ljus::Quad{.corner{-9, 0, 9}, .edge_u{18, 0, 0}, .edge_v{0, 0, -18}},
              floor);
    scene.add(ljus::Sphere{.center{0, 1, 0}, .radius = 0.9f}, glass);
    for (int i = 0; i < 8; ++i) {
        const float angle = float(i) * std::numbers::pi_v<float> / 4;
        const ljus::Sphere ball{
            .center{2.4f * std::cos(angle), 0.45f, 2.4f * std::sin(angle)},
            .radius = 0.45f};
        const float hue = float(i) / 8;
        const auto wave = [&](float phase) {
            return 0.45f + 0.35f * std::cos(6.2831853f * (hue + phase));
        };
        const auto matt = scene.add(
            ljus::Lambertian{.albedo{wave(0), wave(1.0f / 3), wave(2.0f / 3)}});
        scene.add(ball, i % 4 == 0 ? mirror : matt);
    }
    scene.add(ljus::Sphere{.center{-3, 6, -2}, .radius = 0.5f}, floor, Rgb{70});
    scene.add(ljus::Quad{.corner{-9, 9, -9}, .edge_u{18, 0, 0}, .edge_v{0, 0, 18}},
              floor, Rgb{0.25f, 0.3f, 0.4f});
    return ljus::World(std::move(scene));
}

/// The camera at a moment of the flight: once around, rising and sinking; the end is
/// the beginning.
/// \param moment  In [0, 1).
ljus::Camera camera_at(float moment) {
    const float turn = 2 * std::numbers::pi_v<float> * moment;
    return ljus::look_at(
        {.position{6 * std::sin(turn), 2.4f + std::sin(2 * turn), 6 * std::cos(turn)},
         .target{0, 0.7f, 0},
         .vfov_degrees = 42 - 6 * std::cos(turn)});
}
/// Places a frame on the contact sheet.
void paste(Image& sheet, const Image& frame, int column, int row) {
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            pixel(sheet, column * frame.width + x, row * frame.height + y) =
                pixel(frame, x, y);
}

/// "flight-0007.png".
std::string name_of_frame(int number) {
    char name[32];
    std::snprintf(name, sizeof name, "flight-%04d.png", number);
    return name;
}

void body(examples::CommandLine& line) {
    int frames = 0;
    long long photons = 0;
    line.about("A sequence of frames: the camera flies once around a ball of glass.");
    line.add("--frames", frames, "How many; 0: by the quality", 0, 100000);
    line.add("--photons", photons, "Of the caustics map; 0: by the quality", 0,
             100000000);
    const examples::Options options =
        line.parse({.draft{.width = 160, .height = 90, .samples = 4},
                    .report{.width = 480, .height = 270, .samples = 36},
                    .reference{.width = 1280, .height = 720, .samples = 256}});
    if (frames == 0) frames = options.pick(8, 24, 240);
    if (photons == 0) photons = options.pick(20000LL, 200000LL, 2000000LL);

    const auto world = make_place();
    const ljus::PhotonMappingSettings settings{
        .caustics{.photons = photons, .seed = options.seed, .threads = options.threads},
        .caustics_estimate{.radius = options.pick(0.2f, 0.07f, 0.02f)}};
    // Photons do not know where the camera is: one map serves all frames.
    // [frames]
    const examples::StopWatch watch;
    const ljus::PhotonMapper mapper(world, settings);
    const double first_pass = watch.seconds();
    const int columns = std::min(frames, 4), rows = std::min(2, (frames + 3) / 4);
    Image sheet = ljus::make_image(columns * options.width, rows * options.height);
    examples::ProgressBar bar("flight", options.quiet);
    for (int i = 0; i < frames; ++i) {
        const auto seen =
            render(mapper, camera_at(float(i) / float(frames)),
                   {.width = options.width,
                    .height = options.height,
                    .samples = options.samples,
                    // Each frame has its own noise; with one seed for all, the noise
                    // would stand still on the screen, like dirt on a lens.
                    .seed = options.seed + static_cast<std::uint64_t>(i),
                    .threads = options.threads});
        examples::stop_if_asked();
        save_png(seen.image, options.path(name_of_frame(i)));
        (void)bar(i + 1, frames);
        const int places = columns * rows;
        for (int k = 0; k < places; ++k)
            if (k * frames / places == i)
                paste(sheet, seen.image, k % columns, k / columns);
    }
    // [frames]
    const double all = watch.seconds();
    save_png(sheet, options.path("flight.png"));
    if (!options.quiet)
        std::printf("%d frames; the photons %.2f s once, each frame %.2f s\n", frames,
                    first_pass, (all - first_pass) / frames);
}

} // namespace

/// Flies the camera.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, body);
}
