// smoke: --quality draft --photons 500 --width 60
/// \file 24_kd_tree.cpp
/// \brief Chapter 24: the points that a search in a k-d tree visits, on a floor seen
/// from above.

#include <algorithm>
#include <cstdio>
#include <span>
#include <vector>

#include <ljus/accel/kd_tree.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// The positions of photons on the floor of the report's room, with the caustic of its
/// glass ball.
std::vector<Vec3> on_floor(long long photons, std::uint64_t seed) {
    const auto room = final_room();
    std::vector<Vec3> points;
    const auto add = [&](MapType type, long long count) {
        const auto traced =
            trace_photons(room.world, type,
                          {.photons = count, .seed = seed, .shadow_photons = false});
        for (const Photon& photon : traced.photons)
            if (photon.normal.z > 120) points.push_back(photon.position); // 127 is up
    };
    add(MapType::general, photons);
    add(MapType::caustics, 2 * photons);
    float floor = 1e30f;
    for (const Vec3& p : points) floor = std::min(floor, p.z);
    std::erase_if(points, [&](const Vec3& p) { return p.z > floor + 1e-3f; });
    return points;
}

} // namespace

/// Makes kd_tree-search.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 0;
        line.about("Chapter 24, the k-d tree: what a search looks at.");
        line.add("--photons", photons, "Photons emitted", 1, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 480, .height = 480, .samples = 1}});
        if (!line.given("--photons")) photons = options.pick(6000LL, 12000LL, 20000LL);
        const std::vector<Vec3> points = on_floor(photons, options.seed);
        if (points.empty()) return;

        // The floor seen from above; the picture is as wide as the area with photons.
        Vec3 low = points[0], high = points[0];
        for (const Vec3& p : points) low = glm::min(low, p), high = glm::max(high, p);
        const float scale =
            float(options.width - 1) / std::max(high.x - low.x, 1e-6f); // per unit
        Image image = make_image(options.width, int(scale * (high.y - low.y)) + 1);
        const auto dot = [&](const Vec3& p, const Rgb& color) {
            const int right = image.width - 1, bottom = image.height - 1;
            const int x = std::clamp(int(scale * (p.x - low.x)), 0, right);
            const int y = std::clamp(int(scale * (p.y - low.y)), 0, bottom);
            pixel(image, x, y) = pixel(image, std::min(x + 1, right), y) =
                pixel(image, x, std::min(y + 1, bottom)) = color;
        };
        for (const Vec3& p : points) dot(p, Rgb{0.15f});

        // A search for the 400 nearest photons. The walk calls one function with each
        // photon whose distance it computes, and another one to ask whether a box at
        // some distance can hold a nearer photon.
        const KdTree tree{std::span<const Vec3>(points)};
        const Vec3 center =
            low +
            Vec3(0.4f * float(image.width), 0.55f * float(image.height), 0) / scale;
        std::vector<Neighbor> found(std::min<std::size_t>(400, points.size()));
        Nearest best{.found = found, .limit2 = 1e30};
        std::size_t computed = 0;
        tree.walk(
            center,
            [&](std::uint32_t index, double distance2) {
                ++computed;
                dot(tree.points()[index], Rgb{0.7f, 0.25f, 0.02f});
                if (best.reaches(distance2)) best.take({distance2, index});
            },
            [&](double distance2) { return best.reaches(distance2); });
        for (const Neighbor& one : found)
            dot(tree.points()[one.index], Rgb{0.4f, 0.8f, 1.0f});
        save_png(image, options.path("kd_tree-search.png"));
        if (!options.quiet)
            std::printf("the %zu nearest of %zu photons: %zu distances computed\n",
                        found.size(), points.size(), computed);
    });
}
