#pragma once

/// \file ljus/math/field_hash.hpp
/// \brief A hash of all members of a struct. A saved light map keeps the hash of
/// everything that the map was computed from.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <typeinfo>
#include <utility>

#include "ljus/version.hpp"

namespace ljus::detail {

// The unsigned integer type with the size of Number.
template <typename Number>
using BitsOf = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;

// The bytes of a number, lowest first on every machine.
template <typename Number>
[[nodiscard]] std::array<unsigned char, sizeof(Number)>
bytes_of(Number value) noexcept {
    std::uint64_t bits = 0;
    if constexpr (std::is_floating_point_v<Number>)
        bits = std::bit_cast<BitsOf<Number>>(value);
    else
        bits = static_cast<std::uint64_t>(value);
    std::array<unsigned char, sizeof(Number)> bytes{};
    for (std::size_t i = 0; i < sizeof(Number); ++i)
        bytes[i] = static_cast<unsigned char>(bits >> (8 * i) & 255u);
    return bytes;
}

// One step of 64-bit FNV-1a: adds a byte to a hash.
inline constexpr std::uint64_t fnv_start = 0xcbf29ce484222325u;
constexpr std::uint64_t fnv_hash(std::uint64_t hash, unsigned char byte) noexcept {
    return (hash ^ byte) * 0x100000001b3u;
}

// A value that converts to any type. member_count() uses it to count the members of an
// aggregate.
template <typename Whole>
struct AnyMember {
    template <typename Member>
    requires(!std::is_same_v<Member, Whole>) operator Member() const;
};

// The number of members of an aggregate; 11 stands for more than ten.
template <typename A, std::size_t N = 11>
constexpr std::size_t member_count() noexcept {
    constexpr bool fits = []<std::size_t... I>(std::index_sequence<I...>) {
        return requires {
            A{((void)I, AnyMember<A>{})...};
        };
    }
    (std::make_index_sequence<N>{});
    if constexpr (fits || N == 0)
        return N;
    else
        return member_count<A, N - 1>();
}

// The FNV-1a hash of all numbers in some values, in the order of the members. The
// length of each list counts, names and padding do not. The hash is the same on every
// machine.
struct FieldHash {
    std::uint64_t value = fnv_start;

    template <typename... V>
    void add(const V&... values) {
        (add_one(values), ...);
    }

    // Adds the name of a type, so that types with equal members differ. g++ and clang
    // use the same name; another compiler may use another.
    template <typename V>
    void add_name_of() {
        for (const char* c = typeid(V).name(); *c != '\0'; ++c) add(*c);
    }

private:
    template <typename V>
    void add_one(const V& v) {
        if constexpr (std::is_arithmetic_v<V> || std::is_enum_v<V>) {
            for (const unsigned char byte : bytes_of(v)) value = fnv_hash(value, byte);
        } else if constexpr (requires { v.length(), v.x; }) { // a vector of GLM
            for (int i = 0; i < v.length(); ++i) add(v[i]);
        } else if constexpr (requires { v.has_value(), *v; }) {
            add(v.has_value());
            if (v) add(*v);
        } else if constexpr (requires { v.begin(), v.end(), v.size(); }) {
            add(std::uint64_t(v.size()));
            for (const auto& each : v) add(each);
        } else if constexpr (requires { v.data(); }) { // a mesh
            add(v.data());
        } else {
            static_assert(std::is_aggregate_v<V>,
                          "A type that goes into a light map's key must be a struct "
                          "with public members, or have a data() that returns one.");
            add_members(v);
        }
    }

    template <typename V>
    void add_members(const V& v) {
        constexpr std::size_t count = member_count<V>();
        static_assert(count <= 10,
                      "A type that goes into a light map's key may have at "
                      "most ten members: put some of them into a struct.");
        if constexpr (count == 1) {
            const auto& [a] = v;
            add(a);
        } else if constexpr (count == 2) {
            const auto& [a, b] = v;
            add(a, b);
        } else if constexpr (count == 3) {
            const auto& [a, b, c] = v;
            add(a, b, c);
        } else if constexpr (count == 4) {
            const auto& [a, b, c, d] = v;
            add(a, b, c, d);
        } else if constexpr (count == 5) {
            const auto& [a, b, c, d, e] = v;
            add(a, b, c, d, e);
        } else if constexpr (count == 6) {
            const auto& [a, b, c, d, e, f] = v;
            add(a, b, c, d, e, f);
        } else if constexpr (count == 7) {
            const auto& [a, b, c, d, e, f, g] = v;
            add(a, b, c, d, e, f, g);
        } else if constexpr (count == 8) {
            const auto& [a, b, c, d, e, f, g, h] = v;
            add(a, b, c, d, e, f, g, h);
        } else if constexpr (count == 9) {
            const auto& [a, b, c, d, e, f, g, h, i] = v;
            add(a, b, c, d, e, f, g, h, i);
        } else if constexpr (count == 10) {
            const auto& [a, b, c, d, e, f, g, h, i, j] = v;
            add(a, b, c, d, e, f, g, h, i, j);
        }
    }
};

} // namespace ljus::detail
