#pragma once

/// \file ljus/photons/detail/photon_records.hpp
/// \brief What a photon map keeps besides positions: eight photons side by side.

#include <bit>
#include <cstddef>
#include <vector>

#include "ljus/math/lanes.hpp"
#include "ljus/photons/photon.hpp"

namespace ljus::detail {

/// \addtogroup photon_map
/// \{

/// What a photon map keeps of a photon besides its position.
template <std::floating_point T>
struct PhotonRecordT {
    Vec3T<T> direction{T(0)};             ///< Unit, the way it travels.
    RgbT<T> flux{T(0)};                   ///< W.
    std::uint16_t light = 0;              ///< The number of its light.
    PhotonKind kind = PhotonKind::direct; ///< What has happened to it.
    SmallNormal normal{0};                ///< Of the surface that it met.
};

/// Eight records, field by field: 256 bytes in float, which an estimate reads at once.
template <std::floating_point T>
struct RecordBlockT {
    Lanes3T<T> direction;            ///< Unit, the way they travel.
    Lanes3T<T> flux;                 ///< W.
    std::uint16_t light[lane_count]; ///< The numbers of their lights.
    std::uint32_t code[lane_count];  ///< What has happened to them, and their normals.
};

// A photon's kind and its normal in 32 bits. Every machine shifts eight numbers by the
// same count in one instruction, so that lanes can take the fields apart.
struct RecordCode {
    // The kind as one_kind() has it, above the three bytes of the normal.
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
    // A coordinate of the normal: its byte to the top, and down again with its sign.
    template <int axis>
    [[nodiscard]] static constexpr std::int32_t normal(std::uint32_t code) noexcept {
        return static_cast<std::int32_t>(code << (24 - 8 * axis)) >> 24;
    }
    [[nodiscard]] static SmallNormal normal(std::uint32_t code) noexcept {
        return {normal<0>(code), normal<1>(code), normal<2>(code)};
    }
};

/// Records in the order of a tree, eight side by side. To the reader a list of
/// PhotonRecordT, by operator[] and size().
template <std::floating_point T>
class PhotonRecordsT {
public:
    /// No records.
    PhotonRecordsT() = default;

    /// The records of photons, in a given order.
    /// \param photons  The photons.
    /// \param order    Their numbers, in the order that the records shall have.
    PhotonRecordsT(const std::vector<PhotonT<T>>& photons,
                   const std::vector<std::uint32_t>& order)
        : blocks_((order.size() + 7) / 8, RecordBlockT<T>{}), size_(order.size()) {
        for (std::size_t i = 0; i < size_; ++i) {
            const PhotonT<T>& photon = photons[order[i]];
            set(i, {photon.direction, photon.flux, photon.light, photon.kind,
                    photon.normal});
        }
    }

    /// How many there are.
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// Whether there are none.
    [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
    /// One of them.
    /// \param index  In the order of the tree, below size().
    [[nodiscard]] PhotonRecordT<T> operator[](std::size_t index) const noexcept {
        const RecordBlockT<T>& block = blocks_[index / 8];
        const std::size_t i = index % 8;
        return {block.direction[i], block.flux[i], block.light[i],
                RecordCode::kind(block.code[i]), RecordCode::normal(block.code[i])};
    }
    /// The memory that they take.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return blocks_.size() * sizeof(RecordBlockT<T>);
    }
    /// All of them, eight by eight; what fills up the last eight is 0.
    [[nodiscard]] const std::vector<RecordBlockT<T>>& blocks() const noexcept {
        return blocks_;
    }

private:
    void set(std::size_t index, const PhotonRecordT<T>& record) noexcept {
        RecordBlockT<T>& block = blocks_[index / 8];
        const std::size_t i = index % 8;
        block.direction.set(i, record.direction);
        block.flux.set(i, record.flux);
        block.light[i] = record.light;
        block.code[i] = RecordCode::of(record.kind, record.normal);
    }

    std::vector<RecordBlockT<T>> blocks_;
    std::size_t size_ = 0;
};

/// \}

} // namespace ljus::detail
