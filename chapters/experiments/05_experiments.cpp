// figures: ray
// smoke: --quality draft --cases 50 --width 24
/// \file chapters/experiments/05_experiments.cpp
/// \brief Chapter 5: where a ray starts that leaves a surface. A fixed distance is too
/// long for one scene and too short for the next.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "experiments/numbers.hpp"
#include "ljus/geometry/shape.hpp"
#include "ljus/image/image.hpp"
#include "ljus/io/png.hpp"

using ljus::Quad;
using ljus::Ray;
using ljus::Sphere;
using ljus::SurfacePoint;
using ljus::Vec3;

namespace {

using Point = ljus::Vec3T<double>;
using examples::Numbers;
using Long3 = ljus::Vec3T<long double>;

// --- Ways to leave a surface ----------------------------------------------------------

/// The ways that are compared.
enum Way { fixed_2, fixed_3, fixed_4, fixed_5, integer_ulps, bound_alone, ours, ways };
constexpr const char* way_names[] = {
    "fixed 0.01",      "fixed 0.001", "fixed 0.0001",           "fixed 0.00001",
    "256 integer ulp", "bound alone", "ljus::offset_ray_origin"};

/// Steps a float away from 0 or towards it, by so many of its neighbours.
float step(float x, int count) {
    return std::bit_cast<float>(std::bit_cast<std::int32_t>(x) +
                                (x < 0 ? -count : count));
}

/// Waechter and Binder 2019: a count of neighbours in proportion to the normal's
/// coordinate; near 0, where neighbours crowd, a fixed length.
Vec3 leave_by_integers(const Vec3& p, const Vec3& n) {
    Vec3 result;
    for (int k = 0; k < 3; ++k)
        result[k] = std::abs(p[k]) < 1.0f / 32
                        ? p[k] + n[k] / 65536
                        : step(p[k], static_cast<int>(256 * n[k]));
    return result;
}
/// By the bound of the error, and one neighbour outward; as pbrt does.
Vec3 leave_by_bound(const SurfacePoint& point, const Vec3& n) {
    const Vec3 offset = glm::dot(glm::abs(n), point.error) * n;
    Vec3 result = point.position + offset;
    for (int k = 0; k < 3; ++k)
        if (offset[k] != 0)
            result[k] = std::nextafter(result[k], offset[k] > 0 ? 1e38f : -1e38f);
    return result;
}
Vec3 offset_ray_origin(Way way, const SurfacePoint& point, const Vec3& direction) {
    const float side = glm::dot(direction, point.normal) < 0 ? -1.0f : 1.0f;
    switch (way) {
    case fixed_2:
        return point.position + 1e-2f * side * point.normal;
    case fixed_3:
        return point.position + 1e-3f * side * point.normal;
    case fixed_4:
        return point.position + 1e-4f * side * point.normal;
    case fixed_5:
        return point.position + 1e-5f * side * point.normal;
    case integer_ulps:
        return leave_by_integers(point.position, side * point.normal);
    case bound_alone:
        return leave_by_bound(point, side * point.normal);
    default:
        return ljus::offset_ray_origin(point, direction);
    }
}

// --- The count ------------------------------------------------------------------------

/// How far a point lies above a surface. Three floats multiplied have 72 bits, of which
/// long double keeps 64: the tests do this with fractions.
long double height(const Sphere& sphere, const Vec3& p) {
    const Long3 way = Long3(p) - Long3(sphere.center);
    const auto r = static_cast<long double>(sphere.radius);
    return (glm::dot(way, way) - r * r) / (2 * r);
}
long double height(const Quad& quad, const Vec3& p) {
    const Long3 up = glm::cross(Long3(quad.edge_u), Long3(quad.edge_v));
    return glm::dot(Long3(p) - Long3(quad.corner), up) / glm::length(up);
}
Point true_normal(const Sphere& sphere, const Vec3& p) {
    return glm::normalize(Point(p) - Point(sphere.center));
}
Point true_normal(const Quad& quad, const Vec3&) {
    return glm::normalize(glm::cross(Point(quad.edge_u), Point(quad.edge_v)));
}

/// What went wrong with the starts of some rays, each counted once.
struct Tally {
    long rays = 0, wrong_side = 0, on_surface = 0, through_layer = 0;
    long wrong() const { return wrong_side + on_surface + through_layer; }
};
using Tallies = std::array<Tally, ways>;

/// Rays that leave the point where another ray hit, on both sides of it.
template <typename Shape>
void leave_shape(Tallies& tallies, Numbers& n, const Shape& shape, const Vec3& target,
                 double size) {
    const Point origin = Point(target) + size * (0.2 + 5 * n.next()) * n.direction();
    Ray ray{.origin = Vec3(origin)};
    ray.direction = Vec3(glm::normalize(Point(target) - Point(ray.origin)));
    const auto hit = ljus::intersect(ray, shape);
    if (!hit) return;
    const SurfacePoint point = ljus::surface_point(shape, ray, ljus::as_hit(*hit));
    const Point up = true_normal(shape, point.position);
    for (const double side : {1.0, -1.0}) {
        const Point along = glm::normalize(glm::cross(up, n.direction()));
        const double cosine = std::pow(10.0, -2 * n.next());
        const Vec3 direction(side * cosine * up + along);
        for (std::size_t way = 0; way < ways; ++way) {
            const auto h = height(
                shape, offset_ray_origin(static_cast<Way>(way), point, direction));
            Tally& tally = tallies[way];
            ++tally.rays;
            if (h * static_cast<long double>(side) < 0)
                ++tally.wrong_side;
            else if (h == 0)
                ++tally.on_surface;
            else if (std::abs(h) >= 1e-3L * static_cast<long double>(size))
                ++tally.through_layer;
        }
    }
}

/// Spheres and quads of a size, at up to `offset` sizes from the origin.
Tallies count(double size, double offset, int cases, std::uint64_t seed) {
    Tallies tallies{};
    Numbers n{seed};
    for (int i = 0; i < cases; ++i) {
        Point center = size * offset * n.next() * n.direction();
        Point a = n.direction(), b = glm::normalize(glm::cross(a, n.direction()));
        if (i % 4 == 0) a = Point{0, 0, 1}, b = Point{1, 0, 0}; // a floor
        if (i % 8 == 0) center.y = 0;                           // at height 0
        const Point corner = center - size * (n.next() * a + n.next() * b);
        const Quad quad{Vec3(corner), Vec3(size * a), Vec3(size * b)};
        const Sphere sphere{Vec3(center + size * a), static_cast<float>(size)};
        leave_shape(tallies, n, quad, Vec3(center), size);
        leave_shape(tallies, n, sphere, Vec3(center), size);
    }
    return tallies;
}

/// Nanoseconds for one start of a ray; the best of 15 runs.
double nanoseconds(Way way) {
    Numbers n;
    std::vector<SurfacePoint> points;
    std::vector<Vec3> directions;
    for (int i = 0; i < 1024; ++i) {
        const Quad quad{Vec3(n.direction()), Vec3(n.direction()), Vec3(n.direction())};
        points.push_back(ljus::point_at(quad, 0.3f, 0.4f));
        directions.push_back(Vec3(n.direction()));
    }
    return examples::nanoseconds_a_call(
        50.0 * 1024,
        [&] {
            Vec3 sum{0};
            for (int round = 0; round < 50; ++round)
                for (std::size_t i = 0; i < points.size(); ++i)
                    sum += offset_ray_origin(way, points[i], directions[i]);
            return sum.x;
        },
        15);
}

/// Plot and table: what each way gets wrong, by the size of the scene and in all.
void compare(const std::string& folder, int cases) {
    examples::Plot plot{.name = "ray-wrong",
                        .columns = {"size of the object, in scene units"},
                        .y_label = "starts that are wrong, %",
                        .rows = {},
                        .log_x = true};
    for (const char* name : way_names) plot.columns.emplace_back(name);
    Tallies all{};
    for (int power = -4; power <= 4; ++power) {
        const auto tallies = count(std::pow(10.0, power), 30, cases,
                                   static_cast<std::uint64_t>(power + 10));
        examples::Row row{std::pow(10.0, power)};
        for (std::size_t way = 0; way < ways; ++way) {
            const Tally& tally = tallies[way];
            row.push_back(100.0 * static_cast<double>(tally.wrong()) /
                          static_cast<double>(tally.rays));
            all[way].rays += tally.rays;
            all[way].wrong_side += tally.wrong_side;
            all[way].on_surface += tally.on_surface;
            all[way].through_layer += tally.through_layer;
        }
        plot.rows.push_back(row);
    }
    examples::save_plot(folder, plot);

    examples::Table table{
        .name = "ray-trade",
        .columns = {"", "ns", "wrong side", "on the surface", "through a layer"},
        .rows = {}};
    for (std::size_t way = 0; way < ways; ++way) {
        const auto share = [&](long wrong) {
            return wrong == 0 ? std::string("0")
                              : examples::text(100.0 * static_cast<double>(wrong) /
                                                   static_cast<double>(all[way].rays),
                                               "%.2g %%");
        };
        table.rows.push_back(
            {way_names[way], examples::text(nanoseconds(static_cast<Way>(way)), "%.1f"),
             share(all[way].wrong_side), share(all[way].on_surface),
             share(all[way].through_layer)});
    }
    examples::save_table(folder, table);
    for (const auto& row : table.rows) {
        for (const auto& cell : row) std::printf("%-16s ", cell.c_str());
        std::printf("\n");
    }
    std::printf("of %ld starts each\n", all[0].rays);
}

// --- The picture ----------------------------------------------------------------------

/// A ball on a floor under a lamp, and beside it a lid of 1/800 its width, with an
/// orange lamp below it; all of it `size` times as large, `offset` sizes away from 0.
struct Room {
    Sphere ball;
    std::array<Quad, 3> quads; ///< Floor, lower and upper face of the lid.
    Vec3 eye, lamp, low_lamp;
    float size;
};

Room make_room(double size, double offset) {
    const Point place = offset * Point{1, 1, -1};
    const auto at = [&](double x, double y, double z) {
        return Vec3(size * (place + Point{x, y, z}));
    };
    const auto s = static_cast<float>(size);
    const auto flat = [&](double x, double y, double z, float w, float d) {
        return Quad{at(x, y, z), {0, 0, d * s}, {w * s, 0, 0}};
    };
    return {.ball = {at(-0.9, 0.5, 0.1), 0.5f * s},
            .quads = {flat(-4, 0, -5, 8, 9), flat(0, 0.8, -0.7, 1.6f, 1.4f),
                      flat(0, 0.802, -0.7, 1.6f, 1.4f)},
            .eye = at(0.2, 2, 4.2),
            .lamp = at(-2.5, 3, 1.5),
            .low_lamp = at(0.8, 0.35, 0),
            .size = s};
}

/// The first hit of a ray, with its surface.
struct Found {
    float t = std::numeric_limits<float>::infinity();
    SurfacePoint point{};
    int object = -1;
};

Found first_hit(const Room& room, Ray ray) {
    Found found;
    const auto ask = [&](const auto& shape, int object) {
        const auto hit = ljus::intersect(ray, shape);
        if (!hit) return;
        ray.t_max = found.t = ljus::as_hit(*hit).t;
        found.point = ljus::surface_point(shape, ray, ljus::as_hit(*hit));
        found.object = object;
    };
    ask(room.ball, 0);
    for (int i = 0; i < 3; ++i) ask(room.quads[static_cast<std::size_t>(i)], i + 1);
    return found;
}

/// Direct light, each lamp by one shadow ray. A fixed start lies so far along the ray,
/// from the point O + tD, as in the report's program; ours is spawn_ray_to().
ljus::Rgb shade(const Room& room, const Ray& ray, const Found& found, float fixed) {
    const ljus::Rgb colors[] = {{0.8f, 0.3f, 0.25f},
                                {0.7f, 0.7f, 0.7f},
                                {0.3f, 0.5f, 0.75f},
                                {0.3f, 0.5f, 0.75f}};
    const ljus::Rgb color = colors[found.object];
    ljus::Rgb light{0.04f};
    const auto add = [&](const Vec3& lamp, const ljus::Rgb& power) {
        Ray shadow = ljus::spawn_ray_to(found.point, SurfacePoint{.position = lamp});
        if (fixed > 0) {
            shadow.origin = ljus::point_at(ray, found.t);
            const float length = glm::length(lamp - shadow.origin);
            shadow.direction = (lamp - shadow.origin) / length;
            shadow.t_min = fixed, shadow.t_max = length;
        }
        if (first_hit(room, shadow).object >= 0) return;
        const Vec3 way = (lamp - found.point.position) / room.size;
        Vec3 normal = found.point.normal;
        if (glm::dot(normal, ray.direction) > 0) normal = -normal; // towards the eye
        const float distance2 = glm::dot(way, way);
        const float cosine = glm::dot(normal, way) / std::sqrt(distance2);
        // The lid lets nothing through; what comes from behind has found a way in.
        light += power * std::abs(cosine) / distance2;
    };
    add(room.lamp, ljus::Rgb{9});
    add(room.low_lamp, 0.35f * ljus::Rgb{1, 0.55f, 0.15f});
    return color * light;
}
ljus::Image picture(int width, double size, float fixed) {
    constexpr int height_by_3 = 2;
    const int height = std::max(1, width * height_by_3 / 3);
    const Room room = make_room(size, 10);
    const Point eye(room.eye);
    const Point target = size * (10.0 * Point{1, 1, -1} + Point{0, 0.35, 0});
    const Point forward = glm::normalize(target - eye);
    const Point right = glm::normalize(glm::cross(forward, Point{0, 1, 0}));
    const Point up = glm::cross(right, forward);
    ljus::Image image = ljus::make_image<float>(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double across = 0.9 * ((x + 0.5) / width - 0.5);
            const double along = 0.9 * (0.5 * height - y - 0.5) / width;
            const Ray ray{.origin = room.eye,
                          .direction = Vec3(
                              glm::normalize(forward + across * right + along * up))};
            const Found found = first_hit(room, ray);
            ljus::pixel(image, x, y) = found.object < 0
                                           ? ljus::Rgb{0.05f, 0.06f, 0.08f}
                                           : shade(room, ray, found, fixed);
        }
    return image;
}

} // namespace

/// Makes the chapter's figures.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; 2 with one sentence for anything that is wrong.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        int cases = 0;
        line.about("Chapter 5, the ray: its figures and its table.");
        line.add("--cases", cases, "Objects a size", 1, 100000000);
        const examples::Options options = line.parse(
            {.draft{.width = 540}, .report{.width = 540}, .reference{.width = 1080}});
        if (!line.given("--cases")) cases = options.pick(10000, 50000, 1000000);
        compare(options.out, cases);
        for (const auto& [name, scale] :
             {std::pair{"0.01", 0.01}, std::pair{"0.1", 0.1}, std::pair{"1", 1.0},
              std::pair{"100", 100.0}, std::pair{"10000", 1e4}}) {
            ljus::save_png(picture(options.width, scale, 1e-3f),
                           options.path(std::string("ray-fixed-") + name + ".png"));
            ljus::save_png(picture(options.width, scale, 0),
                           options.path(std::string("ray-leave-") + name + ".png"));
        }
    });
}
