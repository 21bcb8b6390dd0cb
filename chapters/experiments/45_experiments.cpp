// smoke: --quality draft
/// \file chapters/experiments/45_experiments.cpp
/// \brief Chapter 45: how a picture is looked up, against the noise of other things.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <ljus/ljus.hpp>
#include <ljus/materials/textured.hpp>
#include <ljus/render/path_tracing.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

constexpr int wide = 64, high = 32;

/// A picture of 8 by 8 fields, black and white.
UvPicture fields() {
    UvPicture picture{.image = make_image<float>(64, 64)};
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            pixel(picture.image, x, y) = Rgb{(x / 8 + y / 8) % 2 == 0 ? 1.0f : 0.0f};
    return picture;
}

/// The picture in sizes of 64, 32, ... 1 pixels, each the means of four of the one
/// before.
std::vector<UvPicture> pyramid_of(const UvPicture& picture) {
    std::vector<UvPicture> levels{picture};
    for (int size = picture.image.width / 2; size > 0; size /= 2) {
        const Image& fine = levels.back().image;
        Image coarse = make_image<float>(size, size);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                pixel(coarse, x, y) =
                    0.25f *
                    (pixel(fine, 2 * x, 2 * y) + pixel(fine, 2 * x + 1, 2 * y) +
                     pixel(fine, 2 * x, 2 * y + 1) + pixel(fine, 2 * x + 1, 2 * y + 1));
        levels.push_back({.image = coarse});
    }
    return levels;
}

/// The colour of the two sizes whose pixels are nearest to a width on the surface.
Rgb looked_up(const std::vector<UvPicture>& levels, const Vec2& uv, float width) {
    const float level =
        std::clamp(std::log2(width * 64), 0.0f, float(levels.size()) - 1.001f);
    const auto below = static_cast<std::size_t>(level);
    return glm::mix(color_at(levels[below], Vec3{0}, uv),
                    color_at(levels[below + 1], Vec3{0}, uv), level - float(below));
}

/// A floor to the horizon, seen from a height of 1: each pixel the mean of `rays`
/// lookups, color_of(uv, width of a pixel on the floor).
template <typename ColorOf>
std::vector<double> floor_by(int rays, std::uint64_t seed, ColorOf color_of) {
    std::vector<double> picture;
    for (int y = 0; y < high; ++y)
        for (int x = 0; x < wide; ++x) {
            auto stream = random_stream(seed, Pass::user, std::uint64_t(rays),
                                        std::uint64_t(y * wide + x));
            double sum = 0;
            for (int i = 0; i < rays; ++i) {
                const Vec2 at = Vec2{x, y} + next_2d<float>(stream);
                const float down = 0.02f + at.y / float(high); // slope of the ray
                const Vec2 uv{(at.x / float(wide) - 0.5f) / down, 1 / down};
                const float along = uv.y * uv.y / float(high); // of a pixel's height
                sum += double(color_of(0.5f * uv, 0.5f * along).x);
            }
            picture.push_back(sum / rays);
        }
    return picture;
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / double(a.size()));
}

/// A grey floor with the soft shadow of a ball.
std::vector<double> lit_floor(int rays, std::uint64_t seed) {
    Scene<Shapes<Quad, Sphere>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.5f}});
    scene.add(Quad{{-20, 0, 4}, {40, 0, 0}, {0, 0, -40}}, grey);
    scene.add(Sphere{{0, 1, -3}, 0.8f}, grey);
    scene.add(Quad{{-2, 5, -5}, {4, 0, 0}, {0, 0, 4}}, grey, Rgb{6});
    const World world(std::move(scene));
    const Camera camera =
        look_at({.position{0, 1, 3}, .target{0, 0.1f, -2}, .vfov_degrees = 40});
    const auto image =
        render(PathTracer(world, {.max_depth = 1}), camera,
               {.width = wide, .height = high, .samples = rays, .seed = seed})
            .image;
    std::vector<double> picture;
    for (const Rgb& color : image.pixels) picture.push_back(double(color.x));
    return picture;
}

/// Table: the error of the mean of some rays.
void tabulate_noise(const examples::Options& options, int reference) {
    const UvPicture smooth = fields();
    UvPicture hard = smooth;
    hard.filter = PictureFilter::nearest;
    const auto levels = pyramid_of(smooth);
    const auto nearest = [&](const Vec2& uv, float) {
        return color_at(hard, Vec3{0}, uv);
    };
    const auto bilinear = [&](const Vec2& uv, float) {
        return color_at(smooth, Vec3{0}, uv);
    };
    const auto filtered = [&](const Vec2& uv, float width) {
        return looked_up(levels, uv, width);
    };
    const auto right = floor_by(reference, 1, bilinear);
    const auto lit = lit_floor(reference, 1);
    examples::Table table{.name = "textures-noise",
                          .columns = {"rays per pixel", "nearest", "bilinear",
                                      "pyramid", "a soft shadow"}};
    for (const int rays : {1, 4, 16, 64}) {
        const auto error = [&](const auto& picture, const auto& truth) {
            return examples::text(apart(picture, truth), "%.3f");
        };
        table.rows.push_back({std::to_string(rays),
                              error(floor_by(rays, 2, nearest), right),
                              error(floor_by(rays, 2, bilinear), right),
                              error(floor_by(rays, 2, filtered), right),
                              error(lit_floor(rays, 2), lit)});
    }
    examples::print_table(table);
    examples::save_table(options.path(""), table);
}

} // namespace

/// Makes the chapter's table.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 45, textures: filters.");
        const examples::Options options = line.parse({});
        tabulate_noise(options, options.pick(64, 4096, 4096));
    });
}
