#pragma once

/// \file ljus/render/lamp_shares.hpp
/// \brief Sends more photons from those lamps whose light a picture shows.

#include <cmath>
#include <vector>

#include "ljus/photons/budget.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/scene/camera.hpp"

namespace ljus {

/// \defgroup lamp_shares Shares of photons by lamp
/// \brief A lamp that lights what the camera sees sends more photons \cite peter1998.
/// Chapter: \ref ch_lamps.
/// \{

/// The points at which a picture queries the photon maps: those on the first and the
/// second non-specular surface that each camera path meets. Each is stored as a photon,
/// whose flux is the throughput of the path: the *importance* of the point.
/// \cost 1024 paths.
template <AnyWorld W, CameraLike C, std::floating_point T = typename W::Scalar>
[[nodiscard]] PhotonMapT<T> seen_places(const W& world, const C& camera, int width,
                                        int height, std::uint64_t seed) {
    constexpr std::uint64_t side = 32;
    std::vector<PhotonT<T>> places;
    for (std::uint64_t i = 0; i < side * side; ++i) {
        auto stream = random_stream(seed, Pass::camera, ~0ull, i);
        const Vec2T<T> cell = Vec2T<T>{T(i % side), T(i / side)};
        const Vec2T<T> at = (cell + next_2d<T>(stream)) / T(side);
        PathStateT<T> path =
            camera_path(world,
                        camera_ray(camera, {at.x * T(width), at.y * T(height)}, width,
                                   height, stream),
                        stream);
        // [seen places]
        int matt = 0; // surfaces that are not only specular
        while (path.depth < 16) {
            const auto vertex = next_vertex(world, path, stream);
            if (!vertex || is_black(path.throughput)) break;
            const bool goes_on = visit_material_at(world, *vertex, [&](const auto& m) {
                if (has(lobes(m), Lobes::non_specular)) {
                    places.push_back(
                        {.position = detail::at_rest(world, *vertex).point.position,
                         .direction = path.ray.direction,
                         .flux = path.throughput,
                         .normal = small_normal(vertex->point.normal)});
                    if (++matt == 2) return false;
                }
                return continue_path(path, *vertex, m, Transport::radiance, Lobes::all,
                                     stream);
            });
            if (!goes_on) break;
        }
        // [seen places]
    }
    return make_photon_map(places, 1);
}

/// Changes the settings so that a lamp whose light contributes more to the picture
/// sends more photons. pilot_lights() measures the contribution; each pilot photon is
/// weighted with the importance of the seen_places() around it. A lamp whose light the
/// picture does not show sends a tenth of the photons that it would send in proportion
/// to its power, and more if a pass has fewer than 800 photons per lamp.
/// \param world     The closed scene.
/// \param camera    Any camera.
/// \param settings  The settings to change; shares that they contain are kept.
/// \param width     Width of the picture, in pixels.
/// \param height    Height of the picture, in pixels.
/// \return The settings with `light_shares` for both passes; unchanged with fewer than
///         two lamps.
/// \cost A twentieth of the photons, or up to a quarter with many lamps; and 1024
///       camera paths.
template <AnyWorld W, CameraLike C>
[[nodiscard, gnu::cold]] PhotonMappingSettings
share_by_sight(const W& world, const C& camera, PhotonMappingSettings settings,
               int width, int height) {
    using T = typename W::Scalar;
    if (world.light_count() < 2) return settings;
    const Passes run = choose_passes(needs(world), settings);
    const auto places =
        seen_places(world, camera, width, height, settings.general.seed);
    const T radius = typical_radius(places, 16);
    const auto importance = [&](const PhotonT<T>& photon) {
        return detail::irradiance_around(places, photon, radius);
    };
    const auto share = [&](PhotonPassSettings pass, MapType map) {
        pass.gloss_as_mirrors = run.gloss_as_mirrors;
        const bool measures = pass.light_shares.empty() && pass.shares.empty();
        return measures ? pilot_lights(world, pass, map, importance)
                        : pass.light_shares;
    };
    if (run.caustics_map)
        settings.caustics.light_shares = share(settings.caustics, MapType::caustics);
    if (run.general_map) {
        PhotonPassSettings pass = settings.general;
        pass.keep = detail::kept_kinds(settings);
        settings.general.light_shares = share(pass, MapType::general);
    }
    return settings;
}

/// \}

} // namespace ljus
