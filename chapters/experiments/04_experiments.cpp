// smoke: --quality draft --width 16 --height 16 --rays 1 --photons 2000 --truth 2
/// \file chapters/experiments/04_experiments.cpp
/// \brief Chapter 4: the experiments behind its tables and plots: the parts of a
/// picture by their paths, Eq. 1 with and without visibility, and what of an error can
/// be seen.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <ljus/image/flip.hpp>
#include <ljus/image/hdr_flip.hpp>
#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>
#include <ljus/path/light_transport.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/example.hpp"

namespace {

using ljus::Image;
using ljus::OnlyPaths;
using ljus::PathTracer;
using ljus::PhotonMapper;
using ljus::Rgb;
using ljus::Vec3;

/// A picture of the options' size with its own number of rays and seed.
template <typename Renderer>
Image rendered(const std::string& name, const Renderer& renderer,
               const ljus::Camera& camera, const examples::Options& options, int rays,
               std::uint64_t seed) {
    auto settings = examples::picture_settings(options);
    settings.samples = rays;
    settings.seed = seed;
    return examples::rendered(name, renderer, camera, settings, options).image;
}

/// The same, with rays and seed of the options.
template <typename Renderer>
Image rendered(const std::string& name, const Renderer& renderer,
               const ljus::Camera& camera, const examples::Options& options) {
    return examples::rendered(name, renderer, camera, options).image;
}

/// The mean over pixels and channels.
double mean_radiance(const Image& image) {
    double sum = 0;
    for (const Rgb& c : image.pixels) sum += double(c.x + c.y + c.z) / 3;
    return sum / double(image.pixels.size());
}

/// The picture bounce by bounce, and how the light that is left shrinks.
void bounces(const examples::Options& options) {
    const auto room = ljus::cornell_box();
    const PathTracer tracer(room.world, {.roulette_depth = 12});
    examples::Plot plot{.name = "transport-bounces",
                        .columns = {"bounces", "mean radiance", "halved each time"},
                        .y_label = "W/(m^2 sr)",
                        .log_y = true};
    std::string words = "E";
    for (int bounce = 0; bounce <= 10; ++bounce) {
        const std::string paths = words + "L";
        const Image part =
            rendered("bounces", OnlyPaths(tracer, paths), room.camera, options);
        if (bounce <= 4)
            save_png(part, options.path("bounce-" + std::to_string(bounce) + ".png"),
                     {.exposure = 1});
        const double first =
            plot.rows.size() < 2 ? mean_radiance(part) : plot.rows[1][1];
        plot.rows.push_back(
            {double(bounce), mean_radiance(part),
             bounce == 0 ? std::nan("") : first * std::exp2(1 - bounce)});
        words += ".";
    }
    save_plot(options.path(""), plot);
}

/// What each way of rendering leaves out: the same picture, cut down to its paths.
void truncations(const examples::Options& options) {
    struct Kind {
        const char *letters, *file;
    };
    constexpr Kind kinds[] = {
        {"ED?L", "casting"},   {"ES*D?L", "whitted"},  {"ES*DS+L", "caustics"},
        {"ED*L", "radiosity"}, {"ES*D*L", "two-pass"}, {"E(S|D)*L", "all"},
    };
    const auto room = ljus::cornell_box();
    const PathTracer tracer(room.world);
    for (const Kind& kind : kinds)
        save_png(rendered(kind.letters, OnlyPaths(tracer, kind.letters), room.camera,
                          options),
                 options.path(std::string("paths-") + kind.file + ".png"));
}

/// A room with only diffuse surfaces: walls, two balls, a lamp.
auto matt_room() {
    ljus::Scene<ljus::Shapes<ljus::Quad, ljus::Sphere>,
                ljus::Materials<ljus::Lambertian>>
        scene;
    ljus::add_cornell_walls(scene);
    const auto grey = scene.add(ljus::Lambertian{.albedo = Rgb{0.7f}});
    const auto blue = scene.add(ljus::Lambertian{.albedo{0.2f, 0.35f, 0.7f}});
    scene.add(ljus::Sphere{.center{-0.42f, 0.38f, -0.3f}, .radius = 0.38f}, blue);
    scene.add(ljus::Sphere{.center{0.42f, 0.38f, 0.3f}, .radius = 0.38f}, grey);
    const auto black = scene.add(ljus::Lambertian{.albedo = Rgb{0}});
    scene.add(ljus::Quad{.corner{-0.25f, 1.99f, -0.25f},
                         .edge_u{0.5f, 0, 0},
                         .edge_v{0, 0, 0.5f}},
              black, Rgb{17, 13, 8});
    return ljus::World(std::move(scene));
}
using MattRoom = decltype(matt_room());

/// The first bounce of Eq. 1, integrated over the area of the lamp: light from points
/// x'' of the lamp, which x' sends on to the eye.
struct AreaForm {
    using Stream = ljus::RandomStream;
    const MattRoom& world;
    bool visibility = true; ///< False: the g of the report, 1/r^2.
};

template <typename Context>
Rgb radiance(const AreaForm& form, const ljus::Ray& ray, Context& context) {
    const auto hit = closest_hit(form.world, ray);
    if (!hit) return Rgb{0};
    const auto here = vertex_at(form.world, ray, *hit);
    const ljus::Quad& lamp = std::get<0>(form.world.shapes()).back();
    const ljus::SurfacePoint there = sample_area(lamp, next_2d(context.stream));
    const Vec3 way = there.position - here.point.position;
    const float squared = glm::dot(way, way);
    const float g =
        form.visibility ? transport_factor(form.world, here.point, there) : 1 / squared;
    const Vec3 w = way / std::sqrt(squared);
    const float cosines = std::max(glm::dot(here.frame.normal, w), 0.0f) *
                          std::max(-glm::dot(there.normal, w), 0.0f);
    const Rgb albedo = form.world.visit_material(
        here.object.material, [](const ljus::Lambertian& m) { return m.albedo; });
    const float pi = 3.14159265f;
    return here.object.emission +
           albedo / pi * Rgb{17, 13, 8} * cosines * g * float(area(lamp));
}

ljus::Camera box_camera() {
    return ljus::look_at({.position{0, 1, 4.4f}, .target{0, 1, 0}, .vfov_degrees = 33});
}

/// Direct light with the g of Kajiya and with the g of the report.
void visibility(const examples::Options& options) {
    const auto room = matt_room();
    for (const bool seen : {true, false})
        save_png(rendered("visibility", AreaForm{room, seen}, box_camera(), options),
                 options.path(seen ? "g-visible.png" : "g-report.png"));
}

/// A map of FLIP as a picture: black where no difference is visible, white from 1/3 on.
void save_flip_map(const Image& image, const Image& truth, const std::string& path) {
    auto map = flip_map(image, truth);
    for (auto& c : map.pixels)
        c = ljus::RgbT<double>(ljus::srgb_decode(3 * c.x)); // grey in proportion
    save_png(map, path);
}

/// Footnote 1: renderers that simulate and renderers that emulate, by how wrong they
/// are and by how wrong they look.
void emulate(const examples::Options& options, long long photons, int truth_rays) {
    const auto room = matt_room();
    const auto camera = box_camera();
    const PathTracer tracer(room);
    const Image truth =
        rendered("truth", tracer, camera, options, truth_rays, options.seed + 1000);
    examples::Table table{
        .name = "transport-emulate",
        .columns = {"renderer", "seconds", "relMSE", "blocks", "FLIP", "HDR-FLIP"}};
    const auto take = [&](const std::string& name, const std::string& file,
                          const auto& make) {
        const examples::StopWatch watch;
        const Image image = make();
        const double seconds = watch.seconds();
        table.rows.push_back({name, examples::text(seconds, "%.2f"),
                              examples::text(rel_mse(image, truth), "%.5f"),
                              examples::text(block_error(image, truth), "%.6f"),
                              examples::text(flip(image, truth), "%.4f"),
                              examples::text(hdr_flip(image, truth), "%.4f")});
        if (file.empty()) return;
        save_png(image, options.path(file + ".png"));
        save_flip_map(image, truth, options.path(file + "-flip.png"));
    };
    for (const int rays : {4, 16, 64, 256}) {
        if (8 * rays > truth_rays) break; // it would see the truth's own noise
        take(std::to_string(rays) + " paths", rays == 16 ? "emulate-paths" : "", [&] {
            return rendered("paths", tracer, camera, options, rays, options.seed);
        });
    }
    for (const long long count : {photons / 100, photons / 10, photons}) {
        const auto shoot = [&](ljus::IndirectLight indirect, int rays) {
            const ljus::PhotonMappingSettings settings{
                .shadow_rays = indirect == ljus::IndirectLight::photons ? 4 : 1,
                .indirect = indirect,
                .general{.photons = count, .seed = options.seed},
                .general_estimate{.radius = 0.25f}};
            return rendered("photons", PhotonMapper(room, settings), camera, options,
                            rays, options.seed);
        };
        const std::string many = std::to_string(count);
        take(many + " photons", count == photons ? "emulate-photons" : "",
             [&] { return shoot(ljus::IndirectLight::photons, 4); });
        if (count == photons)
            take(many + " behind a bounce", "emulate-gather",
                 [&] { return shoot(ljus::IndirectLight::map, 16); });
    }
    save_table(options.path(""), table);
    for (const auto& row : table.rows)
        std::printf("%-44s %6s s  relMSE %s  blocks %s  FLIP %s  HDR %s\n",
                    row[0].c_str(), row[1].c_str(), row[2].c_str(), row[3].c_str(),
                    row[4].c_str(), row[5].c_str());
}

} // namespace

/// Makes the chapter's tables, plots, and their pictures.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 0;
        int truth = 0;
        line.about("Chapter 4: pictures by their classes of paths, and FLIP.");
        line.add("--photons", photons, "Of each map; 0: by the quality", 0, 100000000);
        line.add("--truth", truth, "Rays per pixel of the truth; 0: by the quality", 0,
                 1000000);
        const examples::Options options =
            line.parse({.draft{.width = 96, .height = 96, .samples = 9},
                        .report{.width = 400, .height = 400, .samples = 64},
                        .reference{.width = 400, .height = 400, .samples = 1024}});
        if (photons == 0) photons = options.pick(30000LL, 300000LL, 3000000LL);
        if (truth == 0) truth = options.pick(512, 2048, 65536);
        bounces(options);
        truncations(options);
        visibility(options);
        emulate(options, photons, truth);
    });
}
