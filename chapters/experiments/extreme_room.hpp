#pragma once

/// \file chapters/experiments/extreme_room.hpp
/// \brief The report's room with one property taken to an extreme.

#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "ljus/inspect/scene_remarks.hpp"
#include "ljus/materials/eon.hpp"
#include "ljus/materials/glossy.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scenes/report_rooms.hpp"

namespace examples {

/// What may be extreme about a room. What is below 0 is as in the report.
struct Extreme {
    double scale = 1;               ///< Of all lengths.
    ljus::Vec3T<double> moved{0.0}; ///< Where its origin is, after scaling.
    double lamp = -1;   ///< Radius of one ball that is the lamp, before scaling; 0: a
                        ///< point; `ceiling`: all of the ceiling shines.
    double albedo = -1; ///< Of all matt surfaces.
    double index = -1;  ///< Of all glass.
    double gloss = -1;  ///< The mirror is glossy, of this roughness.
    double matt = -1;   ///< The matt surfaces are rough, of this roughness.
    static constexpr double ceiling = 1e9; ///< See lamp.
};

/// A scene of all that the extremes ask for.
template <std::floating_point T>
using ExtremeSceneT =
    ljus::Scene<ljus::Shapes<ljus::QuadT<T>, ljus::SphereT<T>, ljus::TriangleT<T>>,
                ljus::Materials<ljus::LambertianT<T>, ljus::GlassT<T>, ljus::MirrorT<T>,
                                ljus::MixtureT<T>, ljus::GlossyT<T>, ljus::EonT<T>>,
                ljus::Lights<ljus::PointLightT<T>>>;

/// A shape moved and scaled, rounded once.
template <std::floating_point T>
struct Placed {
    const Extreme& how; ///< Where to.

    /// A point.
    [[nodiscard]] ljus::Vec3T<T> operator()(const ljus::Vec3T<double>& x) const {
        return ljus::Vec3T<T>(how.scale * x + how.moved);
    }
    /// An edge.
    [[nodiscard]] ljus::Vec3T<T> along(const ljus::Vec3T<double>& x) const {
        return ljus::Vec3T<T>(how.scale * x);
    }
    /// A ball.
    [[nodiscard]] ljus::SphereT<T> operator()(const ljus::SphereT<double>& s) const {
        return {(*this)(s.center), T(how.scale * s.radius)};
    }
    /// A quad.
    [[nodiscard]] ljus::QuadT<T> operator()(const ljus::QuadT<double>& q) const {
        return {(*this)(q.corner), along(q.edge_u), along(q.edge_v)};
    }
    /// A triangle.
    [[nodiscard]] ljus::TriangleT<T>
    operator()(const ljus::TriangleT<double>& t) const {
        return {(*this)(t.v1), (*this)(t.v2), (*this)(t.v3)};
    }
};

/// A material as the extreme has it.
template <std::floating_point T, typename S>
ljus::MaterialId add_material(S& scene, const Extreme& how,
                              ljus::LambertianT<double> matt) {
    if (how.albedo >= 0) matt.albedo = ljus::RgbT<double>(how.albedo);
    const ljus::RgbT<T> albedo(matt.albedo);
    if (how.matt >= 0)
        return scene.add(ljus::EonT<T>{.albedo = albedo, .roughness = T(how.matt)});
    return scene.add(ljus::LambertianT<T>{.albedo = albedo});
}
template <std::floating_point T, typename S>
ljus::MaterialId add_material(S& scene, const Extreme& how,
                              const ljus::GlassT<double>& glass) {
    return scene.add(
        ljus::GlassT<T>{.index = T(how.index >= 0 ? how.index : glass.index),
                        .absorption = ljus::RgbT<T>(glass.absorption / how.scale)});
}
template <std::floating_point T, typename S>
ljus::MaterialId add_material(S& scene, const Extreme& how,
                              const ljus::MirrorT<double>& mirror) {
    const ljus::RgbT<T> color(mirror.reflectance);
    if (how.gloss >= 0)
        return scene.add(
            ljus::GlossyT<T>{.reflectance = color, .roughness = T(how.gloss)});
    return scene.add(ljus::MirrorT<T>{.reflectance = color});
}
template <std::floating_point T, typename S>
ljus::MaterialId add_material(S& scene, const Extreme& how,
                              const ljus::MixtureT<double>& mixture) {
    return scene.add(
        ljus::MixtureT<T>{.color = ljus::RgbT<T>(mixture.color),
                          .reflectivity = T(mixture.reflectivity),
                          .transparency = T(mixture.transparency),
                          .index = T(how.index >= 0 ? how.index : mixture.index),
                          .absorption = ljus::RgbT<T>(mixture.absorption / how.scale)});
}

/// The room of figure 1, taken to an extreme: its numbers are worked out in
/// double, and rounded once. All lamps have the flux of the report's.
/// \tparam T    The precision of the scene.
/// \param how   What is extreme.
/// \return The scene and its camera.
template <std::floating_point T>
[[nodiscard]] ljus::Room<ExtremeSceneT<T>> extreme_room(const Extreme& how = {}) {
    using namespace ljus;
    const auto from = final_room<double>();
    const Placed<T> place{how};
    ExtremeSceneT<T> scene;

    std::vector<std::vector<MaterialId>> ids;
    const auto add_materials = [&](const auto& array) {
        ids.emplace_back();
        for (const auto& material : array)
            ids.back().push_back(add_material<T>(scene, how, material));
    };
    std::apply([&](const auto&... arrays) { (add_materials(arrays), ...); },
               from.world.materials());

    const double flux = 30 * (4 + 1) * std::numbers::pi; // of the report's lamps
    const double ceiling = 5; // z; its normals point down into the room
    const auto add_shape = [&](const auto& shape, const auto& object) {
        bool shines = how.lamp < 0 && !is_black(object.emission);
        RgbT<double> radiance = object.emission;
        if (how.lamp >= 0 && !is_black(object.emission)) return; // another lamp
        const SphereT<double> bound = bounding_sphere(shape);
        if (how.lamp == Extreme::ceiling && bound.center.z == ceiling) {
            shines = true;
            radiance = RgbT<double>(flux / std::numbers::pi / (12 * 10 + 12 * 3 / 2.0));
        }
        const MaterialId id = ids[object.material.type][object.material.index];
        scene.add(place(shape), id, RgbT<T>(shines ? radiance : RgbT<double>(0.0)));
    };
    std::size_t type = 0;
    const auto add_shapes = [&](const auto& array) {
        for (std::size_t i = 0; i < array.size(); ++i)
            add_shape(array[i], from.world.objects()[type][i]);
        ++type;
    };
    std::apply([&](const auto&... arrays) { (add_shapes(arrays), ...); },
               from.world.shapes());

    if (how.lamp >= 0 && how.lamp < Extreme::ceiling) {
        const Vec3T<double> at{6, 0, 4};
        const double s = how.scale, r = how.lamp;
        if (r > 0)
            scene.add(
                place(SphereT<double>{at, r}),
                scene.add(LambertianT<T>{.albedo = RgbT<T>(T(0))}),
                RgbT<T>(T(flux / (4 * std::numbers::pi * std::numbers::pi * r * r))));
        else
            scene.add(PointLightT<T>{
                place(at), RgbT<T>(T(s * s * flux / (4 * std::numbers::pi)))});
    }
    CameraT<T> camera = report_camera<T>();
    camera.position = place(report_camera<double>().position);
    return {World(std::move(scene)), camera};
}

/// How an extreme is rendered.
struct ExtremeSettings {
    int width = 64;            ///< Pixels.
    int height = 64;           ///< Pixels.
    int samples = 4;           ///< Rays per pixel.
    long long photons = 20000; ///< Of the caustics map.
    double radius = 0.15;      ///< Of its estimates, before scaling.
    std::size_t nearest = 0;   ///< Photons of an estimate; 0: all in the radius.
    std::uint64_t seed = 1;    ///< Of photons and rays.
    int threads = 0;           ///< 0: all.
};

/// A picture of an extreme, and what the program says of it.
template <std::floating_point T>
struct ExtremePicture {
    ljus::RenderedT<T> rendered{}; ///< The picture and its counts.
    std::string remarks{};         ///< Of mapper_remarks().
    std::size_t photons = 0;       ///< That the map has kept.
    std::size_t photon_bytes = 0;  ///< What they take.
};

/// Both passes.
/// \param how  What is extreme.
/// \param settings  Size, rays, photons.
/// \return The picture.
template <std::floating_point T>
[[nodiscard]] ExtremePicture<T> render_extreme(const Extreme& how,
                                               const ExtremeSettings& settings) {
    using namespace ljus;
    const auto room = extreme_room<T>(how);
    PhotonMappingSettings mapping;
    mapping.caustics.photons = settings.photons;
    mapping.caustics.seed = settings.seed;
    mapping.caustics.threads = settings.threads;
    mapping.caustics_estimate.radius = float(how.scale * settings.radius);
    mapping.caustics_estimate.nearest = settings.nearest;
    const PhotonMapper mapper(room.world, mapping);
    const PhotonMapT<T>& caustics = mapper.maps().caustics;
    return {render(mapper, room.camera,
                   {.width = settings.width,
                    .height = settings.height,
                    .samples = settings.samples,
                    .seed = settings.seed,
                    .threads = settings.threads}),
            mapper_remarks(mapper), caustics.records.size(),
            caustics.tree.bytes() + caustics.records.bytes()};
}

} // namespace examples
