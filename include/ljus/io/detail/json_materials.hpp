#pragma once

/// \file ljus/io/detail/json_materials.hpp
/// \brief The materials of a scene file.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "ljus/io/detail/json_field.hpp"
#include "ljus/materials/compensated_glossy.hpp"
#include "ljus/materials/eon.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/oren_nayar.hpp"
#include "ljus/materials/soap_film.hpp"
#include "ljus/materials/textured.hpp"
#include "ljus/scene/scene.hpp"

namespace ljus {

/// \defgroup json_materials Materials in scene files
/// \brief Optional (nlohmann-json): what a file may say of a material.
///
/// | `type`     | its fields                                                        |
/// |------------|-------------------------------------------------------------------|
/// | lambertian | albedo                                                            |
/// | oren-nayar | albedo, sigma_deg: the slope angle's deviation, degrees           |
/// | mirror     | reflectance                                                       |
/// | dielectric | ior: smooth, clear glass                                          |
/// | eon        | albedo, roughness                                                 |
/// | metal      | metal: gold, copper or silver; smooth                             |
/// | glossy     | reflectance, roughness                                            |
/// | full-glossy | the same; see CompensatedGlossy                                         |
/// | checker    | even, odd; origin, edge_u, edge_v: two by two fields              |
/// | thin-glass | ior, tint: a pane                                                 |
/// | soap-film  | ior, thickness_nm; if it drains scale, level and up: see SoapFilm |
/// \{

/// Whatever a scene file may name.
template <std::floating_point T>
using FileMaterialsT =
    Materials<LambertianT<T>, OrenNayarT<T>, MirrorT<T>, GlassT<T>, EonT<T>, MetalT<T>,
              GlossyT<T>, CompensatedGlossyT<T>, Textured<LambertianT<T>, CheckerT<T>>,
              ThinGlassT<T>, SoapFilmT<T>>;

namespace detail {

constexpr double max_length = 1e9;
constexpr double max_radiance = 1e12;

inline glm::dvec3 vector_field(const JsonField& field, double low, double high,
                               std::string_view right) {
    if (list_size(field) != 3) refuse_value(field, "a list of three numbers");
    return {number(entry(field, 0), low, high, right),
            number(entry(field, 1), low, high, right),
            number(entry(field, 2), low, high, right)};
}

inline glm::dvec3 point_field(const JsonField& field) {
    return vector_field(field, -max_length, max_length, "within [-1e9, 1e9]");
}

inline glm::dvec3 share_field(const JsonField& field) {
    return vector_field(field, 0, 1, "within [0, 1]");
}

// One of the names in a list.
inline void require_one_of(const JsonField& field,
                           const std::vector<std::string>& names) {
    for (const std::string& name : names)
        if (text(field) == name) return;
    refuse_value(field, in_a_row(names, "or"));
}

template <std::floating_point T>
MetalT<T> read_metal(const JsonField& field) {
    require_object(field, {"type", "metal"});
    const JsonField metal = member(field, "metal");
    require_one_of(metal, {"gold", "copper", "silver"});
    if (text(metal) == "gold") return {.index = gold<T>};
    return {.index = text(metal) == "copper" ? copper<T> : silver<T>};
}

template <std::floating_point T>
CheckerT<T> read_checker(const JsonField& field) {
    require_object(field, {"type", "even", "odd", "origin", "edge_u", "edge_v"});
    const auto edge = [&](const char* name) {
        const JsonField vector = member(field, name);
        const Vec3T<T> found{point_field(vector)};
        if (!std::isnormal(glm::dot(found, found)))
            refuse_value(vector, "a vector that is not 0");
        return found;
    };
    return {.map{.origin{point_field(member(field, "origin"))},
                 .edge_u = edge("edge_u"),
                 .edge_v = edge("edge_v")},
            .even{share_field(member(field, "even"))},
            .odd{share_field(member(field, "odd"))}};
}

template <std::floating_point T>
SoapFilmT<T> read_film(const JsonField& field) {
    require_object(field, {"type", "ior", "thickness_nm", "scale", "level", "up"});
    SoapFilmT<T> film{.thickness = static_cast<T>(
                          number(member(field, "thickness_nm"), 0,
                                 double(max_film_thickness<T>), "within [0, 1e6] nm")),
                      .index = static_cast<T>(
                          number(member(field, "ior"), 1, 1e3, "within [1, 1000]"))};
    if (find(field, "scale") || find(field, "level") || find(field, "up")) {
        const JsonField scale = member(field, "scale"), up = member(field, "up");
        film.scale = static_cast<T>(number(scale, 0, max_length, "within [0, 1e9]"));
        film.level = Vec3T<T>{point_field(member(field, "level"))};
        const glm::dvec3 way = point_field(up);
        if (!(glm::dot(way, way) > 0)) refuse_value(up, "a vector that is not 0");
        film.up = Vec3T<T>{glm::normalize(way)};
    }
    film.color = FilmColor::table;
    film.table = bake_film_table(film.index);
    return film;
}

template <typename Scene, std::floating_point T = typename Scene::Scalar>
MaterialId read_material(const JsonField& field, Scene& scene) {
    if (!field.value.is_object()) refuse_value(field, "an object");
    const JsonField type = member(field, "type");
    require_one_of(type,
                   {"lambertian", "oren-nayar", "mirror", "dielectric", "eon", "metal",
                    "glossy", "full-glossy", "checker", "thin-glass", "soap-film"});
    const std::string& name = text(type);
    const auto share = [&](const char* what) {
        return RgbT<T>{share_field(member(field, what))};
    };
    const auto ior = [&] {
        return static_cast<T>(
            number(member(field, "ior"), 1e-3, 1e3, "within [0.001, 1000]"));
    };
    const auto roughness = [&] {
        return static_cast<T>(
            number(member(field, "roughness"), 0, 1, "within [0, 1]"));
    };
    if (name == "lambertian") {
        require_object(field, {"type", "albedo"});
        return scene.add(LambertianT<T>{.albedo = share("albedo")});
    }
    if (name == "oren-nayar") {
        require_object(field, {"type", "albedo", "sigma_deg"});
        const double degrees =
            number(member(field, "sigma_deg"), 0, 90, "within [0, 90] degrees");
        return scene.add(
            OrenNayarT<T>{.albedo = share("albedo"),
                          .sigma = static_cast<T>(degrees * std::numbers::pi / 180)});
    }
    if (name == "mirror") {
        require_object(field, {"type", "reflectance"});
        return scene.add(MirrorT<T>{.reflectance = share("reflectance")});
    }
    if (name == "eon") {
        require_object(field, {"type", "albedo", "roughness"});
        return scene.add(EonT<T>{.albedo = share("albedo"), .roughness = roughness()});
    }
    if (name == "metal") return scene.add(read_metal<T>(field));
    if (name == "glossy" || name == "full-glossy") {
        require_object(field, {"type", "reflectance", "roughness"});
        const T rough = roughness();
        if (rough > T(0) && rough < min_roughness<T>)
            refuse_value(member(field, "roughness"), "0 or within [0.01, 1]");
        const GlossyT<T> gloss{.reflectance = share("reflectance"), .roughness = rough};
        if (name == "full-glossy") return scene.add(compensated_glossy(gloss));
        return scene.add(gloss);
    }
    if (name == "thin-glass") {
        require_object(field, {"type", "ior", "tint"});
        return scene.add(ThinGlassT<T>{.index = ior(), .tint = share("tint")});
    }
    if (name == "soap-film") return scene.add(read_film<T>(field));
    if (name == "checker")
        return scene.add(Textured<LambertianT<T>, CheckerT<T>>{
            {.albedo = RgbT<T>{T(1)}}, read_checker<T>(field)});
    require_object(field, {"type", "ior"});
    return scene.add(GlassT<T>{.index = ior()});
}

} // namespace detail

/// \}

} // namespace ljus
