// smoke: --quality draft --width 48 --height 48 --rays 1
/// \file 17_soap_film.cpp
/// \brief The row of figure 4 in the report's room: glass, rough, mirror, a soap
/// bubble, diffuse.

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/example.hpp"

using namespace ljus;

/// Renders soap_film-figure-4.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 17, the soap bubble: figure 4 with its bubble.");
        const examples::Options options =
            line.parse({.draft{.width = 400, .height = 400, .samples = 4},
                        .report{.width = 800, .height = 800, .samples = 36},
                        .reference{.width = 1000, .height = 1000, .samples = 1000}});

        // A table of the colours that a film of water reflects, by thickness and angle,
        // computed from spectra.
        const auto colors = bake_film_table(1.33f);
        const SoapFilm soap{.thickness = 900, // nm, at the lowest point
                            .scale = 0.8f,
                            .level{0, 0, -5},
                            .color = FilmColor::table,
                            .table = colors};

        Scene<Shapes<Quad, Sphere, Triangle>,
              Materials<Lambertian, OrenNayar, Glass, Mirror, SoapFilm>>
            scene;
        add_report_room(scene);
        const auto ball = [&](int place, const auto& material) {
            scene.add(
                Sphere{.center{6, 4.6f - 2.3f * float(place), -3.95f}, .radius = 1.05f},
                scene.add(material));
        };
        const Rgb ochre{0.75f, 0.5f, 0.2f};
        ball(0, Glass{.index = 1.5f});
        ball(1, OrenNayar{.albedo = ochre, .sigma = 0.7f});
        ball(2, Mirror{.reflectance = Rgb{0.98f}});
        ball(3, soap);
        ball(4, Lambertian{.albedo = ochre});
        add_ceiling_lamp(scene, 5.0f, -1.0f, 2.0f, Rgb{1});
        const World world(std::move(scene));

        const PhotonMapper mapper(
            world, {.caustics{.photons = options.pick(30000, 300000, 3000000),
                              .seed = options.seed,
                              .threads = options.threads},
                    .caustics_estimate{.radius = options.pick(0.3f, 0.15f, 0.06f)}});
        const auto picture =
            examples::rendered("figure 4", mapper, report_camera(), options);
        save_png(picture.image, options.path("soap_film-figure-4.png"));
    });
}
