#pragma once

/// \file support/mesh_rooms.hpp
/// \brief Scenes with a mesh that reflects the light of a lamp to a floor.

#include <tuple>

#include "ljus/accel/mesh.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/render/path_tracing.hpp"
#include "support/mean.hpp"

namespace ljus_test {

using MeshRoom =
    ljus::Scene<ljus::Shapes<ljus::Mesh, ljus::Sphere, ljus::Quad, ljus::Triangle>,
                ljus::Materials<ljus::Lambertian, ljus::Mirror, ljus::Glass>>;
using ClosedMeshRoom = ljus::World<MeshRoom>;

/// A lamp of 2 x 2 that lies on a black floor of 6 x 6 and shines up at a shape. All
/// light on the floor has therefore met the shape.
template <typename Shape, typename Material>
ClosedMeshRoom lamp_below(const Shape& shape, const Material& material) {
    using namespace ljus;
    MeshRoom room;
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Quad{.corner{-3, 0, 3}, .edge_u{6, 0, 0}, .edge_v{0, 0, -6}}, black);
    room.add(Quad{.corner{-1, 0.01f, 1}, .edge_u{2, 0, 0}, .edge_v{0, 0, -2}}, black,
             Rgb{1});
    room.add(shape, room.add(material));
    return ClosedMeshRoom(std::move(room));
}

/// The flux on the floor, measured by `photons` photon paths.
inline Mean flux_by_photons(const ClosedMeshRoom& room, int photons,
                            std::uint64_t seed) {
    using namespace ljus;
    Mean mean;
    const PhotonPassSettings pass{.max_bounces = 100, .shadow_photons = false};
    for (int i = 0; i < photons; ++i) {
        auto stream = random_stream(seed, Pass::general_photons, 0,
                                    static_cast<std::uint64_t>(i));
        detail::PhotonBlockT<float> block;
        // The general map lacks light that has met only mirrors and glass.
        for (const MapType law : {MapType::general, MapType::caustics})
            detail::trace_photon(room, law, {emit(room, room.light_choice(), stream)},
                                 pass, stream, block);
        double sum = 0;
        for (const Photon& photon : block.photons)
            if (photon.position.y < 0.005f) sum += double(photon.flux.x);
        mean.add(sum);
    }
    return mean;
}

/// The flux on the floor, measured by camera paths that start on the floor: the mean
/// radiance times pi times the area. Paths that hit the back of the lamp or the black
/// floor add nothing.
inline Mean flux_by_paths(const ClosedMeshRoom& room, int paths, std::uint64_t seed) {
    using namespace ljus;
    const PathTracer tracer(room, {.max_depth = 100});
    const Mean radiance = mean_radiance(tracer, paths, seed, [](RandomStream& stream) {
        const Vec2 place = next_2d<float>(stream);
        const Vec3 local = sample_cosine_hemisphere(next_2d<float>(stream));
        return Ray{.origin{6 * place.x - 3, 0.001f, 6 * place.y - 3},
                   .direction{local.x, local.z, local.y}};
    });
    const double area = 36 * std::numbers::pi;
    return {radiance.count, area * radiance.mean, area * area * radiance.squares};
}

} // namespace ljus_test
