#pragma once

/// \file ljus/io/light_map_file.hpp
/// \brief A light map in a file, and back.

#include <limits>
#include <string>
#include <string_view>

#include "ljus/io/detail/map_bytes.hpp"
#include "ljus/radiosity/light_map.hpp"

namespace ljus {

/// \defgroup light_map_file Light maps in files
/// \brief Section 2.2: "radiosity can easily be precomputed since it is view
/// independent".
///
/// One flat file, the same on every machine: 16 letters that say what it is; version,
/// number of grids, objects of the scene and checksum; the grids; then the irradiance
/// of each patch, three doubles.
/// \{

namespace detail {

inline constexpr std::string_view light_map_magic = "ljus light map\n\n";
inline constexpr std::uint32_t light_map_version = 1;
inline constexpr std::size_t grid_bytes = 20;
inline constexpr std::size_t light_bytes = 24;

} // namespace detail

/// Saves a light map.
/// \param path  The file; an older one is replaced at the very end (save_file()).
/// \param map   The map.
/// \throws std::runtime_error  as save_file().
/// \cost 24 bytes a patch.
inline void save_light_map(const std::string& path, const LightMap& map) {
    Bytes bytes(detail::light_map_magic.begin(), detail::light_map_magic.end());
    detail::put_number(bytes, detail::light_map_version);
    detail::put_number(bytes, static_cast<std::uint32_t>(map.grids.size()));
    detail::put_number(bytes, map.objects);
    detail::put_number(bytes, std::uint64_t(0)); // the checksum's place
    for (const PatchGrid& grid : map.grids) {
        const std::uint32_t how = static_cast<std::uint32_t>(grid.kind) +
                                  (grid.back ? 4u : 0u) + (grid.inward ? 8u : 0u);
        for (const std::uint32_t number :
             {grid.object.type, grid.object.index, how, grid.columns, grid.rows})
            detail::put_number(bytes, number);
    }
    for (const RgbT<double>& light : map.irradiance)
        for (int channel = 0; channel < 3; ++channel)
            detail::put_number(bytes, light[channel]);
    detail::put_checksum(bytes);
    save_file(path, bytes);
}

/// Loads a light map.
/// \param path  The file.
/// \param most  The most patches it may hold.
/// \return The map, the same bit by bit as the one that was saved.
/// \throws std::runtime_error  "cannot read 'a.light': its checksum is wrong, ...":
///         what is cut short, damaged, of another version or no light map is refused.
[[nodiscard]] inline LightMap load_light_map(const std::string& path,
                                             std::size_t most = 10'000'000) {
    const Bytes bytes = load_file(
        path, detail::map_limit(most, detail::light_bytes + detail::grid_bytes),
        detail::light_map_magic);
    const auto refuse = [&](const std::string& why) {
        detail::fail_to_read(path, why);
    };
    if (bytes.size() < detail::map_header)
        refuse("it ends in the middle of its header");
    const unsigned char* at = bytes.data() + detail::map_magic_size;
    const auto version = detail::take_number<std::uint32_t>(at);
    const auto grids = detail::take_number<std::uint32_t>(at);
    LightMap map{.objects = detail::take_number<std::uint64_t>(at)};
    const auto checksum = detail::take_number<std::uint64_t>(at);
    if (version != detail::light_map_version)
        refuse("it is of version " + std::to_string(version) +
               ", and this library reads version " +
               std::to_string(detail::light_map_version));
    if (checksum != detail::map_checksum(bytes))
        refuse("its checksum is wrong, so that it is damaged or cut short");
    if (grids > (bytes.size() - detail::map_header) / detail::grid_bytes)
        refuse("it says that it holds " + std::to_string(grids) +
               " grids, and is too short for them");

    std::size_t patches = 0;
    for (std::uint32_t i = 0; i < grids; ++i) {
        PatchGrid grid;
        grid.object.type = detail::take_number<std::uint32_t>(at);
        grid.object.index = detail::take_number<std::uint32_t>(at);
        const auto how = detail::take_number<std::uint32_t>(at);
        grid.columns = detail::take_number<std::uint32_t>(at);
        grid.rows = detail::take_number<std::uint32_t>(at);
        const bool square = grid.columns == grid.rows;
        if (how % 4 > 2 || how > 15 || grid.columns < 1 || grid.rows < 1 ||
            grid.columns > 65535 || grid.rows > 65535 || (how % 4 == 1 && !square) ||
            (how % 4 == 2 && (grid.columns < 2 || grid.rows < 3)))
            refuse("its grid " + std::to_string(i) + " is none");
        grid.kind = static_cast<detail::GridKind>(how % 4);
        grid.back = (how & 4u) != 0;
        grid.inward = (how & 8u) != 0;
        grid.first = static_cast<std::uint32_t>(patches);
        patches += grid.size();
        if (patches > most) refuse("it holds more patches than are allowed");
        map.grids.push_back(grid);
    }
    const auto left = static_cast<std::size_t>(bytes.data() + bytes.size() - at);
    if (left != patches * detail::light_bytes)
        refuse("it says that it holds " + std::to_string(patches) +
               " patches, which does not go with its " + std::to_string(bytes.size()) +
               " bytes");
    for (std::size_t i = 0; i < patches; ++i) {
        RgbT<double> light;
        for (int channel = 0; channel < 3; ++channel)
            light[channel] = detail::take_number<double>(at);
        const double least = std::min(light.x, std::min(light.y, light.z));
        if (!is_finite(light) || !(least >= 0))
            refuse("it has light that is not finite, or below 0");
        map.irradiance.push_back(light);
    }
    return map;
}

/// \}

} // namespace ljus
