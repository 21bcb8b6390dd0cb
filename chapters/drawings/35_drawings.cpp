// smoke: --quality draft
/// \file chapters/drawings/35_drawings.cpp
/// \brief Chapter 35: the parts of an error, three ways to end a path, and rays where the first
/// ones disagree.

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

/// The light of each bounce as a bar, and what three endings keep of it.
void draw_endings(const std::string& folder) {
    Drawing drawing{.name = "recursion_depth-endings",
                    .description =
                        "The light of each bounce as a bar: a limit cuts the "
                        "tail off, roulette keeps every bar in the mean",
                    .low{-0.3, -0.75},
                    .high{9.2, 2.85},
                    .scale = 85};
    const double albedo = 0.75;
    const char* names[] = {"limit of depth", "threshold", "roulette"};
    auto stream = ljus::random_stream(3, ljus::Pass::user, 0, 0);
    for (int way = 0; way < 3; ++way) {
        const double x = 3.1 * way;
        double light = 2.2;
        bool goes_on = true;
        for (int bounce = 0; bounce < 9; ++bounce) {
            const Point low{x + 0.3 * bounce, 0}, high{low.x + 0.22, light};
            const std::vector<Point> bar{
                low, {high.x, low.y}, high, {low.x, high.y}, low};
            bool kept = way == 0 ? bounce < 4 : way == 1 ? light > 0.55 : goes_on;
            draw_line(drawing, bar, {.color = "#80808090", .width = 1});
            if (kept) draw_area(drawing, bar, colors::blue);
            if (kept && way == 2 && bounce > 1) {
                // What survives is divided by the chance of surviving.
                const double grown = light / std::pow(albedo, bounce - 1);
                draw_line(drawing, {{low.x, grown}, {high.x, grown}},
                          {colors::orange, 3});
                goes_on = next_1d(stream) < 0.75f;
            } else if (kept) {
                draw_line(drawing, {{low.x, light}, high}, {colors::blue, 3});
            }
            light *= albedo;
        }
        draw_line(drawing, {{x - 0.1, 0}, {x + 2.8, 0}}, {.width = 1.5});
        if (way == 0) { // the bars up to bounce d stay
            draw_line(drawing, {{x + 1.16, 0}, {x + 1.16, 1.6}},
                      {colors::red, 1.2, true});
            draw_label(drawing, {x + 1.16, 1.8}, "d = 3", colors::red);
        }
        if (way == 1) {
            draw_line(drawing, {{x - 0.1, 0.55}, {x + 2.8, 0.55}},
                      {colors::red, 1.2, true});
            draw_label(drawing, {x + 2.6, 0.75}, "t", colors::red);
        }
        draw_label(drawing, {x + 1.35, -0.35}, names[way]);
    }
    save_drawing(folder, drawing);
}

/// Pixels across an edge: two rays each, and those where the two disagree.
void draw_pixels(const std::string& folder) {
    Drawing drawing{.name = "recursion_depth-disagree",
                    .description =
                        "Pixels with two rays each. Where the two differ, along the "
                        "edge, pixels and those around them get more",
                    .low{-0.1, -0.1},
                    .high{7.1, 4.1},
                    .scale = 85};
    const auto is_inside = [](const Point& p) {
        return std::hypot(p.x - 2.4, p.y - 1.2) < 2.1;
    };
    draw_area(drawing, examples::circle({2.4, 1.2}, 2.1), colors::blue);
    auto stream = ljus::random_stream(5, ljus::Pass::user, 0, 0);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 14; ++x) {
            const auto ray = [&] {
                const ljus::Vec2 u = next_2d(stream);
                return Point{0.5 * (x + double(u.x)), 0.5 * (y + double(u.y))};
            };
            const std::vector<Point> rays{ray(), ray()};
            const bool disagree = is_inside(rays[0]) != is_inside(rays[1]);
            const Point low{0.5 * x, 0.5 * y};
            const std::vector<Point> pixel{low,
                                           {low.x + 0.5, low.y},
                                           {low.x + 0.5, low.y + 0.5},
                                           {low.x, low.y + 0.5},
                                           low};
            if (disagree) draw_area(drawing, pixel, colors::orange);
            draw_line(drawing, pixel, {.color = "#80808070", .width = 0.8});
            for (const Point& at : rays)
                draw_dot(drawing, at, 1.8, disagree ? colors::red : "#808080");
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
        line.about("Chapter 35, when to stop: drawings.");
        const examples::Options options = line.parse({});
        draw_endings(options.path(""));
        draw_pixels(options.path(""));
        draw_triangle(options.path(""));
    });
}
