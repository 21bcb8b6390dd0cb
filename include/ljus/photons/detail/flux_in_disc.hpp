#pragma once

/// \file ljus/photons/detail/flux_in_disc.hpp
/// \brief The flux in a disc around a point, summed eight photons at a time.

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "ljus/accel/kd_tree8.hpp"
#include "ljus/photons/detail/photon_records.hpp"
#include "ljus/photons/kernel.hpp"

namespace ljus::detail {

/// The disc in which flux is summed. Photons are tested in the precision T.
template <std::floating_point T, KernelLike<T> K = Kernel>
struct FluxDiscT {
    Vec3T<T> center{T(0)};             ///< The centre.
    Vec3T<T> normal{T(0), T(0), T(1)}; ///< Unit normal of the surface.
    /// Unit normal of the side on which photons count.
    Vec3T<T> from{T(0), T(0), T(1)};
    T radius = T(1);      ///< The radius in scene units, between 1e-15 and 1e15.
    T thickness = T(0.5); ///< Half the height of the disc, divided by the radius.
    K kernel{};           ///< Gives the weight of a photon by its distance.
    PhotonKinds kinds = all_kinds; ///< The kinds of photons that count.
};

/// kernel_weight() of eight photons.
/// \param x  Eight squared distances over the squared radius, each in [0, 1].
template <std::floating_point T, KernelLike<T> K>
[[nodiscard]] LanesT<T> kernel_weights(const K& kernel, const LanesT<T>& x) noexcept {
    LanesT<T> weight;
    for_lanes([&](int i) { weight.lane[i] = kernel_weight(kernel, x.lane[i]); });
    return weight;
}

/// kernel_weight() of eight photons, for a kernel that is chosen at run time.
template <std::floating_point T>
[[nodiscard]] LanesT<T> kernel_weights(Kernel kernel, const LanesT<T>& x) noexcept {
    LanesT<T> weight;
    // One loop per kernel, without branches inside.
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

// Tests eight photons. The result is 1 for each photon in the disc, otherwise 0. There
// are several small loops, because compilers do not always vectorise a long loop.
template <std::floating_point T, typename K>
[[nodiscard]] inline LanesT<T>
lanes_in_disc(const Lanes3T<T>& points, const RecordBlockT<T>& record,
              const FluxDiscT<T, K>& disc, std::uint32_t found) noexcept {
    const T nx = disc.normal.x, ny = disc.normal.y, nz = disc.normal.z;
    const T cx = disc.center.x, cy = disc.center.y, cz = disc.center.z;
    const T limit = disc.thickness * disc.radius;
    const std::uint32_t kinds = std::uint32_t{disc.kinds.bits}
                                << RecordCode::kind_shift;
    LanesT<T> height, along, length2, inside;
    for_lanes([&](int i) {
        height.lane[i] =
            (points.x[i] - cx) * nx + (points.y[i] - cy) * ny + (points.z[i] - cz) * nz;
    });
    for_lanes([&](int i) {
        const T x = T(RecordCode::normal<0>(record.code[i]));
        const T y = T(RecordCode::normal<1>(record.code[i]));
        const T z = T(RecordCode::normal<2>(record.code[i]));
        along.lane[i] = T(2) * T(127) * (x * nx + y * ny + z * nz);
        length2.lane[i] = x * x + y * y + z * z;
    });
    for_lanes([&](int i) {
        const T h = height.lane[i];
        const bool in = (h <= limit) & (-h <= limit) &
                        !(along.lane[i] < length2.lane[i]) &
                        ((record.code[i] & kinds) != 0) & ((found & lane_bit[i]) != 0);
        inside.lane[i] = in ? T(1) : T(0);
    });
    return inside;
}

/// Sums the weighted flux of the photons that arrive on one side of a disc, block by
/// block.
template <std::floating_point T, typename K>
class DiscFluxT {
public:
    DiscFluxT(std::span<const RecordBlockT<T>> records,
              const FluxDiscT<T, K>& disc) noexcept
        : records_(records), disc_(disc),
          per_radius2_(T(1) / (disc.radius * disc.radius)) {}

    void add(const FoundBlockT<T>& block) noexcept {
        const RecordBlockT<T>& record = records_[block.first / 8];
        if (const std::uint32_t rest = block.found & (block.found - 1);
            (rest & (rest - 1)) == 0) {
            add_one(block, record, std::countr_zero(block.found));
            if (rest != 0) add_one(block, record, std::countr_zero(rest));
        } else {
            add_eight(block, record);
        }
        if (++parts_ == 16) add_part();
    }
    RgbT<double> sum() noexcept {
        if (parts_ > 0) add_part();
        return sum_;
    }
    /// The number of photons in the disc, on either side.
    std::uint64_t gathered() const noexcept {
        std::uint64_t all = 0;
        for (const std::int32_t lane : count_) all += static_cast<std::uint64_t>(lane);
        return all;
    }

private:
    void add_part() noexcept {
        for (std::size_t i = 0; i < lane_count / 2; ++i)
            sum_ += RgbT<double>(part_[i] + part_[i + lane_count / 2]);
        part_ = {};
        parts_ = 0;
    }
    // Adds one photon of a block, for blocks with one or two photons in the disc.
    void add_one(const FoundBlockT<T>& block, const RecordBlockT<T>& record,
                 int lane) noexcept {
        const auto i = static_cast<std::size_t>(lane);
        const std::uint32_t kinds = std::uint32_t{disc_.kinds.bits}
                                    << RecordCode::kind_shift;
        const std::uint32_t code = record.code[i];
        const T height = glm::dot(block.points[i] - disc_.center, disc_.normal);
        const SmallNormal normal = RecordCode::normal(code);
        if ((code & kinds) == 0 || std::abs(height) > disc_.thickness * disc_.radius ||
            turned_away(normal, disc_.normal))
            return;
        ++count_[0];
        if (!(glm::dot(record.direction[i], disc_.from) < T(0))) return;
        const T share = block.distance2.lane[i] * per_radius2_;
        const T weight = kernel_weight(disc_.kernel, share < T(1) ? share : T(1));
        part_.x[i] += weight * record.flux.x[i];
        part_.y[i] += weight * record.flux.y[i];
        part_.z[i] += weight * record.flux.z[i];
    }
    void add_eight(const FoundBlockT<T>& block,
                   const RecordBlockT<T>& record) noexcept {
        const LanesT<T> inside =
            lanes_in_disc(block.points, record, disc_, block.found);
        const Vec3T<T> d = disc_.from;
        const T per_radius2 = per_radius2_;
        // There are no branches, so that the loop vectorises. For a photon outside the
        // disc, infinity or NaN becomes 1.
        LanesT<T> shares, lit;
        for_lanes([&](int i) {
            const T share = block.distance2.lane[i] * per_radius2;
            shares.lane[i] = share < T(1) ? share : T(1);
        });
        const LanesT<T> weight = kernel_weights(disc_.kernel, shares);
        for_lanes([&](int i) {
            const T towards = record.direction.x[i] * d.x +
                              record.direction.y[i] * d.y + record.direction.z[i] * d.z;
            const T facing = towards < T(0) ? T(1) : T(0);
            lit.lane[i] = inside.lane[i] * facing * weight.lane[i];
        });
        for_lanes([&](int i) {
            part_.x[i] += lit.lane[i] * record.flux.x[i];
            part_.y[i] += lit.lane[i] * record.flux.y[i];
            part_.z[i] += lit.lane[i] * record.flux.z[i];
        });
        for_lanes(
            [&](int i) { count_[i] += static_cast<std::int32_t>(inside.lane[i]); });
    }

    std::span<const RecordBlockT<T>> records_;
    const FluxDiscT<T, K>& disc_;
    T per_radius2_;
    // The sum over at most 16 blocks. More terms would exceed the precision of float.
    Lanes3T<T> part_{};
    RgbT<double> sum_{0};
    std::int32_t count_[lane_count] = {};
    int parts_ = 0;
};

/// Sums the weighted flux of the photons that arrive on one side of a disc, in W.
/// \param gathered  A counter. The number of photons in the disc, on both sides, is
///                  added to it.
template <std::floating_point T, typename K>
[[nodiscard]] LJUS_CORE_CLONES RgbT<double>
flux_in_disc(const KdTree8T<T>& tree, const PhotonRecordsT<T>& records,
             const FluxDiscT<T, K>& disc, std::uint64_t& gathered) {
    DiscFluxT<T, K> flux(records.blocks(), disc);
    tree.visit_blocks(disc.center, disc.radius,
                      [&](const FoundBlockT<T>& block) { flux.add(block); });
    const RgbT<double> sum = flux.sum();
    gathered += flux.gathered();
    return sum;
}

} // namespace ljus::detail
