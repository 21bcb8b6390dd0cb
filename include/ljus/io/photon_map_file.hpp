#pragma once

/// \file ljus/io/photon_map_file.hpp
/// \brief A photon map in a file, and back.

#include <string>

#include "ljus/io/detail/map_bytes.hpp"
#include "ljus/photons/photon_map.hpp"

namespace ljus {

/// \defgroup photon_map_file Photon maps in files
/// \brief Section 3.2.2: the first pass, kept for another day.
///
/// One flat file, the same on every machine: 16 letters that say what it is; version,
/// bytes of a number, photons and checksum; then the photons, in the order in which
/// they were emitted. The tree is not in it: it is built anew in less time than a disk
/// takes to read it, and comes out the same.
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

inline constexpr std::string_view map_magic = "ljus photon map\n";
inline constexpr std::uint32_t map_version = 1;

} // namespace detail

/// Saves a map.
/// \param path  The file; an older one is replaced at the very end (save_file()).
/// \param map   The map.
/// \throws std::runtime_error  as save_file().
/// \cost 42 bytes a photon in float.
template <std::floating_point T>
void save_photon_map(const std::string& path, const PhotonMapT<T>& map) {
    Bytes bytes(detail::map_magic.begin(), detail::map_magic.end());
    detail::put_number(bytes, detail::map_version);
    detail::put_number(bytes, static_cast<std::uint32_t>(sizeof(T)));
    detail::put_number(bytes, static_cast<std::uint64_t>(map.records.size()));
    detail::put_number(bytes, std::uint64_t(0)); // the checksum's place
    for (const PhotonT<T>& photon : detail::photons_of(map)) {
        for (const Vec3T<T>& v : {photon.position, photon.direction, photon.flux})
            for (int axis = 0; axis < 3; ++axis) detail::put_number(bytes, v[axis]);
        detail::put_number(bytes, photon.light);
        detail::put_number(bytes, static_cast<std::uint8_t>(photon.kind));
        for (int axis = 0; axis < 3; ++axis)
            detail::put_number(bytes, photon.normal[axis]);
    }
    detail::put_checksum(bytes);
    save_file(path, bytes);
}

/// Loads a map.
/// \tparam T     The precision that it was saved with.
/// \param path   The file.
/// \param most   The most photons it may hold.
/// \param threads  That build the tree, as in ParallelSettings.
/// \return The map, the same byte by byte as the one that was saved.
/// \throws std::runtime_error  "cannot read 'a.map': it ends too early: ...": what is
///         cut short, damaged, of another version or no photon map at all is refused.
template <std::floating_point T = float>
[[nodiscard]] PhotonMapT<T> load_photon_map(const std::string& path,
                                            std::size_t most = 100'000'000,
                                            int threads = 0) {
    constexpr std::size_t photon_bytes = 9 * sizeof(T) + 6;
    const Bytes bytes =
        load_file(path, detail::map_limit(most, photon_bytes), detail::map_magic);
    const auto refuse = [&](const std::string& why) {
        detail::fail_to_read(path, why);
    };
    if (bytes.size() < detail::map_header)
        refuse("it ends in the middle of its header");
    const unsigned char* at = bytes.data() + detail::map_magic.size();
    const auto version = detail::take_number<std::uint32_t>(at);
    const auto number_bytes = detail::take_number<std::uint32_t>(at);
    const auto count = detail::take_number<std::uint64_t>(at);
    const auto checksum = detail::take_number<std::uint64_t>(at);
    if (version != detail::map_version)
        refuse("it is of version " + std::to_string(version) +
               ", and this library reads version " +
               std::to_string(detail::map_version));
    if (number_bytes != sizeof(T))
        refuse("its numbers have " + std::to_string(number_bytes) +
               " bytes; those asked for have " + std::to_string(sizeof(T)));
    if ((bytes.size() - detail::map_header) / photon_bytes != count ||
        (bytes.size() - detail::map_header) % photon_bytes != 0)
        refuse("it says that it holds " + std::to_string(count) +
               " photons, which does not go with its " + std::to_string(bytes.size()) +
               " bytes");
    if (checksum != detail::map_checksum(bytes))
        refuse("its checksum is wrong, so that it has been damaged");

    std::vector<PhotonT<T>> photons(count);
    for (PhotonT<T>& photon : photons) {
        for (Vec3T<T>* v : {&photon.position, &photon.direction, &photon.flux})
            for (int axis = 0; axis < 3; ++axis)
                (*v)[axis] = detail::take_number<T>(at);
        photon.light = detail::take_number<std::uint16_t>(at);
        const auto kind = detail::take_number<std::uint8_t>(at);
        if (kind > 3) refuse("it has a photon of kind " + std::to_string(kind));
        photon.kind = static_cast<PhotonKind>(kind);
        for (int axis = 0; axis < 3; ++axis)
            photon.normal[axis] = detail::take_number<std::int8_t>(at);
        if (!is_finite(photon.position) || !is_finite(photon.direction) ||
            !is_finite(photon.flux))
            refuse("it has a photon that is not finite");
    }
    return make_photon_map(photons, threads);
}

/// \}

} // namespace ljus
