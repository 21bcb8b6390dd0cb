// smoke: --quality draft
/// \file chapters/drawings/19_drawings.cpp
/// \brief Chapter 19: a lamp with an area, and a lens with an area.

#include <string>

#include <ljus/scene/lens_camera.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"
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
    // One point in the penumbra, with shadow rays to five points of the lamp.
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

/// Camera rays: all from one point on the film meet in the plane of focus.
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

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 19, distributed rays: drawings.");
        const examples::Options options = line.parse({});
        draw_penumbra(options.path(""));
        draw_lens(options.path(""));
    });
}
