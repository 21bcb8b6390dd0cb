#pragma once

/// \file chapters/experiments/uniform_sky.hpp
/// \brief An environment whose directions are drawn uniformly: the plain twin.

#include <numbers>
#include <optional>

#include <ljus/lights/environment.hpp>

namespace plain {

/// The light as a program adds it: an environment.
struct UniformSky {
    using Scalar = float;         ///< The precision.
    ljus::EnvironmentLight sky{}; ///< What it looks like.
};

/// As its scene stores it.
struct UniformSkyInScene {
    using Scalar = float;                   ///< The precision.
    ljus::EnvironmentInSceneT<float> sky{}; ///< What it looks like.
    ljus::Sphere around{};                  ///< The sphere around the scene.
};

inline void check(const UniformSky& light) {
    check(light.sky);
}
inline UniformSkyInScene in_scene(const UniformSky& light, const ljus::Sphere& around) {
    return {in_scene(light.sky, around), around};
}
inline ljus::Rgb power(const UniformSkyInScene& light) {
    return power(light.sky);
}

// [uniform sky]
constexpr float all_around = 4 * std::numbers::pi_v<float>; // steradians

inline ljus::Rgb escaped_radiance(const UniformSkyInScene& light,
                                  const ljus::Vec3& direction) {
    return escaped_radiance(light.sky, direction);
}
inline float pdf_escaped(const UniformSkyInScene&, const ljus::Vec3&) {
    return 1 / all_around;
}
inline std::optional<ljus::LightSampleT<float>>
sample_light(const UniformSkyInScene& light, const ljus::Vec3& from,
             const ljus::Vec2& u, float /*time*/) {
    const ljus::Vec3 wi = ljus::sample_uniform_sphere(u);
    return ljus::LightSampleT<float>{
        .point{.position = from + 2 * light.around.radius * wi, .normal = -wi},
        .wi = wi,
        .weight = all_around * escaped_radiance(light, wi),
        .pdf = 1 / all_around};
}
inline ljus::ArrivalT<float> sample_arrival(const UniformSkyInScene& light,
                                            const ljus::Vec2& u) {
    const ljus::Vec3 wi = ljus::sample_uniform_sphere(u);
    return {-wi, all_around * escaped_radiance(light, wi)};
}
// [uniform sky]

} // namespace plain
