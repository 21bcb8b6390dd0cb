#pragma once

/// \file ljus/math/lanes.hpp
/// \brief Eight floats at a time, without a line of assembly.

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ljus/math/vector.hpp"
#include "ljus/version.hpp"

namespace ljus {

/// \defgroup lanes Lanes
/// \brief Eight numbers side by side: loops of a constant length, which compilers turn
/// into the widest instructions that they may use.
/// \{

/// How many numbers stand side by side.
inline constexpr int lane_count = 8;

/// Eight floats.
struct alignas(32) Lanes {
    float lane[lane_count]; ///< The numbers.
};

/// Eight answers: all bits of a lane set for yes, none for no.
struct alignas(32) LaneMask {
    std::int32_t lane[lane_count]; ///< -1 or 0.
};

/// Eight points, or directions, by coordinate.
struct Lanes3 {
    Lanes x; ///< First coordinates.
    Lanes y; ///< Second coordinates.
    Lanes z; ///< Third coordinates.
};

/// The same number in every lane.
[[nodiscard]] constexpr Lanes all_lanes(float value) noexcept {
    Lanes result{};
    for (int i = 0; i < lane_count; ++i) result.lane[i] = value;
    return result;
}

/// The same point in every lane.
[[nodiscard]] constexpr Lanes3 all_lanes(const Vec3& v) noexcept {
    return {all_lanes(v.x), all_lanes(v.y), all_lanes(v.z)};
}

/// Applies a function lane by lane.
/// \param f  Called as f(a.lane[i], ...); returns a float.
/// \param a  The first argument's lanes.
/// \param b  The other arguments' lanes.
/// \return The results.
// [lanes]
template <typename F, typename... B>
[[nodiscard]] constexpr Lanes each_lane(F f, const Lanes& a, const B&... b) noexcept {
    Lanes result{};
    for (int i = 0; i < lane_count; ++i) result.lane[i] = f(a.lane[i], b.lane[i]...);
    return result;
}

/// \name Arithmetic, lane by lane
/// \{

/// The operation on each pair of lanes.
[[nodiscard]] constexpr Lanes operator+(const Lanes& a, const Lanes& b) noexcept {
    return each_lane([](float x, float y) { return x + y; }, a, b);
}
[[nodiscard]] constexpr Lanes operator-(const Lanes& a, const Lanes& b) noexcept {
    return each_lane([](float x, float y) { return x - y; }, a, b);
}
[[nodiscard]] constexpr Lanes operator*(const Lanes& a, const Lanes& b) noexcept {
    return each_lane([](float x, float y) { return x * y; }, a, b);
}
[[nodiscard]] constexpr Lanes operator/(const Lanes& a, const Lanes& b) noexcept {
    return each_lane([](float x, float y) { return x / y; }, a, b);
}
/// \}
// [lanes]

/// The smaller of each pair; b where a is NaN.
[[nodiscard]] constexpr Lanes min(const Lanes& a, const Lanes& b) noexcept {
    return each_lane([](float x, float y) { return x < y ? x : y; }, a, b);
}

/// The larger of each pair; b where a is NaN.
[[nodiscard]] constexpr Lanes max(const Lanes& a, const Lanes& b) noexcept {
    return each_lane([](float x, float y) { return x > y ? x : y; }, a, b);
}

/// The square roots; NaN of what is below 0.
[[nodiscard]] inline Lanes sqrt(const Lanes& a) noexcept {
    return each_lane([](float x) { return std::sqrt(x); }, a);
}

/// Whether a <= b; no where either is NaN.
[[nodiscard]] constexpr LaneMask operator<=(const Lanes& a, const Lanes& b) noexcept {
    LaneMask result{};
    for (int i = 0; i < lane_count; ++i)
        result.lane[i] = a.lane[i] <= b.lane[i] ? -1 : 0;
    return result;
}

/// Whether both.
[[nodiscard]] constexpr LaneMask operator&(const LaneMask& a,
                                           const LaneMask& b) noexcept {
    LaneMask result{};
    for (int i = 0; i < lane_count; ++i) result.lane[i] = a.lane[i] & b.lane[i];
    return result;
}

/// Whether any lane says yes.
[[nodiscard]] constexpr bool any(const LaneMask& mask) noexcept {
    std::int32_t bits = 0;
    for (int i = 0; i < lane_count; ++i) bits |= mask.lane[i];
    return bits != 0;
}

/// The lanes that say yes, as a number to take them from one by one: eight bits a lane.
/// Written in the two steps that compilers know: to bytes, and those into one register.
/// \param mask  The answers.
/// \return 0 for none.
// [yes_lanes]
[[nodiscard]] constexpr std::uint64_t yes_lanes(const LaneMask& mask) noexcept {
    std::array<std::int8_t, lane_count> bytes{};
    for (std::size_t i = 0; i < lane_count; ++i)
        bytes[i] = static_cast<std::int8_t>(mask.lane[i]);
    return std::bit_cast<std::uint64_t>(bytes) & 0x0101010101010101u;
}
// [yes_lanes]

/// Takes a lane out of what yes_lanes() returned.
/// \param lanes  Not 0; becomes what is left.
/// \return The lane's place.
[[nodiscard]] constexpr std::size_t take_lane(std::uint64_t& lanes) noexcept {
    const auto place = static_cast<std::size_t>(std::countr_zero(lanes)) / 8;
    lanes &= lanes - 1;
    return std::endian::native == std::endian::little ? place : lane_count - 1 - place;
}

/// a where the mask says yes, b elsewhere.
[[nodiscard]] constexpr Lanes select(const LaneMask& mask, const Lanes& a,
                                     const Lanes& b) noexcept {
    Lanes result{};
    for (int i = 0; i < lane_count; ++i)
        result.lane[i] = mask.lane[i] != 0 ? a.lane[i] : b.lane[i];
    return result;
}

/// \name Vectors, lane by lane
/// \{

/// The operation on each pair of vectors.
[[nodiscard]] constexpr Lanes3 operator-(const Lanes3& a, const Lanes3& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] constexpr Lanes dot(const Lanes3& a, const Lanes3& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] constexpr Lanes3 cross(const Lanes3& a, const Lanes3& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// \}

/// \}

/// \defgroup prefetch Prefetching
/// \brief A processor waits for its memory some hundred steps; it can be told in time.
/// \{

/// Says that `lines` cache lines of 64 bytes will soon be read. A hint: where a
/// compiler has none to give, nothing happens, and all answers are the same.
/// \param address  Where the first begins; any address.
/// \cost An instruction a line.
// [prefetch]
template <int lines = 1>
inline void prefetch([[maybe_unused]] const void* address) noexcept {
#if defined(__GNUC__) // clang says so, too
    for (int i = 0; i < lines; ++i)
        __builtin_prefetch(static_cast<const char*>(address) + 64 * i);
#endif
}
// [prefetch]

/// \}

} // namespace ljus
