#pragma once

/// \file ljus/inspect/photon_dots.hpp
/// \brief Photons as dots over a drawing of their scene.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ljus/image/image.hpp"
#include "ljus/materials/material.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/photons/photon.hpp"
#include "ljus/scene/camera.hpp"

namespace ljus {

/// \defgroup photon_dots Photons as dots
/// \brief Drawings of photons, as in figures 5 to 8 in Section 3.2.2 of the report.
/// \{

/// The size and the brightness of a dot. The brightness falls linearly from the middle
/// to the edge. The size does not depend on the distance of the photon.
struct PhotonDotSettings {
    float radius = 1.0f;     ///< Radius of the dot in pixels, in (0, 1000].
    float brightness = 0.8f; ///< Brightness in the middle; overlapping dots add up.
};

/// A background for photons: the colours of the surfaces without lighting, darkened at
/// grazing angles. Mirrors and glass are grey, and lamps are bright.
/// \throws std::invalid_argument  if the width or the height is below 1.
/// \cost One ray per pixel.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] ImageT<T> scene_drawing(const W& world, const CameraT<T>& camera,
                                      int width, int height) {
    ImageT<T> image = make_image<T>(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Vec2T<T> middle{T(x) + T(0.5), T(y) + T(0.5)};
            const RayT<T> ray = primary_ray(camera, middle, width, height);
            const auto hit = closest_hit(world, ray);
            if (!hit) continue;
            const VertexT<T> vertex = vertex_at(world, ray, *hit);
            const Vec3T<T>& wo = vertex.wo;
            const auto own_color = [&](const auto& material) {
                if (has(lobes(material), Lobes::specular)) return RgbT<T>{T(0.25)};
                return RgbT<T>(evaluate(material, wo, wo) * std::numbers::pi_v<T>);
            };
            pixel(image, x, y) = vertex.emits()
                                     ? RgbT<T>{T(0.5)}
                                     : T(0.16) * (T(0.3) + T(0.7) * std::abs(wo.z)) *
                                           visit_material_at(world, vertex, own_color);
        }
    return image;
}

/// The colour of a photon's dot: the colour of its flux, scaled to full brightness.
/// Shadow photons are yellow, as in the report's program.
/// \return Linear RGB, its largest channel 1; black if there is no flux.
template <std::floating_point T>
[[nodiscard]] RgbT<T> dot_color(const PhotonT<T>& photon) noexcept {
    if (photon.kind == PhotonKind::shadow) return {T(1), T(0.8), T(0.1)};
    const T largest = max_component(photon.flux);
    return largest > T(0) ? photon.flux / largest : RgbT<T>{T(0)};
}

/// The position of a photon in the picture, in pixels from the upper left corner.
/// Nothing if the photon is outside the picture, not on a surface, on the side of its
/// surface that does not face the camera, or occluded, even by glass. An occluder
/// counts only if it is nearer than the photon by more than a thousandth of the
/// distance.
/// \cost One ray.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<Vec2T<T>>
photon_in_sight(const W& world, const CameraT<T>& camera, const PhotonT<T>& photon,
                int width, int height) {
    const auto place = project(camera, photon.position, width, height);
    if (!place || !(place->x >= T(0) && place->x < T(width) && place->y >= T(0) &&
                    place->y < T(height)))
        return std::nullopt;
    const RayT<T> ray{.origin = camera.position,
                      .direction = photon.position - camera.position};
    const auto hit = closest_hit(world, ray);
    if (!hit || std::abs(hit->at.t - T(1)) > T(1e-3)) return std::nullopt;
    const Vec3T<T> normal = vertex_at(world, ray, *hit).point.normal;
    if (photon_side(photon.direction, normal) != photon_side(ray.direction, normal))
        return std::nullopt;
    return place;
}

namespace detail {

template <std::floating_point T>
void add_dot(ImageT<T>& image, const Vec2T<T>& place, const RgbT<T>& color,
             const PhotonDotSettings& look) {
    const T radius = T(look.radius);
    const auto first = [&](T at) { return std::max(0, int(std::floor(at - radius))); };
    const auto last = [&](T at, int size) {
        return std::min(size - 1, int(std::floor(at + radius)));
    };
    for (int y = first(place.y); y <= last(place.y, image.height); ++y)
        for (int x = first(place.x); x <= last(place.x, image.width); ++x) {
            const T distance =
                std::hypot(T(x) + T(0.5) - place.x, T(y) + T(0.5) - place.y);
            const T cone = std::max(T(0), T(1) - distance / radius);
            pixel(image, x, y) += T(look.brightness) * cone * color;
        }
}

} // namespace detail

/// Draws photons over a picture of their scene, such as one made by scene_drawing().
/// The function `color`, such as dot_color(), returns the colour of a photon's dot. A
/// photon with a black dot is skipped.
/// \return The number of photons that were drawn.
/// \throws std::invalid_argument  if the radius of a dot is not in (0, 1000].
/// \cost One ray per photon within the picture whose dot is not black.
/// \report{Section 3.2.2, Figs. 5 to 8}
template <AnyWorld W, std::floating_point T, typename Color>
long long add_photon_dots(ImageT<T>& image, const W& world, const CameraT<T>& camera,
                          const std::vector<PhotonT<T>>& photons,
                          const PhotonDotSettings& look, Color color) {
    require(look.radius > 0 && look.radius <= 1000, "the radius of a dot", look.radius,
            "above 0 and at most 1000 pixels");
    long long seen = 0;
    for (const PhotonT<T>& photon : photons) {
        const RgbT<T> tip = color(photon);
        if (is_black(tip)) continue;
        const auto place =
            photon_in_sight(world, camera, photon, image.width, image.height);
        if (!place) continue;
        detail::add_dot(image, *place, tip, look);
        ++seen;
    }
    return seen;
}

/// \}

} // namespace ljus
