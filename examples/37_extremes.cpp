// smoke: --quality draft --width 8 --height 8 --rays 1
/// \file 37_extremes.cpp
/// \brief Chapter 37: one room far from the origin, in float and in double.

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// The room of figure 1, moved by a distance along each axis. Its points are computed
/// in double, and rounded to T once.
template <std::floating_point T>
Room<ReportSceneT<T>> room_at(double away) {
    const auto exact = final_room<double>();
    const auto room = final_room<T>();
    const auto& objects = room.world.objects();
    const auto there = [&](const Vec3T<double>& x) { return Vec3T<T>(x + away); };

    ReportSceneT<T> scene;
    const auto add_all = [&](const auto& list) {
        for (const auto& material : list) scene.add(material);
    };
    std::apply([&](const auto&... lists) { (add_all(lists), ...); },
               room.world.materials());
    const auto& [quads, spheres, triangles] = exact.world.shapes();
    for (std::size_t i = 0; i < quads.size(); ++i)
        scene.add(QuadT<T>{there(quads[i].corner), Vec3T<T>(quads[i].edge_u),
                           Vec3T<T>(quads[i].edge_v)},
                  objects[0][i].material, objects[0][i].emission);
    for (std::size_t i = 0; i < spheres.size(); ++i)
        scene.add(SphereT<T>{there(spheres[i].center), T(spheres[i].radius)},
                  objects[1][i].material, objects[1][i].emission);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        scene.add(TriangleT<T>{there(triangles[i].v1), there(triangles[i].v2),
                               there(triangles[i].v3)},
                  objects[2][i].material, objects[2][i].emission);
    CameraT<T> camera = room.camera;
    camera.position = there(exact.camera.position);
    return {World(std::move(scene)), camera};
}

/// Renders the room at five distances, and puts the pictures side by side.
template <std::floating_point T>
Image row_of_rooms(const std::string& name, const examples::Options& options) {
    constexpr int gap = 4;
    Image row = make_image(5 * (options.width + gap) - gap, options.height, Rgb{1});
    int left = 0;
    for (const double away : {1e2, 1e4, 1e5, 1e6, 1e7}) {
        PhotonMappingSettings settings;
        settings.caustics = {.photons = options.pick(2000LL, 50'000LL, 200'000LL),
                             .seed = options.seed,
                             .threads = options.threads};
        settings.caustics_estimate.radius = 0.15f;
        const auto room = room_at<T>(away);
        const PhotonMapper mapper(room.world, settings);
        const auto seen = rendered(name, mapper, room.camera, options);
        for (int y = 0; y < options.height; ++y)
            for (int x = 0; x < options.width; ++x)
                pixel(row, left + x, y) = Rgb(pixel(seen.image, x, y));
        left += options.width + gap;
    }
    return row;
}

} // namespace

/// Renders the room in both precisions.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 37: a room far from the origin, in float and in double.");
        const examples::Options options =
            line.parse({.draft{.width = 48, .height = 48, .samples = 2},
                        .report{.width = 100, .height = 100, .samples = 8},
                        .reference{.width = 160, .height = 160, .samples = 64}});
        save_png(row_of_rooms<float>("float", options),
                 options.path("extremes-float.png"), {.exposure = 0.5});
        save_png(row_of_rooms<double>("double", options),
                 options.path("extremes-double.png"), {.exposure = 0.5});
    });
}
