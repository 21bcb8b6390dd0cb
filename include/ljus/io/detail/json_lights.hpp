#pragma once

/// \file ljus/io/detail/json_lights.hpp
/// \brief The lights of a scene file that are not objects.

#include <nlohmann/json.hpp>

#include "ljus/io/detail/json_textures.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/lights/sun_light.hpp"

namespace ljus {

/// \defgroup json_lights Lights in scene files
/// \brief Optional (nlohmann-json): the fields of lights without a size.
///
/// | `type` | its fields                                                              |
/// |--------|-------------------------------------------------------------------------|
/// | point  | position, intensity: W/sr                                               |
/// | spot   | position, direction, intensity, inner_deg, outer_deg: see SpotLight     |
/// | sun    | direction in which it shines; irradiance: W/m^2                         |
/// \{

namespace detail {

template <typename Scene, std::floating_point T = typename Scene::Scalar>
void read_light(const JsonField& field, Scene& scene) {
    const JsonField type = member(field, "type");
    require_one_of(type, {"point", "spot", "sun"});
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
