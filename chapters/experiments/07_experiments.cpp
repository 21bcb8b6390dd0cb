// smoke: --quality draft --cases 300 --width 24
/// \file chapters/experiments/07_experiments.cpp
/// \brief Chapter 7: the experiments behind its plot and its first table: a vertex
/// under the microscope, and the cost of a watertight test.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/intersect.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "experiments/numbers.hpp"
#include "ljus/geometry/watertight.hpp"
#include "ljus/image/image.hpp"
#include "ljus/io/png.hpp"

using ljus::Ray;
using ljus::Triangle;
using ljus::Vec3;

namespace {

using Point = ljus::Vec3T<double>;
using examples::Numbers;

// --- Ways to meet a triangle ----------------------------------------------------------

/// With the usual guard against parallel rays: an epsilon with a unit, volume.
std::optional<float> intersect_guarded(const Ray& ray, const Triangle& triangle) {
    const Vec3 e1 = triangle.v2 - triangle.v1, e2 = triangle.v3 - triangle.v1;
    const Vec3 p = glm::cross(ray.direction, e2);
    const float determinant = glm::dot(p, e1);
    if (std::abs(determinant) < 1e-6f) return std::nullopt;
    const auto hit = ljus::intersect<float>(ray, triangle);
    if (!hit) return std::nullopt;
    return hit->t;
}

/// The ways that are compared.
enum Way { in_float, guarded, glms, in_double, watertight, ways };
constexpr const char* way_names[] = {"Moeller-Trumbore in float", "guarded by 1e-6",
                                     "glm", "Moeller-Trumbore in double", "watertight"};

/// What a way computes once for a ray.
template <Way way>
auto prepare(const Ray& ray) {
    if constexpr (way == watertight)
        return ljus::prepare<ljus::Watertight>(ray);
    else
        return ljus::prepare(ray);
}

/// The distance to the hit, NaN for a miss.
template <Way way, typename Prepared>
float hit(const Ray& ray, const Triangle& triangle, const Prepared& prepared) {
    constexpr float miss = std::numeric_limits<float>::quiet_NaN();
    if constexpr (way == guarded) {
        return intersect_guarded(ray, triangle).value_or(miss);
    } else if constexpr (way == glms) {
        glm::vec2 uv;
        float t = 0;
        const bool found = glm::intersectRayTriangle(
            ray.origin, ray.direction, triangle.v1, triangle.v2, triangle.v3, uv, t);
        return found && t >= 0 ? t : miss;
    } else if constexpr (way == watertight) {
        const auto found = ljus::intersect<ljus::Watertight>(ray, triangle, prepared);
        return found ? found->t : miss;
    } else if constexpr (way == in_double) {
        const auto found = ljus::intersect<double>(ray, triangle);
        return found ? found->t : miss;
    } else {
        const auto found = ljus::intersect<float>(ray, triangle);
        return found ? found->t : miss;
    }
}

// --- Leaks ----------------------------------------------------------------------------

/// A closed mesh around a centre: a dented ball of 128 triangles.
struct Mesh {
    Point center{0};
    std::vector<Triangle> triangles{};
};

Mesh dented_ball(double size, const Point& center) {
    Numbers n{7};
    std::array<std::array<Point, 8>, 8> rings;
    for (std::size_t row = 0; row < 8; ++row)
        for (std::size_t column = 0; column < 8; ++column) {
            const double theta = std::numbers::pi * (static_cast<double>(row) + 1) / 9;
            const double phi = std::numbers::pi * (static_cast<double>(column)) / 4;
            const double r = size * (0.98 + 0.04 * n.next());
            rings[row][column] =
                center + r * Point{std::sin(theta) * std::cos(phi),
                                   std::sin(theta) * std::sin(phi), std::cos(theta)};
        }
    Mesh mesh{.center = center};
    const Vec3 top(center + Point{0, 0, size}), bottom(center - Point{0, 0, size});
    for (std::size_t column = 0; column < 8; ++column) {
        const std::size_t next = (column + 1) % 8;
        mesh.triangles.push_back({top, Vec3(rings[0][column]), Vec3(rings[0][next])});
        for (std::size_t row = 0; row < 7; ++row) {
            const Vec3 a(rings[row][column]), b(rings[row][next]),
                c(rings[row + 1][column]), d(rings[row + 1][next]);
            mesh.triangles.push_back({a, c, d});
            mesh.triangles.push_back({a, d, b});
        }
        mesh.triangles.push_back(
            {bottom, Vec3(rings[7][next]), Vec3(rings[7][column])});
    }
    return mesh;
}

/// What rays from within are aimed at.
enum Aim { anywhere, edges, vertices, exactly };

/// Rays from within. All origins are made first: in one loop with the directions, g++
/// 12 from -O2 on aims from the doubles that an origin was rounded from, and misses.
std::vector<Ray> rays_from_within(const Mesh& mesh, double size, Aim aim, int count) {
    Numbers n{static_cast<std::uint64_t>(aim) + 1};
    std::vector<Ray> rays(static_cast<std::size_t>(count));
    for (Ray& ray : rays)
        ray.origin = Vec3(mesh.center + 0.5 * size * n.next() * n.direction());
    for (Ray& ray : rays) {
        const Triangle& t = mesh.triangles[static_cast<std::size_t>(
            n.next() * static_cast<double>(mesh.triangles.size()))];
        const Point from(ray.origin);
        const double along = aim == edges ? n.next() : 0;
        const Point target = aim == anywhere
                                 ? from + n.direction()
                                 : glm::mix(Point(t.v1), Point(t.v2), along);
        const Point way_there = target - from;
        ray.direction = Vec3(aim == exactly ? way_there : glm::normalize(way_there));
    }
    return rays;
}

/// The fraction of rays from within that hit no triangle.
template <Way way>
double leaks(const Mesh& mesh, double size, Aim aim, int rays) {
    long lost = 0;
    for (const Ray& ray : rays_from_within(mesh, size, aim, rays)) {
        const auto prepared = prepare<way>(ray);
        lost += std::all_of(
            mesh.triangles.begin(), mesh.triangles.end(),
            [&](const Triangle& x) { return std::isnan(hit<way>(ray, x, prepared)); });
    }
    return static_cast<double>(lost) / rays;
}

/// Nanoseconds a test: the nearest of the triangles of a ball, seen from outside.
template <Way way>
double nanoseconds() {
    const Mesh mesh = dented_ball(1, Point{0});
    Numbers n;
    std::vector<Ray> rays;
    for (int i = 0; i < 512; ++i) {
        const Point origin = 4.0 * n.direction(), aim = 1.1 * n.direction();
        rays.push_back(
            {.origin = Vec3(origin), .direction = Vec3(glm::normalize(aim - origin))});
    }
    const auto tests = static_cast<double>(rays.size() * mesh.triangles.size());
    return examples::nanoseconds_a_call(
        tests,
        [&] {
            float sum = 0;
            for (Ray ray : rays) {
                const auto prepared = prepare<way>(ray);
                for (const Triangle& triangle : mesh.triangles) {
                    const float t = hit<way>(ray, triangle, prepared);
                    if (t < ray.t_max) ray.t_max = t;
                }
                if (ray.t_max < 10) sum += ray.t_max;
            }
            return sum;
        },
        15);
}

/// Table: time and leaks. Plot: leaks of random rays, by the size of the mesh.
void compare(const std::string& folder, int rays) {
    const Mesh mesh = dented_ball(1, Point{100, -100, 100});
    examples::Table table{
        .name = "triangle-trade",
        .columns = {"", "ns", "at edges", "at vertices", "exactly there"},
        .rows = {}};
    const auto row = [&]<Way way>() {
        std::vector<std::string> cells{way_names[way],
                                       examples::text(nanoseconds<way>(), "%.1f")};
        for (const Aim aim : {edges, vertices, exactly}) {
            const Mesh& at = aim == exactly ? dented_ball(1, Point{0}) : mesh;
            const double lost = leaks<way>(at, 1, aim, rays);
            cells.push_back(lost > 0 ? examples::text(100 * lost, "%.2g %%") : "0");
        }
        examples::print_row(cells, 26);
        table.rows.push_back(cells);
    };
    row.operator()<in_float>();
    row.operator()<guarded>();
    row.operator()<glms>();
    row.operator()<in_double>();
    row.operator()<watertight>();
    examples::save_table(folder, table);

    examples::Plot plot{.name = "triangle-small",
                        .columns = {"size of the mesh, in scene units"},
                        .y_label = "random rays that leak out, %",
                        .rows = {},
                        .log_x = true};
    for (const char* name : way_names) plot.columns.emplace_back(name);
    for (int power = -16; power <= 4; ++power) {
        const double size = std::pow(10.0, power / 4.0);
        const Mesh small = dented_ball(size, Point{0});
        const int some = std::max(1, rays / 20);
        plot.rows.push_back({size, 100 * leaks<in_float>(small, size, anywhere, some),
                             100 * leaks<guarded>(small, size, anywhere, some),
                             100 * leaks<glms>(small, size, anywhere, some),
                             100 * leaks<in_double>(small, size, anywhere, some),
                             100 * leaks<watertight>(small, size, anywhere, some)});
    }
    examples::save_plot(folder, plot);
}

// --- Pictures -------------------------------------------------------------------------

/// A vertex of six triangles under the microscope: each cell is one direction, one step
/// of float from its neighbours. Its colour says which triangle is hit; none is white,
/// and where two are hit they are mixed.
template <Way way>
ljus::Image microscope(int cells, int cell_size) {
    const Vec3 hub{0.37f, 0.21f, -3.1f}, from{-0.62f, 0.83f, 1.9f};
    std::array<Vec3, 6> rim;
    for (std::size_t k = 0; k < 6; ++k) {
        const double phi = std::numbers::pi / 3 * (static_cast<double>(k) + 0.2);
        rim[k] = Vec3(Point(hub) +
                      Point{std::cos(phi), std::sin(phi), k % 2 == 0 ? 0.13 : -0.21});
    }
    const ljus::Rgb colors[] = {{0.75f, 0.2f, 0.15f}, {0.15f, 0.3f, 0.65f},
                                {0.7f, 0.5f, 0.1f},   {0.15f, 0.45f, 0.2f},
                                {0.45f, 0.2f, 0.55f}, {0.1f, 0.45f, 0.5f}};
    const Vec3 middle(glm::normalize(Point(hub) - Point(from)));
    const auto stepped = [](float x, int steps) {
        for (; steps > 0; --steps) x = std::nextafter(x, 2.0f);
        for (; steps < 0; ++steps) x = std::nextafter(x, -2.0f);
        return x;
    };
    ljus::Image image = ljus::make_image<float>(cells * cell_size, cells * cell_size);
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const Ray ray{.origin = from,
                          .direction = {stepped(middle.x, i - cells / 2),
                                        stepped(middle.y, cells / 2 - j), middle.z}};
            const auto prepared = prepare<way>(ray);
            ljus::Rgb color{0};
            float hits = 0;
            for (std::size_t k = 0; k < 6; ++k) {
                const Triangle triangle{hub, rim[k], rim[(k + 1) % 6]};
                if (std::isnan(hit<way>(ray, triangle, prepared))) continue;
                color += colors[k], hits += 1;
            }
            for (int y = 0; y < cell_size; ++y)
                for (int x = 0; x < cell_size; ++x)
                    ljus::pixel(image, i * cell_size + x, j * cell_size + y) =
                        hits > 0 ? color / hits : ljus::Rgb{1};
        }
    return image;
}
} // namespace

/// Makes the pictures of a vertex, the plot and the table.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        int cases = 0;
        line.about("Chapter 7, the triangle: rays that slip through, and its table.");
        line.add("--cases", cases, "Rays a cell of the table", 1, 100000000);
        line.without({"--height", "--rays", "--seed", "--threads"});
        const examples::Options options = line.parse(
            {.draft{.width = 480}, .report{.width = 480}, .reference{.width = 960}});
        if (!line.given("--cases")) cases = options.pick(50000, 500000, 5000000);
        const int cells = std::min(48, options.width);
        const int cell = std::max(1, options.width / 48);
        ljus::save_png(microscope<in_float>(cells, cell),
                       options.path("triangle-float.png"));
        ljus::save_png(microscope<in_double>(cells, cell),
                       options.path("triangle-double.png"));
        ljus::save_png(microscope<watertight>(cells, cell),
                       options.path("triangle-watertight.png"));
        compare(options.out, cases);
    });
}
