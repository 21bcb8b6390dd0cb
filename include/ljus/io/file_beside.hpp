#pragma once

/// \file ljus/io/file_beside.hpp
/// \brief Saves files whole or not at all.

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ljus/math/require.hpp"

#if __has_include(<unistd.h>)
#include <cstdlib>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#ifdef _MSC_VER
#pragma warning(push)
#pragma warning(disable : 4996) // this header uses std::fopen
#endif

namespace ljus {

/// \defgroup file Files
/// \brief Reading files, and saving them whole or not at all.
/// \{

/// The bytes of a file.
using Bytes = std::vector<unsigned char>;

/// Prepares a text from a file or a user for a message: one line of at most `limit`
/// bytes, followed by "..." if the text is longer. Each control character, and each
/// byte that is not UTF-8, is replaced by `?`.
[[nodiscard, gnu::cold]] inline std::string shown(std::string text,
                                                  std::size_t limit = 48) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    for (std::size_t i = 0, size = 1; i < text.size(); i += size) {
        const unsigned first = byte(i);
        size = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
        bool good = first < 0x80 ? first >= 0x20 && first != 0x7f
                                 : first >= 0xc2 && first < 0xf5;
        for (std::size_t k = 1; k < size; ++k) good = good && byte(i + k) >> 6 == 2;
        if (first == 0xc2 && byte(i + 1) < 0xa0) good = false; // C1 control characters
        if (good) continue;
        text[i] = '?';
        size = 1;
    }
    if (text.size() <= limit) return text;
    // No UTF-8 character is cut.
    while (limit > 0 && (static_cast<unsigned char>(text[limit]) & 0xc0u) == 0x80u)
        --limit;
    return detail::join({std::string_view(text).substr(0, limit), "..."});
}

/// Prepares a path for a message, as shown() does, with at most 1000 bytes.
[[nodiscard, gnu::cold]] inline std::string shown_path(const std::string& path) {
    return shown(path, 1000);
}

namespace detail {

[[noreturn, gnu::cold]] inline void fail_to_write(const std::string& path,
                                                  std::string_view why) {
    throw std::runtime_error(
        join({"cannot write '", shown_path(path), "': ", why, "."}));
}
[[noreturn, gnu::cold]] inline void fail_to_write(const std::string& path, int error) {
    fail_to_write(path, std::strerror(error));
}

// A path that is the same for all names and links of a file; the path itself if the
// file does not exist.
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

// The path of the file that a save replaces. For a symbolic link this is its target, so
// that the link remains. Throws for folders, pipes, devices (/dev/null) and files
// without write permission, which are not replaced.
[[gnu::cold]] inline std::string file_to_replace(const std::string& path) {
#if __has_include(<unistd.h>)
    struct ::stat status = {};
    if (::stat(path.c_str(), &status) != 0) {
        if (::lstat(path.c_str(), &status) == 0 && S_ISLNK(status.st_mode))
            fail_to_write(path, "it is a link to a file that does not exist");
        return path;
    }
    if (S_ISDIR(status.st_mode)) fail_to_write(path, EISDIR);
    if (!S_ISREG(status.st_mode))
        fail_to_write(path, "it is a pipe, a socket or a device, not a file");
    if ((status.st_mode & 0222) == 0 || ::access(path.c_str(), W_OK) != 0)
        fail_to_write(path, EACCES);
#endif
    return one_path(path);
}

// A new file beside `path`, which is removed unless it is renamed to `path`. If
// `nameless`, on systems that allow it, the file gets a name only when it is complete,
// so that a program that is killed before leaves no file. Files in use are locked: the
// next save removes an unlocked file.
class FileBeside {
public:
    [[gnu::cold]] explicit FileBeside(const std::string& path, bool nameless = true)
        : path_(path) {
        if (nameless) open_nameless();
        // The mode "x" never opens a file of another process.
        for (long long number = 0; file_ == nullptr && number < most_names; ++number) {
            name_ = name_of(number);
            remove_what_is_left(name_);
            file_ = std::fopen(name_.c_str(), "wbx");
            if (file_ == nullptr && errno != EEXIST) break;
            if (file_ != nullptr && !lock()) std::fclose(std::exchange(file_, nullptr));
        }
        if (file_ == nullptr) fail_to_write(path_, errno);
#if __has_include(<unistd.h>)
        struct ::stat older = {}; // its permissions, for the new file
        if (::stat(path.c_str(), &older) == 0)
            (void)::fchmod(::fileno(file_), older.st_mode & 07777);
#endif
    }
    FileBeside(const FileBeside&) = delete;
    FileBeside& operator=(const FileBeside&) = delete;
    [[gnu::cold]] ~FileBeside() {
        if (file_ != nullptr) std::fclose(file_);
        if (!renamed_ && !name_.empty()) std::remove(name_.c_str());
#if __has_include(<unistd.h>)
        if (lock_ >= 0) ::close(lock_);
#endif
    }

    [[gnu::cold]] void write(std::span<const unsigned char> bytes) {
        if (bytes.empty()) return;
        if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size())
            fail_to_write(path_, errno);
    }

    [[gnu::cold]] void close() {
        if (std::fflush(file_) != 0) fail_to_write(path_, errno);
#if __has_include(<unistd.h>)
        // If the file were renamed before its bytes are on the disk, a loss of power
        // could leave the name without the bytes. Some file systems lack fsync.
        if (::fsync(::fileno(file_)) != 0 && errno != EINVAL && errno != ENOTSUP)
            fail_to_write(path_, errno);
#endif
        if (name_.empty()) give_name();
        // fclose closes the file even if it reports that the last write failed.
        std::FILE* const file = file_;
        file_ = nullptr;
        if (std::fclose(file) != 0) fail_to_write(path_, errno);
    }

    [[gnu::cold]] void rename_to_path() {
#ifdef _WIN32
        // On Windows std::rename does not replace a file.
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
    static constexpr long long most_names = 10'000;
    [[gnu::cold]] std::string name_of(long long number) const {
        return join({path_, ".ljus-part", to_text(number)});
    }

#if __has_include(<unistd.h>)
    // Whether an open file has this name.
    static bool is_named(int file, const std::string& name) {
        struct ::stat open = {}, named = {};
        return ::fstat(file, &open) == 0 && ::lstat(name.c_str(), &named) == 0 &&
               open.st_dev == named.st_dev && open.st_ino == named.st_ino;
    }
#endif
    // Locks the file, on systems with locks. Returns whether it still has its name:
    // another process may have taken it for an abandoned file before it was locked.
    [[gnu::cold]] bool lock() {
#if __has_include(<unistd.h>)
        if (lock_ >= 0) ::close(lock_);
        lock_ = ::fcntl(::fileno(file_), F_DUPFD_CLOEXEC, 0); // keeps the lock
        if (::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
            return false;
        return is_named(lock_, name_);
#else
        return true;
#endif
    }
    [[gnu::cold]] static void remove_what_is_left(const std::string& name) {
#if __has_include(<unistd.h>)
        struct ::stat status = {};
        const int left =
            ::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (left < 0) return;
        if (::fstat(left, &status) == 0 && S_ISREG(status.st_mode) &&
            ::flock(left, LOCK_EX | LOCK_NB) == 0 && is_named(left, name))
            std::remove(name.c_str());
        ::close(left);
#endif
    }

    // Opens a file without a name. If this fails, a file with a name is opened.
    [[gnu::cold]] void open_nameless() {
#if defined(O_TMPFILE) && defined(AT_SYMLINK_FOLLOW)
        struct ::stat status = {};
        if (::stat(name_of(0).c_str(), &status) != 0 && errno != ENOENT) return;
        if (::stat("/proc/self/fd", &status) != 0) return;
        const std::string folder = path_.substr(0, path_.find_last_of('/') + 1);
        const int number = ::open(folder.empty() ? "." : folder.c_str(),
                                  O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
        if (number < 0) return;
        file_ = ::fdopen(number, "wb");
        if (file_ == nullptr)
            ::close(number);
        else
            lock();
#endif
    }
    [[gnu::cold]] void give_name() {
#if defined(O_TMPFILE) && defined(AT_SYMLINK_FOLLOW)
        const std::string mine = join({"/proc/self/fd/", to_text(::fileno(file_))});
        for (long long number = 0; number < most_names; ++number) {
            const std::string name = name_of(number);
            remove_what_is_left(name);
            if (::linkat(AT_FDCWD, mine.c_str(), AT_FDCWD, name.c_str(),
                         AT_SYMLINK_FOLLOW) == 0) {
                name_ = name;
                return;
            }
            if (errno != EEXIST) break;
        }
        fail_to_write(path_, errno);
#endif
    }

    std::string path_;
    std::string name_; // empty while the file has no name
    std::FILE* file_ = nullptr;
    int lock_ = -1; // a second descriptor of the file
    bool renamed_ = false;
};

} // namespace detail

/// Writes a new file beside `path`, and renames it to `path` when everything has been
/// written. If anything fails, an older file is unchanged and no other file is left.
/// The new file has the permissions of the older one. A program that is killed while it
/// renames leaves the complete new file as `a.png.ljus-part0`, which the next save of
/// `a.png` removes. A program that wants an exception when a file-size limit is reached
/// must ignore SIGXFSZ.
/// \throws std::runtime_error  if the file cannot be written: "cannot write
///         'out/a.png': No space left on device.".
[[gnu::cold]] inline void save_file(const std::string& path, const Bytes& bytes) {
    detail::FileBeside file(detail::file_to_replace(path));
    file.write(bytes);
    file.close();
    file.rename_to_path();
}

/// Tests, before a long computation, whether save_file() could write to `path`. A file
/// of one byte is written beside `path` and removed.
/// \throws std::runtime_error  as save_file().
inline void require_writable(const std::string& path) {
    detail::FileBeside probe(detail::file_to_replace(path));
    probe.write(Bytes{0});
    probe.close();
}

/// \}

} // namespace ljus

#ifdef _MSC_VER
#pragma warning(pop)
#endif
