#pragma once

/// \file ljus/radiosity/patch_rays.hpp
/// \brief Rays from and between patches, for form factors without a closed form.

#include <optional>
#include <span>

#include "ljus/math/frame.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/sampling_pattern.hpp"
#include "ljus/radiosity/patches.hpp"

namespace ljus {

/// \defgroup patch_rays Rays between patches
/// \brief Section 2.2 of the report: "a form factor, which describes patch visibility".
/// Chapter:
/// \ref ch_radiosity.
/// \{

namespace detail {

/// Samples a point of a patch, uniformly over its area, with the normal of the patch.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_patch(const W& world, const Patches& all,
                                            std::uint32_t number, const Vec2T<T>& u) {
    const PatchGrid& grid = all.grids[all.patches[number].grid];
    return world.visit_shape(grid.object, [&](const auto& shape) {
        if constexpr (Cuttable<std::remove_cvref_t<decltype(shape)>>)
            return sample_cell(grid, shape, number - grid.first, u);
        else
            return SurfacePointT<T>{}; // not reached: the shape has no patches
    });
}

/// The index of the patch that a ray has hit; nothing if the hit side has no patches.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<std::uint32_t> patch_at(const W& world, const Patches& all,
                                                    const RayT<T>& ray,
                                                    const SceneHitT<T>& hit) {
    const HitSideT<T> side = side_of(world, ray, hit);
    const std::uint32_t number =
        all.grid_of[hit.object.type][hit.object.index][side.back];
    if (number == no_grid) return std::nullopt;
    const PatchGrid& grid = all.grids[number];
    return grid.first + cell_of(grid, place_on(grid.kind, hit.at, side.outer));
}

} // namespace detail

/// Casts cosine-weighted rays from a patch \cite malley1988. The fraction of the rays
/// that hit another patch is the form factor to that patch, including visibility. A ray
/// that hits patch j adds the area of the casting patch, divided by the number of rays,
/// to element j of `row`.
// [shoot_rays]
template <AnyWorld W>
void shoot_rays(const W& world, const Patches& all, std::uint32_t number, int rays,
                std::uint64_t seed, std::span<double> row) {
    using T = typename W::Scalar;
    const detail::Strata strata = detail::strata_for(rays);
    const std::uint64_t key = mix_bits(seed) ^ number;
    const double share = all.patches[number].area / rays;
    for (int i = 0; i < rays; ++i) {
        RandomStream stream = random_stream(seed, Pass::form_factors, number,
                                            static_cast<std::uint64_t>(i));
        // Positions and directions are both stratified. They are paired at random.
        const auto other = static_cast<int>(detail::shuffled(
            static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(rays), key));
        const Vec2T<T> place =
            detail::stratified(strata, other, ~key, next_2d<T>(stream));
        const auto point = detail::sample_patch(world, all, number, place);
        const Vec2T<T> u = detail::stratified(strata, i, key, next_2d<T>(stream));
        const Vec3T<T> way =
            to_world(frame_around(point.normal), sample_cosine_hemisphere(u));
        const RayT<T> ray = spawn_ray(point, way);
        const auto hit = closest_hit(world, ray);
        if (!hit) continue;
        if (const auto there = detail::patch_at(world, all, ray, *hit))
            row[*there] += share;
    }
}
// [shoot_rays]

namespace detail {

/// The visible fraction of the exchange between two patches, by one or more rays
/// between random points of both. The weight of a ray is the product of the cosines at
/// its ends, divided by its squared length.
template <AnyWorld W>
[[nodiscard]] double visible_fraction(const W& world, const Patches& all,
                                      std::uint32_t one, std::uint32_t two, int rays,
                                      std::uint64_t seed) {
    using T = typename W::Scalar;
    const Strata strata = strata_for(rays);
    const std::uint64_t pair = (std::uint64_t(one) << 32) + two;
    double total = 0, visible = 0;
    for (int i = 0; i < rays; ++i) {
        RandomStream stream = random_stream(seed, Pass::form_factors, pair,
                                            static_cast<std::uint64_t>(i));
        const Vec2T<T> u = stratified(strata, i, pair, next_2d<T>(stream));
        // The other patch has the same strata in another order.
        const auto other = static_cast<int>(shuffled(
            static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(rays), ~pair));
        const Vec2T<T> v = stratified(strata, other, ~pair, next_2d<T>(stream));
        const auto a = sample_patch(world, all, one, u);
        const auto b = sample_patch(world, all, two, v);
        const Vec3T<T> way = b.position - a.position;
        const double cosines =
            double(glm::dot(way, a.normal)) * -double(glm::dot(way, b.normal));
        const double distance2 = double(glm::dot(way, way));
        if (!(glm::dot(way, a.normal) > T(0) && cosines > 0)) continue;
        const double weight = cosines / (distance2 * distance2);
        total += weight;
        if (!occluded(world, spawn_ray_to(a, b))) visible += weight;
    }
    return total > 0 ? visible / total : 0;
}

} // namespace detail

/// \}

} // namespace ljus
