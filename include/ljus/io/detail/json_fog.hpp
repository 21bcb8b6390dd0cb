#pragma once

/// \file ljus/io/detail/json_fog.hpp
/// \brief The fog of a scene file.

#include <nlohmann/json.hpp>

#include "ljus/io/detail/json_members.hpp"
#include "ljus/io/detail/json_textures.hpp"
#include "ljus/media/fog.hpp"

namespace ljus {

/// \defgroup json_fog Fog in scene files
/// \brief Optional (nlohmann-json): balls and boxes of fog. Page:
/// \ref ch_scene_files.
/// \{

namespace detail {

inline constexpr JsonValue coefficient_value{JsonKind::vector, 0, 1e12,
                                             "within [0, 1e12]"};
inline constexpr std::string_view fog_words[]{"sphere", "box"};
inline constexpr JsonMember fog_shared[]{
    needed("type", {.kind = JsonKind::word, .words = fog_words}, "what it fills", {}),
    needed("scattering", coefficient_value, "per unit of length", "[0.1, 0.1, 0.1]"),
    preset("absorption", coefficient_value, 0, "per unit of length"),
    preset("g", {JsonKind::number, -0.99, 0.99, "within [-0.99, 0.99]"}, 0,
           "mean cosine of scattering: above 0 light goes on, below it returns")};
inline constexpr JsonMember fog_sphere_members[]{
    needed("center", point_value, "its centre", "[0, 1, 0]"),
    needed("radius", length_value, "its radius", "0.5")};
inline constexpr JsonMember fog_box_members[]{
    needed("low", point_value, "least x, y and z", "[0, 0, 0]"),
    needed("high", point_value, "greatest x, y and z", "[1, 2, 1]")};
inline constexpr JsonTable fog_tables[]{{"sphere", {}, "a ball", fog_sphere_members},
                                        {"box", {}, "a box", fog_box_members}};

template <typename Scene, std::floating_point T = typename Scene::Scalar>
void read_fog(const JsonField& field, Scene& scene) {
    const JsonField type = member(field, "type");
    const JsonTable* const table = table_of(fog_tables, text(type));
    if (table == nullptr) require_one_of(type, fog_words);
    const JsonMembersOf in(field, table->members, fog_shared);
    const auto vector = [&](const char* name) { return Vec3T<T>{in.vector(name)}; };
    const auto add = [&](const auto& region) {
        made_of(field, [&] {
            scene.add(Fog<std::remove_cvref_t<decltype(region)>>{
                .region = region,
                .absorption = vector("absorption"),
                .scattering = vector("scattering"),
                .g = static_cast<T>(in.number("g"))});
        });
    };
    if (table->name == "sphere")
        add(SphereT<T>{vector("center"), static_cast<T>(in.number("radius"))});
    else
        add(BoxT<T>{vector("low"), vector("high")});
}

} // namespace detail

/// \}

} // namespace ljus
