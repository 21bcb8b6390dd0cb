#pragma once

/// \file ljus/render/plain_photon_mapping.hpp
/// \brief The report's second pass in one page of code: the plain twin of
/// photon_mapping.hpp.

#include <utility>

#include "ljus/path/direct_light.hpp"
#include "ljus/photons/density_estimate.hpp"

namespace ljus {

/// \addtogroup photon_mapping
/// \{

/// A plain photon mapper: a caustics map and its world. The world must outlive the
/// mapper.
template <typename W>
class PlainPhotonMapper {
public:
    using Scalar = typename W::Scalar; ///< The precision.
    using Stream = RandomStream;       ///< The random stream that render() passes.

    /// \param world     Must outlive the mapper.
    /// \param caustics  Photons of the first pass, L S+ D.
    /// \param how       How the caustics map is queried.
    /// \throws std::invalid_argument  if a setting of the query is out of range.
    PlainPhotonMapper(WorldRef<W> world, PhotonMapT<Scalar> caustics,
                      const DensityEstimateSettings& how = {})
        : world_(world), caustics_(std::move(caustics)), how_(how) {
        check(how);
    }
    /// The world that is rendered.
    [[nodiscard]] const W& world() const noexcept { return world_.get(); }
    /// The photons.
    [[nodiscard]] const PhotonMapT<Scalar>& caustics() const noexcept {
        return caustics_;
    }
    /// How the caustics map is queried.
    [[nodiscard]] const DensityEstimateSettings& how() const noexcept { return how_; }

private:
    WorldRef<W> world_;
    PhotonMapT<Scalar> caustics_;
    DensityEstimateSettings how_;
};
/// Deduces the type of the world.
template <typename W>
PlainPhotonMapper(const W&, PhotonMapT<typename W::Scalar>,
                  const DensityEstimateSettings& = {}) -> PlainPhotonMapper<W>;

/// The radiance that one camera path finds, by emission, shadow rays, the caustics map
/// and one indirect ray at each of at most 1000 surfaces.
///
/// The plain mapper ignores media, thin surfaces, shading normals, dispersion and
/// motion. In a scene without these its expected value is that of PhotonMapper with
/// IndirectLight::rays; only the noise differs.
/// \param mapper   World and map.
/// \param ray      A primary ray.
/// \param context  The random stream of this path; counts its rays.
/// \return Radiance, in W/(m^2 sr).
// [plain path]
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> radiance(const PlainPhotonMapper<W>& mapper, RayT<T> ray,
                               Context& context) {
    const W& world = mapper.world();
    RgbT<T> sum{T(0)}, throughput{T(1)};
    bool met_diffuse = false, goes_on = true;
    for (int depth = 1; goes_on && depth <= 1000; ++depth) {
        const auto hit = closest_hit(world, ray);
        if (!hit) {
            if (!met_diffuse) sum += throughput * sky_radiance(world, ray.direction);
            break;
        }
        const VertexT<T> x = vertex_at(world, ray, *hit);
        if (x.emits() && !met_diffuse) // E S* L
            sum += throughput * x.object.emission;
        // [plain path]
        // [plain surface]
        goes_on = visit_material_at(world, x, [&](const auto& material) {
            if (has(lobes(material), Lobes::non_specular)) {
                RgbT<T> light{T(0)};
                for (std::uint32_t lamp = 0; lamp < world.light_count(); ++lamp) // D L
                    light +=
                        direct_light(world, lamp, x, material,
                                     next_2d<T>(context.stream), {}, context.counts);
                light += estimate_radiance(mapper.caustics(), x, material, // D S+ L
                                           x.wo, mapper.how(), light_kinds,
                                           context.counts.map_photons);
                sum += throughput * light;
            }
            const auto next =
                sample(material, x.wo, next_3d<T>(context.stream), Transport::radiance);
            if (!next) return false;
            met_diffuse = met_diffuse || !next->specular;
            throughput *= next->weight; // f cos / pdf
            ray = spawn_ray(x.point, to_world(x.frame, next->wi));
            return depth < 5 || survives(throughput, T(1), next_1d<T>(context.stream));
        });
    }
    return sum;
}
// [plain surface]

/// \}

} // namespace ljus
