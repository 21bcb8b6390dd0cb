// smoke: --quality draft
/// \file chapters/drawings/31_drawings.cpp
/// \brief Chapter 31: the gather rays of two points, how far points count, and which of
/// them answer.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"
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
/// \return The harmonic mean of their lengths; a ray that hits nothing adds 0.
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

/// A room in the plane: how far a point of its floor sees, as a harmonic mean.
double distance_on_floor(double x, double width, double height) {
    double inverse = 0;
    constexpr int rays = 4000;
    for (int i = 0; i < rays; ++i) {
        const double along = (2 * i + 1.0) / rays - 1; // the cosine law in the plane
        const double up = std::sqrt(1 - along * along);
        const double wall = along < 0 ? x / -along : (width - x) / along;
        inverse += 1 / std::min(wall, height / up) / rays;
    }
    return 1 / inverse;
}

/// Points on a floor, the reach of each, and a point where irradiance is interpolated.
void draw_idea(const std::string& folder) {
    constexpr double width = 9, height = 2.4, reach = 0.5;
    constexpr std::array places{0.12, 0.45, 0.8, 1.35, 1.9, 2.4, 3.0, 3.5, 4.2, 4.75};
    Drawing figure{.name = "irradiance_cache-idea",
                   .description =
                       "Points on a floor beside a wall; those near the wall count for "
                       "a short distance",
                   .low{-0.2, -0.5},
                   .high{5.3, 1.75},
                   .scale = 130};
    draw_area(figure, {{-0.2, -0.1}, {5.3, -0.1}, {5.3, 0}, {-0.2, 0}}, "currentColor");
    draw_area(figure, {{-0.2, 0}, {0, 0}, {0, 1.75}, {-0.2, 1.75}}, "currentColor");
    draw_line(figure, {{0, 1.75}, {0, 0}, {5.3, 0}});
    for (const double x : places) {
        const double r = reach * distance_on_floor(x, width, height);
        draw_arc(figure, {x, 0}, r, 0, std::numbers::pi, {colors::blue, 1, true});
    }
    // Six points take part, the nearest says how far they may lie.
    constexpr double asked = 2.6, around = 1.25;
    for (const double x : places) {
        const double share = (x - asked) * (x - asked) / (around * around);
        const double r = reach * distance_on_floor(x, width, height);
        if (share < 1 && std::abs(x - asked) < r)
            draw_line(figure, {{asked, 0.42}, {x, 0}},
                      {colors::orange, 0.5 + 5 * (1 - share)});
        draw_dot(figure, {x, 0}, 5, colors::blue);
    }
    draw_dot(figure, {asked, 0.42}, 6, colors::orange);
    draw_line(figure, {{asked, 0.42}, {asked, 0}}, {"currentColor", 1, true});
    draw_label(figure, {asked, 0.62}, "E ?", colors::orange);
    draw_label(figure, {2.6, -0.3},
               "points that have gathered, and how far each counts", colors::blue);
    save_drawing(folder, figure);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 31, the irradiance cache: drawings.");
        const examples::Options options = line.parse({});
        draw_reach(options.path(""));
        draw_idea(options.path(""));
    });
}
