// smoke: --quality draft --width 32 --height 20 --rays 1
/// \file 47_both_ends.cpp
/// \brief Chapter 47: the contributions of four strategies to a caustic in front of a
/// mirror.

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <ljus/ljus.hpp>
#include <ljus/render/vertex_merging.hpp>

#include "common/example.hpp"

using namespace ljus;

/// The strategies of a VertexMerger, by the names of its terms.
constexpr std::array names{"emission", "shadow ray", "connection", "merging"};

/// A log that adds up the terms of each strategy.
struct TermLog {
    std::array<Rgb, names.size()> sums{}; ///< One sum for each of `names`.

    /// Ignores the start of a path.
    void begin() noexcept {}
    /// Ignores a vertex.
    void vertex(char, const Vec3&, const Rgb&, float) noexcept {}
    /// Adds a term.
    void term(std::string_view owner, std::string_view, const Rgb& value) noexcept {
        for (std::size_t i = 0; i < names.size(); ++i)
            if (owner == names[i]) sums[i] += value;
    }
};

/// A room with a glass ball in front of a mirror, lit by a small lamp.
auto mirror_room() {
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass, Mirror>> room;
    const auto white = room.add(Lambertian{.albedo = Rgb{0.7f}});
    const auto red = room.add(Lambertian{.albedo{0.6f, 0.12f, 0.08f}});
    const auto blue = room.add(Lambertian{.albedo{0.15f, 0.25f, 0.6f}});
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    const auto mirror = room.add(Mirror{.reflectance = Rgb{0.9f}});
    room.add(Quad{{-2, 0, 4}, {4, 0, 0}, {0, 0, -6}}, white); // floor
    room.add(Quad{{-2, 3, -2}, {4, 0, 0}, {0, 0, 6}}, white); // ceiling
    room.add(Quad{{-2, 0, -2}, {4, 0, 0}, {0, 3, 0}}, white); // back
    room.add(Quad{{2, 0, 4}, {-4, 0, 0}, {0, 3, 0}}, white);  // front
    room.add(Quad{{-2, 0, 4}, {0, 0, -6}, {0, 3, 0}}, red);   // left
    room.add(Quad{{2, 0, -2}, {0, 0, 6}, {0, 3, 0}}, blue);   // right
    room.add(Quad{{-1.6f, 0.05f, -1.9f}, {3.2f, 0, 0}, {0, 2, 0}}, mirror);
    room.add(Sphere{{-0.05f, 0.75f, -0.4f}, 0.4f}, room.add(Glass{}));
    room.add(Sphere{{-1.1f, 0.3f, -0.4f}, 0.3f}, white);
    room.add(Sphere{{-1.3f, 2.4f, 0.6f}, 0.05f}, black, Rgb{900, 850, 760});
    return World(std::move(room));
}

/// Renders both_ends-room.png and a picture of each strategy.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 47, both ends: a caustic seen in a mirror.");
        const examples::Options options =
            line.parse({.draft{.width = 200, .height = 125, .samples = 4},
                        .report{.width = 320, .height = 200, .samples = 2},
                        .reference{.width = 800, .height = 500, .samples = 2}});
        const auto world = mirror_room();
        const Camera camera = look_at(
            {.position{0.3f, 1.9f, 3.7f}, .target{0.1f, 0.6f, -1}, .vfov_degrees = 38});

        const int passes = options.pick(1, 16, 500);
        std::vector<Image> shares(names.size(),
                                  make_image(options.width, options.height));
        examples::ProgressBar bar("passes", options.quiet);
        double shrink = 1; // squared factor of the radius
        for (int pass = 1; pass <= passes; ++pass) {
            const VertexMerger merger(world,
                                      {.paths = options.pick(20000, 40000, 60000),
                                       .radius = 0.03f * float(std::sqrt(shrink)),
                                       .seed = options.seed,
                                       .iteration = std::uint64_t(pass),
                                       .threads = options.threads});
            auto picture = picture_settings(options);
            picture.seed += std::uint64_t(pass);
            const PictureRays rays(picture);
            const auto row = [&](long long y) {
                Counts counts;
                for (int x = 0; x < picture.width; ++x) {
                    TermLog log;
                    for (int i = 0; i < picture.samples; ++i)
                        (void)trace_pixel(merger, camera, rays, {x, int(y), i}, counts,
                                          log);
                    for (std::size_t k = 0; k < names.size(); ++k)
                        pixel(shares[k], x, int(y)) +=
                            log.sums[k] / float(passes * picture.samples);
                }
            };
            parallel_blocks(picture.height, row, {.threads = options.threads});
            shrink *= (pass + 2.0 / 3) / (pass + 1);
            bar(pass, passes);
            examples::stop_if_asked();
        }
        auto whole = make_image(options.width, options.height);
        for (std::size_t k = 0; k < names.size(); ++k) {
            for (std::size_t p = 0; p < whole.pixels.size(); ++p)
                whole.pixels[p] += shares[k].pixels[p];
            const std::string name(names[k]);
            save_png(shares[k], options.path("both_ends-" +
                                             name.substr(0, name.find(' ')) + ".png"));
        }
        save_png(whole, options.path("both_ends-room.png"));
    });
}
