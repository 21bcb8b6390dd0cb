#pragma once

/// \file flatland/light.hpp
/// \brief Lamps of the plane: their flux, shadow rays to them, and photons that they
/// emit.

#include "flatland/path.hpp"

namespace flatland {

// Sections 3.2.2 and 3.2.3 in the plane: light falls off as 1/r, like the angle that a
// lamp covers.

/// The flux of an object, in W: the radiance times 2, which is the integral of the
/// cosine over the half circle, times the length. In space it is the radiance times pi
/// times the area.
/// \param object  The object.
[[nodiscard]] inline double flux(const Object& object) {
    return 2 * object.emission * length(object.shape);
}

/// The flux of all objects, in W.
/// \param scene  The scene.
[[nodiscard]] inline double flux(const Scene& scene) {
    double sum = 0;
    for (const Object& object : scene.objects) sum += flux(object);
    return sum;
}

/// The radiance of a circular lamp with a given flux.
/// \param circle  The lamp.
/// \param flux    The flux, W.
/// \return The radiance, W/(m rad).
[[nodiscard]] inline double radiance_of(const Circle& circle, double flux) noexcept {
    return flux / (2 * length(circle));
}

/// A point of a segment, uniform over its length.
/// \param segment  The segment.
/// \param u        In [0, 1).
[[nodiscard]] inline SurfacePoint sample_point(const Segment& segment,
                                               double u) noexcept {
    const Vec2 position = segment.from + u * (segment.to - segment.from);
    return {position, normal(segment, position)};
}

/// A point of a circle, uniform over its length.
/// \param circle  The circle.
/// \param u       In [0, 1).
[[nodiscard]] inline SurfacePoint sample_point(const Circle& circle,
                                               double u) noexcept {
    const double angle = 2 * std::numbers::pi * u;
    const Vec2 out{std::cos(angle), std::sin(angle)};
    return {circle.center + circle.radius * out, out};
}

/// A point of a lamp, and the probability of that lamp.
struct LampPoint {
    SurfacePoint point{};   ///< A point, uniform over the length of the lamp.
    double probability = 0; ///< Probability of the lamp: its fraction of all flux; 0
                            ///< without lamps.
    const Object* lamp = nullptr; ///< The lamp in the scene.
};

/// Chooses a lamp in proportion to its flux, and a point of it.
/// \param scene  The scene.
/// \param u      Chooses the lamp, and the point on it.
/// \return The point; a null lamp if nothing emits.
[[nodiscard]] inline LampPoint sample_lamp(const Scene& scene, const Vec2& u) {
    const double all = flux(scene);
    double left = u.x * all;
    LampPoint chosen;
    for (const Object& object : scene.objects) {
        const double own = flux(object);
        if (!(own > 0)) continue;
        chosen.lamp = &object; // rounding may leave a rest for the last lamp
        chosen.probability = own / all;
        left -= own;
        if (left < 0) break;
    }
    if (chosen.lamp != nullptr)
        chosen.point = std::visit([&](const auto& s) { return sample_point(s, u.y); },
                                  chosen.lamp->shape);
    return chosen;
}

/// The density per angle with which an observer sees a point of a lamp that is uniform
/// over the length.
/// \param from    The position of the observer.
/// \param point   The point of the lamp.
/// \param length  The length of the lamp.
/// \return distance / (|cos| length), per radian. In space the distance is squared.
/// \report{Section 3.2.3}
// [pdf from length]
[[nodiscard]] inline double pdf_from_length(const Vec2& from, const SurfacePoint& point,
                                            double length) noexcept {
    const Vec2 way = point.position - from;
    const double distance = glm::length(way);
    const double cosine = std::abs(glm::dot(way, point.normal)) / distance;
    return distance / (cosine * length);
}
// [pdf from length]

/// The radiance that a vertex reflects along its `wo` from a random point of a lamp.
/// \param scene   The scene.
/// \param vertex  A point of a surface.
/// \param u       Chooses the point of the lamp.
/// \return Radiance, W/(m rad); its mean is the direct light.
/// \report{Section 3.2.3}
[[nodiscard]] inline double direct_light(const Scene& scene, const Vertex& vertex,
                                         const Vec2& u) {
    const LampPoint chosen = sample_lamp(scene, u);
    if (chosen.lamp == nullptr) return 0;
    const Vec2& from = vertex.point.position;
    const Vec2 way = chosen.point.position - from;
    if (!(glm::dot(way, chosen.point.normal) < 0)) return 0; // the back of the lamp
    const Vec2 wi = to_local(vertex.point.normal, glm::normalize(way));
    const double f = evaluate(vertex.object.material, vertex.wo, wi);
    if (f == 0 || occluded(scene, from, chosen.point.position)) return 0;
    const double pdf = chosen.probability *
                       pdf_from_length(from, chosen.point, length(chosen.lamp->shape));
    return f * std::abs(wi.y) * chosen.lamp->emission / pdf;
}

/// Emits a photon. The lamp is chosen in proportion to its flux, the point uniformly
/// over the length, and the direction in proportion to the cosine. All photons
/// therefore carry the same flux.
/// \param scene   A scene with a lamp.
/// \param flux    The flux of the photon, W: the flux of the scene divided by the
///                number of photons.
/// \param stream  Three numbers are drawn.
/// \return A path without a vertex.
/// \report{Section 3.2.2}
[[nodiscard]] inline PathState emit_photon(const Scene& scene, double flux,
                                           RandomStream& stream) {
    const LampPoint from = sample_lamp(scene, next_2d<double>(stream));
    const Vec2 out = sample_cosine_half_circle(next_1d<double>(stream));
    return {.ray{.origin = from.point.position,
                 .direction = to_world(from.point.normal, out)},
            .throughput = flux};
}

} // namespace flatland
