#pragma once

// A new folder for the files of a test, which goes when the test ends.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

struct ScratchFolder {
    std::filesystem::path path;

    ScratchFolder() {
        std::random_device device;
        do {
            path = std::filesystem::temp_directory_path() /
                   ("ljus-test-" + std::to_string(device()));
        } while (!std::filesystem::create_directory(path));
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }

    std::string file(const std::string& name) const { return (path / name).string(); }

    // How many things are in the folder.
    long count() const {
        return static_cast<long>(
            std::distance(std::filesystem::directory_iterator(path), {}));
    }

    static std::string read(const std::string& name) {
        std::ifstream in(name, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    static void write(const std::string& name, const std::string& bytes) {
        std::ofstream(name, std::ios::binary) << bytes;
    }
};
