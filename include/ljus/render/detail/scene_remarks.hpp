#pragma once

/// \file ljus/render/detail/scene_remarks.hpp
/// \brief What a scene has that the passes do badly, as sentences.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ljus/path/vertex.hpp"
#include "ljus/render/photon_mapping_settings.hpp"

namespace ljus::detail {

/// Digits that are left of the shapes, if they are fewer than three, and lengths that
/// are too large.
///
/// A number x of p bits is off by up to 2^-p x. The surface of a ball of radius r whose
/// points have coordinates up to c is then off by 2^-p c / r of its radius, which
/// leaves log10(2^p r / c) digits. The direction of a shadow ray is as long as its way,
/// and chord() multiplies four lengths: above the fourth root of the largest number a
/// ball may cast no shadow.
/// \param scene  The scene.
/// \return A sentence, or nothing.
template <SceneLike S>
[[nodiscard]] std::string digits_remark(const S& scene) {
    using T = typename S::Scalar;
    constexpr bool single = std::is_same_v<T, float>;
    constexpr double widest = single ? 1e9 : 1e75;
    const auto in_double = [](const auto& shape) {
        const SphereT<T> ball = bounding_sphere(shape);
        return SphereT<double>{Vec3T<double>(ball.center), double(ball.radius)};
    };
    double most = 1, radius = 0, reach = 0;
    for (std::uint32_t type = 0; type < scene.objects.size(); ++type)
        for (std::uint32_t i = 0; i < scene.objects[type].size(); ++i) {
            const SphereT<double> bound = scene.visit_shape({type, i}, in_double);
            // [digits]
            const Vec3T<double> far = glm::abs(bound.center) + bound.radius;
            reach = std::max(reach, max_component(far));
            const double ratio = max_component(far) / bound.radius;
            if (!(ratio > most)) continue;
            most = ratio;
            radius = bound.radius;
        }
    constexpr double half = double(std::numeric_limits<T>::epsilon()) / 2;
    const int digits = int(std::max(0.0, std::floor(-std::log10(half * most))));
    // [digits]
    char times[40], size[40];
    if (digits >= 3) {
        if (!(reach > widest)) return {};
        std::snprintf(times, sizeof times, "%.0e", reach);
        return join({"coordinates reach ", times,
                     single ? ": above 1e9 the squares of areas leave the range of "
                              "float; use double, or a larger unit of length"
                            : ": above 1e75 the squares of areas leave the range of "
                              "double; use a larger unit of length"});
    }
    if (!std::isfinite(most)) // all corners are one point
        return join({"an object is so small or so far away that ",
                     single ? "float" : "double", " keeps nothing of its size; ",
                     single ? "use double, or move the scene towards the origin"
                            : "move the scene towards the origin"});
    std::snprintf(times, sizeof times, "%.0e", most);
    std::snprintf(size, sizeof size, "%.3g", radius);
    return join({"coordinates reach ", times, " times the smallest radius, ", size,
                 single ? ": float keeps " : ": double keeps ", to_text(digits),
                 digits == 1 ? " digit of it; " : " digits of it; ",
                 single ? "use double, or move the scene towards the origin"
                        : "move the scene towards the origin"});
}

/// How many objects mirror light in a lobe so narrow, below a thousandth of a
/// steradian, that a shadow ray hardly ever lies in it.
/// \param scene  The scene.
template <SceneLike S>
[[nodiscard]] std::size_t narrow_lobes(const S& scene) {
    using T = typename S::Scalar;
    const Vec3T<T> wo{T(0.6), T(0), T(0.8)}, mirrored{T(-0.6), T(0), T(0.8)};
    const auto narrow = [&](const auto& material) {
        const auto& here = material_at(material, Vec3T<T>{T(0)}, Vec2T<T>{T(0)});
        return has(lobes(here), Lobes::glossy) &&
               pdf(here, wo, mirrored, Lobes::glossy) > T(1000);
    };
    std::size_t count = 0;
    for (const auto& objects : scene.objects)
        for (const auto& object : objects)
            count += scene.visit_material(object.material, narrow) ? 1 : 0;
    return count;
}

/// What a survey remarks.
/// \param scene     The scene.
/// \param settings  What the user asks for.
/// \return Sentences without a full stop.
template <SceneLike S>
[[nodiscard]] std::vector<std::string>
scene_remarks(const S& scene, const PhotonMappingSettings& settings) {
    std::vector<std::string> remarks;
    if (scene.lights.empty())
        remarks.push_back("the scene has no light, and the picture will be black: add "
                          "an object with a radiance, or a point light");
    if (std::string digits = digits_remark(scene); !digits.empty())
        remarks.push_back(std::move(digits));
    const std::size_t narrow =
        settings.direct == DirectLight::sampled ? narrow_lobes(scene) : 0;
    if (narrow > 0)
        remarks.push_back(join(
            {to_text(static_cast<long long>(narrow)),
             " object(s) are nearly mirrors, in whose lobe a shadow ray hardly ever "
             "lies: their light is missing or in a few bright pixels; ask for "
             "direct light by mis, or for a mirror, of roughness 0"}));
    return remarks;
}

} // namespace ljus::detail
