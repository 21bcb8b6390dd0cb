#pragma once

/// \file program_files.hpp
/// \brief Makes sure that a program overwrites neither a file that it reads nor another
/// file that it writes.

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "command_line.hpp"
#include "ljus/io/file.hpp"

namespace examples {

/// A file that a program is about to write.
struct OutputFile {
    std::string name; ///< The option that names it: "--out".
    std::string path; ///< Path of the file; empty if no file is wanted.
};

// The absolute path of a file with all links resolved. Neither the file nor the target
// of a link has to exist.
[[nodiscard]] inline std::filesystem::path place_of(const std::string& file) {
    std::error_code error; // errors leave the path as it is
    std::filesystem::path path = std::filesystem::absolute(file, error);
    for (int i = 0; i < 40 && std::filesystem::is_symlink(path, error); ++i)
        path = path.parent_path() / std::filesystem::read_symlink(path, error);
    const auto place = std::filesystem::weakly_canonical(path, error);
    return place.empty() ? path.lexically_normal() : place;
}

// The relation of a file to another one: "is" if both are the same file, even by
// different names; "stands below" if the other one would have to be a folder; otherwise
// empty.
[[nodiscard]] inline std::string relation(const std::string& a, const std::string& b) {
    std::error_code error;
    const auto first = place_of(a), second = place_of(b);
    if (first == second || std::filesystem::equivalent(a, b, error)) return "is";
    const auto parting =
        std::mismatch(first.begin(), first.end(), second.begin(), second.end());
    return parting.second == second.end() ? "stands below" : "";
}

/// The paths of the files that were read.
[[nodiscard]] inline std::vector<std::string> paths_of(const ljus::FilesRead& read) {
    std::vector<std::string> paths;
    for (const ljus::FilesRead::File& file : read.files()) paths.push_back(file.path);
    return paths;
}

/// Makes sure, before the program begins its work, that every file can be written, and
/// that no file is written twice or is also read, even by different names or links.
/// Creates the folders of the files.
/// \param outputs  All files that the program will write.
/// \param inputs   The paths of all files that the program reads.
/// \throws std::invalid_argument  with the names of both files, if two are the same.
/// \throws std::runtime_error     with path and reason if a file cannot be written.
inline void require_outputs(std::vector<OutputFile> outputs,
                            const std::vector<std::string>& inputs) {
    std::erase_if(outputs, [](const OutputFile& file) { return file.path.empty(); });
    const auto shown = [](const std::string& path) { // without the folder "."
        const auto normal = std::filesystem::path(path).lexically_normal();
        return "'" + ljus::shown_path(normal.string()) + "'";
    };
    const auto refuse = [&](const OutputFile& file, const std::string& what) {
        throw std::invalid_argument(file.name + " is " + shown(file.path) + ", which " +
                                    what);
    };
    for (const OutputFile& file : outputs) {
        for (const std::string& input : inputs)
            if (relation(file.path, input) == "is")
                refuse(file, "is read as " + shown(input) +
                                 "; it must be another file, or that would be lost");
        for (const OutputFile& other : outputs)
            if (const std::string is = relation(file.path, other.path);
                &file != &other && !is.empty())
                refuse(file, is + " " + other.name + ", " + shown(other.path) +
                                 "; it must be a file of its own");
    }
    for (const OutputFile& file : outputs) require_writable(file.path);
}

} // namespace examples
