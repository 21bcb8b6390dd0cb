#pragma once

/// \file ljus/materials/soap_film.hpp
/// \brief A soap film: a thin sheet with the colours of interference.

#include <algorithm>

#include "ljus/materials/material.hpp"
#include "ljus/optics/film_table.hpp"
#include "ljus/optics/reflection.hpp"

namespace ljus {

/// \defgroup soap_film Soap films
/// \brief The soap bubble of figure 4. Chapter: \ref ch_soap_film.
///
/// The film is a *thin sheet*: shadow rays pass straight through it and are tinted;
/// other paths pass or are reflected, chosen at random, see \ref next_vertex. sample()
/// returns the reflection, and pass_through() the transmittance.
/// \{

/// The function that computes the colours of a film.
enum class FilmColor : std::uint8_t {
    table,             ///< From a table over angle and thickness, by look_up().
    three_wavelengths, ///< At one wavelength per channel, by film_three().
    preintegrated      ///< Integrated in closed form, by film_preintegrated().
};

/// A soap film in air. Its thickness falls with the height z, as in films that hang
/// under their own weight \cite pasquet2022 : \f$ d(z) = d_0\, e^{-z/h} \f$, where d_0
/// is `thickness` and h is `scale`.
template <std::floating_point T>
struct SoapFilmT {
    using Scalar = T;                           ///< The precision of its numbers.
    static constexpr bool only_specular = true; ///< All lobes are specular.
    T thickness = T(400); ///< d_0, the thickness at z = 0, in nm; at most 1 mm.
    T index = T(1.33);    ///< Index of the liquid, at least 1.
    T scale = T(0); ///< The h of the formula, in scene units; 0: constant thickness.
    Vec3T<T> level{T(0)}; ///< A point at height z = 0.
    /// The upward direction, against gravity; unit vector.
    Vec3T<T> up{T(0), T(0), T(1)};
    FilmColor color = FilmColor::preintegrated; ///< How the colours are computed.
    /// For FilmColor::table: the result of bake_film_table(index).
    FilmTableT<T> table{};
};
using SoapFilm = SoapFilmT<float>; ///< SoapFilmT in float.

namespace detail {

/// The largest thickness of a film, in nm: 1 mm.
template <std::floating_point T>
inline constexpr T max_film_thickness = T(1e6);

} // namespace detail

/// The thickness of a film at a point, in nm, within [0, 1 mm].
template <std::floating_point T>
[[nodiscard]] T thickness_at(const SoapFilmT<T>& film,
                             const Vec3T<T>& position) noexcept {
    if (film.scale == T(0) || film.thickness == T(0)) return film.thickness;
    const T height = glm::dot(position - film.level, film.up);
    const T thickness = film.thickness * std::exp(-height / film.scale);
    return thickness < detail::max_film_thickness<T> ? thickness
                                                     : detail::max_film_thickness<T>;
}

/// The reflectance of a film of a thickness in nm, for each channel, in [0, 1].
/// `cos_theta` is the cosine between ray and normal, of either sign.
template <std::floating_point T>
[[nodiscard]] RgbT<T> reflectance(const SoapFilmT<T>& film, T cos_theta,
                                  T thickness) noexcept {
    const T c = std::min(std::abs(cos_theta), T(1));
    switch (film.color) {
    case FilmColor::table:
        return look_up(film.table, c, thickness);
    case FilmColor::three_wavelengths:
        return film_three(c, film.index, thickness);
    case FilmColor::preintegrated:
        break;
    }
    return into_gamut(film_preintegrated(c, film.index, thickness));
}

/// A film at one point, as a material of one thickness.
template <std::floating_point T>
struct FilmPointT {
    using Scalar = T;                           ///< The precision of its numbers.
    static constexpr bool only_specular = true; ///< All lobes are specular.
    const SoapFilmT<T>& film;                   ///< The film.
    T thickness;                                ///< Thickness at the point, in nm.
};

/// Checks nothing, because the film has been checked.
template <std::floating_point T>
void check(const FilmPointT<T>&) noexcept {}

/// The material of a film at a point; see material_at(). The film must outlive the
/// result.
template <std::floating_point T>
[[nodiscard]] FilmPointT<T> at_point(const SoapFilmT<T>& film, const Vec3T<T>& position,
                                     const Vec2T<T>& /*uv*/) noexcept {
    return {film, thickness_at(film, position)};
}

/// The transmittance of a film at a point, in each channel. A material with this
/// function is a thin sheet.
template <std::floating_point T>
[[nodiscard]] RgbT<T> pass_through(const SoapFilmT<T>& film, const Vec3T<T>& position,
                                   const Vec3T<T>& wo) noexcept {
    return RgbT<T>{T(1)} - reflectance(film, wo.z, thickness_at(film, position));
}

/// Returns the mirror direction. Its weight is the reflectance at the point.
/// \report{Figure 4}
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const FilmPointT<T>& point, const Vec3T<T>& wo, const Vec3T<T>&,
       Transport /*transport*/, Lobes which = Lobes::all) noexcept {
    if (!has(which, Lobes::specular) || !(wo.z > T(0) || wo.z < T(0)))
        return std::nullopt;
    return specular_sample(reflect(wo), reflectance(point.film, wo.z, point.thickness));
}

/// Samples a film as if its thickness were `thickness` everywhere.
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const SoapFilmT<T>& film, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport transport, Lobes which = Lobes::all) noexcept {
    return sample(FilmPointT<T>{film, film.thickness}, wo, u, transport, which);
}

/// Requires every member to be within its range and, for FilmColor::table, a table that
/// was made for the index of the film.
template <std::floating_point T>
void check(const SoapFilmT<T>& film) {
    require(film.thickness >= T(0) && film.thickness <= detail::max_film_thickness<T>,
            "soap_film.thickness", film.thickness, "within [0, 1e6] nm");
    require(film.index >= T(1) && film.index <= T(1000), "soap_film.index", film.index,
            "within [1, 1000]");
    require(std::isfinite(film.scale) && film.scale >= T(0), "soap_film.scale",
            film.scale, "finite and at least 0");
    require_finite("soap_film.level", film.level);
    require(std::abs(glm::length(film.up) - T(1)) < T(1e-4), "soap_film.up", film.up,
            "of length 1");
    require(film.color != FilmColor::table || film.table.index == film.index,
            "soap_film.table.index", film.table.index,
            "soap_film.index: make it with bake_film_table(index)");
}

/// \}

} // namespace ljus
