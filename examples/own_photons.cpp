/// \file own_photons.cpp
/// \brief Renders the light in a cup by photons that the program traces and stores
/// itself.
// runs in the folder of its picture

#include <ljus/io/png.hpp>
#include <ljus/math/random.hpp>
#include <ljus/math/sampling.hpp>
#include <ljus/optics/reflection.hpp>

#include "own_photons.hpp"

namespace {

using ljus::Vec3, reader::OwnPhoton;

/// The distance at which a ray within the cup meets the wall x^2 + y^2 = 1.
float to_wall(const Vec3& from, const Vec3& d) {
    const float a = d.x * d.x + d.y * d.y, b = from.x * d.x + from.y * d.y;
    const float c = from.x * from.x + from.y * from.y - 1;
    return (std::sqrt(b * b - a * c) - b) / a;
}

/// Traces the photons of a lamp that lights the opening of the cup, at z = 0.8, evenly.
/// Photons arrive on the floor, at z = 0, directly or from the wall, which is a mirror.
std::vector<OwnPhoton> trace(int count) {
    const Vec3 lamp{1.6f, 0, 1.6f};
    const float flux = 10.0f / float(count); // W
    std::vector<OwnPhoton> photons;
    for (int i = 0; i < count; ++i) {
        auto stream = ljus::random_stream(1, ljus::Pass::user, 0, std::uint64_t(i));
        const ljus::Vec2 disc = ljus::sample_concentric_disc(ljus::next_2d(stream));
        Vec3 from{disc.x, disc.y, 0.8f}; // a point of the opening
        Vec3 d = glm::normalize(from - lamp);
        for (int bounces = 0; bounces < 10; ++bounces) {
            const float floor = -from.z / d.z, wall = to_wall(from, d);
            if (floor < wall) {
                photons.push_back({from + floor * d, d, ljus::Rgb{flux}, bounces});
                break;
            }
            from = from + wall * d;
            d = ljus::reflect(d, Vec3{-from.x, -from.y, 0});
            from = from + 1e-4f * d;
        }
    }
    return photons;
}

} // namespace

/// Draws the floor into own_photons.png: direct light blue, reflected light orange.
int main() {
    const reader::OwnMap map(trace(400000));
    ljus::Image image = ljus::make_image(300, 300);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Vec3 at{(float(x) - 149.5f) / 150, (149.5f - float(y)) / 150, 0};
            if (glm::length(at) > 1) continue;
            for (const int bounces : {0, 1, 2}) {
                const ljus::Rgb color = bounces == 0 ? ljus::Rgb{0.05f, 0.07f, 0.1f}
                                                     : ljus::Rgb{0.12f, 0.08f, 0.03f};
                pixel(image, x, y) +=
                    color * irradiance(map, at, {0, 0, 1}, 0.03f, bounces);
            }
        }
    save_png(image, "own_photons.png");
}
