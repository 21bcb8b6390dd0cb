// smoke: --quality draft --cases 50
/// \file chapters/experiments/05_experiments.cpp
/// \brief Chapter 5: the experiments behind its plot and table: how often a ray starts
/// on the wrong side of the surface that it leaves.

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "experiments/numbers.hpp"
#include "ljus/geometry/shape.hpp"

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

/// The float that lies `count` floats above x; below it, if the count is negative.
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

/// How far a point lies above a surface. The product of three floats has 72 bits, and
/// long double keeps 64 of them; the tests compute it exactly, with fractions.
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

/// What was wrong with the starts of rays; each wrong start is counted once.
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

/// Plot and table: the wrong starts of each way, by the size of the scene and in all.
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
    examples::print_row(table.columns, 23);
    examples::print_rows(table, 23);
    std::printf("of %ld starts each\n", all[0].rays);
}

} // namespace

/// Makes the chapter's plot and table.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        int cases = 0;
        line.about("Chapter 5, the ray: its plot and its table.");
        line.add("--cases", cases, "Objects a size", 1, 100000000);
        line.without({"--width", "--height", "--rays", "--seed", "--threads"});
        const examples::Options options = line.parse();
        if (!line.given("--cases")) cases = options.pick(10000, 50000, 1000000);
        compare(options.out, cases);
    });
}
