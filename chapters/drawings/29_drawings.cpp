// smoke: --quality draft
/// \file chapters/drawings/29_drawings.cpp
/// \brief Chapter 29: the gather rays of two points, and how far each point counts.

#include <algorithm>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "drawings/drawing.hpp"
#include "flatland/material.hpp"
#include "flatland/scene.hpp"

namespace {

using examples::Drawing;
using examples::flat;
using flatland::Vec2;
namespace colors = examples::colors;

/// A floor, a wall at its left end and a ceiling.
const flatland::Scene room{{
    {flatland::Segment{.from{0, 0}, .to{7, 0}}},
    {flatland::Segment{.from{0, 3}, .to{0, 0}}},
    {flatland::Segment{.from{7, 3}, .to{0, 3}}},
}};

/// The gather rays of a point of the floor.
/// \return The harmonic mean of their lengths; a ray that meets nothing adds 0.
double draw_gather_rays(Drawing& drawing, double x, int rays, const char* color) {
    double inverse = 0;
    for (int k = 0; k < rays; ++k) {
        const Vec2 d = flatland::sample_cosine_half_circle((k + 0.5) / rays);
        const flatland::Ray ray{.origin{x, 0}, .direction = d};
        const auto hit = closest_hit(room, ray);
        const double shown = hit ? hit->t : 3.0 / d.y; // as far as the ceiling would be
        if (hit) inverse += 1 / (rays * hit->t);
        draw_arrow(drawing, {x, 0}, flat(ray.origin + shown * d), {color, 1});
    }
    return 1 / inverse;
}

/// A point near the wall and one in the open, with their harmonic means.
void draw_reach(const std::string& folder) {
    Drawing drawing{.name = "irradiance_cache-reach",
                    .description = "Gather rays of a point beside a wall and of one in "
                                   "the open: near the wall some are short, and the "
                                   "harmonic mean of all is short as well",
                    .low{-0.35, -1.05},
                    .high{7.2, 3.25},
                    .scale = 95};
    draw_line(drawing, {{7, 0}, {0, 0}, {0, 3}, {7, 3}}, {.width = 3});
    const struct {
        double x;
        const char* color;
        const char* name;
        double label;
    } points[] = {{0.5, colors::orange, "x_1", -0.4}, {4.2, colors::blue, "x_2", -0.4}};
    for (const auto& point : points) {
        const double mean = draw_gather_rays(drawing, point.x, 9, point.color);
        draw_dot(drawing, {point.x, 0}, 6, point.color);
        draw_label(drawing, {point.x, -0.28}, point.name, point.color);
        const double y = -0.55;
        draw_line(drawing, {{point.x - mean / 2, y}, {point.x + mean / 2, y}},
                  {.color = point.color, .width = 5});
        draw_label(drawing, {std::max(point.x, 0.65), y - 0.28},
                   std::string("R_") + point.name[2] + " = " +
                       examples::text(mean, "%.1f"),
                   point.color);
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawing.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 29, the irradiance cache: a drawing.");
        const examples::Options options = line.parse({});
        draw_reach(options.path(""));
    });
}
