#pragma once

/// \file ljus/photons/kernel_border.hpp
/// \brief The fraction of a kernel's disc that lies on a surface, near its border.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "ljus/image/color.hpp"
#include "ljus/math/random.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/photons/irradiance_estimate.hpp"

namespace ljus {

/// \addtogroup irradiance_points
/// \{

/// The fraction of Epanechnikov's kernel on one side of a straight line: the integral
/// of \f$ \frac{8}{3\pi}(1 - t^2)^{3/2} \f$ from -1 to s.
/// \param s  Signed distance from the centre to the line over the radius; negative if
///           the centre lies beyond the line.
/// \return 0 for s <= -1, 1/2 at s = 0, 1 for s >= 1.
// [kernel_part]
template <std::floating_point T>
[[nodiscard]] T kernel_part(T s) noexcept {
    if (!(s < T(1))) return T(1);
    if (s <= T(-1)) return T(0);
    const T root = std::sqrt(T(1) - s * s);
    const T integral = s * root * (T(5) - T(2) * s * s) + T(3) * std::asin(s);
    return T(0.5) + integral / (T(3) * std::numbers::pi_v<T>);
}
// [kernel_part]

namespace detail {

/// Finds the surface near a point by a short ray.
/// \param normal  Unit normal of the expected surface.
/// \param height  The ray starts at this height above the point, and ends as far below.
/// \return The vertex; nothing if there is no surface.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<VertexT<T>>
vertex_below(const W& world, const Vec3T<T>& place, const Vec3T<T>& normal, T height) {
    const RayT<T> down{.origin = place + height * normal,
                       .direction = -normal,
                       .t_max = T(2) * height};
    const auto hit = closest_hit(world, down);
    if (!hit) return std::nullopt;
    VertexT<T> vertex = vertex_at(world, down, *hit);
    vertex.medium = medium_at(world, down);
    return vertex;
}

/// Whether a surface continues at a point: a short ray from above it hits a surface of
/// the same normal.
/// \param normal  Normal of the surface, on the side of the irradiance.
/// \param height  As for vertex_below().
template <AnyWorld W, std::floating_point T>
[[nodiscard]] bool goes_on(const W& world, const Vec3T<T>& place,
                           const Vec3T<T>& normal, T height) {
    const auto there = vertex_below(world, place, normal, height);
    return there && std::abs(glm::dot(there->point.normal, normal)) > T(0.99);
}

} // namespace detail

/// The fraction of a kernel's disc that lies on the surface. Each straight edge of the
/// shape cuts off a segment, unless another surface continues there, as at the diagonal
/// of a wall of two triangles. If several edges cut the disc, their fractions are
/// multiplied, which is exact for a product kernel and close for this one.
/// \param world   The closed scene.
/// \param vertex  The centre.
/// \param normal  Unit normal, on the side of the irradiance.
/// \param radius  Radius of the disc, in scene units.
/// \return In (0, 1]; 1 for shapes without straight edges.
/// \cost A ray per edge that cuts the disc.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] T part_on_surface(const W& world, const VertexT<T>& vertex,
                                const Vec3T<T>& normal, T radius) {
    const Vec3T<T>& x = vertex.point.position;
    // [part_on_surface]
    const auto part = [&](const auto& corners) {
        Vec3T<T> middle{T(0)};
        for (const Vec3T<T>& corner : corners) middle += corner / T(corners.size());
        T product = T(1);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vec3T<T>& a = corners[i];
            const Vec3T<T> along =
                glm::normalize(corners[(i + 1) % corners.size()] - a);
            Vec3T<T> inward = glm::cross(normal, along);
            if (glm::dot(middle - a, inward) < T(0)) inward = -inward;
            const T distance = glm::dot(x - a, inward);
            if (!(distance < radius)) continue;
            const Vec3T<T> beyond = x - (distance + T(0.02) * radius) * inward;
            if (!detail::goes_on(world, beyond, normal, T(0.01) * radius))
                product *= kernel_part(distance / radius);
        }
        return product;
    };
    // [part_on_surface]
    return world.visit_shape(vertex.id, [&](const auto& shape) {
        if constexpr (requires { corners_of(shape); })
            return part(corners_of(shape));
        else
            return T(1);
    });
}

namespace detail {

/// The part of a photon's flux, along one line through its disc, that estimates on the
/// surfaces there find: about the kernel's weight on a flat one.
/// \param world    The closed scene.
/// \param photon   Where the photon landed.
/// \param offset   From it to the line, within the disc, in units of the radius.
/// \param gather   Radius, kernel, thickness.
template <AnyWorld W, std::floating_point T, typename K>
[[nodiscard]] double found_along(const W& world, const SurfacePointT<T>& photon,
                                 const Vec3T<T>& offset,
                                 const DensityEstimateOf<K>& gather) {
    const T radius = T(gather.radius), height = T(gather.thickness) * radius;
    RayT<T> line{.origin = photon.position + radius * offset - height * photon.normal,
                 .direction = photon.normal,
                 .t_max = T(2) * height};
    double found = 0;
    for (int surfaces = 0; surfaces < 8; ++surfaces) {
        const auto hit = closest_hit(world, line);
        if (!hit) break;
        const auto point = vertex_at(world, line, *hit).point;
        const Vec3T<T> way = point.position - photon.position;
        const T distance2 = glm::dot(way, way) / (radius * radius);
        const T cosine = glm::dot(point.normal, photon.normal); // as turned_away()
        if (cosine > T(0.5) && distance2 < T(1) &&
            std::abs(glm::dot(way, point.normal)) < height)
            found += double(kernel_weight(gather.kernel, distance2) / cosine);
        line.t_min = hit->at.t + T(1e-4) * radius;
    }
    return found;
}

} // namespace detail

/// The light that estimates lose where their disc is wider than an object: the part of
/// its photons' flux that is spread beyond its edges, for the object that loses most.
/// The objects on which few of the sampled photons landed are taken together.
/// \param world   The closed scene.
/// \param map     Its photons; some thousands are sampled.
/// \param gather  Radius, kernel, thickness; all photons within the radius count.
/// \param kinds   The kinds that count.
/// \param seed    Of the places in the discs.
/// \return In [0, 1]; 0 if fewer than 16 photons landed on each object.
/// \cost Five rays for each of at most 4096 photons.
template <AnyWorld W, std::floating_point T, typename K>
[[nodiscard, gnu::cold]] double edge_loss(const W& world, const PhotonMapT<T>& map,
                                          const DensityEstimateOf<K>& gather,
                                          PhotonKinds kinds, std::uint64_t seed) {
    constexpr int places = 4, few = 16;
    struct Landed {
        ObjectId object{};
        double flux = 0, found = 0;
        int photons = 1;
    };
    std::vector<Landed> all;
    const std::size_t step = map.records.size() / 4096 + 1;
    for (std::size_t i = 0; i < map.records.size(); i += step) {
        const detail::PhotonRecordT<T> photon = map.records[i];
        if (!kinds.has(photon.kind)) continue;
        const Vec3T<T> place = map.tree.point(i);
        const Vec3T<T> normal = glm::normalize(Vec3T<T>(photon.normal));
        const T near = T(1e-3f * gather.radius);
        const auto vertex = detail::vertex_below(world, place, normal, near);
        if (!vertex || vertex->emits()) continue; // what a lamp reflects hardly shows
        const FrameT<T> frame = frame_around(vertex->point.normal);
        auto stream = random_stream(seed, Pass::irradiance, 0, i);
        Landed landed{.object = vertex->id};
        for (int k = 0; k < places; ++k) {
            const T distance2 = (T(k) + next_1d<T>(stream)) / T(places);
            const T azimuth = T(2) * std::numbers::pi_v<T> * next_1d<T>(stream);
            const Vec3T<T> offset =
                std::sqrt(distance2) * (std::cos(azimuth) * frame.tangent +
                                        std::sin(azimuth) * frame.bitangent);
            const double flux = luminance(RgbT<double>(photon.flux));
            landed.flux += flux * double(kernel_weight(gather.kernel, distance2));
            landed.found +=
                flux * detail::found_along(world, vertex->point, offset, gather);
        }
        all.push_back(landed);
    }
    const auto order = [](const Landed& a, const Landed& b) {
        return a.object.type != b.object.type ? a.object.type < b.object.type
                                              : a.object.index < b.object.index;
    };
    std::sort(all.begin(), all.end(), order);
    double most = 0;
    const auto judge = [&](const Landed& sum) {
        if (sum.photons >= few) most = std::max(most, 1 - sum.found / sum.flux);
    };
    Landed rest{.photons = 0};
    for (auto i = all.begin(); i != all.end();) {
        Landed sum{.photons = 0};
        const auto end = std::upper_bound(i, all.end(), *i, order);
        for (; i != end; ++i) {
            sum.flux += i->flux;
            sum.found += i->found;
            ++sum.photons;
        }
        judge(sum);
        if (sum.photons >= few) continue;
        rest.flux += sum.flux;
        rest.found += sum.found;
        rest.photons += sum.photons;
    }
    judge(rest);
    return most;
}

/// \}

} // namespace ljus
