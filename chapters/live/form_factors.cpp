// Live: the form factor of two patches, in closed form and by chance.
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "ljus/geometry/quad.hpp"
#include "ljus/inspect/estimate.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/radiosity/exchange_area.hpp"
#include "ljus/radiosity/patch_rays.hpp"
#include "ljus/radiosity/patches.hpp"

namespace {

using ljus::Quad, ljus::Vec2, ljus::Vec3;
using Scene = ljus::Scene<ljus::Shapes<Quad>, ljus::Materials<ljus::Lambertian>>;

constexpr int batch = 64; // rays, or pairs of points, of one step
constexpr int most_rays = 128;

/// The floor is a unit square; the other patch is a square that faces it.
struct Figure {
    Quad floor{{-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}};
    Quad other;
    std::optional<ljus::World<Scene>> world; ///< Both of them.
    ljus::Patches patches;
    std::uint32_t to = ljus::no_grid; ///< The other patch, if it is in sight.
    ljus::Estimate rays, pairs;
};
std::unique_ptr<Figure> figure;
std::array<float, 7 * most_rays> lines; // from, to, and whether it arrives

/// The grid of the front of a quad of the scene.
std::uint32_t front_of(const ljus::Patches& patches, std::size_t quad) {
    return patches.grid_of[0][quad][0];
}

ljus::RandomStream stream_of(std::uint64_t step, int i) {
    return random_stream(1, ljus::Pass::user, step, static_cast<std::uint64_t>(i));
}

/// The integrand of the form factor between a point of each patch, times the area.
double by_pair(const Figure& f, Vec2 u, Vec2 v) {
    const auto a = sample_area(f.floor, u), b = sample_area(f.other, v);
    const glm::dvec3 way(b.position - a.position);
    const double r2 = glm::dot(way, way);
    const double here = glm::dot(way, glm::dvec3(a.normal));
    const double there = -glm::dot(way, glm::dvec3(b.normal));
    if (!(here > 0 && there > 0)) return 0;
    return here * there / (std::numbers::pi * r2 * r2) * double(area(f.other));
}

} // namespace

extern "C" {

/// Puts the other patch somewhere, and starts the estimates again.
/// \param x        Of its middle.
/// \param z        Of its middle: the height above the floor.
/// \param degrees  0: it faces down; 90: it is a wall that faces right.
/// \param side     Its length.
[[gnu::used]] void place(double x, double z, double degrees, double side) {
    figure = std::make_unique<Figure>();
    Figure& f = *figure;
    const double angle = degrees * std::numbers::pi / 180;
    const Vec3 y(0, float(side), 0);
    const Vec3 up = float(side) * Vec3(std::cos(angle), 0, std::sin(angle));
    f.other = Quad{Vec3(x, 0, z) - 0.5f * (y + up), y, up};
    Scene scene;
    const auto white = scene.add(ljus::Lambertian{});
    scene.add(f.floor, white);
    scene.add(f.other, white);
    f.world.emplace(std::move(scene));
    f.patches = make_patches(*f.world, {.size = 100});
    const std::uint32_t grid = front_of(f.patches, 1);
    if (grid != ljus::no_grid) f.to = f.patches.grids[grid].first;
}

/// The form factor from the floor to the other patch, in closed form.
[[gnu::used]] double closed_form() {
    return exchange_area(facet_of(figure->floor), facet_of(figure->other));
}
[[gnu::used]] double area_of_other() {
    return double(area(figure->other));
}

/// Some more steps, of 64 rays and 64 pairs of points each.
[[gnu::used]] void more(int steps) {
    Figure& f = *figure;
    const std::uint32_t from = f.patches.grids[front_of(f.patches, 0)].first;
    std::vector<double> row(f.patches.patches.size());
    for (int step = 0; step < steps; ++step) {
        const auto number = static_cast<std::uint64_t>(f.rays.count);
        row.assign(row.size(), 0.0);
        ljus::shoot_rays(*f.world, f.patches, from, batch, number, row);
        add(f.rays, f.to == ljus::no_grid ? 0 : row[f.to]); // area 1
        double sum = 0;
        for (int i = 0; i < batch; ++i) {
            auto stream = stream_of(number, i);
            const Vec2 u = next_2d(stream), v = next_2d(stream);
            sum += by_pair(f, u, v) / batch;
        }
        add(f.pairs, sum);
    }
}
[[gnu::used]] double samples() {
    return batch * figure->rays.count;
}
[[gnu::used]] double mean(int pairs) {
    return pairs ? figure->pairs.mean : figure->rays.mean;
}
[[gnu::used]] double error_of_mean(int pairs) {
    return standard_error(pairs ? figure->pairs : figure->rays);
}

/// Where some rays from the floor go: from, to, 1 if they arrive.
[[gnu::used]] const float* ray_lines(int count) {
    const Figure& f = *figure;
    for (int i = 0; i < count && i < most_rays; ++i) {
        auto stream = stream_of(0, i);
        const auto start = sample_area(f.floor, next_2d(stream));
        const Vec3 way = to_world(ljus::frame_around(start.normal),
                                  ljus::sample_cosine_hemisphere(next_2d(stream)));
        const auto hit = intersect(spawn_ray(start, way), f.other);
        const Vec3 end = start.position + (hit ? hit->t : 1.5f) * way;
        float* const line = &lines[std::size_t(7 * i)];
        for (int k = 0; k < 3; ++k) line[k] = start.position[k], line[3 + k] = end[k];
        line[6] = hit && glm::dot(way, normal(f.other)) < 0 ? 1.0f : 0.0f;
    }
    return lines.data();
}
/// Corner i of the other patch: coordinate k.
[[gnu::used]] double corner(int i, int k) {
    const Quad& q = figure->other;
    const Vec3 at = q.corner + (i == 1 || i == 2 ? q.edge_u : Vec3(0)) +
                    (i == 2 || i == 3 ? q.edge_v : Vec3(0));
    return double(at[k]);
}

[[gnu::used]] int checks() {
    return 12;
}
[[gnu::used]] double check(int i) {
    const int set = i / 3;
    auto kept = std::move(figure); // the page goes on with its own
    place(set == 1 ? -0.5 : 0.2, set == 1 ? 0.5 : 0.8, set == 1 ? 90 : 25 * set,
          set == 3 ? 0.3 : 1);
    if (i % 3 != 0) more(16);
    const double found = i % 3 == 0 ? closed_form() : mean(i % 3 - 1);
    figure = std::move(kept);
    return found;
}

/// The patches and the points on them are in float.
[[gnu::used]] double tolerance() {
    return 1e-6;
}

} // extern "C"
