/// \file guard.cpp
/// \brief Small tasks whose instructions are counted, so that no function becomes
/// slower unnoticed: tests/checks/performance.sh runs them under callgrind and
/// compares.
///
/// Each case is a function `guard_...`, which callgrind names. A case `..._plain` has a
/// fast twin without that word, a case `..._nanoflann` does the same by nanoflann; their
/// ratios are guarded as well. (Not that of building: there nanoflann waits for branches
/// rather than executes instructions.) The work is the same at every run: one thread, fixed
/// seeds.

#include <cstdio>
#include <memory>
#include <vector>

#include <ljus/accel/bvh8.hpp>
#include <ljus/accel/kd_tree.hpp>
#include <ljus/accel/triangle_bvh.hpp>
#include <ljus/geometry/watertight.hpp>
#include <ljus/io/png.hpp>
#include <ljus/materials/eon.hpp>
#include <ljus/materials/glossy.hpp>
#include <ljus/math/low_discrepancy.hpp>
#include <ljus/optics/fresnel.hpp>
#include <ljus/optics/thin_film.hpp>
#include <ljus/photons/density_estimate.hpp>
#include <ljus/render/path_tracing.hpp>
#include <ljus/render/photon_mapping.hpp>
#include <ljus/render/plain_path_tracing.hpp>
#include <ljus/render/render.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "nanoflann_peer.hpp"
#include "rays_scenes.hpp"

#if defined(_MSC_VER)
#define LJUS_GUARD extern "C" __declspec(noinline) void
#else
#define LJUS_GUARD extern "C" __attribute__((noinline)) void
#endif

using namespace ljus;

namespace {

/// All cases add to this, so that no work is optimised away.
volatile double result = 0;

#ifdef LJUS_BENCH_NANOFLANN
using Nanoflann = nanoflann_peer::Nanoflann<nanoflann_peer::Installed>;
#endif

/// The data of the cases, made before counting begins.
struct Work {
    std::vector<Ray> rays;
    std::vector<Vec3> points;
    rays::Mesh mesh = rays::bumpy_ball(2000);
    Bvh tree = rays::plain_tree(mesh);
    TriangleBvh wide = rays::wide_tree(mesh);
    std::vector<Box> boxes;
    Bvh8 eight;
    KdTree kd;
    KdTree8 kd8;
#ifdef LJUS_BENCH_NANOFLANN
    std::unique_ptr<Nanoflann> peer; // it keeps its address
#endif
    PhotonMap map;
    Room<CornellSceneT<float>> room = cornell_box();
    PhotonMappingSettings settings{};
    RenderSettings picture{.width = 12, .height = 12, .samples = 2, .threads = 1};

    Work() {
        RandomStream stream = random_stream(3, Pass::user, 0, 0);
        const auto point = [&] { return 2.0f * next_3d<float>(stream) - 1.0f; };
        std::vector<Photon> photons;
        for (int i = 0; i < 20000; ++i) {
            points.push_back(point());
            if (i % 4 != 0) points.back()[i % 3] = 1;
            photons.push_back({.position = points.back(),
                               .direction = glm::normalize(point()),
                               .flux = Rgb{1e-4f},
                               .kind = PhotonKind::indirect,
                               .normal = small_normal(Vec3{0, 0, 1})});
        }
        for (int i = 0; i < 4000; ++i) {
            const Vec3 from = 3.0f * glm::normalize(point());
            rays.push_back({.origin = from, .direction = 0.7f * point() - from});
        }
        for (const Triangle& t : mesh) boxes.push_back(bounds(t));
        eight = Bvh8(boxes, {.leaf_size = 1, .threads = 1});
        kd = KdTree(points);
        kd8 = KdTree8(points, 1);
#ifdef LJUS_BENCH_NANOFLANN
        peer = std::make_unique<Nanoflann>(points);
        peer->arrange(std::vector<float>(points.size(), 1.0f));
#endif
        map = make_photon_map(photons, 1);
        settings.indirect = IndirectLight::map;
        settings.caustics.photons = settings.general.photons = 1000;
        settings.caustics.threads = settings.general.threads = 1;
    }
};
const Work& work() {
    static const Work all;
    return all;
}

template <typename Compute = void, typename Shape>
void meet(const Shape& shape) {
    for (const Ray& ray : work().rays)
        result = result + bool(intersect<Compute>(ray, shape));
}

template <typename Tree>
void meet_all(const Tree& tree) {
    for (const Ray& ray : work().rays) {
        NearestHit found;
        Ray rest = ray;
        tree.closest(rest, [&](std::uint32_t place, Ray& shorter) {
            if (const auto hit = intersect<double>(
                    shorter, rays::triangle_at(tree, work().mesh, place)))
                found.offer(*hit, tree.primitive_ids()[place], shorter);
        });
        if (found.found) result = result + found.at.t;
    }
}

template <typename Tree>
void find_nearest(const Tree& tree) {
    Neighbor room[50];
    for (std::size_t i = 0; i < 500; ++i)
        result = result + double(tree.nearest(work().points[i * 37], 1.0f, room));
}

template <typename Tree>
void find_within(const Tree& tree) {
    for (std::size_t i = 0; i < 1000; ++i)
        tree.visit_within(work().points[i * 19], 0.05f,
                          [](std::uint32_t, double d) { result = result + d; });
}

template <typename Estimate>
void estimate_all(Estimate estimate) {
    VertexT<float> at{};
    at.point.normal = {0, 0, 1};
    at.frame = frame_around(at.point.normal);
    std::uint64_t gathered = 0;
    for (std::size_t i = 0; i < 500; ++i) {
        at.point.position = work().points[i * 37];
        result = result + estimate(at, gathered).x;
    }
}
const DensityEstimateSettings wide_estimate{.radius = 0.1f};

template <typename Material>
void scatter_all(const Material& material) {
    RandomStream stream = random_stream(5, Pass::user, 0, 0);
    const Vec3 wo = glm::normalize(Vec3{0.3f, 0.4f, 0.6f});
    for (int i = 0; i < 4000; ++i)
        if (const auto to =
                sample(material, wo, next_3d<float>(stream), Transport::radiance))
            result = result + double(to->weight.x + pdf(material, wo, to->wi));
}

} // namespace

LJUS_GUARD guard_sphere() {
    meet(Sphere{.radius = 0.5f});
}
LJUS_GUARD guard_triangle() {
    meet(Triangle{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}});
}
LJUS_GUARD guard_triangle_float() {
    meet<float>(Triangle{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}});
}
LJUS_GUARD guard_quad() {
    meet(Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}});
}
LJUS_GUARD guard_bvh_plain() {
    meet_all(work().tree);
}
LJUS_GUARD guard_bvh() {
    meet_all(work().eight);
}
LJUS_GUARD guard_mesh() {
    meet_all(work().wide);
}
LJUS_GUARD guard_nearest_plain() {
    find_nearest(work().kd);
}
LJUS_GUARD guard_nearest() {
    find_nearest(work().kd8);
}
LJUS_GUARD guard_within_plain() {
    find_within(work().kd);
}
LJUS_GUARD guard_within() {
    find_within(work().kd8);
}
LJUS_GUARD guard_build_kd_tree_plain() {
    result = result + double(KdTree(work().points).point_ids().size());
}
LJUS_GUARD guard_build_kd_tree() {
    result = result + double(KdTree8(work().points, 1).point_ids().size());
}
#ifdef LJUS_BENCH_NANOFLANN
LJUS_GUARD guard_nearest_nanoflann() {
    for (std::size_t i = 0; i < 500; ++i)
        result = result + work().peer->sum_nearest(work().points[i * 37], 50);
}
LJUS_GUARD guard_within_nanoflann() {
    for (std::size_t i = 0; i < 1000; ++i)
        result = result + work().peer->sum_within(work().points[i * 19], 0.05f);
}
#endif
LJUS_GUARD guard_build_mesh() {
    result = result + double(rays::wide_tree(work().mesh).primitive_ids().size());
}
LJUS_GUARD guard_estimate_plain() {
    estimate_all([](const auto& at, std::uint64_t& gathered) {
        return estimate_radiance_plain(work().map, at, Lambertian{}, Vec3{0, 0, 1},
                                       wide_estimate, all_kinds, gathered);
    });
}
LJUS_GUARD guard_estimate() {
    estimate_all([](const auto& at, std::uint64_t& gathered) {
        return estimate_radiance(work().map, at, Lambertian{}, Vec3{0, 0, 1},
                                 wide_estimate, all_kinds, gathered);
    });
}
LJUS_GUARD guard_eon() {
    scatter_all(Eon{});
}
LJUS_GUARD guard_glossy() {
    scatter_all(Glossy{.reflectance = Rgb{0.8f}});
}
LJUS_GUARD guard_fresnel() {
    for (int i = 0; i < 20000; ++i)
        result = result + fresnel(float(i) / 20000, 1.0f, 1.5f);
}
LJUS_GUARD guard_random() {
    for (std::uint64_t path = 0; path < 4000; ++path) {
        RandomStream stream = random_stream(1, Pass::camera, 0, path);
        for (int i = 0; i < 8; ++i) result = result + next_1d<float>(stream);
    }
}
LJUS_GUARD guard_photon_maps() {
    const auto& w = work();
    result =
        result +
        double(PhotonMapper(w.room.world, w.settings).maps().general.records.size());
}
LJUS_GUARD guard_photon_mapping() {
    const auto& w = work();
    result = result +
             render(PhotonMapper(w.room.world, w.settings), w.room.camera, w.picture)
                 .image.pixels[70]
                 .x;
}
LJUS_GUARD guard_path_tracing() {
    const auto& w = work();
    result =
        result +
        render(PathTracer(w.room.world), w.room.camera, w.picture).image.pixels[70].x;
}
LJUS_GUARD guard_png() {
    Image image = make_image<float>(64, 64);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = Rgb{float(i % 61) / 61};
    result = result + double(encode_png(image, {}).size());
}

int main() {
    (void)work();
    for (const auto each :
         {guard_sphere,         guard_triangle,      guard_triangle_float,
          guard_quad,           guard_bvh_plain,     guard_bvh,
          guard_mesh,           guard_nearest_plain, guard_nearest,
          guard_within_plain,   guard_within,        guard_build_kd_tree_plain,
          guard_build_kd_tree,  guard_build_mesh,    guard_estimate_plain,
          guard_estimate,       guard_eon,           guard_glossy,
          guard_fresnel,        guard_random,        guard_photon_maps,
          guard_photon_mapping, guard_path_tracing,  guard_png})
        each();
#ifdef LJUS_BENCH_NANOFLANN
    guard_nearest_nanoflann();
    guard_within_nanoflann();
#endif
    std::printf("%.9g\n", double(result));
}
