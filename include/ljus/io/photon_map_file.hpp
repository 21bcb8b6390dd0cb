#pragma once

/// \file ljus/io/photon_map_file.hpp
/// \brief Photon maps in files that can be searched without loading them.

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>

#include "ljus/io/binary_file.hpp"
#include "ljus/parallel.hpp"
#include "ljus/photons/photon_map.hpp"

#if __has_include(<sys/mman.h>)
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace ljus {

/// \defgroup photon_map_file Photon maps in files
/// \brief A saved map may be larger than the memory. The operating system reads only
/// the pages that a search needs.
///
/// A file has the header of \ref binary_file, with the number of photons and a key.
/// Four arrays follow, as in memory: the nodes of the tree, the positions of the
/// photons, the order of the photons, and their other data. Each array begins at a
/// multiple of 64 KiB. The checksum is computed from the checksums of pieces of 1 MiB,
/// so that several threads can work on it.
/// \{

namespace detail {

inline constexpr FileFormat photon_map_format{"ljus photon map\n", 1};

// Arrays begin at multiples of this size, in bytes. No system has larger pages.
inline constexpr std::size_t map_alignment = 1 << 16;

inline constexpr std::size_t checksum_piece = 1 << 20;

// The sizes of the four arrays of a map.
struct MapSizes {
    std::size_t nodes = 0;  // nodes of the tree
    std::size_t blocks = 0; // blocks of points, and of records
    std::size_t points = 0;

    [[nodiscard]] static MapSizes of(std::uint32_t points) noexcept {
        const KdTree8Shape shape = KdTree8Shape::of(points);
        return {shape.first[std::size_t(shape.levels)], std::size_t(shape.blocks),
                points};
    }
    // The sizes of the arrays in bytes, in the order of the file.
    [[nodiscard]] std::array<std::size_t, 4> bytes() const noexcept {
        return {nodes * sizeof(KdTree8NodeT<float>), blocks * sizeof(Lanes3T<float>),
                points * sizeof(std::uint32_t), blocks * sizeof(RecordBlockT<float>)};
    }
    // The positions at which the arrays begin, and the end of the file.
    [[nodiscard]] std::array<std::size_t, 5> places() const noexcept {
        std::array<std::size_t, 5> place{map_alignment};
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t end = place[i] + bytes()[i];
            place[i + 1] =
                i == 3 ? end
                       : (end + map_alignment - 1) / map_alignment * map_alignment;
        }
        return place;
    }
};

template <typename Element>
[[nodiscard]] std::span<const unsigned char>
raw(const StoredArray<Element>& array) noexcept {
    return {reinterpret_cast<const unsigned char*>(array.data()),
            array.span().size_bytes()};
}

// The arrays of a map, in the order of the file.
[[nodiscard]] inline std::array<std::span<const unsigned char>, 4>
arrays_of(const PhotonMap& map) noexcept {
    const KdTree8PartsT<float>& tree = map.tree.parts();
    return {raw(tree.nodes), raw(tree.blocks), raw(tree.order),
            raw(map.records.stored())};
}

// The checksum of a map. It includes the header, except the checksum itself.
[[nodiscard]] inline std::uint64_t map_checksum(const Bytes& front,
                                                const PhotonMap& map, int threads) {
    FieldHash all{checksum(front)};
    for (const auto& array : arrays_of(map)) {
        std::vector<std::uint64_t> sums((array.size() + checksum_piece - 1) /
                                        checksum_piece);
        parallel_blocks(
            static_cast<long long>(sums.size()),
            [&](long long number) {
                const auto i = static_cast<std::size_t>(number);
                std::uint64_t sum = fnv_start;
                for (const unsigned char byte : array.subspan(
                         i * checksum_piece,
                         std::min(checksum_piece, array.size() - i * checksum_piece)))
                    sum = fnv_hash(sum, byte);
                sums[i] = sum;
            },
            {.threads = threads});
        for (const std::uint64_t sum : sums) all.add(sum);
    }
    return all.value;
}

// Whether the photons of a block are valid for make_photon_map(), and whether unused
// places after the last photon are marked by NaN.
[[nodiscard]] inline bool is_whole_block(const PhotonMap& map, std::size_t block) {
    const Lanes3T<float>& points = map.tree.blocks()[block];
    const RecordBlockT<float>& records = map.records.blocks()[block];
    for (std::size_t i = 0; i < 8; ++i) {
        const Vec3 direction = records.direction[i];
        const std::uint32_t kind = records.code[i] >> RecordCode::kind_shift;
        if (!is_finite(direction) || !is_finite(records.flux[i])) return false;
        if (8 * block + i >= map.tree.size()) {
            if (!std::isnan(points.x[i])) return false;
        } else if (!is_finite(points[i]) || !is_unit_direction(direction) ||
                   !std::has_single_bit(kind) || kind > 16 ||
                   map.tree.point_ids()[8 * block + i] >= map.tree.size()) {
            return false;
        }
    }
    return true;
}

// Refuses a map if the checksum is wrong or a photon is not valid.
inline void check_map(const FileReader& file, const PhotonMap& map, int threads) {
    if (number_at<std::uint64_t>(file.bytes, checksum_place) !=
        map_checksum(file.bytes, map, threads))
        file.refuse("its checksum is wrong: it is damaged");
    parallel_each(map.tree.blocks().size(), 1 << 14,
                  [&](std::size_t block) {
                      if (!is_whole_block(map, block))
                          file.refuse("one of its photons " +
                                      std::to_string(8 * block) + " to " +
                                      std::to_string(8 * block + 7) + " is not valid");
                  },
                  {.threads = threads});
}

// Throws on systems that cannot map these files into memory.
inline void require_map_files(const std::string& path) {
    if constexpr (std::endian::native != std::endian::little)
        fail_to_read(path, "photon maps in files need a processor that stores a "
                           "number's lowest byte first");
#if !__has_include(<sys/mman.h>)
    fail_to_read(path, "photon maps in files need a system that maps files (POSIX)");
#endif
}

#if __has_include(<sys/mman.h>)

// A file that can be mapped into memory. The mapping remains when the file is closed.
class MappableFile {
public:
    MappableFile(const std::string& path) : path_(path) {
        // Without O_NONBLOCK, opening a pipe waits for its writer.
        file_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
        if (file_ < 0) fail_to_read(path, std::strerror(errno));
    }
    MappableFile(const MappableFile&) = delete;
    MappableFile& operator=(const MappableFile&) = delete;
    ~MappableFile() { ::close(file_); }

    [[nodiscard]] std::size_t size() const {
        struct ::stat status = {};
        if (::fstat(file_, &status) != 0) fail_to_read(path_, std::strerror(errno));
        if (!S_ISREG(status.st_mode)) fail_to_read(path_, "it is not a file");
        return static_cast<std::size_t>(status.st_size);
    }
    // The first `count` bytes of the file.
    [[nodiscard]] Bytes front(std::size_t count) const {
        Bytes bytes(count);
        const ::ssize_t got = ::pread(file_, bytes.data(), count, 0);
        if (got < 0) fail_to_read(path_, std::strerror(errno));
        bytes.resize(static_cast<std::size_t>(got));
        return bytes;
    }
    // Maps `count` elements of the file, from the position `place` on, which is a
    // multiple of map_alignment.
    template <typename Element>
    [[nodiscard]] StoredArray<Element> map(std::size_t place, std::size_t count) const {
        if (count == 0) return {};
        void* const memory = ::mmap(nullptr, count * sizeof(Element), PROT_READ,
                                    MAP_SHARED, file_, static_cast<::off_t>(place));
        if (memory == MAP_FAILED) fail_to_read(path_, std::strerror(errno));
        return {std::span<const Element>(static_cast<const Element*>(memory), count),
                [](std::span<const Element> mapped) noexcept {
                    ::munmap(const_cast<Element*>(mapped.data()), mapped.size_bytes());
                }};
    }

private:
    const std::string& path_;
    int file_ = -1;
};

#endif

} // namespace detail

/// Saves a photon map; see save_file(). The caller chooses `key` to tell maps apart,
/// for example a hash of the scene and the settings.
/// \throws std::runtime_error  as save_file().
/// \cost 50 bytes per photon in the file; no further memory.
inline void save_photon_map(const std::string& path, const PhotonMap& map,
                            std::uint64_t key = 0) {
    detail::require_map_files(path);
    const auto count = static_cast<std::uint32_t>(map.tree.size());
    Bytes front = file_front(detail::photon_map_format, count, key);
    const auto sum = detail::bytes_of(detail::map_checksum(front, map, 0));
    std::copy(sum.begin(), sum.end(), front.begin() + detail::checksum_place);
    const auto arrays = detail::arrays_of(map);
    const auto places = detail::MapSizes::of(count).places();
    detail::FileBeside file(detail::file_to_replace(path));
    file.write(front);
    std::size_t written = front.size();
    for (std::size_t i = 0; i < 4; ++i) {
        file.write(Bytes(places[i] - written));
        file.write(arrays[i]);
        written = places[i] + arrays[i].size();
    }
    file.close();
    file.rename_to_path();
}

/// The settings of open_photon_map().
struct PhotonMapFileSettings {
    std::uint64_t key = 0;     ///< The key that the file must have.
    bool check = true;         ///< Whether the whole file is read and checked first.
                               ///< Otherwise damage is not noticed.
    bool single_pages = false; ///< Whether the system reads pages without their
                               ///< neighbours, which suits a map larger than the
                               ///< memory.
    int threads = 0;           ///< Number of threads; see ParallelSettings.
};

/// Opens a photon map in a file, which is mapped into memory. While the map is open,
/// save_photon_map() may replace the file, but no program may write into the file or
/// shorten it.
/// \return The map, equal to the saved one in every bit. The file stays mapped as long
///         as this map exists, or a map to which it is moved. A copy of the map does
///         not need the file.
/// \throws std::runtime_error  if the file cannot be read, has another key or is
///         damaged, or if the system cannot map files into memory.
[[nodiscard]] inline PhotonMap
open_photon_map(const std::string& path, const PhotonMapFileSettings& settings = {}) {
    detail::require_map_files(path);
    PhotonMap map;
#if __has_include(<sys/mman.h>)
    const detail::MappableFile mappable(path);
    const std::size_t size = mappable.size();
    FileReader file{path, mappable.front(file_front_bytes)};
    detail::take_format(file, detail::photon_map_format);
    const auto points = file.take<std::uint32_t>();
    if (file.take<std::uint64_t>() != settings.key)
        file.refuse("it was made of another scene or with other settings; make it "
                    "again");
    const auto sizes = detail::MapSizes::of(points);
    const auto places = sizes.places();
    if (size != places[4])
        file.refuse("it declares " + std::to_string(points) +
                    " photons, which does not match its " + std::to_string(size) +
                    " bytes");
    map.tree =
        KdTree8({detail::KdTree8Shape::of(points),
                 mappable.map<detail::KdTree8NodeT<float>>(places[0], sizes.nodes),
                 mappable.map<detail::Lanes3T<float>>(places[1], sizes.blocks),
                 mappable.map<std::uint32_t>(places[2], sizes.points)});
    map.records = {mappable.map<detail::RecordBlockT<float>>(places[3], sizes.blocks),
                   points};
    if (settings.check) detail::check_map(file, map, settings.threads);
    if (settings.single_pages)
        for (const auto& array : detail::arrays_of(map))
            ::madvise(const_cast<unsigned char*>(array.data()), array.size(),
                      MADV_RANDOM); // if it fails, more is read
#endif
    return map;
}

/// \}

} // namespace ljus
