#pragma once

/// \file ljus/io/detail/map_key.hpp
/// \brief What a saved map was made from, so that it is used for nothing else.

#include <cstddef>
#include <typeinfo>
#include <utility>

#include "ljus/io/binary_file.hpp"
#include "ljus/scene/query.hpp"

namespace ljus {

/// \addtogroup file
/// \{

/// What a map was made from, in two numbers: light_map_key() makes them. A map that is
/// saved with one key is loaded with no other, so that the map of a scene that was
/// changed since is not used in silence.
struct MapKey {
    std::uint64_t scene = 0;    ///< Of shapes, materials and lights.
    std::uint64_t settings = 0; ///< Of the settings that change the map.
    /// Whether both are of the same.
    friend bool operator==(const MapKey&, const MapKey&) = default;
};

namespace detail {

// Stands for a member of any type, to count the members of an aggregate.
template <typename Whole>
struct AnyMember {
    template <typename Member>
    requires(!std::is_same_v<Member, Whole>) operator Member() const;
};

// How many members an aggregate has; 11 for all that have more than ten.
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

// FNV-1a of the numbers that values hold, in the order of their members: the same on
// every machine. Their names and padding do not count; what a list holds, and how much
// of it there is, does.
struct FieldHash {
    std::uint64_t value = fnv_start;

    template <typename... V>
    void add(const V&... values) {
        (add_one(values), ...);
    }

    // Types of equal members are told apart. Two families of compilers name types in
    // two ways.
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
        } else if constexpr (requires { v.data(); }) { // made once of data, as a mesh
            add(v.data());
        } else {
            static_assert(std::is_aggregate_v<V>,
                          "What a map is made from must be a struct with public "
                          "members, or have a data() that returns one.");
            add_members(v);
        }
    }

    template <typename V>
    void add_members(const V& v) {
        constexpr std::size_t count = member_count<V>();
        static_assert(count <= 10, "What a map is made from may have ten members: put "
                                   "some of them into a struct.");
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

// All that is part of a scene, which its camera is not.
template <typename S>
[[nodiscard]] std::uint64_t scene_hash(const S& scene) {
    FieldHash hash;
    const auto lists = [&](const auto&... list) {
        (hash.template add_name_of<
             typename std::remove_cvref_t<decltype(list)>::value_type>(),
         ...);
        hash.add(list...);
    };
    std::apply(lists, scene.shapes);
    std::apply(lists, scene.materials);
    hash.add(scene.objects, scene.lights);
    return hash.value;
}

inline void put_key(Bytes& bytes, const MapKey& key) {
    put_number(bytes, key.scene);
    put_number(bytes, key.settings);
}

// Takes the key of a file, and refuses another.
inline void require_key(FileReader& file, const MapKey& key) {
    file.position = file_front_bytes;
    if (file.left() < map_key_bytes) file.refuse("it ends in the middle of its key");
    if (file.take<std::uint64_t>() != key.scene)
        file.refuse("it was made for another scene, with other shapes, materials or "
                    "lights; make it anew");
    if (file.take<std::uint64_t>() != key.settings)
        file.refuse("it was made with other settings; make it anew, or ask for those "
                    "that it was made with");
}

} // namespace detail

/// \}

} // namespace ljus
