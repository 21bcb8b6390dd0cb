#pragma once

/// \file ljus/io/detail/json_materials.hpp
/// \brief The materials of a scene file: one row per material.

#include <array>
#include <map>
#include <numbers>
#include <tuple>

#include <nlohmann/json.hpp>

#include "ljus/io/detail/json_textures.hpp"
#include "ljus/materials/compensated_glossy.hpp"
#include "ljus/materials/eon.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/materials/rough_glass.hpp"
#include "ljus/materials/soap_film.hpp"
#include "ljus/materials/textured.hpp"
#include "ljus/scene/make_scene.hpp"

namespace ljus {

/// \defgroup json_materials Materials in scene files
/// \brief Optional (nlohmann-json): the fields of a material.
///
/// | `type`          | its fields; those in brackets are optional                    |
/// |-----------------|---------------------------------------------------------------|
/// | lambertian      | albedo                                                        |
/// | oren-nayar      | albedo, sigma_deg: standard deviation of the slope, degrees   |
/// | oren-nayar-full | the same; with interreflection between facets                 |
/// | oren-nayar-printed | the same; the formula of the report's program              |
/// | fujii           | the same; Fujii's first improvement                           |
/// | fon             | albedo, roughness; Fujii's second                             |
/// | eon             | albedo, roughness                                             |
/// | mixture         | color, \[reflectivity, transparency, ior, specularity,        |
/// |                 | emissivity, sigma_deg, absorption\]: the report's sliders     |
/// | mirror          | reflectance                                                   |
/// | metal           | metal: gold, copper or silver; smooth                         |
/// | rough-metal     | metal, roughness                                              |
/// | full-rough-metal | the same; see CompensatedGlossy                              |
/// | glossy          | reflectance, roughness                                        |
/// | full-glossy     | the same; see CompensatedGlossy                               |
/// | dielectric      | ior, \[absorption\]: smooth glass                             |
/// | rough-glass     | ior, roughness, \[absorption\]: frosted; see RoughGlass       |
/// | thin-glass      | ior, tint: a pane                                             |
/// | soap-film       | ior, thickness_nm; if it drains, scale, level and up          |
/// | checker         | even, odd, a map, \[columns, rows\]: two by two squares       |
/// | picture         | file: PNG, JPEG or BMP, relative to the scene file; a map     |
///
/// A map is origin, edge_u and edge_v of a plane; or "map": "globe" and its center; or
/// "map": "uv", the coordinates of the shape, with \[scale\], two numbers: see
/// PlaneMap, GlobeMap, UvMap.
/// \{

namespace detail {

/// The largest number of tables for full-glossy and full-rough-metal; each takes some
/// hundredths of a second.
inline constexpr std::size_t max_loss_tables = 64;

// What several materials of a file can have in common.
template <std::floating_point T>
struct SharedByMaterialsT {
    FilePicturesT<T> pictures;
    std::map<T, EnergyLossT<T>> losses{}; // by the roughness
};

// Reads the fields of a material for the rows below.
template <std::floating_point T>
struct MaterialFields {
    const JsonField& field;
    SharedByMaterialsT<T>& shared;

    T value(const char* name, double low, double high, std::string_view right) const {
        return static_cast<T>(number(member(field, name), low, high, right));
    }
    bool has(const char* name) const { return find(field, name).has_value(); }
    T unit(const char* name) const { return value(name, 0, 1, "within [0, 1]"); }
    T slider(const char* name) const { return has(name) ? unit(name) : T(0); }
    RgbT<T> color(const char* name) const {
        return RgbT<T>{fraction_field(member(field, name))};
    }
    T degrees(const char* name) const {
        return static_cast<T>(
            number(member(field, name), 0, 90, "within [0, 90] degrees") *
            std::numbers::pi / 180);
    }
    T ior() const { return value("ior", 1e-3, 1e3, "within [0.001, 1000]"); }
    RgbT<T> absorption() const {
        if (!has("absorption")) return RgbT<T>{T(0)};
        return RgbT<T>{
            vector_field(member(field, "absorption"), 0, 1e12, "within [0, 1e12]")};
    }
    T roughness() const {
        const T rough = unit("roughness");
        if (rough > T(0) && rough < min_roughness<T>)
            refuse_value(member(field, "roughness"), "0 or within [0.01, 1]");
        return rough;
    }
    GlossyT<T> gloss() const { return {color("reflectance"), roughness()}; }
    ConductorIndexT<T> metal() const {
        const JsonField metal = member(field, "metal");
        require_one_of(metal, {"gold", "copper", "silver"});
        const std::string& name = text(metal);
        return name == "gold" ? gold<T> : name == "copper" ? copper<T> : silver<T>;
    }
    GlossyT<T, ConductorIndexT<T>> rough_metal() const {
        return {metal(), roughness()};
    }
    // The same with multiple scattering.
    template <typename Facet>
    CompensatedGlossyT<T, Facet> full(const GlossyT<T, Facet>& gloss) const {
        const T rough = gloss.roughness;
        auto known = shared.losses.find(rough);
        if (known == shared.losses.end()) {
            if (shared.losses.size() == max_loss_tables)
                refuse_value(member(field, "roughness"),
                             "one of the 64 that full-glossy and full-rough-metal have "
                             "before it, because each takes a table that is slow to "
                             "compute");
            known = shared.losses.emplace(rough, bake_energy_loss(rough * rough)).first;
        }
        return compensated_glossy(gloss, known->second);
    }
    RoughDiffuseT<T> rough(RoughModel model) const {
        return {color("albedo"), degrees("sigma_deg"), model};
    }
};

template <std::floating_point T>
MixtureT<T> read_mixture(const MaterialFields<T>& in) {
    MixtureT<T> mixture{.color = in.color("color"),
                        .reflectivity = in.slider("reflectivity"),
                        .transparency = in.slider("transparency"),
                        .specularity = in.slider("specularity"),
                        .absorption = in.absorption()};
    if (in.has("ior")) mixture.index = in.ior();
    if (in.has("sigma_deg")) mixture.sigma = in.degrees("sigma_deg");
    if (in.has("emissivity"))
        mixture.emissivity =
            in.value("emissivity", 0, max_radiance, "within [0, 1e12]");
    return mixture;
}

template <std::floating_point T>
SoapFilmT<T> read_film(const MaterialFields<T>& in) {
    SoapFilmT<T> film{.thickness =
                          in.value("thickness_nm", 0, double(max_film_thickness<T>),
                                   "within [0, 1e6] nm"),
                      .index = in.value("ior", 1, 1e3, "within [1, 1000]")};
    if (in.has("scale") || in.has("level") || in.has("up")) {
        const glm::dvec3 up = direction_field(member(in.field, "up"));
        film.scale = in.value("scale", 0, max_length, "within [0, 1e9]");
        film.level = Vec3T<T>{point_field(member(in.field, "level"))};
        film.up = Vec3T<T>{glm::normalize(up)};
    }
    film.color = FilmColor::table;
    film.table = bake_film_table(film.index);
    return film;
}

// A material's name, its fields besides `type`, and its reader.
template <std::size_t N, typename Read>
struct MaterialRow {
    std::string_view name;
    std::array<std::string_view, N> fields;
    Read read;
};
template <std::size_t N, typename Read>
constexpr MaterialRow<N, Read> row(std::string_view name,
                                   const std::string_view (&fields)[N], Read read) {
    return {name, std::to_array(fields), read};
}
template <std::floating_point T, typename Texture>
Textured<LambertianT<T>, Texture> white(Texture texture) {
    return {{.albedo = RgbT<T>{T(1)}}, std::move(texture)};
}

// The table of materials. The material types of a file's scene, the readers and the
// names in messages follow from it, so that a new material needs a new row only.
template <std::floating_point T>
constexpr auto material_rows() {
    using In = const MaterialFields<T>&;
    return std::tuple{
        row("lambertian", {"albedo"},
            [](In in) { return LambertianT<T>{in.color("albedo")}; }),
        row("oren-nayar", {"albedo", "sigma_deg"},
            [](In in) {
                return OrenNayarT<T>{in.color("albedo"), in.degrees("sigma_deg")};
            }),
        row("mirror", {"reflectance"},
            [](In in) { return MirrorT<T>{in.color("reflectance")}; }),
        row("dielectric", {"ior", "absorption"},
            [](In in) {
                return GlassT<T>{in.ior(), in.absorption()};
            }),
        row("mixture",
            {"color", "reflectivity", "transparency", "ior", "specularity",
             "emissivity", "sigma_deg", "absorption"},
            [](In in) { return read_mixture(in); }),
        row("oren-nayar-full", {"albedo", "sigma_deg"},
            [](In in) { return in.rough(RoughModel::full); }),
        row("oren-nayar-printed", {"albedo", "sigma_deg"},
            [](In in) { return in.rough(RoughModel::as_printed); }),
        row("fujii", {"albedo", "sigma_deg"},
            [](In in) { return in.rough(RoughModel::fujii); }),
        row("fon", {"albedo", "roughness"},
            [](In in) {
                return RoughDiffuseT<T>{in.color("albedo"), in.unit("roughness"),
                                        RoughModel::fon};
            }),
        row("eon", {"albedo", "roughness"},
            [](In in) {
                return EonT<T>{in.color("albedo"), in.unit("roughness")};
            }),
        row("metal", {"metal"}, [](In in) { return MetalT<T>{in.metal()}; }),
        row("rough-metal", {"metal", "roughness"},
            [](In in) { return in.rough_metal(); }),
        row("full-rough-metal", {"metal", "roughness"},
            [](In in) { return in.full(in.rough_metal()); }),
        row("glossy", {"reflectance", "roughness"}, [](In in) { return in.gloss(); }),
        row("full-glossy", {"reflectance", "roughness"},
            [](In in) { return in.full(in.gloss()); }),
        row("rough-glass", {"ior", "roughness", "absorption"},
            [](In in) {
                return RoughGlassT<T>{in.ior(), in.roughness(), in.absorption()};
            }),
        row("thin-glass", {"ior", "tint"},
            [](In in) {
                return ThinGlassT<T>{in.ior(), in.color("tint")};
            }),
        row("soap-film", {"ior", "thickness_nm", "scale", "level", "up"},
            [](In in) { return read_film(in); }),
        row("checker",
            {"even", "odd", "map", "origin", "edge_u", "edge_v", "center", "scale",
             "columns", "rows"},
            [](In in) { return white<T>(read_checker<T>(in.field)); }),
        row("picture", {"file", "map", "origin", "edge_u", "edge_v", "center", "scale"},
            [](In in) {
                return white<T>(read_picture(in.field, in.shared.pictures));
            })};
}

// The types of the rows, each once: several names may have one type.
template <typename... M>
Materials<M...> listed(TypeList<M...>);
template <std::floating_point T, typename... Row>
constexpr auto materials_of(const std::tuple<Row...>&) {
    using In = const MaterialFields<T>&;
    return (TypeList<>{} + ... +
            TypeList<decltype(std::declval<Row>().read(std::declval<In>()))>{});
}

/// The materials that a scene file may name.
template <std::floating_point T>
using FileMaterialsT = decltype(listed(materials_of<T>(material_rows<T>())));

template <typename Scene, std::floating_point T = typename Scene::Scalar>
MaterialId read_material(const JsonField& field, SharedByMaterialsT<T>& shared,
                         Scene& scene) {
    const JsonField type = member(field, "type");
    MaterialId id{};
    const auto read = [&](const auto& row) {
        if (text(type) != row.name) return false;
        static constexpr std::string_view all[]{"type"};
        require_object(field, all, row.fields);
        id = made_of(field, [&] { return scene.add(row.read({field, shared})); });
        return true;
    };
    std::apply(
        [&](const auto&... row) {
            if (!(read(row) || ...)) require_one_of(type, {row.name...});
        },
        material_rows<T>());
    return id;
}

} // namespace detail

/// \}

} // namespace ljus
