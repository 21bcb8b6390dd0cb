#pragma once

/// \file ljus/io/file.hpp
/// \brief Reads files, and refuses those that are too large.

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "ljus/io/file_beside.hpp"
#include "ljus/math/field_hash.hpp"

#if __has_include(<unistd.h>)
#include <sys/stat.h>
#endif

#ifdef _MSC_VER
#pragma warning(push)
#pragma warning(disable : 4996) // this header uses std::fopen
#endif

namespace ljus {

/// \addtogroup file
/// \{

namespace detail {

[[noreturn, gnu::cold]] inline void fail_to_read(const std::string& path,
                                                 std::string_view why) {
    throw std::runtime_error(
        join({"cannot read '", shown_path(path), "': ", why, "."}));
}

// Throws an error about the content of a file, such as "a.ply: it ends early."
[[noreturn, gnu::cold]] inline void refuse_file(const std::string& path,
                                                std::string_view why) {
    throw std::runtime_error(join({shown_path(path), ": ", why, "."}));
}

// Refuses a file that does not begin with certain bytes.
inline void require_beginning(std::string_view text, std::string_view begin,
                              const std::string& path) {
    if (!text.starts_with(begin))
        fail_to_read(path, join({"it does not begin with '", shown(std::string(begin)),
                                 "': it is another kind of file"}));
}

// The folder of a file, with the slash; empty for the current folder.
inline std::string folder_of(const std::string& path) {
    return path.substr(0, path.find_last_of("/\\") + 1); // 0 if there is no slash
}

// The path of a file that another file names, perhaps with the backslashes of Windows.
// Unless absolute, it is relative to the folder of that other file.
inline std::string path_beside(const std::string& file, std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    return name.starts_with('/') ? name : folder_of(file) + name;
}

} // namespace detail

/// A list of the files that this thread reads while the list exists, such as a scene
/// file with its meshes and pictures. If several lists exist, a file goes into the
/// newest list only.
class FilesRead {
public:
    /// A file that the thread has tried to read.
    struct File {
        std::string path; ///< The path as the caller wrote it.
        /// FNV-1a hash of the file's bytes; 0 if the file could not be read.
        std::uint64_t hash = 0;
    };

    FilesRead() { current() = this; }
    FilesRead(const FilesRead&) = delete;
    FilesRead& operator=(const FilesRead&) = delete;
    ~FilesRead() { current() = outer_; }

    /// All files so far, in the order of reading.
    [[nodiscard]] const std::vector<File>& files() const noexcept { return files_; }

    /// A hash of the contents of all files so far, in the order of reading. Names have
    /// no influence on it, but a missing file has.
    [[nodiscard]] std::uint64_t hash() const noexcept {
        detail::FieldHash all;
        for (const File& file : files_) all.add(file.hash);
        return all.value;
    }

private:
    template <typename Use>
    friend void read_in_pieces(const std::string&, std::size_t, Use&&);
    static FilesRead*& current() noexcept {
        thread_local FilesRead* list = nullptr;
        return list;
    }

    std::vector<File> files_;
    FilesRead* outer_ = current();
};

/// Reads a file piece by piece. If a FilesRead exists, the file is added to its list.
/// \param path  The file; not a pipe or a device, which may never end.
/// \param most  The largest size in bytes.
/// \param use   Called as use(text, last), where `text` is a piece, and `last` is true
///              for the last one. Returns the number of bytes used, from the start of
///              the piece. The next piece begins with the unused bytes.
/// \throws std::runtime_error  with path and reason, if the file cannot be read or is
///         too large.
template <typename Use>
void read_in_pieces(const std::string& path, std::size_t most, Use&& use) {
    FilesRead* const notes = FilesRead::current();
    const std::size_t number = notes != nullptr ? notes->files_.size() : 0;
    if (notes != nullptr) notes->files_.push_back({path});
    struct Closed {
        std::FILE* file;
        ~Closed() {
            if (file != nullptr) std::fclose(file);
        }
    };
#if __has_include(<unistd.h>)
    struct ::stat status = {}; // tested first: opening a pipe waits for its writer
    if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) &&
        !S_ISDIR(status.st_mode))
        detail::fail_to_read(path, "it is a pipe or a device, not a file");
#endif
    const Closed closed{std::fopen(path.c_str(), "rb")};
    if (closed.file == nullptr) detail::fail_to_read(path, std::strerror(errno));

    std::uint64_t hash = detail::fnv_start;
    std::string piece(std::size_t(1) << 16, '\0');
    std::size_t left = 0, size = 0; // unused bytes of the last piece; bytes read
    for (bool last = false; !last;) {
        if (left > piece.size() / 2) piece.resize(2 * piece.size());
        // Reading one byte more than the limit shows whether the file is longer.
        const std::size_t room = most - size, free = piece.size() - left;
        const std::size_t wanted = room < free ? room + 1 : free;
        const std::size_t got = std::fread(piece.data() + left, 1, wanted, closed.file);
        if (std::ferror(closed.file)) detail::fail_to_read(path, std::strerror(errno));
        if (notes != nullptr)
            for (std::size_t i = left; i < left + got; ++i)
                hash = detail::fnv_hash(hash, static_cast<unsigned char>(piece[i]));
        size += got;
        last = got < wanted;
        const std::string_view text(piece.data(), left + got);
        if (size == got && text.starts_with("version https://git-lfs."))
            detail::fail_to_read(path, "it only stands for a file that Git LFS keeps; "
                                       "`git lfs pull` brings the file itself");
        const std::size_t used = use(text, last);
        if (size > most)
            detail::fail_to_read(
                path, detail::join({"it is longer than the ", std::to_string(most),
                                    " bytes allowed"}));
        left = text.size() - used;
        std::memmove(piece.data(), piece.data() + used, left);
    }
    if (notes != nullptr) notes->files_[number].hash = hash;
}

/// Reads a whole file of at most `most` bytes, as read_in_pieces() does. The file must
/// begin with the bytes `begin`, which are tested before the rest is read.
/// \throws std::runtime_error  as read_in_pieces(), or if the file begins with other
///         bytes.
[[nodiscard]] inline Bytes load_file(const std::string& path, std::size_t most,
                                     std::string_view begin = {}) {
    Bytes bytes;
    read_in_pieces(path, most, [&](std::string_view text, bool) {
        if (bytes.empty()) detail::require_beginning(text, begin, path);
        bytes.insert(bytes.end(), text.begin(), text.end());
        return text.size();
    });
    bytes.shrink_to_fit(); // its memory grew by doubling
    return bytes;
}

namespace detail {

// Removes the byte order mark of a UTF-8 text; refuses UTF-16.
inline std::string_view plain_text(std::string_view text, const std::string& path) {
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        fail_to_read(path, "its text is UTF-16; save it as UTF-8");
    return text.substr(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
}

inline std::string load_text(const std::string& path, std::size_t most) {
    std::string text;
    read_in_pieces(path, most, [&](std::string_view piece, bool) {
        text += piece;
        return piece.size();
    });
    return text;
}

} // namespace detail

/// \}

} // namespace ljus

#ifdef _MSC_VER
#pragma warning(pop)
#endif
