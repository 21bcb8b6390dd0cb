#pragma once

/// \file ljus/materials/material.hpp
/// \brief The interface of a material, the type of its samples, and cosine-weighted
/// sampling for matt materials.

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

#include "ljus/hook.hpp"
#include "ljus/math/sampling.hpp"
#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup bsdf Materials
/// \brief Section 3.2.1 of the report: how a surface scatters light.
///
/// A material is a struct with public members and a type `Scalar`. Five free functions
/// belong to it. Their directions are given in a local frame whose z axis is the
/// shading normal; z > 0 is outside. `wo` (outgoing) and `wi` (incident) are unit
/// vectors that point *away* from the surface: light comes from `wi` and leaves along
/// `wo`.
///
///     Lobes lobes(m);                   // the kinds of lobes of m
///     Rgb   evaluate(m, wo, wi);        // f in 1/sr, no cosine, no delta lobes
///     float pdf(m, wo, wi, which);      // density of sample(), per steradian
///     std::optional<BsdfSample> sample(m, wo, u, transport, which);
///     void  check(m);                   // throws std::invalid_argument
///
/// `u` is a point of [0,1)^3; its z chooses a lobe. `transport` says whether the path
/// carries radiance or flux. `which` is the set of lobes to sample, by default all.
/// sample() returns nothing if `wo` is parallel to the surface, if the material has no
/// lobe of `which`, or if the surface is black.
///
/// A material may have further functions. The table gives the purpose of each, and what
/// happens without it:
///
/// \snippet{lineno} ljus/materials/material.hpp material hooks
///
/// Radiosity also uses diffuse_albedo(m), and treats a material without it as black.
/// \{

/// A set of lobes. A *specular* lobe scatters into a single direction (a delta). All
/// other lobes, even glossy ones, have a finite BSDF and a pdf, and count as D in
/// Heckbert's notation.
enum class Lobes : std::uint8_t {
    none = 0,         ///< No lobe.
    diffuse = 1,      ///< Scatters into all directions.
    glossy = 2,       ///< A blurred mirror: scatters around one direction.
    specular = 4,     ///< Mirrors and clear boundaries.
    non_specular = 3, ///< The lobes of evaluate(): diffuse and glossy.
    all = 7,          ///< Every lobe.
};

/// The lobes that are in both sets.
[[nodiscard]] constexpr Lobes operator&(Lobes a, Lobes b) noexcept {
    return static_cast<Lobes>(static_cast<unsigned>(a) & static_cast<unsigned>(b));
}

/// The lobes that are in either set.
[[nodiscard]] constexpr Lobes operator|(Lobes a, Lobes b) noexcept {
    return static_cast<Lobes>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

/// True if `set` contains at least one lobe of `part`.
[[nodiscard]] constexpr bool has(Lobes set, Lobes part) noexcept {
    return (set & part) != Lobes::none;
}

/// The quantity that a path carries. Radiance that enters a body of index n from air is
/// multiplied by n^2, because refraction narrows the cone of the light. The flux of a
/// photon does not change \cite veach1997.
enum class Transport : std::uint8_t {
    radiance, ///< Radiance, on paths from the camera.
    flux,     ///< Flux, on the paths of photons.
};

/// One scattered direction.
template <std::floating_point T>
struct BsdfSampleT {
    Vec3T<T> wi{T(0), T(0), T(1)}; ///< Incident direction; unit vector.
    RgbT<T> weight{T(0)};          ///< The factor of the throughput: f |wi.z| / pdf.
    /// Density per steradian, including the probability of the lobe; 0 for a delta.
    T pdf = T(0);
    bool specular = false; ///< True if `wi` is sampled from a delta lobe.
    /// The factor in `weight` that is due to refraction of radiance: (n_o/n_i)^2, with
    /// the indices n_o on the side of `wo` and n_i on the side of `wi`. It is 1 for
    /// reflection and for flux. Russian roulette leaves it out of the probability of
    /// survival.
    T eta_scale = T(1);
};
using BsdfSample = BsdfSampleT<float>; ///< BsdfSampleT in float.

/// A sample of a delta lobe; its pdf is 0. `share` is the fraction of light that the
/// lobe scatters, divided by the probability of the lobe.
template <std::floating_point T>
[[nodiscard]] constexpr BsdfSampleT<T>
specular_sample(const Vec3T<T>& wi, const RgbT<T>& share, T eta_scale = T(1)) noexcept {
    return {.wi = wi,
            .weight = share * eta_scale,
            .pdf = T(0),
            .specular = true,
            .eta_scale = eta_scale};
}

/// A sample of a lobe with a density. `weight` and `density` are BsdfSampleT::weight
/// and BsdfSampleT::pdf.
template <std::floating_point T>
[[nodiscard]] constexpr BsdfSampleT<T>
diffuse_sample(const Vec3T<T>& wi, const RgbT<T>& weight, T density) noexcept {
    return {.wi = wi, .weight = weight, .pdf = density, .specular = false};
}

/// A material with specular lobes only. It declares
/// `static constexpr bool only_specular = true`. It needs no lobes(), evaluate() and
/// pdf() of its own, because those below serve all such materials.
template <typename M>
concept OnlySpecular = std::floating_point<typename M::Scalar> && M::only_specular;

/// The lobes of an OnlySpecular material: Lobes::specular.
template <OnlySpecular M>
[[nodiscard]] constexpr Lobes lobes(const M&) noexcept {
    return Lobes::specular;
}

/// The BSDF of an OnlySpecular material without its delta lobes: 0.
template <OnlySpecular M>
[[nodiscard]] constexpr RgbT<typename M::Scalar>
evaluate(const M&, const Vec3T<typename M::Scalar>& /*wo*/,
         const Vec3T<typename M::Scalar>& /*wi*/) noexcept {
    return RgbT<typename M::Scalar>{0};
}

/// The density of an OnlySpecular material without its delta lobes: 0.
template <OnlySpecular M>
[[nodiscard]] constexpr typename M::Scalar
pdf(const M&, const Vec3T<typename M::Scalar>& /*wo*/,
    const Vec3T<typename M::Scalar>& /*wi*/, Lobes = Lobes::all) noexcept {
    return 0;
}

/// A material, with the functions of \ref bsdf.
template <typename M>
concept Material = std::floating_point<typename M::Scalar> &&
    requires(const M& m, const Vec3T<typename M::Scalar>& v, Transport transport,
             Lobes which) {
    { lobes(m) } -> std::same_as<Lobes>;
    { evaluate(m, v, v) } -> std::same_as<RgbT<typename M::Scalar>>;
    { pdf(m, v, v, which) } -> std::same_as<typename M::Scalar>;
    {
        sample(m, v, v, transport, which)
        } -> std::same_as<std::optional<BsdfSampleT<typename M::Scalar>>>;
    check(m);
};

/// \name A material around another one
/// A wrapper scatters like its base. It needs check(), the functions that it adds to
/// the base, and the functions of material_hooks() that its base has, with the
/// exceptions of keeps_hooks.
/// \{

/// A material that declares `static constexpr bool scatters_as_base = true` and has a
/// member `base`, which is a material. Nested and Textured are such wrappers.
template <typename M>
concept MaterialWrapper = std::floating_point<typename M::Scalar> &&
    requires(const M& m) {
    requires M::scatters_as_base;
    requires Material<std::remove_cvref_t<decltype(m.base)>>;
};

/// The lobes of the base.
template <MaterialWrapper M>
[[nodiscard]] constexpr Lobes lobes(const M& m) noexcept {
    return lobes(m.base);
}

/// The BSDF of the base, in 1/sr, without the cosine.
template <MaterialWrapper M, std::floating_point T>
[[nodiscard]] RgbT<T> evaluate(const M& m, const Vec3T<T>& wo,
                               const Vec3T<T>& wi) noexcept {
    return evaluate(m.base, wo, wi);
}

/// The density of the base's sample(), per steradian.
template <MaterialWrapper M, std::floating_point T>
[[nodiscard]] T pdf(const M& m, const Vec3T<T>& wo, const Vec3T<T>& wi,
                    Lobes which = Lobes::all) noexcept {
    return pdf(m.base, wo, wi, which);
}

/// Samples the base.
template <MaterialWrapper M, std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const M& m, const Vec3T<T>& wo, const Vec3T<T>& u, Transport transport,
       Lobes which = Lobes::all) noexcept {
    return sample(m.base, wo, u, transport, which);
}

/// \}

/// The absorption coefficient inside, 0 per scene unit, for a material that does not
/// provide its own.
template <typename M>
requires std::floating_point<typename M::Scalar>
[[nodiscard]] constexpr RgbT<typename M::Scalar> absorption(const M&) noexcept {
    return RgbT<typename M::Scalar>{0};
}

/// A material with a medium inside: it provides absorption().
template <typename M>
concept MayAbsorb = requires(const detail::Own<M>& m) {
    absorption(m);
};

/// The material of a transparent body. It provides `refractive_index(m)`, which returns
/// 0 if m happens to be opaque. material_at() must give a material with a member
/// `index` for it.
template <typename M>
concept Refractive = requires(const M& m) {
    { refractive_index(m) } -> std::same_as<typename M::Scalar>;
};

/// A copy of the material `m` for a surface that has another body in front of it in
/// place of air. `outside` is the index of the other body. The index of the copy is
/// relative to it.
template <Refractive M>
[[nodiscard]] constexpr M relative_to(M m, typename M::Scalar outside) noexcept {
    m.index /= outside;
    return m;
}

/// A material whose index depends on the wavelength, like glass that makes a rainbow.
/// `at_wavelength(m, nm)` returns the material at one wavelength in nanometres. A path
/// that meets such a material samples one wavelength and keeps it; see \ref dispersion.
template <typename M>
concept Dispersive = requires(const M& m, typename M::Scalar nm) {
    at_wavelength(m, nm);
};

/// The material of a body that light can enter: a Refractive one, or one that provides
/// absorption().
template <typename M>
concept Transparent = Refractive<M> || MayAbsorb<M>;

/// The priority where transparent bodies overlap, 0, for a material that does not
/// provide its own; see \ref nested_bodies.
template <typename M>
requires std::floating_point<typename M::Scalar>
[[nodiscard]] constexpr int priority(const M&) noexcept {
    return 0;
}

/// A material that provides priority().
template <typename M>
concept HasPriority = requires(const detail::Own<M>& m) {
    priority(m);
};

/// Whether a material scatters light through its surface into a lobe with a density, as
/// rough glass does: it is Refractive and has a glossy lobe. A vertex on such a
/// material receives light from lamps on both sides of the surface.
template <typename M>
[[nodiscard]] constexpr bool scatters_through([[maybe_unused]] const M& m) noexcept {
    if constexpr (Refractive<M>)
        return has(lobes(m), Lobes::glossy);
    else
        return false;
}

/// The emitted radiance, 0 W/(m^2 sr), of a material that does not provide its own.
template <typename M>
requires std::floating_point<typename M::Scalar>
[[nodiscard]] constexpr RgbT<typename M::Scalar> emission(const M&) noexcept {
    return RgbT<typename M::Scalar>{0};
}

/// The material of a lamp that shows a picture on a quad or a disc.
/// `emission_picture(m)` returns the picture, whose colour at (u, v) is multiplied by
/// emission(). Such a lamp needs ljus/lights/picture_light.hpp.
template <typename M>
concept ShowsPicture = requires(const M& m) {
    emission_picture(m).pixels;
};

/// The material at a point: `at_point(m, position, uv)` if the material provides that
/// function, otherwise m itself. m must outlive the result. `uv` is from
/// texture_coordinates(), and is (0, 0) unless the material declares
/// `static constexpr bool uses_uv = true`.
template <typename M>
[[nodiscard]] constexpr decltype(auto)
material_at(const M& m, const Vec3T<typename M::Scalar>& position,
            const Vec2T<typename M::Scalar>& uv) noexcept {
    if constexpr (requires { at_point(m, position, uv); })
        return at_point(m, position, uv);
    else
        return (m);
}

/// A material with holes: `is_open(m, position, uv)` is true for a point in a hole.
/// Rays go through a hole as if nothing were there.
template <typename M>
concept CutOutMaterial = requires(const M& m, const Vec3T<typename M::Scalar>& position,
                                  const Vec2T<typename M::Scalar>& uv) {
    { is_open(m, position, uv) } -> std::same_as<bool>;
};

/// A material that turns the shading normal. `normal_at(m, uv)` returns the new normal,
/// of any length. Its x component is along u of the shape, and its z component along
/// the shading normal of the shape.
template <typename M>
concept NormalMapped = requires(const M& m, const Vec2T<typename M::Scalar>& uv) {
    { normal_at(m, uv) } -> std::same_as<Vec3T<typename M::Scalar>>;
};

/// True if two directions point to the same side of the surface. False if one of them
/// is parallel to the surface.
template <std::floating_point T>
[[nodiscard]] constexpr bool same_side(const Vec3T<T>& a, const Vec3T<T>& b) noexcept {
    // The product of a.z and b.z could underflow.
    return (a.z > T(0) && b.z > T(0)) || (a.z < T(0) && b.z < T(0));
}

/// Whether a material scatters almost like a mirror or clear glass: it has a glossy
/// lobe and no diffuse lobe, and a typical sample has a density above 1 per steradian,
/// three times the highest density of a Lambertian surface. This holds for a GlossyT of
/// roughness below 0.42, and for a RoughGlassT of index 1.5 and roughness below 0.84.
/// \cost One call of sample() for a material with a glossy lobe.
template <Material M>
[[nodiscard]] bool nearly_specular(const M& m) noexcept {
    using T = typename M::Scalar;
    if (!has(lobes(m), Lobes::glossy) || has(lobes(m), Lobes::diffuse)) return false;
    const auto typical =
        sample(m, Vec3T<T>{T(0.6), T(0), T(0.8)}, Vec3T<T>{T(0.5), T(0.5), T(0.5)},
               Transport::radiance, Lobes::glossy);
    return typical && typical->pdf > T(1);
}

namespace detail {

template <Material M>
[[nodiscard]] constexpr auto material_hooks() noexcept {
    using V = Vec3T<typename M::Scalar>;
    using Uv = Vec2T<typename M::Scalar>;
    using O = Own<M>;
    // clang-format off
    return std::array{
        // [material hooks]
        Hook{"absorption", "a medium inside", "clear",
             requires(O m) { absorption(m); }},
        Hook{"refractive_index", "contact with another body", "opaque in contact",
             requires(O m) { refractive_index(m); }},
        Hook{"priority", "overlaps other bodies", "0",
             requires(O m) { priority(m); }},
        Hook{"emission", "its own light", "black",
             requires(O m) { emission(m); }},
        Hook{"emission_picture", "a lamp that shows a picture", "even light",
             requires(O m) { emission_picture(m); }},
        Hook{"at_point", "varies over the surface", "the same anywhere",
             requires(O m, V position, Uv uv) { at_point(m, position, uv); }},
        Hook{"uses_uv", "at_point() with uv", "uv is 0",
             requires { requires M::uses_uv; }},
        Hook{"is_open", "holes that rays go through", "solid",
             requires(O m, V position, Uv uv) { is_open(m, position, uv); }},
        Hook{"normal_at", "a normal by a picture", "the shape's",
             requires(O m, Uv uv) { normal_at(m, uv); }},
        Hook{"split", "a path that splits", "one branch at random",
             requires(O m, V wo, Transport way) { split(m, wo, way); }},
        Hook{"pass_through", "light that goes straight on", "opaque",
             requires(O m, V position, V wo) { pass_through(m, position, wo); }},
        Hook{"at_wavelength", "dispersion", "one index for all light",
             requires(O m, typename M::Scalar nm) { at_wavelength(m, nm); }},
        Hook{"only_specular", "no evaluate(), no pdf()", "write both",
             requires { M::only_specular; }},
        // [material hooks]
    };
// clang-format on
}

/// Whether a wrapper has every optional function of its base; true for a material that
/// is no wrapper. Two are not required: only_specular, and split() of a wrapper whose
/// at_point() returns the base.
template <typename M>
inline constexpr bool keeps_hooks = true;
template <MaterialWrapper M>
inline constexpr bool keeps_hooks<M> = [] {
    constexpr auto own = material_hooks<M>();
    constexpr auto base = material_hooks<std::remove_cvref_t<decltype(M::base)>>();
    bool at_point = false, all = true;
    for (std::size_t i = 0; i < own.size(); ++i) {
        const std::string_view name = own[i].name;
        at_point |= name == "at_point" && own[i].provided;
        all &= own[i].provided || !base[i].provided || name == "only_specular" ||
               (name == "split" && at_point);
    }
    return all;
}();

} // namespace detail

/// \}

/// \defgroup cosine_lobe Sampling matt surfaces
/// \brief Section 3.2.4 of the report: cosine-weighted sampling, which suits every BRDF
/// that is close to a constant.
/// \{

/// The density of sample_cosine_lobe().
/// \return |wi.z|/pi per steradian on the side of `wo`; 0 on the other side, or if
///         `which` lacks Lobes::diffuse.
/// \report{Section 3.2.4}
template <std::floating_point T>
[[nodiscard]] constexpr T pdf_cosine_lobe(const Vec3T<T>& wo, const Vec3T<T>& wi,
                                          Lobes which) noexcept {
    if (!has(which, Lobes::diffuse) || !same_side(wo, wi)) return T(0);
    return (wi.z < T(0) ? -wi.z : wi.z) * std::numbers::inv_pi_v<T>;
}

/// Samples a direction on the side of `wo`, with the density pdf_cosine_lobe(). u.z is
/// not used.
/// \return The sample with a weight of 1, which is right for the BRDF 1/pi. A caller
///         with another BRDF f sets the weight to pi f. Nothing if `wo` is parallel to
///         the surface, or if `which` lacks Lobes::diffuse.
/// \cost One sine, one cosine, one square root and one division.
/// \report{Section 3.2.4}
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample_cosine_lobe(const Vec3T<T>& wo, const Vec3T<T>& u, Lobes which) noexcept {
    std::optional<BsdfSampleT<T>> next;
    if (!has(which, Lobes::diffuse) || !(wo.z > T(0) || wo.z < T(0))) return next;
    next.emplace(); // filled in place, to save a copy
    Vec3T<T>& wi = next->wi;
    wi = sample_cosine_hemisphere(Vec2T<T>{u.x, u.y});
    next->pdf = pdf_cosine_hemisphere(wi);
    wi.z = std::copysign(wi.z, wo.z);
    next->weight = RgbT<T>{T(1)};
    return next;
}

/// \}

} // namespace ljus
