// smoke: --quality draft --width 24 --height 18 --rays 1
/// \file 42_volume_photons.cpp
/// \brief Renders a ball of glass that throws a shaft of light into fog, with different
/// numbers of photons per estimate.

#include <algorithm>

#include <ljus/ljus.hpp>
#include <ljus/media/fog.hpp>

#include "common/example.hpp"

using namespace ljus;

using Cellar = Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Glass>,
                     Lights<SpotLight>, Media<Fog<Box>>>;

/// A room full of fog, in which a spot light shines on a ball of glass.
Cellar cellar() {
    Cellar scene;
    const auto wall = scene.add(Lambertian{.albedo{0.5f, 0.47f, 0.43f}});
    const Vec3 low{-2, 0, -2}, x{4, 0, 0}, y{0, 2.8f, 0}, z{0, 0, 4};
    scene.add(Quad{low, z, x}, wall);
    scene.add(Quad{low, x, y}, wall);
    scene.add(Quad{low, y, z}, wall);
    scene.add(Quad{low + x, z, y}, wall);
    scene.add(Quad{low + y, x, z}, wall);
    scene.add(Sphere{.center{0, 1.6f, 0}, .radius = 0.4f}, scene.add(Glass{}));
    scene.add(SpotLight{.position{-0.9f, 2.75f, 0},
                        .direction{0.9f, -1.15f, 0},
                        .intensity{60, 54, 44},
                        .inner_degrees = 17,
                        .outer_degrees = 19});
    scene.add(Fog<Box>{.region{low, low + x + y + z},
                       .absorption = Rgb{0.03f},
                       .scattering{0.2f, 0.21f, 0.22f},
                       .g = 0.3f});
    return scene;
}

/// Renders volume_photons-shaft.png and volume_photons-nearest.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about(
            "Chapter 42, photons in fog: a shaft of light from a ball of glass.");
        const examples::Options options =
            line.parse({.draft{.width = 160, .height = 120, .samples = 4},
                        .report{.width = 320, .height = 240, .samples = 30},
                        .reference{.width = 880, .height = 660, .samples = 256}});
        const World world(cellar());
        const auto camera = look_at(
            {.position{0, 1.4f, 5.6f}, .target{0, 1.35f, 0}, .vfov_degrees = 32});
        PhotonMappingSettings settings{.indirect = IndirectLight::photons};
        settings.caustics.photons = options.pick(20'000, 100'000, 1'000'000);
        settings.general.photons = options.pick(20'000, 100'000, 1'000'000);
        settings.caustics_estimate.radius = settings.general_estimate.radius = 0;
        settings.fog_estimate.nearest = 20;
        const auto shaft =
            examples::rendered("shaft", PhotonMapper(world, settings), camera, options);
        save_png(shaft.image, options.path("volume_photons-shaft.png"));

        // Side by side, with a tenth of the photons.
        settings.caustics.photons /= 10;
        settings.general.photons /= 10;
        auto picture = examples::picture_settings(options);
        picture.width /= 2;
        picture.height /= 2;
        picture.samples = std::max(1, picture.samples / 4);
        Image balls = make_image<float>(3 * picture.width, picture.height);
        int left = 0;
        for (const std::size_t nearest : {2, 20, 200}) {
            settings.fog_estimate.nearest = nearest;
            const auto one = examples::rendered("balls", PhotonMapper(world, settings),
                                                camera, picture, options);
            for (int row = 0; row < picture.height; ++row)
                for (int column = 0; column < picture.width; ++column)
                    pixel(balls, left + column, row) = pixel(one.image, column, row);
            left += picture.width;
        }
        save_png(balls, options.path("volume_photons-nearest.png"));
    });
}
