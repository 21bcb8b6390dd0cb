#pragma once

/// \file ljus/photons/detail/flux_in_disc.hpp
/// \brief The flux around a point, eight photons at a time.

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "ljus/accel/kd_tree8.hpp"
#include "ljus/photons/detail/photon_records.hpp"
#include "ljus/photons/kernel.hpp"

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

/// kernel_weight() of eight photons.
/// \param kernel  The shape.
/// \param x       Squared distances over the squared radius, each in [0, 1].
template <std::floating_point T>
[[nodiscard]] LanesT<T> kernel_weights(Kernel kernel, const LanesT<T>& x) noexcept {
    LanesT<T> weight;
    // One loop a kernel: a constant in it, and no choice.
    const auto fill = [&](auto chosen) {
        for_lanes([&](int i) { weight.lane[i] = kernel_weight(chosen(), x.lane[i]); });
    };
    switch (kernel) {
    case Kernel::box:
        fill([] { return Kernel::box; });
        break;
    case Kernel::cone:
        fill([] { return Kernel::cone; });
        break;
    case Kernel::gaussian:
        fill([] { return Kernel::gaussian; });
        break;
    case Kernel::epanechnikov:
        fill([] { return Kernel::epanechnikov; });
        break;
    case Kernel::biweight:
        fill([] { return Kernel::biweight; });
        break;
    }
    return weight;
}

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
flux_in_disc(const KdTree8T<T>& tree, const PhotonRecordsT<T>& records,
             const FluxDiscT<T>& disc, std::uint64_t& gathered) {
    const T per_radius2 = T(1) / (disc.radius * disc.radius);
    const T height = disc.thickness * disc.radius;
    const std::uint32_t kinds = std::uint32_t{disc.kinds.bits}
                                << detail::RecordCode::kind_shift;
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
        LanesT<T> shares;
        std::int32_t inside[lane_count];
        std::int32_t count = 0;
        for_lanes([&](int i) {
            const T h = (block.points.x[i] - c.x) * n.x +
                        (block.points.y[i] - c.y) * n.y +
                        (block.points.z[i] - c.z) * n.z;
            const std::uint32_t code = record.code[i];
            const T x = T(detail::RecordCode::normal<0>(code));
            const T y = T(detail::RecordCode::normal<1>(code));
            const T z = T(detail::RecordCode::normal<2>(code));
            const T along = x * n.x + y * n.y + z * n.z;
            const T length2 = x * x + y * y + z * z;
            const T share = block.distance2.lane[i] * per_radius2;
            const std::int32_t in = (share < std::numeric_limits<T>::infinity()) &
                                    (h <= height) & (-h <= height) &
                                    !(T(2) * T(127) * along < length2) &
                                    ((code & kinds) != 0);
            shares.lane[i] = in != 0 ? share : T(0);
            inside[i] = in;
            count += in;
        });
        gathered += static_cast<std::uint64_t>(count);
        const LanesT<T> weight = kernel_weights(disc.kernel, shares);
        for_lanes([&](int i) {
            const T towards = record.direction.x[i] * d.x +
                              record.direction.y[i] * d.y + record.direction.z[i] * d.z;
            const bool lit = (inside[i] != 0) & (towards < T(0));
            const T w = lit ? weight.lane[i] : T(0);
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
