#pragma once

/// \file examples/common/plain_photon_mapper.hpp
/// \brief The second pass in one screen: the plain twin of photon_mapping.hpp.

#include "ljus/path/direct_light.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/photons/density_estimate.hpp"
#include "ljus/photons/photon_map.hpp"
#include "ljus/scene/index.hpp"

namespace examples {

/// A scene and its caustics map, both of which must outlive it.
template <ljus::SceneLike S>
struct PlainPhotonMapper {
    using Stream = ljus::RandomStream;   ///< What render() gives it to draw from.
    ljus::detail::IndexedT<S> scene;     ///< What is rendered.
    const ljus::PhotonMap& caustics;     ///< Of the first pass.
    ljus::DensityEstimateSettings how{}; ///< The disc of an estimate.
};

/// The radiance that one camera path finds: emission, shadow rays, caustics map, and one
/// ray further.
///
/// It knows no media, no thin surfaces and no shading normals. The mean is that of
/// ljus::PhotonMapper with IndirectLight::rays; the noise is not.
/// \param mapper  Scene and map.
/// \param ray     A primary ray.
/// \param stream  The numbers of this path.
/// \param counts  Counts the rays.
/// \return Radiance, W/(m^2 sr).
// [plain path]
template <ljus::SceneLike S, typename Log = ljus::NoLog>
[[nodiscard]] ljus::Rgb radiance(const PlainPhotonMapper<S>& mapper, ljus::Ray ray,
                                 ljus::RandomStream& stream, ljus::Counts& counts,
                                 Log&& = {}) {
    using namespace ljus;
    const auto alone = [](const LightSampleT<float>&, const Vec3&) { return 1.0f; };
    Rgb sum{0}, throughput{1};
    bool met_diffuse = false, goes_on = true;
    for (int depth = 1; goes_on; ++depth) {
        const auto hit = closest_hit(mapper.scene, ray);
        if (!hit) break;
        const Vertex x = vertex_at(mapper.scene, ray, *hit);
        if (x.emits() && !met_diffuse) // E S* L
            sum += throughput * x.object.emission;
        // [plain path]
        // [plain surface]
        goes_on = visit_material_at(mapper.scene, x, [&](const auto& material) {
            if (has(lobes(material), Lobes::non_specular)) {
                Rgb light{0};
                for (const Light& lamp : mapper.scene.lights) // D L
                    light += direct_light(mapper.scene, lamp, x, material,
                                          next_2d(stream), alone, counts);
                light += estimate_radiance(mapper.caustics, x, material, x.wo, // D S+ L
                                           mapper.how, light_kinds, counts.map_photons);
                sum += throughput * light;
            }
            const auto next =
                sample(material, x.wo, next_3d(stream), Transport::radiance);
            if (!next) return false;
            met_diffuse = met_diffuse || !next->specular;
            throughput *= next->weight; // f cos / pdf
            ray = spawn_ray(x.point, to_world(x.frame, next->wi));
            return depth < 5 || survives(throughput, 1.0f, next_1d(stream));
        });
    }
    return sum;
}
// [plain surface]

} // namespace examples
