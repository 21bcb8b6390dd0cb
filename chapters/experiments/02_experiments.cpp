// figures: radiance
// smoke: --quality draft --width 24 --height 24 --rays 4 --shots 20000 --pixels 24
/// \file chapters/experiments/02_experiments.cpp
/// \brief Chapter 2: flux, irradiance and radiance, each counted with rays; and what a
/// pixel makes of them.

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/inspect/estimate.hpp>
#include <ljus/ljus.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/convergence.hpp"
#include "drawings/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Pen;
using examples::Point;
using examples::text;
using ljus::Estimate;
using ljus::Filter;
using ljus::Rgb;
using Vec = ljus::Vec3T<double>;
using Quad = ljus::QuadT<double>;
using Sphere = ljus::SphereT<double>;
using Ray = ljus::RayT<double>;
namespace colors = examples::colors;

constexpr double pi = std::numbers::pi;

/// What the user may set besides the common options.
struct Sizes {
    int shots = 0;  ///< Rays for each count.
    int pixels = 0; ///< Side of the rings.
};

// --- Drawings -------------------------------------------------------------------------

/// A point of space as an onlooker far away sees it who stands above and to the right.
Point seen(const Vec& p) {
    const Vec right{0.94, 0, -0.34}, up{-0.12, 0.94, -0.33};
    return {glm::dot(p, right), glm::dot(p, up)};
}

/// A direction: an angle in the plane of x and z, and a height, both in radians.
Vec direction(double azimuth, double height) {
    return {std::cos(height) * std::cos(azimuth), std::sin(height),
            -std::cos(height) * std::sin(azimuth)};
}

/// The unit sphere around the eye, a patch on it, and the larger patch far away that
/// covers the same directions.
void draw_solid_angle(const std::string& folder) {
    Drawing d{.name = "radiance-solid-angle",
              .description = "A patch A at the distance r, and the patch of the unit "
                             "sphere that it covers: the solid angle",
              .low{-1.15, -1.15},
              .high{3.2, 1.15},
              .scale = 160};
    draw_arc(d, {0, 0}, 1, 0, 2 * pi);
    std::vector<Point> equator;
    for (int i = 0; i <= 64; ++i) equator.push_back(seen(direction(i * pi / 32, 0)));
    draw_line(d, equator, {.color = "#80808080", .width = 1});
    constexpr double a0 = -0.55, a1 = -0.1, h0 = 0.1, h1 = 0.55, far = 3;
    const auto rim = [&](double radius) {
        std::vector<Point> line;
        constexpr int n = 16;
        const auto add = [&](double a, double h) {
            line.push_back(seen(radius * direction(a, h)));
        };
        for (int i = 0; i < n; ++i) add(a0 + (a1 - a0) * i / n, h0);
        for (int i = 0; i < n; ++i) add(a1, h0 + (h1 - h0) * i / n);
        for (int i = 0; i < n; ++i) add(a1 + (a0 - a1) * i / n, h1);
        for (int i = 0; i <= n; ++i) add(a0, h1 + (h0 - h1) * i / n);
        return line;
    };
    for (const double a : {a0, a1})
        for (const double h : {h0, h1})
            draw_line(d, {{0, 0}, seen(far * direction(a, h))},
                      {.color = "#80808080", .width = 1});
    draw_area(d, rim(1), colors::orange);
    draw_line(d, rim(1), {.color = colors::orange, .width = 2});
    draw_area(d, rim(far), colors::blue);
    draw_line(d, rim(far), {.color = colors::blue, .width = 2});
    draw_dot(d, {0, 0}, 4, "currentColor");
    const Vec middle = direction(-0.325, 0.32);
    draw_label(d, seen(1.0 * middle), "ω", colors::orange);
    draw_label(d, seen(far * middle), "A", colors::blue);
    const Point below = seen(0.5 * far * direction(-0.325, h0));
    draw_label(d, {below.x + 0.1, below.y - 0.3}, "r");
    draw_label(d, {-0.4, -0.55}, "radius 1");
    draw_label(d, {2.3, -0.9}, "ω = A / r²");
    save_drawing(folder, d);
}

/// Squares of 1, 4 and 9 cells in the same beam.
void draw_inverse_square(const std::string& folder) {
    Drawing d{.name = "radiance-inverse-square",
              .description = "The rays through one cell at distance 1 fill four cells "
                             "at distance 2 and nine at distance 3",
              .low{-0.35, -1.35},
              .high{3.2, 1.05},
              .scale = 180};
    constexpr double half = 0.26;
    for (const double y : {-half, half})
        for (const double z : {-half, half})
            draw_line(d, {{0, 0}, seen(3.0 * Vec{1, y, z})},
                      {.color = "#80808080", .width = 1});
    for (int r = 3; r >= 1; --r) {
        const auto at = [&](double j, double k) {
            return seen(Vec{double(r), half * (2 * j - r), half * (2 * k - r)});
        };
        const Pen pen{.color = r == 1   ? colors::orange
                               : r == 2 ? colors::blue
                                        : colors::green,
                      .width = 1.6};
        draw_area(d, {at(0, 0), at(r, 0), at(r, r), at(0, r)}, pen.color);
        for (int j = 0; j <= r; ++j) {
            draw_line(d, {at(j, 0), at(j, r)}, pen);
            draw_line(d, {at(0, j), at(r, j)}, pen);
        }
        const Point above = at(r, r);
        draw_label(d, {above.x - 0.1, above.y + 0.16},
                   "r = " + std::to_string(r) +
                       (r == 1 ? ": E" : ": E/" + std::to_string(r * r)),
                   pen.color);
    }
    draw_dot(d, {0, 0}, 7, colors::orange);
    draw_label(d, {-0.1, -0.22}, "lamp");
    save_drawing(folder, d);
}

/// The same patch in the same beam, upright and tilted, with the rays that it takes.
void draw_cosine(const std::string& folder) {
    Drawing d{.name = "radiance-cosine",
              .description = "A patch that faces a beam takes eight rays; tilted by 60 "
                             "degrees it takes four",
              .low{-0.2, -1.3},
              .high{7, 1.5},
              .scale = 100};
    for (const bool tilted : {false, true}) {
        const double left = tilted ? 3.9 : 0, theta = tilted ? pi / 3 : 0;
        const Point center{left + 1.6, 0};
        const Point along{std::sin(theta), std::cos(theta)}; // of half length 1
        int taken = 0;
        for (int i = 0; i < 10; ++i) {
            const double y = -1.125 + 0.25 * i;
            const bool hits = std::abs(y) < along.y;
            taken += hits;
            const double end = hits ? center.x + y / along.y * along.x : left + 2.9;
            draw_arrow(d, {left, y}, {end, y},
                       {.color = hits ? colors::orange : "#80808080", .width = 1.3});
        }
        draw_line(d,
                  {{center.x - along.x, center.y - along.y},
                   {center.x + along.x, center.y + along.y}},
                  {.width = 4});
        const Point normal{center.x - 1.25 * along.y, center.y + 1.25 * along.x};
        if (tilted) {
            draw_arrow(d, center, normal, {.color = colors::blue, .width = 2});
            draw_label(d, {normal.x - 0.02, normal.y + 0.17}, "n", colors::blue);
            draw_arc(d, center, 0.5, pi - theta, pi,
                     {.color = colors::blue, .width = 1.5});
            draw_label(d, {center.x - 0.68, center.y + 0.36}, "θ", colors::blue);
        }
        draw_label(d, {left + 1.45, 1.3}, std::to_string(taken) + " rays");
    }
    save_drawing(folder, d);
}

/// Two small patches that send light to each other.
void draw_beam(const std::string& folder) {
    Drawing d{.name = "radiance-beam",
              .description = "A beam between two tilted patches, with their normals, "
                             "angles and solid angles",
              .low{-0.4, -0.85},
              .high{6.6, 1.75},
              .scale = 100};
    const Point a{0.5, 0.2}, b{5.5, 0.5};
    const auto patch = [](const Point& at, double angle, double half) {
        const Point t{half * std::cos(angle), half * std::sin(angle)};
        return std::vector<Point>{{at.x - t.x, at.y - t.y}, {at.x + t.x, at.y + t.y}};
    };
    const auto pa = patch(a, pi / 2 - 0.5, 0.42);
    const auto pb = patch(b, pi / 2 + 0.35, 0.5);
    // What leaves the middle of one for all of the other, and the other way round.
    draw_area(d, {a, pb[0], pb[1]}, colors::orange);
    draw_area(d, {b, pa[0], pa[1]}, colors::blue);
    draw_line(d, {a, b}, {.color = "#808080", .width = 1.2, .dashed = true});
    draw_line(d, pa, {.color = colors::orange, .width = 4});
    draw_line(d, pb, {.color = colors::blue, .width = 4});
    const Point na{a.x + 1.1 * std::cos(-0.5), a.y + 1.1 * std::sin(-0.5)};
    const Point nb{b.x - 1.1 * std::cos(0.35), b.y - 1.1 * std::sin(0.35)};
    draw_arrow(d, a, na, {.color = colors::orange});
    draw_arrow(d, b, nb, {.color = colors::blue});
    const double line = std::atan2(b.y - a.y, b.x - a.x);
    draw_arc(d, a, 0.75, -0.5, line, {.color = colors::orange});
    draw_arc(d, b, 0.75, pi + line, pi + 0.35, {.color = colors::blue});
    draw_label(d, {a.x + 0.95, a.y - 0.2}, "θ", colors::orange);
    draw_label(d, {b.x - 0.93, b.y - 0.21}, "θ′", colors::blue);
    draw_label(d, {pa[1].x - 0.15, pa[1].y + 0.22}, "A", colors::orange);
    draw_label(d, {pb[1].x + 0.28, pb[1].y + 0.12}, "A′", colors::blue);
    draw_label(d, {3, 0.15}, "r");
    draw_label(d, {3, 1.5}, "A cos θ · A′ cos θ′ / r²");
    save_drawing(folder, d);
}

/// A pixel, a lens and what both see of the scene.
void draw_pixel(const std::string& folder) {
    Drawing d{.name = "radiance-pixel",
              .description = "The rays of one pixel: from each place of the pixel "
                             "through each place of the lens to the plane in focus",
              .low{-1.9, -1.45},
              .high{5.6, 1.5},
              .scale = 100};
    constexpr double film = -1.2, focus = 4.6, half_lens = 0.62;
    constexpr double pixel_low = -0.32, pixel_high = -0.02;
    const auto at_focus = [&](double y) { return -y * focus / -film; };
    for (const double y : {pixel_low, pixel_high})
        draw_area(d, {{film, y}, {0, half_lens}, {focus, at_focus(y)}, {0, -half_lens}},
                  y == pixel_low ? colors::blue : colors::orange);
    for (const double y : {pixel_low, pixel_high})
        for (const double lens : {-half_lens, 0.0, half_lens})
            draw_line(d, {{film, y}, {0, lens}, {focus, at_focus(y)}},
                      {.color = y == pixel_low ? colors::blue : colors::orange,
                       .width = 1.2});
    for (int i = -3; i <= 4; ++i)
        draw_line(d, {{film - 0.07, -0.02 + 0.3 * i}, {film + 0.07, -0.02 + 0.3 * i}});
    draw_line(d, {{film, -0.95}, {film, 1.2}});
    draw_line(d, {{film, pixel_low}, {film, pixel_high}},
              {.color = colors::red, .width = 6});
    std::vector<Point> lens;
    for (int i = 0; i <= 48; ++i)
        lens.push_back(
            {0.1 * std::cos(i * pi / 24), half_lens * std::sin(i * pi / 24)});
    draw_line(d, lens, {.width = 2});
    draw_line(d, {{0, half_lens}, {0, 1.2}}, {.width = 4});
    draw_line(d, {{0, -half_lens}, {0, -1.2}}, {.width = 4});
    draw_line(d, {{focus, -1.2}, {focus, 1.4}}, {.color = "#808080", .dashed = true});
    draw_line(d, {{focus, at_focus(pixel_high)}, {focus, at_focus(pixel_low)}},
              {.color = colors::red, .width = 6});
    draw_label(d, {film, -1.2}, "film");
    draw_label(d, {0, -1.35}, "aperture");
    draw_label(d, {focus, -1.35}, "in focus");
    draw_label(d, {film - 0.4, -0.17}, "pixel", colors::red);
    save_drawing(folder, d);
}

// --- Counting rays --------------------------------------------------------------------

/// The share of random directions from a point for which `hits` says yes.
template <typename Hits>
Estimate count(const Vec& from, int shots, std::uint64_t seed, Hits hits) {
    auto stream = ljus::random_stream(seed, ljus::Pass::user, 0, 0);
    Estimate share;
    for (int i = 0; i < shots; ++i) {
        const Ray ray{.origin = from,
                      .direction =
                          ljus::sample_uniform_sphere(next_2d<double>(stream))};
        add(share, hits(ray) ? 1.0 : 0.0);
    }
    return share;
}

/// A number with its standard error.
std::string with_error(double value, double error, const char* format) {
    return text(value, format) + " ± " + text(error, format);
}

/// Table: solid angles by counting and by formula.
void solid_angles(const std::string& folder, int shots) {
    examples::Table table{
        .name = "radiance-solid-angles",
        .columns = {"seen from a point", "counted", "formula", "A cos θ / r²"}};
    const auto add_row = [&](const std::string& name, const auto& shape, double right,
                             double small) {
        const Estimate share = count({0, 0, 0}, shots, 3, [&](const Ray& ray) {
            return ljus::intersect(ray, shape).has_value();
        });
        table.rows.push_back(
            {name,
             with_error(4 * pi * share.mean, 4 * pi * standard_error(share), "%.4f"),
             text(right, "%.4f"), text(small, "%.4f")});
    };
    const auto square = [](double side, double distance) {
        return Quad{.corner{-side / 2, -side / 2, -distance},
                    .edge_u{side, 0, 0},
                    .edge_v{0, side, 0}};
    };
    const auto of_square = [](double side, double r) {
        const double h = side / 2;
        return 4 * std::atan(h * h / (r * std::sqrt(2 * h * h + r * r)));
    };
    for (const double r : {0.5, 1.0, 3.0})
        add_row("a square of side 1, distance " + text(r), square(1, r),
                of_square(1, r), 1 / (r * r));
    for (const double r : {1.2, 2.0, 5.0})
        add_row("a ball of radius 1, distance " + text(r),
                Sphere{.center{0, 0, -r}, .radius = 1},
                2 * pi * ljus::one_minus_cosine(1 / (r * r)), pi / (r * r));
    save_table(folder, table);
}

/// A square patch of side 0.25 at a distance from the origin along x, tilted.
Quad patch_at(double distance, double degrees) {
    constexpr double side = 0.25;
    const double a = degrees * pi / 180;
    const Vec u = side * Vec{std::sin(a), std::cos(a), 0}, v{0, 0, side};
    return {.corner = Vec{distance, 0, 0} - 0.5 * (u + v), .edge_u = u, .edge_v = v};
}

/// The irradiance of that patch by a lamp of 100 W at the origin, by counting.
// [count]
Estimate irradiance_counted(const Quad& patch, int shots, std::uint64_t seed) {
    constexpr double flux = 100; // of the lamp, W, in as many rays
    Estimate found = count({0, 0, 0}, shots, seed, [&](const Ray& ray) {
        return ljus::intersect(ray, patch).has_value();
    });
    const double each = flux / area(patch); // W/m^2, if all rays went there
    return {found.count, each * found.mean, each * each * found.squares};
}
// [count]

/// Plots and a table: a patch at changing distance, and at changing tilt.
void count_on_patches(const std::string& folder, int shots) {
    examples::Plot far{.name = "radiance-distance",
                       .columns = {"distance r (m)", "counted", "100 W / (4 pi r^2)"},
                       .y_label = "irradiance (W/m^2)",
                       .log_x = true,
                       .log_y = true};
    examples::Table table{.name = "radiance-distance-table",
                          .columns = {"r (m)", "rays that hit", "counted, W/m²",
                                      "100 W / (4πr²)", "apart"}};
    std::vector<double> x, y;
    for (const double r : {0.5, 1.0, 2.0, 4.0, 8.0}) {
        const Estimate e = irradiance_counted(patch_at(r, 0), shots, 11);
        const double right = 100 / (4 * pi * r * r);
        far.rows.push_back({r, e.mean, right});
        if (r >= 1) x.push_back(r), y.push_back(e.mean);
        table.rows.push_back(
            {text(r), text(e.mean * area(patch_at(r, 0)) / 100 * shots, "%.0f"),
             with_error(e.mean, standard_error(e), "%.3f"), text(right, "%.3f"),
             text(100 * (e.mean / right - 1), "%+.1f %%")});
    }
    save_plot(folder, far);
    save_table(folder, table);
    const auto slope = examples::fit_power(x, y);
    examples::save_table(folder, {.name = "radiance-slope",
                                  .columns = {"law", "slope", "its error"},
                                  .rows = {{"distance", text(slope.slope, "%.3f"),
                                            text(slope.error, "%.3f")}}});

    examples::Plot tilt{.name = "radiance-tilt",
                        .columns = {"tilt (degrees)", "counted", "cosine"},
                        .y_label = "irradiance over that at 0 degrees"};
    const double facing = 100 / (4 * pi * 2 * 2);
    for (int degrees = 0; degrees <= 90; degrees += 10) {
        const Estimate e = irradiance_counted(patch_at(2, degrees), shots, 12);
        tilt.rows.push_back(
            {double(degrees), e.mean / facing, std::cos(degrees * pi / 180)});
    }
    save_plot(folder, tilt);
}

/// Plot: a square lamp of side 1 is no point. Both laws, and Lambert's closed form.
void near_the_lamp(const std::string& folder) {
    examples::Plot plot{
        .name = "radiance-near",
        .columns = {"distance over the lamp's side", "inverse square over the truth"},
        .y_label = "ratio",
        .log_x = true,
        .log_y = true};
    examples::Table table{.name = "radiance-near-table",
                          .columns = {"distance over side", "too bright by"}};
    for (int i = -8; i <= 12; ++i) {
        const double r = std::pow(10.0, i / 8.0);
        const Quad lamp{{-0.5, r, -0.5}, {1, 0, 0}, {0, 0, 1}};
        const double truth =
            pi * *form_factor_from(Vec{0, 0, 0}, Vec{0, 1, 0}, lamp, false);
        plot.rows.push_back({r, 1 / (r * r) / truth});
    }
    for (const double r : {0.5, 1.0, 2.0, 5.0, 10.0}) {
        const Quad lamp{{-0.5, r, -0.5}, {1, 0, 0}, {0, 0, 1}};
        const double truth =
            pi * *form_factor_from(Vec{0, 0, 0}, Vec{0, 1, 0}, lamp, false);
        table.rows.push_back(
            {text(r), text(100 * (1 / (r * r) / truth - 1), "%.3g %%")});
    }
    save_plot(folder, plot);
    save_table(folder, table);
}

// --- Radiance along a ray -------------------------------------------------------------

/// A lamp, a ball of radius 0.6 and radiance 0.9, before a white wall.
auto wall_and_lamp(float distance) {
    using Scene = ljus::Scene<ljus::Shapes<ljus::Sphere, ljus::Quad>,
                              ljus::Materials<ljus::Lambertian>>;
    Scene scene;
    const auto white = scene.add(ljus::Lambertian{.albedo = Rgb{0.8f}});
    const auto black = scene.add(ljus::Lambertian{.albedo = Rgb{0}});
    scene.add(ljus::Quad{{-40, -40, 0}, {80, 0, 0}, {0, 80, 0}}, white);
    scene.add(ljus::Sphere{.center{0, 0, distance}, .radius = 0.6f}, black, Rgb{0.9f});
    return ljus::World(std::move(scene));
}

/// Pictures and a table: a lamp that leaves the wall, as a fixed camera sees both.
void leave_the_wall(const examples::Options& options) {
    examples::Table table{.name = "radiance-wall",
                          .columns = {"lamp to wall (m)", "radiance of the lamp",
                                      "radiance of the wall behind it", "by formula"}};
    const auto camera =
        ljus::look_at({.position{8, 0.6f, 5}, .target{0, 0, 1.4f}, .vfov_degrees = 36});
    int number = 0;
    for (const float r : {0.8f, 1.6f, 3.2f}) {
        const auto world = wall_and_lamp(r);
        const ljus::PathTracer tracer(world);
        const auto picture = render(tracer, camera,
                                    {.width = options.width,
                                     .height = options.height,
                                     .samples = options.samples,
                                     .seed = options.seed,
                                     .threads = options.threads});
        save_png(picture.image,
                 options.path("radiance-wall-" + std::to_string(++number) + ".png"));
        // Two pixels of one ray's width: at the lamp, and at the wall behind it.
        const auto one = [&](const ljus::Vec3& target) {
            const auto eye = ljus::look_at(
                {.position{8, 0.6f, 5}, .target = target, .vfov_degrees = 0.01f});
            return render(tracer, eye, {.width = 1, .height = 1, .samples = 65536})
                .image.pixels[0]
                .x;
        };
        const double sine = 0.6 / double(r);
        table.rows.push_back({text(double(r)), text(double(one({0, 0, r})), "%.4f"),
                              text(double(one({0, 0, 0})), "%.4f"),
                              text(0.8 * 0.9 * sine * sine, "%.4f")});
        examples::stop_if_asked();
    }
    save_table(options.path(""), table);
}

/// Table: the same lamp from further and further away.
void step_back(const std::string& folder, int shots) {
    examples::Table table{.name = "radiance-step-back",
                          .columns = {"distance (m)", "radiance in the pixel",
                                      "solid angle (sr)", "irradiance, W/m²",
                                      "irradiance / solid angle"}};
    const ljus::World world(
        ljus::make_scene(placed(ljus::Sphere{.center{0, 0, 0}, .radius = 0.5f},
                                ljus::Lambertian{.albedo = Rgb{0}}, Rgb{10})));
    const ljus::PathTracer tracer(world);
    for (const double r : {1.0, 2.0, 4.0, 20.0, 100.0}) {
        const auto eye = ljus::look_at(
            {.position{0, 0, float(r)}, .target{0, 0, 0}, .vfov_degrees = 0.01f});
        const double seen_radiance =
            double(render(tracer, eye, {.width = 1, .height = 1, .samples = 64})
                       .image.pixels[0]
                       .x);
        // Cosine-weighted directions of the cone: E is the mean of L cos over p.
        const double one_minus_cos = ljus::one_minus_cosine(0.25 / (r * r));
        const double omega = 2 * pi * one_minus_cos;
        auto stream = ljus::random_stream(17, ljus::Pass::user, 0, 0);
        Estimate irradiance;
        for (int i = 0; i < shots; ++i) {
            const Vec d =
                ljus::sample_uniform_cone(next_2d<double>(stream), one_minus_cos);
            add(irradiance, 10 * d.z * omega);
        }
        table.rows.push_back({text(r), text(seen_radiance, "%.4f"), text(omega, "%.3g"),
                              text(irradiance.mean, "%.3g"),
                              text(irradiance.mean / omega, "%.3f")});
    }
    save_table(folder, table);
}

// --- The trade: four ways to an irradiance --------------------------------------------

/// A ball of radius 0.25 and radiance 100 over a patch of the floor, to its side.
struct Lamp {
    Sphere ball{.center{1, 2, 0}, .radius = 0.25};
    double radiance = 100;

    /// Irradiance of a point of the floor, in closed form.
    [[nodiscard]] double at(const Vec& point) const {
        return pi * radiance * *form_factor_from(point, Vec{0, 1, 0}, ball, false);
    }
};

/// One sample of the irradiance at the origin (or over a small patch) by each way.
enum Way { from_lamp, uniform, by_cosine, to_lamp, ways };
constexpr const char* way_names[] = {"rays from the lamp", "uniform directions",
                                     "cosine-weighted directions",
                                     "directions to the lamp"};

double sample_irradiance(Way way, const Lamp& lamp, ljus::RandomStream& stream) {
    const auto up = [](const Vec& z) { return Vec{z.x, z.z, -z.y}; }; // z to y
    const auto u = next_2d<double>(stream);
    if (way == from_lamp) {
        // A point of the lamp, a direction by the cosine; is the patch hit?
        constexpr double side = 0.25;
        const auto start = ljus::sample_area(lamp.ball, u);
        const auto frame = ljus::frame_around(start.normal);
        const Vec d =
            to_world(frame, ljus::sample_cosine_hemisphere(next_2d<double>(stream)));
        if (d.y >= 0) return 0;
        const Vec p = start.position - d * (start.position.y / d.y);
        const bool hit = std::abs(p.x) < side / 2 && std::abs(p.z) < side / 2;
        const double flux = pi * lamp.radiance * area(lamp.ball);
        return hit ? flux / (side * side) : 0;
    }
    if (way == to_lamp) {
        const auto found = ljus::sample_towards(lamp.ball, Vec{0, 0, 0}, u);
        const double cosine = glm::normalize(found.point.position).y;
        return lamp.radiance * cosine / found.pdf;
    }
    const Vec z = way == uniform ? ljus::sample_uniform_hemisphere(u)
                                 : ljus::sample_cosine_hemisphere(u);
    const double pdf = way == uniform ? ljus::pdf_uniform_hemisphere(z)
                                      : ljus::pdf_cosine_hemisphere(z);
    const Ray ray{.origin{0, 0, 0}, .direction = up(z)};
    return ljus::intersect(ray, lamp.ball) ? lamp.radiance * z.z / pdf : 0;
}

/// Plot and table: relative error against processor time.
void trade(const std::string& folder, int most, int seeds) {
    const Lamp lamp;
    double over_patch = 0; // the first way has a patch, the others a point
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            over_patch +=
                lamp.at({(i - 9.5) / 20 * 0.25, 0, (j - 9.5) / 20 * 0.25}) / 400;
    examples::Plot plot{.name = "radiance-trade",
                        .columns = {"processor time (microseconds)"},
                        .y_label = "relative error of the irradiance",
                        .log_x = true,
                        .log_y = true};
    examples::Table table{.name = "radiance-trade-table",
                          .columns = {"", "deviation of one sample, over the mean",
                                      "ns per sample", "time for 1 %, µs"}};
    for (const char* name : way_names) plot.columns.emplace_back(name);
    for (std::size_t way = 0; way < ways; ++way) {
        const auto w = static_cast<Way>(way);
        const double truth = w == from_lamp ? over_patch : lamp.at({0, 0, 0});
        auto clock_stream = ljus::random_stream(1, ljus::Pass::user, 1, 0);
        const double ns = examples::nanoseconds_a_call(20000.0, [&] {
            double sum = 0;
            for (int i = 0; i < 20000; ++i)
                sum += sample_irradiance(w, lamp, clock_stream);
            return sum;
        });
        Estimate one;
        for (int n = 64; n <= most; n *= 4) {
            double squares = 0;
            for (int seed = 0; seed < seeds; ++seed) {
                auto stream = ljus::random_stream(std::uint64_t(seed + 1),
                                                  ljus::Pass::user, way, 0);
                Estimate mean;
                for (int i = 0; i < n; ++i)
                    add(mean, sample_irradiance(w, lamp, stream));
                squares += std::pow(mean.mean / truth - 1, 2) / seeds;
                if (4 * n > most) one = joined(one, mean);
            }
            examples::Row row(ways + 1, std::nan(""));
            row[0] = n * ns / 1000;
            row[way + 1] = std::sqrt(squares);
            plot.rows.push_back(row);
        }
        const double deviation = std::sqrt(variance(one)) / truth;
        table.rows.push_back({way_names[way], text(deviation, "%.3g"), text(ns, "%.0f"),
                              text(deviation * deviation * 1e4 * ns / 1000, "%.3g")});
        std::printf("%-28s %s of the truth, %.3g per sample, %.0f ns\n", way_names[way],
                    text(one.mean / truth, "%.4f").c_str(), deviation, ns);
        examples::stop_if_asked();
    }
    save_plot(folder, plot);
    save_table(folder, table);
}

// --- Filters --------------------------------------------------------------------------

constexpr Filter filters[] = {Filter::box, Filter::tent, Filter::gaussian,
                              Filter::mitchell};
constexpr const char* filter_names[] = {"box", "tent", "Gaussian", "Mitchell"};

/// What a filter passes of a wave with so many cycles per pixel.
double passed(Filter filter, double frequency) {
    constexpr int steps = 4000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = (i + 0.5) / steps * 4 - 2;
        sum += ljus::filter_weight(filter, x) * std::cos(2 * pi * frequency * x);
    }
    return sum * 4 / steps;
}

/// A renderer of waves: along x, of one frequency, or rings that become finer outwards.
struct Card {
    using Stream = ljus::RandomStream;
    double frequency = 1.5; ///< In cycles per pixel; of rings, at the picture's edge.
    double half = 1;        ///< Pixels from the middle of the picture to its edge.
    bool rings = false;     ///< Or waves along x.
};
template <typename Context>
Rgb radiance(const Card& card, const ljus::Ray& ray, Context&) {
    const double x = double(ray.direction.x / -ray.direction.z) * card.half;
    const double y = double(ray.direction.y / -ray.direction.z) * card.half;
    const double value =
        card.rings ? std::cos(pi * card.frequency * (x * x + y * y) / card.half)
                   : std::sin(2 * pi * card.frequency * x);
    return Rgb(float(0.5 + 0.5 * value));
}

/// The picture of a card, with the camera straight before it.
ljus::Image picture_of(const Card& card, Filter filter, int samples, int pixels,
                       const examples::Options& options) {
    const auto camera = ljus::look_at({.vfov_degrees = 90});
    return render(card, camera,
                  {.width = pixels,
                   .height = pixels,
                   .samples = samples,
                   .seed = options.seed,
                   .threads = options.threads,
                   .filter = filter})
        .image;
}

/// The amplitude of a picture's waves over those of the card: the even pixels against
/// the odd ones, as 1.5 cycles per pixel come out as half of one.
double amplitude(const ljus::Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            sum += (double(pixel(image, x, y).x) - 0.5) * (x % 2 == 0 ? 2 : -2);
    return std::abs(sum) / double(image.pixels.size());
}

/// Plots: the weights of the filters, and what passes of each frequency.
void plot_filters(const std::string& folder) {
    examples::Plot weights{.name = "radiance-filters",
                           .columns = {"distance from the pixel's middle (pixels)"},
                           .y_label = "weight"};
    examples::Plot response{.name = "radiance-response",
                            .columns = {"cycles per pixel"},
                            .y_label = "amplitude that passes",
                            .more =
                                "set arrow from 0.5, graph 0 to 0.5, graph 1 nohead "
                                "dt 2 lc rgb '#808080'\n"};
    for (const char* name : filter_names) {
        weights.columns.emplace_back(name);
        response.columns.emplace_back(name);
    }
    for (int i = -55; i <= 55; ++i) {
        examples::Row row{i * 0.04};
        for (const Filter filter : filters)
            row.push_back(ljus::filter_weight(filter, row[0]));
        weights.rows.push_back(row);
    }
    for (int i = 0; i <= 100; ++i) {
        examples::Row row{i * 0.025};
        for (const Filter filter : filters)
            row.push_back(std::abs(passed(filter, row[0])));
        response.rows.push_back(row);
    }
    save_plot(folder, weights);
    save_plot(folder, response);
}

/// The deviation of pixels of white noise, which has no value twice.
double deviation_of_noise(Filter filter, std::uint64_t number) {
    Estimate white;
    auto stream = ljus::random_stream(5, ljus::Pass::user, 0, number);
    for (int k = 0; k < 200000; ++k) {
        const auto at = ljus::sample_filter(filter, next_2d<double>(stream));
        add(white, at.weight * (next_1d<double>(stream) < 0.5 ? -1 : 1));
    }
    return std::sqrt(variance(white));
}

/// The time that a filter takes to choose a place in the pixel.
double nanoseconds_per_ray(Filter filter, std::uint64_t number) {
    return examples::nanoseconds_a_call(20000.0, [&] {
        float sum = 0;
        auto numbers = ljus::random_stream(6, ljus::Pass::user, 0, number);
        for (int k = 0; k < 20000; ++k) {
            const auto at = ljus::sample_filter(filter, next_2d(numbers));
            sum += at.place.x + at.place.y * at.weight;
        }
        return sum;
    });
}

/// Table: what passes by the formula and in a picture, noise, and time.
void table_of_filters(const examples::Options& options, int samples) {
    examples::Table table{.name = "radiance-filter-table",
                          .columns = {"", "passes at 0.25", "passes at 1.5", "measured",
                                      "noise", "ns per ray"}};
    // Waves of 1.5 whose crests stand at the middles of every other pixel: +, -, +, ...
    const int side = 32;
    for (std::size_t i = 0; i < std::size(filters); ++i) {
        const auto waves = picture_of({.frequency = 1.5, .half = side / 2.0},
                                      filters[i], 16 * samples, side, options);
        table.rows.push_back({filter_names[i],
                              text(100 * passed(filters[i], 0.25), "%.1f %%"),
                              text(100 * std::abs(passed(filters[i], 1.5)), "%.2f %%"),
                              text(100 * amplitude(waves), "%.2f %%"),
                              text(deviation_of_noise(filters[i], i), "%.2f"),
                              text(nanoseconds_per_ray(filters[i], i), "%.1f")});
        examples::stop_if_asked();
    }
    save_table(options.path(""), table);
}

/// Rings that become finer outwards: by a ray through the middle of each pixel, and by
/// each filter.
void pictures_of_rings(const examples::Options& options, int pixels, int samples) {
    const Card rings{.frequency = 2, .half = pixels / 2.0, .rings = true};
    auto middles = ljus::make_image(pixels, pixels);
    const auto camera = ljus::look_at({.vfov_degrees = 90});
    for (int y = 0; y < pixels; ++y)
        for (int x = 0; x < pixels; ++x) {
            ljus::RandomStream none;
            ljus::Counts counts;
            auto context = ljus::context_of(none, counts);
            const auto ray =
                primary_ray(camera, {float(x) + 0.5f, float(y) + 0.5f}, pixels, pixels);
            pixel(middles, x, y) = radiance(rings, ray, context);
        }
    save_png(middles, options.path("radiance-rings-none.png"));
    for (std::size_t i = 0; i < std::size(filters); ++i)
        save_png(picture_of(rings, filters[i], samples, pixels, options),
                 options.path("radiance-rings-" + std::to_string(i + 1) + ".png"));
}

/// Plots of weights and of what passes; a table; pictures of rings.
void compare_filters(const examples::Options& options, int pixels, int samples) {
    plot_filters(options.path(""));
    table_of_filters(options, samples);
    pictures_of_rings(options, pixels, samples);
}

} // namespace

/// Makes the figures of chapter 2.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 2, radiance: its laws counted with rays, and filters.");
        line.add("--shots", sizes.shots, "Rays per count", 1000, 2000000000);
        line.add("--pixels", sizes.pixels, "Side of the pictures of rings", 8, 4000);
        const examples::Options options =
            line.parse({.draft{.width = 240, .height = 160, .samples = 16},
                        .report{.width = 480, .height = 320, .samples = 64},
                        .reference{.width = 480, .height = 320, .samples = 1024}});
        if (!line.given("--shots"))
            sizes.shots = options.pick(400000, 10000000, 100000000);
        if (!line.given("--pixels")) sizes.pixels = options.pick(160, 400, 400);
        const std::string folder = options.path("");
        draw_solid_angle(folder);
        draw_inverse_square(folder);
        draw_cosine(folder);
        draw_beam(folder);
        draw_pixel(folder);
        solid_angles(folder, sizes.shots);
        count_on_patches(folder, sizes.shots);
        near_the_lamp(folder);
        leave_the_wall(options);
        step_back(folder, std::min(sizes.shots, 1000000));
        trade(folder, options.pick(4096, 65536, 262144), options.pick(16, 64, 256));
        compare_filters(options, sizes.pixels, std::min(options.samples, 256));
    });
}
