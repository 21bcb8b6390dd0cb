#pragma once

/// \file ljus/io/file.hpp
/// \brief Files as a whole: written beside and renamed, or read up to a limit.

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "ljus/math/require.hpp"

#if __has_include(<unistd.h>)
#include <cstdlib>
#include <sys/stat.h>
#endif

#ifdef _MSC_VER
#pragma warning(push)
#pragma warning(disable : 4996) // std::fopen is what this header wants
#endif

namespace ljus {

/// \defgroup file Files
/// \brief No half-written file, and no older file lost.
/// \{

/// The bytes of a file.
using Bytes = std::vector<unsigned char>;

namespace detail {

// A text of a file as a message shows it: on one line, and not too long; `?` for each
// control character.
[[nodiscard]] inline std::string shown(std::string text, std::size_t limit = 48) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    if (text.size() <= limit) return text;
    // Not in the middle of a UTF-8 character.
    while (limit > 0 && (static_cast<unsigned char>(text[limit]) & 0xc0u) == 0x80u)
        --limit;
    return join({std::string_view(text).substr(0, limit), "..."});
}

// A path as a message shows it: another file may have named it.
[[nodiscard]] inline std::string shown_path(const std::string& path) {
    return shown(path, 1000);
}

[[noreturn]] inline void fail_to_write(const std::string& path, int error) {
    throw std::runtime_error(join({"cannot write '", shown_path(path), "': ",
                                   std::strerror(error == 0 ? EIO : error), "."}));
}

[[noreturn]] inline void fail_to_read(const std::string& path, std::string_view why) {
    throw std::runtime_error(
        join({"cannot read '", shown_path(path), "': ", why, "."}));
}

// The file that a save replaces: behind a symbolic link its target, so that the link
// stays. What is there and no plain file (a folder, /dev/null) is not replaced.
inline std::string file_to_replace(const std::string& path) {
#if __has_include(<unistd.h>)
    struct ::stat status = {};
    if (::stat(path.c_str(), &status) != 0) return path;
    if (S_ISDIR(status.st_mode)) fail_to_write(path, EISDIR);
    if (!S_ISREG(status.st_mode)) fail_to_write(path, EEXIST);
    if (char* const resolved = ::realpath(path.c_str(), nullptr)) {
        const std::string target = resolved;
        std::free(resolved);
        return target;
    }
#endif
    return path;
}

// A new file beside `path`, which goes again unless it is renamed to `path`.
class FileBeside {
public:
    explicit FileBeside(const std::string& path) : path_(path) {
        // "x": never a file that is there already, e.g. of another process.
        for (long long number = 0; file_ == nullptr && number < 100; ++number) {
            name_ = join({path, ".part", to_text(number)});
            errno = 0;
            file_ = std::fopen(name_.c_str(), "wbx");
            if (file_ == nullptr && errno != EEXIST) break;
        }
        if (file_ == nullptr) fail_to_write(path_, errno);
    }
    FileBeside(const FileBeside&) = delete;
    FileBeside& operator=(const FileBeside&) = delete;
    ~FileBeside() {
        if (file_ != nullptr) std::fclose(file_);
        if (!renamed_) std::remove(name_.c_str());
    }

    void write(const Bytes& bytes) {
        if (bytes.empty()) return;
        errno = 0;
        if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size())
            fail_to_write(path_, errno);
    }

    void close() {
        errno = 0;
        if (std::fflush(file_) != 0) fail_to_write(path_, errno);
        // The file counts as closed even if fclose reports that the last write failed.
        std::FILE* const file = file_;
        file_ = nullptr;
        if (std::fclose(file) != 0) fail_to_write(path_, errno);
    }

    void rename_to_path() {
#ifdef _WIN32
        // Here std::rename does not replace: the older file steps aside, and comes back
        // if the new one cannot take its place.
        const std::string aside = name_ + ".old";
        const bool older = std::rename(path_.c_str(), aside.c_str()) == 0;
        renamed_ = std::rename(name_.c_str(), path_.c_str()) == 0;
        const int error = errno;
        if (older && renamed_) std::remove(aside.c_str());
        if (older && !renamed_) std::rename(aside.c_str(), path_.c_str());
        if (!renamed_) fail_to_write(path_, error);
#else
        if (std::rename(name_.c_str(), path_.c_str()) != 0) fail_to_write(path_, errno);
        renamed_ = true;
#endif
    }

private:
    std::string path_;
    std::string name_;
    std::FILE* file_ = nullptr;
    bool renamed_ = false;
};

} // namespace detail

/// Writes a file: beside `path` first, and renamed once every write, the flush and the
/// close have succeeded. Whatever fails, an older file stays as it was and nothing else
/// is left. (A program that wants to hear of the file-size limit must ignore SIGXFSZ.)
/// \param path   The file; its folder must exist.
/// \param bytes  What the file shall hold.
/// \throws std::runtime_error  "cannot write 'out/a.png': No space left on device.".
inline void save_file(const std::string& path, const Bytes& bytes) {
    detail::FileBeside file(detail::file_to_replace(path));
    file.write(bytes);
    file.close();
    file.rename_to_path();
}

/// Reads a file.
/// \param path  The file.
/// \param most  The most bytes it may have: what is longer, or endless, is refused.
/// \param begin What it must begin with, looked at before it is read to the end.
/// \return All its bytes.
/// \throws std::runtime_error  with path and reason.
[[nodiscard]] inline Bytes load_file(const std::string& path, std::size_t most,
                                     std::string_view begin = {}) {
    struct Closed {
        std::FILE* file;
        ~Closed() {
            if (file != nullptr) std::fclose(file);
        }
    };
    errno = 0;
    const Closed closed{std::fopen(path.c_str(), "rb")};
    if (closed.file == nullptr) detail::fail_to_read(path, std::strerror(errno));

    // In pieces, since what a file says about its length cannot be relied on.
    Bytes bytes;
    for (std::size_t piece = std::size_t(1) << 16;;
         piece = std::max(piece, bytes.size())) {
        const std::size_t old_size = bytes.size();
        // One byte more than is allowed tells that the file is longer.
        const std::size_t room = most - old_size;
        const std::size_t wanted = room < piece ? room + 1 : piece;
        bytes.resize(old_size + wanted);
        errno = 0;
        const std::size_t got =
            std::fread(bytes.data() + old_size, 1, wanted, closed.file);
        const int error = errno;
        bytes.resize(old_size + got);
        if (std::ferror(closed.file)) detail::fail_to_read(path, std::strerror(error));
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                                    bytes.size());
        if (!text.starts_with(begin))
            detail::fail_to_read(
                path, detail::join({"it does not begin with '", begin,
                                    "', so that it is another kind of file"}));
        if (bytes.size() > most)
            detail::fail_to_read(
                path, detail::join({"it is longer than the ", std::to_string(most),
                                    " bytes that are allowed"}));
        if (got < wanted) return bytes;
    }
}

/// \}

} // namespace ljus

#ifdef _MSC_VER
#pragma warning(pop)
#endif
