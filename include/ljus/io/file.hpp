#pragma once

/// \file ljus/io/file.hpp
/// \brief Writes files whole or not at all, and reads them up to a limit.

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
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
#pragma warning(disable : 4996) // std::fopen is what this header wants
#endif

namespace ljus {

/// \defgroup file Files
/// \brief A save that fails leaves no half-written file, and keeps the older one.
/// \{

namespace detail {

[[noreturn, gnu::cold]] inline void fail_to_read(const std::string& path,
                                                 std::string_view why) {
    throw std::runtime_error(
        join({"cannot read '", shown_path(path), "': ", why, "."}));
}

// The folder of a file, with the slash; empty for the current folder.
inline std::string folder_of(const std::string& path) {
    return path.substr(0, path.find_last_of("/\\") + 1); // 0 if there is no slash
}

// The path of a file that another file names: relative to that file, unless absolute.
inline std::string path_beside(const std::string& file, const std::string& name) {
    return name.starts_with('/') ? name : folder_of(file) + name;
}

// One path for all names and links of a file; the path itself if it does not exist.
inline std::string one_path(const std::string& path) {
#if __has_include(<unistd.h>)
    if (char* const resolved = ::realpath(path.c_str(), nullptr)) {
        const std::string found = resolved;
        std::free(resolved);
        return found;
    }
#endif
    return path;
}

} // namespace detail

/// Writes a file beside `path`, and renames it once every write, the flush and the
/// close have succeeded. If anything fails, an older file is unchanged and nothing else
/// is left. The new file has the older one's permissions. (A program that wants to
/// receive the error of a file-size limit must ignore SIGXFSZ.)
/// \throws std::runtime_error  "cannot write 'out/a.png': No space left on device.".
[[gnu::cold]] inline void save_file(const std::string& path, const Bytes& bytes) {
    detail::FileBeside file(detail::file_to_replace(path));
    file.write(bytes);
    file.close();
    file.rename_to_path();
}

/// Tests whether save_file() could write a file, before work is done: writes one byte
/// beside it, and removes that again.
/// \throws std::runtime_error  as save_file().
inline void require_writable(const std::string& path) {
    detail::FileBeside probe(detail::file_to_replace(path));
    probe.write({0});
    probe.close();
}

/// The files that load_file() is asked for, by one thread and while the list exists:
/// what a scene was made of, meshes, materials and pictures included, as it was when it
/// was read. A list within a list takes over until it ends.
class FilesRead {
public:
    /// A file that was asked for.
    struct File {
        std::string path;       ///< As load_file() was given it.
        std::uint64_t hash = 0; ///< FNV-1a of its bytes; 0: it could not be read.
    };

    FilesRead() { current() = this; }
    FilesRead(const FilesRead&) = delete;
    FilesRead& operator=(const FilesRead&) = delete;
    ~FilesRead() { current() = outer_; }

    /// All files so far, in the order of reading.
    [[nodiscard]] const std::vector<File>& files() const noexcept { return files_; }

    /// A hash of the contents of all files so far, in the order of reading. Names do
    /// not count, the absence of a file does.
    [[nodiscard]] std::uint64_t hash() const noexcept {
        std::uint64_t all = detail::fnv_start;
        for (const File& file : files_)
            for (const unsigned char byte : detail::bytes_of(file.hash))
                all = detail::fnv_hash(all, byte);
        return all;
    }

private:
    friend Bytes load_file(const std::string&, std::size_t, std::string_view);
    static FilesRead*& current() noexcept {
        thread_local FilesRead* list = nullptr;
        return list;
    }
    static void note(const std::string& path) {
        if (current() != nullptr) current()->files_.push_back({path});
    }
    static void note(const Bytes& bytes) {
        if (current() == nullptr) return;
        std::uint64_t hash = detail::fnv_start;
        for (const unsigned char byte : bytes) hash = detail::fnv_hash(hash, byte);
        current()->files_.back().hash = hash;
    }

    std::vector<File> files_;
    FilesRead* outer_ = current();
};

/// Reads a file; a FilesRead takes note of it.
/// \param path  The file; not a pipe or a device, which may never end.
/// \param most  The largest size in bytes.
/// \param begin The first bytes that it must have; they are tested first.
/// \throws std::runtime_error  with path and reason.
[[nodiscard]] inline Bytes load_file(const std::string& path, std::size_t most,
                                     std::string_view begin = {}) {
    FilesRead::note(path);
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

    // In pieces, because the length in a file's header cannot be trusted.
    Bytes bytes;
    for (std::size_t piece = std::size_t(1) << 16;;
         piece = std::max(piece, bytes.size())) {
        const std::size_t old_size = bytes.size();
        // One byte more than the limit shows that the file is longer.
        const std::size_t room = most - old_size;
        const std::size_t wanted = room < piece ? room + 1 : piece;
        bytes.resize(old_size + wanted);
        const std::size_t got =
            std::fread(bytes.data() + old_size, 1, wanted, closed.file);
        const int error = errno;
        bytes.resize(old_size + got);
        if (std::ferror(closed.file)) detail::fail_to_read(path, std::strerror(error));
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                                    bytes.size());
        if (!text.starts_with(begin))
            detail::fail_to_read(path, detail::join({"it does not begin with '",
                                                     shown(std::string(begin)),
                                                     "': it is another kind of file"}));
        if (bytes.size() > most)
            detail::fail_to_read(
                path, detail::join({"it is longer than the ", std::to_string(most),
                                    " bytes allowed"}));
        if (got < wanted) {
            FilesRead::note(bytes);
            return bytes;
        }
    }
}

namespace detail {

// A text without the byte order mark of UTF-8; UTF-16 is refused.
inline std::string_view plain_text(std::string_view text, const std::string& path) {
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        fail_to_read(path, "its text is UTF-16; save it as UTF-8");
    return text.substr(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
}

// The plain_text() of a file.
inline std::string load_text(const std::string& path, std::size_t most) {
    const Bytes bytes = load_file(path, most);
    return std::string(
        plain_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path));
}

} // namespace detail

/// \}

} // namespace ljus

#ifdef _MSC_VER
#pragma warning(pop)
#endif
