#pragma once

/// \file ljus/io/detail/json_materials.hpp
/// \brief The materials of a scene file, as a table with one row per material.

#include <array>
#include <map>
#include <numbers>
#include <tuple>

#include <nlohmann/json.hpp>

#include "ljus/io/detail/json_textures.hpp"
#include "ljus/io/mesh_file.hpp"
#include "ljus/materials/compensated_glossy.hpp"
#include "ljus/materials/dispersive_glass.hpp"
#include "ljus/materials/eon.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/materials/nested.hpp"
#include "ljus/materials/rough_glass.hpp"
#include "ljus/materials/soap_film.hpp"
#include "ljus/materials/textured.hpp"
#include "ljus/scene/make_scene.hpp"
#include "ljus/scene/picture_lamp.hpp"

namespace ljus::detail {

/// The largest number of energy loss tables for the materials full-glossy and
/// full-rough-metal of a scene file. Each takes some hundredths of a second to compute.
inline constexpr std::size_t max_loss_tables = 64;

// Data that the materials of a file share.
template <std::floating_point T>
struct SharedByMaterialsT {
    long long pixels = 0;                 // of all pictures so far
    std::map<T, EnergyLossT<T>> losses{}; // by roughness
};

// Reads the members of a material for the rows below.
template <std::floating_point T>
struct MaterialFields {
    const JsonMembersOf& in;
    SharedByMaterialsT<T>& shared;

    T value(const char* name) const { return static_cast<T>(in.number(name)); }
    RgbT<T> color(const char* name) const { return RgbT<T>{in.vector(name)}; }
    T radians(const char* name) const {
        return static_cast<T>(in.number(name) * std::numbers::pi / 180);
    }
    int priority() const { return static_cast<int>(in.number("priority")); }
    GlossyT<T> gloss() const { return {color("reflectance"), value("roughness")}; }
    ConductorIndexT<T> metal() const {
        const std::string name = in.word("metal");
        return name == "gold" ? gold<T> : name == "copper" ? copper<T> : silver<T>;
    }
    SellmeierT<T> medium() const {
        const std::string name = in.word("medium");
        return name == "bk7"     ? bk7<T>
               : name == "sf10"  ? sf10<T>
               : name == "sf66"  ? sf66<T>
               : name == "water" ? water<T>
                                 : diamond<T>;
    }
    GlossyT<T, ConductorIndexT<T>> rough_metal() const {
        return {metal(), value("roughness")};
    }
    // A glossy material with multiple scattering.
    template <typename Facet>
    CompensatedGlossyT<T, Facet> full(const GlossyT<T, Facet>& gloss) const {
        const T rough = gloss.roughness;
        auto known = shared.losses.find(rough);
        if (known == shared.losses.end()) {
            if (shared.losses.size() == max_loss_tables)
                refuse_value(in["roughness"],
                             "one of the 64 that full-glossy and full-rough-metal have "
                             "before it, because each takes a table that is slow to "
                             "compute");
            known = shared.losses.emplace(rough, bake_energy_loss(rough * rough)).first;
        }
        return compensated_glossy(gloss, known->second);
    }
    RoughDiffuseT<T> rough(RoughModel model) const {
        return {color("albedo"), radians("sigma_deg"), model};
    }
};

template <std::floating_point T>
MixtureT<T> read_mixture(const MaterialFields<T>& in) {
    return {.color = in.color("color"),
            .reflectivity = in.value("reflectivity"),
            .transparency = in.value("transparency"),
            .index = in.value("ior"),
            .specularity = in.value("specularity"),
            .emissivity = in.value("emissivity"),
            .sigma = in.radians("sigma_deg"),
            .absorption = in.color("absorption")};
}

template <std::floating_point T>
SoapFilmT<T> read_film(const MaterialFields<T>& fields) {
    const JsonMembersOf& in = fields.in;
    SoapFilmT<T> film{.thickness = fields.value("thickness_nm"),
                      .index = fields.value("ior")};
    if (in.has("scale") || in.has("level") || in.has("up")) {
        for (const char* name : {"up", "scale", "level"}) (void)in[name];
        film.scale = fields.value("scale");
        film.level = Vec3T<T>{in.vector("level")};
        film.up = Vec3T<T>{glm::normalize(in.vector("up"))};
    }
    film.color = FilmColor::table;
    film.table = bake_film_table(film.index);
    return film;
}

// A matt surface with pictures of colours, normals and holes, as in a mesh file.
template <std::floating_point T>
MeshDetailedT<LambertianT<T>> read_mapped(const JsonMembersOf& in, long long& pixels) {
    using Picture = PictureTextureT<T, UvMapT<T>>;
    const UvMapT<T> map = read_uv_map<T>(in);
    const auto on_map = [&](const char* file, PictureContent content) {
        return picture_on(map, in, take_picture<T>(in[file], pixels, content));
    };
    const auto even = [&](const RgbT<T>& color) {
        return Picture{.image = make_image(1, 1, color)};
    };
    const bool cut = in.has("cutoff"), dented = in.has("normals");
    return {{{{.albedo = RgbT<T>{T(1)}}, on_map("file", PictureContent::colors)},
             {dented ? on_map("normals", PictureContent::numbers)
                     : even({T(0.5), T(0.5), T(1)})}},
            {cut ? on_map("file", PictureContent::alpha) : even(RgbT<T>{T(1)}),
             cut ? in.number("cutoff") : 0.5}};
}

// The members of the materials.
inline constexpr JsonMember albedo_row =
    needed("albedo", color_value, "the part of the light that is reflected",
           "[0.8, 0.6, 0.4]");
inline constexpr JsonMember sigma_row =
    needed("sigma_deg", {JsonKind::number, 0, 90, "within [0, 90] degrees"},
           "standard deviation of the slope, degrees", "30");
inline constexpr JsonMember unit_roughness_row =
    needed("roughness", fraction_value, "from smooth to rough", "0.5");
inline constexpr JsonMember roughness_row =
    needed("roughness", roughness_value, "from smooth to rough", "0.25");
inline constexpr JsonMember mirror_row =
    needed("reflectance", color_value, "at every angle", "[0.9, 0.9, 0.9]");
inline constexpr JsonMember reflectance_row = needed(
    "reflectance", color_value, "of a facet at normal incidence", "[0.9, 0.9, 0.9]");
inline constexpr std::string_view metal_words[]{"gold", "copper", "silver"};
inline constexpr JsonMember metal_row =
    needed("metal", {.kind = JsonKind::word, .words = metal_words},
           "whose measured index of refraction", "\"gold\"");
inline constexpr std::string_view medium_words[]{"bk7", "sf10", "sf66", "water",
                                                 "diamond"};
inline constexpr JsonValue ior_value{JsonKind::number, 1e-3, 1e3,
                                     "within [0.001, 1000]"};
inline constexpr JsonMember ior_row =
    needed("ior", ior_value, "index of refraction", "1.5");
inline constexpr JsonMember absorption_row = preset(
    "absorption", {JsonKind::vector, 0, 1e12, "within [0, 1e12]"}, 0, "per scene unit");
inline constexpr JsonMember priority_row =
    preset("priority", {JsonKind::whole, 0, 1000, {}}, 0,
           "where bodies overlap, the highest holds");
inline constexpr JsonMember picture_row = needed(
    "file", text_value, "PNG, JPEG or BMP, beside the scene file", "\"tile.png\"");
inline constexpr JsonMember even_row =
    needed("even", color_value, "albedo of the even fields", "[0.9, 0.9, 0.9]");
inline constexpr JsonMember odd_row =
    needed("odd", color_value, "albedo of the odd fields", "[0.1, 0.1, 0.1]");
constexpr JsonMember slider_row(std::string_view name, std::string_view text) {
    return preset(name, fraction_value, 0, text);
}
constexpr JsonMember fields_row(std::string_view name, std::string_view text) {
    return preset(name, {JsonKind::whole, 2, 1e6, {}}, 2, text);
}

// A row of the table: the name of a material, a description, its members other than
// `type`, and the function that reads it.
template <std::size_t N, typename Read>
struct MaterialRow {
    std::string_view name, text;
    std::array<JsonMember, N> members;
    Read read;
};
template <std::size_t N, typename Read>
constexpr MaterialRow<N, Read> row(std::string_view name, std::string_view text,
                                   const JsonMember (&members)[N], Read read) {
    return {name, text, std::to_array(members), read};
}
template <std::floating_point T, typename Texture>
Textured<LambertianT<T>, Texture> white(Texture texture) {
    return {{.albedo = RgbT<T>{T(1)}}, std::move(texture)};
}

// The table of materials. The material types of a scene, the names in messages, the
// page of the book and the JSON schema are made from it.
template <std::floating_point T>
constexpr auto material_rows() {
    using In = const MaterialFields<T>&;
    constexpr auto& map = map_members;
    return std::tuple{
        row("lambertian", "matt", {albedo_row},
            [](In in) { return LambertianT<T>{in.color("albedo")}; }),
        row("oren-nayar", "rough and matt, like clay", {albedo_row, sigma_row},
            [](In in) {
                return OrenNayarT<T>{in.color("albedo"), in.radians("sigma_deg")};
            }),
        row("mirror", "a smooth mirror", {mirror_row},
            [](In in) { return MirrorT<T>{in.color("reflectance")}; }),
        row("dielectric", "smooth glass or water",
            {ior_row, absorption_row, priority_row},
            [](In in) {
                return Nested<GlassT<T>>{{in.value("ior"), in.color("absorption")},
                                         in.priority()};
            }),
        row("mixture", "the report's sliders",
            {needed("color", color_value, "of the body", "[0.8, 0.6, 0.4]"),
             slider_row("reflectivity", "a mirror"),
             slider_row("transparency", "a body of glass"),
             preset("ior", ior_value, 1.5, "index of refraction"),
             slider_row("specularity", "a smooth coat"),
             preset("emissivity",
                    {JsonKind::number, 0, max_radiance, "within [0, 1e12]"}, 0,
                    "radiance over color, W/(m^2 sr)"),
             preset("sigma_deg", sigma_row.value, 0,
                    "standard deviation of the slope, degrees"),
             absorption_row, priority_row},
            [](In in) {
                return Nested<MixtureT<T>>{read_mixture(in), in.priority()};
            }),
        row("oren-nayar-full", "with interreflection between facets",
            {albedo_row, sigma_row}, [](In in) { return in.rough(RoughModel::full); }),
        row("oren-nayar-printed", "the formula of the report's program",
            {albedo_row, sigma_row},
            [](In in) { return in.rough(RoughModel::as_printed); }),
        row("fujii", "Fujii's first improvement", {albedo_row, sigma_row},
            [](In in) { return in.rough(RoughModel::fujii); }),
        row("fon", "Fujii's second improvement", {albedo_row, unit_roughness_row},
            [](In in) {
                return RoughDiffuseT<T>{in.color("albedo"), in.value("roughness"),
                                        RoughModel::fon};
            }),
        row("eon", "rough and matt, keeps all energy", {albedo_row, unit_roughness_row},
            [](In in) {
                return EonT<T>{in.color("albedo"), in.value("roughness")};
            }),
        row("metal", "a smooth metal", {metal_row},
            [](In in) { return MetalT<T>{in.metal()}; }),
        row("rough-metal", "a rough metal", {metal_row, roughness_row},
            [](In in) { return in.rough_metal(); }),
        row("full-rough-metal", "with multiple scattering: ljus::CompensatedGlossy",
            {metal_row, roughness_row},
            [](In in) { return in.full(in.rough_metal()); }),
        row("glossy", "a rough mirror", {reflectance_row, roughness_row},
            [](In in) { return in.gloss(); }),
        row("full-glossy", "with multiple scattering: ljus::CompensatedGlossy",
            {reflectance_row, roughness_row},
            [](In in) { return in.full(in.gloss()); }),
        row("rough-glass", "frosted glass",
            {ior_row, roughness_row, absorption_row, priority_row},
            [](In in) {
                return Nested<RoughGlassT<T>>{
                    {in.value("ior"), in.value("roughness"), in.color("absorption")},
                    in.priority()};
            }),
        row("dispersive-glass", "glass that makes a spectrum, by two numbers",
            {needed("ior", {JsonKind::number, 1, 100, "within [1, 100]"},
                    "index of refraction for yellow light", "1.62"),
             needed("abbe", {JsonKind::number, 1, 1e6, "within [1, 1e6]"},
                    "Abbe's number: 64 for crown glass, 21 for heavy flint", "36"),
             absorption_row, priority_row},
            [](In in) {
                return Nested<DispersiveGlassT<T, CauchyT<T>>>{
                    {cauchy_from_abbe(in.value("ior"), in.value("abbe")),
                     in.color("absorption")},
                    in.priority()};
            }),
        row("measured-glass", "glass, water or diamond with a measured spectrum",
            {needed("medium", {.kind = JsonKind::word, .words = medium_words},
                    "crown glass N-BK7, flint SF10, heavy flint N-SF66, water or "
                    "diamond",
                    "\"sf66\""),
             absorption_row, priority_row},
            [](In in) {
                return Nested<DispersiveGlassT<T>>{
                    {in.medium(), in.color("absorption")}, in.priority()};
            }),
        row("thin-glass", "a pane",
            {ior_row, needed("tint", color_value, "of what passes", "[0.9, 1, 0.9]")},
            [](In in) {
                return ThinGlassT<T>{in.value("ior"), in.color("tint")};
            }),
        row("soap-film", "a thin film; if it drains, it has scale, level and up",
            {needed("ior", {JsonKind::number, 1, 1e3, "within [1, 1000]"},
                    "index of refraction", "1.33"),
             needed("thickness_nm", {JsonKind::number, 0, 1e6, "within [0, 1e6] nm"},
                    "at the level, nanometres", "400"),
             optional("scale", {JsonKind::number, 0, max_length, "within [0, 1e9]"},
                      "the height over which the thickness falls to 1/e; 0: even"),
             optional("level", point_value, "a point at the height of thickness_nm"),
             optional("up", direction_value, "away from the ground")},
            [](In in) { return read_film(in); }),
        row("checker", "matt, with two by two fields",
            {even_row, odd_row, map[0], map[1], map[2], map[3], map[4], map[5], map[6],
             map[7], fields_row("columns", "fields along u, an even number"),
             fields_row("rows", "fields along v, an even number")},
            [](In in) { return white<T>(read_checker<T>(in.in)); }),
        row("picture", "matt, with the colours of a picture",
            {picture_row, map[0], map[1], map[2], map[3], map[4], map[5], map[6],
             map[7], wrap_row, filter_row},
            [](In in) { return white<T>(read_picture<T>(in.in, in.shared.pixels)); }),
        row("mapped", "matt, with pictures in the shape's own coordinates",
            {needed("file", text_value, "its colours: PNG, JPEG or BMP",
                    "\"tile.png\""),
             optional(
                 "normals", text_value,
                 "a picture of normals: red along u, green along v, blue outwards; "
                 "for meshes, quads and triangles"),
             optional("cutoff", fraction_value,
                      "where the alpha of the colours is below it, there is a hole",
                      "0.5"),
             map[5], map[6], map[7], wrap_row, filter_row},
            [](In in) { return read_mapped<T>(in.in, in.shared.pixels); }),
        row("picture-lamp",
            "of a quad or a disc, whose emission it multiplies: ljus::PictureLamp",
            {picture_row,
             preset("albedo", color_value, 0, "of the light that falls on it")},
            [](In in) {
                return PictureLampT<T>{
                    .picture = take_picture<T>(in.in["file"], in.shared.pixels),
                    .base{in.color("albedo")}};
            })};
}

// The material types of the rows. A type that several names share is listed once.
template <typename... M>
Materials<M...> listed(TypeList<M...>);
template <std::floating_point T, typename... Row>
constexpr auto materials_of(const std::tuple<Row...>&) {
    using In = const MaterialFields<T>&;
    return (TypeList<>{} + ... +
            TypeList<decltype(std::declval<Row>().read(std::declval<In>()))>{});
}

/// The materials that a scene file may name, and the metals of mesh files.
template <std::floating_point T>
using FileMaterialsT = decltype(listed(materials_of<T>(material_rows<T>()) +
                                       TypeList<MeshDetailedT<GlossyT<T>>>{}));

template <typename Scene, std::floating_point T = typename Scene::Scalar>
MaterialId read_material(const JsonField& field, SharedByMaterialsT<T>& shared,
                         Scene& scene) {
    const JsonField type = member(field, "type");
    MaterialId id{};
    const auto read = [&](const auto& row) {
        if (text(type) != row.name) return false;
        const JsonMembersOf in(field, row.members, JsonMembers(&type_row, 1));
        id = made_of(field, [&] { return scene.add(row.read({in, shared})); });
        return true;
    };
    std::apply(
        [&](const auto&... row) {
            if ((read(row) || ...)) return;
            const std::string_view names[]{row.name...};
            require_one_of(type, names);
        },
        material_rows<T>());
    return id;
}

} // namespace ljus::detail
