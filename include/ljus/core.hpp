#pragma once

/// \file ljus/core.hpp
/// \brief The templates that the optional library ljus::core compiles, in float.
///
/// The library ljus::core contains code that does not depend on a scene's types, and is
/// compiled once for all programs. A program uses the library if it defines `LJUS_CORE`
/// and is linked with ljus::core. ljus.hpp then includes this list, which declares the
/// instantiations. core/core.cpp defines them.

#include "ljus/accel/mesh.hpp"
#include "ljus/inspect/survey.hpp"
#include "ljus/io/png.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/oren_nayar.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/scene/camera.hpp"

/// `extern` in a program, which only declares the instantiations; empty in
/// core/core.cpp.
#ifndef LJUS_CORE_EXTERN
#define LJUS_CORE_EXTERN extern
#endif

namespace ljus {

/// \cond INSTANTIATIONS

// Error messages.
LJUS_CORE_EXTERN template std::string to_text(float);
LJUS_CORE_EXTERN template std::string to_text(double);
LJUS_CORE_EXTERN template std::string to_text(const Vec3&);
LJUS_CORE_EXTERN template std::string to_text(const Vec3T<double>&);
LJUS_CORE_EXTERN template void detail::refuse(std::string_view, const float&,
                                              std::string_view);
LJUS_CORE_EXTERN template void detail::refuse(std::string_view, const double&,
                                              std::string_view);
LJUS_CORE_EXTERN template void detail::refuse(std::string_view, const long long&,
                                              std::string_view);
LJUS_CORE_EXTERN template void detail::refuse(std::string_view, const Vec3&,
                                              std::string_view);
LJUS_CORE_EXTERN template void check(const Image&);

// Trees.
LJUS_CORE_EXTERN template detail::BvhNodesT<float>
detail::build_bvh(std::span<const Box>, const BvhSettings&);
LJUS_CORE_EXTERN template detail::BvhNodesT<float>
detail::build_bvh(std::vector<Box>&&, const BvhSettings&);
LJUS_CORE_EXTERN template detail::BvhNodesT<double>
detail::build_bvh(std::span<const BoxT<double>>, const BvhSettings&);
LJUS_CORE_EXTERN template detail::Bvh8Nodes
detail::make_bvh8(const detail::BvhNodesT<float>&, std::uint32_t);
LJUS_CORE_EXTERN template KdTree8T<float>::KdTree8T(std::span<const Vec3>, int);
LJUS_CORE_EXTERN template std::optional<ShapeHitT<float>> intersect(const Ray&,
                                                                    const Mesh&);
LJUS_CORE_EXTERN template bool meets(const Ray&, const Mesh&);

// Shapes and lamps.
LJUS_CORE_EXTERN template void check(const Quad&);
LJUS_CORE_EXTERN template Box bounds(const Quad&);
LJUS_CORE_EXTERN template Sphere bounding_sphere(const Quad&);
LJUS_CORE_EXTERN template LampT<float> detail::make_lamp(const Quad&, const Rgb&, bool);
LJUS_CORE_EXTERN template LampT<float> detail::make_lamp(const Sphere&, const Rgb&,
                                                         bool);
LJUS_CORE_EXTERN template SurfacePointT<float> emission_point(const AreaLightT<Quad>&,
                                                              const Vec2&, float);
LJUS_CORE_EXTERN template SurfacePointT<float> emission_point(const AreaLightT<Sphere>&,
                                                              const Vec2&, float);
LJUS_CORE_EXTERN template std::optional<float>
form_factor_from(const Vec3&, const Vec3&, const Quad&, bool) noexcept;

// Paths.
LJUS_CORE_EXTERN template SeenPointT<float> sample_towards(const Sphere&, const Vec3&,
                                                           const Vec2&);
LJUS_CORE_EXTERN template std::optional<ScatteredT<float>>
scatter(const VertexT<float>&, const Lambertian&, const Vec3&, Transport, Lobes);
LJUS_CORE_EXTERN template std::optional<ScatteredT<float>>
scatter(const VertexT<float>&, const OrenNayar&, const Vec3&, Transport, Lobes);
LJUS_CORE_EXTERN template std::optional<ScatteredT<float>>
scatter(const VertexT<float>&, const Mirror&, const Vec3&, Transport, Lobes);
LJUS_CORE_EXTERN template std::optional<ScatteredT<float>>
scatter(const VertexT<float>&, const Glass&, const Vec3&, Transport, Lobes);
LJUS_CORE_EXTERN template std::optional<BsdfSampleT<float>>
sample(const Lambertian&, const Vec3&, const Vec3&, Transport, Lobes) noexcept;
LJUS_CORE_EXTERN template detail::GlassBoundaryT<float>
detail::boundary(const Glass&, const Vec3&, Transport) noexcept;
namespace detail {
LJUS_CORE_EXTERN template void follow(PathStateT<float>&, const VertexT<float>&,
                                      const Lambertian&, const BsdfSampleT<float>&,
                                      const Vec3&) noexcept;
LJUS_CORE_EXTERN template void follow(PathStateT<float>&, const VertexT<float>&,
                                      const Glass&, const BsdfSampleT<float>&,
                                      const Vec3&) noexcept;
} // namespace detail
LJUS_CORE_EXTERN template std::optional<PathStateT<float>>
split_path(PathStateT<float>&, const VertexT<float>&, const Glass&);

// Photons.
LJUS_CORE_EXTERN template LightChoice light_choice(const std::vector<Rgb>&);
namespace detail {
LJUS_CORE_EXTERN template LightChoice
start_pass<float>(MapType, const PhotonPassSettings&, LightChoice);
LJUS_CORE_EXTERN template TracedPartsT<float>
run_pass(MapType, const PhotonPassSettings&,
         FunctionRef<void(const BlockRange&, PhotonBlockT<float>&)>);
LJUS_CORE_EXTERN template bool scatter_photon(PathStateT<float>&, const VertexT<float>&,
                                              const Lambertian&, MapType, SobolStream&,
                                              FluxAudit&, bool);
LJUS_CORE_EXTERN template bool scatter_photon(PathStateT<float>&, const VertexT<float>&,
                                              const OrenNayar&, MapType, SobolStream&,
                                              FluxAudit&, bool);
LJUS_CORE_EXTERN template bool scatter_photon(PathStateT<float>&, const VertexT<float>&,
                                              const Mirror&, MapType, SobolStream&,
                                              FluxAudit&, bool);
LJUS_CORE_EXTERN template bool scatter_photon(PathStateT<float>&, const VertexT<float>&,
                                              const Glass&, MapType, SobolStream&,
                                              FluxAudit&, bool);
LJUS_CORE_EXTERN template std::optional<ChosenTargetT<AimT<float>>>
choose_target(std::span<const ObjectId>, FunctionRef<AimT<float>(ObjectId)>, float);
LJUS_CORE_EXTERN template LeavingPhotonT<float>
emit_into(const AreaLightT<Quad>&, const Sphere&, const Vec2&, Vec2, float);
LJUS_CORE_EXTERN template LeavingPhotonT<float>
emit_into(const AreaLightT<Sphere>&, const Sphere&, const Vec2&, Vec2, float);
LJUS_CORE_EXTERN template void keep_kinds(PhotonPartsT<float>&, PhotonKinds);
LJUS_CORE_EXTERN template long long count_of(const PhotonPartsT<float>&, PhotonKind);
LJUS_CORE_EXTERN template std::string
radius_remark(std::string_view, const DensityEstimateSettings&, const PhotonMap&);
LJUS_CORE_EXTERN template void
estimates_together(const PhotonMap&, std::span<const EstimatePlaceT<float>>,
                   const DensityEstimateSettings&, PhotonKinds, std::uint64_t&,
                   BallBlocks&,
                   FunctionRef<void(const EstimatePlaceT<float>&, const Rgb&)>);
LJUS_CORE_EXTERN template Sphere sphere_around(const std::vector<Sphere>&);
LJUS_CORE_EXTERN template PhotonMap map_of_parts(PhotonPartsT<float>, int);
} // namespace detail
LJUS_CORE_EXTERN template PhotonMap make_photon_map(const std::vector<Photon>&, int);
LJUS_CORE_EXTERN template float typical_radius(const KdTree8&, std::size_t,
                                               std::size_t);
LJUS_CORE_EXTERN template PhotonMap lone_photons(const PhotonMap&, float);
LJUS_CORE_EXTERN template RgbT<double>
detail::flux_in_disc(const KdTree8&, const detail::PhotonRecordsT<float>&,
                     const detail::FluxDiscT<float>&, std::uint64_t&);
namespace detail {
LJUS_CORE_EXTERN template NearestPhotons nearest_photons(const PhotonMap&,
                                                         const SurfacePointT<float>&,
                                                         float, std::span<Neighbor>,
                                                         const OfKinds&);
} // namespace detail
LJUS_CORE_EXTERN template Rgb estimate_radiance(const PhotonMap&, const VertexT<float>&,
                                                const Lambertian&, const Vec3&,
                                                const DensityEstimateSettings&,
                                                PhotonKinds, std::uint64_t&);
LJUS_CORE_EXTERN template Rgb estimate_radiance(const PhotonMap&, const VertexT<float>&,
                                                const OrenNayar&, const Vec3&,
                                                const DensityEstimateSettings&,
                                                PhotonKinds, std::uint64_t&);

// Pictures.
LJUS_CORE_EXTERN template Vec2 detail::sample_filter_axis(Filter, float);
LJUS_CORE_EXTERN template Camera look_at(const ViewT<float>&);
LJUS_CORE_EXTERN template Bytes encode_png(const Image&, const PngSettings&);
LJUS_CORE_EXTERN template void save_png(const Image&, const std::string&,
                                        const PngSettings&);

/// \endcond

} // namespace ljus
