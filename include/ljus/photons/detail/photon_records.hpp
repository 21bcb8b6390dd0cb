#pragma once

/// \file ljus/photons/detail/photon_records.hpp
/// \brief The data of a map's photons, except for their positions, in blocks of eight.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "ljus/accel/detail/stored_array.hpp"
#include "ljus/math/lanes.hpp"
#include "ljus/parallel.hpp"
#include "ljus/photons/photon.hpp"

namespace ljus::detail {

/// The data of a photon, except for its position.
template <std::floating_point T>
struct PhotonRecordT {
    Vec3T<T> direction{T(0)};             ///< Unit direction of travel.
    RgbT<T> flux{T(0)};                   ///< The flux in W.
    std::uint16_t light = 0;              ///< Index of the light.
    PhotonKind kind = PhotonKind::direct; ///< The kind.
    SmallNormal normal{0};                ///< Normal of the surface.
};

/// Eight records. Each field has the values of all eight photons. A block takes 256
/// bytes in float.
template <std::floating_point T>
struct RecordBlockT {
    Lanes3T<T> direction;            ///< Unit directions of travel.
    Lanes3T<T> flux;                 ///< The flux in W.
    std::uint16_t light[lane_count]; ///< Indices of the lights.
    std::uint32_t code[lane_count];  ///< Kinds and normals; see RecordCode.
    std::uint32_t unused[4];         ///< 0, so that saved maps have defined bytes.
};

// The kind of a photon and its normal, in 32 bits. A field has the same position in all
// eight numbers of a block, so that one instruction can extract the field from all.
struct RecordCode {
    // The bits of one_kind() follow the three bytes of the normal.
    static constexpr int kind_shift = 24;

    [[nodiscard]] static std::uint32_t of(PhotonKind kind, SmallNormal n) noexcept {
        const auto byte = [](std::int8_t c) {
            return std::uint32_t{static_cast<std::uint8_t>(c)};
        };
        return std::uint32_t{one_kind(kind).bits} << kind_shift | byte(n.x) |
               byte(n.y) << 8 | byte(n.z) << 16;
    }
    [[nodiscard]] static PhotonKind kind(std::uint32_t code) noexcept {
        return static_cast<PhotonKind>(std::countr_zero(code >> kind_shift));
    }
    // A coordinate of the normal. The second shift restores the sign.
    template <int axis>
    [[nodiscard]] static constexpr std::int32_t normal(std::uint32_t code) noexcept {
        return static_cast<std::int32_t>(code << (24 - 8 * axis)) >> 24;
    }
    [[nodiscard]] static SmallNormal normal(std::uint32_t code) noexcept {
        return {normal<0>(code), normal<1>(code), normal<2>(code)};
    }
};

/// The PhotonRecordT of a map in the order of its k-d tree, stored in blocks of eight.
template <std::floating_point T>
class PhotonRecordsT {
public:
    PhotonRecordsT() = default;

    /// Makes a list of `count` records. The last block is padded with 0.
    PhotonRecordsT(StoredArray<RecordBlockT<T>> blocks, std::size_t count) noexcept
        : blocks_(std::move(blocks)), size_(count) {}

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
    [[nodiscard]] PhotonRecordT<T> operator[](std::size_t index) const noexcept {
        const RecordBlockT<T>& block = blocks_[index / 8];
        const std::size_t i = index % 8;
        return {block.direction[i], block.flux[i], block.light[i],
                RecordCode::kind(block.code[i]), RecordCode::normal(block.code[i])};
    }
    [[nodiscard]] std::size_t bytes() const noexcept {
        return blocks_.span().size_bytes();
    }
    [[nodiscard]] std::span<const RecordBlockT<T>> blocks() const noexcept {
        return blocks_.span();
    }
    /// The blocks with their memory.
    [[nodiscard]] const StoredArray<RecordBlockT<T>>& stored() const noexcept {
        return blocks_;
    }

private:
    StoredArray<RecordBlockT<T>> blocks_;
    std::size_t size_ = 0;
};

/// Receives records one by one, and then sorts them.
template <std::floating_point T>
class RecordSorterT {
public:
    void add(const PhotonT<T>& photon) {
        if (size_ % 8 == 0) blocks_.resize(size_ / 8 + 1);
        put(size_++,
            {photon.direction, photon.flux, photon.light, photon.kind, photon.normal});
    }

    /// Sorts the records in place, and moves them into the result.
    /// \param order  order[i] is the index of the record that becomes record i.
    /// \cost O(n), and 4 bytes per record.
    [[nodiscard]] PhotonRecordsT<T> sorted(std::span<const std::uint32_t> order,
                                           int threads) {
        std::vector<std::uint32_t> to(size_);
        for (std::size_t i = 0; i < size_; ++i)
            to[order[i]] = static_cast<std::uint32_t>(i);
        const auto exchange = [&](std::size_t i, std::size_t j) {
            const PhotonRecordT<T> record = get(i);
            put(i, get(j));
            put(j, record);
            std::swap(to[i], to[j]);
        };
        // Records are first moved into groups that fit into a cache, and then sorted
        // within each group. This causes fewer cache misses.
        constexpr std::size_t group = 4096;
        GrowingArray<std::size_t> next; // the first unsettled index of each group
        for (std::size_t i = 0; i < size_; i += group) next.push_back(i);
        for (std::size_t g = 0; g < next.size(); ++g)
            for (const std::size_t end = std::min((g + 1) * group, size_);
                 next[g] < end;) {
                const std::size_t other = to[next[g]] / group;
                if (other != g) exchange(next[g], next[other]);
                ++next[other];
            }
        const auto settle = [&](long long number) {
            const auto first = static_cast<std::size_t>(number) * group;
            const std::size_t end = std::min(first + group, size_);
            GrowingArray<PhotonRecordT<T>> records(end - first);
            for (std::size_t i = first; i < end; ++i) records[to[i] - first] = get(i);
            for (std::size_t i = first; i < end; ++i) {
                if (i % 8 == 0) blocks_[i / 8] = {};
                set(i, records[i - first]);
            }
        };
        parallel_blocks(static_cast<long long>(next.size()), settle,
                        {.threads = threads});
        blocks_.shrink_to_fit();
        return {std::move(blocks_), size_};
    }

private:
    // Until the records are sorted, a block holds eight of them one after another.
    static_assert(8 * sizeof(PhotonRecordT<T>) <= sizeof(RecordBlockT<T>));
    [[nodiscard]] PhotonRecordT<T> get(std::size_t index) const noexcept {
        PhotonRecordT<T> record;
        std::memcpy(static_cast<void*>(&record),
                    reinterpret_cast<const char*>(&blocks_[index / 8]) +
                        index % 8 * sizeof record,
                    sizeof record);
        return record;
    }
    void put(std::size_t index, const PhotonRecordT<T>& record) noexcept {
        std::memcpy(reinterpret_cast<char*>(&blocks_[index / 8]) +
                        index % 8 * sizeof record,
                    static_cast<const void*>(&record), sizeof record);
    }
    void set(std::size_t index, const PhotonRecordT<T>& record) noexcept {
        RecordBlockT<T>& block = blocks_[index / 8];
        const std::size_t i = index % 8;
        block.direction.set(i, record.direction);
        block.flux.set(i, record.flux);
        block.light[i] = record.light;
        block.code[i] = RecordCode::of(record.kind, record.normal);
    }

    GrowingArray<RecordBlockT<T>> blocks_;
    std::size_t size_ = 0;
};

} // namespace ljus::detail
