// smoke: --quality draft
/// \file chapters/drawings/02_drawings.cpp
/// \brief Chapter 2: solid angles, beams and patches, and the rays of a pixel.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/math/vector.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Pen;
using examples::Point;
using Vec = ljus::Vec3T<double>;
namespace colors = examples::colors;

constexpr double pi = std::numbers::pi;

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

/// A lamp, and three patches with what their middles see of it.
void draw_smaller(const std::string& folder) {
    Drawing d{.name = "radiance-smaller",
              .description =
                  "A lamp seen from three distances: it covers less of the view, "
                  "and has the same radiance",
              .low{-0.4, -0.6},
              .high{3.75, 1.3},
              .scale = 170};
    constexpr double lamp = 0.2, half_view = 0.36;
    draw_dot(d, {0, 0}, lamp * d.scale, colors::orange);
    for (const double r : {0.8, 1.6, 3.2}) {
        draw_line(d, {{r, -0.25}, {r, 0.25}}, {.width = 4});
        draw_label(d, {r, -0.45}, "r = " + examples::text(r, "%g"));
        const Point view{r, 0.85};
        draw_line(d, {{r - half_view, view.y - half_view},
                      {r + half_view, view.y - half_view},
                      {r + half_view, view.y + half_view},
                      {r - half_view, view.y + half_view},
                      {r - half_view, view.y - half_view}});
        draw_dot(d, view, lamp / r / 0.6 * half_view * d.scale, colors::orange);
    }
    save_drawing(folder, d);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 2, radiance: drawings.");
        const std::string folder = line.parse({}).path("");
        draw_solid_angle(folder);
        draw_inverse_square(folder);
        draw_cosine(folder);
        draw_beam(folder);
        draw_smaller(folder);
        draw_pixel(folder);
    });
}
