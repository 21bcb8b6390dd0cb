// figures: fig-3
// smoke: --quality draft
/// \file 01_primary_rays.cpp
/// \brief Figure 3: the rays of a camera through the pixels of its picture, as a second
/// camera sees them.
// runs in the folder of its drawing

#include <cmath>
#include <numbers>
#include <vector>

#include <ljus/ljus.hpp>

#include "common/drawing.hpp"

using namespace ljus;
using namespace examples;

namespace {

/// The picture of the first camera.
constexpr int columns = 6, rows = 4;
const Camera camera =
    look_at({.position{-4.2f, 1.6f, 0}, .target{0.4f, 0.7f, 0}, .vfov_degrees = 30});

/// The scene that the first camera sees.
const Sphere ball{.center{0.3f, 0.75f, 0}, .radius = 0.75f};
const Quad ground{.corner{-1.6f, 0, 1.7f}, .edge_u{4, 0, 0}, .edge_v{0, 0, -3.4f}};

/// The second camera, beside the first.
constexpr int width = 720, height = 380;
const Camera onlooker = look_at(
    {.position{-5.2f, 4.0f, 8.5f}, .target{-0.75f, 0.65f, 0}, .vfov_degrees = 25});

/// Projects a point of the scene into the drawing, in which y points up.
Point seen(const Vec3& point) {
    const Vec2 at = project(onlooker, point, width, height).value();
    return {double(at.x), height - double(at.y)};
}

/// The upper left corner of a pixel, on a plane in front of the camera.
Point corner(int x, int y) {
    const Ray ray = primary_ray(camera, {float(x), float(y)}, columns, rows);
    return seen(point_at(ray, 2.1f / glm::dot(ray.direction, camera.forward)));
}

/// The ray through a point of the picture, up to its first hit.
void draw_ray(Drawing& drawing, const Vec2& pixel, const Pen& pen) {
    static const World world(
        make_scene(placed(ground, Lambertian{}), placed(ball, Lambertian{})));
    const Ray ray = primary_ray(camera, pixel, columns, rows);
    const auto hit = closest_hit(world, ray);
    const Point end = seen(point_at(ray, hit ? hit->at.t : 6.5f));
    draw_line(drawing, {seen(camera.position), end}, pen);
    if (hit) draw_dot(drawing, end, 2.5, pen.color);
}

/// The outline of the ball: the circle that the second camera sees as its edge.
std::vector<Point> outline() {
    const Vec3 way = onlooker.position - ball.center;
    const float near = ball.radius * ball.radius / glm::dot(way, way);
    const auto frame = frame_around(glm::normalize(way));
    std::vector<Point> points;
    for (int i = 0; i <= 64; ++i) {
        const float angle = float(i) * std::numbers::pi_v<float> / 32;
        const Vec3 round = to_world(frame, Vec3{std::cos(angle), std::sin(angle), 0});
        points.push_back(
            seen(ball.center + near * way + ball.radius * std::sqrt(1 - near) * round));
    }
    return points;
}

} // namespace

/// Draws fig-3.svg.
int main() {
    Drawing drawing{.name = "fig-3",
                    .description = "Rays from a view point through the pixels of the "
                                   "camera plane into the scene",
                    .low{0, 0},
                    .high{width, height},
                    .scale = 1};
    const auto& [at, u, v] = ground;
    draw_area(drawing, {seen(at), seen(at + u), seen(at + u + v), seen(at + v)},
              "currentColor");
    draw_line(drawing, outline());
    draw_area(drawing, outline(), colors::orange);

    // A ray through the middle of each pixel.
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            draw_ray(drawing, {float(x) + 0.5f, float(y) + 0.5f},
                     {.color = "#80808070", .width = 1});

    // The grid of pixels.
    const Pen grid{.color = colors::blue, .width = 1.2};
    draw_area(
        drawing,
        {corner(0, 0), corner(columns, 0), corner(columns, rows), corner(0, rows)},
        colors::blue);
    for (int x = 0; x <= columns; ++x)
        draw_line(drawing, {corner(x, 0), corner(x, rows)}, grid);
    for (int y = 0; y <= rows; ++y)
        draw_line(drawing, {corner(0, y), corner(columns, y)}, grid);

    // Five rays through one pixel, at the points of a stratified pattern.
    draw_area(drawing, {corner(2, 1), corner(3, 1), corner(3, 2), corner(2, 2)},
              colors::red);
    const Pattern pattern = make_pattern(Sampling::multi_jittered, 5);
    for (int i = 0; i < 5; ++i)
        draw_ray(drawing, Vec2{2, 1} + spread(pattern, i, 3, Vec2{0.5f}),
                 {.color = colors::red, .width = 1.3});

    const Point eye = seen(camera.position), top = corner(3, 0), side = seen(at + u);
    draw_dot(drawing, eye, 5, "currentColor");
    draw_label(drawing, {eye.x + 10, eye.y + 26}, "view point");
    draw_label(drawing, {top.x, top.y + 40}, "camera plane", colors::blue);
    draw_label(drawing, {side.x - 60, side.y + 160}, "3D scene");
    save_drawing(".", drawing);
}
