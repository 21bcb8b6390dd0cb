// Prints what the searches that ljus::core has for several processors find, bit by bit.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <span>
#include <vector>

#include "ljus/accel/mesh.hpp"
#include "ljus/math/random.hpp"
#include "ljus/render/irradiance_cache.hpp"

using namespace ljus;

namespace {

std::uint64_t found = 14695981039346656037u; // FNV-1a

void add(float value) {
    found = (found ^ std::bit_cast<std::uint32_t>(value)) * 1099511628211u;
}
void add(const Rgb& color) {
    for (const float channel : {color.r, color.g, color.b}) add(channel);
}

Mesh bumpy_ball() {
    constexpr std::uint32_t n = 60;
    MeshData data;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const float theta = 3.14159f * (float(i) + 0.5f) / float(n + 1);
            const float phi = 6.28318f * float(j) / float(n);
            const float r = 1 + 0.1f * std::sin(9 * phi) * std::sin(7 * theta);
            data.positions.push_back(r * Vec3{std::sin(theta) * std::cos(phi),
                                              std::cos(theta),
                                              std::sin(theta) * std::sin(phi)});
        }
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t a = i * n + j, b = i * n + (j + 1) % n;
            data.triangles.push_back({a, b, a + n});
            data.triangles.push_back({b, b + n, a + n});
        }
    return Mesh(std::move(data), 1);
}

} // namespace

int main() {
    RandomStream random(7, 0);
    const auto in_cube = [&] {
        const float x = next_1d<float>(random), y = next_1d<float>(random),
                    z = next_1d<float>(random);
        return 2.0f * Vec3{x, y, z} - Vec3{1};
    };

    const Mesh mesh = bumpy_ball();
    int hits = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Vec3 origin = 2.0f * in_cube(), target = in_cube();
        const Ray ray{.origin = origin, .direction = target - origin};
        add(meets(ray, mesh) ? 1.0f : 0.0f);
        const auto hit = intersect(ray, mesh);
        if (!hit) continue;
        ++hits;
        add(hit->t);
        add(hit->u);
        add(hit->v);
        add(float(hit->part));
    }

    std::vector<Photon> photons;
    for (int i = 0; i < 20'000; ++i) {
        Photon photon{};
        photon.position = {in_cube().x, in_cube().y, 0.01f * in_cube().z};
        photon.direction = glm::normalize(in_cube() - Vec3{0, 0, 2});
        photon.flux = in_cube() + Vec3{2};
        photon.kind = i % 3 == 0 ? PhotonKind::direct : PhotonKind::indirect;
        photons.push_back(photon);
    }
    const PhotonMap map = make_photon_map(photons, 1);
    float largest = 0;
    for (int i = 0; i < 2'000; ++i) {
        const Vec3 x = in_cube();
        const SurfacePoint point{.position{x.x, x.y, 0}, .normal{0, 0, 1}};
        for (const std::size_t nearest : {0u, 50u}) {
            const Rgb e = estimate_irradiance(
                map, point, point.normal,
                DensityEstimateSettings{.radius = 0.1f, .nearest = nearest});
            add(e);
            largest = glm::max(largest, e.r);
        }
        std::array<Neighbor, 50> found_photons;
        const detail::SourcePhotonsT<float> indirect{map, PhotonKind::indirect, 4};
        const detail::OfIndex<detail::SourcePhotonsT<float>> counts{indirect};
        const auto near =
            detail::nearest_photons(map, point, 0.1f, std::span(found_photons), counts);
        add(float(near.radius2));
        add(float(near.photons.size()));
    }

    // The searches of the preset fast.
    std::vector<Vec3> places;
    std::vector<GatheredT<float>> gathered;
    for (const Photon& photon : photons) {
        places.push_back(photon.position);
        gathered.push_back({.irradiance = photon.flux, .distance = 0.05f});
    }
    IrradiancePoints points{.tree = KdTree8(places, 1), .records = {}, .radius = 0.1f};
    for (const std::uint32_t i : points.tree.point_ids())
        points.records.push_back({photons[i].flux, {0, 0, i % 2 == 0 ? 1.0f : -1.0f}});
    const auto cache = make_irradiance_cache(places, gathered, {}, 1);
    std::vector<detail::EstimatePlaceT<float>> asked;
    for (int i = 0; i < 2'000; ++i) {
        const Vec3 x = in_cube(), up{0, 0, 1};
        add(interpolate(cache, {x.x, x.y, 0}, up, 1.0f).value_or(Rgb{-1}));
        add(irradiance_at(points, {x.x, x.y, 0}, up).value_or(Rgb{-1}));
        asked.push_back({.center{x.x, x.y, 0}, .normal = up, .from = up, .brdf = x});
    }
    std::uint64_t count = 0;
    detail::BallBlocks room;
    const auto take = [](const auto&, const Rgb& light) { add(light); };
    detail::estimates_together<float, Kernel>(
        map, asked, DensityEstimateSettings{.radius = 0.1f}, light_kinds, count, room,
        take);
    std::printf("%d hits, irradiance up to %g, all bits %016llx\n", hits,
                double(largest), static_cast<unsigned long long>(found));
    return hits > 1000 && largest > 0 ? 0 : 1;
}
