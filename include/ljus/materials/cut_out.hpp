#pragma once

/// \file ljus/materials/cut_out.hpp
/// \brief Materials with holes, cut out by a texture.

#include "ljus/materials/textured.hpp"

namespace ljus {

/// \defgroup cut_out Cut-outs
/// \brief Materials with holes, for example a leaf on a square. Chapter:
/// \ref ch_textures.
///
/// Rays and photons skip a hit in a hole \cite pharr2023.
/// \{

/// The holes of a CutOut material, given by a texture.
template <typename Texture>
struct Holes {
    static constexpr bool uses_uv = UsesUv<Texture>; ///< True if the mask uses uv.
    Texture mask{};      ///< The red channel is the opacity; see load_image().
    double cutoff = 0.5; ///< Opacity below which a point is in a hole; at least 0.
};

/// A material with holes. Its base must be opaque and may be textured.
template <Material Base, typename Texture>
using CutOut = Textured<Base, Holes<Texture>>;

/// Whether a point lies in a hole of the material or of its base.
/// \cost That of color_at() of the mask.
template <typename Base, typename Texture, std::floating_point T>
[[nodiscard]] bool is_open(const Textured<Base, Holes<Texture>>& cut,
                           const Vec3T<T>& position, const Vec2T<T>& uv) noexcept {
    static_assert(
        !Transparent<
            std::remove_cvref_t<decltype(material_at(cut.base, position, uv))>>,
        "A material with holes must be opaque: a path would get into a transparent "
        "body without crossing its surface.");
    if constexpr (CutOutMaterial<Base>)
        if (is_open(cut.base, position, uv)) return true;
    return double(color_at(cut.texture.mask, position, uv).x) < cut.texture.cutoff;
}

/// Whether a point of a textured material lies in a hole of its base.
template <CutOutMaterial Base, typename Texture, std::floating_point T>
[[nodiscard]] bool is_open(const Textured<Base, Texture>& textured,
                           const Vec3T<T>& position, const Vec2T<T>& uv) noexcept {
    return is_open(textured.base, position, uv);
}

/// Checks the mask and the cutoff.
/// \throws std::invalid_argument  with the name of the member that is not valid.
template <typename Texture>
void check(const Holes<Texture>& holes) {
    check(holes.mask);
    require(holes.cutoff >= 0 && std::isfinite(holes.cutoff), "holes.cutoff",
            holes.cutoff, "finite and at least 0");
}

/// \}

} // namespace ljus
