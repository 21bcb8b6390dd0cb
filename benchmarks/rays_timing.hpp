#pragma once

/// \file rays_timing.hpp
/// \brief Timing for the benchmarks of rays; adapters for Embree and tinybvh.
///
/// A method to find the first hit is a struct
///
///     struct Peer {
///         float closest(const ljus::Ray& ray) const; // t of the first hit, or -1
///         bool any(const ljus::Ray& ray) const;      // whether anything is hit
///     };

#include <algorithm>
#include <array>
#include <cstdint>
#include <ctime>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include <ljus/geometry/ray.hpp>

#if __has_include(<embree3/rtcore.h>) && defined(LJUS_BENCH_EMBREE)
#include <embree3/rtcore.h>
#endif
// Its eight-wide tree needs these instructions.
#if defined(LJUS_BENCH_TINYBVH) && defined(__AVX2__) && defined(__FMA__)
#define NO_THREADED_BUILDS // one thread, as all others here
#define TINYBVH_IMPLEMENTATION
#include <tiny_bvh.h>
#else
#undef LJUS_BENCH_TINYBVH
#endif

namespace rays {

/// Seconds of this process: other work on the machine does not count.
inline double seconds() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

/// In place of a peer that is not installed: only its time is NaN.
struct NoPeer {
    float closest(const ljus::Ray&) const { return -1; }
    bool any(const ljus::Ray&) const { return false; }
};

/// Nanoseconds per ray of each peer, each block of rays by one peer after the other,
/// the best of some runs of each block; and the sums of the answers, to see that peers
/// agree.
template <typename... Peer>
struct Times {
    std::array<double, sizeof...(Peer)> nanoseconds{};
    std::array<double, sizeof...(Peer)> sums{};
};

/// Measures the times.
template <typename... Peer>
Times<Peer...> compare(std::span<const ljus::Ray> set, bool any, const Peer&... peers) {
    Times<Peer...> times;
    const std::size_t block = std::min<std::size_t>(20000, set.size());
    std::size_t blocks = 0;
    for (std::size_t first = 0; block > 0 && first + block <= set.size();
         first += block, ++blocks) {
        std::array<double, sizeof...(Peer)> best;
        best.fill(std::numeric_limits<double>::infinity());
        for (int run = 0; run < 5; ++run) {
            std::size_t k = 0;
            const auto time = [&](const auto& peer) {
                double sum = 0;
                const double start = seconds();
                for (const ljus::Ray& ray : set.subspan(first, block))
                    sum += any ? double(peer.any(ray)) : double(peer.closest(ray));
                best[k] = std::min(best[k], seconds() - start);
                if (run == 0) times.sums[k] += sum;
                ++k;
            };
            (time(peers), ...);
        }
        for (std::size_t k = 0; k < best.size(); ++k) times.nanoseconds[k] += best[k];
    }
    for (double& t : times.nanoseconds) t *= 1e9 / double(block) / double(blocks);
    std::size_t k = 0;
    const auto blank = [&](bool missing) {
        if (missing) times.nanoseconds[k] = std::numeric_limits<double>::quiet_NaN();
        ++k;
    };
    (blank(std::is_same_v<Peer, NoPeer>), ...);
    return times;
}

#ifdef LJUS_BENCH_EMBREE
/// Embree, single rays, one thread. Geometry is added by the caller, then commit().
struct Embree {
    RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    RTCScene scene = rtcNewScene(device);
    mutable RTCIntersectContext context{};
    double build = 0; ///< Seconds of rtcCommitScene.

    /// \param flags  RTC_SCENE_FLAG_ROBUST, or none.
    explicit Embree(RTCSceneFlags flags = RTC_SCENE_FLAG_NONE) {
        rtcSetSceneFlags(scene, flags);
    }
    Embree(const Embree&) = delete;
    ~Embree() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    /// Adds vertices, `width` floats each, and `corners` indices per primitive, in
    /// order.
    void add(RTCGeometryType type, const std::vector<float>& vertices, int width,
             int corners) {
        const RTCGeometry geometry = rtcNewGeometry(device, type);
        const auto w = static_cast<std::size_t>(width);
        const std::size_t count = vertices.size() / w;
        auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0,
            width == 3 ? RTC_FORMAT_FLOAT3 : RTC_FORMAT_FLOAT4, 4 * w, count));
        std::copy(vertices.begin(), vertices.end(), v);
        if (corners > 0) {
            const auto c = static_cast<std::size_t>(corners);
            auto* index = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
                geometry, RTC_BUFFER_TYPE_INDEX, 0,
                corners == 3 ? RTC_FORMAT_UINT3 : RTC_FORMAT_UINT4, 4 * c, count / c));
            for (std::size_t i = 0; i < count; ++i)
                index[i] = static_cast<std::uint32_t>(i);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
    }
    void commit() {
        const double start = seconds();
        rtcCommitScene(scene);
        build = seconds() - start;
        rtcInitIntersectContext(&context);
    }
    static RTCRay ray_of(const ljus::Ray& r) {
        return {r.origin.x,
                r.origin.y,
                r.origin.z,
                r.t_min,
                r.direction.x,
                r.direction.y,
                r.direction.z,
                0,
                r.t_max,
                ~0u,
                0,
                0};
    }
    float closest(const ljus::Ray& ray) const {
        RTCRayHit hit;
        hit.ray = ray_of(ray);
        hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &context, &hit);
        return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? -1 : hit.ray.tfar;
    }
    bool any(const ljus::Ray& ray) const {
        RTCRay shadow = ray_of(ray);
        rtcOccluded1(scene, &context, &shadow);
        return shadow.tfar < 0;
    }
};
#endif

#ifdef LJUS_BENCH_TINYBVH
/// The eight-wide tree of tinybvh.
struct TinyBvh {
    tinybvh::BVH8_CPU tree;
    std::vector<tinybvh::bvhvec4> vertices; // it refers to them
    double build = 0;                       ///< Seconds of Build().

    /// \param corners  Three floats each, three corners a triangle.
    explicit TinyBvh(const std::vector<float>& corners) {
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
            vertices.emplace_back(corners[i], corners[i + 1], corners[i + 2], 0.0f);
        const double start = seconds();
        tree.Build(vertices.data(), std::uint32_t(vertices.size() / 3));
        build = seconds() - start;
    }
    [[nodiscard]] double bytes() const { return 64.0 * tree.usedBlocks; }
    static tinybvh::Ray ray_of(const ljus::Ray& r) {
        return {{r.origin.x, r.origin.y, r.origin.z},
                {r.direction.x, r.direction.y, r.direction.z},
                std::min(r.t_max, BVH_FAR)};
    }
    float closest(const ljus::Ray& ray) const {
        tinybvh::Ray own = ray_of(ray);
        const float end = own.hit.t;
        (void)tree.Intersect(own);
        return own.hit.t < end ? own.hit.t : -1;
    }
    bool any(const ljus::Ray& ray) const { return tree.IsOccluded(ray_of(ray)); }
};
#endif

} // namespace rays
