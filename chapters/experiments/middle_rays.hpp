#pragma once

/// \file chapters/experiments/middle_rays.hpp
/// \brief A picture of one ray a pixel, through its middle: what aliasing looks like.

#include "ljus/render/render.hpp"

namespace examples {

/// Renders without any randomness.
/// \param renderer  One that draws no random numbers.
/// \param camera    Where it stands.
/// \param width     In pixels.
/// \param height    In pixels.
template <typename Renderer>
[[nodiscard]] ljus::Image by_middle_rays(const Renderer& renderer,
                                         const ljus::Camera& camera, int width,
                                         int height) {
    auto image = ljus::make_image(width, height);
    ljus::Counts counts;
    ljus::RandomStream none;
    auto context = ljus::context_of(none, counts);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const ljus::Vec2 middle{float(x) + 0.5f, float(y) + 0.5f};
            const ljus::Ray ray = primary_ray(camera, middle, width, height);
            pixel(image, x, y) = radiance(renderer, ray, context);
        }
    return image;
}

} // namespace examples
