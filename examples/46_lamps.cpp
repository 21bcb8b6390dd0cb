// smoke: --quality draft --width 24 --height 16 --rays 1
/// \file 46_lamps.cpp
/// \brief Chapter 46: a wall below three goniometric lamps, and a window that is a
/// picture lamp.

#include <cmath>
#include <numbers>

#include <ljus/lights/goniometric_light.hpp>
#include <ljus/ljus.hpp>
#include <ljus/math/stratified_stream.hpp>
#include <ljus/render/gathering.hpp>
#include <ljus/render/lamp_shares.hpp>
#include <ljus/scene/picture_lamp.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A table of intensities of type C, cd, from a formula of the angles in degrees; every
/// 5 degrees in the polar angle and every 15 degrees around the axis.
template <typename F>
IntensityTable table_of(const F& candela) {
    IntensityTable table;
    for (int polar = 0; polar <= 90; polar += 5) table.polar.push_back(polar);
    for (int azimuth = 0; azimuth <= 360; azimuth += 15) {
        table.azimuth.push_back(azimuth);
        for (const double polar : table.polar)
            table.candela.push_back(candela(polar, double(azimuth)));
    }
    return table;
}

/// A bell curve: 1 in the middle, and 1/e at a distance of `width` degrees.
double lobe(double degrees, double middle, double width) {
    return std::exp(-std::pow((degrees - middle) / width, 2));
}

/// Three invented lamps: a narrow beam in a faint ring, two wings to the sides, and
/// four petals.
const IntensityTable beam = table_of([](double polar, double) {
    return 2600 * lobe(polar, 0, 12) + 160 * lobe(polar, 42, 5);
});
const IntensityTable wings = table_of([](double polar, double azimuth) {
    const double side = std::abs(std::sin(azimuth * double(pi) / 180));
    return 1100 * side * lobe(polar, 40, 12) + 120 * lobe(polar, 0, 20);
});
const IntensityTable petals = table_of([](double polar, double azimuth) {
    const double turn = std::cos(4 * azimuth * double(pi) / 180);
    return 900 * lobe(polar, 25, 14) * (0.55 + 0.45 * turn);
});

/// A window of six panes: an evening sky above a hill, with the sun in one pane.
Image evening(int width, int height) {
    Image picture = make_image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Vec2 at{(float(x) + 0.5f) / float(width),
                          1 - (float(y) + 0.5f) / float(height)};
            Rgb color = Rgb{1.2f, 0.7f, 0.45f} + at.y * Rgb{-0.8f, -0.1f, 0.6f};
            if (glm::distance(at, Vec2{0.72f, 0.5f}) < 0.035f) color = {160, 90, 40};
            if (at.y < 0.25f + 0.1f * std::sin(5 * at.x)) color = {0.02f, 0.04f, 0.02f};
            const float bars = std::sin(2 * pi * at.x) * std::sin(3 * pi * at.y);
            if (std::abs(bars) < 0.1f) color = Rgb{0};
            pixel(picture, x, y) = color;
        }
    return picture;
}

} // namespace

/// Makes lamps-wall.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 46, lamps: three IES lamps and a window.");
        const examples::Options options = line.parse(
            {.draft{240, 120, 2}, .report{560, 280, 8}, .reference{1120, 560, 64}});
        // [scene]
        Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Glass, PictureLamp>,
              Lights<GoniometricLight>>
            scene;
        const auto plaster = scene.add(Lambertian{.albedo{0.72f, 0.7f, 0.66f}});
        const auto window = scene.add(PictureLamp{.picture = evening(120, 180)});
        scene.add(Quad{{1.8f, 0.8f, -2.98f}, {1, 0, 0}, {0, 1.4f, 0}}, window, Rgb{1});
        float x = -2.3f;
        for (const IntensityTable& table : {beam, wings, petals}) {
            scene.add(GoniometricLight{table,
                                       {x, 2.4f, -2.7f},
                                       {0, -1, -0.08f},
                                       {0, 0, 1},
                                       Rgb{1, 0.8f, 0.55f} / 150.0f});
            x += 1.55f;
        }
        // [scene]
        const auto wood = scene.add(Lambertian{.albedo{0.42f, 0.27f, 0.17f}});
        for (const Quad& side : sides_of(Box{{-3, 0, -3}, {3, 2.6f, 3}}))
            scene.add(side, side.edge_u.y + side.edge_v.y == 0 ? wood : plaster, {},
                      true);
        scene.add(Sphere{{1.4f, 0.4f, -1.7f}, 0.4f}, scene.add(Glass{}));
        const World world(std::move(scene));
        const Camera camera = look_at({.position{-0.2f, 1.3f, 2.8f},
                                       .target{0.1f, 1.2f, -3},
                                       .vfov_degrees = 29});
        // [shares]
        const int width = options.width, height = options.height;
        const PhotonMappingSettings settings = share_by_sight(
            world, camera, preset_settings(Preset::fast, width, height), width, height);
        PhotonMapper mapper(world, settings, abilities<Gathering, StratifiedStream>);
        // [shares]
        mapper.fill_cache(camera, examples::picture_settings(options));
        const auto picture = examples::rendered("lamps", mapper, camera, options);
        save_png(picture.image, options.path("lamps-wall.png"));
    });
}
