/// \file tests/checks/killed_saves.cpp
/// \brief Kills a program at random while it saves files: either the old or the new
/// file is there, complete, and what the killed save has left the next one removes.
///
///     killed_saves FOLDER [KILLS]     kills of each kind of file; 20 if none are given

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "ljus/io/hdr.hpp"
#include "ljus/io/light_map_file.hpp"
#include "ljus/io/pfm.hpp"
#include "ljus/io/png.hpp"
#include "ljus/io/progressive_file.hpp"

using namespace ljus;

namespace {

/// How one kind of file is saved with one of two contents.
struct Kind {
    const char* name;
    std::function<void(const std::string& path, bool second)> save;
};

std::vector<Kind> all_kinds_of_files() {
    const auto picture = [](bool second) {
        Image image = make_image<float>(second ? 100 : 80, 60);
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] = Rgb{float(i % 97) / 97, float(i % 31) / 31, 0.5f};
        return image;
    };
    const auto light = [](bool second) {
        const std::uint32_t side = second ? 40 : 30;
        return LightMap{.grids = {{.columns = side, .rows = side}},
                        .irradiance = {side * side, RgbT<double>(1)}};
    };
    const auto passes = [](bool second) {
        ProgressiveState state{.block_side = 8};
        state.sum = state.squares = make_image<double>(second ? 48 : 40, 40);
        state.block_squares = make_image<double>(second ? 6 : 5, 5);
        state.passes = 1;
        return state;
    };
    return {{"png", [=](auto& path, bool b) { save_png(picture(b), path); }},
            {"pfm", [=](auto& path, bool b) { save_pfm(picture(b), path); }},
            {"hdr", [=](auto& path, bool b) { save_hdr(picture(b), path); }},
            {"light", [=](auto& path, bool b) { save_light_map(path, light(b)); }},
            {"check", [=](auto& path, bool b) { save_checkpoint(path, passes(b)); }},
            {"json", [](auto& path, bool b) {
                 save_file(path, Bytes(b ? 70000u : 50000u, ' '));
             }}};
}

[[noreturn]] void fail(const char* name, int kill, const char* what) {
    std::fprintf(stderr, "WRONG: %s, kill %d: %s\n", name, kill, what);
    std::exit(1);
}

std::size_t files_in(const std::filesystem::path& folder) {
    std::size_t count = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder))
        count += file.is_regular_file();
    return count;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) return 2;
    const int kills = argc > 2 ? std::atoi(argv[2]) : 20;
    std::srand(7);
    for (const Kind& kind : all_kinds_of_files()) {
        const auto folder = std::filesystem::path(argv[1]) / kind.name;
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
        const std::string path = (folder / "saved").string();
        kind.save(path, true);
        const Bytes second = load_file(path, 10'000'000);
        kind.save(path, false);
        const Bytes first = load_file(path, 10'000'000);
        int replaced = 0;
        for (int i = 0; i < kills; ++i) {
            const Bytes before = load_file(path, 10'000'000);
            const pid_t child = ::fork();
            if (child == 0) {
                try {
                    for (bool b = before == first;; b = !b) kind.save(path, b);
                } catch (...) {
                    std::_Exit(1);
                }
            }
            ::usleep(static_cast<useconds_t>(std::rand() % 8000));
            ::kill(child, SIGKILL);
            int status = 0;
            ::waitpid(child, &status, 0);
            if (!WIFSIGNALED(status)) fail(kind.name, i, "a save failed");
            const Bytes after = load_file(path, 10'000'000);
            if (after != first && after != second)
                fail(kind.name, i, "the file is neither the older nor the new one");
            replaced += after != before;
        }
        kind.save(path, true);
        if (load_file(path, 10'000'000) != second)
            fail(kind.name, kills, "the next save did not replace the file");
        if (files_in(folder) != 1) fail(kind.name, kills, "a kill leaves a file");
        std::printf("%s: %d kills, the new file was there after %d\n", kind.name, kills,
                    replaced);
    }
    return 0;
}
