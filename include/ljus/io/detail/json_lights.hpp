#pragma once

/// \file ljus/io/detail/json_lights.hpp
/// \brief The lights of a scene file that are not objects.

#include <nlohmann/json.hpp>

#include "ljus/io/detail/json_textures.hpp"
#include "ljus/io/hdr.hpp"
#include "ljus/io/pfm.hpp"
#include "ljus/lights/environment.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/lights/sun_light.hpp"

namespace ljus {

/// \defgroup json_lights Lights in scene files
/// \brief Optional (nlohmann-json): the fields of lights that are not objects.
///
/// | `type`      | its fields                                                         |
/// |-------------|--------------------------------------------------------------------|
/// | point       | position, intensity: W/sr                                          |
/// | spot        | position, direction, intensity, inner_deg, outer_deg: SpotLight    |
/// | sun         | direction in which it shines; irradiance: W/m^2                    |
/// | environment | one of radiance: a constant, W/(m^2 sr); gradient: horizon, zenith,|
/// |             | ground, see gradient_sky(); file: a picture, .hdr or .pfm, see     |
/// |             | EnvironmentLight; strength (1); rotation_deg (0)                   |
///
/// A scene file has at most one environment, because pictures may be large.
/// \{

namespace detail {

// A picture of the sky: exactly one of three fields says how it is made.
template <std::floating_point T>
ImageT<T> read_sky(const JsonField& field) {
    const auto radiance = find(field, "radiance");
    const auto gradient = find(field, "gradient");
    const auto file = find(field, "file");
    if (int(radiance.has_value()) + int(gradient.has_value()) + int(file.has_value()) !=
        1)
        refuse(field, "must have one of the fields radiance, gradient and file");
    if (radiance) return make_image<T>(1, 1, RgbT<T>{light_field(*radiance)});
    if (gradient) {
        require_object(*gradient, {"horizon", "zenith", "ground"});
        const auto color = [&](const char* name) {
            return RgbT<T>{light_field(member(*gradient, name))};
        };
        return gradient_sky<T>(color("horizon"), color("zenith"), color("ground"));
    }
    const std::string path = path_beside(*file);
    const bool hdr = path.ends_with(".hdr");
    if (!hdr && !path.ends_with(".pfm"))
        refuse_value(*file, "a picture with the ending .hdr or .pfm");
    try {
        return hdr ? load_hdr<T>(path) : load_pfm<T>(path);
    } catch (const std::runtime_error& error) {
        refuse_for(*file, error);
    }
}

template <std::floating_point T>
EnvironmentLightT<T> read_environment(const JsonField& field) {
    require_object(
        field, {"type", "radiance", "gradient", "file", "strength", "rotation_deg"});
    EnvironmentLightT<T> light{.picture = read_sky<T>(field)};
    if (const auto strength = find(field, "strength"))
        light.strength =
            static_cast<T>(number(*strength, 1e-9, 1e9, "within [1e-9, 1e9]"));
    if (const auto rotation = find(field, "rotation_deg"))
        light.rotation_degrees =
            static_cast<T>(number(*rotation, -360, 360, "within [-360, 360] degrees"));
    return light;
}

template <typename Scene, std::floating_point T = typename Scene::Scalar>
void read_light(const JsonField& field, Scene& scene) {
    const JsonField type = member(field, "type");
    require_one_of(type, {"point", "spot", "sun", "environment"});
    const auto strength = [&](const char* what) {
        return RgbT<T>{light_field(member(field, what))};
    };
    const auto vector = [&](const char* what, auto read) {
        return Vec3T<T>{read(member(field, what))};
    };
    const auto degrees = [&](const char* what, double most, const char* right) {
        return number(member(field, what), 0, most, right);
    };
    const auto add = [&](const auto& light) {
        made_of(field, [&] { scene.add(light); });
    };
    if (text(type) == "point") {
        require_object(field, {"type", "position", "intensity"});
        add(PointLightT<T>{.position = vector("position", point_field),
                           .intensity = strength("intensity")});
    } else if (text(type) == "sun") {
        require_object(field, {"type", "direction", "irradiance"});
        add(SunLightT<T>{.direction = vector("direction", direction_field),
                         .irradiance = strength("irradiance")});
    } else if (text(type) == "environment") {
        if (!std::get<std::vector<EnvironmentLightT<T>>>(scene.lights).empty())
            refuse(field, "is a second environment; a scene file has at most one");
        add(read_environment<T>(field));
    } else {
        require_object(field, {"type", "position", "direction", "intensity",
                               "inner_deg", "outer_deg"});
        const double outer = degrees("outer_deg", 180, "within [0.001, 180] degrees");
        const double inner = degrees("inner_deg", outer, "within [0, outer_deg]");
        add(SpotLightT<T>{.position = vector("position", point_field),
                          .direction = vector("direction", direction_field),
                          .intensity = strength("intensity"),
                          .inner_degrees = static_cast<T>(inner),
                          .outer_degrees = static_cast<T>(outer)});
    }
}

} // namespace detail

/// \}

} // namespace ljus
