// smoke: --quality draft --width 16 --height 9 --rays 1 --frames 3 --photons 1000
/// \file 01_flight.cpp
/// \brief Renders the frames of a film. The camera flies once around a ball of glass;
/// all frames use the same photons.
///
///     01_flight --out film --frames 240
///     ffmpeg -i film/flight-%04d.png film.mp4     # or any program that joins them

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// A floor with a ring of balls around a ball of glass, under a lamp and a dim ceiling.
auto ring_of_balls() {
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass, Mirror>> scene;
    const auto floor = scene.add(Lambertian{.albedo{0.6f, 0.58f, 0.55f}});
    const auto glass = scene.add(Glass{.index = 1.5f});
    const auto mirror = scene.add(Mirror{.reflectance = Rgb{0.9f}});
    scene.add(Quad{.corner{-9, 0, 9}, .edge_u{18, 0, 0}, .edge_v{0, 0, -18}}, floor);
    scene.add(Sphere{.center{0, 1, 0}, .radius = 0.9f}, glass);
    for (int i = 0; i < 8; ++i) {
        const float angle = float(i) * std::numbers::pi_v<float> / 4;
        const Sphere ball{
            .center{2.4f * std::cos(angle), 0.45f, 2.4f * std::sin(angle)},
            .radius = 0.45f};
        const auto wave = [hue = float(i) / 8](float phase) {
            return 0.45f + 0.35f * std::cos(6.2831853f * (hue + phase));
        };
        const auto matt =
            scene.add(Lambertian{.albedo{wave(0), wave(1.0f / 3), wave(2.0f / 3)}});
        scene.add(ball, i % 4 == 0 ? mirror : matt);
    }
    scene.add(Sphere{.center{-3, 6, -2}, .radius = 0.5f}, floor, Rgb{70});
    scene.add(Quad{.corner{-9, 9, -9}, .edge_u{18, 0, 0}, .edge_v{0, 0, 18}}, floor,
              Rgb{0.25f, 0.3f, 0.4f});
    return World(std::move(scene));
}

/// The camera at a time in [0, 1). It rises and sinks on its way around the balls, and
/// at time 1 would be where it began.
Camera camera_at(float moment) {
    const float turn = 2 * std::numbers::pi_v<float> * moment;
    return look_at(
        {.position{6 * std::sin(turn), 2.4f + std::sin(2 * turn), 6 * std::cos(turn)},
         .target{0, 0.7f, 0},
         .vfov_degrees = 42 - 6 * std::cos(turn)});
}

/// Puts a frame onto the contact sheet.
void paste(Image& sheet, const Image& frame, int column, int row) {
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            pixel(sheet, column * frame.width + x, row * frame.height + y) =
                pixel(frame, x, y);
}

/// The name of a frame, such as "flight-0007.png".
std::string name_of_frame(int number) {
    char name[32];
    std::snprintf(name, sizeof name, "flight-%04d.png", number);
    return name;
}

} // namespace

/// Renders the frames, and eight of them on one sheet.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        int frames = 0;
        long long photons = 0;
        line.about("A sequence of frames: the camera flies around a ball of glass.");
        line.add("--frames", frames, "Number of frames; 0: by the quality", 0, 100000);
        line.add("--photons", photons, "Caustic photons; 0: by the quality", 0,
                 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 160, .height = 90, .samples = 4},
                        .report{.width = 480, .height = 270, .samples = 36},
                        .reference{.width = 1280, .height = 720, .samples = 256}});
        if (frames == 0) frames = options.pick(8, 8, 240);
        if (photons == 0) photons = options.pick(20000LL, 200000LL, 2000000LL);
        const PhotonMappingSettings settings{
            .caustics{
                .photons = photons, .seed = options.seed, .threads = options.threads},
            .caustics_estimate{.radius = options.pick(0.2f, 0.07f, 0.02f)}};
        const auto world = ring_of_balls();

        const PhotonMapper mapper(world, settings); // photons do not depend on the
                                                    // camera
        const int columns = std::min(frames, 4), rows = std::min(2, (frames + 3) / 4);
        Image sheet = make_image(columns * options.width, rows * options.height);
        RenderSettings picture = examples::picture_settings(options);
        for (int i = 0; i < frames; ++i) {
            // With one seed for all frames, the noise would stand still on the screen,
            // like dirt on a lens.
            picture.seed = options.seed + std::uint64_t(i);
            const std::string name = name_of_frame(i);
            const Camera camera = camera_at(float(i) / float(frames));
            const auto seen =
                examples::rendered(name, mapper, camera, picture, options);
            save_png(seen.image, options.path(name));
            for (int k = 0; k < columns * rows; ++k)
                if (k * frames / (columns * rows) == i)
                    paste(sheet, seen.image, k % columns, k / columns);
        }
        save_png(sheet, options.path("flight.png"));
    });
}
