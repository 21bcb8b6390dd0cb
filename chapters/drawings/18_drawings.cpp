// smoke: --quality draft --width 12 --height 8 --rays 4
/// \file chapters/drawings/18_drawings.cpp
/// \brief Chapter 18: a lamp with an area, a lens with an area, and the cost of a ray
/// whose numbers are spread evenly.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/drawing.hpp"
#include "common/signals.hpp"
#include "drawings/dimension.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// Umbra and penumbra below an object.
void draw_penumbra(const std::string& folder) {
    Drawing drawing{.name = "distributed_rays-penumbra",
                    .description =
                        "A lamp, an object below it, and the floor: points in "
                        "the umbra see nothing of the lamp, points in the "
                        "penumbra a part of it",
                    .low{-3.6, -0.75},
                    .high{3.6, 3.35},
                    .scale = 105};
    const Point lamp[] = {{-0.7, 3}, {0.7, 3}};
    const Point object[] = {{-1.0, 1.5}, {1.0, 1.5}};
    // Where the line from the lamp's end past the object's end meets the floor.
    const auto floor = [](const Point& from, const Point& past) {
        const double t = from.y / (from.y - past.y);
        return Point{from.x + t * (past.x - from.x), 0};
    };
    const Point outer[] = {floor(lamp[1], object[0]), floor(lamp[0], object[1])};
    const Point inner[] = {floor(lamp[0], object[0]), floor(lamp[1], object[1])};
    draw_area(drawing, {object[0], object[1], inner[1], inner[0]}, "currentColor");
    for (int side : {0, 1})
        draw_area(drawing, {object[side], inner[side], outer[side]}, colors::blue);
    for (int side : {0, 1}) {
        const examples::Pen thin{.color = colors::orange, .width = 1, .dashed = true};
        draw_line(drawing, {lamp[1 - side], outer[side]}, thin);
        draw_line(drawing, {lamp[side], inner[side]}, thin);
    }
    draw_line(drawing, {{-3.6, 0}, {3.6, 0}}, {.width = 2});
    draw_line(drawing, {lamp[0], lamp[1]}, {colors::orange, 6});
    draw_line(drawing, {object[0], object[1]}, {.width = 5});
    // One point in the penumbra, with shadow rays to five places of the lamp.
    const Point x{(inner[1].x + outer[1].x) / 2, 0};
    for (int i = 0; i < 5; ++i) {
        const Point y{-0.7 + 1.4 * (i + 0.5) / 5, 3};
        const double at =
            x.x + (y.x - x.x) * 0.5; // where it passes the object's height
        const bool hidden = at < object[1].x;
        if (hidden)
            draw_arrow(drawing, x, {at, 1.5}, {colors::red, 1.5});
        else
            draw_arrow(drawing, x, y, {colors::green, 1.5});
    }
    draw_dot(drawing, x, 4, "currentColor");
    draw_label(drawing, {0, -0.3}, "umbra");
    draw_label(drawing, {x.x, -0.3}, "penumbra", colors::blue);
    draw_label(drawing, {outer[0].x + 0.75, -0.3}, "penumbra", colors::blue);
    draw_label(drawing, {0, 3.22}, "lamp", colors::orange);
    save_drawing(folder, drawing);
}

constexpr double lens_radius = 0.8, film_distance = 2, focus_distance = 3.4;

/// The lens at x = 0 with its letters, and the film behind it, around a height.
void draw_lens_and_film(Drawing& drawing, double height) {
    const Point film{-film_distance, height};
    draw_line(drawing, {{0, height - lens_radius}, {0, height + lens_radius}},
              {colors::blue, 4});
    draw_line(drawing, {{film.x, film.y - 1.1}, {film.x, film.y + 1.1}}, {.width = 2});
    draw_line(drawing, {{focus_distance, height - 1.2}, {focus_distance, height + 1.2}},
              {.width = 1, .dashed = true});
    draw_dimension(drawing, {film.x, height - 1.35}, {0, height - 1.35}, "d",
                   "currentColor", -12);
}

/// Camera rays: all from one place on the film meet in the plane of focus.
/// \param confusion  The letter c of the chapter for points at the depth `far`.
void draw_camera_rays(Drawing& drawing, double far, double confusion) {
    draw_lens_and_film(drawing, 0);
    // The pixel's ray through the middle is the pinhole's; all others meet it in focus.
    const Point pixel{-film_distance, -0.2};
    const double slope = -pixel.y / film_distance;
    const Point sharp{focus_distance, slope * focus_distance};
    for (int i = -2; i <= 2; ++i) {
        const Point lens{0, lens_radius * i / 2};
        draw_line(drawing, {pixel, lens}, {.color = colors::orange, .width = 1});
        const double way = (sharp.y - lens.y) / focus_distance;
        draw_line(drawing, {lens, {far, lens.y + way * far}},
                  {.color = colors::orange, .width = i == 0 ? 2.2 : 1});
    }
    const double half = confusion * far / 2;
    draw_line(drawing, {{far, slope * far - half}, {far, slope * far + half}},
              {colors::red, 4});
    draw_dot(drawing, pixel, 4, "currentColor");
    draw_dot(drawing, sharp, 5, colors::green);
    draw_label(drawing, {pixel.x, 1.3}, "film");
    draw_label(drawing, {0, 1.05}, "lens", colors::blue);
    draw_label(drawing, {focus_distance, 1.4}, "plane of focus");
    draw_label(drawing, {far + 0.3, slope * far}, "c z", colors::red);
    draw_dimension(drawing, {0, -1.35}, {focus_distance, -1.35}, "s", "currentColor",
                   -12);
}

/// The light of a point at the depth z: its tip lies before the film, where a disc is.
void draw_light_of_point(Drawing& drawing, double z, double confusion) {
    const double height = -3.6;
    draw_lens_and_film(drawing, height);
    // 1/F is 1/s + 1/d, and also 1/z + 1/d'.
    const double tip = 1 / (1 / focus_distance + 1 / film_distance - 1 / z);
    const double half = confusion * film_distance / 2;
    for (const double side : {-1.0, 1.0}) {
        const Point lens{0, height + side * lens_radius};
        draw_line(drawing, {{z, height}, lens}, {.color = colors::orange});
        draw_line(drawing, {lens, {-film_distance, height - side * half}},
                  {.color = colors::orange});
    }
    draw_area(drawing,
              {{z, height},
               {0, height + lens_radius},
               {-tip, height},
               {0, height - lens_radius}},
              colors::orange);
    draw_line(drawing,
              {{-film_distance, height - half}, {-film_distance, height + half}},
              {colors::red, 5});
    draw_dot(drawing, {z, height}, 5, colors::violet);
    draw_dot(drawing, {-tip, height}, 4, colors::violet);
    draw_label(drawing, {-film_distance - 0.3, height}, "c d", colors::red);
    draw_label(drawing, {z + 0.4, height + 0.25}, "point", colors::violet);
    draw_dimension(drawing, {-tip, height + 0.95}, {0, height + 0.95}, "d′",
                   colors::violet);
    draw_line(drawing, {{-tip, height}, {-tip, height + 1.05}},
              {.color = colors::violet, .width = 0.8, .dashed = true});
    draw_dimension(drawing, {0, height - 1.35}, {z, height - 1.35}, "z", colors::violet,
                   -12);
    draw_dimension(drawing, {0.2, height - lens_radius}, {0.2, height + lens_radius},
                   "2R", colors::blue, -18);
}

/// A thin lens: points in the plane of focus are sharp, others are circles.
void draw_lens(const std::string& folder) {
    Drawing drawing{.name = "distributed_rays-thin-lens",
                    .description =
                        "Above, rays from one place on the film at the distance d meet "
                        "in the plane of focus at the distance s, and spread behind "
                        "it; below, the light of a point at the depth z meets at the "
                        "distance d′, and covers a disc on the film",
                    .low{-2.6, -5.3},
                    .high{6.7, 1.6},
                    .scale = 80};
    const double z = 6;
    // In pixels; of a picture as high as its distance is 1, in scene units.
    const ljus::LensCameraT<double> camera{
        .pinhole{.half_height = 0.5}, .radius = lens_radius, .focus = focus_distance};
    const double confusion = circle_of_confusion(camera, z, 1);
    draw_camera_rays(drawing, z, confusion);
    draw_light_of_point(drawing, z, confusion);
    save_drawing(folder, drawing);
}

// --- The trade -----------------------------------------------------------------------

using ljus::Sampling;
using MovingBall = ljus::Moving<ljus::Sphere>;
template <typename Ball>
using Balls =
    ljus::Scene<ljus::Shapes<Ball, ljus::Quad>, ljus::Materials<ljus::Lambertian>,
                ljus::Lights<ljus::PointLight>>;

/// Nine balls on a floor, without a light.
template <typename Ball>
Balls<Ball> nine_balls(const ljus::Vec3& way = ljus::Vec3{0}) {
    Balls<Ball> scene;
    const auto grey = scene.add(ljus::Lambertian{.albedo = ljus::Rgb{0.6f}});
    scene.add(ljus::Quad{{-9, 0, 9}, {18, 0, 0}, {0, 0, -18}}, grey);
    for (int i = 0; i < 9; ++i) {
        const ljus::Sphere ball{
            .center{float(2 * (i % 3) - 2), 0.6f, float(2 * (i / 3) - 2)},
            .radius = 0.6f};
        if constexpr (std::is_same_v<Ball, MovingBall>)
            scene.add(MovingBall{ball, way}, grey);
        else
            scene.add(ball, grey);
    }
    return scene;
}

constexpr std::array patterns{Sampling::random, Sampling::jittered,
                              Sampling::multi_jittered, Sampling::sobol};

/// A picture, and what it has cost.
struct Timed {
    ljus::Image image;
    double seconds = 0; ///< Of the processor.
};
template <ljus::AnyWorld W, typename AnyCamera>
Timed timed(const W& world, const AnyCamera& camera, Sampling sampling, int rays,
            const examples::Options& options, std::uint64_t seed = 1) {
    const double start = examples::processor_seconds();
    auto picture = render(ljus::DistributedTracer(world), camera,
                          {.width = options.width,
                           .height = options.height,
                           .samples = rays,
                           .seed = seed,
                           .threads = 1,
                           .sampling = sampling});
    return {std::move(picture.image), examples::processor_seconds() - start};
}

/// Nanoseconds of a camera ray by each pattern, through a lens, and with moving balls.
void table_costs(const examples::Options& options) {
    const ljus::PointLight light{.position{3, 6, 4}, .intensity = ljus::Rgb{100}};
    const auto lit = [&](auto scene) {
        scene.add(light);
        return ljus::World(std::move(scene));
    };
    const auto still = lit(nine_balls<ljus::Sphere>());
    const auto resting = lit(nine_balls<MovingBall>());
    const auto moving = lit(nine_balls<MovingBall>({0.5f, 0, 0}));
    const ljus::Camera pinhole =
        look_at(ljus::View{.position{0, 5, 8}, .target{0, 0.4f, 0}});
    const ljus::LensCamera lens = with_lens(pinhole, 0.1f, 9.0f);

    std::array<double, 7> least;
    least.fill(std::numeric_limits<double>::infinity());
    for (int round = 0; round < options.pick(7, 15, 31); ++round) {
        const auto seconds = [&](const auto& world, const auto& camera,
                                 Sampling sampling) {
            return timed(world, camera, sampling, 16, options).seconds;
        };
        const std::array now{seconds(still, pinhole, Sampling::random),
                             seconds(still, pinhole, Sampling::jittered),
                             seconds(still, pinhole, Sampling::multi_jittered),
                             seconds(still, pinhole, Sampling::sobol),
                             seconds(still, lens, Sampling::random),
                             seconds(resting, pinhole, Sampling::random),
                             seconds(moving, pinhole, Sampling::random)};
        for (std::size_t i = 0; i < now.size(); ++i)
            least[i] = std::min(least[i], now[i]);
        examples::stop_if_asked();
    }
    const std::array names{"random, a pinhole, nothing moves",
                           "jittered",
                           "multi-jittered",
                           "Sobol",
                           "random, and a lens",
                           "random, balls of a moving type that stand still",
                           "random, balls that move"};
    examples::Table table{
        .name = "distributed_rays-costs",
        .columns = {"camera rays", "ns per camera ray", "over the first row"}};
    const double rays = 16.0 * options.width * options.height;
    for (std::size_t i = 0; i < names.size(); ++i)
        table.rows.push_back({names[i], examples::text(1e9 * least[i] / rays, "%.0f"),
                              examples::text(least[i] / least[0], "%.2f")});
    save_table(options.path(""), table);
}

/// The error of a picture with soft shadows against time.
void plot_trade(const examples::Options& options) {
    auto scene = nine_balls<ljus::Sphere>();
    scene.add(ljus::Quad{{2, 6, 3}, {2, 0, 0}, {0, 0, 2}},
              scene.add(ljus::Lambertian{.albedo = ljus::Rgb{0}}), ljus::Rgb{25});
    const ljus::World world(std::move(scene));
    const ljus::Camera camera =
        look_at(ljus::View{.position{0, 5, 8}, .target{0, 0.4f, 0}});
    const ljus::Image truth =
        timed(world, camera, Sampling::sobol, 16 * options.samples, options, 99).image;

    const double none = std::numeric_limits<double>::quiet_NaN();
    examples::Plot plot{.name = "distributed_rays-trade",
                        .columns = {"microseconds per pixel", "random", "jittered",
                                    "multi-jittered", "Sobol"},
                        .y_label = "RMS error of the picture",
                        .rows = {},
                        .log_x = true,
                        .log_y = true};
    const double pixels = double(options.width) * options.height;
    for (std::size_t kind = 0; kind < patterns.size(); ++kind)
        for (int rays = 1; rays <= options.samples; rays *= 4) {
            double square = 0, seconds = std::numeric_limits<double>::infinity();
            const int seeds = options.pick(4, 8, 16);
            for (int seed = 1; seed <= seeds; ++seed) {
                const Timed one = timed(world, camera, patterns[kind], rays, options,
                                        std::uint64_t(seed));
                const double error = double(ljus::rmse(one.image, truth));
                square += error * error / seeds;
                seconds = std::min(seconds, one.seconds);
                examples::stop_if_asked();
            }
            examples::Row row(patterns.size() + 1, none);
            row[0] = 1e6 * seconds / pixels;
            row[kind + 1] = std::sqrt(square);
            plot.rows.push_back(row);
        }
    save_plot(options.path(""), plot);
}

} // namespace

/// Makes the chapter's drawings, and measures what its rays cost.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 18, distributed rays: drawings, and the cost of a ray.");
        const examples::Options options =
            line.parse({.draft{.width = 48, .height = 32, .samples = 64},
                        .report{.width = 72, .height = 48, .samples = 256},
                        .reference{.width = 96, .height = 64, .samples = 1024}});
        draw_penumbra(options.path(""));
        draw_lens(options.path(""));
        table_costs(options);
        plot_trade(options);
    });
}
