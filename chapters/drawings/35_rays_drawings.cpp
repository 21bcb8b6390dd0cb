// smoke: --quality draft
/// \file chapters/drawings/35_rays_drawings.cpp
/// \brief Chapter 35: what the rays of a pixel say about it, and the parts of an error.

#include <cmath>
#include <string>
#include <vector>

#include <ljus/math/random.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A pixel that an edge cuts, with more and more random rays.
void draw_pixel(const std::string& folder) {
    Drawing drawing{.name = "rays_per_pixel-edge",
                    .description =
                        "A pixel that is partly covered, with 4, 16, 64 and "
                        "256 random rays, and the share of rays that find the "
                        "covered part",
                    .low{-0.1, -0.45},
                    .high{8.0, 1.95},
                    .scale = 95};
    const double side = 1.8;
    // The edge runs from the lower left at 0.25 to the upper right at 0.75.
    const auto is_covered = [](double x, double y) { return x < 0.3 + 0.4 * y; };
    double x = 0;
    auto stream = ljus::random_stream(21, ljus::Pass::user, 0, 0);
    for (const int rays : {4, 16, 64, 256}) {
        const auto at = [&](double u, double v) {
            return Point{x + side * u, side * v};
        };
        draw_area(drawing, {at(0, 0), at(0.3, 0), at(0.7, 1), at(0, 1)},
                  "currentColor");
        draw_line(drawing, {at(0, 0), at(1, 0), at(1, 1), at(0, 1), at(0, 0)},
                  {.width = 1.5});
        int found = 0;
        for (int i = 0; i < rays; ++i) {
            const ljus::Vec2 u = next_2d(stream);
            const bool covered = is_covered(double(u.x), double(u.y));
            found += covered;
            draw_dot(drawing, at(double(u.x), double(u.y)), rays > 100 ? 1.8 : 3,
                     covered ? colors::red : colors::blue);
        }
        draw_label(drawing, {x + side / 2, -0.28},
                   std::to_string(rays) +
                       " rays: " + examples::text(double(found) / rays, "%.2f"));
        x += 2.05;
    }
    save_drawing(folder, drawing);
}

/// Bias and noise as the legs of a right triangle.
void draw_triangle(const std::string& folder) {
    Drawing drawing{.name = "rays_per_pixel-parts",
                    .description =
                        "Bias and noise as the legs of a right triangle whose "
                        "longest side is the error; more rays shorten the "
                        "leg of the noise only",
                    .low{-0.6, -0.7},
                    .high{5.3, 1.2},
                    .scale = 95};
    const double bias = 0.9;
    const char* names[] = {"1 ray", "4 rays", "16 rays"};
    double noise = 4.4;
    for (int i = 0; i < 3; ++i) {
        draw_line(drawing, {{0, bias}, {noise, 0}}, {colors::red, 2});
        draw_dot(drawing, {noise, 0}, 4, colors::red);
        draw_label(drawing, {noise + 0.05, -0.32}, names[i]);
        noise /= 2;
    }
    draw_line(drawing, {{0, 0}, {4.4, 0}}, {colors::blue, 3});
    draw_line(drawing, {{0, 0}, {0, bias}}, {colors::orange, 4});
    draw_line(drawing, {{0.15, 0}, {0.15, 0.15}, {0, 0.15}}, {.width = 1});
    draw_label(drawing, {-0.32, bias / 2}, "bias", colors::orange);
    draw_label(drawing, {3.3, 0.72}, "error", colors::red);
    draw_label(drawing, {3.3, -0.32}, "noise", colors::blue);
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 35, rays per pixel: drawings.");
        const examples::Options options = line.parse({});
        draw_pixel(options.path(""));
        draw_triangle(options.path(""));
    });
}
