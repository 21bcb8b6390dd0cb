#pragma once

/// \file ljus/io/detail/json_lights.hpp
/// \brief The fog of a scene file, and its lights that are not objects.

#include <nlohmann/json.hpp>

#include "ljus/io/detail/json_members.hpp"
#include "ljus/io/hdr.hpp"
#include "ljus/io/load_ies.hpp"
#include "ljus/io/pfm.hpp"
#include "ljus/lights/environment.hpp"
#include "ljus/lights/goniometric_light.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/media/fog.hpp"

namespace ljus::detail {

inline constexpr JsonMember light_shared[]{type_row, lamp_group_row};

inline constexpr JsonMember position_row =
    needed("position", point_value, "where it is", "[0, 2, 1]");
inline constexpr JsonMember intensity_row =
    needed("intensity", light_value, "W/sr", "[5, 5, 5]");
inline constexpr JsonMember shines_row =
    needed("direction", direction_value, "in which it shines", "[0, -1, 0]");

inline constexpr JsonMember point_members[]{position_row, intensity_row};
inline constexpr JsonMember spot_members[]{
    position_row, shines_row, intensity_row,
    needed("inner_deg", {JsonKind::number, 0, 180, "within [0, outer_deg]"},
           "half the angle of the cone of full light, degrees", "10"),
    needed("outer_deg", {JsonKind::number, 1e-3, 180, "within [0.001, 180] degrees"},
           "half the angle beyond which it is dark, degrees", "30")};
inline constexpr JsonMember sun_members[]{
    shines_row,
    needed("irradiance", light_value, "W/m^2 on a surface across", "[3, 3, 3]")};
inline constexpr JsonMember goniometric_members[]{
    position_row, shines_row,
    optional("reference", direction_value,
             "of type C: horizontal angle 0, of the types B and A: vertical angle 90; "
             "by default (0, 0, -1)",
             "[1, 0, 0]"),
    needed("file", text_value, "an IES file, beside the scene file",
           "\"wall_washer.ies\""),
    preset("watts_per_lumen", light_value, 1.0 / 683, "W/sr for each candela",
           "[0.01, 0.01, 0.01]")};
inline constexpr std::string_view sky_words[]{"radiance", "gradient", "file"};
inline constexpr JsonMember environment_members[]{
    optional("radiance", light_value, "the same all around, W/(m^2 sr)", "[1, 1, 1]"),
    optional("gradient", {.kind = JsonKind::object, .of = "gradient"},
             "a sky: ljus::gradient_sky()"),
    optional("file", text_value,
             "a picture, .hdr, .pfm or .exr, beside the scene file"),
    preset("strength", factor_value, 1, "factor of the radiance"),
    preset("rotation_deg", angle_value, 0, "about the y axis, degrees")};
inline constexpr JsonMember gradient_members[]{
    needed("horizon", light_value, "W/(m^2 sr)", "[1, 1, 1]"),
    needed("zenith", light_value, "W/(m^2 sr)", "[0.2, 0.4, 1]"),
    needed("ground", light_value, "W/(m^2 sr)", "[0.1, 0.1, 0.1]")};

/// The largest number of goniometric lights in a scene file, and the largest number of
/// intensities of all of them together.
inline constexpr std::size_t max_file_lamps = 1024, max_intensities = 1 << 22;

inline constexpr JsonTable light_tables[]{
    {"point", "a point", point_members},
    {"spot", "a point that shines into a cone", spot_members},
    {"sun", "parallel light", sun_members},
    {"environment",
     "light from all around, by one of radiance, gradient and file; one in a file",
     environment_members, sky_words},
    {"goniometric", "a point whose intensity a maker has measured: ljus::load_ies()",
     goniometric_members}};

// Reads the picture of a sky, which exactly one of three fields describes. `files` is
// the reader of mesh files; WithExr reads EXR pictures as well.
template <std::floating_point T, typename Files>
ImageT<T> read_sky(const JsonMembersOf& in, const Files& files) {
    if (in.has("radiance") + in.has("gradient") + in.has("file") != 1)
        refuse(in.field(), "must have one of the fields radiance, gradient and file");
    if (in.has("radiance")) return make_image<T>(1, 1, RgbT<T>{in.vector("radiance")});
    if (in.has("gradient")) {
        const JsonMembersOf gradient(in["gradient"], gradient_members);
        const auto color = [&](const char* name) {
            return RgbT<T>{gradient.vector(name)};
        };
        return gradient_sky<T>(color("horizon"), color("zenith"), color("ground"));
    }
    const JsonField file = in["file"];
    const std::string path = path_beside(file);
    try {
        if (path.ends_with(".hdr")) return load_hdr<T>(path);
        if (path.ends_with(".pfm")) return load_pfm<T>(path);
        if (path.ends_with(".exr")) {
            if constexpr (requires { &Files::template load_picture<T>; })
                return files.template load_picture<T>(path);
            throw std::runtime_error("load_json() reads no EXR pictures unless it is "
                                     "given WithExr, from ljus/io/exr.hpp.");
        }
    } catch (const std::runtime_error& error) {
        refuse_for(file, error);
    }
    refuse_value(file, "a picture with the ending .hdr, .pfm or .exr");
}

// Reads the intensities of a lamp. `others` are the lamps before it.
template <std::floating_point T>
IntensityTable read_intensities(const JsonMembersOf& in,
                                const std::vector<GoniometricLightT<T>>& others) {
    const JsonField file = in["file"];
    if (others.size() == max_file_lamps)
        refuse(in.field(), "is one goniometric light too many; a scene file has at "
                           "most 1024");
    IntensityTable table;
    try {
        table = load_ies(path_beside(file)).table;
    } catch (const std::runtime_error& error) {
        refuse_for(file, error);
    }
    std::size_t all = table.candela.size();
    for (const auto& other : others) all += other.table.candela.size();
    if (all > max_intensities)
        refuse(file, "has too many intensities; those of all lamps of a scene file "
                     "must be at most 4194304");
    return table;
}

template <typename Scene, typename Files,
          std::floating_point T = typename Scene::Scalar>
void read_light(const JsonField& field, const LampGroups& groups, Scene& scene,
                const Files& files) {
    const JsonTable& table = table_of(light_tables, field);
    const std::string_view name = table.name;
    const JsonMembersOf in(field, table.members, light_shared);
    const T factor = static_cast<T>(groups.factor(in));
    const auto light_of = [&](const char* what) {
        return factor * RgbT<T>{in.vector(what)};
    };
    const auto vector = [&](const char* what) { return Vec3T<T>{in.vector(what)}; };
    const auto add = [&](const auto& light) {
        made_of(field, [&] { scene.add(light); });
    };
    if (name == "point") {
        add(PointLightT<T>{.position = vector("position"),
                           .intensity = light_of("intensity")});
    } else if (name == "sun") {
        add(SunLightT<T>{.direction = vector("direction"),
                         .irradiance = light_of("irradiance")});
    } else if (name == "environment") {
        if (!std::get<std::vector<EnvironmentLightT<T>>>(scene.lights).empty())
            refuse(field, "is a second environment; a scene file has at most one");
        EnvironmentLightT<T> sky{
            .picture = read_sky<T>(in, files),
            .strength = factor * static_cast<T>(in.number("strength")),
            .rotation_degrees = static_cast<T>(in.number("rotation_deg"))};
        if (factor > T(0)) add(sky);
    } else if (name == "goniometric") {
        GoniometricLightT<T> lamp{
            .table = read_intensities(
                in, std::get<std::vector<GoniometricLightT<T>>>(scene.lights)),
            .position = vector("position"),
            .direction = vector("direction"),
            .watts_per_lumen = light_of("watts_per_lumen")};
        if (in.has("reference")) lamp.reference = vector("reference");
        add(lamp);
    } else {
        const double inner = in.number("inner_deg"), outer = in.number("outer_deg");
        if (!(inner <= outer)) refuse_value(in["inner_deg"], "within [0, outer_deg]");
        add(SpotLightT<T>{.position = vector("position"),
                          .direction = vector("direction"),
                          .intensity = light_of("intensity"),
                          .inner_degrees = static_cast<T>(inner),
                          .outer_degrees = static_cast<T>(outer)});
    }
}

inline constexpr JsonValue coefficient_value{JsonKind::vector, 0, 1e12,
                                             "within [0, 1e12]"};
inline constexpr JsonMember fog_shared[]{
    type_row,
    needed("scattering", coefficient_value, "per unit of length", "[0.1, 0.1, 0.1]"),
    preset("absorption", coefficient_value, 0, "per unit of length"),
    preset("g", {JsonKind::number, -0.99, 0.99, "within [-0.99, 0.99]"}, 0,
           "mean cosine of scattering: above 0 light goes on, below it returns")};
inline constexpr JsonMember fog_sphere_members[]{center_row, radius_row};
inline constexpr JsonMember fog_box_members[]{low_row, high_row};
inline constexpr JsonTable fog_tables[]{{"sphere", "a ball", fog_sphere_members},
                                        {"box", "a box", fog_box_members}};

template <typename Scene, std::floating_point T = typename Scene::Scalar>
void read_fog(const JsonField& field, Scene& scene) {
    const JsonTable& table = table_of(fog_tables, field);
    const JsonMembersOf in(field, table.members, fog_shared);
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
    if (table.name == "sphere")
        add(SphereT<T>{vector("center"), static_cast<T>(in.number("radius"))});
    else
        add(BoxT<T>{vector("low"), vector("high")});
}

} // namespace ljus::detail
