#pragma once

/// \file ljus/photons/lane_estimate.hpp
/// \brief The flux around a point, eight photons at a time.

#include <bit>
#include <limits>

#include "ljus/photons/kernel.hpp"
#include "ljus/photons/photon_records.hpp"
#include "ljus/photons/wide_kd_tree.hpp"

namespace ljus {

/// \addtogroup photon_map
/// \{

/// A disc in which flux is summed: what decides on a photon, in the precision of the
/// photons.
template <std::floating_point T>
struct FluxDiscT {
    Vec3T<T> center{T(0)};                ///< Its middle.
    Vec3T<T> normal{T(0), T(0), T(1)};    ///< Of the surface; unit.
    Vec3T<T> from{T(0), T(0), T(1)};      ///< Photons must travel against it.
    T radius = T(1);                      ///< Between 1e-15 and 1e15.
    T thickness = T(0.5);                 ///< Half its height over its radius.
    Kernel kernel = Kernel::epanechnikov; ///< The weight by distance.
    PhotonKinds kinds = all_kinds;        ///< Which kinds count.
};

/// The weighted flux in a disc, of photons that come from one side.
///
/// The same photons as one by one, and the same weights within the rounding of T.
/// \param tree      Where the photons are.
/// \param records   What they carry.
/// \param disc      Which of them count.
/// \param gathered  Counts those that lie in the disc, from either side.
/// \return The sum of weight times flux; W.
// [flux in disc]
template <std::floating_point T>
[[nodiscard]] RgbT<double>
flux_in_disc(const WideKdTreeT<T>& tree, const PhotonRecordsT<T>& records,
             const FluxDiscT<T>& disc, std::uint64_t& gathered) {
    const T per_radius2 = T(1) / (disc.radius * disc.radius);
    const T height = disc.thickness * disc.radius;
    const Vec3T<T> c = disc.center, n = disc.normal, d = disc.from;
    RgbT<double> sum{0};
    BlockT<T> part{}; // of some blocks: more terms would cost a float its last digits
    int parts = 0;
    const auto add_part = [&] {
        for (std::size_t i = 0; i < lane_count; ++i) sum += RgbT<double>(part[i]);
        part = {};
        parts = 0;
    };
    const auto visit = [&](const FoundBlockT<T>& block) {
        const RecordBlockT<T>& record = records.blocks()[block.first / 8];
        T x[lane_count], weight[lane_count];
        std::int32_t inside[lane_count];
        std::int32_t count = 0;
        for_lanes([&](int i) {
            const T h = (block.points.x[i] - c.x) * n.x +
                        (block.points.y[i] - c.y) * n.y +
                        (block.points.z[i] - c.z) * n.z;
            const T nx = T(record.nx[i]), ny = T(record.ny[i]), nz = T(record.nz[i]);
            const T along = nx * n.x + ny * n.y + nz * n.z;
            const bool turned = T(2) * T(127) * along < nx * nx + ny * ny + nz * nz;
            const auto kind = static_cast<std::uint32_t>(record.kind[i]);
            x[i] = block.distance2.lane[i] * per_radius2;
            inside[i] = (x[i] < std::numeric_limits<T>::infinity()) & (h <= height) &
                        (-h <= height) & !turned &
                        static_cast<int>(disc.kinds.bits >> kind & 1u);
            count += inside[i];
        });
        gathered += static_cast<std::uint64_t>(count);
        for_lanes([&](int i) {
            weight[i] = kernel_weight(disc.kernel, inside[i] != 0 ? x[i] : T(0));
        });
        for_lanes([&](int i) {
            const T towards = record.direction.x[i] * d.x +
                              record.direction.y[i] * d.y + record.direction.z[i] * d.z;
            const bool lit = (inside[i] != 0) & (towards < T(0));
            const T w = lit ? weight[i] : T(0);
            part.x[i] += w * record.flux.x[i];
            part.y[i] += w * record.flux.y[i];
            part.z[i] += w * record.flux.z[i];
        });
        if (++parts == 16) add_part();
    };
    tree.visit_blocks(c, disc.radius, visit);
    if (parts > 0) add_part();
    return sum;
}
// [flux in disc]

/// \}

} // namespace ljus
