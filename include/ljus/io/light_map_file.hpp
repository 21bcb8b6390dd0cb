#pragma once

/// \file ljus/io/light_map_file.hpp
/// \brief Saves and loads light maps.

#include <algorithm>
#include <optional>
#include <string>

#include "ljus/io/binary_file.hpp"
#include "ljus/radiosity/radiosity.hpp"

namespace ljus {

/// \defgroup light_map_file Light maps in files
/// \brief Saves and loads light maps: "radiosity can easily be precomputed since it is
/// view independent" (Section 2.2 of the report).
///
/// A file has the header of \ref binary_file, with the number of patch grids and the
/// hash of the scene. Then follow the hash of the settings, the grids, and the
/// irradiance of each patch as three doubles.
/// \{

namespace detail {

inline constexpr FileFormat light_map_format{"ljus light map\n\n", 3};
inline constexpr std::size_t grid_bytes = 20;
inline constexpr std::size_t light_bytes = 24;

inline void put_grid(Bytes& bytes, const PatchGrid& grid) {
    const std::uint32_t how = static_cast<std::uint32_t>(grid.kind) +
                              (grid.back ? 4u : 0u) + (grid.inward ? 8u : 0u);
    for (const std::uint32_t number :
         {grid.object.type, grid.object.index, how, grid.columns, grid.rows})
        put_number(bytes, number);
}

// Reads the next grid, except its member `first`; nothing if a number is not valid.
[[nodiscard]] inline std::optional<PatchGrid> take_grid(FileReader& file) {
    PatchGrid grid;
    grid.object.type = file.take<std::uint32_t>();
    grid.object.index = file.take<std::uint32_t>();
    const auto how = file.take<std::uint32_t>();
    grid.columns = file.take<std::uint32_t>();
    grid.rows = file.take<std::uint32_t>();
    const bool square = grid.columns == grid.rows;
    if (how % 4 > 2 || how > 15 || grid.columns < 1 || grid.rows < 1 ||
        grid.columns > 65535 || grid.rows > 65535 || (how % 4 == 1 && !square) ||
        (how % 4 == 2 && (grid.columns < 2 || grid.rows < 3)))
        return std::nullopt;
    grid.kind = static_cast<GridKind>(how % 4);
    grid.back = (how & 4u) != 0;
    grid.inward = (how & 8u) != 0;
    return grid;
}

// Reads the key of a file, and throws if it differs from `key`.
inline void require_key(FileReader& file, const LightMapKey& key) {
    if (file.bytes.size() < file_front_bytes + key_bytes)
        file.refuse("it ends in the middle of its key");
    if (file.take<std::uint64_t>() != key.scene)
        file.refuse("it was made for another scene, with other shapes, materials or "
                    "lights; make it again for this scene");
    if (file.take<std::uint64_t>() != key.settings)
        file.refuse("it was made with other settings; make it again, or use the "
                    "settings that it was made with");
}

} // namespace detail

/// Saves a light map; see save_file().
/// \throws std::runtime_error  as save_file().
/// \cost 24 bytes per patch.
inline void save_light_map(const std::string& path, const LightMap& map) {
    Bytes bytes =
        file_front(detail::light_map_format,
                   static_cast<std::uint32_t>(map.grids.size()), map.key.scene);
    put_number(bytes, map.key.settings);
    for (const PatchGrid& grid : map.grids) detail::put_grid(bytes, grid);
    for (const RgbT<double>& light : map.irradiance) put_vector(bytes, light);
    put_checksum(bytes);
    save_file(path, bytes);
}

/// Loads a light map of at most `most` patches. The file must have the key `key`, from
/// light_map_key().
/// \return The map, equal to the saved one in every bit.
/// \throws std::runtime_error  as open_file(), or if the scene or the settings differ:
///         "cannot read 'a.light': it was made for another scene, ...".
[[nodiscard]] inline LightMap load_light_map(const std::string& path,
                                             const LightMapKey& key,
                                             std::size_t most = 10'000'000) {
    FileReader file = open_file(
        path, detail::file_limit(most, detail::light_bytes + detail::grid_bytes),
        detail::light_map_format);
    const auto grids = file.take<std::uint32_t>();
    detail::require_key(file, key);
    LightMap map{.key = key};
    if (grids > file.left() / detail::grid_bytes)
        file.refuse("it declares " + std::to_string(grids) +
                    " grids, but is too short for them");

    std::size_t patches = 0;
    for (std::uint32_t i = 0; i < grids; ++i) {
        auto grid = detail::take_grid(file);
        if (!grid) file.refuse("its grid " + std::to_string(i) + " is not valid");
        grid->first = static_cast<std::uint32_t>(patches);
        patches += grid->size();
        if (patches > most) file.refuse("it holds more patches than are allowed");
        map.grids.push_back(*grid);
    }
    file.require_left(patches, detail::light_bytes, "patches");
    for (std::size_t i = 0; i < patches; ++i) {
        const auto light = file.take_vector<RgbT<double>>();
        const double least = std::min({light.x, light.y, light.z});
        if (!is_finite(light) || !(least >= 0))
            file.refuse("it has irradiance that is not finite or is below 0");
        map.irradiance.push_back(light);
    }
    return map;
}

/// \}

} // namespace ljus
