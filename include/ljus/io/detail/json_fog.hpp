#pragma once

/// \file ljus/io/detail/json_fog.hpp
/// \brief The fog of a scene file.

#include <nlohmann/json.hpp>

#include "ljus/io/detail/json_textures.hpp"
#include "ljus/media/fog.hpp"

namespace ljus {

/// \defgroup json_fog Fog in scene files
/// \brief Optional (nlohmann-json): the entries of the list `fog`.
///
/// | where it is         | further fields                                        |
/// |---------------------|-------------------------------------------------------|
/// | center, radius      | scattering, \[absorption\]: per unit; \[g\]: see Fog  |
/// | low, high: of a box | the same                                              |
/// \{

namespace detail {

template <std::floating_point T>
SphereT<T> read_sphere(const JsonField& field) {
    const JsonField radius = member(field, "radius");
    const double length = number(radius, -max_length, max_length, "at most 1e9");
    if (!(static_cast<T>(length) > T(0))) refuse_value(radius, "above 0");
    return {.center{point_field(member(field, "center"))},
            .radius = static_cast<T>(length)};
}

template <typename Region, typename Scene, typename T = typename Scene::Scalar>
void add_fog(const JsonField& field, const Region& region, Scene& scene) {
    const auto coefficient = [](const JsonField& of) {
        return RgbT<T>{vector_field(of, 0, 1e12, "within [0, 1e12]")};
    };
    Fog<Region> fog{.region = region,
                    .scattering = coefficient(member(field, "scattering"))};
    if (const auto absorption = find(field, "absorption"))
        fog.absorption = coefficient(*absorption);
    if (const auto g = find(field, "g"))
        fog.g = static_cast<T>(number(*g, -0.99, 0.99, "within [-0.99, 0.99]"));
    made_of(field, [&] { scene.add(fog); });
}

template <typename Scene, std::floating_point T = typename Scene::Scalar>
void read_fog(const JsonField& field, Scene& scene) {
    if (find(field, "low")) {
        require_object(field, {"low", "high", "scattering", "absorption", "g"});
        add_fog(field,
                BoxT<T>{Vec3T<T>{point_field(member(field, "low"))},
                        Vec3T<T>{point_field(member(field, "high"))}},
                scene);
    } else {
        require_object(field, {"center", "radius", "scattering", "absorption", "g"});
        add_fog(field, read_sphere<T>(field), scene);
    }
}

} // namespace detail

/// \}

} // namespace ljus
