#pragma once

/// \file ljus/io/detail/map_key.hpp
/// \brief What a saved map was made from, so that it is used for nothing else.

#include "ljus/io/detail/field_hash.hpp"
#include "ljus/scene/query.hpp"

namespace ljus {

/// \addtogroup file
/// \{

/// What a map was made from, in two numbers: photon_map_key() and light_map_key() make
/// them. A map that is saved with one key is loaded with no other, so that the map of a
/// scene that was changed since is not used in silence.
struct MapKey {
    std::uint64_t scene = 0;    ///< Of shapes, materials and lights.
    std::uint64_t settings = 0; ///< Of the settings that change the map.
    /// Whether both are of the same.
    friend bool operator==(const MapKey&, const MapKey&) = default;
};

namespace detail {

// All that is part of a scene. A camera is none.
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
inline void require_key(MapReader& file, const MapKey& key) {
    file.position = map_header;
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
