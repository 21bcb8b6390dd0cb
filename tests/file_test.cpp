// alone: its fsync() takes the place of the system's
#include <doctest/doctest.h>

#include <cstring>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include "ljus/io/file.hpp"
#include "scratch_folder.hpp"
#include "support/refusal.hpp"

#if __has_include(<sys/resource.h>)
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

#ifdef __linux__
namespace {
int sync_error = 0; ///< What fsync() shall report.
}

/// In place of the library's: what no disk that works will say. Nothing is asked of the
/// disk, which is slow.
extern "C" int fsync(int) {
    if (sync_error == 0) return 0;
    errno = sync_error;
    return -1;
}
#endif

namespace {

ljus::Bytes bytes_of(const std::string& text) {
    return {text.begin(), text.end()};
}

std::string message_of_save(const std::string& path, const ljus::Bytes& bytes) {
    return ljus_test::refusal<std::runtime_error>([&] { ljus::save_file(path, bytes); },
                                                  "saved");
}

} // namespace

TEST_CASE("file: what is saved is what is loaded, also nothing at all") {
    const ScratchFolder folder;
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, std::size_t{65535}, std::size_t{65536},
          std::size_t{65537}, std::size_t{1000003}}) {
        ljus::Bytes bytes(size);
        for (std::size_t i = 0; i < size; ++i)
            bytes[i] = static_cast<unsigned char>(i * 2654435761u >> 8);
        ljus::save_file(folder.file("a"), bytes);
        CHECK(ljus::load_file(folder.file("a"), size) == bytes);
        CHECK(folder.count() == 1);
    }
}

TEST_CASE("file: a new one replaces the older one") {
    const ScratchFolder folder;
    ljus::save_file(folder.file("a"), bytes_of("the older one, and longer"));
    ljus::save_file(folder.file("a"), bytes_of("new"));
    CHECK(ScratchFolder::read(folder.file("a")) == "new");
    CHECK(folder.count() == 1);
}

#if __has_include(<unistd.h>)
TEST_CASE("file: what a killed program has left is removed, what another one writes is "
          "not") {
    const ScratchFolder folder;
    const std::string path = folder.file("a"), left = path + ".ljus-part0";
    ScratchFolder::write(left, "of a killed program");
    ljus::save_file(path, bytes_of("mine"));
    CHECK(ScratchFolder::read(path) == "mine");
    CHECK(folder.count() == 1);
    for (const bool nameless : {true, false}) {
        ljus::detail::FileBeside other(path, nameless);
        other.write(bytes_of("another's"));
        other.close();
        CHECK(std::filesystem::exists(left));
        ljus::save_file(path, bytes_of("mine"));
        REQUIRE(ScratchFolder::read(left) == "another's");
        other.rename_to_path();
        CHECK(ScratchFolder::read(path) == "another's");
        CHECK(folder.count() == 1);
    }
    // What is no file, and what has another name, was not left by a save.
    std::filesystem::create_directory(left);
    std::filesystem::create_symlink("b", path + ".ljus-part1");
    ScratchFolder::write(folder.file("a.part0"), "someone's");
    ljus::save_file(path, bytes_of("mine"));
    CHECK(ScratchFolder::read(path) == "mine");
    CHECK(folder.count() == 4);
}
#endif

TEST_CASE("file: a failure to write names the path and the reason") {
    const ScratchFolder folder;
    const std::string missing = folder.file("missing/a.png");
    CHECK(message_of_save(missing, {}) ==
          "cannot write '" + missing + "': No such file or directory.");
    ScratchFolder::write(folder.file("plain"), "x");
    CHECK(message_of_save(folder.file("plain/a.png"), {}) ==
          "cannot write '" + folder.file("plain/a.png") + "': Not a directory.");
    CHECK(message_of_save("", {}) == "cannot write '': No such file or directory.");
    const std::string long_name = folder.file(std::string(300, 'x'));
    CHECK(message_of_save(long_name, {}) ==
          "cannot write '" + long_name + "': File name too long.");
    CHECK(folder.count() == 1);
}

TEST_CASE("file: a folder or a device in the place of the file is left alone") {
    const ScratchFolder folder;
    CHECK(message_of_save(folder.path.string(), {}) ==
          "cannot write '" + folder.path.string() + "': Is a directory.");
#if __has_include(<sys/resource.h>)
    const std::string pipe = folder.file("pipe");
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    for (const std::string& name : {pipe, std::string("/dev/null")})
        CHECK(message_of_save(name, {}) ==
              "cannot write '" + name +
                  "': it is a pipe, a socket or a device, not a file.");
    CHECK(std::filesystem::is_character_file("/dev/null"));
    CHECK(std::filesystem::is_fifo(pipe));
    CHECK(folder.count() == 1);
#endif
}

#if __has_include(<sys/resource.h>)
TEST_CASE("file: behind a symbolic link its target is replaced, the link stays") {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.path / "inner");
    ScratchFolder::write(folder.file("inner/target"), "older");
    std::filesystem::create_symlink("inner/target", folder.path / "link");
    ljus::save_file(folder.file("link"), bytes_of("newer"));
    CHECK(std::filesystem::is_symlink(folder.path / "link"));
    CHECK(ScratchFolder::read(folder.file("inner/target")) == "newer");
    CHECK(folder.count() == 2);
    const std::string nowhere = folder.file("nowhere");
    std::filesystem::create_symlink("missing", nowhere);
    CHECK(message_of_save(nowhere, {}) ==
          "cannot write '" + nowhere +
              "': it is a link to a file that does not exist.");
    CHECK(std::filesystem::is_symlink(nowhere));
    CHECK(folder.count() == 3);
}

TEST_CASE(
    "file: at the file-size limit the older file stays and nothing else is left") {
    const ScratchFolder folder;
    ScratchFolder::write(folder.file("a"), "older");

    ::rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    ::rlimit small = before;
    small.rlim_cur = 4096;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    // Longer than the buffer of a FILE, and shorter: the write and the flush fail.
    ::setrlimit(RLIMIT_FSIZE, &small);
    const std::string long_message =
        message_of_save(folder.file("a"), ljus::Bytes(1 << 20));
    small.rlim_cur = 1000;
    ::setrlimit(RLIMIT_FSIZE, &small);
    const std::string short_message =
        message_of_save(folder.file("a"), ljus::Bytes(2000));
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);

    CHECK(long_message == "cannot write '" + folder.file("a") + "': File too large.");
    CHECK(short_message == long_message);
    CHECK(ScratchFolder::read(folder.file("a")) == "older");
    CHECK(folder.count() == 1);
}
#endif

#if __has_include(<sys/resource.h>)
TEST_CASE("file: who may read it stays the same, and what nobody may write stays") {
    using std::filesystem::perms, std::filesystem::permissions;
    const ScratchFolder folder;
    const std::string path = folder.file("a");
    ScratchFolder::write(path, "older");
    const auto mode = [&] { return std::filesystem::status(path).permissions(); };
    permissions(path, perms::owner_read | perms::owner_write);
    ljus::save_file(path, bytes_of("newer"));
    CHECK(mode() == (perms::owner_read | perms::owner_write));
    permissions(path, perms::owner_read);
    CHECK(message_of_save(path, bytes_of("newest")) ==
          "cannot write '" + path + "': Permission denied.");
    CHECK(ScratchFolder::read(path) == "newer");
    CHECK(folder.count() == 1);
}

#ifdef __linux__
TEST_CASE("file: what the disk refuses is told, and what it cannot do is not asked") {
    const ScratchFolder folder;
    const std::string path = folder.file("a");
    ScratchFolder::write(path, "older");
    for (const int error : {EIO, ENOSPC}) {
        sync_error = error;
        CHECK(message_of_save(path, bytes_of("newer")) ==
              "cannot write '" + path + "': " + std::strerror(error) + ".");
        CHECK(ScratchFolder::read(path) == "older");
        CHECK(folder.count() == 1);
    }
    for (const int error : {EINVAL, ENOTSUP}) { // a file system without it
        sync_error = error;
        CHECK(message_of_save(path, bytes_of(std::strerror(error))) == "saved");
        CHECK(ScratchFolder::read(path) == std::strerror(error));
    }
    sync_error = 0;
}
#endif

TEST_CASE("file: where no file can be without a name it has one from the beginning") {
    const ScratchFolder folder;
    const std::string path = folder.file("a");
    ScratchFolder::write(path, "older");
    {
        ljus::detail::FileBeside file(path, false);
        file.write(bytes_of("newer"));
        file.close();
        CHECK(ScratchFolder::read(folder.file("a.ljus-part0")) == "newer");
        CHECK(ScratchFolder::read(path) == "older");
        file.rename_to_path();
    }
    CHECK(ScratchFolder::read(path) == "newer");
    CHECK(folder.count() == 1);
    { // given up before it is whole, and after
        const ljus::detail::FileBeside file(path, false);
        CHECK(folder.count() == 2);
    }
    {
        ljus::detail::FileBeside file(path, false);
        file.close();
    }
    CHECK(folder.count() == 1);
    // One that cannot be is refused at once, not when all has been written.
    const std::string long_name = folder.file(std::string(250, 'x'));
    for (const bool nameless : {true, false})
        CHECK_THROWS_WITH(
            ljus::detail::FileBeside(long_name, nameless),
            ("cannot write '" + long_name + "': File name too long.").c_str());
}

TEST_CASE("file: what others have left beside it does not block a save") {
    const ScratchFolder folder;
    for (int i = 0; i < 150; ++i)
        std::filesystem::create_directory(folder.file("a.ljus-part") +
                                          std::to_string(i));
    CHECK(message_of_save(folder.file("a"), bytes_of("mine")) == "saved");
    CHECK(ScratchFolder::read(folder.file("a")) == "mine");
    CHECK(folder.count() == 151);
}

TEST_CASE("file: a program that is killed while it saves leaves the older file, and "
          "nothing where files can be without a name") {
    const ScratchFolder folder;
    const std::string path = folder.file("a");
    const ljus::Bytes first(6'000'000, 'a'), second(6'000'000, 'b');
    ljus::save_file(path, first);
    for (int round = 0; round < 40; ++round) {
        const ::pid_t child = ::fork();
        REQUIRE(child >= 0);
        if (child == 0)
            for (;;) ljus::save_file(path, round % 2 == 0 ? second : first);
        ::usleep(static_cast<::useconds_t>(500 + 397 * round));
        REQUIRE(::kill(child, SIGKILL) == 0);
        int status = 0;
        REQUIRE(::waitpid(child, &status, 0) == child);
        const ljus::Bytes found = ljus::load_file(path, 10'000'000);
        REQUIRE((found == first || found == second));
    }
    CHECK(message_of_save(path, first) == "saved");
    CHECK(folder.count() == 1);
#ifdef O_TMPFILE
    const int nameless =
        ::open(folder.path.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
    if (nameless < 0) return;
    ::close(nameless);
    ljus::detail::FileBeside unfinished(path);
    unfinished.write(second);
    CHECK(folder.count() == 1); // what a kill would leave now
#endif
}

TEST_CASE("file: a pipe and a device are no files, and are not waited for") {
    const ScratchFolder folder;
    const std::string path = folder.file("pipe");
    REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    for (const std::string& name : {path, std::string("/dev/zero")})
        CHECK_THROWS_WITH(
            (void)ljus::load_file(name, 10),
            ("cannot read '" + name + "': it is a pipe or a device, not a file.")
                .c_str());
}
#endif

TEST_CASE("file: a message shows letters, and nothing that moves the cursor") {
    using ljus::shown;
    CHECK(shown("a\tb\x1b[31m\x7f\n") == "a?b?[31m??");
    CHECK(shown("\xc3\xa5\xe2\x82\xac\xf0\x9f\x92\xa1 ") ==
          "\xc3\xa5\xe2\x82\xac\xf0\x9f\x92\xa1 "); // two, three and four bytes
    CHECK(shown("\xff\xc3") == "??");               // no beginning; no end
    CHECK(shown("\xe2\x82") == "??");               // cut short
    CHECK(shown("\x80z\xc0\x80") == "?z??");        // no such letters
    CHECK(shown("\xc2\x9b"
                "2J") == "??2J"); // a control character of two bytes
    CHECK(shown(std::string(47, 'x') + "\xc3\xa5").size() == 47 + 3);
}

TEST_CASE("file: a failure to read names the path and the reason") {
    const ScratchFolder folder;
    CHECK_THROWS_WITH_AS((void)ljus::load_file("/missing/a", 10),
                         "cannot read '/missing/a': No such file or directory.",
                         std::runtime_error);
    CHECK_THROWS_WITH(
        (void)ljus::load_file(folder.path.string(), 10),
        ("cannot read '" + folder.path.string() + "': Is a directory.").c_str());
    const std::string path = folder.file("a");
    ScratchFolder::write(path, "0123456789");
    CHECK(ljus::load_file(path, 10).size() == 10);
    CHECK(ljus::load_file(path, std::numeric_limits<std::size_t>::max()).size() == 10);
    CHECK_THROWS_WITH(
        (void)ljus::load_file(path, 0),
        ("cannot read '" + path + "': it is longer than the 0 bytes allowed.").c_str());
    // A path that another file has named cannot disturb a message.
    CHECK_THROWS_WITH((void)ljus::load_file("/missing/\x1b[31m\n", 10),
                      "cannot read '/missing/?[31m?': No such file or directory.");
    CHECK_THROWS_WITH(
        (void)ljus::load_file(path, 9),
        ("cannot read '" + path + "': it is longer than the 9 bytes allowed.").c_str());
    CHECK_THROWS_WITH((void)ljus::load_file(path, 10, "PF"),
                      ("cannot read '" + path +
                       "': it does not begin with 'PF': it is another kind of file.")
                          .c_str());
}

TEST_CASE("file: a file of too few bytes does not begin as it must") {
    const ScratchFolder folder;
    const std::string path = folder.file("a");
    for (const char* const bytes : {"", "P", "#?RADIANC"}) {
        ScratchFolder::write(path, bytes);
        for (const char* const begin : {"PF", "#?RADIANCE"})
            CHECK_THROWS_WITH((void)ljus::load_file(path, 100, begin),
                              ("cannot read '" + path + "': it does not begin with '" +
                               begin + "': it is another kind of file.")
                                  .c_str());
    }
}

TEST_CASE("file: a file that stands for one of Git LFS is named as such") {
    const ScratchFolder folder;
    const std::string path = folder.file("sky.hdr");
    ScratchFolder::write(path, "version https://git-lfs.github.com/spec/v1\n"
                               "oid sha256:7864531fb60c\nsize 78545491\n");
    CHECK_THROWS_WITH((void)ljus::load_file(path, 1000, "#?"),
                      ("cannot read '" + path +
                       "': it only stands for a file that Git LFS keeps; `git lfs "
                       "pull` brings the file itself.")
                          .c_str());
}

TEST_CASE("file: pieces begin with what was left of the one before") {
    const ScratchFolder folder;
    const std::string path = folder.file("words");
    std::string whole;
    for (int i = 0; i < 40000; ++i) whole += std::to_string(i) + " ";
    whole.append(300000, 'x').append(" end"); // longer than a piece
    ScratchFolder::write(path, whole);
    std::string words;
    int last_ones = 0;
    ljus::read_in_pieces(path, whole.size(), [&](std::string_view text, bool last) {
        const std::size_t used = last ? text.size() : text.rfind(' ') + 1; // or 0
        words += text.substr(0, used);
        last_ones += last ? 1 : 0;
        return used;
    });
    CHECK(words == whole);
    CHECK(last_ones == 1);
    CHECK_THROWS_WITH(
        ljus::read_in_pieces(path, 9,
                             [](std::string_view text, bool) { return text.size(); }),
        ("cannot read '" + path + "': it is longer than the 9 bytes allowed.").c_str());
}

TEST_CASE("file: a list has what was read, as it was then") {
    const ScratchFolder folder;
    const std::string a = folder.file("a"), b = folder.file("b");
    ScratchFolder::write(a, "a");
    ScratchFolder::write(b, "foobar");
    const auto read = [](const std::string& path) { (void)ljus::load_file(path, 10); };
    const auto hash_of = [&](std::initializer_list<std::string> paths) {
        const ljus::FilesRead list;
        for (const std::string& path : paths) read(path);
        return list.hash();
    };
    ljus::FilesRead list;
    read(a);
    ScratchFolder::write(a, "later");
    CHECK(hash_of({b}) != hash_of({a})); // a list of its own
    read(b);
    std::thread(read, a).join(); // not in the list of this thread
    CHECK_THROWS((void)ljus::load_file("/missing/c", 10));
    REQUIRE(list.files().size() == 3);
    CHECK(list.files()[0].path == a);
    CHECK(list.files()[0].hash == 0xaf63dc4c8601ec8cu); // as FNV-1a is published
    CHECK(list.files()[1].hash == 0x85944171f73967e8u);
    CHECK(list.files()[2].path == "/missing/c");
    CHECK(list.files()[2].hash == 0);
    CHECK(list.hash() != hash_of({a, b, a}));
    CHECK(hash_of({a, b}) != hash_of({b, a}));
    CHECK(hash_of({a, b}) != hash_of({a}));
    CHECK(hash_of({a}) == hash_of({a}));
}

TEST_CASE("file: what another file names stands beside it, or at the root") {
    using namespace ljus::detail;
    CHECK(folder_of("a.obj").empty());
    CHECK(folder_of("x/y/a.obj") == "x/y/");
    CHECK(folder_of("x\\a.obj") == "x\\");
    CHECK(folder_of("x/") == "x/");
    CHECK(path_beside("x/a.obj", "b.mtl") == "x/b.mtl");
    CHECK(path_beside("a.obj", "b.mtl") == "b.mtl");
    CHECK(path_beside("x/a.obj", "y/b.mtl") == "x/y/b.mtl");
    CHECK(path_beside("x/a.obj", "y\\b.mtl") == "x/y/b.mtl");
    CHECK(path_beside("x/a.obj", "/y/b.mtl") == "/y/b.mtl");
    CHECK(path_beside("x/a.obj", "").compare("x/") == 0);
}

#if __has_include(<sys/resource.h>)
TEST_CASE("file: what somebody else may write is not replaced") {
    // Only root can change the user.
    if (::geteuid() != 0) return;
    const ScratchFolder folder;
    const std::string path = folder.file("a");
    ScratchFolder::write(path, "older");
    std::filesystem::permissions(folder.path, std::filesystem::perms::all);
    ::chmod(path.c_str(), 0644);
    const ::pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const bool other = ::setgid(65534) == 0 && ::setuid(65534) == 0;
        ::_exit(!other ? 2
                : message_of_save(path, bytes_of("newer")) ==
                        "cannot write '" + path + "': Permission denied."
                    ? 0
                    : 1);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) != 1);
    CHECK(ScratchFolder::read(path) == "older");
}
#endif
