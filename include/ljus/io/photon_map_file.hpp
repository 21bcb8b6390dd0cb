#pragma once

/// \file ljus/io/photon_map_file.hpp
/// \brief A photon map in a file, and back.

#include <string>

#include "ljus/io/detail/map_key.hpp"
#include "ljus/photons/photon_map.hpp"
#include "ljus/render/photon_mapping_settings.hpp"

namespace ljus {

/// \defgroup photon_map_file Photon maps in files
/// \brief Section 3.2.2: the first pass, kept for another day.
///
/// One flat file, the same on every machine: 16 letters that say what it is; version,
/// bytes of a number, photons and checksum; the key of what it was made from; then the
/// photons, in the order in which they were emitted. The tree is not in it: it is built
/// anew in less time than a disk takes to read it, and comes out the same.
/// \{

namespace detail {

/// The photons of a map, in the order in which it was given them.
/// \param map  The map.
template <std::floating_point T>
[[nodiscard]] std::vector<PhotonT<T>> photons_of(const PhotonMapT<T>& map) {
    std::vector<PhotonT<T>> photons(map.records.size());
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const PhotonRecordT<T> record = map.records[i];
        photons[map.tree.point_ids()[i]] = {.position = map.tree.point(i),
                                            .direction = record.direction,
                                            .flux = record.flux,
                                            .light = record.light,
                                            .kind = record.kind,
                                            .normal = record.normal};
    }
    return photons;
}

inline constexpr MapFormat photon_map_format{"ljus photon map\n", 2};

} // namespace detail

/// What photons were traced from, for save_photon_map() and load_photon_map(). What
/// changes no photon does not count: progress, threads, the limit of memory.
/// \param scene  The scene: its shapes, what they are made of, its lights.
/// \param type   Which map.
/// \param pass   As trace_photons() was given it.
/// \return The key.
template <SceneLike S>
[[nodiscard]] MapKey photon_map_key(const S& scene, MapType type,
                                    const PhotonPassSettings& pass) {
    detail::FieldHash how;
    how.add(type, pass.photons, pass.seed, pass.iteration, pass.max_bounces,
            pass.shadow_photons, pass.keep, pass.equal_lights, pass.numbers,
            pass.shares, pass.give_up);
    return {detail::scene_hash(scene), how.value};
}

/// The same for a map of make_photon_maps(): with what its plan depends on.
/// \param scene     The scene.
/// \param type      Which of the maps.
/// \param settings  As make_photon_maps() was given them.
/// \return The key.
template <SceneLike S>
[[nodiscard]] MapKey photon_map_key(const S& scene, MapType type,
                                    const PhotonMappingSettings& settings) {
    const bool caustics = type == MapType::caustics;
    MapKey key =
        photon_map_key(scene, type, caustics ? settings.caustics : settings.general);
    detail::FieldHash how{key.settings};
    if (!caustics)
        how.add(settings.direct, settings.indirect, settings.keep_general_map,
                settings.skip);
    else if (settings.caustic_budget != CausticBudget::as_seen) // a pilot's
        how.add(settings.caustic_budget, settings.caustics_estimate.radius,
                settings.general_estimate.radius,
                photon_map_key(scene, MapType::general, settings.general).settings);
    return {key.scene, how.value};
}

/// Saves a map.
/// \param path  The file; an older one is replaced at the very end (save_file()).
/// \param map   The map.
/// \param key   What it was made from: photon_map_key().
/// \throws std::runtime_error  as save_file().
/// \cost 42 bytes per photon in float.
template <std::floating_point T>
void save_photon_map(const std::string& path, const PhotonMapT<T>& map,
                     const MapKey& key) {
    Bytes bytes = detail::map_front(detail::photon_map_format,
                                    static_cast<std::uint32_t>(sizeof(T)),
                                    static_cast<std::uint64_t>(map.records.size()));
    detail::put_key(bytes, key);
    for (const PhotonT<T>& photon : detail::photons_of(map)) {
        detail::put_vector(bytes, photon.position);
        detail::put_vector(bytes, photon.direction);
        detail::put_vector(bytes, photon.flux);
        detail::put_number(bytes, photon.light);
        detail::put_number(bytes, static_cast<std::uint8_t>(photon.kind));
        detail::put_vector(bytes, photon.normal);
    }
    detail::put_checksum(bytes);
    save_file(path, bytes);
}

/// Loads a map.
/// \tparam T     The precision that it was saved with.
/// \param path   The file.
/// \param key    What it must have been made from: photon_map_key().
/// \param most   The most photons it may hold.
/// \param threads  That build the tree, as in ParallelSettings.
/// \return The map, the same byte by byte as the one that was saved.
/// \throws std::runtime_error  "cannot read 'a.map': it was made for another scene,
///         ...": what is of another scene or of other settings, cut short, damaged, of
///         another version or no photon map at all is refused.
template <std::floating_point T = float>
[[nodiscard]] PhotonMapT<T> load_photon_map(const std::string& path, const MapKey& key,
                                            std::size_t most = 100'000'000,
                                            int threads = 0) {
    constexpr std::size_t photon_bytes = 9 * sizeof(T) + 6;
    detail::MapReader file = detail::open_map(
        path, detail::map_limit(most, photon_bytes), detail::photon_map_format);
    const auto number_bytes = file.take<std::uint32_t>();
    const auto count = file.take<std::uint64_t>();
    if (number_bytes != sizeof(T))
        file.refuse("its numbers have " + std::to_string(number_bytes) +
                    " bytes; those asked for have " + std::to_string(sizeof(T)));
    detail::require_key(file, key);
    file.require_left(count, photon_bytes, "photons");

    std::vector<PhotonT<T>> photons(count);
    for (PhotonT<T>& photon : photons) {
        photon.position = file.take_vector<Vec3T<T>>();
        photon.direction = file.take_vector<Vec3T<T>>();
        photon.flux = file.take_vector<RgbT<T>>();
        photon.light = file.take<std::uint16_t>();
        const auto kind = file.take<std::uint8_t>();
        if (kind > 3) file.refuse("it has a photon of kind " + std::to_string(kind));
        photon.kind = static_cast<PhotonKind>(kind);
        photon.normal = file.take_vector<decltype(photon.normal)>();
        if (!is_finite(photon.position) || !is_finite(photon.direction) ||
            !is_finite(photon.flux))
            file.refuse("it has a photon that is not finite");
    }
    return make_photon_map(photons, threads);
}

/// \}

} // namespace ljus
