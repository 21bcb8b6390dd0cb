#pragma once

/// \file ljus/path/thin_surfaces.hpp
/// \brief Sheets that light goes straight through: visibility with a colour.

#include <optional>

#include "ljus/math/random.hpp"
#include "ljus/scene/index.hpp"

namespace ljus {

/// \defgroup thin_surfaces Thin sheets
/// \brief Soap films: what they do not reflect goes straight on.
///
/// Going straight on is not scattering: a path keeps its class (a photon that came
/// straight from its lamp is still direct), its density, and its depth; only what the
/// sheet reflects is S. So the renderers do not see a sheet that a path goes through:
///
/// | question                          | answered by                                 |
/// |-----------------------------------|---------------------------------------------|
/// | how much of the lamp is seen      | visibility(): the product of T              |
/// | what a path or a photon meets     | meet(): chance decides between T and R      |
///
/// In a scene that lists no such material both are what they were without sheets, and
/// so is the code; in one that lists some and has none it is a comparison a ray.
/// \{

/// A material that light goes straight through, as far as it does not reflect it:
/// `pass_through(m, position, wo)` says how much. Its sample() reflects, and nothing else.
template <typename M>
concept ThinSurface = requires(const M& m, const Vec3T<typename M::Scalar>& v) {
    { pass_through(m, v, v) } -> std::same_as<RgbT<typename M::Scalar>>;
};

/// Whether a type of scene lists a thin sheet among its materials.
template <typename S>
inline constexpr bool lists_thin_surfaces = false;
/// Of a scene: whether one of its materials is.
template <typename ShapeList, Material... M>
inline constexpr bool
    lists_thin_surfaces<Scene<ShapeList, Materials<M...>>> = (ThinSurface<M> || ...);
/// Of an indexed scene: what its scene says.
template <typename S, typename Compute>
inline constexpr bool lists_thin_surfaces<IndexedScene<S, Compute>> =
    lists_thin_surfaces<S>;

/// Whether a scene has a thin sheet among its materials: the pass is on.
/// \param scene  The scene.
/// \return What has_thin_surfaces() of its scene says.
template <typename S, typename Compute>
[[nodiscard]] bool has_thin_surfaces(const IndexedScene<S, Compute>& scene) noexcept {
    return has_thin_surfaces(scene.scene);
}
/// Whether a scene has a thin sheet among its materials.
/// \param scene  The scene.
/// \return False also if it only lists such a type, and has none.
template <typename ShapeList, Material... M>
[[nodiscard]] bool
has_thin_surfaces(const Scene<ShapeList, Materials<M...>>& scene) noexcept {
    return ((ThinSurface<M> && !std::get<std::vector<M>>(scene.materials).empty()) ||
            ...);
}

/// What goes straight on through a surface.
/// \param scene    The scene.
/// \param surface  The surface.
/// \param way      Unit vector along the ray.
/// \return T for each channel; nothing if the surface is no thin sheet.
template <typename Scene, std::floating_point T>
[[nodiscard]] std::optional<RgbT<T>>
straight_on(const Scene& scene, const SurfaceT<T>& surface, const Vec3T<T>& way) {
    return scene.visit_material(
        surface.object.material, [&](const auto& m) -> std::optional<RgbT<T>> {
            if constexpr (ThinSurface<std::remove_cvref_t<decltype(m)>>)
                return pass_through(m, surface.point.position,
                                    to_local(surface.frame, -way));
            else
                return std::nullopt;
        });
}

/// So many sheets a ray goes through, at most; then the way counts as blocked.
inline constexpr int max_thin_surfaces = 1000;

/// How much of the light from one point arrives at another.
/// \param scene  The scene.
/// \param from   A point of a surface.
/// \param to     Another.
/// \return 0 if anything is between them, else the product of what the thin sheets on
///         the way let through.
/// \cost Without thin sheets that of occluded(); with them a closest_hit() a sheet, and
///       one more.
// [visibility]
template <typename Scene, std::floating_point T>
[[nodiscard]] RgbT<T> visibility(const Scene& scene, const SurfacePointT<T>& from,
                                 const SurfacePointT<T>& to) {
    if (!lists_thin_surfaces<Scene> || !has_thin_surfaces(scene))
        return RgbT<T>{occluded(scene, spawn_ray_to(from, to)) ? T(0) : T(1)};

    RgbT<T> through{T(1)};
    SurfacePointT<T> last = from;
    for (int sheets = 0; sheets < max_thin_surfaces; ++sheets) {
        const RayT<T> ray = spawn_ray_to(last, to);
        const auto hit = closest_hit(scene, ray);
        if (!hit) return through;
        const SurfaceT<T> surface = surface_at(scene, ray, *hit);
        const auto t = straight_on(scene, surface, glm::normalize(ray.direction));
        if (!t) break;
        through *= *t;
        last = surface.point;
    }
    return RgbT<T>{T(0)};
}
// [visibility]

/// The first surface that a path does not go straight through.
template <std::floating_point T>
struct MeetingT {
    SceneHitT<T> hit{};    ///< The surface; of the last part of the ray.
    T distance = T(0);     ///< The whole way to it.
    RgbT<T> through{T(1)}; ///< What came through the sheets on the way.
    T chance = T(1);       ///< Of being stopped here by a sheet.

    /// What of a path's light arrives, the chance made good.
    [[nodiscard]] constexpr RgbT<T> arrives() const noexcept {
        return through / chance;
    }
};

/// What a path meets. At a thin sheet chance decides, with the mean of R over the
/// channels, whether the path stops there, to be reflected, or goes on behind it.
/// \param scene   The scene.
/// \param ray     Its direction is a unit vector; becomes the last part of the way.
/// \param stream  A number is drawn for each thin sheet, and none without.
/// \return The surface; nothing if there is none.
// [meet]
template <typename Scene, std::floating_point T, typename Stream>
[[nodiscard]] std::optional<MeetingT<T>> meet(const Scene& scene, RayT<T>& ray,
                                              Stream& stream) {
    MeetingT<T> met;
    for (int sheets = 0; sheets < max_thin_surfaces; ++sheets) {
        const auto hit = closest_hit(scene, ray);
        if (!hit) return std::nullopt;
        met.hit = *hit;
        met.distance += hit->at.t;
        if (!lists_thin_surfaces<Scene> || !has_thin_surfaces(scene)) return met;

        const SurfaceT<T> surface = surface_at(scene, ray, *hit);
        const auto t = straight_on(scene, surface, ray.direction);
        if (!t) return met;
        const T stop = T(1) - (t->x + t->y + t->z) / T(3);
        if (next_1d<T>(stream) < stop) {
            met.chance = stop;
            return met;
        }
        met.through *= *t / (T(1) - stop);
        ray = spawn_ray(surface.point, ray.direction);
    }
    return std::nullopt;
}
// [meet]

/// \}

} // namespace ljus
