// smoke: --quality draft
/// \file chapters/drawings/18_drawings.cpp
/// \brief Chapter 18: the tree of a ray, in the scene and on paper.

#include <cmath>
#include <optional>
#include <string>

#include <ljus/geometry/sphere.hpp>
#include <ljus/math/frame.hpp>
#include <ljus/optics/reflection.hpp>
#include <ljus/optics/refraction.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::flat;
using examples::Point;
using Vec = ljus::Vec3T<double>;
namespace colors = examples::colors;

/// The ray that is refracted at a point of the ball, where there is one.
std::optional<Vec> refracted(const Vec& d, const Vec& n, double eta) {
    const auto frame = ljus::frame_around(n);
    const auto wt = ljus::refract(to_local(frame, -d), eta);
    if (!wt) return std::nullopt;
    return to_world(frame, *wt);
}

constexpr Point lamp_place{5.4, 4.0};
const ljus::SphereT<double> glass_ball{.center{4.0, 1.5, 0}, .radius = 0.95};

/// The room: a floor, a wall, a ball of glass and a lamp.
void draw_room(Drawing& drawing) {
    const auto outline = examples::circle(flat(glass_ball.center), glass_ball.radius);
    draw_line(drawing, {{0.2, 0}, {7.4, 0}}, {.width = 2.5});
    draw_line(drawing, {{7.4, 0}, {7.4, 4}}, {.width = 2.5});
    draw_area(drawing, outline, colors::blue);
    draw_line(drawing, outline);
    draw_line(drawing, {{5.0, 4.0}, {5.8, 4.0}}, {.color = colors::orange, .width = 6});
}

/// A shadow ray from a point to the lamp.
void draw_shadow_ray(Drawing& drawing, const Vec& from) {
    draw_line(drawing, {flat(from), lamp_place},
              {.color = colors::orange, .dashed = true});
    draw_dot(drawing, flat(from), 4, "currentColor");
}

/// Where a ray meets the ball.
Vec on_ball(const Vec& from, const Vec& d, double t_min) {
    const ljus::RayT<double> ray{.origin = from, .direction = d, .t_min = t_min};
    return from + intersect(ray, glass_ball).value() * d;
}

/// The ray that passes through the ball to the floor, and what is reflected within it.
/// \param hit  Where it enters.
/// \return Where it leaves.
Vec draw_through_ball(Drawing& drawing, const Vec& hit, const Vec& d) {
    const Vec inside = refracted(d, normal(glass_ball, hit), 1 / 1.5).value();
    const Vec leave = on_ball(hit, inside, 1e-6);
    const Vec out_normal = normal(glass_ball, leave);
    draw_arrow(drawing, flat(hit), flat(leave), {colors::blue, 2});
    const Vec out = refracted(inside, -out_normal, 1.5).value();
    const Vec end{leave.x - out.x * leave.y / out.y, 0, 0};
    draw_arrow(drawing, flat(leave), flat(end), {colors::blue, 2});
    draw_shadow_ray(drawing, end);
    // What is reflected within the ball leaves it further on.
    const Vec back = ljus::reflect(inside, out_normal);
    draw_arrow(drawing, flat(leave), flat(on_ball(leave, back, 1e-6)),
               {colors::red, 2});
    return leave;
}

/// A camera ray at a ball of glass between a diffuse floor and a diffuse wall.
void draw_tree_in_scene(const std::string& folder) {
    Drawing drawing{.name = "whitted-scene",
                    .description = "A camera ray at a ball of glass: one ray is "
                                   "reflected to a wall, another passes through "
                                   "the ball to the floor, and from both ends shadow "
                                   "rays go to the lamp",
                    .low{-0.2, -0.3},
                    .high{7.7, 4.3},
                    .scale = 95};
    draw_room(drawing);
    const Vec eye{0.4, 2.7, 0};
    const Vec d = glm::normalize(Vec{3.85, 2.44, 0} - eye);
    const Vec hit = on_ball(eye, d, 0);
    draw_arrow(drawing, flat(eye), flat(hit), {.width = 2.5});

    // Reflected: to the wall.
    const Vec up = ljus::reflect(d, normal(glass_ball, hit));
    const Vec high = hit + (7.4 - hit.x) / up.x * up;
    draw_arrow(drawing, flat(hit), flat(high), {colors::red, 2});
    draw_shadow_ray(drawing, high);

    const Vec leave = draw_through_ball(drawing, hit, d);
    for (const Vec& at : {eye, hit, leave})
        draw_dot(drawing, flat(at), 4, "currentColor");
    draw_label(drawing, {0.25, 2.95}, "E");
    draw_label(drawing, {1.6, 2.35}, "camera ray");
    draw_label(drawing, {4.7, 3.75}, "lamp", colors::orange);
    save_drawing(folder, drawing);
}

/// The same as a tree: each node a hit, each branch with its weight.
void draw_tree_on_paper(const std::string& folder) {
    Drawing drawing{.name = "whitted-tree",
                    .description = "The tree of a ray: at each hit on glass it divides "
                                   "into a reflected and a refracted ray; leaves ask "
                                   "the lamp",
                    .low{-0.4, -0.3},
                    .high{8.4, 3.7},
                    .scale = 85};
    // The letters of the chapter: F is reflected, 1 - F goes through.
    const struct {
        Point from, to;
        const char* color;
        const char* weight;
        Point label;
    } branches[] = {{{4, 3.4}, {4, 2.6}, "currentColor", "1", {4.2, 3.1}},
                    {{4, 2.6}, {1.8, 1.6}, colors::red, "F", {2.8, 2.3}},
                    {{4, 2.6}, {6.2, 1.6}, colors::blue, "1 − F", {5.45, 2.3}},
                    {{6.2, 1.6}, {4.9, 0.6}, colors::red, "(1 − F) F", {4.95, 1.25}},
                    {{6.2, 1.6}, {7.5, 0.6}, colors::blue, "(1 − F)²", {7.25, 1.42}}};
    for (const auto& branch : branches) {
        draw_arrow(drawing, branch.from, branch.to, {branch.color, 2});
        draw_label(drawing, branch.label, branch.weight, branch.color);
    }
    for (const Point& glass : {Point{4, 2.6}, Point{6.2, 1.6}, Point{4.9, 0.6}}) {
        draw_area(drawing, examples::circle(glass, 0.22), colors::blue);
        draw_line(drawing, examples::circle(glass, 0.22), {.width = 1.2});
    }
    for (const Point& leaf : {Point{1.8, 1.6}, Point{7.5, 0.6}}) {
        draw_dot(drawing, leaf, 8, "#808080");
        const double side = leaf.x < 4 ? -1 : 1; // away from the branch
        draw_line(drawing, {leaf, {leaf.x + 0.5 * side, leaf.y + 0.75}},
                  {.color = colors::orange, .width = 1.5, .dashed = true});
        draw_label(drawing, {leaf.x + 0.6 * side, leaf.y + 0.93}, "lamp",
                   colors::orange);
    }
    draw_line(drawing, {{4.9, 0.38}, {4.5, -0.1}},
              {.color = colors::red, .dashed = true});
    draw_line(drawing, {{4.9, 0.38}, {5.3, -0.1}},
              {.color = colors::blue, .dashed = true});
    draw_label(drawing, {1.8, 1.25}, "diffuse");
    draw_label(drawing, {4.65, 2.75}, "glass");
    draw_label(drawing, {7.5, 0.2}, "diffuse");
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 18, Whitted: drawings.");
        const examples::Options options = line.parse({});
        draw_tree_in_scene(options.path(""));
        draw_tree_on_paper(options.path(""));
    });
}
